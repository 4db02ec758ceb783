//! Lattice sum of the indenters outside a circle, in the place of a uniform pressure.
//!
//! Unit forces on the axes of one site and of all its images displace the surface, measured from its mean plane, by
//!
//! G(**x**) = (c/A) Σ_{**q**≠0} T(q)/q · cos **q**·**x**,
//!
//! **q** over the reciprocal lattice, A the area of the cell. At the forces the sum does not converge. The displacement
//! far from a force is that of a smoothed force: the factor
//!
//! g(q) = e^{−s} Σ_{k<n} sᵏ/k!,  s = (q/κ)²,
//!
//! is the transform of a bell-shaped pressure of unit weight without moments below the order 2n, which displaces the surface by
//! K_g(r) = (c/2π) ∫₀^∞ T g J₀(qr) dq and differs from K by 1e-13/r at κr = 16, n = 14. The indenters outside the
//! circle, with images **r**_i inside, therefore displace the surface by
//!
//! E(**x**) = (c/A) Σ_{**q**≠0} T g/q · cos **q**·**x** − Σ_i K_g(|**x** − **r**_i|).
//!
//! The sum is Ewald's, with a bell so flat in q that the part summed in real space is negligible at the first image
//! outside. Layers enter by T alone, whatever their thickness. No moment of the pressure is neglected: each element is a force
//! of its own.

use super::circle::Circle;
use super::mesh::{Mesh, SERIES_DISTANCE};
use super::point::QUADRATURE;
use super::quadrature::{Bessel, hankel};
use super::system::System;
use crate::numeric::chebyshev::Chebyshev;
use crate::numeric::parallel;
use std::f64::consts::{PI, SQRT_2};

/// Order n of the bell.
const BELL_ORDER: u32 = 14;
/// κ times the distance beyond which a force may be replaced by its bell.
const BELL_REACH: f64 = 16.0;
/// q/κ beyond which g is negligible.
const BELL_CUTOFF: f64 = 8.2;
/// Nodes of a Chebyshev series of K_g on an interval of the length 1/κ: it errs by 1e-14.
const NODES: usize = 16;
/// Least distance up to which images are summed one by one, over √A: some hundred waves remain for the others.
const MIN_REACH: f64 = 1.5;

/// Lattice sums of the indenters outside the circles of a system, for points and forces on the spots' meshes.
#[derive(Debug)]
pub struct Exterior {
    /// Images summed one by one: those inside the circles, and all that are near the meshes.
    circles: Vec<Circle>,
    /// Vectors from each site to each other one of the cell, lengths.
    offsets: Vec<Vec<[f64; 2]>>,
    /// Vectors **q** ≠ 0, one of each pair ±**q**, with the amplitudes of both.
    waves: Vec<([f64; 2], f64)>,
    /// Series of K_g on intervals of equal length.
    blurred: Vec<Chebyshev<NODES>>,
    interval: f64,
}

impl Exterior {
    /// Exterior of circles of at least `indenters` for spots on `mesh`. Elements are squares: a force is spread over
    /// one, which to the second moment is the factor 1 − q²e²/24.
    pub fn new(system: &System, mesh: Mesh, indenters: usize) -> Self {
        let kernel = system.kernel();
        let (half, area) = (mesh.span(), system.cell().area());
        let length = |[x, y]: &[f64; 2]| x.hypot(*y);
        let asked = system.circles(indenters);
        let farthest = asked.iter().flat_map(|circle| circle.images.iter().flatten()).map(length).fold(0.0, f64::max);
        let wanted = farthest.max(SERIES_DISTANCE * half).max(MIN_REACH * area.sqrt());
        // The kernel's table ends before only for the meshes of merged contacts.
        let reach = wanted.min(kernel.reach() - SQRT_2 * (half + mesh.size)).max(farthest);
        let clear = (reach - SQRT_2 * half).max(0.25 * reach);
        let kappa = BELL_REACH / clear;
        let spectrum = |q: f64| {
            let spread = 1.0 - (q * mesh.size).powi(2) / 24.0;
            (1.0 + kernel.excess(q)) * bell((q / kappa).powi(2)) * spread
        };
        let end = BELL_CUTOFF * kappa;
        let vectors = system.cell().dual().reduced().vectors_within(end);
        let half_plane: Vec<_> = vectors.into_iter().filter(|&[x, y]| x > 0.0 || (x == 0.0 && y > 0.0)).collect();
        let scale = 2.0 * 2.0 * PI * kernel.factor() / area;
        let waves = parallel::map_items(&half_plane, |q| (*q, scale * spectrum(length(q)) / length(q)));
        let interval = 1.0 / kappa;
        let pieces = ((reach + SQRT_2 * half) / interval).ceil() as usize + 1;
        let at = |r: f64| kernel.factor() * hankel(Bessel::Zero, r, end, QUADRATURE, spectrum).value;
        let blurred = parallel::map(pieces, |k| Chebyshev::of(|x| at((k as f64 + 0.5 * (1.0 + x)) * interval)));
        Self { circles: system.circles_within(reach), offsets: system.offsets(), waves, blurred, interval }
    }

    /// Circles around each site, with the images that are summed one by one.
    pub fn circles(&self) -> &[Circle] {
        &self.circles
    }

    /// Displacement at `x` from the axis of site m by unit forces on the axes of all images of site c outside m's
    /// circle, measured from the mean plane of the displacement by all of them: a length per force.
    pub fn at(&self, m: usize, c: usize, [x, y]: [f64; 2]) -> f64 {
        let [u, v] = self.offsets[m][c];
        let whole: f64 =
            self.waves.iter().map(|([p, q], amplitude)| amplitude * (p * (x - u) + q * (y - v)).cos()).sum();
        let inside: f64 = self.circles[m].images[c].iter().map(|[u, v]| self.blurred((x - u).hypot(y - v))).sum();
        whole - inside
    }

    /// K_g(r).
    fn blurred(&self, r: f64) -> f64 {
        let place = r / self.interval;
        let index = (place as usize).min(self.blurred.len() - 1);
        self.blurred[index].at(2.0 * (place - index as f64) - 1.0)
    }
}

/// g as a function of s.
fn bell(s: f64) -> f64 {
    let (mut term, mut sum) = (1.0, 1.0);
    for k in 1..BELL_ORDER {
        term *= s / f64::from(k);
        sum += term;
    }
    (-s).exp() * sum
}
