//! How much work a solution takes, which is the same on any machine: iterations, and convolutions on all grids as
//! equivalents of the finest one, a convolution in single precision counted half; of stresses the planes that are transformed,
//! and the points around which all waves are summed.

#[path = "../../benches/shared/mod.rs"]
mod shared;

use percoat::{Friction, Load, MeanStress, Problem, Route, Step, StressFields, StressReading};
use shared::{ONE_LEVEL, ROUGH, Rough, THREE_LEVELS, one_level, rough, solver, three_levels};

fn solved(problem: Problem, points: usize, load: Load) -> Step {
    solver(problem, points).solve(load)
}

fn takes(step: &Step, iterations: usize, convolutions: f64) {
    let told = format!("{}; {:.1} convolutions on {}", step.report, step.convolutions, step.grid());
    println!("{told}");
    assert!(step.report.stop.solved() && step.report.route == Route::Direct, "{told}");
    assert!(step.report.iterations <= iterations && step.convolutions <= convolutions, "{told}");
}

#[test]
fn smooth_contacts_take_the_fewer_iterations_the_finer_the_grid() {
    for (points, iterations, convolutions) in [(256, 8, 16.0), (512, 6, 13.0)] {
        takes(&solved(one_level(), points, ONE_LEVEL), iterations, convolutions);
        takes(&solved(three_levels(), points, THREE_LEVELS), iterations, convolutions);
    }
}

#[test]
fn rough_contacts_take_a_dozen_on_any_grid() {
    for points in [256, 512] {
        takes(&solved(rough(Rough::band(), points), points, ROUGH), 14, 26.0);
    }
}

#[test]
fn surfaces_rough_down_to_the_grid_take_a_few_more() {
    for (points, iterations) in [(256, 14), (512, 18)] {
        takes(&solved(rough(Rough::down_to_grid(points), points), points, ROUGH), iterations, 36.0);
    }
}

/// A load path: each step starts from the one before, and asks no more than a first one.
#[test]
fn a_step_of_a_load_path_asks_no_more_than_a_first_one() {
    let mut solver = solver(three_levels(), 256);
    for part in 1..=5 {
        let load = Load::MeanPressure(0.2 * f64::from(part) * THREE_LEVELS.value());
        takes(&solver.solve(load), 8, 16.0);
    }
}

/// Largest stresses of all materials with their errors; a plane is one component. Bounds are a quarter above what was counted.
#[test]
fn largest_stresses_take_few_planes_and_points() {
    let sliding = || three_levels().sliding(Friction::new(0.3, [1.0, 0.0]).unwrap().uncoupled()).unwrap();
    let cases = [
        ("one level", one_level(), ONE_LEVEL, [138, 34]),
        ("three levels", three_levels(), THREE_LEVELS, [303, 73]),
        ("sliding", sliding(), THREE_LEVELS, [303, 87]),
        ("rough", rough(Rough::band(), 256), ROUGH, [138, 48]),
    ];
    for (name, problem, load, [planes, expansions]) in cases {
        let step = solved(problem, 256, load);
        let fields = StressFields::new(step.finest(), MeanStress::default());
        StressReading::of(&step, &step.reading(), &fields);
        let work = fields.work();
        println!("{name}: {work}");
        assert!(work.planes <= planes && work.expansions <= expansions, "{name}: {work}");
    }
}
