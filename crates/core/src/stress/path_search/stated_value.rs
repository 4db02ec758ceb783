//! A largest value as it is stated: with the path beyond the window of an isolated contact, and its error.
//!
//! The error is the change of the value from the next coarser grid, with what the grid, the waves that are left out and the search between
//! planes, lines and places leave open.

use super::contenders::Best;
use super::lines::SearchedLines;
use super::pass::PathSearch;
use super::peaks::PathPeak;
use crate::numeric::search::first_largest;
use crate::stress::constants::{CHANGE_SAFETY, DEEP_SHEAR_ERROR, EXACT_ERROR, SHALLOW_ERROR};
use crate::stress::field::StressField;
use crate::stress::path_measure::PathMeasure;
use crate::stress::plane_search::SEARCH_REACH;

/// Part of a value that the search between planes, lines and places leaves open, with sixteen places to a radius.
const LEFT_OPEN: f64 = 2e-4;
/// Part of a utilisation that the search leaves open: utilisations are not read once more on denser lines and places.
const LEFT_OPEN_OF_UTILISATIONS: f64 = 8e-4;

impl StressField {
    /// A value with the path beyond the window of an isolated contact, and its error.
    pub(super) fn stated(&self, best: Best, measure: PathMeasure, search: &PathSearch<'_>) -> (Best, Option<f64>) {
        let followed = (best.beyond > 0.0).then(|| self.followed(&best, measure, search)).flatten();
        let (rise, beyond) = followed.unwrap_or((0.0, best.beyond));
        let error = self.error(&Best { beyond, ..best }, measure, search);
        (Best { value: best.value + rise, beyond, ..best }, error)
    }

    /// Estimated error of a value; `None` without a coarser grid.
    fn error(&self, best: &Best, measure: PathMeasure, search: &PathSearch<'_>) -> Option<f64> {
        let coarser = search.coarser?;
        let plane = coarser.searched_lines(best.depth, &[measure], search, (&search.pass.coarser, false));
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

/// The largest of values with their errors; its error covers those of the others.
pub(super) fn largest(all: &[(Best, Option<f64>)]) -> PathPeak {
    let Some((number, value)) = first_largest(all.iter().map(|(best, _)| best.value)) else {
        return PathPeak { value: 0.0, error: None, position: [0.0; 3] };
    };
    let Best { place: [x, y], depth, .. } = all[number].0;
    let tops: Option<Vec<f64>> = all.iter().map(|(best, error)| Some(best.value + (*error)?)).collect();
    let error = tops.map(|tops| tops.into_iter().fold(value, f64::max) - value);
    PathPeak { value, error, position: [x, y, depth.z] }
}
