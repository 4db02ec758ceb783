//! How the levels share the load, once the shapes of their pressures are known.
//!
//! Given the contact stiffness S = dP/dδ of each level alone and the displacement J of the surface under one level by a
//! unit load on another, the loads P° that a pass over the levels has found change to P:
//!
//! P_m + S_m Σ_c J_mc P_c − S_m Δδ = P_m° + S_m Σ_c J_mc P_c*,  Σ_m P_m = p̄ A (Eq. 5),
//!
//! P* the loads that the pass assumed for the other levels. Under displacement control Δδ = 0, without the last equation.

use crate::numeric::linear;
use crate::numeric::search::largest;

/// Loads before and after a pass over the levels, with stiffnesses and couplings; one entry per site of the cell.
#[derive(Debug, Clone)]
pub(super) struct LoadExchange {
    /// Loads P* that acted on the other levels, forces.
    pub assumed: Vec<f64>,
    /// Loads P° found, forces.
    pub found: Vec<f64>,
    /// Contact stiffness dP/dδ of each spot alone, a force per length; 0 out of contact.
    pub stiffness: Vec<f64>,
    /// J: displacement of m under a unit load on c, a length per force.
    pub coupling: Vec<Vec<f64>>,
}

impl LoadExchange {
    /// Exchange before a pass that assumes these loads, forces.
    pub fn new(assumed: Vec<f64>) -> Self {
        let count = assumed.len();
        Self { assumed, found: vec![0.0; count], stiffness: vec![0.0; count], coupling: vec![vec![0.0; count]; count] }
    }

    /// Sum of the loads found, a force.
    pub fn whole(&self) -> f64 {
        self.found.iter().sum()
    }

    /// Largest deviation of a load found from the assumed one, or of the sum of the loads found from the wanted one, a force.
    pub fn imbalance(&self, wanted: f64) -> f64 {
        let moved = self.found.iter().zip(&self.assumed).map(|(found, assumed)| (found - assumed).abs());
        largest(moved.chain([(self.whole() - wanted).abs()]))
    }

    /// Loads P of the next pass and the change Δδ of the penetration; `wanted` is the whole load, `None` under displacement
    /// control. Levels whose load would be tensile are left out; loads that the equations do not determine stay as found.
    pub fn new_loads(&self, wanted: Option<f64>) -> (Vec<f64>, f64) {
        let mut active: Vec<usize> = (0..self.found.len()).filter(|&m| self.found[m] > 0.0).collect();
        loop {
            let Some((loads, rise)) = self.solved(&active, wanted) else { return (self.found.clone(), 0.0) };
            let pushed: Vec<usize> = active.iter().copied().filter(|&m| loads[m] > 0.0).collect();
            if pushed.len() == active.len() || pushed.is_empty() {
                return (loads.into_iter().map(|load| load.max(0.0)).collect(), rise);
            }
            active = pushed;
        }
    }

    /// Loads P and Δδ with the `active` levels in contact; `None` when the equations do not determine them.
    fn solved(&self, active: &[usize], wanted: Option<f64>) -> Option<(Vec<f64>, f64)> {
        let n = active.len();
        let unknowns = n + usize::from(wanted.is_some());
        // The penetration as the load under the stiffest spot, so that all unknowns are loads, whatever the units.
        let stiffest = active.iter().map(|&m| self.stiffness[m]).fold(0.0, f64::max);
        let (mut rows, mut right) = (vec![vec![0.0; unknowns]; unknowns], vec![0.0; unknowns]);
        for (i, &m) in active.iter().enumerate() {
            let (stiffness, coupling) = (self.stiffness[m], &self.coupling[m]);
            for (j, &c) in active.iter().enumerate() {
                rows[i][j] = stiffness * coupling[c] + if i == j { 1.0 } else { 0.0 };
            }
            let assumed: f64 = coupling.iter().zip(&self.assumed).map(|(coupling, load)| coupling * load).sum();
            right[i] = self.found[m] + stiffness * assumed;
            if let Some(wanted) = wanted {
                rows[i][n] = -stiffness / stiffest;
                rows[n][i] = 1.0;
                right[n] = wanted;
            }
        }
        let solution = linear::solve(rows, right)?;
        let mut loads = vec![0.0; self.found.len()];
        active.iter().zip(&solution).for_each(|(&m, &load)| loads[m] = load);
        Some((loads, if wanted.is_some() { solution[n] / stiffest } else { 0.0 }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn springs_under_one_plate_share_its_load_whatever_the_units() {
        for unit in [1e-30, 1.0, 1e30] {
            let stiffness = vec![2.0 * unit, unit];
            let (loads, rise) = LoadExchange { stiffness, found: vec![1.0, 0.2], ..LoadExchange::new(vec![1.0, 0.2]) }
                .new_loads(Some(1.5));
            assert!((loads[0] - 1.2).abs() < 1e-15 && (loads[1] - 0.3).abs() < 1e-15, "{loads:?}");
            assert!((rise * unit - 0.1).abs() < 1e-15, "{rise}");
        }
    }

    #[test]
    fn a_level_that_would_be_pulled_is_left_out() {
        let exchange =
            LoadExchange { stiffness: vec![1.0, 1.0], found: vec![1.0, 0.1], ..LoadExchange::new(vec![1.0, 0.1]) };
        let (loads, rise) = exchange.new_loads(Some(0.5));
        assert!((loads[0] - 0.5).abs() < 1e-15 && loads[1] == 0.0 && (rise + 0.5).abs() < 1e-15);
    }
}
