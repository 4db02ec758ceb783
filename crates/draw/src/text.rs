//! Text in the embedded typeface: the places of its glyphs, its width and its pixels.
//!
//! Combining marks, as the bar of p̄, are centred over the letter before them.

use super::typeface::{Glyph, Segment, advance, bounds, glyph, kerning, outline};
use ab_glyph_rasterizer::{Point, Rasterizer, point};
use percoat_common::plain;

/// Height of capital letters over the size.
pub const CAPITALS: f64 = 0.73;

/// A glyph and the distance of its origin from the beginning of the line, in units of the size.
#[derive(Debug, Clone, Copy)]
pub struct Placed {
    pub(crate) glyph: Glyph,
    pub(crate) x: f64,
}

/// The glyphs of a text in a line, and its width, in units of the size.
pub fn placed(text: &str) -> (Vec<Placed>, f64) {
    let middle = |glyph: Glyph| bounds(glyph).map_or(0.0, |[from, to]| 0.5 * (from[0] + to[0]));
    let (mut glyphs, mut end, mut before): (Vec<Placed>, f64, Option<Placed>) = (Vec::new(), 0.0, None);
    for letter in text.chars() {
        let glyph = glyph(letter);
        let combining = ('\u{300}'..='\u{36f}').contains(&letter);
        match before {
            Some(base) if combining => {
                glyphs.push(Placed { glyph, x: base.x + middle(base.glyph) - middle(glyph) });
            }
            _ => {
                let here = Placed { glyph, x: end + before.map_or(0.0, |base| kerning(base.glyph, glyph)) };
                end = here.x + advance(glyph);
                before = Some(here);
                glyphs.push(here);
            }
        }
    }
    (glyphs, end)
}

/// Width of a line of text of the given size, in the unit of the size.
pub fn width(text: &str, size: f64) -> f64 {
    size * placed(text).1
}

/// The text, or its beginning and its end with "…" between where it is wider than `most`.
pub fn fitted(text: &str, size: f64, most: f64) -> String {
    let letters: Vec<char> = text.chars().collect();
    let ends = |kept: usize| -> String {
        let [first, last] = [&letters[..kept.div_ceil(2)], &letters[letters.len() - kept / 2..]];
        first.iter().chain(&['…']).chain(last).collect()
    };
    if width(text, size) <= most {
        return text.to_owned();
    }
    (0..letters.len()).rev().map(ends).find(|cut| width(cut, size) <= most).unwrap_or_else(|| ends(0))
}

/// The text in lines not wider than `most`, broken at spaces but not at no-break spaces.
pub fn wrapped(text: &str, size: f64, most: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in plain::line(text).split(' ').filter(|word| !word.is_empty()) {
        match lines.last_mut() {
            Some(line) if width(&format!("{line} {word}"), size) <= most => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// Calls `put` with place and coverage (0 to 1) of every pixel of a line of text that starts at `origin` on its
/// baseline, x to the right and y down; `size` in pixels.
pub fn draw(text: &str, size: f64, [x, y]: [f64; 2], mut put: impl FnMut(i32, i32, f32)) {
    for Placed { glyph, x: offset } in placed(text).0 {
        let Some([from, to]) = bounds(glyph) else { continue };
        let x = x + size * offset;
        let [left, top] = [x + size * from[0], y - size * to[1]].map(f64::floor);
        let [right, bottom] = [x + size * to[0], y - size * from[1]].map(f64::ceil);
        let mut pixels = Rasterizer::new((right - left) as usize, (bottom - top) as usize);
        fill(&mut pixels, &outline(glyph), |[u, v]| point((x - left + size * u) as f32, (y - top - size * v) as f32));
        pixels.for_each_pixel_2d(|i, j, coverage| put(left as i32 + i as i32, top as i32 + j as i32, coverage));
    }
}

/// Covers the pixels within an outline, whose points stand `at` theirs.
fn fill(pixels: &mut Rasterizer, outline: &[Segment], at: impl Fn([f64; 2]) -> Point) {
    let mut end = point(0.0, 0.0);
    for segment in outline {
        let (Segment::Move(to) | Segment::Line(to) | Segment::Parabola(_, to)) = *segment;
        let to = at(to);
        match *segment {
            Segment::Move(_) => {}
            Segment::Line(_) => pixels.draw_line(end, to),
            Segment::Parabola(aside, _) => pixels.draw_quad(end, at(aside), to),
        }
        end = to;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_is_cut_in_its_middle_where_it_is_too_wide() {
        let whole = "delamination of hydrogenated carbon/steel, above";
        assert_eq!(fitted(whole, 7.0, 1000.0), whole);
        for most in [150.0, 60.0, 20.0] {
            let cut = fitted(whole, 7.0, most);
            let (first, last) = cut.split_once('…').unwrap();
            assert!(width(&cut, 7.0) <= most && most - width(&cut, 7.0) < 10.0, "{cut}");
            assert!(whole.starts_with(first) && whole.ends_with(last), "{cut}");
        }
        assert_eq!(fitted(whole, 7.0, 0.0), "…");
    }

    #[test]
    fn a_bar_over_a_letter_takes_no_width_and_stands_over_it() {
        assert!((width("p̄", 10.0) - width("p", 10.0)).abs() < 1e-12);
        let ink = |text: &str| {
            let (mut least, mut most, mut top) = (i32::MAX, i32::MIN, i32::MAX);
            draw(text, 100.0, [0.0, 0.0], |x, y, coverage| {
                if coverage > 0.5 {
                    (least, most, top) = (least.min(x), most.max(x), top.min(y));
                }
            });
            (least, most, top)
        };
        let (bare, barred) = (ink("p"), ink("p̄"));
        assert!(barred.0 >= bare.0 - 2 && barred.1 <= bare.1 + 2 && barred.2 < bare.2 - 3, "{bare:?} {barred:?}");
    }

    #[test]
    fn long_text_is_broken_at_spaces_into_lines_that_fit() {
        let lines = wrapped("relatively hard coating with three levels in contact", 7.0, 80.0);
        assert!(lines.len() > 2 && lines.iter().all(|line| width(line, 7.0) <= 80.0));
        assert_eq!(lines.join(" "), "relatively hard coating with three levels in contact");
    }
}
