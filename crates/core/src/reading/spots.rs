//! The contact spots under indenters: their loads and areas, whether they have merged, their holes and boundaries.

use super::boundary::{Boundary, ContactSamples, PolarSpot, Sample};
use super::holes::Holes;
use crate::lattice::components::Component;
use crate::lattice::runs::SampleRun;
use crate::numeric::parallel;
use crate::spectral::Contact;
use rayon::prelude::*;
use std::ops::Range;

/// Contact spot of one site.
#[derive(Debug, Clone, Default)]
pub struct SpotReading {
    /// Force on the indenter, a pressure times an area.
    pub load: f64,
    /// Σ p **x** times the area of a sample, **x** from the axis.
    pub moment: [f64; 2],
    /// Area of the samples in contact, a length squared; one that several sites own together counts in equal parts.
    pub counted: f64,
    /// Flat index of the sample with the largest pressure; `None` without contact.
    pub peak: Option<usize>,
    /// Whether the contact touches that of a neighbour, or an image of itself.
    pub merged: bool,
    /// Whether it encloses open samples.
    pub ring: bool,
    /// Boundary between the samples, where it is located.
    pub boundary: Option<Boundary>,
    /// Distance of the farthest sample in contact from the axis, a length.
    farthest: f64,
}

/// Samples in contact that follow each other and face one image of one site.
#[derive(Debug, Clone)]
struct Part {
    component: u32,
    site: u32,
    /// Place of the axis of the image, lengths; beyond the borders of the cell where the component is.
    axis: [f64; 2],
    /// Number of samples.
    count: usize,
    /// Σ p.
    load: f64,
    /// Σ p **x**, **x** from the axis.
    moment: [f64; 2],
    /// Flat index of the sample with the largest pressure.
    peak: usize,
    /// Distance of the farthest sample from the axis, a length.
    farthest: f64,
}

/// Runs of samples of one task.
const RUNS_PER_TASK: usize = 128;

/// Distance of two axes, in spacings, below which they are one.
const SAME_AXIS: f64 = 1e-6;

/// The contact spots of all sites, without their boundaries; empty for a topography.
pub fn spots(contact: &Contact, components: &[Component]) -> Vec<SpotReading> {
    let (grid, surface, pressure) = (contact.grid(), contact.surface(), contact.pressures());
    let mut spots = vec![SpotReading::default(); surface.sites().len()];
    if surface.owners().is_empty() {
        return spots;
    }
    let runs: Vec<(u32, SampleRun)> = (0..)
        .zip(components)
        .flat_map(|(number, component)| component.runs.iter().map(move |run| (number, *run)))
        .collect();
    let parts: Vec<Vec<Part>> = parallel::map_chunks(&runs, RUNS_PER_TASK, |runs| parts(contact, runs));
    let area = grid.sample_area();
    let mut first: Option<&Part> = None;
    for part in parts.iter().flatten() {
        let spot = &mut spots[part.site as usize];
        spot.load += area * part.load;
        spot.moment = [0, 1].map(|k| spot.moment[k] + area * part.moment[k]);
        spot.counted += area * part.count as f64;
        spot.farthest = spot.farthest.max(part.farthest);
        if spot.peak.is_none_or(|peak| is_higher(pressure, part.peak, peak)) {
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
    share_ties(contact, &mut spots);
    spots
}

/// Divides the samples that several sites face equally among these.
fn share_ties(contact: &Contact, spots: &mut [SpotReading]) {
    let (grid, surface, pressure) = (contact.grid(), contact.surface(), contact.pressures());
    let (reduced, area) = (grid.cell().reduced(), grid.sample_area());
    for (index, facing) in surface.ties().iter().filter(|(index, _)| pressure[*index] > 0.0) {
        let (owner, p, whole) = (surface.owners()[*index], pressure[*index], facing.len() as f64);
        for &site in facing {
            let spot = &mut spots[site as usize];
            let part = area * (1.0 / whole - f64::from(u8::from(site == owner)));
            let [x, y] = surface.offset(&reduced, site, *index);
            spot.load += part * p;
            spot.moment = [spot.moment[0] + part * p * x, spot.moment[1] + part * p * y];
            spot.counted += part;
            if spot.peak.is_none_or(|peak| is_higher(pressure, *index, peak)) {
                spot.peak = Some(*index);
            }
        }
    }
}

/// Whether the pressure of sample `a` is larger than that of `b`; of equal ones the first counts as larger.
fn is_higher(pressure: &[f64], a: usize, b: usize) -> bool {
    pressure[a] > pressure[b] || pressure[a] == pressure[b] && a < b
}

/// Whether two axes are different ones.
fn is_apart(a: [f64; 2], b: [f64; 2], spacing: f64) -> bool {
    (0..2).any(|k| (a[k] - b[k]).abs() > SAME_AXIS * spacing)
}

/// Parts of runs, each run with the number of its component.
fn parts(contact: &Contact, runs: &[(u32, SampleRun)]) -> Vec<Part> {
    let mut parts = Vec::new();
    runs.iter().for_each(|&(component, run)| add_parts(contact, component, run, &mut parts));
    parts
}

/// Adds the parts of a run, the first one to the last part so far where that faces the same image.
fn add_parts(contact: &Contact, component: u32, run: SampleRun, parts: &mut Vec<Part>) {
    let (grid, surface, pressure) = (contact.grid(), contact.surface(), contact.pressures());
    let (reduced, along, spacing) = (grid.cell().reduced(), grid.steps()[1], grid.spacing());
    let owners = surface.owners();
    let start = run.index(grid.points());
    let [place, _] = run.ends(grid);
    let mut from = 0;
    while from < run.len() {
        let site = owners[start + from];
        let mut to = owners[start + from..start + run.len()].iter().take_while(|owner| **owner == site).count() + from;
        let offset = |k: usize| surface.offset(&reduced, site, start + k);
        let axis = |k: usize| {
            let offset = offset(k);
            [0, 1].map(|c| place[c] + k as f64 * along[c] - offset[c])
        };
        let first_axis = axis(from);
        // The samples nearest to one image are a convex set: where both ends are, all between them are.
        if is_apart(first_axis, axis(to - 1), spacing) {
            to = (from + 1..to).find(|&k| is_apart(first_axis, axis(k), spacing)).unwrap_or(to);
        }
        let goes_on =
            |last: &Part| last.component == component && last.site == site && !is_apart(last.axis, first_axis, spacing);
        if !parts.last().is_some_and(goes_on) {
            let peak = start + from;
            let fresh =
                Part { component, site, axis: first_axis, count: 0, load: 0.0, moment: [0.0; 2], peak, farthest: 0.0 };
            parts.push(fresh);
        }
        let part = parts.last_mut().expect("there is a part to add to");
        part.add(pressure, start + from..start + to, offset(from), along);
        from = to;
    }
}

impl Part {
    /// Takes in the samples with these flat indices, the first one at the `offset` from the axis, neighbours one step `along`
    /// the row apart; lengths.
    fn add(&mut self, pressure: &[f64], samples: Range<usize>, offset: [f64; 2], along: [f64; 2]) {
        let (mut sum, mut lever) = (0.0, 0.0);
        for (k, &p) in pressure[samples.clone()].iter().enumerate() {
            sum += p;
            lever += k as f64 * p;
            if p > pressure[self.peak] {
                self.peak = samples.start + k;
            }
        }
        self.count += samples.len();
        self.load += sum;
        self.moment = [0, 1].map(|c| self.moment[c] + offset[c] * sum + along[c] * lever);
        let last = [0, 1].map(|c| offset[c] + (samples.len() - 1) as f64 * along[c]);
        self.farthest = [offset, last].iter().map(|[x, y]| x.hypot(*y)).fold(self.farthest, f64::max);
    }
}

/// Locates the holes and the boundaries of the spots that have not merged.
pub fn locate(contact: &Contact, samples: &ContactSamples<'_>, spots: &mut [SpotReading]) {
    let (grid, surface, pressure) = (contact.grid(), contact.surface(), contact.pressures());
    let owners = surface.owners();
    // Open samples between merged contacts lie outside each of them.
    let holes = Holes::of(grid, pressure, |index| Some(owners[index]).filter(|owner| !spots[*owner as usize].merged));
    spots.par_iter_mut().enumerate().for_each(|(site, spot)| {
        let site = site as u32;
        spot.ring = holes.has(site);
        if spot.merged || spot.peak.is_none() {
            return;
        }
        let what = |index: usize| match holes.around(index) {
            Some(around) if around == site => Sample::Hole,
            None if owners[index] == site && pressure[index] > 0.0 => Sample::Contact,
            None if owners[index] == site => Sample::Open,
            _ => Sample::Other,
        };
        let axis = grid.cell().point(surface.sites()[site as usize].place);
        spot.boundary = Boundary::locate(&PolarSpot::new(grid, axis, spot.farthest, &what), samples, spot.ring);
    });
}
