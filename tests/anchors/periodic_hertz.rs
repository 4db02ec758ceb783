//! Paraboloids on a hexagonal lattice: Hertz' contact among its images.

use super::series::{Contact, Sums, System, TRIANGULAR, coated_triangular, paraboloid};
use super::support::{Coating, Steps, absolute, hexagonal, homogeneous, relative};
use percoat::indenter::Shape;

const RADIUS: f64 = 0.8;
/// Area per indenter at the period 1.
const AREA: f64 = 0.866_025_403_784_438_6;
const SHAPE: Shape = Shape::Paraboloid { radius: RADIUS };

fn series(modulus: f64, sums: Sums, mean_pressure: f64) -> Contact {
    System::single(modulus, sums, vec![paraboloid(RADIUS)]).loaded(mean_pressure * AREA, 0.2)[0]
}

#[test]
fn one_level_has_the_peak_pressure_and_penetration_of_the_series_and_of_finer_grids() {
    // p̄/E*; p(0), δ, a of the series; p(0), δ of an independent solver with the same digits at 280 × 484 and 560 × 970
    // points.
    let rows = [
        [0.002, 0.08074, 0.010519, 0.10121, 0.08074, 0.010519],
        [0.010, 0.13897, 0.026131, 0.17249, 0.13897, 0.026131],
        [0.030, 0.20381, 0.044705, 0.24664, 0.20383, 0.044710],
        [0.060, 0.26333, 0.059047, 0.30671, 0.26345, 0.059087],
        [0.100, 0.32275, 0.069371, 0.35734, 0.32321, 0.069544],
    ];
    let mut steps = Steps::new(&hexagonal(1.0, &[(SHAPE, 0.0)]), &homogeneous(), [360, 360]);
    for [mean_pressure, peak, penetration, radius, solver_peak, solver_penetration] in rows {
        let series = series(1.0, TRIANGULAR, mean_pressure);
        let found = steps.loaded(mean_pressure);
        if mean_pressure <= 0.03 {
            relative("the series' printed peak", series.axis, peak, 1e-4);
            relative("the series' printed penetration", series.penetration, penetration, 5e-5);
            relative("the series' printed radius", series.radius, radius, 1e-4);
            relative("peak, series", found.max_pressure, series.axis, 2e-4);
            relative("penetration, series", found.penetration, series.penetration, 2e-4);
            relative("radius, series", found.levels[0].contact_radius.unwrap(), series.radius, 1e-3);
        }
        relative("peak, solver", found.max_pressure, solver_peak, 2e-4);
        relative("penetration, solver", found.penetration, solver_penetration, 2e-4);
        relative("load", found.levels[0].load, mean_pressure * AREA, 1e-12);
    }
}

#[test]
fn three_levels_share_the_load_as_the_series_and_finer_grids_say() {
    // p̄/E*, step of the drops; p(0) of levels 1, 2, 3, their shares of the load, δ: an independent solver at 504
    // points along 3 periods.
    let rows = [
        ([0.01, 0.005], [0.14939, 0.13862, 0.12711], [0.41453, 0.33071, 0.25476], 0.030971),
        ([0.03, 0.01], [0.21968, 0.20318, 0.18566], [0.41902, 0.33008, 0.25090], 0.054341),
    ];
    for ([mean_pressure, step], peaks, shares, penetration) in rows {
        let levels = [(SHAPE, 2.0 * step), (SHAPE, step), (SHAPE, 0.0)];
        let found = Steps::new(&hexagonal(1.0, &levels), &homogeneous(), [480, 480]).loaded(mean_pressure);
        let own = TRIANGULAR.scaled(3f64.sqrt());
        let total = 3.0 * AREA * mean_pressure;
        let system = System::three_levels(1.0, own, TRIANGULAR.other_sublattice(own), RADIUS, step);
        let series = system.loaded(total, 0.2);
        relative("penetration, solver", found.penetration, penetration, 2e-4);
        relative("penetration, series", found.penetration, series[0].penetration, 2e-4);
        for (level, found) in found.levels.iter().enumerate() {
            relative("peak, solver", found.max_pressure, peaks[level], 2e-4);
            relative("peak, series", found.max_pressure, series[level].axis, 2e-4);
            relative("share, solver", found.load_share, shares[level], 2e-4);
            relative("share, series", found.load_share, series[level].load / total, 2e-4);
            relative("radius, series", found.contact_radius.unwrap(), series[level].radius, 1e-3);
        }
    }
}

#[test]
fn a_coated_level_has_the_peak_pressure_and_penetration_of_finer_grids() {
    // χ, ν₁; p̄/E₂, p(0), δ of an independent solver; h = 0.5, ν₂ = 0.3, E₂ = 1. At the lighter load the series is as
    // good.
    let rows = [
        ([2.0, 0.20], [0.01, 0.213797, 0.018369]),
        ([2.0, 0.20], [0.06, 0.395452, 0.045721]),
        ([0.5, 0.45], [0.01, 0.110275, 0.031245]),
    ];
    for ([chi, nu1], [mean_pressure, peak, penetration]) in rows {
        let coating = Coating { chi, poisson: [nu1, 0.3], thickness: 0.5 };
        let found =
            Steps::new(&hexagonal(1.0, &[(SHAPE, 0.0)]), &coating.half_space(), [360, 360]).loaded(mean_pressure);
        relative("peak, solver", found.max_pressure, peak, 2e-4);
        relative("penetration, solver", found.penetration, penetration, 2e-4);
        if mean_pressure < 0.05 {
            let series = series(coating.modulus(), coated_triangular(&coating, 1.0), mean_pressure);
            relative("peak, series", found.max_pressure, series.axis, 3e-4);
            relative("penetration, series", found.penetration, series.penetration, 3e-4);
        }
    }
}

#[test]
fn three_coated_levels_share_a_light_load_as_the_series_says() {
    let coating = Coating { chi: 2.0, poisson: [0.2, 0.3], thickness: 0.5 };
    let (mean_pressure, step) = (0.01, 0.003);
    let levels = [(SHAPE, 2.0 * step), (SHAPE, step), (SHAPE, 0.0)];
    let found = Steps::new(&hexagonal(1.0, &levels), &coating.half_space(), [480, 480]).loaded(mean_pressure);
    let own = coated_triangular(&coating, 3f64.sqrt());
    let other = coated_triangular(&coating, 1.0).other_sublattice(own);
    let total = 3.0 * AREA * mean_pressure;
    let series = System::three_levels(coating.modulus(), own, other, RADIUS, step).loaded(total, 0.15);
    relative("penetration", found.penetration, series[0].penetration, 2e-4);
    for (found, series) in found.levels.iter().zip(&series) {
        relative("peak", found.max_pressure, series.axis, 3e-4);
        absolute("share", found.load_share, series.load / total, 2e-4);
        relative("radius", found.contact_radius.unwrap(), series.radius, 1e-3);
    }
}
