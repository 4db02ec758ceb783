//! Surface data files, `.sdf`: a header and one matrix of heights, all in metres, by ISO 25178-71 or the BCR proposal of 1993 before it.
//!
//! Binary, little-endian without gaps; ISO-2.0 has sizes of 32 bits, so that all behind them lies 4 bytes further:
//!
//! ```text
//!  0  version, 8 characters      44  NumProfiles, u16                           70  Zresolution, f64
//!  8  manufacturer, 10           46  Xscale, f64: distance of points, m         78  Compression, u8: 0
//! 18  created, 12                54  Yscale, f64: distance of profiles, m       79  DataType, u8
//! 30  modified, 12               62  Zscale, f64: heights are m × Zscale        80  CheckType, u8: 0
//! 42  NumPoints, u16                                                            81  heights, profile by profile
//! ```
//!
//! Text form: lines `Name = value ; comment` with the same names, a line `*`, the heights, a line `*`. A text may follow the heights, also binary
//! ones. Data types: 0 u8, 1 u16, 2 u32, 3 f32, 4 i8, 5 i16, 6 i32, 7 f64; ISO has none without a sign. What the versions do not share:
//!
//! ```text
//!                   first profile    point without a measurement
//! ISO-1.0, ISO-2.0  lowest, y = 0    least number of the type; BAD in a text
//! BCR-0.0, BCR-1.0  top one          largest number of the type, of floats also above 3.4e38 and 1.7e308; in a text too, or BAD
//! ```
//!
//! The first letter is b or a, binary or text. Sources: ISO 25178-71:2012 and 2017 (profiles: yᵢ = (i − 1) Yscale) and the proposal of 1993, both
//! as sdfio 2.0 reads and writes them; the order of profiles of BCR is that of MountainsMap and Gwyddion, as the proposal fixes none.
//! `aBCR-0.0` is what Gwyddion writes (`sdfile.c`), without the last `*`. Files of Olympus' programs have eight bytes more before the heights,
//! the numbers 5 and 1, by the same source.

use super::binary::{Bytes, Image, Number, broken, ended, twice, whole_text};
use super::channel::{Channel, WantedChannel, choose};
use super::fault::{Fault, fits};
use super::header::{HeightsUnit, Length};
use super::measured::Measured;

/// First bytes of all versions, before the number.
pub const MAGICS: [&[u8]; 8] = [b"aISO-", b"bISO-", b"AISO-", b"BISO-", b"aBCR-", b"bBCR-", b"ABCR-", b"BBCR-"];

/// Length of the version.
const VERSION: usize = 8;
/// Least floats that mark a point without a measurement in BCR.
const BCR_BAD: [f64; 2] = [3.4e38_f32 as f64, 1.7e308];
/// Bytes of Olympus' programs before the heights.
const OLYMPUS: [u8; 8] = [5, 0, 0, 0, 1, 0, 0, 0];
/// Words for numbers of a header of BCR, in small letters.
const WORDS: [(&str, f64); 12] = [
    ("uchar", 0.0),
    ("uinteger", 1.0),
    ("ulongint", 2.0),
    ("float", 3.0),
    ("char", 4.0),
    ("integer", 5.0),
    ("longint", 6.0),
    ("double", 7.0),
    ("null", 0.0),
    ("none", 0.0),
    ("rll", 1.0),
    ("uinttrace", 1.0),
];

/// A version of the format.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Version {
    Bcr,
    Iso1,
    Iso2,
}

impl Version {
    fn of(content: &[u8]) -> Result<Self, Fault> {
        match content.get(1..VERSION).ok_or_else(ended)? {
            b"BCR-0.0" | b"BCR-1.0" => Ok(Self::Bcr),
            b"ISO-1.0" => Ok(Self::Iso1),
            b"ISO-2.0" => Ok(Self::Iso2),
            other => {
                let is_plain = other.iter().all(|byte| byte.is_ascii_digit() || b"ISOBCR-.".contains(byte));
                let name = if is_plain { String::from_utf8_lossy(other) } else { "that is not known".into() };
                let what = format!("is of the version {name}; BCR-0.0, BCR-1.0, ISO-1.0 and ISO-2.0 are read");
                Err(Fault::new(what, "another version").or_elsewhere())
            }
        }
    }

    /// Whether a number as stored, of this type, marks a point without a measurement.
    fn is_bad(self, kind: Number, value: f64) -> bool {
        let [least, largest] = kind.range();
        match (self, kind) {
            (Self::Bcr, Number::F32) => value >= BCR_BAD[0],
            (Self::Bcr, Number::F64) => value >= BCR_BAD[1],
            (Self::Bcr, _) => value == largest,
            _ => value == least,
        }
    }
}

/// The numbers of a header.
#[derive(Debug)]
struct Header {
    version: Version,
    image: Image,
    /// Xscale, Yscale and Zscale.
    scales: [f64; 3],
    /// Type of the heights.
    kind: Number,
}

impl Header {
    /// NumPoints, NumProfiles, Xscale, Yscale, Zscale, compression, data type and type of check.
    fn new(version: Version, [points, profiles, x, y, z, compression, kind, check]: [f64; 8]) -> Result<Self, Fault> {
        let image = Image::new([points, profiles], version == Version::Bcr)?;
        if compression != 0.0 {
            let what = "is compressed by a method that ISO 25178-71 does not describe";
            return Err(Fault::new(what, "compressed").help("export it without compression").or_elsewhere());
        }
        if check != 0.0 {
            let what = "has checksums among its heights, by a method that ISO 25178-71 does not describe";
            return Err(Fault::new(what, "checksums").help("export it without checksums").or_elsewhere());
        }
        let is_signed = kind >= 3.0;
        let kind = match kind {
            0.0 => Number::U8,
            1.0 => Number::U16,
            2.0 => Number::U32,
            3.0 => Number::F32,
            4.0 => Number::I8,
            5.0 => Number::I16,
            6.0 => Number::I32,
            7.0 => Number::F64,
            _ => return Err(broken("its heights are of a type that the format does not have")),
        };
        if !is_signed && version != Version::Bcr {
            let what = "holds numbers without a sign, which ISO 25178-71 does not have: the mark of points without a measurement is not known";
            return Err(Fault::new(what, "which mark?").help("export it as 16 or 32 bits with a sign").or_elsewhere());
        }
        let scales = [x, y, z];
        if scales.iter().any(|scale| !scale.is_finite() || *scale == 0.0) || x < 0.0 || y < 0.0 {
            return Err(broken("a scale of its header is no number other than 0, or a distance is negative"));
        }
        Ok(Self { version, image, scales, kind })
    }

    /// The header of a binary file and what follows it.
    fn binary(version: Version, content: &[u8]) -> Result<(Self, &[u8]), Fault> {
        let mut bytes = Bytes::new(content);
        bytes.take(42)?;
        let size = if version == Version::Iso2 { Number::U32 } else { Number::U16 };
        let [points, profiles] = [bytes.number(size)?, bytes.number(size)?];
        let mut scales = [0.0; 4];
        for scale in &mut scales {
            *scale = bytes.number(Number::F64)?;
        }
        let [x, y, z, _] = scales;
        let [compression, kind, check] =
            [bytes.number(Number::U8)?, bytes.number(Number::U8)?, bytes.number(Number::U8)?];
        let header = Self::new(version, [points, profiles, x, y, z, compression, kind, check])?;
        let length = header.kind.size() * header.image.len();
        let is_longer = bytes.rest.len() == length + OLYMPUS.len() && bytes.rest.starts_with(&OLYMPUS);
        if version == Version::Iso1 && is_longer {
            bytes.take(OLYMPUS.len())?;
        }
        Ok((header, bytes.rest))
    }

    /// The header of a text and its heights.
    fn text(version: Version, text: &str) -> Result<(Self, &str), Fault> {
        let lines = text.split_inclusive(ENDS).take_while(|line| !line.trim_start().starts_with('*'));
        let (header, rest) = text.split_at(lines.map(str::len).sum());
        let data = rest.trim_start().strip_prefix('*').ok_or_else(ended)?;
        const NAMES: [&str; 8] =
            ["numpoints", "numprofiles", "xscale", "yscale", "zscale", "compression", "datatype", "checktype"];
        let mut found = [None; 8];
        // The first line is the version.
        for line in header.split(ENDS).skip(1) {
            let line = without_comment(line).trim();
            let parts = line.split_once('=').or_else(|| line.split_once(char::is_whitespace));
            let Some((name, value)) = parts else { continue };
            let name = name.trim().to_lowercase();
            if let Some(index) = NAMES.iter().position(|known| *known == name) {
                let value = number(value.trim()).ok_or_else(|| broken("a number of its header is none"))?;
                if found[index].replace(value).is_some() {
                    return Err(twice("a number of its header"));
                }
            }
        }
        let [compression, check] = [found[5].unwrap_or(0.0), found[7].unwrap_or(0.0)];
        let [Some(points), Some(profiles), Some(x), Some(y), Some(z), _, Some(kind), _] = found else {
            return Err(broken("its header lacks a size, a scale or the type of its heights"));
        };
        let header = Self::new(version, [points, profiles, x, y, z, compression, kind, check])?;
        Ok((header, data.split_once('*').map_or(data, |(data, _)| data)))
    }

    /// The surface whose numbers as stored are those of `value`.
    fn stored(&self, value: impl Fn(usize) -> f64) -> Result<Measured, Fault> {
        let [x, y, z] = self.scales;
        let side = |count: usize, spacing: f64| Length { value: count as f64 * spacing, unit: Some("m".to_owned()) };
        let measured = |k: usize| Some(value(k)).filter(|value| !self.version.is_bad(self.kind, *value));
        Ok(Measured {
            heights: self.image.scaled(z, |k| measured(k).unwrap_or(f64::NAN))?,
            sides: [side(self.image.width, x), side(self.image.height, y)],
            unit: Some(HeightsUnit::Known("m".to_owned())),
            doubts: Vec::new(),
        })
    }
}

/// Ends of lines, also those of old Macintosh computers.
const ENDS: [char; 2] = ['\n', '\r'];

fn without_comment(line: &str) -> &str {
    line.split_once(';').map_or(line, |(line, _)| line)
}

/// A number of the header of a text, or a word for it.
fn number(text: &str) -> Option<f64> {
    let word = || WORDS.iter().find(|(word, _)| text.eq_ignore_ascii_case(word)).map(|(_, number)| *number);
    text.parse().ok().or_else(word)
}

/// Reads the only channel; refused where another one is `wanted`.
pub fn read(content: &[u8], wanted: Option<&WantedChannel>) -> Result<Measured, Fault> {
    choose(&[Channel { name: String::new(), unit: Some(HeightsUnit::Known("m".to_owned())) }], wanted)?;
    let version = Version::of(content)?;
    if content[0].eq_ignore_ascii_case(&b'b') {
        return binary(version, content);
    }
    let content = whole_text(content)?;
    let (header, data) = Header::text(version, &content)?;
    let count = header.image.len();
    // Each height has a character and a blank at least.
    if data.len() < 2 * count - 1 {
        return Err(ended());
    }
    fits(8 * count as u64)?;
    let mut values = Vec::with_capacity(count);
    for word in data.split(ENDS).flat_map(|line| without_comment(line).split_whitespace()) {
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

/// Reads a binary file.
fn binary(version: Version, content: &[u8]) -> Result<Measured, Fault> {
    let (header, data) = Header::binary(version, content)?;
    let size = header.kind.size();
    let trailer = data.get(size * header.image.len()..).ok_or_else(ended)?;
    let is_text = trailer.iter().all(|byte| byte.is_ascii_graphic() || byte.is_ascii_whitespace() || *byte == 0);
    if trailer.len() >= size * header.image.width && !is_text {
        return Err(more());
    }
    header.stored(|k| header.kind.at(data, k))
}

/// The fault of a file with a false size, by which its lines would be shifted.
fn more() -> Fault {
    broken("it holds more heights than its header states")
}
