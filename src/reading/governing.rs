//! What comes nearest to failure, and what else may within the errors.
//!
//! Of several utilisations u ± e the largest u governs; every other one with u′ + e′ ≥ u − e is its rival.

use super::strength::Utilisation;

/// What comes nearest to failure in a load step.
#[derive(Debug, Clone, PartialEq)]
pub struct Governing<'a> {
    /// The criterion of the largest utilisation.
    pub first: &'a Utilisation,
    /// The others that may govern within the errors, the one that may reach highest first.
    pub rivals: Vec<&'a Utilisation>,
}

impl<'a> Governing<'a> {
    /// Of all utilisations of a step; `None` without any.
    pub fn of(all: &'a [Utilisation]) -> Option<Self> {
        let first = all.iter().max_by(|a, b| a.value.total_cmp(&b.value))?;
        let mut rivals: Vec<&Utilisation> =
            all.iter().filter(|own| own.criterion != first.criterion && own.most() >= first.least()).collect();
        rivals.sort_by(|a, b| b.most().total_cmp(&a.most()));
        Some(Self { first, rivals })
    }

    /// Names of the rivals.
    pub fn rival_names(&self) -> Vec<String> {
        self.rivals.iter().map(|own| own.criterion.to_string()).collect()
    }

    /// In words, with numbers and their errors as `told` has them: "yield of material 2 takes up 0.93 ± 0.02, or cracking of
    /// material 1 within the errors".
    pub fn in_words(&self, told: impl Fn(f64, Option<f64>) -> String) -> String {
        let Utilisation { criterion, value, error, .. } = *self.first;
        let taken = if value.is_infinite() { "infinitely much".to_owned() } else { told(value, error) };
        format!("{criterion} takes up {taken}{}", within_the_errors(&self.rival_names()))
    }
}

/// Names of the criteria that the errors may bring before the first one, as the end of a sentence: ", or A or B within the
/// errors". An empty text without any.
pub fn within_the_errors(rivals: &[String]) -> String {
    if rivals.is_empty() { String::new() } else { format!(", or {} within the errors", rivals.join(" or ")) }
}

#[cfg(feature = "serde")]
impl serde::Serialize for Governing<'_> {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        use serde::ser::SerializeMap;
        let mut keys = serializer.serialize_map(None)?;
        self.first.criterion.entries(&mut keys)?;
        keys.serialize_entry("state", self.first.verdict().name())?;
        keys.serialize_entry("rivals", &self.rival_names())?;
        keys.end()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reading::Criterion;

    fn taken(criterion: Criterion, value: f64, error: Option<f64>) -> Utilisation {
        Utilisation { criterion, value, error, position: [0.0; 3], rival: None }
    }

    #[test]
    fn what_may_govern_within_the_errors_is_a_rival() {
        let [yields, cracks, parts] = [
            Criterion::Yield { material: 2 },
            Criterion::Cracking { material: 1 },
            Criterion::Delamination { interface: 1 },
        ];
        let told = |x: f64, error: Option<f64>| error.map_or(format!("{x}"), |error| format!("{x} ± {error}"));
        let words = |crack: f64, error: f64, part: f64| {
            let all = [taken(yields, 0.93, Some(0.02)), taken(cracks, crack, Some(error)), taken(parts, part, None)];
            Governing::of(&all).unwrap().in_words(told)
        };
        assert_eq!(words(0.5, 0.4, 0.9), "yield of material 2 takes up 0.93 ± 0.02");
        assert_eq!(
            words(0.5, 0.5, 0.9),
            "yield of material 2 takes up 0.93 ± 0.02, or cracking of material 1 within the errors"
        );
        // The error of the largest one makes rivals too.
        assert_eq!(
            words(1.0, 0.5, 0.9),
            "cracking of material 1 takes up 1 ± 0.5, or yield of material 2 or delamination of interface 1 within the errors"
        );
        assert!(Governing::of(&[]).is_none());
    }

    #[test]
    fn a_criterion_fails_or_holds_only_beyond_its_error() {
        let verdict =
            |value: f64, error: Option<f64>| taken(Criterion::Yield { material: 1 }, value, error).verdict().name();
        assert_eq!(verdict(1.2, Some(0.19)), "fails");
        assert_eq!(verdict(1.2, Some(0.21)), "undecided");
        assert_eq!(verdict(0.737, Some(3.4)), "undecided");
        assert_eq!(verdict(0.737, Some(0.2)), "holds");
        assert_eq!([0.999, 1.0].map(|value| verdict(value, None)), ["holds", "fails"]);
        assert_eq!(verdict(f64::INFINITY, None), "fails");
        assert_eq!(verdict(f64::NAN, None), "undecided");
    }
}
