//! The form of a measured surface, by least squares of the heights h over the samples with a measurement.
//!
//! Σ (h − f(x, y))² is least, with the middle of the cell as origin:
//!
//! - plane: f = c + gₓx + g_y y;
//! - second order: f = c + gₓx + g_y y + ½Hₓₓx² + Hₓ_y xy + ½H_yy y²;
//! - sphere and cylinder ([`Round`]): f − c is the root of κ(|**p**|² − (**p**·**t**)²) = 2 **p**·**n** that is 0 at the origin, the side of
//!   the surface nearer to the tangent plane, **p** = (x, y, f − c), for the curvature κ = ±1/R, the normal **n** ∝ (−gₓ, −g_y, 1) in the
//!   middle and the axis **t** ⊥ **n** of a cylinder, 0 of a sphere. Both are planes for κ = 0: a flat surface needs no other case.

use super::polynomial::{Polynomial, Samples};
use super::round::Round;
use crate::lattice::Cell;
use crate::numeric::array::field;
use crate::numeric::sums;
use ndarray::Array2;
use serde::Serialize;

/// Form that is subtracted from a surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub enum SurfaceForm {
    /// None.
    #[serde(rename = "none")]
    None,
    /// The mean plane.
    #[serde(rename = "plane")]
    Plane,
    /// The paraboloid of second order with any principal curvatures.
    #[serde(rename = "second order")]
    SecondOrder,
    /// A sphere, cap or cup.
    #[serde(rename = "sphere")]
    Sphere,
    /// A cylinder whose axis has any direction.
    #[serde(rename = "cylinder")]
    Cylinder,
}

impl SurfaceForm {
    /// Name in case files.
    pub fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Plane => "plane",
            Self::SecondOrder => "second order",
            Self::Sphere => "sphere",
            Self::Cylinder => "cylinder",
        }
    }
}

/// Why a form is not found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum FormError {
    /// Too few samples have a measurement, or they lie on a line.
    #[error("the samples with a measurement do not determine a {}", .0.name())]
    Undetermined(SurfaceForm),
    /// The iteration does not end, or ends with the equator at a sample.
    #[error("no {} fits the heights: do they rise beyond its equator?", .0.name())]
    NotFound(SurfaceForm),
}

/// Heights minus their form, lengths, on a cell; NaN where there is no measurement, before and after. Radius of a sphere or cylinder, a
/// length.
///
/// # Errors
/// [`FormError`].
pub fn without_form(
    cell: Cell,
    heights: Array2<f64>,
    form: SurfaceForm,
) -> Result<(Array2<f64>, Option<f64>), FormError> {
    let heights = if heights.is_standard_layout() { heights } else { heights.as_standard_layout().into_owned() };
    let samples = Samples::new(cell, &heights);
    let polynomial = |count| Polynomial::fit(&samples, count).ok_or(FormError::Undetermined(form));
    let unit = samples.unit;
    match form {
        SurfaceForm::None => Ok((heights, None)),
        SurfaceForm::Plane | SurfaceForm::SecondOrder => {
            let fitted = polynomial(if form == SurfaceForm::Plane { 3 } else { 6 })?;
            let rest = rest(&samples, |place| fitted.at(place));
            Ok((rest, None))
        }
        SurfaceForm::Sphere | SurfaceForm::Cylinder => {
            let fitted =
                Round::fit(&samples, polynomial(6)?, form == SurfaceForm::Cylinder).ok_or(FormError::NotFound(form))?;
            // The fit has a height at every sample with a measurement; elsewhere there is nothing to subtract it from.
            let rest = rest(&samples, |place| fitted.at(place).unwrap_or(f64::NAN));
            Ok((rest, fitted.radius().map(|radius| unit * radius)))
        }
    }
}

/// Heights minus a form with this height, in units, at a place; lengths.
fn rest(samples: &Samples<'_>, form: impl Fn([f64; 2]) -> f64 + Sync + Send) -> Array2<f64> {
    let mut rest = samples.heights.to_vec();
    sums::update(
        &mut rest,
        |k, height| if height.is_nan() { height } else { height - samples.unit * form(samples.place(k)) },
    );
    field(samples.points, rest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::least_squares;

    fn cell() -> Cell {
        Cell::new([9.0, 0.0], [1.5, 6.0]).unwrap()
    }

    /// Heights at places from the middle of the cell, with two holes.
    fn surface(height: impl Fn([f64; 2]) -> f64) -> Array2<f64> {
        let ([[x1, y1], [x2, y2]], [n1, n2]) = (cell().vectors(), [18, 14]);
        Array2::from_shape_fn([n1, n2], |(i, j)| {
            let [s, t] = [(i as f64 - 8.5) / n1 as f64, (j as f64 - 6.5) / n2 as f64];
            if [(0, 3), (9, 9)].contains(&(i, j)) { f64::NAN } else { height([s * x1 + t * x2, s * y1 + t * y2]) }
        })
    }

    fn largest(rest: &Array2<f64>) -> f64 {
        assert_eq!(rest.iter().filter(|height| height.is_nan()).count(), 2);
        rest.iter().copied().filter(|height| !height.is_nan()).fold(0.0, |most, height| most.max(height.abs()))
    }

    #[test]
    fn each_form_vanishes_when_it_is_subtracted() {
        let plane = |[x, y]: [f64; 2]| 3.0 + 0.1 * x - 0.02 * y;
        let ball = |radius: f64, [x0, y0]: [f64; 2]| {
            move |[x, y]: [f64; 2]| radius.signum() * (radius * radius - (x - x0).powi(2) - (y - y0).powi(2)).sqrt()
        };
        // Along (3, 4)/5, the axis inclined by the slope 0.1 along it.
        let roll = |radius: f64| {
            move |[x, y]: [f64; 2]| {
                let (along, across) = (0.6 * x + 0.8 * y, 0.8 * x - 0.6 * y - 0.3);
                0.1 * along + radius.signum() * ((radius * radius - across * across) * 1.01).sqrt()
            }
        };
        let check = |heights: Array2<f64>, form: SurfaceForm, radius: Option<f64>| {
            let (rest, found) = without_form(cell(), heights, form).unwrap();
            // Round-off of coordinates of some tens, in a fit of squares.
            assert!(largest(&rest) < 1e-10, "{form:?} {radius:?}: {}", largest(&rest));
            match (radius, found) {
                (Some(radius), Some(found)) => assert!((found / radius.abs() - 1.0).abs() < 1e-8, "{form:?}: {found}"),
                (None, _) => {}
                other => panic!("{form:?}: {other:?}"),
            }
        };
        for form in [SurfaceForm::Plane, SurfaceForm::SecondOrder, SurfaceForm::Sphere, SurfaceForm::Cylinder] {
            check(surface(plane), form, None);
        }
        check(
            surface(|[x, y]| plane([x, y]) + 0.03 * x * x - 0.01 * x * y - 0.02 * y * y),
            SurfaceForm::SecondOrder,
            None,
        );
        for radius in [8.0, -20.0, 3000.0] {
            check(surface(ball(radius, [0.5, -1.0])), SurfaceForm::Sphere, Some(radius));
            check(surface(roll(radius)), SurfaceForm::Cylinder, Some(radius));
        }
    }

    /// The rest of a rough sphere has no correlation with small changes of the sphere: what least squares are.
    #[test]
    fn the_sphere_of_a_rough_cap_is_the_best_one() {
        let rough = |[x, y]: [f64; 2]| (40.0 - x * x - y * y).sqrt() + 0.05 * (7.0 * x).sin() * (5.0 * y).cos();
        let heights = surface(rough);
        let squares =
            |rest: &Array2<f64>| rest.iter().filter(|rest| !rest.is_nan()).map(|rest| rest * rest).sum::<f64>();
        let (rest, radius) = without_form(cell(), heights.clone(), SurfaceForm::Sphere).unwrap();
        let (least, radius) = (squares(&rest), radius.unwrap());
        assert!((radius / 40f64.sqrt() - 1.0).abs() < 0.02, "{radius}");
        let samples = Samples::new(cell(), &heights);
        let fitted = Round::fit(&samples, Polynomial::fit(&samples, 6).unwrap(), false).unwrap();
        for k in 0..4 {
            for change in [-1e-3, 1e-3] {
                let mut other = fitted;
                other.parameters[k] += change;
                let of = |k: usize| samples.unit * (samples.height(k) - other.at(samples.place(k)).unwrap());
                let sum: f64 = (0..samples.len()).map(of).filter(|rest| !rest.is_nan()).map(|rest| rest * rest).sum();
                assert!(sum > least, "parameter {k}: {sum} {least}");
            }
        }
    }

    #[test]
    fn the_plane_is_that_of_the_normal_equations() {
        let height = |i: usize, j: usize| 2.0 + 0.3 * i as f64 - 0.7 * j as f64 + ((i * i + 3 * j) % 7) as f64;
        let heights = Array2::from_shape_fn((9, 6), |(i, j)| height(i, j));
        let rows = (0..54).map(|k| (vec![1.0, (k / 6) as f64, (k % 6) as f64], height(k / 6, k % 6)));
        let c = least_squares::fit(3, rows).unwrap();
        let (rest, _) = without_form(Cell::square(1.0).unwrap(), heights, SurfaceForm::Plane).unwrap();
        for ((i, j), rest) in rest.indexed_iter() {
            let expected = height(i, j) - c[0] - c[1] * i as f64 - c[2] * j as f64;
            assert!((rest - expected).abs() < 1e-12);
        }
    }

    /// A ball on a floor: the smallest sphere that reaches all samples is not its sphere. Without the floor its sphere is found.
    #[test]
    fn samples_beyond_the_equator_are_refused() {
        let ball = |radius: f64, floor: f64| {
            let height = move |(i, j): (usize, usize)| {
                let (x, y): (f64, f64) = (i as f64 - 31.5, j as f64 - 31.5);
                let left = radius * radius - x * x - y * y;
                if left > 0.04 * radius * radius { left.sqrt() } else { floor }
            };
            let heights = Array2::from_shape_fn((64, 64), height);
            without_form(Cell::square(64.0).unwrap(), heights, SurfaceForm::Sphere).map(|(_, radius)| radius)
        };
        for radius in [40.6, 43.0] {
            assert_eq!(ball(radius, 0.0), Err(FormError::NotFound(SurfaceForm::Sphere)), "{radius}");
            let found = ball(radius, f64::NAN).unwrap().unwrap();
            assert!((found / radius - 1.0).abs() < 1e-6, "{radius}: {found}");
        }
    }

    #[test]
    fn what_no_form_fits_is_refused() {
        let line = surface(|_| 1.0).mapv(|_| f64::NAN);
        let mut three = line.clone();
        (0..3).for_each(|j| three[[4, j]] = j as f64);
        assert_eq!(without_form(cell(), three, SurfaceForm::Plane), Err(FormError::Undetermined(SurfaceForm::Plane)));
        assert_eq!(without_form(cell(), line.clone(), SurfaceForm::None).unwrap().1, None);
        assert_eq!(without_form(cell(), line, SurfaceForm::Sphere), Err(FormError::Undetermined(SurfaceForm::Sphere)));
    }
}
