//! The part of the kernel at small wavenumbers, a function of the distance alone:
//!
//! L(ρ) = ∫₀¹ f(s) φ(s) J(πρs) ds,
//!
//! s the wavenumber over that of the circle inscribed in the zone, k_N = π/d, ρ the distance over d, J the Bessel function of
//! order zero (even kernel) or one (odd kernel), φ the [cut](super::cut).
//!
//! **In s**: Gauss–Legendre on octaves down to 10⁻¹⁰ and from there to zero, so that f may vary on the scale of ln s however
//! small s is (hard thin coatings do); nodes grow with the phase across a panel. **In ρ**: Chebyshev series on panels of
//! 4 up to 56, beyond, where the cut is no longer seen, each √2 times as far as the one before. The quadrature belongs to the
//! panel of ρ: a table that reaches further has the same bits where both reach.

use super::cut::low_pass;
use crate::numeric::chebyshev::{Chebyshev, inside, place};
use crate::numeric::parallel;
use crate::numeric::quadrature::gauss;
use std::f64::consts::{PI, SQRT_2};

/// Terms of the series of a panel of ρ (18 reach rounding).
const TERMS: usize = 20;
/// Length of the panels of ρ near zero, and where they begin to grow.
const PANEL: f64 = 4.0;
const NEAR: f64 = 56.0;
/// Least s of the octaves.
const FLOOR: f64 = 1e-10;
/// Nodes on a panel of s across which the phase πρs does not change (16 reach rounding).
const NODES: usize = 20;
/// Further nodes per unit of phase, and the number that they are a multiple of.
const NODES_PER_PHASE: f64 = 0.55;
const NODES_STEP: usize = 10;
/// Largest phase across a panel of s.
const PHASE: f64 = 200.0;

/// L(ρ) from 0 to a reach.
#[derive(Debug)]
pub(super) struct Radial {
    /// Upper ends of the panels of ρ.
    ends: Vec<f64>,
    series: Vec<Chebyshev<TERMS>>,
}

impl Radial {
    /// Table for 0 ≤ ρ ≤ `reach` of a finite f on (0, 1), with the Bessel function J.
    pub fn new(bessel: fn(f64) -> f64, reach: f64, f: impl Fn(f64) -> f64 + Sync) -> Self {
        let grown = |end: &f64| Some(if *end < NEAR { end + PANEL } else { end * SQRT_2 });
        let mut ends: Vec<f64> = std::iter::successors(Some(PANEL), grown).take_while(|end| *end < reach).collect();
        ends.push(ends.last().map_or(PANEL, |end| grown(end).expect("panels go on")));
        let starts = std::iter::once(0.0).chain(ends.iter().copied());
        let panels: Vec<[f64; 2]> = starts.zip(&ends).map(|(start, &end)| [start, end]).collect();
        let rules = Rules::new();
        let series = parallel::map_items(&panels, |&panel| {
            let nodes: Vec<[f64; 2]> = rules.nodes(PI * panel[1]).map(|[s, w]| [s, w * f(s) * low_pass(s)]).collect();
            let value = |x: f64| {
                let rho = PI * place(panel, x);
                nodes.iter().map(|[s, weight]| weight * bessel(rho * s)).sum()
            };
            let values = parallel::map_items(&Chebyshev::<TERMS>::nodes(), |&x| value(x));
            Chebyshev::through(&std::array::from_fn(|k| values[k]))
        });
        Self { series, ends }
    }

    /// L(ρ).
    pub fn at(&self, rho: f64) -> f64 {
        let panel = self.ends.partition_point(|end| *end <= rho).min(self.ends.len() - 1);
        let start = if panel > 0 { self.ends[panel - 1] } else { 0.0 };
        self.series[panel].at(inside([start, self.ends[panel]], rho))
    }
}

/// Gauss–Legendre rules of `NODES`, `NODES` + `NODES_STEP`, … points.
struct Rules(Vec<Vec<[f64; 2]>>);

impl Rules {
    fn new() -> Self {
        let largest = steps(PHASE);
        Self(parallel::map(largest + 1, |step| gauss(NODES + step * NODES_STEP)))
    }

    /// Nodes and weights on (0, 1) for functions of s times waves of s up to the wavenumber `rate`.
    fn nodes(&self, rate: f64) -> impl Iterator<Item = [f64; 2]> {
        let octaves = std::iter::successors(Some(1.0), |end| Some(0.5 * end)).take_while(|end| *end > FLOOR);
        let octaves = octaves.map(|end| if 0.5 * end > FLOOR { [0.5 * end, end] } else { [0.0, end] });
        octaves.flat_map(move |[low, high]| {
            let phase = (high - low) * rate;
            let parts = (phase / PHASE).ceil().max(1.0);
            let width = (high - low) / parts;
            let rule = &self.0[steps(phase / parts)];
            (0..parts as usize).flat_map(move |part| {
                let start = low + width * part as f64;
                rule.iter().map(move |[x, weight]| [start + 0.5 * width * (1.0 + x), 0.5 * width * weight])
            })
        })
    }
}

/// Steps of further nodes for a phase.
fn steps(phase: f64) -> usize {
    // The nodes without any phase suffice for some.
    ((NODES_PER_PHASE * phase - 1.0) / NODES_STEP as f64).ceil().max(0.0) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Without the cut the integrals of J₀ and of s J₀ over all s are 1/(πρ) and 0; with it too, far away.
    #[test]
    fn far_away_the_cut_is_not_seen() {
        let table = Radial::new(libm::j0, 3000.0, |_| 1.0);
        for rho in [60.0, 100.3, 777.7, 2999.0] {
            assert!((table.at(rho) - 1.0 / (PI * rho)).abs() < 2e-16, "{rho}: {}", table.at(rho) - 1.0 / (PI * rho));
        }
        let none = Radial::new(libm::j0, 3000.0, |s| s);
        assert!([60.0, 100.3, 777.7].iter().all(|&rho| none.at(rho).abs() < 1e-15));
    }

    #[test]
    fn a_table_that_reaches_further_has_the_same_bits() {
        let f = |s: f64| (1.0 + 1e5 * s).recip();
        let (short, long) = (Radial::new(libm::j1, 70.0, f), Radial::new(libm::j1, 900.0, f));
        for k in 0..=700 {
            let rho = f64::from(k) / 10.0;
            assert_eq!(short.at(rho), long.at(rho));
        }
    }
}
