//! Strains: closed forms, compatibility with the displacements, what is continuous at interfaces, the largest ones with their errors,
//! and nothing where none are asked for.

use crate::common;

use common::{bare, coated, one_level, paraboloid};
use percoat::run::StressRequest;
use percoat::stress::{Compliance, Peak, StrainState};
use percoat::{
    Bodies, Cell, Depth, Friction, GivenPressure, HalfSpace, Indenters, Interface, Lattice, Layer, Level, Load,
    LoadedDisc, Material, MeanStress, Problem, Run, Sampling, Settings, Shape, Solver, Step, StressField, StressFields,
    StressReading,
};
use serde_json::Value;

fn young(young: f64, poisson: f64) -> Material {
    Material::from_young(young, poisson).unwrap()
}

fn square() -> Lattice {
    Lattice::square(1.0, 1).unwrap()
}

fn window(side: f64) -> Lattice {
    Lattice::new(Cell::window([side; 2]).unwrap(), vec![vec![[0.5; 2]]]).unwrap()
}

fn solved(problem: Problem, points: usize, load: Load) -> Step {
    let settings = Settings { tolerance: 1e-10, ..Settings::default() };
    let step = Solver::new(problem, [points; 2], settings).unwrap().solve(load);
    assert!(step.report.stop.solved(), "{}", step.report);
    step
}

/// The largest stresses and strains of a step.
fn largest(step: &Step, mean: MeanStress) -> StressReading {
    StressReading::of(step, &step.reading(), &StressFields::new(step.finest(), mean).with_strains(true))
}

fn disc_on(material: Material) -> Step {
    let disc = LoadedDisc { centre: [0.0; 2], radius: 1.0, pressure: 0.7 };
    let given = GivenPressure::discs(Cell::window([4.0; 2]).unwrap(), vec![disc]).unwrap();
    let force = given.force();
    solved(Problem::new(given, HalfSpace::new(vec![], material)), 160, Load::Force(force))
}

/// Below the middle of a disc (Foster and Ahlvin 1954; Love 1929), with t = z/√(a² + z²),
///
/// ε_z = −(1 + ν)(p/E)[1 − 2ν + 2νt − t³],  ε_r = −½(1 + ν)(p/E)[1 − 2ν − 2(1 − ν)t + t³].
///
/// −ε_z is largest where t² = 2ν/3. The samples leave errors of the order (d/z)²/24, at the least depth 4e-4.
#[test]
fn strains_below_a_disc_have_their_closed_forms() {
    let (p, modulus) = (0.7, 2.0);
    for nu in [0.0, 0.3, 0.5] {
        let material = young(modulus, nu);
        let step = disc_on(material);
        let field = StressField::new(step.finest(), MeanStress::HalfSpace);
        let size = (1.0 + nu) * p / modulus;
        let axial = |t: f64| -size * (1.0 - 2.0 * nu + 2.0 * nu * t - t.powi(3));
        for z in [0.25, 0.5, 1.0, 2.0, 5.0] {
            let strain = Compliance::from(material).strain(&field.points(Depth { z, material: 1 }, &[[0.0; 2]])[0]);
            let t = z / f64::hypot(1.0, z);
            let radial = -0.5 * size * (1.0 - 2.0 * nu - 2.0 * (1.0 - nu) * t + t.powi(3));
            for (found, known) in [(strain.zz, axial(t)), (strain.xx, radial), (strain.yy, radial)] {
                assert!((found - known).abs() < 7e-4 * size, "{nu}, {z}: {found}, {known}");
            }
            let [first, _, last] = strain.principal();
            assert!((first - radial.max(axial(t))).abs() < 7e-4 * size, "{nu}, {z}: {first}");
            assert!((last - radial.min(axial(t))).abs() < 7e-4 * size, "{nu}, {z}: {last}");
        }
        // ν = 0 has its largest compression on the surface, where −ε_z is the pressure over E up to the edge.
        let known = -axial((2.0 * nu / 3.0).sqrt());
        let stated = largest(&step, MeanStress::HalfSpace).overall.compression.unwrap();
        let off = (stated.value - known).abs();
        // Near the surface the waves of the grid may ring.
        let most = if nu > 0.0 { 0.02 * known } else { 0.15 * known };
        assert!(off < stated.error.unwrap() && stated.error.unwrap() < most, "{nu}: {stated:?}, {known}");
        if nu > 0.0 {
            let z = stated.position[2];
            assert!((z / f64::hypot(1.0, z) / (2.0 * nu / 3.0).sqrt() - 1.0).abs() < 1e-2, "{nu}: {stated:?}");
        }
    }
}

/// Central differences of the displacements off the axis of an isolated contact, in both bodies, under friction, in a coating and below
/// it, in an incompressible material and above a rigid base.
#[test]
fn strains_are_the_slopes_of_the_displacements() {
    let layer = |material: Material| Layer::new(material, 0.3, Interface::Bonded).unwrap();
    let hard = HalfSpace::new(vec![layer(young(4.0, 0.2))], young(1.0, 0.4));
    let rubber = HalfSpace::on_rigid_base(vec![layer(young(1.0, 0.5))]).unwrap();
    let bodies = [Bodies::elastic(hard, HalfSpace::new(vec![], young(2.0, 0.1))), rubber.into(), bare().into()];
    for bodies in bodies {
        let problem = Problem::new(one_level(window(1.6), paraboloid(1.0, 0.0)), bodies);
        let problem = problem.sliding(Friction::new(0.3, [0.6, 0.8]).unwrap().uncoupled()).unwrap();
        let step = solved(problem, 64, Load::Penetration(0.15));
        let fields = StressFields::new(step.finest(), MeanStress::Confined);
        for field in fields.each() {
            for (z, material) in [(0.12, 1), (0.25, 1), (0.5, field.half_space().material_count())] {
                if z > field.half_space().base_depth() {
                    continue;
                }
                let [x, y, h] = [0.17, -0.29, 1e-3];
                let at = |place: [f64; 2], z: f64| field.points(Depth { z, material }, &[place])[0].displacement;
                let slope = |ahead: [f64; 3], behind: [f64; 3]| [0, 1, 2].map(|k| (ahead[k] - behind[k]) / (2.0 * h));
                let [ux, uy, uz] = [
                    slope(at([x + h, y], z), at([x - h, y], z)),
                    slope(at([x, y + h], z), at([x, y - h], z)),
                    slope(at([x, y], z + h), at([x, y], z - h)),
                ];
                let slopes = [ux[0], uy[1], uz[2], 0.5 * (ux[1] + uy[0]), 0.5 * (ux[2] + uz[0]), 0.5 * (uy[2] + uz[1])];
                let state = field.points(Depth { z, material }, &[[x, y]])[0];
                let strain = Compliance::from(field.half_space().material(material)).strain(&state);
                let [first, _, last] = strain.principal();
                let size = first.abs().max(last.abs());
                for (found, slope) in strain.components().into_iter().zip(slopes) {
                    assert!((found - slope).abs() < 2e-3 * size, "{z}, {material}: {strain:?}, {slopes:?}");
                }
            }
        }
    }
}

/// Both sides of a bonded interface are strained alike along it, but for the misfit (1 − ν)σ_r/E of a residual stress; ε_zz jumps.
#[test]
fn bonded_sides_are_strained_alike_along_the_interface() {
    for residual in [0.0, -0.3] {
        let coating = young(3.0, 0.15);
        let layer = Layer::new(coating, 0.1, Interface::Bonded).unwrap().with_residual_stress(residual).unwrap();
        let body = HalfSpace::new(vec![layer], young(1.0, 0.45));
        let problem = Problem::new(one_level(square(), paraboloid(1.0, 0.0)), body.clone());
        let problem = problem.sliding(Friction::new(0.4, [0.8, 0.6]).unwrap()).unwrap();
        let step = solved(problem, 64, Load::MeanPressure(0.02));
        let misfit = (1.0 - 0.15) * residual / 3.0;
        for mean in [MeanStress::Confined, MeanStress::HalfSpace] {
            let field = StressField::new(step.finest(), mean);
            let at = |material: usize, place: [f64; 2]| -> StrainState {
                let state = field.points(Depth { z: 0.1, material }, &[place])[0];
                Compliance::from(body.material(material)).strain(&state)
            };
            for place in [[0.0, 0.0], [0.13, 0.07], [0.4, -0.3]] {
                let [above, below] = [at(1, place), at(2, place)];
                let size = below.principal()[2].abs();
                for (upper, lower) in
                    [(above.xx - misfit, below.xx), (above.yy - misfit, below.yy), (above.xy, below.xy)]
                {
                    assert!((upper - lower).abs() < 1e-8 * size, "{mean:?}, {residual}: {above:?}, {below:?}");
                }
            }
            let [above, below] = [at(1, [0.0; 2]), at(2, [0.0; 2])];
            assert!((above.zz - below.zz).abs() > 0.1 * below.zz.abs(), "{above:?}, {below:?}");
        }
    }
}

/// On points of both bodies and of each layer no strain is larger than what is stated, which is that of its place.
fn nowhere_larger(step: &Step, words: &str) {
    let fields = StressFields::new(step.finest(), MeanStress::Confined);
    let stated = largest(step, MeanStress::Confined);
    let near = 2.0 * step.grid().spacing();
    for field in fields.each() {
        for number in 1..=field.half_space().material_count() {
            let material = field.half_space().material(number);
            let (compliance, size) = (Compliance::from(material), step.reading().max_pressure / material.young());
            let peaks = stated.in_material(field.half_space().material_id(number)).unwrap();
            type Measure = fn(&StrainState) -> f64;
            let measures: [(Peak, Measure); 3] = [
                (peaks.strain.unwrap(), |strain| strain.principal()[0]),
                (peaks.horizontal_strain.unwrap(), StrainState::horizontal),
                (peaks.compression.unwrap(), |strain| -strain.zz),
            ];
            let (top, bottom) = field.half_space().faces(number);
            let depths = (0..=10).map(|k| top + 0.1 * f64::from(k) * (bottom.min(top + 0.6) - top));
            let places: Vec<[f64; 2]> =
                (0..400).map(|k| [k / 20, k % 20].map(|i| 0.05 * f64::from(i) - 0.475)).collect();
            for z in depths.filter(|z| *z >= near) {
                for state in field.points(Depth { z, material: number }, &places) {
                    for (peak, of) in measures {
                        let found = of(&compliance.strain(&state));
                        assert!(found <= peak.value + peak.error.unwrap(), "{words}, {number}, {z}: {found}, {peak:?}");
                    }
                }
            }
            for (peak, of) in measures {
                let [x, y, z] = peak.position;
                // Beyond the window of an isolated contact a step has no single values.
                if z < near || !step.grid().cell().contains([x, y]) {
                    continue;
                }
                let there = of(&compliance.strain(&field.points(Depth { z, material: number }, &[[x, y]])[0]));
                // The search leaves out waves of less than e⁻²⁵ of their pressure.
                assert!((there - peak.value).abs() <= 1e-7 * size, "{words}, {number}: {there}, {peak:?}");
            }
        }
    }
}

#[test]
fn no_place_is_strained_more_than_is_stated() {
    let contact = |lattice: Lattice, bodies: Bodies| Problem::new(one_level(lattice, paraboloid(1.0, 0.0)), bodies);
    let slid = |problem: Problem| problem.sliding(Friction::new(0.3, [1.0, 0.5]).unwrap()).unwrap();
    let hard = || coated(3.0, 0.1, [0.2, 0.4], Interface::Bonded);
    let layer = Layer::new(young(1.0, 0.45), 0.2, Interface::Bonded).unwrap();
    let stressed =
        Layer::new(young(2.0, 0.2), 0.1, Interface::Frictionless).unwrap().with_residual_stress(-0.05).unwrap();
    let rigid = HalfSpace::on_rigid_base(vec![layer]).unwrap();
    let cases: [(&str, Problem, Load); 6] = [
        ("friction", slid(contact(square(), hard().into())), Load::MeanPressure(0.02)),
        ("isolated", contact(window(1.0), hard().into()), Load::Force(0.02)),
        ("rigid base", contact(square(), rigid.into()), Load::MeanPressure(0.02)),
        ("two bodies", contact(square(), Bodies::elastic(hard(), bare())), Load::MeanPressure(0.02)),
        (
            "residual",
            contact(square(), HalfSpace::new(vec![stressed], young(1.0, 0.3)).into()),
            Load::MeanPressure(0.02),
        ),
        ("incompressible", contact(square(), HalfSpace::new(vec![], young(1.0, 0.5)).into()), Load::MeanPressure(0.02)),
    ];
    for (words, problem, load) in cases {
        nowhere_larger(&solved(problem, 48, load), words);
    }
}

/// Cones of the slope 0.1 on a body of Poisson's ratio `nu`, sliding with friction `mu`.
fn cones(nu: f64, mu: f64, points: usize) -> Step {
    let level = Level::new(Shape::Cone { slope: 0.1 }, 0.0).unwrap();
    let problem = Problem::new(Indenters::new(square(), vec![level]).unwrap(), HalfSpace::new(vec![], young(1.0, nu)));
    let friction = Friction::new(mu, [1.0, 0.0]).unwrap().uncoupled();
    solved(problem.sliding(friction).unwrap(), points, Load::MeanPressure(0.005))
}

/// Near a tip σ_z = −p, σ_x = σ_y = −(½ + ν)p and σ_xz = −μp, and p grows without bound: so do the strains of these stresses where they
/// are positive.
#[test]
fn strains_under_a_tip_are_infinite_where_they_grow_with_the_pressure() {
    for (nu, mu, is_infinite) in [
        // (1 − 2ν)/√2 = 0.283
        (0.3, 0.2, [false, false, true]),
        (0.3, 0.35, [true, false, true]),
        (0.5, 0.1, [true, false, false]),
        (0.5, 0.0, [false, false, false]),
    ] {
        let of = |points: usize| {
            let step = cones(nu, mu, points);
            let state = StressField::new(step.finest(), MeanStress::Confined).points(Depth::SURFACE, &[[0.0; 2]])[0];
            let strain = Compliance::from(young(1.0, nu)).strain(&state);
            (step.pressure()[[0, 0]], [strain.principal()[0], strain.horizontal(), -strain.zz], step)
        };
        let ((coarse, less, _), (fine, more, step)) = (of(48), of(96));
        // The strains of the grid over its pressure at the tip grow toward these.
        let (normal, shear) = ((1.0 + nu) * (1.0 - 2.0 * nu), (1.0 + nu) * mu);
        let first = -0.75 * normal + f64::hypot(0.25 * normal, shear);
        let grown = [0, 1, 2].map(|k| (more[k] - less[k]) / (fine - coarse));
        for (found, known) in grown.into_iter().zip([first, -0.5 * normal, normal]) {
            assert!((found - known).abs() < 0.1, "{nu}, {mu}: {grown:?}, {known}");
        }
        let found = largest(&step, MeanStress::Confined);
        let infinite = |peak: Option<Peak>| peak.unwrap().value.is_infinite();
        let overall = found.overall;
        assert_eq!(
            [overall.strain, overall.horizontal_strain, overall.compression].map(infinite),
            is_infinite,
            "{nu}, {mu}"
        );
    }
}

fn run(strain: bool) -> Value {
    let problem =
        Problem::new(one_level(square(), paraboloid(1.0, 0.0)), coated(3.0, 0.1, [0.2, 0.4], Interface::Bonded));
    let run = Run::new(problem, vec![Load::MeanPressure(0.02)], Sampling::Points([48; 2]));
    let run = Run { stress: Some(StressRequest { strain, ..StressRequest::default() }), ..run };
    serde_json::to_value(&run.solve(&mut ()).unwrap().steps[0]).unwrap()
}

/// Without strains a record is as it was before there were any; with them it has three more entries beside the stresses, which stay.
#[test]
fn a_record_has_strains_where_they_are_asked_for_and_no_other_number_changes() {
    let keys = ["max_strain", "max_horizontal_strain", "max_vertical_compression"];
    let (mut asked, without) = (run(true), run(false));
    assert!(keys.iter().all(|key| !without.to_string().contains(key)));
    let stress = asked["stress"].as_object_mut().unwrap();
    let mut found = Vec::new();
    keys.iter().for_each(|key| found.extend(stress.shift_remove(*key)));
    for list in ["materials", "faces"] {
        for row in stress[list].as_array_mut().unwrap() {
            keys.iter().for_each(|key| found.extend(row.as_object_mut().unwrap().shift_remove(*key)));
        }
    }
    // Over all, of two materials, and of three faces.
    assert_eq!(found.len(), 3 * (1 + 2 + 3));
    assert!(found.iter().all(|peak| peak["value"].is_number() && peak["error"].is_number() && peak["z"].is_number()));
    let mut without = without;
    for value in [&mut asked, &mut without] {
        value.as_object_mut().unwrap().shift_remove("seconds");
    }
    assert_eq!(asked, without);
}
