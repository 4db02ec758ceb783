//! `[stress]`: places at which stresses and strains are computed.

use serde::{Serialize, Serializer};

use super::error::Refusal;
use super::feasibility::magnitude;
use super::keys::{Form, Key, Range, Unit};
use super::node::Value;
use super::reader::TableAt;
use super::section::{KeyValue, ReadTable, Words, demanded, section, words};
use super::value::ValueAt;
use percoat_common::plain::float;
use percoat_core::body::{HalfSpace, MeanStress};
use percoat_core::counterbody::Indenters;
use percoat_core::lattice::Lattice;
use percoat_core::notation::number;
use percoat_core::problem::Problem;
use percoat_core::run::places::SECTION;
use percoat_core::run::{self, StressRequest, Volume};
use percoat_core::stress::SurfaceLine;

const SIZE: Form = Form::Number(Range::Size);
const SIZE_OR_ZERO: Form = Form::Number(Range::SizeOrZero);
const COORDINATE: Form = Form::Number(Range::Coordinate);
const LEVEL: Form = Form::Text("a level such as \"level 1\"");

words! { MeanStress { Confined = "confined", HalfSpace = "half-space", Line = "line", } }

section! {
    /// The section `[stress]`.
    pub struct StressSection = STRESS {
        /// depths of horizontal planes; one on an interface gives both sides
        pub planes: Vec<f64> =
            Key::new(&[Form::List { of: &SIZE_OR_ZERO, count: [0, 1000] }], "[0.0, 0.25, 0.5]")
                .unit(Unit::Length)
                .default("[]"),
        /// the mean lateral stress: that of no mean lateral strain, under the centre of a wide loaded disc, or under lines far apart, of a
        /// surface that is constant along one side of the cell
        pub mean: MeanStress = Key::new(&[Form::Word(MeanStress::WORDS)], "\"half-space\"").default("\"confined\""),
        /// a vertical cut from one level or place toward another, or along a direction
        pub section: Option<CutSection> = Key::new(
            &[Form::Table(&CUT)],
            "{ from = \"level 1\", toward = \"level 2\", length = 1.0, depth = 1.0 }",
        )
        .otherwise("no cut; of an isolated contact without planes, points and volume the cut through the first indenter across the whole window"),
        /// single points, z ≥ 0 into the body
        pub points: Vec<[f64; 3]> = Key::new(
            &[Form::List { of: &Form::Tuple("a point [x, y, z]", &[COORDINATE, COORDINATE, SIZE_OR_ZERO]), count: [0, 100_000] }],
            "[[0.0, 0.0, 0.1]]",
        )
        .unit(Unit::Length)
        .default("[]")
        .omitted_as_nothing(),
        /// the field under the cell, for ParaView
        pub volume: Option<Volume> =
            Key::new(&[Form::Table(&VOLUME)], "{ depth = 1.0, rows = 40, points = 96 }").otherwise("no field"),
        /// strains beside stresses, at the same places, and the largest ones
        pub strain: bool = Key::new(&[Form::Boolean], "true").default("false").omitted_as_nothing(),
    }
}

section! {
    /// A vertical cut from the axis of an indenter toward a neighbour, or from any place along a direction.
    #[derive(Copy)]
    pub struct CutSection = CUT {
        /// origin of the cut: the axis of a level's first indenter, or a place
        pub from: Origin =
            Key::new(&[LEVEL, Form::Tuple("a place [x, y]", &[COORDINATE; 2])], "\"level 1\"").unit(Unit::Length),
        /// direction of the cut: to the nearest other indenter of a level, or [x, y]
        pub toward: Option<Toward> = Key::new(&[LEVEL, Form::Tuple("a direction [x, y]", &[COORDINATE; 2])], "\"level 2\"")
            .otherwise("the direction of sliding; needed without [friction]"),
        /// length along the surface
        pub length: f64 = Key::new(&[SIZE], "1.0").unit(Unit::Length),
        /// distance behind the origin at which the cut begins
        pub behind: Option<f64> = Key::new(&[SIZE_OR_ZERO], "0.5")
            .unit(Unit::Length)
            .otherwise("half the length without `toward`, else 0")
            .omitted_as_nothing(),
        /// largest depth
        pub depth: f64 = Key::new(&[SIZE], "1.0").unit(Unit::Length),
    }
}

section! {
    for Volume = VOLUME {
        /// largest depth
        depth = Key::new(&[SIZE], "1.0").unit(Unit::Length),
        /// intervals in depth
        rows = Key::new(&[Form::Integer(1, 2048)], "60").default("40"),
        /// samples along each cell vector
        points = Key::new(&[Form::Integer(1, 2048)], "128").default("96"),
    }
}

/// Origin of a cut.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Origin {
    /// Axis of the first indenter of this level, from 1.
    Level(#[serde(serialize_with = "write_level")] usize),
    /// Place [x, y], lengths.
    Place([f64; 2]),
}

/// Direction of a cut.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Toward {
    /// Nearest other indenter of this level, from 1.
    Level(#[serde(serialize_with = "write_level")] usize),
    /// Direction [x, y], of any length.
    Direction([f64; 2]),
}

/// The refusal of the mean lateral stress of lines under a counterbody that is none.
fn no_line(section: &TableAt<'_>) -> Result<Refusal, Refusal> {
    let value = section.value("mean")?;
    let message = format!(
        "`{}` = \"line\", and what loads the body is not constant along one side of the cell alone",
        value.path
    );
    Ok(Refusal::new(value.node.span, message, "no lines").help(
        "\"line\" is for heights of a [surface], or a field of load.pressure, that change along one side of a periodic cell and are constant \
         along the other; otherwise \"confined\" or \"half-space\"",
    ))
}

impl StressSection {
    /// Reads the section of a case with this `problem`, which slides along a direction.
    pub(super) fn read_in(
        section: &TableAt<'_>,
        problem: &Problem,
        sliding: Option<[f64; 2]>,
    ) -> Result<Self, Refusal> {
        if let Some(cut) = section.optional("section") {
            check_levels(&cut, problem.levels().len())?;
        }
        let stress = Self::read_table(section)?;
        // The deepest rigid base; infinite where a body has none.
        let base = problem.bodies().each().map(HalfSpace::base_depth).fold(0.0, f64::max);
        for key in ["planes", "points"] {
            within(section, key, base)?;
        }
        if stress.section.is_some_and(|cut| cut.toward.is_none()) && sliding.is_none() {
            return Err(section.value("section")?.table()?.missing("toward"));
        }
        let stress = Self { section: stress.section.map(|cut| cut.completed(sliding)), ..stress };
        stress.within(problem, section)?;
        if stress.mean == MeanStress::Line && problem.loaded_by().line().is_none() {
            return Err(no_line(section)?);
        }
        Ok(stress)
    }

    /// Refuses points and cuts beyond the window of an isolated contact, where no stresses are computed.
    fn within(&self, problem: &Problem, section: &TableAt<'_>) -> Result<(), Refusal> {
        let cell = problem.cell();
        let refuse = |key: &str, item: String, verb: &str, place: [f64; 2]| {
            let value = section.value(key)?;
            let [width, height] = [0, 1].map(|axis| number((2.0 * place[axis].abs()).max(cell.vectors()[axis][axis])));
            let message = format!("`{}{item}` {verb} beyond the window", value.path);
            Err(Refusal::new(value.node.span, message, "beyond the window").help(format!(
                "stresses are computed inside the window of an isolated contact: lattice.size of at least \
                 [{width}, {height}]"
            )))
        };
        if let Some(index) = self.points.iter().position(|&[x, y, _]| !cell.contains([x, y])) {
            let [x, y, _] = self.points[index];
            return refuse("points", format!("[{index}]"), "is", [x, y]);
        }
        let line = self.section.and_then(|cut| cut.line(problem.indenters().map(Indenters::lattice)));
        let end = line.and_then(|line| line.ends().into_iter().find(|&end| !cell.contains(end)));
        end.map_or(Ok(()), |end| refuse("section", String::new(), "ends", end))
    }

    /// The vertical cut of a run of `problem`: that of the key, or of an isolated contact without any place the one across its window.
    pub(super) fn cut(&self, problem: &Problem) -> Option<CutSection> {
        let is_free = self.planes.is_empty() && self.points.is_empty() && self.volume.is_none();
        self.section.or_else(|| if is_free { CutSection::across_window(problem) } else { None })
    }

    /// The request for a run of `problem`.
    pub(super) fn request(&self, problem: &Problem) -> StressRequest {
        let lattice = problem.indenters().map(Indenters::lattice);
        let cut = |cut: CutSection| Some(run::Cut { line: cut.line(lattice)?, depth: cut.depth });
        StressRequest {
            mean: self.mean,
            planes: self.planes.clone(),
            cut: self.cut(problem).and_then(cut),
            points: self.points.clone(),
            volume: self.volume,
            strain: self.strain,
        }
    }
}

/// Refuses depths below a rigid base: of numbers, or of the last number of each item.
fn within(section: &TableAt<'_>, key: &str, base: f64) -> Result<(), Refusal> {
    let Some(list) = section.optional(key) else { return Ok(()) };
    for item in list.list()? {
        let z = if matches!(item.node.value, Value::List(_)) { item.numbers::<3>()?[2] } else { item.number()? };
        if z > base * (1.0 + 1e-12) {
            let message = format!("`{}`: z = {} is below the rigid base at {}", item.path, float(z), float(base));
            return Err(
                Refusal::new(item.node.span, message, "not in the body").help("stresses are in the layers alone")
            );
        }
    }
    Ok(())
}

/// Refuses a cut from or toward a level that the case does not have.
fn check_levels(cut: &ValueAt<'_>, levels: usize) -> Result<(), Refusal> {
    let section = match levels {
        0 => cut.table_or("{ from = [0.0, 0.0], toward = [1.0, 0.0], length = 1.0, depth = 1.0 }")?,
        _ => cut.table()?,
    };
    section.only()?;
    for end in ["from", "toward"].iter().filter_map(|key| section.optional(key)) {
        if !matches!(end.node.value, Value::List(_)) {
            level(&end, levels)?;
        }
    }
    Ok(())
}

impl CutSection {
    /// The cut through the first indenter, or the middle, from border to border of the window along x or the direction of sliding, half of the
    /// window's shorter side deep; `None` in a periodic cell.
    fn across_window(problem: &Problem) -> Option<Self> {
        let cell = problem.cell();
        let (sides, direction) = (cell.window_sides()?, problem.direction());
        let from = if problem.levels().is_empty() { Origin::Place([0.0; 2]) } else { Origin::Level(1) };
        let cut = Self { from, toward: Some(Toward::Direction(direction)), length: 0.0, behind: None, depth: 0.0 };
        let line = cut.line(problem.indenters().map(Indenters::lattice))?;
        let reach = sides[0].hypot(sides[1]);
        let [first, last] = cell.clipped(line.origin, line.unit(), [-reach, reach]);
        Some(Self { length: last - first, behind: Some(-first), depth: 0.5 * sides[0].min(sides[1]), ..cut })
    }

    /// The cut with the direction of sliding where it has none; it then begins behind the origin, to show both edges of a contact.
    fn completed(self, sliding: Option<[f64; 2]>) -> Self {
        let behind = if self.toward.is_none() { 0.5 * self.length } else { 0.0 };
        let toward = self.toward.or(sliding.map(Toward::Direction));
        Self { toward, behind: self.behind.or(Some(behind)), ..self }
    }

    /// Line of the cut on the surface; `None` for levels without indenters.
    fn line(&self, lattice: Option<&Lattice>) -> Option<SurfaceLine> {
        let first = |level: usize| Some(lattice?.sites()[level - 1][0]);
        let origin = match self.from {
            Origin::Level(level) => lattice?.cell().point(first(level)?),
            Origin::Place(place) => place,
        };
        let direction = match demanded(self.toward) {
            Toward::Level(level) => lattice?.toward(lattice?.cell().fractions(origin), level),
            Toward::Direction(direction) => direction,
        };
        let ([_, points], behind) = (SECTION, self.behind.unwrap_or(0.0));
        Some(SurfaceLine { origin, direction, span: [-behind, self.length - behind], points })
    }
}

impl KeyValue for Origin {
    fn read(value: &ValueAt<'_>) -> Result<Self, Refusal> {
        match value.node.value {
            Value::List(_) => value.numbers().map(Self::Place),
            _ => level(value, usize::MAX).map(Self::Level),
        }
    }
}

impl KeyValue for Toward {
    fn read(value: &ValueAt<'_>) -> Result<Self, Refusal> {
        match value.node.value {
            Value::List(_) => magnitude::direction(value).map(Self::Direction),
            _ => level(value, usize::MAX).map(Self::Level),
        }
    }
}

/// The number N of "level N".
fn level(value: &ValueAt<'_>, levels: usize) -> Result<usize, Refusal> {
    let wanted = match levels {
        0 => "two numbers in brackets: this case has no levels".to_owned(),
        1 => "\"level 1\", the only one".to_owned(),
        _ => format!("\"level 1\" to \"level {levels}\""),
    };
    let text = value.text().map_err(|_| value.refuse(&wanted))?;
    let number = text.strip_prefix("level ").and_then(|number| number.trim().parse().ok());
    number.filter(|number| (1..=levels).contains(number)).ok_or_else(|| value.refuse(wanted))
}

fn write_level<S: Serializer>(level: &usize, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(&format_args!("level {level}"))
}
