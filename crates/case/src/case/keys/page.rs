//! Explanations as text, in lines of at most 80 letters.

use std::fmt;

use super::super::suggestions::joined;
use super::explanation::{Explanation, sections};

/// Letters of a line.
const WIDTH: usize = 80;

/// The sections of a case with a sentence each, and a hint at `percoat explain`.
pub fn overview() -> String {
    let mut text = "A case is a TOML file with these keys and sections:\n\n".to_owned();
    for section in sections() {
        let name = match (section.keys.is_empty(), section.example.starts_with("[[")) {
            (true, _) => section.path.clone(),
            (false, true) => format!("[[{}]]", section.path),
            (false, false) => format!("[{}]", section.path),
        };
        text += &entry(&format!("  {name}"), 15, &section.what);
    }
    text + "\n\
        percoat explain layers           the keys of a section\n\
        percoat explain layers.poisson   a key: type, range, unit, default, example\n\
        percoat explain points           a key wherever it stands\n\
        percoat explain --schema         all of it as a JSON schema, for editors\n"
}

impl fmt::Display for Explanation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&wrapped(&format!("{}: {}", self.path, self.what), 2))?;
        f.write_str("\n")?;
        let line =
            |f: &mut fmt::Formatter<'_>, name: &str, text: &str| f.write_str(&entry(&format!("  {name}"), 12, text));
        line(f, "type", &self.forms)?;
        if let Some(range) = &self.range {
            line(f, "range", range)?;
        }
        if let Some(unit) = &self.unit {
            line(f, "unit", unit)?;
        }
        line(f, "default", &self.when_absent())?;
        if !self.kinds.is_empty() {
            line(f, "only for", &joined(&self.kinds, "and"))?;
        }
        if !self.excludes.is_empty() {
            line(f, "excludes", &joined(&self.excludes, "and"))?;
        }
        if let Some(rule) = &self.rule {
            line(f, "note", rule)?;
        }
        for (index, text) in self.example.lines().enumerate() {
            writeln!(f, "{:<12}{text}", if index == 0 { "  example" } else { "" })?;
        }
        if let Some(line) = self.set.as_ref().map(|set| format!("{:<12}--set {set}", "  or"))
            && line.chars().count() <= WIDTH
        {
            writeln!(f, "{line}")?;
        }
        if self.keys.is_empty() {
            return Ok(());
        }
        f.write_str("\nIts keys:\n\n")?;
        let width = self.keys.iter().map(|key| key.name().chars().count()).max().unwrap_or(0) + 4;
        for key in &self.keys {
            f.write_str(&entry(&format!("  {}", key.name()), width, &key.what))?;
            f.write_str(&entry("", width, &format!("{}; {}", key.value, key.in_short())))?;
        }
        Ok(())
    }
}

impl Explanation {
    fn name(&self) -> &str {
        self.path.rsplit('.').next().unwrap_or_default()
    }

    /// The meaning of its absence, as a sentence.
    fn when_absent(&self) -> String {
        match &self.default {
            Some(default) => default.clone(),
            None if !self.kinds.is_empty() || self.instead.is_empty() => "none, it must be given".to_owned(),
            None => {
                let names = [&["it".to_owned()], &self.instead[..]].concat();
                format!("none, {} must be given", joined(&names, "or"))
            }
        }
    }

    /// The meaning of its absence in a few words.
    fn in_short(&self) -> String {
        match &self.default {
            Some(default) => format!("default: {default}"),
            None if !self.kinds.is_empty() => format!("required for {}", joined(&self.kinds, "and")),
            None if self.instead.is_empty() => "required".to_owned(),
            None => format!("required, or {}", joined(&self.instead, "or")),
        }
    }
}

fn entry(name: &str, column: usize, text: &str) -> String {
    let text = wrapped(text, column);
    let gap = if name.chars().count() < column { column - name.chars().count() } else { 1 };
    // The text is wrapped with blanks in place of the name.
    format!("{name}{}{}", " ".repeat(gap), text.trim_start())
}

/// A text in lines, each as long as if indented; the first is not.
fn wrapped(text: &str, indent: usize) -> String {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let length = lines.last().map_or(0, |line| line.chars().count());
        if length > 0 && indent + length + 1 + word.chars().count() > WIDTH {
            lines.push(String::new());
        }
        if let Some(line) = lines.last_mut() {
            if !line.is_empty() {
                line.push(' ');
            }
            line.push_str(word);
        }
    }
    lines.join(&format!("\n{}", " ".repeat(indent))) + "\n"
}
