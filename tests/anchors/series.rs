//! Circular contacts among their images: Galin's solution in the Taylor series of the periodic Green function.
//!
//! Around a site the displacement of a unit load and of its images, measured from the mean plane, is
//!
//! πE* w = 1/r + S₁ + S₃ r²/4 + 9 S₅ r⁴/64 + …,  S_n = Σ' 1/|R|ⁿ (S₁ without its uniform background).
//!
//! A contact of radius a then feels an indenter f = Σ c_n rⁿ, the images adding to c₂ and c₄, and (Galin 1946, Sneddon
//! 1965)
//!
//! δ = Σ κ_n c_n aⁿ,  P = 2E* Σ n κ_n c_n aⁿ⁺¹/(n+1),  p(0) = (E*/π) Σ n κ_n c_n aⁿ⁻¹/(n−1),  κ_n = √π
//! Γ(n/2+1)/Γ((n+1)/2).
//!
//! A coating replaces E* by its own E₁* and S_n by effective sums.

use super::support::Coating;
use std::f64::consts::PI;

/// S₁, S₃, S₅ of a lattice, lengths to the power −n.
#[derive(Debug, Clone, Copy)]
pub struct Sums(pub [f64; 3]);

/// Triangular lattice of unit period (30-digit Epstein zeta sums, 6 ζ(n/2) L(χ₋₃, n/2); checked by an Ewald sum).
pub const TRIANGULAR: Sums = Sums([-4.213422636136906890, 11.03417573491480977, 6.761898524398701589]);

impl Sums {
    /// Those of the same lattice with `period` times the period.
    pub fn scaled(self, period: f64) -> Self {
        let [s1, s3, s5] = self.0;
        Self([s1 / period, s3 / period.powi(3), s5 / period.powi(5)])
    }

    /// From one of three equal sublattices of a lattice with these sums to each of the others: (whole − own)/2.
    pub fn other_sublattice(self, own: Self) -> Self {
        Self([0, 1, 2].map(|n| 0.5 * (self.0[n] - own.0[n])))
    }

    fn minus(self, other: Self) -> Self {
        Self([0, 1, 2].map(|n| self.0[n] - other.0[n]))
    }
}

/// Effective sums of a triangular lattice of unit indenters, period `period`, on a coating:
/// S₁ + Σ(2π/A₀G)(T−1), S₃ − Σ(2πG/A₀)(T−1), S₅ + Σ(2πG³/9A₀)(T−1) over the reciprocal vectors G ≠ 0.
pub fn coated_triangular(coating: &Coating, period: f64) -> Sums {
    let area = 0.75f64.sqrt() * period * period;
    let least = 4.0 * PI / (3f64.sqrt() * period);
    let reach = (22.0 / (coating.thickness * least)).ceil() as i32 + 1;
    let [mut s1, mut s3, mut s5] = TRIANGULAR.scaled(period).0;
    for (i, j) in (-reach..=reach).flat_map(|i| (-reach..=reach).map(move |j| (i, j))) {
        if (i, j) != (0, 0) {
            let g = least * f64::from(i * i + i * j + j * j).sqrt();
            let excess = 2.0 * PI / area * (coating.correction(g * coating.thickness) - 1.0);
            s1 += excess / g;
            s3 -= excess * g;
            s5 += excess * g.powi(3) / 9.0;
        }
    }
    Sums([s1, s3, s5])
}

/// ∫ xⁿ (1 − T(x)) dx over all x > 0, by Simpson's rule.
pub fn moment(correction: impl Fn(f64) -> f64, n: i32) -> f64 {
    let (steps, step) = (8000, 0.005);
    let total: f64 = (0..=steps)
        .map(|i| {
            let x = (f64::from(i) * step).max(1e-9);
            let weight = if i == 0 || i == steps { 1.0 } else { 2.0 + 2.0 * f64::from(i % 2) };
            weight * x.powi(n) * (1.0 - correction(x))
        })
        .sum();
    total * step / 3.0
}

/// Effective sums of the images alone: a lattice on a coating minus one indenter on the same coating,
/// whose own layer gives −A₀/h, A₂/h³, −A₄/(9h⁵), A_n = ∫xⁿ(1−T)dx.
pub fn coated_images(coating: &Coating, period: f64) -> Sums {
    let moment = |n| moment(|x| coating.correction(x), n);
    let h = coating.thickness;
    let own = Sums([-moment(0) / h, moment(2) / h.powi(3), -moment(4) / (9.0 * h.powi(5))]);
    coated_triangular(coating, period).minus(own)
}

/// √π Γ(7/4)/Γ(5/4).
const KAPPA_THREE_HALVES: f64 = 1.797210352103388;

/// One term c rⁿ of an indenter's profile.
#[derive(Debug, Clone, Copy)]
pub struct Term {
    pub coefficient: f64,
    pub exponent: f64,
}

/// A circular contact.
#[derive(Debug, Clone, Copy, Default)]
pub struct Contact {
    pub radius: f64,
    /// P = ∫p.
    pub load: f64,
    /// ∫p r², ∫p r⁴.
    moments: [f64; 2],
    /// p(0), on the axis.
    pub axis: f64,
    /// δ, from the mean plane when images take part.
    pub penetration: f64,
}

/// κ_n = √π Γ(n/2+1)/Γ((n+1)/2) by κ_n = n/(n−1) κ_{n−2} from n = 1, 1.5 and 2.
fn kappa(n: f64) -> f64 {
    if n > 2.0 {
        return n / (n - 1.0) * kappa(n - 2.0);
    }
    match n {
        1.0 => 0.5 * PI,
        1.5 => KAPPA_THREE_HALVES,
        2.0 => 2.0,
        _ => panic!("no κ for the exponent {n}"),
    }
}

impl Contact {
    /// Isolated contact of radius a with the profile Σ c rⁿ on a half-space with contact modulus `modulus`.
    pub fn isolated(radius: f64, profile: &[Term], modulus: f64) -> Self {
        let a = radius;
        let mut contact = Self { radius, ..Self::default() };
        for &Term { coefficient, exponent: n } in profile {
            let depth = kappa(n) * coefficient * a.powf(n);
            contact.penetration += depth;
            contact.load += 2.0 * modulus * n / (n + 1.0) * depth * a;
            contact.moments[0] += 4.0 / 3.0 * modulus * n / (n + 3.0) * depth * a.powi(3);
            contact.moments[1] += 16.0 / 15.0 * modulus * n / (n + 5.0) * depth * a.powi(5);
            contact.axis += modulus / PI * n / (n - 1.0) * depth / a;
        }
        contact
    }
}

/// Levels of equal indenters, one of each in the cell, that feel each other's images.
#[derive(Debug)]
pub struct System {
    /// Contact modulus of the surface material.
    pub modulus: f64,
    /// `sums[m][j]`: what level j's lattice does to an indenter of level m.
    pub sums: Vec<Vec<Sums>>,
    /// Profile of each level.
    pub profiles: Vec<Vec<Term>>,
    /// Drop of each level.
    pub drops: Vec<f64>,
}

impl System {
    /// One level.
    pub fn single(modulus: f64, sums: Sums, profile: Vec<Term>) -> Self {
        Self { modulus, sums: vec![vec![sums]], profiles: vec![profile], drops: vec![0.0] }
    }

    /// Three levels of equal paraboloids with the drops 0, `step`, 2 `step`.
    pub fn three_levels(modulus: f64, own: Sums, other: Sums, radius: f64, step: f64) -> Self {
        Self {
            modulus,
            sums: (0..3).map(|m| (0..3).map(|j| if m == j { own } else { other }).collect()).collect(),
            profiles: vec![vec![paraboloid(radius)]; 3],
            drops: vec![0.0, step, 2.0 * step],
        }
    }

    /// Curvature coefficients c₂, c₄ and displacement that the images give level m.
    fn images(&self, m: usize, contacts: &[Contact]) -> [f64; 3] {
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

    /// Contacts under the total load of one cell, by Newton's method from radii near `start`.
    pub fn loaded(&self, total: f64, start: f64) -> Vec<Contact> {
        let count = self.profiles.len();
        let mut radii = vec![start; count];
        // Total load, and the same penetration for all levels.
        let residual = |radii: &[f64]| -> Vec<f64> {
            let contacts = self.contacts(radii);
            let load: f64 = contacts.iter().map(|contact| contact.load).sum();
            let mut residual = vec![load - total];
            residual.extend(contacts.windows(2).map(|pair| pair[0].penetration - pair[1].penetration));
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
            let step = linear_solve(&columns, &here);
            for (radius, step) in radii.iter_mut().zip(step) {
                *radius -= step.clamp(-0.3 * *radius, 0.3 * *radius);
            }
        }
        let left = residual(&radii);
        assert!(left.iter().all(|x| x.abs() < 1e-12), "the series did not converge: {left:?}");
        self.contacts(&radii)
    }
}

/// r²/(2R).
pub fn paraboloid(radius: f64) -> Term {
    Term { coefficient: 0.5 / radius, exponent: 2.0 }
}

/// x with Σ columns[m] x[m] = right, by Gauss' elimination with row exchange.
fn linear_solve(columns: &[Vec<f64>], right: &[f64]) -> Vec<f64> {
    let n = right.len();
    let mut rows: Vec<Vec<f64>> =
        (0..n).map(|i| columns.iter().map(|column| column[i]).chain([right[i]]).collect()).collect();
    for k in 0..n {
        let pivot = (k..n).max_by(|&a, &b| rows[a][k].abs().total_cmp(&rows[b][k].abs())).unwrap();
        rows.swap(k, pivot);
        let lead = rows[k].clone();
        for row in rows.iter_mut().skip(k + 1) {
            let factor = row[k] / lead[k];
            row.iter_mut().zip(&lead).for_each(|(x, y)| *x -= factor * y);
        }
    }
    let mut x = vec![0.0; n];
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|m| rows[k][m] * x[m]).sum();
        x[k] = (rows[k][n] - known) / rows[k][k];
    }
    x
}
