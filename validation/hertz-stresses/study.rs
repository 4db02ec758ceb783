//! Stresses under a solved contact against Huber's closed form ([`crate::exact::hertz`]).
//!
//! A paraboloid on a wide lattice, a/l = 0.05: its contact is Hertz' own to 10⁻⁶ once the images' curvature is in the
//! load. Its images press sideways at a depth by −(a²/3)(1+ν)S₃z p₀ in σ_r and σ_θ (the first term of theirs), which is
//! added to the closed form.

use super::draw::{self, curve, linear};
use super::steps::{Steps, case};
use super::{Check, Data, Outcome, Study, StudyError, Tolerance};
use crate::exact::galin::paraboloid;
use crate::exact::hertz::{Stresses, edge_tension, largest_shear};
use crate::exact::lattice_sums::TRIANGULAR;
use crate::exact::{Sums, System};
use percoat_app::picture::{Axis, Chart, Figure, Style};
use percoat_core::body::{Depth, MeanStress};
use percoat_core::load::Load;
use percoat_core::stress::StressField;

pub const STUDY: Study = Study {
    name: "hertz-stresses",
    title: "Stresses under Hertz' contact, inside and on the surface",
    files: &["figure.png", "maxima.data.csv", "stresses.data.csv"],
    run: || run(&[0.2, DRAWN, 0.45]),
    quick: Some(|| run(&[DRAWN])),
};

const CASE: &str = include_str!("case.toml");
/// Contact radius over period.
const RADIUS: f64 = 0.05;
const POINTS: usize = 800;
/// z/a.
const DEPTHS: [f64; 6] = [0.1, 0.25, 0.5, 0.75, 1.0, 1.5];
/// r/a.
const PLACES: [f64; 8] = [0.0, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 2.0];
/// Poisson's ratio of the drawn stresses, and of the quick form.
const DRAWN: f64 = 0.3;

fn run(ratios: &[f64]) -> Result<Outcome, StudyError> {
    let mut outcome = Outcome::default();
    let columns = [
        "nu",
        "z",
        "r",
        "radial",
        "radial_exact",
        "hoop",
        "hoop_exact",
        "axial",
        "axial_exact",
        "shear",
        "shear_exact",
    ];
    let mut data = Data::new("stresses", &columns);
    let mut maxima =
        Data::new("maxima", &["nu", "tau1", "tau1_exact", "depth", "depth_exact", "tension", "tension_exact"]);
    for &nu in ratios {
        let case = case("hertz-stresses", CASE, &[format!("substrate.poisson={nu}")])?;
        let modulus = case.half_space().surface_material().contact_modulus();
        let contact = System::single(modulus, TRIANGULAR, vec![paraboloid(1.0)]).contacts(&[RADIUS])[0];
        let load = Load::MeanPressure(contact.load / case.problem().cell().area());
        let mut steps = Steps::of(&case, POINTS)?;
        let (step, _) = steps.solve(load)?;
        let field = StressField::new(step.finest(), MeanStress::HalfSpace);
        let Sums([_, s3, _]) = TRIANGULAR;
        let images = |z: f64| -RADIUS.powi(3) / 3.0 * (1.0 + nu) * s3 * z;
        // Along a direction that belongs to no lattice line.
        let (sine, cosine) = 0.3f64.sin_cos();
        let places: Vec<[f64; 2]> = PLACES.iter().map(|r| [r * RADIUS * cosine, r * RADIUS * sine]).collect();
        for z in DEPTHS {
            let states = field.points(Depth { z: z * RADIUS, material: 1 }, &places);
            for (&r, state) in PLACES.iter().zip(states) {
                let exact = Stresses::at(r, z, nu);
                let turned =
                    |a: f64, b: f64| (a * a * state.xx + b * b * state.yy + 2.0 * a * b * state.xy) / contact.axis;
                data.rows.push(vec![
                    nu,
                    z,
                    r,
                    turned(cosine, sine),
                    exact.radial + images(z),
                    turned(-sine, cosine),
                    exact.hoop + images(z),
                    state.zz / contact.axis,
                    exact.axial,
                    (cosine * state.xz + sine * state.yz) / contact.axis,
                    exact.shear,
                ]);
            }
        }
        let found = field.maxima([RADIUS; 2]);
        let (tau1, tension) = (found.materials[0].tau1, found.faces[0].tension);
        let [largest, depth] = largest_shear(nu);
        maxima.rows.push(vec![
            nu,
            tau1.value / contact.axis,
            // τ₁ is half the difference of σ_z and σ_r on the axis.
            largest + 0.5 * images(depth),
            tau1.position[2] / RADIUS,
            depth,
            tension.value / contact.axis,
            edge_tension(nu),
        ]);
    }
    for (quantity, name) in [("radial", "σ_r"), ("hoop", "σ_θ"), ("axial", "σ_z"), ("shear", "τ_rz")] {
        let [found, exact] = [data.column(quantity), data.column(&format!("{quantity}_exact"))];
        let z = data.column("z");
        let deep = |least: f64, most: f64| -> Vec<(f64, f64)> {
            let pairs = found.iter().copied().zip(exact.iter().copied()).zip(&z);
            pairs.filter(|(_, z)| (least..=most).contains(*z)).map(|(pair, _)| pair).collect()
        };
        outcome.checks.push(Check::worst(format!("{name}/p₀, z = 0.1a"), deep(0.1, 0.1), Tolerance::Absolute(1e-3)));
        outcome.checks.push(Check::worst(
            format!("{name}/p₀, z = 0.25a to 1.5a"),
            deep(0.2, 2.0),
            Tolerance::Absolute(3e-4),
        ));
    }
    for (quantity, name, tolerance) in [
        ("tau1", "largest τ₁/p₀ below the surface, ν = 0.2, 0.3, 0.45", 1e-3),
        ("depth", "its depth z/a", 1e-2),
        ("tension", "largest tension on the surface, ν = 0.2, 0.3, 0.45", 1.5e-2),
    ] {
        let pairs = maxima.column(quantity).into_iter().zip(maxima.column(&format!("{quantity}_exact")));
        outcome.checks.push(Check::worst(name, pairs, Tolerance::Relative(tolerance)));
    }
    outcome.figures.push(("figure", figure(&data)));
    outcome.data = vec![data, maxima];
    Ok(outcome)
}

fn figure(data: &Data) -> Figure {
    let rows = || data.rows.iter().filter(|row| row[0] == DRAWN);
    let (mut axis, mut across) = (Vec::new(), Vec::new());
    for (name, column, of, colour) in [
        ("σ_r", 3, (|s: Stresses| s.radial) as fn(Stresses) -> f64, 1),
        ("σ_z", 7, |s: Stresses| s.axial, 2),
        ("τ_rz", 9, |s: Stresses| s.shear, 3),
    ] {
        // On the axis the shear vanishes.
        if colour < 3 {
            let depths = linear(0.0, 1.6, 100).into_iter().map(|z| [z, of(Stresses::at(0.0, z, DRAWN))]);
            let found = rows().filter(|row| row[2] == 0.0).map(|row| [row[1], row[column]]);
            axis.push(curve("", Style::Line, colour, depths));
            axis.push(curve(name, Style::Markers, colour, found));
        }
        let places = linear(0.0, 2.1, 150).into_iter().map(|r| [r, of(Stresses::at(r, 0.25, DRAWN))]);
        across.push(curve("", Style::Line, colour, places));
        let found = rows().filter(|row| row[1] == 0.25).map(|row| [row[2], row[column]]);
        across.push(curve(name, Style::Markers, colour, found));
    }
    let tau1 = linear(0.0, 1.6, 100).into_iter().map(|z| [z, Stresses::at(0.0, z, DRAWN).tau1()]);
    axis.push(curve("", Style::Line, 4, tau1));
    let found = rows().filter(|row| row[2] == 0.0).map(|row| [row[1], 0.5 * (row[3] - row[7]).abs()]);
    axis.push(curve("τ₁", Style::Markers, 4, found));
    let chart = |title: &str, x: &str, curves| Chart {
        title: title.to_owned(),
        x: Axis::linear(x),
        y: Axis::linear("stress over p₀"),
        curves,
    };
    let panels = vec![chart("On the axis", "depth z/a", axis), chart("At the depth a/4", "radius r/a", across)];
    draw::figure(
        panels,
        "Lines: Huber's closed form, ν = 0.3; markers: stresses under the solved contact, 40 samples a radius.",
    )
}
