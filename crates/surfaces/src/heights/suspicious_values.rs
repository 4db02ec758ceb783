//! Values that are probably not heights: coordinates, marks of missing data, digits behind decimal commas.
//!
//! [`no_data`] refuses values that no surface has; [`doubts`] returns warnings about implausible ones, which are used nevertheless. Samples
//! without a measurement are not a number, and left out of both.

use super::fault::{Fault, Heights, MARK};
use percoat_core::numeric::sums;

/// Values that instruments and programs write for missing data.
const NO_DATA: [f64; 20] = [
    -999.0,
    -9999.0,
    -99999.0,
    -999999.0,
    9999.0,
    99999.0,
    999999.0,
    -32768.0,
    -32767.0,
    32767.0,
    65535.0,
    -2147483648.0,
    2147483647.0,
    2147483640.0,
    1e10,
    -1e10,
    1e20,
    1e30,
    -1e30,
    -1e32,
];
/// Values for missing data that are written to a few digits: Surfer's blank, netCDF's fill, the limits of single precision.
const NO_DATA_ABOUT: [f64; 5] = [1.701_41e38, 9.969_21e36, 3.402_82e38, -3.402_82e38, -1e38];
/// Distance of an outlier from the mean, standard deviations.
const OUTSIDE: f64 = 20.0;
/// Fewest values of a line that rises evenly.
const RISES: usize = 6;
/// Largest deviation of coordinates from even spacing, in spacings.
const NEAR: f64 = 0.1;

/// Heights as they are; refused where [`no_data`] refuses them.
pub fn checked(heights: Heights) -> Result<Heights, Fault> {
    no_data(&heights).map(|()| heights)
}

/// Refuses marks of missing data: values of [`NO_DATA`] farther from all others than these from each other.
pub fn no_data(heights: &Heights) -> Result<(), Fault> {
    let values = &heights.values;
    let is = |code: f64, about: f64, x: f64| (x - code).abs() <= about * code.abs();
    let codes = NO_DATA.iter().map(|code| (*code, 0.0)).chain(NO_DATA_ABOUT.iter().map(|code| (*code, 1e-4)));
    // Only values between the smallest and the largest height can occur.
    let (low, high) = ends(values.iter().copied());
    for (code, about) in codes {
        if !is(code, about, low) && !is(code, about, high) {
            continue;
        }
        let (least, most) = ends(values.iter().copied().filter(|x| !is(code, about, *x)));
        let (gap, range) = (if code < least { least - code } else { code - most }, most - least);
        if range > 0.0 && gap > range {
            let count = values.iter().filter(|x| is(code, about, **x)).count();
            let first = values.iter().position(|x| is(code, about, *x)).expect("one end of the numbers");
            let n2 = heights.points[1];
            let what = format!(
                "holds {code:?} at {count} of {} places, the first at [{}, {}]: it lies far from all other heights and marks \
                 places without a measurement",
                values.len(),
                first / n2,
                first % n2
            );
            return Err(Fault::new(what, "no data").help(MARK));
        }
    }
    Ok(())
}

fn ends(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
}

/// Warnings about implausible heights, a sentence each.
pub fn doubts(heights: &Heights) -> Vec<String> {
    let rises = [0, 1].into_iter().filter_map(|axis| rising(heights, axis));
    let zeros = [0, 1].into_iter().filter_map(|axis| alternating(heights, axis));
    let zeros: Vec<String> = zeros.take(1).collect();
    rises.chain(zeros).chain(alone(heights).or_else(|| outside(heights))).chain(three(heights)).collect()
}

/// The heights along `axis` at index `k` of the other one.
fn line(heights: &Heights, axis: usize, k: usize) -> impl Iterator<Item = f64> + Clone + '_ {
    (0..heights.points[axis]).map(move |index| at(heights, axis, k, index))
}

/// The height number `index` along `axis` at index `k` of the other one.
fn at(heights: &Heights, axis: usize, k: usize, index: usize) -> f64 {
    let [_, n2] = heights.points;
    heights.values[if axis == 0 { index * n2 + k } else { k * n2 + index }]
}

/// A warning about lines along `axis` that rise evenly while most do not: coordinates.
fn rising(heights: &Heights, axis: usize) -> Option<String> {
    let (count, lines) = (heights.points[axis], heights.points[1 - axis]);
    if count < RISES {
        return None;
    }
    let is_even = |k: &usize| {
        let [first, last] = [0, count - 1].map(|index| at(heights, axis, *k, index));
        let step = (last - first) / (count - 1) as f64;
        step != 0.0
            && line(heights, axis, *k)
                .enumerate()
                .all(|(index, x)| (x - first - index as f64 * step).abs() <= NEAR * step.abs())
    };
    let found: Vec<usize> = (0..lines).filter(is_even).collect();
    // A plane rises everywhere.
    let first = *found.first().filter(|_| 2 * found.len() <= lines)?;
    let at = if axis == 0 { format!("[:, {first}]") } else { format!("[{first}, :]") };
    let more = if found.len() > 1 { format!(" and {} more lines", found.len() - 1) } else { String::new() };
    Some(format!(
        "surface.heights: heights{at}{more} rise evenly and the others do not: coordinates beside the heights? The file must hold \
         heights alone"
    ))
}

/// A warning where every second number along `axis` is 0.
fn alternating(heights: &Heights, axis: usize) -> Option<String> {
    let [n1, n2] = heights.points;
    if heights.points[axis] < 4 || n1 * n2 < 32 {
        return None;
    }
    // Most surfaces have no line of zeros: the first one tells.
    let half = |half: usize| {
        let rows = heights.values.chunks_exact(n2).enumerate();
        let values = rows.filter(move |(i, _)| axis == 1 || i % 2 == half).flat_map(move |(_, row)| {
            let (first, step) = if axis == 1 { (half, 2) } else { (0, 1) };
            row[first..].iter().step_by(step)
        });
        values.copied()
    };
    if (0..2).all(|number| half(number).any(|x| x.abs() > 0.0)) {
        return None;
    }
    let ends = [0, 1].map(|number| ends(half(number)));
    let is_zero = ends.map(|ends| ends == (0.0, 0.0));
    let varies = |half: usize| ends[half].0 < ends[half].1;
    let found = (0..2).any(|half| is_zero[half] && varies(1 - half));
    let along = if axis == 1 {
        "number along a₂ is 0: decimal commas read as separators"
    } else {
        "line along a₁ is 0: lines left out"
    };
    found.then(|| format!("surface.heights: every second {along}, or another quantity beside the heights?"))
}

/// A warning about a height that occurs several times, far from all others.
fn alone(heights: &Heights) -> Option<String> {
    let values = &heights.values;
    let (low, high) = ends(values.iter().copied());
    [low, high].into_iter().find_map(|code| {
        let count = values.iter().filter(|x| **x == code).count();
        if count < 2 || 5 * count > values.len() {
            return None;
        }
        let others = || values.iter().copied().filter(|x| *x != code);
        let (least, most) = ends(others());
        let gap = if code < least { least - code } else { code - most };
        (gap > OUTSIDE * deviation(others())[1] && gap > 2.0 * (most - least) && most > least).then(|| {
            let first = values.iter().position(|x| *x == code).expect("it occurs");
            let n2 = heights.points[1];
            format!(
                "surface.heights: the same height occurs at {count} of {} places, the first at [{}, {}], far from all others: does it \
                 mark places without a measurement? They must be nan in a text or an array, or marked in the program that wrote the \
                 file",
                values.len(),
                first / n2,
                first % n2
            )
        })
    })
}

/// Mean and standard deviation of the values that a condition admits.
fn deviation_of(values: &[f64], admits: impl Fn(usize) -> bool + Sync) -> [f64; 2] {
    let counts = |k: usize| !values[k].is_nan() && admits(k);
    let [count, sum] = sums::of(values.len(), |k| if counts(k) { [1.0, values[k]] } else { [0.0; 2] });
    let mean: f64 = sum / count;
    let [square] = sums::of(values.len(), |k| if counts(k) { [(values[k] - mean).powi(2)] } else { [0.0] });
    [mean, (square / count).sqrt()]
}

/// Mean and standard deviation.
fn deviation(values: impl Iterator<Item = f64>) -> [f64; 2] {
    deviation_of(&values.collect::<Vec<_>>(), |_| true)
}

/// A warning about a height far outside the distribution of the others.
fn outside(heights: &Heights) -> Option<String> {
    let values = &heights.values;
    let [mean, _] = deviation_of(values, |_| true);
    let distance = |x: f64| if x.is_nan() { -1.0 } else { (x - mean).abs() };
    let most = -sums::least(values.len(), |k| -distance(values[k]));
    let farthest = values.iter().rposition(|&x| most >= 0.0 && distance(x) == most)?;
    let [mean, rest] = deviation_of(values, |k| k != farthest);
    let away = (values[farthest] - mean).abs();
    // On a flat surface with one peak the standard deviation is rounding.
    let (is_number, times) = (rest > 1e-12 * away, away / rest);
    (is_number && times > OUTSIDE).then(|| {
        let n2 = heights.points[1];
        format!(
            "surface.heights: the height at [{}, {}] lies {times:.0} standard deviations from the mean of the others, a peak or a pit \
             that hardly any surface has: a fault of the measurement? Marked as not measured it is filled",
            farthest / n2,
            farthest % n2
        )
    })
}

/// A warning about three columns without similarity: points rather than heights.
fn three(heights: &Heights) -> Option<String> {
    let [lines, 3] = heights.points else { return None };
    let column = |k: usize| line(heights, 0, k);
    let alike = |a: usize, b: usize| {
        let [[mean_a, deviation_a], [mean_b, deviation_b]] = [a, b].map(|k| deviation(column(k)));
        let products = column(a).zip(column(b)).map(|(x, y)| (x - mean_a) * (y - mean_b));
        let both: f64 = products.filter(|product| !product.is_nan()).sum();
        both >= 0.5 * deviation_a * deviation_b * lines as f64
    };
    (lines >= 16 && !alike(0, 1) && !alike(1, 2)).then(|| {
        format!(
            "surface.heights holds {lines} lines of three numbers that have little in common, and is read as {lines} × 3 heights: \
             points x y z? They must stand on a regular grid, in a file .xyz"
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn surface([n1, n2]: [usize; 2], height: impl Fn(usize, usize) -> f64) -> Heights {
        Heights { points: [n1, n2], values: (0..n1 * n2).map(|k| height(k / n2, k % n2)).collect() }
    }

    /// Rough enough that no line is straight.
    fn rough(i: usize, j: usize) -> f64 {
        (0.7 * i as f64).sin() + (1.3 * j as f64).cos() + (2.9 * (i * j) as f64).sin()
    }

    #[test]
    fn surfaces_are_not_doubted() {
        let plane = |i: usize, j: usize| 0.1 * i as f64 - 0.3 * j as f64;
        let bump = |i: usize, j: usize| (1.0 - 0.01 * ((i as f64 - 20.0).powi(2) + (j as f64 - 20.0).powi(2))).max(0.0);
        for (name, heights) in [
            ("rough", surface([40, 40], rough)),
            ("offset", surface([40, 40], |i, j| 1e4 + rough(i, j))),
            ("tilted", surface([40, 40], |i, j| 100.0 * plane(i, j) + rough(i, j))),
            ("plane", surface([40, 30], plane)),
            ("flat", surface([16, 16], |_, _| 3.0)),
            ("flat but one", surface([3, 3], |i, j| f64::from(u8::from(i == 1 && j == 1)))),
            ("bump", surface([40, 40], bump)),
            ("pillars", surface([32, 32], |i, j| if i % 8 < 2 && j % 8 < 2 { 1.0 + 0.01 * rough(i, j) } else { 0.0 })),
            ("grating", surface([32, 32], |_, j| f64::from(u8::from(j.is_multiple_of(2))))),
            ("mask of 16 bits", surface([32, 32], |i, _| if i < 16 { 0.0 } else { 65535.0 })),
            ("saturated", surface([32, 32], |i, j| (40000.0 * rough(i, j)).clamp(-32768.0, 32767.0).round())),
            ("large", surface([32, 32], |i, j| if i == j { -9999.0 } else { 9000.0 * rough(i, j) })),
            ("scratch", surface([40, 40], |i, j| rough(i, j) - if j == 7 { 30.0 } else { 0.0 })),
            ("three alike", surface([64, 3], |i, j| (0.2 * i as f64).sin() + 0.1 * rough(i, j))),
        ] {
            assert_eq!((no_data(&heights), doubts(&heights)), (Ok(()), Vec::new()), "{name}");
        }
    }

    #[test]
    fn places_without_a_measurement_are_refused_however_many() {
        for code in NO_DATA.iter().chain(&NO_DATA_ABOUT) {
            for every in [2, 5, 97, 1600] {
                let heights =
                    surface([40, 40], |i, j| if (40 * i + j).is_multiple_of(every) { *code } else { rough(i, j) });
                let fault = no_data(&heights).unwrap_err();
                let told = format!("at {} of 1600 places, the first at [0, 0]", 1600_usize.div_ceil(every));
                assert!(fault.what.contains(&told), "{code} {every}: {}", fault.what);
                // Nobody writes into the file of an instrument.
                assert!(fault.help.is_some_and(|help| help.contains("in the program that wrote the file")));
            }
        }
    }

    #[test]
    fn what_hardly_any_surface_has_is_told() {
        let hash = |k: usize| (k * 2_654_435_761 % 4096) as f64 / 4096.0;
        for (heights, words) in [
            (surface([40, 41], |i, j| if j == 0 { 0.02 * i as f64 } else { rough(i, j) }), "heights[:, 0] rise evenly"),
            (
                surface([40, 41], |i, j| if j == 40 { -3.0 * i as f64 } else { rough(i, j) }),
                "heights[:, 40] rise evenly",
            ),
            (surface([41, 40], |i, j| if i == 0 { 5.0 + j as f64 } else { rough(i, j) }), "heights[0, :] rise evenly"),
            (
                surface([40, 42], |i, j| if j < 2 { (1 + i) as f64 } else { rough(i, j) }),
                "heights[:, 0] and 1 more lines rise evenly",
            ),
            (surface([24, 2], |i, j| if j == 0 { 0.33 * i as f64 } else { rough(i, 3) }), "heights[:, 0] rise evenly"),
            (
                surface([40, 40], |i, j| if j.is_multiple_of(2) { (9.0 * rough(i, j)).round() } else { 0.0 }),
                "along a₂ is 0",
            ),
            (surface([40, 40], |i, j| if j % 2 == 1 { (9.0 * rough(i, j)).round() } else { 0.0 }), "along a₂ is 0"),
            (surface([40, 40], |i, j| if i % 2 == 1 { rough(i, j) } else { 0.0 }), "along a₁ is 0"),
            (surface([40, 40], |i, j| if (i, j) == (7, 9) { 300.0 } else { rough(i, j) }), "[7, 9] lies"),
            (
                surface([64, 64], |i, j| if i == j && i > 60 { -900.0 + i as f64 } else { rough(i, j) }),
                "standard deviations",
            ),
            (
                surface([40, 40], |i, j| if (i + 3 * j).is_multiple_of(31) { 0.0 } else { 50.0 + 0.5 * rough(i, j) }),
                "the same height occurs at",
            ),
            (surface([64, 3], |i, j| hash(3 * i + j)), "64 lines of three numbers"),
            (
                surface([40, 40], |i, j| match (i, j) {
                    (7, 9) => 300.0,
                    (8, 9) => f64::NAN,
                    _ => rough(i, j),
                }),
                "[7, 9] lies",
            ),
        ] {
            let told = doubts(&heights).join("\n");
            assert!(told.contains(words), "\"{words}\" does not stand in {told:?}");
        }
    }
}
