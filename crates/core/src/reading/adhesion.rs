//! Adhesion of a load step: what touches, what pulls, how far the state is from a jump, and the jumps on the way to it.

use crate::adhesion::Adhesion;
use crate::load::Load;
use crate::measured::Measured;
use crate::numeric::serialised;
use crate::problem::Problem;
use crate::quantity::quantities;
use crate::spectral::{AdhesiveNumbers, AdhesiveStep, Jump, PullOff, zone_law};
use serde::{Deserialize, Serialize};

/// Relative difference of forces, and of penetrations over their largest size, that ends a closed path.
const SAME: f64 = 1e-6;

quantities! {
    /// Adhesion of a load step. The pressure of contact and the tension are apart: their difference acts on the bodies.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
    pub struct AdhesionReading {
        /// Sum of the pressure of contact, a force.
        #[serde(deserialize_with = "serialised::number")]
        pub contact_load: f64 = Force "contact load" "P_c" error contact_load_error,
        /// Error of the contact load.
        pub contact_load_error: Option<f64>,
        /// Sum of the tension, a force ≥ 0.
        #[serde(deserialize_with = "serialised::number")]
        pub adhesive_load: f64 = Force "adhesive load" "P_a" error adhesive_load_error,
        /// Error of the adhesive load.
        pub adhesive_load_error: Option<f64>,
        /// Area beside contact where the surfaces pull with more than half of the strength, a length squared, counted by samples.
        #[serde(deserialize_with = "serialised::number")]
        pub cohesive_area: f64 = Area "area that pulls beside contact" "A_a" error cohesive_area_error,
        /// Error of the area that pulls.
        pub cohesive_area_error: Option<f64>,
        /// Margin 1 − κ of stability: 1 where nothing softens, 0 where the surfaces jump; `None` of surfaces that are apart.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub stability: Option<f64> = Fraction "margin of stability" "1 − κ",
        /// Position of the grip, δ + P/k, a length; `None` unless one is prescribed.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub grip: Option<f64> = Length "position of the grip" "Δ",
        /// Tabor's parameter μ of the first level; `None` where its apex has no radius.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub tabor: Option<f64>,
        /// Maugis' parameter λ of the first level; `None` where its apex has no radius.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub maugis: Option<f64>,
        /// Samples across the zone that pulls beside contact.
        #[serde(deserialize_with = "serialised::number")]
        pub samples: f64,
        /// Work of the force on the bodies on the way to this step, an energy.
        #[serde(deserialize_with = "serialised::number")]
        pub work: f64 = Energy "work of the force" "W" error work_error,
        /// Error of the work by the distance of the states on the way.
        pub work_error: Option<f64>,
        /// Jumps on the way to this step.
        #[serde(default)]
        pub jumps: Vec<JumpReading>,
        /// Least force of the path so far; `None` before one has been passed.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub pull_off: Option<PullOffReading>,
    }
    table AdhesionQuantities as ADHESION;
}

/// A jump of the surfaces, before and after.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct JumpReading {
    /// Whether the surfaces come together or part.
    pub kind: JumpKind,
    /// Penetrations, lengths; `None` of surfaces that a load draws apart and nothing holds.
    pub penetration: [Option<f64>; 2],
    /// Forces.
    pub force: [f64; 2],
    /// Areas of the samples that touch, lengths squared.
    pub contact_area: [f64; 2],
    /// Energy that is lost; `None` from and to surfaces that a load draws apart and nothing holds.
    pub loss: Option<f64>,
}

/// Kind of a jump.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum JumpKind {
    /// The surfaces come together.
    In,
    /// The surfaces part.
    Out,
}

/// The least force of a path: a falling load pulls the surfaces apart there.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PullOffReading {
    /// Force, below 0.
    pub force: f64,
    /// Error of the force by the grid, the change from the next coarser one or that of the samples across the zone that pulls, and by the distance
    /// of the states of the path; `None` where the coarser grid has no pull-off, or there is none.
    pub error: Option<f64>,
    /// Penetration, a length.
    pub penetration: f64,
    /// Area of the samples that touch, a length squared.
    pub contact_area: f64,
    /// Whether the surfaces jump apart there, while the force still falls.
    pub jumps: bool,
}

impl AdhesionReading {
    /// Reading of a step; `None` without adhesion.
    pub fn of(step: &AdhesiveStep) -> Option<Self> {
        let problem = step.contact.problem();
        let adhesion = problem.adhesion()?;
        let numbers = &step.numbers;
        let error = |of: fn(&AdhesiveNumbers) -> f64| {
            let coarse = step.coarser.as_ref()?;
            Some((of(numbers) - of(coarse)).abs().max(zone_law(step.samples) * of(numbers).abs()))
        };
        let [work, missing] = step.work;
        Some(Self {
            contact_load: numbers.contact_load,
            contact_load_error: error(|numbers| numbers.contact_load),
            adhesive_load: numbers.adhesive_load,
            adhesive_load_error: error(|numbers| numbers.adhesive_load),
            cohesive_area: numbers.cohesive_area,
            cohesive_area_error: error(|numbers| numbers.cohesive_area),
            stability: step.stability,
            grip: match step.contact.load {
                Load::Grip { position, .. } => Some(position),
                _ => None,
            },
            tabor: of_apex(problem, adhesion, Adhesion::tabor),
            maugis: of_apex(problem, adhesion, Adhesion::maugis),
            samples: step.samples,
            work,
            work_error: Some(missing),
            jumps: step.jumps.iter().map(JumpReading::of).collect(),
            pull_off: step.pull_off.map(|pull_off| PullOffReading::of(&pull_off, step)),
        })
    }
}

impl JumpReading {
    fn of(jump: &Jump) -> Self {
        let Jump { is_in, penetration, force, contact_area, loss } = *jump;
        Self { kind: if is_in { JumpKind::In } else { JumpKind::Out }, penetration, force, contact_area, loss }
    }
}

impl PullOffReading {
    fn of(pull_off: &PullOff, step: &AdhesiveStep) -> Self {
        let PullOff { force, error, penetration, contact_area, jumps } = *pull_off;
        let change = step.coarser_pull_off.map(|coarser| (coarser.force - force).abs());
        let error = change.map(|change| error + change.max(zone_law(step.samples) * force.abs()));
        Self { force, error, penetration, contact_area, jumps }
    }
}

/// A parameter of adhesion at the apex of the first level; `None` where that has no radius.
pub fn of_apex(problem: &Problem, adhesion: &Adhesion, of: fn(&Adhesion, f64, f64) -> f64) -> Option<f64> {
    let radius = match problem.topography() {
        Some(topography) => topography.ball(),
        None => problem.levels().first().and_then(|level| level.shape().apex_radius()),
    };
    Some(of(adhesion, radius?, problem.bodies().contact_modulus()))
}

/// The least force of a path, from the readings of its steps; `None` where none has been passed.
pub fn pull_off<'a>(steps: impl DoubleEndedIterator<Item = &'a AdhesionReading>) -> Option<PullOffReading> {
    steps.rev().find_map(|step| step.pull_off)
}

/// Work of the force on a path that comes back to a state, [force, penetration], in which it has been before, from there on: what its jumps
/// lose. `None` of other paths, and where surfaces have come apart under a load, whose work then is not known.
pub fn loss<'a>(steps: impl Iterator<Item = ([f64; 2], &'a AdhesionReading)>) -> Option<Measured> {
    let all: Vec<([f64; 2], &AdhesionReading)> = steps.collect();
    let ([force, penetration], _) = all.last()?;
    let largest = |index: usize| all.iter().map(|(state, _)| state[index].abs()).fold(f64::MIN_POSITIVE, f64::max);
    let [most_force, most_penetration] = [largest(0), largest(1)];
    let is_same = |state: &[f64; 2]| {
        (state[0] - force).abs() <= SAME * most_force && (state[1] - penetration).abs() <= SAME * most_penetration
    };
    let first = all[..all.len() - 1].iter().position(|(state, _)| is_same(state))?;
    let round = &all[first + 1..];
    let is_held = round.iter().flat_map(|(_, step)| &step.jumps).all(|jump| jump.loss.is_some());
    // Without a way there is nothing to lose.
    let moves = round.iter().any(|(state, _)| !is_same(state));
    if !is_held || !moves {
        return None;
    }
    let work = round.iter().map(|(_, step)| step.work).sum();
    let error = round.iter().map(|(_, step)| step.work_error).sum();
    Some(Measured::new(work, error))
}
