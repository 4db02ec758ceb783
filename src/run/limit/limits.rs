//! What is found: where each criterion is reached, and how sure that is.

use crate::friction::Friction;
use crate::notation::number;
use crate::numeric::search::largest;
use crate::problem::Problem;
use crate::reading::{Criterion, within_the_errors};
use crate::run::places::SECTION;
use crate::run::warnings::{self, Numbered};
use crate::run::{End, Run, StepRecord};
use crate::spectral::Step;
use crate::stress::{Line, Section, StressField};
use std::cmp::Ordering;
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
    /// Under a tip of the highest level, whose stress is infinite however small the load.
    Tip {
        /// x, y, z of the tip; lengths.
        position: [f64; 3],
    },
    /// At this mean pressure.
    Load {
        /// p̄.
        mean_pressure: f64,
        /// Its estimated error by the grid, a pressure: the distance to the farther end of the interval; `None` where a
        /// utilisation jumps, or the interval has no end.
        error: Option<f64>,
        /// The least mean pressures at which u + e and u − e reach 1, u the utilisation and e its error: 0 where u + e does at
        /// the least load that was solved, infinite where u − e never does.
        interval: [f64; 2],
        /// x, y, z of the place that fails; lengths.
        position: [f64; 3],
    },
    /// At less than this mean pressure, at which it is reached: by its error it may be so at the least load that was solved,
    /// whose contact is a few samples wide.
    Below {
        /// p̄, the least at which u − e ≥ 1.
        mean_pressure: f64,
        /// Utilisation u there.
        utilisation: f64,
        /// x, y, z of the place that fails under it; lengths.
        position: [f64; 3],
    },
    /// Not up to complete contact, or the largest load that was solved.
    Never {
        /// Up to this mean pressure.
        up_to: f64,
        /// The largest utilisation, to a hundredth where it is more than a half and has its top between the loads.
        utilisation: f64,
        /// Estimated error of the largest utilisation.
        error: Option<f64>,
        /// Mean pressure of the largest utilisation.
        at: f64,
    },
    /// Whether it is reached is undecided: the utilisation stays below 1, or cannot be told from 1 at any load, and the
    /// utilisation plus its error reaches 1.
    Undecided {
        /// The least mean pressure at which u + e may reach 1; 0 where it does at the least load that was solved.
        from: f64,
        /// The largest mean pressure that was solved.
        up_to: f64,
        /// The largest utilisation u.
        utilisation: f64,
        /// Its estimated error e.
        error: Option<f64>,
        /// Mean pressure of the largest utilisation.
        at: f64,
        /// x, y, z of the place of the largest utilisation; lengths.
        position: [f64; 3],
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
    /// The first limit that is reached above the load 0, and the step there, with its record and its fields; `None` where
    /// there is none.
    pub shown: Option<Shown>,
    /// Mean pressure at which contact becomes complete on the last grid.
    pub complete: f64,
    /// Largest relative change of the limits against the next coarser grid, where an accuracy was asked for.
    pub change: Option<f64>,
    /// Why the refinement ended, where there was one.
    pub end: Option<End>,
    /// What a reader should know before trusting the numbers.
    pub warnings: Vec<String>,
}

/// The first limit above the load 0, and what was solved there.
#[derive(Debug, Clone)]
pub struct Shown {
    /// What fails, and where.
    pub limit: Limit,
    /// Every scalar of the step.
    pub record: StepRecord,
    /// The step.
    pub step: Step,
}

impl Limit {
    /// The mean pressure up to which it holds; infinite where it is never reached, or undecided.
    pub fn mean_pressure(&self) -> f64 {
        match self.at {
            At::Rest | At::Tip { .. } => 0.0,
            At::Load { mean_pressure, .. } | At::Below { mean_pressure, .. } => mean_pressure,
            At::Never { .. } | At::Undecided { .. } => f64::INFINITY,
        }
    }

    /// The mean pressures between which it is reached, by its error; infinite where it is never reached.
    pub fn interval(&self) -> [f64; 2] {
        match self.at {
            At::Rest | At::Tip { .. } => [0.0; 2],
            At::Load { interval, .. } => interval,
            At::Below { mean_pressure, .. } => [0.0, mean_pressure],
            At::Undecided { from, .. } => [from, f64::INFINITY],
            At::Never { .. } => [f64::INFINITY; 2],
        }
    }

    /// Whether its interval has two ends, at most three tenths of the load away, so that the error alone says how sure it is.
    pub fn is_sharp(&self) -> bool {
        let [from, to] = self.interval();
        from > 0.0 && to.is_finite() && self.spread().is_some_and(|part| part <= WIDE)
    }

    /// Distance to the farther end of the interval over the load; `None` of what is not reached at a load.
    fn spread(&self) -> Option<f64> {
        let At::Load { mean_pressure, interval: [from, to], .. } = self.at else { return None };
        Some((mean_pressure - from).max(to - mean_pressure) / mean_pressure)
    }

    /// Where it fails, or may fail, x, y, z; `None` where it does not, or everywhere.
    pub fn position(&self) -> Option<[f64; 3]> {
        match self.at {
            At::Tip { position }
            | At::Load { position, .. }
            | At::Below { position, .. }
            | At::Undecided { position, .. } => Some(position),
            At::Rest | At::Never { .. } => None,
        }
    }

    /// The same one, which fails at another place.
    pub(super) fn moved_to(self, place: [f64; 3]) -> Self {
        let mut moved = self;
        if let At::Load { position, .. } | At::Below { position, .. } = &mut moved.at {
            *position = place;
        }
        moved
    }

    /// Relative change of the load from the same criterion's limit on a coarser grid. What is reached on neither has none:
    /// how near it comes in complete contact depends on how fine the grid is, which is where that ends.
    fn change_from(&self, coarse: &Self) -> f64 {
        match (self.at, coarse.at) {
            (At::Rest, At::Rest) | (At::Tip { .. }, At::Tip { .. }) | (At::Never { .. }, At::Never { .. }) => 0.0,
            (At::Load { mean_pressure: fine, .. }, At::Load { mean_pressure: coarse, .. }) => {
                (fine - coarse).abs() / fine
            }
            (At::Undecided { from: fine, .. }, At::Undecided { from: coarse, .. }) => {
                if fine == coarse {
                    0.0
                } else {
                    (fine - coarse).abs() / fine.max(coarse)
                }
            }
            // A bound that falls with the spacing, or a root that appears, is no number yet.
            _ => f64::INFINITY,
        }
    }

    /// Order of failure: the least mean pressure first; of two bounds the larger utilisation; undecided limits before those that
    /// are never reached.
    fn order(&self, other: &Self) -> Ordering {
        let excess = |limit: &Self| if let At::Below { utilisation, .. } = limit.at { -utilisation } else { 0.0 };
        let loads = self.mean_pressure().total_cmp(&other.mean_pressure());
        let starts = self.interval()[0].total_cmp(&other.interval()[0]);
        let starts = if self.mean_pressure().is_infinite() { starts } else { Ordering::Equal };
        loads.then(excess(self).total_cmp(&excess(other))).then(starts)
    }
}

impl Limits {
    /// The limit that is reached first; `None` where nothing fails.
    pub fn first(&self) -> Option<&Limit> {
        self.ordered().into_iter().next().filter(|limit| limit.mean_pressure().is_finite())
    }

    /// What may be reached before the [first](Self::first) one by the errors of both, in the order of all; everything undecided
    /// where none is reached.
    pub fn contenders(&self) -> Vec<&Limit> {
        let ordered = self.ordered();
        let sure = ordered.iter().map(|limit| limit.interval()[1]).fold(f64::INFINITY, f64::min);
        let first = self.first().map(|first| first.criterion);
        let others = ordered.into_iter().filter(|limit| Some(limit.criterion) != first);
        others.filter(|limit| limit.interval()[0] < sure).collect()
    }

    /// Names of the [contenders](Self::contenders).
    pub fn rivals(&self) -> Vec<String> {
        self.contenders().iter().map(|limit| limit.criterion.to_string()).collect()
    }

    /// All of them, what comes first first, and what is never reached last.
    pub fn ordered(&self) -> Vec<&Limit> {
        let mut ordered: Vec<&Limit> = self.limits.iter().collect();
        ordered.sort_by(|a, b| a.order(b));
        ordered
    }

    /// Whether contact is complete under a mean pressure, which is read off a step to rounding.
    pub fn is_complete(&self, mean_pressure: f64) -> bool {
        mean_pressure >= self.complete * (1.0 - 1e-9)
    }

    /// Largest relative change of the limits from those of a coarser grid.
    pub(super) fn change_from(&self, coarse: &Self) -> f64 {
        let pairs = self.limits.iter().zip(&coarse.limits);
        largest(pairs.map(|(fine, coarse)| fine.change_from(coarse)))
    }

    /// What is doubtful about them, steps numbered by ascending load.
    pub(super) fn doubts(&self, problem: &Problem) -> Vec<String> {
        let all: Vec<Numbered> = (1..).zip(&self.steps).collect();
        let is_limit = |(_, step): &Numbered| {
            let from = |limit: &Limit, step: &StepRecord| (step.reading.mean_pressure - limit.mean_pressure()).abs();
            let nearest = |limit: &Limit| self.steps.iter().all(|other| from(limit, step) <= from(limit, other));
            self.limits.iter().any(|limit| match limit.at {
                At::Load { .. } | At::Below { .. } => nearest(limit),
                At::Never { at, .. } | At::Undecided { at, .. } => step.reading.mean_pressure == at,
                At::Rest | At::Tip { .. } => false,
            })
        };
        let judged: Vec<Numbered> = all.iter().copied().filter(is_limit).collect();
        warnings::of_judged(problem, &all, &judged, self.end, self.change)
    }

    /// Whether all loads were solved, and the accuracy, if one was asked for, is reached.
    pub fn converged(&self) -> bool {
        self.end.is_none_or(|end| end == End::Reached) && self.steps.iter().all(StepRecord::converged)
    }

    /// The stresses under the place that fails first under a load, at its limit: a cut along the sliding (else along x), a
    /// contact's width to both sides and deep enough for it; `None` where nothing does.
    pub fn section(&self, run: &Run) -> Option<Section> {
        let Shown { limit, step, .. } = self.shown.as_ref()?;
        let [x, y, z] = limit.position()?;
        let (half_space, cell) = (run.problem.half_space(), run.problem.cell());
        let direction = run.problem.friction().map_or([1.0, 0.0], Friction::direction);
        let reading = step.reading();
        let radius = (reading.contact_fraction * cell.area() / (PI * reading.contact_spots.max(1) as f64)).sqrt();
        let reach = (REACH * radius).min(0.5 * cell.reduced().longer_side());
        let coating = half_space.interface_depths().last().copied().unwrap_or(0.0);
        let [rows, points] = SECTION;
        let line = Line { origin: [x, y], direction, span: [-reach, reach], points };
        let depth = (DEPTH * radius).max(1.5 * z).max(1.25 * coating.min(DEEPEST * radius));
        let mean = run.mean_stress().unwrap_or_default();
        Some(StressField::new(step.finest(), mean).section(&line, &half_space.rows(depth, rows)))
    }
}

impl Limits {
    /// What fails first, in words, with pressures as `told` has them.
    pub fn in_words(&self, told: impl Fn(f64) -> String) -> String {
        let others = self.rivals().join(" or ");
        let most = self.steps.last().map_or(0.0, |step| step.reading.mean_pressure);
        let complete = if self.is_complete(most) { ", where contact is complete" } else { "" };
        let Some(limit) = self.first() else {
            if others.is_empty() {
                return format!("nothing fails up to the mean pressure {}{complete}", told(most));
            }
            let from = self.contenders().iter().map(|limit| limit.interval()[0]).fold(f64::INFINITY, f64::min);
            let start = self.steps.first().map_or(0.0, |step| step.reading.mean_pressure);
            let from = if from > 0.0 { told(from) } else { format!("below {}", told(start)) };
            let to = told(most);
            return format!(
                "undecided: {others} may fail within its error at mean pressures from {from} to {to}{complete}"
            );
        };
        let at = match limit.at {
            At::Rest => ", without load, by residual stress alone".to_owned(),
            At::Tip { .. } => ", under a tip however small the load".to_owned(),
            At::Below { mean_pressure, .. } => format!(", at less than the mean pressure {}", told(mean_pressure)),
            At::Load { mean_pressure, interval: [from, to], .. } => {
                let part = limit.spread().unwrap_or(0.0);
                let error = match (from > 0.0, to.is_finite()) {
                    (true, true) if part <= TOLD => String::new(),
                    (true, true) if limit.is_sharp() => format!(" ± {:.0} %", 100.0 * part),
                    (true, true) => format!(", between {} and {} by its error", told(from), told(to)),
                    (true, false) => format!(", not before {} and by its error perhaps never", told(from)),
                    (false, true) => format!(", by its error anywhere below {}", told(to)),
                    (false, false) => ", by its error anywhere or never".to_owned(),
                };
                format!(" at the mean pressure {}{error}", told(mean_pressure))
            }
            At::Never { .. } | At::Undecided { .. } => String::new(),
        };
        format!("first: {}{at}{}", limit.criterion, within_the_errors(&self.rivals()))
    }
}

/// Relative errors above this are told beside what fails first.
const TOLD: f64 = 0.005;
/// Above this the ends of the interval are shown in place of the error.
const WIDE: f64 = 0.3;

/// What fails first, in words.
impl fmt::Display for Limits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.in_words(number))
    }
}
