//! Surroundings of a cell: its periodic images, or nothing.

/// Surroundings of a cell and of the samples in it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Surroundings {
    /// Periodic images of the cell. The mean displacement of a loaded half-space is infinite: displacements have zero mean, a uniform
    /// pressure displaces nothing but layers on a rigid base, and contact may be complete.
    Periodic,
    /// Nothing: the cell is a window, a rectangle of any size around an isolated contact, beyond which the surface is free. Displacements
    /// vanish far away, a uniform pressure displaces too, and contact stays inside.
    FreeSpace,
}

impl Surroundings {
    /// A quantity that is stated for the area of a cell: a mean, a part or a density. `None` around an isolated contact, whose window may
    /// have any size.
    pub fn per_cell<T>(self, quantity: T) -> Option<T> {
        match self {
            Self::Periodic => Some(quantity),
            Self::FreeSpace => None,
        }
    }
}
