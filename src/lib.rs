//! percoat
pub mod case;
pub mod field;
pub mod fourier;
pub mod grid;
pub mod hierarchy;
pub mod indenter;
pub mod lattice;
pub mod layered;
pub mod material;
pub mod operator;
pub mod solver;
pub mod texture;
