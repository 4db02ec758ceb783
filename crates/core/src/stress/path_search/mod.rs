//! The search for the largest measures of fatigue of a body: in each material over all lines of a path and all depths, and on each
//! interface.
//!
//! 1. **Planes** at depths that are denser towards the faces of each material, both sides of each interface among them: on each the
//!    [measures](super::path_measure) along every one of its `lines`. They are the map of damage too.
//! 2. **Between**: the `contenders`. From the largest values over the depths on, parabolas in depth lead to further planes, until they
//!    promise no more; across the lines the top is that of a parabola. The best plane of a range is read once more on denser lines and
//!    places.
//! 3. **Errors** as those of the largest stresses ([`super::maxima::Maxima::with_errors`]), in `stated_value`: from the value at the same
//!    depth on the next coarser grid, and by the samples along the radius of the smallest spot. Past an isolated contact the line of the
//!    value is followed beyond the window, in `followed_path`.
//!
//! The results are the [`PathPeaks`] of a `pass`. Within two samples of the surface the values are those of the samples. On the surface
//! the states just outside the edges of contact belong to the lines nearest to them.

mod contenders;
mod followed_path;
mod in_place;
mod lines;
mod pass;
mod peaks;
mod stated_value;

pub use pass::{Others, PassOver};
pub use peaks::{PathPeak, PathPeaks};

use super::field::StressField;
use super::path_measure::PathMeasure;
use super::range_map::completed;
use super::range_plane::{RangePlane, on_common_lines};
use super::sliding_path::SlidingPath;
use crate::body::{Depth, Durability, Fatigue, Interface, Layer};
use contenders::Best;
use lines::SearchedLines;
use pass::PathSearch;
use peaks::MaterialPeaks;
use stated_value::largest;

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
        let stays = !pass.others.moments.is_empty();
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
        let path = if stays { SlidingPath::InPlace } else { lines.path };
        Some(PathPeaks { path, materials, interfaces, planes: on_common_lines(planes) })
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
