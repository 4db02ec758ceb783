//! Partial slip from step to step, with the errors of its results.
//!
//! A step at a fixed pressure is exact in time, of any size, where slip keeps its direction. While the pressure changes the implicit step is of
//! first order: such a step is divided, followed in half as many parts too, and extrapolated,
//!
//! 2X_n − X_{n/2},
//!
//! with the difference X_n − X_{n/2} as its error. The first load presses without a tangential force, then the force or shift is brought up at that
//! load; later steps change load and force, or shift, in proportion. The whole history is followed on the next coarser grid as well, and the
//! difference is the error of the grid.

use super::aim::{Aim, Ramp};
use super::disc::{Vector, add, dot, length, scale, sub};
use super::prolonged::prolonged;
use super::rolling::{NotAlongGrid, Rolling, Stride, contact_length};
use super::stick_slip::{SlipReport, SlipSettings};
use super::track::{History, Track, TrackStep};
use crate::lattice::LatticeError;
use crate::lattice::components::contact_spots;
use crate::load::{Control, Load};
use crate::measured::Measured;
use crate::notation::number;
use crate::numeric::sums;
use crate::problem::Problem;
use crate::spectral::{Contact, FieldError, Settings, Shear, Solver, Step};
use ndarray::Array2;
use std::f64::consts::PI;
use std::sync::Arc;

/// Parts of a step in which the load changes; even.
const PARTS: usize = 16;
/// Parts of a step at one load in which the pressure follows the tractions a little.
const PARTS_AT_ONE_LOAD: usize = 2;
/// Parts of a step in which the load changes, of a history without errors.
const FEW_PARTS: usize = 4;
/// Part of μP that rounding makes of a force that is given.
const ROUNDING: f64 = 1e-11;
/// Error that is stated over the change by steps of rolling half as long, where nothing slips: tractions at the trailing end are infinite then,
/// steps are of the order ½, and extrapolation leaves more than the change. Kalker's balls at 16 steps are off by 1.4 times this.
const OF_HALF_ORDER: f64 = 2.5;
/// Part of μδ, the order of a shift under which all slips, that is the least by which changes of the shift are measured.
const LEAST_SHIFT: f64 = 0.02;
/// Fewest points of a coarser grid along a lattice vector.
const COARSEST: usize = 24;

/// Tangential force or shift at the end of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Drive {
    /// Tangential force on the body over μP, below 1 in size.
    Part(Vector),
    /// Shift of the counterbody against the body since the first contact, a length.
    Shift(Vector),
}

/// A tangential force that friction does not bear: the counterbody slides.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "a tangential force of {} times μP is not borne by friction: the counterbody slides; keep it below 1, or leave [tangential] out, where \
     friction slides everywhere", number(*.0)
)]
pub struct Slides(pub f64);

/// Why partial slip cannot be set up.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SlipError {
    /// The problem has no friction.
    #[error("partial slip needs a coefficient of friction above 0")]
    Frictionless,
    /// A pressure is given.
    #[error("partial slip needs a counterbody: a given pressure has none that sticks")]
    Given,
    /// The grid is refused.
    #[error(transparent)]
    Grid(#[from] LatticeError),
    /// The gap is refused.
    #[error(transparent)]
    Gap(#[from] FieldError),
}

/// A contact that sticks and slips, step after step, of elastic surfaces: a hardness is left out.
#[derive(Debug)]
pub struct SlipSolver {
    problem: Arc<Problem>,
    track: Track,
    /// History of the same steps in half as many parts; `None` as long as no step was divided.
    halved: Option<History>,
    /// The same steps on the next coarser grid; `None` where that has too few points.
    coarser: Option<Track>,
    parts: usize,
    /// Whether steps are followed in half as many parts too.
    with_errors: bool,
    /// Largest size of the shift so far, a length.
    farthest: f64,
}

/// A vector, and the length of its error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasuredVector {
    /// The vector.
    pub value: Vector,
    /// Length of its error.
    pub error: f64,
}

/// A step of partial slip.
#[derive(Debug)]
pub struct SlipStep {
    /// The normal contact, with its partial slip.
    pub contact: Step,
    /// Tangential force on the body, a pressure times an area, on the cell or the isolated contact.
    pub force: MeasuredVector,
    /// Shift of the counterbody against the body since the first contact, of a contact that rolls over one contact length, a length.
    pub shift: MeasuredVector,
    /// Creepage: rise of the shift over the distance rolled; `None` unless the contact rolls.
    pub creepage: Option<MeasuredVector>,
    /// Work that slip dissipates in the step, an energy.
    pub work: Measured,
    /// Largest friction μP.
    pub limit: f64,
    /// How the last part of the step was solved.
    pub report: SlipReport,
    /// Turns between normal and tangential problem in the last part; 1 where they do not couple.
    pub turns: usize,
    /// Part of the samples in contact that stick.
    pub stick_fraction: Measured,
    /// Change against half as many parts, the larger of that of the force over μP and of the shift over the largest so far; 0 where the step needs one
    /// part.
    pub change: f64,
    /// Whether all parts converged.
    pub converged: bool,
}

/// A step on one track.
struct Followed {
    contact: Step,
    numbers: Numbers,
    limit: f64,
    report: SlipReport,
    turns: usize,
    converged: bool,
}

/// Results of a step on one track.
#[derive(Debug, Clone, Copy)]
struct Numbers {
    force: Vector,
    shift: Vector,
    work: f64,
    stick_fraction: f64,
    /// `None` unless the contact rolls.
    creepage: Option<Vector>,
}

impl Numbers {
    fn minus(&self, other: &Self) -> Self {
        Self {
            force: sub(self.force, other.force),
            shift: sub(self.shift, other.shift),
            work: self.work - other.work,
            stick_fraction: self.stick_fraction - other.stick_fraction,
            creepage: self.creepage.zip(other.creepage).map(|(a, b)| sub(a, b)),
        }
    }
}

/// The result of a step, extrapolated where it was followed in half as many parts too, with the difference `of_grid` from the coarser grid,
/// whose contact is that of the errors of stresses. The `farthest` shift so far is what changes of the shift are part of, and `left` the error
/// over the change.
fn result(
    step: Followed,
    coarser: Option<Step>,
    [halved, of_grid]: [Option<Numbers>; 2],
    [farthest, left]: [f64; 2],
) -> SlipStep {
    let Followed { contact, numbers, limit, report, turns, converged } = step;
    let in_time = halved.map(|halved| numbers.minus(&halved));
    let measured = |of: fn(&Numbers) -> Vector| {
        let change = in_time.as_ref().map_or([0.0; 2], of);
        let error = left * length(change) + of_grid.as_ref().map_or(0.0, |grid| length(of(grid)));
        MeasuredVector { value: add(of(&numbers), change), error }
    };
    let force = measured(|numbers| numbers.force);
    // A force that is given has no error but rounding.
    let is_given = force.error < ROUNDING * limit;
    let force = if is_given { MeasuredVector { value: numbers.force, error: 0.0 } } else { force };
    let number = |of: fn(&Numbers) -> Vector| {
        let MeasuredVector { value: [value, _], error } = measured(of);
        Measured::new(value, of_grid.map(|_| error))
    };
    let work = number(|numbers| [numbers.work, 0.0]);
    let part = |change: Vector, of: f64| if of > 0.0 { length(change) / of } else { 0.0 };
    let change = in_time.map_or(0.0, |change| part(change.force, limit).max(part(change.shift, farthest)));
    let left_open = square_of_a_sample(contact.finest()) * work.value.abs();
    SlipStep {
        force,
        shift: measured(|numbers| numbers.shift),
        creepage: numbers.creepage.map(|_| measured(|numbers| numbers.creepage.unwrap_or_default())),
        work: Measured::new(work.value, work.error.map(|error| error + left_open)),
        stick_fraction: number(|numbers| [numbers.stick_fraction, 0.0]),
        contact: match coarser {
            Some(coarse) => contact.with_coarser(coarse),
            None => contact,
        },
        limit,
        report,
        turns,
        change,
        converged,
    }
}

/// Square of the spacing over the mean radius of the spots: two grids may agree by chance, and the energy errs by about this part of it.
fn square_of_a_sample(contact: &Contact) -> f64 {
    let pressures = contact.pressures();
    let touching = pressures.iter().filter(|p| **p > 0.0).count();
    if touching == 0 { 0.0 } else { PI * contact_spots(contact.grid(), pressures).len() as f64 / touching as f64 }
}

/// The problem, where its counterbody can stick.
fn checked(problem: impl Into<Arc<Problem>>) -> Result<Arc<Problem>, SlipError> {
    let problem = problem.into();
    if problem.friction().is_none_or(|friction| friction.coefficient() == 0.0) {
        return Err(SlipError::Frictionless);
    }
    if problem.kind().is_given {
        return Err(SlipError::Given);
    }
    Ok(problem)
}

impl SlipSolver {
    /// The contact of a problem with friction before any load, on a grid of `points`.
    ///
    /// # Errors
    /// [`SlipError`].
    pub fn new(
        problem: impl Into<Arc<Problem>>,
        points: [usize; 2],
        settings: Settings,
        slip: SlipSettings,
    ) -> Result<Self, SlipError> {
        let problem = checked(problem)?;
        let on_grid = |points: [usize; 2]| Track::new(&problem, points, settings, slip);
        let line = problem.loaded_by().line();
        let half = [0, 1].map(|axis| if line == Some(axis) { points[axis] } else { points[axis] / 2 });
        let is_fine = (0..2).all(|axis| line == Some(axis) || half[axis] >= COARSEST);
        let coarser = if is_fine { Some(on_grid(half)?) } else { None };
        let track = on_grid(points)?;
        Ok(Self { problem, track, halved: None, coarser, parts: PARTS, with_errors: true, farthest: 0.0 })
    }

    /// The contact of a problem with friction before any load, with an initial gap, lengths on its grid, as of [`Solver::with_gap`]. Its steps have no
    /// errors: there is no coarser grid, and fewer parts of steps in which the load changes.
    ///
    /// # Errors
    /// [`SlipError`].
    pub fn on_gap(
        problem: impl Into<Arc<Problem>>,
        gap: Array2<f64>,
        settings: Settings,
        slip: SlipSettings,
    ) -> Result<Self, SlipError> {
        let problem = checked(problem)?;
        let track = Track::new(&problem, gap.dim().into(), settings, slip)?.on_gap(gap)?;
        let (parts, with_errors) = (FEW_PARTS, false);
        Ok(Self { problem, track, halved: None, coarser: None, parts, with_errors, farthest: 0.0 })
    }

    /// The solver with another even number of parts for a step in which the pressure changes.
    #[must_use]
    pub fn with_parts(self, parts: usize) -> Self {
        Self { parts: parts.next_multiple_of(2).max(2), ..self }
    }

    /// Shift of the counterbody less the tangential displacement of each sample, lengths, since the first contact: what both surfaces have moved
    /// against each other there, also beside the contact.
    pub fn sheared(&self) -> Vec<Vector> {
        let shift = self.track.shift();
        self.track.displacement().iter().map(|displacement| sub(shift, *displacement)).collect()
    }

    /// Least mean pressure of complete contact, as of [`Solver::full_contact_pressure`].
    pub fn full_contact_pressure(&mut self) -> f64 {
        self.track.full_contact_pressure()
    }

    /// Forgets all steps: the next one is the first.
    pub fn begin_anew(&mut self) {
        (self.halved, self.farthest) = (None, 0.0);
        [Some(&mut self.track), self.coarser.as_mut()].into_iter().flatten().for_each(Track::begin_anew);
    }

    /// The problem.
    pub fn problem(&self) -> &Arc<Problem> {
        &self.problem
    }

    /// The solver of the normal contact.
    pub fn normal(&self) -> &Solver {
        self.track.solver()
    }

    /// One step to a load, and a tangential force or shift at its end.
    ///
    /// # Errors
    /// [`Slides`] for a force that friction does not bear.
    pub fn advance(&mut self, load: Load, drive: Drive) -> Result<SlipStep, Slides> {
        if let Drive::Part(part) = drive
            && length(part) >= 1.0
        {
            return Err(Slides(length(part)));
        }
        let at_one_load = if self.track.couples() { PARTS_AT_ONE_LOAD } else { 1 };
        let (aim, parts) = (self.aim(load, drive), Parts { changing: self.parts, at_one_load });
        let is_divided = self.with_errors && parts.divide(&self.track, load, aim);
        let before = self.halved.take().or_else(|| is_divided.then(|| self.track.history()));
        let coarser = self.coarser.as_mut().map(|track| follow(track, load, aim, parts, None));
        let begins = coarser.as_ref().filter(|_| self.track.has_no_tractions());
        let near = begins.and_then(|coarse| prolonged(coarse.contact.finest(), self.track.solver().grid()));
        let near = near.as_deref();
        let step = follow(&mut self.track, load, aim, parts, near);
        let halved = before.map(|history| {
            let whole = self.track.replace_history(history);
            let numbers = follow(&mut self.track, load, aim, parts.halved(), near).numbers;
            self.halved = Some(self.track.replace_history(whole));
            numbers
        });
        let of_grid = coarser.as_ref().map(|coarse| step.numbers.minus(&coarse.numbers));
        // Shifts far below μδ are none.
        let least = LEAST_SHIFT * self.track.friction() * step.contact.penetration().abs();
        self.farthest = self.farthest.max(length(step.numbers.shift)).max(least);
        Ok(result(step, coarser.map(|coarse| coarse.contact), [halved, of_grid], [self.farthest, 1.0]))
    }

    /// Rolls at a load under a tangential force or a creepage until some contact lengths are passed, by steps, then by half as long ones.
    ///
    /// Shift, slip and energy of the result are those of one contact length.
    ///
    /// # Errors
    /// [`RollError`].
    pub fn roll(&mut self, load: Load, drive: RollingDrive, rolling: Rolling) -> Result<SlipStep, RollError> {
        if let RollingDrive::Part(part) = drive
            && length(part) >= 1.0
        {
            return Err(Slides(length(part)).into());
        }
        let pressed = self.track.press(load);
        let grid = Arc::clone(pressed.grid());
        let whole = contact_length(&grid, pressed.finest().pressures(), rolling.direction);
        if whole == 0.0 {
            return Err(RollError::NoContact);
        }
        let strides = Stride::pair(&grid, rolling.direction, rolling.step * whole)?;
        let distance = rolling.distance * whole;
        let steps = roll(&mut self.track, load, drive, (&strides[0], distance), whole);
        let halved = roll(&mut self.track, load, drive, (&strides[1], 0.5 * distance), whole);
        let coarser = match &mut self.coarser {
            None => None,
            Some(track) => {
                let grid = Arc::clone(track.press(load).grid());
                let [stride, _] = Stride::pair(&grid, rolling.direction, strides[0].length())?;
                Some(roll(track, load, drive, (&stride, distance), whole))
            }
        };
        self.halved = None;
        // Both grids in steps of one length.
        let of_grid = coarser.as_ref().map(|coarse| steps.numbers.minus(&coarse.numbers));
        let farthest = length(halved.numbers.shift);
        // Where less than half a step slips, the traction at the trailing end is as good as infinite.
        let slips = (1.0 - halved.numbers.stick_fraction).max(0.0);
        let left = 1.0 + (OF_HALF_ORDER - 1.0) * (0.5 * rolling.step / slips).min(1.0);
        Ok(result(halved, coarser.map(|coarse| coarse.contact), [Some(steps.numbers), of_grid], [farthest, left]))
    }

    /// Tangential force or shift of a drive at a load.
    fn aim(&self, load: Load, drive: Drive) -> Aim {
        let cell = self.problem.cell();
        match (drive, load.on(cell)) {
            (Drive::Part(part), Control::MeanPressure(mean)) => {
                Aim::Force(scale(self.track.friction() * mean * cell.area(), part))
            }
            (Drive::Part(part), Control::Penetration(_)) => Aim::Part(part),
            (Drive::Shift(shift), _) => Aim::Shift(shift),
        }
    }
}

/// Tangential force or creepage of a contact that rolls.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RollingDrive {
    /// Tangential force on the body over μP, below 1 in size.
    Part(Vector),
    /// Creepage: rise of the shift over the distance rolled.
    Creepage(Vector),
}

/// Why a contact does not roll.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum RollError {
    /// The force is beyond friction.
    #[error(transparent)]
    Slides(#[from] Slides),
    /// The direction is not one of the grid.
    #[error(transparent)]
    NotAlongGrid(#[from] NotAlongGrid),
    /// The load is zero.
    #[error("without a load nothing touches that could roll; keep every load of a contact that rolls above 0")]
    NoContact,
}

/// Number of parts of a ramp.
#[derive(Debug, Clone, Copy)]
struct Parts {
    /// Where the load changes.
    changing: usize,
    at_one_load: usize,
}

impl Parts {
    fn of(self, ramp: &Ramp) -> usize {
        if ramp.is_at_one_load() { self.at_one_load } else { self.changing }
    }

    /// Half as many, at least one.
    fn halved(self) -> Self {
        Self { changing: self.changing.div_ceil(2), at_one_load: self.at_one_load.div_ceil(2) }
    }

    /// Whether a step of a track is divided.
    fn divide(self, track: &Track, load: Load, aim: Aim) -> bool {
        track.ramps(load, aim).iter().any(|ramp| self.of(ramp) > 1)
    }
}

/// Slip, dissipated energy per area and work of a step, summed over its parts.
struct Sum {
    slip: Vec<Vector>,
    density: Vec<f64>,
    work: f64,
    converged: bool,
}

impl Sum {
    fn add(&mut self, step: &TrackStep) {
        self.work += step.work;
        self.converged &= step.is_converged();
        sums::update(&mut self.slip, |i, slip| add(slip, step.slip[i]));
        sums::update(&mut self.density, |i, density| density + dot(step.traction[i], step.slip[i]));
    }
}

/// Follows all ramps of a step, each in its number of parts; at the end tractions are `near` such parts of μp.
fn follow(track: &mut Track, load: Load, aim: Aim, parts: Parts, near: Option<&[Vector]>) -> Followed {
    let len = track.solver().grid().len();
    let mut sum = Sum { slip: vec![[0.0; 2]; len], density: vec![0.0; len], work: 0.0, converged: true };
    let ramps = track.ramps(load, aim);
    let mut ends: Vec<(Load, Aim)> = ramps.iter().flat_map(|ramp| ramp.ends(parts.of(ramp))).collect();
    // The last one is the load and the aim.
    ends.pop();
    for (load, aim) in ends {
        sum.add(&track.advance(load, aim));
    }
    let step = track.advance_near(load, aim, near);
    sum.add(&step);
    let Sum { slip, density, work, converged } = sum;
    let numbers =
        Numbers { force: step.force, shift: step.shift, work, stick_fraction: step.stick_fraction, creepage: None };
    followed(track, step, numbers, (&slip, density), converged)
}

/// Rolls a distance in equal strides; the `length` of the contact is what shift, slip and work are for.
fn roll(
    track: &mut Track,
    load: Load,
    drive: RollingDrive,
    (stride, distance): (&Stride, f64),
    length: f64,
) -> Followed {
    let strides = (distance / stride.length()).ceil().max(1.0) as usize;
    for _ in 1..strides {
        rolled(track, load, drive, stride);
    }
    let (step, rise) = rolled(track, load, drive, stride);
    let whole = length / stride.length();
    let slip: Vec<Vector> = step.slip.iter().map(|s| scale(whole, *s)).collect();
    let density = step.traction.iter().zip(&slip).map(|(q, s)| dot(*q, *s)).collect();
    let creepage = scale(1.0 / stride.length(), rise);
    let numbers = Numbers {
        force: step.force,
        shift: scale(length, creepage),
        // In steady rolling slip dissipates what the force does, unless the pressure does work too.
        work: if track.couples() { whole * step.work } else { length * dot(step.force, creepage) },
        stick_fraction: step.stick_fraction,
        creepage: Some(creepage),
    };
    let converged = step.is_converged();
    followed(track, step, numbers, (&slip, density), converged)
}

/// One stride, with the rise of the shift in it.
fn rolled(track: &mut Track, load: Load, drive: RollingDrive, stride: &Stride) -> (TrackStep, Vector) {
    let grid = Arc::clone(track.solver().grid());
    let before = track.shift();
    let moved = stride.moved(&grid, track.displacement());
    let aim = match drive {
        RollingDrive::Part(part) => Aim::Part(part),
        RollingDrive::Creepage(creepage) => Aim::Shift(add(before, scale(stride.length(), creepage))),
    };
    let step = track.advance_from(load, aim, &moved, None);
    let rise = sub(step.shift, before);
    (step, rise)
}

/// A step of a track, with its slip and energy per area.
fn followed(
    track: &Track,
    step: TrackStep,
    numbers: Numbers,
    (slip, work): (&[Vector], Vec<f64>),
    converged: bool,
) -> Followed {
    let TrackStep { contact, traction, limit, report, turns, .. } = step;
    let components = |field: &[Vector]| [0, 1].map(|component| field.iter().map(|v| v[component]).collect());
    let friction = track.friction();
    let shear = Shear { traction: components(&traction), slip: components(slip), work, friction };
    Followed { contact: contact.with_shear(shear), numbers, limit, report, turns, converged }
}
