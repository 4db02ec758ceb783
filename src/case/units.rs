//! `[units]`: what lengths and pressures are measured in, by name.

use super::keys::{Form, Key};
use super::section::section;

/// Most letters of a unit's name.
const LETTERS: usize = 12;

const NAME: Form = Form::Name("a name", LETTERS);

section! {
    /// The section `[units]`: names alone, no number is converted.
    pub struct UnitsSection = UNITS {
        /// what lengths are measured in
        pub length: Option<String> = Key::new(&[NAME], "\"µm\"").otherwise("not named"),
        /// what pressures are measured in
        pub pressure: Option<String> = Key::new(&[NAME], "\"GPa\"").otherwise("not named"),
    }
}
