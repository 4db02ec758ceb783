//! JSON forms of numbers and places in records, for the `with` attributes of serde.
//!
//! A number that is not finite is null in JSON. It is read back as infinite where the record is `singular`, elsewhere as not a
//! number. A key that follows from another one (`singular` from a value) is written beside it and not read.

use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// A number, null for none.
pub fn number<'de, D: Deserializer<'de>>(keys: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(keys)?.unwrap_or(f64::NAN))
}

/// A number, null for an infinite one.
pub fn infinite<'de, D: Deserializer<'de>>(keys: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(keys)?.unwrap_or(f64::INFINITY))
}

/// Three numbers, null for none.
pub fn numbers<'de, D: Deserializer<'de>>(keys: D) -> Result<[f64; 3], D::Error> {
    Ok(<[Option<f64>; 3]>::deserialize(keys)?.map(|number| number.unwrap_or(f64::NAN)))
}

/// x, y and z of a place.
#[derive(Serialize, Deserialize)]
struct Coordinates {
    #[serde(deserialize_with = "number")]
    x: f64,
    #[serde(deserialize_with = "number")]
    y: f64,
    #[serde(deserialize_with = "number")]
    z: f64,
}

impl From<[f64; 3]> for Coordinates {
    fn from([x, y, z]: [f64; 3]) -> Self {
        Self { x, y, z }
    }
}

impl From<Coordinates> for [f64; 3] {
    fn from(Coordinates { x, y, z }: Coordinates) -> Self {
        [x, y, z]
    }
}

/// A place under the keys `x`, `y` and `z`.
pub mod place {
    use super::*;

    pub fn serialize<S: Serializer>(place: &[f64; 3], keys: S) -> Result<S::Ok, S::Error> {
        Coordinates::from(*place).serialize(keys)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(keys: D) -> Result<[f64; 3], D::Error> {
        Coordinates::deserialize(keys).map(Into::into)
    }
}

/// A place, or null.
pub mod place_or_none {
    use super::*;

    pub fn serialize<S: Serializer>(place: &Option<[f64; 3]>, keys: S) -> Result<S::Ok, S::Error> {
        place.map(Coordinates::from).serialize(keys)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(keys: D) -> Result<Option<[f64; 3]>, D::Error> {
        Ok(Option::<Coordinates>::deserialize(keys)?.map(Into::into))
    }
}

/// Two numbers, or two nulls: two columns of a table, whether they are known or not.
pub mod pair {
    use super::*;

    pub fn serialize<S: Serializer>(pair: &Option<[f64; 2]>, keys: S) -> Result<S::Ok, S::Error> {
        pair.map_or([None; 2], |pair| pair.map(Some)).serialize(keys)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(keys: D) -> Result<Option<[f64; 2]>, D::Error> {
        let [x, y] = <[Option<f64>; 2]>::deserialize(keys)?;
        Ok(x.zip(y).map(|(x, y)| [x, y]))
    }
}

/// A module for a value under a key of its own that is null where it is infinite, with `singular` beside it.
macro_rules! singular {
    ($module:ident) => {
        /// The value, null where it is not finite, and whether it is infinite.
        pub mod $module {
            use super::*;

            #[derive(Serialize, Deserialize)]
            struct Keys {
                $module: Option<f64>,
                singular: bool,
            }

            pub fn serialize<S: Serializer>(value: &f64, keys: S) -> Result<S::Ok, S::Error> {
                let $module = Some(*value).filter(|value| value.is_finite());
                Keys { $module, singular: value.is_infinite() }.serialize(keys)
            }

            pub fn deserialize<'de, D: Deserializer<'de>>(keys: D) -> Result<f64, D::Error> {
                let Keys { $module, singular } = Keys::deserialize(keys)?;
                Ok($module.unwrap_or(if singular { f64::INFINITY } else { f64::NAN }))
            }
        }
    };
}

singular!(value);
singular!(utilisation);
singular!(max_pressure);
