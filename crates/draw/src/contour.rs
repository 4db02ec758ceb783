//! Contour lines of zero of a field, by marching squares.

/// Lines on which values on a rectangle with `columns` × `rows` intervals are zero, in parts of its width and height; a
/// closed line ends where it begins.
pub fn zero_lines(columns: usize, rows: usize, value: impl Fn([f64; 2]) -> Option<f64>) -> Vec<Vec<[f64; 2]>> {
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
    joined(pieces)
}

/// Pieces of lines joined at their common ends.
fn joined(mut pieces: Vec<[[f64; 2]; 2]>) -> Vec<Vec<[f64; 2]>> {
    // Neighbours find their common end from opposite sides and differ by rounding.
    let same = |p: [f64; 2], q: [f64; 2]| (0..2).all(|k| (p[k] - q[k]).abs() < 1e-9);
    let mut lines = Vec::new();
    while let Some(piece) = pieces.pop() {
        let mut line = piece.to_vec();
        for _ in 0..2 {
            while let Some(k) = pieces.iter().position(|piece| piece.iter().any(|&p| same(p, line[line.len() - 1]))) {
                let [p, q] = pieces.swap_remove(k);
                line.push(if same(p, line[line.len() - 1]) { q } else { p });
            }
            line.reverse();
        }
        lines.push(line);
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_circles_are_two_closed_lines_as_long_as_they_are() {
        let circles = |[x, y]: [f64; 2]| Some(((x - 0.49).hypot(y - 0.26) - 0.2).min((x - 0.49).hypot(y - 0.74) - 0.2));
        let lines = zero_lines(50, 60, circles);
        assert_eq!(lines.len(), 2);
        for line in lines {
            let apart = |[p, q]: [[f64; 2]; 2]| (p[0] - q[0]).hypot(p[1] - q[1]);
            let length: f64 = line.windows(2).map(|pair| apart([pair[0], pair[1]])).sum();
            assert!((length / (0.4 * std::f64::consts::PI) - 1.0).abs() < 5e-3, "{length}");
            assert!(apart([line[0], line[line.len() - 1]]) < 1e-9);
        }
    }
}
