//! Comparison of the spectral and the localized solution of one load step.
//!
//! The two differ by the grid of the one, the elements of the other, and the truncation by the circle. Each method is therefore
//! solved at two resolutions, half and full; the change of a quantity between them bounds its discretisation error, since both
//! converge at first order or faster. The rest of the difference is the error of localization. The circles are solved under both
//! radius rules, on the same elements, and the smallest one also with the lattice sum outside it.

mod answer;
mod task;

pub use answer::{Answer, Deviation};
pub use task::{ComparisonError, ComparisonTask};

use crate::body::Depth;
use crate::localized::{CircleRadius, Stop};
use crate::reading::FEW_SAMPLES;
use crate::run::StepRecord;
use crate::stress::StressState;

/// Localized solution with one circle, compared with the spectral solution.
#[derive(Debug, Clone)]
pub struct CircleComparison {
    /// Number of indenters inside, in whole shells.
    pub indenters: usize,
    /// How the localized solution ended.
    pub stop: Stop,
    /// Penetration and levels of the localized solution.
    pub answer: Answer,
    /// Radius R of the circle of each level, lengths; infinite without mutual effect.
    pub radii: Vec<f64>,
    /// Additional displacement w_a, Eq. (8), a length.
    pub additional_displacement: f64,
    /// Deviation from the spectral solution.
    pub difference: Deviation,
    /// Change from half the number of elements.
    pub mesh_error: Deviation,
}

/// Stresses of both methods at one point below the first indenter of the highest level.
#[derive(Debug, Clone, Copy)]
pub struct StressPair {
    /// Position (x, y) from the indenter's axis, lengths.
    pub place: [f64; 2],
    /// Depth and material.
    pub depth: Depth,
    /// State of the spectral solution.
    pub spectral: StressState,
    /// State of the localized solution, displacements left out.
    pub localized: StressState,
}

impl StressPair {
    /// Largest difference of a stress component, a pressure.
    pub fn difference(&self) -> f64 {
        self.spectral.difference_from(&self.localized)
    }
}

/// Both solutions of a load step.
#[derive(Debug)]
pub struct Comparison {
    /// The load step that was compared.
    pub task: ComparisonTask,
    /// The spectral solution with its estimated discretisation errors, as a run records it.
    pub spectral: StepRecord,
    /// Change of the spectral solution from half the points.
    pub grid_error: Deviation,
    /// Circles under the rule of the task.
    pub circles: Vec<CircleComparison>,
    /// The circles under the other rule.
    pub other_rule: Vec<CircleComparison>,
    /// The first circle with the lattice sum outside; `None` without mutual effect, or where all circles have it.
    pub lattice_sum: Option<CircleComparison>,
    /// Stresses with the last circle under the rule of the task; under the lattice sum they are those with p̄ outside the
    /// load-balanced radius.
    pub stresses: Vec<StressPair>,
}

impl Comparison {
    /// Whether the spectral solution and all circles under the rule of the task have converged.
    pub fn converged(&self) -> bool {
        self.spectral.converged() && self.circles.iter().all(|circle| circle.stop == Stop::Converged)
    }

    /// The circles under each rule: that of the task, the other one, the lattice sum.
    pub fn rules(&self) -> [(CircleRadius, &[CircleComparison]); 3] {
        [
            (self.task.rule, &self.circles),
            (self.task.rule.other(), &self.other_rule),
            (CircleRadius::LatticeSum, self.lattice_sum.as_slice()),
        ]
    }

    /// Reasons to doubt the comparison, one sentence each.
    pub fn warnings(&self) -> Vec<String> {
        let rules = self.rules();
        let circles = rules.iter().flat_map(|(rule, circles)| circles.iter().map(move |circle| (rule, circle)));
        let mut warnings: Vec<String> = circles
            .filter(|(_, circle)| circle.stop != Stop::Converged)
            .map(|(rule, circle)| format!("{} circle of {} indenters: {}", rule.name(), circle.indenters, circle.stop))
            .collect();
        if !self.spectral.converged() {
            warnings.push(format!("the spectral solution has not converged: {}", self.spectral.report()));
        }
        let samples =
            self.spectral.reading.levels.iter().filter(|level| level.load > 0.0).map(|level| level.resolution);
        let fewest = samples.fold(f64::INFINITY, f64::min);
        if fewest < FEW_SAMPLES {
            warnings.push(format!(
                "a contact radius has only {fewest:.1} samples in the spectral solution: differences from it are those of \
                 the grid; raise grid.points"
            ));
        }
        warnings
    }
}
