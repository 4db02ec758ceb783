//! One step of partial slip in plain lines, sample after sample: what [`StickSlip`](super::stick_slip::StickSlip) solves, to be read, and the
//! twin that its iteration is tested against.

use super::disc::{Vector, add, length, projected, scale, sub};
use super::operator::TangentialOperator;

/// Most sweeps over all samples.
const SWEEPS: usize = 100_000;

/// Tractions **q** on the discs |**q**| ≤ m under a shift that rises by **d**, with the displacement **b** before the step.
///
/// The slip of a sample is **s** = **d** + **b** − A**q**. Each sample in turn takes a part of it into its traction and comes back onto its disc,
///
/// **q** ← disc(**q** + **s**/a),
///
/// with a the largest displacement of a sample by its own unit traction: nothing changes any more where **s** = 0 within the disc, or **s** is
/// along **q** on its circle.
pub(super) fn tractions(operator: &mut TangentialOperator, m: &[f64], b: &[Vector], d: Vector) -> Vec<Vector> {
    let columns = columns(operator, m.len());
    let of_itself = |i: usize| [columns[i][0][i], columns[i][1][i]];
    let a = (0..m.len()).map(|i| of_itself(i).map(length).into_iter().fold(0.0, f64::max)).fold(0.0, f64::max);
    let mut q = vec![[0.0; 2]; m.len()];
    let mut displacement = vec![[0.0; 2]; m.len()];
    for _ in 0..SWEEPS {
        let mut most: f64 = 0.0;
        for i in 0..m.len() {
            let slip = sub(add(d, b[i]), displacement[i]);
            let next = projected(add(q[i], scale(1.0 / a, slip)), m[i]);
            let change = sub(next, q[i]);
            q[i] = next;
            for (axis, part) in change.into_iter().enumerate() {
                for (u, column) in displacement.iter_mut().zip(&columns[i][axis]) {
                    *u = add(*u, scale(part, *column));
                }
            }
            most = most.max(length(change));
        }
        if most < 1e-15 {
            break;
        }
    }
    q
}

/// Displacements of all samples by a unit traction along x and along y on each.
fn columns(operator: &mut TangentialOperator, samples: usize) -> Vec<[Vec<Vector>; 2]> {
    let mut column = |i: usize, unit: Vector| {
        let mut field = vec![[0.0; 2]; samples];
        field[i] = unit;
        operator.displace(&mut field, |_| true);
        field
    };
    (0..samples).map(|i| [column(i, [1.0, 0.0]), column(i, [0.0, 1.0])]).collect()
}

#[cfg(test)]
mod tests {
    use super::super::preconditioner::Preconditioner;
    use super::super::stick_slip::{ShearControl, SlipSettings, StickSlip};
    use super::*;
    use crate::body::{Bodies, HalfSpace, Interface, Layer, Material};
    use crate::lattice::{Cell, Grid};
    use crate::numeric::sums;

    /// Under a shift, then under the force that it leads to; some samples slip, some stick, some are apart.
    #[test]
    fn the_iteration_has_the_tractions_of_relaxation() {
        let layer = Layer::new(Material::from_shear(4.0, 0.1).unwrap(), 0.2, Interface::Bonded).unwrap();
        let bodies = Bodies::from(HalfSpace::new(vec![layer], Material::from_shear(1.0, 0.4).unwrap()));
        let oblique = Cell::new([1.0, 0.1], [0.3, 1.2]).unwrap();
        for (cell, points) in [(oblique, [9, 12]), (Cell::window([1.0, 1.2]).unwrap(), [10, 12])] {
            let grid = Grid::new(cell, points).unwrap();
            let mut operator = TangentialOperator::new(&grid, &bodies, false);
            let wave = |i: usize, phase: f64| (0.7 * i as f64 + phase).sin();
            let m: Vec<f64> = (0..grid.len()).map(|i| (0.4 + wave(i, 0.3)).max(0.0)).collect();
            let b: Vec<Vector> =
                (0..grid.len()).map(|i| [0.004 * wave(3 * i, 1.0), 0.003 * wave(2 * i, 2.0)]).collect();
            let d = [0.005, -0.003];
            let expected = tractions(&mut operator, &m, &b, d);
            let slips = (0..grid.len()).filter(|&i| m[i] > 0.0 && length(expected[i]) > m[i] * (1.0 - 1e-9)).count();
            let touches = m.iter().filter(|m| **m > 0.0).count();
            assert!(slips > touches / 10 && slips < 9 * touches / 10, "{slips} of {touches} slip");
            let preconditioner = Preconditioner::new(&operator);
            let [x, y] = sums::of(grid.len(), |i| expected[i]);
            let force = scale(grid.sample_area(), [x, y]);
            for control in [ShearControl::Shift(d), ShearControl::Force(force)] {
                let step = StickSlip {
                    operator: &mut operator,
                    preconditioner: &preconditioner,
                    bound: &m,
                    before: &b,
                    control,
                    near: None,
                    area: grid.sample_area(),
                    settings: SlipSettings { tolerance: 1e-15, ..SlipSettings::default() },
                };
                let found = step.solve(&vec![[0.0; 2]; grid.len()]);
                for (i, (q, exact)) in found.traction.iter().zip(&expected).enumerate() {
                    assert!(length(sub(*q, *exact)) < 1e-6, "{control:?}, sample {i}: {q:?} {exact:?}");
                }
                assert!(length(sub(found.rise, d)) < 1e-7, "{control:?}: {:?}", found.rise);
            }
        }
    }
}
