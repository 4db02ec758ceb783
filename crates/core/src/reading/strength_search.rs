//! The utilisations of a step by a search for the stresses of its criteria alone.

use super::fatigue::{Pass, PathReading};
use super::stress::{Tip, contact_radii, move_beside_site};
use super::{Criterion, Reading, Utilisation};
use crate::body::StrainDirection;
use crate::spectral::Step;
use crate::stress::{PathSought, StrengthPeaks, StressFields};

/// The utilisations of a step that has contact, by a search for the stresses of the criteria alone, and in a pass, if one is given; they are
/// those by [`StressReading::of`](super::StressReading::of). `None` when `goes_on`, called many times a second during the search, returns false.
pub(crate) fn utilisations_while(
    step: &Step,
    reading: &Reading,
    fields: &StressFields,
    pass: Option<&Pass<'_>>,
    goes_on: &dyn Fn() -> bool,
) -> Option<Vec<Utilisation>> {
    let mut all = largest_while(step, reading, fields, goes_on)?;
    let sought = PathSought { fatigue: false, endurance: true, map: false };
    if let Some(pass) = pass {
        all.extend(PathReading::of_pass(step, reading, fields, (sought, pass), goes_on)?.utilisations);
    }
    Some(all)
}

/// The utilisations by the largest stresses and strains alone, as [`utilisations_while`].
pub(crate) fn largest_while(
    step: &Step,
    reading: &Reading,
    fields: &StressFields,
    goes_on: &dyn Fn() -> bool,
) -> Option<Vec<Utilisation>> {
    let coarser = step.coarser().first().and_then(|contact| fields.of_other(contact));
    let (bodies, radii) = (step.problem().bodies(), contact_radii(step, reading));
    let mut all = Vec::new();
    for field in fields.each() {
        let side = field.half_space().side();
        let criteria: Vec<Criterion> =
            Criterion::all(bodies).into_iter().filter(|criterion| criterion.side() == side).collect();
        if criteria.is_empty() {
            continue;
        }
        let mut peaks = field.strength_peaks_while(radii, coarser.as_ref().map(|coarser| coarser.on(side)), goes_on)?;
        peaks.each().for_each(|peak| move_beside_site(step, peak));
        if let Some(tip) = Tip::of(step, reading, field.half_space()) {
            let life = field.half_space().durabilities().next().and_then(|durability| durability.strain_life);
            let is_pressed = life.is_some_and(|life| life.direction() == StrainDirection::Compression);
            let StrengthPeaks { tension, mises, strain, .. } = &mut peaks;
            mises[0].iter_mut().for_each(|peak| tip.press(peak));
            strain[0].iter_mut().filter(|_| is_pressed && tip.compresses).for_each(|peak| tip.press(peak));
            tension[0].iter_mut().filter(|_| tip.tears).for_each(|peak| tip.press(peak));
        }
        let peak = |criterion: Criterion| match criterion {
            Criterion::Yield(material) => peaks.mises[material.number - 1],
            Criterion::Cracking(material) => peaks.tension[material.number - 1],
            Criterion::Delamination(interface) => peaks.delamination[interface.number - 1],
            Criterion::StrainLife(material) => peaks.strain[material.number - 1],
            Criterion::Crossland(_) | Criterion::DangVan(_) => None,
        };
        let judged =
            criteria.into_iter().filter_map(|criterion| Utilisation::by_peak(bodies, criterion, peak(criterion)?));
        all.extend(judged);
    }
    Some(all)
}

#[cfg(test)]
mod tests {
    use super::super::StressReading;
    use super::*;
    use crate::body::{
        Durability, HalfSpace, Interface, InterfaceStrength, Layer, Material, MeanStress, StrainLife, Strength,
    };
    use crate::counterbody::{Indenters, Level, Shape};
    use crate::friction::Friction;
    use crate::lattice::{Cell, Lattice};
    use crate::problem::Problem;
    use crate::spectral::{Settings, Solver};
    use crate::{Bodies, Load};

    fn material(young: f64) -> Material {
        Material::from_young(young, 0.3).unwrap()
    }

    fn lasts(direction: StrainDirection) -> Durability {
        let life = StrainLife::new(1e-2, 1e6, 4.0, direction).unwrap();
        Durability { strain_life: Some(life), ..Durability::default() }
    }

    fn layer(strength: Strength, interface: InterfaceStrength) -> Layer {
        let layer = Layer::new(material(2.0), 0.05, Interface::Bonded).unwrap().with_residual_stress(-0.01).unwrap();
        layer.with_strengths(strength, interface).unwrap()
    }

    /// One search finds all stresses, the other those by which strengths are judged: the utilisations are the same bit for bit. Materials
    /// without strengths, with one and with both; interfaces with and without; friction, two bodies, a tip, periodic and isolated.
    #[test]
    fn a_search_for_strengths_alone_finds_the_same_utilisations() {
        let strength = |yielding: Option<f64>, tensile: Option<f64>| Strength { yielding, tensile };
        let bond = InterfaceStrength { normal: Some(0.02), shear: Some(0.05), friction: 0.0 };
        let all = layer(strength(Some(0.3), Some(0.1)), InterfaceStrength { friction: 0.3, ..bond });
        let [pressed, pulled] = [StrainDirection::Compression, StrainDirection::Tension].map(lasts);
        let on_top = layer(strength(None, None), InterfaceStrength::default()).with_durability(pressed, None).unwrap();
        let bodies = [
            HalfSpace::new(vec![on_top, all], material(1.0)).with_substrate_durability(pulled).unwrap(),
            HalfSpace::new(vec![layer(strength(None, Some(0.1)), InterfaceStrength::default())], material(1.0))
                .with_substrate_strength(strength(Some(0.2), None))
                .unwrap(),
            HalfSpace::new(vec![layer(strength(None, None), bond)], material(1.0)),
        ];
        let counterbody = HalfSpace::new(vec![all], material(3.0));
        let cells = [Cell::square(1.0).unwrap(), Cell::window([1.0; 2]).unwrap()];
        let [periodic, isolated] = cells.map(|cell| Lattice::new(cell, vec![vec![[0.5; 2]]]).unwrap());
        let indenters = |lattice: &Lattice, shape: Shape| {
            Indenters::new(lattice.clone(), vec![Level::new(shape, 0.0).unwrap()]).unwrap()
        };
        const BALL: Shape = Shape::Paraboloid { radius: 2.0 };
        const CONE: Shape = Shape::Cone { slope: 0.1 };
        let mut compared = 0;
        for (index, body) in bodies.iter().enumerate() {
            let elastic = Bodies::elastic(body.clone(), counterbody.clone());
            let problems = [
                Problem::new(indenters(&periodic, BALL), body.clone())
                    .sliding(Friction::new(0.3, [0.6, 0.8]).unwrap())
                    .unwrap(),
                Problem::new(indenters(&periodic, CONE), body.clone()),
                Problem::new(indenters(&isolated, BALL), elastic),
            ];
            for problem in problems {
                let mut solver = Solver::new(problem, [64; 2], Settings::default()).unwrap();
                let step = solver.solve(Load::Force(0.01));
                let (reading, fields) = (step.reading(), StressFields::new(step.finest(), MeanStress::Confined));
                let all = Utilisation::all(step.problem().bodies(), &StressReading::of(&step, &reading, &fields));
                let found = utilisations_while(&step, &reading, &fields, Some(&Pass::default()), &|| true).unwrap();
                assert!(found == all && !found.is_empty(), "{index}: {found:?}, {all:?}");
                assert!(found.iter().all(|utilisation| utilisation.error.is_some() || utilisation.value.is_infinite()));
                assert_eq!(utilisations_while(&step, &reading, &fields, None, &|| false), None);
                compared += found.len();
            }
        }
        assert!(compared > 20, "{compared}");
    }
}
