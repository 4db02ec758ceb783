//! Names of the files that `percoat solve` may write, known before anything is solved.

use super::pictures::PictureOptions;
use percoat::case::Case;
use percoat::output::{Plan, Writer};

/// What a run of the case may write.
pub fn may_write(case: &Case, steps: usize, pictures: &PictureOptions) -> Plan {
    let mut names = ["case.toml", "contact.npz", "curve.csv", "summary.json"].map(str::to_owned).to_vec();
    let mut drawn = vec!["pressure", "contact", "profiles"];
    if case.surface.is_some() {
        names.push("histograms.csv".to_owned());
    }
    if let Some(stress) = &case.stress {
        names.push("stress.npz".to_owned());
        if stress.volume.is_some() {
            names.extend((1..=steps).map(|step| format!("stress.{step:04}.vts")));
        }
        if stress.section.is_some() {
            drawn.extend(["section", "lines"]);
        }
    }
    if steps > 1 {
        drawn.push("curve");
    }
    names.extend(pictures.files(&drawn));
    Plan { names, case: Some(case.to_toml()), ..Plan::new(Writer::Solve) }
}
