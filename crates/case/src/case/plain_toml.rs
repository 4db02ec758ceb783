//! TOML in which invisible characters are seen.

use percoat_common::plain::is_hidden;
use serde::Serialize;
use toml::Value;

/// TOML with invisible characters escaped, which reads back equal.
pub fn toml(value: &impl Serialize) -> Result<String, toml::ser::Error> {
    let text = toml::to_string(value)?;
    if !text.contains(|c| is_hidden(c) && !matches!(c, '\n' | '\t')) {
        return Ok(text);
    }
    let mut value = Value::try_from(value)?;
    mark(&mut value);
    Ok(toml::to_string(&value)?.replace("\\u0001", "\\U"))
}

/// Puts U+0001 and eight digits in the place of every hidden character: a text with it is written with escapes, never within
/// single quotes, where there are none. Backslashes too, so that no other text is taken for that escape.
fn mark(value: &mut Value) {
    let letter = |c: char| if is_hidden(c) || c == '\\' { format!("\u{1}{:08X}", u32::from(c)) } else { c.to_string() };
    match value {
        Value::String(text) => *text = text.chars().map(letter).collect(),
        Value::Array(items) => items.iter_mut().for_each(mark),
        Value::Table(table) => table.iter_mut().for_each(|(_, value)| mark(value)),
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use percoat_common::plain::{is_hidden, lines};

    #[test]
    fn toml_and_json_read_back_what_was_replaced() {
        for text in [
            "a\u{202e}b",
            "\u{e0067}\u{7f}",
            "\u{9b} \\ \"quoted\" \u{202e}'",
            "\\ \u{2066}",
            "\\u0001\u{1}\u{202e}",
            "'''\n\"\"\"\u{200b}",
        ] {
            let table = toml::Table::from_iter([
                ("title".to_owned(), text.into()),
                ("path".to_owned(), "C:\\u0001\\'".into()),
                ("list".to_owned(), vec![text, "plain"].into()),
            ]);
            let written = super::toml(&table).unwrap();
            assert_eq!(lines(&written), written);
            assert_eq!(written.parse::<toml::Table>().unwrap(), table, "{written}");
            let json = serde_json::Value::from(text);
            let written = lines(&json.to_string()).into_owned();
            assert!(!written.contains(is_hidden), "{written}");
            assert_eq!(serde_json::from_str::<serde_json::Value>(&written).unwrap(), json, "{written}");
        }
    }
}
