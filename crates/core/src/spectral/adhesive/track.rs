//! States of equilibrium of surfaces that adhere, on one grid.

use super::elastic::{Elastic, Hold};
use super::minimiser::{Ended, Fields, Minimiser, NO_FORCE};
use super::stability::softening_over_stiffness;
use super::tension::Tension;
use crate::adhesion::Adhesion;
use crate::counterbody::Surface;
use crate::lattice::{Grid, LatticeError};
use crate::load::Load;
use crate::numeric::sums;
use crate::problem::Problem;
use crate::spectral::iteration::{Certificate, Progress, Report, Route, Settings, Stop};
use crate::spectral::{Contact, Step};
use std::ops::ControlFlow;
use std::sync::Arc;

/// Tolerance of the first outer iteration around an isolated contact, and its ratio from one to the next, down to that of the settings.
const FIRST_TOLERANCE: f64 = 1e-3;
const TIGHTER: f64 = 1e-2;
/// Most outer iterations.
const MOST_OUTER: usize = 30;
/// Change of what the images displace, over the tolerance and the largest displacement or the range of the tension, that needs no further
/// iteration.
const SETTLED: f64 = 10.0;
/// Part of the strength from which on a tension counts for the area that pulls.
const HALF: f64 = 0.5;
/// Part of the strength with which surfaces may pull at the border of the window of an isolated contact: beyond the window they pull less.
const AT_BORDER: f64 = 0.02;

/// Surfaces that adhere on one grid.
#[derive(Debug)]
pub(super) struct Track {
    problem: Arc<Problem>,
    surface: Arc<Surface>,
    elastic: Elastic,
    tension: Tension,
    settings: Settings,
}

/// The prescribed quantity of a state: a force, or the position of a grip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Aim {
    /// The force on the cell, or on the isolated contact.
    Force(f64),
    /// The position of a grip that holds the counterbody by a spring, a force per length; infinite of a rigid machine.
    Grip { position: f64, stiffness: f64 },
}

impl Aim {
    /// The aim of a load on a cell of some area.
    pub fn of(load: Load, area: f64) -> Self {
        match load {
            Load::MeanPressure(mean) => Self::Force(mean * area),
            Load::Force(force) => Self::Force(force),
            Load::Penetration(position) => Self::Grip { position, stiffness: f64::INFINITY },
            Load::Grip { position, stiffness } => Self::Grip { position, stiffness },
        }
    }

    /// The prescribed value, a force or a length.
    pub fn value(self) -> f64 {
        match self {
            Self::Force(value) | Self::Grip { position: value, .. } => value,
        }
    }

    /// The aim with another value.
    pub fn with(self, value: f64) -> Self {
        match self {
            Self::Force(_) => Self::Force(value),
            Self::Grip { stiffness, .. } => Self::Grip { position: value, stiffness },
        }
    }

    /// The value at which a state would be prescribed in this way.
    pub fn value_of(self, numbers: &Numbers) -> f64 {
        match self {
            Self::Force(_) => numbers.force,
            Self::Grip { stiffness, .. } => numbers.penetration + numbers.force / stiffness,
        }
    }
}

/// Numbers of a state, on the cell or the isolated contact.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Numbers {
    /// Net force.
    pub force: f64,
    /// Penetration δ, a length.
    pub penetration: f64,
    /// Σ of the pressure of contact, a force.
    pub contact_load: f64,
    /// Σ of the tension, a force.
    pub adhesive_load: f64,
    /// Area of the samples that touch, a length squared.
    pub contact_area: f64,
    /// Area of the samples beside it that pull with more than half of the strength, a length squared.
    pub cohesive_area: f64,
    /// Elastic energy and that of the tension.
    pub energy: f64,
}

/// A state of equilibrium.
#[derive(Debug, Clone)]
pub(super) struct State {
    fields: Arc<Fields>,
    /// D p, lengths in the window; empty on a periodic cell.
    correction: Arc<Vec<f64>>,
    /// w − (g − f − D p) in the window, a length.
    shift: f64,
    pub numbers: Numbers,
    pub report: Report,
    pub certificate: Certificate,
    hold: Hold,
}

impl State {
    /// Whether the surfaces neither touch nor pull with more than a force that is none.
    fn is_apart(&self, none: f64) -> bool {
        self.numbers.contact_area == 0.0 && self.numbers.adhesive_load <= none
    }

    /// Whether the surfaces have come apart under a tensile force, which nothing bears.
    pub fn is_detached(&self) -> bool {
        self.report.stop == Stop::Detached
    }
}

impl Track {
    /// Surfaces of a problem with adhesion on a grid of `points`.
    pub fn new(
        problem: &Arc<Problem>,
        adhesion: Adhesion,
        points: [usize; 2],
        settings: Settings,
    ) -> Result<Self, LatticeError> {
        let surface = Arc::new(problem.loaded_by().surface(points)?);
        let elastic = Elastic::new(problem, surface.grid())?;
        let tension = Tension::on_grid(adhesion, problem.bodies().contact_modulus(), surface.grid().spacing());
        Ok(Self { problem: Arc::clone(problem), surface, elastic, tension, settings })
    }

    pub fn grid(&self) -> &Arc<Grid> {
        self.surface.grid()
    }

    pub fn surface(&self) -> &Arc<Surface> {
        &self.surface
    }

    /// Convolutions so far, as equivalents of one on the cell or the doubled window.
    pub fn convolutions(&self) -> f64 {
        self.elastic.convolutions()
    }

    /// Undeformed surfaces at a penetration, from which the first state is found.
    pub fn undeformed(&self, penetration: f64) -> State {
        let f = self.surface.gaps();
        let gap: Vec<f64> = f.iter().map(|f| (f - penetration).max(0.0)).collect();
        let displacement: Vec<f64> = gap.iter().zip(f).map(|(gap, f)| gap - f + penetration).collect();
        let zero = || vec![0.0; if self.elastic.is_isolated() { f.len() } else { 0 }];
        let fields = Fields {
            gap: self.elastic.spread(&gap, 0.0),
            displacement: self.elastic.spread(&displacement, 0.0),
            pressure: vec![0.0; self.elastic.len()],
        };
        State {
            fields: Arc::new(fields),
            correction: Arc::new(zero()),
            shift: penetration,
            numbers: Numbers { penetration, ..Numbers::default() },
            report: Report { stop: Stop::NoContact, route: Route::Direct, iterations: 0, outer: 0, residual: 0.0 },
            certificate: Certificate::default(),
            hold: Hold::Mean,
        }
    }

    /// How the torus is held.
    fn hold(&self, aim: Aim) -> Hold {
        match aim {
            Aim::Force(force) => Hold::Load(force / self.elastic.area()),
            Aim::Grip { stiffness, .. } => match self.elastic.mean_compliance() + self.elastic.area() / stiffness {
                0.0 => Hold::Mean,
                compliance => Hold::Spring(compliance),
            },
        }
    }

    /// The state at an aim that is found from another one: its gap is carried over.
    pub fn solve(
        &mut self,
        from: &State,
        aim: Aim,
        progress: &mut (dyn FnMut(Progress) -> ControlFlow<()> + Send),
    ) -> State {
        let hold = self.hold(aim);
        // Under a load surfaces that are far apart come together until they touch.
        let touching = match aim {
            Aim::Force(force) if force > 0.0 && from.is_apart(self.nothing().min(force)) => Some(self.undeformed(0.0)),
            _ => None,
        };
        let from = touching.as_ref().unwrap_or(from);
        let Some((mut fields, mut shift)) = self.start(from, aim, hold) else {
            let report = Report { stop: Stop::BeyondFullContact, ..from.report };
            return State { report, ..from.clone() };
        };
        let mut correction = Arc::clone(&from.correction);
        let goal = self.settings.tolerance;
        let mut tolerance = if self.elastic.is_isolated() { FIRST_TOLERANCE.max(goal) } else { goal };
        let (mut iterations, mut outer) = (0, 0);
        let (ended, displaced) = loop {
            let mut minimiser = Minimiser {
                elastic: &mut self.elastic,
                tension: &self.tension,
                hold,
                tolerance,
                max_iterations: self.settings.max_iterations.saturating_sub(iterations),
                progress: &mut *progress,
            };
            minimiser.refresh(&mut fields);
            let ended = minimiser.solve(&mut fields);
            (iterations, outer) = (iterations + ended.iterations, outer + 1);
            let pressure = self.elastic.within(&fields.pressure);
            let Some([new, displaced]) = self.elastic.corrected(&pressure) else { break (ended, None) };
            let largest = |len: usize, of: &(dyn Fn(usize) -> f64 + Sync)| -sums::least(len, |i| -of(i).abs());
            let change = largest(new.len(), &|i| new[i] - correction[i]);
            let scale = largest(displaced.len(), &|i| displaced[i]).max(self.tension.range());
            let is_settled = change <= SETTLED * goal * scale && tolerance <= goal;
            if ended.stop != Stop::Converged || is_settled {
                break (ended, Some(displaced));
            }
            if outer >= MOST_OUTER {
                break (Ended { stop: Stop::IterationLimit, ..ended }, Some(displaced));
            }
            // The mean of the change moves as a whole.
            let moved = sums::mean(&new) - sums::mean(&correction);
            let change: Vec<f64> = new.iter().zip(&*correction).map(|(new, old)| new - old - moved).collect();
            let change = self.elastic.spread(&change, 0.0);
            if let Aim::Grip { .. } = aim {
                sums::update(&mut fields.displacement, |i, w| w - change[i] - moved);
            } else {
                sums::update(&mut fields.displacement, |i, w| w - change[i]);
                shift += moved;
            }
            correction = Arc::new(new);
            tolerance = goal.max(TIGHTER * tolerance);
        };
        if !self.elastic.is_isolated() {
            outer = 0;
        }
        if ended.stop == Stop::Detached {
            // Nothing bears the force: far apart, the surfaces are not deformed.
            let report = Report { stop: Stop::Detached, iterations, outer, residual: ended.residual, ..from.report };
            return State { report, ..self.undeformed(-self.tension.reach()) };
        }
        self.state((fields, correction, shift), displaced, (aim, hold), (ended, iterations, outer))
    }

    /// Fields with the gap of a state, at a new aim, and the shift of their displacement; `None` where contact is complete before.
    fn start(&self, from: &State, aim: Aim, hold: Hold) -> Option<(Fields, f64)> {
        let f = self.surface.gaps();
        let mut fields = (*from.fields).clone();
        if hold == Hold::Mean {
            let target = self.surface.mean() - aim.value();
            if target <= 0.0 {
                return None;
            }
            let (mean, initial) = (sums::mean(&fields.gap), self.surface.mean());
            // Out of complete contact the gap has the shape of the counterbody.
            sums::update(&mut fields.gap, |i, g| target * if mean > 0.0 { g / mean } else { f[i] / initial });
        }
        let shift = match aim {
            Aim::Force(_) => from.shift,
            Aim::Grip { position, .. } => position,
        };
        // What lies outside of a window moves with it.
        let moved = shift - from.shift;
        if self.elastic.is_isolated() {
            let g = self.elastic.within(&fields.gap);
            let w: Vec<f64> = (0..f.len()).map(|i| g[i] - f[i] - from.correction[i] + shift).collect();
            let w = self.elastic.spread(&w, 0.0);
            let elastic = &self.elastic;
            sums::update(
                &mut fields.displacement,
                |i, before| if elastic.is_inside(i) { w[i] } else { before + moved },
            );
        } else {
            let gap = &fields.gap;
            sums::update(&mut fields.displacement, |i, _| gap[i] - f[i] + shift);
        }
        Some((fields, shift))
    }

    /// The state of fields that have been found.
    fn state(
        &mut self,
        (fields, correction, shift): (Fields, Arc<Vec<f64>>, f64),
        displaced: Option<Vec<f64>>,
        (aim, hold): (Aim, Hold),
        (ended, iterations, outer): (Ended, usize, usize),
    ) -> State {
        let (f, gap) = (self.surface.gaps(), self.elastic.within(&fields.gap));
        let net = self.net(&gap, &self.elastic.within(&fields.pressure));
        let tau = |i: usize| self.tension.at(gap[i]);
        let (half, area) = (HALF * self.tension.strength(), self.grid().sample_area());
        let count = |x: bool| f64::from(u8::from(x));
        let of_sample = |i: usize| {
            let touches = gap[i] == 0.0;
            [net[i], tau(i), count(touches), count(!touches && tau(i) > half), self.tension.energy(gap[i])]
        };
        let [force, pull, touching, pulling, adhesive] = sums::of(gap.len(), of_sample).map(|sum| sum * area);
        // By a fresh convolution of the pressure, without D on a periodic cell.
        let displaced = displaced.unwrap_or_else(|| {
            let mut displaced = net.clone();
            self.elastic.displace(&mut displaced, self.elastic.mean_compliance());
            displaced
        });
        let penetration = match aim {
            Aim::Grip { position, stiffness } => position - force / stiffness,
            Aim::Force(_) => sums::of(gap.len(), |i| [displaced[i] + f[i] - gap[i]])[0] / gap.len() as f64,
        };
        let [stored] = sums::of(gap.len(), |i| [0.5 * net[i] * (gap[i] - f[i] + penetration)]);
        let numbers = Numbers {
            force,
            penetration,
            contact_load: force + pull,
            adhesive_load: pull,
            contact_area: touching,
            cohesive_area: pulling,
            energy: stored * area + adhesive,
        };
        let certificate = self.certificate(&gap, &net, &displaced, penetration, aim);
        let stop = match ended.stop {
            Stop::Converged if touching == 0.0 && pull <= self.nothing() => Stop::NoContact,
            Stop::Converged if self.reaches_border(&gap) => Stop::AtBorder,
            stop => stop,
        };
        let report = Report { stop, route: Route::Direct, iterations, outer, residual: ended.residual };
        State { fields: Arc::new(fields), correction, shift, numbers, report, certificate, hold }
    }

    /// A tension that is none, a force.
    fn nothing(&self) -> f64 {
        NO_FORCE * self.tension.strength() * self.grid().sample_area() * self.surface.gaps().len() as f64
    }

    /// Net pressure in the window: −τ where the gap is open.
    fn net(&self, gap: &[f64], pressure: &[f64]) -> Vec<f64> {
        let strength = self.tension.strength();
        let mut net = pressure.to_vec();
        sums::update(&mut net, |i, p| if gap[i] > 0.0 { -self.tension.at(gap[i]) } else { p.max(-strength) });
        net
    }

    /// Bounds from a fresh displacement: the gap in energy of the problem with its tension as it is, the deepest penetration and the deviation of
    /// the load.
    fn certificate(&self, gap: &[f64], net: &[f64], displaced: &[f64], penetration: f64, aim: Aim) -> Certificate {
        let f = self.surface.gaps();
        let fresh = |i: usize| displaced[i] + f[i] - penetration;
        let least = sums::least(gap.len(), fresh).min(0.0);
        let strength = self.tension.strength();
        let of_sample = |i: usize| {
            let contact = if gap[i] == 0.0 { net[i] + strength } else { 0.0 };
            [contact * (fresh(i) - least), 0.5 * net[i] * displaced[i], net[i], self.tension.at(gap[i])]
        };
        let [excess, stored, sum, pull] = sums::of(gap.len(), of_sample);
        let scale = -sums::least(gap.len(), |i| -displaced[i].abs());
        let outside = sums::least(gap.len(), |i| if gap[i] == 0.0 { 0.0 } else { fresh(i) }).min(0.0);
        let over = |part: f64, whole: f64| if part == 0.0 { 0.0 } else { part / whole.abs() };
        let load = match aim {
            Aim::Force(force) => {
                // Without a force the contact bears what the tension pulls.
                let area = self.grid().sample_area();
                over((sum * area - force).abs(), force.abs().max(pull * area))
            }
            Aim::Grip { .. } => 0.0,
        };
        Certificate { energy_gap: over(excess, stored), penetration: over(-outside, scale), load }
    }

    /// Whether surfaces pull at the border of the window of an isolated contact as only contact or a tension without an end may: by
    /// [`AT_BORDER`] of the strength.
    fn reaches_border(&self, gap: &[f64]) -> bool {
        let [n1, n2] = self.grid().points();
        let is_border = |i: usize| i < n2 || i >= (n1 - 1) * n2 || i.is_multiple_of(n2) || i % n2 == n2 - 1;
        let pulls = |i: usize| self.tension.at(gap[i]) > AT_BORDER * self.tension.strength();
        self.elastic.is_isolated() && (0..gap.len()).any(|i| is_border(i) && pulls(i))
    }

    /// 1 − κ of a state; `None` of surfaces that are apart.
    pub fn stability(&mut self, state: &State) -> Option<f64> {
        let solved = state.report.stop == Stop::Converged || state.report.stop == Stop::AtBorder;
        solved.then(|| 1.0 - softening_over_stiffness(&mut self.elastic, &self.tension, state.hold, &state.fields))
    }

    /// A state as a load step.
    pub fn step(&self, state: &State, load: Load, convolutions: f64) -> Step {
        let Numbers { penetration, .. } = state.numbers;
        let gap = self.elastic.within(&state.fields.gap);
        let net = self.net(&gap, &self.elastic.within(&state.fields.pressure));
        let tension: Vec<f64> = gap.iter().map(|g| self.tension.at(*g)).collect();
        let touching = |i: usize| if gap[i] == 0.0 { (net[i] + tension[i]).max(0.0) } else { 0.0 };
        let pressure: Vec<f64> = (0..gap.len()).map(touching).collect();
        let contact = Contact::new(&self.problem, &self.surface, Arc::new(pressure), Arc::new(gap), penetration);
        let State { report, certificate, .. } = *state;
        let (finest, coarser) = (contact.with_tension(tension), Vec::new());
        Step { load, report, certificate, convolutions, motion: None, heat: None, finest, coarser }
    }
}
