//! `percoat solve`: every load step of a case, the table and the output folder.

use super::interruption::{self, Saved};
use super::pictures::PictureOptions;
use super::plan::plan;
use super::stress::{largest, stress_change, wanted};
use super::terminal::{self, tell};
use super::{Common, Failure, Outcome, read_case};
use indicatif::{ProgressBar, ProgressStyle};
use percoat::case::resources::{Job, fits, refusal};
use percoat::case::{Case, GridSection, LoadSection, Room, plausibility};
use percoat::grid::Grid;
use percoat::hierarchy::{Hierarchy, Solution};
use percoat::number::number;
use percoat::observables::{FEW_SAMPLES, Observables, errors, observe};
use percoat::output::summary::{Step, Summary, curve};
use percoat::output::{Fields, RunFolder, Section, Seen, Stresses, table, write_text};
use percoat::picture::{Cut, Snapshot};
use percoat::refinement::{self, End, FIRST_POINTS, Refinement, balanced_points, change};
use percoat::solver::{Control, StopReason};
use percoat::stress::Field;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// A larger error of the stresses on the surface than this is worth a warning.
const WORTH_SAYING: f64 = 0.02;

pub fn run(case: Option<&Path>, pictures: &PictureOptions, common: &Common) -> Result<Outcome, Failure> {
    let (case, name) = read_case(case, common)?;
    let folder = common.output.clone().unwrap_or_else(|| Path::new("out").join(&name));
    let started = Instant::now();
    let controls = case.load.controls();
    let job = Job::Solve { pictures: pictures.wanted() };
    let room = room_or_refusal(&case, &folder, job)?;
    refuse_beyond_full_contact(&case, &controls)?;
    interruption::watch();
    let claim = RunFolder::claim(&folder, &plan(&case, controls.len(), pictures))?;
    terminal::tell_aside(claim.set_aside(), common.quiet);
    let run = Run { case: &case, controls, staging: claim.staging(), claim, room, job, pictures, common };
    let result = match case.grid {
        GridSection::Points(points) => run.finished(run.on_grid(points)?)?,
        GridSection::Accuracy(accuracy) => run.refined(accuracy)?,
    };
    let doubts = [plausibility::of_case(&case), plausibility::of_steps(&case, &result.steps)].concat();
    let warnings = [run.warnings(&result), doubts].concat();
    run.record(&result.steps, true, &warnings, result.accuracy)?;
    run.publish(&folder)?;
    if !common.quiet {
        print(&case, &result, &folder, started)?;
        for warning in &warnings {
            tell!("warning: {warning}");
        }
    }
    let converged = result.steps.iter().all(|step| step.converged) && result.is_accurate();
    Ok(if converged { Outcome::Done } else { Outcome::NotConverged })
}

struct Run<'a> {
    case: &'a Case,
    controls: Vec<Control>,
    /// The output folder, this run's until it is published.
    claim: RunFolder,
    /// Where the result is gathered.
    staging: PathBuf,
    /// What there is for all of it.
    room: Room,
    job: Job,
    pictures: &'a PictureOptions,
    common: &'a Common,
}

/// All load steps on one grid, their fields not yet gathered.
struct Gridded {
    hierarchy: Hierarchy,
    /// The last step.
    last: Option<Solution>,
    fields: Fields,
    stresses: Option<Stresses>,
    solved: Solved,
}

struct Solved {
    steps: Vec<Step>,
    observables: Vec<Observables>,
    /// Change against the next coarser grid, where an accuracy was asked for.
    accuracy: Option<f64>,
    /// Why the refinement ended, where there was one.
    end: Option<End>,
}

impl Solved {
    fn is_accurate(&self) -> bool {
        self.end.is_none_or(|end| end == End::Reached)
    }
}

impl Run<'_> {
    /// Gathers the fields and draws the pictures.
    fn finished(&self, gridded: Gridded) -> Result<Solved, Failure> {
        let Gridded { hierarchy, last, fields, mut stresses, solved } = gridded;
        fields.finish(hierarchy.grid(), hierarchy.texture())?;
        let cut = stresses.as_mut().and_then(Stresses::take_section);
        if let Some(stresses) = stresses {
            stresses.finish()?;
        }
        if let (Some(solution), Some(observables), true) = (last, solved.observables.last(), self.pictures.wanted()) {
            let (surface, half_space) = (self.case.surface(), self.case.half_space());
            let snapshot = Snapshot::new(&self.case.title, surface, half_space, &hierarchy, &solution, observables);
            let cut = cut.map(|Seen { section: Section { line, depths }, states, highest }| Cut {
                line,
                depths,
                states,
                highest,
            });
            let spinner = self.spinner("drawing pictures");
            self.pictures.draw(&self.staging, &snapshot, cut.as_ref(), &solved.steps)?;
            spinner.finish_and_clear();
        }
        Ok(solved)
    }

    /// All load steps on finer and finer grids until they change by less than `accuracy`.
    fn refined(&self, accuracy: f64) -> Result<Solved, Failure> {
        let refused = |error: refinement::TooOblong| Failure::Refused(error.to_string());
        let mut refinement = Refinement::new(self.case.surface().cell(), accuracy).map_err(refused)?;
        let mut before: Option<Solved> = None;
        loop {
            let points = refinement.points();
            let mut gridded = self.on_grid(points)?;
            let change = before.as_ref().map(|before| {
                change(&before.observables, &gridded.solved.observables)
                    .max(stress_change(&before.steps, &gridded.solved.steps))
            });
            gridded.solved.accuracy = change;
            if let (Some(change), true) = (change, self.common.verbose) {
                tell!("{points:?} points: change {change:.2e}");
            }
            gridded.solved.end = refinement.refine(change, |finer| fits(self.case, finer, self.room, self.job));
            if gridded.solved.end.is_some() {
                return self.finished(gridded);
            }
            before = Some(gridded.solved);
        }
    }

    /// All load steps on one grid, each put on disk as it is done.
    fn on_grid(&self, points: [usize; 2]) -> Result<Gridded, Failure> {
        let mut hierarchy = Hierarchy::new(self.case.surface(), self.case.half_space(), points, self.case.solver)
            .map_err(|error| Failure::Refused(error.to_string()))?;
        if self.common.verbose {
            tell!("{}\n{}\n{hierarchy}", self.case.surface(), self.case.half_space());
        }
        terminal::tell_aside(self.claim.begin_finer()?.as_deref(), self.common.quiet);
        write_text(&self.staging.join("case.toml"), &self.case.to_toml())?;
        let mut fields = Fields::new(&self.staging)?;
        interruption::steps(0, self.controls.len(), &self.staging);
        let mut stresses = None;
        let mut last = None;
        let progress = self.progress();
        let mut solved = Solved { steps: Vec::new(), observables: Vec::new(), accuracy: None, end: None };
        for &control in &self.controls {
            // Its memory goes before the next one takes as much.
            drop(last.take());
            let solution = hierarchy.solve(control, &mut |iteration| {
                progress.set_message(format!("iteration {}, ε = {:.1e}", iteration.iteration, iteration.residual));
            });
            let observables = observe(&hierarchy, &solution);
            if self.common.verbose {
                tell!("{observables}\n{}\n{}", solution.report, solution.certificate);
            }
            fields.add(hierarchy.grid(), observables.mean_pressure, &solution)?;
            let errors = errors(&hierarchy, &observables, control);
            let mut step = Step::new(&observables, &errors, &solution, points);
            if let Some(section) = &self.case.stress {
                progress.set_message("stresses");
                let field = Field::new(hierarchy.grid(), &solution.pressure, self.case.half_space(), section.mean);
                if observables.max_pressure > 0.0 {
                    step.stress = Some(largest(&field, &hierarchy, &observables));
                }
                let stresses = match &mut stresses {
                    Some(stresses) => stresses,
                    None => stresses.insert(Stresses::new(&self.staging, wanted(self.case, section, &field))?),
                };
                stresses.add(&field)?;
            }
            solved.steps.push(step);
            solved.observables.push(observables);
            self.record(&solved.steps, false, &[], None)?;
            interruption::steps(solved.steps.len(), self.controls.len(), &self.staging);
            last = Some(solution);
            progress.inc(1);
        }
        progress.finish_and_clear();
        Ok(Gridded { hierarchy, last, fields, stresses, solved })
    }

    /// A sign of life while something without steps goes on.
    fn spinner(&self, what: &str) -> ProgressBar {
        if !self.common.shows_progress() {
            return ProgressBar::hidden();
        }
        let spinner = ProgressBar::new_spinner().with_message(what.to_owned());
        spinner.enable_steady_tick(std::time::Duration::from_millis(200));
        spinner
    }

    fn progress(&self) -> ProgressBar {
        if !self.common.shows_progress() {
            return ProgressBar::hidden();
        }
        let style = ProgressStyle::with_template("{bar:24} step {pos}/{len}  {msg}");
        ProgressBar::new(self.controls.len() as u64).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
    }

    /// `summary.json` and `curve.csv` of what is done.
    fn record(
        &self,
        steps: &[Step],
        complete: bool,
        warnings: &[String],
        accuracy: Option<f64>,
    ) -> Result<(), Failure> {
        let summary = Summary {
            percoat: env!("CARGO_PKG_VERSION"),
            title: &self.case.title,
            case: self.case,
            complete,
            warnings,
            accuracy,
            steps,
        };
        write_text(&self.staging.join("summary.json"), &summary.to_json())?;
        write_text(&self.staging.join("curve.csv"), &curve(steps))?;
        Ok(())
    }

    /// The result takes the place of the one before.
    fn publish(self, folder: &Path) -> Result<(), Failure> {
        let mut saved = interruption::hold();
        let aside = self.claim.publish()?;
        *saved = Saved::Result(folder.to_owned());
        terminal::tell_aside(aside.as_deref(), self.common.quiet);
        Ok(())
    }

    fn warnings(&self, solved: &Solved) -> Vec<String> {
        let mut warnings = Vec::new();
        let steps = || (1..).zip(&solved.steps);
        let list = |numbers: &[usize]| numbers.iter().map(usize::to_string).collect::<Vec<_>>().join(", ");
        let is_unresolved = |step: &Step| step.stop_reason == StopReason::Unresolved.to_string();
        let unresolved: Vec<usize> =
            steps().filter(|(_, step)| is_unresolved(step)).map(|(number, _)| number).collect();
        if !unresolved.is_empty() {
            warnings.push(format!(
                "the penetration of step {} reaches hardly a sample: contact is no wider than the grid's spacing, \
                 and its load is unknown; raise grid.points, or prescribe more",
                list(&unresolved)
            ));
        }
        let is_failed = |step: &Step| !step.converged && !is_unresolved(step);
        let failed: Vec<usize> = steps().filter(|(_, step)| is_failed(step)).map(|(number, _)| number).collect();
        if !failed.is_empty() {
            warnings.push(format!("not converged: step {}; judge it by its certificate", list(&failed)));
        }
        let coarse: Vec<usize> = steps()
            .filter(|(_, step)| step.levels.iter().any(|level| level.load > 0.0 && level.resolution < FEW_SAMPLES))
            .map(|(number, _)| number)
            .collect();
        if !coarse.is_empty() {
            warnings.push(format!(
                "a contact radius has less than {FEW_SAMPLES} samples in step {}: its radius and peak pressure are rough; \
                 raise grid.points",
                list(&coarse)
            ));
        }
        // Complete contact has no edge that samples would have to show.
        let rough = |step: &Step| {
            step.levels.is_empty()
                && 0.0 < step.spot_resolution
                && step.spot_resolution < FEW_SAMPLES
                && step.contact_fraction < 1.0
        };
        let rough: Vec<usize> = steps().filter(|(_, step)| rough(step)).map(|(number, _)| number).collect();
        if !rough.is_empty() {
            warnings.push(format!(
                "half of the load lies on contact spots of less than {FEW_SAMPLES} samples to the radius in step {}: contact \
                 area and pressures are rough; give the topography on more points",
                list(&rough)
            ));
        }
        if let Some(end) = solved.end.filter(|_| !solved.is_accurate()) {
            let reached = match solved.accuracy {
                Some(change) => format!("the last change was {change:.1e}"),
                None => "there is one grid only".to_owned(),
            };
            warnings.push(format!("grid.accuracy is not reached: {reached}, and {end}"));
        }
        let rough = |step: &&Step| step.stress.as_ref().is_some_and(|stress| stress.surface_error > WORTH_SAYING);
        let worst = solved.steps.iter().filter(rough).filter_map(|step| step.stress.as_ref());
        if let Some(error) = worst.map(|stress| stress.surface_error).reduce(f64::max) {
            warnings.push(format!(
                "stresses on the surface near the edge of contact may err by {:.0} % (stress.surface_error of each step); \
                 raise grid.points",
                100.0 * error
            ));
        }
        warnings
    }
}

fn print(case: &Case, solved: &Solved, folder: &Path, started: Instant) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    if !case.title.is_empty() {
        writeln!(out, "{}", case.title)?;
    }
    writeln!(out, "\n{}\n", table::steps(&solved.steps))?;
    let steps = &solved.steps;
    let [n1, n2] = steps.last().map_or([0, 0], |step| step.points);
    let most = steps.iter().map(|step| step.iterations).max().unwrap_or(0);
    // Unlike f64::max this keeps what is not a number.
    let gap = steps.iter().map(|step| step.certificate.energy_gap).fold(0.0, |a, b| if b <= a { a } else { b });
    let done = steps.iter().filter(|step| step.converged).count();
    writeln!(
        out,
        "{done} of {} load steps converged on {n1} × {n2} samples, at most {most} iterations each, energy within {gap:.0e} of its minimum",
        steps.len()
    )?;
    for (number, stress) in (1..).zip(steps).filter_map(|(n, step): (usize, _)| Some((n, step.stress.as_ref()?))) {
        if steps.len() <= table::DETAILED {
            writeln!(out, "step {number}: {}", table::stress(stress))?;
        }
    }
    if let Some(errors) = table::largest_errors(steps) {
        writeln!(out, "{errors}")?;
    }
    if let Some(accuracy) = solved.accuracy {
        writeln!(out, "change from the next coarser grid: {accuracy:.1e}")?;
    }
    writeln!(out, "{:.2} s; written to {}", started.elapsed().as_secs_f64(), folder.display())?;
    Ok(())
}

/// The room there is for a job that writes into `folder`; what does not find enough is refused before any is taken.
pub fn room_or_refusal(case: &Case, folder: &Path, job: Job) -> Result<Room, Failure> {
    let room = Room::on_this_machine(folder);
    refusal(case, room, job).map_or(Ok(room), |why| Err(Failure::Refused(why)))
}

/// No load reaches a penetration at which contact is complete: refused before anything is written.
pub fn refuse_beyond_full_contact(case: &Case, controls: &[Control]) -> Result<(), Failure> {
    if matches!(case.load, LoadSection::MeanPressure(_)) {
        return Ok(());
    }
    let surface = case.surface();
    let points = match case.grid {
        GridSection::Points(points) => points,
        GridSection::Accuracy(_) => balanced_points(&surface.cell(), 8 * FIRST_POINTS),
    };
    let grid = Grid::new(surface.cell(), points).map_err(|error| Failure::Refused(error.to_string()))?;
    let full = surface.sample(&grid).mean();
    for control in controls {
        if let Control::Penetration(penetration) = *control
            && penetration >= full
        {
            return Err(Failure::Refused(format!(
                "load.penetration = {penetration} is out of reach: contact becomes complete at {}, \
                 and no further however large the load; prescribe less, or mean_pressure instead",
                number(full)
            )));
        }
    }
    Ok(())
}
