//! Random cases, reproducible from a seed.

use super::StudyError;
use percoat_core::body::{HalfSpace, Interface, Layer, Material};
use percoat_core::counterbody::{Indenters, Level, Shape};
use percoat_core::lattice::{Cell, Lattice};

/// SplitMix64 (Steele, Lea & Flood 2014).
#[derive(Debug, Clone)]
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// Uniform in [low, high).
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^= z >> 31;
        low + (high - low) * (z >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Uniform logarithm between `low` and `high`, both positive.
    pub fn logarithmic(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp()
    }

    /// One of 0, …, count − 1.
    pub fn index(&mut self, count: usize) -> usize {
        self.between(0.0, count as f64) as usize
    }
}

/// Indenters of every shape at one to four levels, on hexagonal, square and oblique cells of side 1 … 2; drops up to
/// three times the heights of the profiles at a tenth of the side.
pub fn indenters(random: &mut Random) -> Result<Indenters, StudyError> {
    let lattice = match random.index(3) {
        0 => Lattice::hexagonal(1.0, [1, 3, 4][random.index(3)])?,
        1 => Lattice::square(1.0, [1, 2, 4][random.index(3)])?,
        _ => {
            let cell = Cell::new([1.0, 0.0], [random.between(-0.5, 0.5), random.between(0.8, 1.5)])?;
            let first = [random.between(0.0, 1.0), random.between(0.0, 1.0)];
            let second = [first[0] + random.between(0.4, 0.6), first[1] + random.between(0.4, 0.6)];
            Lattice::new(cell, vec![vec![first], vec![second]])?
        }
    };
    let levels = lattice.sites().iter().map(|_| -> Result<Level, StudyError> {
        let shape = match random.index(4) {
            0 | 1 => Shape::Paraboloid { radius: random.logarithmic(0.5, 5.0) },
            2 => Shape::Cone { slope: random.logarithmic(0.02, 0.2) },
            _ => Shape::Power { coefficient: random.logarithmic(0.1, 1.0), exponent: random.between(1.2, 4.0) },
        };
        let height = -random.between(0.0, 3.0) * shape.profile(0.1);
        Ok(Level::new(shape, height)?)
    });
    let levels = levels.collect::<Result<_, _>>()?;
    Ok(Indenters::new(lattice, levels)?)
}

/// Bare, or with one or two layers 0.02 … 1 thick, 0.1 … 20 times as stiff as the substrate, with any interface.
pub fn half_space(random: &mut Random) -> Result<HalfSpace, StudyError> {
    let substrate = Material::from_young(1.0, random.between(0.0, 0.5))?;
    let layers = (0..random.index(3)).map(|_| -> Result<Layer, StudyError> {
        let material = Material::from_young(random.logarithmic(0.1, 20.0), random.between(0.0, 0.5))?;
        let interface = match random.index(4) {
            0 => Interface::Frictionless,
            1 => {
                Interface::Spring { tangential: random.logarithmic(0.3, 30.0), normal: random.logarithmic(3.0, 100.0) }
            }
            _ => Interface::Bonded,
        };
        Ok(Layer::new(material, random.logarithmic(0.02, 1.0), interface)?)
    });
    Ok(HalfSpace::new(layers.collect::<Result<_, _>>()?, substrate))
}
