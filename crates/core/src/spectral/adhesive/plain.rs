//! The same states by contacts without tension, in plain lines: the convex–concave iteration.
//!
//! Under the tension τ(g) of the last gap the problem is a contact of the gap f − Cτ, whose pressure is that of contact; its gap gives the next
//! tension. The energy falls from each to the next, and the rate is κ of the state.

use super::tension::Tension;
use crate::load::Load;
use crate::problem::Problem;
use crate::spectral::{LayeredOperator, Settings, Solver, Workspace};
use ndarray::Array2;

/// Gaps of all iterations from a gap on a periodic grid at a penetration, until it changes by less than `least`, a length.
pub(super) fn gaps(
    problem: &Problem,
    (tension, points): (&Tension, [usize; 2]),
    penetration: f64,
    start: Vec<f64>,
    least: f64,
) -> Vec<Vec<f64>> {
    let settings = Settings { tolerance: 1e-11, ..Settings::default() };
    let without = Problem::new(problem.loaded_by().clone(), problem.bodies().clone());
    let mut solver = Solver::new(without, points, settings).unwrap();
    let grid = solver.grid().clone();
    let mut operator = LayeredOperator::new(&grid, problem.bodies().clone());
    let f: Vec<f64> = solver.surface().initial_gap().iter().copied().collect();
    let mut all = vec![start];
    loop {
        let last = &all[all.len() - 1];
        let mut pulled: Vec<f64> = last.iter().map(|gap| tension.at(*gap)).collect();
        operator.displacement(&mut pulled, &mut Workspace::default());
        let opened: Vec<f64> = f.iter().zip(&pulled).map(|(f, w)| f - w).collect();
        let lowest = opened.iter().copied().fold(f64::INFINITY, f64::min);
        let opened = Array2::from_shape_vec(points, opened.iter().map(|f| f - lowest).collect()).unwrap();
        solver.set_gap(opened).unwrap();
        let step = solver.solve(Load::Penetration(penetration - lowest));
        assert!(step.report.stop.solved(), "{}", step.report);
        let (gap, pressure) = (step.gap(), step.pressure());
        let next: Vec<f64> = gap.iter().zip(&pressure).map(|(g, p)| if *p > 0.0 { 0.0 } else { g.max(0.0) }).collect();
        let change = next.iter().zip(last).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
        all.push(next);
        if change < least {
            return all;
        }
    }
}
