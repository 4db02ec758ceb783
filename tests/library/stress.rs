//! Stresses inside coating and substrate: closed forms, balances, and the sum over wavevectors they stand for.

use crate::common;

use common::{PAPER, Random, one_level, paraboloid, solve_sharply};
use ndarray::{Array2, Axis};
use percoat::body::InPlane;
use percoat::{
    Cell, Depth, Grid, HalfSpace, Interface, Lattice, Layer, Load, Material, MeanStress, Problem, StressField,
    StressState, SurfaceLine,
};
use std::f64::consts::TAU;
use std::sync::Arc;

fn noise(points: [usize; 2]) -> Array2<f64> {
    let mut random = Random(4711);
    Array2::from_shape_fn(points, |_| random.unit())
}

fn grid(cell: Cell, points: [usize; 2]) -> Arc<Grid> {
    Arc::new(Grid::new(cell, points).unwrap())
}

/// The field under `pressure` on the whole of a grid.
fn field(grid: &Arc<Grid>, pressure: &Array2<f64>, half_space: &HalfSpace, mean: MeanStress) -> StressField {
    StressField::under(grid, pressure.view(), half_space, None, mean).unwrap()
}

fn two_layers(interface: Interface) -> HalfSpace {
    let material = |shear, nu| Material::from_shear(shear, nu).unwrap();
    let top = Layer::new(material(5.0, 0.2), 0.1, Interface::Bonded).unwrap();
    let next = Layer::new(material(0.4, 0.45), 0.07, interface).unwrap();
    HalfSpace::new(vec![top, next], material(1.0, 0.3))
}

fn worst(a: &StressState, b: &StressState) -> f64 {
    a.components().iter().zip(b.components()).fold(0.0, |m: f64, (x, y)| m.max((x - y).abs()))
}

/// σ at random points and depths as Σ_q p̂(q) A(q, z) e^{iq·x} with p̂ by a direct double sum, aliases found among
/// many.
#[test]
fn points_are_the_direct_sum_over_wavevectors() {
    let half_space = two_layers(Interface::Spring { tangential: 2.0, normal: 9.0 });
    let transfer = half_space.response();
    for (cell, [n1, n2]) in
        [(Cell::hexagonal(1.0).unwrap(), [6, 6]), (Cell::new([1.0, 0.2], [0.4, 0.9]).unwrap(), [6, 7])]
    {
        let grid = grid(cell, [n1, n2]);
        let pressure = noise([n1, n2]);
        let uniform = Array2::from_elem([n1, n2], pressure.iter().sum::<f64>() / (n1 * n2) as f64);
        let [field, flat] =
            [&pressure, &uniform].map(|pressure| field(&grid, pressure, &half_space, MeanStress::Confined));
        let [b1, b2] = cell.reciprocal();
        for (x, y, z, material) in [(0.13, 0.4, 0.05, 1), (0.7, 0.2, 0.15, 2), (0.31, 0.57, 0.3, 3), (0.0, 0.0, 0.0, 1)]
        {
            let depth = Depth { z, material };
            let mut direct = [0.0; 9];
            for (k1, k2) in (0..n1).flat_map(|i| (0..n2).map(move |j| (i, j))).filter(|&k| k != (0, 0)) {
                let (mut re, mut im) = (0.0, 0.0);
                for ((i, j), p) in pressure.indexed_iter() {
                    let phase = -TAU * ((k1 * i) as f64 / n1 as f64 + (k2 * j) as f64 / n2 as f64);
                    re += p * phase.cos() / (n1 * n2) as f64;
                    im += p * phase.sin() / (n1 * n2) as f64;
                }
                let aliases: Vec<[f64; 2]> = (-4..=4)
                    .flat_map(|m1| (-4..=4).map(move |m2| (m1, m2)))
                    .map(|(m1, m2)| {
                        let (u, v) = (k1 as f64 + f64::from(m1) * n1 as f64, k2 as f64 + f64::from(m2) * n2 as f64);
                        [u * b1[0] + v * b2[0], u * b1[1] + v * b2[1]]
                    })
                    .collect();
                let least = aliases.iter().map(|q| q[0].hypot(q[1])).fold(f64::INFINITY, f64::min);
                let tied: Vec<&[f64; 2]> = aliases.iter().filter(|q| q[0].hypot(q[1]) < least * (1.0 + 1e-9)).collect();
                let a = transfer.interior(InPlane::Normal, least).at(depth);
                for q in &tied {
                    let part = 1.0 / tied.len() as f64;
                    let (sine, cosine) = (q[0] * x + q[1] * y).sin_cos();
                    // Real part of c e^{iq·x}, and of −i c e^{iq·x}.
                    let (even, odd) = (part * (re * cosine - im * sine), part * (re * sine + im * cosine));
                    let (nx, ny) = (q[0] / least, q[1] / least);
                    let terms = [
                        (nx * nx * a.sqq + ny * ny * a.stt) * even,
                        (ny * ny * a.sqq + nx * nx * a.stt) * even,
                        a.szz * even,
                        nx * ny * (a.sqq - a.stt) * even,
                        nx * a.sqz * odd,
                        ny * a.sqz * odd,
                        nx * a.uq * odd,
                        ny * a.uq * odd,
                        a.uz * even,
                    ];
                    direct.iter_mut().zip(terms).for_each(|(sum, term)| *sum += term);
                }
            }
            let mean = flat.points(depth, &[[x, y]])[0].components();
            let expected = StressState::from_components(std::array::from_fn(|c| direct[c] + mean[c]));
            let found = field.points(depth, &[[x, y]])[0];
            assert!(worst(&found, &expected) < 1e-12, "{found}\n{expected}");
        }
    }
}

#[test]
fn planes_and_sections_agree_with_points() {
    let half_space = two_layers(Interface::Bonded);
    let cell = Cell::hexagonal(1.0).unwrap();
    let grid = grid(cell, [18, 18]);
    let field = field(&grid, &noise([18, 18]), &half_space, MeanStress::HalfSpace);
    let depths: Vec<Depth> = [0.0, 0.05, 0.1, 0.17, 0.4].iter().flat_map(|&z| half_space.depths(z)).collect();
    assert_eq!(depths.len(), 7, "both sides of two interfaces");
    for &depth in &depths {
        let plane = field.plane(depth, [18, 18]);
        for index in [0, 7, 100, 323] {
            let point = field.points(depth, &[cell.point(grid.fractions(index))])[0];
            assert!(worst(&plane.state([index / 18, index % 18]), &point) < 1e-12, "plane at {depth:?}");
        }
    }
    // Points that are not the pressure's, fewer and more, also on a cell whose shortest waves have large indices.
    let skewed = self::field(
        &self::grid(Cell::new([1.0, 0.0], [7.0, 0.3]).unwrap(), [5, 6]),
        &noise([5, 6]),
        &half_space,
        MeanStress::Confined,
    );
    for (field, points) in [(&field, [12, 20]), (&field, [24, 25]), (&field, [8, 8]), (&skewed, [4, 9])] {
        let plane = field.plane(depths[1], points);
        for [i, j] in [[0, 0], [1, 2], [3, 7]] {
            let place = field.grid().cell().point([i as f64 / points[0] as f64, j as f64 / points[1] as f64]);
            let point = field.points(depths[1], &[place])[0];
            assert!(worst(&plane.state([i, j]), &point) < 1e-12, "plane of {points:?} points");
        }
    }
    // Along a lattice direction, and along one that is incommensurate with it.
    for direction in [cell.vectors()[0], [0.3, 0.777]] {
        let line = SurfaceLine { origin: [0.1, 0.2], direction, span: [-0.4, 1.3], points: 12 };
        let section = field.section(&line, &depths);
        let unit = direction[0].hypot(direction[1]);
        for (row, &depth) in section.states.outer_iter().zip(&depths) {
            for (state, s) in row.iter().zip(line.distances()) {
                let x = [0, 1].map(|k| line.origin[k] + s * direction[k] / unit);
                assert!(worst(state, &field.points(depth, &[x])[0]) < 1e-12, "section at {depth:?}");
            }
        }
    }
}

/// Waves across a line have no wavenumber along it, but for rounding of either sign.
#[test]
fn sections_across_rows_of_a_square_lattice_agree_with_points() {
    let (half_space, cell) = (two_layers(Interface::Bonded), Cell::square(1.0).unwrap());
    let field = field(&grid(cell, [108, 108]), &noise([108, 108]), &half_space, MeanStress::HalfSpace);
    let depth = Depth { z: 0.02, material: 1 };
    for direction in [[1.0, 0.86], [1.0, 0.47], [-0.6, 0.8]] {
        let line = SurfaceLine { origin: [0.1, 0.2], direction, span: [0.0, 1.0], points: 401 };
        let section = field.section(&line, &[depth]);
        for k in [0, 57, 200, 333, 400] {
            let point = field.points(depth, &[line.places()[k]])[0];
            assert!(worst(&section.states[[0, k]], &point) < 1e-12, "{direction:?}, {k}");
        }
    }
}

/// A line and the same one from its other end.
#[test]
fn a_section_is_the_same_from_both_ends() {
    let (half_space, cell) = (two_layers(Interface::Bonded), Cell::square(1.0).unwrap());
    let disc = Array2::from_shape_fn([48, 48], |(i, j)| {
        let r = (i as f64 - 24.0).hypot(j as f64 - 24.0) / 12.0;
        (1.0 - r * r).max(0.0).sqrt()
    });
    let field =
        StressField::under(&grid(cell, [48, 48]), disc.view(), &half_space, None, MeanStress::Confined).unwrap();
    let line = SurfaceLine { origin: [0.5, 0.5], direction: [1.0, 0.3], span: [0.0, 0.6], points: 61 };
    let [there, back] =
        [line, SurfaceLine { span: [0.6, 0.0], ..line }].map(|line| field.section(&line, &[Depth::SURFACE]));
    let ([s, stress], [s_back, stress_back]) = (there.highest.unwrap(), back.highest.unwrap());
    assert!(
        (s - s_back).abs() < 1e-9 && (stress / stress_back - 1.0).abs() < 1e-9,
        "{s}, {s_back}: {stress}, {stress_back}"
    );
    for k in 0..61 {
        // Far from contact the smoothed pressure is rounding, which may look like an edge: what is then taken differs by
        // what the two widths of smoothing leave.
        assert!(worst(&there.states[[0, k]], &back.states[[0, 60 - k]]) < 1e-9, "{k}");
    }
}

#[test]
fn planes_by_rows_are_the_planes_and_end_when_nobody_takes_them() {
    let (half_space, cell) = (two_layers(Interface::Bonded), Cell::hexagonal(1.0).unwrap());
    let field = field(&grid(cell, [18, 18]), &noise([18, 18]), &half_space, MeanStress::HalfSpace);
    let depth = Depth { z: 0.05, material: 1 };
    for [n1, n2] in [[75, 26], [17, 9], [64, 18], [1, 4]] {
        let plane = field.plane(depth, [n1, n2]);
        let (mut stresses, mut displacements) = (Vec::new(), Vec::new());
        let taken: Result<(), ()> = field.stresses_by_rows(depth, [n1, n2], |rows| {
            rows.axis_iter(Axis(1)).for_each(|row| stresses.push(row.to_owned()));
            Ok(())
        });
        taken.unwrap();
        let taken: Result<(), ()> = field.displacements_by_rows(depth, [n1, n2], |rows| {
            rows.axis_iter(Axis(1)).for_each(|row| displacements.push(row.to_owned()));
            Ok(())
        });
        taken.unwrap();
        assert_eq!((stresses.len(), displacements.len()), (n1, n1));
        for (i, (stresses, displacements)) in stresses.iter().zip(&displacements).enumerate() {
            for j in 0..n2 {
                let state = plane.state([i, j]);
                let expected = [state.components().as_slice(), &[state.tau1(), state.mises(), state.s1()]].concat();
                let [stressed, moved] = [stresses, displacements].map(|row| row.column(j).to_vec());
                assert_eq!([&stressed[..6], &moved, &stressed[6..]].concat(), expected, "[{i}, {j}] of {n1} × {n2}");
            }
        }
    }
    let mut calls = 0;
    let ended = field.stresses_by_rows(depth, [75, 26], |_| {
        calls += 1;
        if calls == 2 { Err("enough") } else { Ok(()) }
    });
    assert_eq!((ended, calls), (Err("enough"), 2));
}

#[test]
fn equilibrium_and_hookes_law_hold_everywhere() {
    let half_space = two_layers(Interface::Bonded);
    let grid = grid(Cell::hexagonal(1.0).unwrap(), [10, 10]);
    let field = field(&grid, &noise([10, 10]), &half_space, MeanStress::Confined);
    let materials: Vec<Material> = half_space.materials().collect();
    let step = 1e-4;
    for (x, y, z, number) in [(0.2, 0.3, 0.05, 1), (0.7, 0.1, 0.13, 2), (0.4, 0.6, 0.25, 3)] {
        let at = |dx: f64, dy: f64, dz: f64| {
            field.points(Depth { z: z + dz * step, material: number }, &[[x + dx * step, y + dy * step]])[0]
                .components()
        };
        // Central differences of fourth order.
        let slope = |d: [f64; 3]| -> [f64; 9] {
            let shifted = |m: f64| at(m * d[0], m * d[1], m * d[2]);
            let (a, b, c, e) = (shifted(-2.0), shifted(-1.0), shifted(1.0), shifted(2.0));
            std::array::from_fn(|k| (a[k] - 8.0 * b[k] + 8.0 * c[k] - e[k]) / (12.0 * step))
        };
        let (dx, dy, dz) = (slope([1.0, 0.0, 0.0]), slope([0.0, 1.0, 0.0]), slope([0.0, 0.0, 1.0]));
        let balance = [dx[0] + dy[3] + dz[4], dx[3] + dy[1] + dz[5], dx[4] + dy[5] + dz[2]];
        let scale = dx.iter().chain(&dy).chain(&dz).fold(0.0, |m: f64, v| m.max(v.abs()));
        assert!(balance.iter().all(|b| b.abs() < 1e-8 * scale), "div σ = {balance:?}, scale {scale}");
        let (material, state) = (materials[number - 1], at(0.0, 0.0, 0.0));
        let (young, nu) = (material.young(), material.poisson());
        let strain = |along: usize, one: usize, two: usize| (state[along] - nu * (state[one] + state[two])) / young;
        let shear = 2.0 * material.shear();
        for (found, expected) in [
            (dx[6], strain(0, 1, 2)),
            (dy[7], strain(1, 2, 0)),
            (dz[8], strain(2, 0, 1)),
            (0.5 * (dx[7] + dy[6]), state[3] / shear),
            (0.5 * (dx[8] + dz[6]), state[4] / shear),
            (0.5 * (dy[8] + dz[7]), state[5] / shear),
        ] {
            assert!((found - expected).abs() < 1e-7, "strain {found} against {expected}");
        }
    }
}

#[test]
fn interfaces_transmit_what_they_should() {
    let grid = grid(Cell::hexagonal(1.0).unwrap(), [16, 16]);
    let pressure = noise([16, 16]);
    let spring = Interface::Spring { tangential: 3.0, normal: 8.0 };
    for interface in [Interface::Bonded, Interface::Frictionless, spring] {
        let half_space = two_layers(interface);
        let field = field(&grid, &pressure, &half_space, MeanStress::Confined);
        let sides = half_space.depths(0.17);
        for x in [[0.0, 0.0], [0.21, 0.43]] {
            let [above, below] = [0, 1].map(|k| field.points(sides[k], &[x])[0]);
            for (a, b) in [(above.zz, below.zz), (above.xz, below.xz), (above.yz, below.yz)] {
                assert!((a - b).abs() < 1e-12, "{interface}: traction");
            }
            let jump = [0, 1, 2].map(|k| above.displacement[k] - below.displacement[k]);
            match interface {
                Interface::Bonded => assert!(jump.iter().all(|j| j.abs() < 1e-12)),
                Interface::Frictionless => {
                    assert!(above.xz.abs() < 1e-12 && above.yz.abs() < 1e-12 && jump[2].abs() < 1e-12);
                    assert!(jump[0].abs() > 1e-4, "it slides");
                }
                Interface::Spring { tangential, normal } => {
                    assert!((jump[0] + above.xz / tangential).abs() < 1e-12);
                    assert!((jump[1] + above.yz / tangential).abs() < 1e-12);
                    assert!((jump[2] + above.zz / normal).abs() < 1e-12);
                }
            }
        }
        let surface = field.plane(Depth::SURFACE, [16, 16]).states();
        for (state, p) in surface.iter().zip(&pressure) {
            assert!(state.xz.abs() < 1e-13 && state.yz.abs() < 1e-13, "the surface is free of shear");
            assert!((state.zz + p).abs() < 1e-13);
        }
    }
}

#[test]
fn every_depth_carries_the_load_and_a_uniform_pressure_its_mean_state() {
    let half_space = two_layers(Interface::Frictionless);
    let grid = grid(Cell::hexagonal(1.0).unwrap(), [12, 12]);
    let pressure = noise([12, 12]);
    let load = pressure.iter().sum::<f64>() / 144.0;
    for mean in [MeanStress::Confined, MeanStress::HalfSpace] {
        let [field, uniform] =
            [&pressure, &Array2::from_elem([12, 12], load)].map(|pressure| field(&grid, pressure, &half_space, mean));
        for z in [0.0, 0.05, 0.1, 0.17, 0.3, 20.0] {
            for depth in half_space.depths(z) {
                let plane = field.plane(depth, [12, 12]);
                let average: [f64; 9] =
                    std::array::from_fn(|c| plane.components.index_axis(Axis(0), c).iter().sum::<f64>() / 144.0);
                assert!((average[2] + load).abs() < 1e-13, "σ_zz at {depth:?}");
                let expected = uniform.points(depth, &[[0.3, 0.2]])[0];
                assert!(worst(&StressState::from_components(average), &expected) < 1e-12);
                let lateral = load * mean.lateral(&half_space)[depth.material - 1];
                assert!((expected.xx - lateral).abs() < 1e-13 && expected.xy.abs() < 1e-15);
            }
        }
    }
}

#[test]
fn one_level_on_a_hexagonal_lattice_has_sixfold_stresses_to_round_off() {
    let n = 36;
    let indenters = one_level(Lattice::hexagonal(1.0, 1).unwrap(), paraboloid(0.8, 0.0));
    let half_space = PAPER[4].half_space();
    let problem = Problem::new(indenters, half_space.clone());
    let (step, _) = solve_sharply(&problem, [n, n], Load::MeanPressure(0.06));
    // Rounding leaves the solution sixfold to 1e-11 only.
    let turned = |[i, j]: [usize; 2]| [(n - j) % n, (i + j) % n];
    let sixfold = Array2::from_shape_fn([n, n], |(i, j)| {
        let turns = std::iter::successors(Some([i, j]), |&at| Some(turned(at))).take(6);
        turns.map(|at| step.pressure()[at] / 6.0).sum::<f64>()
    });
    assert!((&sixfold - &step.pressure()).iter().all(|difference| difference.abs() < 1e-10 * sixfold[[0, 0]]));
    let field = StressField::under(step.grid(), sixfold.view(), &half_space, None, MeanStress::Confined).unwrap();
    for z in [0.0, 0.02, 0.087, 0.3] {
        for depth in half_space.depths(z) {
            let states = field.plane(depth, [n, n]).states();
            let scale = states.iter().fold(0.0, |m: f64, state| m.max(state.tau1()));
            for ((i, j), here) in states.indexed_iter() {
                let there = states[turned([i, j])];
                // Rotation by 60° turns the tensor; its invariants stay.
                assert!((here.zz - there.zz).abs() < 1e-11 * scale);
                assert!((here.xx + here.yy - there.xx - there.yy).abs() < 1e-11 * scale);
                assert!((here.xz.hypot(here.yz) - there.xz.hypot(there.yz)).abs() < 1e-11 * scale);
                assert!((here.mises() - there.mises()).abs() < 1e-9 * scale);
            }
        }
    }
}

#[test]
fn a_layer_counted_as_two_has_the_same_stresses() {
    let material = Material::from_shear(5.0, 0.2).unwrap();
    let substrate = Material::from_shear(1.0, 0.3).unwrap();
    let layer = |thickness| Layer::new(material, thickness, Interface::Bonded).unwrap();
    let grid = grid(Cell::hexagonal(1.0).unwrap(), [12, 12]);
    let pressure = noise([12, 12]);
    for mean in [MeanStress::Confined, MeanStress::HalfSpace] {
        let [whole, split] = [vec![layer(0.25)], vec![layer(0.125), layer(0.125)]]
            .map(|layers| field(&grid, &pressure, &HalfSpace::new(layers, substrate), mean));
        for (z, materials) in [(0.06, (1, 1)), (0.2, (1, 2)), (0.25, (1, 2)), (0.25, (2, 3)), (0.6, (2, 3))] {
            let [a, b] = [(&whole, materials.0), (&split, materials.1)]
                .map(|(field, material)| field.points(Depth { z, material }, &[[0.31, 0.17]])[0]);
            assert!(worst(&a, &b) < 1e-12, "z = {z}: {a}\n{b}");
        }
    }
}

/// A Hertzian contact in the middle of the cell, on a bare half-space; `validation/hertz-stresses` has the values.
#[test]
fn the_largest_shear_is_on_the_axis_and_the_largest_tension_at_the_edge_acts_along_the_radius() {
    let (n, radius) = (500, 0.04);
    let pressure = Array2::from_shape_fn([n, n], |(i, j)| {
        let [s, t] = [i, j].map(|k| k as f64 / n as f64 - 0.5);
        (1.0 - (s * s + t * t) / (radius * radius)).max(0.0).sqrt()
    });
    let bare = common::bare();
    let grid = grid(Cell::square(1.0).unwrap(), [n, n]);
    let maxima = field(&grid, &pressure, &bare, MeanStress::HalfSpace).maxima([radius, radius]);
    let from_axis = |position: [f64; 3]| [position[0] - 0.5, position[1] - 0.5];
    let [x, y] = from_axis(maxima.materials[0].tau1.position);
    assert!(x.hypot(y) < 0.02 * radius, "{:?}", maxima.materials[0].tau1);
    let tension = maxima.faces[0].tension;
    let [x, y] = from_axis(tension.position);
    assert!(tension.position[2] == 0.0 && (x.hypot(y) / radius - 1.0).abs() < 0.1, "{tension:?}");
    let along = (tension.direction[0] * x + tension.direction[1] * y).abs() / x.hypot(y);
    assert!(along > 0.99, "{tension:?}");
}
