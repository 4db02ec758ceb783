//! Loads in time on bodies that creep: closed forms, limits, orders, stated errors.

use ndarray::Array2;
use percoat::body::{ConstantModulus, Relaxation};
use percoat::creep::Retardation;
use percoat::run::{Recorder, Times};
use percoat::spectral::{CreepError, CreepSolver, CreepStep};
use percoat::steady_motion::SteadyMotion;
use percoat::{
    Bodies, Cell, Friction, GivenPressure, HalfSpace, Indenters, Interface, Lattice, Layer, Level, Load, LoadedDisc,
    Material, Problem, Run, Sampling, Settings, Shape, Solver, Step, Stop, Topography,
};
use std::f64::consts::TAU;

fn elastic(shear: f64, poisson: f64) -> Material {
    Material::from_shear(shear, poisson).unwrap()
}

/// A material whose shear modulus falls by 10, in two times, the bulk modulus constant.
fn relaxing(shear: f64, poisson: f64) -> Material {
    let relaxation = Relaxation::new(&[2.7 * shear, 6.3 * shear], &[1.0, 0.1]).unwrap();
    elastic(shear, poisson).with_relaxation(Some(relaxation))
}

/// A material whose shear modulus falls from 4 times to its own in the time 1 at constant ν.
fn simple(shear: f64, poisson: f64) -> Material {
    let relaxation = Relaxation::new(&[3.0 * shear], &[1.0]).unwrap().with_constant(ConstantModulus::Poisson);
    elastic(shear, poisson).with_relaxation(Some(relaxation))
}

fn bonded(material: Material, thickness: f64) -> Layer {
    Layer::new(material, thickness, Interface::Bonded).unwrap()
}

fn bare(material: Material) -> HalfSpace {
    HalfSpace::new(vec![], material)
}

/// A soft coat that relaxes, a stiff coat on a body that does, one that does on a rigid base, and two bodies.
fn coated() -> [Bodies; 4] {
    let soft = HalfSpace::new(vec![bonded(relaxing(1.0, 0.45), 0.05)], elastic(20.0, 0.3));
    let stiff = HalfSpace::new(vec![bonded(elastic(20.0, 0.25), 0.02)], relaxing(1.0, 0.45));
    let base = HalfSpace::on_rigid_base(vec![bonded(relaxing(1.0, 0.45), 0.05)]).unwrap();
    let above = HalfSpace::new(vec![bonded(elastic(3.0, 0.3), 0.1)], relaxing(2.0, 0.45));
    [soft.clone().into(), stiff.into(), base.into(), Bodies::elastic(soft, above)]
}

/// The bodies with the moduli that their materials have at once.
fn glassy(bodies: &Bodies) -> Bodies {
    let stiff = |material: Material| elastic(material.glassy().shear, material.glassy().poisson);
    let of = |body: &HalfSpace| {
        let layers = body
            .layers()
            .iter()
            .map(|layer| Layer::new(stiff(layer.material()), layer.thickness(), layer.interface()).unwrap());
        match body.substrate().material() {
            Some(material) => HalfSpace::new(layers.collect(), stiff(material)),
            None => HalfSpace::on_rigid_base(layers.collect()).unwrap(),
        }
    };
    let body = of(bodies.body());
    bodies.counterbody().map_or_else(|| Bodies::from(body.clone()), |above| Bodies::elastic(body.clone(), of(above)))
}

/// A paraboloid of the radius 1 in each square of the side 1.
fn paraboloids() -> Indenters {
    let level = Level::new(Shape::Paraboloid { radius: 1.0 }, 0.0).unwrap();
    Indenters::new(Lattice::square(1.0, 1).unwrap(), vec![level]).unwrap()
}

/// Some waves on an oblique cell.
fn rough() -> Topography {
    let cell = Cell::new([1.0, 0.1], [0.3, 0.8]).unwrap();
    let height = |(i, j): (usize, usize)| {
        let (x, y) = (TAU * i as f64 / 45.0, TAU * j as f64 / 36.0);
        0.004 * ((x + y).cos() + 0.6 * (2.0 * x - y + 0.3).cos() + 0.4 * (3.0 * y + 1.0).cos())
    };
    Topography::new(cell, Array2::from_shape_fn((45, 36), height)).unwrap()
}

fn solver(problem: &Problem, points: [usize; 2], tolerance: f64) -> CreepSolver {
    CreepSolver::new(problem.clone(), points, Settings::default(), tolerance).unwrap()
}

fn advanced(solver: &mut CreepSolver, time: f64, load: Load) -> CreepStep {
    let step = solver.advance(time, load).unwrap();
    assert!(step.contact.report.stop.solved(), "t {time}: {}", step.contact);
    step
}

fn solved(problem: &Problem, points: [usize; 2], load: Load) -> Step {
    let step = Solver::new(problem.clone(), points, Settings::default()).unwrap().solve(load);
    assert!(step.report.stop.solved(), "{step}");
    step
}

fn area(step: &Step) -> usize {
    step.pressure().iter().filter(|p| **p > 0.0).count()
}

/// E. H. Lee and J. R. M. Radok, J. Appl. Mech. 27, 438 (1960): while contact grows under a held load it is at each time the elastic one of the
/// compliance C(t), and so it is in any number of steps. Indenters, and a rough surface on an oblique cell with an odd number of samples.
#[test]
fn a_half_space_under_a_held_load_is_elastic_at_every_time() {
    let body = bare(relaxing(1.0, 0.3));
    let bodies = Bodies::from(body.clone());
    let modes = Retardation::new(&bodies).modes(1.0);
    let cases =
        [(Problem::new(paraboloids(), body.clone()), [64; 2], 0.02), (Problem::new(rough(), body), [45, 36], 0.01)];
    for (problem, points, mean) in cases {
        for steps in [5, 20, 80] {
            let mut creeps = solver(&problem, points, f64::INFINITY);
            let mut first = None;
            for n in 0..=steps {
                let time = 20.0 * f64::from(n) / f64::from(steps);
                let step = advanced(&mut creeps, time, Load::MeanPressure(mean)).contact;
                first.get_or_insert(area(&step));
                if n % (steps / 5) != 0 {
                    continue;
                }
                // C = (1 − ν)/Gk.
                let now = Problem::new(problem.loaded_by().clone(), bare(elastic(0.7 / modes.after(time), 0.3)));
                let exact = solved(&now, points, Load::MeanPressure(mean));
                let error = (step.penetration() / exact.penetration() - 1.0).abs();
                assert!(error < 1e-7, "{steps} steps, t {time}: {error:e}");
                assert!(area(&step).abs_diff(area(&exact)) <= 2, "{} {}", area(&step), area(&exact));
                assert!(step.certificate.energy_gap < 20e-8 && time < 1.0 || area(&step) > first.unwrap());
            }
        }
    }
}

/// The glassy bodies at first, the relaxed ones in the end, also in what they store.
#[test]
fn a_held_load_begins_glassy_and_ends_relaxed() {
    let load = Load::MeanPressure(0.02);
    for bodies in coated() {
        let problem = Problem::new(paraboloids(), bodies.clone());
        let mut creeps = solver(&problem, [64; 2], 1e-3);
        for (time, bodies) in [(0.0, glassy(&bodies)), (1e5, bodies)] {
            let step = advanced(&mut creeps, time, load).contact;
            let exact = solved(&Problem::new(paraboloids(), bodies.clone()), [64; 2], load);
            assert!((step.penetration() / exact.penetration() - 1.0).abs() < 2e-7, "{bodies}, t {time}");
            assert!((step.elastic_energy() / exact.elastic_energy() - 1.0).abs() < 1e-6, "{bodies}, t {time}");
            assert!(area(&step).abs_diff(area(&exact)) <= 2);
            let apart = &step.displacement() - &exact.displacement();
            assert!(apart.iter().all(|d| d.abs() < 1e-6 * exact.penetration()), "{bodies}, t {time}");
        }
    }
}

/// A held penetration keeps the area of a half-space, whose pressure falls as G(t).
#[test]
fn a_held_penetration_relaxes_as_the_modulus() {
    let problem = Problem::new(paraboloids(), bare(simple(1.0, 0.3)));
    let relaxed = solved(&problem, [64; 2], Load::Penetration(0.01)).reading();
    for tolerance in [1e-2, 1e-3, 1e-4] {
        let mut creeps = solver(&problem, [64; 2], tolerance);
        for time in [0.0f64, 0.2, 1.0, 3.0, 30.0] {
            let step = advanced(&mut creeps, time, Load::Penetration(0.01));
            let force = step.contact.reading().force / relaxed.force;
            let exact = 1.0 + 3.0 * (-time).exp();
            let stated = step.error.unwrap().pressure;
            assert!((force - exact).abs() < 4.0 * stated + 1e-6, "t {time}: {force} {exact}, {stated:e}");
            assert!((force / exact - 1.0).abs() < 10.0 * tolerance, "t {time}: {force} {exact}");
        }
    }
}

/// A wave D cos kx in complete contact: the amplitude of the pressure is kD G(t)/(1 − ν) at constant ν.
#[test]
fn a_wave_in_complete_contact_relaxes_by_its_closed_form() {
    let (n, height) = (32, 1e-3);
    let heights = Array2::from_shape_fn((n, n), |(i, _)| height * (TAU * i as f64 / n as f64).cos());
    let waves = Topography::new(Cell::square(1.0).unwrap(), heights).unwrap();
    let problem = Problem::new(waves, bare(simple(1.0, 0.3)));
    let mut creeps = solver(&problem, [n; 2], 1e-4);
    for time in [0.0f64, 0.1, 0.5, 2.0, 10.0] {
        let step = advanced(&mut creeps, time, Load::MeanPressure(0.1)).contact;
        assert_eq!(area(&step), n * n);
        let largest = step.pressure().iter().copied().fold(0.0, f64::max) - 0.1;
        let exact = TAU * height * (1.0 + 3.0 * (-time).exp()) / 0.7;
        assert!((largest / exact - 1.0).abs() < 1e-3, "t {time}: {largest} {exact}");
        assert!((step.penetration() / height - 1.0).abs() < 1e-6, "{}", step.penetration());
    }
}

/// A given pressure displaces by C(t) in one step, and comes back after it.
#[test]
fn a_given_pressure_displaces_by_the_compliance_of_its_time() {
    let body = bare(relaxing(1.0, 0.3));
    let bodies = Bodies::from(body.clone());
    let modes = Retardation::new(&bodies).modes(1.0);
    let disc = LoadedDisc { centre: [0.5; 2], radius: 0.2, pressure: 0.1 };
    let given = GivenPressure::discs(Cell::square(1.0).unwrap(), vec![disc]).unwrap();
    let problem = Problem::new(given, body);
    let mut creeps = solver(&problem, [48; 2], f64::INFINITY);
    let load = Load::MeanPressure(problem.given_pressure().unwrap().force());
    let begins = advanced(&mut creeps, 0.0, load).contact.penetration();
    let later = advanced(&mut creeps, 3.0, load).contact.penetration();
    assert!((later / begins * modes.after(0.0) / modes.after(3.0) - 1.0).abs() < 1e-12);
    let none = load.with_value(0.0);
    let after = advanced(&mut creeps, 3.0, none).contact.penetration();
    assert!((after / begins * modes.after(0.0) / (modes.after(3.0) - modes.after(0.0)) - 1.0).abs() < 1e-12);
    let gone = advanced(&mut creeps, 1e4, none).contact;
    assert!(gone.penetration() < 1e-3 * after, "{}", gone.penetration());
}

/// Loading and unloading in equal steps: differences of successive halvings fall by four.
#[test]
fn steps_are_of_second_order_through_loading_and_unloading() {
    for bodies in coated().into_iter().take(3) {
        let problem = Problem::new(paraboloids(), bodies.clone());
        let penetrations = [10, 20, 80, 160].map(|steps| {
            let mut creeps = solver(&problem, [64; 2], f64::INFINITY);
            let load = |n: i32| 0.002 + 0.01 * (1.0 - (TAU * f64::from(n) / f64::from(2 * steps) * 1.5).cos());
            let all = (0..=steps)
                .map(|n| advanced(&mut creeps, 1.5 * f64::from(n) / f64::from(steps), Load::MeanPressure(load(n))));
            all.last().unwrap().contact.penetration()
        });
        let [coarse, fine] = [penetrations[1] - penetrations[0], penetrations[3] - penetrations[2]];
        let order = (coarse / fine).log2() / 3.0;
        assert!((order - 2.0).abs() < 0.25, "{bodies}: {order}, {penetrations:?}");
    }
}

/// Loading, a hold, unloading and recovery: what is stated bounds what finer steps change.
#[test]
fn stated_errors_in_time_hold() {
    let path = [(0.0, 0.0), (0.5, 0.02), (3.0, 0.02), (4.0, 0.01), (100.0, 0.01)];
    for bodies in coated() {
        let problem = Problem::new(paraboloids(), bodies.clone());
        let run = |tolerance: f64| {
            let mut creeps = solver(&problem, [48; 2], tolerance);
            path.map(|(time, mean)| advanced(&mut creeps, time, Load::MeanPressure(mean)))
        };
        let fine = run(1e-5);
        for tolerance in [1e-2, 1e-3] {
            for (step, fine) in run(tolerance).iter().zip(&fine) {
                let [stated, exact] = [step, fine].map(|step| step.error.unwrap());
                let penetration = (step.contact.penetration() - fine.contact.penetration()).abs();
                assert!(penetration <= stated.penetration + exact.penetration + 1e-9, "{bodies}, t {}", step.time);
                let [one, two] = [step, fine].map(|step| step.contact.pressure().to_owned());
                let apart = (&one - &two).mapv(f64::abs).sum() / fine.contact.pressure().sum().max(1e-3);
                assert!(apart <= 2.0 * (stated.pressure + exact.pressure), "{bodies}, t {}: {apart:e}", step.time);
            }
        }
    }
}

/// After unloading the surface comes back: nothing touches, and what is displaced goes to zero.
#[test]
fn an_unloaded_body_recovers() {
    let problem = Problem::new(paraboloids(), coated()[1].clone());
    let mut creeps = solver(&problem, [48; 2], 1e-3);
    advanced(&mut creeps, 0.0, Load::MeanPressure(0.02));
    let held = advanced(&mut creeps, 2.0, Load::MeanPressure(0.02)).contact.penetration();
    let off = advanced(&mut creeps, 2.0, Load::MeanPressure(0.0)).contact;
    assert_eq!((off.report.stop, area(&off)), (Stop::NoContact, 0));
    // The first touch of what is left.
    let least = (&off.surface().initial_gap() + &off.displacement()).iter().copied().fold(f64::INFINITY, f64::min);
    assert!((off.penetration() - least).abs() < 1e-15 && off.penetration() > 0.3 * held, "{}", off.penetration());
    let later = advanced(&mut creeps, 2e4, Load::MeanPressure(0.0)).contact;
    assert!(later.penetration().abs() < 1e-3 * held && later.elastic_energy() < 1e-3 * off.elastic_energy());
    // It is loaded again as if nothing had been.
    let again = advanced(&mut creeps, 2e4, Load::MeanPressure(0.02)).contact.penetration();
    let first = solved(&Problem::new(paraboloids(), glassy(&coated()[1])), [48; 2], Load::MeanPressure(0.02));
    assert!((again / first.penetration() - 1.0).abs() < 1e-3);
}

#[test]
fn what_is_not_followed_in_time_is_refused() {
    let rubber = bare(relaxing(1.0, 0.3));
    let problem = Problem::new(paraboloids(), rubber.clone());
    let refused = |problem: Problem| CreepSolver::new(problem, [48; 2], Settings::default(), 1e-3).unwrap_err();
    assert_eq!(refused(Problem::new(paraboloids(), bare(elastic(1.0, 0.3)))), CreepError::Elastic);
    let level = Level::new(Shape::Paraboloid { radius: 1.0 }, 0.0).unwrap();
    let lattice = Lattice::new(Cell::window([1.0; 2]).unwrap(), vec![vec![[0.5; 2]]]).unwrap();
    let isolated = Problem::new(Indenters::new(lattice, vec![level]).unwrap(), rubber);
    assert_eq!(refused(isolated), CreepError::Isolated);
    let friction = Friction::new(0.1, [1.0, 0.0]).unwrap();
    assert_eq!(refused(problem.clone().sliding(friction).unwrap()), CreepError::Friction);
    assert_eq!(refused(problem.clone().moving(SteadyMotion::new(1.0).unwrap()).unwrap()), CreepError::Motion);
    let mut creeps = solver(&problem, [48; 2], 1e-3);
    advanced(&mut creeps, 1.0, Load::MeanPressure(0.01));
    let before = creeps.advance(0.5, Load::MeanPressure(0.01)).unwrap_err();
    assert_eq!(before, CreepError::Time { time: 0.5, before: 1.0 });
    assert_eq!(creeps.advance(2.0, Load::Penetration(0.01)).unwrap_err(), CreepError::Loads);
    let run = Run::new(problem, vec![Load::MeanPressure(0.01); 2], Sampling::Points([48; 2]));
    let of = |times: Vec<f64>| Run { times: Some(Times::new(times)), ..run.clone() }.check().unwrap_err().to_string();
    assert!(of(vec![0.0]).contains("as many times as loads") && of(vec![1.0, 0.0]).contains("must not decrease"));
}

/// Counts the steps that it is told of.
#[derive(Default)]
struct Counts {
    steps: usize,
    iterations: usize,
}

impl Recorder for Counts {
    type Error = std::convert::Infallible;

    fn iteration(&mut self, _: percoat::Progress) -> Result<(), Self::Error> {
        self.iterations += 1;
        Ok(())
    }

    fn step(
        &mut self,
        _: &Step,
        _: &percoat::run::StepRecord,
        _: Option<&percoat::StressFields>,
    ) -> Result<(), Self::Error> {
        self.steps += 1;
        Ok(())
    }
}

/// Records of a run have times and errors of steps in time, on one grid and on finer and finer ones.
#[test]
fn a_run_records_its_times() {
    let problem = Problem::new(paraboloids(), coated()[0].clone());
    let loads = [0.0, 0.02, 0.02].map(Load::MeanPressure).to_vec();
    let times = Some(Times::new(vec![0.0, 1.0, 10.0]));
    for sampling in [Sampling::Points([64; 2]), Sampling::Accuracy(0.02)] {
        let run = Run { times: times.clone(), ..Run::new(problem.clone(), loads.clone(), sampling) };
        let mut counts = Counts::default();
        let outcome = run.solve(&mut counts).unwrap();
        assert!(outcome.converged() && counts.steps.is_multiple_of(3) && counts.iterations > 10);
        let creep: Vec<_> = outcome.steps.iter().map(|step| step.creep.unwrap()).collect();
        assert_eq!(creep.iter().map(|creep| creep.time).collect::<Vec<f64>>(), [0.0, 1.0, 10.0]);
        let last = &outcome.steps[2];
        assert!(creep[2].time_steps > 1 && creep[2].time_error.unwrap() < 1e-2 * last.reading.penetration);
        assert!(last.reading.errors.penetration.unwrap() >= creep[2].time_error.unwrap());
        assert!(last.reading.penetration > outcome.steps[1].reading.penetration);
    }
}
