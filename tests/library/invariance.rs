//! Invariance of the answer: place of the origin, choice of the cell, units, counting of layers; and the cases tested
//! are those of the paper.

use crate::common;

use common::{PAPER, one_level, paraboloid, relative_difference, solve, solve_sharply};
use ndarray::{Array2, Axis};
use percoat::{Cell, HalfSpace, Indenters, Interface, Lattice, Layer, Load, Material, Problem};

const LOAD: Load = Load::MeanPressure(0.06);

/// The paper's levels on `cell`, on the half-space of Fig. 2.
fn three_levels(cell: Cell, shift: [f64; 2]) -> Problem {
    let third = 1.0 / 3.0;
    let site = |s: f64| vec![[s + shift[0], s + shift[1]]];
    let lattice = Lattice::new(cell, vec![site(0.0), site(third), site(2.0 * third)]).unwrap();
    Problem::new(Indenters::new(lattice, PAPER[0].levels()).unwrap(), PAPER[0].half_space())
}

fn paper_cell() -> Cell {
    Cell::hexagonal(3f64.sqrt()).unwrap()
}

#[test]
fn a_shift_by_grid_vectors_shifts_the_pressure() {
    let n = 72;
    let (here, _) = solve_sharply(&three_levels(paper_cell(), [0.0; 2]), [n, n], LOAD);
    // Even numbers of samples: a grid vector of the coarser grid too.
    let shift = [6.0 / n as f64, 30.0 / n as f64];
    let (there, _) = solve_sharply(&three_levels(paper_cell(), shift), [n, n], LOAD);
    let moved = Array2::from_shape_fn([n, n], |(i, j)| here.pressure()[[(i + n - 6) % n, (j + n - 30) % n]]);
    assert!(relative_difference(there.pressure(), &moved) < 1e-11);
}

#[test]
fn a_shift_off_the_grid_changes_nothing_that_is_read_off() {
    let (_, here) = solve(&three_levels(paper_cell(), [0.0; 2]), [256, 256], LOAD);
    let (_, there) = solve(&three_levels(paper_cell(), [0.3 / 256.0, 0.6 / 256.0]), [256, 256], LOAD);
    assert!((there.penetration / here.penetration - 1.0).abs() < 2e-5);
    for (a, b) in here.levels.iter().zip(&there.levels) {
        assert!((a.max_pressure / b.max_pressure - 1.0).abs() < 1e-4);
        assert!((a.load_share / b.load_share - 1.0).abs() < 1e-4);
        assert!((a.contact_radius.unwrap() / b.contact_radius.unwrap() - 1.0).abs() < 3e-4);
    }
}

/// Rotation by 60° about a site: s₁a₁ + s₂a₂ → −s₂a₁ + (s₁ + s₂)a₂.
#[test]
fn one_level_on_a_hexagonal_lattice_keeps_its_sixfold_symmetry_to_round_off() {
    let n = 60;
    let indenters = one_level(Lattice::hexagonal(1.0, 1).unwrap(), paraboloid(0.8, 0.0));
    let (step, _) = solve_sharply(&Problem::new(indenters, PAPER[0].half_space()), [n, n], LOAD);
    for field in [step.pressure(), step.displacement().view()] {
        let rotated = Array2::from_shape_fn([n, n], |(i, j)| field[[(n - j) % n, (i + j) % n]]);
        assert!(relative_difference(&rotated, field) < 1e-11);
    }
}

/// Rotation by 120° about a site of three equal sublattices keeps each of them.
#[test]
fn three_levels_keep_their_threefold_symmetry_to_round_off() {
    let n = 60;
    let (step, _) = solve_sharply(&three_levels(paper_cell(), [0.0; 2]), [n, n], LOAD);
    let rotated = Array2::from_shape_fn([n, n], |(i, j)| step.pressure()[[(2 * n - i - j) % n, i]]);
    assert!(relative_difference(&rotated, step.pressure()) < 1e-11);
}

#[test]
fn swapped_cell_vectors_transpose_the_fields() {
    let (n1, n2) = (60, 48);
    let (a1, a2) = ([1.3, 0.1], [-0.2, 0.9]);
    let problem = |swap: bool| {
        let order = |s: [f64; 2]| if swap { [s[1], s[0]] } else { s };
        let cell = if swap { Cell::new(a2, a1) } else { Cell::new(a1, a2) }.unwrap();
        let sites = vec![vec![order([0.1, 0.2])], vec![order([0.6, 0.55]), order([0.2, 0.7])]];
        let levels = vec![paraboloid(0.7, 0.01), paraboloid(0.5, 0.0)];
        Problem::new(Indenters::new(Lattice::new(cell, sites).unwrap(), levels).unwrap(), PAPER[0].half_space())
    };
    let (straight, levels) = solve(&problem(false), [n1, n2], LOAD);
    let (swapped, levels_swapped) = solve(&problem(true), [n2, n1], LOAD);
    assert!(relative_difference(swapped.pressure().t(), straight.pressure()) < 1e-6);
    assert!((levels.levels[1].load / levels_swapped.levels[1].load - 1.0).abs() < 1e-7);
}

#[test]
fn a_doubled_cell_holds_the_same_contact_twice() {
    let load = Load::MeanPressure(PAPER[1].pressure);
    let third = 1.0 / 3.0;
    let [a1, a2] = paper_cell().vectors();
    let doubled = Cell::new(a1.map(|x| 2.0 * x), a2).unwrap();
    let sites = |s: f64| vec![[0.5 * s, s], [0.5 * (s + 1.0), s]];
    let lattice = Lattice::new(doubled, vec![sites(0.0), sites(third), sites(2.0 * third)]).unwrap();
    let problem = Problem::new(Indenters::new(lattice, PAPER[1].levels()).unwrap(), PAPER[1].half_space());
    let (once, single) = solve(&PAPER[1].problem(), [96, 96], load);
    let (twice, double) = solve(&problem, [192, 96], load);
    let (first, second) = twice.pressure().split_at(Axis(0), 96);
    assert!(relative_difference(first, once.pressure()) < 1e-6);
    assert!(relative_difference(second, once.pressure()) < 1e-6);
    for (a, b) in single.levels.iter().zip(&double.levels) {
        assert!((a.load / b.load - 1.0).abs() < 1e-7, "the load is that on one indenter");
        assert!((a.load_share / b.load_share - 1.0).abs() < 1e-7);
        assert!((a.contact_area / b.contact_area - 1.0).abs() < 1e-5);
    }
}

#[test]
fn units_scale_the_answer_and_leave_the_iteration_alone() {
    let (length, pressure) = (1e-6, 2.1e11);
    let level = |height: f64| paraboloid(0.8 * length, height * length);
    let levels = vec![level(0.02), level(0.01), level(0.0)];
    let small = Indenters::new(Lattice::hexagonal(length, 3).unwrap(), levels).unwrap();
    let substrate = Material::from_young(pressure, 0.3).unwrap();
    let coating = Material::from_shear(2.0 * substrate.shear(), 0.2).unwrap();
    let scaled = HalfSpace::new(vec![Layer::new(coating, 0.5 * length, Interface::Bonded).unwrap()], substrate);
    let (plain, here) = solve(&PAPER[0].problem(), [96, 96], LOAD);
    let (other, there) = solve(&Problem::new(small, scaled), [96, 96], Load::MeanPressure(0.06 * pressure));
    assert_eq!(plain.report.iterations, other.report.iterations);
    assert!((there.penetration / length / here.penetration - 1.0).abs() < 1e-10);
    for (a, b) in here.levels.iter().zip(&there.levels) {
        assert!((b.max_pressure / pressure / a.max_pressure - 1.0).abs() < 1e-9);
        assert!((b.load / (pressure * length * length) / a.load - 1.0).abs() < 1e-9);
        assert!((b.contact_radius.unwrap() / length / a.contact_radius.unwrap() - 1.0).abs() < 1e-7);
    }
}

/// Cases of the paper in the tests equal those that the program carries with it, up to a common height.
#[cfg(feature = "cli")]
#[test]
fn the_cases_of_the_tests_are_the_embedded_ones() {
    use percoat::case::{Case, embedded};
    let close = |a: f64, b: f64| (a - b).abs() < 1e-12;
    for paper in PAPER {
        let name = paper.name;
        let case = Case::read(&embedded::source(name).unwrap(), &[]).unwrap();
        let (stated, embedded) = (paper.indenters(), case.problem().indenters().unwrap());
        assert_eq!(stated.lattice(), embedded.lattice(), "{name}");
        assert!(stated.levels().iter().zip(embedded.levels()).all(|(a, b)| a.shape() == b.shape()), "{name}");
        assert_eq!(stated.levels().len(), embedded.levels().len(), "{name}");
        assert!(stated.drops().iter().zip(embedded.drops()).all(|(&a, b)| close(a, b)), "{name}: {embedded}");
        let (stated, embedded) = (paper.half_space(), case.half_space());
        let ([mine], [theirs]) = (stated.layers(), embedded.layers()) else { panic!("{name}: one layer") };
        assert_eq!((mine.thickness(), mine.interface()), (theirs.thickness(), theirs.interface()), "{name}");
        for (a, b) in stated.materials().zip(embedded.materials()) {
            assert!(close(a.shear(), b.shear()) && close(a.poisson(), b.poisson()), "{name}: {embedded}");
        }
        assert_eq!(case.load.quantity(), "mean_pressure");
        assert!(case.load.values().iter().any(|&load| close(load, paper.pressure)), "{name}: {:?}", case.load);
    }
}
