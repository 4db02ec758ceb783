//! What is read off the stresses of a step: where coating and substrate are stressed most, and how sure that is.

use super::Reading;
use crate::counterbody::Site;
use crate::spectral::Step;
use crate::stress::maxima::Extremes;
use crate::stress::{Peak, StressField};
use std::f64::consts::PI;

/// Largest stresses of a step, see [`crate::stress::maxima`].
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct StressReading {
    /// Largest principal shear stress of all.
    pub max_tau1: Peak,
    /// Largest tension of all.
    pub max_tension: Peak,
    /// Over each material, from the surface down.
    pub materials: Vec<Extremes>,
    /// On each face: the surface, then both sides of each interface.
    pub faces: Vec<Extremes>,
    /// Estimated relative error of the largest tension on the surface, see [`crate::stress::Crest::error`].
    pub surface_error: f64,
    /// Estimated discretisation errors of the largest of all, see [`Maxima::errors`](crate::stress::maxima::Maxima::errors).
    pub errors: StressErrors,
}

/// Estimated errors of the largest stresses, pressures; `None` where there is no coarser grid or no number.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct StressErrors {
    /// Of the largest principal shear stress.
    pub max_tau1: Option<f64>,
    /// Of the largest tension.
    pub max_tension: Option<f64>,
}

impl StressReading {
    /// The largest stresses of `field`, the stress field of a step that has contact and whose `reading` is known.
    pub fn of(step: &Step, reading: &Reading, field: &StressField) -> Self {
        let radii = contact_radii(step, reading);
        let under = |contact| StressField::new(contact, field.mean_stress()).maxima(radii);
        let coarser = step.coarser().first().map(under);
        let maxima = field.maxima(radii);
        let coarser = coarser.as_ref();
        let errors = coarser.map(|coarser| maxima.errors(coarser));
        // A tip is infinitely stressed, whatever a grid shows of it.
        let tip = tips(step, reading).next().map(|site| step.grid().cell().point(site.place));
        let mut stress = Self {
            max_tau1: maxima.tau1(),
            max_tension: maxima.tension(),
            surface_error: maxima.surface_error(coarser),
            errors: StressErrors {
                max_tau1: errors.map(|errors| errors[0]).filter(|_| tip.is_none()),
                max_tension: errors.map(|errors| errors[1]),
            },
            materials: maxima.materials,
            faces: maxima.faces,
        };
        if let Some([x, y]) = tip {
            let first = [&mut stress.materials, &mut stress.faces].map(|all| all.first_mut());
            let first = first.into_iter().flatten().map(|extremes| &mut extremes.tau1);
            for tau1 in first.chain([&mut stress.max_tau1]) {
                *tau1 = Peak { value: f64::INFINITY, position: [x, y, 0.0], material: 1, direction: tau1.direction };
            }
        }
        stress
    }
}

/// Where τ₁ is infinite: at the tips in contact, unless the surface material is incompressible, as σ_z and σ_r are then
/// infinite alike.
pub fn tips<'a>(step: &'a Step, reading: &'a Reading) -> impl Iterator<Item = &'a Site> {
    let sites = step.surface().sites().iter().filter(|site| reading.levels[site.level - 1].singular);
    sites.filter(|_| step.problem().half_space().surface_material().poisson() < 0.5)
}

/// Smallest and largest contact radius of a step; where contacts have no radius, that of a disc of the whole contact's
/// area. The smallest is taken to have four samples at least.
fn contact_radii(step: &Step, reading: &Reading) -> [f64; 2] {
    let grid = step.grid();
    let whole = (reading.contact_fraction * grid.cell().area() / PI).sqrt();
    let touching = reading.levels.iter().filter(|level| level.load > 0.0);
    let radii: Vec<f64> = touching.filter_map(|level| level.contact_radius).collect();
    let least = radii.iter().copied().fold(whole, f64::min).max(4.0 * grid.spacing());
    let most = if radii.is_empty() { whole } else { radii.iter().copied().fold(0.0, f64::max) };
    [least, most.max(least)]
}
