//! `percoat compare`: spectral and localized solution of a case side by side.

use super::declared::Declared::{self, Picture, Text};
use super::declared::plan;
use super::ending::{Ending, Failure};
use super::input::{output_folder, read_case};
use super::options::Common;
use super::progress::Progress;
use super::results::Results;
use super::terminal;
use percoat_app::output::{ComparisonFile, Writer, table};
use percoat_app::picture;
use percoat_case::case::feasibility::Allowed;
use percoat_case::case::resources::Job;
use percoat_case::case::{Case, plausibility};
use percoat_core::comparison::{Comparison, ComparisonTask};
use percoat_core::run::{RefinementEnd, Run, Sampling};
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Instant;

pub fn run(case: Option<&Path>, set: &[String], common: &Common) -> Result<Ending, Failure> {
    let (case, name) = read_case(case, set)?;
    if case.problem().indenters().is_none() {
        return Err(Failure::refused(
            "compare needs [[levels]]: the localized method knows indenters, not a [surface] or a given pressure; use percoat solve",
        ));
    }
    let folder = output_folder(common, &name)?;
    let (started, pictures) = (Instant::now(), &common.pictures);
    let (task, steps) = (case.comparison(), case.load.values().len());
    let run = Run { loads: vec![task.load], stress: None, ..case.run() };
    let job = Job::Compare { pictures: pictures.wanted() };
    let allowed = Allowed::new(&case, &folder, job).map_err(Failure::Refused)?;
    run.check()?;
    task.check().map_err(Failure::refused)?;
    let results = Results::claim(folder, plan(Writer::Compare, &files(), pictures), common.saying())?;
    let (points, end) = grid(&case, &run, allowed)?;
    let comparison = compare(&task, points, common)?;
    results.write_all(&files(), &Compared { case: &case, comparison: &comparison, steps }, pictures)?;
    let mut warnings = [comparison.warnings(), plausibility::of_case(&case)].concat();
    if end != RefinementEnd::Reached {
        warnings.push(format!("grid.accuracy is not reached: {end}"));
    }
    let tables = || table::compared(&case, &comparison, terminal::width());
    let line = || format!("{:.2} s", started.elapsed().as_secs_f64());
    results.finish("compare.json", tables, line, &warnings)?;
    Ok(Ending::of(comparison.converged() && end == RefinementEnd::Reached))
}

/// Both solutions of a case.
struct Compared<'a> {
    case: &'a Case,
    comparison: &'a Comparison,
    /// Number of load steps of the case.
    steps: usize,
}

/// The files of a comparison.
fn files<'a>() -> [Declared<Compared<'a>>; 2] {
    [
        Text("compare.json", |both| Some(ComparisonFile::new(both.comparison, both.case, both.steps).to_json())),
        Picture("comparison", |both| picture::comparison(&both.case.title, &both.case.units(), both.comparison)),
    ]
}

/// Points of the grid of the spectral solution, and whether the accuracy, if one is prescribed, is reached there.
fn grid(case: &Case, run: &Run, mut allowed: Allowed<'_>) -> Result<([usize; 2], RefinementEnd), Failure> {
    match case.grid {
        Sampling::Points(points) => Ok((points, RefinementEnd::Reached)),
        Sampling::Accuracy(_) => {
            let refined = run.solve(&mut allowed)?;
            Ok((refined.points, refined.end.unwrap_or(RefinementEnd::Reached)))
        }
    }
}

/// Solves the task by both methods on a grid, and shows the progress.
fn compare(task: &ComparisonTask, points: [usize; 2], common: &Common) -> Result<Comparison, Failure> {
    let progress = Progress::new("", 0, 0, common);
    let comparison = task.compare(points, &mut |what| {
        progress.tell(what);
        progress.say(what);
        ControlFlow::Continue(())
    });
    progress.finish();
    comparison.map_err(Failure::refused)
}
