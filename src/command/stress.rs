//! Stresses of a solved step, as a case asks for them.

use percoat::case::{Case, Cut, StressSection, Toward};
use percoat::hierarchy::Hierarchy;
use percoat::observables::Observables;
use percoat::output::{Section, Wanted};
use percoat::stress::{Field, Line};
use percoat::texture::Surface;

/// Rows and columns of a section.
const ROWS: usize = 200;
const COLUMNS: usize = 401;

/// Where the case wants stresses; `field` knows the interfaces.
pub fn wanted(case: &Case, section: &StressSection, field: &Field) -> Wanted {
    let both_sides = |z: &f64| field.depths(*z);
    let point = |&[x, y, z]: &[f64; 3]| field.depths(z).into_iter().map(move |depth| ([x, y], depth));
    Wanted {
        planes: section.planes.iter().flat_map(both_sides).collect(),
        section: section.section.and_then(|cut| {
            let depths = field.section_depths(cut.depth, ROWS);
            Some(Section { line: line(case, &cut)?, depths })
        }),
        points: section.points.iter().flat_map(point).collect(),
    }
}

/// The line of a cut: from the first indenter of a level toward another, or along a direction.
fn line(case: &Case, cut: &Cut) -> Option<Line> {
    let Surface::Indenters { lattice, .. } = case.surface() else { return None };
    let place = lattice.sites()[cut.from - 1][0];
    let direction = match cut.toward {
        Toward::Level(level) => lattice.toward(place, level),
        Toward::Direction(direction) => direction,
    };
    Some(Line { origin: lattice.cell().point(place), direction, span: [0.0, cut.length], points: COLUMNS })
}

/// Smallest and largest contact radius of a step, and the samples along the smallest; where contacts have no radius,
/// that of a disc of the whole contact's area, and a few samples.
pub fn contact_radii(hierarchy: &Hierarchy, observables: &Observables) -> ([f64; 2], f64) {
    let radii: Vec<f64> =
        observables.levels.iter().filter(|level| level.load > 0.0).filter_map(|level| level.contact_radius).collect();
    let grid = hierarchy.grid();
    let whole = (observables.contact_fraction * grid.cell().area() / std::f64::consts::PI).sqrt();
    let least = radii.iter().copied().fold(f64::INFINITY, f64::min).min(whole).max(4.0 * grid.spacing());
    let most = radii.iter().copied().fold(0.0, f64::max).max(if radii.is_empty() { whole } else { 0.0 });
    ([least, most.max(least)], least / grid.sample_area().sqrt())
}
