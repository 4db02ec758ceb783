//! Digital Surf's files, `.sur` and `.pro`: objects of a header and its points, plain or compressed.
//!
//! Little-endian; the layout of the "Surface file format" of MountainsMap, as the readers of HyperSpy (RosettaSciIO) and surfalize
//! describe it:
//!
//! ```text
//!   0  "DIGITAL SURF" or "DSCOMPRESSED"      108  points of a line, i32       180  unit of the x spacing, 16 characters
//!  12  0 (257: big-endian), i16              112  lines, i32                  196  unit of the y spacing, 16
//!  14  objects of the file, i16              116  all points, i32             212  unit of the z spacing, 16
//!  18  kind of object, i16                   120  spacing along x, f32        332  length of the comment, i16
//!  20  name, 30 characters                   124  spacing along y, f32        334  length of a private zone, i16
//!  86  1: some points not measured, i16      128  spacing along z, f32        512  comment, private zone, points
//!  90  (gauge resolution, f32), 94 points    132  name of x, 16 characters
//!      of a spectrum, i32                    148  name of y, 16
//!  98  bits of a point, 16 or 32, i16        164  name of z, 16
//! 100  least and 104 largest point, i32     228  unit of lengths along x, 244 along y, 260 along z, 16 characters each
//!                                           276  quotient of both units along x, 280 along y, 284 along z, f32
//! ```
//!
//! Points are signed numbers, line by line; height = point × spacing along z, but for a constant. The number least − 2 marks a point
//! that was not measured. Compressed points: the number of streams, u32; for each its length before and after compression, u32 twice; the
//! streams (zlib). The first line counts as the top one, as in an image. A spacing without a unit of its own has that of the lengths,
//! where their quotient is 1. Without any the case must say it.

use super::binary::{Bytes, Image, Number, broken, ended};
use super::channel::{Channel, WantedChannel, choose};
use super::fault::{Fault, fits};
use super::header::{HeightsUnit, Length};
use super::measured::Measured;
use miniz_oxide::inflate::decompress_to_vec_zlib_with_limit;
use std::borrow::Cow;

/// First bytes of a file with plain and with compressed points.
pub const MAGICS: [&[u8]; 2] = [b"DIGITAL SURF", b"DSCOMPRESSED"];

/// Length of a header.
const HEADER: usize = 512;
/// Kinds of objects with a spectrum at each point.
const SPECTRA: [f64; 2] = [20.0, 21.0];
/// Most objects of a file: a series of images has more than anybody chooses from.
const MOST_OBJECTS: usize = 1000;
/// Largest factor by which zlib compresses.
const RATIO: usize = 1040;

/// An object of a file.
#[derive(Debug)]
struct Object<'a> {
    name: String,
    image: Result<Image, Fault>,
    kind: Number,
    /// Spacings along x, y and z and their units.
    spacings: [f64; 3],
    units: [String; 3],
    /// Point without a measurement, if any.
    bad: Option<f64>,
    /// Kind of object.
    of: f64,
    points: Points<'a>,
}

/// The points of an object.
#[derive(Debug)]
enum Points<'a> {
    Plain(&'a [u8]),
    /// Streams, each with its length before compression.
    Compressed(Vec<(usize, &'a [u8])>),
}

/// Reads the object that is `wanted`.
pub fn read(content: &[u8], wanted: Option<&WantedChannel>) -> Result<Measured, Fault> {
    let mut bytes = Bytes::new(content);
    let (first, count) = Object::read(&mut bytes)?;
    let mut objects = vec![first];
    while objects.len() < count.min(MOST_OBJECTS) {
        objects.push(Object::read(&mut bytes)?.0);
    }
    let channel = |object: &Object<'_>| Channel { name: object.name.clone(), unit: object.heights_unit() };
    let index = choose(&objects.iter().map(channel).collect::<Vec<_>>(), wanted)?;
    objects.swap_remove(index).stored()
}

impl<'a> Object<'a> {
    /// The next object, and the number of objects that its header states.
    fn read(bytes: &mut Bytes<'a>) -> Result<(Self, usize), Fault> {
        let header = bytes.take(HEADER)?;
        let at = |offset: usize, kind: Number| Bytes::new(&header[offset..]).number(kind);
        let field = |offset: usize, length: usize| Bytes::new(&header[offset..]).field(length);
        let is_compressed = header.starts_with(MAGICS[1]);
        if !is_compressed && !header.starts_with(MAGICS[0]) {
            return Err(broken("an object does not begin as one"));
        }
        if at(12, Number::I16)? != 0.0 {
            let what = "is written in the order of bytes of old Macintosh computers";
            return Err(Fault::new(what, "another order of bytes").help("save it on a PC").or_elsewhere());
        }
        let kind = match at(98, Number::I16)? {
            16.0 => Number::I16,
            32.0 => Number::I32,
            _ => return Err(broken("its points have neither 16 nor 32 bits")),
        };
        let sizes = [at(108, Number::I32)?, at(112, Number::I32)?];
        let of = at(18, Number::I16)?;
        // Only spectra have a number of points each; in older files these bytes are reserved.
        if SPECTRA.contains(&of) && at(94, Number::I32)? > 1.0 {
            let fault = Fault::new("holds a spectrum at each point", "no surface");
            return Err(fault.help("export the surface alone").or_elsewhere());
        }
        let name = [field(20, 30)?, field(164, 16)?].join(" ");
        let spacings = [120, 124, 128];
        let unit = |axis: usize| -> Result<String, Fault> {
            let [of_spacing, of_lengths] = [field(180 + 16 * axis, 16)?, field(228 + 16 * axis, 16)?];
            match of_spacing.is_empty() && !of_lengths.is_empty() {
                true if at(276 + 4 * axis, Number::F32)? == 1.0 => Ok(of_lengths),
                true => Err(broken("a spacing of its header has no unit")),
                false => Ok(of_spacing),
            }
        };
        let bad = (at(86, Number::I16)? == 1.0).then_some(at(100, Number::I32)? - 2.0);
        for offset in [332, 334] {
            bytes.take(at(offset, Number::U16)? as usize)?;
        }
        let points = if is_compressed {
            Points::streams(bytes)?
        } else {
            let [width, height] = sizes.map(|size| size.max(0.0) as usize);
            let length = width.checked_mul(height).and_then(|count| count.checked_mul(kind.size()));
            Points::Plain(bytes.take(length.ok_or_else(ended)?)?)
        };
        let object = Self {
            name: name.trim().to_owned(),
            image: Image::new(sizes, true),
            kind,
            spacings: [at(spacings[0], Number::F32)?, at(spacings[1], Number::F32)?, at(spacings[2], Number::F32)?],
            units: [unit(0)?, unit(1)?, unit(2)?],
            bad,
            of,
            points,
        };
        Ok((object, at(14, Number::I16)?.max(1.0) as usize))
    }

    fn heights_unit(&self) -> Option<HeightsUnit> {
        Some(&self.units[2]).filter(|unit| !unit.is_empty()).map(|unit| HeightsUnit::of(unit))
    }

    fn stored(self) -> Result<Measured, Fault> {
        // Pictures: of one bit, of intensities, in colours.
        if [3.0, 10.0, 12.0, 18.0].contains(&self.of) {
            let fault = Fault::new("holds a picture, not heights", "no heights");
            return Err(fault.help("export the surface alone").or_elsewhere());
        }
        let unit = self.heights_unit();
        let image = self.image?;
        let [x, y, z] = self.spacings;
        if !(x > 0.0 && y > 0.0 && x.is_finite() && y.is_finite() && z.is_finite() && z != 0.0) {
            return Err(broken("a spacing of its header is no length greater than 0"));
        }
        let points = self.points.plain(self.kind.size() * image.len())?;
        let heights = image.scaled(z, |k| {
            let point = self.kind.at(&points, k);
            if self.bad == Some(point) { f64::NAN } else { point }
        })?;
        let side = |count: usize, spacing: f64, unit: &str| Length {
            value: count as f64 * spacing,
            unit: Some(unit.to_owned()).filter(|unit| !unit.is_empty()),
        };
        let sides = [side(image.width, x, &self.units[0]), side(image.height, y, &self.units[1])];
        Ok(Measured { heights, sides, unit, doubts: Vec::new() })
    }
}

impl<'a> Points<'a> {
    fn streams(bytes: &mut Bytes<'a>) -> Result<Self, Fault> {
        let count = bytes.size()?;
        // A false number of streams is larger than the file.
        let mut lengths = Bytes::new(bytes.take(count.checked_mul(8).ok_or_else(ended)?)?);
        fits((count * size_of::<(usize, &[u8])>()) as u64)?;
        let mut streams = Vec::with_capacity(count);
        for _ in 0..count {
            let (before, after) = (lengths.size()?, lengths.size()?);
            streams.push((before, bytes.take(after)?));
        }
        Ok(Self::Compressed(streams))
    }

    /// The points as `length` bytes.
    fn plain(self, length: usize) -> Result<Cow<'a, [u8]>, Fault> {
        let streams = match self {
            Self::Plain(bytes) => return Ok(Cow::Borrowed(bytes)),
            Self::Compressed(streams) => streams,
        };
        let total = streams.iter().fold(0_usize, |sum, (before, _)| sum.saturating_add(*before));
        if total != length || streams.iter().any(|(before, bytes)| *before > RATIO * bytes.len()) {
            return Err(broken("its compressed points are not as many as its header states"));
        }
        fits(2 * length as u64)?;
        let mut points = Vec::with_capacity(length);
        for (before, bytes) in streams {
            let unpacked =
                decompress_to_vec_zlib_with_limit(bytes, before).map_err(|_| broken("its points do not unpack"))?;
            if unpacked.len() != before {
                return Err(broken("its compressed points are not as many as its header states"));
            }
            points.extend(unpacked);
        }
        Ok(Cow::Owned(points))
    }
}
