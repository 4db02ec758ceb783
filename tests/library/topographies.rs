//! Whether the discretisation errors that are stated of a topography hold: a study has those of indenters.

use crate::common;

use common::{Hills, Random, coated};
use ndarray::Array2;
use percoat::{Cell, Interface, Load, Problem, Settings, Solver, Topography};

const CASES: usize = 20;
const POINTS: usize = 64;
/// Points of the reference over those of the case.
const FINER: usize = 4;
const QUANTITIES: [&str; 5] =
    ["mean pressure", "penetration", "contact fraction", "largest pressure", "elastic energy"];

/// Every case is solved under a load and again under the penetration it has found; the truth is that of a topography
/// given on four times as many points. The penetration is measured from the apex, which is the same on either grid.
#[test]
fn stated_errors_of_topographies_hold_and_say_something() {
    let mut random = Random(67);
    let mut ratios = [const { Vec::new() }; 5];
    for _ in 0..CASES {
        let hills = Hills::random(&mut random, 10, 4, 0.01);
        let interface = random.pick(&[Interface::Bonded, Interface::Frictionless]);
        let half_space = coated(random.log(0.2, 5.0), random.log(0.03, 0.5), [0.3, 0.3], interface);
        let problems =
            [POINTS, FINER * POINTS].map(|points| Problem::new(hills.topography(points), half_space.clone()));
        let read = |points: usize, problem: &Problem, load: Load| {
            let step = Solver::new(problem.clone(), [points; 2], Settings::default()).unwrap().solve(load);
            assert!(step.report.stop.solved(), "{}", step.report);
            let found = step.reading();
            let errors = found.errors;
            let stated = [
                errors.mean_pressure,
                errors.penetration,
                errors.contact_fraction,
                errors.max_pressure,
                errors.elastic_energy,
            ];
            let found = [
                found.mean_pressure.unwrap(),
                found.penetration,
                found.contact_fraction.unwrap(),
                found.max_pressure,
                found.elastic_energy,
            ];
            (found, stated.map(Option::unwrap))
        };
        let by_load = Load::MeanPressure(random.log(1e-4, 0.02));
        let (loaded, _) = read(POINTS, &problems[0], by_load);
        for load in [by_load, Load::Penetration(loaded[1])] {
            let (found, stated) = read(POINTS, &problems[0], load);
            let (exact, _) = read(FINER * POINTS, &problems[1], load);
            for k in 0..5 {
                let error = (found[k] - exact[k]).abs();
                // Prescribed quantities, and complete contact, have no error but rounding.
                if error > 1e-8 * exact[k] {
                    ratios[k].push(stated[k] / error);
                }
            }
        }
    }
    for (name, mut ratios) in QUANTITIES.into_iter().zip(ratios) {
        ratios.sort_by(f64::total_cmp);
        let held = ratios.iter().filter(|&&ratio| ratio >= 1.0).count() as f64 / ratios.len() as f64;
        let median = ratios[ratios.len() / 2];
        println!("{name}: {held:.3} of {}, median of stated over true error {median:.1}", ratios.len());
        assert!(held >= 0.95 && median < 30.0, "{name}: {held} hold, median {median}");
    }
}

/// Roofs, vaults and cones whose kink lies between the samples, against the same shape with the kink at a sample of a finer grid. The penetration is
/// measured from the kink, which the sum of waves through the samples misses; the flanks, which carry the load, are the same in both.
#[test]
fn stated_errors_cover_a_kink_that_touches_first_between_the_samples() {
    const FINE: usize = 256;
    let roof = |[x, _]: [f64; 2]| -0.05 * x.abs();
    let vault = |[x, y]: [f64; 2]| -0.03 * x.abs() - 0.05 * (x * x + y * y);
    let cone = |[x, y]: [f64; 2]| -0.05 * x.hypot(y);
    let all: [&dyn Fn([f64; 2]) -> f64; 3] = [&roof, &vault, &cone];
    let sampled = |n: usize, place: f64, of: &dyn Fn([f64; 2]) -> f64| {
        let at = |k: usize| (k as f64 + place) / n as f64 - 0.5;
        Topography::new(Cell::square(1.0).unwrap(), Array2::from_shape_fn((n, n), |(i, j)| of([at(i), at(j)]))).unwrap()
    };
    let read = |topography: Topography, load: Load| {
        let problem = Problem::new(topography, coated(1.0, 0.1, [0.3, 0.3], Interface::Bonded));
        let step = Solver::new(problem, [FINE; 2], Settings::default()).unwrap().solve(load);
        assert!(step.report.stop.solved(), "{}", step.report);
        step.reading()
    };
    for (name, shape) in ["roof", "vault", "cone"].into_iter().zip(all) {
        let by_load = Load::MeanPressure(2e-3);
        let exact = read(sampled(FINE, 0.0, shape), by_load);
        let by_depth = Load::Penetration(exact.penetration);
        for (n, place) in [(32, 0.5), (48, 0.3), (64, 0.5), (128, 0.5)] {
            let reading = read(sampled(n, place, shape), by_load);
            let (error, stated) = (reading.penetration - exact.penetration, reading.errors.penetration.unwrap());
            assert!(error.abs() <= stated && stated < 0.06 / n as f64, "{name} {n}: {error} {stated}");
            let reading = read(sampled(n, place, shape), by_depth);
            for (found, exact, stated) in [
                (reading.mean_pressure.unwrap(), exact.mean_pressure.unwrap(), reading.errors.mean_pressure),
                (reading.elastic_energy, exact.elastic_energy, reading.errors.elastic_energy),
                (reading.contact_area, exact.contact_area, reading.errors.contact_area),
            ] {
                assert!((found - exact).abs() <= stated.unwrap(), "{name} {n}: {found} {exact} {stated:?}");
            }
        }
    }
}
