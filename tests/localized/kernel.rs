//! Influence coefficients and the far field against closed forms, tables, another quadrature and reciprocity.

use crate::common::coated;
use crate::{homogeneous, two_layers};
use percoat::localized::disc;
use percoat::localized::point::PointKernel;
use percoat::localized::square::Squares;
use percoat::{HalfSpace, Interface};
use std::f64::consts::PI;

#[test]
fn near_and_far_evaluation_agree_where_they_meet() {
    for half_space in [
        homogeneous(),
        coated(2.0, 0.5, [0.2, 0.3], Interface::Bonded),
        coated(100.0, 0.05, [0.2, 0.3], Interface::Frictionless),
    ] {
        let kernel = PointKernel::new(&half_space, 50.0);
        for half in [0.01, 0.1] {
            let squares = Squares::new(&kernel, half);
            for angle in [0.0f64, 0.3, 0.7] {
                let at = |d: f64| squares.coefficient(d * half * angle.cos(), d * half * angle.sin());
                let (below, above) = (at(10.0 * (1.0 - 1e-13)), at(10.0 * (1.0 + 1e-13)));
                assert!((below / above - 1.0).abs() < 1e-9);
            }
        }
    }
}

/// The double integral of Eq. (7) itself: w(x, y) = c/π² ∫₀^{π/2}∫₀^∞ T(q) · 4 sin(qa cos φ) sin(qa sin φ)/(q² cos φ
/// sin φ) · cos(qx cos φ) cos(qy sin φ) dq dφ for unit pressure, its correction T − 1 by Simpson in q and the midpoint
/// rule, which converges geometrically, in φ.
#[test]
fn coefficients_are_the_double_integral_of_eq_7() {
    for half_space in [
        coated(2.0, 0.5, [0.2, 0.3], Interface::Bonded),
        coated(0.5, 0.5, [0.45, 0.3], Interface::Bonded),
        coated(3.0, 0.1, [0.2, 0.3], Interface::Frictionless),
        coated(2.0, 0.3, [0.2, 0.3], Interface::Spring { tangential: 0.3, normal: 1.0 }),
        two_layers(),
    ] {
        let kernel = PointKernel::new(&half_space, 20.0);
        let transfer = half_space.response();
        let surface = half_space.surface_material();
        let c = (1.0 - surface.poisson()) / surface.shear();
        let h = half_space.layers()[0].thickness();
        for half in [0.05, 0.3] {
            let squares = Squares::new(&kernel, half);
            let bare_kernel = PointKernel::new(HalfSpace::new(vec![], surface), 20.0);
            let bare = Squares::new(&bare_kernel, half);
            for (x, y) in [(0.0, 0.0), (0.3, 0.1), (1.0, 0.7)] {
                let (angles, steps) = (400, 6000);
                let end = 22.0 / h;
                let step = end / f64::from(steps);
                let mut sum = 0.0;
                for i in 0..=steps {
                    let q = (f64::from(i) * step).max(1e-12);
                    let weight = if i == 0 || i == steps { 1.0 } else { 2.0 + 2.0 * f64::from(i % 2) };
                    let mut ring = 0.0;
                    for j in 0..angles {
                        let (sin, cos) = (0.5 * PI * (f64::from(j) + 0.5) / f64::from(angles)).sin_cos();
                        ring += 4.0 * (q * half * cos).sin() * (q * half * sin).sin() / (q * q * cos * sin)
                            * (q * x * cos).cos()
                            * (q * y * sin).cos();
                    }
                    sum += weight * (transfer.correction(q) - 1.0) * ring * 0.5 * PI / f64::from(angles);
                }
                let layers = c / (PI * PI) * sum * step / 3.0;
                let expected = bare.coefficient(x, y) + layers;
                let got = squares.coefficient(x, y);
                assert!((got / expected - 1.0).abs() < 1e-8, "a = {half} at ({x}, {y}): {got} {expected}");
            }
        }
    }
}

/// Reciprocity: under unit forces a square displaces a disc as the disc displaces the square.
#[test]
fn work_is_reciprocal_between_a_square_and_a_disc() {
    for half_space in [coated(3.0, 0.2, [0.2, 0.3], Interface::Frictionless), two_layers()] {
        let kernel = PointKernel::new(&half_space, 10.0);
        let (half, radius, [x, y]) = (0.15, 0.4, [0.9, 0.5]);
        let squares = Squares::new(&kernel, half);
        // Mean over the disc of the square's displacement.
        let (rings, angles) = (400, 64);
        let mut under_disc = 0.0;
        for i in 0..rings {
            let r = radius * (f64::from(i) + 0.5) / f64::from(rings);
            for j in 0..angles {
                let angle = 2.0 * PI * (f64::from(j) + 0.5) / f64::from(angles);
                under_disc += r * squares.coefficient(x + r * angle.cos(), y + r * angle.sin());
            }
        }
        under_disc *= 2.0 / (radius * f64::from(rings * angles)) / (4.0 * half * half);
        // Mean over the square of the disc's displacement.
        let n = 60;
        let mut under_square = 0.0;
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            let [u, v] = [i, j].map(|k| half * (2.0 * (f64::from(k) + 0.5) / f64::from(n) - 1.0));
            under_square += disc::displacement(&kernel, radius, (x - u).hypot(y - v));
        }
        under_square /= f64::from(n * n) * PI * radius * radius;
        assert!((under_disc / under_square - 1.0).abs() < 1e-5, "{under_disc} {under_square}");
    }
}

#[test]
fn far_away_only_the_substrate_is_felt() {
    for half_space in [coated(20.0, 0.1, [0.2, 0.3], Interface::Bonded), two_layers()] {
        let kernel = PointKernel::new(&half_space, 2e3);
        let substrate = half_space.material(half_space.material_count());
        for r in [300.0, 1900.0] {
            let bare = 1.0 / (PI * substrate.contact_modulus() * r);
            assert!((kernel.at(r) / bare - 1.0).abs() < 2e-4);
        }
        assert!(kernel.error() < 1e-10);
    }
}
