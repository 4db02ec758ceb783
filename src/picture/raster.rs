//! A sheet as a PNG file: drawn three times as large, then averaged, so that every edge is smooth.

use super::canvas::{Anchor, Canvas, Mark, PIXELS};
use super::colour::Colour;
use super::text;
use plotters::backend::{BitMapBackend, DrawingBackend};
use plotters::style::{Color, RGBColor};
use rayon::prelude::*;

/// Dots along a pixel's side.
const DOTS: usize = 3;

/// The PNG file of a sheet at 300 dots per inch.
pub fn png(canvas: &Canvas) -> Vec<u8> {
    let [width, height] = canvas.size.map(|length| (length * PIXELS).round() as usize);
    let mut dots = vec![255; 3 * width * height * DOTS * DOTS];
    // Images stand below all other marks.
    canvas.marks.iter().for_each(|mark| lay(&mut dots, [width * DOTS, height * DOTS], mark));
    let mut backend = BitMapBackend::with_buffer(&mut dots, ((width * DOTS) as u32, (height * DOTS) as u32));
    for mark in &canvas.marks {
        // Drawing into memory cannot fail; what stands outside the sheet is left out.
        let _ = put(&mut backend, mark);
    }
    drop(backend);
    encode([width, height], &averaged(&dots, [width, height]))
}

/// Tangent of the least angle at which a line needs a round joint.
const SHARP: f64 = 0.2;

/// Dots per point.
const SCALE: f64 = PIXELS * DOTS as f64;

fn dot([x, y]: [f64; 2]) -> (i32, i32) {
    ((x * SCALE).round() as i32, (y * SCALE).round() as i32)
}

fn rgb(Colour([r, g, b]): Colour) -> RGBColor {
    RGBColor(r, g, b)
}

/// Draws a mark; `None` when the library refuses it.
fn put(backend: &mut impl DrawingBackend, mark: &Mark) -> Option<()> {
    match mark {
        Mark::Line { points, width, colour } => {
            let half = (0.5 * width * SCALE).max(1.0);
            let style = rgb(*colour).filled();
            for pair in points.windows(2) {
                let [[x0, y0], [x1, y1]] = [pair[0], pair[1]].map(|p| p.map(|x| x * SCALE));
                let length = (x1 - x0).hypot(y1 - y0);
                if length > 0.0 {
                    let [nx, ny] = [(y0 - y1) * half / length, (x1 - x0) * half / length];
                    let corners = [[x0 + nx, y0 + ny], [x1 + nx, y1 + ny], [x1 - nx, y1 - ny], [x0 - nx, y0 - ny]];
                    backend.fill_polygon(corners.map(|[x, y]| (x.round() as i32, y.round() as i32)), &style).ok()?;
                }
            }
            // Round joints where the line turns; elsewhere its pieces meet without a gap.
            for corner in points.windows(3) {
                let [before, after] = [0, 1].map(|k| [0, 1].map(|c| corner[k + 1][c] - corner[k][c]));
                let along = before[0] * after[0] + before[1] * after[1];
                let aside = before[0] * after[1] - before[1] * after[0];
                if aside.abs() > SHARP * along {
                    backend.draw_circle(dot(corner[1]), half.round() as u32, &style, true).ok()?;
                }
            }
        }
        Mark::Area { corners, colour } => {
            backend.fill_polygon(corners.iter().map(|&corner| dot(corner)), &rgb(*colour).filled()).ok()?;
        }
        Mark::Disc { centre, radius, colour } => {
            backend.draw_circle(dot(*centre), (radius * SCALE).round() as u32, &rgb(*colour).filled(), true).ok()?;
        }
        Mark::Text { text, at, anchor, size, upward, colour } => {
            let before = text::width(text, *size)
                * match anchor {
                    Anchor::Left => 0.0,
                    Anchor::Centre => 0.5,
                    Anchor::Right => 1.0,
                };
            let (x, y) = dot(*at);
            let colour = rgb(*colour);
            let mut result = Some(());
            text::draw(text, size * SCALE, [-before * SCALE, 0.0], |i, j, coverage| {
                let place = if *upward { (x + j, y - i) } else { (x + i, y + j) };
                if result.is_some() && coverage > 0.0 {
                    let style = colour.mix(f64::from(coverage.min(1.0)));
                    result = backend.draw_pixel(place, style.to_backend_color()).ok();
                }
            });
            result?;
        }
        Mark::Image { .. } => {}
    }
    Some(())
}

/// Lays an image on the dots; one that reaches beyond the sheet is cut.
fn lay(dots: &mut [u8], [across, down]: [usize; 2], mark: &Mark) {
    let Mark::Image { corner, pixels: [columns, rows], colours, .. } = mark else { return };
    let [x, y] = [dot(*corner).0, dot(*corner).1].map(|c| usize::try_from(c).unwrap_or(0));
    let (wide, high) = ((columns * DOTS).min(across.saturating_sub(x)), (rows * DOTS).min(down.saturating_sub(y)));
    dots.par_chunks_mut(3 * across).skip(y).take(high).enumerate().for_each(|(row, line)| {
        let own = &colours[3 * columns * (row / DOTS)..][..3 * columns];
        let line = &mut line[3 * x..3 * (x + wide)];
        for (dots, pixel) in line.chunks_mut(3 * DOTS).zip(own.chunks_exact(3)) {
            dots.chunks_mut(3).for_each(|dot| dot.copy_from_slice(&pixel[..dot.len()]));
        }
    });
}

/// The mean of the dots of each pixel.
fn averaged(dots: &[u8], [width, height]: [usize; 2]) -> Vec<u8> {
    let line = 3 * width * DOTS;
    let mut pixels = vec![0; 3 * width * height];
    pixels.par_chunks_mut(3 * width).zip(dots.par_chunks(line * DOTS)).for_each(|(row, dots)| {
        let mut sums = vec![0u16; line];
        for dots in dots.chunks_exact(line) {
            sums.iter_mut().zip(dots).for_each(|(sum, &dot)| *sum += u16::from(dot));
        }
        for (pixel, sums) in row.chunks_exact_mut(3).zip(sums.chunks_exact(3 * DOTS)) {
            for (c, value) in pixel.iter_mut().enumerate() {
                let sum: u16 = sums[c..].iter().step_by(3).sum();
                *value = (sum / (DOTS * DOTS) as u16) as u8;
            }
        }
    });
    pixels
}

/// A PNG file of the pixels that knows its size on paper.
pub fn encode([width, height]: [usize; 2], pixels: &[u8]) -> Vec<u8> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, width as u32, height as u32);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Balanced);
    let per_metre = (PIXELS * 72.0 / 0.0254).round() as u32;
    encoder.set_pixel_dims(Some(png::PixelDimensions { xppu: per_metre, yppu: per_metre, unit: png::Unit::Meter }));
    let written = encoder.write_header().and_then(|mut writer| {
        writer.write_image_data(pixels)?;
        writer.finish()
    });
    debug_assert!(written.is_ok(), "writing into memory cannot fail");
    file
}
