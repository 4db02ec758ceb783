//! Planes of a material between which the damage of a pass is known.
//!
//! The planes of a search follow from the contact radius and the layers, not from the grid: what a cubic between them
//! misses is the same on every grid. The damage rises with the power m of the range, and the depth at which it is
//! largest, that of a fragment, is sensitive to the error of the cubic. So between two planes on which damage is done a
//! further plane is added in the middle, until the damage read there agrees with that of the cubic; the cubic through
//! the further plane errs by less.

use super::range_plane::RangePlane;
use crate::body::Depth;
use crate::numeric::limited_cubic::{between, slopes};

/// Difference of the damage that is foreseen and found, over the largest damage, down to which planes are added.
const MISSED: f64 = 5e-3;
/// Part of the largest damage below which there is none.
const NEGLIGIBLE: f64 = 1e-3;
/// Most times that the distance of two planes is halved.
const HALVED: u32 = 4;

/// The planes of a material, z ascending, with those that are to be added, which `read` gives; damage rises with the `exponent` of the
/// range. `None` when `read` does.
pub(super) fn completed(
    mut planes: Vec<RangePlane>,
    exponent: f64,
    read: &dyn Fn(Depth) -> Option<RangePlane>,
) -> Option<Vec<RangePlane>> {
    let mut open: Vec<(f64, u32)> = planes.iter().skip(1).rev().map(|plane| (plane.depth.z, 0)).collect();
    while let Some((lower, halved)) = open.pop() {
        let below = planes.partition_point(|plane| plane.depth.z < lower);
        let most = planes.iter().map(largest).fold(0.0, f64::max);
        let damage = |plane: &RangePlane| (largest(plane) / most).powf(exponent);
        let ends = [&planes[below - 1], &planes[below]];
        if halved == HALVED || !ends.iter().any(|end| damage(end) > NEGLIGIBLE) {
            continue;
        }
        let z = 0.5 * (ends[0].depth.z + ends[1].depth.z);
        let found = read(Depth { z, ..ends[1].depth })?;
        let most = most.max(largest(&found));
        let off = |(foreseen, [_, range]): (f64, &[f64; 2])| {
            ((foreseen / most).powf(exponent) - (range / most).powf(exponent)).abs()
        };
        let missed = foreseen(&planes, below, &found).zip(&found.lines).map(off).fold(0.0, f64::max);
        planes.insert(below, found);
        if missed > MISSED {
            open.extend([(lower, halved + 1), (z, halved + 1)]);
        }
    }
    Some(planes)
}

/// Largest finite range of a plane.
fn largest(plane: &RangePlane) -> f64 {
    plane.lines.iter().map(|[_, range]| *range).filter(|range| range.is_finite()).fold(0.0, f64::max)
}

/// Ranges on the lines of a plane by the six planes about it, of which `below` is the next one.
fn foreseen<'a>(planes: &'a [RangePlane], below: usize, plane: &'a RangePlane) -> impl Iterator<Item = f64> + 'a {
    let (from, to) = (below.saturating_sub(3), (below + 3).min(planes.len()));
    let depths: Vec<f64> = planes[from..to].iter().map(|node| node.depth.z).collect();
    let after = below - from;
    let apart = depths[after] - depths[after - 1];
    let part = (plane.depth.z - depths[after - 1]) / apart;
    plane.y().map(move |y| {
        let ranges: Vec<f64> = planes[from..to].iter().map(|node| node.at(y)).collect();
        let slopes = slopes(&depths, &ranges);
        between([after - 1, after].map(|end| [ranges[end], slopes[end]]), apart, part)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    fn plane(z: f64, range: f64) -> RangePlane {
        RangePlane { depth: Depth { z, material: 1 }, lines: vec![[0.0, range]], period: None }
    }

    /// Below a Hertz contact, on the axis, ν = 0.3, at depths a third apart as planes are.
    #[test]
    fn planes_are_added_where_damage_is_done_until_it_is_known_between_them() {
        let tau = |z: f64| {
            let s = 1.0 - z * (1.0 / z.max(1e-12)).atan();
            0.5 * (1.5 / (1.0 + z * z) - 1.3 * s).abs()
        };
        let known: Vec<RangePlane> =
            std::iter::once(0.0).chain((0..14).map(|k| 0.1 * 1.35f64.powi(k))).map(|z| plane(z, tau(z))).collect();
        for exponent in [4.0, 8.0, 16.0] {
            let read = Cell::new(0);
            let planes = completed(known.clone(), exponent, &|depth| {
                read.set(read.get() + 1);
                Some(plane(depth.z, tau(depth.z)))
            });
            let planes = planes.unwrap();
            assert!(planes.len() == known.len() + read.get() && read.get() < 16, "{}", read.get());
            assert!(planes.is_sorted_by(|a, b| a.depth.z < b.depth.z));
            let damage = |range: f64| (range / 0.310_021).powf(exponent);
            let off = (1..1000).map(|k| {
                let z = 3e-3 * f64::from(k);
                let below = planes.partition_point(|plane| plane.depth.z < z);
                let range = foreseen(&planes, below, &plane(z, 0.0)).next().unwrap();
                (damage(range) - damage(tau(z))).abs()
            });
            let off = off.fold(0.0, f64::max);
            assert!(off < MISSED / 4.0, "{exponent}: {off}");
        }
        let none = completed(known, 8.0, &|_| None);
        assert!(none.is_none());
    }

    #[test]
    fn an_infinite_range_at_the_surface_and_no_range_add_no_planes_without_end() {
        let read = |depth: Depth| Some(plane(depth.z, 0.0));
        assert_eq!(completed(vec![plane(0.0, 0.0), plane(1.0, 0.0)], 8.0, &read).unwrap().len(), 2);
        let tip = completed(vec![plane(0.0, f64::INFINITY), plane(0.5, 1.0), plane(1.0, 0.5)], 8.0, &|depth| {
            Some(plane(depth.z, 0.5 / depth.z))
        });
        assert!(tip.unwrap().len() < 40);
    }
}
