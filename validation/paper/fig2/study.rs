//! Fig. 2: pressure and contact spot of the third level on a relatively hard coating.

use super::against::{ASYMMETRY, CHANGE};
use super::model::Model;
use super::spot::{self, asymmetries};
use super::{Claim, Test, asymmetry, pinned};
use crate::draw::{curve, figure};
use crate::{Check, Data, Outcome, Study, StudyError, Tolerance};
use percoat_app::picture::{Axis, Chart, Figure, Style};
use percoat_core::comparison::Answer;
use percoat_core::load::Load;
use percoat_core::reading::{Boundary, Reading};
use std::f64::consts::PI;

pub const STUDY: Study = Study {
    name: "paper/fig2",
    title: "Fig. 2: pressure and contact spot of the third level, hard coating",
    files: &["figure.png", "methods.csv", "outline.csv", "pressure.csv"],
    run,
    quick: None,
};

const LOAD: f64 = 0.06;
/// Shortly before the second level touches.
const EARLY: f64 = 0.0009;
const POINTS: usize = 384;
/// An independent periodic solver on 756 points along three periods: peaks, load shares, w_a; first touches.
const PEAKS: [f64; 3] = [0.42169, 0.39448, 0.36528];
const SHARES: [f64; 3] = [0.41085, 0.33067, 0.25848];
const PENETRATION: f64 = 0.055395;
const TOUCHES: [f64; 2] = [0.00094, 0.00365];
/// Peaks and w_a without mutual effect, by an independent integral equation.
const APART: [f64; 3] = [0.3964, 0.3791, 0.3607];
const APART_PENETRATION: f64 = 0.10462;
/// Points of an outline.
const OUTLINE: usize = 361;

/// Results that the claims and the figure rest on.
struct Found {
    early: Reading,
    late: Reading,
    apart: Answer,
    /// Peak over that of an isolated indenter under the same force, minus 1: level 1 early, level 3 late.
    excess: [f64; 2],
    /// Asymmetries with rows of one level each.
    rows: [f64; 3],
    /// (p₃)max at p̄′ = 0.006, and at 0.008 over E₁.
    misprints: [f64; 2],
    outline: Boundary,
    profile: Vec<[f64; 2]>,
}

fn run() -> Result<Outcome, StudyError> {
    let model = Model::new("fig2", &[])?;
    let found = measure(&model)?;
    let mut outcome = Outcome::default();
    super::against::independent_solver(&mut outcome, &found.late, PEAKS, SHARES, PENETRATION);
    super::against::first_touches(&mut outcome, &model, TOUCHES)?;
    super::against::isolated_law(&mut outcome, &found.apart, APART, APART_PENETRATION);
    let coarser = model.steps(2 * POINTS / 3)?.loaded(LOAD)?;
    let peaks = coarser.levels.iter().zip(&found.late.levels).map(|(a, b)| (a.max_pressure, b.max_pressure));
    outcome.checks.push(Check::worst("peaks, N = 256 against 384", peaks, Tolerance::Relative(1e-3)).of_refinement());
    outcome.judge(claims(&found));
    let outlines = outlines(&found)?;
    outcome.figures = vec![("figure", picture(&found, &outlines))];
    let mut profile = Data::new("pressure", &["x", "p3"]);
    profile.rows = found.profile.iter().map(|row| row.to_vec()).collect();
    outcome.published = vec![model.methods("methods", LOAD, POINTS)?, profile, outlines];
    Ok(outcome)
}

fn measure(model: &Model) -> Result<Found, StudyError> {
    let (law, levels) = (model.law()?, model.indenters()?);
    let mut steps = model.steps(POINTS)?;
    let early = steps.loaded(EARLY)?;
    let peak_at_6 = steps.loaded(0.006)?.levels[2].max_pressure;
    let peak_at_8 = steps.loaded(0.008)?.levels[2].max_pressure;
    let (step, late) = steps.solve(Load::MeanPressure(LOAD))?;
    let excess = |m: usize, found: &Reading| {
        let level = &found.levels[m];
        level.max_pressure / law.loaded(levels[m].curvature, level.load).max_pressure - 1.0
    };
    Ok(Found {
        excess: [excess(0, &early), excess(2, &late)],
        rows: asymmetries(&Model::new("fig2", &asymmetry::ROWS)?.steps_as_dense(POINTS)?.loaded(LOAD)?),
        misprints: [peak_at_6, peak_at_8 / model.coating_young()],
        outline: spot::boundary(&step, 3)?,
        profile: spot::pressure_profile(&step, 3, spot::TOWARD_NEIGHBOUR),
        apart: model.apart(LOAD)?,
        early,
        late,
    })
}

fn claims(found: &Found) -> [Claim; 7] {
    let spots = asymmetries(&found.late);
    let [early, late] = found.excess;
    let radius = found.late.levels[2].contact_radius.unwrap_or(f64::NAN);
    let without = found.apart.levels[2].contact_radius.unwrap_or(f64::NAN);
    let above_others = |spots: [f64; 3]| {
        [
            Test::above("asymmetry of level 3", spots[2], 0.01),
            Test::above("over that of level 2", spots[2] / spots[1], 1.0),
            Test::above("over that of level 1", spots[2] / spots[0], 1.0),
        ]
    };
    let peak = |value: f64| Test::printed("(p₃)max", value, 0.07, 0.01);
    [
        Claim::new(
            "§3, Fig. 2",
            "mutual effect for the first level was negligible",
            "level 1 alone",
            vec![
                Test::below("peak at p̄′ = 0.0009 above that of the same force alone, relative", early, 0.01)
                    .pinned(0.00052, CHANGE),
            ],
        ),
        Claim::new(
            "§3, Fig. 2",
            "the pressure under each indenter was axisymmetric",
            "level 1 alone",
            vec![
                Test::below("asymmetry of level 1 at p̄′ = 0.0009", asymmetries(&found.early)[0], 0.01)
                    .pinned(0.0, ASYMMETRY),
            ],
        ),
        Claim::new(
            "§3, Fig. 2",
            "For relatively large average pressure three levels are in contact",
            "three levels",
            vec![Test::above("load share of level 3 at p̄′ = 0.06", found.late.levels[2].load_share, 0.0)],
        ),
        Claim::new(
            "§3, Fig. 2",
            "the mutual effect becomes stronger",
            "stronger",
            vec![
                Test::above("the same excess of level 3 at p̄′ = 0.06 less that of level 1", late - early, 0.0)
                    .pinned(0.04295, CHANGE),
            ],
        ),
        Claim::new(
            "§3, Fig. 2",
            "not circular contact zone, especially for the indenters of the lowest level",
            "not circular",
            pinned(above_others(spots), [0.00324, 0.485, 0.942], [ASYMMETRY, 0.022, 0.056]),
        )
        .or(
            "rows of one level each",
            pinned(above_others(found.rows), [0.02787, 0.6345, 1.110], [ASYMMETRY, 0.004, 0.008]),
        )
        .remark("Not circular here: (max − min)/max above 1 %"),
        Claim::new(
            "§3, Fig. 2b",
            "Mutual effect can be evaluated by comparison of curves 1 and 2",
            "curves 1 and 2",
            vec![
                Test::above("radius of curve 2 above that of curve 1, relative", without / radius - 1.0, 0.01)
                    .pinned(0.0550, 2e-3),
            ],
        ),
        Claim::new("§3, Fig. 2a", "(p₃′)max = 0.07", "peak of level 3", vec![peak(found.late.levels[2].max_pressure)])
            .or("p̄′ = 0.006", vec![peak(found.misprints[0]).pinned(0.1003, 1e-4)])
            .or(
                "p̄′ = 0.008 as in Fig. 3, pressure over E₁ instead of E₂",
                vec![peak(found.misprints[1]).pinned(0.0710, 1e-4)],
            ),
    ]
}

/// The spot's boundary, and the circle of the indenter without mutual effect.
fn outlines(found: &Found) -> Result<Data, StudyError> {
    let without = found.apart.levels[2].contact_radius.ok_or("level 3 does not touch")?;
    let mut data = Data::new("outline", &["x", "y", "x_apart", "y_apart"]);
    data.rows = (0..OUTLINE)
        .map(|i| {
            let angle = 2.0 * PI * i as f64 / (OUTLINE - 1) as f64;
            let (r, (sine, cosine)) = (found.outline.radius(angle), angle.sin_cos());
            vec![r * cosine, r * sine, without * cosine, without * sine]
        })
        .collect();
    Ok(data)
}

fn picture(found: &Found, outlines: &Data) -> Figure {
    let pressure = Chart {
        title: "(a)".to_owned(),
        x: Axis::linear("x/l, from level 2 to level 1"),
        y: Axis::linear("p₃/E₂"),
        curves: vec![curve("", Style::Line, 0, found.profile.clone())],
    };
    let reach = 1.2 * outlines.rows.iter().map(|row| row[2]).fold(0.0, f64::max);
    let line = |x: usize, y: usize| outlines.rows.iter().map(move |row| [row[x], row[y]]);
    let spots = Chart {
        title: "(b)".to_owned(),
        // The chart is as wide as high on the sheet.
        x: Axis::linear("x/l").from_to(-reach / 0.68, reach / 0.68),
        y: Axis::linear("y/l").from_to(-reach, reach),
        curves: vec![
            curve("1: contact spot", Style::Line, 0, line(0, 1)),
            curve("2: without mutual effect", Style::Dashed, 1, line(2, 3)),
        ],
    };
    let caption = "Fig. 2 with the parameters as printed: χ = 2, h/l = 0.5, p̄/E₂ = 0.06; third level.";
    figure(vec![pressure, spots], caption)
}
