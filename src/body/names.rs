//! Names and numbers of materials and interfaces.

use std::collections::BTreeSet;
use std::fmt;
use std::sync::{Mutex, PoisonError};

/// Name of a material, as "TiN", or of an interface, as "TiN/steel". A copy costs nothing: each different text is kept once,
/// until the program ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(transparent))]
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

#[cfg(feature = "serde")]
impl<'de> serde::Deserialize<'de> for Name {
    fn deserialize<D: serde::Deserializer<'de>>(text: D) -> Result<Self, D::Error> {
        String::deserialize(text).map(|text| Self::new(&text))
    }
}

/// A material of the body: its number from the surface down, and its name where it has one. It prints itself as its name, or as
/// "material 2".
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MaterialId {
    /// Number, from 1; the substrate is layers + 1.
    #[cfg_attr(feature = "serde", serde(rename = "material"))]
    pub number: usize,
    /// Name that the user gave it.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub name: Option<Name>,
}

/// An interface of the body: its number from the surface down, and its name where a material beside it has one. It prints itself
/// as its name, or as "interface 1".
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct InterfaceId {
    /// Number, from 1: the lower face of that layer.
    #[cfg_attr(feature = "serde", serde(rename = "interface"))]
    pub number: usize,
    /// Its name by the materials: "TiN/steel".
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub name: Option<Name>,
}

impl MaterialId {
    /// The material with this number, from 1, without a name.
    pub const fn numbered(number: usize) -> Self {
        Self { number, name: None }
    }
}

impl InterfaceId {
    /// The interface with this number, from 1, without a name.
    pub const fn numbered(number: usize) -> Self {
        Self { number, name: None }
    }

    /// The interface between a material and the one below it: "TiN/steel" where either has a name.
    pub fn between(upper: MaterialId, lower: MaterialId) -> Self {
        let has_name = upper.name.is_some() || lower.name.is_some();
        Self { number: upper.number, name: has_name.then(|| Name::new(&format!("{upper}/{lower}"))) }
    }
}

impl fmt::Display for MaterialId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.name {
            Some(name) => name.fmt(f),
            None => write!(f, "material {}", self.number),
        }
    }
}

impl fmt::Display for InterfaceId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.name {
            Some(name) => name.fmt(f),
            None => write!(f, "interface {}", self.number),
        }
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
    fn an_interface_is_named_by_the_materials_beside_it() {
        let material = |number, name: Option<&str>| MaterialId { number, name: name.map(Name::new) };
        let between = |upper, lower| InterfaceId::between(material(1, upper), material(2, lower)).to_string();
        assert_eq!(between(Some("TiN"), Some("steel")), "TiN/steel");
        assert_eq!(between(Some("TiN"), None), "TiN/material 2");
        assert_eq!(between(None, None), "interface 1");
    }
}
