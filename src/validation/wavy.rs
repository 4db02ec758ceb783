//! Square and hexagonal wavy surfaces from first touch to complete contact ([`crate::exact::wavy`]).
//!
//! No closed form spans all loads: between the two asymptotes stands a converged table.

use super::draw::{self, curve, logarithmic};
use super::steps::{Steps, topography};
use super::{Check, Data, Outcome, Study, StudyError, Tolerance};
use crate::exact::Wavy;
use crate::material::{HalfSpace, Material};
use crate::picture::{Axis, Chart, Figure, Style};
use crate::solver::Control;

pub const STUDY: Study =
    Study { name: "wavy", title: "Square and hexagonal wavy surfaces from first touch to complete contact", run };

const REFERENCE: &str = include_str!("../../validation/wavy/reference.csv");
const MERGING: &str = include_str!("../../validation/wavy/merging.csv");

const AMPLITUDE: f64 = 0.01;
/// Samples along the cell, and for the search of the load of merging.
const POINTS: usize = 384;
const FEW: usize = 192;
/// Light enough for the asymptote: the contacts' own interaction is of the order p̄^{2/3}.
const LIGHT: f64 = 1e-3;

fn steps(wavy: Wavy, points: usize) -> Result<Steps, StudyError> {
    let half_space = HalfSpace::new(vec![], Material::from_young(1.0, 0.0)?);
    let surface = topography(wavy.cell()?, [points; 2], |s, t| AMPLITUDE * wavy.height(s, t));
    Steps::new(&surface, &half_space, [points; 2])
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
        let found = steps.hierarchy.full_contact_pressure();
        check(Check::relative(format!("{name}: p*"), found, complete, 1e-12));
        let light = steps.loaded(LIGHT * complete)?;
        check(Check::relative(
            format!("{name}: area, Hertz, f = {LIGHT}"),
            light.contact_fraction,
            wavy.light(LIGHT),
            1e-2,
        ));
        let mut data = Data::new(key, &["fraction", "area", "peak"]);
        for fraction in reference.column("fraction") {
            let found = steps.loaded(fraction * complete)?;
            data.rows.push(vec![fraction, found.contact_fraction, found.max_pressure / complete]);
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
    let (solution, found) = steps.solve(Control::MeanPressure(1.2 * complete))?;
    let n = POINTS as f64;
    let errors = solution.pressure.iter().enumerate().map(|(i, p)| {
        let wave = wavy.height((i / POINTS) as f64 / n, (i % POINTS) as f64 / n);
        (p - 1.2 * complete - 0.5 * wavy.wavenumber() * AMPLITUDE * wave).abs() / complete
    });
    let name = wavy.name();
    let mean = steps.hierarchy.full_contact_penetration();
    Ok(vec![
        Check::absolute(format!("{name}: area, f = 1.2"), found.contact_fraction, 1.0, 1e-15),
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
        let control = Control::MeanPressure(fraction * wavy.complete() * AMPLITUDE);
        if steps.solve(control)?.0.pressure[s * FEW + t] > 0.0 {
            high = fraction;
        } else {
            low = fraction;
        }
    }
    Ok(0.5 * (low + high))
}

fn figure(found: &[Data], reference: &Data) -> Figure {
    let mut areas = Vec::new();
    let mut peaks = Vec::new();
    for ((wavy, data), colour) in Wavy::ALL.into_iter().zip(found).zip(1..) {
        let pairs = |column: &str| data.column("fraction").into_iter().zip(data.column(column)).map(|(x, y)| [x, y]);
        let table = |column: &str| {
            let values = reference.column(&format!("{}_{column}", key(wavy)));
            reference.column("fraction").into_iter().zip(values).map(|(x, y)| [x, y])
        };
        let light = logarithmic(0.01, 0.2, 30).into_iter().map(|f| [f, wavy.light(f)]);
        let nearly = draw::linear(0.8, 1.0, 2).into_iter().map(|f| [f, wavy.nearly_complete(f)]);
        areas.push(curve(if colour == 1 { "asymptotes" } else { "" }, Style::Dashed, colour, light));
        areas.push(curve("", Style::Dashed, colour, nearly));
        areas.push(curve("", Style::Line, colour, table("area")));
        areas.push(curve(wavy.name(), Style::Markers, colour, pairs("area")));
        peaks.push(curve("", Style::Line, colour, table("peak")));
        peaks.push(curve(wavy.name(), Style::Markers, colour, pairs("peak")));
    }
    let chart = |y: &str, curves| Chart {
        title: String::new(),
        caption: Vec::new(),
        x: Axis::linear("mean pressure p̄/p*").from_to(0.0, 1.0),
        y: Axis::linear(y),
        curves,
    };
    let mut area = chart("fraction in contact", areas);
    area.y = area.y.from_to(0.0, 1.0);
    let caption = "Markers: 384 samples across the cell; lines: converged table of an independent solver.";
    draw::figure(vec![area, chart("largest pressure over p*", peaks)], caption)
}
