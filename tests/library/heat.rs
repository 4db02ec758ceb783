//! Frictional heat of contacts that slide steadily: partition, temperatures, swelling, and where no steady state is unique.

use percoat::body::{Conduction, Depth};
use percoat::heat::HeatedBody;
use percoat::heating::{Heating, HeatingError, Partition};
use percoat::reading::TemperatureReading;
use percoat::run::{NoSteadyState, Run, RunError, Sampling};
use percoat::spectral::{LayeredOperator, Stop, Workspace};
use percoat::steady_motion::SteadyMotion;
use percoat::stress::{TemperatureField, Traction};
use percoat::{
    Bodies, Friction, HalfSpace, Indenters, Interface, Lattice, Layer, Level, Load, Material, MeanStress, Problem,
    Settings, Shape, Solver, Step, StressField, StressFields, SurfaceLine,
};
use rustfft::num_complex::Complex64;

/// A material with λ, κ and α.
fn conducting(young: f64, [conductivity, diffusivity, expansion]: [f64; 3]) -> Material {
    let conduction = Conduction::new(conductivity, diffusivity, expansion).unwrap();
    Material::from_young(young, 0.3).unwrap().with_conduction(Some(conduction))
}

fn bare(young: f64, conduction: [f64; 3]) -> HalfSpace {
    HalfSpace::new(vec![], conducting(young, conduction))
}

fn paraboloid(period: f64, radius: f64) -> Indenters {
    let level = Level::new(Shape::Paraboloid { radius }, 0.0).unwrap();
    Indenters::new(Lattice::square(period, 1).unwrap(), vec![level]).unwrap()
}

fn sliding(indenters: Indenters, bodies: impl Into<Bodies>, coefficient: f64, velocity: f64) -> Problem {
    let friction = Friction::new(coefficient, [1.0, 0.0]).unwrap().uncoupled();
    let motion = SteadyMotion::new(velocity).unwrap();
    Problem::new(indenters, bodies.into()).sliding(friction).unwrap().moving(motion).unwrap()
}

fn solved(problem: Problem, points: usize, load: Load) -> Step {
    let step = Solver::new(problem, [points; 2], Settings::default()).unwrap().solve(load);
    assert!(step.report.stop.solved(), "{step}");
    step
}

/// A Hertzian source of the radius 1 in a cell of the side 8, λ = κ = 1 below λ = 3 at rest, equal mean temperatures: three digits of a
/// prototype on 256² samples. At rest the share is λ₁/(λ₁ + λ₂) everywhere.
#[test]
fn heat_is_shared_so_that_temperatures_are_equal() {
    for (velocity, share) in [(1e-9, 0.25), (1.0, 0.26723), (10.0, 0.38032), (100.0, 0.49692), (1000.0, 0.54370)] {
        let bodies = Bodies::elastic(bare(1e6, [1.0, 1.0, 0.0]), bare(1e6, [3.0, 1.0, 0.0]));
        // a³ = ¾ P R/E*, 1/E* = 2 (1 − ν²)/E.
        let modulus = 1e6 / 1.82;
        let problem = sliding(paraboloid(8.0, 1e3), bodies, 0.3, velocity).heated(Heating::default()).unwrap();
        let step = solved(problem, 256, Load::Force(4.0 / 3.0 * modulus / 1e3));
        let heat = step.finest().heat().unwrap();
        assert!((heat.share - share).abs() < 1.5e-3, "v {velocity}: {}", heat.share);
        let (above, p) = (heat.counterbody.as_ref().unwrap(), step.finest().pressures());
        let span = heat.body.iter().fold(0.0f64, |most, t| most.max(t.abs()));
        for i in (0..p.len()).filter(|&i| p[i] > 0.0) {
            assert!((heat.body[i] - above[i]).abs() < 1e-8 * span, "v {velocity}: {} {}", heat.body[i], above[i]);
            assert!(velocity > 1e-3 || (heat.flux[i] / heat.friction[i] - 0.25).abs() < 1e-6);
        }
        assert!((0..p.len()).all(|i| p[i] > 0.0 || heat.flux[i] == 0.0));
        let reading = TemperatureReading::of(&step).unwrap();
        assert!((reading.counterbody_share - 1.0 + share).abs() < 1.5e-3 && reading.materials.len() == 2);
        assert!(reading.max >= reading.mean_in_contact && reading.criticality == 0.0);
    }
}

/// Hertz at rest in free space: T(0) = π q₀ a/(4λ); periodic less Q S₁/(2πλL), S₁ = −3.900264920.
#[test]
fn a_hertzian_source_has_its_temperature() {
    let modulus = 1e6 / 0.91;
    for (period, points, tolerance) in [(8.0, 256, 1e-3), (16.0, 512, 1e-3)] {
        let problem = sliding(paraboloid(period, 1e3), bare(1e6, [2.0, 1.0, 0.0]), 0.3, 1e-6);
        let problem = problem.heated(Heating::default()).unwrap();
        let step = solved(problem, points, Load::Force(4.0 / 3.0 * modulus / 1e3));
        let heat = step.finest().heat().unwrap();
        let peak = heat.friction.iter().copied().fold(0.0, f64::max);
        let whole = heat.friction.iter().sum::<f64>() * step.grid().sample_area();
        let lone = heat.body[0] + 3.900264920 * whole / (2.0 * std::f64::consts::PI * 2.0 * period);
        let known = std::f64::consts::PI * peak / 8.0;
        // The next term of the lattice sum is of the order (a/L)².
        assert!((lone / known - 1.0).abs() < tolerance + 0.6 / (period * period), "{period}: {lone} {known}");
    }
}

/// E = λ = α = 1, ν = .3, μ = .5 in a cell of the side 1: V = 2λk(1 − ν)/(μαE) = 17.592919, with heat that moves or not.
#[test]
fn beyond_its_threshold_no_steady_state_is_unique() {
    for diffusivity in [1e9, 1.0] {
        let at = |part: f64| {
            let problem = sliding(paraboloid(1.0, 1.0), bare(1.0, [1.0, diffusivity, 1.0]), 0.5, part * 17.592919);
            let problem = problem.heated(Heating::default()).unwrap();
            Solver::new(problem, [64; 2], Settings::default()).unwrap().solve(Load::MeanPressure(0.01))
        };
        let below = at(0.99);
        assert!(below.report.stop.solved(), "{below}");
        let reading = TemperatureReading::of(&below).unwrap();
        assert!((reading.criticality - 0.99).abs() < 1e-6, "{}", reading.criticality);
        assert_eq!(at(1.01).report.stop, Stop::NotUnique);
    }
}

/// A run beyond the threshold is refused, with the part of the compliance that swelling takes: V/V_cr of heat at rest.
#[test]
fn runs_without_a_steady_state_are_refused() {
    let problem = sliding(paraboloid(1.0, 1.0), bare(1.0, [1.0, 1e9, 1.0]), 0.5, 1.5 * 17.592919);
    let problem = problem.heated(Heating::default()).unwrap();
    let run = Run::new(problem, vec![Load::MeanPressure(0.01)], Sampling::Points([64; 2]));
    match run.solve(&mut ()) {
        Err(RunError::NoSteadyState(NoSteadyState { taken })) => assert!((taken - 1.5).abs() < 1e-6, "{taken}"),
        other => panic!("{other:?}"),
    }
}

/// The displacement is that of the pressure and of the heat that is left in the step; a given share is met at once, a solved one in turns.
#[test]
fn the_surface_swells_by_the_heat_that_it_takes() {
    let coated = |conduction| {
        let layer = Layer::new(conducting(3.0, [0.2, 0.4, 3.0]), 0.05, Interface::Bonded).unwrap();
        HalfSpace::new(vec![layer.with_thermal_resistance(0.1).unwrap()], conducting(1.0, conduction))
    };
    for partition in [Partition::Solved, Partition::Share(0.3)] {
        let bodies = Bodies::elastic(coated([1.0, 0.5, 3.0]), bare(2.0, [3.0, 1.0, 1.5]));
        let problem = sliding(paraboloid(1.0, 1.0), bodies.clone(), 0.3, 2.0);
        let heating = Heating::new(partition, [10.0, 10.0]).unwrap();
        let cold = solved(problem.clone().heated(heating.without_expansion()).unwrap(), 64, Load::MeanPressure(0.02));
        let step = solved(problem.heated(heating).unwrap(), 64, Load::MeanPressure(0.02));
        let heat = step.finest().heat().unwrap();
        let mut displaced = step.finest().pressures().to_vec();
        LayeredOperator::new(step.grid(), bodies).displacement(&mut displaced, &mut Workspace::default());
        let (w, size) = (step.displacement(), displaced.iter().fold(0.0f64, |most, w| most.max(w.abs())));
        for (i, w) in w.iter().enumerate() {
            assert!(
                (displaced[i] + heat.swelling[i] - w).abs() < 1e-6 * size,
                "{} {w}",
                displaced[i] + heat.swelling[i]
            );
        }
        let largest = |step: &Step| step.pressure().iter().copied().fold(0.0, f64::max);
        let bulge = heat.swelling.iter().copied().fold(0.0, f64::min);
        assert!(bulge < -0.01 * size && largest(&step) > 1.01 * largest(&cold), "{bulge} {size}");
        let reading = TemperatureReading::of(&step).unwrap();
        assert!(reading.materials.len() == 3 && reading.max > 10.0, "{reading:?}");
        // Behind the resistance of the interface it is colder than on the surface.
        assert!(reading.materials[1].value < reading.materials[0].value);
    }
}

#[test]
fn heat_needs_motion_friction_and_conduction() {
    let plain = Problem::new(paraboloid(1.0, 1.0), bare(1.0, [1.0, 1.0, 0.0]));
    assert_eq!(plain.clone().heated(Heating::default()), Err(HeatingError::Rest));
    let moves = plain.moving(SteadyMotion::new(1.0).unwrap()).unwrap();
    assert_eq!(moves.heated(Heating::default()), Err(HeatingError::Smooth));
    let cold =
        Bodies::elastic(bare(1.0, [1.0, 1.0, 0.0]), HalfSpace::new(vec![], Material::from_young(1.0, 0.3).unwrap()));
    let refused = sliding(paraboloid(1.0, 1.0), cold, 0.3, 1.0).heated(Heating::default()).unwrap_err();
    assert!(refused.to_string().contains("counterbody"), "{refused}");
}

/// A heated contact that slides obliquely, of two coated bodies that expand, on odd numbers of samples.
fn heated_and_coated(velocity: f64) -> Step {
    let coated = |young: f64, thickness: f64, [coat, below]: [[f64; 3]; 2]| {
        let layer = Layer::new(conducting(young, coat), thickness, Interface::Bonded).unwrap();
        HalfSpace::new(vec![layer], conducting(1.0, below))
    };
    let body = coated(3.0, 0.05, [[0.3, 0.1, 2e-3], [1.0, 0.5, 1e-3]]);
    let above = coated(0.5, 0.1, [[2.0, 1.0, 1e-3], [0.7, 0.2, 3e-3]]);
    let friction = Friction::new(0.4, [0.6, -0.8]).unwrap().uncoupled();
    let problem = Problem::new(paraboloid(1.0, 1.0), Bodies::elastic(body, above)).sliding(friction).unwrap();
    let problem = problem.moving(SteadyMotion::new(velocity).unwrap()).unwrap().heated(Heating::default()).unwrap();
    solved(problem, 33, Load::MeanPressure(0.01))
}

/// Waves of a field on odd numbers of samples, by the sum itself: wavevectors with coefficients, without the mean.
fn waves(field: &[f64], n: usize) -> Vec<([f64; 2], Complex64)> {
    let half = (n / 2) as i32;
    let turn = std::f64::consts::TAU / n as f64;
    let all = (-half..=half).flat_map(|k| (-half..=half).map(move |l| [k, l])).filter(|k| *k != [0, 0]);
    let coefficient = |[k, l]: [i32; 2]| {
        let phase = |i: usize| -turn * f64::from((k * (i / n) as i32 + l * (i % n) as i32) % n as i32);
        let sum: Complex64 = field.iter().enumerate().map(|(i, value)| Complex64::cis(phase(i)) * value).sum();
        sum / field.len() as f64
    };
    all.map(|k| (k.map(|k| std::f64::consts::TAU * f64::from(k)), coefficient(k))).collect()
}

/// Stresses by heat in a body with a source along `direction`, wave by wave.
fn by_heat(
    body: &HeatedBody,
    flux: &[([f64; 2], Complex64)],
    direction: [f64; 2],
    depth: Depth,
    x: [f64; 2],
) -> [f64; 6] {
    let mut sum = [0.0; 6];
    for &(k, c) in flux {
        let turned = [k[0] * direction[0] + k[1] * direction[1], k[1] * direction[0] - k[0] * direction[1]];
        let a = body.thermal_stress(turned).at(depth);
        let q = k[0].hypot(k[1]);
        let (c, [nx, ny]) = (c * Complex64::cis(k[0] * x[0] + k[1] * x[1]), [k[0] / q, k[1] / q]);
        let late = Complex64::new(0.0, -1.0) * a.sqz;
        let all = [
            a.sqq * (nx * nx) + a.stt * (ny * ny),
            a.sqq * (ny * ny) + a.stt * (nx * nx),
            a.szz,
            (a.sqq - a.stt) * (nx * ny),
            late * nx,
            late * ny,
        ];
        sum.iter_mut().zip(all).for_each(|(sum, a)| *sum += (a * c).re);
    }
    sum
}

/// Stresses of both bodies are those of the traction and those of the flux into each, summed wave by wave.
#[test]
fn stresses_of_the_load_and_of_the_heat_add_up() {
    let velocity = 3.0;
    let step = heated_and_coated(velocity);
    let (contact, friction) = (step.finest(), *step.finest().problem().friction().unwrap());
    let heat = contact.heat().unwrap();
    let fields = StressFields::new(contact, MeanStress::Confined);
    let bodies = contact.problem().bodies();
    let traction = Traction::normal(contact.grid(), contact.pressure()).unwrap().with_friction(&friction, 0.0);
    let cold = StressFields::under(traction, bodies, MeanStress::Confined);
    let above: Vec<f64> = heat.friction.iter().zip(&heat.flux).map(|(whole, body)| whole - body).collect();
    let sides = [(bodies.on(None), &heat.flux, velocity), (bodies.counterbody().unwrap(), &above, 0.0)];
    for ((half_space, flux, velocity), (hot, cold)) in sides.into_iter().zip(fields.each().zip(cold.each())) {
        let body = HeatedBody::of(half_space, velocity).unwrap();
        let waves = waves(flux, 33);
        for (z, material) in [(0.0, 1), (0.03, 1), (half_space.faces(1).1, 1), (half_space.faces(1).1, 2), (0.2, 2)] {
            let depth = Depth { z, material };
            for x in [[0.0, 0.0], [0.13, -0.07], [0.4, 0.45]] {
                let [hot, cold] = [hot, cold].map(|field| field.points(depth, &[x])[0].components());
                let heated = by_heat(&body, &waves, [0.6, -0.8], depth, x);
                let size = heated.iter().fold(0.0f64, |most, s| most.max(s.abs()));
                let worst = (0..6).map(|k| (hot[k] - cold[k] - heated[k]).abs()).fold(0.0, f64::max);
                // Both fields are sums of the pressure's own stresses, of which rounding is left.
                assert!(worst < 1e-11 + 1e-9 * size && size > 1e-8, "{depth:?} {x:?}: {worst:e} of {size:e}");
            }
        }
    }
}

/// Heat leaves the surface free: σ_zz = −p and the shear of friction; a warm spot is pressed together along the surface, the more
/// the hotter.
#[test]
fn heat_leaves_the_surface_free() {
    let step = heated_and_coated(3.0);
    let contact = step.finest();
    let field = StressField::new(contact, MeanStress::Confined);
    let plane = field.plane(Depth::SURFACE, [33; 2]);
    let peak = contact.pressures().iter().copied().fold(0.0, f64::max);
    for ((i, j), &p) in contact.pressure().indexed_iter() {
        let state = plane.state([i, j]);
        assert!((state.zz + p).abs() < 1e-9 * peak);
        assert!((state.xz + 0.4 * 0.6 * p).abs() < 1e-9 * peak && (state.yz - 0.4 * 0.8 * p).abs() < 1e-9 * peak);
    }
    let cold = Heating::default().without_expansion();
    let problem = Problem::clone(contact.problem()).heated(cold).unwrap();
    let cold = solved(problem, 33, Load::MeanPressure(0.01));
    let colder = StressField::new(cold.finest(), MeanStress::Confined).plane(Depth::SURFACE, [33; 2]);
    let heat = contact.heat().unwrap();
    let (hottest, _) = heat.body.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1)).unwrap();
    let [warm, mild] = [&plane, &colder].map(|plane| plane.state([hottest / 33, hottest % 33]));
    assert!(warm.xx + warm.yy < mild.xx + mild.yy, "{warm:?} {mild:?}");
}

/// The largest stresses of a hot body are those of many planes.
#[test]
fn the_largest_stresses_of_a_hot_body_are_those_of_many_planes() {
    let step = heated_and_coated(3.0);
    let field = StressField::new(step.finest(), MeanStress::Confined);
    let radius = step.reading().levels[0].contact_radius.unwrap();
    let maxima = field.maxima([radius; 2]);
    for material in [1, 2] {
        let (top, bottom) = field.half_space().faces(material);
        let bottom = bottom.min(top + 3.0 * radius);
        let depths = (0..=40).map(|k| Depth { z: top + (bottom - top) * (f64::from(k) / 40.0).powi(2), material });
        let largest = depths.filter(|depth| depth.z > 0.05 * radius).flat_map(|depth| {
            let plane = field.plane(depth, [99; 2]);
            (0..99 * 99).map(|i| plane.state([i / 99, i % 99]).derived()).collect::<Vec<_>>()
        });
        let [tau1, mises] = largest.fold([0.0f64; 2], |[a, b], [tau1, mises, _]| [a.max(tau1), b.max(mises)]);
        let found = &maxima.materials[material - 1];
        for (found, seen) in [(found.tau1.value, tau1), (found.mises.value, mises)] {
            assert!(found > seen * (1.0 - 2e-3), "material {material}: {found}, {seen}");
        }
    }
}

/// Temperatures inside are those of the waves of the flux, and on the surface those of the solution.
#[test]
fn temperatures_inside_are_sums_over_the_waves_of_the_flux() {
    let step = heated_and_coated(3.0);
    let contact = step.finest();
    let heat = contact.heat().unwrap();
    let above: Vec<f64> = heat.friction.iter().zip(&heat.flux).map(|(whole, body)| whole - body).collect();
    let surfaces = [(&heat.body, &heat.flux, 3.0), (heat.counterbody.as_ref().unwrap(), &above, 0.0)];
    let fields = TemperatureField::of(contact);
    assert_eq!(fields.len(), 2);
    for (field, (surface, flux, velocity)) in fields.iter().zip(surfaces) {
        let size = surface.iter().fold(0.0f64, |most, t| most.max(t.abs()));
        let place = |sample: usize| contact.grid().cell().point(contact.grid().fractions(sample));
        for sample in (0..33 * 33).step_by(37) {
            let found = field.points(Depth::SURFACE, &[place(sample)])[0];
            assert!((found - surface[sample]).abs() < 1e-9 * size, "{found} {}", surface[sample]);
        }
        let body = HeatedBody::of(field.half_space(), velocity).unwrap();
        let waves = waves(flux, 33);
        let line = SurfaceLine { origin: [0.1, 0.2], direction: [0.6, -0.8], span: [-0.3, 0.4], points: 8 };
        let face = field.half_space().faces(1).1;
        let depths = [(0.0, 1), (0.4 * face, 1), (face, 2), (0.3, 2)].map(|(z, material)| Depth { z, material });
        let section = field.section(&line, &depths);
        for ((row, column), found) in section.indexed_iter() {
            let [x, y] = line.places()[column];
            let of = |&([kx, ky], c): &([f64; 2], Complex64)| {
                let turned = [kx * 0.6 - ky * 0.8, ky * 0.6 + kx * 0.8];
                (c * Complex64::cis(kx * x + ky * y) * body.temperature_wave(turned).at(depths[row])).re
            };
            let expected: f64 = waves.iter().map(of).sum();
            assert!((found - expected).abs() < 1e-9 * size, "{:?}: {found} {expected}", depths[row]);
        }
    }
}

/// A pin on a coated disc, on grids on which a sample of the edge touches in every other turn of contact and heat: held, it lets all others
/// settle.
#[test]
fn a_sample_that_flips_does_not_keep_heat_from_settling() {
    let steel = || conducting(210e3, [45.0, 12.0, 1.2e-5]);
    let layer = Layer::new(conducting(200e3, [2.0, 1.0, 2.3e-6]), 0.003, Interface::Bonded).unwrap();
    let pin = Level::new(Shape::Sphere { radius: 50.0 }, 0.0).unwrap();
    for (points, force) in [(64, 20.0), (128, 16.0), (64, 11.0), (64, 30.0)] {
        let bodies = Bodies::elastic(HalfSpace::new(vec![layer], steel()), HalfSpace::new(vec![], steel()));
        let indenters = Indenters::new(Lattice::square(2.0, 1).unwrap(), vec![pin.clone()]).unwrap();
        let problem = sliding(indenters, bodies, 0.1, 1000.0).heated(Heating::default()).unwrap();
        let step = solved(problem, points, Load::Force(force));
        let heat = step.finest().heat().unwrap();
        let (above, p) = (heat.counterbody.as_ref().unwrap(), step.pressure());
        let shared = p.iter().zip(heat.body.iter().zip(above)).filter(|(p, _)| **p > 0.0);
        let apart = shared.filter(|(_, (a, b))| (*a - *b).abs() > 1e-6).count();
        assert!(apart <= 2, "{points}, {force}: {apart} samples");
    }
}
