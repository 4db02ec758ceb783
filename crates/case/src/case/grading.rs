//! `graded`: a layer whose moduli change with depth, divided into homogeneous bonded sublayers.
//!
//! The k-th of n sublayers of one thickness has the moduli of its middle, at the part t = (k − ½)/n of the layer's
//! depth: E = E₀ + (E₁ − E₀) t, or E₀ (E₁/E₀)ᵗ; ν = ν₀ + (ν₁ − ν₀) t. The response at a wavenumber q depends on means
//! of the moduli over depth; the error of the midpoint rule is of second order in 1/n while qh < n.

use super::error::Refusal;
use super::keys::{Form, Key, Range, Unit};
use super::reader::TableAt;
use super::section::{Words, demanded, section, words};
use percoat_core::body::{Material, MaterialError};

const SIZE: Form = Form::Number(Range::Size);
const POISSON: Form = Form::Number(Range::between(0.0, 0.5));
/// Most layers a case can have, sublayers counted.
pub(super) const LAYERS: usize = 200;

const ENDS: &str = "two numbers, at the upper and the lower face, [upper, lower]";

words! {
    /// How a stiffness changes with depth.
    pub enum Law {
        /// E₀ + (E₁ − E₀) t.
        Linear = "linear",
        /// E₀ (E₁/E₀)ᵗ.
        Exponential = "exponential",
    }
}

section! {
    /// The table `graded` of a layer.
    #[derive(Copy)]
    pub struct Grading = GRADING, rules one_stiffness {
        /// χ at the upper and the lower face
        pub shear_ratio: Option<[f64; 2]> = Key::new(&[Form::Tuple(ENDS, &[SIZE; 2])], "[2.0, 1.0]"),
        /// Young's modulus at the upper and the lower face
        pub young: Option<[f64; 2]> = Key::new(&[Form::Tuple(ENDS, &[SIZE; 2])], "[4.0, 1.0]")
            .unit(Unit::Pressure)
            .instead_of("shear_ratio"),
        /// Poisson's ratio at the upper and the lower face, linear between them
        pub poisson: [f64; 2] = Key::new(&[Form::Tuple(ENDS, &[POISSON; 2])], "[0.2, 0.3]"),
        /// interpolation of the stiffness between the faces
        pub law: Law = Key::new(&[Form::Word(Law::WORDS)], "\"exponential\"").default("\"linear\""),
        /// number of sublayers, each a material of its own in the outputs
        pub sublayers: usize = Key::new(&[Form::Integer(1, LAYERS)], "40").default("20"),
    }
}

fn one_stiffness(_: &Grading, section: &TableAt<'_>) -> Result<(), Refusal> {
    section.one_of(["shear_ratio", "young"]).map(drop)
}

impl Grading {
    /// The grading with another number of sublayers.
    pub(super) fn of(self, sublayers: usize) -> Self {
        Self { sublayers, ..self }
    }

    /// The materials of the sublayers, from the upper one down.
    pub(super) fn materials(
        self,
        substrate: Option<Material>,
    ) -> impl Iterator<Item = Result<Material, MaterialError>> {
        (0..self.sublayers).map(move |k| {
            let t = (k as f64 + 0.5) / self.sublayers as f64;
            let linear = |[upper, lower]: [f64; 2]| upper + (lower - upper) * t;
            let stiffness = |[upper, lower]: [f64; 2]| match self.law {
                Law::Linear => linear([upper, lower]),
                Law::Exponential => upper * (lower / upper).powf(t),
            };
            let poisson = linear(self.poisson);
            match self.young {
                Some(young) => Material::from_young(stiffness(young), poisson),
                None => {
                    Material::from_shear(stiffness(demanded(self.shear_ratio)) * demanded(substrate).shear(), poisson)
                }
            }
        })
    }
}
