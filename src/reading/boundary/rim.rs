//! The two boundaries that a contact may have.

/// Which boundary of a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Rim {
    Outer,
    Hole,
}

impl Rim {
    /// Of the outward normal along the radius.
    pub fn sign(self) -> f64 {
        match self {
            Self::Outer => 1.0,
            Self::Hole => -1.0,
        }
    }
}
