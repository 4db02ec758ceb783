//! A free parameter and its scale: the search takes place in t, all of whose entries have the scale 1 and start from 0.

use crate::notation::number;

/// Kind of a parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Quantity {
    /// A quantity above 0 of the model, searched by its logarithm: start · eᵗ.
    Positive,
    /// A quantity of the model between two bounds, both included, as Poisson's ratio: start + (high − low) t.
    Bounded([f64; 2]),
    /// δ₀, which is added to all penetrations: a zero that was missed: start + a length · t.
    Offset,
    /// δ₀ of the curve of this index, of several that are fitted together.
    OffsetOf(usize),
    /// C_f of the frame, by which C_f P is added to penetrations, a length per force: start + a length per force · t.
    FrameCompliance,
}

/// A parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    /// Name of the parameter.
    pub name: String,
    /// Kind of the parameter.
    pub quantity: Quantity,
    /// Value at the beginning of the search.
    pub start: f64,
}

impl Parameter {
    /// Whether the model has it, and not the measurement.
    pub(super) fn is_of_model(&self) -> bool {
        matches!(self.quantity, Quantity::Positive | Quantity::Bounded(_))
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
            Quantity::Bounded([low, high]) => start + (high - low) * t,
            Quantity::Offset | Quantity::OffsetOf(_) => start + self.units[0] * t,
            Quantity::FrameCompliance => start + self.units[1] * t,
        }
    }

    /// The derivative of the value by t.
    pub(super) fn slope(&self, k: usize, t: f64) -> f64 {
        match self.all[k].quantity {
            Quantity::Positive => self.value(k, t),
            Quantity::Bounded([low, high]) => high - low,
            Quantity::Offset | Quantity::OffsetOf(_) => self.units[0],
            Quantity::FrameCompliance => self.units[1],
        }
    }

    /// The value at t, or the bound nearest to it.
    pub(super) fn bounded(&self, k: usize, t: f64) -> f64 {
        match self.all[k].quantity {
            Quantity::Bounded([low, high]) => self.value(k, t).clamp(low, high),
            _ => self.value(k, t),
        }
    }

    /// A standard error of t relative to the value, or to half the way between its bounds; 0 for what may well be 0.
    pub(super) fn relative(&self, k: usize, deviation: f64) -> f64 {
        match self.all[k].quantity {
            Quantity::Positive => deviation,
            Quantity::Bounded(_) => 2.0 * deviation,
            Quantity::Offset | Quantity::OffsetOf(_) | Quantity::FrameCompliance => 0.0,
        }
    }

    /// The first of the values at t that lies outside of its bounds, or a thousand times from its start, in a sentence.
    pub(super) fn outside(&self, place: &[f64]) -> Option<String> {
        (0..place.len()).find_map(|k| {
            let Parameter { name, quantity, start } = &self.all[k];
            match *quantity {
                Quantity::Positive if place[k].abs() > FARTHEST => Some(format!(
                    "{name} is no longer between a thousandth and a thousand times its start, {}",
                    number(*start)
                )),
                Quantity::Bounded([low, high]) if !(low..=high).contains(&self.value(k, place[k])) => {
                    Some(format!("{name} is no longer between its bounds {low} and {high}"))
                }
                _ => None,
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slope_is_the_derivative_of_the_value_and_bounds_hold() {
        let parameter = |quantity, start| Parameter { name: "parameter".to_owned(), quantity, start };
        let all = [
            parameter(Quantity::Positive, 3.0),
            parameter(Quantity::Bounded([0.0, 0.5]), 0.2),
            parameter(Quantity::Offset, 0.0),
            parameter(Quantity::FrameCompliance, 0.0),
        ];
        let free = FreeParameters { all: &all, units: [2.0, 5.0] };
        for (k, parameter) in all.iter().enumerate() {
            assert_eq!(free.value(k, 0.0), parameter.start);
            let quotient = (free.value(k, 0.4 + 1e-6) - free.value(k, 0.4 - 1e-6)) / 2e-6;
            assert!((free.slope(k, 0.4) / quotient - 1.0).abs() < 1e-8, "{parameter:?}");
        }
        assert_eq!(free.outside(&[6.8, 0.59, 1e3, 1e3]), None);
        assert!(free.outside(&[-7.0, 0.0, 0.0, 0.0]).unwrap().contains("thousandth"));
        for t in [0.61, -0.41] {
            assert!(free.outside(&[0.0, t, 0.0, 0.0]).unwrap().contains("between its bounds 0 and 0.5"));
        }
        assert_eq!([free.bounded(1, 0.7), free.bounded(1, -0.5), free.bounded(1, 0.1)], [0.5, 0.0, 0.25]);
    }
}
