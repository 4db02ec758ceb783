//! Pictures of the page, embedded as they are in the folder: each in an image of its own, so that names within one do not
//! meet those of another, and nothing in it runs.

use super::ReportError;
use super::finished::Finished;
use super::markup::{Markup, tag, void, with};
use crate::picture::vector::base64;

/// What a picture is called, what it shows to those who do not see it, and what stands under it.
pub(super) type Named = (&'static str, &'static str, &'static str);

/// The pictures of these names that the folder has of a result; empty without any.
pub(super) fn figures(finished: &Finished, result: &str, names: &[Named]) -> Result<Markup, ReportError> {
    let figure = |&(name, alt, caption): &Named| {
        let picture = finished.picture(result, name)?;
        Ok(picture.map(|(kind, bytes)| {
            let source = format!("data:{kind};base64,{}", base64(&bytes));
            let image = void("img", &[("src", &source), ("alt", alt)]);
            let class = if is_wide(&bytes) { "wide" } else { "narrow" };
            let scrolling =
                with("div", &[("class", "scroll"), ("role", "region"), ("aria-label", alt), ("tabindex", "0")], image);
            with("figure", &[("id", name), ("class", class)], vec![scrolling, tag("figcaption", caption)])
        }))
    };
    let figures: Result<Vec<Option<Markup>>, ReportError> = names.iter().map(figure).collect();
    Ok(figures?.into_iter().flatten().collect())
}

/// Whether a picture is wider than one column, in points or in pixels at 300 to the inch.
fn is_wide(picture: &[u8]) -> bool {
    const COLUMN: f64 = 300.0;
    if let Some(width) = picture.strip_prefix(b"\x89PNG\r\n\x1a\n").and_then(|rest| rest.get(8..12)) {
        let pixels = width.iter().fold(0, |width, &byte| width << 8 | u32::from(byte));
        return f64::from(pixels) * 72.0 / 300.0 > COLUMN;
    }
    let head = String::from_utf8_lossy(&picture[..picture.len().min(1000)]).into_owned();
    let view = head.split_once("viewBox=\"").and_then(|(_, rest)| rest.split('"').next().map(str::to_owned));
    view.and_then(|view| view.split_whitespace().nth(2)?.parse::<f64>().ok()).is_some_and(|width| width > COLUMN)
}
