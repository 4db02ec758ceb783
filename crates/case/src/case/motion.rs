//! `[motion]`: a counterbody, or a given pressure, that moves steadily over the body.

use super::error::Refusal;
use super::keys::{Form, Key, Range, Unit};
use super::reader::TableAt;
use super::section::section;
use percoat_core::problem::Problem;
use percoat_core::spectral::{Method, Settings};
use percoat_core::steady_motion::{MotionError, SteadyMotion};

section! {
    /// The section `[motion]`.
    #[derive(Copy)]
    pub struct MotionSection = MOTION {
        /// velocity of the indenters over the body, along `friction.direction`, or else +x
        pub velocity: f64 = Key::new(&[Form::Number(Range::Size)], "1.0").unit(Unit::Velocity),
    }
}

impl MotionSection {
    /// The problem with this motion; a refusal where the method, another section or the bodies do not allow it.
    pub(super) fn moving(
        self,
        section: &TableAt<'_>,
        root: &TableAt<'_>,
        (problem, settings): (Problem, Settings),
    ) -> Result<Problem, Refusal> {
        let refuse = |message: &str, label: &str| Refusal::new(section.span, format!("`motion`: {message}"), label);
        if settings.method == Method::PolonskyKeer {
            let message = "`solver.method` = \"polonsky-keer\" needs a symmetric operator, which that of a body that relaxes is not";
            return Err(refuse(message, "no method for this case").help("leave solver.method out"));
        }
        for (other, why) in [
            ("tangential", "a contact that sticks does not move steadily over a body that relaxes"),
            ("composite_hardness", "surfaces of bodies that relax have no hardness here"),
            ("life", "wear and passes of bodies that relax are not followed"),
        ] {
            if root.section(other)?.is_some() {
                return Err(refuse(why, "not together").help(format!("leave [{other}] or [motion] out")));
            }
        }
        let stress = root.section("stress")?;
        if let Some(strain) = stress
            .as_ref()
            .and_then(|stress| stress.optional("strain"))
            .filter(|value| matches!(value.boolean(), Ok(true)))
        {
            let message = "`stress.strain`: strains below a load that moves over a body that relaxes are not computed";
            return Err(Refusal::new(strain.node.span, message, "not with [motion]").help("leave stress.strain out"));
        }
        SteadyMotion::new(self.velocity).and_then(|motion| problem.moving(motion)).map_err(|error| {
            let help = match error {
                MotionError::Elastic => "give a layer or the substrate `relaxation`, or leave [motion] out",
                MotionError::Isolated => {
                    "set lattice.kind = \"square\" with a period of many contact widths: the answer over two periods shows what is left of the images"
                }
                MotionError::Hardness => {
                    "leave `hardness` out, also that of a `material`: take its numbers instead of its name"
                }
                MotionError::Adhesion => "leave [adhesion] out",
                MotionError::Strain => "leave `strain_life` out",
                MotionError::Velocity(_) => "give a velocity above 0",
            };
            refuse(&error.to_string(), "moves steadily").help(help)
        })
    }
}
