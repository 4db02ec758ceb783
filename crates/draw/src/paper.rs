//! A sheet as a PDF file: a page of its size, its lines and letters as outlines, its fields as images.
//!
//! The file has no date and no name of a machine: the same sheet gives the same bytes.

use super::canvas::{Anchor, Canvas, Dash, Mark, Stroke};
use super::colour::Colour;
use super::letters::{Letter, Piece, letters, outline};
use super::text;
use miniz_oxide::deflate::compress_to_vec_zlib;
use pdf_writer::types::{LineCapStyle, LineJoinStyle};
use pdf_writer::{Content, Filter, Finish, Name, Pdf, Rect, Ref};

/// Level of compression, 0 to 10.
const EFFORT: u8 = 6;
/// Distance of the control points of a quarter of a circle, over its radius.
const ROUND: f64 = 0.552_284_75;

/// The PDF file of a sheet.
pub fn pdf(canvas: &Canvas) -> Vec<u8> {
    let [catalog, pages, page_id, content_id] = [1, 2, 3, 4].map(Ref::new);
    let [width, height] = canvas.size.map(|length| length as f32);
    let images: Vec<&Mark> = canvas.marks.iter().filter(|mark| matches!(mark, Mark::Image { .. })).collect();
    let names: Vec<(String, Ref)> = (0..images.len()).map(|k| (format!("I{k}"), Ref::new(5 + k as i32))).collect();
    let mut pdf = Pdf::new();
    pdf.catalog(catalog).pages(pages);
    pdf.pages(pages).kids([page_id]).count(1);
    let mut page = pdf.page(page_id);
    page.media_box(Rect::new(0.0, 0.0, width, height)).parent(pages).contents(content_id);
    {
        let mut resources = page.resources();
        let mut objects = resources.x_objects();
        for (name, id) in &names {
            objects.pair(Name(name.as_bytes()), *id);
        }
    }
    page.finish();
    let mut content = Content::new();
    // y grows downward on the sheet.
    content.transform([1.0, 0.0, 0.0, -1.0, 0.0, height]);
    content.set_line_join(LineJoinStyle::RoundJoin);
    let mut image = names.iter();
    for mark in &canvas.marks {
        put(&mut content, mark, &mut image);
    }
    let content = compress_to_vec_zlib(&content.finish(), EFFORT);
    pdf.stream(content_id, &content).filter(Filter::FlateDecode);
    for (mark, (_, id)) in images.iter().zip(&names) {
        if let Mark::Image { pixels: [columns, rows], colours, .. } = mark {
            let data = compress_to_vec_zlib(colours, EFFORT);
            let mut image = pdf.image_xobject(*id, &data);
            image.width(*columns as i32).height(*rows as i32).bits_per_component(8);
            image.color_space().device_rgb();
            image.filter(Filter::FlateDecode);
        }
    }
    pdf.finish()
}

/// Draws a mark; `images` are the names of the images, in their order.
fn put<'a>(content: &mut Content, mark: &Mark, images: &mut impl Iterator<Item = &'a (String, Ref)>) {
    match mark {
        Mark::Line(Stroke { points, width, dash, colour }) => {
            let [r, g, b] = parts(*colour);
            let lengths = dash.lengths().map_or(Vec::new(), |lengths| lengths.map(|x| (x * width) as f32).to_vec());
            let cap = if *dash == Dash::Dotted { LineCapStyle::RoundCap } else { LineCapStyle::ButtCap };
            content.set_stroke_rgb(r, g, b).set_line_width(*width as f32).set_line_cap(cap);
            content.set_dash_pattern(lengths, 0.0);
            path(content, points);
            content.stroke();
        }
        Mark::Area { corners, colour } => {
            fill(content, *colour);
            path(content, corners);
            content.fill_nonzero();
        }
        Mark::Disc { centre: [x, y], radius, colour } => {
            fill(content, *colour);
            let at = |u: f64, v: f64| [x + radius * u, y + radius * v];
            go(content, Piece::Move(at(1.0, 0.0)));
            for (u, v) in [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)] {
                let (first, second) = (at(u - ROUND * v, v + ROUND * u), at(ROUND * u - v, ROUND * v + u));
                go(content, Piece::Curve([first, second, at(-v, u)]));
            }
            content.close_path().fill_nonzero();
        }
        Mark::Text { text, at, anchor, size, upward, colour } => {
            let before = text::width(text, *size)
                * match anchor {
                    Anchor::Left => 0.0,
                    Anchor::Centre => 0.5,
                    Anchor::Right => 1.0,
                };
            fill(content, *colour);
            for Letter { glyph, x } in letters(text) {
                let place = |[u, v]: [f64; 2]| {
                    let [along, up] = [size * (x + u) - before, size * v];
                    if *upward { [at[0] - up, at[1] - along] } else { [at[0] + along, at[1] - up] }
                };
                for piece in outline(glyph) {
                    go(content, piece.map(place));
                }
            }
            content.fill_nonzero();
        }
        Mark::Image { corner: [x, y], size: [width, height], .. } => {
            let Some((name, _)) = images.next() else { return };
            // The unit square of an image has its first row on top.
            let matrix = [*width, 0.0, 0.0, -height, *x, y + height].map(|c| c as f32);
            content.save_state().transform(matrix).x_object(Name(name.as_bytes())).restore_state();
        }
    }
}

/// Adds a path through points, closed if it ends where it begins.
fn path(content: &mut Content, points: &[[f64; 2]]) {
    for (k, &point) in points.iter().enumerate() {
        go(content, if k == 0 { Piece::Move(point) } else { Piece::Line(point) });
    }
    if points.first() == points.last() {
        content.close_path();
    }
}

fn go(content: &mut Content, piece: Piece) {
    match piece {
        Piece::Move(to) => content.move_to(rounded(to[0]), rounded(to[1])),
        Piece::Line(to) => content.line_to(rounded(to[0]), rounded(to[1])),
        Piece::Curve(places) => {
            let [[a, b], [c, d], [e, f]] = places.map(|place| place.map(rounded));
            content.cubic_to(a, b, c, d, e, f)
        }
    };
}

/// A length rounded to 0.001 points, fine enough for letters.
fn rounded(x: f64) -> f32 {
    ((1000.0 * x).round() / 1000.0) as f32
}

fn fill(content: &mut Content, colour: Colour) {
    let [r, g, b] = parts(colour);
    content.set_fill_rgb(r, g, b);
}

/// Red, green and blue from 0 to 1.
fn parts(Colour(colour): Colour) -> [f32; 3] {
    colour.map(|c| f32::from(c) / 255.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sheet() -> Canvas {
        let mut canvas = Canvas::new([50.0, 20.0]);
        canvas.text("p̄/E₂ in %", [25.0, 10.126], Anchor::Centre, 7.0, Colour::BLACK);
        canvas.disc([10.0, 10.0], 3.0, Colour::BLACK);
        canvas.image([30.0, 2.0], [5.0, 4.0], [3, 2], vec![7; 18]);
        canvas.line(&[[0.0, 1.0], [10.0, 1.0]], 0.6, Colour::BLACK);
        canvas
    }

    /// Offsets of the cross-reference table are those of the objects, and the end of the file names the offset of the table.
    #[test]
    fn the_table_of_the_file_points_at_its_objects() {
        let file = pdf(&sheet());
        let find = |word: &[u8], from: usize| {
            file[from..].windows(word.len()).position(|window| window == word).unwrap() + from
        };
        let number = |at: usize| {
            let digits: String = file[at..].iter().take_while(|c| c.is_ascii_digit()).map(|&c| char::from(c)).collect();
            digits.parse::<usize>().unwrap()
        };
        let end = find(b"startxref\n", 0);
        let table = number(end + 10);
        assert_eq!(&file[table..table + 4], b"xref");
        let first = find(b"0000000000 65535 f", table);
        // Catalogue, pages, page, content and one image, each line of 20 bytes.
        for object in 1..=5 {
            let offset = number(first + 20 * object);
            assert!(file[offset..].starts_with(format!("{object} 0 obj").as_bytes()), "{object} at {offset}");
        }
        assert!(file.starts_with(b"%PDF-1.") && file.ends_with(b"%%EOF"));
    }

    #[test]
    fn the_same_sheet_is_the_same_file_without_a_date() {
        let file = pdf(&sheet());
        assert_eq!(file, pdf(&sheet()));
        assert!(!String::from_utf8_lossy(&file).contains("Date"));
    }
}
