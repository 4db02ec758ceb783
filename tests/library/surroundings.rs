//! Largest stresses of an isolated contact lie where they are, inside its window or outside.

use crate::common;

use common::{Random, one_level};
use percoat::body::{InterfaceStrength, Strength};
use percoat::run::Limits;
use percoat::{
    Cell, Durability, Endurance, Fatigue, Friction, HalfSpace, Interface, Lattice, Layer, Level, Load, Material,
    MeanStress, Problem, Run, Sampling, Settings, Shape, Solver, Step, StressFields, StressReading,
};
use std::f64::consts::PI;

const NO_BOND: InterfaceStrength = InterfaceStrength { normal: None, shear: None, friction: 0.0 };

fn material(young: f64, poisson: f64) -> Material {
    Material::from_young(young, poisson).unwrap()
}

/// A paraboloid over the middle of a window.
fn under_a_ball(body: HalfSpace, radius: f64, window: f64) -> Problem {
    let lattice = Lattice::new(Cell::window([window; 2]).unwrap(), vec![vec![[0.5; 2]]]).unwrap();
    Problem::new(one_level(lattice, Level::new(Shape::Paraboloid { radius }, 0.0).unwrap()), body)
}

fn limits(problem: Problem, start: f64, points: usize) -> Limits {
    Run::new(problem, vec![Load::Force(start)], Sampling::Points([points; 2])).limits(&mut ()).unwrap()
}

/// Two stiff layers bend on a soft base under a ball: the surface cracks several contact radii away. By an axisymmetric Galerkin
/// solution of the contact, with layered stresses of its own, at the force 0.68247.
#[test]
fn a_stiff_coating_cracks_at_one_load_whatever_the_window() {
    let cracks = Strength { yielding: None, tensile: Some(0.05011083) };
    let body = || {
        let layer = |h: f64, nu: f64| Layer::new(material(60.0, nu), h, Interface::Bonded).unwrap();
        let outer = layer(0.2, 0.22).with_strengths(cracks, NO_BOND).unwrap();
        HalfSpace::new(vec![outer, layer(0.8, 0.3)], material(1.0, 0.38))
    };
    for (window, points) in [(3.0, 64), (6.0, 96)] {
        let found = limits(under_a_ball(body(), 50.0, window), 0.5, points);
        let [low, high] = found.limits[0].interval();
        assert!(found.converged(), "{window}: {found:?}");
        assert!(low <= 0.68248 && 0.68246 <= high && high < 1.01 * low, "{window}: {low} … {high}");
    }
}

/// A body on which a ball presses, and what its numbers are.
fn random_body(random: &mut Random, contact: f64) -> (HalfSpace, String) {
    let nu = |random: &mut Random| random.pick(&[0.0, 0.2, 0.3, 0.45, 0.5]);
    let count = 1 + (2.0 * random.unit()) as usize;
    let layers: Vec<Layer> = (0..count)
        .map(|_| {
            let material = material(random.log(1e-1, 3e2), nu(random));
            Layer::new(material, contact * random.log(0.03, 2.0), Interface::Bonded).unwrap()
        })
        .collect();
    let body = HalfSpace::new(layers, material(1.0, nu(random)));
    let words = format!("{body}");
    (body, words)
}

fn stepped(problem: Problem, points: usize, load: Load) -> Step {
    let settings = Settings { tolerance: 1e-9, ..Settings::default() };
    Solver::new(problem, [points; 2], settings).unwrap().solve(load)
}

fn solved(problem: Problem, points: usize, load: Load) -> Step {
    let step = stepped(problem, points, load);
    assert!(step.report.stop.solved(), "{}", step.report);
    step
}

/// Largest stresses of each material and each interface with their errors, and whether they lie in the window.
fn stresses(step: &Step) -> Vec<([f64; 2], bool)> {
    let reading = step.reading();
    let found = StressReading::of(step, &reading, &StressFields::new(step.finest(), MeanStress::HalfSpace));
    let materials = found.materials.iter().flat_map(|material| [material.tau1, material.tension, material.mises]);
    let interfaces = found.interfaces.iter().flat_map(|interface| [interface.normal, interface.shear]);
    let [x, y] = [0, 1];
    let is_inside = |place: [f64; 3]| step.grid().cell().contains([place[x], place[y]]);
    let error = |stated: Option<f64>| stated.unwrap_or_else(|| panic!("{}: {found:?}", step.report));
    materials.chain(interfaces).map(|peak| ([peak.value, error(peak.error)], is_inside(peak.position))).collect()
}

/// Random coated contacts in windows of 1.15 to `widest` contact widths against one of `widest`: the numbers compared, those that differ
/// by more than both errors, and those found outside of their window; with the worst difference over both errors.
fn compared(seed: u64, count: usize, widest: f64) -> ([usize; 3], f64) {
    let mut random = Random(seed);
    let (mut counts, mut worst) = ([0; 3], 0.0f64);
    for _ in 0..count {
        let radius = random.log(2.0, 50.0);
        let (body, words) = random_body(&mut random, 1.0);
        let friction = random.pick(&[0.0, 0.0, 0.3]);
        let slides = |problem: Problem| match friction {
            0.0 => problem,
            mu => problem.sliding(Friction::new(mu, [1.0, 0.0]).unwrap()).unwrap(),
        };
        // The force under which contact has the radius 1, about, from a lesser one on.
        let modulus = |q: f64| 2.0 / (q * body.response().compliance(q));
        let mut force = 0.5 * 4.0 / (3.0 * radius) * modulus(1.5).min(modulus(3.0));
        for _ in 0..3 {
            let step = solved(slides(under_a_ball(body.clone(), radius, 8.0)), 64, Load::Force(force));
            force /= step.reading().levels[0].contact_radius.unwrap().powi(3);
        }
        let at = |widths: f64| {
            let points = (2.0 * (16.0 * widths).ceil()) as usize;
            stepped(slides(under_a_ball(body.clone(), radius, 2.0 * widths)), points, Load::Force(force))
        };
        println!("{words} mu {friction}");
        let reference = stresses(&at(widest));
        let mut narrow = 1.15 * (widest / 1.15).powf(random.unit().powi(2));
        // Friction moves the contact: where it has no room, on the coarser grid neither, the window grows.
        let mut step = at(narrow);
        while !step.report.stop.solved() || step.coarser().is_empty() {
            assert!(narrow < 3.0, "{words}, μ = {friction}, {narrow}: {}", step.report);
            narrow *= 1.1;
            step = at(narrow);
        }
        for (number, (one, other)) in stresses(&step).iter().zip(&reference).enumerate() {
            let away = (one.0[0] - other.0[0]).abs() / (one.0[1] + other.0[1]);
            counts[0] += 1;
            counts[1] += usize::from(away > 1.0);
            counts[2] += usize::from(!one.1);
            worst = worst.max(away);
            if away > 1.0 {
                println!("{words}, μ = {friction}, {narrow:.2} widths, number {number}: {one:?}, {other:?}");
            }
        }
    }
    (counts, worst)
}

#[test]
fn largest_stresses_do_not_depend_on_the_window() {
    let ([all, off, outside], worst) = compared(5, 4, 4.0);
    assert!(all > 30 && off == 0 && outside > 0, "{off} of {all}, {outside} outside, {worst}");
}

/// Minutes; 100 contacts.
#[test]
#[ignore = "minutes"]
fn largest_stresses_of_many_contacts_do_not_depend_on_the_window() {
    let ([all, off, outside], worst) = compared(71, 100, 12.0);
    println!("{off} of {all} differ by more than both errors, {outside} outside, worst {worst}");
    assert!(all > 800 && off * 100 <= all && worst < 3.0, "{off} of {all}, {outside} outside, {worst}");
}

/// Under a ball a bare body is compressed at every point of a plane below it; far away σ_zz tends to zero, which the error of the
/// largest one covers.
#[test]
fn a_largest_compression_covers_the_body_at_rest() {
    let layer = Layer::new(material(1.0, 0.3), 0.7, Interface::Bonded).unwrap();
    let body = HalfSpace::new(vec![layer], material(1.0, 0.3));
    let step = solved(under_a_ball(body, 1.0, 3.0), 64, Load::Force(0.3));
    let reading = step.reading();
    let found = StressReading::of(&step, &reading, &StressFields::new(step.finest(), MeanStress::HalfSpace));
    let normal = found.interfaces[0].normal;
    assert!(normal.value < 0.0 && normal.value + normal.error.unwrap() >= 0.0, "{normal:?}");
    // No stress around the window is larger than on its border: 3P/(2πR²) under a point force, at the distance R = (1.5² + 0.7²)^½.
    assert!(normal.error.unwrap() < 3.0 * 0.3 / (2.0 * PI * (1.5f64.powi(2) + 0.7f64.powi(2))), "{normal:?}");
}

/// A stiff coating bends and is drawn several contact radii away: a point that passes the contact meets that too, and its ranges and endurance
/// are those of a window that holds it.
#[test]
fn a_pass_does_not_end_at_the_window() {
    let (law, endurance) = (Fatigue::new(0.3, 1e6, 8.0).unwrap(), Endurance::new(0.2, 0.3).unwrap());
    let tires = Durability { fatigue: Some(law), endurance: Some(endurance), ..Durability::default() };
    let layer = |h: f64, nu: f64| {
        let layer = Layer::new(material(60.0, nu), h, Interface::Bonded).unwrap();
        layer.with_durability(tires, Some(law)).unwrap()
    };
    let body = HalfSpace::new(vec![layer(0.2, 0.22), layer(0.8, 0.3)], material(1.0, 0.38));
    let body = body.with_substrate_durability(tires).unwrap();
    for (friction, direction) in [(0.2, [1.0, 0.0]), (0.0, [0.8, 0.6])] {
        let of = |window: f64, points: usize| {
            let sliding = Friction::new(friction, direction).unwrap();
            let problem = under_a_ball(body.clone(), 50.0, window).sliding(sliding).unwrap();
            let run = Run::new(problem, vec![Load::Force(0.5)], Sampling::Points([points; 2]));
            let step = run.solve(&mut ()).unwrap().steps.into_iter().next().unwrap();
            let lives = step.fatigue.unwrap().lives;
            let ranges = lives.iter().map(|life| [life.range, life.range * life.error.unwrap() / law.exponent()]);
            let utilisations = step.strength.iter().map(|row| [row.value, row.error.unwrap()]);
            ranges.chain(utilisations).collect::<Vec<[f64; 2]>>()
        };
        let (narrow, wide) = (of(3.0, 64), of(9.0, 144));
        assert_eq!(narrow.len(), 5 + 6, "{narrow:?}");
        for (number, ([one, of_one], [other, of_other])) in narrow.iter().zip(&wide).enumerate() {
            println!("{friction} {number}: {one} ± {of_one}, {other} ± {of_other}");
        }
        for (number, ([one, of_one], [other, of_other])) in narrow.iter().zip(&wide).enumerate() {
            assert!((one - other).abs() <= of_one + of_other, "{number}: {one} ± {of_one}, {other} ± {of_other}");
            assert!(*of_one < 0.08 * one, "{number}: {one} ± {of_one}");
        }
    }
}
