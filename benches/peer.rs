//! percoat as `peers.py` times it: solves, or convolves, whenever a line on standard input says so.
//!
//! ```text
//! peer heights CASE POINTS FILE                  writes heights of benches/shared, prints the mean pressure
//! peer solve CASE POINTS TOLERANCE THREADS       the same case: what `percoat solve` does after reading it
//! peer convolution WHO PRECISION POINTS THREADS  the bare half-space, E* = 1; by percoat or library, double or single
//! ```
//!
//! The program answers `ready`, then each line `run` with one of JSON: `seconds`, of a solution without its `setup`
//! (surface, tables, plans) and its `readings` (boundaries, areas, spots, all on two coarser grids too for their
//! errors; warnings). Of a solution also `iterations`, `converged`, `convolutions` (as equivalents of the finest grid
//! in double precision, of which one in single precision counts half) and `single`, the seconds of one in single
//! precision. `write FILE` writes the last pressure, or the displacement, as a NumPy file.

mod shared;

use npyz::WriterBuilder;
use percoat::run::{GridStart, Recorder};
use percoat::spectral::Checkpoint;
use percoat::*;
use rustfft::FftNum;
use shared::library::Library;
use shared::{Convolution, ONE_LEVEL, ROUGH, Rough, bare, one_level, rough};
use std::convert::Infallible;
use std::error::Error;
use std::fs::File;
use std::io::{BufWriter, stdin};
use std::time::Instant;

type Outcome<T> = Result<T, Box<dyn Error>>;

fn main() -> Outcome<()> {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|argument| argument != "--bench").collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["heights", case, points, file] => heights(case, points.parse()?, file),
        ["solve", case, points, tolerance, threads] => {
            start(threads)?;
            solve(case, points.parse()?, tolerance.parse()?)
        }
        ["convolution", who, precision, points, threads] => {
            start(threads)?;
            let n = points.parse()?;
            match (who, precision) {
                ("percoat", "double") => convolution(n, Convolution::new(&bare(), n), Convolution::run),
                ("percoat", "single") => convolution(n, Convolution::new(&bare(), n), Convolution::run_single),
                ("library", "double") => convolution(n, Library::<f64>::new(n), Library::run),
                ("library", "single") => convolution(n, Library::<f32>::new(n), Library::run),
                _ => Err("no such convolution".into()),
            }
        }
        // `cargo bench` runs every bench.
        [] => {
            println!("benches/peers.py runs this");
            Ok(())
        }
        _ => Err("see the head of benches/peer.rs".into()),
    }
}

fn start(threads: &str) -> Outcome<()> {
    Ok(rayon::ThreadPoolBuilder::new().num_threads(threads.parse()?).build_global()?)
}

/// A case, and its load.
fn problem(case: &str, n: usize) -> Outcome<(Problem, Load)> {
    Ok(match case {
        "one-level" => (one_level(), ONE_LEVEL),
        "rough-4-to-64" => (rough(Rough::band(), n), ROUGH),
        "rough-to-the-grid" => (rough(Rough::down_to_grid(n), n), ROUGH),
        _ => return Err("no such case".into()),
    })
}

fn heights(case: &str, n: usize, file: &str) -> Outcome<()> {
    let (problem, load) = problem(case, n)?;
    let surface = problem.loaded_by().surface([n, n])?;
    write(file, n, &surface.initial_gap().iter().map(|gap| -gap).collect::<Vec<_>>())?;
    println!("{:e}", load.value());
    Ok(())
}

/// When the solver is made, and when the load is solved.
#[derive(Default)]
struct Times(Vec<Instant>);

impl Recorder for Times {
    type Error = Infallible;

    fn begin(&mut self, _start: &GridStart) -> Result<(), Infallible> {
        self.0.push(Instant::now());
        Ok(())
    }

    fn solved(&mut self, _checkpoint: &Checkpoint) -> Result<(), Infallible> {
        self.0.push(Instant::now());
        Ok(())
    }
}

fn solve(case: &str, n: usize, tolerance: f64) -> Outcome<()> {
    let (problem, load) = problem(case, n)?;
    let (convolution, ones) = (Convolution::new(problem.half_space(), n), vec![1.0; n * n]);
    let mut run = Run::new(problem, vec![load], Sampling::Points([n, n]));
    run.settings.tolerance = tolerance;
    let timed_run = |(convolution, field, last): &mut (Convolution, Vec<f32>, Option<Step>)| {
        *last = None;
        let (began, mut times) = (Instant::now(), Times::default());
        let outcome = run.solve(&mut times)?;
        times.0.push(Instant::now());
        let [made, solved, ended] = times.0[..] else { return Err("one load on one grid".into()) };
        let [setup, seconds, readings] = [made - began, solved - made, ended - solved].map(|time| time.as_secs_f64());
        field.fill(1.0);
        let single = timed(|| convolution.run_single(field));
        let step = &outcome.steps[0];
        println!(
            "{{\"setup\": {setup:e}, \"seconds\": {seconds:e}, \"readings\": {readings:e}, \"iterations\": {}, \
             \"convolutions\": {}, \"single\": {single:e}, \"converged\": {}}}",
            step.iterations,
            step.convolutions,
            step.converged()
        );
        *last = outcome.last;
        Ok(())
    };
    serve(n, (convolution, ones, None), timed_run, |(.., last)| {
        last.as_ref().map_or_else(Vec::new, |step| step.pressure().iter().copied().collect())
    })
}

fn convolution<C, T: FftNum + Into<f64>>(n: usize, method: C, run: impl Fn(&mut C, &mut [T])) -> Outcome<()> {
    // Any numbers: no bit pattern of them is faster.
    let pressure: Vec<T> =
        (0..n * n).map(|i| T::from_f64(((i * 7919) % 1009) as f64 / 1009.0).expect("a number")).collect();
    let timed_run = |(method, field): &mut (C, Vec<T>)| {
        field.copy_from_slice(&pressure);
        println!("{{\"seconds\": {:e}}}", timed(|| run(method, field)));
        Ok(())
    };
    serve(n, (method, pressure.clone()), timed_run, |(_, field)| field.iter().map(|&value| value.into()).collect())
}

fn timed(run: impl FnOnce()) -> f64 {
    let began = Instant::now();
    run();
    began.elapsed().as_secs_f64()
}

/// Answers the lines of standard input; `field` gives what is to be written after a run, n × n samples, a₂ fastest.
fn serve<S>(
    n: usize,
    mut state: S,
    run: impl Fn(&mut S) -> Outcome<()>,
    field: impl Fn(&S) -> Vec<f64>,
) -> Outcome<()> {
    println!("ready");
    for line in stdin().lines() {
        match line?.split_once(' ') {
            Some(("write", path)) => {
                write(path, n, &field(&state))?;
                println!("written");
            }
            _ => run(&mut state)?,
        }
    }
    Ok(())
}

fn write(path: &str, n: usize, field: &[f64]) -> Outcome<()> {
    let file = BufWriter::new(File::create(path)?);
    let mut array = npyz::WriteOptions::new().default_dtype().shape(&[n as u64; 2]).writer(file).begin_nd()?;
    array.extend(field.iter().copied())?;
    array.finish()?;
    Ok(())
}
