//! Temperatures of a load step by frictional heat.

use crate::body::MaterialId;
use crate::numeric::{serialised, sums};
use crate::quantity::quantities;
use crate::spectral::{Contact, Hottest, Step};
use serde::{Deserialize, Serialize};

/// Weight of the change from the next coarser grid in the error of a temperature: below an edge of the flux it is of the order 1.5.
const CHANGE: f64 = 1.0;
/// Relative error of a temperature, and of a share, that samples leave beside a change that may vanish by chance: the part n^{−3/2} of n samples
/// along the radius of a spot; and of the mean in contact, whose samples are counted, the part 1/n. The study `heat` has the true errors.
const LEFT: f64 = 0.1;
const COUNTED: f64 = 0.5;

quantities! {
    /// Temperatures of a load step. In a periodic cell they stand above the bulk temperature of their body by what differs from the mean of the
    /// surface, which grows without end.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
    pub struct TemperatureReading {
        /// Largest temperature of all materials, on a surface.
        #[serde(deserialize_with = "serialised::number")]
        pub max: f64 = Temperature "largest temperature" "T" error max_error,
        /// Error of the largest temperature, by the change from the next coarser grid and the samples of a spot.
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
        /// Error of the mean temperature, by the change from the next coarser grid and the samples of a spot.
        pub mean_error: Option<f64>,
        /// Share of the counterbody of all frictional heat.
        #[serde(deserialize_with = "serialised::number")]
        pub counterbody_share: f64 = Fraction "heat into the counterbody" "1 − β" error share_error,
        /// Error of the share, by the change from the next coarser grid and the samples of a spot.
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
    /// Error of the temperature, by the change from the next coarser grid and the samples of a spot; `None` without a coarser grid.
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
        let samples = samples_of_spots(step.finest());
        let [left, counted] = [LEFT * samples.powf(-1.5), COUNTED / samples];
        let bulk = step.problem().heating().map_or([0.0; 2], |heating| heating.bulk());
        let above = |value: f64, of: MaterialId| (value - bulk[usize::from(of.is_counterbody())]).abs();
        let finest = heated.grids.first()?;
        let coarser = heated.grids.get(1);
        let of = |(index, hottest): (usize, &Hottest)| {
            let [x, y] = grid.cell().point(grid.fractions(hottest.sample));
            let other = coarser.and_then(|all| all.get(index));
            let floor = left * above(hottest.value, hottest.material);
            let error = other.map(|other| CHANGE * (other.value - hottest.value).abs() + floor);
            MaterialTemperature { material: hottest.material, value: hottest.value, error, place: [x, y, hottest.z] }
        };
        let materials: Vec<MaterialTemperature> = finest.iter().enumerate().map(of).collect();
        let max =
            materials.iter().copied().reduce(|best, other| if other.value > best.value { other } else { best })?;
        let mean = |contact: &Contact| {
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
            mean_error: other
                .map(|[mean, _]| CHANGE * (mean - mean_in_contact).abs() + counted * (mean_in_contact - bulk[0]).abs()),
            counterbody_share,
            share_error: other
                .map(|[_, share]| CHANGE * (share - counterbody_share).abs() + left * counterbody_share.abs()),
            power: whole * grid.sample_area(),
            criticality: 1.0 - heated.left,
            materials,
        })
    }
}

/// Samples along the radius of the spots of a contact: of a disc πn² samples touch, and 4√2 n of them have a neighbour that does not.
fn samples_of_spots(contact: &Contact) -> f64 {
    let (pressures, [rows, columns]) = (contact.pressures(), contact.grid().points());
    let touches = |i: usize, j: usize| pressures[(i % rows) * columns + j % columns] > 0.0;
    let of = |sample: usize| {
        let (i, j) = (sample / columns, sample % columns);
        let beside = [(i + 1, j), (i + rows - 1, j), (i, j + 1), (i, j + columns - 1)];
        let is_edge = beside.into_iter().any(|(i, j)| !touches(i, j));
        [touches(i, j), touches(i, j) && is_edge].map(|is| f64::from(u8::from(is)))
    };
    let [all, edge] = sums::of(pressures.len(), of);
    if edge > 0.0 {
        (4.0 * std::f64::consts::SQRT_2 / std::f64::consts::PI * all / edge).max(1.0)
    } else {
        f64::INFINITY
    }
}
