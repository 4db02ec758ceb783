//! `graded`: a layer whose moduli change with depth, laid out as sublayers that each are homogeneous and bonded.
//!
//! Of n sublayers of one thickness the k-th has the moduli of its middle, at the part t = (k − ½)/n of the layer's depth:
//! E = E₀ + (E₁ − E₀) t, or E₀ (E₁/E₀)ᵗ; ν = ν₀ + (ν₁ − ν₀) t. What the layer does at a wavenumber q is a matter of its
//! moduli's means over depth, of which the rule of the middles errs at second order in 1/n while qh < n.

use serde::Serialize;

use super::error::Refusal;
use super::keys::LAYERS;
use super::reader::TableAt;
use super::value::ValueAt;
use crate::body::{Material, MaterialError};

/// How a layer is graded.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Grading {
    /// Stiffness at the upper and the lower face.
    #[serde(flatten)]
    pub modulus: Ends,
    /// Poisson's ratio at the upper and the lower face.
    pub poisson: [f64; 2],
    /// How the stiffness goes from one to the other.
    pub law: Law,
    /// Number of sublayers.
    pub sublayers: usize,
}

/// Stiffness at the upper and the lower face.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Ends {
    /// χ = G/G_substrate.
    ShearRatio([f64; 2]),
    /// Young's modulus, a pressure.
    Young([f64; 2]),
}

/// How a stiffness changes with depth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Law {
    /// By equal amounts.
    Linear,
    /// By equal factors.
    Exponential,
}

impl Grading {
    pub(super) fn read(value: &ValueAt<'_>) -> Result<Self, Refusal> {
        let section = value.table()?;
        section.only()?;
        let modulus = match section.one_of(["shear_ratio", "young"])? {
            (0, ratio) => Ends::ShearRatio(ratio.numbers()?),
            (_, young) => Ends::Young(young.numbers()?),
        };
        let poisson = section.value("poisson")?.numbers()?;
        let law = match section.value("law")?.word()? {
            "exponential" => Law::Exponential,
            _ => Law::Linear,
        };
        Ok(Self { modulus, poisson, law, sublayers: section.value("sublayers")?.integer()? })
    }

    /// The same one, of so many sublayers.
    pub(super) fn of(self, sublayers: usize) -> Self {
        Self { sublayers, ..self }
    }

    /// The materials of the sublayers, from the upper one down.
    pub(super) fn materials(self, substrate: Material) -> impl Iterator<Item = Result<Material, MaterialError>> {
        (0..self.sublayers).map(move |k| {
            let t = (k as f64 + 0.5) / self.sublayers as f64;
            let linear = |[upper, lower]: [f64; 2]| upper + (lower - upper) * t;
            let stiffness = |[upper, lower]: [f64; 2]| match self.law {
                Law::Linear => linear([upper, lower]),
                Law::Exponential => upper * (lower / upper).powf(t),
            };
            match self.modulus {
                Ends::ShearRatio(ends) => {
                    Material::from_shear(stiffness(ends) * substrate.shear(), linear(self.poisson))
                }
                Ends::Young(ends) => Material::from_young(stiffness(ends), linear(self.poisson)),
            }
        })
    }
}

/// Refuses more sublayers than can be had, at the layer with which they are too many.
pub(super) fn count(numbers: &[usize], sections: &[TableAt<'_>]) -> Result<(), Refusal> {
    let mut count = 0;
    for (number, section) in numbers.iter().zip(sections) {
        count += number;
        if count > LAYERS {
            let place = section.optional("graded").map_or(section.place, |value| value.node.place);
            let message = format!("`layers` must be at most {LAYERS} layers and sublayers, not {count} up to here");
            return Err(Refusal::new(place, message, "too many").help("give fewer `sublayers`"));
        }
    }
    Ok(())
}
