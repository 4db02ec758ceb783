//! The contact spots of a grid: whose they are, whether they have merged, where they are open, and their boundaries.

use super::boundary::{Boundary, Sample, Scale, Spot};
use super::holes::Holes;
use crate::lattice::components::Component;
use crate::lattice::runs::SampleRun;
use crate::spectral::Contact;
use rayon::prelude::*;
use std::f64::consts::PI;

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
    /// Distance of its farthest sample from its axis.
    farthest: f64,
}

/// Samples in contact that follow each other and face one image of one site.
#[derive(Debug, Clone)]
struct Part {
    component: u32,
    site: u32,
    /// Where its axis stands, lengths; beyond the borders of the cell where the component is.
    axis: [f64; 2],
    /// Number of samples, Σ p, Σ p **x**.
    count: usize,
    load: f64,
    moment: [f64; 2],
    peak: usize,
    farthest: f64,
}

/// Runs that are taken together.
const TOGETHER: usize = 128;

/// The contacts of all sites, without their boundaries; none for a topography.
pub fn spots(contact: &Contact, components: &[Component]) -> Vec<SpotReading> {
    let (grid, surface, pressure) = (contact.grid(), contact.surface(), contact.pressures());
    let mut spots = vec![SpotReading::default(); surface.sites().len()];
    if surface.owners().is_empty() {
        return spots;
    }
    let runs: Vec<(u32, SampleRun)> =
        (0..).zip(components).flat_map(|(own, component)| component.runs.iter().map(move |run| (own, *run))).collect();
    let parts: Vec<Vec<Part>> = runs.par_chunks(TOGETHER).map(|runs| parts(contact, runs)).collect();
    let (area, higher) =
        (grid.sample_area(), |a: usize, b: usize| pressure[a] > pressure[b] || pressure[a] == pressure[b] && a < b);
    let mut first: Option<&Part> = None;
    for part in parts.iter().flatten() {
        let spot = &mut spots[part.site as usize];
        spot.load += area * part.load;
        spot.moment = [0, 1].map(|k| spot.moment[k] + area * part.moment[k]);
        spot.counted += area * part.count as f64;
        spot.farthest = spot.farthest.max(part.farthest);
        if spot.peak.is_none_or(|peak| higher(part.peak, peak)) {
            spot.peak = Some(part.peak);
        }
        // Contact that faces another indenter, or another image of this one: the contacts have merged.
        match first.filter(|first| first.component == part.component) {
            None => first = Some(part),
            Some(first) if first.site != part.site || is_apart(first.axis, part.axis, grid.spacing()) => {
                spots[first.site as usize].merged = true;
                spots[part.site as usize].merged = true;
            }
            Some(_) => {}
        }
    }
    // What several sites face belongs to all of them in equal parts.
    let reduced = grid.cell().reduced();
    for (index, facing) in surface.ties().iter().filter(|(index, _)| pressure[*index] > 0.0) {
        let (own, p, whole) = (surface.owners()[*index], pressure[*index], facing.len() as f64);
        for &site in facing {
            let spot = &mut spots[site as usize];
            let part = area * (1.0 / whole - f64::from(u8::from(site == own)));
            let [x, y] = surface.offset(&reduced, site, *index);
            spot.load += part * p;
            spot.moment = [spot.moment[0] + part * p * x, spot.moment[1] + part * p * y];
            spot.counted += part;
            if spot.peak.is_none_or(|peak| higher(*index, peak)) {
                spot.peak = Some(*index);
            }
        }
    }
    spots
}

fn is_apart(a: [f64; 2], b: [f64; 2], spacing: f64) -> bool {
    (0..2).any(|k| (a[k] - b[k]).abs() > 1e-6 * spacing)
}

/// The parts of runs, each of one component.
fn parts(contact: &Contact, runs: &[(u32, SampleRun)]) -> Vec<Part> {
    let (grid, surface, pressure) = (contact.grid(), contact.surface(), contact.pressures());
    let (points, reduced, along) = (grid.points(), grid.cell().reduced(), grid.steps()[1]);
    let owners = surface.owners();
    let mut parts: Vec<Part> = Vec::new();
    for &(component, run) in runs {
        let start = run.index(points);
        let [place, _] = run.ends(grid);
        let mut from = 0;
        while from < run.len() {
            let site = owners[start + from];
            let mut to = owners[start + from..start + run.len()].iter().take_while(|own| **own == site).count() + from;
            let offset = |k: usize| surface.offset(&reduced, site, start + k);
            let axis = |k: usize| {
                let offset = offset(k);
                [0, 1].map(|c| place[c] + k as f64 * along[c] - offset[c])
            };
            let own = axis(from);
            // Nearest to one image is a convex set: where both ends are, all between them is.
            if is_apart(own, axis(to - 1), grid.spacing()) {
                to = (from + 1..to).find(|&k| is_apart(own, axis(k), grid.spacing())).unwrap_or(to);
            }
            let is_last = |last: &&mut Part| {
                last.component == component && last.site == site && !is_apart(last.axis, own, grid.spacing())
            };
            let mut fresh = None;
            let part = match parts.last_mut().filter(is_last) {
                Some(part) => part,
                None => fresh.insert(Part {
                    component,
                    site,
                    axis: own,
                    count: 0,
                    load: 0.0,
                    moment: [0.0; 2],
                    peak: start + from,
                    farthest: 0.0,
                }),
            };
            let first = offset(from);
            let (mut sum, mut lever) = (0.0, 0.0);
            for (k, &p) in pressure[start + from..start + to].iter().enumerate() {
                sum += p;
                lever += k as f64 * p;
                if p > pressure[part.peak] {
                    part.peak = start + from + k;
                }
            }
            part.count += to - from;
            part.load += sum;
            part.moment = [0, 1].map(|c| part.moment[c] + first[c] * sum + along[c] * lever);
            let last = [0, 1].map(|c| first[c] + (to - from - 1) as f64 * along[c]);
            part.farthest = [first, last].iter().map(|[x, y]| x.hypot(*y)).fold(part.farthest, f64::max);
            parts.extend(fresh);
            from = to;
        }
    }
    parts
}

/// Finds the holes and the boundaries of the spots that stand alone.
pub fn locate(contact: &Contact, scale: &Scale<'_>, spots: &mut [SpotReading]) {
    let (grid, surface, pressure) = (contact.grid(), contact.surface(), contact.pressures());
    let owners = surface.owners();
    // Between merged contacts lies what is outside all of them.
    let holes = Holes::of(grid, pressure, |index| Some(owners[index]).filter(|own| !spots[*own as usize].merged));
    spots.par_iter_mut().enumerate().for_each(|(site, spot)| {
        let site = site as u32;
        spot.ring = holes.has(site);
        if spot.merged || spot.peak.is_none() {
            return;
        }
        let what = |index: usize| match (pressure[index] > 0.0, holes.around(index)) {
            (false, Some(around)) => {
                if around == site {
                    Sample::Hole
                } else {
                    Sample::Other
                }
            }
            (touches, _) if owners[index] == site => {
                if touches {
                    Sample::Contact
                } else {
                    Sample::Open
                }
            }
            _ => Sample::Other,
        };
        let axis = grid.cell().point(surface.sites()[site as usize].place);
        spot.boundary = Boundary::locate(&Spot::new(grid, axis, spot.farthest, &what), scale, spot.ring);
    });
}

/// Fewest samples along the radius of a topography's spot, as it is counted, from which on its boundary is fitted, and most
/// spots, the largest ones: the others are read along the lines of samples.
const FEWEST: f64 = 3.0;
pub const MOST: usize = 8;
/// Largest area of the circle around a spot over its own: that of an ellipse six times as long as wide.
const LONG: f64 = 6.0;

/// Label of a sample that belongs to no contact.
const NOBODY: u32 = u32::MAX;

/// Boundaries of a topography's contacts around their own centres, where these are simple; one for each component.
pub fn of_topography(contact: &Contact, components: &[Component], scale: &Scale<'_>) -> Vec<Option<Boundary>> {
    let (grid, pressure) = (contact.grid(), contact.pressures());
    let size = |own: &u32| components[*own as usize].size();
    let large = |own: &u32| !components[*own as usize].wraps && size(own) as f64 >= PI * FEWEST * FEWEST;
    let mut fitted: Vec<u32> = (0..components.len() as u32).filter(large).collect();
    fitted.sort_by_key(|own| std::cmp::Reverse(size(own)));
    // All of the same size as the last of them: which of these comes first depends on the vectors that describe the cell.
    let least = fitted.get(MOST - 1).map_or(0, size);
    fitted.retain(|own| size(own) >= least);
    let mut boundaries = vec![None; components.len()];
    if fitted.is_empty() {
        return boundaries;
    }
    let mut label = vec![NOBODY; grid.len()];
    for (own, component) in (0..).zip(components) {
        component.indices(grid).for_each(|run| label[run].fill(own));
    }
    let holes = Holes::of(grid, pressure, |index| Some(label[index]));
    let boundary = |&own: &u32| {
        let component = &components[own as usize];
        let centre = component.centre(grid);
        let farthest = component.farthest(grid, centre);
        if PI * farthest * farthest > LONG * component.size() as f64 * grid.sample_area() {
            return None;
        }
        let what = |index: usize| match (label[index], holes.around(index)) {
            (NOBODY, None) => Sample::Open,
            (NOBODY, Some(around)) => {
                if around == own {
                    Sample::Hole
                } else {
                    Sample::Other
                }
            }
            (label, _) => {
                if label == own {
                    Sample::Contact
                } else {
                    Sample::Other
                }
            }
        };
        let spot = Spot::new(grid, centre, farthest, &what);
        spot.stands_alone().then(|| Boundary::locate(&spot, scale, holes.has(own))).flatten()
    };
    let found: Vec<Option<Boundary>> = fitted.par_iter().map(boundary).collect();
    fitted.iter().zip(found).for_each(|(own, boundary)| boundaries[*own as usize] = boundary);
    boundaries
}
