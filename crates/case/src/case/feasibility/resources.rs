//! Estimates of memory and disk of a case, and the largest grid that fits.
//!
//! The figures are peaks of the resident memory, measured from 64 to 1024 points with and without stresses, volumes and
//! pictures (`tests/command_line/refusals.rs` measures two of them again). An estimate lies above the peak by some tenth:
//! below a quarter in all that were measured.

use crate::case::{Case, StressSection, identification};
use percoat_common::machine::{Capacity, Threads, bytes};
use percoat_core::body::{HalfSpace, InteriorTable};
use percoat_core::counterbody::Topography;
use percoat_core::friction::Friction;
use percoat_core::identification::MOST_NODES;
use percoat_core::localized::Setup;
use percoat_core::numeric::fourier::fast_points;
use percoat_core::reading::Criterion;
use percoat_core::run::places::{MOST_ROWS, SECTION};
use percoat_core::run::{EVENTS, Sampling};
use percoat_core::spectral::Memory;
use percoat_core::stress::{StrainState, bytes_far, series_times};
use std::f64::consts::PI;

const MEBIBYTE: u64 = 1 << 20;
/// The program before it solves anything, mostly its mapped code: of a build for tests, which is the largest.
const PROGRAM: u64 = 31 * MEBIBYTE / 2;
/// Bytes of each thread: its stack and what the allocator keeps for it.
const THREAD: u64 = MEBIBYTE / 2;
/// Per sample: reading a step, after the memory of solving it is freed.
const READING: u64 = 20;
/// Per sample, in place of [`READING`]: waves, their coefficients and the search for maxima, and the plane that is written.
const STRESS: u64 = 92;
const PLANE: u64 = 36;
/// Code and buffers of stresses.
const STRESSES: u64 = 2 * MEBIBYTE;
/// Per sample: memory of the stresses of earlier steps that the allocator keeps, in a path and in a search for a limit; and
/// coefficients of pressure and traction where no two waves share theirs.
const AGAIN: u64 = 72;
const SEARCH: u64 = 110;
const SHELLS: u64 = 50;
/// Mean number of waves of one wavenumber on square and hexagonal cells, conjugates not counted, at least.
const SYMMETRIC: f64 = 4.5;
/// Per sample: a stress field that is evaluated at single points only.
const FIELD: u64 = 18;
/// Fields of each spot that the localized method keeps.
const SPOT_FIELDS: u64 = 24;
/// Per sample: the solved problem while pictures are drawn.
const KEPT: u64 = 64;
/// Per point of a volume: the states of all its planes, kept until they are written.
const STATE: u64 = 72;
/// Numbers stored for a place of a stress field in `stress.npz`, those of strains, and numbers for a point of a VTK file.
const COMPONENTS: u64 = 12;
const STRAINS: u64 = StrainState::NAMES.len() as u64;
const VTK_NUMBERS: u64 = 16;
/// Sheets of paper as pixels, several at a time: maps and profiles, cuts, load curves.
const MAPS: u64 = 23 * MEBIBYTE;
const CUTS: u64 = 19 * MEBIBYTE;
const CURVES: u64 = 14 * MEBIBYTE;
const COMPARED: u64 = 16 * MEBIBYTE;
/// `compare.json` with many levels and circles.
const COMPARISON: u64 = MEBIBYTE;
/// Per sample: checkpoints, pressure and gap of all nested grids, twice while one replaces another.
const CHECKPOINTS: u64 = 43;
/// Per sample: a step that stays in memory, pressure and gap of all nested grids and the displacement.
const STEP: u64 = 31;
/// Per sample: a step at a limit that is shown, pressure and gap of its grids.
const SHOWN: u64 = 21;
/// Per sample: a step, its tangent, and problems at other values in its window.
const TANGENT: u64 = 84;
/// Per sample, with hardness: the surface before it is pressed in, depths and their readings; and depths in files.
const INDENTED: u64 = 48;
const DEPTHS: u64 = 8;
/// Per sample: depths worn off both surfaces, of a state and of the one before, and in a file.
const WORN: u64 = 64;
/// Per sample: its position and level.
const PLACES: u64 = 20;
/// A picture on disk, in both formats.
const PICTURE: u64 = 3 * MEBIBYTE / 10;

/// A computation on a case.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Job {
    /// `percoat solve`, with its pictures and fields or without.
    Solve {
        /// Whether pictures are drawn.
        pictures: bool,
        /// Whether fields are kept.
        fields: bool,
    },
    /// Solving into memory: every step keeps its fields and the data for its stresses.
    Keep,
    /// `percoat limit`, with its pictures or without.
    Limit {
        /// Whether pictures are drawn.
        pictures: bool,
    },
    /// `percoat life`, with its pictures or without.
    Life {
        /// Whether pictures are drawn.
        pictures: bool,
    },
    /// `percoat compare`, with its picture or without.
    Compare {
        /// Whether the picture is drawn.
        pictures: bool,
    },
    /// `percoat identify`, with its picture or without.
    Identify {
        /// Whether the picture is drawn.
        pictures: bool,
    },
}

/// Memory and disk that a job takes at most.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Needs {
    /// Peak of memory, bytes.
    pub memory: u64,
    /// Files of the finished result, bytes.
    pub disk: u64,
    /// Files while it runs, bytes at most: the entries of the steps and the archive that is made of them.
    pub disk_while_running: u64,
}

impl Needs {
    /// Whether memory and disk suffice.
    pub fn fit(&self, room: Capacity) -> bool {
        self.memory <= room.memory && self.disk_while_running <= room.disk
    }
}

/// Estimate for a job on `case` on a grid of `points`, with the threads of this process.
pub fn needs(case: &Case, points: [usize; 2], job: Job) -> Needs {
    with_threads(case, points, job, Threads::used())
}

/// Estimate for a job on a number of threads.
fn with_threads(case: &Case, points: [usize; 2], job: Job, threads: usize) -> Needs {
    let samples = points[0] as u64 * points[1] as u64;
    let heights = of_heights(case, samples);
    let coupled = case.problem().friction().is_some_and(Friction::couples);
    let cell = case.problem().cell();
    let Memory { kept, working } = Memory::of(cell, points, case.solver.method, coupled);
    // The baseline takes more memory, but less than reading a step.
    let indented = if yields(case) { INDENTED * samples } else { 0 };
    let (grids, working) = (kept as u64 + indented, working as u64);
    let needs = match job {
        Job::Solve { pictures, fields } => of_solving(case, samples, [grids, working, heights], pictures, fields),
        Job::Keep => of_keeping(case, samples, [grids, working, heights]),
        Job::Limit { pictures } => of_limits(case, samples, [grids, working, heights], pictures),
        Job::Life { pictures } => of_life(case, samples, [grids, working, heights], pictures),
        Job::Compare { pictures } => of_comparing(case, samples, grids + working + heights, pictures),
        Job::Identify { pictures } => {
            // Every thread has a node of the curve.
            let nodes = threads.min(MOST_NODES) as u64;
            of_identifying(nodes * (grids + working + TANGENT * samples), pictures)
        }
    };
    let memory = needs.memory + THREAD * threads as u64;
    Needs { memory: memory + memory / 10, ..needs }
}

/// Heights of a topography; where grids are refined, those of its file, with their waves on the way to another grid.
fn of_heights(case: &Case, samples: u64) -> u64 {
    let Some([n1, n2]) = case.problem().topography().map(Topography::points) else { return 0 };
    let resampled = if matches!(case.grid, Sampling::Accuracy(_)) { 32 * (n1 * n2) as u64 } else { 0 };
    8 * samples + resampled
}

/// Whether a surface has a hardness.
fn yields(case: &Case) -> bool {
    case.problem().bodies().hardness().is_some()
}

/// Cells of the series of stresses over the cell of the contact: those around an isolated contact are twice as wide.
fn series_cells(case: &Case) -> u64 {
    (series_times(case.problem().cell()) as u64).pow(2)
}

/// Samples of the series of stresses.
fn of_series(case: &Case, samples: u64) -> u64 {
    series_cells(case) * samples
}

fn of_solving(case: &Case, samples: u64, [grids, working, heights]: [u64; 3], pictures: bool, fields: bool) -> Needs {
    let series = of_series(case, samples);
    let steps = case.load.values().len() as u64;
    let bodies = case.problem().bodies();
    let (stress, written, volume) = case.stress.as_ref().map_or((0, 0, 0), |stress| {
        let each = bodies.each().map(|half_space| {
            let (_, written, volume) = of_stress(stress, half_space, samples);
            (of_stress(stress, half_space, series).0, written, volume)
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
    let drawn = if pictures { of_pictures(case) } else { 0 };
    let drawing = PROGRAM + KEPT * samples + heights + drawn;
    let summary = steps * 4096 * (1 + case.levels.len() as u64);
    let depths = if yields(case) { DEPTHS } else { 0 };
    let (fields, written, volume) =
        if fields { (steps * (24 + depths) * samples + 20 * samples, written, volume) } else { (0, 0, 0) };
    let pages = if pictures { PICTURE * (3 + 2 * u64::from(has_cut(case)) + u64::from(steps > 1)) } else { 0 };
    let disk = fields + steps * (written + volume) + summary + pages;
    // A refinement keeps the steps of the last grid, a quarter, until those of the next are complete.
    let coarser = if matches!(case.grid, Sampling::Accuracy(_)) { disk / 4 } else { 0 };
    let disk_while_running = disk + fields.max(steps * written) + coarser + (CHECKPOINTS + 3 * depths) * samples;
    let solving = PROGRAM + grids + heights + working.max(READING * samples).max(stress);
    Needs { memory: solving.max(drawing), disk, disk_while_running }
}

/// Steps that stay in memory, without files.
fn of_keeping(case: &Case, samples: u64, grids: [u64; 3]) -> Needs {
    let solving = of_solving(case, samples, grids, false, false).memory;
    let kept = case.load.values().len() as u64 * STEP + PLACES;
    Needs { memory: solving + kept * samples, disk: 0, disk_while_running: 0 }
}

/// A line of the damage of a material: 2048 nodes in two states and as text; and as text alone.
const DAMAGE: [u64; 2] = [80 << 10, 40 << 10];
/// Most of these lines.
const DAMAGE_LINES: u64 = 512;

/// A life: the contact before the first pass stays in memory while later ones are solved with their stresses.
fn of_life(case: &Case, samples: u64, [grids, working, heights]: [u64; 3], pictures: bool) -> Needs {
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
    let solving = PROGRAM + grids + heights + (STEP + WORN) * samples + damage[0] + contact + back;
    let drawing = if pictures { PROGRAM + KEPT * samples + heights + CUTS + CURVES } else { 0 };
    let disk = COMPARISON + WORN * samples + damage[1] + if pictures { 2 * PICTURE } else { 0 };
    Needs { memory: solving.max(drawing), disk, disk_while_running: 2 * disk }
}

/// A search for limit loads: the solver, and the stresses of one load at a time.
fn of_limits(case: &Case, samples: u64, [grids, working, heights]: [u64; 3], pictures: bool) -> Needs {
    let drawing = if pictures { PROGRAM + KEPT * samples + heights + CUTS + CURVES } else { 0 };
    let elastic = case.problem().bodies().each().count() as u64;
    let series = of_series(case, samples);
    let of_bodies = elastic * (STRESS * series + STATE * (MOST_ROWS * SECTION[1]) as u64);
    // The steps that are shown stay in memory while those at higher limits are solved.
    let shown = Criterion::all(case.problem().bodies()).len().clamp(1, EVENTS) as u64 - 1;
    let stress = of_bodies + SEARCH * series + of_shells(case, series) + shown * SHOWN * samples;
    let solving = PROGRAM + grids + heights + working.max(READING * samples).max(stress);
    let disk = COMPARISON + if pictures { (1 + EVENTS as u64) * PICTURE } else { 0 };
    Needs { memory: solving.max(drawing), disk, disk_while_running: disk }
}

/// The localized method's influence coefficients: of every pair of indenters, inside circles and of the whole lattice,
/// on the mesh and on one of half as many elements; its spots; and a field for the stresses compared.
fn of_comparing(case: &Case, samples: u64, solver: u64, pictures: bool) -> Needs {
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
fn of_identifying(solving: u64, pictures: bool) -> Needs {
    let disk = COMPARISON + if pictures { PICTURE } else { 0 };
    let drawing = if pictures { PROGRAM + CURVES } else { 0 };
    Needs { memory: (PROGRAM + solving).max(drawing), disk, disk_while_running: disk }
}

/// Memory of a stress field, and bytes written a step: those that are gathered at the end, and a volume.
fn of_stress(stress: &StressSection, half_space: &HalfSpace, samples: u64) -> (u64, u64, u64) {
    let sides = |z: &f64| half_space.depths(*z).len() as u64;
    let planes: u64 = stress.planes.iter().map(sides).sum();
    let section = if stress.section.is_some() { (MOST_ROWS * SECTION[1]) as u64 } else { 0 };
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
fn of_shells(case: &Case, samples: u64) -> u64 {
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

fn of_pictures(case: &Case) -> u64 {
    let curves = if case.load.values().len() > 1 { CURVES } else { 0 };
    MAPS + curves + if has_cut(case) { CUTS } else { 0 }
}

fn has_cut(case: &Case) -> bool {
    case.stress.as_ref().is_some_and(|stress| stress.section.is_some())
}

/// The largest grid of the shape of `points` on which a job fits; `None` if none does.
pub fn largest_points(case: &Case, points: [usize; 2], room: Capacity, job: Job) -> Option<[usize; 2]> {
    let most = points[0].max(points[1]);
    let shaped =
        |n: usize| points.map(|count| fast_points((count as f64 * n as f64 / most as f64).round().max(4.0) as usize));
    let fits = |n: usize| needs(case, shaped(n), job).fit(room);
    // Needs grow with the grid.
    let (mut low, mut high) = (4, 32_768);
    if !fits(low) {
        return None;
    }
    while high - low > 1 {
        let middle = low + (high - low) / 2;
        if fits(middle) { low = middle } else { high = middle }
    }
    Some(shaped(low))
}

/// Why a job on `case` does not fit, and what would; `None` if it fits. Of a refinement the first grid is checked here, later ones
/// by [`Needs::fit`] when they are reached.
pub fn refusal(case: &Case, room: Capacity, job: Job) -> Option<String> {
    let key = if matches!(case.grid, Sampling::Accuracy(_)) { "grid.accuracy" } else { "grid.points" };
    let points = match (job, case.grid.grids(&case.problem().cell())) {
        (Job::Identify { .. }, _) => [identification::points(case); 2],
        (_, Ok(grids)) => grids[0],
        (_, Err(error)) => return Some(format!("{key}: {error}")),
    };
    let needs = needs(case, points, job);
    let what = if needs.memory > room.memory {
        format!("about {} of memory, and {} are available", bytes(needs.memory), bytes(room.memory))
    } else if needs.disk_while_running > room.disk {
        let (most, end) = (bytes(needs.disk_while_running), bytes(needs.disk));
        format!("about {most} of disk ({end} when done), and {} are free", bytes(room.disk))
    } else {
        return None;
    };
    let [n1, n2] = points;
    let advice = match largest_points(case, points, room, job) {
        Some([m1, m2]) if m1 * m2 < n1 * n2 => format!("the largest grid that fits is grid.points = [{m1}, {m2}]"),
        _ if matches!(job, Job::Compare { .. }) => "no grid fits: choose fewer localized.elements".to_owned(),
        _ if case.stress.as_ref().is_some_and(|stress| stress.volume.is_some()) => {
            "no grid fits: choose fewer rows or points in stress.volume".to_owned()
        }
        _ if needs.memory > room.memory => "no grid fits".to_owned(),
        _ => "no grid fits: choose fewer load steps, or another folder with -o".to_owned(),
    };
    Some(format!("{key}: {n1} × {n2} samples take {what}; {advice}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::embedded;

    const SOLVE: Job = Job::Solve { pictures: false, fields: true };

    fn case(overrides: &[&str]) -> Case {
        let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
        Case::read(&embedded::source("fig2").unwrap(), &overrides).unwrap_or_else(|error| panic!("{error}"))
    }

    /// The estimate for a job on two threads beside the peak of the resident memory in MiB, as `VmHWM` of /proc gave it for the build that
    /// the tests run; `None` where it lies above the peak by less than a quarter.
    fn wrong_estimate(name: String, case: &Case, points: usize, job: Job, peak: f64) -> Option<String> {
        let estimate = with_threads(case, [points; 2], job, 2).memory as f64 / MEBIBYTE as f64;
        let line = format!("{name}: {peak} MiB, estimate {estimate:.1} ({:.3})", estimate / peak);
        println!("{line}");
        (!(peak..=1.25 * peak).contains(&estimate)).then_some(line)
    }

    #[test]
    fn estimates_of_runs_lie_above_the_measured_peaks_by_less_than_a_quarter() {
        let mut wrong = Vec::new();
        let mut check = |points: usize, overrides: &[&str], pictures: bool, peak: f64| {
            let (case, job) = (case(overrides), Job::Solve { pictures, fields: true });
            wrong.extend(wrong_estimate(format!("{points} {overrides:?}"), &case, points, job, peak));
        };
        const CUT: &str = "stress={section={from=\"level 1\",toward=\"level 2\",length=1.0,depth=1.0}}";
        const AWRY: &str = "stress={section={from=\"level 1\",toward=[1.0,0.7312],length=1.0,depth=1.0}}";
        let measured: [(usize, &[&str], bool, f64); 16] = [
            (128, &[], false, 17.9),
            (256, &[], false, 21.4),
            (512, &[], false, 32.9),
            (1024, &[], false, 80.2),
            (256, &["stress={}"], false, 28.9),
            (512, &["stress={}"], false, 50.6),
            (512, &["stress={planes=[0,0.5]}"], false, 63.1),
            (1024, &["stress={planes=[0,0.5]}"], false, 175.9),
            (256, &["stress={volume={depth=1.0,rows=100,points=200}}"], false, 312.4),
            (256, &["solver.method=polonsky-keer"], false, 20.3),
            (64, &[], true, 42.6),
            (512, &[], true, 56.6),
            (1024, &[], true, 97.4),
            (512, &[CUT], true, 80.6),
            (512, &[AWRY], false, 53.4),
            (1024, &[AWRY], false, 146.6),
        ];
        for (points, overrides, pictures, peak) in measured {
            check(points, overrides, pictures, peak);
        }
        const SLIDING: &str = "friction={coefficient=0.4,direction=[1.0,0.3]}";
        const OBLIQUE: [&str; 3] = [
            "lattice={kind=\"oblique\",a1=[1.0,0.0],a2=[0.31,0.83]}",
            "levels=[{shape=\"paraboloid\",radius=0.8,height=0.0,sites=[[0.0,0.0]]}]",
            "stress={}",
        ];
        let [lattice, levels, stress] = OBLIQUE;
        let loads = "load.mean_pressure=[0.02,0.04,0.06]";
        let more: [(usize, &[&str], f64); 8] = [
            (512, &[SLIDING], 33.8),
            (1024, &[SLIDING], 85.5),
            (512, &[SLIDING, stress], 53.8),
            (1024, &[SLIDING, stress], 161.0),
            (512, &[stress, loads], 70.6),
            (1024, &[stress, loads], 241.9),
            (512, &[lattice, levels, stress], 62.7),
            (512, &[lattice, levels, stress, SLIDING], 71.2),
        ];
        for (points, overrides, peak) in more {
            check(points, overrides, false, peak);
        }
        assert!(wrong.is_empty(), "{wrong:#?}");
    }

    #[test]
    fn estimates_of_limits_and_comparisons_lie_above_the_measured_peaks_by_less_than_a_quarter() {
        let mut wrong = Vec::new();
        let coating = Case::read(&embedded::source("dlc-on-steel").unwrap(), &[]).unwrap();
        for (points, pictures, peak) in [(256, false, 39.3), (512, false, 97.4), (256, true, 57.5)] {
            let name = format!("limit {points}");
            wrong.extend(wrong_estimate(name, &coating, points, Job::Limit { pictures }, peak));
        }
        let compared: [(usize, &[&str], bool, f64); 6] = [
            (64, &["localized.elements=12"], true, 32.9),
            (128, &["localized.elements=12"], false, 18.9),
            (256, &["localized.elements=12"], true, 34.9),
            (512, &["localized.elements=12"], true, 42.0),
            (1024, &["localized.elements=12"], true, 89.5),
            (64, &["localized.elements=120", "layers=[]"], false, 48.0),
        ];
        for (points, overrides, pictures, peak) in compared {
            let name = format!("compare {points} {overrides:?}");
            wrong.extend(wrong_estimate(name, &case(overrides), points, Job::Compare { pictures }, peak));
        }
        assert!(wrong.is_empty(), "{wrong:#?}");
    }

    /// Windows are no finer than an identification needs, whatever grid the case has.
    #[test]
    fn an_identification_that_memory_does_not_hold_is_refused() {
        let job = Job::Identify { pictures: false };
        let ball = |overrides: &[&str]| {
            let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
            Case::read(&embedded::source("ball-on-disc").unwrap(), &overrides).unwrap()
        };
        let room = |memory: u64| Capacity { memory: memory * MEBIBYTE, disk: u64::MAX };
        for fine in ["grid.points=8192", "grid={accuracy=1e-3}"] {
            // A thread more takes less than a MiB more.
            assert_eq!(refusal(&ball(&[fine]), room(64 + Threads::used() as u64), job), None);
            let said = refusal(&ball(&[fine]), room(17), job).unwrap();
            assert!(said.contains("96 × 96 samples take about") && said.contains("17 MiB are available"), "{said}");
        }
        let said = refusal(&ball(&["grid.points=64"]), room(17), job).unwrap();
        assert!(said.starts_with("grid.points: 64 × 64 samples"), "{said}");
    }

    #[test]
    fn disk_is_that_of_the_files() {
        let of = |overrides: &[&str]| needs(&case(overrides), [512; 2], SOLVE).disk as f64;
        assert!((of(&[]) / 11_546_733.0 - 1.0).abs() < 0.01);
        assert!((of(&["stress={planes=[0,0.5]}"]) / 87_057_440.0 - 1.0).abs() < 0.01);
        assert!((of(&["stress={planes=[0,0.5],strain=true}"]) / 150_000_000.0 - 1.0).abs() < 0.01);
        let volume = needs(&case(&["stress={volume={depth=1.0,rows=100,points=200}}"]), [256; 2], SOLVE);
        assert!((volume.disk as f64 / 530_383_216.0 - 1.0).abs() < 0.02);
    }

    #[test]
    fn the_largest_grid_fits_and_the_next_does_not() {
        let (case, room) = (case(&[]), Capacity { memory: 500 * MEBIBYTE, disk: u64::MAX });
        for room in [room, Capacity { memory: u64::MAX, disk: 500 * MEBIBYTE }] {
            let points = largest_points(&case, [1024, 512], room, SOLVE).unwrap();
            // Each side is the next fast number of its share: at these sizes at most a twentieth above it.
            let ratio = points[0] as f64 / points[1] as f64;
            assert!((ratio / 2.0 - 1.0).abs() < 0.05, "{points:?}");
            assert_eq!(points.map(fast_points), points);
            assert!(needs(&case, points, SOLVE).fit(room));
            let larger = points.map(|n| fast_points(n + n / 20));
            assert!(!needs(&case, larger, SOLVE).fit(room), "{points:?} is not the largest");
        }
        assert_eq!(largest_points(&case, [64, 64], Capacity { memory: MEBIBYTE, ..room }, SOLVE), None);
    }

    #[test]
    fn steps_that_no_disk_holds_on_any_grid_are_said_to_be_too_many() {
        let many = case(&["grid.points=4", "load.mean_pressure={from=0.01,to=0.06,steps=1000}"]);
        let said = refusal(&many, Capacity { memory: 1000 * MEBIBYTE, disk: MEBIBYTE }, SOLVE).unwrap();
        assert!(said.contains("fewer load steps"), "{said}");
    }

    /// Three sites, 961 elements along a mesh: nine pairs of 1921² coefficients, two and a half times, and fields.
    #[test]
    fn a_comparison_takes_its_influence_coefficients_too() {
        let case = case(&["localized.elements=720", "grid.points=64"]);
        let room = Capacity { memory: 600 * MEBIBYTE, disk: u64::MAX };
        assert_eq!(refusal(&case, room, SOLVE), None);
        let said = refusal(&case, room, Job::Compare { pictures: false }).unwrap();
        let tables = 8.0 * (9.0 * 1921.0 * 1921.0 * 2.5 + 72.0 * 961.0 * 961.0);
        let stated = needs(&case, [64, 64], Job::Compare { pictures: false }).memory as f64;
        assert!((tables..1.25 * tables).contains(&stated), "{stated} for {tables}");
        assert!(said.contains("fewer localized.elements"), "{said}");
    }
}
