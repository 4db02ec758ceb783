//! Aim of a part of a step, a tangential force or a shift, and the parts of a step in which load and aim change in proportion.

use super::disc::Vector;
use crate::load::Load;

/// Tangential force or shift at the end of a part of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Aim {
    /// A force.
    Force(Vector),
    /// A force over μP.
    Part(Vector),
    /// A shift since the first contact.
    Shift(Vector),
}

impl Aim {
    pub fn vector(self) -> Vector {
        match self {
            Self::Force(vector) | Self::Part(vector) | Self::Shift(vector) => vector,
        }
    }

    /// The same kind of aim with another vector.
    pub fn with(self, vector: Vector) -> Self {
        match self {
            Self::Force(_) => Self::Force(vector),
            Self::Part(_) => Self::Part(vector),
            Self::Shift(_) => Self::Shift(vector),
        }
    }
}

/// Load and aim that change in proportion, the load in one quantity and the aim in one kind.
#[derive(Debug)]
pub(super) struct Ramp {
    pub loads: [Load; 2],
    pub aims: [Aim; 2],
}

impl Ramp {
    pub fn is_at_one_load(&self) -> bool {
        self.loads[0] == self.loads[1]
    }

    /// Load and aim at the end of each of so many parts: equal parts of the radius at which a paraboloid touches, a force like its cube and a
    /// penetration like its square.
    pub fn ends(&self, parts: usize) -> impl Iterator<Item = (Load, Aim)> {
        let Self { loads: [from, to], aims: [start, end] } = *self;
        let power = if to.is_load_control() { 3 } else { 2 };
        let [before, after] = [from, to].map(|load| load.value().max(0.0).powf(1.0 / f64::from(power)));
        let change = to.value() - from.value();
        (1..=parts).map(move |part| {
            if part == parts {
                return (to, end);
            }
            let t = part as f64 / parts as f64;
            let load = (before + t * (after - before)).powi(power);
            let t = if change == 0.0 { t } else { (load - from.value()) / change };
            let between = |a: f64, b: f64| a + t * (b - a);
            let ([x0, y0], [x1, y1]) = (start.vector(), end.vector());
            (to.with_value(between(from.value(), to.value())), end.with([between(x0, x1), between(y0, y1)]))
        })
    }
}
