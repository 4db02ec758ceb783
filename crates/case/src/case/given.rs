//! `load.pressure`: a pressure that is given, on discs or from a file, in the place of a counterbody.

use serde::{Serialize, Serializer};
use std::path::PathBuf;

use super::error::Refusal;
use super::keys::{Form, Key, Range, Unit};
use super::lattice::{LatticeSection, build_cell};
use super::node::Value;
use super::reader::TableAt;
use super::section::{KeyValue, ReadTable, section};
use super::source::Source;
use super::surface;
use super::value::ValueAt;
use percoat_core::counterbody::{CounterbodyError, GivenPressure, LoadedDisc};
use percoat_core::lattice::Cell;
use percoat_core::notation::number;
use percoat_core::numeric::array::field;
use percoat_surfaces::heights::{Fault, HeightsUnit, Stored};

/// Most discs of a load.
const MOST: usize = 1000;
const COORDINATE: Form = Form::Number(Range::Coordinate);
const SIZE: Form = Form::Number(Range::Size);
const SIZE_OR_ZERO: Form = Form::Number(Range::SizeOrZero);
const DISC: Form = Form::Tuple("a disc [x, y, radius]", &[COORDINATE, COORDINATE, SIZE]);

section! {
    /// Discs under uniform pressures.
    pub struct DiscsSection = DISCS, rules one_value_each {
        /// middle and radius of each disc
        pub disc: Vec<[f64; 3]> = Key::new(&[Form::List { of: &DISC, count: [1, MOST] }], "[[0.0, 0.0, 0.1]]").unit(Unit::Length),
        /// pressure on the discs, one for all or one for each
        pub value: Pressures =
            Key::new(&[SIZE_OR_ZERO, Form::List { of: &SIZE_OR_ZERO, count: [1, MOST] }], "0.7").unit(Unit::Pressure),
    }
}

/// Pressures of discs: one for all, or one for each.
#[derive(Debug, Clone, PartialEq)]
pub struct Pressures(Vec<f64>);

/// A given pressure, as a case has it.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum GivenSection {
    /// Uniform on discs.
    Discs(DiscsSection),
    /// A field from a file, by its path.
    File(String),
}

impl Serialize for Pressures {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.0[..] {
            [one] => serializer.serialize_f64(one),
            _ => self.0.serialize(serializer),
        }
    }
}

impl KeyValue for Pressures {
    fn read(value: &ValueAt<'_>) -> Result<Self, Refusal> {
        match &value.node.value {
            Value::List(_) => Vec::read(value),
            _ => value.number().map(|pressure| vec![pressure]),
        }
        .map(Self)
    }
}

impl KeyValue for GivenSection {
    fn read(value: &ValueAt<'_>) -> Result<Self, Refusal> {
        match &value.node.value {
            Value::Text(path) => Ok(Self::File(path.clone())),
            _ => DiscsSection::read(value).map(Self::Discs),
        }
    }
}

fn one_value_each(given: &DiscsSection, section: &TableAt<'_>) -> Result<(), Refusal> {
    let (discs, values) = (given.disc.len(), given.value.0.len());
    if values == 1 || values == discs {
        return Ok(());
    }
    let refusal = section.value("value")?.refuse(format!("one pressure for all discs, or {discs}, one for each"));
    Err(refusal.help(format!("received {values} for {discs} discs")))
}

/// The given pressure of a case with warnings about its file; `None` where it prescribes another load. `length`: the unit of the
/// case's lengths, if any.
pub(super) fn read(
    root: &TableAt<'_>,
    source: &Source,
    length: Option<&str>,
) -> Result<Option<(GivenPressure, Vec<String>)>, Refusal> {
    let load = root.section("load")?;
    let Some(value) = load.and_then(|load| load.optional("pressure")) else { return Ok(None) };
    let form = GivenSection::read(&value)?;
    for other in ["levels", "surface", "counterbody"] {
        if let Some(other) = root.optional(other) {
            let message = format!("`{}` is given beside `load.pressure`, which needs nothing that presses", other.path);
            return Err(
                Refusal::new(other.node.span, message, "`load.pressure` is given too").help("remove one of them")
            );
        }
    }
    let lattice_section = root.required_section("lattice")?;
    let cell = build_cell(&LatticeSection::read_table(&lattice_section)?, &lattice_section)?;
    let refuse = |error: CounterbodyError, key: Option<ValueAt<'_>>| {
        let value = key.as_ref().unwrap_or(&value);
        Refusal::new(value.node.span, format!("`{}`: {error}", value.path), "this pressure")
    };
    let mut doubts = Vec::new();
    let given = match form {
        GivenSection::Discs(DiscsSection { disc, value: Pressures(pressures) }) => {
            let loaded = |(index, [x, y, radius]): (usize, [f64; 3])| {
                let pressure = pressures[if pressures.len() == 1 { 0 } else { index }];
                LoadedDisc { centre: [x, y], radius, pressure }
            };
            let discs = disc.into_iter().enumerate().map(loaded).collect();
            let table = value.table()?;
            GivenPressure::discs(cell, discs).map_err(|error| {
                let key = if error == CounterbodyError::Unloaded { "value" } else { "disc" };
                refuse(error, table.optional(key))
            })
        }
        GivenSection::File(name) => {
            let path = source.path(&name).unwrap_or_else(|| PathBuf::from(&name));
            let stored =
                surface::stored(source, &path, &value, None, "pressures at equally spaced samples of the cell")?;
            let complete = stored.and_then(|stored| match stored.holes() {
                0 => Ok(stored),
                holes => Err(Fault::new(format!("has no number at {holes} places"), "a pressure is missing")
                    .help("a pressure is needed everywhere: 0 where nothing presses")),
            });
            let stored = complete.map_err(|fault| surface::refused(&value, &path, fault))?;
            doubts = doubts_of(&stored, &value.path, cell, length);
            GivenPressure::field(cell, field(stored.heights.points, stored.heights.values))
                .map_err(|error| refuse(error, None))
        }
    };
    Ok(Some((given?, doubts)))
}

/// Warnings about a file of pressures: those of its format, sides other than those of the cell, and a unit of length.
fn doubts_of(stored: &Stored, path: &str, cell: Cell, length: Option<&str>) -> Vec<String> {
    let sides = stored.sides.as_ref().map(|sides| sides.each_ref().map(|side| side.in_unit(length, 1.0)));
    let sides = sides.and_then(|[one, two]| Some([one?, two?]));
    let of_cell = cell.vectors().map(|[x, y]| x.hypot(y));
    let differs = |stated: &[f64; 2]| (0..2).any(|axis| (stated[axis] / of_cell[axis] - 1.0).abs() > 0.01);
    let stretched = sides.filter(differs).map(|stated| {
        let [stated, cell] = [stated, of_cell].map(|sides| sides.map(number).join(" × "));
        format!("`{path}`: its file says that it is {stated} large, and is laid on the cell, {cell}: make both equal")
    });
    let unit = match &stored.unit {
        Some(HeightsUnit::Known(unit)) => Some(format!(
            "`{path}`: its file says that its numbers are in {unit}, a length; they are read as pressures in the unit of the case"
        )),
        _ => None,
    };
    stored.doubts.iter().cloned().chain(stretched).chain(unit).collect()
}

impl GivenSection {
    /// The section with the absolute path of its file.
    pub(super) fn located(self, source: &Source) -> Self {
        match self {
            Self::File(name) => Self::File(source.path(&name).map_or(name, |path| path.to_string_lossy().into_owned())),
            discs => discs,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use percoat_surfaces::heights::Length;

    #[test]
    fn a_file_of_other_sides_or_in_a_unit_of_length_is_doubted() {
        let cell = Cell::window([10.0, 5.0]).unwrap();
        let stored = |sides: [f64; 2], unit: Option<HeightsUnit>| {
            let array = ndarray::Array2::from_elem([4, 4], 1.0).into_dyn();
            let side = |value: f64| Length { value, unit: Some("mm".to_owned()) };
            Stored { sides: Some(sides.map(side)), unit, ..Stored::of(&array, None).unwrap() }
        };
        let doubts = |file: &Stored| doubts_of(file, "load.pressure", cell, Some("µm"));
        assert_eq!(doubts(&stored([0.01, 0.005], None)), Vec::<String>::new());
        assert_eq!(
            doubts(&stored([0.004, 0.005], Some(HeightsUnit::Known("nm".to_owned())))),
            [
                "`load.pressure`: its file says that it is 4.0000 × 5.0000 large, and is laid on the cell, 10.000 × 5.0000: make both \
                 equal",
                "`load.pressure`: its file says that its numbers are in nm, a length; they are read as pressures in the unit of the case",
            ]
        );
    }
}
