//! The files that a run writes, and the earlier files that its result replaces.

use super::writer::Writer;

/// The files that a run may write.
#[derive(Debug, Clone)]
pub struct Plan {
    /// The command.
    pub writer: Writer,
    /// Names of all files that it may write, relative to the folder.
    pub names: Vec<String>,
    /// The writer's earlier files that the result replaces.
    pub scope: Scope,
    /// Names of files whose content shows that they are percoat's, even where they are not listed.
    pub adopted: Vec<String>,
    /// Whether the run resumes an interrupted one with finished steps or combinations.
    pub resumes: bool,
    /// Content of `case.toml`, if it is among the names: a user's file of equal content is not refused, and stays the user's.
    pub case: Option<String>,
}

impl Plan {
    /// A plan without files that replaces all earlier files of the writer.
    pub fn new(writer: Writer) -> Self {
        Self { writer, names: Vec::new(), scope: Scope::default(), adopted: Vec::new(), resumes: false, case: None }
    }

    /// Whether the result replaces an earlier file that is listed under the command `by`.
    pub(super) fn replaces(&self, name: &str, by: Writer) -> bool {
        by == self.writer.listed() && self.scope.contains(name)
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
    fn contains(&self, name: &str) -> bool {
        name.starts_with(&self.within) && !self.except.iter().any(|kept| name.starts_with(kept))
    }
}
