//! One indenter of a lattice alone, beside the table of a run.

use super::change;
use crate::output::number::number;
use percoat_case::case::Case;
use percoat_core::reading::Reading;

/// What one contact of a periodic system would be alone under its force, and by how much the lattice changes it, in two lines.
pub fn alone(case: &Case, reading: &Reading, single: &Reading) -> Option<String> {
    let units = case.units();
    let (own, other) = (reading.levels.first()?, single.levels.first()?);
    let changes: Vec<String> = [
        change("the penetration", Some(reading.penetration), Some(single.penetration)),
        change("the contact radius", own.contact_radius, other.contact_radius),
        change("the peak pressure", own.finite_peak(), other.finite_peak()),
    ]
    .into_iter()
    .flatten()
    .collect();
    let [penetration, radius] =
        [single.penetration, other.contact_radius?].map(|x| units.length().with_unit(x, number));
    Some(format!(
        "one such contact alone (lattice.kind = \"isolated\"): penetration {penetration}, contact radius {radius}; the lattice \
         changes\n{}\n",
        changes.join(", ")
    ))
}
