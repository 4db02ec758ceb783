//! Sliding on coatings: stresses under a pressure and a traction, complete contact, small loads, incompressible surfaces, and
//! symmetry.

mod complete;
mod cylinder;
mod incompressible;
mod loads;
mod turned;

use super::draw::{self, curve, linear, slope};
use super::{Check, Data, Outcome, Study, StudyError, Tolerance};
use percoat_app::picture::{Axis, Chart, Figure, Style};

pub const STUDY: Study = Study {
    name: "sliding-coated",
    title: "Sliding on coatings: stresses, complete contact, small loads and symmetry",
    files: &[
        "complete.data.csv",
        "cylinder.data.csv",
        "figure.png",
        "incompressible.data.csv",
        "inside.data.csv",
        "surface.data.csv",
        "turned.data.csv",
    ],
    run,
    quick: None,
};

fn run() -> Result<Outcome, StudyError> {
    let (inside, surface) = (loads::inside()?, loads::surface()?);
    let (complete, cylinder, turned) = (complete::table()?, cylinder::table()?, turned::table()?);
    let incompressible = incompressible::stacks()?;
    let mut checks = checks_of_loads(&inside, &surface);
    checks.extend(checks_of_complete_contact(&complete));
    checks.extend(checks_of_small_loads(&cylinder));
    checks.extend(checks_of_incompressible_surfaces(&incompressible, incompressible::change()?));
    checks.extend(checks_of_symmetry(&turned));
    let figures = vec![("figure", figure(&inside, &surface, &complete, &cylinder))];
    let data = vec![inside, surface, complete, cylinder, incompressible, turned];
    Ok(Outcome { checks, figures, data, ..Outcome::default() })
}

/// The rows of a table that are of one kind.
fn of<'a>(data: &'a Data, kind: impl Fn(&[f64]) -> bool + 'a) -> impl Iterator<Item = &'a [f64]> {
    data.rows.iter().map(Vec::as_slice).filter(move |row| kind(row))
}

/// A column of `inside`: the table's value, then those of the sides, then the extrapolated one.
const TABLE: usize = 6;
const LAST: usize = TABLE + loads::SIDES.len();

/// Largest error in a column of `inside`.
fn error_inside(inside: &Data, ratio: f64, column: usize) -> f64 {
    of(inside, |row| row[0] == ratio).fold(0.0, |most, row| most.max((row[column] - row[TABLE]).abs()))
}

fn checks_of_loads(inside: &Data, surface: &Data) -> Vec<Check> {
    let mut checks = Vec::new();
    for ratio in loads::RATIOS {
        for (load, name) in [(0.0, "pressure"), (1.0, "traction")] {
            let rows = of(inside, |row| row[0] == ratio && row[4] == load);
            let name = format!("E₁ = {ratio} E₂: stresses of the {name} inside");
            checks.push(Check::worst(name, rows.map(|row| (row[LAST + 1], row[TABLE])), Tolerance::Absolute(1e-6)));
        }
    }
    for ratio in loads::RATIOS {
        let [near, far] = [LAST - 1, LAST].map(|column| error_inside(inside, ratio, column));
        checks.push(Check::order(format!("E₁ = {ratio} E₂: order of the images"), (near / far).log2(), 3.0, 0.25));
    }
    let doublings = (loads::SAMPLED.len() - 1) as f64;
    let spacing = 1.0 / loads::SAMPLED[loads::SAMPLED.len() - 1] as f64;
    for ratio in loads::RATIOS {
        let rows: Vec<&[f64]> = of(surface, |row| row[0] == ratio).collect();
        let (first, last) = (rows[0], rows[rows.len() - 1]);
        let order = |error: &dyn Fn(&[f64]) -> f64| (error(first) / error(last)).log2() / doublings;
        let named = |what: &str| format!("E₁ = {ratio} E₂, sampled: {what}");
        checks.push(Check::order(named("order inside"), order(&|row| row[2]), 2.0, 0.25));
        checks.push(Check::order(named("order of σ_x at the edge"), order(&|row| (row[3] - row[4]).abs()), 0.5, 0.1));
        let before = rows[rows.len() - 2];
        let edge = last[3] + (last[3] - before[3]) / (2f64.sqrt() - 1.0);
        checks.push(Check::absolute(named("σ_x of the traction at the edge"), edge, last[4], 0.5 * spacing));
        checks.push(Check::absolute(named("σ_x of the pressure in the middle"), last[5], last[6], spacing * spacing));
        let stated = rows.iter().map(|row| ((row[7] - row[9]).abs() / row[8], 0.0));
        checks.push(Check::worst(
            named("largest tension, error over the stated one"),
            stated,
            Tolerance::Absolute(1.0),
        ));
    }
    checks
}

fn checks_of_complete_contact(complete: &Data) -> Vec<Check> {
    let tolerance = Tolerance::Absolute(20.0 * complete::TOLERANCE);
    let check = |name: &str, of_kind: fn(&[f64]) -> bool| {
        Check::worst(name, of(complete, of_kind).map(|row| (row[9], 0.0)), tolerance)
    };
    vec![
        check("complete contact, relative error of a component", |row| row[1] < 0.5),
        check("the same, incompressible coating", |row| row[1] == 0.5),
    ]
}

fn checks_of_small_loads(cylinder: &Data) -> Vec<Check> {
    let mut checks = Vec::new();
    for coupling in cylinder::COUPLINGS {
        let rows: Vec<&[f64]> = of(cylinder, |row| row[0] == coupling).collect();
        let last = rows[rows.len() - 1];
        let edges = [(last[2], last[3]), (last[4], last[5])];
        let sample = Tolerance::Absolute(1.5 / cylinder::POINTS as f64);
        checks.push(Check::worst(format!("f = {coupling}, least load: edges over λ"), edges, sample));
        for (name, column) in [("centre", 6), ("width", 8)] {
            let error = |row: &[f64]| row[column] - row[column + 1];
            let order = (error(rows[0]) / error(last)).log2() / (rows.len() - 1) as f64;
            checks.push(Check::order(format!("f = {coupling}: order of the {name} in the load"), order, 1.0, 0.15));
            let without = 2.0 * error(last) - error(rows[rows.len() - 2]);
            checks.push(Check::absolute(format!("f = {coupling}: {name} over c without load"), without, 0.0, 2e-4));
        }
    }
    checks
}

fn checks_of_incompressible_surfaces(stacks: &Data, [bare, coated]: [f64; 2]) -> Vec<Check> {
    let added = stacks.rows.iter().map(|row| (row[3], row[4]));
    vec![
        Check::absolute("incompressible half-space: change of the pressure by friction", bare, 0.0, 1e-14)
            .of_refinement(),
        Check::at_least("soft incompressible coating: the same", coated, 0.1),
        Check::worst("incompressible surfaces: what the traction adds", added, Tolerance::Absolute(1e-12)),
    ]
}

fn checks_of_symmetry(turned: &Data) -> Vec<Check> {
    let mut checks = Vec::new();
    // The search for largest values has the axes of the cell: a turn by 60° does not keep them.
    for (fold, name, [fraction, peak, stresses]) in
        [(6.0, "turned by 60° and 120°", [1e-6, 5e-4, 2e-5]), (4.0, "turned by 90°", [1e-8; 3])]
    {
        for (what, column, tolerance) in [
            ("pressure", 2, 1e-10),
            ("penetration", 3, 1e-12),
            ("contact fraction", 4, fraction),
            ("largest pressure", 5, peak),
            ("largest stresses", 6, stresses),
        ] {
            let rows = of(turned, |row| row[0] == fold).map(|row| (row[column], 0.0));
            let name = format!("{name}: {what}, relative change");
            checks.push(Check::worst(name, rows, Tolerance::Absolute(tolerance)).of_refinement());
        }
    }
    checks
}

fn figure(inside: &Data, surface: &Data, complete: &Data, cylinder: &Data) -> Figure {
    let mut images = Vec::new();
    for (colour, ratio) in (1..).zip(loads::RATIOS) {
        let error = |k: usize| [loads::SIDES[k] as f64, error_inside(inside, ratio, TABLE + 1 + k)];
        let points: Vec<[f64; 2]> = (0..loads::SIDES.len()).map(error).collect();
        images.push(slope(if colour == 1 { "L⁻³" } else { "" }, -3.0, 0, &points));
        images.push(curve(format!("E₁ = {ratio} E₂"), Style::Markers, colour, points));
        let extrapolated = [[loads::SIDES[2] as f64, error_inside(inside, ratio, LAST + 1)]];
        images.push(curve(format!("E₁ = {ratio} E₂, without L⁻³, L⁻⁴"), Style::Markers, colour + 2, extrapolated));
    }
    let mut sampled = Vec::new();
    for (colour, ratio) in (1..).zip(loads::RATIOS) {
        let points = |error: fn(&[f64]) -> f64| -> Vec<[f64; 2]> {
            of(surface, |row| row[0] == ratio).map(|row| [row[1], error(row)]).collect()
        };
        let (within, edge) = (points(|row| row[2]), points(|row| (row[3] - row[4]).abs()));
        if colour == 1 {
            sampled.push(slope("d², √d", -2.0, 0, &within));
            sampled.push(slope("", -0.5, 0, &edge));
        }
        sampled.push(curve(format!("E₁ = {ratio} E₂, inside"), Style::Markers, colour, within));
        sampled.push(curve(format!("E₁ = {ratio} E₂, σ_x at the edge"), Style::Markers, colour + 2, edge));
    }
    let mut phases = Vec::new();
    let stacks = [(0.2, "G₁ = 2 G₂, ν₁ = 0.2"), (0.45, "0.5 G₂, 0.45"), (0.5, "0.2 G₂, 0.5")];
    for (colour, (poisson, name)) in (1..).zip(stacks) {
        let mut found: Vec<[f64; 2]> =
            of(complete, |row| row[1] == poisson && row[2] == 1.0).map(|row| [row[4], row[7]]).collect();
        found.sort_by(|a, b| a[0].total_cmp(&b[0]));
        // tan φ = μ cosθ S/(2(1−ν₁)T): from the phase along the wave.
        let along = of(complete, |row| row[1] == poisson && row[2] == 1.0)
            .find(|row| row[4].abs() < 1e-3)
            .map_or(f64::NAN, |row| row[8].to_radians().tan());
        let line = linear(0.0, 150.0, 101)
            .into_iter()
            .map(|angle| [angle, (along * angle.to_radians().cos()).atan().to_degrees()]);
        phases.push(curve("", Style::Line, colour, line));
        phases.push(curve(name, Style::Markers, colour, found));
    }
    let mut small = Vec::new();
    for (index, coupling) in cylinder::COUPLINGS.into_iter().enumerate() {
        for (name, column, colour) in [("centre", 6, 1), ("width", 8, 2)] {
            let rows = of(cylinder, move |row| row[0] == coupling);
            let points: Vec<[f64; 2]> = rows.map(|row| [row[1], (row[column] - row[column + 1]).abs()]).collect();
            if index == 0 {
                small.push(slope(if column == 6 { "p̄/p*" } else { "" }, 1.0, 0, &points));
            }
            small.push(curve(format!("{name}, f = {coupling}"), Style::Markers, colour + 2 * index, points));
        }
    }
    let chart = |x: Axis, y: &str, curves| Chart { title: String::new(), x, y: Axis::log(y), curves };
    let panels = vec![
        chart(Axis::log("side of the cell L/a"), "largest error inside over p₀ or q₀", images),
        chart(Axis::log("samples per radius"), "error of a sampled load", sampled),
        Chart {
            title: String::new(),
            x: Axis::linear("angle between sliding and wave (°)"),
            y: Axis::linear("phase of the pressure (°)"),
            curves: phases,
        },
        chart(Axis::log("load p̄/p*"), "error over c", small),
    ];
    let words = "Loads √(1−r²) on a bonded coating against integrals over wavenumbers: images and sampling; complete contact on coatings at \
                 kh = 1, μ = 1, closed form (lines) and solution (markers); a sliding wave under small loads against a cylinder.";
    draw::figure(panels, words)
}
