//! An elastic counterbody: compliances add, couplings subtract, and both bodies have their stresses.

use percoat::body::Side;
use percoat::reading::Criterion;
use percoat::{
    Bodies, Cell, Depth, Friction, HalfSpace, Indenters, Interface, Lattice, Layer, Level, Load, Material, MeanStress,
    Problem, Run, Sampling, Settings, Shape, Solver, Step, Strength, StressFields, StressReading,
};
use std::sync::Arc;

const POINTS: [usize; 2] = [64, 64];
/// Relative difference that two solutions may have whose residuals are the tolerance.
const SOLVED: f64 = 1e-6;

fn material(young: f64, poisson: f64) -> Material {
    Material::from_young(young, poisson).unwrap()
}

fn bare(young: f64, poisson: f64) -> HalfSpace {
    HalfSpace::new(vec![], material(young, poisson))
}

fn coated(young: f64, poisson: f64, thickness: f64) -> HalfSpace {
    let layer = Layer::new(material(young, poisson), thickness, Interface::Bonded).unwrap();
    HalfSpace::new(vec![layer], material(1.0, 0.3))
}

/// Two levels on a square cell, pressed so that both touch, with friction `mu` along x.
fn solved(bodies: impl Into<Bodies>, mu: f64) -> Step {
    let sites = vec![vec![[0.0, 0.0]], vec![[0.5, 0.5]]];
    let levels = [0.004, 0.0].map(|height| Level::new(Shape::Paraboloid { radius: 1.0 }, height).unwrap());
    let lattice = Lattice::new(Cell::square(1.0).unwrap(), sites).unwrap();
    let problem = Problem::new(Indenters::new(lattice, levels.to_vec()).unwrap(), bodies);
    let problem = problem.sliding(Friction::new(mu, [1.0, 0.0]).unwrap()).unwrap();
    let settings = Settings { tolerance: 1e-10, ..Settings::default() };
    let step = Solver::new(problem, POINTS, settings).unwrap().solve(Load::MeanPressure(0.02));
    assert!(step.report.stop.solved(), "{}", step.report);
    assert!(step.reading().levels.iter().all(|level| level.load > 0.0), "both levels touch");
    step
}

/// Largest difference of two pressures over the largest one; the second is read at (−x, y) where it is `mirrored`.
fn difference(step: &Step, other: &Step, mirrored: bool) -> f64 {
    let ([n1, _], peak) = (POINTS, step.pressure().iter().copied().fold(0.0, f64::max));
    let at = |i: usize| if mirrored { (n1 - i) % n1 } else { i };
    let [pressure, other] = [step.pressure(), other.pressure()];
    let pairs = pressure.indexed_iter().map(|((i, j), p)| (p - other[[at(i), j]]).abs());
    pairs.fold(0.0, f64::max) / peak
}

#[test]
fn bare_bodies_press_like_a_rigid_one_on_the_composite_modulus() {
    let modulus = 1.0 / ((1.0 - 0.09) / 2.0 + (1.0 - 0.01) / 3.0);
    let both = solved(Bodies::elastic(bare(2.0, 0.3), bare(3.0, 0.1)), 0.0);
    let one = solved(bare(modulus, 0.0), 0.0);
    assert!(difference(&both, &one, false) < SOLVED);
    assert!((both.penetration() / one.penetration() - 1.0).abs() < SOLVED);
}

/// 1/E* changes by 1e-6 of itself where the counterbody has 1e6 times the modulus.
#[test]
fn a_stiff_counterbody_is_rigid() {
    let stiff = solved(Bodies::elastic(coated(4.0, 0.2, 0.1), bare(1e6, 0.3)), 0.3);
    let rigid = solved(coated(4.0, 0.2, 0.1), 0.3);
    assert!(difference(&stiff, &rigid, false) < 1e-5);
}

#[test]
fn exchanged_bodies_have_the_same_pressure_and_the_reversed_coupling() {
    let [first, second] = [coated(4.0, 0.0, 0.1), coated(0.5, 0.4, 0.2)];
    let at_rest = [[&first, &second], [&second, &first]]
        .map(|[body, counterbody]| solved(Bodies::elastic(body.clone(), counterbody.clone()), 0.0));
    assert!(difference(&at_rest[0], &at_rest[1], false) < SOLVED);
    let sliding = [[&first, &second], [&second, &first]]
        .map(|[body, counterbody]| solved(Bodies::elastic(body.clone(), counterbody.clone()), 0.8));
    assert!(difference(&sliding[0], &sliding[1], true) < SOLVED);
    let shift = difference(&sliding[0], &at_rest[0], false);
    assert!(shift > 1e-2, "friction couples: {shift:e}");
}

#[test]
fn like_bodies_do_not_couple() {
    let bodies = || Bodies::elastic(coated(4.0, 0.0, 0.1), coated(4.0, 0.0, 0.1));
    let [slid, free] = [0.9, 0.0].map(|mu| solved(bodies(), mu));
    assert!(difference(&slid, &free, false) < SOLVED);
    // Under a rigid counterbody the same coating does.
    let [slid, free] = [0.9, 0.0].map(|mu| solved(coated(4.0, 0.0, 0.1), mu));
    assert!(difference(&slid, &free, false) > 1e-2);
}

/// The stresses of a body do not depend on which of the two it is: as counterbody it has them mirrored at x = 0.
#[test]
fn exchanged_bodies_have_their_stresses_mirrored() {
    let [first, second] = [coated(4.0, 0.1, 0.1), coated(0.5, 0.4, 0.2)];
    let direct = solved(Bodies::elastic(first.clone(), second.clone()), 0.6);
    let exchanged = solved(Bodies::elastic(second, first), 0.6);
    let [direct, exchanged] = [&direct, &exchanged].map(|step| StressFields::new(step.finest(), MeanStress::Confined));
    let pairs = [(direct.body(), exchanged.counterbody().unwrap()), (direct.counterbody().unwrap(), exchanged.body())];
    for (field, other) in pairs {
        assert!(field.half_space().side() != other.half_space().side());
        for depth in [Depth { z: 0.05, material: 1 }, Depth { z: 0.3, material: 2 }] {
            for [x, y] in [[0.07, 0.02], [0.3, -0.2], [0.55, 0.48]] {
                let at = field.points(depth, &[[x, y]])[0].components();
                let mirrored = other.points(depth, &[[-x, y]])[0].components();
                // xx, yy, zz, xy, xz, yz, u_x, u_y, u_z.
                let signs = [1.0, 1.0, 1.0, -1.0, -1.0, 1.0, -1.0, 1.0, 1.0];
                for k in 0..9 {
                    let error = (at[k] - signs[k] * mirrored[k]).abs();
                    assert!(error < SOLVED, "{k} at {x}, {y}, {depth:?}: {at:?}, {mirrored:?}");
                }
            }
        }
    }
}

/// Newton's third law: on both sides of the common surface σ_zz is −p, and the shear traction on the counterbody is opposite.
/// Between the surfaces −σ_xz is the traction along x.
#[test]
fn both_surfaces_bear_the_same_pressure_and_opposite_tractions() {
    let step = solved(Bodies::elastic(coated(4.0, 0.2, 0.1), bare(2.0, 0.3)), 0.4);
    let fields = StressFields::new(step.finest(), MeanStress::Confined);
    let [body, counterbody] = [fields.body(), fields.counterbody().unwrap()]
        .map(|field| field.points(Depth::SURFACE, &[step.grid().cell().point([0.0, 0.0])])[0]);
    let pressure = step.pressure()[[0, 0]];
    for (state, sign) in [(body, 1.0), (counterbody, -1.0)] {
        assert!((state.zz + pressure).abs() < 1e-9 * pressure, "{state:?}, {pressure}");
        assert!((state.xz + sign * 0.4 * pressure).abs() < 1e-9 * pressure, "{state:?}, {pressure}");
    }
}

/// Materials and interfaces of both bodies have their largest stresses, and each criterion its utilisation.
#[test]
fn readings_and_limits_name_the_body() {
    let strong =
        |body: HalfSpace| body.with_substrate_strength(Strength { yielding: Some(0.2), tensile: None }).unwrap();
    let bodies = Bodies::elastic(strong(coated(4.0, 0.2, 0.1)), strong(bare(1.0, 0.3)));
    let step = solved(bodies.clone(), 0.0);
    let stress = StressReading::of(&step, &step.reading(), &StressFields::new(step.finest(), MeanStress::Confined));
    let sides: Vec<_> = stress.materials.iter().map(|row| (row.tau1.material.side, row.tau1.material.number)).collect();
    let [body, counterbody] = [Some(Side::Body), Some(Side::Counterbody)];
    assert_eq!(sides, [(body, 1), (body, 2), (counterbody, 1)]);
    let criteria = Criterion::all(&bodies);
    let codes: Vec<String> = criteria.iter().map(|criterion| criterion.code()).collect();
    assert_eq!(codes, ["yield of material 2", "yield of material 1 of the counterbody"]);
    assert!(codes.iter().zip(&criteria).all(|(code, criterion)| code.parse() == Ok(*criterion)));
    let run = Run::new(Arc::clone(step.problem()), vec![Load::MeanPressure(0.02)], Sampling::Points(POINTS));
    let limits = run.limits(&mut ()).unwrap();
    let loads: Vec<f64> = limits.limits.iter().map(|limit| limit.load()).collect();
    assert_eq!(loads.len(), 2);
    // Bare and below a stiff coating: the counterbody bears the same pressure without a coating, and yields first.
    assert!(loads[1] < loads[0], "{loads:?}");
    assert_eq!(limits.shown[0].sections(&run).unwrap().len(), 2);
}

/// A bare counterbody bears the pressure as the body does: of like bodies both have the same largest stresses.
#[test]
fn like_bodies_are_stressed_alike() {
    let step = solved(Bodies::elastic(bare(1.0, 0.3), bare(1.0, 0.3)), 0.0);
    let stress = StressReading::of(&step, &step.reading(), &StressFields::new(step.finest(), MeanStress::Confined));
    let [body, counterbody] = &stress.materials[..] else { panic!("{stress:?}") };
    for [peak, other] in [[body.tau1, counterbody.tau1], [body.mises, counterbody.mises]] {
        assert!((peak.value / other.value - 1.0).abs() < 1e-9, "{peak:?}, {other:?}");
    }
}
