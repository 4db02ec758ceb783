//! A utilisation with its error over the load, the interval of its limit, and the load that narrows it most.

use super::curve::{LOADS_APART, UtilisationCurve};

/// Ratio of the loads between which an end of the interval of a limit is known well enough, as the error of the utilisation sets it.
const INTERVAL_ENDS_APART: f64 = 1.1;

/// A utilisation u with its error e over the load.
#[derive(Debug, Clone)]
pub(super) struct UtilisationBand {
    /// u.
    pub value: UtilisationCurve,
    /// u + e.
    pub upper: UtilisationCurve,
    /// u − e.
    pub lower: UtilisationCurve,
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

/// An end of the interval of a limit, by the loads that were solved.
struct IntervalEnd {
    /// Mean pressure; while a `next` load is left to solve, the outer one of the two loads that enclose the end.
    load: f64,
    /// Mean pressure to solve next to know the end better; `None` where it is known well enough.
    next: Option<f64>,
}

impl IntervalEnd {
    fn known(load: f64) -> Self {
        Self { load, next: None }
    }
}

impl UtilisationBand {
    /// The band through samples [p̄, u, e], by ascending mean pressure p̄.
    pub fn new(samples: impl Iterator<Item = [f64; 3]>) -> Self {
        let samples: Vec<[f64; 3]> = samples.collect();
        let side = |sign: f64| {
            // An infinite utilisation has no error; one that is not a number may be anything.
            let value = |u: f64, e: f64| match u + sign * e {
                _ if u.is_infinite() => u,
                x if x.is_nan() && sign > 0.0 => f64::INFINITY,
                x if x.is_nan() => f64::NEG_INFINITY,
                x => x,
            };
            UtilisationCurve { samples: samples.iter().map(|&[p, u, e]| [p, value(u, e)]).collect() }
        };
        Self { value: side(0.0), upper: side(1.0), lower: side(-1.0) }
    }

    /// Whether u − e reaches 1 under a load that was solved.
    pub fn fails(&self) -> bool {
        self.lower.first_failure().is_some()
    }

    /// Mean pressure to solve next to know where u becomes 1, or how large it becomes, the middle of an interval where `halve` is
    /// set; `None` where that is known.
    pub fn next(&self, halve: bool) -> Option<f64> {
        let first = self.value.first_failure();
        let root = first.filter(|&above| above > 0).and_then(|above| self.value.enclosure(above).next(halve));
        // Humps that would come first, then the ends of the interval.
        root.or_else(|| {
            self.value.humps(first.unwrap_or(usize::MAX)).find_map(|index| self.value.middle(index, LOADS_APART))
        })
        .or_else(|| self.from().next.or_else(|| self.to().next))
        .or_else(|| self.value.towards_largest().filter(|_| first.is_none()))
    }

    /// Mean pressures at which u, u + e and u − e become 1, by the loads that were solved.
    pub fn crossing(&self) -> Crossing {
        let at = self.at();
        Crossing { from: self.from().load.min(at), at, to: self.to().load.max(at) }
    }

    /// The least mean pressure at which u reaches 1; infinite where it never does.
    fn at(&self) -> f64 {
        match self.value.first_failure() {
            None => f64::INFINITY,
            Some(0) => self.value.samples[0][0],
            Some(above) => self.value.enclosure(above).root(),
        }
    }

    /// Uncertainty of the crossing of u in ln p̄, by the error, the slope there and the uncertainty of the root; `None` where these
    /// are large or the utilisation does not grow.
    fn blur(&self) -> Option<f64> {
        let above = self.value.first_failure().filter(|&above| above > 0)?;
        let enclosure = self.value.enclosure(above);
        let nearest = if enclosure.first_is_nearer() { above - 1 } else { above };
        let open = enclosure.uncertainty().ln_1p();
        let [_, value] = self.value.samples[nearest];
        let error = self.upper.samples[nearest][1] - value;
        let blur = match enclosure.slope() {
            Some(_) => (error / (value * self.value.slope_around(enclosure.root())?)).hypot(open),
            // The utilisation jumps.
            None => open,
        };
        (blur <= INTERVAL_ENDS_APART.ln()).then_some(blur)
    }

    /// The lower end of the interval: the least mean pressure at which u + e may reach 1.
    fn from(&self) -> IntervalEnd {
        let above = self.upper.first_failure();
        let near = self.blur().map(|blur| self.at() * (-blur).exp());
        let crossed = match above {
            None => IntervalEnd::known(f64::INFINITY),
            Some(0) => return IntervalEnd::known(0.0),
            Some(above) => {
                let low = self.upper.samples[above - 1][0];
                match near.filter(|&near| self.upper.samples[above][0] >= near) {
                    Some(near) => IntervalEnd::known(near.max(low)),
                    None => match self.upper.middle(above - 1, INTERVAL_ENDS_APART) {
                        Some(middle) => IntervalEnd { load: low, next: Some(middle) },
                        None => IntervalEnd::known(self.upper.enclosure(above).root()),
                    },
                }
            }
        };
        match self.upper.humps(above.unwrap_or(usize::MAX)).next() {
            Some(index) if near.is_none_or(|near| self.upper.samples[index + 1][0] < near) => {
                IntervalEnd { load: self.upper.samples[index][0], next: self.upper.middle(index, INTERVAL_ENDS_APART) }
            }
            _ => crossed,
        }
    }

    /// The upper end of the interval: the least mean pressure at which u − e reaches 1.
    fn to(&self) -> IntervalEnd {
        let Some(first) = self.value.first_failure() else { return IntervalEnd::known(f64::INFINITY) };
        let sure = (first..self.lower.samples.len()).find(|&index| self.lower.samples[index][1] >= 1.0);
        let Some(sure) = sure else { return IntervalEnd::known(f64::INFINITY) };
        if sure == 0 {
            return IntervalEnd::known(self.lower.samples[0][0]);
        }
        let [low, high] = [self.lower.samples[sure - 1][0], self.lower.samples[sure][0]];
        match self.blur().map(|blur| self.at() * blur.exp()).filter(|&near| low <= near) {
            Some(near) => IntervalEnd::known(near.min(high)),
            None => match self.lower.middle(sure - 1, INTERVAL_ENDS_APART) {
                Some(middle) => IntervalEnd { load: high, next: Some(middle) },
                None => IntervalEnd::known(self.lower.enclosure(sure).root()),
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Crossing and band of a utilisation with its error over ln p̄, searched from loads that double, and the number of further loads.
    fn found(utilisation: impl Fn(f64) -> [f64; 2], first: f64) -> (Crossing, UtilisationBand, usize) {
        let solve = |p: f64| {
            let [u, e] = utilisation(p);
            [p, u, e]
        };
        let mut samples: Vec<[f64; 3]> = (0..12).map(|k| solve(first * 2f64.powi(k))).collect();
        for trial in 0..60 {
            let band = UtilisationBand::new(samples.iter().copied());
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
            let [_, top] = band.value.samples[band.value.largest()];
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
            assert!((1.0 / INTERVAL_ENDS_APART - 5e-3..1.005).contains(&(from * 1.1f64.powi(3) / 100.0)), "{from}");
            assert!((to * 0.9f64.powi(3) / 100.0 - 1.0).abs() < 5e-3, "{to}");
            let (Crossing { from, at, to }, ..) = found(rise(1e-4), first);
            assert!(from < at && at < to && (3e-4..1.5e-3).contains(&(to / from - 1.0)), "{from} {at} {to}");
        }
    }

    /// Ends of intervals are the outer loads where no load between the doublings is solved: 51.2 below 75.1, and 204.8 above 137.2.
    #[test]
    fn an_interval_that_is_not_narrowed_yet_holds_both_ends() {
        let band = UtilisationBand::new((0..12).map(|k| {
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
            assert!((1.0 / INTERVAL_ENDS_APART - 5e-3..1.005).contains(&(from / exact)), "{from} {exact}");
            assert_eq!(found(|_| [0.1, 2.0], first).0.from, 0.0);
            assert_eq!(found(|_| [0.1, 0.2], first).0.from, f64::INFINITY);
        }
    }
}
