//! Fields on one grid: the unknowns, which last from load to load, and the working fields, which all grids use in turn.
//!
//! Between two gaps in double precision the memory of the double-precision fields holds single-precision ones. All working
//! fields are of the preconditioned method, on the samples of one grid:
//!
//! ```text
//! memory              gap in double precision        single precision, line of the method
//! unknowns.gap        g = w + f − δ                  first half:  image   E^T C⁻¹ E r → z (4), C t (5), C d (5)
//!                                                    second half: weight  W, W y (4), step d (5)
//! working.transforms  spectrum of p and w            first part:  spectrum of one convolution
//!                                                    rest:        gap     g (1), carried by its changes
//! working.residual    —                              residual  r = g on I (3)
//! working.previous    —                              previous  r′ of the iteration before (4)
//! working.direction   —                              direction t (4)
//! ```

use super::admissible::AdmissibleSet;
use super::certificate::Certificate;
use crate::load::Control;
use crate::spectral::operator::{ElasticOperator, Workspace};
use std::sync::Arc;

/// Pressure, gap and certificate on one grid, fields with one value per sample: the start of an iteration and its result. A
/// clone shares the fields until one of the two is iterated further.
#[derive(Debug, Clone)]
pub struct Unknowns {
    /// Pressure p.
    pub pressure: Arc<Vec<f64>>,
    /// Gap g = w + f − δ of the last check.
    pub gap: Arc<Vec<f64>>,
    /// Penetration δ of the last check.
    pub penetration: f64,
    /// Bounds on the error of the pressure, from the last check.
    pub certificate: Certificate,
}

impl Unknowns {
    /// No pressure on `samples` samples.
    pub fn new(samples: usize) -> Self {
        let zero = Arc::new(vec![0.0; samples]);
        Self { pressure: Arc::clone(&zero), gap: zero, penetration: 0.0, certificate: Certificate::default() }
    }

    /// p ← 0 everywhere.
    pub(super) fn clear(&mut self) {
        self.pressure = Arc::new(vec![0.0; self.pressure.len()]);
    }

    /// Projects the pressure onto the admissible ones, of the mean under load control.
    pub(super) fn admit(&mut self, load: Control, admissible: AdmissibleSet<'_>) {
        admissible.project(&mut Arc::make_mut(&mut self.pressure)[..], load);
    }
}

/// Working fields in single precision and memory for the transforms, shared by all grids of a problem: each uses as much of
/// them as it has samples.
#[derive(Debug, Default)]
pub struct Working {
    /// Memory of the transforms, and of the gap in single precision.
    pub transforms: Workspace,
    residual: Vec<f32>,
    previous: Vec<f32>,
    direction: Vec<f32>,
}

/// Fields of the preconditioned method on one grid, one value per sample, lengths in units of the largest initial gap.
#[derive(Debug)]
pub(super) struct Fields<'a> {
    /// Gap g.
    pub gap: &'a mut [f32],
    /// Residual r: the gap on the active set, exactly 0 outside.
    pub residual: &'a mut [f32],
    /// r of the iteration before.
    pub previous: &'a mut [f32],
    /// Direction t.
    pub direction: &'a mut [f32],
    /// z, then C t or C d.
    pub image: &'a mut [f32],
    /// Weight W of the extension and what it gathers; then the step d.
    pub weight: &'a mut [f32],
    /// Memory of a convolution in single precision.
    pub memory: &'a mut [f64],
}

impl Working {
    /// Memory for the grid of an `operator` and all coarser ones, allocated at once: memory that grows from grid to grid is
    /// mapped anew each time.
    pub fn of_finest(operator: &impl ElasticOperator) -> Self {
        let mut working = Self::default();
        let samples = operator.split(&mut working.transforms).1.len();
        let Self { residual, previous, direction, .. } = &mut working;
        for field in [residual, previous, direction] {
            *field = vec![0.0; samples];
        }
        working
    }

    /// The fields with their present values, two of them in the memory of the gap in double precision, `double`.
    pub(super) fn of<'a>(&'a mut self, operator: &impl ElasticOperator, double: &'a mut [f64]) -> Fields<'a> {
        let samples = double.len();
        let Self { transforms, residual, previous, direction } = self;
        let (memory, gap) = operator.split(transforms);
        let [residual, previous, direction] = [residual, previous, direction].map(|field| of_size(field, samples));
        let (image, weight) = bytemuck::cast_slice_mut(double).split_at_mut(samples);
        Fields { gap, residual, previous, direction, image, weight, memory }
    }

    /// Gap and residual alone, while the gap in double precision is still read.
    pub(super) fn gap_and_residual(&mut self, operator: &impl ElasticOperator) -> (&mut [f32], &mut [f32]) {
        let (_, gap) = operator.split(&mut self.transforms);
        let residual = of_size(&mut self.residual, gap.len());
        (gap, residual)
    }

    /// r′ ← r; r holds values of no use until it is computed anew.
    pub(super) fn keep_residual(&mut self) {
        std::mem::swap(&mut self.residual, &mut self.previous);
    }
}

/// The first `samples` values of a field, allocated anew where it is shorter.
fn of_size(field: &mut Vec<f32>, samples: usize) -> &mut [f32] {
    if field.len() < samples {
        *field = vec![0.0; samples];
    }
    &mut field[..samples]
}
