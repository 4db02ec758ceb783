//! The line of a largest value past an isolated contact, followed [beyond the window](crate::stress::beyond_window).

use super::contenders::Best;
use super::pass::PathSearch;
use crate::body::Depth;
use crate::stress::beyond_window::{FollowedLine, far_states};
use crate::stress::field::StressField;
use crate::stress::line_path::LinePath;
use crate::stress::line_plane::{Kept, LinePlane};
use crate::stress::path_measure::PathMeasure;

impl StressField {
    /// Rise of a value by the path beyond the window of an isolated contact, and by how much stresses farther away may change it, a
    /// pressure.
    pub(super) fn followed(&self, best: &Best, measure: PathMeasure, search: &PathSearch<'_>) -> Option<(f64, f64)> {
        let kept = Kept::of(&[measure], false);
        let follow = |field: &Self| {
            let all = field.numbered_lines(best.depth, search, kept);
            let (stresses, edges) = all.stresses(field, all.nearest(best.y)?, &search.lines, kept);
            let far =
                far_states(&field.far_fields(), best.depth, &stresses.places[..stresses.places.len() - edges.len()]);
            Some((all.plane, FollowedLine::new((stresses, edges), &far, kept)?))
        };
        let (line, back) = (follow(self)?, search.pass.others.back.and_then(|back| Some((back, follow(back)?))));
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
}
