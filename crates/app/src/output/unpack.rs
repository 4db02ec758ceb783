//! Unpacking of an archive into the entries of its steps.
//!
//! A run that is killed between gathering and publishing leaves only the archive. A run that resumes it needs the entries of the
//! steps before the last, whose checksums are in the log.

use super::layout::{self, partial};
use super::npy::{header, shape};
use super::{disk, make_folder, write_file};
use std::collections::BTreeMap;
use std::io::{self, BufReader, Read};
use std::path::Path;
use zip::ZipArchive;

/// Step of an entry, and its part where it has several.
type Index = (usize, Option<usize>);

/// Writes the entries of these names (`<archive>.partial/<array>.NNNN.npy`) from the archive, which stays; names of other
/// archives are skipped.
///
/// # Errors
/// When the archive cannot be read, or has no such entries.
pub(super) fn unpack<'a>(folder: &Path, archive: &str, names: impl Iterator<Item = &'a str>) -> io::Result<()> {
    let mut arrays: BTreeMap<&str, BTreeMap<Index, &str>> = BTreeMap::new();
    for name in names {
        let entry = name.strip_prefix(archive).and_then(|rest| rest.strip_prefix(".partial/"));
        if let Some((array, index)) = entry.and_then(index_of) {
            arrays.entry(array).or_default().insert(index, name);
        }
    }
    let mut zip = ZipArchive::new(BufReader::new(disk::open(&folder.join(layout::archive(archive)))?))?;
    make_folder(&folder.join(partial(archive))).map_err(io::Error::other)?;
    for (array, entries) in arrays {
        let mut values = zip.by_name(&format!("{array}.npy"))?;
        let whole = shape(&mut values)?;
        let in_parts = entries.keys().any(|(_, part)| part.is_some());
        let Some(shape) = whole.get(if in_parts { 2 } else { 1 }..) else {
            return Err(io::Error::new(io::ErrorKind::InvalidData, format!("`{array}` is not an array of steps")));
        };
        for name in entries.values() {
            let length = shape.iter().try_fold(size_of::<f64>() as u64, |bytes, &n| bytes.checked_mul(n as u64));
            let mut entry = (&mut values).take(length.unwrap_or(u64::MAX));
            let copied = write_file(&folder.join(name), |writer| {
                header::<f64>(&mut *writer, shape)?;
                io::copy(&mut entry, writer).map(|_| ())
            });
            copied.map_err(io::Error::other)?;
        }
    }
    Ok(())
}

/// Array and index of an entry by the name of its file.
fn index_of(file: &str) -> Option<(&str, Index)> {
    let mut parts = file.strip_suffix(".npy")?.split('.');
    let (array, step) = (parts.next()?, parts.next()?.parse().ok()?);
    let part = parts.next().map(|part| part.parse().ok());
    let whole = parts.next().is_none();
    match part {
        Some(None) => None,
        part => whole.then_some((array, (step, part.flatten()))),
    }
}

#[cfg(test)]
mod tests {
    use super::super::Files;
    use super::super::staging::create;
    use super::super::step_arrays::StepArrays;
    use super::*;

    #[test]
    fn an_archive_gives_the_entries_of_its_steps_again_byte_for_byte() {
        let place = tempfile::tempdir().unwrap();
        let folder = place.path().join("unfinished");
        create(&folder, &[]).unwrap();
        let mut arrays = StepArrays::new(&folder, "contact", 0).unwrap();
        let mut files = Files::default();
        for step in 0..3 {
            arrays.next_step();
            let value = |k: usize| f64::from(step) + k as f64 / 7.0;
            arrays.add("a", &[2, 2], (0..4).map(value)).unwrap();
            arrays.add("load", &[], [value(9)]).unwrap();
            for part in 1..=2 {
                let mut entry = arrays.begin("b", part, &[3]).unwrap();
                entry.add(&[value(part), value(2 * part), -1.0]).unwrap();
                arrays.end(entry).unwrap();
            }
            files.append(arrays.left());
        }
        arrays.finish(|_| Ok(())).unwrap();
        assert!(files.damaged(&folder).is_some());
        unpack(&folder, "contact", files.names()).unwrap();
        assert_eq!(files.damaged(&folder), None);
        let others = ["contact.partial/c.0001.npy", "contact.partial/a.x.npy", "other.partial/a.0001.npy"];
        assert!(unpack(&folder, "contact", others.into_iter()).is_err(), "there is no array c");
    }
}
