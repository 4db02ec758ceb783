//! The localization principle in numbers: what the circle leaves out, predicted by lattice sums.
//!
//! With n neighbours of one level in the circle and p̄ outside, the surface under the indenter feels
//!
//! S₁ = Σ 1/r − 2R/R₀²,  S₃ = Σ 1/r³ + 2/(R₀²R),  S₅ = Σ 1/r⁵ + 2/(3R₀²R³),  π R₀² = A₀, π R² = (n+1) A₀,
//!
//! in the place of the whole lattice's −4.2134, 11.0342, 6.7619 (period 1). Moments of the pressure act from the
//! indenters inside alone: a uniform pressure has none.

use crate::common::paraboloid;
use crate::{homogeneous, setup};
use percoat::lattice::Lattice;
use percoat::localized::{CircleRadius, Coupled, Localized, Stop};
use percoat::solver::Control;
use std::f64::consts::PI;

const RADIUS: f64 = 0.8;

/// S₁, S₃, S₅ of a circle with n neighbours, and the parts of S₃ and S₅ from inside.
fn sums(system: &Localized, neighbours: usize) -> ([f64; 3], [f64; 2]) {
    let circle = &system.circles(neighbours + 1)[0];
    assert_eq!(circle.indenters(), neighbours + 1);
    let area = system.cell_area();
    let (square, radius) = (area / PI, circle.area_balanced(area));
    let inside = |power: i32| -> f64 { circle.images[0][1..].iter().map(|[x, y]| x.hypot(*y).powi(-power)).sum() };
    let [s3, s5] = [inside(3), inside(5)];
    let all =
        [inside(1) - 2.0 * radius / square, s3 + 2.0 / (square * radius), s5 + 2.0 / (3.0 * square * radius.powi(3))];
    (all, [s3, s5])
}

/// a and δ of a paraboloid under the load P among its images, E* = 1:
/// P = (8/3)Ba³ + (64/15)Ca⁵; δ = 2Ba² + (8/3)Ca⁴ + (P S₁ + M₂ S₃/4 + 9 M₄ S₅/64)/π with
/// B = 1/2R + (P S₃/4 + 9 M₂ S₅/16)/π, C = 9 P S₅/64π, M₂ = 2Pa²/5, M₄ = 8Pa⁴/35.
fn contact(([s1, s3, s5], [inner3, inner5]): ([f64; 3], [f64; 2]), load: f64) -> (f64, f64) {
    let moments = |a: f64| (0.4 * load * a.powi(2), 8.0 / 35.0 * load * a.powi(4));
    let b = |a: f64| 0.5 / RADIUS + (load * s3 / 4.0 + 9.0 * moments(a).0 * inner5 / 16.0) / PI;
    let c = 9.0 * load * s5 / (64.0 * PI);
    let (mut low, mut high) = (0.0, 0.5);
    for _ in 0..60 {
        let a: f64 = 0.5 * (low + high);
        let carried = 8.0 / 3.0 * b(a) * a.powi(3) + 64.0 / 15.0 * c * a.powi(5);
        if carried < load { low = a } else { high = a }
    }
    let a = low;
    let (m2, m4) = moments(a);
    let lift = (load * s1 + m2 * inner3 / 4.0 + 9.0 * m4 * inner5 / 64.0) / PI;
    (a, 2.0 * b(a) * a.powi(2) + 8.0 / 3.0 * c * a.powi(4) + lift)
}

/// n, R, S₃, S₁ of spheres on a triangular lattice of period 1 (30-digit lattice sums, own derivation).
const TABLE: [(usize, f64, f64, f64); 7] = [
    (0, 0.5250, 13.8184, -3.8093),
    (6, 1.3891, 11.2229, -4.0783),
    (12, 1.8931, 10.9872, -4.2703),
    (18, 2.2886, 11.0749, -4.1400),
    (30, 2.9233, 11.0345, -4.2093),
    (36, 3.1937, 11.0466, -4.1711),
    (54, 3.8938, 11.0385, -4.1903),
];

#[test]
fn circles_have_the_tabulated_sums_and_contacts_feel_exactly_them() {
    let lattice = Lattice::hexagonal(1.0, 1).unwrap();
    let system = Localized::new(&lattice, &[paraboloid(RADIUS, 0.0)], &homogeneous(), 55);
    let pressure = 0.01;
    let load = pressure * system.cell_area();
    let (mesh, start) = system.mesh(Control::MeanPressure(pressure), &setup(7, 48));
    let mut found = Vec::new();
    for (neighbours, radius, s3, s1) in TABLE {
        let sums = sums(&system, neighbours);
        assert!((sums.0[0] - s1).abs() < 1e-4 && (sums.0[1] - s3).abs() < 1e-4, "{neighbours}: {sums:?}");
        let coupled = Coupled::new(&system, mesh, neighbours + 1, true);
        for rule in [CircleRadius::LoadBalanced, CircleRadius::AreaBalanced] {
            let solution = coupled.solve(Control::MeanPressure(pressure), rule, Some(&start));
            assert_eq!(solution.stop, Stop::Converged);
            // One level: both rules are Eq. (4).
            assert!((solution.spots[0].radius - radius).abs() < 1e-4);
            let (a, delta) = contact(sums, load);
            let own = system.observe(&solution)[0];
            println!(
                "{neighbours}: δ {:.7} predicted {delta:.7}, a {:.6} predicted {a:.6}",
                solution.penetration, own.contact_radius
            );
            found.push((solution.penetration, delta, own.contact_radius, a));
        }
    }
    // The mesh errs alike for all circles (1e-4): differences are the circle's own.
    let last = found[found.len() - 1];
    for (delta, predicted, radius, a) in found {
        assert!(((delta - last.0) - (predicted - last.1)).abs() < 5e-7);
        assert!(((radius - last.2) - (a - last.3)).abs() < 5e-6);
        assert!((delta / predicted - 1.0).abs() < 1e-4 && (radius / a - 1.0).abs() < 3e-4);
    }
}
