//! Counterbody, half-space and grid of a case in words, every length and pressure with its unit.

use super::number::{number, with_error};
use percoat_case::units::{Unit, Units};
use percoat_core::body::{Durability, Fatigue, HalfSpace, Interface, Layer, Material, Side, StrainDirection};
use percoat_core::counterbody::{
    Counterbody, GivenPressure, Indenters, LoadedBy, LoadedDisc, Shape, Topography, half_angle,
};
use percoat_core::lattice::{Cell, Grid};
use percoat_core::problem::Problem;

/// A length with its unit, five digits.
pub(super) fn length(units: &Units, x: f64) -> String {
    units.length().with_unit(x, number)
}

/// A pressure with its unit, five digits.
pub(super) fn pressure(units: &Units, x: f64) -> String {
    units.pressure().with_unit(x, number)
}

/// A load in the quantity of the units.
pub(super) fn load_with_error(units: &Units, x: f64, error: Option<f64>) -> String {
    let prefixed = units.load().prefixed(x);
    prefixed.behind(&with_error(prefixed.shown(x), error.map(|error| prefixed.shown(error))))
}

/// A number in a compound unit without a prefix; `of` joins the names of `units`.
fn compound(x: f64, units: &[&Unit], of: impl Fn(&[String]) -> String) -> String {
    match units.iter().map(|unit| unit.name()).collect::<Option<Vec<String>>>() {
        Some(names) => format!("{}\u{a0}{}", number(x), of(&names)),
        None => number(x),
    }
}

fn area(units: &Units, x: f64) -> String {
    compound(x, &[units.length()], |names| format!("{}²", names[0]))
}

fn cell(units: &Units, cell: Cell) -> String {
    if let Some(sides) = cell.window_sides() {
        let [width, height] = sides.map(|side| length(units, side));
        return format!("isolated contact in a window of {width} × {height}");
    }
    let vectors = cell.vectors();
    let prefixed = units.length().suited(vectors.into_iter().flatten());
    let [a1, a2] = vectors.map(|[x, y]| {
        let [x, y] = [x, y].map(|x| number(prefixed.shown(x)));
        prefixed.behind(&format!("({x}, {y})"))
    });
    format!("cell a₁ = {a1}, a₂ = {a2}, area {}", area(units, cell.area()))
}

fn shape(units: &Units, shape: &Shape) -> String {
    let sizes = match *shape {
        Shape::Paraboloid { radius } | Shape::Sphere { radius } => format!("radius {}", length(units, radius)),
        Shape::Cone { slope } => format!("slope {}", number(slope)),
        Shape::Power { coefficient, exponent } => {
            let coefficient =
                compound(coefficient, &[units.length()], |names| format!("{}^{}", names[0], 1.0 - exponent));
            format!("coefficient {coefficient}, exponent {}", number(exponent))
        }
        Shape::SpheroCone { radius, slope } => {
            format!("radius {}, half angle {:.2}°", length(units, radius), half_angle(slope))
        }
        Shape::Measured(ref tip) => {
            let [least, most] = tip.range().map(|radius| length(units, radius));
            format!("radii {least} to {most}")
        }
    };
    format!("{}, {sizes}", shape.name())
}

/// A given pressure in words, one line a disc.
fn given_pressure(units: &Units, given: &GivenPressure) -> String {
    if let Some(values) = given.values() {
        return format!("pressure given at {} × {} samples", values.nrows(), values.ncols());
    }
    let discs = (1..).zip(given.loaded_discs()).map(|(number, disc): (usize, &LoadedDisc)| {
        let [x, y, radius] = [disc.centre[0], disc.centre[1], disc.radius].map(|x| length(units, x));
        format!("\ndisc {number}: radius {radius} around ({x}, {y}), pressure {}", pressure(units, disc.pressure))
    });
    format!("pressure given on discs{}", discs.collect::<String>())
}

/// The cell and what loads the body in it in words, one line a level.
pub(super) fn loaded_by(units: &Units, problem: &Problem) -> String {
    let what = match problem.loaded_by() {
        LoadedBy::Pressure(given) => format!(", {}", given_pressure(units, given)),
        LoadedBy::Counterbody(Counterbody::Topography(heights)) => format!(", {}", topography(units, heights)),
        LoadedBy::Counterbody(Counterbody::Indenters(all)) => match problem.lone_indenter() {
            Some(level) => format!("\n{}: {}", problem.level_name(1), shape(units, level.shape())),
            None => format!(", {}", indenters(units, all)),
        },
    };
    format!("{}{what}", cell(units, problem.cell()))
}

/// A topography in words.
fn topography(units: &Units, topography: &Topography) -> String {
    let [n1, n2] = topography.points();
    let ball = topography.ball();
    let ball = ball.map_or(String::new(), |radius| format!(" on a ball of radius {}", length(units, radius)));
    format!("topography of {n1} × {n2} samples{ball}")
}

/// Indenters in words, one line a level.
fn indenters(units: &Units, indenters: &Indenters) -> String {
    let counts: Vec<String> = indenters.lattice().sites().iter().map(|sites| sites.len().to_string()).collect();
    let levels = (1..).zip(indenters.levels().iter().zip(indenters.drops()));
    let levels = levels.map(|(index, (level, drop)): (usize, _)| {
        format!("\nlevel {index}: {}, drop {}", shape(units, level.shape()), length(units, drop))
    });
    format!("indenters per level: {}{}", counts.join(", "), levels.collect::<String>())
}

fn material(units: &Units, material: Material) -> String {
    let [young, shear, contact] =
        [material.young(), material.shear(), material.contact_modulus()].map(|x| pressure(units, x));
    // Without the rounding of Poisson's ratios within a graded layer.
    let poisson = (1e9 * material.poisson()).round() / 1e9;
    format!("E {young}, ν {poisson}, G {shear}, E* {contact}")
}

fn interface(units: &Units, interface: Interface) -> String {
    let Interface::Spring { tangential, normal } = interface else { return interface.to_string() };
    let [tangential, normal] = [tangential, normal]
        .map(|x| compound(x, &[units.pressure(), units.length()], |names| format!("{}/{}", names[0], names[1])));
    format!("spring, tangential stiffness {tangential}, normal stiffness {normal}")
}

/// Layers and substrate of the body, one a line, then those of an elastic counterbody, or what a rigid one bears, and the largest
/// pressure.
pub(super) fn bodies(units: &Units, problem: &Problem) -> String {
    let bodies = problem.bodies();
    let body = half_space(units, bodies.body());
    let above = match bodies.counterbody() {
        Some(above) => format!("\ncounterbody, from its surface inward:\n{}", half_space(units, above)),
        None if problem.kind().is_given => String::new(),
        None => {
            let borne = durability(units, bodies.surface_durability(Side::Counterbody), None);
            format!("\ncounterbody: rigid{borne}")
        }
    };
    let most = problem.largest_hardness().map_or(String::new(), |(hardness, side)| {
        let composite = problem.composite_hardness();
        let composite = composite
            .map_or(String::new(), |composite| format!(" or of what lies below it, by the penetration; {composite}"));
        format!(
            "\npressure: at most {}, the hardness of the surface of the {side}{composite}",
            pressure(units, hardness)
        )
    });
    format!("{body}{above}{most}")
}

/// Hardness, wear and fatigue of a material and the interface below it, in a line of their own; empty without any.
fn durability(units: &Units, durability: Durability, interface: Option<Fatigue>) -> String {
    let law = |law: Fatigue, stress: &str| {
        let [passes, exponent] = [law.passes(), law.exponent()].map(number);
        format!("{passes} passes with a range of {stress} of {}, exponent {exponent}", pressure(units, law.amplitude()))
    };
    let parts = [
        durability.hardness.map(|hardness| format!("hardness {}", pressure(units, hardness))),
        durability
            .wear
            .map(|wear| format!("wear {}", compound(wear, &[units.pressure()], |names| format!("1/{}", names[0])))),
        durability.fatigue.map(|fatigue| format!("fatigue after {}", law(fatigue, "τ₁"))),
        durability.endurance.map(|endurance| {
            let [torsion, bending] = [endurance.torsion(), endurance.bending()].map(|limit| pressure(units, limit));
            format!("endurance {torsion} in torsion, {bending} in bending")
        }),
        durability.strain_life.map(|law| {
            let [passes, strain, exponent] = [law.passes(), 1e6 * law.strain(), law.exponent()].map(number);
            let counted = match law.direction() {
                StrainDirection::Tension => "horizontal strain",
                StrainDirection::Compression => "vertical compression",
            };
            format!("lasts {passes} passes of the {counted} {strain} µε, exponent {exponent}")
        }),
        interface.map(|fatigue| format!("lower face: fatigue after {}", law(fatigue, "its shear"))),
    ];
    let parts: Vec<String> = parts.into_iter().flatten().collect();
    if parts.is_empty() { String::new() } else { format!("\n  {}", parts.join("; ")) }
}

/// Layers and substrate, each in a line, and in the next one what it bears.
fn half_space(units: &Units, half_space: &HalfSpace) -> String {
    let substrate = half_space.substrate().material();
    let layers = (1..).zip(half_space.layers()).map(|(index, layer): (usize, &Layer)| {
        let residual = match layer.residual_stress() {
            0.0 => String::new(),
            residual => format!(", σ_r {}", pressure(units, residual)),
        };
        let ratio =
            substrate.map_or(String::new(), |base| format!("χ {}, ", number(layer.material().shear() / base.shear())));
        format!(
            "layer {index}{}: thickness {}, {ratio}{}, {}{residual}{}\n",
            layer.material().name_behind(),
            length(units, layer.thickness()),
            material(units, layer.material()),
            interface(units, layer.interface()),
            durability(units, layer.durability(), layer.interface_fatigue())
        )
    });
    let substrate = substrate.map_or("rigid base".to_owned(), |substrate| {
        let borne = half_space.durabilities().last().map_or(String::new(), |last| durability(units, last, None));
        format!("substrate{}: {}{borne}", substrate.name_behind(), material(units, substrate))
    });
    layers.collect::<String>() + &substrate
}

/// Points of the grid and their spacing.
pub(super) fn grid(units: &Units, grid: &Grid) -> String {
    let [n1, n2] = grid.points();
    format!(
        "grid {n1} × {n2}, spacing {}, sample area {}",
        length(units, grid.spacing()),
        area(units, grid.sample_area())
    )
}
