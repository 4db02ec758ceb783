//! The operator of one contact in free space: pressure on a window of samples → normal displacement of the surfaces there.
//!
//! w(x_i) = Σ_j K_{i−j} p_j with the [kernel](super::kernel), by a convolution on the [padded window](super::padded_window): no image, and
//! w → 0 far away. What the window's pressures displace does not depend on the window.
//!
//! K is symmetric and positive on any set of samples. Its inverse is not known in closed form: the preconditioner is the C⁻¹ of
//! the window repeated periodically at the same spacings, which is near to it for waves shorter than the contact.

use super::kernel::{OfWavenumber, Window};
use super::padded_window::{multiplier, padded, repeated, skew_part};
use crate::body::{Bodies, Compliances};
use crate::friction::Friction;
use crate::lattice::Grid;
use crate::spectral::layered_operator::{LayeredOperator, Skew};
use crate::spectral::transforms::Transforms;
use std::fmt;

/// Least wavenumber, over the largest of the grid, at which the compliance of the layered bodies is evaluated: below, it is that of
/// the substrates to rounding.
const LEAST_WAVENUMBER: f64 = 1e-11;
/// Number of wavenumbers at which a kernel evaluates a compliance, in order of magnitude.
pub(in crate::spectral) const EVALUATIONS: usize = 100_000;

/// How a shear traction that goes with the pressure displaces the surfaces.
#[derive(Clone, Copy)]
pub struct Coupling<'a> {
    /// Traction on the body over the pressure, μ**e**.
    pub traction: [f64; 2],
    /// b(k) = kB̂(k), lengths per pressure times wavenumber, finite at k = 0: ŵ = (Ĉ − i(**t**·**k**/k)B̂) p̂ for the traction **t**.
    pub response: OfWavenumber<'a>,
    /// Largest |b/c| over the wavenumbers of the grid.
    pub largest_ratio: f64,
}

impl fmt::Debug for Coupling<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { traction, largest_ratio, .. } = self;
        f.debug_struct("Coupling")
            .field("traction", traction)
            .field("largest_ratio", largest_ratio)
            .finish_non_exhaustive()
    }
}

impl LayeredOperator {
    /// Operator of the bodies in free space, without friction.
    ///
    /// # Panics
    /// When the cell of the grid, the window, is not a rectangle.
    pub fn in_free_space(grid: &Grid, bodies: impl Into<Bodies>) -> Self {
        Self::combined_in_free_space(grid, &[(1.0, &bodies.into())])
    }

    /// Σ wᵢ Cᵢ of several bodies in free space, without friction.
    pub(in crate::spectral) fn combined_in_free_space(grid: &Grid, bodies: &[(f64, &Bodies)]) -> Self {
        let weighted =
            bodies.iter().map(|(weight, bodies)| (*weight, Compliances::new(bodies, range(grid), EVALUATIONS)));
        let compliances: Vec<(f64, Compliances<'_>)> = weighted.collect();
        let c = |k: f64| k * compliances.iter().map(|(weight, compliance)| weight * compliance.at(k)).sum::<f64>();
        Self::of_kernel(grid, &c, None)
    }

    /// Operator of the bodies in free space, the counterbody sliding with `friction`.
    ///
    /// # Panics
    /// When the cell of the grid, the window, is not a rectangle.
    pub fn sliding_in_free_space(grid: &Grid, bodies: impl Into<Bodies>, friction: &Friction) -> Self {
        let bodies = bodies.into();
        if !friction.couples() {
            return Self::in_free_space(grid, bodies);
        }
        let compliances = Compliances::coupled(&bodies, range(grid), EVALUATIONS);
        let c = |k: f64| k * compliances.at(k);
        let [n1, n2] = grid.points();
        let components = (0..=n1 / 2).flat_map(|k1| (0..=n2 / 2).map(move |k2| [k1, k2])).skip(1);
        let ratios = components.map(|component| compliances.coupling_ratio(grid.wavenumber(component)).abs());
        let coupling = Coupling {
            traction: friction.traction(),
            response: &|k| c(k) * compliances.coupling_ratio(k),
            largest_ratio: ratios.fold(0.0, f64::max),
        };
        Self::of_kernel(grid, &c, Some(coupling))
    }

    /// Operator in free space of bodies with c(k) = kĈ(k), the compliance of both together times the wavenumber, a length per pressure
    /// times 1/length, finite at k = 0; with the coupling of both where friction couples.
    ///
    /// # Panics
    /// When the cell of the grid, the window, is not a rectangle.
    pub fn of_kernel(grid: &Grid, c: OfWavenumber<'_>, coupling: Option<Coupling<'_>>) -> Self {
        assert!(grid.cell().is_rectangular(), "the window of a contact in free space is a rectangle");
        let steps = grid.steps();
        let window = Window { spacings: steps.map(|[x, y]| x.hypot(y)), points: grid.points() };
        let transforms = Transforms::padded(window.points, padded(window.points));
        let skew = coupling.map(|coupling| {
            let along = [0, 1].map(|axis| {
                let [x, y] = steps[axis];
                (coupling.traction[0] * x + coupling.traction[1] * y) / window.spacings[axis]
            });
            let Coupling { traction: [x, y], largest_ratio, .. } = coupling;
            (skew_part(&transforms.double, window, along, coupling.response), x.hypot(y) * largest_ratio)
        });
        let kernel = multiplier(&transforms.double, window, c);
        let unit = c(grid.least_wavenumber()) / grid.least_wavenumber();
        let (repeated, compliance) = repeated(grid, c);
        let operator = Self::of(transforms, kernel, unit).in_window(repeated, compliance);
        match skew {
            Some((part, largest)) => operator.coupled(Skew::Part(part), largest),
            None => operator,
        }
    }
}

/// Wavenumbers at which a grid asks the bodies, from its spacings alone, so that every window has the same compliance.
pub(in crate::spectral) fn range(grid: &Grid) -> [f64; 2] {
    let largest = grid.largest_wavenumber();
    [LEAST_WAVENUMBER * largest, largest]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{HalfSpace, Interface, Layer, Material};
    use crate::lattice::Cell;
    use crate::spectral::by_rows::{ResultRows, rows_of, rows_to};
    use crate::spectral::free_space::padded_window::bytes_per_sample;
    use crate::spectral::operator::{ElasticOperator, TractionUpdate, Workspace};

    fn coated() -> HalfSpace {
        let layer = Layer::new(Material::from_shear(3.0, 0.2).unwrap(), 0.8, Interface::Bonded).unwrap();
        HalfSpace::new(vec![layer], Material::from_shear(1.0, 0.3).unwrap())
    }

    /// A window of spacings d₁, d₂.
    fn grid([d1, d2]: [f64; 2], points: [usize; 2]) -> Grid {
        let sides = [d1 * points[0] as f64, d2 * points[1] as f64];
        Grid::new(Cell::new([sides[0], 0.0], [0.0, sides[1]]).unwrap(), points).unwrap()
    }

    fn noise(len: usize) -> Vec<f64> {
        (0..len).map(|k| ((k * k * 7919 + k * 131) % 1009) as f64 / 1009.0 - 0.3).collect()
    }

    fn largest(field: &[f64]) -> f64 {
        field.iter().fold(0.0, |largest, value| value.abs().max(largest))
    }

    /// Σ_j (K + t₁K¹ + t₂K²)_{i−j} p_j.
    fn direct(window: &Window, half_space: &HalfSpace, traction: [f64; 2], p: &[f64]) -> Vec<f64> {
        let response = half_space.response();
        let c = |k: f64| k * response.compliance(k);
        let b = |k: f64| k * response.surface(k).coupling;
        let (even, odd) = (window.kernel(&c), [0, 1].map(|axis| window.coupling_kernel(&b, axis)));
        let [_, n2] = window.points;
        let at = |i: usize, j: usize| {
            let offsets = [(i / n2) as f64 - (j / n2) as f64, (i % n2) as f64 - (j % n2) as f64];
            let place = offsets.map(|offset| offset.abs() as usize);
            let skew = [0, 1].map(|axis| traction[axis] * offsets[axis].signum() * odd[axis][place]);
            even[place] + skew[0] + skew[1]
        };
        (0..p.len()).map(|i| (0..p.len()).map(|j| at(i, j) * p[j]).sum()).collect()
    }

    #[test]
    fn a_convolution_is_its_direct_double_sum() {
        let half_space = coated();
        for (spacings, points) in
            [([0.5, 0.3], [12, 9]), ([0.3, 0.4], [7, 22]), ([0.2, 0.2], [130, 2]), ([1.0, 1.0], [1, 17])]
        {
            for friction in [None, Some([1.0, 0.0]), Some([0.0, -1.0]), Some([0.6, -0.8])] {
                let friction = friction.map(|direction| Friction::new(0.7, direction).unwrap());
                let grid = grid(spacings, points);
                let mut operator = match &friction {
                    Some(friction) => LayeredOperator::sliding_in_free_space(&grid, &half_space, friction),
                    None => LayeredOperator::in_free_space(&grid, &half_space),
                };
                let traction = friction.map_or([0.0; 2], |friction| friction.traction());
                let p = noise(grid.len());
                let expected = direct(&Window { spacings, points }, &half_space, traction, &p);
                let mut workspace = Workspace::default();
                let mut w = p.clone();
                operator.displacement(&mut w, &mut workspace);
                let error = |w: &[f64]| {
                    largest(&w.iter().zip(&expected).map(|(a, b)| a - b).collect::<Vec<_>>()) / largest(&expected)
                };
                assert!(error(&w) < 1e-14, "{points:?}, {traction:?}: {:e}", error(&w));
                let single: Vec<f32> = p.iter().map(|&p| p as f32).collect();
                let (blocks, mut w, unit) = (operator.blocks(), vec![0.0f32; p.len()], operator.unit());
                rayon::scope(|_| {
                    let (memory, _) = operator.split(&mut workspace);
                    let displaced =
                        operator.displaced_single(TractionUpdate::Updated, memory, rows_of(blocks, &single));
                    displaced.rows(rows_to(blocks, &mut w));
                });
                let w: Vec<f64> = w.into_iter().map(|w| unit * f64::from(w)).collect();
                assert!(error(&w) < 1e-6, "{points:?}, {traction:?}, single: {:e}", error(&w));
            }
        }
    }

    #[test]
    fn a_pressure_displaces_the_same_in_every_window() {
        let half_space = coated();
        let friction = Friction::new(0.5, [1.0, 2.0]).unwrap();
        let displaced = |points: [usize; 2]| {
            let grid = grid([0.25, 0.5], points);
            let mut w = vec![0.0; grid.len()];
            for (k, p) in noise(20 * 30).into_iter().enumerate() {
                w[k / 30 * points[1] + k % 30] = p;
            }
            let mut operator = LayeredOperator::sliding_in_free_space(&grid, &half_space, &friction);
            operator.displacement(&mut w, &mut Workspace::default());
            (0..20 * 30).map(|k| w[k / 30 * points[1] + k % 30]).collect::<Vec<_>>()
        };
        let first = displaced([20, 30]);
        for points in [[48, 48], [64, 64], [60, 96], [31, 45]] {
            let other = displaced(points);
            let difference: Vec<f64> = first.iter().zip(&other).map(|(a, b)| a - b).collect();
            assert!(largest(&difference) < 2e-15 * largest(&first), "{points:?}: {:e}", largest(&difference));
        }
    }

    #[test]
    fn every_pressure_does_positive_work_and_the_operator_is_symmetric() {
        let grid = grid([0.2, 0.3], [30, 24]);
        let stiff = Layer::new(Material::from_shear(1e3, 0.2).unwrap(), 0.05, Interface::Bonded).unwrap();
        for half_space in [coated(), HalfSpace::new(vec![stiff], Material::from_shear(1.0, 0.3).unwrap())] {
            let mut operator = LayeredOperator::in_free_space(&grid, &half_space);
            let mut displaced = |p: &[f64]| {
                let mut w = p.to_vec();
                operator.displacement(&mut w, &mut Workspace::default());
                w
            };
            let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
            // A uniform, a random, and the most wavy pressure.
            let wavy: Vec<f64> = (0..grid.len()).map(|k| if (k / 24 + k % 24) % 2 == 0 { 1.0 } else { -1.0 }).collect();
            let pressures = [vec![1.0; grid.len()], noise(grid.len()), wavy];
            for p in &pressures {
                for q in &pressures {
                    let (wp, wq) = (displaced(p), displaced(q));
                    let scale = (dot(p, &wp) * dot(q, &wq)).sqrt();
                    assert!(dot(p, &wp) > 0.0 && (dot(p, &wq) - dot(q, &wp)).abs() < 1e-14 * scale);
                }
            }
        }
    }

    /// Zero rows are not transformed, and rows that are not needed neither: others keep their bits.
    #[test]
    fn rows_that_are_left_out_change_no_other() {
        let grid = grid([0.2, 0.3], [150, 40]);
        let mut operator = LayeredOperator::in_free_space(&grid, coated());
        let is_used = |row: usize| (20..45).contains(&row);
        let mut p = noise(grid.len());
        p.chunks_mut(40).enumerate().filter(|(row, _)| !is_used(*row)).for_each(|(_, row)| row.fill(0.0));
        let (blocks, mut workspace) = (operator.blocks(), Workspace::default());
        let (mut some, mut all) = (vec![0.0; p.len()], vec![0.0; p.len()]);
        let displaced = operator.displaced(&mut workspace, rows_of(blocks, &p));
        displaced.some_rows(is_used, rows_to(blocks, &mut some));
        p.iter_mut().filter(|p| **p == 0.0).for_each(|p| *p = 1e-300);
        operator.displaced(&mut workspace, rows_of(blocks, &p)).rows(rows_to(blocks, &mut all));
        assert_eq!(some[20 * 40..45 * 40], all[20 * 40..45 * 40]);
        assert!(some[..8 * 40].iter().all(|w| *w == 0.0) && all.iter().all(|w| *w != 0.0));
    }

    #[test]
    fn the_memory_is_that_of_its_tables() {
        for (points, most) in [([64, 64], 26.0), ([60, 96], 24.1), ([512, 512], 21.0)] {
            let operator = LayeredOperator::in_free_space(&grid([1.0, 1.0], points), coated());
            let numbers = operator.numbers() as f64;
            let bytes = bytes_per_sample(points, false);
            assert_eq!(bytes, 8.0 * numbers / (points[0] * points[1]) as f64);
            assert!(bytes <= most, "{points:?}: {bytes}");
        }
    }

    /// A Hertz-shaped traction q₀√(1 − r²/a²) along x on a bare half-space displaces by
    /// w = (1−2ν)/(2G) q₀ (a²x/3r²)(1 − (1 − r²/a²)^{3/2}), r ≤ a.
    #[test]
    fn a_shear_traction_displaces_by_its_closed_form() {
        let (n, a) = (128, 30.3);
        let grid = grid([1.0, 1.0], [n, n]);
        let operators = [1.0, 0.5].map(|b| {
            let coupling = Coupling { traction: [b, 0.0], response: &|_| 1.0, largest_ratio: 0.5 };
            LayeredOperator::of_kernel(&grid, &|_| 2.0, Some(coupling))
        });
        let place = |k: usize| [(k / n) as f64 - 64.0, (k % n) as f64 - 64.0];
        let part = |k: usize| (1.0 - (place(k)[0].hypot(place(k)[1]) / a).powi(2)).max(0.0);
        let p: Vec<f64> = (0..n * n).map(|k| part(k).sqrt()).collect();
        // The symmetric part drops out of the difference.
        let [one, half] = operators.map(|mut operator| {
            let mut w = p.clone();
            operator.displacement(&mut w, &mut Workspace::default());
            w
        });
        let exact = |k: usize| {
            let [x, y] = place(k);
            let square = x * x + y * y;
            if square > 0.0 { a * a * x / (3.0 * square) * (1.0 - part(k).powf(1.5)) } else { 0.0 }
        };
        let size = (0..n * n).map(exact).fold(0.0, f64::max);
        let error = |k: usize| (2.0 * (one[k] - half[k]) - exact(k)).abs() / size;
        let inside = (0..n * n).filter(|&k| part(k) > 0.19);
        let (inside, everywhere) = (inside.map(error).fold(0.0, f64::max), (0..n * n).map(error).fold(0.0, f64::max));
        // 4e-4 and 1.5e-3 in an independent program.
        assert!(inside < 5e-4 && everywhere < 1.6e-3, "{inside:e}, {everywhere:e}");
    }
}
