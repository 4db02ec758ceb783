//! Conditions at the surface and the interfaces that the thermal stress obeys, as one system of equations.
//!
//! The surface is free, F = F′ = 0. Across interfaces F, F′, u_z and u_q are continuous (bonded); F′ = 0 on both sides, F and u_z are
//! continuous (frictionless); u_z and u_q jump by F/k_n and F′/k_t (spring). At a rigid base u_z = u_q = 0 below the interface. The
//! unknowns are the numbers of the stress function of each material, every exponential anchored where it is largest: four in a layer, two
//! in the substrate.

use super::expanding_material::{ExpandingMaterial, Face};
use crate::body::Interface;
use crate::numeric::linear::solve;
use crate::numeric::search::largest;
use rustfft::num_complex::Complex64;

/// Conditions at the surface and the interfaces on the numbers of all materials.
pub(super) struct Conditions {
    columns: usize,
    rows: Vec<Vec<f64>>,
    right: Vec<Complex64>,
}

/// A quantity at a face, the row of it, of a material, times a factor.
#[derive(Clone, Copy)]
struct Term<'a> {
    material: usize,
    row: usize,
    face: &'a Face,
    factor: f64,
}

impl Conditions {
    /// Conditions on materials from the surface down, the interfaces below all layers.
    pub fn of(materials: &[ExpandingMaterial], interfaces: &[Interface]) -> Self {
        let mut system = Self {
            columns: 4 * interfaces.len() + 2 * (materials.len() - interfaces.len()),
            rows: vec![],
            right: vec![],
        };
        let top = materials[0].face(0.0);
        system.hold(&[Term { material: 0, row: 0, face: &top, factor: 1.0 }]);
        system.hold(&[Term { material: 0, row: 1, face: &top, factor: 1.0 }]);
        for (number, &interface) in interfaces.iter().enumerate() {
            let material = &materials[number];
            let upper = material.face(material.heat.thickness);
            let lower = materials.get(number + 1).map(|next| next.face(0.0));
            let twice = 2.0 * material.heat.rate.wavenumber;
            let (closure, slip) = match interface {
                Interface::Spring { tangential, normal } => (twice / normal, Some(twice / tangential)),
                Interface::Bonded => (0.0, Some(0.0)),
                Interface::Frictionless => (0.0, None),
            };
            let above = |row: usize, factor: f64| vec![Term { material: number, row, face: &upper, factor }];
            let below = |row: usize| lower.as_ref().map(|face| Term { material: number + 1, row, face, factor: -1.0 });
            // Continuity between two faces; a rigid base below has no displacement.
            let both = |row: usize| above(row, 1.0).into_iter().chain(below(row)).collect::<Vec<_>>();
            let jumps = |row: usize, of: usize, factor: f64| [both(row), above(of, factor)].concat();
            system.hold(&jumps(2, 0, -closure));
            system.hold(&slip.map_or(above(1, 1.0), |slip| jumps(3, 1, slip)));
            if let Some(shear_below) = below(1) {
                system.hold(&both(0));
                system.hold(&slip.map_or(vec![shear_below], |_| both(1)));
            }
        }
        system
    }

    /// Adds the condition that a sum is zero.
    fn hold(&mut self, terms: &[Term<'_>]) {
        let (mut entries, mut right) = (vec![0.0; self.columns], Complex64::default());
        for &Term { material, row, face, factor } in terms {
            // Of the substrate two numbers are zero.
            for (entry, number) in entries[4 * material..].iter_mut().zip(face.rows[row]) {
                *entry += factor * number;
            }
            right -= face.goodier[row] * factor;
        }
        self.rows.push(entries);
        self.right.push(right);
    }

    /// Numbers of each material. Columns, then rows are scaled to 1, so that pivots of soft and of thin layers count.
    pub fn solution(mut self) -> Vec<[Complex64; 4]> {
        let column = |number: usize| largest(self.rows.iter().map(|row| row[number].abs()));
        let scales: Vec<f64> = (0..self.columns).map(column).collect();
        for (row, right) in self.rows.iter_mut().zip(&mut self.right) {
            row.iter_mut().zip(&scales).for_each(|(entry, scale)| *entry /= scale);
            let scale = largest(row.iter().map(|entry| entry.abs()));
            row.iter_mut().for_each(|entry| *entry /= scale);
            *right /= scale;
        }
        let found = solve(self.rows, self.right).expect("an elastic body with a free surface has one solution");
        let found: Vec<_> = found.into_iter().zip(scales).map(|(number, scale)| number / scale).collect();
        let padded = |numbers: &[Complex64]| std::array::from_fn(|k| numbers.get(k).copied().unwrap_or_default());
        found.chunks(4).map(padded).collect()
    }
}
