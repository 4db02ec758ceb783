//! Stresses on the surface itself, where the pressure ends like a square root.
//!
//! There the series of the stresses converges slowly and overshoots. But what is singular at an edge is the pressure
//! alone: with **n** normal and **t** along the edge, and ν of the surface material,
//!
//! σ_αβ = σ̂_αβ − p (n_α n_β + 2ν t_α t_β),
//!
//! where σ̂ has no square root any more. So the series is smoothed by a Gaussian, which leaves σ̂ as it is to the fourth
//! order of its width (each factor is multiplied by 1 + q²w²/2), and the smoothed pressure is put back as the sharp one
//! that [`super::smoothed_edge`] finds behind it. At the edge itself the pressure is zero, and outside it stays so.
//!
//! A traction q = μ p **e** is singular on the other side of the edge: where p = A√d inside, at a distance d outside it adds
//!
//! σ_αβ = A√d μ [2 (**e**·**n**)(n_α n_β + ν t_α t_β) + (**e**·**t**)(n_α t_β + t_α n_β)],
//!
//! a cusp of tension at the trailing edge, **e**·**n** = −1 (in a plane across the edge, the Hilbert transform of √d). It is
//! put back in the same way, with A as the pressure tells it.
//!
//! Near an edge, the width leaves e^{−EDGE²/2} of the shortest waves of the grid, which carry its error. The steps of an
//! edge on the grid make longer waves too: the width near edges grows against the spacing, as n^{2/5} from n = 12 samples
//! along the radius of the smallest spot on. From one to three widths off the edge all this gives way to the series
//! itself, smoothed to the fourth order with e^{−OPEN²/2} of the shortest waves.

use super::constants::{BLEND, EDGE_WIDTH, OPEN_WIDTH, WIDTH_GROWTH};
use super::depth_response::DepthResponse;
use super::field::StressField;
use super::series::Response;
use super::smoothed_edge::SmoothedEdge;
use super::tensor::StressState;
use rustfft::num_complex::Complex64;
use std::sync::Arc;

/// What a Gaussian leaves less of is nothing.
const NEGLIGIBLE: f64 = 1e-20;

/// The surface of a field, smoothed.
#[derive(Debug)]
pub(super) struct SmoothedSurface {
    /// Pressure and slopes.
    pub near: SmoothedPressure,
    /// Stresses and pressure near edges and away from them.
    pub edge: SurfaceStresses,
    pub open: SurfaceStresses,
    /// Width of the Gaussian near edges, a length.
    width: f64,
    seen: &'static SmoothedEdge,
    /// ν of the surface material.
    poisson: f64,
    /// μ **e**.
    traction: [f64; 2],
    /// How far the surface material's own response, which carries the singular part, is from the half-space's at the
    /// wavenumber 1/width, over the pressure: a coating must be thicker than the width for it.
    pub unlike: f64,
}

/// p̃, ∂p̃/∂x, ∂p̃/∂y under a Gaussian.
#[derive(Debug)]
pub(super) struct SmoothedPressure {
    /// Per shell.
    gaussian: Vec<f64>,
    mean: f64,
}

/// σ_xx, σ_yy, σ_xy and p on the surface.
#[derive(Debug)]
pub(super) struct SurfaceStresses {
    surface: Arc<DepthResponse>,
    /// Per shell.
    factors: Vec<f64>,
}

impl SurfaceStresses {
    /// Of the surface, each shell taken times a factor of its wavenumber, which falls to nothing.
    pub fn new(surface: &Arc<DepthResponse>, factor: impl Fn(f64) -> f64) -> Self {
        let factors = surface.lengths.iter().map(|length| factor(1.0 / length));
        Self { surface: Arc::clone(surface), factors: factors.take_while(|&factor| factor > NEGLIGIBLE).collect() }
    }
}

impl Response<4> for SurfaceStresses {
    fn shells(&self) -> usize {
        self.factors.len()
    }

    #[inline(always)]
    fn times(&self, q: [f64; 2], shell: usize, c: Complex64) -> [Complex64; 4] {
        let [xx, yy, zz, xy, ..] = Response::<9>::times(&*self.surface, q, shell, self.factors[shell] * c);
        [xx, yy, xy, -zz]
    }

    fn mean(&self) -> [f64; 4] {
        let StressState { xx, yy, zz, .. } = self.surface.mean;
        [xx, yy, 0.0, -zz]
    }
}

impl Response<3> for SmoothedPressure {
    fn shells(&self) -> usize {
        self.gaussian.len()
    }

    #[inline(always)]
    fn times(&self, [x, y]: [f64; 2], shell: usize, c: Complex64) -> [Complex64; 3] {
        // The slope of c e^{iq·x} is iq times it.
        let c = self.gaussian[shell] * c;
        let slope = Complex64::new(-c.im, c.re);
        [c, x * slope, y * slope]
    }

    fn mean(&self) -> [f64; 3] {
        [self.mean, 0.0, 0.0]
    }
}

impl SmoothedSurface {
    /// Of a field, whose waves `surface` holds, with `scale` times the usual widths.
    pub fn new(field: &StressField, surface: &Arc<DepthResponse>, scale: f64) -> Self {
        let most = field.grid().least_aliased();
        let (from, power) = WIDTH_GROWTH;
        let growth = (field.regions().least_resolution() / from).max(1.0).powf(power);
        let [width, open] = [EDGE_WIDTH * growth, OPEN_WIDTH].map(|c| scale * c / most);
        let waves = &field.series.waves;
        let wavenumbers = waves.wavenumbers();
        let gaussian = wavenumbers.iter().map(|&q| (-0.5 * q * q * width * width).exp());
        let poisson = field.surface_poisson();
        let longer = waves.shells_up_to(1.0 / width).saturating_sub(1);
        let unlike = surface.unlike(longer, poisson);
        Self {
            near: SmoothedPressure {
                gaussian: gaussian.take_while(|&left| left > NEGLIGIBLE).collect(),
                mean: -surface.mean.zz,
            },
            edge: SurfaceStresses::new(surface, |q| fourth(q * width)),
            open: SurfaceStresses::new(surface, |q| fourth(q * open)),
            width,
            seen: SmoothedEdge::shared(),
            poisson,
            traction: field.traction(),
            unlike,
        }
    }

    /// Distance from the edge over the width, positive inside, and the normal that points outward, by p̃ and its slopes.
    pub fn edge_seen(&self, [p, gx, gy]: [f64; 3]) -> (f64, [f64; 2]) {
        let slope = gx.hypot(gy);
        let normal = if slope > 0.0 { [-gx / slope, -gy / slope] } else { [1.0, 0.0] };
        (if p > 0.0 { self.seen.distance(p / (slope * self.width)) } else { self.seen.distance(0.0) }, normal)
    }

    /// Whether the edge is so near that the stress is not the series itself.
    pub fn sees_edge(&self, [p, gx, gy]: [f64; 3]) -> bool {
        p > 0.0 && self.seen.is_within(BLEND[1], p / (gx.hypot(gy) * self.width))
    }

    /// A stress near an edge at the distance `u`, of which the smoothed pressure `four[3]` is replaced by the pressure `p`, and
    /// the traction's smoothed cusp by the sharp one; `smoothed` is p̃.
    fn sharpened(&self, four: [f64; 4], smoothed: f64, (u, p): (f64, f64), [nx, ny]: [f64; 2]) -> [f64; 3] {
        let (nu, [tx, ty]) = (self.poisson, self.traction);
        let (along, across) = (tx * nx + ty * ny, ty * nx - tx * ny);
        let change = four[3] - p;
        let cusp = if self.slides() { smoothed * self.seen.cusp(u) } else { 0.0 };
        // Of n n, t t and n t + t n, with t = (−n_y, n_x).
        let normal = change + 2.0 * along * cusp;
        let lateral = 2.0 * nu * change + 2.0 * nu * along * cusp;
        let shear = across * cusp;
        [
            four[0] + normal * nx * nx + lateral * ny * ny - 2.0 * shear * nx * ny,
            four[1] + normal * ny * ny + lateral * nx * nx + 2.0 * shear * nx * ny,
            four[2] + (normal - lateral) * nx * ny + shear * (nx * nx - ny * ny),
        ]
    }

    fn slides(&self) -> bool {
        self.traction != [0.0; 2]
    }

    /// The state, its displacement left out, from what [`Self::near`], [`Self::edge`] and [`Self::open`] give.
    pub fn state(&self, near: [f64; 3], edge: [f64; 4], open: [f64; 4]) -> StressState {
        let (sharp, part) = self.sharp(near, edge);
        self.toward_open(sharp, open, part)
    }

    /// Between the state near an edge and that away from it, σ_xx, σ_yy, σ_xy and p of each.
    pub fn toward_open(&self, near: [f64; 4], open: [f64; 4], part: f64) -> StressState {
        let four = std::array::from_fn(|k| (1.0 - part) * near[k] + part * open[k]);
        StressState::on_surface(four, self.traction)
    }

    /// σ_xx, σ_yy, σ_xy and p as they are near an edge, and which part of the state away from edges there is in it.
    pub fn sharp(&self, near: [f64; 3], edge: [f64; 4]) -> ([f64; 4], f64) {
        let (u, normal) = self.edge_seen(near);
        let p = near[0] * self.seen.sharp(u);
        let [xx, yy, xy] = self.sharpened(edge, near[0], (u, p), normal);
        // From one width to three: 0 to 1, smoothly.
        let t = ((u.abs() - BLEND[0]) / (BLEND[1] - BLEND[0])).clamp(0.0, 1.0);
        ([xx, yy, xy, p], t * t * (3.0 - 2.0 * t))
    }

    /// The state at the edge, seen from a place on it.
    pub fn state_on_edge(&self, near: [f64; 3], edge: [f64; 4]) -> StressState {
        let (_, normal) = self.edge_seen(near);
        let [xx, yy, xy] = self.sharpened(edge, near[0], (0.0, 0.0), normal);
        StressState::on_surface([xx, yy, xy, 0.0], self.traction)
    }

    /// The place moved to the edge beside it, by what is seen there, and how far that was in widths.
    pub fn moved(&self, [x, y]: [f64; 2], near: [f64; 3]) -> ([f64; 2], f64) {
        let (u, [nx, ny]) = self.edge_seen(near);
        let step = self.width * u.clamp(-1.5, 1.5);
        ([x + step * nx, y + step * ny], u)
    }
}

/// A Gaussian of which qw is wavenumber times width, made to leave what is smooth as it is to the fourth order.
fn fourth(qw: f64) -> f64 {
    (1.0 + 0.5 * qw * qw) * (-0.5 * qw * qw).exp()
}
