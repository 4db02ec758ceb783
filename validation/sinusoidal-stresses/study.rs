//! Stresses and displacements under sinusoidal pressures against their closed form ([`crate::exact::sinusoidal`]).
//!
//! On a grid a sinusoid is one exact wave: nothing but rounding may be left.

use super::draw::{self, curve, linear};
use super::{Check, Data, Outcome, Study, StudyError};
use crate::exact::sinusoidal;
use ndarray::Array2;
use percoat_app::picture::{Axis, Chart, Figure, Style};
use percoat_core::body::{Depth, HalfSpace, Material, MeanStress};
use percoat_core::lattice::{Cell, Grid};
use percoat_core::stress::{StressField, StressState};
use std::f64::consts::{E, TAU};
use std::sync::Arc;

pub const STUDY: Study = Study {
    name: "sinusoidal-stresses",
    title: "Stresses and displacements under sinusoidal pressures",
    files: &["errors.data.csv", "figure.png"],
    run,
    quick: None,
};

const POINTS: usize = 24;
const NU: f64 = 0.3;

/// Pressure Σ cos(**q**·**x**) of waves (m₁, m₂) on a cell, its field and its wavevectors.
fn field(cell: Cell, waves: &[[i32; 2]], half_space: &HalfSpace) -> Result<(StressField, Vec<[f64; 2]>), StudyError> {
    let grid = Arc::new(Grid::new(cell, [POINTS, POINTS])?);
    let pressure = Array2::from_shape_fn((POINTS, POINTS), |(i, j)| {
        let [s, t] = [i, j].map(|k| k as f64 / POINTS as f64);
        waves.iter().map(|&[m1, m2]| (TAU * (f64::from(m1) * s + f64::from(m2) * t)).cos()).sum()
    });
    let [b1, b2] = cell.reciprocal();
    let q = waves.iter().map(|&[m1, m2]| [0, 1].map(|k| f64::from(m1) * b1[k] + f64::from(m2) * b2[k])).collect();
    Ok((StressField::under(&grid, pressure.view(), half_space, None, MeanStress::Confined)?, q))
}

fn run() -> Result<Outcome, StudyError> {
    let material = Material::from_young(1.0, NU)?;
    let half_space = HalfSpace::new(vec![], material);
    let mut data = Data::new("errors", &["case", "z", "stress_error", "displacement_error"]);
    let mut checks = Vec::new();
    let oblique = Cell::new([1.0, 0.2], [0.4, 0.9])?;
    for (number, (name, cell, waves)) in (1..).zip([
        ("one wave along a₁, square cell", Cell::square(1.0)?, &[[1, 0]][..]),
        ("one oblique wave, square cell", Cell::square(1.0)?, &[[2, 1]]),
        ("cos x cos y, square cell", Cell::square(1.0)?, &[[1, 1], [1, -1]]),
        ("three waves at 120°, hexagonal cell", Cell::hexagonal(1.0)?, &[[1, 0], [0, 1], [1, 1]]),
        ("two waves, oblique cell", oblique, &[[1, 0], [-1, 2]]),
    ]) {
        let (field, vectors) = field(cell, waves, &half_space)?;
        let mut worst = [0.0f64; 2];
        for z in [0.0, 0.03, 0.07, 0.15, 0.3, 0.6] {
            let mut here = [0.0f64; 2];
            for x in [[0.0, 0.0], [0.137, 0.41], [0.5, 0.25], [0.81, 0.33]] {
                let found = field.points(Depth { z, material: 1 }, &[x])[0].components();
                let states = vectors.iter().map(|&q| sinusoidal::state(q, x, z, material).components());
                let exact = states.fold([0.0; 9], |sum, state| std::array::from_fn(|k| sum[k] + state[k]));
                let errors: [f64; 9] = std::array::from_fn(|k| (found[k] - exact[k]).abs());
                here[0] = errors[..6].iter().fold(here[0], |worst, &error| worst.max(error));
                here[1] = errors[6..].iter().fold(here[1], |worst, &error| worst.max(error));
            }
            data.rows.push(vec![f64::from(number), z, here[0], here[1]]);
            worst = [worst[0].max(here[0]), worst[1].max(here[1])];
        }
        checks.push(Check::absolute(format!("{name}: stresses over p̂, largest error"), worst[0], 0.0, 1e-12));
        checks.push(Check::absolute(format!("{name}: displacements, largest error"), worst[1], 0.0, 1e-12));
    }
    let (field, _) = field(Cell::square(1.0)?, &[[1, 0]], &half_space)?;
    let tau1 = field.maxima([0.25; 2]).materials[0].tau1;
    // In the plane of the wave τ₁ = ζe^{−ζ} for every x, and σ_yy lies between the other two where it is largest.
    checks.push(Check::relative("largest τ₁ over p̂", tau1.value, 1.0 / E, 1e-4));
    checks.push(Check::relative("its depth qz", tau1.position[2] * TAU, 1.0, 1e-2));
    let figure = figure(&field);
    Ok(Outcome { checks, figures: vec![("figure", figure)], data: vec![data], ..Outcome::default() })
}

/// Amplitudes against depth under cos(2πx), in the plane of the crest and a quarter wave beside it.
fn figure(field: &StressField) -> Figure {
    type Component = (&'static str, fn(&StressState) -> f64, fn(f64) -> f64, f64, usize);
    let components: [Component; 4] = [
        ("σ_zz", |state| state.zz, |x| -(1.0 + x) * (-x).exp(), 0.0, 1),
        ("σ_xx", |state| state.xx, |x| -(1.0 - x) * (-x).exp(), 0.0, 2),
        ("σ_yy", |state| state.yy, |x| -2.0 * NU * (-x).exp(), 0.0, 3),
        ("τ_xz", |state| state.xz, |x| -x * (-x).exp(), 0.25, 4),
    ];
    let mut curves = Vec::new();
    for (name, of, exact, x, colour) in components {
        let found = linear(0.0, 5.0, 21)
            .into_iter()
            .map(|zeta| [zeta, of(&field.points(Depth { z: zeta / TAU, material: 1 }, &[[x, 0.0]])[0])]);
        curves.push(curve("", Style::Line, colour, linear(0.0, 5.0, 101).into_iter().map(|zeta| [zeta, exact(zeta)])));
        curves.push(curve(name, Style::Markers, colour, found));
    }
    let chart =
        Chart { title: String::new(), x: Axis::linear("depth qz"), y: Axis::linear("amplitude over p̂"), curves };
    draw::figure(vec![chart], "Stresses under p̂ cos qx, ν = 0.3: closed form (lines) and field (markers).")
}
