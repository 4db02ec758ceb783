//! Fig. 7: tensile-compressive and principal shear stress along the surface and both sides of the interface.

use super::under::{EDGE, INSIDE, SURFACE, Under};
use super::{Claim, Test, pinned};
use crate::draw::{curve, figure};
use crate::{Data, Outcome, Study, StudyError};
use percoat_app::picture::{Axis, Chart, Curve, Figure, Style};
use percoat_core::body::MeanStress;

pub const STUDY: Study = Study {
    name: "paper/fig7",
    title: "Fig. 7: stresses at the surface and on both sides of the interface",
    files: &["figure.png", "lines-a.csv", "lines-b.csv"],
    run,
    quick: None,
};

/// Overrides of (b).
const B: &str = "lattice.period=0.6";

fn run() -> Result<Outcome, StudyError> {
    let a = Under::new("fig7", &[], MeanStress::Confined)?;
    let b = Under::new("fig7", &[B], MeanStress::Confined)?;
    let open = Under::new("fig7", &[B], MeanStress::HalfSpace)?;
    let mut outcome = Outcome::default();
    outcome.judge(high_density(&a, &b));
    outcome.judge(low_density(&a, &b, &open));
    outcome.judge(both(&a, &b));
    outcome.figures = vec![("figure", picture(&a, &b))];
    for (name, under) in [("lines-a", &a), ("lines-b", &b)] {
        let columns = ["r", "sigma_r_1", "tau1_1", "sigma_r_2", "tau1_2", "sigma_r_3", "tau1_3"];
        let mut data = Data::new(name, &columns);
        data.rows = (0..under.profiles[0].len())
            .map(|i| {
                let pairs = under.profiles.iter().flat_map(|profile| [profile[i][1], profile[i][2]]);
                std::iter::once(under.profiles[0][i][0]).chain(pairs).collect()
            })
            .collect();
        outcome.published.push(data);
    }
    Ok(outcome)
}

const SWAPPED: &str = "l/r₁ of (a) and (b) exchanged, so that (b) is the high density";

fn high_density(a: &Under, b: &Under) -> Vec<Claim> {
    let edge =
        |under: &Under| vec![Test::above("largest σ_r/E₂ from 0.9 to 1.5 a", under.largest(0, 0.9, 1.5)[0], 0.0)];
    let centre = |under: &Under| vec![Test::above("σ_r/E₂", under.centre(1), 0.0)];
    let substrate = |under: &Under, found| {
        let largest = under.largest(2, 0.0, f64::INFINITY)[0];
        vec![Test::below("largest σ_r/E₂ from level 1 to level 2", largest, 0.0).pinned(found, INSIDE)]
    };
    vec![
        Claim::new(
            "§3, Figs 6, 7",
            "the cases of high (b) and low (a) contact densities",
            "densities",
            vec![Test::below("l of (b) over that of (a)", b.period / a.period, 1.0)],
        )
        .or(SWAPPED, vec![Test::below("l of (b) over that of (a)", a.period / b.period, 1.0)])
        .remark("l/r₁ = 0.67 or 6.7 in (a) would repair it as well"),
        Claim::new(
            "§3, Fig. 7b",
            "high contact density: tensile … at the surface under the boundary of the contact zone (curve 1)",
            "high density, surface",
            edge(b),
        )
        .or(SWAPPED, edge(a)),
        Claim::new(
            "§3, Fig. 7b; §4",
            "high contact density: … in coating material at the interface under the center (curve 2)",
            "high density, coating",
            centre(b),
        )
        .or(SWAPPED, centre(a)),
        Claim::new(
            "§3, Fig. 7b",
            "high contact density: only compression realizes in substrate material (curve 3)",
            "high density, substrate",
            substrate(b, 3.599e-4),
        )
        .or(SWAPPED, substrate(a, -1.0682e-3)),
    ]
}

fn low_density(a: &Under, b: &Under, open: &Under) -> Vec<Claim> {
    let under_centre = |under: &Under, found: [f64; 3]| {
        let names = ["σ_r/E₂ at the surface", "at the interface in the coating", "in the substrate"];
        pinned([0, 1, 2].map(|k| Test::below(names[k], under.centre(k), 0.0)), found, [SURFACE, INSIDE, INSIDE])
    };
    // Inside the largest one is taken at one end of the range, from samples of the line: the next may be taken.
    let edge = |under: &Under, found: [f64; 3], next: [f64; 2]| {
        let names =
            ["largest σ_r/E₂ from 0.9 to 1.5 a at the surface", "at the interface in the coating", "in the substrate"];
        let tests = [0, 1, 2].map(|k| Test::above(names[k], under.largest(k, 0.9, 1.5)[0], 0.0));
        pinned(tests, found, [EDGE * found[0], next[0], next[1]])
    };
    let between = |under: &Under, found: [f64; 2]| {
        let [value, place] = under.largest(1, 0.0, f64::INFINITY);
        let tests = [
            Test::above("largest σ_r/E₂ at the interface in the coating", value, 0.0),
            Test::above("its distance from the axis over a", place, 1.5),
        ];
        // Samples of the line are 0.04 a apart at most.
        pinned(tests, found, [INSIDE, 0.04])
    };
    vec![
        Claim::new(
            "§3, Fig. 7a; §4",
            "low density: compression under the center, both for the surface and for the interface",
            "low density, centre",
            under_centre(a, [-0.024320, 0.0073084, -0.0013760]),
        )
        .or(SWAPPED, under_centre(b, [-0.076726, -0.0054197, -0.043576])),
        Claim::new(
            "§3, Fig. 7a",
            "low density: tension under the boundary of the contact zone, both for the surface and for the interface",
            "low density, boundary",
            edge(a, [0.00503, 0.00125, -0.00214], [2e-4, 3e-5]),
        )
        .or(SWAPPED, edge(b, [0.0269, -0.0116, -0.0057], [4e-3, 7e-4]))
        .remark("At the surface alone it holds"),
        Claim::new(
            "§4",
            "For small contact density, interface tension is realized not under but between indenters",
            "between indenters",
            between(a, [0.0073084, 0.0]),
        )
        .or(SWAPPED, between(b, [8.747e-4, 3.936]))
        .or("exchanged, mean lateral stress of a half-space", between(open, [-6.38e-5, 3.936])),
    ]
}

fn both(a: &Under, b: &Under) -> Vec<Claim> {
    let (depth_a, depth_b) = rayon::join(|| a.maxima()[1], || b.maxima()[1]);
    let depth = |what: &str, depth: f64| Test::above(what, depth, 0.98);
    let peak = |what: &str, under: &Under, found: f64| {
        let largest = |curve: usize| under.profiles[curve].iter().map(|row| row[2]).fold(0.0, f64::max);
        Test::above(what, largest(1) / largest(0), 1.0).pinned(found, EDGE * found)
    };
    vec![
        Claim::new(
            "§3, Fig. 7",
            "tensile-compressive stresses … are very different … as at the surface and as at the interface",
            "very different",
            vec![
                Test::above("σ_r under the centre, (b) over (a): surface", b.centre(0) / a.centre(0), 1.5),
                Test::below("interface, coating", b.centre(1) / a.centre(1), 1.0 / 1.5),
                Test::above("interface, substrate", b.centre(2) / a.centre(2), 1.5),
            ],
        ),
        Claim::new(
            "§3, Fig. 7",
            "Principal shear stresses for both cases have interface maxima",
            "interface maxima",
            vec![depth("depth of the largest τ₁ in the coating over h, (a)", depth_a), depth("(b)", depth_b)],
        )
        .or(
            "of the curves drawn, the interface's is the highest",
            vec![
                peak("largest τ₁ at the interface in the coating over that at the surface, (a)", a, 1.40),
                peak("(b)", b, 1.48),
            ],
        ),
    ]
}

fn picture(a: &Under, b: &Under) -> Figure {
    let names = ["surface", "interface, coating", "interface, substrate"];
    let panel = |title: &str, under: &Under, column: usize, mark: &str| {
        let line = |k: usize| -> Curve {
            let points = under.profiles[k].iter().map(|row| [row[0] / under.radius, row[column]]);
            curve(format!("{}{mark}: {}", k + 1, names[k]), Style::Line, k + 1, points)
        };
        Chart {
            title: format!("{title} {}", if column == 1 { "σᵣ" } else { "τ₁" }),
            x: Axis::linear("r/a, from level 1 toward level 2").from_to(0.0, 3.5),
            y: Axis::linear(if column == 1 { "σᵣ/E₂" } else { "τ₁/E₂" }),
            curves: (0..3).map(line).collect(),
        }
    };
    let panels = vec![panel("(a)", a, 1, ""), panel("(b)", b, 1, ""), panel("(a)", a, 2, "′"), panel("(b)", b, 2, "′")];
    figure(panels, "Fig. 7 with the parameters as printed: (a) l/r₁ = 0.067, (b) l/r₁ = 0.6.")
}
