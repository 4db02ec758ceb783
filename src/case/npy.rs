//! NumPy's `.npy` files as `numpy.save` writes them: two axes of 64-bit floats.
//!
//! The head is a Python dictionary behind a magic word, a version and its length:
//! `{'descr': '<f8', 'fortran_order': False, 'shape': (64, 48), }`. It is read by hand, since it may hold anything: a
//! parser of all of Python's literals runs out of stack on deep nesting, and sizes whose product overflows must be refused.

use std::io::{self, Read};

/// Bytes of the longest head that is read; that of a plain array has 118.
const LONGEST: usize = 1 << 16;

/// What the head of a file says.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Head {
    /// Type of the values as written, such as `'<f8'` with its quotes.
    pub(super) kind: String,
    /// Whether the first axis is the fastest.
    pub(super) fortran: bool,
    /// Lengths of the axes.
    pub(super) shape: Vec<u64>,
}

impl Head {
    /// Read the head; the reader then stands before the values.
    pub(super) fn read(reader: &mut impl Read) -> io::Result<Self> {
        let mut magic = [0; 8];
        reader.read_exact(&mut magic)?;
        let [.., major, _] = magic;
        if &magic[..6] != b"\x93NUMPY" || !(1..=3).contains(&major) {
            return Err(invalid("it does not begin as one"));
        }
        let mut size = [0; 4];
        reader.read_exact(&mut size[..if major == 1 { 2 } else { 4 }])?;
        let size = u32::from_le_bytes(size) as usize;
        if size > LONGEST {
            return Err(invalid("its head is too long"));
        }
        let mut text = vec![0; size];
        reader.read_exact(&mut text)?;
        let text = std::str::from_utf8(&text).map_err(|_| invalid("its head is no text"))?;
        Self::parse(text).ok_or_else(|| invalid("its head says neither type nor shape"))
    }

    fn parse(text: &str) -> Option<Self> {
        let body = text.trim().strip_prefix('{')?.strip_suffix('}')?;
        let (mut kind, mut fortran, mut shape) = (None, None, None);
        for entry in entries(body) {
            let (key, value) = entry.split_once(':')?;
            let value = value.trim();
            match key.trim().trim_matches(['\'', '"']) {
                "descr" => kind = Some(value.to_owned()),
                "fortran_order" if ["True", "False"].contains(&value) => fortran = Some(value == "True"),
                "shape" => shape = Some(lengths(value)?),
                _ => return None,
            }
        }
        Some(Self { kind: kind?, fortran: fortran?, shape: shape? })
    }

    /// The next 8 bytes as a value; `None` when the type is not a 64-bit float.
    pub(super) fn decode(&self) -> Option<fn([u8; 8]) -> f64> {
        match self.kind.trim_matches(['\'', '"']) {
            "<f8" => Some(f64::from_le_bytes),
            ">f8" => Some(f64::from_be_bytes),
            _ => None,
        }
    }
}

/// The parts between commas that stand in no brackets.
fn entries(body: &str) -> impl Iterator<Item = &str> {
    let mut depth = 0_i64;
    let parts = body.split(move |c: char| {
        depth += i64::from("([{".contains(c)) - i64::from(")]}".contains(c));
        c == ',' && depth == 0
    });
    parts.filter(|part| !part.trim().is_empty())
}

/// The numbers of a tuple.
fn lengths(tuple: &str) -> Option<Vec<u64>> {
    let inside = tuple.strip_prefix('(')?.strip_suffix(')')?;
    inside.split(',').map(str::trim).filter(|part| !part.is_empty()).map(|part| part.parse().ok()).collect()
}

fn invalid(what: &str) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, what)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(version: u8, text: &str) -> io::Result<Head> {
        let size = u32::try_from(text.len()).unwrap().to_le_bytes();
        let size = if version == 1 { &size[..2] } else { &size[..] };
        Head::read(&mut &[b"\x93NUMPY", &[version, 0][..], size, text.as_bytes()].concat()[..])
    }

    #[test]
    fn heads_of_every_version_are_read() {
        let text = "{'descr': '<f8', 'fortran_order': False, 'shape': (64, 48), }     \n";
        for version in 1..=3 {
            let Head { kind, fortran, shape } = read(version, text).unwrap();
            assert_eq!((kind.as_str(), fortran, &shape[..]), ("'<f8'", false, &[64, 48][..]));
        }
        let record = "{'descr': [('a', '<f8'), ('b', '<i4')], 'fortran_order': True, 'shape': (5,)}";
        let head = read(1, record).unwrap();
        assert_eq!((head.fortran, &head.shape[..], head.decode().is_none()), (true, &[5][..], true));
    }

    #[test]
    fn what_is_no_head_is_refused_however_deep_or_large() {
        let sized = |shape: &str| format!("{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}}}");
        for text in [
            &"(".repeat(60_000),
            &sized(&"(".repeat(60_000)),
            &sized("(99999999999999999999999, 2)"),
            &sized("(-1, 2)"),
            "{'descr': '<f8', 'fortran_order': 1, 'shape': (2, 2)}",
            "{'descr': '<f8', 'shape': (2, 2)}",
            "{}",
            "",
        ] {
            assert!(read(2, text).is_err(), "{text:.40}");
        }
        assert!(read(4, &sized("(2, 2)")).is_err());
        assert!(Head::read(&mut &b"\x93NUMPY\x02\x00\xff\xff\xff\xff"[..]).is_err());
    }
}
