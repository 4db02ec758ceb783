//! Conjugate gradients preconditioned with C⁻¹ on the active set, in single precision around a double one.
//!
//! On I = {p > 0} ∪ {g < 0} the direction is t = z + βt with z = M r, r = P_I g, M = P_I Eᵀ C⁻¹ E P_I (E continues the
//! residual beyond I), β = max(0, ⟨r − r′, z⟩/⟨r′, z′⟩) (Polak–Ribière, primes of the iteration before). Under load control
//! r and z are freed of their mean on I, so that the load stays: M is then symmetric on the admissible directions. Step
//! τ = ⟨g, t⟩/⟨t, Ct⟩, p ← max(p − τt, 0), and p is scaled back to its mean. C⁻¹ makes the spectrum of the iteration nearly
//! independent of the grid, E nearly independent of how ragged the contact is.
//!
//! **Descent.** What clipping takes away can raise the energy. Its change along the step d that was really taken is
//! ⟨g, d⟩ + ½⟨d, Cd⟩; where that is positive a shorter step is clipped afresh (ending at the minimum on the way instead
//! would bring back what was clipped, to be clipped again and again), and where the way leads uphill it is not taken, and
//! the next direction starts anew. The first step on a grid is free: it has to sort out what interpolation has left.
//!
//! **Sliding.** Under coupled friction the operator has a skew part D, T = C⁻¹D, and there is no energy. Where its largest |T|,
//! f, is small the gap is carried with it (the traction *follows*), and the iteration does not mind: ⟨t, Dt⟩ = 0. Else D p of
//! the last gap in double precision *stands*; then there is an energy again: minimising
//!
//! ½⟨p − p_k, C(p − p_k)⟩ + ω⟨g_k, p⟩  over p ≥ 0,  ω = 1/(1 + f²),
//!
//! is the iteration above from p_k and the gap ωg_k on, and these **outer** iterations (forward–backward splitting in the
//! energy's norm, in which C⁻¹(C + D) is monotone with the constants 1 and √(1 + f²)) contract as f/√(1 + f²) at least,
//! whatever f. Each ends when the criteria have fallen to a third.
//!
//! **Precision.** The gap is carried by its changes, g ← g + Cd, in single precision and in units of the largest f. The
//! pressure is double, and when the criteria are met, or single precision
//! exhausted, the gap is computed afresh in double precision: that alone decides about convergence.

use super::check::Check;
use super::problem::GridProblem;
use super::report::{Progress, Report, Route, Stop};
use super::residuals::{self, Active};
use super::stopping::Patience;
use super::unknowns::Unknowns;
use super::working::Fields;
use super::{directions, steps};
use crate::load::Load;
use crate::numeric::rows::{Parts, Totals};
use crate::spectral::convolution::{rows_of, rows_to};
use crate::spectral::extension;
use crate::spectral::operator::Coupling;
use std::sync::Arc;

/// First window of the patience, iterations.
const PATIENCE: usize = 30;
/// Part of its last value in double precision below which a residual of single precision is not believed.
const TRUSTED: f64 = 1e-5;
/// Iterations after which the gap is computed afresh whatever it says.
const RENEWAL: usize = 20;
/// Part of its first value to which the measure falls in an outer iteration.
const OUTER: f64 = 0.3;

/// How often a step that raises the energy is shortened before it ends at the minimum on its way, and how much.
const SHORTENED: usize = 2;
const LEAST_PART: f64 = 0.25;
const MOST_PART: f64 = 0.5;

/// How the residual is continued beyond the active set.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Beyond {
    /// By a fading mean: fewer iterations.
    Continued,
    /// By zero: C⁻¹ on the active set itself.
    Zero,
}

/// Iterates from and into `unknowns`; `iterations` are those before.
pub(super) fn solve(
    problem: &mut GridProblem<'_>,
    (beyond, traction): (Beyond, Coupling),
    mut iterations: usize,
    unknowns: &mut Unknowns,
) -> Report {
    let mut patience = Patience::new(PATIENCE);
    let coupling = problem.operator.coupling();
    let (share, enough) = match traction {
        Coupling::Follows => (1.0, TRUSTED),
        Coupling::Stands => (1.0 / (1.0 + coupling * coupling), OUTER / (1.0 + coupling * coupling)),
    };
    let mut memory = Memory { norm: 0.0, mean: 0.0, free: true };
    loop {
        unknowns.admit(problem.load);
        let check = Check::new(problem, unknowns);
        let ended = |stop| Report { stop, route: Route::Direct, iterations, outer: 0, residual: check.residual };
        if check.converged(problem.settings.tolerance) {
            return ended(Stop::Converged);
        }
        if iterations >= problem.settings.max_iterations {
            return ended(Stop::IterationLimit);
        }
        if patience.ends(check.measure()) {
            return ended(Stop::Stalled);
        }
        problem.outer += usize::from(coupling > 0.0);
        let mut way = Way::new(problem, unknowns, check, share, (beyond, traction));
        for number in 1.. {
            let limit = iterations >= problem.settings.max_iterations;
            let over = number > 1 && (limit || patience.ends(way.check.measure()));
            if over || !way.iterate(problem, unknowns, &mut memory) {
                // What the pressure itself says.
                unknowns.admit(problem.load);
                let check = Check::new(problem, unknowns);
                let stop = match (check.converged(problem.settings.tolerance), limit) {
                    (true, _) => Stop::Converged,
                    (false, true) => Stop::IterationLimit,
                    (false, false) => Stop::Stalled,
                };
                return Report { stop, route: Route::Direct, iterations, outer: 0, residual: check.residual };
            }
            iterations += 1;
            if (problem.progress)(Progress { iteration: iterations, residual: way.check.residual }).is_break() {
                unknowns.admit(problem.load);
                let Check { residual, .. } = Check::new(problem, unknowns);
                return Report { stop: Stop::Interrupted, route: Route::Direct, iterations, outer: 0, residual };
            }
            let met = way.check.converged(problem.settings.tolerance);
            if met || number == RENEWAL || way.check.measure() < enough * check.measure() {
                break;
            }
        }
    }
}

/// What one iteration leaves for the next direction.
#[derive(Debug)]
struct Memory {
    /// ⟨r′, z′⟩; 0 for a new start.
    norm: f64,
    /// Mean of r′ on I′.
    mean: f64,
    /// Whether the next step may raise the energy.
    free: bool,
}

/// A direction t that was found.
#[derive(Debug, Clone, Copy)]
struct Direction {
    /// ⟨r, z⟩.
    norm: f64,
    beta: f64,
    /// Step to the minimum along it, without p ≥ 0.
    tau: f64,
}

/// A step that was taken.
#[derive(Debug, Clone, Copy)]
struct Step {
    /// Whether the next direction has to start anew.
    restart: bool,
    /// How much of what `image` holds is added to the gap.
    factor: f64,
    /// Σ p and Σ p g after it, the gap with the old δ.
    sums: [f64; 2],
}

/// From one gap in double precision to the next.
#[derive(Debug)]
struct Way {
    parts: Parts,
    beyond: Beyond,
    traction: Coupling,
    /// The units of the working fields: the largest f, and the pressure that displaces by it at the least wavenumber.
    length: f64,
    pressure: f64,
    active: Active,
    penetration: f64,
    /// How the pressure stands by the gap in single precision.
    check: Check,
}

impl Way {
    /// From a `share` of the gap of the `check`.
    fn new(
        problem: &mut GridProblem<'_>,
        unknowns: &Unknowns,
        check: Check,
        share: f64,
        (beyond, traction): (Beyond, Coupling),
    ) -> Self {
        let length = problem.largest_gap;
        let (gap, residual) = problem.working.start(problem.operator);
        let active = residuals::take(&unknowns.pressure, &unknowns.gap, length / share, gap, residual);
        let (parts, pressure) = (problem.operator.parts(), length / problem.operator.unit());
        Self { parts, beyond, traction, length, pressure, active, penetration: unknowns.penetration, check }
    }

    /// One iteration; false where no step can be found.
    fn iterate(&mut self, problem: &mut GridProblem<'_>, unknowns: &mut Unknowns, memory: &mut Memory) -> bool {
        let (p, double) = (Arc::make_mut(&mut unknowns.pressure), Arc::make_mut(&mut unknowns.gap));
        let Some(direction) = self.turn(problem, double, memory) else { return false };
        let Some(step) = self.advance(problem, p, double, direction, memory.free) else { return false };
        let norm = if step.restart { 0.0 } else { direction.norm };
        *memory = Memory { norm, mean: self.mean(problem), free: false };
        self.judge(problem, p, double, step);
        true
    }

    /// What r is freed of.
    fn mean(&self, problem: &GridProblem<'_>) -> f64 {
        if problem.load.is_mean_pressure() { self.active.mean() } else { 0.0 }
    }

    /// z = M r, t = z + βt and C t, which is left in `image`.
    fn turn(&self, problem: &mut GridProblem<'_>, double: &mut [f64], memory: &Memory) -> Option<Direction> {
        let (parts, mean, load_control) = (self.parts, self.mean(problem), problem.load.is_mean_pressure());
        let operator = &mut *problem.operator;
        let Fields { residual, previous, direction, image, weight, room, .. } = problem.working.of(operator, double);
        let weight = match self.beyond {
            Beyond::Continued => {
                let mut reached = vec![false; parts.points()[0]];
                let rows = extension::extended(parts, residual, mean as f32, weight, &mut reached);
                let convolved = operator.pressed_single(room, rows);
                convolved.some_rows(|row| reached[row], extension::gathered(parts, image, weight));
                Some(&*weight)
            }
            Beyond::Zero => {
                let rows = directions::centred(parts, residual, mean as f32);
                operator.pressed_single(room, rows).rows(rows_to(parts, image));
                None
            }
        };
        let overlaps = directions::overlap(parts, [residual, previous, direction], weight, image);
        let z_mean = if load_control { overlaps.sum / self.active.size } else { 0.0 };
        let norm = overlaps.with_residual - mean * overlaps.sum;
        let overlap = overlaps.with_previous(memory.mean, z_mean);
        let beta = if memory.norm > 0.0 { ((norm - overlap) / memory.norm).max(0.0) } else { 0.0 };
        // What is left of the last direction on I is freed of its mean too, or the load would drift.
        let t_mean = if load_control && beta > 0.0 { overlaps.direction / self.active.size } else { 0.0 };
        let [mut descent, mut curvature] = [(); 2].map(|()| parts.totals());
        let rows = directions::turned(parts, [residual, image], z_mean + beta * t_mean, beta, direction, &mut descent);
        operator.displaced_single(self.traction, room, rows).rows(directions::curved(
            parts,
            direction,
            image,
            &mut curvature,
        ));
        let ([descent], [curvature]) = (Totals::of(descent).sums, Totals::of(curvature).sums);
        let tau = descent / curvature;
        (tau.is_finite() && curvature > 0.0).then_some(Direction { norm, beta, tau })
    }

    /// p + d, with C t or C d in `image`; `free`: whatever it does to the energy.
    fn advance(
        &self,
        problem: &mut GridProblem<'_>,
        p: &mut [f64],
        double: &mut [f64],
        Direction { beta, mut tau, .. }: Direction,
        free: bool,
    ) -> Option<Step> {
        let (parts, unit, load) = (self.parts, self.pressure, problem.load);
        let operator = &mut *problem.operator;
        let Fields { gap, direction, image, weight: step, room, .. } = problem.working.of(operator, double);
        for shortened in 0.. {
            let advance = steps::advance(p, [gap, direction, image], -tau, unit, step);
            if shortened == 0 && !advance.clipped {
                // C d = −τ C t.
                return Some(Step { restart: false, factor: -tau, sums: [advance.load, advance.work] });
            }
            let scale = match load {
                Load::MeanPressure(mean) if advance.load > 0.0 => mean * p.len() as f64 / advance.load,
                Load::MeanPressure(_) => {
                    steps::retreat(p, step, unit);
                    return None;
                }
                Load::Penetration(_) => 1.0,
            };
            if scale != 1.0 {
                steps::rescale(p, scale, unit, step);
            }
            let mut sums = parts.totals();
            let convolved = operator.displaced_single(self.traction, room, rows_of(parts, step));
            convolved.rows(steps::ended(parts, p, [gap, step], image, &mut sums));
            let [curvature, load, work] = Totals::of(sums).sums;
            // ⟨g, p⟩ = 0 under load control: the scale adds nothing to the slope.
            let slope = scale * advance.slope;
            let (uphill, part) = (slope >= 0.0, -slope / curvature);
            if curvature.is_finite() && (free || slope + 0.5 * curvature <= 0.0) {
                return Some(Step { restart: false, factor: 1.0, sums: [load, work] });
            }
            // Elsewhere the sums are taken anew.
            let ends = |p: &[f64], restart, factor| {
                Some(Step { restart, factor, sums: steps::works(p, gap, (image, factor)) })
            };
            if shortened == SHORTENED && !uphill && part.is_finite() {
                steps::retreat(p, step, (1.0 - part) * unit);
                return ends(p, false, part);
            }
            steps::retreat(p, step, unit);
            if uphill && beta > 0.0 {
                return ends(p, true, 0.0);
            }
            if shortened == SHORTENED || !curvature.is_finite() {
                return None;
            }
            tau *= part.clamp(LEAST_PART, MOST_PART);
        }
        None
    }

    /// The new gap and δ, residual and active set.
    fn judge(&mut self, problem: &mut GridProblem<'_>, p: &[f64], double: &mut [f64], step: Step) {
        let load_control = problem.load.is_mean_pressure();
        problem.working.turn_over();
        let Fields { gap, residual, image, .. } = problem.working.of(problem.operator, double);
        let [load, work] = step.sums;
        let shift = if load_control { work / load } else { 0.0 };
        self.penetration += shift * self.length;
        let (active, residuals) = residuals::settle(p, load, (image, step.factor), shift, gap, residual);
        self.active = active;
        self.check =
            Check::of(residuals.times(self.length), self.penetration, self.check.energy, load_control, p.len() as f64);
    }
}
