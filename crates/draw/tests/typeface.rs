//! The table of the embedded typeface is what its published file says, letter by letter.
//!
//! The published crate has the table, but neither that file nor this test.

use std::collections::{BTreeMap, BTreeSet};
use typeface::{EM, Glyph, Segment, advance, bounds, glyph, kerning, outline};

// Read as its own module: the table belongs to the pictures alone.
#[path = "../src/typeface.rs"]
mod typeface;

/// The published file, in the format TrueType: <https://learn.microsoft.com/typography/opentype/spec/>.
const FILE: &[u8] = include_bytes!("../src/font/DejaVuSans.ttf");

/// A point of a contour in units of the typeface, and whether it lies on the curve.
type Point = ([f64; 2], bool);

fn byte(at: usize) -> usize {
    usize::from(FILE[at])
}

fn word(at: usize) -> usize {
    byte(at) << 8 | byte(at + 1)
}

fn long(at: usize) -> usize {
    word(at) << 16 | word(at + 2)
}

fn signed(at: usize) -> f64 {
    f64::from(word(at) as u16 as i16)
}

/// Place of a table in the file.
fn table(name: &[u8; 4]) -> usize {
    let records = (0..word(4)).map(|k| 12 + 16 * k);
    let mut found = records.filter(|&record| &FILE[record..record + 4] == name);
    long(found.next().unwrap() + 8)
}

/// Letters and their glyphs: the table `cmap` for all of Unicode, format 12.
fn letters() -> BTreeMap<u32, usize> {
    let cmap = table(b"cmap");
    let records = (0..word(cmap + 2)).map(|k| cmap + 4 + 8 * k);
    let record = { records }.find(|&record| [word(record), word(record + 2)] == [3, 10]).unwrap();
    let map = cmap + long(record + 4);
    assert_eq!(word(map), 12);
    let groups = (0..long(map + 12)).map(|k| map + 16 + 12 * k);
    let group = |at| (long(at)..=long(at + 4)).map(move |code| (code as u32, long(at + 8) + code - long(at)));
    groups.flat_map(group).collect()
}

/// Advance of a glyph and the left end of its box, in units: the table `hmtx`.
fn metrics(glyph: usize) -> [f64; 2] {
    let (hmtx, whole) = (table(b"hmtx"), word(table(b"hhea") + 34));
    let advance = word(hmtx + 4 * glyph.min(whole - 1)) as f64;
    let bearing = if glyph < whole { hmtx + 4 * glyph + 2 } else { hmtx + 4 * whole + 2 * (glyph - whole) };
    [advance, signed(bearing)]
}

/// Place of a glyph in the table `glyf`, none for a space.
fn described(glyph: usize) -> Option<usize> {
    assert_eq!(word(table(b"head") + 50), 1, "offsets of 32 bits");
    let [from, to] = [glyph, glyph + 1].map(|k| long(table(b"loca") + 4 * k));
    (from < to).then(|| table(b"glyf") + from)
}

/// Contours of a glyph as its points, in units.
fn contours(glyph: usize) -> Vec<Vec<Point>> {
    let Some(at) = described(glyph) else { return Vec::new() };
    if signed(at) < 0.0 { parts(at + 10) } else { simple(at + 10, word(at)) }
}

/// Contours from their description: ends, instructions, flags, steps along x and along y.
fn simple(at: usize, number: usize) -> Vec<Vec<Point>> {
    let ends: Vec<usize> = (0..number).map(|k| word(at + 2 * k)).collect();
    let count = ends.last().unwrap() + 1;
    let mut at = at + 2 * number;
    at += 2 + word(at);
    let mut flags = Vec::new();
    while flags.len() < count {
        let repeats = if byte(at) & 8 == 0 { 0 } else { byte(at + 1) };
        flags.extend(vec![byte(at); 1 + repeats]);
        at += if byte(at) & 8 == 0 { 1 } else { 2 };
    }
    let mut steps = |short: usize, same: usize| {
        let mut sum = 0.0;
        let step = |&flag: &usize| {
            let (step, bytes) = match (flag & short != 0, flag & same != 0) {
                (true, positive) => (if positive { 1.0 } else { -1.0 } * byte(at) as f64, 1),
                (false, true) => (0.0, 0),
                (false, false) => (signed(at), 2),
            };
            at += bytes;
            sum += step;
            sum
        };
        flags.iter().map(step).collect::<Vec<f64>>()
    };
    let (x, y) = (steps(2, 16), steps(4, 32));
    let points: Vec<Point> = (0..count).map(|k| ([x[k], y[k]], flags[k] & 1 == 1)).collect();
    let starts = [0].into_iter().chain(ends.iter().map(|end| end + 1));
    starts.zip(&ends).map(|(start, &end)| points[start..=end].to_vec()).collect()
}

/// Contours of a glyph that is made of others, each moved.
fn parts(mut at: usize) -> Vec<Vec<Point>> {
    let mut all = Vec::new();
    loop {
        let flags = word(at);
        assert_eq!(flags & (2 | 8 | 64 | 128), 2, "moved, not scaled");
        let (offset, bytes) = if flags & 1 == 1 {
            ([signed(at + 4), signed(at + 6)], 8)
        } else {
            ([4, 5].map(|k| f64::from(FILE[at + k] as i8)), 6)
        };
        let moved = |(point, on_curve): Point| ([0, 1].map(|k| point[k] + offset[k]), on_curve);
        all.extend(contours(word(at + 2)).into_iter().map(|points| points.into_iter().map(moved).collect()));
        at += bytes;
        if flags & 32 == 0 {
            return all;
        }
    }
}

/// A contour as the standard draws it: a point lies on the curve between two that do not; it begins with the first or else with the
/// last that does.
fn drawn(points: &[Point]) -> Vec<Segment> {
    let mut all = Vec::new();
    for (k, &(point, on_curve)) in points.iter().enumerate() {
        let (next, next_on_curve) = points[(k + 1) % points.len()];
        all.push((point, on_curve));
        if !on_curve && !next_on_curve {
            all.push(([0, 1].map(|k| (point[k] + next[k]) / 2.0), true));
        }
    }
    if !all[0].1 {
        all.rotate_right(1);
    }
    let begin = all[0].0;
    let mut segments = vec![Segment::Move(begin)];
    for (k, &(point, on_curve)) in all.iter().enumerate().skip(1) {
        match (all[k - 1].1, on_curve) {
            (true, true) => segments.push(Segment::Line(point)),
            (true, false) => segments.push(Segment::Parabola(point, all[(k + 1) % all.len()].0)),
            (false, _) => {}
        }
    }
    segments.push(Segment::Line(begin));
    segments
}

/// A segment with its points measured from another place, in units of the size.
fn scaled(segment: Segment, shift: f64) -> Segment {
    let place = |[x, y]: [f64; 2]| [(x + shift) / EM, y / EM];
    match segment {
        Segment::Move(to) => Segment::Move(place(to)),
        Segment::Line(to) => Segment::Line(place(to)),
        Segment::Parabola(aside, to) => Segment::Parabola(place(aside), place(to)),
    }
}

#[test]
fn every_letter_has_the_glyph_of_the_published_file_and_others_have_the_box() {
    let published = letters();
    assert_eq!(published.len(), 5906);
    for letter in '\0'..=char::MAX {
        let expected = published.get(&u32::from(letter)).copied().unwrap_or_default();
        assert_eq!(usize::from(glyph(letter).0), expected, "{letter:?}");
    }
    assert_eq!(glyph('語'), Glyph::MISSING);
}

#[test]
fn every_glyph_of_a_letter_has_the_width_and_the_outline_of_the_published_file() {
    assert_eq!(word(table(b"head") + 18) as f64, EM);
    for index in letters().into_values().chain([0]) {
        let glyph = Glyph(index as u16);
        let [width, bearing] = metrics(index);
        assert_eq!(advance(glyph), width / EM, "{index}");
        let Some(at) = described(index) else {
            assert_eq!((outline(glyph).len(), bounds(glyph)), (0, None), "{index}");
            continue;
        };
        // A few outlines stand a unit beside the left end of their box that `hmtx` names, which counts.
        let shift = bearing - signed(at + 2);
        let segments: Vec<Segment> =
            contours(index).iter().flat_map(|points| drawn(points)).map(|segment| scaled(segment, shift)).collect();
        assert_eq!(outline(glyph), segments, "{index}");
        let points = || contours(index).into_iter().flatten().map(|([x, y], _)| [(x + shift) / EM, y / EM]);
        let from = points().reduce(|from, point| [0, 1].map(|k| from[k].min(point[k]))).unwrap();
        let to = points().reduce(|to, point| [0, 1].map(|k| to[k].max(point[k]))).unwrap();
        assert_eq!(bounds(glyph), (from[0] < to[0]).then_some([from, to]), "{index}");
    }
}

#[test]
fn pairs_are_moved_together_as_the_published_file_says() {
    let kern = table(b"kern") + 4;
    assert_eq!([word(kern - 2), word(kern + 4)], [1, 1], "one table of pairs, format 0, along the line");
    let pairs = (0..word(kern + 6)).map(|k| kern + 14 + 6 * k);
    let published: BTreeMap<[u16; 2], f64> =
        pairs.map(|at| ([at, at + 2].map(|at| word(at) as u16), signed(at + 4))).collect();
    assert_eq!(published[&['A', 'V'].map(|letter| glyph(letter).0)], -131.0);
    let firsts: BTreeSet<u16> = published.keys().map(|pair| pair[0]).collect();
    for first in firsts.into_iter().chain([0, glyph('n').0]) {
        for second in letters().into_values().map(|index| index as u16) {
            let expected = published.get(&[first, second]).copied().unwrap_or_default() / EM;
            assert_eq!(kerning(Glyph(first), Glyph(second)), expected, "{first} {second}");
        }
    }
}

#[test]
fn every_sign_of_the_pictures_has_a_glyph() {
    for letter in "p̄δσντχρθ₀₁₂₃₉ₘ⁰¹²³⁴⁵⁶⁷⁸⁹⁻₋−–×·√Åµ°∞≈≤".chars()
    {
        assert_ne!(glyph(letter), Glyph::MISSING, "{letter} is missing");
    }
}
