//! `[[levels]]`: indenters of equal shape and height.

use serde::Serialize;

use super::error::Refusal;
use super::magnitude;
use super::reader::TableAt;
use crate::counterbody::{Level, Shape};

/// Most levels a case can have.
pub(super) const MOST: usize = 200;

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

impl LevelSection {
    pub(super) fn read(section: &TableAt<'_>) -> Result<Self, Refusal> {
        let kind = section.required("shape")?;
        let kind = kind.choice(&[("paraboloid", 0), ("sphere", 1), ("cone", 2), ("power", 3)])?;
        section.only()?;
        let size = |key| magnitude::size(&section.required(key)?);
        let shape = match kind {
            0 => Shape::Paraboloid { radius: size("radius")? },
            1 => Shape::Sphere { radius: size("radius")? },
            2 => Shape::Cone { slope: size("slope")? },
            _ => Shape::Power { coefficient: size("coefficient")?, exponent: size("exponent")? },
        };
        let height = section.optional("height").map_or(Ok(0.0), |height| magnitude::place(&height))?;
        Ok(Self { shape, height, sites: sites(section)? })
    }

    /// The level as the core knows it.
    pub(super) fn build(&self, section: &TableAt<'_>) -> Result<Level, Refusal> {
        Level::new(self.shape, self.height)
            .map_err(|error| Refusal::new(section.place, format!("`{}`: {error}", section.path("shape")), "this level"))
    }
}

fn sites(section: &TableAt<'_>) -> Result<Option<Vec<[f64; 2]>>, Refusal> {
    const WANTED: &str = "a list of sites [s1, s2]";
    const HELP: &str = "one pair an indenter, in fractions of the cell's vectors: sites = [[0.0, 0.0], [0.5, 0.5]]";
    let Some(sites) = section.optional("sites") else { return Ok(None) };
    let items = sites.list(WANTED, HELP)?;
    if items.is_empty() {
        return Err(sites.refuse(WANTED).help(HELP));
    }
    items.iter().map(|site| magnitude::pair(site, "a site [s1, s2]")).collect::<Result<_, _>>().map(Some)
}
