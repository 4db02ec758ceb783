//! The tasks on a case: one door for the program, the Python package, the page, and the combinations of a sweep.
//!
//! A task is made of a case and the memory and disk of a machine, and what cannot be done is [refused](Refused) before anything is
//! claimed or solved. Carried out with a recorder it gives its outcome with all warnings, of which files, tables and pictures are made.
//! A refinement to a prescribed accuracy ends before a grid for which memory or disk do not suffice, whatever the recorder.

mod compare;
mod identify;
mod life;
mod limit;
mod refused;
mod solve;
mod within;

pub use compare::{Compare, CompareError, Compared};
pub use identify::{Identified, Identify};
pub use life::{FollowError, FollowLife, Followed};
pub use limit::{FindLimits, Limited};
pub use refused::Refused;
pub use solve::{Solve, Solved};
