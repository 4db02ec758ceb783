//! A paraboloid that slides on a bare body: ranges on lines, the largest of all, and endurance limits.

use super::lines::{
    FORCE, Parts, endurance_durability, fatigue_durability, peaks, peaks_with_errors, range, solved, young,
};
use crate::{Check, Data, Outcome, StudyError, Tolerance};
use percoat_core::body::{Durability, Endurance, Fatigue, HalfSpace, Material, MeanStress};
use percoat_core::reading::FatigueReading;
use percoat_core::stress::{PathSought, StressField, StressFields};

const SLIDING: &str = include_str!("sliding.csv");
const LARGEST: &str = include_str!("largest.csv");
const ENDURANCE: &str = include_str!("endurance.csv");
/// Samples along a window, their spacing over a, and the |y| that are read in it.
const WINDOWS: [(usize, f64, [f64; 2]); 2] = [(128, 0.025, [0.0, 1.2]), (128, 0.05, [1.2, 3.0])];
const POINTS: usize = 128;
/// Exponent of the law by which the largest ranges are found: of two equal cycles the range is 1.4e-3 higher.
const EXPONENT: f64 = 500.0;
/// Spacing of the windows for the largest ranges, over a.
const SPACING: f64 = 2.7 / 128.0;
/// Depths of the table, and those that are read: at least 8 spacings deep, and at two spacings.
const DEPTHS: [f64; 6] = [0.05, 0.2, 0.48, 0.8, 1.5, 3.0];
/// Errors of stresses over p₀ that the grid may leave: from 0.2a on (two stresses of 10⁻⁴), two spacings deep below the
/// edge, on the surface.
const INSIDE: f64 = 2e-4;
const SHALLOW: f64 = 2e-3;
const SURFACE: f64 = 1e-2;
/// Largest |y| of the lines on the surface that cross its edge at an angle.
const CROSSING: f64 = 0.7;
/// Errors of the largest ranges, relative: the pressure at 47 samples a radius (3·10⁻⁴) with what the search leaves
/// open (2·10⁻⁴), and that in contact.
const LARGEST_INSIDE: f64 = 5e-4;
const LARGEST_IN_CONTACT: f64 = 5e-4;
/// Thickness over a of the layers whose endurance is read: a stress changes by 5·10⁻⁵ across them.
const THIN: f64 = 1e-3;
/// Ratios α of Dang Van's criterion with their columns, and the deepest line.
const ALPHAS: [(f64, usize); 2] = [(0.3, 7), (0.6, 8)];
const DEEPEST: f64 = 0.8;
/// A path has twelve places to a radius. Crossland errs by half the square of their distance; Dang Van, whose centre moves with the
/// place that is farthest from it, by the places themselves.
const CROSSLAND: f64 = 3.5e-3;
const DANG_VAN: f64 = 6e-3;

/// Ranges on lines.
pub fn sliding(outcome: &mut Outcome) -> Result<Data, StudyError> {
    let mut data = Data::new("sliding", &["nu", "mu", "y", "z", "range", "range_exact"]);
    let table = Data::parse("sliding", SLIDING)?;
    let mut cases: Vec<[f64; 2]> = table.rows.iter().map(|row| [row[0], row[1]]).collect();
    cases.dedup();
    for [nu, mu] in cases {
        let body = Parts { coating: None, substrate: [young(nu), nu] };
        let law = fatigue_durability()?;
        for (points, spacing, [least, most]) in WINDOWS {
            let step = solved(body.cut(&DEPTHS, |_| law)?, mu, FORCE, points, spacing)?;
            let field = StressField::new(step.finest(), MeanStress::HalfSpace);
            let found = peaks(&field, 1.0, PathSought::ALL)?;
            let in_window = |row: &&Vec<f64>| row[0] == nu && row[1] == mu && (least..most).contains(&row[2]);
            for row in table.rows.iter().filter(in_window) {
                let (y, z) = (row[2], row[3]);
                data.rows.push(vec![nu, mu, y, z, range(&found.planes, y, z, false)?, row[4]]);
            }
        }
    }
    let mut check = |name: &str, wanted: &dyn Fn(&[f64]) -> bool, tolerance: f64| {
        let pairs = data.rows.iter().filter(|row| wanted(row)).map(|row| (row[4], row[5]));
        outcome.checks.push(Check::worst(format!("Δτ₁/p₀, {name}"), pairs, Tolerance::Absolute(tolerance)));
    };
    check("z = 0.2a to 3a", &|row| row[3] >= 0.1, INSIDE);
    check("z = 0.05a, |y| up to a", &|row| row[3] == 0.05 && row[2] < 1.2, SHALLOW);
    check("surface, |y| up to 0.6a", &|row| row[3] == 0.0 && row[2] < CROSSING, SURFACE);
    check("surface and z = 0.05a, y = 1.5a and 2.5a", &|row| row[3] < 0.1 && row[2] > 1.2, SHALLOW);
    Ok(data)
}

/// The largest ranges of all.
pub fn largest(outcome: &mut Outcome) -> Result<Data, StudyError> {
    let mut data =
        Data::new("largest", &["nu", "mu", "range", "range_exact", "stated", "x", "x_exact", "z", "z_exact"]);
    for row in Data::parse("largest", LARGEST)?.rows {
        let &[nu, mu, exact, x, _, z] = &row[..] else { return Err("a row too short".into()) };
        // Steep, but with passes that are a number.
        let law = Fatigue::new(0.4, 1.0, EXPONENT)?;
        let body = HalfSpace::new(vec![], Material::from_young(young(nu), nu)?)
            .with_substrate_durability(Durability { fatigue: Some(law), ..Durability::default() })?;
        let step = solved(body, mu, FORCE, POINTS, SPACING)?;
        let fields = StressFields::new(step.finest(), MeanStress::HalfSpace);
        let first = FatigueReading::of(&step, &step.reading(), &fields).ok_or("no law of fatigue")?.first;
        // The passes err by m times the range.
        let stated = first.error.unwrap_or(f64::NAN) * first.range / EXPONENT;
        data.rows.push(vec![nu, mu, first.range, exact, stated, first.position[0], x, first.position[2], z]);
    }
    let is_edge = |row: &[f64]| row[8] == 0.0 && row[6] == -1.0;
    let pairs = |wanted: &dyn Fn(&[f64]) -> bool| {
        data.rows.iter().filter(|row| wanted(row)).map(|row| (row[2], row[3])).collect::<Vec<_>>()
    };
    outcome.checks.extend([
        Check::worst("largest Δτ₁/p₀ inside the body", pairs(&|row| row[8] > 0.0), Tolerance::Relative(LARGEST_INSIDE)),
        Check::worst(
            "largest Δτ₁/p₀ in contact",
            pairs(&|row| row[8] == 0.0 && !is_edge(row)),
            Tolerance::Relative(LARGEST_IN_CONTACT),
        ),
        Check::worst("largest Δτ₁/p₀ at the trailing edge", pairs(&is_edge), Tolerance::Relative(SURFACE)),
        Check::worst(
            "largest Δτ₁/p₀, error over the stated one",
            data.rows.iter().map(|row| ((row[2] - row[3]).abs() / row[4], 0.0)),
            Tolerance::Absolute(1.0),
        ),
        Check::worst(
            "depth of the largest Δτ₁ over the spacing",
            data.rows.iter().map(|row| (row[7] / SPACING, row[8] / SPACING)),
            Tolerance::Absolute(0.5),
        ),
    ]);
    Ok(data)
}

/// Utilisations of endurance limits on lines below the middle, times τ₋₁.
pub fn endurance(outcome: &mut Outcome) -> Result<Data, StudyError> {
    let columns = [
        "window",
        "mu",
        "z",
        "alpha",
        "crossland",
        "crossland_exact",
        "dang_van",
        "dang_van_exact",
        "crossland_stated",
    ];
    let mut data = Data::new("endurance", &columns);
    let table = Data::parse("endurance", ENDURANCE)?;
    let depths: Vec<f64> = table.rows.iter().filter(|row| row[1] == 0.0).map(|row| row[2]).collect();
    let faces: Vec<f64> = depths.iter().flat_map(|&z| [z, z + THIN]).collect();
    for (alpha, column) in ALPHAS {
        // α = 3 (τ₋₁/σ₋₁ − ½).
        let torsion = 0.2;
        let ratio = alpha / 3.0 + 0.5;
        let limits = Endurance::new(torsion, torsion / ratio)?;
        for ((points, spacing, _), mu) in WINDOWS.into_iter().flat_map(|window| [(window, 0.0), (window, 0.3)]) {
            let nu = 0.3;
            let body = Parts { coating: None, substrate: [young(nu), nu] };
            // Layers of even numbers are the thin ones.
            let body =
                body.cut(
                    &faces,
                    |number| if number % 2 == 0 { endurance_durability(limits) } else { Durability::default() },
                )?;
            let step = solved(body, mu, FORCE, points, spacing)?;
            let on = |contact| StressField::new(contact, MeanStress::HalfSpace);
            let coarser = step.coarser().first().map(on);
            let found = peaks_with_errors(&on(step.finest()), coarser.as_ref(), 1.0, PathSought::ALL)?;
            for (number, &z) in depths.iter().enumerate() {
                let material = found.materials[2 * number + 1];
                let row = table.rows.iter().find(|row| row[1] == mu && row[2] == z).ok_or("no such row")?;
                let crossland = row[3] + (3.0 * ratio - 3f64.sqrt()) * row[5];
                let value =
                    |peak: Option<percoat_core::stress::PathPeak>| peak.map_or(f64::NAN, |peak| peak.value * torsion);
                let side = points as f64 * spacing;
                let stated = torsion * material.crossland.and_then(|peak| peak.error).unwrap_or(f64::NAN);
                let found = [value(material.crossland), crossland, value(material.dang_van), row[column], stated];
                data.rows.push([&[side, mu, z, alpha], &found[..]].concat());
            }
        }
    }
    // The largest over y stands on y = 0, that of Dang Van for the larger α at the deepest line alone.
    let on_axis = |row: &&Vec<f64>| row[3] == ALPHAS[0].0 || row[2] == DEEPEST;
    for (points, spacing, _) in WINDOWS {
        let side = points as f64 * spacing;
        let rows = || data.rows.iter().filter(move |row| row[0] == side);
        // Under friction σ_H is largest beyond the small window.
        let crossland = rows().filter(|row| side > 4.0 || row[1] == 0.0).map(|row| (row[4], row[5]));
        let dang_van = rows().filter(on_axis).map(|row| (row[6], row[7]));
        outcome.checks.extend([
            Check::worst(
                format!("Crossland, window of {side:.1}a: utilisation times τ₋₁/p₀"),
                crossland,
                Tolerance::Relative(CROSSLAND),
            ),
            Check::worst(
                format!("Dang Van, window of {side:.1}a: utilisation times τ₋₁/p₀"),
                dang_van,
                Tolerance::Absolute(DANG_VAN),
            ),
        ]);
    }
    let stated = data.rows.iter().map(|row| ((row[4] - row[5]).abs() / row[8], 0.0));
    outcome.checks.push(Check::worst(
        "Crossland in both windows, error over the stated one",
        stated,
        Tolerance::Absolute(1.0),
    ));
    Ok(data)
}
