//! Contacts that are open in the middle: `cases/ring.toml`, read in every way.
//!
//! The two methods share neither kernel nor reading; the same heights as a topography have no axis to be read around.

mod common;

use common::solve;
use percoat::case::{Case, embedded};
use percoat::grid::Grid;
use percoat::lattice::{Cell, Lattice};
use percoat::localized::{CircleRadius, Localized, Setup, Stop};
use percoat::observables::Observables;
use percoat::solver::Control;
use percoat::texture::Surface;

const LOAD: Control = Control::MeanPressure(0.01);

fn case() -> Case {
    Case::read(&embedded::source("ring").unwrap(), &[]).unwrap()
}

fn read(surface: &Surface, case: &Case, points: usize) -> Observables {
    read_at(LOAD, surface, case, [points; 2])
}

fn read_at(load: Control, surface: &Surface, case: &Case, points: [usize; 2]) -> Observables {
    let (_, solution, observables) = solve(surface, case.half_space(), points, load);
    assert!(solution.report.stop.solved(), "{}", solution.report);
    observables
}

/// 17, 25 and 50 samples to the outer radius, 4 to 12 across the ring: radii within a tenth of a spacing, areas within
/// what they say.
#[test]
fn both_radii_of_a_ring_and_its_area_are_read() {
    let case = case();
    let fine = read(case.surface(), &case, 512);
    let [exact] = &fine.levels[..] else { panic!("one level") };
    let (inner, outer) = exact.ring_radii.expect("a ring");
    assert!(exact.ring && !exact.merged);
    // The disc that it was once taken for.
    assert!(inner > 0.7 * outer && fine.contact_spots == 1);
    for points in [88, 128, 256] {
        let observables = read(case.surface(), &case, points);
        let found = &observables.levels[0];
        let (own_inner, own_outer) = found.ring_radii.expect("a ring");
        println!("{points}: {own_inner} {own_outer}, area {} ± {}", found.contact_area, found.contact_area_error);
        let spacing = 1.0 / points as f64;
        assert!((own_inner - inner).abs() < 0.1 * spacing && (own_outer - outer).abs() < 0.1 * spacing);
        assert!((found.contact_area - exact.contact_area).abs() < found.contact_area_error);
        assert!(observables.to_string().contains("a ring"), "{observables}");
    }
}

/// The surface's own heights on `points` samples.
fn sampled(surface: &Surface, points: [usize; 2]) -> Surface {
    let Surface::Indenters { lattice, levels } = surface else { panic!("indenters") };
    let cell = lattice.cell();
    let grid = Grid::new(cell, points).unwrap();
    let reduced = cell.reduced();
    let height = |index: usize| {
        let [s, t] = grid.fractions(index);
        let of = |level: usize, site: &[f64; 2]| {
            let [x, y] = reduced.nearest([s - site[0], t - site[1]]);
            levels[level].height() - levels[level].shape().profile(x.hypot(y))
        };
        let sites = lattice.sites().iter().enumerate();
        sites.flat_map(|(level, sites)| sites.iter().map(move |site| of(level, site))).fold(f64::NEG_INFINITY, f64::max)
    };
    Surface::Heights { cell, points, heights: (0..grid.len()).map(height).collect() }
}

/// Area to what both say.
#[test]
fn a_ring_of_a_topography_has_the_area_of_that_of_the_indenter() {
    let case = case();
    let (indenter, topography) =
        (read(case.surface(), &case, 192), read(&sampled(case.surface(), [192; 2]), &case, 192));
    assert!(indenter.levels[0].ring && topography.levels.is_empty());
    let errors = indenter.contact_fraction_error + topography.contact_fraction_error;
    let difference = (indenter.contact_fraction - topography.contact_fraction).abs();
    println!("{indenter}\n{} ± {errors}", topography.contact_fraction);
    assert!(difference < errors && difference < 2e-3 * indenter.contact_fraction);
}

/// Both stand far enough apart not to break the ring open: its hole is its own, and the disc has none.
#[test]
fn a_topography_with_a_disc_beside_a_ring_has_the_area_of_both() {
    let case = case();
    let Surface::Indenters { levels, .. } = case.surface() else { panic!("indenters") };
    let cell = Cell::new([1.0, 0.0], [0.0, 3.0]).unwrap();
    let lattice = Lattice::new(cell, vec![vec![[0.5, 0.25]], vec![[0.5, 0.75]]]).unwrap();
    let levels = vec![levels[0], common::paraboloid(0.5, -0.005)];
    let beside = Surface::Indenters { lattice, levels };
    let load = Control::MeanPressure(0.005);
    let indenters = read_at(load, &beside, &case, [160, 480]);
    let topography = read_at(load, &sampled(&beside, [160, 480]), &case, [160, 480]);
    println!("{indenters}\n{topography}");
    let [ring, disc] = &indenters.levels[..] else { panic!("two levels") };
    assert!(ring.ring && !disc.ring && disc.load > 0.0, "{indenters}");
    assert_eq!((indenters.contact_spots, topography.contact_spots), (2, 2));
    let errors = indenters.contact_fraction_error + topography.contact_fraction_error;
    let difference = (indenters.contact_fraction - topography.contact_fraction).abs();
    assert!(difference < errors && difference < 2e-3 * indenters.contact_fraction, "{difference} {errors}");
}

/// Two methods, two kernels, two readings: each edge to a tenth of an element.
#[test]
fn the_localized_method_sees_the_ring_by_itself() {
    let case = case();
    let Surface::Indenters { lattice, levels } = case.surface() else { panic!("indenters") };
    let system = Localized::new(lattice, levels, case.half_space(), 37);
    let setup = Setup { indenters: 37, elements: 50, radius: CircleRadius::LoadBalanced, mutual_effect: true };
    let solution = system.solve(LOAD, &setup);
    assert_eq!(solution.stop, Stop::Converged);
    let outline = solution.spots[0].outline().expect("an outline");
    let (inner, outer) = read(case.surface(), &case, 256).levels[0].ring_radii.unwrap();
    let own_outer = solution.spots[0].outer_radius();
    println!("{} {own_outer} against {inner} {outer}", outline.hole);
    let element = solution.spots[0].mesh.size;
    assert!((outline.hole - inner).abs() < 0.1 * element, "{}", outline.hole);
    assert!((own_outer - outer).abs() < 0.1 * element, "{own_outer}");
}
