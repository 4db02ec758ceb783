//! Wear by local slip, cycle after cycle, of points that stay in place: against sliding wear, dissipated energy, and the limit of
//! partial slip, where what slipped bears nothing any more.

use percoat::body::Side;
use percoat::life::{Beginning, EventKind, LifeEnd, LifeError, LifeState, LifeTask};
use percoat::reading::FatiguePart;
use percoat::run::{Motion, Run, Sampling, WearPath};
use percoat::spectral::{Drive, Wear};
use percoat::{
    Bodies, Cell, Durability, Fatigue, Friction, HalfSpace, Indenters, Interface, Lattice, Layer, Level, Load,
    Material, MeanStress, Problem, Settings, Shape, Solver,
};
use std::ops::ControlFlow;
use std::sync::Arc;

const POINTS: [usize; 2] = [48; 2];
const LOAD: Load = Load::Force(0.3);

/// A ball of the radius 1 in a window of some side.
fn problem(bodies: Bodies, friction: f64, side: f64) -> Problem {
    let lattice = Lattice::new(Cell::window([side; 2]).unwrap(), vec![vec![[0.5; 2]]]).unwrap();
    let ball = Indenters::new(lattice, vec![Level::new(Shape::Paraboloid { radius: 1.0 }, 0.0).unwrap()]).unwrap();
    Problem::new(ball, bodies).sliding(Friction::new(friction, [1.0, 0.0]).unwrap()).unwrap()
}

fn wearing(body: HalfSpace, k: f64) -> HalfSpace {
    body.with_substrate_durability(Durability { wear: Some(k), ..Durability::default() }).unwrap()
}

/// Like bodies that wear by k_b and k_c.
fn like_bodies([body, counterbody]: [f64; 2]) -> Bodies {
    let half_space = || HalfSpace::new(vec![], Material::from_shear(1.0, 0.3).unwrap());
    Bodies::elastic(wearing(half_space(), body), wearing(half_space(), counterbody))
}

fn task(problem: Problem, drives: &[Drive], passes: Option<f64>) -> LifeTask {
    LifeTask {
        problem: Arc::new(problem),
        load: LOAD,
        sampling: Sampling::Points(POINTS),
        settings: Settings::default(),
        mean: MeanStress::default(),
        passes,
        distance: None,
        stroke: None,
        tolerance: 0.02,
        motions: Some(drives.iter().map(|drive| Motion::Shear(*drive)).collect()),
    }
}

fn followed(task: &LifeTask) -> (Beginning, LifeState) {
    task.check().unwrap();
    let begun = task.beginning(&|_| true, &|| true).unwrap();
    let mut state = task.unworn(&begun);
    while state.end.is_none() {
        state = task.advance(state, &begun, &|| true).unwrap();
    }
    (begun, state)
}

fn parts(parts: &[f64]) -> Vec<Drive> {
    parts.iter().map(|part| Drive::Part([*part, 0.0])).collect()
}

/// A shift of ± 1, some thousand times what sticks, slips everywhere by 4 in a cycle: both surfaces wear as one that slides 4 in its place.
#[test]
fn cycles_of_gross_slip_wear_as_sliding_does() {
    let (k, cycles) = ([0.02, 0.03], 4.0);
    let drives = [1.0, -1.0, 1.0].map(|shift| Drive::Shift([shift, 0.0]));
    let (begun, state) = followed(&task(problem(like_bodies(k), 1e-3, 2.4), &drives, Some(cycles)));
    assert_eq!(state.end, Some(LifeEnd::Passes));
    let touched = begun.step.finest().pressures().iter().zip(&begun.slid).filter(|(p, _)| **p > 0.0);
    assert!(touched.clone().count() > 60 && touched.clone().all(|(_, slid)| (slid / 4.0 - 1.0).abs() < 2e-3));
    // Wear of a counterbody alone does not depend on the direction.
    let wear = Wear::new(0.0, k[0] + k[1], [1.0, 0.0]).unwrap();
    let path = WearPath::new(LOAD, wear, 4.0 * cycles, 2e-3).unwrap();
    let mut solver = Solver::new(problem(like_bodies(k), 1e-3, 2.4).at_rest(), POINTS, Settings::default()).unwrap();
    path.slide(&mut solver, &mut |_, _| ControlFlow::Continue(())).unwrap();
    let expected = solver.worn().unwrap().depth(Side::Counterbody);
    let deepest = expected.iter().copied().fold(0.0, f64::max);
    assert!(deepest > 0.05, "{deepest}");
    // The tolerance of each step, of which there are some tens, is that of what it wears; errors of both signs.
    for (side, depths) in state.worn.iter().enumerate() {
        let part = k[side] / (k[0] + k[1]);
        let apart = depths.iter().zip(expected).map(|(depth, known)| (depth - part * known).abs()).fold(0.0, f64::max);
        println!("{} states, {apart:e} of {deepest}", state.solved);
        assert!(apart < 5e-3 * part * deepest, "{apart:e}");
    }
    let (row, volume) = (state.course.last().unwrap(), 4.0 * cycles * (k[0] + k[1]) * 0.3);
    let [body, counterbody] = [row.body_scar.unwrap(), row.scar.unwrap()].map(|scar| scar.volume);
    assert!(((body + counterbody) / volume - 1.0).abs() < 5e-3, "{} {volume}", body + counterbody);
    assert!((body / counterbody - k[0] / k[1]).abs() < 1e-9 && row.groove.is_none() && row.distance.is_none());
}

/// Little wear: its volume is k/μ times the energy that the cycles dissipate.
#[test]
fn the_volume_that_wears_is_the_dissipated_energy_times_k_over_friction() {
    let (k, mu, cycles) = ([0.0, 1e-3], 0.4, 1.0);
    let steps = [0.7, 0.0, -0.7, 0.0, 0.7];
    let (begun, state) = followed(&task(problem(like_bodies(k), mu, 2.4), &parts(&steps), Some(cycles)));
    let run = Run::new(problem(like_bodies(k), mu, 2.4), vec![LOAD; steps.len()], Sampling::Points(POINTS));
    let motions = parts(&steps).into_iter().map(Motion::Shear).collect();
    let outcome = Run { motions: Some(motions), ..run }.solve(&mut ()).unwrap();
    let energy: f64 = outcome.steps[1..].iter().map(|step| step.tangential.as_ref().unwrap().work).sum();
    let worn = state.course.last().unwrap().scar.unwrap();
    assert!((worn.volume / (k[1] / mu * energy * cycles) - 1.0).abs() < 2e-3, "{} {energy}", worn.volume);
    assert!(worn.depth < 1e-3 * begun.record.reading.penetration && state.largest_worn(Side::Body) == 0.0);
}

/// After many cycles the annulus that slipped bears next to nothing, and what stuck still does (Ciavarella & Hills, Eur. J. Mech. A 18 (1999) 491).
#[test]
fn what_slipped_wears_until_it_bears_nothing() {
    let points = [40; 2];
    let base = task(problem(like_bodies([0.0, 1.0]), 0.4, 2.4), &parts(&[0.7, -0.7, 0.7]), Some(400.0));
    let (begun, state) = followed(&LifeTask { sampling: Sampling::Points(points), tolerance: 0.1, ..base });
    let sticks: Vec<bool> = begun.slid.iter().map(|slid| *slid == 0.0).collect();
    assert!(sticks.iter().filter(|sticks| **sticks).count() > 40);
    println!("{} states, {:?}", state.solved, state.course.last());
    assert_eq!(state.end, Some(LifeEnd::Passes));
    // The pressure of the worn surfaces.
    let unworn = problem(like_bodies([0.0, 1.0]), 0.4, 2.4).at_rest();
    let mut gap = unworn.loaded_by().surface(points).unwrap().initial_gap().to_owned();
    gap.iter_mut().zip(&state.worn[1]).for_each(|(gap, depth)| *gap += depth);
    let least = gap.iter().copied().fold(f64::INFINITY, f64::min);
    gap.mapv_inplace(|gap| gap - least);
    let step = Solver::new(unworn, points, Settings::default()).unwrap().with_gap(gap).unwrap().solve(LOAD);
    let outside = |step: &percoat::Step| {
        let share = |of: bool| -> f64 {
            let pressures = step.finest().pressures().iter().zip(&sticks).filter(|(_, sticks)| **sticks == of);
            pressures.map(|(p, _)| p).sum()
        };
        share(false) / (share(false) + share(true))
    };
    let [before, after] = [&begun.step, &step].map(outside);
    println!("outside {before} {after}");
    assert!(before > 0.3 && after < 1e-3, "{before} {after}");
    // Samples that stuck keep their height, but for those at the border of what slips.
    let deepest = state.largest_worn(Side::Counterbody);
    let kept = state.worn[1].iter().zip(&sticks).filter(|(depth, sticks)| **sticks && **depth < 0.02 * deepest).count();
    let stuck = sticks.iter().filter(|sticks| **sticks).count();
    assert!(4 * kept > 3 * stuck, "{kept} of {stuck}");
}

/// Steps that are coarse leave the volume what it is in fine ones, also while slip spreads.
#[test]
fn the_worn_volume_does_not_depend_on_the_steps() {
    let volume = |tolerance: f64| {
        let base = task(problem(like_bodies([0.0, 1.0]), 0.4, 2.4), &parts(&[0.7, -0.7, 0.7]), Some(2.0));
        let (_, state) = followed(&LifeTask { sampling: Sampling::Points([40; 2]), tolerance, ..base });
        (state.course.last().unwrap().scar.unwrap().volume, state.solved)
    };
    let [(coarse, few), (fine, many)] = [0.1, 0.02].map(volume);
    println!("{coarse} {few} {fine} {many}");
    assert!(few < many && (coarse / fine - 1.0).abs() < 1e-2, "{coarse} {fine}");
}

/// A force so small that no sample slips wears nothing.
#[test]
fn what_sticks_everywhere_does_not_wear() {
    let base = task(problem(like_bodies([1.0, 1.0]), 0.4, 2.4), &parts(&[0.001, -0.001, 0.001]), Some(1e6));
    let (begun, state) = followed(&LifeTask { sampling: Sampling::Points([24; 2]), ..base });
    let pressures = begun.step.finest().pressures();
    assert!(begun.slid.iter().zip(pressures).all(|(slid, p)| *p == 0.0 || *slid == 0.0));
    assert_eq!((state.end, state.solved), (Some(LifeEnd::Passes), 1));
    assert!(state.removed() == 0.0 && state.largest_worn(Side::Counterbody) == 0.0);
}

#[test]
fn a_crack_begins_after_the_passes_of_the_unworn_cycle() {
    let law = Fatigue::new(0.05, 1e6, 5.0).unwrap();
    let tires = Durability { fatigue: Some(law), ..Durability::default() };
    let layer = Layer::new(Material::from_shear(2.0, 0.25).unwrap(), 0.4, Interface::Bonded).unwrap();
    let layer = layer.with_durability(tires, Some(law)).unwrap();
    let body = HalfSpace::new(vec![layer], Material::from_shear(1.0, 0.3).unwrap());
    let body = body.with_substrate_durability(tires).unwrap();
    let bodies = || Bodies::elastic(body.clone(), HalfSpace::new(vec![], Material::from_shear(1.0, 0.3).unwrap()));
    let steps = parts(&[0.6, -0.6, 0.6]);
    let only_first = task(problem(bodies(), 0.4, 2.4), &steps, None);
    let (begun, state) = followed(&only_first);
    let lives = &begun.record.fatigue.as_ref().unwrap().lives;
    let first =
        lives.iter().filter(|life| life.part.is_followed()).map(|life| life.passes).fold(f64::INFINITY, f64::min);
    assert!(state.events.len() == 1 && state.events[0].what == EventKind::Crack && first > 1.0);
    assert!((state.passes / first - 1.0).abs() < 1e-9 && state.end == Some(LifeEnd::Passes));
    // All parts in their order, up to the passes that are followed.
    let last = lives.iter().map(|life| life.passes).fold(0.0, f64::max);
    let (_, state) = followed(&LifeTask { passes: Some(1.1 * last), ..only_first.clone() });
    let parts: Vec<FatiguePart> = state.events.iter().map(|event| event.part).collect();
    assert_eq!(parts.len(), lives.len(), "{parts:?}");
    for event in &state.events {
        let life = lives.iter().find(|life| life.part == event.part).unwrap();
        assert!((event.passes / life.passes - 1.0).abs() < 1e-3, "{event:?}");
    }
    assert!(state.removed() == 0.0 && state.in_place.iter().all(|part| part.damage >= 1.0 - 1e-3));
    let open = LifeTask { motions: Some(vec![Motion::Shear(steps[0]), Motion::Shear(steps[1])]), ..only_first.clone() };
    assert_eq!(open.check(), Err(LifeError::NoCycle));
    assert_eq!(LifeTask { stroke: Some(1.0), ..only_first }.check(), Err(LifeError::CycleAndDistance));
}
