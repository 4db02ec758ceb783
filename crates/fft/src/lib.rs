//! Plans of fast Fourier transforms in double precision.
//!
//! The plans of rustfft are generic in their number, so that each crate that makes one compiles all of its algorithms. They are made
//! here alone, behind `dyn`, and compiled once.

pub use realfft::{ComplexToReal, RealToComplex};
pub use rustfft::num_complex::{Complex, Complex64};
pub use rustfft::{Fft, FftDirection};

use realfft::RealFftPlanner;
use rustfft::FftPlanner;
use std::sync::Arc;

/// Plan of X_k = Σⱼ xⱼ e^{∓2πikj/N} for `count` = N complex numbers, − forward and + inverse, without a factor.
pub fn complex(count: usize, direction: FftDirection) -> Arc<dyn Fft<f64>> {
    FftPlanner::new().plan_fft(count, direction)
}

/// Plan of X_k = Σⱼ xⱼ e^{−2πikj/N} for 0 ≤ k ≤ N/2 and `count` = N real numbers, without a factor.
pub fn of_real(count: usize) -> Arc<dyn RealToComplex<f64>> {
    RealFftPlanner::new().plan_fft_forward(count)
}

/// Plan of the `count` = N real numbers xⱼ = Σ_k X_k e^{2πikj/N}, given X_k for 0 ≤ k ≤ N/2, without a factor.
pub fn to_real(count: usize) -> Arc<dyn ComplexToReal<f64>> {
    RealFftPlanner::new().plan_fft_inverse(count)
}
