//! What a sweep does with its combinations.

/// What is done with every combination.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Task {
    /// Its load steps are solved.
    Solve,
    /// Its limit loads are looked for.
    Limit,
}
