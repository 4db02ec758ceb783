//! The limit loads that were found, with their intervals and their order.

use crate::load::LoadQuantity;
use crate::notation::WIDE;
use crate::numeric::search::largest;
use crate::problem::Problem;
use crate::reading::Criterion;
use crate::run::warnings;
use crate::run::words::Numbered;
use crate::run::{RefinementEnd, StepRecord};
use crate::spectral::Step;
use std::cmp::Ordering;

/// Reason for which a search of limits ends at its largest load.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SearchEnd {
    /// Contact is complete there.
    CompleteContact,
    /// The load is [`SearchEnd::OF_HARDNESS`] of the most that the hardness bears.
    Hardness,
    /// The load is the largest that was solved: under a higher one contact reaches the border of the largest window, the search has used up
    /// its doublings, or the caller has prescribed this load as the largest.
    LargestLoad,
}

/// How a limit is reached, or its bound.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum At {
    /// Reached by residual stress alone, everywhere in the material.
    Rest,
    /// Reached under a tip of the highest level, whose stress is infinite however small the load.
    Tip {
        /// x, y, z of the tip; lengths.
        position: [f64; 3],
    },
    /// Reached at a load.
    Load {
        /// The load, in the quantity of the limit.
        load: f64,
        /// Estimated error of the load by the grid: the distance to the farther end of the interval; `None` where
        /// a utilisation jumps, or the interval has no end.
        error: Option<f64>,
        /// The least loads at which u + e and u − e reach 1, u the utilisation and e its error: 0 where u + e does at
        /// the least load that was solved, infinite where u − e never does.
        interval: [f64; 2],
        /// x, y, z of the place that fails; lengths.
        position: [f64; 3],
    },
    /// Below a load: by the error of the utilisation the criterion may be reached under the least load that was solved, whose
    /// contact is a few samples wide.
    Below {
        /// The least load at which u − e ≥ 1.
        load: f64,
        /// Utilisation u at this load.
        utilisation: f64,
        /// x, y, z of the place that fails at this load; lengths.
        position: [f64; 3],
    },
    /// Not reached up to the largest load that was solved.
    Never {
        /// Load up to which the criterion holds.
        up_to: f64,
        /// Reason for which the search ends there.
        end: SearchEnd,
        /// The largest utilisation, to a hundredth where it is more than a half and has its top between the loads.
        utilisation: f64,
        /// Estimated error of the largest utilisation.
        error: Option<f64>,
        /// Load of the largest utilisation.
        at: f64,
    },
    /// Undecided: the utilisation stays below 1, or cannot be distinguished from 1 at any load, and the
    /// utilisation plus its error reaches 1.
    Undecided {
        /// The least load at which u + e may reach 1; 0 where it does at the least load that was solved.
        from: f64,
        /// The largest load that was solved.
        up_to: f64,
        /// The largest utilisation u.
        utilisation: f64,
        /// Estimated error e of the largest utilisation.
        error: Option<f64>,
        /// Load of the largest utilisation.
        at: f64,
        /// x, y, z of the place of the largest utilisation; lengths.
        position: [f64; 3],
    },
}

/// The limit load of a criterion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limit {
    /// The criterion.
    pub criterion: Criterion,
    /// The quantity of its loads: pressures in the unit of Young's modulus, or forces, pressures times areas.
    pub quantity: LoadQuantity,
    /// How the limit is reached, or its bound.
    pub at: At,
}

/// All limit loads.
#[derive(Debug, Clone)]
pub struct Limits {
    /// The limit of each criterion: yield and cracking from the surface down, then the interfaces.
    pub limits: Vec<Limit>,
    /// All loads that were solved on the last grid, by ascending load.
    pub steps: Vec<StepRecord>,
    /// The first limits that are reached above the load 0, four at most, with the step at each, its record and its fields.
    pub shown: Vec<LimitStep>,
    /// The quantity of all loads.
    pub quantity: LoadQuantity,
    /// Load at which contact becomes complete on the last grid, with hardness at the latest; infinite for an isolated contact, and where
    /// it is not below [`hardness_load`](Self::hardness_load).
    pub complete: f64,
    /// Load that is [`SearchEnd::OF_HARDNESS`] of the most that the hardness bears: of the mean pressure of the hardness everywhere, or of
    /// that under which the highest value of a given pressure is the hardness. No higher one is solved. Infinite without hardness and
    /// for an isolated contact.
    pub hardness_load: f64,
    /// Sides of the largest window in which loads were solved, lengths; `None` where the window of the problem was enough.
    pub window: Option<[f64; 2]>,
    /// Whether the search ended because an isolated contact had no room under higher loads.
    pub ends_at_border: bool,
    /// Largest relative change of the limits against the next coarser grid, where an accuracy was prescribed.
    pub change: Option<f64>,
    /// Reason of the end of the refinement; `None` without one.
    pub end: Option<RefinementEnd>,
    /// Warnings about the results.
    pub warnings: Vec<String>,
}

/// The step at a limit above the load 0.
#[derive(Debug, Clone)]
pub struct LimitStep {
    /// The limit, with the place that fails.
    pub limit: Limit,
    /// Scalars of the step.
    pub record: StepRecord,
    /// The step with its fields.
    pub step: Step,
}

impl Limit {
    /// Load up to which the criterion holds, in its [quantity](Self::quantity); infinite where it is never reached, or undecided.
    pub fn load(&self) -> f64 {
        match self.at {
            At::Rest | At::Tip { .. } => 0.0,
            At::Load { load, .. } | At::Below { load, .. } => load,
            At::Never { .. } | At::Undecided { .. } => f64::INFINITY,
        }
    }

    /// Loads between which the criterion is reached, by its error; infinite where it is never reached.
    pub fn interval(&self) -> [f64; 2] {
        match self.at {
            At::Rest | At::Tip { .. } => [0.0; 2],
            At::Load { interval, .. } => interval,
            At::Below { load, .. } => [0.0, load],
            At::Undecided { from, .. } => [from, f64::INFINITY],
            At::Never { .. } => [f64::INFINITY; 2],
        }
    }

    /// Whether the interval has two ends, at most three tenths of the load away, so that the error alone describes it.
    pub fn is_sharp(&self) -> bool {
        let [from, to] = self.interval();
        from > 0.0 && to.is_finite() && self.spread().is_some_and(|part| part <= WIDE)
    }

    /// Distance to the farther end of the interval over the load; `None` of a criterion that is not reached at a load.
    pub(super) fn spread(&self) -> Option<f64> {
        let At::Load { load, interval: [from, to], .. } = self.at else { return None };
        Some((load - from).max(to - load) / load)
    }

    /// Place x, y, z (lengths) that fails, or may fail; `None` where none does, or all of a material.
    pub fn position(&self) -> Option<[f64; 3]> {
        match self.at {
            At::Tip { position }
            | At::Load { position, .. }
            | At::Below { position, .. }
            | At::Undecided { position, .. } => Some(position),
            At::Rest | At::Never { .. } => None,
        }
    }

    /// The limit with another place that fails.
    pub(super) fn moved_to(self, place: [f64; 3]) -> Self {
        let mut moved = self;
        if let At::Load { position, .. } | At::Below { position, .. } = &mut moved.at {
            *position = place;
        }
        moved
    }

    /// Relative change of the load from the same criterion's limit on a coarser grid; 0 of a criterion that is reached on neither,
    /// since the utilisation in complete contact depends on the grid on which contact becomes complete.
    fn change_from(&self, coarse: &Self) -> f64 {
        match (self.at, coarse.at) {
            (At::Rest, At::Rest) | (At::Tip { .. }, At::Tip { .. }) | (At::Never { .. }, At::Never { .. }) => 0.0,
            (At::Load { load: fine, .. }, At::Load { load: coarse, .. }) => (fine - coarse).abs() / fine,
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

    /// Order of failure: the least load first; of two bounds the larger utilisation; undecided limits before those that
    /// are never reached.
    fn order(&self, other: &Self) -> Ordering {
        let excess = |limit: &Self| if let At::Below { utilisation, .. } = limit.at { -utilisation } else { 0.0 };
        let loads = self.load().total_cmp(&other.load());
        let starts = self.interval()[0].total_cmp(&other.interval()[0]);
        let starts = if self.load().is_infinite() { starts } else { Ordering::Equal };
        loads.then(excess(self).total_cmp(&excess(other))).then(starts)
    }
}

/// All of some limits, the first one first, and those that are never reached last.
fn ordered(limits: &[Limit]) -> Vec<&Limit> {
    let mut ordered: Vec<&Limit> = limits.iter().collect();
    ordered.sort_by(|a, b| a.order(b));
    ordered
}

/// The one of some limits that is reached first; `None` where nothing fails.
pub fn first(limits: &[Limit]) -> Option<&Limit> {
    ordered(limits).into_iter().next().filter(|limit| limit.load().is_finite())
}

fn contenders(limits: &[Limit]) -> Vec<&Limit> {
    let ordered = ordered(limits);
    let sure = ordered.iter().map(|limit| limit.interval()[1]).fold(f64::INFINITY, f64::min);
    let first = first(limits).map(|first| first.criterion);
    let others = ordered.into_iter().filter(|limit| Some(limit.criterion) != first);
    others.filter(|limit| limit.interval()[0] < sure).collect()
}

/// The criteria that may be reached before the [first] one of some limits by the errors of both.
pub fn rivals(limits: &[Limit]) -> Vec<Criterion> {
    contenders(limits).iter().map(|limit| limit.criterion).collect()
}

impl SearchEnd {
    /// Part of the most that the hardness bears up to which loads are solved.
    pub const OF_HARDNESS: f64 = 0.999;

    /// The end at a largest load that is read off a step, to rounding; contact becomes complete at `complete`, and the hardness ends the
    /// search at `hardness_load`.
    pub(super) fn of(load: f64, complete: f64, hardness_load: f64) -> Self {
        let reaches = |end: f64| load >= end * (1.0 - 1e-9);
        match (reaches(complete), reaches(hardness_load)) {
            (true, _) => Self::CompleteContact,
            (false, true) => Self::Hardness,
            (false, false) => Self::LargestLoad,
        }
    }

    /// Words for the reason, which follow the largest load.
    pub(super) fn in_words(self) -> String {
        match self {
            Self::CompleteContact => ", where contact is complete".to_owned(),
            Self::Hardness => {
                format!(", {} of the most that the hardness lets the surface bear", Self::OF_HARDNESS)
            }
            Self::LargestLoad => String::new(),
        }
    }
}

impl Limits {
    /// The limit that is reached first; `None` where nothing fails.
    pub fn first(&self) -> Option<&Limit> {
        first(&self.limits)
    }

    /// Limits that may be reached before the [first](Self::first) one by the errors of both, in the order of all; everything
    /// undecided where none is reached.
    pub fn contenders(&self) -> Vec<&Limit> {
        contenders(&self.limits)
    }

    /// Criteria of the [contenders](Self::contenders).
    pub fn rivals(&self) -> Vec<Criterion> {
        rivals(&self.limits)
    }

    /// All limits, the first one first, and those that are never reached last.
    pub fn ordered(&self) -> Vec<&Limit> {
        ordered(&self.limits)
    }

    /// Largest relative change of the limits from those of a coarser grid.
    pub(super) fn change_from(&self, coarse: &Self) -> f64 {
        let pairs = self.limits.iter().zip(&coarse.limits);
        largest(pairs.map(|(fine, coarse)| fine.change_from(coarse)))
    }

    /// Warnings about the limits, steps numbered by ascending load.
    pub(super) fn doubts(&self, problem: &Problem) -> Vec<String> {
        let all: Vec<Numbered> = (1..).zip(&self.steps).collect();
        let is_limit = |(_, step): &Numbered| {
            let from = |limit: &Limit, step: &StepRecord| (step.reading.load(self.quantity) - limit.load()).abs();
            let nearest = |limit: &Limit| self.steps.iter().all(|other| from(limit, step) <= from(limit, other));
            self.limits.iter().any(|limit| match limit.at {
                At::Load { .. } | At::Below { .. } => nearest(limit),
                At::Never { at, .. } | At::Undecided { at, .. } => step.reading.load(self.quantity) == at,
                At::Rest | At::Tip { .. } => false,
            })
        };
        let judged: Vec<Numbered> = all.iter().copied().filter(is_limit).collect();
        let is_open = |limit: &Limit| matches!(limit.at, At::Never { .. } | At::Undecided { .. });
        let room = self.limits.iter().any(is_open) && self.ends_at_border;
        let room = room.then(|| {
            "the search ends where contact has no room in its window any more: enlarge lattice.size to look further"
                .to_owned()
        });
        let warnings = warnings::of_judged(problem, &all, &judged, self.end, self.change);
        warnings.into_iter().chain(room).collect()
    }

    /// Whether all loads were solved, and the accuracy, if one was prescribed, is reached.
    pub fn converged(&self) -> bool {
        self.end.is_none_or(|end| end == RefinementEnd::Reached) && self.steps.iter().all(StepRecord::converged)
    }
}
