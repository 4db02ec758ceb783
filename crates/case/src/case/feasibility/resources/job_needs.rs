//! Memory and disk of each job: the larger of solving and drawing, and the files that it writes.

use super::constants::{
    ADHESION, AGAIN, CHECKPOINTS, COMPARED, COMPARISON, CREEP, CREEP_MODE, CURVES, CUTS, DAMAGE, DAMAGE_LINES, DEPTHS,
    FIELD, HEATED, KEPT, LAGS, MAPS, MOMENT, MOTION, PASSED, PICTURE, PLACES, PROGRAM, READING, SEARCH, SHOWN, SLIP,
    SLIP_FIELDS, SPOT_FIELDS, STATE, STEP, STRESS, STRESSES, TENSION, WORN,
};
use super::job::Needs;
use super::stress_needs::{of_series, of_shells, of_stress};
use crate::case::Case;
use percoat_core::body::HalfSpace;
use percoat_core::localized::Setup;
use percoat_core::reading::Criterion;
use percoat_core::run::places::{MOST_ROWS, SECTION};
use percoat_core::run::{EVENTS, Sampling};
use percoat_core::spectral::adhesive_widths;

/// Whether a surface has a hardness.
pub(super) fn yields(case: &Case) -> bool {
    case.problem().bodies().hardness().is_some()
}

pub(super) fn of_solving(
    case: &Case,
    samples: u64,
    [grids, working, heights]: [u64; 3],
    pictures: bool,
    fields: bool,
) -> Needs {
    let series = of_series(case, samples);
    let steps = case.step_count() as u64;
    let bodies = case.problem().bodies();
    let (stress, written, volume) = case.stress.as_ref().map_or((0, 0, 0), |stress| {
        let each = bodies.each().map(|half_space| {
            let (_, written, volume) = of_stress((stress, case.has_cut()), half_space, samples);
            (of_stress((stress, case.has_cut()), half_space, series).0, written, volume)
        });
        each.fold((0, 0, 0), |(a, b, c), (x, y, z)| (a + x, b + y, c + z))
    });
    let elastic = bodies.each().count() as u64;
    // Strengths and fatigue need the largest stresses, also where the case has no [stress].
    let stress = if Criterion::all(bodies).is_empty() && !bodies.tire() {
        stress
    } else {
        stress.max(elastic * STRESS * series)
    };
    let again = if stress > 0 && steps > 1 { elastic * AGAIN * series } else { 0 };
    let stress = if stress > 0 { STRESSES + stress + again + of_shells(case, series) } else { 0 };
    let sheets = if pictures { of_pictures(case) } else { 0 };
    let drawing = PROGRAM + KEPT * samples + heights + sheets;
    let summary = steps * 4096 * (1 + case.levels.len() as u64);
    let sticks = case.tangential.is_some();
    let tension = if case.adhesion.is_some() { TENSION } else { 0 };
    let depths = if yields(case) { DEPTHS } else { 0 } + if sticks { SLIP_FIELDS } else { 0 } + tension;
    let slip = of_slip(case, samples, series, stress > 0)
        + of_adhesion(case, samples)
        + of_creep(case, samples)
        + of_motion(case, samples, series, stress > 0);
    let (fields, written, volume) =
        if fields { (steps * (24 + depths) * samples + 20 * samples, written, volume) } else { (0, 0, 0) };
    let drawn = 3 + 2 * u64::from(case.has_cut()) + u64::from(steps > 1) + u64::from(sticks);
    let pages = if pictures { PICTURE * drawn } else { 0 };
    let disk = fields + steps * (written + volume) + summary + pages;
    // A refinement keeps the steps of the last grid, a quarter, until those of the next are complete.
    let coarser = if matches!(case.grid, Sampling::Accuracy(_)) { disk / 4 } else { 0 };
    let disk_while_running = disk + fields.max(steps * written) + coarser + (CHECKPOINTS + 3 * depths) * samples;
    let solving = PROGRAM + grids + heights + slip + working.max(READING * samples).max(stress);
    Needs { memory: solving.max(drawing), disk, disk_while_running }
}

/// Partial slip, and the steps of a cycle in which something tires under the stresses that are computed; nothing where the counterbody slides.
fn of_slip(case: &Case, samples: u64, series: u64, stressed: bool) -> u64 {
    if case.tangential.is_none() {
        return 0;
    }
    let bodies = case.problem().bodies();
    let tires = stressed && (bodies.tire() || bodies.have_endurance());
    SLIP * samples + if tires { case.step_count() as u64 * MOMENT * series } else { 0 }
}

/// States of surfaces that adhere; nothing of others.
fn of_adhesion(case: &Case, samples: u64) -> u64 {
    let is_isolated = case.problem().kind().is_indentation();
    let torus = if is_isolated { adhesive_widths(&case.problem().cell()).iter().product::<usize>() as u64 } else { 1 };
    if case.adhesion.is_some() { ADHESION * torus * samples } else { 0 }
}

/// Bodies that creep: the history of the pressure on all grids, with two modes or so for each term that relaxes; nothing without times.
fn of_creep(case: &Case, samples: u64) -> u64 {
    if case.time.is_none() {
        return 0;
    }
    let materials = case.problem().bodies().each().flat_map(HalfSpace::materials);
    let terms: usize = materials.filter_map(|material| material.relaxation()).map(|series| series.terms().len()).sum();
    (CREEP + CREEP_MODE * (2 * terms as u64 + 1)) * samples
}

/// A load that moves over a body that relaxes: its splitting, and the waves inside the body; nothing at rest.
fn of_motion(case: &Case, samples: u64, series: u64, stressed: bool) -> u64 {
    if case.motion.is_none() {
        return 0;
    }
    let inside = PASSED * case.half_space().material_count() as u64 + LAGS;
    let heated: usize = match case.problem().heating() {
        Some(heating) if heating.expands() => case.problem().bodies().each().map(HalfSpace::material_count).sum(),
        _ => 0,
    };
    MOTION * samples + if stressed { (inside + HEATED * heated as u64) * series } else { 0 }
}

/// Steps that stay in memory, without files.
pub(super) fn of_keeping(case: &Case, samples: u64, grids: [u64; 3]) -> Needs {
    let solving = of_solving(case, samples, grids, false, false).memory;
    let kept = case.step_count() as u64 * STEP + PLACES;
    Needs { memory: solving + kept * samples, disk: 0, disk_while_running: 0 }
}

/// A life: the contact before the first pass stays in memory while later ones are solved with their stresses.
pub(super) fn of_life(case: &Case, samples: u64, [grids, working, heights]: [u64; 3], pictures: bool) -> Needs {
    let series = of_series(case, samples);
    let elastic = case.problem().bodies().each().count() as u64;
    let stress = elastic * (STRESS + SEARCH) * series + of_shells(case, series);
    let tire =
        case.problem().half_space().durabilities().filter(|durability| durability.fatigue.is_some()).count() as u64;
    let damage = DAMAGE.map(|bytes| bytes * tire * DAMAGE_LINES.min(samples));
    let contact = working.max(READING * samples).max(stress);
    // The way back has a contact and stresses of its own.
    let back = case.life.is_some_and(|life| life.stroke.is_some());
    let back = if back { grids + STEP * samples + stress } else { 0 };
    // The contact of each stage of wear in place is solved beside the cycle.
    let stages = if case.tangential.is_some() { grids } else { 0 };
    let slip = stages + of_slip(case, samples, series, true);
    let solving = PROGRAM + grids + heights + (STEP + WORN) * samples + damage[0] + contact + back + slip;
    let drawing = if pictures { PROGRAM + KEPT * samples + heights + CUTS + CURVES } else { 0 };
    let disk = COMPARISON + WORN * samples + damage[1] + if pictures { 2 * PICTURE } else { 0 };
    Needs { memory: solving.max(drawing), disk, disk_while_running: 2 * disk }
}

/// A search for limit loads: the solver, and the stresses of one load at a time.
pub(super) fn of_limits(case: &Case, samples: u64, [grids, working, heights]: [u64; 3], pictures: bool) -> Needs {
    let drawing = if pictures { PROGRAM + KEPT * samples + heights + CUTS + CURVES } else { 0 };
    let elastic = case.problem().bodies().each().count() as u64;
    let series = of_series(case, samples);
    let of_bodies = elastic * (STRESS * series + STATE * (MOST_ROWS * SECTION[1]) as u64);
    // The steps that are shown stay in memory while those at higher limits are solved.
    let shown = Criterion::all(case.problem().bodies()).len().clamp(1, EVENTS) as u64 - 1;
    let stress = of_bodies + SEARCH * series + of_shells(case, series) + shown * SHOWN * samples;
    let slip =
        of_slip(case, samples, series, true) + of_adhesion(case, samples) + of_motion(case, samples, series, true);
    let solving = PROGRAM + grids + heights + slip + working.max(READING * samples).max(stress);
    let disk = COMPARISON + if pictures { (1 + EVENTS as u64) * PICTURE } else { 0 };
    Needs { memory: solving.max(drawing), disk, disk_while_running: disk }
}

/// The localized method's influence coefficients: of every pair of indenters, inside circles and of the whole lattice,
/// on the mesh and on one of half as many elements; its spots; and a field for the stresses compared.
pub(super) fn of_comparing(case: &Case, samples: u64, solver: u64, pictures: bool) -> Needs {
    let sites = case.problem().indenters().map_or(0, |all| all.lattice().sites().concat().len() as u64);
    let width = Setup::width(case.localized.elements) as u64;
    let side = 2 * width - 1;
    let tables = 8 * (sites * sites * side * side * 5 / 2 + SPOT_FIELDS * sites * width * width);
    let disk = COMPARISON + if pictures { PICTURE } else { 0 };
    let drawing = if pictures { PROGRAM + COMPARED + FIELD * samples } else { 0 };
    let comparing = PROGRAM + COMPARISON + solver + FIELD * samples + tables;
    Needs { memory: comparing.max(drawing), disk, disk_while_running: disk }
}

/// A search for parameters, in which the nodes of a curve that are solved at once take so many bytes.
pub(super) fn of_identifying(solving: u64, pictures: bool) -> Needs {
    let disk = COMPARISON + if pictures { PICTURE } else { 0 };
    let drawing = if pictures { PROGRAM + CURVES } else { 0 };
    Needs { memory: (PROGRAM + solving).max(drawing), disk, disk_while_running: disk }
}

fn of_pictures(case: &Case) -> u64 {
    let curves = if case.step_count() > 1 { CURVES } else { 0 };
    MAPS + curves + if case.has_cut() { CUTS } else { 0 }
}
