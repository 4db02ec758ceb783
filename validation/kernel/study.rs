//! The layered half-space against 700 solutions in 120-digit arithmetic (`validation/kernel`).

use super::draw::{self, curve};
use super::{Check, Data, Outcome, Study, StudyError, Tolerance};
use crate::body::{Depth, HalfSpace, Interface, Interior, Layer, Material, TransferFunction};
use crate::numeric::search::largest;
use crate::picture::{Axis, Chart, Figure, Style};
use serde_json::Value;

pub const STUDY: Study = Study {
    name: "kernel",
    title: "Layered half-space against multiprecision solutions of 700 stacks",
    files: &["compliance.data.csv", "figure.png", "interior.data.csv"],
    run,
};

struct Reference {
    half_space: HalfSpace,
    wavenumber: f64,
    compliance: f64,
    interior: Vec<Value>,
}

fn number(value: &Value) -> Result<f64, StudyError> {
    value.as_f64().ok_or_else(|| format!("{value} is no number").into())
}

fn material(value: &Value) -> Result<Material, StudyError> {
    Ok(Material::from_shear(number(&value["shear"])?, number(&value["poisson"])?)?)
}

fn interface(value: &Value) -> Result<Interface, StudyError> {
    let stiffness = |key: &str| value.get(key).map_or(Ok(f64::INFINITY), number);
    Ok(match value.as_str() {
        Some("bonded") => Interface::Bonded,
        Some("frictionless") => Interface::Frictionless,
        _ => {
            Interface::Spring { tangential: stiffness("tangential_stiffness")?, normal: stiffness("normal_stiffness")? }
        }
    })
}

impl Reference {
    /// One line of `reference.jsonl`.
    fn read(line: &str) -> Result<Self, StudyError> {
        let value: Value = serde_json::from_str(line)?;
        let layers: Result<Vec<Layer>, StudyError> = value["layers"]
            .as_array()
            .ok_or("no layers")?
            .iter()
            .map(|layer| {
                Ok(Layer::new(material(layer)?, number(&layer["thickness"])?, interface(&layer["interface"])?)?)
            })
            .collect();
        Ok(Self {
            half_space: HalfSpace::new(layers?, material(&value["substrate"])?),
            wavenumber: number(&value["wavenumber"])?,
            compliance: number(&value["compliance"])?,
            interior: value["interior"].as_array().cloned().unwrap_or_default(),
        })
    }

    /// Largest error of the amplitudes at one point: of stresses and of displacements.
    ///
    /// Displacements in units of the surface displacement; stresses in units of the surface pressure, or of the in-plane
    /// stress where bending makes that larger.
    fn interior_errors(&self, point: &Value) -> Result<[f64; 2], StudyError> {
        let interior = Interior::new(&TransferFunction::new(&self.half_space), self.wavenumber);
        let material = point["side"].as_u64().ok_or("no side")? as usize;
        let amplitudes = interior.at(Depth { z: number(&point["z"])?, material });
        let stress = number(&point["sqq"])?.abs().max(1.0);
        let error = |name: &str, value: f64, scale: f64| -> Result<f64, StudyError> {
            Ok((value - number(&point[name])?).abs() / scale)
        };
        let stresses = [
            error("szz", amplitudes.szz, 1.0)?,
            error("sqz", amplitudes.sqz, 1.0)?,
            error("sqq", amplitudes.sqq, stress)?,
            error("stt", amplitudes.stt, stress)?,
        ];
        let displacements =
            [error("uz", amplitudes.uz, self.compliance)?, error("uq", amplitudes.uq, self.compliance)?];
        Ok([largest(stresses), largest(displacements)])
    }
}

fn run() -> Result<Outcome, StudyError> {
    let lines = include_str!("reference.jsonl").lines();
    let references: Vec<Reference> = lines.map(Reference::read).collect::<Result<_, _>>()?;
    let mut surface = Data::new("compliance", &["stack", "layers", "wavenumber", "compliance", "reference", "error"]);
    let mut interior = Data::new("interior", &["stack", "side", "depth", "stress_error", "displacement_error"]);
    for (stack, reference) in (1..).zip(&references) {
        let compliance = TransferFunction::new(&reference.half_space).compliance(reference.wavenumber);
        surface.rows.push(vec![
            f64::from(stack),
            reference.half_space.layers().len() as f64,
            reference.wavenumber,
            compliance,
            reference.compliance,
            (compliance / reference.compliance - 1.0).abs(),
        ]);
        for point in &reference.interior {
            let [stress, displacement] = reference.interior_errors(point)?;
            interior.rows.push(vec![
                f64::from(stack),
                number(&point["side"])?,
                number(&point["z"])?,
                stress,
                displacement,
            ]);
        }
    }
    let check = |name: &str, errors: Vec<f64>, tolerance| {
        Check::worst(name, errors.into_iter().map(|error| (error, 0.0)), Tolerance::Absolute(tolerance))
    };
    let checks = vec![
        check("compliance, largest relative error", surface.column("error"), 1e-12),
        check("stresses inside, largest error over p̂", interior.column("stress_error"), 1e-10),
        check("displacements inside, largest error over ŵ(0)", interior.column("displacement_error"), 1e-10),
    ];
    let figures = vec![("figure", figure(&surface, &interior))];
    Ok(Outcome { checks, figures, data: vec![surface, interior], ..Outcome::default() })
}

/// Errors of compliance and interior, the worst first: a distribution with all its tail.
fn figure(surface: &Data, interior: &Data) -> Figure {
    let sorted = |mut errors: Vec<f64>| -> Vec<[f64; 2]> {
        errors.sort_by(|a, b| b.total_cmp(a));
        let count = errors.len() as f64;
        // An error of zero is drawn as the rounding unit.
        (1..)
            .zip(errors)
            .map(|(rank, error): (i32, f64)| [f64::from(rank) / count, error.max(f64::EPSILON / 2.0)])
            .collect()
    };
    let bound = |label: &str, tolerance: f64, colour| {
        curve(label, Style::Dashed, colour, [[1.0 / 3000.0, tolerance], [1.0, tolerance]])
    };
    let chart = Chart {
        title: String::new(),
        x: Axis::log("fraction of stacks or points with a larger error"),
        y: Axis::log("error").from_to(1e-17, 1e-8),
        curves: vec![
            curve("compliance", Style::Line, 1, sorted(surface.column("error"))),
            bound("its tolerance", 1e-12, 1),
            curve("stresses inside", Style::Line, 2, sorted(interior.column("stress_error"))),
            curve("displacements inside", Style::Line, 3, sorted(interior.column("displacement_error"))),
            bound("their tolerance", 1e-10, 2),
        ],
    };
    draw::figure(vec![chart], "Errors against 120-digit solutions of 700 stacks of 1 to 20 layers.")
}
