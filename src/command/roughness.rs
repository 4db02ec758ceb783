//! The power spectrum of a surface, which `percoat check -o` writes.

use super::ending::Failure;
use super::interruption;
use percoat_app::output::{Plan, RunFolder, Writer, write_file};
use percoat_app::picture::{self, Format};
use percoat_case::case::{Case, RandomSection, SurfaceSection};
use percoat_core::counterbody::roughness::{Radial, Spectrum};
use std::f64::consts::TAU;
use std::io::Write;
use std::path::Path;

/// Writes the spectrum of the surface of a case as `spectrum.png` and `spectrum.csv` into a folder.
pub fn write(case: &Case, folder: &Path) -> Result<(), Failure> {
    let Some(topography) = case.problem().topography() else {
        return Err(Failure::Refused("-o is for the power spectrum of a [surface], and this case has none".into()));
    };
    let spectrum = Spectrum::of(topography.cell(), topography.own_heights().view()).map_err(Failure::refused)?;
    let random = case.surface.as_ref().and_then(SurfaceSection::random).map(RandomSection::surface);
    let canvas = picture::spectrum(&case.title, topography, &case.units(), random.as_ref());
    let csv = ("spectrum.csv", table(&spectrum.radial()).into_bytes());
    let png = canvas.map(|canvas| ("spectrum.png", canvas.encoded(Format::Png)));
    let files: Vec<(&str, Vec<u8>)> = [csv].into_iter().chain(png).collect();
    let names = files.iter().map(|(name, _)| (*name).to_owned()).collect();
    let claim = RunFolder::claim(folder, Plan { names, ..Plan::new(Writer::Check) })?;
    for (name, content) in &files {
        write_file(&claim.staging().join(name), |writer| writer.write_all(content))?;
    }
    Ok(interruption::publish(claim, folder, false)?)
}

/// One row for each ring of wavevectors: mean wavenumber q, mean of C with h_rms² = ∫ C d²q, number of waves, and 4π²C, the
/// density of the convention h_rms² = ∫ 4π²C d²q/4π².
fn table(rings: &[Radial]) -> String {
    let row = |ring: &Radial| {
        format!("{:e},{:e},{},{:e}\n", ring.wavenumber, ring.density, ring.waves, TAU * TAU * ring.density)
    };
    "wavenumber,density,waves,density_times_4pi2\n".to_owned() + &rings.iter().map(row).collect::<String>()
}
