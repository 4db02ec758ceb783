//! The kernel evaluated over a whole grid.

mod shared;

use divan::Bencher;
use shared::{layered, operator};

fn main() {
    divan::main();
}

const POINTS: [usize; 3] = [512, 1024, 2048];

#[divan::bench(args = POINTS, max_time = 5)]
fn of_1_layer(bencher: Bencher, n: usize) {
    let half_space = layered(1);
    bencher.bench_local(|| operator(&half_space, n));
}

#[divan::bench(args = POINTS, max_time = 10)]
fn of_10_layers(bencher: Bencher, n: usize) {
    let half_space = layered(10);
    bencher.bench_local(|| operator(&half_space, n));
}
