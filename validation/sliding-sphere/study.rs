//! Stresses under a solved contact that slides, without influence on its pressure, against closed forms
//! ([`crate::exact::sliding_sphere`]) and the table of their independent check.
//!
//! A paraboloid on a wide lattice, as in `hertz-stresses`. What the images' first terms press and drag is added to the
//! closed form. The trailing edge is looked for as [`percoat_core::stress::Crest`] does, with the error that it states.

use super::draw::{self, curve, linear};
use super::steps::{Steps, case};
use super::{Check, Data, Outcome, Study, StudyError, Tolerance};
use crate::exact::galin::paraboloid;
use crate::exact::lattice_sums::TRIANGULAR;
use crate::exact::sliding_sphere::{Stress, images, stresses, together, trailing_tension, turned};
use crate::exact::{Sums, System};
use percoat_app::picture::{Axis, Chart, Figure, Style};
use percoat_core::body::{Depth, MeanStress};
use percoat_core::friction::Friction;
use percoat_core::load::Load;
use percoat_core::spectral::{Contact, Step};
use percoat_core::stress::{Crest, StressField, StressState, SurfaceLine};
use std::f64::consts::FRAC_PI_3;

pub const STUDY: Study = Study {
    name: "sliding-sphere",
    title: "Stresses under a sliding sphere, inside, on the surface and at the trailing edge",
    files: &["edge.data.csv", "figure.png", "inside.data.csv", "surface.data.csv"],
    run: || run(&POISSON),
    quick: Some(|| run(&[DRAWN])),
};

const CASE: &str = include_str!("case.toml");
const REFERENCE: &str = include_str!("reference.csv");
const POISSON: [f64; 3] = [0.0, 0.3, 0.5];
/// Poisson's ratio of the drawn stresses, and of the quick form.
const DRAWN: f64 = 0.3;
/// Contact radius over period, and samples along the radius, where stresses are compared.
const RADIUS: f64 = 0.05;
const SAMPLES: usize = 40;
/// Coefficient of friction there, and the bearing of the sliding: along no lattice line.
const FRICTION: f64 = 1.0;
const BEARING: f64 = 0.3;
/// Depths over a from which on the series itself is compared; the spacing is a/40.
const LEAST_DEPTH: f64 = 0.05;
/// Distance of the second line on the surface from the centre, over a.
const ASIDE: f64 = 0.4;
/// Contact radius over period where the trailing edge is looked for, and what is varied there.
const EDGE_RADIUS: f64 = 0.1;
const RESOLUTIONS: [usize; 4] = [10, 20, 28, 40];
const FRICTIONS: [f64; 3] = [0.1, 0.5, 1.0];
const DEGREES: [f64; 5] = [0.0, 17.0, 30.0, 45.0, 90.0];
const COMPONENTS: [&str; 6] = ["xx", "yy", "zz", "xy", "xz", "yz"];

/// A solved contact, the pressure in its middle, and a over the period.
struct Solved {
    step: Step,
    axis: f64,
    radius: f64,
}

impl Solved {
    fn new(nu: f64, radius: f64, samples: usize) -> Result<Self, StudyError> {
        let case = case("sliding-sphere", CASE, &[format!("substrate.poisson={nu}")])?;
        let modulus = case.half_space().surface_material().contact_modulus();
        let contact = System::single(modulus, TRIANGULAR, vec![paraboloid(1.0)]).contacts(&[radius])[0];
        let mut steps = Steps::of(&case, (samples as f64 / radius).round() as usize)?;
        let step = steps.step(Load::MeanPressure(contact.load / case.problem().cell().area()))?;
        Ok(Self { step, axis: contact.axis, radius })
    }

    /// The field under one of its grids where it slides with the bearing `angle`.
    fn field(&self, contact: &Contact, friction: f64, angle: f64) -> Result<StressField, StudyError> {
        let friction = Friction::new(friction, [angle.cos(), angle.sin()])?.uncoupled();
        let half_space = self.step.problem().half_space();
        Ok(StressField::under(contact.grid(), contact.pressure(), half_space, Some(&friction), MeanStress::HalfSpace)?)
    }

    /// The largest tension on the surface, and its stated error; pressures.
    fn crest(&self, friction: f64, angle: f64) -> Result<(Crest, f64), StudyError> {
        let crest = self.field(self.step.finest(), friction, angle)?.crest().ok_or("contact has an edge")?;
        let coarser = self.step.coarser().first().ok_or("there is a coarser grid")?;
        let coarser = self.field(coarser, friction, angle)?.crest().map(|crest| crest.peak.value);
        Ok((crest, crest.error(coarser) * crest.scale))
    }

    /// Part of the images' first terms in the stresses.
    fn images(&self, nu: f64, place: [f64; 3]) -> [Stress; 2] {
        let Sums([_, s3, _]) = TRIANGULAR;
        images(nu, place).map(|stress| stress.map(|part| self.radius.powi(3) * s3 * part))
    }
}

fn components(state: &StressState) -> Stress {
    [state.xx, state.yy, state.zz, state.xy, state.xz, state.yz]
}

fn rotated([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (s, c) = angle.sin_cos();
    [c * x - s * y, s * x + c * y]
}

fn run(ratios: &[f64]) -> Result<Outcome, StudyError> {
    let with_exact = |first: &[&str], names: &[&str]| -> Vec<String> {
        let both = names.iter().flat_map(|name| [(*name).to_owned(), format!("{name}_exact")]);
        first.iter().map(|&name| name.to_owned()).chain(both).collect()
    };
    let mut inside = Data::new("inside", &[]);
    inside.columns = with_exact(&["nu", "x", "y", "z"], &COMPONENTS);
    let mut surface = Data::new("surface", &[]);
    surface.columns = with_exact(&["nu", "x", "y"], &["xx", "yy", "xy"]);
    let mut turn = Vec::new();
    let reference = Data::parse("reference", &numbers_only(REFERENCE))?;
    for &nu in ratios {
        let solved = Solved::new(nu, RADIUS, SAMPLES)?;
        let field = solved.field(solved.step.finest(), FRICTION, BEARING)?;
        read_inside(&mut inside, &solved, &field, nu, &reference);
        read_surface(&mut surface, &solved, &field, nu);
        if nu == DRAWN {
            turn = turned_by_a_sixth(&solved, &field)?;
        }
    }
    let edge = edges(ratios)?;
    let mut outcome = Outcome::default();
    let pairs = |data: &Data, name: &str, keep: &dyn Fn(&[f64]) -> bool| -> Vec<(f64, f64)> {
        let Some(k) = data.columns.iter().position(|column| column == name) else { return Vec::new() };
        data.rows.iter().filter(|row| keep(row)).map(|row| (row[k], row[k + 1])).collect()
    };
    for (name, symbol) in COMPONENTS.into_iter().zip(["σ_x", "σ_y", "σ_z", "τ_xy", "τ_xz", "τ_yz"]) {
        for (range, [low, high], tolerance) in [
            ("z = 0.05a and 0.1a", [0.0, 0.15], 2e-4),
            ("z = 0.2a to a", [0.15, 1.5], 1e-4),
            ("z = 3a", [1.5, 9.0], 3e-4),
        ] {
            outcome.checks.push(Check::worst(
                format!("{symbol}/p₀, {range}"),
                pairs(&inside, name, &|row| low < row[3] && row[3] < high),
                Tolerance::Absolute(tolerance),
            ));
        }
    }
    for (name, symbol) in [("xx", "σ_x"), ("yy", "σ_y"), ("xy", "τ_xy")] {
        for (range, [low, high], tolerance) in [
            ("r < 0.7a", [0.0, 0.7], 3e-4),
            ("r = 0.7a to 0.9a", [0.7, 0.9], 5e-3),
            ("r = 1.1a to 2a", [1.1, 2.2], 1e-3),
        ] {
            let keep = |row: &[f64]| (low..high).contains(&row[1].hypot(row[2]));
            outcome.checks.push(Check::worst(
                format!("{symbol}/p₀ on the surface, {range}"),
                pairs(&surface, name, &keep),
                Tolerance::Absolute(tolerance),
            ));
        }
    }
    edge_checks(&mut outcome, &edge);
    // The pressure is the same but for the tolerance of the solver, 10⁻⁸.
    let name = "stresses over p₀ after a sixth of a turn";
    outcome.checks.push(Check::worst(name, turn, Tolerance::Absolute(1e-7)).of_refinement());
    outcome.figures.push(("figure", figure(&surface, &edge)));
    outcome.data = vec![inside, surface, edge];
    Ok(outcome)
}

/// The table with its loads as numbers: 0 normal, 1 tangential.
fn numbers_only(text: &str) -> String {
    text.replace(",normal,", ",0,").replace(",tangential,", ",1,")
}

/// Stresses at the places of the table, in the axes of the sliding.
fn read_inside(data: &mut Data, solved: &Solved, field: &StressField, nu: f64, reference: &Data) {
    let rows = || reference.rows.iter().filter(|row| row[0] == nu && row[3] >= LEAST_DEPTH);
    for normal in rows().filter(|row| row[4] == 0.0) {
        let Some(tangential) = rows().find(|row| row[4] == 1.0 && row[1..4] == normal[1..4]) else { continue };
        let place @ [x, y, z] = [normal[1], normal[2], normal[3]];
        let loads = [normal, tangential].map(|row| std::array::from_fn(|k| row[5 + k]));
        let [exact, images] = [loads, solved.images(nu, place)].map(|loads| together(loads, FRICTION));
        let depth = Depth { z: z * solved.radius, material: 1 };
        let place = rotated([x, y], BEARING).map(|s| s * solved.radius);
        let found = field.points(depth, &[place]);
        let found = turned(components(&found[0]), -BEARING).map(|stress| stress / solved.axis);
        let mut row = vec![nu, x, y, z];
        row.extend((0..6).flat_map(|k| [found[k], exact[k] + images[k]]));
        data.rows.push(row);
    }
}

/// Stresses along two lines on the surface that follow the sliding.
fn read_surface(data: &mut Data, solved: &Solved, field: &StressField, nu: f64) {
    for aside in [0.0, ASIDE] {
        let line = SurfaceLine {
            origin: rotated([0.0, aside], BEARING).map(|s| s * solved.radius),
            direction: [BEARING.cos(), BEARING.sin()],
            span: [-2.0, 2.0].map(|s| s * solved.radius),
            points: 401,
        };
        let section = field.section(&line, &[Depth::SURFACE]);
        for (s, state) in line.distances().into_iter().zip(&section.states) {
            let place = [s / solved.radius, aside, 0.0];
            let [exact, images] = [stresses(nu, place), solved.images(nu, place)].map(|both| together(both, FRICTION));
            let found = turned(components(state), -BEARING).map(|stress| stress / solved.axis);
            let mut row = vec![nu, place[0], aside];
            row.extend([0, 1, 3].into_iter().flat_map(|k| [found[k], exact[k] + images[k]]));
            data.rows.push(row);
        }
    }
}

/// The six stresses over p₀, in the axes of the sliding, where the sliding turns by a sixth and the places with it.
fn turned_by_a_sixth(solved: &Solved, field: &StressField) -> Result<Vec<(f64, f64)>, StudyError> {
    let other = solved.field(solved.step.finest(), FRICTION, BEARING + FRAC_PI_3)?;
    let read = |field: &StressField, angle: f64, z: f64| -> Vec<f64> {
        let places =
            [[-0.9, 0.0], [0.3, 0.4], [-1.5, 0.7]].map(|place| rotated(place, angle).map(|s| s * solved.radius));
        let states = field.points(Depth { z: z * solved.radius, material: 1 }, &places);
        states.iter().flat_map(|state| turned(components(state), -angle)).map(|part| part / solved.axis).collect()
    };
    let at = |z: f64| {
        let [here, there] = [read(field, BEARING, z), read(&other, BEARING + FRAC_PI_3, z)];
        here.into_iter().zip(there).collect::<Vec<_>>()
    };
    Ok([0.05, 0.3, 1.0].into_iter().flat_map(at).collect())
}

/// The trailing edge: every friction, direction and resolution; and what a sixth of a turn changes.
fn edges(ratios: &[f64]) -> Result<Data, StudyError> {
    let columns = ["nu", "samples", "mu", "degrees", "tension", "tension_exact", "stated", "off_edge", "turn"];
    let mut data = Data::new("edge", &columns);
    for &nu in ratios {
        for samples in RESOLUTIONS {
            let solved = Solved::new(nu, EDGE_RADIUS, samples)?;
            for mu in FRICTIONS {
                for degrees in DEGREES {
                    let angle = degrees.to_radians();
                    let (crest, stated) = solved.crest(mu, angle)?;
                    let [_, dragged] = solved.images(nu, [-1.0, 0.0, 0.0]);
                    let exact = trailing_tension(nu, mu) + mu * dragged[0];
                    let [x, y, _] = crest.peak.position;
                    let off = rotated([-solved.radius, 0.0], angle);
                    let cell = solved.step.grid().cell();
                    let [x, y] = cell.reduced().nearest(cell.fractions([x - off[0], y - off[1]]));
                    let sixth = if samples == RESOLUTIONS[0] {
                        let (other, _) = solved.crest(mu, angle + FRAC_PI_3)?;
                        (other.peak.value / crest.peak.value - 1.0).abs()
                    } else {
                        0.0
                    };
                    data.rows.push(vec![
                        nu,
                        samples as f64,
                        mu,
                        degrees,
                        crest.peak.value / solved.axis,
                        exact,
                        stated / solved.axis,
                        x.hypot(y) / solved.radius,
                        sixth,
                    ]);
                }
            }
        }
    }
    Ok(data)
}

/// Root mean squares of the error over p₀ at the trailing edge and of the stated one, over all directions and ν.
fn typical_errors(edge: &Data, samples: usize, mu: f64) -> [f64; 2] {
    let rows = || edge.rows.iter().filter(|row| row[1] == samples as f64 && row[2] == mu);
    let mean =
        |of: fn(&Vec<f64>) -> f64| (rows().map(|row| of(row).powi(2)).sum::<f64>() / rows().count() as f64).sqrt();
    [mean(|row| row[4] - row[5]), mean(|row| row[6])]
}

fn edge_checks(outcome: &mut Outcome, edge: &Data) {
    let over = |row: &Vec<f64>| ((row[4] - row[5]).abs() / row[6], 0.0);
    outcome.checks.push(Check::worst(
        "tension at the trailing edge, error over the stated one",
        edge.rows.iter().map(over),
        Tolerance::Absolute(1.0),
    ));
    for (samples, tolerance) in RESOLUTIONS.into_iter().zip([3e-2, 1e-2, 1e-2, 6e-3]) {
        let pairs = edge.rows.iter().filter(|row| row[1] == samples as f64).map(|row| (row[4], row[5]));
        let name = format!("the same, {samples} samples a radius");
        outcome.checks.push(Check::worst(name, pairs, Tolerance::Relative(tolerance)));
    }
    let [first, .., last] = RESOLUTIONS;
    for mu in FRICTIONS {
        let fall = typical_errors(edge, first, mu)[0] / typical_errors(edge, last, mu)[0];
        let order = fall.ln() / (last as f64 / first as f64).ln();
        outcome.checks.push(Check::at_least(format!("order in which its error falls, μ = {mu}"), order, 1.0));
    }
    // Along the edge the tension falls from the trailing place on: by more than is stated the highest place cannot be off.
    let lost = |row: &Vec<f64>| {
        let cosine = 1.0 - 0.5 * row[7] * row[7];
        ((1.0 - cosine) * (row[5] - trailing_tension(row[0], 0.0)) / row[6], 0.0)
    };
    outcome.checks.push(Check::worst(
        "what the tension at its place is lower, over the stated error",
        edge.rows.iter().map(lost),
        Tolerance::Absolute(1.0),
    ));
    let off = edge.rows.iter().map(|row| (row[8] * row[1].powi(2), 0.0));
    let name = "its change by a sixth of a turn times n²";
    outcome.checks.push(Check::worst(name, off, Tolerance::Absolute(0.17)).of_refinement());
}

fn figure(surface: &Data, edge: &Data) -> Figure {
    let mut along = Vec::new();
    for (name, k, column, colour) in [("σ_x", 0, 3, 1), ("σ_y", 1, 5, 2)] {
        let at = |x: f64| together(stresses(DRAWN, [x, 0.0, 0.0]), FRICTION)[k];
        along.push(curve("", Style::Line, colour, linear(-2.0, 2.0, 801).into_iter().map(|x| [x, at(x)])));
        let rows = surface.rows.iter().filter(|row| row[0] == DRAWN && row[2] == 0.0).step_by(10);
        along.push(curve(name, Style::Markers, colour, rows.map(|row| [row[1], row[column]])));
    }
    let mut falling = Vec::new();
    for (colour, mu) in (1..).zip(FRICTIONS) {
        let [points, stated] =
            [0, 1].map(|k| RESOLUTIONS.map(|samples| [samples as f64, typical_errors(edge, samples, mu)[k]]));
        falling.push(curve(format!("μ = {mu}"), Style::LineMarkers, colour, points));
        falling.push(curve("", Style::Dashed, colour, stated));
    }
    let chart = |title: &str, x: Axis, y: Axis, curves| Chart { title: title.to_owned(), x, y, curves };
    let panels = vec![
        chart("On the surface, μ = 1", Axis::linear("along the sliding x/a"), Axis::linear("stress over p₀"), along),
        chart(
            "At the trailing edge",
            Axis::log("samples a radius"),
            Axis::log("error of the tension over p₀"),
            falling,
        ),
    ];
    draw::figure(
        panels,
        "Lines: closed form, ν = 0.3; markers: solved, 40 samples a radius. Right: mean over directions and ν; dashed: stated.",
    )
}
