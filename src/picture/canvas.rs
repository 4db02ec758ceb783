//! A sheet of paper measured in points (1/72 inch), and the marks on it in their order.
//!
//! x grows to the right and y down. The sheet becomes pixels ([`super::raster`]) or an SVG file ([`super::vector`]);
//! whoever draws on it need not know which.

use super::Format;
use super::colour::Colour;
use super::text;

/// Width of a column of a journal, 85 mm.
pub const COLUMN: f64 = 241.0;

/// Pixels per point: 300 dots per inch.
pub const PIXELS: f64 = 300.0 / 72.0;

/// Points of a line closer together than this are one, points.
const CLOSE: f64 = 0.25;

fn distance([x0, y0]: [f64; 2], [x1, y1]: [f64; 2]) -> f64 {
    (x1 - x0).hypot(y1 - y0)
}

/// Where a text stands relative to its anchor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// The anchor is the left end of the baseline.
    Left,
    /// The anchor is the middle of the baseline.
    Centre,
    /// The anchor is the right end of the baseline.
    Right,
}

/// How a line is interrupted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dash {
    /// Not at all.
    Solid,
    /// Dashes.
    Dashed,
    /// Dots.
    Dotted,
}

/// One mark.
#[derive(Debug, Clone, PartialEq)]
pub enum Mark {
    /// A line through points.
    Line {
        /// Points.
        points: Vec<[f64; 2]>,
        /// Width, points.
        width: f64,
        /// Its colour.
        colour: Colour,
    },
    /// A filled polygon.
    Area {
        /// Corners.
        corners: Vec<[f64; 2]>,
        /// Its colour.
        colour: Colour,
    },
    /// A filled disc.
    Disc {
        /// Centre.
        centre: [f64; 2],
        /// Radius, points.
        radius: f64,
        /// Its colour.
        colour: Colour,
    },
    /// A line of text.
    Text {
        /// The text.
        text: String,
        /// Where its anchor is, on the baseline.
        at: [f64; 2],
        /// Which part of it is there.
        anchor: Anchor,
        /// Size of the typeface, points.
        size: f64,
        /// Whether it runs from bottom to top.
        upward: bool,
        /// Its colour.
        colour: Colour,
    },
    /// A rectangle of pixels; they stand below all other marks.
    Image {
        /// Upper left corner, points.
        corner: [f64; 2],
        /// Width and height, points.
        size: [f64; 2],
        /// Columns and rows.
        pixels: [usize; 2],
        /// Red, green and blue of every pixel, row by row.
        colours: Vec<u8>,
    },
}

/// The sheet.
#[derive(Debug, Clone, PartialEq)]
pub struct Canvas {
    /// Width and height, points.
    pub size: [f64; 2],
    /// Marks, the first one lowest.
    pub marks: Vec<Mark>,
}

impl Canvas {
    /// An empty sheet.
    pub fn new(size: [f64; 2]) -> Self {
        Self { size, marks: Vec::new() }
    }

    /// A line through points; those closer together than an eye can see are left out.
    pub fn line(&mut self, points: &[[f64; 2]], width: f64, colour: Colour) {
        let Some((&last, others)) = points.split_last() else { return };
        let mut seen: Vec<[f64; 2]> = Vec::new();
        for &point in others {
            if seen.last().is_none_or(|before| distance(*before, point) > CLOSE) {
                seen.push(point);
            }
        }
        seen.push(last);
        if seen.len() > 1 {
            self.marks.push(Mark::Line { points: seen, width, colour });
        }
    }

    /// A line through points, dashed or dotted.
    pub fn dashed(&mut self, points: &[[f64; 2]], width: f64, dash: Dash, colour: Colour) {
        let (on, off) = match dash {
            Dash::Solid => return self.line(points, width, colour),
            Dash::Dashed => (4.0 * width, 2.5 * width),
            Dash::Dotted => (0.01 * width, 2.2 * width),
        };
        for piece in pieces(points, on, off) {
            match dash {
                Dash::Dotted => self.disc(piece[0], 0.55 * width, colour),
                _ => self.line(&piece, width, colour),
            }
        }
    }

    /// A closed line around a polygon.
    pub fn outline(&mut self, corners: &[[f64; 2]], width: f64, colour: Colour) {
        let closed: Vec<[f64; 2]> = corners.iter().chain(corners.first()).copied().collect();
        self.line(&closed, width, colour);
    }

    /// A filled polygon.
    pub fn area(&mut self, corners: &[[f64; 2]], colour: Colour) {
        self.marks.push(Mark::Area { corners: corners.to_vec(), colour });
    }

    /// A filled disc.
    pub fn disc(&mut self, centre: [f64; 2], radius: f64, colour: Colour) {
        self.marks.push(Mark::Disc { centre, radius, colour });
    }

    /// A line of text on its baseline.
    pub fn text(&mut self, text: &str, at: [f64; 2], anchor: Anchor, size: f64, colour: Colour) {
        self.marks.push(Mark::Text { text: text.to_owned(), at, anchor, size, upward: false, colour });
    }

    /// A line of text whose capitals are centred in height on `at`.
    pub fn label(&mut self, text: &str, [x, y]: [f64; 2], anchor: Anchor, size: f64, colour: Colour) {
        self.text(text, [x, y + 0.5 * text::CAPITALS * size], anchor, size, colour);
    }

    /// A centred line of text from bottom to top, its baseline on the right.
    pub fn upward(&mut self, text: &str, at: [f64; 2], size: f64, colour: Colour) {
        let anchor = Anchor::Centre;
        self.marks.push(Mark::Text { text: text.to_owned(), at, anchor, size, upward: true, colour });
    }

    /// A rectangle of pixels.
    pub fn image(&mut self, corner: [f64; 2], size: [f64; 2], pixels: [usize; 2], colours: Vec<u8>) {
        self.marks.push(Mark::Image { corner, size, pixels, colours });
    }

    /// The file of this sheet.
    pub fn file(&self, format: Format) -> Vec<u8> {
        match format {
            Format::Png => super::raster::png(self),
            Format::Svg => super::vector::svg(self).into_bytes(),
        }
    }
}

/// The dashes of a line: pieces of length `on` after gaps of length `off`.
fn pieces(points: &[[f64; 2]], on: f64, off: f64) -> Vec<Vec<[f64; 2]>> {
    let mut pieces = Vec::new();
    let (mut piece, mut left): (Option<Vec<[f64; 2]>>, f64) = (points.first().map(|&p| vec![p]), on);
    for pair in points.windows(2) {
        let ([x0, y0], [x1, y1]) = (pair[0], pair[1]);
        let length = distance([x0, y0], [x1, y1]);
        let mut done = 0.0;
        while length - done > left {
            done += left;
            let here = [x0 + (x1 - x0) * done / length, y0 + (y1 - y0) * done / length];
            match piece.take() {
                Some(mut points) => {
                    points.push(here);
                    pieces.push(points);
                    left = off;
                }
                None => {
                    piece = Some(vec![here]);
                    left = on;
                }
            }
        }
        left -= length - done;
        if let Some(points) = &mut piece {
            points.push([x1, y1]);
        }
    }
    pieces.extend(piece.filter(|points| points.len() > 1));
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dashes_cover_their_share_of_a_line() {
        let dashes = pieces(&[[0.0, 0.0], [7.0, 0.0], [7.0, 23.0]], 2.0, 1.0);
        assert_eq!(dashes.len(), 10);
        let length = |points: &Vec<[f64; 2]>| -> f64 {
            points.windows(2).map(|p| (p[1][0] - p[0][0]).hypot(p[1][1] - p[0][1])).sum()
        };
        assert!((dashes.iter().map(length).sum::<f64>() - 20.0).abs() < 1e-9);
    }
}
