//! Letters as outlines, for files that look the same without the typeface.

use super::text::placed;
use super::typeface::{self, Glyph, Segment};

/// A letter of a line of text.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Letter {
    /// Glyph of the letter in the typeface.
    pub glyph: Glyph,
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
    let letters = placed(text).0.into_iter().map(|letter| Letter { glyph: letter.glyph, x: letter.x });
    letters.filter(|letter| typeface::bounds(letter.glyph).is_some()).collect()
}

/// Outline of a glyph; empty for a space.
pub fn outline(glyph: Glyph) -> Vec<Piece> {
    // A parabola is a cubic whose control points lie two thirds of the way to that of the parabola.
    let toward = |aside: [f64; 2], end: [f64; 2]| [0, 1].map(|k| end[k] + 2.0 / 3.0 * (aside[k] - end[k]));
    let mut end = [0.0; 2];
    let piece = |segment| {
        let piece = match segment {
            Segment::Move(to) => Piece::Move(to),
            Segment::Line(to) => Piece::Line(to),
            Segment::Parabola(aside, to) => Piece::Curve([toward(aside, end), toward(aside, to), to]),
        };
        let (Piece::Move(to) | Piece::Line(to) | Piece::Curve([_, _, to])) = piece;
        end = to;
        piece
    };
    typeface::outline(glyph).into_iter().map(piece).collect()
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
