//! Waves of a grid in shells whose waves have one response below a load that moves.

use crate::lattice::Grid;
use crate::lattice::waves::Waves;
use crate::numeric::parallel;
use std::sync::Arc;

/// Fewest shells of a parallel task.
const MIN_PARALLEL: usize = 512;

/// Waves of a grid in shells of one wavenumber and, below a load that moves, of one component along the motion.
#[derive(Debug)]
pub(super) struct PassedShells {
    grid: Arc<Grid>,
    /// Unit vector of the motion; `None` at rest.
    direction: Option<[f64; 2]>,
    waves: Arc<Waves>,
    /// Component along the motion of each shell, 1/length; none at rest.
    along: Vec<f64>,
}

impl PassedShells {
    /// Shells of the waves of a grid below a load that moves in a direction, a unit vector, or rests.
    pub fn new(grid: &Arc<Grid>, direction: Option<[f64; 2]>) -> Self {
        let (waves, along) = match direction {
            Some(direction) => {
                let (waves, along) = grid.waves().passed_along(direction);
                (Arc::new(waves), along)
            }
            None => (Arc::clone(grid.waves()), Vec::new()),
        };
        Self { grid: Arc::clone(grid), direction, waves, along }
    }

    /// Whether they are those of the waves of a grid below a load that moves in a direction, or rests.
    pub fn are_of(&self, grid: &Grid, direction: Option<[f64; 2]>) -> bool {
        self.direction == direction && self.grid.cell() == grid.cell() && self.grid.points() == grid.points()
    }

    /// Whether they are the same as others.
    pub fn are(&self, others: &Self) -> bool {
        std::ptr::eq(self, others) || self.are_of(&others.grid, others.direction)
    }

    /// Waves in these shells.
    pub fn waves(&self) -> &Arc<Waves> {
        &self.waves
    }

    /// Component along the motion of each shell, 1/length, not below 0; none at rest.
    pub fn along(&self) -> &[f64] {
        &self.along
    }

    /// Values of a function of a wavevector in axes along and across the motion, for each shell, of a component along it that is not below 0.
    pub fn map<T: Send + Sync>(&self, of: impl Fn([f64; 2]) -> T + Sync) -> Vec<T> {
        let of_shell = |shell: usize| {
            let q = self.waves.wavenumbers()[shell];
            let along = self.along.get(shell).copied().unwrap_or(0.0);
            of([along, ((q - along) * (q + along)).max(0.0).sqrt()])
        };
        parallel::map_by(MIN_PARALLEL, self.waves.wavenumbers().len(), of_shell)
    }

    /// Sign of the component of a wavevector along the motion.
    #[inline(always)]
    pub fn sign(&self, [x, y]: [f64; 2]) -> f64 {
        self.direction.map_or(1.0, |[ex, ey]| (x * ex + y * ey).signum())
    }
}
