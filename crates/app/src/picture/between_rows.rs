//! A section between its rows: values at any place, and lines on which they are zero.

use ndarray::Array2;
use percoat_core::stress::VerticalSection;
use percoat_draw::contour::zero_lines;

/// Value at a distance along the line and a depth (lengths), linear between the nearest rows of its material; `None` above the
/// first row. `values` has the axes of the states.
pub(super) fn at(section: &VerticalSection, values: &Array2<f64>, s: f64, z: f64) -> Option<f64> {
    let below = section.depths.partition_point(|depth| depth.z <= z);
    let (before, after) = (below.checked_sub(1)?, below.min(section.depths.len() - 1));
    let [z0, z1] = [before, after].map(|row| section.depths[row].z);
    let t = if z1 > z0 { (z - z0) / (z1 - z0) } else { 0.0 };
    let count = section.line.points;
    let [first, last] = section.line.span;
    let place = ((s - first) / (last - first) * (count - 1) as f64).clamp(0.0, (count - 1) as f64);
    let column = (place as usize).min(count - 2);
    let u = place - column as f64;
    let at = |row: usize| (1.0 - u) * values[[row, column]] + u * values[[row, column + 1]];
    Some((1.0 - t) * at(before) + t * at(after))
}

/// Lines of points (s, z), lengths, on which values are zero. Each material has its own, as a stress may jump over zero at an
/// interface.
pub(super) fn zeros(section: &VerticalSection, values: &Array2<f64>) -> Vec<Vec<[f64; 2]>> {
    /// Intervals along the line and in depth in which zeros are searched.
    const INTERVALS: [f64; 2] = [200.0, 140.0];
    let [first, last] = section.line.span;
    let deepest = section.depths.last().map_or(1.0, |depth| depth.z);
    let bounds = [vec![0.0], section.interfaces(), vec![deepest]].concat();
    let within = |ends: &[f64]| {
        // A depth on an interface belongs to the material below it.
        let thickness = (ends[1] - ends[0]) * (1.0 - 1e-9);
        let place = |[u, v]: [f64; 2]| [first + u * (last - first), ends[0] + v * thickness];
        let rows = (INTERVALS[1] * thickness / deepest).ceil().max(10.0) as usize;
        let value = |part: [f64; 2]| at(section, values, place(part)[0], place(part)[1]);
        let lines = zero_lines(INTERVALS[0] as usize, rows, value).into_iter();
        lines.map(|line| line.into_iter().map(place).collect()).collect::<Vec<Vec<[f64; 2]>>>()
    };
    bounds.windows(2).filter(|ends| ends[0] < ends[1]).flat_map(within).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use percoat_core::body::Depth;
    use percoat_core::reading::SectionMeasure;
    use percoat_core::stress::{StressState, SurfaceLine};

    #[test]
    fn values_are_taken_from_the_side_of_the_interface_where_they_are() {
        let depths = [(0.0, 1), (1.0, 1), (1.0, 2), (2.0, 2)].map(|(z, material)| Depth { z, material }).to_vec();
        let line = SurfaceLine { origin: [0.0; 2], direction: [2.0, 0.0], span: [0.0, 1.0], points: 3 };
        let rows = [1.0, 3.0, -2.0, -1.0];
        let states = Array2::from_shape_fn((4, 3), |(row, _)| StressState { xx: rows[row], ..StressState::default() });
        let section = VerticalSection { line, depths, states, highest: None };
        let values = section.values(SectionMeasure::Along);
        assert!((at(&section, &values, 0.3, 0.5).unwrap() - 2.0).abs() < 1e-12);
        assert_eq!(at(&section, &values, 0.3, 0.999).map(f64::round), Some(3.0));
        assert_eq!(at(&section, &values, 0.3, 1.001).map(f64::round), Some(-2.0));
        // Positive above the interface, negative below it, and zero nowhere.
        assert!(zeros(&section, &values).is_empty());
        assert_eq!(zeros(&section, &(&values - 2.0)).len(), 1);
    }
}
