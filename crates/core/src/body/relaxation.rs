//! Relaxation of a material: a shear modulus that falls with the time since a strain was imposed.
//!
//! A Prony series beside the relaxed modulus G₀, that of the material:
//!
//! G(t) = G₀ + Σ gₙ e^{−t/τₙ},  G(s) = G₀ + Σ gₙ sτₙ/(1 + sτₙ)
//!
//! with the Laplace variable s; under a load e^{iωt}, s = iω, the real part is the storage modulus G′ and the imaginary one the loss modulus
//! G″. The glassy modulus is G(s → ∞) = G₀ + Σ gₙ. Either the bulk modulus K stays constant, as in most polymers, or Poisson's ratio does.
//! With K constant ν(s) = (3K − 2G)/(6K + 2G) falls where G rises.

use crate::notation::number;
use crate::numeric::number::Number;
use std::collections::BTreeMap;
use std::fmt;
use std::sync::{Mutex, PoisonError};

/// One term of a Prony series.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RelaxationTerm {
    /// Shear modulus g that relaxes, a pressure.
    pub shear: f64,
    /// Relaxation time τ.
    pub time: f64,
}

/// Modulus that stays constant while the shear modulus relaxes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ConstantModulus {
    /// The bulk modulus.
    #[default]
    Bulk,
    /// Poisson's ratio.
    Poisson,
}

/// Why a relaxation cannot be built.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum RelaxationError {
    /// No term.
    #[error("a relaxation needs at least one shear modulus with its time")]
    Empty,
    /// Different numbers of moduli and times.
    #[error("a relaxation needs as many times as shear moduli, not {times} beside {moduli}")]
    Lengths {
        /// Number of shear moduli.
        moduli: usize,
        /// Number of times.
        times: usize,
    },
    /// A shear modulus that is not positive and finite.
    #[error("a shear modulus that relaxes must be positive and finite, not {0}")]
    Shear(f64),
    /// A time that is not positive and finite.
    #[error("a relaxation time must be positive and finite, not {0}")]
    Time(f64),
}

/// Relaxation of a material. A copy costs nothing: each different series is kept once, until the program ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Relaxation {
    terms: &'static [RelaxationTerm],
    constant: ConstantModulus,
}

impl Relaxation {
    /// Relaxation by the shear moduli g, pressures, and their times τ, with the bulk modulus constant.
    ///
    /// # Errors
    /// [`RelaxationError`] without terms, for different numbers of moduli and times, and for values that are not positive and finite.
    pub fn new(shear: &[f64], times: &[f64]) -> Result<Self, RelaxationError> {
        let is_size = |x: &&f64| !(x.is_finite() && **x > 0.0);
        match (shear.len(), times.len()) {
            (0, 0) => return Err(RelaxationError::Empty),
            (moduli, times) if moduli != times => return Err(RelaxationError::Lengths { moduli, times }),
            _ => {}
        }
        if let Some(&shear) = shear.iter().find(is_size) {
            return Err(RelaxationError::Shear(shear));
        }
        if let Some(&time) = times.iter().find(is_size) {
            return Err(RelaxationError::Time(time));
        }
        let terms = shear.iter().zip(times).map(|(&shear, &time)| RelaxationTerm { shear, time }).collect();
        Ok(Self { terms: kept(terms), constant: ConstantModulus::Bulk })
    }

    /// The relaxation with another modulus constant.
    #[must_use]
    pub fn with_constant(self, constant: ConstantModulus) -> Self {
        Self { constant, ..self }
    }

    /// Terms of the series.
    pub fn terms(&self) -> &'static [RelaxationTerm] {
        self.terms
    }

    /// Modulus that stays constant.
    pub fn constant(&self) -> ConstantModulus {
        self.constant
    }

    /// Shear modulus Σ gₙ sτₙ/(1 + sτₙ) beside the relaxed one at the Laplace variable s, one over a time; s = iω under a load e^{iωt}.
    pub fn stiffening<N: Number>(&self, s: N) -> N {
        let term = |&RelaxationTerm { shear, time }: &RelaxationTerm| {
            let x = s * time;
            (x * shear).over(N::from(1.0) + x)
        };
        self.terms.iter().map(term).fold(N::from(0.0), |sum, term| sum + term)
    }

    /// Shear modulus Σ gₙ beside the relaxed one at once after a strain, a pressure.
    pub fn instantaneous(&self) -> f64 {
        self.terms.iter().map(|term| term.shear).sum()
    }
}

/// The series with these terms, kept once.
fn kept(terms: Vec<RelaxationTerm>) -> &'static [RelaxationTerm] {
    static KEPT: Mutex<BTreeMap<Vec<[u64; 2]>, &'static [RelaxationTerm]>> = Mutex::new(BTreeMap::new());
    let bits = terms.iter().map(|term| [term.shear.to_bits(), term.time.to_bits()]).collect();
    KEPT.lock().unwrap_or_else(PoisonError::into_inner).entry(bits).or_insert_with(|| terms.leak())
}

impl fmt::Display for Relaxation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "relaxes by")?;
        for (index, term) in self.terms.iter().enumerate() {
            write!(f, "{} g {} in {}", if index > 0 { "," } else { "" }, number(term.shear), number(term.time))?;
        }
        write!(f, " at constant {}", self.constant)
    }
}

impl fmt::Display for ConstantModulus {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Bulk => "bulk modulus",
            Self::Poisson => "Poisson's ratio",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{Material, Moduli};
    use rustfft::num_complex::Complex64;

    fn rubber(poisson: f64, constant: ConstantModulus) -> Material {
        let relaxation = Relaxation::new(&[3.0, 6.0], &[1.0, 0.05]).unwrap().with_constant(constant);
        Material::from_shear(1.0, poisson).unwrap().with_relaxation(Some(relaxation))
    }

    #[test]
    fn values_out_of_range_are_refused() {
        assert_eq!(Relaxation::new(&[], &[]), Err(RelaxationError::Empty));
        assert_eq!(Relaxation::new(&[1.0], &[]), Err(RelaxationError::Lengths { moduli: 1, times: 0 }));
        assert_eq!(Relaxation::new(&[1.0, 0.0], &[1.0, 1.0]), Err(RelaxationError::Shear(0.0)));
        assert_eq!(Relaxation::new(&[1.0], &[f64::INFINITY]), Err(RelaxationError::Time(f64::INFINITY)));
    }

    #[test]
    fn equal_series_are_kept_once() {
        let [one, other] = [0, 1].map(|_| Relaxation::new(&[2.0, 5.0], &[0.3, 7.0]).unwrap());
        assert!(std::ptr::eq(one.terms(), other.terms()));
    }

    #[test]
    fn slow_strains_are_relaxed_and_fast_ones_glassy() {
        for constant in [ConstantModulus::Bulk, ConstantModulus::Poisson] {
            let rubber = rubber(0.3, constant);
            let (slow, fast) = (rubber.moduli_at(1e-12), rubber.moduli_at(1e14));
            let glassy = rubber.glassy();
            assert!((slow.shear - 1.0).abs() < 1e-11 && (slow.poisson - 0.3).abs() < 1e-11);
            assert!((fast.shear - 10.0).abs() < 1e-11 && (fast.poisson - glassy.poisson).abs() < 1e-11);
            assert_eq!(glassy.shear, 10.0);
        }
    }

    /// 2G(1 + ν)/(3(1 − 2ν)) at any frequency.
    #[test]
    fn the_bulk_modulus_or_poissons_ratio_stays_and_the_loss_is_positive() {
        let one = Complex64::from(1.0);
        for omega in [1e-3, 0.7, 20.0, 1e4] {
            let Moduli { shear, poisson } = rubber(0.3, ConstantModulus::Bulk).moduli_at(Complex64::new(0.0, omega));
            let bulk = shear * 2.0 * (one + poisson) / ((one - poisson * 2.0) * 3.0);
            assert!((bulk - 2.6 / 1.2).norm() < 1e-14 && shear.im > 0.0, "{omega}: {bulk}");
            let constant = rubber(0.3, ConstantModulus::Poisson).moduli_at(Complex64::new(0.0, omega));
            assert_eq!((constant.poisson, constant.shear), (0.3.into(), shear));
            assert_eq!(rubber(0.5, ConstantModulus::Bulk).moduli_at(Complex64::new(0.0, omega)).poisson, 0.5.into());
        }
    }
}
