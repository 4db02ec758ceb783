//! `limit.json`: the load at which each criterion is reached, the first of them, and every load that was solved.

use super::head::{Head, with_head};
use super::json::{Unreadable, indented, read_back};
use super::summary::check;
use percoat_case::case::Case;
use percoat_core::load::LoadQuantity;
use percoat_core::reading::{Criterion, names};
use percoat_core::run::{Limit, Limits, StepRecord};
use serde::{Deserialize, Serialize};
use serde_json::Value;

with_head! {
    /// The content of `limit.json`: the limit loads of a case.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
    pub struct LimitFile {
        /// Warnings, a sentence each.
        pub warnings: Vec<String>,
        /// The limit that is reached first; `None` where none is.
        pub first: Option<FirstLimit>,
        /// The least and the largest load that were solved; `None` where none was.
        pub searched: Option<[f64; 2]>,
        /// Load at which contact becomes complete, with hardness at the latest; `None` where it never does, or not below `hardness_load`.
        pub complete_contact: Option<f64>,
        /// Load that is 0.999 of the most that the hardness bears, beyond which none is solved; `None` without hardness and for an isolated
        /// contact.
        #[serde(default)]
        pub hardness_load: Option<f64>,
        /// Sides of the largest window in which loads were solved; `None` where an isolated contact had room in its own in all.
        #[serde(default)]
        pub window: Option<[f64; 2]>,
        /// Largest relative change of the limits against the next coarser grid, where an accuracy was prescribed.
        pub change: Option<f64>,
        /// The limit of each criterion.
        pub limits: Vec<Limit>,
        /// Every load that was solved on the last grid.
        pub steps: Vec<StepRecord>,
    }
}

/// The limit that is reached first, with its rivals.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FirstLimit {
    /// The limit.
    #[serde(flatten)]
    pub limit: Limit,
    /// The criteria that may be reached before it by the errors of both.
    #[serde(with = "names")]
    pub rivals: Vec<Criterion>,
}

impl LimitFile {
    /// The record of the limits of a case.
    pub fn new(limits: &Limits, case: &Case, warnings: &[String]) -> Self {
        let load = |step: &StepRecord| step.reading.load(limits.quantity);
        let ends = limits.steps.first().zip(limits.steps.last());
        let finite = |load: f64| Some(load).filter(|load| load.is_finite());
        let Head { percoat, title, case: keys, units } = Head::of(case);
        Self {
            percoat,
            title,
            case: keys,
            units,
            warnings: warnings.to_vec(),
            first: limits.first().map(|limit| FirstLimit { limit: *limit, rivals: limits.rivals() }),
            searched: ends.map(|(first, last)| [load(first), load(last)]),
            complete_contact: finite(limits.complete),
            hardness_load: finite(limits.hardness_load),
            window: limits.window,
            change: limits.change,
            limits: limits.limits.clone(),
            steps: limits.steps.clone(),
        }
    }

    /// Reads the content of `limit.json`.
    ///
    /// # Errors
    /// [`Unreadable`] with the key that is not as this version writes it.
    pub fn read(file: &Value) -> Result<Self, Unreadable> {
        let record: Self = read_back(file)?;
        check(&record.steps)?;
        Ok(record)
    }

    /// The content of `limit.json`.
    pub fn to_json(&self) -> String {
        indented(self)
    }

    /// The limits, without the step of the picture and the ends of search and refinement, which the file does not keep.
    pub fn limits(&self) -> Limits {
        Limits {
            limits: self.limits.clone(),
            steps: self.steps.clone(),
            shown: Vec::new(),
            quantity: self.limits.first().map_or(LoadQuantity::MeanPressure, |limit| limit.quantity),
            complete: self.complete_contact.unwrap_or(f64::INFINITY),
            hardness_load: self.hardness_load.unwrap_or(f64::INFINITY),
            window: self.window,
            ends_at_border: false,
            change: self.change,
            end: None,
            warnings: self.warnings.clone(),
        }
    }
}
