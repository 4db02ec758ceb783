//! Measured indentation curves from tables: comma-separated columns, a line for each point.
//!
//! The first line names the columns: `force` and `penetration` in the units of the case, or with a unit behind the name as in
//! `force_mN`, `penetration_nm`, which is converted where the case names its units; `penetration_error` is the standard deviation
//! of each penetration, in the unit of the penetration unless it names its own. Other columns are left out. Lines that
//! begin with `#`, and empty ones, are comments. Columns that stand in no table but in memory are read alike.

use crate::units::{Unit, Units};
use percoat_common::plain;
use percoat_core::identification::{Measurement, MeasurementError};

/// Why a table is no measured curve.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Fault {
    /// No line names columns.
    #[error("no line names the columns: the first one must, as `force,penetration` or `force_mN,penetration_nm`")]
    Empty,
    /// A column that is needed is missing.
    #[error(
        "{}no column `{name}` among {found}; name it, with a unit if it is another than the case's: `{name}_{unit}`",
        at(*.line)
    )]
    Missing {
        /// Line of the names, from 1; `None` where columns stand in no table.
        line: Option<usize>,
        /// The column.
        name: &'static str,
        /// The columns that are there.
        found: String,
        /// A unit as an example.
        unit: &'static str,
    },
    /// A column that is there twice.
    #[error("{}`{}` is there twice, in different units or not: keep one", at(*.0), .1)]
    Twice(Option<usize>, String),
    /// A unit that is not known.
    #[error("{}`{unit}` is no unit of {quantity}: use SI units with a prefix, as {example}", at(*.line))]
    Unit {
        /// Line of the names.
        line: Option<usize>,
        /// The unit.
        unit: String,
        /// The quantity.
        quantity: &'static str,
        /// An example.
        example: &'static str,
    },
    /// The case does not name its units.
    #[error(
        "{}the case does not name SI units, so that `{}` cannot be converted: add [units], or give the column in the case's unit as `{}`",
        at(*.0),
        .1,
        .2
    )]
    Unnamed(Option<usize>, String, &'static str),
    /// A line with another number of cells.
    #[error("line {line}: {found} cells, but {expected} columns are named")]
    Cells {
        /// The line, from 1.
        line: usize,
        /// Number of cells of the line.
        found: usize,
        /// Number of columns.
        expected: usize,
    },
    /// A cell that is no number.
    #[error("line {line}, column {column}: {text} is no number")]
    Number {
        /// The line, from 1.
        line: usize,
        /// The column.
        column: String,
        /// The cell.
        text: String,
    },
    /// Values that are no curve.
    #[error("{}{}", .1.map_or(String::new(), |line| format!("line {line}, ")), .0)]
    Values(MeasurementError, Option<usize>),
}

fn at(line: Option<usize>) -> String {
    line.map_or(String::new(), |line| format!("line {line}: "))
}

/// A column that is read: its place in a line, and the factor to the unit of the case.
#[derive(Debug, Clone, Copy)]
struct Column {
    place: usize,
    factor: f64,
}

/// Kinds of columns: name, quantity, base unit, an example of a unit.
struct Kind {
    name: &'static str,
    quantity: &'static str,
    base: &'static str,
    example: &'static str,
}

const FORCE: Kind = Kind { name: "force", quantity: "force", base: "N", example: "mN" };
const PENETRATION: Kind = Kind { name: "penetration", quantity: "length", base: "m", example: "nm" };
const DEVIATION: Kind = Kind { name: "penetration_error", quantity: "length", base: "m", example: "nm" };

/// The curve of a table, in the `units` of the case.
///
/// # Errors
/// [`Fault`] with the line.
pub fn read(text: &str, units: &Units) -> Result<Measurement, Fault> {
    let is_content = |(_, line): &(usize, &str)| !line.trim().is_empty() && !line.trim_start().starts_with('#');
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut lines = (1..).zip(text.lines()).filter(is_content);
    let (line, head) = lines.next().ok_or(Fault::Empty)?;
    let names: Vec<&str> = cells(head).collect();
    if names.iter().all(|name| name.parse::<f64>().is_ok()) {
        return Err(Fault::Empty);
    }
    let Columns { force, penetration, deviation } = Columns::find(&names, Some(line), units)?;
    let (mut forces, mut penetrations, mut deviations, mut numbers) = (vec![], vec![], vec![], vec![]);
    for (line, row) in lines {
        let row: Vec<&str> = cells(row).collect();
        if row.len() != names.len() {
            return Err(Fault::Cells { line, found: row.len(), expected: names.len() });
        }
        let number = |Column { place, factor }: Column| {
            let fault = || Fault::Number {
                line,
                column: plain::line(names[place]).to_string(),
                text: format!("`{}`", plain::line(row[place])),
            };
            row[place].parse::<f64>().map(|x| x * factor).map_err(|_| fault())
        };
        forces.push(number(force)?);
        penetrations.push(number(penetration)?);
        deviation.map_or(Ok(()), |column| number(column).map(|x| deviations.push(x)))?;
        numbers.push(line);
    }
    Measurement::new(forces, penetrations, deviation.map(|_| deviations)).map_err(|error| {
        let line = match error {
            MeasurementError::Unequal(..) => None,
            MeasurementError::Force(index, _)
            | MeasurementError::Penetration(index, _)
            | MeasurementError::Unloading { from: index, .. }
            | MeasurementError::Hold { from: index, .. }
            | MeasurementError::Deviation(index, _) => numbers.get(index).copied(),
        };
        Fault::Values(error, line)
    })
}

/// The curve of columns in memory with these names, in the `units` of the case.
///
/// # Errors
/// [`Fault`] without a line.
pub fn of_columns(columns: &[(String, Vec<f64>)], units: &Units) -> Result<Measurement, Fault> {
    let names: Vec<&str> = columns.iter().map(|(name, _)| name.as_str()).collect();
    let Columns { force, penetration, deviation } = Columns::find(&names, None, units)?;
    let converted = |Column { place, factor }: Column| columns[place].1.iter().map(|x| x * factor).collect();
    Measurement::new(converted(force), converted(penetration), deviation.map(converted))
        .map_err(|error| Fault::Values(error, None))
}

/// The columns of a curve.
struct Columns {
    force: Column,
    penetration: Column,
    deviation: Option<Column>,
}

impl Columns {
    /// The columns among those with these names, which stand in a line of a table.
    fn find(names: &[&str], line: Option<usize>, units: &Units) -> Result<Self, Fault> {
        let column = |kind: &Kind| column(names, kind, line, units);
        let missing = |kind: &Kind| Fault::Missing {
            line,
            name: kind.name,
            found: plain::line(&names.join(", ")).to_string(),
            unit: kind.example,
        };
        let force = column(&FORCE)?.ok_or_else(|| missing(&FORCE))?;
        let penetration = column(&PENETRATION)?.ok_or_else(|| missing(&PENETRATION))?;
        // Without a unit of its own it has that of the penetration.
        let deviation = column(&DEVIATION)?.map(|column| match names[column.place] == DEVIATION.name {
            true => Column { factor: penetration.factor, ..column },
            false => column,
        });
        Ok(Self { force, penetration, deviation })
    }
}

fn cells(line: &str) -> impl Iterator<Item = &str> {
    line.split(',').map(|cell| cell.trim().trim_matches('"'))
}

/// The column of a kind; `None` where there is none.
fn column(names: &[&str], kind: &Kind, line: Option<usize>, units: &Units) -> Result<Option<Column>, Fault> {
    let is_other = |rest: &str| kind.name == PENETRATION.name && rest.starts_with("_error");
    let unit = |name: &str| -> Option<Option<String>> {
        let rest = name.strip_prefix(kind.name)?;
        let unit = rest.strip_prefix('_').filter(|_| !is_other(rest)).map(|unit| Some(unit.to_owned()));
        if rest.is_empty() { Some(None) } else { unit }
    };
    let mut found = names.iter().enumerate().filter_map(|(place, name)| Some((place, unit(name)?)));
    let Some((place, unit)) = found.next() else { return Ok(None) };
    if let Some((again, _)) = found.next() {
        return Err(Fault::Twice(line, plain::line(names[again]).to_string()));
    }
    let Some(unit) = unit else { return Ok(Some(Column { place, factor: 1.0 })) };
    let Unit::Si { exponent, .. } = Unit::called(&unit, kind.base) else {
        let unit = plain::line(&unit).to_string();
        return Err(Fault::Unit { line, unit, quantity: kind.quantity, example: kind.example });
    };
    let of_case = if kind.base == "N" { units.force() } else { units.length().clone() };
    let Unit::Si { exponent: case_exponent, .. } = of_case else {
        return Err(Fault::Unnamed(line, plain::line(names[place]).to_string(), kind.name));
    };
    Ok(Some(Column { place, factor: power_of_ten(exponent - case_exponent) }))
}

/// 10ⁿ, exact as far as it is: division where it is not above 1.
fn power_of_ten(n: i32) -> f64 {
    if n < 0 { 1.0 / 10f64.powi(-n) } else { 10f64.powi(n) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn units() -> Units {
        Units::unknown().named(Some("µm"), Some("GPa"))
    }

    #[test]
    fn columns_are_found_by_name_and_converted() {
        let text =
            "# measured\ntime_s, force_µN ,penetration_nm,penetration_error_nm\n0,2000,15,0.5\n\n1,4e3,\"24\",1\n";
        let measurement = read(text, &units()).unwrap();
        assert_eq!(measurement.forces(), [2.0, 4.0]);
        assert!(
            (measurement.penetrations()[1] - 0.024).abs() < 1e-17
                && measurement.deviations().unwrap()[0] == 0.5 / 1000.0
        );
        let measurement = read("force,penetration_nm,penetration_error\n2,15,0.5\n", &units()).unwrap();
        assert_eq!(measurement.deviations().unwrap(), [0.5 / 1000.0], "in the unit of the penetration");
        let measurement = read("penetration,force\n0.1,3\n", &Units::unknown()).unwrap();
        assert_eq!(
            (measurement.forces(), measurement.penetrations(), measurement.deviations()),
            (&[3.0][..], &[0.1][..], None)
        );
    }

    #[test]
    fn faults_name_their_line() {
        let fault = |text: &str| read(text, &units()).unwrap_err().to_string();
        for (text, words) in [
            ("", "no line names the columns"),
            ("1,2\n3,4\n", "no line names the columns"),
            ("# x\nforce,depth\n", "line 2: no column `penetration` among force, depth"),
            ("force,penetration_error\n", "no column `penetration`"),
            ("force_lb,penetration\n1,2\n", "`lb` is no unit of force"),
            ("force,force_mN,penetration\n", "`force_mN` is there twice"),
            ("force,penetration\n1,2\n1\n", "line 3: 1 cells, but 2 columns"),
            ("force,penetration\n1,x\n", "line 2, column penetration: `x` is no number"),
            ("force,penetration\n1,2\n\n0,2\n", "line 4, point 2: the force must be above 0"),
            ("force,penetration\n1,nan\n", "line 2, point 1: the penetration must be finite"),
        ] {
            assert!(fault(text).contains(words), "{text:?}: {}", fault(text));
        }
        let unnamed = read("force_mN,penetration\n1,2\n", &Units::unknown()).unwrap_err().to_string();
        assert!(unnamed.contains("does not name SI units") && unnamed.contains("`force`"), "{unnamed}");
    }

    #[test]
    fn columns_in_memory_are_those_of_a_table() {
        let columns = |names: [&str; 2]| names.map(|name| (name.to_owned(), vec![2000.0, 4e3]));
        let measurement = of_columns(&columns(["penetration_nm", "force_µN"]), &units()).unwrap();
        let table = read("force_µN,penetration_nm\n2000,2000\n4000,4000\n", &units()).unwrap();
        assert_eq!(measurement, table);
        let fault = |names| of_columns(&columns(names), &units()).unwrap_err().to_string();
        assert!(fault(["force", "depth"]).starts_with("no column `penetration` among force, depth"));
        assert!(fault(["force", "force_N"]).starts_with("`force_N` is there twice"));
    }
}
