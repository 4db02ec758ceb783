//! `percoat compare`: spectral and localized solution of a case side by side.

use super::ending::{Ending, Failure};
use super::input::{output_folder, read_case};
use super::interruption;
use super::options::{Changes, Common};
use super::pictures::PictureOptions;
use super::progress::Progress;
use super::terminal;
use crate::case::feasibility::Allowed;
use crate::case::plausibility;
use crate::case::resources::Job;
use crate::output::{Plan, RunFolder, Writer, compare_json, table, write_text};
use crate::picture;
use crate::plain;
use crate::run::{End, Run, Sampling};
use std::io::Write;
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Instant;

pub fn run(
    case: Option<&Path>,
    changes: &Changes,
    pictures: &PictureOptions,
    common: &Common,
) -> Result<Ending, Failure> {
    let (case, name) = read_case(case, &changes.set)?;
    if case.counterbody().indenters().is_none() {
        return Err(Failure::Refused(
            "compare needs [[levels]]: the localized method knows indenters, not a [surface]; use percoat solve"
                .to_owned(),
        ));
    }
    let folder = output_folder(common, &name)?;
    let started = Instant::now();
    let (task, steps) = (case.comparison(), case.load.values().len());
    let run = Run { loads: vec![task.load], stress: None, ..case.run() };
    let job = Job::Compare { pictures: pictures.wanted() };
    let mut allowed = Allowed::new(&case, &folder, job).map_err(Failure::Refused)?;
    run.check()?;
    task.check().map_err(Failure::refused)?;
    interruption::watch();
    let names = ["compare.json".to_owned()].into_iter().chain(pictures.files(&["comparison"])).collect();
    let claim = RunFolder::claim(&folder, Plan { names, ..Plan::new(Writer::Compare) })?;
    terminal::tell_aside(claim.set_aside(), common.quiet);
    let (points, end) = match case.grid {
        Sampling::Points(points) => (points, End::Reached),
        Sampling::Accuracy(_) => {
            let refined = run.solve(&mut allowed)?;
            (refined.points, refined.end.unwrap_or(End::Reached))
        }
    };
    let progress = Progress::new("", 0, 0, common);
    let comparison = task.compare(points, &mut |what| {
        if common.verbose {
            progress.tell(what);
        }
        progress.say(what);
        ControlFlow::Continue(())
    });
    progress.finish();
    let comparison = comparison.map_err(Failure::refused)?;

    let json = compare_json(&comparison, &case, steps);
    write_text(&claim.staging().join("compare.json"), &json)?;
    pictures.write(&claim.staging(), "comparison", || picture::comparison(&case.title, &case.units(), &comparison))?;
    interruption::publish(claim, &folder, common.quiet)?;
    if common.json {
        write!(terminal::out(), "{json}")?;
    } else if !common.quiet {
        let mut out = terminal::out();
        write!(out, "{}", table::compared(&case, &comparison, terminal::width()))?;
        writeln!(out, "{:.2} s; written to {}", started.elapsed().as_secs_f64(), plain::path(&folder))?;
    }
    let mut warnings = [comparison.warnings(), plausibility::of_case(&case)].concat();
    if end != End::Reached {
        warnings.push(format!("grid.accuracy is not reached: {end}"));
    }
    terminal::warn(&warnings, common.quiet);
    let converged = comparison.converged() && end == End::Reached;
    Ok(if converged { Ending::Done } else { Ending::NotConverged })
}
