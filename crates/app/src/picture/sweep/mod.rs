//! Results of a sweep over its settings: curves over one key, or maps over two.

mod curves;
mod first;
mod keys;
mod maps;
mod numbers;

use super::utilisations::BARS;
use crate::picture::labels::Labels;
use crate::sweep::{Foremost, Row, SweepResult};
use curves::one_in;
use keys::Keys;
use numbers::{Bound, Number, numbers};
use percoat_case::case::NamedKey;
use percoat_case::units::Units;
use percoat_draw::canvas::Canvas;
use percoat_draw::chart::{Chart, plots};
use percoat_draw::curve::Curve;

/// Quantities that a picture shows, at most.
const QUANTITIES: usize = 12;

/// The picture; `None` where no key has several numbers, or nothing came out. `keys`: the names of the keys of the rows.
pub fn sweep(title: &str, units: &Units, keys: &[NamedKey], rows: &[Row]) -> Option<Canvas> {
    let keys = Keys::of(rows, keys.iter().map(|key| units.key_of(key)).collect())?;
    let mut numbers = numbers(units, rows);
    if numbers.is_empty() {
        return None;
    }
    let failed = rows.iter().filter(|row| row.results.is_empty()).count();
    let steps = rows.iter().map(|row| row.results.len()).max().unwrap_or(0);
    let mut words = vec![title.trim_end_matches('.').to_owned(), format!("{} combinations", rows.len())];
    words.retain(|words| !words.is_empty());
    if failed > 0 {
        words.push(format!("{failed} failed"));
    }
    let all = numbers.len();
    numbers.truncate(QUANTITIES);
    let left_out = (all > QUANTITIES).then(|| format!("the first {QUANTITIES} of {all} quantities, the table has all"));
    if keys.pair.is_some() || keys.names.len() > 1 {
        words.extend((steps > 1).then(|| "the last load step of each".to_owned()));
    }
    words.extend(unknown(rows, &numbers, keys.pair.is_some()));
    words.extend(undecided(rows, &numbers, keys.pair.is_some()));
    if keys.pair.is_some() {
        words.extend(left_out);
        return keys.maps(rows, &numbers, &(words.join("; ") + "."));
    }
    let (charts, counts): (Vec<Chart>, Vec<usize>) =
        numbers.iter().map(|number| keys.chart(rows, number, units)).unzip();
    let firsts = Foremost::counted(rows.iter().filter_map(|row| row.results.last()));
    let firsts: Vec<String> = firsts.iter().map(|(first, count)| format!("{first} in {count}")).collect();
    let of_loads = rows.iter().filter_map(|row| row.results.last()).all(|result| result.step().is_some());
    let what = if of_loads { "what governs:" } else { "first comes" };
    words.extend((!firsts.is_empty()).then(|| format!("{what} {}", firsts.join(", "))));
    let curves = counts.into_iter().max().unwrap_or(0);
    if one_in(curves) > 1 {
        words.push(format!("of {curves} curves one in {} is drawn, the table has all", one_in(curves)));
    }
    words.extend(left_out);
    let has_errors = charts.iter().flat_map(|chart| &chart.curves).any(Curve::has_errors);
    let bars = if has_errors { format!(" {BARS}") } else { String::new() };
    Some(plots(&format!("{}.{bars}", words.join("; ")), &charts))
}

/// Numbers of combinations in which the errors leave something open, in words; empty where they do nowhere.
fn undecided(rows: &[Row], numbers: &[Number], is_map: bool) -> Vec<String> {
    let last = || rows.iter().filter_map(|row| row.results.last());
    let sign = if is_map { "?: " } else { "" };
    let first = last().filter(|result| !result.rivals().is_empty()).count();
    let is_open =
        |result: &&SweepResult| numbers.iter().any(|number| !number.is_limit() && number.is_undecided(result));
    let fails = last().filter(is_open).count();
    let told = |count: usize, what: &str| (count > 0).then(|| format!("{sign}{what} in {count}"));
    [told(first, "the errors leave open what comes first"), told(fails, "the errors leave open whether anything fails")]
        .into_iter()
        .flatten()
        .collect()
}

/// Legend of places without a number; empty where there are none.
fn unknown(rows: &[Row], numbers: &[Number], is_map: bool) -> Vec<String> {
    let all = || rows.iter().flat_map(|row| numbers.iter().map(move |shown| (row.results.last(), shown)));
    let value =
        |(result, shown): (Option<&SweepResult>, &Number)| shown.value(result?).filter(|value| value.is_finite());
    let has = |bound: Bound| all().any(|(result, shown)| result.and_then(|result| shown.bound(result)) == Some(bound));
    let mut words = Vec::new();
    if all().any(|pair| value(pair).is_none()) {
        let place = if is_map { "grey" } else { "a gap in a curve" };
        words.push(format!("{place}: no number, see the table"));
    }
    for (bound, sign, meaning) in [
        (Bound::Below, "<", "it is reached below the smallest load that the grid resolves"),
        (Bound::Above, ">", "it is not reached"),
        (Bound::Undecided, "?", "by its error it may be reached"),
    ] {
        words.extend((is_map && has(bound)).then(|| format!("{sign}: {meaning}")));
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sweep::examples::{self, below, never, reached, row, strained};
    use percoat_core::load::LoadQuantity;
    use percoat_core::reading::{Criterion, Utilisation};
    use percoat_draw::canvas::Mark;

    const YIELDS: Criterion = Criterion::yield_of(2);
    const CRACKS: Criterion = Criterion::cracking_of(1);
    const PARTS: Criterion = Criterion::delamination_of(1);

    /// The names of the keys of rows.
    fn named(rows: &[Row]) -> Vec<NamedKey> {
        rows[0].settings.iter().map(|(key, _)| NamedKey::new(key, |_| None)).collect()
    }

    fn keys_of(rows: &[Row]) -> Option<Keys> {
        Keys::of(rows, named(rows).iter().map(|key| Units::unknown().key_of(key)).collect())
    }

    fn picture(title: &str, rows: &[Row]) -> Option<Canvas> {
        sweep(title, &Units::unknown(), &named(rows), rows)
    }

    /// All text of a picture, in a line.
    fn words(picture: Option<Canvas>) -> String {
        let marks = picture.unwrap().marks.into_iter();
        let words = marks.filter_map(|mark| if let Mark::Text { text, .. } = mark { Some(text) } else { None });
        words.collect::<Vec<_>>().join(" ")
    }

    fn step(value: f64) -> SweepResult {
        SweepResult::Step(Box::new(examples::step(value, None, 0.5)))
    }

    #[test]
    fn one_key_has_curves_two_have_maps_and_a_text_has_none() {
        let values = [0.1, 0.2, 0.3];
        let one: Vec<Row> =
            (1..).zip(values).map(|(n, x)| row(n, &[("layers.0.thickness", x.to_string())], vec![step(x)])).collect();
        let keys = keys_of(&one).unwrap();
        assert!(keys.pair.is_none());
        assert_eq!(
            keys.chart(&one, &numbers(&Units::unknown(), &one)[0], &Units::unknown()).0.curves[0].points,
            [[0.1, 0.1], [0.2, 0.2], [0.3, 0.3]]
        );
        let pairs = values.iter().flat_map(|x| values.map(|y| [*x, y]));
        let two: Vec<Row> = (1..)
            .zip(pairs)
            .map(|(n, [x, y])| row(n, &[("a", x.to_string()), ("b", y.to_string())], vec![step(x + y)]))
            .collect();
        assert!(keys_of(&two).unwrap().pair.is_some());
        assert!(keys_of(&two[1..]).unwrap().pair.is_none(), "a pair is missing");
        let text = words(picture("A title", &two));
        assert!(text.contains("peak pressure") && text.contains("9 combinations"));
        let texts = [row(1, &[("a", "bonded".into())], vec![step(1.0)]), row(2, &[("a", "x".into())], vec![step(2.0)])];
        assert!(picture("", &texts).is_none());
    }

    #[test]
    fn axes_and_legends_have_the_words_and_units_of_keys() {
        let units = Units::unknown().named(Some("µm"), Some("GPa"));
        let set = |n: usize| {
            [("layers.0.thickness", (1 + n / 3).to_string()), ("friction.coefficient", format!("0.{}", n % 3))]
        };
        let text = |count: usize| {
            let rows: Vec<Row> = (0..count).map(|n| row(n + 1, &set(n), vec![step(n as f64)])).collect();
            words(sweep("", &units, &named(&rows), &rows)).replace('\u{a0}', " ")
        };
        // A map, and curves where a pair is missing.
        for (text, axis) in [(text(9), "coefficient of friction μ"), (text(8), "coefficient of friction μ")] {
            assert!(text.contains(axis) && text.contains("thickness of layer 1"), "{text}");
            assert!(text.contains("µm") && !text.contains("layers.0"), "{text}");
        }
        assert!(text(9).contains("thickness of layer 1 (µm)"), "{}", text(9));
        assert!(text(8).contains("= 2 µm") || text(8).contains("μ = 0.1"), "{}", text(8));
    }

    #[test]
    fn curves_have_the_errors_of_their_numbers() {
        let rows: Vec<Row> = (1..=3)
            .map(|n| {
                let step = examples::step(n as f64, Some(0.1 * n as f64), 0.5);
                row(n, &[("x", n.to_string())], vec![SweepResult::Step(Box::new(step))])
            })
            .collect();
        let (chart, _) = keys_of(&rows).unwrap().chart(&rows, &numbers(&Units::unknown(), &rows)[0], &Units::unknown());
        assert_eq!(chart.curves[0].errors, [1.0, 2.0, 3.0].map(|n| 0.1 * n));
        assert!(words(picture("", &rows)).contains("Bars and bands: estimated errors"));
    }

    #[test]
    fn curves_of_isolated_contacts_have_their_forces_and_no_panel_is_empty() {
        let steps = |x: f64| {
            // Sums of pressures are rounded.
            let rounded = |force: f64| force * (1.0 + x * 1e-14);
            [1.0, 5.0].map(|force| SweepResult::Step(Box::new(examples::isolated(rounded(force), x * force)))).to_vec()
        };
        let rows: Vec<Row> =
            (1..).zip([0.1, 0.2, 0.3]).map(|(n, x)| row(n, &[("x", x.to_string())], steps(x))).collect();
        let units = Units::unknown().named(Some("µm"), Some("GPa")).with_loads_in(LoadQuantity::Force);
        let numbers = numbers(&units, &rows);
        let names: Vec<&str> = numbers.iter().map(|number| number.quantity.text()).collect();
        assert_eq!(names, ["peak pressure p", "penetration δ", "contact area A"]);
        let (chart, _) = keys_of(&rows).unwrap().chart(&rows, &numbers[2], &units);
        let labels: Vec<String> = chart.curves.iter().map(|curve| curve.label.replace('\u{a0}', " ")).collect();
        assert_eq!(labels, ["P = 1 mN", "P = 5 mN"]);
        assert!(chart.curves[1].points.iter().all(|[_, area]| (area - 2.5).abs() < 1e-12));
    }

    #[test]
    fn what_failed_leaves_a_gap_and_others_have_curves_of_their_own() {
        let mut rows: Vec<Row> = (0..8)
            .map(|n| {
                let settings = [("x", (n / 2).to_string()), ("kind", ["soft", "hard"][n % 2].to_owned())];
                row(n + 1, &settings, vec![step(n as f64)])
            })
            .collect();
        rows[2].results.clear();
        let keys = keys_of(&rows).unwrap();
        let (chart, _) = keys.chart(&rows, &numbers(&Units::unknown(), &rows)[0], &Units::unknown());
        let labels: Vec<&str> = chart.curves.iter().map(|curve| &curve.label[..]).collect();
        assert_eq!(labels, ["kind\u{a0}=\u{a0}soft", "kind\u{a0}=\u{a0}hard"]);
        assert_eq!(chart.curves[0].points, [[0.0, 0.0], [2.0, 4.0], [3.0, 6.0]]);
    }

    #[test]
    fn maps_of_limits_say_what_comes_first_and_where_there_is_a_bound_only() {
        let limits = |place: usize| {
            let yields = 0.002 * f64::powi(2.0, place as i32);
            SweepResult::Limits(match place {
                0 => vec![never(YIELDS, 1.0), below(PARTS, 1e-4)],
                1 => vec![never(YIELDS, 1.0), never(PARTS, 1.0)],
                _ => vec![reached(YIELDS, yields, 0.01 * yields), never(PARTS, 1.0)],
            })
        };
        let rows = |limits: &dyn Fn(usize) -> SweepResult| -> Vec<Row> {
            let set = |n: usize| [("a", (n % 3).to_string()), ("b", (n / 3).to_string())];
            (0..9).map(|n| row(n + 1, &set(n), vec![limits(n)])).collect()
        };
        let said = words(picture("", &rows(&limits)));
        for text in
            ["yield of material 2 (7)", "delamination of interface 1 (1)", "nothing fails (1)", " < ", " > ", "grey:"]
        {
            assert!(said.contains(text), "no {text}: {said}");
        }
        // From 0.008 to 0.512.
        assert!(said.contains("10⁻²") && said.contains("10⁻¹"), "{said}");
        let said = words(picture("", &rows(&|n| step(1.0 + n as f64))));
        assert!(!["what comes first", " < ", " > ", "grey"].iter().any(|text| said.contains(text)), "{said}");
    }

    #[test]
    fn maps_have_a_question_mark_where_the_errors_leave_the_first_open() {
        let limit = |n: usize| {
            let load = 1.0 + n as f64;
            let error = if n.is_multiple_of(4) { 1.5 * load } else { 0.1 * load };
            SweepResult::Limits(vec![reached(YIELDS, load, 0.1 * load), reached(CRACKS, 2.0 * load, error)])
        };
        let load = |n: usize| {
            let error = (n == 4).then_some(0.7);
            strained(vec![Utilisation::new(YIELDS, 0.1 * n as f64, error, [0.0; 3])])
        };
        let told = |result: &dyn Fn(usize) -> SweepResult| {
            let set = |n: usize| [("a", (n % 3).to_string()), ("b", (n / 3).to_string())];
            let rows: Vec<Row> = (0..9).map(|n| row(n + 1, &set(n), vec![result(n)])).collect();
            let told = words(picture("", &rows));
            (told.split_whitespace().filter(|word| *word == "?").count(), told)
        };
        // In 0, 4 and 8, on the map of what comes first and on that of the first limit.
        let (marks, said) = told(&limit);
        assert!(marks == 6 && said.contains("leave open what comes first in 3"), "{marks}: {said}");
        let (marks, said) = told(&load);
        assert!(marks == 1 && said.contains("leave open whether anything fails in 1"), "{marks}: {said}");
        assert!(said.contains("what governs") && said.contains("Hatched: nothing fails."), "{said}");
        let of = |values: &[(f64, Option<f64>)]| {
            strained(values.iter().map(|(value, error)| Utilisation::new(YIELDS, *value, *error, [0.0; 3])).collect())
                .holds()
        };
        let known =
            [of(&[(0.9, Some(0.05))]), of(&[(0.5, None), (f64::INFINITY, None)]), of(&[(0.99, Some(0.05))]), of(&[])];
        assert_eq!(known, [Some(true), Some(false), None, None]);
    }

    #[test]
    fn what_is_not_drawn_is_told() {
        let rows = |kinds: usize| -> Vec<Row> {
            let pairs = (0..2).flat_map(|x| (0..kinds).map(move |kind| (x, kind)));
            let set = |(x, kind): (usize, usize)| [("x", x.to_string()), ("kind", format!("\"{kind:02}\""))];
            pairs.enumerate().map(|(n, pair)| row(n + 1, &set(pair), vec![step(pair.0 as f64); 2])).collect()
        };
        for (kinds, drawn) in [(2, 2), (7, 7), (12, 12), (13, 7), (40, 10)] {
            let rows = rows(kinds);
            let keys = keys_of(&rows).unwrap();
            let (chart, all) = keys.chart(&rows, &numbers(&Units::unknown(), &rows)[0], &Units::unknown());
            assert_eq!((chart.curves.len(), all), (drawn, kinds));
            let text = words(picture("", &rows));
            assert!(text.contains("the last load step of each"));
            assert_eq!(text.contains(&format!("of {kinds} curves one in")), drawn < kinds, "{kinds}");
        }
    }

    #[test]
    fn every_quantity_has_its_map_or_is_told() {
        let rows = |limits: usize| -> Vec<Row> {
            let result = |p: usize| {
                let criteria = (1..=limits).map(Criterion::yield_of);
                SweepResult::Limits(
                    criteria.zip(p..).map(|(criterion, load)| reached(criterion, load as f64, 0.01)).collect(),
                )
            };
            let pairs = (0..9).map(|n| (n, [("a", (n / 3).to_string()), ("b", (n % 3).to_string())]));
            pairs.map(|(n, set)| row(n + 1, &set, vec![result(n)])).collect()
        };
        let maps = |limits: usize| words(picture("", &rows(limits)));
        assert!(maps(7).contains("yield of material 7, mean pressure") && !maps(7).contains("quantities"));
        assert!(maps(20).contains("the first 12 of 21 quantities"));
    }
}
