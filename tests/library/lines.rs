//! Contact along lines: cylinders side by side, each nearly alone, against the closed form of one.

use ndarray::Array2;
use percoat::reading::StressReading;
use percoat::run::{Run, Sampling, StressRequest};
use percoat::{Cell, HalfSpace, Interface, Layer, Load, Material, MeanStress, Problem, Topography};
use std::f64::consts::PI;

/// Largest τ₁ under one cylinder over the largest pressure, and its depth over the half-width (McEwen 1949; Johnson, *Contact Mechanics*,
/// §4.2(c)).
const HERTZ: [f64; 2] = [0.300_283, 0.786_152];
const RADIUS: f64 = 1.0;
/// Half-width of the contact of one cylinder on the bare body.
const HALF_WIDTH: f64 = 0.025;

fn young(young: f64, poisson: f64) -> Material {
    Material::from_young(young, poisson).unwrap()
}

fn bare() -> HalfSpace {
    HalfSpace::new(vec![], young(1.0, 0.3))
}

/// Cylinders a `period` apart along the first vector of the cell (along the second where `exchanged`), the cell turned by an angle.
fn cylinders(period: f64, points: [usize; 2], turned: f64, exchanged: bool) -> Topography {
    let ([c, s], narrow) = ([turned.cos(), turned.sin()], 0.1);
    let [one, other] = [[period * c, period * s], [-narrow * s, narrow * c]];
    let [n, few] = points;
    let height = |k: usize| -(period * (k as f64 / n as f64 - 0.5)).powi(2) / (2.0 * RADIUS);
    let (cell, heights) = if exchanged {
        // The vectors of a cell are right-handed.
        (Cell::new(other.map(|x| -x), one).unwrap(), Array2::from_shape_fn([few, n], |(_, k)| height(k)))
    } else {
        (Cell::new(one, other).unwrap(), Array2::from_shape_fn([n, few], |(k, _)| height(k)))
    };
    Topography::new(cell, heights).unwrap()
}

/// The largest stresses under cylinders, and the largest pressure.
fn pressed(topography: Topography, body: HalfSpace, mean: MeanStress) -> (StressReading, f64) {
    let (points, period) = (topography.points(), topography.cell().area() / 0.1);
    let force = 0.25 * PI * HALF_WIDTH * HALF_WIDTH / RADIUS / 0.91;
    let loads = vec![Load::MeanPressure(force / period)];
    let run = Run::new(Problem::new(topography, body), loads, Sampling::Points(points));
    let run = Run { stress: Some(StressRequest { mean, ..StressRequest::default() }), ..run };
    let mut outcome = run.solve(&mut ()).unwrap();
    let step = outcome.steps.remove(0);
    (step.stress.clone().unwrap(), step.reading.max_pressure)
}

/// Cylinders with few samples along the lines, on either axis and in any direction. At the depth z the neighbours, L
/// apart, press across with 2ζ(2) · 2Pz/(πL²), 4.3 (a/L)² = 2.7e-3 of the largest τ₁ at forty half-widths; samples may
/// take 1e-3.
#[test]
fn one_of_many_cylinders_has_the_stresses_of_one_alone() {
    let surfaces = [
        cylinders(1.0, [768, 8], 0.0, false),
        cylinders(1.0, [768, 6], 0.0, true),
        cylinders(1.0, [720, 10], 0.4, false),
        cylinders(1.0, [720, 64], 0.0, false),
    ];
    for surface in surfaces {
        let name = surface.cell().to_string();
        let (found, highest) = pressed(surface, bare(), MeanStress::Line);
        let tau1 = found.overall.tau1;
        let error = tau1.error.expect("a coarser grid halves the points across the lines alone");
        assert!((tau1.value / highest / HERTZ[0] - 1.0 + 2.7e-3).abs() < 1e-3, "{name}: {} of {highest}", tau1.value);
        assert!((tau1.position[2] / HALF_WIDTH / HERTZ[1] - 1.0).abs() < 0.03, "{name}: {tau1:?}");
        assert!(error < 0.02 * tau1.value && found.overall.tension.error.is_some(), "{name}: {error}");
    }
    // The strain that is denied to the mean of a confined body presses its planes together.
    let (confined, highest) = pressed(cylinders(1.0, [768, 8], 0.0, false), bare(), MeanStress::Confined);
    let off = confined.overall.tau1.value / highest / HERTZ[0] - 1.0;
    assert!(off > 0.03, "{off}");
}

/// Stiff and soft coatings, bonded and sliding on what is below: with twice the period the stresses are the same.
#[test]
fn coated_lines_have_the_stresses_of_any_period() {
    let material = young(4.0, 0.25);
    let layer = |material, interface| vec![Layer::new(material, 0.02, interface).unwrap()];
    let bodies = [
        layer(material, Interface::Bonded),
        layer(material, Interface::Frictionless),
        layer(young(0.3, 0.45), Interface::Bonded),
    ];
    for layers in bodies {
        let body = HalfSpace::new(layers, young(1.0, 0.3));
        let of = |period: f64, n: usize, mean| pressed(cylinders(period, [n, 8], 0.0, false), body.clone(), mean);
        let change = |mean| {
            let [(near, one), (far, two)] = [of(2.0, 1280, mean), of(4.0, 2560, mean)];
            let of = |stress: &StressReading, p: f64, k: usize| stress.materials[k].mises.value / p;
            [0, 1].map(|k| (of(&near, one, k) / of(&far, two, k) - 1.0).abs())
        };
        let (line, confined) = (change(MeanStress::Line), change(MeanStress::Confined));
        assert!(line.iter().all(|change| *change < 2e-3), "{body}: {line:?}");
        assert!(confined.iter().copied().fold(0.0, f64::max) > 5e-3, "{body}: {confined:?}");
    }
}
