//! Refinement: finer and finer grids until the results change by less than an accuracy.

use super::StepRecord;
use crate::lattice::Cell;
use crate::numeric::fourier::fast_points;
use crate::numeric::search::largest;
use crate::reading::Reading;
use crate::spectral::OtherGrids;
use crate::stress::Peak;
use std::fmt;

/// Points along the shorter cell vector of the first grid; fewer where the cell is too oblong for them.
const FIRST_POINTS: usize = 96;
/// Largest number of points along the longer cell vector.
const MOST_POINTS: usize = 4096;
/// Least number of points along the shorter cell vector of the first grid.
const LEAST_POINTS: usize = 12;

/// Numbers of points along the cell vectors: `points` along the shorter one, and as dense along the longer one.
pub fn balanced_points(cell: &Cell, points: usize) -> [usize; 2] {
    let lengths = cell.vectors().map(|a| a[0].hypot(a[1]));
    let shorter = lengths[0].min(lengths[1]);
    lengths.map(|length| fast_points((points as f64 * length / shorter).round() as usize))
}

/// Largest relative change between the load steps on two grids: of peak pressures (over the largest one), load shares,
/// mean pressure and penetration, of the largest stresses, and of the passes to the first damage. Pressures and stresses that are infinite
/// under a tip are left out.
pub fn change(coarse: &[StepRecord], fine: &[StepRecord]) -> f64 {
    let deepest = largest(fine.iter().map(|step| step.reading.penetration.abs()));
    let of = |(coarse, fine): (&StepRecord, &StepRecord)| {
        [step_change(coarse, fine, deepest), stress_change(coarse, fine), life_change(coarse, fine)]
    };
    largest(coarse.iter().zip(fine).flat_map(of))
}

/// The error of a cell too oblong for any grid of a refinement.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "the cell is {0:.0} times as long as wide: no grid of at most {MOST_POINTS} points along a side has {LEAST_POINTS} along the other; \
     give grid.points instead of grid.accuracy"
)]
pub struct TooOblong(f64);

/// Reason for which a refinement ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RefinementEnd {
    /// The last change is below the accuracy.
    Reached,
    /// The changes **stagnate**: extrapolated with the better of the last two rates, they fall below the accuracy on no grid in
    /// reach.
    Stagnates,
    /// The next grid would have more than 4096 points along a side.
    Finest,
    /// Memory or disk does not suffice for the next grid.
    Room,
}

impl fmt::Display for RefinementEnd {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Reached => f.write_str("it is reached"),
            Self::Stagnates => f.write_str("changes fall too slowly for any grid in reach"),
            Self::Finest => write!(f, "the next grid would have more than {MOST_POINTS} points along a side"),
            Self::Room => f.write_str("there is no room for the next grid, in memory or on disk"),
        }
    }
}

/// Finer and finer grids, until the results change by less than an accuracy or for another reason to [`RefinementEnd`].
#[derive(Debug, Clone)]
pub struct Refinement {
    accuracy: f64,
    /// All [grids](Refinement::grids) in reach.
    grids: Vec<[usize; 2]>,
    /// Index of the present grid.
    at: usize,
    /// Changes from grid to grid so far.
    changes: Vec<f64>,
}

impl Refinement {
    /// Refinement on a cell, to changes below `accuracy`.
    ///
    /// # Errors
    /// [`TooOblong`] when not even the first grid is allowed.
    pub fn new(cell: &Cell, accuracy: f64) -> Result<Self, TooOblong> {
        Ok(Self { accuracy, grids: Self::grids(cell)?, at: 0, changes: Vec::new() })
    }

    /// The refinement without its first grids, those that are too coarse; the last one is kept.
    pub(super) fn without(mut self, is_too_coarse: impl Fn([usize; 2]) -> bool) -> Self {
        let first = self.grids.iter().take_while(|points| is_too_coarse(**points)).count();
        self.grids.drain(..first.min(self.grids.len() - 1));
        self
    }

    /// All grids in reach on a cell, at least one: each twice as fine as the one before, as dense along both cell vectors.
    ///
    /// # Errors
    /// [`TooOblong`] when there is none.
    pub fn grids(cell: &Cell) -> Result<Vec<[usize; 2]>, TooOblong> {
        let lengths = cell.vectors().map(|a| a[0].hypot(a[1]));
        let ratio = lengths[0].max(lengths[1]) / lengths[0].min(lengths[1]);
        let first = FIRST_POINTS.min((MOST_POINTS as f64 / ratio) as usize);
        if first < LEAST_POINTS {
            return Err(TooOblong(ratio));
        }
        let grids = (0..).map(|times| balanced_points(cell, first << times));
        Ok(grids.take_while(|points| points.iter().all(|&n| n <= MOST_POINTS)).collect())
    }

    /// Resumes another refinement on the grid of `points`, with the changes between the grids before it.
    ///
    /// # Errors
    /// [`OtherGrids`] when there is no such grid, or another number of changes before it.
    pub fn go_on(&mut self, points: [usize; 2], changes: &[f64]) -> Result<(), OtherGrids> {
        let at = self.grids.iter().position(|grid| *grid == points).ok_or(OtherGrids)?;
        // The first grid has no change.
        if changes.len() != at.saturating_sub(1) {
            return Err(OtherGrids);
        }
        (self.at, self.changes) = (at, changes.to_vec());
        Ok(())
    }

    /// Whether the present grid is the first.
    pub(super) fn is_first(&self) -> bool {
        self.at == 0
    }

    /// The present grid.
    pub fn points(&self) -> [usize; 2] {
        self.grids[self.at]
    }

    /// Moves to the next grid, after the `change` on the present one (`None` on the first), or returns the reason of the end. `fits`:
    /// whether memory and disk suffice for a grid.
    pub fn refine(&mut self, change: Option<f64>, fits: impl Fn([usize; 2]) -> bool) -> Option<RefinementEnd> {
        self.changes.extend(change);
        let finer = self.grids.get(self.at + 1);
        if self.changes.last().is_some_and(|&change| change < self.accuracy) {
            return Some(RefinementEnd::Reached);
        }
        match finer {
            None => Some(RefinementEnd::Finest),
            Some(_) if self.stagnates() => Some(RefinementEnd::Stagnates),
            Some(&finer) if !fits(finer) => Some(RefinementEnd::Room),
            Some(_) => {
                self.at += 1;
                None
            }
        }
    }

    fn stagnates(&self) -> bool {
        let [.., first, second, last] = self.changes[..] else { return false };
        let fall = (second / first).min(last / second);
        let in_reach = self.grids.len() - self.at - 1;
        let best = last * fall.powi(in_reach as i32);
        // A change that is not a number stagnates too.
        best.partial_cmp(&self.accuracy) != Some(std::cmp::Ordering::Less)
    }
}

/// Largest relative change of the contact; `deepest`: the largest penetration of the path.
fn step_change(before: &StepRecord, now: &StepRecord, deepest: f64) -> f64 {
    let pulls = |step: &StepRecord| step.adhesion.as_ref().is_some_and(|adhesion| adhesion.adhesive_load > 0.0);
    let bears_nothing = |step: &StepRecord| step.reading.grid_peak() <= 0.0 && !pulls(step);
    if bears_nothing(now) {
        // A contact that vanishes is an infinite change.
        return if bears_nothing(before) { 0.0 } else { f64::INFINITY };
    }
    let (coarse, fine) = (&before.reading, &now.reading);
    let Scales { pressure, force, penetration } = Scales::of(now, deepest);
    let peak = if fine.singular() { 0.0 } else { (fine.grid_peak() - coarse.grid_peak()).abs() };
    let penetration = (fine.penetration - coarse.penetration).abs() / penetration;
    let load = (fine.force - coarse.force).abs() / force;
    let levels = coarse.levels.iter().zip(&fine.levels).flat_map(|(coarse, level)| {
        let peak = if level.singular() { 0.0 } else { (level.grid_peak() - coarse.grid_peak()).abs() };
        [peak / pressure, (level.load_share - coarse.load_share).abs()]
    });
    largest([peak / pressure, penetration, load].into_iter().chain(levels))
}

/// Pressure, force and penetration by which changes between two grids are divided.
struct Scales {
    pressure: f64,
    force: f64,
    penetration: f64,
}

impl Scales {
    /// The values themselves of surfaces that do not adhere. Where they do, values pass through zero: net pressures are measured by the
    /// tension too, net forces by those that press and pull, and penetrations by the largest one of the path, `deepest`.
    fn of(step: &StepRecord, deepest: f64) -> Self {
        let Reading { force, penetration, .. } = step.reading;
        let peak = step.reading.grid_peak();
        let Some(adhesion) = &step.adhesion else {
            return Self { pressure: peak, force, penetration: penetration.abs() };
        };
        let total = adhesion.contact_load + adhesion.adhesive_load;
        let pulls = adhesion.adhesive_load / (step.reading.contact_area + adhesion.cohesive_area);
        Self {
            pressure: if pulls.is_finite() { peak.abs().max(pulls) } else { peak.abs() },
            force: total,
            penetration: deepest.max(f64::MIN_POSITIVE),
        }
    }
}

/// Largest change of the largest τ₁, tension and von Mises, over the largest of them, and at least the excess of a rival peak of the
/// finer grid by its error; 0 without stresses.
fn stress_change(coarse: &StepRecord, fine: &StepRecord) -> f64 {
    let (Some(coarse), Some(fine)) = (&coarse.stress, &fine.stress) else { return 0.0 };
    let (coarse, fine) = (&coarse.overall, &fine.overall);
    let pairs = [(coarse.tau1, fine.tau1), (coarse.tension, fine.tension), (coarse.mises, fine.mises)];
    let comparable = || pairs.iter().filter(|(coarse, fine)| !(coarse.value.is_infinite() || fine.value.is_infinite()));
    let scale = largest(comparable().map(|(_, fine)| fine.value.abs()));
    let beyond = |fine: &Peak| fine.rival.map_or(0.0, |rival| rival.top() - fine.value);
    let change = largest(comparable().flat_map(|(coarse, fine)| [(fine.value - coarse.value).abs(), beyond(fine)]));
    if scale == 0.0 { 0.0 } else { change / scale }
}

/// Change of the passes until the first damage: with the exponent m, m times that of the range of the shear stress. 0 where nothing tires.
fn life_change(coarse: &StepRecord, fine: &StepRecord) -> f64 {
    let (Some(coarse), Some(fine)) = (&coarse.fatigue, &fine.fatigue) else { return 0.0 };
    let (coarse, fine) = (coarse.first.passes, fine.first.passes);
    if coarse == fine { 0.0 } else { (coarse / fine - 1.0).abs() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_as_dense_along_both_vectors_and_fast() {
        let oblong = Cell::new([10.0, 0.0], [0.0, 1.0]).unwrap();
        assert_eq!(balanced_points(&oblong, 96), [960, 96]);
        let odd = Cell::new([1.0, 0.0], [0.5, 1.1]).unwrap();
        assert_eq!(balanced_points(&odd, 96), [96, 120]);
    }

    #[test]
    fn a_refinement_says_why_it_ends() {
        let square = Cell::square(1.0).unwrap();
        let run = |changes: &[f64], most: usize| {
            let mut refinement = Refinement::new(&square, 1e-3).unwrap();
            let mut rest = changes.iter().copied();
            let mut change = None;
            loop {
                match refinement.refine(change, |[n, _]| n <= most) {
                    Some(end) => return (refinement.points()[0], end),
                    None => change = rest.next(),
                }
            }
        };
        assert_eq!(run(&[1e-2, 3e-3, 9e-4, 1e-9], 8192), (768, RefinementEnd::Reached));
        // A logarithm changes as much from grid to grid.
        assert_eq!(run(&[1e-2, 9.9e-3, 9.8e-3, 9.7e-3], 8192), (768, RefinementEnd::Stagnates));
        assert_eq!(run(&[1e-2, 5e-3, 2.5e-3, 1.3e-3, 1.1e-3, 1e-3], 8192), (3072, RefinementEnd::Finest));
        assert_eq!(run(&[1e-2, 5e-3, 2.5e-3, 1.3e-3, 1.1e-3, 1e-3], 1000), (768, RefinementEnd::Room));
    }

    #[test]
    fn the_first_grid_is_bounded_and_a_needle_refused() {
        let grids = |ratio: f64| Refinement::grids(&Cell::new([ratio, 0.0], [0.0, 1.0]).unwrap());
        assert_eq!(grids(1.0).unwrap(), [96, 192, 384, 768, 1536, 3072].map(|n| [n; 2]));
        assert_eq!(grids(4.0).unwrap()[0], [384, 96]);
        assert!([30.0, 100.0, 300.0].iter().all(|&ratio| grids(ratio).unwrap()[0][0] <= MOST_POINTS));
        assert!(grids(1000.0).is_err() && grids(1e40).is_err());
    }
}
