//! `[stress]`: where the stresses are wanted.

use serde::{Serialize, Serializer};

use super::error::Refusal;
use super::layers::is_zero;
use super::magnitude;
use super::node::Value;
use super::reader::TableAt;
use super::value::ValueAt;
use crate::body::MeanStress;
use crate::counterbody::{Counterbody, Indenters};
use crate::lattice::Lattice;
use crate::run::places::SECTION;
use crate::run::{self, StressRequest, Volume};
use crate::stress::SurfaceLine;

/// The section `[stress]`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StressSection {
    /// Depths z ≥ 0 of horizontal planes, lengths; one on an interface gives both sides.
    pub planes: Vec<f64>,
    /// What the mean lateral stress is.
    pub mean: MeanStress,
    /// A vertical cut.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub section: Option<Cut>,
    /// Single points x, y, z; lengths.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub points: Vec<[f64; 3]>,
    /// A volume under the cell for ParaView.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub volume: Option<Volume>,
}

/// A vertical cut from the axis of an indenter toward a neighbour, or from any place along a direction.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Cut {
    /// Where s = 0.
    pub from: Origin,
    /// Where it runs.
    pub toward: Toward,
    /// Length along the surface.
    pub length: f64,
    /// How far behind `from` it begins, a length.
    #[serde(skip_serializing_if = "is_zero")]
    pub behind: f64,
    /// Depth, a length.
    pub depth: f64,
}

/// Where a cut has its origin.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Origin {
    /// At the axis of the first indenter of this level, from 1.
    Level(#[serde(serialize_with = "write_level")] usize),
    /// At this place [x, y], lengths.
    Place([f64; 2]),
}

/// Where a cut runs.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Toward {
    /// Toward the nearest other indenter of this level, from 1.
    Level(#[serde(serialize_with = "write_level")] usize),
    /// Along this direction, of any length.
    Direction([f64; 2]),
}

impl StressSection {
    /// What a run on `counterbody` is asked for.
    pub(super) fn request(&self, counterbody: &Counterbody) -> StressRequest {
        let lattice = counterbody.indenters().map(Indenters::lattice);
        let cut = |cut: Cut| Some(run::Cut { line: cut.line(lattice)?, depth: cut.depth });
        StressRequest {
            mean: self.mean,
            planes: self.planes.clone(),
            cut: self.section.and_then(cut),
            points: self.points.clone(),
            volume: self.volume,
        }
    }

    /// Read the section of a case with this many levels (none: a surface from a file), which may slide in a direction.
    pub(super) fn read(section: &TableAt<'_>, levels: usize, sliding: Option<[f64; 2]>) -> Result<Self, Refusal> {
        section.only()?;
        let planes = section.value("planes")?.list()?.iter().map(ValueAt::number).collect::<Result<_, _>>()?;
        let mean = match section.value("mean")?.word()? {
            "half-space" => MeanStress::HalfSpace,
            _ => MeanStress::Confined,
        };
        let cut = section.optional("section").map(|value| Cut::read(&value, levels, sliding)).transpose()?;
        let points = section.value("points")?.list()?.iter().map(ValueAt::numbers).collect::<Result<_, _>>()?;
        let volume = section.optional("volume").map(|value| volume(&value)).transpose()?;
        Ok(Self { planes, mean, section: cut, points, volume })
    }
}

fn volume(value: &ValueAt<'_>) -> Result<Volume, Refusal> {
    let section = value.table()?;
    section.only()?;
    let count = |key| section.value(key)?.integer();
    Ok(Volume { depth: section.value("depth")?.number()?, rows: count("rows")?, points: count("points")? })
}

impl Cut {
    /// Its line; `None` for levels without indenters.
    fn line(&self, lattice: Option<&Lattice>) -> Option<SurfaceLine> {
        let first = |level: usize| Some(lattice?.sites()[level - 1][0]);
        let origin = match self.from {
            Origin::Level(level) => lattice?.cell().point(first(level)?),
            Origin::Place(place) => place,
        };
        let direction = match self.toward {
            Toward::Level(level) => lattice?.toward(lattice?.cell().fractions(origin), level),
            Toward::Direction(direction) => direction,
        };
        let [_, points] = SECTION;
        Some(SurfaceLine { origin, direction, span: [-self.behind, self.length - self.behind], points })
    }

    fn read(value: &ValueAt<'_>, levels: usize, sliding: Option<[f64; 2]>) -> Result<Self, Refusal> {
        let section = match levels {
            0 => value.table_or("{ from = [0.0, 0.0], toward = [1.0, 0.0], length = 1.0, depth = 1.0 }")?,
            _ => value.table()?,
        };
        section.only()?;
        let from = Origin::read(&section.value("from")?, levels)?;
        let length = section.value("length")?.number()?;
        // Along the sliding both edges count.
        let (toward, behind) = match (section.optional("toward"), sliding) {
            (None, Some(direction)) => (Toward::Direction(direction), 0.5 * length),
            (None, None) => return Err(section.missing("toward")),
            (Some(toward), _) => (Toward::read(&toward, levels)?, 0.0),
        };
        let behind = section.optional("behind").map_or(Ok(behind), |value| value.number())?;
        Ok(Self { from, toward, length, behind, depth: section.value("depth")?.number()? })
    }
}

impl Origin {
    fn read(value: &ValueAt<'_>, levels: usize) -> Result<Self, Refusal> {
        if !matches!(value.node.value, Value::List(_)) {
            return level(value, levels).map(Self::Level);
        }
        value.numbers().map(Self::Place)
    }
}

impl Toward {
    fn read(value: &ValueAt<'_>, levels: usize) -> Result<Self, Refusal> {
        if !matches!(value.node.value, Value::List(_)) {
            return level(value, levels).map(Self::Level);
        }
        magnitude::direction(value).map(Self::Direction)
    }
}

/// The number N of "level N".
fn level(value: &ValueAt<'_>, levels: usize) -> Result<usize, Refusal> {
    let wanted = match levels {
        0 => "two numbers in brackets: beside [surface] there are no levels".to_owned(),
        1 => "\"level 1\", the only one".to_owned(),
        _ => format!("\"level 1\" to \"level {levels}\""),
    };
    let text = value.text().map_err(|_| value.refuse(&wanted))?;
    let number = text.strip_prefix("level ").and_then(|number| number.trim().parse().ok());
    number.filter(|number| (1..=levels).contains(number)).ok_or_else(|| value.refuse(wanted))
}

fn write_level<S: Serializer>(level: &usize, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(&format_args!("level {level}"))
}
