//! Stresses of a solved step, as a case asks for them.

use percoat::case::{Case, Cut, StressSection, Toward};
use percoat::hierarchy::Hierarchy;
use percoat::observables::Observables;
use percoat::output::summary::{Step, Stress};
use percoat::output::{Section, Volume, Wanted};
use percoat::stress::{Field, Line};
use percoat::texture::Surface;
use std::f64::consts::PI;

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
        volume: section.volume.map(|volume| Volume {
            depths: field.section_depths(volume.depth, volume.rows),
            points: [volume.points; 2],
        }),
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

/// The largest stresses of a step that has contact.
pub fn largest(field: &Field, hierarchy: &Hierarchy, observables: &Observables) -> Stress {
    let radii = contact_radii(hierarchy, observables);
    let coarser = hierarchy.coarser().next().map(|contact| field.under(contact.grid, contact.pressure).maxima(radii));
    Stress::new(&field.maxima(radii), coarser.as_ref(), tip(hierarchy, observables, field))
}

/// Where τ₁ is infinite: at a tip in contact, unless the surface material is incompressible, as σ_z and σ_r are then
/// infinite alike.
fn tip(hierarchy: &Hierarchy, observables: &Observables, field: &Field) -> Option<[f64; 2]> {
    let level = observables.levels.iter().find(|level| level.singular_peak)?.level;
    let site = hierarchy.texture().sites.iter().find(|site| site.level == level && field.surface_poisson() < 0.5)?;
    Some(hierarchy.grid().cell().point(site.place))
}

/// Smallest and largest contact radius of a step; where contacts have no radius, that of a disc of the whole contact's
/// area. The smallest is taken to have four samples at least.
fn contact_radii(hierarchy: &Hierarchy, observables: &Observables) -> [f64; 2] {
    let grid = hierarchy.grid();
    let whole = (observables.contact_fraction * grid.cell().area() / PI).sqrt();
    let touching = observables.levels.iter().filter(|level| level.load > 0.0);
    let radii: Vec<f64> = touching.filter_map(|level| level.contact_radius).collect();
    let least = radii.iter().copied().fold(whole, f64::min).max(4.0 * grid.spacing());
    let most = if radii.is_empty() { whole } else { radii.iter().copied().fold(0.0, f64::max) };
    [least, most.max(least)]
}

/// Largest change of the largest τ₁ and tension between the load steps on two grids, over the larger of both; 0 without
/// stresses. What is infinite under a tip is left out.
pub fn stress_change(coarse: &[Step], fine: &[Step]) -> f64 {
    let change = |(coarse, fine): (&Step, &Step)| {
        let (Some(coarse), Some(fine)) = (&coarse.stress, &fine.stress) else { return 0.0 };
        let pairs = [(&coarse.max_tau1, &fine.max_tau1), (&coarse.max_tension, &fine.max_tension)];
        let finite: Vec<(f64, f64)> = pairs.into_iter().filter_map(|(a, b)| a.value.zip(b.value)).collect();
        let scale = finite.iter().map(|(_, fine)| fine.abs()).fold(0.0, f64::max);
        let largest = finite.iter().map(|(coarse, fine)| (fine - coarse).abs()).fold(0.0, f64::max);
        if scale > 0.0 { largest / scale } else { 0.0 }
    };
    coarse.iter().zip(fine).map(change).fold(0.0, f64::max)
}
