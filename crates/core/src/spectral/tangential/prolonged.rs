//! The tractions of a coarser grid as a start on a finer one.
//!
//! What is taken over is the part **q**/μp: where both slip it is 1 in size on either grid, up to the edge of contact.

use super::disc::{Vector, add, length, scale, sticks};
use crate::lattice::Grid;
use crate::numeric::parallel;
use crate::numeric::sums;
use crate::spectral::Contact;

/// **q**/μp on the samples of a grid by those of a contact on a coarser one of the same cell: linear between those that touch, 1 in size where all
/// of them slip, and 0 where none touches. `None` of a contact without tractions.
pub(super) fn prolonged(coarse: &Contact, grid: &Grid) -> Option<Vec<Vector>> {
    let (shear, pressures) = (coarse.shear()?, coarse.pressures());
    let ([m1, m2], [n1, n2]) = (coarse.grid().points(), grid.points());
    // Sample k of n lies at k/n of the cell: between these two of m, with their shares.
    let beside = |k: usize, n: usize, m: usize| {
        let (whole, rest) = (k * m / n, (k * m % n) as f64 / n as f64);
        [(whole, 1.0 - rest), ((whole + 1) % m, rest)]
    };
    let part = |sample: usize| {
        let bound = shear.friction * pressures[sample];
        let q = [shear.traction[0][sample], shear.traction[1][sample]];
        (bound > 0.0).then(|| (scale(1.0 / bound, q), sticks(q, bound)))
    };
    let at = |sample: usize| {
        let (mut sum, mut share, mut all_slip) = ([0.0; 2], 0.0, true);
        for (row, of_row) in beside(sample / n2, n1, m1) {
            for (column, of_column) in beside(sample % n2, n2, m2) {
                let weight = of_row * of_column;
                if let Some((part, sticks)) = part(row * m2 + column).filter(|_| weight > 0.0) {
                    (sum, share) = (add(sum, scale(weight, part)), share + weight);
                    all_slip &= !sticks;
                }
            }
        }
        let size = length(sum);
        if size == 0.0 { [0.0; 2] } else { scale(if all_slip { 1.0 / size } else { 1.0 / share }, sum) }
    };
    Some(parallel::map_by(sums::BLOCK, grid.len(), at))
}
