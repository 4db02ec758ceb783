//! Faults of a measured curve.

use crate::notation::number;

/// Fault of a measured curve.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MeasurementError {
    /// Another number of penetrations, or of deviations, than of forces.
    #[error("{0} forces, but {1} penetrations or deviations: give one of each for every point")]
    Unequal(usize, usize),
    /// No curve.
    #[error("there is no curve: give one at least")]
    NoCurve,
    /// A curve whose deviations are known or unknown, unlike those of the first one.
    #[error("curve {}: standard deviations are there for some curves only: give those of all, or of none", .0 + 1)]
    SomeDeviations(usize),
    /// A force that is not above 0.
    #[error("point {}: the force must be above 0 and finite, not {}", .0 + 1, number(*.1))]
    Force(usize, f64),
    /// A penetration that is not finite.
    #[error("point {}: the penetration must be finite, not {}", .0 + 1, number(*.1))]
    Penetration(usize, f64),
    /// A force that falls.
    #[error(
        "points {} to {}: the force falls from {} to {}: unloading is not to be fitted, what has yielded stays behind; give the loading alone, \
         by rising force where the points are in no order of time",
        .from + 1, .to + 1, number(.forces[0]), number(.forces[1])
    )]
    Unloading {
        /// Index of the point of the largest force before it.
        from: usize,
        /// Index of the point of the least force behind it.
        to: usize,
        /// Forces at both points.
        forces: [f64; 2],
    },
    /// A penetration that changes under one force.
    #[error(
        "points {} to {}: the penetration changes by {} while the force stays at {}: in a hold the body creeps, or the instrument drifts; \
         leave these points out",
        .from + 1, .to + 1, number(*.by), number(*.force)
    )]
    Hold {
        /// Index of its first point.
        from: usize,
        /// Index of its last point.
        to: usize,
        /// The force.
        force: f64,
        /// The change, a length.
        by: f64,
    },
    /// A deviation that is not above 0.
    #[error("point {}: the standard deviation must be above 0 and finite, not {}", .0 + 1, number(*.1))]
    Deviation(usize, f64),
}
