//! Fig. 5: contact radius, largest pressure and largest principal shear stress of the first level against load.

use super::against::CHANGE;
use super::model::Model;
use super::{Claim, Test, pinned};
use crate::draw::{curve, figure, linear};
use crate::{Check, Data, Outcome, Study, StudyError, Tolerance};
use percoat_app::picture::{Axis, Chart, Figure, Style};
use percoat_core::body::MeanStress;
use percoat_core::load::Load;
use percoat_core::run::{Recorder, Run, Sampling, StepRecord};
use percoat_core::spectral::Step;
use percoat_core::stress::{StressField, StressFields};
use std::convert::Infallible;
use std::sync::Arc;

pub const STUDY: Study = Study {
    name: "paper/fig5",
    title: "Fig. 5: contact radius and stresses against load",
    files: &["curves.csv", "figure.png", "methods.csv", "shear.csv"],
    run,
    quick: None,
};

const POINTS: usize = 192;
const LOADS: [f64; 2] = [0.0025, 0.1];
const COUNT: usize = 25;
/// Every so many loads the stresses are searched.
const STRESSES: usize = 4;
const ONE_LEVEL: [&str; 2] =
    ["lattice.period=1.7320508075688772", "levels=[{ shape = \"paraboloid\", radius = 1.67 }]"];
/// First touches of levels 2 and 3 on 1024 points (192 points give the same).
const TOUCHES: [f64; 2] = [0.0179, 0.0759];

/// One model's first level over all loads.
struct Course {
    radius: Vec<f64>,
    peak: Vec<f64>,
    /// τ₁ in the coating and its depth over h, at every so many loads.
    shear: Vec<[f64; 3]>,
}

/// Searches τ₁ in the coating at every so many load steps, and keeps it with its depth.
#[derive(Default)]
struct Search {
    steps: usize,
    found: Vec<[f64; 2]>,
}

impl Recorder for Search {
    type Error = Infallible;

    fn step(&mut self, step: &Step, record: &StepRecord, _: Option<&StressFields>) -> Result<(), Infallible> {
        if let (0, Some(radius)) = (self.steps % STRESSES, record.reading.levels[0].contact_radius) {
            let field = StressField::new(step.finest(), MeanStress::Confined);
            let peak = field.maxima([radius, radius]).materials[0].tau1;
            self.found.push([peak.value, peak.position[2]]);
        }
        self.steps += 1;
        Ok(())
    }
}

impl Course {
    fn new(model: &Model, loads: &[f64], stresses: bool) -> Result<Self, StudyError> {
        let steps = loads.iter().map(|&load| Load::MeanPressure(load)).collect();
        let run = Run::new(Arc::clone(model.case().problem()), steps, Sampling::Points([POINTS; 2]));
        let mut search = Search::default();
        let outcome = if stresses { run.solve(&mut search)? } else { run.solve(&mut ())? };
        if !outcome.converged() {
            return Err("a load step has not converged".into());
        }
        let first = || outcome.steps.iter().map(|step| &step.reading.levels[0]);
        let radius: Option<Vec<f64>> = first().map(|level| level.contact_radius).collect();
        let shear = loads.iter().step_by(STRESSES).zip(search.found);
        Ok(Self {
            radius: radius.ok_or("merged contacts")?,
            peak: first().map(|level| level.max_pressure).collect(),
            shear: shear.map(|(&load, [tau1, z])| [load, tau1, z / model.thickness()]).collect(),
        })
    }
}

fn run() -> Result<Outcome, StudyError> {
    let model = Model::new("fig5", &[])?;
    let loads = linear(LOADS[0], LOADS[1], COUNT);
    let sparse = Model::new("fig5", &ONE_LEVEL)?;
    let (three, one) = rayon::join(|| Course::new(&model, &loads, true), || Course::new(&sparse, &loads, false));
    let (three, one) = (three?, one?);
    let mut outcome = Outcome::default();
    super::against::first_touches(&mut outcome, &model, TOUCHES)?;
    outcome.checks = outcome.checks.into_iter().map(Check::of_refinement).collect();
    let last = COUNT - 1;
    let finer = model.steps(2 * POINTS)?.loaded(loads[last])?;
    let mesh = [
        (three.peak[last], finer.levels[0].max_pressure),
        (three.radius[last], finer.levels[0].contact_radius.unwrap_or(f64::NAN)),
    ];
    let name = "peak and radius at p̄′ = 0.1, N = 192 against 384";
    outcome.checks.push(Check::worst(name, mesh, Tolerance::Relative(2e-3)).of_refinement());
    outcome.judge(claims(&loads, &three, &one));
    outcome.figures = vec![("figure", picture(&loads, &three, &one))];
    let mut curves = Data::new("curves", &["mean_pressure", "radius_three", "radius_one", "peak_three", "peak_one"]);
    curves.rows =
        (0..COUNT).map(|i| vec![loads[i], three.radius[i], one.radius[i], three.peak[i], one.peak[i]]).collect();
    let mut shear = Data::new("shear", &["mean_pressure", "tau1", "depth_over_h"]);
    shear.rows = three.shear.iter().map(|row| row.to_vec()).collect();
    outcome.published = vec![model.methods("methods", LOADS[1], POINTS)?, curves, shear];
    Ok(outcome)
}

fn claims(loads: &[f64], three: &Course, one: &Course) -> [Claim; 4] {
    let least_rise =
        |values: &[f64]| values.windows(2).map(|pair| pair[1] / pair[0] - 1.0).fold(f64::INFINITY, f64::min);
    let change = |i: usize| {
        let [a, p] = [three.radius[i] / one.radius[i] - 1.0, three.peak[i] / one.peak[i] - 1.0];
        [a.abs(), p.abs()]
    };
    let early = (0..loads.len()).filter(|&i| loads[i] < TOUCHES[0]).flat_map(change).fold(0.0, f64::max);
    let late = change(loads.len() - 1);
    let depths = three.shear.iter().map(|row| row[2]);
    let off_interface = depths.map(|depth| (depth - 1.0).abs()).fold(0.0, f64::max);
    [
        Claim::new(
            "§3, Fig. 5",
            "the radius of contact spot and maximal contact pressure increases with increasing the nominal pressure",
            "increase",
            pinned(
                [
                    Test::above("least rise of a from load to load, relative", least_rise(&three.radius), 0.0),
                    Test::above("of p₁", least_rise(&three.peak), 0.0),
                ],
                [0.0094, 0.0164],
                // A radius is good to 1e-3.
                [2e-3, CHANGE],
            ),
        ),
        Claim::new(
            "§3, Fig. 5",
            "No difference exists between the curves 1 and 2 for small values of average pressure",
            "no difference",
            // One problem on two cells: what the solver's tolerance leaves.
            vec![Test::below("largest relative difference before level 2 touches", early, 1e-3).pinned(0.0, 1e-6)],
        ),
        Claim::new(
            "§3, Fig. 5b",
            "The maximum [of τ₁] is localized at the layer-substrate interface",
            "at the interface",
            vec![
                Test::below(
                    "largest distance of the maximum in the coating from it over h, all loads",
                    off_interface,
                    0.02,
                )
                .pinned(0.0, 1e-9),
            ],
        ),
        Claim::new(
            "§4",
            "pressure distribution and the real contact area strongly depend on the contact density and height",
            "strong dependence",
            pinned(
                [
                    Test::above("change of p₁ from one to three levels at p̄′ = 0.1", late[1], 0.05),
                    Test::above(
                        "of the area under level 1",
                        1.0 - (three.radius[loads.len() - 1] / one.radius[loads.len() - 1]).powi(2),
                        0.05,
                    ),
                ],
                [0.0580, 0.1727],
                [CHANGE, 4e-3],
            ),
        ),
    ]
}

fn picture(loads: &[f64], three: &Course, one: &Course) -> Figure {
    let line =
        |values: &[f64]| loads.iter().copied().zip(values.iter().copied()).map(<[f64; 2]>::from).collect::<Vec<_>>();
    let panel = |title: &str, y: &str, curves| Chart {
        title: title.to_owned(),
        x: Axis::linear("p̄/E₂"),
        y: Axis::linear(y),
        curves,
    };
    let radius = vec![
        curve("1: three levels", Style::Line, 1, line(&three.radius)),
        curve("2: one level of period √3 l", Style::Dashed, 2, line(&one.radius)),
    ];
    let stress = vec![
        curve("1: p₁, three levels", Style::Line, 1, line(&three.peak)),
        curve("2: p₁, one level", Style::Dashed, 2, line(&one.peak)),
        curve("3: τ₁ in the coating", Style::Line, 3, three.shear.iter().map(|row| [row[0], row[1]])),
    ];
    let caption =
        "Fig. 5 with the parameters as printed: χ = 3, h/l = 0.087, steps 0.06, r′ = 1.67, 1.25, 0.83; first level.";
    figure(vec![panel("(a)", "a/l", radius), panel("(b)", "p₁/E₂, τ₁/E₂", stress)], caption)
}
