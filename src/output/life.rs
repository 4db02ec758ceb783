//! `life.json`, `life.csv` and `damage.npz`: passes until something fails, what happens then, and the damage in a pass below the surface.

use super::columns::{csv, scalars};
use super::error::AtPath;
use super::json::{Unreadable, indented, read_back};
use super::layout::LIFE_STATE as STATE;
use super::npz::Archive;
use super::summary::{UnitNames, check};
use super::{OutputError, disk, write_file, write_text};
use crate::case::Case;
use crate::life::{Beginning, Course, Event, LifeEnd, LifeState, LifeTask};
use crate::reading::Life;
use crate::run::StepRecord;
use crate::stress::SlidingPath;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use std::path::Path;

/// The content of `life.json`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LifeFile {
    /// The version that wrote it.
    pub percoat: String,
    /// Title of the case.
    pub title: String,
    /// The whole case, with its defaults.
    pub case: Value,
    /// Names of the units of all numbers.
    #[serde(default)]
    pub units: UnitNames,
    /// Warnings, a sentence each.
    pub warnings: Vec<String>,
    /// Distance that the counterbody slides in one pass, a length.
    pub distance: f64,
    /// The path along which points of the body meet the stresses; `None` where nothing tires.
    pub path: Option<SlidingPath>,
    /// What fails first; `None` where nothing tires.
    pub first: Option<Life>,
    /// The life of each material and interface that tires.
    pub criteria: Vec<Life>,
    /// What happens up to the prescribed number of passes.
    pub events: Vec<Event>,
    /// What is left and worn, state by state.
    pub wear: Vec<Course>,
    /// Why it ends; `None` where it was followed only to the first failure.
    pub end: Option<LifeEnd>,
    /// Number of loads that were solved.
    pub solved: usize,
    /// The contact before the first pass.
    pub steps: Vec<StepRecord>,
}

impl LifeFile {
    /// The record of a life of a case, whose contact before the first pass has this `record`.
    pub fn new(
        case: &Case,
        task: &LifeTask,
        (begun, record): (&Beginning, StepRecord),
        state: &LifeState,
        warnings: &[String],
    ) -> Self {
        Self {
            percoat: env!("CARGO_PKG_VERSION").to_owned(),
            title: case.title.clone(),
            case: json!(case),
            units: UnitNames::of(case),
            warnings: warnings.to_vec(),
            distance: task.distance(),
            path: begun.fatigue.as_ref().map(|own| own.path),
            first: begun.fatigue.as_ref().map(|own| own.first),
            criteria: begun.fatigue.as_ref().map_or(Vec::new(), |own| own.lives.clone()),
            events: state.events.clone(),
            wear: state.course.clone(),
            end: state.end.filter(|_| task.passes.is_some()),
            solved: state.solved,
            steps: vec![record],
        }
    }

    /// Reads the content of `life.json`.
    ///
    /// # Errors
    /// [`Unreadable`] with the key that is not as this version writes it.
    pub fn read(file: &Value) -> Result<Self, Unreadable> {
        let own: Self = read_back(file)?;
        check(&own.steps)?;
        Ok(own)
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
pub fn write_damage(folder: &Path, task: &LifeTask, begun: &Beginning) -> Result<(), OutputError> {
    let Some(first) = begun.planes.first() else { return Ok(()) };
    let lines = first.lines.len();
    let planes: Vec<_> = begun.planes.iter().filter(|plane| plane.lines.len() == lines).collect();
    let laws: Vec<_> = task.problem.half_space().durabilities().map(|own| own.fatigue).collect();
    write_file(&folder.join("damage.npz"), |writer| {
        let mut archive = Archive::new(writer);
        archive.array("y", &[lines], first.lines.iter().map(|[y, _]| *y))?;
        archive.array("z", &[planes.len()], planes.iter().map(|plane| plane.depth.z))?;
        archive.array("side", &[planes.len()], planes.iter().map(|plane| plane.depth.material as i32))?;
        let ranges =
            || planes.iter().flat_map(|plane| plane.lines.iter().map(move |[_, range]| (plane.depth.material, *range)));
        archive.array("range", &[planes.len(), lines], ranges().map(|(_, range)| range))?;
        let damage = |(material, range): (usize, f64)| laws[material - 1].map_or(0.0, |law| law.damage(range));
        archive.array("damage", &[planes.len(), lines], ranges().map(damage))?;
        archive.finish()
    })
}

/// A state with the fingerprint of its life.
#[derive(Debug, Serialize, Deserialize)]
struct Saved {
    fingerprint: String,
    state: LifeState,
}

/// Saves the state of a life that is not finished, in the place of the one before.
///
/// # Errors
/// [`OutputError`] with the path that cannot be written.
pub fn save_state(staging: &Path, fingerprint: &str, state: &LifeState) -> Result<(), OutputError> {
    let saved = Saved { fingerprint: fingerprint.to_owned(), state: state.clone() };
    let text = serde_json::to_string(&saved).expect("numbers under names");
    write_text(&staging.join(STATE), &(text + "\n"))
}

/// Removes the state of a life that is finished.
///
/// # Errors
/// [`OutputError`] where it cannot be removed.
pub fn forget_state(staging: &Path) -> Result<(), OutputError> {
    let path = staging.join(STATE);
    if disk::is_file(&path) { disk::remove(&path).at(&path) } else { Ok(()) }
}

/// The saved state of a life with this fingerprint; `None` where there is none, or one of another life.
pub fn saved_state(staging: &Path, fingerprint: &str) -> Option<LifeState> {
    let text = disk::read_text(&staging.join(STATE)).ok()?;
    let saved: Saved = serde_json::from_str(&text).ok()?;
    (saved.fingerprint == fingerprint).then_some(saved.state)
}
