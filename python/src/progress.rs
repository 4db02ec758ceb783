//! Progress of a computation, the argument of the callable `progress`.

use pyo3::prelude::*;

/// Progress of a computation.
#[pyclass(frozen, skip_from_py_object, module = "percoat._core")]
#[derive(Debug, Clone)]
pub struct Progress {
    /// Counted things: `step`, `combination` or `part`; `load` or `trial` where their number is not known.
    #[pyo3(get)]
    pub unit: &'static str,
    /// Number of those that are done.
    #[pyo3(get)]
    pub done: usize,
    /// Number of all; 0 where it is not known.
    #[pyo3(get)]
    pub of: usize,
    /// Points of the present grid along a₁ and a₂; `None` for a sweep, a search for parameters, and before the first contact of a life.
    #[pyo3(get)]
    pub points: Option<(usize, usize)>,
    /// Iterations so far on that grid.
    #[pyo3(get)]
    pub iteration: usize,
    /// ε of the last iteration; NaN before the first.
    #[pyo3(get)]
    pub residual: f64,
    /// The present phase in words.
    #[pyo3(get)]
    pub phase: String,
    /// Wall time so far, seconds.
    #[pyo3(get)]
    pub seconds: f64,
}

impl Progress {
    /// Progress in this phase, with nothing done, iterated or timed, and neither grid nor number of all known.
    pub fn new(unit: &'static str, phase: String) -> Self {
        Self { unit, done: 0, of: 0, points: None, iteration: 0, residual: f64::NAN, phase, seconds: 0.0 }
    }
}

#[pymethods]
impl Progress {
    fn __str__(&self) -> String {
        let mut parts = Vec::new();
        match self.of {
            0 => {}
            of if self.done == of => parts.push(format!("{of} of {of} {}s", self.unit)),
            of => parts.push(format!("{} {} of {of}", self.unit, self.done + 1)),
        }
        parts.extend(self.points.map(|(n1, n2)| format!("{n1} × {n2} samples")));
        parts.extend(Some(self.phase.clone()).filter(|phase| !phase.is_empty()));
        parts.push(format!("{:.1} s", self.seconds));
        parts.join(", ")
    }

    fn __repr__(&self) -> String {
        format!("<percoat.Progress: {}>", self.__str__())
    }
}
