//! Stresses of the localized solution against Hertz and against the spectral field.

use crate::common::{PAPER, coated, one_level, paraboloid, solve};
use crate::{alone, homogeneous, setup, two_layers};
use percoat::localized::Localized;
use percoat::localized::stress::LocalizedField;
use percoat::{Depth, Friction, HalfSpace, Interface, Lattice, Load, Material, MeanStress, Problem, StressField};
use std::collections::BTreeSet;

/// On the axis, ζ = z/a, ν = 0: σ_z = −p₀/(1+ζ²), σ_r = −(1+ν)(1 − ζ atan(1/ζ))p₀ + ½p₀/(1+ζ²).
#[test]
fn stresses_under_an_indenter_alone_are_hertzian() {
    let indenters = one_level(Lattice::hexagonal(10.0, 1).unwrap(), paraboloid(1.0, 0.0));
    let localized = Localized::new(&Problem::new(indenters, homogeneous()), 1).unwrap();
    let load = 4.0 / 3.0 / localized.system().cell().area();
    let solution = localized.solve(Load::MeanPressure(load), &alone(48));
    let field = LocalizedField::new(&solution, None, MeanStress::Confined);
    let p0 = 2.0 / std::f64::consts::PI;
    for zeta in [0.1f64, 0.3, 0.5, 1.0, 3.0] {
        let state = field.points(0, Depth { z: zeta, material: 1 }, &[[0.0, 0.0]]).unwrap()[0];
        let zz = -p0 / (1.0 + zeta * zeta);
        let rr = -p0 * (1.0 - zeta * (1.0 / zeta).atan()) - 0.5 * zz;
        for (found, expected) in [(state.zz, zz), (state.xx, rr), (state.yy, rr), (state.xz, 0.0), (state.xy, 0.0)] {
            assert!((found - expected).abs() < 5e-4 * p0, "ζ = {zeta}: {found} {expected}");
        }
    }
    assert!(field.points(0, Depth { z: 0.05, material: 1 }, &[[0.0, 0.0]]).is_none());
}

/// Closed form of `validation/sliding-sphere`: both loads apart, normal plus μ times tangential, turned to the direction.
#[test]
fn stresses_under_an_indenter_alone_that_slides_are_those_of_a_sliding_sphere() {
    const COEFFICIENT: f64 = 0.7;
    let rows: Vec<Vec<&str>> = include_str!("../../validation/sliding-sphere/reference.csv")
        .lines()
        .filter(|line| !line.starts_with(['#', 'n']))
        .map(|line| line.split(',').collect())
        .collect();
    let number = |text: &str| text.parse::<f64>().unwrap();
    let p0 = 2.0 / std::f64::consts::PI;
    let (sin, cos) = 0.6f64.sin_cos();
    let turned = |[x, y]: [f64; 2]| [x * cos - y * sin, x * sin + y * cos];
    let friction = Friction::new(COEFFICIENT, [cos, sin]).unwrap().uncoupled();
    let mut compared = 0;
    for nu in [0.0, 0.3, 0.5] {
        let indenters = one_level(Lattice::hexagonal(10.0, 1).unwrap(), paraboloid(1.0, 0.0));
        let body = HalfSpace::new(vec![], Material::from_young(1.0 - nu * nu, nu).unwrap());
        let localized = Localized::new(&Problem::new(indenters, body), 1).unwrap();
        let load = 4.0 / 3.0 / localized.system().cell().area();
        let solution = localized.solve(Load::MeanPressure(load), &alone(48));
        let field = LocalizedField::new(&solution, Some(&friction), MeanStress::Confined);
        let pairs: Vec<_> = rows.chunks_exact(2).filter(|pair| number(pair[0][0]) == nu).collect();
        let place = |pair: &[Vec<&str>]| [1, 2, 3].map(|k| number(pair[0][k]));
        let depths: BTreeSet<&str> = pairs.iter().map(|pair| pair[0][3]).collect();
        for depth in depths {
            let pairs: Vec<_> = pairs.iter().filter(|pair| pair[0][3] == depth).collect();
            let points: Vec<[f64; 2]> = pairs.iter().map(|pair| place(pair)).map(|[x, y, _]| turned([x, y])).collect();
            let Some(states) = field.points(0, Depth { z: number(depth), material: 1 }, &points) else { continue };
            for (pair, state) in pairs.into_iter().zip(states) {
                let [normal, tangential] =
                    [0, 1].map(|k| -> Vec<f64> { pair[k][5..].iter().map(|x| number(x)).collect() });
                assert_eq!((pair[0][4], pair[1][4]), ("normal", "tangential"));
                let [x, y, z] = place(pair);
                let sum = |k: usize| p0 * (normal[k] + COEFFICIENT * tangential[k]);
                let [xx, yy, zz, xy, xz, yz] = [0, 1, 2, 3, 4, 5].map(sum);
                let known = [
                    xx * cos * cos + yy * sin * sin - 2.0 * xy * sin * cos,
                    xx * sin * sin + yy * cos * cos + 2.0 * xy * sin * cos,
                    zz,
                    (xx - yy) * sin * cos + xy * (cos * cos - sin * sin),
                    turned([xz, yz])[0],
                    turned([xz, yz])[1],
                ];
                for (found, known) in state.components().iter().zip(known) {
                    // The tolerance against the spectral field, too: forces for elements, under the edge of 48.
                    assert!((found - known).abs() < 2e-3 * p0, "ν = {nu}, ({x}, {y}, {z}): {found} {known}");
                    compared += 1;
                }
            }
        }
    }
    // Six components at 24 places below the surface, for three Poisson's ratios.
    assert_eq!(compared, 6 * 24 * 3);
}

/// Every component on the axis and along a radial line, above and below the interfaces, for both mean stresses.
#[test]
fn stresses_agree_with_the_spectral_field() {
    let cases: [(HalfSpace, f64); 3] = [
        (PAPER[0].half_space(), 0.5),
        (coated(0.5, 0.2, [0.45, 0.3], Interface::Frictionless), 0.2),
        (two_layers(), 0.3),
    ];
    for (half_space, interface) in cases {
        let load = Load::MeanPressure(0.02);
        let problem = Problem::new(PAPER[0].indenters(), half_space.clone());
        let solution = Localized::new(&problem, 439).unwrap().solve(load, &setup(439, 32));
        let (spectral, reading) = solve(&problem, [384, 384], load);
        // Uncoupled: a layer that slides itself holds nothing that slides on it.
        let friction = Friction::new(0.6, [0.8, -0.6]).unwrap().uncoupled();
        let sliding = problem.clone().sliding(friction).ok();
        let slid = sliding.map(|problem| solve(&problem, [384, 384], load).0);
        assert_eq!(
            slid.is_none(),
            half_space.layers().iter().any(|layer| layer.interface() == Interface::Frictionless)
        );
        // The half-space mean without friction stands on the body that nothing can slide on.
        for (mean, slid) in [(MeanStress::Confined, None), (MeanStress::HalfSpace, slid.as_ref())] {
            let field = LocalizedField::new(&solution, slid.map(|_| &friction), mean);
            let whole = StressField::new(slid.unwrap_or(&spectral).finest(), mean);
            let depths = [
                Depth { z: 0.08, material: 1 },
                Depth { z: interface, material: 1 },
                Depth { z: interface, material: 2 },
            ];
            for depth in depths.into_iter().chain(half_space.depths(0.9)) {
                let points = [[0.0, 0.0], [0.1, 0.0], [0.2, 0.0], [0.35, 0.05]];
                let found = field.points(0, depth, &points).unwrap();
                let expected = whole.points(depth, &points);
                for ((found, expected), point) in found.iter().zip(&expected).zip(points) {
                    let (a, b) = (found.components(), expected.components());
                    for c in 0..6 {
                        let error = (a[c] - b[c]).abs() / reading.max_pressure;
                        assert!(error < 2e-3, "{depth:?} {point:?}, component {c}: {} {}", a[c], b[c]);
                    }
                }
            }
        }
    }
}
