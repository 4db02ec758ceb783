//! Hardness: 0 ≤ p ≤ H in all modes, by other algorithms and closed forms; what is pressed in stays on a load path.

use ndarray::Array2;
use percoat::body::{CompositeHardness, HardnessLaw};
use percoat::reading::PlasticReading;
use percoat::run::{AllAtHardness, PathEnd, RunError, WearPath};
use percoat::spectral::Wear;
use percoat::{
    Bodies, Cell, Contact, Durability, Friction, Grid, HalfSpace, Indenters, Interface, Lattice, Layer, Level, Load,
    Material, Method, Problem, Run, Sampling, Settings, Shape, Solver, Step, Stop, Topography,
};
use std::f64::consts::{PI, TAU};
use std::ops::ControlFlow;
use std::sync::Arc;

fn young(young: f64, poisson: f64) -> Material {
    Material::from_young(young, poisson).unwrap()
}

fn hard(hardness: f64) -> Durability {
    Durability { hardness: Some(hardness), ..Durability::default() }
}

/// A bare half-space, E = 1 and ν = 0.3, with a hardness if there is one.
fn bare(hardness: Option<f64>) -> HalfSpace {
    HalfSpace::new(vec![], young(1.0, 0.3))
        .with_substrate_durability(Durability { hardness, ..Durability::default() })
        .unwrap()
}

/// A stiff coating on it.
fn coated(hardness: Option<f64>) -> HalfSpace {
    let layer = Layer::new(young(3.0, 0.2), 0.1, Interface::Bonded).unwrap();
    let layer = layer.with_durability(Durability { hardness, ..Durability::default() }, None).unwrap();
    HalfSpace::new(vec![layer], young(1.0, 0.3))
}

/// Three levels of paraboloids on a hexagonal lattice.
fn levels() -> Indenters {
    let level = |height| Level::new(Shape::Paraboloid { radius: 0.8 }, height).unwrap();
    Indenters::new(Lattice::hexagonal(1.0, 3).unwrap(), [0.02, 0.01, 0.0].map(level).to_vec()).unwrap()
}

/// One paraboloid in the middle of a window or of a square cell of side 1.
fn ball(cell: Cell, shape: Shape) -> Indenters {
    Indenters::new(Lattice::new(cell, vec![vec![[0.5; 2]]]).unwrap(), vec![Level::new(shape, 0.0).unwrap()]).unwrap()
}

/// Heights of waves in many directions with fixed phases.
fn rough(cell: Cell, points: [usize; 2]) -> Topography {
    let waves = (-4i32..=4).flat_map(|k1| (0..=4).map(move |k2| [k1, k2])).filter(|k| *k != [0, 0]);
    let grid = Grid::new(cell, points).unwrap();
    let height = |index: usize| -> f64 {
        let [s, t] = grid.fractions(index);
        let wave = |[k1, k2]: [i32; 2]| {
            let phase = f64::from((k1 * 37 + k2 * 101).rem_euclid(97)) / 97.0;
            0.01 * f64::from(k1 * k1 + k2 * k2).powf(-0.9)
                * (TAU * (f64::from(k1) * s + f64::from(k2) * t + phase)).cos()
        };
        waves.clone().map(wave).sum()
    };
    let heights = Array2::from_shape_fn(points, |(i, j)| height(i * points[1] + j));
    Topography::new(cell, heights).unwrap()
}

fn solver(problem: Problem, points: [usize; 2]) -> Solver {
    Solver::new(problem, points, Settings::default()).unwrap()
}

fn solved(problem: Problem, points: [usize; 2], load: Load) -> Step {
    let step = solver(problem, points).solve(load);
    assert!(step.report.stop.solved(), "{}\n{}", step.report, step.certificate);
    step
}

fn pressures(step: &Step) -> Vec<f64> {
    step.pressure().iter().copied().collect()
}

/// The conditions of the box on the samples, within `tolerance` of δ: p in [0, H], min(p, H − p) g = 0 where p is free, over H, g ≥ 0 where
/// p = 0 and ≤ 0 where p = H; the number of free and of full samples.
fn complies(contact: &Contact, tolerance: f64) -> [usize; 2] {
    let (hardness, slack) = (contact.hardness(), tolerance * contact.penetration().abs());
    let mut counts = [0; 2];
    for (&p, &g) in contact.pressure().iter().zip(&contact.gap()) {
        assert!((0.0..=hardness).contains(&p));
        if p == 0.0 {
            assert!(g > -slack, "open: {g:e} {slack:e}");
        } else if p < hardness {
            counts[0] += 1;
            assert!(g.abs() * p.min(hardness - p) < slack * hardness, "free: {g:e} {slack:e}");
        } else {
            counts[1] += 1;
            assert!(g < slack, "full: {g:e} {slack:e}");
        }
    }
    counts
}

/// A hardness that no pressure reaches changes no bit, in any mode and under both controls.
#[test]
fn a_hardness_that_is_not_reached_changes_no_bit() {
    let sliding = |problem: Problem| problem.sliding(Friction::new(0.3, [0.6, 0.8]).unwrap()).unwrap();
    let window = Cell::window([1.0; 2]).unwrap();
    let problems = |hardness: Option<f64>| {
        [
            Problem::new(levels(), coated(hardness)),
            sliding(Problem::new(levels(), coated(hardness))),
            Problem::new(ball(window, Shape::Paraboloid { radius: 1.0 }), bare(hardness)),
            Problem::new(rough(Cell::square(1.0).unwrap(), [60, 48]), Bodies::elastic(bare(hardness), coated(None))),
        ]
    };
    for (elastic, other) in problems(None).into_iter().zip(problems(Some(1e3))) {
        for load in [Load::Force(0.01), Load::Penetration(0.008)] {
            let steps = [elastic.clone(), other.clone()].map(|problem| solved(problem, [60, 48], load));
            let [first, second] = steps.each_ref().map(pressures);
            assert_eq!(first, second, "{load}");
            assert_eq!(steps[0].certificate, steps[1].certificate);
            assert_eq!(steps[0].report, steps[1].report);
            let [one, two] = steps.each_ref().map(|step| step.reading());
            assert_eq!((one.max_pressure, one.errors.max_pressure), (two.max_pressure, two.errors.max_pressure));
        }
    }
}

/// Another algorithm: Gauss–Seidel on the assembled matrix with each pressure clipped to [0, H], under the penetration of the step.
/// A step of the certificate 20 tolerance of the energy has an error of its square root in the norm of the energy, and of Σ p|g| ≤ 1e-8 δ Σp
/// one sample has at most all, 5e-6 with 525 samples.
#[test]
fn the_box_is_solved_as_by_clipped_gauss_seidel() {
    let oblique = Cell::new([1.0, 0.1], [0.4, 0.8]).unwrap();
    let cases = [(Cell::square(1.0).unwrap(), [24, 24]), (oblique, [20, 27]), (Cell::square(1.0).unwrap(), [25, 21])];
    for (cell, points) in cases {
        for (load, hardness) in [(0.01, 0.06), (0.03, 0.04), (0.02, 0.021)] {
            let problem = Problem::new(rough(cell, points), coated(Some(hardness)));
            let step = solved(problem.clone(), points, Load::MeanPressure(load));
            let [free, full] = complies(step.finest(), 5e-6);
            assert!(full > 0, "{free} free samples, none full");
            let reference = gauss_seidel(&step, hardness);
            let worst = pressures(&step).iter().zip(&reference).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(worst < 1e-4 * hardness, "{points:?}, {load} of {hardness}: {worst:e}");
        }
    }
}

/// Pressures in [0, H] under the penetration of a step, by Gauss–Seidel from a uniform pressure on.
fn gauss_seidel(step: &Step, hardness: f64) -> Vec<f64> {
    let (grid, f) = (step.grid(), step.surface().initial_gap());
    let f: Vec<f64> = f.iter().copied().collect();
    let mut operator = percoat::spectral::LayeredOperator::new(grid, step.problem().bodies());
    let mut column = vec![0.0; f.len()];
    column[0] = 1.0;
    operator.displacement(&mut column, &mut percoat::spectral::Workspace::default());
    let [n1, n2] = grid.points();
    // The mean of w is zero: a shift of all columns by a positive constant changes w by one number for all samples under a load.
    let load: f64 = step.pressure().iter().sum();
    let shift = 2.0 * column[0] / f.len() as f64;
    let delta = step.penetration() + shift * load;
    let at = |i: usize, k: usize| {
        let (a, b) = ((i / n2 + n1 - k / n2) % n1, (i % n2 + n2 - k % n2) % n2);
        column[a * n2 + b] + shift
    };
    let mut p = vec![load / f.len() as f64; f.len()];
    let mut w: Vec<f64> = (0..f.len()).map(|i| (0..f.len()).map(|k| at(i, k) * p[k]).sum()).collect();
    for _ in 0..20_000 {
        let mut change = 0.0f64;
        for i in 0..f.len() {
            let next = (p[i] - (w[i] + f[i] - delta) / at(i, i)).clamp(0.0, hardness);
            let rise = next - p[i];
            if rise != 0.0 {
                p[i] = next;
                (0..f.len()).for_each(|k| w[k] += at(k, i) * rise);
                change = change.max(rise.abs());
            }
        }
        if change < 1e-9 * hardness {
            return p;
        }
    }
    panic!("Gauss–Seidel does not converge");
}

/// Nearly all of the surface at the hardness: p̄ → H has A/A₀ → p̄/H, which other programs do not reach.
#[test]
fn mean_pressures_near_the_hardness_converge() {
    let square = Cell::square(1.0).unwrap();
    let hexagonal = Problem::new(levels(), coated(Some(0.1)));
    let waves = Problem::new(rough(square, [96, 96]), bare(Some(0.1)));
    let sliding = waves.clone().sliding(Friction::new(0.5, [1.0, 0.0]).unwrap()).unwrap();
    let both = Problem::new(rough(square, [96, 96]), Bodies::elastic(bare(None), coated(Some(0.1))));
    for (name, problem) in [("levels", hexagonal), ("waves", waves), ("sliding", sliding), ("two bodies", both)] {
        let mut solver = solver(problem, [96, 96]);
        for part in [0.1, 0.5, 0.9, 0.99, 0.999, 0.9999] {
            let step = solver.solve(Load::MeanPressure(0.1 * part));
            assert!(step.report.stop.solved(), "{name}, {part}: {}", step.report);
            complies(step.finest(), 1e-5);
            let reading = step.reading();
            let [fraction, error] = [reading.contact_fraction.unwrap(), reading.errors.contact_fraction.unwrap()];
            assert!(fraction + error > part, "{name}, {part}: {fraction} ± {error}");
            if part >= 0.9 {
                assert!(reading.contact_fraction.unwrap() < 1.0 + 1e-9 && reading.max_pressure == 0.1);
            }
            println!(
                "{name} {part}: {} iterations, fraction {}",
                step.report.iterations,
                reading.contact_fraction.unwrap()
            );
        }
        let beyond = solver.solve(Load::MeanPressure(0.1));
        assert_eq!(beyond.report.stop, Stop::BeyondHardness, "{name}");
    }
}

#[test]
fn a_load_beyond_the_hardness_is_refused_before_it_is_solved() {
    let run =
        Run::new(Problem::new(levels(), bare(Some(0.1))), vec![Load::MeanPressure(0.1)], Sampling::Points([24, 24]));
    let Err(RunError::BeyondHardness(error)) = run.solve(&mut ()) else { panic!("refused") };
    assert!(error.to_string().contains("hardness 0.1"), "{error}");
}

/// Both methods find the same pressure, under both controls: each is within √(20 tolerance) = 4.5e-4 of the solution in the norm of the
/// energy.
#[test]
fn the_baseline_finds_the_same() {
    let problem = Problem::new(rough(Cell::square(1.0).unwrap(), [40, 40]), coated(Some(0.03)));
    for load in [Load::MeanPressure(0.012), Load::Penetration(0.02)] {
        let by = |method| {
            let settings = Settings { method, ..Settings::default() };
            let step = Solver::new(problem.clone(), [40, 40], settings).unwrap().solve(load);
            assert!(step.report.stop.solved(), "{method:?} under {load}: {}", step.report);
            assert!(complies(step.finest(), 1e-5)[1] > 0);
            pressures(&step)
        };
        let [first, second] = [Method::Preconditioned, Method::PolonskyKeer].map(by);
        let worst = first.iter().zip(&second).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-3 * 0.03, "{load}: {worst:e}");
    }
}

/// Layers that are thin beside everything else, on a rigid base, are springs: p = M(δ − f)/h, at most H. For a paraboloid with the
/// contact radius a² = 2Rδ the radius of the hardness is b² = a² − 2R h H/M, and P = (πM/(4Rh))(a⁴ − b⁴). The radii of a layer that is
/// not quite thin differ by h/8 (an exact solution of layers), so that P, with b⁴ = 0.36 a⁴, does by 0.8 h/a or a little more, and areas by
/// ¼ h/a.
#[test]
fn a_thin_layer_on_a_rigid_base_yields_as_springs_do() {
    let (h, r, depth) = (0.0005, 1.0, 0.02);
    let material = young(1.0, 0.0);
    let stiffness = 1.0 / material.oedometric_compliance() / h;
    let hardness = 0.4 * stiffness * depth;
    let layer = Layer::new(material, h, Interface::Bonded).unwrap().with_durability(hard(hardness), None).unwrap();
    let body = HalfSpace::on_rigid_base(vec![layer]).unwrap();
    let n = 300;
    let problem = Problem::new(ball(Cell::square(0.6).unwrap(), Shape::Paraboloid { radius: r }), body);
    let step = solved(problem, [n, n], Load::Penetration(depth));
    let (a2, b2) = (2.0 * r * depth, 2.0 * r * (depth - hardness / stiffness));
    let force = PI * stiffness / (4.0 * r) * (a2 * a2 - b2 * b2);
    let reading = step.reading();
    let part = h / a2.sqrt();
    assert!((reading.force / force - 1.0).abs() < 1.6 * part, "{} {force}", reading.force);
    let plastic = percoat::reading::PlasticReading::of(&step).unwrap();
    assert!(
        (plastic.area / (PI * b2) - 1.0).abs() < part + plastic.area_error.unwrap() / (PI * b2),
        "{} {}",
        plastic.area,
        PI * b2
    );
    let pressed = depth - hardness / stiffness;
    assert!((plastic.depth / pressed - 1.0).abs() < 1e-3 && (plastic.permanent_depth / pressed - 1.0).abs() < 1e-3);
    assert!((plastic.volume / (PI * b2 * b2 / (4.0 * r)) - 1.0).abs() < 5e-3, "{}", plastic.volume);
}

/// Loaded, unloaded and loaded again: unloading and reloading are elastic, the second loading is the first step again, and an overload
/// goes on as if there had been no unloading. Reloading begins at the permanent depth.
#[test]
fn a_load_path_carries_what_is_pressed_in() {
    let window = Cell::window([1.0; 2]).unwrap();
    for problem in [
        Problem::new(ball(window, Shape::Paraboloid { radius: 1.0 }), bare(Some(0.06))),
        Problem::new(levels(), coated(Some(0.15))),
        Problem::new(rough(Cell::square(1.0).unwrap(), [60, 60]), bare(Some(0.05))),
    ] {
        let forces = [0.004, 0.001, 0.004, 0.006];
        let mut cycled = solver(problem.clone(), [75, 75]);
        let steps: Vec<Step> = forces
            .iter()
            .map(|&force| {
                let step = cycled.solve(Load::Force(force));
                assert!(step.report.stop.solved(), "{}", step.report);
                cycled.keep_indentation();
                step
            })
            .collect();
        let depths: Vec<Array2<f64>> = steps.iter().map(|step| step.indentation().unwrap()).collect();
        let largest = depths[0].iter().copied().fold(0.0, f64::max);
        assert!(largest > 0.0);
        let apart = |a: &Array2<f64>, b: &Array2<f64>| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert_eq!(depths[1], depths[0], "unloading presses nothing in");
        assert!(apart(&depths[2], &depths[0]) < 1e-4 * largest, "{:e}", apart(&depths[2], &depths[0]) / largest);
        let [first, again] = [0, 2].map(|k| pressures(&steps[k]));
        let worst = first.iter().zip(&again).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-3 * steps[0].finest().hardness(), "{worst:e}");
        assert!((steps[2].penetration() / steps[0].penetration() - 1.0).abs() < 1e-6);
        // The rest of the path as if there had been no unloading.
        let mut straight = solver(problem.clone(), [75, 75]);
        straight.solve(Load::Force(forces[0]));
        straight.keep_indentation();
        let beyond = straight.solve(Load::Force(forces[3]));
        assert!((steps[3].penetration() / beyond.penetration() - 1.0).abs() < 1e-5);
        // Elastic unloading: with what is pressed in as the shape and no hardness the same pressure.
        let soft = match problem.half_space().layers().is_empty() {
            true => Problem::new(problem.loaded_by().clone(), bare(None)),
            false => Problem::new(problem.loaded_by().clone(), coated(None)),
        };
        let gap = steps[1].surface().initial_gap().to_owned();
        let elastic = solver(soft, [75, 75]).with_gap(gap).unwrap().solve(Load::Force(forces[1]));
        assert!((elastic.penetration() / steps[1].penetration() - 1.0).abs() < 1e-6);
        let plastic = percoat::reading::PlasticReading::of(&steps[0]).unwrap();
        assert!(plastic.permanent_depth > 0.0 && plastic.permanent_depth < steps[1].penetration(), "{plastic}");
    }
}

/// A cone would have an infinite pressure at its tip: with hardness the largest pressure is the hardness, without error.
#[test]
fn the_pressure_under_a_tip_is_the_hardness() {
    let problem = Problem::new(ball(Cell::square(1.0).unwrap(), Shape::Cone { slope: 0.1 }), bare(Some(0.2)));
    let reading = solved(problem, [96, 96], Load::MeanPressure(0.002)).reading();
    assert!(!reading.singular() && reading.max_pressure == 0.2 && reading.errors.max_pressure == Some(0.0));
    assert!(reading.levels[0].max_pressure == 0.2 && reading.levels[0].errors.max_pressure == Some(0.0));
}

/// The softer of two surfaces sets the hardness, whichever it is.
#[test]
fn the_softer_surface_sets_the_hardness() {
    let of = |body: Option<f64>, counterbody: Option<f64>| {
        let bodies = Bodies::elastic(bare(body), coated(counterbody));
        solved(Problem::new(levels(), bodies), [48, 48], Load::MeanPressure(0.02)).reading().max_pressure
    };
    assert_eq!([of(Some(0.1), Some(0.12)), of(Some(0.12), Some(0.1)), of(None, Some(0.1))], [0.1; 3]);
    let rigid = Bodies::from(coated(None)).with_rigid_durability(hard(0.1)).unwrap();
    assert_eq!(solved(Problem::new(levels(), rigid), [48, 48], Load::MeanPressure(0.02)).reading().max_pressure, 0.1);
}

/// The errors of what is pressed in hold against a grid of four times the points.
#[test]
fn errors_of_what_is_pressed_in_hold() {
    let window = Cell::window([1.0; 2]).unwrap();
    let problem = Problem::new(ball(window, Shape::Paraboloid { radius: 1.0 }), bare(Some(0.06)));
    let read =
        |n: usize| percoat::reading::PlasticReading::of(&solved(problem.clone(), [n, n], Load::Force(0.004))).unwrap();
    let (coarse, fine) = (read(96), read(384));
    for (a, error, b) in [
        (coarse.area, coarse.area_error, fine.area),
        (coarse.depth, coarse.depth_error, fine.depth),
        (coarse.volume, coarse.volume_error, fine.volume),
        (coarse.permanent_depth, coarse.permanent_depth_error, fine.permanent_depth),
    ] {
        let error = error.unwrap();
        assert!((a - b).abs() < error && error < 0.2 * b, "{a} ± {error}, {b}");
    }
}

#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    let problem = Arc::new(Problem::new(rough(Cell::square(1.0).unwrap(), [96, 96]), coated(Some(0.03))));
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let solve = || {
            Solver::new(Arc::clone(&problem), [96, 96], Settings::default()).unwrap().solve(Load::MeanPressure(0.01))
        };
        pressures(&pool.install(solve))
    };
    assert_eq!(on(1), on(3));
}

/// A surface so soft that all of contact is at the hardness, with no sample between 0 and H: any penetration between the gaps inside and
/// outside contact solves it.
#[test]
fn a_contact_of_full_samples_alone_is_solved() {
    for (cell, points) in
        [(Cell::square(1.0).unwrap(), [24, 24]), (Cell::new([1.0, 0.0], [0.35, 0.9]).unwrap(), [21, 24])]
    {
        let count = points[0] * points[1];
        for (part, bodies) in [(10, bare(Some(1e-4))), (2, bare(Some(1e-4))), (2, coated(Some(1e-4)))] {
            let full = count / part;
            let mean = 1e-4 * full as f64 / count as f64;
            let settings = Settings { tolerance: 1e-12, ..Settings::default() };
            let mut solver = Solver::new(Problem::new(rough(cell, points), bodies), points, settings).unwrap();
            let step = solver.solve(Load::MeanPressure(mean));
            assert!(step.report.stop.solved() && step.report.iterations < 60, "{}", step.report);
            assert!(step.certificate.energy_gap < 1e-11, "{:?}", step.certificate);
            // Single precision leaves 1e-7 of H.
            let pressed = |least: f64| step.pressure().iter().filter(|&&p| p >= least * 1e-4).count();
            assert_eq!([pressed(1e-6), pressed(1.0 - 1e-6)], [full; 2], "{}", step.report);
            let gap = |full: bool| {
                let (p, g) = (step.pressure(), step.gap());
                let samples = p.iter().zip(&g).filter(|(p, _)| (**p > 5e-5) == full);
                samples.map(|(_, gap)| *gap).collect::<Vec<f64>>()
            };
            assert!(gap(true).iter().all(|gap| *gap < 1e-12) && gap(false).iter().all(|gap| *gap > -1e-12));
        }
    }
}

/// A counterbody that wears at its hardness keeps what it has pressed in: the path is that of elastic surfaces of the shape after the first
/// load, and wear lowers the pressure from the hardness on at once.
#[test]
fn wear_begins_on_the_shape_that_is_pressed_in() {
    let hardness = 0.06;
    let bodies = Bodies::from(coated(None)).with_rigid_durability(hard(hardness)).unwrap();
    let (cell, points, load) = (Cell::square(1.0).unwrap(), [48; 2], Load::MeanPressure(0.01));
    let wear = Wear::new(0.0, 1.0, [1.0, 0.0]).unwrap();
    let worn = |solver: &mut Solver| {
        let mut largest = Vec::new();
        let path = WearPath::new(load, wear, 0.02, 0.02).unwrap().slide(solver, &mut |step, _| {
            largest.push(step.max_pressure);
            ControlFlow::Continue(())
        });
        assert_eq!(path.unwrap().end, PathEnd::Complete);
        largest
    };
    let topography = rough(cell, points);
    let mut yielding = solver(Problem::new(topography.clone(), bodies), points);
    let begun = yielding.solve(load);
    assert!(begun.pressure().iter().any(|&p| p == hardness));
    yielding.keep_indentation();
    let shape = yielding.surface().initial_gap().to_owned();
    let largest = worn(&mut yielding);
    let mut elastic = solver(Problem::new(topography, coated(None)), points).with_gap(shape).unwrap();
    worn(&mut elastic);
    let [a, b] = [&mut yielding, &mut elastic].map(|solver| solver.solve(load));
    // Both solve to the root of 20 tolerance in the norm of the energy.
    let apart = pressures(&a).iter().zip(pressures(&b)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(apart < 5e-3 * hardness, "{apart:e} {largest:?}");
    // On the shape before the first load the pressure would stay H until the worn depth exceeds the permanent depth.
    assert!(largest.windows(2).all(|pair| pair[1] < pair[0]) && largest.last().unwrap() < &(0.995 * hardness));
    let kept = yielding.indented().unwrap().iter().copied().fold(0.0, f64::max);
    let first = begun.finest().indentation().unwrap().into_iter().fold(0.0, f64::max);
    assert!((kept / first - 1.0).abs() < 1e-3, "{kept} {first}");
}

/// A uniform pressure displaces nothing but the layers on a rigid base, so that all of the surface is at the hardness from δ = max f, and
/// there max f + C̄ H, on. Beyond it nothing is an answer, and a smaller penetration is solved as at first.
#[test]
fn a_penetration_that_takes_all_of_the_surface_to_its_hardness_is_no_answer() {
    let hardness = 0.1;
    let layer = Layer::new(young(3.0, 0.2), 0.1, Interface::Bonded).unwrap().with_durability(hard(hardness), None);
    let based = HalfSpace::on_rigid_base(vec![layer.unwrap()]).unwrap();
    let waves = || rough(Cell::square(1.0).unwrap(), [45, 48]);
    let problems = [
        Problem::new(levels(), bare(Some(hardness))),
        Problem::new(levels(), based),
        Problem::new(waves(), Bodies::elastic(bare(None), coated(Some(hardness)))),
        Problem::new(waves(), coated(Some(hardness))).sliding(Friction::new(0.3, [1.0, 0.5]).unwrap()).unwrap(),
    ];
    for problem in problems {
        let compliance = problem.bodies().mean_compliance();
        let mut solver = solver(problem.clone(), [45, 48]);
        let all = solver.surface().initial_gap().iter().copied().fold(0.0, f64::max) + compliance * hardness;
        let first = solver.solve(Load::Penetration(0.9 * all));
        assert!(first.report.stop.solved(), "{}", first.report);
        let nearly = solver.solve(Load::Penetration(0.99 * all));
        assert!(nearly.report.stop.solved() && complies(nearly.finest(), 1e-5)[1] > 1000, "{}", nearly.report);
        for part in [1.0 + 1e-9, 1.1, 10.0] {
            let step = solver.solve(Load::Penetration(part * all));
            assert_eq!(step.report.stop, Stop::BeyondHardness, "{part}: {}", step.report);
            assert!(pressures(&step).iter().all(|&p| p == 0.0) && step.elastic_energy() == 0.0);
            solver.keep_indentation();
        }
        let again = solver.solve(Load::Penetration(0.9 * all));
        let apart = pressures(&again).iter().zip(pressures(&first)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(again.report.stop.solved() && apart < 1e-3 * hardness, "{apart:e} {}", again.report);
        let check = |part: f64| {
            Run::new(problem.clone(), vec![Load::Penetration(part * all)], Sampling::Points([45, 48])).check()
        };
        assert!(check(0.999).is_ok());
        let Err(RunError::AllAtHardness(AllAtHardness { complete, .. })) = check(1.001) else { panic!("refused") };
        assert!((complete / all - 1.0).abs() < 1e-14, "{complete} {all}");
    }
}

/// On a part of the cell all of that part; in a window contact reaches the border, beyond which it would go on.
#[test]
fn a_mask_and_a_window_wholly_at_the_hardness_say_so() {
    let mask = Array2::from_shape_fn([40, 40], |(i, j)| i < 20 && j < 20);
    let waves = Problem::new(rough(Cell::square(1.0).unwrap(), [40, 40]), bare(Some(0.02)));
    let mut masked = solver(waves, [40, 40]).with_mask(mask).unwrap();
    let deepest = masked.surface().initial_gap().iter().copied().fold(0.0, f64::max);
    assert_eq!(masked.solve(Load::Penetration(20.0 * deepest)).report.stop, Stop::BeyondHardness);
    let light = masked.solve(Load::MeanPressure(0.001));
    assert!(light.report.stop.solved(), "{}", light.report);
    let window = Cell::window([1.0; 2]).unwrap();
    let ball = Problem::new(ball(window, Shape::Paraboloid { radius: 1.0 }), bare(Some(0.02)));
    for load in [Load::Penetration(3.0), Load::Force(0.0199)] {
        assert_eq!(solver(ball.clone(), [40, 40]).solve(load).report.stop, Stop::AtBorder, "{load}");
    }
}

/// Without friction loads follow one another at one place, also at a coefficient of zero; a softer body that is slid over drops what is
/// pressed in, and the run says so.
#[test]
fn a_path_under_friction_drops_what_is_pressed_in_and_says_so() {
    let window = Cell::window([1.0; 2]).unwrap();
    let of = |coefficient: Option<f64>, body: HalfSpace| {
        let problem = Problem::new(ball(window, Shape::Paraboloid { radius: 1.0 }), body);
        let problem = match coefficient {
            Some(coefficient) => problem.sliding(Friction::new(coefficient, [1.0, 0.0]).unwrap()).unwrap(),
            None => problem,
        };
        let loads = [0.004, 0.001].map(Load::Force).to_vec();
        Run::new(problem, loads, Sampling::Points([72, 72])).solve(&mut ()).unwrap()
    };
    let [none, zero, sliding] = [None, Some(0.0), Some(0.3)].map(|coefficient| of(coefficient, bare(Some(0.06))));
    let told =
        |warnings: &[String]| warnings.iter().any(|words| words.contains("the indentation left by step 1 is dropped"));
    for (a, b) in none.steps.iter().zip(&zero.steps) {
        // Some readings of an isolated contact are no numbers.
        assert_eq!(format!("{:?} {:?}", a.reading, a.plastic), format!("{:?} {:?}", b.reading, b.plastic));
    }
    let depth = |outcome: &percoat::run::Outcome| outcome.steps[1].reading.penetration;
    assert!(depth(&none) > 1.2 * depth(&sliding), "{} {}", depth(&none), depth(&sliding));
    assert_eq!([&none, &zero, &sliding].map(|outcome| told(&outcome.warnings)), [false, false, true]);
    assert!(!told(&of(Some(0.3), bare(Some(6.0))).warnings), "nothing is pressed in");
}

/// At P = 0 the penetration is that at which contact begins, and below it there is none; another load goes on from there.
#[test]
fn without_load_what_is_left_is_the_penetration() {
    let window = Cell::window([1.0; 2]).unwrap();
    for (problem, load) in [
        (Problem::new(ball(window, Shape::Paraboloid { radius: 1.0 }), bare(Some(0.06))), 0.004),
        (Problem::new(levels(), coated(Some(0.15))), 0.01),
        (Problem::new(rough(Cell::square(1.0).unwrap(), [60, 60]), bare(Some(0.05))), 0.01),
    ] {
        let mut solver = solver(problem.clone(), [60, 60]);
        let fresh = solver.solve(Load::Force(0.0));
        assert_eq!((fresh.report.stop, fresh.penetration()), (Stop::NoContact, 0.0));
        let loaded = solver.solve(Load::Force(load));
        solver.keep_indentation();
        let left = PlasticReading::of(&loaded).unwrap().permanent_depth;
        let begins = |solver: &mut Solver, load: Load| {
            let step = solver.solve(load);
            solver.keep_indentation();
            assert!(step.report.stop.solved(), "{load}: {}", step.report);
            step
        };
        let none = begins(&mut solver, Load::Force(0.0));
        assert_eq!(none.report.stop, Stop::NoContact);
        assert!(left > 0.0 && (none.penetration() / left - 1.0).abs() < 1e-12, "{} {left}", none.penetration());
        assert!(none.gap().iter().all(|&g| g >= 0.0) && none.gap().iter().any(|&g| g == 0.0));
        let reading = none.reading();
        let error = reading.errors.penetration.unwrap();
        println!("{left} ± {error}");
        assert!(!reading.touches() && error > 0.0 && error < 0.5 * left);
        let short = begins(&mut solver, Load::Penetration(0.5 * left));
        assert_eq!((short.report.stop, short.penetration()), (Stop::NoContact, 0.5 * left));
        // The lightest load touches at the depth that is left.
        let light = begins(&mut solver, Load::Force(1e-4 * load));
        assert!(light.penetration() > left && light.penetration() < 1.05 * left, "{} {left}", light.penetration());
        let again = begins(&mut solver, Load::Force(load));
        assert!((again.penetration() / loaded.penetration() - 1.0).abs() < 1e-6);
    }
}

/// Errors that the loading step has left are in the stated errors of the steps after it, against a grid of four times the points.
#[test]
fn errors_of_loading_are_inherited_by_unloading() {
    let window = Cell::window([1.0; 2]).unwrap();
    for (problem, hardest) in [
        (Problem::new(ball(window, Shape::Paraboloid { radius: 1.0 }), bare(Some(0.06))), 0.004),
        (Problem::new(ball(window, Shape::Cone { slope: 0.3 }), coated(Some(0.2))), 0.004),
        (Problem::new(levels(), coated(Some(0.15))), 0.008),
    ] {
        let forces = [1.0, 0.5, 0.1, 0.0, 0.3].map(|part| Load::Force(part * hardest));
        let path = |n: usize| {
            let mut solver = solver(problem.clone(), [n, n]);
            forces.map(|load| {
                let step = solver.solve(load);
                solver.keep_indentation();
                (step.reading(), PlasticReading::of(&step).unwrap())
            })
        };
        // The apex of the ball is a sample of each grid.
        let (coarse, fine) = (path(96), path(384));
        for (index, ((reading, plastic), (exact, left))) in coarse.iter().zip(&fine).enumerate() {
            let of = |name: &str, value: f64, error: Option<f64>, exact: f64| {
                let (off, error) = ((value - exact).abs(), error.unwrap());
                println!("step {index}, {name}: {value} ± {error:.1e}, {off:.1e} off");
                // Areas and volumes, which few samples of the coarser grids show, have wide errors.
                let is_useful = ["contact area", "volume"].contains(&name) || error < 0.3 * exact;
                assert!(off <= error && is_useful, "step {index}, {name}: {value} ± {error}, {exact}");
            };
            of("depth", plastic.depth, plastic.depth_error, left.depth);
            of("volume", plastic.volume, plastic.volume_error, left.volume);
            of("permanent depth", plastic.permanent_depth, plastic.permanent_depth_error, left.permanent_depth);
            of("penetration", reading.penetration, reading.errors.penetration, exact.penetration);
            if reading.touches() {
                of("contact area", reading.contact_area, reading.errors.contact_area, exact.contact_area);
                of("energy", reading.elastic_energy, reading.errors.elastic_energy, exact.elastic_energy);
            }
        }
    }
}

/// A hard thin coating on a softer substrate: its hardness is not reached, that of the substrate is.
fn thin_on_soft(thickness: f64, substrate: Option<f64>, strength: Option<f64>) -> HalfSpace {
    let layer = Layer::new(young(2.0, 0.2), thickness, Interface::Bonded).unwrap();
    let layer = layer.with_durability(hard(2.0), None).unwrap();
    let strength = percoat::Strength { yielding: strength, ..percoat::Strength::default() };
    HalfSpace::new(vec![layer], young(1.0, 0.3))
        .with_substrate_durability(Durability { hardness: substrate, ..Durability::default() })
        .unwrap()
        .with_substrate_strength(strength)
        .unwrap()
}

/// Said once: which material, how much and where; not where the substrate bears the pressure, or the coating is thick beside the contact.
#[test]
fn the_end_of_the_elastic_answer_is_said() {
    let window = Cell::window([1.0; 2]).unwrap();
    let said = |body: HalfSpace, force: f64| {
        let problem = Problem::new(ball(window, Shape::Paraboloid { radius: 1.0 }), body);
        let outcome = Run::new(problem, vec![Load::Force(force)], Sampling::Points([72, 72])).solve(&mut ()).unwrap();
        let ended: Vec<String> = outcome
            .warnings
            .iter()
            .filter(|words| words.contains("the elastic solution no longer holds"))
            .cloned()
            .collect();
        assert!(ended.len() < 2, "{ended:?}");
        (ended.into_iter().next(), outcome)
    };
    let force = 0.01;
    let (words, outcome) = said(thin_on_soft(0.002, Some(0.03), None), force);
    let (step, words) = (&outcome.steps[0], words.unwrap());
    let beneath = step.beneath.unwrap();
    assert_eq!((beneath.material.number, beneath.hardness, beneath.depth), (2, 0.03, 0.002));
    let radius = step.reading.levels[0].contact_radius.unwrap();
    let stiffer: f64 = (2.0 / 0.96) / (1.0 / 0.91);
    let decay = 1.0 + (0.002 * stiffer.cbrt() / radius).powi(2);
    assert!((beneath.pressure * decay / step.reading.levels[0].max_pressure - 1.0).abs() < 1e-6, "{beneath}");
    for part in ["step 1", "material 2", "hardness 0.03", "of the thickness of the layers"] {
        assert!(words.contains(part), "{part}: {words}");
    }
    // Hardness that bears it, none, and a thick coating.
    assert_eq!(said(thin_on_soft(0.002, Some(1.0), None), force).0, None);
    assert_eq!(said(thin_on_soft(0.002, None, None), force).0, None);
    assert_eq!(said(thin_on_soft(0.9, Some(0.03), None), 0.001).0, None);
    // Nothing says what the substrate bears.
    let (_, outcome) = said(thin_on_soft(0.002, None, None), force);
    assert!(
        outcome.warnings.iter().any(|words| words.contains("how much it bears is not known")),
        "{:?}",
        outcome.warnings
    );
    // Yield inside, with its depth, in place of the hardness of the same material.
    let (words, outcome) = said(thin_on_soft(0.002, Some(0.03), Some(0.01)), force);
    let (words, row) = (words.unwrap(), &outcome.steps[0].strength[0]);
    assert!(row.value > 2.0 && words.contains("yield of material 2 has the utilisation"), "{words}");
    assert!(!words.contains("hardness") && words.contains("at the depth"), "{words}");
    assert_eq!(said(thin_on_soft(0.002, Some(1.0), Some(0.5)), force).0, None);
}

/// Depths pressed into a coating beyond a tenth of it, and layers on a rigid base that are nearly pressed through.
#[test]
fn layers_that_are_pressed_too_deep_are_told() {
    let cell = Cell::square(1.0).unwrap();
    let told = |body: HalfSpace, load: Load, word: &str| {
        let problem = Problem::new(ball(cell, Shape::Paraboloid { radius: 1.0 }), body);
        let outcome = Run::new(problem, vec![load], Sampling::Points([72, 72])).solve(&mut ()).unwrap();
        outcome.warnings.iter().any(|words| words.contains(word))
    };
    let layer = |h: f64| Layer::new(young(3.0, 0.2), h, Interface::Bonded).unwrap();
    let hard_layer = |h: f64| layer(h).with_durability(hard(0.05), None).unwrap();
    for (thickness, expected) in [(0.01, true), (0.5, false)] {
        let body = HalfSpace::new(vec![hard_layer(thickness)], young(1.0, 0.3));
        assert_eq!(told(body, Load::MeanPressure(0.01), "beyond a tenth of it"), expected, "{thickness}");
    }
    for (depth, expected) in [(0.05, true), (0.01, false)] {
        let body = HalfSpace::on_rigid_base(vec![layer(0.1)]).unwrap();
        assert_eq!(told(body, Load::Penetration(depth), "on a rigid base in step"), expected, "{depth}");
    }
}

/// Every grid has its depths in a checkpoint: what follows has the same pressures, and the same errors.
#[test]
fn a_path_goes_on_from_its_checkpoint_as_without_it() {
    let problem = Arc::new(Problem::new(levels(), coated(Some(0.15))));
    let loads = [0.008, 0.003, 0.01, 0.0].map(Load::Force);
    let whole = |solver: &mut Solver, load: Load| {
        let step = solver.solve(load);
        let saved = solver.checkpoint(&step);
        solver.keep_indentation();
        (format!("{:?} {:?}", step.reading(), PlasticReading::of(&step)), pressures(&step), saved)
    };
    let new = || Solver::new(Arc::clone(&problem), [96, 96], Settings::default()).unwrap();
    let mut straight = new();
    let steps = loads.map(|load| whole(&mut straight, load));
    for saved in 0..3 {
        let mut again = new();
        let step = again.restore(loads[saved], steps[saved].2.clone()).unwrap();
        assert_eq!(format!("{:?} {:?}", step.reading(), PlasticReading::of(&step)), steps[saved].0, "{saved}");
        again.keep_indentation();
        for index in saved + 1..4 {
            let (reading, pressure, _) = whole(&mut again, loads[index]);
            assert!(reading == steps[index].0 && pressure == steps[index].1, "{index} after {saved}");
        }
    }
}

/// A layer 0.1 thick with the modulus of the substrate, whose hardnesses are those given.
fn hard_layer([layer, substrate]: [f64; 2]) -> HalfSpace {
    let coating =
        Layer::new(young(1.0, 0.3), 0.1, Interface::Bonded).unwrap().with_durability(hard(layer), None).unwrap();
    HalfSpace::new(vec![coating], young(1.0, 0.3)).with_substrate_durability(hard(substrate)).unwrap()
}

fn pressed_by_a_ball(body: HalfSpace, composite: Option<(HardnessLaw, f64)>) -> Solver {
    pressed_on(64, body, composite)
}

fn pressed_on(points: usize, body: HalfSpace, composite: Option<(HardnessLaw, f64)>) -> Solver {
    let counterbody = ball(Cell::window([2.0; 2]).unwrap(), Shape::Paraboloid { radius: 1.0 });
    let mut problem = Problem::new(counterbody, body);
    if let Some((law, constant)) = composite {
        let hardness = CompositeHardness::of(problem.half_space(), law, constant).unwrap();
        problem = problem.with_composite_hardness(hardness).unwrap();
    }
    Solver::new(problem, [points; 2], Settings { tolerance: 1e-10, ..Settings::default() }).unwrap()
}

/// By hand: below the hardness a ball has δ = 0.25 R where a = 0.5 R, and H = H_s + φ(2.5)(H_c − H_s).
#[test]
fn an_elastic_contact_meets_the_composite_hardness_of_hertz() {
    let force = 4.0 / 3.0 * 0.5f64.powi(3) / (1.0 - 0.3 * 0.3);
    let constant = 0.5 / 2.5;
    for (law, constant, part) in [
        (HardnessLaw::Area, 0.5, constant * (2.0 - constant)),
        (HardnessLaw::Korsunsky, 0.4, 1.0 / (1.0 + 0.4 * 2.5 * 2.5)),
    ] {
        let step = pressed_by_a_ball(hard_layer([3.0, 1.0]), Some((law, constant))).solve(Load::Force(force));
        let plastic = PlasticReading::of(&step).unwrap();
        // δ on 32 samples a diameter errs by some 1e-3, and dH/dδ · δ is below 2.
        assert!((plastic.hardness_depth.unwrap() / 0.25 - 1.0).abs() < 2e-3, "{plastic:?}");
        assert!(
            (plastic.hardness - (1.0 + 2.0 * part)).abs() < 4e-3 && !plastic.is_pressed_in(),
            "{law:?}: {plastic:?}"
        );
    }
}

/// A ball goes deeper than a depth with the hardness that belongs to it, up to the depth that is found, and less deep beyond: soft and hard
/// substrates, both laws, by force and by penetration; with the same start from earlier loads and after a checkpoint.
#[test]
fn what_yields_has_the_hardness_of_its_own_penetration() {
    for (law, constant, hardness) in [
        (HardnessLaw::Area, 0.5, [0.2, 0.08]),
        (HardnessLaw::Area, 1.0, [0.1, 0.3]),
        (HardnessLaw::Korsunsky, 0.3, [0.2, 0.08]),
        (HardnessLaw::Korsunsky, 0.1, [0.12, 0.3]),
    ] {
        let body = hard_layer(hardness);
        let composite = CompositeHardness::of(&body, law, constant).unwrap();
        let penetration_at =
            |hardness: f64, load: Load| pressed_by_a_ball(hard_layer([hardness, 9.0]), None).solve(load).penetration();
        for load in [Load::Force(0.05), Load::Penetration(0.2)] {
            let mut solver = pressed_by_a_ball(body.clone(), Some((law, constant)));
            let step = solver.solve(load);
            assert!(step.report.stop.solved(), "{law:?}: {}", step.report);
            let plastic = PlasticReading::of(&step).unwrap();
            let found = plastic.hardness_depth.unwrap();
            for (part, goes_deeper) in [(0.5, true), (1.0 - 1e-5, true), (1.0 + 1e-5, false), (2.0, false)] {
                let depth = part * found;
                let penetration = penetration_at(composite.at(depth), load);
                assert!(
                    (penetration > depth) == goes_deeper,
                    "{law:?} {hardness:?}: {plastic:?}, {penetration} at {depth}"
                );
            }
            assert!((plastic.hardness / composite.at(found) - 1.0).abs() < 1e-5, "{law:?}: {plastic:?}");
            assert!(plastic.is_pressed_in() && step.pressure().iter().all(|&p| p <= plastic.hardness), "{plastic:?}");
            let checkpoint = solver.checkpoint(&step);
            let mut other = pressed_by_a_ball(body.clone(), Some((law, constant)));
            let restored = other.restore(load, checkpoint).unwrap();
            let again = PlasticReading::of(&restored).unwrap();
            assert!(again == plastic && restored.pressure() == step.pressure(), "{again:?}, {plastic:?}");
        }
    }
}

/// Deep in the layer a small change of δ changes the hardness, and that changes δ once more. Errors on coarse grids hold this against a
/// grid four times as fine and finer, and each is at least the change from half the points solved alone, with the hardness of that depth.
#[test]
fn errors_at_a_composite_hardness_hold_its_feedback() {
    for (law, constant, hardness, force) in [
        (HardnessLaw::Area, 0.5, [0.2, 0.08], 0.05),
        (HardnessLaw::Area, 0.5, [0.2, 0.03], 0.03),
        (HardnessLaw::Korsunsky, 0.3, [0.15, 0.04], 0.04),
    ] {
        let read = |points: usize| {
            let mut solver = pressed_on(points, hard_layer(hardness), Some((law, constant)));
            let step = solver.solve(Load::Force(force));
            assert!(step.report.stop.solved(), "{}", step.report);
            let (whole, plastic) = (step.reading(), PlasticReading::of(&step).unwrap());
            [
                (whole.penetration, whole.errors.penetration),
                (whole.contact_area, whole.errors.contact_area),
                (plastic.depth, plastic.depth_error),
                (plastic.volume, plastic.volume_error),
            ]
        };
        let fine = read(320);
        assert!(fine[3].0 > 0.0, "{law:?}: nothing is pressed in");
        for points in [48, 60, 64, 80] {
            let (whole, half) = (read(points), read(points / 2));
            let change = (whole[0].0 - half[0].0).abs();
            assert!(change <= whole[0].1.unwrap(), "{law:?} {points}: {whole:?}, {change}");
            for (number, ((value, error), (truth, left))) in whole.into_iter().zip(fine).enumerate() {
                let [error, left] = [error, left].map(Option::unwrap);
                assert!((value - truth).abs() <= error + left, "{law:?} {points} {number}: {value} ± {error}, {truth}");
            }
        }
    }
}

/// A soft layer alone yields to the border of the window under this load; with the substrate it bears it.
#[test]
fn a_soft_coating_on_a_hard_substrate_bears_what_it_would_not_alone() {
    let (body, load) = (hard_layer([0.02, 0.5]), Load::Force(0.1));
    let alone = pressed_by_a_ball(body.clone(), None).solve(load);
    assert!(!alone.report.stop.solved(), "{}", alone.report);
    let step = pressed_by_a_ball(body, Some((HardnessLaw::Area, 0.3))).solve(load);
    let plastic = PlasticReading::of(&step).unwrap();
    assert!(step.report.stop.solved() && plastic.hardness > 0.02, "{}: {plastic:?}", step.report);
}

/// The kink of a roof lies between its samples: the height of it is as little known when nothing is left of the load.
#[test]
fn what_is_left_errs_with_a_kink_between_the_samples() {
    let roof = |i: usize| -0.05 * ((i as f64 + 0.5) / 32.0 - 0.5).abs();
    let topography =
        Topography::new(Cell::square(1.0).unwrap(), Array2::from_shape_fn((32, 32), |(i, _)| roof(i))).unwrap();
    let missed = topography.apex_error();
    let body = HalfSpace::new(vec![], young(1.0, 0.3)).with_substrate_durability(hard(0.02)).unwrap();
    let mut solver = Solver::new(Problem::new(topography, body), [96; 2], Settings::default()).unwrap();
    let loaded = solver.solve(Load::MeanPressure(5e-3));
    let pressed = PlasticReading::of(&loaded).unwrap();
    solver.keep_indentation();
    let left = solver.solve(Load::MeanPressure(0.0)).reading();
    assert!(missed > 0.0 && pressed.permanent_depth > 0.0, "{missed} {pressed:?}");
    let errors = [pressed.permanent_depth_error, left.errors.penetration].map(Option::unwrap);
    assert!(errors.iter().all(|error| *error >= missed), "{errors:?} {missed}");
}
