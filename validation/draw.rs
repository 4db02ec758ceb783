//! Common parts of the figures of the studies.

use percoat_app::picture::{Chart, Curve, Figure, Style};

/// A curve of colour `colour`.
pub fn curve(
    label: impl Into<String>,
    style: Style,
    colour: usize,
    points: impl IntoIterator<Item = [f64; 2]>,
) -> Curve {
    Curve {
        label: label.into(),
        points: points.into_iter().collect(),
        errors: Vec::new(),
        style,
        colour: colour.into(),
    }
}

/// A dashed line y = c xᵖ over the range of the points and through the first of them: the expected slope on logarithmic
/// axes.
pub fn slope(label: impl Into<String>, power: f64, colour: usize, points: &[[f64; 2]]) -> Curve {
    let through = points.first().copied().unwrap_or([1.0; 2]);
    let line = points.iter().map(|&[x, _]| [x, through[1] * (x / through[0]).powf(power)]);
    curve(label, Style::Dashed, colour, line)
}

/// Charts side by side, two in a row at most.
pub fn figure(panels: Vec<Chart>, caption: &str) -> Figure {
    Figure { caption: caption.to_owned(), panels }
}

/// `count` values from `first` to `last`, equally spaced.
pub fn linear(first: f64, last: f64, count: usize) -> Vec<f64> {
    (0..count).map(|i| first + (last - first) * i as f64 / (count - 1) as f64).collect()
}

/// `count` values from `first` to `last`, equally spaced on a logarithmic scale.
pub fn logarithmic(first: f64, last: f64, count: usize) -> Vec<f64> {
    linear(first.ln(), last.ln(), count).into_iter().map(f64::exp).collect()
}
