//! percoat as `peers.py` times it: solves, or convolves, whenever a line on standard input says so.
//!
//! ```text
//! peer heights CASE POINTS FILE                              writes heights of benches/shared, prints the mean pressure
//! peer solve HEIGHTS.npy MEAN_PRESSURE TOLERANCE THREADS     heights on the unit square, E* = 1
//! peer convolution POINTS THREADS                            the bare half-space, E* = 1
//! ```
//!
//! It answers `ready` with a line, then each line `run` with one of JSON: `setup` (surface, tables, plans) and `seconds`;
//! of a solution also `iterations`, `convolutions` (as equivalents of the finest grid) and `converged`. `write FILE`
//! writes the last pressure, or the displacement, as a NumPy file.

mod shared;

use ndarray::Array2;
use npyz::WriterBuilder;
use percoat::*;
use shared::{Convolution, ONE_LEVEL, ROUGH, Rough, bare, one_level, solver};
use std::error::Error;
use std::fs::File;
use std::io::{BufReader, BufWriter, stdin};
use std::sync::Arc;
use std::time::Instant;

type Outcome<T> = Result<T, Box<dyn Error>>;

fn main() -> Outcome<()> {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|argument| argument != "--bench").collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["heights", case, points, file] => heights(case, points.parse()?, file),
        ["solve", heights, mean_pressure, tolerance, threads] => {
            start(threads)?;
            solve(heights, Load::MeanPressure(mean_pressure.parse()?), tolerance.parse()?)
        }
        ["convolution", points, threads] => {
            start(threads)?;
            convolution(points.parse()?)
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

fn heights(case: &str, n: usize, file: &str) -> Outcome<()> {
    let (heights, load) = match case {
        "one-level" => (-&solver(one_level(), n).surface().initial_gap(), ONE_LEVEL),
        "rough-4-to-64" => (Rough::band().heights(n), ROUGH),
        "rough-to-the-grid" => (Rough::down_to_grid(n).heights(n), ROUGH),
        _ => return Err("no such surface".into()),
    };
    let heights: Vec<f64> = heights.iter().copied().collect();
    write(file, [n, n], &heights)?;
    println!("{:e}", load.value());
    Ok(())
}

fn solve(heights: &str, load: Load, tolerance: f64) -> Outcome<()> {
    let topography = Topography::new(Cell::square(1.0)?, read(heights)?)?;
    let points = topography.points();
    let problem = Arc::new(Problem::new(topography, bare()));
    let settings = Settings { tolerance, ..Settings::default() };
    serve(points, || {
        let began = Instant::now();
        let mut solver = Solver::new(Arc::clone(&problem), points, settings)?;
        let setup = began.elapsed().as_secs_f64();
        let began = Instant::now();
        let step = solver.solve(load);
        let seconds = began.elapsed().as_secs_f64();
        let Report { iterations, stop, .. } = step.report;
        println!(
            "{{\"setup\": {setup:e}, \"seconds\": {seconds:e}, \"iterations\": {iterations}, \"convolutions\": {:.2}, \
             \"converged\": {}}}",
            step.convolutions,
            stop.solved()
        );
        Ok(step.pressure().iter().copied().collect())
    })
}

fn convolution(n: usize) -> Outcome<()> {
    let began = Instant::now();
    let mut convolution = Convolution::new(&bare(), n);
    let setup = began.elapsed().as_secs_f64();
    // Any numbers: no bit pattern of them is faster.
    let pressure: Vec<f64> = (0..n * n).map(|i| ((i * 7919) % 1009) as f64 / 1009.0).collect();
    let mut displacement = vec![0.0; n * n];
    serve([n, n], || {
        let began = Instant::now();
        convolution.run(&pressure, &mut displacement);
        println!("{{\"setup\": {setup:e}, \"seconds\": {:e}}}", began.elapsed().as_secs_f64());
        Ok(displacement.clone())
    })
}

/// Answers the lines of standard input; `run` gives the field to be written, a₂ fastest.
fn serve(points: [usize; 2], mut run: impl FnMut() -> Outcome<Vec<f64>>) -> Outcome<()> {
    println!("ready");
    let mut field = Vec::new();
    for line in stdin().lines() {
        match line?.split_once(' ') {
            Some(("write", path)) => {
                write(path, points, &field)?;
                println!("written");
            }
            _ => field = run()?,
        }
    }
    Ok(())
}

fn read(path: &str) -> Outcome<Array2<f64>> {
    let file = npyz::NpyFile::new(BufReader::new(File::open(path)?))?;
    let shape = file.shape().to_vec();
    let [n1, n2] = shape[..] else { return Err("heights have two axes".into()) };
    Ok(Array2::from_shape_vec([n1 as usize, n2 as usize], file.into_vec()?)?)
}

fn write(path: &str, points: [usize; 2], field: &[f64]) -> Outcome<()> {
    let shape = points.map(|n| n as u64);
    let file = BufWriter::new(File::create(path)?);
    let mut array = npyz::WriteOptions::new().default_dtype().shape(&shape).writer(file).begin_nd()?;
    array.extend(field.iter().copied())?;
    array.finish()?;
    Ok(())
}
