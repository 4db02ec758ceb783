//! Matrices of numbers as text: one line a row along **a**₁, its numbers along **a**₂.
//!
//! The separator is the first of semicolon, tab, comma and blank in the first line. Where commas do not separate, they are decimal
//! commas. Lines that begin with # or % are comments, some of which [`Header`] reads; empty lines are skipped.

use super::decimal_commas::Commas;
use super::fault::{Fault, Heights, MOST, fits, push};
use super::header::Header;
use super::lines::{Line, Lines};
use std::io::BufRead;

/// Separator of the numbers of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Separator {
    Mark(char),
    Blanks,
}

impl Separator {
    fn of(line: &str) -> Self {
        // "1,5 2,5": commas between digits, in words between blanks without points, are decimal.
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

    /// The parts of a line; one separator at its end is ignored.
    fn split(self, line: &str) -> Vec<&str> {
        match self {
            Self::Mark(mark) => line.strip_suffix(mark).unwrap_or(line).split(mark).map(str::trim).collect(),
            Self::Blanks => line.split_whitespace().collect(),
        }
    }

    fn number(self, part: &str) -> Option<f64> {
        if self != Self::Mark(',') && part.contains(',') {
            // Comma and point in one number: one of them separates thousands.
            return part.replacen(',', ".", 1).parse().ok().filter(|_| !part.contains('.'));
        }
        part.parse().ok()
    }
}

/// A table of numbers, one row a line of the file.
#[derive(Debug)]
pub struct NumberTable {
    /// Numbers line by line; points [lines, numbers of a line].
    pub heights: Heights,
    /// Numbers of the lines in the file; empty for tables of many columns.
    pub lines: Vec<usize>,
    /// Header from its comments.
    pub header: Header,
    /// Warnings about its format, a sentence each.
    pub doubts: Vec<String>,
}

/// Most columns of a table of points.
pub const FEW: usize = 6;

/// Reads a matrix from a file of `bytes` bytes.
pub fn read(reader: impl BufRead, bytes: u64) -> Result<NumberTable, Fault> {
    let mut lines = Lines::new(reader);
    let (mut values, mut rows, mut columns, mut separator) = (Vec::new(), 0, 0, None);
    let (mut commas, mut numbers, mut blocks) = (Commas::default(), Vec::new(), vec![0_usize]);
    while let Some(Line { number, text, is_apart }) = lines.next_line()? {
        let separator = *separator.get_or_insert_with(|| Separator::of(&text));
        let parts = separator.split(&text);
        if rows == 0 {
            columns = parts.len();
            let expected = bytes / (text.len() as u64 + 1) + 1;
            // Before much is read, if the other lines are as long; the list of values grows by doubling.
            fits(16 * expected * columns as u64)?;
        } else if is_apart {
            blocks.push(0);
        }
        for (column, part) in parts.iter().enumerate() {
            let value = separator.number(part).ok_or_else(|| no_number(number, column, part, rows == 0))?;
            push(&mut values, value)?;
            if separator == Separator::Mark(',') {
                commas.note(column, part);
            } else {
                commas.note_decimal(part);
            }
        }
        if parts.len() != columns {
            let what = format!("line {number} holds {} numbers, those before {columns}", parts.len());
            let fault = Fault::new(what, format!("line {number}"));
            let may_be_decimal = separator == Separator::Mark(',') && !text.contains('.');
            return Err(if may_be_decimal { fault.help(DECIMAL) } else { fault });
        }
        if columns <= FEW {
            numbers.push(number);
        }
        rows += 1;
        *blocks.last_mut().expect("one at least") += 1;
        if columns > MOST || (rows > MOST && columns > FEW) {
            break;
        }
    }
    let heights = Heights { points: [rows, columns], values };
    let doubt = match separator {
        Some(Separator::Mark(',')) => {
            commas.refuse([rows, columns])?;
            commas.doubt(&heights)
        }
        _ => commas.doubt_decimal(heights.values.len()),
    };
    let doubts = doubt.into_iter().chain(several(&blocks, columns)).collect();
    Ok(NumberTable { heights, lines: numbers, header: lines.header, doubts })
}

const DECIMAL: &str = "if its commas are decimal ones, write points, or part the numbers by semicolons, tabs or blanks";

/// The fault of a cell that is not a number, `column` counted from 0; its text is not repeated.
fn no_number(line: usize, column: usize, part: &str, is_first: bool) -> Fault {
    let kind = match part {
        "" => "nothing",
        _ if part.contains(',') && part.contains('.') => "a number with a comma and a point",
        _ => "what is no number",
    };
    let what = format!("line {line} holds {kind} as number {}", column + 1);
    match is_first && !part.is_empty() {
        true => Fault::new(what, format!("line {line}: a header?")).help("remove a header, or begin its lines with #"),
        false => Fault::new(what, format!("line {line}"))
            .help("every height must be a number, none left out: write nan for what was not measured"),
    }
}

/// A warning where empty lines divide a matrix into equal blocks of several lines.
fn several(blocks: &[usize], columns: usize) -> Option<String> {
    let [first, rest @ ..] = blocks else { return None };
    let are_equal = !rest.is_empty() && *first > 1 && rest.iter().all(|lines| lines == first);
    (are_equal && columns > FEW).then(|| {
        format!(
            "surface.heights: empty lines part the file into {} blocks of {first} lines, which are read as one surface: several \
             images? Give each a file of its own",
            blocks.len()
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str) -> Result<Heights, Fault> {
        let Heights { points, values } = read(text.as_bytes(), text.len() as u64)?.heights;
        Heights::new(points, values)
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
            ("x,y\n1,2\n3,4\n", ["line 1 holds what is no number as number 1", "begin its lines with #"]),
            ("# a\n1,2\n3,\n", ["line 3 holds 1 numbers, those before 2", "decimal ones"]),
            ("1;2\n3;;4\n", ["line 2 holds nothing as number 2", "none left out"]),
            ("1 2\n3 ---\n", ["line 2 holds what is no number as number 2", ""]),
            ("1.234,5;2\n1;2\n", ["line 1 holds a number with a comma and a point", ""]),
            ("1 2\n3 inf\n", ["holds inf at [1, 1]", "at most 1e60"]),
            ("nan nan\nnan nan\n", ["no measurement", "no heights"]),
            ("1 2 3\n", ["1 × 3 heights", ""]),
            ("", ["0 × 0 heights", ""]),
            ("\u{1}\u{0}", ["line 1", ""]),
        ] {
            let fault = of(text).unwrap_err();
            let told = format!("{} {} {}", fault.what, fault.label, fault.help.clone().unwrap_or_default());
            assert!(words.iter().all(|word| told.contains(word)), "{text:?}: {told}");
        }
    }
}
