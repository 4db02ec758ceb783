//! The governing criterion of a load step, and its rivals within the errors.
//!
//! The largest u of several utilisations u ± e governs; every other one with u′ + e′ ≥ u − e is its rival.

use super::strength::{Criterion, Utilisation};
use super::verdict::Verdict;
use serde::{Deserialize, Serialize};

/// The criterion nearest to failure in a load step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Governing {
    /// The criterion of the largest utilisation.
    #[serde(flatten)]
    pub criterion: Criterion,
    /// Whether that criterion fails.
    #[serde(rename = "state")]
    pub verdict: Verdict,
    /// The others that may govern within the errors, the one that may reach highest first.
    #[serde(with = "names")]
    pub rivals: Vec<Criterion>,
}

impl Governing {
    /// The governing criterion of all utilisations of a step; `None` without any.
    pub fn of(all: &[Utilisation]) -> Option<Self> {
        let first = all.iter().max_by(|a, b| a.value.total_cmp(&b.value))?;
        let mut rivals: Vec<&Utilisation> = all
            .iter()
            .filter(|utilisation| utilisation.criterion != first.criterion && utilisation.most() >= first.least())
            .collect();
        rivals.sort_by(|a, b| b.most().total_cmp(&a.most()));
        let rivals = rivals.into_iter().map(|rival| rival.criterion).collect();
        Some(Self { criterion: first.criterion, verdict: first.verdict, rivals })
    }
}

/// The criteria that the errors may bring before the first one, as the end of a sentence: ", or A or B within the
/// errors". An empty text without any.
pub fn within_the_errors(rivals: &[Criterion]) -> String {
    let names: Vec<String> = rivals.iter().map(Criterion::to_string).collect();
    if names.is_empty() { String::new() } else { format!(", or {} within the errors", names.join(" or ")) }
}

/// Criteria by their codes, with the name of a material or an interface behind in parentheses: "yield of material 2 (TiN)".
pub mod names {
    use crate::reading::Criterion;
    use serde::de::Error;
    use serde::{Deserialize, Deserializer, Serializer};

    /// Writes the names of criteria.
    pub fn serialize<S: Serializer>(criteria: &[Criterion], names: S) -> Result<S::Ok, S::Error> {
        names.collect_seq(criteria.iter().map(|criterion| criterion.code_with_name()))
    }

    /// Reads the names of criteria.
    pub fn deserialize<'de, D: Deserializer<'de>>(names: D) -> Result<Vec<Criterion>, D::Error> {
        let names = Vec::<String>::deserialize(names)?;
        names.iter().map(|name| name.parse().map_err(D::Error::custom)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn taken(criterion: Criterion, value: f64, error: Option<f64>) -> Utilisation {
        Utilisation::new(criterion, value, error, [0.0; 3])
    }

    #[test]
    fn what_may_govern_within_the_errors_is_a_rival() {
        let [yields, cracks, parts] =
            [Criterion::yield_of(2), Criterion::cracking_of(1), Criterion::delamination_of(1)];
        let words = |crack: f64, error: f64, part: f64| {
            let all = [taken(yields, 0.93, Some(0.02)), taken(cracks, crack, Some(error)), taken(parts, part, None)];
            let Governing { criterion, rivals, .. } = Governing::of(&all).unwrap();
            format!("{criterion}{}", within_the_errors(&rivals))
        };
        assert_eq!(words(0.5, 0.4, 0.9), "yield of material 2");
        assert_eq!(words(0.5, 0.5, 0.9), "yield of material 2, or cracking of material 1 within the errors");
        // The error of the largest one makes rivals too.
        assert_eq!(
            words(1.0, 0.5, 0.9),
            "cracking of material 1, or yield of material 2 or delamination of interface 1 within the errors"
        );
        assert!(Governing::of(&[]).is_none());
    }

    #[test]
    fn a_criterion_fails_or_holds_only_beyond_its_error() {
        let verdict = |value: f64, error: Option<f64>| taken(Criterion::yield_of(1), value, error).verdict.name();
        assert_eq!(verdict(1.2, Some(0.19)), "fails");
        assert_eq!(verdict(1.2, Some(0.21)), "undecided");
        assert_eq!(verdict(0.737, Some(3.4)), "undecided");
        assert_eq!(verdict(0.737, Some(0.2)), "holds");
        assert_eq!([0.999, 1.0].map(|value| verdict(value, None)), ["holds", "fails"]);
        assert_eq!(verdict(f64::INFINITY, None), "fails");
        assert_eq!(verdict(f64::NAN, None), "undecided");
    }
}
