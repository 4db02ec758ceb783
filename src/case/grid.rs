//! `[grid]`: how finely the cell is sampled.

use super::error::Refusal;
use super::node::Value;
use super::reader::TableAt;
use super::value::ValueAt;
use crate::numeric::fourier::has_fast_factors;
use crate::run::Sampling;

/// Read the section `[grid]`; a surface from a `file` brings its own points, which may have any factors.
pub(super) fn read(section: &TableAt<'_>, file: Option<[usize; 2]>) -> Result<Sampling, Refusal> {
    section.only()?;
    match (section.optional("points"), section.optional("accuracy"), file) {
        (Some(_), Some(accuracy), _) => Err(section.both(["points", "accuracy"], accuracy.node.place)),
        (None, Some(accuracy), _) => accuracy.number().map(Sampling::Accuracy),
        (None, None, Some(points)) => Ok(Sampling::Points(points)),
        (Some(given), None, Some(points)) if is(&given, points) => Ok(Sampling::Points(points)),
        (_, None, _) => each(&section.value("points")?).map(Sampling::Points),
    }
}

/// Whether these points are given.
fn is(value: &ValueAt<'_>, points: [usize; 2]) -> bool {
    let is = |value: &Value, n: usize| matches!(value, Value::Integer(m) if usize::try_from(*m) == Ok(n));
    match &value.node.value {
        Value::List(items) => items.len() == 2 && items.iter().zip(points).all(|(item, n)| is(&item.value, n)),
        value => points.iter().all(|n| is(value, *n)),
    }
}

/// An integer for both directions, or one for each.
fn each(value: &ValueAt<'_>) -> Result<[usize; 2], Refusal> {
    match &value.node.value {
        Value::Integer(_) => transformable(value).map(|n| [n; 2]),
        _ => {
            let [n1, n2] = value.tuple()?;
            Ok([transformable(&n1)?, transformable(&n2)?])
        }
    }
}

/// A number of points whose transform is fast: made of the factors 2, 3, 5 and 7.
fn transformable(value: &ValueAt<'_>) -> Result<usize, Refusal> {
    let points = value.integer()?;
    if has_fast_factors(points) {
        return Ok(points);
    }
    // What the table admits begins and ends with such numbers.
    let below = (1..points).rev().find(|n| has_fast_factors(*n)).unwrap_or(points);
    let above = (points..).find(|n| has_fast_factors(*n)).unwrap_or(points);
    Err(value
        .refuse("a product of the factors 2, 3, 5 and 7")
        .help(format!("transforms of other lengths are slow; the nearest that are not: {below} and {above}")))
}
