//! Warnings about the results of a run, a sentence each.
//!
//! The theory is one of small strains and small slopes: under an indenter the strain is about the slope of its flank at
//! the edge of contact, f′(a), and p₀ about ½ E* f′(a). Beyond a slope of ½, a peak pressure of E*/3, a real body is not linear.

use super::accuracy::RefinementEnd;
use super::words::{Numbered, STEEP, list, ratio};
use super::{StepRecord, ended, tip};
use crate::adhesion::AdhesionLaw;
use crate::counterbody::Shape;
use crate::counterbody::roughness::Window;
use crate::notation::number;
use crate::numeric::search::largest;
use crate::problem::Problem;
use crate::reading::{Errors, FEW_SAMPLES, JumpKind, Reading};
use crate::spectral::{FEW_ACROSS, MIN_POINTS, Stop, soft_end};
use std::f64::consts::PI;

/// Part of load or contact on tapered heights from which on there is a warning.
const TAPERED_PART: f64 = 0.02;
/// Fraction in contact from which on the mean lateral stress is a large part of all stresses.
const FILLED: f64 = 0.5;
/// Relative change of force or shift against half as many parts of a step of partial slip from which on there is a warning.
const COARSE: f64 = 0.05;
/// Relative error of the stresses on the surface from which on there is a warning.
const SURFACE_ERROR: f64 = 0.02;

/// Warnings about the steps of a run, and about its refinement by its `end` and last `change`.
pub(crate) fn warnings(
    problem: &Problem,
    steps: &[StepRecord],
    end: Option<RefinementEnd>,
    change: Option<f64>,
) -> Vec<String> {
    let steps: Vec<Numbered> = (1..).zip(steps).collect();
    let dropped = dropped(problem, &steps);
    of_judged(problem, &steps, &steps, end, change).into_iter().chain(dropped).collect()
}

/// Warnings about the steps of a search: about the convergence of all, and about the results of those that are `judged`.
pub(super) fn of_judged(
    problem: &Problem,
    all: &[Numbered],
    judged: &[Numbered],
    end: Option<RefinementEnd>,
    change: Option<f64>,
) -> Vec<String> {
    let warnings = [
        unresolved(all),
        beyond_hardness(all),
        slips_beyond_hardness(problem, all),
        coarse_path(judged),
        detached(all),
        coarse_zone(judged),
        early_jumps(problem, judged),
        not_converged(all),
        at_window(problem, all),
        without_errors(judged),
        few_samples(judged),
        small_spots(judged),
        end.and_then(|end| not_accurate(end, change)),
        rough_surface(judged),
        edges_of_discs(problem, judged),
        mean_matters(problem, judged),
        at_border(problem, judged),
        steep_flank(problem, judged),
        tip::beyond(problem, judged),
        ended::high_pressure(problem, judged),
        ended::ended(problem, judged),
        ended::beyond(problem, judged),
    ];
    warnings.into_iter().flatten().collect()
}

fn unresolved(steps: &[Numbered]) -> Option<String> {
    let list = list(steps, |step| step.stop == Stop::Unresolved)?;
    Some(format!(
        "the penetration of step {list} brings hardly a sample into contact: it is no wider than the spacing of the samples, and its \
         load is unknown; raise grid.points, or prescribe a larger penetration"
    ))
}

fn beyond_hardness(steps: &[Numbered]) -> Option<String> {
    let list = list(steps, |step| step.stop == Stop::BeyondHardness)?;
    Some(format!(
        "step {list} brings the whole surface to its hardness: a larger penetration has the same pressure, and a larger load has no \
         solution; prescribe less"
    ))
}

/// Partial slip of surfaces whose hardness the pressure exceeds.
fn slips_beyond_hardness(problem: &Problem, steps: &[Numbered]) -> Option<String> {
    let (hardness, _) = problem.largest_hardness()?;
    let peak = |step: &StepRecord| step.tangential.as_ref().map_or(0.0, |_| step.reading.grid_peak());
    let list = list(steps, |step| peak(step) > hardness)?;
    let most = steps.iter().map(|(_, step)| peak(step)).fold(0.0, f64::max);
    Some(format!(
        "partial slip is of elastic surfaces, and the peak pressure {} of step {list} is beyond the hardness {} of the softer one: it would \
         yield; prescribe less",
        number(most),
        number(hardness)
    ))
}

/// Steps of partial slip in which load and force, or the way rolled, change too much at once.
fn coarse_path(steps: &[Numbered]) -> Option<String> {
    let change = |step: &StepRecord| step.tangential.as_ref().map_or(0.0, |slip| slip.change);
    let list = list(steps, |step| change(step) > COARSE)?;
    let most = largest(steps.iter().map(|(_, step)| change(step)));
    Some(format!(
        "tangential force or shift of step {list} is uncertain by up to {} %: so much half as many parts of the step change it; bring load and force \
         up in more steps, or roll by a shorter tangential.rolling.step",
        number(100.0 * most)
    ))
}

/// Steps under a tensile force that nothing bears.
fn detached(steps: &[Numbered]) -> Option<String> {
    let list = list(steps, |step| step.stop == Stop::Detached)?;
    Some(format!(
        "nothing bears the tensile load of step {list}: the surfaces have come apart; prescribe load.penetration or load.grip to follow them beyond \
         pull-off"
    ))
}

/// Steps whose grid has few samples across the zone in which surfaces that adhere pull beside contact.
fn coarse_zone(steps: &[Numbered]) -> Option<String> {
    let samples = |step: &StepRecord| step.adhesion.as_ref().map_or(f64::INFINITY, |adhesion| adhesion.samples);
    let list = list(steps, |step| samples(step) < FEW_ACROSS)?;
    let least = steps.iter().map(|(_, step)| samples(step)).fold(f64::INFINITY, f64::min);
    Some(format!(
        "the zone in which the surfaces pull beside contact has {} samples in step {list}: forces may be a few per cent off; raise grid.points",
        number(least)
    ))
}

/// Jumps into contact by Dugdale's law, whose end is soft on a grid.
fn early_jumps(problem: &Problem, steps: &[Numbered]) -> Option<String> {
    let adhesion = problem.adhesion().filter(|adhesion| adhesion.law() == AdhesionLaw::Dugdale)?;
    let comes_together = |step: &StepRecord| {
        let jumps = step.adhesion.iter().flat_map(|adhesion| &adhesion.jumps);
        jumps.into_iter().any(|jump| jump.kind == JumpKind::In)
    };
    let list = list(steps, comes_together)?;
    let samples =
        steps.iter().filter_map(|(_, step)| Some(step.adhesion.as_ref()?.samples)).fold(f64::INFINITY, f64::min);
    let early = 0.5 * soft_end(samples) * adhesion.range();
    Some(format!(
        "the surfaces jump together in step {list}: on this grid the tension ends softly, up to {} beyond its range, and they jump up to so much too \
         early; a finer grid, or law = \"exponential\", has no such error",
        number(early)
    ))
}

/// Whether a stop has a warning of its own.
fn is_told(stop: Stop) -> bool {
    matches!(stop, Stop::Unresolved | Stop::AtBorder | Stop::BeyondHardness | Stop::Detached)
}

/// Warning of what a path presses into a softer body that slides away below the counterbody.
fn dropped(problem: &Problem, steps: &[Numbered]) -> Option<String> {
    let (_, before) = steps.split_last()?;
    let is_pressed_in = |step: &StepRecord| step.plastic.is_some_and(|plastic| plastic.is_pressed_in());
    let list = list(before, is_pressed_in).filter(|_| problem.is_swept())?;
    Some(format!(
        "the indentation left by step {list} is dropped: the body is the softer one and moves away below the sliding counterbody \
         ([friction]), so that each load meets a fresh surface; for loads one after another at one place leave [friction] out, or set its \
         coefficient to 0"
    ))
}

fn not_converged(steps: &[Numbered]) -> Option<String> {
    let list = list(steps, |step| !step.converged() && !is_told(step.stop))?;
    Some(format!("not converged: step {list}; judge it by its certificate"))
}

/// Isolated contact that reaches the border of its window.
fn at_window(problem: &Problem, steps: &[Numbered]) -> Option<String> {
    let list = list(steps, |step| step.stop == Stop::AtBorder)?;
    let [[width, _], [_, height]] = problem.cell().vectors();
    Some(format!(
        "contact reaches the border of the window of {} × {} in step {list}, and would extend beyond it: enlarge lattice.size, \
         to twice that or more",
        number(width),
        number(height)
    ))
}

/// Steps that no coarser grid has solved too.
fn without_errors(steps: &[Numbered]) -> Option<String> {
    let is_alone = |step: &StepRecord| {
        let is_pressed = step.converged() && !step.kind().is_given && step.is_loaded();
        is_pressed && step.reading.errors == Errors::default()
    };
    let adheres = steps.iter().any(|(_, step)| step.adhesion.is_some());
    let list = list(steps, is_alone)?;
    if adheres {
        return Some(format!(
            "no coarser grid has solved step {list}, so the errors of the contact and of all that follows from it are unknown: half of the points do \
             not resolve the zone in which the surfaces pull beside contact; raise grid.points"
        ));
    }
    Some(format!(
        "no coarser grid has solved step {list}, so the errors of the contact and of all that follows from it are unknown: solver.method = \
         \"preconditioned\" solves one from grid.points = {} along each side on, unless the load brings it to complete contact or to its \
         hardness; raise grid.points, or take a smaller load",
        2 * MIN_POINTS
    ))
}

fn few_samples(steps: &[Numbered]) -> Option<String> {
    let coarse =
        |step: &StepRecord| step.reading.levels.iter().any(|level| level.touches() && level.resolution < FEW_SAMPLES);
    let list = list(steps, coarse)?;
    Some(format!(
        "a contact radius has fewer than {FEW_SAMPLES} samples in step {list}: its radius and peak pressure are rough; raise \
         grid.points"
    ))
}

/// Few samples in the spots of a topography; complete contact has no edge to be resolved.
fn small_spots(steps: &[Numbered]) -> Option<String> {
    let rough = |step: &StepRecord| {
        let reading = &step.reading;
        reading.levels.is_empty()
            && 0.0 < reading.spot_resolution
            && reading.spot_resolution < FEW_SAMPLES
            && !is_complete(reading)
    };
    let list = list(steps, rough)?;
    if steps.iter().any(|(_, step)| step.kind().is_given) {
        return Some(format!(
            "half of the load lies on spots of fewer than {FEW_SAMPLES} samples to the radius: stresses near the surface are rough; raise \
             grid.points"
        ));
    }
    Some(format!(
        "half of the load lies on contact spots of fewer than {FEW_SAMPLES} samples to the radius in step {list}: contact area \
         and pressures are rough; give the topography on more points"
    ))
}

/// Whether contact is complete; that of an isolated contact never is.
fn is_complete(reading: &Reading) -> bool {
    reading.contact_fraction.is_some_and(|part| part >= 1.0)
}

fn not_accurate(end: RefinementEnd, change: Option<f64>) -> Option<String> {
    let reached = match change {
        Some(change) => format!("the last change was {change:.1e}"),
        None => "there is one grid only".to_owned(),
    };
    (end != RefinementEnd::Reached).then(|| format!("grid.accuracy is not reached: {reached}, and {end}"))
}

fn rough_surface(steps: &[Numbered]) -> Option<String> {
    let worst = largest(steps.iter().filter_map(|(_, step)| Some(step.stress.as_ref()?.surface_error)));
    // An error that is not a number is reported too.
    if worst <= SURFACE_ERROR {
        return None;
    }
    Some(format!(
        "stresses on the surface near the edge of contact may err by {:.0} % (stress.surface_error of each step); raise \
         grid.points",
        100.0 * worst
    ))
}

/// Stresses on the surface at the edges of discs under a uniform traction, which no grid resolves.
fn edges_of_discs(problem: &Problem, steps: &[Numbered]) -> Option<String> {
    let given = problem.given_pressure()?;
    let slides = problem.friction().is_some_and(|friction| friction.coefficient() > 0.0);
    let is_read = slides && steps.iter().any(|(_, step)| has_stresses(step));
    (is_read && !given.loaded_discs().is_empty()).then(|| {
        "a traction that ends with a jump at the edge of a disc makes lateral stresses there that grow like the logarithm of the distance, \
         without bound: what is stated on the surface is that at about a sample from the edge, and what fails there fails on a fine grid \
         at less; give a pressure that falls to zero from a file, or judge below the surface"
            .to_owned()
    })
}

/// Whether stresses were searched, all or those of strengths.
fn has_stresses(step: &StepRecord) -> bool {
    step.stress.is_some() || !step.strength.is_empty()
}

/// Stresses of contacts that fill much of their cell, in which the mean lateral stress has a large part.
fn mean_matters(problem: &Problem, steps: &[Numbered]) -> Option<String> {
    let fills =
        |step: &StepRecord| has_stresses(step) && step.reading.contact_fraction.is_some_and(|part| part > FILLED);
    problem.indenters()?;
    let list = list(steps, fills)?;
    Some(format!(
        "contact fills more than {:.0} % of the cell in step {list}: lateral stresses depend on stress.mean, which a periodic system \
         does not determine: \"confined\" admits no mean lateral strain, \"half-space\" is a patch on a large body",
        100.0 * FILLED
    ))
}

/// Contact where the window of a topography tapers its heights.
fn at_border(problem: &Problem, steps: &[Numbered]) -> Option<String> {
    let window = problem.topography()?.run_out()?.window;
    let part = |step: &StepRecord| step.tapered.map_or(0.0, |tapered| tapered.load.max(tapered.area));
    let list = list(steps, |step| part(step) > TAPERED_PART)?;
    let worst = steps.iter().filter_map(|(_, step)| step.tapered).max_by(|a, b| a.load.total_cmp(&b.load))?;
    let advice = match window {
        Window::Hann => {
            "\"hann\" is below 1 everywhere and made for spectra: press the surface with surface.window = \"tukey\""
        }
        Window::Tukey => "press less, or a surface that is periodic without a window",
    };
    Some(format!(
        "surface.window: up to {:.0} % of the load and {:.0} % of the contact stand where the window is below 1, in step {list}: \
         heights there are not those of the surface; {advice}",
        100.0 * worst.load,
        100.0 * worst.area
    ))
}

/// The steepest flank at an edge of contact; the slope of cones is given in the case.
fn steep_flank(problem: &Problem, steps: &[Numbered]) -> Option<String> {
    let levels = problem.levels();
    let flanks = steps.iter().flat_map(|&(number, step)| {
        let touching = step.reading.levels.iter().filter(|level| level.touches());
        // Merged contacts have no radius, but an area.
        touching.map(move |level| (number, level.level, (level.contact_area / PI).sqrt()))
    });
    let slope = |level: usize, radius: f64| levels[level - 1].shape().slope(radius);
    let steepest = flanks
        .filter(|(_, level, _)| !matches!(levels[level - 1].shape(), Shape::Cone { .. }))
        .max_by(|a: &(usize, usize, f64), b| slope(a.1, a.2).total_cmp(&slope(b.1, b.2)));
    let (step, level, radius) = steepest.filter(|&(_, level, radius)| slope(level, radius) > STEEP)?;
    let question = "are lengths, load and moduli in consistent units?";
    Some(flank(&format!("step {step}"), problem, level, radius, question))
}

/// Warning that the flank of a level, from 1, is steep at the edge of a contact of radius a, with a question that says what to do.
pub fn flank(context: &str, problem: &Problem, level: usize, a: f64, question: &str) -> String {
    let shape = problem.levels()[level - 1].shape();
    let size = match *shape {
        Shape::Paraboloid { radius } | Shape::Sphere { radius } if a >= radius => {
            format!("is larger than the indenter's radius {}", number(radius))
        }
        Shape::Paraboloid { radius } | Shape::Sphere { radius } => {
            format!("is {} of the indenter's radius {}", ratio(a / radius), number(radius))
        }
        _ => format!("reaches up to where the flank has the slope {}", ratio(shape.slope(a))),
    };
    let name = problem.level_name(level);
    format!(
        "{context}: the contact radius {} under {name} {size}: strains are not small any more; {question}",
        number(a)
    )
}
