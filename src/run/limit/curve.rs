//! What is known of a utilisation over the load, and which load tells more about where it is 1.

/// Relative accuracy of a limit.
const TOLERANCE: f64 = 1e-3;
/// So much of it may be left between a load that was solved and the root that the secant foretells from there.
const NEAR: f64 = 0.3;
/// Utilisations whose ratio is nearer to one do not tell which of them is larger.
const ALIKE: f64 = 1e-3;
/// A largest utilisation below this part of a failure is not looked for between the loads: with twice the load stresses are
/// twice as large at most.
const WORTH: f64 = 0.5;
/// So well a largest utilisation that is no failure is told, relatively.
const TOLD: f64 = 0.01;
/// Loads around a largest utilisation that are closer tell it well enough.
const CLOSE: f64 = 1.05;
/// Where a utilisation grows faster than p̄ to this power, it may as well jump: a root beside a load that was solved needs a
/// load on its other side.
const STEEP: f64 = 2.0;
/// The slope that turns the error of a utilisation into one of its limit is that between loads so far apart: within a
/// thousandth a stress at an edge of contact may jump from sample to sample.
const APART: f64 = 1.2;

/// Mean pressures that were solved, ascending, and the utilisation under each.
#[derive(Debug, Clone)]
pub(super) struct Curve(pub Vec<[f64; 2]>);

/// Two loads between which a utilisation becomes one.
#[derive(Debug, Clone, Copy)]
pub(super) struct Enclosure {
    /// Mean pressures.
    loads: [f64; 2],
    /// Utilisations, the first below one and the second not.
    values: [f64; 2],
}

impl Curve {
    /// The first load that fails.
    pub fn first_failure(&self) -> Option<usize> {
        self.0.iter().position(|[_, u]| *u >= 1.0)
    }

    /// The load that fails and the one before it.
    pub fn enclosure(&self, above: usize) -> Enclosure {
        let [[low, under], [high, over]] = [self.0[above - 1], self.0[above]];
        Enclosure { loads: [low, high], values: [under, over] }
    }

    /// Whether the first utilisation that differs from that at the lowest load is larger.
    pub fn falls_with_the_load(&self) -> bool {
        let [_, first] = self.0[0];
        self.0.iter().find(|[_, u]| (u - first).abs() > ALIKE * first).is_some_and(|[_, u]| *u > first)
    }

    /// The load of the largest utilisation.
    pub fn largest(&self) -> usize {
        let value = |index: usize| self.0[index][1];
        (0..self.0.len()).max_by(|&i, &j| value(i).total_cmp(&value(j)).then(j.cmp(&i))).unwrap_or(0)
    }

    /// The load to solve next in search of a larger utilisation, as long as there may be one of 1, or the top between the
    /// loads is badly known. A parabola through the largest one and its neighbours at equal distances of ln p̄ rises by an
    /// eighth of the larger drop to them at most; twice that is reckoned with.
    pub fn towards_largest(&self) -> Option<f64> {
        let at = self.largest();
        let [p, u] = self.0[at];
        let beside = [at.checked_sub(1), Some(at + 1)].map(|index| self.0.get(index?).copied());
        let drops = beside.iter().flatten().map(|[_, other]| u - other);
        let rise = 0.25 * drops.fold(0.0, f64::max);
        let may_fail = u + rise.max(ALIKE * u) >= 1.0;
        let is_rough = beside.iter().all(Option::is_some) && rise > 2.0 * TOLD * u;
        let apart = |&[other, _]: &[f64; 2]| (other / p).ln().abs();
        let far = beside.into_iter().flatten().max_by(|a, b| apart(a).total_cmp(&apart(b)));
        let far = far.filter(|far| apart(far) > CLOSE.ln())?;
        (u > WORTH && (may_fail || is_rough)).then(|| (p * far[0]).sqrt())
    }

    /// d ln u / d ln p̄ around a load, between the nearest two loads that are far enough apart; `None` where it does not
    /// grow.
    pub fn slope_around(&self, load: f64) -> Option<f64> {
        let usable = |[_, u]: &&[f64; 2]| *u > 0.0 && u.is_finite();
        let (reach, usable) = (APART.sqrt(), self.0.iter().filter(usable).collect::<Vec<_>>());
        let below = usable.iter().rev().find(|[p, _]| *p * reach <= load).or(usable.first())?;
        let above = usable.iter().find(|[p, _]| *p >= load * reach).or(usable.last())?;
        let slope = (above[1] / below[1]).ln() / (above[0] / below[0]).ln();
        (slope > 0.0 && slope.is_finite()).then_some(slope)
    }
}

impl Enclosure {
    /// d ln u / d ln p̄; `None` where a utilisation is zero or infinite: it jumps.
    pub fn slope(&self) -> Option<f64> {
        let ([low, high], [under, over]) = (self.loads, self.values);
        (under > 0.0 && over.is_finite()).then(|| (over / under).ln() / (high / low).ln())
    }

    /// Where the secant of ln u over ln p̄ is zero; the upper end where there is none.
    pub fn root(&self) -> f64 {
        let [low, high] = self.loads;
        self.slope().map_or(high, |slope| (low * (-self.values[0].ln() / slope).exp()).clamp(low, high))
    }

    pub fn first_is_nearer(&self) -> bool {
        let [under, over] = self.values.map(|value| value.ln().abs());
        under < over
    }

    /// How far the root may be from what was solved, relatively: by the secant, or by the loads that enclose it.
    pub fn open(&self) -> f64 {
        let [low, high] = self.loads;
        if self.slope().is_some() { (high / low - 1.0).min(NEAR * TOLERANCE) } else { high / low - 1.0 }
    }

    /// The load to solve next, or none where the root is known well enough.
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

    /// u(ln p̄) whose loads were solved at powers of two from a first one on; how many more loads it took.
    fn largest_of(utilisation: impl Fn(f64) -> f64, first: f64) -> ([f64; 2], usize) {
        let solve = |p: f64| [p, utilisation(p)];
        let mut curve = Curve((0..12).map(|k| solve(first * 2f64.powi(k))).collect());
        for trial in 0..40 {
            let next = curve.towards_largest().filter(|_| curve.first_failure().is_none());
            let Some(next) = next else { return (curve.0[curve.largest()], trial) };
            curve.0.push(solve(next));
            curve.0.sort_by(|a, b| a[0].total_cmp(&b[0]));
        }
        panic!("not found");
    }

    #[test]
    fn a_utilisation_that_rises_and_falls_is_followed_to_its_top() {
        for shift in [0.0, 0.2, 0.4, 0.6, 0.8] {
            let first = 2f64.powf(shift);
            let hill = |top: f64| move |p: f64| top * (-0.3 * (p / 90.0).ln().powi(2)).exp();
            let ([p, u], trials) = largest_of(hill(1.01), first);
            assert!(u >= 1.0 && trials <= 6 && (p / 90.0).ln().abs() < 0.2, "{first}: {p} {u} {trials}");
            let ([_, u], trials) = largest_of(hill(0.995), first);
            // It ends where what may still be above does not reach 1.
            assert!(u > 0.985 && trials <= 10, "{first}: {u} {trials}");
            assert!(largest_of(hill(0.8), first).1 <= 2 && largest_of(hill(0.3), first).1 == 0);
            assert_eq!(largest_of(|p| 0.6 * (p / 2048.0 / first).cbrt(), first).1, 0);
        }
        let falling =
            |values: &[f64]| Curve((1..).zip(values).map(|(p, u)| [f64::from(p), *u]).collect()).falls_with_the_load();
        assert!(falling(&[0.1, 0.2]) && falling(&[0.0, 0.0, 0.3, 0.0]) && falling(&[0.5, 0.500_01, 0.6]));
        assert!(!falling(&[0.0]) && !falling(&[0.0, 0.0]) && !falling(&[0.2, 0.1, 0.5]));
    }

    #[test]
    fn no_error_is_stated_where_there_is_no_slope() {
        let jump = Enclosure { loads: [1.0, 1.0005], values: [0.0, 2.0] };
        assert_eq!((jump.slope(), jump.next(false), jump.root()), (None, None, 1.0005));
        let infinite = Enclosure { loads: [1.0, 2.0], values: [0.5, f64::INFINITY] };
        assert_eq!((infinite.slope(), infinite.next(false)), (None, Some(2f64.sqrt())));
    }
}
