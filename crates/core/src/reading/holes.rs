//! Holes: open samples that one contact encloses.

use crate::lattice::components::{Component, open_regions};
use crate::lattice::{Connectivity, Grid};

/// Label of a sample that belongs to no contact.
pub const NO_CONTACT: u32 = u32::MAX;

/// The holes of all contacts of a grid.
pub struct Holes {
    /// Label of the contact around each sample; empty without holes.
    around: Vec<u32>,
    /// Labels of the contacts that have a hole, ascending.
    owners: Vec<u32>,
}

impl Holes {
    /// The holes under a `pressure` given sample by sample; `label` gives the contact that a sample belongs to, by the flat index
    /// of the sample, and `None` for contacts whose holes do not count.
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
        // Open samples outside the contacts meet their own images, or several contacts.
        let found: Vec<(u32, Component)> = open_regions(grid, pressure)
            .into_iter()
            .filter(|open| !open.wraps)
            .filter_map(|open| Some((enclosing(&open)?, open)))
            .collect();
        let mut around = if found.is_empty() { Vec::new() } else { vec![NO_CONTACT; grid.len()] };
        for (owner, hole) in &found {
            hole.indices(grid).for_each(|run| around[run].fill(*owner));
        }
        let mut owners: Vec<u32> = found.into_iter().map(|(owner, _)| owner).collect();
        owners.sort_unstable();
        owners.dedup();
        Self { around, owners }
    }

    /// Whether the contact with a label has a hole.
    pub fn has(&self, owner: u32) -> bool {
        self.owners.binary_search(&owner).is_ok()
    }

    /// Label of the contact in whose hole a sample lies, by the flat index of the sample.
    pub fn around(&self, index: usize) -> Option<u32> {
        self.around.get(index).copied().filter(|&owner| owner != NO_CONTACT)
    }
}
