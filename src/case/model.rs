//! The whole case.

use serde::Serialize;

use super::error::{CaseError, Refusal};
use super::node::Table;
use super::place::Place;
use super::reader::TableAt;
use super::surface::{self, Around};
use super::{
    FrictionSection, LatticeSection, LayerSection, LevelSection, LoadSection, LocalizedSection, Source, StressSection,
    SubstrateSection, SurfaceSection, UnitsSection,
};
use super::{grid, keys, lattice, layers, magnitude, overrides, solver};
use crate::body::{HalfSpace, MeanStress};
use crate::comparison::ComparisonTask;
use crate::counterbody::{Counterbody, Indenters, Level, Topography};
use crate::plain;
use crate::problem::Problem;
use crate::run::{Run, Sampling};
use crate::spectral::Settings;
use crate::units::Units;
use std::sync::Arc;

/// A valid case with every default resolved. It is read, never edited: overrides change it while it is read.
///
/// Serialised it has the keys of the case file; sections and keys that are absent are skipped.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Case {
    /// What the case is, one line; empty when not given.
    pub title: String,
    /// The cell.
    pub lattice: LatticeSection,
    /// Levels of indenters; empty with a surface.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub levels: Vec<LevelSection>,
    /// A topography instead of levels.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub surface: Option<SurfaceSection>,
    /// The coating's layers from the surface down; empty: uncoated.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub layers: Vec<LayerSection>,
    /// What the coating lies on.
    pub substrate: SubstrateSection,
    /// Load steps.
    pub load: LoadSection,
    /// Samples of the cell.
    pub grid: Sampling,
    /// Iteration.
    pub solver: Settings,
    /// Sliding; none: the indenters do not slide.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub friction: Option<FrictionSection>,
    /// Names of the units; none: not named.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub units: Option<UnitsSection>,
    /// Stresses wanted; none: no stresses.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stress: Option<StressSection>,
    /// Circles of the localized method.
    pub localized: LocalizedSection,
    /// What its surface makes doubtful, a sentence each.
    #[serde(skip)]
    surface_doubts: Vec<String>,
    #[serde(skip)]
    problem: Arc<Problem>,
}

impl Case {
    /// Read a case and change it by `overrides`, each `KEY=VALUE`, in their order.
    ///
    /// # Errors
    /// [`CaseError`] for the first fault found: TOML, unknown, missing or misspelt keys, types, ranges.
    pub fn read(source: &Source, overrides: &[String]) -> Result<Self, CaseError> {
        read(source, overrides).map_err(|refusal| CaseError::new(source, overrides, refusal))
    }

    /// The case as TOML, complete with its defaults; it reads back equal.
    pub fn to_toml(&self) -> String {
        written(self).expect("keys are strings, integers come from TOML, absent values are skipped")
    }

    /// What is pressed into what.
    pub fn problem(&self) -> &Arc<Problem> {
        &self.problem
    }

    /// The rigid counterbody: indenters on their lattice, or a topography.
    pub fn counterbody(&self) -> &Counterbody {
        self.problem.counterbody()
    }

    /// The layers on the substrate.
    pub fn half_space(&self) -> &HalfSpace {
        self.problem.half_space()
    }

    /// What lengths and pressures are measured in, by name or as far as the problem shows it.
    pub fn units(&self) -> Units {
        let name = |of: fn(&UnitsSection) -> &Option<String>| self.units.as_ref().and_then(|own| of(own).as_deref());
        Units::of(&self.problem).named(name(|own| &own.length), name(|own| &own.pressure))
    }

    /// What was found doubtful when its surface was read, a sentence each.
    pub(super) fn surface_doubts(&self) -> &[String] {
        &self.surface_doubts
    }

    /// What `percoat compare` does: the last load by both methods.
    pub fn comparison(&self) -> ComparisonTask {
        let LocalizedSection { indenters, elements, radius, mutual_effect } = &self.localized;
        let loads = self.load.loads();
        ComparisonTask {
            problem: Arc::clone(&self.problem),
            load: loads[loads.len() - 1],
            settings: self.solver,
            indenters: indenters.clone(),
            elements: *elements,
            rule: *radius,
            mutual_effect: *mutual_effect,
            mean: self.mean_stress(),
        }
    }

    /// The mean lateral stress of largest stresses and limits: the default without a section `stress`.
    pub fn mean_stress(&self) -> MeanStress {
        self.stress.as_ref().map_or(MeanStress::default(), |stress| stress.mean)
    }

    /// What `percoat solve` does.
    pub fn run(&self) -> Run {
        Run {
            problem: Arc::clone(&self.problem),
            loads: self.load.loads(),
            sampling: self.grid,
            settings: self.solver,
            stress: self.stress.as_ref().map(|stress| stress.request(self.counterbody())),
        }
    }
}

/// A case as TOML: one that has been read, or what a result says of it, which may be anything.
pub(crate) fn written(case: &impl Serialize) -> Result<String, toml::ser::Error> {
    let text = plain::toml(case)?;
    Ok(text.lines().fold(String::new(), |text, line| text + &readable(line) + "\n"))
}

/// A line `key = value` with the numbers of the value as a person would write them: 2e-7 for 0.0000002.
fn readable(line: &str) -> String {
    let Some((key, value)) = line.split_once(" = ").filter(|(_, value)| !value.starts_with(['"', '\''])) else {
        return line.to_owned();
    };
    let numbers = value.split_inclusive(['[', ']', ',']).map(|part| {
        let number = part.trim_end_matches(['[', ']', ',']).trim_start();
        match number.parse::<f64>() {
            Ok(x) if number.contains('.') && x != 0.0 && !(1e-3..1e6).contains(&x.abs()) => {
                part.replace(number, &format!("{x:e}"))
            }
            _ => part.to_owned(),
        }
    });
    format!("{key} = {}", numbers.collect::<String>())
}

fn read(source: &Source, overrides: &[String]) -> Result<Case, Refusal> {
    let mut root = Table::parse(&source.text)?;
    for (number, text) in (1..).zip(overrides) {
        overrides::apply(text, number, &mut root)?;
    }
    let end = source.text.trim_end().len();
    let root = TableAt::root(&root, &keys::CASE, Place::new(0, end..end));
    root.only()?;
    let title = root.value("title")?;
    let title = match title.text()? {
        text if text.contains('\n') => return Err(title.refuse_form()),
        text => text.to_owned(),
    };

    let level_sections = root.sections("levels")?;
    let levels: Vec<LevelSection> = level_sections.iter().map(LevelSection::read).collect::<Result<_, _>>()?;
    let surface_section = match (&level_sections[..], root.section("surface")?) {
        ([], Some(section)) => Some(section),
        ([_, ..], None) => None,
        ([_, ..], Some(section)) => return Err(root.both(["levels", "surface"], section.place)),
        ([], None) => {
            root.required_section("lattice")?;
            let refusal = Refusal::new(root.place, "the case has neither [[levels]] nor [surface]", "none up to here");
            return Err(refusal.help(format!("add a level, for example\n{}", root.example("levels"))));
        }
    };
    let grid_section = root.section_or_empty("grid")?;
    // Where the cell is said to be what it is: a surface may say it itself.
    let cell_section = match (&surface_section, root.section("lattice")?) {
        (Some(surface), None) => surface.clone(),
        _ => root.required_section("lattice")?,
    };
    let (lattice, surface, counterbody) = match &surface_section {
        Some(section) => {
            let (lattice, grid) = (root.section("lattice")?, grid_section.clone());
            let around = Around { source, lattice, grid, length: length_unit(&root)? };
            let read = surface::read(section, &around)?;
            let counterbody = Counterbody::from(read.topography);
            (read.lattice, Some((read.section, read.sampling, read.doubts)), Ok(counterbody))
        }
        None => {
            let lattice_section = LatticeSection::read(&cell_section)?;
            let built = levels.iter().zip(&level_sections).map(|(level, section)| level.build(section));
            let lattice = lattice::build(&lattice_section, &cell_section, &levels, &level_sections)?;
            let built: Vec<Level> = built.collect::<Result<_, _>>()?;
            magnitude::profiles(&built, &level_sections, lattice.cell())?;
            (lattice_section, None, Indenters::new(lattice, built).map(Counterbody::from))
        }
    };
    // Both were checked key by key.
    let counterbody = counterbody
        .map_err(|error| Refusal::new(cell_section.place, format!("`lattice`: {error}"), "no counterbody"))?;
    let layer_sections = root.sections("layers")?;
    let layers: Vec<LayerSection> = layer_sections.iter().map(LayerSection::read).collect::<Result<_, _>>()?;
    let substrate_section = root.required_section("substrate")?;
    let substrate = SubstrateSection::read(&substrate_section)?;
    let half_space = layers::build(&layers, &layer_sections, &substrate, &substrate_section)?;

    // One a layer of the half-space: the section where it stands.
    let places: Vec<&TableAt<'_>> = layers
        .iter()
        .zip(&layer_sections)
        .flat_map(|(layer, section)| std::iter::repeat_n(section, layer.sublayers()))
        .collect();
    magnitude::layers(&half_space, &places, counterbody.cell())?;

    let load = LoadSection::read(&root.required_section("load")?)?;
    let file_points = counterbody.topography().map(Topography::points);
    let (surface, sampling, surface_doubts) = match surface {
        Some((section, sampling, doubts)) => (Some(section), sampling, doubts),
        None => (None, grid::read(&grid_section, None)?, Vec::new()),
    };
    magnitude::grid(sampling, file_points, &grid_section, &cell_section, counterbody.cell())?;
    let solver_section = root.section_or_empty("solver")?;
    let settings = solver::read(&solver_section)?;
    let mut problem = Problem::new(counterbody, half_space);
    let mut friction = None;
    if let Some(section) = root.section("friction")? {
        let own = FrictionSection::read(&section)?;
        problem = own.slide(&section, &places, (problem, settings), &solver_section)?;
        friction = Some(own);
    }
    Ok(Case {
        title,
        lattice,
        grid: sampling,
        solver: settings,
        friction,
        units: root.section("units")?.as_ref().map(UnitsSection::read).transpose()?,
        stress: root
            .section("stress")?
            .map(|section| StressSection::read(&section, levels.len(), friction.map(|own| own.direction)))
            .transpose()?,
        localized: LocalizedSection::read(&root.section_or_empty("localized")?)?,
        levels,
        surface,
        layers,
        substrate,
        load,
        surface_doubts,
        problem: Arc::new(problem),
    })
}

/// `units.length`, where the case names its units.
fn length_unit(root: &TableAt<'_>) -> Result<Option<String>, Refusal> {
    let length = root.section("units")?.and_then(|units| units.optional("length"));
    length.map(|length| length.name().map(str::to_owned)).transpose()
}
