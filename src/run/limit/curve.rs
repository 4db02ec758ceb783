//! What is known of a utilisation over the load, and which load tells more about where it is 1.

/// Relative accuracy of a limit.
const TOLERANCE: f64 = 1e-3;
/// So much of it may be left between a load that was solved and the root that the secant foretells from there.
const NEAR: f64 = 0.3;
/// A largest utilisation below this part of a failure is not searched for between the loads.
const WORTH: f64 = 0.5;
/// Relative accuracy of a largest utilisation below 1.
const TOP_TOLERANCE: f64 = 0.01;
/// Ratio of neighbouring loads below which a hump between them is not searched for, nor a largest utilisation.
const CLOSE: f64 = 1.05;
/// The same ratio for the ends of the interval of a limit, which the error of the utilisation sets.
const BLURRED: f64 = 1.1;
/// Slopes beside an interval, times this, bound those within it.
const STEEPER: f64 = 1.5;
/// |du/d ln p̄| within an interval is at least taken to be this part of u.
const FLAT: f64 = 0.1;
/// Where a utilisation grows faster than p̄ to this power, it may as well jump: a root beside a load that was solved needs a
/// load on its other side.
const STEEP: f64 = 2.0;
/// The slope that turns the error of a utilisation into one of its limit is that between loads so far apart: within a
/// thousandth a stress at an edge of contact may jump from sample to sample.
const APART: f64 = 1.2;

/// Mean pressures that were solved, ascending, and the utilisation under each.
#[derive(Debug, Clone)]
pub(super) struct Curve(pub Vec<[f64; 2]>);

/// A utilisation u with its error e over the load: u, u + e and u − e.
#[derive(Debug, Clone)]
pub(super) struct Band {
    pub value: Curve,
    pub upper: Curve,
    pub lower: Curve,
}

/// Mean pressures at which a utilisation becomes 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Crossing {
    /// The least load at which u + e may reach 1; 0 where it does at the least load that was solved.
    pub from: f64,
    /// The least load at which u does; infinite where it never does.
    pub at: f64,
    /// The least load at which u − e does; infinite where it never does.
    pub to: f64,
}

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

    /// The load of the largest utilisation.
    pub fn largest(&self) -> usize {
        let value = |index: usize| self.0[index][1];
        (0..self.0.len()).max_by(|&i, &j| value(i).total_cmp(&value(j)).then(j.cmp(&i))).unwrap_or(0)
    }

    /// The load to solve next where the largest utilisation below 1 is not known to [`TOP_TOLERANCE`]. A parabola through it
    /// and its neighbours at equal distances of ln p̄ rises by an eighth of the larger drop to them at most; twice that is
    /// allowed for.
    pub fn towards_largest(&self) -> Option<f64> {
        let at = self.largest();
        let [p, u] = self.0[at];
        let beside = [at.checked_sub(1), Some(at + 1)].map(|index| self.0.get(index?).copied());
        let drops = beside.iter().flatten().map(|[_, other]| u - other);
        let rise = 0.25 * drops.fold(0.0, f64::max);
        let is_rough = beside.iter().all(Option::is_some) && rise > TOP_TOLERANCE * u;
        let apart = |&[other, _]: &[f64; 2]| (other / p).ln().abs();
        let far = beside.into_iter().flatten().max_by(|a, b| apart(a).total_cmp(&apart(b)));
        let far = far.filter(|far| apart(far) > CLOSE.ln())?;
        (u > WORTH && is_rough).then(|| (p * far[0]).sqrt())
    }

    /// du/d ln p̄ between load `index` and the next; `None` beyond the ends.
    fn slope(&self, index: usize) -> Option<f64> {
        let [[low, under], [high, over]] = [*self.0.get(index)?, *self.0.get(index + 1)?];
        Some((over - under) / (high / low).ln())
    }

    /// The largest utilisation that can hide between load `index` and the next. Within an interval a concave curve lies below
    /// the continued chords of the neighbouring intervals; a curve of any shape lies below lines of the steepest slope.
    /// Taken are the slopes of this interval and its neighbours, times [`STEEPER`], and [`FLAT`] at least.
    fn bound(&self, index: usize) -> f64 {
        let [[low, under], [high, over]] = [self.0[index], self.0[index + 1]];
        let width = (high / low).ln();
        let flat = FLAT * under.abs().max(over.abs());
        let steepest = |slopes: [Option<f64>; 2], sign: f64| {
            let slopes = slopes.into_iter().flatten().map(|slope| sign * slope).filter(|slope| slope.is_finite());
            (STEEPER * slopes.fold(0.0, f64::max)).max(flat)
        };
        let up = steepest([index.checked_sub(1).and_then(|before| self.slope(before)), self.slope(index)], 1.0);
        let down = steepest([self.slope(index), self.slope(index + 1)], -1.0);
        if up + down == 0.0 {
            return under.max(over);
        }
        let meet = ((over - under + down * width) / (up + down)).clamp(0.0, width);
        (under + up * meet).max(under).max(over)
    }

    /// The intervals below load `end` in which the curve may reach 1.
    fn humps(&self, end: usize) -> impl Iterator<Item = usize> {
        (0..end.min(self.0.len()).saturating_sub(1)).filter(|&index| self.bound(index) >= 1.0)
    }

    /// The middle of the interval from load `index` on, where its ends are further apart than `ratio`.
    fn middle(&self, index: usize, ratio: f64) -> Option<f64> {
        let [low, high] = [self.0[index][0], self.0[index + 1][0]];
        (high / low > ratio).then(|| (low * high).sqrt())
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

/// An end of the interval of a limit, as far as the loads that were solved tell.
struct End {
    /// Mean pressure; while a `next` load is left to solve, the outer one of the two loads that enclose the end.
    load: f64,
    /// The load to solve next to know the end better.
    next: Option<f64>,
}

impl End {
    fn known(load: f64) -> Self {
        Self { load, next: None }
    }
}

impl Band {
    /// From a mean pressure, a utilisation and its error each, by ascending load.
    pub fn new(samples: impl Iterator<Item = [f64; 3]>) -> Self {
        let samples: Vec<[f64; 3]> = samples.collect();
        let side = |sign: f64| {
            // What is infinite has no error; what is not a number may be anything.
            let value = |u: f64, e: f64| match u + sign * e {
                _ if u.is_infinite() => u,
                x if x.is_nan() && sign > 0.0 => f64::INFINITY,
                x if x.is_nan() => f64::NEG_INFINITY,
                x => x,
            };
            Curve(samples.iter().map(|&[p, u, e]| [p, value(u, e)]).collect())
        };
        Self { value: side(0.0), upper: side(1.0), lower: side(-1.0) }
    }

    /// Whether u − e reaches 1 at a load that was solved.
    pub fn fails(&self) -> bool {
        self.lower.first_failure().is_some()
    }

    /// The load to solve next to know where the utilisation becomes 1, or how far it is from that; `None` where that is known.
    pub fn next(&self, halve: bool) -> Option<f64> {
        let first = self.value.first_failure();
        let root = first.filter(|&above| above > 0).and_then(|above| self.value.enclosure(above).next(halve));
        // Humps that would come first, then the ends of the interval.
        root.or_else(|| self.value.humps(first.unwrap_or(usize::MAX)).find_map(|index| self.value.middle(index, CLOSE)))
            .or_else(|| self.from().next.or_else(|| self.to().next))
            .or_else(|| self.value.towards_largest().filter(|_| first.is_none()))
    }

    /// Where the utilisation becomes 1, by the loads that were solved.
    pub fn crossing(&self) -> Crossing {
        let at = self.at();
        Crossing { from: self.from().load.min(at), at, to: self.to().load.max(at) }
    }

    /// The least load at which u reaches 1.
    fn at(&self) -> f64 {
        match self.value.first_failure() {
            None => f64::INFINITY,
            Some(0) => self.value.0[0][0],
            Some(above) => self.value.enclosure(above).root(),
        }
    }

    /// How far the error moves the crossing of u in ln p̄, by the slope there, where the error and what the search leaves open
    /// are small and the utilisation grows.
    fn blur(&self) -> Option<f64> {
        let above = self.value.first_failure().filter(|&above| above > 0)?;
        let enclosure = self.value.enclosure(above);
        let nearest = if enclosure.first_is_nearer() { above - 1 } else { above };
        let open = enclosure.open().ln_1p();
        let [_, value] = self.value.0[nearest];
        let error = self.upper.0[nearest][1] - value;
        let blur = match enclosure.slope() {
            Some(_) => (error / (value * self.value.slope_around(enclosure.root())?)).hypot(open),
            // It jumps.
            None => open,
        };
        (blur <= BLURRED.ln()).then_some(blur)
    }

    fn from(&self) -> End {
        let above = self.upper.first_failure();
        let near = self.blur().map(|blur| self.at() * (-blur).exp());
        let crossed = match above {
            None => End::known(f64::INFINITY),
            Some(0) => return End::known(0.0),
            Some(above) => {
                let low = self.upper.0[above - 1][0];
                match near.filter(|&near| self.upper.0[above][0] >= near) {
                    Some(near) => End::known(near.max(low)),
                    None => match self.upper.middle(above - 1, BLURRED) {
                        Some(middle) => End { load: low, next: Some(middle) },
                        None => End::known(self.upper.enclosure(above).root()),
                    },
                }
            }
        };
        match self.upper.humps(above.unwrap_or(usize::MAX)).next() {
            Some(index) if near.is_none_or(|near| self.upper.0[index + 1][0] < near) => {
                End { load: self.upper.0[index][0], next: self.upper.middle(index, BLURRED) }
            }
            _ => crossed,
        }
    }

    fn to(&self) -> End {
        let Some(first) = self.value.first_failure() else { return End::known(f64::INFINITY) };
        let sure = (first..self.lower.0.len()).find(|&index| self.lower.0[index][1] >= 1.0);
        let Some(sure) = sure else { return End::known(f64::INFINITY) };
        if sure == 0 {
            return End::known(self.lower.0[0][0]);
        }
        let [low, high] = [self.lower.0[sure - 1][0], self.lower.0[sure][0]];
        match self.blur().map(|blur| self.at() * blur.exp()).filter(|&near| low <= near) {
            Some(near) => End::known(near.min(high)),
            None => match self.lower.middle(sure - 1, BLURRED) {
                Some(middle) => End { load: high, next: Some(middle) },
                None => End::known(self.lower.enclosure(sure).root()),
            },
        }
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

    /// What is found of a utilisation and its error over ln p̄ from loads that double, and how many more loads it took.
    fn found(utilisation: impl Fn(f64) -> [f64; 2], first: f64) -> (Crossing, Band, usize) {
        let solve = |p: f64| {
            let [u, e] = utilisation(p);
            [p, u, e]
        };
        let mut samples: Vec<[f64; 3]> = (0..12).map(|k| solve(first * 2f64.powi(k))).collect();
        for trial in 0..60 {
            let band = Band::new(samples.iter().copied());
            let Some(next) = band.next(trial % 3 == 2) else { return (band.crossing(), band, trial) };
            samples.push(solve(next));
            samples.sort_by(|a, b| a[0].total_cmp(&b[0]));
        }
        panic!("not found");
    }

    const STARTS: [f64; 5] = [1.0, 1.149, 1.32, 1.516, 1.741];

    #[test]
    fn a_utilisation_that_rises_and_falls_is_followed_to_its_top() {
        for first in STARTS {
            let hill = |top: f64| move |p: f64| [top * (-0.3 * (p / 90.0).ln().powi(2)).exp(), 0.0];
            let (crossing, _, trials) = found(hill(1.01), first);
            let exact = 90.0 * (-(1.01f64.ln() / 0.3).sqrt()).exp();
            assert!((crossing.at / exact - 1.0).abs() < 2e-3 && trials <= 20, "{first}: {crossing:?} {trials}");
            let (crossing, band, trials) = found(hill(0.97), first);
            let [_, top] = band.value.0[band.value.largest()];
            assert!(crossing.at.is_infinite() && (top / 0.97 - 1.0).abs() < 0.01 && trials <= 12, "{first} {trials}");
            assert!(found(hill(0.3), first).2 == 0);
            assert_eq!(found(|p| [0.6 * (p / 2048.0 / first).cbrt(), 0.0], first).2, 0);
        }
    }

    /// A hump of half the width of the doublings, and a rise far behind it that reaches 1 too.
    #[test]
    fn the_first_crossing_is_that_of_a_hump_before_a_later_rise() {
        for first in STARTS {
            let utilisation = |p: f64| {
                let hump = 1.1 * (-2.0 * (p / 20.0).ln().powi(2)).exp();
                [(hump.powi(4) + (p / 1000.0).powi(4)).powf(0.25), 0.0]
            };
            let (crossing, ..) = found(utilisation, first);
            let exact = 20.0 * (-(1.1f64.ln() / 2.0).sqrt()).exp();
            assert!((crossing.at / exact - 1.0).abs() < 2e-3, "{first}: {crossing:?}");
        }
    }

    /// u = (p/100)^⅓ with an error of a tenth of it: p from 100/1.1³ to 100/0.9³; with one of a ten-thousandth: 3e-4 of p.
    #[test]
    fn the_interval_of_a_limit_reaches_from_value_plus_error_to_value_minus_error() {
        for first in STARTS {
            let rise = |part: f64| move |p: f64| [1.0, part].map(|c| c * (p / 100.0).cbrt());
            let (Crossing { from, at, to }, _, trials) = found(rise(0.1), first);
            assert!((at / 100.0 - 1.0).abs() < 1e-3 && trials <= 12, "{at} {trials}");
            // An interval of loads below it may hide a hump.
            assert!((1.0 / BLURRED - 5e-3..1.005).contains(&(from * 1.1f64.powi(3) / 100.0)), "{from}");
            assert!((to * 0.9f64.powi(3) / 100.0 - 1.0).abs() < 5e-3, "{to}");
            let (Crossing { from, at, to }, ..) = found(rise(1e-4), first);
            assert!(from < at && at < to && (3e-4..1.5e-3).contains(&(to / from - 1.0)), "{from} {at} {to}");
        }
    }

    /// With no load between the doublings solved, the ends are the outer loads: 51.2 below 75.1, and 204.8 above 137.2.
    #[test]
    fn an_interval_that_is_not_narrowed_yet_holds_both_ends() {
        let band = Band::new((0..12).map(|k| {
            let p = 0.1 * 2f64.powi(k);
            [p, (p / 100.0).cbrt(), 0.1 * (p / 100.0).cbrt()]
        }));
        let Crossing { from, to, .. } = band.crossing();
        assert!(
            band.next(false).is_some() && from <= 100.0 / 1.1f64.powi(3) && to >= 100.0 / 0.9f64.powi(3),
            "{from} {to}"
        );
    }

    /// u stays below 1 and u + e does not: from where u + e is 1 on it is undecided.
    #[test]
    fn what_only_value_plus_error_reaches_has_an_interval_without_end() {
        for first in STARTS {
            let below = |p: f64| [0.7 * (-0.1 * (p / 90.0).ln().powi(2)).exp(), 0.4];
            let (Crossing { from, at, to }, ..) = found(below, first);
            let exact = 90.0 * (-((0.7f64 / 0.6).ln() / 0.1).sqrt()).exp();
            assert!(at.is_infinite() && to.is_infinite(), "{at} {to}");
            assert!((1.0 / BLURRED - 5e-3..1.005).contains(&(from / exact)), "{from} {exact}");
            assert_eq!(found(|_| [0.1, 2.0], first).0.from, 0.0);
            assert_eq!(found(|_| [0.1, 0.2], first).0.from, f64::INFINITY);
        }
    }

    #[test]
    fn no_error_is_stated_where_there_is_no_slope() {
        let jump = Enclosure { loads: [1.0, 1.0005], values: [0.0, 2.0] };
        assert_eq!((jump.slope(), jump.next(false), jump.root()), (None, None, 1.0005));
        let infinite = Enclosure { loads: [1.0, 2.0], values: [0.5, f64::INFINITY] };
        assert_eq!((infinite.slope(), infinite.next(false)), (None, Some(2f64.sqrt())));
    }
}
