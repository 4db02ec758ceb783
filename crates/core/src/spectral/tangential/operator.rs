//! The operator of shear tractions on the grid: **u** = A **q** + B p, the tangential displacement of the body less that of the counterbody.
//!
//! Wave by wave, **k̂** = (c, s) its direction and C, K, L, S the [response](crate::body::Bodies::surface) of both bodies,
//!
//! Â = L **k̂k̂**ᵀ + S (1 − **k̂k̂**ᵀ),  B̂ = iK **k̂**,  ŵ = C p̂ − iK **k̂**·**q̂**.
//!
//! - On a periodic cell tied aliases of a component are averaged; K is odd, so that a component that is its own conjugate has none. The mean
//!   displacement of half-spaces is infinite and left out: shifts count from the mean planes. On a rigid base a uniform traction displaces.
//! - In free space both are convolutions with kernels of the offset alone, on a padded window.
//!
//! A is symmetric and positive. (A + λ)⁻¹, for preconditioners, is exact on a periodic cell; in free space that of the window repeated
//! periodically stands for it.

use crate::body::{Bodies, Compliances, ShearCompliances};
use crate::lattice::{Grid, Surroundings};
use crate::spectral::convolution::{Convolution, PairAction, ShearMultiplier, VectorMultiplier};
use crate::spectral::free_space::{
    EVALUATIONS, Window, coupling_multiplier, padded, shear_multiplier, wavenumbers as free_range,
};
use crate::spectral::periodic_operator::range;
use std::fmt;

/// Tangential displacements of the surfaces under shear tractions and pressure on the samples of a grid.
pub(in crate::spectral) struct TangentialOperator {
    transforms: Convolution<f64>,
    shear: ShearMultiplier,
    /// K **k̂**; `None` where tractions and pressure do not couple.
    coupling: Option<VectorMultiplier>,
    /// Transforms and Â of which inverses are taken, with the least wave in the place of the mean.
    inverted: (Option<Convolution<f64>>, ShearMultiplier),
    /// Least and largest of L and S on the grid, lengths per pressure.
    range: [f64; 2],
    memory: Vec<f64>,
    convolutions: f64,
}

impl TangentialOperator {
    /// The operator of the bodies on a grid; `coupled` unless pressure and tractions are taken not to displace for one another.
    pub fn new(grid: &Grid, bodies: &Bodies, coupled: bool) -> Self {
        match grid.cell().surroundings() {
            Surroundings::Periodic => Self::periodic(grid, bodies, coupled),
            Surroundings::FreeSpace => Self::in_free_space(grid, bodies, coupled),
        }
    }

    fn periodic(grid: &Grid, bodies: &Bodies, coupled: bool) -> Self {
        let transforms = Convolution::new(grid.points());
        let compliances = ShearCompliances::new(bodies, range(grid), grid.len() / 2);
        let inverted = repeated(grid, &transforms, &|k| compliances.at(k));
        let shear = inverted.clone().with_mean([compliances.mean(), compliances.mean(), 0.0]);
        let coupling = coupled.then(|| {
            let normal = Compliances::coupled(bodies, range(grid), grid.len() / 2);
            VectorMultiplier::new(&transforms, |component| match grid.mean_direction(component) {
                [0.0, 0.0] => [0.0; 2],
                direction => {
                    let k = grid.wavenumber(component);
                    direction.map(|x| x * normal.at(k) * normal.coupling_ratio(k))
                }
            })
        });
        Self::of(grid, transforms, shear, coupling, (None, inverted), &compliances)
    }

    /// # Panics
    /// When the cell of the grid, the window, is not a rectangle.
    fn in_free_space(grid: &Grid, bodies: &Bodies, coupled: bool) -> Self {
        assert!(grid.cell().is_rectangular(), "the window of a contact in free space is a rectangle");
        let steps = grid.steps();
        let window = Window { spacings: steps.map(|[x, y]| x.hypot(y)), points: grid.points() };
        let axes = [0, 1].map(|axis| steps[axis].map(|x| x / window.spacings[axis]));
        let transforms = Convolution::padded(window.points, padded(window.points));
        let compliances = ShearCompliances::new(bodies, free_range(grid), EVALUATIONS);
        let of = |sign: f64| {
            let compliances = &compliances;
            move |k: f64| {
                let [along, across] = compliances.at(k);
                0.5 * k * (along + sign * across)
            }
        };
        let shear = shear_multiplier(&transforms, window, axes, [&of(1.0), &of(-1.0)]);
        let coupling = coupled.then(|| {
            let normal = Compliances::coupled(bodies, free_range(grid), EVALUATIONS);
            coupling_multiplier(&transforms, window, axes, &|k| k * normal.at(k) * normal.coupling_ratio(k))
        });
        let repetition = Convolution::new(window.points);
        let inverted = repeated(grid, &repetition, &|k| compliances.at(k));
        Self::of(grid, transforms, shear, coupling, (Some(repetition), inverted), &compliances)
    }

    fn of(
        grid: &Grid,
        transforms: Convolution<f64>,
        shear: ShearMultiplier,
        coupling: Option<VectorMultiplier>,
        inverted: (Option<Convolution<f64>>, ShearMultiplier),
        compliances: &ShearCompliances<'_>,
    ) -> Self {
        let ends = [grid.least_wavenumber(), grid.largest_wavenumber()].map(|k| compliances.at(k));
        let all = || ends.iter().flatten().copied();
        let range = [all().fold(f64::INFINITY, f64::min), all().fold(0.0, f64::max)];
        let memory = vec![0.0; transforms.pair_memory()];
        // Like bodies do not couple at any wave.
        let coupling = coupling.filter(|coupling| !coupling.is_zero());
        Self { transforms, shear, coupling, inverted, range, memory, convolutions: 0.0 }
    }

    /// Least and largest of the compliances L and S between the least and the largest wave of the grid, lengths per pressure.
    pub fn range(&self) -> [f64; 2] {
        self.range
    }

    /// Samples of a row.
    pub fn columns(&self) -> usize {
        self.transforms.blocks().points()[1]
    }

    /// Whether pressure and tractions displace for one another.
    pub fn couples(&self) -> bool {
        self.coupling.is_some()
    }

    /// Convolutions of pairs so far.
    pub fn convolutions(&self) -> f64 {
        self.convolutions
    }

    /// **q** → A **q** in place, in the rows that are `needed`.
    pub fn displace(&mut self, field: &mut [[f64; 2]], needed: impl Fn(usize) -> bool + Sync) {
        self.convolutions += 1.0;
        self.transforms.convolve_pair(PairAction::Shear(&self.shear), &mut self.memory, field, needed);
    }

    /// B p, tangential displacements under a pressure; `None` where that displaces nothing in the plane.
    pub fn dragged(&mut self, pressure: &[f64]) -> Option<Vec<[f64; 2]>> {
        let coupling = self.coupling.as_ref()?;
        let mut field: Vec<[f64; 2]> = pressure.iter().map(|&p| [p, 0.0]).collect();
        self.convolutions += 1.0;
        self.transforms.convolve_pair(PairAction::Gradient(coupling), &mut self.memory, &mut field, |_| true);
        // The second component is that of the first field too.
        Some(field)
    }

    /// Normal displacement by the tractions, −iK **k̂**·**q̂**, by which the gap opens; `None` where they displace nothing so.
    pub fn lifted(&mut self, traction: &[[f64; 2]]) -> Option<Vec<f64>> {
        let coupling = self.coupling.as_ref()?;
        let mut field = traction.to_vec();
        self.convolutions += 1.0;
        self.transforms.convolve_pair(PairAction::Divergence(coupling), &mut self.memory, &mut field, |_| true);
        Some(field.into_iter().map(|[w, _]| w).collect())
    }

    /// The matrix (Â + λ)⁻¹ for [`Self::invert`].
    pub fn inverse(&self, lambda: f64) -> ShearMultiplier {
        self.inverted.1.inverse(lambda)
    }

    /// **r** → (A + λ)⁻¹ **r** in place, or what is near to it, in the rows that are `needed`.
    pub fn invert(&mut self, inverse: &ShearMultiplier, field: &mut [[f64; 2]], needed: impl Fn(usize) -> bool + Sync) {
        self.convolutions += 1.0;
        let transforms = self.inverted.0.as_ref().unwrap_or(&self.transforms);
        transforms.convolve_pair(PairAction::Shear(inverse), &mut self.memory, field, needed);
    }
}

/// Â on the grid repeated periodically, with the least wave in the place of the mean.
fn repeated(
    grid: &Grid,
    transforms: &Convolution<f64>,
    compliances: &(dyn Fn(f64) -> [f64; 2] + Sync),
) -> ShearMultiplier {
    ShearMultiplier::new(transforms, |component| {
        let wavenumber = if component == [0, 0] { grid.least_wavenumber() } else { grid.wavenumber(component) };
        let ([along, across], [xx, yy, xy]) = (compliances(wavenumber), grid.mean_dyad(component));
        [along * xx + across * yy, along * yy + across * xx, (along - across) * xy]
    })
}

impl fmt::Debug for TangentialOperator {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("TangentialOperator").field("range", &self.range).field("couples", &self.couples()).finish()
    }
}
