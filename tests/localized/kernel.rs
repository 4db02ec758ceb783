//! Influence coefficients and the far field against closed forms, tables, another quadrature and reciprocity.

use crate::common::coated;
use crate::{homogeneous, two_layers};
use percoat::layered::TransferFunction;
use percoat::localized::disc;
use percoat::localized::point::PointKernel;
use percoat::localized::square::Squares;
use percoat::material::{HalfSpace, Interface, Layer, Material};
use std::f64::consts::PI;

/// Love (1929): centre (8/π) ln(1+√2) qb/E*, corner half of it, mean 1.8928040176, for a square of half-width b.
#[test]
fn a_square_on_a_half_space_has_loves_values() {
    let kernel = PointKernel::new(&homogeneous(), 1e6);
    let squares = Squares::new(&kernel, 1.0);
    let close = |got: f64, expected: f64| assert!((got / expected - 1.0).abs() < 1e-10, "{got} {expected}");
    close(squares.coefficient(0.0, 0.0), 2.2443994094);
    close(squares.coefficient(1.0, 1.0), 1.1221997047);
    // The mean over the quadrant, x = t − sin(2πt)/2π gathering nodes at the edges.
    let n = 100;
    let node = |i: i32| {
        let t = (f64::from(i) + 0.5) / f64::from(n);
        (t - (2.0 * PI * t).sin() / (2.0 * PI), (1.0 - (2.0 * PI * t).cos()) / f64::from(n))
    };
    let pairs = (0..n).flat_map(|i| (0..n).map(move |j| (node(i), node(j))));
    let mean: f64 = pairs.map(|((x, dx), (y, dy))| dx * dy * squares.coefficient(x, y)).sum();
    assert!((mean / 1.8928040176 - 1.0).abs() < 1e-7, "{mean}");
}

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
        let transfer = TransferFunction::new(&half_space);
        let surface = half_space.surface_material();
        let c = (1.0 - surface.poisson()) / surface.shear();
        let h = half_space.layers()[0].thickness();
        for half in [0.05, 0.3] {
            let squares = Squares::new(&kernel, half);
            let bare_kernel = PointKernel::new(&HalfSpace::new(vec![], surface), 20.0);
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

/// Uniform unit pressure on a disc of unit radius, E₁ = 10, E₂ = 1, ν = 0.3, h = 1: own Hankel integrals with
/// multiprecision amplitudes (about 1e-7), surface displacements.
#[test]
fn a_disc_on_a_coating_has_the_tabulated_displacements() {
    let substrate = Material::from_young(1.0, 0.3).unwrap();
    let coating = Material::from_young(10.0, 0.3).unwrap();
    let half_space = HalfSpace::new(vec![Layer::new(coating, 1.0, Interface::Bonded).unwrap()], substrate);
    let kernel = PointKernel::new(&half_space, 10.0);
    for (s, expected) in [(0.0, 0.79543431), (0.5, 0.76273188), (1.5, 0.53250832), (3.0, 0.31668302)] {
        let found = disc::displacement(&kernel, 1.0, s);
        assert!((found.value - expected).abs() < 2e-8 && found.error < 1e-12);
    }
}

/// u(0) = 2qa/E*, u(a) = (4/π)qa/E*, mean (16/3π)qa/E*; outside, the integral of 1/(πE*r) over the disc.
#[test]
fn a_disc_on_a_half_space_has_its_closed_form() {
    let kernel = PointKernel::new(&homogeneous(), 10.0);
    let at = |s: f64| disc::displacement(&kernel, 1.0, s).value;
    assert!((at(0.0) - 2.0).abs() < 1e-14 && (at(1.0) - 4.0 / PI).abs() < 1e-14);
    // ∫ 2sD(s) ds with s = sin t.
    let n = 400;
    let node = |i: i32| (PI / 2.0 * (f64::from(i) + 0.5) / f64::from(n)).sin_cos();
    let mean = (0..n).map(node).map(|(s, ds)| 2.0 * s * at(s) * ds).sum::<f64>() * PI / 2.0 / f64::from(n);
    assert!((mean / (16.0 / (3.0 * PI)) - 1.0).abs() < 1e-5, "{mean}");
    for s in [1.3, 2.0, 9.0] {
        let (rings, angles) = (2000, 200);
        let mut sum = 0.0;
        for i in 0..rings {
            let r = (f64::from(i) + 0.5) / f64::from(rings);
            for j in 0..angles {
                let angle = 2.0 * PI * (f64::from(j) + 0.5) / f64::from(angles);
                sum += r * kernel.at((r * r + s * s - 2.0 * r * s * angle.cos()).sqrt());
            }
        }
        sum *= 2.0 * PI / f64::from(rings * angles);
        assert!((sum / at(s) - 1.0).abs() < 1e-6, "{s}: {sum} {}", at(s));
    }
}

/// What a square does to a disc, the disc does to the square: both are loaded by unit forces.
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
            under_square += disc::displacement(&kernel, radius, (x - u).hypot(y - v)).value;
        }
        under_square /= f64::from(n * n) * PI * radius * radius;
        assert!((under_disc / under_square - 1.0).abs() < 1e-5, "{under_disc} {under_square}");
    }
}

#[test]
fn far_away_only_the_substrate_is_felt() {
    for half_space in [coated(20.0, 0.1, [0.2, 0.3], Interface::Bonded), two_layers()] {
        let kernel = PointKernel::new(&half_space, 2e3);
        let substrate = half_space.substrate();
        for r in [300.0, 1900.0] {
            let bare = 1.0 / (PI * substrate.contact_modulus() * r);
            assert!((kernel.at(r) / bare - 1.0).abs() < 2e-4);
        }
        assert!(kernel.error() < 1e-10);
    }
}
