//! Load curves: the readings over the load of the steps of a run (Figs 4 and 5).

use super::snapshot::caption;
use super::utilisations::{BARS, utilisation_axis, utilisation_curves};
use crate::picture::labels::Labels;
use percoat_case::units::Units;
use percoat_core::body::MaterialId;
use percoat_core::measured::Measured;
use percoat_core::problem::Problem;
use percoat_core::quantity::Quantity;
use percoat_core::reading::{Criterion, LEVEL, LevelReading, PLASTIC, PlasticReading, READING, Reading};
use percoat_core::run::StepRecord;
use percoat_core::run::touches::touches;
use percoat_core::stress::maxima::{CARRIED, Carried, EXTREMES, Extremes};
use percoat_draw::axis::{Axis, log_spaced};
use percoat_draw::canvas::Canvas;
use percoat_draw::chart::{Chart, plots};
use percoat_draw::curve::{Curve, Ink, NUMBERED_COLOURS, Style};
use percoat_draw::error_bars::MOST_MARKERS;
use percoat_draw::label::Label;

/// The picture; `None` for less than two steps, or where none of them carries load.
pub fn load_curves(title: &str, problem: &Problem, units: &Units, steps: &[StepRecord]) -> Option<Canvas> {
    if steps.len() < 2 || !steps.iter().any(|step| step.reading.touches()) {
        return None;
    }
    let levels = problem.levels().len();
    let touches = touches(problem, steps, units.quantity());
    let loads: Vec<f64> = steps.iter().map(|step| step.reading.load(units.quantity())).collect();
    // Loads that are spread evenly on a logarithmic axis rather than on a linear one have one.
    let path = LoadPath { problem, steps, levels, units, logarithmic: log_spaced(&loads), touches: &touches };
    let mut charts = vec![path.peak_pressure(), path.extent(), path.penetration()];
    charts.extend(path.indentation());
    if path.levels > 1 {
        charts.push(path.shares());
    }
    charts.extend(path.stresses());
    charts.extend(path.interfaces());
    charts.extend(path.utilisations());
    for (letter, chart) in ('a'..).zip(&mut charts) {
        chart.title = format!("({letter}) {}", chart.title);
    }
    let [n1, n2] = steps[0].points;
    let more = [format!("{} load steps", steps.len()), format!("{n1}\u{a0}×\u{a0}{n2} samples")];
    let what = match touches.len() {
        0 => "",
        _ => " Dotted, with the level's number: where a level touches first, from its loads at the steps behind.",
    };
    let has_errors = charts.iter().flat_map(|chart| &chart.curves).any(Curve::has_errors);
    let bars = if has_errors { format!(" {BARS}") } else { String::new() };
    Some(plots(&format!("{}{what}{bars}", caption(title, problem, units, &more)), &charts))
}

/// The steps of a run, and how they are drawn.
struct LoadPath<'a> {
    problem: &'a Problem,
    steps: &'a [StepRecord],
    /// Number of levels; 0 for a topography.
    levels: usize,
    units: &'a Units,
    /// Whether the load and the quantities that grow with it have logarithmic axes.
    logarithmic: bool,
    /// Levels and the loads at which they touch first.
    touches: &'a [(usize, f64)],
}

impl LoadPath<'_> {
    fn axis(&self, label: Label) -> Axis {
        if self.logarithmic { Axis::log(label) } else { Axis::linear(label) }
    }

    fn chart(&self, title: &str, y: Axis, curves: Vec<Curve>) -> Chart {
        let loads = self.steps.iter().map(|step| step.reading.load(self.units.quantity()));
        let last = loads.clone().fold(0.0, f64::max);
        let least = loads.fold(f64::INFINITY, f64::min);
        let (first, last) = if self.logarithmic { (least / 1.1, last * 1.1) } else { (0.0, 1.03 * last) };
        let x = self.axis(self.units.load_of("")).from_to(first, last);
        let marks = self.touches.iter().map(|(level, load)| (*load, level.to_string())).collect();
        Chart { title: title.to_owned(), x: Axis { marks, ..x }, y, curves }
    }

    /// A curve of values with their errors; a step without one has none of both.
    fn curve(&self, label: &str, colour: Ink, value: impl Fn(&StepRecord) -> Option<Measured>) -> Curve {
        let values: Vec<Option<Measured>> = self.steps.iter().map(value).collect();
        let load = |step: &StepRecord| step.reading.load(self.units.quantity());
        let points = self
            .steps
            .iter()
            .zip(&values)
            .map(|(step, found)| [load(step), found.map_or(f64::NAN, |found| found.value)]);
        let points: Vec<[f64; 2]> = points.collect();
        let errors = values.iter().map(|found| found.and_then(|found| found.error).unwrap_or(f64::NAN)).collect();
        // Markers show the steps of short paths.
        let style = if points.len() <= MOST_MARKERS { Style::LineMarkers } else { Style::Line };
        Curve { label: label.to_owned(), points, errors, style, colour }
    }

    /// One curve of a quantity for each level, interrupted where the level has no value or no contact; one of the `whole` for a topography.
    fn by_level(&self, whole: &Quantity<Reading>, quantity: &Quantity<LevelReading>) -> Vec<Curve> {
        if self.levels == 0 {
            return vec![self.curve("", 1.into(), |step| whole.finite(&step.reading))];
        }
        let touching = |level: &LevelReading| if level.load > 0.0 { quantity.finite(level) } else { None };
        let of = |level: usize| {
            self.curve(&self.problem.level_name(level).label(), level.into(), |step| {
                touching(&step.reading.levels[level - 1])
            })
        };
        (1..=self.levels).map(of).collect()
    }

    fn peak_pressure(&self) -> Chart {
        let (whole, of_level) = (&READING.max_pressure, &LEVEL.max_pressure);
        let axis = self.axis(self.units.label(&whole.named));
        self.chart(whole.named.name, axis, self.by_level(whole, of_level))
    }

    fn extent(&self) -> Chart {
        let whole = self.steps.first().map_or(&READING.contact_area, |step| step.reading.extent());
        let of_level = &LEVEL.contact_radius;
        let named = if self.levels == 0 { &whole.named } else { &of_level.named };
        self.chart(named.name, self.axis(self.units.label(named)), self.by_level(whole, of_level))
    }

    fn penetration(&self) -> Chart {
        let named = &READING.penetration.named;
        let curve = self.curve("", 0.into(), |step| READING.penetration.finite(&step.reading));
        self.chart(named.name, self.axis(self.units.label(named)), vec![curve])
    }

    /// Chart of the depths pressed in for good; `None` where nothing is.
    fn indentation(&self) -> Option<Chart> {
        let mut readings = self.steps.iter().filter_map(|step| step.plastic.as_ref());
        readings.any(PlasticReading::is_pressed_in).then(|| {
            let curve = |quantity: &Quantity<PlasticReading>, colour: usize| {
                self.curve(quantity.named.short, colour.into(), |step| quantity.finite(step.plastic.as_ref()?))
            };
            let curves = vec![curve(&PLASTIC.depth, 1), curve(&PLASTIC.permanent_depth, 2)];
            let label = self.units.length_of("pressed in for good", "u");
            self.chart("pressed in for good", Axis::linear(label), curves)
        })
    }

    fn shares(&self) -> Chart {
        let share = |level: &LevelReading| if level.load > 0.0 { LEVEL.load_share.of(level) } else { None };
        let of = |level: usize| {
            let value = |step: &StepRecord| Some(share(&step.reading.levels[level - 1])?.times(100.0));
            self.curve(&format!("level {level}"), level.into(), value)
        };
        let axis = Axis::linear("load share (%)").from_to(0.0, 105.0);
        self.chart(LEVEL.load_share.named.name, axis, (1..=self.levels).map(of).collect())
    }

    /// Charts of the largest stresses in each material; empty for runs without stresses.
    fn stresses(&self) -> Vec<Chart> {
        let Some(any) = self.steps.iter().find_map(|step| step.stress.as_ref()) else { return Vec::new() };
        let ids: Vec<MaterialId> = any.materials.iter().map(|material| material.tau1.material).collect();
        let (names, materials) = (names(&ids), ids.len());
        let chart = |quantity: &Quantity<Extremes>| {
            let of = |index: usize| {
                self.curve(&names[index], Ink::by_depth(index, materials), |step| {
                    quantity.finite(step.stress.as_ref()?.materials.get(index)?)
                })
            };
            let label = self.units.label(&quantity.named);
            // A shear and von Mises are not below zero.
            let is_positive = [EXTREMES.tau1.named, EXTREMES.mises.named].contains(&quantity.named);
            let axis = if is_positive { self.axis(label) } else { Axis::linear(label) };
            self.chart(quantity.named.short, axis, (0..materials).map(of).collect())
        };
        let is_there =
            |quantity: &&Quantity<Extremes>| any.materials.iter().any(|extremes| quantity.of(extremes).is_some());
        EXTREMES.each().into_iter().filter(is_there).map(chart).collect()
    }

    /// Chart of the largest tension and shear of each interface.
    fn interfaces(&self) -> Option<Chart> {
        let any = &self.steps.iter().find_map(|step| step.stress.as_ref())?.interfaces;
        let interfaces = any.len();
        let curve = |index: usize, quantity: &Quantity<Carried>, thin: bool| {
            let what = quantity.named.short;
            let name = match interfaces {
                1 => what.to_owned(),
                NUMBERED_COLOURS.. if thin => String::new(),
                NUMBERED_COLOURS.. => any[index].interface.to_string(),
                _ => format!("{what}, {}", any[index].interface),
            };
            let of = |step: &StepRecord| quantity.finite(step.stress.as_ref()?.interfaces.get(index)?);
            let curve = self.curve(&name, Ink::by_depth(index, interfaces), of);
            if thin { Curve { style: Style::Thin, ..curve } } else { curve }
        };
        let curves = (0..interfaces)
            .flat_map(|index| [curve(index, &CARRIED.normal, true), curve(index, &CARRIED.shear, false)]);
        let y = Axis::linear(self.units.pressure_of("largest tension and shear", "σ, τ"));
        let title =
            if interfaces < NUMBERED_COLOURS { "interfaces" } else { "interfaces; thick: shear, thin: tension" };
        (interfaces > 0).then(|| self.chart(title, y, curves.collect()))
    }

    /// Chart of the utilisations of the strengths.
    fn utilisations(&self) -> Option<Chart> {
        let criteria: Vec<Criterion> =
            self.steps.iter().find(|step| !step.strength.is_empty())?.strength.iter().map(|u| u.criterion).collect();
        Some(self.chart(
            "utilisation",
            utilisation_axis(self.steps),
            utilisation_curves(self.steps, self.units.quantity(), criteria),
        ))
    }
}

/// Names of the curves of materials, the body before the counterbody: each its own, or its place in its body. That of a single
/// body of one material without a name is empty.
fn names(ids: &[MaterialId]) -> Vec<String> {
    let counterbodies = ids.iter().filter(|id| id.is_counterbody()).count();
    let name = |id: &MaterialId| {
        let count = if id.is_counterbody() { counterbodies } else { ids.len() - counterbodies };
        let of = if id.is_counterbody() { " of the counterbody" } else { "" };
        match (id.name, count - id.number, count) {
            (Some(_), ..) => id.to_string(),
            (None, _, 1) if counterbodies == 0 => String::new(),
            (None, _, 1) => if id.is_counterbody() { "counterbody" } else { "body" }.to_owned(),
            (None, 0, _) => format!("substrate{of}"),
            (None, _, 2) => format!("coating{of}"),
            (None, ..) => format!("layer {}{of}", id.number),
        }
    };
    ids.iter().map(name).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use percoat_core::body::{HalfSpace, Material, Name, Side};
    use percoat_core::counterbody::{Indenters, Level, Shape};
    use percoat_core::lattice::Lattice;
    use percoat_core::load::Load;
    use percoat_core::spectral::{Settings, Solver};

    #[test]
    fn materials_are_named_by_their_place_in_their_own_body() {
        let id = |side: Side, number: usize, name: &str| {
            let name = (!name.is_empty()).then(|| Name::new(name));
            MaterialId { side: Some(side), number, name }
        };
        let (below, above) = (Side::Body, Side::Counterbody);
        assert_eq!(names(&[MaterialId::numbered(1)]), [""]);
        assert_eq!(names(&[1, 2].map(MaterialId::numbered)), ["coating", "substrate"]);
        assert_eq!(names(&[1, 2, 3].map(MaterialId::numbered)), ["layer 1", "layer 2", "substrate"]);
        assert_eq!(names(&[id(below, 1, ""), id(above, 1, "")]), ["body", "counterbody"]);
        assert_eq!(names(&[id(below, 1, "D2"), id(above, 1, "D2")]), ["D2", "D2 of the counterbody"]);
        let pair = [id(below, 1, ""), id(below, 2, ""), id(above, 1, ""), id(above, 2, "D2")];
        assert_eq!(names(&pair), ["coating", "substrate", "coating of the counterbody", "D2 of the counterbody"]);
    }

    #[test]
    fn a_course_that_never_carries_load_has_no_curves() {
        let level = Level::new(Shape::Paraboloid { radius: 1.0 }, 0.0).unwrap();
        let indenters = Indenters::new(Lattice::square(1.0, 1).unwrap(), vec![level]).unwrap();
        let body = HalfSpace::new(vec![], Material::from_young(1.0, 0.3).unwrap());
        let mut solver = Solver::new(Problem::new(indenters, body), [8, 8], Settings::default()).unwrap();
        let mut record = |penetration: f64| {
            let step = solver.solve(Load::Penetration(penetration));
            StepRecord::new(&step, step.reading())
        };
        let (open, closed) = ([-0.2, -0.1].map(&mut record), [0.01, 0.02].map(&mut record));
        let problem = solver.problem();
        let units = Units::of(problem);
        assert!(
            load_curves("", problem, &units, &open).is_none() && load_curves("", problem, &units, &closed).is_some()
        );
    }
}
