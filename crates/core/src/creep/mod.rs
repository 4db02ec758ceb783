//! Creep: retardation of viscoelastic layered bodies in time.
//!
//! A wave of the pressure displaces the surface by ŵ(t) = C_g p̂(t) + Σ Aⱼ ∫ e^{−(t−t′)/θⱼ} p̂(t′) dt′/θⱼ, so that each interval of time is an
//! elastic contact with another compliance and a known displacement.
//!
//! - [`Retardation`]: bodies of materials with a [relaxation](crate::body::Relaxation); [`RetardationModes`]: the times θ and amplitudes A of one
//!   wave;
//! - [`History`]: the pressure of all waves as far as it counts, from [`Interval`] to interval.

mod history;
mod modes;
mod retardation;
mod states;

#[cfg(test)]
mod tests;

pub use history::{History, Interval};
pub use modes::{Mode, RetardationModes};
pub use retardation::{Retardation, times};
pub use states::Sample;
