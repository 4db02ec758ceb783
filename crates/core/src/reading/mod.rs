//! Readings of a solved contact: loads, peaks, areas and boundaries level by level, between the samples, with their errors.
//!
//! A sample belongs to the indenter whose surface is nearest to it. Contacts of neighbouring indenters that touch have
//! **merged**: loads and peak pressures still belong to levels, a radius has lost its meaning. A contact that is open in
//! the middle is a **ring**: its area is that in contact. Radii and areas carry an estimate of their discretisation
//! error.

mod adhesion;
mod area;
mod beneath;
pub(crate) mod boundary;
mod contact;
mod contact_area;
mod counted;
mod creep;
mod damage_map;
mod edge;
mod edge_transforms;
mod estimate;
mod fatigue;
mod fraction;
mod fractions;
mod governing;
mod histogram;
mod holes;
mod hysteresis;
mod level;
mod level_spots;
mod peak;
mod plastic;
mod rough;
mod section;
mod slip;
mod spots;
mod strength;
mod strength_search;
mod stress;
mod temperature;
mod topography;
mod touch;
mod verdict;

pub use adhesion::{
    ADHESION, AdhesionQuantities, AdhesionReading, JumpKind, JumpReading, PullOffReading, loss, of_apex, pull_off,
};
pub use beneath::Beneath;
pub(crate) use beneath::pressure_on;
pub use boundary::Boundary;
pub use contact::{Errors, READING, Reading, ReadingQuantities};
pub use counted::CountedArea;
pub use creep::{CREEP, CreepQuantities, CreepReading};
pub use damage_map::DamageMap;
pub use fatigue::{FatiguePart, FatigueReading, LIFE, Life, LifeQuantities, StrainedMaterial};
pub(crate) use fatigue::{Pass, PathReading};
pub use fraction::Fraction;
pub use fractions::Fractions;
pub use governing::names;
pub use governing::{Governing, within_the_errors};
pub use histogram::Histogram;
pub use hysteresis::{HYSTERESIS, HysteresisQuantities, HysteresisReading, MaterialLoss};
pub use level::{FEW_SAMPLES, LEVEL, LevelErrors, LevelQuantities, LevelReading, Uncertainty};
pub use plastic::{PLASTIC, PlasticQuantities, PlasticReading};
pub use rough::{ROUGH, RoughQuantities, RoughReading, SpotSizes, stiffness};
pub use section::{LargestInSection, SectionMeasure};
pub(crate) use slip::closed_cycle;
pub use slip::{SLIP, SlipLevel, SlipQuantities, SlipReading, cycle};
pub use strength::{Criterion, UTILISATION, Utilisation, UtilisationQuantities};
pub(crate) use strength_search::{largest_while, utilisations_while};
pub use stress::contact_radii;
pub use stress::{StressReading, tears, tips};
pub use temperature::{MaterialTemperature, TEMPERATURE, TemperatureQuantities, TemperatureReading};
pub use touch::{FirstTouch, first_touches};
pub use verdict::Verdict;
