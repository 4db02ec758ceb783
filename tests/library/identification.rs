//! Moduli and thickness of a coating from its indentation curve. The curves are those of an integral equation for the
//! axisymmetric contact, with and without noise (`validation/identification`), not of this program.

use percoat::identification::{
    CurveError, Estimate, Identification, IdentificationError, Measurement, Model, NoValue, Parameter, Quantity, Trial,
};
use percoat::{
    Cell, HalfSpace, Indenters, Interface, Lattice, Layer, Level, Material, MaterialError, Problem, Settings, Shape,
};
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
    under_ball(10.0, values)
}

fn under_ball(radius: f64, values: &[f64]) -> Result<Problem, MaterialError> {
    let &[coating, poisson, thickness, substrate] = values else { unreachable!("four values") };
    let layer = Layer::new(Material::from_young(coating, poisson)?, thickness, Interface::Bonded).unwrap();
    let lattice = Lattice::new(Cell::window([4.0; 2]).unwrap(), vec![vec![[0.5; 2]]]).unwrap();
    let level = Level::new(Shape::Paraboloid { radius }, 0.0).unwrap();
    let half_space = HalfSpace::new(vec![layer], Material::from_young(substrate, 0.3)?);
    Ok(Problem::new(Indenters::new(lattice, vec![level]).unwrap(), half_space))
}

/// Finds some of E_c, ν_c, h and E_s, the others known.
fn found(
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
    Identification::new(&Model { problem: &problem, points: 64, settings }, &parameters, measured)
}

/// From starts a factor of two away. The grid of 64 samples leaves some 2e-4 of δ, and ∂ln δ/∂ln E is −0.3 on the average for
/// both moduli, which move against each other.
#[test]
fn moduli_are_found_from_an_exact_curve() {
    let own = found(&[(0, 150.0), (3, 140.0)], &[], &measured(EXACT, 3)).unwrap();
    for (estimate, known) in own.estimates.iter().zip([300.0, 70.0]) {
        assert!((estimate.value / known - 1.0).abs() < 3e-3, "{own}");
    }
    assert!(own.rms < 2e-4 * 0.39 && own.correlation[0][1] < -0.3, "{own}, {:?}", own.correlation);
    // The contact is as wide as the film is thick, and wider.
    assert!(own.radii[0] < 0.2 && own.radii[1] > 1.4, "{:?}", own.radii);
}

/// With noise of 0.5 nm the values lie within three standard errors, the residual is the noise, and the zero that was missed by
/// 5 nm is found.
#[test]
fn noise_is_carried_to_the_standard_errors() {
    let noisy = measured(NOISY, 1);
    let own = found(&[(0, 250.0), (3, 80.0)], &[], &noisy).unwrap();
    assert!((own.rms / 5e-4 - 1.0).abs() < 0.25, "{own}");
    let inside = |own: &Estimate, known: f64| (own.value - known).abs() < 3.0 * own.error && own.error < 0.02 * known;
    assert!(inside(&own.estimates[0], 300.0) && inside(&own.estimates[1], 70.0), "{own}");
    let shifted = Measurement::new(
        noisy.forces().to_vec(),
        noisy.penetrations().iter().map(|x| x + 5e-3).collect(),
        Some(vec![5e-4; noisy.forces().len()]),
    );
    let own = found(&[(0, 250.0), (3, 80.0)], &[Quantity::Offset], &shifted.unwrap()).unwrap();
    assert!((own.estimates[2].value - 5e-3).abs() < 3.0 * own.estimates[2].error, "{own}");
    assert!((own.reduced_chi_square.unwrap() - 1.0).abs() < 0.5, "{own}");
    assert!(own.band.iter().all(|band| *band > 0.0 && *band < 5e-4), "{own}");
}

/// Five points of light loads with noise do not contain four parameters; a parameter that the curve does not depend on is named.
#[test]
fn what_a_curve_does_not_contain_is_refused() {
    let few = measured(NOISY, 12);
    let all = found(&[(0, 300.0), (1, 0.2), (2, 1.0), (3, 70.0)], &[], &few);
    assert!(matches!(all, Err(IdentificationError::Undetermined(_))), "{all:?}");
    let too_many = found(&[(0, 300.0), (1, 0.2), (2, 1.0), (3, 70.0)], &[Quantity::Offset], &few);
    assert!(matches!(too_many, Err(IdentificationError::TooFew { points: 5, parameters: 5 })), "{too_many:?}");
}

/// ∂δ/∂ln θ at a load alone, by two fits of a point each would be no fit: the derivatives come out of the residuals' Jacobian, here by
/// the interval that a fit of one parameter states: its standard error is the noise over √Σ(∂δ/∂ln θ)².
#[test]
fn the_standard_error_of_one_parameter_is_the_noise_over_its_derivatives() {
    let rows = rows(DERIVATIVES);
    let (forces, penetrations): (Vec<f64>, Vec<f64>) = rows.iter().map(|row| (row[0], row[1])).unzip();
    let noise = 1e-3;
    let measured = Measurement::new(forces, penetrations, Some(vec![noise; rows.len()])).unwrap();
    for (index, known, column) in [(0, 300.0, 3), (2, 1.0, 5), (3, 70.0, 4)] {
        let own = found(&[(index, known)], &[], &measured).unwrap();
        let slopes = rows.iter().map(|row| row[column] * row[column]).sum::<f64>().sqrt();
        let (error, expected) = (own.estimates[0].error / own.estimates[0].value, noise / slopes);
        assert!((error / expected - 1.0).abs() < 0.01, "{index}: {error}, {expected}");
    }
}

/// Where the coating is stiffer than 200, on which the exact curve insists, the ball is so large that no window holds its contact: the search
/// ends below, and says which load it is; from a start there it is the start that is refused.
#[test]
fn a_load_that_is_not_solved_on_the_way_is_the_reason_that_is_given() {
    let measured = measured(EXACT, 6);
    let from = |start: f64| {
        let radius = |coating: f64| if coating > 200.0 { 1e60 } else { 10.0 };
        let problem = |values: &[f64]| under_ball(radius(values[0]), &[values[0], 0.2, 1.0, 70.0]);
        let settings = Settings { tolerance: 1e-9, ..Settings::default() };
        let free = Parameter { name: "coating".to_owned(), quantity: Quantity::Positive, start };
        Identification::new(&Model { problem: &problem, points: 48, settings }, &[free], &measured)
    };
    let ended = from(150.0).unwrap_err();
    assert!(matches!(ended, IdentificationError::Refused(NoValue::Curve(CurveError::NotSolved(..)))), "{ended}");
    let told = ended.to_string();
    assert!(told.contains("does not converge") && told.contains("under the force"), "{told}");
    let refused = from(250.0).unwrap_err();
    assert!(matches!(refused, IdentificationError::Curve(CurveError::NotSolved(..))), "{refused}");
}

#[test]
fn a_search_can_be_stopped_and_tells_of_its_trials() {
    let measured = measured(EXACT, 6);
    let problem = |values: &[f64]| problem(&[values[0], 0.2, 1.0, 70.0]);
    let settings = Settings { tolerance: 1e-9, ..Settings::default() };
    let model = Model { problem: &problem, points: 48, settings };
    let free = [Parameter { name: "coating".to_owned(), quantity: Quantity::Positive, start: 150.0 }];
    let mut heard: Vec<Trial> = Vec::new();
    let own = Identification::new_with_progress(&model, &free, &measured, &mut |trial| {
        heard.push(trial);
        ControlFlow::Continue(())
    });
    let own = own.unwrap();
    assert!(heard.iter().map(|trial| trial.number).eq(1..=heard.len()) && heard.len() > own.steps, "{heard:?}");
    // The result is that of the best trial.
    let least = heard.iter().filter_map(|trial| trial.rms).fold(f64::INFINITY, f64::min);
    assert!((own.rms / least - 1.0).abs() < 1e-12, "{own}, {heard:?}");
    let mut trials = 0;
    let stopped = Identification::new_with_progress(&model, &free, &measured, &mut |_| {
        trials += 1;
        if trials < 2 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    });
    assert!(stopped == Err(IdentificationError::Stopped) && trials == 2, "{stopped:?}");
}
