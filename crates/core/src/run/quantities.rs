//! The quantities of a load step, whichever of its records has them.

use super::StepRecord;
use super::record::STEP;
use crate::measured::Measured;
use crate::quantity::{Named, Quantity};
use crate::reading::{
    ADHESION, AdhesionReading, CREEP, CreepReading, HYSTERESIS, HysteresisReading, LEVEL, LIFE, Life, PLASTIC,
    PlasticReading, READING, ROUGH, Reading, RoughReading, SLIP, SlipReading, TEMPERATURE, TemperatureReading,
    UTILISATION,
};
use crate::stress::maxima::{CARRIED, EXTREMES, Extremes};

/// A record of a load step that has one of a kind.
pub trait Part<R> {
    /// Keys that lead to the record in files, each with a dot behind it; empty where its keys are those of the step.
    const PATH: &'static str;

    /// The record; `None` where the step has none.
    fn part(&self) -> Option<&R>;
}

impl Part<Self> for StepRecord {
    const PATH: &'static str = "";

    fn part(&self) -> Option<&Self> {
        Some(self)
    }
}

impl Part<Reading> for StepRecord {
    const PATH: &'static str = "";

    fn part(&self) -> Option<&Reading> {
        Some(&self.reading)
    }
}

impl Part<RoughReading> for StepRecord {
    const PATH: &'static str = "rough.";

    fn part(&self) -> Option<&RoughReading> {
        self.rough.as_ref()
    }
}

impl Part<PlasticReading> for StepRecord {
    const PATH: &'static str = "plastic.";

    fn part(&self) -> Option<&PlasticReading> {
        self.plastic.as_ref()
    }
}

impl Part<SlipReading> for StepRecord {
    const PATH: &'static str = "tangential.";

    fn part(&self) -> Option<&SlipReading> {
        self.tangential.as_ref()
    }
}

impl Part<AdhesionReading> for StepRecord {
    const PATH: &'static str = "adhesion.";

    fn part(&self) -> Option<&AdhesionReading> {
        self.adhesion.as_ref()
    }
}

impl Part<HysteresisReading> for StepRecord {
    const PATH: &'static str = "hysteresis.";

    fn part(&self) -> Option<&HysteresisReading> {
        self.hysteresis.as_ref()
    }
}

impl Part<TemperatureReading> for StepRecord {
    const PATH: &'static str = "temperature.";

    fn part(&self) -> Option<&TemperatureReading> {
        self.temperature.as_ref()
    }
}

impl Part<CreepReading> for StepRecord {
    const PATH: &'static str = "creep.";

    fn part(&self) -> Option<&CreepReading> {
        self.creep.as_ref()
    }
}

impl Part<Extremes> for StepRecord {
    const PATH: &'static str = "stress.";

    fn part(&self) -> Option<&Extremes> {
        self.stress.as_ref().map(|stress| &stress.overall)
    }
}

impl Part<Life> for StepRecord {
    const PATH: &'static str = "fatigue.first.";

    fn part(&self) -> Option<&Life> {
        self.fatigue.as_ref().map(|fatigue| &fatigue.first)
    }
}

/// A quantity of a load step.
pub trait OfStep: Sync {
    /// Names and kind.
    fn named(&self) -> &Named;

    /// Keys that lead to the record of the quantity in files, each with a dot behind it.
    fn path(&self) -> &'static str;

    /// Value and error in a step; `None` where the quantity does not apply, infinite under a tip.
    fn of_step(&self, step: &StepRecord) -> Option<Measured>;
}

impl<R> OfStep for Quantity<R>
where
    StepRecord: Part<R>,
{
    fn named(&self) -> &Named {
        &self.named
    }

    fn path(&self) -> &'static str {
        <StepRecord as Part<R>>::PATH
    }

    fn of_step(&self, step: &StepRecord) -> Option<Measured> {
        self.of(step.part()?)
    }
}

/// All quantities of a load step, in the order of its record.
pub fn of_step() -> Vec<&'static dyn OfStep> {
    fn each<R>(all: Vec<&'static Quantity<R>>) -> impl Iterator<Item = &'static dyn OfStep>
    where
        StepRecord: Part<R>,
    {
        all.into_iter().map(|quantity| quantity as &dyn OfStep)
    }
    each(READING.each())
        .chain(each(STEP.each()))
        .chain(each(ROUGH.each()))
        .chain(each(PLASTIC.each()))
        .chain(each(SLIP.each()))
        .chain(each(ADHESION.each()))
        .chain(each(HYSTERESIS.each()))
        .chain(each(TEMPERATURE.each()))
        .chain(each(CREEP.each()))
        .chain(each(EXTREMES.each()))
        .chain(each(LIFE.each()))
        .collect()
}

/// Names of all quantities of a load step and of the records in its lists, each with the keys that lead to its record in files.
pub fn declared() -> Vec<(&'static str, &'static Named)> {
    fn each<R>(
        path: &'static str,
        all: Vec<&'static Quantity<R>>,
    ) -> impl Iterator<Item = (&'static str, &'static Named)> {
        all.into_iter().map(move |quantity| (path, &quantity.named))
    }
    let lists = each("levels.", LEVEL.each())
        .chain(each("stress.materials.", EXTREMES.each()))
        .chain(each("stress.faces.", EXTREMES.each()))
        .chain(each("stress.interfaces.", CARRIED.each()))
        .chain(each("strength.", UTILISATION.each()))
        .chain(each("fatigue.lives.", LIFE.each()));
    of_step().into_iter().map(|quantity| (quantity.path(), quantity.named())).chain(lists).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::adhesion::{Adhesion, AdhesionLaw};
    use crate::body::{Conduction, Durability, Fatigue, HalfSpace, Interface, Layer, Material, Relaxation, Strength};
    use crate::counterbody::{Indenters, Level, Shape, Topography};
    use crate::friction::Friction;
    use crate::heating::Heating;
    use crate::lattice::{Cell, Lattice};
    use crate::load::Load;
    use crate::problem::Problem;
    use crate::run::{Motion, Run, Sampling, StressRequest, Times};
    use crate::spectral::{Rolling, RollingDrive};
    use crate::steady_motion::SteadyMotion;
    use serde::Serialize;
    use serde_json::{Value, json};
    use std::collections::BTreeSet;

    fn body() -> HalfSpace {
        let fatigue = Fatigue::new(0.1, 1e6, 8.0).unwrap();
        let durability = Durability { hardness: Some(0.1), fatigue: Some(fatigue), ..Durability::default() };
        let substrate = Material::from_young(1.0, 0.3).unwrap();
        let coating = Layer::new(Material::from_young(2.0, 0.3).unwrap(), 0.1, Interface::Bonded).unwrap();
        let coating = coating.with_durability(durability, None).unwrap();
        let strength = Strength { yielding: Some(0.5), ..Strength::default() };
        HalfSpace::new(vec![coating], substrate).with_substrate_strength(strength).unwrap()
    }

    /// The last of two steps that press a ball into a window, of two that press waves, of one that rolls, of one that adheres, of one that moves
    /// over a body that relaxes, of one in which that creeps, and of one that heats.
    fn steps() -> [StepRecord; 7] {
        let last = |problem: Problem, loads: [f64; 2]| {
            let mut run = Run::new(problem, loads.map(Load::Force).to_vec(), Sampling::Points([32; 2]));
            run.stress = Some(StressRequest { strain: true, ..StressRequest::default() });
            run.solve(&mut ()).unwrap().steps.pop().unwrap()
        };
        let level = Level::new(Shape::Paraboloid { radius: 1.0 }, 0.0).unwrap();
        let lattice = Lattice::new(Cell::window([1.0; 2]).unwrap(), vec![vec![[0.5; 2]]]).unwrap();
        let ball = Indenters::new(lattice, vec![level]).unwrap();
        let height = |i: usize| 0.02 * (std::f64::consts::TAU * i as f64 / 32.0).cos();
        let heights = ndarray::Array2::from_shape_fn((32, 32), |(i, j)| height(i) + height(j));
        let waves = Topography::new(Cell::square(1.0).unwrap(), heights).unwrap();
        let pressed = last(Problem::new(ball.clone(), body()), [0.005, 0.01]);
        let (adheres, [moves, creeps]) = (adhering(ball.clone()), relaxing());
        [pressed, last(Problem::new(waves, body()), [0.01, 0.02]), rolled(ball), adheres, moves, creeps, heats()]
    }

    /// A step that adheres, held by a grip.
    fn adhering(ball: Indenters) -> StepRecord {
        let adhesion = Adhesion::new(0.001, 0.01, AdhesionLaw::Dugdale).unwrap();
        let problem = Problem::new(ball, HalfSpace::new(vec![], Material::from_young(1.0, 0.3).unwrap()));
        let loads = [0.01, 0.005].map(|position| Load::Grip { position, stiffness: 1.0 }).to_vec();
        let mut run = Run::new(problem.adhering(adhesion).unwrap(), loads, Sampling::Points([48; 2]));
        run.stress = Some(StressRequest::default());
        run.solve(&mut ()).unwrap().steps.pop().unwrap()
    }

    /// A step of a ball that moves over a body that relaxes, and one of a ball into which it creeps.
    fn relaxing() -> [StepRecord; 2] {
        let level = Level::new(Shape::Paraboloid { radius: 1.0 }, 0.0).unwrap();
        let balls = Indenters::new(Lattice::square(1.0, 1).unwrap(), vec![level]).unwrap();
        let relaxation = Relaxation::new(&[9.0], &[1.0]).unwrap();
        let rubber = Material::from_young(1.0, 0.3).unwrap().with_relaxation(Some(relaxation));
        let problem = Problem::new(balls, HalfSpace::new(vec![], rubber));
        let (load, sampling) = (Load::MeanPressure(0.01), Sampling::Points([48; 2]));
        let moving = problem.clone().moving(SteadyMotion::new(0.1).unwrap()).unwrap();
        let creeping = Run { times: Some(Times::new(vec![0.0, 1.0])), ..Run::new(problem, vec![load; 2], sampling) };
        [Run::new(moving, vec![load], sampling), creeping].map(|run| run.solve(&mut ()).unwrap().steps.pop().unwrap())
    }

    /// A step of balls that heat the body by friction.
    fn heats() -> StepRecord {
        let level = Level::new(Shape::Paraboloid { radius: 1.0 }, 0.0).unwrap();
        let balls = Indenters::new(Lattice::square(1.0, 1).unwrap(), vec![level]).unwrap();
        let steel = Material::from_young(1.0, 0.3).unwrap();
        let steel = steel.with_conduction(Some(Conduction::new(1.0, 1.0, 0.1).unwrap()));
        let friction = Friction::new(0.3, [1.0, 0.0]).unwrap().uncoupled();
        let problem = Problem::new(balls, HalfSpace::new(vec![], steel)).sliding(friction).unwrap();
        let problem = problem.moving(SteadyMotion::new(0.1).unwrap()).unwrap().heated(Heating::default()).unwrap();
        let run = Run::new(problem, vec![Load::MeanPressure(0.01)], Sampling::Points([48; 2]));
        run.solve(&mut ()).unwrap().steps.pop().unwrap()
    }

    /// A step that rolls.
    fn rolled(ball: Indenters) -> StepRecord {
        let problem = Problem::new(ball, HalfSpace::new(vec![], Material::from_young(1.0, 0.3).unwrap()));
        let problem = problem.sliding(Friction::new(0.3, [1.0, 0.0]).unwrap().uncoupled()).unwrap();
        let mut run = Run::new(problem, vec![Load::Force(0.01)], Sampling::Points([48; 2]));
        let rolling = Rolling { direction: [1.0, 0.0], distance: 1.0, step: 0.5 };
        run.motions = Some(vec![Motion::Roll(RollingDrive::Part([0.3, 0.0]), rolling)]);
        run.solve(&mut ()).unwrap().steps.pop().unwrap()
    }

    /// The value under keys with a dot between them.
    fn at<'a>(keys: &'a Value, path: &str) -> &'a Value {
        path.split('.').fold(keys, |keys, key| &keys[key])
    }

    /// Asserts that value and error of a quantity stand in JSON under the keys that its declaration names.
    fn check(named: &Named, measured: Measured, keys: &Value, path: &str) {
        let (value, error) = named.keys(path);
        assert_eq!(at(keys, &value), &json!(measured.value), "{named:?}");
        let error = error.map(|error| at(keys, &error));
        assert!(error.is_none_or(|error| *error == json!(measured.error)), "{named:?}: {error:?}");
    }

    /// Asserts that every quantity of a record stands in its JSON under the declared keys.
    fn check_all<R: Serialize>(quantities: &[&Quantity<R>], record: &R) {
        let keys = json!(record);
        for quantity in quantities {
            quantity.of(record).iter().for_each(|measured| check(&quantity.named, *measured, &keys, ""));
        }
    }

    #[test]
    fn every_quantity_stands_in_files_where_it_is_declared() {
        let mut seen = BTreeSet::new();
        for step in steps() {
            assert!(step.converged());
            let keys = json!(step);
            for quantity in of_step() {
                let Some(measured) = quantity.of_step(&step) else { continue };
                check(quantity.named(), measured, &keys, quantity.path());
                seen.insert((quantity.path(), quantity.named().code));
            }
            for level in &step.reading.levels {
                check_all(&LEVEL.each(), level);
            }
            if let Some(stress) = &step.stress {
                stress.materials.iter().for_each(|extremes| check_all(&EXTREMES.each(), extremes));
                stress.interfaces.iter().for_each(|carried| check_all(&CARRIED.each(), carried));
            }
            step.strength.iter().for_each(|taken| check_all(&UTILISATION.each(), taken));
        }
        let all: BTreeSet<_> = of_step().iter().map(|quantity| (quantity.path(), quantity.named().code)).collect();
        assert_eq!(seen, all);
    }

    #[test]
    fn a_name_is_of_one_quantity_of_a_step() {
        let names: Vec<&str> = of_step().iter().map(|quantity| quantity.named().name).collect();
        assert_eq!(names.iter().collect::<BTreeSet<_>>().len(), names.len(), "{names:?}");
        let keys: Vec<String> = declared().into_iter().map(|(path, named)| named.keys(path).0).collect();
        assert_eq!(keys.iter().collect::<BTreeSet<_>>().len(), keys.len(), "{keys:?}");
    }
}
