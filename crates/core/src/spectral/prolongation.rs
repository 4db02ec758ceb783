//! A solution carried over to a finer grid.
//!
//! A pressure ends like A√d at the edge of contact, and the gap begins beyond it like (4A/3E*) d^{3/2}: neither can be
//! interpolated there, but
//!
//! s = p² inside, −(A² · ¾ E* g)^{2/3} = −A² d outside
//!
//! runs straight through the edge. A is that of the sample and its neighbour across the edge: their distance h holds both
//! d's, A² h = s_in − s_out. s is interpolated linearly, and p = √max(s, 0).

use crate::lattice::{Grid, Interpolation, resampled};
use crate::numeric::rows;
use rayon::prelude::*;

/// Pressure on a grid of `points` of the cell of `grid`, from `pressure` and `gap` on `grid`; `modulus` is E* of the
/// material at the surface.
pub(super) fn prolonged(grid: &Grid, pressure: &[f64], gap: &[f64], modulus: f64, points: [usize; 2]) -> Vec<f64> {
    let s = smooth_square(grid, pressure, gap, modulus);
    resampled(&s, grid.points(), points, Interpolation::on(grid.cell()), f64::sqrt)
}

/// s, one value per sample; outside it is right next to contact, and negative elsewhere.
fn smooth_square(grid: &Grid, pressure: &[f64], gap: &[f64], modulus: f64) -> Vec<f64> {
    let ([n1, n2], apart) = (grid.points(), grid.sample_area().sqrt());
    let beyond = |i: usize| {
        let moment = (0.75 * modulus * gap[i].max(0.0)).cbrt().powi(2);
        let mean = |neighbours: &mut dyn Iterator<Item = usize>, apart: f64| {
            let (mut sum, mut count) = (0.0, 0);
            for inside in neighbours.map(|k| pressure[k]).filter(|&p| p > 0.0) {
                sum += outside(inside * inside, moment, apart);
                count += 1;
            }
            (count > 0).then(|| sum / f64::from(count))
        };
        let adjacent = grid.adjacent(i);
        mean(&mut adjacent.into_iter(), apart)
            .or_else(|| mean(&mut grid.neighbours(i).filter(|k| !adjacent.contains(k)), 2f64.sqrt() * apart))
    };
    let mut s = vec![0.0; pressure.len()];
    rows::each_row(n2, s.par_chunks_mut(n2), |row, s| {
        let [above, here, below] = [row + n1 - 1, row, row + 1].map(|row| &pressure[row % n1 * n2..][..n2]);
        let near = |column: usize| above[column].max(here[column]).max(below[column]) > 0.0;
        let (mut before, mut at) = (near(n2 - 1), near(0));
        for (column, s) in s.iter_mut().enumerate() {
            let after = near(if column + 1 < n2 { column + 1 } else { 0 });
            *s = match here[column] {
                p if p > 0.0 => p * p,
                _ if before || at || after => beyond(row * n2 + column).unwrap_or(-f64::MIN_POSITIVE),
                _ => -f64::MIN_POSITIVE,
            };
            (before, at) = (at, after);
        }
    });
    s
}

/// s outside, −a² c with a = A^{2/3} and c = (¾E*g)^{2/3}, from s inside and the distance of the two samples:
/// a³ h − a² c = s_in. Newton's method descends to the root from above.
fn outside(inside: f64, moment: f64, apart: f64) -> f64 {
    let mut a = moment / apart + (inside / apart).cbrt();
    for _ in 0..6 {
        let slope = a * (3.0 * a * apart - 2.0 * moment);
        if slope > 0.0 {
            a -= (a * a * (a * apart - moment) - inside) / slope;
        }
    }
    -a * a * moment
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::Cell;

    /// A straight edge between two samples: p = A√(x₀ − x), g = (4A/3E*) (x − x₀)^{3/2}.
    #[test]
    fn a_straight_edge_is_found_between_the_samples() {
        let (n, amplitude, modulus) = (32usize, 1.7, 2.3);
        let edges = [0.2512, 0.738];
        let depth = |x: f64| (x - edges[0]).min(edges[1] - x);
        let p = |x: f64| amplitude * depth(x).max(0.0).sqrt();
        let g = |x: f64| 4.0 * amplitude / (3.0 * modulus) * (-depth(x)).max(0.0).powf(1.5);
        let field = |f: &dyn Fn(f64) -> f64| -> Vec<f64> { (0..n * n).map(|i| f((i / n) as f64 / n as f64)).collect() };
        let grid = Grid::new(Cell::square(1.0).unwrap(), [n, n]).unwrap();
        let fine = prolonged(&grid, &field(&p), &field(&g), modulus, [4 * n, n]);
        for i in 0..4 * n {
            let x = i as f64 / (4 * n) as f64;
            assert!((fine[i * n] - p(x)).abs() < 1e-7 || (x - 0.5).abs() < 0.05, "{x}: {} for {}", fine[i * n], p(x));
        }
    }

    #[test]
    fn complete_contact_and_none_stay_so() {
        let grid = Grid::new(Cell::square(1.0).unwrap(), [8, 8]).unwrap();
        for value in [0.0, 2.0] {
            let finer = prolonged(&grid, &[value; 64], &[1.0; 64], 1.0, [16, 16]);
            assert!(finer.iter().all(|&p| p == value));
        }
    }
}
