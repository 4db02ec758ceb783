//! Fig. 4: additional displacement against nominal pressure, one-level and three-level, with and without mutual effect.

use super::model::Model;
use super::{Claim, Test, pinned};
use crate::draw::{curve, figure, linear};
use crate::{Check, Data, Outcome, Study, StudyError, Tolerance};
use percoat_app::picture::{Axis, Chart, Curve, Figure, Style};
use rayon::prelude::*;

pub const STUDY: Study = Study {
    name: "paper/fig4",
    title: "Fig. 4: additional displacement against nominal pressure",
    files: &["chi-2.csv", "chi-5.csv", "figure.png", "hard.png", "methods.csv", "printed.csv"],
    run,
    quick: None,
};

const POINTS: usize = 192;
/// Points along the cell for the curves.
const CURVE_POINTS: usize = 128;
/// The text gives no range: this one reaches from below the touch of the third level on.
const LOADS: [f64; 2] = [0.0005, 0.02];
const COUNT: usize = 14;
/// Load at which the claims are judged, one of the curve's.
const LOAD: f64 = 0.0095;
/// Errors of the mesh: of the difference of two w_a, each good to 2e-4 of 0.06, and of the difference of two such.
const DIFFERENCE: f64 = 2.4e-5;
const DIFFERENCES: f64 = 4.8e-5;
/// Error of the mesh in a ratio of two w_a where the first level alone touches, with five samples to its radius.
const RATIO: f64 = 2e-3;
const THICKNESSES: [&str; 2] = ["layers.0.thickness=0.12", "layers.0.thickness=0.24"];
const ONE_LEVEL: [&str; 2] = ["levels.0.height=0", "levels.1.height=0"];
const SPARSE_LEVEL: [&str; 2] =
    ["lattice.period=1.7320508075688772", "levels=[{ shape = \"paraboloid\", radius = 0.8 }]"];
/// An independent periodic solver, three levels at p̄′ = 0.01: w_a for h/l = 0.12 and 0.24.
const REFERENCE: [(&str, [f64; 2]); 2] = [("0.2", [0.05203, 0.05994]), ("5", [0.02616, 0.02133])];

/// w_a against load for one χ: three levels, one level, without mutual effect; by thickness.
struct Curves {
    loads: Vec<f64>,
    three: [Vec<f64>; 2],
    one: [Vec<f64>; 2],
    apart: [Vec<f64>; 2],
}

impl Curves {
    fn new(chi: &str) -> Result<Self, StudyError> {
        let chi = format!("layers.0.shear_ratio={chi}");
        let loads = linear(LOADS[0], LOADS[1], COUNT);
        let curve = |overrides: &[&str]| -> Result<Vec<f64>, StudyError> {
            let mut steps = Model::new("fig4", overrides)?.steps(CURVE_POINTS)?;
            loads.iter().map(|&load| steps.penetration(load)).collect()
        };
        let of_thickness = |thickness: &&str| -> Result<[Vec<f64>; 3], StudyError> {
            let model = Model::new("fig4", &[&chi, thickness])?;
            let apart: Result<_, StudyError> = loads.iter().map(|&load| Ok(model.apart(load)?.penetration)).collect();
            Ok([curve(&[&chi, thickness])?, curve(&[&chi, thickness, ONE_LEVEL[0], ONE_LEVEL[1]])?, apart?])
        };
        let both: Result<Vec<_>, StudyError> = THICKNESSES.par_iter().map(of_thickness).collect();
        let mut curves = Self { loads, three: Default::default(), one: Default::default(), apart: Default::default() };
        for (k, [three, one, apart]) in both?.into_iter().enumerate() {
            (curves.three[k], curves.one[k], curves.apart[k]) = (three, one, apart);
        }
        Ok(curves)
    }

    /// Index of the load of the claims.
    fn place(&self) -> usize {
        let distance = |i: &usize| (self.loads[*i] - LOAD).abs();
        (0..self.loads.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0)
    }

    /// w_a of three levels minus that of one level, thin and thick.
    fn differences(&self) -> [f64; 2] {
        [0, 1].map(|k| self.three[k][self.place()] - self.one[k][self.place()])
    }

    /// w_a of three levels over that of one level, less 1, thin and thick.
    fn relative(&self) -> [f64; 2] {
        [0, 1].map(|k| self.three[k][self.place()] / self.one[k][self.place()] - 1.0)
    }

    /// w_a of three levels, thin minus thick.
    fn thinner(&self) -> f64 {
        self.three[0][self.place()] - self.three[1][self.place()]
    }

    /// Least and largest ratio of w_a without mutual effect to w_a over all loads, minus 1.
    fn overestimate(&self) -> [f64; 2] {
        let ratios = (0..2).flat_map(|k| self.apart[k].iter().zip(&self.three[k]).map(|(a, w)| a / w - 1.0));
        ratios.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], r| [low.min(r), high.max(r)])
    }

    fn table(&self, name: &'static str) -> Data {
        let columns = ["mean_pressure", "three_012", "three_024", "one_012", "one_024", "apart_012", "apart_024"];
        let mut data = Data::new(name, &columns);
        data.rows = (0..self.loads.len())
            .map(|i| {
                let pairs = [&self.three, &self.one, &self.apart];
                std::iter::once(self.loads[i]).chain(pairs.into_iter().flat_map(|p| [p[0][i], p[1][i]])).collect()
            })
            .collect();
        data
    }
}

fn run() -> Result<Outcome, StudyError> {
    let mut outcome = Outcome::default();
    for (chi, expected) in REFERENCE {
        let chi = format!("layers.0.shear_ratio={chi}");
        let found: Result<Vec<f64>, StudyError> = THICKNESSES
            .iter()
            .map(|thickness| Ok(Model::new("fig4", &[&chi, thickness])?.steps(POINTS)?.loaded(0.01)?.penetration))
            .collect();
        let pairs = found?.into_iter().zip(expected);
        let quantity = format!("w_a at p̄′ = 0.01, {chi}, independent solver");
        outcome.checks.push(Check::worst(
            quantity.replace("layers.0.shear_ratio=", "χ = "),
            pairs,
            Tolerance::Relative(5e-4),
        ));
    }
    let (printed, five, two) = (Curves::new("0.2")?, Curves::new("5")?, Curves::new("2")?);
    outcome.judge(claims(&printed, &five, &two, above_sparse_level(&printed)?));
    outcome.figures = vec![("figure", picture(&printed, "χ = 0.2 as printed")), ("hard", picture(&five, "χ = 5"))];
    let model = Model::new("fig4", &[])?;
    outcome.published = vec![
        model.methods("methods", 0.01, POINTS)?,
        printed.table("printed"),
        five.table("chi-5"),
        two.table("chi-2"),
    ];
    Ok(outcome)
}

fn claims(printed: &Curves, five: &Curves, two: &Curves, above_sparse: [f64; 2]) -> [Claim; 5] {
    let higher = |[thin, thick]: [f64; 2], found| {
        let tests = [
            Test::above("w_a/l of three levels minus one level, h/l = 0.12", thin, 0.0),
            Test::above("h/l = 0.24", thick, 0.0),
        ];
        pinned(tests, found, [DIFFERENCE; 2])
    };
    let thinner = |curves: &Curves| Test::above("w_a/l at h/l = 0.12 minus 0.24", curves.thinner(), 0.0);
    let grows = |curves: &Curves| {
        let [thin, thick] = curves.differences();
        Test::above("difference at h/l = 0.24 minus that at 0.12, over l", thick - thin, 0.0)
    };
    let grows_relatively = |curves: &Curves| {
        let [thin, thick] = curves.relative();
        Test::above("difference over w_a of one level, at h/l = 0.24 minus 0.12", thick - thin, 0.0)
    };
    let [least, most] = printed.overestimate();
    let [least_five, most_five] = five.overestimate();
    let overestimate = |least: f64, most: f64, found: [f64; 2]| {
        let tests = [
            Test::above("w_a without mutual effect over w_a, minus 1: least of all loads", least, 0.0),
            Test::above("largest", most, 0.1),
        ];
        pinned(tests, found, [RATIO; 2])
    };
    [
        Claim::new(
            "§3, Fig. 4a",
            "additional displacement for three level asperities distribution is higher than for the one level model",
            "three levels higher",
            higher(printed.differences(), [0.009455, 0.009546]),
        )
        .or("χ = 5", higher(five.differences(), [0.009372, 0.009158]))
        .or("one level of period √3 l as in Fig. 5", higher(above_sparse, [-0.03314, -0.04254]))
        .remark("At p̄′ = 0.0095, the one-level model as the caption has it: the same lattice, equal heights"),
        Claim::new(
            "§3, Fig. 4a",
            "Decreasing the coating thickness leads to increasing of the additional displacements",
            "thinner",
            vec![thinner(printed).pinned(-0.007801, DIFFERENCE)],
        )
        .or("χ = 5 = 1/0.2, a hard coating as the text says", vec![thinner(five).pinned(0.004674, DIFFERENCE)])
        .or("χ = 2", vec![thinner(two).pinned(0.002420, DIFFERENCE)]),
        Claim::new(
            "§3, Fig. 4a",
            "for the case of relatively thick coatings the difference … is greater than for thinner coating",
            "difference grows",
            vec![grows(printed).pinned(9.11e-5, DIFFERENCES)],
        )
        .or("χ = 5", vec![grows(five).pinned(-2.145e-4, DIFFERENCES)])
        .or("χ = 2", vec![grows(two).pinned(-3.47e-5, DIFFERENCES)])
        .or("χ = 5, the difference in proportion", vec![grows_relatively(five).pinned(0.2010, RATIO)]),
        Claim::new("§3, Fig. 4a", "the last two statements together", "both", vec![thinner(printed), grows(printed)])
            .or("χ = 5", vec![thinner(five), grows(five)])
            .or("χ = 5, the difference in proportion to w_a", vec![thinner(five), grows_relatively(five)])
            .or(
                "χ = 2, the difference in proportion to w_a",
                vec![thinner(two), grows_relatively(two).pinned(0.0545, RATIO)],
            ),
        Claim::new(
            "§3, Fig. 4b",
            "The penetration calculated without mutual effect is greater … essential difference",
            "without mutual effect",
            overestimate(least, most, [0.0567, 0.530]),
        )
        .or("χ = 5", overestimate(least_five, most_five, [0.1701, 0.607]))
        .remark("Essential here: above 10 % somewhere"),
    ]
}

/// w_a of three levels minus that of the other one-level model, that of Fig. 5 with the period √3 l.
fn above_sparse_level(printed: &Curves) -> Result<[f64; 2], StudyError> {
    let place = printed.place();
    let difference = |k: usize| -> Result<f64, StudyError> {
        let model = Model::new("fig4", &[THICKNESSES[k], SPARSE_LEVEL[0], SPARSE_LEVEL[1]])?;
        Ok(printed.three[k][place] - model.steps(POINTS)?.penetration(printed.loads[place])?)
    };
    Ok([difference(0)?, difference(1)?])
}

fn picture(curves: &Curves, what: &str) -> Figure {
    let line = |label: &str, style: Style, colour: usize, values: &[f64]| -> Curve {
        curve(label, style, colour, curves.loads.iter().copied().zip(values.iter().copied()).map(<[f64; 2]>::from))
    };
    let panel = |title: &str, curves: Vec<Curve>| Chart {
        title: title.to_owned(),
        x: Axis::linear("p̄/E₂"),
        y: Axis::linear("wₐ/l"),
        curves,
    };
    let [thin, thick] = &curves.three;
    let levels = vec![
        line("1: h/l = 0.12, three levels", Style::Line, 1, thin),
        line("2: h/l = 0.24, three levels", Style::Line, 2, thick),
        line("1′: h/l = 0.12, one level", Style::Dashed, 1, &curves.one[0]),
        line("2′: h/l = 0.24, one level", Style::Dashed, 2, &curves.one[1]),
    ];
    let mutual = vec![
        line("1: h/l = 0.12", Style::Line, 1, thin),
        line("2: h/l = 0.24", Style::Line, 2, thick),
        line("1′: without mutual effect", Style::Dashed, 1, &curves.apart[0]),
        line("2′: without mutual effect", Style::Dashed, 2, &curves.apart[1]),
    ];
    let caption = format!("Fig. 4, {what}: r′ = 0.8, steps 0.01, ν₁ = 0.22, ν₂ = 0.3.");
    figure(vec![panel("(a)", levels), panel("(b)", mutual)], &caption)
}
