//! The localized method beside the spectral one.

mod shared;

use divan::Bencher;
use percoat::comparison::ComparisonTask;
use percoat::localized::CircleRadius;
use percoat::{MeanStress, Settings};
use shared::{THREE_LEVELS, three_levels};
use std::ops::ControlFlow;
use std::sync::Arc;

fn main() {
    divan::main();
}

/// Elements across the largest contact: 48 are those of `percoat compare` unless told otherwise.
#[divan::bench(args = [12, 24, 48], sample_size = 1, max_time = 20)]
fn elements(bencher: Bencher, elements: usize) {
    let task = ComparisonTask {
        problem: Arc::new(three_levels()),
        load: THREE_LEVELS,
        settings: Settings::default(),
        indenters: vec![7, 13, 37, 73],
        elements,
        rule: CircleRadius::LoadBalanced,
        mutual_effect: true,
        mean: MeanStress::default(),
    };
    bencher.bench_local(|| task.compare([256, 256], &mut |_| ControlFlow::Continue(())).expect("indenters"));
}
