//! NumPy archives: uncompressed zip files of `.npy` arrays.

use super::npy::npy;
use bytemuck::Pod;
use npyz::AutoSerialize;
use std::cell::RefCell;
use std::io::{self, Seek, SeekFrom, Write};
use std::rc::Rc;
use zip::write::SimpleFileOptions;

/// An `.npz` archive under construction.
pub(super) struct Archive<W: Write + Seek> {
    zip: zip::ZipWriter<KeepsFirstError<W>>,
    failure: FirstError,
}

/// The error of the first write that failed.
type FirstError = Rc<RefCell<Option<io::Error>>>;

/// A writer that keeps its first error and ignores later writes: `zip` ends an archive even when it is dropped, and would print
/// the error.
struct KeepsFirstError<W> {
    file: W,
    position: u64,
    end: u64,
    failed: bool,
    failure: FirstError,
}

impl<W: Write + Seek> Archive<W> {
    /// An empty archive.
    pub(super) fn new(writer: W) -> Self {
        let failure = FirstError::default();
        let file = KeepsFirstError { file: writer, position: 0, end: 0, failed: false, failure: Rc::clone(&failure) };
        Self { zip: zip::ZipWriter::new(file), failure }
    }

    /// Adds an array of the given shape, its values in C order.
    pub(super) fn array<T: AutoSerialize + Pod>(
        &mut self,
        name: &str,
        shape: &[usize],
        values: impl IntoIterator<Item = T>,
    ) -> io::Result<()> {
        // Arrays may pass 4 GiB.
        let options = SimpleFileOptions::default().compression_method(zip::CompressionMethod::Stored).large_file(true);
        self.zip.start_file(format!("{name}.npy"), options)?;
        npy(&mut self.zip, shape, values)?;
        self.failure.take().map_or(Ok(()), Err)
    }

    /// Adds a text.
    pub(super) fn text(&mut self, name: &str, text: &str) -> io::Result<()> {
        let options = SimpleFileOptions::default().compression_method(zip::CompressionMethod::Stored);
        self.zip.start_file(name, options)?;
        self.zip.write_all(text.as_bytes())?;
        self.failure.take().map_or(Ok(()), Err)
    }

    /// Ends the archive.
    pub(super) fn finish(self) -> io::Result<()> {
        self.zip.finish()?.flush()?;
        self.failure.take().map_or(Ok(()), Err)
    }
}

impl<W> KeepsFirstError<W> {
    /// The result of an operation on the file, or `otherwise` once one has failed.
    fn attempt<T>(&mut self, file: impl FnOnce(&mut W) -> io::Result<T>, otherwise: T) -> T {
        if self.failed {
            return otherwise;
        }
        file(&mut self.file).unwrap_or_else(|error| {
            self.failed = true;
            self.failure.replace(Some(error));
            otherwise
        })
    }
}

impl<W: Write> Write for KeepsFirstError<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.attempt(|file| file.write_all(bytes), ());
        self.position += bytes.len() as u64;
        self.end = self.end.max(self.position);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.attempt(W::flush, ());
        Ok(())
    }
}

impl<W: Seek> Seek for KeepsFirstError<W> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        let otherwise = match to {
            SeekFrom::Start(position) => Some(position),
            SeekFrom::Current(by) => self.position.checked_add_signed(by),
            SeekFrom::End(by) => self.end.checked_add_signed(by),
        };
        self.position = self.attempt(|file| file.seek(to), otherwise.ok_or(io::ErrorKind::InvalidInput)?);
        Ok(self.position)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A disk with room for so many bytes.
    struct Disk(io::Cursor<Vec<u8>>, u64);

    impl Write for Disk {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            let room = self.1.saturating_sub(self.0.position()) as usize;
            if room == 0 {
                Err(io::ErrorKind::StorageFull.into())
            } else {
                self.0.write(&bytes[..room.min(bytes.len())])
            }
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    impl Seek for Disk {
        fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
            self.0.seek(to)
        }
    }

    fn archive(disk: &mut Disk) -> io::Result<()> {
        let mut archive = Archive::new(disk);
        archive.array("a", &[3], [1.0, 2.0, 3.0])?;
        archive.array("b", &[2], [1.0, 2.0])?;
        archive.finish()
    }

    #[test]
    fn a_disk_that_is_full_at_any_byte_is_the_error_of_the_system() {
        let mut whole = Disk(io::Cursor::default(), u64::MAX);
        archive(&mut whole).unwrap();
        let bytes = whole.0.get_ref().len() as u64;
        for room in 0..bytes {
            let error = archive(&mut Disk(io::Cursor::default(), room)).unwrap_err();
            assert_eq!(error.kind(), io::ErrorKind::StorageFull, "room for {room} of {bytes} bytes: {error}");
        }
        archive(&mut Disk(io::Cursor::default(), bytes)).unwrap();
    }
}
