//! What the numbers of a key are measured in.

/// What the numbers of a key are measured in. Any consistent units; `[units]` names them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::case) enum Unit {
    /// Nothing, or the key has no numbers.
    Pure,
    Length,
    Pressure,
    /// Of springs.
    PressurePerLength,
    /// Of the coefficient of a power law.
    LengthToOneMinusN,
}

impl Unit {
    /// Its name.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Pure => "none",
            Self::Length => "length, the same in the whole case; units.length names it",
            Self::Pressure => "pressure, as Young's modulus; units.pressure names it",
            Self::PressurePerLength => "pressure per length",
            Self::LengthToOneMinusN => "length to the power 1 − n",
        }
    }

    /// What is measured in it, in a word.
    pub(super) fn quantity(self) -> &'static str {
        match self {
            Self::Pure | Self::LengthToOneMinusN => "number",
            Self::Length => "length",
            Self::Pressure => "pressure",
            Self::PressurePerLength => "pressure per length",
        }
    }
}
