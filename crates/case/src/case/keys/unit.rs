//! Units of the numbers of a key.

/// Unit of the numbers of a key. Any consistent units; `[units]` names them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::case) enum Unit {
    /// A pure number, or a key without numbers.
    Pure,
    Length,
    Pressure,
    /// Unit of forces: a pressure times an area.
    Force,
    /// Unit of coefficients of wear.
    PerPressure,
    /// Unit of stiffnesses of springs.
    PressurePerLength,
    /// Unit of energies per area, and of forces per length.
    PressureTimesLength,
    /// Unit of the coefficient of a power law.
    LengthToOneMinusN,
    /// Units of the coefficients of an area function.
    AreaCoefficient,
    /// Degrees of an angle.
    Degree,
    Time,
    /// Length per time.
    Velocity,
    /// Another unit, in words.
    Other(&'static str),
}

impl Unit {
    /// Whether a unit may stand behind its numbers, which are then converted to that of the case.
    pub(in crate::case) fn is_converted(self) -> bool {
        !matches!(
            self,
            Self::Pure
                | Self::LengthToOneMinusN
                | Self::AreaCoefficient
                | Self::Degree
                | Self::Time
                | Self::Velocity
                | Self::Other(_)
        )
    }

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Pure => "none",
            Self::Length => "length, the same in the whole case; units.length names it",
            Self::Pressure => "pressure, as Young's modulus; units.pressure names it",
            Self::Force => "pressure times length squared: mN in a case of GPa and µm, N in one of MPa and mm",
            Self::PerPressure => "one over a pressure: 1/GPa in a case of GPa",
            Self::PressurePerLength => "pressure per length",
            Self::PressureTimesLength => {
                "pressure times length: kJ/m² or kN/m in a case of GPa and µm, J/m² in one of MPa and µm"
            }
            Self::LengthToOneMinusN => "length to the power 1 − n",
            Self::AreaCoefficient => "none of C₀, length of C₁, length to the power 3/2 of C₂, …",
            Self::Degree => "degrees",
            Self::Time => "time, the same in the whole case; units.time names it",
            Self::Velocity => "length per time",
            Self::Other(words) => words,
        }
    }

    /// The quantity, in a word.
    pub(in crate::case) fn quantity(self) -> &'static str {
        match self {
            Self::Pure | Self::LengthToOneMinusN | Self::AreaCoefficient | Self::Other(_) => "number",
            Self::Degree => "angle",
            Self::Time => "time",
            Self::Velocity => "velocity",
            Self::Length => "length",
            Self::Pressure => "pressure",
            Self::Force => "force",
            Self::PerPressure => "1/pressure",
            Self::PressurePerLength => "pressure per length",
            Self::PressureTimesLength => "energy per area or force per length",
        }
    }
}
