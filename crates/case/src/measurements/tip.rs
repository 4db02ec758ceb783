//! Area functions of tips: the area of the cross-section over the depth from the apex, a line for each depth.

use super::table::Table;
use super::{Fault, Kind};
use crate::units::Units;
use percoat_common::measure::Measure;
use percoat_core::counterbody::{MeasuredTip, TipError};

/// A line of names of an area function.
const EXAMPLE: &str = "`depth,area`, `depth_nm,area_nm2` or `Contact depth (nm);Area (nm²)`";

const DEPTH: Kind = Kind {
    names: &["depth", "contact depth", "h", "hc", "h c", "distance", "distance from apex", "height"],
    quantity: "length",
    base: Measure::METRE,
    example: "nm",
};
const AREA: Kind = Kind {
    names: &[
        "area",
        "projected area",
        "contact area",
        "projected contact area",
        "cross section",
        "a",
        "ac",
        "a c",
        "ap",
        "a p",
    ],
    quantity: "area",
    base: Measure::SQUARE_METRE,
    example: "nm2",
};

/// The tip of the area function in a table, in the `units` of the case.
///
/// # Errors
/// [`Fault`] with the line.
pub fn tip(text: &str, units: &Units) -> Result<MeasuredTip, Fault> {
    let table = Table::of(text, |names| DEPTH.is_in(names) && AREA.is_in(names)).ok_or(Fault::Empty(EXAMPLE))?;
    let line = Some(table.line);
    let column = |kind: &Kind| {
        kind.column(&table.names, &table.units, line, units)?.ok_or_else(|| kind.missing(&table.names, line))
    };
    let columns = [column(&DEPTH)?, column(&AREA)?];
    if columns[0].units.is_some() != columns[1].units.is_some() {
        return Err(Fault::OneUnit(line));
    }
    let point = |(line, row): &(usize, Vec<&str>)| -> Result<[f64; 2], Fault> {
        Ok([columns[0].of(&table, *line, row)?, columns[1].of(&table, *line, row)?])
    };
    let points: Vec<[f64; 2]> = table.rows.iter().map(point).collect::<Result<_, _>>()?;
    MeasuredTip::from_areas(&points).map_err(|error| {
        let index = if let TipError::NotRising { index, .. } = error { Some(index) } else { None };
        Fault::Tip(error, index.map(|index| table.rows[index].0))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn units() -> Units {
        Units::unknown().named(Some("µm"), None)
    }

    /// A cone of A = 24.5 h² in nanometres, for a case in micrometres.
    #[test]
    fn depths_and_areas_are_converted() {
        let slope = (std::f64::consts::PI / 24.5f64).sqrt();
        for table in [
            "depth_nm,area_nm2\n100,245000\n200,980000\n400,3920000\n",
            "Tip 7\nContact depth [nm];Projected area [µm²]\n0;0\n100;0,245\n200;0,98\n400;3,92\n",
            "hc\tAc\nnm\tnm^2\n100\t245000\n200\t980000\n400\t3920000\n",
            "h A\n0.1 0.245\n0.2 0.98\n0.4 3.92\n",
        ] {
            let tip = tip(table, &units()).unwrap();
            let most = 0.4 / slope;
            assert!((tip.range()[1] / most - 1.0).abs() < 1e-12, "{table}: {:?}", tip.range());
            assert!((tip.profile(0.2 / slope) - 0.2).abs() < 1e-12, "{table}");
        }
    }

    #[test]
    fn faults_name_their_line() {
        let fault = |text: &str| tip(text, &units()).unwrap_err().to_string();
        for (text, words) in [
            ("1,2\n3,4\n", "no line names the columns: one must, as `depth,area`"),
            ("depth,surface\n1,2\n", "line 1: no column `area` among depth, surface"),
            ("depth_nm,area_nm\n1,2\n", "`nm` is no unit of area"),
            ("depth_nm,area\n1,2\n2,3\n", "line 1: a column has a unit and the other one none"),
            ("depth,area_nm2\n1,2\n2,3\n", "line 1: a column has a unit"),
            ("depth,area\n1,2\n", "two depths above 0 at least, not 1"),
            ("depth,area\n1,2\n\n2,2\n", "line 4: depths and areas of a tip must be above 0 and rise"),
            ("depth,area\n1,x\n", "line 2, column area: `x` is no number"),
            ("depth,area\n1\n", "line 2: 1 cells, but 2 columns"),
        ] {
            assert!(fault(text).contains(words), "{text:?}: {}", fault(text));
        }
        let unnamed = tip("depth_nm,area_nm2\n1,2\n2,3\n", &Units::unknown()).unwrap_err().to_string();
        assert!(unnamed.contains("does not name SI units"), "{unnamed}");
    }
}
