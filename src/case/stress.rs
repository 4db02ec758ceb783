//! `[stress]`: where the stresses are wanted.

use serde::{Serialize, Serializer};

use super::error::Refusal;
use super::limits;
use super::node::Value;
use super::reader::{Field, Section};
use crate::stress::MeanStress;

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

/// The field under the whole cell.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Volume {
    /// Down to this depth, a length.
    pub depth: f64,
    /// Intervals in depth.
    pub rows: usize,
    /// Points along each cell vector.
    pub points: usize,
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
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Toward {
    /// Toward the nearest other indenter of this level, from 1.
    Level(usize),
    /// Along this direction, of any length.
    Direction([f64; 2]),
}

impl Serialize for Toward {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Level(level) => write_level(level, serializer),
            Self::Direction(direction) => direction.serialize(serializer),
        }
    }
}

impl StressSection {
    /// Read the section of a case with this many levels (none: a surface from a file).
    pub(super) fn read(section: &Section<'_>, levels: usize) -> Result<Self, Refusal> {
        section.only(&["planes", "mean", "section", "points", "volume"], &[])?;
        let planes = match section.optional("planes") {
            Some(field) => {
                let depths = field.list("a list of depths", "for example planes = [0.0, 0.5]")?;
                at_most(&field, depths.len(), PLANES)?;
                depths.iter().map(limits::size_or_zero).collect::<Result<_, _>>()?
            }
            None => Vec::new(),
        };
        let mean = match section.optional("mean") {
            Some(field) => {
                field.choice(&[("confined", MeanStress::Confined), ("half-space", MeanStress::HalfSpace)])?
            }
            None => MeanStress::Confined,
        };
        let cut = section.optional("section").map(|field| Cut::read(&field, levels)).transpose()?;
        let points = match section.optional("points") {
            Some(field) => {
                let points = field.list("a list of points", "for example points = [[0.0, 0.0, 0.1]]")?;
                at_most(&field, points.len(), POINTS)?;
                points.iter().map(point).collect::<Result<_, _>>()?
            }
            None => Vec::new(),
        };
        let volume = section.optional("volume").map(|field| Volume::read(&field)).transpose()?;
        Ok(Self { planes, mean, section: cut, points, volume })
    }
}

/// Most planes and points that a case can ask for.
const PLANES: usize = 1000;
const POINTS: usize = 100_000;

fn at_most(field: &Field<'_>, count: usize, most: usize) -> Result<(), Refusal> {
    if count <= most { Ok(()) } else { Err(field.refuse(format!("a list of at most {most} items"))) }
}

/// A point [x, y, z] at or below the surface.
fn point(field: &Field<'_>) -> Result<[f64; 3], Refusal> {
    const WANTED: &str = "three numbers [x, y, z], z not less than 0";
    let items = field.list(WANTED, WANTED)?;
    let [x, y, z] = &items[..] else { return Err(field.refuse(WANTED)) };
    Ok([limits::place(x)?, limits::place(y)?, limits::size_or_zero(z)?])
}

impl Volume {
    fn read(field: &Field<'_>) -> Result<Self, Refusal> {
        let section = field.table("{ depth = 1.0, rows = 40, points = 96 }")?;
        section.only(&["depth", "rows", "points"], &[])?;
        let count = |key: &str, default: usize| match section.optional(key) {
            Some(field) => field.integer(1..=2048),
            None => Ok(default),
        };
        Ok(Self {
            depth: limits::size(&section.required("depth", "how deep it goes")?)?,
            rows: count("rows", 40)?,
            points: count("points", 96)?,
        })
    }
}

impl Cut {
    fn read(field: &Field<'_>, levels: usize) -> Result<Self, Refusal> {
        if levels == 0 {
            let message = format!("`{}` has no place beside [surface]: a cut runs between levels", field.path());
            return Err(Refusal::new(field.place(), message, "no levels in this case").help("remove it"));
        }
        let section = field.table("{ from = \"level 1\", toward = \"level 2\", length = 1.0, depth = 1.0 }")?;
        section.only(&["from", "toward", "length", "depth"], &[])?;
        Ok(Self {
            from: level(&section.required("from", "where the cut begins, such as \"level 1\"")?, levels)?,
            toward: Toward::read(&section.required("toward", "where it runs to, such as \"level 2\"")?, levels)?,
            length: limits::size(&section.required("length", "its length along the surface")?)?,
            depth: limits::size(&section.required("depth", "how deep it goes")?)?,
        })
    }
}

impl Toward {
    fn read(field: &Field<'_>, levels: usize) -> Result<Self, Refusal> {
        const WANTED: &str = "a level such as \"level 2\", or a direction [x, y]";
        if !matches!(field.value(), Value::List(_)) {
            return level(field, levels).map(Self::Level);
        }
        let items = field.list(WANTED, WANTED)?;
        let [x, y] = &items[..] else { return Err(field.refuse(WANTED)) };
        let direction = [limits::place(x)?, limits::place(y)?];
        if direction.iter().all(|x| x.abs() < *limits::CARRIED.start()) {
            return Err(field.refuse("a direction [x, y] other than [0, 0]"));
        }
        Ok(Self::Direction(direction))
    }
}

/// The number N of "level N".
fn level(field: &Field<'_>, levels: usize) -> Result<usize, Refusal> {
    let wanted = match levels {
        1 => "\"level 1\", the only one".to_owned(),
        _ => format!("\"level 1\" to \"level {levels}\""),
    };
    let number = field.text(&wanted)?.strip_prefix("level ").and_then(|number| number.trim().parse().ok());
    number.filter(|number| (1..=levels).contains(number)).ok_or_else(|| field.refuse(wanted))
}

fn write_level<S: Serializer>(level: &usize, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(&format_args!("level {level}"))
}
