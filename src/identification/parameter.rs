//! A free parameter and its scale: the search takes place in t, all of whose entries have the scale 1 and start from 0.

use crate::notation::number;

/// What a parameter is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// A quantity above 0 of the model, searched by its logarithm: start · eᵗ.
    Positive,
    /// A quantity of the model of the order of 1, searched by itself, as Poisson's ratio: start + t.
    Number,
    /// δ₀, which is added to all penetrations: a zero that was missed. It starts from 0.
    Offset,
    /// C_f of the frame, by which C_f P is added to penetrations, a length per force. It starts from 0.
    FrameCompliance,
}

/// A parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    /// Its name.
    pub name: String,
    /// What it is.
    pub quantity: Quantity,
    /// Its value at the beginning.
    pub start: f64,
}

impl Parameter {
    /// Whether the model has it, and not the measurement.
    pub(super) fn is_of_model(&self) -> bool {
        matches!(self.quantity, Quantity::Positive | Quantity::Number)
    }
}

/// Farthest that a logarithm is searched from its start: a factor of 1000.
const FARTHEST: f64 = 6.9;

/// The free parameters of a search, by their numbers.
#[derive(Debug, Clone, Copy)]
pub(super) struct FreeParameters<'a> {
    pub(super) all: &'a [Parameter],
    /// Units of offset and frame compliance: a length, and a length per force.
    pub(super) units: [f64; 2],
}

impl FreeParameters<'_> {
    pub(super) fn name(&self, k: usize) -> String {
        self.all[k].name.clone()
    }

    /// The value at t.
    pub(super) fn value(&self, k: usize, t: f64) -> f64 {
        let Parameter { quantity, start, .. } = self.all[k];
        match quantity {
            Quantity::Positive => start * t.exp(),
            Quantity::Number => start + t,
            Quantity::Offset => self.units[0] * t,
            Quantity::FrameCompliance => self.units[1] * t,
        }
    }

    /// The derivative of the value by t.
    pub(super) fn slope(&self, k: usize, t: f64) -> f64 {
        match self.all[k].quantity {
            Quantity::Positive => self.value(k, t),
            Quantity::Number => 1.0,
            Quantity::Offset => self.units[0],
            Quantity::FrameCompliance => self.units[1],
        }
    }

    /// The first value at t that lies outside of what is searched, in words.
    pub(super) fn outside(&self, place: &[f64]) -> Option<String> {
        (0..place.len()).find_map(|k| {
            let Parameter { name, quantity, start } = &self.all[k];
            let is_too_far = *quantity == Quantity::Positive && place[k].abs() > FARTHEST;
            is_too_far
                .then(|| format!("{name} is no longer between a thousandth and a thousand times {}", number(*start)))
        })
    }
}
