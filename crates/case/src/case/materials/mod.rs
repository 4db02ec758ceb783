//! Materials by their names: the library of `percoat materials`, files of one's own, and the key `material` of a case.
//!
//! Numbers of the library and of such files are in GPa; a case takes them in its `units.pressure`.

mod entry;
mod fill;
mod library;
mod origin;

pub use entry::{Certainty, LibraryMaterial, Property};
pub(super) use fill::{GPA, fill, path};
pub use library::{MaterialsError, UnknownMaterial, library, materials_of_file};
pub use origin::LibraryStrength;
