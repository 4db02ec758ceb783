//! Memory, disk and threads of the machine.

mod capacity;
mod threads;

pub use capacity::{Capacity, available_memory, bytes};
pub use threads::Threads;
