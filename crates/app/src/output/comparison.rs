//! `compare.json`: spectral and localized solution side by side.

use super::head::{Head, with_head};
use super::json::{Unreadable, indented, read_back};
use super::summary::check;
use percoat_case::case::Case;
use percoat_core::comparison::{CircleComparison, Comparison, Deviation, StressPair};
use percoat_core::localized::{CircleRadius, Stop};
use percoat_core::reading::LevelReading;
use percoat_core::run::StepRecord;
use percoat_core::stress::StressState;
use serde::{Deserialize, Serialize};
use serde_json::Value;

with_head! {
    /// The content of `compare.json`: a load step of a case by both methods. Infinite numbers are null.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
    pub struct ComparisonFile {
        /// The load step, from 1.
        pub step: usize,
        /// The spectral solution.
        pub spectral: StepRecord,
        /// Change of the spectral solution from the grid of half the points.
        pub spectral_error: Deviation,
        /// Rule for the radius of the circles.
        pub rule: CircleRadius,
        /// Whether the indenters outside the circle act.
        pub mutual_effect: bool,
        /// Elements across the largest contact.
        pub elements: usize,
        /// The circles under the rule.
        pub localized: Vec<CircleRecord>,
        /// The circles under the other rule; `None` where they have none.
        pub other_rule: Option<OtherRule>,
        /// The first circle with the lattice sum of the indenters outside.
        pub lattice_sum: Option<CircleRecord>,
        /// Stresses of both methods, with the last circle under the rule.
        pub stresses: Vec<PointStresses>,
    }
}

/// Circles under the rule that the case does not prescribe.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct OtherRule {
    /// The rule.
    pub rule: CircleRadius,
    /// The circles.
    pub localized: Vec<CircleRecord>,
}

/// A circle of the localized method.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CircleRecord {
    /// Number of indenters inside.
    pub indenters: usize,
    /// Radius of the circle, level by level, a length; `None` where it is infinite.
    pub radius: Vec<Option<f64>>,
    /// Whether its solution has converged.
    pub converged: bool,
    /// Why the solution ended.
    pub stop_reason: Stop,
    /// Penetration δ, a length.
    pub penetration: f64,
    /// Additional displacement w_a of Eq. (8), a length.
    pub additional_displacement: f64,
    /// Readings of the levels, from the highest down.
    pub levels: Vec<LevelReading>,
    /// Deviation from the spectral solution.
    pub difference: Deviation,
    /// Change from half the number of elements.
    pub mesh_error: Deviation,
}

/// Stresses of both methods at a point.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PointStresses {
    /// Distance from the axis of the indenter along x, a length.
    pub x: f64,
    /// Distance from the axis of the indenter along y, a length.
    pub y: f64,
    /// Depth, a length.
    pub z: f64,
    /// Number of the material, from 1.
    pub side: usize,
    /// Stresses of the spectral solution.
    pub spectral: StressState,
    /// Stresses of the localized solution.
    pub localized: StressState,
}

impl ComparisonFile {
    /// The record of a comparison of load step `step` (from 1) of a case.
    pub fn new(comparison: &Comparison, case: &Case, step: usize) -> Self {
        let task = &comparison.task;
        let circles = |circles: &[CircleComparison]| circles.iter().map(CircleRecord::from).collect::<Vec<_>>();
        let other = OtherRule { rule: task.rule.other(), localized: circles(&comparison.other_rule) };
        let Head { percoat, title, case: keys, units } = Head::of(case);
        Self {
            percoat,
            title,
            case: keys,
            units,
            step,
            spectral: comparison.spectral.clone(),
            spectral_error: comparison.grid_error,
            rule: task.rule,
            mutual_effect: task.mutual_effect,
            elements: task.elements,
            localized: circles(&comparison.circles),
            other_rule: Some(other).filter(|other| !other.localized.is_empty()),
            lattice_sum: comparison.lattice_sum.as_ref().map(CircleRecord::from),
            stresses: comparison.stresses.iter().map(PointStresses::from).collect(),
        }
    }

    /// The circles under each rule: that of the task, the other one, the lattice sum.
    pub fn rules(&self) -> [(CircleRadius, &[CircleRecord]); 3] {
        let other = self.other_rule.as_ref().map_or(&[][..], |other| &other.localized);
        [
            (self.rule, &self.localized),
            (self.rule.other(), other),
            (CircleRadius::LatticeSum, self.lattice_sum.as_slice()),
        ]
    }

    /// Reads the content of `compare.json`.
    ///
    /// # Errors
    /// [`Unreadable`] with the key that is not as this version writes it.
    pub fn read(file: &Value) -> Result<Self, Unreadable> {
        let record: Self = read_back(file)?;
        check(std::slice::from_ref(&record.spectral))?;
        Ok(record)
    }

    /// The content of `compare.json`.
    pub fn to_json(&self) -> String {
        indented(self)
    }
}

impl From<&CircleComparison> for CircleRecord {
    fn from(circle: &CircleComparison) -> Self {
        Self {
            indenters: circle.indenters,
            radius: circle.radii.iter().map(|radius| Some(*radius).filter(|radius| radius.is_finite())).collect(),
            converged: circle.stop == Stop::Converged,
            stop_reason: circle.stop,
            penetration: circle.answer.penetration,
            additional_displacement: circle.additional_displacement,
            levels: circle.answer.levels.clone(),
            difference: circle.difference,
            mesh_error: circle.mesh_error,
        }
    }
}

impl PointStresses {
    /// Largest difference of a stress component, a pressure.
    pub fn difference(&self) -> f64 {
        self.spectral.difference_from(&self.localized)
    }
}

impl From<&StressPair> for PointStresses {
    fn from(pair: &StressPair) -> Self {
        let ([x, y], z, side) = (pair.place, pair.depth.z, pair.depth.material);
        Self { x, y, z, side, spectral: pair.spectral, localized: pair.localized }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use percoat_case::case::embedded;
    use std::ops::ControlFlow;

    #[test]
    fn a_comparison_is_read_back_as_it_was_written() {
        let coarse = ["grid.points=32", "localized={ indenters = [1, 4], elements = 6 }"].map(str::to_owned);
        let case = Case::read(&embedded::source("fig2").unwrap(), &coarse).unwrap();
        let mut comparison = case.comparison().compare([32, 32], &mut |_| ControlFlow::Continue(())).unwrap();
        // The step as a file keeps it: without what only the estimate of errors and pictures need.
        comparison.spectral = serde_json::from_value(serde_json::json!(comparison.spectral)).unwrap();
        let mut written = ComparisonFile::new(&comparison, &case, 1);
        for circle in written.localized.iter_mut().chain(&mut written.lattice_sum) {
            circle.levels.iter_mut().for_each(|level| level.uncertainty = Default::default());
        }
        for PointStresses { spectral, localized, .. } in &mut written.stresses {
            (spectral.displacement, localized.displacement) = ([0.0; 3], [0.0; 3]);
        }
        assert!(written.localized.len() == 2 && written.localized[0].levels.len() == 3);
        let read = ComparisonFile::read(&serde_json::from_str(&written.to_json()).unwrap()).unwrap();
        assert_eq!(read, written);
    }
}
