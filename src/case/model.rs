//! The whole case.

use super::counterbody::{self, CounterbodySections};
use super::error::{CaseError, Refusal};
use super::feasibility::magnitude;
use super::friction::FRICTION;
use super::grading::LAYERS;
use super::grid::{self, GRID};
use super::keys::{Form, Key};
use super::lattice::LATTICE;
use super::layers::{self, Body, LAYER, SUBSTRATE};
use super::levels::LEVELS;
use super::load::LOAD;
use super::localized::LOCALIZED;
use super::material_names::MaterialNames;
use super::overrides;
use super::place::Place;
use super::reader::TableAt;
use super::section::{KeyValue, section};
use super::solver::SOLVER;
use super::stress::STRESS;
use super::surface::SURFACE;
use super::units::UNITS;
use super::writer::written;
use super::{
    FrictionSection, LatticeSection, LayerSection, LevelSection, LoadSection, LocalizedSection, Source, StressSection,
    SubstrateSection, SurfaceSection, UnitsSection,
};
use crate::body::{HalfSpace, MeanStress};
use crate::comparison::ComparisonTask;
use crate::counterbody::{Counterbody, Topography};
use crate::problem::Problem;
use crate::run::{Run, Sampling, StressRequest};
use crate::spectral::Settings;
use crate::units::Units;
use std::sync::Arc;

section! { whole
    /// A valid case with every default resolved. It is read, never edited: overrides change it while it is read.
    ///
    /// Serialised it has the keys of the case file; sections and keys that are absent are skipped.
    pub struct Case = CASE {
        /// what the case is
        pub title: String =
            Key::new(&[Form::Text("a text of one line")], "\"three levels in contact\"").default("\"\""),
        /// the cell, and with it the places of the indenters
        pub lattice: LatticeSection = Key::new(&[Form::Table(&LATTICE)], "{ kind = \"hexagonal\", period = 1.0 }")
            .otherwise("needed, unless `surface` says how large the cell is"),
        /// indenters of one shape and height, one section `[[levels]]` a level
        pub levels: Vec<LevelSection> =
            Key::new(&[Form::Sections(&LEVELS, 200)], "[{ shape = \"paraboloid\", radius = 0.8, height = 0.0 }]")
                .omitted_as_nothing(),
        /// one period of any topography
        pub surface: Option<SurfaceSection> =
            Key::new(&[Form::Table(&SURFACE)], "{ heights = \"surface.npy\", period = 10.0 }").instead_of("levels"),
        /// the coating, one section `[[layers]]` a layer from the surface down
        pub layers: Vec<LayerSection> =
            Key::new(&[Form::Sections(&LAYER, LAYERS)], "[{ thickness = 0.5, shear_ratio = 2.0, poisson = 0.2 }]")
                .otherwise("uncoated")
                .rule("sublayers of graded layers count among the 200")
                .omitted_as_nothing(),
        /// what the coating lies on
        pub substrate: SubstrateSection = Key::new(&[Form::Table(&SUBSTRATE)], "{ young = 1.0, poisson = 0.3 }"),
        /// what is prescribed, one value a load step
        pub load: LoadSection = Key::new(&[Form::Table(&LOAD)], "{ mean_pressure = 0.01 }"),
        /// samples of the cell
        pub grid: Sampling = Key::new(&[Form::Table(&GRID)], "{ points = 256 }").otherwise("its defaults"),
        /// how the contact problem is solved, and how far
        pub solver: Settings =
            Key::new(&[Form::Table(&SOLVER)], "{ method = \"polonsky-keer\" }").otherwise("its defaults"),
        /// the indenters slide
        pub friction: Option<FrictionSection> =
            Key::new(&[Form::Table(&FRICTION)], "{ coefficient = 0.3 }").otherwise("they do not slide"),
        /// names for axes, tables and captions; numbers are not converted
        pub units: Option<UnitsSection> =
            Key::new(&[Form::Table(&UNITS)], "{ length = \"µm\", pressure = \"GPa\" }").otherwise("no names"),
        /// stresses that are wanted
        pub stress: Option<StressSection> =
            Key::new(&[Form::Table(&STRESS)], "{ planes = [0.0, 0.5], mean = \"half-space\" }").otherwise("no stresses"),
        /// circles of the localized method, for `compare`
        pub localized: LocalizedSection =
            Key::new(&[Form::Table(&LOCALIZED)], "{ indenters = [7, 37] }").otherwise("its defaults"),
    }
    beside {
        /// What its surface makes doubtful, a sentence each.
        surface_doubts: Vec<String>,
        problem: Arc<Problem>,
    }
}

impl Case {
    /// Read a case and change it by the values that its source sets and by `overrides`, each `KEY=VALUE`, in their order.
    ///
    /// # Errors
    /// [`CaseError`] for the first fault found: TOML, unknown, missing or misspelt keys, types, ranges.
    pub fn read(source: &Source, overrides: &[String]) -> Result<Self, CaseError> {
        source.read(overrides, |source| read(source, overrides))
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

    /// What the materials of the body are called.
    pub fn material_names(&self) -> MaterialNames {
        MaterialNames::of(&self.layers, &self.substrate)
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

    /// The stresses asked for where the key `stress.section` has this value.
    ///
    /// # Errors
    /// [`CaseError`] of a value that the key does not admit.
    pub fn section(&self, cut: &toml::Value) -> Result<StressRequest, CaseError> {
        let source = Source { set: vec![("stress.section".to_owned(), cut.clone())], ..Source::default() };
        source.read(&[], |source| {
            let root = source.tree(&CASE)?;
            let root = TableAt::root(&root, &CASE, Place::NOWHERE);
            let sliding = self.friction.map(|own| own.direction);
            let section = StressSection::read_in(&root.required_section("stress")?, self.levels.len(), sliding)?;
            Ok(section.request(self.counterbody()))
        })
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

fn read(source: &Source, overrides: &[String]) -> Result<Case, Refusal> {
    let mut root = source.tree(&CASE)?;
    for (number, text) in (1 + source.set.len()..).zip(overrides) {
        overrides::apply(text, number, &mut root, &CASE)?;
    }
    let end = source.text.trim_end().len();
    let root = TableAt::root(&root, &CASE, Place::new(0, end..end));
    root.only()?;
    let title = title(&root)?;
    let CounterbodySections { levels, lattice, cell_section, grid_section, surface, counterbody } =
        counterbody::read(&root, source)?;
    let Body { layers, substrate, half_space, sections } = layers::read(&root)?;
    // One a layer of the half-space: the section where it stands.
    let places = layers.iter().zip(&sections);
    let places = places.flat_map(|(layer, section)| std::iter::repeat_n(section, layer.sublayers()));
    let places: Vec<&TableAt<'_>> = places.collect();
    magnitude::layers(&half_space, &places, counterbody.cell())?;

    let load = LoadSection::read_table(&root.required_section("load")?)?;
    let file_points = counterbody.topography().map(Topography::points);
    let (surface, sampling, surface_doubts) = match surface {
        Some((section, sampling, doubts)) => (Some(section), sampling, doubts),
        None => (None, grid::read(&grid_section, None)?, Vec::new()),
    };
    magnitude::grid(sampling, file_points, &grid_section, &cell_section, counterbody.cell())?;
    let solver_section = root.section_or_empty("solver")?;
    let settings = Settings::read_table(&solver_section)?;
    let mut problem = Problem::new(counterbody, half_space);
    let mut friction = None;
    if let Some(section) = root.section("friction")? {
        let own = FrictionSection::read_table(&section)?;
        problem = own.slide(&section, &places, (problem, settings), &solver_section)?;
        friction = Some(own);
    }
    Ok(Case {
        title,
        lattice,
        grid: sampling,
        solver: settings,
        friction,
        units: root.section("units")?.as_ref().map(UnitsSection::read_table).transpose()?,
        stress: root
            .section("stress")?
            .map(|section| StressSection::read_in(&section, levels.len(), friction.map(|own| own.direction)))
            .transpose()?,
        localized: LocalizedSection::read_table(&root.section_or_empty("localized")?)?,
        levels,
        surface,
        layers,
        substrate,
        load,
        surface_doubts,
        problem: Arc::new(problem),
    })
}

fn title(root: &TableAt<'_>) -> Result<String, Refusal> {
    let title = root.value("title")?;
    match String::read(&title)? {
        text if text.contains('\n') => Err(title.refuse_form()),
        text => Ok(text),
    }
}
