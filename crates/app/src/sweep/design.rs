//! Uncertain keys of a case with their distributions, and how many samples of them a sweep takes.

use super::axis::plain;
use serde::{Deserialize, Serialize};
use std::fmt;

/// Distribution of an uncertain number.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(tag = "distribution", rename_all = "snake_case")]
pub enum Distribution {
    /// Every value between two is as likely.
    Uniform {
        /// Lowest value.
        from: f64,
        /// Highest value.
        to: f64,
    },
    /// The normal distribution.
    Normal {
        /// Mean.
        mean: f64,
        /// Standard deviation.
        deviation: f64,
    },
}

/// An uncertain key of a case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Varied {
    /// The key as in the case file.
    pub key: String,
    /// Distribution of its values, in the unit of the case.
    #[serde(flatten)]
    pub distribution: Distribution,
}

/// The samples of a sweep over uncertain keys.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Design {
    /// The uncertain keys.
    pub keys: Vec<Varied>,
    /// Number of samples N, a power of 2.
    pub samples: usize,
    /// Seed of the scrambled sequence.
    pub seed: u32,
}

impl fmt::Display for Distribution {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Uniform { from, to } => write!(f, "{} to {}", plain(from), plain(to)),
            Self::Normal { mean, deviation } => write!(f, "normal, {} ± {}", plain(mean), plain(deviation)),
        }
    }
}

impl Design {
    /// Number of combinations of a sample.
    pub fn block(&self) -> usize {
        self.keys.len() + 2
    }

    /// Number of all combinations.
    pub fn count(&self) -> usize {
        self.samples * self.block()
    }
}
