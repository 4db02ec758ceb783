//! NumPy archives: uncompressed zip files of `.npy` arrays.

use npyz::{AutoSerialize, WriterBuilder};
use std::io::{self, Seek, Write};
use zip::write::SimpleFileOptions;

/// An `.npz` archive that is being written.
pub struct Archive<W: Write + Seek>(zip::ZipWriter<W>);

impl<W: Write + Seek> std::fmt::Debug for Archive<W> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Archive")
    }
}

impl<W: Write + Seek> Archive<W> {
    /// An empty archive.
    pub fn new(writer: W) -> Self {
        Self(zip::ZipWriter::new(writer))
    }

    /// Adds an array of the given shape, its values in C order.
    pub fn array<T: AutoSerialize>(
        &mut self,
        name: &str,
        shape: &[usize],
        values: impl IntoIterator<Item = T>,
    ) -> io::Result<()> {
        // Arrays may pass 4 GiB.
        let options = SimpleFileOptions::default().compression_method(zip::CompressionMethod::Stored).large_file(true);
        self.0.start_file(format!("{name}.npy"), options)?;
        npy(&mut self.0, shape, values)
    }

    /// Ends the archive.
    pub fn finish(self) -> io::Result<()> {
        self.0.finish()?.flush()
    }
}

/// Writes one array as `.npy`.
pub fn npy<T: AutoSerialize>(
    writer: impl Write,
    shape: &[usize],
    values: impl IntoIterator<Item = T>,
) -> io::Result<()> {
    let shape: Vec<u64> = shape.iter().map(|&n| n as u64).collect();
    let mut array = npyz::WriteOptions::new().default_dtype().shape(&shape).writer(writer).begin_nd()?;
    array.extend(values)?;
    array.finish()
}
