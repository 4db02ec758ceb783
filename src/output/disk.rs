//! The file system, as percoat uses it where results stand: what is not percoat's is neither read, written nor removed.
//!
//! Only a file itself is opened: no link in its place is followed, and a pipe, a socket or a device in its place is refused
//! before it can block ([`open`]). What is to be new is created new ([`create`]); a finished file takes the place of a file
//! or of nothing, never that of a link or a folder ([`replace`]). Nothing is removed but files and empty folders, by their
//! names. Folders that lead to an output folder are the user's, and may be links.
//!
//! # Power cuts
//!
//! Whatever names something as finished, a line of a log or a list, is written after what it names has come to the disk:
//! content by [`sync`], names by [`sync_folder`]. File systems that refuse to do the latter are trusted.

use crate::plain;
use std::fs::{self, File, Metadata, OpenOptions};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

#[cfg(test)]
use super::journal::{Change, note};

/// Metadata of what stands at a path itself, if anything does; a link is not followed.
pub(crate) fn found(path: &Path) -> io::Result<Option<Metadata>> {
    match fs::symlink_metadata(path) {
        Ok(found) => Ok(Some(found)),
        Err(error) if [io::ErrorKind::NotFound, io::ErrorKind::NotADirectory].contains(&error.kind()) => Ok(None),
        Err(error) => Err(error),
    }
}

/// Whether a file stands there itself, no link to one.
pub(crate) fn is_file(path: &Path) -> bool {
    found(path).is_ok_and(|found| found.is_some_and(|own| own.is_file()))
}

/// Whether a folder stands there itself, no link to one.
pub(crate) fn is_folder(path: &Path) -> bool {
    found(path).is_ok_and(|found| found.is_some_and(|own| own.is_dir()))
}

/// The kind of a file, in words.
pub(crate) fn kind(own: &Metadata) -> &'static str {
    match own.file_type() {
        kind if kind.is_symlink() => "a link",
        kind if kind.is_dir() => "a folder",
        kind if kind.is_file() => "a file",
        _ => "a pipe, a socket or a device",
    }
}

/// Opens a file to read it.
///
/// # Errors
/// Those of the system, and anything but a file in its place.
pub(crate) fn open(path: &Path) -> io::Result<File> {
    open_as(path, OpenOptions::new().read(true))
}

/// The bytes of a file.
///
/// # Errors
/// As those of [`open`].
pub(crate) fn read(path: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    open(path)?.read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// The text of a file.
///
/// # Errors
/// As those of [`open`], and bytes that are not UTF-8.
pub(crate) fn read_text(path: &Path) -> io::Result<String> {
    let mut text = String::new();
    open(path)?.read_to_string(&mut text)?;
    Ok(text)
}

/// A file that was not there before, to write and read it.
///
/// # Errors
/// Those of the system; [`io::ErrorKind::AlreadyExists`] where anything has its name, a link without a target too.
pub(crate) fn create(path: &Path) -> io::Result<File> {
    let file = OpenOptions::new().read(true).write(true).create_new(true).open(path)?;
    #[cfg(test)]
    note(Change::Created(path));
    Ok(file)
}

/// Opens a file that is there to write into it; what it holds stays.
///
/// # Errors
/// As those of [`open`].
pub(crate) fn open_to_change(path: &Path) -> io::Result<File> {
    open_as(path, OpenOptions::new().read(true).write(true))
}

/// A log to which lines are added.
#[derive(Debug)]
pub(crate) struct Appended {
    file: File,
    #[cfg_attr(not(test), allow(dead_code, reason = "the journal of the tests reads it"))]
    path: PathBuf,
}

impl Appended {
    /// Of a file that percoat has just written.
    ///
    /// # Errors
    /// As those of [`open`].
    pub(crate) fn open(path: &Path) -> io::Result<Self> {
        Ok(Self { file: open_as(path, OpenOptions::new().append(true))?, path: path.to_owned() })
    }

    /// Adds some bytes, which have come to the disk when this returns.
    ///
    /// # Errors
    /// Those of the system.
    pub(crate) fn add(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.file.write_all(bytes)?;
        #[cfg(test)]
        note(Change::Appended(&self.path, bytes));
        sync(&self.file, &self.path)
    }
}

/// Returns when what has been written into a file at `path` has come to the disk.
///
/// # Errors
/// Those of the system.
#[cfg_attr(not(test), allow(unused_variables, reason = "the journal of the tests reads the path"))]
pub(crate) fn sync(file: &File, path: &Path) -> io::Result<()> {
    #[cfg(test)]
    note(Change::Synced(path));
    // In unit tests the journal says what a power cut would leave.
    if cfg!(test) { Ok(()) } else { unless_refused(file.sync_data()) }
}

/// Returns when the names in a folder have come to the disk: what was made, moved and removed there.
///
/// # Errors
/// Those of the system.
pub(crate) fn sync_folder(folder: &Path) -> io::Result<()> {
    #[cfg(test)]
    note(Change::SyncedFolder(folder));
    // Elsewhere a folder cannot be opened.
    if cfg!(test) || cfg!(not(unix)) {
        return Ok(());
    }
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    match File::open(folder) {
        Ok(folder) => unless_refused(folder.sync_all()),
        // A folder that may be written and not listed cannot be opened.
        Err(error) if error.kind() == io::ErrorKind::PermissionDenied => Ok(()),
        Err(error) => Err(error),
    }
}

/// Success where a file system brings nothing to the disk on demand.
fn unless_refused(synced: io::Result<()>) -> io::Result<()> {
    match synced {
        Err(error) if [io::ErrorKind::Unsupported, io::ErrorKind::InvalidInput].contains(&error.kind()) => Ok(()),
        synced => synced,
    }
}

/// Moves a file into the place of another one, or of nothing.
///
/// # Errors
/// Those of the system, and anything but a file in that place.
pub(crate) fn replace(from: &Path, to: &Path) -> io::Result<()> {
    if let Some(own) = found(to)?.filter(|own| !own.is_file()) {
        return Err(not_a_file(&own));
    }
    fs::rename(from, to)?;
    #[cfg(test)]
    note(Change::Moved(from, to));
    Ok(())
}

/// Moves a file or a folder to where nothing stands.
///
/// # Errors
/// Those of the system, and anything in that place.
pub(crate) fn move_to(from: &Path, to: &Path) -> io::Result<()> {
    if found(to)?.is_some() {
        return Err(io::ErrorKind::AlreadyExists.into());
    }
    fs::rename(from, to)?;
    #[cfg(test)]
    note(Change::Moved(from, to));
    Ok(())
}

/// Gives a file a second name.
///
/// # Errors
/// Those of the system, also where a file cannot have two; [`io::ErrorKind::AlreadyExists`] where anything has that name.
pub(crate) fn link(file: &Path, second: &Path) -> io::Result<()> {
    #[cfg(test)]
    if super::journal::refuses_links(second) {
        return Err(io::ErrorKind::Unsupported.into());
    }
    fs::hard_link(file, second)?;
    #[cfg(test)]
    note(Change::Linked(file, second));
    Ok(())
}

/// Removes the name of a file.
///
/// # Errors
/// Those of the system, and anything but a file in its place.
pub(crate) fn remove(path: &Path) -> io::Result<()> {
    if let Some(own) = found(path)?.filter(|own| !own.is_file()) {
        return Err(not_a_file(&own));
    }
    fs::remove_file(path)?;
    #[cfg(test)]
    note(Change::Removed(path));
    Ok(())
}

/// Removes a folder in which nothing stands.
///
/// # Errors
/// Those of the system; [`io::ErrorKind::DirectoryNotEmpty`] where something does.
pub(crate) fn remove_folder(path: &Path) -> io::Result<()> {
    fs::remove_dir(path)?;
    #[cfg(test)]
    note(Change::Removed(path));
    Ok(())
}

/// A folder that was not there before.
///
/// # Errors
/// Those of the system; [`io::ErrorKind::AlreadyExists`] where anything has its name.
pub(crate) fn create_folder(path: &Path) -> io::Result<()> {
    fs::create_dir(path)?;
    #[cfg(test)]
    note(Change::CreatedFolder(path));
    Ok(())
}

/// Makes a folder and what leads to it; in which folders one was made, the innermost first.
///
/// # Errors
/// Those of the system.
pub(crate) fn make_folder(path: &Path) -> io::Result<Vec<PathBuf>> {
    let missing: Vec<&Path> = path.ancestors().take_while(|own| !own.as_os_str().is_empty() && !own.is_dir()).collect();
    for folder in missing.iter().rev() {
        match create_folder(folder) {
            // Another thread or process has made it.
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists && folder.is_dir() => {}
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {
                let what = format!("{} is no folder", plain::path(folder));
                return Err(io::Error::new(io::ErrorKind::NotADirectory, what));
            }
            made => made?,
        }
    }
    Ok(missing.iter().filter_map(|folder| folder.parent()).map(Path::to_path_buf).collect())
}

fn open_as(path: &Path, options: &mut OpenOptions) -> io::Result<File> {
    // Even opening a device or a pipe can do something.
    if let Some(own) = found(path)?.filter(|own| !own.is_file()) {
        return Err(not_a_file(&own));
    }
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::custom_flags(options, libc::O_NOFOLLOW | libc::O_NONBLOCK);
    let file = options.open(path)?;
    let own = file.metadata()?;
    if own.is_file() { Ok(file) } else { Err(not_a_file(&own)) }
}

fn not_a_file(own: &Metadata) -> io::Error {
    let what = format!("it is {}, and percoat takes only a file itself there: move it away", kind(own));
    io::Error::new(io::ErrorKind::InvalidInput, what)
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(unix)]
    use std::os::unix::{fs::symlink, net::UnixListener};

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
        let own = folder.path().join("own");
        for path in no_files(folder.path()) {
            fs::write(&own, "own").unwrap();
            let refused = [
                open(&path).map(drop),
                read(&path).map(drop),
                read_text(&path).map(drop),
                open_to_change(&path).map(drop),
                Appended::open(&path).map(drop),
                create(&path).map(drop),
                replace(&own, &path),
                move_to(&own, &path),
                link(&own, &path),
                remove(&path),
            ];
            assert!(refused.iter().all(Result::is_err), "{}: {refused:?}", path.display());
            assert!(found(&path).unwrap().is_some_and(|own| !own.is_file()) && own.is_file());
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
        assert_eq!(make_folder(&deep).unwrap(), [folder.path().join("a"), folder.path().to_owned()]);
        assert!(make_folder(&deep).unwrap().is_empty() && create_folder(&deep).is_err());
        assert_eq!(remove_folder(&folder.path().join("a")).unwrap_err().kind(), io::ErrorKind::DirectoryNotEmpty);
        remove_folder(&deep).unwrap();
        fs::write(folder.path().join("mine"), "mine").unwrap();
        let refused = make_folder(&folder.path().join("mine/below")).unwrap_err().to_string();
        assert!(refused.ends_with("mine is no folder"), "{refused}");
    }
}
