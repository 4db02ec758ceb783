//! One history of partial slip on one grid: normal contact and tractions, step after step.
//!
//! Each step is solved by the implicit problem of [`StickSlip`] under its pressure. Where pressure and tractions couple, the normal contact is
//! solved with the gap opened by the tractions, then the tractions under the new pressure, in turn, until the normal problem needs no
//! iteration more for the newest tractions: then both certificates hold for the same pair.

use super::aim::{Aim, Ramp};
use super::disc::{Vector, add, dot, scale, sticks, sub};
use super::operator::TangentialOperator;
use super::preconditioner::Preconditioner;
use super::stick_slip::{ShearControl, SlipReport, SlipSettings, Slipped, StickSlip};
use crate::lattice::LatticeError;
use crate::load::Load;
use crate::numeric::sums;
use crate::problem::Problem;
use crate::spectral::iteration::Unknowns;
use crate::spectral::{FieldError, Settings, Solver, Step, Stop};
use ndarray::Array2;
use std::sync::Arc;

/// Most turns between the normal and the tangential problem.
const MOST_TURNS: usize = 60;
/// Part of μP below which a force is none.
const NO_FORCE: f64 = 1e-12;
/// Tolerance of the tractions in the first turn, and its ratio from turn to turn, down to that of the settings.
const FIRST_TOLERANCE: f64 = 1e-4;
const TIGHTER: f64 = 1e-2;

/// Contact, tractions and their history on one grid.
#[derive(Debug)]
pub(in crate::spectral) struct Track {
    solver: Solver,
    operator: TangentialOperator,
    preconditioner: Preconditioner,
    /// Coefficient of friction μ.
    friction: f64,
    settings: SlipSettings,
    state: SlipState,
}

/// History of a track: all that its next step needs of those before.
#[derive(Debug, Clone)]
pub(super) struct History {
    slip: SlipState,
    /// Unknowns of the normal contact on all grids, the finest first.
    unknowns: Vec<Unknowns>,
}

/// Tractions and displacements after a step, with the load and the tangential force that they belong to.
#[derive(Debug, Clone)]
struct SlipState {
    /// Traction **q** on the body, a pressure.
    traction: Arc<Vec<Vector>>,
    /// Tangential displacement A**q** + Bp on all samples, a length.
    displacement: Arc<Vec<Vector>>,
    /// Shift of the counterbody against the body since the first contact, a length.
    shift: Vector,
    /// `None` before the first contact.
    end: Option<StepEnd>,
}

impl SlipState {
    /// The state of so many samples before the first contact.
    fn still(len: usize) -> Self {
        let still = Arc::new(vec![[0.0; 2]; len]);
        Self { traction: Arc::clone(&still), displacement: still, shift: [0.0; 2], end: None }
    }
}

/// Load and tangential force at the end of a step.
#[derive(Debug, Clone, Copy)]
struct StepEnd {
    load: Load,
    /// Mean pressure over the cell.
    mean_pressure: f64,
    penetration: f64,
    /// Tangential force on the body.
    force: Vector,
    /// Largest friction μP.
    limit: f64,
}

/// A step of a track.
#[derive(Debug)]
pub(in crate::spectral) struct TrackStep {
    /// The normal contact.
    pub contact: Step,
    /// **q**, a pressure.
    pub traction: Arc<Vec<Vector>>,
    /// **s** where there is pressure, a length.
    pub slip: Vec<Vector>,
    /// Tangential force on the body, a pressure times an area.
    pub force: Vector,
    /// Work that slip dissipates in the step, an energy: Σ**q**·**s** ΔA.
    pub work: f64,
    /// Largest friction μP that the pressure allows.
    pub limit: f64,
    pub report: SlipReport,
    /// Turns between normal and tangential problem; 1 where they do not couple.
    pub turns: usize,
    /// Shift since the first contact.
    pub shift: Vector,
    /// Part of the samples in contact that stick.
    pub stick_fraction: f64,
}

impl TrackStep {
    /// Whether pressure and tractions meet their tolerances, or hardly a sample touches, which bears next to nothing.
    pub fn is_converged(&self) -> bool {
        let stop = self.contact.report.stop;
        self.report.converged && (stop.solved() || stop == Stop::Unresolved)
    }
}

impl Track {
    /// The history before any contact, with `points` samples; the friction of the problem sticks or slips.
    pub fn new(
        problem: &Problem,
        points: [usize; 2],
        settings: Settings,
        slip: SlipSettings,
    ) -> Result<Self, LatticeError> {
        let (friction, coupled) =
            problem.friction().map_or((0.0, false), |friction| (friction.coefficient(), friction.is_coupled()));
        let solver = Solver::new(problem.at_rest().without_hardness(), points, settings)?;
        let operator = TangentialOperator::new(solver.grid(), problem.bodies(), coupled);
        let preconditioner = Preconditioner::new(&operator);
        let state = SlipState::still(solver.grid().len());
        Ok(Self { solver, operator, preconditioner, friction, settings: slip, state })
    }

    /// Whether pressure and tractions displace for one another.
    pub fn couples(&self) -> bool {
        self.operator.couples()
    }

    /// Whether nothing has been sheared yet.
    pub fn has_no_tractions(&self) -> bool {
        self.state.traction.iter().all(|q| *q == [0.0; 2])
    }

    /// Coefficient of friction μ.
    pub fn friction(&self) -> f64 {
        self.friction
    }

    /// The solver of the normal contact.
    pub fn solver(&self) -> &Solver {
        &self.solver
    }

    /// The history so far.
    pub fn history(&self) -> History {
        History { slip: self.state.clone(), unknowns: self.solver.unknowns().cloned().collect() }
    }

    /// The track with another initial gap, before any contact.
    pub fn on_gap(self, gap: Array2<f64>) -> Result<Self, FieldError> {
        let state = SlipState::still(gap.len());
        Ok(Self { solver: self.solver.with_gap(gap)?, state, ..self })
    }

    /// Least mean pressure of complete contact.
    pub fn full_contact_pressure(&mut self) -> f64 {
        self.solver.full_contact_pressure()
    }

    /// Forgets all steps: the next one presses first. The pressure stays as a start of the iteration.
    pub fn begin_anew(&mut self) {
        self.state = SlipState::still(self.solver.grid().len());
    }

    /// Goes on from another history on the same grid; returns the one that it leaves.
    pub fn replace_history(&mut self, other: History) -> History {
        let left = self.history();
        self.state = other.slip;
        self.solver.set_unknowns(other.unknowns);
        left
    }

    /// The ramps from the last step to a load and an aim. The first load presses without a tangential force.
    pub fn ramps(&self, load: Load, aim: Aim) -> Vec<Ramp> {
        match &self.state.end {
            Some(end) => {
                let start = match aim {
                    Aim::Force(_) => end.force,
                    Aim::Part(_) if end.limit > 0.0 => scale(1.0 / end.limit, end.force),
                    Aim::Part(_) => [0.0; 2],
                    Aim::Shift(_) => self.state.shift,
                };
                let area = self.solver.grid().cell().area();
                vec![Ramp { loads: [end.load_as(load, area), load], aims: [aim.with(start), aim] }]
            }
            None => {
                let still = aim.with([0.0; 2]);
                let pressed = Ramp { loads: [load.with_value(0.0), load], aims: [still; 2] };
                let sheared = Ramp { loads: [load; 2], aims: [still, aim] };
                if self.couples() { vec![pressed, sheared] } else { vec![sheared] }
            }
        }
    }

    /// Shift of the counterbody against the body since the first contact.
    pub fn shift(&self) -> Vector {
        self.state.shift
    }

    /// Tangential displacement on all samples.
    pub fn displacement(&self) -> &[Vector] {
        &self.state.displacement
    }

    /// The contact pressed to a load without tractions.
    pub fn press(&mut self, load: Load) -> Step {
        self.solver.solve(load)
    }

    /// One step to a load and a tangential force or shift, from the tractions of the step before.
    pub fn advance(&mut self, load: Load, aim: Aim) -> TrackStep {
        self.advance_near(load, aim, None)
    }

    /// One step as [`Self::advance`]; without tractions so far the iteration begins with such `parts` of μp.
    pub fn advance_near(&mut self, load: Load, aim: Aim, parts: Option<&[Vector]>) -> TrackStep {
        let before = Arc::clone(&self.state.displacement);
        let is_new = self.has_no_tractions();
        self.advance_from(load, aim, &before, parts.filter(|_| is_new))
    }

    /// One step from such parts of μp, or the tractions of the step before; its samples had the tangential displacement `before`.
    pub fn advance_from(&mut self, load: Load, aim: Aim, before: &[Vector], parts: Option<&[Vector]>) -> TrackStep {
        let mut contact = self.solver.solve(load);
        let (mut slipped, mut dragged, mut turns) = (None::<Slipped>, None, 0);
        let (mut pressed, mut near, mut agree) = (Vec::new(), None, !self.couples());
        let (mut iterations, mut convolutions) = (contact.report.iterations, contact.convolutions);
        let mut tolerance = if self.couples() { FIRST_TOLERANCE } else { 0.0 };
        while contact.report.stop.solved() && turns < MOST_TURNS {
            turns += 1;
            tolerance = self.settings.tolerance.max(tolerance);
            dragged = self.operator.dragged(contact.finest().pressures());
            let pressures = contact.finest().pressures();
            let first = || match parts {
                Some(parts) => Arc::new(of_bounds(parts, pressures, self.friction)),
                None => Arc::clone(&self.state.traction),
            };
            let start =
                slipped.map_or_else(first, |last| Arc::new(rebound(last.traction, &pressed, pressures, self.friction)));
            pressed = pressures.to_vec();
            let next = self.slip(&contact, dragged.as_deref(), before, (aim, tolerance), (&start, near));
            near = Some(next.rise);
            let (lift, steady) = (self.operator.lifted(&next.traction), next.report.iterations == 0);
            slipped = Some(next);
            let Some(lift) = lift else { break };
            contact = self.solver.solve_lifted(load, &lift);
            (iterations, convolutions) = (iterations + contact.report.iterations, convolutions + contact.convolutions);
            // Tractions that meet their tolerance change no pressure, or met it under the newest pressure as they were.
            let rests = contact.report.iterations == 0 || steady;
            agree = rests && tolerance == self.settings.tolerance;
            if agree {
                break;
            }
            tolerance *= TIGHTER;
        }
        (contact.report.iterations, contact.convolutions) = (iterations, convolutions);
        let mut slipped = slipped.unwrap_or_else(|| {
            let still = Arc::clone(&self.state.traction);
            self.slip(&contact, None, before, (aim, self.settings.tolerance), (&still, None))
        });
        slipped.report.converged &= agree || turns == 0;
        self.finish((load, contact), slipped, dragged, turns)
    }

    /// The tractions under the pressure of a contact.
    fn slip(
        &mut self,
        contact: &Step,
        dragged: Option<&[Vector]>,
        displaced: &[Vector],
        (aim, tolerance): (Aim, f64),
        (start, near): (&[Vector], Option<Vector>),
    ) -> Slipped {
        let bound: Vec<f64> = contact.finest().pressures().iter().map(|p| self.friction * p).collect();
        let area = contact.grid().sample_area();
        let control = match aim {
            Aim::Force(force) => ShearControl::Force(force),
            Aim::Part(part) => ShearControl::Force(scale(area * sums::of(bound.len(), |i| [bound[i]])[0], part)),
            Aim::Shift(shift) => ShearControl::Shift(sub(shift, self.state.shift)),
        };
        let mut before = displaced.to_vec();
        if let Some(dragged) = dragged {
            sums::update(&mut before, |i, u| sub(u, dragged[i]));
        }
        let step = StickSlip {
            operator: &mut self.operator,
            preconditioner: &self.preconditioner,
            bound: &bound,
            before: &before,
            control,
            near,
            area,
            settings: SlipSettings { tolerance, ..self.settings },
        };
        rayon::scope(|_| step.solve(start))
    }

    /// The step, and its state for the next one.
    fn finish(
        &mut self,
        (load, contact): (Load, Step),
        slipped: Slipped,
        dragged: Option<Vec<Vector>>,
        turns: usize,
    ) -> TrackStep {
        let Slipped { traction, mut displacement, slip, rise, report } = slipped;
        if let Some(dragged) = dragged {
            sums::update(&mut displacement, |i, u| add(u, dragged[i]));
        }
        let area = contact.grid().sample_area();
        let pressures = contact.finest().pressures();
        let [x, y, work, pressure, touching, sticking] = sums::of(traction.len(), |i| {
            let (q, p) = (traction[i], pressures[i]);
            let [touches, sticks] = [p > 0.0, sticks(q, self.friction * p)].map(|is| f64::from(u8::from(is)));
            [q[0], q[1], dot(q, slip[i]), p, touches, sticks]
        });
        let (shift, limit) = (add(self.state.shift, rise), self.friction * area * pressure);
        // A force of the size of rounding is none.
        let force = scale(area, [x, y]).map(|force| if force.abs() < NO_FORCE * limit { 0.0 } else { force });
        let traction = Arc::new(traction);
        let end = StepEnd {
            load,
            mean_pressure: pressure / traction.len() as f64,
            penetration: contact.penetration(),
            force,
            limit,
        };
        let (displacement, end) = (Arc::new(displacement), Some(end));
        self.state = SlipState { traction: Arc::clone(&traction), displacement, shift, end };
        TrackStep {
            contact,
            traction,
            slip,
            force,
            work: area * work,
            limit,
            report,
            turns,
            shift,
            stick_fraction: if touching > 0.0 { sticking / touching } else { 0.0 },
        }
    }
}

/// Tractions that are `parts` of μp.
fn of_bounds(parts: &[Vector], pressures: &[f64], friction: f64) -> Vec<Vector> {
    let mut traction = parts.to_vec();
    sums::update(&mut traction, |i, part| scale(friction * pressures[i], part));
    traction
}

/// Tractions under one pressure as a start under another: those that slip stay on their circles.
fn rebound(mut traction: Vec<Vector>, from: &[f64], to: &[f64], friction: f64) -> Vec<Vector> {
    sums::update(&mut traction, |i, q| {
        let slips = from[i] > 0.0 && !sticks(q, friction * from[i]);
        if slips { scale(to[i] / from[i], q) } else { q }
    });
    traction
}

impl StepEnd {
    /// The load in the quantity of another one, on a cell of an area.
    fn load_as(&self, other: Load, area: f64) -> Load {
        if std::mem::discriminant(&self.load) == std::mem::discriminant(&other) {
            return self.load;
        }
        other.with_value(match other {
            Load::MeanPressure(_) => self.mean_pressure,
            Load::Force(_) => self.mean_pressure * area,
            Load::Penetration(_) | Load::Grip { .. } => self.penetration,
        })
    }
}
