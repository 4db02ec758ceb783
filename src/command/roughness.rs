//! What `percoat check` says of a surface, and its power spectrum.

use super::ending::Failure;
use super::interruption;
use crate::case::{Case, ORIENTATION, RandomSection, SurfaceSection};
use crate::counterbody::roughness::{Radial, Spectrum, Statistics};
use crate::output::{Plan, RunFolder, Writer, number, write_text};
use crate::picture::{self, Format};
use std::io::Write;
use std::path::Path;

/// Says what the surface of a case is like; in `output`, its spectrum as `spectrum.png` and `spectrum.csv`.
pub fn check(out: &mut impl Write, case: &Case, output: Option<&Path>) -> Result<(), Failure> {
    let Some(topography) = case.counterbody().topography() else {
        return match output {
            Some(_) => {
                Err(Failure::Refused("-o is for the power spectrum of a [surface], and this case has none".into()))
            }
            None => Ok(()),
        };
    };
    let spectrum = Spectrum::of(topography.cell(), topography.heights()).map_err(Failure::refused)?;
    let statistics = Statistics::of(topography.heights());
    let Statistics { rms_height, range, skewness, kurtosis, .. } = statistics;
    let [n1, n2] = topography.points();
    writeln!(
        out,
        "surface on {n1} × {n2} samples: rms height {}, rms slope {}",
        number(rms_height),
        number(spectrum.rms_slope())
    )?;
    writeln!(
        out,
        "  range {}, skewness {skewness:.3}, kurtosis {kurtosis:.3} (a Gaussian has 0 and 3)",
        number(range)
    )?;
    let random = case.surface.as_ref().and_then(SurfaceSection::random).map(RandomSection::surface);
    if random.is_none() {
        writeln!(out, "{ORIENTATION}")?;
    }
    let Some(folder) = output else { return Ok(()) };
    let names = ["spectrum.png", "spectrum.csv"].map(str::to_owned).to_vec();
    let claim = RunFolder::claim(folder, Plan { names, ..Plan::new(Writer::Check) })?;
    write_text(&claim.staging().join("spectrum.csv"), &table(&spectrum.radial()))?;
    if let Some(canvas) = picture::spectrum(&case.title, topography, &case.units(), random.as_ref()) {
        canvas.write(&claim.staging(), "spectrum", Format::Png)?;
    }
    interruption::publish(claim, folder, false)?;
    writeln!(out, "power spectrum written to {}", folder.display())?;
    Ok(())
}

/// One row a ring of wavevectors.
fn table(rings: &[Radial]) -> String {
    let row = |ring: &Radial| format!("{:e},{:e},{}\n", ring.wavenumber, ring.density, ring.waves);
    "wavenumber,density,waves\n".to_owned() + &rings.iter().map(row).collect::<String>()
}
