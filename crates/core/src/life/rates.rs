//! Damage that one pass does on the present surface, over depth.
//!
//! Between the planes of a step the range of τ₁ is a cubic in depth with limited slopes ([`limited_cubic`](crate::numeric::limited_cubic)),
//! so that a rise at the surface raises nothing below it. A map of damage has planes until that is the range.

use crate::body::{Durability, Fatigue, HalfSpace};
use crate::numeric::limited_cubic::{between, slopes};
use crate::reading::{FatiguePart, FatigueReading};
use crate::stress::RangePlane;

/// Part of a depth by which rounding may set it below the deepest plane.
const ROUNDING: f64 = 1e-9;

/// Damage that one pass does on the present surface.
#[derive(Debug, Clone)]
pub struct Rates {
    /// Rates of each material of the original body with a law and planes.
    materials: Vec<MaterialRates>,
    /// Damage in a pass of each interface of the original body.
    pub(super) interfaces: Vec<f64>,
}

/// Ranges in a material over depth.
#[derive(Debug, Clone)]
struct MaterialRates {
    /// Number of the material in the original body.
    material: usize,
    law: Fatigue,
    /// Depths of the planes below the present surface, ascending, lengths.
    depths: Vec<f64>,
    /// Range and its slope over depth of each plane on each line.
    lines: Vec<Vec<[f64; 2]>>,
}

impl Rates {
    /// Rates by the planes and the reading of a step, on the lines `y` of the damage, on a body of whose original `gone` layers have come
    /// off.
    pub fn new(
        original: &HalfSpace,
        gone: usize,
        planes: &[RangePlane],
        reading: Option<&FatigueReading>,
        y: &[f64],
    ) -> Self {
        let laws = (1..).zip(original.durabilities()).skip(gone);
        let of = |(number, durability): (usize, Durability)| {
            let own_planes = planes.iter().filter(|plane| plane.depth.material + gone == number);
            MaterialRates::new(number, durability.fatigue?, own_planes.map(|plane| plane.on(y)).collect())
        };
        let mut interfaces = vec![0.0; original.layers().len()];
        for life in reading.iter().flat_map(|reading| &reading.lives) {
            if let FatiguePart::Interface(id) = life.part
                && !id.is_counterbody()
            {
                interfaces[id.number - 1 + gone] = life.damage;
            }
        }
        Self { materials: laws.filter_map(of).collect(), interfaces }
    }

    /// Whether any damage is done.
    pub fn is_any(&self) -> bool {
        !self.materials.is_empty() || self.interfaces.iter().any(|rate| *rate > 0.0)
    }

    /// Damage in a pass of a material at a depth below the present surface, on all lines; none below the deepest plane.
    pub(super) fn at(&self, material: usize, z: f64) -> Option<impl Iterator<Item = f64> + '_> {
        let rates = self.materials.iter().find(|rates| rates.material == material)?;
        let last = rates.depths.len() - 1;
        let z = if z <= rates.depths[last] * (1.0 + ROUNDING) { z.min(rates.depths[last]) } else { return None };
        let after = rates.depths.partition_point(|depth| *depth < z).min(last);
        let before = after.saturating_sub(1);
        let apart = rates.depths[after] - rates.depths[before];
        let t = if apart > 0.0 { ((z - rates.depths[before]) / apart).max(0.0) } else { 0.0 };
        let ranges = rates.lines[before].iter().zip(&rates.lines[after]);
        Some(ranges.map(move |(above, below)| rates.law.damage(between([*above, *below], apart, t))))
    }

    /// Depth of the deepest plane of a material.
    pub(super) fn deepest(&self, material: usize) -> Option<f64> {
        let rates = self.materials.iter().find(|rates| rates.material == material)?;
        rates.depths.last().copied()
    }
}

impl MaterialRates {
    /// Rates of a material by its planes; `None` without a plane.
    fn new(material: usize, law: Fatigue, mut planes: Vec<RangePlane>) -> Option<Self> {
        planes.sort_by(|a, b| a.depth.z.total_cmp(&b.depth.z));
        planes.dedup_by(|a, b| a.depth.z == b.depth.z);
        let depths: Vec<f64> = planes.iter().map(|plane| plane.depth.z).collect();
        let count = planes.first().map_or(0, |plane| plane.lines.len());
        let mut lines = vec![vec![[0.0; 2]; count]; planes.len()];
        for line in 0..count {
            let ranges: Vec<f64> = planes.iter().map(|plane| plane.lines[line][1]).collect();
            for (plane, slope) in slopes(&depths, &ranges).into_iter().enumerate() {
                lines[plane][line] = [ranges[plane], slope];
            }
        }
        (!planes.is_empty()).then_some(Self { material, law, depths, lines })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::Depth;

    fn rates(depths: &[f64], range: impl Fn(f64) -> f64) -> MaterialRates {
        let of = |&z: &f64| RangePlane { depth: Depth { z, material: 1 }, lines: vec![[0.0, range(z)]], period: None };
        MaterialRates::new(1, Fatigue::new(1.0, 1.0, 1.0).unwrap(), depths.iter().map(of).collect()).unwrap()
    }

    fn at(material: MaterialRates, z: f64) -> f64 {
        let rates = Rates { materials: vec![material], interfaces: Vec::new() };
        rates.at(1, z).unwrap().next().unwrap()
    }

    /// Below a Hertz contact, on the axis, ν = 0.3, at depths a third apart as planes are: a quarter of what a range linear between them
    /// errs by.
    #[test]
    fn between_planes_the_range_is_that_of_hertz() {
        let tau = |z: f64| {
            let s = 1.0 - z * (1.0 / z.max(1e-12)).atan();
            0.5 * (1.5 / (1.0 + z * z) - 1.3 * s).abs()
        };
        let depths: Vec<f64> = std::iter::once(0.0).chain((0..14).map(|k| 0.1 * 1.35f64.powi(k))).collect();
        for (from, to, most) in [(0.0, 0.7, 2e-3), (0.7, 1.5, 4e-3), (1.5, 3.0, 1.2e-2)] {
            let worst = (0..100)
                .map(|k| from + (to - from) * f64::from(k) / 100.0)
                .fold(0.0f64, |worst, z| worst.max((at(rates(&depths, tau), z) / tau(z) - 1.0).abs()));
            assert!(worst < most, "{from} to {to}: {worst:e}");
        }
    }

    /// The slope below it is three times too steep at most, which is 4/27 of the distance times twice the slope.
    #[test]
    fn a_rise_at_the_surface_raises_and_lowers_nothing_below_it() {
        let rate = |z: f64| at(rates(&[0.0, 0.05, 0.1, 0.15], |z| if z == 0.0 { 0.8 } else { 0.3 - 0.2 * z }), z);
        for k in 0..100 {
            let z = 0.05 + 0.001 * f64::from(k);
            assert!((rate(z) - (0.3 - 0.2 * z)).abs() < 0.05 * 0.4 * 4.0 / 27.0 + 1e-12, "{z}: {}", rate(z));
        }
        assert!((rate(0.15 * (1.0 + 1e-12)) - 0.27).abs() < 1e-12);
        assert!(rates(&[0.0], |_| 1.0).lines[0][0] == [1.0, 0.0]);
    }
}
