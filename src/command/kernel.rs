//! `percoat kernel`: the layered half-space's response, one JSON line a wavenumber.

use super::ending::{Ending, Failure};
use super::input::read_case;
use super::terminal;
use percoat::body::{Depth, HalfSpace, Interior, TransferFunction};
use serde_json::{Value, json};
use std::io::Write;
use std::path::Path;

pub fn run(case: Option<&Path>, wavenumbers: &[f64], depths: &[f64], set: &[String]) -> Result<Ending, Failure> {
    let (case, _) = read_case(case, set)?;
    let transfer = TransferFunction::new(case.half_space());
    let mut out = terminal::out();
    for &wavenumber in wavenumbers {
        let mut line = json!({
            "wavenumber": wavenumber,
            "compliance": transfer.compliance(wavenumber),
            "correction": transfer.correction(wavenumber),
        });
        if !depths.is_empty() {
            let interior = Interior::new(&transfer, wavenumber);
            let rows: Vec<Value> = depths.iter().flat_map(|&z| at_depth(&interior, case.half_space(), z)).collect();
            line["depths"] = Value::Array(rows);
        }
        writeln!(out, "{line}")?;
    }
    Ok(Ending::Done)
}

/// Amplitudes at the depth `z`: one row, or on an interface one for each side.
fn at_depth(interior: &Interior, half_space: &HalfSpace, z: f64) -> Vec<Value> {
    let row = |depth: Depth| {
        let amplitudes = interior.at(depth);
        json!({
            "z": z,
            "side": depth.material,
            "szz": amplitudes.szz,
            "sqz": amplitudes.sqz,
            "sqq": amplitudes.sqq,
            "stt": amplitudes.stt,
            "uz": amplitudes.uz,
            "uq": amplitudes.uq,
        })
    };
    half_space.depths(z).into_iter().map(row).collect()
}
