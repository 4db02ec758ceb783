//! Limits of random cases against fine paths of solved loads, from four starting loads each.

use crate::common;

use common::{Random, paraboloid};
use percoat::body::{InterfaceStrength, Strength};
use percoat::reading::Utilisation;
use percoat::run::{At, Limit, Limits, StepRecord, StressRequest};
use percoat::{
    Cell, Friction, HalfSpace, Indenters, Interface, Lattice, Layer, Level, Load, Material, Problem, Run, Sampling,
    Shape, Solver,
};
use rayon::prelude::*;

/// Neighbouring loads of the path.
const RATIO: f64 = 1.06;
/// Below this part of complete contact no path begins.
const LEAST: f64 = 1e-5;

/// One to three layers on a substrate, bonded, sliding or on springs, thin to thick, some under residual stress.
fn layers(random: &mut Random) -> Vec<Layer> {
    (0..random.pick(&[1, 1, 2, 3]))
        .map(|_| {
            let nu = random.pick(&[0.0, 0.2, 0.3, 0.45, 0.5]);
            let material = Material::from_young(random.log(0.05, 20.0), nu).unwrap();
            let spring = Interface::Spring { tangential: random.log(0.3, 30.0), normal: f64::INFINITY };
            let interface = random.pick(&[Interface::Bonded, Interface::Bonded, Interface::Frictionless, spring]);
            Layer::new(material, random.log(0.02, 0.5), interface).unwrap()
        })
        .collect()
}

fn indenters(random: &mut Random) -> Indenters {
    let lattice = match random.pick(&[0, 1, 2]) {
        0 => Lattice::hexagonal(1.0, random.pick(&[1, 3])).unwrap(),
        1 => Lattice::square(1.0, random.pick(&[1, 2])).unwrap(),
        _ => {
            let cell = Cell::new([1.0, 0.0], [random.unit() - 0.5, 0.8 + 0.5 * random.unit()]).unwrap();
            Lattice::new(cell, vec![vec![[random.unit(), random.unit()]]]).unwrap()
        }
    };
    let levels = lattice.sites().iter().map(|_| {
        let power = Shape::Power { coefficient: random.log(0.2, 1.0), exponent: 1.6 + 2.0 * random.unit() };
        let drop = -0.02 * random.unit();
        if random.unit() < 0.7 { paraboloid(random.log(0.5, 2.0), drop) } else { Level::new(power, drop).unwrap() }
    });
    let levels = levels.collect();
    Indenters::new(lattice, levels).unwrap()
}

/// A problem whose materials and interfaces bear about what a random load causes; `None` where that is no stress.
fn random_problem(random: &mut Random, points: usize) -> Option<Problem> {
    let (layers, indenters) = (layers(random), indenters(random));
    let substrate = Material::from_young(1.0, random.pick(&[0.0, 0.3, 0.5])).unwrap();
    let mu = random.pick(&[0.0, 0.3, 0.6, 0.8]);
    let friction = Friction::new(mu, [1.0, 0.3]).unwrap();
    let friction = if random.unit() < 0.5 { friction } else { friction.uncoupled() };
    let sliding = |problem: Problem| {
        // Bodies that nothing holds do not slide.
        if mu > 0.0 { problem.clone().sliding(friction).unwrap_or(problem) } else { problem }
    };
    let bare = sliding(Problem::new(indenters.clone(), HalfSpace::new(layers.clone(), substrate)));
    let complete = Solver::new(bare.clone(), [points; 2], Default::default()).unwrap().full_contact_pressure();
    let load = Load::MeanPressure(random.log(3e-3, 0.6) * complete);
    let run = Run::new(bare, vec![load], Sampling::Points([points; 2]));
    let run = Run { stress: Some(StressRequest::default()), ..run };
    let stress = run.solve(&mut ()).unwrap().steps.remove(0).stress?;
    let near = |random: &mut Random, stress: f64| (stress > 0.0).then(|| stress * random.log(0.6, 1.6));
    let strong: Vec<Layer> = layers
        .into_iter()
        .enumerate()
        .map(|(index, layer)| {
            let (within, below) = (&stress.materials[index], &stress.interfaces[index]);
            let strength =
                Strength { yielding: near(random, within.mises.value), tensile: near(random, within.tension.value) };
            let bond = InterfaceStrength {
                normal: near(random, below.normal.value),
                shear: near(random, below.shear.value).filter(|_| layer.interface() != Interface::Frictionless),
                friction: 0.0,
            };
            layer.with_strengths(strength, bond).unwrap()
        })
        .collect();
    let yielding = near(random, stress.materials.last()?.mises.value);
    let half_space = HalfSpace::new(strong, substrate);
    let half_space = half_space.with_substrate_strength(Strength { yielding, tensile: None }).unwrap();
    Some(sliding(Problem::new(indenters, half_space)))
}

/// Utilisations of a criterion at loads that were solved.
struct Path {
    /// Mean pressures, ascending, with the utilisation at each.
    taken: Vec<(f64, Utilisation)>,
}

impl Path {
    fn first(&self, holds: impl Fn(&Utilisation) -> bool) -> f64 {
        self.taken.iter().find(|(_, row)| holds(row)).map_or(f64::INFINITY, |(load, _)| *load)
    }

    /// Contradiction of a limit to the path; `least` is the least load of its search, before which the path may begin.
    fn contradicts(&self, limit: &Limit, least: f64) -> Option<Fault> {
        let [may, is, must] = [
            self.first(|row| row.most() >= 1.0),
            self.first(|row| row.value >= 1.0),
            self.first(|row| row.least() >= 1.0),
        ];
        let [from, to] = limit.interval();
        let last = self.taken.last().map_or(0.0, |(load, _)| *load);
        let fault = match limit.at {
            At::Load { .. } if is < from && is >= least => "it fails before its interval",
            At::Load { .. } | At::Below { .. } if last > to * RATIO && is > to * RATIO => "it fails after its interval",
            At::Undecided { .. } | At::Never { .. } if must.is_finite() && must >= least => "it fails for sure",
            // The end of an interval is known to a tenth of it, as between the loads of the search.
            _ if may < from / 1.1 && may >= least => "it may fail before its interval",
            _ => return None,
        };
        let words = format!("{fault}: path {may:.5} {is:.5} {must:.5}, {limit:?}");
        Some(Fault { words, is_by_error: fault.starts_with("it may") })
    }
}

/// A contradiction.
struct Fault {
    words: String,
    /// Whether the error of a utilisation alone makes it: errors jump from load to load, so that one beside a load of the search
    /// may be larger.
    is_by_error: bool,
}

fn limits(problem: &Problem, start: Load, points: usize) -> Limits {
    Run::new(problem.clone(), vec![start], Sampling::Points([points; 2])).limits(&mut ()).unwrap()
}

/// Faults of the limits of a problem, and how many limits there are of each kind: at a load, below the least one, never,
/// undecided, without load.
fn faults_of(problem: &Problem, points: usize, mut random: Random) -> (Vec<Fault>, [usize; 5]) {
    let found = limits(problem, Load::MeanPressure(1e-3), points);
    for part in [1e-4, 0.03, 0.8] {
        let other = limits(problem, Load::MeanPressure(part * found.complete), points);
        assert_eq!(other.limits, found.limits, "from {part} of complete contact");
    }
    let [least, most] = [0, found.steps.len() - 1].map(|index| found.steps[index].reading.mean_pressure.unwrap());
    let first = least.max(LEAST * found.complete) * (1.0 + (RATIO - 1.0) * random.unit());
    let loads = std::iter::successors(Some(first), |load| Some(load * RATIO)).take_while(|load| *load < most);
    let loads: Vec<Load> = loads.map(Load::MeanPressure).collect();
    let steps = Run::new(problem.clone(), loads, Sampling::Points([points; 2])).solve(&mut ()).unwrap().steps;
    let (mut faults, mut kinds) = (Vec::new(), [0; 5]);
    for limit in &found.limits {
        let taken =
            |step: &'_ StepRecord| Some((step.reading.mean_pressure.unwrap(), *step.utilisation(limit.criterion)?));
        let path = Path { taken: steps.iter().filter_map(taken).collect() };
        if let Some(fault) = path.contradicts(limit, least) {
            let (friction, half_space) = (problem.friction(), problem.half_space());
            let words = format!("{}: from {least:.5} to {most:.5}\n  {friction:?} {half_space:?}", fault.words);
            faults.push(Fault { words, ..fault });
        }
        kinds[match limit.at {
            At::Load { .. } => 0,
            At::Below { .. } => 1,
            At::Never { .. } => 2,
            At::Undecided { .. } => 3,
            At::Rest | At::Tip { .. } => 4,
        }] += 1;
    }
    (faults, kinds)
}

/// Limits of random problems: none contradicts its path but by errors, and so at most two in a hundred.
fn judge(seed: u64, problems: usize, points: usize) {
    let mut random = Random(seed);
    let all: Vec<(Problem, u64)> =
        std::iter::from_fn(|| Some(random_problem(&mut random, points))).flatten().zip(seed..).take(problems).collect();
    let judged: Vec<(Vec<Fault>, [usize; 5])> =
        all.par_iter().map(|(problem, seed)| faults_of(problem, points, Random(*seed))).collect();
    let kinds: [usize; 5] = std::array::from_fn(|kind| judged.iter().map(|(_, kinds)| kinds[kind]).sum());
    let (by_error, others): (Vec<Fault>, Vec<Fault>) =
        judged.into_iter().flat_map(|(faults, _)| faults).partition(|fault| fault.is_by_error);
    let count = kinds.iter().sum::<usize>();
    println!("{count} limits: {kinds:?} at a load, below, never, undecided, else");
    println!("{} contradict their paths, {} more by errors", others.len(), by_error.len());
    others.iter().chain(&by_error).for_each(|fault| println!("{}", fault.words));
    assert!(others.is_empty() && 50 * by_error.len() <= count, "{} and {}", others.len(), by_error.len());
}

#[test]
#[ignore = "takes minutes"]
fn two_hundred_random_limits_agree_from_four_starts_and_with_fine_paths() {
    judge(4211, 40, 48);
}
