//! The lines of a path on a plane of constant depth: the stresses along each, and the measures of fatigue by them.
//!
//! Lines go on in the windows around an isolated contact. On the surface the states just outside the edges of contact belong to the lines
//! nearest to them.

use super::in_place::measured;
use super::pass::{Others, PathSearch};
use crate::body::{Depth, Side};
use crate::numeric::parallel;
use crate::stress::field::StressField;
use crate::stress::line_around::PlaneAround;
use crate::stress::line_path::{LinePath, LineValue};
use crate::stress::line_plane::{Kept, LinePlane, LineStresses};
use crate::stress::path_measure::PathMeasure;
use crate::stress::sliding_path::{SlidingLines, SlidingPath};
use crate::stress::tensor::StressState;

/// Measures along the lines of a plane.
#[derive(Debug)]
pub(super) struct SearchedLines {
    pub depth: Depth,
    /// y of each line, ascending.
    pub y: Vec<f64>,
    /// Values of the measures on each line.
    pub values: Vec<Vec<LineValue>>,
    pub is_smooth: bool,
}

/// y and number of a line, and the states on edges of contact that belong to it, with their places.
type NumberedLine = (f64, usize, Vec<([f64; 2], StressState)>);

/// Numbered lines of a plane, y ascending, with their plane.
pub(super) struct NumberedLines {
    pub plane: LinePlane,
    lines: Vec<NumberedLine>,
    /// The planes around the window of an isolated contact, on which lines go on.
    around: Vec<PlaneAround>,
}

impl StressField {
    /// Whether the contact passes over it: a counterbody stays below it.
    fn is_swept(&self) -> bool {
        self.half_space().side() != Some(Side::Counterbody)
    }

    /// Measures along all lines of a plane on the grid of the search.
    pub(super) fn own_lines(&self, depth: Depth, measures: &[PathMeasure], search: &PathSearch<'_>) -> SearchedLines {
        self.searched_lines(depth, measures, search, (&search.pass.others, false))
    }

    /// Measures along all lines of a plane, with `others` of the stresses that its points meet; `finely`: on denser lines and places.
    pub(super) fn searched_lines(
        &self,
        depth: Depth,
        measures: &[PathMeasure],
        search: &PathSearch<'_>,
        (others, finely): (&Others<'_>, bool),
    ) -> SearchedLines {
        let kept = match others.moments[..] {
            [] => Kept::of(measures, finely),
            _ => Kept { stress: true, finely, ..Kept::default() },
        };
        let (lines, times) = (&search.lines, search.times);
        let all = self.numbered_lines(depth, search, kept);
        let back = others.back.map(|back| (back, back.numbered_lines(depth, search, kept)));
        let planes = others.moments.iter().map(|field| field.line_plane(lines, depth, search.radii[0], kept));
        let moments: Vec<LinePlane> = planes.collect();
        let along = |number: usize| -> Vec<LineValue> {
            if !moments.is_empty() {
                return all.in_place(&moments, number, self, measures);
            }
            let (stresses, edges) = all.stresses(self, number, lines, kept);
            let path = self.line_path((&all.plane, depth), &stresses, edges, (lines, times));
            let of_back = back.as_ref().map(|(field, all)| (*field, all, all.stresses(field, number, lines, kept)));
            let back = of_back.as_ref().map(|(field, all, (stresses, edges))| {
                field.line_path((&all.plane, depth), stresses, edges.clone(), (lines, times))
            });
            let path = LinePath { back: back.as_ref(), ..path };
            measures.iter().map(|measure| measure.along(&path)).collect()
        };
        let values = parallel::map(all.lines.len(), along);
        SearchedLines {
            depth,
            y: all.lines.iter().map(|line| line.0).collect(),
            values,
            is_smooth: all.plane.is_smooth,
        }
    }

    /// The path of the stresses along a line of a plane, those on edges of contact behind the others.
    pub(super) fn line_path<'a>(
        &self,
        (plane, depth): (&LinePlane, Depth),
        stresses: &'a LineStresses,
        edges: Vec<f64>,
        (lines, times): (&SlidingLines, f64),
    ) -> LinePath<'a> {
        let ordered = stresses.places.len() - edges.len();
        LinePath {
            stresses,
            path: lines.path,
            ordered,
            border: [0, ordered.saturating_sub(1)],
            run: if lines.path == SlidingPath::FromFarAway { ordered } else { lines.run(plane.points) },
            edges,
            times,
            back: None,
            is_smooth: plane.is_smooth,
            rest: self.at_rest(depth.material),
            is_swept: self.is_swept(),
        }
    }

    /// The lines of a plane, y ascending, with the states on edges of contact that belong to them.
    pub(super) fn numbered_lines(&self, depth: Depth, search: &PathSearch<'_>, kept: Kept) -> NumberedLines {
        let (cell, lines) = (self.grid().cell(), &search.lines);
        let plane = self.line_plane(lines, depth, search.radii[0], kept);
        let edges = if depth == Depth::SURFACE { self.states_on_edges() } else { Vec::new() };
        let period = lines.period_across();
        let number = |line: usize| {
            let y = lines.y(plane.first_place(cell, line)?);
            Some((period.map_or(y, |period| y.rem_euclid(period)), line, Vec::new()))
        };
        let mut all: Vec<NumberedLine> = (0..plane.count()).filter_map(number).collect();
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (place, state) in edges {
            let away = |y: f64| {
                let away = lines.y(place) - y;
                period.map_or(away, |period| away - period * (away / period).round()).abs()
            };
            // The first of equally near lines.
            let nearest = all.iter_mut().min_by(|a, b| away(a.0).total_cmp(&away(b.0)));
            nearest.into_iter().for_each(|(_, _, on_edges)| on_edges.push((place, state)));
        }
        NumberedLines { plane, lines: all, around: self.planes_around(search.direction, depth, kept) }
    }
}

impl Kept {
    /// The stresses that some measures need.
    pub(super) fn of(measures: &[PathMeasure], finely: bool) -> Self {
        let has = |wanted: fn(&PathMeasure) -> bool| measures.iter().any(wanted);
        Self {
            tau1: has(|measure| matches!(measure, PathMeasure::Range(_))),
            shear: has(|measure| matches!(measure, PathMeasure::ShearRange(_))),
            stress: has(|measure| matches!(measure, PathMeasure::Crossland(_) | PathMeasure::DangVan(_))),
            finely,
        }
    }
}

impl NumberedLines {
    /// The number of the line nearest to y, across the sliding, of an isolated contact; `None` without lines.
    pub fn nearest(&self, y: f64) -> Option<usize> {
        let away = |line: &NumberedLine| (line.0 - y).abs();
        let numbered = self.lines.iter().enumerate();
        numbered.min_by(|(_, a), (_, b)| away(a).total_cmp(&away(b))).map(|(number, _)| number)
    }

    /// The largest values of measures on a line, by its number among them, of points that stay in place in a cycle with other `moments`.
    fn in_place(
        &self,
        moments: &[LinePlane],
        number: usize,
        field: &StressField,
        measures: &[PathMeasure],
    ) -> Vec<LineValue> {
        let (cell, line) = (field.grid().cell(), self.lines[number].1);
        let states: Vec<LineStresses> =
            moments.iter().chain([&self.plane]).map(|plane| plane.line(cell, line)).collect();
        measures.iter().map(|measure| measured(*measure, &states)).collect()
    }

    /// Stresses along a line, by its place among them, with those on edges of contact behind the others, and where those lie on the path.
    pub fn stresses(
        &self,
        field: &StressField,
        number: usize,
        lines: &SlidingLines,
        kept: Kept,
    ) -> (LineStresses, Vec<f64>) {
        let (y, line, edges) = &self.lines[number];
        let mut hole = field.grid().cell();
        let mut stresses = self.plane.line(hole, *line);
        let positions = edges.iter().map(|&(place, _)| match lines.path {
            SlidingPath::FromFarAway => between_places(&stresses.places, place),
            _ => lines.position(place, *line, self.plane.points),
        });
        let positions: Vec<f64> = positions.collect();
        for plane in &self.around {
            plane.lengthen(&mut stresses, *y, hole);
            hole = plane.cell();
        }
        let before = stresses.outside[0] as f64;
        let positions = positions.into_iter().map(|position| position + before).collect();
        edges.iter().for_each(|&(place, state)| stresses.push(place, state, kept));
        (stresses, positions)
    }
}

/// Position of a place among others on a straight line: the number of the one before it and the part of the way to the
/// next.
fn between_places(places: &[[f64; 2]], [x, y]: [f64; 2]) -> f64 {
    let (Some([first_x, first_y]), Some([last_x, last_y])) = (places.first(), places.last()) else { return 0.0 };
    let along = [last_x - first_x, last_y - first_y];
    let part = ((x - first_x) * along[0] + (y - first_y) * along[1]) / (along[0] * along[0] + along[1] * along[1]);
    let last = places.len().saturating_sub(1) as f64;
    if part.is_finite() { (part * last).clamp(0.0, last) } else { 0.0 }
}
