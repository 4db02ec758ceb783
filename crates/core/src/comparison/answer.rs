//! Result of a load step by either method, and its deviation from another result.

use crate::localized;
use crate::numeric::search::largest;
use crate::numeric::serialised;
use crate::reading::{LevelReading, Reading};
use serde::{Deserialize, Serialize};

/// Largest deviation of any level in contact from a reference, relative except for the load share.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Deviation {
    /// Deviation of the penetration, relative.
    #[serde(deserialize_with = "serialised::number")]
    pub penetration: f64,
    /// Deviation of the load on one indenter, relative.
    #[serde(deserialize_with = "serialised::number")]
    pub load: f64,
    /// Deviation of the share of the whole load, absolute.
    #[serde(deserialize_with = "serialised::number")]
    pub load_share: f64,
    /// Deviation of the peak pressure, relative; not a number where it is infinite.
    #[serde(deserialize_with = "serialised::number")]
    pub max_pressure: f64,
    /// Deviation of the contact radius, relative.
    #[serde(deserialize_with = "serialised::number")]
    pub contact_radius: f64,
}

/// Penetration and levels of a load step, by either method.
#[derive(Debug, Clone, PartialEq)]
pub struct Answer {
    /// Penetration δ, a length.
    pub penetration: f64,
    /// Readings of the levels, from the highest down.
    pub levels: Vec<LevelReading>,
}

impl Answer {
    /// Deviation of this answer from `reference`. A level in contact in one of them only has the deviation 1; the
    /// radius of merged contacts and the infinite peak under a tip are not numbers.
    pub fn deviation(&self, reference: &Self) -> Deviation {
        let relative = |a: f64, b: f64| match (a, b) {
            _ if a == b => 0.0,
            _ if a == 0.0 || b == 0.0 => 1.0,
            _ => (a / b - 1.0).abs(),
        };
        let worst = |of: &dyn Fn(&LevelReading, &LevelReading) -> f64| {
            let pairs = self.levels.iter().zip(&reference.levels);
            largest(pairs.filter(|(a, b)| a.load > 0.0 || b.load > 0.0).map(|(a, b)| of(a, b)))
        };
        let peak = |level: &LevelReading| level.finite_peak().unwrap_or(f64::NAN);
        let radius = |level: &LevelReading| level.contact_radius.unwrap_or(f64::NAN);
        Deviation {
            penetration: relative(self.penetration, reference.penetration),
            load: worst(&|a, b| relative(a.load, b.load)),
            load_share: worst(&|a, b| (a.load_share - b.load_share).abs()),
            max_pressure: worst(&|a, b| relative(peak(a), peak(b))),
            contact_radius: worst(&|a, b| relative(radius(a), radius(b))),
        }
    }
}

impl From<&Reading> for Answer {
    fn from(reading: &Reading) -> Self {
        Self { penetration: reading.penetration, levels: reading.levels.clone() }
    }
}

impl From<&localized::Solution> for Answer {
    fn from(solution: &localized::Solution) -> Self {
        Self { penetration: solution.penetration, levels: solution.levels() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_peak_under_a_tip_is_not_compared() {
        let tip = |max_pressure| LevelReading {
            load: 1.0,
            max_pressure: f64::INFINITY,
            resolved_peak: Some(max_pressure),
            ..LevelReading::default()
        };
        let [one, other] = [2.0, 3.0].map(|peak| Answer { penetration: 0.1, levels: vec![tip(peak)] });
        let deviation = one.deviation(&other);
        assert!(deviation.max_pressure.is_nan() && deviation.load == 0.0);
    }
}
