//! Complete contact on a coating under coupled friction: three waves at once against the closed form of each.
//!
//! Every component stands for itself, p̂ = û/[(1−ν₁)T − ½iμ cosθ S] · G₁k, with the T and S of `coupling.csv` and θ between the
//! wavevector and the sliding.

use super::super::steps::{Steps, topography};
use super::super::{Data, StudyError};
use percoat_core::body::{HalfSpace, Interface, Layer, Material};
use percoat_core::friction::Friction;
use percoat_core::lattice::Cell;
use percoat_core::load::Load;
use percoat_core::problem::Problem;
use percoat_core::spectral::{Settings, Solver};
use std::f64::consts::TAU;

/// Waves in a square cell of the side 20πh, so that kh = 0.5, 1, 2.
const WAVES: [[f64; 2]; 3] = [[3.0, 4.0], [-8.0, 6.0], [20.0, 0.0]];
const POINTS: usize = 64;
const COEFFICIENT: f64 = 1.0;
const AMPLITUDE: f64 = 1e-3;
/// Tolerance of the solver.
pub const TOLERANCE: f64 = 1e-12;
/// Directions along the first wave and across the second, across the first and along the second, and elsewhere,
/// degrees.
pub fn directions() -> Vec<f64> {
    let along = 4f64.atan2(3.0).to_degrees();
    let mut all: Vec<f64> = (0..12).map(|k| 15.0 * f64::from(k)).collect();
    all.extend([33.0, along, along + 90.0]);
    all
}

/// One bonded layer of the thickness 1 and G₁ = χ on G₂ = 1.
fn coated([ratio, nu1, nu2]: [f64; 3]) -> Result<HalfSpace, StudyError> {
    let layer = Layer::new(Material::from_shear(ratio, nu1)?, 1.0, Interface::Bonded)?;
    Ok(HalfSpace::new(vec![layer], Material::from_shear(1.0, nu2)?))
}

/// Columns: stack, kh, direction and angle to it, then amplitude over that without friction and phase (degrees) found and
/// exact, what the components err by and what is left beside them, over the amplitude.
pub fn table() -> Result<Data, StudyError> {
    let coupling = Data::parse("coupling", include_str!("coupling.csv"))?;
    let columns = [
        "shear_ratio",
        "poisson",
        "x",
        "direction",
        "angle",
        "amplitude",
        "amplitude_exact",
        "phase",
        "phase_exact",
        "error",
    ];
    let mut data = Data::new("complete", &columns);
    let side = 10.0 * TAU;
    let at = |[s, t]: [f64; 2], [m1, m2]: [f64; 2]| TAU * (m1 * s + m2 * t);
    for stack in coupling.rows.chunks(WAVES.len()) {
        let parameters = [stack[0][0], stack[0][1], stack[0][2]];
        let half_space = coated(parameters)?;
        // More than all amplitudes without friction, which makes them smaller.
        let amplitudes = stack.iter().map(|row| parameters[0] * row[3] * AMPLITUDE / ((1.0 - row[1]) * row[4]));
        let load = Load::MeanPressure(1.5 * amplitudes.sum::<f64>());
        for direction in directions() {
            let (sine, cosine) = direction.to_radians().sin_cos();
            let hills = |s: f64, t: f64| AMPLITUDE * WAVES.iter().map(|&wave| at([s, t], wave).cos()).sum::<f64>();
            let surface = topography(Cell::square(side)?, [POINTS; 2], hills)?;
            let friction = Friction::new(COEFFICIENT, [cosine, sine])?;
            let problem = Problem::new(surface, half_space.clone()).sliding(friction)?;
            let settings = Settings { tolerance: TOLERANCE, ..Settings::default() };
            let mut steps = Steps { solver: Solver::new(problem, [POINTS; 2], settings)? };
            let step = steps.step(load)?;
            if step.pressure().iter().any(|&p| p <= 0.0) {
                return Err("contact is not complete".into());
            }
            for (wave, row) in WAVES.into_iter().zip(stack) {
                let mut found = [0.0; 2];
                for ((i, j), p) in step.pressure().indexed_iter() {
                    let phase = at([i, j].map(|k| k as f64 / POINTS as f64), wave);
                    let weight = 2.0 * p / (POINTS * POINTS) as f64;
                    found = [found[0] + weight * phase.cos(), found[1] - weight * phase.sin()];
                }
                let (x, normal, shear) = (row[3], 2.0 * (1.0 - row[1]) * row[4], row[5]);
                let aligned = (cosine * wave[0] + sine * wave[1]) / wave[0].hypot(wave[1]);
                // 2G₁k û/(2(1−ν₁)T − iμ cosθ S)
                let skew = COEFFICIENT * aligned * shear;
                let scale = 2.0 * parameters[0] * x * AMPLITUDE / (normal * normal + skew * skew);
                let exact = [scale * normal, scale * skew];
                let still = 2.0 * parameters[0] * x * AMPLITUDE / normal;
                let polar = |[re, im]: [f64; 2]| [re.hypot(im) / still, im.atan2(re).to_degrees()];
                let error = (found[0] - exact[0]).hypot(found[1] - exact[1]) / exact[0].hypot(exact[1]);
                let ([amplitude, phase], [amplitude_exact, phase_exact]) = (polar(found), polar(exact));
                data.rows.push(vec![
                    parameters[0],
                    parameters[1],
                    x,
                    direction,
                    aligned.acos().to_degrees(),
                    amplitude,
                    amplitude_exact,
                    phase,
                    phase_exact,
                    error,
                ]);
            }
        }
    }
    Ok(data)
}
