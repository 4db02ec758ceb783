//! A pass of the counterbody over the path of a body, and what the searches on its lines share.

use crate::stress::field::StressField;
use crate::stress::sliding_path::SlidingLines;

/// A pass on the path of a body.
#[derive(Debug, Clone, Default)]
pub struct PassOver<'a> {
    /// Length of one way of the counterbody over a lattice, a length; `None`: one period. Past an isolated contact a point comes once.
    pub way: Option<f64>,
    /// Other stresses that points of the body meet.
    pub others: Others<'a>,
    /// The same on the next coarser grid.
    pub coarser: Others<'a>,
}

/// Stresses that points of a body meet in a pass besides those of a field, on its grid.
#[derive(Debug, Clone, Default)]
pub struct Others<'a> {
    /// Stresses on the way back, where the counterbody goes to and fro.
    pub back: Option<&'a StressField>,
    /// Stresses at the other steps of a cycle in which points stay in place, in their order; empty where the counterbody slides.
    pub moments: Vec<&'a StressField>,
}

/// Parameters that the searches share.
pub(super) struct PathSearch<'a> {
    pub lines: SlidingLines,
    pub direction: [f64; 2],
    pub radii: [f64; 2],
    pub coarser: Option<&'a StressField>,
    /// Times that a pass goes along the path, in one way.
    pub times: f64,
    pub pass: PassOver<'a>,
    pub goes_on: &'a dyn Fn() -> bool,
}
