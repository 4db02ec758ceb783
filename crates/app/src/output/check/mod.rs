//! The result of `percoat check`: problem, grid, memory and disk, first touches and warnings of a case.
//!
//! `first_touches`: the loads at which the levels of indenters begin to touch; `roughness`: statistics of a topography, and how the
//! heights of its file were prepared; `strengths`: strengths and residual stresses with their origin.

mod first_touches;
mod roughness;
mod strengths;

pub use first_touches::Touches;
pub use roughness::Roughness;

use super::described;
use super::number::number;
use super::table;
use first_touches::touches;
use percoat_case::case::resources::{Job, Needs, needs};
use percoat_case::case::{Case, LibraryStrength, foreseen, plausibility, sublayer_error};
use percoat_case::units::{Unit, Units};
use percoat_common::machine::{Capacity, bytes};
use percoat_common::plain;
use percoat_core::lattice::{Grid, LatticeError};
use percoat_core::problem::Problem;
use percoat_core::reading::FirstTouch;
use percoat_core::run::{RunError, Sampling};
use serde_json::{Value, json};
use std::convert::Infallible;
use std::fmt;

/// Letters of a line of its sentences.
const WIDTH: usize = 100;

/// Summary of a case before it is solved.
#[derive(Debug, Clone)]
pub struct Check {
    /// Title of the case, or its name where it has none.
    pub title: String,
    /// Counterbody and half-space in words.
    pub problem: [String; 2],
    /// Units of all numbers.
    pub units: Units,
    /// Number of sublayers of each layer, and their relative error of the surface compliance; `None` where no layer is graded.
    pub sublayers: Option<(Vec<usize>, f64)>,
    /// The finest grid, points along a₁ and a₂.
    pub points: [usize; 2],
    /// The prescribed accuracy; `None` where the grid is prescribed.
    pub accuracy: Option<f64>,
    /// The grid in words.
    pub grid: String,
    /// Memory and disk that solving takes at most, with pictures.
    pub needs: Needs,
    /// Memory without pictures, bytes.
    pub without_pictures: u64,
    /// Memory and disk of the machine.
    pub room: Capacity,
    /// `mean_pressure`, `force` or `penetration`.
    pub quantity: &'static str,
    /// Loads in that quantity, one a load step.
    pub loads: Vec<f64>,
    /// Partial slip or rolling; `None` where nothing sticks.
    pub slip: Option<Slip>,
    /// Motion over a body that relaxes, a sentence each; empty at rest.
    pub motion: Vec<String>,
    /// Retardation of bodies under loads in time, a sentence each; empty where nothing depends on time.
    pub creep: Vec<String>,
    /// Law and regime of adhesion and what closed forms say, a sentence each; empty where surfaces do not pull.
    pub adhesion: Vec<String>,
    /// First touches of the levels; `None` for a topography.
    pub touches: Option<Touches>,
    /// Roughness of a topography; `None` for indenters.
    pub surface: Option<Roughness>,
    /// The strengths that are numbers of the library.
    pub library_strengths: Vec<LibraryStrength>,
    /// Strengths and residual stresses with their origin, a sentence for each part of the bodies; empty where none is given.
    pub strengths: Vec<String>,
    /// Warnings, a sentence each.
    pub warnings: Vec<String>,
}

/// Motion of a contact that sticks and slips.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Slip {
    /// Whether the contact rolls.
    pub rolls: bool,
    /// Number of its steps.
    pub steps: usize,
}

/// Why a case cannot be solved.
#[derive(Debug, thiserror::Error)]
pub enum CheckError {
    /// The run is refused.
    #[error(transparent)]
    Run(#[from] RunError<Infallible>),
    /// The grid is refused.
    #[error(transparent)]
    Grid(#[from] LatticeError),
}

impl Check {
    /// Checks a case; `name` replaces an empty title, `room` is the memory and disk of the machine.
    ///
    /// # Errors
    /// [`CheckError`].
    pub fn of(case: &Case, name: &str, room: Capacity) -> Result<Self, CheckError> {
        case.run().check()?;
        let cell = case.problem().cell();
        let grids = case.grid.grids(&cell).map_err(RunError::<Infallible>::from)?;
        let points = grids[grids.len() - 1];
        let units = case.units();
        let (accuracy, grid) = match case.grid {
            Sampling::Points(points) => (None, described::grid(&units, &Grid::new(cell, points)?)),
            Sampling::Accuracy(accuracy) => {
                (Some(accuracy), format!("grid: refined until results change by less than {accuracy}"))
            }
        };
        let solving = |pictures| needs(case, points, Job::Solve { pictures, fields: true });
        let (touches_on, found) = touches(case, grids[0])?.unzip();
        let pressure = |touch: &Option<FirstTouch>| touch.map(|touch| touch.mean_pressure);
        let pressures: Vec<Option<f64>> = found.iter().flatten().map(pressure).collect();
        let warnings = [plausibility::of_case(case), foreseen(case, &pressures)].concat();
        let touches = touches_on.zip(found).map(|(points, found)| Touches::new(points, &found, units.quantity(), cell));
        // Surfaces with partial slip are elastic.
        let slip =
            case.tangential.as_ref().map(|tangential| Slip { rolls: tangential.rolls(), steps: case.step_count() });
        let problem = if slip.is_some() { case.problem().without_hardness() } else { Problem::clone(case.problem()) };
        let counts = || case.layers.iter().map(percoat_case::case::LayerSection::sublayers).collect();
        Ok(Self {
            title: if case.title.is_empty() { name.to_owned() } else { case.title.clone() },
            problem: [described::loaded_by(&units, case.problem()), described::bodies(&units, &problem)],
            units,
            sublayers: sublayer_error(case).map(|error| (counts(), error)),
            points,
            accuracy,
            grid,
            needs: solving(true),
            without_pictures: solving(false).memory,
            room,
            quantity: case.load.quantity(),
            loads: case.load.values().to_vec(),
            slip,
            motion: [table::motion_words(case.problem(), &case.units()), table::heat_words(case.problem())].concat(),
            creep: table::creep_words(case, &case.units()),
            adhesion: table::adhesion_words(case, &case.units()),
            touches,
            surface: Roughness::of(case)?,
            library_strengths: LibraryStrength::of_case(&json!(case)),
            strengths: strengths::sentences(&json!(case)),
            warnings,
        })
    }

    /// The check as a JSON object: lengths, pressures and bytes under names.
    pub fn json(&self) -> Value {
        let Self { title, points, accuracy, needs, room, quantity, loads, warnings, .. } = self;
        json!({
            "title": title,
            "points": points,
            "accuracy": accuracy,
            "memory": needs.memory,
            "memory_available": room.memory,
            "disk": needs.disk,
            "load": { *quantity: loads },
            "first_touch": self.touches.as_ref().map(Touches::loads),
            "first_touch_error": self.touches.as_ref().map(Touches::errors),
            "first_touch_quantity": self.touches.as_ref().map(|touches| touches.quantity.key()),
            "sublayer_error": self.sublayers.as_ref().map(|(_, error)| error),
            "surface": self.surface.as_ref().map(Roughness::json),
            "library_strengths": self.library_strengths,
            "warnings": warnings,
            "text": self.to_string(),
        })
    }
}

/// The names of the units in a line; empty where they have none.
fn named(units: &Units) -> String {
    let named = |of: &str, unit: &Unit| unit.name().map(|name| format!("{of} in {name}"));
    let names =
        [named("lengths", units.length()), named("pressures", units.pressure()), named("forces", &units.force())];
    names.into_iter().flatten().collect::<Vec<_>>().join(", ")
}

impl fmt::Display for Check {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [counterbody, half_space] = &self.problem;
        writeln!(f, "{}\n\n{counterbody}\n\n{half_space}\n", plain::line(&self.title))?;
        let units = named(&self.units);
        if !units.is_empty() {
            writeln!(f, "units: {units}")?;
        }
        if let Some((sublayers, error)) = &self.sublayers {
            write_sublayers(f, sublayers, *error)?;
        }
        writeln!(f, "{}", self.grid)?;
        let Needs { memory, disk, disk_while_running } = self.needs;
        let free = if self.room.disk == u64::MAX { String::new() } else { format!(", {} free", bytes(self.room.disk)) };
        let most = if self.accuracy.is_some() { "at most " } else { "" };
        writeln!(
            f,
            "memory: about {most}{} ({} without pictures), {} available",
            bytes(memory),
            bytes(self.without_pictures),
            bytes(self.room.memory)
        )?;
        writeln!(f, "disk: about {most}{}, {} while it runs{free}", bytes(disk), bytes(disk_while_running))?;
        let unit = match self.quantity {
            "penetration" | "grip" => self.units.length().clone(),
            "force" => self.units.force(),
            _ => self.units.pressure().clone(),
        };
        let unit = unit.suited(self.loads.iter().copied());
        let [first, mut last] = [self.loads[0], self.loads[self.loads.len() - 1]];
        if !self.creep.is_empty() {
            // A path in time may come back.
            last = self.loads.iter().copied().fold(last, f64::max);
        }
        let last = unit.with_unit(last, number);
        match self.loads.len() {
            1 => writeln!(f, "load: {} {last}", self.quantity)?,
            count => writeln!(f, "load: {} {} … {last}, {count} steps", self.quantity, number(unit.shown(first)))?,
        }
        if let Some(Slip { rolls, steps }) = self.slip {
            let how = if rolls { "rolls at each load" } else { "sticks and slips" };
            writeln!(f, "tangential: the contact {how}, steps: {steps}; surfaces are elastic, a hardness is left out")?;
        }
        let told = self.motion.iter().chain(&self.creep).chain(&self.adhesion);
        told.into_iter().try_for_each(|sentence| f.write_str(&table::indented(sentence, WIDTH)))?;
        let none = if self.strengths.is_empty() { " none given, failure is not checked" } else { "" };
        writeln!(f, "strengths:{none}")?;
        self.strengths.iter().try_for_each(|sentence| f.write_str(&table::indented(sentence, WIDTH)))?;
        if let Some(Touches { points: [n1, n2], quantity, levels }) = &self.touches {
            writeln!(f, "first touch, on {n1} × {n2} samples:")?;
            for (level, touch) in (1..).zip(levels) {
                match *touch {
                    Some((load, error)) => {
                        let load = described::load_with_error(&self.units, load, error);
                        writeln!(f, "  level {level}: {} {load}", quantity.name())?;
                    }
                    None => writeln!(f, "  level {level}: never, it is hidden behind the others")?,
                }
            }
        }
        self.surface.as_ref().map_or(Ok(()), |surface| surface.write(f, &self.units))
    }
}

/// Writes the material numbers of each layer, and the error by the sublayers.
fn write_sublayers(f: &mut fmt::Formatter<'_>, sublayers: &[usize], error: f64) -> fmt::Result {
    let mut material = 1;
    for (number, &count) in (1..).zip(sublayers) {
        let last = material + count - 1;
        match count {
            1 => writeln!(f, "layer {number}: material {material}")?,
            _ => writeln!(
                f,
                "layer {number}: materials {material} to {last}, {count} sublayers from its upper face down"
            )?,
        }
        material += count;
    }
    writeln!(f, "surface compliance: error by the sublayers about {error:.1e}\n")
}

#[cfg(test)]
mod tests {
    use super::*;
    use percoat_case::case::Source;
    use std::f64::consts::PI;

    /// Two paraboloids far from each other, the lower one by d: the upper one carries 4/3 E* δ^{3/2} when the surface under the lower
    /// one, at a distance r, has come up to it: δ = d + P/(πE*r).
    #[test]
    fn levels_of_an_isolated_contact_first_touch_at_a_force() {
        let modulus = 1.0 / 0.91;
        let force = |depth: f64| 4.0 / 3.0 * modulus * f64::powf(depth, 1.5);
        let exact = force((0..60).fold(0.04, |depth, _| 0.04 + force(depth) / (PI * modulus * 3.0)));
        for load in ["force = 0.1", "penetration = 0.1"] {
            let text = format!(
                "lattice = {{ kind = \"isolated\", size = 6.0 }}\nload = {{ {load} }}\ngrid = {{ points = 64 }}\n\
                 levels = [{{ shape = \"paraboloid\", radius = 1.0, height = 0.04, sites = [[-0.25, 0.0]] }}, \
                 {{ shape = \"paraboloid\", radius = 1.0, height = 0.0, sites = [[0.25, 0.0]] }}]\n\
                 substrate = {{ young = 1.0, poisson = 0.3 }}\nunits = {{ length = \"µm\", pressure = \"GPa\" }}\n"
            );
            let source = Source { name: "case".to_owned(), text, ..Source::default() };
            let room = Capacity { memory: u64::MAX, disk: u64::MAX };
            let check = Check::of(&Case::read(&source, &[]).unwrap(), "case", room).unwrap();
            let told = check.json();
            assert_eq!((&told["first_touch_quantity"], &told["first_touch"][0]), (&json!("force"), &json!(0.0)));
            let [found, error] =
                ["first_touch", "first_touch_error"].map(|key| told[key][1].as_f64().unwrap_or(f64::NAN));
            assert!((found - exact).abs() < error && error < 0.05 * exact, "{found} ± {error}, {exact}");
            // GPa·µm² = mN.
            let micro = crate::output::with_error(1e3 * found, Some(1e3 * error));
            let stated = format!("  level 2: force {micro}\u{a0}µN");
            assert!(check.to_string().contains(&stated), "{stated}:\n{check}");
        }
    }

    #[test]
    fn what_surfaces_and_interfaces_bear_is_said_with_its_units() {
        let law = "{ amplitude = 0.4, passes = 1e6, exponent = 8 }";
        let text = format!(
            "lattice = {{ kind = \"isolated\", size = 6.0 }}\nlevels = [{{ shape = \"paraboloid\", radius = 1.0 }}]\n\
             layers = [{{ thickness = 1.0, young = 300.0, poisson = 0.25, hardness = 24.0, interface_fatigue = {law} }}]\n\
             substrate = {{ young = 210.0, poisson = 0.3, wear = 1e-9, fatigue = {law}, endurance = {{ torsion = 0.3, bending = 0.5 }} }}\n\
             counterbody = {{ rigid = true, hardness = 9.0 }}\nload = {{ force = 0.1 }}\ngrid = {{ points = 64 }}\n\
             units = {{ length = \"µm\", pressure = \"GPa\" }}\n"
        );
        let source = Source { name: "case".to_owned(), text, ..Source::default() };
        let room = Capacity { memory: u64::MAX, disk: u64::MAX };
        let told =
            Check::of(&Case::read(&source, &[]).unwrap(), "case", room).unwrap().to_string().replace('\u{a0}', " ");
        for line in [
            "\n  hardness 24.000 GPa; lower face: fatigue after 1.0000e6 passes with a range of its shear of 0.40000 GPa, exponent 8.0000\n",
            "\n  wear 1.0000e-9 1/GPa; fatigue after 1.0000e6 passes with a range of τ₁ of 0.40000 GPa, exponent 8.0000; endurance 0.30000 GPa \
             in torsion, 0.50000 GPa in bending\n",
            "\ncounterbody: rigid\n  hardness 9.0000 GPa\n",
            "\npressure: at most 9.0000 GPa, the hardness of the surface of the counterbody\n",
        ] {
            assert!(told.contains(line), "{line} does not stand in\n{told}");
        }
    }
}
