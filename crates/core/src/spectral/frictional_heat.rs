//! Frictional heat of a contact on a grid: its partition between the bodies, the temperatures of their surfaces, and their swelling.
//!
//! The flux q = μ p v enters where the surfaces touch, q₁ into the body and q − q₁ into the counterbody. With the temperatures K₁q₁ and K₂(q − q₁)
//! of the surfaces, K = 1/Z of each wave, one temperature in contact asks for
//!
//! (K₁ + K₂) q₁ = K₂ q + T₂ − T₁ in contact, q₁ = 0 elsewhere,
//!
//! with the bulk temperatures T₁, T₂: linear equations on a set of samples ([`SampleSet`]). Energy makes the real part of K positive.

use super::iteration::{Invertible, SampleSet};
use super::layered_operator::{LayeredOperator, Skew};
use super::operator::{ElasticOperator, Workspace};
use super::transforms::Transforms;
use super::wave_operator::{WaveOperator, of_component};
use crate::body::{Depth, MaterialId};
use crate::heat::HeatedBody;
use crate::heating::{HeatedBodies, Heating, Partition};
use crate::lattice::Grid;
use crate::numeric::sums;
use crate::problem::Problem;

/// Part to which the equations of the partition are solved.
const TOLERANCE: f64 = 1e-10;
/// Most restarts of their solution.
const RESTARTS: usize = 12;
/// Wavenumber by which the share of the body is estimated first, over the least one of the cell.
const FIRST_WAVE: f64 = 8.0;

/// Flux and temperatures of the surfaces of a contact.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceHeat {
    /// Flux into the body, a power per area, sample by sample, a₂ fastest.
    pub flux: Vec<f64>,
    /// Flux of friction, μ p v, a power per area.
    pub friction: Vec<f64>,
    /// Temperature of the body's surface.
    pub body: Vec<f64>,
    /// Temperature of the counterbody's surface; `None` of a rigid one.
    pub counterbody: Option<Vec<f64>>,
    /// Displacement of the gap by heat, lengths, below 0 where it closes; empty without expansion.
    pub swelling: Vec<f64>,
    /// Share of the body of all heat, from 0 to 1 unless bulk temperatures drive heat through the contact.
    pub share: f64,
    /// Steps of the linear solve of the partition; 0 where the share is given.
    pub steps: usize,
}

impl SurfaceHeat {
    /// Flux into the counterbody, a power per area: that of friction less that into the body.
    pub fn flux_above(&self) -> Vec<f64> {
        self.friction.iter().zip(&self.flux).map(|(q, body)| q - body).collect()
    }
}

/// Operators of frictional heat on a grid.
#[derive(Debug)]
pub(super) struct FrictionalHeat {
    heating: Heating,
    bodies: HeatedBodies,
    /// μ v.
    over_pressure: f64,
    temperature: WaveOperator,
    above: Option<Above>,
    swelling: WaveOperator,
    /// Samples in which heat is shared whatever touches; `None` where it is shared in contact.
    held: Option<SampleSet>,
}

/// Operators of a counterbody that takes heat.
#[derive(Debug)]
struct Above {
    temperature: WaveOperator,
    swelling: WaveOperator,
    /// K₁ + K₂.
    both: LayeredOperator,
}

/// K₁ + K₂ and its inverse.
struct Both<'a> {
    operator: &'a mut LayeredOperator,
    workspace: &'a mut Workspace,
}

impl Invertible for Both<'_> {
    fn apply(&mut self, field: &mut [f64]) {
        self.operator.displace(field, self.workspace);
    }

    fn invert(&mut self, field: &mut [f64]) {
        self.operator.pressure(field, self.workspace);
    }
}

impl FrictionalHeat {
    /// Operators of a problem on a grid; `None` where nothing heats.
    pub fn new(problem: &Problem, grid: &Grid) -> Option<Self> {
        let heating = *problem.heating()?;
        let bodies = problem.heated_bodies().ok()?;
        let of_body = |k| bodies.body.surface_temperature(bodies.turned(k));
        let above = bodies.counterbody.as_ref().map(|above| {
            let of_above = |k| above.surface_temperature(bodies.turned(k));
            let both = |k| of_body(k) + of_above(k);
            let transforms = Transforms::new(grid.points());
            let least = grid.least_wavenumber();
            let (multiplier, skew) = transforms.double.complex_multiplier(|[k1, k2], values| {
                values.iter_mut().zip(k2..).for_each(|(value, k2)| {
                    let is_mean = [k1, k2] == [0, 0];
                    *value =
                        if is_mean { both([least, 0.0]).norm().into() } else { of_component(grid, [k1, k2], &both) };
                });
            });
            let largest = skew.largest();
            let both =
                LayeredOperator::of(transforms, multiplier.dropping_mean(), 1.0).coupled(Skew::Ratio(skew), largest);
            Above {
                temperature: WaveOperator::new(grid, of_above),
                swelling: WaveOperator::new(grid, |k| above.swelling(bodies.turned(k))),
                both,
            }
        });
        Some(Self {
            heating,
            over_pressure: problem.heat_over_pressure(),
            temperature: WaveOperator::new(grid, of_body),
            swelling: WaveOperator::new(grid, |k| bodies.body.swelling(bodies.turned(k))),
            above,
            bodies,
            held: None,
        })
    }

    /// Holds the samples in which heat is shared at those that touch under a pressure, or shares it in contact again.
    ///
    /// A sample at the edge that touches in one turn and not in the next has swelling follow pressure without end: it is within the error of
    /// the grid.
    pub fn hold(&mut self, pressure: Option<&[f64]>) {
        self.held = pressure.map(touching);
    }

    /// Flux and temperatures under a pressure, sample by sample.
    pub fn under(&mut self, pressure: &[f64]) -> SurfaceHeat {
        let workspace = &mut Workspace::default();
        let friction: Vec<f64> = pressure.iter().map(|p| self.over_pressure * p).collect();
        let (flux, steps) = self.flux_below(pressure, &friction, workspace);
        let [whole, body] = sums::of(flux.len(), |i| [friction[i], flux[i]]);
        let [below, above] = self.heating.bulk();
        let mut temperature = self.temperature.of(&flux, workspace);
        sums::update(&mut temperature, |_, t| t + below);
        let share = if whole > 0.0 { body / whole } else { 1.0 };
        let (counterbody, swelling) = (None, Vec::new());
        let mut heat = SurfaceHeat { flux, friction, body: temperature, counterbody, swelling, share, steps };
        heat.counterbody = self.above.as_ref().map(|operators| {
            let mut temperature = operators.temperature.of(&heat.flux_above(), workspace);
            sums::update(&mut temperature, |_, t| t + above);
            temperature
        });
        if self.heating.expands() {
            heat.swelling = self.swelling_by(&heat);
        }
        heat
    }

    /// Flux into the body, and the steps of its linear solve.
    fn flux_below(&mut self, pressure: &[f64], friction: &[f64], workspace: &mut Workspace) -> (Vec<f64>, usize) {
        let Some(above) = &mut self.above else { return (friction.to_vec(), 0) };
        if let Partition::Share(share) = self.heating.partition() {
            return (friction.iter().map(|q| share * q).collect(), 0);
        }
        let set = self.held.clone().unwrap_or_else(|| touching(pressure));
        if set.len() == 0 {
            return (friction.to_vec(), 0);
        }
        let [below, bulk_above] = self.heating.bulk();
        let mut right = above.temperature.of(friction, workspace);
        sums::update(&mut right, |_, t| t + bulk_above - below);
        let mut flux = vec![0.0; friction.len()];
        let (mut residual, mut steps) = (set.gathered(&right), 0);
        let first = residual.iter().map(|r| r * r).sum::<f64>().sqrt();
        for _ in 0..RESTARTS {
            let size = residual.iter().map(|r| r * r).sum::<f64>().sqrt();
            if size <= TOLERANCE * first {
                break;
            }
            let part = (TOLERANCE * first / size).max(1e-6);
            let found = set.solve_freely(residual, part, &mut Both { operator: &mut above.both, workspace });
            steps += found.steps;
            set.samples().zip(&found.change).for_each(|(i, change)| flux[i] += change);
            let mut warmed = flux.clone();
            above.both.displace(&mut warmed, workspace);
            residual = set.samples().map(|i| right[i] - warmed[i]).collect();
        }
        (flux, steps)
    }

    /// Displacement of the gap by all of a heat, lengths sample by sample.
    fn swelling_by(&self, heat: &SurfaceHeat) -> Vec<f64> {
        let workspace = &mut Workspace::default();
        let mut displaced = self.swelling.of(&heat.flux, workspace);
        if let Some(above) = &self.above {
            let other = above.swelling.of(&heat.flux_above(), workspace);
            sums::update(&mut displaced, |i, w| w + other[i]);
        }
        displaced
    }

    /// Whether the share of the body differs from place to place and changes the contact.
    pub fn lifts(&self) -> bool {
        self.heating.expands() && self.above.is_some() && self.heating.partition() == Partition::Solved
    }

    /// Share of the body with which a solution begins, on a cell whose least wavenumber, 1/length, is this one.
    pub fn first_share(problem: &Problem, least: f64) -> f64 {
        match (problem.heating().map(Heating::partition), problem.heated_bodies()) {
            (Some(Partition::Share(share)), _) => share,
            (Some(Partition::Solved), Ok(bodies)) => bodies.nearest_share(FIRST_WAVE * least),
            _ => 1.0,
        }
    }

    /// Swelling of the gap, a length sample by sample, by what of a heat differs from a uniform share of the friction's: added to what the
    /// share displaces it is all of it.
    pub fn lift(&self, heat: &SurfaceHeat, share: f64) -> Vec<f64> {
        let workspace = &mut Workspace::default();
        let excess: Vec<f64> = heat.flux.iter().zip(&heat.friction).map(|(body, q)| body - share * q).collect();
        let mut lift = self.swelling.of(&excess, workspace);
        if let Some(above) = &self.above {
            let other = above.swelling.of(&excess, workspace);
            sums::update(&mut lift, |i, w| w - other[i]);
        }
        lift
    }

    /// Largest temperature of each material, of the body and then of a counterbody that takes heat: heat enters at the surface, so that it lies on
    /// the upper face.
    pub fn hottest(&self, grid: &Grid, heat: &SurfaceHeat) -> Vec<Hottest> {
        let rest = heat.flux_above();
        let [below, above] = self.heating.bulk();
        let below = (&self.bodies.body, &heat.flux, below);
        let above = self.bodies.counterbody.as_ref().map(|body| (body, &rest, above));
        let of_body = |(body, flux, bulk): (&HeatedBody, &Vec<f64>, f64)| {
            let half_space = body.half_space();
            let of = |number: usize| {
                let depth = Depth { z: half_space.faces(number).0, material: number };
                let wave = |k| body.temperature_wave(self.bodies.turned(k)).at(depth);
                let temperature = WaveOperator::new(grid, wave).of(flux, &mut Workspace::default());
                let hotter = |best: (usize, f64), (i, &t): (usize, &f64)| if t > best.1 { (i, t) } else { best };
                let (sample, value) = temperature.iter().enumerate().fold((0, f64::NEG_INFINITY), hotter);
                Hottest { material: half_space.material_id(number), z: depth.z, sample, value: value + bulk }
            };
            (1..=half_space.material_count()).map(of).collect::<Vec<_>>()
        };
        std::iter::once(below).chain(above).flat_map(of_body).collect()
    }
}

/// The samples that touch.
fn touching(pressure: &[f64]) -> SampleSet {
    SampleSet::of(pressure.len(), |i| pressure[i] > 0.0)
}

/// Largest temperature of a material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hottest {
    /// The material.
    pub material: MaterialId,
    /// Depth of its upper face, a length.
    pub z: f64,
    /// Number of the sample below which it lies.
    pub sample: usize,
    /// The temperature.
    pub value: f64,
}
