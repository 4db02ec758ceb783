//! `[life]`: how far `percoat life` follows wear and fatigue.

use super::keys::{Form, Key, Range, Unit};
use super::layers::SIZE;
use super::section::section;
use std::ops::Bound;

const TOLERANCE: Range = Range::Within(Bound::Excluded(0.0), Bound::Excluded(1.0));

section! {
    /// The section `[life]`.
    #[derive(Copy)]
    pub struct LifeSection = LIFE {
        /// passes up to which wear and damage are followed, on after the first failure
        pub passes: Option<f64> = Key::new(&[SIZE], "1e7").otherwise("only to the first failure"),
        /// distance that the counterbody slides in one pass
        pub distance: Option<f64> = Key::new(&[SIZE], "20.0").unit(Unit::Length).otherwise(
            "the period along the direction of sliding; of an isolated contact the width of the window along it",
        ),
        /// relative error of a step of wear
        pub tolerance: f64 = Key::new(&[Form::Number(TOLERANCE)], "1e-3").default("1e-2"),
    }
}
