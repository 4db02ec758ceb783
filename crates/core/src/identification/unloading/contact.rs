//! The contact at the largest force of an unloading: its depth and radius, and the stiffness of the bodies there.

use super::punch::Punch;
use super::record::Unloading;
use crate::counterbody::Shape;
use crate::identification::Instrument;
use crate::notation::number;
use crate::problem::Problem;
use std::fmt;

/// Passes in which ε and the contact radius follow from each other, at most.
const PASSES: usize = 20;
/// Change of ε at which they end.
const CLOSE: f64 = 1e-10;
/// ε of a paraboloid on bare bodies.
const BARE: f64 = 0.75;
/// Part of S and of a contact depth by which they are varied in difference quotients.
const STEP: f64 = 1e-4;

/// A model of unloadings: the problem at values of its parameters, and what else the stiffness depends on.
pub struct UnloadingModel<'a, E> {
    /// The problem of one indenter alone at the values, in the order of the parameters; the error refuses values.
    pub problem: &'a (dyn Fn(&[f64]) -> Result<Problem, E> + Sync),
    /// Known additions of the instrument to the penetrations.
    pub instrument: Instrument,
    /// β, by which the stiffness of a tip that is not round exceeds that of the round one of its area: 1.034 of a triangle (King, Int. J.
    /// Solids Struct. 23 (1987) 1657).
    pub beta: f64,
}

impl<E> fmt::Debug for UnloadingModel<'_, E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { instrument, beta, .. } = self;
        f.debug_struct("UnloadingModel").field("instrument", instrument).field("beta", beta).finish_non_exhaustive()
    }
}

/// Why an unloading has no contact in a model.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NoContact {
    /// A frame that is more compliant than the unloading.
    #[error(
        "unloading {}: the compliance of the frame, {}, is not below that of the unloading, {}: state a smaller one",
        .curve + 1, number(*.frame), number(*.whole)
    )]
    Frame {
        /// Index of the unloading.
        curve: usize,
        /// C_f, a length per force.
        frame: f64,
        /// 1/S that was measured, a length per force.
        whole: f64,
    },
    /// A contact depth that is not above 0.
    #[error(
        "unloading {}: the contact depth h − ε P/S is {}, not above 0: look for a wrong zero of the penetration or wrong units, or fit another \
         part of the unloading",
        .curve + 1, number(*.depth)
    )]
    Depth {
        /// Index of the unloading.
        curve: usize,
        /// h_c, a length.
        depth: f64,
    },
    /// A contact depth beyond the equator of a sphere.
    #[error("unloading {}: the contact depth {} reaches the equator of the sphere: its area is not known there", .curve + 1, number(*.depth))]
    Tip {
        /// Index of the unloading.
        curve: usize,
        /// h_c, a length.
        depth: f64,
    },
    /// Layers so thin that the contact is not computed.
    #[error("unloading {}: the stiffness of the contact of the radius {} is not computed: its layers are too thin for it", .curve + 1, number(*.radius))]
    Unsolved {
        /// Index of the unloading.
        curve: usize,
        /// Contact radius, a length.
        radius: f64,
    },
}

/// The modulus by Oliver and Pharr's formula, as of a bare body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BareModulus {
    /// Reduced modulus E_r = √π S/(2β√A) with ε = 3/4, a pressure.
    pub reduced: f64,
    /// Standard error of E_r, a pressure.
    pub error: f64,
    /// Young's modulus of the body with Poisson's ratio of the surface, without the compliance of the indenter, a pressure; `None` where that is
    /// all of it.
    pub young: Option<f64>,
}

/// Measured unloading beside a model of it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Measured<'a> {
    pub curve: usize,
    pub unloading: &'a Unloading,
    pub instrument: Instrument,
    pub beta: f64,
}

/// The contact at the largest force, in a model.
#[derive(Debug, Clone, Copy)]
pub(super) struct Contact {
    pub epsilon: f64,
    /// h_c and a, lengths.
    pub depth: f64,
    pub radius: f64,
    /// dP/dh of the model with its frame, a force per length.
    pub stiffness: f64,
    /// Estimated relative error of the stiffness.
    pub error: f64,
}

impl Measured<'_> {
    /// S of the contact alone, by that with the frame.
    pub fn without_frame(&self, stiffness: f64) -> Result<f64, NoContact> {
        let (frame, whole) = (self.instrument.frame_compliance, 1.0 / stiffness);
        if whole <= frame {
            return Err(NoContact::Frame { curve: self.curve, frame, whole });
        }
        Ok(1.0 / (whole - frame))
    }

    /// h_c and a with a given ε, for a penetration h and S of the contact.
    fn section(&self, shape: &Shape, epsilon: f64, [h, stiffness]: [f64; 2]) -> Result<[f64; 2], NoContact> {
        let (curve, force) = (self.curve, self.unloading.force);
        let depth = h - self.instrument.adds(force) - epsilon * force / stiffness;
        if depth.is_nan() || depth <= 0.0 {
            return Err(NoContact::Depth { curve, depth });
        }
        let radius = shape.section_radius(depth).ok_or(NoContact::Tip { curve, depth })?;
        Ok([depth, radius])
    }

    /// The contact for h and S as measured, or beside what was measured; the search begins with an ε.
    pub fn contact(&self, problem: &Problem, [h, stiffness]: [f64; 2], mut epsilon: f64) -> Result<Contact, NoContact> {
        let of_contact = self.without_frame(stiffness)?;
        let shape = problem.levels().first().map(|level| level.shape());
        let shape = shape.expect("a problem of one indenter alone");
        let mut passes = 0..PASSES;
        loop {
            let [depth, radius] = self.section(shape, epsilon, [h, of_contact])?;
            let punch = Punch::new(problem.bodies(), radius);
            if !(punch.stiffness.is_finite() && punch.epsilon.is_finite()) {
                return Err(NoContact::Unsolved { curve: self.curve, radius });
            }
            if (punch.epsilon - epsilon).abs() < CLOSE || passes.next().is_none() {
                let stiffness = 1.0 / (1.0 / (self.beta * punch.stiffness) + self.instrument.frame_compliance);
                return Ok(Contact { epsilon, depth, radius, stiffness, error: punch.error });
            }
            epsilon = punch.epsilon;
        }
    }

    /// Measured penetration h and stiffness S.
    pub fn values(&self) -> [f64; 2] {
        [self.unloading.penetration, self.unloading.stiffness]
    }

    /// Standard error of a number of h and S by those of both.
    pub fn error_of<X>(&self, of: impl Fn([f64; 2]) -> Result<f64, X>) -> Result<f64, X> {
        let [h, stiffness] = self.values();
        let steps = [STEP * self.unloading.force / stiffness, STEP * stiffness];
        let errors = [self.unloading.scatter, self.unloading.stiffness_error];
        let mut square = 0.0;
        for k in 0..2 {
            let at = |by: f64| of([h + if k == 0 { by } else { 0.0 }, stiffness + if k == 1 { by } else { 0.0 }]);
            let slope = (at(steps[k])? - at(-steps[k])?) / (2.0 * steps[k]);
            square += (slope * errors[k]).powi(2);
        }
        Ok(square.sqrt())
    }

    /// The modulus by the formula for bare bodies.
    pub fn bare(&self, problem: &Problem) -> Result<BareModulus, NoContact> {
        let shape = problem.levels().first().map(|level| level.shape());
        let shape = shape.expect("a problem of one indenter alone");
        let at = |[h, stiffness]: [f64; 2]| {
            let stiffness = self.without_frame(stiffness)?;
            let [_, radius] = self.section(shape, BARE, [h, stiffness])?;
            Ok(stiffness / (2.0 * self.beta * radius))
        };
        let reduced = at(self.values())?;
        let indenter =
            problem.bodies().counterbody().map_or(0.0, |body| 1.0 / body.surface_material().contact_modulus());
        let poisson = problem.bodies().body().surface_material().poisson();
        let young = Some((1.0 - poisson * poisson) / (1.0 / reduced - indenter)).filter(|young| *young > 0.0);
        Ok(BareModulus { reduced, error: self.error_of(at)?, young })
    }
}
