//! One convolution in either precision, beside its twin by libraries: only their ratio means something on a noisy machine.

mod shared;

use divan::Bencher;
use shared::library::Library;
use shared::{Convolution, bare};

fn main() {
    divan::main();
}

const POINTS: [usize; 7] = [512, 768, 1024, 1536, 2048, 3072, 4096];

#[divan::bench(args = POINTS, max_time = 5)]
fn double(bencher: Bencher, n: usize) {
    let mut convolution = Convolution::new(&bare(), n);
    bencher.with_inputs(|| vec![1.0; n * n]).bench_local_refs(|field| convolution.run(field));
}

#[divan::bench(args = POINTS, max_time = 5)]
fn double_by_libraries(bencher: Bencher, n: usize) {
    let mut convolution = Library::new(n);
    bencher.with_inputs(|| vec![1.0_f64; n * n]).bench_local_refs(|field| convolution.run(field));
}

#[divan::bench(args = POINTS, max_time = 5)]
fn single(bencher: Bencher, n: usize) {
    let mut convolution = Convolution::new(&bare(), n);
    bencher.with_inputs(|| vec![1.0; n * n]).bench_local_refs(|field| convolution.run_single(field));
}

#[divan::bench(args = POINTS, max_time = 5)]
fn single_by_libraries(bencher: Bencher, n: usize) {
    let mut convolution = Library::new(n);
    bencher.with_inputs(|| vec![1.0_f32; n * n]).bench_local_refs(|field| convolution.run(field));
}
