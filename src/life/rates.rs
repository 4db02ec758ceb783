//! Damage that one pass does on the present surface, over depth.
//!
//! Between the planes of a step the range of τ₁ is a cubic in depth with the slopes of parabolas through three planes, none of which is
//! steeper than three times the flatter of its secants, so that a rise at the surface raises nothing below it (Hyman, SIAM J. Sci. Stat.
//! Comput. 4 (1983) 645).

use crate::body::{Durability, Fatigue, HalfSpace};
use crate::reading::{FatiguePart, FatigueReading};
use crate::stress::RangePlane;

/// Part of a depth by which rounding may set it below the deepest plane.
const ROUNDING: f64 = 1e-9;
/// Most slope over the flatter secant.
const STEEPEST: f64 = 3.0;

/// Damage that one pass does on the present surface.
#[derive(Debug, Clone)]
pub struct Rates {
    /// Of each material of the original body with a law and planes.
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
        let of = |(number, own): (usize, Durability)| {
            let own_planes = planes.iter().filter(|plane| plane.depth.material + gone == number);
            MaterialRates::new(number, own.fatigue?, own_planes.map(|plane| plane.on(y)).collect())
        };
        let mut interfaces = vec![0.0; original.layers().len()];
        for life in reading.iter().flat_map(|own| &own.lives) {
            if let FatiguePart::Interface(own) = life.part
                && !own.is_counterbody()
            {
                interfaces[own.number - 1 + gone] = life.damage;
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
        let own = self.materials.iter().find(|own| own.material == material)?;
        let last = own.depths.len() - 1;
        let z = if z <= own.depths[last] * (1.0 + ROUNDING) { z.min(own.depths[last]) } else { return None };
        let after = own.depths.partition_point(|depth| *depth < z).min(last);
        let before = after.saturating_sub(1);
        let apart = own.depths[after] - own.depths[before];
        let t = if apart > 0.0 { ((z - own.depths[before]) / apart).max(0.0) } else { 0.0 };
        let ranges = own.lines[before].iter().zip(&own.lines[after]);
        Some(ranges.map(move |(above, below)| own.law.damage(between([*above, *below], apart, t))))
    }

    /// Depth of the deepest plane of a material.
    pub(super) fn deepest(&self, material: usize) -> Option<f64> {
        let own = self.materials.iter().find(|own| own.material == material)?;
        own.depths.last().copied()
    }
}

impl MaterialRates {
    /// `None` without a plane.
    fn new(material: usize, law: Fatigue, mut planes: Vec<RangePlane>) -> Option<Self> {
        planes.sort_by(|a, b| a.depth.z.total_cmp(&b.depth.z));
        planes.dedup_by(|a, b| a.depth.z == b.depth.z);
        let depths: Vec<f64> = planes.iter().map(|plane| plane.depth.z).collect();
        let range = |plane: usize, line: usize| planes[plane].lines[line][1];
        let slope = |plane: usize, line: usize| {
            let secant = |a: usize| (range(a + 1, line) - range(a, line)) / (depths[a + 1] - depths[a]);
            let last = planes.len() - 1;
            match plane {
                _ if last == 0 => 0.0,
                _ if last == 1 => secant(0),
                0 => end_slope([secant(0), secant(1)], [depths[1] - depths[0], depths[2] - depths[1]]),
                own if own == last => {
                    let apart = [depths[last] - depths[last - 1], depths[last - 1] - depths[last - 2]];
                    end_slope([secant(last - 1), secant(last - 2)], apart)
                }
                own => inner_slope(
                    [secant(own - 1), secant(own)],
                    [depths[own] - depths[own - 1], depths[own + 1] - depths[own]],
                ),
            }
        };
        let on = |plane: usize| {
            (0..planes[plane].lines.len()).map(|line| [range(plane, line), slope(plane, line)]).collect::<Vec<_>>()
        };
        let lines = (0..planes.len()).map(on).collect();
        (!planes.is_empty()).then_some(Self { material, law, depths, lines })
    }
}

/// Slope of the parabola through three places in the middle one, from the secants before and after it and their lengths.
fn inner_slope([before, after]: [f64; 2], [a, b]: [f64; 2]) -> f64 {
    limited((b * before + a * after) / (a + b), before.abs().min(after.abs()))
}

/// Slope of that parabola in its first place, from the first secant on; not against it.
fn end_slope([first, second]: [f64; 2], [a, b]: [f64; 2]) -> f64 {
    let slope = limited(((2.0 * a + b) * first - a * second) / (a + b), first.abs());
    if slope * first > 0.0 { slope } else { 0.0 }
}

fn limited(slope: f64, flatter: f64) -> f64 {
    let most = STEEPEST * flatter;
    if most.is_finite() { slope.clamp(-most, most) } else { 0.0 }
}

/// The cubic with value and slope at both ends `apart` at a part t of the way, not below 0.
fn between([[a, p], [b, q]]: [[f64; 2]; 2], apart: f64, t: f64) -> f64 {
    let (s, u) = (t * t * (3.0 - 2.0 * t), 1.0 - t);
    let linear = if s == 0.0 { a } else { a + s * (b - a) };
    (linear + apart * t * u * (u * p - t * q)).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::Depth;

    fn rates(depths: &[f64], range: impl Fn(f64) -> f64) -> MaterialRates {
        let of = |&z: &f64| RangePlane { depth: Depth { z, material: 1 }, lines: vec![[0.0, range(z)]], period: None };
        MaterialRates::new(1, Fatigue::new(1.0, 1.0, 1.0).unwrap(), depths.iter().map(of).collect()).unwrap()
    }

    fn at(own: MaterialRates, z: f64) -> f64 {
        let own = Rates { materials: vec![own], interfaces: Vec::new() };
        own.at(1, z).unwrap().next().unwrap()
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
        let own = |z: f64| at(rates(&[0.0, 0.05, 0.1, 0.15], |z| if z == 0.0 { 0.8 } else { 0.3 - 0.2 * z }), z);
        for k in 0..100 {
            let z = 0.05 + 0.001 * f64::from(k);
            assert!((own(z) - (0.3 - 0.2 * z)).abs() < 0.05 * 0.4 * 4.0 / 27.0 + 1e-12, "{z}: {}", own(z));
        }
        assert!((own(0.15 * (1.0 + 1e-12)) - 0.27).abs() < 1e-12);
        assert!(rates(&[0.0], |_| 1.0).lines[0][0] == [1.0, 0.0]);
    }
}
