//! Points `x y z`, one a line, that stand on a regular grid along x and y, in any order: x along **a**₁, y along **a**₂.
//!
//! Coordinates of one column differ by rounding, those of neighbours by the spacing: the sorted ones are cut where they
//! rise by more than half of their largest rise. Every point must then stand within a tenth of a spacing of its place, and
//! every place must have one point.

use super::fault::{Fault, Heights, Lines, MOST, fits};
use std::io::BufRead;

/// How far a point may stand from its place, in spacings.
const NEAR: f64 = 0.1;
/// Memory per point: itself, its line, its place and a sorted coordinate, and the list before it has grown.
const PER_POINT: u64 = 72;

/// A point and its line.
struct Point {
    at: [f64; 2],
    height: f64,
    line: usize,
}

/// Equally spaced coordinates.
#[derive(Debug, Clone, Copy)]
struct Axis {
    first: f64,
    step: f64,
    count: usize,
}

impl Axis {
    fn of(mut coordinates: Vec<f64>) -> Self {
        coordinates.sort_unstable_by(f64::total_cmp);
        let rises = || coordinates.windows(2).map(|pair| pair[1] - pair[0]);
        let half = 0.5 * rises().fold(0.0, f64::max);
        let count = 1 + rises().filter(|rise| *rise > half && half > 0.0).count();
        let (first, last) = (coordinates[0], coordinates[coordinates.len() - 1]);
        Self { first, step: (last - first) / (count.max(2) - 1) as f64, count }
    }

    /// Index of a coordinate; none away from every place.
    fn index(&self, x: f64) -> Option<usize> {
        let steps = if self.step > 0.0 { (x - self.first) / self.step } else { 0.0 };
        let index = steps.round();
        ((steps - index).abs() <= NEAR).then_some(index as usize)
    }

    fn at(&self, index: usize) -> f64 {
        self.first + index as f64 * self.step
    }
}

/// Read points from a file of `bytes` bytes; also the period along x and y, n times the spacing.
pub(super) fn read(reader: impl BufRead, bytes: u64) -> Result<(Heights, [f64; 2]), Fault> {
    let mut lines = Lines::new(reader);
    let mut points = Vec::new();
    while let Some((line, text)) = lines.next_line()? {
        if points.is_empty() {
            fits(PER_POINT * (bytes / (text.len() as u64 + 1) + 1))?;
        }
        let parts = text.split(|c: char| c.is_whitespace() || c == ',' || c == ';').filter(|part| !part.is_empty());
        let numbers: Vec<Option<f64>> = parts.map(|part| part.parse().ok().filter(|x: &f64| x.is_finite())).collect();
        let [Some(x), Some(y), Some(height)] = numbers[..] else {
            let shown: String = text.chars().take(40).collect();
            let what = format!("line {line} holds \"{shown}\", not three finite numbers x y z");
            let help = "remove a header, or begin its lines with #; fill what was not measured before";
            return Err(Fault::new(what, format!("line {line}")).help(help));
        };
        points.push(Point { at: [x, y], height, line });
    }
    if points.len() < 4 {
        return Err(Fault::new(format!("holds {} points, too few for a surface", points.len()), "too few points"));
    }
    let axes = [0, 1].map(|axis| Axis::of(points.iter().map(|point| point.at[axis]).collect()));
    let counts = axes.map(|axis| axis.count);
    let mut values = vec![f64::NAN; 0];
    let mut lines_of = vec![0usize; 0];
    if counts.iter().all(|n| (2..=MOST).contains(n)) && counts[0] * counts[1] <= 2 * points.len() {
        values.resize(counts[0] * counts[1], f64::NAN);
        lines_of.resize(counts[0] * counts[1], 0);
    }
    for Point { at, height, line } in &points {
        let place = axes[0].index(at[0]).zip(axes[1].index(at[1])).map(|(i, j)| i * counts[1] + j);
        let Some(place) = place.filter(|place| *place < values.len()) else {
            let what = format!(
                "line {line}: the point ({}, {}) stands on no grid of equal spacings along x and y ({} × {} were found)",
                at[0], at[1], counts[0], counts[1]
            );
            return Err(Fault::new(what, format!("line {line}"))
                .help("every x must occur with every y, at equal distances: put the points on a regular grid before"));
        };
        if lines_of[place] != 0 {
            let what = format!("lines {} and {line} hold the same point ({}, {})", lines_of[place], at[0], at[1]);
            return Err(Fault::new(what, format!("line {line}")).help("give every point once"));
        }
        (values[place], lines_of[place]) = (*height, *line);
    }
    if let Some(place) = lines_of.iter().position(|line| *line == 0) {
        let [x, y] = [axes[0].at(place / counts[1]), axes[1].at(place % counts[1])];
        let missing = values.len() - points.len();
        let what = format!("{missing} of {} × {} points are missing, the first at ({x}, {y})", counts[0], counts[1]);
        return Err(Fault::new(what, "points are missing").help("fill what was not measured before"));
    }
    Ok((Heights::new(counts, values)?, axes.map(|axis| axis.count as f64 * axis.step)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str) -> Result<(Heights, [f64; 2]), Fault> {
        read(text.as_bytes(), text.len() as u64)
    }

    /// 3 × 2 points, spacing ⅓ and 2, of height 10 i + j.
    fn lines() -> Vec<String> {
        let at = |k: usize| (k / 2, k % 2);
        let line = |(i, j)| format!("{:.3} {} {}", -1.0 + i as f64 / 3.0, 5.0 + 2.0 * j as f64, 10 * i + j);
        (0..6).map(at).map(line).collect()
    }

    #[test]
    fn points_in_any_order_are_the_same_surface() {
        let mut lines = lines();
        let expected = Heights { points: [3, 2], values: vec![0.0, 1.0, 10.0, 11.0, 20.0, 21.0] };
        for _ in 0..6 {
            lines.rotate_left(1);
            lines.swap(0, 3);
            let (heights, period) = of(&format!("# x y z\n{}\n", lines.join("\n"))).unwrap();
            assert_eq!(heights, expected);
            assert!((period[0] - 1.0).abs() < 2e-3 && period[1] == 4.0, "{period:?}");
        }
        assert!(of(&lines.join("\n").replace(' ', "\t")).is_ok());
    }

    #[test]
    fn what_is_no_regular_grid_is_refused_with_its_line() {
        let with = |change: &dyn Fn(&mut Vec<String>)| {
            let mut lines = lines();
            change(&mut lines);
            let fault = of(&lines.join("\n")).unwrap_err();
            format!("{} {} {}", fault.what, fault.label, fault.help.unwrap_or_default())
        };
        let told = with(&|lines| drop(lines.remove(3)));
        assert!(told.contains("1 of 3 × 2 points are missing, the first at (-0.66") && told.contains(", 7)"), "{told}");
        let told = with(&|lines| lines[4] = lines[0].clone());
        assert!(told.contains("lines 1 and 5 hold the same point (-1, 5)"), "{told}");
        let told = with(&|lines| lines[3] = "-0.6 7 11".to_owned());
        assert!(told.contains("line 4: the point (-0.6, 7)"), "{told}");
        let told = with(&|lines| lines[2] = "1 2".to_owned());
        assert!(told.contains("line 3 holds \"1 2\", not three"), "{told}");
        let told = with(&|lines| lines[0] = "-1 5 nan".to_owned());
        assert!(told.contains("line 1"), "{told}");
        assert!(with(&|lines| lines.truncate(2)).contains("too few"));
        // A line of points, and points at random.
        assert!(of("0 0 1\n1 0 1\n2 0 1\n3 0 1\n").is_err());
        assert!(of("0 0 1\n1.1 0.3 1\n2.3 0.9 1\n3.1 1.7 1\n").is_err());
    }
}
