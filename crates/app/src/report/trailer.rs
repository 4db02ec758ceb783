//! The last line of a report, a checksum by which percoat recognises its own unchanged reports; and the beginning, by which it
//! recognises one that was being written.

use crate::output::{Trailer, disk};
use std::io;
use std::path::Path;

/// The beginning of every page, up to the version that wrote it.
pub const BEGINNING: &str = concat!(
    "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">",
    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"><meta name=\"generator\" content=\"percoat ",
);

const TRAILER: Trailer = Trailer { before: "<!-- end of a report of percoat, checksum ", after: " -->\n" };

/// The page with its last line.
pub(super) fn with_trailer(page: &str) -> String {
    TRAILER.added(page)
}

/// Whether a file is a report of percoat, unchanged since it was written.
///
/// # Errors
/// When it cannot be read.
pub fn is_own(path: &Path) -> io::Result<bool> {
    if disk::found(path)?.is_some_and(|metadata| !metadata.is_file()) {
        return Ok(false);
    }
    let bytes = disk::read(path)?;
    Ok(str::from_utf8(&bytes).is_ok_and(|text| TRAILER.removed(text).is_ok()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn a_page_is_percoats_until_a_letter_is_changed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("report.html");
        let page = with_trailer("<p>0.05 ± 0.01</p>\n");
        let is = |text: &str| {
            fs::write(&path, text).unwrap();
            is_own(&path).unwrap()
        };
        assert!(is(&page));
        assert!(!is(&page.replace("0.01", "0.02")) && !is(&format!("{page}\n")) && !is("mine") && !is(""));
        assert!(!is(&page[..page.len() - TRAILER.after.len()]));
        assert!(is_own(folder.path()).is_ok_and(|is_own| !is_own));
    }
}
