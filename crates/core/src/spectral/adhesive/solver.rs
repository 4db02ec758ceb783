//! Surfaces that adhere, from load to load, with the errors of the grid.
//!
//! The same path is followed on the next coarser grid where that resolves the zone that pulls beside contact; the difference is the error of the grid.

use super::track::{Aim, Numbers, Track};
use super::walk::{Jump, Met, PullOff, Way};
use crate::adhesion::{Adhesion, AdhesionError};
use crate::counterbody::Surface;
use crate::lattice::{Grid, LatticeError};
use crate::load::Load;
use crate::notation::number;
use crate::problem::Problem;
use crate::spectral::Step;
use crate::spectral::iteration::{Method, Progress, Settings, Stop};
use crate::spectral::solver::nested_points;
use std::fmt;
use std::ops::ControlFlow;
use std::sync::Arc;

/// Fewest samples across the zone that pulls, below which its border locks on the grid.
pub const FEWEST_ACROSS: f64 = 1.5;
/// Samples across the zone that pulls below which forces are several per cent off.
pub const FEW_ACROSS: f64 = 3.0;

/// Relative error of a grid with so many samples across the zone that pulls: spheres on bare half-spaces against Maugis' theory, 1.4 to 20
/// samples.
pub fn zone_law(samples: f64) -> f64 {
    0.012 / samples
}

/// Why surfaces that adhere cannot be solved for.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum AdhesiveError {
    /// The problem has no adhesion.
    #[error("the problem has no adhesion")]
    None,
    /// The surfaces may not adhere.
    #[error(transparent)]
    Refused(#[from] AdhesionError),
    /// A contact that sticks and slips.
    #[error("partial slip of surfaces that adhere is not solved: let them slide, or leave adhesion out")]
    Sticks,
    /// A grip of surfaces that do not adhere.
    #[error("a grip is for surfaces that adhere: prescribe a penetration")]
    Grip,
    /// A machine without a stiffness.
    #[error("the stiffness of a machine must be greater than 0, not {0}")]
    Stiffness(f64),
    /// The grid does not resolve the zone that pulls.
    #[error(
        "the zone in which the surfaces pull beside contact, π/4 E*w/σ₀² = {} wide, has {} samples of the grid, and its border would lock on \
         them; take {} times as many points along each direction, or a range of {} or more", number(*.zone), number(*.samples), number(*.factor),
         number(*.range)
    )]
    Unresolved {
        /// Width ℓ of the zone, a length.
        zone: f64,
        /// Samples across the zone.
        samples: f64,
        /// Factor for the points along each direction that gives enough.
        factor: f64,
        /// Range that the grid resolves, a length.
        range: f64,
    },
    /// The grid is refused.
    #[error(transparent)]
    Grid(#[from] LatticeError),
}

/// Surfaces that adhere, load after load: the state of the last load is where the next one begins.
#[derive(Debug)]
pub struct AdhesiveSolver {
    problem: Arc<Problem>,
    adhesion: Adhesion,
    fine: Followed,
    /// The same loads on the next coarser grid; `None` where that does not resolve the zone that pulls.
    coarser: Option<Followed>,
}

/// A path on one grid.
#[derive(Debug)]
struct Followed {
    track: Track,
    way: Way,
}

/// A step of surfaces that adhere.
#[derive(Debug, Clone)]
pub struct AdhesiveStep {
    /// The contact, with the pressure of contact and the tension as two fields.
    pub contact: Step,
    /// Numbers of the state.
    pub numbers: Numbers,
    /// Numbers on the next coarser grid; `None` without one.
    pub coarser: Option<Numbers>,
    /// Jumps on the way to this state.
    pub jumps: Vec<Jump>,
    /// Least force of the path so far, once it has been passed.
    pub pull_off: Option<PullOff>,
    /// The same on the next coarser grid.
    pub coarser_pull_off: Option<PullOff>,
    /// Work of the force on the way to this state, an energy, and what trapezoids between its states miss.
    pub work: [f64; 2],
    /// 1 − κ: how far the state is from instability, 1 of surfaces that do not soften; `None` of surfaces apart.
    pub stability: Option<f64>,
    /// Samples across the zone that pulls beside contact.
    pub samples: f64,
    /// States that were solved on the way to this one, which share the iterations: more than one where a step was halved.
    pub states: usize,
}

impl AdhesiveSolver {
    /// Surfaces of a problem with adhesion, on a grid of `points`.
    ///
    /// # Errors
    /// [`AdhesiveError`].
    pub fn new(
        problem: impl Into<Arc<Problem>>,
        points: [usize; 2],
        settings: Settings,
    ) -> Result<Self, AdhesiveError> {
        let problem = problem.into();
        let adhesion = *problem.adhesion().ok_or(AdhesiveError::None)?;
        problem.may_adhere()?;
        let grid = Grid::new(problem.cell(), points)?;
        check_grid(&problem, &grid)?;
        let followed = |points| -> Result<Followed, LatticeError> {
            Ok(Followed { track: Track::new(&problem, adhesion, points, settings)?, way: Way::new() })
        };
        let fine = followed(points)?;
        let line = problem.loaded_by().line();
        let coarse = nested_points(points, Method::Preconditioned, line).get(1).copied();
        let coarser = match coarse {
            Some(points) if samples(&problem, &Grid::new(problem.cell(), points)?) >= FEWEST_ACROSS => {
                Some(followed(points)?)
            }
            _ => None,
        };
        Ok(Self { adhesion, fine, coarser, problem })
    }

    /// The problem.
    pub fn problem(&self) -> &Arc<Problem> {
        &self.problem
    }

    /// The grid.
    pub fn grid(&self) -> &Arc<Grid> {
        self.fine.track.grid()
    }

    /// The counterbody's surface on it.
    pub fn surface(&self) -> &Arc<Surface> {
        self.fine.track.surface()
    }

    /// Forgets all steps: the next one begins from undeformed surfaces.
    pub fn begin_anew(&mut self) {
        [Some(&mut self.fine), self.coarser.as_mut()].into_iter().flatten().for_each(|path| path.way = Way::new());
    }

    /// Goes on to a load on the grid alone, without errors and stability; the reason where the state is not solved.
    pub(crate) fn follow(&mut self, load: Load) -> Result<Numbers, Stop> {
        let aim = Aim::of(load, self.problem.cell().area());
        let settings = (aim, self.adhesion.work(), self.adhesion.range());
        let Followed { track, way } = &mut self.fine;
        rayon::scope(|_| way.go(track, settings, &mut |_| ControlFlow::Continue(())));
        let state = way.present().expect("a state was found");
        if state.report.stop.solved() { Ok(state.numbers) } else { Err(state.report.stop) }
    }

    /// Samples across the zone that pulls beside contact.
    pub(crate) fn samples_across(&self) -> f64 {
        samples(&self.problem, self.grid())
    }

    /// Convolutions so far on both grids, as equivalents of one on the finer one.
    fn convolutions(&self) -> f64 {
        let samples = |path: &Followed| path.track.grid().points().iter().product::<usize>() as f64;
        let coarser = self.coarser.as_ref();
        let coarser = coarser.map_or(0.0, |path| path.track.convolutions() * samples(path) / samples(&self.fine));
        self.fine.track.convolutions() + coarser
    }

    /// Goes on to a load.
    pub fn advance(&mut self, load: Load) -> AdhesiveStep {
        self.advance_with_progress(load, &mut |_| ControlFlow::Continue(()))
    }

    /// Goes on to a load. Calls `progress` after each iteration; `Break` ends the step as interrupted.
    pub fn advance_with_progress(
        &mut self,
        load: Load,
        progress: &mut (dyn FnMut(Progress) -> ControlFlow<()> + Send),
    ) -> AdhesiveStep {
        rayon::scope(|_| self.advance_here(load, progress))
    }

    fn advance_here(
        &mut self,
        load: Load,
        progress: &mut (dyn FnMut(Progress) -> ControlFlow<()> + Send),
    ) -> AdhesiveStep {
        let aim = Aim::of(load, self.problem.cell().area());
        let settings = (aim, self.adhesion.work(), self.adhesion.range());
        let before = self.convolutions();
        let coarse = self.coarser.as_mut().map(|path| {
            path.way.go(&mut path.track, settings, progress);
            let state = path.way.present().expect("a state was found").clone();
            (path.track.step(&state, load, 0.0), state.numbers, path.way.pull_off)
        });
        let Met { jumps, work, missing, iterations, states } =
            self.fine.way.go(&mut self.fine.track, settings, progress);
        let state = self.fine.way.present().expect("a state was found").clone();
        let stability = self.fine.track.stability(&state);
        let convolutions = self.convolutions() - before;
        let mut contact = self.fine.track.step(&state, load, convolutions);
        contact.report.iterations = iterations;
        let samples = self.samples_across();
        let (coarser, coarser_pull_off) = match coarse {
            Some((step, numbers, pull_off)) => {
                contact = contact.with_coarser(step);
                (Some(numbers), pull_off)
            }
            None => (None, None),
        };
        AdhesiveStep {
            contact,
            numbers: state.numbers,
            coarser,
            jumps,
            pull_off: self.fine.way.pull_off,
            coarser_pull_off,
            work: [work, missing],
            stability,
            samples,
            states,
        }
    }
}

impl fmt::Display for AdhesiveSolver {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.grid())?;
        match &self.coarser {
            Some(coarser) => write!(f, "\nand for errors {}", coarser.track.grid()),
            None => Ok(()),
        }
    }
}

/// Samples of a grid across the zone that pulls beside contact; 0 without adhesion.
pub fn samples(problem: &Problem, grid: &Grid) -> f64 {
    let modulus = problem.bodies().contact_modulus();
    problem.adhesion().map_or(0.0, |adhesion| adhesion.cohesive_zone(modulus) / grid.spacing())
}

/// Checks that a grid resolves the zone that pulls beside contact.
///
/// # Errors
/// [`AdhesiveError::Unresolved`].
pub fn check_grid(problem: &Problem, grid: &Grid) -> Result<(), AdhesiveError> {
    let Some(adhesion) = problem.adhesion() else { return Ok(()) };
    let samples = samples(problem, grid);
    if samples >= FEWEST_ACROSS {
        return Ok(());
    }
    let zone = adhesion.cohesive_zone(problem.bodies().contact_modulus());
    let factor = FEWEST_ACROSS / samples;
    Err(AdhesiveError::Unresolved { zone, samples, factor, range: adhesion.range() * factor.sqrt() })
}
