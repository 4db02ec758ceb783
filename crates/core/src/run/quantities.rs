//! The quantities of a load step, whichever of its records has them.

use super::StepRecord;
use super::record::STEP;
use crate::measured::Measured;
use crate::quantity::{Named, Quantity};
use crate::reading::{LIFE, Life, PLASTIC, PlasticReading, READING, ROUGH, Reading, RoughReading};
use crate::stress::maxima::{EXTREMES, Extremes};

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
        all.into_iter().map(|own| own as &dyn OfStep)
    }
    each(READING.each())
        .chain(each(STEP.each()))
        .chain(each(ROUGH.each()))
        .chain(each(PLASTIC.each()))
        .chain(each(EXTREMES.each()))
        .chain(each(LIFE.each()))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{Durability, Fatigue, HalfSpace, Material};
    use crate::counterbody::{Indenters, Level, Shape, Topography};
    use crate::lattice::{Cell, Lattice};
    use crate::load::Load;
    use crate::problem::Problem;
    use crate::quantity::ErrorAt;
    use crate::reading::{LEVEL, UTILISATION};
    use crate::run::{Run, Sampling, StressRequest};
    use crate::stress::maxima::CARRIED;
    use serde_json::{Value, json};
    use std::collections::BTreeSet;

    fn body() -> HalfSpace {
        let fatigue = Fatigue::new(0.1, 1e6, 8.0).unwrap();
        let durability = Durability { hardness: Some(0.1), fatigue: Some(fatigue), ..Durability::default() };
        let substrate = Material::from_young(1.0, 0.3).unwrap();
        HalfSpace::new(vec![], substrate).with_substrate_durability(durability).unwrap()
    }

    /// The last of two steps that press a ball into a window, and of two that press waves.
    fn steps() -> [StepRecord; 2] {
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
        [last(Problem::new(ball, body()), [0.005, 0.01]), last(Problem::new(waves, body()), [0.01, 0.02])]
    }

    /// The value under keys with a dot between them.
    fn at<'a>(keys: &'a Value, path: &str) -> &'a Value {
        path.split('.').fold(keys, |keys, key| &keys[key])
    }

    /// Compares what is declared of a quantity with the keys of its record: value and error stand where they are said to.
    fn check(named: &Named, own: Measured, keys: &Value, path: &str) {
        let value = at(keys, &format!("{path}{}", named.code));
        let (value, error) = match named.error {
            ErrorAt::Under => (value, Some(&at(keys, &format!("{path}errors"))[named.code])),
            ErrorAt::Beside(key) => (value, Some(at(keys, &format!("{path}{key}")))),
            ErrorAt::InPeak => (&value["value"], Some(&value["error"])),
            ErrorAt::Nowhere => (value, None),
        };
        assert_eq!(value, &json!(own.value), "{named:?}");
        assert!(error.is_none_or(|error| *error == json!(own.error)), "{named:?}: {error:?}");
    }

    #[test]
    fn every_quantity_stands_in_files_where_it_is_declared() {
        let mut seen = BTreeSet::new();
        for step in steps() {
            assert!(step.converged());
            let keys = json!(step);
            for own in of_step() {
                let Some(measured) = own.of_step(&step) else { continue };
                check(own.named(), measured, &keys, own.path());
                seen.insert((own.path(), own.named().code));
            }
            for (level, keys) in step.reading.levels.iter().map(|level| (level, json!(level))) {
                LEVEL
                    .each()
                    .iter()
                    .for_each(|own| own.of(level).iter().for_each(|of| check(&own.named, *of, &keys, "")));
            }
            for (own, keys) in step.stress.iter().flat_map(|stress| &stress.materials).map(|own| (own, json!(own))) {
                EXTREMES.each().iter().for_each(|of| check(&of.named, of.of(own).unwrap(), &keys, ""));
            }
        }
        let all: BTreeSet<_> = of_step().iter().map(|own| (own.path(), own.named().code)).collect();
        assert_eq!(seen, all);
    }

    #[test]
    fn a_name_is_of_one_quantity_of_a_step() {
        let names: Vec<&str> = of_step().iter().map(|own| own.named().name).collect();
        assert_eq!(names.iter().collect::<BTreeSet<_>>().len(), names.len(), "{names:?}");
        let others = [CARRIED.each().len(), UTILISATION.each().len()];
        assert_eq!(others, [2, 1]);
    }
}
