//! The operator of layered half-spaces on a periodic cell.
//!
//! ŵ(q) = C(q) p̂(q) with the layered compliance C(q) at the shortest alias of each grid wavevector; its inverse makes the
//! preconditioner. Both are diagonal in Fourier space. Under coupled friction the traction μ p **e** displaces too,
//!
//! ŵ = (C − iμK cos θ) p̂ = C(1 − iT) p̂,  T = μ (K/C) cos θ,
//!
//! θ between **q** and **e**: a skew part, which is odd in **q**, so that tied aliases are averaged and a component
//! that is its own conjugate has none.
//!
//! Below a load that moves steadily over bodies that relax ŵ = K̂ p̂ with the complex [K̂](Bodies::moving_compliance) = C(1 − iT): what is lost
//! is a skew part too.
//!
//! The mean displacement of a half-space is infinite and left out; that of layers on a rigid base is the mean pressure times
//! [`Bodies::mean_compliance`].

use super::layered_operator::{LayeredOperator, Skew};
use super::transforms::Transforms;
use super::wave_operator::of_component;
use crate::body::{Bodies, Compliances};
use crate::friction::Friction;
use crate::lattice::Grid;
use rustfft::num_complex::Complex64;
use std::sync::atomic::{AtomicU64, Ordering};

impl LayeredOperator {
    /// Operator of the bodies on a periodic grid, without friction.
    pub fn new(grid: &Grid, bodies: impl Into<Bodies>) -> Self {
        Self::combined(grid, &[(1.0, &bodies.into())])
    }

    /// Σ wᵢ Cᵢ of several bodies on a periodic grid, without friction.
    pub(super) fn combined(grid: &Grid, bodies: &[(f64, &Bodies)]) -> Self {
        let weighted =
            bodies.iter().map(|(weight, bodies)| (*weight, Compliances::new(bodies, range(grid), grid.len() / 2)));
        let compliances: Vec<(f64, Compliances<'_>)> = weighted.collect();
        Self::with(grid, Transforms::new(grid.points()), &compliances)
    }

    /// Operator of the bodies on a periodic grid, the counterbody sliding with `friction`.
    pub fn sliding(grid: &Grid, bodies: impl Into<Bodies>, friction: &Friction) -> Self {
        let bodies = bodies.into();
        let [x, y] = friction.traction();
        if !friction.couples() {
            return Self::new(grid, bodies);
        }
        let compliances = Compliances::coupled(&bodies, range(grid), grid.len() / 2);
        let transforms = Transforms::new(grid.points());
        let ratio = |component| match grid.mean_direction(component) {
            [0.0, 0.0] => 0.0,
            [nx, ny] => (x * nx + y * ny) * compliances.coupling_ratio(grid.wavenumber(component)),
        };
        let skew = transforms.double.skew_ratio(|[k1, k2], values| {
            values.iter_mut().zip(k2..).for_each(|(value, k2)| *value = ratio([k1, k2]));
        });
        let largest = skew.largest();
        Self::with(grid, transforms, &[(1.0, compliances)]).coupled(Skew::Ratio(skew), largest)
    }

    /// Operator of the bodies on a periodic grid below a load that moves steadily with a `velocity`, with the `traction` over the pressure that
    /// couples, and with the `swelling` by its heat over the pressure; of infinite coupling where the real part of a wave is not positive, and no steady state is unique.
    pub(super) fn moving(
        grid: &Grid,
        bodies: &Bodies,
        [velocity, traction]: [[f64; 2]; 2],
        swelling: impl Fn([f64; 2]) -> Complex64 + Sync,
    ) -> Self {
        let transforms = Transforms::new(grid.points());
        let mean = bodies.mean_compliance();
        let taken = AtomicU64::new(0f64.to_bits());
        let at = |wavevector| {
            let elastic = bodies.moving_compliance(wavevector, velocity, traction);
            let whole = elastic + swelling(wavevector);
            // Bits of numbers that are not negative are in their order.
            taken.fetch_max((1.0 - whole.re / elastic.re).max(0.0).to_bits(), Ordering::Relaxed);
            whole
        };
        let compliance = |component: [usize; 2]| match component {
            [0, 0] if mean != 0.0 => mean.into(),
            [0, 0] => bodies.compliance(grid.least_wavenumber()).into(),
            _ => of_component(grid, component, &at),
        };
        let (multiplier, skew) = transforms.double.complex_multiplier(|[k1, k2], values| {
            values.iter_mut().zip(k2..).for_each(|(value, k2)| *value = compliance([k1, k2]));
        });
        let multiplier = if mean != 0.0 { multiplier } else { multiplier.dropping_mean() };
        let largest = if multiplier.is_positive() { skew.largest() } else { f64::INFINITY };
        let unit = bodies.compliance(grid.least_wavenumber());
        let left = 1.0 - f64::from_bits(taken.into_inner());
        Self::of(transforms, multiplier, unit).with_mean(mean).with_left(left).coupled(Skew::Ratio(skew), largest)
    }

    /// Σ wᵢ Cᵢ of several compliances.
    fn with(grid: &Grid, transforms: Transforms, compliances: &[(f64, Compliances<'_>)]) -> Self {
        let at = |k: f64| compliances.iter().map(|(weight, compliance)| weight * compliance.at(k)).sum::<f64>();
        let unit = at(grid.least_wavenumber());
        let mean: f64 = compliances.iter().map(|(weight, compliance)| weight * compliance.mean()).sum();
        // The inverse must stay positive where displacements have zero mean: it takes the mean for a component of the least
        // wavenumber.
        let compliance = transforms.double.multiplier(grid.cell().is_rectangular(), |first, values| {
            grid.wavenumbers(first, values);
            if first == [0, 0] {
                values[0] = grid.least_wavenumber();
            }
            match compliances {
                [(1.0, compliance)] => compliance.replace(values),
                _ => values.iter_mut().for_each(|k| *k = at(*k)),
            }
            if first == [0, 0] && mean != 0.0 {
                values[0] = mean;
            }
        });
        let compliance = if mean != 0.0 { compliance } else { compliance.dropping_mean() };
        Self::of(transforms, compliance, unit).with_mean(mean)
    }
}

/// Least and largest wavenumber of a grid.
pub(super) fn range(grid: &Grid) -> [f64; 2] {
    [grid.least_wavenumber(), grid.largest_wavenumber()]
}
