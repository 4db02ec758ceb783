//! Sliding contact: against a closed form, against the sum it stands for, and against itself turned around.

use crate::common;

use common::{Hills, PAPER, Random, bare, coated, one_level, paraboloid, relative_difference, solve, solve_sharply};
use ndarray::{Array2, Axis};
use percoat::body::InterfaceId;
use percoat::spectral::{LayeredOperator, Workspace};
use percoat::{
    Cell, Friction, FrictionError, Grid, HalfSpace, Interface, Lattice, Load, Material, Problem, Route, Settings,
    Solver, Topography,
};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

fn friction(coefficient: f64, degrees: f64) -> Friction {
    Friction::new(coefficient, [degrees.to_radians().cos(), degrees.to_radians().sin()]).unwrap()
}

/// w(x) = Σ_q (C − iμ **e**·**n** K) p̂(q) e^{iq·x}, over all shortest aliases of each component.
#[test]
fn a_displacement_under_friction_is_the_direct_sum_over_wavevectors() {
    let half_space = coated(0.3, 0.2, [0.1, 0.4], Interface::Bonded);
    let sliding = friction(0.7, 33.0);
    let [fx, fy] = sliding.traction();
    for (cell, [n1, n2]) in [
        (Cell::hexagonal(1.0).unwrap(), [6, 6]),
        (Cell::hexagonal(1.0).unwrap(), [9, 9]),
        (Cell::square(0.7).unwrap(), [5, 8]),
        (Cell::square(1.0).unwrap(), [1, 7]),
        (Cell::new([1.0, 0.2], [1.4, 0.9]).unwrap(), [7, 6]),
    ] {
        let grid = Arc::new(Grid::new(cell, [n1, n2]).unwrap());
        let mut random = Random(77);
        let pressure: Vec<f64> = (0..n1 * n2).map(|_| random.unit()).collect();
        let mut displacement = pressure.clone();
        let mut operator = LayeredOperator::sliding(&grid, &half_space, &sliding);
        operator.displacement(&mut displacement, &mut Workspace::default());

        let [b1, b2] = cell.reciprocal();
        let aliases = |k1: usize, k2: usize| -> Vec<[f64; 2]> {
            let around = (-5..=5).flat_map(|m1| (-5..=5).map(move |m2| [m1, m2]));
            let wavevector = |[m1, m2]: [i32; 2]| {
                let (u, v) = (k1 as f64 + f64::from(m1) * n1 as f64, k2 as f64 + f64::from(m2) * n2 as f64);
                [u * b1[0] + v * b2[0], u * b1[1] + v * b2[1]]
            };
            let all: Vec<[f64; 2]> = around.map(wavevector).collect();
            let least = all.iter().map(|[x, y]| x.hypot(*y)).fold(f64::INFINITY, f64::min);
            all.into_iter().filter(|[x, y]| x.hypot(*y) < least * (1.0 + 1e-9)).collect()
        };
        let symbols: Vec<[f64; 2]> = (0..n1 * n2)
            .map(|k| {
                if k == 0 {
                    return [0.0; 2];
                }
                let aliases = aliases(k / n2, k % n2);
                let [x, y] = aliases[0];
                let response = half_space.response().surface(x.hypot(y));
                let cosines: f64 = aliases.iter().map(|[x, y]| (fx * x + fy * y) / x.hypot(*y)).sum();
                [response.normal, -response.coupling * cosines / aliases.len() as f64]
            })
            .collect();
        for (i, j) in (0..n1).flat_map(|i| (0..n2).map(move |j| (i, j))) {
            let mut direct = 0.0;
            for (k1, k2) in (0..n1).flat_map(|i| (0..n2).map(move |j| (i, j))) {
                let [re, im] = symbols[k1 * n2 + k2];
                for (i0, j0) in (0..n1).flat_map(|i| (0..n2).map(move |j| (i, j))) {
                    let phase = TAU
                        * ((k1 as f64 * (i as f64 - i0 as f64)) / n1 as f64
                            + (k2 as f64 * (j as f64 - j0 as f64)) / n2 as f64);
                    direct += (re * phase.cos() - im * phase.sin()) * pressure[i0 * n2 + j0] / (n1 * n2) as f64;
                }
            }
            let error = (displacement[i * n2 + j] - direct).abs();
            assert!(error < 1e-14, "{cell}, {n1} × {n2}: {} against {direct}", displacement[i * n2 + j]);
        }
        // And back, up to the mean.
        operator.pressure(&mut displacement, &mut Workspace::default());
        let mean = pressure.iter().sum::<f64>() / pressure.len() as f64;
        let deviations: Vec<f64> = pressure.iter().map(|p| p - mean).collect();
        assert!(relative_difference(&displacement, &deviations) < 1e-13, "{cell}, {n1} × {n2}");
    }
}

/// A rigid wave h = Δ(1 − cos 2πx/λ) on a bare half-space, one period on n × 4 samples.
fn wave(n: usize, beta_friction: f64) -> (Problem, f64) {
    let (delta, material) = (0.01, Material::from_young(1.0, 0.3).unwrap());
    let heights = Array2::from_shape_fn([n, 4], |(i, _)| delta * ((TAU * i as f64 / n as f64).cos() - 1.0));
    let cell = Cell::new([1.0, 0.0], [0.0, 0.25]).unwrap();
    let counterbody = Topography::new(cell, heights).unwrap();
    // β = (1 − 2ν)/(2(1 − ν)), p* = πE*Δ/λ.
    let sliding = friction(beta_friction * 1.4 / 0.4, 0.0);
    let problem = Problem::new(counterbody, HalfSpace::new(vec![], material)).sliding(sliding).unwrap();
    (problem, PI * material.contact_modulus() * delta)
}

/// f = μβ, p̄/p*, then ψ₁/π, ψ₂/π, p_max/p* and where it is over λ, from the closed form of the sliding wave
/// (`validation/sliding-wave`): p = 2p* cos(πη) sin(ψ+ψ₁)^{½+η} sin(ψ₂−ψ)^{½−η} cos(ψ+σ).
const WAVE: [[f64; 6]; 6] = [
    [0.1, 0.1, 0.107_866_18, 0.097_419_26, 0.631_519_23, -0.010_384],
    [0.1, 0.5, 0.260_867_56, 0.240_629_43, 1.410_949_09, -0.015_395],
    [0.3, 0.1, 0.119_892_40, 0.088_909_83, 0.624_289_71, -0.030_790],
    [0.3, 0.5, 0.286_685_07, 0.226_568_09, 1.385_973_66, -0.045_211],
    [0.3, 0.9, 0.462_280_17, 0.379_380_89, 1.856_953_43, -0.046_383],
    // Beyond what the traction follows: splitting.
    [1.2, 0.3, 0.321_935_65, 0.150_794_51, 0.891_963_27, -0.135_238],
];

#[test]
fn the_sliding_wave_has_its_closed_form() {
    let n = 1024;
    for [f, mean, trailing, leading, most, place] in WAVE {
        let (problem, unit) = wave(n, f);
        let (step, reading) = solve(&problem, [n, 4], Load::MeanPressure(mean * unit));
        assert!(step.report.stop.solved() && step.report.outer > 0, "{}", step.report);
        assert_eq!(step.report.route == Route::Splitting, f > 0.4, "{}", step.report);
        let pressure: Vec<f64> = step.pressure().column(0).iter().map(|p| p / unit).collect();
        for column in step.pressure().axis_iter(Axis(1)) {
            assert!(column.iter().zip(&pressure).all(|(p, first)| (p / unit - first).abs() < 1e-12));
        }
        // The trailing edge is behind, at −ψ₁; a sample at the edge may be in contact or not.
        let within = |from: f64, to: f64| {
            let samples = (-(n as i64) / 2..n as i64 / 2).filter(|&i| {
                let x = i as f64 / n as f64;
                from < x && x < to && pressure[i.rem_euclid(n as i64) as usize] > 0.0
            });
            samples.count() as f64 / n as f64
        };
        let edge = 1.5 / n as f64;
        // Read at edges of other powers than ½ as if they were: no worse than counting samples.
        let area = reading.contact_fraction.unwrap() - trailing - leading;
        assert!(area.abs() < 1.0 / n as f64, "f = {f}: the contact is off by {:e} samples", area * n as f64);
        assert!((within(-0.6, 0.0) - trailing).abs() < edge && (within(0.0, 0.6) - leading).abs() < edge, "f = {f}");
        let peak = (0..n).max_by(|&a, &b| pressure[a].total_cmp(&pressure[b])).unwrap();
        // The pressure ends like d^{½+η} behind: of n samples in contact the peak errs as n^{−3/2−η}.
        let order = 1.5 - f.atan() / PI;
        let error = 2.0 * ((leading + trailing) * n as f64).powf(-order) * most;
        assert!((pressure[peak] - most).abs() < error, "f = {f}, p̄ = {mean}: {} against {most}", pressure[peak]);
        let x = peak as f64 / n as f64;
        let x = if x > 0.5 { x - 1.0 } else { x };
        assert!((x - place).abs() < 3.0 / n as f64, "f = {f}, p̄ = {mean}: at {x}, not {place}");
    }
}

/// ½⟨d, Cd⟩ with d = p − p* is at most the gap Σ p (g − min g), and in complete contact ½⟨g, C⁻¹g⟩: of rough surfaces in
/// partial and in complete contact, against steps a thousand times sharper, for loose tolerances.
#[test]
fn the_certificate_bounds_the_elastic_energy_of_the_error() {
    let half_space = || coated(2.0, 0.2, [0.0, 0.3], Interface::Bonded);
    let problem = |coefficient: f64| {
        let surface = Hills::random(&mut Random(5), 8, 3, 0.01).topography(48);
        Problem::new(surface, half_space()).sliding(friction(coefficient, 25.0)).unwrap()
    };
    let complete = Solver::new(problem(1.5), [48, 48], Settings::default()).unwrap().full_contact_pressure();
    let mut judged = [0; 2];
    for coefficient in [0.5, 1.5, 5.0] {
        for mean in [0.1, 0.5, 0.97, 1.5].map(|part| part * complete) {
            let solved = |tolerance: f64| {
                let settings = Settings { tolerance, ..Settings::default() };
                Solver::new(problem(coefficient), [48, 48], settings).unwrap().solve(Load::MeanPressure(mean))
            };
            let sharp = solved(1e-12);
            assert!(sharp.report.stop.solved(), "{}", sharp.report);
            let mut operator = LayeredOperator::new(sharp.grid(), half_space());
            let mut elastic = |field: Array2<f64>| {
                let mut displacement: Vec<f64> = field.iter().copied().collect();
                operator.displacement(&mut displacement, &mut Workspace::default());
                field.iter().zip(&displacement).map(|(p, w)| 0.5 * p * w).sum::<f64>()
            };
            for tolerance in [1e-2, 1e-3, 1e-4] {
                let loose = solved(tolerance);
                let (error, energy) =
                    (elastic(&loose.pressure() - &sharp.pressure()), elastic(loose.pressure().to_owned()));
                let bound = loose.certificate.energy_gap * energy;
                assert!(error <= bound * (1.0 + 1e-9) + 1e-13 * energy, "{coefficient} {mean}: {error:e} {bound:e}");
                judged[usize::from(mean > complete)] += usize::from(error > 1e-12 * energy);
            }
        }
    }
    assert!(judged.iter().all(|&count| count > 3), "{judged:?}: there is little to bound");
}

#[test]
fn contact_of_the_sliding_wave_is_complete_from_its_load_on() {
    for f in [0.0, 0.1, 0.3, 1.2] {
        let (problem, unit) = wave(64, f);
        let mut solver = Solver::new(problem, [64, 4], Settings::default()).unwrap();
        // p* cos(atan f), at the trough between the samples: the cosine of half a step is 1 − 5e-3 at most.
        let complete = solver.full_contact_pressure() / (unit / f.hypot(1.0));
        assert!(complete <= 1.0 + 1e-12 && complete > (PI / 64.0).cos(), "f = {f}: {complete}");
        let step = solver.solve(Load::MeanPressure(1.1 * unit));
        assert!(step.report.stop.solved() && step.pressure().iter().all(|&p| p > 0.0), "{}", step.report);
        // p = p̄ + p* cos(atan f) cos(2πx/λ + atan f).
        for (i, p) in step.pressure().column(0).iter().enumerate() {
            let expected = 1.1 + (TAU * i as f64 / 64.0 + f.atan()).cos() / f.hypot(1.0);
            assert!((p / unit - expected).abs() < 1e-7, "f = {f}, {i}: {} against {expected}", p / unit);
        }
    }
}

/// Rotation by 60° about a site: s₁a₁ + s₂a₂ → −s₂a₁ + (s₁ + s₂)a₂.
#[test]
fn turning_the_direction_with_the_lattice_turns_the_pressure_to_round_off() {
    for (n, coefficient) in [(60, 0.5), (45, 0.5), (60, 3.0)] {
        let solved = |degrees: f64| {
            let indenters = one_level(Lattice::hexagonal(1.0, 1).unwrap(), paraboloid(0.8, 0.0));
            let half_space = coated(0.5, 0.2, [0.0, 0.3], Interface::Bonded);
            let problem = Problem::new(indenters, half_space).sliding(friction(coefficient, degrees)).unwrap();
            let settings = Settings { tolerance: 1e-13, ..Settings::default() };
            let step = Solver::new(problem, [n, n], settings).unwrap().solve(Load::MeanPressure(0.04));
            assert!(step.report.stop.solved(), "{}", step.report);
            step.pressure().to_owned()
        };
        let (here, there, back) = (solved(10.0), solved(70.0), solved(190.0));
        let turned = Array2::from_shape_fn([n, n], |(i, j)| there[[(n - j) % n, (i + j) % n]]);
        assert!(relative_difference(&turned, &here) < 1e-10, "μ = {coefficient}, {n}");
        let opposite = Array2::from_shape_fn([n, n], |(i, j)| back[[(n - i) % n, (n - j) % n]]);
        assert!(relative_difference(&opposite, &here) < 1e-10, "μ = {coefficient}, {n}");
        assert!(relative_difference(&back, &here) > 1e-3, "friction must show");
    }
}

#[test]
fn a_direction_along_a_mirror_keeps_the_mirror() {
    // (s₁, s₂) → (s₂, s₁) mirrors a hexagonal cell at a₁ + a₂, which points to 30°.
    let n = 54;
    let problem = PAPER[0].problem().sliding(friction(0.6, 30.0)).unwrap();
    let (step, _) = solve_sharply(&problem, [n, n], Load::MeanPressure(0.06));
    assert!(relative_difference(step.pressure().t(), step.pressure()) < 1e-10);
}

/// β = 0: the traction displaces nothing vertically.
#[test]
fn an_incompressible_half_space_is_not_coupled() {
    let incompressible = HalfSpace::new(vec![], Material::from_young(1.0, 0.5).unwrap());
    let indenters = || one_level(Lattice::square(1.0, 1).unwrap(), paraboloid(0.8, 0.0));
    let rest = Problem::new(indenters(), incompressible);
    let load = Load::MeanPressure(0.02);
    let (still, _) = solve(&rest, [48, 48], load);
    let (moving, _) = solve(&rest.clone().sliding(friction(1.0, 20.0)).unwrap(), [48, 48], load);
    assert!(moving.pressure() == still.pressure() && moving.report.outer == 0);
    // Uncoupled friction leaves any pressure as it is.
    let rest = Problem::new(indenters(), bare());
    let (still, _) = solve(&rest, [48, 48], load);
    let (moving, _) = solve(&rest.clone().sliding(friction(1.0, 20.0).uncoupled()).unwrap(), [48, 48], load);
    assert!(moving.pressure() == still.pressure());
    let (none, _) = solve(&rest.sliding(friction(0.0, 20.0)).unwrap(), [48, 48], load);
    assert!(none.pressure() == still.pressure());
}

/// On rough contacts too: no more than 8 outer iterations and 2.5 times the convolutions of frictionless contact at μ = 0.5,
/// cold and warm, and under the other control.
#[test]
fn friction_costs_little_and_displacement_control_agrees_with_load_control() {
    let (n, mut compared) = (192, 0);
    let hills = || Hills::random(&mut Random(5), 40, 9, 0.05).topography(n);
    let stacks =
        [bare(), coated(20.0, 0.02, [0.2, 0.3], Interface::Bonded), coated(0.1, 0.05, [0.2, 0.3], Interface::Bonded)];
    for half_space in stacks {
        let rest = Problem::new(hills(), half_space);
        let slides = rest.clone().sliding(friction(0.5, 65.0)).unwrap();
        let [mut still, mut moving] =
            [rest, slides.clone()].map(|problem| Solver::new(problem, [n, n], Settings::default()).unwrap());
        for load in [0.01, 0.02, 0.06].map(Load::MeanPressure) {
            let (still, moving) = (still.solve(load), moving.solve(load));
            assert!(moving.report.stop.solved() && moving.report.outer <= 8, "{}", moving.report);
            let ratio = moving.convolutions / still.convolutions;
            assert!(ratio < 2.5, "{load}: {ratio}, {} after {}", moving.report, still.report);
            let given = Load::Penetration(moving.penetration());
            let mut other = Solver::new(slides.clone(), [n, n], Settings::default()).unwrap();
            if moving.penetration() > 0.999 * other.full_contact_penetration() {
                continue;
            }
            let other = other.solve(given);
            assert!(other.report.stop.solved(), "{}", other.report);
            assert!(relative_difference(other.pressure(), moving.pressure()) < 1e-4);
            compared += 1;
        }
    }
    assert!(compared >= 6, "both controls were compared {compared} times");
}

#[test]
fn what_slides_must_be_held() {
    let rest = Problem::new(
        one_level(Lattice::square(1.0, 1).unwrap(), paraboloid(0.8, 0.0)),
        coated(2.0, 0.1, [0.2, 0.3], Interface::Frictionless),
    );
    assert_eq!(rest.clone().sliding(friction(0.1, 0.0)), Err(FrictionError::Unheld(InterfaceId::numbered(1))));
    assert!(rest.sliding(friction(0.0, 0.0)).is_ok());
}
