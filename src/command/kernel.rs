//! `percoat kernel`: the layered half-space's response, one JSON line a wavenumber.

use super::arguments::Traction;
use super::ending::{Ending, Failure};
use super::input::read_case;
use super::terminal;
use crate::body::{Amplitudes, Antiplane, Depth, HalfSpace, InPlane, Interior, TransferFunction};
use serde_json::{Value, json};
use std::io::Write;
use std::path::Path;

pub fn run(
    case: Option<&Path>,
    wavenumbers: &[f64],
    depths: &[f64],
    traction: Traction,
    set: &[String],
) -> Result<Ending, Failure> {
    let (case, _) = read_case(case, set)?;
    let (half_space, transfer) = (case.half_space(), TransferFunction::new(case.half_space()));
    let mut out = terminal::out();
    for &wavenumber in wavenumbers {
        let response = transfer.response(wavenumber);
        let material = half_space.surface_material();
        let unit = 1.0 / (material.shear() * wavenumber);
        // The displacement in the direction of the traction, and over that of a half-space of the surface material.
        let (compliance, correction) = match traction {
            Traction::Normal => (transfer.compliance(wavenumber), transfer.correction(wavenumber)),
            Traction::Along => (response.along, response.along / ((1.0 - material.poisson()) * unit)),
            Traction::Across => (response.across, response.across / unit),
        };
        let mut line = json!({ "wavenumber": wavenumber, "compliance": compliance, "correction": correction });
        if traction != Traction::Across {
            line["coupling"] = response.coupling.into();
        }
        if !depths.is_empty() {
            let rows: Vec<Value> = match traction {
                Traction::Across => rows(depths, half_space, |at| across(&transfer.antiplane(wavenumber, at))),
                Traction::Normal | Traction::Along => {
                    let in_plane = if traction == Traction::Normal { InPlane::Normal } else { InPlane::Along };
                    let interior = Interior::under(in_plane, &transfer, wavenumber);
                    rows(depths, half_space, |at| along(&interior.at(at)))
                }
            };
            line["depths"] = Value::Array(rows);
        }
        writeln!(out, "{line}")?;
    }
    Ok(Ending::Done)
}

/// Amplitudes at the depths: one row each, or on an interface one for each side.
fn rows(depths: &[f64], half_space: &HalfSpace, amplitudes: impl Fn(Depth) -> Value) -> Vec<Value> {
    let row = |depth: Depth| {
        let mut row = json!({ "z": depth.z, "side": depth.material });
        let (row_keys, own) = (row.as_object_mut().expect("an object"), amplitudes(depth));
        row_keys.extend(own.as_object().cloned().unwrap_or_default());
        row
    };
    depths.iter().flat_map(|&z| half_space.depths(z)).map(row).collect()
}

fn along(&Amplitudes { szz, sqz, sqq, stt, uz, uq }: &Amplitudes) -> Value {
    json!({ "szz": szz, "sqz": sqz, "sqq": sqq, "stt": stt, "uz": uz, "uq": uq })
}

fn across(&Antiplane { stz, sqt, ut }: &Antiplane) -> Value {
    json!({ "stz": stz, "sqt": sqt, "ut": ut })
}
