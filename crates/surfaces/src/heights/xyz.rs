//! Points `x y z`, one a line, on a regular grid along x and y, in any order: x along **a**₁, y along **a**₂.
//!
//! Coordinates of one column differ by rounding, those of neighbours by the spacing: the sorted ones are divided where they rise by
//! more than half of their largest rise. Every point must lie within a tenth of a spacing of a grid point, and every grid point
//! must have one point.

use super::fault::{Fault, Heights, MOST, fits, push};
use super::header::Header;
use super::lines::{Line, Lines};
use super::profile;
use super::text::FEW;
use std::io::BufRead;

/// Largest distance of a point from its grid point, in spacings.
const NEAR: f64 = 0.1;
/// Memory per point for a sorted coordinate, and for two grid points with a height and a line, bytes.
const PER_GRID_POINT: u64 = 40;
/// Memory per point, bytes: the point, its line, its grid point, a sorted coordinate, and the list while it grows.
const PER_POINT: u64 = 72;

/// A point and its line.
struct Point {
    at: [f64; 2],
    height: f64,
    line: usize,
}

/// Equally spaced coordinates.
#[derive(Debug, Clone, Copy)]
struct EvenAxis {
    first: f64,
    step: f64,
    count: usize,
}

impl EvenAxis {
    fn of(mut coordinates: Vec<f64>) -> Self {
        coordinates.sort_unstable_by(f64::total_cmp);
        let rises = || coordinates.windows(2).map(|pair| pair[1] - pair[0]);
        let half = 0.5 * rises().fold(0.0, f64::max);
        let count = 1 + rises().filter(|rise| *rise > half && half > 0.0).count();
        let (first, last) = (coordinates[0], coordinates[coordinates.len() - 1]);
        Self { first, step: (last - first) / (count.max(2) - 1) as f64, count }
    }

    /// Index of a coordinate; none away from every grid line.
    fn index(&self, x: f64) -> Option<usize> {
        let steps = if self.step > 0.0 { (x - self.first) / self.step } else { 0.0 };
        let index = steps.round();
        ((steps - index).abs() <= NEAR).then_some(index as usize)
    }

    fn at(&self, index: usize) -> f64 {
        self.first + index as f64 * self.step
    }
}

/// A regular grid of points.
#[derive(Debug)]
pub struct PointGrid {
    /// Heights, axis 0 along x, axis 1 along y.
    pub heights: Heights,
    /// Period along x and y: n times the spacing.
    pub period: [f64; 2],
}

/// Reads points from a file of `bytes` bytes, and its header.
pub fn read(reader: impl BufRead, bytes: u64) -> Result<(PointGrid, Header), Fault> {
    let mut lines = Lines::new(reader);
    let mut points = Vec::new();
    while let Some(Line { number: line, text, .. }) = lines.next_line()? {
        if points.is_empty() {
            // Before much is read, if the other lines are as long.
            fits(PER_POINT * (bytes / (text.len() as u64 + 1) + 1))?;
        }
        let parts = text.split(|c: char| c.is_whitespace() || c == ',' || c == ';').filter(|part| !part.is_empty());
        let number =
            |(k, part): (usize, &str)| part.parse().ok().filter(|x: &f64| x.is_finite() || k == 2 && x.is_nan());
        let numbers: Vec<Option<f64>> = parts.enumerate().map(number).collect();
        let [Some(x), Some(y), Some(height)] = numbers[..] else {
            let what = format!("line {line} does not hold three finite numbers x y z");
            let help = match numbers.len() {
                6 if !text.contains('.') => "if its commas are decimal ones, write points instead",
                _ => "remove a header, or begin its lines with #; write nan for a height that was not measured",
            };
            return Err(Fault::new(what, format!("line {line}")).help(help));
        };
        push(&mut points, Point { at: [x, y], height, line })?;
    }
    Ok((on_grid(&points)?, lines.header))
}

/// Points of a table whose first two columns form a regular grid; `None` where they do not. Refused where points are missing, and
/// with more than one height a point. `lines` are the numbers of the rows in the file; empty: they count from 1.
pub fn of_table(table: &Heights, lines: &[usize]) -> Option<Result<PointGrid, Fault>> {
    let [count, columns] = table.points;
    if !(3..=FEW).contains(&columns) || count < 4 {
        return None;
    }
    if let Err(fault) = fits(PER_POINT * count as u64) {
        return Some(Err(fault));
    }
    let rows = table.values.chunks_exact(columns).enumerate();
    let line = |k: usize| lines.get(k).copied().unwrap_or(k + 1);
    let points: Vec<Point> =
        rows.map(|(k, row)| Point { at: [row[0], row[1]], height: row[2], line: line(k) }).collect();
    if points.iter().any(|point| point.at.iter().any(|x| !x.is_finite())) {
        return None;
    }
    let axes = axes(&points);
    let [n1, n2] = axes.map(|axis| axis.count);
    if let Some(fault) = profile_along(&points, [n1, n2]) {
        return Some(Err(fault));
    }
    // A few small whole numbers fill a grid by chance.
    let most = if count < 9 { count } else { 2 * count };
    if n1.min(n2) < 2 || n1.max(n2) > count / 2 || !(count..=most).contains(&(n1 * n2)) {
        return None;
    }
    let mut taken = vec![false; n1 * n2];
    for point in &points {
        let place = axes[0].index(point.at[0])? * n2 + axes[1].index(point.at[1])?;
        if std::mem::replace(taken.get_mut(place)?, true) {
            return None;
        }
    }
    Some(match columns {
        3 => on_grid(&points),
        _ => Err(Fault::new(
            format!("holds lines of {columns} numbers, of which the first two are the places of a {n1} × {n2} grid"),
            "points with more than a height?",
        )
        .help("keep x, y and z of each point alone")),
    })
}

/// The fault of points on a line along x or y, one behind the other.
fn profile_along(points: &[Point], counts: [usize; 2]) -> Option<Fault> {
    let along = (0..2).find(|axis| counts[1 - axis] == 1)?;
    let places: Vec<f64> = points.iter().map(|point| point.at[along]).collect();
    let name = ["x", "y"][along];
    profile::is_ordered(places.iter())
        .then(|| profile::fault(&format!("{} points on a line along {name}", points.len())))
}

fn axes(points: &[Point]) -> [EvenAxis; 2] {
    [0, 1].map(|axis| EvenAxis::of(points.iter().map(|point| point.at[axis]).collect()))
}

/// The heights of points, and the period along x and y.
fn on_grid(points: &[Point]) -> Result<PointGrid, Fault> {
    if points.len() < 4 {
        return Err(Fault::new(format!("holds {} points, too few for a surface", points.len()), "too few points"));
    }
    fits(PER_GRID_POINT * points.len() as u64)?;
    let axes = axes(points);
    let counts = axes.map(|axis| axis.count);
    if let Some(fault) = profile_along(points, counts) {
        return Err(fault);
    }
    let mut values = vec![f64::NAN; 0];
    let mut lines_of = vec![0usize; 0];
    if counts.iter().all(|n| (2..=MOST).contains(n)) && counts[0] * counts[1] <= 2 * points.len() {
        values.resize(counts[0] * counts[1], f64::NAN);
        lines_of.resize(counts[0] * counts[1], 0);
    }
    for Point { at, height, line } in points {
        let place = axes[0].index(at[0]).zip(axes[1].index(at[1])).map(|(i, j)| i * counts[1] + j);
        let Some(place) = place.filter(|place| *place < values.len()) else {
            let what = format!(
                "line {line}: its point is off the grid of equal spacings along x and y ({} × {} points)",
                counts[0], counts[1]
            );
            return Err(Fault::new(what, format!("line {line}"))
                .help("every x must occur with every y, at equal distances: put the points on a regular grid before"));
        };
        if lines_of[place] != 0 {
            let what = format!("lines {} and {line} hold the same point", lines_of[place]);
            return Err(Fault::new(what, format!("line {line}")).help("give every point once"));
        }
        (values[place], lines_of[place]) = (*height, *line);
    }
    if let Some(place) = lines_of.iter().position(|line| *line == 0) {
        let [x, y] = [axes[0].at(place / counts[1]), axes[1].at(place % counts[1])];
        let missing = values.len() - points.len();
        let what = format!("{missing} of {} × {} points are missing, the first at ({x}, {y})", counts[0], counts[1]);
        return Err(
            Fault::new(what, "points are missing").help("write them with the height nan where they were not measured")
        );
    }
    Ok(PointGrid { heights: Heights::new(counts, values)?, period: axes.map(|axis| axis.count as f64 * axis.step) })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str) -> Result<(Heights, [f64; 2]), Fault> {
        read(text.as_bytes(), text.len() as u64).map(|(PointGrid { heights, period }, _)| (heights, period))
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
    fn a_height_without_a_measurement_is_nan() {
        let (heights, _) = of(&lines().join("\n").replace(" 11", " nan")).unwrap();
        assert!(heights.values.iter().enumerate().all(|(k, height)| height.is_nan() == (k == 3)), "{heights:?}");
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
        assert!(told.contains("lines 1 and 5 hold the same point"), "{told}");
        let told = with(&|lines| lines[3] = "-0.6 7 11".to_owned());
        assert!(told.contains("line 4: its point is off the grid"), "{told}");
        let told = with(&|lines| lines[2] = "1 2".to_owned());
        assert!(told.contains("line 3 does not hold three"), "{told}");
        let told = with(&|lines| lines[0] = "-1 nan 5".to_owned());
        assert!(told.contains("line 1"), "{told}");
        assert!(with(&|lines| lines.truncate(2)).contains("too few"));
        // A line of points, and points at random.
        assert!(of("0 0 1\n1 0 1\n2 0 1\n3 0 1\n").is_err());
        assert!(of("0 0 1\n1.1 0.3 1\n2.3 0.9 1\n3.1 1.7 1\n").is_err());
    }
}
