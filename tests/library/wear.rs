//! Wear by implicit steps: exact decays, volumes, worn shapes, any length of step.

use crate::common;

use common::{PAPER, bare, coated, paraboloid, relative_difference};
use ndarray::Array2;
use percoat::body::Side;
use percoat::spectral::{Wear, WearError};
use percoat::{
    Bodies, Cell, Friction, GivenPressure, HalfSpace, Indenters, Interface, Lattice, Load, LoadedDisc, Material,
    Method, Problem, Settings, Solver, Step, Topography,
};
use std::f64::consts::{PI, TAU};
use std::ops::ControlFlow;

fn sharp() -> Settings {
    Settings { tolerance: 1e-13, ..Settings::default() }
}

/// Only the counterbody wears.
fn of_counterbody(coefficient: f64) -> Wear {
    Wear::new(0.0, coefficient, [1.0, 0.0]).unwrap()
}

fn force(step: &Step) -> f64 {
    step.pressure().sum() * step.grid().sample_area()
}

fn assert_solved(step: &Step) {
    assert!(step.report.stop.solved(), "{step}");
}

/// Heights with one wave k₁b₁ + k₂b₂ of an amplitude.
fn wavy(cell: Cell, points: [usize; 2], wave: [f64; 2], amplitude: f64) -> Topography {
    let [n1, n2] = points.map(|n| n as f64);
    let height = |(i, j)| amplitude * (TAU * (wave[0] * i as f64 / n1 + wave[1] * j as f64 / n2)).cos();
    Topography::new(cell, Array2::from_shape_fn(points, height)).unwrap()
}

/// The amplitude of a wave in a field.
fn amplitude(field: &Array2<f64>, wave: [f64; 2]) -> f64 {
    let (n1, n2) = field.dim();
    let cosine = |(i, j)| (TAU * (wave[0] * i as f64 / n1 as f64 + wave[1] * j as f64 / n2 as f64)).cos();
    field.indexed_iter().map(|(place, value)| value * cosine(place)).sum::<f64>() * 2.0 / (n1 * n2) as f64
}

fn gap(step: &Step) -> Array2<f64> {
    step.surface().initial_gap().to_owned()
}

/// Each step divides the wave of the shape by 1 + kΔs/Ĉ, with the compliance of the layers.
#[test]
fn a_wave_in_complete_contact_decays_as_the_implicit_formula_has_it() {
    let stacks = [
        coated(40.0, 0.02, [0.2, 0.3], Interface::Bonded),
        coated(0.1, 0.15, [0.4, 0.3], Interface::Bonded),
        coated(3.0, 0.3, [0.5, 0.5], Interface::Bonded),
    ];
    let cell = Cell::hexagonal(1.0).unwrap();
    let [b1, b2] = cell.reciprocal();
    for half_space in stacks {
        for wave in [[1.0, 0.0], [1.0, 2.0]] {
            let q = (wave[0] * b1[0] + wave[1] * b2[0]).hypot(wave[0] * b1[1] + wave[1] * b2[1]);
            let compliance = half_space.response().compliance(q);
            let problem = Problem::new(wavy(cell, [24, 24], wave, 0.01), half_space.clone());
            let load = Load::MeanPressure(2.0 * 0.01 / compliance);
            for steps in [1, 3, 10] {
                // k s/Ĉ = 1.7.
                let distance = 1.7 * compliance / f64::from(steps);
                let mut solver = Solver::new(problem.clone(), [24, 24], sharp()).unwrap();
                let mut last = None;
                for _ in 0..steps {
                    last = Some(solver.wear(load, &of_counterbody(1.0), distance).unwrap());
                }
                let last = last.unwrap();
                assert_solved(&last);
                let factor = (1.0 + 1.7 / f64::from(steps)).powi(-steps);
                let shape = amplitude(&gap(&last), wave) / -0.01;
                let pressure = amplitude(&last.pressure().to_owned(), wave) / (0.01 / compliance);
                assert!((shape / factor - 1.0).abs() < 1e-12, "{steps}: {:e}", shape / factor - 1.0);
                assert!((pressure / factor - 1.0).abs() < 1e-12, "{steps}: {:e}", pressure / factor - 1.0);
            }
        }
    }
}

/// e^{−ks/Ĉ} is met to first order in Δs: halving the step halves the error.
#[test]
fn implicit_steps_tend_to_the_exponential_to_first_order() {
    let (cell, wave) = (Cell::square(1.0).unwrap(), [1.0, 1.0]);
    let half_space = coated(5.0, 0.1, [0.25, 0.3], Interface::Bonded);
    let compliance = half_space.response().compliance(TAU * 2f64.sqrt());
    let error = |steps: u32| {
        let problem = Problem::new(wavy(cell, [24, 24], wave, 0.01), half_space.clone());
        let mut solver = Solver::new(problem, [24, 24], sharp()).unwrap();
        let load = Load::MeanPressure(0.02 / compliance);
        for _ in 0..steps {
            solver.wear(load, &of_counterbody(1.0), compliance / f64::from(steps)).unwrap();
        }
        let left = amplitude(&gap(&solver.solve(load)), wave) / -0.01;
        left / (-1f64).exp() - 1.0
    };
    let errors = [8, 16, 32].map(error);
    // ½ (ks/Ĉ)²/n.
    assert!((errors[2] * 64.0 - 1.0).abs() < 0.05, "{errors:?}");
    assert!(errors.windows(2).all(|pair| (pair[0] / pair[1] - 2.0).abs() < 0.1), "{errors:?}");
}

/// The swept body wears by the mean along the path: crests along it decay as on the counterbody, crests across do not.
#[test]
fn a_swept_body_wears_off_the_crests_along_the_path_alone() {
    let cell = Cell::new([1.0, 0.1], [0.3, 1.2]).unwrap();
    let half_space = coated(5.0, 0.1, [0.25, 0.3], Interface::Bonded);
    let [b1, b2] = cell.reciprocal();
    // The wave b₁ + b₂ is constant along a₁ − a₂.
    let (wave, q) = ([1.0, 1.0], (b1[0] + b2[0]).hypot(b1[1] + b2[1]));
    let compliance = half_space.response().compliance(q);
    let problem = Problem::new(wavy(cell, [27, 27], wave, 0.01), half_space);
    for (parts, decays) in [([1.0, -1.0], true), ([1.0, 0.0], false), ([1.0, 1.0], false), ([1.0, 2f64.sqrt()], false)]
    {
        let mut solver = Solver::new(problem.clone(), [27, 27], sharp()).unwrap();
        let wear = Wear::new(2.0, 0.0, cell.vector(parts)).unwrap();
        let before = solver.surface().initial_gap().to_owned();
        let step = solver.wear(Load::MeanPressure(0.02 / compliance), &wear, compliance).unwrap();
        assert_solved(&step);
        let left = amplitude(&gap(&step), wave) / -0.01;
        let expected = if decays { 1.0 / 3.0 } else { 1.0 };
        assert!((left / expected - 1.0).abs() < 1e-12, "{parts:?}: {left}");
        assert!(decays || relative_difference(&gap(&step), &before) < 1e-12);
    }
}

/// A ball whose wear exceeds its elastic deformation by far is cut off flat, πa⁴/4R = k s P, and presses with p = P/πa². The area is
/// counted by samples, to the order of one spacing of its rim.
#[test]
fn a_worn_ball_has_a_flat_of_the_worn_volume_under_a_uniform_pressure() {
    let stiff = HalfSpace::new(vec![], Material::from_young(1e7, 0.3).unwrap());
    let (radius, load) = (2.0, 1.0);
    for points in [32, 64, 128] {
        let lattice = Lattice::square(1.0, 1).unwrap();
        let indenters = Indenters::new(lattice, vec![paraboloid(radius, 0.0)]).unwrap();
        let mut solver = Solver::new(Problem::new(indenters, stiff.clone()), [points; 2], Settings::default()).unwrap();
        let a = 0.3f64;
        let path = PI * a.powi(4) / (4.0 * radius * load);
        // Most of the path at once, then steps so small that the rim, which they have reached newly, is narrow.
        let mut step = solver.wear(Load::Force(load), &of_counterbody(1.0), 0.98 * path).unwrap();
        for _ in 0..2 {
            step = solver.wear(Load::Force(load), &of_counterbody(1.0), 0.01 * path).unwrap();
        }
        assert_solved(&step);
        let pressed: Vec<f64> = step.pressure().iter().copied().filter(|&p| p > 0.0).collect();
        let found = (pressed.len() as f64 * step.grid().sample_area() / PI).sqrt();
        let spacing = 1.0 / points as f64;
        assert!((found / a - 1.0).abs() < 0.25 * spacing / a, "{points}: {found}");
        let uniform = load / (PI * a * a);
        let within = step.surface().grid();
        let middle = |index: usize| {
            let [s, t] = within.fractions(index).map(|s| s - s.round());
            s.hypot(t) < a - 1.5 * spacing
        };
        let middle =
            step.pressure().iter().enumerate().filter(|(index, _)| middle(*index)).map(|(_, p)| *p).collect::<Vec<_>>();
        let error = middle.iter().fold(0.0f64, |most, p| most.max((p / uniform - 1.0).abs()));
        assert!(error < 0.05, "{points}: {error}");
        let volume = solver.worn().unwrap().volume(Side::Counterbody);
        assert!((volume / (path * load) - 1.0).abs() < 1e-12, "{volume}");
    }
}

/// Problems of every kind, with a load and the wear of both surfaces.
fn kinds() -> Vec<(&'static str, Problem, [usize; 2], Load, Wear)> {
    let case = PAPER[0];
    let oblique = Lattice::new(Cell::new([1.0, 0.2], [0.3, 1.1]).unwrap(), vec![vec![[0.1, 0.2]], vec![[0.6, 0.7]]]);
    let oblique = Indenters::new(oblique.unwrap(), vec![paraboloid(0.8, 0.01), paraboloid(0.8, 0.0)]).unwrap();
    let window = Lattice::new(Cell::window([2.4, 2.0]).unwrap(), vec![vec![[0.5; 2]]]).unwrap();
    let ball = || Indenters::new(window.clone(), vec![paraboloid(1.0, 0.0)]).unwrap();
    let friction = Friction::new(0.4, [1.0, 0.0]).unwrap();
    let rigid = HalfSpace::on_rigid_base(case.half_space().layers().to_vec()).unwrap();
    let both = Bodies::elastic(bare(), case.half_space());
    let wear = |direction| Wear::new(0.3, 0.5, direction).unwrap();
    vec![
        ("three levels", case.problem(), [48, 48], Load::MeanPressure(case.pressure), wear([1.0, 0.0])),
        ("odd grid", case.problem(), [45, 45], Load::MeanPressure(case.pressure), wear([0.5, 0.75f64.sqrt()])),
        ("unequal grid", case.problem(), [50, 45], Load::MeanPressure(case.pressure), wear([0.0, 1.0])),
        ("off the lattice", case.problem(), [48, 48], Load::MeanPressure(case.pressure), wear([1.0, 0.123])),
        ("oblique", Problem::new(oblique, bare()), [40, 49], Load::MeanPressure(0.02), wear([1.0, 0.2])),
        ("penetration", case.problem(), [48, 48], Load::Penetration(0.03), wear([1.0, 0.0])),
        ("coupled", case.problem().sliding(friction).unwrap(), [48, 48], Load::MeanPressure(0.06), wear([1.0, 0.0])),
        ("rigid base", Problem::new(case.indenters(), rigid), [48, 48], Load::MeanPressure(0.06), wear([1.0, 0.0])),
        ("two bodies", Problem::new(case.indenters(), both), [48, 48], Load::MeanPressure(0.06), wear([1.0, 0.0])),
        ("isolated", Problem::new(ball(), bare()), [48, 40], Load::Force(0.1), wear([1.0, 0.0])),
        ("isolated, across", Problem::new(ball(), case.half_space()), [48, 40], Load::Force(0.1), wear([0.0, 1.0])),
        ("isolated, penetration", Problem::new(ball(), bare()), [48, 40], Load::Penetration(0.1), wear([1.0, 0.0])),
        (
            "isolated, coupled",
            Problem::new(ball(), bare()).sliding(friction).unwrap(),
            [48, 40],
            Load::Force(0.1),
            wear([1.0, 0.0]),
        ),
    ]
}

/// Σ depth = k s P on either side to rounding, under the forces of the steps; and an independent solver with the gap of the worn
/// surfaces finds the pressure and the penetration of the step.
#[test]
fn volumes_balance_and_the_pressure_solves_the_contact_of_the_worn_surfaces() {
    for (name, problem, points, load, wear) in kinds() {
        let settings = Settings { tolerance: 1e-10, ..Settings::default() };
        let mut solver = Solver::new(problem.clone(), points, settings).unwrap();
        let (mut work, mut step) = (0.0, None);
        for distance in [0.01, 0.02, 0.04] {
            let solved = solver.wear(load, &wear, distance).unwrap();
            assert_solved(&solved);
            work += distance * force(&solved);
            step = Some(solved);
        }
        let (step, worn) = (step.unwrap(), solver.worn().unwrap().clone());
        for (side, coefficient) in [(Side::Body, 0.3), (Side::Counterbody, 0.5)] {
            let volume = worn.volume(side);
            assert!((volume / (coefficient * work) - 1.0).abs() < 1e-13, "{name}, {side}: {volume}");
        }
        assert_eq!(worn.distance(), 0.01 + 0.02 + 0.04);
        let unworn = Solver::new(problem.clone(), points, settings).unwrap().surface().initial_gap().to_owned();
        let depth = &worn.depth(Side::Body) + &worn.depth(Side::Counterbody) - worn.recession();
        let scale = unworn.iter().copied().fold(0.0, f64::max);
        let difference = (&(&unworn + &depth) - &gap(&step)).iter().fold(0.0f64, |most, x| most.max(x.abs()));
        assert!(difference < 2e-15 * scale, "{name}: {difference:e}");
        let mut independent = Solver::new(problem, points, settings).unwrap().with_gap(gap(&step)).unwrap();
        let load = match load {
            Load::Penetration(_) => Load::Penetration(step.penetration()),
            load => load,
        };
        let again = independent.solve(load);
        assert_solved(&again);
        let difference = relative_difference(again.pressure(), step.pressure());
        assert!(difference < 1e-5, "{name}: {difference:e}, {step}");
        assert!((again.penetration() / step.penetration() - 1.0).abs() < 1e-7, "{name}");
        assert!((again.elastic_energy() / step.elastic_energy() - 1.0).abs() < 1e-6, "{name}");
    }
}

/// 10⁶ times the path in which wear removes the elastic deformation, in one step and on: solved, balanced, and nearly uniform pressure.
#[test]
fn a_step_of_any_length_is_stable() {
    for (name, problem, points, load, _) in kinds() {
        if problem.kind().is_indentation() || !load.is_load_control() {
            continue;
        }
        for (wear, factor) in [(0.0, 1e6), (0.0, 1.0), (0.5, 1e6), (1e-7, 1e6)] {
            let wear = Wear::new(wear, 1.0, [1.0, 0.0]).unwrap();
            let mut solver = Solver::new(problem.clone(), points, Settings::default()).unwrap();
            let mut step = solver.wear(load, &wear, factor).unwrap();
            assert_solved(&step);
            for _ in 0..3 {
                step = solver.wear(load, &wear, factor).unwrap();
                assert_solved(&step);
                assert!(step.report.iterations <= 40, "{name}, {factor}: {step}");
            }
            let mean = step.pressure().mean().unwrap();
            let error = step.pressure().iter().fold(0.0f64, |most, p| most.max((p / mean - 1.0).abs()));
            assert!(factor == 1.0 || error < 1e-5, "{name}, {factor}: {error:e}");
        }
    }
}

/// An isolated ball under a huge step: the wear of both surfaces opens a groove, contact stays in the window.
#[test]
fn a_groove_is_constant_along_the_path() {
    let (_, problem, points, load, _) = kinds().remove(9);
    let mut solver = Solver::new(problem.clone(), points, Settings::default()).unwrap();
    let unworn = solver.solve(load);
    let wear = Wear::new(0.4, 0.0, [-3.0, 0.0]).unwrap();
    let step = solver.wear(load, &wear, 0.1).unwrap();
    assert_solved(&step);
    let worn = solver.worn().unwrap();
    let depth = worn.depth(Side::Body);
    for (j, groove) in depth.columns().into_iter().enumerate() {
        assert!(groove.iter().all(|depth| *depth == groove[0]), "line {j}");
        let sum: f64 = step.pressure().column(j).sum();
        assert!((groove[0] - 0.04 * sum / 48.0).abs() <= 1e-15 * worn.largest(Side::Body));
    }
    assert!(worn.largest(Side::Counterbody) == 0.0 && depth[[0, 0]] == 0.0);
    let peak = |step: &Step| step.pressure().iter().copied().fold(0.0, f64::max);
    assert!(peak(&step) < 0.999 * peak(&unworn));
    // A stroke to and fro over half the width passes each point twice as often.
    let mut short = Solver::new(problem.clone(), points, Settings::default()).unwrap();
    let half = short.wear(load, &wear.with_stroke(1.2).unwrap(), 0.05).unwrap();
    // The solver starts from no pressure: equal to the tolerance.
    assert!(relative_difference(half.pressure(), step.pressure()) < 1e-5);
    let oblique = Wear::new(0.4, 0.0, [1.0, 1.0]).unwrap();
    assert_eq!(short.wear(load, &oblique, 0.1).unwrap_err(), WearError::Oblique([1.0, 1.0]));
    let counterbody = Wear::new(0.0, 0.4, [1.0, 1.0]).unwrap();
    assert_solved(&short.wear(load, &counterbody, 0.1).unwrap());
}

/// Levels of different heights wear until each carries what its part of the cell does, under a uniform pressure.
#[test]
fn levels_wear_until_lower_ones_carry_alike() {
    let case = PAPER[0];
    let load = Load::MeanPressure(case.pressure);
    let mut solver = Solver::new(case.problem(), [96, 96], Settings::default()).unwrap();
    // Share of each level in the load, and in the samples.
    let shares = |step: &Step| {
        let (mut load, mut area) = ([0.0; 3], [0.0; 3]);
        for (index, &pressure) in step.pressure().iter().enumerate() {
            let level = step.surface().level_at(index) - 1;
            load[level] += pressure;
            area[level] += 1.0;
        }
        let share = |parts: [f64; 3]| parts.map(|part| part / parts.iter().sum::<f64>());
        (share(load), share(area))
    };
    let mut lowest = vec![shares(&solver.solve(load)).0[2]];
    for n in 0..12 {
        let step = solver.wear(load, &of_counterbody(1.0), 0.05 * 2f64.powi(n)).unwrap();
        assert_solved(&step);
        lowest.push(shares(&step).0[2]);
    }
    assert!(1.2 * lowest[0] < lowest[12] && lowest.windows(2).all(|pair| pair[1] > pair[0] - 1e-6), "{lowest:?}");
    let step = solver.solve(load);
    let (load, area) = shares(&step);
    assert!((0..3).all(|level| (load[level] / area[level] - 1.0).abs() < 0.01), "{load:?} {area:?}");
    let error = step.pressure().iter().fold(0.0f64, |most, p| most.max((p / case.pressure - 1.0).abs()));
    assert!(error < 0.02, "{error}");
}

/// Partial contact: steps of half the length have half the error.
#[test]
fn steps_are_of_first_order_in_partial_contact_too() {
    let case = PAPER[0];
    let worn = |steps: u32| {
        let mut solver =
            Solver::new(case.problem(), [48, 48], Settings { tolerance: 1e-11, ..Settings::default() }).unwrap();
        for _ in 0..steps {
            solver.wear(Load::MeanPressure(0.03), &of_counterbody(1.0), 0.2 / f64::from(steps)).unwrap();
        }
        let worn = solver.worn().unwrap();
        worn.depth(Side::Counterbody).to_owned()
    };
    let exact = worn(256);
    let mean = |field: Array2<f64>| field.iter().map(|x| x.abs()).sum::<f64>();
    let errors = [4, 8, 16].map(|steps| mean(&worn(steps) - &exact));
    // Against 256 steps the ratios of first order are 63/31 and 31/15.
    let ratios = [errors[0] / errors[1], errors[1] / errors[2]];
    assert!(ratios.iter().all(|ratio| (1.7..2.4).contains(ratio)), "{ratios:?}");
}

#[test]
fn no_path_and_no_coefficient_wear_nothing() {
    let case = PAPER[0];
    let load = Load::MeanPressure(case.pressure);
    let mut plain = Solver::new(case.problem(), [48, 48], Settings::default()).unwrap();
    let expected = plain.solve(load);
    for (coefficient, distance) in [(1.0, 0.0), (0.0, 1.0)] {
        let mut solver = Solver::new(case.problem(), [48, 48], Settings::default()).unwrap();
        let step = solver.wear(load, &of_counterbody(coefficient), distance).unwrap();
        assert_eq!((step.pressure(), step.gap()), (expected.pressure(), expected.gap()));
        assert_eq!(gap(&step), gap(&expected));
        assert_eq!(step.penetration(), expected.penetration());
    }
}

/// After its return a solver has the bits of one that has never worn, whatever the step was.
#[test]
fn a_solver_returns_to_its_state_and_its_operator_bit_for_bit() {
    for (name, problem, points, load, wear) in kinds() {
        let mut plain = Solver::new(problem.clone(), points, Settings::default()).unwrap();
        let mut worn = Solver::new(problem, points, Settings::default()).unwrap();
        let first = [plain.solve(load), worn.solve(load)];
        assert_eq!(first[0].pressure(), first[1].pressure(), "{name}");
        let state = worn.wear_state();
        for distance in [1e-3, 1e3] {
            let step = worn.wear(load, &wear, distance).unwrap();
            assert!(step.report.stop.solved() || name.starts_with("isolated"), "{name}: {step}");
        }
        worn.return_to(state);
        assert!(worn.worn().is_none());
        let half = match load {
            Load::MeanPressure(mean) => Load::MeanPressure(0.5 * mean),
            Load::Force(force) => Load::Force(0.5 * force),
            load => Load::Penetration(0.5 * load.value()),
        };
        let [one, other] = [&mut plain, &mut worn].map(|solver| solver.solve(half));
        assert_eq!((one.pressure(), one.gap()), (other.pressure(), other.gap()), "{name}");
    }
}

#[test]
fn worn_depths_do_not_depend_on_the_number_of_threads() {
    for number in [0, 2, 9] {
        let depths = [1, 3].map(|threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let (_, problem, points, load, wear) = kinds().remove(number);
                let mut solver = Solver::new(problem, points, Settings::default()).unwrap();
                solver.wear(load, &wear, 0.01).unwrap();
                let step = solver.wear(load, &wear, 0.02).unwrap();
                let worn = solver.worn().unwrap();
                (step.pressure().to_owned(), worn.depth(Side::Body).to_owned(), worn.recession())
            })
        });
        assert_eq!(depths[0], depths[1]);
    }
}

/// The baseline wears alike.
#[test]
fn the_baseline_wears_alike() {
    let case = PAPER[0];
    let load = Load::MeanPressure(case.pressure);
    let wear = Wear::new(0.2, 0.3, [1.0, 0.0]).unwrap();
    let steps = [Method::Preconditioned, Method::PolonskyKeer].map(|method| {
        let settings = Settings { method, ..Settings::default() };
        let mut solver = Solver::new(case.problem(), [48, 48], settings).unwrap();
        solver.wear(load, &wear, 0.1).unwrap()
    });
    assert!(relative_difference(steps[1].pressure(), steps[0].pressure()) < 1e-4);
}

#[test]
fn a_step_that_is_not_solved_wears_nothing() {
    let case = PAPER[0];
    let load = Load::MeanPressure(case.pressure);
    let mut solver = Solver::new(case.problem(), [48, 48], Settings::default()).unwrap();
    let before = solver.surface().initial_gap().to_owned();
    let mut stop = |_| ControlFlow::Break(());
    let step = solver.wear_with_progress(load, &of_counterbody(1.0), 0.1, &mut stop).unwrap();
    assert!(!step.report.stop.solved() && solver.worn().is_none());
    assert_eq!(solver.surface().initial_gap(), before);
    assert_eq!(solver.wear(load, &of_counterbody(1.0), -1.0).unwrap_err(), WearError::Distance(-1.0));
    let disc = LoadedDisc { centre: [0.5, 0.5], radius: 0.1, pressure: 1.0 };
    let given = GivenPressure::discs(Cell::square(1.0).unwrap(), vec![disc]).unwrap();
    let mut given = Solver::new(Problem::new(given, bare()), [24, 24], Settings::default()).unwrap();
    assert_eq!(given.wear(load, &of_counterbody(1.0), 1.0).unwrap_err(), WearError::Given);
}
