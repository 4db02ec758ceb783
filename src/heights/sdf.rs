//! Surface data files, `.sdf` (ISO 25178-71): a header and one matrix of heights, all in metres.
//!
//! Binary, "bISO-1.0" ("bBCR-1.0" in the format before the standard), little-endian without gaps:
//!
//! ```text
//!  0  version, 8 characters      44  NumProfiles, u16                           70  Zresolution, f64
//!  8  manufacturer, 10           46  Xscale, f64: distance of points, m         78  Compression, u8: 0
//! 18  created, 12                54  Yscale, f64: distance of profiles, m       79  DataType, u8
//! 30  modified, 12               62  Zscale, f64: heights are m × Zscale        80  CheckType, u8
//! 42  NumPoints, u16                                                            81  heights, profile by profile
//! ```
//!
//! As text, "aISO-1.0" ("aBCR-1.0"): lines `Name = value ; comment` with the same names, a line `*`, the heights, a line `*`. A text may
//! follow the heights, also binary ones. Data types: 0 u8, 1 u16, 2 u32, 3 f32, 4 i8, 5 i16, 6 i32, 7 f64. A point without a measurement is
//! BAD in a text, else NaN, the least number of a signed type of 16 bits or more, or the largest of an unsigned one. The first profile counts
//! as the top one, as the first line of an image.

use super::binary::{Bytes, Image, Number, broken, ended, whole_text};
use super::channel::{Channel, WantedChannel, choose};
use super::fault::{Fault, fits};
use super::header::{HeightsUnit, Length};
use super::measured::Measured;

/// First bytes of binary files and of texts, by the standard and by the format before it.
pub const MAGICS: [&[u8]; 4] = [b"bISO-1.0", b"bBCR-1.0", b"aISO-1.0", b"aBCR-1.0"];

/// The numbers of a header.
#[derive(Debug)]
struct Header {
    image: Image,
    /// Xscale, Yscale and Zscale.
    scales: [f64; 3],
    /// Type of binary heights.
    kind: Number,
    /// Binary number of a point without a measurement.
    bad: Option<f64>,
}

impl Header {
    /// NumPoints, NumProfiles, Xscale, Yscale, Zscale, compression and data type.
    fn new([points, profiles, x, y, z, compression, kind]: [f64; 7]) -> Result<Self, Fault> {
        let image = Image::new([points, profiles], true)?;
        if compression != 0.0 {
            let what = "is compressed by a method that ISO 25178-71 does not describe";
            return Err(Fault::new(what, "compressed").help("export it without compression"));
        }
        let (kind, bad) = match kind as u8 {
            0 => (Number::U8, None),
            1 => (Number::U16, Some(f64::from(u16::MAX))),
            2 => (Number::U32, Some(f64::from(u32::MAX))),
            3 => (Number::F32, Some(f64::from(f32::MIN))),
            4 => (Number::I8, None),
            5 => (Number::I16, Some(f64::from(i16::MIN))),
            6 => (Number::I32, Some(f64::from(i32::MIN))),
            7 => (Number::F64, Some(f64::MIN)),
            _ => return Err(broken("its heights are of a type that the format does not have")),
        };
        let scales = [x, y, z];
        if scales.iter().any(|scale| !scale.is_finite() || *scale == 0.0) || x < 0.0 || y < 0.0 {
            return Err(broken("a scale of its header is no number other than 0, or a distance is negative"));
        }
        Ok(Self { image, scales, kind, bad })
    }

    /// The header of a binary file and what follows it.
    fn binary(content: &[u8]) -> Result<(Self, &[u8]), Fault> {
        let mut bytes = Bytes::new(content);
        bytes.take(42)?;
        let [points, profiles] = [bytes.number(Number::U16)?, bytes.number(Number::U16)?];
        let mut scales = [0.0; 4];
        for scale in &mut scales {
            *scale = bytes.number(Number::F64)?;
        }
        let [x, y, z, _] = scales;
        let [compression, kind, _] = [bytes.number(Number::U8)?, bytes.number(Number::U8)?, bytes.number(Number::U8)?];
        Ok((Self::new([points, profiles, x, y, z, compression, kind])?, bytes.rest))
    }

    /// The header of a text and its heights.
    fn text(text: &str) -> Result<(Self, &str), Fault> {
        let lines = text.split_inclusive('\n').take_while(|line| !line.trim_start().starts_with('*'));
        let (header, rest) = text.split_at(lines.map(str::len).sum());
        let data = rest.trim_start().strip_prefix('*').ok_or_else(ended)?;
        const NAMES: [&str; 7] = ["numpoints", "numprofiles", "xscale", "yscale", "zscale", "compression", "datatype"];
        let mut found = [None; 7];
        // The first line is the version.
        for line in header.lines().skip(1) {
            let line = line.split_once(';').map_or(line, |(line, _)| line).trim();
            let parts = line.split_once('=').or_else(|| line.split_once(char::is_whitespace));
            let Some((name, value)) = parts else { continue };
            let name = name.trim().to_lowercase();
            if let Some(index) = NAMES.iter().position(|own| *own == name) {
                let value = value.trim().parse().map_err(|_| broken("a number of its header is none"))?;
                found[index] = Some(value);
            }
        }
        found[5] = found[5].or(Some(0.0));
        let [Some(points), Some(profiles), Some(x), Some(y), Some(z), Some(compression), Some(kind)] = found else {
            return Err(broken("its header lacks a size, a scale or the type of its heights"));
        };
        let header = Self::new([points, profiles, x, y, z, compression, kind])?;
        Ok((header, data.split_once('*').map_or(data, |(data, _)| data)))
    }

    fn stored(&self, value: impl Fn(usize) -> f64) -> Result<Measured, Fault> {
        let [x, y, z] = self.scales;
        let side = |count: usize, spacing: f64| Length { value: count as f64 * spacing, unit: Some("m".to_owned()) };
        Ok(Measured {
            heights: self.image.heights(|k| z * value(k))?,
            sides: [side(self.image.width, x), side(self.image.height, y)],
            unit: Some(HeightsUnit::Known("m".to_owned())),
            doubts: Vec::new(),
        })
    }
}

/// Reads the only channel; refused where another one is `wanted`.
pub fn read(content: &[u8], wanted: Option<&WantedChannel>) -> Result<Measured, Fault> {
    choose(&[Channel { name: String::new(), unit: Some(HeightsUnit::Known("m".to_owned())) }], wanted)?;
    if content.starts_with(b"b") {
        let (header, data) = Header::binary(content)?;
        let size = header.kind.size();
        let trailer = data.get(size * header.image.len()..).ok_or_else(ended)?;
        let is_text = trailer.iter().all(|byte| byte.is_ascii_graphic() || byte.is_ascii_whitespace() || *byte == 0);
        if trailer.len() >= size * header.image.width && !is_text {
            return Err(more());
        }
        return header.stored(|k| {
            let value = header.kind.at(data, k);
            if header.bad == Some(value) { f64::NAN } else { value }
        });
    }
    let content = whole_text(content)?;
    let (header, data) = Header::text(&content)?;
    let count = header.image.len();
    // Each height has a character and a blank at least.
    if data.len() < 2 * count - 1 {
        return Err(ended());
    }
    fits(8 * count as u64)?;
    let mut values = Vec::with_capacity(count);
    for word in data.split_whitespace() {
        if values.len() == count {
            return Err(more());
        }
        let value: Option<f64> = if word.eq_ignore_ascii_case("BAD") { Some(f64::NAN) } else { word.parse().ok() };
        values.push(value.ok_or_else(|| broken("one of its heights is no number"))?);
    }
    if values.len() < count {
        return Err(ended());
    }
    header.stored(|k| values[k])
}

/// The fault of a file with a false size, by which its lines would be shifted.
fn more() -> Fault {
    broken("it holds more heights than its header states")
}
