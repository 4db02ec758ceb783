//! What uncertain keys do to the results of a sweep: how far each result spreads, and which key matters.

use super::best::{first_limit, short_keys};
use super::combinations::column;
use super::design::Design;
use super::indices::{Estimate, Statistics};
use super::result::{LimitValue, SHOWN, SweepResult, stated};
use super::row::{Row, Status};
use crate::output::columns::Cells;
use crate::output::table::{Table, Worded};
use crate::output::{in_unit, number};
use percoat_case::units::Units;
use percoat_core::load::LoadQuantity;
use percoat_core::measured::Measured;
use percoat_core::quantity::{Kind, Named};
use percoat_core::reading::{LEVEL, READING, UTILISATION};
use percoat_core::run::{StepRecord, of_step};
use rayon::prelude::*;
use serde_json::{Value, json};
use std::collections::HashMap;

/// Results of a table, at most.
const MOST: usize = 8;
/// Total index from which on an input is named, and most inputs that are.
const MATTERS: f64 = 0.02;
const NAMED: usize = 4;

/// The uncertainty of all results of a sweep.
#[derive(Debug)]
pub struct Uncertainty {
    design: Design,
    /// Each result of each load step: the largest utilisation, quantities of the whole contact, of criteria and of levels; or limits.
    pub results: Vec<Spread>,
}

/// A result of a sweep with its spread.
#[derive(Debug)]
pub struct Spread {
    /// Name of the column, as in `sweep.csv` where that has it.
    pub column: String,
    /// Load step, from 1.
    pub step: usize,
    /// Number of the result.
    pub what: What,
    /// Values at **a** and **b** of every sample, infinite beyond what was searched, NaN where none is known.
    pub draws: Vec<f64>,
    /// Median of the errors that the grid makes in it; NaN where none is known.
    grid_error: f64,
    /// Moments, quantiles and indices.
    pub statistics: Statistics,
}

/// A number of a result of a sweep.
#[derive(Debug, Clone)]
pub enum What {
    /// A quantity of a load step or of a part of it, by its name, and whether it is among the main ones.
    Quantity(&'static Named, String, bool),
    /// A limit load in a quantity of loads, by the words for the limit.
    Limit(LoadQuantity, String),
}

/// A number of a result with its column and value.
type Found = (String, What, LimitValue);

impl What {
    /// Name in words.
    pub fn name(&self) -> String {
        match self {
            Self::Quantity(_, name, _) => name.clone(),
            Self::Limit(quantity, name) => format!("{name}, {}", quantity.name()),
        }
    }

    fn kind(&self) -> Kind {
        match self {
            Self::Quantity(named, ..) => named.kind,
            Self::Limit(quantity, _) => READING.load(*quantity).named.kind,
        }
    }
}

impl Spread {
    /// Whether a main result that spreads, or of which not all draws are known.
    fn is_shown(&self) -> bool {
        let is_main = matches!(self.what, What::Limit(..) | What::Quantity(_, _, true));
        let is_known = self.draws.iter().all(|value| value.is_finite());
        is_main && !(is_known && self.statistics.is_constant())
    }

    /// Numbers of draws that are known, above and below what was searched, and not known.
    fn counts(&self) -> [usize; 4] {
        let count = |is: fn(&f64) -> bool| self.draws.iter().filter(|value| is(value)).count();
        [
            count(|x| x.is_finite()),
            count(|x| *x == f64::INFINITY),
            count(|x| *x == f64::NEG_INFINITY),
            count(|x| x.is_nan()),
        ]
    }

    /// Whether the grid errs by more than the result spreads.
    pub fn is_below_the_grid(&self) -> bool {
        self.grid_error > self.statistics.deviation.value
    }

    /// Number of draws in which a utilisation is 1 or more; `None` of other results.
    fn failing(&self) -> Option<usize> {
        let is_utilisation = self.what.kind() == Kind::Utilisation;
        is_utilisation.then(|| self.draws.iter().filter(|value| **value >= 1.0).count())
    }

    fn cells(&self, keys: &[String]) -> Cells {
        let mut cells: Cells = vec![
            ("step".to_owned(), self.step.into()),
            ("result".to_owned(), self.column.as_str().into()),
            ("name".to_owned(), self.what.name().into()),
        ];
        let counts = ["known", "above", "below", "unknown"].into_iter().zip(self.counts());
        cells.extend(counts.map(|(name, count)| (name.to_owned(), Value::from(count))));
        cells.push(("failing".to_owned(), json!(self.failing())));
        cells.push(("grid_error".to_owned(), json!(self.grid_error)));
        let mut add = |name: String, estimate: &Estimate| {
            let Estimate { value, low, high } = *estimate;
            cells.extend(
                [("", value), ("_low", low), ("_high", high)].map(|(end, x)| (format!("{name}{end}"), json!(x))),
            );
        };
        let Statistics { mean, deviation, quantiles, indices } = &self.statistics;
        add("mean".to_owned(), mean);
        add("deviation".to_owned(), deviation);
        ["q05", "median", "q95"].into_iter().zip(quantiles).for_each(|(name, quantile)| add(name.to_owned(), quantile));
        for (key, [first, total]) in keys.iter().zip(indices) {
            add(format!("first_{key}"), first);
            add(format!("total_{key}"), total);
        }
        cells
    }

    /// Cells of the table: name, median, range, how many draws are known, and the inputs by their weight.
    fn line(&self, units: &Units, keys: &[String]) -> Vec<String> {
        let Statistics { quantiles: [low, median, high], indices, .. } = &self.statistics;
        let size = [median, low, high].map(|estimate| estimate.value).into_iter().find(|x| x.is_finite());
        let unit = units.unit(self.what.kind()).prefixed(size.unwrap_or(1.0));
        let text = |estimate: &Estimate| match estimate.value {
            f64::INFINITY => "not reached".to_owned(),
            f64::NEG_INFINITY => "below all that is resolved".to_owned(),
            value if value.is_nan() => "not known".to_owned(),
            value => in_unit(&unit, Measured::new(value, Some(estimate.half()))),
        };
        let middle = if median.value.is_finite() { unit.behind(&text(median)) } else { text(median) };
        // The value alone; of a wide interval in five digits.
        let bare = |estimate: &Estimate| match text(estimate) {
            text if text.contains(" to ") => number(unit.shown(estimate.value)),
            text => text.split(" ±").next().unwrap_or_default().to_owned(),
        };
        let counts = self.counts();
        let words = ["", " above all that was searched", " below all that is resolved", " not known"];
        let counted = counts.iter().zip(words).filter(|(count, _)| **count > 0);
        let counted: Vec<String> = counted.map(|(count, word)| format!("{count}{word}")).collect();
        let mut order: Vec<usize> = (0..indices.len()).collect();
        order.sort_by(|&i, &j| indices[j][1].value.total_cmp(&indices[i][1].value));
        let index = |estimate: &Estimate| {
            in_unit(
                &units.unit(Kind::Utilisation).prefixed(1.0),
                Measured::new(estimate.value, Some(estimate.half().max(0.005))),
            )
        };
        let matters = order.iter().filter(|&&input| indices[input][1].value >= MATTERS).take(NAMED);
        let matters = matters.map(|&input| format!("{} {}", keys[input], index(&indices[input][1])));
        let mut matters = matters.collect::<Vec<_>>().join(", ");
        if indices.iter().all(|[_, total]| total.value.is_nan()) {
            matters = "too little is known".to_owned();
        } else if self.is_below_the_grid() {
            matters = format!("the grid errs by more, {}", unit.behind(&number(unit.shown(self.grid_error))));
        }
        let fails = self.failing().map_or(String::new(), |count| format!(", 1 or more in {count} draws"));
        vec![self.what.name() + &fails, middle, format!("{} to {}", bare(low), bare(high)), matters, counted.join(", ")]
    }
}

impl Uncertainty {
    /// The uncertainty of the results of the rows of a design; `None` where rows are missing.
    pub fn of(design: &Design, rows: &[Row]) -> Option<Self> {
        if rows.len() != design.count() {
            return None;
        }
        let mut gathered: Vec<Gathered> = Vec::new();
        let mut places: HashMap<(usize, String), usize> = HashMap::new();
        for row in rows.iter().filter(|row| row.status == Status::Done) {
            for (step, result) in (1..).zip(&row.results) {
                for (column, what, value) in found(result) {
                    let place = *places.entry((step, column.clone())).or_insert(gathered.len());
                    if place == gathered.len() {
                        let values = vec![f64::NAN; design.count()];
                        gathered.push(Gathered { column, step, what, values, errors: Vec::new() });
                    }
                    gathered[place].add(row.combination - 1, value);
                }
            }
        }
        gathered.sort_by_key(|gathered| gathered.step);
        let results = gathered.into_par_iter().map(|gathered| gathered.spread(design.block())).collect();
        Some(Self { design: design.clone(), results })
    }

    /// Main results of the last load step that spread, the first eight.
    pub fn shown(&self) -> impl Iterator<Item = &Spread> {
        let last = self.results.iter().map(|spread| spread.step).max();
        self.results.iter().filter(move |spread| Some(spread.step) == last && spread.is_shown()).take(MOST)
    }

    /// Names of the uncertain keys, in the shortest form that tells them apart.
    fn names(&self) -> Vec<String> {
        short_keys(&self.design.keys.iter().map(|varied| &varied.key[..]).collect::<Vec<_>>())
    }

    /// Number of the uncertain keys in words.
    pub fn keys(&self) -> String {
        let count = self.design.keys.len();
        format!("{count} uncertain key{}", if count == 1 { "" } else { "s" })
    }

    /// Rows of `uncertainty.csv`.
    pub fn cells(&self) -> Vec<Cells> {
        let keys = self.design.keys.iter().map(|varied| column(&varied.key));
        let keys: Vec<String> = keys.map(|name| name.trim_start_matches("set_").to_owned()).collect();
        self.results.iter().map(|spread| spread.cells(&keys)).collect()
    }

    /// The table of the main results; `None` where none spreads.
    pub fn table(&self, units: &Units) -> Option<Worded> {
        let keys = self.names();
        let mut lines: Vec<Vec<String>> = self.shown().map(|spread| spread.line(units, &keys)).collect();
        let draws = 2 * self.design.samples;
        let mut head = vec!["result", "median", "5 to 95 %", "what matters: total index", "of the draws"];
        if lines.iter().all(|line| line[4] == draws.to_string()) {
            head.pop();
            lines.iter_mut().for_each(|line| drop(line.pop()));
        }
        let steps = self.results.iter().map(|spread| spread.step).max().unwrap_or(0);
        let is_wide = lines.iter().flat_map(|line| [&line[1], &line[3]]).any(|cell| cell.contains(" to "));
        let words = format!(
            "uncertainty by {draws} draws of {}{}; ± is the 95 % interval of the sampling{}",
            self.keys(),
            if steps > 1 { ", last load step" } else { "" },
            if is_wide { ", a to b where it is beyond 30 %" } else { "" }
        );
        (!lines.is_empty()).then(|| Worded { words, table: Table::new(&head, lines, 5) })
    }
}

/// Values of a result that are being gathered.
struct Gathered {
    column: String,
    step: usize,
    what: What,
    /// One value a combination.
    values: Vec<f64>,
    errors: Vec<f64>,
}

impl Gathered {
    fn add(&mut self, at: usize, value: LimitValue) {
        self.values[at] = match value {
            LimitValue::At(value, error) => {
                self.errors.extend(error.filter(|error| error.is_finite()));
                value
            }
            LimitValue::Below(_) => f64::NEG_INFINITY,
            LimitValue::Above(_) => f64::INFINITY,
            LimitValue::Undecided => f64::NAN,
        };
    }

    fn spread(mut self, block: usize) -> Spread {
        self.errors.sort_unstable_by(f64::total_cmp);
        let draws = self.values.chunks(block).flat_map(|sample| [sample[0], sample[1]]).collect();
        Spread {
            statistics: Statistics::of(&self.values, block),
            column: self.column,
            step: self.step,
            what: self.what,
            draws,
            grid_error: self.errors.get(self.errors.len() / 2).copied().unwrap_or(f64::NAN),
        }
    }
}

/// The numbers of a result.
fn found(result: &SweepResult) -> Vec<Found> {
    match result {
        SweepResult::Step(step) => of_the_step(step),
        SweepResult::Limits(limits) => {
            let first = limits.first().zip(first_limit(result)).map(|(limit, value)| {
                let column = format!("first_{}", READING.load(limit.quantity).named.code);
                (column, What::Limit(limit.quantity, "first limit".to_owned()), value)
            });
            let each = limits.iter().map(|limit| {
                let criterion = limit.criterion;
                let column = format!("{}_{}", criterion.code(), READING.load(limit.quantity).named.code);
                (column.replace(' ', "_"), What::Limit(limit.quantity, criterion.to_string()), limit.into())
            });
            first.into_iter().chain(each).collect()
        }
    }
}

/// The numbers of a load step, of its levels, and the utilisations of its criteria.
fn of_the_step(step: &StepRecord) -> Vec<Found> {
    let known = |measured: Measured| LimitValue::At(measured.value, measured.error);
    let is_main = |named: &Named| SHOWN[2..].iter().any(|shown| shown.named() == named);
    let whole = of_step().into_iter().filter_map(|quantity| {
        let (named, value) = (quantity.named(), stated(quantity, step)?);
        let column = named.keys(quantity.path()).0.replace('.', "_");
        Some((column, What::Quantity(named, named.name.to_owned(), is_main(named)), known(value)))
    });
    let utilisation = &UTILISATION.value.named;
    // Under a tip one is infinite.
    let taken = || step.strength.iter().filter_map(|taken| UTILISATION.value.of(taken));
    let largest = taken().max_by(|a, b| a.value.total_cmp(&b.value)).map(|value| {
        let name = format!("largest {}", utilisation.name);
        (name.replace(' ', "_"), What::Quantity(utilisation, name, true), known(value))
    });
    let each = step.strength.iter().filter_map(|taken| {
        let name = format!("{}, {}", taken.criterion, utilisation.name);
        let column = format!("{}_{}", taken.criterion.code(), utilisation.code).replace(' ', "_");
        Some((column, What::Quantity(utilisation, name, false), known(UTILISATION.value.of(taken)?)))
    });
    let levels = (1..).zip(&step.reading.levels).flat_map(|(number, level)| {
        LEVEL.each().into_iter().filter_map(move |quantity| {
            let named = &quantity.named;
            let name = format!("{} of level {number}", named.name);
            Some((
                format!("levels_{number}_{}", named.code),
                What::Quantity(named, name, false),
                known(quantity.finite(level)?),
            ))
        })
    });
    largest.into_iter().chain(whole).chain(each).chain(levels).collect()
}

#[cfg(test)]
mod tests {
    use super::super::design::{Distribution, Varied};
    use super::super::examples::{below, never, reached, row, strained};
    use super::*;
    use percoat_core::reading::{Criterion, Utilisation};

    /// Rows of 8 samples of a strength from 1 to 2 whose limit is what `limit` makes of it.
    fn found(limit: impl Fn(f64) -> SweepResult) -> (Design, Vec<Row>) {
        let varied = Varied { key: "a.b".to_owned(), distribution: Distribution::Uniform { from: 1.0, to: 2.0 } };
        let design = Design { keys: vec![varied], samples: 8, seed: 0 };
        let rows = design.combinations().all.into_iter().map(|combination| {
            let value = combination.values[0].clone();
            row(combination.number, &[("a.b", value.clone())], vec![limit(value.parse().unwrap())])
        });
        let rows = rows.collect();
        (design, rows)
    }

    /// Name, median, range, what matters and the draws of the first line of the table, without the sampling.
    fn line(design: &Design, rows: &[Row]) -> Vec<String> {
        let told = Uncertainty::of(design, rows).unwrap().table(&Units::unknown()).unwrap();
        told.table.rows[0].iter().map(|cell| cell.split(" ±").next().unwrap().to_owned()).collect()
    }

    /// Under a tip a utilisation is infinite: four of the strengths lie above 1.75.
    #[test]
    fn infinite_utilisations_count_as_failing() {
        let yields = Criterion::yield_of(1);
        let (design, rows) = found(|strength| {
            let value = if strength > 1.75 { f64::INFINITY } else { 0.5 * strength };
            strained(vec![Utilisation::new(yields, value, None, [0.0; 3])])
        });
        let found = Uncertainty::of(&design, &rows).unwrap();
        let utilisations: Vec<&Spread> = found.results.iter().filter(|spread| spread.failing().is_some()).collect();
        assert_eq!(utilisations.len(), 2, "the largest one, and that of the criterion");
        for spread in utilisations {
            assert_eq!((spread.failing(), spread.counts()), (Some(4), [12, 4, 0, 0]), "{}", spread.column);
        }
    }

    #[test]
    fn draws_beyond_the_search_and_failed_ones_are_told() {
        let yields = Criterion::yield_of(1);
        // Each eighth of the strengths has two draws: four are above 1.75, two below 1.125.
        let (design, rows) = found(|strength| {
            SweepResult::Limits(vec![match strength {
                _ if strength > 1.75 => never(yields, 1.75),
                _ if strength < 1.125 => below(yields, 1.125),
                _ => reached(yields, strength, 0.01),
            }])
        });
        let told = line(&design, &rows);
        assert_eq!(told[0], "first limit, mean pressure");
        assert_eq!(told[2], "below all that is resolved to not reached");
        assert_eq!(told[4], "10, 4 above all that was searched, 2 below all that is resolved");
        let mut failed = rows.clone();
        (failed[0].status, failed[0].results) = (Status::Failed, Vec::new());
        assert!(line(&design, &failed)[4].ends_with("1 not known"));
        let unsolved = Row { status: Status::NotConverged, ..rows[4].clone() };
        let rows: Vec<Row> = rows.iter().map(|row| Row { combination: row.combination, ..unsolved.clone() }).collect();
        assert!(Uncertainty::of(&design, &rows).unwrap().table(&Units::unknown()).is_none(), "nothing is known");
        assert!(Uncertainty::of(&design, &rows[1..]).is_none(), "a row is missing");
    }

    #[test]
    fn a_spread_within_the_error_of_the_grid_is_told() {
        let yields = Criterion::yield_of(1);
        let (design, rows) = found(|strength| SweepResult::Limits(vec![reached(yields, strength, 0.5)]));
        assert!(line(&design, &rows)[3].starts_with("the grid errs by more, 0.5"));
        let (design, rows) = found(|strength| SweepResult::Limits(vec![reached(yields, strength, 0.05)]));
        assert!(line(&design, &rows)[3].starts_with("b "), "{:?}", line(&design, &rows));
        let (design, rows) = found(|_| SweepResult::Limits(vec![reached(yields, 1.0, 0.05)]));
        assert!(Uncertainty::of(&design, &rows).unwrap().table(&Units::unknown()).is_none(), "it is constant");
    }
}
