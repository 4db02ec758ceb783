//! Heights as text in the `main.xml` of an X3P file: `<DataList><Datum>1.5e-6</Datum><Datum/>…</DataList>`.
//!
//! One number a datum, x fastest, an empty one without a measurement. The list is cut out of `main.xml` before that is parsed as XML, whose
//! time rises steeply with what a hostile file may hold, and read by itself, in one pass.

use super::binary::{broken, ended};
use super::fault::{Fault, fits};

const LIST: &str = "DataList";
/// Most bytes between `<` and the name of an element: the prefix of its namespace.
const PREFIX: usize = 64;
/// Fewest bytes of a datum: `<Datum/>`.
const SHORTEST: usize = 8;

/// A `main.xml` without the content of its list of heights, and that content; `None` where it has no list, or more than `most` bytes beside it.
pub fn apart(main: &str, most: usize) -> Option<(String, &str)> {
    let is_open = |at: &usize| has_before(main, *at, "<") && main[at + LIST.len()..].trim_start().starts_with('>');
    let open = main.match_indices(LIST).map(|(at, _)| at).find(is_open)?;
    let start = open + main[open..].find('>')? + 1;
    let (close, _) = main.rmatch_indices(LIST).find(|(at, _)| has_before(main, *at, "</"))?;
    let end = main[..close].rfind("</").filter(|end| *end >= start && start + main.len() - *end <= most)?;
    Some(([&main[..start], &main[end..]].concat(), &main[start..end]))
}

/// Whether a name begins at a place, behind this mark and perhaps the prefix of a namespace.
fn has_before(main: &str, at: usize, mark: &str) -> bool {
    let before = &main.as_bytes()[at.saturating_sub(PREFIX)..at];
    let Some(tag) = before.iter().rposition(|byte| *byte == b'<') else { return false };
    let Some(prefix) = before[tag..].strip_prefix(mark.as_bytes()) else { return false };
    let is_name = |name: &[u8]| name.iter().all(|byte| byte.is_ascii_alphanumeric() || b"_-.".contains(byte));
    prefix.is_empty() || prefix.strip_suffix(b":").is_some_and(|name| !name.is_empty() && is_name(name))
}

/// The numbers of a list, of which there must be `count`; NaN where there is no measurement.
pub fn numbers(list: &str, count: usize) -> Result<Vec<f64>, Fault> {
    if list.len() < SHORTEST * count {
        return Err(ended());
    }
    fits(8 * count as u64)?;
    let mut values = Vec::with_capacity(count);
    let mut rest = list.trim_start();
    let foreign = || broken("its list of heights holds something else");
    while !rest.is_empty() {
        if let Some(comment) = rest.strip_prefix("<!--") {
            rest = comment.split_once("-->").ok_or_else(foreign)?.1.trim_start();
            continue;
        }
        let (text, after) = datum(rest).ok_or_else(foreign)?;
        if values.len() == count {
            return Err(broken("it holds more heights than its main.xml states"));
        }
        values.push(if text.is_empty() {
            f64::NAN
        } else {
            text.parse().map_err(|_| broken("one of its heights is no number"))?
        });
        rest = after.trim_start();
    }
    if values.len() < count { Err(ended()) } else { Ok(values) }
}

/// The text of the datum with which a text begins, and what follows it; `None` where it begins with something else.
fn datum(text: &str) -> Option<(&str, &str)> {
    let (tag, rest) = text.strip_prefix('<')?.split_once('>')?;
    let (name, is_empty) = tag.strip_suffix('/').map_or((tag, false), |name| (name, true));
    let name = name.trim_end();
    if name.rsplit(':').next() != Some("Datum") {
        return None;
    }
    if is_empty {
        return Some(("", rest));
    }
    let (text, rest) = rest.split_once('<')?;
    let (closing, rest) = rest.strip_prefix('/')?.split_once('>')?;
    (closing.trim_end() == name).then_some((text.trim(), rest))
}
