//! Elastic bodies as a minimisation over the gap uses them: displacement → pressure on a torus, and back.
//!
//! On a periodic cell the torus is the cell, where both are exact. The window of an isolated contact has no inverse in closed form: its torus
//! is twice as wide, with the surface outside of the window free. What the images of the torus displace in the window,
//!
//! D p = A p − C p,
//!
//! with the operators A of free space and C of the torus, is smooth and small: it is taken from the last pressure, in outer iterations. The
//! mean compliance of the torus is chosen so that D of a force in the middle of the window vanishes there.

use crate::lattice::{Cell, Grid, LatticeError, Surroundings};
use crate::numeric::sums;
use crate::problem::Problem;
use crate::spectral::LayeredOperator;
use crate::spectral::operator::{ElasticOperator, Workspace};

/// Largest ratio of the sides of a torus around a window.
const OBLONG: f64 = 3.0;

/// Mean pressure of a torus over its mean displacement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Hold {
    /// The mean displacement is held: the mean pressure is what bears it.
    Mean,
    /// The mean displacement is the mean pressure times a compliance c₀ > 0, of the body and a machine, a length per pressure.
    Spring(f64),
    /// The mean pressure is given.
    Load(f64),
}

/// Widths of the torus of a window over those of the window: 2, and of a window that is oblong as many along its short side as make the torus at
/// most three times as long as wide. (The images of a longer one displace its middle the other way, and its mean compliance would be negative.)
pub fn widths(window: &Cell) -> [usize; 2] {
    let lengths = window.vectors().map(|a| a[0].hypot(a[1]));
    let least = 2.0 * lengths[0].max(lengths[1]) / OBLONG;
    lengths.map(|length| ((least / length - 1e-9).ceil() as usize).max(2))
}

/// Elastic bodies on a torus.
#[derive(Debug)]
pub(super) struct Elastic {
    operator: LayeredOperator,
    /// Free space in the window of an isolated contact; `None` on a periodic cell.
    free: Option<LayeredOperator>,
    workspace: Workspace,
    torus: [usize; 2],
    window: [usize; 2],
    /// Displacement under a mean pressure of the torus, a length per pressure: of layers on a rigid base, or of the torus of a window.
    mean: f64,
    area: f64,
}

impl Elastic {
    /// The bodies of a problem on a grid of its cell.
    pub fn new(problem: &Problem, grid: &Grid) -> Result<Self, LatticeError> {
        let (bodies, window, workspace) = (problem.bodies(), grid.points(), Workspace::default());
        if grid.cell().surroundings() == Surroundings::Periodic {
            let operator = LayeredOperator::new(grid, bodies.clone());
            let (mean, area) = (bodies.mean_compliance(), grid.cell().area());
            return Ok(Self { operator, free: None, workspace, torus: window, window, mean, area });
        }
        let times = widths(&grid.cell());
        let torus = [0, 1].map(|axis| times[axis] * window[axis]);
        let widened = [0, 1].map(|axis| grid.cell().vectors()[axis].map(|x| times[axis] as f64 * x));
        let cell = Cell::new(widened[0], widened[1])?;
        let operator = LayeredOperator::new(&Grid::new(cell, torus)?, bodies.clone());
        let free = Some(LayeredOperator::in_free_space(grid, bodies.clone()));
        let mut elastic = Self { operator, free, workspace, torus, window, mean: 0.0, area: cell.area() };
        elastic.mean = elastic.of_images();
        Ok(elastic)
    }

    /// Samples of the torus.
    pub fn len(&self) -> usize {
        self.torus[0] * self.torus[1]
    }

    /// Area of the torus, a length squared.
    pub fn area(&self) -> f64 {
        self.area
    }

    /// Displacement under a mean pressure of the torus, a length per pressure.
    pub fn mean_compliance(&self) -> f64 {
        self.mean
    }

    /// Whether the contact is isolated, and the torus wider than its window.
    pub fn is_isolated(&self) -> bool {
        self.free.is_some()
    }

    /// Whether a sample of the torus is in the window; all are on a periodic cell.
    pub fn is_inside(&self, sample: usize) -> bool {
        let [n1, n2] = self.window;
        sample / self.torus[1] < n1 && sample % self.torus[1] < n2
    }

    /// A field of the window on the torus, with a value outside.
    pub fn spread(&self, field: &[f64], outside: f64) -> Vec<f64> {
        let (columns, [_, n2]) = (self.torus[1], self.window);
        let mut spread = vec![outside; self.len()];
        sums::update(
            &mut spread,
            |i, value| {
                if self.is_inside(i) { field[i / columns * n2 + i % columns] } else { value }
            },
        );
        spread
    }

    /// The part of a field of the torus that lies in the window.
    pub fn within(&self, field: &[f64]) -> Vec<f64> {
        let (columns, [n1, n2]) = (self.torus[1], self.window);
        field.chunks_exact(columns).take(n1).flat_map(|row| &row[..n2]).copied().collect()
    }

    /// p → w in place: the displacement by C, with c₀ under the mean pressure.
    pub fn displace(&mut self, field: &mut [f64], compliance: f64) {
        self.without_mean(field, compliance, |operator, field, workspace| operator.displacement(field, workspace));
    }

    /// w → p in place: the pressure C⁻¹ w, with 1/c₀ times the mean displacement, or of zero mean.
    pub fn press(&mut self, field: &mut [f64], compliance: Option<f64>) {
        let stiffness = compliance.map_or(0.0, |compliance| 1.0 / compliance);
        self.without_mean(field, stiffness, |operator, field, workspace| operator.symmetric_pressure(field, workspace));
    }

    /// Displacement by C of the least wave, a length per pressure.
    pub fn unit(&self) -> f64 {
        self.operator.unit()
    }

    /// Convolutions on the torus and in the window so far.
    pub fn convolutions(&self) -> f64 {
        self.operator.convolutions() + self.free.as_ref().map_or(0.0, LayeredOperator::convolutions)
    }

    /// D p, lengths in the window, of a pressure in the window, and the displacement A p there; `None` on a periodic cell.
    pub fn corrected(&mut self, pressure: &[f64]) -> Option<[Vec<f64>; 2]> {
        let mut free = pressure.to_vec();
        self.free.as_mut()?.displacement(&mut free, &mut self.workspace);
        let mut torus = self.spread(pressure, 0.0);
        self.displace(&mut torus, self.mean);
        let correction = free.iter().zip(self.within(&torus)).map(|(free, torus)| free - torus).collect();
        Some([correction, free])
    }

    /// Mean compliance of the torus with which D of a force in the middle of the window vanishes there.
    fn of_images(&mut self) -> f64 {
        let [n1, n2] = self.window;
        let (middle, mut pressure) = (n1 / 2 * n2 + n2 / 2, vec![0.0; n1 * n2]);
        pressure[middle] = 1.0;
        let [correction, _] = self.corrected(&pressure).expect("the contact is isolated");
        correction[middle] * self.len() as f64
    }

    /// Applies an operator to a field without its mean, and `factor` to that.
    fn without_mean(
        &mut self,
        field: &mut [f64],
        factor: f64,
        apply: impl FnOnce(&mut LayeredOperator, &mut [f64], &mut Workspace),
    ) {
        let mean = sums::mean(field);
        sums::update(field, |_, x| x - mean);
        apply(&mut self.operator, field, &mut self.workspace);
        let rest = sums::mean(field);
        sums::update(field, |_, x| x - rest + factor * mean);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{HalfSpace, Interface, Layer, Material};
    use crate::counterbody::{Indenters, Level, Shape};
    use crate::lattice::Lattice;

    fn problem(cell: Cell, ratio: f64) -> Problem {
        let layer = Layer::new(Material::from_shear(ratio, 0.3).unwrap(), 0.05, Interface::Bonded).unwrap();
        let body = HalfSpace::new(vec![layer], Material::from_shear(1.0, 0.3).unwrap());
        let level = Level::new(Shape::Paraboloid { radius: 1.0 }, 0.0).unwrap();
        Problem::new(Indenters::new(Lattice::new(cell, vec![vec![[0.5; 2]]]).unwrap(), vec![level]).unwrap(), body)
    }

    fn noise(len: usize) -> Vec<f64> {
        (0..len).map(|k| ((k * k * 7919 + k * 131) % 1009) as f64 / 1009.0 - 0.3).collect()
    }

    #[test]
    fn pressure_and_displacement_are_inverse_on_both_tori() {
        for cell in [Cell::new([1.0, 0.1], [0.3, 0.8]).unwrap(), Cell::window([1.0, 0.8]).unwrap()] {
            let grid = Grid::new(cell, [20, 18]).unwrap();
            let mut elastic = Elastic::new(&problem(cell, 50.0), &grid).unwrap();
            let field = noise(elastic.len());
            let mut there = field.clone();
            elastic.press(&mut there, Some(0.7));
            elastic.displace(&mut there, 0.7);
            let error = field.iter().zip(&there).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
            assert!(error < 1e-13, "{error:e}");
            assert_eq!(elastic.within(&elastic.spread(&field[..360], 9.0)), field[..360]);
        }
    }

    /// Pressures in the middle half of the window: what the images displace is smooth and a few hundredths of the whole.
    #[test]
    fn the_images_of_a_torus_displace_little() {
        for ratio in [0.1, 1.0, 100.0] {
            let cell = Cell::window([1.0; 2]).unwrap();
            let grid = Grid::new(cell, [32, 32]).unwrap();
            let mut elastic = Elastic::new(&problem(cell, ratio), &grid).unwrap();
            assert!(elastic.mean_compliance() > 0.0);
            let is_loaded = |k: usize| (8..24).contains(&(k / 32)) && (8..24).contains(&(k % 32));
            let pressure: Vec<f64> = (0..1024).map(|k| f64::from(u8::from(is_loaded(k)))).collect();
            let [correction, displaced] = elastic.corrected(&pressure).unwrap();
            let loaded =
                |field: &[f64]| -> Vec<f64> { (0..1024).filter(|k| is_loaded(*k)).map(|k| field[k]).collect() };
            let most = |field: &[f64]| field.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
            let part = most(&loaded(&correction)) / most(&displaced);
            assert!(part < 0.05, "{ratio}: {part}");
        }
    }
}
