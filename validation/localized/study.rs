//! The localized solution against what its circles should leave out, and against the spectral one.
//!
//! One level: lattice sums over the indenters inside predict contact and penetration ([`crate::exact::localization`]).
//! Three levels on four coatings, with load-balanced circles: the exchange of load that [`leftover`] predicts, its
//! median and worst over all shells; with the lattice sum outside: loads, pressures, radii, penetration and stresses of
//! both methods, whatever the shell. One level on thin coatings, with the lattice sum: radius, peak and penetration of both.

mod leftover;
mod one_level;
mod thin;

use super::draw::{self, curve};
use super::{Check, Data, Outcome, Study, StudyError, Tolerance};
use leftover::{Leftover, Shells};
use one_level::one_level;
use percoat_app::picture::{Axis, Chart, Curve, Style};
use percoat_core::body::{HalfSpace, Interface, Layer, Material, MeanStress};
use percoat_core::comparison::{Answer, CircleComparison, Comparison, ComparisonTask, StressPair};
use percoat_core::counterbody::{Indenters, Level, Shape};
use percoat_core::lattice::Lattice;
use percoat_core::load::Load;
use percoat_core::localized::{CircleRadius, Setup, Stop};
use percoat_core::problem::Problem;
use percoat_core::spectral::Settings;
use std::ops::ControlFlow;
use std::sync::Arc;
use thin::thin_coatings;

pub const STUDY: Study = Study {
    name: "localized",
    title: "Localized against spectral",
    files: &[
        "figure.png",
        "hard-shells.data.csv",
        "hard.data.csv",
        "one-level.data.csv",
        "sliding-shells.data.csv",
        "sliding.data.csv",
        "soft-shells.data.csv",
        "soft.data.csv",
        "thin.data.csv",
        "two-layers-shells.data.csv",
        "two-layers.data.csv",
    ],
    run: || run(&coatings()?, &thin::coatings()),
    quick: Some(|| run(&coatings()?[3..], &thin::coatings()[..3])),
};

const RADIUS: f64 = 0.8;
/// Indenters in the circles of the three levels.
const INDENTERS: [usize; 5] = [7, 37, 301, 439, 613];
/// Whole shells between these numbers of indenters stand for one another.
const SHELLS: [usize; 2] = [301, 613];
/// Samples along the cell.
const POINTS: usize = 192;

const SETUP: Setup = Setup { indenters: 7, elements: 32, rule: CircleRadius::LatticeSum, mutual_effect: true };

fn run(coatings: &[Coated], thin: &[thin::Coating]) -> Result<Outcome, StudyError> {
    let mut outcome = Outcome::default();
    let first = one_level(&mut outcome)?;
    let mut second = Vec::new();
    for (colour, (names, half_space, mean_pressure)) in (1..).zip(coatings) {
        second.extend(coated(*names, half_space, *mean_pressure, colour, &mut outcome)?);
    }
    thin_coatings(thin, &mut outcome)?;
    let chart = |title: &str, y, curves| Chart {
        title: title.to_owned(),
        x: Axis::log("indenters inside the circle"),
        y,
        curves,
    };
    let panels = vec![
        chart("(a) one level, bare", Axis::linear("error of the penetration, %"), first),
        chart("(b) three levels, coated", Axis::log("largest error of a load share").from_to(1e-6, 0.1), second),
    ];
    outcome.figures.push(("figure", draw::figure(panels, CAPTION)));
    Ok(outcome)
}

const CAPTION: &str = "(a) Lattice sums and computed circles, p̄ = 0.01 E*. (b) Load-balanced circles: computed (markers) and \
                       from point forces (line, the first coating). Dashed: the lattice sum outside.";

/// Names of data, of the shells' data and of checks, body and mean pressure.
type Coated = ([&'static str; 3], HalfSpace, f64);

/// The coatings; E₂ = 1, ν₂ = 0.3.
fn coatings() -> Result<[Coated; 4], StudyError> {
    let substrate = Material::from_young(1.0, 0.3)?;
    let layer = |chi: f64, nu, thickness, interface| -> Result<Layer, StudyError> {
        Ok(Layer::new(Material::from_shear(chi * substrate.shear(), nu)?, thickness, interface)?)
    };
    let body = |layers| HalfSpace::new(layers, substrate);
    Ok([
        (["hard", "hard-shells", "hard coating"], body(vec![layer(2.0, 0.2, 0.5, Interface::Bonded)?]), 0.03),
        (["soft", "soft-shells", "soft coating"], body(vec![layer(0.5, 0.45, 0.5, Interface::Bonded)?]), 0.008),
        (
            ["sliding", "sliding-shells", "sliding coating"],
            body(vec![layer(3.0, 0.2, 0.2, Interface::Frictionless)?]),
            0.02,
        ),
        (
            ["two-layers", "two-layers-shells", "two layers"],
            body(vec![layer(1.2, 0.2, 0.3, Interface::Bonded)?, layer(0.5, 0.4, 0.4, Interface::Bonded)?]),
            0.02,
        ),
    ])
}

/// Three levels on one coating: its checks, its data, and its curves of panel (b).
fn coated(
    [key, shells_key, name]: [&'static str; 3],
    half_space: &HalfSpace,
    mean_pressure: f64,
    colour: usize,
    outcome: &mut Outcome,
) -> Result<Vec<Curve>, StudyError> {
    let lattice = Lattice::hexagonal(1.0, 3)?;
    let level = |m: usize| Level::new(Shape::Paraboloid { radius: RADIUS }, -0.01 * m as f64);
    let indenters = Indenters::new(lattice.clone(), vec![level(0)?, level(1)?, level(2)?])?;
    let task = ComparisonTask {
        problem: Arc::new(Problem::new(indenters, half_space.clone())),
        load: Load::MeanPressure(mean_pressure),
        settings: Settings::default(),
        indenters: INDENTERS.to_vec(),
        elements: SETUP.elements,
        rule: SETUP.rule,
        mutual_effect: SETUP.mutual_effect,
        mean: MeanStress::Confined,
    };
    let compared = task.compare([POINTS; 2], &mut |_| ControlFlow::Continue(()))?;
    if !compared.spectral.converged() {
        return Err(format!("{name}: {}", compared.spectral.report()).into());
    }
    if let Some(circle) =
        compared.circles.iter().chain(&compared.other_rule).find(|circle| circle.stop != Stop::Converged)
    {
        return Err(format!("{name}, {} indenters: {}", circle.indenters, circle.stop).into());
    }
    let leftover =
        Leftover::new(&lattice, half_space, SHELLS[1], Answer::from(&compared.spectral.reading), mean_pressure)?;
    let (data, shares) = exchange(key, &compared, &leftover)?;
    let shells = leftover.shells(SHELLS)?;
    for check in checks(name, &compared, shares, &data, &shells)? {
        outcome.checks.push(check);
    }
    outcome.data.push(data);
    let share = |circle: &CircleComparison| [circle.indenters as f64, circle.difference.load_share];
    let mut curves = vec![
        curve(name, Style::Markers, colour, compared.other_rule.iter().map(share)),
        curve("", Style::Dashed, colour, compared.circles.iter().map(share)),
    ];
    if colour == 1 {
        let line = shells.every.iter().map(|shell| [shell[0], shell[1]]);
        curves.push(curve("point forces", Style::Line, colour, line));
    }
    let mut data = Data::new(shells_key, &["indenters", "share", "own_load"]);
    data.rows = shells.every.iter().map(|shell| shell.to_vec()).collect();
    outcome.data.push(data);
    Ok(curves)
}

/// Load shares less the spectral ones, with what point forces predict of it.
type Pairs = Vec<(f64, f64)>;

/// Exchange of load between the levels, load-balanced circle by circle, found and predicted; and what is left of it
/// with the lattice sum.
fn exchange(key: &'static str, compared: &Comparison, leftover: &Leftover) -> Result<(Data, Pairs), StudyError> {
    let columns = [
        "indenters",
        "level",
        "share",
        "share_predicted",
        "penetration",
        "penetration_predicted",
        "own_load",
        "own_load_lattice_sum",
    ];
    let (mut data, mut pairs) = (Data::new(key, &columns), Vec::new());
    for (circle, lattice_sum) in compared.other_rule.iter().zip(&compared.circles) {
        let expected = leftover.of(circle.indenters)?;
        let penetration = circle.answer.penetration / compared.spectral.reading.penetration - 1.0;
        for (m, (level, spectral)) in circle.answer.levels.iter().zip(&compared.spectral.reading.levels).enumerate() {
            let pair = (level.load_share - spectral.load_share, expected.shares[m]);
            let number = [circle.indenters, level.level].map(|n| n as f64);
            let [balanced, whole] =
                [level.load, lattice_sum.answer.levels[m].load].map(|load| load / spectral.load - 1.0);
            let rest = [pair.0, pair.1, penetration, expected.penetration, balanced, whole];
            data.rows.push([&number[..], &rest[..]].concat());
            pairs.push(pair);
        }
    }
    Ok((data, pairs))
}

/// Errors of the meshes in a load share, in the whole load, in a peak, and in a radius, relatively: a fiftieth of the
/// 2.2/32 of the radius that an element has.
const SHARE: f64 = 1e-4;
const MESH: f64 = 5e-4;
const RADIUS_MESH: f64 = 2.2 / 32.0 / 50.0;

fn checks(
    name: &str,
    compared: &Comparison,
    shares: Pairs,
    data: &Data,
    shells: &Shells,
) -> Result<Vec<Check>, StudyError> {
    let scale = compared.stresses.iter().flat_map(|pair| pair.spectral.components()[..6].to_vec());
    let scale = scale.fold(0.0, |most: f64, stress| most.max(stress.abs()));
    let stress = compared.stresses.iter().map(StressPair::difference).fold(f64::NAN, f64::max) / scale;
    let penetrations = data.column("penetration").into_iter().zip(data.column("penetration_predicted"));
    let least = compared.spectral.reading.levels.iter().map(|level| level.load_share).fold(f64::INFINITY, f64::min);
    // Peaks and radii follow the load with a power below ½ on any layers.
    let load = shells.worst + SHARE / least;
    let follows = |mesh: f64| 0.5 * load + mesh;
    let balanced = |of: fn(&CircleComparison) -> f64| {
        let far = compared.other_rule.iter().filter(|circle| circle.indenters >= SHELLS[0]);
        far.map(of).fold(f64::NAN, f64::max)
    };
    let summed = |of: fn(&CircleComparison) -> f64| compared.circles.iter().map(of).fold(f64::NAN, f64::max);
    let below = |quantity: &str, value, bound| Check::at_most(format!("{name}: {quantity}"), value, bound);
    let last = compared.circles.last().ok_or("a circle is missing")?;
    let between = compared.circles.iter().flat_map(|circle| {
        let levels = circle.answer.levels.iter().zip(&last.answer.levels);
        levels.map(|(level, last)| (level.load, last.load))
    });
    Ok(vec![
        Check::worst(
            format!("{name}: load-balanced, load shares less the spectral ones, point forces"),
            shares,
            Tolerance::Absolute(SHARE),
        )
        .of_refinement(),
        Check::worst(
            format!("{name}: load-balanced, penetration over the spectral one less 1, point forces"),
            penetrations,
            Tolerance::Absolute(1e-3),
        )
        .of_refinement(),
        below("load-balanced, own load, 301 to 613 indenters, worst shell", balanced(|c| c.difference.load), load),
        below(
            "load-balanced, peak pressure, 301 to 613 indenters",
            balanced(|c| c.difference.max_pressure),
            follows(MESH),
        ),
        below(
            "load-balanced, contact radius, 301 to 613 indenters",
            balanced(|c| c.difference.contact_radius),
            follows(RADIUS_MESH),
        ),
        below("lattice sum, own load, 7 to 613 indenters", summed(|c| c.difference.load), 1e-3),
        below("lattice sum, peak pressure, 7 to 613 indenters", summed(|c| c.difference.max_pressure), 1e-3),
        below("lattice sum, contact radius, 7 to 613 indenters", summed(|c| c.difference.contact_radius), RADIUS_MESH),
        below("lattice sum, penetration, 7 to 613 indenters", summed(|c| c.difference.penetration), 1e-3),
        below("lattice sum, stresses over the largest, 613 indenters", stress, 1e-3),
        Check::worst(
            format!("{name}: lattice sum, own load, that with 613 indenters"),
            between,
            Tolerance::Relative(1e-6),
        )
        .of_refinement(),
    ])
}
