//! Pictures of the page, each embedded as an image, so that identifiers of one picture do not clash with those of another and
//! no script in it runs.

use super::ReportError;
use super::markup::{Markup, tag, void, with};
use super::results::Results;
use percoat_draw::base64;

/// Name of a picture's file without its ending, alternative text, caption.
pub(super) type PictureText = (&'static str, &'static str, &'static str);

/// The pictures of a result that the folder has, of those named; empty without any.
pub(super) fn figures(results: &Results, result: &str, names: &[PictureText]) -> Result<Markup, ReportError> {
    let figure = |&(name, alt, caption): &PictureText| {
        let picture = results.picture(result, name)?;
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
