//! Temperature of the surfaces by frictional heat.

use super::pressure::{axes, sliding_arrow, sliding_words, unit_cell};
use super::snapshot::Snapshot;
use super::zoom;
use crate::picture::labels::Labels;
use percoat_core::quantity::Named;
use percoat_core::reading::TEMPERATURE;
use percoat_draw::bar::Bar;
use percoat_draw::canvas::Canvas;
use percoat_draw::map::{Fill, Map};
use percoat_draw::sheet::{Panel, sheet};

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
    let words = ["Temperature above the lowest one of both surfaces.", sliding_words(snapshot)].concat();
    let panels: Vec<&dyn Panel> = maps.iter().map(|map| map as &dyn Panel).collect();
    Some(sheet(&snapshot.caption(&words), &panels))
}
