//! The cycles that a value goes through along a line, in the order in which a point of the body meets it.
//!
//! A pass holds as many cycles as the path has maxima, counted by [rainflow](super::rainflow): those of the levels of a cell count apart.
//! Where the counterbody goes to and fro the way back follows the way there. The value of a vector is its component in the direction in
//! which the cycles do the most damage.

use super::line_path::{LinePath, top};
use super::rainflow::{Cycles, Equivalent};
use crate::numeric::search::first_largest;
use std::f64::consts::PI;

/// Directions of a traction that are compared, and halvings of the angle between them about the best.
const DIRECTIONS: usize = 8;
const HALVINGS: usize = 5;

impl LinePath<'_> {
    /// Numbers of the samples of a line, by its number, in the order in which they are met, those on edges of contact among them.
    fn met(&self, run: usize) -> Vec<usize> {
        let samples = run * self.run..((run + 1) * self.run).min(self.ordered);
        let is_within = |position: f64| (position as usize) >= samples.start && (position as usize) < samples.end;
        let mut edges: Vec<(f64, usize)> = self.edges.iter().copied().zip(self.ordered..).collect();
        edges.retain(|(position, _)| is_within(*position));
        let mut all: Vec<(f64, usize)> = samples.map(|k| (k as f64, k)).chain(edges).collect();
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        all.into_iter().map(|(_, k)| k).collect()
    }

    /// Values met along a line, by its number, at least `least`; a maximum or a minimum is that of a parabola. The value at rest stands
    /// before them where the path comes from there.
    fn sequence(&self, run: usize, rest: f64, least: f64, value: &impl Fn(&Self, usize) -> f64) -> Vec<f64> {
        let turned = |k: usize| {
            let middle = value(self, k);
            let Some([before, after]) = self.along(k) else { return middle };
            let three = [value(self, before), middle, value(self, after)];
            (middle + top(three).0 - top(three.map(|x| -x)).0).max(least)
        };
        let rest = self.comes_from_rest().then_some(rest);
        rest.into_iter().chain(self.met(run).into_iter().map(turned)).collect()
    }

    /// The one cycle that does the damage of a pass, by the cycles of a value that is `rest` without load and at least `least`.
    pub(super) fn counted(
        &self,
        exponent: f64,
        [rest, least]: [f64; 2],
        value: &impl Fn(&Self, usize) -> f64,
    ) -> Equivalent {
        let mut cycles = Cycles::default();
        let runs = self.ordered.div_ceil(self.run.max(1));
        let times = self.times / runs.max(1) as f64;
        for run in 0..runs {
            let there = self.sequence(run, rest, least, value);
            let Some(back) = self.back else {
                cycles.count(&there, times);
                continue;
            };
            let of_back = back.sequence(run, rest, least, value);
            // Once the last cycle there and the first one back are one.
            let joined = times.min(1.0 / runs as f64);
            for way in [&there, &of_back] {
                cycles.count(way, times - joined);
            }
            cycles.count(&self.there_and_back(run, there, (back, of_back)), joined);
        }
        cycles.equivalent(exponent)
    }

    /// Values along a line and back: from rest to rest, or where it closes for the point that is passed last with the largest value.
    fn there_and_back(&self, run: usize, mut there: Vec<f64>, (back, mut of_back): (&Self, Vec<f64>)) -> Vec<f64> {
        if !self.comes_from_rest() {
            let most = first_largest(there.iter().copied()).map_or(0, |(most, _)| most);
            let number = self.met(run)[most];
            let sample = number.checked_sub(self.ordered).map_or(number, |edge| self.edges[edge] as usize);
            let same = back.met(run).iter().position(|k| *k == sample).unwrap_or(0);
            there.rotate_left(most);
            of_back.rotate_left(same);
        }
        // Each way ends as it begins.
        for way in [&mut there, &mut of_back] {
            way.extend_from_within(..1);
        }
        there.into_iter().chain(of_back.into_iter().rev()).collect()
    }
}

/// The longest cycle of all directions within a `turn`, from the first one on, which has that of a single cycle.
pub(super) fn most_damaging(first: f64, turn: f64, toward: impl Fn(f64) -> Equivalent) -> Equivalent {
    let mut apart = PI / DIRECTIONS as f64;
    let mut best = (first, toward(first));
    let longer = |best: (f64, Equivalent), angle: f64| {
        let cycle = toward(angle);
        if cycle.range > best.1.range { (angle, cycle) } else { best }
    };
    for k in 1..(turn / apart).round() as usize {
        best = longer(best, first + apart * k as f64);
    }
    for _ in 0..HALVINGS {
        apart *= 0.5;
        let middle = best.0;
        best = [-apart, apart].into_iter().fold(best, |best, by| longer(best, middle + by));
    }
    best.1
}
