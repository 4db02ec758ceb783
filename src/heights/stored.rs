//! Heights as any of the formats stores them, upright: axis 0 along a₁, axis 1 along a₂.

use ndarray::ArrayD;
use std::io::BufRead;
use std::path::Path;

use super::fault::{Fault, Heights, fits};
use super::header::{Header, HeightsUnit, Length};
use super::text::NumberTable;
use super::xyz::PointGrid;
use super::{npy, suspicious_values, text, xyz};

/// The formats, for error messages.
pub const FORMATS: &str =
    "`.npy` (NumPy), `.csv`, `.txt` or `.dat` (a matrix of numbers), `.xyz` (x y z, one point a line)";

/// A format of heights.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum HeightsFormat {
    /// An array of NumPy.
    Npy,
    /// A matrix of numbers.
    Text,
    /// Points x y z, one a line.
    Xyz,
}

impl HeightsFormat {
    /// The format of the ending of a path; `None` for an unknown one.
    pub fn of(path: &Path) -> Option<Self> {
        match &path.extension()?.to_string_lossy().to_lowercase()[..] {
            "npy" => Some(Self::Npy),
            "csv" | "txt" | "dat" => Some(Self::Text),
            "xyz" => Some(Self::Xyz),
            _ => None,
        }
    }
}

/// Content of a file of heights.
#[derive(Debug)]
pub struct Stored {
    /// Heights in the unit of the file.
    pub heights: Heights,
    /// Sides along a₁ and a₂; none where the file has none.
    pub sides: Option<[Length; 2]>,
    /// Unit of the heights; none where the file has none.
    pub unit: Option<HeightsUnit>,
    /// Whether it is a text whose lines run along a₁ by default.
    pub lines_along_a1: bool,
    /// Warnings about its format, a sentence each.
    pub doubts: Vec<String>,
}

impl Stored {
    /// Reads a file of `bytes` bytes; without a `format`, as for a pipe, the first bytes determine it, by default a text.
    pub fn read(mut reader: impl BufRead, bytes: u64, format: Option<HeightsFormat>) -> Result<Self, Fault> {
        let format = match format {
            Some(format) => format,
            None if reader.fill_buf().is_ok_and(|bytes| bytes.starts_with(b"\x93NUMPY")) => HeightsFormat::Npy,
            None => HeightsFormat::Text,
        };
        let stored = match format {
            HeightsFormat::Npy => npy::read(reader, bytes).and_then(of_array),
            HeightsFormat::Xyz => xyz::read(reader, bytes).map(|(points, header)| Self::points(points, &header)),
            HeightsFormat::Text => text::read(reader, bytes).and_then(of_table),
        }?;
        stored.checked()
    }

    /// Heights of an array in memory.
    pub fn of(array: &ArrayD<f64>) -> Result<Self, Fault> {
        npy::of_array(array).and_then(of_array)?.checked()
    }

    /// Refuses values that are not heights, and adds warnings about implausible ones.
    fn checked(mut self) -> Result<Self, Fault> {
        suspicious_values::no_data(&self.heights)?;
        self.doubts.extend(suspicious_values::doubts(&self.heights));
        Ok(self)
    }

    fn points(PointGrid { heights, period }: PointGrid, header: &Header) -> Self {
        let side = |value: f64| Length { value, unit: header.of_coordinates() };
        let (sides, unit) = (Some(period.map(side)), header.heights().cloned());
        Self { heights, sides, unit, lines_along_a1: false, doubts: Vec::new() }
    }
}

/// The content of a NumPy array; one of points is refused.
fn of_array(heights: Heights) -> Result<Stored, Fault> {
    if xyz::of_table(&heights, &[]).is_some() {
        let [lines, columns] = heights.points;
        let what = format!("holds {lines} rows of {columns} numbers, of which the first two are places of a grid");
        return Err(
            Fault::new(what, "points x y z?").help("save heights of shape (n1, n2), or the points in a file .xyz")
        );
    }
    Ok(Stored { heights, sides: None, unit: None, lines_along_a1: false, doubts: Vec::new() })
}

/// The content of a text: points, an image, or lines along a₁.
fn of_table(table: NumberTable) -> Result<Stored, Fault> {
    let NumberTable { heights, lines, header, doubts } = table;
    if let Some(points) = xyz::of_table(&heights, &lines) {
        return Ok(Stored::points(points?, &header));
    }
    let Heights { points: [lines, numbers], values } = heights;
    let Heights { values, .. } = Heights::new([lines, numbers], values)?;
    let sides = header.sides([numbers, lines])?;
    let heights = match header.is_image() {
        true => upright([numbers, lines], &values)?,
        false => Heights { points: [lines, numbers], values },
    };
    Ok(Stored { heights, sides, unit: header.heights().cloned(), lines_along_a1: !header.is_image(), doubts })
}

/// Heights of an image of n₁ numbers a line and n₂ lines, the first one on top, with x along a₁ and y along a₂: `image[::-1].T`.
fn upright([n1, n2]: [usize; 2], values: &[f64]) -> Result<Heights, Fault> {
    fits(8 * values.len() as u64)?;
    let at = |k: usize| values[(n2 - 1 - k % n2) * n1 + k / n2];
    Ok(Heights { points: [n1, n2], values: (0..n1 * n2).map(at).collect() })
}
