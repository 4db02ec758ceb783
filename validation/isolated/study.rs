//! One indenter alone, from a cell of twenty contact radii whose images are taken off.
//!
//! The images curve the surface by c₂ = PΔS₃/(4πE₁*) and lift it by PΔS₁/(πE₁*), ΔS_n their effective sums: the solver
//! gets an indenter less curved by c₂, and the lift is taken off its penetration. What is left is compared with the
//! integral equation of the contact ([`crate::exact::coated_contact`]) and, without coating, with Galin's power laws.

use super::draw::{self, curve, logarithmic};
use super::steps::{Steps, case};
use super::{Check, Data, Outcome, Study, StudyError, Tolerance};
use crate::exact::lattice_sums::{TRIANGULAR, coated_images};
use crate::exact::{CoatedContact, Coating, Sums, System, Term};
use percoat_app::picture::{Axis, Chart, Figure, Style};
use percoat_core::load::Load;
use std::f64::consts::PI;

pub const STUDY: Study = Study {
    name: "isolated",
    title: "One indenter alone on a coating, a layer and a half-space",
    files: &["coated.data.csv", "figure.png"],
    run,
    quick: None,
};

const CASE: &str = include_str!("case.toml");
const REFERENCE: &str = include_str!("reference.csv");
const INCOMPRESSIBLE: &str = include_str!("incompressible.csv");

/// Samples along the side of the cell.
const POINTS: usize = 400;
/// Side of the cell over the contact radius.
const SIDE: f64 = 20.0;

fn run() -> Result<Outcome, StudyError> {
    let mut outcome = Outcome::default();
    let coated = coated(&mut outcome)?;
    incompressible(&mut outcome)?;
    power_laws(&mut outcome)?;
    outcome.figures.push(("figure", figure(&coated)?));
    outcome.data.push(coated);
    Ok(outcome)
}

/// The case with a layer, a shape `profile` (TOML), a side and a mean pressure of its own.
fn steps(layers: &str, poisson: f64, shape: &str, side: f64) -> Result<Steps, StudyError> {
    let overrides = [
        format!("lattice.period={side}"),
        format!("levels=[{{ {shape} }}]"),
        format!("layers={layers}"),
        format!("substrate.poisson={poisson}"),
    ];
    Steps::of(&case("isolated", CASE, &overrides)?, POINTS)
}

/// Solved contact of a paraboloid of unit radius on a coating, the penetration without images.
struct Alone {
    penetration: f64,
    peak: f64,
    radius: f64,
}

impl Alone {
    /// The contact under `load`, which makes a contact of about the radius `radius`.
    fn new(chi: f64, nu1: f64, load: f64, radius: f64) -> Result<Self, StudyError> {
        let coating = Coating::new(chi, [nu1, 0.3], 1.0)?;
        let side = SIDE * radius;
        let scale = PI * coating.modulus();
        let Sums([s1, s3, s5]) = coated_images(&coating, side);
        let second = 0.4 * load * radius * radius;
        let c2 = (load * s3 / 4.0 + 9.0 * second * s5 / 16.0) / scale;
        let lift = (load * s1 + second * s3 / 4.0) / scale;
        let layers = format!("[{{ thickness = 1.0, shear_ratio = {chi}, poisson = {nu1} }}]");
        let shape = format!("shape = \"paraboloid\", radius = {}", 0.5 / (0.5 - c2));
        let found = steps(&layers, 0.3, &shape, side)?.loaded(load / (0.75f64.sqrt() * side * side))?;
        Ok(Self {
            penetration: found.penetration - lift,
            peak: found.max_pressure,
            radius: found.levels[0].contact_radius.unwrap_or(f64::NAN),
        })
    }
}

fn coated(outcome: &mut Outcome) -> Result<Data, StudyError> {
    let reference = Data::parse("reference", REFERENCE)?;
    let mut data = Data::new("coated", &["chi", "nu1", "radius", "found_radius", "penetration", "peak"]);
    let mut equation = Data::new("equation", &["load", "penetration", "peak"]);
    for row in &reference.rows {
        let &[chi, nu1, radius, load, ..] = &row[..] else { return Err("a row too short".into()) };
        let alone = Alone::new(chi, nu1, load, radius)?;
        data.rows.push(vec![chi, nu1, radius, alone.radius, alone.penetration, alone.peak]);
        let exact = CoatedContact::new(&Coating::new(chi, [nu1, 0.3], 1.0)?, radius).ok_or("a singular system")?;
        equation.rows.push(vec![exact.load, exact.penetration, exact.peak]);
    }
    for quantity in ["load", "penetration", "peak"] {
        let pairs = equation.column(quantity).into_iter().zip(reference.column(quantity));
        let name = format!("integral equation: {quantity}, table of ten contacts");
        // The table has ten decimals.
        outcome.checks.push(Check::worst(name, pairs, Tolerance::Absolute(1e-9)));
    }
    for (name, chi) in [("hard", 2.0), ("soft", 0.5)] {
        let rows = || data.rows.iter().zip(&reference.rows).filter(|(row, _)| row[0] == chi);
        let mut check = |quantity: &str, pairs: Vec<(f64, f64)>, tolerance| {
            let name = format!("{name} coating: {quantity}, a/h = 0.1 to 2");
            outcome.checks.push(Check::worst(name, pairs, Tolerance::Relative(tolerance)));
        };
        check("penetration", rows().map(|(found, exact)| (found[4], exact[4])).collect(), 1e-4);
        check("peak", rows().map(|(found, exact)| (found[5], exact[5])).collect(), 2e-4);
        check("radius", rows().map(|(found, exact)| (found[3], exact[2])).collect(), 1e-3);
    }
    Ok(data)
}

/// The layer keeps its volume: the mean plane of its surface does not move.
fn incompressible(outcome: &mut Outcome) -> Result<(), StudyError> {
    let modulus = Coating::new(1e-6, [0.5, 0.3], 1.0)?.modulus();
    let mut pairs = Vec::new();
    for row in Data::parse("incompressible", INCOMPRESSIBLE)?.rows {
        let &[x, ratio] = &row[..] else { return Err("a row too short".into()) };
        let load = ratio * 4.0 / 3.0 * modulus * x.powi(3);
        pairs.push((Alone::new(1e-6, 0.5, load, 1.1 * x)?.penetration, x * x));
    }
    // X is given to 5 digits.
    let name = "incompressible layer on a rigid base: penetration, X = 0.1 to 0.75";
    outcome.checks.push(Check::worst(name, pairs, Tolerance::Relative(2e-4)));
    Ok(())
}

/// Cones and power laws of contact radius 1, E* = 1.
fn power_laws(outcome: &mut Outcome) -> Result<(), StudyError> {
    let [mut penetrations, mut radii, mut axes] = [const { Vec::new() }; 3];
    for exponent in [1.0, 1.5, 3.0, 4.0] {
        let term = Term { coefficient: 0.1, exponent };
        let expected = System::single(1.0, TRIANGULAR.scaled(SIDE), vec![term]).contacts(&[1.0])[0];
        let shape = format!("shape = \"power\", coefficient = 0.1, exponent = {exponent}");
        let load = Load::MeanPressure(expected.load / (0.75f64.sqrt() * SIDE * SIDE));
        let (step, found) = steps("[]", 0.0, &shape, SIDE)?.solve(load)?;
        penetrations.push((found.penetration, expected.penetration));
        radii.push((found.levels[0].contact_radius.unwrap_or(f64::NAN), 1.0));
        // Below n = 2 the pressure has a cusp on the axis.
        if exponent > 2.0 {
            axes.push((step.pressure()[[0, 0]], expected.axis));
        }
        if exponent == 1.0 {
            // Sneddon (1965): p = ½E*s arcosh(a/r); there are 20 samples to the radius.
            let pairs = [5usize, 10, 15].map(|i| (step.pressure()[[0, i]], 0.05 * (20.0 / i as f64).acosh()));
            let name = "cone: pressure at r = a/4, a/2, 3a/4";
            outcome.checks.push(Check::worst(name, pairs, Tolerance::Relative(1e-3)));
        }
    }
    for (quantity, pairs, tolerance) in [
        ("penetration, n = 1 to 4", penetrations, 1e-4),
        ("radius, n = 1 to 4", radii, 1e-3),
        ("pressure on the axis, n = 3, 4", axes, 4e-4),
    ] {
        outcome.checks.push(Check::worst(format!("indenters rⁿ: {quantity}"), pairs, Tolerance::Relative(tolerance)));
    }
    Ok(())
}

/// Effect of a coating on Hertz' contact of the same radius: load over 4E₂*a³/3 and pressure over 2E₂*a/π.
fn figure(found: &Data) -> Result<Figure, StudyError> {
    let mut curves = Vec::new();
    let substrate = 1.0 / (1.0 - 0.09);
    for (chi, nu1, colour) in [(2.0, 0.2, 1), (0.5, 0.45, 2)] {
        let coating = Coating::new(chi, [nu1, 0.3], 1.0)?;
        let mut exact = Vec::new();
        for radius in logarithmic(0.05, 10.0, 50) {
            let contact = CoatedContact::new(&coating, radius).ok_or("a singular system")?;
            exact.push([radius, 0.5 * PI * contact.peak / (substrate * radius)]);
        }
        let rows = found.rows.iter().filter(|row| row[0] == chi);
        let points = rows.map(|row| [row[2], 0.5 * PI * row[5] / (substrate * row[2])]);
        curves.push(curve(format!("χ = {chi}, ν₁ = {nu1}: integral equation"), Style::Line, colour, exact));
        curves.push(curve("solver", Style::Markers, colour, points));
        let limit = coating.modulus() / substrate;
        curves.push(curve("", Style::Dotted, colour, [[0.05, limit], [10.0, limit]]));
    }
    curves.push(curve("E₂*, E₁* alone", Style::Dotted, 0, [[0.05, 1.0], [10.0, 1.0]]));
    let chart = Chart {
        title: String::new(),
        x: Axis::log("contact radius over thickness a/h"),
        y: Axis::linear("pressure on the axis over 2E₂*a/(πR)").from_to(0.4, 2.2),
        curves,
    };
    Ok(draw::figure(
        vec![chart],
        "A paraboloid alone on a bonded coating, from the coating's Hertz to the substrate's.",
    ))
}
