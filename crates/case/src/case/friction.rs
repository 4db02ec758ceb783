//! `[friction]`: sliding of the indenters.

use super::error::Refusal;
use super::feasibility::magnitude;
use super::keys::{Form, Key, Range};
use super::reader::TableAt;
use super::section::section;
use percoat_core::friction::{Friction, FrictionError};
use percoat_core::problem::Problem;
use percoat_core::spectral::{Method, Settings};

section! {
    /// The section `[friction]`.
    #[derive(Copy)]
    pub struct FrictionSection = FRICTION, rules a_direction {
        /// coefficient of friction μ: the traction on the body is μp
        pub coefficient: f64 = Key::new(&[Form::Number(Range::between(0.0, 100.0))], "0.3"),
        /// direction in which the indenters slide, of any length
        pub direction: [f64; 2] =
            Key::new(&[Form::Tuple("a direction [x, y]", &[Form::Number(Range::Coordinate); 2])], "[1.0, 1.0]")
                .default("[1, 0]")
                .rule("not [0, 0]"),
        /// whether the displacement by the traction acts back on the pressure
        pub coupling: bool = Key::new(&[Form::Boolean], "false").default("true"),
    }
}

fn a_direction(_: &FrictionSection, section: &TableAt<'_>) -> Result<(), Refusal> {
    magnitude::direction(&section.value("direction")?).map(drop)
}

impl FrictionSection {
    pub(super) fn friction(&self) -> Result<Friction, FrictionError> {
        let friction = Friction::new(self.coefficient, self.direction)?;
        Ok(if self.coupling { friction } else { friction.uncoupled() })
    }

    /// The problem with this friction; a refusal where the method or the body does not allow it.
    pub(super) fn slide(
        &self,
        section: &TableAt<'_>,
        layers: &[Vec<&TableAt<'_>>; 2],
        (problem, settings): (Problem, Settings),
        solver: &TableAt<'_>,
    ) -> Result<Problem, Refusal> {
        let method = solver.optional("method");
        if let Some(method) = method.filter(|_| settings.method == Method::PolonskyKeer && self.is_coupled()) {
            let message =
                "`solver.method` = \"polonsky-keer\" needs a symmetric operator, which coupled friction is not";
            return Err(Refusal::new(method.node.span, message, "no method for this case")
                .help("leave the key out, or set friction.coupling = false"));
        }
        let refuse = |error: FrictionError| {
            let layer = match error {
                FrictionError::Unheld(place) => layers[usize::from(place.is_counterbody())].get(place.number - 1),
                _ => None,
            };
            let interface = layer.and_then(|layer| layer.optional("interface"));
            let span = interface.map_or(section.span, |interface| interface.node.span);
            Refusal::new(span, format!("`friction`: {error}"), "slides without anything to hold it")
        };
        self.friction().and_then(|friction| problem.sliding(friction)).map_err(refuse)
    }

    fn is_coupled(&self) -> bool {
        self.coupling && self.coefficient > 0.0
    }
}
