//! Contact stiffness and the sensitivities of the penetration, against closed forms and against loads solved again.

use percoat::{
    Bodies, Cell, HalfSpace, Indenters, Interface, Lattice, Layer, Level, Load, Material, Problem, Settings, Shape,
    Solver, Surroundings,
};

/// A ball of this radius on a coated half-space, its coating as stiff as given: isolated in a window, or in a periodic cell.
fn problem(cell: Cell, radius: f64, coating: f64, substrate: f64) -> Problem {
    let middle = if cell.surroundings() == Surroundings::FreeSpace { [0.5; 2] } else { [0.0; 2] };
    let lattice = Lattice::new(cell, vec![vec![middle]]).unwrap();
    let indenters = Indenters::new(lattice, vec![Level::new(Shape::Paraboloid { radius }, 0.0).unwrap()]).unwrap();
    let material = |young: f64, poisson: f64| Material::from_young(young, poisson).unwrap();
    let layer = Layer::new(material(coating, 0.22), 0.3, Interface::Bonded).unwrap();
    Problem::new(indenters, Bodies::from(HalfSpace::new(vec![layer], material(substrate, 0.3))))
}

/// ∂/∂ln θ by five points, with an error of the fourth power of their distance.
fn quotient(of: impl Fn(f64) -> Problem) -> Vec<(f64, Problem)> {
    let h = 0.02f64;
    let points = [(-2.0, 1.0 / 12.0), (-1.0, -2.0 / 3.0), (1.0, 2.0 / 3.0), (2.0, -1.0 / 12.0)];
    points.into_iter().map(|(k, weight)| (weight / h, of((k * h).exp()))).collect()
}

fn solver(problem: Problem, points: usize) -> Solver {
    let settings = Settings { tolerance: 1e-12, ..Settings::default() };
    Solver::new(problem, [points; 2], settings).unwrap()
}

/// Hertz: δ³ = 9P²/(16RE*²), S = 3P/2δ, ∂δ/∂ln E* = −⅔δ, ∂δ/∂ln R = −⅓δ. Eight samples at a time join a contact of N:
/// stiffness and sensitivities of the discrete contact step by up to 8/N.
#[test]
fn a_hertz_contact_has_its_stiffness_and_sensitivities() {
    let of = |radius: f64, young: f64| problem(Cell::window([1.0; 2]).unwrap(), radius, young, young);
    // A coating of the substrate's material, but for its Poisson's ratio, would not be one: both are 0.3 here.
    let alike = |radius: f64, young: f64| {
        let material = Material::from_young(young, 0.3).unwrap();
        let layer = Layer::new(material, 0.3, Interface::Bonded).unwrap();
        Problem::new(of(radius, young).loaded_by().clone(), HalfSpace::new(vec![layer], material))
    };
    let mut solver = solver(alike(1.0, 1.0), 96);
    for load in [0.01, 0.03, 0.05] {
        let step = solver.solve(Load::Force(load));
        let (tangent, delta) = (solver.tangent().unwrap(), step.penetration());
        let samples = step.pressure().iter().filter(|p| **p > 0.0).count() as f64;
        let stepping = 8.0 / samples;
        let stiffness = 1.5 * load / delta;
        assert!((tangent.stiffness() / stiffness - 1.0).abs() < stepping + 1e-3, "{load}: {tangent}, {stiffness}");
        let derivative = |of: &dyn Fn(f64) -> Problem| {
            let problems = quotient(of);
            let all: Vec<(f64, &Problem)> = problems.iter().map(|(weight, problem)| (*weight, problem)).collect();
            tangent.penetration(step.finest(), &all) / delta
        };
        let (by_modulus, by_radius) = (derivative(&|t| alike(1.0, t)), derivative(&|t| alike(t, 1.0)));
        assert!((by_modulus + 2.0 / 3.0).abs() < stepping, "{load}: {by_modulus}");
        assert!((by_radius + 1.0 / 3.0).abs() < stepping, "{load}: {by_radius}");
    }
}

/// On a coating, isolated and periodic: the sensitivity is the change of the penetration that solving again finds, to the steps
/// of the discrete contact, which twelve samples join at a time on a hexagonal cell. That by all moduli together is −P/S, exactly.
#[test]
fn sensitivities_are_those_of_loads_solved_again() {
    for cell in [Cell::window([1.0; 2]).unwrap(), Cell::hexagonal(1.2).unwrap()] {
        let of = |t: [f64; 2]| problem(cell, 1.0, 3.0 * t[0], t[1]);
        let load = Load::Force(0.08);
        let mut base = solver(of([1.0; 2]), 96);
        let step = base.solve(load);
        let tangent = base.tangent().unwrap();
        let samples = step.pressure().iter().filter(|p| **p > 0.0).count() as f64;
        let stepping = if cell.is_rectangular() { 8.0 } else { 12.0 } / samples;
        let solved = |t: [f64; 2]| solver(of(t), 96).solve(load).penetration();
        let kinds: [fn(f64) -> [f64; 2]; 2] = [|t| [t, 1.0], |t| [1.0, t]];
        for kind in kinds {
            let problems = quotient(|t| of(kind(t)));
            let all: Vec<(f64, &Problem)> = problems.iter().map(|(weight, problem)| (*weight, problem)).collect();
            let found = tangent.penetration(step.finest(), &all);
            let h = 0.02f64;
            let again = (solved(kind(h.exp())) - solved(kind((-h).exp()))) / (2.0 * h);
            assert!((found / again - 1.0).abs() < stepping, "{cell}: {found}, {again}");
        }
        let all = quotient(|t| of([t; 2]));
        let all: Vec<(f64, &Problem)> = all.iter().map(|(weight, problem)| (*weight, problem)).collect();
        let found = tangent.penetration(step.finest(), &all) * tangent.stiffness();
        assert!((found / 0.08 + 1.0).abs() < 1e-7, "{cell}: {found}");
        let (above, below) = (base.solve(Load::Force(0.0816)), base.solve(Load::Force(0.0784)));
        let secant = 0.0032 / (above.penetration() - below.penetration());
        assert!((tangent.stiffness() / secant - 1.0).abs() < stepping, "{cell}: {tangent}, {secant}");
    }
}
