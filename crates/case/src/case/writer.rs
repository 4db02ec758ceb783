//! A case as TOML, its numbers as a person would write them.

use serde::Serialize;

/// A case as TOML: one that was read, or the record of one in a result.
pub fn written(case: &impl Serialize) -> Result<String, toml::ser::Error> {
    let text = super::plain_toml::toml(case)?;
    Ok(text.lines().fold(String::new(), |text, line| text + &readable(line) + "\n"))
}

/// A line `key = value` with short numbers: 2e-7 for 0.0000002.
fn readable(line: &str) -> String {
    let Some((key, value)) = line.split_once(" = ").filter(|(_, value)| !value.starts_with(['"', '\''])) else {
        return line.to_owned();
    };
    let numbers = value.split_inclusive(['[', ']', ',']).map(|part| {
        let number = part.trim_end_matches(['[', ']', ',']).trim_start();
        match number.parse::<f64>() {
            Ok(x) if number.contains('.') && x != 0.0 && !(1e-3..1e6).contains(&x.abs()) => {
                part.replace(number, &format!("{x:e}"))
            }
            _ => part.to_owned(),
        }
    });
    format!("{key} = {}", numbers.collect::<String>())
}
