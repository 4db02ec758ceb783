//! A sliding that is turned with the lattice turns everything.

use super::super::steps::fraction_in_contact;
use super::super::{Data, StudyError};
use ndarray::Array2;
use percoat_core::body::{HalfSpace, Interface, Layer, Material, MeanStress};
use percoat_core::counterbody::{Indenters, Level, Shape};
use percoat_core::friction::Friction;
use percoat_core::lattice::Lattice;
use percoat_core::load::Load;
use percoat_core::problem::Problem;
use percoat_core::reading::{Reading, StressReading};
use percoat_core::spectral::{Settings, Solver};
use percoat_core::stress::StressFields;

const POINTS: usize = 60;

struct Found {
    pressure: Array2<f64>,
    /// Penetration, contact fraction, largest pressure.
    scalars: [f64; 3],
    /// Largest τ₁, tension and von Mises of all materials and faces, tension and shear of the interface.
    stresses: Vec<f64>,
}

fn solve(lattice: Lattice, degrees: f64) -> Result<Found, StudyError> {
    let sphere = Level::new(Shape::Paraboloid { radius: 0.8 }, 0.0)?;
    let substrate = Material::from_young(1.0, 0.3)?;
    let coating = Layer::new(Material::from_shear(3.0 * substrate.shear(), 0.2)?, 0.15, Interface::Bonded)?;
    let (sine, cosine) = degrees.to_radians().sin_cos();
    let problem = Problem::new(Indenters::new(lattice, vec![sphere])?, HalfSpace::new(vec![coating], substrate))
        .sliding(Friction::new(0.6, [cosine, sine])?)?;
    // Until rounding is all that is left.
    let settings = Settings { tolerance: 1e-13, ..Settings::default() };
    let step = Solver::new(problem, [POINTS; 2], settings)?.solve(Load::MeanPressure(0.04));
    if !step.report.stop.solved() {
        return Err(step.report.to_string().into());
    }
    let reading = Reading::of(step.finest());
    let stress = StressReading::of(&step, &reading, &StressFields::new(step.finest(), MeanStress::Confined));
    let all = stress.materials.iter().chain(&stress.faces);
    let mut stresses: Vec<f64> =
        all.flat_map(|face| [face.tau1, face.tension, face.mises].map(|peak| peak.value)).collect();
    stresses.extend(stress.interfaces.iter().flat_map(|face| [face.normal.value, face.shear.value]));
    Ok(Found {
        pressure: step.pressure().to_owned(),
        scalars: [reading.penetration, fraction_in_contact(&reading)?, reading.max_pressure],
        stresses,
    })
}

/// Columns: directions of the lattice, by how much the sliding is turned, and what differs: the pressure over its largest, the
/// others relatively.
pub fn table() -> Result<Data, StudyError> {
    let mut data = Data::new("turned", &["fold", "angle", "pressure", "penetration", "fraction", "peak", "stresses"]);
    let n = POINTS;
    for (fold, lattice, turns) in [(6.0, Lattice::hexagonal(1.0, 1)?, 2), (4.0, Lattice::square(1.0, 1)?, 1)] {
        let here = solve(lattice.clone(), 0.0)?;
        let largest = here.pressure.iter().fold(0.0, |most: f64, &p| most.max(p));
        let mut expected = here.pressure.clone();
        for turn in 1..=turns {
            let angle = 360.0 / fold * f64::from(turn);
            let there = solve(lattice.clone(), angle)?;
            // a₁ → a₁ + … : 60° takes s₁a₁ + s₂a₂ to −s₂a₁ + (s₁+s₂)a₂, 90° to −s₂a₁ + s₁a₂.
            let before = expected;
            let source = |i: usize, j: usize| if fold == 6.0 { [(i + j) % n, (n - i) % n] } else { [j, (n - i) % n] };
            expected = Array2::from_shape_fn((n, n), |(i, j)| before[source(i, j)]);
            let differ = |a: &[f64], b: &[f64]| {
                a.iter().zip(b).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs() / b.abs().max(f64::MIN_POSITIVE)))
            };
            let pressure = there.pressure.iter().zip(&expected).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
            let scalar = |k: usize| differ(&there.scalars[k..k + 1], &here.scalars[k..k + 1]);
            data.rows.push(vec![
                fold,
                angle,
                pressure / largest,
                scalar(0),
                scalar(1),
                scalar(2),
                differ(&there.stresses, &here.stresses),
            ]);
        }
    }
    Ok(data)
}
