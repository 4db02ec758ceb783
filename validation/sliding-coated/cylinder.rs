//! Small loads: under a wave that slides on a half-space, what is in contact is a cylinder of the radius R = λ²/(4π²Δ).
//!
//! p ~ (x+b)^{½+η}(a−x)^{½−η}, 2c = a + b, a/b = (1+2η)/(1−2η), P = πE*c²(1−4η²)/(4R); the centre of pressure is 8ηc/3,
//! the variance c²(9/4 − η²)/9. The mean of the traction tilts nothing in a periodic contact: the slope 2fp̄/E* that it
//! would give stays, and moves the contact forward by 2fRp̄/E*, which falls against c as the root of the load. What is
//! left of the wave falls as the load.

use super::super::steps::{Steps, topography};
use super::super::{Data, StudyError};
use percoat_core::body::{HalfSpace, Material};
use percoat_core::friction::Friction;
use percoat_core::lattice::Cell;
use percoat_core::load::Load;
use percoat_core::problem::Problem;
use percoat_core::spectral::{Settings, Solver};
use std::f64::consts::{PI, TAU};

const AMPLITUDE: f64 = 0.01;
const POISSON: f64 = 0.3;
const BETA: f64 = (1.0 - 2.0 * POISSON) / (2.0 * (1.0 - POISSON));
/// f = μβ.
pub const COUPLINGS: [f64; 2] = [0.1, 0.3];
pub const POINTS: usize = 8192;
/// p̄/p*.
pub const FRACTIONS: [f64; 4] = [0.08, 0.04, 0.02, 0.01];

/// Columns: f, p̄/p*, the edges behind and before over λ found and exact, centre and width over c found and exact.
pub fn table() -> Result<Data, StudyError> {
    let columns = [
        "coupling",
        "fraction",
        "behind",
        "behind_exact",
        "before",
        "before_exact",
        "centre",
        "centre_exact",
        "width",
        "width_exact",
    ];
    let mut data = Data::new("cylinder", &columns);
    let material = Material::from_young(1.0, POISSON)?;
    let modulus = material.contact_modulus();
    let radius = 1.0 / (TAU * TAU * AMPLITUDE);
    for coupling in COUPLINGS {
        let eta = -coupling.atan() / PI;
        let surface = topography(Cell::new([1.0, 0.0], [0.0, 0.01])?, [POINTS, 4], |s, _| AMPLITUDE * (TAU * s).cos())?;
        let friction = Friction::new(coupling / BETA, [1.0, 0.0])?;
        let problem = Problem::new(surface, HalfSpace::new(vec![], material)).sliding(friction)?;
        let mut steps = Steps { solver: Solver::new(problem, [POINTS, 4], Settings::default())? };
        for fraction in FRACTIONS {
            let load = fraction * PI * modulus * AMPLITUDE;
            let step = steps.step(Load::MeanPressure(load))?;
            let c = (4.0 * radius * load / (PI * modulus * (1.0 - 4.0 * eta * eta))).sqrt();
            let shift = 2.0 * coupling * radius * load / modulus;
            let place = |i: usize| (i as f64 / POINTS as f64 + 0.5).fract() - 0.5;
            let samples: Vec<[f64; 2]> = step
                .pressure()
                .column(0)
                .iter()
                .enumerate()
                .map(|(i, &p)| [place(i), p])
                .filter(|s| s[1] > 0.0)
                .collect();
            let sum = |of: &dyn Fn(f64) -> f64| samples.iter().map(|&[x, p]| p * of(x)).sum::<f64>();
            let mean = sum(&|x| x) / sum(&|_| 1.0);
            let variance = sum(&|x| (x - mean).powi(2)) / sum(&|_| 1.0);
            let half = 0.5 / POINTS as f64;
            let behind = half - samples.iter().fold(0.0, |least: f64, &[x, _]| least.min(x));
            let before = half + samples.iter().fold(0.0, |most: f64, &[x, _]| most.max(x));
            data.rows.push(vec![
                coupling,
                fraction,
                behind,
                c * (1.0 - 2.0 * eta) - shift,
                before,
                c * (1.0 + 2.0 * eta) + shift,
                mean / c,
                8.0 * eta / 3.0 + shift / c,
                variance.sqrt() / c,
                (2.25 - eta * eta).sqrt() / 3.0,
            ]);
        }
    }
    Ok(data)
}
