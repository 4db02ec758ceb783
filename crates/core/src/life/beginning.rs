//! The body before its first pass: the contact, with what it does in each pass.

use super::task::{LifeError, LifeTask};
use crate::reading::{FatigueReading, Pass, PathReading, largest_while};
use crate::run::{Refinement, RefinementEnd, Sampling, StepRecord, change};
use crate::spectral::{Solver, Step};
use crate::stress::{PathSought, RangePlane, StressFields};
use std::sync::Arc;

/// The body before its first pass: the contact with what it does in each pass.
#[derive(Debug, Clone)]
pub struct Beginning {
    /// The step that was solved.
    pub step: Step,
    /// The step on the way back of a counterbody that goes to and fro with friction; `None` where the way there stands for both.
    pub back: Option<Step>,
    /// Record of the step, with the lives of what tires.
    pub record: StepRecord,
    /// Range of τ₁ on planes of the materials that tire; none of points that stay in place.
    pub planes: Vec<RangePlane>,
    /// Length by which both surfaces slip against each other in a cycle, sample by sample, a₂ fastest; empty where the counterbody slides.
    pub slid: Vec<f64>,
    /// Largest [change](crate::run::change) from the grid before, that of the passes included; `None` on a first or prescribed grid.
    pub change: Option<f64>,
    /// Why a refinement has ended; `None` on a prescribed grid.
    pub end: Option<RefinementEnd>,
}

impl LifeTask {
    /// The contact before the first pass; where an accuracy is prescribed on finer and finer grids, all that `fits`
    /// says have room, until the results change by less: with the exponent m of a law the passes change m times as much
    /// as the range of the shear stress.
    ///
    /// # Errors
    /// [`LifeError`].
    pub fn beginning(
        &self,
        fits: &dyn Fn([usize; 2]) -> bool,
        goes_on: &dyn Fn() -> bool,
    ) -> Result<Beginning, LifeError> {
        let on_grid = |points: [usize; 2]| {
            if self.motions.is_some() {
                return self.begun_in_place(points, goes_on);
            }
            let mut solver = Solver::new(Arc::clone(&self.problem), points, self.settings)?;
            self.contact(&mut solver, goes_on)
        };
        let accuracy = match self.sampling {
            Sampling::Points(points) => return on_grid(points),
            Sampling::Accuracy(accuracy) => accuracy,
        };
        let mut refinement = Refinement::new(&self.problem.cell(), accuracy)?;
        let mut coarse: Option<StepRecord> = None;
        loop {
            let begun = on_grid(refinement.points())?;
            let record = std::slice::from_ref(&begun.record);
            let change = coarse.as_ref().map(|coarse| change(std::slice::from_ref(coarse), record));
            if let Some(end) = refinement.refine(change, fits) {
                return Ok(Beginning { change, end: Some(end), ..begun });
            }
            coarse = Some(begun.record);
        }
    }

    /// The contact of the surfaces of a solver, with what it does in a pass.
    pub(super) fn contact(&self, solver: &mut Solver, goes_on: &dyn Fn() -> bool) -> Result<Beginning, LifeError> {
        let mut step = solver.solve(self.load);
        let back = match step.reading().touches() {
            true => self.way_back(step.problem(), step.grid().points())?.over(step.surface())?,
            false => None,
        };
        // A way back that was not solved is no answer.
        if let Some(stop) = back.as_ref().map(|back| back.report.stop).filter(|stop| !stop.solved()) {
            step.report.stop = stop;
        }
        self.read(step, back, goes_on)
    }

    /// Damage in a pass by a step, and by that on the way back where it is another one.
    pub(super) fn read(
        &self,
        step: Step,
        back: Option<Step>,
        goes_on: &dyn Fn() -> bool,
    ) -> Result<Beginning, LifeError> {
        let reading = step.reading();
        let fields = StressFields::new(step.finest(), self.mean);
        let sought = PathSought { fatigue: true, endurance: false, map: true };
        let found = if reading.touches() && self.problem.bodies().tire() {
            let pass = Pass { way: self.way(), back: back.as_ref().or(self.stroke.map(|_| &step)), ..Pass::default() };
            PathReading::of_pass(&step, &reading, &fields, (sought, &pass), goes_on).ok_or(LifeError::Interrupted)?
        } else {
            PathReading::default()
        };
        let by_strain = self.problem.bodies().last_by_strain() && reading.touches();
        let strains = match by_strain {
            true => largest_while(&step, &reading, &fields, goes_on).ok_or(LifeError::Interrupted)?,
            false => Vec::new(),
        };
        drop(fields);
        let fatigue = FatigueReading::with_strains(found.fatigue, &self.problem, &strains);
        let record = StepRecord { fatigue, ..StepRecord::new(&step, reading) };
        Ok(Beginning { step, back, record, planes: found.planes, slid: Vec::new(), change: None, end: None })
    }
}
