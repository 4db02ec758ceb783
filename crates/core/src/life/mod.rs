//! How long it lasts: damage and wear of the body pass after pass, what comes off, and what the contact is then.
//!
//! In one pass the counterbody slides over one period, or the distance that is given, or there and back. The damage of each pass adds up in the material ([`Damage`]); where it reaches 1,
//! at a depth z*, everything above comes off, the layers become thinner, the damage below moves up with the surface, and the contact is
//! solved again (Goryacheva & Torskaya, Wear 268 (2010) 1417). Between two failures sliding wears both surfaces in implicit steps
//! ([`crate::spectral::Wear`]). So there is a time without loss, **incubation**, then layers come off one after another or, where damage
//! is largest at the surface, slice by slice.
//!
//! - What comes off leaves the surface as it was: flat but for wear, without debris.
//! - Layers stay homogeneous along the surface: on a lattice sliding lowers the body by the mean depth that it wears off, under an isolated
//!   contact by the depth of the groove, the shape of which is part of the gap.
//! - The half-space is laid out anew where a twentieth of the thickness that the first layer had at first is gone since it last was, and
//!   where a layer is gone.
//! - Only the first failure has an error: later ones err by as much at least.
//! - A counterbody that goes to and fro wears by the pressure of the way there; damage is done by both ways.
//! - Damage over a groove that widens is that of the mean pressure from one row of samples at its edge to the next, on both ways.
//! - Where contact reaches the border of the window of an isolated contact, life goes on in one twice as large, on as many samples, and
//!   damage on its lines too.
//!
//! Under a contact that sticks and slips a pass is a cycle, and points stay in place (`in_place`).
//!
//! A [`LifeState`] is all that the rest of a life depends on: [`LifeTask::advance`] leads from one to the next, with one solution of the
//! contact, and can begin anywhere.

mod advance;
mod beginning;
mod damage;
mod event;
mod first;
mod groove;
mod in_place;
mod rates;
mod state;
mod tally;
mod task;
mod warnings;
mod way_back;
mod wider;
mod worn_path;

pub use beginning::Beginning;
pub use damage::Damage;
pub use event::{Course, Event, EventKind, Scar};
pub use first::{First, FirstKind};
pub use state::{LifeEnd, LifeState, PartDamage};
pub use task::{LifeError, LifeTask};
