//! The embedded typeface: glyphs of letters with their widths and outlines, in units of the size.
//!
//! DejaVu Sans (its licence stands beside it): Latin, Greek, Cyrillic, indices and signs, so that pictures look the same on
//! every machine. Titles and names in pictures are the users' own, so all of its 5906 letters are kept, in 450 kB: the table
//! `font/letters.bin`, which `font/make.py` has made from the published file and describes. Hinting is left out.

use std::sync::LazyLock;

static TABLE: LazyLock<Table> = LazyLock::new(|| Table::new(include_bytes!("font/letters.bin")));

const WHOLE: &str = "the embedded typeface is whole";

/// Units of the typeface per size: a power of two, so that nothing is rounded.
pub const EM: f64 = 2048.0;

/// Index of a glyph in the typeface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Glyph(pub u16);

impl Glyph {
    /// The empty box that stands for letters without a glyph.
    pub const MISSING: Self = Self(0);

    fn new(index: i32) -> Self {
        Self(u16::try_from(index).expect(WHOLE))
    }
}

/// A piece of an outline: whole or half units over [`EM`], y up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Segment {
    /// The beginning of a closed line.
    Move([f64; 2]),
    /// A straight line to a point.
    Line([f64; 2]),
    /// A parabola: its control point and its end.
    Parabola([f64; 2], [f64; 2]),
}

/// Glyph of a letter; an empty box where the typeface has none.
pub fn glyph(letter: char) -> Glyph {
    let letters = &TABLE.letters;
    letters.binary_search_by_key(&letter, |&(letter, _)| letter).map_or(Glyph::MISSING, |k| letters[k].1)
}

/// Distance from the origin of a glyph to that of the next one.
pub fn advance(glyph: Glyph) -> f64 {
    f64::from(TABLE.glyphs[usize::from(glyph.0)].0) / EM
}

/// Addition to the advance of a glyph before another: negative for pairs like AV.
pub fn kerning(glyph: Glyph, next: Glyph) -> f64 {
    let pairs = &TABLE.pairs;
    let found = pairs.binary_search_by_key(&[glyph, next], |&(pair, _)| pair);
    found.map_or(0.0, |k| f64::from(pairs[k].1) / EM)
}

/// The least box around the outline of a glyph and its control points: left and lower, right and upper corner, y up. None for a space.
pub fn bounds(glyph: Glyph) -> Option<[[f64; 2]; 2]> {
    let (mut from, mut to) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    let mut enclose = |point: [f64; 2]| {
        from = [0, 1].map(|k| from[k].min(point[k]));
        to = [0, 1].map(|k| to[k].max(point[k]));
    };
    for segment in outline(glyph) {
        match segment {
            Segment::Move(to) | Segment::Line(to) => enclose(to),
            Segment::Parabola(aside, to) => [aside, to].into_iter().for_each(&mut enclose),
        }
    }
    (from[0] < to[0]).then_some([from, to])
}

/// Outline of a glyph, y up; empty for a space.
pub fn outline(glyph: Glyph) -> Vec<Segment> {
    let mut segments = Vec::new();
    trace(glyph, [0, 0], &mut segments);
    segments
}

/// Adds the contours of a glyph and of its parts, its origin at a place in units of the typeface.
fn trace(glyph: Glyph, origin: [i32; 2], segments: &mut Vec<Segment>) {
    let mut numbers = Numbers(TABLE.glyphs[usize::from(glyph.0)].1);
    let mut at = origin;
    while !numbers.0.is_empty() {
        match numbers.number() {
            0 => {
                let part = Glyph::new(numbers.number());
                let place = origin.map(|c| c + numbers.number());
                trace(part, place, segments);
            }
            count => {
                let point = |_| {
                    let along = numbers.number();
                    at = [at[0] + (along >> 1), at[1] + numbers.number()];
                    (at.map(|c| f64::from(c) / EM), along & 1 == 1)
                };
                contour(&(0..count).map(point).collect::<Vec<_>>(), segments);
            }
        }
    }
}

/// Adds a contour through points, each with whether it lies on the curve: between two that do not, their middle does.
fn contour(points: &[([f64; 2], bool)], segments: &mut Vec<Segment>) {
    let middle = |a: [f64; 2], b: [f64; 2]| [0, 1].map(|k| 0.5 * (a[k] + b[k]));
    let (first, last) = (points[0], points[points.len() - 1]);
    let (begin, rest) = if first.1 { (first.0, &points[1..]) } else { (middle(last.0, first.0), points) };
    segments.push(Segment::Move(begin));
    let mut aside = None;
    for &(point, on_curve) in rest.iter().chain([&(begin, true)]) {
        match (aside, on_curve) {
            (None, true) => segments.push(Segment::Line(point)),
            (Some(control), true) => segments.push(Segment::Parabola(control, point)),
            (Some(control), false) => segments.push(Segment::Parabola(control, middle(control, point))),
            (None, false) => {}
        }
        aside = (!on_curve).then_some(point);
    }
    if let Some(Segment::Parabola(..)) = segments.last() {
        segments.push(Segment::Line(begin));
    }
}

/// The table of the typeface.
struct Table {
    /// Advance of every glyph, and the bytes of its outline.
    glyphs: Vec<(i32, &'static [u8])>,
    /// Letters with their glyphs, ascending.
    letters: Vec<(char, Glyph)>,
    /// Glyphs that follow each other with what is added to the advance, ascending.
    pairs: Vec<([Glyph; 2], i32)>,
}

impl Table {
    fn new(file: &'static [u8]) -> Self {
        let mut numbers = Numbers(file);
        let glyphs = numbers.rows(|row| (row.number(), row.bytes()));
        let (mut code, mut glyph) = (0, 0);
        let letters = numbers.rows(|row| {
            (code, glyph) = (code + row.number(), glyph + row.number());
            (u32::try_from(code).ok().and_then(char::from_u32).expect(WHOLE), Glyph::new(glyph))
        });
        let mut first = 0;
        let pairs = numbers.rows(|row| {
            first += row.number();
            ([first, row.number()].map(Glyph::new), row.number())
        });
        Self { glyphs, letters, pairs }
    }
}

/// The rest of a row of numbers.
struct Numbers(&'static [u8]);

impl Numbers {
    /// The next number: seven bits a byte, the lowest first; the lowest bit of all is the sign.
    fn number(&mut self) -> i32 {
        let (mut bits, mut shift) = (0, 0);
        loop {
            let (&byte, rest) = self.0.split_first().expect(WHOLE);
            self.0 = rest;
            bits |= i32::from(byte & 127) << shift;
            shift += 7;
            if byte < 128 {
                return (bits >> 1) ^ -(bits & 1);
            }
        }
    }

    /// The next rows; the next number is their count.
    fn rows<T>(&mut self, mut row: impl FnMut(&mut Self) -> T) -> Vec<T> {
        (0..self.number()).map(|_| row(self)).collect()
    }

    /// The next bytes; the next number is their count.
    fn bytes(&mut self) -> &'static [u8] {
        let length = usize::try_from(self.number()).expect(WHOLE);
        let (bytes, rest) = self.0.split_at(length);
        self.0 = rest;
        bytes
    }
}
