//! `[surface]`: one period of any topography, from a file or a seed.
//!
//! `file` converts heights of any format ([`percoat_surfaces::heights`]) to the unit of the case, `preparation` frees them of their form, of holes and
//! short waves and tapers them, `random` has the keys of a generated surface.
//! [`ORIENTATION`] draws the directions of the indices.

mod file;
mod preparation;
mod random;
mod section;
mod stage;

use super::error::Refusal;
use super::grid;
use super::lattice::{LatticeSection, build_cell};
use super::reader::TableAt;
use super::source::Source;
use super::value::ValueAt;
use crate::case::section::ReadTable;
use crate::units::CARRIED;
use file::{Extent, FromFile, Treatment};
use ndarray::Array2;
use percoat_core::counterbody::Topography;
use percoat_core::counterbody::roughness::{Spectrum, SurfaceForm};
use percoat_core::lattice::Cell;
use percoat_core::notation::number;
use percoat_core::run::Sampling;
use percoat_surfaces::heights::fits;
use preparation::{Prepared, prepared};

pub use percoat_surfaces::heights::WantedChannel;
pub use random::RandomSection;
pub use section::{Sides, SurfaceSection, Taper};
pub use stage::{Stage, Treated};

pub(super) use file::{refused, stored};
pub(super) use section::SURFACE;

/// Directions of the indices of `heights[i, j]`, a drawing.
pub const ORIENTATION: &str = "   a₂ ↑  [0, n₂−1]  …  [n₁−1, n₂−1]    heights[i, j], larger = nearer to the body
      │      ⋮               ⋮         i: along a₁; the lines of a text file
      │    [0, 0]   …    [n₁−1, 0]     j: along a₂; the numbers of a line
      └──────────────────────→ a₁      an image with its first row on top: image[::-1].T";

/// The surroundings with which a topography is read.
#[derive(Debug)]
pub(super) struct Around<'a> {
    /// The source of the case, with its files.
    pub(super) source: &'a Source,
    pub(super) lattice: Option<TableAt<'a>>,
    pub(super) grid: TableAt<'a>,
    /// `units.length`, if any.
    pub(super) length: Option<String>,
}

/// A topography of a case, as read.
#[derive(Debug)]
pub(super) struct Read {
    pub(super) section: SurfaceSection,
    pub(super) lattice: LatticeSection,
    pub(super) topography: Topography,
    pub(super) sampling: Sampling,
    pub(super) doubts: Vec<String>,
}

/// Relative loss of rms slope above which there is a warning: under light loads the area of contact goes as 1/slope.
const LOSS: f64 = 0.01;

/// Reads the section and its file, or generates its surface.
pub(super) fn read(section: &TableAt<'_>, around: &Around<'_>) -> Result<Read, Refusal> {
    section.only()?;
    match section.one_of(["heights", "random"])? {
        (0, heights) => from_file(section, &heights, around),
        (_, random) => from_seed(section, &random, around),
    }
}

fn from_file(section: &TableAt<'_>, heights: &ValueAt<'_>, around: &Around<'_>) -> Result<Read, Refusal> {
    let own_section = SurfaceSection::read_table(section)?;
    let length = around.length.as_deref();
    let treatment = Treatment::of(&own_section, section, length)?;
    let FromFile { heights: stored, extent, treatment, lines_along_a1, doubts } =
        file::read(around.source, heights, own_section.channel.as_ref(), treatment, length)?;
    let points: [usize; 2] = stored.dim().into();
    let (lattice, cell) = cell(&own_section, section, around, points, extent)?;
    let Prepared { heights: stored, run_out, stages, spectrum, doubts: of_preparation } =
        prepared(section, heights, cell, stored, &treatment)?;
    let across = across(points, cell);
    let jump = cell.surroundings().per_cell(&stored).and_then(|stored| file::not_periodic(stored, &treatment));
    let sampling = grid::read(&around.grid, Some(points))?;
    let (on_grid, lost) = match sampling {
        Sampling::Points(wanted) if wanted != points => resampled(heights, cell, stored, wanted)?,
        _ => (stored, None),
    };
    let squeezed = if let Extent::Stated(sides) = extent { squeezed(sides, cell) } else { None };
    let name = heights.text()?;
    let path = around.source.path(name).map_or(name.to_owned(), |path| path.to_string_lossy().into_owned());
    let topography = topography(section, own_section.radius, cell, on_grid)?;
    let topography = run_out.into_iter().fold(topography, Topography::with_run_out);
    let topography = spectrum.iter().fold(topography, Topography::with_spectrum);
    let Treatment { own_scale, name: unit, form, cutoff, window, .. } = treatment;
    Ok(Read {
        section: SurfaceSection {
            heights: Some(path),
            channel: own_section.channel,
            scale: Some(own_scale.unwrap_or(1.0)),
            unit,
            period: None,
            pixel: None,
            level: Some(form == SurfaceForm::Plane),
            form: Some(form),
            cutoff,
            window: window.map(|window| Taper(Some(window))),
            radius: own_section.radius,
            random: None,
            lines_along_a1,
            stages,
        },
        lattice,
        topography,
        sampling,
        doubts: doubts
            .into_iter()
            .chain(of_preparation)
            .chain(jump)
            .chain(across)
            .chain(lost)
            .chain(squeezed)
            .collect(),
    })
}

/// A warning where the spacings along a₁ and a₂ differ, and would be equal with lines and numbers exchanged.
fn across([n1, n2]: [usize; 2], cell: Cell) -> Option<String> {
    let [side1, side2] = cell.vectors().map(|[x, y]| x.hypot(y));
    let is_one = |ratio: f64, near: f64| (ratio - 1.0).abs() < near;
    let (as_read, exchanged) = (side1 / n1 as f64 * (n2 as f64 / side2), side1 / n2 as f64 * (n1 as f64 / side2));
    (n1 != n2 && !is_one(as_read, 0.02) && is_one(exchanged, 0.002)).then(|| {
        format!(
            "surface.heights: {n1} lines stand {} apart along a₁ and the {n2} numbers of a line {} along a₂; were lines read along \
             a₂, both would stand {} apart: is it an image? Its lines run along x: give image[::-1].T, or exchange the sides",
            number(side1 / n1 as f64),
            number(side2 / n2 as f64),
            number(side1 / n2 as f64)
        )
    })
}

/// A warning where the sides of a file differ from the cell by more than a hundredth.
fn squeezed(stated: [f64; 2], cell: Cell) -> Option<String> {
    let sides = cell.vectors().map(|[x, y]| x.hypot(y));
    let differs = (0..2).any(|axis| (stated[axis] / sides[axis] - 1.0).abs() > 0.01);
    differs.then(|| {
        let [stated, sides] = [stated, sides].map(|sides| sides.map(number).join(" × "));
        format!(
            "the surface's file says that it is {stated} large; the case makes that {sides}: leave [lattice], surface.period and \
             surface.pixel out, or say the unit of the file"
        )
    })
}

fn from_seed(section: &TableAt<'_>, random: &ValueAt<'_>, around: &Around<'_>) -> Result<Read, Refusal> {
    if let Some(value) = ["channel", "scale", "unit", "pixel", "level", "form", "cutoff", "window"]
        .iter()
        .find_map(|key| section.optional(key))
    {
        let message = format!("`{}` has no place beside `surface.random`: it belongs to a file's heights", value.path);
        return Err(Refusal::new(value.node.span, message, "not used here").help("remove it"));
    }
    let table = random.table_or("write it as a section, [surface.random]")?;
    let own_section = SurfaceSection::read_table(section)?;
    let (lattice, cell) = cell(&own_section, section, around, [1, 1], Extent::Unstated)?;
    let random = RandomSection::read_in(&table, cell)?;
    let surface = random.surface();
    let sampling = grid::read(&around.grid, None)?;
    let refuse = |error: String| Refusal::new(table.span, format!("`surface.random`: {error}"), "no such surface");
    let points = match sampling {
        Sampling::Points(points) => points,
        Sampling::Accuracy(_) => surface.resolving_points(cell).map_err(|error| refuse(error.to_string()))?,
    };
    room(&table, points)?;
    let (spectrum, whole) = surface
        .spectrum(cell, points)
        .and_then(|spectrum| Ok((spectrum, surface.rms_slope(cell)?)))
        .map_err(|error| refuse(error.to_string()))?;
    let lost = loss([spectrum.rms_slope(), whole], points);
    Ok(Read {
        topography: topography(section, own_section.radius, cell, spectrum.into_heights())?,
        section: SurfaceSection { period: None, random: Some(random), ..own_section },
        lattice,
        sampling,
        doubts: lost.into_iter().collect(),
    })
}

/// The cell: `[lattice]`, or the period in the section or its file.
fn cell(
    surface: &SurfaceSection,
    section: &TableAt<'_>,
    around: &Around<'_>,
    points: [usize; 2],
    of_file: Extent,
) -> Result<(LatticeSection, Cell), Refusal> {
    let [period, pixel] = ["period", "pixel"].map(|key| section.optional(key));
    if let Some(table) = &around.lattice {
        if let Some(value) = period.or(pixel) {
            let message = format!("`{}` and [lattice] exclude each other: both say how large the cell is", value.path);
            return Err(Refusal::new(value.node.span, message, "the cell is known"));
        }
        let lattice = LatticeSection::read_table(table)?;
        return Ok((lattice, build_cell(&lattice, table)?));
    }
    let sides = match (surface.period, surface.pixel) {
        (Some(_), Some(_)) => {
            return Err(section.both(["period", "pixel"], pixel.map_or(section.span, |pixel| pixel.node.span)));
        }
        (Some(Sides(sides)), None) => sides,
        (None, Some(Sides([d1, d2]))) => [d1 * points[0] as f64, d2 * points[1] as f64],
        (None, None) => match of_file {
            Extent::Stated(sides) => sides,
            other => return Err(without_sides(section, other)),
        },
    };
    if let Some(side) = sides.iter().find(|side| !CARRIED.contains(*side)) {
        let message = format!("`surface`: a side of the cell is {side}; it must be between 1e-60 and 1e60");
        return Err(Refusal::new(section.span, message, "no cell"));
    }
    let lattice = LatticeSection::rectangle(sides);
    Ok((lattice, build_cell(&lattice, section)?))
}

/// The refusal of a surface whose size neither the case nor its file states.
fn without_sides(section: &TableAt<'_>, of_file: Extent) -> Refusal {
    let advice = "add period = L or [L1, L2], the lengths of the whole file along a₁ and a₂; or pixel = d, the distance of its samples; or a \
                  section [lattice]";
    let help = match of_file {
        Extent::WithoutUnit => format!("the file states its sides, and not their unit: {advice}"),
        _ => advice.to_owned(),
    };
    Refusal::new(section.span, "`surface.period` is missing, and so is [lattice]", "how large is the cell?").help(help)
}

/// Heights of a file on another grid, and a warning about the slope that is lost.
fn resampled(
    value: &ValueAt<'_>,
    cell: Cell,
    heights: Array2<f64>,
    points: [usize; 2],
) -> Result<(Array2<f64>, Option<String>), Refusal> {
    let refuse = |what: String| Refusal::new(value.node.span, format!("`{}`: {what}", value.path), "resampled");
    let needed = 24 * (heights.len() + points[0] * points[1]) as u64;
    fits(needed).map_err(|fault| refuse(format!("resampling {}", fault.what)).help("choose fewer grid.points"))?;
    let spectrum = Spectrum::of(cell, heights.view()).map_err(|error| refuse(error.to_string()))?;
    drop(heights);
    let on_grid = spectrum.resampled(points).map_err(|error| refuse(error.to_string()))?;
    let held = Spectrum::of(cell, on_grid.view()).map_err(|error| refuse(error.to_string()))?;
    Ok((on_grid, loss([held.rms_slope(), spectrum.rms_slope()], points)))
}

/// Refuses a generated surface for which there is no memory.
fn room(section: &TableAt<'_>, [n1, n2]: [usize; 2]) -> Result<(), Refusal> {
    fits(24 * (n1 * n2) as u64).map_err(|fault| {
        let message = format!("`surface.random`: on {n1} × {n2} samples it {}", fault.what);
        Refusal::new(section.span, message, fault.label()).help("choose fewer grid.points")
    })
}

fn topography(
    section: &TableAt<'_>,
    radius: Option<f64>,
    cell: Cell,
    heights: Array2<f64>,
) -> Result<Topography, Refusal> {
    let plane = Topography::new(cell, heights)
        .map_err(|error| Refusal::new(section.span, format!("`surface`: {error}"), "no topography"))?;
    let Some(radius) = radius else { return Ok(plane) };
    plane.on_ball(radius).map_err(|error| {
        let span = section.optional("radius").map_or(section.span, |key| key.node.span);
        Refusal::new(span, format!("`surface.radius`: {error}"), "no ball")
    })
}

/// A warning where a grid of `points` keeps the rms slope `held` of `whole`.
fn loss([held, whole]: [f64; 2], [n1, n2]: [usize; 2]) -> Option<String> {
    (held < (1.0 - LOSS) * whole).then(|| {
        format!(
            "grid.points = [{n1}, {n2}] holds an rms slope of {} of the surface's {}: waves shorter than two samples are \
             left out, and the true area of contact is smaller and the pressure higher by about as much; raise grid.points",
            number(held),
            number(whole)
        )
    })
}

#[cfg(test)]
mod tests;
