//! Damage of the body below its surface, carried with the material.
//!
//! In the frame of the original surface the damage D(y, Z) of a material grows in each pass by Q(y, z), the damage of the law of fatigue
//! at the depth z = Z − r below the present surface, r what has come off ([`Rates`]): D = ∫ Q dN. It is kept at nodes, equally far apart
//! over the depth of each material, on the lines y of the path under the unworn contact; what has come off is dropped. Of an interface
//! the largest damage counts.

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
const FAILED: f64 = 1e-9;

/// Damage of a body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Damage {
    /// y of each line across the path, lengths.
    y: Vec<f64>,
    /// Of each material with a law of fatigue, from the original surface down.
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

/// Where damage reaches 1 next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Failure {
    /// What fails: the number of a material or an interface of the original body.
    pub place: FailurePlace,
    /// Passes from now on.
    pub passes: f64,
    /// Depth in the original body, a length.
    pub depth: f64,
}

/// What fails.
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
        let laws = (1..).zip(original.durabilities()).filter(|(_, own)| own.fatigue.is_some());
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

    /// Adds the damage of some passes on a surface `removed` below the original one.
    pub fn add(&mut self, rates: &Rates, passes: f64, removed: f64) {
        for own in &mut self.materials {
            own.add(rates, passes, removed, self.y.len());
        }
        self.interfaces.iter_mut().zip(&rates.interfaces).for_each(|(own, rate)| *own += passes * rate);
    }

    /// Where the damage of what is left reaches 1 first at these rates; `None` where it never does.
    pub fn next_failure(&self, original: &HalfSpace, rates: &Rates, removed: f64) -> Option<Failure> {
        let materials = self.materials.iter().filter_map(|own| own.next_failure(rates, removed, self.y.len()));
        let faces = original.interface_depths();
        let interfaces = (1..).zip(self.interfaces.iter().zip(&rates.interfaces)).zip(&faces);
        let interfaces = interfaces.filter(|((_, (_, rate)), face)| **rate > 0.0 && **face > removed).map(
            |((number, (own, rate)), &face)| Failure {
                place: FailurePlace::Interface(number),
                passes: ((1.0 - own) / rate).max(0.0),
                depth: face,
            },
        );
        // Of failures at the same time the deepest: it takes the others with it.
        materials
            .chain(interfaces)
            .reduce(|a, b| if b.passes < a.passes || (b.passes == a.passes && b.depth > a.depth) { b } else { a })
    }

    /// Depth of the layer that comes off at least when a material fails at a depth: to the next node below the surface.
    pub fn slice(&self, place: FailurePlace, removed: f64) -> f64 {
        let FailurePlace::Material(number) = place else { return 0.0 };
        let own = self.materials.iter().find(|own| own.material == number);
        own.map_or(0.0, |own| {
            let next = ((removed - own.top) / own.spacing + 1e-9).floor() + 1.0;
            (own.top + next * own.spacing).min(own.bottom) - removed
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
            let own = &mut self.damage[node * lines..(node + 1) * lines];
            if let Some(rates) = rates.at(self.material, z.max(0.0)) {
                own.iter_mut().zip(rates).for_each(|(own, rate)| *own += passes * rate);
            }
        }
    }

    fn next_failure(&self, rates: &Rates, removed: f64, lines: usize) -> Option<Failure> {
        let nodes = self.count(removed + rates.deepest(self.material)?);
        let mut next: Option<Failure> = None;
        for node in self.first(removed)..nodes {
            let depth = self.depth(node);
            let done = |line: usize| {
                let kept = node.checked_sub(self.gone).and_then(|node| self.damage.get(node * lines + line));
                kept.copied().unwrap_or(0.0)
            };
            let rates = rates.at(self.material, (depth - removed).max(0.0)).into_iter().flatten().enumerate();
            // What failed at this depth has made the surface, and fails no more.
            let is_surface = depth - removed < SURFACE * self.spacing;
            let lasts = |(line, rate): &(usize, f64)| *rate > 0.0 && !(is_surface && done(*line) > 1.0 - FAILED);
            let passes = rates.filter(lasts).map(|(line, rate)| ((1.0 - done(line)) / rate).max(0.0));
            let passes = passes.fold(f64::INFINITY, f64::min);
            // Of failures at the same time the deepest: it takes the others with it.
            if passes.is_finite() && next.is_none_or(|next| passes <= next.passes) {
                next = Some(Failure { place: FailurePlace::Material(self.material), passes, depth });
            }
        }
        next
    }
}
