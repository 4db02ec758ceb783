//! Limits of double precision: refusal of numbers whose ratios are too large.
//!
//! Each number alone is within [`CARRIED`]. Beyond the ratios below one of two numbers is lost in rounding beside the other, far
//! beyond those of any real body.

use std::ops::RangeInclusive;

use super::super::error::Refusal;
use super::super::reader::TableAt;
use super::super::value::ValueAt;
use crate::units::CARRIED;
use percoat_common::plain::float;
use percoat_core::body::{HalfSpace, Interface};
use percoat_core::counterbody::Level;
use percoat_core::lattice::Cell;
use percoat_core::run::Sampling;

/// Allowed ratios of moduli, of thicknesses to the cell, and of springs to the layers above them.
const RATIO: RangeInclusive<f64> = 1e-12..=1e12;
/// Largest ratio of the spacings of samples along the two cell vectors.
const DENSER: f64 = 1000.0;

/// A direction [x, y] along the surface, of any length.
pub(in crate::case) fn direction(value: &ValueAt<'_>) -> Result<[f64; 2], Refusal> {
    let direction = value.numbers()?;
    if direction.iter().all(|x| x.abs() < *CARRIED.start()) {
        return Err(value.refuse("a direction [x, y] other than [0, 0]"));
    }
    Ok(direction)
}

/// Refuses layers and interfaces whose ratios to cell and substrate are not [allowed](RATIO).
pub(in crate::case) fn layers(half_space: &HalfSpace, sections: &[&TableAt<'_>], cell: Cell) -> Result<(), Refusal> {
    let side = cell.reduced().longer_side();
    // Layers on a rigid base are compared with the one at the surface.
    let (reference, of) = match half_space.substrate().material() {
        Some(substrate) => (substrate.shear(), "the substrate's"),
        None => (half_space.surface_material().shear(), "that of the first layer"),
    };
    for (layer, section) in half_space.layers().iter().zip(sections) {
        let refuse = |key: &str, what: String, help: &str| {
            let span = section.optional(key).map_or(section.span, |value| value.node.span);
            Refusal::new(span, format!("`{}`: {what}", section.path(key)), "beyond double precision").help(help)
        };
        let shear = layer.material().shear();
        if !RATIO.contains(&(shear / reference)) {
            let what = format!("the shear modulus {} is {} times {of}", float(shear), short(shear / reference));
            let key =
                ["young", "graded"].into_iter().find(|key| section.optional(key).is_some()).unwrap_or("shear_ratio");
            return Err(refuse(key, what, "between 1e-12 and 1e12 times are carried; are both in one unit?"));
        }
        let thickness = layer.thickness();
        if !RATIO.contains(&(thickness / side)) {
            let what =
                format!("the thickness {} is {} times the cell's side", float(thickness), short(thickness / side));
            return Err(refuse(
                "thickness",
                what,
                "between 1e-12 and 1e12 times are carried: leave a thinner layer out, and make a thicker one the substrate",
            ));
        }
        if let Interface::Spring { tangential, normal } = layer.interface() {
            for (key, stiffness) in [("tangential_stiffness", tangential), ("normal_stiffness", normal)] {
                let relative = stiffness * side / shear;
                if stiffness.is_finite() && !RATIO.contains(&relative) {
                    let what = format!(
                        "`{key}` = {} times the cell's side is {} of the layer's shear modulus",
                        float(stiffness),
                        short(relative)
                    );
                    let help = match (key, relative < 1.0) {
                        ("tangential_stiffness", true) => {
                            "such a spring carries nothing: write interface = \"frictionless\""
                        }
                        (_, true) => "such a spring carries no pressure; between 1e-12 and 1e12 is allowed",
                        _ => "such a spring is rigid: leave the key out",
                    };
                    return Err(refuse("interface", what, help));
                }
            }
        }
    }
    Ok(())
}

/// Refuses profiles that rise too much or too little within the cell.
pub(in crate::case) fn profiles(levels: &[Level], sections: &[TableAt<'_>], cell: Cell) -> Result<(), Refusal> {
    let reach = cell.reduced().longer_side();
    for (level, section) in levels.iter().zip(sections) {
        let rise = level.shape().profile(reach);
        if !CARRIED.contains(&rise) {
            let what =
                format!("at the distance {} of the cell's side the profile rises by {}", float(reach), float(rise));
            return Err(Refusal::new(section.span, format!("`{}`: {what}", section.path("shape")), "this level")
                .help("between 1e-60 and 1e60 is carried by double precision; choose other units"));
        }
    }
    Ok(())
}

/// Refuses grids whose spacings along the cell vectors differ by more than a factor [`DENSER`], and a refinement without a grid.
pub(in crate::case) fn grid(
    grid: Sampling,
    file: Option<[usize; 2]>,
    section: &TableAt<'_>,
    lattice: &TableAt<'_>,
    cell: Cell,
) -> Result<(), Refusal> {
    let Sampling::Points([n1, n2]) = grid else {
        let refuse = |error| Refusal::new(lattice.span, format!("`grid.accuracy`: {error}"), "this cell");
        return grid.grids(&cell).map(drop).map_err(refuse);
    };
    let [a1, a2] = cell.vectors().map(|[x, y]| x.hypot(y));
    let (first, second) = (a1 / n1 as f64, a2 / n2 as f64);
    if first.max(second) <= DENSER * first.min(second) {
        return Ok(());
    }
    let points = section.optional("points");
    let span = points.map_or(lattice.span, |value| value.node.span);
    let what = format!("samples stand {} apart along a₁ and {} along a₂", short(first), short(second));
    let advice = match file {
        Some(_) => "give each vector its own points = [n1, n2], others than the file's",
        None => "give each vector its own points = [n1, n2]",
    };
    Err(Refusal::new(span, format!("`grid.points`: {what}"), format!("{n1} × {n2} points"))
        .help(format!("at most a factor of 1000 is allowed between them: {advice}")))
}

fn short(x: f64) -> String {
    format!("{x:.1e}")
}
