//! The layered half-space against solutions in 120-digit arithmetic (`validation/kernel`): 700 under a pressure, 414 under
//! shear tractions.

use super::draw::{self, curve};
use super::{Check, Data, Outcome, Study, StudyError, Tolerance};
use percoat_app::picture::{Axis, Chart, Figure, Style};
use percoat_core::body::{Amplitudes, Antiplane, Depth, HalfSpace, InPlane, Interface, Layer, Material};
use percoat_core::numeric::search::largest;
use serde_json::Value;

pub const STUDY: Study = Study {
    name: "kernel",
    title: "Layered half-space against multiprecision solutions of 700 stacks under pressure, 414 under shear",
    files: &["compliance.data.csv", "figure.png", "interior.data.csv", "tangential.data.csv"],
    run,
    quick: None,
};

/// One stack of a table.
pub(super) struct Reference {
    pub half_space: HalfSpace,
    pub wavenumber: f64,
    /// Displacements of the surface under a unit traction.
    surface: Value,
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
    pub fn read(line: &str) -> Result<Self, StudyError> {
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
            surface: value.clone(),
            interior: value["interior"].as_array().cloned().unwrap_or_default(),
        })
    }

    /// Largest error of the amplitudes at one point: of stresses and of displacements.
    ///
    /// Displacements in units of the surface displacement; stresses in units of the surface pressure, or of the in-plane
    /// stress where bending makes that larger.
    fn interior_errors(&self, point: &Value) -> Result<[f64; 2], StudyError> {
        let interior = self.half_space.response().interior(InPlane::Normal, self.wavenumber);
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
        let compliance = self.compliance()?;
        let displacements = [error("uz", amplitudes.uz, compliance)?, error("uq", amplitudes.uq, compliance)?];
        Ok([largest(stresses), largest(displacements)])
    }

    /// u_q and u_z of the surface under a unit shear traction along the wavevector.
    pub fn along(&self) -> Result<[f64; 2], StudyError> {
        let along = &self.surface["along"];
        Ok([number(&along["uq"])?, number(&along["uz"])?])
    }

    fn compliance(&self) -> Result<f64, StudyError> {
        number(&self.surface["compliance"])
    }

    /// Relative errors of the surface displacements under shear tractions: u_q along the wavevector; u_z, whose size may
    /// vanish, over the larger of both; u_t across it.
    fn tangential_errors(&self) -> Result<[f64; 3], StudyError> {
        let response = self.half_space.response().surface(self.wavenumber);
        let ([uq, uz], ut) = (self.along()?, number(&self.surface["across"]["ut"])?);
        let error = |found: f64, known: f64, scale: f64| (found - known).abs() / scale;
        Ok([
            error(response.along, uq, uq),
            error(response.coupling, uz, uq.max(uz.abs())),
            error(response.across, ut, ut),
        ])
    }

    /// Largest errors of the amplitudes at one point under shear tractions, as [`Self::interior_errors`] has them.
    fn tangential_interior_errors(&self, point: &Value) -> Result<[f64; 2], StudyError> {
        let transfer = self.half_space.response();
        let material = point["side"].as_u64().ok_or("no side")? as usize;
        let depth = Depth { z: number(&point["z"])?, material };
        let Amplitudes { szz, sqz, sqq, stt, uz, uq } = transfer.interior(InPlane::Along, self.wavenumber).at(depth);
        let Antiplane { stz, sqt, ut } = transfer.antiplane(self.wavenumber, depth);
        let across = &self.surface["across"];
        let magnitude = |name: &str| Ok::<f64, StudyError>(number(&point[name])?.abs());
        let (in_plane, lateral) = (magnitude("sqq")?.max(1.0), magnitude("sqt")?.max(1.0));
        let largest_along = largest(self.along()?.map(f64::abs));
        let error = |name: &str, value: f64, scale: f64| -> Result<f64, StudyError> {
            Ok((value - number(&point[name])?).abs() / scale)
        };
        let stresses = [
            error("szz", szz, 1.0)?,
            error("sqz", sqz, 1.0)?,
            error("sqq", sqq, in_plane)?,
            error("stt", stt, in_plane)?,
            error("stz", stz, 1.0)?,
            error("sqt", sqt, lateral)?,
        ];
        let displacements = [
            error("uz", uz, largest_along)?,
            error("uq", uq, largest_along)?,
            error("ut", ut, number(&across["ut"])?)?,
        ];
        Ok([largest(stresses), largest(displacements)])
    }
}

fn run() -> Result<Outcome, StudyError> {
    let lines = include_str!("reference.jsonl").lines();
    let references: Vec<Reference> = lines.map(Reference::read).collect::<Result<_, _>>()?;
    let mut surface = Data::new("compliance", &["stack", "layers", "wavenumber", "compliance", "reference", "error"]);
    let mut interior = Data::new("interior", &["stack", "side", "depth", "stress_error", "displacement_error"]);
    for (stack, reference) in (1..).zip(&references) {
        let compliance = reference.half_space.response().compliance(reference.wavenumber);
        surface.rows.push(vec![
            f64::from(stack),
            reference.half_space.layers().len() as f64,
            reference.wavenumber,
            compliance,
            reference.compliance()?,
            (compliance / reference.compliance()? - 1.0).abs(),
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
    let lines = include_str!("tangential.jsonl").lines();
    let references: Vec<Reference> = lines.map(Reference::read).collect::<Result<_, _>>()?;
    let columns = ["stack", "layers", "along", "coupling", "across", "stress_error", "displacement_error"];
    let mut tangential = Data::new("tangential", &columns);
    for (stack, reference) in (1..).zip(&references) {
        let inside: Vec<[f64; 2]> = reference
            .interior
            .iter()
            .map(|point| reference.tangential_interior_errors(point))
            .collect::<Result<_, _>>()?;
        let [stress, displacement] = [0, 1].map(|k| largest(inside.iter().map(|errors| errors[k])).max(0.0));
        let [along, coupling, across] = reference.tangential_errors()?;
        let layers = reference.half_space.layers().len() as f64;
        tangential.rows.push(vec![f64::from(stack), layers, along, coupling, across, stress, displacement]);
    }
    let check = |name: &str, errors: Vec<f64>, tolerance| {
        Check::worst(name, errors.into_iter().map(|error| (error, 0.0)), Tolerance::Absolute(tolerance))
    };
    let checks = vec![
        check("compliance, largest relative error", surface.column("error"), 1e-12),
        check("stresses inside, largest error over p̂", interior.column("stress_error"), 1e-10),
        check("displacements inside, largest error over ŵ(0)", interior.column("displacement_error"), 1e-10),
        check("shear along: u_q, largest relative error", tangential.column("along"), 1e-12),
        check("shear along: u_z, largest error over u_q or u_z", tangential.column("coupling"), 1e-12),
        check("shear across: u_t, largest relative error", tangential.column("across"), 1e-12),
        check("shear: stresses inside, largest error over q̂", tangential.column("stress_error"), 1e-10),
        check("shear: displacements inside, largest error over û(0)", tangential.column("displacement_error"), 1e-10),
    ];
    let figures = vec![("figure", figure(&surface, &interior, &tangential))];
    Ok(Outcome { checks, figures, data: vec![surface, interior, tangential], ..Outcome::default() })
}

/// Errors of compliance and interior, the worst first: a distribution with all its tail.
fn figure(surface: &Data, interior: &Data, tangential: &Data) -> Figure {
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
            curve("shear along", Style::Line, 4, sorted(tangential.column("along"))),
            curve("coupling", Style::Line, 5, sorted(tangential.column("coupling"))),
            curve("shear across", Style::Line, 6, sorted(tangential.column("across"))),
        ],
    };
    draw::figure(
        vec![chart],
        "Errors against 120-digit solutions of 700 stacks of 1 to 20 layers under pressure, 414 under shear.",
    )
}
