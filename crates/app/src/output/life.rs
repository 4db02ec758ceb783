//! `life.json`, `life.csv` and `damage.npz`: passes until something fails, what happens then, and the damage in a pass below the surface.

use super::columns::{csv, scalars};
use super::finished::CannotGoOn;
use super::head::{Head, with_head};
use super::json::{Unreadable, indented, read_back};
use super::layout::LIFE_STATE as STATE;
use super::npz::Archive;
use super::summary::check;
use super::trailer::{with_checksum, without_checksum};
use super::{OutputError, disk, write_file, write_text};
use percoat_case::case::{Case, plausibility};
use percoat_core::life::{Beginning, Course, Event, First, LifeEnd, LifeState, LifeTask};
use percoat_core::reading::{DamageMap, Life};
use percoat_core::run::StepRecord;
use percoat_core::spectral::Stop;
use percoat_core::stress::SlidingPath;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use std::path::Path;

with_head! {
    /// The content of `life.json`.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
    pub struct LifeFile {
        /// Warnings, a sentence each.
        pub warnings: Vec<String>,
        /// Distance that the counterbody slides in one pass, a length; `None` where it is not known.
        pub distance: Option<f64>,
        /// The path along which points of the body meet the stresses; `None` where nothing tires.
        pub path: Option<SlidingPath>,
        /// The first event, of any kind; `None` where nothing tires and nothing is worn through.
        pub first: Option<First>,
        /// The life of each material and interface that tires, under the unworn surfaces.
        pub criteria: Vec<LifeCriterion>,
        /// Events up to the prescribed number of passes.
        pub events: Vec<Event>,
        /// Layers left and heights worn, state by state.
        pub wear: Vec<Course>,
        /// Why the life ends; `None` where it was followed only to the first failure, and there is one.
        pub end: Option<LifeEnd>,
        /// Why the last contact was not solved; `None` where it was.
        #[serde(default)]
        pub stop: Option<Stop>,
        /// Number of loads that were solved.
        pub solved: usize,
        /// The contact before the first pass.
        pub steps: Vec<StepRecord>,
    }
}

/// The life of a material or an interface.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct LifeCriterion {
    /// The life.
    #[serde(flatten)]
    pub life: Life,
    /// Distance that the counterbody has slid by then, a length; `None` where it is not known.
    pub distance: Option<f64>,
}

impl LifeFile {
    /// The record of a life of a case.
    pub fn new(case: &Case, task: &LifeTask, begun: &Beginning, state: &LifeState) -> Self {
        let fatigue = begun.record.fatigue.as_ref();
        let of_life = |life: &Life| LifeCriterion { life: *life, distance: task.slid_after(life.passes) };
        let Head { percoat, title, case: keys, units } = Head::of(case);
        Self {
            percoat,
            title,
            case: keys,
            units,
            warnings: [task.warnings(begun, state), plausibility::of_case(case)].concat(),
            distance: task.distance(),
            path: fatigue.map(|fatigue| fatigue.path),
            first: First::of(task, begun, state),
            criteria: fatigue.map_or(Vec::new(), |fatigue| fatigue.lives.iter().map(of_life).collect()),
            events: state.events.clone(),
            wear: state.course.clone(),
            stop: state.stop,
            end: state.end.filter(|end| task.passes.is_some() || *end == LifeEnd::Endless),
            solved: state.solved,
            steps: vec![begun.record.clone()],
        }
    }

    /// Reads the content of `life.json`.
    ///
    /// # Errors
    /// [`Unreadable`] with the key that is not as this version writes it.
    pub fn read(file: &Value) -> Result<Self, Unreadable> {
        let record: Self = read_back(file)?;
        check(&record.steps)?;
        Ok(record)
    }

    /// The content of `life.json`.
    pub fn to_json(&self) -> String {
        indented(self)
    }

    /// The content of `life.csv`: what is left and worn, a row a state.
    pub fn course(&self) -> String {
        csv(|| self.wear.iter().map(|course| scalars(&json!(course))))
    }
}

/// Writes `damage.npz`: the range of τ₁ along each line y of the path at depths z of each material, and the damage in one pass.
///
/// # Errors
/// [`OutputError`] with the path that cannot be written.
pub fn write_damage(path: &Path, task: &LifeTask, begun: &Beginning) -> Result<(), OutputError> {
    let Some(map) = DamageMap::new(task.problem.half_space(), &begun.planes) else { return Ok(()) };
    let shape = [map.z.len(), map.y.len()];
    write_file(path, |writer| {
        let mut archive = Archive::new(writer);
        archive.array("y", &shape[1..], map.y.iter().copied())?;
        archive.array("z", &shape[..1], map.z.iter().map(|depth| depth.z))?;
        archive.array("side", &shape[..1], map.z.iter().map(|depth| depth.material as i32))?;
        archive.array("range", &shape, map.range.iter().copied())?;
        archive.array("damage", &shape, map.damage.iter().copied())?;
        archive.finish()
    })
}

/// The fingerprint of a life, first in the file of its state.
#[derive(Debug, Deserialize)]
struct Identity {
    fingerprint: String,
}

/// A state with the fingerprint of its life.
#[derive(Debug, Serialize, Deserialize)]
struct Saved {
    fingerprint: String,
    state: LifeState,
}

/// Saves the state of a life, in the place of the one before. It goes with the staging folder once the result is published.
///
/// # Errors
/// [`OutputError`] with the path that cannot be written.
pub fn save_state(staging: &Path, fingerprint: &str, state: &LifeState) -> Result<(), OutputError> {
    let saved = Saved { fingerprint: fingerprint.to_owned(), state: state.clone() };
    let text = serde_json::to_string(&saved).expect("numbers under names");
    write_text(&staging.join(STATE), &(with_checksum(&text) + "\n"))
}

/// The last state of an interrupted life of this fingerprint; `None` where none is saved.
///
/// # Errors
/// [`CannotGoOn`] for a state of another life, and for one that is not as it was written.
pub fn saved_state(staging: &Path, fingerprint: &str) -> Result<Option<LifeState>, CannotGoOn> {
    let path = staging.join(STATE);
    if !disk::is_file(&path) {
        return Ok(None);
    }
    let damaged = |reason: String| CannotGoOn::Damaged { path: path.clone(), reason };
    let text = disk::read_text(&path).map_err(|error| damaged(error.to_string()))?;
    let text = without_checksum(text.trim_end()).map_err(|error| damaged(error.to_string()))?;
    // Another version may have states of another form.
    let identity: Identity = serde_json::from_str(&text).map_err(|error| damaged(error.to_string()))?;
    if identity.fingerprint != fingerprint {
        return Err(CannotGoOn::Foreign(staging.to_owned()));
    }
    let saved: Saved = serde_json::from_str(&text).map_err(|error| damaged(error.to_string()))?;
    Ok(Some(saved.state))
}
