//! Names and numbers of materials and interfaces.

use serde::{Deserialize, Serialize};
use std::cmp::Ordering;
use std::collections::BTreeSet;
use std::fmt;
use std::sync::{Mutex, PoisonError};

/// Name of a material, as "TiN", or of an interface, as "TiN/steel". A copy costs nothing: each different text is kept once,
/// until the program ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(transparent)]
pub struct Name(&'static str);

impl Name {
    /// The name with this text.
    pub fn new(text: &str) -> Self {
        static KEPT: Mutex<BTreeSet<&'static str>> = Mutex::new(BTreeSet::new());
        let mut kept = KEPT.lock().unwrap_or_else(PoisonError::into_inner);
        let own = kept.get(text).copied();
        Self(own.unwrap_or_else(|| {
            let own: &'static str = Box::leak(text.into());
            kept.insert(own);
            own
        }))
    }

    /// Its text.
    pub fn text(self) -> &'static str {
        self.0
    }
}

impl fmt::Display for Name {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0)
    }
}

impl<'de> serde::Deserialize<'de> for Name {
    fn deserialize<D: serde::Deserializer<'de>>(text: D) -> Result<Self, D::Error> {
        String::deserialize(text).map(|text| Self::new(&text))
    }
}

macro_rules! numbered {
    ($(#[$doc:meta])* $id:ident, $what:literal, $number:literal) => {
        $(#[$doc])*
        ///
        /// It prints itself as its name, or without one as its number. Equal numbers are equal and in order, whatever the names: a
        /// name says what stands there, and may differ between two cases.
        #[derive(Debug, Clone, Copy, Serialize, Deserialize)]
        pub struct $id {
            #[doc = $number]
            #[serde(rename = $what)]
            pub number: usize,
            /// Its name; `None` where it has none.
            #[serde(default, skip_serializing_if = "Option::is_none")]
            pub name: Option<Name>,
        }

        impl $id {
            /// The one with this number, from 1, without a name.
            pub const fn numbered(number: usize) -> Self {
                Self { number, name: None }
            }
        }

        impl fmt::Display for $id {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                match self.name {
                    Some(name) => name.fmt(f),
                    None => write!(f, "{} {}", $what, self.number),
                }
            }
        }

        impl PartialEq for $id {
            fn eq(&self, other: &Self) -> bool {
                self.number == other.number
            }
        }

        impl Eq for $id {}

        impl PartialOrd for $id {
            fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
                Some(self.cmp(other))
            }
        }

        impl Ord for $id {
            fn cmp(&self, other: &Self) -> Ordering {
                self.number.cmp(&other.number)
            }
        }
    };
}

numbered! {
    /// Number of a material of the body, and its name where the user gave it one.
    MaterialId, "material", "Number, from 1 at the surface down; the substrate is layers + 1."
}
numbered! {
    /// Number of an interface of the body, and its name where a material beside it has one.
    InterfaceId, "interface", "Number, from 1: the lower face of that layer."
}

impl InterfaceId {
    /// The interface between a material and the one below it: "TiN/steel" where either has a name.
    pub fn between(upper: MaterialId, lower: MaterialId) -> Self {
        let has_name = upper.name.is_some() || lower.name.is_some();
        Self { number: upper.number, name: has_name.then(|| Name::new(&format!("{upper}/{lower}"))) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_is_kept_once() {
        let [first, second] = [Name::new("TiN"), Name::new(&["Ti", "N"].concat())];
        assert!(std::ptr::eq(first.text(), second.text()));
        assert!(Name::new("DLC") != first);
    }

    #[test]
    fn materials_are_equal_by_number() {
        let named = MaterialId { number: 2, name: Some(Name::new("TiN")) };
        assert!(named == MaterialId::numbered(2) && named < MaterialId::numbered(3));
    }

    #[test]
    fn an_interface_is_named_by_the_materials_beside_it() {
        let material = |number, name: Option<&str>| MaterialId { number, name: name.map(Name::new) };
        let between = |upper, lower| InterfaceId::between(material(1, upper), material(2, lower)).to_string();
        assert_eq!(between(Some("TiN"), Some("steel")), "TiN/steel");
        assert_eq!(between(Some("TiN"), None), "TiN/material 2");
        assert_eq!(between(None, None), "interface 1");
    }
}
