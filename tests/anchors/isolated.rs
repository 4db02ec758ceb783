//! One indenter alone, from a cell of twenty contact radii whose images are taken off.
//!
//! The images curve the surface by c₂ = PΔS₃/(4πE₁*) and lift it by PΔS₁/(πE₁*), ΔS_n their effective sums: the solver
//! gets an indenter less curved by c₂, and the lift is taken off its penetration.

use super::series::{Contact, Sums, System, TRIANGULAR, Term, coated_images};
use super::support::{Coating, Steps, hexagonal, homogeneous, relative};
use percoat::indenter::Shape;
use percoat::observables::{LevelObservables, Observables};
use percoat::solver::Control;
use std::f64::consts::PI;

/// Samples along the side of the cell.
const POINTS: usize = 400;
/// Side of the cell over the contact radius.
const SIDE: f64 = 20.0;

/// Solved contact of a paraboloid of unit radius under `load` on a coating of unit thickness, and the penetration
/// without images.
pub fn alone(coating: &Coating, load: f64, radius: f64, side: f64, points: usize) -> (LevelObservables, f64) {
    let scale = PI * coating.modulus();
    let Sums([s1, s3, s5]) = coated_images(coating, side);
    let second = 0.4 * load * radius * radius;
    let c2 = (load * s3 / 4.0 + 9.0 * second * s5 / 16.0) / scale;
    let shape = Shape::Paraboloid { radius: 0.5 / (0.5 - c2) };
    let mean_pressure = load / (0.75f64.sqrt() * side * side);
    let surface = hexagonal(side, &[(shape, 0.0)]);
    let found = Steps::new(&surface, &coating.half_space(), [points; 2]).loaded(mean_pressure);
    let lift = (load * s1 + second * s3 / 4.0) / scale;
    println!("a/h = {radius}: images add {:.1e} of the curvature, {:.1e} of δ", 2.0 * c2, lift / found.penetration);
    (found.levels[0].clone(), found.penetration - lift)
}

/// a/h; P, δ, p(0), E₂ = 1.
#[track_caller]
fn check(chi: f64, nu1: f64, rows: &[[f64; 4]]) {
    let coating = Coating { chi, poisson: [nu1, 0.3], thickness: 1.0 };
    for &[radius, load, penetration, peak] in rows {
        let (found, alone) = alone(&coating, load, radius, SIDE * radius, POINTS);
        relative("penetration", alone, penetration, 1e-4);
        relative("peak", found.max_pressure, peak, 2e-4);
        if radius <= 1.0 {
            relative("radius", found.contact_radius.unwrap(), radius, 1e-3);
        }
    }
}

// Expected: the Fredholm equation of the coated contact after Abel's transformation, 60 to 140 Gauss points.

#[test]
fn a_paraboloid_on_a_hard_coating_obeys_its_integral_equation() {
    check(
        2.0,
        0.2,
        &[
            [0.1, 0.0025633856, 0.0103930073, 0.1223925569],
            [0.3, 0.0687561769, 0.0998754442, 0.3647066518],
            [0.5, 0.3120348446, 0.2898603133, 0.5950257264],
            [1.0, 2.2825080348, 1.1947458790, 1.0686694765],
            [2.0, 15.6606283229, 4.6035461523, 1.7339225282],
        ],
    );
}

#[test]
fn a_paraboloid_on_a_soft_coating_obeys_its_integral_equation() {
    check(
        0.5,
        0.45,
        &[
            [0.1, 0.0009326574, 0.0097130919, 0.0445311458],
            [0.3, 0.0253446217, 0.0828597089, 0.1344804291],
            [0.5, 0.1196315249, 0.2212290823, 0.2288640504],
            [1.0, 1.0452409113, 0.8540365489, 0.5090555470],
            [2.0, 9.8112764528, 3.5311309063, 1.2542901641],
        ],
    );
}

#[test]
fn an_incompressible_layer_on_a_rigid_base_carries_its_exact_load() {
    // X = √(Rδ)/h and P/(4/3 E* √R δ^3/2) from the integral equation of the layer bonded to a rigid base, ν = ½ (their
    // expansion in X is that of Garcia & Garcia, Biophys. J. 114 (2018) 2923). The layer keeps its volume: the mean
    // plane of its surface does not move.
    let coating = Coating { chi: 1e-6, poisson: [0.5, 0.3], thickness: 1.0 };
    for [x, ratio] in [[0.09622, 1.123544], [0.26740, 1.440023], [0.48694, 2.105576], [0.74794, 3.371097]] {
        let load = ratio * 4.0 / 3.0 * coating.modulus() * f64::powi(x, 3);
        let (_, penetration) = alone(&coating, load, 1.1 * x, SIDE * x, POINTS);
        // X is given to 5 digits.
        relative("penetration", penetration, x * x, 2e-4);
    }
}

/// One cone or power law c rⁿ of contact radius 1, E* = 1, `samples` to the radius: Galin's contact among its images,
/// and as found.
pub fn power_law(shape: Shape, term: Term, samples: usize) -> (Contact, Observables, Vec<f64>) {
    let expected = System::single(1.0, TRIANGULAR.scaled(SIDE), vec![term]).contacts(&[1.0])[0];
    let alone = Contact::isolated(1.0, &[term], 1.0);
    // The images are a small correction: nearly all that is tested is the isolated closed form.
    assert!((expected.load / alone.load - 1.0).abs() < 1e-3);
    let mean_pressure = expected.load / (0.75f64.sqrt() * SIDE * SIDE);
    let points = SIDE as usize * samples;
    let mut steps = Steps::new(&hexagonal(SIDE, &[(shape, 0.0)]), &homogeneous(), [points; 2]);
    let (found, pressure) = steps.solve(Control::MeanPressure(mean_pressure));
    (expected, found, pressure)
}

#[test]
fn a_cone_obeys_sneddon() {
    // Sneddon (1965): P = ½πE*s a², δ = ½πs a, p = ½E*s arcosh(a/r).
    let term = Term { coefficient: 0.3, exponent: 1.0 };
    let alone = Contact::isolated(1.0, &[term], 1.0);
    relative("P", alone.load, 0.15 * PI, 1e-15);
    relative("δ", alone.penetration, 0.15 * PI, 1e-15);
    let (expected, found, pressure) = power_law(Shape::Cone { slope: 0.3 }, term, 40);
    relative("penetration", found.penetration, expected.penetration, 1e-5);
    for sample in [10, 20, 30] {
        let exact = 0.15 * (40.0 / sample as f64).acosh();
        // The images press by less than a thousandth of this.
        relative("pressure at r = a/4, a/2, 3a/4", pressure[sample], exact, 1e-3);
    }
}

#[test]
fn power_laws_obey_galin() {
    for exponent in [1.5, 3.0, 4.0] {
        let term = Term { coefficient: 0.1, exponent };
        let (expected, found, pressure) = power_law(Shape::Power { coefficient: 0.1, exponent }, term, 40);
        relative("penetration", found.penetration, expected.penetration, 1e-5);
        // Below n = 2 the pressure has a cusp on the axis.
        if exponent > 2.0 {
            relative("pressure on the axis", pressure[0], expected.axis, 1e-4);
        }
    }
}
