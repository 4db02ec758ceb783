//! A key with its values: `KEY=V1,V2,…`, `KEY=A:B:N` or `KEY=A:B:N:log`.

use std::fmt;

/// Most values of a key.
const MOST: usize = 100_000;

/// A key of the case with its values in their order.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Axis {
    /// The key as in the case file, such as `layers.0.thickness`.
    pub key: String,
    /// The values as texts of TOML, such as `0.2`.
    pub values: Vec<String>,
}

/// Why a text is not an axis.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "--set {text}: {reason}; write KEY=V1,V2,…, KEY=A:B:N or KEY=A:B:N:log, for example layers.0.thickness=0.1:1:5:log"
)]
pub struct AxisError {
    text: String,
    reason: String,
}

impl Axis {
    /// Reads an axis. Commas within brackets and quotes belong to a value, so that lists can be values:
    /// `load.mean_pressure=[0.01, 0.02],[0.03]`.
    ///
    /// # Errors
    /// [`AxisError`] without `=`, with an empty value, or for a range without a valid number, spacing or end.
    pub fn parse(text: &str) -> Result<Self, AxisError> {
        let refuse = |reason: &str| AxisError { text: text.to_owned(), reason: reason.to_owned() };
        let (key, values) = text.split_once('=').ok_or_else(|| refuse("a key needs values"))?;
        let key = key.trim().to_owned();
        if key.is_empty() {
            return Err(refuse("there is no key before `=`"));
        }
        let values = match range(values.trim()) {
            Some(range) => range.map_err(|reason| refuse(&reason))?,
            None => listed(values).into_iter().map(|value| value.trim().to_owned()).collect(),
        };
        if values.iter().any(String::is_empty) {
            return Err(refuse("a value is empty"));
        }
        Ok(Self { key, values })
    }

    /// The settings `KEY=VALUE`, one a value.
    pub fn settings(&self) -> impl Iterator<Item = String> {
        self.values.iter().map(|value| format!("{}={value}", self.key))
    }
}

impl fmt::Display for Axis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.values[..] {
            [first, .., last] if self.values.len() > 6 => {
                write!(f, "{} = {first} … {last} ({} values)", self.key, self.values.len())
            }
            values => write!(f, "{} = {}", self.key, values.join(", ")),
        }
    }
}

/// The values of `A:B:N` or `A:B:N:log`; `None` for any other text.
fn range(text: &str) -> Option<Result<Vec<String>, String>> {
    let parts: Vec<&str> = text.split(':').map(str::trim).collect();
    let (from, to, count, spacing) = match parts[..] {
        [from, to, count] => (from, to, count, None),
        [from, to, count, spacing] => (from, to, count, Some(spacing)),
        _ => return None,
    };
    let (Ok(from), Ok(to)) = (from.parse::<f64>(), to.parse::<f64>()) else { return None };
    let spaced = || {
        if !from.is_finite() || !to.is_finite() {
            return Err("both ends of a range must be finite".to_owned());
        }
        let count = count.parse::<usize>().ok().filter(|count| (2..=MOST).contains(count));
        let count = count.ok_or_else(|| format!("the number of values of a range must be between 2 and {MOST}"))?;
        let last = (count - 1) as f64;
        let at = |k: usize| k as f64 / last;
        let values: Vec<f64> = match spacing {
            None | Some("linear") => (0..count).map(|k| ((last - k as f64) * from + k as f64 * to) / last).collect(),
            Some("log") if from * to > 0.0 => (0..count).map(|k| from * (to / from).powf(at(k))).collect(),
            Some("log") => return Err("both ends of a geometric range must be above 0".to_owned()),
            Some(other) => return Err(format!("a range is `linear` or `log`, not `{other}`")),
        };
        let inner = |k: usize, value: f64| {
            if k == 0 {
                from
            } else if k + 1 == count {
                to
            } else {
                short(value)
            }
        };
        Ok(values.into_iter().enumerate().map(|(k, value)| plain(inner(k, value))).collect())
    };
    Some(spaced())
}

/// A number without the last digits of double precision, which are noise: 0.3 and not 0.30000000000000004.
fn short(value: f64) -> f64 {
    format!("{value:.14e}").parse().unwrap_or(value)
}

/// A number as TOML: in decimals between 1e-4 and 1e15, else with an exponent.
pub(super) fn plain(value: f64) -> String {
    let size = value.abs();
    if value != 0.0 && !(1e-4..1e15).contains(&size) { format!("{value:e}") } else { value.to_string() }
}

/// Parts between commas outside brackets and quotes.
fn listed(text: &str) -> Vec<&str> {
    let (mut parts, mut start, mut depth, mut quote) = (Vec::new(), 0, 0_usize, None);
    for (at, c) in text.char_indices() {
        match (quote, c) {
            (Some(open), _) if c == open => quote = None,
            (Some(_), _) => {}
            (None, '"' | '\'') => quote = Some(c),
            (None, '[' | '{') => depth += 1,
            (None, ']' | '}') => depth = depth.saturating_sub(1),
            (None, ',') if depth == 0 => {
                parts.push(&text[start..at]);
                start = at + 1;
            }
            (None, _) => {}
        }
    }
    parts.push(&text[start..]);
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(text: &str) -> Vec<String> {
        Axis::parse(&format!("a.b={text}")).unwrap().values
    }

    #[test]
    fn a_list_keeps_what_stands_in_brackets_and_quotes_together() {
        assert_eq!(values("0.1, 0.2"), ["0.1", "0.2"]);
        assert_eq!(values("[1, 2],[3]"), ["[1, 2]", "[3]"]);
        assert_eq!(values("\"a,b\",{ x = 1, y = 2 }"), ["\"a,b\"", "{ x = 1, y = 2 }"]);
        assert_eq!(values("bonded,frictionless"), ["bonded", "frictionless"]);
        assert_eq!(values("0.5"), ["0.5"]);
        assert_eq!(values("C:file.npy"), ["C:file.npy"], "a path is no range");
    }

    #[test]
    fn ranges_keep_both_ends_and_have_no_noise() {
        assert_eq!(values("0.1:0.5:5"), ["0.1", "0.2", "0.3", "0.4", "0.5"]);
        assert_eq!(values("64:256:4"), ["64", "128", "192", "256"]);
        assert_eq!(values("1e-3:1:4:log"), ["0.001", "0.01", "0.1", "1"]);
        assert_eq!(values("1e-8:1e-6:3:log"), ["1e-8", "1e-7", "1e-6"]);
        assert_eq!(values("1:-1:3:linear"), ["1", "0", "-1"]);
        let thirds = values("0:1:4");
        assert!(thirds[1].parse::<f64>().is_ok_and(|third| (third - 1.0 / 3.0).abs() < 1e-15), "{thirds:?}");
    }

    #[test]
    fn what_is_no_axis_is_refused_with_its_text() {
        for (text, reason) in [
            ("a", "needs values"),
            ("=1,2", "no key"),
            ("a=1,,2", "empty"),
            ("a=", "empty"),
            ("a=1:2:1", "between 2 and"),
            ("a=1:2:x", "between 2 and"),
            ("a=0:2:3:log", "above 0"),
            ("a=1:2:3:cubic", "`cubic`"),
            ("a=1:inf:3", "finite"),
        ] {
            let error = Axis::parse(text).unwrap_err().to_string();
            assert!(error.contains(reason) && error.contains(&format!("--set {text}")), "{error}");
        }
    }
}
