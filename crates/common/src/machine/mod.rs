//! Memory, disk and threads of the machine.

mod capacity;
mod threads;

pub use capacity::{Capacity, RESERVED, addresses_left, available_memory, bytes};
pub use threads::Threads;
