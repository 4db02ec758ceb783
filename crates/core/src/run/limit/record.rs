//! The record of a limit: every limit has the keys of a load, null where it does not have the value, and a code of how it is
//! reached.

use super::limits::{At, Limit, SearchEnd};
use crate::load::LoadQuantity;
use crate::reading::Criterion;
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// How a limit is reached.
#[derive(Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Reached {
    #[serde(alias = "by residual stress alone")]
    ResidualStressAlone,
    #[serde(alias = "under a tip however small the load")]
    TipAtAnyLoad,
    #[serde(alias = "under load")]
    UnderLoad,
    #[serde(alias = "by a contact of a few samples")]
    ContactOfFewSamples,
    #[serde(alias = "not up to complete contact")]
    NotUpToCompleteContact,
    NotUpToHardness,
    #[serde(alias = "not up to the largest load")]
    NotUpToLargestLoad,
    Undecided,
}

/// The keys of a limit.
#[derive(Clone, Serialize, Deserialize)]
struct Keys {
    #[serde(flatten)]
    criterion: Criterion,
    mean_pressure: Option<f64>,
    /// Load of a limit in force, whose mean pressure is null.
    #[serde(default, deserialize_with = "present", skip_serializing_if = "Option::is_none")]
    force: Option<Option<f64>>,
    error: Option<f64>,
    /// An end that is null is infinite.
    interval: Option<[Option<f64>; 2]>,
    x: Option<f64>,
    y: Option<f64>,
    z: Option<f64>,
    reached: Reached,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    below: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    up_to: Option<f64>,
    /// Null where it is infinite, as the error where it is not known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    utilisation: Option<Option<f64>>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    utilisation_error: Option<Option<f64>>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    utilisation_at: Option<f64>,
}

/// The value of a key that is there, null as `None`.
fn present<'de, D: Deserializer<'de>>(value: D) -> Result<Option<Option<f64>>, D::Error> {
    Option::deserialize(value).map(Some)
}

impl Serialize for Limit {
    fn serialize<S: Serializer>(&self, keys: S) -> Result<S::Ok, S::Error> {
        Keys::from(*self).serialize(keys)
    }
}

impl<'de> Deserialize<'de> for Limit {
    fn deserialize<D: Deserializer<'de>>(keys: D) -> Result<Self, D::Error> {
        Self::try_from(Keys::deserialize(keys)?).map_err(D::Error::custom)
    }
}

impl From<Limit> for Keys {
    fn from(limit: Limit) -> Self {
        let finite = |x: f64| Some(x).filter(|x| x.is_finite());
        let [x, y, z] = limit.position().map_or([None; 3], |position| position.map(Some));
        let interval = Some(limit.interval().map(finite));
        let keys = Self {
            criterion: limit.criterion,
            mean_pressure: None,
            force: (limit.quantity == LoadQuantity::Force).then_some(None),
            error: None,
            interval,
            x,
            y,
            z,
            reached: Reached::Undecided,
            below: None,
            up_to: None,
            utilisation: None,
            utilisation_error: None,
            utilisation_at: None,
        };
        let with_load = |load: f64| match limit.quantity {
            LoadQuantity::MeanPressure => Self { mean_pressure: Some(load), ..keys.clone() },
            LoadQuantity::Force => Self { force: Some(Some(load)), ..keys.clone() },
        };
        let no_load = |reached| Self { error: Some(0.0), reached, ..with_load(0.0) };
        match limit.at {
            At::Rest => no_load(Reached::ResidualStressAlone),
            At::Tip { .. } => no_load(Reached::TipAtAnyLoad),
            At::Load { load, error, .. } => Self { error, reached: Reached::UnderLoad, ..with_load(load) },
            At::Below { load, utilisation, .. } => Self {
                reached: Reached::ContactOfFewSamples,
                below: Some(load),
                utilisation: Some(finite(utilisation)),
                ..keys
            },
            At::Never { up_to, end, utilisation, error, at } => Self {
                interval: None,
                reached: match end {
                    SearchEnd::CompleteContact => Reached::NotUpToCompleteContact,
                    SearchEnd::Hardness => Reached::NotUpToHardness,
                    SearchEnd::LargestLoad => Reached::NotUpToLargestLoad,
                },
                up_to: Some(up_to),
                utilisation: Some(Some(utilisation)),
                utilisation_error: Some(error),
                utilisation_at: Some(at),
                ..keys
            },
            At::Undecided { up_to, utilisation, error, at, .. } => Self {
                up_to: Some(up_to),
                utilisation: Some(Some(utilisation)),
                utilisation_error: Some(error),
                utilisation_at: Some(at),
                ..keys
            },
        }
    }
}

impl TryFrom<Keys> for Limit {
    type Error = String;

    fn try_from(keys: Keys) -> Result<Self, String> {
        let criterion = keys.criterion;
        let quantity = keys.force.map_or(LoadQuantity::MeanPressure, |_| LoadQuantity::Force);
        let at = keys.at().ok_or_else(|| format!("the limit of {criterion} lacks a number, or one is below zero"))?;
        Ok(Self { criterion, quantity, at })
    }
}

impl Keys {
    fn at(&self) -> Option<At> {
        let load = self.force.map_or(self.mean_pressure, |force| force);
        let sizes = [load, self.error, self.below, self.up_to, self.utilisation_at];
        if sizes.into_iter().flatten().any(|size| size < 0.0) {
            return None;
        }
        let position = || Some([self.x?, self.y?, self.z?]);
        let interval = || Some(self.interval?.map(|end| end.unwrap_or(f64::INFINITY)));
        let (utilisation, error) = (self.utilisation.flatten(), self.utilisation_error.flatten());
        let never = |end| {
            Some(At::Never { up_to: self.up_to?, end, utilisation: utilisation?, error, at: self.utilisation_at? })
        };
        Some(match self.reached {
            Reached::ResidualStressAlone => At::Rest,
            Reached::TipAtAnyLoad => At::Tip { position: position()? },
            Reached::UnderLoad => {
                At::Load { load: load?, error: self.error, interval: interval()?, position: position()? }
            }
            Reached::ContactOfFewSamples => {
                let utilisation = utilisation.unwrap_or(f64::INFINITY);
                At::Below { load: self.below?, utilisation, position: position()? }
            }
            Reached::NotUpToCompleteContact => never(SearchEnd::CompleteContact)?,
            Reached::NotUpToHardness => never(SearchEnd::Hardness)?,
            Reached::NotUpToLargestLoad => never(SearchEnd::LargestLoad)?,
            Reached::Undecided => {
                let [from, _] = interval()?;
                let (up_to, utilisation, at) = (self.up_to?, utilisation?, self.utilisation_at?);
                At::Undecided { from, up_to, utilisation, error, at, position: position()? }
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every way in which a limit is reached comes back from JSON as it was.
    #[test]
    fn every_limit_is_read_back_as_it_was_written() {
        let (position, error) = ([0.1, -0.2, 0.3], Some(0.01));
        let all = [
            At::Rest,
            At::Tip { position },
            At::Load { load: 0.2, error: None, interval: [0.0, f64::INFINITY], position },
            At::Load { load: 0.2, error, interval: [0.19, 0.21], position },
            At::Below { load: 0.1, utilisation: f64::INFINITY, position },
            At::Never { up_to: 1.0, end: SearchEnd::CompleteContact, utilisation: 0.5, error, at: 0.7 },
            At::Never { up_to: 1.0, end: SearchEnd::Hardness, utilisation: 0.5, error, at: 0.7 },
            At::Never { up_to: 1.0, end: SearchEnd::LargestLoad, utilisation: 0.5, error: None, at: 0.7 },
            At::Undecided { from: 0.0, up_to: 1.0, utilisation: 0.5, error, at: 0.7, position },
        ];
        let quantities = [LoadQuantity::MeanPressure, LoadQuantity::Force];
        for (at, quantity) in all.into_iter().flat_map(|at| quantities.map(|quantity| (at, quantity))) {
            let limit = Limit { criterion: Criterion::delamination_of(1), quantity, at };
            let text = serde_json::to_string(&limit).unwrap();
            assert_eq!(serde_json::from_str::<Limit>(&text).unwrap(), limit, "{text}");
            // A key that a limit has is written where it is null, too.
            let keys = |key: &str| text.contains(&format!("\"{key}\":"));
            let is_far = matches!(at, At::Never { .. } | At::Undecided { .. });
            assert_eq!(keys("utilisation_error"), is_far, "{text}");
            let is_hard = matches!(at, At::Never { end: SearchEnd::Hardness, .. });
            assert_eq!(text.contains(r#""reached":"not_up_to_hardness""#), is_hard, "{text}");
            assert_eq!(keys("utilisation"), is_far || matches!(at, At::Below { .. }), "{text}");
        }
        let unknown = r#"{"criterion":"yield","material":1,"mean_pressure":null,"error":null,"interval":null,"x":null,"y":null,"z":null,"reached":"x"}"#;
        assert!(serde_json::from_str::<Limit>(unknown).unwrap_err().to_string().contains("unknown variant `x`"));
    }
}
