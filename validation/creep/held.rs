//! Growing contacts on a body of one material at constant ν (Lee & Radok 1960).
//!
//! While the contact grows, ∫J(t − t′) dp(t′) is the pressure of the elastic contact of the modulus 1 under ∫J dp̄: penetration and area are those of
//! that contact. Steps in time are exact, however long, where the load is linear within each.

use super::compliance::Compliance;
use super::setup::{POISSON, SURFACES, Stuff, advanced, in_contact, in_time, solved, surface};
use crate::{Check, Data, Evidence, Outcome, StudyError, Tolerance};
use percoat_core::load::Load;
use percoat_core::problem::Problem;
use std::f64::consts::PI;

/// Series of one, two and three terms, whose relaxed modulus is 1.
pub const SERIES: [&[[f64; 2]]; 3] =
    [&[[3.0, 1.0]], &[[2.7, 1.0], [6.3, 0.1]], &[[0.5, 30.0], [4.0, 1.0], [20.0, 0.01]]];
/// Samples of each surface, and mean pressures.
const CASES: [([usize; 2], f64); 4] = [([64, 64], 0.02), ([60, 60], 0.03), ([128, 128], 0.02), ([45, 36], 0.01)];
const END: f64 = 20.0;
/// Steps of a series of one term, and of others: what a step would press in beyond p = 0 ends it with another pressure, where many times are
/// shorter than the step.
const STEPS: [&[usize]; 2] = [&[1, 5, 40], &[40]];
/// Times at which steps that are divided are compared, and their tolerances.
const TIMES: [f64; 6] = [0.0, 0.03, 0.3, 2.0, 8.0, 50.0];
const TOLERANCES: [f64; 2] = [1e-2, 1e-3];
/// Σ′R⁻¹ and Σ′R⁻³ of the square lattice.
const LATTICE: [f64; 2] = [-3.900_264_920_001_956, 9.033_621_683_100_95];

pub fn add(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let columns = ["surface", "terms", "rises", "steps", "time", "penetration", "elastic", "touching", "displacement"];
    let mut data = Data::new("held", &columns);
    let (surfaces, series) = (if quick { &[0, 3][..] } else { &[0, 1, 2, 3] }, if quick { 2..3 } else { 0..3 });
    for &number in surfaces {
        for terms in series.clone() {
            for rises in [false, true] {
                for &steps in STEPS[terms.min(1)] {
                    data.rows.extend(path(number, terms, rises, steps)?);
                }
            }
        }
    }
    for (number, name) in SURFACES.into_iter().enumerate().filter(|(number, _)| surfaces.contains(number)) {
        let rows = || data.rows.iter().filter(move |row| row[0] == number as f64);
        let mut add = |what: &str, pairs: Vec<(f64, f64)>, tolerance| {
            let check = Check::worst(format!("{name}, {what}"), pairs, tolerance);
            outcome.checks.push(Check { evidence: Evidence::Refinement, ..check });
        };
        add(
            "penetration of a growing contact",
            rows().map(|row| (row[5], row[6])).collect(),
            Tolerance::Relative(1e-7),
        );
        add("samples in contact, more or fewer", rows().map(|row| (row[7], 0.0)).collect(), Tolerance::Absolute(2.0));
        add(
            "displacement, difference over the penetration",
            rows().map(|row| (row[8], 0.0)).collect(),
            Tolerance::Absolute(1e-6),
        );
    }
    outcome.data.push(data);
    divided(outcome, quick)?;
    light(outcome, quick)
}

/// A load that is held from the beginning, or rises for half of the time: rows at five times at most.
fn path(number: usize, terms: usize, rises: bool, steps: usize) -> Result<Vec<Vec<f64>>, StudyError> {
    let (points, mean) = CASES[number];
    let (compliance, material) = (Compliance::new(1.0, SERIES[terms]), Stuff::simple(SERIES[terms]));
    let problem = Problem::new(surface(number)?, material.half_space()?);
    let mut creeps = in_time(&problem, points, f64::INFINITY)?;
    let load = |time: f64| if rises { mean * (2.0 * time / END).min(1.0) } else { mean };
    let mut rows = Vec::new();
    // Two steps at least where the load has a corner.
    let steps = if rises { 2 * steps } else { steps };
    for n in 0..=steps {
        let time = END * n as f64 / steps as f64;
        let step = advanced(&mut creeps, time, Load::MeanPressure(load(time)))?.contact;
        if n % steps.div_ceil(5) != 0 || load(time) == 0.0 {
            continue;
        }
        // ∫J dp̄, over which the elastic contact of the modulus 1 is solved by one of that mean pressure.
        let eased = |time: f64| compliance.of_rise(time.max(0.0)) * 2.0 * mean / END;
        let whole = if rises { eased(time) - eased(time - 0.5 * END) } else { mean * compliance.after(time) };
        let elastic = Stuff::elastic(load(time) / whole, POISSON).half_space()?;
        let exact = solved(Problem::new(surface(number)?, elastic), points, Load::MeanPressure(load(time)))?;
        let touching = in_contact(&step).abs_diff(in_contact(&exact)) as f64;
        let moved = (&step.displacement() - &exact.displacement()).iter().fold(0.0f64, |most, w| most.max(w.abs()));
        let known = [step.penetration(), exact.penetration(), touching, moved / exact.penetration()];
        let row = [number as f64, terms as f64, f64::from(u8::from(rises)), steps as f64, time];
        rows.push([&row[..], &known].concat());
    }
    Ok(rows)
}

/// A held load in steps that are divided by their errors: true errors, against the elastic contacts of J(t), over the stated ones.
fn divided(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let mut data = Data::new("divided", &["surface", "terms", "tolerance", "time", "penetration", "elastic", "stated"]);
    let surfaces = if quick { &[0][..] } else { &[0, 1, 2, 3] };
    for (&number, terms) in surfaces.iter().flat_map(|number| (0..SERIES.len()).map(move |terms| (number, terms))) {
        let (points, mean) = CASES[number];
        let (compliance, material) = (Compliance::new(1.0, SERIES[terms]), Stuff::simple(SERIES[terms]));
        let load = Load::MeanPressure(mean);
        for tolerance in TOLERANCES {
            let mut creeps = in_time(&Problem::new(surface(number)?, material.half_space()?), points, tolerance)?;
            for time in TIMES {
                let step = advanced(&mut creeps, time, load)?;
                let elastic = Stuff::elastic(1.0 / compliance.after(time), POISSON).half_space()?;
                let exact = solved(Problem::new(surface(number)?, elastic), points, load)?.penetration();
                let stated = step.error.map_or(f64::NAN, |error| error.penetration);
                data.rows.push(vec![
                    number as f64,
                    terms as f64,
                    tolerance,
                    time,
                    step.contact.penetration(),
                    exact,
                    stated,
                ]);
            }
        }
    }
    let parts = data.rows.iter().map(|row| ((row[4] - row[5]).abs() / (row[6] + 1e-7 * row[5]), 1.0));
    let name = "growing contact in divided steps, true error over the stated one";
    outcome.checks.push(Check::worst(name, parts, Tolerance::AtMost));
    outcome.data.push(data);
    Ok(())
}

/// Contacts that are small in their cell: δ = a²/R + (4a³/3πR)(S₁/L + S₃·4a²/(5·4L³)), a³ = 3(1 − ν)FRJ(t)/8 less what images make steeper.
fn light(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let points = if quick { 256 } else { 768 };
    let mut pairs = Vec::new();
    let mut data = Data::new("light", &["time", "penetration", "hertz"]);
    let (compliance, material) = (Compliance::new(1.0, SERIES[1]), Stuff::simple(SERIES[1]));
    let problem = Problem::new(surface(0)?, material.half_space()?);
    let mut creeps = in_time(&problem, [points; 2], f64::INFINITY)?;
    let mean = 8.0 * 0.06f64.powi(3) / (3.0 * (1.0 - POISSON));
    for time in [0.0, 0.1, 1.0, 5.0, 50.0] {
        let found = advanced(&mut creeps, time, Load::MeanPressure(mean))?.contact.penetration();
        let cube = 3.0 * (1.0 - POISSON) * mean * compliance.after(time) / 8.0;
        let plain = cube.cbrt();
        let steeper = 2.0 * LATTICE[1] / (3.0 * PI) * plain.powi(3);
        let a = plain * (1.0 - steeper / 3.0);
        let images = 4.0 * cube / (3.0 * PI) * (LATTICE[0] + 0.25 * LATTICE[1] * 0.4 * a * a);
        let known = a * a * (1.0 + steeper) + images;
        let allowed = 0.1 * (a * points as f64).powf(-1.5) + 3.0 * plain.powi(5);
        data.rows.push(vec![time, found, known]);
        pairs.push(((found / known - 1.0) / allowed, 0.0));
    }
    let name = "small contact, penetration by Hertz and J(t), over what a grid and images make";
    outcome.checks.push(Check::worst(name, pairs, Tolerance::Absolute(1.0)));
    outcome.data.push(data);
    Ok(())
}
