//! The one-dimensional layer: springs side by side that relax, below a paraboloid that slides.
//!
//! p + c p′ = (M w + c M∞ w′)/h along s behind the leading edge, c = vτ; M = 2G(1 − ν)/(1 − 2ν) of a layer that cannot widen. In contact
//! w = a s − s²/2 over R = 1, on the strip of half-width a = √(2δ − y²), and p(0) = 0. So p = q₀(1 − e^{−s/c}) + q₁ s + q₂ s², up to where
//! it vanishes.

use super::setup::RADIUS;

/// A layer of this kind, and the way of the load in the relaxation time.
#[derive(Debug, Clone, Copy)]
pub struct Sheet {
    pub thickness: f64,
    pub poisson: f64,
    pub ratio: f64,
    pub way: f64,
}

/// Load, friction and peak of a contact.
#[derive(Debug, Clone, Copy, Default)]
pub struct Pressed {
    pub load: f64,
    pub friction: f64,
    pub peak: f64,
}

/// Pressure of a strip: q₀, q₁, q₂, c and where it ends.
type Strip = [f64; 5];

const STRIPS: usize = 200;

impl Sheet {
    /// The relaxed stiffness M/h.
    pub fn stiffness(&self) -> f64 {
        2.0 * (1.0 - self.poisson) / (1.0 - 2.0 * self.poisson) / self.thickness
    }

    /// The contact under a load, by bisection of the half-width of its middle strip.
    pub fn under(&self, load: f64) -> Pressed {
        let [mut low, mut high] = [0.0, RADIUS];
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.with_width(middle).load < load { low = middle } else { high = middle }
        }
        self.with_width(high)
    }

    fn with_width(&self, half: f64) -> Pressed {
        let mut all = Pressed::default();
        let mut moment = 0.0;
        for k in 0..STRIPS {
            // y = a cos θ, both signs.
            let angle = std::f64::consts::FRAC_PI_2 * (k as f64 + 0.5) / STRIPS as f64;
            let strip = self.strip(half * angle.sin());
            let [force, turned] = integrals(strip);
            let width = 2.0 * half * angle.sin() * std::f64::consts::FRAC_PI_2 / STRIPS as f64;
            all.load += width * force;
            // Slope x = a − s of the shape.
            moment += width * (half * angle.sin() * force - turned);
        }
        let strip = self.strip(half);
        all.friction = moment / all.load / RADIUS;
        all.peak = (0..=2000).map(|k| pressure(strip, strip[4] * f64::from(k) / 2000.0)).fold(0.0, f64::max);
        all
    }

    fn strip(&self, half: f64) -> Strip {
        let (relaxed, c) = (self.stiffness(), self.way);
        let glassy = self.ratio * relaxed;
        let right = [c * glassy * half, relaxed * half - c * glassy, -0.5 * relaxed];
        let q2 = right[2];
        let q1 = right[1] - 2.0 * c * q2;
        let q0 = right[0] - c * q1;
        // Positive at first, below 0 where the shape leaves the undeformed surface.
        let [mut low, mut high] = [1e-9 * half, 2.0 * half];
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if pressure([q0, q1, q2, c, 0.0], middle) > 0.0 { low = middle } else { high = middle }
        }
        [q0, q1, q2, c, low]
    }
}

fn pressure([q0, q1, q2, c, _]: Strip, s: f64) -> f64 {
    -q0 * (-s / c).exp_m1() + s * (q1 + s * q2)
}

/// ∫ p ds and ∫ p s ds over a strip.
fn integrals([q0, q1, q2, c, end]: Strip) -> [f64; 2] {
    let (gone, s) = (-(-end / c).exp_m1(), end);
    let force = q0 * (s - c * gone) + q1 * s * s / 2.0 + q2 * s.powi(3) / 3.0;
    let decay = c * c * gone - c * s * (1.0 - gone);
    [force, q0 * (s * s / 2.0 - decay) + q1 * s.powi(3) / 3.0 + q2 * s.powi(4) / 4.0]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sheet_at_rest_carries_its_closed_form_and_a_slow_one_rubs_as_every_layer() {
        let sheet = Sheet { thickness: 0.01, poisson: 0.3, ratio: 10.0, way: 1e-7 };
        let half = 0.1f64;
        let pressed = sheet.with_width(half);
        // P = π a⁴ M/(4 R h), and μ = vτ (r − 1)/R.
        let load = std::f64::consts::PI * half.powi(4) * sheet.stiffness() / 4.0;
        assert!((pressed.load / load - 1.0).abs() < 1e-4, "{} {load}", pressed.load);
        assert!((pressed.friction / 9e-7 - 1.0).abs() < 1e-3, "{}", pressed.friction);
        assert!((pressed.peak / (0.5 * half * half * sheet.stiffness()) - 1.0).abs() < 1e-4);
        assert!((sheet.under(load).load / load - 1.0).abs() < 1e-9);
    }
}
