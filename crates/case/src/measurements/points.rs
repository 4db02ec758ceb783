//! The points of a test, of which a segment is taken.

use super::Fault;
use super::segment::Segment;
use percoat_core::identification::{
    Measurement, MeasurementError, Retraction, RetractionError, Unloading, UnloadingError,
};

/// Part of the largest force up to which a test is loaded: creep and the noise of a hold begin above it.
const LOADED: f64 = 0.995;

/// Part of the largest force that noise before contact has at most.
const BEFORE_CONTACT: f64 = 0.02;

/// Points of a test, each with its line where they stand in a table.
#[derive(Debug, Default)]
pub(super) struct Points {
    pub forces: Vec<f64>,
    pub penetrations: Vec<f64>,
    /// Standard deviations of the penetrations, where they are known.
    pub deviations: Option<Vec<f64>>,
    /// Lines of the points where they stand in a table.
    pub lines: Vec<usize>,
}

impl Points {
    /// The curve of loading of a segment, and what was left out, a sentence each.
    pub fn loading(mut self, segment: Segment) -> Result<(Measurement, Vec<String>), Fault> {
        let mut notes = Vec::new();
        let others = [Some(self.penetrations.len()), self.deviations.as_ref().map(Vec::len)];
        if let Some(other) = others.into_iter().flatten().find(|&other| other != self.forces.len()) {
            return Err(Fault::Values(MeasurementError::Unequal(self.forces.len(), other), None, ""));
        }
        let largest = self.forces.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let count = self.forces.len();
        let top = self.forces.iter().position(|&force| force == largest).unwrap_or(0);
        if segment == Segment::Loading {
            let end = self.forces.iter().position(|&force| force >= LOADED * largest).map_or(count, |last| last + 1);
            self.keep(0..end);
            notes.extend((end < count).then(|| {
                format!(
                    "{} of {count} points are left out, those behind the first one under {LOADED} of the largest force",
                    count - end
                )
            }));
        }
        // Before contact forces are zero but for noise.
        let before = self.forces.iter().take(top).rposition(|&force| force <= 0.0).map_or(0, |last| last + 1);
        let is_noise = self.forces[..before].iter().all(|&force| force <= BEFORE_CONTACT * largest);
        let before = if is_noise { before } else { 0 };
        self.keep(before..self.forces.len());
        notes.extend((before > 0).then(|| {
            format!("{before} of {count} points before contact, up to the last without a force, are left out")
        }));
        let Self { forces, penetrations, deviations, lines } = self;
        let advice = match segment {
            Segment::Whole => "; or take the segment of loading alone (--segment loading)",
            Segment::Loading | Segment::Unloading { .. } | Segment::Retraction => "",
        };
        let measurement = Measurement::new(forces, penetrations, deviations);
        measurement.map(|measurement| (measurement, notes)).map_err(|error| {
            // Points are numbered as in the table.
            let (error, first, advice) = match error {
                MeasurementError::Unequal(..) | MeasurementError::NoCurve | MeasurementError::SomeDeviations(_) => {
                    (error, None, "")
                }
                MeasurementError::Unloading { from, to, forces } => {
                    (MeasurementError::Unloading { from: from + before, to: to + before, forces }, Some(from), advice)
                }
                MeasurementError::Hold { from, to, force, by } => {
                    (MeasurementError::Hold { from: from + before, to: to + before, force, by }, Some(from), advice)
                }
                MeasurementError::Force(index, value) => {
                    (MeasurementError::Force(index + before, value), Some(index), advice)
                }
                MeasurementError::Penetration(index, value) => {
                    (MeasurementError::Penetration(index + before, value), Some(index), "")
                }
                MeasurementError::Deviation(index, value) => {
                    (MeasurementError::Deviation(index + before, value), Some(index), "")
                }
            };
            Fault::Values(error, first.and_then(|index| lines.get(index).copied()), advice)
        })
    }

    /// The unloading between two parts of its largest force.
    pub fn unloading(&self, part: [f64; 2]) -> Result<Unloading, Fault> {
        let Self { forces, penetrations, deviations, lines } = self;
        Unloading::new(forces, penetrations, deviations.as_deref(), part).map_err(|error| {
            let first = match error {
                UnloadingError::Value { index, .. } => Some(index),
                UnloadingError::Reloaded { from, .. } | UnloadingError::Rises { from, .. } => Some(from),
                _ => None,
            };
            let line = first.and_then(|index| lines.get(index).copied());
            Fault::Unloading(error, line)
        })
    }

    /// The curve of drawing off, and what was left out, in a sentence.
    pub fn retraction(&self) -> Result<(Retraction, Option<String>), Fault> {
        let Self { forces, penetrations, lines, .. } = self;
        let curve = Retraction::new(forces, penetrations).map_err(|error| {
            let first = if let RetractionError::NotFinite(index) = error { Some(index) } else { None };
            Fault::Retraction(error, first.and_then(|index| lines.get(index).copied()))
        })?;
        let left = forces.len() - curve.forces().len();
        let note = (left > 0).then(|| {
            format!(
                "{left} of {} points are left out, those before the largest penetration and behind the least force",
                forces.len()
            )
        });
        Ok((curve, note))
    }

    fn keep(&mut self, range: std::ops::Range<usize>) {
        for column in [&mut self.forces, &mut self.penetrations].into_iter().chain(&mut self.deviations) {
            column.truncate(range.end);
            column.drain(..range.start.min(column.len()));
        }
        if !self.lines.is_empty() {
            self.lines.truncate(range.end);
            self.lines.drain(..range.start);
        }
    }
}
