//! One load from nothing on bodies that relax, creep or warm up. Before the times stand the counts, which no machine changes:
//! `cargo bench --bench moving -- counts` prints them alone.

mod shared;

use divan::Bencher;
use percoat::body::{Conduction, ConstantModulus, Relaxation};
use percoat::spectral::CreepSolver;
use percoat::steady_motion::SteadyMotion;
use percoat::*;
use shared::solver;
use std::time::Instant;

/// Names of the cases that one load solves: bodies that relax with r = E∞/E₀ = 10, and a pin on a coated disc, both of steel.
const CASES: [&str; 4] = ["bare", "soft", "stiff", "hot"];
const POINTS: [usize; 3] = [128, 256, 512];
/// Glassy over relaxed modulus.
const RATIO: f64 = 10.0;
/// Error of a step in time.
const IN_TIME: f64 = 1e-3;

fn main() {
    if !std::env::args().any(|argument| argument == "--list") {
        counts();
    }
    divan::main();
}

/// The table of counts in Markdown, beside the time of this one run.
fn counts() {
    println!("| case | samples | iterations | convolutions | on the way | s |\n|---|---|---|---|---|---|");
    for case in CASES {
        for n in POINTS {
            let mut solver = solver(problem(case), n);
            let begin = Instant::now();
            let step = solver.solve(load(case));
            let time = begin.elapsed().as_secs_f64();
            assert!(step.report.stop.solved(), "{case}: {step}");
            let way = match step.finest().heat() {
                Some(heat) => format!("iterations of the last turn; {} steps of its partition", heat.steps),
                None => format!("{} splittings", step.report.outer),
            };
            let (iterations, convolutions) = (step.report.iterations, step.convolutions);
            println!("| {case} | {n}² | {iterations} | {convolutions:.0} | {way} | {time:.3} |");
        }
    }
    for n in POINTS {
        let begin = Instant::now();
        let [steps, iterations, convolutions] = crept(n);
        let time = begin.elapsed().as_secs_f64();
        println!("| creep | {n}² | {iterations:.0} | {convolutions:.0} | {steps:.0} steps in time | {time:.3} |");
    }
    println!();
}

fn elastic(shear: f64, poisson: f64) -> Material {
    Material::from_shear(shear, poisson).expect("valid")
}

/// A material that relaxes in the time 1 at constant ν.
fn relaxing(shear: f64, poisson: f64) -> Material {
    let relaxation = Relaxation::new(&[(RATIO - 1.0) * shear], &[1.0]).expect("valid");
    elastic(shear, poisson).with_relaxation(Some(relaxation.with_constant(ConstantModulus::Poisson)))
}

fn coated(coat: Material, thickness: f64, substrate: Material) -> HalfSpace {
    HalfSpace::new(vec![Layer::new(coat, thickness, Interface::Bonded).expect("valid")], substrate)
}

fn soft_coat() -> HalfSpace {
    coated(relaxing(1.0, 0.4), 0.05, elastic(20.0, 0.3))
}

fn paraboloids(radius: f64) -> Indenters {
    let level = Level::new(Shape::Paraboloid { radius }, 0.0).expect("valid");
    Indenters::new(Lattice::square(1.0, 1).expect("valid"), vec![level]).expect("valid")
}

/// The problem of a case.
fn problem(case: &str) -> Problem {
    let body = match case {
        "bare" => HalfSpace::new(vec![], relaxing(1.0, 0.3)),
        "soft" => soft_coat(),
        "stiff" => coated(elastic(20.0, 0.25), 0.02, relaxing(1.0, 0.45)),
        _ => return hot_pin(),
    };
    // Near the velocity of the largest losses.
    let motion = SteadyMotion::new(0.1 / RATIO.sqrt()).expect("valid");
    Problem::new(paraboloids(1.0), body).moving(motion).expect("a body that relaxes")
}

fn load(case: &str) -> Load {
    Load::MeanPressure(match case {
        "stiff" => 0.02,
        "hot" => 2e-4,
        _ => 0.05,
    })
}

/// A steel pin on a steel disc under a hard coat that conducts badly; both swell. Lengths in mm, the unit of pressures 100 GPa.
fn hot_pin() -> Problem {
    let conducting = |young: f64, conduction: [f64; 3]| {
        let [conductivity, diffusivity, expansion] = conduction;
        let conduction = Conduction::new(conductivity, diffusivity, expansion).expect("valid");
        Material::from_young(young, 0.3).expect("valid").with_conduction(Some(conduction))
    };
    let steel = || conducting(2.1, [4.5e-4, 12.0, 1.2e-5]);
    let disc = coated(conducting(2.0, [2e-5, 1.0, 2e-6]), 0.003, steel());
    let bodies = Bodies::elastic(disc, HalfSpace::new(vec![], steel()));
    let friction = Friction::new(0.1, [1.0, 0.0]).expect("valid").uncoupled();
    let sliding = Problem::new(paraboloids(10.0), bodies).sliding(friction).expect("valid");
    let moving = sliding.moving(SteadyMotion::new(300.0).expect("valid")).expect("bodies that conduct");
    moving.heated(Heating::default()).expect("bodies that conduct")
}

/// Steps in time, iterations and convolutions of a soft coat under a load that comes at once and rests for ten relaxation times.
fn crept(n: usize) -> [f64; 3] {
    let problem = Problem::new(paraboloids(1.0), soft_coat());
    let mut creeping = CreepSolver::new(problem, [n, n], Settings::default(), IN_TIME).expect("a body that creeps");
    [0.0, 10.0].into_iter().fold([0.0; 3], |[steps, iterations, convolutions], time| {
        let step = creeping.advance(time, load("soft")).expect("a later time");
        assert!(step.contact.report.stop.solved(), "{}", step.contact);
        let contact = &step.contact;
        [steps + step.steps as f64, iterations + contact.report.iterations as f64, convolutions + contact.convolutions]
    })
}

fn solve(bencher: Bencher, case: &str, n: usize) {
    let fresh = || solver(problem(case), n);
    bencher.with_inputs(fresh).bench_local_refs(|solver| assert!(solver.solve(load(case)).report.stop.solved()));
}

#[divan::bench(args = POINTS, sample_size = 1, max_time = 10)]
fn bare(bencher: Bencher, n: usize) {
    solve(bencher, "bare", n);
}

#[divan::bench(args = POINTS, sample_size = 1, max_time = 10)]
fn soft(bencher: Bencher, n: usize) {
    solve(bencher, "soft", n);
}

#[divan::bench(args = POINTS, sample_size = 1, max_time = 10)]
fn stiff(bencher: Bencher, n: usize) {
    solve(bencher, "stiff", n);
}

#[divan::bench(args = POINTS, sample_size = 1, max_time = 10)]
fn hot(bencher: Bencher, n: usize) {
    solve(bencher, "hot", n);
}

#[divan::bench(args = POINTS, sample_size = 1, max_time = 10)]
fn creep(n: usize) -> [f64; 3] {
    crept(n)
}
