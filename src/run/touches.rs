//! The loads of first touch of the levels along a run, estimated from its load steps.
//!
//! The load of a profile c rⁿ is proportional to the (n + 1)/n-th power of its penetration, and so is about the mean
//! pressure on the other levels of that profile: P^{n/(n+1)} over p̄^{n/(n+1)} is nearly a straight line. Through the two
//! steps after the touch it is extrapolated to zero load, between the last step without load and the first one with it.

use super::StepRecord;
use crate::problem::Problem;

/// Number and mean pressure of first touch of each level whose first touch lies between two steps.
pub fn touches(problem: &Problem, steps: &[StepRecord]) -> Vec<(usize, f64)> {
    let finite = |step: &&StepRecord| step.reading.mean_pressure.is_finite();
    let mut steps: Vec<&StepRecord> = steps.iter().filter(finite).collect();
    steps.sort_by(|a, b| a.reading.mean_pressure.total_cmp(&b.reading.mean_pressure));
    let levels = problem.counterbody().levels();
    let highest = levels.iter().map(|level| level.height()).fold(f64::NEG_INFINITY, f64::max);
    let touch = |exponent: f64, is_highest: bool, level: usize| {
        let load = |step: &StepRecord| step.reading.levels.get(level - 1).map_or(0.0, |own| own.load);
        let first = steps.iter().position(|step| load(step) > 0.0).filter(|&first| first > 0)?;
        // A level that touches from the beginning has no load of first touch.
        let before = steps[first - 1].reading.mean_pressure;
        let power = exponent / (exponent + 1.0);
        let at = |step: &StepRecord| [step.reading.mean_pressure, load(step)].map(|x| x.powf(power));
        let ([x, own], p) = (at(steps[first]), steps[first].reading.mean_pressure);
        let line = steps.get(first + 1).map(|step| at(step)).filter(|[_, next]| *next > own);
        let zero = line.map_or(0.5 * (before + p), |[next, further]| {
            (x - own * (next - x) / (further - own)).max(0.0).powf(power.recip())
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
    use crate::lattice::Lattice;
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
        let found = touches(solver.problem(), &steps);
        let exact = first_touches(&mut solver);
        assert_eq!(found.iter().map(|(level, _)| *level).collect::<Vec<usize>>(), [2, 3]);
        for (level, pressure) in found {
            let exact = exact[level - 1].unwrap().mean_pressure;
            assert!((pressure / exact - 1.0).abs() < 0.07, "level {level}: {pressure} {exact}");
        }
    }
}
