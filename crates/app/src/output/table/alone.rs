//! One indenter of a lattice alone, beside the table of a run.

use super::change;
use crate::output::number::number;
use percoat_case::case::Case;
use percoat_core::reading::Reading;

/// One contact of a periodic system alone under its force, and by how much the lattice changes it, in two lines.
pub fn alone(case: &Case, reading: &Reading, single: &Reading) -> Option<String> {
    let units = case.units();
    let (level, alone) = (reading.levels.first()?, single.levels.first()?);
    let changes: Vec<String> = [
        change("the penetration", Some(reading.penetration), Some(single.penetration)),
        change("the contact radius", level.contact_radius, alone.contact_radius),
        change("the peak pressure", level.finite_peak(), alone.finite_peak()),
    ]
    .into_iter()
    .flatten()
    .collect();
    let [penetration, radius] =
        [single.penetration, alone.contact_radius?].map(|x| units.length().with_unit(x, number));
    Some(format!(
        "one such contact alone (lattice.kind = \"isolated\"): penetration {penetration}, contact radius {radius}; the lattice \
         changes\n{}\n",
        changes.join(", ")
    ))
}
