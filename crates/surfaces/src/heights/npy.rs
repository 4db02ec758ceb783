//! NumPy's `.npy` files as `numpy.save` writes them: two axes of floats or integers, in either order of the bytes and of
//! the axes.
//!
//! The head is a Python dictionary behind a magic word, a version and its length:
//! `{'descr': '<f8', 'fortran_order': False, 'shape': (64, 48), }`. It is parsed here, since it may have any content: a parser of all
//! of Python's literals runs out of stack on deep nesting, and sizes whose product overflows must be refused.

use std::io::{self, Read};

use super::fault::{Fault, Heights, MOST, fits};
use ndarray::ArrayD;

/// Longest head, bytes; that of a plain array has 118.
const LONGEST: usize = 1 << 16;

/// Conversion of the bytes of a value to a number.
type Decode = fn(&[u8]) -> f64;

/// The head of a file.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Head {
    /// Type of the values as written, such as `'<f8'` with its quotes.
    kind: String,
    /// Whether the first axis is the fastest.
    fortran: bool,
    /// Lengths of the axes.
    shape: Vec<u64>,
}

impl Head {
    /// Reads the head, up to the values.
    fn read(reader: &mut impl Read) -> io::Result<Self> {
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
        Self::parse(text).ok_or_else(|| invalid("its head has no type or no shape"))
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

    /// Type of the numbers in words: as written for the short names of NumPy, since a head may have any content.
    fn kind_in_words(&self) -> String {
        let short =
            self.kind.len() <= 6 && self.kind.chars().all(|c| c.is_ascii_alphanumeric() || "<>|='\"".contains(c));
        if short { format!("type {}", self.kind) } else { "another type".to_owned() }
    }

    /// Size of a value in bytes and its conversion; `None` for a type that is not a real number.
    fn decode(&self) -> Option<(usize, Decode)> {
        macro_rules! number {
            ($type:ty, $read:ident) => {
                (size_of::<$type>(), |bytes: &[u8]| <$type>::$read(bytes.try_into().expect("as many as it has")) as f64)
            };
        }
        Some(match self.kind.trim_matches(['\'', '"']) {
            "<f8" => number!(f64, from_le_bytes),
            ">f8" => number!(f64, from_be_bytes),
            "<f4" => number!(f32, from_le_bytes),
            ">f4" => number!(f32, from_be_bytes),
            "|i1" | "<i1" | ">i1" => number!(i8, from_le_bytes),
            "|u1" | "<u1" | ">u1" => number!(u8, from_le_bytes),
            "<i2" => number!(i16, from_le_bytes),
            ">i2" => number!(i16, from_be_bytes),
            "<u2" => number!(u16, from_le_bytes),
            ">u2" => number!(u16, from_be_bytes),
            "<i4" => number!(i32, from_le_bytes),
            ">i4" => number!(i32, from_be_bytes),
            "<u4" => number!(u32, from_le_bytes),
            ">u4" => number!(u32, from_be_bytes),
            "<i8" => number!(i64, from_le_bytes),
            ">i8" => number!(i64, from_be_bytes),
            "<u8" => number!(u64, from_le_bytes),
            ">u8" => number!(u64, from_be_bytes),
            _ => return None,
        })
    }
}

const WANTED: &str = "needed: heights of shape (n1, n2) and type float64, float32 or an integer, written by numpy.save";

/// Reads a file of `bytes` bytes.
pub fn read(mut reader: impl Read, bytes: u64) -> Result<Heights, Fault> {
    read_heights(&mut reader, bytes).map_err(|fault| if fault.help.is_none() { fault.help(WANTED) } else { fault })
}

/// Heights of an array in memory.
pub fn of_array(array: &ArrayD<f64>) -> Result<Heights, Fault> {
    let lengths: Vec<u64> = array.shape().iter().map(|&n| n as u64).collect();
    let points = points(&lengths).map_err(|fault| fault.help(WANTED))?;
    fits(8 * array.len() as u64)?;
    Heights::new(points, array.iter().copied().collect())
}

/// Samples along both axes of an array; a fault without two axes of allowed lengths.
fn points(shape: &[u64]) -> Result<[usize; 2], Fault> {
    let most = MOST as u64;
    match *shape {
        [n1, n2] if (2..=most).contains(&n1) && (2..=most).contains(&n2) => Ok([n1 as usize, n2 as usize]),
        _ => {
            let sizes: Vec<String> = shape.iter().map(u64::to_string).collect();
            let shape = format!("shape ({})", sizes.join(", "));
            let what = format!("holds an array of {shape}; n1 and n2 must lie between 2 and {MOST}");
            Err(Fault::new(what, shape))
        }
    }
}

fn read_heights(reader: &mut impl Read, bytes: u64) -> Result<Heights, Fault> {
    let head = Head::read(reader).map_err(|error| Fault::new(format!("is not a NumPy file: {error}"), "this file"))?;
    let points = points(&head.shape)?;
    let kind = head.kind_in_words();
    let Some((size, number)) = head.decode() else {
        return Err(Fault::new(format!("holds values of {kind}"), kind));
    };
    let [n1, n2] = points;
    let truncated = || Fault::new(format!("ends before its {n1} × {n2} values"), "truncated");
    if bytes < (size * n1 * n2) as u64 {
        return Err(truncated());
    }
    // The heights in the order of the grid, and one line as stored.
    fits(8 * (n1 * n2) as u64)?;
    let mut values = vec![0.0; n1 * n2];
    let [lines, along] = if head.fortran { [n2, n1] } else { [n1, n2] };
    let mut stored = vec![0; size * along];
    for line in 0..lines {
        reader.read_exact(&mut stored).map_err(|_| truncated())?;
        for (k, value) in stored.chunks_exact(size).map(number).enumerate() {
            values[if head.fortran { k * n2 + line } else { line * n2 + k }] = value;
        }
    }
    Heights::new(points, values)
}

/// The parts between commas outside brackets.
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
        assert!(head.fortran && head.shape == [5] && head.decode().is_none());
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
