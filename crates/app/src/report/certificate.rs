//! The certificate in words: bounds and residuals of a solution, and how far each is below its limit.

use super::markup::{Markup, tag, with};
use percoat_core::numeric::search::largest;
use percoat_core::run::StepRecord;
use percoat_core::spectral::{Certificate, Stop};

/// A quantity of the certificate, and its limit.
struct Condition {
    name: &'static str,
    /// Largest of all steps, relative.
    value: f64,
    /// Largest value of a converged solution; `None` where the quantity has no limit.
    below: Option<f64>,
    means: &'static str,
}

/// Meanings of the quantities, a sentence each, and whether the surfaces adhere.
struct Words {
    adheres: bool,
    energy_gap: &'static str,
    penetration: &'static str,
    residual: &'static str,
    load: &'static str,
}

impl Words {
    const STILL: Self = Self {
        adheres: false,
        energy_gap: "The energy of this pressure is at most this part above the least possible one on this grid: a proven bound, \
                     however the pressure was found.",
        penetration: "Where there is no pressure the surfaces overlap by at most this part of the penetration; exactly they would not.",
        residual: "Pressure times gap, which is zero everywhere in the exact solution, summed over all samples and relative to load times \
                   penetration.",
        load: "Relative difference from the prescribed mean pressure, force or penetration.",
    };
    const SLIDING: Self = Self {
        energy_gap: "The elastic energy of what the pressure still differs by from the exact one of this grid is at most this part \
                     of the whole: a proven bound, however the pressure was found; where friction is coupled it bounds the error, \
                     not an excess of energy.",
        ..Self::STILL
    };
    const ADHERING: Self = Self {
        adheres: true,
        energy_gap: "With the tension held as it is, the energy of this pressure is at most this part above the least possible one on this \
                     grid. The tension softens with the gap: the state is an equilibrium that holds against small changes where its margin of \
                     stability is above zero, not the one of least energy of all.",
        penetration: "Where the surfaces do not touch they overlap by at most this part of the largest displacement; exactly they would not.",
        residual: "Pressure of the bodies and tension of the gap that are not in balance, as all are in the exact solution, summed over all \
                   samples and relative to what presses and pulls.",
        load: "Difference from the prescribed mean pressure, force or penetration, relative to that, or of forces to the tension where that \
               is more.",
    };

    fn of(steps: &[&StepRecord]) -> Self {
        match () {
            () if steps.iter().any(|step| step.adhesion.is_some()) => Self::ADHERING,
            () if steps.iter().any(|step| step.friction.is_some()) => Self::SLIDING,
            () => Self::STILL,
        }
    }
}

/// The certificate of all steps under load; `tolerance` is `solver.tolerance`, where the case has it.
pub(super) fn certificate(steps: &[StepRecord], tolerance: Option<f64>) -> Markup {
    let solved: Vec<&StepRecord> =
        steps.iter().filter(|step| step.reading.touches() && !step.kind().is_given).collect();
    if solved.is_empty() {
        return Markup::default();
    }
    let at_rounding = solved.iter().any(|step| step.stop == Stop::Rounding);
    let most = |of: fn(&StepRecord) -> f64| largest(solved.iter().map(|&step| of(step)));
    let words = Words::of(&solved);
    // The solver of surfaces that adhere ends by the residual alone.
    let tested = |limit: f64| tolerance.filter(|_| !words.adheres).map(|tolerance| limit * tolerance);
    let conditions = [
        Condition {
            name: "Energy gap",
            value: most(|step| step.certificate.energy_gap),
            below: tested(Certificate::ENERGY_GAP),
            means: words.energy_gap,
        },
        Condition {
            name: "Penetration outside contact",
            value: most(|step| step.certificate.penetration),
            below: tested(Certificate::PENETRATION),
            means: words.penetration,
        },
        Condition { name: "Residual ε", value: most(|step| step.residual), below: tolerance, means: words.residual },
        Condition { name: "Load", value: most(|step| step.certificate.load), below: None, means: words.load },
    ];
    let entry =
        |condition: &Condition| vec![tag("dt", margin(condition, at_rounding)), tag("dd", condition.means)].into();
    let entries: Markup = conditions.iter().map(entry).collect();
    let converged = steps.iter().filter(|step| step.converged()).count();
    let text = if converged == steps.len() && at_rounding {
        "Every load step meets the conditions of convergence, or comes as near to them as double precision carries: what is above its limit is \
         rounding, measured by computing the gap twice. The certificate is of the equations on this grid; the errors of the grid \
         itself are given above."
    } else if converged == steps.len() {
        "Every load step meets the conditions of convergence. The certificate is of the equations on this grid; the errors of \
        the grid itself are given above."
    } else {
        "Not every load step meets the conditions of convergence. The certificate says how far the returned pressure is from the \
         solution of the equations on this grid."
    };
    vec![tag("p", text), with("dl", &[("class", "certificate")], entries)].into()
}

/// A quantity with the ratio of its limit to it; `at_rounding`: whether a step has stopped at rounding.
fn margin(condition: &Condition, at_rounding: bool) -> Markup {
    let value = if condition.value == 0.0 { "0".to_owned() } else { format!("{:.1e}", condition.value) };
    let Some(below) = condition.below else { return format!("{}: {value}", condition.name).into() };
    let distance = match below / condition.value {
        ratio if condition.value == 0.0 || ratio > 1e6 => "zero to rounding".to_owned(),
        ratio if ratio >= 10.0 => format!("{ratio:.0} times below"),
        ratio if ratio > 1.0 => format!("{ratio:.1} times below"),
        ratio if ratio.is_finite() && at_rounding => format!("{:.1} times above, by rounding", 1.0 / ratio),
        ratio if ratio.is_finite() => format!("{:.1} times above, not met", 1.0 / ratio),
        _ => "not a number".to_owned(),
    };
    format!("{}: {value}; its limit is {below:.0e}: {distance}", condition.name).into()
}
