//! Frictional heat of contacts that slide steadily: partition, temperatures, swelling, and where no steady state is unique.

use percoat::body::Conduction;
use percoat::heating::{Heating, HeatingError, Partition};
use percoat::reading::TemperatureReading;
use percoat::run::{NoSteadyState, Run, RunError, Sampling};
use percoat::spectral::{LayeredOperator, Stop, Workspace};
use percoat::steady_motion::SteadyMotion;
use percoat::{
    Bodies, Friction, HalfSpace, Indenters, Interface, Lattice, Layer, Level, Load, Material, Problem, Settings, Shape,
    Solver, Step,
};

/// A material with λ, κ and α.
fn conducting(young: f64, [conductivity, diffusivity, expansion]: [f64; 3]) -> Material {
    let conduction = Conduction::new(conductivity, diffusivity, expansion).unwrap();
    Material::from_young(young, 0.3).unwrap().with_conduction(Some(conduction))
}

fn bare(young: f64, conduction: [f64; 3]) -> HalfSpace {
    HalfSpace::new(vec![], conducting(young, conduction))
}

fn paraboloid(period: f64, radius: f64) -> Indenters {
    let level = Level::new(Shape::Paraboloid { radius }, 0.0).unwrap();
    Indenters::new(Lattice::square(period, 1).unwrap(), vec![level]).unwrap()
}

fn sliding(indenters: Indenters, bodies: impl Into<Bodies>, coefficient: f64, velocity: f64) -> Problem {
    let friction = Friction::new(coefficient, [1.0, 0.0]).unwrap().uncoupled();
    let motion = SteadyMotion::new(velocity).unwrap();
    Problem::new(indenters, bodies.into()).sliding(friction).unwrap().moving(motion).unwrap()
}

fn solved(problem: Problem, points: usize, load: Load) -> Step {
    let step = Solver::new(problem, [points; 2], Settings::default()).unwrap().solve(load);
    assert!(step.report.stop.solved(), "{step}");
    step
}

/// A Hertzian source of the radius 1 in a cell of the side 8, λ = κ = 1 below λ = 3 at rest, equal mean temperatures: three digits of a
/// prototype on 256² samples. At rest the share is λ₁/(λ₁ + λ₂) everywhere.
#[test]
fn heat_is_shared_so_that_temperatures_are_equal() {
    for (velocity, share) in [(1e-9, 0.25), (1.0, 0.26723), (10.0, 0.38032), (100.0, 0.49692), (1000.0, 0.54370)] {
        let bodies = Bodies::elastic(bare(1e6, [1.0, 1.0, 0.0]), bare(1e6, [3.0, 1.0, 0.0]));
        // a³ = ¾ P R/E*, 1/E* = 2 (1 − ν²)/E.
        let modulus = 1e6 / 1.82;
        let problem = sliding(paraboloid(8.0, 1e3), bodies, 0.3, velocity).heated(Heating::default()).unwrap();
        let step = solved(problem, 256, Load::Force(4.0 / 3.0 * modulus / 1e3));
        let heat = step.finest().heat().unwrap();
        assert!((heat.share - share).abs() < 1.5e-3, "v {velocity}: {}", heat.share);
        let (above, p) = (heat.counterbody.as_ref().unwrap(), step.finest().pressures());
        let span = heat.body.iter().fold(0.0f64, |most, t| most.max(t.abs()));
        for i in (0..p.len()).filter(|&i| p[i] > 0.0) {
            assert!((heat.body[i] - above[i]).abs() < 1e-8 * span, "v {velocity}: {} {}", heat.body[i], above[i]);
            assert!(velocity > 1e-3 || (heat.flux[i] / heat.friction[i] - 0.25).abs() < 1e-6);
        }
        assert!((0..p.len()).all(|i| p[i] > 0.0 || heat.flux[i] == 0.0));
        let reading = TemperatureReading::of(&step).unwrap();
        assert!((reading.counterbody_share - 1.0 + share).abs() < 1.5e-3 && reading.materials.len() == 2);
        assert!(reading.max >= reading.mean_in_contact && reading.criticality == 0.0);
    }
}

/// Hertz at rest in free space: T(0) = π q₀ a/(4λ); periodic less Q S₁/(2πλL), S₁ = −3.900264920.
#[test]
fn a_hertzian_source_has_its_temperature() {
    let modulus = 1e6 / 0.91;
    for (period, points, tolerance) in [(8.0, 256, 1e-3), (16.0, 512, 1e-3)] {
        let problem = sliding(paraboloid(period, 1e3), bare(1e6, [2.0, 1.0, 0.0]), 0.3, 1e-6);
        let problem = problem.heated(Heating::default()).unwrap();
        let step = solved(problem, points, Load::Force(4.0 / 3.0 * modulus / 1e3));
        let heat = step.finest().heat().unwrap();
        let peak = heat.friction.iter().copied().fold(0.0, f64::max);
        let whole = heat.friction.iter().sum::<f64>() * step.grid().sample_area();
        let lone = heat.body[0] + 3.900264920 * whole / (2.0 * std::f64::consts::PI * 2.0 * period);
        let known = std::f64::consts::PI * peak / 8.0;
        // The next term of the lattice sum is of the order (a/L)².
        assert!((lone / known - 1.0).abs() < tolerance + 0.6 / (period * period), "{period}: {lone} {known}");
    }
}

/// E = λ = α = 1, ν = .3, μ = .5 in a cell of the side 1: V = 2λk(1 − ν)/(μαE) = 17.592919, with heat that moves or not.
#[test]
fn beyond_its_threshold_no_steady_state_is_unique() {
    for diffusivity in [1e9, 1.0] {
        let at = |part: f64| {
            let problem = sliding(paraboloid(1.0, 1.0), bare(1.0, [1.0, diffusivity, 1.0]), 0.5, part * 17.592919);
            let problem = problem.heated(Heating::default()).unwrap();
            Solver::new(problem, [64; 2], Settings::default()).unwrap().solve(Load::MeanPressure(0.01))
        };
        let below = at(0.99);
        assert!(below.report.stop.solved(), "{below}");
        let reading = TemperatureReading::of(&below).unwrap();
        assert!((reading.criticality - 0.99).abs() < 1e-6, "{}", reading.criticality);
        assert_eq!(at(1.01).report.stop, Stop::NotUnique);
    }
}

/// A run beyond the threshold is refused, with the part of the compliance that swelling takes: V/V_cr of heat at rest.
#[test]
fn runs_without_a_steady_state_are_refused() {
    let problem = sliding(paraboloid(1.0, 1.0), bare(1.0, [1.0, 1e9, 1.0]), 0.5, 1.5 * 17.592919);
    let problem = problem.heated(Heating::default()).unwrap();
    let run = Run::new(problem, vec![Load::MeanPressure(0.01)], Sampling::Points([64; 2]));
    match run.solve(&mut ()) {
        Err(RunError::NoSteadyState(NoSteadyState { taken })) => assert!((taken - 1.5).abs() < 1e-6, "{taken}"),
        other => panic!("{other:?}"),
    }
}

/// The displacement is that of the pressure and of the heat that is left in the step; a given share is met at once, a solved one in turns.
#[test]
fn the_surface_swells_by_the_heat_that_it_takes() {
    let coated = |conduction| {
        let layer = Layer::new(conducting(3.0, [0.2, 0.4, 3.0]), 0.05, Interface::Bonded).unwrap();
        HalfSpace::new(vec![layer.with_thermal_resistance(0.1).unwrap()], conducting(1.0, conduction))
    };
    for partition in [Partition::Solved, Partition::Share(0.3)] {
        let bodies = Bodies::elastic(coated([1.0, 0.5, 3.0]), bare(2.0, [3.0, 1.0, 1.5]));
        let problem = sliding(paraboloid(1.0, 1.0), bodies.clone(), 0.3, 2.0);
        let heating = Heating::new(partition, [10.0, 10.0]).unwrap();
        let cold = solved(problem.clone().heated(heating.without_expansion()).unwrap(), 64, Load::MeanPressure(0.02));
        let step = solved(problem.heated(heating).unwrap(), 64, Load::MeanPressure(0.02));
        let heat = step.finest().heat().unwrap();
        let mut displaced = step.finest().pressures().to_vec();
        LayeredOperator::new(step.grid(), bodies).displacement(&mut displaced, &mut Workspace::default());
        let (w, size) = (step.displacement(), displaced.iter().fold(0.0f64, |most, w| most.max(w.abs())));
        for (i, w) in w.iter().enumerate() {
            assert!(
                (displaced[i] + heat.swelling[i] - w).abs() < 1e-6 * size,
                "{} {w}",
                displaced[i] + heat.swelling[i]
            );
        }
        let largest = |step: &Step| step.pressure().iter().copied().fold(0.0, f64::max);
        let bulge = heat.swelling.iter().copied().fold(0.0, f64::min);
        assert!(bulge < -0.01 * size && largest(&step) > 1.01 * largest(&cold), "{bulge} {size}");
        let reading = TemperatureReading::of(&step).unwrap();
        assert!(reading.materials.len() == 3 && reading.max > 10.0, "{reading:?}");
        // Behind the resistance of the interface it is colder than on the surface.
        assert!(reading.materials[1].value < reading.materials[0].value);
    }
}

#[test]
fn heat_needs_motion_friction_and_conduction() {
    let plain = Problem::new(paraboloid(1.0, 1.0), bare(1.0, [1.0, 1.0, 0.0]));
    assert_eq!(plain.clone().heated(Heating::default()), Err(HeatingError::Rest));
    let moves = plain.moving(SteadyMotion::new(1.0).unwrap()).unwrap();
    assert_eq!(moves.heated(Heating::default()), Err(HeatingError::Smooth));
    let cold =
        Bodies::elastic(bare(1.0, [1.0, 1.0, 0.0]), HalfSpace::new(vec![], Material::from_young(1.0, 0.3).unwrap()));
    let refused = sliding(paraboloid(1.0, 1.0), cold, 0.3, 1.0).heated(Heating::default()).unwrap_err();
    assert!(refused.to_string().contains("counterbody"), "{refused}");
}
