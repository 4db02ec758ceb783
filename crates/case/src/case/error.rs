//! The error of a case that is refused: it names line and key, the value received, the values allowed, and a remedy.

use std::fmt;
use std::ops::Range;

use ariadne::{CharSet, Color, Config, IndexType, Label, Report, ReportKind};

use super::span::Span;
use percoat_common::plain;

/// A refusal at a span of one of the sources, before its excerpt is made.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Refusal {
    pub(super) span: Span,
    message: String,
    label: String,
    help: Option<String>,
    /// Name and text of the file into which the span points, where it is none of the sources of the case.
    file: Option<Box<[String; 2]>>,
}

impl Refusal {
    /// A refusal of the text at `span`; `message` names the key and the fault, `label` is shown at the excerpt.
    pub(super) fn new(span: Span, message: impl Into<String>, label: impl Into<String>) -> Self {
        Self { span, message: message.into(), label: label.into(), help: None, file: None }
    }

    /// Adds advice.
    pub(super) fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// The refusal of the text of another file than the case.
    pub(super) fn in_file(mut self, name: &str, text: &str) -> Self {
        self.file = Some(Box::new([name.to_owned(), text.to_owned()]));
        self
    }

    /// Adds advice where there is none.
    pub(super) fn or_help(mut self, help: impl Into<String>) -> Self {
        self.help.get_or_insert_with(|| help.into());
        self
    }
}

/// Why a case was refused: one fault, with its place in the case file or in a `--set`.
///
/// `Display` gives plain text; [`CaseError::render`] also in colour.
#[derive(Debug, Clone, PartialEq)]
pub struct CaseError(Box<Excerpt>);

#[derive(Debug, Clone, PartialEq)]
struct Excerpt {
    name: String,
    text: String,
    span: Range<usize>,
    refusal: Refusal,
}

impl CaseError {
    /// The error of a refusal, with an excerpt of the text: of the file of this `name`, or of a `--set`, unless the refusal has a
    /// file of its own. A span over several lines is cut to its first one; control characters are escaped.
    pub(super) fn new(name: &str, text: &str, refusal: Refusal) -> Self {
        let Refusal { span, message, label, help, file } = refusal;
        let [name, text] = file.as_ref().map_or([name, text], |file| [&file[0], &file[1]]);
        let Span { start, end, .. } = span;
        let boundary = |at: usize| (0..=at.min(text.len())).rev().find(|at| text.is_char_boundary(*at)).unwrap_or(0);
        let start = boundary(start);
        let line = text[start..].find(['\r', '\n']).map_or(text.len(), |length| start + length);
        let end = boundary(end).clamp(start, line);
        // Escapes lengthen the text.
        let shown = [start, end].map(|at| plain::lines(&text[..at]).len());
        let [message, label] = [message, label].map(|text| plain::line(&text).into_owned());
        let help = help.map(|help| plain::lines(&help).into_owned());
        Self(Box::new(Excerpt {
            name: plain::line(name).into_owned(),
            text: plain::lines(text).into_owned(),
            span: shown[0]..shown[1],
            refusal: Refusal { span, message, label, help, file: None },
        }))
    }

    /// The fault in one sentence, without excerpt and advice.
    pub fn message(&self) -> &str {
        &self.0.refusal.message
    }

    /// The whole error with its excerpt, several lines; with colour for a terminal or without.
    pub fn render(&self, color: bool) -> String {
        let Excerpt { name, text, span, refusal } = &*self.0;
        let config = Config::new()
            .with_color(color)
            .with_index_type(IndexType::Byte)
            .with_char_set(CharSet::Unicode)
            .with_label_attach(ariadne::LabelAttach::Start);
        let at = (name.as_str(), span.clone());
        let mut report = Report::build(ReportKind::Error, at.clone())
            .with_config(config)
            .with_message(&refusal.message)
            .with_label(Label::new(at).with_message(&refusal.label).with_color(Color::Red));
        if let Some(help) = &refusal.help {
            report.set_help(help);
        }
        let mut rendered = Vec::new();
        let source = ariadne::Source::from(text.as_str());
        match report.finish().write((name.as_str(), source), &mut rendered) {
            Ok(()) => {
                // In lower case, as all errors of the command line; a custom kind of report would always be coloured.
                let lines = String::from_utf8_lossy(&rendered).replacen("Error:", "error:", 1);
                lines.lines().map(str::trim_end).collect::<Vec<_>>().join("\n").trim_end().to_owned()
            }
            // Writing into memory does not fail.
            Err(_) => refusal.message.clone(),
        }
    }
}

impl fmt::Display for CaseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.render(false))
    }
}

impl std::error::Error for CaseError {}
