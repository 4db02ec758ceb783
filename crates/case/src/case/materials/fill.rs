//! `material` of a section: the numbers of the library at the keys that the section leaves out.
//!
//! The tree of a case is filled before it is read, so that a case holds numbers alone and is written with them. A section that
//! has both moduli needs no library: its `material` is a name only. So a written case reads back the same whatever becomes of the
//! library, and of the file `materials`.

use super::entry::LibraryMaterial;
use super::library::{self, UnknownMaterial, library};
use crate::case::error::Refusal;
use crate::case::keys::{Absent, Key, Keys, Unit};
use crate::case::node::{Entry, Node, Table, Value};
use crate::case::reader::TableAt;
use crate::case::source::Source;
use crate::case::span::Span;
use crate::case::value::ValueAt;
use crate::units::pascals;

/// Pascals of the unit of the library.
pub(in crate::case) const GPA: f64 = 1e9;

/// The key of a case that names a file of materials.
const FILE: &str = "materials";

/// Fills every section of a tree with these `keys` that has a `material` and leaves keys out.
pub(in crate::case) fn fill(tree: &mut Table, keys: &'static Keys, source: &Source) -> Result<(), Refusal> {
    let root = TableAt::root(tree, keys, Span::NOWHERE);
    let file =
        root.optional(FILE).map(|value| value.text().map(|name| (name.to_owned(), value.node.span))).transpose()?;
    let pressure = root.section("units")?.and_then(|units| units.optional("pressure"));
    let pressure =
        pressure.as_ref().map(|value| value.name().map(|name| (name.to_owned(), value.node.span))).transpose()?;
    Filling { source, file, pressure, materials: None }.table(tree, keys, "")
}

/// The absolute path of the file of materials of a case; the name of one in memory.
pub(in crate::case) fn path(root: &TableAt<'_>, source: &Source) -> Result<Option<String>, Refusal> {
    let path = |value: ValueAt<'_>| {
        let name = value.text()?;
        Ok(source.path(name).map_or(name.to_owned(), |path| path.to_string_lossy().into_owned()))
    };
    root.optional(FILE).map(path).transpose()
}

/// Sources of the keys that the sections of a case leave out.
struct Filling<'a> {
    source: &'a Source,
    /// Name of the file of materials, and its place in the case.
    file: Option<(String, Span)>,
    /// `units.pressure`, and its place in the case.
    pressure: Option<(String, Span)>,
    /// The materials of the file, once one was looked up.
    materials: Option<Vec<LibraryMaterial>>,
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
        // A switch that is off excludes nothing.
        let is_given = |entry: &Entry| entry.key == key.name || !matches!(entry.node.value, Value::Boolean(false));
        let is_absent = |key: &&Key| {
            !std::iter::once(key.name).chain(keys.excluded(key.name)).any(|name| table.get(name).is_some_and(is_given))
        };
        let absent: Vec<&Key> = key.fills.iter().filter_map(|name| keys.get(name)).filter(is_absent).collect();
        let material = match absent.iter().any(|key| key.absent == Absent::Refused) {
            true => Some((self.find(&name, path, span)?.clone(), self.factor(path, span)?)),
            false => None,
        };
        for key in absent {
            let value = match (key.name, &material) {
                ("name", _) => Some(Value::Text(name.clone())),
                (property, Some((material, factor))) => {
                    material.property(property).map(|property| property.value).map(|x| match key.unit {
                        Unit::Pressure => Value::Float(rounded(x * factor)),
                        _ => Value::Float(x),
                    })
                }
                _ => None,
            };
            let entry = |value| Entry { key: key.name.to_owned(), key_span: span, node: Node { value, span } };
            value.map(entry).into_iter().for_each(|entry| table.insert(entry));
        }
        Ok(())
    }

    /// The material of a name: of the file, else of the library.
    fn find(&mut self, name: &str, path: &str, span: Span) -> Result<&LibraryMaterial, Refusal> {
        if let (None, Some((file, at))) = (&self.materials, &self.file) {
            self.materials = Some(materials(self.source, file, *at)?);
        }
        let all = || self.materials.iter().flatten().chain(library());
        all().find(|material| material.is_called(name)).ok_or_else(|| {
            let message = format!("`{path}.material`: there is no material \"{name}\"");
            let refusal = Refusal::new(span, message, "unknown material");
            let add = |file: &str| format!("add it to {file}:\n{}", entry(name));
            let file = self.file.as_ref().map(|(file, _)| file);
            refusal.help(match (UnknownMaterial::among(name, all()).help(), file) {
                (Some(meant), None) => meant,
                (Some(meant), Some(file)) => format!("{meant} Or {}", add(file)),
                (None, file) => format!(
                    "`percoat materials` lists them; or give `young` and `poisson`, and it is a name alone; or {}",
                    add(file.map_or("a file that `materials` names", String::as_str))
                ),
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

/// An entry of a file of materials, the shortest with this name.
fn entry(name: &str) -> String {
    format!("[[material]]\nname = {}\nyoung = 210.0      # GPa\npoisson = 0.3", toml::Value::from(name))
}

/// The materials of the file `name` of a case, which stands at `span`; a fault of it is shown in its own text.
fn materials(source: &Source, name: &str, span: Span) -> Result<Vec<LibraryMaterial>, Refusal> {
    let file = source.text_of(name).map_err(|error| {
        let shown = source.path(name).map_or_else(|| name.to_owned(), |path| path.display().to_string());
        let message = format!("`{FILE}`: cannot read {shown}: {error}");
        Refusal::new(span, message, "this file").help(format!(
            "its path is relative to the case file; it is a list of such entries:\n{}",
            entry("shop steel")
        ))
    })?;
    library::read(&file).map_err(|refusal| refusal.in_file(&file.name, &file.text))
}

/// `x` to twelve digits, which no conversion spoils.
pub(super) fn rounded(x: f64) -> f64 {
    format!("{x:.11e}").parse().unwrap_or(x)
}

#[cfg(test)]
mod tests {
    use crate::case::{Case, CaseError, Source};

    const CASE: &str = "lattice = { kind = \"square\", period = 10 }\nlevels = [{ shape = \"sphere\", radius = 9 }]\n\
                        load = { mean_pressure = 1 }\n";

    /// A case with these lines, and the file `own.toml`.
    fn read(lines: &str, file: &str, set: &[&str]) -> Result<Case, CaseError> {
        let set: Vec<String> = set.iter().map(|&text| text.to_owned()).collect();
        Case::read(&source(lines, file), &set)
    }

    fn source(lines: &str, file: &str) -> Source {
        let files = [("own.toml".to_owned(), file.as_bytes().into())].into();
        Source { name: "case.toml".to_owned(), text: format!("{lines}\n{CASE}"), files, ..Source::default() }
    }

    fn valid(lines: &str, file: &str, set: &[&str]) -> Case {
        read(lines, file, set).unwrap_or_else(|error| panic!("{error}"))
    }

    const OWN: &str = "[[material]]\nname = \"mine\"\nyoung = 3.0\npoisson = { value = 0.4, range = [0.3, 0.45] }\n\
                       tensile_strength = 0.07\n[[material]]\nname = \"TiN\"\nyoung = 1\npoisson = 0.1\n";

    #[test]
    fn a_material_gives_what_its_section_leaves_out_in_the_unit_of_the_case() {
        for (unit, young, yielding, hardness) in [
            ("GPa", 193.0, 0.215, 1.36),
            ("MPa", 193e3, 215.0, 1360.0),
            ("N/mm²", 193e3, 215.0, 1360.0),
            ("Pa", 193e9, 215e6, 136e7),
            ("TPa", 0.193, 2.15e-4, 1.36e-3),
            ("bar", 193e4, 2150.0, 13_600.0),
        ] {
            let lines = format!("substrate = {{ material = \"AISI 304\" }}\nunits = {{ pressure = \"{unit}\" }}");
            // The load is below the hardness in every unit.
            let substrate = valid(&lines, "", &["load.mean_pressure=1e-6"]).substrate;
            assert_eq!(
                (substrate.young, substrate.poisson, substrate.yield_strength, substrate.hardness),
                (Some(young), Some(0.29), Some(yielding), Some(hardness)),
                "{unit}"
            );
            assert_eq!((substrate.wear, substrate.fatigue, substrate.endurance), (None, None, None), "{unit}");
            assert_eq!(
                (substrate.name.as_deref(), substrate.material.as_deref()),
                (Some("AISI 304"), Some("AISI 304"))
            );
            // The ultimate strength of a ductile steel is none at which it cracks.
            assert_eq!(substrate.tensile_strength, None);
        }
    }

    #[test]
    fn any_key_beside_it_overrides() {
        let layer = "layers = [{ thickness = 1, material = \"SiC\", ";
        let units = "substrate = { young = 200, poisson = 0.3 }\nunits = { pressure = \"GPa\" }";
        let of = |keys: &str| valid(&format!("{layer}{keys} }}]\n{units}"), "", &[]).layers.remove(0);
        let ratio = of("shear_ratio = 2, name = \"a\"");
        assert_eq!((ratio.young, ratio.shear_ratio, ratio.poisson), (None, Some(2.0), Some(0.16)));
        assert_eq!((ratio.name.as_deref(), ratio.tensile_strength), (Some("a"), Some(0.41)));
        let young = of("young = 300, tensile_strength = 1");
        assert_eq!((young.young, young.poisson, young.tensile_strength), (Some(300.0), Some(0.16), Some(1.0)));
        assert_eq!((young.hardness, of("hardness = 25").hardness), (Some(27.0), Some(25.0)));
        // Beside both moduli a name is no more than a name, known or not.
        let graded = of("graded = { young = [2, 1], poisson = [0.2, 0.3] }");
        assert_eq!((graded.young, graded.poisson, graded.tensile_strength), (None, None, None));
        assert_eq!(graded.hardness, None);
        assert_eq!(graded.name.as_deref(), Some("SiC"));
    }

    #[test]
    fn a_written_case_needs_neither_library_nor_file() {
        let lines = "materials = \"own.toml\"\nlayers = [{ thickness = 1, material = \"mine\" }]\n\
                     substrate = { material = \"100Cr6\" }\nunits = { pressure = \"MPa\" }";
        let case = valid(lines, OWN, &[]);
        assert_eq!((case.layers[0].young, case.layers[0].tensile_strength), (Some(3000.0), Some(70.0)));
        let text = case.to_toml();
        for line in ["material = \"mine\"", "young = 3000.0", "tensile_strength = 70.0", "material = \"100Cr6\""] {
            assert!(text.contains(line), "{line} does not stand in\n{text}");
        }
        // Without the file, and with numbers that no library has.
        let text = text.replace("207000.0", "206000.0");
        let again = Case::read(&Source { text: text.clone(), ..Source::default() }, &[]).unwrap();
        assert_eq!((again.substrate.young, &again.layers), (Some(206e3), &case.layers));
        // Only the path of the file depends on where it is read.
        let without = |text: &str| text.lines().filter(|line| !line.starts_with("materials = ")).collect::<String>();
        assert_eq!(without(&again.to_toml()), without(&text));
    }

    #[test]
    fn another_material_takes_the_place_of_the_numbers_before_it() {
        let lines = "substrate = { young = 1, poisson = 0.3, yield_strength = 2, hardness = 3, name = \"a\" }\nunits = { pressure = \"GPa\" }";
        let substrate = valid(lines, "", &["substrate.material=TiN"]).substrate;
        assert_eq!((substrate.young, substrate.poisson, substrate.yield_strength), (Some(430.0), Some(0.25), None));
        assert_eq!(substrate.hardness, Some(24.0));
        assert_eq!(substrate.name.as_deref(), Some("TiN"));
        let later = valid(lines, "", &["substrate.material=TiN", "substrate.young=300"]).substrate;
        assert_eq!((later.young, later.poisson), (Some(300.0), Some(0.25)));
    }

    #[test]
    fn materials_of_a_file_come_before_those_of_the_library() {
        let of = |file: &str| {
            let lines = format!("{file}substrate = {{ material = \"TiN\" }}\nunits = {{ pressure = \"GPa\" }}");
            valid(&lines, OWN, &[]).substrate.young
        };
        assert_eq!((of(""), of("materials = \"own.toml\"\n")), (Some(430.0), Some(1.0)));
    }

    #[test]
    fn faults_of_a_file_are_told_with_its_line() {
        let lines = "materials = \"own.toml\"\nsubstrate = { material = \"mine\" }\nunits = { pressure = \"GPa\" }";
        let entry = |keys: &str| format!("[[material]]\nname = \"mine\"\n{keys}");
        for (file, words) in [
            (
                entry("young = \"a\"\npoisson = 0.3\n"),
                &["own.toml:3:9", "`material[0].young` must be a finite number greater than 0", "the text \"a\""][..],
            ),
            (entry("young = 0\npoisson = 0.3\n"), &["own.toml:3:9", "not 0"]),
            (entry("young = 1\npoisson = 0.6\n"), &["own.toml:4:11", "between 0 and 0.5", "not 0.6"]),
            (entry("young = 1\npoisson = { value = 0.6 }\n"), &["`material[0].poisson.value`", "between 0 and 0.5"]),
            (entry("young = 1\n"), &["`material[0].poisson` is missing"]),
            (entry("young = 1\npoison = 0.3\n"), &["own.toml:4:1", "did you mean `poisson`?"]),
            (
                entry("poisson = 0.3\n[material.young]\nvalue = 3\nrange = [1, 2]\n"),
                &["own.toml:6:9", "`material[0].young.range` must be [lowest, highest] around the value 3"],
            ),
            (entry("young = { value = 1, certainty = \"sure\" }\npoisson = 0.3\n"), &["\"sourced\" or \"assumed\""]),
            ([OWN, OWN].concat(), &["`material[2].name`", "no other material", "\"mine\""]),
            (
                format!("{OWN}{}aliases = [\"TiN\"]", entry("young = 1\npoisson = 0.3\n").replace("mine", "theirs")),
                &["`material[2].aliases`", "no other material"],
            ),
            ("[[materials]]\n".to_owned(), &["own.toml:1:3", "did you mean `material`?"]),
            (String::new(), &["`material` is missing"]),
            ("young = \n".to_owned(), &["own.toml:1", "not valid TOML"]),
        ] {
            let told = read(lines, &file, &[]).unwrap_err().to_string();
            for words in words {
                assert!(told.contains(words), "{words} does not stand in\n{told}");
            }
        }
    }

    #[test]
    fn a_material_has_other_names_and_keeps_the_one_that_is_typed() {
        for (name, young) in [("52100", 207.0), ("SUJ2", 207.0), ("440C", 205.0), ("HSS", 207.0), ("ta-C", 493.0)] {
            let lines = format!("substrate = {{ material = \"{name}\" }}\nunits = {{ pressure = \"GPa\" }}");
            let substrate = valid(&lines, "", &[]).substrate;
            assert_eq!((substrate.young, substrate.name.as_deref()), (Some(young), Some(name)));
        }
        let file = "[[material]]\nname = \"mine\"\naliases = [\"52100\", \"theirs\"]\nyoung = 3\npoisson = 0.3\n";
        let of = |name: &str| {
            let lines = format!(
                "materials = \"own.toml\"\nsubstrate = {{ material = \"{name}\" }}\nunits = {{ pressure = \"GPa\" }}"
            );
            valid(&lines, file, &[]).substrate.young
        };
        assert_eq!((of("theirs"), of("52100"), of("SUJ2")), (Some(3.0), Some(3.0), Some(207.0)));
    }

    #[test]
    fn an_unknown_material_is_told_the_nearest_of_file_and_library_and_how_a_file_has_one() {
        let units = "units = { pressure = \"GPa\" }";
        let has_entry = |told: &str, name: &str| {
            ["[[material]]\n", &format!("name = \"{name}\"\n"), "young = 210.0"].iter().all(|line| told.contains(line))
        };
        for (name, words) in [
            ("Mine", "did you mean \"mine\"?"),
            ("tin", "did you mean \"TiN\"?"),
            ("DLC", "did you mean \"DLC a-C:H\", \"DLC ta-C\" or \"DLC WC/a-C:H\"?"),
            ("Suj2", "did you mean \"SUJ2\"?"),
            ("xyz", "`percoat materials`"),
        ] {
            let lines = format!("substrate = {{ material = \"{name}\" }}\n{units}");
            let told = read(&format!("materials = \"own.toml\"\n{lines}"), OWN, &[]).unwrap_err().to_string();
            for words in ["case.toml:2:", words, "dd it to own.toml:"] {
                assert!(told.contains(words) && has_entry(&told, name), "{words} does not stand in\n{told}");
            }
            let told = read(&lines, "", &[]).unwrap_err().to_string();
            assert_ne!(told.contains("did you mean"), has_entry(&told, name), "{told}");
        }
        let told = read(
            "materials = \"absent.toml\"\nsubstrate = { material = \"a\" }\nunits = { pressure = \"GPa\" }",
            "",
            &[],
        );
        let told = told.unwrap_err().to_string();
        assert!(told.contains("absent.toml") && has_entry(&told, "shop steel"), "{told}");
    }
}
