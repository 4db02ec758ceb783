//! Warnings about springs between layers that displace farther than the cell is wide.

use crate::case::Case;
use percoat_core::body::{Interface, Layer, MeanStress};
use percoat_core::lattice::Cell;
use percoat_core::notation::number;
use percoat_core::run::words::ratio;
use std::iter::repeat_n;

/// Springs that shear under the mean friction: the layers above them drift by μp̄/k_t against those below.
pub(super) fn drifting(case: &Case, cell: Cell) -> Vec<String> {
    // A single contact has no mean friction.
    let loads = case.mean_pressures().and_then(|loads| cell.surroundings().per_cell(loads));
    let (Some(friction), Some(loads)) = (case.problem().friction(), loads) else {
        return Vec::new();
    };
    let traction = friction.coefficient() * loads.iter().copied().fold(0.0, f64::max);
    let [side, other] = cell.vectors().map(|[x, y]| x.hypot(y));
    let period = side.min(other);
    // Under a graded layer that of its last sublayer.
    let sections = (0..).zip(&case.layers).flat_map(|(number, layer)| repeat_n(number, layer.sublayers()));
    let drifts = sections.zip(case.half_space().layers()).filter_map(|(layer, above): (usize, &Layer)| {
        let Interface::Spring { tangential, .. } = above.interface() else { return None };
        let drift = Some(traction / tangential).filter(|drift| *drift > period)?;
        Some(format!(
            "under the mean friction μp̄ = {} the spring under layers[{layer}] (tangential stiffness {}) lets what lies above it drift \
             by μp̄/k_t = {}, {} times the side {} of the cell: displacements are not small any more; is the stiffness in \
             pressure over length, in the units of the case?",
            number(traction),
            number(tangential),
            number(drift),
            ratio(drift / period),
            number(period)
        ))
    });
    drifts.collect()
}

/// Springs that slip over more than the cell: the wide disc of `mean = "half-space"` must be wider than that.
pub(super) fn slipping(case: &Case, cell: Cell) -> Vec<String> {
    let (half_space, side) = (case.half_space(), cell.reduced().longer_side());
    // Under a graded layer that of its last sublayer.
    let sections = (0..).zip(&case.layers).flat_map(|(number, layer)| repeat_n(number, layer.sublayers()));
    let layers = sections.zip(half_space.layers()).zip(MeanStress::slip_lengths(half_space));
    let slips = layers.filter_map(|((layer, above), length): ((usize, &Layer), Option<f64>)| {
        let Interface::Spring { tangential, .. } = above.interface() else { return None };
        let length = length.filter(|&length| length > side)?;
        Some(format!(
            "stress.mean = \"half-space\": the spring under layers[{layer}] (tangential stiffness {}) slips over {}, {} times \
             the cell: the layers above follow the substrate only where the load is several times wider than that; \
             under a narrower one they spread as above a frictionless interface",
            number(tangential),
            number(length),
            ratio(length / side)
        ))
    });
    slips.collect()
}

#[cfg(test)]
mod tests {
    use super::super::plausibility;
    use super::*;
    use crate::case::embedded;

    fn doubts(name: &str, overrides: &[&str]) -> Vec<String> {
        let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
        plausibility::of_case(&Case::read(&embedded::source(name).unwrap(), &overrides).unwrap())
    }

    #[test]
    fn a_coating_that_drifts_by_more_than_a_period_is_doubted() {
        let said = |k: &str, friction: &str, load: &str, more: &[&str]| {
            let spring = format!("layers.0.interface={{ tangential_stiffness = {k} }}");
            let (friction, load) = (format!("friction.coefficient={friction}"), format!("load.mean_pressure={load}"));
            doubts("fig2", &[&[spring.as_str(), &friction, &load], more].concat()).join("\n")
        };
        // μp̄ = 0.03 at the highest load; fig2's cell has the side √3.
        let soft = said("0.01", "0.5", "[0.01, 0.06]", &[]);
        assert!(
            soft.contains("μp̄ = 0.03") && soft.contains("layers[0]") && soft.contains("drift by μp̄/k_t = 3"),
            "{soft}"
        );
        for (k, friction, load, more) in [
            ("0.02", "0.5", "0.06", &[][..]),
            ("1e3", "0.5", "0.06", &[]),
            ("0.01", "0.2", "0.06", &[]),
            ("0.01", "0.5", "[0.02, 0.01]", &[]),
            ("0.01", "0.5", "0.06", &["lattice.period=10"]),
        ] {
            let told = said(k, friction, load, more);
            assert!(!told.contains("drift"), "{k} {friction} {load} {more:?}: {told}");
        }
        let frictionless = doubts("fig2", &["layers.0.interface={ tangential_stiffness = 1e-9 }"]).join("\n");
        assert!(!frictionless.contains("drift"), "{frictionless}");
    }

    #[test]
    fn a_spring_that_slips_further_than_the_cell_is_named_where_it_matters() {
        let spring = |k: &str| format!("layers.0.interface={{ tangential_stiffness = {k} }}");
        let half_space = "stress.mean=half-space";
        let soft = doubts("fig2", &[&spring("1e-3"), half_space]).join("\n");
        assert!(soft.contains("layers[0]") && soft.contains("slips over"), "{soft}");
        assert!(doubts("fig2", &[&spring("1e3"), half_space]).is_empty());
        assert!(doubts("fig2", &[&spring("1e-3"), "stress.mean=confined"]).is_empty());
    }
}
