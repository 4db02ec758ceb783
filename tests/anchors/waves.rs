//! Wavy surfaces from light load to complete contact.

use super::support::{Steps, absolute, homogeneous, relative};
use percoat::lattice::Cell;
use percoat::solver::Control;
use percoat::texture::Surface;
use std::f64::consts::{PI, TAU};

/// Topography with the heights h(s₁, s₂) at the samples, s in fractions of the cell vectors.
fn topography(cell: Cell, points: [usize; 2], height: impl Fn(f64, f64) -> f64) -> Surface {
    let [n1, n2] = points;
    let heights =
        (0..n1 * n2).map(|index| height((index / n2) as f64 / n1 as f64, (index % n2) as f64 / n2 as f64)).collect();
    Surface::Heights { cell, points, heights }
}

#[test]
fn westergaards_wave_has_its_peak_pressure_and_contact_width() {
    // Westergaard (1939): p* = πE*Δ/λ, largest pressure 2√(p̄ p*), contact width (2/π) asin √(p̄/p*) of the wavelength.
    let amplitude = 0.02;
    let complete = PI * amplitude;
    let cell = Cell::new([1.0, 0.0], [0.0, 0.01]).unwrap();
    let points = [2048, 4];
    let surface = topography(cell, points, |s, _| amplitude * (TAU * s).cos());
    let mut steps = Steps::new(&surface, &homogeneous(), points);
    for fraction in [0.1, 0.5, 0.9] {
        let found = steps.loaded(fraction * complete);
        relative("peak", found.max_pressure, 2.0 * fraction.sqrt() * complete, 1e-4);
        absolute("width", found.contact_fraction, 2.0 / PI * fraction.sqrt().asin(), 1e-3);
    }
}

#[test]
fn a_wave_across_the_diagonal_is_westergaards_too() {
    // Wavevector (1, 1) · 2π on the unit square: wavelength 1/√2, oblique to both grid directions.
    let amplitude = 0.02;
    let complete = PI * amplitude * 2f64.sqrt();
    let surface = topography(Cell::square(1.0).unwrap(), [256; 2], |s, t| amplitude * (TAU * (s + t)).cos());
    let found = Steps::new(&surface, &homogeneous(), [256; 2]).loaded(0.5 * complete);
    relative("peak", found.max_pressure, 2f64.sqrt() * complete, 1e-4);
    absolute("width", found.contact_fraction, 0.5, 1e-3);
}

/// A wavy surface: heights Δ·wave on a cell of unit period.
struct Wavy {
    cell: Cell,
    wave: fn(f64, f64) -> f64,
    /// p*/(E*Δ).
    complete: f64,
    /// 1 − A tends to this times 1 − p̄/p* near complete contact.
    holes: f64,
    /// p̄/p*, fraction in contact, largest pressure over p*.
    rows: [[f64; 3]; 6],
}

const AMPLITUDE: f64 = 0.01;

/// K = 4π/(√3 l), the least wavenumber of the hexagonal cell.
const K: f64 = 4.0 * PI / 1.732_050_807_568_877_2;

fn cosines(s: f64, t: f64) -> f64 {
    (TAU * s).cos() + (TAU * t).cos() + (TAU * (s + t)).cos()
}

// Converged tables: 512 points, pressures good to 2e-5, areas corrected for the perimeter and good to 5e-4. The egg-box
// rows 0.05 and 0.8 agree with an independent program to 5 digits of the pressure.

/// Johnson, Greenwood & Higginson (1985): p* = √2 πE*Δ/λ, two peaks in the cell.
fn egg_box() -> Wavy {
    Wavy {
        cell: Cell::square(1.0).unwrap(),
        wave: |s, t| (TAU * s).cos() * (TAU * t).cos(),
        complete: 2f64.sqrt() * PI,
        holes: 1.5 / PI,
        rows: [
            [0.05, 0.1129, 0.70940],
            [0.20, 0.3457, 1.09553],
            [0.50, 0.7043, 1.47934],
            [0.80, 0.8975, 1.79834],
            [0.95, 0.9758, 1.94995],
            [0.98, 0.9904, 1.98000],
        ],
    }
}

/// Peaks on the triangular lattice: p* = ¾ E*KΔ, holes shrink to the two points of the honeycomb.
fn peaks() -> Wavy {
    Wavy {
        cell: Cell::hexagonal(1.0).unwrap(),
        wave: cosines,
        complete: 0.75 * K,
        holes: 3.0 * 3f64.sqrt() / TAU,
        rows: [
            [0.05, 0.0660, 1.18790],
            [0.20, 0.1848, 1.84401],
            [0.50, 0.4188, 2.43589],
            [0.80, 0.8058, 2.79671],
            [0.95, 0.9574, 2.94991],
            [0.98, 0.9832, 2.97999],
        ],
    }
}

/// Holes on the triangular lattice: p* = 3/2 E*KΔ.
fn holes() -> Wavy {
    Wavy {
        cell: Cell::hexagonal(1.0).unwrap(),
        wave: |s, t| -cosines(s, t),
        complete: 1.5 * K,
        holes: 3.0 * 3f64.sqrt() / (4.0 * PI),
        rows: [
            [0.05, 0.2471, 0.35657],
            [0.20, 0.4971, 0.61281],
            [0.50, 0.7470, 0.98130],
            [0.80, 0.9115, 1.29849],
            [0.95, 0.9791, 1.44995],
            [0.98, 0.9916, 1.47999],
        ],
    }
}

#[track_caller]
fn check(wavy: &Wavy, points: usize) {
    let surface = topography(wavy.cell, [points; 2], |s, t| AMPLITUDE * (wavy.wave)(s, t));
    let mut steps = Steps::new(&surface, &homogeneous(), [points; 2]);
    let complete = wavy.complete * AMPLITUDE;
    relative("p*", steps.hierarchy.full_contact_pressure(), complete, 1e-12);
    for [fraction, area, peak] in wavy.rows {
        let found = steps.loaded(fraction * complete);
        relative("peak", found.max_pressure / complete, peak, 1e-4);
        absolute("area", found.contact_fraction, area, 1e-3);
        if fraction > 0.97 {
            absolute("area near completion", found.contact_fraction, 1.0 - wavy.holes * (1.0 - fraction), 5e-4);
        }
    }
    let mean_pressure = 1.2 * complete;
    let (found, pressure) = steps.solve(Control::MeanPressure(mean_pressure));
    assert_eq!(found.contact_fraction, 1.0, "complete contact");
    relative("penetration", found.penetration, steps.hierarchy.texture().mean(), 1e-10);
    // C⁻¹ of one wavelength: p = p̄ + E*q/2 · Δ · wave; p* lowers its least value to zero.
    let wavenumber = 2.0 * wavy.complete / -lowest(wavy.wave);
    let n = points as f64;
    let worst = (0..points * points)
        .map(|i| {
            let wave = (wavy.wave)((i / points) as f64 / n, (i % points) as f64 / n);
            (pressure[i] - mean_pressure - 0.5 * wavenumber * AMPLITUDE * wave).abs()
        })
        .fold(0.0, f64::max);
    println!("complete contact: pressure off by {:.1e} p*", worst / complete);
    assert!(worst < 1e-7 * complete, "pressure of complete contact off by {:.1e} p*", worst / complete);
}

/// Least value of a wave on a grid that holds its extremes.
fn lowest(wave: fn(f64, f64) -> f64) -> f64 {
    (0..144).map(|i| wave(f64::from(i / 12) / 12.0, f64::from(i % 12) / 12.0)).fold(f64::INFINITY, f64::min)
}

#[test]
fn the_egg_box_follows_its_converged_table_to_complete_contact() {
    check(&egg_box(), 384);
}

#[test]
fn peaks_on_the_triangular_lattice_follow_their_converged_table_to_complete_contact() {
    check(&peaks(), 384);
}

#[test]
fn holes_on_the_triangular_lattice_follow_their_converged_table_to_complete_contact() {
    check(&holes(), 384);
}
