//! How far a computation is, for the callable that wants to know.

use pyo3::prelude::*;

/// How far a computation is.
#[pyclass(frozen, skip_from_py_object, module = "percoat._core")]
#[derive(Debug, Clone)]
pub struct Progress {
    /// What is counted: `step` or `combination`; `load` where the end is not known.
    #[pyo3(get)]
    pub unit: &'static str,
    /// How many are done.
    #[pyo3(get)]
    pub done: usize,
    /// Of how many; 0 where that is not known.
    #[pyo3(get)]
    pub of: usize,
    /// The grid that is worked on, points along a₁ and a₂; `None` for a sweep.
    #[pyo3(get)]
    pub points: Option<(usize, usize)>,
    /// Iterations so far on it.
    #[pyo3(get)]
    pub iteration: usize,
    /// ε of the last one.
    #[pyo3(get)]
    pub residual: f64,
    /// What goes on right now, in words.
    #[pyo3(get)]
    pub phase: String,
    /// Wall time so far.
    #[pyo3(get)]
    pub seconds: f64,
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
