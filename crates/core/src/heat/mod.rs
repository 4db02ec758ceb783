//! Frictional heat in layered bodies under a source that moves: temperature, swelling and thermal stress, wave by wave.
//!
//! Where the source moves along +x with the velocity v over a body and everything is steady in its frame, a flux q̂e^{ik·x} into the
//! surface causes a temperature that decays into each material with
//!
//! s = √(k² − ik_x v/κ),  Re s > 0
//!
//! (`thermal_rate`), T̂ = q̂/Z at the surface by a recursion over the layers ([`TemperatureWave`], `transfer`), and it swells the surface by
//! ŵ = ∫αT̂ σ̂_kk dz by reciprocity with the elastic problem of a pressure (`swelling`). On a homogeneous half-space
//!
//! Z = λs,  ŵ = −2(1+ν)α q̂/(λs(s + k)).
//!
//! Stresses inside are those of Goodier's potential with the elastic waves that free the surface and join the layers ([`ThermalStress`],
//! `goodier`, `conditions`). Moduli are the relaxed ones. A body that rests in the frame of the source has v = 0 and s = k.
//!
//! The wave **k** = 0 has no steady temperature on a half-space: the mean is left out, and bulk temperatures are given. What a uniform
//! rise of temperature does to a body that is held laterally is [`HeatedBody::confined_stress`].

mod conditions;
mod conducting_material;
mod expanding_material;
mod exponentials;
mod goodier;
mod heated_body;
mod stress;
mod swelling;
mod temperature_wave;
mod thermal_rate;
mod transfer;
#[cfg(test)]
mod twin;

pub use heated_body::{HeatError, HeatedBody};
pub use stress::ThermalStress;
pub use temperature_wave::TemperatureWave;
