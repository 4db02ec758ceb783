//! Stresses under sliding contact and residual stresses, from first principles: tractions, equilibrium, Hooke's law and what
//! interfaces connect.

use crate::common;

use common::{Hills, Random, solve};
use ndarray::Array2;
use percoat::{
    Cell, Depth, Friction, Grid, HalfSpace, Interface, Layer, Load, Material, MeanStress, Problem, StressField,
    StressState, SurfaceLine,
};
use std::sync::Arc;

const TRACTION: [f64; 2] = [0.3, -0.55];

fn friction() -> Friction {
    Friction::new(TRACTION[0].hypot(TRACTION[1]), TRACTION).unwrap()
}

fn material(shear: f64, nu: f64) -> Material {
    Material::from_shear(shear, nu).unwrap()
}

fn layers(interface: Interface) -> HalfSpace {
    let top = Layer::new(material(5.0, 0.2), 0.1, Interface::Bonded).unwrap();
    let next = Layer::new(material(0.4, 0.5), 0.07, interface).unwrap();
    HalfSpace::new(vec![top, next], material(1.0, 0.0))
}

const SPRING: Interface = Interface::Spring { tangential: 2.0, normal: 9.0 };

/// A random pressure on a coarse grid: few waves, which differences follow well.
fn field(cell: Cell, points: [usize; 2], half_space: &HalfSpace) -> (StressField, Array2<f64>) {
    let mut random = Random(99);
    let pressure = Array2::from_shape_fn(points, |_| random.unit());
    let grid = Arc::new(Grid::new(cell, points).unwrap());
    let field =
        StressField::under(&grid, pressure.view(), half_space, Some(&friction()), MeanStress::Confined).unwrap();
    (field, pressure)
}

fn cells() -> [(Cell, [usize; 2]); 3] {
    [
        (Cell::hexagonal(1.0).unwrap(), [6, 6]),
        (Cell::square(1.0).unwrap(), [5, 7]),
        (Cell::new([1.0, 0.2], [0.4, 0.9]).unwrap(), [6, 4]),
    ]
}

fn at(field: &StressField, [x, y, z]: [f64; 3], material: usize) -> StressState {
    field.points(Depth { z, material }, &[[x, y]])[0]
}

/// σ_zz = −p, σ_xz = −μ e_x p, σ_yz = −μ e_y p at every sample.
#[test]
fn the_surface_feels_the_pressure_and_the_traction_along_the_sliding() {
    for (cell, points) in cells() {
        let (field, pressure) = field(cell, points, &layers(SPRING));
        let plane = field.plane(Depth::SURFACE, points);
        for ([i, j], p) in pressure.indexed_iter().map(|((i, j), p)| ([i, j], p)) {
            let state = plane.state([i, j]);
            assert!((state.zz + p).abs() < 1e-12, "{cell}: {state} under {p}");
            // Components that are their own conjugates cannot be turned by a quarter wave: the shear is even, and keeps them.
            assert!((state.xz + TRACTION[0] * p).abs() < 1e-12 && (state.yz + TRACTION[1] * p).abs() < 1e-12, "{cell}");
        }
        let mean = pressure.iter().sum::<f64>() / pressure.len() as f64;
        for z in [0.03, 0.1, 0.3, 2.0] {
            let depth = *field.half_space().depths(z).last().unwrap();
            let plane = field.plane(depth, [8, 8]);
            let mean_of = |k: usize| plane.components.index_axis(ndarray::Axis(0), k).mean().unwrap();
            assert!((mean_of(4) + TRACTION[0] * mean).abs() < 1e-13 && (mean_of(5) + TRACTION[1] * mean).abs() < 1e-13);
        }
    }
}

/// ∂σ_ij/∂x_j = 0 and Hooke's law, by differences of the fourth order.
#[test]
fn stresses_are_in_equilibrium_and_follow_the_displacements() {
    let half_space = layers(SPRING);
    for (cell, points) in cells() {
        let (field, _) = field(cell, points, &half_space);
        for (place, number) in [([0.13, 0.42, 0.05], 1), ([0.71, 0.2, 0.13], 2), ([0.31, 0.57, 0.31], 3)] {
            let h = 2e-3;
            let slope = |axis: usize| -> [f64; 9] {
                let moved = |steps: f64| {
                    let mut place: [f64; 3] = place;
                    place[axis] += steps * h;
                    at(&field, place, number).components()
                };
                let (a, b, c, d) = (moved(-2.0), moved(-1.0), moved(1.0), moved(2.0));
                std::array::from_fn(|k| (a[k] - 8.0 * b[k] + 8.0 * c[k] - d[k]) / (12.0 * h))
            };
            let [dx, dy, dz] = [0, 1, 2].map(slope);
            // xx, yy, zz, xy, xz, yz, u_x, u_y, u_z.
            let balance = [dx[0] + dy[3] + dz[4], dx[3] + dy[1] + dz[5], dx[4] + dy[5] + dz[2]];
            let scale = dx.iter().chain(&dy).chain(&dz).fold(0.0f64, |m, x| m.max(x.abs()));
            assert!(balance.iter().all(|rest| rest.abs() < 1e-6 * scale), "{cell}, {place:?}: {balance:?} of {scale}");
            let state = at(&field, place, number);
            let body = half_space.materials().nth(number - 1).unwrap();
            let (young, nu, shear) = (body.young(), body.poisson(), body.shear());
            let strain = |one: f64, two: f64, three: f64| (one - nu * (two + three)) / young;
            let hooke = [
                dx[6] - strain(state.xx, state.yy, state.zz),
                dy[7] - strain(state.yy, state.xx, state.zz),
                dz[8] - strain(state.zz, state.xx, state.yy),
                dx[7] + dy[6] - state.xy / shear,
                dx[8] + dz[6] - state.xz / shear,
                dy[8] + dz[7] - state.yz / shear,
            ];
            assert!(hooke.iter().all(|rest| rest.abs() < 1e-6 * scale), "{cell}, {place:?}: {hooke:?}");
        }
    }
}

#[test]
fn interfaces_pass_tractions_on_and_displacements_as_they_are_held() {
    let half_space = layers(SPRING);
    for (cell, points) in cells() {
        let (field, _) = field(cell, points, &half_space);
        for [x, y] in [[0.1, 0.2], [0.77, 0.35]] {
            for (z, above, jumps) in [(0.1, 1, [0.0; 3]), (0.1 + 0.07, 2, [0.5, 0.5, 1.0 / 9.0])] {
                let [upper, lower] = [above, above + 1].map(|material| at(&field, [x, y, z], material));
                for (up, low) in [(upper.zz, lower.zz), (upper.xz, lower.xz), (upper.yz, lower.yz)] {
                    assert!((up - low).abs() < 1e-12, "{cell}: {upper}\n{lower}");
                }
                // The lower side lags by traction over stiffness: u_below − u_above = σ_xz/k_t, σ_zz/k_n.
                let tractions = [upper.xz, upper.yz, upper.zz];
                for k in 0..3 {
                    let jump = lower.displacement[k] - upper.displacement[k];
                    assert!((jump - jumps[k] * tractions[k]).abs() < 1e-12, "{cell}, {k}: {jump}");
                }
            }
        }
    }
}

/// A residual stress adds to σ_xx and σ_yy of its layer, at the surface and between, and to nothing else.
#[test]
fn residual_stress_adds_to_its_layer_alone() {
    let mut stack = layers(Interface::Bonded).layers().to_vec();
    stack[0] = stack[0].with_residual_stress(2.0).unwrap();
    let substrate = layers(Interface::Bonded).material(3);
    let problem = |layers: Vec<Layer>| {
        Problem::new(Hills::random(&mut Random(3), 12, 4, 0.05).topography(36), HalfSpace::new(layers, substrate))
            .sliding(friction())
            .unwrap()
    };
    let load = Load::MeanPressure(0.01);
    let (free, _) = solve(&problem(layers(Interface::Bonded).layers().to_vec()), [36, 36], load);
    let (stressed, _) = solve(&problem(stack), [36, 36], load);
    assert!(free.pressure() == stressed.pressure());
    let [free, stressed] = [&free, &stressed].map(|step| StressField::new(step.finest(), MeanStress::HalfSpace));
    let depths: Vec<Depth> = [0.0, 0.004, 0.1, 0.17].iter().flat_map(|&z| free.half_space().depths(z)).collect();
    let line = SurfaceLine { origin: [0.0, 0.1], direction: [1.0, 0.3], span: [0.0, 1.0], points: 64 };
    let [sections, others] = [&free, &stressed].map(|field| field.section(&line, &depths).states);
    for ((row, depth), other) in sections.outer_iter().zip(&depths).zip(others.outer_iter()) {
        let residual = if depth.material == 1 { 2.0 } else { 0.0 };
        for (state, other) in row.iter().zip(other) {
            let expected = StressState { xx: state.xx + residual, yy: state.yy + residual, ..*state };
            let (expected, found) = (expected.components(), other.components());
            assert!((0..9).all(|k| (expected[k] - found[k]).abs() < 1e-12), "{depth:?}: {expected:?}\n{found:?}");
        }
    }
    let tension = |field: &StressField| field.maxima([0.05, 0.1]).faces[0].tension.value;
    assert!((tension(&stressed) - (tension(&free) + 2.0)).abs() < 1e-9 * tension(&free).abs());
}
