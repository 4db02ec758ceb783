//! Why a counterbody cannot be built.

/// Why a counterbody cannot be built from its parts.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
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
    /// A ball under a topography whose radius is not positive and finite.
    #[error("a topography stands on a ball of a finite radius greater than 0, not {0}")]
    Ball(f64),
    /// A loaded disc, by its number from 1, with a radius that is not positive, a negative pressure or a number that is not finite.
    #[error("disc {0} must have a finite centre, a radius greater than 0 and a pressure of at least 0")]
    Disc(usize),
    /// A loaded disc without room in its window.
    #[error(
        "disc {disc} must lie within {} and {} of the middle of the window, seven eighths of it: enlarge the window", .room[0], .room[1]
    )]
    OutsideWindow {
        /// Number of the disc, from 1.
        disc: usize,
        /// Largest distances from the middle along x and y, lengths.
        room: [f64; 2],
    },
    /// A given pressure that is not a finite number of at least 0.
    #[error("the pressure at [{}, {}] must be finite and at least 0, not {value}", .place[0], .place[1])]
    Pressure {
        /// Indices of the sample along a₁ and a₂.
        place: [usize; 2],
        /// The value given.
        value: f64,
    },
    /// A given pressure that is zero everywhere.
    #[error("a given pressure must load something: all of it is zero")]
    Unloaded,
}
