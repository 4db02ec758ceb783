//! `percoat compare`: spectral and localized solution of a case side by side.

use super::interruption::{self, Saved};
use super::pictures::PictureOptions;
use super::solve::room_or_refusal;
use super::terminal::{self, tell};
use super::{Common, Failure, Outcome, read_case};
use indicatif::ProgressBar;
use percoat::case::resources::{Job, fits};
use percoat::comparison::{Comparison, Task};
use percoat::localized::{CircleRadius, Setup, Stop};
use percoat::output::{CompareFile, Plan, RunFolder, Writer, number, table, write_text};
use percoat::reading::FEW_SAMPLES;
use percoat::run::accuracy::End;
use percoat::run::{Run, Sampling};
use percoat::{MeanStress, picture};
use std::io::Write;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

pub fn run(case: Option<&Path>, pictures: &PictureOptions, common: &Common) -> Result<Outcome, Failure> {
    let (case, name) = read_case(case, common)?;
    if case.counterbody().indenters().is_none() {
        return Err(Failure::Refused(
            "compare needs [[levels]]: the localized method knows indenters, not a [surface]; use percoat solve"
                .to_owned(),
        ));
    }
    let folder = common.output.clone().unwrap_or_else(|| Path::new("out").join(&name));
    let started = Instant::now();
    let loads = case.load.loads();
    let Some(&load) = loads.last() else { return Err(Failure::Refused("the case has no load step".to_owned())) };
    let run = Run { loads: vec![load], stress: None, ..case.run() };
    let job = Job::Compare { pictures: pictures.wanted() };
    let room = room_or_refusal(&case, &folder, job)?;
    run.check()?;
    interruption::watch();
    let names = ["compare.json".to_owned()].into_iter().chain(pictures.files(&["comparison"])).collect();
    let plan = Plan { names, ..Plan::new(Writer::Compare) };
    let claim = RunFolder::claim(&folder, &plan)?;
    terminal::tell_aside(claim.set_aside(), common.quiet);
    let localized = &case.localized;
    let setup = Setup {
        indenters: localized.indenters.iter().copied().max().unwrap_or(1),
        elements: localized.elements,
        radius: localized.radius,
        mutual_effect: localized.mutual_effect,
    };
    let task = Task {
        problem: Arc::clone(case.problem()),
        load,
        settings: case.solver,
        setup,
        indenters: localized.indenters.clone(),
        mean: case.stress.as_ref().map_or(MeanStress::default(), |stress| stress.mean),
    };
    let (points, end) = match case.grid {
        Sampling::Points(points) => (points, End::Reached),
        Sampling::Accuracy(_) => {
            let refined = run.solve(&mut (), &|points| fits(&case, points, room, job))?;
            (refined.points, refined.end.unwrap_or(End::Reached))
        }
    };
    let progress = if common.shows_progress() { ProgressBar::new_spinner() } else { ProgressBar::hidden() };
    let comparison = task.compare(points, &mut |what| {
        progress.set_message(what.to_owned());
        progress.tick();
        if common.verbose {
            tell!("{what}");
        }
    });
    progress.finish_and_clear();
    let comparison = comparison.map_err(|error| Failure::Refused(error.to_string()))?;

    let file =
        CompareFile::new(&comparison, &case.title, &case, loads.len(), setup.radius, setup.mutual_effect).to_json();
    write_text(&claim.staging().join("compare.json"), &file)?;
    pictures.write(&claim.staging(), "comparison", || {
        picture::comparison(&case.title, case.problem(), &comparison, setup.radius)
    })?;
    let mut saved = interruption::hold();
    terminal::tell_aside(claim.publish()?.as_deref(), common.quiet);
    *saved = Saved::Result(folder.clone());
    drop(saved);
    if !common.quiet {
        let mut out = std::io::stdout().lock();
        if !case.title.is_empty() {
            writeln!(out, "{}", case.title)?;
        }
        if loads.len() > 1 {
            writeln!(out, "the last of {} load steps", loads.len())?;
        }
        writeln!(out, "\n{}\n\n{}\n", table::readings(&comparison, &setup), table::differences(&comparison, &setup))?;
        if let Some(text) = stresses(&comparison) {
            writeln!(out, "{text}")?;
        }
        writeln!(out, "{:.2} s; written to {}", started.elapsed().as_secs_f64(), folder.display())?;
    }
    let doubts = doubts(&comparison, &setup, end);
    if !common.quiet {
        doubts.iter().for_each(|doubt| tell!("warning: {doubt}"));
    }
    let all_solved = comparison.circles.iter().all(|circle| circle.stop == Stop::Converged);
    let solved = comparison.step.report.stop.solved() && all_solved && end == End::Reached;
    Ok(if solved { Outcome::Done } else { Outcome::NotConverged })
}

/// What makes the comparison doubtful, a sentence each.
fn doubts(comparison: &Comparison, setup: &Setup, end: End) -> Vec<String> {
    let (circles, other) = (&comparison.circles[..], &comparison.other_rule[..]);
    let lattice_sum = comparison.lattice_sum.as_slice();
    let rules = [(setup.radius, circles), (setup.radius.other(), other), (CircleRadius::LatticeSum, lattice_sum)];
    let circles = rules.iter().flat_map(|(rule, circles)| circles.iter().map(move |circle| (rule, circle)));
    let mut doubts: Vec<String> = circles
        .filter(|(_, circle)| circle.stop != Stop::Converged)
        .map(|(rule, circle)| format!("{} circle of {} indenters: {}", rule.name(), circle.indenters, circle.stop))
        .collect();
    if !comparison.step.report.stop.solved() {
        doubts.push(format!("the spectral solution has not converged: {}", comparison.step.report));
    }
    if end != End::Reached {
        doubts.push(format!("grid.accuracy is not reached: {end}"));
    }
    let samples = comparison.reading.levels.iter().filter(|level| level.load > 0.0).map(|level| level.resolution);
    let fewest = samples.fold(f64::INFINITY, f64::min);
    if fewest < FEW_SAMPLES {
        doubts.push(format!(
            "a contact radius has only {fewest:.1} samples in the spectral solution: differences from it are those of the \
             grid; raise grid.points"
        ));
    }
    doubts
}

/// How far the stresses agree, in a line.
fn stresses(comparison: &Comparison) -> Option<String> {
    let worst = comparison.stresses.iter().max_by(|a, b| a.difference().total_cmp(&b.difference()))?;
    let largest = comparison.stresses.iter().flat_map(|pair| pair.spectral.components()[..6].to_vec());
    let largest = largest.fold(0.0, |most: f64, stress| most.max(stress.abs()));
    Some(format!(
        "stresses at {} points under the highest level agree within {:.2} % of the largest, worst at z = {} in material {}",
        comparison.stresses.len(),
        100.0 * worst.difference() / largest,
        number(worst.depth.z),
        worst.depth.material
    ))
}
