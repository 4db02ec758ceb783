//! Report of a solution: its route, and the reason why the iteration ended.

use serde::{Deserialize, Serialize};
use std::fmt;

/// Reason why the iteration ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Stop {
    /// ε < tolerance, energy gap < 20 tolerance and penetration outside contact < 10 tolerance · δ.
    Converged,
    /// The tolerance is not reached, and no further iteration reduces the criteria: ε, energy gap and penetration outside contact are each
    /// below their multiple of the tolerance, or below eight times what rounding in double precision makes of them.
    #[serde(rename = "converged_to_rounding", alias = "converged to rounding")]
    Rounding,
    /// Over the last window of iterations the mean of what must fall below the tolerance was not below 0.9 of that over
    /// the window before, half as long; or the load is no finite number.
    Stalled,
    /// Tolerance not reached in as many iterations as allowed.
    #[serde(alias = "iteration limit")]
    IterationLimit,
    /// Nothing to solve: the load or the penetration is not above zero, or that of the first touch of what earlier loads have pressed in.
    #[serde(alias = "no contact")]
    NoContact,
    /// At the prescribed penetration at most four samples are in contact, a touching indenter (of a topography, in
    /// all): contact is no wider than the grid's spacing, and its load a matter of where the samples lie.
    Unresolved,
    /// The prescribed penetration is not below the mean of the initial gap f, where contact is complete: no finite load
    /// reaches it.
    #[serde(alias = "beyond full contact")]
    BeyondFullContact,
    /// The prescribed mean pressure is not below the hardness of the surface, which no pressure exceeds; or at the prescribed penetration
    /// all of the surface is at it, as at any greater one: nothing is left that is elastic.
    BeyondHardness,
    /// Surfaces that adhere have come apart under a tensile force, which nothing bears.
    Detached,
    /// A wave of the surface gives back more work than it takes: no steady state is unique, and none is sought.
    NotUnique,
    /// Contact reaches the border of the window of an isolated contact, beyond which it would go on.
    AtBorder,
    /// The progress callback has ended the step.
    Interrupted,
    /// A number of the result is not finite.
    #[serde(alias = "not a number")]
    NotANumber,
}

impl Stop {
    /// Whether the returned pressure solves the problem, to the tolerance or as far as double precision carries.
    pub fn solved(self) -> bool {
        matches!(self, Self::Converged | Self::Rounding | Self::NoContact | Self::Detached)
    }
}

impl fmt::Display for Stop {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Converged => "converged",
            Self::Rounding => "converged to rounding",
            Self::Stalled => "stalled",
            Self::IterationLimit => "iteration limit",
            Self::NoContact => "no contact",
            Self::Unresolved => "unresolved",
            Self::BeyondFullContact => "beyond full contact",
            Self::BeyondHardness => "beyond the hardness",
            Self::Detached => "detached",
            Self::NotUnique => "no unique steady state",
            Self::AtBorder => "at the border of the window",
            Self::Interrupted => "interrupted",
            Self::NotANumber => "not a number",
        })
    }
}

/// Route to a solution.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(tag = "route", rename_all = "kebab-case")]
pub enum Route {
    /// The preconditioned method, as prescribed; also where there was nothing to solve.
    Direct,
    /// The preconditioned method without its continuation of the residual beyond contact, after it had stalled with it.
    WithoutContinuation,
    /// Outer iterations with the lagged traction of coupled friction: it displaces much, or the iteration had stalled with the
    /// traction updated in every step.
    Outer,
    /// Splitting in the metric of the operator's magnitude, under a strong skew part: of friction that couples, or of materials that relax.
    Splitting,
    /// The baseline, as prescribed.
    Baseline,
    /// The baseline, after the preconditioned method had stalled.
    BaselineAfterStall,
    /// Displacement control by load control: the iteration under displacement control had stalled.
    LoadSearch {
        /// Mean pressures tried.
        trials: usize,
    },
    /// No iteration: the pressure is given.
    Given,
}

impl Route {
    /// Mean pressures tried; 0 unless there was a load search.
    pub fn trials(self) -> usize {
        if let Self::LoadSearch { trials } = self { trials } else { 0 }
    }

    /// Name in outputs.
    pub fn name(self) -> &'static str {
        match self {
            Self::Direct => "direct",
            Self::Outer => "outer",
            Self::Splitting => "splitting",
            Self::Baseline => "baseline",
            Self::WithoutContinuation => "without-continuation",
            Self::BaselineAfterStall => "baseline-after-stall",
            Self::LoadSearch { .. } => "load-search",
            Self::Given => "given",
        }
    }
}

/// A route in a record: its name, whether it fell back to the baseline, and mean pressures tried. The last two follow from
/// the route.
impl serde::Serialize for Route {
    fn serialize<S: serde::Serializer>(&self, keys: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Keys {
            route: &'static str,
            fell_back: bool,
            trials: usize,
        }
        Keys { route: self.name(), fell_back: *self == Self::BaselineAfterStall, trials: self.trials() }.serialize(keys)
    }
}

/// Report of a solution on one grid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Report {
    /// Reason why the iteration ended.
    pub stop: Stop,
    /// Route to the solution.
    pub route: Route,
    /// Iterations of all methods and trials on this grid.
    pub iterations: usize,
    /// Gaps computed with the traction of the present pressure, under coupled friction; 0 otherwise.
    pub outer: usize,
    /// ε = Σ p|g| / (δ Σp) of the last iterate.
    pub residual: f64,
}

impl Report {
    /// Report of a pressure that is given and not found.
    pub(in crate::spectral) fn given(stop: Stop) -> Self {
        Self::new(stop, Route::Given, 0, 0.0)
    }

    /// Report of a surface that the load does not reach.
    pub(in crate::spectral) fn without_contact() -> Self {
        Self::new(Stop::NoContact, Route::Direct, 0, 0.0)
    }

    /// Report of one iteration, without outer ones.
    pub(super) fn new(stop: Stop, route: Route, iterations: usize, residual: f64) -> Self {
        Self { stop, route, iterations, outer: 0, residual }
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.route == Route::Given {
            return write!(f, "{}, the pressure is given", self.stop);
        }
        write!(f, "{} after {} iterations", self.stop, self.iterations)?;
        if self.outer > 0 {
            write!(f, " ({} outer)", self.outer)?;
        }
        write!(f, ", ε = {:.1e}", self.residual)?;
        match self.route {
            Route::Direct | Route::Outer | Route::Splitting | Route::Baseline | Route::Given => Ok(()),
            Route::WithoutContinuation => write!(f, ", without continuing the residual beyond contact"),
            Route::BaselineAfterStall => write!(f, ", fell back to Polonsky–Keer"),
            Route::LoadSearch { trials } => write!(f, ", by {trials} trials of the mean pressure"),
        }
    }
}

/// Progress after an iteration on the finest grid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// Iterations so far on this grid.
    pub iteration: usize,
    /// ε.
    pub residual: f64,
}
