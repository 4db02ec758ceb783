//! The table of statements in `validation/paper/README.md`: written by the run, part of the program, compared with each
//! fresh run.

use super::STUDIES;

/// The committed page.
const PAGE: &str = include_str!("README.md");
/// The table's first two lines.
const HEAD: &str = "| where | the paper | measured | verdict | again by |\n|---|---|---|---|---|\n";

/// The committed page, its table's rows of the studies in `fresh` (name and rows) replaced.
pub fn renewed(fresh: &[(&str, Vec<String>)]) -> String {
    renew(PAGE, fresh, &STUDIES.map(|study| study.name))
}

/// Whether a text is the committed page but for the table's rows.
pub fn is_around(text: &str) -> bool {
    let around = |page: &str| {
        let (before, rest) = page.split_once(HEAD)?;
        let after: String = rest.split_inclusive('\n').skip_while(|line| line.starts_with('|')).collect();
        Some((before.to_owned(), after))
    };
    around(text).is_some_and(|text| Some(text) == around(PAGE))
}

/// Rows of the studies in `fresh` that differ from the committed page's.
pub fn differences(fresh: &[(&str, Vec<String>)]) -> Vec<String> {
    let differ = |(study, rows): &(&str, Vec<String>)| {
        let committed = rows_of(PAGE, study);
        let changed: Vec<String> = rows.iter().filter(|row| !committed.contains(&row.as_str())).cloned().collect();
        let lost = committed.iter().filter(|row| !rows.iter().any(|fresh| fresh == *row)).map(|row| (*row).to_owned());
        let lost: Vec<String> = lost.collect();
        let line = |what: &str, row: &String| format!("{study}: {what} validation/paper/README.md: {row}");
        let added = changed.iter().map(|row| line("not in", row));
        added.chain(lost.iter().map(|row| line("now otherwise than in", row))).collect::<Vec<_>>()
    };
    fresh.iter().flat_map(differ).collect()
}

/// The rows of a study: those that end with its command.
fn rows_of<'a>(page: &'a str, study: &str) -> Vec<&'a str> {
    let end = format!("| `percoat validate {study}` |");
    page.lines().filter(|line| line.ends_with(&end)).collect()
}

fn renew(page: &str, fresh: &[(&str, Vec<String>)], order: &[&str]) -> String {
    let Some((before, rest)) = page.split_once(HEAD) else { return page.to_owned() };
    let table: usize = rest.split_inclusive('\n').take_while(|line| line.starts_with('|')).map(str::len).sum();
    let after = &rest[table..];
    let mut text = before.to_owned() + HEAD;
    for study in order {
        let rows = match fresh.iter().find(|(name, _)| name == study) {
            Some((_, rows)) => rows.clone(),
            None => rows_of(rest, study).into_iter().map(str::to_owned).collect(),
        };
        rows.iter().for_each(|row| text += &format!("{row}\n"));
    }
    text + after
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_rows_of_studies_that_were_run_are_replaced() {
        let row = |text: &str, study: &str| format!("| {text} | `percoat validate {study}` |");
        let page = format!("Title\n\n{HEAD}{}\n{}\n\nEnd\n", row("a", "one"), row("b", "two"));
        let text = renew(&page, &[("one", vec![row("c", "one"), row("d", "one")])], &["one", "two"]);
        assert_eq!(
            text,
            format!("Title\n\n{HEAD}{}\n{}\n{}\n\nEnd\n", row("c", "one"), row("d", "one"), row("b", "two"))
        );
        assert_eq!(renew(&page, &[], &["one", "two"]), page);
        let empty = format!("{HEAD}\n## End\n\nof it\n");
        assert_eq!(renew(&empty, &[], &["one"]), empty);
    }

    #[test]
    fn the_committed_page_has_statements_of_every_study_and_of_no_other() {
        let known: usize = STUDIES.iter().map(|study| rows_of(PAGE, study.name).len()).sum();
        assert!(STUDIES.iter().all(|study| !rows_of(PAGE, study.name).is_empty()));
        let table = PAGE.split_once(HEAD).unwrap().1.lines().take_while(|line| line.starts_with('|')).count();
        assert_eq!(table, known);
        assert_eq!(renewed(&[]), PAGE);
        let other = renewed(&[("paper/fig2", vec!["| other | `percoat validate paper/fig2` |".to_owned()])]);
        assert!(other != PAGE && is_around(&other) && is_around(PAGE));
        assert!(!is_around("# Mine\n") && !is_around(&(PAGE.to_owned() + "Mine.\n")));
    }

    #[test]
    fn a_row_that_changed_is_a_difference() {
        let rows: Vec<String> = rows_of(PAGE, "paper/fig2").into_iter().map(str::to_owned).collect();
        assert!(differences(&[("paper/fig2", rows.clone())]).is_empty());
        assert_eq!(differences(&[("paper/fig2", rows[1..].to_vec())]).len(), 1);
        let mut changed = rows;
        changed[0] = changed[0].replace("holds", "fails");
        assert_eq!(differences(&[("paper/fig2", changed)]).len(), 2);
    }
}
