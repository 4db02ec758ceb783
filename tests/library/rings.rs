//! Contacts that are open in the middle: `cases/ring.toml`, read in every way.
//!
//! The two methods share neither kernel nor reading; the same heights as a topography have no axis to be read around.

#![cfg(feature = "cli")]

use crate::common;

use common::solve;
use ndarray::Array2;
use percoat::case::{Case, embedded};
use percoat::localized::{CircleRadius, Localized, Setup, Stop};
use percoat::{Cell, Grid, Indenters, Lattice, LevelReading, Load, Problem, Reading, Topography};

const LOAD: Load = Load::MeanPressure(0.01);

fn case() -> Case {
    Case::read(&embedded::source("ring").unwrap(), &[]).unwrap()
}

fn read(problem: &Problem, points: usize) -> Reading {
    read_at(LOAD, problem, [points; 2])
}

fn read_at(load: Load, problem: &Problem, points: [usize; 2]) -> Reading {
    let (step, reading) = solve(problem, points, load);
    assert!(step.report.stop.solved(), "{}", step.report);
    reading
}

/// Inner and outer radius of a ring.
fn radii(level: &LevelReading) -> Option<(f64, f64)> {
    level.radius_inner.zip(level.radius_outer)
}

/// 17, 25 and 50 samples to the outer radius, 4 to 12 across the ring: radii within a tenth of a spacing, areas within
/// what they say.
#[test]
fn both_radii_of_a_ring_and_its_area_are_read() {
    let case = case();
    let fine = read(case.problem(), 512);
    let [exact] = &fine.levels[..] else { panic!("one level") };
    let (inner, outer) = radii(exact).expect("a ring");
    assert!(exact.ring && !exact.merged);
    // The disc that it was once taken for.
    assert!(inner > 0.7 * outer && fine.contact_spots == 1);
    for points in [88, 128, 256] {
        let reading = read(case.problem(), points);
        let found = &reading.levels[0];
        let (own_inner, own_outer) = radii(found).expect("a ring");
        println!("{points}: {own_inner} {own_outer}, area {} ± {}", found.contact_area, found.uncertainty.area);
        let spacing = 1.0 / points as f64;
        assert!((own_inner - inner).abs() < 0.1 * spacing && (own_outer - outer).abs() < 0.1 * spacing);
        assert!((found.contact_area - exact.contact_area).abs() < found.uncertainty.area);
        assert!(reading.to_string().contains("a ring"), "{reading}");
    }
}

/// The indenters' own heights on `points` samples.
fn sampled(problem: &Problem, points: [usize; 2]) -> Problem {
    let indenters = problem.indenters().expect("indenters");
    let (cell, levels) = (problem.cell(), indenters.levels());
    let grid = Grid::new(cell, points).unwrap();
    let reduced = cell.reduced();
    let height = |(i, j): (usize, usize)| {
        let [s, t] = grid.fractions(i * points[1] + j);
        let of = |level: usize, site: &[f64; 2]| {
            let [x, y] = reduced.nearest([s - site[0], t - site[1]]);
            levels[level].height() - levels[level].shape().profile(x.hypot(y))
        };
        let sites = indenters.lattice().sites().iter().enumerate();
        sites.flat_map(|(level, sites)| sites.iter().map(move |site| of(level, site))).fold(f64::NEG_INFINITY, f64::max)
    };
    let topography = Topography::new(cell, Array2::from_shape_fn(points, height)).unwrap();
    Problem::new(topography, problem.half_space().clone())
}

/// Area to what both say.
#[test]
fn a_ring_of_a_topography_has_the_area_of_that_of_the_indenter() {
    let case = case();
    let (indenter, topography) = (read(case.problem(), 192), read(&sampled(case.problem(), [192; 2]), 192));
    assert!(indenter.levels[0].ring && topography.levels.is_empty());
    let errors = indenter.contact_fraction_uncertainty + topography.contact_fraction_uncertainty;
    let difference = (indenter.contact_fraction.unwrap() - topography.contact_fraction.unwrap()).abs();
    println!("{indenter}\n{} ± {errors}", topography.contact_fraction.unwrap());
    assert!(difference < errors && difference < 2e-3 * indenter.contact_fraction.unwrap());
}

/// Both stand far enough apart not to break the ring open: its hole is its own, and the disc has none.
#[test]
fn a_topography_with_a_disc_beside_a_ring_has_the_area_of_both() {
    let case = case();
    let cell = Cell::new([1.0, 0.0], [0.0, 3.0]).unwrap();
    let lattice = Lattice::new(cell, vec![vec![[0.5, 0.25]], vec![[0.5, 0.75]]]).unwrap();
    let levels = vec![case.problem().levels()[0].clone(), common::paraboloid(0.5, -0.005)];
    let beside = Problem::new(Indenters::new(lattice, levels).unwrap(), case.half_space().clone());
    let load = Load::MeanPressure(0.005);
    let indenters = read_at(load, &beside, [160, 480]);
    let topography = read_at(load, &sampled(&beside, [160, 480]), [160, 480]);
    println!("{indenters}\n{topography}");
    let [ring, disc] = &indenters.levels[..] else { panic!("two levels") };
    assert!(ring.ring && !disc.ring && disc.load > 0.0, "{indenters}");
    assert_eq!((indenters.contact_spots, topography.contact_spots), (2, 2));
    let errors = indenters.contact_fraction_uncertainty + topography.contact_fraction_uncertainty;
    let difference = (indenters.contact_fraction.unwrap() - topography.contact_fraction.unwrap()).abs();
    assert!(difference < errors && difference < 2e-3 * indenters.contact_fraction.unwrap(), "{difference} {errors}");
}

/// Two methods, two kernels, two readings: each edge to a tenth of an element.
#[test]
fn the_localized_method_sees_the_ring_by_itself() {
    let case = case();
    let localized = Localized::new(case.problem(), 37).unwrap();
    let setup = Setup { indenters: 37, elements: 50, rule: CircleRadius::LoadBalanced, mutual_effect: true };
    let step = localized.solve(LOAD, &setup);
    assert_eq!(step.stop, Stop::Converged);
    let outline = step.spots[0].outline().expect("an outline");
    let (inner, outer) = radii(&read(case.problem(), 256).levels[0]).unwrap();
    let own_outer = step.spots[0].outer_radius();
    println!("{} {own_outer} against {inner} {outer}", outline.hole);
    let element = step.spots[0].mesh.size;
    assert!((outline.hole - inner).abs() < 0.1 * element, "{}", outline.hole);
    assert!((own_outer - outer).abs() < 0.1 * element, "{own_outer}");
}
