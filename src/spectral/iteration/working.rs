//! What the methods work on besides the unknowns: fields that no grid needs while another one is solved.

use crate::spectral::operator::{Operator, Workspace};

/// Working fields in single precision and memory for the transforms, shared by all grids of a problem: each takes as much
/// of them as it has samples.
#[derive(Debug, Default)]
pub struct Working {
    /// Memory of the transforms, and of the gap in single precision.
    pub transforms: Workspace,
    residual: Vec<f32>,
    previous: Vec<f32>,
    direction: Vec<f32>,
}

/// The fields of the preconditioned method on one grid, lengths in units of the largest initial gap.
#[derive(Debug)]
pub(super) struct Fields<'a> {
    /// Gap g.
    pub gap: &'a mut [f32],
    /// r: the gap on the active set, 0 outside.
    pub residual: &'a mut [f32],
    /// r of the iteration before.
    pub previous: &'a mut [f32],
    /// Direction t.
    pub direction: &'a mut [f32],
    /// z, then C t or C d.
    pub image: &'a mut [f32],
    /// W of the extension, and what it gathers; then the step d.
    pub weight: &'a mut [f32],
    /// What convolutions in single precision work in.
    pub room: &'a mut [f64],
}

impl Working {
    /// For the grid of an `operator` and all coarser ones, taken at once: memory that grows from grid to grid is mapped
    /// anew each time.
    pub fn of_finest(operator: &Operator) -> Self {
        let mut working = Self::default();
        let samples = operator.shared(&mut working.transforms).1.len();
        let Self { residual, previous, direction, .. } = &mut working;
        for field in [residual, previous, direction] {
            *field = vec![0.0; samples];
        }
        working
    }

    /// The fields, with whatever values they have. Some are in the place of what is in double precision and computed
    /// afresh when it is needed again: one in that of a spectrum, two in that of the gap `double`.
    pub(super) fn of<'a>(&'a mut self, operator: &Operator, double: &'a mut [f64]) -> Fields<'a> {
        let samples = double.len();
        let Self { transforms, residual, previous, direction } = self;
        let (room, gap) = operator.shared(transforms);
        let [residual, previous, direction] = [residual, previous, direction].map(|field| of_size(field, samples));
        let (image, weight) = bytemuck::cast_slice_mut(double).split_at_mut(samples);
        Fields { gap, residual, previous, direction, image, weight, room }
    }

    /// Gap and residual alone.
    pub(super) fn start(&mut self, operator: &Operator) -> (&mut [f32], &mut [f32]) {
        let (_, gap) = operator.shared(&mut self.transforms);
        let residual = of_size(&mut self.residual, gap.len());
        (gap, residual)
    }

    /// r becomes that of the iteration before.
    pub(super) fn turn_over(&mut self) {
        std::mem::swap(&mut self.residual, &mut self.previous);
    }
}

/// So many samples of a field that may have been too short yet.
fn of_size(field: &mut Vec<f32>, samples: usize) -> &mut [f32] {
    if field.len() < samples {
        *field = vec![0.0; samples];
    }
    &mut field[..samples]
}
