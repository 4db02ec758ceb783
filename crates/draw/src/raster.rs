//! A sheet as a PNG file, with smooth edges.

use super::canvas::{Anchor, Canvas, Dash, Mark, PIXELS, Stroke};
use super::colour::Colour;
use super::text;
use png::{DeflateCompression, Filter};
use tiny_skia::{Color, FillRule, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap, Shader, StrokeDash, Transform};

/// Largest number of pixels of a side of a sheet; the rest is cut off.
const MOST_PIXELS: f64 = 20_000.0;
/// Level of compression of a file, 1 to 9.
pub const OF_FILE: u8 = 5;
/// Level of compression of what is shown at once.
pub const ON_SCREEN: u8 = 1;

/// The PNG file of a sheet at 300 dots per inch.
pub fn png(canvas: &Canvas) -> Vec<u8> {
    let [width, height] = canvas.size.map(|length| (length * PIXELS).round().clamp(1.0, MOST_PIXELS) as u32);
    let mut sheet = Pixmap::new(width, height).expect("a sheet of paper fits into memory");
    sheet.fill(Color::WHITE);
    for mark in &canvas.marks {
        // A mark without extent or place is not drawn.
        let _ = put(&mut sheet, mark);
    }
    let colours: Vec<u8> = sheet.pixels().iter().flat_map(|pixel| [pixel.red(), pixel.green(), pixel.blue()]).collect();
    encode([width, height].map(|count| count as usize), &colours, OF_FILE)
}

/// Draws a mark; `None` when there is nothing to draw.
fn put(sheet: &mut Pixmap, mark: &Mark) -> Option<()> {
    let scale = Transform::from_scale(PIXELS as f32, PIXELS as f32);
    match mark {
        Mark::Line(Stroke { points, width, dash, colour }) => {
            let dashes = dash.lengths().map(|lengths| lengths.map(|length| (length * width) as f32).to_vec());
            let stroke = tiny_skia::Stroke {
                width: *width as f32,
                line_cap: if *dash == Dash::Dotted { LineCap::Round } else { LineCap::Butt },
                line_join: LineJoin::Round,
                dash: dashes.and_then(|lengths| StrokeDash::new(lengths, 0.0)),
                ..tiny_skia::Stroke::default()
            };
            sheet.stroke_path(&path(points)?, &paint(*colour), &stroke, scale, None);
        }
        Mark::Area { corners, colour } => {
            sheet.fill_path(&path(corners)?, &paint(*colour), FillRule::Winding, scale, None);
        }
        Mark::Disc { centre: [x, y], radius, colour } => {
            let circle = PathBuilder::from_circle(*x as f32, *y as f32, *radius as f32)?;
            sheet.fill_path(&circle, &paint(*colour), FillRule::Winding, scale, None);
        }
        Mark::Text { text, at: [x, y], anchor, size, upward, colour } => {
            let before = text::width(text, *size)
                * match anchor {
                    Anchor::Left => 0.0,
                    Anchor::Centre => 0.5,
                    Anchor::Right => 1.0,
                };
            let [along, down] = if *upward { [-y, *x] } else { [*x, *y] };
            text::draw(text, size * PIXELS, [(along - before) * PIXELS, down * PIXELS], |i, j, coverage| {
                // A pixel ends one further than it begins; rotated, it begins there.
                let [i, j] = if *upward { [j, -1 - i] } else { [i, j] };
                blend(sheet, [i, j], coverage, *colour);
            });
        }
        Mark::Image { corner, pixels: [columns, _], colours, .. } => {
            let [x, y] = corner.map(|c| (c * PIXELS).round() as usize);
            let across = 4 * sheet.width() as usize;
            let lines = sheet.data_mut().chunks_exact_mut(across).skip(y);
            for (line, row) in lines.zip(colours.chunks_exact(3 * columns)) {
                for (pixel, colour) in line.chunks_exact_mut(4).skip(x).zip(row.chunks_exact(3)) {
                    pixel[..3].copy_from_slice(colour);
                }
            }
        }
    }
    Some(())
}

fn paint(Colour([r, g, b]): Colour) -> Paint<'static> {
    Paint { shader: Shader::SolidColor(Color::from_rgba8(r, g, b, u8::MAX)), ..Paint::default() }
}

/// The path through points, closed if it ends where it begins.
fn path(points: &[[f64; 2]]) -> Option<Path> {
    let mut path = PathBuilder::new();
    for (k, &[x, y]) in points.iter().enumerate() {
        match k {
            0 => path.move_to(x as f32, y as f32),
            _ => path.line_to(x as f32, y as f32),
        }
    }
    if points.first() == points.last() {
        path.close();
    }
    path.finish()
}

/// Covers a part (0 to 1) of a pixel, if it is on the sheet.
fn blend(sheet: &mut Pixmap, [column, row]: [i32; 2], part: f32, Colour(colour): Colour) {
    let (width, height) = (sheet.width() as i32, sheet.height() as i32);
    if (0..width).contains(&column) && (0..height).contains(&row) {
        let pixel = &mut sheet.data_mut()[4 * (row * width + column) as usize..][..3];
        for (old, new) in pixel.iter_mut().zip(colour.map(f32::from)) {
            *old = (f32::from(*old) + part.min(1.0) * (new - f32::from(*old))).round() as u8;
        }
    }
}

/// PNG file of the pixels, with its size on paper. Maps have few colours in long runs, and charts hardly any: their rows are packed as they
/// are, which makes files a tenth smaller than differences of rows, in less than half of the time.
pub fn encode([width, height]: [usize; 2], pixels: &[u8], level: u8) -> Vec<u8> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, width as u32, height as u32);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_filter(Filter::NoFilter);
    encoder.set_deflate_compression(DeflateCompression::Level(level));
    let per_metre = (PIXELS * 72.0 / 0.0254).round() as u32;
    encoder.set_pixel_dims(Some(png::PixelDimensions { xppu: per_metre, yppu: per_metre, unit: png::Unit::Meter }));
    let written = encoder.write_header().and_then(|mut writer| {
        writer.write_image_data(pixels)?;
        writer.finish()
    });
    debug_assert!(written.is_ok(), "writing into memory cannot fail");
    file
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pixels from 0 (white) to 1 (black), row by row, of a sheet 48 points = 200 pixels wide and high.
    fn darkness(draw: impl Fn(&mut Canvas)) -> Vec<Vec<f64>> {
        let mut canvas = Canvas::new([48.0, 48.0]);
        draw(&mut canvas);
        let file = png(&canvas);
        let mut reader = png::Decoder::new(std::io::Cursor::new(file)).read_info().unwrap();
        let mut colours = vec![0; 3 * 200 * 200];
        reader.next_frame(&mut colours).unwrap();
        colours
            .chunks(3 * 200)
            .map(|row| row.iter().step_by(3).map(|&c| 1.0 - f64::from(c) / 255.0).collect())
            .collect()
    }

    #[test]
    fn images_stand_below_other_marks_and_keep_their_pixels() {
        let colours: Vec<u8> = (0..30 * 20).flat_map(|k| [(k % 251) as u8; 3]).collect();
        let sheet = darkness(|canvas| {
            canvas.disc([12.0, 12.0], 1.0, Colour::BLACK);
            canvas.image([12.0, 12.0], [7.2, 4.8], [30, 20], colours.clone());
        });
        assert_eq!(sheet[50][50], 1.0);
        for (row, column) in (5..20).flat_map(|i| (5..30).map(move |j| (i, j))) {
            assert_eq!(sheet[50 + row][50 + column], 1.0 - f64::from(colours[3 * (30 * row + column)]) / 255.0);
        }
    }

    #[test]
    fn a_file_has_the_pixels_that_were_packed() {
        let pixels: Vec<u8> = (0..3 * 40 * 30).map(|k| (k * k % 253) as u8).collect();
        for level in [OF_FILE, ON_SCREEN] {
            let file = encode([40, 30], &pixels, level);
            let mut decoded = vec![0; pixels.len()];
            png::Decoder::new(std::io::Cursor::new(file)).read_info().unwrap().next_frame(&mut decoded).unwrap();
            assert_eq!(decoded, pixels);
        }
    }

    #[test]
    fn a_line_is_as_wide_as_it_is_told_wherever_it_stands() {
        for step in 0..10 {
            let y = 24.0 + 0.03 * f64::from(step);
            let sheet = darkness(|canvas| canvas.line(&[[0.0, y], [48.0, y]], 0.6, Colour::BLACK));
            let width: f64 = sheet.iter().map(|row| row[100]).sum();
            assert!((width - 2.5).abs() < 0.26, "{width} at {y}");
        }
    }

    #[test]
    fn upward_text_is_level_text_turned() {
        let level = darkness(|canvas| canvas.text("σₛ/E₂", [24.0, 20.0], Anchor::Centre, 7.5, Colour::BLACK));
        let upward = darkness(|canvas| canvas.upward("σₛ/E₂", [20.0, 24.0], 7.5, Colour::BLACK));
        assert!(level.iter().flatten().sum::<f64>() > 100.0);
        for (row, column) in (0..200).flat_map(|i| (0..200).map(move |j| (i, j))) {
            assert!((level[row][column] - upward[199 - column][row]).abs() < 0.01);
        }
    }
}
