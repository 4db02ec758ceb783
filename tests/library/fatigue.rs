//! Fatigue of one load step: ranges of the stresses along the path of sliding against closed forms, and what turning, scaling and
//! windows do not change.

use ndarray::Array2;
use percoat::reading::{Criterion, FatiguePart, Utilisation};
use percoat::run::{Run, Sampling};
#[cfg(feature = "validate")]
use percoat::validation::exact::sliding_sphere::{stresses, together};
use percoat::{
    Bodies, Cell, Durability, Endurance, Fatigue, FatigueReading, Friction, HalfSpace, Indenters, Interface, Lattice,
    Layer, Level, Life, Load, Material, MeanStress, Problem, Settings, Shape, SlidingPath, Solver, Step, StressFields,
};
#[cfg(feature = "validate")]
use percoat::{DamageMap, StressState};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

const NU: f64 = 0.3;

fn law() -> Fatigue {
    Fatigue::new(0.3, 1e6, 8.0).unwrap()
}

/// A law so steep that of the cycles along a path the longest alone counts.
#[cfg(feature = "validate")]
fn steep() -> Fatigue {
    Fatigue::new(0.3, 1e6, 500.0).unwrap()
}

/// A bare body of E = 1 whose material tires by a law.
fn bare_by(law: Fatigue) -> HalfSpace {
    let material = Material::from_young(1.0, NU).unwrap();
    let tires = Durability { fatigue: Some(law), ..Durability::default() };
    HalfSpace::new(vec![], material).with_substrate_durability(tires).unwrap()
}

fn bare() -> HalfSpace {
    bare_by(law())
}

/// A hard layer on a body, all of which tires, the interface too; `endurance` of both materials.
fn coated(h: f64, endurance: Option<Endurance>) -> HalfSpace {
    let durability = Durability { fatigue: Some(law()), endurance, ..Durability::default() };
    let layer = Layer::new(Material::from_young(3.0, 0.22).unwrap(), h, Interface::Bonded).unwrap();
    let layer = layer.with_durability(durability, Some(law())).unwrap();
    let substrate = Material::from_young(1.0, NU).unwrap();
    HalfSpace::new(vec![layer], substrate).with_substrate_durability(durability).unwrap()
}

/// The paraboloid r²/2 at the fractions of a cell.
fn indenters(cell: Cell, sites: &[[f64; 2]]) -> Indenters {
    let lattice = Lattice::new(cell, sites.iter().map(|site| vec![*site]).collect()).unwrap();
    let level = Level::new(Shape::Paraboloid { radius: 1.0 }, 0.0).unwrap();
    Indenters::new(lattice, vec![level; sites.len()]).unwrap()
}

fn solved(problem: Problem, points: [usize; 2], load: Load) -> Step {
    let settings = Settings { tolerance: 1e-10, ..Settings::default() };
    let step = Solver::new(problem, points, settings).unwrap().solve(load);
    assert!(step.report.stop.solved(), "{}", step.report);
    step
}

fn fatigue(step: &Step) -> FatigueReading {
    FatigueReading::of(step, &step.reading(), &StressFields::new(step.finest(), MeanStress::Confined)).unwrap()
}

/// Force of the paraboloid with a contact radius of 1, and its p₀.
const FORCE: f64 = 4.0 / 3.0 / (1.0 - NU * NU);
const P0: f64 = 2.0 / PI / (1.0 - NU * NU);

/// REACH §2: from far away the range is the largest τ₁ below the middle, 0.310021 p₀ at z = 0.480864. The samples leave the error of
/// the pressure, (a/n)² of it, 3e-4 for 47 samples along the radius; the value is flat at the maximum, and its place errs like the root.
#[test]
fn one_pass_of_a_ball_has_the_range_of_hertz() {
    let (along, others) = ([1.0, 0.0], [[0.0, 1.0], [0.6, 0.8]]);
    for (window, points, directions) in [(2.7, 128, &[along, others[0], others[1]][..]), (6.0, 256, &[along])] {
        let window = Cell::window([window; 2]).unwrap();
        for &direction in directions {
            let friction = Friction::new(0.0, direction).unwrap();
            let problem = Problem::new(indenters(window, &[[0.5; 2]]), bare()).sliding(friction).unwrap();
            let step = solved(problem, [points; 2], Load::Force(FORCE));
            let reading = fatigue(&step);
            let Life { range, error, position: [x, y, z], passes, .. } = reading.first;
            println!("{points} {direction:?}: {range} {error:?} {x} {y} {z}, off {:e}", range / P0 / 0.310021 - 1.0);
            assert_eq!(reading.path, SlidingPath::FromFarAway);
            assert!((range / P0 / 0.310021 - 1.0).abs() < 3e-4, "{range}, {z}");
            assert!((z - 0.480864).abs() < 0.02 && x.hypot(y) < 0.01, "{x}, {y}, {z}");
            assert!((law().damage(range) * passes - 1.0).abs() < 1e-14);
            assert!((range / P0 - 0.310021).abs() * 8.0 / 0.310021 <= error.unwrap() + 1e-5, "{error:?}");
        }
    }
}

/// A small contact in a large cell, an eighth of its side wide: images change τ₁ by (a/l)³ times numbers near 1, and the mean has τ₁ = (1 − 2ν)/(2(1 −
/// ν)) p̄ = 2.3e-3 p₀ everywhere, of either sign, at the maximum and between the contacts: 1.5 % of the range.
#[test]
fn a_sparse_cell_is_nearly_one_contact() {
    let side = 16.0;
    let problem = Problem::new(indenters(Cell::square(side).unwrap(), &[[0.0; 2]]), bare());
    let reading = fatigue(&solved(problem, [384; 2], Load::MeanPressure(FORCE / side / side)));
    println!("{:?} off {:e}", reading.first, reading.first.range / P0 / 0.310021 - 1.0);
    assert_eq!(reading.path, SlidingPath::LatticeVector([1, 0]));
    assert!((reading.first.range / P0 / 0.310021 - 1.0).abs() < 0.015);
}

/// In plane strain the wave of a pressure has τ₁ = p̂ qz e^{−qz} at every x. Its mean adds a stress that is the same in all directions
/// where ν = ½, and contact is complete: no range, and no damage.
#[test]
fn under_a_wave_in_complete_contact_nothing_tires() {
    let surface = Array2::from_shape_fn([64; 2], |(i, _)| 0.002 * (TAU * i as f64 / 64.0).cos());
    let topography = percoat::Topography::new(Cell::square(1.0).unwrap(), surface).unwrap();
    let tires = Durability { fatigue: Some(law()), ..Durability::default() };
    let body =
        HalfSpace::new(vec![], Material::from_young(1.0, 0.5).unwrap()).with_substrate_durability(tires).unwrap();
    let problem = Problem::new(topography, body);
    // Twice the pressure at which contact is complete.
    let step = solved(problem, [64; 2], Load::MeanPressure(0.03));
    assert!(step.pressure().iter().all(|&p| p > 0.0));
    let Life { range, .. } = fatigue(&step).first;
    // The pressure of the solver has the wave to its tolerance.
    assert!(range < 1e-8, "{range:e}");
}

/// Lines of the closed form of the sliding sphere at several y and z; the path from far away: the window is filled by nine tenths and by
/// a third.
#[cfg(feature = "validate")]
#[test]
fn a_sliding_sphere_has_the_ranges_of_its_closed_form() {
    let mu = 0.3;
    let friction = Friction::new(mu, [1.0, 0.0]).unwrap().uncoupled();
    let tau1 = |place: [f64; 3]| {
        let [xx, yy, zz, xy, xz, yz] = together(stresses(NU, place), mu);
        StressState { xx, yy, zz, xy, xz, yz, ..StressState::default() }.tau1()
    };
    // Far away it is at rest.
    let exact = |y: f64, z: f64| (-1000..=1000).map(|k| tau1([f64::from(k) * 4e-3, y, z])).fold(0.0, f64::max);
    for (window, points) in [(2.2, 96), (6.0, 256)] {
        let window = Cell::window([window; 2]).unwrap();
        let problem = Problem::new(indenters(window, &[[0.5; 2]]), bare_by(steep())).sliding(friction).unwrap();
        let step = solved(problem, [points; 2], Load::Force(FORCE));
        let fields = StressFields::new(step.finest(), MeanStress::Confined);
        let map = DamageMap::of(&step, &step.reading(), fields.body()).unwrap();
        let mut most = 0.0f64;
        for (row, depth) in map.z.iter().enumerate().filter(|(_, depth)| depth.z > 0.1 && depth.z < 2.0) {
            for (column, &y) in map.y.iter().enumerate().step_by(7).filter(|(_, y)| y.abs() < 0.99) {
                most = most.max((map.range[[row, column]] / P0 - exact(y, depth.z)).abs());
            }
        }
        assert!(most < 2e-3, "{most:e}");
    }
}

/// The largest range of all, below the surface or at the trailing edge, where it is that of p₀[(1 − 2ν)/3 + μπ(4 + ν)/8] along x and the
/// lesser one of 0 and p₀[3πμν/8 − (1 − 2ν)/3] across: within the stated error of the passes over the exponent.
#[cfg(feature = "validate")]
#[test]
fn the_largest_range_of_a_sliding_sphere_is_known_within_its_error() {
    let p0 = 2.0 / PI;
    for (nu, mu) in [(0.0, 0.2), (0.0, 0.5), (0.2, 0.2), (0.3, 0.3), (0.3, 0.5), (0.45, 0.5)] {
        let tau1 = |x: f64, z: f64| {
            let [xx, yy, zz, xy, xz, yz] = together(stresses(nu, [x, 0.0, z]), mu);
            StressState { xx, yy, zz, xy, xz, yz, ..StressState::default() }.tau1()
        };
        let edge = 0.5
            * ((1.0 - 2.0 * nu) / 3.0 + mu * PI * (4.0 + nu) / 8.0
                - (3.0 * PI * mu * nu / 8.0 - (1.0 - 2.0 * nu) / 3.0).min(0.0));
        let places = (0..=80).flat_map(|j| (-200..=200).map(move |k| [0.01 * f64::from(k), 0.01 * f64::from(j)]));
        let exact = places.map(|[x, z]| tau1(x, z.max(1e-6))).fold(edge, f64::max);
        let tires = Durability { fatigue: Some(steep()), ..Durability::default() };
        let body = HalfSpace::new(vec![], Material::from_young(1.0 - nu * nu, nu).unwrap());
        let body = body.with_substrate_durability(tires).unwrap();
        let friction = Friction::new(mu, [1.0, 0.0]).unwrap().uncoupled();
        let window = Cell::window([2.7; 2]).unwrap();
        let problem = Problem::new(indenters(window, &[[0.5; 2]]), body).sliding(friction).unwrap();
        let run = Run::new(problem, vec![Load::Force(4.0 / 3.0)], Sampling::Points([128; 2]));
        let first = run.solve(&mut ()).unwrap().steps[0].fatigue.as_ref().unwrap().first;
        let [off, stated] = [(first.range / p0 / exact - 1.0).abs(), first.error.unwrap() / steep().exponent()];
        println!("ν {nu}, μ {mu}: {off:e} of {stated:e} at {:?}, exact {exact}", first.position);
        assert!(off < stated && stated < 0.1, "ν {nu}, μ {mu}: {off:e} of {stated:e} at {:?}", first.position);
    }
}

/// Turned by a quarter, and with a₁ and a₂ exchanged, the same bodies last as long.
#[test]
fn turning_the_cell_and_exchanging_its_vectors_changes_no_life() {
    let friction = |direction: [f64; 2]| Friction::new(0.25, direction).unwrap();
    let sites = [[0.1, 0.2], [0.55, 0.75]];
    let exchanged = sites.map(|[s, t]| [t, s]);
    let of = |a1: [f64; 2], a2: [f64; 2], sites: &[[f64; 2]], direction: [f64; 2], points: [usize; 2]| {
        let problem = Problem::new(indenters(Cell::new(a1, a2).unwrap(), sites), coated(0.2, None));
        let step = solved(problem.sliding(friction(direction)).unwrap(), points, Load::MeanPressure(0.01));
        fatigue(&step)
    };
    let reading = of([4.0, 0.0], [1.0, 3.0], &sites, [1.0, 0.0], [96, 80]);
    assert_eq!(reading.path, SlidingPath::LatticeVector([1, 0]));
    let others = [
        of([1.0, 3.0], [4.0, 0.0], &exchanged, [1.0, 0.0], [80, 96]),
        of([0.0, 4.0], [-3.0, 1.0], &sites, [0.0, 1.0], [96, 80]),
    ];
    assert_eq!(reading.lives.len(), 3);
    for other in others {
        for (one, other) in reading.lives.iter().zip(&other.lives) {
            println!("{:?} {} {}", one.part, one.range, other.range);
            assert!((one.range / other.range - 1.0).abs() < 1e-6, "{one:?}, {other:?}");
            assert!((one.position[2] - other.position[2]).abs() < 1e-3, "{one:?}, {other:?}");
        }
    }
}

/// Along the diagonal of a square cell of two contacts, one in its middle, the path is that along the side of the cell of half the area
/// turned by an eighth; off the lattice all of the plane counts, and the range is no less (with next to no friction, whose direction
/// changes the stresses).
#[test]
fn a_diagonal_is_followed_and_a_direction_off_the_lattice_uses_the_whole_plane() {
    let under = |friction: f64, cell: Cell, sites: &[[f64; 2]], direction: [f64; 2], points: [usize; 2]| {
        let friction = Friction::new(friction, direction).unwrap();
        let problem = Problem::new(indenters(cell, sites), coated(0.2, None)).sliding(friction).unwrap();
        fatigue(&solved(problem, points, Load::MeanPressure(0.01)))
    };
    let of = |cell: Cell, sites: &[[f64; 2]], direction: [f64; 2], points: [usize; 2]| {
        under(0.25, cell, sites, direction, points)
    };
    let square = Cell::square(4.0).unwrap();
    let centred = [[0.0; 2], [0.5; 2]];
    let diagonal = of(square, &centred, [1.0, 1.0], [96, 96]);
    assert_eq!(diagonal.path, SlidingPath::LatticeVector([1, 1]));
    let half = Cell::new([2.0, 2.0], [-2.0, 2.0]).unwrap();
    let side = of(half, &[[0.0; 2]], [1.0, 1.0], [68, 68]);
    for (one, other) in diagonal.lives.iter().zip(&side.lives) {
        println!("diagonal {:?} {} ± {:?}, side {} ± {:?}", one.part, one.range, one.error, other.range, other.error);
        let stated = (one.error.unwrap() + other.error.unwrap()) / 8.0;
        // The path passes both contacts before it closes.
        assert!((one.range / other.range / 2f64.powf(1.0 / 8.0) - 1.0).abs() < stated, "{one:?}, {other:?}");
    }
    // All points of the body last as long, longer than those under the middle of the contacts.
    let [off, along] = [[1.0, 2f64.sqrt() - 0.3], [1.0, 0.0]].map(|way| under(1e-6, square, &centred, way, [96, 96]));
    assert_eq!(off.path, SlidingPath::WholePlane);
    for (one, other) in off.lives.iter().zip(&along.lives) {
        assert!(0.5 * other.range < one.range && one.range < other.range, "{one:?}, {other:?}");
    }
}

/// Waves of a few lengths on a coated body, on `count` periods along x of a cell of the side 1, moved by parts of it.
fn wavy(count: usize, moved: [f64; 2], direction: [f64; 2], points: usize) -> FatigueReading {
    let n = [count * points, points];
    let waves = [
        (1.0, 0.0, 1.0, 0.3),
        (1.0, 1.0, 0.7, 1.1),
        (2.0, -1.0, 0.5, 2.0),
        (0.0, 2.0, 0.4, 0.2),
        (3.0, 1.0, 0.25, 4.0),
    ];
    let heights = Array2::from_shape_fn(n, |(i, j)| {
        let [x, y] = [i as f64 / points as f64 - moved[0], j as f64 / points as f64 - moved[1]];
        0.004 * waves.iter().map(|(k, l, part, phase)| part * (TAU * (k * x + l * y) + phase).cos()).sum::<f64>()
    });
    let cell = Cell::new([count as f64, 0.0], [0.0, 1.0]).unwrap();
    let topography = percoat::Topography::new(cell, heights).unwrap();
    let friction = Friction::new(0.2, direction).unwrap();
    let problem = Problem::new(topography, coated(0.1, None)).sliding(friction).unwrap();
    fatigue(&solved(problem, n, Load::MeanPressure(0.01)))
}

/// Distances to failure of two readings, whose passes have some lengths: the same to a thousandth, or near the surface within their errors.
fn last_the_same_distance([one, other]: [&FatigueReading; 2], lengths: [f64; 2], spacing: f64) {
    assert_eq!(one.lives.len(), 3);
    for (one, other) in one.lives.iter().zip(&other.lives) {
        let off = (one.passes * lengths[0] / (other.passes * lengths[1]) - 1.0).abs();
        println!("{:?}: distances off {off:e} at z = {}, stated {:?}", one.part, one.position[2], one.error);
        let stated = if one.position[2] > 2.0 * spacing { 1e-3 } else { one.error.unwrap() };
        assert!(off < stated, "{off:e}: {one:?}, {other:?}");
    }
}

/// A surface that is tiled four times along the path has four times the cycles in a pass, moved by parts of a sample the same ones.
#[test]
fn a_tiled_and_a_shifted_surface_last_the_same_distance() {
    let plain = wavy(1, [0.0; 2], [1.0, 0.0], 96);
    last_the_same_distance([&plain, &wavy(4, [0.0; 2], [1.0, 0.0], 96)], [1.0, 4.0], 1.0 / 96.0);
    last_the_same_distance([&plain, &wavy(1, [0.3713, 0.1291], [1.0, 0.0], 96)], [1.0, 1.0], 1.0 / 96.0);
    // Along [10, 3] of the cell, which is [5, 6] of the cell tiled twice.
    let slanting = [1.0, 0.3];
    let [one, two] = [wavy(1, [0.0; 2], slanting, 64), wavy(2, [0.0; 2], slanting, 64)];
    let paths = [&one, &two].map(|reading| reading.path);
    assert_eq!(paths, [SlidingPath::LatticeVector([10, 3]), SlidingPath::LatticeVector([5, 3])]);
    let length = 10f64.hypot(3.0);
    last_the_same_distance([&one, &two], [length, length], 1.0 / 64.0);
}

/// Two equal indenters in a doubled cell are passed twice in a pass, and the second one counts.
#[test]
fn two_equal_indenters_in_a_doubled_cell_last_the_same_distance() {
    let of = |cell: [f64; 2], sites: &[[f64; 2]], points: [usize; 2]| {
        let cell = Cell::new([cell[0], 0.0], [0.0, cell[1]]).unwrap();
        let friction = Friction::new(0.25, [1.0, 0.0]).unwrap();
        let problem = Problem::new(indenters(cell, sites), coated(0.3, None)).sliding(friction).unwrap();
        fatigue(&solved(problem, points, Load::MeanPressure(0.02)))
    };
    let one = of([3.0, 3.0], &[[0.2, 0.4]], [96, 96]);
    let two = of([6.0, 3.0], &[[0.1, 0.4], [0.6, 0.4]], [192, 96]);
    last_the_same_distance([&one, &two], [3.0, 6.0], 3.0 / 96.0);
    // Across the path a cell repeats lines.
    let across = of([3.0, 6.0], &[[0.2, 0.2], [0.2, 0.7]], [96, 192]);
    last_the_same_distance([&one, &across], [3.0, 3.0], 3.0 / 96.0);
}

/// Along a direction that closes after many cells, and one beside it that never closes, a body lasts nearly as far; with next to no slope
/// off the lattice the damage is the mean over the lines along it.
#[test]
fn a_path_off_the_lattice_has_the_damage_of_its_length() {
    let cell = Cell::square(3.0).unwrap();
    let of = |direction: [f64; 2]| {
        let problem = Problem::new(indenters(cell, &[[0.0; 2]]), coated(0.3, None));
        let problem = problem.sliding(Friction::new(1e-6, direction).unwrap()).unwrap();
        solved(problem, [64; 2], Load::MeanPressure(0.02))
    };
    let [closed, open] = [[1.0, 0.3], [1.0, 0.3 + 1e-4 / TAU]].map(|way| fatigue(&of(way)));
    assert_eq!((closed.path, open.path), (SlidingPath::LatticeVector([10, 3]), SlidingPath::WholePlane));
    for (closed, open) in closed.lives.iter().zip(&open.lives) {
        let ratio = closed.passes * 3.0 * 10f64.hypot(3.0) / (open.passes * 3.0);
        println!("{:?}: {ratio}", closed.part);
        // Lines are 0.29 apart, and the damage of the worst is above the mean.
        assert!(0.6 < ratio && ratio < 1.01, "{ratio}: {closed:?}, {open:?}");
    }
    let step = of([1.0, 0.0]);
    let fields = StressFields::new(step.finest(), MeanStress::Confined);
    let map = percoat::DamageMap::of(&step, &step.reading(), fields.body()).unwrap();
    let means = map.damage.outer_iter().zip(&map.z).filter(|(_, depth)| depth.material == 2);
    let known = means.map(|(line, _)| line.mean().unwrap()).fold(0.0, f64::max);
    let open = fatigue(&of([1.0, 1e-5 / TAU]));
    let found = open.lives[1];
    assert!(matches!(found.part, FatiguePart::Material(material) if material.number == 2));
    // Between planes of the map the mean is larger by some hundredths.
    println!("{} {known}", found.damage);
    assert!((found.damage / known - 1.0).abs() < 0.05, "{} {known}", found.damage);
}

/// Doubling τ₀ multiplies each life by 2^m, doubling N₀ by 2.
#[test]
fn lives_follow_their_law() {
    let of = |law: Fatigue| {
        let tires = Durability { fatigue: Some(law), ..Durability::default() };
        let half_space =
            HalfSpace::new(vec![], Material::from_young(1.0, NU).unwrap()).with_substrate_durability(tires).unwrap();
        let problem = Problem::new(indenters(Cell::square(4.0).unwrap(), &[[0.0; 2]]), half_space);
        fatigue(&solved(problem, [64; 2], Load::MeanPressure(0.02))).first.passes
    };
    let passes = of(Fatigue::new(0.3, 1e6, 8.0).unwrap());
    assert!((of(Fatigue::new(0.6, 1e6, 8.0).unwrap()) / passes / 256.0 - 1.0).abs() < 1e-12);
    assert!((of(Fatigue::new(0.3, 2e6, 8.0).unwrap()) / passes / 2.0 - 1.0).abs() < 1e-12);
}

/// A counterbody is loaded and unloaded: that of the same material and shape bears under its surface what the body bears from far
/// away, the largest τ₁ of Hertz.
#[test]
fn an_elastic_counterbody_is_loaded_and_unloaded() {
    let window = Cell::window([2.7; 2]).unwrap();
    let bodies = Bodies::elastic(bare(), bare());
    let step = solved(Problem::new(indenters(window, &[[0.5; 2]]), bodies), [128; 2], Load::Force(0.5 * FORCE));
    let reading = fatigue(&step);
    let [body, counterbody] = reading.lives[..] else { panic!("{reading:?}") };
    assert!((body.range / counterbody.range - 1.0).abs() < 1e-9, "{reading:?}");
    assert!((body.range / (0.5 * P0) / 0.310021 - 1.0).abs() < 3e-4, "{reading:?}");
    assert!(matches!(counterbody.part, FatiguePart::Material(material) if material.is_counterbody()));
}

/// A run gives the lives and the endurance, the same with any number of threads.
#[test]
fn a_run_has_lives_and_endurance_whatever_the_threads() {
    let endurance = Endurance::new(0.2, 0.3).unwrap();
    let problem =
        Arc::new(Problem::new(indenters(Cell::square(4.0).unwrap(), &[[0.0; 2]]), coated(0.2, Some(endurance))));
    let run = Run::new(Arc::clone(&problem), vec![Load::MeanPressure(0.02)], Sampling::Points([96; 2]));
    let of = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let outcome = pool.install(|| run.solve(&mut ())).unwrap();
        outcome.steps.into_iter().next().unwrap()
    };
    let [one, three] = [1, 3].map(of);
    assert_eq!((&one.fatigue, &one.strength), (&three.fatigue, &three.strength));
    assert_eq!(one.fatigue.as_ref().unwrap().lives.len(), 3);
    let names: Vec<&str> = one.strength.iter().map(|row: &Utilisation| row.criterion.name()).collect();
    assert_eq!(names, ["crossland", "dang_van", "crossland", "dang_van"]);
    let kinds: Vec<Criterion> = one.strength.iter().map(|row| row.criterion).collect();
    assert_eq!(kinds, Criterion::all(problem.bodies()));
    assert!(one.strength.iter().all(|row| row.value > 0.0 && row.error.is_some()), "{:?}", one.strength);
    assert_eq!(one.check(), Ok(()));
}

/// One pass of a ball from far away: the path from rest. On the axis of symmetry the deviator under the middle, at its largest, is the end
/// of the longest chord from rest unless two places before and behind differ more: Crossland is at least that.
#[test]
fn endurance_of_one_pass_is_at_least_that_of_loading_the_middle() {
    let endurance = Endurance::new(0.2, 0.3).unwrap();
    let material = Material::from_young(1.0, NU).unwrap();
    let endures = Durability { endurance: Some(endurance), ..Durability::default() };
    let half_space = HalfSpace::new(vec![], material).with_substrate_durability(endures).unwrap();
    let window = Cell::window([2.7; 2]).unwrap();
    let run = Run::new(
        Problem::new(indenters(window, &[[0.5; 2]]), half_space),
        vec![Load::Force(FORCE)],
        Sampling::Points([128; 2]),
    );
    let outcome = run.solve(&mut ()).unwrap();
    let least = endurance.crossland(0.5 * 2.0 / 3f64.sqrt() * 0.310021 * P0, 0.0);
    for found in &outcome.steps[0].strength {
        println!("{found:?}, {least}");
        if found.criterion.name() == "crossland" {
            assert!(found.value > least, "{found:?}, {least}");
        }
    }
}
