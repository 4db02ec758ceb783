//! Shapes of rigid indenters and the levels they form, Eq. (1) of Goryacheva & Torskaya (2019).
//!
//! An indenter of level m has the profile f_m(r): the distance of its surface above its apex at
//! the radius r from its axis. The drop d_m = h₁ − h_m ≥ 0 of the level is the distance of its apex behind that of the highest
//! level, which touches first.

use super::MeasuredTip;
use crate::notation::number;
use std::fmt;
use std::sync::Arc;

/// Why an indenter cannot be built.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum IndenterError {
    /// A size that is zero, negative or not finite.
    #[error("the {name} of a {shape} must be positive and finite, not {value}")]
    NotPositive {
        /// Name of the shape.
        shape: &'static str,
        /// Name of the size.
        name: &'static str,
        /// The value given.
        value: f64,
    },
    /// A height that is not finite.
    #[error("the height of a level must be finite, not {0}")]
    Height(f64),
}

/// Profile f(r) of a rigid axisymmetric indenter.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// Paraboloid f = r²/(2R), R the radius of curvature at the apex.
    Paraboloid {
        /// Radius of curvature R, a length.
        radius: f64,
    },
    /// Sphere f = R − √(R² − r²) up to the equator, and a flat plate beyond: f = R for r ≥ R.
    Sphere {
        /// Radius R, a length.
        radius: f64,
    },
    /// Cone f = s r.
    Cone {
        /// Slope s of the flank against the surface, dimensionless.
        slope: f64,
    },
    /// Power law f = c rⁿ.
    Power {
        /// Coefficient c, a length to the power 1 − n.
        coefficient: f64,
        /// Exponent n > 0.
        exponent: f64,
    },
    /// Sphere of the radius R near the apex, which goes over tangentially into a cone of the slope s at r = R s/√(1 + s²).
    SpheroCone {
        /// Radius R of the sphere, a length.
        radius: f64,
        /// Slope s of the cone against the surface, dimensionless; cot α of the half angle α between its flank and its axis.
        slope: f64,
    },
    /// Profile of equal area of a tip that was measured.
    Measured(Arc<MeasuredTip>),
}

impl Shape {
    /// Name of the shape in case files.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Paraboloid { .. } => "paraboloid",
            Self::Sphere { .. } => "sphere",
            Self::Cone { .. } => "cone",
            Self::Power { .. } => "power",
            Self::SpheroCone { .. } => "sphero-cone",
            Self::Measured(_) => "measured",
        }
    }

    /// Profile f at the radius `r` ≥ 0, a length.
    pub fn profile(&self, r: f64) -> f64 {
        match *self {
            Self::Paraboloid { radius } => r * r / (2.0 * radius),
            Self::Sphere { radius } if r < radius => cap(radius, r),
            Self::Sphere { radius } => radius,
            Self::Cone { slope } => slope * r,
            Self::Power { coefficient, exponent } => coefficient * r.powf(exponent),
            Self::SpheroCone { radius, slope } => {
                let rim = radius * slope / slope.hypot(1.0);
                if r < rim { cap(radius, r) } else { cap(radius, rim) + slope * (r - rim) }
            }
            Self::Measured(ref tip) => tip.profile(r),
        }
    }

    /// Replaces squared radii by the profiles at these radii, lengths.
    pub(crate) fn profiles(&self, squares: &mut [f64]) {
        match *self {
            Self::Paraboloid { radius } => squares.iter_mut().for_each(|square| *square /= 2.0 * radius),
            _ => squares.iter_mut().for_each(|square| *square = self.profile(square.sqrt())),
        }
    }

    /// Slope f′ of the flank at the radius `r` ≥ 0, dimensionless; infinite at and beyond the equator of a sphere.
    pub fn slope(&self, r: f64) -> f64 {
        match *self {
            Self::Paraboloid { radius } => r / radius,
            Self::Sphere { radius } if r < radius => r / ((radius - r) * (radius + r)).sqrt(),
            Self::Sphere { .. } => f64::INFINITY,
            Self::Cone { slope } => slope,
            Self::Power { coefficient, exponent } => coefficient * exponent * r.powf(exponent - 1.0),
            Self::SpheroCone { radius, slope } if r < radius * slope / slope.hypot(1.0) => {
                r / ((radius - r) * (radius + r)).sqrt()
            }
            Self::SpheroCone { slope, .. } => slope,
            Self::Measured(ref tip) => tip.slope(r),
        }
    }

    /// Radius of the cross-section at a distance `depth` ≥ 0 from the apex, f(r) = depth; lengths. `None` at and beyond the equator of a
    /// sphere.
    pub fn section_radius(&self, depth: f64) -> Option<f64> {
        let ball = |radius: f64| (depth * (2.0 * radius - depth)).sqrt();
        match *self {
            Self::Paraboloid { radius } => Some((2.0 * radius * depth).sqrt()),
            Self::Sphere { radius } => (depth < radius).then(|| ball(radius)),
            Self::Cone { slope } => Some(depth / slope),
            Self::Power { coefficient, exponent } => Some((depth / coefficient).powf(1.0 / exponent)),
            Self::SpheroCone { radius, slope } => {
                let rim = radius * slope / slope.hypot(1.0);
                let beyond = depth - cap(radius, rim);
                Some(if beyond < 0.0 { ball(radius) } else { rim + beyond / slope })
            }
            Self::Measured(ref tip) => Some(tip.section_radius(depth)),
        }
    }

    /// Whether the pressure is infinite on the axis once the apex is in contact.
    ///
    /// Under f = c rⁿ it varies as r^{n−1}: infinite for n < 1, as ln 1/r for n = 1, a finite cusp for 1 < n < 2.
    pub fn singular_peak(&self) -> bool {
        self.exponent() <= 1.0
    }

    /// Radius of curvature at the apex, a length; `None` of shapes without one.
    pub fn apex_radius(&self) -> Option<f64> {
        match *self {
            Self::Paraboloid { radius } | Self::Sphere { radius } | Self::SpheroCone { radius, .. } => Some(radius),
            Self::Power { coefficient, exponent: 2.0 } => Some(0.5 / coefficient),
            Self::Cone { .. } | Self::Power { .. } | Self::Measured(_) => None,
        }
    }

    /// Exponent n of the profile near the apex, f ~ rⁿ.
    pub fn exponent(&self) -> f64 {
        match *self {
            Self::Paraboloid { .. } | Self::Sphere { .. } | Self::SpheroCone { .. } | Self::Measured(_) => 2.0,
            Self::Cone { .. } => 1.0,
            Self::Power { exponent, .. } => exponent,
        }
    }

    fn sizes(&self) -> Vec<(&'static str, f64)> {
        match *self {
            Self::Paraboloid { radius } | Self::Sphere { radius } => vec![("radius", radius)],
            Self::Cone { slope } => vec![("slope", slope)],
            Self::Power { coefficient, exponent } => vec![("coefficient", coefficient), ("exponent", exponent)],
            Self::SpheroCone { radius, slope } => vec![("radius", radius), ("slope", slope)],
            Self::Measured(ref tip) => {
                let [least, most] = tip.range();
                vec![("least radius", least), ("largest radius", most)]
            }
        }
    }
}

/// Slope against the surface of a flank whose angle to the axis is this, degrees.
pub fn flank_slope(half_angle: f64) -> f64 {
    (90.0 - half_angle).to_radians().tan()
}

/// Angle to the axis, degrees, of a flank of this slope against the surface.
pub fn half_angle(slope: f64) -> f64 {
    90.0 - slope.atan().to_degrees()
}

/// R − √(R² − r²) without cancellation near the apex.
fn cap(radius: f64, r: f64) -> f64 {
    r * r / (radius + ((radius - r) * (radius + r)).sqrt())
}

impl fmt::Display for Shape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sizes: Vec<String> =
            self.sizes().iter().map(|(name, value)| format!("{name} {}", number(*value))).collect();
        write!(f, "{}, {}", self.name(), sizes.join(", "))
    }
}

/// One level of a multi-level system: equal indenters of equal height.
#[derive(Debug, Clone, PartialEq)]
pub struct Level {
    shape: Shape,
    height: f64,
}

impl Level {
    /// Level of indenters of the given shape whose apices protrude to `height` (a length; only differences matter).
    ///
    /// # Errors
    /// [`IndenterError`] when a size is not positive and finite or the height not finite.
    pub fn new(shape: Shape, height: f64) -> Result<Self, IndenterError> {
        for (name, value) in shape.sizes() {
            if !(value.is_finite() && value > 0.0) {
                return Err(IndenterError::NotPositive { shape: shape.name(), name, value });
            }
        }
        if !height.is_finite() {
            return Err(IndenterError::Height(height));
        }
        Ok(Self { shape, height })
    }

    /// Shape of the level's indenters.
    pub fn shape(&self) -> &Shape {
        &self.shape
    }

    /// Height h_m of the level's apices, a length.
    pub fn height(&self) -> f64 {
        self.height
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHAPES: [Shape; 5] = [
        Shape::Paraboloid { radius: 0.8 },
        Shape::Sphere { radius: 0.8 },
        Shape::Cone { slope: 0.3 },
        Shape::Power { coefficient: 2.0, exponent: 3.5 },
        Shape::SpheroCone { radius: 0.8, slope: 0.3 },
    ];

    #[test]
    fn a_sphere_is_a_paraboloid_at_its_apex_and_flat_beyond_its_equator() {
        let (sphere, paraboloid) = (Shape::Sphere { radius: 2.0 }, Shape::Paraboloid { radius: 2.0 });
        let r = 1e-4;
        assert!((sphere.profile(r) / paraboloid.profile(r) - 1.0).abs() < 1e-8);
        assert!((sphere.profile(1.2) - 0.4).abs() < 1e-15);
        assert_eq!(sphere.profile(2.5), 2.0);
    }

    #[test]
    fn profiles_of_squares_are_those_at_their_roots() {
        for shape in SHAPES {
            let mut squares = [0.0, 1e-8, 0.1, 0.64, 2.0];
            let expected = squares.map(|square: f64| shape.profile(square.sqrt()));
            shape.profiles(&mut squares);
            assert!(
                squares.iter().zip(expected).all(|(f, profile)| (f - profile).abs() <= 1e-15 * profile),
                "{squares:?}"
            );
        }
    }

    /// The rim of a Rockwell diamond, 120° and 200 µm, is at R cos 60° = 100 µm and R(1 − sin 60°) above the apex.
    #[test]
    fn a_sphero_cone_goes_over_into_its_flank_without_a_kink() {
        let (radius, slope) = (200.0, 30f64.to_radians().tan());
        let tip = Shape::SpheroCone { radius, slope };
        let height = radius * (1.0 - 60f64.to_radians().sin());
        assert!((tip.profile(100.0) - height).abs() < 1e-12 && (tip.slope(100.0) - slope).abs() < 1e-12);
        let [inside, outside] = [100.0 - 1e-7, 100.0 + 1e-7].map(|r| [tip.profile(r), tip.slope(r)]);
        assert!((inside[0] - outside[0]).abs() < 2e-7 && (inside[1] - outside[1]).abs() < 1e-8);
        assert_eq!(tip.profile(40.0), Shape::Sphere { radius }.profile(40.0));
        assert!((tip.profile(300.0) - (height + 200.0 * slope)).abs() < 1e-12 && !tip.singular_peak());
        assert!(Level::new(Shape::SpheroCone { radius: 0.0, slope }, 0.0).is_err());
    }

    /// The radius of a section is that at which the profile has its depth; a sphere has none beyond its equator.
    #[test]
    fn sections_have_the_radius_of_the_profile() {
        let tip = MeasuredTip::from_areas(&[[0.05, 0.4], [0.2, 1.9], [0.7, 14.0]]).unwrap();
        for shape in SHAPES.into_iter().chain([Shape::Measured(Arc::new(tip))]) {
            for depth in [1e-6, 0.01, 0.05, 0.3, 0.75] {
                let radius = shape.section_radius(depth).unwrap();
                assert!((shape.profile(radius) / depth - 1.0).abs() < 1e-9, "{shape}, {depth}: {radius}");
            }
        }
        assert_eq!(Shape::Sphere { radius: 0.8 }.section_radius(0.9), None);
    }

    #[test]
    fn a_power_law_contains_paraboloid_and_cone() {
        let close = |a: f64, b: f64| (a - b).abs() < 1e-15;
        let (r, radius, slope) = (0.37, 0.8, 0.3);
        let square = Shape::Power { coefficient: 0.5 / radius, exponent: 2.0 };
        assert!(close(square.profile(r), Shape::Paraboloid { radius }.profile(r)));
        let linear = Shape::Power { coefficient: slope, exponent: 1.0 };
        assert!(close(linear.profile(r), Shape::Cone { slope }.profile(r)));
    }

    #[test]
    fn pressure_is_infinite_under_a_tip_and_finite_under_a_cusp() {
        let power = |exponent| Shape::Power { coefficient: 1.0, exponent }.singular_peak();
        assert!(Shape::Cone { slope: 0.1 }.singular_peak() && power(1.0) && power(0.5));
        assert!(!Shape::Paraboloid { radius: 1.0 }.singular_peak() && !power(1.01) && !power(2.0));
    }

    #[test]
    fn sizes_that_are_not_positive_are_refused() {
        assert!(Level::new(Shape::Cone { slope: -0.1 }, 0.0).is_err());
        assert!(Level::new(Shape::Sphere { radius: f64::NAN }, 0.0).is_err());
        assert!(Level::new(Shape::Sphere { radius: 1.0 }, f64::INFINITY).is_err());
    }
}
