//! Contacts that are open in the middle: a blunt indenter on a stiff plate that slides on its substrate.
//!
//! Inner and outer radius of c r⁴ follow from the integral equation of an annular contact (`reference.py`, which shares
//! nothing with the solver); the indenter stands in a hexagonal cell whose images act by their curvature at the axis.

use super::draw::{self, curve};
use super::steps::Steps;
use super::{Check, Data, Outcome, Study, StudyError};
use percoat_app::picture::{Axis, Chart, Figure, Style};
use percoat_core::body::{HalfSpace, Interface, Layer, Material};
use percoat_core::counterbody::{Indenters, Level, Shape};
use percoat_core::lattice::Lattice;
use percoat_core::load::Load;
use percoat_core::numeric::fourier::fast_points;

pub const STUDY: Study = Study {
    name: "rings",
    title: "Annular contacts under a blunt indenter on a sliding plate",
    files: &["figure.png", "rings.data.csv"],
    run,
    quick: None,
};

const REFERENCE: &str = include_str!("reference.csv");

/// Side of the cell.
const PERIOD: f64 = 4.0;
/// Samples to the outer radius, of which a ring is a fifth to a quarter wide, and how far from the reference its edges may
/// be read, in spacings: 1 % of the radius at 20 samples.
const SAMPLES: [usize; 2] = [10, 20];
const EDGE: f64 = 0.2;

/// One ring of the reference.
struct Ring {
    half_space: HalfSpace,
    young: f64,
    thickness: f64,
    load: f64,
    inner: f64,
    outer: f64,
    peak: f64,
}

impl Ring {
    fn new(row: &[f64]) -> Result<Self, StudyError> {
        let &[young, thickness, load, inner, outer, peak] = row else { return Err("a row too short".into()) };
        let coating = Layer::new(Material::from_young(young, 0.3)?, thickness, Interface::Frictionless)?;
        let half_space = HalfSpace::new(vec![coating], Material::from_young(1.0, 0.3)?);
        Ok(Self { half_space, young, thickness, load, inner, outer, peak })
    }

    /// Inner and outer radius, peak pressure and its stated error, radius √(area/π) and its stated error; the pressure along
    /// a₁ from the axis.
    fn solved(&self, samples: usize) -> Result<([f64; 6], Vec<[f64; 2]>), StudyError> {
        let lattice = Lattice::hexagonal(PERIOD, 1)?;
        let points = fast_points((PERIOD / self.outer * samples as f64 / 0.75f64.powf(0.25)).round() as usize);
        let load = Load::MeanPressure(self.load / lattice.cell().area());
        let shape = Shape::Power { coefficient: 1.0, exponent: 4.0 };
        let indenters = Indenters::new(lattice, vec![Level::new(shape, 0.0)?])?;
        let mut steps = Steps::new(indenters, &self.half_space, [points; 2])?;
        let step = steps.step(load)?;
        let found = step.reading();
        let level = &found.levels[0];
        let (inner, outer) = level.radius_inner.zip(level.radius_outer).ok_or("no ring")?;
        let stated = level.errors;
        let stated = stated.contact_radius.zip(stated.max_pressure).ok_or("no stated error")?;
        let radius = level.contact_radius.ok_or("merged")?;
        let along = (0..points / 8).map(|i| [i as f64 * PERIOD / points as f64, step.pressure()[[i, 0]]]);
        Ok(([inner, outer, level.max_pressure, stated.1, radius, stated.0], along.collect()))
    }
}

fn run() -> Result<Outcome, StudyError> {
    let mut outcome = Outcome::default();
    let rings: Vec<Ring> =
        Data::parse("reference", REFERENCE)?.rows.iter().map(|row| Ring::new(row)).collect::<Result<_, _>>()?;
    let mut data = Data::new(
        "rings",
        &[
            "samples",
            "load",
            "inner",
            "outer",
            "peak",
            "peak_stated",
            "radius",
            "stated",
            "inner_exact",
            "outer_exact",
            "peak_exact",
        ],
    );
    let mut curves = Vec::new();
    for samples in SAMPLES {
        let (mut edges, mut held) = ([0.0f64; 2], [0; 2]);
        for (colour, ring) in (1..).zip(&rings) {
            let ([inner, outer, peak, peak_stated, radius, stated], along) = ring.solved(samples)?;
            data.rows.push(vec![
                samples as f64,
                ring.load,
                inner,
                outer,
                peak,
                peak_stated,
                radius,
                stated,
                ring.inner,
                ring.outer,
                ring.peak,
            ]);
            let spacing = ring.outer / samples as f64;
            edges = [
                edges[0].max((inner - ring.inner).abs() / spacing),
                edges[1].max((outer - ring.outer).abs() / spacing),
            ];
            let exact = ((ring.outer - ring.inner) * (ring.outer + ring.inner)).sqrt();
            held[0] += u8::from((radius - exact).abs() <= stated);
            held[1] += u8::from((peak - ring.peak).abs() <= peak_stated);
            if samples == SAMPLES[1] {
                let scaled = along.into_iter().map(|[r, p]| [r / ring.outer, p / ring.peak]);
                let near = scaled.filter(|[r, _]| (0.65..1.1).contains(r));
                let label = format!("E₁/E₂ = {}, h = {}, P = {}", ring.young, ring.thickness, ring.load);
                curves.push(curve(label, Style::Line, colour, near));
                let ratio = ring.inner / ring.outer;
                curves.push(curve("", Style::Dotted, colour, [[ratio, 0.0], [ratio, 1.0]]));
            }
        }
        for (edge, name) in edges.into_iter().zip(["inner", "outer"]) {
            let name = format!("{name} radius, {samples} samples: largest error in spacings");
            outcome.checks.push(Check::absolute(name, edge, 0.0, EDGE));
        }
        for (held, name) in held.into_iter().zip(["radius √(area/π)", "peak pressure"]) {
            let name = format!("{name}, {samples} samples: rings within the stated error");
            outcome.checks.push(Check::at_least(name, f64::from(held), rings.len() as f64));
        }
    }
    curves.push(curve("inner radius, integral equation", Style::Dotted, 0, []));
    outcome.figures.push(("figure", figure(curves)));
    outcome.data.push(data);
    Ok(outcome)
}

fn figure(curves: Vec<percoat_app::picture::Curve>) -> Figure {
    let chart = Chart {
        title: String::new(),
        x: Axis::linear("distance from the axis over the outer radius"),
        y: Axis::linear("pressure over its largest value"),
        curves,
    };
    draw::figure(vec![chart], "Four rings at 20 samples to the outer radius, all radii scaled to the exact outer one.")
}
