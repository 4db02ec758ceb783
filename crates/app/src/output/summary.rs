//! `summary.json` and `curve.csv`: every scalar of a run.

use super::Timing;
use super::columns::{csv, scalars};
use super::fingerprint::fingerprint;
use super::head::{Head, with_head};
use super::json::{Unreadable, indented, read_back};
use super::table::adhesive_loss;
use percoat_case::case::Case;
use percoat_core::measured::Measured;
use percoat_core::reading::{JumpReading, PullOffReading, cycle, pull_off};
use percoat_core::run::StepRecord;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

with_head! {
    /// The content of `summary.json`: a whole run. Two runs of one case differ only in `timing` and in the `seconds` of the steps.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
    pub struct Summary {
        /// Warnings, a sentence each.
        pub warnings: Vec<String>,
        /// Fingerprint of the case and the version, by which a run recognises its finished result.
        #[serde(default)]
        pub fingerprint: String,
        /// Change between the two finest grids, where an accuracy was prescribed.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub accuracy: Option<f64>,
        /// Energy that slip dissipates in the last closed cycle; `None` without one.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub cycle: Option<Cycle>,
        /// Least force of the path of surfaces that adhere; `None` before one has been passed.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub pull_off: Option<PullOffReading>,
        /// Jumps of surfaces that adhere.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        pub jumps: Vec<JumpReading>,
        /// Energy that the jumps of a closed path lose; `None` of other paths.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub loss: Option<Loss>,
        /// The load steps.
        pub steps: Vec<StepRecord>,
        /// Wall times by phases.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub timing: Option<Timing>,
    }
}

/// Energy that a closed path of surfaces that adhere loses.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Loss {
    /// Energy, of the cell or the isolated contact.
    pub energy: f64,
    /// Error of the energy, by the distance of the states of the path.
    pub error: Option<f64>,
}

/// A closed cycle of the tangential force.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Cycle {
    /// Energy that slip dissipates, of the cell or the isolated contact.
    pub work: f64,
    /// Error of the energy.
    pub error: Option<f64>,
}

impl Summary {
    /// The record of a run of a case; `accuracy`: relative change between the two finest grids, where an accuracy was prescribed.
    pub fn new(case: &Case, warnings: &[String], accuracy: Option<f64>, steps: &[StepRecord], timing: Timing) -> Self {
        let Head { percoat, title, case: keys, units } = Head::of(case);
        Self {
            percoat,
            title,
            case: keys,
            units,
            warnings: warnings.to_vec(),
            fingerprint: fingerprint(case, ""),
            accuracy,
            cycle: closed_cycle(steps).map(|Measured { value, error }| Cycle { work: value, error }),
            pull_off: pull_off(steps.iter().filter_map(|step| step.adhesion.as_ref())),
            jumps: steps.iter().filter_map(|step| step.adhesion.as_ref()).flat_map(|step| step.jumps.clone()).collect(),
            loss: adhesive_loss(steps).map(|Measured { value, error }| Loss { energy: value, error }),
            steps: steps.to_vec(),
            timing: Some(timing),
        }
    }

    /// Reads the content of `summary.json`.
    ///
    /// # Errors
    /// [`Unreadable`] with the key that is not as this version writes it.
    pub fn read(file: &Value) -> Result<Self, Unreadable> {
        let summary: Self = read_back(file)?;
        check(&summary.steps)?;
        Ok(summary)
    }

    /// The content of `summary.json`.
    pub fn to_json(&self) -> String {
        indented(self)
    }
}

/// Energy dissipated in the last closed cycle of a path; `None` without one.
pub(super) fn closed_cycle(steps: &[StepRecord]) -> Option<Measured> {
    cycle(steps.iter().filter_map(|step| Some((&step.reading, step.tangential.as_ref()?))))
}

/// Refuses steps that no run can have.
pub(super) fn check(steps: &[StepRecord]) -> Result<(), Unreadable> {
    let refused = |number: usize, reason| Unreadable { place: format!("step {number}"), reason };
    (1..).zip(steps).try_for_each(|(number, step)| step.check().map_err(|reason| refused(number, reason)))
}

/// The steps as a CSV table: one row a step, one column a scalar, nested names joined by underscores (`levels_1_load`). A cell is
/// empty where a step does not have the scalar.
pub fn curve(steps: &[StepRecord]) -> String {
    csv(|| steps.iter().map(|step| scalars(&json!(step))))
}

#[cfg(test)]
mod tests {
    use super::super::LimitFile;
    use super::*;
    use percoat_case::case::embedded;
    use percoat_core::body::Substrate;
    use percoat_core::run::Outcome;

    /// A record without the values that only error estimates and pictures need.
    fn kept(mut step: StepRecord) -> StepRecord {
        let reading = &mut step.reading;
        (reading.contact_fraction_uncertainty, reading.peak_to_edge) = (0.0, 0.0);
        reading.boundaries.clear();
        reading.fractions = Default::default();
        reading.levels.iter_mut().for_each(|level| level.uncertainty = Default::default());
        let interfaces = step.stress.iter_mut().flat_map(|stress| &mut stress.interfaces);
        interfaces.for_each(|carried| carried.delamination = None);
        step.rough.iter_mut().for_each(|rough| rough.histograms.clear());
        step
    }

    #[test]
    fn every_case_is_read_back_as_it_was_written() {
        for (name, _) in embedded::all() {
            let whole = Case::read(&embedded::source(name).unwrap(), &[]).unwrap();
            // The zone beside contact in which surfaces pull has to be resolved, and its grip goes through many positions.
            let coarse: &[&str] = match whole.adhesion.is_some() {
                true => &["grid={ points = 48 }", "load.grip=[0.05, -0.05]"],
                false => &["grid={ points = 32 }"],
            };
            // Bodies that creep have no stresses.
            let stresses = whole.time.is_none().then_some("stress={ planes = [0.0] }");
            // A rigid base has neither a name nor stresses; what lies on it has.
            let named = (whole.half_space().substrate() != Substrate::Rigid).then_some("substrate.name=steel");
            let sets = coarse.iter().copied().chain(stresses).chain(named).map(str::to_owned);
            let case = Case::read(&embedded::source(name).unwrap(), &sets.collect::<Vec<_>>()).unwrap();
            let Outcome { steps, .. } = case.run().solve(&mut ()).unwrap();
            let steps: Vec<StepRecord> = steps.into_iter().map(kept).collect();
            let timing = Timing { setup: 0.1, solve: 0.2, stress: 0.3, output: 0.4 };
            let written = Summary::new(&case, &["doubtful".to_owned()], Some(1e-3), &steps, timing);
            let read = Summary::read(&serde_json::from_str(&written.to_json()).unwrap()).unwrap();
            // Names do not count in equality: the text has them.
            assert!(read == written && read.to_json() == written.to_json(), "{name}");
            // Surfaces that are drawn apart have no stresses.
            let last = steps.iter().rfind(|step| step.stress.is_some());
            let substrate = &json!(last)["stress"]["materials"][case.half_space().layers().len()];
            assert_eq!(substrate["max_tau1"]["name"].as_str(), stresses.and(named).map(|_| "steel"), "{name}");
            // A history takes long for each load; the program's test of a ball that is shaken reads its limits back.
            if case.tangential.is_none() && case.run().check_limits().is_ok() {
                let mut limits = case.run().limits(&mut ()).unwrap();
                limits.steps = limits.steps.into_iter().map(kept).collect();
                let written = LimitFile::new(&limits, &case, &[]);
                let read = LimitFile::read(&serde_json::from_str(&written.to_json()).unwrap()).unwrap();
                assert!(read == written && read.to_json() == written.to_json(), "{name}");
            }
        }
    }

    #[test]
    fn a_tip_and_numbers_that_are_none_are_read_back_too() {
        let case = Case::read(&embedded::source("fig2").unwrap(), &["grid.points=32".to_owned()]).unwrap();
        let step = kept(case.run().solve(&mut ()).unwrap().steps.remove(0));
        let mut tip = step.clone();
        (tip.reading.max_pressure, tip.reading.resolved_peak) = (f64::INFINITY, Some(2.0));
        let back = |step: &StepRecord| -> StepRecord { serde_json::from_value(json!(step)).unwrap() };
        assert_eq!(back(&tip), tip);
        assert_eq!(json!(tip)["max_pressure"], Value::Null);
        let mut none = step;
        none.reading.penetration = f64::NAN;
        none.stop = percoat_core::spectral::Stop::NotANumber;
        let read = back(&none);
        assert!(read.reading.penetration.is_nan() && !read.converged() && read.check().is_ok());
        assert_eq!(json!(read), json!(none));
        none.stop = percoat_core::spectral::Stop::Converged;
        assert!(back(&none).check().unwrap_err().contains("`penetration` is null"));
    }

    #[test]
    fn codes_of_the_version_before_are_read_and_unknown_ones_refused() {
        let case = Case::read(&embedded::source("fig2").unwrap(), &["grid.points=32".to_owned()]).unwrap();
        let steps = case.run().solve(&mut ()).unwrap().steps;
        let summary =
            Summary::new(&case, &[], None, &steps, Timing { setup: 0.0, solve: 0.0, stress: 0.0, output: 0.0 });
        let mut file: Value = serde_json::from_str(&summary.to_json()).unwrap();
        let mut read = |key: &str, code: &str| {
            let before = std::mem::replace(&mut file["steps"][0][key], code.into());
            let read = Summary::read(&file).map(|summary| summary.steps[0].stop);
            file["steps"][0][key] = before;
            read.map_err(|error| error.to_string())
        };
        assert_eq!(read("stop_reason", "iteration limit"), Ok(percoat_core::spectral::Stop::IterationLimit));
        assert!(read("stop_reason", "x").unwrap_err().contains("`steps[0]`: unknown variant `x`"));
        assert!(read("route", "x").unwrap_err().contains("unknown variant `x`"));
    }
}
