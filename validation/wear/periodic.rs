//! Three levels of which the counterbody wears, and rough cells of which the body wears too.

use super::path::{Place, VOLUME, extrapolated, largest, volume};
use crate::alone::half_space;
use crate::cells::{self, CELLS, coated, range, rough, steps};
use crate::steps::Steps;
use crate::{Check, Data, Outcome, StudyError, Tolerance};
use ndarray::Array2;
use percoat_core::body::Interface::Bonded;
use percoat_core::counterbody::{Indenters, Level, Shape};
use percoat_core::lattice::{Cell, Lattice};
use percoat_core::load::Load;
use percoat_core::problem::Problem;
use percoat_core::run::{PathEnd, WearPath};
use percoat_core::spectral::Wear;
use std::ops::ControlFlow;

const LEVELS: &str = include_str!("levels.csv");
const LEVEL_SHAPES: &str = include_str!("levels-shapes.csv");
const BODIES: &str = include_str!("bodies.csv");
/// Shapes of the rough cells after s = 0.2, by the number of the cell.
const SHAPES: [&str; 3] = ["", include_str!("rectangle-shapes.csv"), include_str!("oblique-shapes.csv")];
const SHAPED: f64 = 0.2;
const SAMPLES: usize = 24;
const LEVEL_LOAD: f64 = 0.002;
const ROUGH_LOAD: f64 = 0.02;
/// Ends of the parts of the paths, and the equal steps of each, which are doubled and extrapolated.
const LEVEL_PARTS: [(f64, usize); 7] =
    [(0.1, 40), (0.5, 40), (1.0, 40), (2.0, 60), (5.0, 200), (10.0, 300), (20.0, 600)];
const ROUGH_PARTS: [(f64, usize); 3] = [(0.05, 20), (0.2, 40), (0.5, 75)];
/// Error of these steps, three times that which Euler's steps of the tables' own program leave: of δ and of depths over the range of the
/// gap, three levels and rough cells, there of the counterbody and of the body.
const LEVEL_ERRORS: [f64; 2] = [1e-6, 1e-5];
const ROUGH_ERRORS: [f64; 3] = [6e-6, 1e-4, 1e-5];
/// Loads of the levels: 4·10⁻³ of the mean pressure on ten samples that have just come into contact, of 576.
const SHARES: f64 = 1e-4;
/// Tolerance of the steps of a path, and what the error of the depth may be over the stated one, which is of leading order in the length
/// of the steps.
const CONTROLLED: f64 = 0.05;
const STATED: f64 = 1.2;

/// The levels of the paper's Fig. 2.
fn levelled() -> Result<Steps, StudyError> {
    let site = |s: f64| vec![[s; 2]];
    let lattice = Lattice::new(Cell::hexagonal(3f64.sqrt())?, vec![site(0.0), site(1.0 / 3.0), site(2.0 / 3.0)])?;
    let level = |height: f64| Level::new(Shape::Paraboloid { radius: 0.8 }, height);
    let indenters = Indenters::new(lattice, vec![level(0.02)?, level(0.01)?, level(0.0)?])?;
    let body = half_space(&[(0.5, 2.0 * 1.2 / 1.3, 0.2, Bonded)], [1.0, 0.3])?;
    Steps::to(Problem::new(indenters, body), [SAMPLES; 2], 1e-13)
}

/// Parts of the load on the levels.
fn shares(place: &Place) -> Result<[f64; 3], StudyError> {
    let surface = place.step.as_ref().ok_or("no step")?.surface();
    let mut loads = [0.0; 3];
    place.pressure.iter().enumerate().for_each(|(sample, p)| loads[surface.level_at(sample) - 1] += p);
    let whole: f64 = loads.iter().sum();
    Ok(loads.map(|load| load / whole))
}

/// Largest difference of a field and tabulated samples.
fn off(field: &Array2<f64>, table: &Data, column: &str) -> Result<f64, StudyError> {
    let known = table.column(column);
    if known.is_empty() {
        return Err(format!("no column {column}").into());
    }
    let places = table.rows.iter().map(|row| [row[0] as usize, row[1] as usize]);
    Ok(places.zip(known).map(|(place, known)| (field[place] - known).abs()).fold(0.0, f64::max))
}

/// Three levels, from the table's start to where all carry nearly alike.
pub fn levels(outcome: &mut Outcome) -> Result<Data, StudyError> {
    let (table, shapes) = (Data::parse("levels", LEVELS)?, Data::parse("shapes", LEVEL_SHAPES)?);
    let (load, wear) = (Load::MeanPressure(LEVEL_LOAD), Wear::new(0.0, 1.0, [1.0, 0.0])?);
    let first = levelled()?;
    let (size, area) = (first.solver.surface().range(), first.solver.grid().cell().area());
    let (places, worst) = extrapolated(levelled, load, &wear, &LEVEL_PARTS, LEVEL_LOAD * area)?;
    let columns =
        ["ks", "delta", "delta_exact", "share1", "share2", "share3", "share1_exact", "share2_exact", "share3_exact"];
    let mut data = Data::new("levels", &columns);
    let [mut approaches, mut loads, mut depths] = [const { Vec::new() }; 3];
    for (place, row) in places.iter().zip(table.rows.iter().filter(|row| row[0] > 0.0)) {
        let &[path, delta, _, _, s1, s2, s3, ..] = &row[..] else { return Err("a row too short".into()) };
        let found = shares(place)?;
        approaches.push((place.approach / size, delta / size));
        loads.extend(found.into_iter().zip([s1, s2, s3]));
        depths.push((largest(&place.worn[1]) / size, row[11] / size));
        let column = format!("h_{path}");
        if shapes.columns.contains(&column) {
            depths.push((off(&place.worn[1], &shapes, &column)? / size, 0.0));
        }
        data.rows.push([&[path, place.approach, delta], &found[..], &[s1, s2, s3]].concat());
    }
    outcome.checks.extend([
        Check::worst("three levels: δ over the range of the gap", approaches, Tolerance::Absolute(LEVEL_ERRORS[0])),
        Check::worst("three levels: parts of the load", loads, Tolerance::Absolute(SHARES)),
        Check::worst(
            "three levels: worn depths over the range of the gap",
            depths,
            Tolerance::Absolute(LEVEL_ERRORS[1]),
        ),
        Check::absolute("three levels: volume over k s P, less 1", worst, 0.0, VOLUME),
    ]);
    controlled(&shapes, outcome)?;
    Ok(data)
}

/// Wear by steps of controlled length, which are of second order: the largest error of the depth over the stated one,
/// the accumulated errors of all parts of the path times the largest depth.
fn controlled(shapes: &Data, outcome: &mut Outcome) -> Result<(), StudyError> {
    let (load, wear) = (Load::MeanPressure(LEVEL_LOAD), Wear::new(0.0, 1.0, [1.0, 0.0])?);
    let mut steps = levelled()?;
    let force = LEVEL_LOAD * steps.solver.grid().cell().area();
    let (mut slid, mut stated, mut ratios, mut volumes) = (0.0, 0.0, Vec::new(), 0.0f64);
    for end in [0.5, 2.0, 10.0] {
        let path = WearPath::new(load, wear, end - slid, CONTROLLED)?;
        let path = path.slide(&mut steps.solver, &mut |_, _| ControlFlow::Continue(()))?;
        let last = path.steps.last().filter(|_| path.end == PathEnd::Complete).ok_or("the path was not followed")?;
        let worn = steps.solver.worn().ok_or("nothing has worn")?;
        stated += last.accumulated_error * worn.largest(percoat_core::body::Side::Counterbody);
        let depth = worn.depth(percoat_core::body::Side::Counterbody).to_owned();
        ratios.push((off(&depth, shapes, &format!("h_{end}"))? / stated, 0.0));
        volumes = volumes.max(volume(worn, &wear, force));
        slid = end;
    }
    outcome.checks.extend([
        Check::worst(
            "three levels, steps of controlled length: error of the depth over the stated one",
            ratios,
            Tolerance::Absolute(STATED),
        ),
        Check::absolute("three levels, steps of controlled length: volume over k s P, less 1", volumes, 0.0, VOLUME),
    ]);
    Ok(())
}

/// Rough cells of which the body wears alone, and the counterbody too.
pub fn bodies(outcome: &mut Outcome) -> Result<Data, StudyError> {
    let table = Data::parse_named("bodies", BODIES, &cells::NAMES)?;
    let mut data = Data::new(
        "bodies",
        &["cell", "k1", "k2", "s", "delta", "delta_exact", "worn1", "worn1_exact", "worn2", "worn2_exact"],
    );
    let [mut approaches, mut first, mut second, mut volumes] = [const { Vec::new() }; 4];
    for cell in [1, 2] {
        let gap = rough(CELLS[cell].0);
        let size = range(&gap);
        let shapes = Data::parse("shapes", SHAPES[cell])?;
        for [k1, k2] in [[0.0, 1.0], [1.0, 0.5]] {
            let wear = Wear::new(k2, k1, [1.0, 0.0])?;
            let [[x1, _], [_, y2]] = CELLS[cell].1;
            let (load, force) = (Load::MeanPressure(ROUGH_LOAD), ROUGH_LOAD * x1 * y2);
            let (places, worst) = extrapolated(|| steps(cell, &gap, coated()?), load, &wear, &ROUGH_PARTS, force)?;
            volumes.push((worst, 0.0));
            let rows = table.rows.iter().filter(|row| row[0] == cell as f64 && row[1] == k1);
            for (place, row) in places.iter().zip(rows) {
                let [body, counterbody] = [0, 1].map(|k| largest(&place.worn[k]));
                approaches.push((place.approach / size, row[4] / size));
                first.push((counterbody / size, row[8] / size));
                second.push((body / size, row[9] / size));
                if row[3] == SHAPED {
                    let column = |name: &str| format!("{name}_{k1}_{k2}");
                    first.push((off(&place.worn[1], &shapes, &column("h1"))? / size, 0.0));
                    second.push((off(&place.worn[0], &shapes, &column("h2"))? / size, 0.0));
                }
                data.rows.push(vec![row[0], k1, k2, row[3], place.approach, row[4], counterbody, row[8], body, row[9]]);
            }
        }
    }
    let worst = |name: &str, pairs: Vec<(f64, f64)>, tolerance: f64| {
        Check::worst(format!("rough cells: {name}"), pairs, Tolerance::Absolute(tolerance))
    };
    outcome.checks.extend([
        worst("δ over the range of the gap", approaches, ROUGH_ERRORS[0]),
        worst("depths worn off the counterbody over the range of the gap", first, ROUGH_ERRORS[1]),
        worst("depths worn off the swept body over the range of the gap", second, ROUGH_ERRORS[2]),
        worst("volumes over k s P, less 1", volumes, VOLUME),
    ]);
    Ok(data)
}
