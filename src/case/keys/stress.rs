//! `[stress]` and `[localized]`: what is wanted beside the contact.

use super::key::{Form, Key, Keys};
use super::range::Range;
use super::unit::Unit;

const SIZE: Form = Form::Number(Range::Size);
const SIZE_OR_ZERO: Form = Form::Number(Range::SizeOrZero);
const PLACE: Form = Form::Number(Range::Place);
const LEVEL: Form = Form::Text("a level such as \"level 1\"");

pub(super) static STRESS: Keys = Keys::new(&[
    Key::new(
        "planes",
        "depths of horizontal planes; one on an interface gives both sides",
        &[Form::List { of: &SIZE_OR_ZERO, count: [0, 1000] }],
        "[0.0, 0.25, 0.5]",
    )
    .unit(Unit::Length)
    .default("[]"),
    Key::new(
        "mean",
        "the mean lateral stress: that of no mean lateral strain, or under the centre of a wide loaded disc",
        &[Form::Word(&["confined", "half-space"])],
        "\"half-space\"",
    )
    .default("\"confined\""),
    Key::new(
        "section",
        "a vertical cut from one level or place toward another, or along a direction",
        &[Form::Table(&CUT)],
        "{ from = \"level 1\", toward = \"level 2\", length = 1.0, depth = 1.0 }",
    )
    .otherwise("no cut"),
    Key::new(
        "points",
        "single points, z ≥ 0 into the body",
        &[Form::List { of: &Form::Tuple("a point [x, y, z]", &[PLACE, PLACE, SIZE_OR_ZERO]), count: [0, 100_000] }],
        "[[0.0, 0.0, 0.1]]",
    )
    .unit(Unit::Length)
    .default("[]"),
    Key::new(
        "volume",
        "the field under the cell, for ParaView",
        &[Form::Table(&VOLUME)],
        "{ depth = 1.0, rows = 40, points = 96 }",
    )
    .otherwise("no field"),
]);

static CUT: Keys = Keys::new(&[
    Key::new(
        "from",
        "where the cut has its origin: the axis of a level's first indenter, or a place",
        &[LEVEL, Form::Tuple("a place [x, y]", &[PLACE; 2])],
        "\"level 1\"",
    )
    .unit(Unit::Length),
    Key::new(
        "toward",
        "where it runs to: the nearest other indenter of a level, or a direction",
        &[LEVEL, Form::Tuple("a direction [x, y]", &[PLACE; 2])],
        "\"level 2\"",
    )
    .otherwise("the direction of sliding; needed without [friction]"),
    Key::new("length", "its length along the surface", &[SIZE], "1.0").unit(Unit::Length),
    Key::new("behind", "how far behind the origin it begins", &[SIZE_OR_ZERO], "0.5")
        .unit(Unit::Length)
        .otherwise("half the length without `toward`, else 0"),
    Key::new("depth", "how deep it goes", &[SIZE], "1.0").unit(Unit::Length),
]);

static VOLUME: Keys = Keys::new(&[
    Key::new("depth", "how deep it goes", &[SIZE], "1.0").unit(Unit::Length),
    Key::new("rows", "intervals in depth", &[Form::Integer(1, 2048)], "60").default("40"),
    Key::new("points", "samples along each cell vector", &[Form::Integer(1, 2048)], "128").default("96"),
]);

pub(super) static LOCALIZED: Keys = Keys::new(&[
    Key::new(
        "indenters",
        "how many indenters stand inside the circle, one number a circle",
        &[Form::List { of: &Form::Integer(1, 10_000), count: [1, 100] }],
        "[7, 37]",
    )
    .default("[7, 13, 37, 73]"),
    Key::new("elements", "elements across the largest contact", &[Form::Integer(4, 1000)], "64").default("48"),
    Key::new(
        "radius",
        "of the circle; with \"lattice-sum\" all indenters stand outside it, in place of the uniform pressure",
        &[Form::Word(&["load-balanced", "area-balanced", "lattice-sum"])],
        "\"area-balanced\"",
    )
    .default("\"load-balanced\""),
    Key::new("mutual_effect", "whether the indenters around the one looked at act on it", &[Form::Boolean], "false")
        .default("true"),
]);
