//! Boundary of a contact spot under one indenter, between the samples.
//!
//! Outside its edge a contact opens as 3E*g/4 = A γ(d), d the distance from the edge, γ that of the layered half-space
//! ([`crate::reading::edge`]): d^{3/2} on a bare one. Around the present boundary ρ(θ)
//!
//! 3E*g/4 ≈ A(θ) [γ(d) + γ′(d) u(θ)] + (κ d + κ′ d²) γ(d)
//!
//! is fitted by least squares, A and the shift u (among near neighbours κ too) as short Fourier series, and ρ moves by u
//! until it converges. The gap is smoother than the pressure and errs less; where neighbours leave too few open samples the
//! pressure inside, p ≈ A φ(d), is fitted too, with the same A. Neighbours nearer than the radius make a channel, whose gap is
//! that of one edge over a part of the way to its middle only.
//!
//! The samples next to the edge carry the discretisation error, which alternates from ring to ring: their weight rises
//! smoothly with the distance. The fit reaches a number of spacings that grows with the square root of the resolution,
//! so that the radius converges faster than the spacing.
//!
//! **Error.** Three readings of one edge, the fit, one of half the reach without κ′ and one with the pressure, differ by
//! about as much as the first one errs.
//!
//! A **ring** has a hole, read in the same way with inside and outside exchanged.

mod beside;
mod clearance;
pub(crate) mod constants;
mod counted_rim;
mod equations;
mod fit;
mod rim;
mod spot;

pub use spot::{ContactSamples, PolarSpot, Sample};

use crate::numeric::closed_line::{self, ANGLES, mean_radius};
use constants::COUNTED_ERROR;
use counted_rim::counted_rim;
use fit::located;
use rim::Rim;
use std::f64::consts::{PI, TAU};

/// A closed boundary ρ(θ) around an indenter's axis, and the hole of a ring.
#[derive(Debug, Clone, PartialEq)]
pub struct Boundary {
    /// Radii at 360 equally spaced angles from θ = 0, the direction of x; lengths.
    pub radii: Vec<f64>,
    /// Radii of the hole at the same angles, lengths; empty without a hole.
    pub hole: Vec<f64>,
    /// Estimated error of the mean radius, a length.
    pub error: f64,
    /// Estimated error of the mean radius of the hole, a length; 0 without one.
    pub hole_error: f64,
}

impl Boundary {
    /// Boundary of a spot, and of its hole where it `is_ring`; `None` for a spot with too few samples for a fit, or without a
    /// simple boundary around the axis.
    pub(crate) fn locate(spot: &PolarSpot<'_>, samples: &ContactSamples<'_>, is_ring: bool) -> Option<Self> {
        let (radii, error) = located(spot, samples, Rim::Outer)?;
        let mut boundary = Self { radii, hole: Vec::new(), error, hole_error: 0.0 };
        if is_ring {
            (boundary.hole, boundary.hole_error) = located(spot, samples, Rim::Hole).unwrap_or_else(|| {
                let (counted, _) = counted_rim(spot, samples.sample_area, Rim::Hole);
                (vec![mean_radius(&counted); ANGLES], COUNTED_ERROR * samples.spacing)
            });
        }
        Some(boundary)
    }

    /// ρ(θ), linear between the angles; a length.
    pub fn radius(&self, theta: f64) -> f64 {
        closed_line::radius(&self.radii, theta)
    }

    /// Radius of the hole at an angle, a length; 0 without one.
    pub fn hole_radius(&self, theta: f64) -> f64 {
        if self.hole.is_empty() { 0.0 } else { closed_line::radius(&self.hole, theta) }
    }

    /// Area in contact, ½∮ρ² dθ without the hole; a length squared.
    pub fn area(&self) -> f64 {
        PI * (self.mean_radius().powi(2) - self.mean_hole_radius().powi(2))
    }

    /// Estimated error of the area, a length squared.
    pub fn area_error(&self) -> f64 {
        TAU * (self.mean_radius() * self.error + self.mean_hole_radius() * self.hole_error)
    }

    /// √(area within the boundary/π), a length.
    pub fn mean_radius(&self) -> f64 {
        mean_radius(&self.radii)
    }

    /// √(area of the hole/π), a length; 0 without one.
    pub fn mean_hole_radius(&self) -> f64 {
        mean_radius(&self.hole)
    }

    /// Smallest and largest radius, lengths.
    pub fn extremes(&self) -> (f64, f64) {
        let least = self.radii.iter().copied().fold(f64::INFINITY, f64::min);
        (least, self.radii.iter().copied().fold(0.0, f64::max))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{HalfSpace, Material};
    use crate::lattice::{Cell, Grid};
    use crate::reading::edge::ContactEdge;

    /// Pressure and gap of a contact with E* = 1 in the middle of a cell of side 4.
    struct Fields {
        grid: Grid,
        pressure: Vec<f64>,
        gap: Vec<f64>,
        hole: Vec<bool>,
    }

    /// Off the samples, so that none has a place of its own.
    fn axis(spacing: f64) -> [f64; 2] {
        [2.0 + 0.31 * spacing, 2.0 - 0.17 * spacing]
    }

    /// A boundary `edge`(θ), pressure and gap of Hertz' contact of radius 1 stretched onto it.
    fn spot(spacing: f64, edge: impl Fn(f64) -> f64) -> Fields {
        let n = (4.0 / spacing).round() as usize;
        let grid = Grid::new(Cell::square(4.0).unwrap(), [n, n]).unwrap();
        let (mut pressure, mut gap) = (Vec::new(), Vec::new());
        for index in 0..grid.len() {
            let [r, theta] = polar(&grid, spacing, index);
            let s = r / edge(theta);
            let (p, g) = if s < 1.0 {
                (2.0 / PI * (1.0 - s * s).sqrt(), 0.0)
            } else {
                (0.0, 0.5 * s * s - 1.0 + ((2.0 - s * s) * (1.0 / s).asin() + (s * s - 1.0).sqrt()) / PI)
            };
            pressure.push(p);
            // A² goes as 1/edge, so that the gap goes as √edge⁻¹ d^{3/2}.
            gap.push(edge(theta) * g);
        }
        let hole = vec![false; grid.len()];
        Fields { grid, pressure, gap, hole }
    }

    /// Distance and angle of a sample.
    fn polar(grid: &Grid, spacing: f64, index: usize) -> [f64; 2] {
        let ([x, y], [s, t]) = (axis(spacing), grid.fractions(index));
        [(4.0 * s - x).hypot(4.0 * t - y), (4.0 * t - y).atan2(4.0 * s - x)]
    }

    /// The boundary on a bare half-space.
    fn located(fields: &Fields, spacing: f64) -> Option<Boundary> {
        let bare = HalfSpace::new(vec![], Material::from_young(1.0, 0.0).unwrap());
        let [shortest, longest] = ContactSamples::distances(&fields.grid);
        let edge = ContactEdge::new(&bare.into(), None, shortest, longest);
        let Fields { grid, pressure, gap, hole } = fields;
        let what = |index: usize| match (pressure[index] > 0.0, hole[index]) {
            (true, _) => Sample::Contact,
            (_, true) => Sample::Hole,
            _ => Sample::Open,
        };
        let samples = ContactSamples {
            sample_area: spacing * spacing,
            spacing,
            pressure,
            gap,
            modulus: 1.0,
            edge: &edge,
            errors: true,
        };
        let spot = PolarSpot::new(grid, axis(spacing), 1.1, &what);
        Boundary::locate(&spot, &samples, hole.contains(&true))
    }

    #[test]
    fn a_hertzian_contact_has_its_boundary() {
        for (spacing, tolerance) in [(0.25, 2e-2), (0.1, 2e-3), (0.05, 5e-4), (0.0125, 3e-5)] {
            let boundary = located(&spot(spacing, |_| 1.0), spacing).unwrap();
            assert!((boundary.area() / PI - 1.0).abs() < tolerance, "{spacing}: {}", boundary.area() / PI - 1.0);
        }
    }

    #[test]
    fn a_three_lobed_boundary_is_recovered() {
        let edge = |theta: f64| 1.0 + 0.03 * (3.0 * theta + 0.4).cos();
        let boundary = located(&spot(0.02, edge), 0.02).unwrap();
        for theta in [0.0, 1.0, 2.5, 4.4] {
            let error = boundary.radius(theta) / edge(theta) - 1.0;
            assert!(error.abs() < 5e-4, "{theta}: {error:e}");
        }
        let (least, largest) = boundary.extremes();
        assert!((least - 0.97).abs() < 5e-4 && (largest - 1.03).abs() < 5e-4);
    }

    #[test]
    fn a_spot_of_few_samples_has_no_located_boundary() {
        assert_eq!(located(&spot(0.5, |_| 1.0), 0.5), None);
    }

    /// A ring between two edges: outside the larger one Hertz' gap, in the hole the gap of a straight edge, which errs by
    /// the order of its distance over the hole's radius.
    #[test]
    fn the_hole_of_a_ring_is_read_and_taken_off_the_area() {
        let (spacing, inner) = (0.04, 0.5);
        let mut fields = spot(spacing, |_| 1.0);
        for index in 0..fields.grid.len() {
            let [r, _] = polar(&fields.grid, spacing, index);
            if r < inner {
                (fields.pressure[index], fields.hole[index]) = (0.0, true);
                fields.gap[index] = (inner - r).powf(1.5) / 0.75;
            }
        }
        let boundary = located(&fields, spacing).unwrap();
        assert!((boundary.mean_hole_radius() / inner - 1.0).abs() < 2e-3, "{}", boundary.mean_hole_radius());
        let exact = PI * (1.0 - inner * inner);
        assert!((boundary.area() / exact - 1.0).abs() < 2e-3, "{}", boundary.area() / exact);
        assert!((boundary.area() - exact).abs() < boundary.area_error());
    }
}
