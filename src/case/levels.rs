//! `[[levels]]`: indenters of equal shape and height.

use serde::Serialize;

use super::error::Refusal;
use super::reader::TableAt;
use super::value::ValueAt;
use crate::counterbody::{Level, Shape};

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
        let shape = section.value("shape")?.word()?;
        section.only()?;
        let size = |key| section.value(key)?.number();
        let shape = match shape {
            "paraboloid" => Shape::Paraboloid { radius: size("radius")? },
            "sphere" => Shape::Sphere { radius: size("radius")? },
            "cone" => Shape::Cone { slope: size("slope")? },
            _ => Shape::Power { coefficient: size("coefficient")?, exponent: size("exponent")? },
        };
        let sites = |sites: &ValueAt<'_>| sites.list()?.iter().map(ValueAt::numbers).collect();
        let height = section.value("height")?.number()?;
        Ok(Self { shape, height, sites: section.optional("sites").as_ref().map(sites).transpose()? })
    }

    /// The level as the core knows it.
    pub(super) fn build(&self, section: &TableAt<'_>) -> Result<Level, Refusal> {
        Level::new(self.shape, self.height)
            .map_err(|error| Refusal::new(section.place, format!("`{}`: {error}", section.path("shape")), "this level"))
    }
}
