//! Binary files of instruments: numbers, texts and images within their bounds.
//!
//! A file is read whole, as it is at most as large as its length on the disk; nothing of the size that a header states is taken before that
//! size was compared with the bytes that are there.

use super::fault::{Fault, Heights, MOST, PROFILE, fits};
use super::suspicious_values;
use percoat_common::encoding::utf8_or_latin1;
use std::borrow::Cow;
use std::io::Read;

/// Reads a whole file of `bytes` bytes.
pub fn whole(reader: impl Read, bytes: u64) -> Result<Vec<u8>, Fault> {
    fits(bytes)?;
    let mut content = Vec::new();
    reader.take(bytes).read_to_end(&mut content).map_err(|error| Fault::unreadable(&error))?;
    Ok(content)
}

/// The fault of a file that ends too early.
pub fn ended() -> Fault {
    Fault::new("ends before the data that its header announces", "truncated")
        .help("copy or export it again: a part of it is missing")
}

/// The fault of a file whose content contradicts its format.
pub fn broken(what: impl std::fmt::Display) -> Fault {
    Fault::new(format!("is damaged: {what}"), "damaged").help("export it again from the program that wrote it")
}

/// The fault of a file that states something twice: the first is not the right one rather than the last.
pub fn twice(what: impl std::fmt::Display) -> Fault {
    Fault::new(format!("has {what} twice, and does not say which is meant"), "twice").help("remove one of them")
}

/// Bytes that are read from their start.
#[derive(Debug, Clone)]
pub struct Bytes<'a> {
    /// Bytes that are not read yet.
    pub rest: &'a [u8],
}

impl<'a> Bytes<'a> {
    pub fn new(bytes: &'a [u8]) -> Self {
        Self { rest: bytes }
    }

    /// The next `count` bytes.
    pub fn take(&mut self, count: usize) -> Result<&'a [u8], Fault> {
        let (taken, rest) = self.rest.split_at_checked(count).ok_or_else(ended)?;
        self.rest = rest;
        Ok(taken)
    }

    /// The next number, little-endian.
    pub fn number(&mut self, kind: Number) -> Result<f64, Fault> {
        Ok(kind.at(self.take(kind.size())?, 0))
    }

    /// The next size, an unsigned number of 32 bits, little-endian.
    pub fn size(&mut self) -> Result<usize, Fault> {
        let bytes = self.take(4)?;
        Ok(u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]) as usize)
    }

    /// The next text, which ends with a NUL.
    pub fn text(&mut self) -> Result<Cow<'a, str>, Fault> {
        let end = self.rest.iter().position(|byte| *byte == 0).ok_or_else(ended)?;
        let decoded = utf8_or_latin1(self.take(end)?);
        self.take(1)?;
        Ok(decoded)
    }

    /// The text of a field of `count` bytes, up to a NUL, without blanks around it.
    pub fn field(&mut self, count: usize) -> Result<String, Fault> {
        let bytes = self.take(count)?;
        let end = bytes.iter().position(|byte| *byte == 0).unwrap_or(count);
        Ok(utf8_or_latin1(&bytes[..end]).trim().to_owned())
    }
}

/// The text of a whole file; one in Latin-1 is copied to at most twice its length, while a list grows to twice of that.
pub fn whole_text(content: &[u8]) -> Result<Cow<'_, str>, Fault> {
    if std::str::from_utf8(content).is_err() {
        fits(4 * content.len() as u64)?;
    }
    Ok(utf8_or_latin1(content))
}

/// Type of a number in a file, little-endian.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Number {
    U8,
    I8,
    U16,
    I16,
    U32,
    I32,
    F32,
    F64,
}

impl Number {
    /// Bytes of a number.
    pub fn size(self) -> usize {
        match self {
            Self::U8 | Self::I8 => 1,
            Self::U16 | Self::I16 => 2,
            Self::U32 | Self::I32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    /// Least and largest finite number.
    pub fn range(self) -> [f64; 2] {
        match self {
            Self::U8 => [0.0, u8::MAX.into()],
            Self::I8 => [i8::MIN.into(), i8::MAX.into()],
            Self::U16 => [0.0, u16::MAX.into()],
            Self::I16 => [i16::MIN.into(), i16::MAX.into()],
            Self::U32 => [0.0, u32::MAX.into()],
            Self::I32 => [i32::MIN.into(), i32::MAX.into()],
            Self::F32 => [f32::MIN.into(), f32::MAX.into()],
            Self::F64 => [f64::MIN, f64::MAX],
        }
    }

    /// Number `k` of a list of them.
    pub fn at(self, bytes: &[u8], k: usize) -> f64 {
        let chunk = &bytes[k * self.size()..][..self.size()];
        match (self, chunk) {
            (Self::I8, [a]) => f64::from(i8::from_le_bytes([*a])),
            (Self::U16, [a, b]) => f64::from(u16::from_le_bytes([*a, *b])),
            (Self::I16, [a, b]) => f64::from(i16::from_le_bytes([*a, *b])),
            (Self::U32, [a, b, c, d]) => f64::from(u32::from_le_bytes([*a, *b, *c, *d])),
            (Self::I32, [a, b, c, d]) => f64::from(i32::from_le_bytes([*a, *b, *c, *d])),
            (Self::F32, [a, b, c, d]) => f64::from(f32::from_le_bytes([*a, *b, *c, *d])),
            (Self::F64, [a, b, c, d, e, f, g, h]) => f64::from_le_bytes([*a, *b, *c, *d, *e, *f, *g, *h]),
            (_, chunk) => f64::from(chunk[0]),
        }
    }
}

/// Numbers of an image, line by line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Image {
    /// Numbers of a line, along x.
    pub width: usize,
    /// Lines, along y.
    pub height: usize,
    /// Whether the first line is the top one, so that y falls from line to line.
    pub top_first: bool,
}

impl Image {
    /// The image of these sizes; a fault for one of fewer than 2 or more than [`MOST`] numbers or lines.
    pub fn new([width, height]: [f64; 2], top_first: bool) -> Result<Self, Fault> {
        let allowed = |n: f64| n.fract() == 0.0 && (2.0..=MOST as f64).contains(&n);
        if allowed(width) && allowed(height) {
            return Ok(Self { width: width as usize, height: height as usize, top_first });
        }
        let what = format!(
            "says that it holds {width} × {height} heights; there must be between 2 and {MOST} along either direction"
        );
        let fault = Fault::new(what, format!("{width} × {height} heights"));
        Err(if width == 1.0 || height == 1.0 { fault.help(PROFILE) } else { fault })
    }

    pub fn len(self) -> usize {
        self.width * self.height
    }

    /// Heights with x along a₁ and y along a₂; `value` gives number `k` as stored, NaN where there is no measurement.
    pub fn heights(self, value: impl Fn(usize) -> f64) -> Result<Heights, Fault> {
        let Self { width, height, top_first } = self;
        fits(8 * self.len() as u64)?;
        let line = |j: usize| if top_first { height - 1 - j } else { j };
        let values = (0..self.len()).map(|k| value(line(k % height) * width + k / height)).collect();
        Heights::new([width, height], values)
    }

    /// Heights as those of [`heights`](Self::heights) times a `factor`; refused where numbers as stored mark places without a measurement
    /// in another way than that of the format, which `value` knows.
    pub fn scaled(self, factor: f64, value: impl Fn(usize) -> f64) -> Result<Heights, Fault> {
        let Heights { points, values } = suspicious_values::checked(self.heights(value)?)?;
        Heights::new(points, values.into_iter().map(|value| factor * value).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_texts_are_read_within_their_bounds() {
        let mut bytes = Bytes::new(b"\xfe\xff\x01\0\0\0ab\0\xb5m\0\0\0x");
        assert_eq!((bytes.number(Number::I16), bytes.size()), (Ok(-2.0), Ok(1)));
        assert_eq!((bytes.text(), bytes.field(5)), (Ok("ab".into()), Ok("µm".to_owned())));
        assert_eq!((bytes.text(), bytes.take(2), bytes.take(1)), (Err(ended()), Err(ended()), Ok(&b"x"[..])));
        assert_eq!(Number::F64.at(&[[0; 8], 2.5f64.to_le_bytes()].concat(), 1), 2.5);
        assert_eq!(Number::U8.at(&[7, 200], 1), 200.0);
    }

    /// A file of half the memory has no room for a copy.
    #[test]
    fn a_text_in_utf_8_is_not_copied() {
        assert!(matches!(whole_text("1 2 µm".as_bytes()), Ok(Cow::Borrowed("1 2 µm"))));
        assert_eq!(whole_text(b"1 2 \xb5m").as_deref(), Ok("1 2 µm"));
    }

    #[test]
    fn an_image_stands_upright() {
        // Lines 0 1 2 and 3 4 5.
        let heights = |top_first| Image::new([3.0, 2.0], top_first).unwrap().heights(|k| k as f64).unwrap();
        assert_eq!(heights(true), Heights { points: [3, 2], values: vec![3.0, 0.0, 4.0, 1.0, 5.0, 2.0] });
        assert_eq!(heights(false), Heights { points: [3, 2], values: vec![0.0, 3.0, 1.0, 4.0, 2.0, 5.0] });
        for sizes in [[-1.0, 4.0], [f64::NAN, 4.0], [4.0, 1e9], [2.5, 4.0], [1.0, 64.0]] {
            assert!(Image::new(sizes, true).is_err(), "{sizes:?}");
        }
    }
}
