//! The parameter sets of Figs 2 and 3 of Goryacheva & Torskaya (2019), as the model itself answers them.
//!
//! Expected: an independent periodic solver, 756 points along three periods (residual 1e-10; 252 and 504 points give
//! the same four digits). The pressures printed in the paper do not follow from the printed parameters and are no
//! reference here.

use super::support::{Coating, Steps, hexagonal, relative};
use percoat::indenter::Shape;

/// Paraboloids r²/(2 · 0.8 l), steps of 0.01 l, h = 0.5 l, ν₂ = 0.3, E₂ = 1, l = 1.
#[track_caller]
fn check([chi, nu1, mean_pressure]: [f64; 3], peaks: [f64; 3], shares: [f64; 3], penetration: f64) {
    let shape = Shape::Paraboloid { radius: 0.8 };
    let coating = Coating { chi, poisson: [nu1, 0.3], thickness: 0.5 };
    let surface = hexagonal(1.0, &[(shape, 0.02), (shape, 0.01), (shape, 0.0)]);
    let found = Steps::new(&surface, &coating.half_space(), [512, 512]).loaded(mean_pressure);
    relative("penetration", found.penetration, penetration, 2e-4);
    for (level, found) in found.levels.iter().enumerate() {
        relative("peak", found.max_pressure, peaks[level], 2e-4);
        relative("share", found.load_share, shares[level], 2e-4);
    }
}

#[test]
fn the_hard_coating_of_fig_2_has_its_peaks_shares_and_penetration() {
    check([2.0, 0.2, 0.06], [0.42169, 0.39448, 0.36528], [0.41085, 0.33067, 0.25848], 0.055395);
}

#[test]
fn the_nearly_incompressible_soft_coating_of_fig_3a_has_its_peaks_shares_and_penetration() {
    check([0.5, 0.45, 0.008], [0.11677, 0.10094, 0.08326], [0.49490, 0.32258, 0.18252], 0.037197);
}

#[test]
fn the_compressible_soft_coating_of_fig_3b_has_its_peaks_shares_and_penetration() {
    check([0.5, 0.2, 0.008], [0.08908, 0.07927, 0.06860], [0.46069, 0.32652, 0.21279], 0.043233);
}
