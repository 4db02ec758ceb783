//! The embedded typeface: glyphs of letters with their widths and outlines, in units of the size.
//!
//! It is DejaVu Sans (its licence stands beside it): Latin, Greek, Cyrillic, indices and signs, so that pictures look the same on
//! every machine.

use skrifa::GlyphId;
use skrifa::font::Font;
use skrifa::font::glyph::outline::{DrawMemory, DrawOptions, OutlineGlyph, PathElement, TransformSink};
use skrifa::raw::{TableProvider, tables::kern::SubtableKind, types::Matrix};
use std::sync::LazyLock;

static FONT: LazyLock<Font> =
    LazyLock::new(|| Font::new(include_bytes!("font/DejaVuSans.ttf").as_slice(), 0).expect(WHOLE));

const WHOLE: &str = "the embedded typeface is whole";

/// Units of the typeface per size: a power of two, so that nothing is rounded.
fn em() -> f32 {
    f32::from(FONT.units_per_em())
}

/// Glyph of a letter; an empty box where the typeface has none.
pub fn glyph(letter: char) -> GlyphId {
    FONT.charmap().map_unicode(letter).unwrap_or_default()
}

/// Distance from the origin of a glyph to that of the next one.
pub fn advance(glyph: GlyphId) -> f64 {
    f64::from(FONT.glyph_metrics().h_advance(glyph) / em())
}

/// What is added to the advance of a glyph before another: negative for pairs like AV.
pub fn kerning(glyph: GlyphId, next: GlyphId) -> f64 {
    let tables = FONT.tables().kern().into_iter().flat_map(|kern| kern.subtables());
    let mut pairs = tables.flatten().filter_map(|table| match table.kind() {
        Ok(SubtableKind::Format0(pairs)) => pairs.kerning(glyph, next),
        _ => None,
    });
    pairs.next().map_or(0.0, |units| f64::from(units) / f64::from(em()))
}

/// The least box around the outline of a glyph and its control points: left and lower, right and upper corner, y up. None for a space.
pub fn bounds(glyph: GlyphId) -> Option<[[f64; 2]; 2]> {
    let ink = drawn(glyph)?.extents().expect(WHOLE);
    let corner = |x: f32, y: f32| [x, y].map(|c| f64::from(c / em()));
    let [left, upper] = [ink.x_bearing, ink.y_bearing];
    (ink.width > 0.0).then(|| [corner(left, upper - ink.height), corner(left + ink.width, upper)])
}

/// Outline of a glyph, y up; empty for a space.
pub fn outline(glyph: GlyphId) -> Vec<PathElement> {
    let scale = em().recip();
    let mut path = TransformSink::new(Vec::new(), Matrix::from_elements([scale, 0.0, 0.0, scale, 0.0, 0.0]));
    if let Some(drawn) = drawn(glyph) {
        drawn.draw(&DrawOptions::new(), DrawMemory::Scratch, &mut path).expect(WHOLE);
    }
    path.into_inner()
}

fn drawn(glyph: GlyphId) -> Option<OutlineGlyph<'static>> {
    FONT.outline_glyphs().get(glyph)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_sign_of_the_pictures_has_a_glyph() {
        for letter in "p̄δσντχρθ₀₁₂₃₉ₘ⁰¹²³⁴⁵⁶⁷⁸⁹⁻₋−–×·√Åµ°∞≈≤".chars()
        {
            assert_ne!(glyph(letter), GlyphId::NOTDEF, "{letter} is missing");
        }
    }

    #[test]
    fn pairs_are_moved_together_as_the_typeface_says() {
        // From its table `kern`, in units of 1/2048: A before V.
        assert_eq!(kerning(glyph('A'), glyph('V')), -131.0 / 2048.0);
        assert_eq!(kerning(glyph('n'), glyph('n')), 0.0);
    }
}
