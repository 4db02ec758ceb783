//! The parameter sets of Figs 2 and 3 of Goryacheva & Torskaya (2019), as the model itself answers them.
//!
//! Expected: an independent periodic solver, 756 points along three periods (residual 1e-10; 252 and 504 points give
//! the same four digits). The pressures printed in the paper do not follow from the printed parameters and are no
//! reference here.

mod common;

use common::{PAPER, solve};
use percoat::solver::Control;

#[track_caller]
fn relative(what: &str, got: f64, expected: f64) {
    assert!((got / expected - 1.0).abs() <= 2e-4, "{what}: {got} against {expected}");
}

#[track_caller]
fn check(figure: usize, peaks: [f64; 3], shares: [f64; 3], penetration: f64) {
    let case = PAPER[figure];
    let control = Control::MeanPressure(case.pressure);
    let (_, solution, found) = solve(&case.surface(), &case.half_space(), [512, 512], control);
    assert!(solution.report.stop.solved(), "{}", solution.report);
    relative("penetration", found.penetration, penetration);
    for (level, found) in found.levels.iter().enumerate() {
        relative("peak", found.max_pressure, peaks[level]);
        relative("share", found.load_share, shares[level]);
    }
}

#[test]
fn the_hard_coating_of_fig_2_has_its_peaks_shares_and_penetration() {
    check(0, [0.42169, 0.39448, 0.36528], [0.41085, 0.33067, 0.25848], 0.055395);
}

#[test]
fn the_nearly_incompressible_soft_coating_of_fig_3a_has_its_peaks_shares_and_penetration() {
    check(1, [0.11677, 0.10094, 0.08326], [0.49490, 0.32258, 0.18252], 0.037197);
}

#[test]
fn the_compressible_soft_coating_of_fig_3b_has_its_peaks_shares_and_penetration() {
    check(2, [0.08908, 0.07927, 0.06860], [0.46069, 0.32652, 0.21279], 0.043233);
}
