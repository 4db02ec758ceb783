//! Overrides `KEY=VALUE` of single values of a case, as in `--set layers.0.thickness=0.3`.
//!
//! KEY is a dotted path, items of lists counted from 0; VALUE is TOML, a bare word counts as text. A value that stands in no text
//! replaces one of a case as it is ([`replace`]).

use super::error::Refusal;
use super::keys::Keys;
use super::measures;
use super::node::{Entry, Node, Table, Value};
use super::span::Span;
use super::suggestions::nearest;
use std::collections::HashSet;

/// Most parts of a path; the longest of a case has four.
const DEEPEST: usize = 16;

/// One part of a dotted path.
#[derive(Debug, Clone, PartialEq)]
struct PathStep {
    name: String,
    span: Span,
}

impl PathStep {
    fn index(&self) -> Option<usize> {
        self.name.parse().ok()
    }
}

/// Applies `KEY=VALUE`, source number `source`, to the tree of a case with these `keys`.
pub(super) fn apply(text: &str, source: usize, root: &mut Table, keys: &'static Keys) -> Result<(), Refusal> {
    let (key, value) = split(text, source)?;
    let steps = steps(key, source)?;
    let offset = key.len() + 1 + (value.len() - value.trim_start().len());
    let (key, value) = (key.trim(), value.trim());
    let span = Span::new(source, offset..offset + value.len());
    if value.is_empty() {
        let message = format!("no value is given for `{key}`");
        return Err(Refusal::new(span, message, "no value here").help(format!("write {key}=VALUE")));
    }
    let value = match Node::parse(value, source, offset) {
        Err(_) if is_bare_word(value) || measures::is_measure(value) => {
            Node { value: Value::Text(value.to_owned()), span }
        }
        parsed => parsed.map_err(|refusal| match value {
            value if is_decimal_comma(value) => refusal.help(WITH_A_POINT),
            value if is_list_of_numbers(value) => refusal
                .help(format!("a list has brackets: '{key}=[{value}]'; percoat sweep takes several values without")),
            _ => refusal,
        })?,
    };
    set_in_table(root, keys, "", &steps, value)
}

/// Sets a value that stands in no text, which is source number `source`: shown as `KEY=VALUE` where it is refused.
pub(super) fn replace(
    key: &str,
    value: &toml::Value,
    source: usize,
    root: &mut Table,
    keys: &'static Keys,
) -> Result<(), Refusal> {
    let place = Span::new(source, key.len() + 1..usize::MAX);
    set_in_table(root, keys, "", &steps(key, source)?, Node::of(value, place))
}

/// The first of some dotted keys that is there twice, also where it is spelt in two ways: `layers.0.young`, `layers[0].young`.
pub fn given_twice<'a>(keys: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let mut seen = HashSet::new();
    keys.into_iter().find(|key| !seen.insert(parts(key).collect::<Vec<_>>()))
}

/// The parts of a dotted key, the same of `layers.0.young` and `layers[0].young`.
pub fn parts(key: &str) -> impl Iterator<Item = &str> {
    key.split(['.', '[']).map(|part| part.trim().trim_end_matches(']').trim_end())
}

fn split(text: &str, source: usize) -> Result<(&str, &str), Refusal> {
    text.split_once('=').ok_or_else(|| {
        Refusal::new(Span::new(source, 0..text.len()), "an override needs a value", "no `=` here").help(WITH_BOTH)
    })
}

/// The parts of `layers.0.thickness`, also written `layers[0].thickness` as in errors.
fn steps(key: &str, source: usize) -> Result<Vec<PathStep>, Refusal> {
    if key.trim().is_empty() {
        let span = Span::new(source, 0..usize::MAX);
        return Err(Refusal::new(span, "an override needs a key", "no key before `=`").help(WITH_BOTH));
    }
    let mut at = 0;
    let steps: Vec<PathStep> = key
        .split(['.', '['])
        .map(|part| {
            let start = at + (part.len() - part.trim_start().len());
            at += part.len() + 1;
            let part = part.trim();
            let name = part.strip_suffix(']').unwrap_or(part);
            let span = Span::new(source, start..start + part.len());
            if name.is_empty() {
                return Err(Refusal::new(span, format!("`{}` has an empty part", key.trim()), "nothing here")
                    .help("write the path with single dots, for example layers.0.thickness"));
            }
            Ok(PathStep { name: name.to_owned(), span })
        })
        .collect::<Result<_, _>>()?;
    match steps.get(DEEPEST) {
        Some(step) => Err(Refusal::new(step.span, "no key of a case has so many parts", "too many parts")
            .help("write KEY=VALUE, for example layers.0.thickness=0.2")),
        None => Ok(steps),
    }
}

const WITH_BOTH: &str = "write KEY=VALUE, for example solver.tolerance=1e-10";
const WITH_A_POINT: &str = "write the number with a point: 0.5; several values are a list: [0, 5]";

/// Whether a text is numbers with commas between.
fn is_list_of_numbers(text: &str) -> bool {
    text.contains(',') && text.split(',').all(|item| item.trim().parse::<f64>().is_ok())
}

/// Whether it is two integers with a comma between them.
fn is_decimal_comma(value: &str) -> bool {
    let digits = |part: &str| !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_digit());
    value.trim_start_matches(['-', '+']).split_once(',').is_some_and(|(whole, part)| digits(whole) && digits(part))
}

/// Whether a value that is not TOML is read as text: it begins like a word or a path and has no TOML punctuation, or is a word
/// with digits at its beginning, such as 100Cr6.
fn is_bare_word(value: &str) -> bool {
    let begins = value.starts_with(|c: char| c.is_alphabetic() || "_./~\\".contains(c))
        && !value.contains(['"', '[', '{', '\n', '=']);
    begins || (value.contains(char::is_alphabetic) && value.chars().all(char::is_alphanumeric))
}

/// Sets a value inside a `table` that has these `keys`.
fn set_in_table(
    table: &mut Table,
    keys: &'static Keys,
    path: &str,
    steps: &[PathStep],
    value: Node,
) -> Result<(), Refusal> {
    // A path has at least one part; `set_in_node` passes on a path only where parts are left.
    let [step, rest @ ..] = steps else { return Ok(()) };
    let path = if path.is_empty() { step.name.clone() } else { format!("{path}.{}", step.name) };
    let next = match (rest.first(), table.get_mut(&step.name)) {
        (None, _) => value,
        (Some(_), Some(node)) => return set_in_node(node, keys.within(&step.name), &path, rest, value),
        (Some(next), None) if next.index().is_some() => {
            let message = format!("`{path}` has no item {}: the case has no `{path}`", next.name);
            let refusal = Refusal::new(next.span, message, "no such item");
            let known: Vec<&str> = keys.all.iter().map(|key| key.name).collect();
            return Err(match nearest(&step.name, &known) {
                Some((near, _)) if near != step.name => refusal.help(format!("did you mean `{near}`?")),
                _ => refusal,
            });
        }
        (Some(_), None) => {
            let mut created = Table::default();
            set_in_table(&mut created, keys.within(&step.name), &path, rest, value)?;
            Node { value: Value::Table(created), span: step.span }
        }
    };
    // A switch that is off stands beside the keys that it excludes.
    if !matches!(next.value, Value::Boolean(false)) {
        keys.replaced(&step.name).into_iter().for_each(|other| table.remove(other));
    }
    table.insert(Entry { key: step.name.clone(), key_span: step.span, node: next });
    Ok(())
}

/// Sets a value inside a table with these `keys`, or inside one of a list of such tables.
fn set_in_node(
    node: &mut Node,
    keys: &'static Keys,
    path: &str,
    steps: &[PathStep],
    value: Node,
) -> Result<(), Refusal> {
    let Some((step, rest)) = steps.split_first() else {
        *node = value;
        return Ok(());
    };
    match &mut node.value {
        Value::Table(table) => set_in_table(table, keys, path, steps, value),
        Value::List(items) => {
            let count = items.len();
            let allowed = match count {
                0 => "the list is empty".to_owned(),
                1 => "its only item is 0".to_owned(),
                _ => format!("its items are 0 to {}", count - 1),
            };
            match step.index().map(|index| (index, items.get_mut(index))) {
                Some((index, Some(item))) => set_in_node(item, keys, &format!("{path}[{index}]"), rest, value),
                Some((index, None)) => {
                    let message = format!("`{path}` has no item {index}: {allowed}");
                    Err(Refusal::new(step.span, message, "no such item").help("items are counted from 0"))
                }
                None => {
                    let message = format!("`{path}` is a list: {allowed}");
                    let label = format!("a number is needed here, not `{}`", step.name);
                    let rest: String = steps.iter().map(|step| format!(".{}", step.name)).collect();
                    Err(Refusal::new(step.span, message, label).help(format!("for example {path}.0{rest}")))
                }
            }
        }
        other => {
            let message = format!("`{path}` is {}: it holds no `{}`", other.describe(), step.name);
            Err(Refusal::new(step.span, message, "no such key")
                .help(format!("set it as a whole: {path}={{ {} = … }}", step.name)))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::model::CASE;
    use super::*;

    fn set(case: &str, text: &str) -> Result<Table, Refusal> {
        let mut root = Table::parse(case)?;
        apply(text, 1, &mut root, &CASE)?;
        Ok(root)
    }

    fn value<'a>(root: &'a Table, path: &[&str]) -> Option<&'a Value> {
        let mut value = &root.get(path[0])?.node.value;
        for step in &path[1..] {
            value = match value {
                Value::Table(table) => &table.get(step)?.node.value,
                Value::List(items) => &items[step.parse::<usize>().unwrap()].value,
                _ => return None,
            };
        }
        Some(value)
    }

    #[test]
    fn slips_are_told_what_to_write() {
        let says = |text: &str, words: &str| format!("{:?}", set("", text).unwrap_err()).contains(words);
        assert!(says("layer.0.thickness=1", "did you mean `layers`?"));
        assert!(!says("layers.0.thickness=1", "did you mean"));
        assert!(says("substrate.poisson=0,3", "with a point") && says("substrate.poisson=-10,25", "with a point"));
        assert!(!says("substrate.poisson=0.3,", "with a point"));
    }

    #[test]
    fn a_value_is_replaced_or_added() {
        let case = "[[layers]]\nthickness = 1.0\n[[layers]]\nthickness = 2.0\n";
        let root = set(case, "layers.1.thickness = 3.5").unwrap();
        assert_eq!(value(&root, &["layers", "1", "thickness"]), Some(&Value::Float(3.5)));
        let root = set(case, "layers[0].poisson=0.2").unwrap();
        assert_eq!(value(&root, &["layers", "0", "poisson"]), Some(&Value::Float(0.2)));
        let root = set(case, "grid.points=[64, 32]").unwrap();
        assert_eq!(value(&root, &["grid", "points", "1"]), Some(&Value::Integer(32)));
    }

    #[test]
    fn a_key_is_there_twice_whatever_its_spelling() {
        assert_eq!(given_twice(["layers.0.young", "layers.1.young", "layers. 0 .poisson"]), None);
        for other in ["layers.0.young", "layers[0].young", " layers.0 .young "] {
            assert_eq!(given_twice(["title", "layers.0.young", other]), Some(other));
        }
    }

    #[test]
    fn a_bare_word_may_begin_with_digits() {
        let root = set("", "substrate.material=100Cr6").unwrap();
        assert_eq!(value(&root, &["substrate", "material"]), Some(&Value::Text("100Cr6".to_owned())));
        // The unit is refused where its key is known.
        let root = set("", "substrate.young=1 a").unwrap();
        assert_eq!(value(&root, &["substrate", "young"]), Some(&Value::Text("1 a".to_owned())));
        assert!(set("", "substrate.young=1 2").is_err());
    }

    #[test]
    fn a_bare_word_is_text_and_the_rest_is_toml() {
        for (text, expected) in [
            ("solver.method=polonsky-keer", "polonsky-keer"),
            ("surface.heights=../data/a b.npy", "../data/a b.npy"),
            ("title=\"a = b\"", "a = b"),
        ] {
            let root = set("", text).unwrap();
            let path: Vec<&str> = text.split_once('=').unwrap().0.split('.').collect();
            assert_eq!(value(&root, &path), Some(&Value::Text(expected.to_owned())));
        }
        assert_eq!(value(&set("", "a=true").unwrap(), &["a"]), Some(&Value::Boolean(true)));
        for text in ["=1", "a=", "a..b=1"] {
            assert!(set("", text).is_err(), "{text}");
        }
    }

    #[test]
    fn one_of_an_exclusive_pair_drives_out_the_other() {
        let root = set("[load]\nmean_pressure = 1\n", "load.penetration=0.1").unwrap();
        assert_eq!(value(&root, &["load", "mean_pressure"]), None);
        let root = set("[[layers]]\nshear_ratio = 1\n", "layers.0.young=2").unwrap();
        assert_eq!(value(&root, &["layers", "0", "shear_ratio"]), None);
        let root = set("[grid]\naccuracy = 0.1\n", "grid.points=64").unwrap();
        assert_eq!(value(&root, &["grid", "accuracy"]), None);
        let root = set("[[levels]]\ncoefficient = 1\nexponent = 3\nheight = 1\n", "levels.0.slope=0.1").unwrap();
        assert_eq!(value(&root, &["levels", "0", "exponent"]), None);
        assert_eq!(value(&root, &["levels", "0", "height"]), Some(&Value::Integer(1)));
    }

    #[test]
    fn a_material_drives_out_the_numbers_of_the_one_before() {
        let layer = "[[layers]]\nthickness = 1\nname = \"a\"\nshear_ratio = 1\npoisson = 0.3\nyield_strength = 1\n";
        let root = set(layer, "layers.0.material=TiN").unwrap();
        for key in ["name", "shear_ratio", "poisson", "yield_strength"] {
            assert_eq!(value(&root, &["layers", "0", key]), None, "{key}");
        }
        assert_eq!(value(&root, &["layers", "0", "thickness"]), Some(&Value::Integer(1)));
    }

    /// Faults are reported, not repaired.
    #[test]
    fn keys_that_exclude_each_other_elsewhere_stay() {
        let root = set("[substrate]\nshear_ratio = 1\n", "substrate.young=2").unwrap();
        assert_eq!(value(&root, &["substrate", "shear_ratio"]), Some(&Value::Integer(1)));
        let root = set("[localized]\nslope = 1\n", "localized.radius=area-balanced").unwrap();
        assert_eq!(value(&root, &["localized", "slope"]), Some(&Value::Integer(1)));
        let root = set("[stress]\naccuracy = 1\n", "stress.volume.points=8").unwrap();
        assert_eq!(value(&root, &["stress", "accuracy"]), Some(&Value::Integer(1)));
    }

    #[test]
    fn a_path_of_any_length_is_refused_without_descending_it() {
        let deep = "a.".repeat(200_000) + "a=1";
        assert!(set("", &deep).is_err());
    }
}
