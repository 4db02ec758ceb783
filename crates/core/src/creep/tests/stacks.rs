//! Modes of layered bodies of all kinds against the layers themselves.

use super::super::retardation::{compliance, responses};
use super::super::{Retardation, times};
use super::{SPRING, layer, material, one};
use crate::body::{Bodies, ConstantModulus, HalfSpace, Interface, LayeredResponse, Material, Relaxation};
use rayon::prelude::*;
use rustfft::num_complex::Complex64;
use std::f64::consts::PI;

/// Target of the relative error of C, at real s and at iω.
const MISFIT: f64 = 1e-9;

/// A material with a number of terms from τ = 1e-3 on.
fn many(material: Material, terms: i32, decades: f64, constant: ConstantModulus) -> Material {
    let shear: Vec<f64> = (0..terms).map(|n| material.shear() * 1.7f64.powi(n % 3)).collect();
    let times: Vec<f64> = (0..terms).map(|n| 10f64.powf(decades * f64::from(n) - 3.0)).collect();
    material.with_relaxation(Some(Relaxation::new(&shear, &times).unwrap().with_constant(constant)))
}

/// Materials, alone and together, that relax in bodies of all kinds.
fn cases(interface: Interface, chi: f64, nu: f64, constant: ConstantModulus) -> Vec<Bodies> {
    let (top, below) = (material(chi, nu), material(1.0, 0.3));
    let coated = |top, below| HalfSpace::new(vec![layer(top, 1.0, interface)], below);
    let [many_top, many_below] = [many(top, 5, 1.3, constant), many(below, 4, 1.1, constant)];
    let on_base =
        HalfSpace::on_rigid_base(vec![layer(many_top, 1.0, interface), layer(many_below, 0.5, interface)]).unwrap();
    let bare = HalfSpace::new(vec![], one(material(0.7, 0.4), 5.0, constant));
    vec![
        coated(one(top, 10.0, constant), below).into(),
        coated(one(top, 1e3, constant), below).into(),
        coated(top, one(below, 10.0, constant)).into(),
        coated(top, one(below, 1.1, constant)).into(),
        coated(many_top, below).into(),
        coated(many_top, many_below).into(),
        on_base.into(),
        Bodies::elastic(coated(many_top, many_below), bare),
    ]
}

fn all_cases() -> impl ParallelIterator<Item = Bodies> {
    let numbers = [1e-3, 0.05, 1.0, 30.0, 1e3].map(|chi| [0.2, 0.45, 0.5].map(|nu| (chi, nu))).concat();
    let kinds = [Interface::Bonded, Interface::Frictionless, SPRING]
        .map(|interface| [ConstantModulus::Bulk, ConstantModulus::Poisson].map(|constant| (interface, constant)));
    let of = move |(interface, constant)| {
        numbers.clone().into_iter().flat_map(move |(chi, nu)| cases(interface, chi, nu, constant))
    };
    kinds.concat().into_iter().flat_map(of).collect::<Vec<_>>().into_par_iter()
}

/// Soft and stiff layers on softer and stiffer bodies; at real s and at iω, and in both limits.
#[test]
fn modes_are_the_compliance_of_the_layers() {
    all_cases().for_each(|bodies| {
        let retardation = Retardation::new(&bodies);
        let [shortest, longest] = times(&bodies).unwrap();
        for kh in (-8..=6).map(|k| 10f64.powf(0.5 * f64::from(k))) {
            let found = retardation.modes(kh);
            let misfit = retardation.misfit(kh, &found);
            assert!(misfit < MISFIT, "{bodies}, kh {kh}: {misfit:e} by {} modes", found.modes.len());
            assert!((found.relaxed() / bodies.compliance(kh) - 1.0).abs() < MISFIT, "{bodies}, kh {kh}");
            for mode in &found.modes {
                // A mode of little amplitude may be beyond by its rounding.
                assert!(mode.time > 0.99 * shortest && mode.time < 1.01 * longest, "{bodies}, kh {kh}: {mode:?}");
                assert!(mode.amplitude > 0.0);
            }
        }
    });
}

/// w(t) = 1/2πi ∫ e^{st} C(s)/s ds on a contour around the negative axis, of C of the layers at complex s: A. Talbot's method with the
/// contour of L. N. Trefethen, J. A. C. Weideman and T. Schmelzer, BIT 46, 653 (2006), and 24 places.
#[test]
fn displacements_under_a_held_pressure_are_those_of_an_inverse_laplace_transform() {
    let places = 24.0;
    all_cases().for_each(|bodies| {
        let retardation = Retardation::new(&bodies);
        for time in [1e-4, 0.01, 0.3, 1.0, 7.0, 200.0, 3e4] {
            let on_contour = |k: i32| {
                let angle = PI * f64::from(2 * k + 1) / places;
                let (sine, cosine) = (0.6407 * angle).sin_cos();
                let [re, slope] =
                    [0.5017 * angle * cosine / sine, 0.5017 * (cosine / sine - 0.6407 * angle / (sine * sine))];
                let scale = places / time;
                (Complex64::new(re - 0.6122, 0.2645 * angle) * scale, Complex64::new(slope, 0.2645) * scale)
            };
            let contour: Vec<_> = (0..12).map(on_contour).collect();
            let responses: Vec<Vec<LayeredResponse<Complex64>>> =
                contour.iter().map(|(s, _)| responses(&bodies, *s)).collect();
            for kh in [1e-3, 0.1, 1.0, 10.0] {
                let term = |((s, slope), responses): (&(Complex64, Complex64), &Vec<LayeredResponse<Complex64>>)| {
                    ((s * time).exp() * compliance(responses, kh) / s * slope).im
                };
                let displacement = contour.iter().zip(&responses).map(term).sum::<f64>() * 2.0 / places;
                let found = retardation.modes(kh).after(time);
                assert!(
                    (found / displacement - 1.0).abs() < MISFIT,
                    "{bodies}, t {time}, kh {kh}: {found} {displacement}"
                );
            }
        }
    });
}
