//! Doubts about surfaces that adhere: what pulls more than a material bears.

use crate::case::Case;
use percoat_core::body::HalfSpace;
use percoat_core::notation::number;

/// Warnings about the adhesion of a case, a sentence each; none without.
pub(super) fn doubts(case: &Case) -> Vec<String> {
    let Some(adhesion) = case.problem().adhesion() else { return Vec::new() };
    let bodies = || case.problem().bodies().each();
    let tensile = bodies().flat_map(HalfSpace::strengths).filter_map(|strength| strength.tensile);
    let interfaces = bodies().flat_map(HalfSpace::layers).filter_map(|layer| layer.interface_strength().normal);
    let torn = |what: &str, least: Option<f64>| {
        let least = least.filter(|least| *least < adhesion.strength())?;
        Some(format!(
            "the surfaces pull with up to σ₀ = {}, more than {what} of {} bears: it would tear before the surfaces part; is the range of \
             adhesion too short?",
            number(adhesion.strength()),
            number(least)
        ))
    };
    let least = |values: &mut dyn Iterator<Item = f64>| values.reduce(f64::min);
    [
        torn("a tensile strength", least(&mut tensile.into_iter())),
        torn("an interface strength", least(&mut interfaces.into_iter())),
    ]
    .into_iter()
    .flatten()
    .collect()
}
