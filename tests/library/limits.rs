//! Limit loads: what is found is where a criterion becomes one, from any load on, in any unit.

use crate::common;

use common::one_level;
use percoat::body::{Durability, InterfaceStrength, Strength};
use percoat::reading::Criterion;
use percoat::run::{At, GridStart, Limit, Limits, Recorder, RefinementEnd, RunError, SearchEnd, StepRecord};
use percoat::{
    Cell, Friction, HalfSpace, Interface, Lattice, Layer, Level, Load, LoadQuantity, Material, Problem, Run, Sampling,
    Shape, Step, Stop, StressFields,
};
use std::convert::Infallible;

const NO_BOND: InterfaceStrength = InterfaceStrength { normal: None, shear: None, friction: 0.0 };

/// A hard coating under residual compression that slides, and everything of it with a strength; lengths and pressures in
/// any unit.
fn coated([length, pressure]: [f64; 2]) -> Problem {
    let material = |young: f64, nu: f64| Material::from_young(young * pressure, nu).unwrap();
    let strength = |yielding: f64, tensile: Option<f64>| Strength {
        yielding: Some(yielding * pressure),
        tensile: tensile.map(|tensile| tensile * pressure),
    };
    let bond = InterfaceStrength { normal: Some(0.5 * pressure), shear: Some(1.0 * pressure), friction: 0.0 };
    let coating = Layer::new(material(200.0, 0.25), 2.0 * length, Interface::Bonded).unwrap();
    let coating = coating.with_residual_stress(-2.0 * pressure).unwrap();
    let coating = coating.with_strengths(strength(8.0, Some(1.5)), bond).unwrap();
    let half_space = HalfSpace::new(vec![coating], material(210.0, 0.3));
    let half_space = half_space.with_substrate_strength(strength(2.0, None)).unwrap();
    let level = Level::new(Shape::Sphere { radius: 50.0 * length }, 0.0).unwrap();
    let indenters = one_level(Lattice::square(20.0 * length, 1).unwrap(), level);
    Problem::new(indenters, half_space).sliding(Friction::new(0.2, [1.0, 0.5]).unwrap()).unwrap()
}

/// One shape on a body that yields at a stress, in contact modulus 1.
fn bare(shape: Shape, yielding: f64) -> Problem {
    let half_space = HalfSpace::new(vec![], Material::from_young(0.91, 0.3).unwrap());
    let strength = Strength { yielding: Some(yielding), tensile: None };
    let half_space = half_space.with_substrate_strength(strength).unwrap();
    Problem::new(one_level(Lattice::hexagonal(1.0, 1).unwrap(), Level::new(shape, 0.0).unwrap()), half_space)
}

fn limits(problem: Problem, start: Load, points: usize) -> Limits {
    Run::new(problem, vec![start], Sampling::Points([points; 2])).limits(&mut ()).unwrap()
}

fn loads(limits: &Limits) -> Vec<f64> {
    limits.limits.iter().map(percoat::run::Limit::load).collect()
}

/// Solved afresh at its limit, a criterion is one: u grows as p̄ to some power below two.
#[test]
fn at_its_limit_each_criterion_is_one_at_the_place_that_is_told() {
    let problem = coated([1.0; 2]);
    let found = limits(problem.clone(), Load::MeanPressure(0.05), 96);
    assert!(found.converged() && found.steps.is_sorted_by_key(|step| step.reading.mean_pressure.unwrap()));
    let expected =
        [Criterion::yield_of(1), Criterion::yield_of(2), Criterion::cracking_of(1), Criterion::delamination_of(1)];
    assert_eq!(found.limits.iter().map(|limit| limit.criterion).collect::<Vec<_>>(), expected);
    for limit in &found.limits {
        let At::Load { load: mean_pressure, position, error, .. } = limit.at else { panic!("{limit:?}") };
        let run = Run::new(problem.clone(), vec![Load::MeanPressure(mean_pressure)], Sampling::Points([96; 2]));
        let step = run.solve(&mut ()).unwrap().steps.remove(0);
        let row = step.strength.iter().find(|row| row.criterion == limit.criterion).unwrap();
        assert!((row.value - 1.0).abs() < 2e-3, "{limit:?}: {row:?}");
        let apart = (0..3).map(|k| (row.position[k] - position[k]).abs()).fold(0.0, f64::max);
        assert!(apart < 20.0 / 96.0, "{limit:?}: {row:?}");
        assert!(error.is_some_and(|error| error > 0.0), "{limit:?}");
    }
    let first = found.first().unwrap();
    assert_eq!(first.load(), loads(&found).into_iter().fold(f64::INFINITY, f64::min));
    let shown = &found.shown[0];
    assert_eq!((shown.limit, &shown.limit), (*first, first));
    assert!((shown.step.reading().mean_pressure.unwrap() / first.load() - 1.0).abs() < 1e-12);
    let run = Run::new(problem, vec![Load::MeanPressure(0.1)], Sampling::Points([96; 2]));
    let sections = found.shown[0].sections(&run).unwrap();
    assert_eq!(sections.len(), 1, "of the body alone under a rigid counterbody");
    assert_eq!(sections[0].line.origin, [first.position().unwrap()[0], first.position().unwrap()[1]]);
}

#[test]
fn limits_do_not_depend_on_the_first_load_and_scale_with_the_units() {
    let known = limits(coated([1.0; 2]), Load::MeanPressure(0.05), 48);
    for start in [Load::MeanPressure(1e9), Load::Penetration(0.03)] {
        assert_eq!(limits(coated([1.0; 2]), start, 48).limits, known.limits, "{start:?}");
    }
    let [length, pressure] = [1e-6, 1e9];
    let scaled = loads(&limits(coated([length, pressure]), Load::MeanPressure(0.05 * pressure), 48));
    for (found, known) in scaled.into_iter().zip(loads(&known)) {
        assert!((found / (known * pressure) - 1.0).abs() < 1e-6, "{found} {known}");
    }
}

/// Criteria that hold under the largest load asked for have no limit; those that fail below it have that of any search.
#[test]
fn a_search_up_to_a_load_solves_no_higher_one() {
    let run = Run::new(coated([1.0; 2]), vec![Load::MeanPressure(0.05)], Sampling::Points([64; 2]));
    let whole = run.limits(&mut ()).unwrap();
    let mut known = loads(&whole);
    known.sort_by(f64::total_cmp);
    // Between the first limit and the second, below all of them, and below the first load of the search.
    for most in [(known[0] * known[1]).sqrt(), 0.5 * known[0], 1e-3 * known[0]] {
        let found = run.limits_up_to(most, &mut ()).unwrap();
        let highest = found.steps.last().unwrap().reading.mean_pressure.unwrap();
        assert!((highest / most - 1.0).abs() < 1e-9, "{highest} {most}");
        for (limit, other) in found.limits.iter().zip(&whole.limits) {
            if other.load() < most {
                assert!((limit.load() / other.load() - 1.0).abs() < 2e-3, "{limit:?} {other:?}");
            } else {
                assert!(matches!(limit.at, At::Never { end: SearchEnd::LargestLoad, .. }), "{limit:?}");
            }
        }
        assert_eq!(found.to_string().starts_with("nothing fails up to the mean pressure"), most < known[0], "{found}");
    }
}

#[test]
fn what_is_never_reached_or_at_once_is_said() {
    const PARABOLOID: Shape = Shape::Paraboloid { radius: 1.0 };
    let at = |problem: Problem| {
        let found = limits(problem, Load::MeanPressure(0.01), 48);
        assert!(found.converged(), "{:?}", found.warnings);
        (found.limits[0].at, found.to_string(), found)
    };
    let (never, words, found) = at(bare(PARABOLOID, 100.0));
    let At::Never { up_to, utilisation, at: load, .. } = never else { panic!("{never:?}") };
    assert!((up_to / found.complete - 1.0).abs() < 1e-12 && 0.0 < utilisation && utilisation < 1.0 && load <= up_to);
    assert!(found.steps.last().unwrap().reading.contact_fraction.unwrap() > 0.99);
    assert!(words.contains("nothing fails") && words.contains("contact is complete"), "{words}");
    assert!(found.first().is_none() && found.shown.is_empty());

    let (below, words, found) = at(bare(PARABOLOID, 1e-5));
    let At::Below { load: mean_pressure, .. } = below else { panic!("{below:?}") };
    // Three samples along the radius, and the load is halved: 2^⅓ times as many at most.
    let samples = found.steps[0].reading.contact_fraction.unwrap() * 48.0 * 48.0;
    assert!(mean_pressure < 0.01 && (28.0..45.0).contains(&samples), "{below:?} {samples}");
    assert!(words.contains("less than"), "{words}");

    let (tip, words, found) = at(bare(Shape::Cone { slope: 0.1 }, 0.2));
    assert_eq!(tip, At::Tip { position: [0.0; 3] });
    assert!(words.contains("under a tip") && found.steps.len() < 20, "{words}");

    // A tip on the lower of two levels fails where it touches, from whatever load the search begins.
    let lower = |start: f64| {
        let level = |shape, height| Level::new(shape, height).unwrap();
        let levels = vec![level(PARABOLOID, 0.01), level(Shape::Cone { slope: 0.1 }, 0.0)];
        let indenters = percoat::Indenters::new(Lattice::square(1.0, 2).unwrap(), levels).unwrap();
        let half_space = bare(PARABOLOID, 2.0).half_space().clone();
        limits(Problem::new(indenters, half_space), Load::MeanPressure(start), 48)
    };
    let [before, after] = [1e-4, 0.2].map(|start| match lower(start).limits[0].at {
        At::Load { load: mean_pressure, error: None, .. } => mean_pressure,
        other => panic!("from {start}: {other:?}"),
    });
    assert!((before / after - 1.0).abs() < 2e-3 && before > 2e-4, "{before} {after}");

    // A layer of the substrate's own kind, whose residual stress is as large as its yield strength.
    let material = Material::from_young(0.91, 0.3).unwrap();
    let layer = |residual: f64| {
        let layer = Layer::new(material, 0.1, Interface::Bonded).unwrap().with_residual_stress(residual).unwrap();
        layer.with_strengths(Strength { yielding: Some(0.1), tensile: Some(0.1) }, NO_BOND).unwrap()
    };
    let indenters = || one_level(Lattice::hexagonal(1.0, 1).unwrap(), Level::new(PARABOLOID, 0.0).unwrap());
    let rest = |residual| at(Problem::new(indenters(), HalfSpace::new(vec![layer(residual)], material))).2;
    let pressed = rest(-0.1);
    assert_eq!(pressed.limits[0].at, At::Rest);
    assert!(pressed.limits[1].load() > 0.0 && pressed.to_string().contains("residual stress alone"));
    let pulled = rest(0.1);
    assert_eq!(pulled.limits.iter().map(|limit| limit.at).collect::<Vec<_>>(), [At::Rest; 2]);
    assert!(pulled.steps.is_empty(), "nothing is left to be solved");
}

/// Problem of [`bare`] with a hardness of its surface.
fn hard(shape: Shape, yielding: f64, hardness: f64) -> Problem {
    let problem = bare(shape, yielding);
    let durability = Durability { hardness: Some(hardness), ..Durability::default() };
    problem.on_body(problem.half_space().clone().with_substrate_durability(durability).unwrap())
}

/// The search ends at 0.999 of the hardness, which is not complete contact, unless contact is complete before.
#[test]
fn a_search_ends_at_the_hardness_and_says_so() {
    const PARABOLOID: Shape = Shape::Paraboloid { radius: 1.0 };
    let ended = |problem: Problem| {
        let found = limits(problem, Load::MeanPressure(0.01), 48);
        assert!(found.converged(), "{:?}", found.warnings);
        let At::Never { up_to, end, .. } = found.limits[0].at else { panic!("{found}") };
        (up_to, end, found)
    };
    let (complete, end, elastic) = ended(bare(PARABOLOID, 100.0));
    assert_eq!((end, elastic.hardness_load), (SearchEnd::CompleteContact, f64::INFINITY));

    let hardness = 0.05 * complete;
    let (up_to, end, found) = ended(hard(PARABOLOID, 100.0, hardness));
    assert_eq!((end, found.complete), (SearchEnd::Hardness, f64::INFINITY));
    assert!((up_to / (0.999 * hardness) - 1.0).abs() < 1e-9 && found.hardness_load == 0.999 * hardness, "{up_to}");
    let last = &found.steps.last().unwrap().reading;
    assert!(last.max_pressure == hardness && last.contact_fraction.unwrap() > 0.998, "{last}");
    let words = found.in_words(|load| format!("{:.4} H", load / hardness));
    assert_eq!(
        words,
        "nothing fails up to the mean pressure 0.9990 H, 0.999 of the most that the hardness lets the surface bear"
    );

    let (up_to, end, found) = ended(hard(PARABOLOID, 100.0, 20.0 * complete));
    assert_eq!((end, found.complete), (SearchEnd::CompleteContact, elastic.complete));
    assert!((up_to / complete - 1.0).abs() < 1e-9 && found.to_string().ends_with("where contact is complete"));
}

/// Under a flat surface stresses are proportional to the load, with a hardness too: a limit below it is found from where everything
/// holds, one above it is not reached.
#[test]
fn a_hardness_ends_the_search_under_a_flat_surface() {
    let searched = |hardness: f64| {
        let cell = Cell::square(1.0).unwrap();
        let flat = percoat::Topography::new(cell, ndarray::Array2::zeros([24, 24])).unwrap();
        let body = hard(Shape::Paraboloid { radius: 1.0 }, 0.1, hardness).half_space().clone();
        limits(Problem::new(flat, body), Load::MeanPressure(0.01), 24)
    };
    let elastic = searched(1e3);
    let At::Load { load: yields, .. } = elastic.limits[0].at else { panic!("{elastic}") };
    let above = searched(2.0 * yields);
    assert!((above.limits[0].load() / yields - 1.0).abs() < 1e-3 && above.steps.len() < 20, "{above}");
    let below = searched(0.5 * yields);
    let At::Never { up_to, end, .. } = below.limits[0].at else { panic!("{below}") };
    assert!(end == SearchEnd::Hardness && !below.ends_at_border && below.steps.len() < 20, "{below}");
    assert!((up_to / (0.4995 * yields) - 1.0).abs() < 1e-9 && below.converged(), "{:?}", below.warnings);
}

/// An isolated contact outgrows a window that the hardness would fill, and is solved in a larger one: no load is too large for it.
#[test]
fn a_hardness_does_not_end_the_search_of_an_isolated_contact() {
    let cell = Cell::window([1.0; 2]).unwrap();
    let lattice = Lattice::new(cell, vec![vec![[0.5; 2]]]).unwrap();
    const PARABOLOID: Shape = Shape::Paraboloid { radius: 1.0 };
    let indenters = percoat::Indenters::new(lattice, vec![Level::new(PARABOLOID, 0.0).unwrap()]).unwrap();
    for hardness in [0.01, 0.3] {
        let body = hard(PARABOLOID, 100.0, hardness).half_space().clone();
        let found = limits(Problem::new(indenters.clone(), body), Load::Force(0.001), 24);
        let At::Never { up_to, end, .. } = found.limits[0].at else { panic!("{found}") };
        let stops: Vec<Stop> = found.steps.iter().map(|step| step.stop).collect();
        assert!(!stops.contains(&Stop::BeyondHardness) && !stops.contains(&Stop::AtBorder), "{stops:?}");
        assert!(end == SearchEnd::LargestLoad && found.ends_at_border, "{found}");
        assert!(up_to > 100.0 * hardness && found.window.is_some_and(|[side, _]| side > 8.0), "{up_to}");
    }
}

/// A stiff coating on a soft body, which comes off where it is opened: between the spheres.
fn peeling(strength: f64) -> Problem {
    let material = |young: f64, nu: f64| Material::from_young(young, nu).unwrap();
    let bond = InterfaceStrength { normal: Some(strength), shear: None, friction: 0.0 };
    let stiff = Layer::new(material(400.0, 0.25), 1.0, Interface::Bonded).unwrap();
    let stiff = stiff.with_strengths(Strength::default(), bond).unwrap();
    let level = Level::new(Shape::Sphere { radius: 50.0 }, 0.0).unwrap();
    let indenters = one_level(Lattice::square(20.0, 1).unwrap(), level);
    Problem::new(indenters, HalfSpace::new(vec![stiff], material(10.0, 0.3)))
}

/// Tension that opens an interface falls towards complete contact: the least load that opens it is found, whatever the
/// loads of the run.
#[test]
fn what_fails_at_lesser_loads_only_is_found_from_larger_ones() {
    let from = |start: f64| {
        let found = limits(peeling(1e-3), Load::MeanPressure(start), 96);
        let At::Load { load: mean_pressure, position, .. } = found.limits[0].at else {
            panic!("from {start}: {found}")
        };
        assert_eq!(found.shown[0].limit.position(), Some(position));
        (mean_pressure, found.complete)
    };
    let (known, complete) = from(0.05);
    assert!(known < 1e-3 * complete);
    for start in [5.0, 10.0 * complete] {
        assert_eq!(from(start).0, known, "from {start}");
    }
}

/// An opening that rises with the load and falls again is found at its top, between the loads of a search that doubles them.
#[test]
fn a_largest_utilisation_is_found_between_the_loads() {
    let start = Load::MeanPressure(0.05);
    let found = limits(peeling(1e3), start, 48);
    let At::Never { up_to, .. } = found.limits[0].at else { panic!("{found}") };
    // An unbreakable bond has no limit to search for: the loads are the doublings.
    let taken = |step: &StepRecord| (1e3 * step.strength[0].value, step.reading.mean_pressure.unwrap());
    let (doubled, at) = found.steps.iter().map(taken).max_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
    assert!(at < 0.5 * up_to, "it falls again: {at} {up_to}");
    let paths = (0..60).map(|k| Load::MeanPressure(0.5 * at * 4f64.powf(f64::from(k) / 60.0))).collect();
    let path = Run::new(peeling(1e3), paths, Sampling::Points([48; 2])).solve(&mut ()).unwrap().steps;
    let fine: Vec<(f64, f64)> = path.iter().map(taken).collect();
    let top = fine.iter().map(|(value, _)| *value).fold(0.0, f64::max);
    assert!(doubled < 0.995 * top, "{doubled} {top}");
    // Between the best doubling and the top it is reached, where the fine path is.
    let strength = (doubled * top).sqrt();
    let found = limits(peeling(strength), start, 48);
    let At::Load { load: mean_pressure, .. } = found.limits[0].at else { panic!("{found}") };
    let (_, reached) = fine.iter().find(|(value, _)| *value >= strength).unwrap();
    assert!((mean_pressure..1.025 * mean_pressure).contains(reached), "{mean_pressure} {reached}");
    // Above the top nothing fails, and how near it comes is known to a hundredth.
    let found = limits(peeling(1.2 * top), start, 48);
    let At::Never { utilisation, .. } = found.limits[0].at else { panic!("{found}") };
    assert!((1.2 * utilisation - 1.0).abs() < 0.01, "{utilisation}");
}

/// Keeps what it hears; it has room for so many points.
#[derive(Default)]
struct Heard {
    grids: Vec<usize>,
    steps: usize,
    room: usize,
}

impl Recorder for Heard {
    type Error = Infallible;

    fn fits(&self, [n, _]: [usize; 2]) -> bool {
        n <= self.room
    }

    fn begin(&mut self, solver: &GridStart) -> Result<(), Infallible> {
        self.grids.push(solver.grid().points()[0]);
        Ok(())
    }

    fn step(&mut self, _: &Step, record: &StepRecord, fields: Option<&StressFields>) -> Result<(), Infallible> {
        assert!(fields.is_some() && !record.strength.is_empty());
        self.steps += 1;
        Ok(())
    }
}

#[test]
fn an_accuracy_refines_until_limits_change_by_less_or_there_is_no_room() {
    let run = |accuracy: f64| {
        let problem = bare(Shape::Paraboloid { radius: 1.0 }, 0.1);
        Run::new(problem, vec![Load::MeanPressure(0.01)], Sampling::Accuracy(accuracy))
    };
    let mut roomy = Heard { room: 1000, ..Heard::default() };
    let found = run(0.02).limits(&mut roomy).unwrap();
    assert_eq!((found.end, found.converged()), (Some(RefinementEnd::Reached), true));
    assert!(found.change.is_some_and(|change| 0.0 < change && change < 0.02), "{:?}", found.change);
    assert!(roomy.grids.len() > 1 && roomy.steps > found.steps.len());
    // A limit that is never reached has no load that could change.
    let tough = Strength { yielding: Some(0.1), tensile: Some(100.0) };
    let body =
        bare(Shape::Paraboloid { radius: 1.0 }, 0.1).half_space().clone().with_substrate_strength(tough).unwrap();
    let level = Level::new(Shape::Paraboloid { radius: 1.0 }, 0.0).unwrap();
    let problem = Problem::new(one_level(Lattice::hexagonal(1.0, 1).unwrap(), level), body);
    let both = Run::new(problem, vec![Load::MeanPressure(0.01)], Sampling::Accuracy(0.02)).limits(&mut ()).unwrap();
    assert!(matches!(both.limits[1].at, At::Never { .. }), "{both}");
    assert!(
        both.end == Some(RefinementEnd::Reached) && both.change.is_some_and(|change| change < 0.02),
        "{:?}",
        both.change
    );
    assert!((loads(&both)[0] / loads(&found)[0] - 1.0).abs() < 2e-3, "{both} {found}");
    let mut narrow = Heard { room: 100, ..Heard::default() };
    let found = run(1e-6).limits(&mut narrow).unwrap();
    assert_eq!((found.end, found.converged(), narrow.grids), (Some(RefinementEnd::Room), false, vec![96]));
    assert!(found.warnings.iter().any(|warning| warning.contains("grid.accuracy is not reached")));
}

#[test]
fn a_search_without_strengths_is_refused_and_needs_no_loads() {
    let run = |problem: Problem, loads: Vec<Load>| Run::new(problem, loads, Sampling::Points([48; 2]));
    let plain = common::PAPER[0].problem();
    assert!(matches!(run(plain, vec![Load::MeanPressure(0.01)]).check_limits(), Err(RunError::NoStrengths)));
    let of = |loads: Vec<Load>| {
        let run = run(bare(Shape::Paraboloid { radius: 1.0 }, 0.1), loads);
        run.check_limits().unwrap();
        run.limits(&mut ()).unwrap().limits
    };
    let expected = of(vec![Load::MeanPressure(0.01)]);
    for loads in [vec![], vec![Load::MeanPressure(0.0)], vec![Load::Penetration(-0.1)], vec![Load::Penetration(9.0)]] {
        assert_eq!(of(loads), expected);
    }
}

/// A bare sphere slides: von Mises at the trailing edge is hardly above that inside, and only ten samples reach from the centre
/// to it. The limit load by the closed form lies within the interval of the limit load that the search states.
#[test]
#[cfg(feature = "validate")]
fn the_limit_of_a_coarse_sliding_sphere_covers_the_closed_form() {
    let (nu, friction, radius) = (0.3, 0.315, 10.0 / 128.0);
    let largest = common::largest_mises_of_a_sliding_sphere(nu, friction);
    let load = 4.0 / 3.0 * f64::powi(radius, 3);
    let peak = 1.5 * load / (std::f64::consts::PI * radius * radius);
    let strength = Strength { yielding: Some(largest * peak), tensile: None };
    let body = HalfSpace::new(vec![], Material::from_young(1.0 - nu * nu, nu).unwrap());
    let body = body.with_substrate_strength(strength).unwrap();
    let level = Level::new(Shape::Paraboloid { radius: 1.0 }, 0.0).unwrap();
    let sliding = Friction::new(friction, [1.0, 0.0]).unwrap().uncoupled();
    let problem = Problem::new(one_level(Lattice::square(1.0, 1).unwrap(), level), body).sliding(sliding).unwrap();
    let found = limits(problem, Load::MeanPressure(load), 128);
    let At::Load { load: mean_pressure, interval: [from, to], .. } = found.limits[0].at else { panic!("{found}") };
    // The images of the lattice add some (a/l)³ to a load that grows as the cube of the stress.
    let images = 3.0 * f64::powi(radius, 3);
    println!("{:.5}: {:.5} to {:.5}", mean_pressure / load, from / load, to / load);
    assert!(from / load - images <= 1.0 && 1.0 <= to / load + images, "{:?}", [from, to].map(|end| end / load));
    // A tenth of the stress, as far as ten samples know the edge, is a third of the load.
    assert!(from < mean_pressure && mean_pressure < to && to - from < 0.67 * mean_pressure, "{found}");
}

/// A limit is no sharper than its error, nor is what comes first.
#[test]
fn an_error_is_told_with_what_else_may_come_first() {
    let limit = |material: usize, mean_pressure: f64, error: f64| Limit {
        quantity: LoadQuantity::MeanPressure,
        criterion: Criterion::cracking_of(material),
        at: At::Load {
            load: mean_pressure,
            error: Some(error),
            interval: [mean_pressure - error, mean_pressure + error],
            position: [0.0; 3],
        },
    };
    let words = |limits: Vec<Limit>| {
        let (steps, warnings) = (Vec::new(), Vec::new());
        let quantity = LoadQuantity::MeanPressure;
        Limits {
            limits,
            steps,
            shown: Vec::new(),
            quantity,
            complete: f64::INFINITY,
            hardness_load: f64::INFINITY,
            window: None,
            ends_at_border: false,
            change: None,
            end: None,
            warnings,
        }
        .to_string()
    };
    let sharp = [limit(1, 0.5, 1e-4), limit(2, 0.6, 1e-3)];
    assert_eq!(words(sharp.to_vec()), "first: cracking of material 1 at the mean pressure 0.50000");
    let blurred = [limit(1, 0.5, 0.06), limit(2, 0.7, 0.2), limit(3, 0.8, 0.1)];
    assert_eq!(
        words(blurred.to_vec()),
        "first: cracking of material 1 at the mean pressure 0.50000 ± 12 %, or cracking of material 2 within the errors"
    );
}

/// Equal moduli, an interface at a twentieth of the radius, sliding: its shear and tension rise above 1, fall below it and rise
/// again. From a load between both crossings the search once found the second, 0.171.
#[test]
fn the_first_failure_is_that_of_a_hump_below_the_load_of_the_case() {
    let material = Material::from_young(1.0, 0.3).unwrap();
    let bond = InterfaceStrength { normal: Some(0.002), shear: Some(0.2), friction: 0.0 };
    let layer = Layer::new(material, 0.05, Interface::Bonded).unwrap();
    let layer = layer.with_strengths(Strength::default(), bond).unwrap();
    let level = Level::new(Shape::Paraboloid { radius: 1.0 }, 0.0).unwrap();
    let problem =
        Problem::new(one_level(Lattice::square(1.0, 1).unwrap(), level), HalfSpace::new(vec![layer], material));
    let problem = problem.sliding(Friction::new(0.6, [1.0, 0.0]).unwrap()).unwrap();
    let found = limits(problem.clone(), Load::MeanPressure(0.1), 96);
    let At::Load { load: mean_pressure, interval: [from, to], .. } = found.limits[0].at else { panic!("{found}") };
    assert!((0.027..0.035).contains(&mean_pressure) && from < mean_pressure && mean_pressure < to, "{found}");
    // A fine path, solved on its own, first reaches 1 within the interval, and 1 − u is at least its error before.
    let loads = (0..40).map(|k| Load::MeanPressure(0.01 * 1.06f64.powi(k))).collect();
    let path = Run::new(problem, loads, Sampling::Points([96; 2])).solve(&mut ()).unwrap().steps;
    let taken = |step: &StepRecord| {
        (step.reading.mean_pressure.unwrap(), step.strength[0].value, step.strength[0].error.unwrap())
    };
    let (least, ..) = path.iter().map(taken).find(|(_, u, e)| u + e >= 1.0).unwrap();
    let (reached, ..) = path.iter().map(taken).find(|(_, u, _)| *u >= 1.0).unwrap();
    let (sure, ..) = path.iter().map(taken).find(|(_, u, e)| u - e >= 1.0).unwrap();
    assert!(
        least * 1.001 > from && (mean_pressure..mean_pressure * 1.061).contains(&reached),
        "{least} {from} {reached}"
    );
    assert!(sure < 1.07 * to && sure > to / 1.07, "{sure} {to}");
}

/// The sphere of [`coated`] alone: the limits found in a narrow window, which its contact outgrows, are those found in a wide one,
/// within the errors that both state.
#[test]
fn a_contact_that_outgrows_its_window_has_the_limits_of_a_wide_one() {
    let periodic = coated([1.0, 1.0]);
    let level = periodic.indenters().unwrap().levels()[0].clone();
    let found = |side: f64, points: usize| {
        let lattice = Lattice::new(Cell::window([side; 2]).unwrap(), vec![vec![[0.5; 2]]]).unwrap();
        let problem = Problem::new(one_level(lattice, level.clone()), periodic.half_space().clone());
        limits(problem.sliding(*periodic.friction().unwrap()).unwrap(), Load::Force(1.0), points)
    };
    let (narrow, wide) = (found(4.0, 32), found(24.0, 64));
    let [width, height] = narrow.window.expect("a contact too large for its window");
    assert!(width == height && width >= 8.0 && wide.window.is_none(), "{width}, {:?}", wide.window);
    for (limit, other) in narrow.limits.iter().zip(&wide.limits) {
        let ends = |limit: &Limit| limit.interval();
        let ([from, to], [low, high]) = (ends(limit), ends(other));
        assert!(limit.load().is_finite() && from <= high && low <= to, "{limit:?}, {other:?}");
    }
    assert!(narrow.converged() && narrow.warnings.iter().all(|words| !words.contains("lattice.size")));
    // The section at a limit is that of the contact, not cut at the border of the narrow window.
    let shown = narrow.shown.iter().find(|shown| shown.record.reading.levels[0].contact_radius > Some(2.0));
    let shown = shown.expect("a contact wider than the narrow window");
    let lattice = Lattice::new(Cell::window([4.0; 2]).unwrap(), vec![vec![[0.5; 2]]]).unwrap();
    let problem = Problem::new(one_level(lattice, level.clone()), periodic.half_space().clone());
    let problem = problem.sliding(*periodic.friction().unwrap()).unwrap();
    let sections = shown.sections(&Run::new(problem, vec![], Sampling::Points([32; 2]))).unwrap();
    let [from, to] = sections[0].line.span;
    let radius = shown.record.reading.levels[0].contact_radius.unwrap();
    assert!(to - from > 2.0 * radius, "{from} {to}, {radius}");
    // Ordered by load, whatever the window.
    assert!(narrow.steps.is_sorted_by(|one, other| one.reading.force < other.reading.force));
}

/// Beside the border of its window a contact has no room under any load: the search begins in a larger window.
#[test]
fn a_contact_at_the_border_under_the_first_load_is_searched_in_a_larger_window() {
    let of = |place: f64, side: f64| {
        let lattice = Lattice::new(Cell::window([side; 2]).unwrap(), vec![vec![[0.5 + place / side, 0.5]]]).unwrap();
        let body = HalfSpace::new(vec![], Material::from_young(0.91, 0.3).unwrap());
        let body = body.with_substrate_strength(Strength { yielding: Some(0.1), tensile: None }).unwrap();
        let level = Level::new(Shape::Paraboloid { radius: 1.0 }, 0.0).unwrap();
        limits(Problem::new(one_level(lattice, level), body), Load::Force(1e-3), 64)
    };
    let (beside, middle) = (of(0.49, 1.0), of(0.0, 2.0));
    assert!(beside.window.is_some_and(|[width, _]| width >= 2.0), "{:?}", beside.window);
    let [[from, to], [low, high]] = [&beside, &middle].map(|limits| limits.limits[0].interval());
    assert!(from <= high && low <= to && to < 1.1 * from, "{from} {to}, {low} {high}");
}
