//! What a tribologist reads off a solved contact, level by level and between the samples.
//!
//! A sample belongs to the indenter whose surface is nearest to it. Contacts of neighbouring indenters that touch have
//! **merged**: loads and peak pressures still belong to levels, a radius has lost its meaning.

pub mod area;
pub mod error;
pub mod peak;

pub use crate::boundary::Boundary;
pub use error::{Errors, LevelErrors, errors};

use crate::boundary::Polar;
use crate::field;
use crate::hierarchy::{Contact, Hierarchy, Solution};
use crate::number::number;
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
    /// Largest pressure, between the samples.
    pub max_pressure: f64,
    /// Per level; empty for a topography.
    pub levels: Vec<LevelObservables>,
    /// Per site, the boundary of its contact; `None` without contact, for merged contacts and for spots of too few
    /// samples. Empty for a topography.
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
    /// √(area/π), a length; `None` for merged contacts.
    pub contact_radius: Option<f64>,
    /// Smallest and largest distance of the boundary from the axis; `None` for merged contacts and for spots of too few
    /// samples.
    pub radius_extremes: Option<(f64, f64)>,
    /// Whether the contact of an indenter of this level touches that of a neighbour.
    pub merged: bool,
    /// Samples along the contact radius: below some ten the radii are rough.
    pub resolution: f64,
}

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

/// Contact spot of one site.
#[derive(Debug, Clone, Default)]
struct Spot {
    load: f64,
    /// Area of its samples; one that several sites own together counts in parts.
    counted: f64,
    peak: Option<usize>,
    merged: bool,
    boundary: Option<Boundary>,
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

    let spots = spots(contact);
    let cell = grid.cell().area();
    // Located spots have their own area. The others share what the lines of samples find beside them, as they were
    // counted.
    let located: f64 = spots.iter().filter_map(|spot| spot.boundary.as_ref()).map(Boundary::area).sum();
    let counted: f64 = spots.iter().filter(|spot| spot.boundary.is_none()).map(|spot| spot.counted).sum();
    let all_located = !spots.is_empty() && counted == 0.0;
    let contact_area = if all_located { located } else { cell * area::contact_fraction(grid, pressure, gap) };
    let correction = if counted > 0.0 { ((contact_area - located) / counted).max(0.0) } else { 1.0 };
    let spot_area = |spot: &Spot| spot.boundary.as_ref().map_or(correction * spot.counted, Boundary::area);

    let levels = (1..=contact.levels)
        .map(|level| {
            let own: Vec<&Spot> =
                texture.sites.iter().zip(&spots).filter(|(site, _)| site.level == level).map(|(_, s)| s).collect();
            let indenters = own.len() as f64;
            let load = own.iter().map(|spot| spot.load).sum::<f64>();
            let area = own.iter().map(|spot| spot_area(spot)).sum::<f64>() / indenters;
            let merged = own.iter().any(|spot| spot.merged);
            let peaks = own.iter().filter_map(|spot| spot.peak);
            let extremes = own.iter().map(|spot| spot.boundary.as_ref().map(Boundary::extremes));
            LevelObservables {
                level,
                load: load / indenters,
                load_share: if mean_pressure > 0.0 { load / (mean_pressure * cell) } else { 0.0 },
                max_pressure: peaks.map(|index| peak::interpolated(grid, pressure, index)).fold(0.0, f64::max),
                singular_peak: load > 0.0
                    && texture.sites.iter().any(|site| site.level == level && site.shape.singular_peak()),
                contact_area: area,
                contact_radius: (!merged).then(|| (area / PI).sqrt()),
                radius_extremes: extremes.reduce(|a, b| a.zip(b).map(|(a, b)| (a.0.min(b.0), a.1.max(b.1)))).flatten(),
                merged,
                resolution: (area / PI / grid.sample_area()).sqrt(),
            }
        })
        .collect();
    let contact_fraction = contact_area / cell;
    let boundaries = spots.into_iter().map(|spot| spot.boundary).collect();
    Observables { mean_pressure, penetration, contact_fraction, max_pressure, levels, boundaries }
}

fn spots(contact: &Contact<'_>) -> Vec<Spot> {
    let Contact { grid, texture, pressure, .. } = *contact;
    let (reduced, [n1, n2]) = (grid.cell().reduced(), grid.points());
    let mut spots = vec![Spot::default(); texture.sites.len()];
    if texture.owner.is_empty() {
        return spots;
    }
    let offset = |index: usize| texture.offset(grid, &reduced, texture.owner[index], index);
    // The way to the next sample along a₁ and a₂, in a skewed cell by its shortest equivalent.
    let steps = [reduced.nearest([1.0 / n1 as f64, 0.0]), reduced.nearest([0.0, 1.0 / n2 as f64])];
    let tolerance = 1e-6 * grid.spacing();
    for (index, &p) in pressure.iter().enumerate().filter(|(_, p)| **p > 0.0) {
        let owner = texture.owner[index];
        let owners = match texture.ties.binary_search_by_key(&index, |(sample, _)| *sample) {
            Ok(tie) => &texture.ties[tie].1[..],
            Err(_) => std::slice::from_ref(&owner),
        };
        let part = grid.sample_area() / owners.len() as f64;
        for &site in owners {
            let spot = &mut spots[site as usize];
            spot.load += part * p;
            spot.counted += part;
            if spot.peak.is_none_or(|peak| p > pressure[peak]) {
                spot.peak = Some(index);
            }
        }
        // Neighbours in contact that face another indenter, or another image of this one: the contacts have merged.
        let (row, column) = (index / n2, index % n2);
        let neighbours = [(row + 1) % n1 * n2 + column, row * n2 + (column + 1) % n2];
        for (neighbour, step) in neighbours.into_iter().zip(steps) {
            if pressure[neighbour] <= 0.0 {
                continue;
            }
            let (here, there) = (offset(index), offset(neighbour));
            let apart = [0, 1].map(|k| (there[k] - here[k] - step[k]).abs());
            let other = texture.owner[neighbour];
            if other != owner || apart[0].max(apart[1]) > tolerance {
                spots[owner as usize].merged = true;
                spots[other as usize].merged = true;
            }
        }
    }
    locate(contact, &mut spots);
    spots
}

/// Finds the boundaries of the spots that stand alone.
fn locate(contact: &Contact<'_>, spots: &mut [Spot]) {
    let Contact { grid, texture, pressure, gap, .. } = *contact;
    let reduced = grid.cell().reduced();
    // Samples that a fit can reach: out to twice the counted radius.
    let reach: Vec<f64> = spots
        .iter()
        .map(|spot| if spot.merged || spot.counted == 0.0 { 0.0 } else { 2.0 * (spot.counted / PI).sqrt() })
        .collect();
    let mut samples: Vec<Vec<Polar>> = vec![Vec::new(); spots.len()];
    for (index, &owner) in texture.owner.iter().enumerate() {
        let reach = reach[owner as usize];
        if reach == 0.0 {
            continue;
        }
        let [x, y] = texture.offset(grid, &reduced, owner, index);
        let r = x.hypot(y);
        if r < reach || pressure[index] > 0.0 {
            let opening = 0.75 * contact.contact_modulus * gap[index];
            samples[owner as usize].push(Polar { r, theta: y.atan2(x), p: pressure[index], opening });
        }
    }
    for (spot, samples) in spots.iter_mut().zip(&samples) {
        if !samples.is_empty() {
            spot.boundary = Boundary::locate(samples, grid.sample_area(), grid.spacing());
        }
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
                if level.merged { ", merged with a neighbour" } else { "" }
            )?;
        }
        Ok(())
    }
}
