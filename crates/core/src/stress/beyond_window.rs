//! The path of a point of the body beyond the window of an isolated contact.
//!
//! Lines are searched as far as [layers bend](super::line_around). The state of rest lies beyond it, and so may the extremes of a measure: the longest chord of the
//! deviator from there, or a hydrostatic stress that is tensile far behind the contact. Stresses fall as r⁻² with the distance r: on the line
//! of a largest value they are read at distances from its middle that are 2^{1/12} apart, in the windows
//! [around](super::surroundings), and what is left beyond the last one is 4^{−k} of the stresses at the border of the window, k their number.

use super::depth_response::DepthResponse;
use super::field::StressField;
use super::line_plane::{Kept, LineStresses};
use super::loaded_window::MOST_WINDOWS;
use super::plane_search::SEARCH_REACH;
use super::tensor::StressState;
use crate::body::Depth;

/// Number of windows around that in which a line is searched: 4⁻⁵ = 1e-3 of the stresses at its border are left.
const WINDOWS: u32 = 5;
/// Places on either side of a line up to twice the distance from its middle.
const PER_OCTAVE: i32 = 12;

/// A state at a place x, y, lengths, with where it lies on a line: the number of the sample before it and a part of the way to the next.
type FarState = (f64, [f64; 2], StressState);

impl StressField {
    /// Fields around the window of an isolated contact, the inner one first.
    pub(super) fn far_fields(&self) -> Vec<&Self> {
        let last = (self.windows_around() + WINDOWS).min(MOST_WINDOWS);
        (1..=last).map_while(|number| self.around(number)).collect()
    }
}

/// States at a depth beyond both ends of a line through a window, in the fields around it. Those before the line have places on it below the first
/// one, those behind above the last one; the farthest come first.
pub(super) fn far_states(around: &[&StressField], depth: Depth, line: &[[f64; 2]]) -> Vec<FarState> {
    let (Some(&first), Some(&last)) = (line.first(), line.last()) else { return Vec::new() };
    let middle = [0, 1].map(|axis| 0.5 * (first[axis] + last[axis]));
    let (count, last_number) = (WINDOWS as i32 * PER_OCTAVE, (line.len() - 1) as f64);
    let responses: Vec<DepthResponse> = around.iter().map(|field| field.depth_response(depth, SEARCH_REACH)).collect();
    let far = |k: i32| {
        let times = 2f64.powf(f64::from(k) / f64::from(PER_OCTAVE));
        let part = f64::from(k) / f64::from(count + 1);
        [(first, -part), (last, last_number + part)].map(|(end, position)| {
            let place = [0, 1].map(|axis| middle[axis] + times * (end[axis] - middle[axis]));
            let number = around.iter().position(|field| field.grid().cell().contains(place))?;
            let state = around[number].stresses_at(&responses[number], &[place])[0];
            Some((position, place, state))
        })
    };
    (1..=count).rev().flat_map(far).flatten().collect()
}

/// A line within the window, and the same with states beyond its ends behind the others.
pub(super) struct FollowedLine {
    /// Stresses, and where those that do not follow the others lie on the line.
    within: (LineStresses, Vec<f64>),
    followed: (LineStresses, Vec<f64>),
    /// Numbers of the farthest states before and behind the window.
    pub border: [usize; 2],
}

impl FollowedLine {
    /// A line with its `far` states; `None` without those.
    pub fn new(within: (LineStresses, Vec<f64>), far: &[FarState], kept: Kept) -> Option<Self> {
        let (mut stresses, mut places) = within.clone();
        let start = stresses.places.len();
        let border = [far.iter().position(|state| state.0 < 0.0)?, far.iter().position(|state| state.0 > 0.0)?];
        for &(position, place, state) in far {
            stresses.push(place, state, kept);
            places.push(position);
        }
        Some(Self { within, followed: (stresses, places), border: border.map(|number| start + number) })
    }

    /// The stresses within the window, or those of the whole line.
    pub fn stresses(&self, is_far: bool) -> &(LineStresses, Vec<f64>) {
        if is_far { &self.followed } else { &self.within }
    }
}
