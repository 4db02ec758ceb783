//! What is found: where each criterion is reached, and how sure that is.

use crate::friction::Friction;
use crate::numeric::number::number;
use crate::numeric::search::largest;
use crate::reading::Criterion;
use crate::run::places::SECTION;
use crate::run::{End, Run, StepRecord};
use crate::spectral::Step;
use crate::stress::{Line, Section, StressField};
use std::f64::consts::PI;
use std::fmt;

/// Half the length of the [section](Limits::section) and its depth, in radii of a contact.
const REACH: f64 = 3.0;
const DEPTH: f64 = 2.0;
/// Its depth at most, in the same unit, when it shall show all layers.
const DEEPEST: f64 = 8.0;

/// Where a criterion is reached.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum At {
    /// Residual stress alone reaches it, everywhere in its material.
    Rest,
    /// Under a tip, whose stress is infinite however small the load.
    Tip {
        /// x, y, z of the tip; lengths.
        position: [f64; 3],
    },
    /// At this mean pressure.
    Load {
        /// p̄.
        mean_pressure: f64,
        /// Its estimated error by the grid, a pressure: that of the utilisation over its slope.
        error: Option<f64>,
        /// x, y, z of the place that fails; lengths.
        position: [f64; 3],
    },
    /// So small a load that contact is a few samples wide reaches it already: at less than this mean pressure.
    Below {
        /// p̄.
        mean_pressure: f64,
        /// x, y, z of the place that fails under it; lengths.
        position: [f64; 3],
    },
    /// Not up to complete contact, or the largest load that was solved.
    Never {
        /// Up to this mean pressure,
        up_to: f64,
        /// where the utilisation is.
        utilisation: f64,
    },
}

/// The limit load of a criterion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limit {
    /// Which.
    pub criterion: Criterion,
    /// Where it is reached.
    pub at: At,
}

/// All limit loads.
#[derive(Debug, Clone)]
pub struct Limits {
    /// One of each criterion: yield and cracking from the surface down, then the interfaces.
    pub limits: Vec<Limit>,
    /// Every load that was solved on the last grid, by ascending mean pressure.
    pub steps: Vec<StepRecord>,
    /// The step at the first limit load that is above 0, with its fields; `None` where there is none.
    pub last: Option<Step>,
    /// Mean pressure at which contact becomes complete on the last grid.
    pub complete: f64,
    /// Largest relative change of the limits against the next coarser grid, where an accuracy was asked for.
    pub change: Option<f64>,
    /// Why the refinement ended, where there was one.
    pub end: Option<End>,
    /// What a reader should know before trusting the numbers.
    pub warnings: Vec<String>,
}

impl Limit {
    /// The mean pressure up to which it holds; infinite where it is never reached.
    pub fn mean_pressure(&self) -> f64 {
        match self.at {
            At::Rest | At::Tip { .. } => 0.0,
            At::Load { mean_pressure, .. } | At::Below { mean_pressure, .. } => mean_pressure,
            At::Never { .. } => f64::INFINITY,
        }
    }

    /// Where it fails, x, y, z; `None` where it does not, or everywhere.
    pub fn position(&self) -> Option<[f64; 3]> {
        match self.at {
            At::Tip { position } | At::Load { position, .. } | At::Below { position, .. } => Some(position),
            At::Rest | At::Never { .. } => None,
        }
    }

    /// Relative change from the same criterion's limit on a coarser grid; `None` where neither is found at a load.
    fn change_from(&self, coarse: &Self) -> Option<f64> {
        let found = |limit: &Self| matches!(limit.at, At::Load { .. });
        let (fine, rough) = (self.mean_pressure(), coarse.mean_pressure());
        match (found(self), found(coarse)) {
            (true, true) => Some((fine / rough - 1.0).abs()),
            // A bound that falls with the spacing, or a root that appears, is no number yet.
            (true, false) | (false, true) => Some(f64::INFINITY),
            (false, false) => None,
        }
    }
}

impl Limits {
    /// The limit that is reached first; `None` where nothing fails.
    pub fn first(&self) -> Option<&Limit> {
        let reached = self.limits.iter().filter(|limit| limit.mean_pressure().is_finite());
        reached.min_by(|a, b| a.mean_pressure().total_cmp(&b.mean_pressure()))
    }

    /// Largest relative change of the limits from those of a coarser grid; 0 where none is found at a load.
    pub(super) fn change_from(&self, coarse: &Self) -> f64 {
        let pairs = self.limits.iter().zip(&coarse.limits);
        largest(pairs.filter_map(|(fine, coarse)| fine.change_from(coarse))).max(0.0)
    }

    /// Whether all loads were solved, and the accuracy, if one was asked for, is reached.
    pub fn converged(&self) -> bool {
        self.end.is_none_or(|end| end == End::Reached) && self.steps.iter().all(StepRecord::converged)
    }

    /// The stresses under the place that fails first, at its limit: a cut along the sliding (else along x), a contact's
    /// width to both sides and deep enough for it; `None` where nothing fails under a load.
    pub fn section(&self, run: &Run) -> Option<Section> {
        let step = self.last.as_ref()?;
        let [x, y, z] = self.limits.iter().filter(|limit| limit.mean_pressure() > 0.0).min_by(earlier)?.position()?;
        let (half_space, cell) = (run.problem.half_space(), run.problem.cell());
        let direction = run.problem.friction().map_or([1.0, 0.0], Friction::direction);
        let reading = step.reading();
        let radius = (reading.contact_fraction * cell.area() / (PI * reading.contact_spots.max(1) as f64)).sqrt();
        let reach = (REACH * radius).min(0.5 * cell.reduced().longer_side());
        let coating = half_space.interface_depths().last().copied().unwrap_or(0.0);
        let [rows, points] = SECTION;
        let line = Line { origin: [x, y], direction, span: [-reach, reach], points };
        let depth = (DEPTH * radius).max(1.5 * z).max(1.25 * coating.min(DEEPEST * radius));
        let mean = run.stress.as_ref().map(|request| request.mean).unwrap_or_default();
        Some(StressField::new(step.finest(), mean).section(&line, &half_space.rows(depth, rows)))
    }
}

/// What fails first, in words.
impl fmt::Display for Limits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(Limit { criterion, at }) = self.first() else {
            let most = self.steps.last().map_or(0.0, |step| step.reading.mean_pressure);
            let complete = if most >= self.complete { ", where contact is complete" } else { "" };
            return write!(f, "nothing fails up to the mean pressure {}{complete}", number(most));
        };
        write!(f, "first: {criterion}")?;
        match *at {
            At::Rest => f.write_str(", without load, by residual stress alone"),
            At::Tip { .. } => f.write_str(", under a tip however small the load"),
            At::Below { mean_pressure, .. } => write!(f, ", at less than the mean pressure {}", number(mean_pressure)),
            At::Load { mean_pressure, .. } | At::Never { up_to: mean_pressure, .. } => {
                write!(f, " at the mean pressure {}", number(mean_pressure))
            }
        }
    }
}

/// Which limit comes first.
fn earlier(a: &&Limit, b: &&Limit) -> std::cmp::Ordering {
    a.mean_pressure().total_cmp(&b.mean_pressure())
}
