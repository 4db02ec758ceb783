//! The part of the lattice that a circle leaves out, by sums over the indenters inside it.
//!
//! With n neighbours of one level in the circle and p̄ outside, the surface under the indenter feels
//!
//! S₁ = Σ 1/r − 2R/R₀²,  S₃ = Σ 1/r³ + 2/(R₀²R),  S₅ = Σ 1/r⁵ + 2/(3R₀²R³),  π R₀² = A₀, π R² = (n+1) A₀,
//!
//! in the place of the whole lattice's sums ([`super::lattice_sums`]). Moments of the pressure act from the indenters
//! inside alone: a uniform pressure has none.
//!
//! Several levels under one plate: where circles displace the surface under level m by ε_m more than the lattice does,
//! loads and penetration move by ΔP and Δδ with
//!
//! ΔP_m/(2E*a_m) + Σ_c S₁ ΔP_c/(πE*) + ε_m = Δδ,  Σ_m ΔP_m = 0,
//!
//! S₁ from level c to level m and 2E*a the stiffness of a contact of the radius a.

use super::galin::{Contact, Term, paraboloid};
use super::lattice_sums::Sums;
use percoat_core::numeric::linear;
use std::f64::consts::PI;

/// Effect of its images on an indenter of one level, with a circle of neighbours.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Localization {
    /// S₁, S₃, S₅, lengths to the power −n.
    pub sums: Sums,
    /// The parts of S₃ and S₅ that indenters cause.
    inside: [f64; 2],
}

impl Localization {
    /// Circle with neighbours at these `distances` from its centre, `area` of one indenter: lengths, an area.
    pub fn new(distances: &[f64], area: f64) -> Self {
        let square = area / PI;
        let radius = ((distances.len() + 1) as f64 * square).sqrt();
        let [s1, s3, s5] = [1, 3, 5].map(|n| distances.iter().map(|r| r.powi(-n)).sum::<f64>());
        let outside = [-2.0 * radius, 2.0 / radius, 2.0 / (3.0 * radius.powi(3))].map(|part| part / square);
        Self { sums: Sums([s1 + outside[0], s3 + outside[1], s5 + outside[2]]), inside: [s3, s5] }
    }

    /// The whole lattice.
    pub fn whole(sums: Sums) -> Self {
        let Sums([_, s3, s5]) = sums;
        Self { sums, inside: [s3, s5] }
    }

    /// Contact of a paraboloid of the radius of curvature `radius` under `load` on a half-space with the contact
    /// modulus E* = `modulus`, in the series of [`super::periodic_hertz`].
    pub fn contact(&self, radius: f64, load: f64, modulus: f64) -> Contact {
        let Sums([s1, s3, s5]) = self.sums;
        let [inner3, inner5] = self.inside;
        let scale = PI * modulus;
        let at = |a: f64| {
            let [second, fourth] = [0.4 * load * a.powi(2), 8.0 / 35.0 * load * a.powi(4)];
            let c2 = (load * s3 / 4.0 + 9.0 * second * inner5 / 16.0) / scale;
            let c4 = 9.0 * load * s5 / 64.0 / scale;
            let profile =
                [paraboloid(radius), Term { coefficient: c2, exponent: 2.0 }, Term { coefficient: c4, exponent: 4.0 }];
            let contact = Contact::isolated(a, &profile, modulus);
            let lift = (load * s1 + second * inner3 / 4.0 + 9.0 * fourth * inner5 / 64.0) / scale;
            Contact { penetration: contact.penetration + lift, ..contact }
        };
        // Among images the radius is below that of Hertz' contact or a little above it.
        let (mut low, mut high) = (0.0, 2.0 * (0.75 * load * radius / modulus).cbrt());
        for _ in 0..60 {
            let a = 0.5 * (low + high);
            if at(a).load < load { low = a } else { high = a }
        }
        at(low)
    }
}

/// ΔP_m of every level and Δδ from the contact radii a, S₁ (`sums[m][c]`), E* = `modulus` and the errors ε of the
/// displacement; `None` for a singular system.
pub fn shifts(radii: &[f64], sums: &[Vec<f64>], modulus: f64, errors: &[f64]) -> Option<(Vec<f64>, f64)> {
    let count = radii.len();
    let mut rows = vec![vec![0.0; count + 1]; count + 1];
    for m in 0..count {
        for c in 0..count {
            let diagonal = if c == m { 0.5 * PI / radii[m] } else { 0.0 };
            rows[m][c] = diagonal + sums[m][c];
        }
        // Δδ in units of a force per length, as the loads are.
        (rows[m][count], rows[count][m]) = (-1.0, 1.0);
    }
    let right = errors.iter().map(|error| -error * PI * modulus).chain([0.0]).collect();
    let mut loads = linear::solve(rows, right)?;
    let penetration = loads.pop()? / (PI * modulus);
    Some((loads, penetration))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::System;
    use crate::exact::lattice_sums::TRIANGULAR;

    #[test]
    fn the_whole_lattice_gives_the_series_of_its_images() {
        let load = 0.01 * 0.75f64.sqrt();
        let found = Localization::whole(TRIANGULAR).contact(0.8, load, 1.0);
        let series = System::single(1.0, TRIANGULAR, vec![paraboloid(0.8)]).loaded(load, 0.2).unwrap()[0];
        assert!((found.penetration / series.penetration - 1.0).abs() < 1e-6, "{found:?} {series:?}");
        assert!((found.radius / series.radius - 1.0).abs() < 1e-6);
    }

    #[test]
    fn two_springs_under_one_plate_exchange_what_moves_one_of_them() {
        let (loads, penetration) = shifts(&[0.5, 0.5], &[vec![0.0; 2], vec![0.0; 2]], 2.0, &[0.1, 0.0]).unwrap();
        // Stiffness 2 each: the plate follows by half the displacement.
        assert!((penetration - 0.05).abs() < 1e-15 && (loads[0] + 0.1).abs() < 1e-15 && (loads[1] - 0.1).abs() < 1e-15);
    }
}
