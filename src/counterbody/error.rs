/// Why a counterbody cannot be built from its parts.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CounterbodyError {
    /// A number of levels that differs from the lattice's.
    #[error("the lattice has sites for {sites} levels, not {levels}: give one level for each")]
    Levels {
        /// Number of levels of the lattice.
        sites: usize,
        /// Number of levels given.
        levels: usize,
    },
    /// A topography without samples.
    #[error("a topography of {0} × {1} heights is empty: give at least one height along each cell vector")]
    Empty(usize, usize),
    /// A height that is not finite.
    #[error("the height at [{}, {}] of a topography must be finite, not {value}", .place[0], .place[1])]
    Height {
        /// Indices of the height along a₁ and a₂.
        place: [usize; 2],
        /// The value given.
        value: f64,
    },
}
