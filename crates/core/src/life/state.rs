//! The state of a body after some passes, from which its life goes on.

use super::damage::Damage;
use super::event::{Course, Event};
use crate::body::Side;
use crate::numeric::serialised;
use crate::reading::FatiguePart;
use crate::spectral::Stop;
use serde::{Deserialize, Serialize};

/// The state of a life after some passes. What follows depends on nothing else.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LifeState {
    /// Passes so far.
    pub passes: f64,
    /// Points of the grid of all its contacts.
    pub points: [usize; 2],
    /// Height of what has come off by damage, a length.
    pub detached: f64,
    /// Height by which wear has lowered the body, a length: the mean depth worn off it by sliding on a lattice, the largest under an isolated
    /// contact, beside which nothing is worn, and where points stay in place.
    pub lowered: f64,
    /// Damage in the frame of the original body.
    pub damage: Damage,
    /// Damage so far of each part of points that stay in place, at the worst place of each state; empty where the counterbody slides.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub in_place: Vec<PartDamage>,
    /// Depths worn off body and counterbody by sliding, lengths sample by sample, a₂ fastest; empty where nothing is.
    pub worn: [Vec<f64>; 2],
    /// Depths pressed in for good of a counterbody that is softer, lengths sample by sample; empty where nothing is.
    pub indented: Vec<f64>,
    /// Length of sliding that the next step of wear tries, a length, or its cycles where points stay in place; 0 at the beginning.
    pub step: f64,
    /// Passes so far whose damage is to be added at the rates of the present surfaces.
    pub pending: f64,
    /// Whether the last failure was at the surface, which wears on in slices.
    pub sheds: bool,
    /// Loads solved so far.
    pub solved: usize,
    /// Events so far.
    pub events: Vec<Event>,
    /// The course so far.
    pub course: Vec<Course>,
    /// Times that the window of an isolated contact was doubled, as contact grew.
    pub doubled: u32,
    /// Why the life ended, if it has.
    pub end: Option<LifeEnd>,
    /// Why the last contact was not solved, where it was not.
    pub stop: Option<Stop>,
}

/// Damage of a material or an interface of the body.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PartDamage {
    /// The part, by its number in the original body.
    #[serde(flatten)]
    pub part: FatiguePart,
    /// Damage; 1 where a crack begins, infinite under a tip.
    #[serde(deserialize_with = "serialised::infinite")]
    pub damage: f64,
}

/// Why a life is not followed any further.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LifeEnd {
    /// The passes are done.
    Passes,
    /// Nothing tires or wears any further.
    Endless,
    /// All layers on a rigid base have come off.
    NothingLeft,
    /// A contact of the worn surfaces could not be solved.
    Unsolved,
    /// The largest number of loads was solved.
    LoadLimit,
}

impl LifeState {
    /// Mean depth worn off a surface by sliding, a length.
    pub fn mean_worn(&self, side: Side) -> f64 {
        let depths = self.of(side);
        if depths.is_empty() { 0.0 } else { depths.iter().sum::<f64>() / depths.len() as f64 }
    }

    /// Largest depth worn off a surface by sliding, a length.
    pub fn largest_worn(&self, side: Side) -> f64 {
        self.of(side).iter().copied().fold(0.0, f64::max)
    }

    /// Height of all that is gone from the body, a length.
    pub fn removed(&self) -> f64 {
        self.detached + self.lowered
    }

    /// Depths worn off a surface, lengths sample by sample; empty where nothing is.
    pub(super) fn of(&self, side: Side) -> &[f64] {
        &self.worn[match side {
            Side::Body => 0,
            Side::Counterbody => 1,
        }]
    }
}
