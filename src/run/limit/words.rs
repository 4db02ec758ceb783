//! The first limit in words.

use super::limits::is_complete;
use super::{At, Limits};
use crate::notation::number;
use crate::reading::{Criterion, within_the_errors};
use std::fmt;

/// Relative error from which on it is given beside the first limit.
const RELEVANT_ERROR: f64 = 0.005;

impl Limits {
    /// The first limit in words, pressures formatted by `pressure`.
    pub fn in_words(&self, pressure: impl Fn(f64) -> String) -> String {
        let others: Vec<String> = self.rivals().iter().map(Criterion::to_string).collect();
        let others = others.join(" or ");
        let most = self.steps.last().map_or(0.0, |step| step.reading.mean_pressure);
        let complete = if is_complete(most, self.complete) { ", where contact is complete" } else { "" };
        let Some(limit) = self.first() else {
            if others.is_empty() {
                return format!("nothing fails up to the mean pressure {}{complete}", pressure(most));
            }
            let from = self.contenders().iter().map(|limit| limit.interval()[0]).fold(f64::INFINITY, f64::min);
            let start = self.steps.first().map_or(0.0, |step| step.reading.mean_pressure);
            let from = if from > 0.0 { pressure(from) } else { format!("below {}", pressure(start)) };
            let to = pressure(most);
            return format!(
                "undecided: {others} may fail within its error at mean pressures from {from} to {to}{complete}"
            );
        };
        let at = match limit.at {
            At::Rest => ", without load, by residual stress alone".to_owned(),
            At::Tip { .. } => ", under a tip however small the load".to_owned(),
            At::Below { mean_pressure, .. } => format!(", at less than the mean pressure {}", pressure(mean_pressure)),
            At::Load { mean_pressure, interval: [from, to], .. } => {
                let part = limit.spread().unwrap_or(0.0);
                let error = match (from > 0.0, to.is_finite()) {
                    (true, true) if part <= RELEVANT_ERROR => String::new(),
                    (true, true) if limit.is_sharp() => format!(" ± {:.0} %", 100.0 * part),
                    (true, true) => format!(", between {} and {} by its error", pressure(from), pressure(to)),
                    (true, false) => format!(", not before {} and by its error perhaps never", pressure(from)),
                    (false, true) => format!(", by its error anywhere below {}", pressure(to)),
                    (false, false) => ", by its error anywhere or never".to_owned(),
                };
                format!(" at the mean pressure {}{error}", pressure(mean_pressure))
            }
            At::Never { .. } | At::Undecided { .. } => String::new(),
        };
        format!("first: {}{at}{}", limit.criterion, within_the_errors(&self.rivals()))
    }
}

impl fmt::Display for Limits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.in_words(number))
    }
}
