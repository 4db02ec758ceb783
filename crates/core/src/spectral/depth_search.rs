//! The penetration whose composite hardness is that of the solution: δ = δ(H(δ)).
//!
//! From the largest hardness on: where the substrate is softer δ grows towards the least such depth; where it is harder δ swings about the
//! only one, and half of each step is taken, also from a depth whose hardness does not bear the load.

use super::iteration::Stop;
use crate::body::CompositeHardness;

/// Most penetrations that are tried.
const MOST: usize = 100;

/// A search for the penetration of which the hardness is that of the solution.
#[derive(Debug)]
pub(super) struct DepthSearch {
    composite: CompositeHardness,
    tolerance: f64,
    /// The depth that is tried, a length.
    depth: f64,
    /// The last depth whose hardness has borne the load, a length.
    borne: f64,
    /// Excess of the last penetration over the depth that was tried, a length.
    deeper: f64,
    tried: usize,
}

/// Outcome of a solution at the hardness of the depth that is tried.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Found {
    /// Another depth is tried.
    Another,
    /// Another depth is tried, and the solution is no start for it: the hardness does not bear the load.
    NotBorne,
    /// The search ends with this stop of the solution.
    End(Stop),
}

impl DepthSearch {
    /// A search from a depth that is `nearly` the one, a length, or from that of the largest hardness; it ends with a change of δ of the
    /// `tolerance` times δ.
    pub fn new(composite: CompositeHardness, nearly: Option<f64>, tolerance: f64) -> Self {
        let hardest = composite.hardest_depth();
        Self { composite, tolerance, depth: nearly.unwrap_or(hardest), borne: hardest, deeper: 0.0, tried: 0 }
    }

    /// Hardness of the depth that is tried, a pressure.
    pub fn hardness(&self) -> f64 {
        self.composite.at(self.depth)
    }

    /// Takes the `penetration` of the solution at this hardness, a length, and how it has ended.
    pub fn found(&mut self, stop: Stop, penetration: f64) -> Found {
        self.tried += 1;
        let deeper = penetration - self.depth;
        if stop == Stop::BeyondHardness && self.composite.hardest_depth() > self.depth && self.tried < MOST {
            self.depth = if self.borne.is_finite() { 0.5 * (self.depth + self.borne) } else { 2.0 * self.depth };
            return Found::NotBorne;
        }
        if !stop.solved() || deeper.abs() <= self.tolerance * penetration {
            return Found::End(stop);
        }
        if self.tried == MOST {
            return Found::End(Stop::IterationLimit);
        }
        self.borne = self.depth;
        self.depth = penetration - if deeper * self.deeper < 0.0 { 0.5 * deeper } else { 0.0 };
        self.deeper = deeper;
        Found::Another
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{Durability, HalfSpace, HardnessLaw, Interface, Layer, Material};

    fn composite([coating, substrate]: [f64; 2]) -> CompositeHardness {
        let of = |hardness: f64| Durability { hardness: Some(hardness), ..Durability::default() };
        let material = Material::from_young(1.0, 0.3).unwrap();
        let layer = Layer::new(material, 0.1, Interface::Bonded).unwrap().with_durability(of(coating), None).unwrap();
        let body = HalfSpace::new(vec![layer], material).with_substrate_durability(of(substrate)).unwrap();
        CompositeHardness::of(&body, HardnessLaw::Area, 1.0).unwrap()
    }

    /// A rigid ball of R = 1 in a body that yields without elasticity: δ = F/(2π H), borne where F is less than H times the area 4.
    fn searched(composite: CompositeHardness, nearly: Option<f64>, force: f64) -> (f64, Found, usize) {
        let mut search = DepthSearch::new(composite, nearly, 1e-9);
        let mut not_borne = 0;
        loop {
            let hardness = search.hardness();
            let stop = if force < 4.0 * hardness { Stop::Converged } else { Stop::BeyondHardness };
            let penetration = force / (2.0 * std::f64::consts::PI * hardness);
            match search.found(stop, penetration) {
                Found::Another => {}
                Found::NotBorne => not_borne += 1,
                end @ Found::End(_) => return (penetration - search.depth, end, not_borne),
            }
        }
    }

    #[test]
    fn soft_and_hard_substrates_have_the_hardness_of_their_depth() {
        for (hardness, force) in [([0.2, 0.08], 0.05), ([0.002, 0.05], 0.03), ([0.05, 0.05], 0.02)] {
            for nearly in [None, Some(0.1), Some(1.0)] {
                let (left, end, _) = searched(composite(hardness), nearly, force);
                assert!(
                    left.abs() < 1e-8 && end == Found::End(Stop::Converged),
                    "{hardness:?} {nearly:?}: {left} {end:?}"
                );
            }
        }
    }

    /// At the depth under the hardness of the substrate, and on the surface, the soft coating does not bear what it bears deeper.
    #[test]
    fn a_depth_whose_hardness_does_not_bear_the_load_is_gone_back_from() {
        for nearly in [None, Some(0.1)] {
            let (left, end, not_borne) = searched(composite([0.002, 0.05]), nearly, 0.06);
            assert!(not_borne > 0 && left.abs() < 1e-8 && end == Found::End(Stop::Converged), "{left} {end:?}");
        }
        // More than the substrate bears, and a softer substrate under a load that no depth bears.
        assert!(matches!(searched(composite([0.002, 0.05]), None, 0.3).1, Found::End(Stop::BeyondHardness)));
        assert_eq!(searched(composite([0.2, 0.02]), None, 0.7).1, Found::End(Stop::BeyondHardness));
    }
}
