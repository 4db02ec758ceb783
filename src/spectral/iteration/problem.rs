//! One load step on one grid, as the methods receive it.

use super::fields::Working;
use super::report::Progress;
use crate::load::Load;
use crate::spectral::operator::ElasticOperator;
use std::fmt;
use std::ops::ControlFlow;

/// Conjugate-gradient method.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "kebab-case"))]
#[non_exhaustive]
pub enum Method {
    /// Preconditioned with C⁻¹ between the active set and its surroundings: iterations do not grow with the grid.
    #[default]
    Preconditioned,
    /// Polonsky & Keer, Wear 231 (1999) 206. For a symmetric operator: under coupled friction it stalls.
    PolonskyKeer,
}

/// Dimensionless tolerance and limits.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Settings {
    /// The method that starts; the preconditioned one falls back to the other when it stalls, unless friction is coupled.
    pub method: Method,
    /// Bound on ε, greater than 0; the energy gap of a converged solution is below 20 times it, the deepest penetration
    /// outside contact below 10 times it and δ. A tolerance that is not greater than 0 is never reached.
    pub tolerance: f64,
    /// Largest number of iterations on one grid.
    pub max_iterations: usize,
}

impl Default for Settings {
    fn default() -> Self {
        Self { method: Method::default(), tolerance: 1e-8, max_iterations: 10_000 }
    }
}

/// Admissible pressures: p ≥ 0 where contact may occur, p = 0 elsewhere.
///
/// A further bound on the pressure (p ≤ hardness) would belong here too. It takes more than the clipping of a step: a second
/// active set, a load that is restored by a shift instead of a scale, and the least ⟨s, g⟩ over the box for the certificate.
#[derive(Debug, Clone, Copy, Default)]
pub struct AdmissibleSet<'a> {
    /// Whether contact may occur, one value per sample; `None`: everywhere.
    mask: Option<&'a [bool]>,
}

impl<'a> AdmissibleSet<'a> {
    /// Pressures on the samples of a mask; on all samples without one.
    pub fn new(mask: Option<&'a [bool]>) -> Self {
        Self { mask }
    }

    /// Whether contact may occur everywhere.
    pub fn is_everywhere(self) -> bool {
        self.mask.is_none()
    }

    /// p ← 0 where contact may not occur.
    pub(super) fn restrict(self, pressure: &mut [f64]) {
        self.closed().for_each(|i| pressure[i] = 0.0);
    }

    /// The uniform pressure on the samples of the set with the given sum.
    pub(super) fn fill(self, pressure: &mut [f64], sum: f64) {
        let size = pressure.len() - self.closed().count();
        pressure.fill(sum / size as f64);
        self.restrict(pressure);
    }

    /// g ← `far` where contact may not occur: such a sample never joins the active set.
    pub(super) fn open(self, gap: &mut [f64], far: f64) {
        self.closed().for_each(|i| gap[i] = far);
    }

    /// min g, and min g where p = 0, over the samples where contact may occur.
    pub(super) fn least_gaps(self, pressure: &[f64], gap: &[f64]) -> [f64; 2] {
        let admissible = |i: &usize| self.mask.is_none_or(|mask| mask[*i]);
        (0..gap.len()).filter(admissible).fold([f64::INFINITY; 2], |[least, outside], i| {
            [least.min(gap[i]), if pressure[i] > 0.0 { outside } else { outside.min(gap[i]) }]
        })
    }

    /// Samples where contact may not occur.
    fn closed(self) -> impl Iterator<Item = usize> + use<'a> {
        self.mask.unwrap_or_default().iter().enumerate().filter(|(_, admissible)| !**admissible).map(|(i, _)| i)
    }
}

/// One load step on one grid: everything that the methods receive.
pub struct ContactProblem<'a, O> {
    /// The elastic body.
    pub operator: &'a mut O,
    /// Fields that the methods work on.
    pub working: &'a mut Working,
    /// f ≥ 0, a length, one value per sample, a₂ fastest, measured from first touch.
    pub initial_gap: &'a [f64],
    /// Its largest value.
    pub largest_gap: f64,
    /// Where contact may occur.
    pub admissible: AdmissibleSet<'a>,
    /// Prescribed mean pressure or penetration.
    pub load: Load,
    /// Tolerance and limits.
    pub settings: Settings,
    /// Outer iterations so far, see [`Report::outer`](super::Report::outer).
    pub outer: usize,
    /// Called after each iteration; `Break` ends the step.
    pub progress: &'a mut (dyn FnMut(Progress) -> ControlFlow<()> + Send),
}

impl<O: ElasticOperator> ContactProblem<'_, O> {
    /// p → w = A p in place.
    pub(super) fn displace(&mut self, field: &mut [f64]) {
        self.operator.displace(field, &mut self.working.transforms);
    }

    /// Scale of lengths: the largest initial gap or, under a flat counterbody that touches on a part of the cell, what the
    /// load displaces.
    pub(super) fn length(&self) -> f64 {
        match self.load {
            _ if self.largest_gap > 0.0 => self.largest_gap,
            Load::MeanPressure(mean) => mean * self.operator.unit(),
            Load::Penetration(penetration) => penetration,
        }
    }
}

impl<O> fmt::Debug for ContactProblem<'_, O> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "contact of {} samples under {}", self.initial_gap.len(), self.load)
    }
}
