//! Two loads that enclose a limit, and the load at which the utilisation becomes 1 between them.
//!
//! The root is that of the secant of ln u over ln p̄; bisection is its safeguard, and takes over where u jumps.

/// Relative accuracy of a limit.
const TOLERANCE: f64 = 1e-3;
/// Distance of a solved load from the root of the secant, in parts of the accuracy, below which the root is known.
const NEAR: f64 = 0.3;
/// Exponent of p̄ beyond which a growing utilisation may as well jump: its root needs a load on either side.
const STEEP: f64 = 2.0;

/// Two loads between which a utilisation becomes 1.
#[derive(Debug, Clone, Copy)]
pub(super) struct Enclosure {
    /// Mean pressures, ascending.
    pub loads: [f64; 2],
    /// Utilisations, the first below 1 and the second not.
    pub values: [f64; 2],
}

impl Enclosure {
    /// Slope d ln u / d ln p̄ of the secant; `None` where a utilisation is zero or infinite: it jumps.
    pub fn slope(&self) -> Option<f64> {
        let ([low, high], [under, over]) = (self.loads, self.values);
        (under > 0.0 && over.is_finite()).then(|| (over / under).ln() / (high / low).ln())
    }

    /// Mean pressure at which the secant of ln u over ln p̄ is zero; the upper load where there is no secant.
    pub fn root(&self) -> f64 {
        let [low, high] = self.loads;
        self.slope().map_or(high, |slope| (low * (-self.values[0].ln() / slope).exp()).clamp(low, high))
    }

    /// Whether the utilisation under the lower load is nearer to 1 than that under the upper one.
    pub fn first_is_nearer(&self) -> bool {
        let [under, over] = self.values.map(|value| value.ln().abs());
        under < over
    }

    /// Relative uncertainty of the root: by the secant, or by the loads that enclose it.
    pub fn uncertainty(&self) -> f64 {
        let [low, high] = self.loads;
        if self.slope().is_some() { (high / low - 1.0).min(NEAR * TOLERANCE) } else { high / low - 1.0 }
    }

    /// Mean pressure to solve next, the middle of the interval where `halve` is set; `None` where the root is known well enough.
    pub fn next(&self, halve: bool) -> Option<f64> {
        let ([low, high], root) = (self.loads, self.root());
        let near = if self.first_is_nearer() { low } else { high };
        if high / low - 1.0 <= TOLERANCE {
            return None;
        }
        let known = (root / near - 1.0).abs() <= NEAR * TOLERANCE;
        match self.slope().filter(|_| known) {
            Some(slope) if slope <= STEEP => None,
            Some(_) if !halve => {
                let beyond = 1.0 + 0.5 * TOLERANCE;
                Some(if self.first_is_nearer() { root * beyond } else { root / beyond })
            }
            _ => {
                let inside = low < root && root < high && !halve;
                Some(if inside { root } else { (low * high).sqrt() })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Root of a utilisation between 1 and 2, and how many loads it took.
    fn solved(utilisation: impl Fn(f64) -> f64) -> (f64, usize) {
        let mut enclosure = Enclosure { loads: [1.0, 2.0], values: [1.0, 2.0].map(&utilisation) };
        for trial in 0..40 {
            let Some(next) = enclosure.next(trial % 3 == 2) else { return (enclosure.root(), trial) };
            let value = utilisation(next);
            let end = usize::from(value >= 1.0);
            (enclosure.loads[end], enclosure.values[end]) = (next, value);
        }
        panic!("no root: {enclosure:?}");
    }

    /// A power is one secant; bisection takes ten loads, and where two of three are wasted on secants, thirty.
    #[test]
    fn roots_are_found_of_powers_of_curves_and_of_utilisations_that_jump() {
        let near = |(root, trials): (f64, usize), known: f64, most: usize| {
            assert!((root / known - 1.0).abs() <= TOLERANCE, "{root} for {known}");
            assert!(trials <= most, "{trials} loads");
        };
        near(solved(|p| (p / 1.3).cbrt()), 1.3, 1);
        near(solved(|p| (p / 1.3).cbrt() + 0.05 * (p - 1.3)), 1.3, 3);
        near(solved(|p| if p < 1.4 { 0.0 } else { f64::INFINITY }), 1.4, 10);
        near(solved(|p| if p < 1.4 { 0.5 } else { 30.0 * p }), 1.4, 30);
        // Just before they jump.
        near(solved(|p| if p < 1.9 { 0.999 } else { 60.0 }), 1.9, 30);
        near(solved(|p| if p < 1.1 { 0.9 } else { 1.001 }), 1.1, 30);
        near(solved(|p| (p - 1.2).max(0.0) / 0.3), 1.5, 10);
        near(solved(|p| 10f64.powf(20.0 * (p - 1.9))), 1.9, 8);
    }

    #[test]
    fn no_error_is_stated_where_there_is_no_slope() {
        let jump = Enclosure { loads: [1.0, 1.0005], values: [0.0, 2.0] };
        assert_eq!((jump.slope(), jump.next(false), jump.root()), (None, None, 1.0005));
        let infinite = Enclosure { loads: [1.0, 2.0], values: [0.5, f64::INFINITY] };
        assert_eq!((infinite.slope(), infinite.next(false)), (None, Some(2f64.sqrt())));
    }
}
