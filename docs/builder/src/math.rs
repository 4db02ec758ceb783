//! Equations: blocks `math` and inline $`…`$ in LaTeX become MathML, which browsers typeset by themselves.

use anyhow::{Result, bail};
use pulldown_latex::config::DisplayMode;
use pulldown_latex::{Parser, RenderConfig, Storage, push_mathml};
use regex::{Captures, Regex};

/// The page with its equations typeset. Other blocks of code stay.
pub fn typeset(text: &str) -> Result<String> {
    let inline = Regex::new(r"\$`([^`]+)`\$")?;
    let mut page = String::with_capacity(text.len());
    let mut lines = text.split_inclusive('\n');
    while let Some(line) = lines.next() {
        let Some(info) = line.strip_prefix("```") else {
            let mut failed = None;
            page += &inline.replace_all(line, |found: &Captures<'_>| {
                mathml(&found[1], DisplayMode::Inline).unwrap_or_else(|error| {
                    failed = Some(error);
                    String::new()
                })
            });
            if let Some(error) = failed {
                return Err(error);
            }
            continue;
        };
        let content: String = lines.by_ref().take_while(|line| line.trim_end() != "```").collect();
        match info.trim().strip_prefix("math") {
            Some(number) => {
                let number = number.trim();
                let anchor = if number.is_empty() { String::new() } else { format!(" id=\"eq-{number}\"") };
                let number =
                    if number.is_empty() { String::new() } else { format!("<span class=\"number\">({number})</span>") };
                let equation = mathml(&content, DisplayMode::Block)?;
                page += &format!("<div class=\"equation\"{anchor}>{equation}{number}</div>\n\n");
            }
            None => page += &format!("{line}{content}```\n"),
        }
    }
    Ok(page)
}

fn mathml(latex: &str, display_mode: DisplayMode) -> Result<String> {
    let storage = Storage::new();
    let events: Vec<_> = Parser::new(latex, &storage).collect();
    if let Some(error) = events.iter().find_map(|event| event.as_ref().err()) {
        bail!("{latex}\n{error}");
    }
    let mut text = String::new();
    push_mathml(&mut text, events.into_iter(), RenderConfig { display_mode, ..RenderConfig::default() })?;
    // Markdown ends a block of HTML at an empty line.
    Ok(text.replace('\n', " "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equations_become_mathml_and_code_stays() {
        let page = typeset("The load $`\\bar p`$:\n```math 5\n\\frac{a}{b}\n```\n```text\n$`no`$\n```\n").unwrap();
        assert_eq!(page.matches("<math").count(), 2, "{page}");
        assert!(page.contains("<mfrac>") && page.contains("id=\"eq-5\"") && page.contains("(5)"), "{page}");
        assert!(page.contains("```text\n$`no`$\n```\n"), "{page}");
    }

    #[test]
    fn what_is_no_latex_is_refused() {
        assert!(typeset("$`\\frac{a`$").is_err());
        assert!(typeset("```math\n\\nonsense{a}\n```\n").is_err());
    }
}
