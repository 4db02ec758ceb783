//! A contact solved on one grid.

use super::frictional_heat::SurfaceHeat;
use super::iteration::{Bounds, Certificate, Unknowns};
use super::tangential::sticks;
use crate::counterbody::Surface;
use crate::kind::Datum;
use crate::lattice::Grid;
use crate::lattice::components::{Component, SpotCounts, contact_spots};
use crate::numeric::array::view;
use crate::numeric::sums;
use crate::problem::Problem;
use ndarray::ArrayView2;
use std::borrow::Cow;
use std::sync::{Arc, OnceLock};

/// Partial slip in a step, sample by sample, a₂ fastest.
#[derive(Debug, Clone, PartialEq)]
pub struct Shear {
    /// Tangential traction q_x and q_y on the body, pressures.
    pub traction: [Vec<f64>; 2],
    /// Slip of the counterbody against the body in the step, along x and y, lengths; zero where nothing touches.
    pub slip: [Vec<f64>; 2],
    /// Energy that slip has dissipated in the step, over the area: a pressure times a length.
    pub work: Vec<f64>,
    /// Coefficient of friction μ.
    pub friction: f64,
}

impl Shear {
    /// Whether a sample under a pressure sticks.
    pub fn sticks(&self, sample: usize, pressure: f64) -> bool {
        let [x, y] = &self.traction;
        sticks([x[sample], y[sample]], self.friction * pressure)
    }
}

/// Pressure and gap of a solved load step on one grid. It owns its fields and shares problem and surface, so that it
/// outlives the solver.
#[derive(Debug, Clone)]
pub struct Contact {
    problem: Arc<Problem>,
    surface: Arc<Surface>,
    pressure: Arc<Vec<f64>>,
    gap: Arc<Vec<f64>>,
    penetration: f64,
    /// Depths pressed in by earlier loads, in the gap already; `None` without any.
    indented: Option<Arc<Vec<f64>>>,
    /// Partial slip; `None` where the traction follows from the friction.
    shear: Option<Arc<Shear>>,
    /// Tension between surfaces that adhere, beside the pressure; `None` of others.
    tension: Option<Arc<Vec<f64>>>,
    /// Frictional heat; `None` where nothing heats.
    heat: Option<Arc<SurfaceHeat>>,
    /// Energy stored in bodies that creep, a pressure times a cubed length; `None` of others.
    stored: Option<f64>,
    /// Counted at the first call of [`Self::spots`].
    spots: OnceLock<SpotCounts>,
}

impl Contact {
    /// `pressure` and `gap` have one value per sample of the surface's grid, a₂ fastest.
    pub(super) fn new(
        problem: &Arc<Problem>,
        surface: &Arc<Surface>,
        pressure: Arc<Vec<f64>>,
        gap: Arc<Vec<f64>>,
        penetration: f64,
    ) -> Self {
        let (problem, surface) = (Arc::clone(problem), Arc::clone(surface));
        let (indented, shear, tension, heat, stored) = (None, None, None, None, None);
        let spots = OnceLock::new();
        Self { problem, surface, pressure, gap, penetration, indented, shear, tension, heat, stored, spots }
    }

    /// The contact after earlier loads that have pressed in these depths, lengths, one per sample.
    pub(super) fn after(self, indented: Option<Arc<Vec<f64>>>) -> Self {
        Self { indented, ..self }
    }

    /// The contact with partial slip.
    pub(super) fn with_shear(self, shear: Shear) -> Self {
        Self { shear: Some(Arc::new(shear)), ..self }
    }

    /// Partial slip on the samples; `None` where the tangential traction follows from the friction.
    pub fn shear(&self) -> Option<&Shear> {
        self.shear.as_deref()
    }

    /// The contact of surfaces that pull each other with a tension beside the pressure, one value per sample.
    pub(super) fn with_tension(self, tension: Vec<f64>) -> Self {
        Self { tension: Some(Arc::new(tension)), ..self }
    }

    /// The contact with its frictional heat.
    pub(super) fn with_heat(self, heat: SurfaceHeat) -> Self {
        Self { heat: Some(Arc::new(heat)), ..self }
    }

    /// Frictional heat, flux and temperatures of the surfaces; `None` where nothing heats.
    pub fn heat(&self) -> Option<&SurfaceHeat> {
        self.heat.as_deref()
    }

    /// The contact of bodies that creep, in which this energy is stored, a pressure times a cubed length.
    pub(super) fn creeping(self, stored: f64) -> Self {
        Self { stored: Some(stored), ..self }
    }

    /// Whether the bodies creep: what they displace depends on earlier pressures.
    pub fn creeps(&self) -> bool {
        self.stored.is_some()
    }

    /// Tension between surfaces that adhere, pressures ≥ 0 sample by sample, a₂ fastest; `None` of others.
    pub fn tensions(&self) -> Option<&[f64]> {
        self.tension.as_ref().map(|tension| &tension[..])
    }

    /// Pressure of contact less the tension sample by sample, a₂ fastest: what acts on the bodies.
    pub fn net_pressures(&self) -> Cow<'_, [f64]> {
        match &self.tension {
            None => Cow::Borrowed(&self.pressure),
            Some(tension) => self.pressure.iter().zip(&**tension).map(|(p, tension)| p - tension).collect(),
        }
    }

    /// The contact under another pressure, closed wherever that presses.
    pub(super) fn with_pressure(&self, pressure: Vec<f64>) -> Self {
        let closed = |(gap, p): (&f64, &f64)| if *p > 0.0 { 0.0 } else { *gap };
        let gap = Arc::new(self.gap.iter().zip(&pressure).map(closed).collect());
        Self { pressure: Arc::new(pressure), gap, spots: OnceLock::new(), ..self.clone() }
    }

    /// Unknowns of the iteration, with their certificate.
    pub(super) fn unknowns(&self, certificate: Certificate) -> Unknowns {
        let Self { pressure, gap, penetration, .. } = self;
        Unknowns { pressure: Arc::clone(pressure), gap: Arc::clone(gap), penetration: *penetration, certificate }
    }

    /// The problem.
    pub fn problem(&self) -> &Arc<Problem> {
        &self.problem
    }

    /// The counterbody's surface on the grid.
    pub fn surface(&self) -> &Arc<Surface> {
        &self.surface
    }

    /// The grid.
    pub fn grid(&self) -> &Arc<Grid> {
        self.surface.grid()
    }

    /// Pressure of contact p ≥ 0, in the unit of Young's modulus; axes along a₁ and a₂.
    pub fn pressure(&self) -> ArrayView2<'_, f64> {
        view(self.grid().points(), &self.pressure)
    }

    /// Gap g = w + f − δ, a length; axes along a₁ and a₂.
    pub fn gap(&self) -> ArrayView2<'_, f64> {
        view(self.grid().points(), &self.gap)
    }

    /// Hardness H of the softer surface, which the pressure does not exceed, in its unit; infinite without one, and under a given pressure.
    pub fn hardness(&self) -> f64 {
        self.problem.hardness().map_or(f64::INFINITY, |(hardness, _)| hardness)
    }

    /// Depths that the softer surface is pressed in for good by this load and those before it, lengths ≥ 0 sample by sample, a₂ fastest:
    /// −g where p = H, added up over the loads. `None` without hardness, and under a given pressure.
    pub fn indentation(&self) -> Option<Vec<f64>> {
        let bounds = Bounds::up_to(self.hardness());
        bounds.is_finite().then(|| {
            let before = |i: usize| self.indented.as_ref().map_or(0.0, |depths| depths[i]);
            (0..self.gap.len()).map(|i| before(i) + bounds.indentation(self.pressure[i], self.gap[i])).collect()
        })
    }

    /// Penetration δ, from the mean plane of the deformed surface to the highest apex, a length: the additional
    /// displacement w_a. On a rigid base it counts from that base and has the mean compression of the layers in it. Under a
    /// given pressure it is the largest deflection of the samples.
    pub fn penetration(&self) -> f64 {
        self.penetration
    }

    /// Elastic energy ½∫ p w d²x of one cell, a pressure times a cubed length.
    ///
    /// The energy is the work ∫ P dδ of the force P on the cell along the load path: w has zero mean and δ is measured from the mean
    /// plane, or both from a rigid base, and of E(p) = ½⟨p, Cp⟩ + ⟨p, f − δ⟩ the minimum over p ≥ 0 is −½⟨p, Cp⟩, whose derivative by δ is −P. Under
    /// coupled friction it is the energy stored by the pressure, without the work of the traction. In bodies that creep it is what they store.
    pub fn elastic_energy(&self) -> f64 {
        if let Some(stored) = self.stored {
            return stored;
        }
        // A uniform pressure does work where it displaces.
        let pressure = self.net_pressures();
        let (mean, shift) = match self.problem.datum() {
            Datum::MeanPlane => (sums::mean(&pressure), 0.0),
            Datum::FarAway | Datum::Base => (0.0, self.penetration),
        };
        // w = g − f + δ; a uniform part of the pressure does no work with a displacement without mean, and would add rounding alone.
        let f = self.surface.gaps();
        // Swelling by heat stores no elastic energy.
        let swelling = self.heat.as_ref().map_or(&[][..], |heat| &heat.swelling);
        let by_heat = |i: usize| swelling.get(i).copied().unwrap_or(0.0);
        let [sum] = sums::of(f.len(), |i| [(pressure[i] - mean) * (self.gap[i] - f[i] + shift - by_heat(i))]);
        0.5 * sum * self.grid().sample_area()
    }

    /// Pressure of contact sample by sample, a₂ fastest.
    pub fn pressures(&self) -> &[f64] {
        &self.pressure
    }

    /// Gap sample by sample, a₂ fastest.
    pub fn gaps(&self) -> &[f64] {
        &self.gap
    }

    /// Counts of the contact spots; `found`: their samples, if these are known.
    pub(crate) fn spots(&self, found: Option<&[Component]>) -> &SpotCounts {
        self.spots.get_or_init(|| match found {
            Some(found) => SpotCounts::of(found, self.grid(), &self.pressure),
            None => SpotCounts::of(&self.touching(), self.grid(), &self.pressure),
        })
    }

    /// The contact spots: samples in contact whose cells share an edge or a corner; merged contacts are one.
    pub(crate) fn touching(&self) -> Vec<Component> {
        contact_spots(self.grid(), &self.pressure)
    }
}
