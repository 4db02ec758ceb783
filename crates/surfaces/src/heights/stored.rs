//! Heights as any of the formats stores them, upright: axis 0 along a₁, axis 1 along a₂.

use ndarray::ArrayD;
use std::io::BufRead;
use std::path::Path;

use super::binary::{Image, whole};
use super::channel::{Channel, WantedChannel, choose};
use super::fault::{Fault, Heights};
use super::header::{Header, HeightsUnit, Length};
use super::measured::Measured;
use super::text::NumberTable;
use super::xyz::PointGrid;
use super::{asc, gwy, npy, profile, sdf, spip, sur, suspicious_values, text, x3p, xyz};

/// The formats, for error messages.
pub const FORMATS: &str = "`.npy` (NumPy), `.csv`, `.txt` or `.dat` (a matrix of numbers), `.xyz` (x y z, one point a line), `.x3p` (ISO 25178-72), \
     `.sdf` (ISO 25178-71), `.sur` or `.pro` (Digital Surf), `.gwy` (Gwyddion), `.asc` (Esri's grid, SPIP's text)";

/// A format of heights.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum HeightsFormat {
    /// An array of NumPy.
    Npy,
    /// A matrix of numbers.
    Text,
    /// Points x y z, one a line.
    Xyz,
    /// ISO 25178-72.
    X3p,
    /// ISO 25178-71.
    Sdf,
    /// Digital Surf.
    Sur,
    /// Gwyddion.
    Gwy,
    /// Esri's grid, or a text that begins with a comment.
    Asc,
}

impl HeightsFormat {
    /// The format of the ending of a path; `None` for an unknown one.
    pub fn of(path: &Path) -> Option<Self> {
        match &path.extension()?.to_string_lossy().to_lowercase()[..] {
            "npy" => Some(Self::Npy),
            "csv" | "txt" | "dat" => Some(Self::Text),
            "xyz" => Some(Self::Xyz),
            "x3p" => Some(Self::X3p),
            "sdf" => Some(Self::Sdf),
            "sur" | "pro" => Some(Self::Sur),
            "gwy" => Some(Self::Gwy),
            "asc" => Some(Self::Asc),
            _ => None,
        }
    }

    /// The format of the first bytes of a file; by default a text.
    fn of_start(bytes: &[u8]) -> Self {
        let begins = |magic: &[u8]| bytes.starts_with(magic);
        match bytes {
            _ if begins(b"\x93NUMPY") => Self::Npy,
            _ if begins(x3p::MAGIC) => Self::X3p,
            _ if sdf::MAGICS.into_iter().any(begins) => Self::Sdf,
            _ if sur::MAGICS.into_iter().any(begins) => Self::Sur,
            _ if begins(gwy::MAGIC) => Self::Gwy,
            _ => Self::Text,
        }
    }

    /// Whether files of the format begin with a mark of it.
    fn has_mark(self) -> bool {
        matches!(self, Self::X3p | Self::Sdf | Self::Sur | Self::Gwy)
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
    /// Whether it is the file of an instrument, whose lengths are not in the unit of the case where it states none.
    pub is_measured: bool,
    /// Whether it is a text whose lines run along a₁ by default.
    pub lines_along_a1: bool,
    /// Warnings about its format, a sentence each.
    pub doubts: Vec<String>,
}

impl Stored {
    /// Reads the channel that is `wanted`, or the only one of heights, of a file of `bytes` bytes; without a `format`, as for a pipe, the
    /// first bytes determine it, by default a text.
    pub fn read(
        mut reader: impl BufRead,
        bytes: u64,
        format: Option<HeightsFormat>,
        wanted: Option<&WantedChannel>,
    ) -> Result<Self, Fault> {
        let first = reader.fill_buf().unwrap_or_default();
        let (start, is_comment) =
            (HeightsFormat::of_start(first), first.strip_prefix(b"\xef\xbb\xbf").unwrap_or(first).starts_with(b"#"));
        let format = match format.unwrap_or(start) {
            HeightsFormat::Asc if is_comment => HeightsFormat::Text,
            format => format,
        };
        if format.has_mark() && start != format {
            let help = "its ending says which format it is in: rename it, or export it again from the program of the instrument";
            return Err(Fault::new("does not begin as a file of its format", "another format?")
                .help(help)
                .or_elsewhere());
        }
        let stored = match format {
            HeightsFormat::Npy => npy::read(reader, bytes).and_then(of_array),
            HeightsFormat::Xyz => xyz::read(reader, bytes).map(|(points, header)| Self::points(points, &header)),
            HeightsFormat::Text => text::read(reader, bytes).and_then(of_table),
            HeightsFormat::X3p => return x3p::read(&whole(reader, bytes)?, wanted).and_then(Self::measured),
            HeightsFormat::Sdf => return sdf::read(&whole(reader, bytes)?, wanted).and_then(Self::measured),
            HeightsFormat::Sur => return sur::read(&whole(reader, bytes)?, wanted).and_then(Self::measured),
            HeightsFormat::Gwy => return gwy::read(&whole(reader, bytes)?, wanted).and_then(Self::measured),
            HeightsFormat::Asc => return asc::read(&whole(reader, bytes)?, wanted).and_then(Self::measured),
        }?;
        stored.only(wanted)?.checked()
    }

    fn measured(mut measured: Measured) -> Result<Self, Fault> {
        measured.doubts.extend(measured.implausible());
        let Measured { heights, sides, unit, doubts } = measured;
        Self { heights, sides: Some(sides), unit, is_measured: true, lines_along_a1: false, doubts }.checked()
    }

    /// Heights of an array in memory.
    pub fn of(array: &ArrayD<f64>, wanted: Option<&WantedChannel>) -> Result<Self, Fault> {
        npy::of_array(array).and_then(of_array)?.only(wanted)?.checked()
    }

    /// The heights with sides along a₁ and a₂, lengths in a unit, which is that of the heights too.
    pub fn sized(self, sides: [f64; 2], unit: Option<&str>) -> Result<Self, Fault> {
        if sides.iter().any(|side| !side.is_finite() || *side <= 0.0) {
            let what = format!("says that it is {} × {} large", sides[0], sides[1]);
            return Err(Fault::new(what, "no sizes").help("physical sizes must be greater than 0"));
        }
        let side = |value: f64| Length { value, unit: unit.map(str::to_owned) };
        Ok(Self { sides: Some(sides.map(side)), unit: unit.map(HeightsUnit::of), ..self })
    }

    /// Refuses another channel than the only one.
    fn only(self, wanted: Option<&WantedChannel>) -> Result<Self, Fault> {
        choose(&[Channel { name: String::new(), unit: self.unit.clone() }], wanted)?;
        Ok(self)
    }

    /// Number of samples without a measurement.
    pub fn holes(&self) -> usize {
        self.heights.values.iter().filter(|height| height.is_nan()).count()
    }

    /// Refuses values that are not heights, and adds warnings about implausible ones.
    fn checked(mut self) -> Result<Self, Fault> {
        suspicious_values::no_data(&self.heights)?;
        self.doubts.extend(suspicious_values::doubts(&self.heights));
        Ok(self)
    }

    fn points(PointGrid { heights, period }: PointGrid, header: &Header) -> Self {
        let side = |value: f64| Length { value, unit: header.of_coordinates() };
        let (sides, unit) = (Some(period.map(side)), header.heights());
        Self { heights, sides, unit, is_measured: false, lines_along_a1: false, doubts: Vec::new() }
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
    profile::refuse(&heights)?;
    Ok(Stored { heights, sides: None, unit: None, is_measured: false, lines_along_a1: false, doubts: Vec::new() })
}

/// The content of a text: points, an image, or lines along a₁.
fn of_table(table: NumberTable) -> Result<Stored, Fault> {
    let NumberTable { heights, lines, header, doubts } = table;
    if let Some(points) = xyz::of_table(&heights, &lines) {
        return Ok(Stored::points(points?, &header));
    }
    if !header.is_image() {
        profile::refuse(&heights)?;
    }
    let mut heights = match header.voids() {
        Some([lines, voids]) => spip::without_voids(heights, lines, voids)?,
        None => heights,
    };
    if header.factor() != 1.0 {
        heights = suspicious_values::checked(heights)?;
        heights.values.iter_mut().for_each(|height| *height *= header.factor());
    }
    let Heights { points: [lines, numbers], values } = Heights::new(heights.points, heights.values)?;
    let sides = header.sides([numbers, lines])?;
    let heights = match header.is_image() {
        true => Image { width: numbers, height: lines, top_first: true }.heights(|k| values[k])?,
        false => Heights { points: [lines, numbers], values },
    };
    let (unit, is_measured) = (header.heights(), header.is_spip());
    Ok(Stored { heights, sides, unit, is_measured, lines_along_a1: !header.is_image(), doubts })
}
