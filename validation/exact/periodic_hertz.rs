//! Circular contacts among their images: Galin's solution in the Taylor series of the periodic Green function.
//!
//! The images of level j, of load P_j and second moment M_j = ∫p r², curve the surface under level m by
//!
//! c₂ = Σ_j (P_j S₃/4 + 9 M_j S₅/16)/(πE*),  c₄ = Σ_j 9 P_j S₅/(64 πE*)
//!
//! and lift it by Σ_j (P_j S₁ + M_j S₃/4 + 9 M4_j S₅/64)/(πE*), S_n the sums from lattice j to a site of level m
//! ([`super::lattice_sums`]). The penetration δ is measured from the mean plane: it is the additional displacement w_a of
//! Goryacheva & Torskaya (2019), Eq. (8), for an infinite circle. What is left out is of the order (a/l)⁷, a the contact
//! radius and l the period; on coatings also a must stay well below the thickness.

use super::galin::{Contact, Term, paraboloid};
use super::lattice_sums::Sums;
use percoat_core::numeric::linear;
use std::f64::consts::PI;

/// Levels of indenters, one of each in the cell, that feel each other's images.
#[derive(Debug, Clone)]
pub struct System {
    /// Contact modulus of the surface material, a pressure.
    pub modulus: f64,
    /// `sums[m][j]`: what level j's lattice does to an indenter of level m.
    pub sums: Vec<Vec<Sums>>,
    /// Profile of each level.
    pub profiles: Vec<Vec<Term>>,
    /// Drop of each level below the highest one, a length.
    pub drops: Vec<f64>,
}

impl System {
    /// One level.
    pub fn single(modulus: f64, sums: Sums, profile: Vec<Term>) -> Self {
        Self { modulus, sums: vec![vec![sums]], profiles: vec![profile], drops: vec![0.0] }
    }

    /// Three levels of equal paraboloids with the drops 0, `step`, 2 `step`; `same` from a sublattice to itself,
    /// `other` to each other one.
    pub fn three_levels(modulus: f64, same: Sums, other: Sums, radius: f64, step: f64) -> Self {
        Self {
            modulus,
            sums: (0..3).map(|m| (0..3).map(|j| if m == j { same } else { other }).collect()).collect(),
            profiles: vec![vec![paraboloid(radius)]; 3],
            drops: vec![0.0, step, 2.0 * step],
        }
    }

    /// Coefficients c₂ and c₄ (r² and r⁴) and displacement that the images of all `contacts` give level m, from 0.
    pub fn images(&self, m: usize, contacts: &[Contact]) -> [f64; 3] {
        let [mut c2, mut c4, mut lift] = [0.0; 3];
        for (contact, Sums([s1, s3, s5])) in contacts.iter().zip(&self.sums[m]) {
            let (load, [second, fourth]) = (contact.load, contact.moments);
            c2 += (load * s3 / 4.0 + 9.0 * second * s5 / 16.0) / (PI * self.modulus);
            c4 += 9.0 * load * s5 / 64.0 / (PI * self.modulus);
            lift += (load * s1 + second * s3 / 4.0 + 9.0 * fourth * s5 / 64.0) / (PI * self.modulus);
        }
        [c2, c4, lift]
    }

    /// Contacts of the given radii; `penetration` is that of the highest apex which each level asks for.
    pub fn contacts(&self, radii: &[f64]) -> Vec<Contact> {
        let isolated = |m: usize, profile: &[Term]| Contact::isolated(radii[m], profile, self.modulus);
        let mut contacts: Vec<Contact> = (0..radii.len()).map(|m| isolated(m, &self.profiles[m])).collect();
        for _ in 0..60 {
            contacts = (0..radii.len())
                .map(|m| {
                    let [c2, c4, lift] = self.images(m, &contacts);
                    let mut profile = self.profiles[m].clone();
                    profile.push(Term { coefficient: c2, exponent: 2.0 });
                    profile.push(Term { coefficient: c4, exponent: 4.0 });
                    let contact = isolated(m, &profile);
                    Contact { penetration: contact.penetration + lift + self.drops[m], ..contact }
                })
                .collect();
        }
        contacts
    }

    /// Contacts under the total load of one cell (a force), all levels touching, by Newton's method from radii near
    /// `start`; `None` where it does not converge.
    pub fn loaded(&self, total: f64, start: f64) -> Option<Vec<Contact>> {
        let count = self.profiles.len();
        let mut radii = vec![start; count];
        // Total load, and the same penetration for all levels.
        let residual = |radii: &[f64]| -> Vec<f64> {
            let contacts = self.contacts(radii);
            let load: f64 = contacts.iter().map(|contact| contact.load).sum();
            let mut residual = vec![load / total - 1.0];
            residual.extend(contacts.windows(2).map(|pair| pair[0].penetration / pair[1].penetration - 1.0));
            residual
        };
        for _ in 0..30 {
            let here = residual(&radii);
            let columns: Vec<Vec<f64>> = (0..count)
                .map(|m| {
                    let mut moved = radii.clone();
                    moved[m] *= 1.0 + 1e-6;
                    residual(&moved).iter().zip(&here).map(|(there, here)| (there - here) / (1e-6 * radii[m])).collect()
                })
                .collect();
            let rows = (0..count).map(|i| columns.iter().map(|column| column[i]).collect()).collect();
            for (radius, step) in radii.iter_mut().zip(linear::solve(rows, here)?) {
                *radius -= step.clamp(-0.3 * *radius, 0.3 * *radius);
            }
        }
        let solved = residual(&radii).iter().all(|x| x.abs() < 1e-11);
        solved.then(|| self.contacts(&radii))
    }
}
