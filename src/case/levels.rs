//! `[[levels]]`: indenters of equal shape and height.

use serde::Serialize;

use super::error::Refusal;
use super::limits;
use super::reader::Section;
use crate::indenter::{Level, Shape};

/// Most levels a case can have.
const MOST: usize = 200;

/// One section of `[[levels]]`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LevelSection {
    /// Shape of the indenters, with its sizes.
    #[serde(flatten, with = "ShapeKeys")]
    pub shape: Shape,
    /// Protrusion of the apices, a length; only differences matter.
    pub height: f64,
    /// Sites of the level's indenters in fractions of a₁, a₂; none: the lattice's standard ones.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sites: Option<Vec<[f64; 2]>>,
}

/// The keys a [`Shape`] has in a case.
#[derive(Serialize)]
#[serde(remote = "Shape", tag = "shape", rename_all = "lowercase")]
enum ShapeKeys {
    Paraboloid { radius: f64 },
    Sphere { radius: f64 },
    Cone { slope: f64 },
    Power { coefficient: f64, exponent: f64 },
}

/// Every level of the case.
pub(super) fn read(sections: &[Section<'_>]) -> Result<Vec<LevelSection>, Refusal> {
    if let Some(section) = sections.get(MOST) {
        let message = format!("`levels` must be at most {MOST} sections, not {}", sections.len());
        return Err(Refusal::new(section.place(), message, "one too many"));
    }
    sections.iter().map(LevelSection::read).collect()
}

impl LevelSection {
    fn read(section: &Section<'_>) -> Result<Self, Refusal> {
        let shape = shape(section)?;
        let height = section.optional("height").map_or(Ok(0.0), |height| limits::place(&height))?;
        Ok(Self { shape, height, sites: sites(section)? })
    }

    /// The level as the core knows it.
    pub(super) fn build(&self, section: &Section<'_>) -> Result<Level, Refusal> {
        Level::new(self.shape, self.height).map_err(|error| {
            Refusal::new(section.place(), format!("`{}`: {error}", section.path("shape")), "this level")
        })
    }
}

fn shape(section: &Section<'_>) -> Result<Shape, Refusal> {
    const RADIUS: &str = "`radius` is a size of a paraboloid or a sphere";
    const SLOPE: &str = "`slope` is the size of a cone";
    const COEFFICIENT: &str = "`coefficient` is a size of a power profile c rⁿ";
    const EXPONENT: &str = "`exponent` is a size of a power profile c rⁿ";
    let foreign = [("radius", RADIUS), ("slope", SLOPE), ("coefficient", COEFFICIENT), ("exponent", EXPONENT)];
    let size = |key, what| limits::size(&section.required(key, what)?);
    let radius = || {
        section.only(&["shape", "radius", "height", "sites"], &foreign)?;
        size("radius", "the radius at the apex, a length greater than 0")
    };
    let kind = section.required("shape", "\"paraboloid\", \"sphere\", \"cone\" or \"power\"")?;
    match kind.choice(&[("paraboloid", 0), ("sphere", 1), ("cone", 2), ("power", 3)])? {
        0 => Ok(Shape::Paraboloid { radius: radius()? }),
        1 => Ok(Shape::Sphere { radius: radius()? }),
        2 => {
            section.only(&["shape", "slope", "height", "sites"], &foreign)?;
            Ok(Shape::Cone { slope: size("slope", "the slope of the flank, greater than 0")? })
        }
        _ => {
            section.only(&["shape", "coefficient", "exponent", "height", "sites"], &foreign)?;
            Ok(Shape::Power {
                coefficient: size("coefficient", "c of the profile c rⁿ, greater than 0")?,
                exponent: size("exponent", "n of the profile c rⁿ, greater than 0")?,
            })
        }
    }
}

fn sites(section: &Section<'_>) -> Result<Option<Vec<[f64; 2]>>, Refusal> {
    const WANTED: &str = "a list of sites [s1, s2]";
    const HELP: &str = "one pair an indenter, in fractions of the cell's vectors: sites = [[0.0, 0.0], [0.5, 0.5]]";
    let Some(field) = section.optional("sites") else { return Ok(None) };
    let items = field.list(WANTED, HELP)?;
    if items.is_empty() {
        return Err(field.refuse(WANTED).help(HELP));
    }
    items.iter().map(|site| site.pair("a site [s1, s2]")).collect::<Result<_, _>>().map(Some)
}
