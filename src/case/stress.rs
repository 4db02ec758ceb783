//! `[stress]`: where the stresses are wanted.

use serde::{Serialize, Serializer};

use super::error::Refusal;
use super::limits;
use super::node::Value;
use super::reader::{TableAt, ValueAt};
use crate::body::MeanStress;
use crate::counterbody::Counterbody;
use crate::lattice::Lattice;
use crate::run::places::SECTION;
use crate::run::{self, StressRequest, Volume};
use crate::stress::Line;

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

/// A vertical cut from the axis of an indenter toward a neighbour.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Cut {
    /// Level, from 1, of the indenter at whose axis the cut begins.
    #[serde(serialize_with = "write_level")]
    pub from: usize,
    /// Where it runs.
    pub toward: Toward,
    /// Length along the surface.
    pub length: f64,
    /// Depth, a length.
    pub depth: f64,
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
        let cut = |cut: Cut| {
            let line = cut.line(counterbody.indenters()?.lattice());
            Some(run::Cut { line, depth: cut.depth })
        };
        StressRequest {
            mean: self.mean,
            planes: self.planes.clone(),
            cut: self.section.and_then(cut),
            points: self.points.clone(),
            volume: self.volume,
        }
    }

    /// Read the section of a case with this many levels (none: a surface from a file).
    pub(super) fn read(section: &TableAt<'_>, levels: usize) -> Result<Self, Refusal> {
        section.only()?;
        let planes = section.optional("planes").map_or(Ok(Vec::new()), |value| {
            value.items("a list of depths", "for example planes = [0.0, 0.5]", PLANES, limits::size_or_zero)
        })?;
        let mean = match section.optional("mean") {
            Some(value) => {
                value.choice(&[("confined", MeanStress::Confined), ("half-space", MeanStress::HalfSpace)])?
            }
            None => MeanStress::Confined,
        };
        let cut = section.optional("section").map(|value| Cut::read(&value, levels)).transpose()?;
        let points = section.optional("points").map_or(Ok(Vec::new()), |value| {
            value.items("a list of points", "for example points = [[0.0, 0.0, 0.1]]", POINTS, point)
        })?;
        let volume = section.optional("volume").map(|value| volume(&value)).transpose()?;
        Ok(Self { planes, mean, section: cut, points, volume })
    }
}

/// Most planes and points that a case can ask for.
const PLANES: usize = 1000;
const POINTS: usize = 100_000;

/// A point [x, y, z] at or below the surface.
fn point(value: &ValueAt<'_>) -> Result<[f64; 3], Refusal> {
    const WANTED: &str = "three numbers [x, y, z], z not less than 0";
    let items = value.list(WANTED, WANTED)?;
    let [x, y, z] = &items[..] else { return Err(value.refuse(WANTED)) };
    Ok([limits::place(x)?, limits::place(y)?, limits::size_or_zero(z)?])
}

fn volume(value: &ValueAt<'_>) -> Result<Volume, Refusal> {
    let section = value.table("{ depth = 1.0, rows = 40, points = 96 }")?;
    section.only()?;
    let count = |key: &str, default: usize| match section.optional(key) {
        Some(value) => value.integer(1..=2048),
        None => Ok(default),
    };
    Ok(Volume {
        depth: limits::size(&section.required("depth")?)?,
        rows: count("rows", 40)?,
        points: count("points", 96)?,
    })
}

impl Cut {
    /// The line from the first indenter of a level toward another, or along a direction.
    fn line(&self, lattice: &Lattice) -> Line {
        let place = lattice.sites()[self.from - 1][0];
        let direction = match self.toward {
            Toward::Level(level) => lattice.toward(place, level),
            Toward::Direction(direction) => direction,
        };
        let [_, points] = SECTION;
        Line { origin: lattice.cell().point(place), direction, span: [0.0, self.length], points }
    }

    fn read(value: &ValueAt<'_>, levels: usize) -> Result<Self, Refusal> {
        if levels == 0 {
            let message = format!("`{}` has no place beside [surface]: a cut runs between levels", value.path);
            return Err(Refusal::new(value.node.place, message, "no levels in this case").help("remove it"));
        }
        let section = value.table("{ from = \"level 1\", toward = \"level 2\", length = 1.0, depth = 1.0 }")?;
        section.only()?;
        Ok(Self {
            from: level(&section.required("from")?, levels)?,
            toward: Toward::read(&section.required("toward")?, levels)?,
            length: limits::size(&section.required("length")?)?,
            depth: limits::size(&section.required("depth")?)?,
        })
    }
}

impl Toward {
    fn read(value: &ValueAt<'_>, levels: usize) -> Result<Self, Refusal> {
        const WANTED: &str = "a level such as \"level 2\", or a direction [x, y]";
        if !matches!(value.node.value, Value::List(_)) {
            return level(value, levels).map(Self::Level);
        }
        let items = value.list(WANTED, WANTED)?;
        let [x, y] = &items[..] else { return Err(value.refuse(WANTED)) };
        let direction = [limits::place(x)?, limits::place(y)?];
        if direction.iter().all(|x| x.abs() < *limits::CARRIED.start()) {
            return Err(value.refuse("a direction [x, y] other than [0, 0]"));
        }
        Ok(Self::Direction(direction))
    }
}

/// The number N of "level N".
fn level(value: &ValueAt<'_>, levels: usize) -> Result<usize, Refusal> {
    let wanted = match levels {
        1 => "\"level 1\", the only one".to_owned(),
        _ => format!("\"level 1\" to \"level {levels}\""),
    };
    let number = value.text(&wanted)?.strip_prefix("level ").and_then(|number| number.trim().parse().ok());
    number.filter(|number| (1..=levels).contains(number)).ok_or_else(|| value.refuse(wanted))
}

fn write_level<S: Serializer>(level: &usize, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(&format_args!("level {level}"))
}
