//! Stresses inside coating and substrate: closed forms, balances, and the sum over wavevectors they stand for.

mod common;

use common::{PAPER, Random, paraboloid, solve};
use percoat::exact::hertz::{Stresses, largest_shear};
use percoat::grid::Grid;
use percoat::lattice::{Cell, Lattice};
use percoat::layered::{Interior, TransferFunction};
use percoat::material::{HalfSpace, Interface, Layer, Material};
use percoat::solver::Control;
use percoat::stress::{Depth, Field, Line, MeanStress, State};
use percoat::texture::Surface;
use std::f64::consts::TAU;

fn noise(len: usize) -> Vec<f64> {
    let mut random = Random(4711);
    (0..len).map(|_| random.unit()).collect()
}

fn two_layers(interface: Interface) -> HalfSpace {
    let material = |shear, nu| Material::from_shear(shear, nu).unwrap();
    let top = Layer::new(material(5.0, 0.2), 0.1, Interface::Bonded).unwrap();
    let next = Layer::new(material(0.4, 0.45), 0.07, interface).unwrap();
    HalfSpace::new(vec![top, next], material(1.0, 0.3))
}

fn bare(nu: f64) -> HalfSpace {
    HalfSpace::new(vec![], Material::from_young(1.0, nu).unwrap())
}

fn worst(a: &State, b: &State) -> f64 {
    a.components().iter().zip(b.components()).fold(0.0, |m: f64, (x, y)| m.max((x - y).abs()))
}

/// σ at random points and depths as Σ_q p̂(q) A(q, z) e^{iq·x} with p̂ by a direct double sum, aliases found among
/// many.
#[test]
fn points_are_the_direct_sum_over_wavevectors() {
    let half_space = two_layers(Interface::Spring { tangential: 2.0, normal: 9.0 });
    let transfer = TransferFunction::new(&half_space);
    for (cell, [n1, n2]) in
        [(Cell::hexagonal(1.0).unwrap(), [6, 6]), (Cell::new([1.0, 0.2], [0.4, 0.9]).unwrap(), [7, 6])]
    {
        let grid = Grid::new(cell, [n1, n2]).unwrap();
        let pressure = noise(n1 * n2);
        let field = Field::new(&grid, &pressure, &half_space, MeanStress::Confined);
        let [b1, b2] = cell.reciprocal();
        for (x, y, z, side, top) in
            [(0.13, 0.4, 0.05, 1, 0.0), (0.7, 0.2, 0.15, 2, 0.1), (0.31, 0.57, 0.3, 3, 0.17), (0.0, 0.0, 0.0, 1, 0.0)]
        {
            let mut direct = [0.0; 9];
            for (k1, k2) in (0..n1).flat_map(|i| (0..n2).map(move |j| (i, j))).filter(|&k| k != (0, 0)) {
                let (mut re, mut im) = (0.0, 0.0);
                for (i, p) in pressure.iter().enumerate() {
                    let phase = -TAU * ((k1 * (i / n2)) as f64 / n1 as f64 + (k2 * (i % n2)) as f64 / n2 as f64);
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
                let a = Interior::new(&transfer, least).at(side, z - top);
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
            let flat = Field::new(
                &grid,
                &vec![pressure.iter().sum::<f64>() / (n1 * n2) as f64; n1 * n2],
                &half_space,
                MeanStress::Confined,
            );
            let mean = flat.points(Depth { z, side }, &[[x, y]])[0].components();
            let expected = State::from_components(std::array::from_fn(|c| direct[c] + mean[c]));
            let found = field.points(Depth { z, side }, &[[x, y]])[0];
            assert!(worst(&found, &expected) < 1e-12, "{found}\n{expected}");
        }
    }
}

#[test]
fn planes_and_sections_agree_with_points() {
    let half_space = two_layers(Interface::Bonded);
    let cell = Cell::hexagonal(1.0).unwrap();
    let grid = Grid::new(cell, [18, 18]).unwrap();
    let field = Field::new(&grid, &noise(18 * 18), &half_space, MeanStress::HalfSpace);
    let depths: Vec<Depth> = [0.0, 0.05, 0.1, 0.17, 0.4].iter().flat_map(|&z| field.depths(z)).collect();
    assert_eq!(depths.len(), 7, "both sides of two interfaces");
    for &depth in &depths {
        let plane = field.plane(depth, [18, 18]);
        for index in [0, 7, 100, 323] {
            let point = field.points(depth, &[cell.point(grid.fractions(index))])[0];
            assert!(worst(&plane.state(index), &point) < 1e-12, "plane at {depth:?}");
        }
    }
    // Along a lattice direction, and along one that is incommensurate with it.
    for direction in [cell.vectors()[0], [0.3, 0.777]] {
        let line = Line { origin: [0.1, 0.2], direction, span: [-0.4, 1.3], points: 12 };
        let section = field.section(&line, &depths);
        let unit = direction[0].hypot(direction[1]);
        for (row, &depth) in section.iter().zip(&depths) {
            for (state, s) in row.iter().zip(line.distances()) {
                let x = [0, 1].map(|k| line.origin[k] + s * direction[k] / unit);
                assert!(worst(state, &field.points(depth, &[x])[0]) < 1e-12, "section at {depth:?}");
            }
        }
    }
}

#[test]
fn equilibrium_and_hookes_law_hold_everywhere() {
    let half_space = two_layers(Interface::Bonded);
    let grid = Grid::new(Cell::hexagonal(1.0).unwrap(), [10, 10]).unwrap();
    let field = Field::new(&grid, &noise(100), &half_space, MeanStress::Confined);
    let materials: Vec<Material> =
        half_space.layers().iter().map(|layer| layer.material()).chain([half_space.substrate()]).collect();
    let step = 1e-4;
    for (x, y, z, side) in [(0.2, 0.3, 0.05, 1), (0.7, 0.1, 0.13, 2), (0.4, 0.6, 0.25, 3)] {
        let at = |dx: f64, dy: f64, dz: f64| {
            field.points(Depth { z: z + dz * step, side }, &[[x + dx * step, y + dy * step]])[0].components()
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
        let (material, state) = (materials[side - 1], at(0.0, 0.0, 0.0));
        let (young, nu) = (material.young(), material.poisson());
        let strain = |own: usize, one: usize, two: usize| (state[own] - nu * (state[one] + state[two])) / young;
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
    let grid = Grid::new(Cell::hexagonal(1.0).unwrap(), [16, 16]).unwrap();
    let pressure = noise(256);
    let spring = Interface::Spring { tangential: 3.0, normal: 8.0 };
    for interface in [Interface::Bonded, Interface::Frictionless, spring] {
        let half_space = two_layers(interface);
        let field = Field::new(&grid, &pressure, &half_space, MeanStress::Confined);
        let sides = field.depths(0.17);
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
        let surface = field.plane(Depth { z: 0.0, side: 1 }, [16, 16]);
        for index in 0..256 {
            let state = surface.state(index);
            assert!(state.xz.abs() < 1e-13 && state.yz.abs() < 1e-13, "the surface is free of shear");
            assert!((state.zz + pressure[index]).abs() < 1e-13);
        }
    }
}

#[test]
fn every_depth_carries_the_load_and_a_uniform_pressure_its_mean_state() {
    let half_space = two_layers(Interface::Frictionless);
    let grid = Grid::new(Cell::hexagonal(1.0).unwrap(), [12, 12]).unwrap();
    let pressure = noise(144);
    let load = pressure.iter().sum::<f64>() / 144.0;
    for mean in [MeanStress::Confined, MeanStress::HalfSpace] {
        let field = Field::new(&grid, &pressure, &half_space, mean);
        let uniform = Field::new(&grid, &vec![load; 144], &half_space, mean);
        for z in [0.0, 0.05, 0.1, 0.17, 0.3, 20.0] {
            for depth in field.depths(z) {
                let plane = field.plane(depth, [12, 12]);
                let average: [f64; 9] = std::array::from_fn(|c| plane.components[c].iter().sum::<f64>() / 144.0);
                assert!((average[2] + load).abs() < 1e-13, "σ_zz at {depth:?}");
                let expected = uniform.points(depth, &[[0.3, 0.2]])[0];
                assert!(worst(&State::from_components(average), &expected) < 1e-12);
                let lateral = load * mean.lateral(&half_space)[depth.side - 1];
                assert!((expected.xx - lateral).abs() < 1e-13 && expected.xy.abs() < 1e-15);
            }
        }
    }
}

#[test]
fn one_level_on_a_hexagonal_lattice_has_sixfold_stresses_to_round_off() {
    let n = 36;
    let surface =
        Surface::Indenters { lattice: Lattice::hexagonal(1.0, 1).unwrap(), levels: vec![paraboloid(0.8, 0.0)] };
    let half_space = PAPER[4].half_space();
    let (hierarchy, solution, _) = solve(&surface, &half_space, [n, n], Control::MeanPressure(0.06));
    let field = Field::new(hierarchy.grid(), &solution.pressure, &half_space, MeanStress::Confined);
    for z in [0.0, 0.02, 0.087, 0.3] {
        for depth in field.depths(z) {
            let plane = field.plane(depth, [n, n]);
            let scale = (0..n * n).fold(0.0, |m: f64, i| m.max(plane.state(i).tau1()));
            for index in 0..n * n {
                let (i, j) = (index / n, index % n);
                let (here, there) = (plane.state(index), plane.state((n - j) % n * n + (i + j) % n));
                // Rotation by 60° turns the tensor; its invariants stay.
                assert!((here.zz - there.zz).abs() < 1e-11 * scale);
                assert!((here.xx + here.yy - there.xx - there.yy).abs() < 1e-11 * scale);
                assert!((here.xz.hypot(here.yz) - there.xz.hypot(there.yz)).abs() < 1e-11 * scale);
                assert!((here.mises() - there.mises()).abs() < 1e-9 * scale);
            }
        }
    }
}

/// Pressure of a Hertzian contact of radius `radius` in the middle of a square cell of side 1.
fn hertz(points: usize, radius: f64) -> (Grid, Vec<f64>) {
    let grid = Grid::new(Cell::square(1.0).unwrap(), [points, points]).unwrap();
    let pressure = (0..grid.len())
        .map(|index| {
            let [s, t] = grid.fractions(index);
            (1.0 - ((s - 0.5).powi(2) + (t - 0.5).powi(2)) / (radius * radius)).max(0.0).sqrt()
        })
        .collect();
    (grid, pressure)
}

#[test]
fn the_largest_shear_under_hertz_is_found_without_being_told_where() {
    for nu in [0.2, 0.3, 0.45] {
        let [tau1, depth] = largest_shear(nu);
        let radius = 0.02;
        let (grid, pressure) = hertz(1000, radius);
        let field = Field::new(&grid, &pressure, &bare(nu), MeanStress::HalfSpace);
        let maxima = field.maxima([radius, radius]);
        let found = maxima.materials[0].tau1;
        assert!((found.value / tau1 - 1.0).abs() < 1e-3, "ν = {nu}: τ₁ = {found:?}");
        assert!((found.position[2] / radius - depth).abs() < 1e-2, "ν = {nu}: at {found:?}");
        assert!((found.position[0] - 0.5).hypot(found.position[1] - 0.5) < 0.02 * radius);
        // The tension at the edge of contact acts along the radius.
        let tension = maxima.faces[0].tension;
        let [x, y] = [tension.position[0] - 0.5, tension.position[1] - 0.5];
        let along = (tension.direction[0] * x + tension.direction[1] * y).abs() / x.hypot(y);
        assert!(tension.position[2] == 0.0 && (x.hypot(y) / radius - 1.0).abs() < 0.1, "{tension:?}");
        assert!(along > 0.99, "ν = {nu}: {tension:?}");
        // The stresses on the axis.
        for zeta in [0.3f64, 1.0, 2.0] {
            let state = field.points(Depth { z: zeta * radius, side: 1 }, &[[0.5, 0.5]])[0];
            let exact = Stresses::at(0.0, zeta, nu);
            let errors = [state.zz - exact.axial, state.xx - exact.radial];
            assert!(errors.iter().all(|error| error.abs() < 2e-3), "ζ = {zeta}: {state}");
        }
    }
}

#[test]
fn a_layer_counted_as_two_has_the_same_stresses() {
    let material = Material::from_shear(5.0, 0.2).unwrap();
    let substrate = Material::from_shear(1.0, 0.3).unwrap();
    let layer = |thickness| Layer::new(material, thickness, Interface::Bonded).unwrap();
    let grid = Grid::new(Cell::hexagonal(1.0).unwrap(), [12, 12]).unwrap();
    let pressure = noise(144);
    for mean in [MeanStress::Confined, MeanStress::HalfSpace] {
        let whole = Field::new(&grid, &pressure, &HalfSpace::new(vec![layer(0.25)], substrate), mean);
        let split = Field::new(&grid, &pressure, &HalfSpace::new(vec![layer(0.125), layer(0.125)], substrate), mean);
        for (z, sides) in [(0.06, (1, 1)), (0.2, (1, 2)), (0.25, (1, 2)), (0.25, (2, 3)), (0.6, (2, 3))] {
            let [a, b] = [(&whole, sides.0), (&split, sides.1)]
                .map(|(field, side)| field.points(Depth { z, side }, &[[0.31, 0.17]])[0]);
            assert!(worst(&a, &b) < 1e-12, "z = {z}: {a}\n{b}");
        }
    }
}

#[test]
fn a_spring_lies_between_its_limits() {
    let grid = Grid::new(Cell::square(1.0).unwrap(), [12, 12]).unwrap();
    let pressure = noise(144);
    let at = |interface| {
        let half_space = common::coated(3.0, 0.1, [0.2, 0.3], interface);
        let field = Field::new(&grid, &pressure, &half_space, MeanStress::Confined);
        field.points(Depth { z: 0.1, side: 1 }, &[[0.31, 0.17]])[0]
    };
    let spring = |tangential| at(Interface::Spring { tangential, normal: f64::INFINITY });
    assert!(worst(&spring(1e12), &at(Interface::Bonded)) < 1e-9);
    assert!(worst(&spring(1e-12), &at(Interface::Frictionless)) < 1e-9);
    let shear = [1e3, 10.0, 1.0, 0.1].map(|k| spring(k).xz.abs());
    assert!(shear.windows(2).all(|pair| pair[0] > pair[1]), "softer springs carry less shear: {shear:?}");
}
