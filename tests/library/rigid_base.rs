//! Layers on a rigid base through the whole solver: the mean compression in δ, complete contact at any penetration, thin layers as
//! columns, periodic and isolated contact alike, and stresses down to the base.

use crate::common;

use common::{one_level, paraboloid};
use ndarray::Array2;
use percoat::{
    Cell, Depth, Friction, Grid, HalfSpace, Interface, Lattice, Layer, Load, Material, MeanStress, Problem, Settings,
    Solver, Step, Stop, StressField, Surroundings,
};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

const SHARP: Settings = Settings { tolerance: 1e-11, ..DEFAULT };
const DEFAULT: Settings = Settings { method: percoat::Method::Preconditioned, tolerance: 1e-8, max_iterations: 10_000 };

fn layer(young: f64, poisson: f64, thickness: f64, interface: Interface) -> Layer {
    Layer::new(Material::from_young(young, poisson).unwrap(), thickness, interface).unwrap()
}

fn on_rigid_base(layers: &[Layer]) -> HalfSpace {
    HalfSpace::on_rigid_base(layers.to_vec()).unwrap()
}

fn rubber(thickness: f64, poisson: f64) -> HalfSpace {
    on_rigid_base(&[layer(1.0, poisson, thickness, Interface::Bonded)])
}

/// Paraboloids of radius 1 on a square lattice.
fn periodic(body: &HalfSpace, side: f64) -> Problem {
    Problem::new(one_level(Lattice::square(side, 1).unwrap(), paraboloid(1.0, 0.0)), body.clone())
}

/// One paraboloid of radius 1 in a window.
fn isolated(body: &HalfSpace, window: f64) -> Problem {
    let lattice = Lattice::new(Cell::window([window; 2]).unwrap(), vec![vec![[0.5; 2]]]).unwrap();
    Problem::new(one_level(lattice, paraboloid(1.0, 0.0)), body.clone())
}

fn solved(problem: Problem, points: usize, load: Load) -> Step {
    let step = Solver::new(problem, [points; 2], SHARP).unwrap().solve(load);
    assert!(step.report.stop.solved(), "{}", step.report);
    step
}

/// w has the mean p̄ (h/M + 1/k_n), and so has δ, which counts from the base; the pressure is that without it.
#[test]
fn the_mean_compression_is_in_the_displacement_and_the_penetration() {
    let spring = Interface::Spring { tangential: 3.0, normal: 5.0 };
    let body = on_rigid_base(&[layer(2.0, 0.3, 0.2, Interface::Bonded), layer(1.0, 0.45, 0.3, spring)]);
    let modulus = |young: f64, nu: f64| young * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu));
    let compliance = 0.2 / modulus(2.0, 0.3) + 0.3 / modulus(1.0, 0.45) + 0.2;
    assert!((body.mean_compliance() / compliance - 1.0).abs() < 1e-14);
    let step = solved(periodic(&body, 1.0), 64, Load::MeanPressure(0.01));
    let mean = step.displacement().mean().unwrap();
    assert!((mean / (0.01 * compliance) - 1.0).abs() < 1e-10, "{mean}");
    // By the penetration that this load has the same contact is found.
    let again = solved(periodic(&body, 1.0), 64, Load::Penetration(step.penetration()));
    assert!((again.pressure().mean().unwrap() / 0.01 - 1.0).abs() < 1e-8);
    // A base ten million times as stiff as the layers gives the same pressure, and δ without the compression.
    let stiff = HalfSpace::new(body.layers().to_vec(), Material::from_young(1e7, 0.3).unwrap());
    let other = solved(periodic(&stiff, 1.0), 64, Load::MeanPressure(0.01));
    let peak = step.pressure().iter().copied().fold(0.0, f64::max);
    for (pressure, other) in step.pressure().iter().zip(other.pressure()) {
        assert!((pressure - other).abs() < 1e-6 * peak, "{pressure}, {other}");
    }
    assert!((step.penetration() - other.penetration() - 0.01 * compliance).abs() < 1e-7 * step.penetration());
}

/// Beyond complete contact a compressible layer is pressed uniformly further; an incompressible one gives no way, and the
/// penetration is refused as on a half-space.
#[test]
fn complete_contact_bears_any_penetration_unless_nothing_is_compressible() {
    let body = rubber(0.3, 0.3);
    let mut solver = Solver::new(periodic(&body, 0.5), [32; 2], SHARP).unwrap();
    let (complete, least) = (solver.full_contact_penetration(), solver.full_contact_pressure());
    assert!((complete - solver.surface().mean() - least * body.mean_compliance()).abs() < 1e-12);
    for part in [0.7, 1.3, 3.0] {
        let step = solver.solve(Load::Penetration(part * complete));
        assert!(step.report.stop.solved(), "{part}: {}", step.report);
        let mean = step.pressure().mean().unwrap();
        let open = step.pressure().iter().filter(|p| **p == 0.0).count();
        if part > 1.0 {
            let known = (part * complete - solver.surface().mean()) / body.mean_compliance();
            assert!(open == 0 && (mean / known - 1.0).abs() < 1e-8, "{part}: {mean}, {known}");
        } else {
            assert!(open > 0 && mean < least);
        }
        let again = solver.solve(Load::MeanPressure(mean));
        assert!((again.penetration() / (part * complete) - 1.0).abs() < 1e-8, "{part}: {}", again.penetration());
    }
    let mut solver = Solver::new(periodic(&rubber(0.3, 0.5), 0.5), [32; 2], SHARP).unwrap();
    let complete = solver.full_contact_penetration();
    assert_eq!(complete, solver.surface().mean());
    assert_eq!(solver.solve(Load::Penetration(1.01 * complete)).report.stop, Stop::BeyondFullContact);
    let step = solver.solve(Load::MeanPressure(0.05));
    assert!(step.report.stop.solved() && step.displacement().mean().unwrap().abs() < 1e-12, "{}", step.report);
}

/// Simpson's rule over the penetration: with δ from the base the compression stores energy too.
#[test]
fn the_elastic_energy_is_the_work_of_the_load_path() {
    let mut solver = Solver::new(periodic(&rubber(0.2, 0.3), 1.0), [64; 2], SHARP).unwrap();
    let (from, to, steps) = (0.02, 0.06, 24);
    let h = (to - from) / f64::from(steps);
    let mut at = |k: i32| {
        let step = solver.solve(Load::Penetration(from + h * f64::from(k)));
        (step.pressure().mean().unwrap(), step.elastic_energy())
    };
    let path: Vec<(f64, f64)> = (0..=steps).map(&mut at).collect();
    let weight = |k: usize| if k == 0 || k + 1 == path.len() { 1.0 } else { [2.0, 4.0][k % 2] };
    let work: f64 = path.iter().enumerate().map(|(k, (force, _))| weight(k) * force * h / 3.0).sum();
    let stored = path[path.len() - 1].1 - path[0].1;
    assert!((stored / work - 1.0).abs() < 1e-4, "{stored:e} {work:e}");
}

/// Displacements of a contact on a rigid base fade within some thicknesses: neighbours eight thicknesses apart are
/// alone, and δ of the lattice, which counts from the base, is that of the single contact, which counts from far away.
#[test]
fn a_wide_lattice_is_a_single_contact() {
    let stacks = [
        rubber(0.1, 0.3),
        on_rigid_base(&[layer(3.0, 0.2, 0.02, Interface::Bonded), layer(1.0, 0.4, 0.06, Interface::Bonded)]),
    ];
    for body in stacks {
        // Both grids have samples at the middle of the contact, at equal spacings.
        let single = solved(isolated(&body, 0.75), 96, Load::Force(2e-3));
        let lattice = solved(periodic(&body, 1.5), 192, Load::Force(2e-3));
        let [one, many] = [&single, &lattice].map(|step| step.pressure().iter().copied().fold(0.0, f64::max));
        assert!((one / many - 1.0).abs() < 1e-5, "{body}: {one}, {many}");
        let [one, many] = [single.penetration(), lattice.penetration()];
        assert!((one / many - 1.0).abs() < 1e-5, "{body}: {one}, {many}");
    }
}

/// A contact far wider than the layer presses columns, p = M(δ − r²/2R)/h: a² = 2Rδ and P = πRMδ²/h, to the order (h/a)², as the
/// compliance of long waves.
#[test]
fn a_thin_layer_is_a_foundation_of_columns() {
    let (nu, delta) = (0.3, 0.02);
    let modulus = (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu));
    let errors = [0.02, 0.01].map(|h| {
        let step = solved(isolated(&rubber(h, nu), 0.6), 128, Load::Penetration(delta));
        step.reading().force / (PI * modulus * delta * delta / h) - 1.0
    });
    assert!(errors[1].abs() < 1e-3 && (3.0..5.0).contains(&(errors[0] / errors[1])), "{errors:?}");
}

/// Down to the base: u = 0 there, also in the mean and under friction, and stresses are the limit of a stiff substrate. Under the mean
/// pressure alone the layers are columns.
#[test]
fn stresses_reach_the_base_and_nothing_moves_there() {
    let layers = [layer(3.0, 0.2, 0.1, Interface::Bonded), layer(0.5, 0.5, 0.15, Interface::Bonded)];
    let (rigid, stiff) =
        (on_rigid_base(&layers), HalfSpace::new(layers.to_vec(), Material::from_young(1e9, 0.3).unwrap()));
    let friction = Friction::new(0.4, [0.6, 0.8]).unwrap();
    for cell in [Cell::square(1.0).unwrap(), Cell::window([1.0; 2]).unwrap()] {
        let grid = Arc::new(Grid::new(cell, [24; 2]).unwrap());
        let bell =
            |i: usize| (0.5 * TAU * (i as f64 - 7.5) / 8.0).cos().powi(2) * f64::from(u8::from((4..=11).contains(&i)));
        let pressure = Array2::from_shape_fn([24; 2], |(i, j)| bell(i) * bell(j));
        let field = |body: &HalfSpace| {
            StressField::under(&grid, pressure.view(), body, Some(&friction), MeanStress::Confined).unwrap()
        };
        let (on_rigid, other) = (field(&rigid), field(&stiff));
        let peak = 1.0;
        // In a window the polynomials in depth leave 10⁻⁷ of what the field of its images, on four times the area, has in addition: that of
        // their mean pressure and traction at most.
        let mean = pressure.mean().unwrap() / 4.0;
        let moved = mean * (rigid.mean_compliance() + 0.4 * (0.1 / (3.0 / 2.4) + 0.15 / (0.5 / 3.0)));
        let rest = if cell.surroundings() == Surroundings::FreeSpace { 1e-7 * moved } else { 1e-12 };
        for (z, material) in [(0.0, 1), (0.1, 1), (0.1, 2), (0.2, 2), (0.25, 2)] {
            for place in [[0.1, 0.05], [-0.15, 0.21], [0.4, 0.4]] {
                let at = |field: &StressField| field.points(Depth { z, material }, &[place])[0];
                let (state, limit) = (at(&on_rigid), at(&other));
                for (one, two) in state.components()[..6].iter().zip(&limit.components()[..6]) {
                    assert!((one - two).abs() < 2e-7 * peak, "{cell}, {z}, {place:?}: {state:?}, {limit:?}");
                }
                if z == 0.25 {
                    assert!(state.displacement.iter().all(|u| u.abs() < rest), "{cell}: {:?}", state.displacement);
                }
            }
        }
        // The mean of the surface is that of the columns, sheared by the mean traction.
        if cell.surroundings() == Surroundings::Periodic {
            let plane = field(&rigid).plane(Depth::SURFACE, [24; 2]);
            let all: Vec<[f64; 3]> =
                (0..24).flat_map(|i| (0..24).map(move |j| [i, j])).map(|at| plane.state(at).displacement).collect();
            let mean = |k: usize| all.iter().map(|u| u[k]).sum::<f64>() / all.len() as f64;
            let p = pressure.mean().unwrap();
            let slide = 0.4 * p * (0.1 / (3.0 / 2.4) + 0.15 / (0.5 / 3.0));
            for (k, known) in [0.6 * slide, 0.8 * slide, p * rigid.mean_compliance()].into_iter().enumerate() {
                assert!((mean(k) - known).abs() < 1e-12, "{k}: {}, {known}", mean(k));
            }
        }
    }
}

/// Coupled friction on a bonded layer: the solver's displacement is that of its harmonic response with the mean.
#[test]
fn sliding_on_a_layer_on_a_rigid_base_converges_as_on_a_stiff_one() {
    let body = rubber(0.15, 0.2);
    let friction = Friction::new(0.3, [1.0, 0.0]).unwrap();
    let stiff = HalfSpace::new(body.layers().to_vec(), Material::from_young(1e8, 0.3).unwrap());
    let [step, other] = [&body, &stiff].map(|body| {
        let problem = periodic(body, 1.0).sliding(friction).unwrap();
        solved(problem, 64, Load::MeanPressure(0.02))
    });
    let peak = step.pressure().iter().copied().fold(0.0, f64::max);
    for (pressure, other) in step.pressure().iter().zip(other.pressure()) {
        assert!((pressure - other).abs() < 1e-6 * peak, "{pressure}, {other}");
    }
    let compression = 0.02 * body.mean_compliance();
    assert!((step.penetration() - other.penetration() - compression).abs() < 1e-6 * step.penetration());
}
