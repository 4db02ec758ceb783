//! "Without mutual effect": every indenter alone on the coating, all levels at one penetration, the nominal load in
//! equilibrium.
//!
//! Σ_m N_m P(δ − d_m) = p̄ A over the cell of area A with N_m indenters of level m, drop d_m, radius R_m; P(δ) of a
//! single paraboloid by the integral equation of [`crate::exact::coated_contact`].

use crate::StudyError;
use crate::exact::{CoatedContact, Coating};
use percoat_core::comparison::Answer;
use percoat_core::reading::LevelReading;
use rayon::prelude::*;

/// Contact radii of the table, and the smallest and largest one in units of √(cell area).
const RADII: usize = 96;
const RANGE: [f64; 2] = [3e-3, 0.3];

/// One level's indenters as isolated paraboloids.
#[derive(Debug, Clone, Copy)]
pub struct Indenter {
    /// Radius of curvature r_m, a length.
    pub curvature: f64,
    /// Drop d_m, a length.
    pub drop: f64,
}

/// Load, penetration, peak pressure of a paraboloid with R = 1 against its contact radius, as logarithms.
#[derive(Debug, Clone)]
pub struct Law {
    rows: Vec<[f64; 4]>,
}

/// Column of a quantity in the table.
#[derive(Debug, Clone, Copy)]
enum Quantity {
    Radius,
    Load,
    Penetration,
    Peak,
}

impl Law {
    /// The law of a coating, for contacts up to half the `period`.
    pub fn new(coating: &Coating, period: f64) -> Result<Self, StudyError> {
        let [first, last] = RANGE.map(|r| (r * period).ln());
        let radius = |i: usize| (first + (last - first) * i as f64 / (RADII - 1) as f64).exp();
        let row = |i: usize| -> Option<[f64; 4]> {
            let contact = CoatedContact::new(coating, radius(i))?;
            Some([contact.radius, contact.load, contact.penetration, contact.peak].map(f64::ln))
        };
        let rows: Option<Vec<_>> = (0..RADII).into_par_iter().map(row).collect();
        Ok(Self { rows: rows.ok_or("the integral equation of the coated contact is singular")? })
    }

    /// `wanted` where `given` has the value `x`, by cubic interpolation of the logarithms; beyond the table as its end.
    fn at(&self, given: Quantity, x: f64, wanted: Quantity) -> f64 {
        let (x, given, wanted) = (x.ln(), given as usize, wanted as usize);
        let after = self.rows.partition_point(|row| row[given] < x);
        if after == 0 || after == RADII {
            let (a, b) = if after == 0 {
                (&self.rows[0], &self.rows[1])
            } else {
                (&self.rows[RADII - 2], &self.rows[RADII - 1])
            };
            let slope = (b[wanted] - a[wanted]) / (b[given] - a[given]);
            return (a[wanted] + slope * (x - a[given])).exp();
        }
        let start = after.saturating_sub(2).min(RADII - 4);
        let nodes = &self.rows[start..start + 4];
        let weight = |i: usize| -> f64 {
            let others = (0..4).filter(|&j| j != i);
            others.map(|j| (x - nodes[j][given]) / (nodes[i][given] - nodes[j][given])).product()
        };
        (0..4).map(|i| weight(i) * nodes[i][wanted]).sum::<f64>().exp()
    }

    /// The contact of a paraboloid of curvature radius `curvature` under the force `load`.
    pub fn loaded(&self, curvature: f64, load: f64) -> LevelReading {
        if load <= 0.0 {
            return LevelReading::default();
        }
        let radius = self.at(Quantity::Load, load * curvature, Quantity::Radius);
        let max_pressure = self.at(Quantity::Radius, radius, Quantity::Peak) / curvature;
        LevelReading { load, max_pressure, contact_radius: Some(radius), ..LevelReading::default() }
    }

    /// The force that presses it in by `penetration`.
    fn load(&self, curvature: f64, penetration: f64) -> f64 {
        if penetration <= 0.0 {
            return 0.0;
        }
        self.at(Quantity::Penetration, penetration * curvature, Quantity::Load) / curvature
    }
}

/// Indenters, one of each level, that carry the load `total` together without mutual effect in a cell of the side
/// `period`.
pub fn solve(law: &Law, levels: &[Indenter], total: f64, period: f64) -> Answer {
    let loads = |penetration: f64| levels.iter().map(move |level| law.load(level.curvature, penetration - level.drop));
    let (mut low, mut high) = (1e-9 * period, period);
    for _ in 0..200 {
        let middle = (low * high).sqrt();
        if loads(middle).sum::<f64>() < total { low = middle } else { high = middle }
    }
    let penetration = (low * high).sqrt();
    let levels = levels.iter().zip(loads(penetration)).map(|(level, load)| law.loaded(level.curvature, load)).collect();
    Answer { penetration, levels }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_coating_of_the_substrates_material_obeys_hertz_at_any_load() {
        let coating = Coating::new(1.0, [0.3, 0.3], 0.4).unwrap();
        let law = Law::new(&coating, 1.5).unwrap();
        for radius in [1e-4, 0.0123, 0.2345, 0.6] {
            // P = 4E*a³/(3R), δ = a²/R, p(0) = 2E*a/(πR), also beyond both ends of the table.
            let (curvature, modulus) = (0.8, coating.modulus());
            let load = 4.0 / 3.0 * modulus * f64::powi(radius, 3) / curvature;
            let found = law.loaded(curvature, load);
            assert!((found.contact_radius.unwrap() / radius - 1.0).abs() < 1e-9);
            assert!(
                (found.max_pressure * std::f64::consts::PI * curvature / (2.0 * modulus * radius) - 1.0).abs() < 1e-9
            );
            assert!((law.load(curvature, radius * radius / curvature) / load - 1.0).abs() < 1e-9);
        }
        assert_eq!(law.load(0.8, -0.1), 0.0);
        assert_eq!(law.loaded(0.8, 0.0), LevelReading::default());
    }

    #[test]
    fn a_law_between_the_radii_of_its_table_is_the_equation_itself() {
        let coating = Coating::new(5.0, [0.22, 0.3], 0.12).unwrap();
        let law = Law::new(&coating, 1.6).unwrap();
        for radius in [0.0171, 0.0777, 0.2113] {
            let exact = CoatedContact::new(&coating, radius).unwrap();
            let found = law.loaded(1.0, exact.load);
            assert!((found.max_pressure / exact.peak - 1.0).abs() < 1e-5, "{radius}: {found:?} against {exact:?}");
            assert!((law.load(1.0, exact.penetration) / exact.load - 1.0).abs() < 1e-5);
        }
    }
}
