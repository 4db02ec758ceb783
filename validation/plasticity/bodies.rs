//! Bodies with a hardness.

use crate::StudyError;
use percoat_core::body::{Bodies, Durability, HalfSpace};

/// A body and a rigid counterbody with a hardness, a pressure.
pub fn with_hardness(body: HalfSpace, hardness: f64) -> Result<Bodies, StudyError> {
    Ok(Bodies::from(body).with_rigid_durability(Durability { hardness: Some(hardness), ..Durability::default() })?)
}
