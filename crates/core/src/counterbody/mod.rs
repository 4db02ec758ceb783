//! Loading of the body: a counterbody of indenters at several levels or of a topography, or a given pressure; and the
//! surface of the counterbody on a grid.

mod bare;
mod error;
mod indenter;
mod indenters;
mod level_name;
mod loaded_by;
mod loaded_disc;
mod measured_tip;
mod pressure;
pub mod roughness;
mod surface;
mod topography;

pub use error::CounterbodyError;
pub use indenter::{IndenterError, Level, Shape, flank_slope, half_angle};
pub use indenters::{Indenters, Site};
pub use level_name::LevelName;
pub use loaded_by::LoadedBy;
pub use loaded_disc::LoadedDisc;
pub use measured_tip::{MeasuredTip, TipError};
pub use pressure::GivenPressure;
pub use surface::Surface;
pub use topography::Topography;

use crate::lattice::Cell;
use crate::numeric::parallel;
use ndarray::{ArrayView1, ArrayView2, Axis};
use std::fmt;

/// The counterbody, independent of any grid.
#[derive(Debug, Clone, PartialEq)]
pub enum Counterbody {
    /// Indenters at several levels on the sites of a lattice.
    Indenters(Indenters),
    /// One period of a measured or generated topography.
    Topography(Topography),
}

impl Counterbody {
    /// The unit cell.
    pub fn cell(&self) -> Cell {
        match self {
            Self::Indenters(indenters) => indenters.lattice().cell(),
            Self::Topography(topography) => topography.cell(),
        }
    }

    /// The indenters; `None` for a topography.
    pub fn indenters(&self) -> Option<&Indenters> {
        match self {
            Self::Indenters(indenters) => Some(indenters),
            Self::Topography(_) => None,
        }
    }

    /// The topography; `None` for indenters.
    pub fn topography(&self) -> Option<&Topography> {
        match self {
            Self::Topography(topography) => Some(topography),
            Self::Indenters(_) => None,
        }
    }

    /// The levels of the indenters; none for a topography.
    pub fn levels(&self) -> &[Level] {
        self.indenters().map_or(&[], Indenters::levels)
    }
}

/// Part of the range of values within which they count as equal.
const EQUAL: f64 = 1e-9;

/// The axis along which values are constant while they change along the other; `None` where there is no such axis.
pub(crate) fn constant_axis(values: ArrayView2<'_, f64>) -> Option<usize> {
    let join = |[low, high]: [f64; 2], [least, most]: [f64; 2]| [low.min(least), high.max(most)];
    let nothing = [f64::INFINITY, f64::NEG_INFINITY];
    let ends = |values: ArrayView1<'_, f64>| values.iter().fold(nothing, |ends, &x| join(ends, [x; 2]));
    let range = |values: ArrayView1<'_, f64>| {
        let [low, high] = ends(values);
        high - low
    };
    // No axis is constant along which the first line varies by more than rounding of the range of all values.
    let [low, high] = parallel::map(values.nrows(), |row| ends(values.row(row))).into_iter().fold(nothing, join);
    let varies = |axis: usize| {
        let first = values.lanes(Axis(axis)).into_iter().next();
        first.is_some_and(|line| range(line) > EQUAL * (high - low))
    };
    if varies(0) && varies(1) {
        return None;
    }
    // Ranges within the lines along an axis.
    let along = [0, 1].map(|axis| values.lanes(Axis(axis)).into_iter().map(range).fold(0.0, f64::max));
    (0..2).find(|&axis| along[axis] <= EQUAL * along[1 - axis] && along[1 - axis] > 0.0)
}

impl From<Indenters> for Counterbody {
    fn from(indenters: Indenters) -> Self {
        Self::Indenters(indenters)
    }
}

impl From<Topography> for Counterbody {
    fn from(topography: Topography) -> Self {
        Self::Topography(topography)
    }
}

impl fmt::Display for Counterbody {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Indenters(indenters) => indenters.fmt(f),
            Self::Topography(topography) => topography.fmt(f),
        }
    }
}
