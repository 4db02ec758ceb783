//! Numbers in pictures, in the style of a journal: on axes, on colour bars and in captions.
//!
//! Numbers have a true minus sign, and powers of ten as 2×10⁻⁵; tables on the terminal have 2e-5, which other programs read.

/// A number with up to five digits.
pub fn short(x: f64) -> String {
    if x == 0.0 {
        return "0".to_owned();
    }
    let scientific = format!("{x:.4e}");
    let (digits, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let trimmed = |text: &str| {
        let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { text };
        signed(text)
    };
    match exponent {
        -3..6 => trimmed(&format!("{x:.*}", usize::try_from(4 - exponent).unwrap_or(0))),
        _ => times(&trimmed(digits), exponent),
    }
}

/// Digits times a power of ten, of which a leading one is left out.
pub fn times(digits: &str, exponent: i32) -> String {
    if digits == "1" { power(exponent) } else { format!("{digits}{}", factor(exponent)) }
}

/// The factor ×10ⁿ.
pub fn factor(exponent: i32) -> String {
    format!("×{}", power(exponent))
}

/// The power 10ⁿ.
pub fn power(exponent: i32) -> String {
    let raised = |c: char| match c {
        '-' => '⁻',
        digit => ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][digit.to_digit(10).unwrap_or(0) as usize],
    };
    match exponent {
        0 => "1".to_owned(),
        1 => "10".to_owned(),
        n => format!("10{}", n.to_string().chars().map(raised).collect::<String>()),
    }
}

/// A number with a true minus sign, and no sign at zero.
pub fn signed(text: &str) -> String {
    match text.strip_prefix('-') {
        Some(rest) if rest.chars().any(|c| ('1'..='9').contains(&c)) => format!("−{rest}"),
        Some(rest) => rest.to_owned(),
        None => text.to_owned(),
    }
}

/// A direction [x, y] as whole degrees from the x axis.
pub fn degrees([x, y]: [f64; 2]) -> String {
    format!("{}°", signed(&format!("{:.0}", y.atan2(x).to_degrees())))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_printed_as_a_journal_does() {
        let texts = [0.06, 2.0, -0.055395, 2.1e11, 1e-6, 0.0, -20e-6, 123456.0].map(short);
        assert_eq!(texts, ["0.06", "2", "−0.055395", "2.1×10¹¹", "10⁻⁶", "0", "−2×10⁻⁵", "123456"]);
        assert_eq!([[1.0, -1e-9], [0.0, -2.0]].map(degrees), ["0°", "−90°"]);
    }
}
