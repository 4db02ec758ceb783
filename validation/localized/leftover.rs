//! The part of the lattice that the circles of three levels leave out, predicted from point forces.
//!
//! Around level m a circle of radius R displaces the surface by more than the lattice does by
//!
//! ε_m = Σ_c P_c Σ_i K(r_i) − p̄ D_R(0) − Σ_c P_c S₁/(πE*) − (π/2A) K(R) Σ_c M_c,
//!
//! r_i to the images of level c inside, S₁ from level c to level m without the indenter itself. The last term is what
//! the second moments M = 2Pa²/5 of the indenters outside would add, A the area of the cell: the pressure p̄ has none.
//! Divided by the stiffness of the contacts ε moves loads and penetration ([`crate::exact::localization::shifts`]).

use crate::StudyError;
use crate::exact::lattice_sums::layered_triangular;
use crate::exact::localization::shifts;
use percoat_core::body::HalfSpace;
use percoat_core::comparison::Answer;
use percoat_core::lattice::Lattice;
use percoat_core::localized::circle::Circle;
use percoat_core::localized::disc;
use percoat_core::localized::point::PointKernel;
use percoat_core::reading::LevelReading;
use std::f64::consts::PI;

/// Three levels on a hexagonal lattice of unit period, as the spectral solution finds them.
pub struct Leftover<'a> {
    lattice: &'a Lattice,
    kernel: PointKernel,
    /// E* of the surface material.
    modulus: f64,
    /// S₁ of the images from level c to level m.
    sums: Vec<Vec<f64>>,
    answer: Answer,
    mean_pressure: f64,
}

/// Changes by a circle.
pub struct Shift {
    /// Load shares, absolute, level by level.
    pub shares: Vec<f64>,
    /// Penetration, relative.
    pub penetration: f64,
}

/// Changes by load-balanced circles, shell by shell.
pub struct Shells {
    /// Indenters, largest change of a load share and largest relative one of a level's load, for every whole shell.
    pub every: Vec<[f64; 3]>,
    /// Largest relative change of a level's load over the shells asked for.
    pub worst: f64,
}

impl<'a> Leftover<'a> {
    /// Prediction for circles of up to `most` indenters; the spectral solution's `answer` under the mean pressure.
    pub fn new(
        lattice: &'a Lattice,
        half_space: &HalfSpace,
        most: usize,
        answer: Answer,
        mean_pressure: f64,
    ) -> Result<Self, StudyError> {
        let transfer = half_space.response();
        let layer = half_space.layers().first().ok_or("a coating is needed")?;
        let triangular = |period| layered_triangular(|q| transfer.correction(q), layer.thickness(), period);
        let same = triangular(3f64.sqrt());
        let other = triangular(1.0).other_sublattice(same);
        let kernel = PointKernel::new(half_space, 2.0 * ((most as f64).sqrt() + 2.0));
        // The indenter's own layer is no image.
        let images = same.0[0] - kernel.correction(0.0);
        let sum = |m: usize, c: usize| if m == c { images } else { other.0[0] };
        Ok(Self {
            lattice,
            kernel,
            modulus: half_space.surface_material().contact_modulus(),
            sums: (0..3).map(|m| (0..3).map(|c| sum(m, c)).collect()).collect(),
            answer,
            mean_pressure,
        })
    }

    /// Changes by load-balanced circles of at least so many indenters.
    pub fn of(&self, indenters: usize) -> Result<Shift, StudyError> {
        let loads: Vec<f64> = self.answer.levels.iter().map(|level| level.load).collect();
        let radii: Vec<f64> = self.answer.levels.iter().map(radius).collect();
        let errors: Vec<f64> = (0..3).map(|m| self.error(m, indenters, &loads)).collect();
        // The layer under a contact: C at the mean distance of two points of a stamp's pressure, r² = 4a²/3.
        let mut sums = self.sums.clone();
        for (m, radius) in radii.iter().enumerate() {
            sums[m][m] += self.kernel.correction((4f64 / 3.0).sqrt() * radius);
        }
        let (moved, penetration) =
            shifts(&radii, &sums, self.modulus, &errors).ok_or("the levels' stiffness is singular")?;
        let whole: f64 = loads.iter().sum();
        Ok(Shift {
            shares: moved.into_iter().map(|load| load / whole).collect(),
            penetration: penetration / self.answer.penetration,
        })
    }

    /// All whole shells up to the larger number of indenters, the worst of those between both.
    pub fn shells(&self, [least, most]: [usize; 2]) -> Result<Shells, StudyError> {
        let (mut every, mut asked) = (Vec::new(), 1);
        while asked <= most {
            let inside = self.indenters(asked);
            let shares = self.of(inside)?.shares;
            let largest = |of: &dyn Fn(usize) -> f64| (0..shares.len()).map(|m| of(m).abs()).fold(0.0, f64::max);
            let relative = largest(&|m| shares[m] / self.answer.levels[m].load_share);
            every.push([inside as f64, largest(&|m| shares[m]), relative]);
            asked = inside + 1;
        }
        let among = every.iter().filter(|shell| shell[0] >= least as f64);
        let worst = among.map(|shell| shell[2]).fold(0.0, f64::max);
        Ok(Shells { every, worst })
    }

    /// Indenters in whole shells, at least so many.
    pub fn indenters(&self, asked: usize) -> usize {
        Circle::new(self.lattice, &self.lattice.sites().concat(), 0, asked).indenters()
    }

    /// ε_m, a length.
    fn error(&self, m: usize, indenters: usize, loads: &[f64]) -> f64 {
        let places = self.lattice.sites().concat();
        let circle = Circle::new(self.lattice, &places, m, indenters);
        let outer = circle.load_balanced(loads, self.mean_pressure);
        let moments: f64 = self.answer.levels.iter().map(|level| 0.4 * level.load * radius(level).powi(2)).sum();
        let mut error = -self.mean_pressure * disc::displacement(&self.kernel, outer, 0.0);
        error -= 0.5 * PI / self.lattice.cell().area() * self.kernel.at(outer) * moments;
        for (c, images) in circle.images.iter().enumerate() {
            let distances = images.iter().map(|[x, y]| x.hypot(*y)).filter(|r| *r > 0.0);
            let inside: f64 = distances.map(|r| self.kernel.at(r)).sum();
            error += loads[c] * (inside - self.sums[m][c] / (PI * self.modulus));
        }
        error
    }
}

/// The contact radius, not a number for merged contacts.
fn radius(level: &LevelReading) -> f64 {
    level.contact_radius.unwrap_or(f64::NAN)
}
