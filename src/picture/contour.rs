//! Lines on which a field is zero, by marching squares.

/// Pieces of the zero line of values on a rectangle with `columns` × `rows` intervals, in parts of its width and height.
pub fn zero_line(columns: usize, rows: usize, value: impl Fn([f64; 2]) -> Option<f64>) -> Vec<[[f64; 2]; 2]> {
    let part = |i: usize, j: usize| [i as f64 / columns as f64, j as f64 / rows as f64];
    let values: Vec<Option<f64>> =
        (0..=rows).flat_map(|j| (0..=columns).map(move |i| (i, j))).map(|(i, j)| value(part(i, j))).collect();
    let mut pieces = Vec::new();
    for (i, j) in (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j))) {
        let corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
        let at = |k: usize| values[corners[k % 4].1 * (columns + 1) + corners[k % 4].0];
        let mut crossings: Vec<[f64; 2]> = Vec::new();
        for k in 0..4 {
            let (Some(a), Some(b)) = (at(k), at(k + 1)) else { continue };
            if (a > 0.0) != (b > 0.0) {
                let t = a / (a - b);
                let [p, q] = [corners[k], corners[(k + 1) % 4]].map(|(i, j)| part(i, j));
                crossings.push([0, 1].map(|c| p[c] + t * (q[c] - p[c])));
            }
        }
        pieces.extend(crossings.chunks_exact(2).map(|pair| [pair[0], pair[1]]));
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_zero_line_of_a_circle_has_its_length() {
        let pieces = zero_line(50, 60, |[x, y]| Some((x - 0.5).hypot(y - 0.5) - 0.3));
        let length: f64 = pieces.iter().map(|[p, q]| (p[0] - q[0]).hypot(p[1] - q[1])).sum();
        assert!((length / (0.6 * std::f64::consts::PI) - 1.0).abs() < 2e-3, "{length}");
    }
}
