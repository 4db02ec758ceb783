//! Paraboloids on a hexagonal lattice: Hertz' contact among its images, bare and coated, at one and at three levels.
//!
//! Expected: the series of [`crate::exact::periodic_hertz`] where a/l is small, and an independent solver at all loads.

use super::draw::{self, curve, logarithmic};
use super::steps::{Steps, case};
use super::{Check, Data, Outcome, Study, StudyError, Tolerance};
use crate::exact::galin::paraboloid;
use crate::exact::lattice_sums::{TRIANGULAR, coated_triangular};
use crate::exact::{Coating, Contact, Hertz, Sums, System};
use percoat_app::picture::{Axis, Chart, Figure, Style};
use percoat_core::reading::Reading;

pub const STUDY: Study = Study {
    name: "periodic-hertz",
    title: "Paraboloids among their images, one and three levels, bare and coated",
    files: &["coated.data.csv", "figure.png", "one-level.data.csv"],
    run,
    quick: None,
};

const CASE: &str = include_str!("case.toml");
const ONE_LEVEL: &str = include_str!("one-level.csv");
const THREE_LEVELS: &str = include_str!("three-levels.csv");
const COATED: &str = include_str!("coated.csv");

const RADIUS: f64 = 0.8;
/// Area per indenter, √3/2.
const AREA: f64 = 0.866_025_403_784_438_6;
/// Up to this mean pressure over E* the series errs by less than the tolerance.
const LIGHT: f64 = 0.03;
/// Samples along the cell for one level, and for three.
const POINTS: [usize; 2] = [360, 480];

fn run() -> Result<Outcome, StudyError> {
    let mut outcome = Outcome::default();
    one_level(&mut outcome)?;
    three_levels(&mut outcome)?;
    coated(&mut outcome)?;
    three_coated_levels(&mut outcome)?;
    let figure = figure(&outcome.data)?;
    outcome.figures.push(("figure", figure));
    Ok(outcome)
}

/// One level of the case, with further overrides.
fn single(overrides: &[String]) -> Result<Steps, StudyError> {
    let level = format!("levels=[{{ shape = \"paraboloid\", radius = {RADIUS} }}]");
    Steps::of(&case("periodic-hertz", CASE, &[&[level], overrides].concat())?, POINTS[0])
}

fn steps_of(step: f64, overrides: &[String]) -> Result<Steps, StudyError> {
    let heights = [format!("levels.0.height={}", 2.0 * step), format!("levels.1.height={step}")];
    Steps::of(&case("periodic-hertz", CASE, &[&heights, overrides].concat())?, POINTS[1])
}

fn layer(chi: f64, nu1: f64) -> [String; 2] {
    let layer = format!("layers=[{{ thickness = 0.5, shear_ratio = {chi}, poisson = {nu1} }}]");
    [layer, "substrate.poisson=0.3".to_owned()]
}

fn series(modulus: f64, sums: Sums, mean_pressure: f64) -> Result<Contact, StudyError> {
    let system = System::single(modulus, sums, vec![paraboloid(RADIUS)]);
    Ok(system.loaded(mean_pressure * AREA, 0.2).ok_or("the series did not converge")?[0])
}

fn radius(found: &Reading, level: usize) -> f64 {
    found.levels[level].contact_radius.unwrap_or(f64::NAN)
}

fn one_level(outcome: &mut Outcome) -> Result<(), StudyError> {
    let reference = Data::parse("one-level", ONE_LEVEL)?;
    let mut data = Data::new(
        "one-level",
        &["mean_pressure", "peak", "peak_series", "penetration", "penetration_series", "radius", "radius_series"],
    );
    let mut steps = single(&[])?;
    for mean_pressure in reference.column("mean_pressure") {
        let (found, series) = (steps.loaded(mean_pressure)?, series(1.0, TRIANGULAR, mean_pressure)?);
        data.rows.push(vec![
            mean_pressure,
            found.max_pressure,
            series.axis,
            found.penetration,
            series.penetration,
            radius(&found, 0),
            series.radius,
        ]);
    }
    let light = data.column("mean_pressure").iter().filter(|&&pressure| pressure <= LIGHT).count();
    for (quantity, tolerance) in [("peak", 2e-4), ("penetration", 2e-4), ("radius", 1e-3)] {
        let pairs = data.column(quantity).into_iter().zip(data.column(&format!("{quantity}_series"))).take(light);
        let tolerance = Tolerance::Relative(tolerance);
        outcome.checks.push(Check::worst(format!("one level: {quantity}, series, loads to 0.03 E*"), pairs, tolerance));
    }
    for quantity in ["peak", "penetration"] {
        let pairs = data.column(quantity).into_iter().zip(reference.column(quantity));
        let tolerance = Tolerance::Relative(2e-4);
        outcome.checks.push(Check::worst(format!("one level: {quantity}, independent solver"), pairs, tolerance));
    }
    outcome.data.push(data);
    Ok(())
}

fn three_levels(outcome: &mut Outcome) -> Result<(), StudyError> {
    let same = TRIANGULAR.scaled(3f64.sqrt());
    let other = TRIANGULAR.other_sublattice(same);
    let (mut against_series, mut against_solver) = (Pairs::default(), Pairs::default());
    for row in Data::parse("three-levels", THREE_LEVELS)?.rows {
        let &[mean_pressure, step, ref rest @ ..] = &row[..] else { return Err("a row too short".into()) };
        let found = steps_of(step, &[])?.loaded(mean_pressure)?;
        let system = System::three_levels(1.0, same, other, RADIUS, step);
        against_series.add(&found, &system, mean_pressure)?;
        against_solver.penetrations.push((found.penetration, rest[6]));
        for (m, level) in found.levels.iter().enumerate() {
            against_solver.peaks.push((level.max_pressure, rest[m]));
            against_solver.shares.push((level.load_share, rest[3 + m]));
        }
    }
    against_series.check("three levels", "series", [2e-4, 2e-4, 1e-3], outcome);
    against_solver.check("three levels", "independent solver", [2e-4, 2e-4, 1e-3], outcome);
    Ok(())
}

fn coated(outcome: &mut Outcome) -> Result<(), StudyError> {
    let mut data = Data::new(
        "coated",
        &["chi", "nu1", "mean_pressure", "peak", "peak_series", "penetration", "penetration_series"],
    );
    let (mut against_series, mut against_solver) = (Pairs::default(), Pairs::default());
    for row in Data::parse("coated", COATED)?.rows {
        let &[chi, nu1, mean_pressure, peak, penetration] = &row[..] else { return Err("a row too short".into()) };
        let found = single(&layer(chi, nu1))?.loaded(mean_pressure)?;
        let coating = Coating::new(chi, [nu1, 0.3], 0.5)?;
        let series = series(coating.modulus(), coated_triangular(&coating, 1.0), mean_pressure)?;
        against_solver.peaks.push((found.max_pressure, peak));
        against_solver.penetrations.push((found.penetration, penetration));
        if mean_pressure <= LIGHT {
            against_series.peaks.push((found.max_pressure, series.axis));
            against_series.penetrations.push((found.penetration, series.penetration));
        }
        data.rows.push(vec![
            chi,
            nu1,
            mean_pressure,
            found.max_pressure,
            series.axis,
            found.penetration,
            series.penetration,
        ]);
    }
    against_series.check("coated", "series, loads to 0.03 E₂", [3e-4, 3e-4, 1e-3], outcome);
    against_solver.check("coated", "independent solver", [2e-4, 2e-4, 1e-3], outcome);
    outcome.data.push(data);
    Ok(())
}

fn three_coated_levels(outcome: &mut Outcome) -> Result<(), StudyError> {
    let (mean_pressure, step) = (0.01, 0.003);
    let coating = Coating::new(2.0, [0.2, 0.3], 0.5)?;
    let same = coated_triangular(&coating, 3f64.sqrt());
    let other = coated_triangular(&coating, 1.0).other_sublattice(same);
    let found = steps_of(step, &layer(2.0, 0.2))?.loaded(mean_pressure)?;
    let mut pairs = Pairs::default();
    pairs.add(&found, &System::three_levels(coating.modulus(), same, other, RADIUS, step), mean_pressure)?;
    pairs.check("three coated levels", "series", [3e-4, 2e-4, 1e-3], outcome);
    Ok(())
}

/// Found and expected values, quantity by quantity.
#[derive(Default)]
struct Pairs {
    peaks: Vec<(f64, f64)>,
    shares: Vec<(f64, f64)>,
    penetrations: Vec<(f64, f64)>,
    radii: Vec<(f64, f64)>,
}

impl Pairs {
    /// A step at three levels against the series.
    fn add(&mut self, found: &Reading, system: &System, mean_pressure: f64) -> Result<(), StudyError> {
        let total = 3.0 * AREA * mean_pressure;
        let series = system.loaded(total, 0.2).ok_or("the series did not converge")?;
        self.penetrations.push((found.penetration, series[0].penetration));
        for (m, (level, series)) in found.levels.iter().zip(&series).enumerate() {
            self.peaks.push((level.max_pressure, series.axis));
            self.shares.push((level.load_share, series.load / total));
            self.radii.push((radius(found, m), series.radius));
        }
        Ok(())
    }

    /// One check a quantity that was compared; tolerances of peaks and penetrations, of shares, of radii.
    fn check(self, what: &str, source: &str, [pressure, share, radius]: [f64; 3], outcome: &mut Outcome) {
        for (quantity, pairs, tolerance) in [
            ("peaks", self.peaks, pressure),
            ("penetration", self.penetrations, pressure),
            ("load shares", self.shares, share),
            ("radii", self.radii, radius),
        ] {
            if !pairs.is_empty() {
                let tolerance = Tolerance::Relative(tolerance);
                outcome.checks.push(Check::worst(format!("{what}: {quantity}, {source}"), pairs, tolerance));
            }
        }
    }
}

/// Peak pressures and penetrations of one level against load.
fn figure(data: &[Data]) -> Result<Figure, StudyError> {
    let (mut peaks, mut depths) = (Vec::new(), Vec::new());
    let hertz = |mean_pressure: f64| Hertz::loaded(RADIUS, mean_pressure * AREA, 1.0);
    let loads = || logarithmic(1e-3, 0.12, 40);
    peaks.push(curve("Hertz alone, bare", Style::Dotted, 0, loads().into_iter().map(|p| [p, hertz(p).peak])));
    depths.push(curve("", Style::Dotted, 0, loads().into_iter().map(|p| [p, hertz(p).penetration])));
    let (hard, soft) = (Coating::new(2.0, [0.2, 0.3], 0.5)?, Coating::new(0.5, [0.45, 0.3], 0.5)?);
    for (name, modulus, sums, colour) in [
        ("bare", 1.0, TRIANGULAR, 1),
        ("χ = 2", hard.modulus(), coated_triangular(&hard, 1.0), 2),
        ("χ = 0.5", soft.modulus(), coated_triangular(&soft, 1.0), 3),
    ] {
        let (mut peak, mut depth) = (Vec::new(), Vec::new());
        // The series ends where contacts come too close.
        for mean_pressure in loads().into_iter().filter(|p| *p < 0.06 * modulus) {
            let contact = series(modulus, sums, mean_pressure)?;
            peak.push([mean_pressure, contact.axis]);
            depth.push([mean_pressure, contact.penetration]);
        }
        peaks.push(curve(if colour == 1 { "series of the images" } else { "" }, Style::Line, colour, peak));
        depths.push(curve("", Style::Line, colour, depth));
        let rows: Vec<&Vec<f64>> = match colour {
            1 => data[0].rows.iter().collect(),
            _ => data[1].rows.iter().filter(|row| (row[0] > 1.0) == (colour == 2)).collect(),
        };
        let [load, found, lift] = if colour == 1 { [0, 1, 3] } else { [2, 3, 5] };
        peaks.push(curve(name, Style::Markers, colour, rows.iter().map(|row| [row[load], row[found]])));
        depths.push(curve("", Style::Markers, colour, rows.iter().map(|row| [row[load], row[lift]])));
    }
    let chart = |y: &str, curves| Chart {
        title: String::new(),
        x: Axis::log("mean pressure over E* (bare), E₂"),
        y: Axis::log(y),
        curves,
    };
    let panels = vec![chart("peak pressure", peaks), chart("penetration over period", depths)];
    Ok(draw::figure(panels, "One level, R = 0.8 of the period, coatings of half a period."))
}
