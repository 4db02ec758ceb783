//! `percoat kernel`: the response of the layered half-space, one JSON line for each wavenumber.

use super::ending::{Ending, Failure};
use super::input::read_case;
use super::terminal;
use percoat_app::output::{self, Traction};
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
    let (half_space, transfer) = (case.half_space(), case.half_space().response());
    if let Some(z) = depths.iter().find(|&&z| half_space.depths(z).is_empty()) {
        let base = half_space.base_depth();
        return Err(Failure::Refused(format!(
            "--depth {z} is below the rigid base at {base}: stresses are in the layers alone"
        )));
    }
    let mut out = terminal::out();
    for &wavenumber in wavenumbers {
        writeln!(out, "{}", output::kernel(transfer, half_space, wavenumber, depths, traction))?;
    }
    Ok(Ending::Done)
}
