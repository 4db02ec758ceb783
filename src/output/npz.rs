//! NumPy archives: uncompressed zip files of `.npy` arrays.

use bytemuck::Pod;
use npyz::{AutoSerialize, WriterBuilder};
use std::cell::RefCell;
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::rc::Rc;
use std::sync::Arc;
use zip::write::SimpleFileOptions;

/// An `.npz` archive that is being written.
pub(super) struct Archive<W: Write + Seek> {
    zip: zip::ZipWriter<Calm<W>>,
    failure: Failure,
}

/// Values that are written at a time.
const CHUNK: usize = 1 << 13;

/// What the system said when a write failed.
type Failure = Rc<RefCell<Option<io::Error>>>;

/// A file that takes everything in silence once it has failed: zip ends an archive even when it is given up, and would
/// print what it thinks of it.
struct Calm<W> {
    file: W,
    position: u64,
    end: u64,
    failed: bool,
    failure: Failure,
}

impl<W: Write + Seek> Archive<W> {
    /// An empty archive.
    pub(super) fn new(writer: W) -> Self {
        let failure = Failure::default();
        let file = Calm { file: writer, position: 0, end: 0, failed: false, failure: Rc::clone(&failure) };
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

impl<W> Calm<W> {
    /// What the file gives, or what it would if it had not failed.
    fn ask<T>(&mut self, file: impl FnOnce(&mut W) -> io::Result<T>, otherwise: T) -> T {
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

impl<W: Write> Write for Calm<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.ask(|file| file.write_all(bytes), ());
        self.position += bytes.len() as u64;
        self.end = self.end.max(self.position);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.ask(W::flush, ());
        Ok(())
    }
}

impl<W: Seek> Seek for Calm<W> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        let otherwise = match to {
            SeekFrom::Start(position) => Some(position),
            SeekFrom::Current(by) => self.position.checked_add_signed(by),
            SeekFrom::End(by) => self.end.checked_add_signed(by),
        };
        self.position = self.ask(|file| file.seek(to), otherwise.ok_or(io::ErrorKind::InvalidInput)?);
        Ok(self.position)
    }
}

/// Writes one array as `.npy`, in the byte order of the machine, which the header tells.
pub(super) fn npy<T: AutoSerialize + Pod>(
    mut writer: impl Write,
    shape: &[usize],
    values: impl IntoIterator<Item = T>,
) -> io::Result<()> {
    header::<T>(&mut writer, shape)?;
    let (mut values, mut chunk, mut count) = (values.into_iter(), Vec::with_capacity(CHUNK), 0);
    loop {
        chunk.extend(values.by_ref().take(CHUNK));
        writer.write_all(bytemuck::cast_slice(&chunk))?;
        count += chunk.len();
        if chunk.len() < CHUNK {
            break;
        }
        chunk.clear();
    }
    complete(shape, count)
}

/// The same in memory: the content of a `.npy` file.
///
/// # Errors
/// When there are fewer or more values than the shape says.
pub fn npy_bytes(shape: &[usize], values: impl IntoIterator<Item = f64>) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    npy(&mut bytes, shape, values)?;
    Ok(bytes)
}

/// The same, written where it stays: beside the bytes nothing is taken. `values` are as many as the shape says.
///
/// # Errors
/// When there is no header of such a shape.
pub fn npy_shared(shape: &[usize], values: impl IntoIterator<Item = f64>) -> io::Result<Arc<[u8]>> {
    let (mut head, mut values, mut value) = (Vec::new(), values.into_iter(), [0; size_of::<f64>()]);
    header::<f64>(&mut head, shape)?;
    let (begin, end) = (head.len(), head.len() + size_of_val(&value) * shape.iter().product::<usize>());
    // The length of a mapped range is known: the bytes are collected without a detour.
    let byte = |at: usize| {
        let Some(at) = at.checked_sub(begin) else { return head[at] };
        let at = at % value.len();
        if at == 0 {
            value = values.next().unwrap_or(f64::NAN).to_ne_bytes();
        }
        value[at]
    };
    Ok((0..end).map(byte).collect())
}

/// What stands before the values of an array. The library would write those one by one, which takes longer than the disk.
pub(super) fn header<T: AutoSerialize>(writer: impl Write, shape: &[usize]) -> io::Result<()> {
    let sizes: Vec<u64> = shape.iter().map(|&n| n as u64).collect();
    let header = npyz::WriteOptions::new_header_only().dtype(T::default_dtype()).shape(&sizes);
    header.writer(writer).write_header_only()?;
    Ok(())
}

/// The values of an array as [`npy`] has written it: behind the header, in the byte order of the machine.
pub(super) fn values(mut reader: impl Read) -> io::Result<Vec<f64>> {
    let header = npyz::NpyHeader::from_reader(&mut reader)?;
    if header.dtype() != f64::default_dtype() {
        return Err(io::ErrorKind::InvalidData.into());
    }
    let mut values = vec![0.0; header.len() as usize];
    reader.read_exact(bytemuck::cast_slice_mut(&mut values))?;
    Ok(values)
}

/// Whether an array has as many values as its shape says.
pub(super) fn complete(shape: &[usize], count: usize) -> io::Result<()> {
    if count == shape.iter().product::<usize>() {
        Ok(())
    } else {
        Err(io::Error::new(io::ErrorKind::InvalidData, format!("{count} values for an array of {shape:?}")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_array_written_where_it_stays_is_the_same() {
        for shape in [&[][..], &[0], &[5], &[2, 3], &[3, 0, 2], &[40, 50]] {
            let values = || (0..shape.iter().product::<usize>()).map(|k| (k as f64).sqrt() - 1.5);
            assert_eq!(&*npy_shared(shape, values()).unwrap(), npy_bytes(shape, values()).unwrap(), "{shape:?}");
        }
    }

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
    fn an_array_is_read_back_and_has_as_many_values_as_its_shape_says() {
        let mut file = Vec::new();
        let values: Vec<f64> = (0..3 * CHUNK + 5).map(|k| k as f64 / 7.0).collect();
        npy(&mut file, &[values.len()], values.iter().copied()).unwrap();
        assert_eq!(npyz::NpyFile::new(&file[..]).unwrap().into_vec::<f64>().unwrap(), values);
        for count in [CHUNK - 1, CHUNK + 1] {
            let error = npy(io::sink(), &[CHUNK], vec![0.0; count]).unwrap_err().to_string();
            assert!(error.contains(&format!("{count} values")), "{error}");
        }
    }

    #[test]
    fn a_disk_that_is_full_at_any_byte_is_told_as_the_system_tells_it() {
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
