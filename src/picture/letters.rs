//! Letters as outlines, for files that look the same without the typeface.

use super::text::{FONT, placed};
use ab_glyph::{Font, OutlineCurve, Point};

/// A letter of a line of text.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Letter {
    /// Index of the glyph in the typeface.
    pub glyph: u16,
    /// Distance of its origin from the beginning of the line, in units of the size.
    pub x: f64,
}

/// A piece of an outline, y up; coordinates in units of the em.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Piece {
    /// The beginning of a closed line.
    Move([f64; 2]),
    /// A straight line to a point.
    Line([f64; 2]),
    /// A cubic Bézier curve: two control points and the end.
    Curve([[f64; 2]; 3]),
}

impl Piece {
    /// The piece with its points mapped to other places.
    pub fn map(self, place: impl Fn([f64; 2]) -> [f64; 2]) -> Self {
        match self {
            Self::Move(to) => Self::Move(place(to)),
            Self::Line(to) => Self::Line(place(to)),
            Self::Curve(places) => Self::Curve(places.map(place)),
        }
    }
}

/// The letters of a line of text that have an outline.
pub fn letters(text: &str) -> Vec<Letter> {
    let letters = placed(text).0.into_iter().map(|own| Letter { glyph: own.glyph.0, x: own.x });
    letters.filter(|letter| !outline(letter.glyph).is_empty()).collect()
}

/// Outline of a glyph by its index in the typeface; empty for a space.
pub fn outline(glyph: u16) -> Vec<Piece> {
    let em = FONT.units_per_em().unwrap_or(2048.0);
    let at = |point: Point| [point.x, point.y].map(|c| f64::from(c / em));
    let between = |[a, b]: [[f64; 2]; 2], part: f64| [0, 1].map(|k| a[k] + part * (b[k] - a[k]));
    let (mut pieces, mut end) = (Vec::new(), None);
    for curve in FONT.outline(ab_glyph::GlyphId(glyph)).map_or(Vec::new(), |outline| outline.curves) {
        let (from, piece, to) = match curve {
            OutlineCurve::Line(from, to) => (at(from), Piece::Line(at(to)), at(to)),
            // A parabola is a cubic whose control points lie two thirds of the way to that of the parabola.
            OutlineCurve::Quad(from, aside, to) => {
                let [a, q, b] = [from, aside, to].map(at);
                (a, Piece::Curve([between([a, q], 2.0 / 3.0), between([b, q], 2.0 / 3.0), b]), b)
            }
            OutlineCurve::Cubic(from, first, second, to) => {
                (at(from), Piece::Curve([first, second, to].map(at)), at(to))
            }
        };
        if end != Some(from) {
            pieces.push(Piece::Move(from));
        }
        pieces.push(piece);
        end = Some(to);
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_stand_where_the_text_has_them_and_spaces_leave_no_ink() {
        let letters = letters("i o");
        assert_eq!(letters.len(), 2);
        assert!(letters[1].x > 0.5 && letters[0].x == 0.0, "{letters:?}");
        // A stem and a dot; an outer and an inner line.
        for letter in letters {
            let begun = outline(letter.glyph).iter().filter(|piece| matches!(piece, Piece::Move(_))).count();
            assert_eq!(begun, 2);
        }
    }

    #[test]
    fn every_line_of_an_outline_ends_where_it_begins() {
        for letter in letters("p̄δσ8µg") {
            let (mut begin, mut end) = ([0.0; 2], [0.0; 2]);
            for piece in outline(letter.glyph) {
                match piece {
                    Piece::Move(to) => {
                        assert_eq!(begin, end);
                        (begin, end) = (to, to);
                    }
                    Piece::Line(to) | Piece::Curve([_, _, to]) => end = to,
                }
            }
            assert_eq!(begin, end);
        }
    }
}
