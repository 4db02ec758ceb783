//! The roughness of a topography, and how the heights of its file were prepared.

use crate::output::described;
use crate::output::number::number;
use percoat_case::case::{Case, ORIENTATION, RandomSection, Stage, SurfaceSection, Treated};
use percoat_case::units::Units;
use percoat_core::counterbody::roughness::{Spectrum, Statistics};
use percoat_core::lattice::LatticeError;
use serde_json::{Value, json};
use std::fmt;

/// Roughness of a topography.
#[derive(Debug, Clone)]
pub struct Roughness {
    /// Samples along a₁ and a₂.
    pub points: [usize; 2],
    /// Statistics of its heights.
    pub statistics: Statistics,
    /// Rms slope √⟨|∇h|²⟩.
    pub rms_slope: f64,
    /// Spacing of samples along a₁ and a₂, lengths.
    pub spacing: [f64; 2],
    /// Whether its heights are those of a file.
    pub from_file: bool,
    /// Whether a window tapers its border.
    pub has_window: bool,
    /// Stages by which the heights of a file were prepared, in this order; empty without any.
    pub stages: Vec<Stage>,
}

impl Roughness {
    /// The roughness of the topography of a case; `None` of other counterbodies.
    pub(super) fn of(case: &Case) -> Result<Option<Self>, LatticeError> {
        let Some(topography) = case.problem().topography() else { return Ok(None) };
        let heights = topography.own_heights();
        let spectrum = Spectrum::of(topography.cell(), heights.view())?;
        let (sides, points) = (topography.cell().vectors().map(|[x, y]| x.hypot(y)), topography.points());
        Ok(Some(Self {
            points,
            statistics: Statistics::of(heights.view()),
            rms_slope: spectrum.rms_slope(),
            spacing: [0, 1].map(|axis| sides[axis] / points[axis] as f64),
            has_window: topography.run_out().is_some(),
            stages: case.surface.as_ref().map(|surface| surface.stages.clone()).unwrap_or_default(),
            from_file: case.surface.as_ref().and_then(SurfaceSection::random).map(RandomSection::surface).is_none(),
        }))
    }

    /// The roughness as a JSON object, under names.
    pub(super) fn json(&self) -> Value {
        let Statistics { rms_height, range, skewness, kurtosis, .. } = self.statistics;
        json!({
            "points": self.points, "rms_height": rms_height, "rms_slope": self.rms_slope, "range": range,
            "skewness": skewness, "kurtosis": kurtosis, "stages": self.stages,
        })
    }

    /// Writes the preparation of the heights and the statistics, a line each, with their units.
    pub(super) fn write(&self, f: &mut fmt::Formatter<'_>, units: &Units) -> fmt::Result {
        let ([n1, n2], slope) = (self.points, number(self.rms_slope));
        let [d1, d2] = self.spacing.map(|spacing| described::length(units, spacing));
        let Statistics { rms_height, range, skewness, kurtosis, .. } = self.statistics;
        let [rms_height, range] = [rms_height, range].map(|height| described::length(units, height));
        write_stages(f, &self.stages, units)?;
        writeln!(f, "surface on {n1} × {n2} samples, {d1} apart along a₁ and {d2} along a₂:")?;
        writeln!(f, "  rms height {rms_height}, rms slope {slope}, range {range}")?;
        writeln!(f, "  skewness {skewness:.3}, kurtosis {kurtosis:.3} (a Gaussian has 0 and 3)")?;
        if self.has_window {
            writeln!(f, "  its window's run-out at the border left out")?;
        }
        if self.from_file { writeln!(f, "{ORIENTATION}") } else { Ok(()) }
    }
}

/// Writes what was done to the heights of a file, with their rms values before and after.
fn write_stages(f: &mut fmt::Formatter<'_>, stages: &[Stage], units: &Units) -> fmt::Result {
    if !stages.is_empty() {
        writeln!(f, "heights of the file, rms height and rms slope of neighbours:")?;
    }
    for Stage { treated, rms } in stages {
        let what = match *treated {
            Treated::AsRead => "as read".to_owned(),
            Treated::WithoutForm { form, radius: None } => format!("without its {}", form.name()),
            Treated::WithoutForm { form, radius: Some(radius) } => {
                format!("without its {} of radius {}", form.name(), described::length(units, radius))
            }
            Treated::Filled { share } => format!("{} % of the places filled", number(100.0 * share)),
            Treated::Smoothed { cutoff, is_periodic } => {
                let beyond = if is_periodic { "continued periodically" } else { "border: only samples that exist" };
                format!("waves below {} weakened ({beyond})", described::length(units, cutoff))
            }
        };
        writeln!(f, "  {what}: {}, {}", described::length(units, rms.height), number(rms.slope))?;
    }
    Ok(())
}
