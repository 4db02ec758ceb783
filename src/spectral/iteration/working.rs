//! What the methods work on besides the unknowns: fields that no grid needs while another one is solved.

use crate::spectral::operator::Workspace;

/// Working fields in single precision and buffers of the transforms, shared by all grids of a problem: each takes as much
/// of them as it has samples.
#[derive(Debug, Default)]
pub struct Working {
    /// Buffers of the transforms.
    pub transforms: Workspace,
    pub(super) fields: Fields<Vec<f32>>,
}

/// The fields of the preconditioned method, lengths in units of the largest initial gap.
#[derive(Debug, Default)]
pub(super) struct Fields<F> {
    /// Gap g.
    pub gap: F,
    /// r: the gap on the active set, 0 outside.
    pub residual: F,
    /// r of the iteration before.
    pub previous: F,
    /// Direction t.
    pub direction: F,
    /// What is convolved: z, then C t.
    pub image: F,
    /// W of the extension, and what it gathers; then the step d.
    pub weight: F,
    /// Of the extension; then C d.
    pub aside: F,
}

impl Working {
    /// The fields of a grid, with whatever values they have, and the transforms' buffers.
    pub(super) fn of(&mut self, samples: usize) -> (Fields<&mut [f32]>, &mut Workspace) {
        let Fields { gap, residual, previous, direction, image, weight, aside } = &mut self.fields;
        let [gap, residual, previous, direction, image, weight, aside] =
            [gap, residual, previous, direction, image, weight, aside].map(|field| {
                if field.len() < samples {
                    *field = vec![0.0; samples];
                }
                &mut field[..samples]
            });
        (Fields { gap, residual, previous, direction, image, weight, aside }, &mut self.transforms)
    }
}
