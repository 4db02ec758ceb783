//! The solver: complementarity, certificate, stop reasons, iteration counts, and robustness against the baseline.

use crate::common;

use common::{PAPER, Random, bare, coated, one_level, paraboloid, relative_difference, solve, solve_with};
use ndarray::Array2;
use percoat::spectral::{LayeredOperator, Workspace};
use percoat::{
    Cell, Counterbody, FieldError, HalfSpace, Indenters, Interface, Lattice, Layer, Level, Load, Material, Method,
    Problem, Reading, Route, Settings, Shape, Solver, Step, Stop, Topography,
};
use std::f64::consts::TAU;

fn baseline() -> Settings {
    Settings { method: Method::PolonskyKeer, ..Settings::default() }
}

#[test]
fn solutions_are_complementary_and_carry_their_load() {
    for case in PAPER {
        let (step, reading) = solve(&case.problem(), [120, 120], Load::MeanPressure(case.pressure));
        assert_eq!(step.report.stop, Stop::Converged);
        let (p, g) = (step.pressure(), step.gap());
        assert!(p.iter().all(|&p| p >= 0.0));
        let range = step.surface().range();
        assert!(g.iter().all(|&g| g > -1e-7 * range), "{}: penetration outside contact", case.name);
        let (load, product) = p.iter().zip(&g).fold((0.0, 0.0), |(l, s), (p, g)| (l + p, s + p * g.abs()));
        assert!(product < 1e-8 * load * range);
        assert!((load / p.len() as f64 / case.pressure - 1.0).abs() < 1e-12);
        let shares: f64 = reading.levels.iter().map(|level| level.load_share).sum();
        assert!((shares - 1.0).abs() < 1e-12);
        let peak = reading.levels.iter().map(|level| level.max_pressure).fold(0.0, f64::max);
        assert_eq!(reading.max_pressure, peak, "the largest pressure is that of a level");
        assert!(step.certificate.energy_gap < 2e-7 && step.certificate.load < 1e-12);
    }
}

/// w from the pressure anew, whatever way has led to it or however it has ended: the gap's memory has served others.
#[test]
fn the_gap_of_a_step_is_that_of_its_pressure() {
    let settings = Settings::default();
    let (three, hexagonal) = (PAPER[0], one_level(Lattice::hexagonal(1.0, 1).unwrap(), paraboloid(0.8, 0.0)));
    let plate = Problem::new(hexagonal, coated(1e4, 0.01, [0.3, 0.3], Interface::Bonded));
    for (problem, load, settings, stop) in [
        (three.problem(), Load::MeanPressure(three.pressure), settings, Stop::Converged),
        (three.problem(), Load::Penetration(0.02), settings, Stop::Converged),
        (
            three.problem(),
            Load::MeanPressure(three.pressure),
            Settings { max_iterations: 3, ..settings },
            Stop::IterationLimit,
        ),
        (
            three.problem(),
            Load::MeanPressure(three.pressure),
            Settings { tolerance: 1e-19, ..settings },
            Stop::Rounding,
        ),
        (
            three.problem(),
            Load::MeanPressure(three.pressure),
            Settings { max_iterations: 3, ..baseline() },
            Stop::IterationLimit,
        ),
        (plate, Load::MeanPressure(0.06), settings, Stop::Converged),
    ] {
        let mut solver = Solver::new(problem, [66, 72], settings).unwrap();
        let step = solver.solve(load);
        assert_eq!(step.report.stop, stop, "{step}");
        let mut displacement: Vec<f64> = step.pressure().iter().copied().collect();
        LayeredOperator::new(step.grid(), step.problem().half_space())
            .displacement(&mut displacement, &mut Workspace::default());
        let (initial, gap) = (step.surface().initial_gap(), step.gap());
        let expected = initial.iter().zip(&displacement).map(|(f, w)| f + w - step.penetration());
        let error = expected.zip(&gap).map(|(expected, gap)| (gap - expected).abs()).fold(0.0, f64::max);
        assert!(error < 1e-13 * step.surface().range(), "{error:e}: {step}");
    }
}

/// The Frank–Wolfe gap bounds the excess of energy: against a step a thousand times sharper, for loose tolerances.
#[test]
fn the_certificate_bounds_the_true_error_of_the_energy() {
    let case = PAPER[0];
    let load = Load::MeanPressure(case.pressure);
    let sharpest = Settings { tolerance: 1e-13, ..Settings::default() };
    let (sharp, _) = solve_with(&case.problem(), [72, 72], load, sharpest);
    let f = sharp.surface().initial_gap();
    let energy = |step: &Step| (&step.pressure() * &(0.5 * &step.displacement() + f)).sum();
    let elastic = |step: &Step| 0.5 * (&step.pressure() * &step.displacement()).sum();
    let best = energy(&sharp);
    for tolerance in [1e-2, 1e-3, 1e-4, 1e-6] {
        for method in [Method::Preconditioned, Method::PolonskyKeer] {
            let settings = Settings { tolerance, method, ..Settings::default() };
            let (loose, _) = solve_with(&case.problem(), [72, 72], load, settings);
            let excess = energy(&loose) - best;
            let bound = loose.certificate.energy_gap * elastic(&loose);
            assert!(excess > -1e-12 * best && excess <= bound, "{method:?} at {tolerance}: {excess:e} {bound:e}");
        }
    }
}

#[test]
fn a_load_step_starts_from_the_last_one() {
    let case = PAPER[0];
    let mut solver = Solver::new(case.problem(), [192, 192], Settings::default()).unwrap();
    let first = solver.solve(Load::MeanPressure(0.05));
    let again = solver.solve(Load::MeanPressure(0.05));
    assert_eq!(again.report.iterations, 0, "the same load again");
    assert!(relative_difference(again.pressure(), first.pressure()) < 1e-14);
    let next = solver.solve(Load::MeanPressure(0.0505));
    let (alone, _) = solve(&case.problem(), [192, 192], Load::MeanPressure(0.0505));
    assert!(next.report.iterations <= alone.report.iterations + 2, "{} / {}", next.report, alone.report);
    assert!(relative_difference(next.pressure(), alone.pressure()) < 1e-5);
}

#[test]
fn the_same_load_again_has_the_same_contact() {
    // Crests on the triangular lattice, a light load: the coarse grids' contact reaches beyond that of the finest.
    let n = 192;
    let wave = |s: f64, t: f64| (TAU * s).cos() + (TAU * t).cos() + (TAU * (s + t)).cos();
    let heights = Array2::from_shape_fn([n, n], |(i, j)| 0.01 * wave(i as f64 / n as f64, j as f64 / n as f64));
    let topography = Topography::new(Cell::hexagonal(1.0).unwrap(), heights).unwrap();
    let problem = Problem::new(topography, coated(2.0, 0.5, [0.2, 0.3], Interface::Bonded));
    let mut solver = Solver::new(problem, [n, n], Settings::default()).unwrap();
    let mut area = |mean_pressure: f64| {
        Reading::of(solver.solve(Load::MeanPressure(mean_pressure)).finest()).contact_fraction.unwrap()
    };
    let first = area(1e-3);
    for again in [1e-3, 1e-3 * (1.0 + 1e-10)] {
        let fraction = area(again);
        assert!((fraction / first - 1.0).abs() < 1e-6, "{fraction} after {first}");
    }
}

#[test]
fn displacement_control_finds_the_load_that_belongs_to_its_penetration() {
    for case in PAPER {
        let load = Load::MeanPressure(case.pressure);
        let (loaded, _) = solve(&case.problem(), [96, 96], load);
        let load = Load::Penetration(loaded.penetration());
        let (pushed, reading) = solve(&case.problem(), [96, 96], load);
        assert_eq!(pushed.report.stop, Stop::Converged);
        assert!((reading.mean_pressure.unwrap() / case.pressure - 1.0).abs() < 1e-6, "{}", case.name);
        assert!(relative_difference(pushed.pressure(), loaded.pressure()) < 1e-5);
        assert!(pushed.certificate.load < 1e-8);
    }
}

#[test]
fn nothing_touches_without_load() {
    let case = PAPER[0];
    for load in [Load::MeanPressure(0.0), Load::Penetration(0.0)] {
        let (step, reading) = solve(&case.problem(), [48, 48], load);
        assert_eq!(step.report.stop, Stop::NoContact);
        assert!(step.pressure().iter().all(|&p| p == 0.0));
        assert!(step.gap() == step.surface().initial_gap());
        assert_eq!((reading.penetration, reading.contact_fraction.unwrap()), (0.0, 0.0));
    }
}

/// Contact of one sample: all the load on the highest apex.
#[test]
fn first_touch_is_one_sample() {
    let case = PAPER[0];
    for settings in [Settings::default(), baseline()] {
        let (step, _) = solve_with(&case.problem(), [96, 96], Load::MeanPressure(1e-9), settings);
        assert_eq!(step.report.stop, Stop::Converged);
        assert_eq!(step.pressure().iter().filter(|&&p| p > 0.0).count(), 1);
        assert!((step.pressure()[[0, 0]] / (1e-9 * 96.0 * 96.0) - 1.0).abs() < 1e-12);
    }
}

/// In complete contact w = δ − f with δ = mean f, whatever the load: a uniform pressure moves nothing, and leaves the
/// bound on the energy at rounding.
#[test]
fn complete_contact_flattens_the_surface() {
    let n = 30;
    let wave = |i: usize| 0.01 * (TAU * i as f64 / n as f64).cos();
    let heights = Array2::from_shape_fn([n, n], |(i, j)| wave(i) + wave(j));
    let topography = Topography::new(Cell::square(1.0).unwrap(), heights).unwrap();
    let problem = Problem::new(topography, PAPER[0].half_space());
    for (settings, load) in [(Settings::default(), 1.0), (Settings::default(), 1e4), (baseline(), 1.0)] {
        let (step, reading) = solve_with(&problem, [n, n], Load::MeanPressure(load), settings);
        assert_eq!(step.report.stop, Stop::Converged);
        assert_eq!(reading.contact_fraction.unwrap(), 1.0);
        assert!((step.penetration() - 0.02).abs() < 1e-9, "δ = {}", step.penetration());
        assert!(step.certificate.energy_gap < 2e-7 && step.certificate.load < 1e-8, "{load}: {}", step.certificate);
    }
}

/// A thousandth below the penetration of complete contact, where a uniform pressure is nearly free.
#[test]
fn displacement_control_reaches_up_to_complete_contact() {
    for case in [PAPER[0], PAPER[4]] {
        for settings in [Settings::default(), baseline()] {
            let mut solver = Solver::new(case.problem(), [48, 48], settings).unwrap();
            let penetration = 0.999 * solver.full_contact_penetration();
            let step = solver.solve(Load::Penetration(penetration));
            assert_eq!(step.report.stop, Stop::Converged, "{}: {}", case.name, step.report);
            assert!(step.certificate.load < 1e-8 && step.certificate.energy_gap < 2e-7);
        }
    }
}

/// Cones on a stiff sliding plate just below complete contact, where the iteration under displacement control may stall and
/// leaves the rest to a search for the load: whichever way it goes, it ends with the penetration, within the iterations given.
#[test]
fn penetrations_just_below_complete_contact_are_found_within_the_iterations_given() {
    let substrate = Material::from_young(1.0, 0.3).unwrap();
    let plate = |contrast: f64| {
        let material = Material::from_shear(contrast * substrate.shear(), 0.3).unwrap();
        HalfSpace::new(vec![Layer::new(material, 0.1, Interface::Frictionless).unwrap()], substrate)
    };
    let cones = [0.02, 0.01, 0.0].map(|height| Level::new(Shape::Cone { slope: 0.1 }, height).unwrap());
    let indenters = Indenters::new(Lattice::hexagonal(1.0, 3).unwrap(), cones.to_vec()).unwrap();
    let pushed = |contrast: f64, part: f64, max_iterations: usize| {
        let settings = Settings { max_iterations, ..Settings::default() };
        let mut solver = Solver::new(Problem::new(indenters.clone(), plate(contrast)), [48, 48], settings).unwrap();
        let penetration = part * solver.full_contact_penetration();
        (solver.solve(Load::Penetration(penetration)), penetration)
    };
    for (contrast, part) in [(200.0, 0.9999995), (1e3, 0.99999), (2e3, 0.999999), (1e4, 0.99999), (5e4, 0.9999999)] {
        let (free, penetration) = pushed(contrast, part, 10_000);
        assert_eq!(free.report.stop, Stop::Converged, "{contrast}, {part}: {}", free.report);
        assert!((free.penetration() / penetration - 1.0).abs() < 1e-7, "{}", free.penetration());
        for given in [1, free.report.iterations / 2] {
            let cut = pushed(contrast, part, given).0.report;
            assert_eq!(cut.stop, Stop::IterationLimit, "{given}: {cut}");
            assert!(cut.iterations <= given, "{given}: {cut}");
        }
    }
}

/// A penetration that no load reaches has the fields of the surface at rest, pushed in, not those of the step before.
#[test]
fn a_penetration_beyond_complete_contact_has_no_pressure() {
    let case = PAPER[0];
    for settings in [Settings::default(), baseline()] {
        let mut solver = Solver::new(case.problem(), [48, 48], settings).unwrap();
        assert!(solver.solve(Load::MeanPressure(case.pressure)).report.stop.solved());
        let penetration = 1.01 * solver.full_contact_penetration();
        let step = solver.solve(Load::Penetration(penetration));
        assert_eq!(step.report.stop, Stop::BeyondFullContact);
        assert!(step.pressure().iter().chain(&step.displacement()).all(|&x| x == 0.0));
        assert_eq!(step.penetration(), penetration);
        let gap = solver.surface().initial_gap().mapv(|f| f - penetration);
        assert_eq!(step.gap(), gap);
        assert!(solver.solve(Load::MeanPressure(case.pressure)).report.stop.solved(), "the next step is unharmed");
    }
}

/// Between the penetrations of complete contact on two grids, the coarser one has nothing to say of the step. The apex is
/// at a sample of the finer grid alone: by Euler and Maclaurin, its mean gap is the larger one.
#[test]
fn a_grid_that_the_penetration_is_beyond_is_no_grid_of_the_step() {
    let level = Level::new(Shape::Power { exponent: 2.0, coefficient: 1.0 }, 0.0).unwrap();
    let lattice = Lattice::new(Cell::square(1.0).unwrap(), vec![vec![[1.0 / 48.0; 2]]]).unwrap();
    let problem = Problem::new(one_level(lattice, level), bare());
    let [fine, coarse] =
        [48, 24].map(|n| Solver::new(problem.clone(), [n, n], Settings::default()).unwrap().full_contact_penetration());
    assert!(coarse < fine, "{coarse} {fine}");
    let mut solver = Solver::new(problem.clone(), [48, 48], Settings::default()).unwrap();
    let both = solver.solve(Load::Penetration(0.9 * coarse));
    assert!(both.report.stop.solved() && both.coarser().len() == 1);
    let between = solver.solve(Load::Penetration(0.5 * (coarse + fine)));
    assert!(between.report.stop.solved() && between.coarser().is_empty(), "{}", between.report);
    // Then no error is known, which a run says.
    let loads = [0.9 * coarse, 0.5 * (coarse + fine)].map(Load::Penetration).to_vec();
    let run = percoat::Run::new(problem, loads, percoat::Sampling::Points([48; 2]));
    let warnings = run.solve(&mut ()).unwrap().warnings;
    assert!(warnings.iter().any(|words| words.contains("no coarser grid has solved step 2,")), "{warnings:?}");
}

/// A load that is no number is not solved, also by a flat counterbody that carries any.
#[test]
fn a_load_that_is_no_number_is_not_solved() {
    let flat = Topography::new(Cell::square(1.0).unwrap(), Array2::zeros([24, 24])).unwrap();
    for problem in [Problem::new(flat, bare()), PAPER[0].problem()] {
        let mut solver = Solver::new(problem, [24, 24], Settings::default()).unwrap();
        for load in [Load::MeanPressure(f64::NAN), Load::MeanPressure(f64::INFINITY), Load::Penetration(f64::NAN)] {
            let step = solver.solve(load);
            assert_eq!(step.report.stop, Stop::Stalled);
            assert!(step.pressure().iter().all(|&p| p == 0.0));
        }
    }
}

/// A step owns what it holds: it is read on another thread after its solver is gone.
#[test]
fn a_step_outlives_its_solver() {
    let case = PAPER[1];
    let mut solver = Solver::new(case.problem(), [96, 96], Settings::default()).unwrap();
    let first = solver.solve(Load::MeanPressure(0.5 * case.pressure));
    let before = (first.pressure().to_owned(), first.gap().to_owned(), first.reading());
    solver.solve(Load::MeanPressure(case.pressure));
    drop(solver);
    let read = move || (first.pressure().to_owned(), first.gap().to_owned(), first.reading());
    assert!(std::thread::spawn(read).join().unwrap() == before, "the next load leaves a step as it was");
}

/// 21² samples are no power of two: the transform of a uniform pressure leaves rounding, which is no energy.
#[test]
fn a_flat_counterbody_is_in_complete_contact_at_once() {
    for n in [16, 21] {
        let flat = Topography::new(Cell::square(1.0).unwrap(), Array2::from_elem([n, n], 0.3)).unwrap();
        for half_space in [PAPER[0].half_space(), bare()] {
            let (step, reading) = solve(&Problem::new(flat.clone(), half_space), [n, n], Load::MeanPressure(0.1));
            assert_eq!((step.report.stop, reading.contact_fraction.unwrap()), (Stop::Converged, 1.0));
            assert!(step.pressure().iter().all(|&p| (p - 0.1).abs() < 1e-12) && step.penetration().abs() < 1e-12);
            let certificate = &step.certificate;
            assert!(certificate.energy_gap < 2e-7 && certificate.penetration < 1e-7, "{n}: {certificate}");
        }
    }
}

/// Samples halfway between equal indenters belong to both.
#[test]
fn equal_levels_carry_equal_loads_when_merged() {
    let lattice = Lattice::square(1.0, 4).unwrap();
    let indenters = Indenters::new(lattice, vec![paraboloid(0.8, 0.0); 4]).unwrap();
    let (_, reading) = solve(&Problem::new(indenters, bare()), [32, 32], Load::MeanPressure(1.0));
    for level in &reading.levels {
        assert!(level.merged && (level.load_share - 0.25).abs() < 1e-9, "{reading}");
        assert!((level.contact_area - reading.contact_fraction.unwrap()).abs() < 1e-9, "a quarter of a cell of area 4");
    }
}

#[test]
fn the_areas_of_the_levels_make_up_the_contact_fraction() {
    let case = PAPER[0];
    for load in [0.0011, 0.004, 0.06] {
        let (step, reading) = solve(&case.problem(), [128, 128], Load::MeanPressure(load));
        let sum: f64 = reading.levels.iter().map(|level| level.contact_area).sum();
        assert!((sum / step.grid().cell().area() / reading.contact_fraction.unwrap() - 1.0).abs() < 1e-12);
    }
}

#[test]
fn a_skewed_cell_is_the_same_lattice() {
    let system = |cell: Cell| {
        let lattice = Lattice::new(cell, vec![vec![[0.0, 0.0]]]).unwrap();
        let problem = Problem::new(one_level(lattice, paraboloid(0.8, 0.0)), PAPER[0].half_space());
        solve(&problem, [30, 30], Load::MeanPressure(0.05)).1
    };
    let straight = system(Cell::square(1.0).unwrap());
    // (150, 1) is the grid vector (0, 1) of a 30 × 30 grid, shifted by 150 = 5 · 30 samples' worth of a₁.
    let skewed = system(Cell::new([1.0, 0.0], [150.0, 1.0]).unwrap());
    assert!((straight.penetration / skewed.penetration - 1.0).abs() < 1e-9);
    assert!(!skewed.levels[0].merged);
    let radii = [&straight, &skewed].map(|o| o.levels[0].contact_radius.unwrap());
    assert!((radii[0] / radii[1] - 1.0).abs() < 1e-2, "{radii:?}");
}

#[test]
fn an_exhausted_solver_says_so() {
    let case = PAPER[0];
    for method in [Method::Preconditioned, Method::PolonskyKeer] {
        let settings = Settings { method, max_iterations: 3, ..Settings::default() };
        let load = Load::MeanPressure(case.pressure);
        let (step, _) = solve_with(&case.problem(), [96, 96], load, settings);
        assert_eq!(step.report.stop, Stop::IterationLimit);
        assert_ne!(step.report.route, Route::BaselineAfterStall);
        assert!(step.report.residual > 1e-8 && step.certificate.energy_gap > 1e-8);
    }
    // A tolerance below round-off cannot be met: the solver ends at what rounding leaves, and says that it is that.
    let settings = Settings { tolerance: 1e-19, ..Settings::default() };
    let load = Load::MeanPressure(case.pressure);
    let (step, _) = solve_with(&case.problem(), [48, 48], load, settings);
    assert_eq!(step.report.stop, Stop::Rounding);
    assert!(step.certificate.energy_gap < 1e-11 && step.report.residual > settings.tolerance);
}

/// Smooth and rough, by load and by penetration, on numbers of points whose transforms differ.
#[test]
fn answers_do_not_depend_on_the_number_of_threads() {
    let paper = PAPER[3];
    let rough = Problem::new(rough(&mut Random(77), 34), bare());
    let runs = [
        (paper.problem(), [150, 150], Load::MeanPressure(paper.pressure)),
        (paper.problem(), [136, 120], Load::Penetration(0.01)),
        (rough.clone(), [68, 68], Load::MeanPressure(0.01)),
        (rough, [75, 64], Load::MeanPressure(0.003)),
    ];
    for (problem, points, load) in runs {
        let run = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| solve(&problem, points, load))
        };
        let (one, reading_of_one) = run(1);
        assert!(one.report.stop.solved(), "{}", one.report);
        for threads in [2, 3, 5] {
            let (other, reading) = run(threads);
            assert!(one.pressure() == other.pressure() && one.gap() == other.gap(), "{points:?}: bit for bit");
            assert_eq!(reading_of_one, reading);
        }
    }
}

/// A self-affine topography on a rhombus: amplitudes q^(−1−H) with random phases between two cut-offs.
fn rough(random: &mut Random, n: usize) -> Topography {
    let (hurst, roll_off) = (random.unit(), 2.0 + 6.0 * random.unit());
    let mut heights = Array2::<f64>::zeros([n, n]);
    let most = n as i32 / 2;
    for (k1, k2) in (-most..most).flat_map(|k1| (0..most).map(move |k2| (k1, k2))) {
        let q = f64::from(k1 * k1 + k2 * k2 - k1 * k2).sqrt();
        if !(1.0..0.8 * f64::from(most)).contains(&q) {
            continue;
        }
        let amplitude = q.max(roll_off).powf(-1.0 - hurst) * (-random.unit().max(1e-9).ln()).sqrt();
        let phase = TAU * random.unit();
        for ((i, j), height) in heights.indexed_iter_mut() {
            let turns = (f64::from(k1) * i as f64 + f64::from(k2) * j as f64) / n as f64;
            *height += amplitude * (TAU * turns + phase).cos();
        }
    }
    let largest = heights.iter().fold(0.0, |m: f64, h| m.max(h.abs()));
    let scale = random.log(1e-3, 1.0) / largest;
    Topography::new(Cell::hexagonal(1.0).unwrap(), scale * heights).unwrap()
}

fn indenters(random: &mut Random) -> Indenters {
    let k = random.pick(&[1usize, 3, 4]);
    let lattice = match random.pick(&[0, 1, 2]) {
        0 => Lattice::hexagonal(1.0, k),
        1 => Lattice::square(1.0, if k == 3 { 2 } else { k }),
        _ => {
            let cell = Cell::new([1.0, 0.1 * random.unit()], [random.unit() - 0.5, 0.5 + random.unit()]).unwrap();
            Lattice::new(cell, (0..k).map(|_| vec![[random.unit(), random.unit()]]).collect())
        }
    };
    let lattice = lattice.unwrap();
    let step = random.log(1e-4, 0.1);
    let mut level = || {
        let radius = random.log(0.3, 3.0);
        let shape = random.pick(&[
            Shape::Paraboloid { radius },
            Shape::Sphere { radius },
            Shape::Cone { slope: 0.1 },
            Shape::Power { coefficient: 0.3, exponent: 3.0 },
        ]);
        Level::new(shape, -step * random.unit()).unwrap()
    };
    let levels = lattice.sites().iter().map(|_| level()).collect();
    Indenters::new(lattice, levels).unwrap()
}

fn stack(random: &mut Random) -> HalfSpace {
    let mut layer = || {
        let poisson = random.pick(&[0.0, 0.2, 0.3, 0.45, 0.5]);
        let material = Material::from_shear(random.log(0.01, 100.0), poisson).unwrap();
        let interface = match random.pick(&[0, 0, 1, 2]) {
            0 => Interface::Bonded,
            1 => Interface::Frictionless,
            _ => Interface::Spring { tangential: random.log(0.01, 100.0), normal: random.log(0.01, 100.0) },
        };
        Layer::new(material, random.log(1e-3, 3.0), interface).unwrap()
    };
    let count = 3.min((layer().thickness() * 4.0) as usize);
    HalfSpace::new((0..count).map(|_| layer()).collect(), Material::from_shear(1.0, 0.3).unwrap())
}

/// 120 random cases: levels, heights, shapes, radii, up to three layers of contrast 1e4 with any interfaces, loads from
/// first touch to complete contact; every fourth a rough topography. The default converges wherever the baseline does,
/// to the same pressure, and under displacement load too.
#[test]
fn the_default_converges_wherever_the_baseline_does() {
    let n = 48;
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    let (mut fell_back, mut iterations, mut iterations_baseline) = (0, 0, 0);
    for case in 0..120 {
        let counterbody: Counterbody =
            if case % 4 == 3 { rough(&mut random, n).into() } else { indenters(&mut random).into() };
        let problem = Problem::new(counterbody, stack(&mut random));
        let mut reference = Solver::new(problem.clone(), [n, n], baseline()).unwrap();
        let scale = reference.surface().mean()
            / problem.half_space().response().compliance(reference.grid().least_wavenumber());
        let pressure = scale * random.log(1e-5, 10.0);
        let load = Load::MeanPressure(pressure);
        let base = reference.solve(load);
        let (step, _) = solve(&problem, [n, n], load);
        let context = format!("case {case}\n{problem}\nload {pressure:e}: {} / {}", step.report, base.report);
        assert_eq!(step.report.stop, Stop::Converged, "{context}");
        assert!(step.certificate.energy_gap < 2e-7, "{context}: {}", step.certificate);
        if base.report.stop.solved() {
            assert!(relative_difference(step.pressure(), base.pressure()) < 1e-4, "{context}");
        }
        if step.penetration() < 0.999 * reference.full_contact_penetration() {
            let (pushed, reading) = solve(&problem, [n, n], Load::Penetration(step.penetration()));
            // At most four samples an indenter: as discrete an answer, told as unresolved.
            let levels = problem.levels().len();
            let few = pushed.pressure().iter().filter(|&&p| p > 0.0).count() <= 4 * levels.max(1);
            let unresolved = few && pushed.report.stop == Stop::Unresolved;
            assert!(unresolved || pushed.report.stop == Stop::Converged, "{context}: {}", pushed.report);
            assert!((reading.mean_pressure.unwrap() / pressure - 1.0).abs() < 1e-4, "{context}");
        }
        fell_back += usize::from(step.report.route == Route::BaselineAfterStall);
        iterations += step.report.iterations;
        iterations_baseline += base.report.iterations;
    }
    println!("120 cases: {fell_back} fell back; iterations {iterations} against {iterations_baseline} of the baseline");
    assert!(fell_back <= 2, "{fell_back} of 120 fell back");
}

#[test]
fn rough_surfaces_take_few_iterations() {
    let mut random = Random(42);
    for n in [64, 128] {
        let problem = Problem::new(rough(&mut random, n), bare());
        let mut reference = Solver::new(problem.clone(), [n, n], baseline()).unwrap();
        let load = Load::MeanPressure(0.05 * reference.full_contact_pressure());
        let base = reference.solve(load);
        let (step, _) = solve(&problem, [n, n], load);
        let context = format!("N = {n}: {} / {}", step.report, base.report);
        assert_ne!(step.report.route, Route::BaselineAfterStall, "{context}");
        assert!(2 * step.report.iterations <= base.report.iterations, "{context}");
    }
}

#[test]
fn contacts_that_touch_are_recognised_as_merged() {
    let indenters = one_level(Lattice::hexagonal(1.0, 1).unwrap(), paraboloid(0.8, 0.0));
    let problem = Problem::new(indenters, bare());
    let (_, apart) = solve(&problem, [96, 96], Load::MeanPressure(0.1));
    assert!(!apart.levels[0].merged && apart.levels[0].contact_radius.is_some());
    let complete = Solver::new(problem.clone(), [96, 96], Settings::default()).unwrap().full_contact_pressure();
    let (_, merged) = solve(&problem, [96, 96], Load::MeanPressure(0.5 * complete));
    let level = &merged.levels[0];
    assert!(
        level.merged && level.contact_radius.is_none() && level.radius_min.or(level.radius_max).is_none(),
        "{merged}"
    );
    assert!(merged.contact_fraction.unwrap() > 0.8 && (level.load_share - 1.0).abs() < 1e-12);
    assert!((level.contact_area / (merged.contact_fraction.unwrap() * 0.75f64.sqrt()) - 1.0).abs() < 1e-12);
}

/// Heights of a few waves, largest 0 at a sample.
fn waves([n1, n2]: [usize; 2]) -> Array2<f64> {
    let wave = |s: f64, t: f64| (TAU * s).cos() + (TAU * t).cos() + 0.6 * (TAU * (3.0 * s - 2.0 * t) + 1.0).cos();
    let heights = Array2::from_shape_fn([n1, n2], |(i, j)| 0.01 * wave(i as f64 / n1 as f64, j as f64 / n2 as f64));
    let highest = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    heights - highest
}

fn flat(points: [usize; 2]) -> Problem {
    Problem::new(Topography::new(Cell::hexagonal(1.0).unwrap(), Array2::zeros(points)).unwrap(), PAPER[0].half_space())
}

/// On grids that halve to whole fractions and on others, by load and by penetration.
#[test]
fn a_given_gap_is_that_of_the_equivalent_topography() {
    for points in [[96, 96], [90, 75]] {
        let topography = Topography::new(Cell::hexagonal(1.0).unwrap(), waves(points)).unwrap();
        let problem = Problem::new(topography, PAPER[0].half_space());
        for load in [Load::MeanPressure(0.02), Load::Penetration(0.01)] {
            let mut solver = Solver::new(problem.clone(), points, Settings::default()).unwrap();
            let step = solver.solve(load);
            let given = |offset: f64| {
                let gap = &solver.surface().initial_gap() + offset;
                let given = Solver::new(flat(points), points, Settings::default()).unwrap();
                given.with_gap(gap).unwrap().solve(load)
            };
            let (same, shifted) = (given(0.0), given(0.004));
            assert!(step.report.stop.solved(), "{step}");
            assert!(step.pressure() == same.pressure() && step.gap() == same.gap(), "{points:?}: bit for bit");
            if load.is_load_control() {
                assert!(relative_difference(step.pressure(), shifted.pressure()) < 1e-4);
                assert!((step.penetration() + 0.004 - shifted.penetration()).abs() < 1e-6 * step.penetration());
            }
        }
    }
}

/// The gap of the indenters themselves leaves everything as it is; worn indenters carry less.
#[test]
fn a_given_gap_leaves_the_samples_to_their_indenters() {
    let (case, points) = (PAPER[0], [96, 96]);
    let load = Load::MeanPressure(case.pressure);
    let mut solver = Solver::new(case.problem(), points, Settings::default()).unwrap();
    let step = solver.solve(load);
    let mut gap = step.surface().initial_gap().to_owned();
    let mut given = Solver::new(case.problem(), points, Settings::default()).unwrap().with_gap(gap.clone()).unwrap();
    let same = given.solve(load);
    assert!(step.pressure() == same.pressure() && step.reading() == same.reading());
    let depth = 0.1 * step.penetration();
    let worn = |sample: &usize| step.surface().level_at(*sample) == 1;
    gap.iter_mut().enumerate().filter(|(sample, _)| worn(sample)).for_each(|(_, f)| *f += depth);
    let worn = given.with_gap(gap).unwrap().solve(load);
    assert!(worn.report.stop.solved(), "{worn}");
    let share = |step: &Step| step.reading().levels[0].load_share;
    assert!(share(&worn) < 0.95 * share(&step), "{} {}", share(&worn), share(&step));
    assert!((worn.pressure().mean().unwrap() / case.pressure - 1.0).abs() < 1e-8);
}

#[test]
fn fields_that_do_not_fit_the_grid_are_refused() {
    let solver = || Solver::new(flat([32, 24]), [32, 24], Settings::default()).unwrap();
    let error = solver().with_gap(Array2::zeros([24, 32])).unwrap_err();
    assert!(matches!(error, FieldError::Shape(_)), "{error}");
    assert!(error.to_string().contains("24 × 32") && error.to_string().contains("32 × 24"), "{error}");
    for value in [f64::NAN, f64::INFINITY, -1e-9] {
        let mut gap = Array2::zeros([32, 24]);
        gap[[3, 5]] = value;
        let error = solver().with_gap(gap).unwrap_err();
        assert!(matches!(error, FieldError::Gap { sample: [3, 5], .. }), "{error}");
    }
    assert!(matches!(solver().with_mask(Array2::from_elem([32, 1], true)).unwrap_err(), FieldError::Shape(_)));
    assert_eq!(solver().with_mask(Array2::from_elem([32, 24], false)).unwrap_err(), FieldError::EmptyMask);
}

/// Contact on a strip alone: that of a surface out of reach elsewhere, by either method.
#[test]
fn a_mask_is_a_surface_out_of_reach() {
    let points = [96, 96];
    let problem =
        Problem::new(Topography::new(Cell::hexagonal(1.0).unwrap(), waves(points)).unwrap(), PAPER[0].half_space());
    let load = Load::MeanPressure(0.02);
    let mask = Array2::from_shape_fn(points, |(i, _)| !(20..60).contains(&i));
    for settings in [Settings::default(), baseline()] {
        let solver = || Solver::new(problem.clone(), points, settings).unwrap();
        let free = solver().solve(load);
        let whole = solver().with_mask(Array2::from_elem(points, true)).unwrap().solve(load);
        assert!(free.pressure() == whole.pressure(), "bit for bit");
        let masked = solver().with_mask(mask.clone()).unwrap().solve(load);
        assert_eq!(masked.report.stop, Stop::Converged, "{masked}");
        let mut gap = free.surface().initial_gap().to_owned();
        gap.zip_mut_with(&mask, |f, &admissible| *f += if admissible { 0.0 } else { 1.0 });
        let far = solver().with_gap(gap).unwrap().solve(load);
        assert_eq!(far.report.stop, Stop::Converged, "{far}");
        assert!(relative_difference(masked.pressure(), far.pressure()) < 1e-5, "{masked}\n{far}");
        assert!((masked.penetration() / far.penetration() - 1.0).abs() < 1e-6, "{masked}\n{far}");
        assert!(relative_difference(masked.pressure(), free.pressure()) > 0.1, "the mask matters");
        let pressed = masked.pressure().iter().zip(&mask).any(|(&p, &admissible)| p > 0.0 && !admissible);
        assert!(!pressed, "no pressure outside the mask");
        // The gap is a true one outside the mask too: w + f − δ.
        let least = masked.gap().iter().copied().fold(f64::INFINITY, f64::min);
        assert!(least > -masked.penetration() && masked.gap().iter().all(|g| g.abs() < 1.0), "{least}");
        let pushed = solver().with_mask(mask.clone()).unwrap().solve(Load::Penetration(masked.penetration()));
        assert_eq!(pushed.report.stop, Stop::Converged, "{pushed}");
        assert!(relative_difference(masked.pressure(), pushed.pressure()) < 1e-4, "{pushed}");
    }
}

/// A flat counterbody on a disc: complete contact on it, so that pressures are proportional to the load.
#[test]
fn a_flat_punch_is_linear_in_its_load() {
    let points = [72, 72];
    let disc = |(i, j): (usize, usize)| {
        let (x, y) = (i as f64 / 72.0 - 0.5, j as f64 / 72.0 - 0.5);
        x * x + y * y + x * y < 0.05
    };
    let mask = Array2::from_shape_fn(points, disc);
    for settings in [Settings::default(), baseline()] {
        let mut solver = Solver::new(flat(points), points, settings).unwrap().with_mask(mask.clone()).unwrap();
        let [light, heavy] = [0.1, 3.0].map(|mean| solver.solve(Load::MeanPressure(mean)));
        for step in [&light, &heavy] {
            assert_eq!(step.report.stop, Stop::Converged, "{step}");
            let pressed = step.pressure().iter().zip(&mask).all(|(&p, &admissible)| (p > 0.0) == admissible);
            assert!(pressed && step.penetration() > 0.0, "{step}");
        }
        let scaled = &light.pressure() * 30.0;
        assert!(relative_difference(scaled.view(), heavy.pressure()) < 1e-5);
        assert!((heavy.penetration() / light.penetration() / 30.0 - 1.0).abs() < 1e-6);
        let pushed = solver.solve(Load::Penetration(light.penetration()));
        assert_eq!(pushed.report.stop, Stop::Converged, "{pushed}");
        assert!((pushed.pressure().mean().unwrap() / 0.1 - 1.0).abs() < 1e-6, "{pushed}");
    }
}
