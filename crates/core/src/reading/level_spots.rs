//! The contact spots of the indenters of one level, and the reading of the level.

use super::boundary::Boundary;
use super::contact_area::ContactArea;
use super::spots::SpotReading;
use super::{LevelErrors, LevelReading, Uncertainty, peak};
use crate::numeric::sums;
use crate::spectral::Contact;
use std::f64::consts::PI;

/// The spots of the indenters of one level.
pub struct LevelSpots<'a> {
    contact: &'a Contact,
    /// Level, from 1.
    level: usize,
    spots: Vec<&'a SpotReading>,
    /// Boundaries of all spots; `None` where one of them has none.
    boundaries: Option<Vec<&'a Boundary>>,
}

impl<'a> LevelSpots<'a> {
    /// The spots of a `level` (from 1) among those of all sites.
    pub fn new(contact: &'a Contact, level: usize, all: &'a [SpotReading]) -> Self {
        let sites = contact.surface().sites().iter().zip(all);
        let spots: Vec<&SpotReading> = sites.filter(|(site, _)| site.level == level).map(|(_, spot)| spot).collect();
        let boundaries = spots.iter().map(|spot| spot.boundary.as_ref()).collect();
        Self { contact, level, spots, boundaries }
    }

    /// The reading of the level under a mean pressure of contact over the cell, without estimated errors.
    pub fn reading(&self, area: &ContactArea, mean_pressure: f64) -> LevelReading {
        let (grid, indenters) = (self.contact.grid(), self.spots.len() as f64);
        let load = self.spots.iter().map(|spot| spot.load).sum::<f64>();
        let areas: Vec<[f64; 2]> = self.spots.iter().map(|spot| area.of_spot(spot)).collect();
        let [area, area_error] = [0, 1].map(|k| areas.iter().map(|spot_area| spot_area[k]).sum::<f64>() / indenters);
        let merged = self.spots.iter().any(|spot| spot.merged);
        let radius = (area / PI).sqrt();
        let resolution = (area / PI / grid.sample_area()).sqrt();
        let ring = !merged && self.spots.iter().any(|spot| spot.ring);
        let [inner, outer] = [self.mean(Boundary::mean_hole_radius), self.mean(Boundary::mean_radius)];
        let (radius_inner, radius_outer) = inner.zip(outer).filter(|_| ring).unzip();
        let moment = [0, 1].map(|k| self.spots.iter().map(|spot| spot.moment[k]).sum::<f64>());
        let radius_min = self.radii(|b| b.extremes().0).and_then(|radii| radii.into_iter().reduce(f64::min));
        let radius_max = self.largest(|b| b.extremes().1);
        let peak = if load > 0.0 { peak::net(self.contact, self.max_pressure()) } else { 0.0 };
        let (max_pressure, resolved_peak) = LevelReading::peak_of(peak, load > 0.0 && self.is_tip());
        LevelReading {
            level: self.level,
            load: (load - self.pull()) / indenters,
            load_share: if mean_pressure > 0.0 { load / (mean_pressure * grid.cell().area()) } else { 0.0 },
            max_pressure,
            resolved_peak,
            contact_area: area,
            contact_radius: (!merged).then_some(radius),
            ring,
            radius_inner,
            radius_outer,
            radius_min,
            radius_max,
            asymmetry: LevelReading::asymmetry_of(radius_min, radius_max),
            centre: (load > 0.0 && !merged).then(|| moment.map(|moment| moment / load)),
            merged,
            resolution,
            uncertainty: Uncertainty {
                peak_to_edge: self.peak_to_edge(resolution),
                area: area_error,
                radius: (!merged && area > 0.0).then(|| 0.5 * area_error / area * radius),
                hole: self.largest(|b| b.hole_error).filter(|_| ring),
                boundary: self.largest(|b| b.error),
            },
            errors: LevelErrors::default(),
        }
    }

    /// Tension on the samples that face the indenters, a force; 0 without adhesion.
    fn pull(&self) -> f64 {
        let (surface, area) = (self.contact.surface(), self.contact.grid().sample_area());
        let Some(tension) = self.contact.tensions() else { return 0.0 };
        let faces = |i: usize| surface.level_at(i) == self.level;
        area * sums::of(tension.len(), |i| if faces(i) { [tension[i]] } else { [0.0] })[0]
    }

    /// Largest pressure of contact that the grid resolves under the indenters, between the samples; in the unit of Young's modulus.
    fn max_pressure(&self) -> f64 {
        self.peaks().map(|index| peak::interpolated(self.contact, index)).fold(0.0, f64::max)
    }

    /// Samples between the peak pressure and the edge of contact, `farthest` at most; the least of all indenters.
    fn peak_to_edge(&self, farthest: f64) -> f64 {
        let (grid, pressure) = (self.contact.grid(), self.contact.pressures());
        self.peaks().map(|index| peak::samples_to_edge(grid, pressure, index, farthest)).fold(farthest, f64::min)
    }

    /// Flat indices of the samples with the largest pressure of each spot.
    fn peaks(&self) -> impl Iterator<Item = usize> {
        self.spots.iter().filter_map(|spot| spot.peak)
    }

    /// Whether the indenters have a tip, under which the pressure is infinite unless a surface yields.
    fn is_tip(&self) -> bool {
        if self.contact.hardness().is_finite() {
            return false;
        }
        let sites = self.contact.surface().sites().iter();
        sites.filter(|site| site.level == self.level).any(|site| site.shape.singular_peak())
    }

    /// A value of the boundaries of all indenters; `None` where a boundary is missing.
    fn radii(&self, value: fn(&Boundary) -> f64) -> Option<Vec<f64>> {
        Some(self.boundaries.as_ref()?.iter().map(|boundary| value(boundary)).collect())
    }

    /// Mean by area of a radius of the boundaries.
    fn mean(&self, radius: fn(&Boundary) -> f64) -> Option<f64> {
        let squares = self.radii(radius)?.into_iter().map(|r| r * r).sum::<f64>();
        Some((squares / self.spots.len() as f64).sqrt())
    }

    /// Largest value of the boundaries, at least 0.
    fn largest(&self, value: fn(&Boundary) -> f64) -> Option<f64> {
        Some(self.radii(value)?.into_iter().fold(0.0, f64::max))
    }
}
