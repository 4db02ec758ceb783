//! The power spectrum of a topography, averaged over all directions.

use percoat_case::units::{Unit, Units};
use percoat_core::counterbody::Topography;
use percoat_core::counterbody::roughness::{SelfAffine, Spectrum, Statistics};
use percoat_draw::axis::Axis;
use percoat_draw::canvas::Canvas;
use percoat_draw::chart::{Chart, plots};
use percoat_draw::curve::{Curve, Ink, Style};
use percoat_draw::number::short;
use std::f64::consts::TAU;

/// The picture; `None` for a flat surface. `random`: the prescribed parameters of a generated surface.
pub fn spectrum(title: &str, topography: &Topography, units: &Units, random: Option<&SelfAffine>) -> Option<Canvas> {
    let heights = topography.own_heights();
    let spectrum = Spectrum::of(topography.cell(), heights.view()).ok()?;
    let rings: Vec<[f64; 2]> = spectrum.radial().iter().map(|ring| [ring.wavenumber, ring.density]).collect();
    let most = rings.iter().map(|[_, density]| *density).fold(0.0, f64::max);
    // Rounding errors of vanishing waves are left out.
    let rings: Vec<[f64; 2]> = rings.into_iter().filter(|[_, density]| *density > 1e-20 * most).collect();
    let least = rings.iter().map(|[_, density]| *density).reduce(f64::min)?;
    let curve = |label: &str, points, style, colour: usize| {
        let (label, colour) = (label.to_owned(), Ink::from(colour));
        Curve { label, points, errors: Vec::new(), style, colour }
    };
    let (mut curves, mut marks) = (Vec::new(), Vec::new());
    if let Some((surface, density)) =
        random.and_then(|surface| Some((surface, surface.density(topography.cell()).ok()?)))
    {
        let ends = [surface.longest, surface.shortest].map(|length| TAU / length);
        let at = |k: u32| ends[0] * (ends[1] / ends[0]).powf(f64::from(k) / 200.0);
        let prescribed = (0..=200).map(|k| [at(k), density(at(k))]).collect();
        curves.push(curve("prescribed", prescribed, Style::Dashed, 2));
        let words = [("longest", surface.longest), ("roll-off", surface.rolloff), ("shortest", surface.shortest)];
        marks.extend(words.map(|(word, length)| (TAU / length, word.to_owned())));
    }
    curves.push(curve("surface on the grid", rings, Style::Markers, 1));
    let chart = Chart {
        title: String::new(),
        x: Axis { marks, ..Axis::log(in_lengths("wavenumber q", units, |unit| format!("1/{unit}"))) },
        y: Axis::log(in_lengths("spectral density C, ∫\u{a0}C\u{a0}d²q\u{a0}=\u{a0}⟨h²⟩", units, |unit| {
            format!("{unit}⁴")
        }))
        .from_to(0.3 * least, 3.0 * most),
        curves,
    };
    let statistics = Statistics::of(heights.view());
    let [n1, n2] = topography.points();
    let caption = format!(
        "{}{}, rms slope {}; {n1}\u{a0}×\u{a0}{n2} samples. C averaged over all directions; ∫\u{a0}C\u{a0}d²q is the mean \
         square ⟨h²⟩ of the heights; SurfaceTopography's C is 4π² times this one.{}",
        if title.is_empty() { String::new() } else { format!("{title}. ") },
        units.length().with_unit(statistics.rms_height, |x| format!("Rms height {}", short(x))),
        short(spectrum.rms_slope()),
        if random.is_some() { " Dotted: the longest and the shortest wave, and the roll-off." } else { "" }
    );
    Some(plots(&caption, &[chart]))
}

/// A quantity in a power of the unit of length, such as "1/µm" or "µm⁴"; `of` writes the unit.
fn in_lengths(words: &str, units: &Units, of: impl Fn(&str) -> String) -> String {
    let unit = match units.length() {
        Unit::Relative(symbol) => symbol.clone(),
        length => length.name().unwrap_or_else(|| "unit\u{a0}of\u{a0}length".to_owned()),
    };
    format!("{words}\u{a0}({})", of(&unit))
}
