//! Meshes of square elements around the indenters' axes, and the influence of the pressures on one mesh on another.
//!
//! All spots of a solution have meshes of one element size e, centred on their axes, so that the displacement of the
//! spot m under the indenters of site c inside its circle is a sum over differences of element numbers,
//!
//! u_m(t) = Σ_s A_mc(t − s) p_c(s),  A_mc(Δ) = Σ_i w(Δe − r_i),
//!
//! w the influence coefficient of one element, r_i from the centre of the circle to the images of c inside it. Images
//! far from the mesh make a smooth contribution to A, which a Chebyshev series in both directions carries.

use super::square::Squares;
use crate::numeric::chebyshev::Chebyshev;
use crate::numeric::parallel;

/// A square mesh of `width` × `width` elements, the central one on the axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mesh {
    /// Number of elements along a side, odd.
    pub width: usize,
    /// Side of an element, a length.
    pub size: f64,
}

impl Mesh {
    /// Number of elements.
    pub fn elements(&self) -> usize {
        self.width * self.width
    }

    /// The mesh with half as many elements along a side, on about the same square.
    #[must_use]
    pub fn halved(&self) -> Self {
        Self { width: self.width.div_ceil(2) / 2 * 2 + 1, size: 2.0 * self.size }
    }

    /// Half the side of the mesh, a length.
    pub fn half(&self) -> f64 {
        0.5 * self.width as f64 * self.size
    }

    /// Largest distance of two elements' centres along a side, a length.
    pub fn span(&self) -> f64 {
        (self.width as f64 - 1.0).max(1.0) * self.size
    }

    /// Centre (x, y) of an element, measured from the axis: lengths.
    pub fn place(&self, index: usize) -> [f64; 2] {
        let middle = (self.width / 2) as f64;
        [(index / self.width) as f64, (index % self.width) as f64].map(|k| (k - middle) * self.size)
    }

    /// Whether an element lies on the rim of the mesh.
    pub fn on_rim(&self, index: usize) -> bool {
        [index / self.width, index % self.width].into_iter().any(|k| k == 0 || k == self.width - 1)
    }

    /// Bilinear interpolation of a field between the centres of the elements; 0 outside the mesh.
    pub fn interpolated(&self, field: &[f64], place: [f64; 2]) -> f64 {
        let [u, v] = place.map(|x| x / self.size + (self.width / 2) as f64);
        let value = |i: f64, j: f64| {
            let inside = |k: f64| (0.0..self.width as f64).contains(&k);
            if inside(i) && inside(j) { field[i as usize * self.width + j as usize] } else { 0.0 }
        };
        let (i, j) = (u.floor(), v.floor());
        let (s, t) = (u - i, v - j);
        (1.0 - s) * ((1.0 - t) * value(i, j) + t * value(i, j + 1.0))
            + s * ((1.0 - t) * value(i + 1.0, j) + t * value(i + 1.0, j + 1.0))
    }
}

/// Number of terms of the Chebyshev series in each direction.
const SERIES_TERMS: usize = 14;
/// Distance beyond which images enter the Chebyshev series, in half-sides of the table: the series then errs by 1e-11.
pub(super) const SERIES_DISTANCE: f64 = 3.5;

/// A smooth displacement as a function of (x, y).
pub(super) type Smooth<'a> = dyn Fn(f64, f64) -> f64 + Sync + 'a;

/// Influence table A_mc of one site's indenters on a spot.
#[derive(Debug, Clone)]
pub struct Influence {
    width: usize,
    /// A(Δ) for Δ from −(width−1) to width−1 along x and y, y fastest.
    table: Vec<f64>,
}

impl Influence {
    /// Influence on a spot of the indenters at the vectors `images` from it, and of those `outside`: the displacement at (x, y) from
    /// an element by unit pressure on all its images outside the circle.
    pub fn new(squares: &Squares<'_>, mesh: Mesh, images: &[[f64; 2]], outside: Option<&Smooth<'_>>) -> Self {
        let (side, last) = (2 * mesh.width - 1, mesh.width as f64 - 1.0);
        let half = mesh.span();
        let (far, near): (Vec<[f64; 2]>, Vec<[f64; 2]>) =
            images.iter().partition(|[x, y]| x.hypot(*y) > SERIES_DISTANCE * half);
        let under = |images: &[[f64; 2]], x: f64, y: f64| -> f64 {
            images.iter().map(|[u, v]| squares.coefficient(x - u, y - v)).sum()
        };
        let distant = |x, y| under(&far, x, y) + outside.map_or(0.0, |outside| outside(x, y));
        let nowhere = far.is_empty() && outside.is_none();
        let series = (!nowhere).then(|| ChebyshevProduct::new(half, distant));
        let offset = |k: usize| (k as f64 - last) * mesh.size;
        let mut table = vec![0.0; side * side];
        parallel::each_chunk(&mut table, side, |i, row| {
            let x = offset(i);
            let line = series.as_ref().map(|series| series.at(x / half));
            for (j, value) in row.iter_mut().enumerate() {
                let y = offset(j);
                let smooth = line.as_ref().map_or(0.0, |line| line.at(y / half));
                *value = under(&near, x, y) + smooth;
            }
        });
        Self { width: mesh.width, table }
    }

    /// A(0): displacement of an element under unit pressure on itself (and on its images).
    pub fn diagonal(&self) -> f64 {
        self.table[self.table.len() / 2]
    }

    /// Adds the displacement under `pressure` to `displacement`: one value per element each.
    pub fn add(&self, pressure: &[f64], displacement: &mut [f64]) {
        let (width, side) = (self.width, 2 * self.width - 1);
        let loaded: Vec<usize> =
            (0..width).filter(|&row| pressure[row * width..(row + 1) * width].iter().any(|&p| p != 0.0)).collect();
        parallel::each_chunk(displacement, width, |target, out| {
            for &source in &loaded {
                let row = &self.table[(target + width - 1 - source) * side..][..side];
                for (j, &p) in pressure[source * width..(source + 1) * width].iter().enumerate() {
                    if p != 0.0 {
                        for (u, a) in out.iter_mut().zip(&row[width - 1 - j..]) {
                            *u += p * a;
                        }
                    }
                }
            }
        });
    }
}

/// Chebyshev series of a smooth function on the square |x|, |y| ≤ half: one in x for each coefficient of the series in y.
struct ChebyshevProduct([Chebyshev<SERIES_TERMS>; SERIES_TERMS]);

impl ChebyshevProduct {
    fn new(half: f64, f: impl Fn(f64, f64) -> f64 + Sync) -> Self {
        let nodes = Chebyshev::<SERIES_TERMS>::nodes();
        let lines: Vec<Chebyshev<SERIES_TERMS>> =
            parallel::map_items(&nodes, |x| Chebyshev::of(|y| f(half * x, half * y)));
        Self(std::array::from_fn(|l| Chebyshev::through(&std::array::from_fn(|k| lines[k].coefficients()[l]))))
    }

    /// The series in y/half at x/half.
    fn at(&self, x: f64) -> Chebyshev<SERIES_TERMS> {
        Chebyshev::with(self.0.each_ref().map(|series| series.at(x)))
    }
}

#[cfg(test)]
mod tests {
    use super::super::point::PointKernel;
    use super::*;
    use crate::body::{HalfSpace, Interface, Layer, Material};

    #[test]
    fn tables_are_sums_of_coefficients_near_and_far() {
        let substrate = Material::from_young(1.0, 0.3).unwrap();
        let coating = Material::from_young(4.0, 0.2).unwrap();
        let half_space = HalfSpace::new(vec![Layer::new(coating, 0.3, Interface::Bonded).unwrap()], substrate);
        let kernel = PointKernel::new(&half_space, 20.0);
        let squares = Squares::new(&kernel, 0.02);
        let mesh = Mesh { width: 9, size: 0.04 };
        let images = [[0.0, 0.0], [1.0, 0.2], [-1.2, 0.1], [3.0, 4.0], [-5.0, 2.0]];
        let influence = Influence::new(&squares, mesh, &images, None);
        let mut pressure = vec![0.0; mesh.elements()];
        (pressure[3], pressure[40], pressure[57]) = (1.0, 0.5, 2.0);
        let mut displacement = vec![0.0; mesh.elements()];
        influence.add(&pressure, &mut displacement);
        for target in [0, 17, 40, 80] {
            let mut expected = 0.0;
            for (source, p) in pressure.iter().enumerate() {
                let (t, s) = (mesh.place(target), mesh.place(source));
                for r in images {
                    expected += p * squares.coefficient(t[0] - s[0] - r[0], t[1] - s[1] - r[1]);
                }
            }
            assert!((displacement[target] / expected - 1.0).abs() < 1e-10);
        }
    }
}
