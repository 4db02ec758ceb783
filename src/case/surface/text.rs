//! Matrices of numbers as text: one line a row along **a**₁, its numbers along **a**₂.
//!
//! Numbers stand apart by semicolons, tabs, commas or blanks, whichever the first line has, in this order. Where commas do
//! not separate, they are decimal commas. Lines that begin with # or %, and empty ones, count for nothing.

use super::fault::{Fault, Heights, Lines, MOST, fits};
use std::io::BufRead;

/// What stands between the numbers of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Separator {
    Mark(char),
    Blanks,
}

impl Separator {
    fn of(line: &str) -> Self {
        // "1,5 2,5": where every word between blanks has a comma between digits at most, and no point, it is a decimal one.
        let words: Vec<&str> = line.split_whitespace().collect();
        let is_decimal = |word: &&str| match word.split_once(',') {
            None => true,
            Some((whole, part)) => {
                let digit = |c: char| c.is_ascii_digit();
                whole.ends_with(digit) && part.starts_with(digit) && !part.contains(',') && !word.contains('.')
            }
        };
        let is_apart_by_blanks = words.len() > 1 && words.iter().all(is_decimal);
        match line {
            _ if line.contains(';') => Self::Mark(';'),
            _ if line.contains('\t') => Self::Mark('\t'),
            _ if line.contains(',') && !is_apart_by_blanks => Self::Mark(','),
            _ => Self::Blanks,
        }
    }

    /// The parts of a line; one separator at its end is none.
    fn split(self, line: &str) -> Vec<&str> {
        match self {
            Self::Mark(mark) => line.strip_suffix(mark).unwrap_or(line).split(mark).map(str::trim).collect(),
            Self::Blanks => line.split_whitespace().collect(),
        }
    }

    fn number(self, part: &str) -> Option<f64> {
        if self != Self::Mark(',') && part.contains(',') {
            // Where a point stands too, one of them marks thousands.
            return part.replacen(',', ".", 1).parse().ok().filter(|_| !part.contains('.'));
        }
        part.parse().ok()
    }
}

/// Read a matrix of `bytes` bytes.
pub(super) fn read(reader: impl BufRead, bytes: u64) -> Result<Heights, Fault> {
    let mut lines = Lines::new(reader);
    let (mut values, mut rows, mut columns, mut separator) = (Vec::new(), 0, 0, None);
    while let Some((number, line)) = lines.next_line()? {
        let own = *separator.get_or_insert_with(|| Separator::of(&line));
        let parts = own.split(&line);
        if rows == 0 {
            columns = parts.len();
            let expected = bytes / (line.len() as u64 + 1) + 1;
            // The list of values grows by doubling.
            fits(16 * expected * columns as u64)?;
        }
        for (column, part) in (1..).zip(&parts) {
            match own.number(part) {
                Some(value) => values.push(value),
                None if rows == 0 => {
                    let what = format!("line {number} holds \"{part}\", which is no number");
                    return Err(Fault::new(what, format!("line {number}: a header?"))
                        .help("remove a header, or begin its lines with #"));
                }
                None => {
                    let what = format!("line {number} holds \"{part}\" as number {column}");
                    return Err(Fault::new(what, format!("line {number}"))
                        .help("every height must be a number, none left out: fill what was not measured before"));
                }
            }
        }
        if parts.len() != columns {
            let what = format!("line {number} holds {} numbers, those before {columns}", parts.len());
            return Err(Fault::new(what, format!("line {number}")));
        }
        rows += 1;
        if rows > MOST || columns > MOST {
            break;
        }
    }
    Heights::new([rows, columns], values)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str) -> Result<Heights, Fault> {
        read(text.as_bytes(), text.len() as u64)
    }

    #[test]
    fn every_separator_and_both_decimal_marks_give_the_same_heights() {
        let expected = Heights { points: [2, 3], values: vec![1.5, -2.0, 3e-2, 4.0, 5.25, 6.0] };
        for text in [
            "1.5,-2,3e-2\n4,5.25,6\n",
            "# heights in nm\n% of a disc\n\n1.5, -2, 3e-2\n4, 5.25, 6",
            "1.5;-2;3e-2\r\n4;5.25;6\r\n",
            "1,5;-2;3e-2;\n4;5,25;6;\n",
            "\u{feff}1,5\t-2\t3e-2\n4\t5,25\t6\n",
            "  1.5  -2 3e-2\n4 5.25    6 \n",
            "1,5 -2 3e-2\n4 5,25 6\n",
        ] {
            assert_eq!(of(text), Ok(expected.clone()), "{text:?}");
        }
    }

    #[test]
    fn numbers_between_commas_may_be_padded_with_blanks() {
        let found = |text: &str| of(text).unwrap().values;
        assert_eq!(found("   10,  200,30000\n    1,    2,    3\n"), [10.0, 200.0, 30000.0, 1.0, 2.0, 3.0]);
        assert_eq!(found(" 123.40, 123.50,1234.50\n1,2,3\n")[..3], [123.4, 123.5, 1234.5]);
    }

    #[test]
    fn what_is_no_matrix_is_refused_with_its_line() {
        for (text, words) in [
            ("x,y\n1,2\n3,4\n", ["line 1 holds \"x\"", "begin its lines with #"]),
            ("# a\n1,2\n3,\n", ["line 3 holds 1 numbers, those before 2", ""]),
            ("1;2\n3;;4\n", ["line 2 holds \"\" as number 2", "none left out"]),
            ("1 2\n3 ---\n", ["line 2 holds \"---\"", ""]),
            ("1.234,5;2\n1;2\n", ["line 1 holds \"1.234,5\"", ""]),
            ("1 2\n3 nan\n", ["holds nan at [1, 1]", "finite"]),
            ("1 2 3\n", ["1 × 3 heights", ""]),
            ("", ["0 × 0 heights", ""]),
        ] {
            let fault = of(text).unwrap_err();
            let told = format!("{} {} {}", fault.what, fault.label, fault.help.clone().unwrap_or_default());
            assert!(words.iter().all(|word| told.contains(word)), "{text:?}: {told}");
        }
    }
}
