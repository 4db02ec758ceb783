//! Surfaces that adhere: stresses, strengths and limits under the pressure less the tension, and runs that are read back.

#![cfg(feature = "cli")]

use crate::common::Random;
use percoat::adhesion::{Adhesion, AdhesionLaw, MaugisState};
use percoat::body::Strength;
use percoat::case::{Case, embedded};
use percoat::identification::{FromRetraction, Instrument, Model, Parameter, Quantity, Retraction, RetractionError};
use percoat::reading::{Criterion, JumpKind};
use percoat::run::{At, Run, Sampling, StressRequest};
use percoat::spectral::Stop;
use percoat::{
    Bodies, Cell, Depth, Friction, HalfSpace, Indenters, Interface, Lattice, Layer, Level, Load, Material,
    MaterialError, MeanStress, Problem, Settings, Shape, StressField,
};
use std::f64::consts::PI;
use std::ops::ControlFlow;

const POINTS: [usize; 2] = [64; 2];

/// A ball of the radius 1 in a window, on a soft layer of which both materials yield.
fn problem(law: AdhesionLaw, friction: f64) -> Problem {
    let bears = Strength { yielding: Some(0.4), tensile: Some(5.0) };
    let layer = Layer::new(Material::from_young(0.6, 0.35).unwrap(), 0.3, Interface::Bonded).unwrap();
    let layer = layer.with_strengths(bears, Default::default()).unwrap();
    let body =
        HalfSpace::new(vec![layer], Material::from_young(1.0, 0.3).unwrap()).with_substrate_strength(bears).unwrap();
    let lattice = Lattice::new(Cell::window([2.4; 2]).unwrap(), vec![vec![[0.5; 2]]]).unwrap();
    let ball = Indenters::new(lattice, vec![Level::new(Shape::Paraboloid { radius: 1.0 }, 0.0).unwrap()]).unwrap();
    let problem = Problem::new(ball, Bodies::from(body));
    let friction = Friction::new(friction, [1.0, 0.0]).unwrap().uncoupled();
    problem.sliding(friction).unwrap().adhering(Adhesion::new(0.02, 0.1, law).unwrap()).unwrap()
}

fn run(problem: Problem, loads: Vec<Load>) -> Run {
    let stress = Some(StressRequest { mean: MeanStress::HalfSpace, ..StressRequest::default() });
    Run { stress, ..Run::new(problem, loads, Sampling::Points(POINTS)) }
}

/// Largest stresses against those of a field under the net pressure at all samples of forty depths.
#[test]
fn largest_stresses_are_those_of_the_pressure_less_the_tension() {
    for (law, load) in [
        (AdhesionLaw::Dugdale, Load::Force(0.15)),
        (AdhesionLaw::Exponential, Load::Force(0.05)),
        // Drawn apart, no pressure of contact is larger than the tension.
        (AdhesionLaw::Dugdale, Load::Force(-0.06)),
    ] {
        let outcome = run(problem(law, 0.0), vec![Load::Force(0.0), load]).solve(&mut ()).unwrap();
        let (record, step) = (&outcome.steps[1], outcome.last.as_ref().unwrap());
        assert!(record.converged(), "{:?}", record.stop);
        let contact = step.finest();
        let net = contact.net_pressures();
        let area = contact.grid().sample_area();
        let force = net.iter().sum::<f64>() * area;
        assert!((force - load.value()).abs() < 1e-6 && (record.reading.force - force).abs() < 1e-12, "{force}");
        let pressure = ndarray::ArrayView2::from_shape(POINTS, &net).unwrap();
        let field =
            StressField::under(contact.grid(), pressure, contact.problem().half_space(), None, MeanStress::HalfSpace)
                .unwrap();
        let most = |depth: f64| {
            let material = if depth < 0.3 { 1 } else { 2 };
            let plane = field.plane(Depth { z: depth, material }, POINTS);
            plane.states().iter().map(|state| state.tau1()).fold(0.0, f64::max)
        };
        let dense = (1..=40).map(|k| most(0.019 * f64::from(k))).fold(0.0, f64::max);
        let found = &record.stress.as_ref().unwrap().overall;
        let error = found.tau1.error.unwrap_or(0.0);
        println!("{law} {load}: τ₁ {} ± {error}, {dense} at samples, σ₁ {}", found.tau1.value, found.tension.value);
        // No sample exceeds the largest value, and some come near to it, or it lies at the edge on the surface.
        assert!(dense < found.tau1.value + error, "{law} {load}: {dense} {}", found.tau1.value);
        let at_surface = found.tau1.position[2] < 0.02;
        assert!(at_surface || dense > 0.98 * found.tau1.value - error, "{law} {load}: {dense} {}", found.tau1.value);
        // The surface bears the tension itself.
        assert!(found.tension.value > 0.8 * 0.2, "{law} {load}: {}", found.tension.value);
    }
}

#[test]
fn friction_rubs_by_the_pressure_of_contact() {
    let outcome = run(problem(AdhesionLaw::Dugdale, 0.3), vec![Load::Force(0.1)]).solve(&mut ()).unwrap();
    let step = outcome.last.unwrap();
    let contact = step.finest();
    let field = StressField::new(contact, MeanStress::HalfSpace);
    let grid = contact.grid();
    // In the middle of the contact, where a field under samples is that of its samples.
    let middle = POINTS[0] / 2 * POINTS[1] + POINTS[1] / 2;
    let place = grid.cell().point(grid.fractions(middle));
    let state = field.points(Depth::SURFACE, &[place])[0];
    let (p, tension) = (contact.pressures()[middle], contact.tensions().unwrap()[middle]);
    assert!(tension > 0.19 && p > tension);
    assert!((state.xz.abs() - 0.3 * p).abs() < 0.02 * p, "{} {p}", state.xz);
    assert!((state.zz + p - tension).abs() < 0.02 * p, "{} {p} {tension}", state.zz);
}

/// The limit is that of a contact that came together at its load, where the utilisation is 1.
#[test]
fn limits_are_loads_of_surfaces_that_adhere() {
    let adheres = problem(AdhesionLaw::Dugdale, 0.0);
    let limits = run(adheres.clone(), vec![Load::Force(0.1)]).limits(&mut ()).unwrap();
    let first = limits.first().expect("something yields");
    let At::Load { load, .. } = first.at else { panic!("{first:?}") };
    assert!(matches!(first.criterion, Criterion::Yield(_)), "{first:?}");
    let outcome = run(adheres, vec![Load::Force(load)]).solve(&mut ()).unwrap();
    let taken = outcome.steps[0].utilisation(first.criterion).unwrap();
    assert!((taken.value - 1.0).abs() < 5e-3, "{taken:?}");
}

/// A record has what its path has met, and the surfaces that a load draws apart bear nothing.
#[test]
fn a_path_records_its_jumps_and_pull_off() {
    let loads = (0..=20).map(|k| Load::Penetration(0.05 - 0.02 * f64::from(k))).collect();
    let outcome = run(problem(AdhesionLaw::Dugdale, 0.0), loads).solve(&mut ()).unwrap();
    let readings: Vec<_> = outcome.steps.iter().map(|step| step.adhesion.as_ref().unwrap()).collect();
    let pull_off = readings[20].pull_off.expect("the force rises again");
    assert!(pull_off.force < 0.0 && pull_off.error.is_some_and(|error| error < 0.1 * pull_off.force.abs()));
    let least = outcome.steps.iter().map(|step| step.reading.force).fold(0.0, f64::min);
    assert!(pull_off.force <= least + 1e-9 && pull_off.force > 1.05 * least);
    for step in &outcome.steps {
        let reading = step.adhesion.as_ref().unwrap();
        let error = step.reading.force - (reading.contact_load - reading.adhesive_load);
        assert!(error.abs() < 1e-9 && step.converged());
        let written = serde_json::to_value(step).unwrap();
        let read: percoat::run::StepRecord = serde_json::from_value(written).unwrap();
        assert_eq!(read.adhesion, step.adhesion);
        read.check().unwrap();
    }
    let jumps: Vec<_> = readings.iter().flat_map(|reading| &reading.jumps).collect();
    assert!(jumps.iter().all(|jump| jump.kind == JumpKind::Out), "{jumps:?}");
    let drawn =
        run(problem(AdhesionLaw::Dugdale, 0.0), vec![Load::Force(0.0), Load::Force(-1.0)]).solve(&mut ()).unwrap();
    assert_eq!(drawn.steps[1].stop, Stop::Detached);
    assert!(
        drawn.steps[1].reading.contact_area == 0.0
            && drawn.warnings.iter().any(|warning| warning.contains("come apart"))
    );
}

/// Work of adhesion and modulus from a curve of drawing off by Maugis' theory, which this program has no part in. The grid of nine samples across
/// the zone that pulls leaves 0.2 % of the forces; with noise of 1 % of pull-off values lie within three standard errors.
#[test]
fn work_and_modulus_are_found_from_a_curve_of_drawing_off() {
    let (work, range, young) = (4.0 / (3.0 * PI), 2.0 / PI, 0.91);
    let modulus = young / 0.91;
    let lambda = Adhesion::new(work, range, AdhesionLaw::Dugdale).unwrap().maugis(1.0, modulus);
    let least = MaugisState::pull_off(lambda).radius;
    let states = (0..40).map(|k| MaugisState::at(1.7 + (least - 1.7) * f64::from(k) / 39.0, lambda));
    let (forces, penetrations): (Vec<f64>, Vec<f64>) =
        states.map(|state| (PI * work * state.force, state.penetration)).unzip();
    let problem = |values: &[f64]| -> Result<Problem, MaterialError> {
        let body = HalfSpace::new(vec![], Material::from_young(values[1], 0.3)?);
        let lattice = Lattice::new(Cell::window([5.0; 2]).unwrap(), vec![vec![[0.5; 2]]]).unwrap();
        let ball = Indenters::new(lattice, vec![Level::new(Shape::Paraboloid { radius: 1.0 }, 0.0).unwrap()]).unwrap();
        let adhesion = Adhesion::new(values[0], range, AdhesionLaw::Dugdale).unwrap();
        Ok(Problem::new(ball, body).adhering(adhesion).unwrap())
    };
    let parameter = |name: &str, quantity, start| Parameter { name: name.to_owned(), quantity, start };
    let parameters = [
        parameter("work", Quantity::Positive, 0.7 * work),
        parameter("young", Quantity::Positive, 1.4 * young),
        parameter("zero", Quantity::Offset, 0.0),
    ];
    let settings = Settings { tolerance: 1e-7, ..Settings::default() };
    let model = Model { problem: &problem, points: 64, settings };
    let mut random = Random(5);
    let mut normal = || (0..12).map(|_| random.unit()).sum::<f64>() - 6.0;
    for (noise, bound) in [(0.0, Some(1e-2)), (0.01, None)] {
        let unit = noise * 1.6 * PI * work;
        let noisy: Vec<f64> = forces.iter().map(|force| force + unit * normal()).collect();
        let measured = Retraction::new(&noisy, &penetrations).unwrap();
        let fit = FromRetraction::new(&model, &parameters, (&measured, Instrument::default()), &mut |_| {
            ControlFlow::Continue(())
        })
        .unwrap();
        for (estimate, known) in fit.estimates.iter().zip([work, young, 0.0]) {
            println!("{noise} {} {} {known} ± {}", estimate.parameter.name, estimate.value, estimate.error);
            let within = bound.map_or(3.0 * estimate.error, |bound| bound * known.max(0.5));
            assert!(
                (estimate.value - known).abs() < within,
                "{}: {} {known} {within}",
                estimate.parameter.name,
                estimate.value
            );
        }
        assert!((fit.pull_off / (PI * work * MaugisState::pull_off(lambda).force) - 1.0).abs() < 0.02);
    }
    let pressed = Retraction::new(&[0.3, 0.2, 0.1, 0.0], &[0.3, 0.2, 0.1, 0.0]);
    assert_eq!(pressed, Err(RetractionError::NoTension));
}

/// Indenters of three heights on a soft coating, drawn apart under a prescribed penetration: each level jumps apart at a penetration of its own, the
/// lowest level first, and the three jumps lose the same energy within 15 %.
#[test]
fn levels_let_go_one_after_another() {
    let case = Case::read(&embedded::source("textured").unwrap(), &[]).unwrap();
    let outcome = case.run().solve(&mut ()).unwrap();
    let jumps: Vec<_> =
        outcome.steps.iter().filter_map(|step| step.adhesion.as_ref()).flat_map(|reading| &reading.jumps).collect();
    let [third, second, first] = jumps[..] else { panic!("{jumps:?}") };
    let levels = outcome.steps[0].reading.levels.len();
    assert!(levels == 3 && jumps.iter().all(|jump| jump.kind == JumpKind::Out));
    let losses = [third, second, first].map(|jump| jump.loss.unwrap());
    assert!(losses.iter().all(|loss| (loss / losses[2] - 1.0).abs() < 0.15), "{losses:?}");
    // The levels lie 0.015 apart.
    let places = [third, second, first].map(|jump| jump.penetration[0].unwrap());
    assert!(places.windows(2).all(|pair| (pair[0] - pair[1] - 0.0158).abs() < 1e-3), "{places:?}");
    // After the last one nothing touches.
    assert_eq!(first.contact_area[1], 0.0);
}
