//! The certificate in words: what a solution proves about itself, and how far that is below what convergence asks.

use super::markup::{Markup, tag, with};
use crate::numeric::search::largest;
use crate::run::StepRecord;
use crate::spectral::{Certificate, Stop};

/// A quantity that convergence is judged by.
struct Criterion {
    name: &'static str,
    /// The largest of all steps.
    value: f64,
    /// What it must stay below; `None` where nothing is asked.
    below: Option<f64>,
    means: &'static str,
}

/// What the steps prove; `tolerance` is that of the solver, where the case says it.
pub(super) fn certificate(steps: &[StepRecord], tolerance: Option<f64>) -> Markup {
    let solved: Vec<&StepRecord> = steps.iter().filter(|step| step.reading.mean_pressure > 0.0).collect();
    if solved.is_empty() {
        return Markup::default();
    }
    let at_rounding = solved.iter().any(|step| step.stop == Stop::Rounding);
    let most = |of: fn(&StepRecord) -> f64| largest(solved.iter().map(|&step| of(step)));
    let slides = solved.iter().any(|step| step.friction.is_some());
    let criteria = [
        Criterion {
            name: "Energy gap",
            value: most(|step| step.certificate.energy_gap),
            below: tolerance.map(|tolerance| Certificate::ENERGY_GAP * tolerance),
            means: if slides {
                "The elastic energy of what the pressure still differs by from the exact one of this grid is at most this part \
                 of the whole: a proven bound, however the pressure was found; where friction is coupled it bounds the error, \
                 not an excess of energy."
            } else {
                "The energy of this pressure is at most this part above the least possible one on this grid: a proven bound, \
                 however the pressure was found."
            },
        },
        Criterion {
            name: "Penetration outside contact",
            value: most(|step| step.certificate.penetration),
            below: tolerance.map(|tolerance| Certificate::PENETRATION * tolerance),
            means: "Where there is no pressure the surfaces overlap by at most this part of the penetration; exactly they would \
                    not.",
        },
        Criterion {
            name: "Residual ε",
            value: most(|step| step.residual),
            below: tolerance,
            means: "Pressure times gap, which is zero everywhere in the exact solution, summed over the cell and relative to load \
                    times penetration.",
        },
        Criterion {
            name: "Load",
            value: most(|step| step.certificate.load),
            below: None,
            means: "What was prescribed, mean pressure or penetration, is met to this part.",
        },
    ];
    let entry = |own: &Criterion| vec![tag("dt", stands(own, at_rounding)), tag("dd", own.means)].into();
    let entries: Markup = criteria.iter().map(entry).collect();
    let converged = steps.iter().filter(|step| step.converged()).count();
    let text = if converged == steps.len() && at_rounding {
        "Every load step meets what convergence asks, or comes as near to it as double precision carries: what is above its limit is \
         rounding, measured by computing the gap twice. The certificate speaks of the equations on this grid; what the grid itself \
         leaves open are the errors above."
    } else if converged == steps.len() {
        "Every load step meets what convergence asks. The certificate speaks of the equations on this grid; what the grid \
         itself leaves open are the errors above."
    } else {
        "Not every load step meets what convergence asks. The certificate says how far the returned pressure is from the \
         solution of the equations on this grid."
    };
    vec![tag("p", text), with("dl", &[("class", "certificate")], entries)].into()
}

/// The quantity, and how far it is below what it must be; `at_rounding`: whether a step has converged to rounding instead.
fn stands(own: &Criterion, at_rounding: bool) -> Markup {
    let value = if own.value == 0.0 { "0".to_owned() } else { format!("{:.1e}", own.value) };
    let Some(below) = own.below else { return format!("{}: {value}", own.name).into() };
    let margin = match below / own.value {
        ratio if own.value == 0.0 || ratio > 1e6 => "zero to rounding".to_owned(),
        ratio if ratio >= 10.0 => format!("{ratio:.0} times below"),
        ratio if ratio > 1.0 => format!("{ratio:.1} times below"),
        ratio if ratio.is_finite() && at_rounding => format!("{:.1} times above, by rounding", 1.0 / ratio),
        ratio if ratio.is_finite() => format!("{:.1} times above, not met", 1.0 / ratio),
        _ => "not a number".to_owned(),
    };
    format!("{}: {value}; its limit is {below:.0e}: {margin}", own.name).into()
}
