//! The damage that a pass does below the surface, with the interfaces; and the course of a life over the passes.

use super::snapshot::{Snapshot, caption};
use crate::picture::labels::Labels;
use percoat_case::units::Units;
use percoat_case::words::AroundWords;
use percoat_core::body::Fatigue;
use percoat_core::life::{Course, Event, EventKind};
use percoat_core::problem::Problem;
use percoat_core::reading::{FatigueReading, READING};
use percoat_core::stress::RangePlane;
use percoat_draw::axis::Axis;
use percoat_draw::bar::Bar;
use percoat_draw::canvas::{Canvas, Dash, Stroke};
use percoat_draw::chart::{Chart, plots};
use percoat_draw::colour::{Colour, ColourMap};
use percoat_draw::curve::{Curve, Style};
use percoat_draw::map::{Fill, Map, Over};
use percoat_draw::scale::Scale;
use percoat_draw::sheet::sheet;

/// Height over width of the map, least and largest.
const ASPECT: [f64; 2] = [0.4, 1.1];
/// Least damage shown, over the largest.
const LEAST: f64 = 1e-6;

/// The damage in a pass over y and z: of each material by its law, from the ranges of τ₁ on planes; `None` without any.
pub fn damage(snapshot: &Snapshot, fatigue: &FatigueReading, planes: &[RangePlane]) -> Option<Canvas> {
    let half_space = snapshot.step.problem().half_space();
    let laws: Vec<Option<Fatigue>> = half_space.durabilities().map(|durability| durability.fatigue).collect();
    let of = |material: usize, range: f64| laws[material - 1].map_or(0.0, |law| law.damage(range));
    let damages = |plane: &RangePlane| -> Vec<f64> {
        plane.lines.iter().map(|[_, range]| of(plane.depth.material, *range)).collect()
    };
    let most = planes.iter().flat_map(damages).filter(|damage| damage.is_finite()).fold(0.0, f64::max);
    if most <= 0.0 {
        return None;
    }
    let [ex, ey] = snapshot.step.problem().direction();
    let worst = fatigue.first;
    let across = worst.position[1] * ex - worst.position[0] * ey;
    let [first, last] = about(planes, across)?;
    // Down to where damage is next to nothing.
    let visible = planes.iter().filter(|plane| damages(plane).iter().any(|damage| *damage > LEAST * most));
    let depth = 1.1 * visible.map(|plane| plane.depth.z).fold(0.0, f64::max);
    let value = |[y, z]: [f64; 2]| {
        let z = z.max(0.0);
        let material = half_space.depths(z).last()?.material;
        let damage = of(material, between_planes(planes, material, [y, z])?);
        Some(damage).filter(|damage| *damage > LEAST * most)
    };
    let bar = Bar {
        label: "damage in a pass, Q".into(),
        colours: ColourMap::Sequential,
        span: [LEAST * most, most],
        scale: Scale::Log,
        apart: false,
        without: Colour::WHITE,
    };
    let width = (last - first).max(f64::MIN_POSITIVE);
    let y = Axis::linear(snapshot.units.length_of("across the path", "y")).from_to(first, last);
    let z = Axis::linear(snapshot.units.length_of("depth", "z")).from_to(depth, 0.0);
    let interface = |&face: &f64| {
        (face < depth).then(|| {
            Over::Line(Stroke {
                points: vec![[first, face], [last, face]],
                width: 0.8,
                dash: Dash::Solid,
                colour: Colour::BLACK,
            })
        })
    };
    let mut over: Vec<Over> = half_space.interface_depths().iter().filter_map(interface).collect();
    if worst.position[2] <= depth && worst.part.is_followed() {
        over.push(Over::Mark { at: [across.clamp(first, last), worst.position[2]], colour: Colour::WHITE });
    }
    let map = Map {
        title: String::new(),
        x: y,
        y: z,
        aspect: (depth / width).clamp(ASPECT[0], ASPECT[1]),
        fill: Fill::Values(bar, &value),
        over,
    };
    let words = format!(
        "First: {}. Lines: interfaces; cross: where damage is largest; white: less than a millionth of it.",
        worst.in_words(percoat_draw::number::short)
    );
    Some(sheet(&snapshot.caption(&words), &[&map]))
}

/// Range of τ₁ in a material at y and z, linear in z between its planes; `None` above and below all of them.
fn between_planes(planes: &[RangePlane], material: usize, [y, z]: [f64; 2]) -> Option<f64> {
    let of_material = || planes.iter().filter(|plane| plane.depth.material == material);
    let above = of_material().filter(|plane| plane.depth.z <= z).max_by(|a, b| a.depth.z.total_cmp(&b.depth.z))?;
    let below = of_material().filter(|plane| plane.depth.z >= z).min_by(|a, b| a.depth.z.total_cmp(&b.depth.z))?;
    let apart = below.depth.z - above.depth.z;
    let part = if apart > 0.0 { (z - above.depth.z) / apart } else { 0.0 };
    Some((1.0 - part) * above.at(y) + part * below.at(y))
}

/// First and last y shown of planes: one period about a place where lines repeat.
fn about(planes: &[RangePlane], across: f64) -> Option<[f64; 2]> {
    let plane = planes.first()?;
    if let Some(period) = plane.period {
        return Some([across - 0.5 * period, across + 0.5 * period]);
    }
    let ([first, _], [last, _]) = (plane.lines.first()?, plane.lines.last()?);
    Some([*first, *last])
}

/// Points (passes, height removed): what comes off does so at once, the height before and after.
fn removed(course: &[Course], events: &[Event]) -> Vec<[f64; 2]> {
    let off = |event: &Event| [[event.passes, event.removed - event.depth], [event.passes, event.removed]];
    let off = events.iter().filter(|event| event.what != EventKind::WornThrough).flat_map(off);
    let mut removed: Vec<[f64; 2]> = off.chain(course.iter().map(|state| [state.passes, state.removed])).collect();
    removed.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    removed
}

/// The first damage of a life.
struct FirstDamage {
    /// Passes until then less and more their error.
    passes: [f64; 2],
    /// Height in the middle of what comes off, from the original surface; a length.
    removed: f64,
}

impl FirstDamage {
    /// The first of these events with the relative error of its passes; `None` without an event or an error.
    fn of(events: &[Event], error: Option<f64>) -> Option<Self> {
        let (event, error) = (events.first()?, error.filter(|error| *error > 0.0 && error.is_finite())?);
        let passes = [1.0 - error, 1.0 + error].map(|part| event.passes * part.max(0.0));
        Some(Self { passes, removed: event.removed - 0.5 * event.depth })
    }

    /// A level bar over the error of the passes.
    fn bar(&self, height: f64) -> Vec<[f64; 2]> {
        self.passes.map(|passes| [passes, height]).to_vec()
    }
}

/// Layers left and heights worn off over the passes, with the events; `None` for less than two states. `error`: relative
/// error of the passes until the first damage, which is a level bar.
pub fn course(
    title: &str,
    problem: &Problem,
    units: &Units,
    (course, events): (&[Course], &[Event]),
    error: Option<f64>,
) -> Option<Canvas> {
    if course.len() < 2 {
        return None;
    }
    let last = course.iter().map(|state| state.passes).fold(0.0, f64::max);
    let x = || Axis::linear("passes N").from_to(0.0, 1.02 * last);
    let curve = |label: &str, colour: usize, points: Vec<[f64; 2]>, style: Style| Curve {
        label: label.to_owned(),
        points,
        errors: Vec::new(),
        style,
        colour: colour.into(),
    };
    let points =
        |value: fn(&Course) -> f64| course.iter().map(|state| [state.passes, value(state)]).collect::<Vec<_>>();
    let has_layers = course.iter().any(|state| state.thickness > 0.0);
    let removed = removed(course, events);
    let first = FirstDamage::of(events, error);
    let mut charts = Vec::new();
    if has_layers {
        let whole = course[0].thickness;
        let left = removed.iter().map(|[n, removed]| [*n, (whole - removed).max(0.0)]).collect();
        let y = Axis::linear(units.length_of("layers left", "h")).from_to(0.0, 1.05 * whole);
        let bar = first.as_ref().map(|first| curve("", 1, first.bar(whole - first.removed), Style::Line));
        let curves = [curve("", 1, left, Style::Line)].into_iter().chain(bar).collect();
        charts.push(Chart { title: "layers".to_owned(), x: x(), y, curves });
    }
    let mut curves = vec![curve("removed from the body", 1, removed, Style::Line)];
    curves.extend(first.as_ref().map(|first| curve("", 1, first.bar(first.removed), Style::Line)));
    // An isolated contact has no mean.
    let [body, counterbody]: [fn(&Course) -> f64; 2] =
        [|state| state.body.unwrap_or(state.body_depth), |state| state.counterbody.unwrap_or(state.counterbody_depth)];
    let what = AroundWords::of(problem.cell().surroundings()).worn;
    if course.iter().any(|state| body(state) > 0.0) {
        curves.push(curve(&format!("worn off the body by sliding, {what}"), 2, points(body), Style::Line));
    }
    if course.iter().any(|state| counterbody(state) > 0.0) {
        curves.push(curve(&format!("worn off the counterbody, {what}"), 3, points(counterbody), Style::Line));
    }
    let y = Axis::linear(units.length_of("height", "u"));
    charts.push(Chart { title: "removed and worn".to_owned(), x: x(), y, curves });
    let finite = |state: &Course| if state.max_pressure.is_finite() { state.max_pressure } else { f64::NAN };
    // The largest pressure jumps where something comes off.
    let jumps = |state: &Course| events.iter().any(|event| event.passes == state.passes);
    let before = course.windows(2).filter(|pair| jumps(&pair[1])).map(|pair| [pair[1].passes, finite(&pair[0])]);
    let mut pressures: Vec<[f64; 2]> = before.chain(points(finite)).collect();
    pressures.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let y = Axis::linear(units.label(&READING.max_pressure.named));
    charts.push(Chart { title: "pressure".to_owned(), x: x(), y, curves: vec![curve("", 1, pressures, Style::Line)] });
    for (letter, chart) in ('a'..).zip(&mut charts) {
        chart.title = format!("({letter}) {}", chart.title);
    }
    let more = [format!("{} events in {} passes", events.len(), percoat_draw::number::short(last))];
    let words = first.as_ref().map_or("", |_| " Level bar: estimated error of the passes until the first damage.");
    Some(plots(&format!("{}{words}", caption(title, problem, units, &more)), &charts))
}
