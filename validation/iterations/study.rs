//! Iterations and convolutions of the default method and of the baseline against the number of points, on the cases of
//! the paper's figures and on stiff plates.

use super::draw::{self, curve};
use super::{Check, Data, Outcome, Study, StudyError, Tolerance};
use percoat_app::picture::{Axis, Chart, Figure, Style};
use percoat_case::case::{Case, embedded};
use percoat_core::body::{HalfSpace, Interface, Layer, Material};
use percoat_core::counterbody::{Indenters, Level, Shape};
use percoat_core::lattice::Lattice;
use percoat_core::load::Load;
use percoat_core::problem::Problem;
use percoat_core::spectral::{Method, Route, Settings, Solver, Step};
use std::sync::Arc;

pub const STUDY: Study = Study {
    name: "iterations",
    title: "Iterations against the number of points",
    files: &["figure.png", "plates.data.csv", "polonsky-keer.data.csv", "preconditioned.data.csv"],
    run: || run(&SIZES),
    quick: Some(|| run(&SIZES[..3])),
};

/// Figures of Goryacheva & Torskaya (2019), each at one load p̄/E₂.
const CASES: [(&str, f64); 5] = [("fig2", 0.06), ("fig3a", 0.008), ("fig3b", 0.008), ("fig4", 0.01), ("fig5", 0.08)];
const SIZES: [usize; 4] = [128, 256, 512, 1024];

fn run(sizes: &[usize]) -> Result<Outcome, StudyError> {
    // The baseline takes too long on the finest grid.
    let [preconditioned, baseline] = [(Method::Preconditioned, sizes), (Method::PolonskyKeer, &SIZES[..3])]
        .map(|(method, sizes)| table(method, sizes));
    let [mut preconditioned, mut baseline] = [preconditioned?, baseline?];
    (preconditioned.name, baseline.name) = ("preconditioned", "polonsky-keer");
    let (mut most, mut growth, mut saving) = (Vec::new(), Vec::new(), Vec::new());
    for (name, _) in CASES {
        let iterations = preconditioned.column(name);
        most.extend(iterations.iter().map(|&iterations| (iterations, 20.0)));
        growth.extend(
            iterations[2..].iter().map(|iterations| (iterations / iterations_at_256(&preconditioned, name), 1.3)),
        );
        let work = |data: &Data| data.column(&format!("{name} convolutions"))[2];
        saving.push((work(&baseline) / work(&preconditioned), 2.0));
    }
    let plates = plates()?;
    let ratios: Vec<(f64, f64)> = plates.rows.iter().map(|row| (row[4] / row[3], 1.0)).collect();
    let checks = vec![
        Check::worst("preconditioned: iterations, 5 cases, N = 128 to 1024", most, Tolerance::AtMost),
        Check::worst("preconditioned: iterations over those at N = 256, finer grids", growth, Tolerance::AtMost),
        Check::worst("convolutions of Polonsky–Keer over preconditioned, N = 512", saving, Tolerance::AtLeast),
        Check::worst("the same on plates, E₁/E₂ = 1000, N = 144 and 288", ratios, Tolerance::AtLeast),
    ];
    let figures = vec![("figure", figure(&preconditioned, &baseline))];
    Ok(Outcome { checks, figures, data: vec![preconditioned, baseline, plates], ..Outcome::default() })
}

fn iterations_at_256(data: &Data, name: &str) -> f64 {
    data.column(name)[1]
}

/// Iterations on the finest grid and convolutions on all, a row a size.
fn table(method: Method, sizes: &[usize]) -> Result<Data, StudyError> {
    let names: Vec<String> = CASES.iter().map(|(name, _)| (*name).to_owned()).collect();
    let work = names.iter().map(|name| format!("{name} convolutions"));
    let columns = ["points".to_owned()].into_iter().chain(names.iter().cloned()).chain(work).collect();
    let mut data = Data { name: "iterations", columns, rows: Vec::new() };
    for &points in sizes {
        let (mut iterations, mut convolutions) = (Vec::new(), Vec::new());
        for (name, mean_pressure) in CASES {
            let source = embedded::source(name).ok_or("no such case")?;
            let case = Case::read(&source, &[]).map_err(|error| error.render(false))?;
            let settings = Settings { method, ..Settings::default() };
            let mut solver = Solver::new(Arc::clone(case.problem()), [points; 2], settings)?;
            let step = solver.solve(Load::MeanPressure(mean_pressure));
            if !step.report.stop.solved() || step.report.route == Route::BaselineAfterStall {
                return Err(format!("{name} at N = {points}: {}", step.report).into());
            }
            iterations.push(step.report.iterations as f64);
            convolutions.push(step.convolutions);
        }
        data.rows.push([vec![points as f64], iterations, convolutions].concat());
    }
    Ok(data)
}

/// Both methods on bonded plates of thickness h, E₁/E₂ = 1000, under hexagonal paraboloids, R = 0.8 l, p̄/E₂ = 0.06.
fn plates() -> Result<Data, StudyError> {
    let mut data =
        Data::new("plates", &["points", "thickness", "iterations", "convolutions", "polonsky-keer convolutions"]);
    let substrate = Material::from_young(1.0, 0.3)?;
    let level = Level::new(Shape::Paraboloid { radius: 0.8 }, 0.0)?;
    let indenters = Indenters::new(Lattice::hexagonal(1.0, 1)?, vec![level])?;
    for (points, thickness) in [(144, 0.001), (144, 0.01), (288, 0.001)] {
        let coating = Layer::new(Material::from_young(1000.0, 0.3)?, thickness, Interface::Bonded)?;
        let problem = Arc::new(Problem::new(indenters.clone(), HalfSpace::new(vec![coating], substrate)));
        let solved = |method| -> Result<Step, StudyError> {
            let settings = Settings { method, ..Settings::default() };
            let step = Solver::new(Arc::clone(&problem), [points; 2], settings)?.solve(Load::MeanPressure(0.06));
            if step.report.stop.solved() && step.report.route != Route::BaselineAfterStall {
                Ok(step)
            } else {
                Err(format!("plate of {thickness} at N = {points}: {}", step.report).into())
            }
        };
        let (preconditioned, baseline) = (solved(Method::Preconditioned)?, solved(Method::PolonskyKeer)?);
        let iterations = preconditioned.report.iterations as f64;
        data.rows.push(vec![points as f64, thickness, iterations, preconditioned.convolutions, baseline.convolutions]);
    }
    Ok(data)
}

fn figure(preconditioned: &Data, baseline: &Data) -> Figure {
    let mut curves = Vec::new();
    for (data, style) in [(preconditioned, Style::LineMarkers), (baseline, Style::Markers)] {
        for ((name, _), colour) in CASES.into_iter().zip(1..) {
            let label = match style {
                Style::LineMarkers => name,
                _ if colour == 1 => "Polonsky–Keer (open)",
                _ => "",
            };
            let points = data.column("points").into_iter().zip(data.column(name)).map(|(x, y)| [x, y]);
            curves.push(curve(label, style, colour, points));
        }
    }
    let chart = Chart {
        title: String::new(),
        x: Axis::log("points along the cell N").from_to(100.0, 2000.0),
        y: Axis::log("iterations on the finest grid").from_to(2.0, 300.0),
        curves,
    };
    draw::figure(
        vec![chart],
        "Iterations to the tolerance 1e-8 on the cases of the paper: preconditioned (filled) and Polonsky–Keer (open).",
    )
}
