//! The contact spots of a grid: whose they are, whether they have merged, where they are open, and their boundaries.

use super::boundary::{Boundary, Polar, Scale};
use crate::lattice::Joined;
use crate::lattice::components::{Component, around, components};
use crate::spectral::Contact;
use rayon::prelude::*;
use std::f64::consts::PI;

/// Label of a sample that belongs to no contact, or to no contact's hole.
const NOBODY: u32 = u32::MAX;

/// Contact spot of one site.
#[derive(Debug, Clone, Default)]
pub struct SpotReading {
    pub load: f64,
    /// Σ p **x** over its area, **x** from its axis.
    pub moment: [f64; 2],
    /// Area of its samples; one that several sites own together counts in parts.
    pub counted: f64,
    pub peak: Option<usize>,
    pub merged: bool,
    /// Whether it encloses open samples.
    pub ring: bool,
    pub boundary: Option<Boundary>,
}

/// The contacts of all sites; none for a topography.
pub fn spots(contact: &Contact, scale: &Scale<'_>) -> Vec<SpotReading> {
    let (grid, surface, pressure) = (contact.grid(), contact.surface(), contact.pressures());
    let (reduced, [n1, n2]) = (grid.cell().reduced(), grid.points());
    let mut spots = vec![SpotReading::default(); surface.sites().len()];
    if surface.owners().is_empty() {
        return spots;
    }
    let offset = |index: usize| surface.offset(&reduced, surface.owners()[index], index);
    // The ways to the samples that are joined to one in contact.
    let ways = grid.ways(Joined::AtCorners);
    let steps: Vec<[f64; 2]> =
        ways.iter().map(|[i, j]| reduced.nearest([f64::from(*i) / n1 as f64, f64::from(*j) / n2 as f64])).collect();
    let tolerance = 1e-6 * grid.spacing();
    for (index, &p) in pressure.iter().enumerate().filter(|(_, p)| **p > 0.0) {
        let owner = surface.owners()[index];
        let owners = surface.facing(index);
        let part = grid.sample_area() / owners.len() as f64;
        for &site in owners {
            let spot = &mut spots[site as usize];
            spot.load += part * p;
            let [x, y] = surface.offset(&reduced, site, index);
            spot.moment = [spot.moment[0] + part * p * x, spot.moment[1] + part * p * y];
            spot.counted += part;
            if spot.peak.is_none_or(|peak| p > pressure[peak]) {
                spot.peak = Some(index);
            }
        }
        // Neighbours in contact that face another indenter, or another image of this one: the contacts have merged.
        for (&way, step) in ways.iter().zip(&steps) {
            let neighbour = grid.along(way, index);
            if pressure[neighbour] <= 0.0 {
                continue;
            }
            let (here, there) = (offset(index), offset(neighbour));
            let apart = [0, 1].map(|k| (there[k] - here[k] - step[k]).abs());
            let other = surface.owners()[neighbour];
            if other != owner || apart[0].max(apart[1]) > tolerance {
                spots[owner as usize].merged = true;
                spots[other as usize].merged = true;
            }
        }
    }
    locate(contact, scale, &mut spots);
    spots
}

/// Open samples that one contact encloses: `label` tells contacts apart.
fn holes(contact: &Contact, label: impl Fn(usize) -> u32) -> Vec<(u32, Component)> {
    let (grid, pressure) = (contact.grid(), contact.pressures());
    let ways = grid.ways(Joined::AtEdges);
    let enclosed = |open: Component| {
        let around = |index: usize| {
            let both = ways.iter().flat_map(|way| [*way, way.map(|k| -k)]);
            both.map(move |way| grid.along(way, index))
        };
        let mut beside = open.indices(grid).flat_map(around).filter(|&next| pressure[next] > 0.0);
        let owner = label(beside.next()?);
        let alone = beside.all(|index| label(index) == owner);
        drop(beside);
        alone.then_some((owner, open))
    };
    // What lies outside meets its own images, or several contacts.
    components(grid, Joined::AtEdges, |index| pressure[index] <= 0.0)
        .into_iter()
        .filter(|open| !open.wraps)
        .filter_map(enclosed)
        .collect()
}

/// Finds the holes and the boundaries of the spots that stand alone.
fn locate(contact: &Contact, scale: &Scale<'_>, spots: &mut [SpotReading]) {
    let (grid, surface) = (contact.grid(), contact.surface());
    let (pressure, gap) = (contact.pressures(), contact.gaps());
    let (reduced, [_, n2]) = (grid.cell().reduced(), grid.points());
    let modulus = contact.problem().half_space().surface_material().contact_modulus();
    // Whose a sample is: in a hole that of the contact around it.
    let mut owner = surface.owners().to_vec();
    let mut hole = vec![false; grid.len()];
    for (own, open) in holes(contact, |index| surface.owners()[index]) {
        let spot = &mut spots[own as usize];
        // Between merged contacts lies what is outside all of them.
        if !spot.merged {
            spot.ring = true;
            for index in open.indices(grid) {
                (owner[index], hole[index]) = (own, true);
            }
        }
    }
    // Samples that a fit can reach: out to twice the radius of all that is enclosed.
    let mut enclosed = vec![0.0; spots.len()];
    for (index, &own) in owner.iter().enumerate() {
        if pressure[index] > 0.0 || hole[index] {
            enclosed[own as usize] += grid.sample_area();
        }
    }
    let is_near = |index: usize| {
        let own = owner[index];
        let area = enclosed[own as usize];
        if spots[own as usize].merged || area == 0.0 {
            return false;
        }
        let [x, y] = surface.offset(&reduced, own, index);
        x * x + y * y < 4.0 * area / PI || pressure[index] > 0.0
    };
    let is_near: Vec<bool> = (0..grid.len()).into_par_iter().with_min_len(n2).map(is_near).collect();
    // Counted first, so that they take no more room than they need.
    let near = || (0..grid.len()).filter(|&index| is_near[index]);
    let mut counts = vec![0; spots.len()];
    near().for_each(|index| counts[owner[index] as usize] += 1);
    let mut samples: Vec<Vec<usize>> = counts.into_iter().map(Vec::with_capacity).collect();
    near().for_each(|index| samples[owner[index] as usize].push(index));
    let polar = |&index: &usize| {
        let offset = surface.offset(&reduced, owner[index], index);
        Polar::new(offset, pressure[index], 0.75 * modulus * gap[index], hole[index])
    };
    spots.par_iter_mut().zip(&samples).filter(|(_, samples)| !samples.is_empty()).for_each(|(spot, samples)| {
        let samples: Vec<Polar> = samples.par_iter().map(polar).collect();
        spot.boundary = Boundary::locate(&samples, scale);
    });
}

/// Boundaries of a topography's contacts around their own centres, where these are simple, and the samples of all that
/// have one.
pub fn of_topography(contact: &Contact, scale: &Scale<'_>) -> (Vec<Boundary>, Vec<bool>) {
    let (grid, pressure, gap) = (contact.grid(), contact.pressures(), contact.gaps());
    let modulus = contact.problem().half_space().surface_material().contact_modulus();
    let contacts = contact.touching();
    contact.spots(Some(&contacts));
    let mut label = vec![NOBODY; grid.len()];
    for (own, contact) in (0..).zip(&contacts) {
        contact.indices(grid).for_each(|index| label[index] = own);
    }
    let mut hole_of = vec![NOBODY; grid.len()];
    for (own, open) in holes(contact, |index| label[index]) {
        open.indices(grid).for_each(|index| hole_of[index] = own);
    }
    let boundary = |(own, spot): (usize, &Component)| {
        let own = own as u32;
        let centre = spot.centre(grid);
        // What is nobody's or its own, in contact and in holes.
        let ours = |whose: u32| whose == own || whose == NOBODY;
        let samples: Vec<Polar> = around(grid, centre, 2.0 * spot.farthest(grid, centre))
            .filter(|(index, _)| ours(label[*index]) && ours(hole_of[*index]))
            .map(|(index, offset)| {
                Polar::new(offset, pressure[index], 0.75 * modulus * gap[index], hole_of[index] == own)
            })
            .collect();
        Boundary::locate(&samples, scale)
    };
    let found: Vec<Option<Boundary>> =
        contacts.par_iter().enumerate().map(|each| (!each.1.wraps).then(|| boundary(each)).flatten()).collect();
    let mut located = vec![false; grid.len()];
    for (spot, _) in contacts.iter().zip(&found).filter(|(_, boundary)| boundary.is_some()) {
        spot.indices(grid).for_each(|index| located[index] = true);
    }
    (found.into_iter().flatten().collect(), located)
}
