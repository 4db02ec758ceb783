//! Wear in equal implicit steps, which are of first order in their length, and twice as many extrapolated. Steps of a [`WearPath`],
//! which are of second order, are not used here.
//!
//! [`WearPath`]: percoat_core::run::WearPath

use crate::StudyError;
use crate::steps::Steps;
use ndarray::Array2;
use percoat_core::body::Side;
use percoat_core::load::Load;
use percoat_core::spectral::{Step, Wear, Worn};

/// Error of [`volume`] by rounding.
pub const VOLUME: f64 = 1e-12;

/// A contact at the end of a part of a path.
pub struct Place {
    /// Approach from the first touch of the unworn surfaces.
    pub approach: f64,
    pub pressure: Array2<f64>,
    /// Depths worn off body and counterbody.
    pub worn: [Array2<f64>; 2],
    /// The last step, or none of extrapolated places.
    pub step: Option<Step>,
}

impl Place {
    /// The contact of a step of a solver that has worn.
    pub fn of(steps: &Steps, step: Step) -> Result<Self, StudyError> {
        let worn = steps.solver.worn().ok_or("nothing has worn")?;
        let depth = |side: Side| worn.depth(side).to_owned();
        Ok(Self {
            approach: step.penetration() + worn.recession(),
            pressure: step.pressure().to_owned(),
            worn: [depth(Side::Body), depth(Side::Counterbody)],
            step: Some(step),
        })
    }

    /// Place without the error of first order of the steps, of which it has twice as many as the `coarser`.
    fn extrapolated(self, coarser: Self) -> Self {
        let [body, counterbody] = self.worn;
        let [coarser_body, coarser_counterbody] = coarser.worn;
        Self {
            approach: 2.0 * self.approach - coarser.approach,
            pressure: 2.0 * self.pressure - coarser.pressure,
            worn: [2.0 * body - coarser_body, 2.0 * counterbody - coarser_counterbody],
            step: self.step,
        }
    }
}

/// The worst of the volumes worn off body and counterbody against k s P, relative.
pub fn volume(worn: &Worn, wear: &Wear, force: f64) -> f64 {
    let of = |side: Side| {
        let exact = wear.coefficient(side) * worn.distance() * force;
        if exact > 0.0 { (worn.volume(side) / exact - 1.0).abs() } else { worn.volume(side).abs() }
    };
    of(Side::Body).max(of(Side::Counterbody))
}

/// Places at the ends of the parts of a path, each with the distance slid by its end and a number of equal steps; and the worst
/// [`volume`] under a force.
fn follow(
    mut steps: Steps,
    load: Load,
    wear: &Wear,
    parts: &[(f64, usize)],
    force: f64,
) -> Result<(Vec<Place>, f64), StudyError> {
    let (mut slid, mut places, mut worst) = (0.0, Vec::new(), 0.0f64);
    for &(end, count) in parts {
        let mut last = None;
        for _ in 0..count {
            let step = steps.solver.wear(load, wear, (end - slid) / count as f64)?;
            if !step.report.stop.solved() {
                return Err(format!("{}", step.report).into());
            }
            last = Some(step);
        }
        slid = end;
        worst = worst.max(volume(steps.solver.worn().ok_or("nothing has worn")?, wear, force));
        places.push(Place::of(&steps, last.ok_or("no step")?)?);
    }
    Ok((places, worst))
}

/// Places of a path in the steps of its parts and in twice as many, extrapolated; and the worst [`volume`].
pub fn extrapolated(
    new: impl Fn() -> Result<Steps, StudyError>,
    load: Load,
    wear: &Wear,
    parts: &[(f64, usize)],
    force: f64,
) -> Result<(Vec<Place>, f64), StudyError> {
    let twice: Vec<(f64, usize)> = parts.iter().map(|&(end, count)| (end, 2 * count)).collect();
    let (coarse, one) = follow(new()?, load, wear, parts, force)?;
    let (fine, two) = follow(new()?, load, wear, &twice, force)?;
    let places = fine.into_iter().zip(coarse).map(|(fine, coarse)| fine.extrapolated(coarse)).collect();
    Ok((places, one.max(two)))
}

/// Largest value of a field.
pub fn largest(field: &Array2<f64>) -> f64 {
    field.iter().copied().fold(f64::NEG_INFINITY, f64::max)
}
