//! A given pressure in the place of a counterbody: closed forms, published pavements, both kinds of surroundings, limits.

use ndarray::Array2;
use percoat::body::{Durability, InterfaceStrength, Strength};
use percoat::localized::{disc, point::PointKernel};
use percoat::reading::Criterion;
use percoat::run::{At, SearchEnd, StressRequest};
use percoat::{
    Cell, Depth, Friction, GivenPressure, HalfSpace, Interface, Layer, Load, LoadedDisc, Material, MeanStress, Problem,
    Route, Run, Sampling, Settings, Solver, Step, StressField, StressState,
};
use std::f64::consts::PI;

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
    assert!((reading.max_pressure / p - 1.0).abs() < 1e-3, "{}", reading.max_pressure);
    assert!(reading.errors.max_pressure.is_some_and(|error| error < 1e-3 * p), "{:?}", reading.errors);
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

/// Strains in the order xx, yy, zz, in compression positive, of 10⁻⁶.
fn strains(state: &StressState, material: Material) -> [f64; 3] {
    let [x, y, z] = [state.xx, state.yy, state.zz];
    let nu = material.poisson();
    [x - nu * (y + z), y - nu * (x + z), z - nu * (x + y)].map(|strain| -1e6 * strain / material.young())
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
/// pressure jumps and the waves of the grid ring: the largest tension differs from σ_r by less than its stated error.
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
    for tension in [coarse.faces[0].tension, fine.faces[0].tension] {
        let error = tension.error.unwrap();
        assert!((tension.value - 0.2 * p).abs() < error && error < 0.25 * p, "{tension:?}");
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
    // Of two discs above each other the pressures add.
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
        assert!(record.is_given() && record.converged() && record.rough.is_none() && record.strength.len() == 3);
        // What is given has no contact stiffness.
        assert!(record.contact_stiffness.is_none());
        let limits = run.limits(&mut ()).unwrap();
        for own in &record.strength {
            let limit = limits.limits.iter().find(|limit| limit.criterion == own.criterion).unwrap();
            let At::Load { load, .. } = limit.at else { panic!("{radius}: {limit:?}") };
            assert!((load * own.value / force - 1.0).abs() < 2e-3, "{:?}: {load}, {}", own.criterion, own.value);
            assert!(radius < 0.1 || own.error.is_some_and(|error| error < 0.02 * own.value), "{own:?}");
        }
        assert!(Criterion::all(run.problem.bodies()).len() == 3);
    }
}
