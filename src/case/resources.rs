//! Memory and disk that a case takes, and the largest grid that fits.
//!
//! The figures are peaks of the resident memory, measured from 64 to 1024 points with and without stresses, volumes and
//! pictures (`tests/command_line/refusals.rs` measures two of them again). An estimate lies above the peak by some tenth:
//! below a quarter in all that were measured.

use super::{Case, GridSection, StressSection};
use crate::fourier::fast_points;
use crate::hierarchy;
use crate::material::HalfSpace;
use crate::number::number;
use crate::refinement::{MOST_POINTS, balanced_points};

const MEBIBYTE: u64 = 1 << 20;
/// What the program takes before it solves anything.
const PROGRAM: u64 = 9 * MEBIBYTE;
/// Per sample: waves, shells, amplitudes and one plane of a stress field.
const STRESS: u64 = 168;
/// Per sample: what stays of a solved problem while pictures are drawn.
const KEPT: u64 = 137;
/// Per point of a volume: the states of all its planes, kept until they are written.
const STATE: u64 = 72;
/// Numbers stored for a place of a stress field in `stress.npz`, and for a point of a VTK file.
const COMPONENTS: u64 = 12;
const VTK_NUMBERS: u64 = 16;
/// Sheets of paper as pixels, several at a time: maps and profiles, cuts, load curves.
const MAPS: u64 = 90 * MEBIBYTE;
const CUTS: u64 = 46 * MEBIBYTE;
const CURVES: u64 = 84 * MEBIBYTE;
/// A picture on disk.
const PICTURE: u64 = MEBIBYTE / 5;
/// Rows and columns of a vertical section.
const SECTION: u64 = 200 * 401;

/// What a run takes at most.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Needs {
    /// Peak of the memory, bytes.
    pub memory: u64,
    /// Files of the finished result, bytes; while a run gathers its fields it takes twice as much.
    pub disk: u64,
}

/// What solving `case` on a grid of `points` takes, with its pictures or without.
pub fn needs(case: &Case, points: [usize; 2], pictures: bool) -> Needs {
    let [n1, n2] = points.map(|n| n as u64);
    let samples = n1 * n2;
    let steps = case.load.values().len() as u64;
    let (stress, written) = case.stress.as_ref().map_or((0, 0), |stress| of_stress(stress, case.half_space(), samples));
    let drawn = if pictures { of_pictures(case) } else { 0 };
    let heights = case.surface.as_ref().map_or(0, |_| 8 * samples);
    let solving = hierarchy::memory(points, case.solver.method) as u64 + stress + heights;
    let drawing = KEPT * samples + heights + drawn;
    let peak = PROGRAM + solving.max(drawing);
    let summary = steps * 4096 * (1 + case.levels.len() as u64);
    let fields = steps * 24 * samples + 20 * samples;
    let pages = if pictures { PICTURE * (3 + 2 * u64::from(has_cut(case)) + u64::from(steps > 1)) } else { 0 };
    Needs { memory: peak + peak / 10, disk: fields + steps * written + summary + pages }
}

/// Memory of a stress field, and bytes written a step.
fn of_stress(stress: &StressSection, half_space: &HalfSpace, samples: u64) -> (u64, u64) {
    let sides = |z: &f64| half_space.sides(*z).count() as u64;
    let planes: u64 = stress.planes.iter().map(sides).sum();
    let section = if stress.section.is_some() { SECTION } else { 0 };
    let volume = stress.volume.map_or(0, |volume| {
        let layer = (volume.points as u64 + 1) * (volume.points as u64 + 1);
        (volume.rows as u64 + 1 + half_space.layers().len() as u64) * layer
    });
    let stored = planes * samples + section + stress.points.len() as u64;
    let memory = (STRESS * samples).max(STATE * volume + 64 * samples) + STATE * section;
    (memory, 8 * (COMPONENTS * stored + VTK_NUMBERS * volume))
}

fn of_pictures(case: &Case) -> u64 {
    let curves = if case.load.values().len() > 1 { CURVES } else { 0 };
    MAPS + curves + if has_cut(case) { CUTS } else { 0 }
}

fn has_cut(case: &Case) -> bool {
    case.stress.as_ref().is_some_and(|stress| stress.section.is_some())
}

/// The largest grid of `case`, shaped like `points`, on which it takes at most `memory` bytes; `None` if none does.
pub fn largest_points(case: &Case, points: [usize; 2], memory: u64, pictures: bool) -> Option<[usize; 2]> {
    let most = points[0].max(points[1]);
    let shaped =
        |n: usize| points.map(|own| fast_points((own as f64 * n as f64 / most as f64).round().max(4.0) as usize));
    let fits = |n: usize| needs(case, shaped(n), pictures).memory <= memory;
    // Needs grow with the grid.
    let (mut low, mut high) = (4, 32_768);
    if !fits(low) {
        return None;
    }
    while high - low > 1 {
        let middle = low + (high - low) / 2;
        if fits(middle) { low = middle } else { high = middle }
    }
    Some(shaped(low)).filter(|&points| needs(case, points, pictures).memory <= memory)
}

/// The largest grid that `case` may be solved on: its own, or the last one of a refinement.
pub fn finest_points(case: &Case) -> [usize; 2] {
    match case.grid {
        GridSection::Points(points) => points,
        GridSection::Accuracy(_) => {
            let cell = case.surface().cell();
            let finer = |points: &usize| Some(2 * points);
            std::iter::successors(Some(crate::refinement::FIRST_POINTS), finer)
                .map(|points| balanced_points(&cell, points))
                .take_while(|points| points.iter().all(|&n| n <= MOST_POINTS))
                .last()
                .unwrap_or(balanced_points(&cell, crate::refinement::FIRST_POINTS))
        }
    }
}

/// Why `case` cannot be solved with the memory `available`, bytes, and what would fit; `None` if it can. A refinement
/// is held to its first grid: its later ones are bounded as they come ([`largest_points`]).
pub fn refusal(case: &Case, available: u64, pictures: bool) -> Option<String> {
    let (points, key) = match case.grid {
        GridSection::Points(points) => (points, "grid.points"),
        GridSection::Accuracy(_) => {
            (balanced_points(&case.surface().cell(), crate::refinement::FIRST_POINTS), "grid.accuracy")
        }
    };
    let Needs { memory, .. } = needs(case, points, pictures);
    if memory <= available {
        return None;
    }
    let [n1, n2] = points;
    let what =
        format!("{key}: {n1} × {n2} samples take about {}, and {} are available", bytes(memory), bytes(available));
    let advice = match largest_points(case, points, available, pictures) {
        _ if case.surface.is_some() => "resample the topography, or use a larger machine".to_owned(),
        Some([m1, m2]) if m1 * m2 < n1 * n2 => format!("the largest grid that fits is grid.points = [{m1}, {m2}]"),
        _ if case.stress.as_ref().is_some_and(|stress| stress.volume.is_some()) => {
            "no grid fits: ask for fewer rows or points in stress.volume".to_owned()
        }
        _ => "no grid fits".to_owned(),
    };
    Some(format!("{what}; {advice}"))
}

/// A size for a person: "132 MiB", "1.5 GiB".
pub fn bytes(size: u64) -> String {
    let mebibytes = size as f64 / MEBIBYTE as f64;
    match mebibytes {
        small if small < 9.95 => format!("{small:.1} MiB"),
        some if some < 10_000.0 => format!("{some:.0} MiB"),
        many if many < 1e7 => format!("{:.0} GiB", many / 1024.0),
        huge => format!("{} GiB", number(huge / 1024.0)),
    }
}

#[cfg(test)]
mod tests {
    use super::super::embedded;
    use super::*;

    fn case(overrides: &[&str]) -> Case {
        let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
        Case::read(&embedded::source("fig2").unwrap(), &overrides).unwrap_or_else(|error| panic!("{error}"))
    }

    /// Peaks of the resident memory in MiB, two threads, as `VmHWM` of /proc gave them.
    #[test]
    fn estimates_lie_above_the_measured_peaks_by_less_than_a_quarter() {
        const CUT: &str = "stress={section={from=\"level 1\",toward=\"level 2\",length=1.0,depth=1.0}}";
        let measured: [(usize, &[&str], bool, f64); 14] = [
            (128, &[], false, 11.8),
            (256, &[], false, 20.5),
            (512, &[], false, 55.4),
            (1024, &[], false, 189.4),
            (256, &["stress={}"], false, 31.7),
            (512, &["stress={}"], false, 97.4),
            (512, &["stress={planes=[0,0.5]}"], false, 97.6),
            (1024, &["stress={planes=[0,0.5]}"], false, 358.6),
            (256, &["stress={volume={depth=1.0,rows=100,points=200}}"], false, 310.8),
            (256, &["solver.method=polonsky-keer"], false, 17.1),
            (64, &[], true, 95.8),
            (512, &[], true, 132.2),
            (1024, &[], true, 242.3),
            (512, &[CUT], true, 193.8),
        ];
        for (points, overrides, pictures, peak) in measured {
            let estimate = needs(&case(overrides), [points; 2], pictures).memory as f64 / MEBIBYTE as f64;
            println!("{points} {overrides:?}: {peak} MiB, estimate {estimate:.1} ({:.3})", estimate / peak);
            assert!((peak..=1.25 * peak).contains(&estimate), "{points} {overrides:?}: {peak}, not {estimate:.1} MiB");
        }
    }

    #[test]
    fn disk_is_that_of_the_files() {
        let of = |overrides: &[&str]| needs(&case(overrides), [512; 2], false).disk as f64;
        assert!((of(&[]) / 11_546_733.0 - 1.0).abs() < 0.01);
        assert!((of(&["stress={planes=[0,0.5]}"]) / 87_057_440.0 - 1.0).abs() < 0.01);
        let volume = needs(&case(&["stress={volume={depth=1.0,rows=100,points=200}}"]), [256; 2], false);
        assert!((volume.disk as f64 / 530_383_216.0 - 1.0).abs() < 0.02);
    }

    #[test]
    fn the_largest_grid_fits_and_the_next_does_not() {
        let (case, memory) = (case(&[]), 500 * MEBIBYTE);
        let points = largest_points(&case, [1024, 512], memory, false).unwrap();
        assert_eq!(points[0], 2 * points[1]);
        assert!(needs(&case, points, false).memory <= memory);
        let larger = points.map(|n| fast_points(n + n / 20));
        assert!(needs(&case, larger, false).memory > memory, "{points:?} is not the largest");
        assert_eq!(largest_points(&case, [64, 64], MEBIBYTE, false), None);
    }

    #[test]
    fn a_refusal_names_what_is_needed_and_what_fits() {
        let case = case(&["grid.points=16384"]);
        let said = refusal(&case, 1000 * MEBIBYTE, true).unwrap();
        assert!(said.contains("16384 × 16384") && said.contains("1000 MiB are available"), "{said}");
        assert!(said.contains("the largest grid that fits is grid.points = ["), "{said}");
        assert_eq!(refusal(&case, 1 << 50, true), None);
    }
}
