//! Warnings about a case that can be solved but is implausible: units mixed up, strains that are not small.

use super::{adhesion, ball, durability, si_sizes, silent, springs, sublayers};
use crate::case::{Case, LayerSection, LevelSection};
use percoat_core::body::{HalfSpace, Material, MeanStress};
use percoat_core::counterbody::{Level, Shape, Topography, half_angle};
use percoat_core::lattice::Cell;
use percoat_core::notation::number;
use percoat_core::run::words::{HIGH, STEEP, ratio};

/// Ratio of two lengths, or two moduli, beyond which they are probably not in one unit.
const APART: f64 = 1e4;
const MODULI_APART: f64 = 1e3;
/// Coefficient of friction beyond which it is implausible.
const ROUGH: f64 = 2.0;

const SUBSTRATE: &str = "the substrate";
const COUNTERBODY: &str = "the counterbody";

/// Warnings about a case before it is solved, a sentence each.
pub fn of_case(case: &Case) -> Vec<String> {
    let (problem, cell) = (case.problem(), case.problem().cell());
    let mut doubts: Vec<String> = pressures(case).into_iter().collect();
    doubts.extend(moduli(case));
    let named: Vec<(Material, String)> = materials(case).collect();
    doubts.extend(si_sizes::doubts(case, &named));
    doubts.extend(strengths(case));
    doubts.extend(durability::doubts(case, &named));
    doubts.extend(friction(case));
    doubts.extend(adhesion::doubts(case));
    doubts.extend(springs::drifting(case, cell));
    doubts.extend(lengths(case, cell));
    doubts.extend(ball::doubts(case));
    doubts.extend(sublayers::doubt(case));
    if problem.indenters().is_some() {
        doubts.extend(heights(problem.levels(), cell));
    }
    doubts.extend(equal_areas(case));
    let levels = case.levels.iter().zip(problem.levels()).enumerate();
    doubts.extend(levels.filter_map(|(index, (section, level))| steep_cone(index, section, level)));
    doubts.extend(problem.topography().and_then(topography));
    doubts.extend(silent::doubts(case, &named));
    doubts.extend_from_slice(case.file_doubts());
    if case.stress.as_ref().is_some_and(|stress| stress.mean == MeanStress::HalfSpace) {
        doubts.extend(springs::slipping(case, cell));
    }
    doubts
}

/// Names of the layers of a half-space in the case: `layers[0]`, or one of its sublayers.
fn names<'a>(layers: &'a [LayerSection], prefix: &'static str) -> impl Iterator<Item = String> + use<'a> {
    layers.iter().enumerate().flat_map(move |(number, layer)| {
        let (of, graded) = (layer.sublayers(), layer.graded.is_some());
        let name = move |sublayer| match graded {
            true => format!("{prefix}layers[{number}], its sublayer {sublayer} of {of}"),
            false => format!("{prefix}layers[{number}]"),
        };
        (1..=of).map(name)
    })
}

/// A mean pressure, or a given pressure, that is high beside a modulus. The window of an isolated contact says nothing about what it bears.
fn pressures(case: &Case) -> Option<String> {
    let (material, name) = materials(case).min_by(|a, b| a.0.young().total_cmp(&b.0.young()))?;
    let highest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
    let (pressure, load) = if let Some(given) = case.problem().given_pressure() {
        (given.highest(), format!("the highest load.pressure, {},", number(given.highest())))
    } else {
        let loads = case.problem().cell().surroundings().per_cell(case.mean_pressures()?)?;
        let (pressure, value) = (highest(&loads), number(highest(case.load.values())));
        let in_time = case.time.is_some();
        match case.load.quantity() {
            "force" => {
                let key = if in_time { "time.force" } else { "load.force" };
                (pressure, format!("{key} = {value}, a mean pressure of {} on the cell,", number(pressure)))
            }
            _ if in_time => (pressure, format!("time.load = {value}")),
            quantity => (pressure, format!("load.{quantity} = {value}")),
        }
    };
    let part = pressure / material.young();
    (part > HIGH).then(|| {
        format!(
            "{load} is {} of Young's modulus {} of {name}: strains are not small any more; are load and moduli in one unit, not \
             one in MPa and the other in GPa?",
            ratio(part),
            number(material.young())
        )
    })
}

/// Every material of both bodies with its name.
fn materials(case: &Case) -> impl Iterator<Item = (Material, String)> {
    let below = names(&case.layers, "").chain((!case.substrate.rigid.0).then(|| SUBSTRATE.to_owned()));
    let above = case.counterbody.iter().flat_map(|above| names(&above.layers.0, "counterbody."));
    let is_elastic = case.counterbody.as_ref().is_some_and(|above| !above.rigid.0);
    let above = above.chain(is_elastic.then(|| COUNTERBODY.to_owned()));
    case.problem().bodies().each().flat_map(HalfSpace::materials).zip(below.chain(above))
}

/// Young's moduli whose largest ratio is implausible.
fn moduli(case: &Case) -> Option<String> {
    let by_young = |a: &(Material, String), b: &(Material, String)| a.0.young().total_cmp(&b.0.young());
    let (stiff, stiff_name) = materials(case).max_by(by_young)?;
    let (soft, soft_name) = materials(case).min_by(by_young)?;
    let times = stiff.young() / soft.young();
    (times > MODULI_APART).then(|| {
        format!(
            "Young's modulus {} of {stiff_name} is {} times the {} of {soft_name}: are both in one unit, not one in MPa and \
             the other in GPa?",
            number(stiff.young()),
            ratio(times),
            number(soft.young())
        )
    })
}

/// Strengths and residual stresses that are implausibly large beside Young's modulus.
fn strengths(case: &Case) -> Vec<String> {
    let bodies = || case.problem().bodies().each();
    let stresses = bodies().flat_map(HalfSpace::residual_stresses).map(f64::abs);
    let all = materials(case).zip(bodies().flat_map(HalfSpace::strengths)).zip(stresses);
    let doubts = all.flat_map(|(((material, name), strength), residual)| {
        let of = [("yield_strength", strength.yielding), ("tensile_strength", strength.tensile)];
        let strengths = of.into_iter().filter_map(|(key, value)| Some((key, value?)));
        let high = strengths.chain([("residual_stress", residual)]).filter(move |(_, value)| *value > HIGH * material.young());
        high.map(move |(key, value)| {
            format!(
                "{key} of {name} is {} of its Young's modulus {}: are both in one unit, not one in MPa and the other in GPa?",
                ratio(value / material.young()),
                number(material.young())
            )
        })
        .collect::<Vec<_>>()
    });
    doubts.collect()
}

fn friction(case: &Case) -> Option<String> {
    let coefficient = case.problem().friction()?.coefficient();
    (coefficient > ROUGH).then(|| {
        format!("friction.coefficient = {} is more than surfaces have: is it in per cent?", number(coefficient))
    })
}

/// Radii and thicknesses that are implausibly small or large beside the cell.
fn lengths(case: &Case, cell: Cell) -> Vec<String> {
    let [side, other] = cell.vectors().map(|[x, y]| x.hypot(y));
    let side = side.min(other);
    let mut all: Vec<(String, f64)> = Vec::new();
    for (number, (section, level)) in case.levels.iter().zip(case.problem().levels()).enumerate() {
        all.extend(section.apex_radius().map(|(key, radius)| (format!("levels[{number}].{key}"), radius)));
        // The radius of the paraboloid with the slope of the profile there.
        if let Shape::Power { coefficient, exponent } = *level.shape()
            && exponent > 1.0
        {
            let slope = coefficient * exponent * side.powf(exponent - 1.0);
            all.push((format!("levels[{number}]: the side of the cell over the slope of c·rⁿ there"), side / slope));
        }
    }
    let layers = case.layers.iter().enumerate();
    all.extend(
        layers.map(|(number, layer): (usize, &LayerSection)| (format!("layers[{number}].thickness"), layer.thickness)),
    );
    let odd = all.into_iter().filter(|(_, length)| !(side / APART..=side * APART).contains(length));
    odd.map(|(key, length)| {
        format!(
            "{key} = {} is {} times the side {} of the cell: are all lengths in one unit, not some in metres and others in \
             micrometres?",
            number(length),
            ratio(length / side),
            number(side)
        )
    })
    .collect()
}

/// Heights whose differences are lost in rounding, or are larger than the cell.
fn heights(levels: &[Level], cell: Cell) -> Option<String> {
    let largest = levels.iter().map(|level| level.height().abs()).fold(0.0, f64::max);
    let side = cell.reduced().longer_side();
    let reach = levels.iter().map(|level| level.shape().profile(side)).fold(f64::INFINITY, f64::min);
    (largest > 1e6 * side.max(reach)).then(|| {
        format!(
            "heights up to {} beside a cell of side {}: only differences of heights matter, and their digits are lost; are \
             all lengths in one unit?",
            number(largest),
            number(side)
        )
    })
}

/// Pyramids and measured tips, which are taken as round.
fn equal_areas(case: &Case) -> Option<String> {
    let levels = case
        .levels
        .iter()
        .zip(case.problem().levels())
        .enumerate()
        .filter(|(_, (section, _))| section.is_of_equal_area());
    let told = levels.map(|(index, (section, level))| {
        let angle = match *level.shape() {
            Shape::Cone { slope } | Shape::SpheroCone { slope, .. } => {
                format!(", half angle {:.2}°", half_angle(slope))
            }
            _ => String::new(),
        };
        format!("levels[{index}] ({}{angle})", section.shape.word())
    });
    let told: Vec<String> = told.collect();
    (!told.is_empty()).then(|| {
        format!(
            "{}: taken as round, with the area of the tip at each depth; edges of a pyramid, where pressure and stress are higher, are not \
             resolved",
            told.join(", ")
        )
    })
}

fn steep_cone(index: usize, section: &LevelSection, level: &Level) -> Option<String> {
    let Shape::Cone { slope } = *level.shape() else { return None };
    let given = match section.slope {
        Some(_) => format!("slope = {}", number(slope)),
        None => format!("shape = \"{}\", of the slope {}", section.shape.word(), number(slope)),
    };
    (slope > STEEP).then(|| {
        format!(
            "levels[{index}].{given}: the flank of a cone must be flat against the surface for small strains, its slope below \
             {STEEP}"
        )
    })
}

/// A topography with an implausible rms slope.
fn topography(topography: &Topography) -> Option<String> {
    let ([n1, n2], heights) = (topography.points(), topography.heights());
    let [step1, step2] = [(0, n1), (1, n2)].map(|(axis, n)| {
        let [x, y] = topography.cell().vectors()[axis];
        x.hypot(y) / n as f64
    });
    let squares = heights.indexed_iter().map(|((i, j), height)| {
        let along = (heights[[(i + 1) % n1, j]] - height) / step1;
        let across = (heights[[i, (j + 1) % n2]] - height) / step2;
        along * along + across * across
    });
    let slope = (squares.sum::<f64>() / heights.len() as f64).sqrt();
    let told = match slope {
        steep if steep > 2.0 => "steeper than any surface whose contact is one of small strains",
        flat if flat > 0.0 && flat < 1e-8 => "flatter than atoms allow",
        _ => return None,
    };
    Some(format!("surface.heights: the mean slope is {}, {told}: are heights and the cell in one unit?", number(slope)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::embedded;

    fn doubts(name: &str, overrides: &[&str]) -> Vec<String> {
        let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
        let case = Case::read(&embedded::source(name).unwrap(), &overrides).unwrap_or_else(|error| panic!("{error}"));
        // A grid that is coarse at the lowest load is not implausible.
        let foreseen = crate::case::foreseen(&case, &[]).into_iter().filter(|doubt| !doubt.contains("grid.points"));
        of_case(&case).into_iter().chain(foreseen).collect()
    }

    #[test]
    fn the_embedded_cases_are_not_doubted() {
        for (name, _) in embedded::all() {
            assert_eq!(doubts(name, &[]), Vec::<String>::new(), "{name}");
        }
    }

    #[test]
    fn mixed_units_are_named() {
        for (overrides, words) in [
            (&["load.mean_pressure=60"][..], &["load.mean_pressure", "MPa", "GPa"][..]),
            (&["lattice.period=1e-6"], &["levels[0].radius", "metres", "layers[0].thickness"]),
            (&["levels.0.radius=1e-6"], &["levels[0].radius = 1.0000e-6"]),
            (&["levels.0.height=1e9"], &["only differences of heights matter"]),
            (&["levels.0.slope=3", "levels.0.shape=cone"], &["levels[0].slope", "cone"]),
            (&["substrate.young=210", "layers.0.young=450000"], &["Young's modulus 450000", "2.1e3 times", "MPa"]),
            (&["substrate.yield_strength=2"], &["yield_strength of the substrate is 2.0", "MPa"]),
            (&["layers.0.residual_stress=-30"], &["residual_stress of layers[0]"]),
            (&["friction.coefficient=15"], &["friction.coefficient = 15", "per cent"]),
            (&["levels.2.radius=0.05"], &["level 3", "of a single contact"]),
            (
                &["lattice.period=1e-6", "levels.0.shape=power", "levels.0.coefficient=0.6", "levels.0.exponent=2"],
                &["levels[0]: the side of the cell over the slope of c·rⁿ there = 0.83333", "metres"],
            ),
        ] {
            let said = doubts("fig2", overrides).join("\n");
            for word in words {
                assert!(said.contains(word), "{overrides:?}: \"{word}\" does not stand in\n{said}");
            }
        }
    }

    #[test]
    fn a_load_is_named_by_the_key_that_the_case_has() {
        for (name, set, words) in [
            (
                "fig2",
                "load.mean_pressure=60",
                "load.mean_pressure = 60.000 is 60.00 of Young's modulus 1.0000 of the substrate",
            ),
            (
                "fig2",
                "load.force=200",
                "load.force = 200.00, a mean pressure of 76.980 on the cell, is 76.98 of Young's modulus 1.0000 of the substrate",
            ),
            ("rubber-creep", "time.force=[[0.0, 0.0], [200.0, 9e5]]", "time.force = "),
            (
                "pavement",
                "load.pressure.value=60",
                "the highest load.pressure, 60.000, is 1.20 of Young's modulus 50.000 of the substrate",
            ),
        ] {
            let said = doubts(name, &[set]).join("\n");
            assert!(said.contains(words) && said.matches("Young's modulus").count() == 1, "{set}: {said}");
        }
    }

    #[test]
    fn a_sublayer_is_named_by_its_layer() {
        let graded = "{ young = [2.0, 1e-3], poisson = [0.2, 0.3], sublayers = 20 }";
        let layers =
            format!("layers=[{{ thickness = 0.5, young = 2, poisson = 0.3 }}, {{ thickness = 1, graded = {graded} }}]");
        let said = doubts("fig2", &[&layers, "load.mean_pressure=0.5"]).join("\n");
        assert!(said.contains("of layers[1], its sublayer 20 of 20:"), "{said}");
        let said =
            doubts("fig2", &["load.mean_pressure=60", "substrate.young=1e3", "layers.0.shear_ratio=1e-3"]).join("\n");
        assert!(said.contains("of layers[0]:"), "{said}");
        let spring = "interface = { tangential_stiffness = 1e-3 }";
        let layers =
            format!("layers=[{{ thickness = 1, graded = {{ young = [2.0, 1.0], poisson = [0.2, 0.3] }}, {spring} }}]");
        let said = doubts("fig2", &[&layers, "stress.mean=half-space"]).join("\n");
        assert!(said.contains("the spring under layers[0] ("), "{said}");
    }

    #[test]
    fn a_topography_of_micrometres_on_a_cell_of_metres_is_doubted_either_way() {
        let cell = Cell::square(1.0).unwrap();
        let waves = |height: f64| {
            let wave = |(_, j): (usize, usize)| height * (j as f64 * std::f64::consts::FRAC_PI_4).cos();
            Topography::new(cell, ndarray::Array2::from_shape_fn((8, 8), wave)).unwrap()
        };
        assert!(topography(&waves(1e3)).unwrap().contains("steeper"));
        assert!(topography(&waves(1e-10)).unwrap().contains("flatter"));
        assert_eq!(topography(&waves(0.01)), None);
        assert_eq!(topography(&waves(0.0)), None);
    }
}
