//! Moduli from unloading: the flat punch and the paraboloid on layered bodies, and Oliver and Pharr's method with them.

use crate::common::Random;

use percoat::identification::{
    FromUnloading, IdentificationError, Instrument, NoContact, Parameter, Punch, Quantity, Unloading, UnloadingDoubt,
    UnloadingModel,
};
use percoat::{
    Bodies, Cell, HalfSpace, Indenters, Interface, Lattice, Layer, Level, Load, Material, MaterialError, Problem,
    Settings, Shape, Solver,
};
use std::f64::consts::PI;
use std::ops::ControlFlow;

/// A cone with the area of a Berkovich diamond at each depth, A = 24.5 h².
const SLOPE: f64 = 0.358_090_4;
/// E and ν of the coating, and of the substrate; GPa. Its thickness is 1 µm.
const COATING: [f64; 2] = [300.0, 0.2];
const SUBSTRATE: [f64; 2] = [70.0, 0.3];

fn material([young, poisson]: [f64; 2]) -> Material {
    Material::from_young(young, poisson).unwrap()
}

fn coated(young: f64, thickness: f64) -> HalfSpace {
    let layer = Layer::new(material([young, COATING[1]]), thickness, Interface::Bonded).unwrap();
    HalfSpace::new(vec![layer], material(SUBSTRATE))
}

fn under(shape: Shape, bodies: impl Into<Bodies>) -> Problem {
    let lattice = Lattice::new(Cell::window([4.0; 2]).unwrap(), vec![vec![[0.5; 2]]]).unwrap();
    Problem::new(Indenters::new(lattice, vec![Level::new(shape, 0.0).unwrap()]).unwrap(), bodies)
}

fn parameter(name: &str, quantity: Quantity, start: f64) -> Parameter {
    Parameter { name: name.to_owned(), quantity, start }
}

/// An unloading with these numbers, S with a relative standard error.
fn unloading([force, penetration]: [f64; 2], stiffness: f64, error: f64) -> Unloading {
    Unloading {
        force,
        penetration,
        scatter: 1e-9,
        stiffness,
        stiffness_error: error * stiffness,
        exponent: 1.5,
        residual_depth: 0.5 * penetration,
        forces: vec![force; 60],
        penetrations: vec![penetration; 60],
        fitted: vec![penetration; 60],
        rms: 1e-9,
        is_systematic: false,
    }
}

/// The modulus of a coating of a thickness by unloadings with the cone.
fn modulus(
    unloadings: &[Unloading],
    thickness: f64,
    start: f64,
) -> Result<FromUnloading, IdentificationError<MaterialError>> {
    let problem = |values: &[f64]| {
        Ok(under(Shape::Cone { slope: SLOPE }, coated(values[0], *values.get(1).unwrap_or(&thickness))))
    };
    let model = UnloadingModel { problem: &problem, instrument: Instrument::default(), beta: 1.0 };
    let free = [parameter("coating", Quantity::Positive, start)];
    let fixed = [parameter("thickness", Quantity::Positive, thickness)];
    FromUnloading::new(&model, (&free, &fixed), unloadings, &mut |_| ControlFlow::Continue(()))
}

/// S and ε = (δ − a²/(2R)) S/P of the paraboloid of an independent integral equation (`validation/free-space`), good to 1e-11, on six bodies with
/// contacts of 0.02 to 20 thicknesses. What is stated as the error holds.
#[test]
fn punches_and_paraboloids_are_those_of_the_integral_equation() {
    let (bonded, sliding) = (Interface::Bonded, Interface::Frictionless);
    let bodies: [&[([f64; 3], Interface)]; 7] = [
        &[([1.0, 10.0, 0.2], bonded)],
        &[([1.0, 100.0, 0.2], bonded)],
        &[([1.0, 0.01, 0.5], bonded)],
        &[([1.0, 4.0, 0.25], bonded), ([0.5, 0.5, 0.45], bonded)],
        &[([1.0, 10.0, 0.2], sliding)],
        &[([1.0, 0.1, 0.5], sliding)],
        &[([1.0, 4.0, 0.25], sliding), ([0.5, 0.5, 0.45], bonded)],
    ];
    let table = include_str!("../../validation/free-space/indentation.csv");
    let rows: Vec<Vec<f64>> = table
        .lines()
        .filter_map(|line| line.split(',').map(str::parse).collect::<Result<Vec<f64>, _>>().ok())
        .collect();
    assert_eq!(rows.len(), 49);
    for row in rows {
        let &[body, a, force, penetration, _, stiffness] = &row[..] else { panic!("{row:?}") };
        let layer = |&([h, young, poisson], interface): &([f64; 3], Interface)| {
            Layer::new(material([young, poisson]), h, interface).unwrap()
        };
        let layers = bodies[body as usize].iter().map(layer).collect();
        let found = Punch::new(&HalfSpace::new(layers, material([1.0, 0.3])).into(), a);
        let off = (found.stiffness / stiffness - 1.0).abs();
        assert!(off < 1e-8 && off < found.error + 1e-9, "{row:?}: {off:e}, {found:?}");
        let epsilon = (penetration - 0.5 * a * a) * stiffness / force;
        assert!((found.epsilon / epsilon - 1.0).abs() < 1e-7, "{row:?}: {epsilon}, {found:?}");
    }
}

/// On a bare body the modulus is that of the formula with ε = 3/4, to the tolerance 1e-6 of the search, whose last step is far
/// smaller; with a diamond, a frame, a missed zero and β too.
#[test]
fn a_bare_body_has_the_modulus_of_oliver_and_pharr() {
    let [force, penetration, stiffness] = [10.0, 0.3, 220.0];
    let (instrument, beta) = (Instrument { offset: 0.01, frame_compliance: 2e-4 }, 1.034);
    let alone = 1.0 / (1.0 / stiffness - instrument.frame_compliance);
    let depth = penetration - 0.01 - 2e-4 * force - 0.75 * force / alone;
    let area = PI * (depth / SLOPE).powi(2);
    let reduced = PI.sqrt() * alone / (2.0 * beta * area.sqrt());
    let diamond = HalfSpace::new(vec![], material([1141.0, 0.07]));
    let young = 0.91 / (1.0 / reduced - (1.0 - 0.07 * 0.07) / 1141.0);
    let problem = |values: &[f64]| {
        let body = HalfSpace::new(vec![], material([values[0], 0.3]));
        Ok::<_, MaterialError>(under(Shape::Cone { slope: SLOPE }, Bodies::elastic(body, diamond.clone())))
    };
    let model = UnloadingModel { problem: &problem, instrument, beta };
    let free = [parameter("young", Quantity::Positive, 100.0)];
    let measured = [unloading([force, penetration], stiffness, 0.01)];
    let found = FromUnloading::new(&model, (&free, &[]), &measured, &mut |_| ControlFlow::Continue(())).unwrap();
    let contact = &found.contacts[0];
    assert!((found.estimates[0].value / young - 1.0).abs() < 1e-7, "{found:?}, {young}");
    assert!((contact.bare.reduced / reduced - 1.0).abs() < 1e-12 && contact.epsilon == 0.75);
    assert!((contact.bare.young.unwrap() / young - 1.0).abs() < 1e-12);
    assert!((contact.hardness / (force / area) - 1.0).abs() < 1e-12 && found.model_error == 0.0);
    // E_r ~ S/√A: its error is that of S, 1 %, times 1 − 0.75 P/(S h_c) of a cone.
    let part = 1.0 - 0.75 * force / (alone * depth);
    let expected = 0.01 * alone / stiffness * part;
    assert!((contact.bare.error / reduced / expected - 1.0).abs() < 1e-3, "{contact:?}, {expected}");
    let soft =
        UnloadingModel { problem: &problem, instrument: Instrument { frame_compliance: 1.0, offset: 0.0 }, beta };
    let refused = FromUnloading::new(&soft, (&free, &[]), &measured, &mut |_| ControlFlow::Continue(())).unwrap_err();
    assert!(matches!(refused, IdentificationError::Contact(NoContact::Frame { curve: 0, .. })), "{refused}");
}

/// Radius, force and penetration of a paraboloid on the coated body by the spectral solver, on `points` samples of a window that the contact fills
/// alike under each force.
fn spectral(radius: f64, force: f64, points: usize) -> [f64; 2] {
    let mut side = 4.0;
    loop {
        let lattice = Lattice::new(Cell::window([side; 2]).unwrap(), vec![vec![[0.5; 2]]]).unwrap();
        let level = Level::new(Shape::Paraboloid { radius }, 0.0).unwrap();
        let problem = Problem::new(Indenters::new(lattice, vec![level]).unwrap(), coated(COATING[0], 1.0));
        let settings = Settings { tolerance: 1e-9, ..Settings::default() };
        let step = Solver::new(problem, [points; 2], settings).unwrap().solve(Load::Force(force));
        let a = step.reading().levels[0].contact_radius.unwrap_or(side);
        if step.report.stop.solved() && (2.0 * a / side - 0.7).abs() < 0.01 {
            return [a, step.penetration()];
        }
        side = 2.0 * a / 0.7;
    }
}

/// A test on the coated body by the spectral solver: a cone that has pressed in to a contact radius comes loose as the paraboloid of radius R
/// does, h = f(a) + δ(P) − a²/(2R).
fn spectral_test(radius: f64, force: f64) -> [Vec<f64>; 2] {
    let [a, most] = spectral(radius, force, 128);
    let depth = SLOPE * a - 0.5 * a * a / radius;
    let parts: Vec<f64> = (0..12).map(|k| 1.0 - 0.07 * f64::from(k)).collect();
    let unloading = parts.iter().map(|part| [part * force, depth + spectral(radius, part * force, 128)[1]]);
    let loading = (1..10).map(|k| f64::from(k) / 10.0).map(|part| [part * force, (depth + most) * part.sqrt()]);
    let points: Vec<[f64; 2]> = loading.chain(unloading).collect();
    [0, 1].map(|k| points.iter().map(|point| point[k]).collect())
}

/// E of the coating from unloadings that the spectral solver has computed, at contacts of half to all of the thickness. Its radius is off by 1e-3 at most and
/// the slope of its penetrations by 2e-3; the layered unloading is no power law, by some 5e-4 of S. With ∂ln S/∂ln E_c ≥ 0.35 that is 1 % of E_c.
/// The formula for bare bodies is off by far more.
#[test]
fn the_modulus_of_a_coating_is_found_from_spectral_unloadings() {
    let tests: Vec<[Vec<f64>; 2]> = [8.0, 40.0].map(|force| spectral_test(4.0, force)).to_vec();
    let unloadings: Vec<Unloading> = tests
        .iter()
        .map(|[forces, penetrations]| Unloading::new(forces, penetrations, None, Unloading::PART).unwrap())
        .collect();
    for some in [&unloadings[..1], &unloadings[1..], &unloadings[..]] {
        let found = modulus(some, 1.0, 150.0).unwrap();
        let off = found.estimates[0].value / COATING[0] - 1.0;
        let bare = found.contacts[0].bare.young.unwrap() / COATING[0] - 1.0;
        assert!(off.abs() < 0.01 && bare < -0.1, "{off} {bare} {found:?}");
        assert!((found.contacts[0].epsilon - 0.75).abs() > 0.005, "{found:?}");
    }
}

/// Derivative by the thickness: the modulus found beside it.
#[test]
fn derivatives_by_what_is_known_are_those_of_other_known_values() {
    let punch = Punch::new(&coated(300.0, 1.0).into(), 0.7);
    let measured = [unloading([10.0, SLOPE * 0.7 + punch.epsilon * 10.0 / punch.stiffness], punch.stiffness, 0.01)];
    let at = |thickness: f64| modulus(&measured, thickness, 200.0).unwrap();
    let found = at(1.0);
    assert!((found.estimates[0].value / 300.0 - 1.0).abs() < 1e-6, "{found:?}");
    let quotient = (at(1.01).estimates[0].value - at(0.99).estimates[0].value) / 0.02;
    assert!((found.sensitivities[0].derivatives[0] / quotient - 1.0).abs() < 2e-3, "{found:?}, {quotient}");
}

/// Noise of 0.4 nm in the penetrations of three tests, 100 draws: the intervals of 95 % hold the modulus that is found without noise in 95 % of them, within
/// 3 √(0.95·0.05/100) = 6.5 %, and are not wider by half than the scatter.
#[test]
fn intervals_hold_the_modulus_under_noise() {
    let mut random = Random(7);
    let mut normal = || (-2.0 * (1.0 - random.unit()).ln()).sqrt() * (2.0 * PI * random.unit()).cos();
    let laws: Vec<[f64; 4]> = [0.4, 0.7, 1.1]
        .map(|a| {
            let punch = Punch::new(&coated(300.0, 1.0).into(), a);
            // A hardness of 12 GPa; m = 1.4.
            let force = 12.0 * PI * a * a;
            let c = 1.4 * force / punch.stiffness;
            [force, SLOPE * a + punch.epsilon * force / punch.stiffness - c, c, 1.0 / 1.4]
        })
        .to_vec();
    let mut draw = |noise: f64| -> FromUnloading {
        let unloadings: Vec<Unloading> = laws
            .iter()
            .map(|&[force, left, c, n]| {
                let parts = (0..=60).map(|k| 1.0 - f64::from(k) / 80.0);
                let points = parts.map(|part| (part * force, left + c * part.powf(n) + noise * normal()));
                let (forces, penetrations): (Vec<f64>, Vec<f64>) = points.unzip();
                Unloading::new(&forces, &penetrations, None, Unloading::PART).unwrap()
            })
            .collect();
        modulus(&unloadings, 1.0, 250.0).unwrap()
    };
    let exact = draw(0.0).estimates[0].value;
    assert!((exact / 300.0 - 1.0).abs() < 1e-5, "{exact}");
    let (mut inside, mut squares, mut errors) = (0, 0.0, 0.0);
    for _ in 0..100 {
        let found = draw(4e-4);
        let estimate = &found.estimates[0];
        inside += i32::from(estimate.interval[0] < exact && exact < estimate.interval[1]);
        squares += (estimate.value - exact).powi(2);
        errors += estimate.error;
    }
    let (scatter, error) = ((squares / 100.0_f64).sqrt(), errors / 100.0);
    assert!((f64::from(inside) / 100.0 - 0.95).abs() < 0.065, "{inside} of 100; {scatter} {error}");
    assert!((error / scatter - 1.0).abs() < 0.5, "{scatter} {error}");
}

/// A film of a hundredth of the contact radius, S to 2 %; and fewer unloadings than unknowns. Stiffnesses that differ by more than their
/// errors are told.
#[test]
fn what_unloading_does_not_tell_is_said() {
    let at = |a: f64, thickness: f64, factor: f64| {
        let punch = Punch::new(&coated(300.0, thickness).into(), a);
        let force = 12.0 * PI * a * a;
        let top = [force, SLOPE * a + punch.epsilon * force / (factor * punch.stiffness)];
        unloading(top, factor * punch.stiffness, 0.02)
    };
    let refused = modulus(&[at(1.0, 0.01, 1.0)], 0.01, 300.0).unwrap_err();
    let IdentificationError::Undetermined(undetermined) = &refused else { panic!("{refused}") };
    assert!(undetermined.name == "coating" && refused.to_string().contains("contact radii"), "{refused}");
    let problem =
        |values: &[f64]| Ok::<_, MaterialError>(under(Shape::Cone { slope: SLOPE }, coated(values[0], values[1])));
    let model = UnloadingModel { problem: &problem, instrument: Instrument::default(), beta: 1.0 };
    let free = [parameter("coating", Quantity::Positive, 300.0), parameter("thickness", Quantity::Positive, 1.0)];
    let one = [at(0.7, 1.0, 1.0)];
    let too_few = FromUnloading::new(&model, (&free, &[]), &one, &mut |_| ControlFlow::Continue(())).unwrap_err();
    assert_eq!(too_few, IdentificationError::TooFewUnloadings { curves: 1, parameters: 2 });
    let differing = modulus(&[at(0.7, 1.0, 1.1), at(0.7, 1.0, 0.95)], 1.0, 300.0).unwrap();
    assert!(differing.doubts.iter().any(|doubt| matches!(doubt, UnloadingDoubt::Scatter(_))), "{differing:?}");
    assert!(differing.estimates[0].error > 3.0 * 0.02 * 300.0, "{differing:?}");
}
