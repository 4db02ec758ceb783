//! `[adhesion]`: surfaces that pull each other.

use super::error::Refusal;
use super::keys::{Form, Key, Range, Unit};
use super::reader::TableAt;
use super::section::{Words, demanded, section, words};
use percoat_core::adhesion::{Adhesion, AdhesionError, AdhesionLaw};
use percoat_core::problem::Problem;
use percoat_core::spectral::{Method, Settings};

section! {
    /// The section `[adhesion]`: the work, and the range or the strength.
    #[derive(Copy)]
    pub struct AdhesionSection = ADHESION, rules one_size {
        /// work of adhesion of the two surfaces, an energy per area
        pub work: f64 = Key::new(&[Form::Number(Range::Size)], "0.05").unit(Unit::PressureTimesLength),
        /// range of the tension: the gap up to which Dugdale's law pulls, or that over which the exponential one falls to 1/e
        pub range: Option<f64> = Key::new(&[Form::Number(Range::Size)], "0.001").unit(Unit::Length),
        /// largest tension, that of surfaces in contact: the work over the range
        pub strength: Option<f64> =
            Key::new(&[Form::Number(Range::Size)], "50.0").unit(Unit::Pressure).instead_of("range"),
        /// law of the tension over the gap: constant up to the range, or falling exponentially
        pub law: TensionLaw = Key::new(&[Form::Word(TensionLaw::WORDS)], "\"exponential\"").default("\"dugdale\""),
    }
}

words! {
    /// Law of the tension over the gap.
    pub enum TensionLaw {
        /// A constant tension up to the range.
        Dugdale = "dugdale",
        /// A tension that falls exponentially.
        Exponential = "exponential",
    }
}

fn one_size(_: &AdhesionSection, section: &TableAt<'_>) -> Result<(), Refusal> {
    section.one_of(["range", "strength"]).map(drop)
}

impl AdhesionSection {
    /// Work and range of the two surfaces.
    ///
    /// # Errors
    /// [`AdhesionError`] of a range that double precision does not carry.
    pub(super) fn adhesion(&self) -> Result<Adhesion, AdhesionError> {
        let range = self.range.unwrap_or_else(|| self.work / demanded(self.strength));
        let law = match self.law {
            TensionLaw::Dugdale => AdhesionLaw::Dugdale,
            TensionLaw::Exponential => AdhesionLaw::Exponential,
        };
        Adhesion::new(self.work, range, law)
    }

    /// The problem with this adhesion; a refusal where the method or the surfaces do not allow it.
    pub(super) fn adhere(
        &self,
        section: &TableAt<'_>,
        root: &TableAt<'_>,
        (problem, settings): (Problem, Settings),
    ) -> Result<Problem, Refusal> {
        let refuse = |message: &str, label: &str| Refusal::new(section.span, format!("`adhesion`: {message}"), label);
        if settings.method == Method::PolonskyKeer {
            return Err(refuse("`solver.method` = \"polonsky-keer\" seeks a pressure that is never below 0", "pulls")
                .help("leave solver.method out"));
        }
        for (other, why) in [
            ("tangential", "partial slip of surfaces that adhere is not solved"),
            ("composite_hardness", "surfaces that adhere are elastic here"),
        ] {
            if root.section(other)?.is_some() {
                return Err(refuse(why, "not together").help(format!("leave [{other}] or [adhesion] out")));
            }
        }
        self.adhesion().and_then(|adhesion| problem.adhering(adhesion)).map_err(|error| {
            let help = match error {
                AdhesionError::Coupled => "set friction.coupling = false",
                AdhesionError::Hardness => {
                    "leave `hardness` out, also that of a `material`: take its numbers instead of its name"
                }
                _ => "leave [adhesion] out",
            };
            refuse(&error.to_string(), "surfaces that pull").help(help)
        })
    }
}

#[cfg(test)]
mod tests {
    use crate::case::{Case, Source};
    use percoat_core::load::Load;

    fn read(more: &str, load: &str) -> Result<Case, String> {
        let text = format!(
            "lattice = {{ kind = \"isolated\", size = 4.0 }}\nlevels = [{{ shape = \"paraboloid\", radius = 1.0 }}]\n\
             substrate = {{ young = 1.0, poisson = 0.3 }}\nunits = {{ length = \"µm\", pressure = \"MPa\" }}\n\
             grid = {{ points = 64 }}\nload = {{ {load} }}\n{more}"
        );
        Case::read(&Source { name: "case".to_owned(), text, ..Source::default() }, &[])
            .map_err(|error| error.to_string())
    }

    #[test]
    fn work_and_range_or_strength_are_read_with_their_units() {
        // 1 MPa·µm = 1 J/m².
        for size in ["range = \"20 nm\"", "strength = \"2.5 MPa\""] {
            let case = read(&format!("adhesion = {{ work = \"50 mJ/m²\", {size} }}\n"), "force = -0.1").unwrap();
            let adhesion = case.problem().adhesion().unwrap();
            assert!((adhesion.work() - 0.05).abs() < 1e-15 && (adhesion.range() - 0.02).abs() < 1e-15, "{adhesion:?}");
            assert_eq!(case.run().loads, [Load::Force(-0.1)]);
            let again = Source { text: case.to_toml(), ..Source::default() };
            assert!(Case::read(&again, &[]).unwrap() == case);
        }
    }

    #[test]
    fn a_grip_goes_there_and_back_and_holds_by_a_spring() {
        let adhesion = "adhesion = { work = 0.05, range = 0.02, law = \"exponential\" }\n";
        let load = "grip = { from = 0.01, to = -0.02, steps = 4, back = true }, machine_stiffness = 2.0";
        let loads = read(adhesion, load).unwrap().run().loads;
        let expected = [0.01, 0.0, -0.01, -0.02, -0.01, 0.0, 0.01];
        assert_eq!(loads.len(), expected.len());
        for (load, expected) in loads.iter().zip(expected) {
            let Load::Grip { position, stiffness } = *load else { panic!("{load:?}") };
            assert!((position - expected).abs() < 1e-15 && stiffness == 2.0, "{load:?}");
        }
        let rigid = read(adhesion, "grip = -0.01").unwrap().run().loads;
        assert_eq!(rigid, [Load::Grip { position: -0.01, stiffness: f64::INFINITY }]);
    }

    #[test]
    fn what_cannot_adhere_is_refused() {
        let adhesion = "adhesion = { work = 0.05, range = 0.02 }\n";
        for (more, load, why) in [
            ("", "force = -1.0", "`load.force` must be a finite number not less than 0"),
            ("", "force = [1.0, -1.0]", "`load.force[1]` must be"),
            ("", "grip = 0.1", "[adhesion]"),
            (adhesion, "force = 1.0, machine_stiffness = 2.0", "machine_stiffness"),
            ("adhesion = { work = 0.05 }\n", "force = 1.0", "`range` or `strength` is missing"),
            (&format!("{adhesion}friction = {{ coefficient = 0.2 }}\n"), "force = 1.0", "coupling = false"),
            (&format!("{adhesion}solver = {{ method = \"polonsky-keer\" }}\n"), "force = 1.0", "never below 0"),
            ("adhesion = { work = \"5 mN\", range = 0.02 }\n", "force = 1.0", "mN is no unit of one"),
        ] {
            let error = read(more, load).unwrap_err();
            assert!(error.contains(why), "{more} {load}: {error}");
        }
        let slides = format!("{adhesion}friction = {{ coefficient = 0.2, coupling = false }}\n");
        assert!(read(&slides, "force = 1.0").is_ok());
    }
}
