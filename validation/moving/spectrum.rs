//! Waves of a field on a grid, by a plain transform.

use ndarray::ArrayView2;
use percoat_core::lattice::Cell;
use rustfft::FftPlanner;
use rustfft::num_complex::Complex64;

/// Wavevectors with |p̂|², the mean left out; a wave at half the samples along a₁ or a₂ stands for both of its directions.
pub fn spectrum(field: ArrayView2<'_, f64>, cell: Cell) -> Vec<([f64; 2], f64)> {
    let (n1, n2) = field.dim();
    let mut planner = FftPlanner::new();
    let mut values: Vec<Complex64> = field.iter().map(|&x| x.into()).collect();
    let rows = planner.plan_fft_forward(n2);
    values.chunks_mut(n2).for_each(|row| rows.process(row));
    let columns = planner.plan_fft_forward(n1);
    for j in 0..n2 {
        let mut column: Vec<Complex64> = (0..n1).map(|i| values[i * n2 + j]).collect();
        columns.process(&mut column);
        column.into_iter().enumerate().for_each(|(i, x)| values[i * n2 + j] = x);
    }
    let [b1, b2] = cell.reciprocal();
    let scale = ((n1 * n2) as f64).powi(-2);
    let directions = |k: usize, n: usize| match (2 * k).cmp(&n) {
        std::cmp::Ordering::Less => vec![k as f64],
        std::cmp::Ordering::Equal => vec![k as f64, -(k as f64)],
        std::cmp::Ordering::Greater => vec![k as f64 - n as f64],
    };
    let mut waves = Vec::with_capacity(n1 * n2);
    for index in 1..n1 * n2 {
        let [first, second] = [directions(index / n2, n1), directions(index % n2, n2)];
        let share = scale * values[index].norm_sqr() / (first.len() * second.len()) as f64;
        for (m, n) in first.iter().flat_map(|m| second.iter().map(move |n| (m, n))) {
            waves.push(([0, 1].map(|axis| m * b1[axis] + n * b2[axis]), share));
        }
    }
    waves
}
