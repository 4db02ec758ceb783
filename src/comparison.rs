//! Spectral and localized solution of one case side by side.
//!
//! Three things differ between them: the grid of the one, the elements of the other, and what the circle leaves out.
//! Each method is therefore solved at two resolutions, half and full; what a quantity changes between them bounds its
//! discretisation error, since both converge at first order or faster. What remains of the difference is the error of
//! localization. The circles have both radius rules, on the same elements, and the smallest also the lattice sum of what
//! is outside it.

use crate::body::{Depth, MeanStress};
use crate::counterbody::Indenters;
use crate::lattice::LatticeError;
use crate::load::Load;
use crate::localized::stress::LocalizedField;
use crate::localized::{self, CircleRadius, Coupled, Localized, NoIndenters, Setup, Stop};
use crate::numeric::search::largest;
use crate::problem::Problem;
use crate::reading::{LevelReading, Reading};
use crate::spectral::{Settings, Solver, Step};
use crate::stress::{State, StressField};
use std::sync::Arc;

/// Why two methods cannot be compared.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ComparisonError {
    /// The localized method knows indenters only.
    #[error(transparent)]
    NoIndenters(#[from] NoIndenters),
    /// There is no such grid.
    #[error(transparent)]
    Grid(#[from] LatticeError),
}

/// Largest deviation of any level in contact from a reference; relative but for the share.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Deviation {
    /// Of the penetration, relative.
    pub penetration: f64,
    /// Of the load on one indenter, relative.
    pub load: f64,
    /// Of the share of the whole load, absolute.
    pub load_share: f64,
    /// Of the peak pressure, relative.
    pub max_pressure: f64,
    /// Of the contact radius, relative.
    pub contact_radius: f64,
}

/// What any method says of a load step.
#[derive(Debug, Clone, PartialEq)]
pub struct Answer {
    /// Penetration δ, a length.
    pub penetration: f64,
    /// From the highest level down.
    pub levels: Vec<LevelReading>,
}

impl Answer {
    /// Deviation of this answer from `reference`. A level that touches in one of them only deviates by all of it; the
    /// radius of merged contacts is not a number.
    pub fn deviation(&self, reference: &Self) -> Deviation {
        let relative = |a: f64, b: f64| match (a, b) {
            _ if a == b => 0.0,
            _ if a == 0.0 || b == 0.0 => 1.0,
            _ => (a / b - 1.0).abs(),
        };
        let worst = |of: &dyn Fn(&LevelReading, &LevelReading) -> f64| {
            let pairs = self.levels.iter().zip(&reference.levels);
            largest(pairs.filter(|(a, b)| a.load > 0.0 || b.load > 0.0).map(|(a, b)| of(a, b)))
        };
        let radius = |level: &LevelReading| level.contact_radius.unwrap_or(f64::NAN);
        Deviation {
            penetration: relative(self.penetration, reference.penetration),
            load: worst(&|a, b| relative(a.load, b.load)),
            load_share: worst(&|a, b| (a.load_share - b.load_share).abs()),
            max_pressure: worst(&|a, b| relative(a.max_pressure, b.max_pressure)),
            contact_radius: worst(&|a, b| relative(radius(a), radius(b))),
        }
    }
}

impl From<&Reading> for Answer {
    fn from(reading: &Reading) -> Self {
        Self { penetration: reading.penetration, levels: reading.levels.clone() }
    }
}

impl From<&localized::Solution> for Answer {
    fn from(solution: &localized::Solution) -> Self {
        Self { penetration: solution.penetration, levels: solution.levels() }
    }
}

/// One circle held against the spectral solution.
#[derive(Debug, Clone)]
pub struct CircleComparison {
    /// Indenters inside, whole shells.
    pub indenters: usize,
    /// How the solution ended.
    pub stop: Stop,
    /// What it says.
    pub answer: Answer,
    /// Radius R of the circle, level by level, a length; infinite without mutual effect.
    pub radii: Vec<f64>,
    /// Additional displacement w_a, Eq. (8).
    pub additional_displacement: f64,
    /// Deviation from the spectral solution.
    pub difference: Deviation,
    /// Change from half the number of elements.
    pub mesh_error: Deviation,
}

/// Stresses of both methods at one point under the first indenter of the highest level.
#[derive(Debug, Clone, Copy)]
pub struct StressPair {
    /// Place from the indenter's axis, lengths.
    pub place: [f64; 2],
    /// Depth and material.
    pub depth: Depth,
    /// Spectral state.
    pub spectral: State,
    /// Localized state; without displacements.
    pub localized: State,
}

impl StressPair {
    /// Largest difference of a stress component, a pressure.
    pub fn difference(&self) -> f64 {
        let (a, b) = (self.spectral.components(), self.localized.components());
        (0..6).map(|c| (a[c] - b[c]).abs()).fold(0.0, f64::max)
    }
}

/// Both solutions of a load step.
#[derive(Debug)]
pub struct Comparison {
    /// Spectral solution.
    pub step: Step,
    /// What is read off it, with its estimated discretisation errors.
    pub reading: Reading,
    /// Change from half the points.
    pub grid_error: Deviation,
    /// Elements across the largest contact.
    pub elements: usize,
    /// Circles under the rule asked for.
    pub circles: Vec<CircleComparison>,
    /// The same circles under the other rule.
    pub other_rule: Vec<CircleComparison>,
    /// The first circle with the lattice sum outside; `None` without mutual effect or where all have it.
    pub lattice_sum: Option<CircleComparison>,
    /// Stresses with the last circle, the rule asked for.
    pub stresses: Vec<StressPair>,
}

/// What is compared.
#[derive(Debug, Clone)]
pub struct Task {
    /// Indenters on a half-space.
    pub problem: Arc<Problem>,
    /// The load step.
    pub load: Load,
    /// Settings of the spectral solver.
    pub settings: Settings,
    /// Indenters in the circles, elements, rule and mutual effect; one solution for each number of indenters.
    pub setup: Setup,
    /// Numbers of indenters.
    pub indenters: Vec<usize>,
    /// Mean lateral stress.
    pub mean: MeanStress,
}

impl Task {
    /// Compares both methods, the spectral one on grids of `points` and half of them. `progress` hears what is begun.
    ///
    /// # Errors
    /// [`ComparisonError`] for a topography, or when a number of points is zero.
    pub fn compare(&self, points: [usize; 2], progress: &mut dyn FnMut(&str)) -> Result<Comparison, ComparisonError> {
        let indenters = self.problem.counterbody().indenters().ok_or(NoIndenters)?;
        progress("spectral solution");
        let solve = |points: [usize; 2]| -> Result<Step, LatticeError> {
            Ok(Solver::new(Arc::clone(&self.problem), points, self.settings)?.solve(self.load))
        };
        let coarse = Reading::of(solve(points.map(|n| n.div_ceil(2)))?.finest());
        let step = solve(points)?;
        let reading = step.reading();
        let reference = Answer::from(&reading);
        let grid_error = reference.deviation(&Answer::from(&coarse));
        let most = self.indenters.iter().copied().max().unwrap_or(1);
        let localized = Localized::new(&self.problem, most)?;
        let (mesh, start) = localized.mesh(self.load, &self.setup);
        let half = mesh.halved();
        let (mut circles, mut other_rule, mut lattice_sum) = (Vec::new(), Vec::new(), None);
        let mut last = start;
        let counts: &[usize] = if self.setup.mutual_effect { &self.indenters } else { &[1] };
        for &inside in counts {
            progress(&format!("localized solution, {inside} indenters in the circle"));
            let coupled = |mesh| localized.coupled(mesh, inside, self.setup.mutual_effect);
            let [fine, coarse] = [mesh, half].map(coupled);
            let compared = |rule: CircleRadius| {
                let widened = |coupled: &Coupled, start| {
                    let solution = coupled.solve(self.load, rule, Some(start));
                    if solution.stop != Stop::Rim {
                        return solution;
                    }
                    localized.solve(self.load, &Setup { indenters: inside, radius: rule, ..self.setup })
                };
                let found = widened(&fine, &last);
                let own = found.spots[0].mesh;
                let rough = if own == mesh {
                    coarse.solve(self.load, rule, Some(&found))
                } else {
                    coupled(own.halved()).solve(self.load, rule, Some(&found))
                };
                let answer = Answer::from(&found);
                let comparison = CircleComparison {
                    indenters: fine.indenters(),
                    stop: found.stop,
                    additional_displacement: found.additional_displacement(),
                    difference: answer.deviation(&reference),
                    mesh_error: answer.deviation(&Answer::from(&rough)),
                    radii: found.circle_radii(),
                    answer,
                };
                (comparison, found)
            };
            let (chosen, found) = compared(self.setup.radius);
            circles.push(chosen);
            if self.setup.mutual_effect {
                other_rule.push(compared(self.setup.radius.other()).0);
            }
            if self.setup.mutual_effect && self.setup.radius != CircleRadius::LatticeSum && lattice_sum.is_none() {
                lattice_sum = Some(compared(CircleRadius::LatticeSum).0);
            }
            last = found;
        }
        progress("stresses");
        let stresses = self.stresses(indenters, &last, &step);
        let elements = self.setup.elements;
        Ok(Comparison { step, reading, grid_error, elements, circles, other_rule, lattice_sum, stresses })
    }

    /// Stresses on the axis of the first indenter of the highest level and along a line from it.
    fn stresses(&self, indenters: &Indenters, localized: &localized::Solution, spectral: &Step) -> Vec<StressPair> {
        let (lattice, half_space) = (indenters.lattice(), self.problem.half_space());
        let highest = localized.system().highest();
        let spot = &localized.spots[highest];
        if !spot.touches() || localized.stop != Stop::Converged {
            return Vec::new();
        }
        let radius = spot.contact_radius();
        let field = LocalizedField::new(localized, self.mean);
        let whole = StressField::new(spectral.finest(), self.mean);
        let faces = half_space.interface_depths();
        let mut depths: Vec<f64> = [0.25, 0.5, 1.0, 2.0].map(|part| part * radius).to_vec();
        depths.extend(faces.into_iter().filter(|&z| z < 3.0 * radius && field.reaches(z)));
        depths.sort_by(f64::total_cmp);
        let [x, y] = lattice.toward(spot.place, spot.level);
        let unit = [x, y].map(|v| v / x.hypot(y));
        let places: Vec<[f64; 2]> = [0.0, 0.5, 1.0, 1.5].map(|part| unit.map(|u| part * radius * u)).to_vec();
        let origin = lattice.cell().point(spot.place);
        let mut pairs = Vec::new();
        for depth in depths.into_iter().flat_map(|z| half_space.depths(z)) {
            let Some(states) = field.points(highest, depth, &places) else { continue };
            let absolute: Vec<[f64; 2]> = places.iter().map(|p| [origin[0] + p[0], origin[1] + p[1]]).collect();
            for ((&place, localized), spectral) in places.iter().zip(states).zip(whole.points(depth, &absolute)) {
                pairs.push(StressPair { place, depth, spectral, localized });
            }
        }
        pairs
    }
}
