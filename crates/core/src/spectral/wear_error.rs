//! Errors of wear.

/// Reason why surfaces cannot wear so.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum WearError {
    /// A coefficient that is negative or not finite.
    #[error("a coefficient of wear must be finite and not negative, not {0}")]
    Coefficient(f64),
    /// A direction whose length is zero or not finite.
    #[error("a direction of sliding needs a finite length greater than 0, not that of [{}, {}]", .0[0], .0[1])]
    Direction([f64; 2]),
    /// A distance of sliding that is negative or not finite.
    #[error("a distance of sliding must be finite and not negative, not {0}")]
    Distance(f64),
    /// The stroke of an isolated contact, unless it is positive and finite.
    #[error("the stroke of an isolated contact must be finite and greater than 0, not {0}")]
    Stroke(f64),
    /// The largest error of a step of a path, unless it is positive and finite.
    #[error("the largest error of a step must be finite and greater than 0, not {0}")]
    Tolerance(f64),
    /// An isolated contact whose body wears while it slides along neither side of the window.
    #[error(
        "the body of an isolated contact wears in a groove along a side of the window, not along [{}, {}]: turn the problem, \
         or wear the counterbody alone", .0[0], .0[1]
    )]
    Oblique([f64; 2]),
    /// A given pressure, under which no surface stands above the body.
    #[error("a given pressure has no counterbody that slides: surfaces in contact wear")]
    Given,
}
