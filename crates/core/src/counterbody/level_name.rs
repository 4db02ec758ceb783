//! Names of levels in words.

use super::Level;
use std::fmt;

/// Name of a level in sentences, tables and legends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LevelName {
    /// A level by its number, from 1.
    Numbered(usize),
    /// The only indenter of an isolated contact, by the name of its shape.
    Lone(&'static str),
}

impl LevelName {
    /// The name of a level by its number, from 1; `lone` is the only indenter of an isolated contact.
    pub fn new(number: usize, lone: Option<&Level>) -> Self {
        lone.map_or(Self::Numbered(number), |level| Self::Lone(level.shape().name()))
    }

    /// The name of the only indenter of a shape, by the word of case files for it.
    pub fn of_shape(shape: &str) -> &str {
        match shape {
            "sphere" => "ball",
            "power" => "indenter",
            "paraboloid" | "cone" => shape,
            _ => "tip",
        }
    }

    /// The name without an article, as it stands in a legend: `level 2`, `ball`.
    pub fn label(&self) -> String {
        match self {
            Self::Numbered(number) => format!("level {number}"),
            Self::Lone(shape) => Self::of_shape(shape).to_owned(),
        }
    }
}

/// The name as it stands in a sentence: `level 2`, `the ball`.
impl fmt::Display for LevelName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Numbered(_) => f.write_str(&self.label()),
            Self::Lone(_) => write!(f, "the {}", self.label()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::counterbody::{Indenters, Shape};
    use crate::lattice::{Cell, Lattice};
    use crate::{HalfSpace, Material, Problem};

    #[test]
    fn only_a_lone_indenter_is_called_by_its_shape() {
        let body = || HalfSpace::new(vec![], Material::from_young(1.0, 0.3).unwrap());
        let named = |lattice: Lattice, shape: &Shape| {
            let levels = lattice.sites().iter().map(|_| Level::new(shape.clone(), 0.0).unwrap()).collect();
            let problem = Problem::new(Indenters::new(lattice, levels).unwrap(), body());
            let name = problem.level_name(1);
            [name.to_string(), name.label()]
        };
        let window = |sites: Vec<Vec<[f64; 2]>>| Lattice::new(Cell::window([4.0, 4.0]).unwrap(), sites).unwrap();
        let middle = || window(vec![vec![[0.5, 0.5]]]);
        let ball = Shape::Sphere { radius: 1.0 };
        assert_eq!(named(middle(), &ball), ["the ball", "ball"]);
        assert_eq!(named(middle(), &Shape::Cone { slope: 0.1 }), ["the cone", "cone"]);
        let flat = Shape::Power { coefficient: 1.0, exponent: 20.0 };
        assert_eq!(named(middle(), &flat), ["the indenter", "indenter"]);
        assert_eq!(named(middle(), &Shape::SpheroCone { radius: 1.0, slope: 0.5 }), ["the tip", "tip"]);
        for several in [window(vec![vec![[0.2, 0.5], [0.8, 0.5]]]), window(vec![vec![[0.2, 0.5]], vec![[0.8, 0.5]]])] {
            assert_eq!(named(several, &ball), ["level 1", "level 1"]);
        }
        assert_eq!(named(Lattice::square(4.0, 1).unwrap(), &ball), ["level 1", "level 1"]);
    }
}
