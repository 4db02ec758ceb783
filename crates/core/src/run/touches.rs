//! The loads of first touch of the levels along a run, estimated from its load steps.
//!
//! The load of a profile c rⁿ is proportional to the (n + 1)/n-th power of its penetration, and so is about the load F of all
//! levels, a mean pressure or a force: P^{n/(n+1)} of one level over F^{n/(n+1)} is nearly a straight line. Through the two steps
//! after the touch it is extrapolated to zero load, between the last step without load and the first one with it.

use super::StepRecord;
use crate::load::LoadQuantity;
use crate::problem::Problem;

/// Number and load of first touch, in this quantity, of each level whose first touch lies between two steps.
pub fn touches(problem: &Problem, steps: &[StepRecord], quantity: LoadQuantity) -> Vec<(usize, f64)> {
    let whole = |step: &StepRecord| step.reading.load(quantity);
    let mut steps: Vec<&StepRecord> = steps.iter().filter(|step| whole(step).is_finite()).collect();
    steps.sort_by(|a, b| whole(a).total_cmp(&whole(b)));
    let levels = problem.levels();
    let highest = levels.iter().map(|level| level.height()).fold(f64::NEG_INFINITY, f64::max);
    let touch = |exponent: f64, is_highest: bool, level: usize| {
        let load = |step: &StepRecord| step.reading.levels.get(level - 1).map_or(0.0, |reading| reading.load);
        let first = steps.iter().position(|step| load(step) > 0.0).filter(|&first| first > 0)?;
        // A level that touches from the beginning has no load of first touch.
        let before = whole(steps[first - 1]);
        let power = exponent / (exponent + 1.0);
        let at = |step: &StepRecord| [whole(step), load(step)].map(|x| x.powf(power));
        let ([x, near], p) = (at(steps[first]), whole(steps[first]));
        let line = steps.get(first + 1).map(|step| at(step)).filter(|[_, next]| *next > near);
        let zero = line.map_or(0.5 * (before + p), |[next, further]| {
            (x - near * (next - x) / (further - near)).max(0.0).powf(power.recip())
        });
        (before > 0.0 || !is_highest).then(|| zero.clamp(before, p))
    };
    let marks = levels.iter().zip(1..).filter_map(|(level, number)| {
        let is_highest = level.height() >= highest;
        Some((number, touch(level.shape().exponent(), is_highest, number)?))
    });
    marks.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{HalfSpace, Material};
    use crate::counterbody::{Indenters, Level, Shape};
    use crate::lattice::{Cell, Lattice};
    use crate::load::Load;
    use crate::reading::first_touches;
    use crate::spectral::{Settings, Solver};

    /// Steps a third apart lead back to first touch within a fifth of the step, less than a marker is wide, as bisection finds it.
    #[test]
    fn the_steps_lead_back_to_first_touch() {
        let level = |height| Level::new(Shape::Paraboloid { radius: 0.8 }, height).unwrap();
        let levels = [0.02, 0.01, 0.0].map(level).to_vec();
        let indenters = Indenters::new(Lattice::hexagonal(1.0, 3).unwrap(), levels).unwrap();
        let body = HalfSpace::new(vec![], Material::from_young(1.0, 0.3).unwrap());
        let mut solver = Solver::new(Problem::new(indenters, body), [72, 72], Settings::default()).unwrap();
        let record = |pressure: f64, solver: &mut Solver| {
            let step = solver.solve(Load::MeanPressure(pressure));
            StepRecord::new(&step, step.reading())
        };
        let steps: Vec<StepRecord> = (0..15).map(|k| record(2e-4 * 1.35f64.powi(k), &mut solver)).collect();
        let found = touches(solver.problem(), &steps, LoadQuantity::MeanPressure);
        let exact = first_touches(&mut solver);
        assert_eq!(found.iter().map(|(level, _)| *level).collect::<Vec<usize>>(), [2, 3]);
        for (level, pressure) in found {
            let exact = exact[level - 1].unwrap().mean_pressure;
            assert!((pressure / exact - 1.0).abs() < 0.07, "level {level}: {pressure} {exact}");
        }
        // The loads are the same as forces.
        let (area, forces) = (solver.problem().cell().area(), touches(solver.problem(), &steps, LoadQuantity::Force));
        assert_eq!(forces.len(), 2);
        for ((level, force), (number, pressure)) in
            forces.into_iter().zip(touches(solver.problem(), &steps, LoadQuantity::MeanPressure))
        {
            assert!(
                level == number && (force / (pressure * area) - 1.0).abs() < 1e-12,
                "level {level}: {force} {pressure}"
            );
        }
    }

    /// Two balls at the distance d in a window, one higher by 0.01: the lower one touches where the approach of the other, by Hertz
    /// (3P/4E*√R)^(2/3), is 0.01 and the displacement P/(πE*d) of the surface below it.
    #[test]
    fn the_second_ball_of_a_window_touches_between_two_forces() {
        let level = |height| Level::new(Shape::Paraboloid { radius: 1.0 }, height).unwrap();
        let sites = vec![vec![[0.25, 0.5]], vec![[0.75, 0.5]]];
        let lattice = Lattice::new(Cell::window([2.0, 1.0]).unwrap(), sites).unwrap();
        let indenters = Indenters::new(lattice, [0.01, 0.0].map(level).to_vec()).unwrap();
        let body = HalfSpace::new(vec![], Material::from_young(1.0, 0.0).unwrap());
        let mut solver = Solver::new(Problem::new(indenters, body), [128, 64], Settings::default()).unwrap();
        let steps: Vec<StepRecord> = (0..6)
            .map(|k| {
                let step = solver.solve(Load::Force(4e-4 * 1.6f64.powi(k)));
                StepRecord::new(&step, step.reading())
            })
            .collect();
        let [(2, force)] = touches(solver.problem(), &steps, LoadQuantity::Force)[..] else {
            panic!("level 2 touches")
        };
        let expected = (0..20).fold(0.0, |p: f64, _| 4.0 / 3.0 * (0.01 + p / std::f64::consts::PI).powf(1.5));
        assert!((force / expected - 1.0).abs() < 0.07, "{force} {expected}");
    }
}
