//! Table 1: largest pressures with mutual effect and under isolated indenters, and how strong the mutual effect is.

use super::against::CHANGE;
use super::fig3::{LOAD, POINTS};
use super::model::Model;
use super::{Claim, Test, pinned};
use crate::draw::{curve, figure};
use crate::{Check, Data, Outcome, Study, StudyError};
use percoat_app::picture::{Axis, Chart, Figure, Style};
use percoat_core::comparison::Answer;
use percoat_core::reading::Reading;

pub const STUDY: Study = Study {
    name: "paper/table1",
    title: "Table 1: largest pressures, and how strong the mutual effect is",
    files: &["figure.png", "table1.csv"],
    run,
    quick: None,
};

/// Peaks as printed, ν₁ = 0.45 and 0.2: with mutual effect, isolated; levels 1 to 3.
const PRINTED: [[[f64; 3]; 2]; 2] =
    [[[0.356, 0.298, 0.191], [0.312, 0.289, 0.232]], [[0.320, 0.288, 0.213], [0.311, 0.287, 0.230]]];
/// An independent periodic solver on 756 points along three periods: peaks, load shares, w_a, first touches; isolated
/// peaks under the same forces by the integral equation of the coated contact.
const PEAKS: [[f64; 3]; 2] = [[0.11677, 0.10094, 0.08326], [0.08908, 0.07927, 0.06860]];
const SHARES: [[f64; 3]; 2] = [[0.49490, 0.32258, 0.18252], [0.46069, 0.32652, 0.21279]];
const PENETRATIONS: [f64; 2] = [0.037197, 0.043233];
const TOUCHES: [[f64; 2]; 2] = [[0.00037, 0.00147], [0.00025, 0.00099]];
const ISOLATED: [[f64; 3]; 2] = [[0.11630, 0.10047, 0.08284], [0.08844, 0.07862, 0.06798]];
/// Peaks and w_a without mutual effect, by the same equation.
const APART: [[f64; 3]; 2] = [[0.1149, 0.1008, 0.0849], [0.0875, 0.0788, 0.0692]];
const APART_PENETRATIONS: [f64; 2] = [0.04641, 0.05673];

/// Found for h/l = 0.05 over E₁: with mutual effect, isolated.
const THIN: [[[f64; 3]; 2]; 2] =
    [[[0.2995, 0.2477, 0.1842], [0.2980, 0.2463, 0.1831]], [[0.2814, 0.2347, 0.1817], [0.2800, 0.2334, 0.1806]]];

/// An effect is stronger than another when it is larger by this factor.
const STRONGER: f64 = 1.05;

/// Largest pressures over E₂ at one load.
struct Peaks {
    model: Model,
    found: Reading,
    mutual: [f64; 3],
    /// Peaks isolated under the same forces.
    same_forces: [f64; 3],
    /// Answer without mutual effect: isolated at one penetration, under the same nominal pressure.
    apart: Answer,
    same_nominal: [f64; 3],
}

impl Peaks {
    fn new(case: &str, overrides: &[&str], mean_pressure: f64) -> Result<Self, StudyError> {
        let model = Model::new(case, overrides)?;
        let found = model.steps(POINTS)?.loaded(mean_pressure)?;
        let (law, indenters, apart) = (model.law()?, model.indenters()?, model.apart(mean_pressure)?);
        let same_forces = [0, 1, 2].map(|m| law.loaded(indenters[m].curvature, found.levels[m].load).max_pressure);
        let mutual = [0, 1, 2].map(|m| found.levels[m].max_pressure);
        let same_nominal = [0, 1, 2].map(|m| apart.levels[m].max_pressure);
        Ok(Self { model, found, mutual, same_forces, same_nominal, apart })
    }

    /// Relative change of the peaks by the mutual effect, under the same forces and the same nominal pressure.
    fn changes(&self) -> [[f64; 3]; 2] {
        [self.same_forces, self.same_nominal].map(|alone| [0, 1, 2].map(|m| self.mutual[m] / alone[m] - 1.0))
    }
}

fn run() -> Result<Outcome, StudyError> {
    let mut outcome = Outcome::default();
    let peaks = [Peaks::new("fig3a", &[], LOAD)?, Peaks::new("fig3b", &[], LOAD)?];
    for (k, (nu, peaks)) in ["ν₁ = 0.45", "ν₁ = 0.2"].iter().zip(&peaks).enumerate() {
        let mut part = Outcome::default();
        super::against::independent_solver(&mut part, &peaks.found, PEAKS[k], SHARES[k], PENETRATIONS[k]);
        super::against::first_touches(&mut part, &peaks.model, TOUCHES[k])?;
        super::against::isolated_law(&mut part, &peaks.apart, APART[k], APART_PENETRATIONS[k]);
        let isolated = peaks.same_forces.into_iter().zip(ISOLATED[k]);
        let tolerance = crate::Tolerance::Relative(2e-4);
        part.checks.push(Check::worst("isolated peaks, independent integral equation", isolated, tolerance));
        let named = |check: Check| Check { quantity: format!("{nu}: {}", check.quantity), ..check };
        outcome.checks.extend(part.checks.into_iter().map(named));
    }
    let thin = "layers.0.thickness=0.05";
    let thin = [Peaks::new("fig3a", &[thin], LOAD)?, Peaks::new("fig3b", &[thin], LOAD)?];
    let hard = Peaks::new("fig3b", &["layers.0.shear_ratio=2.0"], LOAD)?;
    outcome.judge(numbers(&peaks, &thin));
    outcome.judge(patterns(&peaks, &thin));
    outcome.judge([harder(&hard, &peaks[1])]);
    outcome.published.push(table(&peaks, &thin));
    outcome.figures.push(("figure", picture(&peaks, &thin)));
    Ok(outcome)
}

/// The twelve numbers.
fn numbers(peaks: &[Peaks; 2], thin: &[Peaks; 2]) -> Vec<Claim> {
    let mut claims = Vec::new();
    for (k, place) in ["Table 1, ν₁ = 0.45", "Table 1, ν₁ = 0.2"].into_iter().enumerate() {
        let tests = |values: [f64; 3], printed: [f64; 3]| {
            [0, 1, 2].map(|m| Test::printed(format!("level {}", m + 1), values[m], printed[m], 0.001))
        };
        let over_e1 = |values: [f64; 3]| values.map(|p| p / thin[k].model.coating_young());
        let thinner = |values: [f64; 3], printed: [f64; 3], found: [f64; 3]| {
            pinned(tests(over_e1(values), printed), found, [1e-4; 3])
        };
        let [mutual, isolated] = PRINTED[k];
        let quotes =
            [["0.356 / 0.298 / 0.191", "0.312 / 0.289 / 0.232"], ["0.320 / 0.288 / 0.213", "0.311 / 0.287 / 0.230"]][k];
        let names = [["with mutual effect 0.45", "isolated 0.45"], ["with mutual effect 0.2", "isolated 0.2"]][k];
        claims.push(
            Claim::new(place, quotes[0], names[0], tests(peaks[k].mutual, mutual).to_vec())
                .or("h/l = 0.05, over E₁", thinner(thin[k].mutual, mutual, THIN[k][0]))
                .remark("Calculation with mutual effect"),
        );
        claims.push(
            Claim::new(place, quotes[1], names[1], tests(peaks[k].same_forces, isolated).to_vec())
                .or("same nominal pressure", tests(peaks[k].same_nominal, isolated).to_vec())
                .or("h/l = 0.05, over E₁", thinner(thin[k].same_forces, isolated, THIN[k][1]))
                .remark("Isolated indenters"),
        );
    }
    claims
}

/// Patterns that the numbers are said, or seen, to show.
fn patterns(peaks: &[Peaks; 2], thin: &[Peaks; 2]) -> [Claim; 5] {
    let [[forces_a, nominal_a], [forces_b, nominal_b]] = [peaks[0].changes(), peaks[1].changes()];
    let [[thin_forces_a, thin_nominal_a], [thin_forces_b, thin_nominal_b]] = [thin[0].changes(), thin[1].changes()];
    let largest = |changes: [f64; 3]| changes.into_iter().map(f64::abs).fold(0.0, f64::max);
    let strength = |a: [f64; 3], b: [f64; 3], found: [f64; 2]| {
        let ratio = largest(a) / largest(b);
        let tests = [
            Test::above("largest change of a peak, ν₁ = 0.45", largest(a), 0.0),
            Test::above("over that for ν₁ = 0.2", ratio, STRONGER),
        ];
        pinned(tests, found, [CHANGE, found[1] * (1.0 + found[1]) / found[0] * CHANGE])
    };
    let signs = |a: [f64; 3], b: [f64; 3], found: [f64; 4]| {
        let tests = [
            Test::above("change of level 1, ν₁ = 0.45", a[0], 0.0),
            Test::below("of level 3", a[2], 0.0),
            Test::above("ν₁ = 0.2: of level 1", b[0], 0.0),
            Test::below("of level 3", b[2], 0.0),
        ];
        pinned(tests, found, [CHANGE; 4])
    };
    let ratio = |pair: &[Peaks; 2], over_e1: bool| {
        let young = if over_e1 { pair[1].model.coating_young() / pair[0].model.coating_young() } else { 1.0 };
        let value = young * pair[0].same_forces[0] / pair[1].same_forces[0];
        Test::printed("ratio of level 1", value, 1.003, 0.006)
    };
    [
        Claim::new(
            "Table 1",
            "Level 1: 0.356 against 0.312; level 3: 0.191 against 0.232",
            "signs",
            signs(forces_a, forces_b, [0.0040, 0.0051, 0.0073, 0.0092]),
        )
        .or(
            "isolated indenters under the same nominal pressure",
            signs(nominal_a, nominal_b, [0.0163, -0.0200, 0.0181, -0.0094]),
        )
        .remark("The mutual effect as a shift of load from low to high levels: its sign, not its size"),
        Claim::new(
            "§3, Fig. 3",
            "soft low-compressive coatings (ν₁ = 0.45) mutual effect is strong",
            "strong",
            vec![Test::above("largest change of a peak under the same forces", largest(forces_a), 0.05)],
        )
        .or(
            "isolated indenters under the same nominal pressure",
            vec![Test::above("largest change of a peak", largest(nominal_a), 0.05)],
        )
        .or(
            "h/l = 0.05 and the same nominal pressure",
            vec![Test::above("largest change of a peak", largest(thin_nominal_a), 0.05)],
        )
        .remark("Strong here: 5 %; Table 1 shows 18 %"),
        Claim::new(
            "§3, Fig. 3",
            "for ν₁ = 0.2 it is negligible",
            "negligible",
            vec![Test::below("largest change of a peak under the same forces", largest(forces_b), 0.01)],
        ),
        Claim::new(
            "§4",
            "for … thin soft coatings this effect is stronger for … relatively high value of Poisson ratio",
            "high Poisson ratio",
            strength(forces_a, forces_b, [0.0051, 0.552]),
        )
        .or("isolated indenters under the same nominal pressure", strength(nominal_a, nominal_b, [0.0200, 1.108]))
        .or("thin as the words say, h/l = 0.05", strength(thin_forces_a, thin_forces_b, [0.0061, 1.003]))
        .or("h/l = 0.05 and the same nominal pressure", strength(thin_nominal_a, thin_nominal_b, [0.0563, 1.409])),
        Claim::new(
            "Table 1",
            "isolated: 0.312 for ν₁ = 0.45, 0.311 for ν₁ = 0.2",
            "isolated ratio",
            vec![ratio(peaks, false)],
        )
        .or("pressure over E₁", vec![ratio(peaks, true)])
        .or("h/l = 0.05, pressure over E₁", vec![ratio(thin, true).pinned(1.0642, CHANGE)]),
    ]
}

fn harder(hard: &Peaks, soft: &Peaks) -> Claim {
    let [[forces_hard, nominal_hard], [forces_soft, nominal_soft]] = [hard.changes(), soft.changes()];
    let largest = |changes: [f64; 3]| changes.into_iter().map(f64::abs).fold(0.0, f64::max);
    let tests = |hard: [f64; 3], soft: [f64; 3], [found, error]: [f64; 2]| {
        let ratio = largest(hard) / largest(soft);
        vec![Test::above("largest change of a peak, χ = 2 over χ = 0.5", ratio, STRONGER).pinned(found, error)]
    };
    Claim::new(
        "§4",
        "the mutual effect is stronger for hard coatings, than for the soft ones",
        "hard and soft",
        tests(nominal_hard, nominal_soft, [5.83, 0.15]),
    )
    .or("isolated indenters under the same forces, as in Table 1", tests(forces_hard, forces_soft, [0.650, 0.072]))
    .remark("Fig. 3b with χ = 2 and 0.5; isolated under the same nominal pressure as in Figs 2b, 4b")
}

fn table(peaks: &[Peaks; 2], thin: &[Peaks; 2]) -> Data {
    let columns = [
        "poisson",
        "level",
        "printed_mutual",
        "printed_isolated",
        "mutual",
        "same_forces",
        "same_nominal_pressure",
        "thin_over_e1_mutual",
        "thin_over_e1_same_forces",
    ];
    let mut data = Data::new("table1", &columns);
    for (k, nu) in [0.45, 0.2].into_iter().enumerate() {
        for m in 0..3 {
            let (peaks, young) = (&peaks[k], thin[k].model.coating_young());
            data.rows.push(vec![
                nu,
                (m + 1) as f64,
                PRINTED[k][0][m],
                PRINTED[k][1][m],
                peaks.mutual[m],
                peaks.same_forces[m],
                peaks.same_nominal[m],
                thin[k].mutual[m] / young,
                thin[k].same_forces[m] / young,
            ]);
        }
    }
    data
}

/// The table as a picture: a panel for each ν₁, the levels across.
fn picture(peaks: &[Peaks; 2], thin: &[Peaks; 2]) -> Figure {
    let line = |label: &str, style: Style, colour: usize, values: [f64; 3]| {
        curve(label, style, colour, (1..).zip(values).map(|(m, p): (i32, f64)| [f64::from(m), p]))
    };
    let panel = |k: usize, title: &str| {
        let over_e1 = thin[k].mutual.map(|p| p / thin[k].model.coating_young());
        Chart {
            title: title.to_owned(),
            x: Axis::linear("level").from_to(0.8, 3.2),
            y: Axis::linear("largest pressure over E₂").from_to(0.0, 0.4),
            curves: vec![
                line("printed, with mutual effect", Style::LineMarkers, 1, PRINTED[k][0]),
                line("printed, isolated", Style::Markers, 1, PRINTED[k][1]),
                line("with mutual effect", Style::LineMarkers, 2, peaks[k].mutual),
                line("isolated, same forces", Style::Markers, 2, peaks[k].same_forces),
                line("h/l = 0.05, over E₁", Style::Dashed, 3, over_e1),
            ],
        }
    };
    figure(vec![panel(0, "ν₁ = 0.45"), panel(1, "ν₁ = 0.2")], "Table 1, printed and converged.")
}
