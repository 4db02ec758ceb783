//! Measured surfaces: [heights] from the files of instruments.

pub mod heights;
