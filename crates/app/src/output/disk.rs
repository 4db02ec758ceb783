//! File operations in output folders. Files that are not percoat's are neither read, written nor removed.
//!
//! Only regular files are opened: links are not followed, and a pipe, a socket or a device is refused before it can block
//! ([`open`]). A new file must not exist before (`create`); a finished file replaces a file or nothing, never a link or a
//! folder ([`replace`]). Only files and empty folders are removed, by their names. The parents of an output folder may be links.
//!
//! # Power cuts
//!
//! A log line or list that names a file as finished is written after that file is on the disk: its content by [`sync`], its
//! name by [`sync_folder`]. A file system that does not support the latter is not an error.

use super::system;
pub(crate) use super::system::{
    create_dir as create_folder, create_new as create, hard_link as link, remove_dir as remove_folder,
};
use percoat_common::plain;
use std::fs::{self, File, Metadata, OpenOptions};
use std::io::{self, Read, Write};
use std::path::Path;

/// Metadata of a path, links not followed; `None` where nothing exists.
pub fn found(path: &Path) -> io::Result<Option<Metadata>> {
    match fs::symlink_metadata(path) {
        Ok(found) => Ok(Some(found)),
        Err(error) if [io::ErrorKind::NotFound, io::ErrorKind::NotADirectory].contains(&error.kind()) => Ok(None),
        Err(error) => Err(error),
    }
}

/// Whether a path is a regular file, not a link to one.
pub fn is_file(path: &Path) -> bool {
    found(path).is_ok_and(|found| found.is_some_and(|there| there.is_file()))
}

/// Whether a path is a folder, not a link to one.
pub fn is_folder(path: &Path) -> bool {
    found(path).is_ok_and(|found| found.is_some_and(|there| there.is_dir()))
}

/// The kind of a path, in words.
pub fn kind(there: &Metadata) -> &'static str {
    match there.file_type() {
        kind if kind.is_symlink() => "a link",
        kind if kind.is_dir() => "a folder",
        kind if kind.is_file() => "a file",
        _ => "a pipe, a socket or a device",
    }
}

/// Opens a regular file to read it.
///
/// # Errors
/// Errors of the system, and a path that is not a regular file.
pub fn open(path: &Path) -> io::Result<File> {
    open_as(path, OpenOptions::new().read(true))
}

/// The bytes of a file.
///
/// # Errors
/// Errors of [`open`].
pub fn read(path: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    open(path)?.read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// The text of a file.
///
/// # Errors
/// Errors of [`open`], and bytes that are not UTF-8.
pub fn read_text(path: &Path) -> io::Result<String> {
    let mut text = String::new();
    open(path)?.read_to_string(&mut text)?;
    Ok(text)
}

/// Opens an existing file for writing; its content stays.
///
/// # Errors
/// Errors of [`open`].
pub fn open_to_change(path: &Path) -> io::Result<File> {
    open_as(path, OpenOptions::new().read(true).write(true))
}

/// Opens a file that percoat has just written, to [append] to it.
///
/// # Errors
/// Errors of [`open`].
pub fn open_to_append(path: &Path) -> io::Result<File> {
    open_as(path, OpenOptions::new().append(true))
}

/// Appends bytes to a file and syncs them to the disk.
///
/// # Errors
/// Errors of the system.
pub fn append(file: &mut File, bytes: &[u8]) -> io::Result<()> {
    file.write_all(bytes)?;
    sync(file)
}

/// Syncs the content of a file to the disk.
///
/// # Errors
/// Errors of the system.
pub fn sync(file: &File) -> io::Result<()> {
    unless_refused(system::sync(file))
}

/// Syncs the names in a folder to the disk: files created, moved and removed there.
///
/// # Errors
/// Errors of the system.
pub fn sync_folder(folder: &Path) -> io::Result<()> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    match system::sync_folder(folder) {
        // A folder that may be written and not listed cannot be opened.
        Err(error) if error.kind() == io::ErrorKind::PermissionDenied => Ok(()),
        synced => unless_refused(synced),
    }
}

/// Success where the file system does not support syncing.
fn unless_refused(synced: io::Result<()>) -> io::Result<()> {
    match synced {
        Err(error) if [io::ErrorKind::Unsupported, io::ErrorKind::InvalidInput].contains(&error.kind()) => Ok(()),
        synced => synced,
    }
}

/// Moves a file to a path where a file stands or nothing.
///
/// # Errors
/// Errors of the system, and anything but a regular file at `to`.
pub fn replace(from: &Path, to: &Path) -> io::Result<()> {
    if let Some(there) = found(to)?.filter(|there| !there.is_file()) {
        return Err(not_a_file(&there));
    }
    system::rename(from, to)
}

/// Moves a file or a folder to a free path.
///
/// # Errors
/// Errors of the system, and anything at `to`.
pub fn move_to(from: &Path, to: &Path) -> io::Result<()> {
    if found(to)?.is_some() {
        return Err(io::ErrorKind::AlreadyExists.into());
    }
    system::rename(from, to)
}

/// Removes the name of a file.
///
/// # Errors
/// Errors of the system, and a path that is not a regular file.
pub fn remove(path: &Path) -> io::Result<()> {
    if let Some(there) = found(path)?.filter(|there| !there.is_file()) {
        return Err(not_a_file(&there));
    }
    system::remove_file(path)
}

/// Creates a folder and its parents; their names are on the disk then.
///
/// # Errors
/// Errors of the system, and anything but a folder in the way.
pub fn make_folder(path: &Path) -> io::Result<()> {
    let missing: Vec<&Path> =
        path.ancestors().take_while(|part| !part.as_os_str().is_empty() && !part.is_dir()).collect();
    for folder in missing.into_iter().rev() {
        match create_folder(folder) {
            // Another thread or process has made it.
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists && folder.is_dir() => {}
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {
                let what = format!("{} is no folder", plain::path(folder));
                return Err(io::Error::new(io::ErrorKind::NotADirectory, what));
            }
            made => made?,
        }
        folder.parent().map_or(Ok(()), sync_folder)?;
    }
    Ok(())
}

/// Whether a file has a second name (hard link).
#[cfg(unix)]
pub fn has_other_name(file: &File) -> bool {
    file.metadata().is_ok_and(|found| std::os::unix::fs::MetadataExt::nlink(&found) > 1)
}

/// Whether a file has a second name, which is known on Unix alone.
#[cfg(not(unix))]
pub fn has_other_name(_: &File) -> bool {
    false
}

fn open_as(path: &Path, options: &mut OpenOptions) -> io::Result<File> {
    // Opening a device or a pipe can have side effects.
    if let Some(there) = found(path)?.filter(|there| !there.is_file()) {
        return Err(not_a_file(&there));
    }
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::custom_flags(options, libc::O_NOFOLLOW | libc::O_NONBLOCK);
    let file = options.open(path)?;
    let opened = file.metadata()?;
    if opened.is_file() { Ok(file) } else { Err(not_a_file(&opened)) }
}

fn not_a_file(there: &Metadata) -> io::Error {
    let what = format!("it is {}, and percoat takes only a file itself there: move it away", kind(there));
    io::Error::new(io::ErrorKind::InvalidInput, what)
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(unix)]
    use std::{
        os::unix::{fs::symlink, net::UnixListener},
        path::PathBuf,
    };

    /// A link to a file, one to nothing, a folder, a socket, and a device behind a link.
    #[cfg(unix)]
    fn no_files(folder: &Path) -> Vec<PathBuf> {
        let path = |name: &str| folder.join(name);
        fs::write(path("mine.txt"), "mine").unwrap();
        symlink(path("mine.txt"), path("link")).unwrap();
        symlink(path("nothing"), path("dangling")).unwrap();
        fs::create_dir(path("folder")).unwrap();
        drop(UnixListener::bind(path("socket")).unwrap());
        symlink("/dev/zero", path("device")).unwrap();
        ["link", "dangling", "folder", "socket", "device"].map(path).to_vec()
    }

    #[cfg(unix)]
    #[test]
    fn only_a_file_itself_is_opened_replaced_and_removed() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        for path in no_files(folder.path()) {
            fs::write(&file, "file").unwrap();
            let refused = [
                open(&path).map(drop),
                read(&path).map(drop),
                read_text(&path).map(drop),
                open_to_change(&path).map(drop),
                open_to_append(&path).map(drop),
                create(&path).map(drop),
                replace(&file, &path),
                move_to(&file, &path),
                link(&file, &path),
                remove(&path),
            ];
            assert!(refused.iter().all(Result::is_err), "{}: {refused:?}", path.display());
            assert!(found(&path).unwrap().is_some_and(|there| !there.is_file()) && file.is_file());
            let error = open(&path).unwrap_err();
            assert!(error.kind() == io::ErrorKind::InvalidInput && error.to_string().contains("it is a "), "{error}");
        }
        assert_eq!(read_text(&folder.path().join("mine.txt")).unwrap(), "mine");
        assert_eq!(read(&folder.path().join("none")).unwrap_err().kind(), io::ErrorKind::NotFound);
    }

    #[test]
    fn a_folder_is_removed_only_when_it_is_empty_and_made_once() {
        let folder = tempfile::tempdir().unwrap();
        let deep = folder.path().join("a/b");
        make_folder(&deep).unwrap();
        assert!(deep.is_dir() && make_folder(&deep).is_ok() && create_folder(&deep).is_err());
        assert_eq!(remove_folder(&folder.path().join("a")).unwrap_err().kind(), io::ErrorKind::DirectoryNotEmpty);
        remove_folder(&deep).unwrap();
        fs::write(folder.path().join("mine"), "mine").unwrap();
        let refused = make_folder(&folder.path().join("mine/below")).unwrap_err().to_string();
        assert!(refused.ends_with("mine is no folder"), "{refused}");
    }
}
