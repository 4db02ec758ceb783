//! `[[levels]]`: indenters of equal shape and height.

use super::error::Refusal;
use super::keys::{Form, Key, Range, Unit};
use super::reader::TableAt;
use super::section::{Words, demanded, section, words};
use percoat_core::counterbody::{Level, Shape};

const SIZE: Form = Form::Number(Range::Size);
const COORDINATE: Form = Form::Number(Range::Coordinate);

words! {
    /// Kinds of shapes.
    pub enum ShapeKind {
        /// r²/2R.
        Paraboloid = "paraboloid",
        /// A sphere's lower half.
        Sphere = "sphere",
        /// A cone.
        Cone = "cone",
        /// c rⁿ.
        Power = "power",
    }
}

section! {
    /// One section of `[[levels]]`.
    pub struct LevelSection = LEVELS, misplaced [
        ("radius", "`radius` is a size of a paraboloid or a sphere"),
        ("slope", "`slope` is the size of a cone"),
        ("coefficient", "`coefficient` is a size of a power profile c rⁿ"),
        ("exponent", "`exponent` is a size of a power profile c rⁿ"),
    ] {
        /// the shape of the indenters; a power law is c rⁿ
        pub shape: ShapeKind = Key::new(&[Form::Word(ShapeKind::WORDS)], "\"paraboloid\""),
        /// the radius at the apex
        pub radius: Option<f64> = Key::new(&[SIZE], "0.8").unit(Unit::Length).of(&["paraboloid", "sphere"]),
        /// the slope of the flank
        pub slope: Option<f64> = Key::new(&[SIZE], "0.1").of(&["cone"]),
        /// c of the profile c rⁿ
        pub coefficient: Option<f64> = Key::new(&[SIZE], "1.5").unit(Unit::LengthToOneMinusN).of(&["power"]),
        /// n of the profile c rⁿ
        pub exponent: Option<f64> = Key::new(&[SIZE], "3.0").of(&["power"]),
        /// protrusion of the apices, of which only differences matter
        pub height: f64 = Key::new(&[COORDINATE], "0.02").unit(Unit::Length).default("0"),
        /// places of its indenters, in fractions of a₁ and a₂; in the window of an isolated contact from its middle
        pub sites: Option<Vec<[f64; 2]>> = Key::new(
            &[Form::List { of: &Form::Tuple("a site [s1, s2]", &[COORDINATE; 2]), count: [1, 10_000] }],
            "[[0.0, 0.0], [0.5, 0.5]]",
        )
        .otherwise("the lattice's standard ones")
        .rule("all levels have them, or none"),
    }
}

impl LevelSection {
    fn shape(&self) -> Shape {
        match self.shape {
            ShapeKind::Paraboloid => Shape::Paraboloid { radius: demanded(self.radius) },
            ShapeKind::Sphere => Shape::Sphere { radius: demanded(self.radius) },
            ShapeKind::Cone => Shape::Cone { slope: demanded(self.slope) },
            ShapeKind::Power => {
                Shape::Power { coefficient: demanded(self.coefficient), exponent: demanded(self.exponent) }
            }
        }
    }

    pub(super) fn build(&self, section: &TableAt<'_>) -> Result<Level, Refusal> {
        Level::new(self.shape(), self.height)
            .map_err(|error| Refusal::new(section.span, format!("`{}`: {error}", section.path("shape")), "this level"))
    }
}
