//! Which method iterates, and how far.

/// Which conjugate-gradient method.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "kebab-case"))]
#[non_exhaustive]
pub enum Method {
    /// Preconditioned with C⁻¹ between the active set and its surroundings: iterations do not grow with the grid.
    #[default]
    Preconditioned,
    /// Polonsky & Keer, Wear 231 (1999) 206. For a symmetric operator: under coupled friction it stalls.
    PolonskyKeer,
}

/// Dimensionless tolerance and limits.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Settings {
    /// Which method starts; the preconditioned one falls back to the other when it stalls, unless friction is coupled.
    pub method: Method,
    /// Bound on ε, greater than 0; the energy gap of a converged solution is below 20 times it, the deepest penetration
    /// outside contact below 10 times it and δ. What is not greater than 0 is never reached.
    pub tolerance: f64,
    /// Largest number of iterations on one grid.
    pub max_iterations: usize,
}

impl Default for Settings {
    fn default() -> Self {
        Self { method: Method::default(), tolerance: 1e-8, max_iterations: 10_000 }
    }
}
