//! A section row by row: values of a stress, interfaces, the largest.

use super::contour::zero_lines;
use crate::body::{Depth, HalfSpace, InterfaceStrength};
use crate::reading::Criterion;
use crate::stress::{StressState, VerticalSection};
use ndarray::Array2;

/// A stress that the pictures show.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// The normal stress along the line: tension and compression, σ_r of the paper when it begins at an axis.
    Along,
    /// The principal shear stress τ₁.
    Tau1,
    /// The stress of von Mises.
    Mises,
    /// The largest principal stress σ₁.
    Tension,
    /// What shears a horizontal plane, √(σ_xz² + σ_yz²).
    Shear,
    /// What opens a horizontal plane, σ_zz.
    Opening,
}

impl Quantity {
    /// Its name and symbol.
    pub fn named(self) -> [&'static str; 2] {
        match self {
            Self::Along => ["stress along the section", "σₛ"],
            Self::Tau1 => ["principal shear stress", "τ₁"],
            Self::Mises => ["stress of von Mises", "σᵥ"],
            Self::Tension => ["largest principal stress", "σ₁"],
            Self::Shear => ["shear of horizontal planes", "τ"],
            Self::Opening => ["normal stress of horizontal planes", "σₙ"],
        }
    }
}

/// Where a stress is largest in a section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Largest {
    /// The value.
    pub value: f64,
    /// Distance along the line.
    pub s: f64,
    /// Where in depth.
    pub depth: Depth,
}

impl VerticalSection {
    /// What brings about failure by a criterion: of an interface, what contributes most where most is taken up.
    pub(super) fn failing(&self, criterion: Criterion, half_space: &HalfSpace) -> Quantity {
        let interface = match criterion {
            Criterion::Yield { .. } => return Quantity::Mises,
            Criterion::Cracking { .. } => return Quantity::Tension,
            Criterion::Delamination { interface } => interface,
        };
        let strength = half_space.layers()[interface - 1].interface_strength();
        let (opening, shear) =
            (InterfaceStrength { shear: None, ..strength }, InterfaceStrength { normal: None, ..strength });
        let taken = |of: InterfaceStrength, state: &StressState| of.utilisation(state.zz, state.interface_shear());
        let below = self.depths.iter().position(|depth| depth.material == interface + 1);
        let states = below.into_iter().flat_map(|row| self.states.row(row));
        let worst = states.max_by(|a, b| taken(strength, a).total_cmp(&taken(strength, b)));
        let opens = worst.map_or(strength.shear.is_none(), |state| taken(opening, state) > taken(shear, state));
        if opens { Quantity::Opening } else { Quantity::Shear }
    }

    /// The stress of a state.
    pub(super) fn stress(&self, quantity: Quantity, state: &StressState) -> f64 {
        match quantity {
            Quantity::Along => state.along(self.line.direction),
            Quantity::Tau1 => state.tau1(),
            Quantity::Mises => state.mises(),
            Quantity::Tension => state.principal()[0],
            Quantity::Shear => state.interface_shear(),
            Quantity::Opening => state.zz,
        }
    }

    /// All values of a stress; axes as of the states.
    pub(super) fn values(&self, quantity: Quantity) -> Array2<f64> {
        self.states.map(|state| self.stress(quantity, state))
    }

    /// Value at a distance along the line and a depth, between the nearest rows of its material.
    pub(super) fn at(&self, values: &Array2<f64>, s: f64, z: f64) -> Option<f64> {
        let below = self.depths.partition_point(|depth| depth.z <= z);
        let (before, after) = (below.checked_sub(1)?, below.min(self.depths.len() - 1));
        let [z0, z1] = [before, after].map(|row| self.depths[row].z);
        let t = if z1 > z0 { (z - z0) / (z1 - z0) } else { 0.0 };
        let count = self.line.points;
        let [first, last] = self.line.span;
        let place = ((s - first) / (last - first) * (count - 1) as f64).clamp(0.0, (count - 1) as f64);
        let column = (place as usize).min(count - 2);
        let u = place - column as f64;
        let at = |row: usize| (1.0 - u) * values[[row, column]] + u * values[[row, column + 1]];
        Some((1.0 - t) * at(before) + t * at(after))
    }

    /// The largest of a stress.
    pub(super) fn largest(&self, quantity: Quantity) -> Option<Largest> {
        let (distances, values) = (self.line.distances(), self.values(quantity));
        let surface = self.depths.first().filter(|_| quantity == Quantity::Along).zip(self.highest);
        let mut best = surface.map(|(&depth, [s, value])| Largest { value, s, depth });
        for (row, &depth) in values.outer_iter().zip(&self.depths) {
            for (&value, &s) in row.iter().zip(&distances) {
                if best.is_none_or(|best| value > best.value) {
                    best = Some(Largest { value, s, depth });
                }
            }
        }
        best
    }

    /// Lines (s, z) on which values are zero. Each material has its own, as a stress may jump over zero at an interface.
    pub(super) fn zero_lines(&self, values: &Array2<f64>) -> Vec<Vec<[f64; 2]>> {
        const ROWS: f64 = 140.0;
        let [first, last] = self.line.span;
        let deepest = self.depths.last().map_or(1.0, |depth| depth.z);
        let bounds = [vec![0.0], self.interfaces(), vec![deepest]].concat();
        let within = |ends: &[f64]| {
            // A depth on an interface belongs to what lies below.
            let thickness = (ends[1] - ends[0]) * (1.0 - 1e-9);
            let place = |[u, v]: [f64; 2]| [first + u * (last - first), ends[0] + v * thickness];
            let rows = (ROWS * thickness / deepest).ceil().max(10.0) as usize;
            let value = |part: [f64; 2]| self.at(values, place(part)[0], place(part)[1]);
            let lines = zero_lines(200, rows, value).into_iter();
            lines.map(|line| line.into_iter().map(place).collect()).collect::<Vec<Vec<[f64; 2]>>>()
        };
        bounds.windows(2).filter(|ends| ends[0] < ends[1]).flat_map(within).collect()
    }

    /// Depths of the interfaces within the section.
    pub(super) fn interfaces(&self) -> Vec<f64> {
        self.depths.windows(2).filter(|pair| pair[0].material != pair[1].material).map(|pair| pair[1].z).collect()
    }

    /// The rows on the surface and on both sides of each interface, by their index.
    pub(super) fn face_rows(&self) -> Vec<usize> {
        let sides = self.depths.windows(2).enumerate().filter(|(_, pair)| pair[0].material != pair[1].material);
        let surface = (self.depths.first().is_some_and(|depth| depth.z == 0.0)).then_some(0);
        surface.into_iter().chain(sides.flat_map(|(row, _)| [row, row + 1])).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{Interface, Layer, Material, Strength};
    use crate::stress::SurfaceLine;

    #[test]
    fn an_interface_shows_what_contributes_most_to_its_failure() {
        let bears = |normal, shear| InterfaceStrength { normal, shear };
        let shown = |[zz, xz]: [f64; 2], bears: InterfaceStrength| {
            let material = Material::from_young(1.0, 0.3).unwrap();
            let layer = Layer::new(material, 1.0, Interface::Bonded).unwrap();
            let layer = layer.with_strengths(Strength::default(), bears).unwrap();
            let depths = [(0.0, 1), (1.0, 1), (1.0, 2)].map(|(z, material)| Depth { z, material }).to_vec();
            let line = SurfaceLine { origin: [0.0; 2], direction: [1.0, 0.0], span: [0.0, 1.0], points: 2 };
            // Worst at the second point of the interface; the surface does not count.
            let parts = [[9.0, 0.0], [0.1, 0.5], [0.1, 1.0]];
            let states = Array2::from_shape_fn((3, 2), |(row, column)| {
                let part = parts[row][column];
                StressState { zz: part * zz, xz: part * xz, ..StressState::default() }
            });
            let section = VerticalSection { line, depths, states, highest: None };
            section.failing(Criterion::Delamination { interface: 1 }, &HalfSpace::new(vec![layer], material))
        };
        assert_eq!(shown([1.0, 2.0], bears(Some(1.0), None)), Quantity::Opening);
        assert_eq!(shown([1.0, 0.1], bears(None, Some(1.0))), Quantity::Shear);
        assert_eq!(shown([1.0, 2.0], bears(Some(1.0), Some(1.0))), Quantity::Shear);
        assert_eq!(shown([1.0, 2.0], bears(Some(1.0), Some(4.0))), Quantity::Opening);
        assert_eq!(shown([-1.0, 0.2], bears(Some(1.0), Some(4.0))), Quantity::Shear);
    }

    #[test]
    fn values_are_taken_from_the_side_of_the_interface_where_they_are() {
        let depths = [(0.0, 1), (1.0, 1), (1.0, 2), (2.0, 2)].map(|(z, material)| Depth { z, material }).to_vec();
        let line = SurfaceLine { origin: [0.0; 2], direction: [2.0, 0.0], span: [0.0, 1.0], points: 3 };
        let rows = [1.0, 3.0, -2.0, -1.0];
        let states = Array2::from_shape_fn((4, 3), |(row, _)| StressState { xx: rows[row], ..StressState::default() });
        let section = VerticalSection { line, depths, states, highest: None };
        let values = section.values(Quantity::Along);
        assert!((section.at(&values, 0.3, 0.5).unwrap() - 2.0).abs() < 1e-12);
        assert_eq!(section.at(&values, 0.3, 0.999).map(f64::round), Some(3.0));
        assert_eq!(section.at(&values, 0.3, 1.001).map(f64::round), Some(-2.0));
        assert_eq!(section.interfaces(), [1.0]);
        assert_eq!(section.face_rows(), [0, 1, 2]);
        // Positive above the interface, negative below it, and zero nowhere.
        assert!(section.zero_lines(&values).is_empty());
        assert_eq!(section.zero_lines(&(&values - 2.0)).len(), 1);
        assert_eq!(section.largest(Quantity::Along).unwrap().value, 3.0);
        let sharp = VerticalSection { highest: Some([0.3, 3.2]), ..section };
        assert_eq!(sharp.largest(Quantity::Along).map(|largest| (largest.s, largest.value)), Some((0.3, 3.2)));
        assert!((sharp.largest(Quantity::Tau1).unwrap().value - 1.5).abs() < 1e-12);
    }
}
