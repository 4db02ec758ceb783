//! Heights as a file holds them, and what can be wrong with any of them.

use super::super::keys::CARRIED;
use super::super::node::plain;
use super::super::resources::bytes;
use super::super::room::available_memory;

/// Most samples along a cell vector.
pub(super) const MOST: usize = 32_768;

/// Heights of one period of a surface.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::case) struct Heights {
    /// Samples along a₁ and a₂.
    pub(in crate::case) points: [usize; 2],
    /// Protrusion upward at each sample, n₁ × n₂ values, a₂ fastest.
    pub(in crate::case) values: Vec<f64>,
}

/// Why a file is refused, without its name and that of the key.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::case) struct Fault {
    pub(super) what: String,
    /// Stands at the excerpt of the case.
    pub(super) label: String,
    pub(super) help: Option<String>,
}

impl Fault {
    pub(super) fn new(what: impl Into<String>, label: impl Into<String>) -> Self {
        Self { what: what.into(), label: label.into(), help: None }
    }

    /// What to do about it.
    pub(super) fn help(self, help: impl Into<String>) -> Self {
        Self { help: Some(help.into()), ..self }
    }

    /// What stands at the excerpt.
    pub(super) fn label(self) -> String {
        self.label
    }

    pub(super) fn unreadable(error: &std::io::Error) -> Self {
        Self::new(format!("cannot be read: {error}"), "this file")
    }
}

impl Heights {
    /// Of n₁ × n₂ samples, each a number that double precision carries.
    pub(super) fn new(points: [usize; 2], values: Vec<f64>) -> Result<Self, Fault> {
        let [n1, n2] = points;
        if points.iter().any(|n| !(2..=MOST).contains(n)) {
            let what = format!("holds {n1} × {n2} heights; there must be between 2 and {MOST} along either direction");
            return Err(Fault::new(what, format!("{n1} × {n2} heights")));
        }
        match values.iter().position(|height| height.is_nan() || height.abs() > *CARRIED.end()) {
            None => Ok(Self { points, values }),
            Some(k) => Err(Fault::new(
                format!("holds {} at [{}, {}]", plain(values[k]), k / n2, k % n2),
                "every height must be finite and at most 1e60",
            )
            .help("fill what was not measured before, as from its neighbours")),
        }
    }
}

/// Refuses what takes more memory than there is.
pub(in crate::case) fn fits(needed: u64) -> Result<(), Fault> {
    let room = available_memory();
    if needed <= room {
        return Ok(());
    }
    let what = format!("takes about {} of memory to read, and {} are available", bytes(needed), bytes(room));
    Err(Fault::new(what, "too large"))
}
