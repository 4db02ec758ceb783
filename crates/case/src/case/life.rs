//! `[life]`: how far `percoat life` follows wear and fatigue.

use super::error::Refusal;
use super::keys::{Form, Key, Range, Unit};
use super::layers::SIZE;
use super::reader::TableAt;
use super::section::section;
use std::ops::Bound;

const TOLERANCE: Range = Range::Within(Bound::Excluded(0.0), Bound::Excluded(1.0));

section! {
    /// The section `[life]`.
    #[derive(Copy)]
    pub struct LifeSection = LIFE, rules one_length {
        /// passes up to which wear and damage are followed, on after the first failure
        pub passes: Option<f64> = Key::new(&[SIZE], "1e7").otherwise("only to the first failure"),
        /// distance that the counterbody slides in one pass, of a disc the circumference of the track
        pub distance: Option<f64> = Key::new(&[SIZE], "20.0").unit(Unit::Length).otherwise(
            "the period along the direction of sliding; this or `stroke` is needed where the counterbody of an isolated contact wears",
        ),
        /// stroke of a counterbody that goes to and fro, instead of `distance`: there and back is one pass
        pub stroke: Option<f64> = Key::new(&[SIZE], "2.0").unit(Unit::Length).otherwise("one way only"),
        /// relative error of a step of wear
        pub tolerance: f64 = Key::new(&[Form::Number(TOLERANCE)], "1e-3").default("1e-2"),
    }
}

/// Refuses a distance beside a stroke.
fn one_length(life: &LifeSection, section: &TableAt<'_>) -> Result<(), Refusal> {
    if life.distance.is_none() || life.stroke.is_none() {
        return Ok(());
    }
    let stroke = section.value("stroke")?;
    let message = "`life.stroke` and `life.distance` both say how far the counterbody slides in a pass";
    Err(Refusal::new(stroke.node.span, message, "one of them").help(
        "give `stroke` where it goes to and fro, there and back being one pass, and `distance` where it goes round",
    ))
}
