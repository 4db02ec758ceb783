//! The arrow of modules in the core's `lib.rs` is true, and no files of a crate import each other, in a ring of any length.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Folders of the sources of every crate; the published package has `src` alone.
const CRATES: [&str; 11] = [
    "crates/fft/src",
    "crates/core/src",
    "crates/common/src",
    "crates/surfaces/src",
    "crates/case/src",
    "crates/draw/src",
    "crates/app/src",
    "src",
    "validation",
    "python/src",
    "docs/page/src",
];

/// Every source file of a folder by its module path, without its tests and comments.
fn sources(folder: &str) -> BTreeMap<String, String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let mut sources = BTreeMap::new();
    let mut folders: Vec<_> = root.is_dir().then(|| (root, String::new())).into_iter().collect();
    while let Some((folder, module)) = folders.pop() {
        for path in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
            let stem = path.file_stem().unwrap().to_string_lossy().replace('-', "_");
            let below = if module.is_empty() { stem.clone() } else { format!("{module}::{stem}") };
            if path.is_dir() {
                folders.push((path, below));
            } else if path.extension().is_some_and(|ending| ending == "rs") && below != "main" {
                let name = if ["mod", "study"].contains(&&stem[..]) { module.clone() } else { below };
                sources.insert(name, code(&path));
            }
        }
    }
    // Names that a crate hands on are no imports.
    sources.remove("lib");
    sources.remove("");
    sources
}

fn code(path: &PathBuf) -> String {
    let text = fs::read_to_string(path).unwrap();
    let text = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
    text.lines().filter(|line| !line.trim_start().starts_with("//")).map(|line| format!("{line}\n")).collect()
}

/// Module paths that a text names after `crate::` or `super::`, groups in braces one by one.
fn named(text: &str, module: &str, is_folder: bool) -> Vec<String> {
    let parent = if is_folder { module } else { module.rsplit_once("::").map_or("", |(parent, _)| parent) };
    // Not who may see a name: `pub(in crate::folder)`.
    let starts = text.match_indices("crate::").filter(|(at, _)| !text[..*at].ends_with("(in "));
    let starts = starts.map(|(at, word)| (at + word.len(), String::new()));
    let above = text.match_indices("super::").filter(|(at, _)| !text[..*at].ends_with("super::"));
    let above = above.map(|(at, word)| {
        let deeper = text[at + word.len()..].starts_with("super::");
        let up = |path: &str| path.rsplit_once("::").map_or(String::new(), |(up, _)| up.to_owned());
        let base = if is_folder { up(parent) } else { parent.to_owned() };
        if deeper { (at + 2 * word.len(), up(&base)) } else { (at + word.len(), base) }
    });
    starts.chain(above).flat_map(|(at, base)| expanded(&base, &text[at..])).collect()
}

/// The paths that a text begins with, below `base`: one, or those of a group in braces, which may hold others.
fn expanded(base: &str, text: &str) -> Vec<String> {
    let path: String = text.chars().take_while(|c| c.is_alphanumeric() || "_:".contains(*c)).collect();
    let whole = format!("{base}::{path}").trim_matches(':').to_owned();
    let Some(group) = text[path.len()..].strip_prefix('{') else { return vec![whole] };
    let (mut items, mut depth) = (vec![String::new()], 0);
    for c in group.chars() {
        match c {
            '}' if depth == 0 => break,
            ',' if depth == 0 => {
                items.push(String::new());
                continue;
            }
            '{' => depth += 1,
            '}' => depth -= 1,
            _ => {}
        }
        items.last_mut().unwrap().push(c);
    }
    items
        .iter()
        .map(|item| item.trim())
        .filter(|item| !item.is_empty())
        .flat_map(|item| expanded(&whole, item))
        .collect()
}

#[test]
fn groups_within_groups_are_named_one_by_one() {
    let text = "use crate::body::{self, minors::{Minors, deep::Deep}, Layer};\nuse super::{\n    x::Y,\n    z,\n};\n";
    let mut names = named(text, "run::accuracy", false);
    names.sort();
    let wanted =
        ["body::Layer", "body::minors::Minors", "body::minors::deep::Deep", "body::self", "run::x::Y", "run::z"];
    assert_eq!(names, wanted);
}

#[test]
fn every_module_uses_only_what_stands_to_its_left() {
    let lib = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("crates/core/src/lib.rs")).unwrap();
    let arrow = lib.split("```text").nth(1).and_then(|rest| rest.split("```").next()).expect("the arrow of modules");
    let order: Vec<&str> =
        arrow.split(|c: char| !c.is_alphanumeric() && c != '_').filter(|word| !word.is_empty()).collect();
    let place = |module: &str| order.iter().position(|name| *name == module);
    let sources = sources("crates/core/src");
    let modules: BTreeSet<String> =
        sources.keys().filter_map(|path| path.split("::").next().map(str::to_owned)).collect();
    assert_eq!(modules, order.iter().map(|name| (*name).to_owned()).collect(), "modules of the arrow");
    for (path, text) in &sources {
        let importer = path.split("::").next().and_then(place).unwrap();
        for used in named(text, path, false).iter().filter_map(|path| place(path.split("::").next()?)) {
            assert!(used <= importer, "{path} uses {}, which stands to the right of it", order[used]);
        }
    }
}

#[test]
fn no_files_import_each_other_in_a_ring() {
    for folder in CRATES {
        assert_eq!(rings(&imports(&sources(folder))), [] as [Ring; 0], "files of {folder} that import each other");
    }
    assert!(sources("src").contains_key("command"), "the program's own files are read");
}

#[test]
fn a_ring_of_any_length_is_found_once() {
    let files = [("a", "use crate::b::B;"), ("b", "use crate::c::C;"), ("c", "use crate::{a::A, d::D};")];
    let others = [("d", "use crate::e::E;"), ("e", "use super::d::D;"), ("f", "use crate::a::A;"), ("g", "")];
    let sources = files.iter().chain(&others).map(|(path, text)| ((*path).to_owned(), format!("{text}\n"))).collect();
    assert_eq!(rings(&imports(&sources)), [vec!["a", "b", "c"], vec!["d", "e"]]);
}

/// Files that reach each other by their imports, in the order of their names.
type Ring = Vec<String>;

/// The files that each file imports.
type Imports = BTreeMap<String, BTreeSet<String>>;

/// The rings of files that import each other: the strongly connected components of more than one file, each once.
fn rings(imports: &Imports) -> Vec<Ring> {
    let reached: BTreeMap<&String, BTreeSet<&String>> = imports
        .keys()
        .map(|from| {
            let (mut reached, mut left) = (BTreeSet::new(), vec![from]);
            while let Some(path) = left.pop() {
                left.extend(imports.get(path).into_iter().flatten().filter(|used| reached.insert(*used)));
            }
            (from, reached)
        })
        .collect();
    let reaches = |from: &String, to: &String| reached.get(from).is_some_and(|reached| reached.contains(to));
    let ring = |path: &String| -> Ring {
        let back = reached[path].iter().filter(|other| reaches(other, path));
        back.map(|other| (*other).clone()).collect()
    };
    let rings: BTreeSet<Ring> = reached.keys().map(|path| ring(path)).filter(|ring| !ring.is_empty()).collect();
    rings.into_iter().collect()
}

/// The files that each file imports, names that a folder hands on resolved to their own files.
fn imports(sources: &BTreeMap<String, String>) -> Imports {
    let is_folder = |path: &str| sources.keys().any(|other| other.starts_with(&format!("{path}::")));
    // Names that a folder hands on from its files: `pub use file::{Name, …}`.
    let mut homes: BTreeMap<String, String> = BTreeMap::new();
    for (folder, text) in sources.iter().filter(|(path, _)| is_folder(path)) {
        for (at, _) in text.match_indices("use ") {
            let path = &text[at + 4..at + text[at..].find(';').unwrap_or(4)];
            let (file, names) = path.split_once("::").unwrap_or((path, ""));
            let file = format!("{folder}::{file}");
            if sources.contains_key(&file) && ["pub ", "pub(crate) "].iter().any(|open| text[..at].ends_with(open)) {
                let names = names.trim_matches(['{', '}']).split(',').map(|name| format!("{folder}::{}", name.trim()));
                homes.extend(names.map(|name| (name, file.clone())));
            }
        }
    }
    // The file in which a path ends.
    let file = |path: &str| {
        let mut path = path.to_owned();
        loop {
            if let Some(home) = homes.get(&path).or_else(|| sources.get_key_value(&path).map(|(path, _)| path)) {
                return Some(home.clone());
            }
            path.truncate(path.rfind("::")?);
        }
    };
    sources
        .iter()
        .map(|(path, text)| {
            let folder = is_folder(path);
            // Names from the files of a folder in the folder's own file, beside those that it hands on.
            let lines = text
                .lines()
                .filter(|line| folder && !line.starts_with("pub use ") && !line.starts_with("pub(crate) use "));
            let words = lines.flat_map(|line| line.split(|c: char| !(c.is_alphanumeric() || "_:".contains(c))));
            let below = words.filter_map(|word| Some(format!("{path}::{}", word.split_once("::")?.0)));
            let used = named(text, path, folder).into_iter().chain(below).filter_map(|path| file(&path));
            (path.clone(), used.filter(|used| used != path).collect())
        })
        .collect()
}
