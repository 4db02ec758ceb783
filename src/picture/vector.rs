//! A sheet as an SVG file: its lines and texts stay lines and texts.
//!
//! Texts name the embedded typeface and others of the same widths, so that a viewer without them still shows every
//! word. Fields are images within the file.

use super::canvas::{Anchor, Canvas, Mark};
use super::colour::Colour;
use super::{raster, text};
use plotters::backend::{DrawingBackend, SVGBackend};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, FontFamily, FontStyle, FontTransform, IntoFont, RGBColor, TextStyle};

/// Units of the file per point: the library draws at whole numbers.
const SCALE: f64 = 20.0;

/// Half the height of small letters over the size: how far the library lifts text from its anchor.
const LIFT: f64 = 0.5 * 0.547;

/// The SVG file of a sheet.
pub fn svg(canvas: &Canvas) -> String {
    let [width, height] = canvas.size.map(|length| (length * SCALE).round() as u32);
    let mut drawn = String::new();
    let mut backend = SVGBackend::with_string(&mut drawn, (width, height));
    for mark in &canvas.marks {
        // Drawing into memory cannot fail.
        let _ = put(&mut backend, mark);
    }
    let _ = backend.present();
    drop(backend);
    // The library's first line knows no unit of length; images stand below all marks.
    let body = drawn.split_once('\n').map_or("", |(_, body)| body);
    let millimetres = canvas.size.map(|length| length * 25.4 / 72.0);
    let images: String = canvas.marks.iter().filter_map(image).collect();
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{:.2}mm\" height=\"{:.2}mm\" viewBox=\"0 0 {width} {height}\">\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#FFFFFF\"/>\n{images}{body}",
        millimetres[0], millimetres[1]
    )
}

fn unit([x, y]: [f64; 2]) -> (i32, i32) {
    ((x * SCALE).round() as i32, (y * SCALE).round() as i32)
}

fn rgb(Colour([r, g, b]): Colour) -> RGBColor {
    RGBColor(r, g, b)
}

/// Draws a mark; `None` when the library refuses it.
fn put(backend: &mut impl DrawingBackend, mark: &Mark) -> Option<()> {
    match mark {
        Mark::Line { points, width, colour } => {
            let style = rgb(*colour).stroke_width((width * SCALE).round().max(1.0) as u32);
            backend.draw_path(points.iter().map(|&point| unit(point)), &style).ok()
        }
        Mark::Area { corners, colour } => {
            backend.fill_polygon(corners.iter().map(|&corner| unit(corner)), &rgb(*colour).filled()).ok()
        }
        Mark::Disc { centre, radius, colour } => {
            backend.draw_circle(unit(*centre), (radius * SCALE).round() as u32, &rgb(*colour).filled(), true).ok()
        }
        Mark::Text { text: words, at: [x, y], anchor, size, upward, colour } => {
            let h_pos = match anchor {
                Anchor::Left => HPos::Left,
                Anchor::Centre => HPos::Center,
                Anchor::Right => HPos::Right,
            };
            let lift = LIFT * size;
            let (place, turn) = if *upward {
                ([x + lift, *y], FontTransform::Rotate270)
            } else {
                ([*x, y + lift], FontTransform::None)
            };
            // The library divides sizes by 1.24.
            let font = (FontFamily::Name(text::FAMILY), 1.24 * size * SCALE, FontStyle::Normal).into_font();
            let colour = rgb(*colour);
            let style = TextStyle::from(font.transform(turn)).color(&colour).pos(Pos::new(h_pos, VPos::Bottom));
            backend.draw_text(words, &style, unit(place)).ok()
        }
        Mark::Image { .. } => Some(()),
    }
}

/// An image as an element that holds its PNG file.
fn image(mark: &Mark) -> Option<String> {
    let Mark::Image { corner, size, pixels, colours } = mark else { return None };
    let ([x, y], [width, height]) = (corner.map(|c| c * SCALE), size.map(|c| c * SCALE));
    let file = base64(&raster::encode(*pixels, colours));
    Some(format!(
        "<image x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" preserveAspectRatio=\"none\" \
         href=\"data:image/png;base64,{file}\"/>\n"
    ))
}

/// Base64 of RFC 4648.
fn base64(bytes: &[u8]) -> String {
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
}
