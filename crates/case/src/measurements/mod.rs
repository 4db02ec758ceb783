//! Measured indentation curves from tables: columns, a line for each point, as instruments and spreadsheets export them.
//!
//! A line names the columns: `force` (or load, P, …) and `penetration` (depth, displacement, h, …), alone in the units of the case, or with
//! their own as in `force_mN`, `Load (mN)`, `Depth [nm]` or in a line of units below, which are converted where the case names its units.
//! `penetration_error` is the standard deviation of each penetration, in the unit of the penetration unless it names its own. Other
//! columns are left out. Columns that stand in no table but in memory are read alike. Area functions of tips stand in such tables too ([`tip`](tip())).
//!
//! Points without a force before the largest one are those before contact, and left out. Of a test with hold and unloading the
//! [segment](Segment) of loading or of unloading can be taken. Several curves are taken together ([`Taken`]).

mod fault;
mod points;
mod segment;
mod table;
mod taken;
mod tip;

use crate::units::Units;
use percoat_common::measure::Measure;
use percoat_common::plain;
use points::Points;
use table::{Table, bare};

pub use fault::{CurveFault, Fault};
pub use segment::{NoSegment, Segment};
pub use table::text;
pub use taken::{Curves, Source, Taken};
pub use tip::tip;

/// A column that is read: its place in a line, and the conversion to the unit of the case.
#[derive(Debug, Clone, Copy)]
struct Column {
    place: usize,
    /// Units from and to which its numbers are converted; `None` for numbers in that of the case.
    units: Option<[Measure; 2]>,
}

/// Kind of column: names, of which percoat's own files have the first; quantity, base unit, an example of a unit.
struct Kind {
    names: &'static [&'static str],
    quantity: &'static str,
    base: Measure,
    example: &'static str,
}

/// A line of names of a measured curve.
const EXAMPLE: &str = "`force,penetration`, `force_mN,penetration_nm` or `Load (mN);Depth (nm)`";

const FORCE: Kind = Kind {
    names: &[
        "force",
        "load",
        "normal force",
        "normal load",
        "indentation force",
        "indentation load",
        "load on sample",
        "force on surface",
        "applied load",
        "last",
        "kraft",
        "prüfkraft",
        "normalkraft",
        "charge",
        "fn",
        "p",
    ],
    quantity: "force",
    base: Measure::NEWTON,
    example: "mN",
};
const PENETRATION: Kind = Kind {
    names: &[
        "penetration",
        "depth",
        "disp",
        "penetration depth",
        "indentation depth",
        "displacement",
        "displacement into surface",
        "indenter displacement",
        "tiefe",
        "eindringtiefe",
        "profondeur",
        "pd",
        "h",
    ],
    quantity: "length",
    base: Measure::METRE,
    example: "nm",
};
const DEVIATION: Kind = Kind {
    names: &["penetration error", "depth error", "displacement error"],
    quantity: "length",
    base: Measure::METRE,
    example: "nm",
};

/// The points in a table, in the `units` of the case.
fn points_of_text(text: &str, units: &Units) -> Result<Points, Fault> {
    let table = Table::of(text, |names| FORCE.is_in(names) && PENETRATION.is_in(names)).ok_or(Fault::Empty(EXAMPLE))?;
    let columns = Columns::find(&table.names, &table.units, Some(table.line), units)?;
    let Columns { force, penetration, deviation } = columns;
    let mut points = Points { deviations: deviation.map(|_| Vec::new()), ..Points::default() };
    for (line, row) in &table.rows {
        let number = |column: Column| column.of(&table, *line, row);
        points.forces.push(number(force)?);
        points.penetrations.push(number(penetration)?);
        if let (Some(column), Some(deviations)) = (deviation, &mut points.deviations) {
            deviations.push(number(column)?);
        }
        points.lines.push(*line);
    }
    Ok(points)
}

/// The points in columns in memory with these names, in the `units` of the case.
fn points_of_columns(columns: &[(String, Vec<f64>)], units: &Units) -> Result<Points, Fault> {
    let names: Vec<&str> = columns.iter().map(|(name, _)| name.as_str()).collect();
    let Columns { force, penetration, deviation } = Columns::find(&names, &[], None, units)?;
    let converted = |column: Column| columns[column.place].1.iter().map(|&x| column.converted(x)).collect::<Vec<f64>>();
    Ok(Points {
        forces: converted(force),
        penetrations: converted(penetration),
        deviations: deviation.map(converted),
        lines: Vec::new(),
    })
}

/// The columns of a curve.
struct Columns {
    force: Column,
    penetration: Column,
    deviation: Option<Column>,
}

impl Columns {
    /// The columns among those with these names, and with units in a line of their own, which stand in a line of a table.
    fn find(names: &[&str], units_below: &[&str], line: Option<usize>, units: &Units) -> Result<Self, Fault> {
        let column = |kind: &Kind| kind.column(names, units_below, line, units);
        let force = column(&FORCE)?.ok_or_else(|| FORCE.missing(names, line))?;
        let penetration = column(&PENETRATION)?.ok_or_else(|| PENETRATION.missing(names, line))?;
        // Without a unit of its own it has that of the penetration.
        let deviation =
            column(&DEVIATION)?.map(|column| Column { units: column.units.or(penetration.units), ..column });
        Ok(Self { force, penetration, deviation })
    }
}

impl Column {
    /// The number of the column in a row of a table, converted.
    fn of(self, table: &Table<'_>, line: usize, row: &[&str]) -> Result<f64, Fault> {
        let (found, expected) = (row.len(), table.names.len());
        if found > expected || self.place >= found {
            return Err(Fault::Cells { line, found, expected });
        }
        let fault = || Fault::Number {
            line,
            column: plain::line(table.names[self.place]).to_string(),
            text: format!("`{}`", plain::line(row[self.place])),
        };
        table.number(row[self.place]).map(|x| self.converted(x)).ok_or_else(fault)
    }

    fn converted(self, number: f64) -> f64 {
        self.units.and_then(|[from, to]| from.convert(number, to)).unwrap_or(number)
    }
}

impl Kind {
    /// Whether a column of the kind is among those with these names.
    fn is_in(&self, names: &[&str]) -> bool {
        names.iter().any(|name| self.unit_of(name).is_some())
    }

    /// The refusal of columns with these names, in a line of a table, without one of the kind.
    fn missing(&self, names: &[&str], line: Option<usize>) -> Fault {
        let found = plain::line(&names.join(", ")).to_string();
        Fault::Missing { line, name: self.names[0], found, unit: self.example }
    }

    /// The unit in the name of a column of the kind, `Some(None)` without one; `None` of another column.
    fn unit_of(&self, name: &str) -> Option<Option<String>> {
        let plain = |text: &str| text.replace('_', " ").split_whitespace().collect::<Vec<_>>().join(" ").to_lowercase();
        // H is the hardness.
        let is_known = |text: &str| text.trim() != "H" && self.names.contains(&&plain(text)[..]);
        if is_known(name) {
            return Some(None);
        }
        let name = name.trim();
        let bracketed = [('(', ')'), ('[', ']')].into_iter().find_map(|(open, close)| {
            let (before, unit) = name.strip_suffix(close)?.rsplit_once(open)?;
            Some((before, unit))
        });
        let behind = || name.split_once('/').or_else(|| name.split_once(',')).or_else(|| name.rsplit_once('_'));
        let (before, unit) = bracketed.or_else(behind)?;
        let is_other = plain(unit).starts_with("error");
        (is_known(before) && !is_other).then(|| Some(unit.trim().to_owned()))
    }

    /// The column of the kind; `None` where there is none.
    fn column(
        &self,
        names: &[&str],
        units_below: &[&str],
        line: Option<usize>,
        units: &Units,
    ) -> Result<Option<Column>, Fault> {
        let unit_below =
            |place: usize| units_below.get(place).map(|unit| bare(unit).to_owned()).filter(|unit| !unit.is_empty());
        let named = names.iter().enumerate().filter_map(|(place, name)| Some((place, self.unit_of(name)?)));
        let named: Vec<(usize, Option<String>)> =
            named.map(|(place, unit)| (place, unit.or_else(|| unit_below(place)))).collect();
        // Beside a load in newtons there may be one in volts, and beside a depth `h_max`.
        let measure = |unit: &str| Measure::like(unit, self.base);
        let mut fitting = named.iter().filter(|(_, unit)| unit.as_deref().is_none_or(|unit| measure(unit).is_some()));
        let Some((place, unit)) = fitting.next() else {
            let Some((_, Some(unit))) = named.first() else { return Ok(None) };
            let unit = plain::line(unit).to_string();
            return Err(Fault::Unit { line, unit, quantity: self.quantity, example: self.example });
        };
        if let Some((again, _)) = fitting.next() {
            return Err(Fault::Twice(line, plain::line(names[*again]).to_string()));
        }
        let place = *place;
        let Some(from) = unit.as_deref().and_then(measure) else { return Ok(Some(Column { place, units: None })) };
        let [length, pressure] = units.measures();
        let to = match self.base {
            Measure::METRE => length,
            Measure::SQUARE_METRE => length.map(|length| length.by(length, 1)),
            _ => pressure.zip(length).map(|(pressure, length)| pressure.by(length, 2)),
        };
        let to = to.ok_or_else(|| Fault::Unnamed(line, plain::line(names[place]).to_string(), self.names[0]))?;
        Ok(Some(Column { place, units: Some([from, to]) }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use percoat_core::identification::Measurement;

    /// The curve of loading in a table, with the notes.
    fn curve(source: Source<'_>, segment: Segment, units: &Units) -> Result<(Measurement, Vec<String>), Fault> {
        let taken = Taken::new(&[("", source)], segment, units).map_err(|fault| fault.fault)?;
        match taken.curves {
            Curves::Loading(measurement) => Ok((measurement, taken.notes)),
            Curves::Unloading(_) | Curves::Retraction(_) => unreachable!("loading is taken"),
        }
    }

    fn read(text: &str, units: &Units) -> Result<Measurement, Fault> {
        curve(Source::Text(text), Segment::Whole, units).map(|(measurement, _)| measurement)
    }

    fn of_columns(columns: &[(String, Vec<f64>)], segment: Segment) -> Result<(Measurement, Vec<String>), Fault> {
        curve(Source::Columns(columns), segment, &units())
    }

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
        let german = read("Prüfung 3;Berkovich\nZeit (s);Eindringtiefe (nm);Kraft (mN)\n0;15;2,5\n", &units()).unwrap();
        assert_eq!((german.forces(), german.penetrations()), (&[2.5][..], &[0.015][..]));
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
            ("# x\nforce,deep\n", "line 2: no column `penetration` among force, deep"),
            ("force,penetration_error\n", "no column `penetration`"),
            ("P,H\n1,2\n", "no column `penetration`"),
            ("force_lb,penetration\n1,2\n", "`lb` is no unit of force"),
            ("force_nm,penetration\n1,2\n", "`nm` is no unit of force"),
            ("force,force_mN,penetration\n", "`force_mN` is there twice"),
            ("force,penetration\n1,2\n1\n", "line 3: 1 cells, but 2 columns"),
            ("force,penetration\n1,x\n", "line 2, column penetration: `x` is no number"),
            ("force,penetration\n1,2\n\n0,2\n", "line 4, point 2: the force must be above 0"),
            ("force,penetration\n1,nan\n", "line 2, point 1: the penetration must be finite"),
        ] {
            assert!(fault(text).contains(words), "{text:?}: {}", fault(text));
        }
        let unnamed = read("force_mN,penetration\n1,2\n", &Units::unknown()).unwrap_err().to_string();
        let wrong = Units::unknown().named(Some("µm"), Some("mm"));
        assert!(read("force_mN,penetration\n1,2\n", &wrong).is_err(), "pressures in millimetres");
        assert!(unnamed.contains("does not name SI units") && unnamed.contains("`force`"), "{unnamed}");
    }

    #[test]
    fn columns_in_memory_are_those_of_a_table() {
        let columns = |names: [&str; 2]| names.map(|name| (name.to_owned(), vec![2000.0, 4e3]));
        let (measurement, _) = of_columns(&columns(["penetration_nm", "force_µN"]), Segment::Whole).unwrap();
        let table = read("force_µN,penetration_nm\n2000,2000\n4000,4000\n", &units()).unwrap();
        assert_eq!(measurement, table);
        let fault = |names| of_columns(&columns(names), Segment::Whole).unwrap_err().to_string();
        assert!(fault(["force", "deep"]).starts_with("no column `penetration` among force, deep"));
        assert!(fault(["force", "force_N"]).starts_with("`force_N` is there twice"));
    }

    /// Separators, decimal commas, names, units, encodings and line ends of exports: each has the same three points.
    #[test]
    fn tables_of_instruments_are_read_as_they_are_exported() {
        let expected = read("force_mN,penetration_nm\n0.5,10\n1.5,20.5\n3,30\n", &units()).unwrap();
        let semicolons =
            "Sample;DLC 7\nDate;2026-11-28\n\nTime [s];Load (mN);Depth (nm);\n0;0,5;10;\n1;1,5;20,5;\n2;3;30;\n";
        let tabs = "Displacement Into Surface\tLoad On Sample\tTime On Sample\r\nnm\tmN\ts\r\n10\t0.5\t0\r\n20.5\t1.5\t1\r\n30\t3\t2\r\n";
        let spaces = "Test 4 of 9\rh [µm]  P [µN]\r0.01   500\r0.0205 1.5e3\r0.03   3000\r";
        let plain = "force_N penetration_m\n5e-4 1e-8\n1.5e-3 2.05e-8\n3e-3 3e-8\n";
        let slashes = "Force / mN\tPenetration / nm\n0,5\t10\n1,5\t20,5\n3\t30\n";
        let quoted = "\"Normal Force\",\"Indentation Depth\"\n\"[mN]\",\"[nm]\"\n\"0.5\",\"10\"\n\"1.5\",\"20.5\"\n\"3\",\"30\"\n";
        let volts = "Depth (nm)\tLoad (mN)\tTime (s)\tDepth (V)\tLoad (V)\th_max\tH (GPa)\n10\t0.5\t0\t1\t1\t3\t9\n20.5\t1.5\t1\t1\t1\t3\t9\n30\t3\t2\t1\t1\t3\t9\n";
        let sheet = "\"Load, mN\",\"Depth, nm\"\n\"0.5\",\"10\"\n1.5,20.5\n3,30\n,,\n";
        for exported in [semicolons, tabs, spaces, plain, slashes, quoted, volts, sheet] {
            let latin: Vec<u8> = exported.chars().map(|c| c as u8).collect();
            let wide = |of: fn(u16) -> [u8; 2]| -> Vec<u8> {
                std::iter::once(0xfeff).chain(exported.encode_utf16()).flat_map(of).collect()
            };
            let marked = [b"\xef\xbb\xbf", exported.as_bytes()].concat();
            for bytes in [exported.as_bytes().to_vec(), latin, wide(u16::to_le_bytes), wide(u16::to_be_bytes), marked] {
                assert_eq!(read(&text(&bytes), &units()).unwrap(), expected, "{exported}");
            }
        }
    }

    /// Noise before contact, loading, a hold with creep, and unloading.
    #[test]
    fn of_a_whole_test_the_loading_is_taken() {
        let forces = [0.0, 0.01, -0.02, 1.0, 2.0, 4.0, 7.98, 8.0, 8.01, 7.99, 8.0, 4.0, 1.0, 0.0];
        let table: String = forces.iter().enumerate().map(|(k, force)| format!("{force},{k}\n")).collect();
        let table = format!("force_mN,penetration_nm\n{table}");
        let refused = read(&table, &units()).unwrap_err().to_string();
        assert!(
            refused.contains("point 14: the force must be above 0") && refused.ends_with("(--segment loading)"),
            "{refused}"
        );
        let (measurement, notes) = curve(Source::Text(&table), Segment::Loading, &units()).unwrap();
        assert_eq!(measurement.forces(), [1.0, 2.0, 4.0, 7.98]);
        assert!(
            notes[0].starts_with("7 of 14 points") && notes[1].starts_with("3 of 14 points before contact"),
            "{notes:?}"
        );
        let columns = [("force".to_owned(), forces.to_vec()), ("h".to_owned(), (0..14).map(f64::from).collect())];
        let found = of_columns(&columns, Segment::Loading).unwrap();
        assert_eq!((found.0.forces(), &found.1), (measurement.forces(), &notes));
        // Points of an earlier cycle are no noise, and columns have one length.
        let cycles = "force,penetration\n1,10\n2,20\n0,15\n3,30\n";
        assert!(read(cycles, &units()).unwrap_err().to_string().contains("line 4, point 3: the force must be above 0"));
        let uneven = [("force".to_owned(), forces.to_vec()), ("h".to_owned(), vec![1.0; 12])];
        assert!(of_columns(&uneven, Segment::Loading).unwrap_err().to_string().contains("14 forces, but 12"));
        // A zero point alone is one before contact.
        let zero = Source::Text("force,penetration\n0,0\n1,0.1\n2,0.2\n");
        let (zero, notes) = curve(zero, Segment::Whole, &units()).unwrap();
        assert_eq!((zero.forces(), notes.len()), (&[1.0, 2.0][..], 1));
    }
}
