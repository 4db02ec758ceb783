//! X3P files (ISO 25178-72, earlier ISO 5436-2): a zip with `main.xml` and binary matrices, all in metres.
//!
//! ```text
//! main.xml                                            bindata/data.bin (the name is that of PointDataLink)
//! Record1 Axes CX, CY   AxisType I; Increment, m        SizeX × SizeY × SizeZ numbers, x fastest, then y, then the layers;
//!              CZ       AxisType A; DataType;           I i16 | L i32 | F f32 | D f64, little-endian
//!                       Increment, m (1 if absent)    bindata/valid.bin (ValidPointsLink, optional)
//! Record3 MatrixDimension SizeX, SizeY, SizeZ           a bit a number, the lowest of each byte first: 1 is measured
//!         DataLink PointDataLink, ValidPointsLink
//! ```
//!
//! Heights are numbers × Increment of CZ; NaN and infinite ones have no measurement. y grows from line to line (ISO 25178-72: the
//! first number is at the lower left; under ISO 5436-2 many programs had it on top). A `Rotation` of the axes (r11 … r33) other than the
//! identity is refused. What a zip unpacks to is limited by what `main.xml` states, and compared with its checksum. `main.xml` itself is
//! limited in its length and its namespaces, with whose number the time to parse it rises steeply.

use super::binary::{Image, Number, broken, text};
use super::channel::{Channel, WantedChannel, choose};
use super::fault::{Fault, fits};
use super::header::{HeightsUnit, Length};
use super::measured::Measured;
use miniz_oxide::inflate::decompress_to_vec_with_limit;
use roxmltree::{Document, Node};
use std::io::{Cursor, Read};
use zip::{CompressionMethod, ZipArchive};

/// First bytes of a zip.
pub const MAGIC: &[u8] = b"PK\x03\x04";
/// Most bytes of `main.xml`, of which real ones have 2000 to 10000.
const LONGEST: u64 = 1 << 16;
/// Most declarations of namespaces in `main.xml`, of which real ones have two or three.
const MOST_NAMESPACES: usize = 16;
/// Largest difference of a rotation from the identity, by rounding.
const ROTATED: f64 = 1e-6;
/// Most layers of a matrix.
const MOST_LAYERS: f64 = 1000.0;
/// Largest factor by which deflate compresses.
const RATIO: u64 = 1040;

/// What `main.xml` states.
#[derive(Debug)]
struct Matrix {
    image: Image,
    layers: usize,
    /// Increments of x, y and z, m.
    increments: [f64; 3],
    kind: Number,
    /// Names of the files with the numbers and with the bits.
    data: String,
    valid: Option<String>,
}

/// Reads the layer that is `wanted`.
pub fn read(content: &[u8], wanted: Option<&WantedChannel>) -> Result<Measured, Fault> {
    let mut archive = Archive::open(content)?;
    let main = archive.entry("main.xml", LONGEST)?;
    let matrix = Matrix::read(text(&main).trim_start_matches('\u{feff}'))?;
    let unit = || HeightsUnit::Known("m".to_owned());
    let layer = |number: usize| Channel { name: format!("layer {number}"), unit: Some(unit()) };
    let index = choose(&(1..=matrix.layers).map(layer).collect::<Vec<_>>(), wanted)?;
    let first = index * matrix.image.len();
    let count = matrix.layers * matrix.image.len();
    let data = archive.exactly(&matrix.data, matrix.kind.size() * count)?;
    let valid = matrix.valid.as_ref().map(|name| archive.exactly(name, count.div_ceil(8))).transpose()?;
    let is_measured = |k: usize| valid.as_ref().is_none_or(|bits| bits[k / 8] >> (k % 8) & 1 == 1);
    let [x, y, z] = matrix.increments;
    let heights = matrix.image.heights(|k| {
        let value = matrix.kind.at(&data, first + k);
        if is_measured(first + k) && value.is_finite() { z * value } else { f64::NAN }
    })?;
    let side = |count: usize, spacing: f64| Length { value: count as f64 * spacing, unit: Some("m".to_owned()) };
    let sides = [side(matrix.image.width, x), side(matrix.image.height, y)];
    Ok(Measured { heights, sides, unit: Some(unit()), doubts: Vec::new() })
}

/// The files of a zip.
struct Archive<'a> {
    zip: ZipArchive<Cursor<&'a [u8]>>,
    /// Folder of `main.xml`, with its slash: empty but in zips of a folder.
    folder: String,
}

impl<'a> Archive<'a> {
    fn open(content: &'a [u8]) -> Result<Self, Fault> {
        let zip = ZipArchive::new(Cursor::new(content)).map_err(|_| broken("it is no whole zip"))?;
        let names = zip.file_names().filter_map(Result::ok);
        let mut folders: Vec<String> = names
            .filter_map(|name| name.strip_suffix("main.xml").map(str::to_owned))
            .filter(|folder| folder.is_empty() || folder.ends_with('/') && !folder.starts_with("__MACOSX"))
            .collect();
        folders.sort_by_key(String::len);
        let folder = folders.into_iter().next().ok_or_else(|| {
            Fault::new("is a zip without a main.xml, and no X3P file", "this file").help("unpack what is in it before")
        })?;
        Ok(Self { zip, folder })
    }

    /// The content of a file of at most `most` bytes.
    fn entry(&mut self, name: &str, most: u64) -> Result<Vec<u8>, Fault> {
        let name = format!("{}{}", self.folder, name.trim_start_matches("./").trim_start_matches('/'));
        let index =
            self.zip.index_for_name(&name).ok_or_else(|| broken("a file that its main.xml names is missing"))?;
        let mut entry = self.zip.by_index_raw(index).map_err(|_| broken("a file of its zip cannot be found"))?;
        let (size, packed, method) = (entry.size(), entry.compressed_size(), entry.compression());
        let checksum = entry.crc32();
        // The sizes may both be false: what is unpacked is limited, and what is packed by the length of the zip.
        if size > most || size > packed.saturating_mul(RATIO) {
            return Err(broken(format_args!(
                "a file of its zip says that it has {size} bytes, at most {most} belong there"
            )));
        }
        if method == CompressionMethod::STORE && packed != size {
            return Err(broken("a file of its zip is stored with another size than it states"));
        }
        fits(size.saturating_add(packed))?;
        let mut bytes = Vec::new();
        entry.by_ref().take(packed).read_to_end(&mut bytes).map_err(|_| broken("a file of its zip is cut off"))?;
        let content = match method {
            CompressionMethod::STORE => bytes,
            CompressionMethod::DEFLATE => decompress_to_vec_with_limit(&bytes, size as usize)
                .map_err(|_| broken("a file of its zip does not unpack to the size that it states"))?,
            _ => {
                let fault = Fault::new("is packed by another method than X3P files are", "this file");
                return Err(fault.help("export it again"));
            }
        };
        match crc32fast::hash(&content) == checksum {
            true => Ok(content),
            false => Err(broken("a file of its zip has another checksum than the zip states")),
        }
    }

    /// The content of a file of `length` bytes.
    fn exactly(&mut self, name: &str, length: usize) -> Result<Vec<u8>, Fault> {
        let content = self.entry(name, length as u64)?;
        if content.len() == length {
            return Ok(content);
        }
        Err(broken(format_args!("a file of its zip has {} bytes, by its main.xml it has {length}", content.len())))
    }
}

impl Matrix {
    fn read(main: &str) -> Result<Self, Fault> {
        if main.matches("xmlns").nth(MOST_NAMESPACES).is_some() {
            return Err(broken(format_args!("its main.xml declares more than {MOST_NAMESPACES} namespaces")));
        }
        let document = Document::parse(main).map_err(|_| broken("its main.xml is no XML"))?;
        let root = document.root_element();
        let axis =
            |name: &str| at(root, &["Record1", "Axes", name]).ok_or_else(|| broken("its main.xml lacks an axis"));
        let kind_of =
            |axis: Node<'_, '_>| at(axis, &["AxisType"]).and_then(|own| own.text()).map_or("", str::trim).to_owned();
        let axes = [axis("CX")?, axis("CY")?, axis("CZ")?];
        if axes.map(kind_of) != ["I", "I", "A"] {
            let what = "holds points with coordinates of their own, not heights on a regular grid";
            return Err(
                Fault::new(what, "no regular grid").help("export it as a surface, or put it on a regular grid before")
            );
        }
        if at(root, &["Record1", "Axes", "Rotation"]).is_some_and(is_rotated) {
            let what = "has axes that are rotated or mirrored by its main.xml";
            return Err(Fault::new(what, "rotated axes")
                .help("turn the surface in the program that wrote it, so that the matrix Rotation is the identity"));
        }
        // Heights without an increment are in metres; a spacing has no default.
        let mut increments = [f64::NAN, f64::NAN, 1.0];
        for (own, axis) in increments.iter_mut().zip(axes) {
            let written = at(axis, &["Increment"]).and_then(|own| own.text()).map_or("", str::trim);
            if !written.is_empty() {
                *own = written.parse().map_err(|_| broken("an increment of an axis is no number"))?;
            } else if own.is_nan() {
                return Err(broken("its main.xml lacks the increment of x or y"));
            }
        }
        let [x, y, z] = increments;
        if !(x > 0.0 && y > 0.0 && z != 0.0 && increments.iter().all(|own| own.is_finite())) {
            return Err(broken("an increment of an axis is no length greater than 0"));
        }
        let kind = match at(axes[2], &["DataType"]).and_then(|own| own.text()).map_or("", str::trim) {
            "I" => Number::I16,
            "L" => Number::I32,
            "F" => Number::F32,
            "D" => Number::F64,
            _ => return Err(broken("its heights are of a type that the format does not have")),
        };
        let size = |name: &str| -> Result<f64, Fault> {
            let own = at(root, &["Record3", "MatrixDimension", name]).and_then(|own| own.text());
            own.and_then(|own| own.trim().parse().ok()).ok_or_else(|| broken("its main.xml lacks a size of its matrix"))
        };
        let image = Image::new([size("SizeX")?, size("SizeY")?], false)?;
        let layers = size("SizeZ")?;
        if !(1.0..=MOST_LAYERS).contains(&layers) || layers.fract() != 0.0 {
            return Err(broken("it has no layer or too many"));
        }
        let link = |name: &str| {
            let own = at(root, &["Record3", "DataLink", name]).and_then(|own| own.text()).map(str::trim);
            own.filter(|own| !own.is_empty()).map(str::to_owned)
        };
        let data = link("PointDataLink").ok_or_else(|| {
            Fault::new("holds its heights as text in main.xml", "no binary data").help("export it with binary data")
        })?;
        Ok(Self { image, layers: layers as usize, increments, kind, data, valid: link("ValidPointsLink") })
    }
}

/// Whether a rotation is not the identity; elements that it lacks are those of the identity.
fn is_rotated(rotation: Node<'_, '_>) -> bool {
    (1..=9).any(|k| {
        let (row, column) = ((k + 2) / 3, (k + 2) % 3 + 1);
        let written = at(rotation, &[&format!("r{row}{column}")]).and_then(|own| own.text());
        let identity = f64::from(u8::from(row == column));
        written.is_some_and(|own| !own.trim().parse().is_ok_and(|own: f64| (own - identity).abs() <= ROTATED))
    })
}

/// The element at a path of names below another one, whatever their namespaces.
fn at<'a, 'input>(from: Node<'a, 'input>, path: &[&str]) -> Option<Node<'a, 'input>> {
    path.iter().try_fold(from, |node, name| node.children().find(|child| child.tag_name().name() == *name))
}
