//! Cases that several tests share.
#![allow(dead_code, reason = "each test binary uses its part")]

use ndarray::Array2;
use percoat::{
    Cell, HalfSpace, Indenters, Interface, Lattice, Layer, Level, Load, Material, Problem, Reading, Route, Settings,
    Shape, Solver, Step, Topography,
};
use std::f64::consts::TAU;

/// Parameters of one of the paper's three-level cases, in units of l and E₂.
#[derive(Debug, Clone, Copy)]
pub struct Paper {
    pub name: &'static str,
    pub chi: f64,
    pub thickness: f64,
    pub poisson: [f64; 2],
    pub radii: [f64; 3],
    pub step: f64,
    pub pressure: f64,
}

const FIG2: Paper =
    Paper { name: "fig2", chi: 2.0, thickness: 0.5, poisson: [0.2, 0.3], radii: [0.8; 3], step: 0.01, pressure: 0.06 };

/// Figs 2, 3a, 3b, 4 and 5 of Goryacheva & Torskaya (2019), each with one of its loads.
pub const PAPER: [Paper; 5] = [
    FIG2,
    Paper { name: "fig3a", chi: 0.5, poisson: [0.45, 0.3], pressure: 0.008, ..FIG2 },
    Paper { name: "fig3b", chi: 0.5, pressure: 0.008, ..FIG2 },
    Paper { name: "fig4", chi: 0.2, thickness: 0.12, poisson: [0.22, 0.3], pressure: 0.01, ..FIG2 },
    Paper {
        name: "fig5",
        chi: 3.0,
        thickness: 0.087,
        poisson: [0.22, 0.4],
        radii: [1.67, 1.25, 0.83],
        step: 0.06,
        pressure: 0.08,
    },
];

impl Paper {
    pub fn problem(&self) -> Problem {
        Problem::new(self.indenters(), self.half_space())
    }

    pub fn indenters(&self) -> Indenters {
        Indenters::new(Lattice::hexagonal(1.0, 3).unwrap(), self.levels()).unwrap()
    }

    pub fn levels(&self) -> Vec<Level> {
        let level = |m: usize| paraboloid(self.radii[m], -self.step * m as f64);
        (0..3).map(level).collect()
    }

    pub fn half_space(&self) -> HalfSpace {
        coated(self.chi, self.thickness, self.poisson, Interface::Bonded)
    }
}

pub fn paraboloid(radius: f64, height: f64) -> Level {
    Level::new(Shape::Paraboloid { radius }, height).unwrap()
}

/// The uncoated half-space, E = 1, ν = 0.3.
pub fn bare() -> HalfSpace {
    HalfSpace::new(vec![], Material::from_young(1.0, 0.3).unwrap())
}

/// One layer on a substrate with E₂ = 1; χ = G₁/G₂.
pub fn coated(chi: f64, thickness: f64, poisson: [f64; 2], interface: Interface) -> HalfSpace {
    let substrate = Material::from_young(1.0, poisson[1]).unwrap();
    let coating = Material::from_shear(chi * substrate.shear(), poisson[0]).unwrap();
    HalfSpace::new(vec![Layer::new(coating, thickness, interface).unwrap()], substrate)
}

/// The largest von Mises stress under a bare sphere that slides, over the peak pressure, by the closed form (Hamilton 1983): at
/// the trailing edge, or inside on a hundred by forty places of the plane of symmetry.
#[cfg(feature = "validate")]
pub fn largest_mises_of_a_sliding_sphere(nu: f64, friction: f64) -> f64 {
    use percoat::validation::exact::sliding_sphere::{mises, stresses, together};
    let at = |place| mises(together(stresses(nu, place), friction));
    let inside = (0..4000).map(|k| at([0.4 - 1.2 * f64::from(k % 100) / 100.0, 0.0, 0.02 + 0.02 * f64::from(k / 100)]));
    inside.fold(at([-1.0, 0.0, 0.0]), f64::max)
}

/// Indenters of one level, one in the cell.
pub fn one_level(lattice: Lattice, level: Level) -> Indenters {
    Indenters::new(lattice, vec![level]).unwrap()
}

/// Solves one step with the default settings.
pub fn solve(problem: &Problem, points: [usize; 2], load: Load) -> (Step, Reading) {
    solve_with(problem, points, load, Settings::default())
}

/// Solves one step until rounding is all that is left: what is equal by symmetry comes out so however it was reached.
pub fn solve_sharply(problem: &Problem, points: [usize; 2], load: Load) -> (Step, Reading) {
    let (step, reading) = solve_with(problem, points, load, Settings { tolerance: 1e-13, ..Settings::default() });
    assert!(step.report.stop.solved() && step.report.route == Route::Direct, "{}", step.report);
    (step, reading)
}

/// Solves one step.
pub fn solve_with(problem: &Problem, points: [usize; 2], load: Load, settings: Settings) -> (Step, Reading) {
    let step = Solver::new(problem.clone(), points, settings).unwrap().solve(load);
    let reading = Reading::of(step.finest());
    (step, reading)
}

/// Largest difference over the largest value of the second field.
pub fn relative_difference<'a>(a: impl IntoIterator<Item = &'a f64>, b: impl IntoIterator<Item = &'a f64>) -> f64 {
    let [a, b]: [Vec<&f64>; 2] = [a.into_iter().collect(), b.into_iter().collect()];
    let scale = b.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).fold(0.0, |m: f64, (x, y)| m.max((*x - y).abs())) / scale
}

/// A generator of reproducible numbers (xorshift).
#[derive(Debug)]
pub struct Random(pub u64);

impl Random {
    /// In [0, 1).
    pub fn unit(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Between `a` and `b`, uniform on a logarithmic scale.
    pub fn log(&mut self, a: f64, b: f64) -> f64 {
        a * (b / a).powf(self.unit())
    }

    pub fn pick<T: Clone>(&mut self, choices: &[T]) -> T {
        choices[(self.unit() * choices.len() as f64) as usize].clone()
    }
}

/// Smooth hills on a hexagonal cell of period 1: waves with random phases, so that no apex stands on a sample.
#[derive(Debug)]
pub struct Hills(Vec<[f64; 4]>);

impl Hills {
    /// `count` waves of up to `most` periods along each cell vector; `height` is that of the longest.
    pub fn random(random: &mut Random, count: usize, most: u32, height: f64) -> Self {
        let most = f64::from(most);
        let mut wave = || {
            let [k1, k2] = [0, 1].map(|_| ((2.0 * most + 1.0) * random.unit()).floor() - most);
            [k1, k2, random.unit(), height / (1.0 + k1 * k1 + k2 * k2)]
        };
        Self((0..count).map(|_| wave()).collect())
    }

    /// Heights of the hills on n × n samples.
    pub fn topography(&self, n: usize) -> Topography {
        let height = |(i, j): (usize, usize)| {
            let (s, t) = (i as f64 / n as f64, j as f64 / n as f64);
            self.0.iter().map(|[k1, k2, phase, size]| size * (TAU * (k1 * s + k2 * t + phase)).cos()).sum()
        };
        Topography::new(Cell::hexagonal(1.0).unwrap(), Array2::from_shape_fn([n; 2], height)).unwrap()
    }
}
