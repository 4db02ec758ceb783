//! The first Brillouin zone of a grid's samples: the wavevectors that the grid distinguishes.
//!
//! The index (k₁, k₂) of a Fourier component means the wavevector k₁**b**₁ + k₂**b**₂ up to multiples of N₁**b**₁ and
//! N₂**b**₂ (its aliases). Those of least length fill the zone |**q**·**g**| ≤ ½g², for all reciprocal vectors **g** of the
//! samples.

use super::{Cell, LatticeError, ReducedBasis};

/// The first Brillouin zone of N₁ × N₂ samples on a cell.
#[derive(Debug, Clone)]
pub(crate) struct BrillouinZone {
    cell: Cell,
    points: [usize; 2],
    /// Reduced basis of the lattice of N₁**b**₁, N₂**b**₂, by whose vectors aliases differ.
    sampling: ReducedBasis,
}

impl BrillouinZone {
    /// Zone of `points` = [N₁, N₂] samples along a₁ and a₂, neither of them zero.
    pub fn new(cell: Cell, points: [usize; 2]) -> Result<Self, LatticeError> {
        let [b1, b2] = cell.reciprocal();
        let [n1, n2] = points.map(|n| n as f64);
        let sampling = [[n1 * b1[0], n1 * b1[1]], [n2 * b2[0], n2 * b2[1]]];
        let sampling = Cell::new(sampling[0], sampling[1])?.reduced();
        Ok(Self { cell, points, sampling })
    }

    /// The unit cell.
    pub fn cell(&self) -> Cell {
        self.cell
    }

    /// Number of samples [N₁, N₂] along a₁ and a₂.
    pub fn points(&self) -> [usize; 2] {
        self.points
    }

    /// The shortest alias of the component (k₁, k₂), 1/length.
    pub fn wavevector(&self, component: [usize; 2]) -> [f64; 2] {
        self.sampling.nearest(self.fractions_of(component))
    }

    /// Squared lengths of the [shortest aliases](Self::wavevector) of the components (k₁, k₂), (k₁, k₂ + 1), … from the
    /// `first` on, 1/length².
    pub fn squares(&self, first: [usize; 2], squares: &mut [f64]) {
        self.sampling.nearest_squares(self.fractions_of(first), self.points[1], squares);
    }

    /// A component as fractions of N₁b₁ and N₂b₂.
    fn fractions_of(&self, component: [usize; 2]) -> [f64; 2] {
        [0, 1].map(|axis| component[axis] as f64 / self.points[axis] as f64)
    }

    /// All shortest aliases of the component (k₁, k₂) whose lengths agree to the relative `tolerance`, each with the
    /// multiples of b₁, b₂ it is made of.
    pub fn tied_wavevectors(&self, component: [usize; 2], tolerance: f64) -> Vec<([i32; 2], [f64; 2])> {
        let aliases = self.sampling.shortest(self.fractions_of(component), tolerance).into_iter();
        let index = |taken: [i32; 2]| [0, 1].map(|k| component[k] as i32 - taken[k] * self.points[k] as i32);
        aliases.map(|(q, taken)| (index(taken), q)).collect()
    }

    /// Reciprocal vectors of the samples, one of each pair ±**g**, whose bisectors bound the zone, 1/length.
    pub fn facets(&self) -> [[f64; 2]; 3] {
        self.sampling.facets()
    }

    /// The shortest of the [facets](Self::facets), 1/length.
    pub fn shortest_facet(&self) -> [f64; 2] {
        self.sampling.short()
    }

    /// Whether a wavevector lies on the border, to the relative `tolerance`, or outside the zone.
    pub fn on_border(&self, [x, y]: [f64; 2], tolerance: f64) -> bool {
        let outside = |[gx, gy]: [f64; 2]| (x * gx + y * gy).abs() > 0.5 * (1.0 - tolerance) * (gx * gx + gy * gy);
        self.facets().into_iter().any(outside)
    }
}
