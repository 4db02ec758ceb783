//! Decimal commas in a text whose numbers are separated by commas: "0,5,0,3" is two heights or four.
//!
//! Every second number of decimal commas is the digits behind a comma: it has no sign, may have leading zeros, and exponents
//! follow only these numbers. Where the spelling is not conclusive the values are compared: along a line of a surface the numbers at
//! even and odd places have similar differences and similar means.
//!
//! A comma may also separate thousands, "5,234.50": between commas pairs of one to three digits and of three digits with a point.
//! Numbers that other characters separate are ambiguous too, "5,234" is 5.234 or 5234: three digits behind every comma, and no
//! zero before one.

use super::fault::{Fault, Heights};

/// Ratio of the squared differences of the two halves beyond which they are not similar.
const UNLIKE: f64 = 4.0;
/// Mean difference of the two halves over the rms difference of neighbours, beyond which they are not similar.
const APART: f64 = 0.6;
/// Fewest pairs of numbers that are compared.
const FEWEST: usize = 16;

/// Spelling of the numbers of a text by their place in the line: the first, third, … and the second, fourth, …
#[derive(Debug, Clone, Copy, Default)]
pub struct Commas {
    has_points: bool,
    leading_zeros: [bool; 2],
    signs: [usize; 2],
    exponents: [bool; 2],
    /// Whether a number shows that commas do not separate thousands: between commas other than one to three digits at odd places or
    /// three before a point at even ones; elsewhere no comma, other than three digits behind it, or a zero before it.
    no_thousands: bool,
}

/// Whether a number without its sign can be the first group of thousands.
fn is_first_group(digits: &str) -> bool {
    (1..=3).contains(&digits.len()) && !digits.starts_with('0') && is_digits(digits)
}

fn is_digits(text: &str) -> bool {
    text.bytes().all(|byte| byte.is_ascii_digit())
}

impl Commas {
    /// Notes the spelling of number `column` of a line, from 0.
    pub fn note(&mut self, column: usize, part: &str) {
        let half = column % 2;
        let digits = part.trim_start_matches(['+', '-']);
        let bytes = digits.as_bytes();
        self.has_points |= digits.contains('.');
        self.signs[half] += usize::from(digits.len() < part.len());
        self.leading_zeros[half] |= bytes.len() > 1 && bytes[0] == b'0' && bytes[1].is_ascii_digit();
        self.exponents[half] |= digits.contains(['e', 'E']);
        let group = digits.split_once('.').map_or(digits, |(whole, _)| whole);
        self.no_thousands |= match half {
            0 => !is_first_group(digits),
            _ => part.len() > digits.len() || group.len() != 3 || !is_digits(group),
        };
    }

    /// Notes the spelling of a number with a decimal comma, in a text with another separator.
    pub fn note_decimal(&mut self, part: &str) {
        let digits = part.trim_start_matches(['+', '-']);
        let is_thousand = |(first, rest): (&str, &str)| is_first_group(first) && rest.len() == 3 && is_digits(rest);
        self.no_thousands |= !digits.split_once(',').is_some_and(is_thousand);
    }

    /// A warning where every decimal comma of a text with another separator may separate thousands.
    pub fn doubt_decimal(&self, count: usize) -> Option<String> {
        (!self.no_thousands && count >= FEWEST).then(|| {
            "surface.heights: every number has three digits behind its comma, which is read as a decimal one, 5,234 as 5.234: \
             thousands? Write them without commas"
                .to_owned()
        })
    }

    /// Refuses a text whose spelling shows decimal commas or thousands.
    pub fn refuse(&self, [lines, columns]: [usize; 2]) -> Result<(), Fault> {
        let could_be = !self.has_points && columns.is_multiple_of(2) && self.signs[1] == 0 && !self.exponents[0];
        if could_be && ((self.leading_zeros[1] && !self.leading_zeros[0]) || self.exponents[1]) {
            let what = format!(
                "holds {lines} lines of {columns} whole numbers between commas, every second one spelt like the digits behind a \
                 decimal comma"
            );
            return Err(Fault::new(what, format!("decimal commas, {lines} × {}?", columns / 2)).help(HELP));
        }
        if self.has_points && columns.is_multiple_of(2) && !self.no_thousands {
            let what = format!(
                "holds {lines} lines of {columns} numbers between commas, in turn one to three digits and three before a point"
            );
            let label = format!("commas between thousands, {lines} × {}?", columns / 2);
            return Err(Fault::new(what, label).help("write numbers without commas between thousands"));
        }
        Ok(())
    }

    /// A warning where the values suggest decimal commas.
    pub fn doubt(&self, heights: &Heights) -> Option<String> {
        let [lines, columns] = heights.points;
        let could_be = !self.has_points && self.signs[1] == 0 && !self.exponents.contains(&true);
        if !could_be || columns % 2 == 1 || columns < 4 || lines * columns < 2 * FEWEST {
            return None;
        }
        // Only every second column has signs.
        let signed = columns >= 8 && 8 * self.signs[0] >= lines * columns;
        (signed || halves_differ(heights)).then(|| {
            format!(
                "surface.heights holds {lines} lines of {columns} whole numbers between commas, every second one unlike its \
                 neighbours, and is read so: decimal commas, {lines} × {}? {HELP}",
                columns / 2
            )
        })
    }
}

const HELP: &str = "write decimal points, or part the numbers by semicolons, tabs or blanks";

/// Whether the numbers at even and odd places differ as different quantities do.
fn halves_differ(heights: &Heights) -> bool {
    let columns = heights.points[1];
    let (mut changes, mut risen, mut across, mut between, mut count) = ([0.0; 2], [0.0; 2], 0.0, 0.0, 0.0);
    for line in heights.values.chunks_exact(columns) {
        for (j, three) in line.windows(3).enumerate() {
            changes[j % 2] += (three[2] - three[0]).powi(2);
            risen[j % 2] += f64::from(u8::from(three[2] != three[0]));
            // A value less the mean of its neighbours: slope and curvature of the surface cancel.
            let bend = three[1] - 0.5 * (three[0] + three[2]);
            across += if j.is_multiple_of(2) { bend } else { -bend };
            between += bend * bend;
            count += 1.0;
        }
    }
    let (mean, rms): (f64, f64) = (across / count, f64::sqrt(between / count));
    let livelier = usize::from(changes[1] > changes[0]);
    // A few peaks in one half are possible on a surface.
    let are_unlike = changes[livelier] > UNLIKE * changes[1 - livelier] && risen[livelier] > 0.25 * count;
    are_unlike || mean.abs() > APART * rms
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(heights: &[f64], columns: usize, digits: usize) -> String {
        let line = |line: &[f64]| line.iter().map(|h| format!("{h:.digits$}").replace('.', ",")).collect::<Vec<_>>();
        heights.chunks(columns).map(|row| line(row).join(",") + "\n").collect()
    }

    fn found(text: &str) -> (bool, bool) {
        let (mut commas, mut values, mut columns) = (Commas::default(), Vec::new(), 0);
        for line in text.lines() {
            columns = line.split(',').count();
            line.split(',').enumerate().for_each(|(k, part)| commas.note(k, part));
            values.extend(line.split(',').map(|part| part.parse::<f64>().unwrap()));
        }
        let points = [values.len() / columns, columns];
        (commas.refuse(points).is_err(), commas.doubt(&Heights { points, values }).is_some())
    }

    fn waves(size: f64) -> Vec<f64> {
        let wave = |k: usize| (0.37 * (k / 24) as f64).sin() + (0.51 * (k % 24) as f64).cos() + (1.7 * k as f64).sin();
        (0..24 * 24).map(|k| size * wave(k)).collect()
    }

    #[test]
    fn decimal_commas_between_commas_do_not_pass_and_whole_numbers_do() {
        for size in [0.3, 1.0, 7.0, 40.0, 300.0] {
            for offset in [0.0, 100.0, 1000.0] {
                let heights: Vec<f64> = waves(size).iter().map(|h| h + offset).collect();
                for digits in [1, 2, 3, 6] {
                    let (refused, doubted) = found(&table(&heights, 24, digits));
                    assert!(refused || doubted, "{size} {offset} {digits}");
                }
                assert_eq!(found(&table(&heights, 24, 0)), (false, false), "{size} {offset}");
            }
        }
        assert!(found("1,5E-3,2,5E-3\n1,5E-3,2,5E-3\n").0);
    }

    #[test]
    fn commas_between_thousands_do_not_pass() {
        assert!(found("1,234.5,-5,234.0\n12,000.,123,999.25\n").0);
        for other in ["1,234.5,0,234.0\n", "1,234.5,5,-234.0\n", "1,234.5,5,23.0\n", "1.5,234.5,5.5,231.0\n"] {
            assert!(!found(other).0, "{other}");
        }
        let doubted = |numbers: &[&str]| {
            let mut commas = Commas::default();
            (0..FEWEST).for_each(|k| commas.note_decimal(numbers[k % numbers.len()]));
            commas.doubt_decimal(FEWEST).is_some()
        };
        assert!(doubted(&["5,234", "-12,000", "+999,999"]));
        for other in ["0,234", "5,23", "5,2345", "5234", "5,234e3", "1,234,567"] {
            assert!(!doubted(&["5,234", other]), "{other}");
        }
    }
}
