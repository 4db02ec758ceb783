//! One contact in free space, by the whole solver: closed forms, windows, stresses.

use ndarray::Array2;
use percoat::run::{Run, Sampling};
use percoat::spectral::Stop;
use percoat::stress::{Peak, StressState};
use percoat::{
    Bodies, Cell, Depth, Friction, HalfSpace, Indenters, Interface, Lattice, Layer, Level, Load, Material, MeanStress,
    Problem, Settings, Shape, Solver, Step, StressField, StressFields, Topography,
};
use std::f64::consts::PI;

const NU: f64 = 0.3;

fn material(young: f64, poisson: f64) -> Material {
    Material::from_young(young, poisson).unwrap()
}

fn bare() -> HalfSpace {
    HalfSpace::new(vec![], material(1.0, NU))
}

/// The paraboloid r²/2 over the middle of a window.
fn problem(bodies: impl Into<Bodies>, window: f64) -> Problem {
    let lattice = Lattice::new(Cell::window([window; 2]).unwrap(), vec![vec![[0.5; 2]]]).unwrap();
    let level = Level::new(Shape::Paraboloid { radius: 1.0 }, 0.0).unwrap();
    Problem::new(Indenters::new(lattice, vec![level]).unwrap(), bodies)
}

fn solved(problem: Problem, points: usize, load: Load) -> Step {
    let settings = Settings { tolerance: 1e-10, ..Settings::default() };
    let step = Solver::new(problem, [points; 2], settings).unwrap().solve(load);
    assert!(step.report.stop.solved(), "{}", step.report);
    step
}

/// REACH §1: a, P, δ, p₀ on five bodies, by an axisymmetric integral equation with the composite compliance.
fn anchors() -> Vec<(Bodies, [f64; 4])> {
    let layer = |(h, young, nu): (f64, f64, f64)| Layer::new(material(young, nu), h, Interface::Bonded).unwrap();
    let on = |layers: &[(f64, f64, f64)]| {
        HalfSpace::new(layers.iter().map(|given| layer(*given)).collect(), material(1.0, NU))
    };
    let hard = || on(&[(0.3, 3.0, 0.22)]);
    vec![
        (bare().into(), [1.0, 1.465201465, 1.0, 0.699582167]),
        (hard().into(), [0.6, 0.5482060482, 0.4691976347, 0.6269412241]),
        (on(&[(0.2, 4.0, 0.25), (0.1, 0.5, 0.45)]).into(), [0.5, 0.3025023174, 0.3222496694, 0.4465318074]),
        (on(&[(0.25, 0.3, 0.45)]).into(), [0.8, 0.5073880235, 0.5157036901, 0.4367572404]),
        (
            Bodies::elastic(hard(), HalfSpace::new(vec![], material(1.4, 0.27))),
            [0.6, 0.2416299715, 0.4075877403, 0.3043501295],
        ),
    ]
}

/// 128 samples over 2.7 radii: the discretisation leaves 3e-5 of p₀ and of δ (second order, as the periodic mode); the radius is
/// read between the samples.
#[test]
fn a_ball_on_coated_bodies_has_its_anchors() {
    for (bodies, [a, force, delta, p0]) in anchors() {
        for load in [Load::Force(force), Load::Penetration(delta)] {
            let step = solved(problem(bodies.clone(), 2.7 * a), 128, load);
            let reading = step.reading();
            let radius = reading.levels[0].contact_radius.unwrap();
            let found = [radius, reading.force, reading.penetration, reading.max_pressure];
            for (k, (found, known)) in found.into_iter().zip([a, force, delta, p0]).enumerate() {
                assert!((found / known - 1.0).abs() < 2e-4, "{k} of {a}, {load}: {found}, {known}");
            }
            assert!(reading.mean_pressure.or(reading.contact_fraction).is_none());
            assert!((reading.contact_area / (PI * a * a) - 1.0).abs() < 5e-4);
            assert!(reading.errors.penetration.unwrap() < 1e-3 * delta && reading.errors.mean_pressure.is_none());
        }
    }
}

/// At equal spacing nothing depends on the window: neither the contact nor the stresses, here of a coating under friction. On the
/// surface itself the shortest waves of the grid count, which ring at the border of its zone: four samples below they are gone.
#[test]
fn nothing_depends_on_the_window() {
    let (bodies, [_, force, ..]) = anchors().remove(1);
    let step = |points: usize| {
        let problem = problem(bodies.clone(), 0.025 * points as f64);
        let problem = problem.sliding(Friction::new(0.4, [1.0, 0.0]).unwrap()).unwrap();
        let settings = Settings { tolerance: 1e-12, ..Settings::default() };
        Solver::new(problem, [points; 2], settings).unwrap().solve(Load::Force(force))
    };
    let [small, large] = [64, 96].map(step);
    assert!((small.penetration() / large.penetration() - 1.0).abs() < 1e-10);
    let peak = large.pressure().iter().copied().fold(0.0, f64::max);
    for ((i, j), p) in small.pressure().indexed_iter() {
        let other = large.pressure()[[i + 16, j + 16]];
        assert!((p - other).abs() < 1e-8 * peak, "{i}, {j}: {p}, {other}");
    }
    let [one, two] = [&small, &large].map(|step| StressField::new(step.finest(), MeanStress::Confined));
    for (z, material) in [(0.1, 1), (0.2, 1), (0.3, 1), (0.3, 2), (0.7, 2), (2.5, 2), (9.0, 2)] {
        for place in [[0.0, 0.0], [0.45, 0.1], [-0.3, 0.66]] {
            let at = |field: &StressField| field.points(Depth { z, material }, &[place])[0].components();
            let (one, two) = (at(&one), at(&two));
            for k in 0..6 {
                assert!((one[k] - two[k]).abs() < 2e-6 * peak, "{k} at {place:?}, {z}: {one:?}, {two:?}");
            }
        }
    }
}

/// On the axis of a Hertz contact (Johnson 1985, Eq. 3.45), with ζ = z/a:
/// σ_r = −p₀[(1+ν)(1 − ζ atan(1/ζ)) − ½/(1+ζ²)], σ_z = −p₀/(1+ζ²).
/// So it is in a layer of the material of the substrate, here of ten windows.
#[test]
fn the_axis_below_a_hertz_contact_has_its_closed_form() {
    let (_, [a, force, _, p0]) = anchors().remove(0);
    let thickness = 25.0 * a;
    let layer = Layer::new(material(1.0, NU), thickness, Interface::Bonded).unwrap();
    for body in [bare(), HalfSpace::new(vec![layer], material(1.0, NU))] {
        let is_layered = !body.layers().is_empty();
        let step = solved(problem(body, 2.5), 160, Load::Force(force));
        let field = StressField::new(step.finest(), MeanStress::HalfSpace);
        for zeta in [0.1f64, 0.3, 0.48, 1.0, 2.0, 4.0, 8.0, 12.0, 20.0, 24.99, 25.01, 30.0] {
            let z = zeta * a;
            let material = if is_layered && z > thickness { 2 } else { 1 };
            let state = field.points(Depth { z, material }, &[[0.0, 0.0]])[0];
            let radial = -p0 * ((1.0 + NU) * (1.0 - zeta * (1.0 / zeta).atan()) - 0.5 / (1.0 + zeta * zeta));
            let axial = -p0 / (1.0 + zeta * zeta);
            for (found, known) in [(state.xx, radial), (state.yy, radial), (state.zz, axial)] {
                assert!((found - known).abs() < 1e-4 * p0, "{zeta}: {found}, {known}");
            }
            // Far below the displacement is that of a point force.
            if zeta >= 30.0 {
                let point = force * (1.0 + NU) * (2.0 * (1.0 - NU) + 1.0) / (2.0 * PI * zeta * a);
                assert!((state.displacement[2] / point - 1.0).abs() < 2e-3, "{}, {point}", state.displacement[2]);
            }
        }
        // Outside the contact on the surface σ_r = −σ_θ = (1 − 2ν) p₀ a²/(3r²).
        let plane = field.plane(Depth { z: 1e-3, material: 1 }, [160; 2]);
        assert_eq!(plane.points(), [160; 2]);
        let (i, j) = (80 + 74, 80);
        let r = 74.0 * 2.5 / 160.0;
        let known = (1.0 - 2.0 * NU) * p0 / (3.0 * r * r);
        let state = plane.state([i, j]);
        assert!((state.yy + known).abs() < 5e-3 * p0 && (state.xx - known).abs() < 5e-3 * p0, "{state:?}, {known}");
    }
}

#[test]
fn contact_at_the_border_of_its_window_is_not_a_solution() {
    let step = Solver::new(problem(bare(), 1.9), [48; 2], Settings::default()).unwrap().solve(Load::Force(1.465));
    assert_eq!(step.report.stop, Stop::AtBorder);
}

/// Two balls in one window, far from each other: each has half of the force, and the other one presses it down by P(1−ν²)/(πE s).
#[test]
fn two_indenters_share_a_window() {
    let cell = Cell::window([2.4, 1.0]).unwrap();
    let lattice = Lattice::new(cell, vec![vec![[0.2, 0.5], [0.8, 0.5]]]).unwrap();
    let level = Level::new(Shape::Paraboloid { radius: 1.0 }, 0.0).unwrap();
    let pair = Problem::new(Indenters::new(lattice, vec![level]).unwrap(), bare());
    let settings = Settings::default();
    let a = 0.2f64;
    let force = 4.0 / 3.0 * a.powi(3) / (1.0 - NU * NU);
    let step = Solver::new(pair, [192, 80], settings).unwrap().solve(Load::Force(2.0 * force));
    let reading = step.reading();
    let apart = 0.6 * 2.4;
    let known = a * a + force * (1.0 - NU * NU) / (PI * apart);
    // The other contact is 0.28 radii wide beside their distance: its field is uniform to (a/s)²/5 of it.
    assert!((reading.penetration / known - 1.0).abs() < 2e-3, "{} {known}", reading.penetration);
    assert!((reading.levels[0].load / force - 1.0).abs() < 1e-9);
}

/// The series is that of a window of twice the size: beyond the middle half of it is the field of images. What is found outside of the
/// window is the free field, as the series of a window four times as wide has it; what lies beyond that one too is small.
#[test]
fn the_largest_stresses_are_those_of_the_free_field() {
    // With and without friction on the first two, bare and coated; sliding on the others.
    for (number, (bodies, [a, force, ..])) in anchors().into_iter().enumerate() {
        for &friction in if number < 2 { &[0.0, 0.5][..] } else { &[0.5] } {
            let step = |window: f64, points: usize| {
                let sliding = Friction::new(friction, [1.0, 0.4]).unwrap();
                solved(problem(bodies.clone(), window * a).sliding(sliding).unwrap(), points, Load::Force(force))
            };
            let [narrow, wide] = [step(2.4, 48), step(9.6, 192)];
            let fields = [&narrow, &wide].map(|step| StressFields::new(step.finest(), MeanStress::Confined));
            let pressed = narrow.reading().max_pressure;
            for (field, free) in fields[0].each().zip(fields[1].each()) {
                let maxima = field.maxima([a; 2]);
                let of = |peak: Peak, measure: fn(&StressState) -> f64| (peak, measure);
                let materials = maxima.materials.iter().chain(&maxima.faces).flat_map(|peaks| {
                    [
                        of(peaks.tau1, StressState::tau1),
                        of(peaks.tension, StressState::s1),
                        of(peaks.mises, StressState::mises),
                    ]
                });
                let interfaces = maxima.interfaces.iter().flat_map(|peaks| {
                    let shear = |state: &StressState| state.xz.hypot(state.yz);
                    [of(peaks.normal, |state| state.zz), of(peaks.shear, shear)]
                });
                let peaks: Vec<_> = materials.chain(interfaces).collect();
                assert!(peaks.len() >= 6);
                for (peak, measure) in peaks {
                    let [x, y, z] = peak.position;
                    let out = x.abs().max(y.abs()) / a;
                    if out > 4.8 {
                        assert!(peak.value.abs() < 5e-3 * pressed, "{peak:?}");
                    } else if out > 1.2 {
                        let exact = measure(&free.points(Depth { z, material: peak.material.number }, &[[x, y]])[0]);
                        // On the surface the series of the wide window rings.
                        let left = if z > 0.0 { 1e-3 } else { 1e-2 };
                        assert!((peak.value - exact).abs() < left * pressed, "{peak:?}, {exact}");
                    }
                }
            }
        }
    }
}

/// On the surface the tension is largest at the edge of contact, (1 − 2ν)p₀/3 under Hertz' pressure, and with a traction in +x at the
/// trailing edge p₀[(1 − 2ν)/3 + μπ(4 + ν)/8] (Hamilton, Proc. Inst. Mech. Eng. 197C (1983) 53), in windows of which contact fills three
/// quarters and a third. The cusp behind the trailing edge errs by CUSP_ERROR/n and more of 2μp₀: 0.02 p₀ at least.
#[test]
fn the_largest_tension_lies_at_the_edge_of_contact() {
    let p0 = 2.0 / PI;
    for (window, points) in [(2.7, 96), (6.0, 216)] {
        for (nu, mu) in [(0.0, 0.0), (0.25, 0.0), (0.0, 0.5), (0.25, 0.5)] {
            let body = HalfSpace::new(vec![], material(1.0 - nu * nu, nu));
            let problem = problem(body, window).sliding(Friction::new(mu, [1.0, 0.0]).unwrap().uncoupled()).unwrap();
            let step = solved(problem, points, Load::Force(4.0 / 3.0));
            let crest = StressField::new(step.finest(), MeanStress::Confined).maxima([1.0; 2]).crest.unwrap();
            let [x, y, _] = crest.peak.position;
            let exact = p0 * ((1.0 - 2.0 * nu) / 3.0 + mu * PI * (4.0 + nu) / 8.0);
            let off = crest.peak.value - exact;
            println!("{window} {points} {nu} {mu}: {off:e}, r = {}", x.hypot(y));
            assert!((x.hypot(y) - 1.0).abs() < window / points as f64, "{:?}", crest.peak);
            assert!(off.abs() < if mu > 0.0 { 0.02 * p0 } else { 0.02 * exact }, "{off:e}: {:?}", crest.peak);
        }
    }
}

/// A window of four times the length holds the same contact, and the same stresses far beside and below it.
#[test]
fn a_slender_window_has_the_stresses_of_a_square_one() {
    let (bodies, [a, force, ..]) = anchors().remove(1);
    let of = |sides: [f64; 2], points: [usize; 2]| {
        let lattice = Lattice::new(Cell::window(sides).unwrap(), vec![vec![[0.5; 2]]]).unwrap();
        let level = Level::new(Shape::Paraboloid { radius: 1.0 }, 0.0).unwrap();
        let problem = Problem::new(Indenters::new(lattice, vec![level]).unwrap(), bodies.clone());
        let settings = Settings { tolerance: 1e-12, ..Settings::default() };
        Solver::new(problem, points, settings).unwrap().solve(Load::Force(force))
    };
    let side = 2.5 * a;
    let (square, slender, upright) =
        (of([4.0 * side; 2], [160; 2]), of([4.0 * side, side], [160, 40]), of([side, 4.0 * side], [40, 160]));
    let peak = square.reading().max_pressure;
    let [square, slender, upright] =
        [&square, &slender, &upright].map(|step| StressField::new(step.finest(), MeanStress::Confined));
    let places = [[0.0, 0.0], [0.3 * side, 0.45 * side], [1.9 * side, 0.4 * side], [1.2 * side, 0.0]];
    for (z, material) in [(0.1 * side, 1), (0.3, 1), (0.3, 2), (side, 2), (6.0 * side, 2), (20.0 * side, 2)] {
        let depth = Depth { z, material };
        let states = square.points(depth, &places);
        let turned = places.map(|[x, y]| [y, x]);
        for ((state, other), third) in
            states.iter().zip(slender.points(depth, &places)).zip(upright.points(depth, &turned))
        {
            let (a, b, c) = (state.components(), other.components(), third.components());
            let c = [c[1], c[0], c[2], c[3], c[5], c[4]];
            for k in 0..6 {
                assert!(
                    (a[k] - b[k]).abs() < 2e-6 * peak && (a[k] - c[k]).abs() < 2e-6 * peak,
                    "{k} at {z}: {a:?}, {b:?}, {c:?}"
                );
            }
        }
    }
    let beyond = slender.points(Depth { z: 0.1, material: 1 }, &[[0.0, 0.6 * side]])[0];
    assert!(beyond.zz.is_nan() && square.points(Depth { z: 0.1, material: 1 }, &[[0.0, 0.6 * side]])[0].zz.is_finite());
}

/// A window has no mean pressure; a cell has no force that another cell of the same system would have.
#[test]
fn a_stress_field_says_the_load_that_its_contact_has() {
    let free = solved(problem(bare(), 3.0), 32, Load::Force(0.5));
    let said = StressField::new(free.finest(), MeanStress::Confined).to_string();
    assert!(said.ends_with(", 1 materials, force 0.50000"), "{said}");
    let indenter = Level::new(Shape::Paraboloid { radius: 1.0 }, 0.0).unwrap();
    let cell = Indenters::new(Lattice::square(2.0, 1).unwrap(), vec![indenter]).unwrap();
    let step = solved(Problem::new(cell, bare()), 32, Load::Force(0.5));
    let said = StressField::new(step.finest(), MeanStress::Confined).to_string();
    assert!(said.ends_with(", 1 materials, mean pressure 0.12500"), "{said}");
}

/// The paraboloid as a topography: by Hertz dP/dδ = 2E*a; what would be of the window's area is not there. The stiffness is that of the
/// tangent, and under friction that couples, which has none, of the neighbouring loads.
#[test]
fn a_topography_in_a_window_has_its_stiffness_once_and_no_parts_of_the_window() {
    for friction in [0.0, 0.05] {
        topography_in_a_window(friction);
    }
}

fn topography_in_a_window(friction: f64) {
    let (window, points) = (3.0, 96);
    let cell = Cell::window([window; 2]).unwrap();
    let place = |index: usize| (index as f64 / points as f64 - 0.5) * window;
    let heights = Array2::from_shape_fn([points; 2], |(i, j)| -0.5 * (place(i).powi(2) + place(j).powi(2)));
    let mut problem = Problem::new(Topography::new(cell, heights).unwrap(), bare());
    if friction > 0.0 {
        problem = problem.sliding(Friction::new(friction, [1.0, 0.0]).unwrap()).unwrap();
    }
    let loads: Vec<Load> = (0..5).map(|k| Load::Force(0.2 * 1.2f64.powi(k))).collect();
    let steps = Run::new(problem, loads, Sampling::Points([points; 2])).solve(&mut ()).unwrap().steps;
    for step in &steps {
        let rough = step.rough.as_ref().unwrap();
        assert_eq!((rough.spots.count, rough.spots.percolates), (1, false));
        let none = [rough.counted_fraction, rough.corrected_fraction, rough.perimeter_density, rough.mean_gap];
        assert!(none.iter().chain([&rough.spots.density]).all(Option::is_none), "{rough:?}");
        assert_eq!((rough.corrected_fraction_error, rough.mean_gap_error), (None, None));
        let names: Vec<&str> = rough.histograms.iter().map(|histogram| histogram.quantity.as_ref()).collect();
        assert_eq!(names, ["pressure", "spot_area"]);
        let radius = (0.75 * step.reading.force * (1.0 - NU * NU)).cbrt();
        let exact = 2.0 * radius / (1.0 - NU * NU);
        let by_tangent = step.contact_stiffness.zip(step.contact_stiffness_error);
        let by_neighbours = rough.stiffness.zip(rough.stiffness_error);
        assert_eq!((by_tangent.is_some(), by_neighbours.is_some()), (friction == 0.0, friction > 0.0));
        let (found, error) = by_tangent.or(by_neighbours).unwrap();
        assert!((found / exact - 1.0).abs() < 1e-2 && (found - exact).abs() < error, "{found} ± {error}, {exact}");
        #[cfg(feature = "cli")]
        is_read_back(step);
    }
}

/// A record with numbers that have no meaning in a window is read back as it was written.
#[cfg(feature = "cli")]
fn is_read_back(step: &percoat::run::StepRecord) {
    let text = serde_json::to_string(step).unwrap();
    let read: percoat::run::StepRecord = serde_json::from_str(&text).unwrap();
    assert_eq!(serde_json::to_string(&read).unwrap(), text);
    assert!(text.contains("\"mean_gap\":null") && text.contains("\"density\":null"), "{text}");
}

/// A ball without roughness, as heights, is the sphere of the indenters.
#[test]
fn a_smooth_ball_of_heights_is_a_sphere() {
    let (window, points, radius) = (Cell::window([1.0, 1.4]).unwrap(), [48, 60], 2.0);
    let half_space = HalfSpace::new(vec![], Material::from_young(0.91, 0.3).unwrap());
    let lattice = Lattice::new(window, vec![vec![[0.5; 2]]]).unwrap();
    let level = Level::new(Shape::Sphere { radius }, 0.0).unwrap();
    let sphere = Problem::new(Indenters::new(lattice, vec![level]).unwrap(), half_space.clone());
    let heights = Topography::new(window, Array2::zeros(points)).unwrap().on_ball(radius).unwrap();
    let [flat, other] = [Problem::new(heights, half_space), sphere].map(|problem| {
        let step = Solver::new(problem, points, Settings::default()).unwrap().solve(Load::Penetration(0.02));
        assert!(step.report.stop.solved());
        (step.reading().force, step.pressure().to_owned())
    });
    let peak = other.1.iter().copied().fold(0.0, f64::max);
    assert!((flat.0 / other.0 - 1.0).abs() < 1e-6, "{} {}", flat.0, other.0);
    assert!(flat.1.iter().zip(&other.1).all(|(a, b)| (a - b).abs() < 1e-5 * peak));
}

/// A narrow window along the sliding direction has few samples across it, and no grid with half of them.
#[test]
fn a_step_without_errors_says_so() {
    let lattice = Lattice::new(Cell::window([3.0, 1.2]).unwrap(), vec![vec![[0.5; 2]]]).unwrap();
    let level = Level::new(Shape::Paraboloid { radius: 1.0 }, 0.0).unwrap();
    let sliding = Problem::new(Indenters::new(lattice, vec![level]).unwrap(), bare())
        .sliding(Friction::new(0.3, [1.0, 0.0]).unwrap())
        .unwrap();
    let of = |points: [usize; 2]| {
        let run = Run::new(sliding.clone(), vec![Load::Force(0.05)], Sampling::Points(points));
        let outcome = run.solve(&mut ()).unwrap();
        let told = outcome.warnings.iter().any(|words| words.contains("no coarser grid has solved step 1"));
        (outcome.steps[0].reading.errors.penetration.is_some(), told)
    };
    assert_eq!([[120, 40], [120, 48]].map(of), [(false, true), (true, false)]);
}
