//! Stresses on the surface itself, where the pressure ends like a square root.
//!
//! The series of the stresses converges slowly there and overshoots. But only the pressure is singular at an edge: with
//! **n** normal and **t** along the edge, and ν of the surface material,
//!
//! σ_αβ = σ̂_αβ − p (n_α n_β + 2ν t_α t_β),
//!
//! where σ̂ has no square root. So the series is smoothed by a Gaussian, which changes σ̂ in the fourth order of its width
//! alone (each factor is multiplied by 1 + q²w²/2), and the smoothed pressure in it is replaced by the sharp one of
//! [`super::smoothed_edge`]. The pressure is zero at the edge itself and outside.
//!
//! A traction q = μ p **e** is singular on the other side of the edge: where p = A√d inside, at a distance d outside it adds
//!
//! σ_αβ = A√d μ [2 (**e**·**n**)(n_α n_β + ν t_α t_β) + (**e**·**t**)(n_α t_β + t_α n_β)],
//!
//! a cusp of tension at the trailing edge, **e**·**n** = −1 (in a plane across the edge, the Hilbert transform of √d). Its
//! smoothed form is replaced in the same way, with A from the pressure. Coupled friction has p = A dˢ, s = ½ − η **e**·**n** with the η of the materials that meet
//! at the surface, and the cusp of [`super::smoothed_edge`] on both sides. A tangential traction with [fields](super::Traction::with_fields)
//! of its own is smoothed as the pressure is: where both end like √d, its A in the direction **e** takes the place of μA.
//!
//! Near an edge, the smoothing leaves e^{−W²/2} of the shortest waves of the grid, W = [`EDGE_WIDTH`], which carry the
//! discretisation error. The steps of an edge on the grid excite longer waves too: the width near edges grows against the
//! spacing, as n^{2/5} from n = 12 samples along the radius of the smallest spot on. From one to three widths off the edge the
//! sharpened stresses are blended into the series itself, smoothed to the fourth order with W = [`OPEN_WIDTH`].

use super::constants::{BLEND, EDGE_WIDTH, OPEN_WIDTH, WIDTH_GROWTH};
use super::depth_response::DepthResponse;
use super::far_plane::FarPlane;
use super::field::{REACH, StressField};
use super::series::Response;
use super::smoothed_edge::SmoothedEdge;
use super::smoothed_shear::SmoothedShear;
use super::tensor::StressState;
use super::traction::ShearForm;
use super::traction_waves::Wave;
use crate::body::Depth;
use rustfft::num_complex::Complex64;
use std::sync::Arc;

/// Factor of a Gaussian below which waves are neglected.
const NEGLIGIBLE: f64 = 1e-20;
/// Smoothed pressure over its mean that may be rounding alone; three widths from an edge it is far larger.
const ROUNDING: f64 = 1e-9;

/// Smoothed responses on the surface of a stress field.
#[derive(Debug)]
pub(super) struct SmoothedSurface {
    /// Smoothed pressure and its slopes.
    pub near: SmoothedPressure,
    /// Stresses and pressure with the width near edges.
    pub edge: SurfaceStresses,
    /// Stresses and pressure with the width away from edges.
    pub open: SurfaceStresses,
    /// Tangential traction with fields of its own, smoothed with both widths; `None` of one that follows from the pressure.
    pub shear: Option<SmoothedShear>,
    /// Width of the Gaussian near edges, a length.
    width: f64,
    seen: Arc<SmoothedEdge>,
    /// ν of the surface material.
    poisson: f64,
    /// Tangential traction over the pressure, zero where it has fields of its own.
    ratio: [f64; 2],
    /// Largest difference of the amplitudes at the wavenumber 1/width from those of a bare half-space of the surface material,
    /// which has the singular part, over the pressure and over tangential fields: small where the coating is thicker than the width.
    unlike: [f64; 2],
}

/// Smoothed pressure p̃ near an edge with its slopes ∂p̃/∂x, ∂p̃/∂y, and the tangential traction smoothed alike, zero where it follows from
/// the pressure.
#[derive(Debug, Clone, Copy)]
pub(super) struct NearEdge {
    pub pressure: [f64; 3],
    pub shear: [f64; 2],
}

/// Sharpened stresses at a point near an edge.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sharp {
    /// σ_xx, σ_yy, σ_xy and p.
    four: [f64; 4],
    /// Tangential traction with fields of its own, else zero.
    shear: [f64; 2],
    /// Weight of the series away from edges beside them.
    part: f64,
}

impl Sharp {
    /// A point away from edges.
    pub const AWAY: Self = Self { four: [0.0; 4], shear: [0.0; 2], part: 1.0 };
}

/// Response p̃, ∂p̃/∂x, ∂p̃/∂y of the pressure smoothed by a Gaussian.
#[derive(Debug)]
pub(super) struct SmoothedPressure {
    /// Factor of each shell.
    gaussian: Vec<f64>,
    mean: f64,
}

/// Response σ_xx, σ_yy, σ_xy and p on the surface, smoothed.
#[derive(Debug)]
pub(super) struct SurfaceStresses {
    surface: Arc<DepthResponse>,
    /// Factor of each shell.
    factors: Vec<f64>,
    /// Whether the waves are those of discs, whatever the samples see of them.
    is_of_discs: bool,
}

impl SurfaceStresses {
    /// Response of the surface, each shell multiplied by a factor of its wavenumber that decreases to zero.
    pub fn new(surface: &Arc<DepthResponse>, factor: impl Fn(f64) -> f64) -> Self {
        let factors = surface.lengths.iter().map(|length| factor(1.0 / length));
        let factors = factors.take_while(|&factor| factor > NEGLIGIBLE).collect();
        Self { surface: Arc::clone(surface), factors, is_of_discs: false }
    }

    /// Response of the surface to the discs themselves, not to their samples.
    pub fn of_discs(surface: &Arc<DepthResponse>, factor: impl Fn(f64) -> f64) -> Self {
        Self { is_of_discs: true, ..Self::new(surface, factor) }
    }
}

impl Response<4> for SurfaceStresses {
    fn shells(&self) -> usize {
        self.factors.len()
    }

    #[inline(always)]
    fn times<W: Wave>(&self, q: [f64; 2], shell: usize, wave: W) -> [Complex64; 4] {
        let [xx, yy, zz, xy, ..] = Response::<9>::times(&*self.surface, q, shell, wave * self.factors[shell]);
        [xx, yy, xy, -zz]
    }

    fn mean(&self) -> [f64; 4] {
        let StressState { xx, yy, zz, xy, .. } = self.surface.mean;
        [xx, yy, xy, -zz]
    }

    fn is_deep(&self) -> bool {
        self.is_of_discs
    }

    fn far(&self) -> Option<FarPlane<4>> {
        // The far field is so smooth that smoothing leaves it as it is.
        Some(self.surface.far.as_ref()?.map(|[xx, yy, zz, xy, ..]| [xx, yy, xy, -zz]))
    }
}

impl Response<3> for SmoothedPressure {
    fn shells(&self) -> usize {
        self.gaussian.len()
    }

    #[inline(always)]
    fn times<W: Wave>(&self, [x, y]: [f64; 2], shell: usize, wave: W) -> [Complex64; 3] {
        // The slope of c e^{iq·x} is iq times it.
        let c = self.gaussian[shell] * wave.pressure();
        let slope = Complex64::new(-c.im, c.re);
        [c, x * slope, y * slope]
    }

    fn mean(&self) -> [f64; 3] {
        [self.mean, 0.0, 0.0]
    }
}

impl SmoothedSurface {
    /// Smoothed surface of a field with the response `surface`, with `scale` times the usual widths.
    pub fn new(field: &StressField, surface: &Arc<DepthResponse>, scale: f64) -> Self {
        let most = field.least_aliased();
        let (from, power) = WIDTH_GROWTH;
        let growth = (field.regions().least_resolution() / from).max(1.0).powf(power);
        let [width, open] = [EDGE_WIDTH * growth, OPEN_WIDTH].map(|c| scale * c / most);
        let waves = &field.series.waves;
        let wavenumbers = waves.wavenumbers();
        let gaussian = |q: f64| (-0.5 * q * q * width * width).exp();
        let factors = wavenumbers.iter().map(|&q| [gaussian(q), fourth(q * open)]);
        let factors = factors.take_while(|both| both.iter().any(|&left| left > NEGLIGIBLE));
        let poisson = field.surface_poisson();
        let longer = waves.shells_up_to(1.0 / width).saturating_sub(1);
        let unlike = surface.unlike(longer, poisson);
        Self {
            near: SmoothedPressure {
                gaussian: wavenumbers.iter().map(|&q| gaussian(q)).take_while(|&left| left > NEGLIGIBLE).collect(),
                mean: field.mean_pressure(),
            },
            edge: SurfaceStresses::new(surface, |q| fourth(q * width)),
            open: SurfaceStresses::new(surface, |q| fourth(q * open)),
            shear: (field.form() == ShearForm::Fields).then(|| SmoothedShear::new(factors, field.mean_shear())),
            width,
            seen: field.tables().edges(field.form().edge_exponent()),
            poisson,
            ratio: field.form().ratio().unwrap_or_default(),
            unlike,
        }
    }

    /// Distance from the edge over the width, positive inside, and the outward unit normal, from p̃ and its slopes.
    pub fn edge_seen(&self, [p, gx, gy]: [f64; 3]) -> (f64, [f64; 2]) {
        let slope = gx.hypot(gy);
        let normal = if slope > 0.0 { [-gx / slope, -gy / slope] } else { [1.0, 0.0] };
        let ratio = if p > 0.0 { p / (slope * self.width) } else { 0.0 };
        (self.seen.distance(ratio, self.along(normal)), normal)
    }

    /// Component of the normal of an edge along the sliding, −1 to 1; 0 without friction.
    fn along(&self, [nx, ny]: [f64; 2]) -> f64 {
        let [tx, ty] = self.ratio;
        if self.slides() { (tx * nx + ty * ny) / tx.hypot(ty) } else { 0.0 }
    }

    /// Whether the edge is near enough for the stress to differ from the series itself.
    pub fn sees_edge(&self, [p, gx, gy]: [f64; 3]) -> bool {
        p > ROUNDING * self.near.mean && self.seen.is_within(BLEND[1], p / (gx.hypot(gy) * self.width))
    }

    /// σ_xx, σ_yy, σ_xy near an edge at the distance `u`: of the smoothed ones in `four` the smoothed pressure `four[3]` is replaced by
    /// the pressure `p`, and the smoothed cusp of the traction by the sharp one.
    fn sharpened(&self, four: [f64; 4], near: NearEdge, (u, p): (f64, f64), [nx, ny]: [f64; 2]) -> [f64; 3] {
        // The cusp is that of the smoothed tangential fields, or under friction of μ e times the smoothed pressure.
        let (nu, [tx, ty], smoothed) = match self.shear {
            Some(_) => (self.poisson, near.shear, 1.0),
            None => (self.poisson, self.ratio, near.pressure[0]),
        };
        let (along, across) = (tx * nx + ty * ny, ty * nx - tx * ny);
        let change = four[3] - p;
        let has_cusp = self.slides() || self.shear.is_some();
        let cusp = if has_cusp { smoothed * self.seen.cusp(u, self.along([nx, ny])) } else { 0.0 };
        // Coefficients of n n, t t and n t + t n, with t = (−n_y, n_x).
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
        self.ratio != [0.0; 2]
    }

    /// State blended from sharpened stresses near an edge and σ_xx, σ_yy, σ_xy and p away from it, with the tangential fields `shear` as they
    /// are smoothed there.
    pub fn toward_open(&self, sharp: Sharp, open: [f64; 4], shear: [f64; 2]) -> StressState {
        let part = sharp.part;
        let four = std::array::from_fn(|k| (1.0 - part) * sharp.four[k] + part * open[k]);
        let state = StressState::on_surface(four, self.ratio);
        if self.shear.is_none() {
            return state;
        }
        let [xz, yz] = [0, 1].map(|axis| -((1.0 - part) * sharp.shear[axis] + part * shear[axis]));
        StressState { xz, yz, ..state }
    }

    /// Sharpened stresses near an edge.
    pub fn sharp(&self, near: NearEdge, edge: [f64; 4]) -> Sharp {
        let (u, normal) = self.edge_seen(near.pressure);
        let sharp = self.seen.sharp(u, self.along(normal));
        let p = near.pressure[0] * sharp;
        let [xx, yy, xy] = self.sharpened(edge, near, (u, p), normal);
        // Rises smoothly from 0 to 1.
        let t = ((u.abs() - BLEND[0]) / (BLEND[1] - BLEND[0])).clamp(0.0, 1.0);
        Sharp { four: [xx, yy, xy, p], shear: near.shear.map(|q| q * sharp), part: t * t * (3.0 - 2.0 * t) }
    }

    /// State outside the edge at a point on it, displacements left out.
    pub fn state_on_edge(&self, near: NearEdge, edge: [f64; 4]) -> StressState {
        let (_, normal) = self.edge_seen(near.pressure);
        let [xx, yy, xy] = self.sharpened(edge, near, (0.0, 0.0), normal);
        StressState::on_surface([xx, yy, xy, 0.0], self.ratio)
    }

    /// Stress by which the waves near an edge differ from those of the surface material, a pressure, where the pressure smoothed as the
    /// stresses are is `smoothed`.
    pub fn unlike(&self, smoothed: f64, near: NearEdge) -> f64 {
        let ([normal, tangential], [x, y]) = (self.unlike, near.shear);
        let ratio = if near.pressure[0] > 0.0 { x.hypot(y) / near.pressure[0] } else { 0.0 };
        smoothed.abs() * (normal + ratio * tangential)
    }

    /// Largest tangential traction of friction under a pressure, a pressure; zero of tangential fields.
    pub fn rubbed(&self, pressure: f64) -> f64 {
        let [x, y] = self.ratio;
        x.hypot(y) * pressure
    }

    /// The point moved onto the edge beside it, lengths, and its distance from the edge before, in widths.
    pub fn moved(&self, [x, y]: [f64; 2], near: [f64; 3]) -> ([f64; 2], f64) {
        let (u, [nx, ny]) = self.edge_seen(near);
        let step = self.width * u.clamp(-1.5, 1.5);
        ([x + step * nx, y + step * ny], u)
    }
}

impl StressField {
    /// Whether stresses at points, (x, y) and a depth, lie so near to an edge of contact that no error is known of them: within three
    /// widths of the smoothing of an edge, and within two samples of the surface.
    pub fn near_edge(&self, points: &[([f64; 2], Depth)]) -> Vec<bool> {
        let shallow = points.iter().filter(|(_, depth)| depth.z < self.shallow_depth());
        let places: Vec<[f64; 2]> = shallow.map(|&(place, _)| place).collect();
        let smoothed = if places.is_empty() { None } else { self.smoothed_edges() };
        let Some(smoothed) = smoothed else { return vec![false; points.len()] };
        let mut near = self.at(&places, &smoothed.near).into_iter();
        let mut is_near =
            |depth: Depth| depth.z < self.shallow_depth() && near.next().is_some_and(|near| smoothed.sees_edge(near));
        points.iter().map(|&(_, depth)| is_near(depth)).collect()
    }

    /// The smoothed surface; `None` where contact has no edge.
    pub(super) fn smoothed_edges(&self) -> Option<SmoothedSurface> {
        let surface = || Arc::new(self.depth_response(Depth::SURFACE, REACH));
        self.regions().have_edges().then(|| SmoothedSurface::new(self, &surface(), 1.0))
    }
}

/// Factor of the Gaussian smoothing that changes smooth fields in the fourth order alone; `qw` is wavenumber times width.
pub(super) fn fourth(qw: f64) -> f64 {
    (1.0 + 0.5 * qw * qw) * (-0.5 * qw * qw).exp()
}
