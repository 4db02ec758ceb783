//! Creep compliance of a Prony series: J(t) = 1/G(∞) + Σ A (1 − e^{−xt}).
//!
//! G(s) = G₀ + Σ g sτ/(1 + sτ) has one zero −x between two of its poles −1/τ, and one between 0 and the nearest pole; A = 1/(x G′(−x)).

/// Compliance in time.
#[derive(Debug, Clone)]
pub struct Compliance {
    glassy: f64,
    /// A and x of each zero.
    modes: Vec<[f64; 2]>,
}

impl Compliance {
    /// Compliance for the relaxed modulus and the terms g and τ.
    pub fn new(relaxed: f64, terms: &[[f64; 2]]) -> Self {
        let mut poles: Vec<f64> = terms.iter().map(|term| 1.0 / term[1]).collect();
        poles.sort_by(f64::total_cmp);
        let modulus = |x: f64| relaxed - terms.iter().map(|[g, time]| g * x * time / (1.0 - x * time)).sum::<f64>();
        let slope = |x: f64| terms.iter().map(|[g, time]| g * time / (1.0 - x * time).powi(2)).sum::<f64>();
        let zero = |(number, &above): (usize, &f64)| {
            let [mut low, mut high] = [if number == 0 { 0.0 } else { poles[number - 1] }, above];
            for _ in 0..200 {
                let middle = 0.5 * (low + high);
                if modulus(middle) > 0.0 { low = middle } else { high = middle }
            }
            let x = 0.5 * (low + high);
            [1.0 / (x * slope(x)), x]
        };
        let modes = poles.iter().enumerate().map(zero).collect();
        Self { glassy: 1.0 / (relaxed + terms.iter().map(|term| term[0]).sum::<f64>()), modes }
    }

    /// J of a load held for a time.
    pub fn after(&self, time: f64) -> f64 {
        self.modes.iter().fold(self.glassy, |sum, [a, x]| sum - a * (-x * time).exp_m1())
    }

    /// ∫J over a time: of a load that rises at the rate 1.
    pub fn of_rise(&self, time: f64) -> f64 {
        self.modes.iter().fold(self.glassy * time, |sum, [a, x]| sum + a * (time + (-x * time).exp_m1() / x))
    }
}
