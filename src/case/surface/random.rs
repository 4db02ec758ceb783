//! `[surface.random]`: a self-affine surface from a seed instead of a file.

use serde::Serialize;

use super::super::error::Refusal;
use super::super::reader::TableAt;
use crate::counterbody::roughness::{Rms, SelfAffine};
use crate::lattice::Cell;

/// The section `[surface.random]`, complete.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct RandomSection {
    /// Hurst exponent H.
    pub hurst: f64,
    /// Longest wavelength, a length.
    pub longest: f64,
    /// Wavelength of the roll-off, a length.
    pub rolloff: f64,
    /// Shortest wavelength, a length.
    pub shortest: f64,
    /// What fixes the amplitude: `rms_slope` or `rms_height`.
    #[serde(flatten)]
    pub rms: RmsKey,
    /// Which of all such surfaces.
    pub seed: u64,
}

/// The key that fixes the amplitude.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum RmsKey {
    /// √⟨|∇h|²⟩.
    RmsSlope(f64),
    /// √⟨(h − h̄)²⟩, a length.
    RmsHeight(f64),
}

impl RandomSection {
    pub(super) fn read(section: &TableAt<'_>, cell: Cell) -> Result<Self, Refusal> {
        section.only()?;
        let hurst = section.value("hurst")?.number()?;
        let shortest_value = section.value("shortest")?;
        let shortest = shortest_value.number()?;
        let [x, y] = cell.reduced().short();
        // The wave along the lattice's densest lines, which lie farthest apart.
        let of_cell = cell.area() / x.hypot(y);
        let length = |key, otherwise| section.optional(key).map_or(Ok(otherwise), |value| value.number());
        let longest = length("longest", of_cell)?;
        let rolloff = length("rolloff", longest)?;
        let rms = match section.one_of(["rms_slope", "rms_height"])? {
            (0, slope) => RmsKey::RmsSlope(slope.number()?),
            (_, height) => RmsKey::RmsHeight(height.number()?),
        };
        let seed = section.value("seed")?.integer()? as u64;
        if !(shortest <= rolloff && rolloff <= longest) {
            let what = format!(
                "`{}` ≤ `rolloff` ≤ `longest` must hold of the wavelengths, not {shortest} ≤ {rolloff} ≤ {longest}",
                section.path("shortest")
            );
            return Err(Refusal::new(shortest_value.node.place, what, "no band of wavelengths")
                .help("`rolloff` is `longest` when not given, and that is the longest wave of the cell"));
        }
        Ok(Self { hurst, longest, rolloff, shortest, rms, seed })
    }

    /// What it says, for the core.
    pub fn surface(&self) -> SelfAffine {
        let Self { hurst, longest, rolloff, shortest, seed, .. } = *self;
        let rms = match self.rms {
            RmsKey::RmsSlope(slope) => Rms::Slope(slope),
            RmsKey::RmsHeight(height) => Rms::Height(height),
        };
        SelfAffine { hurst, longest, rolloff, shortest, rms, seed }
    }
}
