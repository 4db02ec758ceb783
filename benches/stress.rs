//! Stresses under three levels on a coating: a section, planes, the maxima.

mod shared;

use divan::{Bencher, black_box};
use percoat::{Depth, MeanStress, Step, StressField, StressFields, StressReading, SurfaceLine};
use shared::{THREE_LEVELS, solver, three_levels};

fn main() {
    divan::main();
}

const POINTS: [usize; 3] = [256, 512, 1024];
/// Depth of the section and of the planes: the coating and as much below it.
const DEPTH: f64 = 1.0;

fn solved(n: usize) -> Step {
    solver(three_levels(), n).solve(THREE_LEVELS)
}

fn under(step: &Step) -> StressField {
    StressField::new(step.finest(), MeanStress::default())
}

#[divan::bench(args = POINTS, sample_size = 1, max_time = 5)]
fn section(bencher: Bencher, n: usize) {
    let field = under(&solved(n));
    let depths = field.half_space().rows(DEPTH, 200);
    let line = SurfaceLine { origin: [0.0; 2], direction: [1.0, 0.0], span: [0.0, 1.0], points: 401 };
    bencher.bench_local(|| field.section(&line, &depths));
}

#[divan::bench(args = POINTS, sample_size = 1, max_time = 10)]
fn planes_100(bencher: Bencher, n: usize) {
    let field = under(&solved(n));
    let depths: Vec<Depth> =
        (0..100).map(|number| field.half_space().depths(DEPTH * f64::from(number) / 99.0)[0]).collect();
    bencher.bench_local(|| {
        for &depth in &depths {
            black_box(field.plane(depth, [n, n]));
        }
    });
}

#[divan::bench(args = POINTS, sample_size = 1, max_time = 5)]
fn maxima(bencher: Bencher, n: usize) {
    let step = solved(n);
    let (fields, reading) = (StressFields::new(step.finest(), MeanStress::default()), step.reading());
    bencher.bench_local(|| StressReading::of(&step, &reading, &fields));
}
