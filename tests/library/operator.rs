//! The displacement operator against the sum over wavevectors that it stands for.

use crate::common;

use common::Random;
use percoat::spectral::{LayeredOperator, Workspace};
use percoat::{Cell, Grid, Interface};
use std::f64::consts::TAU;
use std::sync::Arc;

/// w(x) = Σ_q C(|q|) p̂(q) e^{iq·x}, each q the shortest alias found among many.
#[test]
fn a_displacement_is_the_direct_sum_over_wavevectors() {
    let half_space = common::coated(3.0, 0.2, [0.25, 0.4], Interface::Bonded);
    let response = half_space.response();
    for (cell, [n1, n2]) in [
        (Cell::hexagonal(1.0).unwrap(), [6, 6]),
        (Cell::square(0.7).unwrap(), [5, 8]),
        (Cell::new([1.0, 0.2], [1.4, 0.9]).unwrap(), [7, 6]),
    ] {
        let grid = Arc::new(Grid::new(cell, [n1, n2]).unwrap());
        let mut random = Random(77);
        let pressure: Vec<f64> = (0..n1 * n2).map(|_| random.unit()).collect();
        let mut displacement = pressure.clone();
        LayeredOperator::new(&grid, &half_space).displacement(&mut displacement, &mut Workspace::default());

        let [b1, b2] = cell.reciprocal();
        let shortest = |k1: usize, k2: usize| {
            let length = |m1: i32, m2: i32| {
                let (u, v) = (k1 as f64 + f64::from(m1) * n1 as f64, k2 as f64 + f64::from(m2) * n2 as f64);
                (u * b1[0] + v * b2[0]).hypot(u * b1[1] + v * b2[1])
            };
            (-5..=5).flat_map(|m1| (-5..=5).map(move |m2| (m1, m2))).map(|(m1, m2)| length(m1, m2)).fold(1e9, f64::min)
        };
        let compliance: Vec<f64> =
            (0..n1 * n2).map(|k| if k == 0 { 0.0 } else { response.compliance(shortest(k / n2, k % n2)) }).collect();
        for (i, j) in (0..n1).flat_map(|i| (0..n2).map(move |j| (i, j))) {
            let mut direct = 0.0;
            for (k1, k2) in (0..n1).flat_map(|i| (0..n2).map(move |j| (i, j))) {
                for (i0, j0) in (0..n1).flat_map(|i| (0..n2).map(move |j| (i, j))) {
                    let phase = TAU
                        * ((k1 as f64 * (i as f64 - i0 as f64)) / n1 as f64
                            + (k2 as f64 * (j as f64 - j0 as f64)) / n2 as f64);
                    direct += compliance[k1 * n2 + k2] * pressure[i0 * n2 + j0] * phase.cos() / (n1 * n2) as f64;
                }
            }
            let error = (displacement[i * n2 + j] - direct).abs();
            assert!(error < 1e-14, "{cell}: {} against {direct}", displacement[i * n2 + j]);
        }
        let mean: f64 = displacement.iter().sum::<f64>() / displacement.len() as f64;
        assert!(mean.abs() < 1e-15, "the mean displacement is {mean}");
    }
}

/// A grid that is worth series of the compliance: waves of a pressure come back times that of the layers themselves.
#[test]
fn on_large_grids_too_waves_are_multiplied_by_their_compliance() {
    let (half_space, n) = (common::coated(200.0, 0.03, [0.25, 0.4], Interface::Bonded), 160);
    let response = half_space.response();
    for cell in [Cell::hexagonal(1.0).unwrap(), Cell::square(1.0).unwrap()] {
        let grid = Arc::new(Grid::new(cell, [n, n]).unwrap());
        let mut operator = LayeredOperator::new(&grid, &half_space);
        for [k1, k2] in [[1, 0], [3, 7], [80, 0], [41, 55], [0, 79], [80, 80]] {
            let wave = |i: usize| (TAU * ((k1 * (i / n) + k2 * (i % n)) % n) as f64 / n as f64).cos();
            let mut field: Vec<f64> = (0..n * n).map(wave).collect();
            operator.displacement(&mut field, &mut Workspace::default());
            let compliance = response.compliance(grid.wavenumber([k1, k2]));
            let error = (0..n * n).map(|i| (field[i] / compliance - wave(i)).abs()).fold(0.0, f64::max);
            // Rounding in the transforms makes long waves of a short one, which are displaced far more.
            let leak = f64::EPSILON * response.compliance(grid.least_wavenumber()) / compliance;
            assert!(error < 1e-12 + leak, "{cell}, {k1}, {k2}: {error:e}");
        }
    }
}

/// C⁻¹ C p = p up to the mean, which C drops.
#[test]
fn the_pressure_inverts_the_displacement() {
    let half_space = common::coated(0.1, 0.05, [0.5, 0.3], Interface::Frictionless);
    let grid = Arc::new(Grid::new(Cell::hexagonal(2.0).unwrap(), [20, 18]).unwrap());
    let mut operator = LayeredOperator::new(&grid, &half_space);
    let mut random = Random(5);
    let mut pressure: Vec<f64> = (0..360).map(|_| random.unit()).collect();
    let mean = pressure.iter().sum::<f64>() / 360.0;
    pressure.iter_mut().for_each(|p| *p -= mean);
    let (mut field, mut workspace) = (pressure.clone(), Workspace::default());
    operator.displacement(&mut field, &mut workspace);
    operator.pressure(&mut field, &mut workspace);
    assert!(common::relative_difference(&field, &pressure) < 1e-13);
}

#[test]
fn in_single_precision_a_displacement_is_the_same() {
    let half_space = common::coated(0.1, 0.05, [0.5, 0.3], Interface::Frictionless);
    let grid = Arc::new(Grid::new(Cell::hexagonal(2.0).unwrap(), [20, 18]).unwrap());
    let mut operator = LayeredOperator::new(&grid, &half_space);
    let mut random = Random(6);
    let (mut field, mut workspace): (Vec<f64>, _) = ((0..360).map(|_| random.unit()).collect(), Workspace::default());
    let mut single: Vec<f32> = field.iter().map(|&p| p as f32).collect();
    operator.displacement(&mut field, &mut workspace);
    operator.displacement_single(&mut single, &mut workspace);
    let single: Vec<f64> = single.into_iter().map(f64::from).collect();
    assert!(common::relative_difference(&single, &field) < 1e-5);
}
