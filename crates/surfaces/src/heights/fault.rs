//! Heights of a file, and its faults.

use percoat_common::machine::{available_memory, bytes};
use percoat_common::plain;
use percoat_common::unit::CARRIED;

/// Advice where numbers stand for missing measurements, for files of every format.
pub const MARK: &str = "mark places without a measurement: by nan in a text or an array, otherwise in the program that wrote the file; they are \
                        filled from what surrounds them, with a warning";

/// Way through another program, for formats and versions that are not read.
pub const ELSEWHERE: &str =
    "where Gwyddion or the instrument's program opens it, save it there as .gwy, or as points x y z in a text, .xyz";

/// Advice where a file holds a profile.
pub const PROFILE: &str = "a profile is no surface: give a measured area; for a surface that is the same all along y, write its heights alone, at \
                           equal distances along x, in several equal columns";

/// Most samples along a cell vector.
pub const MOST: usize = 32_768;

/// Heights of one period of a surface.
#[derive(Debug, Clone, PartialEq)]
pub struct Heights {
    /// Samples along a₁ and a₂.
    pub points: [usize; 2],
    /// Protrusion upward at each sample, n₁ × n₂ values, a₂ fastest; NaN where there is no measurement.
    pub values: Vec<f64>,
}

/// Why a file is refused, without its name and that of the key.
#[derive(Debug, Clone, PartialEq)]
pub struct Fault {
    /// Words for what is wrong.
    pub what: String,
    /// Label at the excerpt of the case.
    pub label: String,
    /// Advice what to do, if any.
    pub help: Option<String>,
}

impl Fault {
    /// A fault in words.
    pub fn new(what: impl Into<String>, label: impl Into<String>) -> Self {
        Self { what: what.into(), label: label.into(), help: None }
    }

    /// Adds advice.
    pub fn help(self, help: impl Into<String>) -> Self {
        Self { help: Some(help.into()), ..self }
    }

    /// Adds the way through another program.
    pub fn or_elsewhere(self) -> Self {
        let help = self.help.as_ref().map_or(ELSEWHERE.to_owned(), |help| format!("{help}; or, {ELSEWHERE}"));
        self.help(help)
    }

    /// Label at the excerpt of the case.
    pub fn label(self) -> String {
        self.label
    }

    pub(crate) fn unreadable(error: &std::io::Error) -> Self {
        Self::new(format!("cannot be read: {error}"), "this file")
    }
}

impl Heights {
    /// Heights of n₁ × n₂ samples, NaN where there is no measurement; a fault for a number of samples out of range, for heights that
    /// are infinite or beyond 1e60, and without any measurement.
    pub fn new(points: [usize; 2], values: Vec<f64>) -> Result<Self, Fault> {
        let [n1, n2] = points;
        if points.iter().any(|n| !(2..=MOST).contains(n)) {
            let what = format!("holds {n1} × {n2} heights; there must be between 2 and {MOST} along either direction");
            let fault = Fault::new(what, format!("{n1} × {n2} heights"));
            return Err(if n1.min(n2) == 1 && n1.max(n2) > 1 { fault.help(PROFILE) } else { fault });
        }
        match values.iter().position(|height| height.abs() > *CARRIED.end()) {
            None if values.iter().all(|height| height.is_nan()) => {
                Err(Fault::new("holds no measurement at any place", "no heights"))
            }
            None => Ok(Self { points, values }),
            Some(k) => Err(Fault::new(
                format!("holds {} at [{}, {}]", plain::float(values[k]), k / n2, k % n2),
                "every height must be at most 1e60",
            )
            .help(MARK)),
        }
    }
}

/// Adds to a list; refused where it is full and a list of twice its length exceeds the available memory.
pub fn push<T>(list: &mut Vec<T>, item: T) -> Result<(), Fault> {
    if list.len() == list.capacity() {
        fits(2 * size_of_val(&list[..]) as u64)?;
    }
    list.push(item);
    Ok(())
}

/// Refuses `needed` bytes that exceed the available memory.
pub fn fits(needed: u64) -> Result<(), Fault> {
    let room = available_memory();
    if needed <= room {
        return Ok(());
    }
    let what = format!("takes about {} of memory to read, and {} are available", bytes(needed), bytes(room));
    Err(Fault::new(what, "too large"))
}
