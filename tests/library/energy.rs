//! The elastic energy ½∫ p w of a cell, against closed forms and the work ∫ P dδ of the load path.

use crate::common;

use common::{PAPER, bare, one_level, paraboloid};
use ndarray::Array2;
use percoat::counterbody::roughness::{Rms, SelfAffine};
use percoat::{Cell, Friction, Lattice, Load, Problem, Settings, Solver, Topography};
use std::f64::consts::{PI, TAU};

const SHARP: Settings = Settings { tolerance: 1e-10, method: percoat::Method::Preconditioned, max_iterations: 10_000 };

/// ∫ P dδ with P = 4E*a³/3R, δ = a²/R − cP: neighbours lower the mean plane of a small contact by c P, c = 3.900265/(πE*l) on a
/// square lattice (the sum over it of 1/r, less its mean). Next they press it flatter: two contacts at R interact by
/// P²/(πE*) ⟨d²⟩/4R³ more than point loads do, ⟨d²⟩ = 2 · 2a²/5, all neighbours of one by ΔE = S₃ P²a²/(10πE*), S₃ = Σ R⁻³ =
/// 9.033622; with ΔE ~ P^{8/3}, P dΔE/dP − ΔE = 5/3 ΔE of it is stored. What is left is of the order (a/l)⁵, and the grid's
/// 0.3 n⁻² with n samples along the radius.
#[test]
fn low_density_recovers_hertz() {
    let modulus = 1.0 / 0.91;
    let lattice = Lattice::square(1.0, 1).unwrap();
    let problem = Problem::new(one_level(lattice, paraboloid(1.0, 0.0)), bare());
    for (radius, points) in [(0.05, 256), (0.1, 256), (0.1, 512)] {
        let force = 4.0 / 3.0 * modulus * radius * radius * radius;
        let step = Solver::new(problem.clone(), [points; 2], SHARP).unwrap().solve(Load::MeanPressure(force));
        let c = 3.900_264_920 / (PI * modulus);
        let flatter = 9.033_621_683 * (force * radius).powi(2) / (10.0 * PI * modulus);
        let exact = 8.0 / 15.0 * modulus * radius.powi(5) - 0.5 * c * force * force + 5.0 / 3.0 * flatter;
        let found = step.reading();
        let off = found.elastic_energy / exact - 1.0;
        println!("a = {radius}: {:e} for {exact:e}: {off:+.1e}", found.elastic_energy);
        let samples = radius * points as f64;
        assert!(off.abs() < 0.3 * samples.powi(-2) + 10.0 * radius.powi(5), "{radius}: {off:e}");
        assert!(found.errors.elastic_energy.unwrap() < 0.02 * exact);
    }
}

/// A wave of amplitude h pressed flat: p = ½E*q h cos qx, w = h cos qx, ½⟨pw⟩ = E*q h²/8, and a uniform pressure adds nothing.
#[test]
fn a_sine_pressed_flat_has_its_closed_form() {
    let (modulus, height, n) = (1.0 / 0.91, 0.01, 48);
    let cell = Cell::new([2.0, 0.0], [0.0, 0.5]).unwrap();
    let wave = |(i, _): (usize, usize)| height * (TAU * (i as f64 / n as f64 + 0.013)).cos();
    let topography = Topography::new(cell, Array2::from_shape_fn([n, 12], wave)).unwrap();
    let mut solver = Solver::new(Problem::new(topography, bare()), [n, 12], SHARP).unwrap();
    let q = TAU / 2.0;
    let exact = modulus * q * height * height / 8.0 * cell.area();
    let full = 0.5 * modulus * q * height;
    for pressure in [1.01 * full, 40.0 * full] {
        let found = solver.solve(Load::MeanPressure(pressure)).elastic_energy();
        assert!((found / exact - 1.0).abs() < 1e-8, "{pressure}: {found:e} {exact:e}");
    }
}

/// Simpson's rule over the penetration, indenters under a coating, rough surfaces, and sliding without coupling; with δ from the
/// mean plane nothing else stores or takes energy.
#[test]
fn the_elastic_energy_is_the_work_of_the_load_path() {
    let cell = Cell::square(1.0).unwrap();
    let surface = SelfAffine { hurst: 0.8, longest: 1.0, rolloff: 0.5, shortest: 0.125, rms: Rms::Slope(0.1), seed: 4 };
    let rough = Topography::new(cell, surface.heights(cell, [64; 2]).unwrap()).unwrap();
    let sliding = Friction::new(0.4, [1.0, 0.3]).unwrap().uncoupled();
    for (name, problem) in [
        ("three levels", PAPER[0].problem()),
        ("uncoupled", PAPER[1].problem().sliding(sliding).unwrap()),
        ("rough", Problem::new(rough, bare())),
    ] {
        let mut solver = Solver::new(problem, [64; 2], SHARP).unwrap();
        let area = solver.grid().cell().area();
        let (from, to, steps) = (0.25 * solver.full_contact_penetration(), 0.6 * solver.full_contact_penetration(), 24);
        let h = (to - from) / f64::from(steps);
        let path: Vec<[f64; 2]> = (0..=steps)
            .map(|k| {
                let step = solver.solve(Load::Penetration(from + h * f64::from(k)));
                assert!(step.report.stop.solved(), "{name}: {}", step.report);
                [step.pressure().mean().unwrap() * area, step.elastic_energy()]
            })
            .collect();
        let weight = |k: usize| if k == 0 || k == path.len() - 1 { 1.0 } else { [2.0, 4.0][k % 2] };
        let work: f64 = path.iter().enumerate().map(|(k, [force, _])| weight(k) * force * h / 3.0).sum();
        let stored = path[path.len() - 1][1] - path[0][1];
        println!("{name}: {stored:e} for {work:e}: {:+.1e}", stored / work - 1.0);
        assert!((stored / work - 1.0).abs() < 1e-4, "{name}: {stored:e} {work:e}");
    }
}
