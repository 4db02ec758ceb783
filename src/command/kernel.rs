//! `percoat kernel`: the layered half-space's response, one JSON line a wavenumber.

use super::{Common, Failure, Outcome, read_case};
use percoat::layered::{Interior, TransferFunction};
use serde_json::{Value, json};
use std::io::Write;
use std::path::Path;

pub fn run(case: Option<&Path>, wavenumbers: &[f64], depths: &[f64], common: &Common) -> Result<Outcome, Failure> {
    let (case, _) = read_case(case, common)?;
    let transfer = TransferFunction::new(case.half_space());
    let faces = case.half_space().interface_depths();
    let mut out = std::io::stdout().lock();
    for &wavenumber in wavenumbers {
        let mut line = json!({
            "wavenumber": wavenumber,
            "compliance": transfer.compliance(wavenumber),
            "correction": transfer.correction(wavenumber),
        });
        if !depths.is_empty() {
            let interior = Interior::new(&transfer, wavenumber);
            let rows: Vec<Value> = depths.iter().flat_map(|&z| at_depth(&interior, &faces, z)).collect();
            line["depths"] = Value::Array(rows);
        }
        writeln!(out, "{line}")?;
    }
    Ok(Outcome::Done)
}

/// Amplitudes at the depth `z`: one row, or on an interface one for each side.
fn at_depth(interior: &Interior, faces: &[f64], z: f64) -> Vec<Value> {
    let above = faces.iter().filter(|&&face| face < z).count();
    let below = faces.iter().filter(|&&face| face <= z).count();
    (above..=below)
        .map(|material| {
            let top = if material == 0 { 0.0 } else { faces[material - 1] };
            let amplitudes = interior.at(material + 1, z - top);
            json!({
                "z": z,
                "side": material + 1,
                "szz": amplitudes.szz,
                "sqz": amplitudes.sqz,
                "sqq": amplitudes.sqq,
                "stt": amplitudes.stt,
                "uz": amplitudes.uz,
                "uq": amplitudes.uq,
            })
        })
        .collect()
}
