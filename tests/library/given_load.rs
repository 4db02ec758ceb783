//! A given pressure in the place of a counterbody: closed forms, published pavements, both kinds of surroundings, limits.

use crate::common::Random;
use ndarray::Array2;
use percoat::body::{Durability, InterfaceStrength, Strength};
use percoat::life::{First, LifeEnd, LifeTask};
use percoat::localized::{disc, point::PointKernel};
use percoat::reading::Criterion;
use percoat::run::{At, SearchEnd, StressRequest};
use percoat::stress::Compliance;
use percoat::{
    Cell, Depth, Friction, GivenPressure, Grid, HalfSpace, Interface, Layer, Load, LoadedDisc, Material, MeanStress,
    Problem, Route, Run, Sampling, Settings, Solver, Step, StrainDirection, StrainLife, StressField, StressFields,
    StressReading, StressState,
};
use std::f64::consts::PI;
use std::sync::Arc;

fn young(young: f64, poisson: f64) -> Material {
    Material::from_young(young, poisson).unwrap()
}

fn disc(centre: [f64; 2], radius: f64, pressure: f64) -> LoadedDisc {
    LoadedDisc { centre, radius, pressure }
}

fn window(sides: [f64; 2], discs: &[LoadedDisc]) -> GivenPressure {
    GivenPressure::discs(Cell::window(sides).unwrap(), discs.to_vec()).unwrap()
}

/// The step under a given pressure as it is.
fn loaded(given: GivenPressure, body: &HalfSpace, points: [usize; 2]) -> Step {
    let force = given.force();
    let step =
        Solver::new(Problem::new(given, body.clone()), points, Settings::default()).unwrap().solve(Load::Force(force));
    assert!(step.report.stop.solved() && step.report.route == Route::Given, "{}", step.report);
    assert!((step.reading().force / force - 1.0).abs() < 1e-12);
    step
}

/// Under the middle of a disc on a half-space w = 2(1 − ν²)pa/E, at its edge 2/π of it, and on the axis (Love 1929)
/// σ_z = −p[1 − z³/(a² + z²)^{3/2}], σ_r = −½p[1 + 2ν − 2(1 + ν)z/√(a² + z²) + z³/(a² + z²)^{3/2}]. The samples leave
/// errors of the order (d/z)²/24, at the least depth 4e-4.
#[test]
fn a_disc_on_a_half_space_has_its_closed_forms() {
    let (a, p, nu) = (1.0, 0.7, 0.3);
    let body = HalfSpace::new(vec![], young(2.0, nu));
    let step = loaded(window([4.0, 4.0], &[disc([0.0, 0.0], a, p)]), &body, [160; 2]);
    let reading = step.reading();
    let deepest = 2.0 * (1.0 - nu * nu) * p * a / 2.0;
    assert!((reading.penetration / deepest - 1.0).abs() < 2e-4, "{}", reading.penetration);
    assert!((reading.penetration / deepest - 1.0).abs() * deepest < reading.errors.penetration.unwrap());
    let w = step.displacement();
    assert!((w[[80, 80]] / deepest - 1.0).abs() < 2e-4 && (w[[120, 80]] / deepest * PI / 2.0 - 1.0).abs() < 2e-3);
    assert!((reading.contact_area / (PI * a * a) - 1.0).abs() < 1e-12 && reading.levels.is_empty());
    assert!((reading.max_pressure / p - 1.0).abs() < 1e-12, "{}", reading.max_pressure);
    assert_eq!(reading.errors.max_pressure, Some(0.0));
    let field = StressField::new(step.finest(), MeanStress::HalfSpace);
    for z in [0.25, 0.5, 1.0, 2.0, 5.0] {
        let state = field.points(Depth { z, material: 1 }, &[[0.0, 0.0]])[0];
        let s = (a * a + z * z).sqrt();
        let axial = -p * (1.0 - (z / s).powi(3));
        let radial = -0.5 * p * (1.0 + 2.0 * nu - 2.0 * (1.0 + nu) * z / s + (z / s).powi(3));
        for (found, known) in [(state.zz, axial), (state.xx, radial), (state.yy, radial)] {
            assert!((found - known).abs() < 5e-4 * p, "{z}: {found}, {known}");
        }
    }
}

/// On the axis of a disc, with c = z/√(a² + z²), Hooke's law of the stresses above gives −ε_zz = (1 + ν)p/E [1 − 2ν + 2νc − c³], largest
/// at c² = 2ν/3, and ε_r = (1 + ν)p/E [(1 − ν)c − ½c³ − ½(1 − 2ν)], largest at c² = ⅔(1 − ν); at ν = 0.45 nothing off the axis is larger.
/// Passes are N₀(ε₀/ε)^n, and the load at which they are N₀ is in proportion.
#[test]
fn passes_by_strain_under_a_disc_are_those_of_its_closed_forms() {
    let (a, p, nu, modulus) = (1.0, 0.1, 0.45, 50.0);
    let scale = (1.0 + nu) * p / modulus;
    let [down, out] = [2.0 * nu / 3.0, 2.0 * (1.0 - nu) / 3.0].map(f64::sqrt);
    let compression = scale * (1.0 - 2.0 * nu + 2.0 * nu * down - down.powi(3));
    let tension = scale * ((1.0 - nu) * out - 0.5 * out.powi(3) - 0.5 * (1.0 - 2.0 * nu));
    for (direction, strain, c) in
        [(StrainDirection::Compression, compression, down), (StrainDirection::Tension, tension, out)]
    {
        let law = StrainLife::new(1e-3, 1e6, 4.0, direction).unwrap();
        let durability = Durability { strain_life: Some(law), ..Durability::default() };
        let body = HalfSpace::new(vec![], young(modulus, nu)).with_substrate_durability(durability).unwrap();
        let given = window([4.0, 4.0], &[disc([0.0, 0.0], a, p)]);
        let force = given.force();
        let run = Run::new(Problem::new(given, body), vec![Load::Force(force)], Sampling::Points([160; 2]));
        let record = &run.solve(&mut ()).unwrap().steps[0];
        let known = 1e6 * (1e-3 / strain).powi(4);
        let life = record.fatigue.as_ref().unwrap().first;
        let error = life.error.unwrap();
        assert!((life.passes / known - 1.0).abs() < error && error < 0.02, "{life:?}, {known}");
        let depth = a * c / (1.0 - c * c).sqrt();
        assert!((life.position[2] / depth - 1.0).abs() < 0.02, "{life:?}, {depth}");
        let [taken] = record.strength[..] else { panic!("{:?}", record.strength) };
        assert!((taken.value / (strain / 1e-3) - 1.0).abs() < 0.005 && taken.value * 1e-3 == life.range, "{taken:?}");
        assert!((life.error.unwrap() / (4.0 * taken.error.unwrap() / taken.value) - 1.0).abs() < 1e-12);
        let limits = run.limits(&mut ()).unwrap();
        let At::Load { load, .. } = limits.limits[0].at else { panic!("{limits}") };
        assert!((load * taken.value / force - 1.0).abs() < 2e-3, "{load}");
        // Nothing comes off: a life ends with the first failure.
        let task = LifeTask {
            problem: Arc::clone(&run.problem),
            load: Load::Force(force),
            sampling: run.sampling,
            settings: run.settings,
            mean: MeanStress::default(),
            passes: None,
            distance: None,
            stroke: None,
            tolerance: 1e-2,
            motions: None,
        };
        task.check().unwrap();
        let begun = task.beginning(&|_| true, &|| true).unwrap();
        let state = task.advance(task.unworn(&begun), &begun, &|| true).unwrap();
        assert_eq!((state.passes, state.end, state.events.len()), (life.passes, Some(LifeEnd::Passes), 0));
        assert_eq!(First::of(&task, &begun, &state).map(|first| first.passes), Some(life.passes));
    }
}

/// Strains in the order xx, yy, zz, in compression positive, of 10⁻⁶.
fn strains(state: &StressState, material: Material) -> [f64; 3] {
    let [x, y, z, ..] = Compliance::from(material).strain(state).components();
    [x, y, z].map(|strain| -1e6 * strain)
}

/// The pavement of the European benchmark of programs: 260 mm of 5000 MPa on 500 mm of 200 MPa on 50 MPa.
fn pavement(first: Interface) -> HalfSpace {
    let layers = [(5000.0, 0.35, 260.0, first), (200.0, 0.4, 500.0, Interface::Bonded)];
    let layer = |(modulus, nu, h, interface)| Layer::new(young(modulus, nu), h, interface).unwrap();
    HalfSpace::new(layers.map(layer).to_vec(), young(50.0, 0.45))
}

/// European Commission, *Advanced models for analytical design of European pavement structures* (AMADEUS, 2000), as the programs BISAR
/// and GAMES give it and the examples of ALVA quote it: horizontal strain below the asphalt, vertical strains on top of the base and of the subgrade, in 10⁻⁶ and
/// compression positive, under the middle of a single wheel and at its edge, and under a tyre of two and between them. Printed are
/// tenths for one wheel and whole numbers for two: the tolerance is what rounding leaves, half a digit, and for what the samples
/// damp 3e-4; the base is read 0.01 to 0.1 mm below the interface, which changes it by 2e-4. The two programs differ by up to a digit.
#[test]
fn pavements_have_their_published_strains() {
    let body = pavement(Interface::Bonded);
    let at = |field: &StressField, [x, y]: [f64; 2], component: usize| -> [f64; 3] {
        let of = |z: f64, material: usize, component: usize| {
            strains(&field.points(Depth { z, material }, &[[x, y]])[0], body.material(material))[component]
        };
        [of(260.0, 1, component), of(260.0, 2, 2), of(760.0, 3, 2)]
    };
    let single = loaded(window([800.0, 800.0], &[disc([0.0, 0.0], 150.8, 0.7)]), &body, [200; 2]);
    let field = StressField::new(single.finest(), MeanStress::HalfSpace);
    for (place, published) in [([0.0, 0.0], [-100.5, 251.6, 185.1]), ([150.8, 0.0], [-61.9, 192.2, 177.5])] {
        for (found, known) in at(&field, place, 0).into_iter().zip(published) {
            assert!((found - known).abs() < 0.1 + 1e-3 * known.abs(), "{place:?}: {found}, {known}");
        }
    }
    // The published strains are the largest ones at the bottom of the asphalt and on top of the base and the subgrade.
    let fields = StressFields::new(single.finest(), MeanStress::HalfSpace).with_strains(true);
    let stress = StressReading::of(&single, &single.reading(), &fields);
    let [_, bottom, base, _, subgrade] = &stress.faces[..] else { panic!("{stress:?}") };
    let found = [bottom.horizontal_strain, base.compression, subgrade.compression].map(Option::unwrap);
    for (peak, published) in found.into_iter().zip([100.5, 251.6, 185.1]) {
        let error = 1e6 * peak.error.unwrap();
        assert!((1e6 * peak.value - published).abs() < error.max(0.1 + 1e-3 * published), "{peak:?}, {published}");
        assert!(error < 0.01 * published && peak.position[0].hypot(peak.position[1]) < 5.0, "{peak:?}");
    }
    let tyres = [disc([-170.0, 0.0], 106.6, 0.7), disc([170.0, 0.0], 106.6, 0.7)];
    let dual = loaded(window([800.0, 400.0], &tyres), &body, [200, 100]);
    let field = StressField::new(dual.finest(), MeanStress::HalfSpace);
    for (place, published) in [([170.0, 0.0], [-85.0, 186.0, 170.0]), ([0.0, 0.0], [-89.0, 183.0, 177.0])] {
        for (found, known) in at(&field, place, 1).into_iter().zip(published) {
            assert!((found - known).abs() < 0.5 + 5e-4 * known.abs(), "{place:?}: {found}, {known}");
        }
    }
}

/// The deflection of a layered body, from the middle of a disc to three radii, against the integral of its Hankel transform over the
/// wavenumbers, another program's way.
#[test]
fn deflections_are_those_of_the_hankel_integral() {
    for body in [pavement(Interface::Bonded), pavement(Interface::Frictionless)] {
        let (a, p) = (150.0, 0.7);
        let step = loaded(window([1000.0, 1000.0], &[disc([0.0, 0.0], a, p)]), &body, [250; 2]);
        let kernel = PointKernel::new(&body, 2000.0);
        for r in [0.0, 60.0, 300.0, 452.0] {
            let exact = p * disc::displacement(&kernel, a, r);
            let found = step.displacement()[[125 + (r / 4.0) as usize, 125]];
            assert!((found / exact - 1.0).abs() < 3e-4, "{r}: {found}, {exact}");
        }
    }
}

/// A field of the same numbers is the same load; by the largest deflection it is scaled; displacements and stresses are proportional.
#[test]
fn a_field_is_a_load_and_loads_are_proportional() {
    let body = HalfSpace::new(vec![Layer::new(young(3.0, 0.2), 0.2, Interface::Bonded).unwrap()], young(1.0, 0.3));
    for cell in [Cell::window([2.0; 2]).unwrap(), Cell::hexagonal(2.0).unwrap()] {
        let discs = vec![disc([0.1, 0.2], 0.4, 0.03)];
        let given = GivenPressure::discs(cell, discs).unwrap();
        let one = loaded(given.clone(), &body, [48; 2]);
        let field = GivenPressure::field(cell, one.pressure().to_owned()).unwrap();
        let two = loaded(field, &body, [48; 2]);
        assert!(one.displacement().iter().zip(&two.displacement()).all(|(a, b)| (a - b).abs() < 1e-14));
        let mut solver = Solver::new(Problem::new(given, body.clone()), [48; 2], Settings::default()).unwrap();
        let deeper = solver.solve(Load::Penetration(3.0 * one.penetration()));
        assert!((deeper.reading().force / one.reading().force - 3.0).abs() < 1e-12);
        let largest = deeper.displacement().iter().copied().fold(0.0, f64::max);
        assert!((deeper.penetration() / largest - 1.0).abs() < 1e-14);
        let [single, triple] = [&one, &deeper].map(|step| {
            StressField::new(step.finest(), MeanStress::Confined).points(Depth { z: 0.2, material: 2 }, &[[0.1, 0.3]])
                [0]
        });
        for (one, three) in single.components().into_iter().zip(triple.components()) {
            assert!((three - 3.0 * one).abs() < 1e-13, "{one}, {three}");
        }
    }
}

/// A uniform field on a periodic cell displaces nothing but a layer on a rigid base, by p h/M; on discs the mean is that of the force.
#[test]
fn periodic_loads_displace_their_mean_on_a_rigid_base_alone() {
    let layer = Layer::new(young(2.0, 0.3), 0.5, Interface::Bonded).unwrap();
    let cell = Cell::square(1.0).unwrap();
    let uniform = GivenPressure::field(cell, Array2::from_elem([8, 8], 0.01)).unwrap();
    let on_half_space = loaded(uniform.clone(), &HalfSpace::new(vec![layer], young(1.0, 0.3)), [32; 2]);
    assert!(on_half_space.displacement().iter().all(|w| w.abs() < 1e-15));
    let rigid = HalfSpace::on_rigid_base(vec![layer]).unwrap();
    let compressed = 0.01 * rigid.mean_compliance();
    let step = loaded(uniform, &rigid, [32; 2]);
    assert!(step.displacement().iter().all(|w| (w / compressed - 1.0).abs() < 1e-12));
    let given = GivenPressure::discs(cell, vec![disc([0.9, 0.5], 0.3, 0.02)]).unwrap();
    let mean = given.force() * rigid.mean_compliance();
    assert!((loaded(given, &rigid, [48; 2]).displacement().mean().unwrap() / mean - 1.0).abs() < 1e-12);
}

/// A braking tyre: below the disc the shear stress is that of the traction, and the surface moves with it. Far below, the traction is
/// a point force: σ_xz is even, σ_zz odd along the traction.
#[test]
fn a_braking_load_draws_the_surface_along() {
    let body = HalfSpace::new(vec![], young(1.0, 0.3));
    let given = window([3.0, 3.0], &[disc([0.0, 0.0], 0.5, 0.01)]);
    let force = given.force();
    let friction = Friction::new(0.6, [1.0, 0.0]).unwrap();
    let problem = Problem::new(given, body).sliding(friction).unwrap();
    let step = Solver::new(problem, [120; 2], Settings::default()).unwrap().solve(Load::Force(force));
    let field = StressField::new(step.finest(), MeanStress::HalfSpace);
    let at = |x: f64, z: f64| field.points(Depth { z, material: 1 }, &[[x, 0.0]])[0];
    assert!((at(0.0, 0.0).xz / -0.006 - 1.0).abs() < 1e-7, "{:?}", at(0.0, 0.0));
    // In the middle of a uniform traction u_x = (1 − ν/2) q a/G: the integral of (1 − ν)/r + ν x²/r³ over the disc, over 2πG.
    let known = (1.0 - 0.15) / (1.0 / 2.6) * 0.006 * 0.5;
    assert!((at(0.0, 0.0).displacement[0] / known - 1.0).abs() < 2e-3, "{}, {known}", at(0.0, 0.0).displacement[0]);
    // Q x z²/r⁵: σ_zz = −(3Q/2π) x z²/r⁵ of the tangential force on top of −(3P/2π) z³/r⁵.
    let (x, z) = (1.2, 6.0);
    let r = f64::hypot(x, z);
    let odd = 0.5 * (at(x, z).zz - at(-x, z).zz);
    let point = -3.0 * 0.6 * force / (2.0 * PI) * x * z * z / r.powi(5);
    assert!((odd / point - 1.0).abs() < 2e-2, "{odd}, {point}");
}

/// The largest τ₁ under a disc, near its edge, of two grids; and on the surface σ_r = (1 − 2ν)p/2 just outside the edge, where the
/// pressure jumps: the largest stresses differ from it by less than their stated errors.
#[test]
fn largest_stresses_under_a_disc_are_within_their_errors() {
    let p = 0.01;
    let largest = |points: usize| {
        let given = window([3.0, 3.0], &[disc([0.0, 0.0], 0.5, p)]);
        let load = Load::Force(given.force());
        let body = HalfSpace::new(vec![], young(1.0, 0.3));
        let run = Run::new(Problem::new(given, body), vec![load], Sampling::Points([points; 2]));
        let run = Run { stress: Some(StressRequest::default()), ..run };
        run.solve(&mut ()).unwrap().steps[0].stress.clone().unwrap()
    };
    let [coarse, fine] = [64, 128].map(largest);
    let [one, two] = [coarse.overall.tau1, fine.overall.tau1];
    assert!((one.value - two.value).abs() < one.error.unwrap() + two.error.unwrap(), "{one:?}, {two:?}");
    assert!(one.error.unwrap() < 0.6 * one.value, "{one:?}");
    for (stress, most) in [(coarse, 0.05), (fine, 0.02)] {
        // Outside σ_r = −σ_t, without pressure.
        let known =
            [(stress.faces[0].tension, 0.2), (stress.faces[0].tau1, 0.2), (stress.faces[0].mises, 0.2 * 3f64.sqrt())];
        for (found, known) in known {
            let error = found.error.unwrap();
            assert!((found.value - known * p).abs() < error && error < most * p, "{found:?} for {known}");
        }
    }
}

/// A small disc beside a large one: the largest stress is below the small one, whose pressure is higher, at a depth of its own size.
#[test]
fn the_largest_stress_is_found_under_the_smallest_disc() {
    let body = HalfSpace::new(vec![], young(1.0, 0.3));
    let mises = |discs: &[LoadedDisc]| {
        let given = window([6.0, 4.0], discs);
        let load = Load::Force(given.force());
        let run = Run::new(Problem::new(given, body.clone()), vec![load], Sampling::Points([240, 160]));
        let run = Run { stress: Some(StressRequest::default()), ..run };
        run.solve(&mut ()).unwrap().steps[0].stress.clone().unwrap().overall.mises
    };
    let (large, small) = (disc([-0.8, 0.0], 1.2, 0.009), disc([1.6, 0.0], 0.15, 0.011));
    let (both, alone) = (mises(&[large, small]), mises(&[small]));
    let [x, y, z] = both.position;
    assert!((x - 1.6).hypot(y) < 0.15 && z < 0.3, "{both:?}");
    // At the distance ρ = 2.4 the large disc adds σ_r = (1 − 2ν)pa²/(2ρ²) = 4.5e-4, 7 % of the small one's.
    assert!((both.value / alone.value - 1.0).abs() < 0.1, "{both:?}, {alone:?}");
}

/// A given pressure presses nothing in, be it the hardness or twice that; a limit is looked for until it comes near the hardness.
#[test]
fn a_hardness_presses_nothing_in_under_a_given_pressure() {
    let p = 0.04;
    let strength = Strength { yielding: Some(1.0), tensile: None };
    let body = HalfSpace::new(vec![], young(1.0, 0.3)).with_substrate_strength(strength).unwrap();
    let durability = Durability { hardness: Some(p), ..Durability::default() };
    let hard = body.clone().with_substrate_durability(durability).unwrap();
    let given = window([3.0, 3.0], &[disc([0.0, 0.0], 0.5, p)]);
    let force = given.force();
    let path = |body: &HalfSpace| {
        let problem = Problem::new(given.clone(), body.clone());
        let mut solver = Solver::new(problem, [96; 2], Settings::default()).unwrap();
        let steps = [1.0, 2.0, 1.0].map(|factor| {
            let step = solver.solve(Load::Force(factor * force));
            solver.keep_indentation();
            step
        });
        steps.to_vec()
    };
    for (elastic, hard) in path(&body).into_iter().zip(path(&hard)) {
        assert!(hard.report.stop.solved() && hard.indentation().is_none() && hard.finest().hardness().is_infinite());
        assert_eq!((elastic.pressure(), elastic.gap()), (hard.pressure(), hard.gap()));
        assert_eq!(elastic.reading().max_pressure, hard.reading().max_pressure);
    }
    // Pressures of two discs above each other add.
    let twice = window([3.0, 3.0], &[disc([0.0, 0.0], 0.5, 0.5 * p), disc([0.0, 0.0], 0.5, 0.25 * p)]);
    for (given, most) in [(given, 1.0), (twice, 4.0 / 3.0)] {
        let load = Load::Force(given.force());
        let most = 0.999 * most * given.force();
        let limits = Run::new(Problem::new(given, hard.clone()), vec![load], Sampling::Points([96; 2])).limits(&mut ());
        let limits = limits.unwrap();
        let At::Never { up_to, end, .. } = limits.limits[0].at else { panic!("{limits}") };
        assert!(end == SearchEnd::Hardness && (up_to / most - 1.0).abs() < 1e-9, "{limits}");
        assert!(limits.to_string().contains("0.999 of the most that the hardness") && limits.converged(), "{limits}");
    }
}

/// Under a given pressure stresses are proportional to it: the load at which something fails follows from the utilisation.
#[test]
fn the_limit_is_the_load_over_its_utilisation() {
    let strength = Strength { yielding: Some(0.05), tensile: None };
    let layer = Layer::new(young(5.0, 0.25), 0.3, Interface::Bonded).unwrap();
    let layer = layer.with_strengths(strength, InterfaceStrength { shear: Some(0.02), ..Default::default() }).unwrap();
    let body = HalfSpace::new(vec![layer], young(1.0, 0.3)).with_substrate_strength(strength).unwrap();
    // The small disc has two samples along its radius.
    for radius in [0.5, 0.07] {
        let given = window([3.0, 3.0], &[disc([0.0, 0.0], radius, 0.04)]);
        let force = given.force();
        let run = Run::new(Problem::new(given, body.clone()), vec![Load::Force(force)], Sampling::Points([96; 2]));
        let outcome = run.solve(&mut ()).unwrap();
        let record = &outcome.steps[0];
        assert!(record.kind().is_given && record.converged() && record.rough.is_none() && record.strength.len() == 3);
        // A given pressure has no contact stiffness.
        assert!(record.contact_stiffness.is_none());
        let limits = run.limits(&mut ()).unwrap();
        for row in &record.strength {
            let limit = limits.limits.iter().find(|limit| limit.criterion == row.criterion).unwrap();
            let At::Load { load, .. } = limit.at else { panic!("{radius}: {limit:?}") };
            assert!((load * row.value / force - 1.0).abs() < 2e-3, "{:?}: {load}, {}", row.criterion, row.value);
            assert!(radius < 0.1 || row.error.is_some_and(|error| error < 0.02 * row.value), "{row:?}");
        }
        assert!(Criterion::all(run.problem.bodies()).len() == 3);
    }
}

/// However fine the grid is, and wherever the disc lies on it: samples whose cells lie outside have no pressure, those inside all of it.
#[test]
fn a_cell_outside_of_a_disc_has_no_pressure_and_one_inside_has_all_of_it() {
    for (side, points) in [(8.0, 180), (8.0, 216), (8.0, 333), (16.0, 480)] {
        let given = window([side; 2], &[disc([-0.37, 0.11], 1.508, 0.7)]);
        let grid = Grid::new(given.cell(), [points; 2]).unwrap();
        let half = 0.5 * side / points as f64;
        for ((i, j), &p) in given.on(&grid).indexed_iter() {
            let [x, y] = given.cell().point([i as f64 / points as f64, j as f64 / points as f64]);
            let [x, y] = [(x + 0.37).abs(), (y - 0.11).abs()];
            let (nearest, farthest) = ((x - half).max(0.0).hypot((y - half).max(0.0)), (x + half).hypot(y + half));
            assert!(p == 0.0 || nearest < 1.508 * (1.0 + 1e-12), "{points}: {p:e} at {i}, {j}");
            assert!(p == 0.7 || farthest > 1.508 * (1.0 - 1e-12), "{points}: {p} at {i}, {j}");
        }
    }
}

/// The largest pressure of overlapping discs, periodic images included, is the sum of all that overlap in one place.
#[test]
fn the_largest_pressure_is_that_of_the_discs_that_overlap_in_one_place() {
    let highest = |cell: Cell, discs: &[LoadedDisc]| GivenPressure::discs(cell, discs.to_vec()).unwrap().highest();
    let (wide, square) = (Cell::window([8.0; 2]).unwrap(), Cell::square(1.0).unwrap());
    let three = [disc([0.0, 0.0], 1.0, 1.0), disc([1.5, 0.0], 1.0, 2.0), disc([0.75, 1.0], 0.3, 4.0)];
    // The small disc reaches both others, but not the lens that they share.
    assert_eq!(highest(wide, &three), 6.0);
    assert_eq!(highest(wide, &[three[0], three[0], three[1]]), 4.0);
    // One inside of another, and two that touch.
    assert_eq!(highest(wide, &[disc([0.0, 0.0], 1.0, 1.0), disc([0.2, 0.1], 0.3, 0.5)]), 1.5);
    assert_eq!(highest(wide, &[disc([-1.0, 0.0], 1.0, 1.0), disc([1.0, 0.0], 1.0, 0.5)]), 1.0);
    for (radius, most) in [(0.4, 1.0), (0.6, 2.0), (0.75, 4.0)] {
        assert_eq!(highest(square, &[disc([0.3, 0.3], radius, 1.0)]), most);
    }
    // Against samples: a region may be narrower than one, but no sample has more.
    let mut random = Random(11);
    for cell in [square, Cell::new([1.0, 0.2], [0.4, 0.9]).unwrap()] {
        let grid = Grid::new(cell, [300; 2]).unwrap();
        let mut equal = 0;
        for _ in 0..20 {
            let draw = |random: &mut Random| {
                disc([random.unit(), random.unit()], 0.15 + 0.4 * random.unit(), 1.0 + random.unit())
            };
            let discs: Vec<LoadedDisc> = (0..4).map(|_| draw(&mut random)).collect();
            let given = GivenPressure::discs(cell, discs).unwrap();
            let (found, sampled) = (given.highest(), given.on(&grid).iter().copied().fold(0.0, f64::max));
            assert!(found >= sampled * (1.0 - 1e-12) && found < 1.5 * sampled, "{found}, {sampled}: {given:?}");
            equal += usize::from(found < sampled * (1.0 + 1e-9));
        }
        assert!(equal >= 15, "{equal}");
    }
}

/// The largest stresses of a loaded road on grids that share nothing, even and odd: all agree within their errors, and no error is out of
/// line with those of the other grids.
#[test]
fn stated_errors_under_a_disc_are_smooth_in_the_grid() {
    let asphalt = Layer::new(young(5000.0, 0.35), 260.0, Interface::Bonded).unwrap();
    let base = Layer::new(young(200.0, 0.4), 500.0, Interface::Bonded).unwrap();
    let body = HalfSpace::new(vec![asphalt, base], young(50.0, 0.45));
    let grids = [100, 105, 108, 125];
    let found = grids.map(|points| {
        let given = window([1000.0, 1000.0], &[disc([7.3, -4.1], 150.8, 0.7)]);
        let load = Load::Force(given.force());
        let run = Run::new(Problem::new(given, body.clone()), vec![load], Sampling::Points([points; 2]));
        let run = Run { stress: Some(StressRequest::default()), ..run };
        let step = run.solve(&mut ()).unwrap().steps.remove(0);
        assert!((step.reading.max_pressure / 0.7 - 1.0).abs() < 1e-12, "{points}");
        step.stress.clone().unwrap().overall.tension
    });
    for (points, peak) in grids.iter().zip(&found) {
        let error = peak.error.unwrap();
        assert!(error < 5e-3 * peak.value, "{points}: {peak:?}");
        for other in &found {
            assert!((peak.value - other.value).abs() <= error + other.error.unwrap(), "{points}: {peak:?}, {other:?}");
            assert!(error < 4.0 * other.error.unwrap(), "{points}: {peak:?}, {other:?}");
        }
    }
}

/// The largest stresses on the surface at the edges of discs, on grids that share nothing: bare and coated bodies, in windows and in
/// periodic cells, discs that overlap and discs that touch. All agree within their errors, which fall with the spacing.
#[test]
fn stresses_at_the_edges_of_discs_are_those_of_any_grid() {
    let p = 0.01;
    let coated = |young_of_layer: f64| {
        let layer = Layer::new(young(young_of_layer, 0.2), 0.4, Interface::Bonded).unwrap();
        HalfSpace::new(vec![layer], young(1.0, 0.3))
    };
    let bare = HalfSpace::new(vec![], young(1.0, 0.3));
    let square = Cell::square(2.0).unwrap();
    let pair = [disc([-0.3, 0.1], 0.5, p), disc([0.35, 0.0], 0.4, 0.7 * p)];
    let touching = [disc([-0.4, 0.0], 0.4, p), disc([0.4, 0.0], 0.4, p)];
    let cases = [
        (window([3.0, 3.0], &pair), bare.clone()),
        (window([3.0, 3.0], &pair[..1]), coated(4.0)),
        (window([3.0, 3.0], &touching), coated(0.3)),
        (GivenPressure::discs(square, vec![disc([0.4, 1.9], 0.45, p)]).unwrap(), bare.clone()),
        // A disc of few samples, one of them in its middle.
        (window([3.0, 3.0], &[disc([0.0, 0.0], 0.1, p)]), bare),
    ];
    for (given, body) in cases {
        let is_small = given.loaded_discs()[0].radius < 0.2;
        let found = [72, 90, 125, 144].map(|points| {
            let load = Load::Force(given.force());
            let run = Run::new(Problem::new(given.clone(), body.clone()), vec![load], Sampling::Points([points; 2]));
            let run = Run { stress: Some(StressRequest::default()), ..run };
            let surface = run.solve(&mut ()).unwrap().steps[0].stress.clone().unwrap().faces[0];
            [surface.tension, surface.tau1, surface.mises]
        });
        for (k, one) in found.iter().enumerate() {
            for other in &found[..k] {
                for (one, other) in one.iter().zip(other) {
                    let [a, b] = [one.error.unwrap(), other.error.unwrap()];
                    assert!((one.value - other.value).abs() <= a + b, "{given}, {body}: {one:?}, {other:?}");
                }
            }
        }
        let last = found[3].map(|peak| peak.error.unwrap());
        assert!(last.iter().all(|error| *error < if is_small { 0.5 } else { 0.05 } * p), "{given}, {body}: {last:?}");
    }
}
