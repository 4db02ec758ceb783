//! What the anchors share: bodies, solved steps, and comparisons that say by how much they failed.

use percoat::hierarchy::Hierarchy;
use percoat::indenter::{Level, Shape};
use percoat::lattice::Lattice;
use percoat::material::{HalfSpace, Interface, Layer, Material};
use percoat::observables::{Observables, observe};
use percoat::solver::{Control, Settings};
use percoat::texture::Surface;

/// Asserts |got − expected| ≤ tolerance · |expected|.
#[track_caller]
pub fn relative(what: &str, got: f64, expected: f64, tolerance: f64) {
    let error = got / expected - 1.0;
    println!("{what}: {got:.9} against {expected:.9}, relative error {error:.1e} (allowed {tolerance:.0e})");
    assert!(
        error.abs() <= tolerance,
        "{what}: {got} against {expected}, relative error {error:.2e}, allowed {tolerance:.0e}"
    );
}

/// Asserts |got − expected| ≤ tolerance.
#[track_caller]
pub fn absolute(what: &str, got: f64, expected: f64, tolerance: f64) {
    let error = got - expected;
    println!("{what}: {got:.9} against {expected:.9}, error {error:.1e} (allowed {tolerance:.0e})");
    assert!(error.abs() <= tolerance, "{what}: {got} against {expected}, error {error:.2e}, allowed {tolerance:.0e}");
}

/// Uncoated half-space with E* = 1.
pub fn homogeneous() -> HalfSpace {
    HalfSpace::new(vec![], Material::from_young(1.0, 0.0).unwrap())
}

/// A coating bonded to a substrate with E₂ = 1: χ = G₁/G₂, Poisson's ratios, thickness.
#[derive(Debug, Clone, Copy)]
pub struct Coating {
    pub chi: f64,
    pub poisson: [f64; 2],
    pub thickness: f64,
}

impl Coating {
    fn materials(&self) -> [Material; 2] {
        let substrate = Material::from_young(1.0, self.poisson[1]).unwrap();
        [Material::from_shear(self.chi * substrate.shear(), self.poisson[0]).unwrap(), substrate]
    }

    pub fn half_space(&self) -> HalfSpace {
        let [coating, substrate] = self.materials();
        HalfSpace::new(vec![Layer::new(coating, self.thickness, Interface::Bonded).unwrap()], substrate)
    }

    /// E₁* of the coating.
    pub fn modulus(&self) -> f64 {
        self.materials()[0].contact_modulus()
    }

    /// Layer correction T(x), x = qh, from the plane-strain solution of one bonded layer:
    /// T = [1 + 4xκθ − λκθ²]/[1 − (λ + κ + 4κx²)θ + λκθ²], θ = e^{−2x}.
    pub fn correction(&self, x: f64) -> f64 {
        let [nu1, nu2] = self.poisson;
        let lambda = 1.0 - 4.0 * (1.0 - nu1) / (1.0 + self.chi * (3.0 - 4.0 * nu2));
        let kappa = (self.chi - 1.0) / (self.chi + 3.0 - 4.0 * nu1);
        let theta = (-2.0 * x).exp();
        let end = lambda * kappa * theta * theta;
        (1.0 + 4.0 * x * kappa * theta - end) / (1.0 - (lambda + kappa + 4.0 * kappa * x * x) * theta + end)
    }
}

/// One indenter per level on a hexagonal lattice of the given period; `levels` are (shape, height).
pub fn hexagonal(period: f64, levels: &[(Shape, f64)]) -> Surface {
    Surface::Indenters {
        lattice: Lattice::hexagonal(period, levels.len()).unwrap(),
        levels: levels.iter().map(|&(shape, height)| Level::new(shape, height).unwrap()).collect(),
    }
}

/// Load steps of one surface on one half-space.
pub struct Steps {
    pub hierarchy: Hierarchy,
}

impl Steps {
    pub fn new(surface: &Surface, half_space: &HalfSpace, points: [usize; 2]) -> Self {
        Self { hierarchy: Hierarchy::new(surface, half_space, points, Settings::default()).unwrap() }
    }

    /// Observables and pressure of the next step.
    pub fn solve(&mut self, control: Control) -> (Observables, Vec<f64>) {
        let solution = self.hierarchy.solve(control, &mut |_| ());
        assert!(solution.report.stop.solved(), "{control:?}: {}", solution.report);
        println!("{control:?}: {}", solution.report);
        (observe(&self.hierarchy, &solution), solution.pressure)
    }

    pub fn loaded(&mut self, mean_pressure: f64) -> Observables {
        self.solve(Control::MeanPressure(mean_pressure)).0
    }
}
