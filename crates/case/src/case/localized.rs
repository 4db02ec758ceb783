//! `[localized]`: the circles of the localized method, for `compare`.

use super::keys::{Form, Key};
use super::section::{Words, section, words};
use percoat_core::localized::CircleRadius;

words! {
    CircleRadius {
        LoadBalanced = "load-balanced",
        AreaBalanced = "area-balanced",
        LatticeSum = "lattice-sum",
    }
}

section! {
    /// The section `[localized]`.
    pub struct LocalizedSection = LOCALIZED {
        /// number of indenters inside the circle, one number a circle
        pub indenters: Vec<usize> =
            Key::new(&[Form::List { of: &Form::Integer(1, 10_000), count: [1, 100] }], "[7, 37]")
                .default("[7, 13, 37, 73]"),
        /// elements across the largest contact
        pub elements: usize = Key::new(&[Form::Integer(4, 1000)], "64").default("48"),
        /// radius of the circle; with "lattice-sum" the indenters outside act in place of the uniform pressure
        pub radius: CircleRadius =
            Key::new(&[Form::Word(CircleRadius::WORDS)], "\"area-balanced\"").default("\"load-balanced\""),
        /// whether neighbouring indenters act on each other
        pub mutual_effect: bool = Key::new(&[Form::Boolean], "false").default("true"),
    }
}
