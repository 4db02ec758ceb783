//! Stresses under fields of a tangential traction: beside those of friction, of stress functions and of the forces on their samples.

use super::*;
use crate::body::{Bodies, Depth, HalfSpace, Interface, Layer, Material, MeanStress, Side};
use crate::lattice::Cell;
use crate::numeric::linear::solve;
use crate::stress::line_plane::Kept;
use crate::stress::measure::MATERIAL_MEASURES;
use crate::stress::{StressField, StressFields, StressState, SurfaceLine};
use ndarray::Array2;
use std::f64::consts::{PI, TAU};

fn material(shear: f64, poisson: f64) -> Material {
    Material::from_shear(shear, poisson).unwrap()
}

fn layered() -> HalfSpace {
    let spring = Interface::Spring { tangential: 2.0, normal: 9.0 };
    let top = Layer::new(material(5.0, 0.2), 0.1, Interface::Bonded).unwrap();
    let next = Layer::new(material(0.4, 0.45), 0.07, spring).unwrap();
    HalfSpace::new(vec![top, next], material(1.0, 0.3))
}

/// A spot in the middle of a cell, where the pressure ends like a square root.
fn spot(points: [usize; 2]) -> Array2<f64> {
    let wave = |i: usize, n: usize| (TAU * (i as f64 / n as f64 - 0.5)).cos();
    Array2::from_shape_fn(points, |(i, j)| (wave(i, points[0]) + wave(j, points[1]) - 1.1).max(0.0).sqrt())
}

/// The pressure of [`spot`] under friction, and with the same tangential traction as fields.
fn twice(cell: Cell, points: [usize; 2], mut with: impl FnMut(Traction<'_>)) {
    let (grid, pressure) = (Arc::new(Grid::new(cell, points).unwrap()), spot(points));
    let friction = Friction::new(0.3f64.hypot(0.55), [0.3, -0.55]).unwrap();
    let fields = friction.traction().map(|ratio| ratio * &pressure);
    let normal = || Traction::normal(&grid, pressure.view()).unwrap();
    with(normal().with_friction(&friction, 0.0));
    with(normal().with_fields(fields.each_ref().map(|field| field.view())).unwrap());
}

/// Stress fields under both tractions of [`twice`].
fn both(cell: Cell, points: [usize; 2], half_space: &HalfSpace) -> [StressField; 2] {
    let mut found = Vec::new();
    twice(cell, points, |traction| found.push(StressField::of(&traction, half_space, MeanStress::HalfSpace)));
    found.try_into().expect("two fields")
}

/// Asserts that states are equal to a part of the largest stress or displacement.
fn assert_equal(friction: &[StressState], fields: &[StressState], part: f64) {
    let kinds = |state: &StressState| {
        let [stresses @ .., x, y, z] = state.components();
        (stresses, [x, y, z])
    };
    let size = |all: &[f64]| all.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let largest = |of: &dyn Fn(&StressState) -> f64| friction.iter().map(of).fold(0.0, f64::max);
    let (stress, displacement) = (largest(&|state| size(&kinds(state).0)), largest(&|state| size(&kinds(state).1)));
    assert!(stress > 0.0 && friction.len() == fields.len());
    for (a, b) in friction.iter().zip(fields) {
        let ((s, u), (t, v)) = (kinds(a), kinds(b));
        assert!((0..6).all(|k| (s[k] - t[k]).abs() <= part * stress), "{a}\n{b}");
        assert!((0..3).all(|k| (u[k] - v[k]).abs() <= part * displacement), "{a}\n{b}");
    }
}

/// A cell that is oblique, and the window of an isolated contact.
fn cells() -> [(Cell, [usize; 2]); 2] {
    [(Cell::new([1.0, 0.1], [0.3, 0.9]).unwrap(), [24, 20]), (Cell::window([1.0, 1.2]).unwrap(), [24, 28])]
}

#[test]
fn fields_in_proportion_to_the_pressure_have_the_stresses_of_friction() {
    let half_space = layered();
    for (cell, points) in cells() {
        let [friction, fields] = both(cell, points, &half_space);
        let places = [[0.3, 0.4], [0.02, -0.1], [0.41, 0.33], [0.1, 0.1], [-0.2, 0.3]].map(|place| {
            let [s, t] = cell.fractions(place);
            cell.point([s.rem_euclid(1.0), t.rem_euclid(1.0)])
        });
        for depth in [0.0, 0.03, 0.1, 0.15, 0.5].iter().flat_map(|&z| half_space.depths(z)) {
            let at = |field: &StressField| field.points(depth, &places);
            assert_equal(&at(&friction), &at(&fields), 1e-12);
            let plane = |field: &StressField| field.plane(depth, [9, 12]).states().into_raw_vec_and_offset().0;
            assert_equal(&plane(&friction), &plane(&fields), 1e-12);
            let expanded = |field: &StressField| {
                let expansion = field.expanded(depth, places[0]);
                [[0.0; 3], [1e-2, 2e-2, 1e-2]].map(|away| expansion.at(away))
            };
            assert_equal(&expanded(&friction), &expanded(&fields), 1e-11);
        }
    }
}

/// On sections, lines of a path and edges, where pressure and traction are sharpened on the surface.
#[test]
fn fields_that_end_as_the_pressure_does_have_the_edges_of_friction() {
    let half_space = layered();
    for (cell, points) in cells() {
        let [friction, fields] = both(cell, points, &half_space);
        // Around an isolated contact p on the surface has what the polynomials of the free field leave of it.
        let part = if cell.surroundings() == crate::lattice::Surroundings::FreeSpace { 1e-7 } else { 1e-11 };
        let [x, y] = cell.point([0.5, 0.5]);
        let line = SurfaceLine { origin: [x, y], direction: [1.0, -0.4], span: [-0.4, 0.4], points: 67 };
        let depths: Vec<Depth> = [0.0, 0.004, 0.05, 0.1, 0.3].iter().flat_map(|&z| half_space.depths(z)).collect();
        let [one, other] = [&friction, &fields].map(|field| field.section(&line, &depths));
        for (a, b) in one.states.outer_iter().zip(other.states.outer_iter()) {
            assert_equal(&a.to_vec(), &b.to_vec(), part);
        }
        let [[s, stress], [t, equal]] = [&one, &other].map(|section| section.highest.unwrap());
        assert!(s == t && (stress - equal).abs() < part * stress, "{stress}, {equal}");
        for depth in [Depth::SURFACE, Depth { z: 0.12, material: 2 }] {
            let rows = |field: &StressField| -> Vec<StressState> {
                let lines = field.sliding_lines([0.8, 0.6]);
                let kept = Kept { stress: true, ..Kept::default() };
                let plane = field.line_plane(&lines, depth, 0.2, kept);
                (0..plane.count()).flat_map(|number| plane.line(cell, number).stress).collect()
            };
            assert_equal(&rows(&friction), &rows(&fields), part);
        }
        let edges = |field: &StressField| -> Vec<StressState> {
            field.states_on_edges().into_iter().map(|(_, state)| state).collect()
        };
        assert_equal(&edges(&friction), &edges(&fields), part);
    }
}

/// Largest stresses and their errors, around the window of an isolated contact too.
#[test]
fn fields_in_proportion_to_the_pressure_have_the_largest_stresses_of_friction() {
    let half_space = layered();
    for (cell, points) in cells() {
        let coarser = both(cell, points.map(|n| n / 2), &half_space);
        let mut found = both(cell, points, &half_space).into_iter().zip(&coarser).map(|(field, coarser)| {
            let crests = field.crests_of(&MATERIAL_MEASURES);
            (crests, field.maxima([0.15, 0.2]).with_errors(coarser))
        });
        let ((crests, friction), (others, fields)) = (found.next().unwrap(), found.next().unwrap());
        for ((_, a), (_, b)) in crests.iter().zip(&others) {
            assert!((a.peak.value - b.peak.value).abs() < 1e-10 * a.scale, "{a:?}\n{b:?}");
            assert!((a.uncertainty - b.uncertainty).abs() < 1e-7 * a.scale, "{a:?}\n{b:?}");
        }
        assert!(crests.len() == 3 && others.len() == 3);
        for (a, b) in friction.materials.iter().chain(&friction.faces).zip(fields.materials.iter().chain(&fields.faces))
        {
            for (a, b) in [(&a.tau1, &b.tau1), (&a.tension, &b.tension), (&a.mises, &b.mises)] {
                let size = a.value.abs().max(0.01);
                assert!((a.value - b.value).abs() < 1e-7 * size, "{a:?}\n{b:?}");
                let [error, other] = [a, b].map(|peak| peak.error.unwrap());
                assert!((error - other).abs() < 1e-5 * size, "{a:?}\n{b:?}");
            }
        }
    }
}

#[test]
fn a_counterbody_bears_the_opposite_fields() {
    let bodies = Bodies::elastic(layered(), HalfSpace::new(vec![], material(2.0, 0.4)));
    for (cell, points) in cells() {
        let mut found = Vec::new();
        twice(cell, points, |traction| {
            let fields = StressFields::under(traction, &bodies, MeanStress::Confined);
            let at = |side: Side, z: f64| {
                fields.on(Some(side)).points(Depth { z, material: 1 }, &[cell.point([0.5, 0.5])])[0]
            };
            found.push([0.0, 0.06].map(|z| [Side::Body, Side::Counterbody].map(|side| at(side, z))));
        });
        assert_equal(found[0].as_flattened(), found[1].as_flattened(), 1e-12);
        let [[body, counterbody], _] = &found[1];
        assert!((body.xz + counterbody.xz).abs() < 1e-6 * body.xz.abs() && body.xz < -0.2, "{body}\n{counterbody}");
    }
}

/// q_x = cos kx has the stress function φ = z e^{−kz} sin(kx)/k, and q_y = cos kx the displacement u_y = e^{−kz} cos(kx)/(Gk); a wave of
/// pressure across them adds its own stresses.
#[test]
fn shear_waves_without_a_pressure_have_their_stress_functions() {
    let (nu, n) = (0.3, 16);
    let half_space = HalfSpace::new(vec![], material(2.0, nu));
    let grid = Arc::new(Grid::new(Cell::square(1.5).unwrap(), [n, n]).unwrap());
    let (k, turn) = (2.0 * TAU / 1.5, TAU / n as f64);
    let wave = Array2::from_shape_fn([n, n], |(i, _)| (2.0 * turn * i as f64).cos());
    let (none, across) = (Array2::zeros([n, n]), wave.t());
    let of = |pressure: ArrayView2<'_, f64>, x: ArrayView2<'_, f64>, y: ArrayView2<'_, f64>| {
        let traction = Traction::normal(&grid, pressure).unwrap().with_fields([x, y]).unwrap();
        StressField::of(&traction, &half_space, MeanStress::Confined)
    };
    let along = of(none.view(), wave.view(), none.view());
    let antiplane = of(none.view(), none.view(), wave.view());
    let pressed = of(across, none.view(), none.view());
    let together = of(across, wave.view(), wave.view());
    for (z, [x, y]) in [(0.0, [0.1, 0.2]), (0.07, [0.4, 0.9]), (0.2, [-0.3, 0.1]), (0.5, [0.66, 0.0])] {
        let (depth, s) = (Depth { z, material: 1 }, k * z);
        let (sine, cosine) = (k * x).sin_cos();
        let [sine, cosine] = [sine, cosine].map(|wave| wave * (-s).exp());
        let at = |field: &StressField| field.points(depth, &[[x, y]])[0].components();
        let (ux, uz) = ((2.0 - 2.0 * nu - s) * cosine, (1.0 - 2.0 * nu + s) * sine);
        let expected = [
            -(2.0 - s) * sine,
            -2.0 * nu * sine,
            -s * sine,
            0.0,
            -(1.0 - s) * cosine,
            0.0,
            ux / (2.0 * 2.0 * k),
            0.0,
            uz / (2.0 * 2.0 * k),
        ];
        let across = [0.0, 0.0, 0.0, -sine, 0.0, -cosine, 0.0, cosine / (2.0 * k), 0.0];
        let (found, other, pressed, all) = (at(&along), at(&antiplane), at(&pressed), at(&together));
        for c in 0..9 {
            assert!((found[c] - expected[c]).abs() < 1e-13, "{z}, {c}: {found:?}, {expected:?}");
            assert!((other[c] - across[c]).abs() < 1e-13, "{z}, {c}: {other:?}, {across:?}");
            assert!((all[c] - found[c] - other[c] - pressed[c]).abs() < 1e-13, "{z}, {c}");
        }
    }
    let section = along.section(
        &SurfaceLine { origin: [0.0; 2], direction: [1.0, 0.0], span: [0.0, 0.75], points: 9 },
        &[Depth::SURFACE],
    );
    assert!(section.states.indexed_iter().all(|((_, i), state)| {
        let (sine, cosine) = (k * 0.75 * i as f64 / 8.0).sin_cos();
        (state.xx + 2.0 * sine).abs() < 1e-13 && (state.xz + cosine).abs() < 1e-13
    }));
    // σ₁ = −σ₃ = 2 where sin kx = −1, σ_yy between them.
    let tension = along.maxima([0.2, 0.2]).faces[0].tension;
    assert!((tension.value - 2.0).abs() < 1e-9, "{tension:?}");
}

/// The stress function f(z) sin kx of a coating and a substrate by one linear system for all of its coefficients.
#[test]
fn a_shear_wave_on_a_coating_has_the_stress_function_of_a_dense_system() {
    let (h, n, side) = (0.12, 12, 1.0);
    let (coating, substrate) = (material(3.0, 0.2), material(1.0, 0.35));
    let layer = Layer::new(coating, h, Interface::Bonded).unwrap();
    let half_space = HalfSpace::new(vec![layer], substrate);
    let grid = Arc::new(Grid::new(Cell::square(side).unwrap(), [n, n]).unwrap());
    for number in [1.0, 3.0] {
        let k = number * TAU / side;
        let wave = Array2::from_shape_fn([n, n], |(i, _)| (number * TAU * i as f64 / n as f64).cos());
        let none = Array2::zeros([n, n]);
        let traction = Traction::normal(&grid, none.view()).unwrap().with_fields([wave.view(), none.view()]).unwrap();
        let field = StressField::of(&traction, &half_space, MeanStress::Confined);
        // f, f′, f″, f‴ of e^{−kz}, z e^{−kz}, e^{kz}, z e^{kz}.
        let functions = |z: f64| -> [[f64; 4]; 4] {
            let (down, up) = ((-k * z).exp(), (k * z).exp());
            [
                [down, -k * down, k * k * down, -k * k * k * down],
                [z * down, (1.0 - k * z) * down, (k * z - 2.0) * k * down, (3.0 - k * z) * k * k * down],
                [up, k * up, k * k * up, k * k * k * up],
                [z * up, (1.0 + k * z) * up, (2.0 + k * z) * k * up, (3.0 + k * z) * k * k * up],
            ]
        };
        // σ_zz, σ_xx over sin kx, σ_xz over cos kx, and 2G u_x over cos kx, 2G u_z over sin kx.
        let parts = |[f0, f1, f2, f3]: [f64; 4], nu: f64| {
            let ux = -((1.0 - nu) * f2 + nu * k * k * f0) / k;
            let uz = ((1.0 - nu) * f3 - (2.0 - nu) * k * k * f1) / (k * k);
            [-k * k * f0, f2, -k * f1, ux, uz]
        };
        let columns = |z: f64, body: Material| functions(z).map(|f| parts(f, body.poisson()));
        let (top, above, below) = (columns(0.0, coating), columns(h, coating), columns(h, substrate));
        let mut rows = vec![vec![0.0; 6]; 6];
        for c in 0..4 {
            (rows[0][c], rows[1][c]) = (top[c][0], top[c][2]);
            for (row, part) in [0, 2, 3, 4].into_iter().enumerate() {
                let scale = |body: Material| if part > 2 { 1.0 / (2.0 * body.shear()) } else { 1.0 };
                rows[2 + row][c] = scale(coating) * above[c][part];
                if c < 2 {
                    rows[2 + row][4 + c] = -scale(substrate) * below[c][part];
                }
            }
        }
        let solution = solve(rows, vec![0.0, -1.0, 0.0, 0.0, 0.0, 0.0]).unwrap();
        for (z, number, x) in [(0.0, 1, 0.1), (0.05, 1, 0.3), (h, 1, -0.2), (h, 2, -0.2), (0.4, 2, 0.7)] {
            let (body, coefficients) = [(coating, &solution[..4]), (substrate, &solution[4..])][number - 1];
            let all = columns(z, body);
            let sum = |part: usize| coefficients.iter().zip(&all).map(|(c, parts)| c * parts[part]).sum::<f64>();
            let (sine, cosine) = (k * x).sin_cos();
            let state = field.points(Depth { z, material: number }, &[[x, 0.37]])[0];
            let scale = 1.0 / (2.0 * body.shear());
            for (found, expected) in [
                (state.zz, sum(0) * sine),
                (state.xx, sum(1) * sine),
                (state.yy, body.poisson() * (sum(0) + sum(1)) * sine),
                (state.xz, sum(2) * cosine),
                (state.displacement[0], scale * sum(3) * cosine),
                (state.displacement[2], scale * sum(4) * sine),
            ] {
                assert!((found - expected).abs() < 1e-11, "{k}, {z}: {found} for {expected}");
            }
        }
    }
}

/// Stresses under a unit shear force along x at the origin of a bare half-space (K. L. Johnson, Contact Mechanics, Eq. (3.76)): xx, yy, zz,
/// xz, yz.
fn cerruti([x, y, z]: [f64; 3], nu: f64) -> [f64; 5] {
    let r = (x * x + y * y + z * z).sqrt();
    let (scale, free) = (x / (2.0 * PI * r.powi(3)), (1.0 - 2.0 * nu) / ((r + z) * (r + z)));
    [
        scale * (-3.0 * x * x / (r * r) + free * (r * r - y * y - 2.0 * r * y * y / (r + z))),
        scale * (-3.0 * y * y / (r * r) + free * (3.0 * r * r - x * x - 2.0 * r * x * x / (r + z))),
        -3.0 * scale * z * z / (r * r),
        -3.0 * scale * x * z / (r * r),
        -3.0 * scale * y * z / (r * r),
    ]
}

/// In the window and in one around it: the samples act as Cerruti's forces below some spacings.
#[test]
fn isolated_shear_has_the_stresses_of_the_forces_on_its_samples() {
    let (nu, n) = (0.3, 20);
    let cell = Cell::window([1.0, 1.0]).unwrap();
    let half_space = HalfSpace::new(vec![], material(1.0, nu));
    let grid = Arc::new(Grid::new(cell, [n, n]).unwrap());
    let (pressure, spot) = (Array2::zeros([n, n]), spot([n, n]));
    let place = |i: usize, j: usize| cell.point([i as f64 / n as f64, j as f64 / n as f64]);
    // Both signs along x, and a twist.
    let x = Array2::from_shape_fn([n, n], |(i, j)| spot[[i, j]] * (0.4 - 3.0 * place(i, j)[1]));
    let y = Array2::from_shape_fn([n, n], |(i, j)| spot[[i, j]] * 3.0 * place(i, j)[0]);
    let traction = Traction::normal(&grid, pressure.view()).unwrap().with_fields([x.view(), y.view()]).unwrap();
    let field = StressField::of(&traction, &half_space, MeanStress::HalfSpace);
    let expected = |[u, v, z]: [f64; 3]| {
        let mut sums = [0.0; 5];
        for (i, j) in (0..n * n).map(|index| (index / n, index % n)) {
            let [px, py] = place(i, j);
            let area = grid.sample_area();
            let by_x = cerruti([u - px, v - py, z], nu);
            // Stresses under a force along y, with x and y exchanged.
            let [yy, xx, zz, yz, xz] = cerruti([v - py, u - px, z], nu);
            for (sum, (a, b)) in sums.iter_mut().zip(by_x.into_iter().zip([xx, yy, zz, xz, yz])) {
                *sum += area * (x[[i, j]] * a + y[[i, j]] * b);
            }
        }
        sums
    };
    let parts = |state: &StressState| [state.xx, state.yy, state.zz, state.xz, state.yz];
    for (z, places, around) in [
        (0.25, vec![[0.0, 0.0], [0.3, 0.1], [-0.45, 0.48]], 0),
        (0.8, vec![[0.1, -0.2], [0.49, -0.49]], 0),
        (0.25, vec![[0.8, 0.3], [-0.6, 0.1], [-0.2, 0.9]], 1),
    ] {
        let field = if around == 0 { &field } else { field.around(around).unwrap() };
        let found = field.points(Depth { z, material: 1 }, &places);
        let exact: Vec<[f64; 5]> = places.iter().map(|[u, v]| expected([*u, *v, z])).collect();
        let largest = exact.iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
        let within = if around == 0 { 1e-6 } else { 1e-3 };
        for (state, exact) in found.iter().zip(&exact) {
            let worst = parts(state).iter().zip(exact).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
            assert!(worst < within * largest, "{z}: {state} for {exact:?}, {:e}", worst / largest);
        }
    }
}

#[test]
fn fields_belong_to_their_grid_and_have_its_lines() {
    let grid = Arc::new(Grid::new(Cell::square(1.0).unwrap(), [6, 8]).unwrap());
    let [none, waves] = [0.0, 1.0].map(|size| Array2::from_shape_fn([6, 8], |(i, _)| size * (i * i % 5) as f64));
    let uneven = Array2::from_shape_fn([6, 8], |(i, j)| (i + j) as f64);
    let of = |pressure: &'_ Array2<f64>, x: &'_ Array2<f64>, y: &'_ Array2<f64>| {
        Traction::normal(&grid, pressure.view()).unwrap().with_fields([x.view(), y.view()]).unwrap().line()
    };
    assert_eq!(
        [of(&waves, &none, &waves), of(&none, &waves, &none), of(&none, &none, &none)],
        [Some(1), Some(1), None]
    );
    assert_eq!([of(&waves, &none, &uneven), of(&none, &waves, &uneven)], [None, None]);
    let other = Array2::zeros([8, 6]);
    let normal = Traction::normal(&grid, none.view()).unwrap();
    assert!(normal.with_fields([none.view(), other.view()]).is_err() && Traction::normal(&grid, other.view()).is_err());
}
