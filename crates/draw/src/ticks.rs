//! Ticks of axes: round numbers, few enough to be read.

use super::number::{signed, times};
use super::scale::Scale;
use percoat_common::unit::Prefixed;

/// The ticks of an axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Ticks {
    /// Values of ticks with numbers, and the numbers, to be multiplied by ten to the `exponent`.
    pub numbered: Vec<(f64, String)>,
    /// Values of short ticks without numbers.
    pub plain: Vec<f64>,
    /// Exponent of ten by which the numbers are multiplied.
    pub exponent: i32,
}

impl Ticks {
    /// The ticks with their values converted from a unit to that of the case.
    pub fn in_unit(self, unit: &Prefixed) -> Self {
        let inverse = Prefixed { exponent: -unit.exponent, name: String::new() };
        Self {
            numbered: self.numbered.into_iter().map(|(x, number)| (inverse.shown(x), number)).collect(),
            plain: self.plain.into_iter().map(|x| inverse.shown(x)).collect(),
            ..self
        }
    }

    /// The ticks without the numbers that would overlap, given the `span` that a number takes on the sheet.
    pub fn apart(mut self, span: impl Fn(f64, &str) -> Option<[f64; 2]>) -> Self {
        let mut taken: Vec<[f64; 2]> = Vec::new();
        let fits = |(value, number): &(f64, String)| {
            let Some([first, last]) = span(*value, number) else { return true };
            let free = taken.iter().all(|[from, to]| last < *from || first > *to);
            if free {
                taken.push([first, last]);
            }
            free
        };
        let (numbered, left): (Vec<_>, Vec<_>) = self.numbered.into_iter().partition(fits);
        self.plain.extend(left.into_iter().map(|(value, _)| value));
        Self { numbered, ..self }
    }
}

/// Ticks of a range with at most `most` numbers.
pub fn ticks(range: [f64; 2], scale: Scale, most: usize) -> Ticks {
    match scale {
        Scale::Linear => linear_ticks(range, most.max(2)),
        Scale::Log => log_ticks(range, most.max(2)),
        Scale::Degrees => degree_ticks(range, most.max(2)),
    }
}

fn linear_ticks([first, last]: [f64; 2], most: usize) -> Ticks {
    let (low, high) = (first.min(last), first.max(last));
    let largest = low.abs().max(high.abs());
    let rough = (high - low) / most as f64;
    let mut power = rough.log10().floor() as i32;
    let mut step = f64::INFINITY;
    let mut parts = 1;
    'search: for _ in 0..3 {
        for (factor, divisions) in [(1.0, 5), (2.0, 4), (5.0, 5)] {
            step = factor * 10f64.powi(power);
            parts = divisions;
            let slack = 1e-9 * step;
            let count = ((high + slack) / step).floor() - ((low - slack) / step).ceil() + 1.0;
            if count <= most as f64 {
                break 'search;
            }
        }
        power += 1;
    }
    // Numbers from 0.01 to 9999 are written without a power of ten.
    let magnitude = if largest > 0.0 { (largest * (1.0 + 1e-12)).log10().floor() as i32 } else { 0 };
    let exponent = if (-2..4).contains(&magnitude) { 0 } else { magnitude.div_euclid(3) * 3 };
    let decimals = usize::try_from(exponent - power).unwrap_or(0);
    let unit = 10f64.powi(exponent);
    Ticks { exponent, ..marked([low, high], step, parts, |x| format!("{:.decimals$}", x / unit)) }
}

fn degree_ticks([first, last]: [f64; 2], most: usize) -> Ticks {
    let (low, high) = (first.min(last), first.max(last));
    let count = |step: f64| (high / step).floor() - (low / step).ceil() + 1.0;
    let steps = [(15.0, 3), (30.0, 3), (60.0, 4), (90.0, 3), (180.0, 4), (360.0, 4)];
    let (step, parts) = steps.into_iter().find(|&(step, _)| count(step) <= most as f64).unwrap_or((360.0, 4));
    marked([low, high], step, parts, |x| format!("{x:.0}"))
}

/// Ticks with numbers at the multiples of `step`, and short ticks that divide a step into `parts`.
fn marked([low, high]: [f64; 2], step: f64, parts: i32, number: impl Fn(f64) -> String) -> Ticks {
    let slack = 1e-9 * step;
    let multiples = |step: f64| {
        let (from, to) = (((low - slack) / step).ceil() as i64, ((high + slack) / step).floor() as i64);
        (from..=to).map(move |k| (k, k as f64 * step))
    };
    let numbered = multiples(step).map(|(_, x)| (x, signed(&number(x)))).collect();
    let plain = multiples(step / f64::from(parts)).filter(|(k, _)| k % i64::from(parts) != 0).map(|(_, x)| x).collect();
    Ticks { numbered, plain, exponent: 0 }
}

fn log_ticks([first, last]: [f64; 2], most: usize) -> Ticks {
    let (low, high) = (first.min(last) * (1.0 - 1e-9), first.max(last) * (1.0 + 1e-9));
    let decades = low.log10().ceil() as i32..=high.log10().floor() as i32;
    let count = decades.clone().count();
    let all = |factors: &'static [u8]| {
        let decades = low.log10().floor() as i32..=high.log10().floor() as i32;
        let values = decades.flat_map(move |k| factors.iter().map(move |&f| (f, k, f64::from(f) * 10f64.powi(k))));
        values.filter(move |(_, _, x)| (low..=high).contains(x))
    };
    if count >= 2 {
        let stride = count.div_ceil(most) as i32;
        let numbered: Vec<(f64, String)> =
            decades.clone().filter(|k| k.rem_euclid(stride) == 0).map(|k| (10f64.powi(k), times("1", k))).collect();
        let plain = if count <= 8 {
            all(&[2, 3, 4, 5, 6, 7, 8, 9]).map(|(_, _, x)| x).collect()
        } else {
            decades.filter(|k| k.rem_euclid(stride) != 0).map(|k| 10f64.powi(k)).collect()
        };
        return Ticks { numbered, plain, exponent: 0 };
    }
    // Within one decade or two: numbers between the powers, or as on a linear axis where there are too few.
    let named = |(f, k, x): (u8, i32, f64)| {
        let text = match k {
            -2..0 => format!("{x:.*}", usize::try_from(-k).unwrap_or(0)),
            0..4 => format!("{x:.0}"),
            _ => times(&f.to_string(), k),
        };
        (x, text)
    };
    let choices: [&'static [u8]; 5] = [&[1, 2, 3, 4, 5, 6, 7, 8, 9], &[1, 2, 3, 5], &[1, 2, 5], &[1, 3], &[1, 5]];
    // The numbers must span half of the axis.
    let spread = |factors: &'static [u8]| {
        let mut values = all(factors).map(|(_, _, x)| x);
        let first = values.next().unwrap_or(low);
        (values.next_back().unwrap_or(first) / first).ln() > 0.5 * (high / low).ln()
    };
    let fits = |factors: &&'static [u8]| (2..=most).contains(&all(factors).count()) && spread(factors);
    let Some(factors) = choices.into_iter().find(fits) else {
        return linear_ticks([low, high], most);
    };
    let numbered: Vec<(f64, String)> = all(factors).map(named).collect();
    let taken = |x: &f64| !numbered.iter().any(|(value, _)| (value / x - 1.0).abs() < 1e-9);
    let plain = all(choices[0]).map(|(_, _, x)| x).filter(taken).collect();
    Ticks { numbered, plain, exponent: 0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers(range: [f64; 2], scale: Scale, most: usize) -> (Vec<String>, i32) {
        let ticks = ticks(range, scale, most);
        (ticks.numbered.into_iter().map(|(_, text)| text).collect(), ticks.exponent)
    }

    #[test]
    fn linear_ticks_are_round_and_few() {
        assert_eq!(numbers([0.0, 0.06], Scale::Linear, 5).0, ["0.00", "0.02", "0.04", "0.06"]);
        assert_eq!(numbers([-1.1, 1.1], Scale::Linear, 6).0, ["−1.0", "−0.5", "0.0", "0.5", "1.0"]);
        let (texts, exponent) = numbers([0.0, 9.3e9], Scale::Linear, 6);
        assert_eq!((texts.join(" "), exponent), ("0 2 4 6 8".to_owned(), 9));
        let (texts, exponent) = numbers([0.0, 2.1e-5], Scale::Linear, 6);
        assert_eq!((texts.join(" "), exponent), ("0 5 10 15 20".to_owned(), -6));
        for most in 2..12 {
            for k in 1..40 {
                let range = [-0.37 * f64::from(k), 1.9f64.powi(k)];
                let found = ticks(range, Scale::Linear, most).numbered;
                assert!(found.len() <= most && found.len() * 3 >= most.min(6), "{range:?} {most}: {found:?}");
            }
        }
    }

    #[test]
    fn logarithmic_ticks_are_powers_of_ten() {
        assert_eq!(numbers([2e-4, 3.0], Scale::Log, 8).0, ["10⁻³", "10⁻²", "10⁻¹", "1"]);
        assert_eq!(numbers([1e-12, 1.0], Scale::Log, 5).0.len(), 5);
        assert_eq!(numbers([0.01, 0.06], Scale::Log, 4).0, ["0.01", "0.02", "0.03", "0.05"]);
        assert_eq!(numbers([60.0, 700.0], Scale::Log, 5).0, ["100", "200", "300", "500"]);
        assert_eq!(numbers([2e-5, 9e-5], Scale::Log, 4).0, ["2×10⁻⁵", "3×10⁻⁵", "5×10⁻⁵"]);
        assert_eq!(numbers([0.21, 0.29], Scale::Log, 5).0, ["0.22", "0.24", "0.26", "0.28"]);
        assert_eq!(numbers([0.088, 0.19], Scale::Log, 6).0, ["0.10", "0.12", "0.14", "0.16", "0.18"]);
        assert_eq!(
            numbers([2.1e8, 2.9e8], Scale::Log, 5),
            (["220", "240", "260", "280"].map(str::to_owned).to_vec(), 6)
        );
    }

    #[test]
    fn degrees_are_marked_at_parts_of_a_full_circle() {
        assert_eq!(numbers([0.0, 360.0], Scale::Degrees, 7).0, ["0", "60", "120", "180", "240", "300", "360"]);
    }
}
