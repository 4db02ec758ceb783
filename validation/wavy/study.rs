//! Square and hexagonal wavy surfaces from first touch to complete contact ([`crate::exact::wavy`]).
//!
//! No closed form spans all loads: between the two asymptotes stands a converged table.

use super::draw::{self, curve, logarithmic};
use super::steps::{Steps, fraction_in_contact, topography};
use super::{Check, Data, Outcome, Study, StudyError, Tolerance};
use crate::exact::Wavy;
use percoat_app::picture::{Axis, Chart, Figure, Style};
use percoat_core::body::{HalfSpace, Material};
use percoat_core::load::Load;

pub const STUDY: Study = Study {
    name: "wavy",
    title: "Square and hexagonal wavy surfaces from first touch to complete contact",
    files: &["egg_box.data.csv", "figure.png", "holes.data.csv", "peaks.data.csv"],
    run,
    quick: None,
};

const REFERENCE: &str = include_str!("reference.csv");
const MERGING: &str = include_str!("merging.csv");

const AMPLITUDE: f64 = 0.01;
/// Samples along the cell, and for the search of the load of merging.
const POINTS: usize = 384;
const FEW: usize = 192;
/// Loads f = p̄/p* light enough for the asymptote, from which the pressure departs as f^{2/3}.
const LIGHT: [f64; 2] = [0.0025, 0.01];

fn steps(wavy: Wavy, points: usize) -> Result<Steps, StudyError> {
    let half_space = HalfSpace::new(vec![], Material::from_young(1.0, 0.0)?);
    let surface = topography(wavy.cell()?, [points; 2], |s, t| AMPLITUDE * wavy.height(s, t))?;
    Steps::new(surface, &half_space, [points; 2])
}

fn key(wavy: Wavy) -> &'static str {
    match wavy {
        Wavy::EggBox => "egg_box",
        Wavy::Peaks => "peaks",
        Wavy::Holes => "holes",
    }
}

fn run() -> Result<Outcome, StudyError> {
    let (reference, merging) = (Data::parse("reference", REFERENCE)?, Data::parse("merging", MERGING)?);
    let mut outcome = Outcome::default();
    for wavy in Wavy::ALL {
        let (key, name) = (key(wavy), wavy.name());
        let complete = wavy.complete() * AMPLITUDE;
        let mut steps = steps(wavy, POINTS)?;
        let mut check = |check| outcome.checks.push(check);
        let found = steps.solver.full_contact_pressure();
        check(Check::relative(format!("{name}: p*"), found, complete, 1e-12));
        let mut departures = Vec::new();
        for fraction in LIGHT {
            let peak = steps.loaded(fraction * complete)?.max_pressure / complete;
            departures.push(1.0 - peak / wavy.light_peak(fraction));
        }
        check(Check::absolute(format!("{name}: departure from Hertz' peak, f = 0.0025"), departures[0], 0.0, 1e-2));
        let order = (departures[1] / departures[0]).ln() / 4f64.ln();
        check(Check::order(format!("{name}: order in f of that departure"), order, 2.0 / 3.0, 0.1));
        let mut data = Data::new(key, &["fraction", "area", "peak"]);
        for fraction in reference.column("fraction") {
            let found = steps.loaded(fraction * complete)?;
            data.rows.push(vec![fraction, fraction_in_contact(&found)?, found.max_pressure / complete]);
        }
        for (quantity, tolerance) in [("area", Tolerance::Absolute(1e-3)), ("peak", Tolerance::Relative(1e-4))] {
            let pairs = data.column(quantity).into_iter().zip(reference.column(&format!("{key}_{quantity}")));
            check(Check::worst(format!("{name}: {quantity}, f = 0.01 to 0.98"), pairs, tolerance));
        }
        let [fraction, area] = data.rows.last().map_or([f64::NAN; 2], |row| [row[0], row[1]]);
        check(Check::absolute(format!("{name}: area, cracks, f = 0.98"), area, wavy.nearly_complete(fraction), 5e-4));
        for each in complete_contact(wavy, &mut steps)? {
            check(each);
        }
        let expected = merging.column(key)[0];
        check(Check::absolute(
            format!("{name}: f at which contacts merge"),
            merged_at(wavy, expected)?,
            expected,
            1e-3,
        ));
        outcome.data.push(data);
    }
    outcome.figures.push(("figure", figure(&outcome.data, &reference)));
    Ok(outcome)
}

/// Beyond p*: contact everywhere, δ the mean of f, and p = p̄ + E*q/2 · Δ · wave.
fn complete_contact(wavy: Wavy, steps: &mut Steps) -> Result<Vec<Check>, StudyError> {
    let complete = wavy.complete() * AMPLITUDE;
    let (step, found) = steps.solve(Load::MeanPressure(1.2 * complete))?;
    let n = POINTS as f64;
    let pressure = step.pressure();
    let errors = pressure.indexed_iter().map(|((i, j), p)| {
        let wave = wavy.height(i as f64 / n, j as f64 / n);
        (p - 1.2 * complete - 0.5 * wavy.wavenumber() * AMPLITUDE * wave).abs() / complete
    });
    let name = wavy.name();
    let mean = steps.solver.full_contact_penetration();
    Ok(vec![
        Check::absolute(format!("{name}: area, f = 1.2"), fraction_in_contact(&found)?, 1.0, 1e-15),
        Check::relative(format!("{name}: penetration, f = 1.2"), found.penetration, mean, 1e-10),
        Check::absolute(
            format!("{name}: pressure over p*, largest error, f = 1.2"),
            errors.fold(0.0, f64::max),
            0.0,
            1e-7,
        ),
    ])
}

/// Mean pressure over p* at which the saddle between two crests comes under pressure, by bisection.
fn merged_at(wavy: Wavy, near: f64) -> Result<f64, StudyError> {
    let mut steps = steps(wavy, FEW)?;
    let [s, t] = wavy.saddle().map(|place| (place * FEW as f64) as usize);
    let [mut low, mut high] = [0.8 * near, 1.2 * near];
    while high - low > 2e-4 {
        let fraction = 0.5 * (low + high);
        let load = Load::MeanPressure(fraction * wavy.complete() * AMPLITUDE);
        if steps.step(load)?.pressure()[[s, t]] > 0.0 {
            high = fraction;
        } else {
            low = fraction;
        }
    }
    Ok(0.5 * (low + high))
}

fn figure(found: &[Data], reference: &Data) -> Figure {
    let [mut areas, mut light, mut holes, mut peaks] = [const { Vec::new() }; 4];
    for ((wavy, data), colour) in Wavy::ALL.into_iter().zip(found).zip(1..) {
        let fractions = data.column("fraction");
        let pairs = |values: Vec<f64>| fractions.iter().copied().zip(values).map(|(x, y)| [x, y]).collect::<Vec<_>>();
        let (area, peak) = (pairs(data.column("area")), pairs(data.column("peak")));
        let table = |column: &str| pairs(reference.column(&format!("{}_{column}", key(wavy))));
        let hertz = logarithmic(0.005, 0.3, 30).into_iter().map(|f| [f, wavy.light(f)]);
        let cracks = logarithmic(0.01, 0.4, 30).into_iter().map(|rest| [rest, 1.0 - wavy.nearly_complete(1.0 - rest)]);
        let open = area.iter().map(|[f, area]| [1.0 - f, 1.0 - area]).collect::<Vec<_>>();
        areas.push(curve(if colour == 1 { "converged table" } else { "" }, Style::Line, colour, table("area")));
        areas.push(curve(wavy.name(), Style::Markers, colour, area.clone()));
        light.push(curve(if colour == 1 { "Hertz" } else { "" }, Style::Dashed, colour, hertz));
        light.push(curve("", Style::Markers, colour, area));
        holes.push(curve(if colour == 1 { "cracks" } else { "" }, Style::Dashed, colour, cracks));
        holes.push(curve("", Style::Markers, colour, open));
        peaks.push(curve("", Style::Line, colour, table("peak")));
        peaks.push(curve("", Style::Markers, colour, peak));
    }
    let chart = |x, y, curves| Chart { title: String::new(), x, y, curves };
    let load = "mean pressure p̄/p*";
    let panels = vec![
        chart(Axis::linear(load).from_to(0.0, 1.0), Axis::linear("fraction in contact A").from_to(0.0, 1.0), areas),
        chart(Axis::linear(load).from_to(0.0, 1.0), Axis::linear("largest pressure over p*"), peaks),
        chart(Axis::log(load), Axis::log("fraction in contact A"), light),
        chart(Axis::log("distance from completion 1 − p̄/p*"), Axis::log("fraction out of contact 1 − A"), holes),
    ];
    draw::figure(
        panels,
        "Markers: 384 samples across the cell. Above against an independent solver, below against the asymptotes.",
    )
}
