//! The quantities of a load step as they are declared, for plots and datasets.

use percoat::run::declared;
use pyo3::prelude::*;

/// Key, name in words, kind of unit, and key of the error, `None` where it has none.
pub type Declared = (String, &'static str, &'static str, Option<String>);

/// Every quantity of a load step and of the records in its lists; keys have dots where they lead deeper.
#[pyfunction]
pub fn quantities() -> Vec<Declared> {
    let of = |(path, named): (&str, &'static percoat::quantity::Named)| {
        let (key, error) = named.keys(path);
        (key, named.name, named.kind.name(), error)
    };
    declared().into_iter().map(of).collect()
}
