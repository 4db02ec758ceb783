//! A ball that is shifted on a like body (Cattaneo, Rend. Accad. Naz. Lincei 27 (1938) 342; Mindlin, J. Appl. Mech. 16 (1949) 259; the cycle by
//! Mindlin & Deresiewicz, J. Appl. Mech. 20 (1953) 327).
//!
//! Traction q = μ(p − p_c), p_c the Hertzian pressure under the force P − Q/μ: the contact of the radius a sticks within c = a(1 − Q/μP)^{1/3}.
//! Exact by Coulomb's law for ν = 0; else the slip is not quite along the traction.

/// Two like bodies of the shear modulus G and Poisson's ratio ν, one of them a ball.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CattaneoMindlin {
    /// Shear modulus G, a pressure.
    pub shear: f64,
    /// Poisson's ratio ν.
    pub poisson: f64,
    /// Radius of the ball, a length.
    pub radius: f64,
    /// Force P.
    pub force: f64,
    /// Coefficient of friction μ.
    pub friction: f64,
}

impl CattaneoMindlin {
    /// Contact radius a, a length.
    pub fn contact_radius(&self) -> f64 {
        // 1/E* = 2(1−ν)/(2G).
        let modulus = self.shear / (1.0 - self.poisson);
        (0.75 * self.force * self.radius / modulus).cbrt()
    }

    /// Shift of the ball under the force Q = `part` · μP for the first time, a length.
    pub fn shift(&self, part: f64) -> f64 {
        let scale =
            3.0 * self.friction * self.force * (2.0 - self.poisson) / (8.0 * self.contact_radius() * self.shear);
        scale * (1.0 - (1.0 - part).powf(2.0 / 3.0))
    }

    /// Energy dissipated in a cycle between ±`part` · μP.
    pub fn cycle(&self, part: f64) -> f64 {
        let limit = self.friction * self.force;
        let scale = 9.0 * limit * limit * (2.0 - self.poisson) / (5.0 * self.contact_radius() * self.shear);
        let rest = 1.0 - part;
        scale * (1.0 - rest.powf(5.0 / 3.0) - 5.0 * part / 6.0 * (1.0 + rest.powf(2.0 / 3.0)))
    }

    /// Part of the contact area that sticks.
    pub fn stick_fraction(&self, part: f64) -> f64 {
        (1.0 - part).powf(2.0 / 3.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The cycle is what the force does along the path of the shift: loading from −s to s by twice the shift of half the force.
    #[test]
    fn the_energy_of_a_cycle_is_the_area_of_its_loop() {
        let ball = CattaneoMindlin { shear: 2.0, poisson: 0.3, radius: 1.5, force: 0.7, friction: 0.4 };
        let (part, steps) = (0.8, 20_000);
        let unload = |s: f64| ball.shift(part) - 2.0 * ball.shift(0.5 * (part - s));
        let limit = ball.friction * ball.force;
        let ds = 2.0 * part / f64::from(steps);
        let area: f64 = (0..steps)
            .map(|k| {
                let s = -part + (f64::from(k) + 0.5) * ds;
                // Both branches at one force; the second is the first one turned.
                (unload(s) + unload(-s)) * limit * ds
            })
            .sum();
        assert!((area / ball.cycle(part) - 1.0).abs() < 1e-6, "{area} {}", ball.cycle(part));
    }
}
