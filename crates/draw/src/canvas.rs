//! A sheet of paper measured in points (1/72 inch), and the marks on it in their order.
//!
//! x grows to the right and y down. A sheet is written as PNG, SVG or PDF; drawing on it does not depend on the format.

use super::colour::Colour;
use super::text;
use percoat_common::plain;

/// Width of a column of a journal, 85 mm.
pub const COLUMN: f64 = 241.0;

/// Pixels per point: 300 dots per inch.
pub const PIXELS: f64 = 300.0 / 72.0;

/// Distance in points below which two points of a line are drawn as one.
const CLOSE: f64 = 0.25;

/// The point of its baseline by which a text is placed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// Left end.
    Left,
    /// Middle.
    Centre,
    /// Right end.
    Right,
}

/// The pattern of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dash {
    /// A line without gaps.
    Solid,
    /// Dashes with gaps of about half their length.
    Dashed,
    /// Round dots.
    Dotted,
}

impl Dash {
    /// Lengths of a dash and of the gap after it over the width of the line; `None` for a solid line. A dot is a round end without a
    /// dash.
    pub fn lengths(self) -> Option<[f64; 2]> {
        match self {
            Self::Solid => None,
            Self::Dashed => Some([4.0, 2.5]),
            Self::Dotted => Some([0.0, 1.8]),
        }
    }
}

/// A line through points.
#[derive(Debug, Clone, PartialEq)]
pub struct Stroke {
    /// Points x, y in their order, points of 1/72 inch.
    pub points: Vec<[f64; 2]>,
    /// Width, points (1/72 inch).
    pub width: f64,
    /// Pattern.
    pub dash: Dash,
    /// Colour.
    pub colour: Colour,
}

/// A mark; lengths in points.
#[derive(Debug, Clone, PartialEq)]
pub enum Mark {
    /// A line.
    Line(Stroke),
    /// A filled polygon.
    Area {
        /// Corners in their order.
        corners: Vec<[f64; 2]>,
        /// Colour of the inside.
        colour: Colour,
    },
    /// A filled disc.
    Disc {
        /// Centre.
        centre: [f64; 2],
        /// Radius.
        radius: f64,
        /// Colour of the inside.
        colour: Colour,
    },
    /// A line of text.
    Text {
        /// The line.
        text: String,
        /// Place of the anchor on the baseline.
        at: [f64; 2],
        /// The point that is placed.
        anchor: Anchor,
        /// Size of the letters.
        size: f64,
        /// Whether it runs from bottom to top.
        upward: bool,
        /// Colour of the letters.
        colour: Colour,
    },
    /// A rectangle of pixels, below all other marks.
    Image {
        /// Upper left corner.
        corner: [f64; 2],
        /// Width and height.
        size: [f64; 2],
        /// Columns and rows.
        pixels: [usize; 2],
        /// Red, green and blue of every pixel, row by row.
        colours: Vec<u8>,
    },
}

/// A sheet.
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

    /// Draws a line through points.
    pub fn line(&mut self, points: &[[f64; 2]], width: f64, colour: Colour) {
        self.dashed(points, width, Dash::Solid, colour);
    }

    /// Draws a line through points, solid, dashed or dotted; points closer together than a quarter of a point are left out.
    pub fn dashed(&mut self, points: &[[f64; 2]], width: f64, dash: Dash, colour: Colour) {
        let Some((&last, others)) = points.split_last() else { return };
        let mut seen: Vec<[f64; 2]> = Vec::new();
        for &[x, y] in others {
            if seen.last().is_none_or(|before| (x - before[0]).hypot(y - before[1]) > CLOSE) {
                seen.push([x, y]);
            }
        }
        seen.push(last);
        // Dots of the width of a line would look thinner than the line.
        let width = if dash == Dash::Dotted { 1.2 * width } else { width };
        if seen.len() > 1 {
            self.marks.push(Mark::Line(Stroke { points: seen, width, dash, colour }));
        }
    }

    /// Draws the outline of a polygon.
    pub fn outline(&mut self, corners: &[[f64; 2]], width: f64, colour: Colour) {
        let closed: Vec<[f64; 2]> = corners.iter().chain(corners.first()).copied().collect();
        self.line(&closed, width, colour);
    }

    /// Fills a polygon.
    pub fn area(&mut self, corners: &[[f64; 2]], colour: Colour) {
        self.marks.push(Mark::Area { corners: corners.to_vec(), colour });
    }

    /// Fills a disc.
    pub fn disc(&mut self, centre: [f64; 2], radius: f64, colour: Colour) {
        self.marks.push(Mark::Disc { centre, radius, colour });
    }

    /// Draws a line of text on its baseline, hidden characters as their escapes.
    pub fn text(&mut self, text: &str, at: [f64; 2], anchor: Anchor, size: f64, colour: Colour) {
        self.marks.push(Mark::Text { text: plain::line(text).into_owned(), at, anchor, size, upward: false, colour });
    }

    /// Draws a line of text whose capitals are centred in height on `at`.
    pub fn label(&mut self, text: &str, [x, y]: [f64; 2], anchor: Anchor, size: f64, colour: Colour) {
        self.text(text, [x, y + 0.5 * text::CAPITALS * size], anchor, size, colour);
    }

    /// Draws a centred line of text from bottom to top, its baseline on the right.
    pub fn upward(&mut self, text: &str, at: [f64; 2], size: f64, colour: Colour) {
        let anchor = Anchor::Centre;
        self.marks.push(Mark::Text { text: plain::line(text).into_owned(), at, anchor, size, upward: true, colour });
    }

    /// Draws a rectangle of pixels, below all other marks.
    pub fn image(&mut self, corner: [f64; 2], size: [f64; 2], pixels: [usize; 2], colours: Vec<u8>) {
        let lowest = self.marks.partition_point(|mark| matches!(mark, Mark::Image { .. }));
        self.marks.insert(lowest, Mark::Image { corner, size, pixels, colours });
    }
}
