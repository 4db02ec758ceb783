//! The record of a load step: every scalar of it, written to `summary.json` and read back.

use super::Tapered;
use crate::body::Bodies;
use crate::kind::ContactKind;
use crate::numeric::serialised;
use crate::problem::Problem;
use crate::quantity::quantities;
use crate::reading::{
    AdhesionReading, Beneath, CreepReading, Criterion, FatigueReading, Governing, HysteresisReading, PathReading,
    PlasticReading, Reading, RoughReading, SlipReading, StressReading, TemperatureReading, Utilisation, stiffness,
    within_the_errors,
};
use crate::spectral::{Certificate, Report, Route, Step, Stop};
use serde::{Deserialize, Serialize};

quantities! {
    /// Every scalar of a load step.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
    pub struct StepRecord {
        /// Loads, penetration, pressures, contact areas and radii with their errors.
        #[serde(flatten)]
        pub reading: Reading,
        /// Why the iteration ended.
        #[serde(flatten, with = "with_verdict")]
        pub stop: Stop,
        /// Route of the iteration to the solution.
        #[serde(flatten)]
        pub route: Route,
        /// Iterations of all methods and trials on the finest grid.
        pub iterations: usize,
        /// Convolutions on all grids, as equivalents of the finest one.
        pub convolutions: f64,
        /// ε = Σ p|g| / (δ Σp) of the last iterate.
        #[serde(deserialize_with = "serialised::number")]
        pub residual: f64,
        /// Bounds on the error of the pressure.
        pub certificate: Certificate,
        /// Grid points along a₁ and a₂.
        pub points: [usize; 2],
        /// Contact stiffness S = ∂P/∂δ of an isolated contact, a force per length; `None` in a periodic cell, without contact, and under
        /// friction that couples.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub contact_stiffness: Option<f64> = Stiffness "contact stiffness" "∂P/∂δ" error contact_stiffness_error,
        /// Estimated error of the contact stiffness, a force per length.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub contact_stiffness_error: Option<f64>,
        /// Areas, spots, gap and stiffness of a topography; `None` for indenters.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub rough: Option<RoughReading>,
        /// Parts of load and contact where the window of a topography is below 1; `None` without a window.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub tapered: Option<Tapered>,
        /// Permanent indentation of the softer surface under its hardness; `None` without hardness.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub plastic: Option<PlasticReading>,
        /// Pressure above the hardness of a material beneath the surface; `None` where none is exceeded.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub beneath: Option<Beneath>,
        /// How contact and traction were solved together; `None` without friction.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub friction: Option<Sliding>,
        /// Partial slip; `None` where nothing sticks.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub tangential: Option<SlipReading>,
        /// Adhesion; `None` of surfaces that do not pull each other.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub adhesion: Option<AdhesionReading>,
        /// Friction by hysteresis; `None` at rest, and where nothing relaxes.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub hysteresis: Option<HysteresisReading>,
        /// Temperatures by frictional heat; `None` where nothing heats.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub temperature: Option<TemperatureReading>,
        /// Time of bodies that creep; `None` where nothing depends on time.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub creep: Option<CreepReading>,
        /// Largest stresses; `None` where they are not computed, without contact, and under loads of a search for limits that are not shown.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub stress: Option<StressReading>,
        /// Utilisation of each criterion with a strength; empty without contact.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        pub strength: Vec<Utilisation>,
        /// The criterion nearest to failure, with its rivals; `None` without contact or strengths.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub governing: Option<Governing>,
        /// Passes until the first damage of each material and interface with a law of fatigue; `None` without contact or laws, and under loads
        /// of a search for limits that are not shown.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub fatigue: Option<FatigueReading>,
        /// Wall time of the solution, the readings and the largest stresses, seconds, by the [clock](super::Recorder::clock)
        /// of the recorder; `None` where it has none.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub seconds: Option<f64>,
    }
    table StepQuantities as STEP;
}

/// How contact and traction were solved together.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Sliding {
    /// Number of times the gap was recomputed under the traction of the pressure; 0 where friction is not coupled.
    pub outer_iterations: usize,
    /// ε of the whole problem, the displacement by the traction included.
    #[serde(deserialize_with = "serialised::number")]
    pub residual: f64,
}

/// Why an iteration ended, with `converged` beside it, which follows from that.
mod with_verdict {
    use crate::spectral::Stop;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    #[derive(Serialize, Deserialize)]
    struct Keys {
        #[serde(skip_deserializing)]
        converged: bool,
        stop_reason: Stop,
    }

    pub fn serialize<S: Serializer>(stop: &Stop, keys: S) -> Result<S::Ok, S::Error> {
        Keys { converged: stop.solved(), stop_reason: *stop }.serialize(keys)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(keys: D) -> Result<Stop, D::Error> {
        Ok(Keys::deserialize(keys)?.stop_reason)
    }
}

impl StepRecord {
    /// The record of a step and its reading, without stresses and time.
    pub fn new(step: &Step, reading: Reading) -> Self {
        let Step { report, certificate, convolutions, .. } = *step;
        let rough = step.rough_reading(&reading);
        let beneath = Beneath::of(step.problem(), &reading, step.grid().points());
        let sliding = Sliding { outer_iterations: report.outer, residual: report.residual };
        let plastic =
            PlasticReading::of(step).map(|plastic| plastic.with_error_of_depth(step, reading.errors.penetration));
        let record = Self {
            reading,
            stop: report.stop,
            route: report.route,
            iterations: report.iterations,
            convolutions,
            residual: report.residual,
            certificate,
            points: step.grid().points(),
            contact_stiffness: None,
            contact_stiffness_error: None,
            rough,
            tapered: Tapered::of(step.finest()),
            plastic,
            beneath,
            friction: step.problem().friction().map(|_| sliding),
            tangential: None,
            adhesion: None,
            hysteresis: HysteresisReading::of(step),
            temperature: TemperatureReading::of(step),
            creep: None,
            stress: None,
            strength: Vec::new(),
            governing: None,
            fatigue: None,
            seconds: None,
        };
        record.judged()
    }

    /// The record with the contact stiffness of its step and its error.
    #[must_use]
    pub(super) fn with_stiffness(self, stiffness: Option<[f64; 2]>) -> Self {
        let [contact_stiffness, contact_stiffness_error] = [0, 1].map(|index| stiffness.map(|pair| pair[index]));
        Self { contact_stiffness, contact_stiffness_error, ..self }
    }

    /// The record with partial slip.
    #[must_use]
    pub(crate) fn with_slip(self, slip: SlipReading) -> Self {
        // Why the normal contact is not solved says more.
        let stop = if slip.converged || !self.stop.solved() { self.stop } else { Stop::IterationLimit };
        Self { tangential: Some(slip), stop, ..self }
    }

    /// The record with adhesion.
    #[must_use]
    pub(super) fn with_adhesion(self, adhesion: Option<AdhesionReading>) -> Self {
        Self { adhesion, ..self }
    }

    /// The record with its time.
    #[must_use]
    pub(super) fn with_creep(self, creep: CreepReading) -> Self {
        Self { creep: Some(creep), ..self }
    }

    /// Whether anything acts on the bodies.
    pub(super) fn is_loaded(&self) -> bool {
        self.reading.max_pressure > 0.0 || self.adhesion.as_ref().is_some_and(|adhesion| adhesion.adhesive_load > 0.0)
    }

    /// Adds the stiffness dp̄/dδ of topographies, which depends on all steps of a path; of an isolated contact dP/dδ, where its
    /// tangent has not given it.
    pub(super) fn add_stiffness(steps: &mut [Self]) {
        // Steps that have not converged are left out.
        let place = |step: &Self| {
            let Reading { mean_pressure, force, penetration, .. } = step.reading;
            let load = mean_pressure.unwrap_or(force);
            if step.converged() { [load, penetration] } else { [f64::NAN; 2] }
        };
        // Of surfaces that adhere, and of bodies that creep, a load has several penetrations.
        if steps.iter().any(|step| step.adhesion.is_some() || step.creep.is_some()) {
            return;
        }
        let path: Vec<[f64; 2]> = steps.iter().map(place).collect();
        for (step, found) in steps.iter_mut().zip(stiffness(&path)) {
            let is_wanted = step.contact_stiffness.is_none();
            if let (Some(rough), Some([value, error])) = (step.rough.as_mut().filter(|_| is_wanted), found) {
                (rough.stiffness, rough.stiffness_error) = (Some(value), Some(error));
            }
        }
    }

    /// The record with its largest stresses, and the utilisations of the strengths of the bodies.
    #[must_use]
    pub fn with_stress(self, stress: StressReading, bodies: &Bodies) -> Self {
        let strength = Utilisation::all(bodies, &stress);
        Self { stress: Some(stress), ..self }.with_utilisations(strength)
    }

    /// The record with the utilisations of the strengths of the bodies.
    #[must_use]
    pub(super) fn with_utilisations(self, strength: Vec<Utilisation>) -> Self {
        Self { governing: Governing::of(&strength), strength, ..self }.judged()
    }

    /// The record with what the stresses along the path of sliding of a problem say: lives, those by strain among them, and utilisations of
    /// endurance limits behind those of the strengths.
    #[must_use]
    pub(super) fn with_path(self, path: PathReading, problem: &Problem) -> Self {
        let fatigue = FatigueReading::with_strains(path.fatigue, problem, &self.strength);
        self.with_cycle(PathReading { fatigue, ..path })
    }

    /// The record with lives and utilisations of endurance limits of a cycle in which points stay in place; lives by strain are those of a pass.
    #[must_use]
    pub(super) fn with_cycle(self, PathReading { fatigue, utilisations, .. }: PathReading) -> Self {
        let strength = [&self.strength[..], &utilisations].concat();
        Self { fatigue, ..self }.with_utilisations(strength)
    }

    /// The utilisation of a criterion; `None` without contact, or a strength.
    pub fn utilisation(&self, criterion: Criterion) -> Option<&Utilisation> {
        self.strength.iter().find(|utilisation| utilisation.criterion == criterion)
    }

    /// The governing criterion in words, numbers and errors formatted by `format`: "yield of material 2 has the utilisation 0.93 ± 0.02, or
    /// cracking of material 1 within the errors"; `None` without contact or strengths.
    pub fn governing_in_words(&self, format: impl Fn(f64, Option<f64>) -> String) -> Option<String> {
        let Governing { criterion, rivals, .. } = self.governing.as_ref()?;
        let Utilisation { value, error, .. } = *self.utilisation(*criterion)?;
        let taken = if value.is_infinite() { "∞".to_owned() } else { format(value, error) };
        Some(format!("{criterion} has the utilisation {taken}{}", within_the_errors(rivals)))
    }

    /// Whether the solution meets the tolerance, or as far as double precision carries, and every number of it is finite.
    pub fn converged(&self) -> bool {
        self.stop.solved()
    }

    /// Kind of the contact.
    pub fn kind(&self) -> ContactKind {
        ContactKind { surroundings: self.reading.surroundings(), is_given: self.route == Route::Given }
    }

    /// How the solution was reached.
    pub fn report(&self) -> Report {
        let outer = self.friction.map_or(0, |friction| friction.outer_iterations);
        Report { stop: self.stop, route: self.route, iterations: self.iterations, outer, residual: self.residual }
    }

    /// The record with [`Stop::NotANumber`] where a number of it is not finite.
    fn judged(mut self) -> Self {
        if !self.is_finite() {
            self.stop = Stop::NotANumber;
        }
        self
    }

    fn is_finite(&self) -> bool {
        let Reading { force, penetration, .. } = self.reading;
        // Under a tip the pressure is infinite, also where that of the grid is finite.
        let scalars = [force, penetration, self.reading.grid_peak(), self.certificate.energy_gap];
        // Stresses are infinite under a tip.
        let stresses = self
            .stress
            .iter()
            .flat_map(|stress| stress.overall.peaks().map(|peak| peak.value).chain([stress.surface_error]));
        let utilisations = self.strength.iter().map(|utilisation| utilisation.value);
        let interfaces = self.stress.iter().flat_map(|stress| &stress.interfaces);
        let interfaces = interfaces.flat_map(|carried| carried.peaks().map(|peak| peak.value));
        let ranges = self.fatigue.iter().flat_map(|fatigue| fatigue.lives.iter().map(|life| life.range));
        let stresses = stresses.chain(utilisations).chain(interfaces).chain(ranges);
        scalars.iter().all(|x| x.is_finite()) && !stresses.into_iter().any(f64::is_nan)
    }
}
