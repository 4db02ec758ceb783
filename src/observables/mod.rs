//! What a tribologist reads off a solved contact, level by level and between the samples.
//!
//! A sample belongs to the indenter whose surface is nearest to it. Contacts of neighbouring indenters that touch have **merged**: loads and
//! peak pressures still belong to levels, a radius has lost its meaning.

pub mod area;
pub mod boundary;
pub mod peak;

pub use boundary::Boundary;

use crate::field;
use crate::grid::Grid;
use crate::hierarchy::Solution;
use crate::texture::{Owner, Texture};
use boundary::Polar;
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
}

/// Scalars of one level. Where a level has several indenters in the cell, loads and areas are means over them, the others extremes.
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
    /// Contact area of one indenter.
    pub contact_area: f64,
    /// √(area/π), a length; `None` for merged contacts.
    pub contact_radius: Option<f64>,
    /// Smallest and largest distance of the boundary from the axis; `None` for merged contacts and for spots of too few samples.
    pub radius_extremes: Option<(f64, f64)>,
    /// Whether the contact of an indenter of this level touches that of a neighbour.
    pub merged: bool,
    /// Samples along the contact radius: below some ten the radii are rough.
    pub resolution: f64,
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
    samples: Vec<Polar>,
    peak: Option<usize>,
    merged: bool,
    boundary: Option<Boundary>,
}

/// Observables of a solved step.
pub fn observe(grid: &Grid, texture: &Texture, solution: &Solution) -> Observables {
    let pressure = &solution.pressure;
    let [total] = field::sums(grid.len(), |i| [pressure[i]]);
    let mean_pressure = total / grid.len() as f64;
    let highest = (0..grid.len()).max_by(|&a, &b| pressure[a].total_cmp(&pressure[b]));
    let max_pressure = highest.map_or(0.0, |index| peak::interpolated(grid, pressure, index));
    let spots = spots(grid, texture, pressure);
    let simple = !spots.is_empty() && spots.iter().all(|spot| spot.samples.is_empty() || spot.boundary.is_some());
    let contact_fraction = if simple {
        spots.iter().map(|spot| spot.area(grid)).sum::<f64>() / grid.cell().area()
    } else {
        area::contact_fraction(grid, pressure)
    };
    // Merged spots share the area between the samples in proportion to their samples.
    let counted = spots.iter().map(|spot| spot.samples.len()).sum::<usize>() as f64 * grid.sample_area();
    let correction = if simple || counted == 0.0 { 1.0 } else { contact_fraction * grid.cell().area() / counted };
    let whole = mean_pressure * grid.cell().area();
    let count = texture.sites.iter().map(|site| site.level).max().unwrap_or(0);
    let levels = (1..=count)
        .map(|level| {
            let own: Vec<&Spot> =
                texture.sites.iter().zip(&spots).filter(|(site, _)| site.level == level).map(|(_, s)| s).collect();
            let indenters = own.len() as f64;
            let load = own.iter().map(|spot| spot.load).sum::<f64>();
            let contact_area = own
                .iter()
                .map(|spot| if spot.boundary.is_some() { spot.area(grid) } else { correction * spot.area(grid) })
                .sum::<f64>()
                / indenters;
            let merged = own.iter().any(|spot| spot.merged);
            let extremes = own.iter().map(|spot| spot.boundary.as_ref().map(Boundary::extremes));
            LevelObservables {
                level,
                load: load / indenters,
                load_share: if whole > 0.0 { load / whole } else { 0.0 },
                max_pressure: own
                    .iter()
                    .filter_map(|spot| spot.peak)
                    .map(|index| peak::interpolated(grid, pressure, index))
                    .fold(0.0, f64::max),
                contact_area,
                contact_radius: (!merged).then(|| (contact_area / PI).sqrt()),
                radius_extremes: extremes.reduce(|a, b| a.zip(b).map(|(a, b)| (a.0.min(b.0), a.1.max(b.1)))).flatten(),
                merged,
                resolution: (contact_area / PI / grid.sample_area()).sqrt(),
            }
        })
        .collect();
    Observables { mean_pressure, penetration: solution.penetration, contact_fraction, max_pressure, levels }
}

/// Boundary of each site's contact around its axis, where it has one; sites in the texture's order.
pub fn boundaries(grid: &Grid, texture: &Texture, pressure: &[f64]) -> Vec<Option<Boundary>> {
    spots(grid, texture, pressure).into_iter().map(|spot| spot.boundary).collect()
}

fn spots(grid: &Grid, texture: &Texture, pressure: &[f64]) -> Vec<Spot> {
    let mut spots = vec![Spot::default(); texture.sites.len()];
    let [n1, n2] = grid.points();
    // The owner of a neighbouring sample, seen from this side of the cell's border.
    let owner = |i: usize, j: usize| {
        let Owner { site, image: [m1, m2] } = texture.owner[(i % n1) * n2 + j % n2];
        (pressure[(i % n1) * n2 + j % n2] > 0.0, site, [m1 + (i / n1) as i8, m2 + (j / n2) as i8])
    };
    for (index, owned) in texture.owner.iter().enumerate() {
        let p = pressure[index];
        if p <= 0.0 {
            continue;
        }
        let spot = &mut spots[owned.site as usize];
        let [s, t] = grid.fractions(index);
        let place = texture.sites[owned.site as usize].place;
        let [x, y] =
            grid.cell().point([s - place[0] - f64::from(owned.image[0]), t - place[1] - f64::from(owned.image[1])]);
        spot.load += p * grid.sample_area();
        spot.samples.push(Polar { r: x.hypot(y), theta: y.atan2(x), p });
        if spot.peak.is_none_or(|peak| p > pressure[peak]) {
            spot.peak = Some(index);
        }
        let (i, j) = (index / n2, index % n2);
        for neighbour in [owner(i + 1, j), owner(i, j + 1)] {
            let (touching, site, image) = neighbour;
            if touching && (site, image) != (owned.site, owned.image) {
                spots[owned.site as usize].merged = true;
                spots[site as usize].merged = true;
            }
        }
    }
    for spot in &mut spots {
        if !spot.merged {
            spot.boundary = Boundary::locate(&spot.samples, grid.sample_area(), grid.spacing());
        }
    }
    spots
}

impl Spot {
    fn area(&self, grid: &Grid) -> f64 {
        self.boundary.as_ref().map_or(self.samples.len() as f64 * grid.sample_area(), Boundary::area)
    }
}

impl fmt::Display for Observables {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "mean pressure {:.6e}, penetration {:.6e}, contact fraction {:.5}",
            self.mean_pressure, self.penetration, self.contact_fraction
        )?;
        for level in &self.levels {
            write!(
                f,
                "\nlevel {}: load {:.6e} ({:.3} %), peak pressure {:.6e}, contact area {:.6e}{}",
                level.level,
                level.load,
                100.0 * level.load_share,
                level.max_pressure,
                level.contact_area,
                if level.merged { ", merged with a neighbour" } else { "" }
            )?;
        }
        Ok(())
    }
}
