//! `percoat check`: cell, grid, materials, memory and loads of first touch of a case, without a solution.

use super::ending::{Ending, Failure};
use super::input::{default_folder, read_case};
use super::roughness;
use super::terminal::{self, tell};
use percoat_app::output::Check;
use percoat_case::case::feasibility::Allowed;
use percoat_case::case::resources::Job;
use percoat_common::machine::Capacity;
use percoat_common::plain;
use std::io::Write;
use std::path::Path;

pub fn run(path: &Path, output: Option<&Path>, set: &[String]) -> Result<Ending, Failure> {
    let (case, name) = read_case(Some(path), set)?;
    let job = Job::Solve { pictures: true, fields: true };
    let room = Capacity::on_this_machine(&default_folder(&name).unwrap_or_else(|_| "out".into()));
    Allowed::within(&case, room, job).map_err(Failure::Refused)?;
    let check = Check::of(&case, &name, room).map_err(Failure::refused)?;
    let mut out = terminal::out();
    write!(out, "{check}")?;
    if let Some(folder) = output {
        roughness::write(&case, folder)?;
        let folder = plain::path(folder);
        writeln!(
            out,
            "power spectrum C(q), with h_rms² = ∫ C d²q, written to {folder} (4π²C is what SurfaceTopography has)"
        )?;
    }
    check.warnings.iter().for_each(|doubt| tell!("warning: {doubt}"));
    Ok(Ending::Done)
}
