//! Parameters of a layered body from a measured indentation curve: force P and penetration δ of one indenter.
//!
//! The model is the isolated contact: δ(P) by the whole solver at a few loads, between which ln δ is interpolated over
//! ln P, and ∂δ/∂θ by one linear solve at each ([`Tangent`](crate::Tangent)). A zero that was missed by δ₀ and a frame of the
//! compliance C_f add δ₀ + C_f P. Least squares of the measured penetrations give the parameters, and their
//! covariance s²(JᵀJ)⁻¹ with s² the sum of squares over the degrees of freedom.
//!
//! From drawing off surfaces that adhere the parameters follow by least squares of the forces (`retraction`).
//!
//! From unloading the parameters follow by Oliver and Pharr's method with the layered body in place of the bare one (`unloading`).
//!
//! A parameter whose standard error exceeds [`MOST_UNCERTAIN`] of it, or of half the way between its bounds, is not stated: the curve does not contain it.

mod branches;
mod covariance;
mod curve;
mod doubt;
mod early;
mod error;
mod estimate;
mod fit;
mod least_squares;
mod measurement_error;
mod parameter;
mod pattern;
mod retraction;
mod search;
mod sensitivity;
mod student;
mod unloading;

pub use covariance::MOST_UNCERTAIN;
pub use curve::{CurveError, MOST_NODES};
pub use doubt::{Doubt, Missing};
pub use error::{IdentificationError, NoValue, Undetermined};
pub use estimate::Estimate;
pub use fit::Identification;
pub use measurement_error::MeasurementError;
pub use parameter::{Parameter, Quantity};
pub use pattern::{LEVEL, Pattern};
pub use retraction::{FromRetraction, Retraction, RetractionError};
pub use search::{Listener, Model, Trial};
pub use sensitivity::{NoDerivative, Sensitivity};
pub use unloading::{
    BareModulus, FromUnloading, NoContact, Punch, Unloading, UnloadingContact, UnloadingDoubt, UnloadingError,
    UnloadingModel,
};

/// A measured indentation curve, or several that are fitted together.
#[derive(Debug, Clone, PartialEq)]
pub struct Measurement {
    forces: Vec<f64>,
    penetrations: Vec<f64>,
    /// Standard deviation of each penetration; `None`: all alike, and unknown.
    deviations: Option<Vec<f64>>,
    /// Number of the points of each curve.
    lengths: Vec<usize>,
    instrument: Instrument,
}

/// Known additions of an instrument to penetrations: a zero that was missed by δ₀, and C_f P of a frame of the compliance C_f.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Instrument {
    /// δ₀, a length.
    pub offset: f64,
    /// C_f, a length per force.
    pub frame_compliance: f64,
}

impl Instrument {
    /// δ₀ + C_f P of a force P, a length.
    pub fn adds(&self, force: f64) -> f64 {
        self.offset + self.frame_compliance * force
    }
}

impl Measurement {
    /// Forces P > 0 (pressure times a length squared), penetrations δ (lengths), and their standard deviations where they are known.
    ///
    /// # Errors
    /// [`MeasurementError`] for other numbers of them, for values that are not so, and for unloading and holds.
    pub fn new(
        forces: Vec<f64>,
        penetrations: Vec<f64>,
        deviations: Option<Vec<f64>>,
    ) -> Result<Self, MeasurementError> {
        for other in [Some(&penetrations), deviations.as_ref()].into_iter().flatten() {
            if other.len() != forces.len() {
                return Err(MeasurementError::Unequal(forces.len(), other.len()));
            }
        }
        let is_size = |x: f64| x > 0.0 && x.is_finite();
        let first = |all: &[f64], is_good: &dyn Fn(f64) -> bool| all.iter().position(|&x| !is_good(x));
        if let Some(index) = first(&forces, &is_size) {
            return Err(MeasurementError::Force(index, forces[index]));
        }
        if let Some(index) = first(&penetrations, &f64::is_finite) {
            return Err(MeasurementError::Penetration(index, penetrations[index]));
        }
        if let Some((index, deviations)) = deviations.as_ref().and_then(|all| Some((first(all, &is_size)?, all))) {
            return Err(MeasurementError::Deviation(index, deviations[index]));
        }
        branches::check(&forces, &penetrations)?;
        let lengths = vec![forces.len()];
        Ok(Self { forces, penetrations, deviations, lengths, instrument: Instrument::default() })
    }

    /// Several curves, by the instrument of the first one.
    ///
    /// # Errors
    /// [`MeasurementError`] without any curve, and where the deviations of some are known and those of others are not.
    pub fn joined(curves: Vec<Self>) -> Result<Self, MeasurementError> {
        let mut curves = curves.into_iter();
        let mut joined = curves.next().ok_or(MeasurementError::NoCurve)?;
        for (number, curve) in (1..).zip(curves) {
            match (&mut joined.deviations, curve.deviations) {
                (Some(all), Some(more)) => all.extend(more),
                (None, None) => {}
                _ => return Err(MeasurementError::SomeDeviations(number)),
            }
            joined.forces.extend(curve.forces);
            joined.penetrations.extend(curve.penetrations);
            joined.lengths.extend(curve.lengths);
        }
        Ok(joined)
    }

    /// Number of the points of each curve, one curve after the other.
    pub fn lengths(&self) -> &[usize] {
        &self.lengths
    }

    /// Index of the curve of a point.
    pub fn curve_of(&self, point: usize) -> usize {
        let mut end = 0;
        let is_before = |length: &&usize| {
            end += **length;
            end <= point
        };
        self.lengths.iter().take_while(is_before).count()
    }

    /// The curve measured by an instrument whose zero and frame are known.
    #[must_use]
    pub fn with_instrument(self, instrument: Instrument) -> Self {
        Self { instrument, ..self }
    }

    /// Known additions of the instrument to the penetrations.
    pub fn instrument(&self) -> Instrument {
        self.instrument
    }

    /// Forces, a pressure times a length squared.
    pub fn forces(&self) -> &[f64] {
        &self.forces
    }

    /// Penetrations, lengths.
    pub fn penetrations(&self) -> &[f64] {
        &self.penetrations
    }

    /// Standard deviations of the penetrations, lengths; `None` where they are unknown.
    pub fn deviations(&self) -> Option<&[f64]> {
        self.deviations.as_deref()
    }
}
