//! Fig. 6: lines of equal tensile-compressive and principal shear stress under an indenter of the first level.

use super::model::Model;
use super::under::{EDGE, INSIDE, Part, Under};
use super::{Claim, Test, pinned};
use crate::draw::{curve, figure};
use crate::{Data, Outcome, Study, StudyError};
use percoat_app::picture::{Axis, Chart, Figure, Style};
use percoat_core::body::MeanStress;
use rayon::prelude::*;

pub const STUDY: Study = Study {
    name: "paper/fig6",
    title: "Fig. 6: stresses under an indenter of the first level",
    files: &["figure.png", "section-a.csv", "section-b.csv"],
    run,
    quick: None,
};

/// Steps a tenth of the printed ones.
const STEPS: [&str; 2] = ["levels.0.height=0.0072", "levels.1.height=0.0036"];
/// First touches of levels 2 and 3 of (b), an independent periodic solver.
const TOUCHES: [f64; 2] = [0.0174, 0.0744];

fn run() -> Result<Outcome, StudyError> {
    let smaller = ["lattice.period=0.67", STEPS[0], STEPS[1]];
    let sets: [(&str, &[&str]); 5] = [
        ("fig6a", &[]),
        ("fig6b", &[]),
        ("fig6b", &STEPS),
        ("fig6b", &smaller),
        ("fig6b", &["layers.0.thickness=0.1"]),
    ];
    let unders: Result<Vec<Under>, StudyError> =
        sets.par_iter().map(|(name, overrides)| Under::new(name, overrides, MeanStress::Confined)).collect();
    let [a, b, small, smaller, thick] = &unders?[..] else { return Err("five sets".into()) };
    let mut outcome = Outcome::default();
    super::against::first_touches(&mut outcome, &Model::new("fig6b", &[])?, TOUCHES)?;
    outcome.judge(claims(a, b, [small, smaller], thick));
    outcome.figures = vec![("figure", picture(a, b))];
    for (name, under) in [("section-a", a), ("section-b", b)] {
        let mut data = Data::new(name, &["material", "x_over_a", "z_over_h", "sigma_r", "tau1"]);
        for (material, part) in (1..).zip(&under.section(WIDE, DEEP)) {
            // Every fourth column and row: the figure is drawn from all.
            let kept = |(i, _): &(usize, [f64; 4])| i % 121 % 4 == 0 && i / 121 % 4 == 0;
            let samples = part.samples().enumerate().filter(kept);
            data.rows.extend(samples.map(|(_, [x, z, radial, shear])| vec![f64::from(material), x, z, radial, shear]));
        }
        outcome.published.push(data);
    }
    Ok(outcome)
}

const WIDE: f64 = 2.0;
const DEEP: f64 = 2.0;

fn claims(a: &Under, b: &Under, three: [&Under; 2], thick: &Under) -> Vec<Claim> {
    let ([shear_a, depth_a, tension_a], [shear_b, depth_b, tension_b]) = rayon::join(|| a.maxima(), || b.maxima());
    let levels = |[a, b]: [&Under; 2], found: f64| {
        let count = |what: &str, under: &Under| Test::above(what, under.levels as f64, 2.5).pinned(found, 0.0);
        vec![count("levels in contact, (a)", a), count("(b)", b)]
    };
    let at_interface = |what: &str, depth: f64| Test::above(what, depth, 0.98);
    let edge = |what: &str, under: &Under, found: f64| {
        Test::above(what, under.largest(0, 0.9, 1.5)[0], 0.0).pinned(found, EDGE * found)
    };
    vec![
        Claim::new(
            "§3, Figs 6, 7",
            "the nominal pressure p̄′, which provides three-level contact",
            "three levels",
            levels([a, b], 1.0),
        )
        .or("(h₁ − h₂)/r₁ = 0.0036, a tenth, and l/r₁ = 0.67 in (a)", levels([three[1], three[0]], 3.0))
        .remark("In (b) levels 2 and 3 touch at p̄′ = 0.0174 and 0.0745; in (a) the penetration is 0.0003 r₁"),
        Claim::new(
            "§3, Fig. 6",
            "tension occurs at the surface near the boundary of contact",
            "surface tension",
            vec![edge("largest σ_r/E₂ from 0.9 to 1.5 a, (a)", a, 0.00503), edge("(b)", b, 0.0269)],
        ),
        Claim::new(
            "§3, Fig. 6",
            "and at the coating-substrate interface for thicker coating",
            "interface tension",
            pinned(
                [
                    Test::above("σ_r/E₂ in the coating under the centre: (a), h = 1.2 a", a.centre(1), 0.0),
                    Test::below("(b), h = 0.23 a", b.centre(1), 0.0),
                    Test::above("(b) with h/r₁ = 0.1", thick.centre(1), 0.0),
                ],
                [0.0073084, -0.0054197, 0.033488],
                [INSIDE; 3],
            ),
        ),
        Claim::new(
            "§3, Fig. 6",
            "principal shear stresses concentrate at the surface-substrate interface",
            "shear at the interface",
            pinned(
                [
                    at_interface("depth of the largest τ₁ in the coating over h, (a)", depth_a),
                    at_interface("(b)", depth_b),
                ],
                [0.39118, 1.0],
                // The search for a largest stress ends within a thousandth of its depth.
                [4e-4, 1e-9],
            ),
        )
        .or("for (b) alone", vec![at_interface("depth over h", depth_b)]),
        Claim::new(
            "§4",
            "internal stresses in relatively hard coatings also depend essentially on the contact density",
            "contact density",
            pinned(
                [
                    Test::above("largest tension of (b) over that of (a)", tension_b / tension_a, 1.5),
                    Test::above("largest τ₁", shear_b / shear_a, 1.5),
                ],
                [3.69, 3.8953],
                [3.69 * EDGE, 2e-4],
            ),
        ),
    ]
}

fn picture(a: &Under, b: &Under) -> Figure {
    let mut panels = Vec::new();
    for (title, under) in [("(a) l/r₁ = 0.067", a), ("(b) l/r₁ = 0.6", b)] {
        let parts = under.section(WIDE, DEEP);
        panels.push(lines(format!("{title}: σᵣ/E₂"), &parts, 0));
        panels.push(lines(format!("{title}: τ₁/E₂"), &parts, 1));
    }
    figure(panels, "Fig. 6 with the parameters as printed, lines of equal stress; contact |x| < a, interface z = h.")
}

/// Eight lines at round values.
fn lines(title: String, parts: &[Part; 2], quantity: usize) -> Chart {
    let values = parts.iter().flat_map(Part::samples).map(|sample| sample[2 + quantity]);
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
    let rough = (high - low) / 7.0;
    let power = 10f64.powf(rough.log10().floor());
    let step = power * [1.0, 2.0, 5.0, 10.0].into_iter().find(|f| f * power >= rough).unwrap_or(10.0);
    let numbers = (low / step).ceil() as i32..=(high / step).floor() as i32;
    let curves = numbers.enumerate().map(|(i, n)| {
        let level = f64::from(n) * step;
        let points = parts.iter().flat_map(|part| part.line(quantity, level));
        curve(format!("{level:.3}").replace('-', "−"), Style::Line, i % 7, points)
    });
    let curves = curves.chain([curve("", Style::Dotted, 0, [[-WIDE, 1.0], [WIDE, 1.0]])]).collect();
    Chart { title, x: Axis::linear("x/a").from_to(-WIDE, WIDE), y: Axis::linear("z/h").from_to(DEEP, 0.0), curves }
}
