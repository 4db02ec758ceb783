//! `[[layers]]` and `[substrate]`: the coated half-space.

use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

use super::error::Refusal;
use super::grading::{self, Grading};
use super::node::Value;
use super::reader::TableAt;
use super::value::ValueAt;
use crate::body::{HalfSpace, Interface, InterfaceStrength, Layer, Material, MaterialError, Strength};

/// One section of `[[layers]]`, from the surface down.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LayerSection {
    /// Thickness h, a length.
    pub thickness: f64,
    /// Its moduli, the same everywhere or graded.
    #[serde(flatten)]
    pub elasticity: Elasticity,
    /// How the lower face holds to what lies below.
    #[serde(serialize_with = "write_interface")]
    pub interface: Interface,
    /// Equi-biaxial residual stress, a pressure, positive in tension.
    #[serde(skip_serializing_if = "is_zero")]
    pub residual_stress: f64,
    /// Strengths of the material.
    #[serde(flatten)]
    pub strength: StrengthKeys,
    /// Strengths of the lower face.
    #[serde(skip_serializing_if = "InterfaceStrengthKeys::is_empty")]
    pub interface_strength: InterfaceStrengthKeys,
}

/// The moduli of a layer.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Elasticity {
    /// The same everywhere.
    Uniform {
        /// Shear ratio or Young's modulus.
        #[serde(flatten)]
        modulus: Modulus,
        /// Poisson's ratio.
        poisson: f64,
    },
    /// They change with depth.
    Graded {
        /// How.
        graded: Grading,
    },
}

/// Strengths of a material.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct StrengthKeys {
    /// Yield strength, a pressure.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub yield_strength: Option<f64>,
    /// Tensile strength, a pressure.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tensile_strength: Option<f64>,
}

/// Strengths of an interface.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct InterfaceStrengthKeys {
    /// Under tension alone, a pressure.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub normal: Option<f64>,
    /// Under shear alone, a pressure.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shear: Option<f64>,
}

/// How the stiffness of a layer is given.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Modulus {
    /// χ = G/G_substrate.
    ShearRatio(f64),
    /// Young's modulus, a pressure.
    Young(f64),
}

/// The section `[substrate]`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SubstrateSection {
    /// Young's modulus, a pressure.
    pub young: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Strengths of the material.
    #[serde(flatten)]
    pub strength: StrengthKeys,
}

impl StrengthKeys {
    fn read(section: &TableAt<'_>) -> Result<Self, Refusal> {
        Ok(Self {
            yield_strength: strength(section, "yield_strength")?,
            tensile_strength: strength(section, "tensile_strength")?,
        })
    }

    fn strength(&self) -> Strength {
        Strength { yielding: self.yield_strength, tensile: self.tensile_strength }
    }
}

impl InterfaceStrengthKeys {
    fn read(value: &ValueAt<'_>) -> Result<Self, Refusal> {
        let section = value.table()?;
        section.only()?;
        let own = Self { normal: strength(&section, "normal")?, shear: strength(&section, "shear")? };
        if own.is_empty() {
            return Err(value.refuse_form().help("at least one of the two; the one left out is never reached"));
        }
        Ok(own)
    }

    fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    fn strength(&self) -> InterfaceStrength {
        InterfaceStrength { normal: self.normal, shear: self.shear }
    }
}

fn strength(section: &TableAt<'_>, key: &str) -> Result<Option<f64>, Refusal> {
    section.optional(key).map(|value| value.number()).transpose()
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde passes references")]
pub(super) fn is_zero(x: &f64) -> bool {
    *x == 0.0
}

impl Elasticity {
    fn read(section: &TableAt<'_>) -> Result<Self, Refusal> {
        if let Some(graded) = section.optional("graded") {
            let other =
                ["shear_ratio", "young", "poisson"].into_iter().find_map(|key| Some((key, section.optional(key)?)));
            return match other {
                Some((key, value)) => Err(section.both(["graded", key], value.node.place)),
                None => Ok(Self::Graded { graded: Grading::read(&graded)? }),
            };
        }
        let modulus = match section.one_of(["shear_ratio", "young"])? {
            (0, ratio) => Modulus::ShearRatio(ratio.number()?),
            (_, young) => Modulus::Young(young.number()?),
        };
        Ok(Self::Uniform { modulus, poisson: section.value("poisson")?.number()? })
    }

    /// The key of its stiffness.
    fn key(self) -> &'static str {
        match self {
            Self::Uniform { modulus: Modulus::ShearRatio(_), .. } => "shear_ratio",
            Self::Uniform { modulus: Modulus::Young(_), .. } => "young",
            Self::Graded { .. } => "graded",
        }
    }
}

impl LayerSection {
    pub(super) fn read(section: &TableAt<'_>) -> Result<Self, Refusal> {
        section.only()?;
        let thickness = section.value("thickness")?.number()?;
        let elasticity = Elasticity::read(section)?;
        let interface = interface(&section.value("interface")?)?;
        let residual_stress = section.value("residual_stress")?.number()?;
        let interface_strength =
            section.optional("interface_strength").map(|value| InterfaceStrengthKeys::read(&value));
        Ok(Self {
            thickness,
            elasticity,
            interface,
            residual_stress,
            strength: StrengthKeys::read(section)?,
            interface_strength: interface_strength.transpose()?.unwrap_or_default(),
        })
    }

    /// How it is graded, if it is.
    pub fn grading(&self) -> Option<Grading> {
        if let Elasticity::Graded { graded } = self.elasticity { Some(graded) } else { None }
    }

    /// Number of homogeneous layers that it is laid out as.
    pub fn sublayers(&self) -> usize {
        self.grading().map_or(1, |graded| graded.sublayers)
    }

    /// It, or its sublayers from the upper one down, bonded to each other; its lower face is that of the last.
    fn build(&self, substrate: Material) -> Result<Vec<Layer>, MaterialError> {
        let materials: Vec<Material> = match self.elasticity {
            Elasticity::Uniform { modulus: Modulus::ShearRatio(ratio), poisson } => {
                vec![Material::from_shear(ratio * substrate.shear(), poisson)?]
            }
            Elasticity::Uniform { modulus: Modulus::Young(young), poisson } => {
                vec![Material::from_young(young, poisson)?]
            }
            Elasticity::Graded { graded } => graded.materials(substrate).collect::<Result<_, _>>()?,
        };
        let count = materials.len();
        let layer = |(index, material): (usize, Material)| {
            let (interface, strength) = if index + 1 == count {
                (self.interface, self.interface_strength.strength())
            } else {
                (Interface::Bonded, InterfaceStrength::default())
            };
            Layer::new(material, self.thickness / count as f64, interface)?
                .with_residual_stress(self.residual_stress)?
                .with_strengths(self.strength.strength(), strength)
        };
        materials.into_iter().enumerate().map(layer).collect()
    }
}

impl SubstrateSection {
    pub(super) fn read(section: &TableAt<'_>) -> Result<Self, Refusal> {
        section.only()?;
        let young = section.value("young")?.number()?;
        Ok(Self { young, poisson: section.value("poisson")?.number()?, strength: StrengthKeys::read(section)? })
    }
}

/// The half-space of the case, or what is wrong with it at the line where it stands.
pub(super) fn build(
    layers: &[LayerSection],
    layer_sections: &[TableAt<'_>],
    substrate: &SubstrateSection,
    substrate_section: &TableAt<'_>,
) -> Result<HalfSpace, Refusal> {
    let refuse = |section: &TableAt<'_>, key: &str, error: MaterialError| {
        let place = section.optional(key).map_or(section.place, |value| value.node.place);
        Refusal::new(place, format!("`{}`: {error}", section.path(key)), "this material")
    };
    let base = Material::from_young(substrate.young, substrate.poisson)
        .map_err(|error| refuse(substrate_section, "young", error))?;
    grading::count(&layers.iter().map(LayerSection::sublayers).collect::<Vec<_>>(), layer_sections)?;
    let built: Result<Vec<Vec<Layer>>, Refusal> = layers
        .iter()
        .zip(layer_sections)
        .map(|(layer, section)| layer.build(base).map_err(|error| refuse(section, layer.elasticity.key(), error)))
        .collect();
    HalfSpace::new(built?.concat(), base)
        .with_substrate_strength(substrate.strength.strength())
        .map_err(|error| refuse(substrate_section, "yield_strength", error))
}

/// The half-space with twice the sublayers in graded layers.
pub(super) fn refined(layers: &[LayerSection], substrate: &SubstrateSection) -> Option<HalfSpace> {
    let base = Material::from_young(substrate.young, substrate.poisson).ok()?;
    let finer = |layer: &LayerSection| match layer.elasticity {
        Elasticity::Graded { graded } => {
            let graded = graded.of(2 * graded.sublayers);
            LayerSection { elasticity: Elasticity::Graded { graded }, ..*layer }.build(base).ok()
        }
        Elasticity::Uniform { .. } => layer.build(base).ok(),
    };
    Some(HalfSpace::new(layers.iter().map(finer).collect::<Option<Vec<_>>>()?.concat(), base))
}

fn interface(value: &ValueAt<'_>) -> Result<Interface, Refusal> {
    match &value.node.value {
        Value::Text(_) => match value.word().map_err(|refusal| refusal.or_help(value.example()))? {
            "frictionless" => Ok(Interface::Frictionless),
            _ => Ok(Interface::Bonded),
        },
        Value::Table(table) if !table.entries.is_empty() => {
            let section = value.table()?;
            section.only()?;
            let stiffness =
                |key, without| section.optional(key).map_or(Ok(f64::INFINITY), |value| rigidity(&value, without));
            Ok(Interface::Spring {
                tangential: stiffness("tangential_stiffness", NO_SHEAR)?,
                normal: stiffness("normal_stiffness", NO_PRESSURE)?,
            })
        }
        _ => Err(value.refuse_form().help("a spring needs one stiffness at least; the one left out is rigid")),
    }
}

const NO_SHEAR: &str = "for no tangential stiffness write interface = \"frictionless\"";
const NO_PRESSURE: &str =
    "without normal stiffness an interface carries no pressure; leave the key out where the faces do not approach";

/// A stiffness; `without` says what to do instead of 0.
fn rigidity(value: &ValueAt<'_>, without: &str) -> Result<f64, Refusal> {
    value.number().map_err(|refusal| match value.node.value {
        Value::Integer(0) | Value::Float(0.0) => refusal.help(without),
        Value::Float(stiffness) if stiffness.is_infinite() => {
            refusal.help("leave the key out: an absent stiffness is rigid")
        }
        _ => refusal,
    })
}

fn write_interface<S: Serializer>(interface: &Interface, serializer: S) -> Result<S::Ok, S::Error> {
    match *interface {
        Interface::Bonded => serializer.serialize_str("bonded"),
        Interface::Frictionless => serializer.serialize_str("frictionless"),
        Interface::Spring { tangential, normal } => {
            let mut map = serializer.serialize_map(None)?;
            for (key, value) in [("tangential_stiffness", tangential), ("normal_stiffness", normal)] {
                // An absent stiffness is rigid.
                if value.is_finite() {
                    map.serialize_entry(key, &value)?;
                }
            }
            map.end()
        }
    }
}
