//! Estimated memory beside measured peaks, estimated disk beside sizes of written files, and the refusals of jobs by both.

use super::constants::MEBIBYTE;
use super::*;
use crate::case::embedded;
use percoat_common::machine::Capacity;
use percoat_core::numeric::fourier::fast_points;

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
