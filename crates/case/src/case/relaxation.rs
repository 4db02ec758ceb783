//! `relaxation` of a material: shear moduli that relax beside its own.

use super::error::Refusal;
use super::keys::{Form, Key, Range, Unit};
use super::reader::TableAt;
use super::section::{Words, section, words};
use percoat_core::body::{ConstantModulus, Relaxation, RelaxationError};

const SIZE: Form = Form::Number(Range::Size);
/// Most terms of a series.
const TERMS: usize = 64;
const SIZES: Form = Form::List { of: &SIZE, count: [1, TERMS] };
static SERIES: [Form; 1] = [Form::Table(&RELAXATION)];

/// Key of layers, of the substrate and of the counterbody.
pub(super) const RELAXES: Key = Key::new(&SERIES, "{ shear = [3.0, 6.0], times = [1.0, 0.05] }").otherwise("elastic");

section! {
    /// Relaxation of the shear modulus to that of the material, a Prony series G(t) = G + Σ shear e^(−t/time).
    pub struct RelaxationSection = RELAXATION, rules as_many {
        /// shear moduli that relax, beside the relaxed one that `young` and `poisson` give
        pub shear: Vec<f64> = Key::new(&[SIZES], "[3.0, 6.0]").unit(Unit::Pressure),
        /// their relaxation times
        pub times: Vec<f64> = Key::new(&[SIZES], "[1.0, 0.05]").unit(Unit::Time),
        /// modulus that stays constant: the bulk modulus, with a Poisson's ratio that falls where the shear modulus is larger, or Poisson's ratio
        pub constant: ConstantWord = Key::new(&[Form::Word(ConstantWord::WORDS)], "\"poisson\"").default("\"bulk\""),
    }
}

words! {
    /// Modulus that stays constant.
    pub enum ConstantWord {
        /// The bulk modulus.
        Bulk = "bulk",
        /// Poisson's ratio.
        Poisson = "poisson",
    }
}

/// Refuses another number of times than of moduli.
fn as_many(series: &RelaxationSection, section: &TableAt<'_>) -> Result<(), Refusal> {
    series.relaxation().map(drop).map_err(|error| {
        let times = section.path("times");
        Refusal::new(section.span, format!("`{times}`: {error}"), "one time for each modulus")
            .help("give `times` as many numbers as `shear`")
    })
}

impl RelaxationSection {
    /// The relaxation.
    ///
    /// # Errors
    /// [`RelaxationError`] for different numbers of moduli and times.
    pub fn relaxation(&self) -> Result<Relaxation, RelaxationError> {
        let constant = match self.constant {
            ConstantWord::Bulk => ConstantModulus::Bulk,
            ConstantWord::Poisson => ConstantModulus::Poisson,
        };
        Ok(Relaxation::new(&self.shear, &self.times)?.with_constant(constant))
    }
}
