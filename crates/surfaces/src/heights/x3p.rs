//! X3P files (ISO 25178-72, earlier ISO 5436-2): a zip with `main.xml` and binary matrices, all in metres.
//!
//! ```text
//! main.xml                                            bindata/data.bin (the name is that of PointDataLink)
//! Record1 Axes CX, CY   AxisType I; Increment, m        SizeX × SizeY × SizeZ numbers, x fastest, then y, then the layers;
//!              CZ       AxisType A; DataType;           I i16 | L i32 | F f32 | D f64, little-endian
//!                       Increment, m (1 if absent)    bindata/valid.bin (ValidPointsLink, optional)
//! Record3 MatrixDimension SizeX, SizeY, SizeZ           a bit a number, the lowest of each byte first: 1 is measured
//!         DataLink PointDataLink, ValidPointsLink     md5checksum.hex (the name is that of ChecksumFile, optional)
//!                  MD5ChecksumPointData,                of main.xml
//!                  MD5ChecksumValidPoints
//!      or DataList Datum: the numbers as text, as in the samples of the standard
//! Record4 ChecksumFile
//! ```
//!
//! Heights are numbers × Increment of CZ; NaN and infinite ones, and empty data, have no measurement. y grows from line to line (ISO 25178-72:
//! the first number is at the lower left; under ISO 5436-2 many programs had it on top). A `Rotation` of the axes (r11 … r33) other than the
//! identity is refused, and so is whatever is there twice: a member of the zip, a `main.xml`, an element. Checksums must match, where they are
//! stated, as in x3pio 2.0. What a zip unpacks to is limited by what `main.xml` states. `main.xml` itself, without heights, is
//! limited in its length and its namespaces, with whose number the time to parse it rises steeply.

use super::archive::{Archive, MAIN};
use super::binary::{Image, Number, broken, twice, whole_text};
use super::channel::{Channel, WantedChannel, choose};
use super::datums;
use super::fault::Fault;
use super::header::{HeightsUnit, Length};
use super::measured::Measured;
use roxmltree::{Document, Node};

/// First bytes of a zip.
pub const MAGIC: &[u8] = b"PK\x03\x04";
/// Most bytes of `main.xml` without heights, of which real ones have 2000 to 10000.
const LONGEST: usize = 1 << 16;
/// Most bytes of `main.xml` with heights: seven million of them.
const LONGEST_WITH_HEIGHTS: u64 = 1 << 28;
/// Name of the member with the checksum of `main.xml`, where `main.xml` has none.
const CHECKSUM: &str = "md5checksum.hex";
/// Most declarations of namespaces in `main.xml`, of which real ones have two or three.
const MOST_NAMESPACES: usize = 16;
/// Largest difference of a rotation from the identity, by rounding.
const ROTATED: f64 = 1e-6;
/// Most layers of a matrix.
const MOST_LAYERS: f64 = 1000.0;

/// Matrix as `main.xml` states it.
#[derive(Debug)]
struct Matrix {
    image: Image,
    layers: usize,
    /// Increments of x, y and z, m.
    increments: [f64; 3],
    kind: Number,
    /// Names of the members with the numbers and with the bits; none where the numbers are text.
    data: Option<Link>,
    valid: Option<Link>,
    /// Name of the member with the checksum of `main.xml`.
    checksum: String,
}

/// A member of the zip and its checksum, if that is stated.
#[derive(Debug)]
struct Link {
    name: String,
    md5: Option<String>,
}

/// Reads the layer that is `wanted`.
pub fn read(content: &[u8], wanted: Option<&WantedChannel>) -> Result<Measured, Fault> {
    let mut archive = Archive::open(content)?;
    let main = archive.member(MAIN, LONGEST_WITH_HEIGHTS)?;
    let text = whole_text(&main)?;
    let text = text.trim_start_matches('\u{feff}');
    let apart = datums::apart(text, LONGEST);
    let matrix = Matrix::read(apart.as_ref().map_or(text, |(head, _)| head))?;
    archive.verify(&main, &matrix.checksum)?;
    let unit = || HeightsUnit::Known("m".to_owned());
    let layer = |number: usize| Channel { name: format!("layer {number}"), unit: Some(unit()) };
    let index = choose(&(1..=matrix.layers).map(layer).collect::<Vec<_>>(), wanted)?;
    let first = index * matrix.image.len();
    let [x, y, z] = matrix.increments;
    let measured = |value: f64| if value.is_finite() { value } else { f64::NAN };
    let heights = match &matrix.data {
        Some(link) => {
            let Binary { numbers, bits } = matrix.binary(&mut archive, link)?;
            let is_valid = |k: usize| bits.as_ref().is_none_or(|bits| bits[k / 8] >> (k % 8) & 1 == 1);
            let value = |k: usize| if is_valid(k) { matrix.kind.at(&numbers, k) } else { f64::NAN };
            matrix.image.scaled(z, |k| measured(value(first + k)))?
        }
        None => {
            let list = apart.as_ref().map_or("", |(_, list)| list);
            let numbers = datums::numbers(list, matrix.layers * matrix.image.len())?;
            matrix.image.scaled(z, |k| measured(numbers[first + k]))?
        }
    };
    let side = |count: usize, spacing: f64| Length { value: count as f64 * spacing, unit: Some("m".to_owned()) };
    let sides = [side(matrix.image.width, x), side(matrix.image.height, y)];
    Ok(Measured { heights, sides, unit: Some(unit()), doubts: Vec::new() })
}

/// Members of a zip with numbers and with a bit for each that is 1 where it is measured.
struct Binary {
    numbers: Vec<u8>,
    bits: Option<Vec<u8>>,
}

impl Matrix {
    fn read(main: &str) -> Result<Self, Fault> {
        if main.len() > LONGEST {
            return Err(broken(format_args!(
                "its main.xml has {} bytes, at most {LONGEST} belong there beside heights",
                main.len()
            )));
        }
        if main.matches("xmlns").nth(MOST_NAMESPACES).is_some() {
            return Err(broken(format_args!("its main.xml declares more than {MOST_NAMESPACES} namespaces")));
        }
        let document = Document::parse(main).map_err(|_| broken("its main.xml is no XML"))?;
        let root = document.root_element();
        let axis =
            |name: &str| at(root, &["Record1", "Axes", name])?.ok_or_else(|| broken("its main.xml lacks an axis"));
        let axes = [axis("CX")?, axis("CY")?, axis("CZ")?];
        let kind_of = |axis: Node<'_, '_>| text_at(axis, &["AxisType"]).map(|text| text.unwrap_or_default().to_owned());
        if [kind_of(axes[0])?, kind_of(axes[1])?, kind_of(axes[2])?] != ["I", "I", "A"] {
            let what = "holds points with coordinates of their own, not heights on a regular grid";
            let fault = Fault::new(what, "no regular grid");
            return Err(fault.help("export it as a surface, or put it on a regular grid before").or_elsewhere());
        }
        if at(root, &["Record1", "Axes", "Rotation"])?.map_or(Ok(false), is_rotated)? {
            let what = "has axes that are rotated or mirrored by its main.xml";
            return Err(Fault::new(what, "rotated axes")
                .help("turn the surface in the program that wrote it, so that the matrix Rotation is the identity"));
        }
        let increments = increments(axes)?;
        let kind = match text_at(axes[2], &["DataType"])?.unwrap_or_default() {
            "I" => Number::I16,
            "L" => Number::I32,
            "F" => Number::F32,
            "D" => Number::F64,
            _ => return Err(broken("its heights are of a type that the format does not have")),
        };
        let size = |name: &str| -> Result<f64, Fault> {
            let parsed = text_at(root, &["Record3", "MatrixDimension", name])?.and_then(|text| text.parse().ok());
            parsed.ok_or_else(|| broken("its main.xml lacks a size of its matrix"))
        };
        let image = Image::new([size("SizeX")?, size("SizeY")?], false)?;
        let layers = size("SizeZ")?;
        if !(1.0..=MOST_LAYERS).contains(&layers) || layers.fract() != 0.0 {
            return Err(broken("it has no layer or too many"));
        }
        let link = |name: &str, md5: &str| -> Result<Option<Link>, Fault> {
            let md5 = text_at(root, &["Record3", "DataLink", md5])?.map(str::to_owned);
            let name = text_at(root, &["Record3", "DataLink", name])?.map(str::to_owned);
            Ok(name.map(|name| Link { name, md5 }))
        };
        let data = link("PointDataLink", "MD5ChecksumPointData")?;
        match (&data, at(root, &["Record3", "DataList"])?) {
            (Some(_), Some(_)) => return Err(twice("its heights")),
            (None, None) => return Err(broken("its main.xml holds no heights, and names no file of them")),
            _ => {}
        }
        let checksum = text_at(root, &["Record4", "ChecksumFile"])?.unwrap_or(CHECKSUM).to_owned();
        let valid = link("ValidPointsLink", "MD5ChecksumValidPoints")?;
        Ok(Self { image, layers: layers as usize, increments, kind, data, valid, checksum })
    }

    /// The numbers of the member that `link` names.
    fn binary(&self, archive: &mut Archive<'_>, link: &Link) -> Result<Binary, Fault> {
        let count = self.layers * self.image.len();
        let mut member = |link: &Link, length: usize| archive.exactly(&link.name, length, link.md5.as_deref());
        let numbers = member(link, self.kind.size() * count)?;
        let bits = self.valid.as_ref().map(|link| member(link, count.div_ceil(8))).transpose()?;
        Ok(Binary { numbers, bits })
    }
}

/// Increments of x, y and z.
fn increments(axes: [Node<'_, '_>; 3]) -> Result<[f64; 3], Fault> {
    // Heights without an increment are in metres; a spacing has no default.
    let mut increments = [f64::NAN, f64::NAN, 1.0];
    for (increment, axis) in increments.iter_mut().zip(axes) {
        if let Some(written) = text_at(axis, &["Increment"])? {
            *increment = written.parse().map_err(|_| broken("an increment of an axis is no number"))?;
        } else if increment.is_nan() {
            return Err(broken("its main.xml lacks the increment of x or y"));
        }
    }
    let [x, y, z] = increments;
    if x > 0.0 && y > 0.0 && z != 0.0 && increments.iter().all(|increment| increment.is_finite()) {
        return Ok(increments);
    }
    Err(broken("an increment of an axis is no length greater than 0"))
}

/// Whether a rotation is not the identity; elements that it lacks are those of the identity.
fn is_rotated(rotation: Node<'_, '_>) -> Result<bool, Fault> {
    for k in 1..=9 {
        let (row, column) = ((k + 2) / 3, (k + 2) % 3 + 1);
        let identity = f64::from(u8::from(row == column));
        let is_it = |text: &str| text.parse().is_ok_and(|element: f64| (element - identity).abs() <= ROTATED);
        if text_at(rotation, &[&format!("r{row}{column}")])?.is_some_and(|text| !is_it(text)) {
            return Ok(true);
        }
    }
    Ok(false)
}

/// The element at a path of names below another one, whatever their namespaces; refused where there are two.
fn at<'a, 'input>(from: Node<'a, 'input>, path: &[&str]) -> Result<Option<Node<'a, 'input>>, Fault> {
    let mut node = from;
    for name in path {
        let mut named = node.children().filter(|child| child.tag_name().name() == *name);
        let Some(first) = named.next() else { return Ok(None) };
        if named.next().is_some() {
            return Err(twice(format_args!("an element {name} of its main.xml")));
        }
        node = first;
    }
    Ok(Some(node))
}

/// The text of the element at a path, without blanks around it; `None` where it is empty.
fn text_at<'a>(from: Node<'a, '_>, path: &[&str]) -> Result<Option<&'a str>, Fault> {
    Ok(at(from, path)?.and_then(|element| element.text()).map(str::trim).filter(|text| !text.is_empty()))
}
