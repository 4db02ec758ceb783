//! `interface` and `interface_strength` of a layer: kind and strengths of the interface below it.

use serde::Serialize;

use super::error::Refusal;
use super::keys::{Form, Key, Range, Unit};
use super::node::Value;
use super::reader::TableAt;
use super::section::{KeyValue, ReadTable, Words, section, words};
use super::value::ValueAt;
use percoat_core::body::{Interface, InterfaceStrength};

const SIZE: Form = Form::Number(Range::Size);

words! {
    /// A word that names an interface.
    pub enum InterfaceWord {
        /// No relative displacement.
        Bonded = "bonded",
        /// No shear, no opening.
        Frictionless = "frictionless",
    }
}

section! {
    /// An interface with stiffnesses; one that is absent is rigid.
    #[derive(Copy)]
    pub struct SpringSection = SPRING {
        /// stiffness of the interface against sliding
        pub tangential_stiffness: Option<f64> = Key::new(&[SIZE], "10.0")
            .unit(Unit::PressurePerLength)
            .otherwise("rigid")
            .rule("at least one of the two"),
        /// stiffness of the interface against opening and closing
        pub normal_stiffness: Option<f64> = Key::new(&[SIZE], "100.0")
            .unit(Unit::PressurePerLength)
            .otherwise("rigid")
            .rule("at least one of the two"),
    }
}

section! {
    /// Strengths of an interface; one that is absent is never reached.
    #[derive(Copy)]
    pub struct InterfaceStrengthSection = INTERFACE_STRENGTH {
        /// normal strength: the tension at failure without shear
        pub normal: Option<f64> = Key::new(&[SIZE], "0.5").unit(Unit::Pressure).otherwise("never reached"),
        /// shear strength: the shear stress at failure without tension
        pub shear: Option<f64> = Key::new(&[SIZE], "0.8").unit(Unit::Pressure).otherwise("never reached"),
        /// friction f of the interface: a pressure p on it adds f p to the shear strength
        pub friction: f64 = Key::new(&[Form::Number(Range::between(0.0, 100.0))], "0.3")
            .default("0")
            .omitted_as_nothing()
            .rule("only with `shear`"),
    }
}

/// The interface below a layer: a word or a table.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(untagged)]
pub enum InterfaceSection {
    /// Bonded or frictionless.
    Word(InterfaceWord),
    /// A spring.
    Spring(SpringSection),
}

impl InterfaceSection {
    pub(super) const WORDS: &'static [&'static str] = InterfaceWord::WORDS;

    pub(super) fn interface(self) -> Interface {
        match self {
            Self::Word(InterfaceWord::Bonded) => Interface::Bonded,
            Self::Word(InterfaceWord::Frictionless) => Interface::Frictionless,
            Self::Spring(SpringSection { tangential_stiffness, normal_stiffness }) => {
                let [tangential, normal] =
                    [tangential_stiffness, normal_stiffness].map(|stiffness| stiffness.unwrap_or(f64::INFINITY));
                Interface::Spring { tangential, normal }
            }
        }
    }
}

impl KeyValue for InterfaceSection {
    fn read(value: &ValueAt<'_>) -> Result<Self, Refusal> {
        match &value.node.value {
            Value::Text(_) => {
                InterfaceWord::read(value).map(Self::Word).map_err(|refusal| refusal.or_help(value.example()))
            }
            Value::Table(table) if !table.entries.is_empty() => spring(&value.table()?).map(Self::Spring),
            _ => Err(value.refuse_form().help("a spring needs one stiffness at least; the one left out is rigid")),
        }
    }
}

fn spring(section: &TableAt<'_>) -> Result<SpringSection, Refusal> {
    SpringSection::read_table(section).map_err(|refusal| match stiffness_advice(section) {
        Some(advice) => refusal.or_help(advice),
        None => refusal,
    })
}

const NO_SHEAR: &str = "for no tangential stiffness write interface = \"frictionless\"";
const NO_PRESSURE: &str =
    "without normal stiffness an interface carries no pressure; leave the key out where the faces do not approach";

/// Advice for the first stiffness that is 0 or infinite.
fn stiffness_advice(section: &TableAt<'_>) -> Option<&'static str> {
    [("tangential_stiffness", NO_SHEAR), ("normal_stiffness", NO_PRESSURE)].into_iter().find_map(|(key, without)| {
        match section.optional(key)?.node.value {
            Value::Integer(0) | Value::Float(0.0) => Some(without),
            Value::Float(stiffness) if stiffness.is_infinite() => {
                Some("leave the key out: an absent stiffness is rigid")
            }
            _ => None,
        }
    })
}

impl InterfaceStrengthSection {
    pub(super) fn strength(&self) -> InterfaceStrength {
        InterfaceStrength { normal: self.normal, shear: self.shear, friction: self.friction }
    }
}
