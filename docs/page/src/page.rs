//! The page's program: one request, one answer.

use crate::answer::{Answer, TableText};
use crate::numbers;
use crate::request::Request;
use percoat::case::feasibility::Allowed;
use percoat::case::resources::Job;
use percoat::case::{Case, Source, library, plausibility};
use percoat::localized::isolated;
use percoat::machine::Capacity;
use percoat::output::summary;
use percoat::output::table::{self, Assumptions};
use percoat::picture::{self, Canvas, Format, Snapshot};
use percoat::run::{Cut, Recorder, StepRecord};
use percoat::{Depth, Step, StressField, StressFields, SurfaceLine, VerticalSection};
use serde_json::{Value, json};
use std::convert::Infallible;
use std::path::Path;

/// The page, with the step that was solved last with pictures.
#[derive(Debug, Default)]
pub struct Page {
    kept: Option<Kept>,
}

/// A solved step with what its pictures and tables are made of.
#[derive(Debug)]
struct Kept {
    snapshot: Snapshot,
    sections: Vec<VerticalSection>,
    record: StepRecord,
}

impl Page {
    /// The answer to a request in JSON: JSON, or the bytes of a picture or table. A request that is refused has the answer
    /// `{"error": "…"}`.
    pub fn answer(&mut self, request: &[u8]) -> Vec<u8> {
        let answer = serde_json::from_slice(request)
            .map_err(|error| format!("no request of this page: {error}"))
            .and_then(|request| self.perform(request));
        answer.unwrap_or_else(|error| json!({ "error": error }).to_string().into_bytes())
    }

    fn perform(&mut self, request: Request) -> Result<Vec<u8>, String> {
        match request {
            Request::Materials => Ok(json!({ "materials": library() }).to_string().into_bytes()),
            Request::Solve { case, pictures, coarse } => {
                self.solve(case, pictures, coarse).map(|answer| json!(answer).to_string().into_bytes())
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

    fn solve(&mut self, case: Value, pictures: bool, coarse: bool) -> Result<Answer, String> {
        let case = read(case)?;
        let (run, room) = (case.run(), Capacity::on_this_machine(Path::new("")));
        let cut = run.stress.as_ref().and_then(|stress| stress.cut.clone()).filter(|_| pictures);
        let allowed = Allowed::within(&case, room, Job::Keep)?;
        let mut recording = Recording { allowed, cut, coarse, sections: Vec::new() };
        let outcome = run.solve(&mut recording).map_err(|error| error.to_string())?;
        let record = outcome.steps.last().ok_or("a case has a load at least")?;
        let units = case.units();
        let mut tables = vec![TableText::new("contact", table::steps(&outcome.steps, &units))];
        tables
            .extend(table::largest_stresses(&outcome.steps, &units).map(|own| TableText::new("largest stresses", own)));
        let utilised = table::utilisations(&outcome.steps, Some(case.problem().bodies()), &units)
            .map(|own| TableText::worded("utilisation of strengths", own));
        let (verdict, utilised) = utilised.unzip();
        tables.extend(utilised);
        let mut answer = Answer {
            case: case.to_toml(),
            converged: outcome.converged(),
            numbers: numbers::of(record, &units),
            verdict,
            tables,
            assumptions: assumptions(&case),
            warnings: [outcome.warnings.clone(), plausibility::of_case(&case)].concat(),
            pictures: Vec::new(),
            step: Some(json!(record)),
        };
        if let (true, Some(last)) = (pictures, outcome.last) {
            let snapshot = Snapshot::new(&case.title, last, record.reading.clone()).with_units(units);
            let snapshot = snapshot.with_strength(record.strength.clone());
            let kept = Kept { snapshot, sections: recording.sections, record: record.clone() };
            answer.pictures = kept.pictures();
            self.kept = Some(kept);
        }
        Ok(answer)
    }
}

/// The loads at which the criteria of a case are reached.
fn limit(case: Value) -> Result<Answer, String> {
    let case = read(case)?;
    let mut allowed = Allowed::within(&case, Capacity::on_this_machine(Path::new("")), Job::Keep)?;
    let limits = case.run().limits(&mut allowed).map_err(|error| error.to_string())?;
    let (verdict, table) = TableText::worded("limits", table::limits(&limits, &case.units()));
    Ok(Answer {
        case: case.to_toml(),
        converged: limits.converged(),
        numbers: Vec::new(),
        verdict: Some(verdict),
        tables: vec![table],
        assumptions: assumptions(&case),
        warnings: [limits.warnings.clone(), plausibility::of_case(&case)].concat(),
        pictures: Vec::new(),
        step: None,
    })
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
    allowed: Allowed<'a>,
    cut: Option<Cut>,
    coarse: bool,
    sections: Vec<VerticalSection>,
}

/// A line of half as many intervals, and every other depth; interfaces and the last depth stay.
fn halved(line: SurfaceLine, depths: &[Depth]) -> (SurfaceLine, Vec<Depth>) {
    let stays = |i: usize| {
        let is_on_interface = |j: usize| depths.get(j).is_some_and(|other| other.z == depths[i].z);
        i.is_multiple_of(2) || i + 1 == depths.len() || is_on_interface(i - 1) || is_on_interface(i + 1)
    };
    let rows = (0..depths.len()).filter(|&i| stays(i)).map(|i| depths[i]).collect();
    (SurfaceLine { points: line.points.div_ceil(2), ..line }, rows)
}

impl Recorder for Recording<'_> {
    type Error = Infallible;

    fn fits(&self, points: [usize; 2]) -> bool {
        self.allowed.fits(points)
    }

    fn step(&mut self, _step: &Step, _record: &StepRecord, fields: Option<&StressFields>) -> Result<(), Infallible> {
        if let (Some(cut), Some(fields)) = (&self.cut, fields) {
            let section = |field: &StressField| {
                let depths = cut.depths(field.half_space());
                let (line, depths) = if self.coarse { halved(cut.line, &depths) } else { (cut.line, depths) };
                field.section(&line, &depths)
            };
            self.sections = fields.each().map(section).collect();
        }
        Ok(())
    }
}

impl Kept {
    /// Names of the pictures, in the order in which they are shown.
    const PICTURES: [&str; 3] = ["pressure", "section", "profiles"];

    /// The pictures that there are, as SVG.
    fn pictures(&self) -> Vec<(String, String)> {
        let svg = |name: &str| {
            let text = String::from_utf8(self.picture(name)?.encoded(Format::Svg)).ok()?;
            Some((name.to_owned(), text))
        };
        Self::PICTURES.into_iter().filter_map(svg).collect()
    }

    fn picture(&self, name: &str) -> Option<Canvas> {
        let Self { snapshot, sections, .. } = self;
        let touches = snapshot.reading.touches();
        match name {
            "pressure" if touches => Some(picture::pressure(snapshot)),
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
