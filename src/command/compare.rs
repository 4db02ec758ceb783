//! `percoat compare`: spectral and localized solution of a case side by side.

use super::declared::Declared::{self, Picture, Text};
use super::declared::plan;
use super::ending::{Ending, Failure};
use super::input::{output_folder, read_case};
use super::options::Common;
use super::progress::Progress;
use super::results::Results;
use super::terminal;
use percoat_app::output::{Writer, table};
use percoat_app::picture;
use percoat_app::task::{Compare, CompareError, Compared};
use percoat_common::machine::Capacity;
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Instant;

pub fn run(case: Option<&Path>, set: &[String], common: &Common) -> Result<Ending, Failure> {
    let (started, pictures) = (Instant::now(), &common.pictures);
    let (case, name) = read_case(case, set)?;
    let folder = output_folder(common, &name)?;
    let task = Compare::new(&case, Capacity::on_this_machine(&folder), pictures.wanted())?;
    let results = Results::claim(folder, plan(Writer::Compare, &files(), pictures), common.saying())?;
    let progress = Progress::new("", 0, 0, common);
    let compared = task.compare(&mut (), &mut |_, stage| {
        progress.tell(stage);
        progress.say(stage);
        ControlFlow::Continue(())
    });
    progress.finish();
    let compared = compared.map_err(|error| match error {
        CompareError::Run(error) => error.into(),
        CompareError::Comparison(error) => Failure::refused(error),
    })?;
    results.write_all(&files(), &compared, pictures)?;
    let tables = || table::compared(&case, &compared.file(), terminal::width());
    let line = || format!("{:.2} s", started.elapsed().as_secs_f64());
    results.finish("compare.json", tables, line, &compared.warnings)?;
    Ok(Ending::of(compared.converged()))
}

/// The files of a comparison.
fn files<'a>() -> [Declared<Compared<'a>>; 2] {
    [
        Text("compare.json", |both| Some(both.file().to_json())),
        Picture("comparison", |both| picture::comparison(&both.case.title, &both.case.units(), &both.comparison)),
    ]
}
