//! `material` of a section: the numbers of the library at the keys that the section leaves out.
//!
//! The tree of a case is filled before it is read, so that a case holds numbers alone and is written with them. A section that
//! has both moduli needs no library: its `material` is a name only. So a written case reads back the same whatever becomes of the
//! library, and of the file `materials`.

use super::entry::LibraryMaterial;
use super::library::{self, UnknownMaterial, library};
use crate::case::error::Refusal;
use crate::case::keys::{Absent, Key, Keys, Unit};
use crate::case::model::CASE;
use crate::case::node::{Entry, Node, Table, Value};
use crate::case::reader::TableAt;
use crate::case::source::Source;
use crate::case::span::Span;
use crate::case::value::ValueAt;
use crate::units::pascals;

/// Pascals of the unit of the library.
const GPA: f64 = 1e9;

/// The key of a case that names a file of materials.
const FILE: &str = "materials";

/// Fills every section of the tree that has a `material` and leaves keys out.
pub(in crate::case) fn fill(tree: &mut Table, source: &Source) -> Result<(), Refusal> {
    let root = TableAt::root(tree, &CASE, Span::NOWHERE);
    let file = root.optional(FILE).map(|value| value.text().map(|name| (name.to_owned(), value.node.span))).transpose()?;
    let pressure = root.section("units")?.and_then(|units| units.optional("pressure"));
    let pressure = pressure.as_ref().map(|value| value.name().map(|name| (name.to_owned(), value.node.span))).transpose()?;
    Filling { source, file, pressure, own: None }.table(tree, &CASE, "")
}

/// The absolute path of the file of materials of a case; the name of one in memory.
pub(in crate::case) fn path(root: &TableAt<'_>, source: &Source) -> Result<Option<String>, Refusal> {
    let path = |value: ValueAt<'_>| {
        let name = value.text()?;
        Ok(source.path(name).map_or(name.to_owned(), |path| path.to_string_lossy().into_owned()))
    };
    root.optional(FILE).map(path).transpose()
}

/// What the sections of a case are filled from.
struct Filling<'a> {
    source: &'a Source,
    /// Name of the file of materials, and its place in the case.
    file: Option<(String, Span)>,
    /// `units.pressure`, and its place in the case.
    pressure: Option<(String, Span)>,
    /// The materials of the file, once one was looked up.
    own: Option<Vec<LibraryMaterial>>,
}

impl Filling<'_> {
    /// Fills a table that has these `keys`, and those inside it.
    fn table(&mut self, table: &mut Table, keys: &'static Keys, path: &str) -> Result<(), Refusal> {
        for entry in &mut table.entries {
            let (keys, path) = (keys.within(&entry.key), format!("{path}.{}", entry.key));
            match &mut entry.node.value {
                Value::Table(inner) => self.table(inner, keys, &path)?,
                Value::List(items) => {
                    for (index, item) in items.iter_mut().enumerate() {
                        if let Value::Table(inner) = &mut item.value {
                            self.table(inner, keys, &format!("{path}[{index}]"))?;
                        }
                    }
                }
                _ => {}
            }
        }
        match keys.all.iter().find(|key| !key.fills.is_empty()) {
            Some(key) => self.section(table, keys, key, path.trim_start_matches('.')),
            None => Ok(()),
        }
    }

    /// Fills a section from the material that its `key` names.
    fn section(&mut self, table: &mut Table, keys: &'static Keys, key: &Key, path: &str) -> Result<(), Refusal> {
        // The reader refuses what is no text.
        let Some((name, span)) = table.get(key.name).and_then(|entry| match &entry.node {
            Node { value: Value::Text(name), span } => Some((name.clone(), *span)),
            _ => None,
        }) else {
            return Ok(());
        };
        let is_absent = |key: &&Key| !std::iter::once(key.name).chain(keys.excluded(key.name)).any(|own| table.get(own).is_some());
        let absent: Vec<&Key> = key.fills.iter().filter_map(|own| keys.get(own)).filter(is_absent).collect();
        let material = match absent.iter().any(|key| key.absent == Absent::Refused) {
            true => Some((self.find(&name, path, span)?.clone(), self.factor(path, span)?)),
            false => None,
        };
        for key in absent {
            let value = match (key.name, &material) {
                ("name", _) => Some(Value::Text(name.clone())),
                (own, Some((material, factor))) => material.number(own).map(|x| match key.unit {
                    Unit::Pressure => Value::Float(rounded(x * factor)),
                    _ => Value::Float(x),
                }),
                _ => None,
            };
            let entry = |value| Entry { key: key.name.to_owned(), key_span: span, node: Node { value, span } };
            value.map(entry).into_iter().for_each(|entry| table.insert(entry));
        }
        Ok(())
    }

    /// The material of a name: of the file, else of the library.
    fn find(&mut self, name: &str, path: &str, span: Span) -> Result<&LibraryMaterial, Refusal> {
        if let (None, Some((file, at))) = (&self.own, &self.file) {
            self.own = Some(own(self.source, file, *at)?);
        }
        let all = || self.own.iter().flatten().chain(library());
        all().find(|own| own.name == name).ok_or_else(|| {
            let unknown = UnknownMaterial::among(name, all());
            let message = format!("`{path}.material`: there is no material \"{name}\"");
            Refusal::new(span, message, "unknown material").help(match unknown.near {
                Some(near) => format!("did you mean \"{near}\"?"),
                None => "`percoat materials` lists them; or give `young` and `poisson`, and it is a name alone".to_owned(),
            })
        })
    }

    /// GPa in the unit of the case's pressures.
    fn factor(&self, path: &str, span: Span) -> Result<f64, Refusal> {
        let Some((unit, at)) = &self.pressure else {
            let message = format!("`{path}.material` needs the unit of the case's pressures: the library is in GPa");
            return Err(Refusal::new(span, message, "in which unit?").help(
                "name it, for example\n[units]\npressure = \"GPa\"\nor give `young` and `poisson`, and `material` is a name alone",
            ));
        };
        pascals(unit).map(|pascals| GPA / pascals).ok_or_else(|| {
            let message = format!("`units.pressure` must be a known unit for `{path}.material`, not the text {unit:?}");
            Refusal::new(*at, message, "the library is in GPa").help(
                "allowed: Pa with any prefix, N/mm², N/m², bar, hPa, psi, ksi, Msi, atm; or give `young` and `poisson`, and \
                 `material` is a name alone",
            )
        })
    }
}

/// The materials of the file `name` of a case, which stands at `span`; a fault of it is shown in its own text.
fn own(source: &Source, name: &str, span: Span) -> Result<Vec<LibraryMaterial>, Refusal> {
    let file = source.text_of(name).map_err(|error| {
        let shown = source.path(name).map_or_else(|| name.to_owned(), |path| path.display().to_string());
        let message = format!("`{FILE}`: cannot read {shown}: {error}");
        Refusal::new(span, message, "this file").help("a file of [[material]] entries; its path is relative to the case file")
    })?;
    library::read(&file).map_err(|refusal| refusal.in_file(&file.name, &file.text))
}

/// To twelve digits, which no conversion spoils.
fn rounded(x: f64) -> f64 {
    format!("{x:.11e}").parse().unwrap_or(x)
}
