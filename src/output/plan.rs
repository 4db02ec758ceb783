//! What a run is going to write, and which earlier files its result replaces.

use super::writer::Writer;

/// What a run is going to write.
#[derive(Debug, Clone)]
pub struct Plan {
    /// The command.
    pub writer: Writer,
    /// Names of all files that it may write, relative to the folder.
    pub names: Vec<String>,
    /// Which of the writer's earlier files the result replaces.
    pub scope: Scope,
    /// Names of files whose content shows that they are percoat's, whatever its list says.
    pub adopted: Vec<String>,
    /// Whether the run goes on with finished steps or combinations of an interrupted one.
    pub resumes: bool,
    /// Content of `case.toml`, if it is among the names: a file of that content is no obstacle, and stays its owner's.
    pub case: Option<String>,
}

impl Plan {
    /// A result without files that replaces the writer's earlier one.
    pub fn new(writer: Writer) -> Self {
        Self { writer, names: Vec::new(), scope: Scope::default(), adopted: Vec::new(), resumes: false, case: None }
    }
}

/// Earlier files of a writer that its new result replaces, by the beginnings of their names.
#[derive(Debug, Clone, Default)]
pub struct Scope {
    /// Beginning of the names of all of them; empty: every name.
    pub within: String,
    /// Beginnings of the names of those that stay as they are.
    pub except: Vec<String>,
}

impl Scope {
    pub(super) fn contains(&self, name: &str) -> bool {
        name.starts_with(&self.within) && !self.except.iter().any(|kept| name.starts_with(kept))
    }
}
