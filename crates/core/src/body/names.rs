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
        let known = kept.get(text).copied();
        Self(known.unwrap_or_else(|| {
            let leaked: &'static str = Box::leak(text.into());
            kept.insert(leaked);
            leaked
        }))
    }

    /// Text of the name.
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

/// One of two elastic bodies in contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Side {
    /// The body below, into which z is measured.
    Body,
    /// The counterbody above, into which its own z is measured; x and y are those of the body.
    Counterbody,
}

impl fmt::Display for Side {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Body => "body",
            Self::Counterbody => "counterbody",
        })
    }
}

impl Side {
    /// Words behind what belongs to the counterbody: " of the counterbody"; none for what belongs to the body.
    fn behind(side: Option<Self>) -> &'static str {
        if side == Some(Self::Counterbody) { " of the counterbody" } else { "" }
    }
}

macro_rules! numbered {
    ($(#[$doc:meta])* $id:ident, $what:literal, $number:literal) => {
        $(#[$doc])*
        ///
        /// Prints itself as its name, or without one as its number. Equal numbers of one body are equal and in order,
        /// whatever the names: a name says what stands there, and may differ between two cases. Those of the
        /// counterbody follow those of the body.
        #[derive(Debug, Clone, Copy, Serialize, Deserialize)]
        pub struct $id {
            /// The body it belongs to; `None` where the counterbody is rigid.
            #[serde(default, rename = "body", skip_serializing_if = "Option::is_none")]
            pub side: Option<Side>,
            #[doc = $number]
            #[serde(rename = $what)]
            pub number: usize,
            /// Name of the material or interface; `None` where it has none.
            #[serde(default, skip_serializing_if = "Option::is_none")]
            pub name: Option<Name>,
        }

        impl $id {
            /// Material or interface of this number, from 1, without a name.
            pub const fn numbered(number: usize) -> Self {
                Self { side: None, number, name: None }
            }

            /// The number without the name.
            #[must_use]
            pub const fn without_name(self) -> Self {
                Self { name: None, ..self }
            }

            /// Whether it belongs to an elastic counterbody.
            pub fn is_counterbody(self) -> bool {
                self.side == Some(Side::Counterbody)
            }

            /// Number with the body it belongs to, as files have it.
            pub fn code(self) -> String {
                format!("{} {}{}", $what, self.number, Side::behind(self.side))
            }

            /// Reads its [code](Self::code).
            pub fn of_code(code: &str) -> Option<Self> {
                let (side, rest) = match code.strip_suffix(Side::behind(Some(Side::Counterbody))) {
                    Some(rest) => (Some(Side::Counterbody), rest),
                    None => (None, code),
                };
                let number = rest.strip_prefix($what)?.strip_prefix(' ')?.parse().ok()?;
                Some(Self { side, number, name: None })
            }

            fn place(self) -> (bool, usize) {
                (self.is_counterbody(), self.number)
            }
        }

        impl fmt::Display for $id {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                match self.name {
                    Some(name) => write!(f, "{name}{}", Side::behind(self.side)),
                    None => f.write_str(&self.code()),
                }
            }
        }

        impl PartialEq for $id {
            fn eq(&self, other: &Self) -> bool {
                self.place() == other.place()
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
                self.place().cmp(&other.place())
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
        // The body stands behind the whole.
        let [above, below] = [upper, lower].map(|id| MaterialId { side: None, ..id });
        let name = has_name.then(|| Name::new(&format!("{above}/{below}")));
        Self { side: upper.side, number: upper.number, name }
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
        let named = MaterialId { side: Some(Side::Body), number: 2, name: Some(Name::new("TiN")) };
        assert!(named == MaterialId::numbered(2) && named < MaterialId::numbered(3));
        let other = MaterialId { side: Some(Side::Counterbody), ..named };
        assert!(other != named && other > MaterialId::numbered(3));
        assert_eq!(other.to_string(), "TiN of the counterbody");
        assert_eq!(other.code(), "material 2 of the counterbody");
        assert_eq!(MaterialId::of_code(&other.code()), Some(other));
        assert_eq!(MaterialId::of_code("material 2"), Some(named));
    }

    #[test]
    fn an_interface_is_named_by_the_materials_beside_it() {
        let material = |number, name: Option<&str>| MaterialId { side: None, number, name: name.map(Name::new) };
        let between = |upper, lower| InterfaceId::between(material(1, upper), material(2, lower)).to_string();
        assert_eq!(between(Some("TiN"), Some("steel")), "TiN/steel");
        assert_eq!(between(Some("TiN"), None), "TiN/material 2");
        assert_eq!(between(None, None), "interface 1");
    }
}
