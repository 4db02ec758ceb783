//! `percoat check`: what a case means, without solving it.

use super::{Common, Failure, Outcome, read_case};
use percoat::case::{Case, GridSection};
use percoat::grid::Grid;
use percoat::hierarchy::{self, Hierarchy};
use percoat::number::number;
use percoat::refinement::balanced_points;
use percoat::texture::Surface;
use percoat::touch::first_touches;
use std::io::Write;
use std::path::Path;

pub fn run(path: &Path, common: &Common) -> Result<Outcome, Failure> {
    let (case, name) = read_case(Some(path), common)?;
    let mut out = std::io::stdout().lock();
    let title = if case.title.is_empty() { &name } else { &case.title };
    writeln!(out, "{title}\n\n{}\n\n{}\n", case.surface(), case.half_space())?;
    match case.grid {
        GridSection::Points(points) => {
            let grid = Grid::new(case.surface().cell(), points).map_err(|error| Failure::Refused(error.to_string()))?;
            let mebibytes = hierarchy::memory(points, case.solver.method) as f64 / f64::from(1 << 20);
            writeln!(out, "{grid}\nmemory: about {mebibytes:.0} MiB")?;
        }
        GridSection::Accuracy(accuracy) => writeln!(out, "grid: refined until results change by less than {accuracy}")?,
    }
    let (name, values) = (case.load.quantity(), case.load.values());
    let [first, last] = [values[0], values[values.len() - 1]].map(number);
    match values.len() {
        1 => writeln!(out, "load: {name} {first}")?,
        count => writeln!(out, "load: {name} {first} … {last}, {count} steps")?,
    }
    write_touches(&mut out, &case)?;
    Ok(Outcome::Done)
}

/// Points along the shorter cell vector on which the first touches are looked for.
const POINTS: usize = 192;

fn write_touches(out: &mut impl Write, case: &Case) -> Result<(), Failure> {
    let Surface::Indenters { .. } = case.surface() else { return Ok(()) };
    let points = balanced_points(&case.surface().cell(), POINTS);
    let mut hierarchy = Hierarchy::new(case.surface(), case.half_space(), points, case.solver)
        .map_err(|error| Failure::Refused(error.to_string()))?;
    writeln!(out, "first touch, on {} × {} samples:", points[0], points[1])?;
    for (level, touch) in (1..).zip(first_touches(&mut hierarchy)) {
        match touch {
            Some(pressure) => writeln!(out, "  level {level}: mean pressure {}", number(pressure))?,
            None => writeln!(out, "  level {level}: never, it is hidden behind the others")?,
        }
    }
    Ok(())
}
