//! Segments of a test.

use percoat_common::plain;
use percoat_core::identification::Unloading;

/// Part of a test that is read.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Segment {
    /// All of its points: a curve of loading alone.
    #[default]
    Whole,
    /// Loading: the points up to the first one under nearly the largest force.
    Loading,
    /// Unloading, of which the stiffness at the largest force is read.
    Unloading {
        /// Parts of the largest force between which it is fitted.
        part: [f64; 2],
    },
    /// Drawing off surfaces that adhere, from the largest penetration to the least force.
    Retraction,
}

/// Why words name no segment.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NoSegment {
    /// A name of no segment.
    #[error("the segment must be \"loading\", \"unloading\" or \"retraction\", not \"{}\"", plain::line(.0))]
    Name(String),
    /// A fitted part where no unloading is fitted.
    #[error("a fitted part is that of unloading: take the segment of unloading, or leave the part out")]
    Part,
    /// Another number of bounds than two.
    #[error("a fitted part has two bounds, parts of the largest force such as 0.25 and 0.95, not {0}")]
    Bounds(usize),
}

impl Segment {
    /// The segment of a name, all of the test without one, with the bounds of the part that is fitted of unloading, where they are given.
    ///
    /// # Errors
    /// [`NoSegment`] for other names, for other numbers of bounds, and for bounds where no unloading is fitted.
    pub fn of(name: Option<&str>, part: Option<&[f64]>) -> Result<Self, NoSegment> {
        let segment = match name {
            None => Self::Whole,
            Some("loading") => Self::Loading,
            Some("retraction") => Self::Retraction,
            Some("unloading") => Self::Unloading {
                part: match part {
                    None => Unloading::PART,
                    Some(&[low, high]) => [low, high],
                    Some(other) => return Err(NoSegment::Bounds(other.len())),
                },
            },
            Some(other) => return Err(NoSegment::Name(other.to_owned())),
        };
        match (segment, part) {
            (Self::Whole | Self::Loading | Self::Retraction, Some(_)) => Err(NoSegment::Part),
            _ => Ok(segment),
        }
    }
}
