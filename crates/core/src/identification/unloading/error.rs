//! Why a test has no stiffness of unloading.

use crate::notation::number;

/// Why a test has no stiffness of unloading.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum UnloadingError {
    /// Another number of penetrations, or of deviations, than of forces.
    #[error("{0} forces, but {1} penetrations or deviations: give one of each for every point")]
    Unequal(usize, usize),
    /// A force, penetration or deviation that is not finite, or a deviation that is not above 0.
    #[error("point {}: the {name} must be finite{}, not {}", .index + 1, if *.name == "standard deviation" { " and above 0" } else { "" }, number(*.value))]
    Value {
        /// Index of the point.
        index: usize,
        /// Name of the number.
        name: &'static str,
        /// The number.
        value: f64,
    },
    /// Bounds of the fitted part that are not two rising ones below 1.
    #[error(
        "the fitted part of the unloading lies between two parts of the largest force, 0 < low < high < 1, not {} and {}",
        number(.0[0]),
        number(.0[1])
    )]
    Part([f64; 2]),
    /// No force falls behind the largest one.
    #[error(
        "there is no unloading: behind the largest force {} no point lies below {} of it; give the whole test, in the order in which it was measured",
        number(*.largest),
        number(*.high)
    )]
    Missing {
        /// The largest force.
        largest: f64,
        /// Part of it from which on unloading is fitted.
        high: f64,
    },
    /// Too few points in the fitted part.
    #[error(
        "{count} points of the unloading lie between {} and {} of the largest force: {least} are needed at least; export more points, or fit a larger part",
        number(.part[0]),
        number(.part[1])
    )]
    Few {
        /// Points there are.
        count: usize,
        /// Fewest that are needed.
        least: usize,
        /// Bounds of the fitted part.
        part: [f64; 2],
    },
    /// A force that rises again.
    #[error(
        "points {} to {}: the force rises again from {} to {} during the unloading: give one unloading, not cycles",
        .from + 1, .to + 1, number(.forces[0]), number(.forces[1])
    )]
    Reloaded {
        /// Index of the point of the least force before it.
        from: usize,
        /// Index of the point of the largest force behind it.
        to: usize,
        /// Forces at both points.
        forces: [f64; 2],
    },
    /// A penetration that does not fall with the force.
    #[error(
        "points {} to {}: the penetration does not fall with the force, its slope is {}: in the unloading the body creeps or the instrument drifts \
         by more than it springs back; hold longer, or correct the drift",
        .from + 1, .to + 1, number(*.slope)
    )]
    Rises {
        /// Index of the first point of the fitted part.
        from: usize,
        /// Index of its last point.
        to: usize,
        /// dh/dP, a length per force.
        slope: f64,
    },
    /// No power law fits.
    #[error("the unloading is no power law P = B (h − h_f)^m: its fit does not converge; fit another part")]
    NoPowerLaw,
}
