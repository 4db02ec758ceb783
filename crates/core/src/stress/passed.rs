//! Waves of a grid, and their amplitudes in a body that relaxes, below a load that moves over it.

use crate::body::{Amplitudes, Antiplane, Depth, HalfSpace, InPlane, PassedTable};
use crate::lattice::Grid;
use crate::lattice::waves::Waves;
use rustfft::num_complex::Complex64;
use std::sync::Arc;

/// A body that a load passes, for the waves of a grid.
#[derive(Debug)]
pub(super) struct Passed {
    grid: Arc<Grid>,
    half_space: HalfSpace,
    velocity: [f64; 2],
    slides: bool,
    /// Waves in shells of one wavenumber and one component along the motion.
    waves: Arc<Waves>,
    table: PassedTable,
}

impl Passed {
    /// Table for the waves of a grid below a load of this velocity, lengths per time, with shear tractions where it `slides`.
    pub fn new(grid: &Arc<Grid>, half_space: &HalfSpace, (velocity, slides): ([f64; 2], bool)) -> Self {
        let speed = velocity[0].hypot(velocity[1]);
        let (waves, along) = grid.waves().passed_along(velocity.map(|v| v / speed));
        let table = PassedTable::new(half_space, waves.wavenumbers(), &along, (speed, slides));
        let (grid, half_space, waves) = (Arc::clone(grid), half_space.clone(), Arc::new(waves));
        Self { grid, half_space, velocity, slides, waves, table }
    }

    /// The grid.
    pub fn grid(&self) -> &Arc<Grid> {
        &self.grid
    }

    /// Whether the table is that of a body below such a load.
    pub fn is_of(&self, half_space: &HalfSpace, velocity: [f64; 2], slides: bool) -> bool {
        self.velocity == velocity && self.slides == slides && self.half_space == *half_space
    }

    /// Waves in shells of one wavenumber and one component along the motion.
    pub fn waves(&self) -> &Arc<Waves> {
        &self.waves
    }

    /// Speed, a length per time.
    pub fn speed(&self) -> f64 {
        self.velocity[0].hypot(self.velocity[1])
    }

    /// Unit vector of the motion.
    pub fn direction(&self) -> [f64; 2] {
        self.velocity.map(|v| v / self.speed())
    }

    /// Real and imaginary parts of the amplitudes of the first `count` shells at a depth, of waves with a positive component along the motion.
    pub fn amplitudes(&self, traction: InPlane, count: usize, depth: Depth) -> [Vec<Amplitudes>; 2] {
        let all = self.table.amplitudes(traction, count, depth);
        let part = |of: fn(Complex64) -> f64| {
            let each = |a: &Amplitudes<Complex64>| Amplitudes {
                szz: of(a.szz),
                sqz: of(a.sqz),
                sqq: of(a.sqq),
                stt: of(a.stt),
                uz: of(a.uz),
                uq: of(a.uq),
            };
            all.iter().map(each).collect()
        };
        [part(|x| x.re), part(|x| x.im)]
    }

    /// Real and imaginary parts of the amplitudes under a shear traction across the wavevector, as [`Self::amplitudes`].
    pub fn antiplane(&self, count: usize, depth: Depth) -> [Vec<Antiplane>; 2] {
        let all = self.table.antiplane(count, depth);
        let part = |of: fn(Complex64) -> f64| {
            let each = |a: &Antiplane<Complex64>| Antiplane { stz: of(a.stz), sqt: of(a.sqt), ut: of(a.ut) };
            all.iter().map(each).collect()
        };
        [part(|x| x.re), part(|x| x.im)]
    }
}
