//! `[stress]`: where the stresses are wanted.

use serde::{Serialize, Serializer};

use super::error::Refusal;
use super::reader::{Field, POSITIVE, Section};

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
}

/// The mean lateral stress, which the periodic problem alone leaves open.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum MeanStress {
    /// No mean lateral strain.
    Confined,
    /// That at the centre of a wide loaded disc on the half-space.
    HalfSpace,
}

/// A vertical cut from the axis of an indenter toward a neighbour.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Cut {
    /// Level, from 1, of the indenter at whose axis the cut begins.
    #[serde(serialize_with = "write_level")]
    pub from: usize,
    /// Level, from 1, of the nearest indenter toward which it runs.
    #[serde(serialize_with = "write_level")]
    pub toward: usize,
    /// Length along the surface.
    pub length: f64,
    /// Depth, a length.
    pub depth: f64,
}

impl StressSection {
    /// Read the section of a case with this many levels (none: a surface from a file).
    pub(super) fn read(section: &Section<'_>, levels: usize) -> Result<Self, Refusal> {
        section.only(&["planes", "mean", "section"], &[])?;
        let planes = match section.optional("planes") {
            Some(field) => {
                let depths = field.list("a list of depths", "for example planes = [0.0, 0.5]")?;
                depths.iter().map(|depth| depth.number(0.0..)).collect::<Result<_, _>>()?
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
        Ok(Self { planes, mean, section: cut })
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
            toward: level(&section.required("toward", "where it runs to, such as \"level 2\"")?, levels)?,
            length: section.required("length", "its length along the surface")?.number(POSITIVE)?,
            depth: section.required("depth", "how deep it goes")?.number(POSITIVE)?,
        })
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
