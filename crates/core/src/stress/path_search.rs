//! The search for the largest measures of fatigue of a body: in each material over all lines of a path and all depths, and on each
//! interface.
//!
//! 1. **Planes** at depths that are denser towards the faces of each material, both sides of each interface among them: on each the
//!    measures along every line ([`super::path_measure`]). They are the map of damage too.
//! 2. **Between**: from the largest values over the depths on, parabolas in depth lead to further planes, until they promise no
//!    more; across the lines the top is that of a parabola. The best plane of a range is read once more on denser lines and places.
//! 3. **Errors** as those of the largest stresses ([`super::maxima::Maxima::with_errors`]): from the value at the same depth on the
//!    next coarser grid, and by the samples along the radius of the smallest spot.
//!
//! Within two samples of the surface the values are those of the samples. On the surface the states just outside the edges of contact
//! belong to the lines nearest to them.

use super::beyond_window::{FollowedLine, far_states};
use super::constants::{
    CHANGE_SAFETY, DEEP_SHEAR_ERROR, EXACT_ERROR, MISSED_BY_SAMPLES, RISE_BETWEEN_PLANES, SHALLOW_ERROR,
};
use super::field::StressField;
use super::line_around::PlaneAround;
use super::line_path::{LinePath, LineValue};
use super::line_plane::{Kept, LinePlane, LineStresses};
use super::path_measure::PathMeasure;
use super::plane_search::SEARCH_REACH;
use super::range_map::completed;
use super::range_plane::{RangePlane, on_common_lines};
use super::sliding_path::{SlidingLines, SlidingPath};
use super::tensor::StressState;
use crate::body::{Depth, Durability, Fatigue, Interface, Layer, Side};
use crate::numeric::parallel;
use crate::numeric::search::first_largest;

/// Largest number of further planes of one maximum.
const MAX_PLANES: usize = 8;
/// Part of a value that a further plane must promise.
const LEAST_RISE: f64 = 2e-5;
/// Part of a value that the search between planes, lines and places leaves open, with sixteen places to a radius.
const LEFT_OPEN: f64 = 2e-4;
/// Part of a utilisation that the search leaves open: utilisations are not read once more on denser lines and places.
const LEFT_OPEN_OF_UTILISATIONS: f64 = 8e-4;

/// Measures that are searched.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PathSought {
    /// Measures of laws of fatigue.
    pub fatigue: bool,
    /// Measures of endurance limits.
    pub endurance: bool,
    /// Planes of the ranges between which damage is known.
    pub map: bool,
}

impl PathSought {
    /// All measures, without a map.
    pub const ALL: Self = Self { fatigue: true, endurance: true, map: false };
}

/// A pass on the path of a body.
#[derive(Debug, Clone, Copy, Default)]
pub struct PassOver<'a> {
    /// Length of one way of the counterbody over a lattice, a length; `None`: one period. Past an isolated contact a point comes once.
    pub way: Option<f64>,
    /// Stresses on the way back, where the counterbody goes to and fro.
    pub back: Option<&'a StressField>,
    /// Stresses on the way back on the next coarser grid.
    pub coarser_back: Option<&'a StressField>,
}

/// A largest measure and its place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathPeak {
    /// The value: a pressure, or a utilisation.
    pub value: f64,
    /// Estimated error of the value; `None` without a coarser grid.
    pub error: Option<f64>,
    /// Place x, y, z; lengths.
    pub position: [f64; 3],
}

/// Largest measures in a material.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MaterialPeaks {
    /// Range of τ₁, of a material with fatigue.
    pub range: Option<PathPeak>,
    /// Utilisation of Crossland's criterion, of a material with endurance limits.
    pub crossland: Option<PathPeak>,
    /// Utilisation of Dang Van's criterion, of a material with endurance limits.
    pub dang_van: Option<PathPeak>,
}

/// Largest measures of fatigue of a body.
#[derive(Debug, Clone, PartialEq)]
pub struct PathPeaks {
    pub(crate) path: SlidingPath,
    /// Peaks of each material, from the surface down.
    pub materials: Vec<MaterialPeaks>,
    /// Range of the shear traction of each interface with fatigue, from the surface down.
    pub interfaces: Vec<Option<PathPeak>>,
    /// Planes of the materials with fatigue, all with the same lines.
    pub planes: Vec<RangePlane>,
}

impl PathPeaks {
    /// Every peak.
    pub fn each(&mut self) -> impl Iterator<Item = &mut PathPeak> {
        self.materials.iter_mut().flat_map(MaterialPeaks::each).chain(self.interfaces.iter_mut().flatten())
    }

    /// Every peak of the material at the surface.
    pub fn in_surface(&mut self) -> impl Iterator<Item = &mut PathPeak> {
        self.materials.iter_mut().take(1).flat_map(MaterialPeaks::each)
    }
}

impl MaterialPeaks {
    fn each(&mut self) -> impl Iterator<Item = &mut PathPeak> {
        [&mut self.range, &mut self.crossland, &mut self.dang_van].into_iter().flatten()
    }
}

/// Measures along the lines of a plane.
#[derive(Debug)]
struct SearchedLines {
    depth: Depth,
    /// y of each line, ascending.
    y: Vec<f64>,
    /// Values of the measures on each line.
    values: Vec<Vec<LineValue>>,
    is_smooth: bool,
}

/// y and number of a line, and the states on edges of contact that belong to it, with their places.
type NumberedLine = (f64, usize, Vec<([f64; 2], StressState)>);

/// Numbered lines of a plane, y ascending, with their plane.
struct NumberedLines {
    plane: LinePlane,
    lines: Vec<NumberedLine>,
    /// The planes around the window of an isolated contact, on which lines go on.
    around: Vec<PlaneAround>,
}

/// The largest value of a measure on a plane, between the lines too.
#[derive(Debug, Clone, Copy)]
struct Best {
    value: f64,
    depth: Depth,
    place: [f64; 2],
    y: f64,
    beyond: f64,
    gain: f64,
}

/// Parameters that the searches share.
struct PathSearch<'a> {
    lines: SlidingLines,
    direction: [f64; 2],
    radii: [f64; 2],
    coarser: Option<&'a StressField>,
    /// Times that a pass goes along the path, in one way.
    times: f64,
    pass: PassOver<'a>,
    goes_on: &'a dyn Fn() -> bool,
}

impl StressField {
    /// The largest measures of fatigue along a `direction` of sliding, a unit vector. `radii`: the smallest and the largest contact
    /// radius, lengths. Errors are those by the `coarser` field. `None` when `goes_on`, called between planes, returns false.
    pub fn path_peaks_while(
        &self,
        direction: [f64; 2],
        radii: [f64; 2],
        sought: PathSought,
        coarser: Option<&Self>,
        goes_on: &dyn Fn() -> bool,
    ) -> Option<PathPeaks> {
        self.path_peaks_of_pass(direction, radii, (sought, PassOver::default()), coarser, goes_on)
    }

    /// The largest measures of fatigue of a pass, as [`Self::path_peaks_while`].
    pub(crate) fn path_peaks_of_pass(
        &self,
        direction: [f64; 2],
        radii: [f64; 2],
        (sought, pass): (PathSought, PassOver<'_>),
        coarser: Option<&Self>,
        goes_on: &dyn Fn() -> bool,
    ) -> Option<PathPeaks> {
        let lines = self.sliding_lines(direction);
        let times = pass.way.zip(lines.period()).map_or(1.0, |(way, period)| way / period);
        // Where the path never closes a line stands for all of them, as much of it as the period is long.
        let times = times * lines.period().map_or(1.0, |period| period / lines.length());
        let search = PathSearch { lines, direction, radii, coarser, times, pass, goes_on };
        let (mut materials, mut interfaces, mut planes) = (Vec::new(), Vec::new(), Vec::new());
        for (number, durability) in (1..).zip(self.half_space().durabilities()) {
            let measures = measures(durability, sought);
            let (peaks, searched) = self.in_material(number, &measures, &search)?;
            let of = |wanted: fn(&PathMeasure) -> bool| {
                measures.iter().zip(&peaks).find(|(measure, _)| wanted(measure)).map(|(_, peak)| *peak)
            };
            materials.push(MaterialPeaks {
                range: of(|measure| matches!(measure, PathMeasure::Range(_))),
                crossland: of(|measure| matches!(measure, PathMeasure::Crossland(_))),
                dang_van: of(|measure| matches!(measure, PathMeasure::DangVan(_))),
            });
            let ranges = |plane: SearchedLines| {
                let values = plane.values.iter().zip(&plane.y).map(|(line, &y)| [y, line[0].value]);
                RangePlane { depth: plane.depth, lines: values.collect(), period: lines.period_across() }
            };
            if let Some(law) = durability.fatigue.filter(|_| sought.fatigue) {
                let known = searched.into_iter().map(ranges).collect();
                let measure = [PathMeasure::Range(law.exponent())];
                let read = |depth: Depth| goes_on().then(|| ranges(self.own_lines(depth, &measure, &search)));
                planes.extend(if sought.map { completed(known, law.exponent(), &read)? } else { known });
            }
            if let Some(layer) = self.half_space().layers().get(number - 1) {
                let fatigue = transmitted(layer).filter(|_| sought.fatigue);
                interfaces.push(match fatigue {
                    Some(law) => Some(self.on_interface(number, law, &search)?),
                    None => None,
                });
            }
        }
        Some(PathPeaks { path: lines.path, materials, interfaces, planes: on_common_lines(planes) })
    }

    /// Whether the contact passes over it: a counterbody stays below it.
    fn is_swept(&self) -> bool {
        self.half_space().side() != Some(Side::Counterbody)
    }

    /// The largest of each measure in a material, and the planes searched; `None` when the search does not go on.
    fn in_material(
        &self,
        material: usize,
        measures: &[PathMeasure],
        search: &PathSearch<'_>,
    ) -> Option<(Vec<PathPeak>, Vec<SearchedLines>)> {
        if measures.is_empty() {
            return Some((Vec::new(), Vec::new()));
        }
        let depths = self.search_depths(material, search.radii);
        self.read_ahead(depths.iter().map(|&z| Depth { z, material }));
        let plane = |&z: &f64| (search.goes_on)().then(|| self.own_lines(Depth { z, material }, measures, search));
        let planes: Vec<SearchedLines> = depths.iter().map(plane).collect::<Option<_>>()?;
        let mut peaks = Vec::new();
        for (number, &measure) in measures.iter().enumerate() {
            let known: Vec<Best> = planes.iter().map(|plane| self.best(plane, number, search)).collect();
            let contenders = self.contenders(&known, measure, search)?;
            let mut stated = Vec::new();
            for best in contenders {
                if !(search.goes_on)() {
                    return None;
                }
                stated.push(self.stated(best, measure, search));
            }
            peaks.push(largest(&stated));
        }
        Some((peaks, planes))
    }

    /// The largest range of the shear traction that an interface transmits.
    fn on_interface(&self, number: usize, law: Fatigue, search: &PathSearch<'_>) -> Option<PathPeak> {
        if !(search.goes_on)() {
            return None;
        }
        let depth = Depth { z: self.half_space().faces(number).1, material: number };
        let measure = PathMeasure::ShearRange(law.exponent());
        let best = self.finely(depth, measure, search);
        Some(largest(&[self.stated(best, measure, search)]))
    }

    /// Measures along all lines of a plane on the grid of the search.
    fn own_lines(&self, depth: Depth, measures: &[PathMeasure], search: &PathSearch<'_>) -> SearchedLines {
        self.searched_lines(depth, measures, search, (search.pass.back, false))
    }

    /// The largest value of a measure on a plane, read on lines and places that are denser.
    fn finely(&self, depth: Depth, measure: PathMeasure, search: &PathSearch<'_>) -> Best {
        self.best(&self.searched_lines(depth, &[measure], search, (search.pass.back, true)), 0, search)
    }

    /// Measures along all lines of a plane, where the counterbody goes to and fro with the stresses `back`; `finely`: on denser
    /// lines and places.
    fn searched_lines(
        &self,
        depth: Depth,
        measures: &[PathMeasure],
        search: &PathSearch<'_>,
        (back, finely): (Option<&Self>, bool),
    ) -> SearchedLines {
        let kept = Kept::of(measures, finely);
        let (lines, times) = (&search.lines, search.times);
        let all = self.numbered_lines(depth, search, kept);
        let back = back.map(|back| (back, back.numbered_lines(depth, search, kept)));
        let along = |number: usize| -> Vec<LineValue> {
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
    fn line_path<'a>(
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
    fn numbered_lines(&self, depth: Depth, search: &PathSearch<'_>, kept: Kept) -> NumberedLines {
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

    /// The largest value of a measure, by its number, on a plane.
    fn best(&self, plane: &SearchedLines, measure: usize, search: &PathSearch<'_>) -> Best {
        let most = first_largest(plane.values.iter().map(|values| values[measure].value)).map_or(0, |(line, _)| line);
        self.between_lines(plane, measure, most, search)
    }

    /// The largest value of a measure beside a line that has the largest one of its neighbours.
    fn between_lines(&self, plane: &SearchedLines, measure: usize, line: usize, search: &PathSearch<'_>) -> Best {
        let n = plane.y.len();
        let Some(middle) = plane.values.get(line).map(|values| values[measure]) else {
            return Best { value: 0.0, depth: plane.depth, place: [0.0; 2], y: 0.0, beyond: 0.0, gain: 1.0 };
        };
        let is_closed = search.lines.is_closed();
        let beside = if plane.is_smooth && n >= 3 && (is_closed || (0 < line && line + 1 < n)) {
            [(line + n - 1) % n, (line + 1) % n].map(|next| plane.values[next][measure].value)
        } else {
            [f64::NEG_INFINITY; 2]
        };
        let (rise, offset) = vertex([-1.0, 0.0, 1.0], [beside[0], middle.value, beside[1]])
            .map_or((0.0, 0.0), |(t, value)| (value - middle.value, t));
        let step = search
            .lines
            .period_across()
            .map_or_else(|| plane.y.get(1).map_or(0.0, |y| y - plane.y[0]), |period| period / n as f64);
        let moved = offset * step;
        let [ex, ey] = search.direction;
        let place = [middle.place[0] - moved * ey, middle.place[1] + moved * ex];
        Best {
            value: middle.value + rise.max(0.0),
            depth: plane.depth,
            place,
            y: plane.y[line] + moved,
            beyond: middle.beyond,
            gain: middle.gain,
        }
    }

    /// Values that may be the largest of a material: on its faces, near the surface, and at the maxima over its depths.
    fn contenders(&self, known: &[Best], measure: PathMeasure, search: &PathSearch<'_>) -> Option<Vec<Best>> {
        let near = self.shallow_depth();
        let is_shallow = |best: &&Best| best.depth.z < near;
        let shallow = known.iter().filter(is_shallow).copied();
        let mut all: Vec<Best> = shallow.reduce(|a, b| if b.value > a.value { b } else { a }).into_iter().collect();
        let mut deep: Vec<Best> = known.iter().filter(|best| !is_shallow(best)).copied().collect();
        let most = deep.iter().map(|best| best.value).fold(f64::NEG_INFINITY, f64::max);
        let starts: Vec<f64> = (0..deep.len())
            .filter(|&i| {
                let beside = [i.checked_sub(1), Some(i + 1)].into_iter().flatten().filter_map(|j| deep.get(j));
                let value = deep[i].value;
                let drop = beside.clone().map(|neighbour| value - neighbour.value).fold(0.0, f64::max);
                let is_near = value + RISE_BETWEEN_PLANES * drop + MISSED_BY_SAMPLES * most.abs() >= most;
                // The first of equal depths.
                let is_first = i.checked_sub(1).is_none_or(|before| deep[before].value < value);
                is_near && is_first && beside.into_iter().all(|neighbour| neighbour.value <= value)
            })
            .map(|i| deep[i].depth.z)
            .collect();
        for start in starts {
            let best = self.between_depths(&mut deep, start, measure, search)?;
            all.push(match measure {
                PathMeasure::Range(_) if (search.goes_on)() => self.finely(best.depth, measure, search),
                _ => best,
            });
        }
        Some(all)
    }

    /// The largest value near a depth `start`, by further planes, which are added to the known ones.
    fn between_depths(
        &self,
        known: &mut Vec<Best>,
        start: f64,
        measure: PathMeasure,
        search: &PathSearch<'_>,
    ) -> Option<Best> {
        let mut at = known.iter().position(|peak| peak.depth.z == start).unwrap_or(0);
        for _ in 0..MAX_PLANES {
            let middle = at.clamp(1, known.len().saturating_sub(2).max(1));
            let Some(three) = known.get(middle - 1..middle + 2) else { break };
            let (z, values) = ([0, 1, 2].map(|k| three[k].depth.z), [0, 1, 2].map(|k| three[k].value));
            let Some((next, promised)) = vertex(z, values) else { break };
            // Depths that are as near as this have the same value.
            let least = 1e-3 * (z[2] - z[0]);
            if promised - known[at].value <= LEAST_RISE * known[at].value.abs()
                || z.iter().any(|z| (z - next).abs() < least)
            {
                break;
            }
            if !(search.goes_on)() {
                return None;
            }
            let depth = Depth { z: next, material: known[at].depth.material };
            let best = self.best(&self.own_lines(depth, &[measure], search), 0, search);
            let place = known.partition_point(|peak| peak.depth.z < next);
            known.insert(place, best);
            at = match best.value > known[if place <= at { at + 1 } else { at }].value {
                true => place,
                false if place <= at => at + 1,
                false => at,
            };
        }
        Some(known[at])
    }

    /// A value with the path beyond the window of an isolated contact, and its error.
    fn stated(&self, best: Best, measure: PathMeasure, search: &PathSearch<'_>) -> (Best, Option<f64>) {
        let followed = (best.beyond > 0.0).then(|| self.followed(&best, measure, search)).flatten();
        let (rise, beyond) = followed.unwrap_or((0.0, best.beyond));
        let error = self.error(&Best { beyond, ..best }, measure, search);
        (Best { value: best.value + rise, beyond, ..best }, error)
    }

    /// Rise of a value by the path beyond the window of an isolated contact, and by how much stresses farther away may change it, a
    /// pressure.
    fn followed(&self, best: &Best, measure: PathMeasure, search: &PathSearch<'_>) -> Option<(f64, f64)> {
        let kept = Kept::of(&[measure], false);
        let follow = |field: &Self| {
            let all = field.numbered_lines(best.depth, search, kept);
            let (stresses, edges) = all.stresses(field, all.nearest(best.y)?, &search.lines, kept);
            let far =
                far_states(&field.far_fields(), best.depth, &stresses.places[..stresses.places.len() - edges.len()]);
            Some((all.plane, FollowedLine::new((stresses, edges), &far, kept)?))
        };
        let (line, back) = (follow(self)?, search.pass.back.and_then(|back| Some((back, follow(back)?))));
        let value = |is_far: bool| {
            let back = back.as_ref().map(|(field, line)| field.followed_path(line, best.depth, is_far, search));
            let path = self.followed_path(&line, best.depth, is_far, search);
            measure.along(&LinePath { back: back.as_ref(), ..path })
        };
        let [within, far] = [false, true].map(value);
        Some((far.value - within.value, far.beyond))
    }

    /// The path along a followed line of a plane, within the window or beyond it too.
    fn followed_path<'a>(
        &self,
        (plane, line): &'a (LinePlane, FollowedLine),
        depth: Depth,
        is_far: bool,
        search: &PathSearch<'_>,
    ) -> LinePath<'a> {
        let (stresses, edges) = line.stresses(is_far);
        let path = self.line_path((plane, depth), stresses, edges.clone(), (&search.lines, search.times));
        if is_far { LinePath { border: line.border, ..path } } else { path }
    }

    /// Estimated error of a value; `None` without a coarser grid.
    fn error(&self, best: &Best, measure: PathMeasure, search: &PathSearch<'_>) -> Option<f64> {
        let coarser = search.coarser?;
        let plane = coarser.searched_lines(best.depth, &[measure], search, (search.pass.coarser_back, false));
        let coarse = coarser.beside(&plane, best.y, search);
        let field = self.holding(best.place);
        let state = field.stresses_at(&field.depth_response(best.depth, SEARCH_REACH), &[best.place]);
        let size = state.first().map_or(0.0, |state| self.size_of_waves(best.depth, state));
        let resolution = self.regions().least_resolution();
        let is_near = best.depth.z < self.shallow_depth();
        let open = match is_near {
            true => SHALLOW_ERROR / resolution,
            false if self.regions().is_exact() => EXACT_ERROR,
            false => DEEP_SHEAR_ERROR / resolution.powi(2),
        };
        let ringing = if is_near { self.regions().ringing() } else { 0.0 };
        let left = match measure {
            _ if is_near => 0.0,
            PathMeasure::Crossland(_) | PathMeasure::DangVan(_) => LEFT_OPEN_OF_UTILISATIONS,
            PathMeasure::Range(_) | PathMeasure::ShearRange(_) => LEFT_OPEN,
        };
        let rise = best.gain * measure.rise((open + self.left_out_of_lines()) * size + ringing + best.beyond);
        Some(CHANGE_SAFETY * (best.value - coarse).abs() + rise + left * best.value.abs())
    }

    /// The largest value of the only measure of a plane beside a line at y.
    fn beside(&self, plane: &SearchedLines, y: f64, search: &PathSearch<'_>) -> f64 {
        let away = |line_y: &f64| {
            let away = line_y - y;
            search.lines.period_across().map_or(away, |period| away - period * (away / period).round()).abs()
        };
        let n = plane.y.len();
        let Some(mut line) = (0..n).min_by(|&a, &b| away(&plane.y[a]).total_cmp(&away(&plane.y[b]))) else {
            return 0.0;
        };
        let value = |line: usize| plane.values[line][0].value;
        // Not farther than a few lines: another maximum would be no measure of the error.
        for _ in 0..3 {
            let next = [line.checked_sub(1), Some(line + 1).filter(|&next| next < n)].into_iter().flatten();
            line = next.fold(line, |best, next| if value(next) > value(best) { next } else { best });
        }
        self.between_lines(plane, 0, line, search).value
    }
}

impl Kept {
    /// The stresses that some measures need.
    fn of(measures: &[PathMeasure], finely: bool) -> Self {
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
    fn nearest(&self, y: f64) -> Option<usize> {
        let away = |line: &NumberedLine| (line.0 - y).abs();
        let numbered = self.lines.iter().enumerate();
        numbered.min_by(|(_, a), (_, b)| away(a).total_cmp(&away(b))).map(|(number, _)| number)
    }

    /// Stresses along a line, by its place among them, with those on edges of contact behind the others, and where those lie on the path.
    fn stresses(
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

/// Measures of a material.
fn measures(durability: Durability, sought: PathSought) -> Vec<PathMeasure> {
    let range = durability.fatigue.filter(|_| sought.fatigue).map(|law| PathMeasure::Range(law.exponent()));
    let limits = durability
        .endurance
        .filter(|_| sought.endurance)
        .map(|endurance| [PathMeasure::Crossland(endurance), PathMeasure::DangVan(endurance)]);
    range.into_iter().chain(limits.into_iter().flatten()).collect()
}

/// Fatigue of the lower interface of a layer; `None` where it transmits no shear.
pub fn transmitted(layer: &Layer) -> Option<Fatigue> {
    layer.interface_fatigue().filter(|_| layer.interface() != Interface::Frictionless)
}

/// The largest of values with their errors; its error covers those of the others.
fn largest(all: &[(Best, Option<f64>)]) -> PathPeak {
    let Some((number, value)) = first_largest(all.iter().map(|(best, _)| best.value)) else {
        return PathPeak { value: 0.0, error: None, position: [0.0; 3] };
    };
    let Best { place: [x, y], depth, .. } = all[number].0;
    let tops: Option<Vec<f64>> = all.iter().map(|(best, error)| Some(best.value + (*error)?)).collect();
    let error = tops.map(|tops| tops.into_iter().fold(value, f64::max) - value);
    PathPeak { value, error, position: [x, y, depth.z] }
}

/// Place and value of the top of the parabola through three points, kept within them; `None` where it has none.
fn vertex([a, b, c]: [f64; 3], [of_a, of_b, of_c]: [f64; 3]) -> Option<(f64, f64)> {
    let (left, right) = ((of_b - of_a) / (b - a), (of_c - of_b) / (c - b));
    let bend = (right - left) / (c - a);
    // f = f_b + slope (x − b) + bend (x − b)².
    let slope = left + bend * (b - a);
    if !(bend < 0.0 && bend.is_finite()) {
        return None;
    }
    let place = (b - 0.5 * slope / bend).clamp(a, c);
    Some((place, of_b + (slope + bend * (place - b)) * (place - b)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_top_of_a_parabola_is_found_from_unequal_steps() {
        let value = |x: f64| 3.0 - 2.0 * (x - 0.7) * (x - 0.7);
        let z = [0.1, 0.5, 1.6];
        let (place, top) = vertex(z, z.map(value)).unwrap();
        assert!((place - 0.7).abs() < 1e-14 && (top - 3.0).abs() < 1e-14);
        let (place, _) = vertex([0.8, 0.9, 1.0], [0.8, 0.9, 1.0].map(value)).unwrap();
        assert_eq!(place, 0.8);
        assert_eq!(vertex(z, z.map(|x| x * x)), None);
        assert_eq!(vertex([-1.0, 0.0, 1.0], [f64::NEG_INFINITY, 1.0, f64::NEG_INFINITY]), None);
    }
}
