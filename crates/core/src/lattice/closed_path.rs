//! Straight paths on a periodic cell: along a lattice vector they close.

use super::Cell;

/// Largest multiple of a cell vector in a lattice vector that a path is found to close after.
const MAX_MULTIPLE: i32 = 1000;
/// Largest sine of the angle between a path and the lattice vector after which it closes.
const TOLERANCE: f64 = 1e-9;

impl Cell {
    /// The shortest lattice vector n₁**a**₁ + n₂**a**₂ along a direction of any length, [n₁, n₂]: after it a straight path closes.
    /// `None` where multiples up to 1000 give no vector whose angle to the direction has a sine below 10⁻⁹: such a path covers the
    /// cell evenly.
    pub fn closing_vector(&self, direction: [f64; 2]) -> Option<[i32; 2]> {
        let parts = self.parts(direction);
        let larger = usize::from(parts[1].abs() > parts[0].abs());
        let (sign, slope) = (parts[larger].signum(), parts[1 - larger] / parts[larger].abs());
        let [x, y] = direction;
        (1..=MAX_MULTIPLE).find_map(|multiple| {
            let mut vector = [0; 2];
            (vector[larger], vector[1 - larger]) =
                (sign as i32 * multiple, (slope * f64::from(multiple)).round() as i32);
            let [u, v] = self.vector(vector.map(f64::from));
            ((x * v - y * u).abs() < TOLERANCE * x.hypot(y) * u.hypot(v)).then_some(vector)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_along_a_lattice_vector_closes_after_the_shortest_one() {
        for cell in [Cell::hexagonal(0.7), Cell::square(1e-6), Cell::new([1.0, 0.2], [1.7, 0.9])] {
            let cell = cell.unwrap();
            for vector in [[1, 0], [0, 1], [-1, 0], [0, -1], [1, 1], [1, -1], [-2, 1], [3, 5], [-31, 17]] {
                for factor in [1.0, 3.0, 0.3] {
                    let direction = cell.vector(vector.map(|n| factor * f64::from(n)));
                    assert_eq!(cell.closing_vector(direction), Some(vector), "{cell:?}");
                }
            }
        }
    }

    #[test]
    fn other_paths_do_not_close() {
        let cell = Cell::square(1.0).unwrap();
        for direction in [[1.0, 2f64.sqrt()], [1.0, 1e-7], [0.0, 0.0], [f64::NAN, 1.0], [1.0, f64::INFINITY]] {
            assert_eq!(cell.closing_vector(direction), None, "{direction:?}");
        }
    }
}
