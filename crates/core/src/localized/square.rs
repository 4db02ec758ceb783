//! Influence coefficients: displacement under a uniformly loaded square, Eq. (7).
//!
//! A unit pressure on the square |x| ≤ a, |y| ≤ a displaces the surface by ∫∫ K over the square. Its first part is
//! Love's (1929), with F(u, v) = u asinh(v/u) + v asinh(u/v),
//!
//! c/(2π) [F(x+a, y+a) − F(x−a, y+a) − F(x+a, y−a) + F(x−a, y−a)];
//!
//! the correction C is smooth and is integrated by a product Gauss rule. Far away, where Love's differences cancel,
//! the rule takes all of K. The order of the rule follows from the distance of the nearest singularity: with it at
//! D half-widths from the centre, n points err by about (D + √(D²+1))^{−2n}.

use super::point::PointKernel;
use crate::numeric::quadrature::gauss;

/// Distance beyond which all of K is integrated by Gauss' rule, in half-widths.
const GAUSS_DISTANCE: f64 = 10.0;
/// Largest relative error of a Gauss rule.
const RULE_ERROR: f64 = 1e-11;
/// Largest number of points of a rule; where more are needed, the square is divided.
const MAX_POINTS: usize = 10;

/// Influence coefficients of squares of one size.
#[derive(Debug, Clone)]
pub struct Squares<'a> {
    kernel: &'a PointKernel,
    half: f64,
    /// Depth below the surface of the nearest image of the point force, in half-widths.
    image: f64,
    /// Abscissae and weights of the Gauss rules on [−1, 1], by their number of points.
    rules: Vec<Vec<[f64; 2]>>,
}

impl<'a> Squares<'a> {
    /// Squares of the half-width a = `half`, a length.
    pub fn new(kernel: &'a PointKernel, half: f64) -> Self {
        let image = kernel.thickness().map_or(f64::INFINITY, |thickness| 2.0 * thickness / half);
        Self { kernel, half, image, rules: (0..=MAX_POINTS).map(gauss).collect() }
    }

    /// Displacement at (x, y) from the centre of a square under unit pressure: a length per pressure.
    pub fn coefficient(&self, x: f64, y: f64) -> f64 {
        let distance = x.hypot(y) / self.half;
        if distance > GAUSS_DISTANCE {
            // The singularity of 1/r lies in the plane of the square.
            let points = points(distance).min(MAX_POINTS);
            return self.mean(x, y, self.half, points, |r| self.kernel.at(r)) * 4.0 * self.half * self.half;
        }
        self.kernel.factor() * self.love(x, y) + self.correction(x, y)
    }

    /// Love's part for c/(2π) = 1, a length.
    fn love(&self, x: f64, y: f64) -> f64 {
        let a = self.half;
        let corner = |u: f64, v: f64| term(u, v) + term(v, u);
        corner(x + a, y + a) - corner(x - a, y + a) - corner(x + a, y - a) + corner(x - a, y - a)
    }

    /// The layers' part: the square is divided until its parts are small against the distance of the image.
    fn correction(&self, x: f64, y: f64) -> f64 {
        if self.image.is_infinite() {
            return 0.0;
        }
        let singularity = self.image.hypot(x.hypot(y) / self.half);
        let mut parts = 1;
        while points(singularity * f64::from(parts)) > MAX_POINTS {
            parts += 1;
        }
        let half = self.half / f64::from(parts);
        let points = points(singularity * f64::from(parts));
        let offset = |part: i32| self.half * (f64::from(2 * part + 1) / f64::from(parts) - 1.0);
        let mut sum = 0.0;
        for (i, j) in (0..parts).flat_map(|i| (0..parts).map(move |j| (i, j))) {
            sum += self.mean(x - offset(i), y - offset(j), half, points, |r| self.kernel.correction(r));
        }
        self.kernel.factor() * sum * 4.0 * half * half
    }

    /// Mean of a function of the distance over a square of the half-width `half` whose centre lies (x, y) away.
    fn mean(&self, x: f64, y: f64, half: f64, points: usize, f: impl Fn(f64) -> f64) -> f64 {
        let rule = &self.rules[points];
        let mut sum = 0.0;
        for &[s, u] in rule {
            for &[t, v] in rule {
                sum += u * v * f((x - half * s).hypot(y - half * t));
            }
        }
        0.25 * sum
    }
}

/// Term u asinh(v/u) of F, 0 at u = 0.
fn term(u: f64, v: f64) -> f64 {
    if u == 0.0 { 0.0 } else { u * (v / u.abs()).asinh() }
}

/// Number of points of a Gauss rule whose nearest singularity is `distance` half-widths away.
fn points(distance: f64) -> usize {
    let ellipse = distance + (distance * distance - 1.0).max(0.0).sqrt();
    (-0.5 * RULE_ERROR.ln() / ellipse.ln().max(1e-9)).ceil().max(1.0) as usize
}
