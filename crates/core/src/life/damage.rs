//! Damage of the body below its surface, carried with the material.
//!
//! In the frame of the original surface the damage D(y, Z) of a material grows in each pass by Q(y, z), the damage of the law of fatigue
//! at the depth z = Z − r below the present surface, r what has come off ([`Rates`]): D = ∫ Q dN. It is kept at nodes, equally far apart
//! over the depth of each material, on the lines y of the path under the unworn contact, and where the window of an isolated contact
//! grows on those of the wider one; what has come off is dropped. Where a node fails below the surface, the depth that fails first is that
//! of the parabola through its damage and that of the nodes beside it. Of an interface the largest damage counts.

use super::rates::Rates;
use crate::body::{Durability, HalfSpace};
use crate::numeric::serialised;
use crate::stress::RangePlane;
use serde::{Deserialize, Serialize};

/// Nodes of a layer as thick as the smallest contact radius or thinner, and nodes to that radius in thicker ones and in the substrate;
/// fewer where the largest radius would have more than 512.
const NODES: f64 = 64.0;
const MOST_NODES: f64 = 512.0;
/// Part of the distance of nodes within which one is at the surface, and of the damage within which it has failed.
const SURFACE: f64 = 1e-6;
/// Distances of nodes below the first one down to which what fails is wear of the surface.
const UNRESOLVED: f64 = 1.5;
const FAILED: f64 = 1e-9;

/// Damage of a body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Damage {
    /// y of each line across the path, lengths.
    y: Vec<f64>,
    /// Damage of each material with a law of fatigue, from the original surface down.
    materials: Vec<MaterialDamage>,
    /// Largest damage of each interface, from the original surface down; those that have come off keep theirs.
    interfaces: Vec<f64>,
}

/// Damage of a material.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct MaterialDamage {
    /// Number of the material in the original body, from 1.
    material: usize,
    /// Depth of its upper face in the original body, a length.
    top: f64,
    /// Depth of its lower face, infinite for the substrate, a length.
    #[serde(deserialize_with = "serialised::infinite")]
    bottom: f64,
    /// Distance of nodes, a length.
    spacing: f64,
    /// Number of nodes from the upper face on that have come off.
    gone: usize,
    /// Damage at the nodes that are left, all lines of a node one after the other, from the upper one down, as deep as damage was done.
    damage: Vec<f64>,
}

/// The next failure: damage reaches 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Failure {
    /// Material or interface that fails, by its number in the original body.
    pub place: FailurePlace,
    /// Passes from now on.
    pub passes: f64,
    /// Depth in the original body, a length.
    pub depth: f64,
}

/// Material or interface that fails.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FailurePlace {
    /// The material of this number.
    Material(usize),
    /// The interface of this number.
    Interface(usize),
}

impl Damage {
    /// No damage in a body, on the lines of `planes`; `radii`: the smallest and the largest contact radius, lengths.
    pub fn none(original: &HalfSpace, [smallest, largest]: [f64; 2], planes: &[RangePlane]) -> Self {
        let radius = smallest.max(largest * NODES / MOST_NODES);
        let laws = (1..).zip(original.durabilities()).filter(|(_, durability)| durability.fatigue.is_some());
        let material = |(number, _): (usize, Durability)| {
            let (top, bottom) = original.faces(number);
            let thickness = bottom - top;
            let spacing = if thickness.is_finite() {
                thickness / (NODES * (thickness / radius).max(1.0)).ceil()
            } else {
                radius / NODES
            };
            MaterialDamage { material: number, top, bottom, spacing, gone: 0, damage: Vec::new() }
        };
        let y = planes.first().map_or(Vec::new(), |plane| plane.y().collect());
        Self { y, materials: laws.map(material).collect(), interfaces: vec![0.0; original.layers().len()] }
    }

    /// y of each line across the path, lengths.
    pub(super) fn y(&self) -> &[f64] {
        &self.y
    }

    /// Follows the lines of `planes` beyond those followed so far too, in a wider window, without damage until then.
    /// Damage there was less than on the outermost line so far: ranges fall with the distance from a contact.
    pub fn widen(&mut self, planes: &[RangePlane]) {
        let (Some(plane), &[first, second, ..], &[.., before, last]) = (planes.first(), &self.y[..], &self.y[..])
        else {
            return;
        };
        // Planes on fewer or more points of the same window end half a distance of lines elsewhere, or less.
        let (lower, upper) = (first - 0.5 * (second - first), last + 0.5 * (last - before));
        let left: Vec<f64> = plane.y().filter(|y| *y < lower).collect();
        let right: Vec<f64> = plane.y().filter(|y| *y > upper).collect();
        let none = [&left, &right].map(|lines| vec![0.0; lines.len()]);
        for material in &mut self.materials {
            let wider = |node: &[f64]| [&none[0], node, &none[1]].concat();
            material.damage = material.damage.chunks(self.y.len()).flat_map(wider).collect();
        }
        self.y = [&left[..], &self.y, &right].concat();
    }

    /// Adds the damage of some passes on a surface `removed` below the original one.
    pub fn add(&mut self, rates: &Rates, passes: f64, removed: f64) {
        for material in &mut self.materials {
            material.add(rates, passes, removed, self.y.len());
        }
        self.interfaces.iter_mut().zip(&rates.interfaces).for_each(|(damage, rate)| *damage += passes * rate);
    }

    /// First failure of what is left at these rates; `None` where damage never reaches 1.
    pub fn next_failure(&self, original: &HalfSpace, rates: &Rates, removed: f64) -> Option<Failure> {
        let materials =
            self.materials.iter().filter_map(|material| material.next_failure(rates, removed, self.y.len()));
        let faces = original.interface_depths();
        let interfaces = (1..).zip(self.interfaces.iter().zip(&rates.interfaces)).zip(&faces);
        let interfaces = interfaces.filter(|((_, (_, rate)), face)| **rate > 0.0 && **face > removed).map(
            |((number, (damage, rate)), &face)| Failure {
                place: FailurePlace::Interface(number),
                passes: ((1.0 - damage) / rate).max(0.0),
                depth: face,
            },
        );
        // The deepest of failures at the same time takes the others with it.
        materials
            .chain(interfaces)
            .reduce(|a, b| if b.passes < a.passes || (b.passes == a.passes && b.depth > a.depth) { b } else { a })
    }

    /// Depth of the layer that comes off at least when a material fails at a depth, to the next node below the surface, and the largest
    /// depth at which this is wear of the surface, one node and a half deeper: nodes resolve no thinner fragments.
    pub fn slice(&self, place: FailurePlace, removed: f64) -> [f64; 2] {
        let FailurePlace::Material(number) = place else { return [0.0; 2] };
        let material = self.materials.iter().find(|material| material.material == number);
        material.map_or([0.0; 2], |material| {
            let next = ((removed - material.top) / material.spacing + 1e-9).floor() + 1.0;
            let slice = (material.top + next * material.spacing).min(material.bottom) - removed;
            [slice, slice + UNRESOLVED * material.spacing]
        })
    }
}

impl MaterialDamage {
    /// Depth of a node in the original body, by its number from the upper face on.
    fn depth(&self, node: usize) -> f64 {
        (self.top + node as f64 * self.spacing).min(self.bottom)
    }

    /// Number of the first node at or below the surface.
    fn first(&self, removed: f64) -> usize {
        ((removed - self.top) / self.spacing - 1e-9).ceil().max(0.0) as usize
    }

    /// Number of nodes down to a depth in the original body.
    fn count(&self, depth: f64) -> usize {
        ((depth.min(self.bottom) - self.top) / self.spacing + 1e-9).floor().max(-1.0) as usize + 1
    }

    fn add(&mut self, rates: &Rates, passes: f64, removed: f64, lines: usize) {
        let first = self.first(removed);
        let off = first.saturating_sub(self.gone);
        self.damage.drain(..(off * lines).min(self.damage.len()));
        self.gone += off;
        let Some(deepest) = rates.deepest(self.material) else { return };
        let nodes = self.count(removed + deepest).saturating_sub(self.gone);
        // Deeper than any plane no damage was done.
        if self.damage.len() < nodes * lines {
            self.damage.resize(nodes * lines, 0.0);
        }
        for node in 0..nodes {
            let z = self.depth(self.gone + node) - removed;
            let row = &mut self.damage[node * lines..(node + 1) * lines];
            if let Some(rates) = rates.at(self.material, z.max(0.0)) {
                row.iter_mut().zip(rates).for_each(|(damage, rate)| *damage += passes * rate);
            }
        }
    }

    /// Damage at a node on a line, which is none where none was done.
    fn done(&self, node: usize, line: usize, lines: usize) -> f64 {
        let kept = node.checked_sub(self.gone).and_then(|node| self.damage.get(node * lines + line));
        kept.copied().unwrap_or(0.0)
    }

    fn next_failure(&self, rates: &Rates, removed: f64, lines: usize) -> Option<Failure> {
        let nodes = self.first(removed)..self.count(removed + rates.deepest(self.material)?);
        let mut next: Option<(f64, usize, usize)> = None;
        for node in nodes.clone() {
            let depth = self.depth(node) - removed;
            let rates = rates.at(self.material, depth.max(0.0)).into_iter().flatten().enumerate();
            // A failure at this depth has made the surface, which fails no more.
            let is_surface = depth < SURFACE * self.spacing;
            for (line, rate) in rates.filter(|(_, rate)| *rate > 0.0) {
                let done = self.done(node, line, lines);
                let passes = ((1.0 - done) / rate).max(0.0);
                // The deepest of failures at the same time takes the others with it.
                let is_next = next.is_none_or(|(least, last, _)| passes < least || (passes == least && node > last));
                if is_next && passes.is_finite() && !(is_surface && done > 1.0 - FAILED) {
                    next = Some((passes, node, line));
                }
            }
        }
        let (passes, node, line) = next?;
        let (passes, depth) = if nodes.start < node && node + 1 < nodes.end && passes > 0.0 {
            self.between_nodes(rates, removed, (passes, node), (line, lines))
        } else {
            (passes, self.depth(node))
        };
        Some(Failure { place: FailurePlace::Material(self.material), passes, depth })
    }

    /// Passes and depth of the failure beside a node that fails after some `passes`, by the parabola through its damage then, which is 1,
    /// and that of the nodes beside it.
    fn between_nodes(
        &self,
        rates: &Rates,
        removed: f64,
        (passes, node): (f64, usize),
        (line, lines): (usize, usize),
    ) -> (f64, f64) {
        let rate = |depth: f64| {
            let found = rates.at(self.material, depth - removed).and_then(|mut all| all.nth(line));
            found.unwrap_or(0.0)
        };
        let then = |node: usize| self.done(node, line, lines) + passes * rate(self.depth(node));
        let [above, below] = [node - 1, node + 1].map(|node| 1.0 - then(node));
        let bend = above + below;
        if !(bend > 0.0 && above >= 0.0 && below >= 0.0) {
            return (passes, self.depth(node));
        }
        let moved = 0.5 * (above - below) / bend;
        let depth = (self.depth(node) + moved * self.spacing).min(self.bottom);
        let beyond = 0.5 * bend * moved * moved;
        ((passes - beyond / rate(depth)).max(0.0), depth)
    }
}
