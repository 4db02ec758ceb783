//! `[friction]`: the indenters slide.

use serde::Serialize;

use super::error::Refusal;
use super::magnitude;
use super::reader::TableAt;
use crate::friction::{Friction, FrictionError};
use crate::problem::Problem;
use crate::spectral::{Method, Settings};

/// The section `[friction]`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct FrictionSection {
    /// Coefficient μ ≥ 0.
    pub coefficient: f64,
    /// Direction in which the indenters slide, of any length.
    pub direction: [f64; 2],
    /// Whether the pressure follows the displacement that the traction causes.
    pub coupling: bool,
}

impl FrictionSection {
    pub(super) fn read(section: &TableAt<'_>) -> Result<Self, Refusal> {
        section.only()?;
        let coefficient = section.value("coefficient")?.number()?;
        let direction = magnitude::direction(&section.value("direction")?)?;
        Ok(Self { coefficient, direction, coupling: section.value("coupling")?.boolean()? })
    }

    pub(super) fn friction(&self) -> Result<Friction, FrictionError> {
        let friction = Friction::new(self.coefficient, self.direction)?;
        Ok(if self.coupling { friction } else { friction.uncoupled() })
    }

    /// The problem with this friction, or why it cannot be.
    pub(super) fn slide(
        &self,
        section: &TableAt<'_>,
        layers: &[&TableAt<'_>],
        (problem, settings): (Problem, Settings),
        solver: &TableAt<'_>,
    ) -> Result<Problem, Refusal> {
        let method = solver.optional("method");
        if let Some(method) = method.filter(|_| settings.method == Method::PolonskyKeer && self.is_coupled()) {
            let message =
                "`solver.method` = \"polonsky-keer\" needs a symmetric operator, which coupled friction is not";
            return Err(Refusal::new(method.node.place, message, "no method for this case")
                .help("leave the key out, or set friction.coupling = false"));
        }
        let refuse = |error: FrictionError| {
            let layer = if let FrictionError::Unheld(layer) = error { layers.get(layer - 1) } else { None };
            let interface = layer.and_then(|layer| layer.optional("interface"));
            let place = interface.map_or(section.place, |interface| interface.node.place);
            Refusal::new(place, format!("`friction`: {error}"), "slides without anything to hold it")
        };
        self.friction().and_then(|friction| problem.sliding(friction)).map_err(refuse)
    }

    fn is_coupled(&self) -> bool {
        self.coupling && self.coefficient > 0.0
    }
}
