//! One load from nothing, its grids and tables made before; and a load path.

mod shared;

use divan::Bencher;
use percoat::{Load, Problem};
use shared::{ONE_LEVEL, ROUGH, Rough, THREE_LEVELS, one_level, rough, solver, three_levels};

fn main() {
    divan::main();
}

const POINTS: [usize; 6] = [512, 768, 1024, 1536, 2048, 4096];
const STEPS: usize = 20;

fn solve(bencher: Bencher, problem: Problem, n: usize, load: Load) {
    let fresh = || solver(problem.clone(), n);
    bencher.with_inputs(fresh).bench_local_refs(|solver| assert!(solver.solve(load).report.stop.solved()));
}

#[divan::bench(args = POINTS, sample_size = 1, max_time = 10)]
fn one_level_bare(bencher: Bencher, n: usize) {
    solve(bencher, one_level(), n, ONE_LEVEL);
}

#[divan::bench(args = POINTS, sample_size = 1, max_time = 10)]
fn three_levels_coated(bencher: Bencher, n: usize) {
    solve(bencher, three_levels(), n, THREE_LEVELS);
}

#[divan::bench(args = POINTS, sample_size = 1, max_time = 20)]
fn rough_4_to_64(bencher: Bencher, n: usize) {
    solve(bencher, rough(Rough::band(), n), n, ROUGH);
}

#[divan::bench(args = POINTS, sample_size = 1, max_time = 20)]
fn rough_down_to_the_grid(bencher: Bencher, n: usize) {
    solve(bencher, rough(Rough::down_to_grid(n), n), n, ROUGH);
}

/// From a twentieth of the load to the whole.
#[divan::bench(args = POINTS, sample_size = 1, max_time = 20)]
fn path_of_20_steps(bencher: Bencher, n: usize) {
    let problem = three_levels();
    let load = |step: usize| Load::MeanPressure(THREE_LEVELS.value() * step as f64 / STEPS as f64);
    bencher.with_inputs(|| solver(problem.clone(), n)).bench_local_refs(|solver| {
        (1..=STEPS).for_each(|step| assert!(solver.solve(load(step)).report.stop.solved()));
    });
}
