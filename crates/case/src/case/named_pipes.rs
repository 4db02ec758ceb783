//! Files that can be read only once: named pipes and process substitutions of a shell.

use percoat_common::machine::available_memory;
use std::collections::BTreeMap;
use std::fs;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

/// The content of pipes that were read, by their paths; clones share it.
#[derive(Debug, Clone, Default)]
pub struct Pipes(Arc<Mutex<BTreeMap<PathBuf, Arc<[u8]>>>>);

/// The cache is not part of the comparison of sources.
impl PartialEq for Pipes {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// Whether `path` exists and is neither a file nor a folder.
pub(super) fn is_pipe(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|metadata| !metadata.is_file() && !metadata.is_dir())
}

impl Pipes {
    /// All bytes of the pipe at `path`. A pipe can be read once: later calls return the bytes of the first.
    pub(super) fn read(&self, path: &Path) -> io::Result<Arc<[u8]>> {
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(bytes) = known.get(path) {
            return Ok(Arc::clone(bytes));
        }
        // The length of a pipe is not known in advance, and numbers take more memory than their text.
        let most = available_memory() / 8;
        let mut bytes = Vec::new();
        fs::File::open(path)?.take(most + 1).read_to_end(&mut bytes)?;
        if bytes.len() as u64 > most {
            return Err(io::Error::new(io::ErrorKind::FileTooLarge, "more comes out of it than there is memory for"));
        }
        let bytes: Arc<[u8]> = bytes.into();
        known.insert(path.to_owned(), Arc::clone(&bytes));
        Ok(bytes)
    }
}
