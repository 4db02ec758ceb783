//! `load.pressure`: a pressure that is given, on discs or from a file, in the place of a counterbody.

use serde::{Serialize, Serializer};
use std::path::PathBuf;

use super::error::Refusal;
use super::keys::{Form, Key, Range, Unit};
use super::lattice::{LatticeSection, build_cell};
use super::node::Value;
use super::reader::TableAt;
use super::section::{KeyValue, section};
use super::source::Source;
use super::surface;
use super::value::ValueAt;
use crate::counterbody::{CounterbodyError, GivenPressure, LoadedDisc};
use crate::numeric::array::field;

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

fn one_value_each(own: &DiscsSection, section: &TableAt<'_>) -> Result<(), Refusal> {
    let (discs, values) = (own.disc.len(), own.value.0.len());
    if values == 1 || values == discs {
        return Ok(());
    }
    let refusal = section.value("value")?.refuse(format!("one pressure for all discs, or {discs}, one for each"));
    Err(refusal.help(format!("received {values} for {discs} discs")))
}

/// The given pressure of a case; `None` where it prescribes another load.
pub(super) fn read(root: &TableAt<'_>, source: &Source) -> Result<Option<GivenPressure>, Refusal> {
    let load = root.section("load")?;
    let Some(value) = load.and_then(|load| load.optional("pressure")) else { return Ok(None) };
    let own = GivenSection::read(&value)?;
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
        let own = key.as_ref().unwrap_or(&value);
        Refusal::new(own.node.span, format!("`{}`: {error}", own.path), "this pressure")
    };
    let given = match own {
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
            let stored = surface::stored(source, &path, &value, "pressures at equally spaced samples of the cell")?;
            let heights = stored.map_err(|fault| {
                let message = format!("`{}`: {} {}", value.path, path.display(), fault.what);
                let refusal = Refusal::new(value.node.span, message, fault.label);
                fault.help.into_iter().fold(refusal, Refusal::help)
            })?;
            GivenPressure::field(cell, field(heights.heights.points, heights.heights.values))
                .map_err(|error| refuse(error, None))
        }
    };
    given.map(Some)
}

impl GivenSection {
    /// It with the absolute path of its file.
    pub(super) fn located(self, source: &Source) -> Self {
        match self {
            Self::File(name) => Self::File(source.path(&name).map_or(name, |path| path.to_string_lossy().into_owned())),
            discs => discs,
        }
    }
}
