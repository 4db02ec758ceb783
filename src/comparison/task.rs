//! Solving a load step by both methods, each at two resolutions.

use super::{Answer, CircleComparison, Comparison, StressPair};
use crate::body::MeanStress;
use crate::counterbody::Indenters;
use crate::friction::Friction;
use crate::lattice::LatticeError;
use crate::load::Load;
use crate::localized::stress::LocalizedField;
use crate::localized::{self, CircleRadius, Coupled, Localized, NoIndenters, Setup, Stop};
use crate::problem::Problem;
use crate::reading::Reading;
use crate::run::StepRecord;
use crate::spectral::{Settings, Solver, Step};
use crate::stress::StressField;
use std::ops::ControlFlow;
use std::sync::Arc;

/// Why two methods cannot be compared.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ComparisonError {
    /// The localized method knows indenters only.
    #[error(transparent)]
    NoIndenters(#[from] NoIndenters),
    /// The localized method solves frictionless contact.
    #[error(
        "the localized method knows the pressure of frictionless contact only, to which uncoupled friction adds its stresses: \
         compare with friction.coupling = false"
    )]
    CoupledFriction,
    /// There is no such grid.
    #[error(transparent)]
    Grid(#[from] LatticeError),
    /// Whoever heard of it wanted no more.
    #[error("stopped before its end")]
    Interrupted,
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
    /// Numbers of indenters inside the circles, one circle for each.
    pub indenters: Vec<usize>,
    /// Elements across the largest contact.
    pub elements: usize,
    /// How large the circles are.
    pub rule: CircleRadius,
    /// Whether the indenters around the one looked at act on it; if not, each is alone on the half-space.
    pub mutual_effect: bool,
    /// Mean lateral stress.
    pub mean: MeanStress,
}

impl Task {
    /// Whether both methods know the problem.
    ///
    /// # Errors
    /// [`ComparisonError::NoIndenters`] for a topography, [`ComparisonError::CoupledFriction`] for coupled friction.
    pub fn check(&self) -> Result<(), ComparisonError> {
        self.indenters().map(|_| ())
    }

    /// The indenters of a problem that both methods know.
    fn indenters(&self) -> Result<&Indenters, ComparisonError> {
        let couples = self.problem.friction().is_some_and(Friction::couples);
        let indenters = self.problem.counterbody().indenters().ok_or(NoIndenters)?;
        if couples { Err(ComparisonError::CoupledFriction) } else { Ok(indenters) }
    }

    /// Compares both methods, the spectral one on grids of `points` and half of them. `progress` hears what is to begin, and
    /// says whether it shall.
    ///
    /// # Errors
    /// [`ComparisonError`]: see [`Self::check`], when a number of points is zero, or `progress` wants no more.
    pub fn compare(
        &self,
        points: [usize; 2],
        progress: &mut dyn FnMut(&str) -> ControlFlow<()>,
    ) -> Result<Comparison, ComparisonError> {
        let indenters = self.indenters()?;
        let mut begin = |what: &str| match progress(what) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(ComparisonError::Interrupted),
        };
        begin("spectral solution")?;
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
        let (mesh, start) = localized.mesh(self.load, &self.setup(most, self.rule));
        let half = mesh.halved();
        let (mut circles, mut other_rule, mut lattice_sum) = (Vec::new(), Vec::new(), None);
        let mut last = start;
        let counts: &[usize] = if self.mutual_effect { &self.indenters } else { &[1] };
        for &inside in counts {
            let what = format!("localized solution, {inside} indenters in the circle");
            begin(&what)?;
            let coupled = |mesh| Coupled::new(localized.system(), mesh, inside, self.mutual_effect);
            let [fine, coarse] = [mesh, half].map(coupled);
            let compared = |rule: CircleRadius| {
                let widened = |coupled: &Coupled, start| {
                    let solution = coupled.solve(self.load, rule, Some(start));
                    if solution.stop != Stop::Rim {
                        return solution;
                    }
                    localized.solve(self.load, &self.setup(inside, rule))
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
            let (chosen, found) = compared(self.rule);
            circles.push(chosen);
            if self.mutual_effect {
                begin(&format!("{what}, {}", self.rule.other().name()))?;
                other_rule.push(compared(self.rule.other()).0);
            }
            if self.mutual_effect && self.rule != CircleRadius::LatticeSum && lattice_sum.is_none() {
                begin(&format!("{what}, {}", CircleRadius::LatticeSum.name()))?;
                lattice_sum = Some(compared(CircleRadius::LatticeSum).0);
            }
            last = found;
        }
        begin("stresses")?;
        let stresses = self.stresses(indenters, &last, &step);
        let (task, spectral) = (self.clone(), StepRecord::new(&step, reading));
        Ok(Comparison { task, spectral, grid_error, circles, other_rule, lattice_sum, stresses })
    }

    /// What the localized method is asked for with so many indenters inside the circles.
    fn setup(&self, indenters: usize, rule: CircleRadius) -> Setup {
        Setup { indenters, elements: self.elements, rule, mutual_effect: self.mutual_effect }
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
        let field = LocalizedField::new(localized, self.problem.friction(), self.mean);
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
