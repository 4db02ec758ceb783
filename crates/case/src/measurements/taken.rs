//! Measured curves taken together: those of loading, or unloadings; or one of drawing off.

use super::fault::{CurveFault, Fault};
use super::points::Points;
use super::segment::Segment;
use super::{points_of_columns, points_of_text};
use crate::units::Units;
use percoat_core::identification::{Measurement, Retraction, Unloading};

/// Where a curve stands.
#[derive(Debug, Clone, Copy)]
pub enum Source<'a> {
    /// The text of a table.
    Text(&'a str),
    /// Columns in memory with their names.
    Columns(&'a [(String, Vec<f64>)]),
}

/// Curves of one segment, in the units of the case.
#[derive(Debug, Clone, PartialEq)]
pub enum Curves {
    /// Loading: the points of all curves.
    Loading(Measurement),
    /// Unloading: the stiffness of each.
    Unloading(Vec<Unloading>),
    /// Drawing off surfaces that adhere.
    Retraction(Retraction),
}

/// Measured curves with their names, and what was left out.
#[derive(Debug, Clone, PartialEq)]
pub struct Taken {
    /// The curves.
    pub curves: Curves,
    /// Name of each: of its file, else its number from 1.
    pub names: Vec<String>,
    /// Parts of the tests that were taken or left out, a sentence each.
    pub notes: Vec<String>,
}

impl Taken {
    /// The curves of a `segment` of tests, each with the name of its file, in the `units` of the case.
    ///
    /// # Errors
    /// [`CurveFault`] with the name of the curve.
    pub fn new(sources: &[(&str, Source<'_>)], segment: Segment, units: &Units) -> Result<Self, CurveFault> {
        let fault = |index: usize| {
            let name = match sources {
                [(name, _)] => (*name).to_owned(),
                _ => named(sources[index].0, index),
            };
            move |fault: Fault| CurveFault { name, fault }
        };
        let points = |(index, (_, source)): (usize, &(&str, Source<'_>))| -> Result<Points, CurveFault> {
            match source {
                Source::Text(text) => points_of_text(text, units),
                Source::Columns(columns) => points_of_columns(columns, units),
            }
            .map_err(fault(index))
        };
        let all: Vec<Points> = sources.iter().enumerate().map(points).collect::<Result<_, _>>()?;
        let mut notes = Vec::new();
        let curves = match segment {
            Segment::Whole | Segment::Loading => {
                let mut curves = Vec::new();
                for (index, points) in all.into_iter().enumerate() {
                    let (curve, left_out) = points.loading(segment).map_err(fault(index))?;
                    curves.push(curve);
                    notes.extend(left_out.into_iter().map(|text| match sources {
                        [_] => text,
                        _ => format!("{}: {text}", named(sources[index].0, index)),
                    }));
                }
                let none = |error| CurveFault { name: String::new(), fault: Fault::Values(error, None, "") };
                Curves::Loading(Measurement::joined(curves).map_err(none)?)
            }
            Segment::Unloading { part } => {
                let each = all.iter().enumerate();
                let each = each.map(|(index, points)| points.unloading(part).map_err(fault(index)));
                Curves::Unloading(each.collect::<Result<_, _>>()?)
            }
            Segment::Retraction => match &all[..] {
                [points] => {
                    let (curve, left_out) = points.retraction().map_err(fault(0))?;
                    notes.extend(left_out);
                    Curves::Retraction(curve)
                }
                _ => {
                    let fault = Fault::SeveralRetractions(all.len());
                    return Err(CurveFault { name: String::new(), fault });
                }
            },
        };
        let names = sources.iter().enumerate().map(|(index, (name, _))| named(name, index)).collect();
        Ok(Self { curves, names, notes })
    }
}

/// The name of a curve: of its file, else its number from 1.
fn named(name: &str, index: usize) -> String {
    if name.is_empty() { format!("curve {}", index + 1) } else { name.to_owned() }
}
