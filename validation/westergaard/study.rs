//! A wave pressed flat: Westergaard's pressures and contact widths ([`crate::exact::westergaard`]).

use super::draw::{self, curve, linear};
use super::steps::{Steps, fraction_in_contact, topography};
use super::{Check, Data, Outcome, Study, StudyError, Tolerance};
use crate::exact::westergaard::Wave;
use percoat_app::picture::{Axis, Chart, Style};
use percoat_core::body::{HalfSpace, Material};
use percoat_core::lattice::Cell;
use percoat_core::load::Load;
use std::f64::consts::TAU;

pub const STUDY: Study = Study {
    name: "westergaard",
    title: "A sinusoidal wave from light load to complete contact",
    files: &["figure.png", "loads.data.csv"],
    run,
    quick: None,
};

const WAVE: Wave = Wave { amplitude: 0.02, wavelength: 1.0, modulus: 1.0 };
const POINTS: [usize; 2] = [2048, 4];
/// p̄/p*.
const FRACTIONS: [f64; 7] = [0.01, 0.05, 0.1, 0.3, 0.5, 0.7, 0.9];
/// Values of p̄/p* whose pressure is drawn.
const DRAWN: [f64; 3] = [0.1, 0.5, 0.9];

fn run() -> Result<Outcome, StudyError> {
    let half_space = HalfSpace::new(vec![], Material::from_young(1.0, 0.0)?);
    let cell = Cell::new([1.0, 0.0], [0.0, 0.01])?;
    let surface = topography(cell, POINTS, |s, _| WAVE.amplitude * (TAU * s).cos())?;
    let mut steps = Steps::new(surface, &half_space, POINTS)?;
    let mut data = Data::new("loads", &["fraction", "peak", "peak_exact", "width", "width_exact", "pressure_error"]);
    let mut curves = Vec::new();
    for fraction in FRACTIONS {
        let (step, found) = steps.solve(Load::MeanPressure(fraction * WAVE.complete()))?;
        let across = |i: usize| i as f64 / POINTS[0] as f64;
        let profile: Vec<[f64; 2]> =
            (0..POINTS[0]).map(|i| [across(i), step.pressure()[[i, 0]] / WAVE.complete()]).collect();
        let exact = |x: f64| WAVE.pressure(fraction, x) / WAVE.complete();
        // The edge, where the slope is infinite, lies between two samples.
        let edge = 0.5 * WAVE.contact_fraction(fraction);
        let away = |x: f64| (x.min(1.0 - x) - edge).abs() > 0.005;
        let errors = profile.iter().filter(|[x, _]| away(*x)).map(|&[x, p]| (p - exact(x)).abs());
        data.rows.push(vec![
            fraction,
            found.max_pressure / WAVE.complete(),
            WAVE.peak(fraction) / WAVE.complete(),
            fraction_in_contact(&found)?,
            WAVE.contact_fraction(fraction),
            errors.fold(0.0, f64::max),
        ]);
        if let Some(index) = DRAWN.iter().position(|&drawn| drawn == fraction) {
            let label = format!("p̄/p* = {fraction}");
            let fine = linear(-0.5, 0.5, 801).into_iter().map(|x| [x, exact(x)]);
            curves.push(curve(if index == 0 { "Westergaard" } else { "" }, Style::Line, 0, fine));
            let centred = |[x, p]: [f64; 2]| [if x >= 0.5 { x - 1.0 } else { x }, p];
            let sparse = profile.into_iter().step_by(48).map(centred);
            curves.push(curve(label, Style::Markers, index + 1, sparse));
        }
    }
    let pairs = |found: &str, exact: &str| data.column(found).into_iter().zip(data.column(exact)).collect::<Vec<_>>();
    let mut checks = vec![
        Check::worst("peak pressure over p*, 7 loads", pairs("peak", "peak_exact"), Tolerance::Relative(1e-4)),
        Check::worst("width of contact over λ, 7 loads", pairs("width", "width_exact"), Tolerance::Absolute(1e-3)),
        Check::worst(
            "pressure over p* away from the edge, largest error, 7 loads",
            data.column("pressure_error").into_iter().map(|error| (error, 0.0)),
            Tolerance::Absolute(1e-3),
        ),
    ];
    // Wavevector (1, 1) · 2π on the unit square: wavelength 1/√2, oblique to both grid directions.
    let oblique = Wave { wavelength: 0.5f64.sqrt(), ..WAVE };
    let surface = topography(Cell::square(1.0)?, [256; 2], |s, t| oblique.amplitude * (TAU * (s + t)).cos())?;
    let found = Steps::new(surface, &half_space, [256; 2])?.loaded(0.5 * oblique.complete())?;
    let peak = found.max_pressure / oblique.complete();
    checks.push(Check::relative("oblique to the grid: peak pressure over p*", peak, 2f64.sqrt(), 1e-4));
    checks.push(Check::absolute(
        "oblique to the grid: width of contact over λ",
        fraction_in_contact(&found)?,
        0.5,
        1e-3,
    ));
    let chart = Chart {
        title: String::new(),
        x: Axis::linear("distance from the crest x/λ"),
        y: Axis::linear("pressure p/p*"),
        curves,
    };
    let figure = draw::figure(vec![chart], "Pressure across a wave; 2048 samples a wavelength, one in 48 drawn.");
    Ok(Outcome { checks, figures: vec![("figure", figure)], data: vec![data], ..Outcome::default() })
}
