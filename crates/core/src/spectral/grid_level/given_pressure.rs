//! A load of a given pressure on one grid: the deflection of the surface, without an iteration.

use super::GridLevel;
use crate::load::Control;
use crate::numeric::sums;
use crate::spectral::iteration::{Certificate, Report, Stop, Unknowns};
use crate::spectral::operator::{ElasticOperator, Workspace};
use std::sync::Arc;

impl GridLevel {
    /// Displaces by a given pressure of mean 1 times the load: a mean pressure, or that of the largest deflection δ. The gap of a surface
    /// that touches nothing is w − δ, with displacements that this pressure does not cause in w.
    pub(super) fn load_with(&mut self, mut pressure: Vec<f64>, load: Control) -> Report {
        let mut gap = pressure.clone();
        self.operator.displace(&mut gap, &mut Workspace::default());
        let largest = -sums::least(gap.len(), |i| -gap[i]);
        let factor = match load {
            Control::MeanPressure(mean) => mean,
            Control::Penetration(deflection) => deflection / largest,
        };
        let lift = self.surface.gaps();
        sums::update(&mut pressure, |_, p| factor * p);
        sums::update(&mut gap, |i, w| factor * w + lift[i]);
        let deflection = -sums::least(gap.len(), |i| -gap[i]);
        sums::update(&mut gap, |_, w| w - deflection);
        self.unknowns = Unknowns {
            pressure: Arc::new(pressure),
            gap: Arc::new(gap),
            penetration: deflection,
            certificate: Certificate::default(),
        };
        Report::given(match factor {
            0.0 => Stop::NoContact,
            _ if factor > 0.0 && deflection.is_finite() => Stop::Converged,
            _ => Stop::Stalled,
        })
    }
}
