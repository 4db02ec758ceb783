//! Gwyddion's own files, `.gwy`: containers of objects, several channels of heights and their masks.
//!
//! Little-endian throughout (Gwyddion user guide, "Format of Gwyddion files"):
//!
//! ```text
//! file       "GWYP", then one object
//! object     name, NUL; size of its components, u32; components
//! component  name, NUL; type, one character; value
//! type       b u8 | c char | i i32 | q i64 | d f64 | s text, NUL | o object; a capital: count, u32, and so many of them
//!
//! GwyContainer   "/0/data" o, "/0/data/title" s, "/0/mask" o, "/1/data" o, …
//! GwyDataField   xres i, yres i: numbers of a line and lines; xreal d, yreal d: sides; si_unit_xy o, si_unit_z o; data D
//! GwySIUnit      unitstr s
//! ```
//!
//! The first line is the top one. A unit that is missing or empty is none, as in images of cameras: the case must say it. Samples where the mask is at least ½ have no measurement.

use super::binary::{Bytes, Image, Number, broken, twice};
use super::channel::{Channel, WantedChannel, choose};
use super::fault::Fault;
use super::header::{HeightsUnit, Length};
use super::measured::Measured;
use percoat_common::encoding::utf8_or_latin1;
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};

/// First bytes of a file.
pub const MAGIC: &[u8] = b"GWYP";

/// A component of an object: its type and the bytes of its value.
type Component<'a> = (u8, &'a [u8]);

/// A field of numbers.
#[derive(Debug)]
struct DataField<'a> {
    /// Numbers of a line and lines of the field, or why it is no surface.
    image: Result<Image, Fault>,
    /// Sides, none where it has the length 1 a number.
    sides: [Option<f64>; 2],
    unit: Option<String>,
    lateral: Option<String>,
    /// Numbers, f64.
    data: &'a [u8],
}

/// Objects of a channel of the container.
#[derive(Debug, Default)]
struct Parts<'a> {
    data: Option<&'a [u8]>,
    mask: Option<&'a [u8]>,
    title: Option<&'a [u8]>,
}

/// Reads the channel that is `wanted`.
pub fn read(content: &[u8], wanted: Option<&WantedChannel>) -> Result<Measured, Fault> {
    let mut bytes = Bytes::new(content);
    bytes.take(MAGIC.len())?;
    let parts = channels(object(&mut bytes, "GwyContainer")?)?;
    let mut fields: Vec<(DataField<'_>, &Parts<'_>)> = Vec::new();
    for channel in parts.values() {
        if let Some(data) = channel.data {
            fields.push((DataField::read(data)?, channel));
        }
    }
    let described = |(field, channel): &(DataField<'_>, &Parts<'_>)| Channel {
        name: channel.title.map(utf8_or_latin1).unwrap_or_default().into_owned(),
        unit: field.heights_unit(),
    };
    let all: Vec<Channel> = fields.iter().map(described).collect();
    if all.is_empty() {
        return Err(Fault::new("holds no channel with an image", "no heights").help("save one of heights in Gwyddion"));
    }
    let index = choose(&all, wanted)?;
    let (field, channel) = fields.swap_remove(index);
    let mask = channel.mask.map(DataField::read).transpose()?;
    field.stored(mask)
}

/// The components of the next object, which must have this name.
fn object<'a>(bytes: &mut Bytes<'a>, name: &str) -> Result<Bytes<'a>, Fault> {
    if bytes.text()? != name {
        return Err(broken(format_args!("it has another object where a {name} belongs")));
    }
    let size = bytes.size()?;
    bytes.take(size).map(Bytes::new)
}

/// The next component with its name.
fn component<'a>(bytes: &mut Bytes<'a>) -> Result<(Cow<'a, str>, Component<'a>), Fault> {
    let name = bytes.text()?;
    let kind = bytes.take(1)?[0];
    Ok((name, (kind, value(bytes, kind)?)))
}

/// The bytes of a value of this type: those of a text without its NUL, those of an object with its name.
fn value<'a>(bytes: &mut Bytes<'a>, kind: u8) -> Result<&'a [u8], Fault> {
    let count = if kind.is_ascii_uppercase() { bytes.size()? } else { 1 };
    let start = bytes.rest;
    let size = match kind.to_ascii_lowercase() {
        b'b' | b'c' => 1,
        b'i' => 4,
        b'q' | b'd' => 8,
        b's' | b'o' => {
            // Each has at least one byte, so that a false count ends with the file.
            for _ in 0..count {
                bytes.text()?;
                if kind.eq_ignore_ascii_case(&b'o') {
                    let size = bytes.size()?;
                    bytes.take(size)?;
                }
            }
            let taken = start.len() - bytes.rest.len();
            return Ok(&start[..if kind == b's' { taken - 1 } else { taken }]);
        }
        _ => return Err(broken("a component is of a type that the format does not have")),
    };
    bytes.take(count.checked_mul(size).ok_or_else(super::binary::ended)?)
}

/// The channels of a container by their numbers.
fn channels(mut container: Bytes<'_>) -> Result<BTreeMap<u32, Parts<'_>>, Fault> {
    let mut parts: BTreeMap<u32, Parts<'_>> = BTreeMap::new();
    while !container.rest.is_empty() {
        let (name, (kind, value)) = component(&mut container)?;
        let Some((number, key)) = name.strip_prefix('/').and_then(|name| name.split_once('/')) else { continue };
        let Ok(number) = number.parse() else { continue };
        let channel = parts.entry(number).or_default();
        let before = match (key, kind) {
            ("data", b'o') => channel.data.replace(value),
            ("mask", b'o') => channel.mask.replace(value),
            ("data/title", b's') => channel.title.replace(value),
            _ => None,
        };
        if before.is_some() {
            return Err(twice("a channel, its mask or its title"));
        }
    }
    Ok(parts)
}

impl<'a> DataField<'a> {
    fn read(bytes: &'a [u8]) -> Result<Self, Fault> {
        let mut components = object(&mut Bytes::new(bytes), "GwyDataField")?;
        let (mut numbers, mut units, mut data) = ([None; 4], [None, None], None);
        let mut names = BTreeSet::new();
        while !components.rest.is_empty() {
            let (name, (kind, value)) = component(&mut components)?;
            if !names.insert(name.clone()) {
                return Err(twice("a part of an image"));
            }
            match (&name[..], kind) {
                ("xres", b'i') => numbers[0] = Some(Number::I32.at(value, 0)),
                ("yres", b'i') => numbers[1] = Some(Number::I32.at(value, 0)),
                ("xreal", b'd') => numbers[2] = Some(Number::F64.at(value, 0)),
                ("yreal", b'd') => numbers[3] = Some(Number::F64.at(value, 0)),
                ("si_unit_xy", b'o') => units[0] = unit_of(value)?,
                ("si_unit_z", b'o') => units[1] = unit_of(value)?,
                ("data", b'D') => data = Some(value),
                _ => {}
            }
        }
        let [width, height, sides @ ..] = numbers;
        let (image, [lateral, unit]) = (Self::image(width.zip(height), data), units);
        Ok(Self { image, sides, unit, lateral, data: data.unwrap_or_default() })
    }

    /// The image of these sizes, of which there must be as many numbers.
    fn image(sizes: Option<(f64, f64)>, data: Option<&[u8]>) -> Result<Image, Fault> {
        let (Some((width, height)), Some(data)) = (sizes, data) else {
            return Err(broken("an image has no size or no data"));
        };
        let image = Image::new([width, height], true)?;
        if data.len() != 8 * image.len() {
            return Err(broken(format_args!("an image of {width} × {height} has {} numbers", data.len() / 8)));
        }
        Ok(image)
    }

    fn heights_unit(&self) -> Option<HeightsUnit> {
        self.unit.as_deref().map(HeightsUnit::of)
    }

    fn stored(self, mask: Option<Self>) -> Result<Measured, Fault> {
        let unit = self.heights_unit();
        let image = self.image?;
        if mask.as_ref().is_some_and(|mask| mask.image != Ok(image)) {
            return Err(broken("the mask of the channel has another size"));
        }
        let [x, y] = self.sides;
        let sides = [x.unwrap_or(image.width as f64), y.unwrap_or(image.height as f64)];
        if !sides.iter().all(|side| side.is_finite() && *side > 0.0) {
            return Err(broken("a side of the image is no length greater than 0"));
        }
        let is_masked = |k: usize| mask.as_ref().is_some_and(|mask| Number::F64.at(mask.data, k) >= 0.5);
        let heights = image.heights(|k| if is_masked(k) { f64::NAN } else { Number::F64.at(self.data, k) })?;
        let masked = (0..image.len()).filter(|k| is_masked(*k)).count();
        let doubt = (masked > 0).then(|| {
            format!(
                "surface.heights: the mask of the channel marks {masked} of {} samples, which count as not measured; remove \
                 the mask in Gwyddion where it marks something else, as grains",
                image.len()
            )
        });
        let side = |value: f64| Length { value, unit: self.lateral.clone() };
        Ok(Measured { heights, sides: sides.map(side), unit, doubts: doubt.into_iter().collect() })
    }
}

/// The text of a unit; none where it is empty.
fn unit_of(bytes: &[u8]) -> Result<Option<String>, Fault> {
    let mut components = object(&mut Bytes::new(bytes), "GwySIUnit")?;
    while !components.rest.is_empty() {
        if let (name, (b's', value)) = component(&mut components)?
            && name == "unitstr"
        {
            return Ok(Some(utf8_or_latin1(value).into_owned()).filter(|unit| !unit.trim().is_empty()));
        }
    }
    Ok(None)
}
