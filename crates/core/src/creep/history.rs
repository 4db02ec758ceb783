//! History of the pressure as creep remembers it: one number a wave and mode.
//!
//! ŵ(t) = C_g p̂(t) + Σ Aⱼ hⱼ(t),  hⱼ(t) = ∫₀ᵗ e^{−(t−t′)/θⱼ} p̂(t′) dt′/θⱼ.
//!
//! Where p̂ is linear in time over an interval Δt, from p̂₋ to p̂₊, the integral is exact: with y = Δt/θ and φ = (1 − e^{−y})/y
//!
//! h₊ = e^{−y} h₋ + (φ − e^{−y}) p̂₋ + (1 − φ) p̂₊,
//!
//! so that the displacement at the end is that of an elastic body of the compliance C_g + Σ Aⱼ(1 − φⱼ) under p̂₊, and what is known
//! beforehand. Over Δt = 0 the compliance is glassy: the pressure jumps.
//!
//! Waves of equal wavenumber form a shell and share their modes. A wave takes 20 bytes, and 16 for each of its modes; a shell 12, and 16 a
//! mode, and an interval 24 a mode of a shell.

use super::modes::{Mode, RetardationModes};
use rustfft::num_complex::Complex64;
use std::sync::Arc;

/// Time over retardation time below which series are summed: differences would cancel.
const SERIES_BELOW: f64 = 1.0;

/// Memory of the pressure of all waves of a grid. A copy shares the modes.
#[derive(Debug, Clone, PartialEq)]
pub struct History {
    /// Modes of all shells, one shell after the other.
    modes: Arc<[Mode]>,
    /// Index of the first mode of each shell, and the number of all.
    first: Arc<[u32]>,
    /// Glassy compliance of each shell, a length per pressure.
    glassy: Arc<[f64]>,
    /// Shell of each wave.
    shells: Arc<[u32]>,
    /// Amplitudes h, pressures, of the modes of all waves, one wave after the other.
    states: Vec<Complex64>,
    /// Pressure of each wave at the present time.
    pressure: Vec<Complex64>,
}

/// Interval of time from one pressure to the next, with what it makes of the modes of a [`History`].
#[derive(Debug, Clone, PartialEq)]
pub struct Interval {
    weights: Vec<Weights>,
}

/// Weights of the state, of the pressure before and of the pressure after an interval.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Weights {
    /// e^{−y}.
    decay: f64,
    /// φ − e^{−y}.
    before: f64,
    /// 1 − φ.
    after: f64,
}

impl Weights {
    /// Weights for y ≥ 0, the time over the retardation time.
    fn new(y: f64) -> Self {
        if y < SERIES_BELOW {
            let (mut term, mut before, mut after) = (-1.0, 0.0, 0.0);
            let mut n = 1.0;
            // 1 − φ = −Σ (−y)ⁿ/(n+1)!, φ − e^{−y} = −Σ n(−y)ⁿ/(n+1)!, n ≥ 1
            loop {
                term *= -y / (n + 1.0);
                after += term;
                before += n * term;
                if term.abs() <= 1e-18 * after.abs() {
                    return Self { decay: (-y).exp(), before, after };
                }
                n += 1.0;
            }
        }
        let decay = (-y).exp();
        let mean = -(-y).exp_m1() / y;
        Self { decay, before: mean - decay, after: 1.0 - mean }
    }
}

impl History {
    /// History of bodies at rest without pressure: `modes` of each shell, and the shell of each wave.
    ///
    /// # Panics
    /// Where a wave has a shell that is not there.
    pub fn new(modes: &[RetardationModes], shells: impl Into<Arc<[u32]>>) -> Self {
        let shells = shells.into();
        let mut first = vec![0];
        let counts = modes.iter().map(|modes| modes.modes.len() as u32);
        first.extend(counts.scan(0, |sum, count| {
            *sum += count;
            Some(*sum)
        }));
        let count = |&shell: &u32| modes[shell as usize].modes.len();
        let zero = Complex64::default();
        Self {
            modes: modes.iter().flat_map(|modes| modes.modes.iter().copied()).collect(),
            glassy: modes.iter().map(|modes| modes.glassy).collect(),
            states: vec![zero; shells.iter().map(count).sum()],
            pressure: vec![zero; shells.len()],
            first: first.into(),
            shells,
        }
    }

    /// An interval of a duration Δt ≥ 0, a time: 0 for a jump of the load.
    pub fn interval(&self, duration: f64) -> Interval {
        Interval { weights: self.modes.iter().map(|mode| Weights::new(duration / mode.time)).collect() }
    }

    /// Compliance of each shell under the pressure at the end of an interval, C_g + Σ Aⱼ(1 − φⱼ): positive, a length per pressure.
    pub fn compliances(&self, interval: &Interval) -> Vec<f64> {
        let of = |(&glassy, ends): (&f64, &[u32])| {
            let range = ends[0] as usize..ends[1] as usize;
            let modes = self.modes[range.clone()].iter().zip(&interval.weights[range]);
            modes.fold(glassy, |sum, (mode, weights)| sum + mode.amplitude * weights.after)
        };
        self.glassy.iter().zip(self.first.windows(2)).map(of).collect()
    }

    /// Displacement of each wave at the end of an interval as far as it is known before: beside that of the pressure at the end under the
    /// [compliances](Self::compliances). Lengths, complex amplitudes as those of the pressure.
    pub fn known(&self, interval: &Interval) -> Vec<Complex64> {
        let mut states = self.states.as_slice();
        let of = |(&shell, &pressure): (&u32, &Complex64)| {
            let range = self.range(shell);
            let of_wave = states.split_off(..range.len()).unwrap_or_default();
            let modes = self.modes[range.clone()].iter().zip(&interval.weights[range]).zip(of_wave);
            modes.fold(Complex64::default(), |sum, ((mode, weights), state)| {
                sum + (state * weights.decay + pressure * weights.before) * mode.amplitude
            })
        };
        self.shells.iter().zip(&self.pressure).map(of).collect()
    }

    /// Goes to the end of an interval, where `pressure` has the complex amplitude of each wave, a pressure each.
    ///
    /// # Panics
    /// For another number of waves.
    pub fn advance(&mut self, interval: &Interval, pressure: &[Complex64]) {
        assert_eq!(pressure.len(), self.shells.len(), "a pressure for each wave");
        let mut states = self.states.as_mut_slice();
        for ((&shell, before), &after) in self.shells.iter().zip(&mut self.pressure).zip(pressure) {
            let ends = &self.first[shell as usize..];
            let range = ends[0] as usize..ends[1] as usize;
            let of_wave = states.split_off_mut(..range.len()).unwrap_or_default();
            for (state, weights) in of_wave.iter_mut().zip(&interval.weights[range]) {
                *state = *state * weights.decay + *before * weights.before + after * weights.after;
            }
            *before = after;
        }
    }

    /// Displacement of each wave at the present time: lengths, complex amplitudes as those of the pressure.
    pub fn displacement(&self) -> Vec<Complex64> {
        let mut states = self.states.as_slice();
        let of = |(&shell, &pressure): (&u32, &Complex64)| {
            let range = self.range(shell);
            let of_wave = states.split_off(..range.len()).unwrap_or_default();
            let elastic = pressure * self.glassy[shell as usize];
            self.modes[range].iter().zip(of_wave).fold(elastic, |sum, (mode, state)| sum + state * mode.amplitude)
        };
        self.shells.iter().zip(&self.pressure).map(of).collect()
    }

    /// Work that each wave stores at the present time, over the area: ½ C_g |p̂|² + ½ Σ Aⱼ |hⱼ|², a pressure times a length, in springs and
    /// Kelvin elements in a row, which respond as the body does.
    pub fn stored(&self) -> Vec<f64> {
        let mut states = self.states.as_slice();
        let of = |(&shell, &pressure): (&u32, &Complex64)| {
            let range = self.range(shell);
            let of_wave = states.split_off(..range.len()).unwrap_or_default();
            let elastic = self.glassy[shell as usize] * pressure.norm_sqr();
            0.5 * self.modes[range]
                .iter()
                .zip(of_wave)
                .fold(elastic, |sum, (mode, state)| sum + mode.amplitude * state.norm_sqr())
        };
        self.shells.iter().zip(&self.pressure).map(of).collect()
    }

    /// Indices of the modes of a shell.
    fn range(&self, shell: u32) -> std::ops::Range<usize> {
        let shell = shell as usize;
        self.first[shell] as usize..self.first[shell + 1] as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn modes(glassy: f64, pairs: &[(f64, f64)]) -> RetardationModes {
        let mode = |&(time, amplitude): &(f64, f64)| Mode { time, amplitude };
        RetardationModes { glassy, modes: pairs.iter().map(mode).collect() }
    }

    /// Three shells, one of them elastic, and times over twelve decades.
    fn shells() -> Vec<RetardationModes> {
        vec![
            modes(0.5, &[(1e6, 3.0), (20.0, 0.1), (1.0, 2.0), (1e-6, 0.4)]),
            modes(2.0, &[]),
            modes(0.01, &[(3.0, 1.0), (0.2, 5.0)]),
        ]
    }

    fn pressure(time: f64, wave: u32) -> Complex64 {
        Complex64::from_polar(1.0 + f64::from(wave), 0.3 * f64::from(wave)) * (0.7 + 0.45 * time)
    }

    /// Displacement of a pressure that jumps to a and grows at the rate b: aC(t) + b∫C, with C(t) = C_g + Σ A(1 − e^{−t/θ}).
    fn closed_form(modes: &RetardationModes, time: f64, [jump, rate]: [Complex64; 2]) -> Complex64 {
        let grown = |mode: &Mode| {
            let y = time / mode.time;
            // y − 1 + e^{−y}, without cancellation where y is small.
            let bracket =
                if y < 1e-2 { y * y * (0.5 - y / 6.0 + y * y / 24.0 - y * y * y / 120.0) } else { y + (-y).exp_m1() };
            mode.amplitude * mode.time * bracket
        };
        jump * modes.after(time) + rate * (modes.glassy * time + modes.modes.iter().map(grown).sum::<f64>())
    }

    #[test]
    fn a_pressure_linear_in_time_is_exact_in_any_steps() {
        let (shells, waves) = (shells(), vec![0, 2, 1, 2, 0]);
        for durations in [vec![7.0], vec![0.01; 700], vec![1e-7, 1e-3, 0.3, 4.0, 1e-9, 2.699], vec![3.0, 0.0, 4.0, 0.0]]
        {
            let mut history = History::new(&shells, waves.clone());
            let mut time = 0.0;
            for duration in [vec![0.0], durations].concat() {
                time += duration;
                let pressures: Vec<Complex64> = waves.iter().map(|&shell| pressure(time, shell)).collect();
                let interval = history.interval(duration);
                let (known, compliances) = (history.known(&interval), history.compliances(&interval));
                history.advance(&interval, &pressures);
                let found = history.displacement();
                for (wave, &shell) in waves.iter().enumerate() {
                    let ends = [0.0, 1.0].map(|time| pressure(time, shell));
                    let exact = closed_form(&shells[shell as usize], time, [ends[0], ends[1] - ends[0]]);
                    assert!((found[wave] - exact).norm() < 1e-13 * exact.norm(), "t {time}: {} {exact}", found[wave]);
                    let sum = known[wave] + pressures[wave] * compliances[shell as usize];
                    assert!((sum - exact).norm() < 1e-13 * exact.norm(), "known before: {sum} {exact}");
                }
            }
        }
    }

    /// ∫ over each step by Gauss' rule with five places, of a pressure that zigzags.
    #[test]
    fn any_pressure_is_the_integral_over_its_past() {
        let shell = modes(0.3, &[(30.0, 2.0), (1.5, 1.0), (0.4, 0.6)]);
        let places =
            [0.0, 0.538_469_310_105_683, -0.538_469_310_105_683, 0.906_179_845_938_664, -0.906_179_845_938_664];
        let weights =
            [128.0 / 225.0, 0.478_628_670_499_366, 0.478_628_670_499_366, 0.236_926_885_056_189, 0.236_926_885_056_189];
        let mut history = History::new(std::slice::from_ref(&shell), vec![0]);
        let at = |n: usize| Complex64::new((1.3 * n as f64).sin(), (0.7 * n as f64).cos());
        let step = 0.05;
        for n in 0..=60 {
            let interval = history.interval(if n == 0 { 0.0 } else { step });
            history.advance(&interval, &[at(n)]);
            let past = |mode: &Mode, t: f64| (-(n as f64 * step - t) / mode.time).exp() / mode.time;
            let over = |mode: &Mode, m: usize| {
                let part = |(x, w): (f64, f64)| {
                    let r = 0.5 * (1.0 + x);
                    (at(m) * (1.0 - r) + at(m + 1) * r) * (0.5 * step * w * past(mode, step * (m as f64 + r)))
                };
                places.into_iter().zip(weights).map(part).sum::<Complex64>()
            };
            let creep = |mode: &Mode| (0..n).map(|m| over(mode, m)).sum::<Complex64>() * mode.amplitude;
            let exact = at(n) * shell.glassy + shell.modes.iter().map(creep).sum::<Complex64>();
            assert!((history.displacement()[0] - exact).norm() < 1e-12, "{n}");
        }
    }

    #[test]
    fn weights_are_positive_and_add_to_one_on_both_sides_of_the_series() {
        for y in [0.0, 1e-300, 1e-12, 1e-3, 0.5, 1.0f64.next_down(), 1.0, 3.0, 40.0, 1e3, 1e300, f64::INFINITY] {
            let Weights { decay, before, after } = Weights::new(y);
            assert!((decay + before + after - 1.0).abs() < 3e-16, "{y}: {decay} {before} {after}");
            assert!(decay >= 0.0 && before >= 0.0 && (0.0..=1.0).contains(&after), "{y}");
        }
        let [below, above] = [1.0f64.next_down(), 1.0].map(Weights::new);
        assert!((below.before - above.before).abs() < 1e-15 && (below.after - above.after).abs() < 1e-15);
        // Both → y/2 for small y.
        let small = Weights::new(1e-200);
        assert_eq!((small.before, small.after), (0.5e-200, 0.5e-200));
    }

    #[test]
    fn what_is_stored_is_what_a_fast_and_a_slow_load_put_in() {
        let shells = shells();
        for (duration, of) in
            [(0.0, RetardationModes::after as fn(&RetardationModes, f64) -> f64), (1e30, |modes, _| modes.relaxed())]
        {
            let mut history = History::new(&shells, vec![2, 0, 1]);
            let interval = history.interval(duration);
            let pressures = [pressure(0.0, 2), pressure(0.0, 0), pressure(0.0, 1)];
            // Twice, so that a slow load has been held.
            (0..2).for_each(|_| history.advance(&interval, &pressures));
            for ((stored, p), shell) in history.stored().iter().zip(&pressures).zip([2, 0, 1]) {
                let work = 0.5 * of(&shells[shell], 0.0) * p.norm_sqr();
                assert!((stored - work).abs() < 1e-13 * work, "{duration}");
            }
        }
    }

    #[test]
    fn without_duration_the_response_is_glassy_and_after_long_relaxed() {
        let shells = shells();
        let history = History::new(&shells, vec![0, 1]);
        let glassy: Vec<f64> = shells.iter().map(|shell| shell.glassy).collect();
        assert_eq!(history.compliances(&history.interval(0.0)), glassy);
        let long = history.compliances(&history.interval(1e30));
        assert!(long.iter().zip(&shells).all(|(found, shell)| (found / shell.relaxed() - 1.0).abs() < 1e-15));
        assert_eq!(history.known(&history.interval(5.0)), [Complex64::default(); 2]);
    }
}
