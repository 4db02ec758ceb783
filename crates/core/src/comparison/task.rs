//! Solving a load step by both methods, each at two resolutions.

use super::{Answer, CircleComparison, Comparison, StressPair};
use crate::body::MeanStress;
use crate::counterbody::Indenters;
use crate::friction::Friction;
use crate::lattice::{LatticeError, Surroundings};
use crate::load::Load;
use crate::localized::mesh::Mesh;
use crate::localized::stress::LocalizedField;
use crate::localized::{self, CircleRadius, Coupled, Localized, LocalizedError, Setup, Stop};
use crate::problem::Problem;
use crate::reading::Reading;
use crate::run::StepRecord;
use crate::spectral::{Settings, Solver, Step};
use crate::stress::StressField;
use std::ops::ControlFlow;
use std::sync::Arc;

/// Why two methods cannot be compared.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ComparisonError {
    /// A topography or a rigid base, which the localized method cannot solve.
    #[error(transparent)]
    Localized(#[from] LocalizedError),
    /// Coupled friction, which the localized method cannot solve.
    #[error(
        "the localized method knows the pressure of frictionless contact only, to which uncoupled friction adds its stresses: \
         compare with friction.coupling = false"
    )]
    CoupledFriction,
    /// An isolated contact, which the localized method cannot solve.
    #[error(
        "the localized method knows periodic systems, and this contact is isolated: solve it, or compare on a lattice whose period \
         is large"
    )]
    Isolated,
    /// A grid that cannot be built.
    #[error(transparent)]
    Grid(#[from] LatticeError),
    /// `progress` ended the comparison.
    #[error("stopped before its end")]
    Interrupted,
}

/// One load step to be solved by both methods.
#[derive(Debug, Clone)]
pub struct ComparisonTask {
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
    /// Rule for the radius of the circles, or for what acts outside them.
    pub rule: CircleRadius,
    /// Whether indenters act on each other; if not, each is alone on the half-space.
    pub mutual_effect: bool,
    /// Mean lateral stress of the stress field.
    pub mean: MeanStress,
}

/// The circles under each rule, and the last solution under the rule of the task.
struct Circles {
    chosen: Vec<CircleComparison>,
    other_rule: Vec<CircleComparison>,
    lattice_sum: Option<CircleComparison>,
    last: localized::Solution,
}

/// Circles of one number of indenters, on the elements of the task and on half as many.
struct TwoMeshes<'a> {
    task: &'a ComparisonTask,
    localized: &'a Localized,
    /// Least number of indenters inside.
    indenters: usize,
    mesh: Mesh,
    fine: Coupled,
    coarse: Coupled,
}

impl<'a> TwoMeshes<'a> {
    fn new(task: &'a ComparisonTask, localized: &'a Localized, indenters: usize, mesh: Mesh) -> Self {
        let [fine, coarse] =
            [mesh, mesh.halved()].map(|mesh| Coupled::new(localized.system(), mesh, indenters, task.mutual_effect));
        Self { task, localized, indenters, mesh, fine, coarse }
    }

    /// The solution under a rule, and its comparison with the `reference` and with half the elements.
    fn compared(
        &self,
        rule: CircleRadius,
        start: &localized::Solution,
        reference: &Answer,
    ) -> (CircleComparison, localized::Solution) {
        let found = self.solved(rule, start);
        let rough = self.on_half_the_elements(rule, &found);
        let answer = Answer::from(&found);
        let comparison = CircleComparison {
            indenters: self.fine.indenters(),
            stop: found.stop,
            additional_displacement: found.additional_displacement(),
            difference: answer.deviation(reference),
            mesh_error: answer.deviation(&Answer::from(&rough)),
            radii: found.circle_radii(),
            answer,
        };
        (comparison, found)
    }

    /// The solution on the mesh of the task, or on a wider one where a contact reaches its rim.
    fn solved(&self, rule: CircleRadius, start: &localized::Solution) -> localized::Solution {
        let solution = self.fine.solve(self.task.load, rule, Some(start));
        if solution.stop != Stop::Rim {
            return solution;
        }
        self.localized.solve(self.task.load, &self.task.setup(self.indenters, rule))
    }

    /// The solution on half the elements of a solution that was `found`.
    fn on_half_the_elements(&self, rule: CircleRadius, found: &localized::Solution) -> localized::Solution {
        let mesh = found.spots[0].mesh;
        if mesh == self.mesh {
            return self.coarse.solve(self.task.load, rule, Some(found));
        }
        let coarse = Coupled::new(self.localized.system(), mesh.halved(), self.indenters, self.task.mutual_effect);
        coarse.solve(self.task.load, rule, Some(found))
    }
}

impl ComparisonTask {
    /// Whether both methods can solve the problem.
    ///
    /// # Errors
    /// [`ComparisonError::Localized`] for a topography or a rigid base, [`ComparisonError::Isolated`] for an isolated contact,
    /// [`ComparisonError::CoupledFriction`] for coupled friction.
    pub fn check(&self) -> Result<(), ComparisonError> {
        self.indenters().map(|_| ())
    }

    /// The indenters of a problem that both methods can solve.
    fn indenters(&self) -> Result<&Indenters, ComparisonError> {
        let couples = self.problem.friction().is_some_and(Friction::couples);
        let indenters = Localized::solvable(&self.problem)?;
        match (self.problem.cell().surroundings(), couples) {
            (Surroundings::FreeSpace, _) => Err(ComparisonError::Isolated),
            (Surroundings::Periodic, true) => Err(ComparisonError::CoupledFriction),
            (Surroundings::Periodic, false) => Ok(indenters),
        }
    }

    /// Compares both methods, the spectral one on grids of `points` and half of them. `progress` is called with the name of each
    /// stage before it begins.
    ///
    /// # Errors
    /// [`ComparisonError`]: see [`Self::check`], when a number of points is zero, or `progress` returns a break.
    pub fn compare(
        &self,
        points: [usize; 2],
        progress: &mut dyn FnMut(&str) -> ControlFlow<()>,
    ) -> Result<Comparison, ComparisonError> {
        let indenters = self.indenters()?;
        let mut begin = |stage: &str| match progress(stage) {
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
        let localized = Localized::new(&self.problem, self.most_indenters())?;
        let circles = self.circles(&localized, &reference, &mut begin)?;
        begin("stresses")?;
        let stresses = self.stresses(indenters, &circles.last, &step);
        let Circles { chosen: circles, other_rule, lattice_sum, .. } = circles;
        let (task, spectral) = (self.clone(), StepRecord::new(&step, reading));
        Ok(Comparison { task, spectral, grid_error, circles, other_rule, lattice_sum, stresses })
    }

    /// Largest number of indenters inside a circle.
    fn most_indenters(&self) -> usize {
        self.indenters.iter().copied().max().unwrap_or(1)
    }

    /// The circles under each rule.
    fn circles(
        &self,
        localized: &Localized,
        reference: &Answer,
        begin: &mut dyn FnMut(&str) -> Result<(), ComparisonError>,
    ) -> Result<Circles, ComparisonError> {
        let (mesh, start) = localized.mesh(self.load, &self.setup(self.most_indenters(), self.rule));
        let mut circles = Circles { chosen: Vec::new(), other_rule: Vec::new(), lattice_sum: None, last: start };
        let counts: &[usize] = if self.mutual_effect { &self.indenters } else { &[1] };
        for &inside in counts {
            let what = format!("localized solution, {inside} indenters in the circle");
            begin(&what)?;
            let circle = TwoMeshes::new(self, localized, inside, mesh);
            let (chosen, found) = circle.compared(self.rule, &circles.last, reference);
            circles.chosen.push(chosen);
            if self.mutual_effect {
                begin(&format!("{what}, {}", self.rule.other().name()))?;
                circles.other_rule.push(circle.compared(self.rule.other(), &circles.last, reference).0);
            }
            if self.mutual_effect && self.rule != CircleRadius::LatticeSum && circles.lattice_sum.is_none() {
                begin(&format!("{what}, {}", CircleRadius::LatticeSum.name()))?;
                circles.lattice_sum = Some(circle.compared(CircleRadius::LatticeSum, &circles.last, reference).0);
            }
            circles.last = found;
        }
        Ok(circles)
    }

    /// Setup of the localized method with so many `indenters` inside the circles.
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
