//! A rigid wave that slides, coupled: its closed form ([`crate::exact::SlidingWave`]).

use super::draw::{self, curve, linear};
use super::steps::{Steps, topography};
use super::{Check, Data, Outcome, Study, StudyError, Tolerance};
use crate::exact::SlidingWave;
use percoat_app::picture::{Axis, Chart, Style};
use percoat_core::body::{HalfSpace, Material, MeanStress};
use percoat_core::friction::Friction;
use percoat_core::lattice::Cell;
use percoat_core::load::Load;
use percoat_core::problem::Problem;
use percoat_core::spectral::{Settings, Solver};
use percoat_core::stress::StressField;
use std::f64::consts::{PI, TAU};

pub const STUDY: Study = Study {
    name: "sliding-wave",
    title: "A sliding wave, coupled: contact, pressure and trailing edge",
    files: &["figure.png", "grids.data.csv", "loads.data.csv"],
    run,
    quick: None,
};

const AMPLITUDE: f64 = 0.01;
const POISSON: f64 = 0.3;
/// β = (1−2ν)/(2(1−ν)).
const BETA: f64 = (1.0 - 2.0 * POISSON) / (2.0 * (1.0 - POISSON));
/// f = μβ: μ = 0.35 and 1.05; and 4.2, beyond what the traction follows.
const COUPLINGS: [f64; 3] = [0.1, 0.3, 1.2];
/// p̄/p*.
const FRACTIONS: [f64; 3] = [0.1, 0.5, 0.75];
const POINTS: usize = 2048;
/// Largest error of an edge, samples.
const EDGE: f64 = 1.5;
/// Grids of the order of convergence, and the wave it is measured on.
const GRIDS: [usize; 5] = [256, 512, 1024, 2048, 4096];
const ORDER: (f64, f64) = (0.3, 0.5);

/// Results on one grid.
struct Found {
    /// p/p* at the samples, from x = −λ/2 on.
    profile: Vec<[f64; 2]>,
    /// Largest p/p* of the samples, and its x/λ.
    peak: [f64; 2],
    /// How far contact reaches behind and before the crest, over λ.
    reach: [f64; 2],
    /// Largest tension on the surface over p*, its mean left out, and its stated error.
    tension: [f64; 2],
    outer: usize,
}

fn solve(coupling: f64, fraction: f64, points: usize) -> Result<Found, StudyError> {
    let material = Material::from_young(1.0, POISSON)?;
    let unit = PI * material.contact_modulus() * AMPLITUDE;
    // Samples are as dense across as along.
    let cell = Cell::new([1.0, 0.0], [0.0, 4.0 / points as f64])?;
    let surface = topography(cell, [points, 4], |s, _| AMPLITUDE * (TAU * s).cos())?;
    let problem =
        Problem::new(surface, HalfSpace::new(vec![], material)).sliding(Friction::new(coupling / BETA, [1.0, 0.0])?)?;
    let mut steps = Steps { solver: Solver::new(problem, [points, 4], Settings::default())? };
    let step = steps.step(Load::MeanPressure(fraction * unit))?;
    let half = (points / 2) as i64;
    let at = |i: i64| step.pressure()[[i.rem_euclid(points as i64) as usize, 0]] / unit;
    let profile: Vec<[f64; 2]> = (-half..half).map(|i| [i as f64 / points as f64, at(i)]).collect();
    let peak = profile.iter().fold([0.0, 0.0], |best, &[x, p]| if p > best[0] { [p, x] } else { best });
    let count = |side: fn(f64) -> bool| {
        let samples = profile.iter().filter(|[x, p]| *p > 0.0 && side(*x)).count();
        // The sample at the crest counts half on each side.
        (samples as f64 + 0.5) / points as f64
    };
    let reach = [count(|x| x < 0.0), count(|x| x > 0.0)];
    let field = StressField::new(step.finest(), MeanStress::Confined);
    let mean = fraction * POISSON / (1.0 - POISSON);
    let tension = field
        .crest()
        .map_or([0.0; 2], |crest| [crest.peak.value / unit + mean, crest.error(None) * crest.scale / unit]);
    Ok(Found { profile, peak, reach, tension, outer: step.report.outer })
}

fn run() -> Result<Outcome, StudyError> {
    let columns = [
        "coupling",
        "fraction",
        "peak",
        "peak_exact",
        "peak_bound",
        "place",
        "place_exact",
        "behind",
        "behind_exact",
        "before",
        "before_exact",
        "tension",
        "tension_exact",
        "tension_stated",
        "outer",
    ];
    let mut loads = Data::new("loads", &columns);
    let mut curves = Vec::new();
    for (index, coupling) in COUPLINGS.into_iter().enumerate() {
        for fraction in FRACTIONS {
            if fraction >= coupling.atan().cos() {
                continue;
            }
            let (found, exact) = (solve(coupling, fraction, POINTS)?, SlidingWave::new(coupling, fraction));
            let [peak, place] = exact.peak();
            // An edge that is a sample and a half off takes as much load with it as lies there, p d/(1 + ½ + η); both may be,
            // and before the contact, where the pressure ends more gently, there lies less.
            let aside = EDGE / POINTS as f64;
            let behind = exact.pressure(PI * aside - exact.trailing);
            let bound = 2.0 * behind * aside / ((1.5 + exact.exponent()) * fraction);
            loads.rows.push(vec![
                coupling,
                fraction,
                found.peak[0],
                peak,
                bound,
                found.peak[1],
                place / PI,
                found.reach[0],
                exact.trailing / PI,
                found.reach[1],
                exact.leading / PI,
                found.tension[0],
                exact.trailing_tension(coupling / BETA),
                found.tension[1],
                found.outer as f64,
            ]);
            if fraction == 0.5 {
                let reach = (exact.trailing / PI, exact.leading / PI);
                let fine = linear(-reach.0, reach.1, 401).into_iter().map(|x| [x, exact.pressure(PI * x)]);
                curves.push(curve(if index == 0 { "closed form" } else { "" }, Style::Line, 0, fine));
                let sparse = found.profile.into_iter().step_by(32).filter(|[x, _]| x.abs() < 0.35);
                curves.push(curve(format!("f = {coupling}"), Style::Markers, index + 1, sparse));
            }
        }
    }
    let (coupling, fraction) = ORDER;
    let exact = SlidingWave::new(coupling, fraction);
    let mut grids = Data::new("grids", &["points", "error"]);
    for points in GRIDS {
        let found = solve(coupling, fraction, points)?;
        // Over the whole contact but for its edges, in the mean.
        let away = |x: f64| -0.9 * exact.trailing < PI * x && PI * x < 0.9 * exact.leading;
        let errors: Vec<f64> =
            found.profile.iter().filter(|[x, _]| away(*x)).map(|&[x, p]| (p - exact.pressure(PI * x)).abs()).collect();
        grids.rows.push(vec![points as f64, errors.iter().sum::<f64>() / errors.len() as f64]);
    }
    let errors = grids.column("error");
    let order = (errors[0] / errors[errors.len() - 1]).log2() / (GRIDS.len() - 1) as f64;
    let column = |name: &str| loads.column(name);
    let over = |found: &str, exact: &str, bound: &str| {
        let all = column(found).into_iter().zip(column(exact)).zip(column(bound));
        all.map(|((found, exact), bound)| ((found / exact - 1.0).abs() / bound, 0.0)).collect::<Vec<_>>()
    };
    let pairs = |found: &str, exact: &str| column(found).into_iter().zip(column(exact)).collect::<Vec<_>>();
    let stated = column("tension").into_iter().zip(column("tension_exact")).zip(column("tension_stated"));
    let stated: Vec<(f64, f64)> =
        stated.map(|((found, exact), stated)| ((found - exact).abs() / stated, 0.0)).collect();
    let checks = vec![
        Check::worst(
            "largest pressure, error over that of an edge off by 1.5 samples",
            over("peak", "peak_exact", "peak_bound"),
            Tolerance::Absolute(1.0),
        ),
        // The peak is flat: two samples.
        Check::worst("its place over λ", pairs("place", "place_exact"), Tolerance::Absolute(8.0 / POINTS as f64)),
        Check::worst(
            "contact behind the crest over λ",
            pairs("behind", "behind_exact"),
            Tolerance::Absolute(EDGE / POINTS as f64),
        ),
        Check::worst(
            "contact before the crest over λ",
            pairs("before", "before_exact"),
            Tolerance::Absolute(EDGE / POINTS as f64),
        ),
        Check::worst("tension at the trailing edge, error over the stated one", stated, Tolerance::Absolute(1.0)),
        Check::new(
            "order of convergence of the pressure, f = 0.3",
            order,
            1.5 + exact.exponent(),
            Tolerance::Order(0.25),
        ),
    ];
    let chart = Chart {
        title: String::new(),
        x: Axis::linear("distance from the crest x/λ"),
        y: Axis::linear("pressure p/p*"),
        curves,
    };
    let words = "Pressure under a sliding wave at p̄ = p*/2, sliding to the right; 2048 samples, one in 32 drawn.";
    let figure = draw::figure(vec![chart], words);
    Ok(Outcome { checks, figures: vec![("figure", figure)], data: vec![loads, grids], ..Outcome::default() })
}
