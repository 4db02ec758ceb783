//! `.npz` archives, read back array by array.

use npyz::{Deserialize, NpyFile};
use std::fs::File;
use std::io::{BufReader, Read};
use std::path::Path;

/// An `.npz` archive.
pub struct Archive(zip::ZipArchive<BufReader<File>>);

/// An array with its shape, values in C order.
pub struct Array<T> {
    pub shape: Vec<usize>,
    pub values: Vec<T>,
}

impl Archive {
    pub fn open(path: &Path) -> Self {
        Self(zip::ZipArchive::new(BufReader::new(File::open(path).unwrap())).unwrap())
    }

    /// Names of the arrays, sorted.
    pub fn names(&self) -> Vec<String> {
        let mut names: Vec<String> =
            self.0.file_names().map(|name| name.unwrap().trim_end_matches(".npy").to_owned()).collect();
        names.sort();
        names
    }

    pub fn array<T: Deserialize>(&mut self, name: &str) -> Array<T> {
        read(self.0.by_name(&format!("{name}.npy")).unwrap())
    }

    /// An array of numbers.
    pub fn field(&mut self, name: &str) -> Array<f64> {
        self.array(name)
    }
}

/// The array of one `.npy` file.
pub fn read_npy(path: &Path) -> Array<f64> {
    read(BufReader::new(File::open(path).unwrap()))
}

fn read<T: Deserialize>(reader: impl Read) -> Array<T> {
    let file = NpyFile::new(reader).unwrap();
    assert_eq!(file.order(), npyz::Order::C);
    let shape = file.shape().iter().map(|&n| n as usize).collect();
    Array { shape, values: file.into_vec().unwrap() }
}
