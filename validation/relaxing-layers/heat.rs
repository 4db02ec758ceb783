//! Frictional heat below a ball and a pin on a coat.

use super::setup::{HERTZ, POISSON, Slide};
use super::statement::Statement;
use crate::{Check, Data, Outcome, StudyError};
use percoat_core::body::{Conduction, HalfSpace, Interface, Layer, Material};
use percoat_core::friction::Friction;
use percoat_core::heating::Heating;
use percoat_core::load::Load;
use percoat_core::problem::Problem;
use percoat_core::spectral::{Settings, Solver};
use percoat_core::steady_motion::SteadyMotion;

/// Exponents of the profiles: a ball, and a pin with a flat end.
const SLIDERS: [(&str, f64); 2] = [("a ball", 2.0), ("a pin", 16.0)];
/// Half of the velocity times a₀ over the diffusivity of the body.
const PECLET: f64 = 1.0;
/// The temperatures in contact differ by a tenth of their mean at least.
const UNEVEN: f64 = 0.1;

pub fn add(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let mut data = Data::new("temperatures", &["exponent", "least", "mean", "largest"]);
    let mut statement = Statement::new("frictional heating is uneven in the contact");
    for (name, exponent) in SLIDERS {
        let [least, mean, largest] = temperatures(exponent)?;
        data.rows.push(vec![exponent, least, mean, largest]);
        let what = format!("{name}, largest less least temperature in contact, over their mean");
        statement = statement.says(Check::at_least(what, (largest - least) / mean, UNEVEN));
    }
    statement.judge(outcome, quick);
    outcome.data.push(data);
    Ok(())
}

/// Least, mean and largest temperature where the bodies touch.
fn temperatures(exponent: f64) -> Result<[f64; 3], StudyError> {
    let slide = Slide { exponent, ..Slide::square(8.0, 128, 0.0) };
    let conducting = |shear: f64, conductivity: f64| -> Result<Material, StudyError> {
        let conduction = Conduction::new(conductivity, conductivity, 0.0)?;
        Ok(Material::from_shear(shear, POISSON)?.with_conduction(Some(conduction)))
    };
    let coat = Layer::new(conducting(2.0, 0.2)?, 0.1 * HERTZ, Interface::Bonded)?;
    let body = HalfSpace::new(vec![coat], conducting(1.0, 1.0)?);
    let friction = Friction::new(0.2, [1.0, 0.0])?.uncoupled();
    let motion = SteadyMotion::new(2.0 * PECLET / HERTZ)?;
    let problem =
        Problem::new(slide.asperities()?, body).sliding(friction)?.moving(motion)?.heated(Heating::default())?;
    let mean = slide.load / (slide.sides[0] * slide.sides[1]);
    let step = Solver::new(problem, slide.points, Settings::default())?.solve(Load::MeanPressure(mean));
    let heat = step.finest().heat().ok_or("no heat")?;
    let touching = heat.friction.iter().zip(&heat.body).filter(|(flux, _)| **flux > 0.0).map(|(_, t)| *t);
    let (count, sum, least, largest) = touching.fold((0.0, 0.0, f64::INFINITY, f64::NEG_INFINITY), |all, t| {
        (all.0 + 1.0, all.1 + t, f64::min(all.2, t), f64::max(all.3, t))
    });
    Ok([least, sum / count, largest])
}
