//! The files that a run writes, and the earlier files that its result replaces.

use super::writer::Writer;

/// The files that a run may write.
#[derive(Debug, Clone)]
pub struct Plan {
    /// The command.
    pub writer: Writer,
    /// Names of all files that it may write, relative to the folder.
    pub names: Vec<String>,
    /// Beginning of the names of the earlier files that the result replaces; empty: all of the command.
    pub within: String,
    /// Beginnings of the names of those that stay as they are.
    pub kept: Vec<String>,
    /// Names of files whose content shows that they are percoat's, even where they are not listed.
    pub adopted: Vec<String>,
    /// Whether the run resumes an interrupted one with finished steps or combinations.
    pub resumes: bool,
    /// Content of `case.toml`, if it is among the names: a user's file of equal content is not refused, and stays the user's.
    pub case: Option<String>,
}

impl Plan {
    /// A plan without files that replaces all earlier files of the command.
    pub fn new(writer: Writer) -> Self {
        let (names, kept, adopted) = (Vec::new(), Vec::new(), Vec::new());
        Self { writer, names, within: String::new(), kept, adopted, resumes: false, case: None }
    }

    /// Whether the result replaces an earlier file that is listed under the command `by`.
    pub(super) fn replaces(&self, name: &str, by: Writer) -> bool {
        let is_kept = || self.kept.iter().any(|beginning| name.starts_with(beginning));
        by == self.writer.listed() && name.starts_with(&self.within) && !is_kept()
    }
}
