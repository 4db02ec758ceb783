//! A sheet as an SVG file: lines as lines, letters as outlines.
//!
//! Every letter is defined once in the file and used from there, so that browsers, drawing programs and converters for LaTeX show
//! the same picture, whatever typefaces are installed. The words lie over the letters as transparent text, which can be searched and
//! copied. Fields are images within the file. The unit of the file is the point.

use super::canvas::{Anchor, Canvas, Dash, Mark, Stroke};
use super::colour::Colour;
use super::letters::{Letter, Piece, letters, outline};
use super::typeface::{EM, Glyph};
use super::{raster, text};
use std::collections::BTreeSet;

/// The SVG file of a sheet, with its images compressed so.
pub fn svg(canvas: &Canvas, level: u8) -> String {
    let [width, height] = canvas.size.map(hundredths);
    let [wide, high] = canvas.size.map(|length| hundredths(length * 25.4 / 72.0));
    let marks: String = canvas.marks.iter().map(|mark| element(mark, level)).collect();
    let texts =
        canvas.marks.iter().filter_map(|mark| if let Mark::Text { text, .. } = mark { Some(text) } else { None });
    let used: BTreeSet<Glyph> = texts.flat_map(|text| letters(text)).map(|letter| letter.glyph).collect();
    let outlines: String = used.into_iter().map(outlined).collect();
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{wide}mm\" height=\"{high}mm\" \
         viewBox=\"0 0 {width} {height}\" stroke-linejoin=\"round\">\n<defs>\n{outlines}</defs>\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#FFFFFF\"/>\n{marks}</svg>\n"
    )
}

/// Definition of a letter's outline, y down, named by the index of the glyph, which is the same in all files.
fn outlined(glyph: Glyph) -> String {
    let units = |[x, y]: [f64; 2]| format!("{:.0},{:.0}", EM * x, 0.0 - EM * y);
    let piece = |piece: Piece| match piece {
        Piece::Move(to) => format!("M{}", units(to)),
        Piece::Line(to) => format!("L{}", units(to)),
        Piece::Curve(places) => format!("C{}", places.map(units).join(" ")),
    };
    let path: String = outline(glyph).into_iter().map(piece).collect();
    format!("<path id=\"g{}\" d=\"{path}Z\"/>\n", glyph.0)
}

/// A mark as an element of the file.
fn element(mark: &Mark, level: u8) -> String {
    match mark {
        Mark::Line(Stroke { points, width, dash, colour }) => {
            let dashes = dash.lengths().map_or(String::new(), |lengths| {
                let [on, off] = lengths.map(|length| hundredths(length * width));
                format!(" stroke-dasharray=\"{on} {off}\"")
            });
            let cap = if *dash == Dash::Dotted { " stroke-linecap=\"round\"" } else { "" };
            let (path, width, colour) = (path(points), hundredths(*width), hex(*colour));
            format!("<path d=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\"{dashes}{cap}/>\n")
        }
        Mark::Area { corners, colour } => format!("<path d=\"{}\" fill=\"{}\"/>\n", path(corners), hex(*colour)),
        Mark::Disc { centre, radius, colour } => {
            let ([x, y], radius) = (centre.map(hundredths), hundredths(*radius));
            format!("<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\" fill=\"{}\"/>\n", hex(*colour))
        }
        Mark::Text { text, at, anchor, size, upward, colour } => {
            let length = text::width(text, *size);
            let before = match anchor {
                Anchor::Left => 0.0,
                Anchor::Centre => 0.5 * length,
                Anchor::Right => length,
            };
            let rotation = if *upward { " rotate(-90)" } else { "" };
            let used = |Letter { glyph, x }: Letter| format!("<use href=\"#g{}\" x=\"{:.0}\"/>", glyph.0, EM * x);
            let used: String = letters(text).into_iter().map(used).collect();
            let ([x, y], colour, words) = (at.map(hundredths), hex(*colour), escaped(text));
            let (scale, start) = (format!("{:.5}", size / EM), hundredths(-before));
            let (length, size) = (hundredths(length), hundredths(*size));
            format!(
                "<g transform=\"translate({x} {y}){rotation} translate({start})\" fill=\"{colour}\">\
                 <g transform=\"scale({scale})\">{used}</g>\
                 <text font-size=\"{size}\" font-family=\"sans-serif\" textLength=\"{length}\" fill-opacity=\"0\">\
                 {words}</text></g>\n"
            )
        }
        Mark::Image { corner, size, pixels, colours } => {
            let ([x, y], [width, height]) = (corner.map(hundredths), size.map(hundredths));
            let file = base64(&raster::encode(*pixels, colours, level));
            format!(
                "<image x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" preserveAspectRatio=\"none\" \
                 href=\"data:image/png;base64,{file}\"/>\n"
            )
        }
    }
}

/// A length rounded to 0.01 points, finer than any printer; without the sign of −0.
fn hundredths(x: f64) -> f64 {
    (100.0 * x).round() / 100.0 + 0.0
}

fn hex(Colour([r, g, b]): Colour) -> String {
    format!("#{r:02X}{g:02X}{b:02X}")
}

/// Path through points, closed if it ends where it begins.
fn path(points: &[[f64; 2]]) -> String {
    let places: Vec<String> =
        points.iter().map(|place| place.map(hundredths)).map(|[x, y]| format!("{x},{y}")).collect();
    let end = if points.first() == points.last() { "Z" } else { "" };
    format!("M{}{end}", places.join(" "))
}

/// Text escaped for use between tags and within quotes.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// Bytes in base64 (RFC 4648).
pub fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(4 * bytes.len().div_ceil(3));
    for group in bytes.chunks(3) {
        let bits = group.iter().enumerate().fold(0, |bits, (k, &byte)| bits | u32::from(byte) << (16 - 8 * k));
        for k in 0..4 {
            let letter = LETTERS[(bits >> (18 - 6 * k) & 63) as usize];
            text.push(if k <= group.len() { char::from(letter) } else { '=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_agrees_with_the_vectors_of_its_standard() {
        for (bytes, expected) in [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foobar", "Zm9vYmFy")] {
            assert_eq!(base64(bytes.as_bytes()), expected);
        }
    }

    #[test]
    fn every_letter_stands_once_in_the_file_and_every_use_finds_it() {
        let mut canvas = Canvas::new([50.0, 20.0]);
        canvas.text("aba p̄", [1.0, 10.0], Anchor::Left, 7.0, Colour::BLACK);
        canvas.upward("ab", [1.0, 10.0], 7.0, Colour::BLACK);
        let file = svg(&canvas, raster::OF_FILE);
        let all = |mark: &str| {
            file.match_indices(mark)
                .map(|(at, _)| {
                    let rest = &file[at + mark.len()..];
                    rest[..rest.find('"').unwrap()].to_owned()
                })
                .collect::<Vec<String>>()
        };
        let (defined, used) = (all("id=\"g"), all("href=\"#g"));
        assert_eq!((defined.len(), used.len()), (4, 7), "{file}");
        assert!(used.iter().all(|glyph| defined.contains(glyph)));
    }

    #[test]
    fn signs_of_the_file_are_escaped_within_text() {
        let mut canvas = Canvas::new([50.0, 20.0]);
        canvas.text("a < b & \"c\" > d", [-0.001, 10.126], Anchor::Left, 7.0, Colour::BLACK);
        let file = svg(&canvas, raster::OF_FILE);
        assert!(file.contains(">a &lt; b &amp; &quot;c&quot; &gt; d</text>"), "{file}");
        assert!(file.contains("translate(0 10.13)"), "{file}");
    }
}
