//! Relaxation of a material: its shear modulus after a strain that is then held.
//!
//! G(s) = G₀ + Σ gₙ sτₙ/(1 + sτₙ)   (Prony series, s the Laplace variable, times s as for a step),
//!
//! with the relaxed modulus G₀ (s → 0) and the glassy one G₀ + Σgₙ (s → ∞). Poisson's ratio follows from a constant bulk modulus,
//! 1/K = 3(1−2ν₀)/(2G₀(1+ν₀)),  ν = (3 − 2G/K)/(6 + 2G/K),  or stays constant.

use crate::body::{Bodies, HalfSpace, LayeredResponse, Material, Moduli};
use crate::numeric::number::Number;

/// Modulus that does not relax with the shear modulus.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Constant {
    /// Bulk modulus: only shear relaxes.
    #[default]
    Bulk,
    /// Poisson's ratio: shear and volume relax alike.
    Poisson,
}

/// Relaxation of one material; without terms the material is elastic.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Relaxation {
    /// Pairs gₙ > 0, a pressure, and τₙ > 0, a time.
    pub terms: Vec<[f64; 2]>,
    /// Modulus that stays constant.
    pub constant: Constant,
}

impl Relaxation {
    /// Moduli at the Laplace variable s, one over a time, of a material given relaxed.
    pub fn moduli_at<N: Number>(&self, material: Material, s: N) -> Moduli<N> {
        let (relaxed, poisson) = (material.shear(), material.poisson());
        let one = N::from(1.0);
        let term = |sum: N, &[g, time]: &[f64; 2]| sum + (s * time * g).over(one + s * time);
        let shear = self.terms.iter().fold(N::from(relaxed), term);
        let poisson = match self.constant {
            Constant::Poisson => N::from(poisson),
            Constant::Bulk => {
                let ratio = shear * (3.0 * (1.0 - 2.0 * poisson) / (2.0 * relaxed * (1.0 + poisson)));
                (N::from(3.0) - ratio * 2.0).over(N::from(6.0) + ratio * 2.0)
            }
        };
        Moduli { shear, poisson }
    }

    /// Shortest and longest time within which the material can retard: the least τ, and the largest τ times G(∞)/G(0); `None` for an
    /// elastic material.
    fn times(&self, material: Material) -> Option<[f64; 2]> {
        let ratio = 1.0 + self.terms.iter().map(|[g, _]| g).sum::<f64>() / material.shear();
        let times = self.terms.iter().map(|&[_, time]| [time, time * ratio]);
        times.reduce(|[short, long], [least, most]| [short.min(least), long.max(most)])
    }
}

/// Relaxations of the materials of the body and of the counterbody, from each surface down.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Relaxations(pub Vec<Vec<Relaxation>>);

impl Relaxations {
    /// Each half-space with the relaxations of its materials.
    fn each<'a>(&'a self, bodies: &'a Bodies) -> impl Iterator<Item = (&'a HalfSpace, &'a [Relaxation])> {
        bodies.each().zip(self.0.iter().map(Vec::as_slice))
    }

    /// Shortest and longest retardation time that the bodies can have, times; `None` where all materials are elastic.
    pub fn times(&self, bodies: &Bodies) -> Option<[f64; 2]> {
        let of = |(body, relaxations): (&HalfSpace, &[Relaxation])| {
            let pairs: Vec<_> = body.materials().zip(relaxations).collect();
            pairs.into_iter().filter_map(|(material, relaxation)| relaxation.times(material)).collect::<Vec<_>>()
        };
        let all = self.each(bodies).flat_map(of);
        all.reduce(|[short, long], [least, most]| [short.min(least), long.max(most)])
    }

    /// Responses of the bodies at the Laplace variable s, one over a time.
    pub fn responses_at<N: Number>(&self, bodies: &Bodies, s: N) -> Vec<LayeredResponse<N>> {
        let of = |(body, relaxations): (&HalfSpace, &[Relaxation])| {
            body.response_of(|number, material| relaxations[number - 1].moduli_at(material, s))
        };
        self.each(bodies).map(of).collect()
    }

    /// Moduli of the materials of each body at the Laplace variable s, one over a time.
    pub fn moduli_at<N: Number>(&self, bodies: &Bodies, s: N) -> Vec<Vec<Moduli<N>>> {
        let of = |(body, relaxations): (&HalfSpace, &[Relaxation])| {
            body.materials().zip(relaxations).map(|(material, relaxation)| relaxation.moduli_at(material, s)).collect()
        };
        self.each(bodies).map(of).collect()
    }
}
