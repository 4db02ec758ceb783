//! Friction by hysteresis of a load step, below a load that moves steadily over a body that relaxes.

use crate::body::{Material, MaterialId};
use crate::numeric::serialised;
use crate::quantity::quantities;
use crate::spectral::{Hysteresis, MotionLoss, Step};
use crate::stress::losses;
use serde::{Deserialize, Serialize};

/// Weight of the difference of both coefficients on the finest grid in the error: it is that of the grid within a factor 3.
const DIFFERENCE: f64 = 3.0;
/// Weights of the changes from the next two coarser grids, at second order.
const CHANGES: [f64; 2] = [0.5, 0.25];
/// Part of the coefficient that one sample along the radius of a contact misses where the way of a relaxation is short beside the spacing: both
/// coefficients fall short together there, at the first order, by up to 0.4 over the samples of a radius (study `moving`): half a sample at the edge.
const SHORTFALL: f64 = 0.5;

quantities! {
    /// Friction by hysteresis of a load step.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
    pub struct HysteresisReading {
        /// Coefficient of friction by hysteresis, by the shape that is pushed: the force against the motion over the normal one.
        #[serde(deserialize_with = "serialised::number")]
        pub friction_coefficient: f64 = Ratio "friction by hysteresis" "μ_h" error error,
        /// Error of the coefficient: by the difference of both coefficients, the changes from the coarser grids, what samples miss in slow motion, and the
        /// bound of the solution.
        pub error: Option<f64>,
        /// Coefficient of friction by the energy that is lost.
        #[serde(deserialize_with = "serialised::number")]
        pub by_energy: f64 = Ratio "friction by lost energy" "μ_E",
        /// Bound on the part of the error that the iteration leaves.
        #[serde(deserialize_with = "serialised::number")]
        pub bound: f64,
        /// Force against the motion, by hysteresis: the energy that is lost per length of way, of one cell.
        #[serde(deserialize_with = "serialised::number")]
        pub force: f64 = Force "hysteresis force" "F_h" error force_error,
        /// Error of the force.
        pub force_error: Option<f64>,
        /// Dissipated power, the force times the velocity, of one cell.
        #[serde(deserialize_with = "serialised::number")]
        pub power: f64,
        /// Distance of the middle of the pressure ahead of that of the contact area, over the contact radius; `None` where several indenters touch.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub lean: Option<f64> = Ratio "lean of the pressure" "e/a",
        /// Largest ratio of lost to stored work among the waves of the grid, tan δ.
        #[serde(deserialize_with = "serialised::number")]
        pub loss_tangent: f64,
        /// Part of the lost energy in each material that relaxes.
        pub materials: Vec<MaterialLoss>,
    }
    table HysteresisQuantities as HYSTERESIS;
}

/// Energy that a material loses.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct MaterialLoss {
    /// The material.
    #[serde(flatten)]
    pub material: MaterialId,
    /// Part of all lost energy.
    pub share: f64,
    /// Dissipated power, of one cell.
    pub power: f64,
}

impl HysteresisReading {
    /// Reading of a step; `None` at rest, and without contact.
    pub fn of(step: &Step) -> Option<Self> {
        if !step.problem().half_space().relaxes() {
            return None;
        }
        let MotionLoss { grids, bound, loss_tangent } = step.motion.as_ref()?;
        let (problem, grid) = (step.problem(), step.grid());
        let Hysteresis { by_shape, by_energy } = *grids.first()?;
        let change = |(coarser, weight): (&Hysteresis, f64)| weight * (coarser.by_shape - by_shape).abs();
        let changes = grids.iter().skip(1).zip(CHANGES).map(change).reduce(f64::max);
        let on_grid = (DIFFERENCE * (by_shape - by_energy).abs()).max(shortfall(step) * by_shape.abs());
        let error = changes.map(|change| change.max(on_grid) + bound);
        let load = step.pressure().sum() * grid.sample_area();
        let velocity = problem.motion()?.velocity();
        let power = by_shape * load * velocity;
        let body = problem.half_space();
        let shares = losses(step.finest());
        let loss = |(number, share)| MaterialLoss { material: body.material_id(number), share, power: share * power };
        Some(Self {
            friction_coefficient: by_shape,
            error,
            by_energy,
            bound: *bound,
            force: by_shape * load,
            force_error: error.map(|error| error * load),
            power,
            lean: lean(step),
            loss_tangent: *loss_tangent,
            materials: shares.into_iter().map(loss).collect(),
        })
    }
}

/// Part of the coefficient that the samples may miss: over those along the radius of a spot, less where the way in the longest relaxation of the
/// body is long beside their spacing.
fn shortfall(step: &Step) -> f64 {
    let problem = step.problem();
    let touching = step.finest().pressures().iter().filter(|p| **p > 0.0).count() as f64;
    let spots = step.finest().spots(None).sizes.len().max(1) as f64;
    let samples = (touching / (std::f64::consts::PI * spots)).sqrt().max(1.0);
    let longest = |material: Material| {
        let relaxation = material.relaxation()?;
        let ratio = 1.0 + relaxation.instantaneous() / material.shear();
        relaxation.terms().iter().map(|term| ratio * term.time).reduce(f64::max)
    };
    let time = problem.half_space().materials().filter_map(longest).fold(0.0, f64::max);
    let speed = problem.motion().map_or(0.0, |motion| motion.velocity());
    SHORTFALL / samples / (1.0 + speed * time / step.grid().spacing())
}

/// Distance of the middle of the pressure ahead of that of the samples in contact, over √(A/π), of a single indenter.
fn lean(step: &Step) -> Option<f64> {
    let (surface, grid) = (step.surface(), step.grid());
    if surface.sites().len() != 1 {
        return None;
    }
    let (reduced, [ex, ey]) = (grid.cell().reduced(), step.problem().direction());
    let (mut force, mut moment, mut count, mut middle) = (0.0, 0.0, 0.0, 0.0);
    for (i, &p) in step.finest().pressures().iter().enumerate().filter(|(_, p)| **p > 0.0) {
        let [x, y] = surface.offset(&reduced, 0, i);
        let along = ex * x + ey * y;
        (force, moment, count, middle) = (force + p, moment + p * along, count + 1.0, middle + along);
    }
    let radius = (count * grid.sample_area() / std::f64::consts::PI).sqrt();
    (force > 0.0).then(|| (moment / force - middle / count) / radius)
}
