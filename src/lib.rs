//! percoat
pub mod case;
pub mod field;
pub mod fourier;
pub mod grid;
pub mod hierarchy;
pub mod indenter;
pub mod lattice;
pub mod layered;
pub mod least_squares;
pub mod material;
pub mod observables;
pub mod operator;
pub mod solver;
pub mod texture;
