//! A case between its text and its values: parsed once, changed and read many times.

use super::error::{CaseError, Refusal};
use super::model::{self, CASE};
use super::node::Table;
use super::overrides;
use super::{Case, Source};

/// The tree of a case with what is set in it. A sweep and an identification read each of their cases from one tree.
#[derive(Debug)]
pub struct Document<'a> {
    source: &'a Source,
    /// Overrides `KEY=VALUE` that the tree has.
    set: Vec<String>,
    tree: Table,
}

impl Case {
    /// Reads a case and changes it by the values that its source sets and by `overrides`, each `KEY=VALUE`, in their order.
    ///
    /// # Errors
    /// [`CaseError`] for the first fault found: TOML, unknown, missing or misspelt keys, types, ranges.
    pub fn read(source: &Source, overrides: &[String]) -> Result<Self, CaseError> {
        Document::new(source, overrides)?.case()
    }
}

impl<'a> Document<'a> {
    /// Parses a source, and changes it by the values that it sets and by `overrides`, each `KEY=VALUE`, in their order.
    ///
    /// # Errors
    /// [`CaseError`] of a text that is no TOML, and of an override that does not fit.
    pub fn new(source: &'a Source, overrides: &[String]) -> Result<Self, CaseError> {
        let tree = source.read(overrides, |source| tree_of(source, overrides))?;
        Ok(Self { source, set: overrides.to_vec(), tree })
    }

    /// The case.
    ///
    /// # Errors
    /// [`CaseError`] of the first fault found: unknown, missing or misspelt keys, types, ranges.
    pub fn case(&self) -> Result<Case, CaseError> {
        self.changed(&[])
    }

    /// The case with further overrides.
    ///
    /// # Errors
    /// [`CaseError`] of the first fault found, also of an override that does not fit.
    pub fn changed(&self, overrides: &[String]) -> Result<Case, CaseError> {
        let mut tree = self.tree.clone();
        let read = change(&mut tree, self.next(), overrides).and_then(|()| model::read(tree, self.source));
        read.map_err(|refusal| {
            let all = [&self.set, overrides].concat();
            self.source.error_of(refusal, &all, |source| model::read(tree_of(source, &all)?, source))
        })
    }

    /// Number of the next override among the texts into which spans point.
    fn next(&self) -> usize {
        1 + self.source.set.len() + self.set.len()
    }
}

/// The tree of a source with overrides.
fn tree_of(source: &Source, overrides: &[String]) -> Result<Table, Refusal> {
    let mut tree = source.tree(&CASE)?;
    change(&mut tree, 1 + source.set.len(), overrides)?;
    Ok(tree)
}

/// Changes a tree by overrides, the first of which has a `number` among the texts into which spans point.
fn change(tree: &mut Table, number: usize, overrides: &[String]) -> Result<(), Refusal> {
    (number..).zip(overrides).try_for_each(|(number, text)| overrides::apply(text, number, tree, &CASE))
}

#[cfg(test)]
mod tests {
    use super::super::embedded;
    use super::*;

    fn texts(texts: &[&str]) -> Vec<String> {
        texts.iter().map(|&text| text.to_owned()).collect()
    }

    #[test]
    fn a_changed_case_is_that_of_all_overrides_at_once() {
        let mut source = embedded::source("dlc-on-steel").unwrap();
        source.set = vec![("layers.0.thickness".to_owned(), toml::Value::Float(0.75))];
        let [first, second] =
            [texts(&["layers.0.poisson=0.31"]), texts(&["layers[0].poisson=0.32", "load.mean_pressure=0.01"])];
        let document = Document::new(&source, &first).unwrap();
        let all = [&first[..], &second].concat();
        assert_eq!(document.changed(&second).unwrap(), Case::read(&source, &all).unwrap());
        assert_eq!(document.case().unwrap(), Case::read(&source, &first).unwrap(), "no change stays");
    }

    /// Faults of texts, of values in memory, and of what is set in either: each with the text in which it stands.
    #[test]
    fn a_fault_is_shown_where_it_stands() {
        let text = embedded::source("fig2").unwrap();
        let values = Source { values: Some(text.text.parse().unwrap()), text: String::new(), ..text.clone() };
        let first = texts(&["grid.points=48", "layers.0.poisson=0.7"]);
        for mut source in [text, values] {
            source.set = vec![("title".to_owned(), toml::Value::String("t".to_owned()))];
            for (set, changed) in [
                (&first[..1], &["layers.0.poisson=0.7"][..]),
                (&first[..], &[]),
                (&[], &["layers.9.young=1"]),
                (&[], &["=1"]),
            ] {
                let changed = texts(changed);
                let told = Document::new(&source, set).and_then(|document| document.changed(&changed)).unwrap_err();
                let whole = Case::read(&source, &[set, &changed].concat()).unwrap_err();
                assert_eq!(told.render(false), whole.render(false));
                assert!(told.render(false).contains("--set"), "{}", told.render(false));
            }
        }
    }
}
