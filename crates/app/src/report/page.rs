//! The page: its head, and its parts one after the other.

use super::markup::{Markup, tag, void, with};
use super::part::{Part, with_warnings};
use super::results::Results;
use super::trailer::with_trailer;
use super::{ReportError, comparison, identification, life, limit, run, sweep};
use std::path::Path;

/// The report of an output folder.
#[derive(Debug, Clone)]
pub struct Page {
    /// A whole HTML file.
    pub html: String,
    /// Files that are not shown because they are missing or were changed since percoat wrote them, a sentence each.
    pub missing: Vec<String>,
}

/// The report of an output folder.
///
/// # Errors
/// [`ReportError`] without a finished result that this version can read, or where one was changed since percoat wrote it.
pub fn page(folder: &Path) -> Result<Page, ReportError> {
    let results = Results::read(folder)?;
    let mut parts = Vec::new();
    if let Some(swept) = &results.sweep {
        parts.push(sweep::part(&results, swept)?);
    }
    if let Some(file) = &results.limit {
        parts.push(limit::part(&results, file)?);
    }
    if let Some(file) = &results.life {
        parts.push(life::part(&results, file)?);
    }
    if let Some(file) = &results.identification {
        parts.push(identification::part(&results, file)?);
    }
    if let Some(file) = &results.comparison {
        parts.push(comparison::part(&results, file)?);
    }
    if let Some(file) = &results.run {
        parts.push(run::part(&results, file)?);
    }
    let parts = with_warnings(parts);
    results.whole()?;
    let missing = results.doubts();
    Ok(Page { html: with_trailer(&written(&parts, &missing)), missing })
}

fn written(parts: &[Part], missing: &[String]) -> String {
    let mut titles: Vec<&str> =
        parts.iter().map(|part| part.title.as_str()).filter(|title| !title.is_empty()).collect();
    titles.dedup();
    let heading = if titles.is_empty() { "Periodic contact".to_owned() } else { titles.join("; ") };
    let kinds = parts.iter().map(|part| part.kind).collect::<Vec<_>>().join(", ");
    let head = vec![
        void("meta", &[("charset", "utf-8")]),
        void("meta", &[("name", "viewport"), ("content", "width=device-width, initial-scale=1")]),
        void("meta", &[("name", "generator"), ("content", concat!("percoat ", env!("CARGO_PKG_VERSION")))]),
        void("meta", &[("name", "color-scheme"), ("content", "light dark")]),
        // No text of a result can load or run anything.
        void(
            "meta",
            &[
                ("http-equiv", "Content-Security-Policy"),
                ("content", "default-src 'none'; img-src data:; style-src 'unsafe-inline'"),
            ],
        ),
        tag("title", format!("{heading} – percoat")),
        tag("style", Markup::unescaped(include_str!("style.css"))),
    ];
    let doubt = |text: &String| with("p", &[("class", "doubt"), ("role", "note")], format!("{text}; it is not shown."));
    let doubts = missing.iter().map(doubt).collect::<Markup>();
    let header = vec![with("p", &[("class", "kind")], kinds), tag("h1", heading), doubts, contents(parts)];
    let footer = format!("Written by percoat {} from the files of the output folder.", env!("CARGO_PKG_VERSION"));
    let body = vec![
        tag("header", header),
        tag("main", parts.iter().map(|part| article(part, parts.len() > 1)).collect::<Markup>()),
        tag("footer", tag("p", footer)),
    ];
    let page = with("html", &[("lang", "en")], vec![tag("head", head), tag("body", body)]);
    format!("<!DOCTYPE html>\n{}\n", page.as_str())
}

/// Links to the sections.
fn contents(parts: &[Part]) -> Markup {
    let links = parts.iter().flat_map(|part| {
        let several = parts.len() > 1;
        part.sections.iter().filter(|section| !section.content.is_empty()).map(move |section| {
            let text = if several { format!("{}: {}", part.kind, section.heading) } else { section.heading.to_owned() };
            tag("li", with("a", &[("href", &format!("#{}-{}", part.name, section.name))], text))
        })
    });
    with("nav", &[("aria-label", "Sections")], tag("ul", links.collect::<Markup>()))
}

fn article(part: &Part, several: bool) -> Markup {
    let heading = if several { tag("h2", format!("{}: {}", part.kind, part.title)) } else { Markup::default() };
    let level = if several { "h3" } else { "h2" };
    let sections = part.sections.iter().filter(|section| !section.content.is_empty()).map(|section| {
        let anchor = format!("{}-{}", part.name, section.name);
        let class = format!("section {}", section.name);
        with(
            "section",
            &[("id", &anchor), ("class", &class)],
            vec![tag(level, section.heading), section.content.clone()],
        )
    });
    tag("article", [heading].into_iter().chain(sections).collect::<Markup>())
}
