//! The layered half-space's response to a harmonic traction, as `percoat kernel` prints it.

use percoat_core::body::{Amplitudes, Antiplane, Depth, HalfSpace, InPlane, LayeredResponse};
use serde_json::{Value, json};

/// Direction of the traction on the surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
pub enum Traction {
    /// A pressure
    #[default]
    Normal,
    /// A shear traction along the wavevector
    Along,
    /// A shear traction across the wavevector
    Across,
}

/// The response at a `wavenumber` q > 0, 1/length, as text: the displacement in the direction of the traction per unit of it,
/// its ratio to that of a half-space of the surface material, and amplitudes at `depths` z ≥ 0, one row each, on an interface one
/// for each side.
pub fn kernel(
    transfer: &LayeredResponse,
    half_space: &HalfSpace,
    wavenumber: f64,
    depths: &[f64],
    traction: Traction,
) -> Value {
    let response = transfer.surface(wavenumber);
    let material = half_space.surface_material();
    let unit = 1.0 / (material.shear() * wavenumber);
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
                let interior = transfer.interior(in_plane, wavenumber);
                rows(depths, half_space, |at| along(&interior.at(at)))
            }
        };
        line["depths"] = Value::Array(rows);
    }
    line
}

fn rows(depths: &[f64], half_space: &HalfSpace, amplitudes: impl Fn(Depth) -> Value) -> Vec<Value> {
    let row = |depth: Depth| {
        let mut row = json!({ "z": depth.z, "side": depth.material });
        let (row_keys, values) = (row.as_object_mut().expect("an object"), amplitudes(depth));
        row_keys.extend(values.as_object().cloned().unwrap_or_default());
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
