//! A run of surfaces that adhere: loads one after another, each from the state of the last.

use super::{EarlierRun, Loading, Recorder, Run, RunError, Solved, StepRecord};
use crate::load::Load;
use crate::reading::AdhesionReading;
use crate::run::GridStart;
use crate::spectral::{AdhesiveSolver, AdhesiveStep, OtherGrids, Step};
use crate::stress::Tables;
use std::ops::ControlFlow;
use std::sync::Arc;

impl Run {
    /// Solves all loads on one grid with adhesion. The steps of the earlier run `finished` are solved once more, since those after them begin
    /// from their states; they are not recorded again.
    pub(super) fn adhesive_on_grid<R: Recorder>(
        &self,
        points: [usize; 2],
        finished: Option<EarlierRun>,
        recorder: &mut R,
    ) -> Result<Solved, RunError<R::Error>> {
        let mut solver = AdhesiveSolver::new(Arc::clone(&self.problem), points, self.settings)?;
        recorder.begin(&GridStart::from(&solver)).map_err(RunError::Recorder)?;
        let mut records = finished.map_or_else(Vec::new, |earlier| earlier.steps);
        let known = records.len();
        if known >= self.loads.len() {
            return Err(OtherGrids.into());
        }
        let (mut last, tables) = (None, Arc::default());
        for (number, &load) in self.loads.iter().enumerate() {
            // The memory of a step is freed before the next one needs as much.
            drop(last.take());
            if number >= known {
                recorder.load(load);
            }
            let began = recorder.clock();
            let step = advance(&mut solver, load, recorder)?;
            if number >= known {
                records.push(self.adhesive_record(&step, (Loading::Path, &tables, began), recorder)?);
            }
            last = Some(step.contact);
        }
        Ok((records, last))
    }

    /// One load of a search, from undeformed surfaces that touch.
    pub(super) fn adhering_at<R: Recorder>(
        &self,
        solver: &mut AdhesiveSolver,
        load: Load,
        (loading, tables): (Loading<'_>, &Arc<Tables>),
        recorder: &mut R,
    ) -> Result<(StepRecord, Step), RunError<R::Error>> {
        solver.begin_anew();
        recorder.load(load);
        let began = recorder.clock();
        let step = advance(solver, load, recorder)?;
        let record = self.adhesive_record(&step, (loading, tables, began), recorder)?;
        Ok((record, step.contact))
    }

    /// The record of a step, passed to the recorder.
    fn adhesive_record<R: Recorder>(
        &self,
        step: &AdhesiveStep,
        (loading, tables, began): (Loading<'_>, &Arc<Tables>, Option<f64>),
        recorder: &mut R,
    ) -> Result<StepRecord, RunError<R::Error>> {
        let mut reading = step.contact.reading();
        // A search goes by the loads that it prescribes, which are met to the tolerance.
        if let (Load::MeanPressure(_) | Load::Force(_), Loading::Search | Loading::Limit) = (step.contact.load, loading)
        {
            let area = self.problem.cell().area();
            let mean =
                if let Load::Force(force) = step.contact.load { force / area } else { step.contact.load.value() };
            reading.force = mean * area;
            reading.mean_pressure = reading.mean_pressure.map(|_| mean);
        }
        let record = StepRecord::new(&step.contact, reading).with_adhesion(AdhesionReading::of(step));
        self.with_stresses(&step.contact, record, tables, loading, (began, 0.0), recorder)
    }
}

/// The next step of a solver, whose iterations the recorder watches.
fn advance<R: Recorder>(
    solver: &mut AdhesiveSolver,
    load: Load,
    recorder: &mut R,
) -> Result<AdhesiveStep, RunError<R::Error>> {
    let mut iterated = Ok(());
    let step = solver.advance_with_progress(load, &mut |progress| {
        if iterated.is_ok() {
            iterated = recorder.iteration(progress);
        }
        if iterated.is_ok() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    });
    iterated.map_err(RunError::Recorder)?;
    Ok(step)
}
