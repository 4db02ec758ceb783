//! `[units]`: names of the units of lengths and pressures.

use super::keys::{Form, Key};
use super::section::section;

/// Most letters of a unit's name.
const LETTERS: usize = 12;

const NAME: Form = Form::Name("a name", LETTERS);

section! {
    /// The section `[units]`: a number alone is in these units, one with a unit is converted to them.
    pub struct UnitsSection = UNITS {
        /// unit of all lengths
        pub length: Option<String> = Key::new(&[NAME], "\"µm\"").otherwise("not named"),
        /// unit of all pressures
        pub pressure: Option<String> = Key::new(&[NAME], "\"GPa\"").otherwise("not named"),
        /// unit of all times; numbers are not converted to it
        pub time: Option<String> = Key::new(&[NAME], "\"s\"").otherwise("not named"),
        /// unit of all temperatures; numbers are not converted to it
        pub temperature: Option<String> = Key::new(&[NAME], "\"K\"").otherwise("not named"),
    }
}
