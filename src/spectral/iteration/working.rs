//! What the methods work on besides the unknowns: fields that no grid needs while another one is solved.

use crate::spectral::operator::Workspace;

/// Working fields in single precision and a buffer of the transforms, shared by all grids of a problem: each takes as much
/// of them as it has samples.
#[derive(Debug, Default)]
pub struct Working {
    /// Buffer of the transforms.
    pub transforms: Workspace,
    gap: Vec<f32>,
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
}

impl Working {
    /// The fields, with whatever values they have, and the transforms' buffer. Two fields take the place of a gap in
    /// double precision, which is computed afresh when it is needed again.
    pub(super) fn of<'a>(&'a mut self, double: &'a mut [f64]) -> (Fields<'a>, &'a mut Workspace) {
        let samples = double.len();
        let Self { transforms, gap, residual, previous, direction } = self;
        let [gap, residual, previous, direction] =
            [gap, residual, previous, direction].map(|field| of_size(field, samples));
        let (image, weight) = bytemuck::cast_slice_mut(double).split_at_mut(samples);
        (Fields { gap, residual, previous, direction, image, weight }, transforms)
    }

    /// Gap and residual alone.
    pub(super) fn start(&mut self, samples: usize) -> (&mut [f32], &mut [f32]) {
        (of_size(&mut self.gap, samples), of_size(&mut self.residual, samples))
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
