//! Where the elastic solution no longer holds: yield inside, pressures that softer materials beneath the surface do not bear, and penetrations
//! beyond the layers.
//!
//! Contact is solved for bodies that are elastic inside, and yield at the surface alone where that has a hardness. What is stated beyond
//! first yield is of bodies that do not.

use super::StepRecord;
use super::words::{HIGH, Numbered, list, ratio};
use crate::body::{Bodies, HalfSpace, Material, Side};
use crate::notation::number;
use crate::problem::Problem;
use crate::reading::{Beneath, Criterion, PlasticReading, Utilisation, Verdict, pressure_on};

/// Utilisation of yield from which on it is exceeded: a limit is searched up to a part of it.
const EXCEEDED: f64 = 1.02;
/// Part of their thickness from which on what is pressed into layers is held by the substrate too (Bückle's rule).
const OF_THE_LAYERS: f64 = 0.1;

/// Sentence on the steps whose elastic solutions no longer hold, and why; `None` where all hold.
pub(super) fn ended(problem: &Problem, steps: &[Numbered]) -> Option<String> {
    let yields: Vec<&Utilisation> = steps.iter().flat_map(|(_, step)| exceeded(step)).collect();
    let has_ended = |step: &StepRecord| exceeded(step).next().is_some() || step.beneath.is_some();
    let is_deep = |step: &StepRecord| pressed_beyond(problem, step).is_some();
    let list = list(steps, |step| has_ended(step) || is_deep(step))?;
    let mut why: Vec<String> = worst(&yields).into_iter().map(yielding).collect();
    let beneath = steps.iter().filter_map(|(_, step)| step.beneath);
    let is_said = |beneath: &Beneath| yields.iter().any(|known| known.criterion == Criterion::Yield(beneath.material));
    let most = |a: &Beneath, b: &Beneath| (a.pressure / a.hardness).total_cmp(&(b.pressure / b.hardness));
    why.extend(beneath.filter(|beneath| !is_said(beneath)).max_by(most).map(|beneath| beneath.to_string()));
    let pressed = steps.iter().filter_map(|(_, step)| pressed_beyond(problem, step));
    why.extend(pressed.max_by(|a, b| a[0].total_cmp(&b[0])).map(|[depth, thickness]| {
        format!(
            "the depth pressed in, {}, is {} of the thickness of the layers; beyond a tenth of it the hardness is not that of the layers alone",
            number(depth),
            ratio(depth / thickness)
        )
    }));
    let deepest = steps.iter().filter(|(_, step)| has_ended(step)).filter_map(|(_, step)| beyond_layers(problem, step));
    why.extend(
        deepest
            .reduce(f64::max)
            .map(|part| format!("the penetration is {} of the thickness of the layers", ratio(part))),
    );
    Some(format!(
        "the elastic solution no longer holds in step {list}: {}; the numbers of these steps are for bodies that stay elastic inside",
        why.join("; ")
    ))
}

/// Penetrations beyond the layers on a substrate of which nothing says what it bears, and on a rigid base.
pub(super) fn beyond(problem: &Problem, steps: &[Numbered]) -> Option<String> {
    let bodies = problem.bodies();
    let (rigid, judged) = (bodies.body().base_depth().is_finite(), is_judged(bodies));
    let is_beyond = |step: &StepRecord| match beyond_layers(problem, step) {
        Some(part) if rigid => part > HIGH,
        Some(_) => judged == Some(false) && step.beneath.is_none() && exceeded(step).next().is_none(),
        None => false,
    };
    let list = list(steps, is_beyond)?;
    let parts = steps.iter().filter(|(_, step)| is_beyond(step)).filter_map(|(_, step)| beyond_layers(problem, step));
    let part = ratio(parts.fold(0.0, f64::max));
    Some(if rigid {
        format!(
            "the penetration is {part} of the thickness of the layers on a rigid base in step {list}: strains are not small any more"
        )
    } else {
        format!(
            "the penetration is {part} of the thickness of the layers in step {list}: the substrate carries what they do not, and how much \
             it bears is not known; give it a yield_strength or a hardness"
        )
    })
}

/// Utilisations of yield beyond 1, their errors included.
fn exceeded(step: &StepRecord) -> impl Iterator<Item = &Utilisation> {
    let is_yield = |utilisation: &&Utilisation| matches!(utilisation.criterion, Criterion::Yield(_));
    step.strength
        .iter()
        .filter(is_yield)
        .filter(|utilisation| utilisation.verdict == Verdict::Fails && utilisation.value > EXCEEDED)
}

/// The largest utilisation of each criterion, the largest of all first.
fn worst<'a>(all: &[&'a Utilisation]) -> Vec<&'a Utilisation> {
    let mut worst: Vec<&Utilisation> = Vec::new();
    for &utilisation in all {
        match worst.iter_mut().find(|known| known.criterion == utilisation.criterion) {
            Some(known) if known.value < utilisation.value => *known = utilisation,
            Some(_) => {}
            None => worst.push(utilisation),
        }
    }
    worst.sort_by(|a, b| b.value.total_cmp(&a.value));
    worst
}

fn yielding(utilisation: &Utilisation) -> String {
    let value = if utilisation.value.is_infinite() { "∞".to_owned() } else { ratio(utilisation.value) };
    format!("{} has the utilisation {value} at the depth {}", utilisation.criterion, number(utilisation.position[2]))
}

/// Depth pressed in and thickness of the layers of the softer body, lengths, where that is beyond a tenth of it.
fn pressed_beyond(problem: &Problem, step: &StepRecord) -> Option<[f64; 2]> {
    let PlasticReading { depth, .. } = *step.plastic.as_ref()?;
    // A composite hardness has the substrate in it.
    let (_, softer) = problem.hardness().filter(|_| problem.composite_hardness().is_none())?;
    let body = match softer {
        Side::Body => Some(problem.bodies().body()),
        Side::Counterbody => problem.bodies().counterbody(),
    };
    let thickness = thickness(body?)?;
    (depth > OF_THE_LAYERS * thickness).then_some([depth, thickness])
}

/// Penetration over the thickness of the layers of the body, where it is beyond that; on a rigid base always.
fn beyond_layers(problem: &Problem, step: &StepRecord) -> Option<f64> {
    let body = problem.bodies().body();
    let part = step.reading.penetration / thickness(body)?;
    (step.reading.touches() && (part > 1.0 || body.base_depth().is_finite())).then_some(part)
}

/// Thickness of all layers, a length; `None` without any.
fn thickness(body: &HalfSpace) -> Option<f64> {
    body.interface_depths().last().copied()
}

/// Whether yield of the material below the layers is judged; `None` where no material has a hardness or a strength, and nothing is.
fn is_judged(bodies: &Bodies) -> Option<bool> {
    let known = |body: &HalfSpace| -> Vec<[bool; 2]> {
        let all = body.strengths().zip(body.durabilities());
        all.map(|(strength, durability)| {
            [strength.yielding.is_some() || durability.hardness.is_some(), strength.tensile.is_some()]
        })
        .collect()
    };
    let any = bodies.each().flat_map(known).any(|judged| judged.contains(&true));
    any.then(|| known(bodies.body()).last().is_some_and(|judged| judged[0]))
}

/// Pressure over the contact modulus E* of a material that it reaches.
struct Strain {
    part: f64,
    step: usize,
    peak: f64,
    /// Material beneath the surface with its depth, in words; `None` at the surface.
    beneath: Option<String>,
}

/// The largest pressure over E*, of all steps and materials, where strains are not small any more.
pub(super) fn high_pressure(problem: &Problem, steps: &[Numbered]) -> Option<String> {
    let all = steps.iter().flat_map(|step| strains(problem, step)).filter(|strain| strain.part > HIGH);
    let Strain { part, step, peak, beneath } = all.reduce(|a, b| if b.part > a.part { b } else { a })?;
    let (peak, part) = (number(peak), ratio(part));
    let high = match beneath {
        None => format!("the peak pressure {peak} is {part} of E* at the surface"),
        Some(beneath) => {
            format!("under the peak pressure {peak}, the pressure that reaches {beneath} is {part} of its E*")
        }
    };
    Some(format!("step {step}: {high}: strains are not small any more; are load and moduli in one unit?"))
}

/// Sentences of a step: at the surfaces, and at the materials beneath by what reaches them.
fn strains(problem: &Problem, &(step, record): &Numbered) -> Vec<Strain> {
    let reading = &record.reading;
    let of_body = |body: &HalfSpace| -> Vec<Strain> {
        let depths = std::iter::once(0.0).chain(body.interface_depths());
        let of = |(material, (index, depth)): (Material, (usize, f64))| {
            let is_beneath = depth > 0.0;
            // A pressure that is infinite under a tip is left out.
            let pressure = match is_beneath {
                true => pressure_on(problem, reading, record.points, (body, index)),
                false => reading.finite_peak().unwrap_or(0.0),
            };
            let beneath = is_beneath.then(|| format!("{} at the depth {}", body.material_id(index), number(depth)));
            Strain { part: pressure / material.contact_modulus(), step, peak: reading.grid_peak(), beneath }
        };
        body.materials().zip((1..).zip(depths)).map(of).collect()
    };
    problem.bodies().each().flat_map(of_body).collect()
}
