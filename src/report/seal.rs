//! The last line of a page: whoever meets the file knows by it that percoat wrote all of it and nobody has changed it since.

use crate::output::{disk, seal};
use std::io;
use std::path::Path;

const BEFORE: &str = "<!-- end of a report of percoat, checksum ";
const AFTER: &str = " -->\n";

/// The page with its seal.
pub(super) fn sealed(page: &str) -> String {
    format!("{page}{BEFORE}{}{AFTER}", seal(page))
}

/// Whether the file is a report of percoat that nobody has changed.
///
/// # Errors
/// When it cannot be read.
pub fn is_own(path: &Path) -> io::Result<bool> {
    if disk::found(path)?.is_some_and(|own| !own.is_file()) {
        return Ok(false);
    }
    let bytes = disk::read(path)?;
    let own = || {
        let text = str::from_utf8(&bytes).ok()?;
        let (page, end) = text.rsplit_once(BEFORE)?;
        Some(end.strip_suffix(AFTER)? == seal(page))
    };
    Ok(own().unwrap_or(false))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn a_page_is_percoats_until_a_letter_is_changed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("report.html");
        let page = sealed("<p>0.05 ± 0.01</p>\n");
        let is = |text: &str| {
            fs::write(&path, text).unwrap();
            is_own(&path).unwrap()
        };
        assert!(is(&page));
        assert!(!is(&page.replace("0.01", "0.02")) && !is(&format!("{page}\n")) && !is("mine") && !is(""));
        assert!(!is(&page[..page.len() - AFTER.len()]));
        assert!(is_own(folder.path()).is_ok_and(|own| !own));
    }
}
