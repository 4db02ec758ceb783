//! Dense solutions of periodic cells: loads, approaches, paths, and the mirrored problem.

use super::bodies::with_hardness;
use crate::cells::{self, CELLS, bare, coated, range, rough, steps, wavy};
use crate::{Check, Data, Outcome, StudyError, Tolerance};
use ndarray::Array2;
use percoat_core::body::{Bodies, HalfSpace};
use percoat_core::load::Load;
use percoat_core::spectral::Step;

const PERIODIC: &str = include_str!("periodic.csv");
const PATH: &str = include_str!("path.csv");
/// Tables of the rough cells by number: pressure at each sample, and permanent depth after step 3 of the load path, a length.
const PRESSURES: [&str; 3] = [
    include_str!("square-pressures.csv"),
    include_str!("rectangle-pressures.csv"),
    include_str!("oblique-pressures.csv"),
];
const RESIDUALS: [&str; 3] =
    [include_str!("square-residual.csv"), include_str!("rectangle-residual.csv"), include_str!("oblique-residual.csv")];
/// Words of the tables by their numbers: cells, surfaces, bodies, what is prescribed.
const WORDS: [&str; 9] =
    [cells::NAMES[0], cells::NAMES[1], cells::NAMES[2], "wavy", "rough", "bare", "coated", "load", "approach"];
const ROUGH: f64 = 4.0;
const COATED: f64 = 6.0;
const APPROACH: f64 = 8.0;
/// The gap of the certificate, 10⁻¹² of the energy, leaves its root in pressures over H, a tenth of it in the approach over the range of
/// the gap, and in what is pressed in that of the pressures.
const PRESSURE: f64 = 1e-6;
const LENGTH: f64 = 1e-7;
const DEPTH: f64 = 1e-6;
/// Least distance of a sample from a change of its state with which counts are the same, pressures over H and gaps over their range.
const MARGIN: f64 = 1e-5;

fn body(number: f64) -> Result<HalfSpace, StudyError> {
    if number == COATED { coated() } else { bare() }
}

/// Parts of the samples with pressure and at the hardness; largest depth pressed in and its mean.
fn counted(step: &Step) -> [f64; 4] {
    let (p, hardness) = (step.pressure(), step.finest().hardness());
    let depths = step.indentation().unwrap_or_else(|| Array2::zeros(p.dim()));
    let part = |count: usize| count as f64 / p.len() as f64;
    [
        part(p.iter().filter(|&&p| p > 0.0).count()),
        part(p.iter().filter(|&&p| p >= hardness).count()),
        depths.iter().copied().fold(0.0, f64::max),
        depths.sum() / depths.len() as f64,
    ]
}

/// Largest difference of two fields.
fn difference(one: &Array2<f64>, other: &Array2<f64>) -> f64 {
    one.iter().zip(other).map(|(one, other)| (one - other).abs()).fold(0.0, f64::max)
}

/// A column of a table of all samples.
fn field(table: &Data, column: &str, points: [usize; 2]) -> Result<Array2<f64>, StudyError> {
    Ok(Array2::from_shape_vec(points, table.column(column))?)
}

/// A contact of a periodic cell.
struct Contact {
    cell: usize,
    gap: Array2<f64>,
    bodies: Bodies,
    hardness: f64,
}

impl Contact {
    /// The contact of a row of `periodic.csv`.
    fn of(row: &[f64]) -> Result<Self, StudyError> {
        let &[cell, surface, material, hardness, ..] = row else { return Err("a row too short".into()) };
        let points = CELLS[cell as usize].0;
        let gap = if surface == ROUGH { rough(points) } else { wavy(points) };
        Ok(Self { cell: cell as usize, gap, bodies: with_hardness(body(material)?, hardness)?, hardness })
    }

    /// The step under a load; `None` if it is not solved.
    fn solve(&self, load: Load) -> Result<Option<Step>, StudyError> {
        let step = steps(self.cell, &self.gap, &self.bodies)?.solver.solve(load);
        Ok(Some(step).filter(|step| step.report.stop.solved()))
    }

    /// The contact of the bodies with the gap max f − f.
    fn mirrored(&self) -> Self {
        let top = self.top();
        Self { gap: self.gap.mapv(|f| top - f), bodies: self.bodies.clone(), ..*self }
    }

    /// max f.
    fn top(&self) -> f64 {
        self.gap.iter().copied().fold(0.0, f64::max)
    }
}

/// The pressures of a row, if they are in the tables.
fn tabulated(row: &[f64], contact: &Contact) -> Result<Option<Array2<f64>>, StudyError> {
    let &[_, surface, material, hardness, control, mean, ..] = row else { return Err("a row too short".into()) };
    if surface != ROUGH || control == APPROACH {
        return Ok(None);
    }
    let pressures = Data::parse("pressures", PRESSURES[contact.cell])?;
    let share = (mean / hardness * 100.0).round() / 100.0;
    let name = format!("{}_{}_{hardness}_{share}", WORDS[contact.cell], WORDS[material as usize]);
    if pressures.columns.contains(&name) {
        Ok(Some(field(&pressures, &name, contact.gap.dim().into())?))
    } else {
        Ok(None)
    }
}

/// Pairs of what is found and what it has to be, of all rows.
#[derive(Default)]
struct Pairs {
    approaches: Vec<(f64, f64)>,
    means: Vec<(f64, f64)>,
    counts: Vec<(f64, f64)>,
    depths: Vec<(f64, f64)>,
    pressures: Vec<(f64, f64)>,
    mirrored: Vec<(f64, f64)>,
    mirrored_approaches: Vec<(f64, f64)>,
    /// Number of loads that are not solved.
    unsolved: f64,
}

impl Pairs {
    /// Solves a row and compares it. Returns the errors of δ over the range of the gap, of the pressure over H, and of that of the mirrored
    /// problem; not a number where there is nothing to compare with.
    fn add(&mut self, row: &[f64]) -> Result<[f64; 3], StudyError> {
        let &[.., hardness, control, mean, delta, fraction, plastic, depth, pressed, margin] = row else {
            return Err("a row too short".into());
        };
        let contact = Contact::of(row)?;
        let size = range(&contact.gap);
        let load = if control == APPROACH { Load::Penetration(delta) } else { Load::MeanPressure(mean) };
        let Some(step) = contact.solve(load)? else {
            self.unsolved += 1.0;
            return Ok([f64::NAN; 3]);
        };
        let p = step.pressure().to_owned();
        // If no sample is between 0 and H, an interval of δ solves the load; of the depths what is left after δ is
        // known.
        let mut free = 0.0;
        if control == APPROACH {
            self.means.push((p.sum() / p.len() as f64 / hardness, mean / hardness));
        } else if fraction > plastic {
            self.approaches.push((step.penetration() / size, delta / size));
        } else {
            free = step.penetration() - delta;
        }
        let found = counted(&step);
        if margin > MARGIN {
            self.counts.extend([(found[0], fraction), (found[1], plastic)]);
        }
        self.depths
            .extend([((found[2] - free) / size, depth / size), ((found[3] - plastic * free) / size, pressed / size)]);
        let error = tabulated(row, &contact)?.map(|known| difference(&p, &known) / hardness);
        self.pressures.extend(error.map(|error| (error, 0.0)));
        let mirror = if control == APPROACH { None } else { self.mirror(&contact, mean, &step)? };
        Ok([(step.penetration() - delta) / size, error.unwrap_or(f64::NAN), mirror.unwrap_or(f64::NAN)])
    }

    /// Compares a step under p̄ with its mirrored problem: H − p under max f − f and H − p̄.
    fn mirror(&mut self, contact: &Contact, mean: f64, step: &Step) -> Result<Option<f64>, StudyError> {
        let hardness = contact.hardness;
        let Some(other) = contact.mirrored().solve(Load::MeanPressure(hardness - mean))? else {
            self.unsolved += 1.0;
            return Ok(None);
        };
        let error = difference(&step.pressure().to_owned(), &other.pressure().mapv(|p| hardness - p)) / hardness;
        self.mirrored.push((error, 0.0));
        let size = range(&contact.gap);
        self.mirrored_approaches.push(((step.penetration() + other.penetration()) / size, contact.top() / size));
        Ok(Some(error))
    }

    fn checks(self) -> [Check; 8] {
        let worst = |name: &str, pairs: Vec<(f64, f64)>, tolerance: f64| {
            Check::worst(format!("periodic, {name}"), pairs, Tolerance::Absolute(tolerance))
        };
        [
            Check::at_most("periodic, loads and mirrored ones that are not solved", self.unsolved, 0.0),
            worst("p̄/H = 0.1 to 0.99: δ over the range of the gap", self.approaches, LENGTH),
            worst("δ given: p̄/H", self.means, PRESSURE),
            worst("parts of the samples in contact and at the hardness", self.counts, 1e-9),
            worst("largest and mean depth pressed in over the range of the gap", self.depths, DEPTH),
            worst("pressure of every sample of the rough cells over H", self.pressures, PRESSURE),
            worst("mirrored: pressure of every sample over H", self.mirrored, 2.0 * PRESSURE).of_refinement(),
            worst("mirrored: δ over the range of the gap", self.mirrored_approaches, 2.0 * LENGTH).of_refinement(),
        ]
    }
}

/// Every row, and the mirrored problem of it.
pub fn periodic(outcome: &mut Outcome) -> Result<Data, StudyError> {
    let columns =
        ["cell", "surface", "body", "hardness", "control", "mean", "delta_error", "pressure_error", "mirror_error"];
    let mut data = Data::new("periodic", &columns);
    let mut pairs = Pairs::default();
    for row in Data::parse_named("periodic", PERIODIC, &WORDS)?.rows {
        let errors = pairs.add(&row)?;
        data.rows.push([&row[..6], &errors].concat());
    }
    outcome.checks.extend(pairs.checks());
    Ok(data)
}

/// Loading, unloading and reloading, each step on the surface that those before have left.
pub fn path(outcome: &mut Outcome) -> Result<Data, StudyError> {
    let cases = ["square_bare", "rectangle_coated", "oblique_coated"];
    let table = Data::parse_named("path", PATH, &cases)?;
    let mut data = Data::new("path", &["case", "step", "mean", "delta", "delta_exact", "pressed", "pressed_exact"]);
    let [mut approaches, mut counts, mut depths, mut residuals, mut reloaded] = [const { Vec::new() }; 5];
    for (cell, name) in cases.into_iter().enumerate() {
        let points = CELLS[cell].0;
        let (gap, hardness) = (rough(points), if cell == 0 { 0.1 } else { 0.3 });
        let size = range(&gap);
        let mut steps = steps(cell, &gap, with_hardness(if cell == 0 { bare()? } else { coated()? }, hardness)?)?;
        let mut loaded = None;
        for row in table.rows.iter().filter(|row| row[0] == cell as f64) {
            let &[_, number, mean, delta, fraction, plastic, depth, pressed, margin] = &row[..] else {
                return Err("a row too short".into());
            };
            let step = steps.step(Load::MeanPressure(mean))?;
            let found = counted(&step);
            approaches.push((step.penetration() / size, delta / size));
            if margin > MARGIN {
                counts.extend([(found[0], fraction), (found[1], plastic)]);
            }
            depths.extend([(found[2] / size, depth / size), (found[3] / size, pressed / size)]);
            if number == 3.0 {
                let residual = Data::parse("residual", RESIDUALS[cell])?;
                let residual = field(&residual, name, points)?;
                let found = step.indentation().ok_or("no hardness")?;
                residuals.push((difference(&found, &residual) / size, 0.0));
                loaded = Some(step.pressure().to_owned());
            }
            if let (true, Some(before)) = (number == 6.0, &loaded) {
                reloaded.push((difference(&step.pressure().to_owned(), before) / hardness, 0.0));
            }
            data.rows.push(vec![cell as f64, number, mean, step.penetration(), delta, found[3], pressed]);
            steps.solver.keep_indentation();
        }
    }
    let worst = |name: &str, pairs: Vec<(f64, f64)>, tolerance: f64| {
        Check::worst(format!("load path, {name}"), pairs, Tolerance::Absolute(tolerance))
    };
    outcome.checks.extend([
        worst("δ over the range of the gap", approaches, LENGTH),
        worst("parts of the samples in contact and at the hardness", counts, 1e-9),
        worst("largest and mean depth pressed in over the range of the gap", depths, DEPTH),
        worst("depth of every sample after loading over the range of the gap", residuals, DEPTH),
        worst("loaded again: pressure of every sample over H", reloaded, 2.0 * PRESSURE).of_refinement(),
    ]);
    Ok(data)
}
