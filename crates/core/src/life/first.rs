//! The first event of a life, of any kind.

use super::beginning::Beginning;
use super::event::EventKind;
use super::state::LifeState;
use super::task::LifeTask;
use crate::numeric::serialised;
use crate::reading::{FatiguePart, Life};
use serde::{Deserialize, Serialize};

/// Kind of the first event.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FirstKind {
    /// A material fails by fatigue.
    Fatigue,
    /// An interface fails by fatigue.
    Delamination,
    /// A layer is worn through.
    WornThrough,
}

/// The first event of a life.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct First {
    /// Kind of the event.
    pub kind: FirstKind,
    /// The part that fails, or is worn through.
    #[serde(flatten)]
    pub part: FatiguePart,
    /// Passes until the event; infinite where nothing ever fails.
    #[serde(deserialize_with = "serialised::infinite")]
    pub passes: f64,
    /// Distance that the counterbody has slid until the event, a length; `None` where it is not known.
    pub distance: Option<f64>,
    /// Estimated relative error of the passes by the grid; `None` where it is not known.
    pub error: Option<f64>,
    /// Range of the shear stress that does the damage, a pressure, or the strain, as of [`Life::range`]; `None` of wear.
    pub range: Option<f64>,
    /// Damage in one pass of the unworn surfaces; `None` of wear.
    pub damage: Option<f64>,
    /// Place x, a length; `None` where only its depth is known.
    pub x: Option<f64>,
    /// Place y, a length.
    pub y: Option<f64>,
    /// Depth below the original surface, a length.
    pub z: Option<f64>,
}

impl First {
    /// The first event: of those that were followed, or the first failure of the unworn surfaces where none was. `None` where nothing
    /// tires and nothing is worn through.
    pub fn of(task: &LifeTask, begun: &Beginning, state: &LifeState) -> Option<Self> {
        let fatigue = begun.record.fatigue.as_ref();
        let lives = || fatigue.iter().flat_map(|reading| &reading.lives);
        let foreseen = |life: &Life| Self {
            kind: kind_of(life.part),
            part: life.part,
            passes: life.passes,
            distance: task.slid_after(life.passes),
            error: life.error,
            range: Some(life.range).filter(|range| range.is_finite()),
            damage: Some(life.damage).filter(|damage| damage.is_finite()),
            x: Some(life.position[0]),
            y: Some(life.position[1]),
            z: Some(life.position[2]),
        };
        let shorter = |a: Self, b: Self| if b.passes < a.passes { b } else { a };
        let Some(event) = state.events.first() else { return lives().map(foreseen).reduce(shorter) };
        let life = lives().find(|life| life.part == event.part && event.what != EventKind::WornThrough);
        let followed = Self {
            kind: if event.what == EventKind::WornThrough { FirstKind::WornThrough } else { kind_of(event.part) },
            part: event.part,
            passes: event.passes,
            distance: event.distance,
            error: None,
            range: None,
            damage: None,
            x: None,
            y: None,
            z: (event.what != EventKind::Crack).then_some(event.removed),
        };
        // The failure of the unworn surfaces has a place; that of surfaces that wear errs by as much at least.
        let followed = life.map_or(followed, |life| match life.passes == event.passes {
            true => foreseen(life),
            false => Self { error: life.error, ..followed },
        });
        let others = lives().filter(|life| !life.part.is_followed()).map(foreseen);
        Some(others.fold(followed, shorter))
    }
}

fn kind_of(part: FatiguePart) -> FirstKind {
    match part {
        FatiguePart::Material(_) | FatiguePart::Strained(_) => FirstKind::Fatigue,
        FatiguePart::Interface(_) => FirstKind::Delamination,
    }
}
