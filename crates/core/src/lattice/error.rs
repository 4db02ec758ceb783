//! Why a lattice, or a grid on it, cannot be built.

/// Why a lattice cannot be built.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum LatticeError {
    /// The cell vectors are parallel, zero or not finite.
    #[error("the cell vectors ({}, {}) and ({}, {}) span no area: give two finite ones that are not parallel", .0[0], .0[1], .1[0], .1[1])]
    FlatCell([f64; 2], [f64; 2]),
    /// A grid without points along a cell vector.
    #[error("a grid of {0} × {1} points has none: give at least one along each cell vector")]
    NoPoints(usize, usize),
    /// The number of levels has no standard arrangement on this lattice.
    #[error("a {lattice} lattice has no standard arrangement of {levels} levels (it has one for {standard})")]
    NoStandardSites {
        /// Name of the lattice.
        lattice: &'static str,
        /// Number of levels given.
        levels: usize,
        /// Numbers of levels that have an arrangement.
        standard: &'static str,
    },
    /// A level without any site.
    #[error("level {0} has no site: give at least one, in fractions of the cell vectors")]
    NoSite(usize),
    /// A site of a level that is not finite.
    #[error("a site of level {0} is not finite: give fractions of the cell vectors")]
    Site(usize),
    /// Two levels with an indenter at the same place.
    #[error("levels {0} and {1} have an indenter at the same place: move one, or leave it out")]
    SharedSite(usize, usize),
}
