//! The page's program: one request, one answer.

use crate::answer::{Answer, TableText};
use crate::numbers;
use crate::request::Request;
use percoat_app::output::summary;
use percoat_app::output::table::{self, Assumptions};
use percoat_app::picture::{self, Canvas, Format, Snapshot};
use percoat_app::task::{FindLimits, Limited, Solve, Solved};
use percoat_case::case::{Case, Source, library, plausibility};
use percoat_common::machine::Capacity;
use percoat_core::localized::isolated;
use percoat_core::run::{Cut, Recorder, StepRecord};
use percoat_core::{Depth, Step, StressField, StressFields, SurfaceLine, VerticalSection};
use serde_json::{Value, json};
use std::convert::Infallible;
use std::path::Path;

/// The page, with the step that was solved last with pictures.
#[derive(Debug, Default)]
pub struct Page {
    kept: Option<Kept>,
}

/// Takes an answer that is not complete.
type Begun<'a> = &'a mut (dyn FnMut(Answer) + Send);

/// A solved step with what its pictures and tables are made of.
#[derive(Debug)]
struct Kept {
    snapshot: Snapshot,
    sections: Vec<VerticalSection>,
    record: StepRecord,
}

impl Page {
    /// The answer to a request in JSON: JSON, or the bytes of a picture or table. A request that is refused has the answer
    /// `{"error": "…"}`. `begun` takes what is known of it before the rest is computed, where the request has `parts`.
    pub fn answer(&mut self, request: &[u8], begun: &mut (dyn FnMut(&[u8]) + Send)) -> Vec<u8> {
        let answer = serde_json::from_slice(request)
            .map_err(|error| format!("no request of this page: {error}"))
            .and_then(|request| self.perform(request, begun));
        answer.unwrap_or_else(|error| json!({ "error": error }).to_string().into_bytes())
    }

    fn perform(&mut self, request: Request, begun: &mut (dyn FnMut(&[u8]) + Send)) -> Result<Vec<u8>, String> {
        match request {
            Request::Materials => Ok(json!({ "materials": library() }).to_string().into_bytes()),
            Request::Solve { case, pictures, coarse, parts } => {
                let mut begun = |answer: Answer| begun(json!(answer).to_string().as_bytes());
                let begun: Option<Begun<'_>> = if parts { Some(&mut begun) } else { None };
                let answer = self.solve(case, pictures.then_some(coarse), begun)?;
                Ok(json!(answer).to_string().into_bytes())
            }
            Request::Limit { case } => limit(case).map(|answer| json!(answer).to_string().into_bytes()),
            Request::Picture { name } => {
                let canvas =
                    self.kept()?.picture(&name).ok_or_else(|| format!("no picture \"{name}\" of this case"))?;
                Ok(canvas.encoded(Format::Png))
            }
            Request::Table { name } => {
                let table = self.kept()?.table(&name).ok_or_else(|| format!("no table \"{name}\" of this case"))?;
                Ok(table.into_bytes())
            }
        }
    }

    fn kept(&self) -> Result<&Kept, String> {
        self.kept.as_ref().ok_or_else(|| "nothing is solved yet".to_owned())
    }

    /// `pictures`: whether their section is coarse; `None` without.
    fn solve(&mut self, case: Value, pictures: Option<bool>, mut begun: Option<Begun<'_>>) -> Result<Answer, String> {
        if pictures.is_some() {
            self.kept = None;
        }
        let case = read(case)?;
        let task = Solve::in_memory(&case, room()).map_err(|error| error.to_string())?;
        let cut = task.run.stress.as_ref().and_then(|stress| stress.cut.clone());
        let cut = pictures.and_then(|coarse| Some((cut?, coarse)));
        // Pictures of the surface of the step that was last begun: its stresses do not change them.
        let mut of_surface = Vec::new();
        let mut known = |step: &Step, record: &StepRecord| {
            let Some(begun) = &mut begun else { return };
            let mut answer = of_steps(&case, std::slice::from_ref(record));
            if pictures.is_some() && record.stress.is_none() {
                of_surface = Kept::new(&case, step.clone(), record.clone(), Vec::new()).pictures(&Kept::SURFACE);
            }
            answer.pictures = of_surface.clone();
            begun(answer);
        };
        let mut recording = Recording { cut, sections: Vec::new(), known: &mut known };
        let Solved { outcome, warnings } = task.solve(&mut recording).map_err(|error| error.to_string())?;
        let sections = recording.sections;
        let record = outcome.steps.last().ok_or("a case has a load at least")?;
        let mut answer = of_steps(&case, &outcome.steps);
        answer.converged = outcome.converged();
        answer.warnings = warnings;
        if let (true, Some(last)) = (pictures.is_some(), outcome.last) {
            let kept = Kept::new(&case, last, record.clone(), sections);
            let of_surface = if of_surface.is_empty() { kept.pictures(&Kept::SURFACE) } else { of_surface };
            answer.pictures = [of_surface, kept.pictures(&["section"])].concat();
            self.kept = Some(kept);
        }
        Ok(answer)
    }
}

/// Answer for the last step of a case, by the records of all; without pictures, with the warnings of the case alone.
fn of_steps(case: &Case, steps: &[StepRecord]) -> Answer {
    let (units, last) = (case.units(), steps.last());
    let mut tables = vec![TableText::new("contact", table::steps(steps, &units))];
    tables.extend(table::slip(steps, &units).map(|(words, table)| TableText::new(&words, table)));
    let utilised = table::utilisations(steps, Some(case.problem().bodies()), &units)
        .map(|utilisations| TableText::worded("utilisation of strengths", utilisations));
    let (verdict, utilised) = utilised.unzip();
    tables.extend(utilised);
    tables.extend(table::largest_stresses(steps, &units).map(|stresses| TableText::new("largest stresses", stresses)));
    tables.extend(table::largest_strains(steps, &units).map(|strains| TableText::new("largest strains", strains)));
    Answer {
        case: case.to_toml(),
        converged: steps.iter().all(StepRecord::converged),
        numbers: last.map_or(Vec::new(), |last| numbers::of(last, &units)),
        verdict,
        tables,
        without_strength: Assumptions::of(case).without_strength(),
        assumptions: assumptions(case),
        warnings: plausibility::of_case(case),
        pictures: Vec::new(),
        step: last.map(|last| json!(last)),
    }
}

/// The loads at which the criteria of a case are reached.
fn limit(case: Value) -> Result<Answer, String> {
    let case = read(case)?;
    let task = FindLimits::new(&case, room(), false).map_err(|error| error.to_string())?;
    let Limited { limits, warnings, .. } = task.find(&mut ()).map_err(|error| error.to_string())?;
    let (verdict, table) = TableText::worded("limits", table::limits(&limits, &case.units()));
    Ok(Answer {
        case: case.to_toml(),
        converged: limits.converged(),
        numbers: Vec::new(),
        verdict: Some(verdict),
        tables: vec![table],
        without_strength: None,
        assumptions: assumptions(&case),
        warnings,
        pictures: Vec::new(),
        step: None,
    })
}

/// Memory of the browser.
fn room() -> Capacity {
    Capacity::on_this_machine(Path::new(""))
}

/// The case of an object in JSON.
fn read(case: Value) -> Result<Case, String> {
    let values = toml::Table::try_from(case).map_err(|error| format!("no case: {error}"))?;
    let source = Source { name: "this case".to_owned(), values: Some(values), ..Source::default() };
    Case::read(&source, &[]).map_err(|error| error.to_string())
}

fn assumptions(case: &Case) -> Vec<String> {
    Assumptions::of(case).sentences(true)
}

/// Keeps the sections of the last step.
struct Recording<'a> {
    /// The section, and whether it is coarse.
    cut: Option<(Cut, bool)>,
    sections: Vec<VerticalSection>,
    /// Takes a step when its contact is known, and again with its largest stresses.
    known: &'a mut (dyn FnMut(&Step, &StepRecord) + Send),
}

/// A line of half as many intervals, and every third depth; interfaces and the last depth stay.
fn thinned(line: SurfaceLine, depths: &[Depth]) -> (SurfaceLine, Vec<Depth>) {
    let stays = |i: usize| {
        let is_on_interface = |j: usize| depths.get(j).is_some_and(|other| other.z == depths[i].z);
        i.is_multiple_of(3) || i + 1 == depths.len() || is_on_interface(i - 1) || is_on_interface(i + 1)
    };
    let rows = (0..depths.len()).filter(|&i| stays(i)).map(|i| depths[i]).collect();
    (SurfaceLine { points: line.points.div_ceil(2), ..line }, rows)
}

impl Recorder for Recording<'_> {
    type Error = Infallible;

    fn stresses(&mut self, step: &Step, record: &StepRecord) {
        (self.known)(step, record);
    }

    fn step(&mut self, step: &Step, record: &StepRecord, fields: Option<&StressFields>) -> Result<(), Infallible> {
        if let (Some((cut, coarse)), Some(fields)) = (&self.cut, fields) {
            (self.known)(step, record);
            let section = |field: &StressField| {
                let depths = cut.depths(field.half_space());
                let (line, depths) = if *coarse { thinned(cut.line, &depths) } else { (cut.line, depths) };
                field.section(&line, &depths)
            };
            self.sections = fields.each().map(section).collect();
        }
        Ok(())
    }
}

impl Kept {
    /// Names of the pictures of the surface.
    const SURFACE: [&str; 3] = ["pressure", "slip", "profiles"];

    fn new(case: &Case, step: Step, record: StepRecord, sections: Vec<VerticalSection>) -> Self {
        let snapshot = Snapshot::new(&case.title, step, record.reading.clone()).with_units(case.units());
        Self { snapshot: snapshot.with_strength(record.strength.clone()), sections, record }
    }

    /// Pictures of these names, as SVG, as far as the step has them.
    fn pictures(&self, names: &[&str]) -> Vec<(String, String)> {
        names.iter().filter_map(|&name| Some((name.to_owned(), self.picture(name)?.for_screen()))).collect()
    }

    fn picture(&self, name: &str) -> Option<Canvas> {
        let Self { snapshot, sections, .. } = self;
        let touches = snapshot.reading.touches();
        match name {
            "pressure" if touches => Some(picture::pressure(snapshot)),
            "slip" if touches => picture::slip(snapshot),
            "section" if touches && !sections.is_empty() => Some(picture::section(snapshot, sections)),
            "profiles" => {
                let alone = isolated::profiles(snapshot.step.problem(), &snapshot.reading);
                picture::profiles(snapshot, alone.as_deref())
            }
            _ => None,
        }
    }

    fn table(&self, name: &str) -> Option<String> {
        match name {
            "numbers" => Some(summary::curve(std::slice::from_ref(&self.record))),
            "profile" => Some(self.profile()),
            "section" => self.sections.first().map(section),
            _ => None,
        }
    }

    /// Pressure and gap on the row of samples along a₁ that has the largest pressure.
    fn profile(&self) -> String {
        let (pressure, gap, grid) =
            (self.snapshot.step.pressure(), self.snapshot.step.gap(), self.snapshot.step.grid());
        let [n1, n2] = grid.points();
        let most = pressure.indexed_iter().max_by(|a, b| a.1.total_cmp(b.1));
        let row = most.map_or(0, |((_, j), _)| j);
        let line = |i: usize| {
            let [x, y] = grid.cell().point(grid.fractions(i * n2 + row));
            format!("{x},{y},{},{}\n", pressure[[i, row]], gap[[i, row]])
        };
        "x,y,pressure,gap\n".to_owned() + &(0..n1).map(line).collect::<String>()
    }
}

/// The stresses of a section, a line for each depth and place.
fn section(section: &VerticalSection) -> String {
    let (places, distances) = (section.line.places(), section.line.distances());
    let mut text = "s,x,y,z,xx,yy,zz,xy,xz,yz,ux,uy,uz,tau1,mises,s1\n".to_owned();
    for (depth, row) in section.depths.iter().zip(section.states.rows()) {
        for ((state, s), [x, y]) in row.iter().zip(&distances).zip(&places) {
            let numbers = state.components().into_iter().chain(state.derived());
            let numbers: Vec<String> = numbers.map(|x| x.to_string()).collect();
            text += &format!("{s},{x},{y},{},{}\n", depth.z, numbers.join(","));
        }
    }
    text
}
