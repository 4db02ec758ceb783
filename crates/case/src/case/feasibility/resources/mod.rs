//! Estimates of memory and disk of a case, and the largest grid that fits.
//!
//! A [`Job`] needs memory for the solver, for what it keeps and for the stresses that it reads (`job_needs`, `stress_needs`), and draws its
//! pictures after that. An estimate lies above the measured peak by some tenth: below a quarter in all that were measured (`constants`).
//! What does not fit is met with a [`refusal()`].

mod constants;
mod job;
mod job_needs;
mod refusal;
mod stress_needs;
#[cfg(test)]
mod tests;

pub use job::{Job, Needs};
pub use refusal::{largest_points, refusal};

use crate::case::Case;
use constants::{INDENTED, TANGENT, THREAD};
use job_needs::{of_comparing, of_identifying, of_keeping, of_life, of_limits, of_solving, yields};
use percoat_common::machine::Threads;
use percoat_core::counterbody::Topography;
use percoat_core::friction::Friction;
use percoat_core::identification::MOST_NODES;
use percoat_core::run::Sampling;
use percoat_core::spectral::Memory;

/// Estimate for a job on `case` on a grid of `points`, with the threads of this process.
pub fn needs(case: &Case, points: [usize; 2], job: Job) -> Needs {
    with_threads(case, points, job, Threads::used())
}

/// Estimate for a job on a number of threads.
fn with_threads(case: &Case, points: [usize; 2], job: Job, threads: usize) -> Needs {
    let samples = points[0] as u64 * points[1] as u64;
    let heights = of_heights(case, samples);
    let coupled = case.problem().friction().is_some_and(Friction::couples);
    let cell = case.problem().cell();
    let Memory { kept, working } = Memory::of(cell, points, case.solver.method, coupled);
    // The baseline takes more memory, but less than reading a step.
    let indented = if yields(case) { INDENTED * samples } else { 0 };
    let (grids, working) = (kept as u64 + indented, working as u64);
    let needs = match job {
        Job::Solve { pictures, fields } => of_solving(case, samples, [grids, working, heights], pictures, fields),
        Job::Keep => of_keeping(case, samples, [grids, working, heights]),
        Job::Limit { pictures } => of_limits(case, samples, [grids, working, heights], pictures),
        Job::Life { pictures } => of_life(case, samples, [grids, working, heights], pictures),
        Job::Compare { pictures } => of_comparing(case, samples, grids + working + heights, pictures),
        Job::Identify { pictures } => {
            // Every thread has a node of the curve.
            let nodes = threads.min(MOST_NODES) as u64;
            of_identifying(nodes * (grids + working + TANGENT * samples), pictures)
        }
    };
    let memory = needs.memory + THREAD * threads as u64;
    Needs { memory: memory + memory / 10, ..needs }
}

/// Heights of a topography; where grids are refined, those of its file, with their waves on the way to another grid.
fn of_heights(case: &Case, samples: u64) -> u64 {
    let Some([n1, n2]) = case.problem().topography().map(Topography::points) else { return 0 };
    let resampled = if matches!(case.grid, Sampling::Accuracy(_)) { 32 * (n1 * n2) as u64 } else { 0 };
    8 * samples + resampled
}
