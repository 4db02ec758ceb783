//! `percoat check`: what a case means, without solving it.

use super::allowed::Allowed;
use super::ending::{Ending, Failure};
use super::input::read_case;
use super::roughness;
use super::terminal::{self, tell};
use crate::case::resources::{Job, Needs, bytes, needs};
use crate::case::{Case, Room, foreseen, plausibility, sublayer_error};
use crate::output::number;
use crate::reading::first_touches;
use crate::run::{Sampling, balanced_points};
use crate::units::{Unit, Units};
use crate::{Grid, Solver};
use std::io::Write;
use std::path::Path;
use std::sync::Arc;

pub fn run(path: &Path, output: Option<&Path>, set: &[String]) -> Result<Ending, Failure> {
    let (case, name) = read_case(Some(path), set)?;
    let job = Job::Solve { pictures: true, fields: true };
    let Allowed { room, .. } = Allowed::new(&case, &Path::new("out").join(&name), job)?;
    case.run().check()?;
    let mut out = terminal::out();
    let title = if case.title.is_empty() { &name } else { &case.title };
    writeln!(out, "{title}\n\n{}\n\n{}\n", case.counterbody(), case.half_space())?;
    if let Some(names) = units(&case.units()) {
        writeln!(out, "{names}")?;
    }
    write_sublayers(&mut out, &case)?;
    match case.grid {
        Sampling::Points(points) => {
            writeln!(out, "{}", Grid::new(case.counterbody().cell(), points).map_err(Failure::refused)?)?;
        }
        Sampling::Accuracy(accuracy) => writeln!(out, "grid: refined until results change by less than {accuracy}")?,
    }
    let grids = case.grid.grids(&case.counterbody().cell()).map_err(Failure::refused)?;
    write_needs(&mut out, &case, grids[grids.len() - 1], room)?;
    let (name, values) = (case.load.quantity(), case.load.values());
    let [first, last] = [values[0], values[values.len() - 1]].map(number);
    match values.len() {
        1 => writeln!(out, "load: {name} {first}")?,
        count => writeln!(out, "load: {name} {first} … {last}, {count} steps")?,
    }
    let touches = write_touches(&mut out, &case, grids[0])?;
    roughness::check(&mut out, &case, output)?;
    for doubt in [plausibility::of_case(&case), foreseen(&case, &touches)].concat() {
        tell!("warning: {doubt}");
    }
    Ok(Ending::Done)
}

/// What all numbers here are measured in, where units have names.
fn units(units: &Units) -> Option<String> {
    let named = |of: &str, unit: &Unit| unit.name().map(|name| format!("{of} in {name}"));
    let names =
        [named("lengths", units.length()), named("pressures", units.pressure()), named("forces", &units.force())];
    let names: Vec<String> = names.into_iter().flatten().collect();
    (!names.is_empty()).then(|| format!("units: {}", names.join(", ")))
}

/// Which materials the layers of the case are, and how well the graded ones are laid out; nothing where none is graded.
fn write_sublayers(out: &mut impl Write, case: &Case) -> Result<(), Failure> {
    let Some(error) = sublayer_error(case) else { return Ok(()) };
    let mut material = 1;
    for (number, layer) in (1..).zip(&case.layers) {
        let count = layer.sublayers();
        let last = material + count - 1;
        match count {
            1 => writeln!(out, "layer {number}: material {material}")?,
            _ => writeln!(
                out,
                "layer {number}: materials {material} to {last}, {count} sublayers from its upper face down"
            )?,
        }
        material += count;
    }
    writeln!(out, "surface compliance: error by the sublayers about {error:.1e}\n")?;
    Ok(())
}

/// Memory and disk that solving the case takes on its finest grid, with pictures and without.
fn write_needs(out: &mut impl Write, case: &Case, points: [usize; 2], room: Room) -> Result<(), Failure> {
    let Needs { memory, disk, disk_while_running } = needs(case, points, Job::Solve { pictures: true, fields: true });
    let free = if room.disk == u64::MAX { String::new() } else { format!(", {} free", bytes(room.disk)) };
    let most = if matches!(case.grid, Sampling::Accuracy(_)) { "at most " } else { "" };
    writeln!(
        out,
        "memory: about {most}{} ({} without pictures), {} available",
        bytes(memory),
        bytes(needs(case, points, Job::Solve { pictures: false, fields: true }).memory),
        bytes(room.memory)
    )?;
    writeln!(out, "disk: about {most}{}, {} while it runs{free}", bytes(disk), bytes(disk_while_running))?;
    Ok(())
}

/// Points along the shorter cell vector on which the first touches are looked for.
const POINTS: usize = 192;

/// The mean pressures at which the levels first touch, also as lines; none for a topography. `first` is the coarsest grid
/// of the case, for which there is room.
fn write_touches(out: &mut impl Write, case: &Case, first: [usize; 2]) -> Result<Vec<Option<f64>>, Failure> {
    if case.counterbody().indenters().is_none() {
        return Ok(Vec::new());
    }
    let [n1, n2] = balanced_points(&case.counterbody().cell(), POINTS);
    // Along a long cell they would be many.
    let points = if n1 * n2 <= 4 * POINTS * POINTS { [n1, n2] } else { first };
    let mut solver = Solver::new(Arc::clone(case.problem()), points, case.solver).map_err(Failure::refused)?;
    writeln!(out, "first touch, on {} × {} samples:", points[0], points[1])?;
    let touches = first_touches(&mut solver);
    for (level, touch) in (1..).zip(&touches) {
        match touch {
            Some(pressure) => writeln!(out, "  level {level}: mean pressure {}", number(*pressure))?,
            None => writeln!(out, "  level {level}: never, it is hidden behind the others")?,
        }
    }
    Ok(touches)
}
