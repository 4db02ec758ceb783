//! The boundaries of the largest contact spots of a topography; the other spots are read along the lines of samples.

use super::boundary::constants::MIN_RESOLUTION;
use super::boundary::{Boundary, ContactSamples, PolarSpot, Sample};
use super::holes::{Holes, NO_CONTACT};
use crate::lattice::components::Component;
use crate::numeric::parallel;
use crate::spectral::Contact;
use std::cmp::Reverse;
use std::f64::consts::PI;

/// Number of spots whose boundaries are fitted, at most: the largest ones, and all as large as the smallest of these.
pub const LARGEST_SPOTS: usize = 8;
/// Largest area of the circle around a spot over the area of the spot: that of an ellipse six times as long as wide.
const LONGEST: f64 = 6.0;

/// Boundaries of the contact spots around their own centres, one for each component; `None` for small and long spots, for those
/// that reach around the cell, and for those without a simple boundary.
pub fn boundaries(contact: &Contact, components: &[Component], samples: &ContactSamples<'_>) -> Vec<Option<Boundary>> {
    let (grid, pressure) = (contact.grid(), contact.pressures());
    let mut boundaries = vec![None; components.len()];
    let fitted = largest(components);
    if fitted.is_empty() {
        return boundaries;
    }
    let mut label = vec![NO_CONTACT; grid.len()];
    for (number, component) in (0..).zip(components) {
        component.indices(grid).for_each(|run| label[run].fill(number));
    }
    let holes = Holes::of(grid, pressure, |index| Some(label[index]));
    let boundary = |&number: &u32| {
        let component = &components[number as usize];
        let centre = component.centre(grid);
        let farthest = component.farthest(grid, centre);
        if PI * farthest * farthest > LONGEST * component.size() as f64 * grid.sample_area() {
            return None;
        }
        let what = |index: usize| match holes.around(index) {
            Some(around) if around == number => Sample::Hole,
            None if label[index] == number => Sample::Contact,
            None if label[index] == NO_CONTACT => Sample::Open,
            _ => Sample::Other,
        };
        let spot = PolarSpot::new(grid, centre, farthest, &what);
        spot.stands_alone().then(|| Boundary::locate(&spot, samples, holes.has(number))).flatten()
    };
    let found: Vec<Option<Boundary>> = parallel::map_items(&fitted, boundary);
    fitted.iter().zip(found).for_each(|(number, boundary)| boundaries[*number as usize] = boundary);
    boundaries
}

/// Numbers of the components whose boundaries are fitted, the largest first.
fn largest(components: &[Component]) -> Vec<u32> {
    let size = |number: &u32| components[*number as usize].size();
    let large = |number: &u32| {
        !components[*number as usize].wraps && size(number) as f64 >= PI * MIN_RESOLUTION * MIN_RESOLUTION
    };
    let mut largest: Vec<u32> = (0..components.len() as u32).filter(large).collect();
    largest.sort_by_key(|number| Reverse(size(number)));
    // The order of spots of one size depends on the vectors that describe the cell: all of them count.
    let least = largest.get(LARGEST_SPOTS - 1).map_or(0, size);
    largest.retain(|number| size(number) >= least);
    largest
}
