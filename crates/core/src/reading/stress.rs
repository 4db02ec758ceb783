//! The largest stresses of a step in coating and substrate of the body, and of the counterbody where it is elastic, with their
//! errors.

use super::Reading;
use crate::body::{HalfSpace, InterfaceId, MaterialId};
use crate::counterbody::Site;
use crate::friction::Friction;
use crate::numeric::serialised;
use crate::spectral::Step;
use crate::stress::maxima::{Carried, Extremes, Maxima};
use crate::stress::{PathPeak, Peak, StressField, StressFields};
use serde::{Deserialize, Serialize};
use std::f64::consts::{PI, SQRT_2};

/// Largest stresses of a step, residual stresses among them, see [`crate::stress::maxima`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StressReading {
    /// Over all materials.
    #[serde(flatten)]
    pub overall: Extremes,
    /// Over each material, from the surface down; those of an elastic counterbody follow those of the body.
    pub materials: Vec<Extremes>,
    /// On each face: the surface, then both sides of each interface; those of an elastic counterbody follow.
    pub faces: Vec<Extremes>,
    /// Largest stresses that each interface carries, from the surface down; those of an elastic counterbody follow.
    pub interfaces: Vec<Carried>,
    /// Estimated relative error of the largest tension on the surface, see [`crate::stress::Crest::error`]; infinite where
    /// the samples do not show it.
    #[serde(deserialize_with = "serialised::infinite")]
    pub surface_error: f64,
}

impl StressReading {
    /// The largest stresses of the `fields` of a step that has contact and whose `reading` is known.
    pub fn of(step: &Step, reading: &Reading, fields: &StressFields) -> Self {
        Self::of_while(step, reading, fields, &|| true).expect("a search that nothing interrupts ends")
    }

    /// Stress reading of a step; `None` when `goes_on`, called many times a second during the search, returns false.
    pub fn of_while(step: &Step, reading: &Reading, fields: &StressFields, goes_on: &dyn Fn() -> bool) -> Option<Self> {
        let coarser = step.coarser().first().and_then(|contact| fields.of_other(contact));
        let (mut materials, mut faces, mut interfaces, mut surface_error) = (vec![], vec![], vec![], 0.0f64);
        for field in fields.each() {
            let coarser = coarser.as_ref().map(|coarser| coarser.on(field.half_space().side()));
            let stresses = in_body(step, reading, field, coarser, goes_on)?;
            let error = stresses.surface_error();
            // A number that is none stays.
            surface_error = if error > surface_error || error.is_nan() { error } else { surface_error };
            materials.extend(stresses.materials);
            faces.extend(stresses.faces);
            interfaces.extend(stresses.interfaces);
        }
        Some(Self { overall: overall(&materials), materials, faces, interfaces, surface_error })
    }

    /// Largest stresses in a material.
    pub fn in_material(&self, material: MaterialId) -> Option<&Extremes> {
        self.materials.iter().find(|extremes| extremes.tau1.material == material)
    }

    /// Largest stresses that an interface carries.
    pub fn on_interface(&self, interface: InterfaceId) -> Option<&Carried> {
        self.interfaces.iter().find(|carried| carried.interface == interface)
    }
}

/// The largest stresses of one body by its field, with errors by that on a coarser grid; `None` when `goes_on` returns false.
fn in_body(
    step: &Step,
    reading: &Reading,
    field: &StressField,
    coarser: Option<&StressField>,
    goes_on: &dyn Fn() -> bool,
) -> Option<Maxima> {
    let maxima = field.maxima_while(contact_radii(step, reading), goes_on)?;
    let mut maxima = match coarser {
        Some(coarser) => maxima.with_errors_while(coarser, goes_on)?,
        None => maxima,
    };
    let Maxima { materials, faces, interfaces, .. } = &mut maxima;
    peaks(materials, faces, interfaces).for_each(|peak| move_beside_site(step, peak));
    if let Some(tip) = Tip::of(step, reading, field.half_space()) {
        let first = [materials, faces].map(|all| all.first_mut());
        for Extremes { tau1, mises, tension, strain, compression, horizontal_strain: _ } in first.into_iter().flatten()
        {
            let peaks = [Some(tau1), Some(mises), Some(tension).filter(|_| tip.tears)];
            let strains = [strain.as_mut().filter(|_| tip.stretches), compression.as_mut().filter(|_| tip.compresses)];
            peaks.into_iter().chain(strains).flatten().for_each(|peak| tip.press(peak));
        }
    }
    Some(maxima)
}

/// Moves a peak and its rival to the images nearest to an indenter of the first cell.
pub(super) fn move_beside_site(step: &Step, peak: &mut Peak) {
    peak.position = beside_site(step, peak.position);
    peak.rival.iter_mut().for_each(|rival| rival.position = beside_site(step, rival.position));
}

/// A tip in contact: the body below is infinitely stressed, whatever a grid shows of it.
pub(super) struct Tip {
    position: [f64; 3],
    material: MaterialId,
    /// Whether tension is infinite too.
    pub tears: bool,
    /// Whether the largest principal strain is.
    stretches: bool,
    /// Whether the compression along z is.
    pub compresses: bool,
}

impl Tip {
    pub fn of(step: &Step, reading: &Reading, half_space: &HalfSpace) -> Option<Self> {
        let [x, y] = step.grid().cell().point(tips(step, reading, half_space).next()?.place);
        let material = half_space.material_id(1);
        Some(Self {
            position: [x, y, 0.0],
            material,
            tears: tears(step, half_space),
            stretches: stretches(step, half_space),
            compresses: half_space.surface_material().poisson() < 0.5,
        })
    }

    pub fn press(&self, peak: &mut Peak) {
        let Self { position, material, .. } = *self;
        *peak = Peak { value: f64::INFINITY, position, material, error: None, rival: None, ..*peak };
    }

    /// Makes the peak of a measure along a path infinite, as shear stress and amplitude of the deviator are at the tip.
    pub fn press_path(&self, peak: &mut PathPeak) {
        *peak = PathPeak { value: f64::INFINITY, error: None, position: self.position };
    }
}

/// Every place of a largest stress.
fn peaks<'a>(
    materials: &'a mut [Extremes],
    faces: &'a mut [Extremes],
    interfaces: &'a mut [Carried],
) -> impl Iterator<Item = &'a mut Peak> {
    let extremes = materials.iter_mut().chain(faces);
    let extremes = extremes.flat_map(Extremes::peaks_mut);
    let interfaces = interfaces.iter_mut().flat_map(|carried| {
        let Carried { normal, shear, delamination, .. } = carried;
        [Some(normal), Some(shear), delamination.as_mut()].into_iter().flatten()
    });
    extremes.chain(interfaces)
}

/// The extremes over all of some materials.
fn overall(materials: &[Extremes]) -> Extremes {
    let highest = |peaks: Vec<Peak>| Peak::highest(&peaks, 0.0);
    let largest =
        |peak: fn(&Extremes) -> Peak| highest(materials.iter().map(peak).collect()).expect("a body has materials");
    let strain = |peak: fn(&Extremes) -> Option<Peak>| highest(materials.iter().filter_map(peak).collect());
    Extremes {
        tau1: largest(|peaks| peaks.tau1),
        tension: largest(|peaks| peaks.tension),
        mises: largest(|peaks| peaks.mises),
        strain: strain(|peaks| peaks.strain),
        horizontal_strain: strain(|peaks| peaks.horizontal_strain),
        compression: strain(|peaks| peaks.compression),
    }
}

/// Places of infinite τ₁ at the surface of one of the bodies: the tips in contact, unless its material there is
/// incompressible, as σ_z and σ_r are then infinite alike; then the traction of a counterbody that slides still is.
pub fn tips<'a>(
    step: &'a Step,
    reading: &'a Reading,
    half_space: &'a HalfSpace,
) -> impl Iterator<Item = &'a Site> + use<'a> {
    let sites = step.surface().sites().iter().filter(|site| reading.levels[site.level - 1].singular());
    let slides = friction(step) > 0.0;
    sites.filter(move |_| slides || half_space.surface_material().poisson() < 0.5)
}

/// Whether tension is infinite at the surface of one of the bodies at a tip in contact: near it σ_z = −p, σ_x = −(½ + ν)p and τ = μp, so that there is tension
/// from μ² > ½ + ν on.
pub fn tears(step: &Step, half_space: &HalfSpace) -> bool {
    let (nu, mu) = (half_space.surface_material().poisson(), friction(step));
    mu * mu > 0.5 + nu
}

/// Whether the largest principal strain is infinite at the surface of one of the bodies at a tip in contact: with the stresses of [`tears`]
/// ε_z = −(1 + ν)(1 − 2ν)p/E, ε_x = ½ε_z and ε_xz = −(1 + ν)μp/E, so that there is extension from μ > (1 − 2ν)/√2 on. All horizontal
/// strains are compressions there.
fn stretches(step: &Step, half_space: &HalfSpace) -> bool {
    friction(step) > (1.0 - 2.0 * half_space.surface_material().poisson()) / SQRT_2
}

/// μ, 0 without friction.
fn friction(step: &Step) -> f64 {
    step.problem().friction().map_or(0.0, Friction::coefficient)
}

/// The image of a position nearest to an indenter of the first cell: behind an indenter x is less than at its axis, not a period
/// more.
pub(super) fn beside_site(step: &Step, [x, y, z]: [f64; 3]) -> [f64; 3] {
    let cell = step.grid().cell();
    let ([s, t], reduced) = (cell.fractions([x, y]), cell.reduced());
    let near = step.surface().sites().iter().map(|site| {
        let [u, v] = reduced.nearest([s - site.place[0], t - site.place[1]]);
        (cell.point(site.place), [u, v], u.hypot(v))
    });
    // The first one of indenters that are as near, to rounding.
    let nearest = near.reduce(|best, next| if next.2 < best.2 * (1.0 - 1e-9) { next } else { best });
    nearest.map_or([x, y, z], |(site, [u, v], _)| [site[0] + u, site[1] + v, z])
}

/// Smallest and largest contact radius of a step; where contacts have no radius, that of a disc of the whole contact's
/// area. The smallest is taken to have four samples at least.
///
/// Under a given pressure the radii are those of its discs and of its spots, discs of their area.
pub fn contact_radii(step: &Step, reading: &Reading) -> [f64; 2] {
    let grid = step.grid();
    if let Some(given) = step.problem().given_pressure() {
        let radii = given.loaded_discs().iter().filter(|disc| disc.pressure > 0.0).map(|disc| disc.radius);
        let of_spot = |&(samples, _): &(usize, f64)| (samples as f64 * grid.sample_area() / PI).sqrt();
        let counts = step.finest().spots(None);
        let radii: Vec<f64> = radii.chain(counts.sizes.iter().map(of_spot)).collect();
        let least = radii.iter().copied().fold(f64::INFINITY, f64::min).max(4.0 * grid.spacing());
        return [least, radii.iter().copied().fold(least, f64::max)];
    }
    let whole = (reading.contact_area / PI).sqrt();
    let touching = reading.levels.iter().filter(|level| level.touches());
    let radii: Vec<f64> = touching.filter_map(|level| level.contact_radius).collect();
    let least = radii.iter().copied().fold(whole, f64::min).max(4.0 * grid.spacing());
    let most = if radii.is_empty() { whole } else { radii.iter().copied().fold(0.0, f64::max) };
    [least, most.max(least)]
}
