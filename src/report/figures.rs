//! Pictures of the page, embedded as they are in the folder: each in an image of its own, so that names within one do not
//! meet those of another, and nothing in it runs.

use super::ReportError;
use super::finished::Finished;
use super::markup::{Markup, tag, void, with};
use crate::picture::vector::base64;

/// What a picture is called, what it shows to those who do not see it, and what stands under it.
pub(super) type Named = (&'static str, &'static str, &'static str);

/// The pictures of these names that the folder has; empty without any.
pub(super) fn figures(finished: &Finished, names: &[Named]) -> Result<Markup, ReportError> {
    let figure = |&(name, alt, caption): &Named| {
        let picture = finished.picture(name)?;
        Ok(picture.map(|(kind, bytes)| {
            let source = format!("data:{kind};base64,{}", base64(&bytes));
            let image = void("img", &[("src", &source), ("alt", alt)]);
            with("figure", &[("id", name)], vec![image, tag("figcaption", caption)])
        }))
    };
    let figures: Result<Vec<Option<Markup>>, ReportError> = names.iter().map(figure).collect();
    Ok(figures?.into_iter().flatten().collect())
}
