//! The certificate in words: what a solution proves about itself, and how far that is below what convergence asks.

use super::markup::{Markup, tag, with};
use super::table::table;
use crate::numeric::search::largest;
use crate::output::table::Table;
use crate::run::StepRecord;
use crate::spectral::Certificate;

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
    let most = |of: fn(&StepRecord) -> f64| largest(solved.iter().map(|&step| of(step)));
    let slides = solved.iter().any(|step| step.slides);
    let criteria = [
        Criterion {
            name: "energy gap",
            value: most(|step| step.certificate.energy_gap),
            below: tolerance.map(|tolerance| Certificate::ENERGY_GAP * tolerance),
            means: if slides {
                "the elastic energy of what the pressure still differs by from the exact one of this grid is at most this part \
                 of the whole: a proven bound, however the pressure was found; where friction is coupled it bounds the error, \
                 not an excess of energy"
            } else {
                "the energy of this pressure is at most this part above the least possible one on this grid: a proven bound, \
                 however the pressure was found"
            },
        },
        Criterion {
            name: "penetration outside contact",
            value: most(|step| step.certificate.penetration),
            below: tolerance.map(|tolerance| Certificate::PENETRATION * tolerance),
            means: "where there is no pressure the surfaces overlap by at most this part of the penetration; exactly they would \
                    not",
        },
        Criterion {
            name: "residual ε",
            value: most(|step| step.report.residual),
            below: tolerance,
            means: "pressure times gap, which is zero everywhere in the exact solution, summed over the cell and relative to load \
                    times penetration",
        },
        Criterion {
            name: "load",
            value: most(|step| step.certificate.load),
            below: None,
            means: "what was prescribed, mean pressure or penetration, is met to this part",
        },
    ];
    let row = |own: &Criterion| {
        let below = own.below.map_or("–".to_owned(), |below| format!("{below:.0e}"));
        vec![own.name.to_owned(), own.means.to_owned(), format!("{:.1e}", own.value), below, margin(own)]
    };
    let head = ["quantity", "what it means", "largest of all steps", "must be below", "how far it is"];
    let rows = criteria.iter().map(row).collect();
    let measured = Table { head: head.map(str::to_owned).to_vec(), rows, words: 2 };
    let converged = steps.iter().filter(|step| step.converged()).count();
    let text = if converged == steps.len() {
        "Every load step meets what convergence asks. The certificate speaks of the equations on this grid; what the grid \
         itself leaves open are the errors above."
    } else {
        "Not every load step meets what convergence asks. The certificate says how far the returned pressure is from the \
         solution of the equations on this grid."
    };
    let summary = tag("p", text);
    with("div", &[("class", "certificate")], vec![summary, table("What the pressures prove about themselves", &measured)])
}

fn margin(own: &Criterion) -> String {
    let Some(below) = own.below else { return "–".to_owned() };
    match below / own.value {
        ratio if own.value == 0.0 || ratio > 1e6 => "zero to rounding".to_owned(),
        ratio if ratio >= 10.0 => format!("{ratio:.0} times below"),
        ratio if ratio > 1.0 => format!("{ratio:.1} times below"),
        ratio if ratio.is_finite() => format!("{:.1} times above: not met", 1.0 / ratio),
        _ => "not a number".to_owned(),
    }
}
