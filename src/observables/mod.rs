//! What a tribologist reads off a solved contact, level by level and between the samples.
//!
//! A sample belongs to the indenter whose surface is nearest to it. Contacts of neighbouring indenters that touch have
//! **merged**: loads and peak pressures still belong to levels, a radius has lost its meaning. A contact that is open in
//! the middle is a **ring**: its area is that in contact. Radii and areas carry an estimate of their discretisation
//! error.

pub mod area;
pub mod error;
pub mod peak;
mod spots;

pub use crate::boundary::Boundary;
pub use error::{Errors, LevelErrors, errors};

use crate::boundary::Scale;
use crate::components;
use crate::edge::Edge;
use crate::field;
use crate::hierarchy::{Contact, Hierarchy, Solution};
use crate::number::number;
use spots::Spot;
use std::f64::consts::PI;
use std::fmt;

/// Scalars of one load step.
#[derive(Debug, Clone, PartialEq)]
pub struct Observables {
    /// Mean pressure p̄ over the cell.
    pub mean_pressure: f64,
    /// Penetration δ, a length.
    pub penetration: f64,
    /// Fraction of the cell in contact.
    pub contact_fraction: f64,
    /// Estimated error of the fraction in contact.
    pub contact_fraction_error: f64,
    /// Largest pressure, between the samples.
    pub max_pressure: f64,
    /// Number of contact spots in the cell; merged contacts are one.
    pub contact_spots: usize,
    /// Samples along the radius of a disc as large as the typical spot: the one up to which, from the smallest on, half
    /// of the load is carried. 0 without contact.
    pub spot_resolution: f64,
    /// Per level; empty for a topography.
    pub levels: Vec<LevelObservables>,
    /// Per site, the boundary of its contact; `None` without contact, for merged contacts and for spots of too few
    /// samples or no smooth boundary. Empty for a topography.
    pub boundaries: Vec<Option<Boundary>>,
}

/// Scalars of one level. Where a level has several indenters in the cell, loads and areas are means over them, the
/// others extremes.
#[derive(Debug, Clone, PartialEq)]
pub struct LevelObservables {
    /// Level, from 1.
    pub level: usize,
    /// Force on one indenter.
    pub load: f64,
    /// Share of the whole load that the level carries.
    pub load_share: f64,
    /// Peak pressure, between the samples.
    pub max_pressure: f64,
    /// Whether the peak pressure is infinite, see [`crate::indenter::Shape::singular_peak`]: `max_pressure` is then
    /// only what the grid resolves of it. Never for a level without load.
    pub singular_peak: bool,
    /// Contact area of one indenter.
    pub contact_area: f64,
    /// Estimated error of the contact area.
    pub contact_area_error: f64,
    /// √(area/π), a length; `None` for merged contacts.
    pub contact_radius: Option<f64>,
    /// Estimated error of the contact radius, a length.
    pub radius_error: Option<f64>,
    /// Whether the contact of an indenter of this level is open in the middle.
    pub ring: bool,
    /// Inner and outer radius of a ring: √(area/π) of the hole and of all inside the outer boundary, lengths. `None`
    /// without a hole, for merged contacts and for spots of too few samples or no smooth boundary.
    pub ring_radii: Option<(f64, f64)>,
    /// Estimated error of the inner one, a length; that of the outer one is `boundary_error`.
    pub hole_error: Option<f64>,
    /// Smallest and largest distance of the boundary from the axis; `None` for merged contacts and for spots of too few
    /// samples or no smooth boundary.
    pub radius_extremes: Option<(f64, f64)>,
    /// Estimated error of the distances of a boundary, a length.
    pub boundary_error: Option<f64>,
    /// Whether the contact of an indenter of this level touches that of a neighbour.
    pub merged: bool,
    /// Samples along the contact radius: below some ten the radii are rough.
    pub resolution: f64,
}

/// Fewest samples along a contact radius from which on radii and peak pressures are more than rough.
pub const FEW_SAMPLES: f64 = 10.0;

impl Observables {
    /// Whether the largest pressure is infinite: that of a level is.
    pub fn singular_peak(&self) -> bool {
        self.levels.iter().any(|level| level.singular_peak)
    }
}

impl LevelObservables {
    /// (largest − smallest)/largest boundary radius.
    pub fn asymmetry(&self) -> Option<f64> {
        self.radius_extremes.map(|(least, largest)| (largest - least) / largest)
    }
}

/// Observables of a solved step; `solution` is the last one of `hierarchy`, or one of the same grid.
pub fn observe(hierarchy: &Hierarchy, solution: &Solution) -> Observables {
    read(&hierarchy.contact(solution))
}

/// Observables of a solved grid.
pub fn read(contact: &Contact<'_>) -> Observables {
    let Contact { grid, texture, pressure, gap, penetration, .. } = *contact;
    let mean_pressure = field::mean(pressure);
    let highest = (0..grid.len()).max_by(|&a, &b| pressure[a].total_cmp(&pressure[b]));
    let max_pressure = highest.map_or(0.0, |index| peak::interpolated(grid, pressure, index));

    let most = grid.len() as f64;
    let [shortest, longest] = Scale::distances((most / PI).sqrt()).map(|distance| distance * grid.spacing());
    let edge = Edge::new(contact.transfer, shortest, longest);
    let scale = Scale { sample_area: grid.sample_area(), spacing: grid.spacing(), edge: &edge };
    let spots = spots::spots(contact, &scale);
    let (topography, located_samples) =
        if texture.owner.is_empty() { spots::of_topography(contact, &scale) } else { spots::samples(contact, &spots) };

    let cell = grid.cell().area();
    // Located spots have their own area. The others share what the lines of samples find there, as they were counted.
    let located = || spots.iter().filter_map(|spot| spot.boundary.as_ref()).chain(&topography);
    let along_lines = area::contact_fraction(grid, pressure, gap, |index| located_samples[index]);
    let located_area: f64 = located().map(Boundary::area).sum();
    let contact_area = located_area + cell * along_lines.fraction;
    let counted: f64 = spots.iter().filter(|spot| spot.boundary.is_none()).map(|spot| spot.counted).sum();
    let share = if counted > 0.0 { cell / counted } else { 0.0 };
    let spot_area = |spot: &Spot| match &spot.boundary {
        Some(boundary) => [boundary.area(), boundary.area_error()],
        None => [along_lines.fraction, along_lines.error].map(|part| part * share * spot.counted),
    };

    let levels = (1..=contact.levels)
        .map(|level| {
            let own: Vec<&Spot> =
                texture.sites.iter().zip(&spots).filter(|(site, _)| site.level == level).map(|(_, s)| s).collect();
            let indenters = own.len() as f64;
            let load = own.iter().map(|spot| spot.load).sum::<f64>();
            let [area, area_error] = [0, 1].map(|k| own.iter().map(|spot| spot_area(spot)[k]).sum::<f64>() / indenters);
            let merged = own.iter().any(|spot| spot.merged);
            let peaks = own.iter().filter_map(|spot| spot.peak);
            let boundaries = || own.iter().map(|spot| spot.boundary.as_ref());
            let extremes = boundaries().map(|boundary| boundary.map(Boundary::extremes));
            let radius = (area / PI).sqrt();
            let ring = !merged && own.iter().any(|spot| spot.ring);
            // Means over the indenters, by area.
            let mean = |radius: fn(&Boundary) -> f64| {
                let squares: Option<Vec<f64>> = boundaries().map(|b| b.map(|b| radius(b).powi(2))).collect();
                squares.map(|squares| (squares.iter().sum::<f64>() / indenters).sqrt())
            };
            // The largest of them.
            let most = |error: fn(&Boundary) -> f64| {
                let errors: Option<Vec<f64>> = boundaries().map(|b| b.map(error)).collect();
                errors.map(|errors| errors.into_iter().fold(0.0, f64::max))
            };
            LevelObservables {
                level,
                load: load / indenters,
                load_share: if mean_pressure > 0.0 { load / (mean_pressure * cell) } else { 0.0 },
                max_pressure: peaks.map(|index| peak::interpolated(grid, pressure, index)).fold(0.0, f64::max),
                singular_peak: load > 0.0
                    && texture.sites.iter().any(|site| site.level == level && site.shape.singular_peak()),
                contact_area: area,
                contact_area_error: area_error,
                contact_radius: (!merged).then_some(radius),
                radius_error: (!merged && area > 0.0).then(|| 0.5 * area_error / area * radius),
                ring,
                ring_radii: mean(Boundary::mean_hole_radius).zip(mean(Boundary::mean_radius)).filter(|_| ring),
                hole_error: most(|b| b.hole_error).filter(|_| ring),
                boundary_error: most(|b| b.error),
                radius_extremes: extremes.reduce(|a, b| a.zip(b).map(|(a, b)| (a.0.min(b.0), a.1.max(b.1)))).flatten(),
                merged,
                resolution: (area / PI / grid.sample_area()).sqrt(),
            }
        })
        .collect();
    let (contact_spots, spot_resolution) = components::spots(grid, pressure).unwrap_or_default();
    let contact_fraction = contact_area / cell;
    let contact_fraction_error = located().map(Boundary::area_error).sum::<f64>() / cell + along_lines.error;
    let boundaries = spots.into_iter().map(|spot| spot.boundary).collect();
    Observables {
        mean_pressure,
        penetration,
        contact_fraction,
        contact_fraction_error,
        max_pressure,
        contact_spots,
        spot_resolution,
        levels,
        boundaries,
    }
}

impl fmt::Display for Observables {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "mean pressure {}, penetration {}, contact fraction {}",
            number(self.mean_pressure),
            number(self.penetration),
            number(self.contact_fraction)
        )?;
        for level in &self.levels {
            write!(
                f,
                "\nlevel {}: load {} ({:.3} %), peak pressure {}, contact area {}{}",
                level.level,
                number(level.load),
                100.0 * level.load_share,
                number(level.max_pressure),
                number(level.contact_area),
                match (level.merged, level.ring) {
                    (true, _) => ", merged with a neighbour",
                    (false, true) => ", a ring",
                    (false, false) => "",
                }
            )?;
        }
        Ok(())
    }
}
