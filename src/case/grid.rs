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

/// Read the section `[grid]`; a surface from a `file` brings its own points.
pub(super) fn read(section: Option<&TableAt<'_>>, file: Option<[usize; 2]>) -> Result<Sampling, Refusal> {
    let default = file.unwrap_or([POINTS; 2]);
    let Some(section) = section else { return Ok(Sampling::Points(default)) };
    section.only()?;
    match (section.optional("points"), section.optional("accuracy"), file) {
        (Some(_), Some(accuracy), _) => Err(section.both(["points", "accuracy"], accuracy.node.place)),
        (None, Some(accuracy), Some(_)) => {
            let message = "`grid.accuracy` has no place beside [surface]: its grid is that of the file";
            Err(Refusal::new(accuracy.node.place, message, "not used here").help("remove it"))
        }
        (None, Some(accuracy), None) => {
            accuracy.number((Bound::Excluded(0.0), Bound::Included(0.1))).map(Sampling::Accuracy)
        }
        (Some(points), None, Some(file)) => same_as(&points, file),
        (Some(points), None, None) => each(&points, transformable).map(Sampling::Points),
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

fn same_as(value: &ValueAt<'_>, file: [usize; 2]) -> Result<Sampling, Refusal> {
    let points = each(value, |value| value.integer(1..=usize::MAX))?;
    if points == file {
        return Ok(Sampling::Points(points));
    }
    let [n1, n2] = file;
    Err(value.refuse(format!("[{n1}, {n2}], the shape of the surface's file")).help("remove it, or resample the file"))
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
