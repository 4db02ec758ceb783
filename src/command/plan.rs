//! Names of the files that a command may write, known before anything is solved.

use super::pictures::PictureOptions;
use percoat_app::output::{Plan, Writer, solved_plan};
use percoat_case::case::Case;

/// Files of a result with these names, and pictures with the names `drawn`.
pub fn plan(writer: Writer, files: &[&str], pictures: &PictureOptions, drawn: &[&str]) -> Plan {
    let names = files.iter().map(|name| (*name).to_owned()).chain(pictures.files(drawn)).collect();
    Plan { names, ..Plan::new(writer) }
}

/// Files that a run of the case may write, with its fields or without.
pub fn may_write(case: &Case, steps: usize, fields: bool, pictures: &PictureOptions) -> Plan {
    let mut plan = solved_plan(case, steps, fields);
    let mut drawn = vec!["pressure", "contact", "profiles"];
    if case.stress.as_ref().is_some_and(|stress| stress.section.is_some()) {
        drawn.extend(["section", "lines"]);
    }
    if case.problem().bodies().hardness().is_some() {
        drawn.push("indentation");
    }
    if steps > 1 {
        drawn.push("curve");
    }
    plan.names.extend(pictures.files(&drawn));
    plan
}
