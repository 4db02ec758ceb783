//! The localized solution against what its circles should leave out, and against the spectral one.
//!
//! One level: lattice sums over the indenters inside predict contact and penetration ([`crate::exact::localization`]).
//! Three levels on four coatings: loads, pressures, radii, penetration and stresses of both methods, and the exchange of
//! load that [`super::leftover`] predicts.

use super::draw::{self, curve};
use super::leftover::Leftover;
use super::one_level::one_level;
use super::{Check, Data, Outcome, Study, StudyError, Tolerance};
use crate::comparison::{CircleComparison, Comparison, Reading, StressPair, Task};
use crate::indenter::{Level, Shape};
use crate::lattice::Lattice;
use crate::localized::{CircleRadius, Setup, Stop};
use crate::material::{HalfSpace, Interface, Layer, Material};
use crate::picture::{Axis, Chart, Curve, Style};
use crate::solver::{Control, Settings};
use crate::stress::MeanStress;

pub const STUDY: Study = Study { name: "localized", title: "Localized against spectral", run };

const RADIUS: f64 = 0.8;
/// Indenters in the circles of the three levels.
const INDENTERS: [usize; 4] = [7, 37, 301, 439];
/// Samples along the cell.
const POINTS: usize = 192;

const SETUP: Setup = Setup { indenters: 7, elements: 32, radius: CircleRadius::LoadBalanced, mutual_effect: true };

fn run() -> Result<Outcome, StudyError> {
    let mut outcome = Outcome::default();
    let first = one_level(&mut outcome)?;
    let mut second = Vec::new();
    for (colour, (names, half_space, mean_pressure)) in (1..).zip(coatings()?) {
        second.extend(coated(names, &half_space, mean_pressure, colour, &mut outcome)?);
    }
    let chart = |title: &str, y, curves| Chart {
        title: title.to_owned(),
        caption: Vec::new(),
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
                       from point forces (line, the first coating). Dashed: area-balanced circles.";

/// Names of data and checks, body and mean pressure.
type Coated = ([&'static str; 2], HalfSpace, f64);

/// The coatings; E₂ = 1, ν₂ = 0.3.
fn coatings() -> Result<[Coated; 4], StudyError> {
    let substrate = Material::from_young(1.0, 0.3)?;
    let layer = |chi: f64, nu, thickness, interface| -> Result<Layer, StudyError> {
        Ok(Layer::new(Material::from_shear(chi * substrate.shear(), nu)?, thickness, interface)?)
    };
    let body = |layers| HalfSpace::new(layers, substrate);
    Ok([
        (["hard", "hard coating"], body(vec![layer(2.0, 0.2, 0.5, Interface::Bonded)?]), 0.03),
        (["soft", "soft coating"], body(vec![layer(0.5, 0.45, 0.5, Interface::Bonded)?]), 0.008),
        (["sliding", "sliding coating"], body(vec![layer(3.0, 0.2, 0.2, Interface::Frictionless)?]), 0.02),
        (
            ["two-layers", "two layers"],
            body(vec![layer(1.2, 0.2, 0.3, Interface::Bonded)?, layer(0.5, 0.4, 0.4, Interface::Bonded)?]),
            0.02,
        ),
    ])
}

/// Three levels on one coating: its checks, its data, and its curves of panel (b).
fn coated(
    [key, name]: [&'static str; 2],
    half_space: &HalfSpace,
    mean_pressure: f64,
    colour: usize,
    outcome: &mut Outcome,
) -> Result<Vec<Curve>, StudyError> {
    let lattice = Lattice::hexagonal(1.0, 3)?;
    let level = |m: usize| Level::new(Shape::Paraboloid { radius: RADIUS }, -0.01 * m as f64);
    let levels = [level(0)?, level(1)?, level(2)?];
    let task = Task {
        lattice: &lattice,
        levels: &levels,
        half_space,
        control: Control::MeanPressure(mean_pressure),
        settings: Settings::default(),
        setup: SETUP,
        indenters: &INDENTERS,
        mean: MeanStress::Confined,
    };
    let compared = task.compare([POINTS; 2], &mut |_| ())?;
    if !compared.solution.report.stop.solved() {
        return Err(format!("{name}: {}", compared.solution.report).into());
    }
    if let Some(circle) = compared.circles.iter().find(|circle| circle.stop != Stop::Converged) {
        return Err(format!("{name}, {} indenters: {}", circle.indenters, circle.stop).into());
    }
    let leftover =
        Leftover::new(&lattice, half_space, INDENTERS[3], Reading::spectral(&compared.spectral), mean_pressure)?;
    let (data, shares) = exchange(key, &compared, &leftover)?;
    for check in checks(name, &compared, shares, &data)? {
        outcome.checks.push(check);
    }
    outcome.data.push(data);
    let share = |circle: &CircleComparison| [circle.indenters as f64, circle.difference.load_share];
    let mut curves = vec![
        curve(name, Style::Markers, colour, compared.circles.iter().map(share)),
        curve("", Style::Dashed, colour, compared.other_rule.iter().map(share)),
    ];
    if colour == 1 {
        let mut line: Vec<[f64; 2]> = Vec::new();
        for asked in 1..=INDENTERS[3] {
            let inside = leftover.indenters(asked);
            if line.last().is_none_or(|last| last[0] < inside as f64) {
                let shares = leftover.of(asked)?.shares;
                line.push([inside as f64, shares.into_iter().map(f64::abs).fold(0.0, f64::max)]);
            }
        }
        let mut data = Data::new("point-forces", &["indenters", "share"]);
        data.rows = line.iter().map(|point| point.to_vec()).collect();
        outcome.data.push(data);
        curves.push(curve("point forces", Style::Line, colour, line));
    }
    Ok(curves)
}

/// Load shares less the spectral ones, with what point forces predict of it.
type Pairs = Vec<(f64, f64)>;

/// What changes hands between the levels, circle by circle, found and predicted.
fn exchange(key: &'static str, compared: &Comparison, leftover: &Leftover) -> Result<(Data, Pairs), StudyError> {
    let columns = ["indenters", "level", "share", "share_predicted", "penetration", "penetration_predicted"];
    let (mut data, mut pairs) = (Data::new(key, &columns), Vec::new());
    for circle in &compared.circles {
        let expected = leftover.of(circle.indenters)?;
        let penetration = circle.reading.penetration / compared.spectral.penetration - 1.0;
        for (m, (level, spectral)) in circle.reading.levels.iter().zip(&compared.spectral.levels).enumerate() {
            let pair = (level.load_share - spectral.load_share, expected.shares[m]);
            let number = [circle.indenters, level.level].map(|n| n as f64);
            let rest = [pair.0, pair.1, penetration, expected.penetration];
            data.rows.push([&number[..], &rest[..]].concat());
            pairs.push(pair);
        }
    }
    Ok((data, pairs))
}

fn checks(name: &str, compared: &Comparison, shares: Pairs, data: &Data) -> Result<Vec<Check>, StudyError> {
    let [_, _, shells, largest] = &compared.circles[..] else { return Err("a circle is missing".into()) };
    let area = &compared.other_rule[2];
    let scale = compared.stresses.iter().flat_map(|pair| pair.spectral.components()[..6].to_vec());
    let scale = scale.fold(0.0, |most: f64, stress| most.max(stress.abs()));
    let stress = compared.stresses.iter().map(StressPair::difference).fold(f64::NAN, f64::max) / scale;
    let penetrations = data.column("penetration").into_iter().zip(data.column("penetration_predicted"));
    let below = |quantity: &str, value, bound| Check::at_most(format!("{name}: {quantity}"), value, bound);
    let [far, near] = [largest.difference, shells.difference];
    Ok(vec![
        Check::worst(
            format!("{name}: load shares less the spectral ones, point forces"),
            shares,
            Tolerance::Absolute(1e-4),
        )
        .of_refinement(),
        Check::worst(
            format!("{name}: penetration over the spectral one less 1, point forces"),
            penetrations,
            Tolerance::Absolute(1e-3),
        )
        .of_refinement(),
        below("load shares, 301 indenters", near.load_share, 1e-3),
        below("load shares, 439 indenters", far.load_share, 3e-4),
        below("peak pressure, 439 indenters", far.max_pressure, 1e-3),
        below("contact radius, 439 indenters", far.contact_radius, 1e-3),
        below("penetration, 439 indenters", far.penetration, 1e-3),
        below("stresses over the largest, 439 indenters", stress, 1e-3),
        Check::at_least(
            format!("{name}: load shares, area- over load-balanced, 301 indenters"),
            area.difference.load_share / near.load_share,
            10.0,
        ),
    ])
}
