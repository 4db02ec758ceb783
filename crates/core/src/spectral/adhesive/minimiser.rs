//! The gap of least energy, by projected preconditioned conjugate gradients.
//!
//! Unknown is the gap g ≥ 0 on the samples, with w = g − f + δ and the net pressure p = K w, K = C⁻¹:
//!
//! E(g) = ½⟨w, K w⟩ + Σ φ(g) (+ p̄ Σ g under a load),  r = p + τ(g),
//!
//! r = 0 where g > 0 and r ≥ 0 where g = 0, where r is the pressure of contact. As Polonsky & Keer's method with pressure and gap exchanged:
//! C is the preconditioner, on the samples F that are open or want to be, and −dτ/dg lessens the curvature along a direction, down to a quarter
//! of the elastic one. Because τ falls, E is not convex: what is found is a stationary state near that of the start.
//!
//! A body without mean compliance in a stiff machine holds the mean gap: r and the preconditioned residual lose their means on F, and a step
//! that was clipped is scaled back.

use super::elastic::{Elastic, Hold};
use super::tension::Tension;
use crate::numeric::sums;
use crate::spectral::iteration::{Progress, Stop};
use std::ops::ControlFlow;

/// Least part of the elastic curvature along a direction that is left beside the softening of the tension.
const LEAST_CURVATURE: f64 = 0.25;
/// Steps without softening after one that has raised the energy.
const CAREFUL_STEPS: usize = 3;
/// Rise of the energy, over its parts, that rounding makes.
const ROUNDING: f64 = 1e-13;
/// Part of σ₀ on all samples that is no force.
pub(super) const NO_FORCE: f64 = 1e-9;
/// Iterations between two pressures found afresh.
const REFRESH_INTERVAL: usize = 50;

/// Fields of a state on the torus, one value per sample.
#[derive(Debug, Clone)]
pub(super) struct Fields {
    /// Gap g ≥ 0 in the window, lengths; outside the displacement.
    pub gap: Vec<f64>,
    /// Displacement w, lengths.
    pub displacement: Vec<f64>,
    /// Net pressure p; under [`Hold::Mean`] the solution adds its mean at its end.
    pub pressure: Vec<f64>,
}

/// How a minimisation has ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Ended {
    pub stop: Stop,
    pub iterations: usize,
    /// Σ|r| on F over the forces.
    pub residual: f64,
}

/// Elastic bodies under tension, held in one way.
pub(super) struct Minimiser<'a> {
    pub elastic: &'a mut Elastic,
    pub tension: &'a Tension,
    pub hold: Hold,
    pub tolerance: f64,
    pub max_iterations: usize,
    pub progress: &'a mut (dyn FnMut(Progress) -> ControlFlow<()> + Send),
}

/// Working fields.
struct Working {
    residual: Vec<f64>,
    previous: Vec<f64>,
    direction: Vec<f64>,
    image: Vec<f64>,
}

/// Residual of a state, with the size of F and whether the surfaces have come apart.
struct Look {
    /// Samples of F.
    free: f64,
    /// Σ|r| on F over the forces.
    residual: f64,
    /// Whether nothing touches and the tension that is left does not bear the load.
    is_detached: bool,
}

impl Minimiser<'_> {
    /// Minimises from and into `fields`, whose pressure is that of its displacement.
    pub fn solve(&mut self, fields: &mut Fields) -> Ended {
        let len = self.elastic.len();
        let zero = || vec![0.0; len];
        let mut working = Working { residual: zero(), previous: zero(), direction: zero(), image: zero() };
        let (mut before, mut free_before, mut energy_before, mut careful) = (0.0, 0.0, f64::INFINITY, 0usize);
        let mut since_fresh = 0;
        for iterations in 0.. {
            let mut look = self.look(fields, &mut working.residual);
            if look.residual < self.tolerance && since_fresh > 0 || since_fresh >= REFRESH_INTERVAL {
                self.refresh(fields);
                since_fresh = 0;
                look = self.look(fields, &mut working.residual);
            }
            let ended = |stop| Ended { stop, iterations, residual: look.residual };
            let progress = Progress { iteration: iterations, residual: look.residual };
            let stop = match () {
                () if look.is_detached => Some(Stop::Detached),
                () if look.residual < self.tolerance => Some(Stop::Converged),
                () if !look.residual.is_finite() => Some(Stop::NotANumber),
                () if iterations >= self.max_iterations => Some(Stop::IterationLimit),
                () if (self.progress)(progress).is_break() => Some(Stop::Interrupted),
                () => None,
            };
            if let Some(stop) = stop {
                self.add_mean(fields);
                return ended(stop);
            }
            let joined = look.free > free_before;
            free_before = look.free;
            before = self.turn(&mut working, if joined { 0.0 } else { before });
            let length = self.length(fields, &mut working, careful > 0);
            careful = careful.saturating_sub(1);
            self.advance(fields, &mut working, length);
            since_fresh += 1;
            let [energy, parts] = self.energy(fields);
            if energy > energy_before + ROUNDING * parts {
                careful = CAREFUL_STEPS;
            }
            energy_before = energy;
        }
        unreachable!("the loop returns")
    }

    /// Residual r on F, zero elsewhere.
    fn look(&self, fields: &Fields, residual: &mut [f64]) -> Look {
        let Fields { gap, pressure, .. } = fields;
        let (tension, elastic) = (self.tension, &*self.elastic);
        let tau = |i: usize| if elastic.is_inside(i) { tension.at(gap[i]) } else { 0.0 };
        let multiplier = self.multiplier(fields);
        sums::update(residual, |i, _| {
            let r = pressure[i] + tau(i) + multiplier;
            if !elastic.is_inside(i) || gap[i] > 0.0 || r < 0.0 { r } else { 0.0 }
        });
        let of_sample = |i: usize| {
            let (r, is_inside) = (residual[i], elastic.is_inside(i));
            let is_free = !is_inside || gap[i] > 0.0 || r != 0.0;
            let touches = is_inside && gap[i] == 0.0;
            let count = |x: bool| f64::from(u8::from(x));
            [count(is_free), r.abs(), r, tau(i), (pressure[i] + multiplier).abs(), count(touches)]
        };
        let [free, size, sum, pull, press, touching] = sums::of(gap.len(), of_sample);
        let mut look = size;
        if self.hold == Hold::Mean && free > 0.0 {
            // The multiplier is that of the open samples; those that open now shift it.
            let mean = sum / free;
            sums::update(
                residual,
                |i, r| {
                    if !elastic.is_inside(i) || gap[i] > 0.0 || r != 0.0 { r - mean } else { 0.0 }
                },
            );
            [look] = sums::of(gap.len(), |i| [residual[i].abs()]);
        }
        let forces = pull.max(0.5 * press).max(NO_FORCE * self.tension.strength() * gap.len() as f64);
        let given = if let Hold::Load(mean) = self.hold { mean * gap.len() as f64 } else { 0.0 };
        Look { free, residual: look / forces, is_detached: touching == 0.0 && pull < -given }
    }

    /// Mean pressure where the mean displacement is held: that with which the open samples bear none; 0 otherwise.
    fn multiplier(&self, fields: &Fields) -> f64 {
        if self.hold != Hold::Mean {
            return 0.0;
        }
        let Fields { gap, pressure, .. } = fields;
        let r = |i: usize| pressure[i] + self.tension.at(gap[i]);
        let [open, sum] = sums::of(gap.len(), |i| if gap[i] > 0.0 { [1.0, r(i)] } else { [0.0; 2] });
        // Complete contact bears as little as keeps it closed.
        if open > 0.0 { -sum / open } else { -sums::least(gap.len(), r) }
    }

    /// Gives the pressure its mean where that was left out.
    fn add_mean(&self, fields: &mut Fields) {
        let multiplier = self.multiplier(fields);
        if multiplier != 0.0 {
            sums::update(&mut fields.pressure, |_, p| p + multiplier);
        }
    }

    /// The pressure of the displacement, found afresh.
    pub fn refresh(&mut self, fields: &mut Fields) {
        fields.pressure.copy_from_slice(&fields.displacement);
        self.stiffen(&mut fields.pressure);
        if let Hold::Load(mean) = self.hold {
            sums::update(&mut fields.pressure, |_, p| p + mean);
        }
    }

    /// K of a change of the displacement, in place.
    fn stiffen(&mut self, field: &mut [f64]) {
        let compliance = match self.hold {
            Hold::Spring(compliance) => Some(compliance),
            Hold::Mean | Hold::Load(_) => None,
        };
        self.elastic.press(field, compliance);
    }

    /// The next direction, of which F is where the residual is not zero; returns ⟨z, r⟩.
    fn turn(&mut self, working: &mut Working, before: f64) -> f64 {
        let Working { residual, previous, direction, image } = working;
        image.copy_from_slice(residual);
        let mean = match self.hold {
            Hold::Spring(compliance) => compliance,
            Hold::Mean | Hold::Load(_) => self.elastic.unit(),
        };
        self.elastic.displace(image, mean);
        sums::update(image, |i, z| if residual[i] != 0.0 { z } else { 0.0 });
        self.centre(image, residual);
        let [now, crossed] =
            sums::of(image.len(), |i| [image[i] * residual[i], image[i] * (residual[i] - previous[i])]);
        let beta = if before > 0.0 { (crossed / before).max(0.0) } else { 0.0 };
        sums::update(direction, |i, d| if residual[i] != 0.0 { image[i] + beta * d } else { 0.0 });
        // Samples that have left F took their part of the mean with them.
        self.centre(direction, residual);
        let [descent] = sums::of(image.len(), |i| [direction[i] * residual[i]]);
        if descent <= 0.0 {
            direction.copy_from_slice(image);
        }
        previous.copy_from_slice(residual);
        now
    }

    /// Takes the mean on F off a field that is zero elsewhere, where the mean displacement is held.
    fn centre(&self, field: &mut [f64], residual: &[f64]) {
        if self.hold == Hold::Mean {
            let [sum, free] = sums::of(field.len(), |i| if residual[i] != 0.0 { [field[i], 1.0] } else { [0.0; 2] });
            sums::update(field, |i, x| if residual[i] != 0.0 { x - sum / free } else { 0.0 });
        }
    }

    /// Length of the step along the direction, whose K it leaves in `working.image`; without softening where care is due.
    fn length(&mut self, fields: &Fields, working: &mut Working, is_careful: bool) -> f64 {
        let Working { residual, direction, image, .. } = working;
        image.copy_from_slice(direction);
        self.stiffen(image);
        let (elastic, tension) = (&*self.elastic, self.tension);
        let softening = |i: usize| if elastic.is_inside(i) { tension.softening(fields.gap[i]) } else { 0.0 };
        let [descent, curvature, softened] = sums::of(image.len(), |i| {
            let d = direction[i];
            [residual[i] * d, d * image[i], if d != 0.0 { softening(i) * d * d } else { 0.0 }]
        });
        let least = if is_careful { curvature } else { LEAST_CURVATURE * curvature };
        let length = descent / (curvature - softened).max(least);
        if !matches!(self.hold, Hold::Load(_)) {
            return length;
        }
        // Under a load a uniform shift costs nothing elastic: it goes no farther than the surfaces are apart.
        let largest = |of: &(dyn Fn(usize) -> f64 + Sync)| -sums::least(fields.gap.len(), |i| -of(i).abs());
        let farthest = (largest(&|i| fields.gap[i]) + tension.reach()) / largest(&|i| direction[i]);
        if (0.0..=farthest).contains(&length) { length } else { farthest }
    }

    /// Takes a step against the direction, with what clips the gap at zero, and keeps the mean gap where that is held.
    fn advance(&mut self, fields: &mut Fields, working: &mut Working, length: f64) {
        let Working { direction, image, .. } = working;
        let Fields { gap, displacement, pressure } = fields;
        let elastic = &*self.elastic;
        sums::update(pressure, |i, p| p - length * image[i]);
        // From here on `image` holds the clipped gap less the unclipped one, lengths that are added to the step.
        let stepped = |i: usize| gap[i] - length * direction[i];
        let clip = |i: usize| if elastic.is_inside(i) { (-stepped(i)).max(0.0) } else { 0.0 };
        let [clipped, sum, all] = sums::of(gap.len(), |i| [clip(i), stepped(i) + clip(i), gap[i]]);
        let scale = if self.hold == Hold::Mean && clipped > 0.0 { all / sum } else { 1.0 };
        sums::update(image, |i, _| {
            let end = stepped(i) + clip(i);
            scale * end - stepped(i)
        });
        sums::update(displacement, |i, w| w - length * direction[i] + image[i]);
        let end: &[f64] = image;
        let d = &*direction;
        // Exactly zero where the step is clipped.
        sums::update(gap, |i, g| g - length * d[i] + end[i]);
        if clipped > 0.0 {
            self.stiffen(image);
            sums::update(pressure, |i, p| p + image[i]);
        }
    }

    /// Energy of a state over the area of a sample, and the sum of the sizes of its parts.
    fn energy(&self, fields: &Fields) -> [f64; 2] {
        let Fields { gap, displacement, pressure } = fields;
        let (elastic, tension) = (&*self.elastic, self.tension);
        // Under a load p̄ takes no part in the elastic energy, and has one of its own.
        let given = if let Hold::Load(mean) = self.hold { mean } else { 0.0 };
        let [stored, pulled, held] = sums::of(gap.len(), |i| {
            let pulled = if elastic.is_inside(i) { tension.energy(gap[i]) } else { 0.0 };
            [0.5 * displacement[i] * (pressure[i] - given), pulled, given * displacement[i]]
        });
        [stored + pulled + held, stored.abs() + pulled.abs() + held.abs()]
    }
}
