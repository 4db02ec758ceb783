//! `graded`: a layer whose moduli change with depth, laid out as sublayers that each are homogeneous and bonded.
//!
//! Of n sublayers of one thickness the k-th has the moduli of its middle, at the part t = (k − ½)/n of the layer's depth:
//! E = E₀ + (E₁ − E₀) t, or E₀ (E₁/E₀)ᵗ; ν = ν₀ + (ν₁ − ν₀) t. What the layer does at a wavenumber q is a matter of its
//! moduli's means over depth, of which the rule of the middles errs at second order in 1/n while qh < n.

use serde::Serialize;

use super::error::Refusal;
use super::magnitude;
use super::reader::{TableAt, ValueAt};
use crate::body::{Material, MaterialError};

/// Most layers a case can have, sublayers counted.
pub(super) const MOST: usize = 200;
/// Sublayers of a layer that says nothing of them.
const SUBLAYERS: usize = 20;

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
        const WANTED: &str = "{ young = [upper, lower], poisson = [upper, lower], sublayers = … }";
        let section = value.table(WANTED)?;
        section.only()?;
        let what = "`shear_ratio` (χ = G/G_substrate) or `young` (a pressure), at the upper and the lower face";
        let modulus = match section.one_of(["shear_ratio", "young"], what)? {
            (0, ratio) => Ends::ShearRatio(faces(&ratio, magnitude::size)?),
            (_, young) => Ends::Young(faces(&young, magnitude::size)?),
        };
        let poisson = faces(&section.required("poisson")?, |value| value.number(0.0..=0.5))?;
        let laws = [("linear", Law::Linear), ("exponential", Law::Exponential)];
        let law = section.optional("law").map_or(Ok(Law::Linear), |value| value.choice(&laws))?;
        let sublayers = section.optional("sublayers").map_or(Ok(SUBLAYERS), |value| value.integer(1..=MOST))?;
        Ok(Self { modulus, poisson, law, sublayers })
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

/// Values at the upper and the lower face.
fn faces(value: &ValueAt<'_>, read: impl Fn(&ValueAt<'_>) -> Result<f64, Refusal>) -> Result<[f64; 2], Refusal> {
    const WANTED: &str = "two numbers, at the upper and the lower face";
    match &value.list(WANTED, "[upper, lower]")?[..] {
        [upper, lower] => Ok([read(upper)?, read(lower)?]),
        _ => Err(value.refuse(WANTED).help("[upper, lower]")),
    }
}

/// Refuses more sublayers than can be had, at the layer with which they are too many.
pub(super) fn count(numbers: &[usize], sections: &[TableAt<'_>]) -> Result<(), Refusal> {
    let mut count = 0;
    for (number, section) in numbers.iter().zip(sections) {
        count += number;
        if count > MOST {
            let place = section.optional("graded").map_or(section.place, |value| value.node.place);
            let message = format!("`layers` must be at most {MOST} layers and sublayers, not {count} up to here");
            return Err(Refusal::new(place, message, "too many").help("give fewer `sublayers`"));
        }
    }
    Ok(())
}
