//! The reading of a vertical section: its stresses measure by measure, the largest of each, and the measure that governs failure.

use super::Criterion;
use crate::body::{Depth, HalfSpace, InterfaceStrength, StrainDirection};
use crate::stress::{SAME_IN_SECTION, StressState, VerticalSection};
use ndarray::Array2;

/// A scalar stress measure that a section shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SectionMeasure {
    /// Normal stress along the line: tension and compression, σ_r of the paper when the line begins at an axis.
    Along,
    /// Principal shear stress τ₁.
    Tau1,
    /// Von Mises stress.
    Mises,
    /// Largest principal stress σ₁.
    Tension,
    /// Shear of a horizontal plane, √(σ_xz² + σ_yz²).
    Shear,
    /// Normal stress of a horizontal plane, σ_zz.
    Opening,
}

/// The largest value of a measure in a section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LargestInSection {
    /// The value, in the unit of Young's modulus.
    pub value: f64,
    /// Distance along the line, a length.
    pub s: f64,
    /// The depth.
    pub depth: Depth,
}

impl VerticalSection {
    /// Measure that brings about failure by a criterion; for an interface the one that contributes most where the utilisation is
    /// largest.
    pub fn governing_measure(&self, criterion: Criterion, half_space: &HalfSpace) -> SectionMeasure {
        let interface = match criterion {
            Criterion::Yield(_) | Criterion::Crossland(_) => return SectionMeasure::Mises,
            Criterion::DangVan(_) => return SectionMeasure::Tau1,
            Criterion::Cracking(_) => return SectionMeasure::Tension,
            Criterion::StrainLife(material) => {
                let law = half_space.durabilities().nth(material.number - 1).and_then(|last| last.strain_life);
                let is_pressed = law.is_some_and(|law| law.direction() == StrainDirection::Compression);
                return if is_pressed { SectionMeasure::Opening } else { SectionMeasure::Along };
            }
            Criterion::Delamination(interface) => interface.number,
        };
        let strength = half_space.layers()[interface - 1].interface_strength();
        let (opening, shear) =
            (InterfaceStrength { shear: None, ..strength }, InterfaceStrength { normal: None, ..strength });
        let taken = |of: InterfaceStrength, state: &StressState| of.utilisation(state.zz, state.interface_shear());
        let below = self.depths.iter().position(|depth| depth.material == interface + 1);
        let states = below.into_iter().flat_map(|row| self.states.row(row));
        let worst = states.max_by(|a, b| taken(strength, a).total_cmp(&taken(strength, b)));
        let opens = worst.map_or(strength.shear.is_none(), |state| taken(opening, state) > taken(shear, state));
        if opens { SectionMeasure::Opening } else { SectionMeasure::Shear }
    }

    /// A measure of a state, in the unit of Young's modulus.
    pub fn measure(&self, measure: SectionMeasure, state: &StressState) -> f64 {
        match measure {
            SectionMeasure::Along => state.along(self.line.direction),
            SectionMeasure::Tau1 => state.tau1(),
            SectionMeasure::Mises => state.mises(),
            SectionMeasure::Tension => state.principal()[0],
            SectionMeasure::Shear => state.interface_shear(),
            SectionMeasure::Opening => state.zz,
        }
    }

    /// All values of a measure; axes as of the states.
    pub fn values(&self, measure: SectionMeasure) -> Array2<f64> {
        self.states.map(|state| self.measure(measure, state))
    }

    /// The largest value of a measure; `None` in a section without points.
    pub fn largest(&self, measure: SectionMeasure) -> Option<LargestInSection> {
        let (distances, values) = (self.line.distances(), self.values(measure));
        // On the surface σ₁ is at least the stress along the line, which is known between the points.
        let is_along = matches!(measure, SectionMeasure::Along | SectionMeasure::Tension);
        let surface = self.depths.first().filter(|_| is_along).zip(self.highest);
        let mut best = surface.map(|(&depth, [s, value])| LargestInSection { value, s, depth });
        for (row, &depth) in values.outer_iter().zip(&self.depths) {
            for (&value, &s) in row.iter().zip(&distances) {
                if best.is_none_or(|best| value > best.value + SAME_IN_SECTION * value.abs()) {
                    best = Some(LargestInSection { value, s, depth });
                }
            }
        }
        best
    }

    /// Depths of the interfaces within the section, lengths.
    pub fn interfaces(&self) -> Vec<f64> {
        self.depths.windows(2).filter(|pair| pair[0].material != pair[1].material).map(|pair| pair[1].z).collect()
    }

    /// Indices of the rows on the surface and on both sides of each interface.
    pub fn face_rows(&self) -> Vec<usize> {
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
        let bears = |normal, shear| InterfaceStrength { normal, shear, friction: 0.0 };
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
            section.governing_measure(Criterion::delamination_of(1), &HalfSpace::new(vec![layer], material))
        };
        assert_eq!(shown([1.0, 2.0], bears(Some(1.0), None)), SectionMeasure::Opening);
        assert_eq!(shown([1.0, 0.1], bears(None, Some(1.0))), SectionMeasure::Shear);
        assert_eq!(shown([1.0, 2.0], bears(Some(1.0), Some(1.0))), SectionMeasure::Shear);
        assert_eq!(shown([1.0, 2.0], bears(Some(1.0), Some(4.0))), SectionMeasure::Opening);
        assert_eq!(shown([-1.0, 0.2], bears(Some(1.0), Some(4.0))), SectionMeasure::Shear);
    }

    #[test]
    fn the_largest_value_on_the_surface_may_lie_between_the_points() {
        let depths = [(0.0, 1), (1.0, 1), (1.0, 2), (2.0, 2)].map(|(z, material)| Depth { z, material }).to_vec();
        let line = SurfaceLine { origin: [0.0; 2], direction: [2.0, 0.0], span: [0.0, 1.0], points: 3 };
        let rows = [1.0, 3.0, -2.0, -1.0];
        let states = Array2::from_shape_fn((4, 3), |(row, _)| StressState { xx: rows[row], ..StressState::default() });
        let section = VerticalSection { line, depths, states, highest: None };
        assert_eq!(section.interfaces(), [1.0]);
        assert_eq!(section.face_rows(), [0, 1, 2]);
        assert_eq!(section.largest(SectionMeasure::Along).unwrap().value, 3.0);
        let sharp = VerticalSection { highest: Some([0.3, 3.2]), ..section };
        assert_eq!(sharp.largest(SectionMeasure::Along).map(|largest| (largest.s, largest.value)), Some((0.3, 3.2)));
        assert_eq!(sharp.largest(SectionMeasure::Tension).unwrap().value, 3.2);
        assert!((sharp.largest(SectionMeasure::Tau1).unwrap().value - 1.5).abs() < 1e-12);
    }
}
