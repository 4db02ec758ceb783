//! `[lattice]`, `[[levels]]` and `[surface]`: what is pressed into the body.

use super::key::{Form, Key, Keys};
use super::range::Range;
use super::unit::Unit;

const SIZE: Form = Form::Number(Range::Size);
const PLACE: Form = Form::Number(Range::Place);

pub(super) static LATTICE: Keys = Keys {
    all: &[
        Key::new(
            "kind",
            "which lattice: of triangles, of squares, or any cell",
            &[Form::Word(&["hexagonal", "square", "oblique"])],
            "\"hexagonal\"",
        ),
        Key::new("period", "the distance of neighbouring indenters whatever their level", &[SIZE], "1.0")
            .unit(Unit::Length)
            .of(&["hexagonal", "square"])
            .rule("with `sites` and with a surface: the side of the cell"),
        Key::new("a1", "a cell vector", &[Form::Tuple("a vector [x, y]", &[PLACE; 2])], "[1.0, 0.0]")
            .unit(Unit::Length)
            .of(&["oblique"])
            .rule("not parallel to `a2`"),
        Key::new("a2", "a cell vector", &[Form::Tuple("a vector [x, y]", &[PLACE; 2])], "[0.25, 1.5]")
            .unit(Unit::Length)
            .of(&["oblique"])
            .rule("not parallel to `a1`"),
    ],
    misplaced: &[
        ("a1", "the cell of a hexagonal or square lattice follows from `period`"),
        ("a2", "the cell of a hexagonal or square lattice follows from `period`"),
        ("period", "the cell of an oblique lattice is given by `a1` and `a2`"),
    ],
};

pub(super) static LEVELS: Keys = Keys {
    all: &[
        Key::new(
            "shape",
            "the shape of the indenters; a power law is c rⁿ",
            &[Form::Word(&["paraboloid", "sphere", "cone", "power"])],
            "\"paraboloid\"",
        ),
        Key::new("radius", "the radius at the apex", &[SIZE], "0.8").unit(Unit::Length).of(&["paraboloid", "sphere"]),
        Key::new("slope", "the slope of the flank", &[SIZE], "0.1").of(&["cone"]),
        Key::new("coefficient", "c of the profile c rⁿ", &[SIZE], "1.5").unit(Unit::LengthToOneMinusN).of(&["power"]),
        Key::new("exponent", "n of the profile c rⁿ", &[SIZE], "3.0").of(&["power"]),
        Key::new("height", "protrusion of the apices, of which only differences matter", &[PLACE], "0.02")
            .unit(Unit::Length)
            .default("0"),
        Key::new(
            "sites",
            "where its indenters stand, in fractions of a₁ and a₂",
            &[Form::List { of: &Form::Tuple("a site [s1, s2]", &[PLACE; 2]), count: [1, 10_000] }],
            "[[0.0, 0.0], [0.5, 0.5]]",
        )
        .otherwise("the lattice's standard ones")
        .rule("all levels have them, or none"),
    ],
    misplaced: &[
        ("radius", "`radius` is a size of a paraboloid or a sphere"),
        ("slope", "`slope` is the size of a cone"),
        ("coefficient", "`coefficient` is a size of a power profile c rⁿ"),
        ("exponent", "`exponent` is a size of a power profile c rⁿ"),
    ],
};

/// What has nothing to act on beside `random`.
const OF_A_FILE: &str = "of a file, not of a random surface";

pub(super) static SURFACE: Keys = Keys::new(&[
    Key::new(
        "heights",
        "a file of heights, `.npy`, `.csv`, `.txt`, `.dat` or `.xyz`, relative to the case file",
        &[Form::Text("the path of a file")],
        "\"surface.npy\"",
    ),
    Key::new("scale", "factor of its heights, negative to turn them over", &[Form::Number(Range::Factor)], "1e-3")
        .default("1")
        .rule(OF_A_FILE),
    Key::new("unit", "what the heights of the file are in", &[Form::Text("a unit of length")], "\"nm\"")
        .otherwise("the case's own")
        .rule("m, cm, mm, µm, nm, pm, Å, in or mil; needs `units.length`; of a file, not of a random surface"),
    Key::new(
        "period",
        "lengths of the whole surface along a₁ and a₂",
        &[SIZE, Form::Tuple("two of them, [L1, L2]", &[SIZE; 2])],
        "[20.0, 10.0]",
    )
    .unit(Unit::Length)
    .otherwise("that of a file of points, or of `lattice`")
    .rule("in place of [lattice]"),
    Key::new(
        "pixel",
        "the distance of its samples along a₁ and a₂",
        &[SIZE, Form::Tuple("two of them, [d1, d2]", &[SIZE; 2])],
        "0.1",
    )
    .unit(Unit::Length)
    .otherwise("follows from `period`")
    .instead_of("period")
    .rule("in place of [lattice]; of a file, not of a random surface"),
    Key::new("level", "whether its mean plane is taken away", &[Form::Boolean], "true")
        .default("false")
        .rule(OF_A_FILE),
    Key::new(
        "window",
        "tapers its border; true is \"tukey\"",
        &[Form::Boolean, Form::Word(&["hann", "tukey"])],
        "\"tukey\"",
    )
    .default("false")
    .rule(OF_A_FILE),
    Key::new(
        "random",
        "a self-affine surface",
        &[Form::Table(&RANDOM)],
        "{ hurst = 0.8, shortest = 0.25, rms_slope = 0.1 }",
    )
    .instead_of("heights"),
]);

static RANDOM: Keys = Keys::new(&[
    Key::new("hurst", "the Hurst exponent", &[Form::Number(Range::between(0.0, 1.0))], "0.8"),
    Key::new("shortest", "the shortest wavelength", &[SIZE], "0.25")
        .unit(Unit::Length)
        .rule("`shortest` ≤ `rolloff` ≤ `longest`"),
    Key::new("longest", "the longest wavelength", &[SIZE], "1.0").unit(Unit::Length).otherwise("that of the cell"),
    Key::new("rolloff", "the wavelength above which the spectrum is constant", &[SIZE], "0.5")
        .unit(Unit::Length)
        .otherwise("`longest`"),
    Key::new("rms_slope", "root mean square of the slope", &[Form::Number(Range::POSITIVE)], "0.1"),
    Key::new("rms_height", "root mean square of the heights", &[SIZE], "0.02")
        .unit(Unit::Length)
        .instead_of("rms_slope"),
    Key::new("seed", "which of all such surfaces", &[Form::Integer(0, i64::MAX as usize)], "1").default("0"),
]);
