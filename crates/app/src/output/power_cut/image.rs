//! The content of a folder in memory, for tests of kills and power cuts.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// Files with their content and folders without, by their paths.
pub(crate) type Image = BTreeMap<PathBuf, Option<Vec<u8>>>;

/// The image of a folder.
pub(super) fn read(root: &Path) -> Image {
    fn add(root: &Path, below: &Path, image: &mut Image) {
        for entry in fs::read_dir(root.join(below)).unwrap().map(Result::unwrap) {
            let path = below.join(entry.file_name());
            if entry.file_type().unwrap().is_dir() {
                add(root, &path, image);
                image.insert(path, None);
            } else {
                image.insert(path, Some(fs::read(entry.path()).unwrap()));
            }
        }
    }
    let mut image = Image::new();
    add(root, Path::new(""), &mut image);
    image
}

/// A new folder with the content of an image.
pub(super) fn laid(image: &Image) -> TempDir {
    let place = tempfile::tempdir().unwrap();
    for (path, content) in image {
        let path = place.path().join(path);
        match content {
            None => fs::create_dir_all(path).unwrap(),
            Some(content) => fs::write(path, content).unwrap(),
        }
    }
    place
}
