//! percoat from Python: the compiled module `percoat._core` of the package `percoat`.
//!
//! A dict becomes a case, and a record a dict with the keys that it has in the files of the command line, value by value; a field
//! becomes an array over the memory of its step. The classes that users see stand in `percoat/`.

mod case;
mod command;
mod compare;
mod errors;
mod half_space;
mod identify;
mod interior;
mod life;
mod limit;
mod materials;
mod progress;
mod quantities;
mod record;
mod row;
mod save;
mod solve;
mod step;
mod sweep;
mod tables;
mod value;
mod window;
mod work;

#[pyo3::pymodule]
mod _core {
    #[pymodule_export]
    use super::case::{Case, cases, explain, schema};
    #[pymodule_export]
    use super::command::main;
    #[pymodule_export]
    use super::compare::compare;
    #[pymodule_export]
    use super::errors::CaseError;
    #[pymodule_export]
    use super::half_space::HalfSpace;
    #[pymodule_export]
    use super::identify::identify;
    #[pymodule_export]
    use super::life::{life, life_text};
    #[pymodule_export]
    use super::limit::{limit, limit_text};
    #[pymodule_export]
    use super::materials::materials;
    #[pymodule_export]
    use super::progress::Progress;
    #[pymodule_export]
    use super::quantities::quantities;
    #[pymodule_export]
    use super::row::Row;
    #[pymodule_export]
    use super::save::{save_result, save_sweep};
    #[pymodule_export]
    use super::solve::{outcome_text, solve};
    #[pymodule_export]
    use super::step::{Step, step};
    #[pymodule_export]
    use super::sweep::{Sweep, columns, uncertainty};
    #[pymodule_export]
    use super::tables::{life_tables, limit_tables, outcome_tables};
    #[pymodule_export]
    use super::window::window;

    #[pymodule_init]
    fn init(module: &pyo3::Bound<'_, pyo3::types::PyModule>) -> pyo3::PyResult<()> {
        use pyo3::prelude::*;
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
