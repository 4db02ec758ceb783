//! [Cases](case) of percoat: their keys and materials, the [units] of their numbers, doubts and memory before anything is solved,
//! and [measured indentation curves](measurements).

pub mod case;
pub mod measurements;
pub mod units;
pub mod words;
