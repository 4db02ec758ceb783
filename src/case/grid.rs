//! `[grid]`: how finely the cell is sampled.

use std::ops::{Bound, RangeInclusive};

use super::error::Refusal;
use super::node::Value;
use super::reader::{TableAt, ValueAt};
use crate::numeric::fourier::has_fast_factors;
use crate::run::Sampling;

/// Points along a cell vector when nothing is said.
const POINTS: usize = 512;
/// Points along a cell vector that are allowed.
const ALLOWED: RangeInclusive<usize> = 4..=32768;

/// Read the section `[grid]`; a surface from a `file` brings its own points, which may have any factors.
pub(super) fn read(section: Option<&TableAt<'_>>, file: Option<[usize; 2]>) -> Result<Sampling, Refusal> {
    let default = file.unwrap_or([POINTS; 2]);
    let Some(section) = section else { return Ok(Sampling::Points(default)) };
    section.only()?;
    match (section.optional("points"), section.optional("accuracy"), file) {
        (Some(_), Some(accuracy), _) => Err(section.both(["points", "accuracy"], accuracy.node.place)),
        (None, Some(accuracy), _) => {
            accuracy.number((Bound::Excluded(0.0), Bound::Included(0.1))).map(Sampling::Accuracy)
        }
        (Some(points), None, file) => match each(&points, |value| value.integer(1..=usize::MAX)) {
            Ok(points) if Some(points) == file => Ok(Sampling::Points(points)),
            _ => each(&points, transformable).map(Sampling::Points),
        },
        (None, None, _) => Ok(Sampling::Points(default)),
    }
}

/// An integer for both directions, or one for each.
fn each(value: &ValueAt<'_>, read: fn(&ValueAt<'_>) -> Result<usize, Refusal>) -> Result<[usize; 2], Refusal> {
    const WANTED: &str = "an integer or [n1, n2]";
    match &value.node.value {
        Value::Integer(_) => read(value).map(|n| [n; 2]),
        Value::List(_) => match &value.list(WANTED, WANTED)?[..] {
            [n1, n2] => Ok([read(n1)?, read(n2)?]),
            _ => Err(value.refuse(WANTED)),
        },
        _ => Err(value.refuse(WANTED)),
    }
}

/// A number of points whose transform is fast: made of the factors 2, 3, 5 and 7.
fn transformable(value: &ValueAt<'_>) -> Result<usize, Refusal> {
    let points = value.integer(ALLOWED)?;
    if has_fast_factors(points) {
        return Ok(points);
    }
    let below = (*ALLOWED.start()..points).rev().find(|n| has_fast_factors(*n)).unwrap_or(*ALLOWED.start());
    let above = (points..=*ALLOWED.end()).find(|n| has_fast_factors(*n)).unwrap_or(*ALLOWED.end());
    Err(value
        .refuse("a product of the factors 2, 3, 5 and 7")
        .help(format!("transforms of other lengths are slow; the nearest that are not: {below} and {above}")))
}
