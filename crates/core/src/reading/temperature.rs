//! Temperatures of a load step by frictional heat.

use crate::body::MaterialId;
use crate::numeric::{serialised, sums};
use crate::quantity::quantities;
use crate::spectral::{Hottest, Step};
use serde::{Deserialize, Serialize};

/// Weight of the change from the next coarser grid in the error of a temperature: below an edge of the flux it is of the order 1.5.
const CHANGE: f64 = 1.0;

quantities! {
    /// Temperatures of a load step. In a periodic cell they stand above the bulk temperature of their body by what differs from the mean of the
    /// surface, which grows without end.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
    pub struct TemperatureReading {
        /// Largest temperature of all materials, on a surface.
        #[serde(deserialize_with = "serialised::number")]
        pub max: f64 = Temperature "largest temperature" "T" error max_error,
        /// Error of the largest temperature, by the change from the next coarser grid.
        pub max_error: Option<f64>,
        /// Place of the largest temperature along x, a length.
        pub x: f64,
        /// Place of the largest temperature along y, a length.
        pub y: f64,
        /// Depth of the largest temperature, a length.
        pub z: f64,
        /// Material of the largest temperature.
        pub material: MaterialId,
        /// Mean temperature of the body's surface where it touches.
        #[serde(deserialize_with = "serialised::number")]
        pub mean_in_contact: f64 = Temperature "mean temperature in contact" "T_c" error mean_error,
        /// Error of the mean temperature, by the change from the next coarser grid.
        pub mean_error: Option<f64>,
        /// Share of the counterbody of all frictional heat.
        #[serde(deserialize_with = "serialised::number")]
        pub counterbody_share: f64 = Fraction "heat into the counterbody" "1 − β" error share_error,
        /// Error of the share, by the change from the next coarser grid.
        pub share_error: Option<f64>,
        /// Frictional heat of one cell, a power.
        #[serde(deserialize_with = "serialised::number")]
        pub power: f64,
        /// Largest part of the compliance of a wave of the cell that swelling takes: no steady state is unique from 1 on; 0 without expansion.
        /// Of heat that a counterbody at rest takes in, the part is that of the velocity in the critical one.
        #[serde(deserialize_with = "serialised::number")]
        pub criticality: f64 = Fraction "compliance taken by swelling" "1 − C_h/C",
        /// Largest temperature of each material, of the body and then of the counterbody.
        pub materials: Vec<MaterialTemperature>,
    }
    table TemperatureQuantities as TEMPERATURE;
}

/// Largest temperature of a material, on its upper face.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct MaterialTemperature {
    /// The material.
    #[serde(flatten)]
    pub material: MaterialId,
    /// The temperature.
    pub value: f64,
    /// Error of the temperature, by the change from the next coarser grid; `None` without one.
    pub error: Option<f64>,
    /// Place, lengths; z from the surface of its body inward.
    pub place: [f64; 3],
}

impl TemperatureReading {
    /// Reading of a step; `None` where nothing heats, and without contact.
    pub fn of(step: &Step) -> Option<Self> {
        let (heated, heat) = (step.heat.as_ref()?, step.finest().heat()?);
        let grid = step.grid();
        let [whole] = sums::of(heat.friction.len(), |i| [heat.friction[i]]);
        if whole <= 0.0 {
            return None;
        }
        let finest = heated.grids.first()?;
        let coarser = heated.grids.get(1);
        let of = |(index, hottest): (usize, &Hottest)| {
            let [x, y] = grid.cell().point(grid.fractions(hottest.sample));
            let other = coarser.and_then(|all| all.get(index));
            let error = other.map(|other| CHANGE * (other.value - hottest.value).abs());
            MaterialTemperature { material: hottest.material, value: hottest.value, error, place: [x, y, hottest.z] }
        };
        let materials: Vec<MaterialTemperature> = finest.iter().enumerate().map(of).collect();
        let max =
            materials.iter().copied().reduce(|best, other| if other.value > best.value { other } else { best })?;
        let mean = |contact: &crate::spectral::Contact| {
            let (heat, p) = (contact.heat()?, contact.pressures());
            let [sum, count] = sums::of(p.len(), |i| if p[i] > 0.0 { [heat.body[i], 1.0] } else { [0.0; 2] });
            Some([sum / count, 1.0 - heat.share])
        };
        let [mean_in_contact, counterbody_share] = mean(step.finest())?;
        let other = step.coarser().first().and_then(mean);
        let [x, y, z] = max.place;
        Some(Self {
            max: max.value,
            max_error: max.error,
            x,
            y,
            z,
            material: max.material,
            mean_in_contact,
            mean_error: other.map(|[mean, _]| CHANGE * (mean - mean_in_contact).abs()),
            counterbody_share,
            share_error: other.map(|[_, share]| CHANGE * (share - counterbody_share).abs()),
            power: whole * grid.sample_area(),
            criticality: 1.0 - heated.left,
            materials,
        })
    }
}
