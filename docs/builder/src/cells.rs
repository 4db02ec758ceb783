//! A page as cells: commands with what they print, files, Python, and the text between them.

use anyhow::{Result, bail};

/// A page of the book.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Page {
    /// Parts of the page, in order.
    pub cells: Vec<Cell>,
}

/// A part of a page.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Cell {
    /// Lines that are shown as they are, code that is not run among them.
    Text(String),
    /// A block `console`.
    Console(Vec<Command>),
    /// A block with the name of a file behind its language, which is written.
    File {
        /// The line that opens the block.
        head: String,
        /// Name of the file.
        name: String,
        /// Content of the file.
        content: String,
    },
    /// A block `python`, and the block `text` behind it with what it prints.
    Python {
        /// The program.
        code: String,
        /// Output of the program; `None` without a block `text`.
        prints: Option<String>,
    },
}

/// A command and what it prints.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Command {
    /// The command, as it is typed.
    pub line: String,
    /// Output of the command, each line with its end.
    pub prints: String,
}

const FENCE: &str = "```";

impl Page {
    /// The page of a text in Markdown.
    pub fn read(text: &str) -> Result<Self> {
        let mut lines = text.split_inclusive('\n').peekable();
        let mut cells = Vec::new();
        while let Some(line) = lines.next() {
            let Some(info) = line.strip_prefix(FENCE) else {
                push_text(&mut cells, line);
                continue;
            };
            let mut content = String::new();
            loop {
                match lines.next() {
                    None => bail!("a block is not closed: {}", line.trim_end()),
                    Some(end) if end.trim_end() == FENCE => break,
                    Some(inside) => content += inside,
                }
            }
            let (language, name) = info.trim().split_once(' ').unwrap_or((info.trim(), ""));
            match language {
                "console" => cells.push(Cell::Console(commands(&content)?)),
                "python" => cells.push(Cell::Python { code: content, prints: None }),
                "text" if follows_python(&cells) => {
                    if let Some(gap) = cells.pop_if(|cell| matches!(cell, Cell::Text(_))) {
                        debug_assert_eq!(gap, Cell::Text("\n".to_owned()));
                    }
                    if let Some(Cell::Python { prints, .. }) = cells.last_mut() {
                        *prints = Some(content);
                    }
                }
                _ if !name.is_empty() && language != "math" && name.contains('.') => {
                    cells.push(Cell::File { head: line.to_owned(), name: name.to_owned(), content });
                }
                _ => push_text(&mut cells, &format!("{line}{content}{FENCE}\n")),
            }
        }
        Ok(Self { cells })
    }

    /// The page in Markdown.
    pub fn source(&self) -> String {
        self.cells.iter().map(Cell::source).collect()
    }
}

/// Whether the last cell is Python, with nothing but an empty line behind it.
fn follows_python(cells: &[Cell]) -> bool {
    match cells {
        [.., Cell::Python { prints: None, .. }] => true,
        [.., Cell::Python { prints: None, .. }, Cell::Text(gap)] => gap == "\n",
        _ => false,
    }
}

fn push_text(cells: &mut Vec<Cell>, text: &str) {
    match cells.last_mut() {
        Some(Cell::Text(before)) => *before += text,
        _ => cells.push(Cell::Text(text.to_owned())),
    }
}

fn commands(content: &str) -> Result<Vec<Command>> {
    let mut commands: Vec<Command> = Vec::new();
    for line in content.split_inclusive('\n') {
        match (line.strip_prefix("$ "), commands.last_mut()) {
            (Some(command), _) => commands.push(Command { line: command.trim_end().to_owned(), prints: String::new() }),
            // A command goes on behind a backslash.
            (None, Some(last)) if last.line.ends_with('\\') && last.prints.is_empty() => {
                last.line += &format!("\n{}", line.trim_end());
            }
            (None, Some(last)) => last.prints += line,
            (None, None) => bail!("a block of commands begins with \"$ \": {line}"),
        }
    }
    Ok(commands)
}

impl Cell {
    fn source(&self) -> String {
        match self {
            Self::Text(text) => text.clone(),
            Self::Console(commands) => {
                let commands: String =
                    commands.iter().map(|command| format!("$ {}\n{}", command.line, command.prints)).collect();
                format!("{FENCE}console\n{commands}{FENCE}\n")
            }
            Self::File { head, content, .. } => format!("{head}{content}{FENCE}\n"),
            Self::Python { code, prints } => {
                let prints = prints.as_ref().map(|prints| format!("\n{FENCE}text\n{prints}{FENCE}\n"));
                format!("{FENCE}python\n{code}{FENCE}\n{}", prints.unwrap_or_default())
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE: &str = "# A page\n\n```console\n$ percoat solve \\\n  mine.toml\na table\n\n$ ls out\n```\n\n```toml mine.toml\na = 1\n```\n\
        ```python\nprint(1)\n```\n\n```text\n1\n```\n\n```text\nfree\n```\n```math 3\nx\n```\nEnd.\n";

    #[test]
    fn a_page_reads_back_equal() {
        let page = Page::read(PAGE).unwrap();
        assert_eq!(page.source(), PAGE);
        let Cell::Console(commands) = &page.cells[1] else { panic!("{page:?}") };
        assert_eq!(commands[0].line, "percoat solve \\\n  mine.toml");
        assert_eq!((&*commands[0].prints, &*commands[1].prints), ("a table\n\n", ""));
        assert!(page.cells.iter().any(|cell| matches!(cell, Cell::Python { prints: Some(text), .. } if text == "1\n")));
        assert!(page.cells.iter().any(|cell| matches!(cell, Cell::File { name, .. } if name == "mine.toml")));
    }

    #[test]
    fn open_blocks_and_outputs_without_a_command_are_refused() {
        for text in ["```console\n$ a\n", "```console\nno command\n```\n"] {
            assert!(Page::read(text).is_err(), "{text}");
        }
    }
}
