//! `[grid]`: the samples of the cell.

use std::ops::Bound;

use super::error::Refusal;
use super::keys::{Form, Key, Range};
use super::node::Value;
use super::reader::TableAt;
use super::section::{KeyValue, ReadTable, section};
use super::value::ValueAt;
use percoat_core::numeric::fourier::has_fast_factors;
use percoat_core::run::Sampling;

const POINTS: Form = Form::Integer(4, 32_768);

section! {
    /// The section `[grid]`, serialised by [`Sampling`].
    pub struct GridSection = GRID {
        /// samples along each cell vector, a product of the factors 2, 3, 5 and 7
        pub points: Points = Key::new(&[POINTS, Form::Tuple("[n1, n2]", &[POINTS; 2])], "[512, 256]")
            .default("512")
            .rule("beside a surface's file its own when not given, which may have any factors"),
        /// refine until results change by less than this, relatively
        pub accuracy: Option<f64> = Key::new(
            &[Form::Number(Range::Within(Bound::Excluded(0.0), Bound::Included(0.1)))],
            "1e-3",
        )
        .otherwise("`points` are taken")
        .instead_of("points"),
    }
}

/// Samples along a₁ and a₂.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Points([usize; 2]);

impl KeyValue for Points {
    /// Reads an integer for both directions, or one for each.
    fn read(value: &ValueAt<'_>) -> Result<Self, Refusal> {
        match &value.node.value {
            Value::Integer(_) => transformable(value).map(|n| Self([n; 2])),
            _ => {
                let [n1, n2] = value.tuple()?;
                Ok(Self([transformable(&n1)?, transformable(&n2)?]))
            }
        }
    }
}

impl KeyValue for Sampling {
    fn read(value: &ValueAt<'_>) -> Result<Self, Refusal> {
        read(&value.table()?, None)
    }
}

/// The sampling of a case; `file`: the points of a surface from a file, which may have any factors.
pub(super) fn read(section: &TableAt<'_>, file: Option<[usize; 2]>) -> Result<Sampling, Refusal> {
    if let (Some(_), Some(accuracy)) = (section.optional("points"), section.optional("accuracy")) {
        return Err(section.both(["points", "accuracy"], accuracy.node.span));
    }
    let points = section.optional("points");
    if let Some(file) = file.filter(|file| points.as_ref().is_none_or(|points| is(points, *file)))
        && section.optional("accuracy").is_none()
    {
        return section.only().map(|()| Sampling::Points(file));
    }
    let GridSection { points: Points(points), accuracy } = GridSection::read_table(section)?;
    Ok(accuracy.map_or(Sampling::Points(points), Sampling::Accuracy))
}

/// Whether a value is equal to `points`.
fn is(value: &ValueAt<'_>, points: [usize; 2]) -> bool {
    let is = |value: &Value, n: usize| matches!(value, Value::Integer(m) if usize::try_from(*m) == Ok(n));
    match &value.node.value {
        Value::List(items) => items.len() == 2 && items.iter().zip(points).all(|(item, n)| is(&item.value, n)),
        value => points.iter().all(|n| is(value, *n)),
    }
}

/// A number of points whose transform is fast: made of the factors 2, 3, 5 and 7.
fn transformable(value: &ValueAt<'_>) -> Result<usize, Refusal> {
    let points = value.integer()?;
    if has_fast_factors(points) {
        return Ok(points);
    }
    // The bounds of the key are such numbers.
    let below = (1..points).rev().find(|n| has_fast_factors(*n)).unwrap_or(points);
    let above = (points..).find(|n| has_fast_factors(*n)).unwrap_or(points);
    Err(value
        .refuse("a product of the factors 2, 3, 5 and 7")
        .help(format!("transforms of other lengths are slow; the nearest that are not: {below} and {above}")))
}
