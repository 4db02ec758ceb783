//! Amplitudes of the waves of a grid in a body that relaxes, below a load that moves over it.

use super::passed_shells::PassedShells;
use crate::body::{Amplitudes, Antiplane, Depth, HalfSpace, InPlane, PassedTable};
use rustfft::num_complex::Complex64;
use std::sync::Arc;

/// Meaning of the stresses of a body that relaxes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Meaning {
    /// Themselves.
    Stresses,
    /// The strains, by Hooke's law of the relaxed moduli.
    Strains,
}

/// A body that relaxes and that a load passes, for the waves of a grid.
#[derive(Debug)]
pub(super) struct Passed {
    shells: Arc<PassedShells>,
    half_space: HalfSpace,
    speed: f64,
    slides: bool,
    table: PassedTable,
}

impl Passed {
    /// Table for the waves in `shells` below a load of this speed, a length per time, with shear tractions where it `slides`.
    pub fn new(shells: &Arc<PassedShells>, half_space: &HalfSpace, (speed, slides): (f64, bool)) -> Self {
        let wavenumbers = shells.waves().wavenumbers();
        let table = PassedTable::new(half_space, wavenumbers, shells.along(), (speed, slides));
        Self { shells: Arc::clone(shells), half_space: half_space.clone(), speed, slides, table }
    }

    /// Whether the table is that of a body below such a load.
    pub fn is_of(&self, shells: &Arc<PassedShells>, half_space: &HalfSpace, (speed, slides): (f64, bool)) -> bool {
        self.shells.are(shells) && self.speed == speed && self.slides == slides && self.half_space == *half_space
    }

    /// Shells of the waves.
    pub fn shells(&self) -> &Arc<PassedShells> {
        &self.shells
    }

    /// Speed, a length per time.
    pub fn speed(&self) -> f64 {
        self.speed
    }

    /// Real and imaginary parts of the amplitudes of the first `count` shells at a depth, of waves with a positive component along the motion.
    pub fn amplitudes(&self, traction: InPlane, count: usize, depth: Depth, of: Meaning) -> [Vec<Amplitudes>; 2] {
        let mut all = self.table.amplitudes(traction, count, depth);
        if of == Meaning::Strains {
            self.table.hookean(&mut all, depth);
        }
        parts(&all)
    }

    /// Real and imaginary parts of the amplitudes under a shear traction across the wavevector, as [`Self::amplitudes`].
    pub fn antiplane(&self, count: usize, depth: Depth, of: Meaning) -> [Vec<Antiplane>; 2] {
        let mut all = self.table.antiplane(count, depth);
        if of == Meaning::Strains {
            self.table.hookean_across(&mut all, depth);
        }
        let part = |of: fn(Complex64) -> f64| {
            let each = |a: &Antiplane<Complex64>| Antiplane { stz: of(a.stz), sqt: of(a.sqt), ut: of(a.ut) };
            all.iter().map(each).collect()
        };
        [part(|x| x.re), part(|x| x.im)]
    }
}

/// Real and imaginary parts of amplitudes.
fn parts(all: &[Amplitudes<Complex64>]) -> [Vec<Amplitudes>; 2] {
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
