//! Ranges on wanted lines (y, z): bodies are cut into layers of their own materials with faces at the depths wanted, where planes are
//! read; between the lines of a plane a parabola.

use crate::StudyError;
use crate::alone::problem;
use crate::steps::Steps;
use percoat_core::body::Interface::Bonded;
use percoat_core::body::{Durability, Endurance, Fatigue, HalfSpace, Layer, Material};
use percoat_core::counterbody::Shape;
use percoat_core::friction::Friction;
use percoat_core::load::Load;
use percoat_core::problem::Problem;
use percoat_core::spectral::Step;
use percoat_core::stress::{PathPeaks, PathSought, RangePlane, StressField};
use std::f64::consts::PI;

/// A tolerance below the errors of the grid.
const TOLERANCE: f64 = 1e-10;

/// A law that all parts have, so steep that of the cycles along a path the longest alone counts: only ranges are read, as in the tables.
pub fn law() -> Result<Fatigue, StudyError> {
    Ok(Fatigue::new(1.0, 1.0, 1e5)?)
}

/// Friction along x that does not change the pressure.
pub fn friction(mu: f64) -> Result<Friction, StudyError> {
    Ok(Friction::new(mu, [1.0, 0.0])?.uncoupled())
}

/// The paraboloid r²/2 over the middle of a window of some points and their spacing, uncoupled.
pub fn solved(body: HalfSpace, mu: f64, force: f64, points: usize, spacing: f64) -> Result<Step, StudyError> {
    let problem = problem(Shape::Paraboloid { radius: 1.0 }, body, points as f64 * spacing)?;
    let problem: Problem = problem.sliding(friction(mu)?)?;
    Steps::to(problem, [points; 2], TOLERANCE)?.step(Load::Force(force))
}

/// Force under which radius and largest pressure are 1, on a bare body of [`young`].
pub const FORCE: f64 = 2.0 * PI / 3.0;

/// E with E* = π/2.
pub fn young(nu: f64) -> f64 {
    0.5 * PI * (1.0 - nu * nu)
}

/// A body of a coating, (h, E, ν), or none, and a substrate (E, ν).
#[derive(Clone, Copy)]
pub struct Parts {
    pub coating: Option<[f64; 3]>,
    pub substrate: [f64; 2],
}

impl Parts {
    fn material(&self, bottom: f64) -> Result<Material, StudyError> {
        let [young, poisson] = match self.coating {
            Some([h, young, poisson]) if bottom <= h * (1.0 + 1e-12) => [young, poisson],
            _ => self.substrate,
        };
        Ok(Material::from_young(young, poisson)?)
    }

    /// The body with faces at these depths, ascending, that of the coating's interface among them. Layers of their
    /// numbers, from 1 on, have a durability; the coating's interface has a law.
    pub fn cut(&self, depths: &[f64], durability: impl Fn(usize) -> Durability) -> Result<HalfSpace, StudyError> {
        let mut top = 0.0;
        let mut layers = Vec::new();
        for (number, &bottom) in (1..).zip(depths) {
            let is_coating = self.coating.is_some_and(|[h, ..]| (h - bottom).abs() < 1e-12);
            let interface = if is_coating { Some(law()?) } else { None };
            let layer = Layer::new(self.material(bottom)?, bottom - top, Bonded)?;
            layers.push(layer.with_durability(durability(number), interface)?);
            top = bottom;
        }
        let [young, poisson] = self.substrate;
        Ok(HalfSpace::new(layers, Material::from_young(young, poisson)?))
    }
}

/// A durability of a law of fatigue.
pub fn fatigue_durability() -> Result<Durability, StudyError> {
    Ok(Durability { fatigue: Some(law()?), ..Durability::default() })
}

/// A durability of endurance limits.
pub fn endurance_durability(limits: Endurance) -> Durability {
    Durability { endurance: Some(limits), ..Durability::default() }
}

/// Peaks along x under contacts of a radius.
pub fn peaks(field: &StressField, radius: f64, sought: PathSought) -> Result<PathPeaks, StudyError> {
    peaks_with_errors(field, None, radius, sought)
}

/// Peaks along x under contacts of a radius, with errors by the field of a coarser grid.
pub fn peaks_with_errors(
    field: &StressField,
    coarser: Option<&StressField>,
    radius: f64,
    sought: PathSought,
) -> Result<PathPeaks, StudyError> {
    field
        .path_peaks_while([1.0, 0.0], [radius; 2], sought, coarser, &|| true)
        .ok_or_else(|| "the search was ended".into())
}

/// The range at y on the plane of a depth in the material above it or below it.
pub fn range(planes: &[RangePlane], y: f64, z: f64, is_below: bool) -> Result<f64, StudyError> {
    let at_depth = planes.iter().filter(|plane| (plane.depth.z - z).abs() < 1e-9);
    let by_material = |plane: &&RangePlane| plane.depth.material;
    let plane = if is_below { at_depth.max_by_key(by_material) } else { at_depth.min_by_key(by_material) };
    let lines = &plane.ok_or_else(|| format!("no plane at {z}"))?.lines;
    let next = lines.partition_point(|line| line[0] < y - 1e-9).clamp(1, lines.len() - 2);
    // The middle of three lines is the one nearest to y.
    let middle = if next > 1 && y - lines[next - 1][0] < lines[next][0] - y { next - 1 } else { next };
    let [[a, of_a], [b, of_b], [c, of_c]] = [lines[middle - 1], lines[middle], lines[middle + 1]];
    let weight = |x: f64, others: [f64; 2]| others.iter().map(|other| (y - other) / (x - other)).product::<f64>();
    Ok(of_a * weight(a, [b, c]) + of_b * weight(b, [a, c]) + of_c * weight(c, [a, b]))
}
