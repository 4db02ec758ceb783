//! One contact in free space: no periodic images, displacements that vanish far away.
//!
//! `kernel` is the displacement of a sample by another one, an integral over the zone of the grid in two parts, between which
//! `cut` divides: `radial` at small wavenumbers, `filon` at large ones. `operator`: the convolution with it; `padded_window`: the
//! transforms of the kernels on a padded grid, `quadrant` those of kernels that are even or odd.

mod cut;
mod filon;
mod kernel;
mod operator;
mod padded_window;
mod quadrant;
mod radial;

pub use kernel::OfWavenumber;
pub(super) use kernel::Window;
pub use operator::Coupling;
pub(super) use operator::{EVALUATIONS, range as wavenumbers};
pub(super) use padded_window::{bytes_per_sample, bytes_while_made, coupling_multiplier, padded, shear_multiplier};

#[cfg(test)]
mod tests {
    use crate::body::{HalfSpace, Interface, Layer, Material};
    use crate::friction::Friction;
    use crate::lattice::{Cell, Grid};
    use crate::load::Control;
    use crate::spectral::LayeredOperator;
    use crate::spectral::iteration::{AdmissibleSet, ContactProblem, Method, Report, Settings, Unknowns, Working};
    use crate::spectral::operator::ElasticOperator;
    use std::f64::consts::{LN_2, PI};
    use std::ops::ControlFlow;

    /// A sphere x²/2, radius 1, over the middle of a window.
    struct Sphere {
        grid: Grid,
        gap: Vec<f64>,
    }

    impl Sphere {
        fn new(spacing: f64, points: [usize; 2]) -> Self {
            let sides = points.map(|n| spacing * n as f64);
            let grid = Grid::new(Cell::new([sides[0], 0.0], [0.0, sides[1]]).unwrap(), points).unwrap();
            let gap = |k: usize| {
                let [i, j] = [k / points[1], k % points[1]];
                let [x, y] = [(i, 0), (j, 1)].map(|(i, axis)| spacing * (i as f64 - (points[axis] / 2) as f64));
                0.5 * (x * x + y * y)
            };
            Self { gap: (0..grid.len()).map(gap).collect(), grid }
        }

        fn mean(&self, load: f64) -> Control {
            Control::MeanPressure(load / (self.grid.sample_area() * self.grid.len() as f64))
        }

        fn solved(&self, operator: &mut impl ElasticOperator, load: Control, settings: Settings) -> (Report, Unknowns) {
            let mut unknowns = Unknowns::new(self.gap.len());
            let report = ContactProblem {
                working: &mut Working::default(),
                operator,
                initial_gap: &self.gap,
                largest_gap: self.gap.iter().copied().fold(0.0, f64::max),
                admissible: AdmissibleSet::default(),
                load,
                settings,
                outer: 0,
                progress: &mut |_| ControlFlow::Continue(()),
            }
            .solve(&mut unknowns);
            assert!(report.stop.solved(), "{report}");
            (report, unknowns)
        }

        /// Contact radius from the area of the pressed samples, without what its boundary's steps add.
        fn radius(&self, pressure: &[f64]) -> f64 {
            let pressed = |i: usize| pressure[i] > 0.0;
            let samples = (0..pressure.len()).filter(|&i| pressed(i)).count() as f64;
            let edges =
                |i: usize| self.grid.adjacent(i).into_iter().take(2).filter(|&j| pressed(i) != pressed(j)).count();
            let perimeter = (0..pressure.len()).map(edges).sum::<usize>() as f64;
            ((samples - (PI - 1.0 + LN_2) / 24.0 * perimeter) * self.grid.sample_area() / PI).sqrt()
        }
    }

    fn peak(pressure: &[f64]) -> f64 {
        pressure.iter().copied().fold(0.0, f64::max)
    }

    fn rms(errors: impl ExactSizeIterator<Item = f64>) -> f64 {
        let count = errors.len() as f64;
        (errors.map(|error| error * error).sum::<f64>() / count).sqrt()
    }

    fn by(method: Method) -> Settings {
        Settings { method, ..Settings::default() }
    }

    fn bare(grid: &Grid) -> LayeredOperator {
        LayeredOperator::of_kernel(grid, &|_| 2.0, None)
    }

    /// p₀ = 2a/π, δ = a², P = 4a³/3 for E* = 1, with the errors of an independent program at the same radii, to a tenth, by either
    /// method and under load and displacement control. (The penetration exceeds the mean of the gap.)
    #[test]
    fn a_sphere_on_a_bare_half_space_is_hertz() {
        for (method, is_load) in
            [(Method::Preconditioned, true), (Method::PolonskyKeer, true), (Method::Preconditioned, false)]
        {
            let errors = [24.0, 24.2, 24.4, 24.6, 24.8].map(|a| {
                let sphere = Sphere::new(1.0, [63, 64]);
                let load = if is_load { sphere.mean(4.0 / 3.0 * a * a * a) } else { Control::Penetration(a * a) };
                let (_, found) = sphere.solved(&mut bare(&sphere.grid), load, by(method));
                let total: f64 = found.pressure.iter().sum();
                let third = if is_load { found.penetration / (a * a) } else { total / (4.0 / 3.0 * a * a * a) };
                [peak(&found.pressure) / (2.0 * a / PI), third, sphere.radius(&found.pressure) / a].map(|x| x - 1.0)
            });
            let [p, third, a] = [0, 1, 2].map(|kind| rms(errors.iter().map(|errors| errors[kind])));
            // The error of the load is 1.5 times that of δ: P ~ δ^{3/2}.
            assert!(p < 1.1 * 4.5e-5 && third < 1.1 * 1.5 * 2.0e-5 && a < 1.1 * 2.1e-3, "{p:e} {third:e} {a:e}");
        }
    }

    /// An isolated paraboloid of radius 1 on layered bodies, a, P, δ, p₀ by an axisymmetric integral equation that reproduces Hertz
    /// to 1e-10; substrates of E = 1, ν = 0.3. Errors, rms over three spacings, are those of an independent program, to a tenth.
    #[test]
    fn spheres_on_layered_bodies_have_the_load_and_penetration_of_the_integral_equation() {
        let young = |modulus, poisson| Material::from_young(modulus, poisson).unwrap();
        let body = |layers: &[[f64; 3]], substrate| {
            let layer = |&[h, e, nu]: &[f64; 3]| Layer::new(young(e, nu), h, Interface::Bonded).unwrap();
            HalfSpace::new(layers.iter().map(layer).collect(), substrate)
        };
        let substrate = young(1.0, 0.3);
        let counterbody = body(&[], young(1.4, 0.27));
        let rows = [
            (body(&[], substrate), None, [1.0, 1.465201465, 1.0, 0.699582167], [3.8e-5, 1.9e-5]),
            (
                body(&[[0.3, 3.0, 0.22]], substrate),
                None,
                [0.6, 0.5482060482, 0.4691976347, 0.6269412241],
                [5.3e-5, 1.5e-5],
            ),
            (
                body(&[[0.2, 4.0, 0.25], [0.1, 0.5, 0.45]], substrate),
                None,
                [0.5, 0.3025023174, 0.3222496694, 0.4465318074],
                [7.3e-5, 1.5e-5],
            ),
            (
                body(&[[0.25, 0.3, 0.45]], substrate),
                None,
                [0.8, 0.5073880235, 0.5157036901, 0.4367572404],
                [3.3e-5, 2.4e-5],
            ),
            (
                body(&[[0.3, 3.0, 0.22]], substrate),
                Some(&counterbody),
                [0.6, 0.2416299715, 0.4075877403, 0.3043501295],
                [4.2e-5, 1.7e-5],
            ),
        ];
        for (body, counterbody, [a, load, penetration, p0], known) in rows {
            let c = |k: f64| {
                let of_body = |body: &HalfSpace| k * body.response().compliance(k);
                of_body(&body) + counterbody.map_or(0.0, of_body)
            };
            let errors = [24.1, 24.37, 24.71].map(|samples| {
                let sphere = Sphere::new(a / samples, [64, 64]);
                let mut operator = LayeredOperator::of_kernel(&sphere.grid, &c, None);
                let (_, found) = sphere.solved(&mut operator, sphere.mean(load), Settings::default());
                let radius = sphere.radius(&found.pressure);
                [peak(&found.pressure) / p0, found.penetration / penetration, radius / a].map(|x| x - 1.0)
            });
            let [p, delta, radius] = [0, 1, 2].map(|kind| rms(errors.iter().map(|errors| errors[kind])));
            assert!(
                p < 1.1 * known[0] && delta < 1.1 * known[1] && radius < 1.1 * 2.5e-3,
                "{p:e} {delta:e} {radius:e}"
            );
        }
    }

    /// ε is over δ and the load, which do not depend on the window: one tolerance stops at one residual.
    #[test]
    fn the_contact_does_not_depend_on_the_window() {
        let a = 20.3;
        let substrate = Material::from_young(1.0, 0.3).unwrap();
        let soft = Layer::new(Material::from_young(0.3, 0.45).unwrap(), 6.0, Interface::Bonded).unwrap();
        let friction = Friction::new(0.4, [0.6, 0.8]).unwrap();
        let bodies = [HalfSpace::new(vec![], substrate), HalfSpace::new(vec![soft], substrate)];
        for (body, friction, method) in [
            (0, None, Method::Preconditioned),
            (0, None, Method::PolonskyKeer),
            (1, None, Method::Preconditioned),
            (0, Some(friction), Method::Preconditioned),
        ] {
            let body = &bodies[body];
            let found = [[48, 48], [64, 64], [60, 96]].map(|points| {
                let sphere = Sphere::new(1.0, points);
                let mut operator = match &friction {
                    Some(friction) => LayeredOperator::sliding_in_free_space(&sphere.grid, body, friction),
                    None => LayeredOperator::in_free_space(&sphere.grid, body),
                };
                let load = if body.layers().is_empty() { 4.0 / 3.0 * a * a * a } else { 2000.0 };
                let settings = Settings { tolerance: 1e-14, ..by(method) };
                let (_, found) = sphere.solved(&mut operator, sphere.mean(load), settings);
                let inside = (0..45 * 45).map(|k| {
                    let [i, j] = [k / 45, k % 45];
                    found.pressure[(i + points[0] / 2 - 22) * points[1] + j + points[1] / 2 - 22]
                });
                (inside.collect::<Vec<f64>>(), found.penetration)
            });
            let (first, penetration) = &found[0];
            for (other, other_penetration) in &found[1..] {
                let difference = first.iter().zip(other).fold(0.0f64, |most, (a, b)| most.max((a - b).abs()));
                assert!(difference < 1e-11 * peak(first), "{difference:e}");
                assert!((other_penetration / penetration - 1.0).abs() < 1e-13, "{other_penetration} {penetration}");
            }
        }
    }

    /// The periodic C⁻¹ of the window is as good a preconditioner as for the periodic contact in it.
    #[test]
    fn iterations_are_hardly_more_than_for_the_periodic_contact() {
        let stiff = Layer::new(Material::from_young(20.0, 0.3).unwrap(), 3.0, Interface::Bonded).unwrap();
        let substrate = Material::from_young(1.0, 0.3).unwrap();
        for body in [HalfSpace::new(vec![], substrate), HalfSpace::new(vec![stiff], substrate)] {
            for n in [64, 256] {
                let sphere = Sphere::new(64.0 / n as f64, [n, n]);
                let mut free = LayeredOperator::in_free_space(&sphere.grid, &body);
                let mut periodic = LayeredOperator::new(&sphere.grid, &body);
                let (isolated, found) = sphere.solved(&mut free, sphere.mean(8000.0), Settings::default());
                let (images, _) = sphere.solved(&mut periodic, sphere.mean(8000.0), Settings::default());
                assert!(2 * isolated.iterations <= 3 * images.iterations, "{isolated}; {images}");
                // From no pressure, under the penetration of this load, the first active set is twice the contact.
                let (isolated, _) =
                    sphere.solved(&mut free, Control::Penetration(found.penetration), Settings::default());
                assert!(2 * isolated.iterations <= 3 * images.iterations, "{isolated}; {images}");
            }
        }
    }

    /// Both controls meet: the penetration of a load has its pressure.
    #[test]
    fn the_penetration_of_a_load_needs_that_load() {
        let sphere = Sphere::new(1.0, [50, 64]);
        let settings = Settings { tolerance: 1e-11, ..Settings::default() };
        let mut operator = bare(&sphere.grid);
        let (_, first) = sphere.solved(&mut operator, sphere.mean(9000.0), settings);
        let (_, second) = sphere.solved(&mut operator, Control::Penetration(first.penetration), settings);
        let pairs = first.pressure.iter().zip(&*second.pressure);
        let difference = pairs.fold(0.0f64, |most, (a, b)| most.max((a - b).abs()));
        assert!(difference < 1e-8 * peak(&first.pressure), "{difference:e}");
    }

    /// A square punch as large as the window: P = 1.012 · 2E*δ √(A/π), the pressure rising towards its edges; where contact is
    /// complete a uniform pressure is no solution, and any penetration has one.
    #[test]
    fn a_flat_punch_presses_most_at_its_edges() {
        let flat = Sphere { gap: vec![0.0; 40 * 40], ..Sphere::new(1.0, [40, 40]) };
        let stiffness = 1.012 * 2.0 * 40.0 / PI.sqrt();
        for load in [flat.mean(stiffness), Control::Penetration(1.0)] {
            let (_, found) = flat.solved(&mut bare(&flat.grid), load, Settings::default());
            let total: f64 = found.pressure.iter().sum();
            assert!((total / found.penetration / stiffness - 1.0).abs() < 0.02, "{total} {}", found.penetration);
            let [corner, middle] = [0, 20 * 41].map(|k| found.pressure[k]);
            assert!(corner > 4.0 * middle && found.gap.iter().all(|g| g.abs() < 1e-6), "{corner} {middle}");
        }
    }

    /// The energy gap bounds the excess of the energy ½⟨p, Kp⟩ + ⟨p, f⟩ of an unfinished pressure.
    #[test]
    fn the_certificate_bounds_the_energy() {
        let sphere = Sphere::new(1.0, [64, 64]);
        let mut operator = bare(&sphere.grid);
        let mut energies = |tolerance: f64| {
            let settings = Settings { tolerance, ..Settings::default() };
            let (_, found) = sphere.solved(&mut operator, sphere.mean(18000.0), settings);
            let mut w = found.pressure.to_vec();
            operator.displacement(&mut w, &mut crate::spectral::Workspace::default());
            let sum = |field: &[f64]| field.iter().zip(&*found.pressure).map(|(x, p)| x * p).sum::<f64>();
            let elastic = 0.5 * sum(&w);
            (elastic, elastic + sum(&sphere.gap), found.certificate.energy_gap)
        };
        let (_, least, _) = energies(1e-12);
        for tolerance in [1e-1, 1e-2, 1e-4, 1e-6] {
            let (elastic, whole, bound) = energies(tolerance);
            let excess = (whole - least) / elastic;
            assert!(excess <= bound + 1e-15 && bound < 20.0 * tolerance, "{tolerance}: {excess:e}, {bound:e}");
        }
    }

    /// μβ = 0.2: peak 0.99766 of Hertz and the pressure's centroid at −0.0949 a, by a fixed point around a frictionless solver of an
    /// independent program at the same spacing. Any direction is a rotation of it, half turns and quarter turns to rounding.
    #[test]
    fn a_sliding_sphere_leans_backwards() {
        let a = 20.3;
        let sphere = Sphere::new(1.0, [65, 65]);
        let body = HalfSpace::new(vec![], Material::from_shear(0.5, 0.0).unwrap());
        let slid = |friction: Friction| {
            let mut operator = LayeredOperator::sliding_in_free_space(&sphere.grid, &body, &friction);
            let settings = Settings { tolerance: 1e-12, ..Settings::default() };
            let (_, found) = sphere.solved(&mut operator, sphere.mean(4.0 / 3.0 * a * a * a), settings);
            let load: f64 = found.pressure.iter().sum();
            let moment = |axis: usize| {
                let place = |k: usize| [k / 65, k % 65][axis] as f64 - 32.0;
                found.pressure.iter().enumerate().map(|(k, p)| p * place(k)).sum::<f64>() / load / a
            };
            ([moment(0), moment(1)], peak(&found.pressure) / (2.0 * a / PI))
        };
        let friction = |direction| Friction::new(0.4, direction).unwrap();
        let ([x, y], top) = slid(friction([1.0, 0.0]));
        assert!((top - 0.99766).abs() < 5e-5 && (x + 0.0949).abs() < 5e-5 && y.abs() < 1e-10, "{top} {x} {y}");
        for (direction, expected) in [([-1.0, 0.0], [-x, 0.0]), ([0.0, 1.0], [0.0, x]), ([0.0, -1.0], [0.0, -x])] {
            let ([x, y], peak) = slid(friction(direction));
            assert!((x - expected[0]).abs() < 1e-10 && (y - expected[1]).abs() < 1e-10 && (peak - top).abs() < 1e-10);
        }
        let ([u, v], peak) = slid(friction([0.6, 0.8]));
        assert!((0.6 * u + 0.8 * v - x).abs() < 2e-4 && (0.6 * v - 0.8 * u).abs() < 1e-3 && (peak - top).abs() < 2e-4);
        // A traction that displaces much lags behind.
        let ([strong, _], _) = slid(Friction::new(1.0, [1.0, 0.0]).unwrap());
        assert!(strong < 2.0 * x, "{strong}");
        let ([none, _], top) = slid(friction([1.0, 0.0]).uncoupled());
        assert!(none.abs() < 1e-10 && (top - 1.0).abs() < 2e-4, "{none} {top}");
    }
}
