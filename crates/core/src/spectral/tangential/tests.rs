//! Against closed forms and converged numbers.

use super::aim::Aim;
use super::prolonged::prolonged;
use super::rolling::Rolling;
use super::solver::{Drive, MeasuredVector, RollingDrive, SlipSolver};
use super::stick_slip::SlipSettings;
use super::track::Track;
use crate::body::{Bodies, HalfSpace, Interface, Layer, Material};
use crate::counterbody::{Indenters, Level, Shape, Topography};
use crate::friction::Friction;
use crate::lattice::{Cell, Grid, Lattice};
use crate::load::Load;
use crate::problem::Problem;
use crate::spectral::Settings;
use ndarray::Array2;
use std::f64::consts::PI;

fn bare(poisson: f64) -> HalfSpace {
    HalfSpace::new(vec![], Material::from_shear(1.0, poisson).unwrap())
}

/// A ball of the radius 1 in a window, on like bodies of the shear modulus 1.
fn ball(window: f64, poisson: f64, friction: f64) -> Problem {
    let level = Level::new(Shape::Paraboloid { radius: 1.0 }, 0.0).unwrap();
    let lattice = Lattice::new(Cell::window([window; 2]).unwrap(), vec![vec![[0.5; 2]]]).unwrap();
    let indenters = Indenters::new(lattice, vec![level]).unwrap();
    Problem::new(indenters, Bodies::elastic(bare(poisson), bare(poisson)))
        .sliding(Friction::new(friction, [1.0, 0.0]).unwrap())
        .unwrap()
}

fn track(problem: &Problem, n: usize) -> Track {
    let settings = Settings { tolerance: 1e-10, ..Settings::default() };
    Track::new(problem, [n; 2], settings, SlipSettings::default()).unwrap()
}

/// Cattaneo and Mindlin, exact for like bodies with ν = 0: shift, and the work of a cycle. At 49 samples a radius shifts err by the order of
/// the square of 1/49 over its first digits, works by ten times that.
#[test]
fn a_ball_on_like_bodies_has_the_shift_and_loop_of_mindlin() {
    let (mu, p) = (0.5, 4.0 / 3.0);
    for s in [0.3, 0.6, 0.9] {
        let mut track = track(&ball(2.6, 0.0, mu), 128);
        let mut to = |part: f64| track.advance(Load::Force(p), Aim::Force([part * mu * p, 0.0]));
        let (up, down, again) = (to(s), to(-s), to(s));
        assert!([&up, &down, &again].iter().all(|step| step.report.converged && step.report.iterations <= 20));
        // D = 3μP(2 − ν)/(8aG).
        let exact = 0.75 * mu * p * (1.0 - (1.0f64 - s).powf(2.0 / 3.0));
        assert!((up.shift[0] / exact - 1.0).abs() < 4e-5 && up.shift[1].abs() < 1e-12, "{s}: {:?}", up.shift);
        let rise = 1.0 - (1.0 - s).powf(5.0 / 3.0) - 5.0 * s / 6.0 * (1.0 + (1.0 - s).powf(2.0 / 3.0));
        let exact = 18.0 / 5.0 * mu * mu * p * p * rise;
        let error = (down.work + again.work) / exact - 1.0;
        assert!(error.abs() < 4e-4, "{s}: {error:e}");
        // The annulus of slip lies beyond c = a(1 − s)^{1/3}.
        let stick = (1.0f64 - s).powf(2.0 / 3.0);
        assert!((up.stick_fraction - stick).abs() < 0.02, "{s}: {} {stick}", up.stick_fraction);
        assert!((up.force[0] / (s * mu * p) - 1.0).abs() < 1e-12 && up.force[1].abs() < 1e-12);
    }
}

/// Like coated bodies under a wave, plane strain: shift and loop of a dense solver by Chebyshev polynomials, which a spectral prototype
/// confirms to 1e-6 with 4096 samples, and to 4e-4 in the loop with 512.
#[test]
fn coated_waves_have_their_known_shifts() {
    let cases = [
        (None::<[f64; 3]>, 0.3, [[0.3, 0.0011157535], [0.6, 0.0025274716], [0.9, 0.0045031430]], 4.766830e-6),
        (Some([4.0, 0.25, 0.05]), 0.3, [[0.3, 0.0005276162], [0.6, 0.0011509406], [0.9, 0.0019656818]], 1.542909e-6),
        (Some([0.25, 0.45, 0.05]), 0.3, [[0.3, 0.0023168214], [0.6, 0.0054277231], [0.9, 0.0100289086]], 1.279672e-5),
        (Some([20.0, 0.2, 0.01]), 0.3, [[0.3, 0.0003433056], [0.6, 0.0007889065], [0.9, 0.0013802942]], f64::NAN),
    ];
    for (layer, nu, shifts, cycle) in cases {
        let layers =
            layer.map(|[chi, nu, h]| Layer::new(Material::from_shear(chi, nu).unwrap(), h, Interface::Bonded).unwrap());
        let body = HalfSpace::new(layers.into_iter().collect(), Material::from_shear(1.0, nu).unwrap());
        let (mean, area) = (0.01, 4.0 / 512.0);
        let problem = || wave(Bodies::elastic(body.clone(), body.clone()));
        for [s, exact] in shifts {
            let mut track = wave_track(&problem(), 512);
            let up = track.advance(Load::MeanPressure(mean), Aim::Force([s * mean * area, 0.0]));
            let error = up.shift[0] / exact - 1.0;
            assert!(error.abs() < 1.5e-4 && up.report.iterations <= 20, "{layer:?}, {s}: {error:e}");
            if s == 0.6 && cycle.is_finite() {
                let down = track.advance(Load::MeanPressure(mean), Aim::Force([-s * mean * area, 0.0]));
                let again = track.advance(Load::MeanPressure(mean), Aim::Force([s * mean * area, 0.0]));
                let error = (down.work + again.work) / (4.0 / 512.0) / cycle - 1.0;
                assert!(error.abs() < 6e-4, "{layer:?}: {error:e}");
            }
        }
    }
}

/// The counterbody f = 0.01(1 − cos 2πx) on like bodies, the same along y.
fn wave(bodies: Bodies) -> Problem {
    let (n, rows) = (512, 4);
    let cell = Cell::new([1.0, 0.0], [0.0, rows as f64 / n as f64]).unwrap();
    let height = |(i, _): (usize, usize)| 0.01 * ((2.0 * PI * i as f64 / n as f64).cos() - 1.0);
    let surface = Topography::new(cell, Array2::from_shape_fn((n, rows), height)).unwrap();
    Problem::new(surface, bodies).sliding(Friction::new(1.0, [1.0, 0.0]).unwrap()).unwrap()
}

fn wave_track(problem: &Problem, n: usize) -> Track {
    let settings = Settings { tolerance: 1e-10, ..Settings::default() };
    Track::new(problem, [n, 4], settings, SlipSettings::default()).unwrap()
}

/// A ball of the radius 1 over bodies in a window of `n` samples at a spacing.
fn ball_on(bodies: Bodies, friction: f64, window: f64) -> Problem {
    let level = Level::new(Shape::Paraboloid { radius: 1.0 }, 0.0).unwrap();
    let lattice = Lattice::new(Cell::window([window; 2]).unwrap(), vec![vec![[0.5; 2]]]).unwrap();
    let indenters = Indenters::new(lattice, vec![level]).unwrap();
    Problem::new(indenters, bodies).sliding(Friction::new(friction, [1.0, 0.0]).unwrap()).unwrap()
}

fn coated(chi: f64, [nu1, nu2]: [f64; 2], h: f64) -> HalfSpace {
    let layer = Layer::new(Material::from_shear(chi, nu1).unwrap(), h, Interface::Bonded).unwrap();
    HalfSpace::new(vec![layer], Material::from_shear(1.0, nu2).unwrap())
}

/// Slip turns where ν is not 0: converged numbers of a prototype, and what Cattaneo and Mindlin miss.
#[test]
fn slip_that_turns_has_its_known_shift() {
    let p = 4.0 / 3.0 / 0.7;
    for (s, exact) in [(0.3, 0.256923), (0.6, 0.554810), (0.9, 0.951877)] {
        let mut track = track(&ball(2.4, 0.3, 1.0), 96);
        let up = track.advance(Load::Force(p), Aim::Force([s * p, 0.0]));
        // 2e-5 … 6e-5 of the prototype between 96 and 192 samples.
        let error = up.shift[0] / exact - 1.0;
        assert!(error.abs() < 8e-5 && up.report.iterations <= 20, "{s}: {error:e}");
        let mindlin = 3.0 * p * 1.7 / 8.0 * (1.0 - (1.0f64 - s).powf(2.0 / 3.0));
        assert!((up.shift[0] / mindlin - 1.0).abs() > 1e-4, "the formula is near, not exact");
    }
}

#[test]
fn a_coated_ball_has_the_same_shift_in_every_window() {
    let body = coated(4.0, [0.25, 0.3], 0.3);
    let shift = |window: f64, spacing: f64| {
        let problem = ball_on(Bodies::elastic(body.clone(), body.clone()), 1.0, window);
        let mut track = track(&problem, (window / spacing).round() as usize);
        track.advance(Load::Force(1.0), Aim::Force([0.6, 0.0])).shift[0]
    };
    let [narrow, wide] = [2.4, 3.6].map(|window| shift(window, 0.05));
    assert!((narrow / wide - 1.0).abs() < 1e-8, "{narrow} {wide}");
    // A prototype has 0.20010560 at a spacing of 0.025, which differs from that at 0.05 by 1e-4.
    let fine = shift(2.4, 0.025);
    assert!((fine / 0.20010560 - 1.0).abs() < 1e-4, "{fine}");
}

#[test]
fn unlike_bodies_couple() {
    let ball = HalfSpace::new(vec![], Material::from_shear(2.0, 0.3).unwrap());
    let problem = ball_on(Bodies::elastic(coated(4.0, [0.2, 0.3], 0.3), ball), 0.3, 2.4);
    for (s, exact) in [(0.6, 0.0662183), (0.95, 0.1224056)] {
        let mut track = track(&problem, 48);
        let up = track.advance(Load::Force(1.0), Aim::Force([s * 0.3, 0.0]));
        // The grid of the prototype has the spacing of this one, and another place of the apex.
        assert!((up.shift[0] / exact - 1.0).abs() < 3e-4 && up.turns <= 8, "{s}: {} turns, {}", up.turns, up.shift[0]);
    }
}

/// Under a rigid counterbody pressure and tractions couple strongly, and few samples stick near μP.
#[test]
fn a_rigid_counterbody_takes_few_turns() {
    for part in [0.05, 0.6, 0.9, 0.99] {
        let mut track = track(&ball_on(Bodies::from(coated(4.0, [0.2, 0.3], 0.3)), 0.3, 2.4), 64);
        let step = track.advance(Load::Force(1.0), Aim::Force([part * 0.3, 0.0]));
        assert!(step.is_converged() && step.turns <= 12, "{part}: {} turns, {:?}", step.turns, step.report);
    }
}

/// 107 samples to the radius, of which eight at the edge bear 1e-5 of the pressure: their slip must not move the others.
#[test]
fn samples_that_hardly_touch_do_not_slow_the_iteration() {
    let mut track = track(&ball(2.4, 0.3, 1.0), 256);
    let p = 4.0 / 3.0 / 0.7;
    for part in [0.99, -0.99] {
        let step = track.advance(Load::Force(p), Aim::Force([part * p, 0.0]));
        assert!(step.is_converged() && step.report.iterations <= 20, "{part}: {:?}", step.report);
    }
}

/// dQ/dP = μ/2 from zero: nothing slips, and the shift is κ times the penetration. One step would be 26 % short; steps in parts are of first
/// order, and their extrapolation is within its stated error.
#[test]
fn proportional_loading_does_not_slip() {
    let mut last = f64::INFINITY;
    for parts in [4, 8, 16] {
        let settings = Settings { tolerance: 1e-10, ..Settings::default() };
        let solver = SlipSolver::new(ball(2.6, 0.0, 0.5), [64; 2], settings, SlipSettings::default());
        let mut solver = solver.unwrap().with_parts(parts);
        solver.advance(Load::Force(1e-6), Drive::Part([0.5, 0.0])).unwrap();
        let step = solver.advance(Load::Force(4.0 / 3.0), Drive::Part([0.5, 0.0])).unwrap();
        let error = (step.shift.value[0] - 0.25 * step.contact.penetration()).abs();
        assert!(error < step.shift.error, "{parts}: {error:e} {:?}", step.shift);
        assert!(step.work.value.abs() < step.work.error.unwrap(), "{parts}: {:?}", step.work);
        assert!(error < 0.6 * last, "{parts}: {error:e} {last:e}");
        last = error;
    }
}

#[test]
fn a_force_that_friction_does_not_bear_is_refused() {
    let mut solver =
        SlipSolver::new(ball(2.6, 0.0, 0.5), [48; 2], Settings::default(), SlipSettings::default()).unwrap();
    let refused = solver.advance(Load::Force(1.0), Drive::Part([0.8, 0.6])).unwrap_err();
    assert!(refused.to_string().contains("slides"), "{refused}");
    let frictionless = ball(2.6, 0.0, 0.5).at_rest();
    assert!(SlipSolver::new(frictionless, [48; 2], Settings::default(), SlipSettings::default()).is_err());
}

fn slip_solver(problem: Problem, n: usize) -> SlipSolver {
    let settings = Settings { tolerance: 1e-10, ..Settings::default() };
    SlipSolver::new(problem, [n; 2], settings, SlipSettings::default()).unwrap()
}

/// Under a shift the force is found: that of the force that leads to this shift.
#[test]
fn a_shift_leads_to_the_force_that_leads_to_it() {
    let load = Load::Force(4.0 / 3.0);
    let by_force = slip_solver(ball(2.6, 0.0, 0.5), 64).advance(load, Drive::Part([0.6, 0.0])).unwrap();
    let mut solver = slip_solver(ball(2.6, 0.0, 0.5), 64);
    let by_shift = solver.advance(load, Drive::Shift(by_force.shift.value)).unwrap();
    let [force, exact] = [&by_shift, &by_force].map(|step| step.force.value[0]);
    assert_eq!(by_force.force.error, 0.0);
    assert!((force / exact - 1.0).abs() < 1e-5, "{force} {exact}");
    assert!(by_shift.force.error > 0.0 && by_shift.shift.error < 1e-12, "{by_shift:?}");
    // The force is extrapolated over the parts of a step whose load changes: back and forth leaves what the error says.
    let by_parts = |parts: usize| {
        let mut solver = slip_solver(ball(2.6, 0.0, 0.5), 64).with_parts(parts);
        let mut to = |p: f64| solver.advance(Load::Force(p), Drive::Shift(by_force.shift.value)).unwrap().force;
        to(4.0 / 3.0);
        [to(1.0), to(4.0 / 3.0)]
    };
    for (coarse, fine) in by_parts(8).into_iter().zip(by_parts(32)) {
        let apart = (coarse.value[0] - fine.value[0]).abs();
        // The rest of the error is that of the grid.
        assert!(apart < coarse.error && fine.error < 1.01 * coarse.error, "{coarse:?} {fine:?}");
    }
}

/// A drive of another kind goes on from what the one before it has come to.
#[test]
fn a_shift_goes_on_from_a_force() {
    let load = Load::Force(1.0);
    let mut solver = slip_solver(ball(2.6, 0.0, 0.5), 64);
    let before = solver.advance(load, Drive::Part([0.5, 0.0])).unwrap();
    // The same load in another quantity, within rounding, and the shift that is there: nothing changes.
    let area = solver.problem().cell().area();
    let kept = solver.advance(Load::MeanPressure(1.0 / area), Drive::Shift(before.shift.value)).unwrap();
    assert!((kept.force.value[0] - before.force.value[0]).abs() < 1e-7, "{kept:?}");
    assert!(kept.work.value.abs() < 1e-9, "{kept:?}");
}

#[test]
fn without_a_load_nothing_sticks() {
    let mut solver = slip_solver(ball(2.6, 0.0, 0.5), 48);
    let mut to = |p: f64, part: f64| solver.advance(Load::Force(p), Drive::Part([part, 0.0])).unwrap();
    for step in [to(0.0, 0.5), to(1.0, 0.5), to(0.0, 0.5)] {
        let numbers = [step.force.value[0], step.shift.value[0], step.work.value, step.stick_fraction.value];
        assert!(numbers.iter().all(|number| number.is_finite()), "{step:?}");
        assert_eq!(step.force.value[0] == 0.0, step.limit == 0.0);
    }
    let rolling = Rolling { direction: [1.0, 0.0], distance: 1.0, step: 0.5 };
    let refused = solver.roll(Load::Force(0.0), RollingDrive::Part([0.1, 0.0]), rolling).unwrap_err();
    assert!(refused.to_string().contains("without a load"), "{refused}");
}

/// Bit for bit, with coupled tractions, a changing load and a step of rolling.
#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    let numbers = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let ball = HalfSpace::new(vec![], Material::from_shear(2.0, 0.3).unwrap());
            let problem = ball_on(Bodies::elastic(coated(4.0, [0.2, 0.3], 0.3), ball), 0.3, 2.4);
            let mut solver = slip_solver(problem, 48).with_parts(2);
            let step = solver.advance(Load::Force(1.0), Drive::Part([0.5, 0.2])).unwrap();
            let rolling = Rolling { direction: [1.0, 0.0], distance: 0.5, step: 0.25 };
            let rolled = solver.roll(Load::Force(1.0), RollingDrive::Part([0.3, 0.0]), rolling).unwrap();
            [step, rolled].map(|step| {
                let shear = step.contact.finest().shear().unwrap().clone();
                let bits = |values: &[f64]| values.iter().map(|value| value.to_bits()).collect::<Vec<u64>>();
                let fields: Vec<_> = shear.traction.iter().chain(&shear.slip).map(|field| bits(field)).collect();
                (fields, bits(&step.shift.value), bits(&step.force.value), step.work.value.to_bits())
            })
        })
    };
    let one = numbers(1);
    assert!([2, 5].into_iter().all(|threads| numbers(threads) == one));
}

/// Steady rolling of a wave on like bodies: stick begins at the leading edge. Creepages over μ of a dense solver.
#[test]
fn rolling_waves_have_their_known_creepage() {
    let body = |layer: Option<[f64; 3]>| {
        let layers =
            layer.map(|[chi, nu, h]| Layer::new(Material::from_shear(chi, nu).unwrap(), h, Interface::Bonded).unwrap());
        HalfSpace::new(layers.into_iter().collect(), Material::from_shear(1.0, 0.3).unwrap())
    };
    let cases = [
        (None, [(0.3, 0.0087031381), (0.9, 0.0368341087)]),
        (Some([4.0, 0.25, 0.05]), [(0.3, 0.0040454302), (0.9, 0.0170930566)]),
        (Some([0.25, 0.45, 0.05]), [(0.3, 0.0182107140), (0.9, 0.0782824542)]),
    ];
    for (layer, creepages) in cases {
        for (part, exact) in creepages {
            let problem = wave(Bodies::elastic(body(layer), body(layer)));
            let mut solver = SlipSolver::new(problem, [512, 4], Settings::default(), SlipSettings::default()).unwrap();
            let rolling = Rolling { direction: [1.0, 0.0], distance: 3.0, step: 0.125 };
            let rolled = solver.roll(Load::MeanPressure(0.01), RollingDrive::Part([part, 0.0]), rolling).unwrap();
            let MeasuredVector { value, error } = rolled.creepage.unwrap();
            assert!((value[0] - exact).abs() < error && rolled.converged, "{layer:?}, {part}: {value:?} ± {error:e}");
            // A prototype with 16 and 32 steps a contact length, extrapolated, is within .25 %; 8 and 16 may be four times as far.
            assert!((value[0] / exact - 1.0).abs() < 1e-2, "{layer:?}, {part}: {value:?}");
        }
    }
}

/// Samples that both grids have keep their part of μp, none is beyond it, and a start from the coarser grid takes fewer iterations.
#[test]
fn tractions_of_a_coarser_grid_are_a_start() {
    let (load, drive) = (Load::Force(1.0), Drive::Part([0.6, 0.0]));
    let step = slip_solver(ball(2.6, 0.3, 0.5), 48).advance(load, drive).unwrap();
    let (coarse, grid) = (step.contact.finest(), Grid::new(step.contact.grid().cell(), [96, 144]).unwrap());
    let parts = prolonged(coarse, &grid).unwrap();
    let shear = coarse.shear().unwrap();
    let mut touching = 0;
    for (i, p) in coarse.pressures().iter().enumerate() {
        let found = parts[2 * (i / 48) * 144 + 3 * (i % 48)];
        if *p > 0.0 {
            touching += 1;
            let exact = [0, 1].map(|axis| shear.traction[axis][i] / (0.5 * p));
            assert!((0..2).all(|axis| (found[axis] - exact[axis]).abs() < 1e-5), "{found:?} {exact:?}");
        }
    }
    assert!(touching > 200 && parts.iter().all(|[x, y]| x.hypot(*y) < 1.0 + 1e-9));
    let from_coarser = slip_solver(ball(2.6, 0.3, 0.5), 192).advance(load, drive).unwrap();
    let settings = Settings { tolerance: 1e-10, ..Settings::default() };
    let mut track = Track::new(&ball(2.6, 0.3, 0.5), [192; 2], settings, SlipSettings::default()).unwrap();
    let cold = track.advance(load, Aim::Force([0.3, 0.0]));
    assert!(from_coarser.report.iterations < cold.report.iterations, "{from_coarser:?} {:?}", cold.report);
    assert!((from_coarser.shift.value[0] / cold.shift[0] - 1.0).abs() < 1e-6);
}
