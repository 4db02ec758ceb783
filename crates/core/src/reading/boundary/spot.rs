//! A contact spot on its grid, in polar coordinates about an axis.

use super::constants::WEIGHT_RISE;
use crate::lattice::runs::{SampleRun, annulus, samples};
use crate::lattice::{Grid, ReducedBasis};
use crate::numeric::parallel;
use crate::reading::edge::ContactEdge;
use std::f64::consts::PI;

/// Distance from the edge, in spacings, from which on samples enter the fits.
pub(super) const NEAREST: f64 = 0.3;

/// Runs of samples of one task.
const RUNS_PER_TASK: usize = 64;

/// Place of a sample in relation to a spot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sample {
    /// Sample of this spot, in contact.
    Contact,
    /// Open sample outside this spot and nearer to it than to others.
    Open,
    /// Open sample enclosed by this spot.
    Hole,
    /// Sample in or beside another spot.
    Other,
}

/// A contact spot and the samples around it.
pub struct PolarSpot<'a> {
    grid: &'a Grid,
    reduced: ReducedBasis,
    /// Half the length of the shortest lattice vector: a sample nearer than that to the axis is farther from all images of it.
    alone: f64,
    /// The axis, lengths.
    centre: [f64; 2],
    /// Distance of the farthest sample in contact from the axis, a length.
    farthest: f64,
    /// Place of a sample in relation to the spot, by its flat index.
    what: &'a (dyn Fn(usize) -> Sample + Sync),
}

impl<'a> PolarSpot<'a> {
    /// The spot around a `centre` (lengths), whose samples in contact are not farther from it than `farthest`, a length; `what`
    /// classifies a sample by its flat index.
    pub fn new(grid: &'a Grid, centre: [f64; 2], farthest: f64, what: &'a (dyn Fn(usize) -> Sample + Sync)) -> Self {
        let (cell, reduced) = (grid.cell(), grid.cell().reduced());
        let alone = cell.clear_radius().min(cell.border_distance(centre));
        Self { grid, reduced, alone, centre, farthest, what }
    }

    /// Whether no sample in contact is nearer to an image of the axis, or at the border of a window.
    pub fn stands_alone(&self) -> bool {
        self.farthest < self.alone
    }

    /// Distance of the farthest sample in contact from the axis, a length.
    pub fn farthest(&self) -> f64 {
        self.farthest
    }

    /// Place of a sample, given its `offset` from the axis (lengths): [`Sample::Other`] if an image of the axis is nearer, or
    /// outside of a window.
    fn what(&self, index: usize, offset: [f64; 2]) -> Sample {
        let [x, y] = offset;
        let is_far = x * x + y * y > self.alone * self.alone;
        if is_far && !self.grid.cell().belongs(&self.reduced, self.centre, offset, 1e-6 * self.alone) {
            return Sample::Other;
        }
        (self.what)(index)
    }

    /// Place of the sample nearest to a point at an `offset` from the axis (lengths).
    pub fn at(&self, offset: [f64; 2]) -> Sample {
        let [n1, n2] = self.grid.points();
        let place = [self.centre[0] + offset[0], self.centre[1] + offset[1]];
        let [s, t] = self.grid.cell().fractions(place);
        // Places halfway between samples, as directions along the axes of a symmetric contact have them, take the next sample:
        // rounding errors would make the choice differ between equal contacts.
        let nearest = |place: f64| (place + 1e-6).round() as i64;
        let (row, column) = (nearest(s * n1 as f64), nearest(t * n2 as f64));
        let index = row.rem_euclid(n1 as i64) as usize * n2 + column.rem_euclid(n2 as i64) as usize;
        self.what(index, offset)
    }

    /// Results of `take` over the samples at distances from the axis of at least the first and less than the second of two lengths,
    /// one for each task, in their order. `take` is given the flat index of a sample, its offset from the axis and where it lies.
    pub fn taken<T: Send + Sync + Default>(
        &self,
        distances: [f64; 2],
        take: impl Fn(&mut T, usize, [f64; 2], Sample) + Sync,
    ) -> Vec<T> {
        let runs = annulus(self.grid, self.centre, distances);
        let of_task = |runs: &[SampleRun]| {
            let mut taken = T::default();
            for (index, offset) in samples(self.grid, runs, self.centre) {
                take(&mut taken, index, offset, self.what(index, offset));
            }
            taken
        };
        parallel::map_chunks(&runs, RUNS_PER_TASK, of_task)
    }
}

/// The samples of a contact, their spacing, and the edge of its body.
#[derive(Debug, Clone, Copy)]
pub struct ContactSamples<'a> {
    /// Area of a sample, a length squared.
    pub sample_area: f64,
    /// Largest distance of neighbours, a length.
    pub spacing: f64,
    /// Pressure, sample by sample, in the unit of Young's modulus.
    pub pressure: &'a [f64],
    /// Gap, sample by sample, lengths.
    pub gap: &'a [f64],
    /// Contact modulus of the surface material, E* = E/(1 − ν²).
    pub modulus: f64,
    /// Pressure and gap at an edge on the half-space, at [`ContactSamples::distances`].
    pub edge: &'a ContactEdge,
    /// Whether errors of boundaries are estimated.
    pub errors: bool,
}

impl ContactSamples<'_> {
    /// The least and the largest distance from an edge of the samples that fits on a grid use, lengths.
    pub fn distances(grid: &Grid) -> [f64; 2] {
        let most = (grid.len() as f64 / PI).sqrt();
        [0.5 * NEAREST, WEIGHT_RISE + most.max(1.0).sqrt()].map(|distance| distance * grid.spacing())
    }

    /// Number of samples along a radius, a length.
    pub(super) fn resolution(&self, radius: f64) -> f64 {
        radius / self.sample_area.sqrt()
    }

    /// Largest distance from the edge of the samples that the fit of a boundary of `radius` uses, a length.
    pub(super) fn reach(&self, radius: f64) -> f64 {
        let resolution = self.resolution(radius);
        (WEIGHT_RISE + resolution.sqrt()).min(0.6 * resolution) * self.spacing
    }

    /// 3E*g/4 at a sample, by its flat index: a pressure times a length.
    pub(super) fn opening(&self, index: usize) -> f64 {
        0.75 * self.modulus * self.gap[index].max(0.0)
    }
}
