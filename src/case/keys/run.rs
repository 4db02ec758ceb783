//! `[load]`, `[grid]`, `[solver]`, `[friction]` and `[units]`: what is solved, and how.

use std::ops::Bound;

use super::key::{Form, Key, Keys};
use super::range::Range;
use super::unit::Unit;

/// Most load steps a case can have.
const STEPS: usize = 10_000;

const SIZE_OR_ZERO: Form = Form::Number(Range::SizeOrZero);
const LOADS: Form = Form::List { of: &SIZE_OR_ZERO, count: [1, STEPS] };
const POINTS: Form = Form::Integer(4, 32_768);

pub(in crate::case) static LOAD: Keys = Keys::new(&[
    Key::new(
        "mean_pressure",
        "the nominal pressure p̄",
        &[SIZE_OR_ZERO, LOADS, Form::Table(&PRESSURES)],
        "[0.01, 0.06]",
    )
    .unit(Unit::Pressure),
    Key::new(
        "penetration",
        "the penetration δ from first touch",
        &[SIZE_OR_ZERO, LOADS, Form::Table(&PENETRATIONS)],
        "[0.01, 0.05]",
    )
    .unit(Unit::Length)
    .instead_of("mean_pressure"),
]);

static PRESSURES: Keys = Keys::new(&range(Unit::Pressure));
static PENETRATIONS: Keys = Keys::new(&range(Unit::Length));

/// The keys of a range of load steps.
const fn range(unit: Unit) -> [Key; 4] {
    [
        Key::new("from", "the first value", &[SIZE_OR_ZERO], "1e-4")
            .unit(unit)
            .rule("greater than 0 with `spacing = \"log\"`"),
        Key::new("to", "the last value", &[SIZE_OR_ZERO], "0.06")
            .unit(unit)
            .rule("greater than 0 with `spacing = \"log\"`"),
        Key::new("steps", "the number of values, both ends counted", &[Form::Integer(1, STEPS)], "20"),
        Key::new("spacing", "by equal amounts or by equal factors", &[Form::Word(&["linear", "log"])], "\"log\"")
            .default("\"linear\""),
    ]
}

pub(super) static GRID: Keys = Keys::new(&[
    Key::new(
        "points",
        "samples along each cell vector, a product of the factors 2, 3, 5 and 7",
        &[POINTS, Form::Tuple("[n1, n2]", &[POINTS; 2])],
        "[512, 256]",
    )
    .default("512")
    .rule("beside a surface's file its own when not given, which may have any factors"),
    Key::new(
        "accuracy",
        "refine until results change by less, relatively",
        &[Form::Number(Range::Within(Bound::Excluded(0.0), Bound::Included(0.1)))],
        "1e-3",
    )
    .otherwise("`points` are taken")
    .instead_of("points"),
]);

pub(super) static SOLVER: Keys = Keys::new(&[
    Key::new(
        "method",
        "which method of conjugate gradients",
        &[Form::Word(&["preconditioned", "polonsky-keer"])],
        "\"polonsky-keer\"",
    )
    .default("\"preconditioned\"")
    .rule("not \"polonsky-keer\" under coupled friction"),
    Key::new(
        "tolerance",
        "energy of the error below 20 tolerance times the elastic energy, penetration outside contact below 10 \
         tolerance times δ, residual ε below the tolerance",
        &[Form::Number(Range::between(1e-14, 1e-4))],
        "1e-10",
    )
    .default("1e-8"),
    Key::new(
        "max_iterations",
        "most iterations for one load step on one grid",
        &[Form::Integer(1, usize::MAX)],
        "2000",
    )
    .default("10000"),
]);

pub(super) static FRICTION: Keys = Keys::new(&[
    Key::new("coefficient", "μ: the body feels the traction μp", &[Form::Number(Range::between(0.0, 100.0))], "0.3"),
    Key::new(
        "direction",
        "in which the indenters slide, of any length",
        &[Form::Tuple("a direction [x, y]", &[Form::Number(Range::Place); 2])],
        "[1.0, 1.0]",
    )
    .default("[1, 0]")
    .rule("not [0, 0]"),
    Key::new("coupling", "whether the pressure follows what the traction displaces", &[Form::Boolean], "false")
        .default("true"),
]);

/// Most letters of a unit's name.
const LETTERS: usize = 12;

pub(super) static UNITS: Keys = Keys::new(&[
    Key::new("length", "what lengths are measured in", &[Form::Name("a name", LETTERS)], "\"µm\"")
        .otherwise("not named"),
    Key::new("pressure", "what pressures are measured in", &[Form::Name("a name", LETTERS)], "\"GPa\"")
        .otherwise("not named"),
]);
