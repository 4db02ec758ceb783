//! Friction of an interface by Mohr and Coulomb: the shear that it bears rises with the pressure on it.

use crate::common;

use common::one_level;
use percoat::body::{Depth, InterfaceStrength, MeanStress, Strength};
use percoat::run::{At, Limits};
use percoat::{
    Cell, Friction, HalfSpace, Interface, Lattice, Layer, Level, Load, Material, Problem, Run, Sampling, Shape, Solver,
    StressFields, Topography,
};

/// Shear strength of the interface.
const SHEAR: f64 = 0.1;

fn material(young: f64) -> Material {
    Material::from_young(young, 0.3).unwrap()
}

/// A body whose layer comes off where its interface is sheared beyond its strength, with this friction under pressure.
fn layered([young, thickness]: [f64; 2], normal: Option<f64>, friction: f64) -> HalfSpace {
    let bond = InterfaceStrength { normal, shear: Some(SHEAR), friction };
    let layer = Layer::new(material(young), thickness, Interface::Bonded).unwrap();
    HalfSpace::new(vec![layer.with_strengths(Strength::default(), bond).unwrap()], material(1.0))
}

fn limits(problem: Problem, points: usize) -> Limits {
    Run::new(problem, vec![Load::MeanPressure(0.01)], Sampling::Points([points; 2])).limits(&mut ()).unwrap()
}

/// Under a flat surface that slides with μ the interface carries the pressure p and the shear μp everywhere: it comes off at
/// p = τ_c/(μ − f), and never where f exceeds μ: its utilisation tends to μ/f.
#[test]
fn a_flat_slider_shears_an_interface_off_at_its_closed_form() {
    const SLIDING: f64 = 0.5;
    let found = |friction: f64| {
        let flat = Topography::new(Cell::square(1.0).unwrap(), ndarray::Array2::zeros([16, 16])).unwrap();
        let body = layered([3.0, 0.1], Some(0.01), friction);
        let problem = Problem::new(flat, body).sliding(Friction::new(SLIDING, [0.6, 0.8]).unwrap()).unwrap();
        limits(problem, 16)
    };
    for friction in [0.0, 0.1, 0.3, 0.45] {
        let limits = found(friction);
        let At::Load { load, .. } = limits.limits[0].at else { panic!("{friction}: {limits}") };
        let exact = SHEAR / (SLIDING - friction);
        assert!((load / exact - 1.0).abs() < 1e-3, "{friction}: {load}, {exact}");
    }
    for friction in [0.6, 0.8] {
        let limits = found(friction);
        let At::Never { utilisation, .. } = limits.limits[0].at else { panic!("{friction}: {limits}") };
        assert!(utilisation < 1.0 && utilisation > 0.9 * SLIDING / friction, "{friction}: {limits}");
    }
}

/// The utilisation under a sliding sphere is the largest of τ/(τ_c + f⟨−σ_zz⟩), and of the tension beside it, over a dense plane of
/// stresses at the interface; f = 0 is the ellipse alone; friction of the interface never does harm.
#[test]
fn the_largest_utilisation_is_that_of_a_dense_plane_of_stresses() {
    let sphere = Level::new(Shape::Sphere { radius: 2.0 }, 0.0).unwrap();
    for (stack, sliding, normal) in
        [([4.0, 0.1], 0.4, Some(0.05)), ([0.3, 0.1], 0.2, None), ([1.0, 0.3], 0.7, Some(0.2))]
    {
        let mut before = f64::INFINITY;
        for friction in [0.0, 0.2, 1.0] {
            let lattice = Lattice::square(1.0, 1).unwrap();
            let body = layered(stack, normal, friction);
            let problem = Problem::new(one_level(lattice, sphere.clone()), body);
            let problem = problem.sliding(Friction::new(sliding, [1.0, 0.0]).unwrap()).unwrap();
            let load = Load::MeanPressure(0.05);
            let run = Run::new(problem.clone(), vec![load], Sampling::Points([64; 2]));
            let step = run.solve(&mut ()).unwrap().steps.remove(0);
            let row = step.strength[0];
            let solved = Solver::new(problem, [64; 2], run.settings).unwrap().solve(load);
            let fields = StressFields::new(solved.finest(), MeanStress::default());
            // Twice as many points as waves: their spacing leaves some (πh/2L)² of waves of the length L, a tenth of the contact.
            let plane = fields.body().plane(Depth { z: stack[1], material: 2 }, [256; 2]);
            let taken = |state: &percoat::stress::StressState| {
                let (pressure, shear) = ((-state.zz).max(0.0), state.xz.hypot(state.yz));
                let opened = normal.map_or(0.0, |normal| state.zz.max(0.0) / normal);
                opened.hypot(shear / (SHEAR + friction * pressure))
            };
            let dense = plane.states().iter().map(taken).fold(0.0, f64::max);
            assert!(
                row.value > dense * (1.0 - 1e-9) && row.value < dense * 1.01,
                "{stack:?}, {friction}: {row:?}, {dense}"
            );
            assert!(row.value <= before && row.error.is_some(), "{stack:?}, {friction}: {row:?}");
            before = row.value;
        }
    }
}
