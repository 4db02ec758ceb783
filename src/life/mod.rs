//! How long it lasts: damage and wear of the body pass after pass, what comes off, and what the contact is then.
//!
//! In one pass the counterbody slides over one period. The damage of each pass adds up in the material ([`Damage`]); where it reaches 1,
//! at a depth z*, everything above comes off, the layers become thinner, the damage below moves up with the surface, and the contact is
//! solved again (Goryacheva & Torskaya, Wear 268 (2010) 1417). Between two failures sliding wears both surfaces in implicit steps
//! ([`crate::spectral::Wear`]). So there is a time without loss, **incubation**, then layers come off one after another or, where damage
//! is largest at the surface, slice by slice.
//!
//! - What comes off leaves the surface as it was: flat but for wear, without debris.
//! - Layers stay homogeneous along the surface: a worn groove lowers the body by its mean depth, its shape is part of the gap.
//! - The half-space is laid out anew where more than a twentieth of the first layer is gone since it last was.
//!
//! A [`LifeState`] is all that the rest of a life depends on: [`LifeTask::advance`] leads from one to the next, with one solution of the
//! contact, and can begin anywhere.

mod damage;
mod event;
mod state;
mod task;

pub use damage::Damage;
pub use event::{Course, Event, EventKind};
pub use state::{LifeEnd, LifeState};
pub use task::{Beginning, LifeError, LifeTask};
