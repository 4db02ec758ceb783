//! One contact in free space: no periodic images, displacements that vanish far away.
//!
//! `kernel` is the displacement of a sample by another one, an integral over the zone of the grid in two parts, between which
//! `cut` divides: `radial` at small wavenumbers, `filon` at large ones.

mod cut;
mod filon;
mod kernel;
mod radial;
