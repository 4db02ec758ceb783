//! Coated bodies: glassy at first and relaxed in the end, the order of the steps, stated errors in time.

use super::setup::{NAMES, Stuff, advanced, coated, in_contact, in_time, solved, surface};
use crate::{Check, Data, Outcome, StudyError, Tolerance};
use percoat_core::load::Load;
use percoat_core::problem::Problem;
use percoat_core::spectral::CreepStep;
use std::f64::consts::TAU;

const MEAN: f64 = 0.02;
/// Loading, a hold, unloading, recovery.
const PATH: [[f64; 2]; 5] = [[0.0, 0.0], [0.5, 0.02], [3.0, 0.02], [4.0, 0.01], [100.0, 0.01]];
/// A jump, a hold, a jump back, recovery under a rest of the load.
const JUMPS: [[f64; 2]; 5] = [[0.0, 0.02], [2.0, 0.02], [2.0, 0.004], [3.0, 0.004], [50.0, 0.004]];
const TOLERANCES: [f64; 3] = [1e-2, 3e-3, 1e-3];
const FINE: f64 = 1e-5;

pub fn add(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    ends(outcome, quick)?;
    orders(outcome, quick)?;
    stated(outcome, quick)
}

fn unchanged(stuff: &Stuff) -> Stuff {
    stuff.clone()
}

/// Under a held load: penetration, energy and displacement of the elastic contact of glassy, then of relaxed materials.
fn ends(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let mut data = Data::new(
        "ends",
        &["body", "surface", "relaxed", "penetration", "elastic", "energy", "touching", "displacement"],
    );
    let points = if quick { 48 } else { 96 };
    let surfaces = if quick { 0..1 } else { 0..3 };
    for (number, form) in surfaces.flat_map(|form| (0..NAMES.len()).map(move |number| (number, form))) {
        let points = [if form == 2 { 128 } else { points }; 2];
        let problem = Problem::new(surface(form)?, coated(number, unchanged)?);
        let mut creeps = in_time(&problem, points, 1e-2)?;
        for (time, of) in [(0.0, Stuff::glassy as fn(&Stuff) -> Stuff), (1e5, Stuff::relaxed)] {
            let step = advanced(&mut creeps, time, Load::MeanPressure(MEAN))?.contact;
            let exact = solved(Problem::new(surface(form)?, coated(number, of)?), points, Load::MeanPressure(MEAN))?;
            let moved = (&step.displacement() - &exact.displacement()).iter().fold(0.0f64, |most, w| most.max(w.abs()));
            data.rows.push(vec![
                number as f64,
                form as f64,
                f64::from(u8::from(time > 0.0)),
                step.penetration(),
                exact.penetration(),
                step.elastic_energy() / exact.elastic_energy(),
                in_contact(&step).abs_diff(in_contact(&exact)) as f64,
                moved / exact.penetration(),
            ]);
        }
    }
    for (end, name) in ["glassy at first", "relaxed in the end"].into_iter().enumerate() {
        let rows = || data.rows.iter().filter(|row| row[2] == end as f64);
        let mut add = |what: &str, pairs: Vec<(f64, f64)>, tolerance| {
            let name = format!("coated bodies, {name}, {what}");
            outcome.checks.push(Check::worst(name, pairs, tolerance).of_refinement());
        };
        add("penetration", rows().map(|row| (row[3], row[4])).collect(), Tolerance::Relative(2e-7));
        add("energy over the elastic one", rows().map(|row| (row[5], 1.0)).collect(), Tolerance::Absolute(1e-6));
        add("displacement over the penetration", rows().map(|row| (row[7], 0.0)).collect(), Tolerance::Absolute(1e-6));
        add("samples in contact, more or fewer", rows().map(|row| (row[6], 0.0)).collect(), Tolerance::Absolute(2.0));
    }
    outcome.data.push(data);
    Ok(())
}

/// Loading and unloading in equal steps.
fn orders(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let mut data = Data::new("steps", &["body", "steps", "penetration"]);
    let counts = if quick { [8, 16, 32, 64] } else { [10, 20, 80, 160] };
    for number in 0..if quick { 1 } else { NAMES.len() } {
        let problem = Problem::new(surface(0)?, coated(number, unchanged)?);
        for steps in counts {
            let mut creeps = in_time(&problem, [64; 2], f64::INFINITY)?;
            let mut penetration = f64::NAN;
            for n in 0..=steps {
                let part = f64::from(n) / f64::from(steps);
                let load = 0.002 + 0.01 * (1.0 - (0.75 * TAU * part).cos());
                let step = advanced(&mut creeps, 1.5 * part, Load::MeanPressure(load))?;
                penetration = step.contact.penetration();
            }
            data.rows.push(vec![number as f64, f64::from(steps), penetration]);
        }
    }
    let orders = data.rows.chunks(4).map(|rows| {
        let change = |row: usize| rows[row + 1][2] - rows[row][2];
        ((change(0) / change(2)).log2() / (counts[2] as f64 / counts[0] as f64).log2(), 2.0)
    });
    let name = "order of the steps through loading and unloading";
    outcome.checks.push(Check::worst(name, orders.collect::<Vec<_>>(), Tolerance::Order(0.25)));
    outcome.data.push(data);
    Ok(())
}

/// Errors of a path against fine steps, and those that are stated.
fn stated(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let columns =
        ["body", "surface", "jumps", "tolerance", "time", "penetration", "stated", "pressure", "stated_pressure"];
    let mut data = Data::new("stated", &columns);
    let (bodies, forms) = if quick { (0..2, 0..1) } else { (0..NAMES.len(), 0..3) };
    for (number, form) in bodies.flat_map(|number| forms.clone().map(move |form| (number, form))) {
        let points = [if form == 2 { 64 } else { 48 }; 2];
        let problem = Problem::new(surface(form)?, coated(number, unchanged)?);
        for (jumps, path) in [PATH, JUMPS].into_iter().enumerate() {
            let run = |tolerance: f64| -> Result<Vec<CreepStep>, StudyError> {
                let mut creeps = in_time(&problem, points, tolerance)?;
                path.iter().map(|&[time, mean]| advanced(&mut creeps, time, Load::MeanPressure(mean))).collect()
            };
            let fine = run(FINE)?;
            for tolerance in TOLERANCES {
                for (step, fine) in run(tolerance)?.iter().zip(&fine) {
                    let row = [number as f64, form as f64, jumps as f64, tolerance, step.time];
                    data.rows.push([&row[..], &errors(step, fine)?].concat());
                }
            }
        }
    }
    for (column, name) in [(5, "penetration"), (7, "pressure")] {
        let rows = data.rows.iter().filter(|row| row[column] > 0.0);
        let worst = rows.map(|row| row[column] / row[column + 1]).fold(0.0, f64::max);
        let name = format!("{name} in time, true error over the stated one, worst row");
        outcome.checks.push(Check::at_most(name, worst, 1.0));
    }
    outcome.data.push(data);
    Ok(())
}

/// True and stated errors of penetration and pressure, the stated ones with those of the fine steps and of a solver that ends at 10⁻⁸.
fn errors(step: &CreepStep, fine: &CreepStep) -> Result<[f64; 4], StudyError> {
    let (stated, rest) = step.error.zip(fine.error).ok_or("no error in time")?;
    let penetration = (step.contact.penetration() - fine.contact.penetration()).abs();
    let [one, two] = [step, fine].map(|step| step.contact.pressure().to_owned());
    let [change, samples] = [(&one - &two).mapv(f64::abs).sum(), one.len() as f64];
    // The stated error counts over the largest sum of pressures of the path.
    let allowed = [
        stated.penetration + rest.penetration + 1e-7 * fine.contact.penetration().abs(),
        stated.pressure + rest.pressure + 1e-6,
    ];
    Ok([penetration, allowed[0], change / (MEAN * samples), allowed[1]])
}
