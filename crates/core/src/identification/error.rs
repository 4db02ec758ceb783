//! Why parameters are not found.

use super::curve::CurveError;
use super::unloading::NoContact;
use crate::notation::number;
use std::fmt;

/// Why parameters are not found.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum IdentificationError<E> {
    /// The values of the start are refused.
    #[error("{0}")]
    Model(E),
    /// The model has no indentation curve.
    #[error(transparent)]
    Curve(#[from] CurveError),
    /// An unloading has no contact at the values of the start.
    #[error(transparent)]
    Contact(NoContact),
    /// Fewer unloadings than parameters.
    #[error(
        "{curves} {} not determine {parameters} parameters: as many unloadings as parameters are needed, from different largest forces",
        if *.curves == 1 { "unloading does" } else { "unloadings do" }
    )]
    TooFewUnloadings {
        /// Unloadings there are.
        curves: usize,
        /// Parameters to be found.
        parameters: usize,
    },
    /// Too few points: no more than parameters.
    #[error("{points} points do not determine {parameters} parameters: more points than parameters are needed")]
    TooFew {
        /// Points of the curve.
        points: usize,
        /// Parameters to be found.
        parameters: usize,
    },
    /// A parameter on which penetrations do not depend.
    #[error("{0} has no influence on what was measured: it cannot be found from that")]
    NoInfluence(String),
    /// The search ends where the model has no values beside those of the last step.
    #[error(
        "the search for the parameters does not converge, start nearer to them or free fewer: at its next values {0}"
    )]
    Refused(NoValue<E>),
    /// The search does not end.
    #[error("the search for the parameters does not converge: start nearer to them, or free fewer")]
    NotConverged,
    /// The curve does not contain a parameter.
    #[error("{0}")]
    Undetermined(Undetermined),
    /// The listener has stopped the search.
    #[error("stopped before its end")]
    Stopped,
}

/// Why a model has no penetrations at values of its parameters.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NoValue<E> {
    /// The model refuses the values.
    #[error("the model is refused: {0}")]
    Model(E),
    /// The model has no indentation curve, or a load of it is not solved.
    #[error(transparent)]
    Curve(#[from] CurveError),
    /// An unloading has no contact.
    #[error(transparent)]
    Contact(#[from] NoContact),
    /// A trial value of a parameter lies outside of its bounds, or a thousand times from its start; a sentence.
    #[error("{0}")]
    Outside(String),
    /// The listener has stopped the search.
    #[error("the search is stopped")]
    Stopped,
}

impl<E> NoValue<E> {
    /// The error of a search whose start has no value.
    pub(super) fn at_the_start(self) -> IdentificationError<E> {
        match self {
            Self::Model(error) => IdentificationError::Model(error),
            Self::Curve(error) => IdentificationError::Curve(error),
            Self::Contact(error) => IdentificationError::Contact(error),
            Self::Stopped => IdentificationError::Stopped,
            Self::Outside(_) => IdentificationError::Refused(self),
        }
    }
}

/// A parameter that the curve does not contain.
#[derive(Debug, Clone, PartialEq)]
pub struct Undetermined {
    /// Name of the parameter.
    pub name: String,
    /// Value of the parameter.
    pub value: f64,
    /// Standard error of the value; infinite where parameters cannot be told apart.
    pub error: f64,
    /// The parameter that it is mixed up with, and their correlation.
    pub mixed: Option<(String, f64)>,
    /// Contact radii of the fit, lengths.
    pub radii: [f64; 2],
    /// Whether the search was given up at its first values.
    pub at_start: bool,
}

impl fmt::Display for Undetermined {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, value, error, mixed, radii: [least, most], at_start } = self;
        if *at_start {
            f.write_str("at the first values of the search, by the scatter of the points, ")?;
        }
        if error.is_finite() {
            write!(f, "the curve does not determine {name}: {} ± {}", number(*value), number(*error))?;
        } else {
            write!(f, "the curve does not determine {name}")?;
        }
        if let Some((other, correlation)) = mixed {
            write!(f, ", it cannot be told from {other} (correlation {correlation:.3})")?;
        }
        write!(
            f,
            "; give one of them a known value, or measure where it matters: contact radii are {} to {} here",
            number(*least),
            number(*most)
        )
    }
}
