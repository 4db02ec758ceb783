//! The damage of one pass below the surface, across the path of sliding and over depth.

use super::Reading;
use super::stress::contact_radii;
use crate::body::{Depth, HalfSpace};
use crate::spectral::Step;
use crate::stress::{PathSought, RangePlane, StressField};
use ndarray::Array2;

/// Range of τ₁ along the path of sliding, and the damage by it in one pass, of the materials of a body that have a law of fatigue.
#[derive(Debug, Clone, PartialEq)]
pub struct DamageMap {
    /// y across the path, lengths, ascending: along y where the counterbody slides along x. One value where all of a plane is one path.
    pub y: Vec<f64>,
    /// Depths, from the surface down; an interface has both of its sides where both materials have a law.
    pub z: Vec<Depth>,
    /// Range of τ₁, a pressure; axis 0 along `z`, axis 1 along `y`.
    pub range: Array2<f64>,
    /// Damage in one pass; axes as those of `range`.
    pub damage: Array2<f64>,
}

impl DamageMap {
    /// The map of the planes of a body that one step gives; `None` without any.
    pub fn new(body: &HalfSpace, planes: &[RangePlane]) -> Option<Self> {
        let laws: Vec<_> = body.durabilities().map(|durability| durability.fatigue).collect();
        let y: Vec<f64> = planes.first()?.y().collect();
        let z: Vec<Depth> = planes.iter().map(|plane| plane.depth).collect();
        let range = Array2::from_shape_fn([z.len(), y.len()], |(row, column)| planes[row].lines[column][1]);
        let mut damage = range.clone();
        for (mut row, depth) in damage.outer_iter_mut().zip(&z) {
            let law = laws[depth.material - 1]?;
            row.mapv_inplace(|range| law.damage(range));
        }
        Some(Self { y, z, range, damage })
    }

    /// The map below a step that has contact and whose `reading` is known, by the stress `field` of one of its bodies; `None` where none of
    /// its materials has a law of fatigue.
    pub fn of(step: &Step, reading: &Reading, field: &StressField) -> Option<Self> {
        let (direction, radii) = (step.problem().direction(), contact_radii(step, reading));
        let sought = PathSought { fatigue: true, endurance: false, map: true };
        let found = field.path_peaks_while(direction, radii, sought, None, &|| true)?;
        Self::new(field.half_space(), &found.planes)
    }
}
