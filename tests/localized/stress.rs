//! Stresses of the localized solution against Hertz and against the spectral field.

use crate::common::{PAPER, coated, one_level, paraboloid, solve};
use crate::{alone, homogeneous, setup, two_layers};
use percoat::localized::Localized;
use percoat::localized::stress::LocalizedField;
use percoat::{Depth, HalfSpace, Interface, Lattice, Load, MeanStress, Problem, StressField};

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
        for mean in [MeanStress::Confined, MeanStress::HalfSpace] {
            let field = LocalizedField::new(&solution, None, mean);
            let whole = StressField::new(spectral.finest(), mean);
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
