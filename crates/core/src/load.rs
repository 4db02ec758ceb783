//! The prescribed quantity of a load step: mean pressure, force, penetration or the position of a grip.

use crate::lattice::Cell;
use crate::notation::number;
use std::fmt;

/// The prescribed quantity of a load step and its value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Load {
    /// Mean pressure p̄ over the cell, below 0 of surfaces that adhere alone, in the unit of Young's modulus (load control). Around an isolated contact, whose force is
    /// what counts, over the window.
    MeanPressure(f64),
    /// Force P on the cell, likewise, or on the isolated contact, a pressure times an area (load control).
    Force(f64),
    /// Penetration δ below first touch, a length (displacement control); in a periodic system at most the mean of the initial gap,
    /// where contact is complete, unless compressible layers lie on a rigid base; of a surface with hardness below the largest initial gap
    /// and what the hardness compresses the layers by. Of a given pressure the largest deflection.
    Penetration(f64),
    /// Position of a grip that holds the counterbody by a spring, for surfaces that adhere: the penetration and what the force stretches the
    /// spring by, δ + P/k.
    Grip {
        /// Position, a length; falls where the counterbody is drawn off.
        position: f64,
        /// Stiffness k of the spring, a force per length; infinite of a rigid machine.
        stiffness: f64,
    },
}

/// The quantity in which loads are stated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum LoadQuantity {
    /// The mean pressure p̄ over the cell.
    #[default]
    MeanPressure,
    /// The force P on the cell, or on an isolated contact.
    Force,
}

impl LoadQuantity {
    /// Symbol of the quantity.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::MeanPressure => "p̄",
            Self::Force => "P",
        }
    }

    /// Name of the quantity in words.
    pub fn name(self) -> &'static str {
        match self {
            Self::MeanPressure => "mean pressure",
            Self::Force => "force",
        }
    }

    /// Key of the quantity in case files and results.
    pub fn key(self) -> &'static str {
        match self {
            Self::MeanPressure => "mean_pressure",
            Self::Force => "force",
        }
    }

    /// The load of a force on a cell, stated in this quantity.
    pub fn of_force(self, force: f64, cell: Cell) -> Load {
        match self {
            Self::MeanPressure => Load::MeanPressure(force / cell.area()),
            Self::Force => Load::Force(force),
        }
    }

    /// A load of this quantity.
    pub fn load(self, value: f64) -> Load {
        match self {
            Self::MeanPressure => Load::MeanPressure(value),
            Self::Force => Load::Force(value),
        }
    }
}

impl Load {
    /// The prescribed value, a pressure, a force or a length.
    pub fn value(self) -> f64 {
        match self {
            Self::MeanPressure(value)
            | Self::Force(value)
            | Self::Penetration(value)
            | Self::Grip { position: value, .. } => value,
        }
    }

    /// The same quantity with another value.
    pub fn with_value(self, value: f64) -> Self {
        match self {
            Self::MeanPressure(_) => Self::MeanPressure(value),
            Self::Force(_) => Self::Force(value),
            Self::Penetration(_) => Self::Penetration(value),
            Self::Grip { stiffness, .. } => Self::Grip { position: value, stiffness },
        }
    }

    /// Whether the mean pressure or the force is prescribed.
    pub fn is_load_control(self) -> bool {
        matches!(self, Self::MeanPressure(_) | Self::Force(_))
    }

    /// Control by the load on a cell: a force is a mean pressure there, and the position of a grip the penetration of a rigid machine.
    pub(crate) fn on(self, cell: Cell) -> Control {
        match self {
            Self::MeanPressure(mean) => Control::MeanPressure(mean),
            Self::Force(force) => Control::MeanPressure(force / cell.area()),
            Self::Penetration(penetration) | Self::Grip { position: penetration, .. } => {
                Control::Penetration(penetration)
            }
        }
    }
}

/// The prescribed quantity of a load step on a cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Control {
    /// Mean pressure p̄ ≥ 0 over the cell.
    MeanPressure(f64),
    /// Penetration δ, a length.
    Penetration(f64),
}

impl Control {
    /// The prescribed value, a pressure or a length.
    pub fn value(self) -> f64 {
        match self {
            Self::MeanPressure(value) | Self::Penetration(value) => value,
        }
    }

    /// Whether the mean pressure is prescribed.
    pub fn is_mean_pressure(self) -> bool {
        matches!(self, Self::MeanPressure(_))
    }
}

impl fmt::Display for Load {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = match self {
            Self::MeanPressure(_) => "mean pressure",
            Self::Force(_) => "force",
            Self::Penetration(_) => "penetration",
            Self::Grip { .. } => "grip at",
        };
        write!(f, "{name} {}", number(self.value()))
    }
}

impl fmt::Display for Control {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::MeanPressure(mean) => Load::MeanPressure(mean).fmt(f),
            Self::Penetration(penetration) => Load::Penetration(penetration).fmt(f),
        }
    }
}
