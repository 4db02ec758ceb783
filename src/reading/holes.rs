//! What is open inside contacts.

use crate::lattice::components::{Component, open_regions};
use crate::lattice::{Connectivity, Grid};

/// Label of a sample that lies in no hole.
const NOBODY: u32 = u32::MAX;

/// Open samples that one contact encloses.
pub struct Holes {
    /// The contact around each sample; empty without holes.
    around: Vec<u32>,
    /// Contacts that have a hole, ascending.
    owners: Vec<u32>,
}

impl Holes {
    /// Of a pressure; `label` tells contacts apart by their samples, and may leave some out.
    pub fn of(grid: &Grid, pressure: &[f64], label: impl Fn(usize) -> Option<u32>) -> Self {
        let offsets = grid.neighbour_offsets(Connectivity::Edges);
        let enclosing = |open: &Component| {
            let around = |index: usize| {
                let both = offsets.iter().flat_map(|offset| [*offset, offset.map(|k| -k)]);
                both.map(move |offset| grid.at_offset(offset, index))
            };
            let mut beside = open.indices(grid).flatten().flat_map(around).filter(|&next| pressure[next] > 0.0);
            let owner = label(beside.next()?)?;
            beside.all(|index| label(index) == Some(owner)).then_some(owner)
        };
        // What lies outside meets its own images, or several contacts.
        let found: Vec<(u32, Component)> = open_regions(grid, pressure)
            .into_iter()
            .filter(|open| !open.wraps)
            .filter_map(|open| Some((enclosing(&open)?, open)))
            .collect();
        let mut around = if found.is_empty() { Vec::new() } else { vec![NOBODY; grid.len()] };
        for (owner, hole) in &found {
            hole.indices(grid).for_each(|run| around[run].fill(*owner));
        }
        let mut owners: Vec<u32> = found.into_iter().map(|(owner, _)| owner).collect();
        owners.sort_unstable();
        owners.dedup();
        Self { around, owners }
    }

    /// Whether a contact has a hole.
    pub fn has(&self, owner: u32) -> bool {
        self.owners.binary_search(&owner).is_ok()
    }

    /// The contact in whose hole a sample lies.
    pub fn around(&self, index: usize) -> Option<u32> {
        self.around.get(index).copied().filter(|&owner| owner != NOBODY)
    }
}
