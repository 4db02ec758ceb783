//! The way from one state to the next: jumps are bracketed, and the least force on it is found.
//!
//! On a smooth branch the bodies' energy U rises by the work of the force, W = ∫P dδ. Where less arrives than the trapezoid of both ends has done,
//! by a 500th of the work of adhesion on all that touches or a 20th of the work done, or what touches and pulls changes to twice or half its area,
//! the surfaces may have jumped: the step is halved. Halves of a smooth step miss a quarter together, and in a small part of it force and
//! penetration change little; in a jump they change as much as before, however near the two states are. Jumps that lose less are part of what
//! trapezoids miss.
//!
//! Pull-off is the least force on a branch, by a parabola through the three lowest states around it, or the force from which surfaces jump apart.

use super::track::{Aim, Numbers, State, Track};
use crate::spectral::iteration::Progress;
use std::ops::ControlFlow;

/// Missing energy from which on a step is halved, over the work of adhesion on all that touches and pulls, and over the work done: one of many
/// asperities that lets go loses little.
const SUSPICIOUS: [f64; 2] = [2e-3, 0.05];
/// The same below which nothing is missing.
const LEAST_MISSING: f64 = 1e-4;
/// Missing energy over the work of adhesion on all that touches and pulls that is a jump between two near states, however the force changes.
const LARGE: f64 = 0.02;
/// Part to which the area that touches or pulls falls, or from which it rises, in a step that is halved.
const CHANGED: f64 = 0.5;
/// Part of the missing energy that halves of a smooth step miss together, at most.
const SMOOTH: f64 = 0.5;
/// Most halvings of a step.
const MOST_HALVINGS: usize = 8;
/// Part of the change of the whole step, of the force or under a given force of the penetration, that is a jump where it is left between two
/// near states.
const LEFT: f64 = 0.2;
/// Part of the range of the tension below which the place of a jump is known well enough.
const CLOSE: f64 = 0.02;
/// Most states tried at the lowest place of a parabola, and the relative difference of its force at which it is found.
const TRIES: usize = 3;
const FOUND: f64 = 3e-4;

/// A jump of the surfaces in a step, between two states next to each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jump {
    /// Whether the surfaces come together; otherwise they part.
    pub is_in: bool,
    /// Penetration before and after, lengths; `None` of surfaces that a load draws apart and nothing holds.
    pub penetration: [Option<f64>; 2],
    /// Force before and after.
    pub force: [f64; 2],
    /// Contact area before and after, lengths squared.
    pub contact_area: [f64; 2],
    /// Energy that is lost; `None` from and to surfaces that a load draws apart and nothing holds.
    pub loss: Option<f64>,
}

/// The least force of a path, at which a falling load would pull the surfaces apart.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PullOff {
    /// Force, below 0.
    pub force: f64,
    /// Error of the force by the distance of the states of the path.
    pub error: f64,
    /// Penetration, a length.
    pub penetration: f64,
    /// Contact area, a length squared.
    pub contact_area: f64,
    /// Whether the surfaces jump apart there, while the force still falls.
    pub jumps: bool,
}

/// A way from state to state on one grid.
#[derive(Debug, Clone)]
pub(super) struct Way {
    /// The last states, the present one behind; at most three. A jump empties it before its end.
    trail: Vec<Placed>,
    pub pull_off: Option<PullOff>,
}

/// Jumps, work and iterations of a step.
#[derive(Debug, Clone, Default)]
pub(super) struct Met {
    pub jumps: Vec<Jump>,
    /// Work of the force on the bodies, ∫P dδ, an energy.
    pub work: f64,
    /// Iterations of all states, and their number: more than one where a step was halved.
    pub iterations: usize,
    pub states: usize,
    /// Part of the work, without jumps, that trapezoids miss: its error.
    pub missing: f64,
}

type Watch<'a> = &'a mut (dyn FnMut(Progress) -> ControlFlow<()> + Send);

impl Way {
    /// The way that begins with undeformed surfaces that touch.
    pub fn new() -> Self {
        Self { trail: Vec::new(), pull_off: None }
    }

    /// The present state; `None` before the first one.
    pub fn present(&self) -> Option<&State> {
        self.trail.last().map(|(state, _)| state)
    }

    /// Goes on to an aim.
    pub fn go(&mut self, track: &mut Track, (aim, work, range): (Aim, f64, f64), watch: Watch<'_>) -> Met {
        let Some(from) = self.present().cloned() else {
            // The first state is found from surfaces that touch, or lie apart at its penetration.
            let apart = match aim {
                Aim::Force(_) => 0.0,
                Aim::Grip { position, .. } => position,
            };
            let state = track.solve(&track.undeformed(apart), aim, watch);
            let met = Met { iterations: state.report.iterations, states: 1, ..Met::default() };
            self.trail.push((state, aim.value()));
            return met;
        };
        // States of another kind of control are no places along this one.
        let at = aim.value_of(&from.numbers);
        for (state, value) in &mut self.trail {
            *value = aim.value_of(&state.numbers);
        }
        let end = track.solve(&from, aim, watch);
        let least = LEFT * change(aim, &from, &end);
        let met = Met { iterations: end.report.iterations, states: 1, ..Met::default() };
        let mut search = Search { way: self, aim, work, close: CLOSE * range, least, met };
        search.divide(track, (from, at), (end, aim.value()), MOST_HALVINGS, watch);
        search.met
    }

    /// Takes the state from which surfaces jump apart for pull-off where no force has been lower.
    fn part(&mut self, before: &State, after: &State) {
        let Numbers { force, penetration, contact_area, .. } = before.numbers;
        let is_lower = force < self.pull_off.map_or(0.0, |lowest| lowest.force);
        if !before.report.stop.solved() || !is_lower || extent(&after.numbers) >= extent(&before.numbers) {
            return;
        }
        // As much as the force has changed between the last two states, or changes in the jump.
        let earlier = self.trail.len().checked_sub(2).map_or(after, |index| &self.trail[index].0);
        let error = (force - earlier.numbers.force).abs();
        self.pull_off = Some(PullOff { force, error, penetration, contact_area, jumps: true });
    }

    /// Finds the least force where the middle one of the last three states is the lowest; returns the iterations and the number of states tried.
    fn lowest(&mut self, track: &mut Track, aim: Aim, watch: Watch<'_>) -> [usize; 2] {
        let [(a, at_a), (b, at_b), (c, at_c)] = &self.trail[..] else { return [0; 2] };
        let mut three = [(a.clone(), *at_a), (b.clone(), *at_b), (c.clone(), *at_c)];
        let force = |(state, _): &Placed| state.numbers.force;
        let is_lowest = force(&three[1]) < force(&three[0]) && force(&three[1]) <= force(&three[2]);
        let is_new = force(&three[1]) < self.pull_off.map_or(0.0, |lowest| lowest.force);
        let is_turned = (three[1].1 - three[0].1) * (three[2].1 - three[1].1) <= 0.0;
        let is_solved = three.iter().all(|(state, _)| state.report.stop.solved() && !state.is_detached());
        if !is_solved || !is_lowest || !is_new || is_turned || matches!(aim, Aim::Force(_)) {
            return [0; 2];
        }
        let mut tried = [0; 2];
        let mut bottom = vertex(&three);
        for _ in 0..TRIES {
            let [place, least] = bottom;
            if (least - force(&three[1])).abs() <= FOUND * least.abs() {
                break;
            }
            // From the state before, on the way out.
            let index = usize::from((place - three[1].1) * (three[2].1 - three[1].1) > 0.0);
            let between = track.solve(&three[index].0, aim.with(place), watch);
            tried = [tried[0] + between.report.iterations, tried[1] + 1];
            if !between.report.stop.solved() {
                break;
            }
            let between = (between, place);
            three = match (index, force(&between) < force(&three[1])) {
                (0, true) => [three[0].clone(), between, three[1].clone()],
                (0, false) => [between, three[1].clone(), three[2].clone()],
                (_, true) => [three[1].clone(), between, three[2].clone()],
                (_, false) => [three[0].clone(), three[1].clone(), between],
            };
            bottom = vertex(&three);
        }
        let (lowest, [_, least]) = (&three[1].0.numbers, bottom);
        let error = (least - lowest.force).abs();
        let Numbers { penetration, contact_area, .. } = *lowest;
        self.pull_off =
            Some(PullOff { force: least.min(lowest.force), error, penetration, contact_area, jumps: false });
        tried
    }
}

/// A state with the value at which it is prescribed.
type Placed = (State, f64);

/// Search for the jumps of a step.
struct Search<'a> {
    way: &'a mut Way,
    aim: Aim,
    /// Work of adhesion, a pressure times a length.
    work: f64,
    /// Distance of two positions of a grip that are near enough, a length.
    close: f64,
    /// Least change of force, or under a given force of the penetration, of a jump.
    least: f64,
    met: Met,
}

impl Search<'_> {
    /// Halves the way from a state to another one as long as there may be a jump. Every half begins where the one before has ended: a long
    /// step may come to another branch than short ones. All pairs of neighbours are taken up in their order.
    fn divide(&mut self, track: &mut Track, mut a: Placed, mut b: Placed, mut left: usize, watch: Watch<'_>) -> Placed {
        loop {
            if let Some(is_jump) = self.ends(&a, &b, left) {
                self.take(track, &a.0, &b, is_jump, watch);
                return b;
            }
            let (place, end) = (0.5 * (a.1 + b.1), b.1);
            let mut middle = (self.solve(track, &a.0, place, watch), place);
            b = (self.solve(track, &middle.0, end, watch), end);
            let [whole, first, second] =
                [(&a, &b), (&a, &middle), (&middle, &b)].map(|((a, _), (b, _))| missing(&a.numbers, &b.numbers).abs());
            let is_smooth = first + second < SMOOTH * whole && !changes(&a.0, &middle.0) && !changes(&middle.0, &b.0);
            left -= 1;
            if is_smooth {
                self.take(track, &a.0, &middle, false, watch);
                self.take(track, &middle.0, &b, false, watch);
                return b;
            }
            if self.ends(&a, &middle, left) == Some(false) {
                self.take(track, &a.0, &middle, false, watch);
            } else {
                middle = self.divide(track, a, middle, left, watch);
                b = (self.solve(track, &middle.0, end, watch), end);
            }
            a = middle;
        }
    }

    /// The state at a value, from another one.
    fn solve(&mut self, track: &mut Track, from: &State, value: f64, watch: Watch<'_>) -> State {
        let state = track.solve(from, self.aim.with(value), watch);
        self.met.iterations += state.report.iterations;
        self.met.states += 1;
        state
    }

    /// Whether the way between two states is halved no more, and then whether there is a jump.
    fn ends(&self, (a, at_a): &Placed, (b, at_b): &Placed, left: usize) -> Option<bool> {
        let is_solved = a.report.stop.solved() && b.report.stop.solved();
        if !is_solved || !(self.may_jump(a, b) || changes(a, b)) {
            return Some(false);
        }
        let is_close = matches!(self.aim, Aim::Grip { .. }) && (at_b - at_a).abs() <= self.close;
        (left == 0 || is_close).then(|| self.loses(a, b) || change(self.aim, a, b) > self.least)
    }

    /// Takes up the way from a state to the next one.
    fn take(&mut self, track: &mut Track, a: &State, next: &Placed, is_jump: bool, watch: Watch<'_>) {
        let b = &next.0;
        let is_held = !a.is_detached() && !b.is_detached();
        if is_held {
            self.met.work += done(&a.numbers, &b.numbers);
        }
        if is_jump {
            self.met.jumps.push(jump(a, b));
            self.way.part(a, b);
            self.way.trail.clear();
        } else if is_held {
            self.met.missing += missing(&a.numbers, &b.numbers).abs();
        }
        let trail = &mut self.way.trail;
        trail.push(next.clone());
        trail.drain(..trail.len().saturating_sub(3));
        if !is_jump {
            let [iterations, states] = self.way.lowest(track, self.aim, watch);
            self.met.iterations += iterations;
            self.met.states += states;
        }
    }

    /// Whether so much energy is missing between two states that there may be a jump.
    fn may_jump(&self, a: &State, b: &State) -> bool {
        let [of_adhesion, of_work] = SUSPICIOUS;
        let missing = missing(&a.numbers, &b.numbers).abs();
        // In what rounding and the tolerance make of an energy there is none.
        let is_much = missing > LEAST_MISSING * self.adhesive(a, b);
        self.parts(a, b).unwrap_or_else(|| {
            missing > of_adhesion * self.adhesive(a, b)
                || is_much && missing > of_work * done(&a.numbers, &b.numbers).abs()
        })
    }

    /// Whether more energy is lost between two near states than on any smooth way.
    fn loses(&self, a: &State, b: &State) -> bool {
        self.parts(a, b).unwrap_or_else(|| missing(&a.numbers, &b.numbers).abs() > LARGE * self.adhesive(a, b))
    }

    /// Whether surfaces come apart under a load, or together from there; `None` where they are held at both.
    fn parts(&self, a: &State, b: &State) -> Option<bool> {
        (a.is_detached() || b.is_detached()).then(|| a.is_detached() != b.is_detached())
    }

    /// Work of adhesion on all that touches and pulls.
    fn adhesive(&self, a: &State, b: &State) -> f64 {
        self.work * extent(&a.numbers).max(extent(&b.numbers))
    }
}

/// Whether what touches and pulls grows or shrinks so much that the states may lie on two branches.
fn changes(a: &State, b: &State) -> bool {
    let extents = [extent(&a.numbers), extent(&b.numbers)];
    extents[0].min(extents[1]) < CHANGED * extents[0].max(extents[1])
}

/// Change of the force between two states, or under a given force of the penetration.
fn change(aim: Aim, a: &State, b: &State) -> f64 {
    match aim {
        Aim::Force(_) => (b.numbers.penetration - a.numbers.penetration).abs(),
        Aim::Grip { .. } => (b.numbers.force - a.numbers.force).abs(),
    }
}

/// Area that touches or pulls.
fn extent(numbers: &Numbers) -> f64 {
    numbers.contact_area + numbers.cohesive_area
}

/// Work of the force between two states, by the trapezoid.
fn done(a: &Numbers, b: &Numbers) -> f64 {
    0.5 * (a.force + b.force) * (b.penetration - a.penetration)
}

/// Work less the rise of the energy between two states.
fn missing(a: &Numbers, b: &Numbers) -> f64 {
    done(a, b) - (b.energy - a.energy)
}

fn jump(a: &State, b: &State) -> Jump {
    let pair = |of: fn(&Numbers) -> f64| [of(&a.numbers), of(&b.numbers)];
    Jump {
        is_in: extent(&b.numbers) > extent(&a.numbers),
        penetration: [a, b].map(|state| (!state.is_detached()).then_some(state.numbers.penetration)),
        force: pair(|numbers| numbers.force),
        contact_area: pair(|numbers| numbers.contact_area),
        loss: (!a.is_detached() && !b.is_detached()).then(|| missing(&a.numbers, &b.numbers)),
    }
}

/// Place and force of the vertex of the parabola through three states of which the middle one is the lowest.
fn vertex(three: &[Placed; 3]) -> [f64; 2] {
    let [[xa, ya], [xb, yb], [xc, yc]] = three.each_ref().map(|(state, x)| [*x, state.numbers.force]);
    let [left, right] = [(ya - yb) / (xa - xb), (yc - yb) / (xc - xb)];
    let curvature = (left - right) / (xa - xc);
    let slope = left - curvature * (xa - xb);
    if curvature <= 0.0 {
        return [xb, yb];
    }
    let place = (-0.5 * slope / curvature).clamp((xa - xb).min(xc - xb), (xa - xb).max(xc - xb));
    [xb + place, yb + slope * place + curvature * place * place]
}
