//! The localization principle in numbers: what the circle leaves out, predicted by lattice sums.

use crate::common::paraboloid;
use crate::{homogeneous, setup};
use percoat::exact::{Localization, Sums};
use percoat::lattice::Lattice;
use percoat::localized::{CircleRadius, Coupled, Localized, Stop};
use percoat::solver::Control;

const RADIUS: f64 = 0.8;

fn localization(system: &Localized, neighbours: usize) -> Localization {
    let circle = &system.circles(neighbours + 1)[0];
    assert_eq!(circle.indenters(), neighbours + 1);
    let distances: Vec<f64> = circle.images[0][1..].iter().map(|[x, y]| x.hypot(*y)).collect();
    Localization::new(&distances, system.cell_area())
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
        let localization = localization(&system, neighbours);
        let Sums(sums) = localization.sums;
        assert!((sums[0] - s1).abs() < 1e-4 && (sums[1] - s3).abs() < 1e-4, "{neighbours}: {sums:?}");
        let coupled = Coupled::new(&system, mesh, neighbours + 1, true);
        for rule in [CircleRadius::LoadBalanced, CircleRadius::AreaBalanced] {
            let solution = coupled.solve(Control::MeanPressure(pressure), rule, Some(&start));
            assert_eq!(solution.stop, Stop::Converged);
            // One level: both rules are Eq. (4).
            assert!((solution.spots[0].radius - radius).abs() < 1e-4);
            let predicted = localization.contact(RADIUS, load, 1.0);
            let (a, delta) = (predicted.radius, predicted.penetration);
            let own = system.observe(&solution)[0];
            println!(
                "{neighbours}: δ {:.7} predicted {delta:.7}, a {:.6} predicted {a:.6}",
                solution.penetration, own.contact_radius
            );
            found.push((solution.penetration, delta, own.contact_radius, a));
        }
    }
    // The mesh errs alike for all circles (1e-4): differences are the circle's own, but for what is left of the elements
    // in the outline of each.
    let outline = 2e-3 * mesh.size;
    let last = found[found.len() - 1];
    for (delta, predicted, radius, a) in found {
        assert!(((delta - last.0) - (predicted - last.1)).abs() < 5e-7);
        assert!(((radius - last.2) - (a - last.3)).abs() < outline);
        assert!((delta / predicted - 1.0).abs() < 1e-4 && (radius / a - 1.0).abs() < 3e-4);
    }
}
