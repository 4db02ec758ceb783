//! The part of the surface that a plot shows, and its distortion.

use percoat_core::lattice::{Cell, Surroundings};
use percoat_draw::number::short;

/// A rectangle of the surface, [first, last] along x and along y; lengths.
pub type Window = [[f64; 2]; 2];

/// Largest number of rows of cells of a slender cell.
const ROWS: f64 = 12.0;

/// A window and its distortion in a plot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// The rectangle.
    pub window: Window,
    /// Whether a whole cell does not fit into the window.
    pub is_part: bool,
}

impl View {
    /// Least and largest height over width of a plot: beyond, one axis is stretched. The label fits along the lowest plot.
    pub const ASPECT: [f64; 2] = [0.45, 1.6];

    /// A window of at least two by two cells around the middle of the unit cell, less for slender cells; the window of an isolated
    /// contact.
    pub fn cells(cell: Cell) -> Self {
        if cell.surroundings() == Surroundings::FreeSpace {
            return Self::one(cell);
        }
        let long = cell.reduced().longer_side();
        // Rows of cells are area/long apart; of a slender cell several are shown.
        let apart = cell.area() / long;
        let half = [long, 0.5 * (1.2 * long / apart).clamp(2.0, ROWS) * apart];
        // The longer vector of the reduced cell lies along x in all named lattices.
        let lies_along =
            |axis: usize| cell.vectors().iter().any(|a| a[1 - axis] == 0.0 && a[axis].abs() >= long * (1.0 - 1e-9));
        let half = match (lies_along(0), lies_along(1)) {
            (true, _) => half,
            // A slender cell along y has the window turned; any other cell has a square.
            (_, true) if long > ROWS * apart => [half[1], half[0]],
            _ => return Self::square(cell, long, apart),
        };
        Self { window: around(cell, half), is_part: false }
    }

    /// A window of one cell: the rectangle around it.
    pub fn one(cell: Cell) -> Self {
        let [[x1, y1], [x2, y2]] = cell.vectors();
        let corner = cell.corner();
        let window = [bounds(x1, x2).map(|x| corner[0] + x), bounds(y1, y2).map(|y| corner[1] + y)];
        let area: f64 = window.iter().map(|[first, last]| last - first).product();
        // An oblique slender cell would be a line in the rectangle around it.
        if area > ROWS * cell.area() {
            let long = cell.reduced().longer_side();
            return Self::square(cell, long, cell.area() / long);
        }
        Self { window, is_part: false }
    }

    /// A square around the middle of the cell, no wider than some rows of cells.
    fn square(cell: Cell, long: f64, apart: f64) -> Self {
        let most = 0.5 * ROWS * apart;
        Self { window: around(cell, [long.min(most); 2]), is_part: long > 2.0 * most }
    }

    /// Width or height of the view over that of a whole, the larger one.
    pub fn part_of(&self, whole: &Self) -> f64 {
        let length = |view: &Self, k: usize| view.window[k][1] - view.window[k][0];
        (length(self, 0) / length(whole, 0)).max(length(self, 1) / length(whole, 1))
    }

    /// Height over width of the plot.
    pub fn aspect(&self) -> f64 {
        self.true_aspect().clamp(Self::ASPECT[0], Self::ASPECT[1])
    }

    /// Ratio of the scales of y and x in the plot.
    pub fn stretch(&self) -> f64 {
        self.aspect() / self.true_aspect()
    }

    fn true_aspect(&self) -> f64 {
        let [width, height] = self.window.map(|[first, last]| last - first);
        height / width
    }

    /// Text of the caption on the distortion.
    pub fn words(&self) -> String {
        let stretch = self.stretch();
        let part = if self.is_part { " The middle of a slender cell." } else { "" };
        match stretch {
            s if s > 1.0 + 1e-9 => format!(" Not to scale: y is stretched by a factor of {}.{part}", times(s)),
            s if s < 1.0 - 1e-9 => format!(" Not to scale: x is stretched by a factor of {}.{part}", times(s.recip())),
            _ => part.to_owned(),
        }
    }
}

/// A factor with three digits.
fn times(stretch: f64) -> String {
    short(format!("{stretch:.2e}").parse().unwrap_or(stretch))
}

/// A window around the middle of a cell, with half its width and height.
fn around(cell: Cell, half: [f64; 2]) -> Window {
    let middle = cell.point([0.5, 0.5]);
    [0, 1].map(|k| [middle[k] - half[k], middle[k] + half[k]])
}

/// Least and largest coordinate of a cell's corners.
fn bounds(one: f64, other: f64) -> [f64; 2] {
    [one.min(0.0) + other.min(0.0), one.max(0.0) + other.max(0.0)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_window_of_one_cell_is_that_cell_where_it_is_a_rectangle() {
        let window = |a1, a2| View::one(Cell::new(a1, a2).unwrap()).window;
        assert_eq!(window([2.0, 0.0], [0.0, 3.0]), [[0.0, 2.0], [0.0, 3.0]]);
        assert_eq!(window([0.0, 2.0], [-3.0, 0.0]), [[-3.0, 0.0], [0.0, 2.0]]);
        assert_eq!(window([2.0, 0.0], [1.0, 1.5]), [[0.0, 3.0], [0.0, 1.5]]);
    }

    #[test]
    fn a_window_holds_two_cells_along_each_side_of_a_slender_one() {
        for cell in [Cell::new([0.1, 0.0], [0.0, 10.0]).unwrap(), Cell::new([10.0, 0.0], [0.0, 0.1]).unwrap()] {
            let [[x1, _], [_, y2]] = cell.vectors();
            let [width, height] = View::cells(cell).window.map(|[first, last]| last - first);
            assert!(width > 1.999 * x1 && height > 1.999 * y2, "{width} {height}");
        }
    }

    /// A plot of any cell has a bounded height and few cells, and a caption where it is not true to scale.
    #[test]
    fn plots_of_slender_cells_are_bounded_and_say_so() {
        let radians = [90.0, 60.0, 5.0, 0.1f64].map(f64::to_radians);
        for (angle, side) in radians.into_iter().flat_map(|angle| [1.0, 10.0, 1e3, 1e9].map(|side| (angle, side))) {
            for turn in [0.0, 0.7, 90f64.to_radians()] {
                let vector = |length: f64, angle: f64| [length * angle.cos(), length * angle.sin()];
                let Ok(cell) = Cell::new(vector(1.0, turn), vector(side, turn + angle)) else { continue };
                for view in [View::cells(cell), View::one(cell)] {
                    assert!((0.45..=1.6).contains(&view.aspect()), "{view:?}");
                    let [width, height] = view.window.map(|[first, last]| last - first);
                    // The most cells shown, whole or in parts.
                    assert!(width > 0.0 && width * height <= (2.0 * ROWS + 1e-6) * cell.area(), "{cell} {view:?}");
                    let is_true = (view.stretch() - 1.0).abs() < 1e-9;
                    assert_eq!(view.words().contains("Not to scale"), !is_true);
                }
            }
        }
        let words = |x: f64, y: f64| View::one(Cell::new([x, 0.0], [0.0, y]).unwrap()).words();
        assert_eq!([words(1.0, 1.0), words(2.0, 1.0)], ["", ""]);
        assert_eq!(words(10.0, 1.0), " Not to scale: y is stretched by a factor of 4.5.");
        assert_eq!(words(1.0, 8.0), " Not to scale: x is stretched by a factor of 5.");
    }
}
