//! The two boundaries that a contact may have.

/// A boundary of a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Rim {
    /// The outer boundary.
    Outer,
    /// The boundary of the hole of a ring.
    Hole,
}

impl Rim {
    /// Sign of the component of the outward normal along the radius.
    pub fn sign(self) -> f64 {
        match self {
            Self::Outer => 1.0,
            Self::Hole => -1.0,
        }
    }
}
