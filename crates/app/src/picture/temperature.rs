//! Temperature by frictional heat: of the surfaces, and in a section through the hottest place along the motion.

use super::pressure::{axes, sliding_arrow, sliding_words, unit_cell};
use super::snapshot::Snapshot;
use super::zoom;
use crate::picture::labels::Labels;
use ndarray::Array2;
use percoat_core::body::Depth;
use percoat_core::quantity::Named;
use percoat_core::reading::TEMPERATURE;
use percoat_core::stress::{SurfaceLine, TemperatureField};
use percoat_draw::axis::Axis;
use percoat_draw::bar::Bar;
use percoat_draw::canvas::{Canvas, Dash, Stroke};
use percoat_draw::colour::Colour;
use percoat_draw::map::{Fill, Map, Over};
use percoat_draw::sheet::{Panel, sheet};

/// Depth of the section in each body over its length.
const DEPTH: f64 = 0.25;
/// Points along the section, and rows of it in each body.
const POINTS: [usize; 2] = [257, 64];

/// The picture of a step, the body's surface and that of a counterbody that takes heat; `None` where nothing heats.
pub fn temperature(snapshot: &Snapshot) -> Option<Canvas> {
    let heat = snapshot.step.finest().heat()?;
    let (grid, pressures) = (snapshot.step.grid(), snapshot.pressures());
    let view = zoom::view(grid, snapshot.levels() > 0, |index| pressures[index] > 0.0);
    let surfaces = [("body", Some(&heat.body)), ("counterbody", heat.counterbody.as_ref())];
    let surfaces: Vec<(&str, &Vec<f64>)> =
        surfaces.into_iter().filter_map(|(name, field)| Some((name, field?))).collect();
    let least = surfaces.iter().flat_map(|(_, field)| field.iter().copied()).fold(f64::INFINITY, f64::min);
    let most = surfaces.iter().flat_map(|(_, field)| field.iter().copied()).fold(f64::NEG_INFINITY, f64::max);
    type Values<'a> = Box<dyn Fn([f64; 2]) -> Option<f64> + Sync + 'a>;
    let values: Vec<Values<'_>> = surfaces
        .iter()
        .map(|&(_, field)| Box::new(move |place| snapshot.nearest(place).map(|i| field[i] - least)) as Values<'_>)
        .collect();
    let label = snapshot.units.label(&Named { name: "temperature", ..TEMPERATURE.max.named });
    let span = (most - least).max(f64::MIN_POSITIVE);
    let [x, y] = axes(snapshot, view.window);
    let mut maps: Vec<Map<'_>> = Vec::new();
    for (letter, ((name, _), value)) in ["a", "b"].into_iter().zip(surfaces.iter().zip(&values)) {
        let mut over = unit_cell(snapshot, view);
        over.extend(sliding_arrow(snapshot, view));
        let fill = Fill::Values(Bar::sequential(label.clone(), span), value);
        let title = format!("({letter}) {name}");
        maps.push(Map { title, x: x.clone(), y: y.clone(), aspect: view.aspect(), fill, over });
    }
    let section = Section::below(snapshot, &heat.body);
    let inside = |place: [f64; 2]| section.at(place).map(|temperature| temperature - least);
    maps.push(section.map(Fill::Values(Bar::sequential(label, span), &inside), ["b", "c"][maps.len() - 1], snapshot));
    let words = ["Temperature above the lowest one of both surfaces; the section runs along the motion through the hottest place.", sliding_words(snapshot)].concat();
    let panels: Vec<&dyn Panel> = maps.iter().map(|map| map as &dyn Panel).collect();
    Some(sheet(&snapshot.caption(&words), &panels))
}

/// A vertical section through both bodies, that of the counterbody above.
struct Section {
    line: SurfaceLine,
    /// Depth in each body, a length.
    depth: f64,
    bodies: Vec<Temperatures>,
}

/// Temperatures of a body in the section.
struct Temperatures {
    depths: Vec<Depth>,
    /// Depths down axis 0, along the line on axis 1.
    values: Array2<f64>,
    /// Depths of the interfaces, lengths.
    interfaces: Vec<f64>,
}

impl Section {
    /// Section along the motion through the hottest place of a surface.
    fn below(snapshot: &Snapshot, surface: &[f64]) -> Self {
        let (contact, grid) = (snapshot.step.finest(), snapshot.step.grid());
        let hotter = |best: usize, i: usize| if surface[i] > surface[best] { i } else { best };
        let hottest = (0..surface.len()).fold(0, hotter);
        let length = grid.cell().reduced().longer_side();
        let line = SurfaceLine {
            origin: grid.cell().point(grid.fractions(hottest)),
            direction: contact.problem().direction(),
            span: [-0.5 * length, 0.5 * length],
            points: POINTS[0],
        };
        let depth = DEPTH * length;
        let of = |field: TemperatureField| {
            let depths = field.half_space().rows(depth, POINTS[1]);
            let values = field.section(&line, &depths);
            let interfaces = field.half_space().interface_depths();
            Temperatures { depths, values, interfaces: interfaces.into_iter().filter(|z| *z < depth).collect() }
        };
        Self { line, depth, bodies: TemperatureField::of(contact).into_iter().map(of).collect() }
    }

    /// Temperature at a distance along the line and a depth, below 0 in the counterbody.
    fn at(&self, [s, z]: [f64; 2]) -> Option<f64> {
        let body = self.bodies.get(usize::from(z < 0.0))?;
        let [first, last] = self.line.span;
        let column = (s - first) / (last - first) * (self.line.points - 1) as f64;
        let left = column.floor().clamp(0.0, (self.line.points - 2) as f64);
        let (left, across) = (left as usize, column - left);
        let lower = body.depths.partition_point(|depth| depth.z <= z.abs()).clamp(1, body.depths.len() - 1);
        let [above, below] = [lower - 1, lower].map(|row| body.depths[row].z);
        let down = if below > above { ((z.abs() - above) / (below - above)).min(1.0) } else { 0.0 };
        let row = |row: usize| (1.0 - across) * body.values[[row, left]] + across * body.values[[row, left + 1]];
        Some((1.0 - down) * row(lower - 1) + down * row(lower))
    }

    fn map<'f>(&self, fill: Fill<'f>, letter: &str, snapshot: &Snapshot) -> Map<'f> {
        let (units, [first, last]) = (&snapshot.units, self.line.span);
        let top = if self.bodies.len() > 1 { -self.depth } else { 0.0 };
        let sides = self.bodies.iter().zip([1.0, -1.0]);
        let faces = sides.flat_map(|(body, side)| body.interfaces.iter().map(move |z| side * z));
        let lines = faces.chain((top < 0.0).then_some(0.0)).map(|z| {
            let points = vec![[first, z], [last, z]];
            Over::Line(Stroke { points, width: 0.4, dash: Dash::Solid, colour: Colour::WHITE })
        });
        Map {
            title: format!("({letter}) section along the motion"),
            x: Axis::linear(units.length_of("distance", "s")).from_to(first, last),
            y: Axis::linear(units.length_of("depth", "z")).from_to(self.depth, top),
            aspect: (self.depth - top) / (last - first),
            fill,
            over: lines.collect(),
        }
    }
}
