//! The text of a table as instruments and spreadsheets export it: its encoding, separators, line of names and decimal commas.
//!
//! Lines that begin with `#`, and empty ones, are comments. Lines before the one that names the columns are a preamble.

use percoat_common::encoding::utf8_or_latin1;
use std::borrow::Cow;

/// A table: the names of its columns, a unit for each where a line of units follows them, and its lines.
#[derive(Debug)]
pub(super) struct Table<'a> {
    /// Number of the line of names, from 1.
    pub line: usize,
    pub names: Vec<&'a str>,
    /// Cells of the line of units; empty without one.
    pub units: Vec<&'a str>,
    /// Number and cells of each line behind.
    pub rows: Vec<(usize, Vec<&'a str>)>,
    separator: Separator,
}

/// Separator of the cells of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Separator {
    Character(char),
    /// Two spaces or more; names may have single ones.
    Gap,
    Space,
}

/// The text of a file: UTF-8, UTF-16 where it begins with its mark, else Latin-1; with line ends of any system.
pub fn text(bytes: &[u8]) -> Cow<'_, str> {
    let wide = |units: &mut dyn Iterator<Item = u16>| -> String {
        char::decode_utf16(units).map(|unit| unit.unwrap_or(char::REPLACEMENT_CHARACTER)).collect()
    };
    let pairs = |of: fn([u8; 2]) -> u16| bytes[2..].chunks_exact(2).map(move |pair| of([pair[0], pair[1]]));
    let text: Cow<'_, str> = match bytes {
        [0xff, 0xfe, ..] => wide(&mut pairs(u16::from_le_bytes)).into(),
        [0xfe, 0xff, ..] => wide(&mut pairs(u16::from_be_bytes)).into(),
        _ => utf8_or_latin1(bytes),
    };
    let text = match text {
        Cow::Borrowed(text) => Cow::Borrowed(text.strip_prefix('\u{feff}').unwrap_or(text)),
        decoded => decoded,
    };
    // Old ends of lines: a return alone.
    if text.contains('\r') { text.replace("\r\n", "\n").replace('\r', "\n").into() } else { text }
}

impl<'a> Table<'a> {
    /// The table in a text whose line of names fulfils a condition; without one that of the first line that is not all numbers.
    /// `None` where no line can name columns.
    pub fn of(text: &'a str, names_columns: impl Fn(&[&str]) -> bool) -> Option<Self> {
        let is_content = |(_, line): &(usize, &str)| !line.trim().is_empty() && !line.trim_start().starts_with('#');
        let lines: Vec<(usize, &str)> = (1..).zip(text.lines()).filter(is_content).collect();
        fn head(line: &str) -> (Separator, Vec<&str>) {
            let separator = Separator::of(line);
            (separator, separator.cells(line))
        }
        let named = lines.iter().position(|(_, line)| names_columns(&head(line).1));
        let place = match named {
            Some(place) => place,
            None => {
                let is_text = |(_, line): &(usize, &str)| {
                    let (separator, cells) = head(line);
                    !cells.iter().all(|cell| separator.number(cell).is_some())
                };
                is_text(lines.first()?).then_some(0)?
            }
        };
        let (separator, names) = head(lines[place].1);
        // Numbers have no spaces within.
        let separator = if separator == Separator::Gap { Separator::Space } else { separator };
        let mut rows: Vec<(usize, Vec<&str>)> =
            lines[place + 1..].iter().map(|(number, line)| (*number, separator.cells(line))).collect();
        rows.retain(|(_, cells)| !cells.is_empty());
        let is_of_units = |(_, cells): &(usize, Vec<&str>)| {
            named.is_some()
                && cells.len() <= names.len()
                && cells.iter().all(|cell| separator.number(cell).is_none())
                && cells.iter().any(|cell| percoat_common::measure::Measure::of(bare(cell)).is_some())
        };
        let units = if rows.first().is_some_and(is_of_units) { rows.remove(0).1 } else { Vec::new() };
        Some(Self { line: lines[place].0, names, units, rows, separator })
    }

    /// The number of a cell; `None` where it is none.
    pub fn number(&self, cell: &str) -> Option<f64> {
        self.separator.number(cell)
    }
}

/// A text without the brackets around it.
pub(super) fn bare(text: &str) -> &str {
    let text = text.trim();
    let within = |open, close| text.strip_prefix(open)?.strip_suffix(close);
    within('(', ')').or_else(|| within('[', ']')).unwrap_or(text).trim()
}

impl Separator {
    fn of(line: &str) -> Self {
        match ['\t', ';', ','].into_iter().find(|&separator| line.contains(separator)) {
            Some(separator) => Self::Character(separator),
            None if line.trim().contains("  ") => Self::Gap,
            None => Self::Space,
        }
    }

    /// The cells of a line, without quotes and without empty ones at its end.
    fn cells(self, line: &str) -> Vec<&str> {
        let mut cells: Vec<&str> = match self {
            Self::Character(separator) => {
                // A separator between quotes belongs to its cell.
                let mut is_quoted = false;
                let splits = |c: char| {
                    is_quoted ^= c == '"';
                    c == separator && !is_quoted
                };
                line.split(splits).collect()
            }
            Self::Gap => line.split("  ").filter(|cell| !cell.trim().is_empty()).collect(),
            Self::Space => line.split_whitespace().collect(),
        };
        cells.iter_mut().for_each(|cell| *cell = cell.trim().trim_matches('"').trim());
        while cells.last().is_some_and(|cell| cell.is_empty()) {
            cells.pop();
        }
        cells
    }

    /// The number of a cell, with a decimal comma where cells are not separated by commas.
    fn number(self, cell: &str) -> Option<f64> {
        let has_comma = self != Self::Character(',') && cell.matches(',').count() == 1 && !cell.contains('.');
        if has_comma { cell.replace(',', ".").parse().ok() } else { cell.parse().ok() }
    }
}
