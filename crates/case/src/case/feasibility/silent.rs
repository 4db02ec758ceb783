//! Properties of materials that have no effect in a case: relaxation where nothing moves and no load has a time, conduction where nothing
//! heats.

use crate::case::Case;
use percoat_core::body::Material;

/// Warnings about them; every material with its name.
pub(super) fn doubts(case: &Case, named: &[(Material, String)]) -> Vec<String> {
    [relaxed(case, named), cold(case, named)].into_iter().flatten().collect()
}

/// A material that relaxes, at rest.
fn relaxed(case: &Case, named: &[(Material, String)]) -> Option<String> {
    let is_at_rest = case.motion.is_none() && case.time.is_none();
    let (_, name) = named.iter().find(|(material, _)| is_at_rest && material.relaxation().is_some())?;
    Some(format!(
        "{name} relaxes, and has its relaxed moduli: nothing depends on time here; give [motion] with a velocity, or [time] in the place of [load]"
    ))
}

/// A material that conducts heat, in a case without any.
fn cold(case: &Case, named: &[(Material, String)]) -> Option<String> {
    let problem = case.problem();
    if problem.heating().is_some() {
        return None;
    }
    let (_, name) = named.iter().find(|(material, _)| material.conduction().is_some())?;
    let reason = match named.iter().find(|(material, _)| material.conduction().is_none()) {
        _ if problem.motion().is_none() => "nothing moves: give [motion] with a velocity".to_owned(),
        _ if problem.friction().is_none_or(|friction| friction.coefficient() <= 0.0) => {
            "nothing rubs: give friction.coefficient".to_owned()
        }
        Some((_, other)) => format!("{other} does not: give it `conductivity` and `diffusivity`"),
        None => return None,
    };
    Some(format!("{name} conducts heat, but there is no frictional heat, as {reason}"))
}

#[cfg(test)]
mod tests {
    use super::super::plausibility::of_case;
    use crate::case::{Case, embedded};

    fn said(name: &str, set: &[&str]) -> String {
        let set: Vec<String> = set.iter().map(|&text| text.to_owned()).collect();
        of_case(&Case::read(&embedded::source(name).unwrap(), &set).unwrap()).join("\n")
    }

    #[test]
    fn what_has_no_effect_is_said() {
        for (name, set, word) in [
            ("pin-on-disc-hot", "friction.coefficient=0.0", "nothing rubs"),
            ("fig2", "substrate.relaxation={ shear = [1.0], times = [1.0] }", "relaxed"),
            (
                "fig2",
                "substrate={ young = 1.0, poisson = 0.3, conductivity = 1.0, diffusivity = 1.0 }",
                "nothing moves",
            ),
        ] {
            let said = said(name, &[set]);
            assert!(said.contains(word), "{name} {set}: {said}");
        }
    }
}
