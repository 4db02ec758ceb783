//! Why a contact is not followed in time.

use crate::lattice::{LatticeError, Surroundings};
use crate::load::Load;
use crate::problem::Problem;

/// Why a contact is not followed in time.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CreepError {
    /// Elastic bodies, in which nothing depends on time.
    #[error("nothing depends on time here: no material of the bodies relaxes")]
    Elastic,
    /// An isolated contact.
    #[error(
        "bodies creep in a periodic cell here, not in the window of an isolated contact: take a cell that is wide beside the contact"
    )]
    Isolated,
    /// A surface has a hardness.
    #[error(
        "`hardness` of bodies that creep is not followed: the depth pressed in for good would depend on the time under load"
    )]
    Hardness,
    /// The surfaces adhere.
    #[error(
        "adhesion of bodies that creep is not followed: the work of adhesion would depend on the speed of separation"
    )]
    Adhesion,
    /// Surfaces with friction.
    #[error("bodies creep without friction here: what a traction displaces is not followed in time")]
    Friction,
    /// A steady motion.
    #[error("a load either moves steadily or changes in time")]
    Motion,
    /// Stresses, or strengths and laws of fatigue that are judged by them.
    #[error(
        "stresses of bodies that creep are not computed here, nor what is judged by them: strengths, fatigue and lives by strain"
    )]
    Stresses,
    /// A time that is not finite, or before the last one.
    #[error("times must be finite and must not decrease: {time} comes after {before}")]
    Time {
        /// The time.
        time: f64,
        /// The time before.
        before: f64,
    },
    /// Numbers of times and loads that differ.
    #[error("a path in time has as many times as loads, not {times} beside {loads}")]
    Lengths {
        /// Number of times.
        times: usize,
        /// Number of loads.
        loads: usize,
    },
    /// Loads of more than one kind, or of one that is not followed in time.
    #[error(
        "a path in time has loads of one kind: mean pressures, forces, or penetrations; under a given pressure no penetrations"
    )]
    Loads,
    /// A tolerance that is not above 0.
    #[error("the tolerance of a step in time must be greater than 0, not {0}")]
    Tolerance(f64),
    /// The grid is refused.
    #[error(transparent)]
    Grid(#[from] LatticeError),
}

impl CreepError {
    /// Why the bodies of a problem are not followed in time.
    ///
    /// # Errors
    /// [`CreepError`].
    pub fn of_problem(problem: &Problem) -> Result<(), Self> {
        match () {
            () if !problem.bodies().relax() => Err(Self::Elastic),
            () if problem.cell().surroundings() == Surroundings::FreeSpace => Err(Self::Isolated),
            () if problem.largest_hardness().is_some() => Err(Self::Hardness),
            () if problem.adhesion().is_some() => Err(Self::Adhesion),
            () if problem.friction().is_some() => Err(Self::Friction),
            () if problem.motion().is_some() => Err(Self::Motion),
            () => Ok(()),
        }
    }

    /// Why a path of times and loads is not followed.
    ///
    /// # Errors
    /// [`CreepError::Lengths`], [`CreepError::Time`], [`CreepError::Loads`].
    pub fn of_path(problem: &Problem, times: &[f64], loads: &[Load]) -> Result<(), Self> {
        if times.len() != loads.len() {
            return Err(Self::Lengths { times: times.len(), loads: loads.len() });
        }
        let mut before = f64::NEG_INFINITY;
        for &time in times {
            if !time.is_finite() || time < before {
                return Err(Self::Time { time, before });
            }
            before = time;
        }
        let is_one = loads.windows(2).all(|pair| pair[1] == pair[0].with_value(pair[1].value()));
        let is_followed = |load: &Load| match load {
            Load::MeanPressure(_) | Load::Force(_) => true,
            Load::Penetration(_) => !problem.kind().is_given,
            Load::Grip { .. } => false,
        };
        if is_one && loads.iter().all(is_followed) { Ok(()) } else { Err(Self::Loads) }
    }
}
