//! The keys of `[surface]`.

use serde::Serialize;
use std::path::Path;

use super::super::error::Refusal;
use super::super::keys::{Form, Key, Range, Unit};
use super::super::node::Value;
use super::super::reader::TableAt;
use super::super::section::{KeyValue, Words, section, words};
use super::super::value::ValueAt;
use super::random::{RANDOM, RandomSection};
use super::stage::Stage;
use percoat_common::plain;
use percoat_core::counterbody::roughness::{SurfaceForm, Window};
use percoat_surfaces::heights::WantedChannel;

const SIZE: Form = Form::Number(Range::Size);

/// Rule of keys that do not apply to `random`.
const OF_A_FILE: &str = "of a file, not of a random surface";

section! {
    /// The section `[surface]`, complete with an absolute path and its factor; its period is in
    /// [`LatticeSection`](crate::case::LatticeSection).
    pub struct SurfaceSection = SURFACE, rules one_form {
        /// a file of heights, `.npy`, `.csv`, `.txt`, `.dat`, `.xyz`, `.x3p`, `.sdf`, `.sur`, `.pro`, `.gwy` or `.asc`, relative to the case file
        pub heights: Option<String> = Key::new(&[Form::Text("the path of a file")], "\"surface.npy\""),
        /// which of its channels holds the heights: a name, or a number from 1
        pub channel: Option<WantedChannel> =
            Key::new(&[Form::Text("the name of a channel"), Form::Integer(1, 10_000)], "1")
                .otherwise("the only one of heights")
                .rule(OF_A_FILE),
        /// factor of its heights, negative to turn them over
        pub scale: Option<f64> =
            Key::new(&[Form::Number(Range::Factor)], "1e-3").default("1").rule(OF_A_FILE),
        /// unit of the heights of the file
        pub unit: Option<String> = Key::new(&[Form::Text("a unit of length")], "\"nm\"")
            .otherwise("the case's own")
            .rule("m, cm, mm, µm, nm, pm, Å, in or mil; needs `units.length`; of a file, not of a random surface"),
        /// lengths of the whole surface along a₁ and a₂
        pub period: Option<Sides> =
            Key::new(&[SIZE, Form::Tuple("two of them, [L1, L2]", &[SIZE; 2])], "[20.0, 10.0]")
                .unit(Unit::Length)
                .otherwise("that of a file of points, or of `lattice`")
                .rule("in place of [lattice]")
                .never_written(),
        /// the distance of its samples along a₁ and a₂
        pub pixel: Option<Sides> = Key::new(&[SIZE, Form::Tuple("two of them, [d1, d2]", &[SIZE; 2])], "0.1")
            .unit(Unit::Length)
            .otherwise("follows from `period`")
            .instead_of("period")
            .rule("in place of [lattice]; of a file, not of a random surface")
            .never_written(),
        /// whether its mean plane is subtracted: the same as `form` = "plane"
        pub level: Option<bool> = Key::new(&[Form::Boolean], "true").default("false").rule(OF_A_FILE),
        /// form that is subtracted, by least squares over what is measured
        pub form: Option<SurfaceForm> =
            Key::new(&[Form::Word(SurfaceForm::WORDS)], "\"sphere\"").default("\"none\"").rule(OF_A_FILE),
        /// wavelength λ_s below which waves are left out, by the Gaussian filter of ISO 16610; λ_s itself is halved
        pub cutoff: Option<f64> = Key::new(&[SIZE], "0.8")
            .unit(Unit::Length)
            .otherwise("all waves are kept")
            .rule("from two samples to the shorter side; of a file, not of a random surface"),
        /// taper of its border; true is "tukey"
        pub window: Option<Taper> =
            Key::new(&[Form::Boolean, Form::Word(Window::WORDS)], "\"tukey\"").default("false").rule(OF_A_FILE),
        /// radius of a ball that the heights stand on, its apex in the middle of the window, or of each periodic cell
        pub radius: Option<f64> = Key::new(&[SIZE], "3000.0").unit(Unit::Length).otherwise("a plane"),
        /// a self-affine surface
        pub random: Option<RandomSection> =
            Key::new(&[Form::Table(&RANDOM)], "{ hurst = 0.8, shortest = 0.25, rms_slope = 0.1 }")
                .instead_of("heights"),
    }
    beside {
        /// Whether its file is a text whose lines run along a₁ by default.
        pub lines_along_a1: bool,
        /// Stages of the preparation of the heights of its file, in order; empty where nothing was done.
        pub stages: Vec<Stage>,
    }
}

words! { Window { Hann = "hann", Tukey = "tukey", } }
words! {
    SurfaceForm {
        None = "none",
        Plane = "plane",
        SecondOrder = "second order",
        Sphere = "sphere",
        Cylinder = "cylinder",
    }
}

impl KeyValue for WantedChannel {
    fn read(value: &ValueAt<'_>) -> Result<Self, Refusal> {
        match &value.node.value {
            Value::Text(_) => value.text().map(|name| Self::Named(name.to_owned())),
            _ => value.integer().map(Self::Number),
        }
    }
}

/// Refuses a `level` that contradicts `form`.
fn one_form(surface: &SurfaceSection, section: &TableAt<'_>) -> Result<(), Refusal> {
    let (Some(level), Some(form)) = (surface.level, surface.form) else { return Ok(()) };
    let other = match (level, form) {
        (true, SurfaceForm::Plane) => return Ok(()),
        (true, _) => "subtracts the mean plane",
        (false, SurfaceForm::Plane) => "keeps the mean plane",
        (false, _) => return Ok(()),
    };
    let value = section.value("form")?;
    let message = format!("`{}` is \"{}\", and `{}` {other}", value.path, form.name(), section.path("level"));
    Err(Refusal::new(value.node.span, message, "which form?").help("leave `level` out: `form` says it all"))
}

/// A taper of the border; none where the key is false.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(transparent)]
pub struct Taper(pub Option<Window>);

impl KeyValue for Taper {
    fn read(value: &ValueAt<'_>) -> Result<Self, Refusal> {
        match &value.node.value {
            Value::Text(_) => Window::read(value).map(Some),
            _ => value.boolean().map(|tapers| tapers.then_some(Window::Tukey)),
        }
        .map(Self)
    }
}

/// Lengths along a₁ and a₂.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(transparent)]
pub struct Sides(pub [f64; 2]);

impl KeyValue for Sides {
    /// Reads a length for both directions, or one for each.
    fn read(value: &ValueAt<'_>) -> Result<Self, Refusal> {
        match &value.node.value {
            Value::List(_) => value.numbers(),
            _ => value.number().map(|side| [side; 2]),
        }
        .map(Self)
    }
}

impl SurfaceSection {
    /// The keys of a generated surface; `None` for one from a file.
    pub fn random(&self) -> Option<&RandomSection> {
        self.random.as_ref()
    }

    /// The assumed direction of the lines of its file, a sentence; `None` where the file states it.
    pub fn lines(&self) -> Option<String> {
        let heights = self.heights.as_ref().filter(|_| self.lines_along_a1)?;
        Some(format!(
            "{}: its lines run along a₁, the numbers of a line along a₂; of an image, whose lines run along x, give image[::-1].T",
            plain::path(Path::new(heights))
        ))
    }
}
