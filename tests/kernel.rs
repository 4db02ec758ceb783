//! The layered half-space against 700 solutions in 120-digit arithmetic (`validation/kernel`).

use percoat::layered::{Interior, TransferFunction};
use percoat::material::{HalfSpace, Interface, Layer, Material};
use serde_json::Value;

struct Reference {
    half_space: HalfSpace,
    wavenumber: f64,
    compliance: f64,
    interior: Vec<Value>,
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

fn material(value: &Value) -> Material {
    Material::from_shear(number(&value["shear"]), number(&value["poisson"])).expect("a material")
}

fn interface(value: &Value) -> Interface {
    let stiffness = |key: &str| value.get(key).map_or(f64::INFINITY, number);
    match value.as_str() {
        Some("bonded") => Interface::Bonded,
        Some("frictionless") => Interface::Frictionless,
        _ => Interface::Spring { tangential: stiffness("tangential_stiffness"), normal: stiffness("normal_stiffness") },
    }
}

fn references() -> Vec<Reference> {
    let references: Vec<Reference> = include_str!("../validation/kernel/reference.jsonl")
        .lines()
        .map(|line| {
            let value: Value = serde_json::from_str(line).expect("one JSON object a line");
            let layers = value["layers"].as_array().expect("layers").iter().map(|layer| {
                Layer::new(material(layer), number(&layer["thickness"]), interface(&layer["interface"]))
                    .expect("a layer")
            });
            Reference {
                half_space: HalfSpace::new(layers.collect(), material(&value["substrate"])),
                wavenumber: number(&value["wavenumber"]),
                compliance: number(&value["compliance"]),
                interior: value.get("interior").and_then(Value::as_array).cloned().unwrap_or_default(),
            }
        })
        .collect();
    assert_eq!(references.len(), 700);
    references
}

#[test]
fn compliance_is_exact_to_one_part_in_1e12_for_every_stack() {
    let mut worst: f64 = 0.0;
    for (line, reference) in (1..).zip(references()) {
        let compliance = TransferFunction::new(&reference.half_space).compliance(reference.wavenumber);
        let error = (compliance / reference.compliance - 1.0).abs();
        assert!(
            error < 1e-12,
            "line {line}: {compliance} against {}, relative error {error:.1e}",
            reference.compliance
        );
        worst = worst.max(error);
    }
    println!("largest relative error of the compliance: {worst:.2e}");
}

#[test]
fn interior_amplitudes_are_exact_to_1e10_of_the_surface_pressure() {
    let (mut points, mut worst): (usize, f64) = (0, 0.0);
    for (line, reference) in (1..).zip(references()) {
        let interior = Interior::new(&TransferFunction::new(&reference.half_space), reference.wavenumber);
        let tops: Vec<f64> = std::iter::once(0.0).chain(reference.half_space.interface_depths()).collect();
        for point in &reference.interior {
            let side = point["side"].as_u64().expect("a side") as usize;
            let amplitudes = interior.at(side, number(&point["z"]) - tops[side - 1]);
            // Displacements in units of the surface displacement; stresses in units of the surface pressure, or of the
            // in-plane stress where bending makes that larger.
            let stress = number(&point["sqq"]).abs().max(1.0);
            for (name, value, scale) in [
                ("szz", amplitudes.szz, 1.0),
                ("sqz", amplitudes.sqz, 1.0),
                ("sqq", amplitudes.sqq, stress),
                ("stt", amplitudes.stt, stress),
                ("uz", amplitudes.uz, reference.compliance),
                ("uq", amplitudes.uq, reference.compliance),
            ] {
                let error = (value - number(&point[name])).abs() / scale;
                assert!(error < 1e-10, "line {line}, {point}: {name} = {value:e}, error {error:.1e}");
                worst = worst.max(error);
            }
            points += 1;
        }
    }
    assert!(points > 2000, "only {points} points");
    println!("largest error of an amplitude at {points} points: {worst:.2e}");
}
