//! `[[layers]]` and `[substrate]`: the body.

use super::key::{Form, Key, Keys};
use super::range::Range;
use super::unit::Unit;

/// Most layers a case can have, sublayers counted.
pub(in crate::case) const LAYERS: usize = 200;

const SIZE: Form = Form::Number(Range::Size);
const POISSON: Form = Form::Number(Range::between(0.0, 0.5));
const ENDS: &str = "two numbers, at the upper and the lower face, [upper, lower]";

const YIELD: Key = Key::new("yield_strength", "what the stress of von Mises must not reach", &[SIZE], "8.0")
    .unit(Unit::Pressure)
    .otherwise("never reached");
const TENSILE: Key = Key::new("tensile_strength", "what the largest principal stress must not reach", &[SIZE], "2.0")
    .unit(Unit::Pressure)
    .otherwise("never reached");

pub(super) static LAYER: Keys = Keys::new(&[
    Key::new("thickness", "the thickness of the layer", &[SIZE], "0.5").unit(Unit::Length),
    Key::new("shear_ratio", "shear modulus over that of the substrate, χ", &[SIZE], "2.0"),
    Key::new("young", "Young's modulus", &[SIZE], "300.0").unit(Unit::Pressure).instead_of("shear_ratio"),
    Key::new("poisson", "Poisson's ratio", &[POISSON], "0.25"),
    Key::new(
        "graded",
        "moduli, `poisson` among them, that change with depth, the layer laid out as bonded sublayers",
        &[Form::Table(&GRADED)],
        "{ young = [4.0, 1.0], poisson = [0.2, 0.3] }",
    )
    .instead_of("young")
    .and_of(&["shear_ratio", "poisson"]),
    Key::new(
        "interface",
        "how the lower face holds to what lies below; a table is a spring",
        &[Form::Word(&["bonded", "frictionless"]), Form::Table(&SPRING)],
        "{ tangential_stiffness = 10.0 }",
    )
    .default("\"bonded\""),
    Key::new(
        "residual_stress",
        "equi-biaxial residual stress, positive in tension",
        &[Form::Number(Range::Place)],
        "-2.0",
    )
    .unit(Unit::Pressure)
    .default("0"),
    YIELD,
    TENSILE,
    Key::new(
        "interface_strength",
        "what the lower face bears",
        &[Form::Table(&INTERFACE_STRENGTH)],
        "{ normal = 0.5, shear = 0.8 }",
    )
    .otherwise("never reached")
    .rule("at least one of the two"),
]);

static GRADED: Keys = Keys::new(&[
    Key::new("shear_ratio", "χ at the upper and the lower face", &[Form::Tuple(ENDS, &[SIZE; 2])], "[2.0, 1.0]"),
    Key::new(
        "young",
        "Young's modulus at the upper and the lower face",
        &[Form::Tuple(ENDS, &[SIZE; 2])],
        "[4.0, 1.0]",
    )
    .unit(Unit::Pressure)
    .instead_of("shear_ratio"),
    Key::new(
        "poisson",
        "Poisson's ratio at the upper and the lower face, linear between them",
        &[Form::Tuple(ENDS, &[POISSON; 2])],
        "[0.2, 0.3]",
    ),
    Key::new(
        "law",
        "how the stiffness goes from one to the other",
        &[Form::Word(&["linear", "exponential"])],
        "\"exponential\"",
    )
    .default("\"linear\""),
    Key::new(
        "sublayers",
        "number of sublayers, each a material of its own in the outputs",
        &[Form::Integer(1, LAYERS)],
        "40",
    )
    .default("20"),
]);

static SPRING: Keys = Keys::new(&[
    Key::new("tangential_stiffness", "how it resists sliding", &[SIZE], "10.0")
        .unit(Unit::PressurePerLength)
        .otherwise("rigid")
        .rule("at least one of the two"),
    Key::new("normal_stiffness", "how it resists opening and closing", &[SIZE], "100.0")
        .unit(Unit::PressurePerLength)
        .otherwise("rigid")
        .rule("at least one of the two"),
]);

static INTERFACE_STRENGTH: Keys = Keys::new(&[
    Key::new("normal", "what it bears under tension alone", &[SIZE], "0.5")
        .unit(Unit::Pressure)
        .otherwise("never reached"),
    Key::new("shear", "what it bears under shear alone", &[SIZE], "0.8")
        .unit(Unit::Pressure)
        .otherwise("never reached"),
]);

pub(super) static SUBSTRATE: Keys = Keys {
    all: &[
        Key::new("young", "Young's modulus", &[SIZE], "210.0").unit(Unit::Pressure),
        Key::new("poisson", "Poisson's ratio", &[POISSON], "0.3"),
        YIELD,
        TENSILE,
    ],
    misplaced: &[("shear_ratio", "`shear_ratio` relates a layer to the substrate, whose modulus is `young`")],
};
