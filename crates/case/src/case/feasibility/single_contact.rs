//! Warnings about a case before it is solved, by the formulas of single contacts.

use crate::case::{Case, LevelSection};
use crate::units::Unit;
use percoat_core::body::Bodies;
use percoat_core::counterbody::{Level, Shape};
use percoat_core::lattice::{Grid, Lattice};
use percoat_core::notation::number;
use percoat_core::reading::FEW_SAMPLES;
use percoat_core::run::Sampling;
use percoat_core::run::warnings::flank;
use percoat_core::run::words::{STEEP, ratio};

/// Width of a window over that of the contact from which on a smaller window is advised.
const WIDE: f64 = 6.0;
/// Width of a window over that of the contact that leaves room enough.
const ROOM: f64 = 1.3;
/// qa of the waves by whose compliance the contact radius a is foreseen, from to.
const CONTACT_WAVES: [f64; 2] = [1.5, 3.0];

/// Warnings about steep flanks at the highest load and few samples at the lowest. `touches` are the mean pressures of first touch
/// of the levels, where known. Closed forms without tension say nothing of surfaces that adhere.
pub fn foreseen(case: &Case, touches: &[Option<f64>]) -> Vec<String> {
    // The formulas are those of surfaces that do not pull.
    if case.adhesion.is_some() {
        return Vec::new();
    }
    let flanks = steep_flank(case).or_else(|| steep_ball(case));
    flanks.into_iter().chain(few_samples(case, touches)).chain(narrow_window(case)).collect()
}

/// A flank that is steep at the highest load; cones are not checked.
fn steep_flank(case: &Case) -> Option<String> {
    let modulus = stiffer_modulus(case.problem().bodies());
    let levels = (1..).zip(case.problem().levels().iter().map(Level::shape));
    let flanks = levels.filter(|(_, shape)| !matches!(shape, Shape::Cone { .. }));
    let mut estimates =
        flanks.filter_map(|(number, shape)| Some((number, shape, highest_radius(case, shape, modulus)?)));
    let (number, _, radius) =
        estimates.find(|&(_, shape, radius): &(usize, &Shape, f64)| shape.slope(radius) > STEEP)?;
    let question = format!("is {}?", measured(case, number - 1));
    Some(flank("by the formulas of a single contact", case.problem(), number, radius, &question))
}

/// A contact that is wide beside the ball on which its roughness stands.
fn steep_ball(case: &Case) -> Option<String> {
    let ball = rough_ball(case)?;
    let radius = highest_radius(case, &ball, stiffer_modulus(case.problem().bodies()))?;
    (ball.slope(radius) > STEEP).then(|| {
        format!(
            "by Hertz the contact radius {} is a large part of the radius {} of the ball: strains are not small any more; is {}?",
            number(radius),
            number(case.problem().topography().and_then(|topography| topography.ball()).unwrap_or_default()),
            measured(case, 0)
        )
    })
}

/// The ball on which a topography stands.
fn rough_ball(case: &Case) -> Option<Shape> {
    Some(Shape::Sphere { radius: case.problem().topography()?.ball()? })
}

/// Size of a level, by its index, or of the ball below a roughness, and load with the units in which the case has them: "levels\[0\].radius in µm, and load.force in mN".
pub(super) fn measured(case: &Case, index: usize) -> String {
    let (units, quantity) = (case.units(), case.load.quantity());
    let named = |unit: &Unit, other: &str| unit.name().unwrap_or_else(|| other.to_owned());
    let length = named(units.length(), "the unit of the other lengths");
    let load = match quantity {
        "force" => named(&units.force(), "the unit of pressure times that of length squared"),
        "penetration" => length.clone(),
        _ => named(units.pressure(), "the unit of the moduli"),
    };
    let size = match case.levels.get(index).map(LevelSection::apex_radius) {
        Some(Some((key, _))) => format!("levels[{index}].{key}"),
        Some(None) => "every length".to_owned(),
        None => "surface.radius".to_owned(),
    };
    format!("{size} in {length}, and load.{quantity} in {load}")
}

/// An isolated contact that will hardly have room in its window at the highest load.
fn narrow_window(case: &Case) -> Option<String> {
    let cell = case.problem().cell();
    let [[width, _], [_, height]] = cell.vectors();
    if !is_lone(case) {
        return None;
    }
    let shape = case.problem().levels().first().map(Level::shape).cloned().or_else(|| rough_ball(case))?;
    let radius = layered_radius(case, &shape)?;
    (2.0 * radius > 0.9 * width.min(height)).then(|| {
        format!(
            "by the formulas of a single contact the contact will be about {} wide, and lattice.size is {}: contact must stay \
             inside the window; enlarge lattice.size to {}",
            number(2.0 * radius),
            number(width.min(height)),
            number(2.0 * ROOM * radius)
        )
    })
}

/// Few samples along the contact radius of the highest level at the lowest load, which the levels that touch carry.
fn few_samples(case: &Case, touches: &[Option<f64>]) -> Option<String> {
    let (Some(indenters), Sampling::Points(points)) = (case.problem().indenters(), &case.grid) else {
        return None;
    };
    let lattice = indenters.lattice();
    let grid = Grid::new(lattice.cell(), *points).ok()?;
    let (number_of_highest, highest) =
        (1..).zip(indenters.levels()).max_by(|a, b| a.1.height().total_cmp(&b.1.height()))?;
    let shape = highest.shape();
    let lowest = |values: &[f64]| values.iter().copied().filter(|load| *load > 0.0).reduce(f64::min);
    let prescribed = lowest(case.load.values())?;
    let radius = match case.mean_pressures() {
        Some(loads) => {
            let load = lowest(&loads)?;
            let touching =
                |level: usize| touches.get(level).is_none_or(|touch| touch.is_some_and(|touch| touch <= load));
            let sites = lattice.sites().iter().enumerate().filter(|(level, _)| touching(*level));
            let sites = sites.map(|(_, sites)| sites.len()).sum::<usize>().max(1);
            let force = load * lattice.cell().area() / sites as f64;
            shape.radius_under(force / stiffer_modulus(case.problem().bodies()))
        }
        None => shape.radius_at(prescribed),
    };
    let samples = radius / grid.sample_area().sqrt();
    (samples < FEW_SAMPLES).then(|| {
        format!(
            "at load.{} = {} the contact radius under {} will have about {samples:.1} samples, by the \
             formulas of a single contact: radii and peak pressures are rough below {FEW_SAMPLES}; raise grid.points{}",
            case.load.quantity(),
            number(prescribed),
            case.problem().level_name(number_of_highest),
            wide_window(case).unwrap_or_default()
        )
    })
}

/// Further advice where the window of an isolated contact is many times as wide as the contact, as words that go on.
fn wide_window(case: &Case) -> Option<String> {
    let cell = case.problem().cell();
    let [[width, _], [_, height]] = cell.vectors();
    let level = case.problem().levels().first()?.shape();
    let contact = 2.0 * layered_radius(case, level)?;
    let times = width.min(height) / contact;
    (is_lone(case) && times > WIDE).then(|| {
        format!(
            ", or lower lattice.size to {}: the window is {} times as wide as the contact at the highest load, with {}",
            number(ROOM * contact),
            ratio(times),
            measured(case, 0)
        )
    })
}

/// Number of indenters in the cell; one for a rough ball, `None` for another topography.
fn sites(case: &Case) -> Option<usize> {
    let of_lattice = |lattice: &Lattice| lattice.sites().iter().map(Vec::len).sum();
    let indenters = case.problem().indenters().map(|indenters| of_lattice(indenters.lattice()));
    indenters.or_else(|| rough_ball(case).map(|_| 1))
}

/// Whether one indenter or one rough ball is pressed in alone.
fn is_lone(case: &Case) -> bool {
    case.problem().kind().is_indentation() && sites(case) == Some(1)
}

/// Contact radius of an indenter of this shape alone at the highest load, of which each in the cell has its part, on a half-space of this
/// E*; `None` for a penetration of several indenters.
pub(super) fn highest_radius(case: &Case, shape: &Shape, modulus: f64) -> Option<f64> {
    let (cell, sites) = (case.problem().cell(), sites(case)?);
    let highest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
    match case.mean_pressures() {
        Some(loads) => {
            let force = highest(&loads) * cell.area() / sites as f64;
            Some(shape.radius_under(force / modulus))
        }
        None if is_lone(case) => Some(shape.radius_at(highest(case.load.values()))),
        None => None,
    }
}

/// Contact radius as [`highest_radius`], on the layered bodies: E* is that of their compliance for waves about as long as the contact is
/// wide, 2/(q C). Of Hertz' contact on a coating the one at qa between 1.5 and 3 gives the radius; the larger of both ends is taken.
fn layered_radius(case: &Case, shape: &Shape) -> Option<f64> {
    let bodies = case.problem().bodies();
    let [least, most] =
        [stiffer_modulus(bodies), softer_modulus(bodies)].map(|modulus| highest_radius(case, shape, modulus));
    let widest = |phase: f64| {
        let exceeds = |a: f64| {
            let q = phase / a;
            highest_radius(case, shape, 2.0 / (q * bodies.compliance(q))).is_some_and(|radius| radius > a)
        };
        let mut ends = [1e-3 * least?, 1e3 * most?].map(f64::ln);
        for _ in 0..40 {
            let middle = 0.5 * (ends[0] + ends[1]);
            ends[usize::from(!exceeds(middle.exp()))] = middle;
        }
        Some(ends[1].exp())
    };
    Some(widest(CONTACT_WAVES[0])?.max(widest(CONTACT_WAVES[1])?))
}

/// The larger E* of surfaces and elastic substrates, with which the radius is the smaller one.
pub(super) fn stiffer_modulus(bodies: &Bodies) -> f64 {
    let surfaces = bodies.contact_modulus();
    bodies.substrate_modulus().map_or(surfaces, |modulus| modulus.max(surfaces))
}

/// The smaller E* of surfaces and elastic substrates, with which the radius is the larger one.
pub(super) fn softer_modulus(bodies: &Bodies) -> f64 {
    let surfaces = bodies.contact_modulus();
    bodies.substrate_modulus().map_or(surfaces, |modulus| modulus.min(surfaces))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Source;

    fn case(text: &str) -> Case {
        let source = Source { name: "case".to_owned(), text: text.to_owned(), ..Source::default() };
        Case::read(&source, &[]).unwrap()
    }

    #[test]
    fn a_contact_larger_than_its_ball_is_foreseen() {
        let text = "lattice={kind=\"square\",period=10}\nlevels=[{shape=\"sphere\",radius=1}]\n\
                    substrate={young=1,poisson=0.3}\nload={mean_pressure=0.05}";
        assert!(foreseen(&case(text), &[]).join("").contains("larger than the indenter's radius 1.0000"));
    }

    /// A rough ball as a ball: too small a window, and a radius in another unit.
    #[test]
    fn the_contact_of_a_rough_ball_is_foreseen() {
        let of = |radius: f64, size: f64| {
            case(&format!(
                "lattice={{kind=\"isolated\",size={size}}}\nsurface={{radius={radius},random={{hurst=0.8,shortest={},rms_slope=1e-3}}}}\n\
                 substrate={{young=210,poisson=0.3}}\nload={{force=5000}}\ngrid={{points=32}}\nunits={{length=\"µm\",pressure=\"GPa\"}}",
                size / 4.0
            ))
        };
        assert_eq!(foreseen(&of(3000.0, 200.0), &[]), Vec::<String>::new());
        assert!(foreseen(&of(3000.0, 60.0), &[]).join("").contains("contact must stay inside the window"));
        let told = foreseen(&of(3.0, 200.0), &[]).join("");
        assert!(told.ends_with("is surface.radius in µm, and load.force in mN?"), "{told}");
    }

    /// A plate of E = 60 on E = 1: 2.0 wide, while the base alone would let it become 5.6.
    #[test]
    fn the_contact_on_a_stiff_coating_is_foreseen() {
        let of = |size: f64| {
            case(&format!(
                "lattice={{kind=\"isolated\",size={size}}}\nlevels=[{{shape=\"paraboloid\",radius=50}}]\n\
                 layers=[{{thickness=0.2,young=60,poisson=0.22}},{{thickness=0.8,young=60,poisson=0.3}}]\n\
                 substrate={{young=1,poisson=0.38}}\nload={{force=0.68247}}\ngrid={{points=96}}"
            ))
        };
        assert_eq!(foreseen(&of(3.0), &[]), Vec::<String>::new());
        let told = foreseen(&of(2.2), &[]).join("");
        assert!(told.contains("will be about 2.1"), "{told}");
        let radius = layered_radius(&of(3.0), &Shape::Paraboloid { radius: 50.0 }).unwrap();
        assert!((0.98..1.12).contains(&radius), "{radius}");
    }

    #[test]
    fn few_samples_are_foreseen_by_hertz_and_by_the_cone() {
        // a = √(Rδ) = 0.1: 5 and 20 samples of 1/50 and 1/200.
        let of = |points: usize, load: &str| {
            case(&format!(
                "lattice={{kind=\"square\",period=1}}\nlevels=[{{shape=\"paraboloid\",radius=1}}]\n\
                 substrate={{young=1,poisson=0.3}}\nload={{{load}}}\ngrid={{points={points}}}"
            ))
        };
        let told = foreseen(&of(50, "penetration=[0.01,0.02]"), &[]).join("");
        assert!(told.contains("level 1") && told.contains("about 5.0 samples"), "{told}");
        assert!(foreseen(&of(200, "penetration=[0.01,0.02]"), &[]).is_empty());
        // P = 4/3 E* a³: p̄ = 0.0014652 for a = 0.1.
        let told = foreseen(&of(50, "mean_pressure=0.0014652"), &[Some(0.0)]).join("");
        assert!(told.contains("about 5.0 samples"), "{told}");
        // The lower one of two levels takes half, nothing before it touches, and nothing where it is hidden.
        let two = case(
            "lattice={kind=\"square\",period=1}\n\
             levels=[{shape=\"paraboloid\",radius=1,sites=[[0,0]]},\
             {shape=\"paraboloid\",radius=1,height=-0.01,sites=[[0.5,0.5]]}]\n\
             substrate={young=1,poisson=0.3}\nload={mean_pressure=0.0014652}\ngrid={points=50}",
        );
        for (second, samples) in [(Some(0.001), "4.0"), (Some(0.01), "5.0"), (None, "5.0")] {
            let told = foreseen(&two, &[Some(0.0), second]).join("");
            assert!(told.contains(&format!("about {samples} samples")), "{second:?}: {told}");
        }
    }
}
