//! Maps: a field over a rectangle in colours, with a colour bar and marks over it.

use super::axis::Axis;
use super::bar::{Bar, GAP};
use super::canvas::{Anchor, Canvas, PIXELS, Stroke};
use super::colour::Colour;
use super::curve::clipped;
use super::frame::Frame;
use super::sheet::{HAIR, Margins, NUMBERS, Panel};
use rayon::prelude::*;

/// A mark over a field, in its coordinates.
#[derive(Debug, Clone, PartialEq)]
pub enum Over {
    /// A line.
    Line(Stroke),
    /// A centred word.
    Word {
        /// The word.
        word: String,
        /// Place of its centre.
        at: [f64; 2],
        /// Colour of its letters.
        colour: Colour,
    },
    /// A bar on top of the plot, for a contact.
    Roof {
        /// First and last place along the horizontal axis.
        from_to: [f64; 2],
    },
    /// A cross, at a largest value.
    Mark {
        /// Place of its centre.
        at: [f64; 2],
        /// Colour of the cross; its edge has the opposite lightness.
        colour: Colour,
    },
    /// A number in a ring, at a failure.
    Ring {
        /// Place of its centre.
        at: [f64; 2],
        /// The number.
        number: usize,
    },
    /// An arrow in the lower left corner.
    Arrow {
        /// A unit vector of the plot, whose axes are to scale.
        direction: [f64; 2],
    },
}

/// The colours of a field.
#[allow(missing_debug_implementations, reason = "functions have no text")]
pub enum Fill<'a> {
    /// Values with a colour bar; places without a value have [`Bar::without`].
    Values(Bar, &'a (dyn Fn([f64; 2]) -> Option<f64> + Sync)),
    /// Colours without a scale.
    Colours(&'a (dyn Fn([f64; 2]) -> Colour + Sync)),
}

/// A map of a field.
#[allow(missing_debug_implementations, reason = "functions have no text")]
pub struct Map<'a> {
    /// Title above the plot.
    pub title: String,
    /// The horizontal axis, with a range.
    pub x: Axis,
    /// The vertical axis, with a range.
    pub y: Axis,
    /// Height over width.
    pub aspect: f64,
    /// The field.
    pub fill: Fill<'a>,
    /// Marks over the field, the first one lowest.
    pub over: Vec<Over>,
}

/// Height of a bar on top of a plot, points.
const ROOF: f64 = 2.6;
/// Length of an arrow, points.
const ARROW: f64 = 20.0;
/// Length of the head of an arrow, points.
const HEAD: f64 = 6.0;
/// Distance of an arrow from the border of the plot, points.
const INSET: f64 = 16.0;

impl Map<'_> {
    /// The map with more marks, under those that it has.
    #[must_use]
    pub fn under(self, marks: Vec<Over>) -> Self {
        Self { over: marks.into_iter().chain(self.over).collect(), ..self }
    }

    fn ranges(&self) -> [[f64; 2]; 2] {
        [&self.x, &self.y].map(|axis| axis.range.unwrap_or([0.0, 1.0]))
    }

    fn frame(&self, width: f64, margins: Margins) -> Frame {
        Frame::new([&self.x, &self.y], self.ranges(), width, margins, self.aspect, true)
    }

    /// The field's pixels, row by row from the top.
    fn pixels(&self, [columns, rows]: [usize; 2]) -> Vec<u8> {
        let [[x0, x1], [y0, y1]] = self.ranges();
        let place = |row: f64, column: f64| {
            let across = (column + 0.5) / columns as f64;
            let down = (row + 0.5) / rows as f64;
            [self.x.scale.between(x0, x1, across), self.y.scale.between(y1, y0, down)]
        };
        let table = match &self.fill {
            Fill::Values(bar, _) => bar.colours.table(),
            Fill::Colours(_) => Vec::new(),
        };
        let colour = |place: [f64; 2]| match &self.fill {
            Fill::Values(bar, value) => value(place).map_or(bar.without, |value| bar.colour(&table, value)),
            Fill::Colours(colour) => colour(place),
        };
        let mut pixels = vec![0; 3 * columns * rows];
        pixels.par_chunks_mut(3 * columns).enumerate().for_each(|(row, line)| {
            for (column, pixel) in line.chunks_exact_mut(3).enumerate() {
                pixel.copy_from_slice(&colour(place(row as f64, column as f64)).0);
            }
        });
        // The edges of white areas are smoothed: pixels next to them become means of several places.
        const PARTS: u8 = 4;
        let white = |row: usize, column: usize| pixels[3 * (row * columns + column)..][..3] == [255; 3];
        let is_edge = |row: usize, column: usize| {
            let neighbours = [
                (row.saturating_sub(1), column),
                ((row + 1).min(rows - 1), column),
                (row, column.saturating_sub(1)),
                (row, (column + 1).min(columns - 1)),
            ];
            neighbours.into_iter().any(|(i, j)| white(i, j) != white(row, column))
        };
        let edges: Vec<(usize, [u8; 3])> = (0..rows * columns)
            .into_par_iter()
            .filter(|index| is_edge(index / columns, index % columns))
            .map(|index| {
                let mut sum = [0u32; 3];
                for (i, j) in (0..PARTS).flat_map(|i| (0..PARTS).map(move |j| (i, j))) {
                    let shift = |k: u8| (f64::from(k) + 0.5) / f64::from(PARTS) - 0.5;
                    let Colour(rgb) =
                        colour(place((index / columns) as f64 + shift(i), (index % columns) as f64 + shift(j)));
                    sum = [0, 1, 2].map(|k| sum[k] + u32::from(rgb[k]));
                }
                (index, sum.map(|c| (c / u32::from(PARTS * PARTS)) as u8))
            })
            .collect();
        for (index, colour) in edges {
            pixels[3 * index..][..3].copy_from_slice(&colour);
        }
        pixels
    }
}

impl Panel for Map<'_> {
    fn title(&self) -> &str {
        &self.title
    }

    fn margins(&self, width: f64) -> Margins {
        let (right, has_factor) = match &self.fill {
            Fill::Values(bar, _) => (bar.width(), bar.factor().is_some()),
            Fill::Colours(_) => (GAP, false),
        };
        let margins = Frame::margins([&self.x, &self.y], self.ranges(), [width, right], self.aspect, true);
        Margins { top: margins.top.max(if has_factor { 1.5 * NUMBERS } else { 0.0 }), ..margins }
    }

    fn height(&self, width: f64, margins: Margins) -> f64 {
        self.frame(width, margins).height
    }

    fn draw(&self, canvas: &mut Canvas, [ox, oy]: [f64; 2], width: f64, margins: Margins) {
        let frame = self.frame(width, margins);
        let bounds = frame.bounds([ox, oy]);
        let pixels = frame.size.map(|length| (length * PIXELS).round() as usize);
        canvas.image(bounds[0], frame.size, pixels, self.pixels(pixels));
        let at = |place: [f64; 2]| frame.place(place).map(|[x, y]| [ox + x, oy + y]);
        for over in &self.over {
            match over {
                Over::Line(Stroke { points, width, dash, colour }) => {
                    let places: Vec<[f64; 2]> = points.iter().filter_map(|&point| at(point)).collect();
                    for piece in clipped(&places, bounds) {
                        canvas.dashed(&piece, *width, *dash, *colour);
                    }
                }
                Over::Word { word, at: place, colour } => {
                    if let Some(place) = at(*place) {
                        canvas.label(word, place, Anchor::Centre, NUMBERS, *colour);
                    }
                }
                Over::Roof { from_to: [from, to] } => {
                    let top = bounds[0][1] - 0.5 * HAIR;
                    if let (Some([x0, _]), Some([x1, _])) = (at([*from, 0.0]), at([*to, 0.0])) {
                        let corners = [[x0, top - ROOF], [x1, top - ROOF], [x1, top], [x0, top]];
                        canvas.area(&corners, Colour::GREY);
                    }
                }
                Over::Mark { at: place, colour } => {
                    if let Some(place) = at(*place) {
                        cross(canvas, place, *colour);
                    }
                }
                Over::Ring { at: place, number } => {
                    if let Some(place) = at(*place) {
                        ring(canvas, place, *number);
                    }
                }
                Over::Arrow { direction } => {
                    arrow(canvas, [bounds[0][0] + INSET, bounds[1][1] - INSET], *direction);
                }
            }
        }
        frame.draw(canvas, [ox, oy]);
        if let Fill::Values(bar, _) = &self.fill {
            bar.draw(canvas, [bounds[1][0] + GAP, bounds[0][1]], frame.size[1]);
        }
    }
}

/// A cross with an edge of the opposite lightness.
fn cross(canvas: &mut Canvas, [x, y]: [f64; 2], colour: Colour) {
    let edge = if colour.lightness() > 0.5 { Colour::BLACK } else { Colour::WHITE };
    for (width, arm, colour) in [(2.2, 3.6, edge), (1.0, 3.1, colour)] {
        canvas.line(&[[x - arm, y], [x + arm, y]], width, colour);
        canvas.line(&[[x, y - arm], [x, y + arm]], width, colour);
    }
}

/// A number on a white disc with a black edge.
fn ring(canvas: &mut Canvas, place: [f64; 2], number: usize) {
    canvas.disc(place, 4.6, Colour::BLACK);
    canvas.disc(place, 4.0, Colour::WHITE);
    canvas.label(&number.to_string(), place, Anchor::Centre, NUMBERS, Colour::BLACK);
}

/// An arrow around a place, on a white ground; `direction` with y upwards.
fn arrow(canvas: &mut Canvas, [x, y]: [f64; 2], [dx, dy]: [f64; 2]) {
    let at = |along: f64, across: f64| [x + along * dx + across * dy, y - along * dy + across * dx];
    let (tail, neck, tip) = (-0.5 * ARROW, 0.5 * ARROW - HEAD, 0.5 * ARROW);
    canvas.disc([x, y], 0.5 * ARROW + 2.5, Colour::WHITE);
    canvas.line(&[at(tail, 0.0), at(neck, 0.0)], 1.4, Colour::BLACK);
    canvas.area(&[at(neck, -0.42 * HEAD), at(tip, 0.0), at(neck, 0.42 * HEAD)], Colour::BLACK);
}
