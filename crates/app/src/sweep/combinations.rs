//! The combinations of a sweep: the product of axes, their pairs, or the rows of a table; and a part of them.

use super::axis::Axis;
use super::design::Design;
use percoat_case::case::{self, given_twice};
use std::collections::{BTreeMap, HashSet};
use std::iter;

/// Most combinations of a sweep.
pub(super) const MOST: usize = 1_000_000;

/// Values of the keys of a sweep for which the case is solved once.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Combination {
    /// Number of the combination in the whole sweep, from 1.
    pub number: usize,
    /// One value for each key of the sweep.
    pub values: Vec<String>,
}

/// Keys, and the combinations of their values.
#[derive(Debug, Clone, PartialEq)]
pub struct Combinations {
    /// The keys, as in the case file.
    pub keys: Vec<String>,
    /// The combinations, all of them or a [part](Self::shard).
    pub all: Vec<Combination>,
    /// The samples that the combinations are; `None` of given values.
    pub design: Option<Design>,
}

/// Why keys and values make no sweep.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum CombinationsError {
    /// No key has several values.
    #[error(
        "a sweep needs a key with several values, for example --set layers.0.thickness=0.1,0.2,0.5, or a table of them"
    )]
    Nothing,
    /// A key is given twice.
    #[error("`{0}` is given twice; give a key once, with all its values: --set {0}=V1,V2,…")]
    Twice(String),
    /// A value, or a row of values, is given twice.
    #[error("{0} is given twice, and would be solved twice: give every value, or row of values, once")]
    Repeated(String),
    /// Keys to be paired have different numbers of values.
    #[error("--zip pairs values one by one: `{first}` has {first_count} of them, `{other}` {other_count}")]
    Unequal {
        /// One key.
        first: String,
        /// Number of its values.
        first_count: usize,
        /// Another key.
        other: String,
        /// Number of its values.
        other_count: usize,
    },
    /// More than a million combinations.
    #[error("{0} combinations are more than {MOST}: sweep over fewer values")]
    TooMany(String),
    /// The table cannot be read.
    #[error("line {line}: {reason}")]
    Table {
        /// Number of the line, from 1.
        line: usize,
        /// The fault of the line.
        reason: String,
    },
}

/// Keys that change together: each row has one value for each key.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Group {
    keys: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Group {
    /// The values of one key.
    pub fn of(axis: &Axis) -> Self {
        let rows = axis.values.iter().map(|value| vec![value.clone()]).collect();
        Self { keys: vec![axis.key.clone()], rows }
    }

    /// The values of several keys, paired one by one.
    ///
    /// # Errors
    /// [`CombinationsError::Unequal`].
    pub fn zip(axes: &[Axis]) -> Result<Self, CombinationsError> {
        let count = axes.first().map_or(0, |axis| axis.values.len());
        if let Some(other) = axes.iter().find(|axis| axis.values.len() != count) {
            return Err(CombinationsError::Unequal {
                first: axes[0].key.clone(),
                first_count: count,
                other: other.key.clone(),
                other_count: other.values.len(),
            });
        }
        let row = |k: usize| axes.iter().map(|axis| axis.values[k].clone()).collect();
        Ok(Self { keys: axes.iter().map(|axis| axis.key.clone()).collect(), rows: (0..count).map(row).collect() })
    }

    /// The keys, as in the case file.
    pub fn keys(&self) -> impl Iterator<Item = &str> {
        self.keys.iter().map(String::as_str)
    }

    /// Refuses values that are there twice.
    fn rows_once(&self) -> Result<(), CombinationsError> {
        let mut seen = HashSet::with_capacity(self.rows.len());
        let mut is_new = |row: &Vec<String>| seen.insert(row.iter().map(|value| value_of(value)).collect::<Vec<_>>());
        let Some(row) = self.rows.iter().find(|row| !is_new(row)) else { return Ok(()) };
        let named = self.keys.iter().zip(row).map(|(key, value)| format!("{key} = {value}"));
        Err(CombinationsError::Repeated(named.collect::<Vec<_>>().join(", ")))
    }

    /// A table: the first line has the keys, each further line one value for each key, separated by commas or semicolons.
    /// Empty lines and those that begin with `#` are skipped. A cell in double quotes may hold the separator.
    ///
    /// # Errors
    /// [`CombinationsError::Table`] with the line, `TooMany`.
    pub fn table(text: &str) -> Result<Self, CombinationsError> {
        // Lines are counted before they are read.
        let count = text.bytes().filter(|byte| *byte == b'\n').count();
        if count > 2 * MOST {
            return Err(CombinationsError::TooMany(count.to_string()));
        }
        let mut lines = (1..).zip(text.lines()).filter(|(_, line)| {
            let line = line.trim_start_matches('\u{feff}').trim();
            !line.is_empty() && !line.starts_with('#')
        });
        let refuse = |line: usize, reason: String| CombinationsError::Table { line, reason };
        let Some((line, head)) = lines.next() else {
            return Err(refuse(
                1,
                "the first line must name the keys, for example layers.0.thickness,grid.points".into(),
            ));
        };
        let separator = if head.contains(';') { ';' } else { ',' };
        let keys = cells(head.trim_start_matches('\u{feff}'), separator);
        if keys.iter().any(String::is_empty) {
            return Err(refuse(line, "a key is empty".into()));
        }
        let rows = lines.map(|(line, text)| {
            let row = cells(text, separator);
            match row.iter().position(String::is_empty) {
                _ if row.len() != keys.len() => {
                    Err(refuse(line, format!("{} values for {} keys", row.len(), keys.len())))
                }
                Some(at) => Err(refuse(line, format!("the value of `{}` is empty", keys[at]))),
                None => Ok(row),
            }
        });
        let rows = rows.collect::<Result<_, _>>()?;
        Ok(Self { keys, rows })
    }
}

/// Refuses a key that is there twice, also where it is spelt in two ways.
///
/// # Errors
/// [`CombinationsError::Twice`].
pub fn keys_once<'a>(keys: impl IntoIterator<Item = &'a str>) -> Result<(), CombinationsError> {
    match given_twice(keys) {
        Some(key) => Err(CombinationsError::Twice(key.to_owned())),
        None => Ok(()),
    }
}

/// A value by which equal ones are found: a number whatever its spelling, or the text.
fn value_of(text: &str) -> String {
    if let Ok(whole) = text.parse::<i64>()
        && whole.unsigned_abs() > 1 << 53
    {
        return whole.to_string();
    }
    text.parse::<f64>().map_or_else(|_| text.to_owned(), |number| format!("{:e}", number + 0.0))
}

/// The cells of a line, without blanks and quotes around them; two quotes within a quoted cell are one.
fn cells(line: &str, separator: char) -> Vec<String> {
    let (mut cells, mut cell, mut quoted) = (Vec::new(), String::new(), false);
    let mut characters = line.chars().peekable();
    while let Some(c) = characters.next() {
        match c {
            '"' if quoted && characters.peek() == Some(&'"') => cell.extend(characters.next()),
            '"' if quoted || cell.trim().is_empty() => quoted = !quoted,
            _ if c == separator && !quoted => cells.push(std::mem::take(&mut cell).trim().to_owned()),
            _ => cell.push(c),
        }
    }
    cells.push(cell.trim().to_owned());
    cells
}

impl Combinations {
    /// Every row of each group with every row of the others, the last group fastest.
    ///
    /// # Errors
    /// [`CombinationsError::Nothing`] without rows, `Twice`, `Repeated`, `TooMany`.
    pub fn product(groups: &[Group]) -> Result<Self, CombinationsError> {
        let keys: Vec<String> = groups.iter().flat_map(|group| group.keys.clone()).collect();
        keys_once(keys.iter().map(String::as_str))?;
        groups.iter().try_for_each(Group::rows_once)?;
        let count = groups.iter().try_fold(1_usize, |count, group| count.checked_mul(group.rows.len()));
        match count {
            Some(0) => return Err(CombinationsError::Nothing),
            _ if keys.is_empty() => return Err(CombinationsError::Nothing),
            Some(count) if count <= MOST => {}
            Some(count) => return Err(CombinationsError::TooMany(count.to_string())),
            None => return Err(CombinationsError::TooMany("that many".to_owned())),
        }
        let mut all: Vec<Vec<String>> = vec![Vec::new()];
        for group in groups {
            let with = |row: &Vec<String>| group.rows.iter().map(|more| [&row[..], more].concat()).collect::<Vec<_>>();
            all = all.iter().flat_map(with).collect();
        }
        let all = (1..).zip(all).map(|(number, values)| Combination { number, values }).collect();
        Ok(Self { keys, all, design: None })
    }

    /// Every `of`-th combination from the `part`-th on, which is counted from 1. Neighbouring combinations, which take similar
    /// times, go to different parts.
    pub fn shard(mut self, part: usize, of: usize) -> Self {
        self.all.retain(|combination| (combination.number - 1) % of == part - 1);
        self
    }

    /// One combination of each kind, with the number of combinations of that kind; `None` for more than `most` kinds. Within a
    /// kind only numbers differ that do not change the size of the results, so no number of load steps or sublayers.
    pub(super) fn kinds(&self, most: usize) -> Option<Vec<(&Combination, usize)>> {
        let counts = |key: &str| ["steps", "sublayers"].iter().any(|word| key.trim_end().ends_with(word));
        let is_number = |value: &str| value.parse::<f64>().is_ok();
        let mut kinds: BTreeMap<Vec<&str>, (&Combination, usize)> = BTreeMap::new();
        for combination in &self.all {
            let values = self.keys.iter().zip(&combination.values);
            let kind =
                values.map(|(key, value)| if counts(key) || !is_number(value) { value.as_str() } else { "" }).collect();
            kinds.entry(kind).or_insert((combination, 0)).1 += 1;
            if kinds.len() > most {
                return None;
            }
        }
        Some(kinds.into_values().collect())
    }

    /// One combination alone, by its place among all of them, from 0; `None` beyond the last.
    pub fn alone(&self, index: usize) -> Option<Self> {
        Some(Self { all: vec![self.all.get(index)?.clone()], keys: self.keys.clone(), design: self.design.clone() })
    }

    /// The keys with their values in a combination.
    pub fn named_values(&self, combination: &Combination) -> Vec<(String, String)> {
        self.keys.iter().cloned().zip(combination.values.iter().cloned()).collect()
    }

    /// The settings of a combination, `KEY=VALUE` each.
    pub fn settings(&self, combination: &Combination) -> Vec<String> {
        self.keys.iter().zip(&combination.values).map(|(key, value)| format!("{key}={value}")).collect()
    }
}

/// The name of a key's column: `set_layers_0_thickness` for `layers.0.thickness` and `layers[0].thickness`. Lists count from 0
/// in keys and from 1 in results, where `levels_1_load` is that of the first level.
pub fn column(key: &str) -> String {
    iter::once("set").chain(case::parts(key)).collect::<Vec<_>>().join("_")
}

#[cfg(test)]
mod tests {
    use super::super::examples::product;
    use super::*;

    fn axes(texts: &[&str]) -> Vec<Axis> {
        texts.iter().map(|text| Axis::parse(text).unwrap()).collect()
    }

    fn values(all: &Combinations) -> Vec<String> {
        all.all.iter().map(|combination| format!("{}: {}", combination.number, combination.values.join(" "))).collect()
    }

    #[test]
    fn a_key_and_a_result_have_no_column_in_common() {
        assert_eq!(["levels.1.height", "levels[1].height"].map(column), ["set_levels_1_height"; 2]);
    }

    #[test]
    fn a_product_has_the_last_key_fastest_and_pairs_go_together() {
        let keys = ["a=1,2", "b.0.c=x,y"];
        let product = product(&keys);
        assert_eq!(values(&product), ["1: 1 x", "2: 1 y", "3: 2 x", "4: 2 y"]);
        assert_eq!(product.settings(&product.all[1]), ["a=1", "b.0.c=y"]);
        let pairs = Combinations::product(&[Group::zip(&axes(&keys)).unwrap()]).unwrap();
        assert_eq!(values(&pairs), ["1: 1 x", "2: 2 y"]);
    }

    #[test]
    fn a_table_is_a_group_and_its_faults_have_their_line() {
        let table = Group::table("\u{feff}# mine\na ; b.c\n\n 1; \"x;\"\"y\"\"\" \n2;[0, 1]\n").unwrap();
        let all = Combinations::product(&[table, Group::of(&Axis::parse("d=7,8").unwrap())]).unwrap();
        assert_eq!(all.keys, ["a", "b.c", "d"]);
        assert_eq!(values(&all), ["1: 1 x;\"y\" 7", "2: 1 x;\"y\" 8", "3: 2 [0, 1] 7", "4: 2 [0, 1] 8"]);
        for (text, message) in [
            ("", "line 1: the first line must name the keys"),
            ("a,b\n1\n", "line 2: 1 values for 2 keys"),
            ("# x\na,b\n1,\n", "line 3: the value of `b` is empty"),
            ("a,,b\n", "line 1: a key is empty"),
        ] {
            assert!(Group::table(text).unwrap_err().to_string().starts_with(message), "{text}");
        }
    }

    #[test]
    fn numbers_make_no_kind_of_their_own_but_counts_and_words_do() {
        let kinds = |texts: &[&str]| {
            let all = product(texts);
            all.kinds(3).map(|kinds| kinds.iter().map(|(kind, count)| (kind.number, *count)).collect::<Vec<_>>())
        };
        assert_eq!(kinds(&["a=1:2:50", "b=3:4:20"]), Some(vec![(1, 1000)]));
        assert_eq!(kinds(&["a=1:2:50", "load.mean_pressure.steps=5,7"]), Some(vec![(1, 50), (2, 50)]));
        assert_eq!(kinds(&["a=1:2:50", "load.mean_pressure=0.1,[0.1, 0.2]"]), Some(vec![(1, 50), (2, 50)]));
        assert_eq!(kinds(&["a=p,q,r,s"]), None);
    }

    #[test]
    fn parts_are_disjoint_and_make_up_the_whole() {
        let whole = product(&["a=1:7:7"]);
        let mut numbers: Vec<usize> = (1..=3)
            .flat_map(|part| whole.clone().shard(part, 3).all.into_iter().map(|combination| combination.number))
            .collect();
        assert_eq!(
            whole.clone().shard(2, 3).all.iter().map(|combination| combination.number).collect::<Vec<_>>(),
            [2, 5]
        );
        numbers.sort_unstable();
        assert_eq!(numbers, [1, 2, 3, 4, 5, 6, 7]);
    }

    #[test]
    fn what_makes_no_sweep_is_refused() {
        let product = |texts: &[&str]| {
            Combinations::product(&axes(texts).iter().map(Group::of).collect::<Vec<_>>()).unwrap_err().to_string()
        };
        assert!(product(&[]).contains("several values"));
        assert!(product(&["layers.0.a=1,2", "layers[0].a=3,4"]).contains("given twice"));
        assert!(product(&["a=1,2,1.0"]).starts_with("a = 1.0 is given twice"));
        assert!(product(&["a=x,y", "b=0.1:0.1:3"]).starts_with("b = 0.1 is given twice"));
        let table = Group::table("a,b\n1,2\n1,3\n1.0,2e0\n").unwrap();
        let repeated = Combinations::product(&[table]).unwrap_err().to_string();
        assert!(repeated.starts_with("a = 1.0, b = 2e0 is given twice"), "{repeated}");
        assert!(Combinations::product(&[Group::zip(&axes(&["a=1,1,2", "b=1,2,2"])).unwrap()]).is_ok());
        assert!(product(&["a=1:2:10000", "b=1:2:10000"]).contains("100000000 combinations"));
        let unequal = Group::zip(&axes(&["a=1,2", "b=1,2,3"])).unwrap_err().to_string();
        assert!(unequal.contains("`a` has 2 of them, `b` 3"), "{unequal}");
    }
}
