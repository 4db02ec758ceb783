//! A utilisation over the load: the loads that were solved, and bounds between them.

use super::enclosure::Enclosure;

/// Utilisation below which a largest value is not searched for between the loads.
const RELEVANT: f64 = 0.5;
/// Relative accuracy of a largest utilisation below 1.
const LARGEST_TOLERANCE: f64 = 0.01;
/// Ratio of neighbouring loads below which neither a hump nor a largest utilisation is searched for between them.
pub(super) const LOADS_APART: f64 = 1.05;
/// Factor on the slopes beside an interval with which they bound those within it.
const SLOPE_SAFETY: f64 = 1.5;
/// Least slope |du/d ln p̄| that is taken for an interval, over u.
const LEAST_SLOPE: f64 = 0.1;
/// Ratio of the loads between which the slope is taken that turns the error of a utilisation into one of its limit: within a
/// thousandth a stress at an edge of contact may jump from sample to sample.
const SLOPE_BASE: f64 = 1.2;

/// Utilisations under the mean pressures that were solved.
#[derive(Debug, Clone)]
pub(super) struct UtilisationCurve {
    /// Mean pressure and utilisation, by ascending pressure.
    pub samples: Vec<[f64; 2]>,
}

impl UtilisationCurve {
    /// Index of the first load under which the utilisation reaches 1.
    pub fn first_failure(&self) -> Option<usize> {
        self.samples.iter().position(|[_, u]| *u >= 1.0)
    }

    /// The load with the index `above`, under which the utilisation reaches 1, and the one before it.
    pub fn enclosure(&self, above: usize) -> Enclosure {
        let [[low, under], [high, over]] = [self.samples[above - 1], self.samples[above]];
        Enclosure { loads: [low, high], values: [under, over] }
    }

    /// Index of the load with the largest utilisation.
    pub fn largest(&self) -> usize {
        let value = |index: usize| self.samples[index][1];
        (0..self.samples.len()).max_by(|&i, &j| value(i).total_cmp(&value(j)).then(j.cmp(&i))).unwrap_or(0)
    }

    /// Mean pressure to solve next where the largest utilisation below 1 is not known to [`LARGEST_TOLERANCE`]. A parabola through it
    /// and its neighbours at equal distances of ln p̄ rises by an eighth of the larger drop to them at most; twice that is
    /// allowed for.
    pub fn towards_largest(&self) -> Option<f64> {
        let at = self.largest();
        let [p, u] = self.samples[at];
        let beside = [at.checked_sub(1), Some(at + 1)].map(|index| self.samples.get(index?).copied());
        let drops = beside.iter().flatten().map(|[_, other]| u - other);
        let rise = 0.25 * drops.fold(0.0, f64::max);
        let is_rough = beside.iter().all(Option::is_some) && rise > LARGEST_TOLERANCE * u;
        let apart = |&[other, _]: &[f64; 2]| (other / p).ln().abs();
        let far = beside.into_iter().flatten().max_by(|a, b| apart(a).total_cmp(&apart(b)));
        let far = far.filter(|far| apart(far) > LOADS_APART.ln())?;
        (u > RELEVANT && is_rough).then(|| (p * far[0]).sqrt())
    }

    /// Slope du/d ln p̄ between load `index` and the next; `None` beyond the ends.
    fn slope(&self, index: usize) -> Option<f64> {
        let [[low, under], [high, over]] = [*self.samples.get(index)?, *self.samples.get(index + 1)?];
        Some((over - under) / (high / low).ln())
    }

    /// Upper bound of the utilisation between load `index` and the next. Within an interval a concave curve lies below
    /// the continued chords of the neighbouring intervals; a curve of any shape lies below lines of the steepest slope.
    /// Taken are the slopes of this interval and its neighbours, times [`SLOPE_SAFETY`], and [`LEAST_SLOPE`] at least.
    fn bound(&self, index: usize) -> f64 {
        let [[low, under], [high, over]] = [self.samples[index], self.samples[index + 1]];
        let width = (high / low).ln();
        let flat = LEAST_SLOPE * under.abs().max(over.abs());
        let steepest = |slopes: [Option<f64>; 2], sign: f64| {
            let slopes = slopes.into_iter().flatten().map(|slope| sign * slope).filter(|slope| slope.is_finite());
            (SLOPE_SAFETY * slopes.fold(0.0, f64::max)).max(flat)
        };
        let up = steepest([index.checked_sub(1).and_then(|before| self.slope(before)), self.slope(index)], 1.0);
        let down = steepest([self.slope(index), self.slope(index + 1)], -1.0);
        if up + down == 0.0 {
            return under.max(over);
        }
        let meet = ((over - under + down * width) / (up + down)).clamp(0.0, width);
        (under + up * meet).max(under).max(over)
    }

    /// The intervals below load `end`, by the index of their first load, in which the utilisation may reach 1.
    pub fn humps(&self, end: usize) -> impl Iterator<Item = usize> {
        (0..end.min(self.samples.len()).saturating_sub(1)).filter(|&index| self.bound(index) >= 1.0)
    }

    /// Geometric mean of load `index` and the next; `None` where their ratio is not above `ratio`.
    pub fn middle(&self, index: usize, ratio: f64) -> Option<f64> {
        let [low, high] = [self.samples[index][0], self.samples[index + 1][0]];
        (high / low > ratio).then(|| (low * high).sqrt())
    }

    /// Slope d ln u / d ln p̄ around a load, between the nearest two loads that are far enough apart; `None` where u does not
    /// grow.
    pub fn slope_around(&self, load: f64) -> Option<f64> {
        let usable = |[_, u]: &&[f64; 2]| *u > 0.0 && u.is_finite();
        let (reach, usable) = (SLOPE_BASE.sqrt(), self.samples.iter().filter(usable).collect::<Vec<_>>());
        let below = usable.iter().rev().find(|[p, _]| *p * reach <= load).or(usable.first())?;
        let above = usable.iter().find(|[p, _]| *p >= load * reach).or(usable.last())?;
        let slope = (above[1] / below[1]).ln() / (above[0] / below[0]).ln();
        (slope > 0.0 && slope.is_finite()).then_some(slope)
    }
}
