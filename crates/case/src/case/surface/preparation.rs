//! Heights of a file as they are pressed: form, holes, short waves and border, in this order.
//!
//! The form comes first, by what is measured alone, so that what is filled has no part in it, and so that holes in a ball are filled along
//! the ball. The filter of short waves needs a height everywhere, so it follows; before the window, which makes
//! heights that were not measured. Without a window, in a periodic cell, the surface is declared to be one period, and
//! the filter goes on beyond its border; otherwise it counts what is there.

use super::super::error::Refusal;
use super::super::reader::TableAt;
use super::super::value::ValueAt;
use super::file::Treatment;
use super::stage::{Stage, Treated};
use ndarray::Array2;
use percoat_core::counterbody::roughness::{
    FILLING_MEMORY, MeasuredRms, RunOut, SMOOTHING_MEMORY, Spectrum, SurfaceForm, filled, short_wave_noise, smoothed,
    tapered, without_form,
};
use percoat_core::lattice::{Cell, Surroundings};
use percoat_core::notation::number;
use percoat_surfaces::heights::fits;
use std::borrow::Cow;
use std::f64::consts::TAU;

/// Largest part of places without a measurement: beyond it most heights, and the rms values, would be those of the filling.
const MOST_HOLES: f64 = 0.5;

/// Largest part of the rms height that a sphere or cylinder leaves of a surface that it describes.
const MOST_REST: f64 = 0.5;

/// Heights as they are pressed.
#[derive(Debug)]
pub(super) struct Prepared {
    /// Lengths, axis 0 along a₁, axis 1 along a₂.
    pub heights: Array2<f64>,
    /// Taper of the border, if any.
    pub run_out: Option<RunOut>,
    /// Stages of the preparation, in order; empty where nothing was done.
    pub stages: Vec<Stage>,
    /// Spectrum of the heights, where it was computed.
    pub spectrum: Option<Spectrum>,
    /// Warnings, a sentence each.
    pub doubts: Vec<String>,
}

/// Prepares the heights of the file `written` in the `section`; NaN marks a hole.
pub(super) fn prepared(
    section: &TableAt<'_>,
    written: &ValueAt<'_>,
    cell: Cell,
    heights: Array2<f64>,
    treatment: &Treatment,
) -> Result<Prepared, Refusal> {
    let Treatment { form, cutoff, window, .. } = *treatment;
    let at = |key: &str| section.optional(key).map_or(written.node.span, |value| value.node.span);
    let room = |needed: u64| {
        fits(needed).map_err(|fault| {
            Refusal::new(written.node.span, format!("`{}`: it {}", written.path, fault.what), fault.label())
        })
    };
    room(32 * heights.len() as u64)?;
    let mut stages = Vec::new();
    let mut add = |treated: Treated, heights: &Array2<f64>| {
        stages.push(Stage { treated, rms: MeasuredRms::of(cell, heights.view()) });
    };
    if form != SurfaceForm::None || cutoff.is_some() || heights.iter().any(|height| height.is_nan()) {
        add(Treated::AsRead, &heights);
    }
    let (mut heights, radius) = without_form(cell, heights, form)
        .map_err(|error| Refusal::new(at("form"), format!("`{}`: {error}", section.path("form")), "no such form"))?;
    if form != SurfaceForm::None {
        add(Treated::WithoutForm { form, radius }, &heights);
    }
    let mut doubts = Vec::new();
    let holes = holes(written, &heights)?;
    if holes > 0 {
        let share = holes as f64 / heights.len() as f64;
        room(FILLING_MEMORY[0] * heights.len() as u64 + FILLING_MEMORY[1] * holes as u64)?;
        (heights, _) = filled(cell, heights);
        add(Treated::Filled { share }, &heights);
        doubts.push(format!(
            "surface.heights: {holes} of {} places ({} %) have no measurement, and are filled smoothly from what surrounds them",
            heights.len(),
            number(100.0 * share)
        ));
    }
    if let Some(cutoff) = cutoff {
        let is_periodic = window.is_none() && cell.surroundings() == Surroundings::Periodic;
        heights = without_short_waves(section, cell, &heights, cutoff, is_periodic)?;
        add(Treated::Smoothed { cutoff, is_periodic }, &heights);
    }
    doubts.extend(rest(form, &stages));
    let (heights, run_out) = match window {
        Some(window) => {
            let (heights, run_out) = tapered(heights, window, form != SurfaceForm::None);
            (heights, Some(run_out))
        }
        None => (heights, None),
    };
    let spectrum = spectrum(cell, &heights, run_out.as_ref());
    doubts.extend(spectrum.as_ref().and_then(noise));
    Ok(Prepared { spectrum: spectrum.filter(|_| run_out.is_none()), heights, run_out, stages, doubts })
}

/// A warning where a sphere or cylinder leaves most of the heights.
fn rest(form: SurfaceForm, stages: &[Stage]) -> Option<String> {
    let [before, after, ..] = stages else { return None };
    let is_round = matches!(form, SurfaceForm::Sphere | SurfaceForm::Cylinder);
    let share = after.rms.height / before.rms.height;
    (is_round && share > MOST_REST).then(|| {
        format!(
            "surface.form: without its {} the surface has {:.0} % of its rms height left: it is no {0}, or hardly curved",
            form.name(),
            100.0 * share
        )
    })
}

/// Number of places without a measurement; refused where there are too many.
fn holes(written: &ValueAt<'_>, heights: &Array2<f64>) -> Result<usize, Refusal> {
    let holes = heights.iter().filter(|height| height.is_nan()).count();
    if holes as f64 <= MOST_HOLES * heights.len() as f64 {
        return Ok(holes);
    }
    let message = format!(
        "`{}`: {holes} of its {} places have no measurement; at most half of them can be filled, beyond it the surface would be \
         more of the filling than of the measurement",
        written.path,
        heights.len()
    );
    Err(Refusal::new(written.node.span, message, "too few heights").help("cut out a part that is measured better"))
}

/// Heights without waves shorter than the `cutoff`; refused where that is no wave of the surface.
fn without_short_waves(
    section: &TableAt<'_>,
    cell: Cell,
    heights: &Array2<f64>,
    cutoff: f64,
    is_periodic: bool,
) -> Result<Array2<f64>, Refusal> {
    let value = section.value("cutoff")?;
    let refuse = |what: String, label: &str| Refusal::new(value.node.span, format!("`{}`: {what}", value.path), label);
    let (n1, n2) = heights.dim();
    let [l1, l2] = cell.vectors().map(|[x, y]| x.hypot(y));
    let (least, most) = (2.0 * f64::max(l1 / n1 as f64, l2 / n2 as f64), cell.area() / l1.max(l2));
    if !(least..=most).contains(&cutoff) {
        let what = format!(
            "{cutoff} is no wavelength that can be told apart on the surface: from two samples, {}, to its shorter side, {}",
            number(least),
            number(most)
        );
        return Err(refuse(what, "no such wave").help("leave it out to keep all waves"));
    }
    fits(SMOOTHING_MEMORY[usize::from(!is_periodic)] * heights.len() as u64)
        .map_err(|fault| refuse(format!("the filter {}", fault.what), "too large"))?;
    smoothed(cell, heights.view(), cutoff, is_periodic).map_err(|error| refuse(error.to_string(), "no filter"))
}

/// Spectrum of heights without their run-out; `None` where memory does not hold it, which solving needs too.
fn spectrum(cell: Cell, heights: &Array2<f64>, run_out: Option<&RunOut>) -> Option<Spectrum> {
    fits(32 * heights.len() as u64).ok()?;
    let measured = run_out.map_or(Cow::Borrowed(heights), |run_out| Cow::Owned(run_out.undone(heights.clone())));
    Spectrum::of(cell, measured.view()).ok()
}

/// A warning where the shortest waves are noise.
fn noise(spectrum: &Spectrum) -> Option<String> {
    let found = short_wave_noise(spectrum)?;
    // Adding 0 takes the sign of a rounded zero away.
    let (from, exponent) = (TAU / found.from, (10.0 * found.exponent).round() / 10.0 + 0.0);
    Some(format!(
        "surface.heights: its shortest waves look like noise of the instrument: from the wavelength {} down to {} the power spectrum goes \
         as q^{:.1}, and that of rough surfaces at least as q^−2 downward; these waves have {:.0} % of the mean square slope, to \
         which contact areas and pressures answer; surface.cutoff = {} weakens them, the longest to a half, the shortest to 6 %",
        number(from),
        number(0.5 * from),
        exponent,
        100.0 * found.share,
        number(from)
    ))
}
