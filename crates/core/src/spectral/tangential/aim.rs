//! What a part of a step comes to: a tangential force, or a shift.

use super::disc::Vector;

/// What the tangential force or the shift comes to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Aim {
    /// A force.
    Force(Vector),
    /// A force over μP.
    Part(Vector),
    /// A shift since the first contact.
    Shift(Vector),
    /// A rise of the shift over the distance rolled.
    Creepage(Vector),
}

impl Aim {
    /// The same kind of aim at nothing.
    pub fn zero(self) -> Self {
        self.with([0.0; 2])
    }

    /// This aim where it is of the kind of another, else nothing of that kind.
    pub fn or_zero(self, other: Self) -> Self {
        if std::mem::discriminant(&self) == std::mem::discriminant(&other) { self } else { other.zero() }
    }

    pub fn vector(self) -> Vector {
        match self {
            Self::Force(vector) | Self::Part(vector) | Self::Shift(vector) | Self::Creepage(vector) => vector,
        }
    }

    pub fn with(self, vector: Vector) -> Self {
        match self {
            Self::Force(_) => Self::Force(vector),
            Self::Part(_) => Self::Part(vector),
            Self::Shift(_) => Self::Shift(vector),
            Self::Creepage(_) => Self::Creepage(vector),
        }
    }
}
