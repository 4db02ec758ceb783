//! Memory and files of the stresses of a case: series on the grid, coefficients inside the bodies, and the places that are written.

use super::constants::{COMPONENTS, PLANE, SHELLS, STATE, STRAINS, STRESS, SYMMETRIC, VTK_NUMBERS};
use crate::case::{Case, StressSection};
use percoat_core::body::{HalfSpace, InteriorTable};
use percoat_core::run::places::{MOST_ROWS, SECTION};
use percoat_core::stress::{bytes_far, series_times};
use std::f64::consts::PI;

/// Cells of the series of stresses over the cell of the contact: those around an isolated contact are twice as wide.
fn series_cells(case: &Case) -> u64 {
    (series_times(case.problem().cell()) as u64).pow(2)
}

/// Samples of the series of stresses.
pub(super) fn of_series(case: &Case, samples: u64) -> u64 {
    series_cells(case) * samples
}

/// Memory of a stress field, and bytes written a step: those that are gathered at the end, and a volume.
pub(super) fn of_stress(
    (stress, has_cut): (&StressSection, bool),
    half_space: &HalfSpace,
    samples: u64,
) -> (u64, u64, u64) {
    let sides = |z: &f64| half_space.depths(*z).len() as u64;
    let planes: u64 = stress.planes.iter().map(sides).sum();
    let section = if has_cut { (MOST_ROWS * SECTION[1]) as u64 } else { 0 };
    let volume = stress.volume.map_or(0, |volume| {
        let layer = (volume.points as u64 + 1) * (volume.points as u64 + 1);
        (volume.rows as u64 + 1 + half_space.layers().len() as u64) * layer
    });
    let stored = planes * samples + section + stress.points.len() as u64;
    let plane = if planes > 0 { PLANE } else { 0 };
    let memory = ((STRESS + plane) * samples + STATE * section).max(STATE * volume + 64 * samples);
    let components = COMPONENTS + if stress.strain { STRAINS } else { 0 };
    (memory, 8 * components * stored, 8 * VTK_NUMBERS * volume)
}

/// Amplitudes inside the body, kept from load to load, and coefficients of a stress field where few waves have the same
/// wavenumber: on cells without the symmetry of a square or a hexagon.
pub(super) fn of_shells(case: &Case, samples: u64) -> u64 {
    let (slides, cell) = (case.problem().friction().is_some(), case.problem().cell());
    let area = series_cells(case) as f64 * cell.area();
    let of_body = |half_space: &HalfSpace, together: f64| {
        // On the grid, and on the coarser one of the error estimate; a wave and its conjugate count once.
        let of_grid = |samples: u64| {
            let count = |most: f64| (0.5 * samples as f64).min(area * most * most / (8.0 * PI)) / together;
            InteriorTable::bytes(half_space, slides, |most| count(most) as usize) as u64
        };
        of_grid(samples) + of_grid(samples / 4)
    };
    let bodies = case.problem().bodies();
    let far: u64 = bodies.each().map(|body| bytes_far(cell, body, slides) as u64).sum();
    let kept = |together: f64| far + bodies.each().map(|body| of_body(body, together)).sum::<u64>();
    let [a1, a2] = case.problem().cell().vectors();
    let [first, second, product] = [(a1, a1), (a2, a2), (a1, a2)].map(|(u, v)| u[0] * v[0] + u[1] * v[1]);
    let is = |x: f64, y: f64| (x - y).abs() <= 1e-9 * first;
    if is(first, second) && (is(product, 0.0) || is(2.0 * product.abs(), first)) {
        return kept(SYMMETRIC);
    }
    SHELLS * samples * if slides { 2 } else { 1 } + kept(1.0)
}
