//! The first limit in words.

use super::{At, Limits, SearchEnd};
use crate::notation::number;
use crate::reading::{Criterion, within_the_errors};
use crate::run::StepRecord;
use std::fmt;

/// Relative error from which on it is given beside the first limit.
const RELEVANT_ERROR: f64 = 0.005;

impl Limits {
    /// The first limit in words, loads formatted by `load`.
    pub fn in_words(&self, load: impl Fn(f64) -> String) -> String {
        let (name, of) = (self.quantity.name(), |step: &StepRecord| step.reading.load(self.quantity));
        let others: Vec<String> = self.rivals().iter().map(Criterion::to_string).collect();
        let others = others.join(" or ");
        let most = self.steps.last().map_or(0.0, of);
        let end = SearchEnd::of(most, self.complete, self.hardness_load).in_words();
        let Some(limit) = self.first() else {
            if others.is_empty() {
                return format!("nothing fails up to the {name} {}{end}", load(most));
            }
            let from = self.contenders().iter().map(|limit| limit.interval()[0]).fold(f64::INFINITY, f64::min);
            let start = self.steps.first().map_or(0.0, of);
            let from = if from > 0.0 { load(from) } else { format!("below {}", load(start)) };
            let to = load(most);
            return format!("undecided: {others} may fail within its error at {name}s from {from} to {to}{end}");
        };
        // Above the largest load nothing is known.
        let up_to = match SearchEnd::of(most, self.complete, self.hardness_load) {
            SearchEnd::LargestLoad => format!(" up to {}", load(most)),
            SearchEnd::CompleteContact | SearchEnd::Hardness => String::new(),
        };
        let at = match limit.at {
            At::Rest => ", without load, by residual stress alone".to_owned(),
            At::Tip { .. } => ", under a tip however small the load".to_owned(),
            At::Below { load: at, .. } => format!(", at less than the {name} {}", load(at)),
            At::Load { load: at, interval: [from, to], .. } => {
                let part = limit.spread().unwrap_or(0.0);
                let error = match (from > 0.0, to.is_finite()) {
                    (true, true) if part <= RELEVANT_ERROR => String::new(),
                    (true, true) if limit.is_sharp() => format!(" ± {:.0} %", 100.0 * part),
                    (true, true) => format!(", between {} and {} by its error", load(from), load(to)),
                    (true, false) => format!(", not before {} and by its error perhaps never{up_to}", load(from)),
                    (false, true) => format!(", by its error anywhere below {}", load(to)),
                    (false, false) => ", by its error anywhere or never".to_owned(),
                };
                format!(" at the {name} {}{error}", load(at))
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
