//! Contacts of single indenters and of levels.

use crate::common::{PAPER, coated, one_level, paraboloid, solve};
use crate::{alone, homogeneous, setup, two_layers};
use percoat::localized::{CircleRadius, Localized, Setup, Stop};
use percoat::{Cell, HalfSpace, Indenters, Interface, Lattice, Layer, Level, Load, Material, Problem, Shape};
use std::f64::consts::PI;

fn single(half_space: &HalfSpace) -> Localized {
    let indenters = one_level(Lattice::hexagonal(10.0, 1).unwrap(), paraboloid(1.0, 0.0));
    Localized::new(&Problem::new(indenters, half_space.clone()), 1).unwrap()
}

/// a = (3PR/4E*)^{1/3}, δ = a²/R, p₀ = 2E*a/(πR), whatever the size of the contact in the cell; errors fall with the
/// element size.
#[test]
fn an_indenter_alone_on_a_half_space_obeys_hertz() {
    let localized = single(&homogeneous());
    for a in [0.01, 1.0] {
        let error = |elements| {
            let load = 4.0 / 3.0 * f64::powi(a, 3);
            let solution =
                localized.solve(Load::MeanPressure(load / localized.system().cell().area()), &alone(elements));
            assert_eq!(solution.stop, Stop::Converged);
            let found = &solution.levels()[0];
            assert!((found.load / load - 1.0).abs() < 1e-8);
            [solution.penetration / (a * a), found.max_pressure * PI / (2.0 * a), found.contact_radius.unwrap() / a]
                .map(|ratio| (ratio - 1.0).abs())
        };
        let (coarse, fine) = (error(16), error(64));
        println!("a = {a}: δ, p₀, a err by {coarse:?} at 16 elements, {fine:?} at 64");
        assert!(fine.iter().all(|error| *error < 1e-4));
        // δ at 16 elements errs by less than the contact's outline promises, by chance.
        assert!(coarse.iter().all(|error| *error < 5e-3) && fine[1] < coarse[1] / 8.0);
    }
}

/// Under c·rⁿ, δ = c·aⁿ·√π·Γ(n/2 + 1)/Γ((n + 1)/2) and P = 2E*·a·δ·n/(n + 1) (Galin 1946; Sneddon 1965): nearly a flat punch
/// at large n, whose pressure is heaped at the edge of the mesh.
#[test]
fn an_indenter_of_a_steep_power_obeys_galin() {
    let a: f64 = 0.3;
    for n in [4, 12, 24, 40] {
        let shape = Shape::Power { coefficient: 0.03 / a.powi(n), exponent: f64::from(n) };
        let indenters = one_level(Lattice::hexagonal(10.0, 1).unwrap(), Level::new(shape, 0.0).unwrap());
        let localized = Localized::new(&Problem::new(indenters, homogeneous()), 1).unwrap();
        let penetration = 0.03 * (1..=n / 2).map(|k| f64::from(k) / (f64::from(k) - 0.5)).product::<f64>();
        let load = 2.0 * a * penetration * f64::from(n) / f64::from(n + 1);
        for elements in [24, 48] {
            let solution =
                localized.solve(Load::MeanPressure(load / localized.system().cell().area()), &alone(elements));
            assert_eq!(solution.stop, Stop::Converged, "n = {n}: {solution}");
            let (size, radius) = (solution.spots[0].mesh.size, solution.levels()[0].contact_radius.unwrap());
            println!(
                "{n}, {elements}: δ {:.5}, a {:.5}, size {:.5}",
                solution.penetration / penetration,
                radius / a,
                size / a
            );
            assert!((radius - a).abs() < 0.5 * size, "n = {n}, {elements} elements of {size}: {radius}");
            // The error that README states.
            assert!((solution.penetration / penetration - 1.0).abs() < 4e-3, "n = {n}: {solution}");
        }
    }
}

/// On a plate that slides on its substrate the pressure is heaped within two elements of the edge, and no outline can be
/// fitted: the elements are counted, to half of one. The contact of `cases/ring.toml` alone: a = 0.34982 by the spectral
/// solver on 768 × 768 points of a lattice of period 4.
#[test]
fn a_contact_whose_pressure_is_heaped_at_its_edge_is_counted() {
    let half_space = coated(100.0, 0.05, [0.3, 0.3], Interface::Frictionless);
    let level = Level::new(Shape::Power { coefficient: 1.0, exponent: 4.0 }, 0.0).unwrap();
    let indenters = one_level(Lattice::hexagonal(1.0, 1).unwrap(), level);
    let localized = Localized::new(&Problem::new(indenters, half_space), 1).unwrap();
    for elements in [24, 48] {
        let solution = localized.solve(Load::MeanPressure(0.1), &alone(elements));
        assert_eq!(solution.stop, Stop::Converged);
        let (spot, radius) = (&solution.spots[0], solution.levels()[0].contact_radius.unwrap());
        println!("{elements} elements: {radius}");
        assert!((radius - 0.34982).abs() < 0.5 * spot.mesh.size, "{elements} elements of {}: {radius}", spot.mesh.size);
    }
}

/// Hertz with E₁* of the coating, whatever the load: the lattice and the layer are far away.
#[test]
fn tiny_loads_have_hertzian_contacts() {
    let localized = Localized::new(&PAPER[0].problem(), 7).unwrap();
    for pressure in [1e-7, 1e-9, 1e-12] {
        let solution = localized.solve(Load::MeanPressure(pressure), &setup(7, 24));
        assert_eq!(solution.stop, Stop::Converged);
        let found = &solution.levels()[0];
        let a = (0.6 * pressure * localized.system().cell().area()
            / localized.system().half_space().surface_material().contact_modulus())
        .cbrt();
        let p0 = 2.0 * localized.system().half_space().surface_material().contact_modulus() * a / (PI * 0.8);
        let radius = found.contact_radius.unwrap();
        println!("{pressure}: a {}, p₀ {}", radius / a, found.max_pressure / p0);
        assert!((radius / a - 1.0).abs() < 2e-3 && (found.max_pressure / p0 - 1.0).abs() < 2e-3);
    }
}

/// The Fredholm equation of the coated contact after Abel's transformation, 60 to 140 Gauss points: E₂ = 1, h = 1, R = 1.
#[test]
fn an_indenter_alone_on_a_coating_obeys_its_integral_equation() {
    // χ and ν₁ of two coatings; a/h, then P, δ, p(0) on each.
    let coatings = [[2.0, 0.2], [0.5, 0.45]];
    let table = [
        [0.1, 0.0025633856, 0.0103930073, 0.1223925569, 0.0009326574, 0.0097130919, 0.0445311458],
        [0.3, 0.0687561769, 0.0998754442, 0.3647066518, 0.0253446217, 0.0828597089, 0.1344804291],
        [0.5, 0.3120348446, 0.2898603133, 0.5950257264, 0.1196315249, 0.2212290823, 0.2288640504],
        [1.0, 2.2825080348, 1.1947458790, 1.0686694765, 1.0452409113, 0.8540365489, 0.5090555470],
        [2.0, 15.6606283229, 4.6035461523, 1.7339225282, 9.8112764528, 3.5311309063, 1.2542901641],
    ];
    for (first, [chi, nu1]) in [1, 4].into_iter().zip(coatings) {
        let localized = single(&coated(chi, 1.0, [nu1, 0.3], Interface::Bonded));
        for row in table {
            let (radius, [load, penetration, peak]) = (row[0], [0, 1, 2].map(|k| row[first + k]));
            let solution = localized.solve(Load::MeanPressure(load / localized.system().cell().area()), &alone(48));
            let found = &solution.levels()[0];
            let pairs = [
                (solution.penetration, penetration, 3e-4),
                (found.max_pressure, peak, 3e-4),
                (found.contact_radius.unwrap(), radius, 1e-3),
            ];
            for (found, expected, tolerance) in pairs {
                assert!((found / expected - 1.0).abs() < tolerance, "a/h {radius}: {found} against {expected}");
            }
        }
    }
}

/// Under one rigid plane each level is pressed in by δ less its drop, as if it were alone.
#[test]
fn levels_without_mutual_effect_share_the_load_as_isolated_indenters_do() {
    let paper = PAPER[0];
    let indenters = paper.indenters();
    let localized = Localized::new(&paper.problem(), 1).unwrap();
    let solution = localized.solve(Load::MeanPressure(paper.pressure), &alone(48));
    assert_eq!(solution.stop, Stop::Converged);
    for (m, (found, drop)) in solution.levels().iter().zip(indenters.drops()).enumerate() {
        let indenter = one_level(Lattice::hexagonal(10.0, 1).unwrap(), paraboloid(paper.radii[m], 0.0));
        let pressed = Load::Penetration(solution.penetration - drop);
        let isolated = &Localized::new(&Problem::new(indenter, paper.half_space()), 1)
            .unwrap()
            .solve(pressed, &alone(48))
            .levels()[0];
        assert!((found.load / isolated.load - 1.0).abs() < 2e-3, "{found:?} {isolated:?}");
        assert!((found.max_pressure / isolated.max_pressure - 1.0).abs() < 2e-3, "{found:?} {isolated:?}");
    }
}

#[test]
fn the_penetration_found_under_a_load_gives_the_load_back() {
    let paper = PAPER[1];
    let localized = Localized::new(&paper.problem(), 37).unwrap();
    let lattice_sum = Setup { rule: CircleRadius::LatticeSum, ..setup(7, 24) };
    for setup in [setup(37, 24), alone(24), lattice_sum] {
        let loaded = localized.solve(Load::MeanPressure(paper.pressure), &setup);
        let pressed = localized.solve(Load::Penetration(loaded.penetration), &setup);
        assert_eq!((loaded.stop, pressed.stop), (Stop::Converged, Stop::Converged));
        // The meshes differ in the last digits of the contact's size.
        assert!((pressed.mean_pressure / paper.pressure - 1.0).abs() < 1e-5, "{}", pressed.mean_pressure);
    }
}

/// On either side of the loads at which levels 2 and 3 of Fig. 2 touch (`validation/paper/fig2`).
#[test]
fn levels_come_into_contact_one_after_the_other() {
    let paper = PAPER[0];
    let localized = Localized::new(&paper.problem(), 37).unwrap();
    let touching = |pressure: f64| {
        let solution = localized.solve(Load::MeanPressure(pressure), &setup(37, 24));
        assert_eq!(solution.stop, Stop::Converged);
        solution.spots.iter().filter(|spot| spot.touches()).count()
    };
    assert_eq!([0.0009, 0.001, 0.0035, 0.0038].map(touching), [1, 2, 2, 3]);
    let none = localized.solve(Load::Penetration(-1e-3), &setup(37, 24));
    assert!(none.spots.iter().all(|spot| !spot.touches()) && none.mean_pressure == 0.0);
}

#[test]
fn the_additional_displacement_of_eq_8_is_the_penetration() {
    for half_space in [PAPER[0].half_space(), two_layers()] {
        let localized = Localized::new(&Problem::new(PAPER[0].indenters(), half_space), 37).unwrap();
        let solution = localized.solve(Load::MeanPressure(0.02), &setup(37, 24));
        let additional = solution.additional_displacement();
        assert!((additional / solution.penetration - 1.0).abs() < 1e-6, "{additional} {}", solution.penetration);
    }
}

/// Far beyond complete contact: elements grow with the contact, their number does not.
#[test]
fn a_penetration_out_of_reach_comes_to_an_end() {
    let localized = Localized::new(&PAPER[0].problem(), 7).unwrap();
    let solution = localized.solve(Load::Penetration(0.1), &setup(7, 8));
    assert!(solution.stop != Stop::Converged && solution.stop != Stop::Rim);
    assert!(solution.spots[0].mesh.width < 30);
}

#[test]
fn contacts_that_meet_are_reported() {
    let indenters = one_level(Lattice::hexagonal(1.0, 1).unwrap(), paraboloid(0.8, 0.0));
    let localized = Localized::new(&Problem::new(indenters, homogeneous()), 7).unwrap();
    // At p̄ = 0.4 E* spots are hexagons that fill nine tenths of the cell and still stand apart.
    assert_eq!(localized.solve(Load::MeanPressure(0.4), &setup(7, 24)).stop, Stop::Converged);
    assert_eq!(localized.solve(Load::MeanPressure(1.2), &setup(7, 24)).stop, Stop::Merged);
}

/// A wide level at half the period, and a small one that stands apart in the middle between its rows.
#[test]
fn only_contacts_that_meet_have_merged() {
    let cell = Cell::new([1.0, 0.0], [0.0, 6.0]).unwrap();
    let lattice = Lattice::new(cell, vec![vec![[0.0, 0.0]], vec![[0.5, 0.5]]]).unwrap();
    let indenters = Indenters::new(lattice, vec![paraboloid(2.0, 0.3), paraboloid(0.1, 0.28)]).unwrap();
    let localized = Localized::new(&Problem::new(indenters, homogeneous()), 1).unwrap();
    let solution = localized.solve(Load::MeanPressure(0.12), &setup(1, 24));
    println!("{solution}");
    assert_eq!(solution.stop, Stop::Merged);
    let [wide, small] = &solution.levels()[..] else { panic!("two levels") };
    assert!(wide.merged && wide.contact_radius.is_none(), "{wide:?}");
    assert!(!small.merged && small.load > 0.0 && small.contact_radius.is_some(), "{small:?}");
}

/// χ = 2, h/l = 0.5, ν 0.2/0.3, R = 0.8 l, steps 0.01 l, p̄ = 0.03.
#[test]
fn load_balanced_circles_need_few_indenters_and_area_balanced_ones_many() {
    let paper = PAPER[0];
    let load = Load::MeanPressure(0.03);
    let localized = Localized::new(&paper.problem(), 451).unwrap();
    let (_, spectral) = solve(&paper.problem(), [384, 384], load);
    let deviation = |setup| {
        let solution = localized.solve(load, &setup);
        let mut largest = [0.0f64; 2];
        for (level, reference) in solution.levels().iter().zip(&spectral.levels) {
            largest[0] = largest[0].max((level.load_share - reference.load_share).abs());
            largest[1] = largest[1].max((level.max_pressure / reference.max_pressure - 1.0).abs());
        }
        println!(
            "{}: share, peak {largest:?}, δ {:e}",
            setup.indenters,
            solution.penetration / spectral.penetration - 1.0
        );
        (largest, (solution.penetration / spectral.penetration - 1.0).abs())
    };
    for (indenters, penetration) in [(7, 0.025), (13, 0.013), (37, 0.006), (451, 0.001)] {
        let ([share, peak], delta) = deviation(setup(indenters, 32));
        assert!(share < 0.007 && peak < 0.007 && delta < penetration);
    }
    let area = |indenters| Setup { rule: CircleRadius::AreaBalanced, ..setup(indenters, 32) };
    let ([share, peak], _) = deviation(area(73));
    assert!(share > 0.1 && peak > 0.05);
}

/// A wide indenter on a coating that slides: the first guess of the penetration lies beyond complete contact, where the
/// lattice sum has no stiffness. Both meshes find one contact, and the spectral one.
#[test]
fn a_wide_indenter_on_a_sliding_coating_converges_with_any_number_of_elements() {
    let [coating, substrate] = [(2.4, 0.21), (1.0, 0.35)].map(|(e, nu)| Material::from_young(e, nu).unwrap());
    let half_space = HalfSpace::new(vec![Layer::new(coating, 0.26, Interface::Frictionless).unwrap()], substrate);
    let indenters = one_level(Lattice::hexagonal(1.0, 1).unwrap(), paraboloid(1.3, 0.0));
    let (problem, load) = (Problem::new(indenters, half_space), Load::MeanPressure(0.019));
    let localized = Localized::new(&problem, 7).unwrap();
    let (_, spectral) = solve(&problem, [192, 192], load);
    for elements in [32, 64] {
        let lattice_sum = Setup { rule: CircleRadius::LatticeSum, ..setup(7, elements) };
        let solution = localized.solve(load, &lattice_sum);
        assert_eq!(solution.stop, Stop::Converged, "{elements} elements: {solution}");
        let (found, reference) = (&solution.levels()[0], &spectral.levels[0]);
        let pairs = [
            (solution.penetration, spectral.penetration),
            (found.max_pressure, reference.max_pressure),
            (found.contact_radius.unwrap(), reference.contact_radius.unwrap()),
        ];
        for (found, expected) in pairs {
            assert!((found / expected - 1.0).abs() < 1e-3, "{elements} elements: {found} against {expected}");
        }
    }
}

/// Pressures displace nothing beyond the mean plane of complete contact: no load reaches such a penetration.
#[test]
fn a_penetration_beyond_complete_contact_is_not_converged_at_once() {
    let indenters = one_level(Lattice::hexagonal(1.0, 1).unwrap(), paraboloid(1.3, 0.0));
    let localized = Localized::new(&Problem::new(indenters, homogeneous()), 7).unwrap();
    let lattice_sum = Setup { rule: CircleRadius::LatticeSum, ..setup(7, 24) };
    let solution = localized.solve(Load::Penetration(1.0), &lattice_sum);
    assert!(solution.stop == Stop::Stalled && solution.passes <= 3, "{solution}");
}
