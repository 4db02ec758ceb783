//! Ranges in coatings, at their interfaces and below: under given tractions and under a contact.

use super::lines::{FORCE, Parts, fatigue_durability, friction, peaks, range, solved, young};
use crate::{Check, Data, Outcome, StudyError, Tolerance};
use percoat_core::body::{HalfSpace, Material, MeanStress};
use percoat_core::spectral::Step;
use percoat_core::stress::{PathPeaks, PathSought, StressField};

const COATED: &str = include_str!("coated.csv");
const INTERFACE: &str = include_str!("coated-interface.csv");
const CONTACT: &str = include_str!("contact.csv");
const CONTACT_INTERFACE: &str = include_str!("contact-interface.csv");
const SIDES: [&str; 2] = ["above", "below"];
const NAMES: [&str; 4] = ["above", "below", "hard", "soft"];
/// Samples along a window, and their spacing over a.
const POINTS: usize = 128;
pub const SPACING: f64 = 0.025;
/// Error of a range over p₀ that the grid may leave: of given tractions from four spacings on and above, and of
/// contacts, whose pressure on coatings errs by as much.
const DEEP: f64 = 3e-4;
const SHALLOW: f64 = 2e-3;
const OF_CONTACT: f64 = 1e-3;
/// Error of ranges of interfaces over p₀: by the grid and the places of the table.
const OF_INTERFACE: f64 = 1e-3;

/// The pressure √(1 − r²), as the grid has it.
pub fn hertz() -> Result<Step, StudyError> {
    let nu = 0.3;
    let body = HalfSpace::new(vec![], Material::from_young(young(nu), nu)?);
    solved(body, 0.0, FORCE, POINTS, SPACING)
}

/// Peaks below the pressure of a step and its traction on a body.
pub fn under(step: &Step, body: &HalfSpace, mu: f64) -> Result<PathPeaks, StudyError> {
    let friction = friction(mu)?;
    let sliding = (mu > 0.0).then_some(&friction);
    let field = StressField::under(step.grid(), step.pressure(), body, sliding, MeanStress::HalfSpace)?;
    peaks(&field, 1.0, PathSought::ALL)
}

/// Depths of rows in a column, ascending, each once.
fn depths<'a>(rows: impl Iterator<Item = &'a Vec<f64>>, column: usize) -> Vec<f64> {
    let mut depths: Vec<f64> = rows.map(|row| row[column]).collect();
    depths.sort_by(f64::total_cmp);
    depths.dedup();
    depths
}

/// The largest range of the only interface with a law.
fn of_interface(peaks: &PathPeaks) -> f64 {
    peaks.interfaces.iter().flatten().next().map_or(f64::NAN, |peak| peak.value)
}

/// Ranges under tractions of Hertz' shape.
pub fn given(outcome: &mut Outcome) -> Result<Data, StudyError> {
    let (table, interface) = (Data::parse_named("coated", COATED, &SIDES)?, Data::parse("interface", INTERFACE)?);
    let mut data = Data::new("coated", &["E1", "h", "mu", "y", "z", "is_below", "range", "range_exact"]);
    let (step, mut shears) = (hertz()?, Vec::new());
    for [modulus, h] in [[4.0, 1.0], [0.5, 1.0], [4.0, 0.3], [0.5, 0.3]] {
        let rows = || table.rows.iter().filter(move |row| row[0] == modulus && row[1] == h);
        let law = fatigue_durability()?;
        let parts = Parts { coating: Some([h, modulus, 0.3]), substrate: [1.0, 0.3] };
        let body = parts.cut(&depths(rows(), 4), |_| law)?;
        for mu in [0.0, 0.1, 0.3] {
            let found = under(&step, &body, mu)?;
            for row in rows().filter(|row| row[2] == mu) {
                let &[_, _, _, y, z, is_below, exact, _] = &row[..] else { return Err("a row too short".into()) };
                let value = range(&found.planes, y, z, is_below == 1.0)?;
                data.rows.push(vec![modulus, h, mu, y, z, is_below, value, exact]);
            }
            let known = interface.rows.iter().find(|row| row[..4] == [modulus, h, mu, 0.0]).ok_or("no such row")?;
            shears.push((of_interface(&found), known[4]));
        }
    }
    let pairs = |is_shallow: bool| {
        let rows = data.rows.iter().filter(move |row| (row[4] < 3.0 * SPACING) == is_shallow);
        rows.map(|row| (row[6], row[7]))
    };
    outcome.checks.extend([
        Check::worst("coated, Hertz' tractions: Δτ₁/p₀ from z = 0.1a on", pairs(false), Tolerance::Absolute(DEEP)),
        Check::worst("coated, Hertz' tractions: Δτ₁/p₀ at z = 0.05a", pairs(true), Tolerance::Absolute(SHALLOW)),
        Check::worst(
            "coated, Hertz' tractions: range of the interface's shear over p₀",
            shears,
            Tolerance::Absolute(OF_INTERFACE),
        ),
    ]);
    Ok(data)
}

/// Ranges under a rigid paraboloid of contact radius 0.6, whose traction does not change the pressure.
pub fn contact(outcome: &mut Outcome) -> Result<Data, StudyError> {
    let table = Data::parse_named("contact", CONTACT, &NAMES)?;
    let interface = Data::parse_named("interface", CONTACT_INTERFACE, &NAMES)?;
    let mut data = Data::new("contact", &["body", "mu", "y", "z", "is_below", "range", "range_exact"]);
    let mut shears = Vec::new();
    for body in [2.0, 3.0] {
        let rows = || table.rows.iter().filter(move |row| row[0] == body);
        let &[_, h, modulus, poisson, radius, force, axis, ..] = &rows().next().ok_or("no rows")?[..] else {
            return Err("a row too short".into());
        };
        let law = fatigue_durability()?;
        let parts = Parts { coating: Some([h, modulus, poisson]), substrate: [1.0, 0.3] };
        let half_space = parts.cut(&depths(rows(), 9), |_| law)?;
        for mu in [0.0, 0.3] {
            let step = solved(half_space.clone(), mu, force, POINTS, SPACING * radius)?;
            let found = peaks(&StressField::new(step.finest(), MeanStress::HalfSpace), radius, PathSought::ALL)?;
            for row in rows().filter(|row| row[7] == mu) {
                let (y, z, is_below, exact) = (row[8], row[9], row[10], row[11]);
                let value = range(&found.planes, y, z, is_below == 1.0)?;
                data.rows.push(vec![body - 2.0, mu, y, z, is_below, value / axis, exact / axis]);
            }
            let known = interface.rows.iter().find(|row| row[..3] == [body, mu, 0.0]).ok_or("no such row")?;
            shears.push((of_interface(&found) / axis, known[3] / axis));
        }
    }
    let pairs = data.rows.iter().map(|row| (row[5], row[6]));
    outcome.checks.extend([
        Check::worst("coated, contact: Δτ₁/p₀", pairs, Tolerance::Absolute(OF_CONTACT)),
        Check::worst(
            "coated, contact: range of the interface's shear over p₀",
            shears,
            Tolerance::Absolute(OF_INTERFACE),
        ),
    ]);
    Ok(data)
}
