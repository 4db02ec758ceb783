//! Largest stresses, and what they take up of strengths.

use super::number::{or_none, plain, value};
use crate::reading::{Criterion, StressReading, Utilisation};
use crate::stress::maxima::{Carried, Extremes};
use crate::stress::{Peak, Rival};
use serde::Deserialize;

#[derive(Deserialize)]
pub(super) struct StressKeys {
    materials: Vec<ExtremesKeys>,
    faces: Vec<ExtremesKeys>,
    interfaces: Vec<CarriedKeys>,
    surface_error: Option<f64>,
}

#[derive(Deserialize)]
struct ExtremesKeys {
    max_tau1: PeakKeys,
    max_tension: PeakKeys,
    max_mises: PeakKeys,
}

#[derive(Deserialize)]
struct CarriedKeys {
    interface: usize,
    max_normal: PeakKeys,
    max_shear: PeakKeys,
}

#[derive(Deserialize)]
struct PeakKeys {
    value: Option<f64>,
    error: Option<f64>,
    singular: bool,
    #[serde(deserialize_with = "or_none")]
    x: f64,
    #[serde(deserialize_with = "or_none")]
    y: f64,
    #[serde(deserialize_with = "or_none")]
    z: f64,
    material: usize,
    direction: [Option<f64>; 3],
    rival: Option<RivalKeys>,
}

#[derive(Deserialize)]
struct RivalKeys {
    #[serde(deserialize_with = "or_none")]
    value: f64,
    #[serde(deserialize_with = "or_none")]
    error: f64,
    #[serde(deserialize_with = "or_none")]
    x: f64,
    #[serde(deserialize_with = "or_none")]
    y: f64,
    #[serde(deserialize_with = "or_none")]
    z: f64,
    material: usize,
}

#[derive(Deserialize)]
struct PlaceKeys {
    #[serde(deserialize_with = "or_none")]
    x: f64,
    #[serde(deserialize_with = "or_none")]
    y: f64,
    #[serde(deserialize_with = "or_none")]
    z: f64,
}

#[derive(Deserialize)]
pub(super) struct UtilisationKeys {
    criterion: String,
    material: Option<usize>,
    interface: Option<usize>,
    utilisation: Option<f64>,
    singular: bool,
    error: Option<f64>,
    #[serde(deserialize_with = "or_none")]
    x: f64,
    #[serde(deserialize_with = "or_none")]
    y: f64,
    #[serde(deserialize_with = "or_none")]
    z: f64,
    rival: Option<PlaceKeys>,
}

pub(super) fn stress(keys: StressKeys) -> StressReading {
    let all = |list: Vec<ExtremesKeys>| {
        let one = |keys: ExtremesKeys| Extremes {
            tau1: peak(&keys.max_tau1),
            tension: peak(&keys.max_tension),
            mises: peak(&keys.max_mises),
        };
        list.into_iter().map(one).collect()
    };
    let carried = |keys: CarriedKeys| Carried {
        interface: keys.interface,
        normal: peak(&keys.max_normal),
        shear: peak(&keys.max_shear),
        delamination: None,
    };
    StressReading {
        materials: all(keys.materials),
        faces: all(keys.faces),
        interfaces: keys.interfaces.into_iter().map(carried).collect(),
        // Infinite where it cannot be told.
        surface_error: keys.surface_error.unwrap_or(f64::INFINITY),
    }
}

fn peak(keys: &PeakKeys) -> Peak {
    Peak {
        value: value(keys.value, keys.singular),
        position: [keys.x, keys.y, keys.z],
        material: keys.material,
        direction: keys.direction.map(plain),
        error: keys.error,
        rival: keys.rival.as_ref().map(rival),
    }
}

fn rival(keys: &RivalKeys) -> Rival {
    let RivalKeys { value, error, x, y, z, material } = *keys;
    Rival { value, error, position: [x, y, z], material }
}

/// Refused for a criterion that is not known.
pub(super) fn utilisation(keys: UtilisationKeys) -> Result<Utilisation, String> {
    let UtilisationKeys { criterion: name, material, interface, .. } = &keys;
    let criterion = criterion(name, *material, *interface).ok_or_else(|| format!("criterion {name:?} is not known"))?;
    Ok(Utilisation {
        criterion,
        value: value(keys.utilisation, keys.singular),
        error: keys.error,
        position: [keys.x, keys.y, keys.z],
        rival: keys.rival.map(|PlaceKeys { x, y, z }| [x, y, z]),
    })
}

/// A criterion by its name and what it is of.
pub(super) fn criterion(name: &str, material: Option<usize>, interface: Option<usize>) -> Option<Criterion> {
    Some(match name {
        "yield" => Criterion::Yield { material: material? },
        "cracking" => Criterion::Cracking { material: material? },
        "delamination" => Criterion::Delamination { interface: interface? },
        _ => return None,
    })
}
