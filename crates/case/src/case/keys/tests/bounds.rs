//! The reader admits and refuses the values that the table of keys admits and refuses, at every bound.

use super::super::key::Form;
use super::super::range::Range;
use super::bases::{self, Bases, all_keys};
use super::schema::accepts;
use std::ops::Bound;

/// A value, the place of its fault, and whether bounds alone show the fault.
#[derive(Debug, Clone)]
struct Probe {
    value: String,
    /// Path of the item that must be refused, below the value; empty for the value itself.
    at: String,
    admitted: bool,
    /// A schema has bounds only.
    seen_by_schema: bool,
}

fn probe(value: impl Into<String>, admitted: bool) -> Probe {
    Probe { value: value.into(), at: String::new(), admitted, seen_by_schema: true }
}

fn unseen(value: &str) -> Probe {
    Probe { seen_by_schema: false, ..probe(value, false) }
}

/// Values that no number may be, and values on either side of each bound of `range`.
fn of_number(range: Range) -> Vec<Probe> {
    let float = |x: f64| format!("{x:?}");
    let carried = |sign: &str| {
        [("1e60", true), ("1.000001e60", false), ("1e300", false)].map(|(x, is)| probe(format!("{sign}{x}"), is))
    };
    let probes = match range {
        Range::Size => [vec![probe("0", false), probe("9.9e-61", false), probe("1e-60", true)], carried("").into()],
        Range::SizeOrZero => [vec![probe("-1e-60", false), unseen("9.9e-61"), probe("0", true)], carried("").into()],
        Range::Coordinate => [carried("-").into(), carried("").into()],
        Range::Factor => {
            let small =
                vec![unseen("0"), unseen("9e-61"), unseen("-9e-61"), probe("-1e-60", true), probe("1e-60", true)];
            [small, [carried("-"), carried("")].concat()]
        }
        Range::Within(low, high) => {
            let below = match low {
                Bound::Included(x) => vec![probe(float(x), true), probe(float(x.next_down()), false)],
                Bound::Excluded(x) => vec![probe(float(x), false), probe(float(x.next_up()), true)],
                Bound::Unbounded => vec![],
            };
            let above = match high {
                Bound::Included(x) => vec![probe(float(x), true), probe(float(x.next_up()), false)],
                Bound::Excluded(x) => vec![probe(float(x), false), probe(float(x.next_down()), true)],
                Bound::Unbounded => vec![],
            };
            [below, above]
        }
    };
    [probes.concat(), vec![unseen("nan"), unseen("inf"), unseen("-inf"), probe("1979-05-27", false)]].concat()
}

/// A value that every form of its kind admits.
fn plain(form: &Form) -> String {
    match form {
        Form::Number(_) => "0.25".to_owned(),
        Form::Integer(..) => "8".to_owned(),
        Form::Tuple(_, items) => format!("[{}]", items.iter().map(plain).collect::<Vec<_>>().join(", ")),
        other => panic!("an item of the form {other:?}"),
    }
}

fn probes(form: &Form) -> Vec<Probe> {
    let list = |count: usize, item: &str| format!("[{}]", vec![item; count].join(", "));
    match form {
        Form::Number(range) => of_number(*range),
        Form::Integer(low, high) => {
            let below = probe((*low as i64 - 1).to_string(), false);
            let above = (*high < i64::MAX as usize)
                .then(|| [probe(high.to_string(), true), probe((high + 1).to_string(), false)]);
            let others = [probe(low.to_string(), true), below, probe(format!("{low}.5"), false)];
            others.into_iter().chain(above.into_iter().flatten()).collect()
        }
        Form::Boolean => vec![probe("true", true), probe("false", true), probe("1", false)],
        Form::Word(words) => {
            let known = words.iter().map(|word| probe(format!("\"{word}\""), true));
            known.chain([probe("\"otherwise\"", false), probe("3.5", false)]).collect()
        }
        Form::Text(_) => vec![probe("7.5", false), probe("{ a = 1 }", false)],
        Form::Name(_, most) => vec![
            probe(format!("\"{}\"", "µ".repeat(*most)), true),
            probe(format!("\"{}\"", "µ".repeat(most + 1)), false),
            probe("\"\"", false),
            unseen("\" m\""),
        ],
        Form::Tuple(_, items) => {
            let all: Vec<String> = items.iter().map(plain).collect();
            let mut found = vec![
                probe(format!("[{}]", all[1..].join(", ")), false),
                probe(format!("[{}, {}]", all.join(", "), all[0]), false),
            ];
            for (index, item) in items.iter().enumerate() {
                found.extend(probes(item).into_iter().map(|inner| {
                    let mut all = all.clone();
                    all[index].clone_from(&inner.value);
                    Probe { value: format!("[{}]", all.join(", ")), at: format!("[{index}]{}", inner.at), ..inner }
                }));
            }
            found
        }
        Form::List { of, count: [least, most] } => {
            let inside = probes(of).into_iter().map(|inner| Probe {
                value: format!("[{}]", vec![inner.value.clone(); (*least).max(1)].join(", ")),
                at: format!("[0]{}", inner.at),
                ..inner
            });
            let short = least.checked_sub(1).map(|count| probe(list(count, &plain(of)), false));
            inside.chain(short).chain([probe(list(most + 1, &plain(of)), false)]).collect()
        }
        Form::Table(_) => vec![],
        Form::Sections(..) => vec![probe("{}", false), probe("1", false)],
    }
}

/// Whether a value of one form may be one of another: the bounds of an integer are not those of a list, and of a table its keys are
/// checked.
fn is_of(value: &str, forms: &[Form]) -> bool {
    let is_table = value.starts_with('{') && forms.iter().any(|form| matches!(form, Form::Table(_)));
    is_table || forms.iter().flat_map(probes).any(|probe| probe.admitted && probe.value == value)
}

#[test]
fn every_bound_of_the_table_is_that_of_the_reader_and_of_the_schema() {
    let bases = Bases::new();
    let mut count = [0; 2];
    for (path, key) in all_keys() {
        // A fault of one form may be another's value.
        let all = key.forms.iter().flat_map(probes).filter(|probe| probe.admitted || !is_of(&probe.value, key.forms));
        for Probe { value, at: item, admitted, seen_by_schema } in all {
            let at = bases.each(&path).next().unwrap_or_else(|| panic!("no case has {path}"));
            let words = format!("`{}{item}` must be ", at.path());
            let error = at.set(&value).err();
            let refused = error.as_ref().is_some_and(|error| error.message().starts_with(&words));
            let shown: String = value.chars().take(60).collect();
            assert_eq!(refused, !admitted, "{path} = {shown}: {error:?}");
            if admitted || seen_by_schema {
                assert_eq!(accepts(&path, &value), admitted, "the schema of {path} = {shown}");
            }
            count[usize::from(admitted)] += 1;
        }
    }
    assert!(count.iter().all(|count| *count > 150), "{count:?}");
}

#[test]
fn every_word_means_what_is_written_again() {
    let bases = Bases::new();
    let mut unwritten = Vec::new();
    for (path, key) in all_keys() {
        for word in key.forms.iter().flat_map(|form| if let Form::Word(words) = form { *words } else { &[] }) {
            let set = |at: bases::At<'_>| at.set(&format!("\"{word}\"")).ok().map(|case| at.written(&case));
            let written = bases.each(&path).find_map(set).unwrap_or_else(|| panic!("no case has {path} = {word}"));
            match written {
                Some(written) => assert_eq!(written.as_str(), Some(*word), "{path}"),
                None => unwritten.push(format!("{path} = {word}")),
            }
        }
    }
    // A range is written as its values.
    let ranges = ["mean_pressure", "force", "penetration", "grip"];
    let expected = ranges.map(|key| format!("load.{key}")).into_iter().chain(["time.times".to_owned()]);
    let expected = expected.flat_map(|key| ["linear", "log"].map(|word| format!("{key}.spacing = {word}")));
    assert_eq!(unwritten, expected.collect::<Vec<_>>());
}
