//! The whole case.

use super::adhesion::ADHESION;
use super::composite_hardness::COMPOSITE_HARDNESS;
use super::counterbody::{self, CounterbodySections};
use super::elastic_counterbody::{self, Above, COUNTERBODY};
use super::error::{CaseError, Refusal};
use super::feasibility::{hardness, magnitude};
use super::friction::FRICTION;
use super::grading::LAYERS;
use super::grid::{self, GRID};
use super::heat::{self, HEAT, HeatSection};
use super::keys::{Form, Key};
use super::lattice::LATTICE;
use super::layers::{self, Body, LAYER, SUBSTRATE};
use super::levels::LEVELS;
use super::life::LIFE;
use super::load::{self, LOAD};
use super::localized::LOCALIZED;
use super::materials;
use super::measures::{self, NoLoad};
use super::motion::{MOTION, MotionSection};
use super::node::Table;
use super::reader::TableAt;
use super::section::{KeyValue, ReadTable, section};
use super::solver::SOLVER;
use super::span::Span;
use super::stress::STRESS;
use super::surface::SURFACE;
use super::tangential::TANGENTIAL;
use super::time::{TIME, TimeSection};
use super::units::UNITS;
use super::writer::written;
use super::{
    AdhesionSection, CompositeHardnessSection, CounterbodySection, FrictionSection, LatticeSection, LayerSection,
    LevelSection, LifeSection, LoadSection, LocalizedSection, Source, StressSection, SubstrateSection, SurfaceSection,
    TangentialSection, UnitsSection,
};
use crate::units::Units;
use percoat_core::body::{Bodies, HalfSpace, MeanStress};
use percoat_core::comparison::ComparisonTask;
use percoat_core::counterbody::LoadedBy;
use percoat_core::lattice::Cell;
use percoat_core::life::LifeTask;
use percoat_core::load::LoadQuantity;
use percoat_core::problem::Problem;
use percoat_core::run::{Run, Sampling, StressRequest};
use percoat_core::spectral::Settings;
use std::sync::Arc;

/// Relative error of a step of wear without a section `[life]`.
const LIFE_TOLERANCE: f64 = 1e-2;

section! { whole
    /// A valid case with every default resolved. Its values do not change after reading; overrides act while it is read.
    ///
    /// Serialised it has the keys of the case file; sections and keys that are absent are skipped.
    pub struct Case = CASE {
        /// title of the case
        pub title: String =
            Key::new(&[Form::Text("a text of one line")], "\"three levels in contact\"").default("\"\""),
        /// the cell and the places of the indenters
        pub lattice: LatticeSection = Key::new(&[Form::Table(&LATTICE)], "{ kind = \"hexagonal\", period = 1.0 }")
            .otherwise("required, unless `surface` gives the size of the cell"),
        /// indenters of one shape and height, one section `[[levels]]` a level
        pub levels: Vec<LevelSection> =
            Key::new(&[Form::Sections(&LEVELS, 200)], "[{ shape = \"paraboloid\", radius = 0.8, height = 0.0 }]")
                .otherwise("required, or `surface`, unless `load.pressure` is given")
                .omitted_as_nothing(),
        /// one period of any topography
        pub surface: Option<SurfaceSection> =
            Key::new(&[Form::Table(&SURFACE)], "{ heights = \"surface.npy\", period = 10.0 }").instead_of("levels")
                .otherwise("required, or `levels`, unless `load.pressure` is given"),
        /// a file of one's own materials, which come before those of `percoat materials`
        pub materials: Option<String> =
            Key::new(&[Form::Text("the path of a file")], "\"own.toml\"").otherwise("those of `percoat materials`"),
        /// the coating, one section `[[layers]]` a layer from the surface down
        pub layers: Vec<LayerSection> =
            Key::new(&[Form::Sections(&LAYER, LAYERS)], "[{ thickness = 0.5, shear_ratio = 2.0, poisson = 0.2 }]")
                .otherwise("uncoated")
                .rule("sublayers of graded layers count among the 200")
                .omitted_as_nothing(),
        /// the material below the layers, or a rigid base
        pub substrate: SubstrateSection = Key::new(&[Form::Table(&SUBSTRATE)], "{ young = 1.0, poisson = 0.3 }"),
        /// the body that the indenters or the topography belong to
        pub counterbody: Option<CounterbodySection> = Key::new(&[Form::Table(&COUNTERBODY)], "{ young = 210.0, poisson = 0.3 }").otherwise("rigid"),
        /// mean pressure, force, penetration or position of a grip, one value a load step, or a given pressure
        pub load: LoadSection = Key::new(&[Form::Table(&LOAD)], "{ mean_pressure = 0.01 }")
            .otherwise("required, or `time`"),
        /// samples of the cell
        pub grid: Sampling = Key::new(&[Form::Table(&GRID)], "{ points = 256 }").otherwise("its defaults"),
        /// method, tolerance and iterations of the solver
        pub solver: Settings =
            Key::new(&[Form::Table(&SOLVER)], "{ method = \"polonsky-keer\" }").otherwise("its defaults"),
        /// sliding friction of the indenters
        pub friction: Option<FrictionSection> =
            Key::new(&[Form::Table(&FRICTION)], "{ coefficient = 0.3 }").otherwise("no friction"),
        /// tangential force or shift of a contact that sticks and slips
        pub tangential: Option<TangentialSection> =
            Key::new(&[Form::Table(&TANGENTIAL)], "{ force = [0.3, -0.3, 0.3] }").otherwise("with [friction] the counterbody slides"),
        /// how the two surfaces pull each other
        pub adhesion: Option<AdhesionSection> =
            Key::new(&[Form::Table(&ADHESION)], "{ work = 0.05, range = 0.001 }").otherwise("surfaces do not pull"),
        /// velocity of a counterbody, or of a given pressure, that moves steadily over a body that relaxes
        pub motion: Option<MotionSection> =
            Key::new(&[Form::Table(&MOTION)], "{ velocity = 1.0 }").otherwise("materials that relax are relaxed"),
        /// heat of friction of a counterbody that moves steadily
        pub heat: Option<HeatSection> =
            Key::new(&[Form::Table(&HEAT)], "{ partition = 0.5 }").otherwise("solved, where all materials conduct"),
        /// loads that change in time on bodies that creep
        pub time: Option<TimeSection> =
            Key::new(&[Form::Table(&TIME)], "{ load = [[0.0, 0.0], [1.0, 0.05], [100.0, 0.05]] }").instead_of("load")
                .otherwise("required, or `load`: materials that relax are relaxed"),
        /// hardness of a coating and its substrate together
        pub composite_hardness: Option<CompositeHardnessSection> =
            Key::new(&[Form::Table(&COMPOSITE_HARDNESS)], "{ law = \"area\", constant = 0.5 }")
                .otherwise("each surface has its own"),
        /// names for axes, tables and captions, to which numbers with a unit are converted
        pub units: Option<UnitsSection> =
            Key::new(&[Form::Table(&UNITS)], "{ length = \"µm\", pressure = \"GPa\" }").otherwise("no names"),
        /// stresses to be computed
        pub stress: Option<StressSection> =
            Key::new(&[Form::Table(&STRESS)], "{ planes = [0.0, 0.5], mean = \"half-space\" }").otherwise("no stresses"),
        /// circles of the localized method, for `compare`
        pub localized: LocalizedSection =
            Key::new(&[Form::Table(&LOCALIZED)], "{ indenters = [7, 37] }").otherwise("its defaults"),
        /// how far `percoat life` follows wear and fatigue
        pub life: Option<LifeSection> =
            Key::new(&[Form::Table(&LIFE)], "{ passes = 1e7 }").otherwise("only to the first failure"),
    }
    beside {
        /// Warnings about its surface, a sentence each.
        file_doubts: Vec<String>,
        problem: Arc<Problem>,
    }
}

impl Case {
    /// The case as TOML, complete with its defaults; it reads back equal.
    pub fn to_toml(&self) -> String {
        written(self).expect("keys are strings, integers come from TOML, absent values are skipped")
    }

    /// Counterbody and bodies.
    pub fn problem(&self) -> &Arc<Problem> {
        &self.problem
    }

    /// The layers on the substrate of the body.
    pub fn half_space(&self) -> &HalfSpace {
        self.problem.half_space()
    }

    /// Units of lengths and pressures: their names, or quantities of the problem where they have none.
    pub fn units(&self) -> Units {
        let name =
            |of: fn(&UnitsSection) -> &Option<String>| self.units.as_ref().and_then(|units| of(units).as_deref());
        let units = Units::of(&self.problem)
            .named(name(|units| &units.length), name(|units| &units.pressure))
            .with_time(name(|units| &units.time))
            .with_temperature(name(|units| &units.temperature));
        if self.load.force.is_some() { units.with_loads_in(LoadQuantity::Force) } else { units }
    }

    /// The load of a text such as "20 N", in the quantity and the units of the case; a number alone is in these units.
    ///
    /// # Errors
    /// [`NoLoad`] for what is no number above 0, with a unit or without, and for a unit of something else.
    pub fn load_of(&self, text: &str) -> Result<f64, NoLoad> {
        measures::load(text, &self.units())
    }

    /// The mean pressures p̄; `None` where penetrations or positions of a grip are prescribed.
    pub fn mean_pressures(&self) -> Option<Vec<f64>> {
        self.load.mean_pressures(self.problem.cell().area())
    }

    /// Number of load steps.
    pub fn step_count(&self) -> usize {
        let loads = self.load.values().len();
        self.tangential.as_ref().map_or(loads, |tangential| tangential.step_count(loads))
    }

    /// Warnings about its surface, a sentence each.
    pub(super) fn file_doubts(&self) -> &[String] {
        &self.file_doubts
    }

    /// The task of `percoat compare`: the last load by both methods.
    pub fn comparison(&self) -> ComparisonTask {
        let LocalizedSection { indenters, elements, radius, mutual_effect } = &self.localized;
        let loads = self.load.loads();
        // The localized method has no hardness.
        let is_elastic = self.problem.bodies().hardness().is_none();
        let elastic = || Arc::new(self.problem.without_hardness());
        ComparisonTask {
            problem: if is_elastic { Arc::clone(&self.problem) } else { elastic() },
            load: loads[loads.len() - 1],
            settings: self.solver,
            indenters: indenters.clone(),
            elements: *elements,
            rule: *radius,
            mutual_effect: *mutual_effect,
            mean: self.mean_stress(),
        }
    }

    /// The task of `percoat life`, on the grid of the case or, where an accuracy is prescribed, on the finest one of 512 points at most.
    ///
    /// # Errors
    /// A sentence for a case with several loads, a given pressure, or a cell that is too oblong.
    pub fn life_task(&self) -> Result<LifeTask, String> {
        if self.time.is_some() {
            return Err("a life has no loads in time: wear and passes of bodies that creep are not followed; give [load] instead of [time]".to_owned());
        }
        let loads = self.load.loads();
        let [load] = loads[..] else {
            return Err(format!(
                "a life has one load in all passes, and the case has {}: give one by --set load.{}=…, or read the passes of each from percoat \
                 solve",
                loads.len(),
                self.load.quantity()
            ));
        };
        if self.adhesion.is_some() {
            return Err("a life has no adhesion: wear and fatigue pass after pass are those of surfaces that do not pull; leave [adhesion] out".to_owned());
        }
        if self.motion.is_some() {
            return Err("a life has no steady motion: wear and passes of a load that moves steadily are not followed; leave [motion] out".to_owned());
        }
        if self.problem.kind().is_given {
            return Err(
                "a given pressure has no surfaces that wear: percoat solve states the passes to the first damage"
                    .to_owned(),
            );
        }
        Ok(LifeTask {
            problem: Arc::clone(&self.problem),
            load,
            sampling: self.grid,
            settings: self.solver,
            mean: self.mean_stress(),
            passes: self.life.and_then(|life| life.passes),
            distance: self.life.and_then(|life| life.distance),
            stroke: self.life.and_then(|life| life.stroke),
            tolerance: self.life.map_or(LIFE_TOLERANCE, |life| life.tolerance),
            motions: self.run().motions,
        })
    }

    /// The mean lateral stress in largest stresses and limits; the default without a section `stress`.
    pub fn mean_stress(&self) -> MeanStress {
        self.stress.as_ref().map_or(MeanStress::default(), |stress| stress.mean)
    }

    /// The request of stresses on a vertical section, from a value of the key `stress.section`.
    ///
    /// # Errors
    /// [`CaseError`] of a value that the key does not admit.
    pub fn section(&self, cut: &toml::Value) -> Result<StressRequest, CaseError> {
        let source = Source { set: vec![("stress.section".to_owned(), cut.clone())], ..Source::default() };
        source.read(&[], |source| {
            let root = source.tree(&CASE)?;
            let root = TableAt::root(&root, &CASE, Span::NOWHERE);
            let sliding = self.friction.map(|friction| friction.direction);
            let section = StressSection::read_in(&root.required_section("stress")?, &self.problem, sliding)?;
            Ok(section.request(&self.problem))
        })
    }

    /// Whether a run has stresses on a vertical cut.
    pub fn has_cut(&self) -> bool {
        self.stress.as_ref().is_some_and(|stress| stress.cut(&self.problem).is_some())
    }

    /// The run of `percoat solve`.
    pub fn run(&self) -> Run {
        let friction = self.problem.friction();
        let (loads, motions) = match &self.tangential {
            None => (self.load.loads(), None),
            Some(tangential) => {
                let (loads, motions) = tangential.steps(self.load.loads(), friction);
                (loads, Some(motions))
            }
        };
        Run {
            problem: Arc::clone(&self.problem),
            loads,
            motions,
            times: self.time.as_ref().map(TimeSection::times),
            sampling: self.grid,
            settings: self.solver,
            stress: self.stress.as_ref().map(|stress| stress.request(&self.problem)),
        }
    }
}

/// The case of a tree, which is that of a source with what is set in it.
pub(super) fn read(mut root: Table, source: &Source) -> Result<Case, Refusal> {
    measures::convert(&mut root, &CASE)?;
    materials::fill(&mut root, &CASE, source)?;
    let root = TableAt::root(&root, &CASE, end_of(source));
    root.only()?;
    let title = title(&root)?;
    let CounterbodySections { levels, lattice, cell_section, grid_section, surface, doubts: file_doubts, loaded_by } =
        counterbody::read(&root, source)?;
    let (body, above, bodies) = bodies(&root, loaded_by.cell())?;
    let Loads { load, section: load_section, time } = Loads::read(&root, source, &loaded_by)?;
    let file_points = loaded_by.samples().map(|samples| samples.dim().into());
    let (surface, sampling) = match surface {
        Some((section, sampling)) => (Some(section), sampling),
        None => (None, grid::read(&grid_section, file_points)?),
    };
    magnitude::grid(sampling, file_points, &grid_section, &cell_section, loaded_by.cell())?;
    let solver_section = root.section_or_empty("solver")?;
    let settings = Settings::read_table(&solver_section)?;
    let problem = Problem::new(loaded_by, bodies);
    let places = [body.places(), above.iter().flat_map(|above| &above.body).flat_map(Body::places).collect()];
    let Surfaces { mut problem, friction, adhesion, motion, heat } =
        Surfaces::read(&root, &places, (problem, settings), &solver_section)?;
    let mut composite_hardness = None;
    if let Some(section) = root.section("composite_hardness")? {
        let keys = CompositeHardnessSection::read_table(&section)?;
        problem = keys.harden(&section, &load, problem)?;
        composite_hardness = Some(keys);
    }
    time.as_ref().map(|_| TimeSection::follow(&load_section, &root, &problem)).transpose()?;
    hardness::bears(&load, &load_section, &problem)?;
    let tangential = TangentialSection::of_case(&root, &problem, friction.as_ref(), &load)?;
    Ok(Case {
        title,
        materials: materials::path(&root, source)?,
        lattice,
        grid: sampling,
        solver: settings,
        friction,
        tangential,
        adhesion,
        motion,
        heat,
        composite_hardness,
        units: root.section("units")?.as_ref().map(UnitsSection::read_table).transpose()?,
        stress: root
            .section("stress")?
            .map(|section| StressSection::read_in(&section, &problem, friction.map(|friction| friction.direction)))
            .transpose()?,
        localized: LocalizedSection::read_table(&root.section_or_empty("localized")?)?,
        life: root.section("life")?.as_ref().map(LifeSection::read_table).transpose()?,
        levels,
        surface,
        layers: body.layers,
        substrate: body.substrate,
        counterbody: above.map(|above| above.section),
        load,
        time,
        file_doubts,
        problem: Arc::new(problem),
    })
}

/// The loads of a case, with the section `[load]` or `[time]` that has them.
struct Loads<'a> {
    load: LoadSection,
    section: TableAt<'a>,
    time: Option<TimeSection>,
}

impl<'a> Loads<'a> {
    /// Reads the one of the sections `[load]` and `[time]` that is there.
    fn read(root: &TableAt<'a>, source: &Source, loaded_by: &LoadedBy) -> Result<Self, Refusal> {
        let in_time = root.section("time")?;
        match (in_time, root.section("load")?) {
            (Some(time), Some(_)) => Err(root.both(["load", "time"], time.span)),
            (Some(section), None) => {
                let time = TimeSection::read_table(&section)?;
                Ok(Self { load: time.loads(), section, time: Some(time) })
            }
            (None, _) => {
                let (section, adheres) = (root.required_section("load")?, root.section("adhesion")?.is_some());
                Ok(Self { load: load::read(&section, source, loaded_by, adheres)?, section, time: None })
            }
        }
    }
}

/// The problem with what its surfaces do to each other beside pressing.
struct Surfaces {
    problem: Problem,
    friction: Option<FrictionSection>,
    adhesion: Option<AdhesionSection>,
    motion: Option<MotionSection>,
    heat: Option<HeatSection>,
}

impl Surfaces {
    /// Reads the sections `[friction]`, `[adhesion]`, `[motion]` and `[heat]`; `places` are the layers of both bodies.
    fn read(
        root: &TableAt<'_>,
        places: &[Vec<&TableAt<'_>>; 2],
        (problem, settings): (Problem, Settings),
        solver: &TableAt<'_>,
    ) -> Result<Self, Refusal> {
        let mut all = Self { problem, friction: None, adhesion: None, motion: None, heat: None };
        if let Some(section) = root.section("friction")? {
            let keys = FrictionSection::read_table(&section)?;
            all.problem = keys.slide(&section, places, (all.problem, settings), solver)?;
            all.friction = Some(keys);
        }
        if let Some(section) = root.section("adhesion")? {
            let keys = AdhesionSection::read_table(&section)?;
            all.problem = keys.adhere(&section, root, (all.problem, settings))?;
            all.adhesion = Some(keys);
        }
        if let Some(section) = root.section("motion")? {
            let keys = MotionSection::read_table(&section)?;
            all.problem = keys.moving(&section, root, (all.problem, settings))?;
            all.motion = Some(keys);
        }
        let section = root.section("heat")?;
        all.heat = section.as_ref().map(HeatSection::read_table).transpose()?;
        all.problem = heat::heated(section.as_ref().zip(all.heat), root, all.problem)?;
        Ok(all)
    }
}

/// The end of the text of a source, where what is missing is missed.
fn end_of(source: &Source) -> Span {
    let end = source.text.trim_end().len();
    Span::new(0, end..end)
}

/// Reads the body and the section `[counterbody]`, with layers that are possible in the cell, and both bodies together.
fn bodies<'a>(root: &TableAt<'a>, cell: Cell) -> Result<(Body<'a>, Option<Above<'a>>, Bodies), Refusal> {
    let body = layers::read(root)?;
    let section = root.section("counterbody")?;
    let above = section.as_ref().map(elastic_counterbody::read).transpose()?;
    for body in [&body].into_iter().chain(above.iter().flat_map(|above| &above.body)) {
        magnitude::layers(&body.half_space, &body.places(), cell)?;
    }
    let bodies = match (&above, &section) {
        (Some(above), Some(section)) => above
            .bodies(body.half_space.clone())
            .map_err(|error| Refusal::new(section.span, format!("`counterbody`: {error}"), "this counterbody"))?,
        _ => Bodies::from(body.half_space.clone()),
    };
    Ok((body, above, bodies))
}

fn title(root: &TableAt<'_>) -> Result<String, Refusal> {
    let title = root.value("title")?;
    match String::read(&title)? {
        text if text.contains('\n') => Err(title.refuse_form()),
        text => Ok(text),
    }
}
