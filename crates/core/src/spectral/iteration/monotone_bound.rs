//! Sharp bound on the error of a pressure under an operator A with a skew part, from one more contact of its symmetric part C.
//!
//! ‖e‖_C of e = p − p*, p* the solution, has the bound of the energy gap 𝒢, ‖e‖²_C ≤ 𝒢: but 𝒢 is of the order ‖e‖. With
//!
//! y = argmin ½⟨s − p, C(s − p)⟩ + ⟨g, s⟩ over the admissible s, r = p − y:  ‖e‖_C ≤ (1 + L)‖r‖_C,  L = √(1 + f²),
//!
//! since C⁻¹A is monotone with the constants 1 and L in the norm of C, f the largest |C⁻¹(A − C)| (the natural residual of a variational
//! inequality: J.-S. Pang, Math. Oper. Res. 12 (1987) 474). What y itself is off by adds √(2 × its energy gap).

use super::fields::{Unknowns, Working};
use super::problem::{ContactProblem, Method, Settings};
use super::{AdmissibleSet, Bounds};
use crate::load::Control;
use crate::numeric::sums;
use crate::spectral::LayeredOperator;
use crate::spectral::operator::ElasticOperator;
use std::ops::ControlFlow;
use std::sync::Arc;

/// Iterations of the contact of C, which begins next to its end.
const ITERATIONS: usize = 24;
/// Tolerance of that contact, beyond what rounding lets it reach.
const TOLERANCE: f64 = 1e-14;

/// Norms of the error of a pressure and of the pressure, ‖e‖_C and ‖p‖_C over the samples: of ⟨p, Cp⟩ = Σ p Cp.
#[derive(Debug, Clone, Copy)]
pub struct ErrorNorm {
    /// Bound on ‖e‖_C.
    pub error: f64,
    /// ‖p‖_C.
    pub pressure: f64,
}

impl ErrorNorm {
    /// Norms of a solution under load control, by the samples of `mask` where contact may occur.
    pub fn of(
        operator: &mut LayeredOperator,
        working: &mut Working,
        mask: Option<&[bool]>,
        unknowns: &Unknowns,
    ) -> Self {
        let f = operator.coupling();
        operator.symmetric(|symmetric| {
            let (p, g) = (&unknowns.pressure, &unknowns.gap);
            let mut displaced = p.to_vec();
            symmetric.displace(&mut displaced, &mut working.transforms);
            let [energy] = sums::of(p.len(), |i| [p[i] * displaced[i]]);
            let gap: Vec<f64> = g.iter().zip(&displaced).map(|(g, w)| g - w).collect();
            let (least, largest) = (sums::least(gap.len(), |i| gap[i]), -sums::least(gap.len(), |i| -gap[i]));
            let gap: Vec<f64> = gap.iter().map(|gap| gap - least).collect();
            let mut nearest = Unknowns { pressure: Arc::clone(p), ..unknowns.clone() };
            ContactProblem {
                operator: &mut *symmetric,
                working: &mut *working,
                initial_gap: &gap,
                largest_gap: largest - least,
                admissible: AdmissibleSet::new(mask).within(Bounds::default()),
                load: Control::MeanPressure(sums::mean(p)),
                settings: Settings { method: Method::Preconditioned, tolerance: TOLERANCE, max_iterations: ITERATIONS },
                outer: 0,
                progress: &mut |_| ControlFlow::Continue(()),
            }
            .solve(&mut nearest);
            let y = &nearest.pressure;
            let change: Vec<f64> = p.iter().zip(&**y).map(|(p, y)| p - y).collect();
            let mut moved = change.clone();
            symmetric.displace(&mut moved, &mut working.transforms);
            let [residual] = sums::of(change.len(), |i| [change[i] * moved[i]]);
            // The energy gap of y is over its elastic energy, nearly that of p.
            let inexact = (nearest.certificate.energy_gap * energy).sqrt();
            let error = (1.0 + f.hypot(1.0)) * (residual.max(0.0).sqrt() + inexact);
            Self { error, pressure: energy.max(0.0).sqrt() }
        })
    }
}
