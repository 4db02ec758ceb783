//! The search on one grid, load by load.

use super::{At, Limit, Limits, Shown};
use crate::load::Load;
use crate::reading::{Criterion, Utilisation};
use crate::run::{Recorder, Run, RunError, StepRecord};
use crate::spectral::{Solver, Step};
use std::sync::Arc;

/// Relative accuracy of a limit.
const TOLERANCE: f64 = 1e-3;
/// So much of it may be left between a load that was solved and the root that the secant foretells from there.
const NEAR: f64 = 0.3;
/// Doublings and halvings of the first load at most.
const DOUBLINGS: usize = 40;
/// Loads to enclose one root at most; bisection alone takes ten from a factor of two on.
const TRIALS: usize = 40;
/// Samples that the radius of a contact needs to be worth halving its load further.
const LEAST_SAMPLES: f64 = 2.0;
/// Utilisations whose ratio is nearer to one do not tell which of them is larger.
const ALIKE: f64 = 1e-3;
/// A largest utilisation below this part of a failure is not looked for between the loads: with twice the load stresses are
/// twice as large at most.
const WORTH: f64 = 0.5;
/// Loads around a largest utilisation that are closer tell it well enough.
const CLOSE: f64 = 1.05;
/// Where a utilisation grows faster than p̄ to this power, it may as well jump: a root beside a load that was solved needs a
/// load on its other side.
const STEEP: f64 = 2.0;
/// The slope that turns the error of a utilisation into one of its limit is that between loads so far apart: within a
/// thousandth a stress at an edge of contact may jump from sample to sample.
const APART: f64 = 1.2;
/// Rounds over all criteria: loads that were solved for one may be an earlier crossing of another.
const ROUNDS: usize = 4;
/// Loads that differ by less are one.
const SAME: f64 = 1e-12;
/// Part of the pressure of complete contact to begin with where the run's first load is none.
const START: f64 = 1e-3;

/// A search that goes on.
pub(super) struct Search<'a, R: Recorder> {
    run: &'a Run,
    solver: Solver,
    complete: f64,
    /// By ascending mean pressure.
    steps: Vec<StepRecord>,
    /// The last one that was solved.
    last: Option<Step>,
    recorder: &'a mut R,
}

/// Two loads between which a utilisation becomes one.
#[derive(Debug, Clone, Copy)]
struct Enclosure {
    /// Mean pressures.
    loads: [f64; 2],
    /// Utilisations, the first below one and the second not.
    values: [f64; 2],
}

impl<'a, R: Recorder> Search<'a, R> {
    /// The limits of a run on a grid of `points`.
    pub fn on_grid(run: &'a Run, points: [usize; 2], recorder: &'a mut R) -> Result<Limits, RunError<R::Error>> {
        let mut solver = Solver::new(Arc::clone(&run.problem), points, run.settings)?;
        recorder.begin(&solver).map_err(RunError::Recorder)?;
        // A flat surface is in complete contact under any load, and more of it changes what fails all the same.
        let complete = Some(solver.full_contact_pressure()).filter(|pressure| *pressure > 0.0);
        let complete = complete.unwrap_or(f64::INFINITY);
        let mut search = Self { run, solver, complete, steps: Vec::new(), last: None, recorder };
        let half_space = run.problem.half_space();
        let (at_rest, sought): (Vec<Criterion>, Vec<Criterion>) =
            Criterion::all(half_space).into_iter().partition(|criterion| criterion.at_rest(half_space) >= 1.0);
        if !sought.is_empty() {
            search.enclose(&sought)?;
        }
        let mut limits = Vec::new();
        for _ in 0..ROUNDS {
            let known = search.steps.len();
            limits.clear();
            for criterion in Criterion::all(half_space) {
                let at = if at_rest.contains(&criterion) { At::Rest } else { search.find(criterion)? };
                limits.push(Limit { criterion, at });
            }
            if search.steps.len() == known {
                break;
            }
        }
        let mut limits =
            Limits { limits, steps: Vec::new(), shown: None, complete, change: None, end: None, warnings: Vec::new() };
        let is_load = |limit: &&&Limit| limit.mean_pressure() > 0.0 && limit.mean_pressure().is_finite();
        let first = limits.ordered().iter().find(is_load).map(|limit| **limit);
        let shown = match first {
            Some(limit) => {
                let record = search.solve(limit.mean_pressure())?.clone();
                // Of places alike by symmetry rounding takes one or the other: told is the one of the step that is shown.
                let limit = limit.moved_to(search.utilisation(&record, limit.criterion).position);
                limits.limits.iter_mut().filter(|own| own.criterion == limit.criterion).for_each(|own| *own = limit);
                search.last.take().map(|step| Shown { limit, record, step })
            }
            None => None,
        };
        Ok(Limits { shown, steps: search.steps, ..limits })
    }

    /// Solves a load and keeps what it says.
    fn solve(&mut self, mean_pressure: f64) -> Result<&StepRecord, RunError<R::Error>> {
        // Its memory goes before the next one takes as much.
        self.last = None;
        let load = Load::MeanPressure(mean_pressure);
        let (record, step) = self.run.solve_load(&mut self.solver, load, self.recorder)?;
        self.last = Some(step);
        // What is read off a step has the load to rounding.
        let before = |other: &StepRecord| other.reading.mean_pressure < mean_pressure * (1.0 - SAME);
        let place = self.steps.partition_point(before);
        match self.steps.get_mut(place) {
            Some(same) if same.reading.mean_pressure <= mean_pressure * (1.0 + SAME) => *same = record,
            _ => self.steps.insert(place, record),
        }
        Ok(&self.steps[place])
    }

    /// The first load: the run's, or a little where it prescribes a penetration that hardly touches. That penetration is only
    /// where the search begins, and no load of it.
    fn start(&mut self) -> f64 {
        let pressure = match self.run.loads.iter().find(|load| load.value() > 0.0) {
            Some(&Load::MeanPressure(pressure)) => pressure,
            Some(&penetration) => self.solver.solve(penetration).reading().mean_pressure,
            None => 0.0,
        };
        let pressure = if pressure > 0.0 && pressure.is_finite() { pressure } else { START * self.complete };
        pressure.min(self.complete)
    }

    /// Solves loads until each criterion has one load below and one above, or none is left; downwards until it holds and
    /// falls with the load, as the tension at an edge and the opening of an interface fall towards complete contact too.
    fn enclose(&mut self, sought: &[Criterion]) -> Result<(), RunError<R::Error>> {
        let mut lowest = self.start();
        let mut highest = lowest;
        self.solve(lowest)?;
        for _ in 0..DOUBLINGS {
            let holds = |&criterion: &Criterion| self.values(criterion).iter().all(|[_, value]| *value < 1.0);
            if highest >= self.complete || !sought.iter().any(holds) {
                break;
            }
            highest = (2.0 * highest).min(self.complete);
            self.solve(highest)?;
        }
        let is_tip = self.first_is_tip();
        for _ in 0..DOUBLINGS {
            // Under a tip of the highest level it fails however small the load.
            let asks_for_less = |&criterion: &Criterion| {
                let values = self.values(criterion);
                let [_, first] = values[0];
                if first >= 1.0 { !(first.is_infinite() && is_tip) } else { !falls_with_the_load(&values) }
            };
            if self.steps[0].reading.spot_resolution < LEAST_SAMPLES || !sought.iter().any(asks_for_less) {
                break;
            }
            lowest *= 0.5;
            self.solve(lowest)?;
        }
        Ok(())
    }

    /// Loads that were solved and what each takes up of a criterion.
    fn values(&self, criterion: Criterion) -> Vec<[f64; 2]> {
        let value = |record: &StepRecord| [record.reading.mean_pressure, self.utilisation(record, criterion).value];
        self.steps.iter().map(value).collect()
    }

    /// Whether the highest level, which touches under any load, has tips whose pressure is infinite.
    fn first_is_tip(&self) -> bool {
        let indenters = self.run.problem.counterbody().indenters();
        let levels = indenters.into_iter().flat_map(|all| all.levels().iter().zip(all.drops()));
        levels.into_iter().any(|(level, drop)| drop == 0.0 && level.shape().singular_peak())
    }

    /// What a step takes up of a criterion; without contact what residual stress does.
    fn utilisation(&self, record: &StepRecord, criterion: Criterion) -> Utilisation {
        let found = record.strength.iter().find(|utilisation| utilisation.criterion == criterion);
        let value = criterion.at_rest(self.run.problem.half_space());
        found.copied().unwrap_or(Utilisation { criterion, value, error: None, position: [0.0; 3] })
    }

    /// Where a criterion is reached.
    fn find(&mut self, criterion: Criterion) -> Result<At, RunError<R::Error>> {
        for trial in 0.. {
            let values = self.values(criterion);
            let taken: Vec<Utilisation> = self.steps.iter().map(|record| self.utilisation(record, criterion)).collect();
            let load = |index: usize| values[index][0];
            let Some(above) = taken.iter().position(|taken| taken.value >= 1.0) else {
                match towards_largest(&values).filter(|_| trial < TRIALS) {
                    Some(next) => self.solve(next)?,
                    None => {
                        let [at, utilisation] = values[largest(&values)];
                        return Ok(At::Never { up_to: load(values.len() - 1), utilisation, at });
                    }
                };
                continue;
            };
            let Some(below) = above.checked_sub(1) else {
                let Utilisation { value, position, .. } = taken[above];
                let is_tip = value.is_infinite() && self.first_is_tip();
                let below = At::Below { mean_pressure: load(above), utilisation: value, position };
                return Ok(if is_tip { At::Tip { position } } else { below });
            };
            let enclosure =
                Enclosure { loads: [below, above].map(load), values: [below, above].map(|index| taken[index].value) };
            // Every third load halves what is enclosed.
            match enclosure.next(trial % 3 == 2) {
                Some(next) if trial < TRIALS => {
                    self.solve(next)?;
                }
                _ => {
                    let nearest = taken[if enclosure.first_is_nearer() { below } else { above }];
                    let mean_pressure = enclosure.root();
                    // Of what jumps nothing tells how far the grid moves it.
                    let slope = enclosure.slope().and_then(|_| slope_around(&values, mean_pressure));
                    let by_grid = slope.zip(nearest.error).map(|(slope, error)| error / (nearest.value * slope));
                    // What the search leaves open is an error too.
                    let error = by_grid.map(|by_grid| mean_pressure * by_grid.hypot(enclosure.open()));
                    // The place of one that jumps is where it has failed.
                    let position = if enclosure.slope().is_some() { nearest.position } else { taken[above].position };
                    return Ok(At::Load { mean_pressure, error, position });
                }
            }
        }
        unreachable!("trials end")
    }
}

impl Enclosure {
    /// d ln u / d ln p̄; `None` where a utilisation is zero or infinite: it jumps.
    fn slope(&self) -> Option<f64> {
        let ([low, high], [under, over]) = (self.loads, self.values);
        (under > 0.0 && over.is_finite()).then(|| (over / under).ln() / (high / low).ln())
    }

    /// Where the secant of ln u over ln p̄ is zero; the upper end where there is none.
    fn root(&self) -> f64 {
        let [low, high] = self.loads;
        self.slope().map_or(high, |slope| (low * (-self.values[0].ln() / slope).exp()).clamp(low, high))
    }

    fn first_is_nearer(&self) -> bool {
        let [under, over] = self.values.map(|value| value.ln().abs());
        under < over
    }

    /// How far the root may be from what was solved, relatively: by the secant, or by the loads that enclose it.
    fn open(&self) -> f64 {
        let [low, high] = self.loads;
        if self.slope().is_some() { (high / low - 1.0).min(NEAR * TOLERANCE) } else { high / low - 1.0 }
    }

    /// The load to solve next, or none where the root is known well enough.
    fn next(&self, halve: bool) -> Option<f64> {
        let ([low, high], root) = (self.loads, self.root());
        let near = if self.first_is_nearer() { low } else { high };
        if high / low - 1.0 <= TOLERANCE {
            return None;
        }
        let known = (root / near - 1.0).abs() <= NEAR * TOLERANCE;
        match self.slope().filter(|_| known) {
            Some(slope) if slope <= STEEP => None,
            Some(_) if !halve => {
                let beyond = 1.0 + 0.5 * TOLERANCE;
                Some(if self.first_is_nearer() { root * beyond } else { root / beyond })
            }
            _ => {
                let inside = low < root && root < high && !halve;
                Some(if inside { root } else { (low * high).sqrt() })
            }
        }
    }
}

/// Whether the first of `values` (loads and utilisations) that differs from that at the lowest load is larger.
fn falls_with_the_load(values: &[[f64; 2]]) -> bool {
    let [_, first] = values[0];
    values.iter().find(|[_, u]| (u - first).abs() > ALIKE * first).is_some_and(|[_, u]| *u > first)
}

/// Which of `values` has the largest utilisation.
fn largest(values: &[[f64; 2]]) -> usize {
    (0..values.len()).max_by(|&i, &j| values[i][1].total_cmp(&values[j][1]).then(j.cmp(&i))).unwrap_or(0)
}

/// The load to solve next in search of a larger utilisation, as long as there may be one of 1: a parabola of u over ln p̄
/// through the largest of `values` and its neighbours, or beside an end their line, would rise half as far.
fn towards_largest(values: &[[f64; 2]]) -> Option<f64> {
    let at = largest(values);
    let [p, u] = values[at];
    let ends = [at.checked_sub(1), Some(at + 1)].map(|index| values.get(index?).copied());
    let rise = match ends {
        [Some([low, under]), Some([high, over])] => {
            let ([left, right], [down, up]) = ([(p / low).ln(), (high / p).ln()], [u - under, u - over]);
            let slope = (down * right / left - up * left / right) / (left + right);
            let curvature = 2.0 * (down / left + up / right) / (left + right);
            if curvature > 0.0 { 0.5 * slope * slope / curvature } else { 0.0 }
        }
        [Some([_, other]), None] | [None, Some([_, other])] => u - other,
        [None, None] => 0.0,
    };
    let gap = |[low, high]: &[f64; 2]| high / low;
    let gaps = [ends[0].map(|[low, _]| [low, p]), ends[1].map(|[high, _]| [p, high])].into_iter().flatten();
    let wide = gaps.filter(|ends| gap(ends) > CLOSE).max_by(|a, b| gap(a).total_cmp(&gap(b)))?;
    (u > WORTH && u + 2.0 * rise.max(ALIKE * u) >= 1.0).then(|| (wide[0] * wide[1]).sqrt())
}

/// d ln u / d ln p̄ around a load, between the nearest two of `values` (loads and utilisations) that are far enough apart;
/// `None` where it does not grow.
fn slope_around(values: &[[f64; 2]], load: f64) -> Option<f64> {
    let usable = |[_, u]: &&[f64; 2]| *u > 0.0 && u.is_finite();
    let (reach, usable) = (APART.sqrt(), values.iter().filter(usable).collect::<Vec<_>>());
    let below = usable.iter().rev().find(|[p, _]| *p * reach <= load).or(usable.first())?;
    let above = usable.iter().find(|[p, _]| *p >= load * reach).or(usable.last())?;
    let slope = (above[1] / below[1]).ln() / (above[0] / below[0]).ln();
    (slope > 0.0 && slope.is_finite()).then_some(slope)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Root of a utilisation between 1 and 2, and how many loads it took.
    fn solved(utilisation: impl Fn(f64) -> f64) -> (f64, usize) {
        let mut enclosure = Enclosure { loads: [1.0, 2.0], values: [1.0, 2.0].map(&utilisation) };
        for trial in 0..TRIALS {
            let Some(next) = enclosure.next(trial % 3 == 2) else { return (enclosure.root(), trial) };
            let value = utilisation(next);
            let end = usize::from(value >= 1.0);
            (enclosure.loads[end], enclosure.values[end]) = (next, value);
        }
        panic!("no root after {TRIALS} loads: {enclosure:?}");
    }

    /// A power is one secant; bisection takes ten loads, and where two of three are wasted on secants, thirty.
    #[test]
    fn roots_are_found_of_powers_of_curves_and_of_utilisations_that_jump() {
        let near = |(root, trials): (f64, usize), known: f64, most: usize| {
            assert!((root / known - 1.0).abs() <= TOLERANCE, "{root} for {known}");
            assert!(trials <= most, "{trials} loads");
        };
        near(solved(|p| (p / 1.3).cbrt()), 1.3, 1);
        near(solved(|p| (p / 1.3).cbrt() + 0.05 * (p - 1.3)), 1.3, 3);
        near(solved(|p| if p < 1.4 { 0.0 } else { f64::INFINITY }), 1.4, 10);
        near(solved(|p| if p < 1.4 { 0.5 } else { 30.0 * p }), 1.4, 30);
        // Just before they jump.
        near(solved(|p| if p < 1.9 { 0.999 } else { 60.0 }), 1.9, 30);
        near(solved(|p| if p < 1.1 { 0.9 } else { 1.001 }), 1.1, 30);
        near(solved(|p| (p - 1.2).max(0.0) / 0.3), 1.5, 10);
        near(solved(|p| 10f64.powf(20.0 * (p - 1.9))), 1.9, 8);
    }

    /// u(ln p̄) whose loads were solved at every second power of two from a first one on; how many more loads it took.
    fn largest_of(utilisation: impl Fn(f64) -> f64, first: f64) -> ([f64; 2], usize) {
        let mut values: Vec<[f64; 2]> = (0..12).map(|k| first * 2f64.powi(k)).map(|p| [p, utilisation(p)]).collect();
        for trial in 0..TRIALS {
            let found = values[largest(&values)];
            let Some(next) = towards_largest(&values).filter(|_| found[1] < 1.0) else { return (found, trial) };
            values.push([next, utilisation(next)]);
            values.sort_by(|a, b| a[0].total_cmp(&b[0]));
        }
        panic!("not found");
    }

    #[test]
    fn a_utilisation_that_rises_and_falls_is_followed_to_its_top() {
        for shift in [0.0, 0.2, 0.4, 0.6, 0.8] {
            let first = 2f64.powf(shift);
            let hill = |top: f64| move |p: f64| top * (-0.3 * (p / 90.0).ln().powi(2)).exp();
            let ([p, u], trials) = largest_of(hill(1.01), first);
            assert!(u >= 1.0 && trials <= 6 && (p / 90.0).ln().abs() < 0.2, "{first}: {p} {u} {trials}");
            let ([_, u], trials) = largest_of(hill(0.995), first);
            // It ends where what may still be above does not reach 1.
            assert!(u > 0.985 && trials <= 10, "{first}: {u} {trials}");
            assert!(largest_of(hill(0.8), first).1 <= 2 && largest_of(hill(0.3), first).1 == 0);
            assert_eq!(largest_of(|p| 0.6 * (p / 2048.0 / first).cbrt(), first).1, 0);
        }
        let falling = |values: &[f64]| {
            falls_with_the_load(&(1..).zip(values).map(|(p, u)| [f64::from(p), *u]).collect::<Vec<_>>())
        };
        assert!(falling(&[0.1, 0.2]) && falling(&[0.0, 0.0, 0.3, 0.0]) && falling(&[0.5, 0.500_01, 0.6]));
        assert!(!falling(&[0.0]) && !falling(&[0.0, 0.0]) && !falling(&[0.2, 0.1, 0.5]));
    }

    #[test]
    fn no_error_is_stated_where_there_is_no_slope() {
        let jump = Enclosure { loads: [1.0, 1.0005], values: [0.0, 2.0] };
        assert_eq!((jump.slope(), jump.next(false), jump.root()), (None, None, 1.0005));
        let infinite = Enclosure { loads: [1.0, 2.0], values: [0.5, f64::INFINITY] };
        assert_eq!((infinite.slope(), infinite.next(false)), (None, Some(2f64.sqrt())));
    }
}
