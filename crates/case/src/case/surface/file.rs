//! `[surface]` from a file: its heights in the unit of the case.

use std::path::{Path, PathBuf};

use super::super::error::Refusal;
use super::super::reader::TableAt;
use super::super::source::{PhysicalSizes, Source};
use super::super::value::ValueAt;
use super::section::{SurfaceSection, Taper};
use ndarray::Array2;
use percoat_core::counterbody::roughness::{MAX_BORDER_JUMP, SurfaceForm, Window, border_jumps};
use percoat_core::notation::number;
use percoat_core::numeric::array::field;
use percoat_surfaces::heights::unit::{self, KNOWN};
use percoat_surfaces::heights::{
    ELSEWHERE, FORMATS, Fault, Heights, HeightsFormat, HeightsUnit, Length, Stored, WantedChannel,
};

/// Conversion of the heights of a file.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Treatment {
    /// Factor of the heights, that of their unit included.
    pub scale: f64,
    /// Factor of the coordinates of points.
    pub unit: f64,
    /// Factor of the section, if any.
    pub own_scale: Option<f64>,
    /// Unit of the section, or of the file.
    pub name: Option<String>,
    /// Form that is subtracted.
    pub form: SurfaceForm,
    /// Cut-off of short waves, a length, if any.
    pub cutoff: Option<f64>,
    /// Taper, if any.
    pub window: Option<Window>,
}

/// Sides of a surface as its file states them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Extent {
    /// No sides, or sides in a unit that cannot be converted to that of the case.
    Unstated,
    /// Sides in no unit.
    WithoutUnit,
    /// Sides along a₁ and a₂, lengths of the case.
    Stated([f64; 2]),
}

/// A surface from a file.
#[derive(Debug)]
pub(super) struct FromFile {
    /// Heights, lengths of the case, axis 0 along a₁, axis 1 along a₂; NaN where there is no measurement.
    pub heights: Array2<f64>,
    /// The lengths of its sides.
    pub extent: Extent,
    /// Conversion of its heights.
    pub treatment: Treatment,
    /// Whether it is a text whose lines run along a₁ by default.
    pub lines_along_a1: bool,
    /// Warnings, a sentence each.
    pub doubts: Vec<String>,
}

impl Treatment {
    /// The conversion of a section, read from its `table`; `length` is the unit of the case, if any.
    pub fn of(surface: &SurfaceSection, table: &TableAt<'_>, length: Option<&str>) -> Result<Self, Refusal> {
        let unit = table.optional("unit").map_or(Ok(1.0), |value| unit_of(&value, length))?;
        Ok(Self {
            scale: surface.scale.unwrap_or(1.0) * unit,
            unit,
            own_scale: surface.scale,
            name: surface.unit.clone(),
            form: surface.form.unwrap_or(if surface.level == Some(true) {
                SurfaceForm::Plane
            } else {
                SurfaceForm::None
            }),
            cutoff: surface.cutoff,
            window: surface.window.and_then(|Taper(window)| window),
        })
    }

    /// The conversion with the `unit` of a file; `length` is the unit of the case, if any.
    fn of_file(self, unit: Option<&HeightsUnit>, length: Option<&str>) -> Result<Self, Fault> {
        let unit = match (unit, &self.name) {
            (None, _) => return Ok(self),
            (Some(HeightsUnit::Known(unit)), None) => unit,
            (Some(HeightsUnit::Known(unit)), Some(name)) => {
                return match unit::factor(unit, name) {
                    Ok(1.0) => Ok(self),
                    _ => {
                        Err(Fault::new(format!("says that its heights are in {unit}"), "another unit than the file's")
                            .help("leave surface.unit out, or correct the header of the file"))
                    }
                };
            }
            (Some(HeightsUnit::Other), _) if self.own_scale.is_some() && self.name.is_none() => return Ok(self),
            (Some(HeightsUnit::Other), _) => {
                let what = "says that its heights are in no unit of length that is known, or have a factor before them";
                return Err(Fault::new(what, "which factor?").help(
                    "give surface.scale, the factor from its numbers to the case's lengths, without surface.unit",
                ));
            }
        };
        match (length.and_then(|length| unit::factor(unit, length).ok()), self.own_scale) {
            (None, Some(_)) => Ok(self),
            (None, None) => Err(Fault::new(format!("says that its heights are in {unit}"), "to be converted to what?").help(
                "add [units] with length = \"µm\" or another, or give surface.scale, the factor to the case's lengths",
            )),
            (Some(factor), None) => Ok(Self { scale: factor, unit: factor, name: Some(unit.clone()), ..self }),
            // The factor of the section is that of the unit, or the unit has the factor 1.
            (Some(factor), Some(scale)) if factor == 1.0 || (scale.abs() / factor - 1.0).abs() < 1e-9 => Ok(self),
            (Some(factor), Some(_)) => Err(Fault::new(
                format!("says that its heights are in {unit}, which makes a factor of {factor:?}, not that of surface.scale"),
                "with the unit or without?",
            )
            .help(format!("add surface.unit = \"{unit}\": surface.scale is then a factor beside it; or leave surface.scale out"))),
        }
    }

    /// Refuses heights of an instrument in no unit, of which the case says none either.
    fn in_a_unit(&self, unit: Option<&HeightsUnit>) -> Result<(), Fault> {
        if unit.is_some() || self.name.is_some() || self.own_scale.is_some() {
            return Ok(());
        }
        Err(Fault::new("says no unit of its heights", "which unit?").help(
            "give surface.unit, the unit of its lengths; or surface.scale, the factor from its numbers to the case's lengths, and \
             surface.period",
        ))
    }

    /// Sides of a file in the unit of the case; `None` where their unit cannot be converted.
    fn sides(&self, sides: [Length; 2], length: Option<&str>) -> Option<[f64; 2]> {
        let [one, two] = sides.map(|side| side.in_unit(length, self.unit));
        Some([one?, two?])
    }
}

fn unit_of(value: &ValueAt<'_>, length: Option<&str>) -> Result<f64, Refusal> {
    let name = value.text()?;
    let Some(length) = length else {
        let message = format!("`{}` needs the unit of the case's lengths to be converted to", value.path);
        return Err(Refusal::new(value.node.span, message, "converted to what?")
            .help("add [units] with length = \"µm\" or another, or give `scale` instead of `unit`"));
    };
    // The error names the unit that is not known.
    unit::factor(name, name).map_err(|_| value.refuse(format!("a unit of length: {KNOWN}")))?;
    unit::factor(name, length).map_err(|error| {
        let message = format!("`{}` cannot be converted to `units.length`: {error}", value.path);
        Refusal::new(value.node.span, message, "converted to what?")
            .help(format!("known are {KNOWN}; or give `scale` instead of `unit`"))
    })
}

/// Reads the `wanted` channel of the file of `source` with the name `written`; `length` is the unit of the case, if any.
pub(super) fn read(
    source: &Source,
    written: &ValueAt<'_>,
    wanted: Option<&WantedChannel>,
    treatment: Treatment,
    length: Option<&str>,
) -> Result<FromFile, Refusal> {
    let name = written.text()?;
    let path = source.path(name).unwrap_or_else(|| PathBuf::from(name));
    let refuse = |fault: Fault| refused(written, &path, fault);
    let Stored { heights: Heights { points, mut values }, sides, unit, is_measured, lines_along_a1, doubts } =
        stored(source, &path, written, wanted, "one period of heights")?.map_err(refuse)?;
    if is_measured {
        treatment.in_a_unit(unit.as_ref()).map_err(refuse)?;
    }
    // The unit of the section is that of the sides too, where the file has none at all.
    let is_said = !is_measured || unit.is_none() && treatment.name.is_some();
    let treatment = treatment.of_file(unit.as_ref(), length).map_err(refuse)?;
    values.iter_mut().for_each(|height| *height *= treatment.scale);
    let Heights { values, .. } = Heights::new(points, values).map_err(refuse)?;
    let extent = match sides {
        Some(sides) if !is_said && sides.iter().any(|side| side.unit.is_none()) => Extent::WithoutUnit,
        sides => sides.and_then(|sides| treatment.sides(sides, length)).map_or(Extent::Unstated, Extent::Stated),
    };
    Ok(FromFile { heights: field(points, values), extent, treatment, lines_along_a1, doubts })
}

/// The refusal of the file at a path for its fault.
pub(in crate::case) fn refused(written: &ValueAt<'_>, path: &Path, fault: Fault) -> Refusal {
    let message = format!("`{}`: {} {}", written.path, path.display(), fault.what);
    let refusal = Refusal::new(written.node.span, message, fault.label);
    fault.help.into_iter().fold(refusal, Refusal::help)
}

/// The numbers in the `wanted` channel of a file of heights, or of what is `needed` in their place; a refusal where there is no such
/// file, or its format is not known.
pub(in crate::case) fn stored(
    source: &Source,
    path: &Path,
    written: &ValueAt<'_>,
    wanted: Option<&WantedChannel>,
    needed: &str,
) -> Result<Result<Stored, Fault>, Refusal> {
    let shown = path.display();
    if let Some(array) = source.arrays.get(written.text()?) {
        let sized = |stored: Stored| match source.sizes.get(written.text().unwrap_or_default()) {
            Some(PhysicalSizes { sides, unit }) => stored.sized(*sides, unit.as_deref()),
            None => Ok(stored),
        };
        return Ok(Stored::of(array, wanted).and_then(sized));
    }
    let format = HeightsFormat::of(path);
    if format.is_none() && !source.is_pipe(written.text()?) {
        let message = format!("`{}`: {shown} has an ending by which no format is known", written.path);
        return Err(
            Refusal::new(written.node.span, message, "which format?").help(format!("allowed: {FORMATS}; {ELSEWHERE}"))
        );
    }
    let (reader, bytes) = source.open(written.text()?).map_err(|error| {
        let message = format!("`{}`: cannot read {shown}: {error}", written.path);
        Refusal::new(written.node.span, message, "this file").help(format!(
            "needed: {needed}, float64 in a `.npy` file for example; a path is relative to the case file"
        ))
    })?;
    Ok(Stored::read(reader, bytes, format, wanted))
}

/// A warning where the surface jumps between two periods.
pub(super) fn not_periodic(heights: &Array2<f64>, treatment: &Treatment) -> Option<String> {
    let jumps = border_jumps(heights.view());
    let (axis, jump) = if jumps[0] >= jumps[1] { ("a₁", jumps[0]) } else { ("a₂", jumps[1]) };
    let advice = match treatment {
        Treatment { window: Some(_), .. } => "the window is too narrow for it",
        Treatment { form: SurfaceForm::None, .. } => {
            "it is pressed as if it were periodic; surface.level = true takes its plane away, surface.window = true tapers \
             its border"
        }
        _ => "it is pressed as if it were periodic; surface.window = true tapers its border",
    };
    (jump > MAX_BORDER_JUMP).then(|| {
        format!(
            "surface.heights: where the surface meets its next period along {axis} heights jump by {} times the rms \
             difference of neighbours, at most {MAX_BORDER_JUMP} is usual: {advice}",
            number(jump)
        )
    })
}
