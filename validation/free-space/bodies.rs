//! The bodies of the tables, and the rows of each.

use crate::alone::{LayerOf, half_space};
use crate::{Data, StudyError};
use percoat_core::body::HalfSpace;
use percoat_core::body::Interface::{Bonded, Frictionless};
use percoat_core::counterbody::Shape;

pub const INDENTATION: &str = include_str!("indentation.csv");
/// A ball of unit radius.
pub const BALL: Shape = Shape::Paraboloid { radius: 1.0 };

/// The bodies of the tables by their number: names and layers on the substrate.
pub const BODIES: [(&str, &[LayerOf]); 7] = [
    ("E₁/E₂ = 10", &[(1.0, 10.0, 0.2, Bonded)]),
    ("E₁/E₂ = 100", &[(1.0, 100.0, 0.2, Bonded)]),
    ("E₁/E₂ = 0.01, ν = 0.5", &[(1.0, 0.01, 0.5, Bonded)]),
    ("two layers", &[(1.0, 4.0, 0.25, Bonded), (0.5, 0.5, 0.45, Bonded)]),
    ("E₁/E₂ = 10, sliding", &[(1.0, 10.0, 0.2, Frictionless)]),
    ("E₁/E₂ = 0.1, ν = 0.5, sliding", &[(1.0, 0.1, 0.5, Frictionless)]),
    ("two layers, sliding", &[(1.0, 4.0, 0.25, Frictionless), (0.5, 0.5, 0.45, Bonded)]),
];
/// A body of the tables.
pub fn body(number: usize) -> Result<HalfSpace, StudyError> {
    half_space(BODIES[number].1, [1.0, 0.3])
}

/// Rows of a table of the bodies: number, radius and force.
pub fn rows(table: &Data, body: usize) -> impl Iterator<Item = &Vec<f64>> {
    table.rows.iter().filter(move |row| row[0] == body as f64)
}
