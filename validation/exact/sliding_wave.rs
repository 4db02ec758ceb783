//! A rigid wave that slides on a bare half-space in plane strain, coupled.
//!
//! h = Δ(1 − cos 2πx/λ) below the crest slides in +x with f = μβ, β = (1−2ν)/(2(1−ν)). With ψ = πx/λ, p* = πE*Δ/λ and
//! η = −atan(f)/π contact reaches from −ψ₁, behind, to ψ₂, and with σ = ψ₂(½−η) − ψ₁(½+η)
//!
//! p = 2p* cos(πη) sin(ψ+ψ₁)^{½+η} sin(ψ₂−ψ)^{½−η} cos(ψ+σ),
//! ½[e^{2iσ} − (½+η)e^{2iψ₁} − (½−η)e^{−2iψ₂}] = (1 + if) p̄/p*.
//!
//! Without friction it is Westergaard's; contact is complete at p̄ = p* cos(atan f). In contact the surface has the
//! slope of the wave, w′ = (2/E*) (𝓗p + f(p − p̄)) with 𝓗p ↔ i sgn(k) p̂, and the traction's part of σ_xx on the
//! surface is 2μ 𝓗p: at the trailing edge, where p = 0, σ_xx is p̄ and its mean besides 2μp* [sin 2ψ₁ + f p̄/p*].

use percoat_core::numeric::search::golden_maximum;
use std::f64::consts::PI;

/// The contact of a sliding wave, pressures over p*, angles ψ = πx/λ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlidingWave {
    /// f = μβ ≥ 0.
    pub coupling: f64,
    /// p̄/p*.
    pub fraction: f64,
    /// ψ₁: how far contact reaches behind the crest.
    pub trailing: f64,
    /// ψ₂: how far it reaches before it.
    pub leading: f64,
}

impl SlidingWave {
    /// Contact under p̄ = `fraction` · p*, below complete contact: Newton's method from Westergaard's contact on, f
    /// growing.
    pub fn new(coupling: f64, fraction: f64) -> Self {
        const STEPS: usize = 50;
        let half = fraction.sqrt().asin();
        let mut wave = Self { coupling: 0.0, fraction, trailing: half, leading: half };
        for step in 1..=STEPS {
            wave.coupling = coupling * step as f64 / STEPS as f64;
            for _ in 0..8 {
                wave.improve();
            }
        }
        wave
    }

    /// η = −atan(f)/π; the pressure ends like d^{½+η} behind and d^{½−η} before.
    pub fn exponent(&self) -> f64 {
        -self.coupling.atan() / PI
    }

    /// Real and imaginary part of what the equation for ψ₁, ψ₂ lacks.
    fn lack(&self, [trailing, leading]: [f64; 2]) -> [f64; 2] {
        let eta = self.exponent();
        let sigma = leading * (0.5 - eta) - trailing * (0.5 + eta);
        let [along, behind, before] = [2.0 * sigma, 2.0 * trailing, -2.0 * leading].map(f64::sin_cos);
        let sum =
            |part: fn((f64, f64)) -> f64| 0.5 * (part(along) - (0.5 + eta) * part(behind) - (0.5 - eta) * part(before));
        [sum(|(_, cosine)| cosine) - self.fraction, sum(|(sine, _)| sine) - self.coupling * self.fraction]
    }

    fn improve(&mut self) {
        let at = [self.trailing, self.leading];
        let step = 1e-7;
        let here = self.lack(at);
        let slope = |k: usize| {
            let (mut up, mut down) = (at, at);
            (up[k], down[k]) = (at[k] + step, at[k] - step);
            let (up, down) = (self.lack(up), self.lack(down));
            [0, 1].map(|i| (up[i] - down[i]) / (2.0 * step))
        };
        let [a, b] = [slope(0), slope(1)];
        let determinant = a[0] * b[1] - a[1] * b[0];
        self.trailing -= (here[0] * b[1] - here[1] * b[0]) / determinant;
        self.leading -= (here[1] * a[0] - here[0] * a[1]) / determinant;
    }

    /// p/p* at ψ; 0 outside contact.
    pub fn pressure(&self, psi: f64) -> f64 {
        let (behind, before) = (psi + self.trailing, self.leading - psi);
        if behind <= 0.0 || before <= 0.0 {
            return 0.0;
        }
        let eta = self.exponent();
        let sigma = self.leading * (0.5 - eta) - self.trailing * (0.5 + eta);
        2.0 * (PI * eta).cos() * behind.sin().powf(0.5 + eta) * before.sin().powf(0.5 - eta) * (psi + sigma).cos()
    }

    /// The largest p/p* and its ψ.
    pub fn peak(&self) -> [f64; 2] {
        let width = self.trailing + self.leading;
        let [behind, value] = golden_maximum([0.0, width], 1e-9, |behind| self.pressure(behind - self.trailing));
        [value, behind - self.trailing]
    }

    /// σ_xx/p* at the trailing edge, without its mean over the cell: 2μ [sin 2ψ₁ + f p̄/p*] + p̄/p*.
    pub fn trailing_tension(&self, coefficient: f64) -> f64 {
        let traction = (2.0 * self.trailing).sin() + self.coupling * self.fraction;
        2.0 * coefficient * traction + self.fraction
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::westergaard::Wave;

    /// Values that two independent programs agree on.
    #[test]
    fn contact_and_peak_have_their_known_values() {
        for [f, fraction, trailing, leading, peak, place] in [
            [0.1, 0.1, 0.107_866_18, 0.097_419_26, 0.631_519_23, -0.010_384],
            [0.1, 0.5, 0.260_867_56, 0.240_629_43, 1.410_949_09, -0.015_395],
            [0.3, 0.1, 0.119_892_40, 0.088_909_83, 0.624_289_71, -0.030_790],
            [0.3, 0.5, 0.286_685_07, 0.226_568_09, 1.385_973_66, -0.045_211],
            [0.3, 0.9, 0.462_280_17, 0.379_380_89, 1.856_953_43, -0.046_384],
        ] {
            let wave = SlidingWave::new(f, fraction);
            let found = [wave.trailing / PI, wave.leading / PI, wave.peak()[0]];
            for (found, known) in found.into_iter().zip([trailing, leading, peak]) {
                assert!((found - known).abs() < 1.5e-8, "f {f}, {fraction}: {found}, {known}");
            }
            assert!((wave.peak()[1] / PI - place).abs() < 2e-6, "f {f}, {fraction}: {}", wave.peak()[1] / PI);
        }
    }

    #[test]
    fn the_pressure_has_its_mean_and_without_friction_it_is_westergaards() {
        for (f, fraction) in [(0.0, 0.3), (0.2, 0.6), (1.2, 0.3)] {
            let wave = SlidingWave::new(f, fraction);
            let steps = 200_000;
            let width = wave.trailing + wave.leading;
            let at = |i: i32| -wave.trailing + width * (f64::from(i) + 0.5) / f64::from(steps);
            let mean = (0..steps).map(|i| wave.pressure(at(i))).sum::<f64>() * width / PI / f64::from(steps);
            assert!((mean / fraction - 1.0).abs() < 1e-5, "f {f}: {mean}");
        }
        let still = Wave { amplitude: 1.0 / PI, wavelength: 1.0, modulus: 1.0 };
        let wave = SlidingWave::new(0.0, 0.3);
        for x in [0.0, 0.07, 0.15, 0.3] {
            assert!((wave.pressure(PI * x) - still.pressure(0.3, x)).abs() < 1e-12);
        }
    }
}
