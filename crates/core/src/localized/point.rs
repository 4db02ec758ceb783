//! Displacement of the layered surface at the distance r from a unit point force on it.
//!
//! With c = Σ(1−ν)/G of the materials at the surfaces and the layer correction T of the bodies,
//!
//! K(r) = c/(2π) [1/r + C(r)],  C(r) = ∫₀^∞ (T(q) − 1) J₀(qr) dq.
//!
//! C is smooth at r = 0 and goes to (T(0) − 1)/r far away, where K is the substrate's. It is integrated adaptively and
//! kept as Chebyshev series on intervals of r, each halved until it agrees with the integral between its nodes.

use super::quadrature::{Bessel, Estimate, hankel};
use crate::body::Bodies;
use crate::numeric::chebyshev::{self, Chebyshev};
use crate::numeric::search::largest;
use rayon::prelude::*;
use std::f64::consts::PI;

/// Number of nodes of one Chebyshev series.
const SERIES_NODES: usize = 16;
/// Largest error of a series, relative to K: intervals of larger errors are halved.
const SERIES_TOLERANCE: f64 = 2e-11;
/// Relative tolerance of the integrals over the layer correction, which is exact to 1e-15.
pub(super) const QUADRATURE: f64 = 1e-13;
/// qh beyond which T − 1 ~ (qh)² e^{−2qh} is negligible.
const LAYER_CUTOFF: f64 = 24.0;
/// Largest number of halvings of an interval.
const MAX_HALVINGS: usize = 8;

/// Point kernel of a layered half-space, or of two in contact, tabulated up to a distance.
#[derive(Debug, Clone)]
pub struct PointKernel {
    bodies: Bodies,
    /// c = Σ(1−ν)/G, 1/pressure.
    compliance: f64,
    /// Thickness of the first layer, of two the thinner one; `None` without layers.
    thickness: Option<f64>,
    /// Upper ends of the intervals, ascending, and their series of C.
    intervals: Vec<(f64, Chebyshev<SERIES_NODES>)>,
    reach: f64,
    error: f64,
}

impl PointKernel {
    /// Kernel of the bodies, tabulated for distances up to `reach`, a length.
    pub fn new(bodies: impl Into<Bodies>, reach: f64) -> Self {
        let bodies = bodies.into();
        let mut kernel = Self {
            compliance: bodies.surface_compliance(),
            thickness: bodies.thinnest_first_layer(),
            bodies,
            intervals: Vec::new(),
            reach,
            error: 0.0,
        };
        if let Some(thickness) = kernel.thickness {
            let mut bounds = vec![0.0, thickness.min(reach)];
            while let Some(&last) = bounds.last().filter(|&&last| last < reach) {
                bounds.push((2.0 * last).min(reach));
            }
            let pieces: Vec<_> =
                bounds.par_windows(2).map(|ends| kernel.fitted(ends[0], ends[1], MAX_HALVINGS)).collect();
            kernel.error = largest(pieces.iter().map(|(_, error)| *error));
            kernel.intervals = pieces.into_iter().flat_map(|(intervals, _)| intervals).collect();
        }
        kernel
    }

    /// Largest distance of the table, a length.
    pub fn reach(&self) -> f64 {
        self.reach
    }

    /// Largest relative error of K between the nodes of the table, with the error of the integrals.
    pub fn error(&self) -> f64 {
        self.error
    }

    /// c/(2π), the factor of 1/r + C(r): a length times a length per force.
    pub fn factor(&self) -> f64 {
        self.compliance / (2.0 * PI)
    }

    /// Thickness of the first layer; `None` without layers.
    pub(super) fn thickness(&self) -> Option<f64> {
        self.thickness
    }

    /// Wavenumber beyond which the layers do not change the displacement of the surface, 1/length; 0 without layers.
    pub(super) fn layer_cutoff(&self) -> f64 {
        self.thickness.map_or(0.0, |thickness| LAYER_CUTOFF / thickness)
    }

    /// T(q) − 1.
    pub(super) fn excess(&self, wavenumber: f64) -> f64 {
        self.bodies.correction(wavenumber) - 1.0
    }

    /// C(r) by quadrature, 1/length.
    pub fn correction_by_quadrature(&self, r: f64) -> Estimate {
        match self.thickness {
            Some(_) => hankel(Bessel::Zero, r, self.layer_cutoff(), QUADRATURE, |q| self.excess(q)),
            None => Estimate::default(),
        }
    }

    /// C(r), 1/length: from the table up to [`PointKernel::reach`], beyond it by quadrature, as exact but slower.
    pub fn correction(&self, r: f64) -> f64 {
        if self.intervals.is_empty() {
            return 0.0;
        }
        if r > self.reach {
            return self.correction_by_quadrature(r).value;
        }
        let index = self.intervals.partition_point(|(end, _)| *end < r).min(self.intervals.len() - 1);
        let start = if index == 0 { 0.0 } else { self.intervals[index - 1].0 };
        let (end, series) = &self.intervals[index];
        series.at(chebyshev::inside([start, *end], r))
    }

    /// K(r) for r > 0, a length per force.
    pub fn at(&self, r: f64) -> f64 {
        self.factor() * (1.0 / r + self.correction(r))
    }

    /// Series on [a, b], or on its halves where one is not accurate enough; with the largest relative error.
    fn fitted(&self, a: f64, b: f64, depth: usize) -> (Vec<(f64, Chebyshev<SERIES_NODES>)>, f64) {
        let place = |x: f64| chebyshev::place([a, b], x);
        let series = Chebyshev::of(|x| self.correction_by_quadrature(place(x)).value);
        let error = [-0.995, -0.47, 0.098, 0.61, 0.995].into_iter().map(|x| {
            let r = place(x);
            let exact = self.correction_by_quadrature(r);
            // On nearly incompressible layers on stiff substrates the surface heaves: K has zeros.
            let size = (1.0 / r + exact.value).abs().max(1e-3 / r);
            ((series.at(x) - exact.value).abs() + exact.error) / size
        });
        let error = largest(error);
        if error < SERIES_TOLERANCE || depth == 0 {
            return (vec![(b, series)], error);
        }
        let middle = 0.5 * (a + b);
        let ((mut lower, one), (upper, two)) = (self.fitted(a, middle, depth - 1), self.fitted(middle, b, depth - 1));
        lower.extend(upper);
        (lower, largest([one, two]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{HalfSpace, Interface, Layer, Material};

    #[test]
    fn beyond_its_reach_the_kernel_is_that_of_a_longer_table() {
        let coating = Layer::new(Material::from_shear(5.0, 0.2).unwrap(), 0.1, Interface::Bonded).unwrap();
        let half_space = HalfSpace::new(vec![coating], Material::from_shear(1.0, 0.3).unwrap());
        let (short, long) = (PointKernel::new(&half_space, 1.0), PointKernel::new(&half_space, 8.0));
        for r in [0.9, 1.0, 1.001, 1.5, 3.0, 7.9] {
            let (one, other) = (short.at(r), long.at(r));
            assert!((one / other - 1.0).abs() < 2.0 * SERIES_TOLERANCE, "r = {r}: {one} {other}");
        }
    }
}
