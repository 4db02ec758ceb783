//! Friction by hysteresis of a steadily moving contact: by the shape that is pushed, and by the energy that is lost.
//!
//! With the direction **e** of the motion, the initial gap f, the pressure p and its force P,
//!
//! μ = ∫ p ∂f/∂e d²x / P,  μ = ∫ p ∂w/∂e d²x (−1)/P = Σ (**k**·**e**) Im K̂ |p̂|² / P:
//!
//! in contact w = δ − f, so that both are one number, and their difference on a grid shows what the samples miss. The error of the solution
//! itself adds |Δμ| ≤ ‖e‖_C ‖∂w/∂e‖_{C⁻¹}/P, with the [bound](super::iteration::ErrorNorm) on ‖e‖_C.

use super::iteration::{ErrorNorm, Unknowns, Working};
use super::operator::{ElasticOperator, Workspace};
use super::wave_operator::WaveOperator;
use super::{Contact, LayeredOperator};
use crate::counterbody::{Shape, Surface, Topography};
use crate::numeric::sums;

/// Friction by hysteresis on one grid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hysteresis {
    /// μ by the shape that is pushed; that by energy under a given pressure.
    pub by_shape: f64,
    /// μ by the energy that is lost.
    pub by_energy: f64,
}

impl Hysteresis {
    /// Friction of a contact; `None` without a force.
    pub(super) fn of(contact: &Contact) -> Option<Self> {
        let (grid, p) = (contact.grid(), contact.pressures());
        let [force] = sums::of(p.len(), |i| [p[i]]);
        if force <= 0.0 {
            return None;
        }
        let direction = contact.problem().direction();
        let derivative = WaveOperator::derivative(grid, direction);
        let workspace = &mut Workspace::default();
        let mut rise = p.to_vec();
        derivative.apply(&mut rise, workspace);
        let (g, f) = (contact.gaps(), contact.surface().gaps());
        // ∫ ∂p/∂e w; a uniform part of w does no work with what has no mean.
        let [lost] = sums::of(p.len(), |i| [rise[i] * (g[i] - f[i])]);
        let by_energy = lost / force;
        if contact.problem().counterbody().is_none() {
            return Some(Self { by_shape: by_energy, by_energy });
        }
        let slopes = slopes(contact, &derivative, direction);
        let [pushed] = sums::of(p.len(), |i| [p[i] * slopes[i]]);
        Some(Self { by_shape: pushed / force, by_energy })
    }
}

/// ∂f/∂e at each sample in contact: by the shape of its indenter, or by the waves of a topography; zero elsewhere, where a shape may be steep
/// without end.
fn slopes(contact: &Contact, derivative: &WaveOperator, [x, y]: [f64; 2]) -> Vec<f64> {
    let (surface, p) = (contact.surface(), contact.pressures());
    let (owners, sites) = (surface.owners(), surface.sites());
    if owners.is_empty() {
        return waves(surface, contact.problem().topography(), derivative, [x, y]);
    }
    let (reduced, mut slopes) = (surface.grid().cell().reduced(), vec![0.0; owners.len()]);
    sums::update(&mut slopes, |i, _| {
        let [dx, dy] = surface.offset(&reduced, owners[i], i);
        let r = dx.hypot(dy);
        let slopes = p[i] > 0.0 && r > 0.0;
        if slopes { sites[owners[i] as usize].shape.slope(r) * (x * dx + y * dy) / r } else { 0.0 }
    });
    slopes
}

/// ∂f/∂e of a topography: by its waves, and by the profile of the ball that it stands on.
fn waves(surface: &Surface, topography: Option<&Topography>, derivative: &WaveOperator, [x, y]: [f64; 2]) -> Vec<f64> {
    let grid = surface.grid();
    let mut slopes = surface.gaps().to_vec();
    let Some(radius) = topography.and_then(Topography::ball) else {
        derivative.apply(&mut slopes, &mut Workspace::default());
        return slopes;
    };
    // Where two balls meet their profile has a kink, which waves do not hold.
    let (ball, beside) = (Shape::Sphere { radius }, topography.map(Topography::beside_ball));
    let offset = |i: usize| beside.as_ref().map_or([0.0; 2], |beside| beside(grid.fractions(i)));
    sums::update(&mut slopes, |i, f| {
        let [dx, dy] = offset(i);
        f - ball.profile(dx.hypot(dy))
    });
    derivative.apply(&mut slopes, &mut Workspace::default());
    sums::update(&mut slopes, |i, slope| {
        let [dx, dy] = offset(i);
        let r = dx.hypot(dy);
        let steep = ball.slope(r);
        slope + if r > 0.0 && steep.is_finite() { steep * (x * dx + y * dy) / r } else { 0.0 }
    });
    slopes
}

/// Bound on the error of μ by that of the solution, and ‖e‖²_C over ‖p‖²_C, of a solved contact with its operator.
pub(super) fn bound(
    operator: &mut LayeredOperator,
    working: &mut Working,
    mask: Option<&[bool]>,
    (contact, unknowns): (&Contact, &Unknowns),
) -> [f64; 2] {
    let p = contact.pressures();
    let [force] = sums::of(p.len(), |i| [p[i]]);
    let norm = ErrorNorm::of(operator, working, mask, unknowns);
    let (g, f) = (contact.gaps(), contact.surface().gaps());
    let mut slope: Vec<f64> = g.iter().zip(f).map(|(g, f)| g - f).collect();
    WaveOperator::derivative(contact.grid(), contact.problem().direction()).apply(&mut slope, &mut working.transforms);
    let mut pressure = slope.clone();
    operator.symmetric_pressure(&mut pressure, &mut working.transforms);
    let [square] = sums::of(p.len(), |i| [slope[i] * pressure[i]]);
    [norm.error * square.max(0.0).sqrt() / force, (norm.error / norm.pressure).powi(2)]
}
