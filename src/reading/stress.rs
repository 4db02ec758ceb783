//! The largest stresses of coating and substrate in a step, with their errors.

use super::Reading;
use crate::counterbody::Site;
use crate::friction::Friction;
use crate::numeric::serialised;
use crate::spectral::Step;
use crate::stress::maxima::{Carried, Extremes, Maxima};
use crate::stress::{Peak, StressField};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Largest stresses of a step, residual stresses among them, see [`crate::stress::maxima`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StressReading {
    /// Over all materials.
    #[serde(flatten)]
    pub overall: Extremes,
    /// Over each material, from the surface down.
    pub materials: Vec<Extremes>,
    /// On each face: the surface, then both sides of each interface.
    pub faces: Vec<Extremes>,
    /// Largest stresses that each interface carries, from the surface down.
    pub interfaces: Vec<Carried>,
    /// Estimated relative error of the largest tension on the surface, see [`crate::stress::Crest::error`]; infinite where
    /// the samples do not show it.
    #[serde(deserialize_with = "serialised::infinite")]
    pub surface_error: f64,
}

impl StressReading {
    /// The largest stresses of `field`, the stress field of a step that has contact and whose `reading` is known.
    pub fn of(step: &Step, reading: &Reading, field: &StressField) -> Self {
        Self::of_while(step, reading, field, &|| true).expect("a search that nothing interrupts ends")
    }

    /// Stress reading of a step; `None` when `goes_on`, called many times a second during the search, returns false.
    pub fn of_while(step: &Step, reading: &Reading, field: &StressField, goes_on: &dyn Fn() -> bool) -> Option<Self> {
        let radii = contact_radii(step, reading);
        let coarser = step.coarser().first().map(|contact| field.of_other(contact));
        let maxima = field.maxima_while(radii, goes_on)?;
        let maxima = match &coarser {
            Some(coarser) => maxima.with_errors_while(coarser, goes_on)?,
            None => maxima,
        };
        let surface_error = maxima.surface_error();
        let Maxima { mut materials, mut faces, mut interfaces, .. } = maxima;
        for peak in peaks(&mut materials, &mut faces, &mut interfaces) {
            peak.position = beside_site(step, peak.position);
            peak.rival.iter_mut().for_each(|rival| rival.position = beside_site(step, rival.position));
        }
        // A tip is infinitely stressed, whatever a grid shows of it.
        if let Some(tip) = tips(step, reading).next() {
            let [x, y] = step.grid().cell().point(tip.place);
            let first = [&mut materials, &mut faces].map(|all| all.first_mut());
            let is_torn = tears(step);
            for Extremes { tau1, mises, tension } in first.into_iter().flatten() {
                for peak in [Some(tau1), Some(mises), Some(tension).filter(|_| is_torn)].into_iter().flatten() {
                    *peak = Peak {
                        value: f64::INFINITY,
                        position: [x, y, 0.0],
                        material: step.problem().half_space().material_id(1),
                        error: None,
                        rival: None,
                        ..*peak
                    };
                }
            }
        }
        Some(Self { overall: overall(&materials), materials, faces, interfaces, surface_error })
    }
}

/// Every place of a largest stress.
fn peaks<'a>(
    materials: &'a mut [Extremes],
    faces: &'a mut [Extremes],
    interfaces: &'a mut [Carried],
) -> impl Iterator<Item = &'a mut Peak> {
    let extremes = materials.iter_mut().chain(faces);
    let extremes = extremes.flat_map(|Extremes { tau1, tension, mises }| [tau1, tension, mises]);
    let interfaces = interfaces.iter_mut().flat_map(|carried| {
        let Carried { normal, shear, delamination, .. } = carried;
        [Some(normal), Some(shear), delamination.as_mut()].into_iter().flatten()
    });
    extremes.chain(interfaces)
}

/// The extremes over all of some materials.
fn overall(materials: &[Extremes]) -> Extremes {
    let largest = |peak: fn(&Extremes) -> Peak| {
        let peaks: Vec<Peak> = materials.iter().map(peak).collect();
        Peak::highest(&peaks, 0.0).expect("there is always a substrate")
    };
    Extremes { tau1: largest(|own| own.tau1), tension: largest(|own| own.tension), mises: largest(|own| own.mises) }
}

/// Where τ₁ is infinite: at the tips in contact, unless the surface material is incompressible, as σ_z and σ_r are then
/// infinite alike; then the traction of a counterbody that slides still is.
pub fn tips<'a>(step: &'a Step, reading: &'a Reading) -> impl Iterator<Item = &'a Site> {
    let sites = step.surface().sites().iter().filter(|site| reading.levels[site.level - 1].singular());
    let slides = friction(step) > 0.0;
    sites.filter(move |_| slides || step.problem().half_space().surface_material().poisson() < 0.5)
}

/// Whether tension is infinite at a tip in contact: near it σ_z = −p, σ_x = −(½ + ν)p and τ = μp, so that there is tension
/// from μ² > ½ + ν on.
pub fn tears(step: &Step) -> bool {
    let (nu, mu) = (step.problem().half_space().surface_material().poisson(), friction(step));
    mu * mu > 0.5 + nu
}

/// μ, 0 without friction.
fn friction(step: &Step) -> f64 {
    step.problem().friction().map_or(0.0, Friction::coefficient)
}

/// The image of a position nearest to an indenter of the first cell: behind an indenter x is less than at its axis, not a period
/// more.
fn beside_site(step: &Step, [x, y, z]: [f64; 3]) -> [f64; 3] {
    let cell = step.grid().cell();
    let ([s, t], reduced) = (cell.fractions([x, y]), cell.reduced());
    let near = step.surface().sites().iter().map(|site| {
        let [u, v] = reduced.nearest([s - site.place[0], t - site.place[1]]);
        (cell.point(site.place), [u, v], u.hypot(v))
    });
    // Of indenters that are as near, to rounding, the first one.
    let nearest = near.reduce(|best, next| if next.2 < best.2 * (1.0 - 1e-9) { next } else { best });
    nearest.map_or([x, y, z], |(site, [u, v], _)| [site[0] + u, site[1] + v, z])
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
