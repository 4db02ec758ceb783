//! How the levels share the load, once their patterns are known.
//!
//! Every level in contact answers with its stiffness S to what its surface is moved by, and loads on one level move
//! the surface under another by J, so that the loads P that a sweep has found change to
//!
//! P_m + S_m Σ_c J_mc P_c − S_m Δδ = P_m° + S_m Σ_c J_mc P_c*,  Σ_m P_m = p̄ A (Eq. 5),
//!
//! P* the loads the sweep had for the others. The last equation falls away under displacement control, with Δδ = 0.

use crate::numeric::linear;
use crate::numeric::search::largest;

/// What a sweep has found of the levels, one entry per site.
#[derive(Debug, Clone)]
pub(super) struct Sweep {
    /// Loads P* that acted on the others.
    pub used: Vec<f64>,
    /// Loads P° found.
    pub found: Vec<f64>,
    /// dP/dδ of each spot alone, 0 out of contact.
    pub stiffness: Vec<f64>,
    /// J: displacement of m under a unit load on c.
    pub coupling: Vec<Vec<f64>>,
}

impl Sweep {
    pub fn new(used: Vec<f64>) -> Self {
        let count = used.len();
        Self { used, found: vec![0.0; count], stiffness: vec![0.0; count], coupling: vec![vec![0.0; count]; count] }
    }

    /// Largest deviation of the loads found from those used, and of their sum from the wanted one.
    pub fn unrest(&self, wanted: f64) -> f64 {
        let moved = self.found.iter().zip(&self.used).map(|(found, used)| (found - used).abs());
        largest(moved.chain([(self.found.iter().sum::<f64>() - wanted).abs()]))
    }

    /// New loads and the change of the penetration; `wanted` is the whole load, `None` under displacement control.
    /// Levels that would be pulled are left out; loads that are not determined stay as found.
    pub fn exchanged(&self, wanted: Option<f64>) -> (Vec<f64>, f64) {
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

    /// `None` when the equations do not determine the loads.
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
            let used: f64 = coupling.iter().zip(&self.used).map(|(coupling, load)| coupling * load).sum();
            right[i] = self.found[m] + stiffness * used;
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
            let (loads, rise) =
                Sweep { stiffness, found: vec![1.0, 0.2], ..Sweep::new(vec![1.0, 0.2]) }.exchanged(Some(1.5));
            assert!((loads[0] - 1.2).abs() < 1e-15 && (loads[1] - 0.3).abs() < 1e-15, "{loads:?}");
            assert!((rise * unit - 0.1).abs() < 1e-15, "{rise}");
        }
    }

    #[test]
    fn a_level_that_would_be_pulled_is_left_out() {
        let sweep = Sweep { stiffness: vec![1.0, 1.0], found: vec![1.0, 0.1], ..Sweep::new(vec![1.0, 0.1]) };
        let (loads, rise) = sweep.exchanged(Some(0.5));
        assert!((loads[0] - 0.5).abs() < 1e-15 && loads[1] == 0.0 && (rise + 0.5).abs() < 1e-15);
    }
}
