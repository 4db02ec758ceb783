//! A periodic system of asperities on a half-space that relaxes below a thin stiff coat, which bends as a plate.

use super::setup::{HERTZ, RATIO, Slid, Slide, change, clear};
use super::statement::Statement;
use crate::moving::setup::{Stack, Stuff};
use crate::{Check, Data, Outcome, StudyError};

/// Periods over a₀: dense, and wide apart.
const PERIODS: [f64; 2] = [4.0, 12.0];
/// Samples per a₀ at either period, and in the quick form.
const SAMPLES: [f64; 2] = [96.0, 48.0];
const FEWER: [f64; 2] = [32.0, 16.0];
/// Exponent of the asperity, way and thickness over a₀: a case, and others that differ from it in one of them.
pub const CASES: [(&str, [f64; 3]); 4] =
    [("", [2.0, 0.1, 0.2]), ("shape", [4.0, 0.1, 0.2]), ("velocity", [2.0, 1.0, 0.2]), ("thickness", [2.0, 0.1, 0.4])];
const QUANTITIES: [&str; 3] = ["friction", "the peak", "τ₁ below the coat"];
/// A change is seen from so many of its errors on.
const SEEN: f64 = 3.0;

/// Friction, peak and τ₁ of a case, dense and wide apart.
type Pair = [[[f64; 2]; 3]; 2];

pub fn add(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let columns =
        ["exponent", "way", "thickness", "period", "friction", "error", "peak", "peak_error", "tau1", "tau1_error"];
    let mut data = Data::new("neighbours", &columns);
    let samples = if quick { FEWER } else { SAMPLES };
    let mut pairs = Vec::new();
    for (_, case) in CASES {
        let mut pair: Pair = Default::default();
        for ((period, samples), read) in PERIODS.into_iter().zip(samples).zip(&mut pair) {
            *read = asperity(case, [period, samples], quick)?;
            data.rows.push(case.into_iter().chain([period]).chain(read.iter().copied().flatten()).collect());
        }
        pairs.push(pair);
    }
    let quantities = if quick { 1 } else { 3 };
    // Dense over wide apart.
    let effect = |case: usize, quantity: usize| {
        let [change, error] = change(pairs[case][1][quantity], pairs[case][0][quantity]);
        [1.0 + change, error]
    };
    let mut mutual = Statement::new("shape, velocity and thickness of the coat determine the mutual effect");
    let mut all = Statement::new("shape, velocity and thickness of the coat determine friction, pressure and stresses");
    for (case, (name, _)) in CASES.iter().enumerate().skip(1) {
        for (quantity, what) in QUANTITIES.iter().enumerate().take(quantities) {
            let seen = clear(change(effect(0, quantity), effect(case, quantity)));
            let test = format!("{name}, change of the mutual effect on {what} over its error");
            mutual = mutual.says(Check::at_least(test, seen, SEEN));
            let seen = clear(change(pairs[0][0][quantity], pairs[case][0][quantity]));
            all = all.says(Check::at_least(format!("{name}, change of {what} over its error"), seen, SEEN));
        }
    }
    mutual.judge(outcome, quick);
    all.judge(outcome, quick);
    outcome.data.push(data);
    outcome.data.push(effects(quantities, effect));
    outcome.data.push(periods(quick)?);
    Ok(())
}

/// The mutual effects: each quantity of dense asperities over that of asperities wide apart.
fn effects(quantities: usize, effect: impl Fn(usize, usize) -> [f64; 2]) -> Data {
    let mut data = Data::new("mutual", &["case", "quantity", "dense_over_wide", "error"]);
    for case in 0..CASES.len() {
        for quantity in 0..quantities {
            let [ratio, error] = effect(case, quantity);
            data.rows.push(vec![case as f64, quantity as f64, ratio, error]);
        }
    }
    data
}

/// Friction over the period, for the figure.
fn periods(quick: bool) -> Result<Data, StudyError> {
    let mut data = Data::new("periods", &["case", "period", "friction", "error"]);
    let periods = if quick { &PERIODS[..] } else { &[3.0, 4.0, 6.0, 8.0, 12.0][..] };
    for (case, (_, parameters)) in CASES.iter().enumerate() {
        for &period in periods {
            let [friction, error] = slid(*parameters, [period, FEWER[1]])?.friction;
            data.rows.push(vec![case as f64, period, friction, error]);
        }
    }
    Ok(data)
}

fn asperity(case: [f64; 3], cell: [f64; 2], quick: bool) -> Result<[[f64; 2]; 3], StudyError> {
    let slid = slid(case, cell)?;
    Ok([slid.friction, slid.peak, if quick { [f64::NAN; 2] } else { slid.shear(1)? }])
}

/// The contact of a case with a period and samples per a₀.
fn slid([exponent, way, thickness]: [f64; 3], [period, samples]: [f64; 2]) -> Result<Slid, StudyError> {
    let coat = Stuff::elastic(100.0, 0.3);
    let body = Stack::coated(coat, thickness * HERTZ, Stuff::relaxing(1.0, 0.45, RATIO)).half_space()?;
    Slide { exponent, ..Slide::square(period, (period * samples) as usize, way) }.over(body)
}
