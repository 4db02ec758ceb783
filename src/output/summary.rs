//! `summary.json` and `curve.csv`: every scalar of a run.

use crate::hierarchy::Solution;
use crate::observables::{Errors, LevelErrors, Observables};
use crate::stress::maxima::{self, Maxima};
use serde::Serialize;
use serde_json::Value;

/// One load step as it stands in `summary.json`.
#[derive(Debug, Clone, Serialize)]
pub struct Step {
    /// Mean pressure p̄ over the cell.
    pub mean_pressure: f64,
    /// Penetration δ, a length.
    pub penetration: f64,
    /// Additional displacement w_a, Eq. (8): equal to δ, which is measured from the mean plane of the deformed surface.
    pub additional_displacement: f64,
    /// Fraction of the cell in contact.
    pub contact_fraction: f64,
    /// Largest pressure; null where it is infinite.
    pub max_pressure: Option<f64>,
    /// Whether the largest pressure is infinite: under a tip in contact.
    pub singular: bool,
    /// Estimated discretisation errors of these.
    pub errors: Errors,
    /// Whether the solution meets the tolerance.
    pub converged: bool,
    /// Why the iteration ended.
    pub stop_reason: String,
    /// Whether the preconditioned method gave up and the baseline took over.
    pub fell_back: bool,
    /// Iterations on the finest grid.
    pub iterations: usize,
    /// Convolutions on all grids, as equivalents of the finest one.
    pub convolutions: f64,
    /// ε = Σ p|g| / (δ Σp).
    pub residual: f64,
    /// What the pressure proves about itself.
    pub certificate: Certificate,
    /// Grid points along a₁ and a₂.
    pub points: [usize; 2],
    /// Number of contact spots in the cell.
    pub contact_spots: usize,
    /// Samples along the radius of the typical one, see [`Observables::spot_resolution`].
    pub spot_resolution: f64,
    /// Per level.
    pub levels: Vec<Level>,
    /// Largest stresses, where the case asks for stresses and there is contact.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stress: Option<Stress>,
}

/// Largest stresses of a step, see [`crate::stress::maxima`].
#[derive(Debug, Clone, Serialize)]
pub struct Stress {
    /// Largest principal shear stress of all.
    pub max_tau1: Peak,
    /// Largest tension of all.
    pub max_tension: Peak,
    /// Over each material, from the surface down.
    pub materials: Vec<Extremes>,
    /// On each face: the surface, then both sides of each interface.
    pub faces: Vec<Extremes>,
    /// Estimated relative error of the largest tension on the surface, see [`crate::stress::Crest::error`].
    pub surface_error: f64,
    /// Estimated discretisation errors of the largest of all, see [`Maxima::errors`].
    pub errors: StressErrors,
}

/// Estimated errors of the largest stresses, pressures; null where there is no coarser grid or no number.
#[derive(Debug, Clone, Serialize)]
pub struct StressErrors {
    /// Of the largest principal shear stress.
    pub max_tau1: Option<f64>,
    /// Of the largest tension.
    pub max_tension: Option<f64>,
}

/// Largest stresses over a material or a face.
#[derive(Debug, Clone, Serialize)]
pub struct Extremes {
    /// Largest principal shear stress.
    pub max_tau1: Peak,
    /// Largest principal stress; negative where nothing is in tension.
    pub max_tension: Peak,
}

/// A largest value and where it stands.
#[derive(Debug, Clone, Serialize)]
pub struct Peak {
    /// The value; null where it is infinite.
    pub value: Option<f64>,
    /// Whether the value is infinite: τ₁ under a tip in contact.
    pub singular: bool,
    /// Where, lengths.
    pub x: f64,
    /// See `x`.
    pub y: f64,
    /// See `x`; depth below the surface.
    pub z: f64,
    /// Material, from 1; the substrate is layers + 1.
    pub material: usize,
    /// Direction along which σ₁ acts there, a unit vector.
    pub direction: [f64; 3],
}

impl Stress {
    /// From the maxima of a field and those of the next coarser grid. `tip`: a place where τ₁ is infinite.
    pub fn new(maxima: &Maxima, coarser: Option<&Maxima>, tip: Option<[f64; 2]>) -> Self {
        let peak = |peak: &maxima::Peak| {
            let [x, y, z] = peak.position;
            Peak { value: Some(peak.value), singular: false, x, y, z, material: peak.side, direction: peak.direction }
        };
        let extremes = |extremes: &maxima::Extremes| Extremes {
            max_tau1: peak(&extremes.tau1),
            max_tension: peak(&extremes.tension),
        };
        let errors = coarser.map(|coarser| maxima.errors(coarser));
        let mut stress = Self {
            max_tau1: peak(&maxima.tau1()),
            max_tension: peak(&maxima.tension()),
            materials: maxima.materials.iter().map(extremes).collect(),
            faces: maxima.faces.iter().map(extremes).collect(),
            surface_error: maxima.crest.map_or(0.0, |crest| crest.error(coarser.and_then(|all| all.crest.as_ref()))),
            errors: StressErrors {
                max_tau1: errors.map(|errors| errors[0]).filter(|_| tip.is_none()),
                max_tension: errors.map(|errors| errors[1]),
            },
        };
        if let Some([x, y]) = tip {
            // A tip is infinitely stressed, whatever a grid shows of it.
            let first = [&mut stress.materials, &mut stress.faces].map(|all| all.first_mut());
            let first = first.into_iter().flatten().map(|extremes| &mut extremes.max_tau1);
            for tau1 in first.chain([&mut stress.max_tau1]) {
                *tau1 = Peak { value: None, singular: true, x, y, z: 0.0, material: 1, direction: tau1.direction };
            }
        }
        stress
    }
}

/// See [`crate::solver::Certificate`].
#[derive(Debug, Clone, Serialize)]
pub struct Certificate {
    /// Bound on the relative excess of energy.
    pub energy_gap: f64,
    /// Deepest penetration outside contact over δ.
    pub penetration: f64,
    /// Deviation of what was prescribed.
    pub load: f64,
}

/// One level of a step, see [`crate::observables::LevelObservables`].
#[derive(Debug, Clone, Serialize)]
pub struct Level {
    /// Level, from 1.
    pub level: usize,
    /// Force on one indenter.
    pub load: f64,
    /// Share of the whole load.
    pub load_share: f64,
    /// Peak pressure; null where it is infinite.
    pub max_pressure: Option<f64>,
    /// Whether the peak pressure is infinite, see [`crate::indenter::Shape::singular_peak`].
    pub singular: bool,
    /// Contact area of one indenter.
    pub contact_area: f64,
    /// √(area/π); null for merged contacts.
    pub contact_radius: Option<f64>,
    /// Whether a contact of this level is open in the middle.
    pub ring: bool,
    /// √(area/π) of a ring's hole; null without one, for merged contacts, spots of too few
    /// samples and polygons.
    pub radius_inner: Option<f64>,
    /// √(area/π) of all inside a ring's outer boundary; see `radius_inner`.
    pub radius_outer: Option<f64>,
    /// Smallest boundary radius; null for merged contacts, spots of too few samples and polygons.
    pub radius_min: Option<f64>,
    /// Largest boundary radius.
    pub radius_max: Option<f64>,
    /// (largest − smallest)/largest.
    pub asymmetry: Option<f64>,
    /// Whether contacts of this level touch a neighbour's.
    pub merged: bool,
    /// Samples along the contact radius.
    pub resolution: f64,
    /// Estimated discretisation errors of these.
    pub errors: LevelErrors,
}

impl Step {
    /// The step's scalars with their errors; `points` of the grid it was solved on.
    pub fn new(observables: &Observables, errors: &Errors, solution: &Solution, points: [usize; 2]) -> Self {
        let (report, certificate) = (&solution.report, &solution.certificate);
        let numbers =
            [observables.mean_pressure, observables.penetration, observables.max_pressure, certificate.energy_gap];
        // What is not a number compares as small as any tolerance.
        let finite = numbers.iter().all(|x| x.is_finite());
        Self {
            mean_pressure: observables.mean_pressure,
            penetration: observables.penetration,
            additional_displacement: observables.penetration,
            contact_fraction: observables.contact_fraction,
            max_pressure: (!observables.singular_peak()).then_some(observables.max_pressure),
            singular: observables.singular_peak(),
            errors: errors.clone(),
            converged: report.stop.solved() && finite,
            stop_reason: if finite { report.stop.to_string() } else { "not a number".to_owned() },
            fell_back: report.fell_back,
            iterations: report.iterations,
            convolutions: solution.convolutions,
            residual: report.residual,
            certificate: Certificate {
                energy_gap: certificate.energy_gap,
                penetration: certificate.penetration,
                load: certificate.load,
            },
            points,
            contact_spots: observables.contact_spots,
            spot_resolution: observables.spot_resolution,
            stress: None,
            levels: observables
                .levels
                .iter()
                .zip(&errors.levels)
                .map(|(level, &errors)| Level {
                    level: level.level,
                    load: level.load,
                    load_share: level.load_share,
                    max_pressure: (!level.singular_peak).then_some(level.max_pressure),
                    singular: level.singular_peak,
                    contact_area: level.contact_area,
                    contact_radius: level.contact_radius,
                    ring: level.ring,
                    radius_inner: level.ring_radii.map(|(inner, _)| inner),
                    radius_outer: level.ring_radii.map(|(_, outer)| outer),
                    radius_min: level.radius_extremes.map(|(least, _)| least),
                    radius_max: level.radius_extremes.map(|(_, largest)| largest),
                    asymmetry: level.asymmetry(),
                    merged: level.merged,
                    resolution: level.resolution,
                    errors,
                })
                .collect(),
        }
    }
}

/// A whole run as it stands in `summary.json`.
#[derive(Debug, Serialize)]
pub struct Summary<'a, C: Serialize> {
    /// Version of the program.
    pub percoat: &'static str,
    /// Title of the case.
    pub title: &'a str,
    /// The case as run.
    pub case: &'a C,
    /// Whether all load steps are there.
    pub complete: bool,
    /// What a reader should know before trusting the numbers.
    pub warnings: &'a [String],
    /// Change of the observables between the two finest grids, where an accuracy was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub accuracy: Option<f64>,
    /// The load steps.
    pub steps: &'a [Step],
}

impl<C: Serialize> Summary<'_, C> {
    /// As indented JSON.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).unwrap_or_default() + "\n"
    }
}

/// The steps as a CSV table: one row a step, one column a scalar, nested names joined by dots (`levels.1.load`).
/// What a step does not have stays empty.
pub fn curve(steps: &[Step]) -> String {
    let rows: Vec<Vec<(String, String)>> = steps.iter().map(row).collect();
    let mut names: Vec<&str> = Vec::new();
    // The step with most scalars has those of all others: only a step without contact lacks some.
    if let Some(longest) = rows.iter().max_by_key(|row| row.len()) {
        names.extend(longest.iter().map(|(name, _)| name.as_str()));
    }
    let mut text = names.join(",") + "\n";
    for row in &rows {
        let value = |name: &&str| row.iter().find(|(own, _)| own == name).map_or("", |(_, value)| value.as_str());
        text += &(names.iter().map(value).collect::<Vec<_>>().join(",") + "\n");
    }
    text
}

/// Names and values of a step's scalars.
pub fn row(step: &Step) -> Vec<(String, String)> {
    let mut cells = Vec::new();
    flatten("", &serde_json::to_value(step).unwrap_or_default(), &mut cells);
    cells
}

fn flatten(name: &str, value: &Value, cells: &mut Vec<(String, String)>) {
    let join = |key: &str| if name.is_empty() { key.to_owned() } else { format!("{name}.{key}") };
    match value {
        Value::Object(map) => map.iter().for_each(|(key, value)| flatten(&join(key), value, cells)),
        Value::Array(items) => {
            (1..).zip(items).for_each(|(number, value): (usize, _)| flatten(&join(&number.to_string()), value, cells));
        }
        Value::Null => cells.push((name.to_owned(), String::new())),
        Value::String(text) => cells.push((name.to_owned(), text.clone())),
        other => cells.push((name.to_owned(), other.to_string())),
    }
}
