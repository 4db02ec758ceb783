//! `[surface]` from a file: which format it has, and its heights in the case's unit, made periodic.

use std::path::{Path, PathBuf};

use super::super::error::Refusal;
use super::super::node::Value;
use super::super::reader::TableAt;
use super::super::source::Source;
use super::super::value::ValueAt;
use super::fault::{Fault, Heights};
use super::unit::{self, KNOWN};
use super::{npy, text, xyz};
use crate::counterbody::roughness::{JUMP, Window, border_jumps, levelled, tapered};
use crate::numeric::array::field;
use crate::numeric::number::number;
use ndarray::Array2;

/// How a file's heights become those of the case.
#[derive(Debug, Clone, Copy)]
pub(super) struct Treatment {
    /// Factor of the heights, that of their unit included.
    pub scale: f64,
    /// Factor of the coordinates of points.
    pub unit: f64,
    /// Whether the mean plane is taken away.
    pub level: bool,
    /// Taper, if any.
    pub window: Option<Window>,
}

/// What a file gives.
#[derive(Debug)]
pub(super) struct FromFile {
    /// Heights, lengths of the case, axis 0 along a₁, axis 1 along a₂.
    pub heights: Array2<f64>,
    /// Its own period along a₁ and a₂, if it knows it, a length of the case.
    pub period: Option<[f64; 2]>,
    /// What is doubtful about it.
    pub doubt: Option<String>,
}

const FORMATS: &str =
    "`.npy` (NumPy), `.csv`, `.txt` or `.dat` (a matrix of numbers), `.xyz` (x y z, one point a line)";

impl Treatment {
    /// Of the section; `length` is the case's unit, where it names one.
    pub fn read(section: &TableAt<'_>, length: Option<&str>) -> Result<Self, Refusal> {
        let scale = section.value("scale")?.number()?;
        let unit = section.optional("unit").map_or(Ok(1.0), |value| unit_of(&value, length))?;
        let level = section.value("level")?.boolean()?;
        let window = section.value("window")?;
        let window = match &window.node.value {
            Value::Text(_) => match window.word()? {
                "hann" => Some(Window::Hann),
                _ => Some(Window::Tukey),
            },
            _ => window.boolean()?.then_some(Window::Tukey),
        };
        Ok(Self { scale: scale * unit, unit, level, window })
    }
}

fn unit_of(value: &ValueAt<'_>, length: Option<&str>) -> Result<f64, Refusal> {
    let name = value.text()?;
    let Some(length) = length else {
        let message = format!("`{}` needs the unit of the case's lengths to be converted to", value.path);
        return Err(Refusal::new(value.node.place, message, "converted to what?")
            .help("add [units] with length = \"µm\" or another, or give `scale` instead of `unit`"));
    };
    // Which of both is not known.
    unit::factor(name, name).map_err(|_| value.refuse(format!("a unit of length: {KNOWN}")))?;
    unit::factor(name, length).map_err(|error| {
        let message = format!("`{}` cannot be converted to `units.length`: {error}", value.path);
        Refusal::new(value.node.place, message, "converted to what?")
            .help(format!("known are {KNOWN}; or give `scale` instead of `unit`"))
    })
}

/// Read the file of `source` that `written` names.
pub(super) fn read(source: &Source, written: &ValueAt<'_>, treatment: Treatment) -> Result<FromFile, Refusal> {
    let name = written.text()?;
    let path = source.path(name).unwrap_or_else(|| PathBuf::from(name));
    let refuse = |fault: Fault| {
        let message = format!("`{}`: {} {}", written.path, path.display(), fault.what);
        let refusal = Refusal::new(written.node.place, message, fault.label);
        fault.help.into_iter().fold(refusal, Refusal::help)
    };
    let (Heights { points, mut values }, period) = heights(source, &path, written)?.map_err(refuse)?;
    values.iter_mut().for_each(|height| *height *= treatment.scale);
    let Heights { values, .. } = Heights::new(points, values).map_err(refuse)?;
    let heights = field(points, values);
    let heights = match treatment {
        Treatment { window: Some(window), level, .. } => tapered(heights, window, level),
        Treatment { level: true, .. } => levelled(heights),
        _ => heights,
    };
    let doubt = not_periodic(&heights, treatment);
    Ok(FromFile { heights, period: period.map(|period| period.map(|length| length * treatment.unit)), doubt })
}

type Read = Result<(Heights, Option<[f64; 2]>), Fault>;

/// The heights as they stand in the file, and the period of a file that tells it; refused when there is no such file.
fn heights(source: &Source, path: &Path, written: &ValueAt<'_>) -> Result<Read, Refusal> {
    let shown = path.display();
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    if !["npy", "csv", "txt", "dat", "xyz"].contains(&&extension[..]) {
        let message = format!("`{}`: {shown} has an ending by which no format is known", written.path);
        return Err(Refusal::new(written.node.place, message, "which format?").help(format!("allowed: {FORMATS}")));
    }
    let (reader, bytes) = source.open(written.text()?).map_err(|error| {
        let message = format!("`{}`: cannot read {shown}: {error}", written.path);
        Refusal::new(written.node.place, message, "this file").help(
            "needed: one period of heights, float64 in a `.npy` file for example; a path is relative to the case file",
        )
    })?;
    Ok(match &extension[..] {
        "npy" => npy::read(reader, bytes).map(|heights| (heights, None)),
        "xyz" => xyz::read(reader, bytes).map(|(heights, period)| (heights, Some(period))),
        _ => text::read(reader, bytes).map(|heights| (heights, None)),
    })
}

/// That a surface jumps where it meets its next period.
fn not_periodic(heights: &Array2<f64>, treatment: Treatment) -> Option<String> {
    let jumps = border_jumps(heights.view());
    let (axis, jump) = if jumps[0] >= jumps[1] { ("a₁", jumps[0]) } else { ("a₂", jumps[1]) };
    let advice = match treatment {
        Treatment { window: Some(_), .. } => "the window is too narrow for it",
        Treatment { level: false, .. } => {
            "it is pressed as if it were periodic; surface.level = true takes its plane away, surface.window = true tapers \
             its border"
        }
        Treatment { level: true, .. } => {
            "it is pressed as if it were periodic; surface.window = true tapers its border"
        }
    };
    (jump > JUMP).then(|| {
        format!(
            "surface.heights: where the surface meets its next period along {axis} heights jump by {} times the rms \
             difference of neighbours, at most {JUMP} is usual: {advice}",
            number(jump)
        )
    })
}
