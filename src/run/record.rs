//! Every scalar of a load step, as `summary.json` has them.

use super::Tapered;
use crate::body::HalfSpace;
use crate::reading::{Criterion, Governing, Reading, RoughReading, StressReading, Utilisation, stiffness};
use crate::spectral::{Certificate, Report, Step, Stop};

/// What stays of a load step beside its fields.
#[derive(Debug, Clone, PartialEq)]
pub struct StepRecord {
    /// What is read off it.
    pub reading: Reading,
    /// How it was solved.
    pub report: Report,
    /// What the pressure proves about itself.
    pub certificate: Certificate,
    /// Whether the counterbody slides.
    pub slides: bool,
    /// Convolutions on all grids, as equivalents of the finest one.
    pub convolutions: f64,
    /// Grid points along a₁ and a₂.
    pub points: [usize; 2],
    /// What is read of the contact of a topography.
    pub rough: Option<RoughReading>,
    /// What of the contact stands where the window of a topography is below 1, if it has one.
    pub tapered: Option<Tapered>,
    /// Largest stresses, where stresses are asked for and there is contact.
    pub stress: Option<StressReading>,
    /// What each criterion with a strength takes up, where there is contact.
    pub strength: Vec<Utilisation>,
    /// Wall time of the solution, the readings and the largest stresses, seconds, by the [clock](super::Recorder::clock)
    /// of the recorder; `None` where it has none.
    pub seconds: Option<f64>,
}

impl StepRecord {
    /// Of a step and what is read off it, without stresses and time.
    pub fn new(step: &Step, reading: Reading) -> Self {
        let Step { report, certificate, convolutions, .. } = *step;
        let rough = step.rough_reading(&reading);
        Self {
            reading,
            report,
            certificate,
            slides: step.problem().friction().is_some(),
            convolutions,
            points: step.grid().points(),
            rough,
            tapered: Tapered::of(step.finest()),
            stress: None,
            strength: Vec::new(),
            seconds: None,
        }
    }

    /// Adds to the steps of a path on a topography what only all of them tell: its stiffness.
    pub(super) fn add_stiffness(steps: &mut [Self]) {
        // What has not converged has no place on the path.
        let place = |step: &Self| match step.converged() {
            true => [step.reading.mean_pressure, step.reading.penetration],
            false => [f64::NAN; 2],
        };
        let path: Vec<[f64; 2]> = steps.iter().map(place).collect();
        for (step, found) in steps.iter_mut().zip(stiffness(&path)) {
            if let (Some(rough), Some([value, error])) = (&mut step.rough, found) {
                (rough.stiffness, rough.stiffness_error) = (Some(value), Some(error));
            }
        }
    }

    /// Adds its largest stresses, and what they take up of the strengths of a half-space.
    pub fn add_stress(&mut self, stress: StressReading, half_space: &HalfSpace) {
        self.strength = Utilisation::all(half_space, &stress);
        self.stress = Some(stress);
    }

    /// What it takes up of a criterion; `None` without contact, or a strength.
    pub fn utilisation(&self, criterion: Criterion) -> Option<&Utilisation> {
        self.strength.iter().find(|own| own.criterion == criterion)
    }

    /// What comes nearest to failure, with its rivals; `None` without contact, or strengths.
    pub fn governing(&self) -> Option<Governing<'_>> {
        Governing::of(&self.strength)
    }

    /// Whether the solution meets the tolerance. What is not a number compares as small as any, and does not.
    pub fn converged(&self) -> bool {
        self.report.stop.solved() && self.is_finite()
    }

    /// Whether it has converged as far as double precision carries, which is less far than the tolerance asks.
    pub fn is_at_rounding(&self) -> bool {
        self.report.stop == Stop::Rounding && self.is_finite()
    }

    /// Why the iteration ended.
    pub fn stop_reason(&self) -> String {
        if self.is_finite() { self.report.stop.to_string() } else { "not a number".to_owned() }
    }

    /// Whether contact is no wider than the grid's spacing.
    pub fn is_unresolved(&self) -> bool {
        self.report.stop == Stop::Unresolved && self.is_finite()
    }

    fn is_finite(&self) -> bool {
        let Reading { mean_pressure, penetration, max_pressure, .. } = self.reading;
        // Under a tip the pressure is infinite, whatever a grid says.
        let peak = if self.reading.singular() && !max_pressure.is_nan() { 0.0 } else { max_pressure };
        let scalars = [mean_pressure, penetration, peak, self.certificate.energy_gap];
        // Stresses are infinite under a tip.
        let stresses =
            self.stress.iter().flat_map(|s| [s.tau1().value, s.tension().value, s.mises().value, s.surface_error]);
        let taken = self.strength.iter().map(|utilisation| utilisation.value);
        let interfaces = self.stress.iter().flat_map(|stress| &stress.interfaces);
        let interfaces = interfaces.flat_map(|carried| [carried.normal.value, carried.shear.value]);
        let stresses = stresses.chain(taken).chain(interfaces);
        scalars.iter().all(|x| x.is_finite()) && !stresses.into_iter().any(f64::is_nan)
    }
}

/// How the contact with its traction was solved.
#[cfg(feature = "serde")]
#[derive(serde::Serialize)]
struct Sliding {
    /// See [`Report::outer`].
    outer_iterations: usize,
    /// ε of the whole problem, the traction's displacement included.
    residual: f64,
}

#[cfg(feature = "serde")]
impl serde::Serialize for StepRecord {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        use crate::spectral::Route;
        use serde::ser::SerializeStruct;
        let Self { reading, report, certificate, .. } = self;
        let mut keys = serializer.serialize_struct("step", 28)?;
        keys.serialize_field("mean_pressure", &reading.mean_pressure)?;
        keys.serialize_field("penetration", &reading.penetration)?;
        // Eq. (8): δ is measured from the mean plane of the deformed surface.
        keys.serialize_field("additional_displacement", &reading.penetration)?;
        keys.serialize_field("contact_fraction", &reading.contact_fraction)?;
        keys.serialize_field("elastic_energy", &reading.elastic_energy)?;
        keys.serialize_field("max_pressure", &reading.finite_peak())?;
        keys.serialize_field("singular", &reading.singular())?;
        keys.serialize_field("errors", &reading.errors)?;
        keys.serialize_field("converged", &self.converged())?;
        keys.serialize_field("stop_reason", &self.stop_reason())?;
        keys.serialize_field("route", report.route.name())?;
        keys.serialize_field("fell_back", &(report.route == Route::BaselineAfterStall))?;
        keys.serialize_field("trials", &report.route.trials())?;
        keys.serialize_field("iterations", &report.iterations)?;
        keys.serialize_field("convolutions", &self.convolutions)?;
        keys.serialize_field("residual", &report.residual)?;
        keys.serialize_field("certificate", certificate)?;
        keys.serialize_field("points", &self.points)?;
        keys.serialize_field("contact_spots", &reading.contact_spots)?;
        keys.serialize_field("spot_resolution", &reading.spot_resolution)?;
        keys.serialize_field("levels", &reading.levels)?;
        match &self.rough {
            Some(rough) => keys.serialize_field("rough", rough)?,
            None => keys.skip_field("rough")?,
        }
        match &self.tapered {
            Some(tapered) => keys.serialize_field("tapered", tapered)?,
            None => keys.skip_field("tapered")?,
        }
        if self.slides {
            let outer_iterations = report.outer;
            keys.serialize_field("friction", &Sliding { outer_iterations, residual: report.residual })?;
        } else {
            keys.skip_field("friction")?;
        }
        match &self.stress {
            Some(stress) => keys.serialize_field("stress", stress)?,
            None => keys.skip_field("stress")?,
        }
        if self.strength.is_empty() {
            keys.skip_field("strength")?;
        } else {
            keys.serialize_field("strength", &self.strength)?;
        }
        match self.governing() {
            Some(governing) => keys.serialize_field("governing", &governing)?,
            None => keys.skip_field("governing")?,
        }
        match self.seconds {
            Some(seconds) => keys.serialize_field("seconds", &seconds)?,
            None => keys.skip_field("seconds")?,
        }
        keys.end()
    }
}
