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
            ("tangential", "a contact that sticks does not move steadily over a body"),
            ("composite_hardness", "surfaces under a load that moves steadily have no hardness here"),
            ("life", "wear and passes of a steady motion are not followed"),
        ] {
            if root.section(other)?.is_some() {
                return Err(refuse(why, "not together").help(format!("leave [{other}] or [motion] out")));
            }
        }
        let stress = root.section("stress")?;
        if let Some(strain) = stress
            .as_ref()
            .and_then(|stress| stress.optional("strain"))
            .filter(|value| problem.strains_at_edges() && matches!(value.boolean(), Ok(true)))
        {
            let message = "`stress.strain`: strains below a contact that moves over a body that relaxes are not computed, only those below a given pressure";
            return Err(Refusal::new(strain.node.span, message, "not with [motion]").help("leave stress.strain out"));
        }
        SteadyMotion::new(self.velocity).and_then(|motion| problem.moving(motion)).map_err(|error| {
            let help = match error {
                MotionError::Elastic => {
                    "give a layer or the substrate `relaxation`, or all layers, the substrate and the counterbody `conductivity` and `diffusivity`, or leave [motion] out"
                }
                MotionError::Isolated => {
                    "set lattice.kind = \"square\" with a period of many contact widths: the answer over two periods shows what is left of the images"
                }
                MotionError::Hardness => {
                    "leave `hardness` out, also that of a `material`: take its numbers instead of its name"
                }
                MotionError::Adhesion => "leave [adhesion] out",
                MotionError::Strain => "leave `strain_life` out, or give load.pressure",
                MotionError::Velocity(_) => "give a velocity above 0",
            };
            refuse(&error.to_string(), "moves steadily").help(help)
        })
    }
}

#[cfg(test)]
mod tests {
    use crate::case::{Case, Source};

    fn read(substrate: &str, more: &str) -> Result<Case, String> {
        let text = format!(
            "lattice = {{ kind = \"square\", period = 1.0 }}\nlevels = [{{ shape = \"paraboloid\", radius = 1.0 }}]\n\
             substrate = {{ young = 1.0, poisson = 0.3, {substrate} }}\nload = {{ mean_pressure = 0.01 }}\n\
             grid = {{ points = 32 }}\n{more}"
        );
        Case::read(&Source { name: "case".to_owned(), text, ..Source::default() }, &[])
            .map_err(|error| error.to_string())
    }

    const RELAXES: &str = "relaxation = { shear = [3.0, 6.0], times = [1.0, 0.05] }";
    const MOVES: &str = "motion = { velocity = 2.0 }\n";

    #[test]
    fn a_velocity_is_along_the_friction_or_else_along_x() {
        let case = read(RELAXES, MOVES).unwrap();
        assert_eq!(case.problem().velocity(), [2.0, 0.0]);
        let turned = read(RELAXES, &format!("{MOVES}friction = {{ coefficient = 0.0, direction = [0.0, -3.0] }}\n"));
        assert_eq!(turned.unwrap().problem().velocity(), [0.0, -2.0]);
        let again = Source { text: case.to_toml(), ..Source::default() };
        assert!(Case::read(&again, &[]).unwrap() == case);
        assert!(case.life_task().unwrap_err().contains("motion"));
    }

    #[test]
    fn what_does_not_move_steadily_is_refused() {
        for (substrate, more, why) in [
            ("wear = 1e-9", MOVES, "no material of the body relaxes"),
            (RELAXES, &format!("{MOVES}solver = {{ method = \"polonsky-keer\" }}\n")[..], "symmetric operator"),
            (&format!("{RELAXES}, hardness = 1.0"), MOVES, "hardness"),
            (RELAXES, &format!("{MOVES}adhesion = {{ work = 1e-3, range = 0.1 }}\n"), "adhere"),
            (RELAXES, &format!("{MOVES}life = {{ passes = 10 }}\n"), "leave [life] or [motion] out"),
            (RELAXES, &format!("{MOVES}stress = {{ strain = true }}\n"), "strain"),
            (RELAXES, "motion = { velocity = -1.0 }\n", "greater than 0"),
            ("relaxation = { shear = [1.0], times = [1.0, 2.0] }", MOVES, "as many times as shear moduli"),
        ] {
            let error = read(substrate, more).unwrap_err();
            assert!(error.contains(why), "{substrate} {more}: {error}");
        }
    }

    #[test]
    fn heat_needs_what_conducts_and_rubs() {
        let conducts = "conductivity = 1.0, diffusivity = 2.0, expansion = 1e-3";
        let rubs = format!("{MOVES}friction = {{ coefficient = 0.1 }}\n");
        assert!(read(conducts, &rubs).unwrap().problem().heating().is_some());
        assert!(read(conducts, MOVES).unwrap().problem().heating().is_none());
        for (substrate, more, why) in [
            ("conductivity = 1.0", rubs.clone(), "diffusivity"),
            (conducts, format!("{MOVES}heat = {{}}\n"), "friction"),
            (conducts, "heat = {}\n".to_owned(), "velocity"),
            (conducts, format!("{rubs}heat = {{ partition = 2.0 }}\n"), "between 0 and 1"),
            (conducts, format!("{rubs}heat = {{ partition = 0.5 }}\n"), "a rigid one takes no heat"),
            (conducts, format!("{rubs}heat = {{ partition = \"some\" }}\n"), "\"solved\" or a number"),
            (conducts, format!("{rubs}counterbody = {{ young = 1.0, poisson = 0.3 }}\nheat = {{}}\n"), "conduction"),
        ] {
            let error = read(substrate, &more).unwrap_err();
            assert!(error.contains(why), "{substrate} {more}: {error}");
        }
        assert!(read(&format!("{conducts}, yield_strength = 1.0"), &format!("{rubs}stress = {{}}\n")).is_ok());
    }
}
