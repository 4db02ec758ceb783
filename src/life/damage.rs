//! Damage of the body below its surface, carried with the material.
//!
//! In the frame of the original surface the damage D(y, Z) of a material grows in each pass by Q(y, z), the damage of the law of fatigue
//! at the depth z = Z − r below the present surface, r what has come off: D = ∫ Q dN. It is kept at nodes, a line of them at equal
//! distances in each material, for each line y of the path. Between the planes of a step the range of τ₁ is linear in depth. Of an
//! interface the largest damage counts.

use crate::body::{Fatigue, HalfSpace};
use crate::numeric::serialised;
use crate::reading::{FatiguePart, FatigueReading};
use crate::stress::RangePlane;
use serde::{Deserialize, Serialize};

/// Nodes of a layer as thick as the smallest contact radius or thinner, and nodes to that radius in thicker ones and in the substrate.
const NODES: f64 = 64.0;

/// Damage of a body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Damage {
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
    /// Number of lines y.
    lines: usize,
    /// Damage at the nodes, all lines of a node one after the other, from the upper face down, as deep as damage was done.
    damage: Vec<f64>,
}

/// Damage that one pass does on the present surface.
#[derive(Debug, Clone)]
pub struct Rates {
    /// Planes of each material of the original body with its law, in the frame of the present surface.
    materials: Vec<(usize, Fatigue, Vec<RangePlane>)>,
    /// Damage in a pass of each interface of the original body.
    interfaces: Vec<f64>,
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

impl Rates {
    /// Rates by the planes and the reading of a step, on a body of whose original `gone` layers have come off.
    pub fn new(original: &HalfSpace, gone: usize, planes: Vec<RangePlane>, reading: Option<&FatigueReading>) -> Self {
        let laws = (1..).zip(original.durabilities()).skip(gone);
        let of = |(number, own): (usize, crate::body::Durability)| {
            let law = own.fatigue?;
            let mut own: Vec<RangePlane> =
                planes.iter().filter(|plane| plane.depth.material + gone == number).cloned().collect();
            own.sort_by(|a, b| a.depth.z.total_cmp(&b.depth.z));
            (!own.is_empty()).then_some((number, law, own))
        };
        let mut interfaces = vec![0.0; original.layers().len()];
        for life in reading.iter().flat_map(|own| &own.lives) {
            if let FatiguePart::Interface(own) = life.part
                && !own.is_counterbody()
            {
                interfaces[own.number - 1 + gone] = life.damage;
            }
        }
        Self { materials: laws.filter_map(of).collect(), interfaces }
    }

    /// Whether any damage is done.
    pub fn is_any(&self) -> bool {
        !self.materials.is_empty() || self.interfaces.iter().any(|rate| *rate > 0.0)
    }

    /// Damage in a pass of a material at a depth below the present surface, on all lines; none below the deepest plane.
    fn of(&self, material: usize, z: f64) -> Option<impl Iterator<Item = f64> + '_> {
        let (_, law, planes) = self.materials.iter().find(|(number, ..)| *number == material)?;
        let last = planes.last().filter(|last| z <= last.depth.z)?;
        let after = planes.partition_point(|plane| plane.depth.z < z);
        let (above, below) = (&planes[after.saturating_sub(1)], planes.get(after).unwrap_or(last));
        let apart = below.depth.z - above.depth.z;
        let part = if apart > 0.0 { ((z - above.depth.z) / apart).clamp(0.0, 1.0) } else { 0.0 };
        let ranges = above.lines.iter().zip(&below.lines);
        Some(ranges.map(move |([_, above], [_, below])| law.damage(above + part * (below - above))))
    }

    /// Number of lines, and depth of the deepest plane of a material.
    fn extent(&self, material: usize) -> Option<(usize, f64)> {
        let (.., planes) = self.materials.iter().find(|(number, ..)| *number == material)?;
        planes.last().map(|last| (last.lines.len(), last.depth.z))
    }
}

impl Damage {
    /// No damage in a body; `radius`: the smallest contact radius, a length.
    pub fn none(original: &HalfSpace, radius: f64) -> Self {
        let laws = (1..).zip(original.durabilities()).filter(|(_, own)| own.fatigue.is_some());
        let material = |(number, _): (usize, crate::body::Durability)| {
            let (top, bottom) = original.faces(number);
            let thickness = bottom - top;
            let spacing = if thickness.is_finite() {
                thickness / (NODES * (thickness / radius).max(1.0)).ceil()
            } else {
                radius / NODES
            };
            MaterialDamage { material: number, top, bottom, spacing, lines: 0, damage: Vec::new() }
        };
        Self { materials: laws.map(material).collect(), interfaces: vec![0.0; original.layers().len()] }
    }

    /// Adds the damage of some passes on a surface `removed` below the original one.
    pub fn add(&mut self, rates: &Rates, passes: f64, removed: f64) {
        for own in &mut self.materials {
            own.add(rates, passes, removed);
        }
        self.interfaces.iter_mut().zip(&rates.interfaces).for_each(|(own, rate)| *own += passes * rate);
    }

    /// Where the damage of what is left reaches 1 first at these rates; `None` where it never does.
    pub fn next_failure(&self, original: &HalfSpace, rates: &Rates, removed: f64) -> Option<Failure> {
        let materials = self.materials.iter().filter_map(|own| own.next_failure(rates, removed));
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

    /// Largest damage of what is left of each material, with its number in the original body.
    pub fn largest(&self, removed: f64) -> Vec<(usize, f64)> {
        self.materials.iter().map(|own| (own.material, own.left(removed).fold(0.0, f64::max))).collect()
    }

    /// Profiles of the largest damage of all lines over the depth below the present surface: material, and [z, D] at its nodes.
    pub fn profiles(&self, removed: f64) -> Vec<(usize, Vec<[f64; 2]>)> {
        let of = |own: &MaterialDamage| {
            let at = |(node, values): (usize, &[f64])| {
                [own.depth(node) - removed, values.iter().copied().fold(0.0, f64::max)]
            };
            let nodes = own.damage.chunks(own.lines.max(1)).enumerate().map(at);
            (own.material, nodes.filter(|[z, _]| *z >= 0.0).collect())
        };
        self.materials.iter().map(of).collect()
    }
}

impl MaterialDamage {
    /// Depth of a node in the original body.
    fn depth(&self, node: usize) -> f64 {
        (self.top + node as f64 * self.spacing).min(self.bottom)
    }

    /// Number of the first node at or below the surface.
    fn first(&self, removed: f64) -> usize {
        ((removed - self.top) / self.spacing - 1e-9).ceil().max(0.0) as usize
    }

    /// Number of nodes down to a depth in the original body.
    fn count(&self, depth: f64) -> usize {
        ((depth.min(self.bottom) - self.top) / self.spacing + 1e-9).floor() as usize + 1
    }

    fn left(&self, removed: f64) -> impl Iterator<Item = f64> + '_ {
        self.damage.iter().copied().skip(self.first(removed) * self.lines)
    }

    fn add(&mut self, rates: &Rates, passes: f64, removed: f64) {
        let Some((lines, deepest)) = rates.extent(self.material) else { return };
        if self.lines == 0 {
            self.lines = lines;
        }
        let nodes = self.count(removed + deepest);
        // Deeper than any plane no damage was done.
        if self.damage.len() < nodes * self.lines {
            self.damage.resize(nodes * self.lines, 0.0);
        }
        for node in self.first(removed)..nodes {
            let z = self.depth(node) - removed;
            let own = &mut self.damage[node * self.lines..(node + 1) * self.lines];
            if let Some(rates) = rates.of(self.material, z) {
                own.iter_mut().zip(rates).for_each(|(own, rate)| *own += passes * rate);
            }
        }
    }

    fn next_failure(&self, rates: &Rates, removed: f64) -> Option<Failure> {
        let (lines, deepest) = rates.extent(self.material)?;
        let (first, nodes) = (self.first(removed), self.count(removed + deepest));
        let mut next: Option<Failure> = None;
        for node in first..nodes {
            let depth = self.depth(node);
            let done = |line: usize| self.damage.get(node * lines + line).copied().unwrap_or(0.0);
            let passes = rates.of(self.material, depth - removed).into_iter().flatten().enumerate();
            let passes =
                passes.filter(|(_, rate)| *rate > 0.0).map(|(line, rate)| ((1.0 - done(line)) / rate).max(0.0));
            let passes = passes.fold(f64::INFINITY, f64::min);
            if passes.is_finite() && next.is_none_or(|next| passes < next.passes) {
                next = Some(Failure { place: FailurePlace::Material(self.material), passes, depth });
            }
        }
        next
    }
}
