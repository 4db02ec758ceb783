//! The unit cell, and the reduced basis of its lattice; or a window around an isolated contact.

use super::{LatticeError, Surroundings};
use crate::notation::number;
use crate::numeric::lanes::vectorised;
use fearless_simd::Simd;
use std::f64::consts::TAU;
use std::fmt;

/// The unit cell of a doubly periodic system, spanned by two vectors; or a window around an isolated contact, a rectangle whose
/// middle is the origin, beyond which the surface is free.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cell {
    a1: [f64; 2],
    a2: [f64; 2],
    /// Corner of a window, a point; `None` of a periodic cell.
    corner: Option<[f64; 2]>,
}

/// Largest projection of one cell vector on the other, over the length of the other: multiples are kept in 32 bits.
const MAX_SKEW: f64 = 1e9;

impl Cell {
    /// Cell spanned by `a1` and `a2` (lengths in the case's unit).
    ///
    /// # Errors
    /// [`LatticeError::FlatCell`] when the vectors span no area or are not finite, or the projection of one on the other is more
    /// than 10⁹ times as long as the other.
    pub fn new(a1: [f64; 2], a2: [f64; 2]) -> Result<Self, LatticeError> {
        let sine = cross(a1, a2) / (norm(a1) * norm(a2));
        let along = dot(a1, a2).abs() / dot(a1, a1).min(dot(a2, a2));
        if !(sine.is_finite() && sine.abs() > 1e-6 && along < MAX_SKEW) {
            return Err(LatticeError::FlatCell(a1, a2));
        }
        Ok(Self { a1, a2, corner: None })
    }

    /// The window of these sides along x and y (lengths) around an isolated contact.
    ///
    /// # Errors
    /// When a side is zero or not finite.
    pub fn window([width, height]: [f64; 2]) -> Result<Self, LatticeError> {
        Self::window_at([-0.5 * width, -0.5 * height], [width, height])
    }

    /// The window of these sides (lengths) with its corner at a point.
    ///
    /// # Errors
    /// When a side is zero or not finite.
    pub(crate) fn window_at(corner: [f64; 2], [width, height]: [f64; 2]) -> Result<Self, LatticeError> {
        Ok(Self { corner: Some(corner), ..Self::new([width, 0.0], [0.0, height])? })
    }

    /// Surroundings of the cell: nothing around a window.
    pub fn surroundings(&self) -> Surroundings {
        match self.corner {
            Some(_) => Surroundings::FreeSpace,
            None => Surroundings::Periodic,
        }
    }

    /// Sides of a window along x and y, lengths; `None` of a periodic cell.
    pub fn window_sides(&self) -> Option<[f64; 2]> {
        self.corner.map(|_| [self.a1[0], self.a2[1]])
    }

    /// Whether the cell is a window.
    fn is_isolated(&self) -> bool {
        self.surroundings() == Surroundings::FreeSpace
    }

    /// The 60° rhombus of the side `side`, a length.
    ///
    /// # Errors
    /// When `side` is zero or not finite.
    pub fn hexagonal(side: f64) -> Result<Self, LatticeError> {
        Self::new([side, 0.0], [0.5 * side, 0.75f64.sqrt() * side])
    }

    /// The square of the side `side`, a length.
    ///
    /// # Errors
    /// When `side` is zero or not finite.
    pub fn square(side: f64) -> Result<Self, LatticeError> {
        Self::new([side, 0.0], [0.0, side])
    }

    /// The cell vectors a₁, a₂, lengths.
    pub fn vectors(&self) -> [[f64; 2]; 2] {
        [self.a1, self.a2]
    }

    /// The reciprocal vectors b₁, b₂ with aᵢ·bⱼ = 2π δᵢⱼ, 1/length.
    pub fn reciprocal(&self) -> [[f64; 2]; 2] {
        let scale = TAU / cross(self.a1, self.a2);
        [[scale * self.a2[1], -scale * self.a2[0]], [-scale * self.a1[1], scale * self.a1[0]]]
    }

    /// The cell of the reciprocal lattice, spanned by b₁ and b₂ (1/length).
    #[must_use]
    pub fn dual(&self) -> Self {
        let [a1, a2] = self.reciprocal();
        Self { a1, a2, corner: None }
    }

    /// Whether a₁ and a₂ are at right angles, exactly.
    pub fn is_rectangular(&self) -> bool {
        let [a1, a2] = self.vectors();
        dot(a1, a2) == 0.0
    }

    /// Area |a₁ × a₂|, a length squared.
    pub fn area(&self) -> f64 {
        cross(self.a1, self.a2).abs()
    }

    /// The corner of the cell from which fractions count, a point: 0, or that of a window whose middle is 0.
    #[inline]
    pub fn corner(&self) -> [f64; 2] {
        self.corner.unwrap_or_default()
    }

    /// The point at the fractions s₁, s₂ of a₁ and a₂ from the [corner](Self::corner), lengths.
    #[inline]
    pub fn point(&self, s: [f64; 2]) -> [f64; 2] {
        let (vector, corner) = (self.vector(s), self.corner());
        [corner[0] + vector[0], corner[1] + vector[1]]
    }

    /// The fractions s₁, s₂ of a [point](Self::point).
    pub fn fractions(&self, x: [f64; 2]) -> [f64; 2] {
        let corner = self.corner();
        self.parts([x[0] - corner[0], x[1] - corner[1]])
    }

    /// The vector s₁ a₁ + s₂ a₂, lengths.
    #[inline]
    pub fn vector(&self, [s1, s2]: [f64; 2]) -> [f64; 2] {
        [s1 * self.a1[0] + s2 * self.a2[0], s1 * self.a1[1] + s2 * self.a2[1]]
    }

    /// The parts s₁, s₂ of a [vector](Self::vector).
    pub fn parts(&self, x: [f64; 2]) -> [f64; 2] {
        let determinant = cross(self.a1, self.a2);
        [cross(x, self.a2) / determinant, cross(self.a1, x) / determinant]
    }

    /// Whether a point, lengths, lies in a window or on its border, to 10⁻⁹ of a side; any point does in a periodic cell.
    pub fn contains(&self, place: [f64; 2]) -> bool {
        let within = |s: f64| (-1e-9..=1.0 + 1e-9).contains(&s);
        !self.is_isolated() || self.fractions(place).into_iter().all(within)
    }

    /// The nearest point of a window; of a periodic cell the point itself.
    pub(crate) fn nearest_point(&self, place: [f64; 2]) -> [f64; 2] {
        if self.is_isolated() { self.point(self.fractions(place).map(|s| s.clamp(0.0, 1.0))) } else { place }
    }

    /// The part of the `span` [s₁, s₂] of the line `origin` + s `direction`, from an origin in the cell, that lies in a window;
    /// lengths over that of the direction. Of a periodic cell the span itself.
    pub fn clipped(&self, origin: [f64; 2], direction: [f64; 2], span: [f64; 2]) -> [f64; 2] {
        if !self.is_isolated() {
            return span;
        }
        let (at, along) = (self.fractions(origin), self.parts(direction));
        span.map(|end| {
            let reach = |axis: usize| {
                let way = along[axis] * end;
                let room = if way > 0.0 { 1.0 - at[axis] } else { at[axis] };
                if way == 0.0 { 1.0 } else { (room / way.abs()).clamp(0.0, 1.0) }
            };
            end * reach(0).min(reach(1))
        })
    }

    /// The reduced basis of the same lattice (Lagrange–Gauss): its shortest vector, and the shortest one that
    /// completes it.
    pub fn reduced(&self) -> ReducedBasis {
        let (mut short, mut long) = ((self.a1, [1, 0]), (self.a2, [0, 1]));
        loop {
            if dot(long.0, long.0) < dot(short.0, short.0) {
                (short, long) = (long, short);
            }
            let whole = (dot(short.0, long.0) / dot(short.0, short.0)).round();
            if whole == 0.0 {
                break;
            }
            let multiple = whole as i32;
            long.0 = [0, 1].map(|k| long.0[k] - whole * short.0[k]);
            long.1 = [0, 1].map(|k| long.1[k] - multiple * short.1[k]);
            if dot(long.0, long.0) >= dot(short.0, short.0) * (1.0 - 1e-12) {
                break;
            }
        }
        ReducedBasis { cell: Self { a1: short.0, a2: long.0, corner: self.corner }, matrix: [short.1, long.1] }
    }
}

/// A reduced basis r₁, r₂ of a cell's lattice, in which the shortest equivalent vector is one of few candidates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReducedBasis {
    /// The cell spanned by r₁ and r₂.
    cell: Cell,
    /// Integers with rᵢ = Σⱼ `matrix[i][j]` aⱼ.
    matrix: [[i32; 2]; 2],
}

impl ReducedBasis {
    /// The cell spanned by r₁ and r₂.
    pub fn cell(&self) -> Cell {
        self.cell
    }

    /// A shortest lattice vector, lengths.
    pub fn short(&self) -> [f64; 2] {
        if norm(self.cell.a1) <= norm(self.cell.a2) { self.cell.a1 } else { self.cell.a2 }
    }

    /// Integers with rᵢ = Σⱼ `matrix[i][j]` aⱼ.
    pub(super) fn matrix(&self) -> [[i32; 2]; 2] {
        self.matrix
    }

    /// Length of the longer of r₁ and r₂.
    pub fn longer_side(&self) -> f64 {
        norm(self.cell.a1).max(norm(self.cell.a2))
    }

    /// The lattice vectors, one of each pair ±r, whose perpendicular bisectors bound the Wigner–Seitz cell: r₁, r₂ and the shorter
    /// diagonal.
    pub fn facets(&self) -> [[f64; 2]; 3] {
        let Cell { a1, a2, .. } = self.cell;
        let sign = if dot(a1, a2) > 0.0 { -1.0 } else { 1.0 };
        [a1, a2, [a1[0] + sign * a2[0], a1[1] + sign * a2[1]]]
    }

    /// The shortest vectors equivalent to s₁a₁ + s₂a₂ (all whose lengths agree to the relative `tolerance`), each with the multiples
    /// of a₁, a₂ that were subtracted.
    pub fn shortest(&self, [s1, s2]: [f64; 2], tolerance: f64) -> Vec<([f64; 2], [i32; 2])> {
        let candidates = self.candidates([s1, s2]);
        let least = candidates.iter().map(|&(x, _)| norm(x)).fold(f64::INFINITY, f64::min);
        candidates.into_iter().filter(|&(x, _)| norm(x) <= least * (1.0 + tolerance)).collect()
    }

    /// One shortest vector equivalent to s₁a₁ + s₂a₂: in a reduced cell one of the four corners around it is nearest. Of a window the
    /// vector itself.
    pub fn nearest(&self, s: [f64; 2]) -> [f64; 2] {
        let t = self.fractions(s);
        if self.cell.is_isolated() {
            return self.cell.vector(t);
        }
        let [u, v] = t.map(|t| t - t.floor());
        let (mut nearest, mut least) = ([0.0; 2], f64::INFINITY);
        for corner in [[u, v], [u - 1.0, v], [u, v - 1.0], [u - 1.0, v - 1.0]] {
            let x = self.cell.vector(corner);
            let square = x[0] * x[0] + x[1] * x[1];
            if square < least {
                (nearest, least) = (x, square);
            }
        }
        nearest
    }

    /// The squared lengths of the [nearest](Self::nearest) vectors equivalent to s a₁ + (t + k/`count`) a₂, k = 0, 1, …
    pub(crate) fn nearest_squares(&self, place: [f64; 2], count: usize, squares: &mut [f64]) {
        vectorised!(simd => self.nearest_squares_by(simd, place, count, squares));
    }

    #[inline(always)]
    fn nearest_squares_by<S: Simd>(&self, _: S, [s, t]: [f64; 2], count: usize, squares: &mut [f64]) {
        let Cell { a1, a2, .. } = self.cell;
        let ([u0, v0], [du, dv]) = (self.fractions([s, t]), self.fractions([0.0, 1.0]));
        for (k, square) in squares.iter_mut().enumerate() {
            let part = k as f64 / count as f64;
            let [u, v] = [u0 + part * du, v0 + part * dv];
            if self.cell.is_isolated() {
                let [x, y] = [u * a1[0] + v * a2[0], u * a1[1] + v * a2[1]];
                *square = x * x + y * y;
                continue;
            }
            let [u, v] = [u - u.floor(), v - v.floor()];
            let mut least = f64::INFINITY;
            for [a, b] in [[u, v], [u - 1.0, v], [u, v - 1.0], [u - 1.0, v - 1.0]] {
                let [x, y] = [a * a1[0] + b * a2[0], a * a1[1] + b * a2[1]];
                least = least.min(x * x + y * y);
            }
            *square = least;
        }
    }

    /// All lattice vectors up to the length `reach`, with a tolerance of 10⁻⁹.
    pub fn vectors_within(&self, reach: f64) -> Vec<[f64; 2]> {
        // In a reduced basis |m₁r₁ + m₂r₂|² ≥ ½ (m₁²|r₁|² + m₂²|r₂|²).
        let most = [self.cell.a1, self.cell.a2].map(|r| (reach * 2f64.sqrt() / norm(r)).ceil() as i32);
        let multiples = (-most[0]..=most[0]).flat_map(|i| (-most[1]..=most[1]).map(move |j| [i, j].map(f64::from)));
        multiples.map(|m| self.cell.vector(m)).filter(|&x| norm(x) <= reach * (1.0 + 1e-9)).collect()
    }

    /// Fractions of r₁, r₂ of the vector s₁a₁ + s₂a₂: the inverse of an integer matrix of determinant ±1 is one too.
    fn fractions(&self, [s1, s2]: [f64; 2]) -> [f64; 2] {
        let [[m11, m12], [m21, m22]] = self.matrix.map(|row| row.map(f64::from));
        let determinant = m11 * m22 - m12 * m21;
        [(m22 * s1 - m21 * s2) * determinant, (m11 * s2 - m12 * s1) * determinant]
    }

    /// Nine equivalent vectors among which are all shortest ones, each with the multiples of a₁, a₂ that were subtracted.
    fn candidates(&self, s: [f64; 2]) -> [([f64; 2], [i32; 2]); 9] {
        let t = self.fractions(s);
        let whole = t.map(f64::round);
        std::array::from_fn(|k| {
            let shift = [whole[0] + (k / 3) as f64 - 1.0, whole[1] + (k % 3) as f64 - 1.0];
            let [n1, n2] = shift.map(|n| n as i32);
            let taken = [0, 1].map(|j| n1 * self.matrix[0][j] + n2 * self.matrix[1][j]);
            (self.cell.vector([t[0] - shift[0], t[1] - shift[1]]), taken)
        })
    }
}

impl fmt::Display for Cell {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ([x1, y1], [x2, y2]) = (self.a1, self.a2);
        let [x1, y1, x2, y2, area] = [x1, y1, x2, y2, self.area()].map(number);
        if self.is_isolated() {
            return write!(f, "window of {x1} × {y2} around an isolated contact");
        }
        write!(f, "cell a₁ = ({x1}, {y1}), a₂ = ({x2}, {y2}), area {area}")
    }
}

fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

pub(super) fn norm(a: [f64; 2]) -> f64 {
    a[0].hypot(a[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reciprocal_vectors_are_dual_to_the_cell() {
        let cell = Cell::new([1.3, 0.2], [-0.4, 0.9]).unwrap();
        for (i, a) in cell.vectors().iter().enumerate() {
            for (j, b) in cell.reciprocal().iter().enumerate() {
                let expected = if i == j { TAU } else { 0.0 };
                assert!((a[0] * b[0] + a[1] * b[1] - expected).abs() < 1e-14);
            }
        }
        let s = cell.fractions(cell.point([0.3, -1.7]));
        assert!((s[0] - 0.3).abs() < 1e-14 && (s[1] + 1.7).abs() < 1e-14);
    }

    #[test]
    fn the_reduced_cell_finds_the_shortest_equivalent_however_skewed_the_cell() {
        for (cell, reach) in [(Cell::new([1.0, 0.0], [2.3, 0.4]), 9), (Cell::new([0.3, 0.1], [-15.2, 0.7]), 60)] {
            let cell = cell.unwrap();
            let reduced = cell.reduced();
            assert!((reduced.cell.area() / cell.area() - 1.0).abs() < 1e-12);
            for k in 0..60 {
                let s = [f64::from(k % 7) / 7.0 - 0.4, f64::from(k / 7) / 8.0 - 0.5];
                let at = |m: [i32; 2]| cell.point([s[0] - f64::from(m[0]), s[1] - f64::from(m[1])]);
                let wide = (-reach..=reach).flat_map(|i| (-reach..=reach).map(move |j| [i, j]));
                let true_shortest = wide.map(|m| norm(at(m))).fold(f64::INFINITY, f64::min);
                assert!((norm(reduced.nearest(s)) - true_shortest).abs() < 1e-12);
                for (x, taken) in reduced.shortest(s, 1e-9) {
                    assert!((norm(x) - true_shortest).abs() < 1e-8);
                    let y = at(taken);
                    assert!((x[0] - y[0]).abs() < 1e-12 && (x[1] - y[1]).abs() < 1e-12);
                }
            }
        }
    }

    #[test]
    fn the_middle_of_a_window_is_the_origin_and_nothing_in_it_is_periodic() {
        let window = Cell::window([3.0, 2.0]).unwrap();
        assert_eq!((window.point([0.5, 0.5]), window.point([0.0, 0.0])), ([0.0; 2], [-1.5, -1.0]));
        assert_eq!((window.fractions([0.0; 2]), window.vector([0.5, 0.5])), ([0.5; 2], [1.5, 1.0]));
        let reduced = window.reduced();
        assert_eq!(reduced.nearest([0.9, -0.9]), [2.7, -1.8]);
        let mut squares = [0.0; 2];
        reduced.nearest_squares([-0.8, 0.0], 2, &mut squares);
        assert!((squares[0] - 5.76).abs() < 1e-14 && (squares[1] - 6.76).abs() < 1e-14, "{squares:?}");
        assert!(window != Cell::new([3.0, 0.0], [0.0, 2.0]).unwrap() && Cell::window([1.0, 0.0]).is_err());
    }

    #[test]
    fn a_line_is_clipped_to_a_window_and_not_to_a_periodic_cell() {
        let window = Cell::window([4.0, 2.0]).unwrap();
        assert!(window.contains([2.0, -1.0]) && !window.contains([2.1, 0.0]) && !window.contains([0.0, -1.01]));
        let is = |found: [f64; 2], known: [f64; 2]| {
            assert!((0..2).all(|k| (found[k] - known[k]).abs() < 1e-14), "{found:?}")
        };
        is(window.nearest_point([2.5, 0.3]), [2.0, 0.3]);
        is(window.clipped([1.0, 0.0], [1.0, 0.0], [-5.0, 0.5]), [-3.0, 0.5]);
        is(window.clipped([0.0, 0.5], [0.6, -0.8], [-5.0, 5.0]), [-0.625, 1.875]);
        is(window.clipped([0.0, -1.0], [0.0, 1.0], [-1.0, 3.0]), [0.0, 2.0]);
        let periodic = Cell::square(1.0).unwrap();
        assert!(periodic.contains([7.0, -3.0]) && periodic.nearest_point([7.0, -3.0]) == [7.0, -3.0]);
        assert_eq!(periodic.clipped([0.0; 2], [1.0, 0.0], [-5.0, 5.0]), [-5.0, 5.0]);
    }

    #[test]
    fn tied_vectors_are_all_found() {
        let hexagonal = Cell::hexagonal(1.0).unwrap().reduced();
        assert_eq!(hexagonal.shortest([1.0 / 3.0, 1.0 / 3.0], 1e-9).len(), 3);
        assert_eq!(hexagonal.shortest([0.5, 0.0], 1e-9).len(), 2);
        assert_eq!(Cell::square(1.0).unwrap().reduced().shortest([0.5, 0.5], 1e-9).len(), 4);
    }
}
