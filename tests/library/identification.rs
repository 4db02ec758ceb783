//! Moduli and thickness of a coating from its indentation curve. The curves are those of an integral equation for the
//! axisymmetric contact, with and without noise (`validation/identification`), not of this program.

use crate::common::Random;

use percoat::identification::{
    CurveError, Doubt, Estimate, Identification, IdentificationError, Instrument, LEVEL, Measurement, MeasurementError,
    Model, NoValue, Parameter, Pattern, Quantity, Trial,
};
use percoat::{
    Cell, HalfSpace, Indenters, Interface, Lattice, Layer, Level, Material, MaterialError, Problem, Settings, Shape,
};
use std::f64::consts::PI;
use std::ops::ControlFlow;

const EXACT: &str = include_str!("../../validation/identification/indentation.csv");
const NOISY: &str = include_str!("../../validation/identification/indentation_noisy.csv");
const DERIVATIVES: &str = include_str!("../../validation/identification/indentation_derivatives.csv");

fn rows(text: &str) -> Vec<Vec<f64>> {
    let numbers = |line: &str| line.split(',').map(str::parse).collect::<Result<Vec<f64>, _>>().ok();
    text.lines().filter_map(numbers).collect()
}

fn measured(text: &str, every: usize) -> Measurement {
    let rows = rows(text).into_iter().step_by(every);
    let (forces, penetrations) = rows.map(|row| (row[0], row[1])).unzip();
    Measurement::new(forces, penetrations, None).unwrap()
}

/// A ball of 10 µm on a coating: E, ν and h of the coating, E of the substrate; µm and GPa.
fn problem(values: &[f64]) -> Result<Problem, MaterialError> {
    let &[coating, poisson, thickness, substrate] = values else { unreachable!("four values") };
    let layer = Layer::new(Material::from_young(coating, poisson)?, thickness, Interface::Bonded).unwrap();
    Ok(ball_on(HalfSpace::new(vec![layer], Material::from_young(substrate, 0.3)?), 10.0))
}

fn ball_on(body: HalfSpace, radius: f64) -> Problem {
    let lattice = Lattice::new(Cell::window([4.0; 2]).unwrap(), vec![vec![[0.5; 2]]]).unwrap();
    let level = Level::new(Shape::Paraboloid { radius }, 0.0).unwrap();
    Problem::new(Indenters::new(lattice, vec![level]).unwrap(), body)
}

/// Finds some of E_c, ν_c, h and E_s on 64 samples, the others known.
fn found(
    free: &[(usize, f64)],
    more: &[Quantity],
    measured: &Measurement,
) -> Result<Identification, IdentificationError<MaterialError>> {
    found_on(64, free, more, measured)
}

fn found_on(
    points: usize,
    free: &[(usize, f64)],
    more: &[Quantity],
    measured: &Measurement,
) -> Result<Identification, IdentificationError<MaterialError>> {
    const NAMES: [&str; 4] = ["coating", "poisson", "thickness", "substrate"];
    let parameter = |&(index, start): &(usize, f64)| Parameter {
        name: NAMES[index].to_owned(),
        quantity: if index == 1 { Quantity::Bounded([0.0, 0.5]) } else { Quantity::Positive },
        start,
    };
    let more = more.iter().map(|&quantity| Parameter { name: format!("{quantity:?}"), quantity, start: 0.0 });
    let parameters: Vec<Parameter> = free.iter().map(parameter).chain(more).collect();
    let problem = |values: &[f64]| {
        let mut all = [300.0, 0.2, 1.0, 70.0];
        free.iter().zip(values).for_each(|((index, _), value)| all[*index] = *value);
        problem(&all)
    };
    let settings = Settings { tolerance: 1e-9, ..Settings::default() };
    Identification::new(&Model { problem: &problem, points, settings }, &parameters, measured)
}

/// From starts a factor of two away. The grid of 64 samples leaves some 2e-4 of δ, and ∂ln δ/∂ln E is −0.3 on the average for
/// both moduli, which move against each other.
#[test]
fn moduli_are_found_from_an_exact_curve() {
    let fit = found(&[(0, 150.0), (3, 140.0)], &[], &measured(EXACT, 3)).unwrap();
    for (estimate, known) in fit.estimates.iter().zip([300.0, 70.0]) {
        assert!((estimate.value / known - 1.0).abs() < 3e-3, "{fit}");
    }
    assert!(fit.rms < 2e-4 * 0.39 && fit.correlation[0][1] < -0.3, "{fit}, {:?}", fit.correlation);
    // The contact is as wide as the film is thick, and wider.
    assert!(fit.radii[0] < 0.2 && fit.radii[1] > 1.4, "{:?}", fit.radii);
}

/// Values from a curve with noise of 0.5 nm lie within three standard errors, the residual is the noise, and the zero
/// that was missed by 5 nm is found.
#[test]
fn noise_is_carried_to_the_standard_errors() {
    let noisy = measured(NOISY, 1);
    let fit = found(&[(0, 250.0), (3, 80.0)], &[], &noisy).unwrap();
    assert!((fit.rms / 5e-4 - 1.0).abs() < 0.25, "{fit}");
    let inside = |estimate: &Estimate, known: f64| {
        (estimate.value - known).abs() < 3.0 * estimate.error && estimate.error < 0.02 * known
    };
    assert!(inside(&fit.estimates[0], 300.0) && inside(&fit.estimates[1], 70.0), "{fit}");
    let shifted = Measurement::new(
        noisy.forces().to_vec(),
        noisy.penetrations().iter().map(|x| x + 5e-3).collect(),
        Some(vec![5e-4; noisy.forces().len()]),
    );
    let fit = found(&[(0, 250.0), (3, 80.0)], &[Quantity::Offset], &shifted.unwrap()).unwrap();
    assert!((fit.estimates[2].value - 5e-3).abs() < 3.0 * fit.estimates[2].error, "{fit}");
    assert!((fit.reduced_chi_square.unwrap() - 1.0).abs() < 0.5, "{fit}");
    assert!(fit.band.iter().all(|band| *band > 0.0 && *band < 5e-4), "{fit}");
}

/// Five points with noise do not contain four parameters; a parameter that the curve does not depend on is named.
#[test]
fn what_a_curve_does_not_contain_is_refused() {
    let few = measured(NOISY, 12);
    let all = found_on(32, &[(0, 300.0), (1, 0.2), (2, 1.0), (3, 70.0)], &[], &few);
    assert!(matches!(all, Err(IdentificationError::Undetermined(_))), "{all:?}");
    let too_many = found(&[(0, 300.0), (1, 0.2), (2, 1.0), (3, 70.0)], &[Quantity::Offset], &few);
    assert!(matches!(too_many, Err(IdentificationError::TooFew { points: 5, parameters: 5 })), "{too_many:?}");
}

/// ∂δ/∂ln θ at a load alone, by two fits of a point each would be no fit: the derivatives come out of the residuals' Jacobian, here by
/// the interval that a fit of one parameter states: its standard error is the noise over √Σ(∂δ/∂ln θ)². Loads below a tenth of the largest
/// add two percent to the sum at most, and are left out.
#[test]
fn the_standard_error_of_one_parameter_is_the_noise_over_its_derivatives() {
    let rows: Vec<Vec<f64>> = rows(DERIVATIVES).into_iter().filter(|row| row[0] >= 10.0).collect();
    let (forces, penetrations): (Vec<f64>, Vec<f64>) = rows.iter().map(|row| (row[0], row[1])).unzip();
    let noise = 1e-3;
    let measured = Measurement::new(forces, penetrations, Some(vec![noise; rows.len()])).unwrap();
    for (index, known, column) in [(0, 300.0, 3), (2, 1.0, 5), (3, 70.0, 4)] {
        let fit = found(&[(index, known)], &[], &measured).unwrap();
        let slopes = rows.iter().map(|row| row[column] * row[column]).sum::<f64>().sqrt();
        let (error, expected) = (fit.estimates[0].error / fit.estimates[0].value, noise / slopes);
        assert!((error / expected - 1.0).abs() < 0.01, "{index}: {error}, {expected}");
    }
}

/// Instead of a body stiffer than 60, on which the curve of 70 insists, the model has a ball so large that no window holds its contact: the search ends
/// below, and says which load it is; a start above is refused as a start.
#[test]
fn a_load_that_is_not_solved_on_the_way_is_the_reason_that_is_given() {
    // One load, measured again and again: each node of a curve would seek a window in vain.
    let measured = Measurement::new(vec![20.0; 4], vec![hertz(20.0); 4], None).unwrap();
    let from = |start: f64| {
        let problem = |values: &[f64]| {
            let radius = if values[0] > 60.0 { 1e60 } else { 10.0 };
            Ok::<_, MaterialError>(ball_on(HalfSpace::new(vec![], Material::from_young(values[0], 0.3)?), radius))
        };
        let settings = Settings { tolerance: 1e-9, max_iterations: 200, ..Settings::default() };
        let free = Parameter { name: "young".to_owned(), quantity: Quantity::Positive, start };
        Identification::new(&Model { problem: &problem, points: 32, settings }, &[free], &measured)
    };
    let ended = from(45.0).unwrap_err();
    assert!(matches!(ended, IdentificationError::Refused(NoValue::Curve(CurveError::NotSolved(..)))), "{ended}");
    let told = ended.to_string();
    assert!(told.contains("does not converge") && told.contains("under the force"), "{told}");
    let refused = from(65.0).unwrap_err();
    assert!(matches!(refused, IdentificationError::Curve(CurveError::NotSolved(..))), "{refused}");
}

#[test]
fn a_search_can_be_stopped_and_tells_of_its_trials() {
    let measured = measured(EXACT, 6);
    let problem = |values: &[f64]| problem(&[values[0], 0.2, 1.0, 70.0]);
    let settings = Settings { tolerance: 1e-9, ..Settings::default() };
    let model = Model { problem: &problem, points: 32, settings };
    let free = [Parameter { name: "coating".to_owned(), quantity: Quantity::Positive, start: 150.0 }];
    let mut heard: Vec<Trial> = Vec::new();
    let fit = Identification::new_with_progress(&model, &free, &measured, &mut |trial| {
        heard.push(trial);
        ControlFlow::Continue(())
    });
    let fit = fit.unwrap();
    assert!(heard.iter().map(|trial| trial.number).eq(1..=heard.len()) && heard.len() > fit.steps, "{heard:?}");
    // The result is that of the best trial.
    let least = heard.iter().filter_map(|trial| trial.rms).fold(f64::INFINITY, f64::min);
    assert!((fit.rms / least - 1.0).abs() < 1e-12, "{fit}, {heard:?}");
    let mut trials = 0;
    let stopped = Identification::new_with_progress(&model, &free, &measured, &mut |_| {
        trials += 1;
        if trials < 2 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    });
    assert!(stopped == Err(IdentificationError::Stopped) && trials == 2, "{stopped:?}");
}

/// A number of the normal distribution (Box and Muller).
fn normal(random: &mut Random) -> f64 {
    (-2.0 * (1.0 - random.unit()).ln()).sqrt() * (2.0 * PI * random.unit()).cos()
}

/// Hertz with noise in force and penetration, both a part of their largest value.
fn record(forces: &[f64], part: f64, random: &mut Random) -> [Vec<f64>; 2] {
    let largest = forces.iter().copied().fold(0.0, f64::max);
    let penetrations = forces.iter().map(|force| (force / largest).powf(2.0 / 3.0) + part * normal(random)).collect();
    let forces = forces.iter().map(|force| (force + part * largest * normal(random)).max(1e-9)).collect();
    [forces, penetrations]
}

fn refusal([forces, penetrations]: [Vec<f64>; 2]) -> Option<MeasurementError> {
    Measurement::new(forces, penetrations, None).err()
}

/// Loads in equal steps, in equal ratios, and each twice, with noise up to 2 % of the largest: falls of noise are refused in one of a
/// thousand at most.
#[test]
fn loading_with_noise_is_taken_for_loading() {
    let mut random = Random(1);
    let mut alarms = Vec::new();
    for trial in 0..1200 {
        let count = [5, 12, 40, 300, 1500][trial % 5];
        let force = |k: i32| match trial % 3 {
            0 => f64::from(k),
            1 => 10.0 * 1000f64.powf(f64::from(k) / f64::from(count)),
            _ => f64::from((k + 1) / 2),
        };
        let forces: Vec<f64> = (1..=count).map(force).collect();
        let part = [0.0, 1e-4, 3e-3, 0.02][trial % 4];
        alarms.extend(refusal(record(&forces, part, &mut random)).map(|refusal| (trial, refusal)));
    }
    assert!(alarms.len() <= 3, "{alarms:?}");
}

/// Loading at a constant rate by a cone and by a sphere, whose zero was missed to either side by up to 5 % of the depth: δ/P is then no
/// bound of the slope at first touch.
#[test]
fn a_missed_zero_is_no_hold() {
    for (count, exponent) in [1000, 4000].into_iter().flat_map(|count| [(count, 2.0), (count, 1.5)]) {
        let forces: Vec<f64> = (1..=count).map(|k| (f64::from(k) / f64::from(count)).powf(exponent)).collect();
        for missed in [-0.05, -0.02, 0.0, 0.03] {
            let penetrations = forces.iter().map(|force| force.powf(1.0 / exponent) + missed).collect();
            let refused = refusal([forces.clone(), penetrations]);
            assert!(refused.is_none(), "{count}, {exponent}, {missed}: {refused:?}");
        }
    }
}

#[test]
fn unloading_and_holds_are_refused_with_their_points() {
    let mut random = Random(2);
    let up: Vec<f64> = (1..=20).map(f64::from).collect();
    let down: Vec<f64> = up.iter().rev().copied().collect();
    let held = vec![20.0; 12];
    for part in [0.0, 1e-3, 5e-3] {
        for forces in [down.clone(), [up.clone(), down.clone()].concat(), [&up[..], &held, &down].concat()] {
            let found = refusal(record(&forces, part, &mut random));
            let Some(MeasurementError::Unloading { from, to, forces: ends }) = found else {
                panic!("{part}: {found:?}")
            };
            assert!(to == forces.len() - 1 && forces[from] > 19.0 && (ends[1] - 1.0).abs() < 0.5, "{from} {ends:?}");
        }
        // Points that are repeated are no hold; those between whose first and last third the penetration creeps are.
        let [forces, mut penetrations] = record(&[&up[..], &held].concat(), part, &mut random);
        assert_eq!(refusal([forces.clone(), penetrations.clone()]), None, "{part}");
        penetrations[20..]
            .iter_mut()
            .zip(0u8..)
            .for_each(|(penetration, k)| *penetration += 0.1 * (f64::from(k) / 11.0).sqrt());
        let found = refusal([forces, penetrations]);
        let Some(MeasurementError::Hold { from, to, by, .. }) = found else { panic!("{part}: {found:?}") };
        assert!((18..22).contains(&from) && to == 31 && by > 0.03, "{from} {to} {by}");
    }
}

/// Residuals of straight lines through scatter, also where it grows tenfold along the line, are called a pattern in no more than the
/// stated part of the curves; an arch of the size of the scatter is found.
#[test]
fn scatter_is_no_pattern_and_an_arch_is_one() {
    let mut random = Random(3);
    let mut residuals = |count: usize, grows: bool, arch: f64| -> Vec<f64> {
        let x = |i: usize| 2.0 * i as f64 / (count - 1) as f64 - 1.0;
        let size = |i: usize| if grows { 0.1 + 0.45 * (x(i) + 1.0) } else { 1.0 };
        let scatter: Vec<f64> = (0..count).map(|i| size(i) * normal(&mut random) + arch * x(i) * x(i)).collect();
        // A straight line is taken off: x has the mean 0.
        let mean = scatter.iter().sum::<f64>() / count as f64;
        let squares: f64 = (0..count).map(|i| x(i) * x(i)).sum();
        let slope = scatter.iter().enumerate().map(|(i, r)| x(i) * r).sum::<f64>() / squares;
        scatter.iter().enumerate().map(|(i, r)| r - mean - slope * x(i)).collect()
    };
    const CURVES: usize = 4000;
    for count in [6, 10, 24, 100] {
        for grows in [false, true] {
            let alarms = (0..CURVES).filter(|_| Pattern::of(&residuals(count, grows, 0.0)).is_systematic()).count();
            // Two tests; three standard deviations of the count.
            let expected = 2.0 * LEVEL * CURVES as f64;
            assert!((alarms as f64) < expected + 3.0 * expected.sqrt(), "{count}, {grows}: {alarms}, {expected}");
        }
    }
    for (count, arch, part) in [(24, 6.0, 0.9), (100, 3.0, 0.9), (12, 30.0, 0.9)] {
        let found = (0..400).filter(|_| Pattern::of(&residuals(count, false, arch)).is_systematic()).count();
        assert!(found as f64 > part * 400.0, "{count}, {arch}: {found}");
    }
    // All of twelve above, then all below: 2 of C(24, 12) arrangements.
    let two = Pattern::of(&(0..24).map(|k| if k < 12 { 1.0 } else { -1.0 }).collect::<Vec<_>>());
    assert!((two.probability / (2.0 / 2_704_156.0) - 1.0).abs() < 1e-9 && two.runs == 2 && two.expected == 13.0);
}

/// Penetrations of Hertz under a paraboloid of 10 µm: E = 70 GPa and ν = 0.3.
fn hertz(force: f64) -> f64 {
    (3.0 * force * 0.91 / (4.0 * 70.0 * 10f64.sqrt())).powf(2.0 / 3.0)
}

/// The modulus of a body from its curve, from a start on, beside R = 10 µm, ν = 0.3 and what the instrument is known to add; with its
/// derivatives by these, or without.
fn modulus(measured: &Measurement, start: f64, more: &[Quantity], by_what_is_known: bool) -> Identification {
    let (poisson, radius) = (0.3, 10.0);
    let problem = |values: &[f64]| {
        // The modulus, then what more is free, then ν and R.
        let (nu, radius) = match values.get(1 + more.len()..) {
            Some(&[nu, radius, ..]) => (nu, radius),
            _ => (poisson, radius),
        };
        Ok::<_, MaterialError>(ball_on(HalfSpace::new(vec![], Material::from_young(values[0], nu)?), radius))
    };
    let settings = Settings { tolerance: 1e-9, ..Settings::default() };
    let parameter = |name: &str, quantity, start| Parameter { name: name.to_owned(), quantity, start };
    let mut free = vec![parameter("young", Quantity::Positive, start)];
    free.extend(more.iter().map(|&quantity| parameter("instrument", quantity, 0.0)));
    let mut fixed = vec![
        parameter("poisson", Quantity::Bounded([0.0, 0.5]), poisson),
        parameter("radius", Quantity::Positive, radius),
        parameter("offset", Quantity::Offset, measured.instrument().offset),
        parameter("frame", Quantity::FrameCompliance, measured.instrument().frame_compliance),
    ];
    fixed.retain(|parameter| by_what_is_known && !more.contains(&parameter.quantity));
    let model = Model { problem: &problem, points: 36, settings };
    Identification::with_fixed(&model, (&free, &fixed), measured, &mut |_| ControlFlow::Continue(())).unwrap()
}

fn curve(count: i32, scatter: f64, seed: u64, adds: &dyn Fn(f64) -> f64) -> Measurement {
    let mut random = Random(seed);
    let forces: Vec<f64> = (1..=count).map(|k| 20.0 * f64::from(k) / f64::from(count)).collect();
    let penetrations = forces.iter().map(|&force| hertz(force) + adds(force) + scatter * normal(&mut random)).collect();
    Measurement::new(forces, penetrations, None).unwrap()
}

/// E is in proportion to (1 − ν²)/√R: its derivatives by ν, R, δ₀ and C_f are those, and those of fits with other fixed numbers.
#[test]
fn derivatives_by_what_is_known_are_those_of_hertz_and_of_other_fits() {
    let measured = curve(12, 0.0, 4, &|_| 0.0);
    let fit = modulus(&measured, 100.0, &[], true);
    let young = fit.estimates[0].value;
    let by = |k: usize| fit.sensitivities[k].derivatives[0];
    let exact = [-0.6 * young / 0.91, -young / 20.0];
    for (k, exact) in exact.into_iter().enumerate() {
        // Derivatives on 48 samples are right to a percent or so.
        assert!((by(k) / exact - 1.0).abs() < 0.02, "{k}: {} {exact}", by(k));
    }
    let largest = hertz(20.0);
    for (k, step) in [(2, 0.004 * largest), (3, 0.004 * largest / 20.0)] {
        let at = |sign: f64| {
            let mut instrument = Instrument::default();
            *(if k == 2 { &mut instrument.offset } else { &mut instrument.frame_compliance }) = sign * step;
            modulus(&measured.clone().with_instrument(instrument), young, &[], false).estimates[0].value
        };
        let quotient = (at(1.0) - at(-1.0)) / (2.0 * step);
        assert!((by(k) / quotient - 1.0).abs() < 0.02, "{k}: {} {quotient}", by(k));
    }
}

/// A zero that is missed by 2.5 nm, and the compliance of a frame, are told with their size and the modulus with them; free, or known, there
/// is no doubt and the modulus is right. Points that yield beyond 8 mN are told as a pattern. A good curve is not doubted.
#[test]
fn a_missed_zero_a_frame_and_yield_are_told() {
    const SCATTER: f64 = 2e-4;
    let modulus = |measured: &Measurement, more: &[Quantity]| modulus(measured, 75.0, more, false);
    let plain = modulus(&curve(24, SCATTER, 5, &|_| 0.0), &[]);
    assert_eq!(plain.doubts, []);
    let near = |fit: &Identification| (fit.estimates[0].value - 70.0).abs() < 4.0 * fit.estimates[0].error + 0.2;
    assert!(near(&plain), "{plain}");
    for (quantity, size, instrument) in [
        (Quantity::Offset, -2.5e-3, Instrument { offset: -2.5e-3, ..Instrument::default() }),
        (Quantity::FrameCompliance, 3e-4, Instrument { frame_compliance: 3e-4, ..Instrument::default() }),
    ] {
        let measured = curve(24, SCATTER, 6, &|force| instrument.adds(force));
        let wrong = modulus(&measured, &[]);
        assert!(!near(&wrong), "{wrong}");
        let missing = wrong.doubts.iter().find_map(|doubt| match doubt {
            Doubt::Offset(missing) if quantity == Quantity::Offset => Some(missing),
            Doubt::FrameCompliance(missing) if quantity == Quantity::FrameCompliance => Some(missing),
            _ => None,
        });
        let missing = missing.unwrap_or_else(|| panic!("{wrong:?}"));
        // First order in a change of several percent.
        assert!((missing.value - size).abs() < 4.0 * missing.error + 0.1 * size.abs(), "{missing:?}");
        assert!((missing.estimates[0] - 70.0).abs() < 1.5, "{missing:?}");
        let freed = modulus(&measured, &[quantity]);
        let known = modulus(&measured.with_instrument(instrument), &[]);
        for fit in [freed, known] {
            assert!(near(&fit) && fit.doubts.is_empty(), "{fit}: {:?}", fit.doubts);
        }
    }
    let yields = curve(24, SCATTER, 7, &|force| 1.5e-3 * (force - 8.0f64).max(0.0));
    let told = modulus(&yields, &[]).doubts;
    assert!(matches!(told.first(), Some(Doubt::Systematic(pattern)) if pattern.is_systematic()), "{told:?}");
}

/// A parameter that a curve does not contain is named at the first values, not at the end of a search along it.
#[test]
fn a_hopeless_search_is_given_up_at_its_start() {
    // Contact of less than a thousandth of the thickness: nothing of the substrate is in it.
    let forces: Vec<f64> = (1..=12).map(|k| 1e-9 * f64::from(k)).collect();
    let penetrations = forces.iter().map(|force| (3.0 * force * 0.96 / (4.0 * 300.0 * 10f64.sqrt())).powf(2.0 / 3.0));
    let mut random = Random(8);
    let penetrations = penetrations.map(|penetration| penetration * (1.0 + 0.02 * normal(&mut random))).collect();
    let measured = Measurement::new(forces, penetrations, None).unwrap();
    let problem = |values: &[f64]| problem(&[values[0], 0.2, 1.0, values[1]]);
    let settings = Settings { tolerance: 1e-9, ..Settings::default() };
    let parameter = |name: &str, start| Parameter { name: name.to_owned(), quantity: Quantity::Positive, start };
    let mut trials = 0;
    let found = Identification::new_with_progress(
        &Model { problem: &problem, points: 32, settings },
        &[parameter("coating", 250.0), parameter("substrate", 70.0)],
        &measured,
        &mut |trial| {
            // Values that the model refuses are none.
            trials += usize::from(trial.rms.is_some());
            ControlFlow::Continue(())
        },
    );
    let Err(IdentificationError::Undetermined(parameter)) = found else { panic!("{found:?}") };
    assert!(parameter.at_start && parameter.name == "substrate" && trials <= 3, "{parameter}, {trials} trials");
    assert!(parameter.to_string().starts_with("at the first values of the search"), "{parameter}");
}

/// A radius that the model takes at its value alone has no derivative; what was found stays, and so do the derivatives by the others. Where the
/// model takes none of them, none is there.
#[test]
fn a_fit_is_kept_where_derivatives_are_missing() {
    let measured = curve(12, 0.0, 4, &|_| 0.0);
    let parameter = |name: &str, quantity, start| Parameter { name: name.to_owned(), quantity, start };
    let free = [parameter("young", Quantity::Positive, 100.0)];
    let fixed = [
        parameter("poisson", Quantity::Bounded([0.0, 0.5]), 0.3),
        parameter("radius", Quantity::Positive, 10.0),
        parameter("offset", Quantity::Offset, 0.0),
    ];
    let fit = |takes: &(dyn Fn(&[f64]) -> bool + Sync)| {
        let problem = |values: &[f64]| match takes(values) {
            true => {
                let nu = values.get(1).copied().unwrap_or(0.3);
                Ok(ball_on(HalfSpace::new(vec![], Material::from_young(values[0], nu)?), 10.0))
            }
            false => Err(MaterialError::Hardness(-1.0)),
        };
        let model =
            Model { problem: &problem, points: 48, settings: Settings { tolerance: 1e-9, ..Settings::default() } };
        Identification::with_fixed(&model, (&free, &fixed), &measured, &mut |_| ControlFlow::Continue(())).unwrap()
    };
    let whole = fit(&|_| true);
    let names = |fit: &Identification| fit.sensitivities.iter().map(|row| row.fixed.name.clone()).collect::<Vec<_>>();
    assert!(whole.doubts.is_empty() && names(&whole) == ["poisson", "radius", "offset"], "{:?}", whole.doubts);
    for (takes, known, missing) in [
        (
            &(|values: &[f64]| values.get(2).is_none_or(|radius| *radius == 10.0)) as &(dyn Fn(&[f64]) -> bool + Sync),
            2,
            vec!["radius"],
        ),
        (&|values: &[f64]| values.len() == 1, 0, vec!["poisson", "radius", "offset"]),
    ] {
        let found = fit(takes);
        assert_eq!((&found.estimates, found.rms, found.sensitivities.len()), (&whole.estimates, whole.rms, known));
        let [Doubt::NoDerivative(none)] = &found.doubts[..] else { panic!("{:?}", found.doubts) };
        assert!(none.names == missing && none.reason.contains("a hardness must be positive"), "{none:?}");
        if known == 2 {
            assert_eq!(found.sensitivities[0].fixed.name, "poisson");
            let [part, all] = [&found, &whole].map(|fit| fit.sensitivities[0].derivatives[0]);
            assert!((part / all - 1.0).abs() < 1e-6, "{part} {all}");
        }
    }
}
