//! Arrays as `.npy` files.

use bytemuck::Pod;
use npyz::{AutoSerialize, WriterBuilder};
use std::io::{self, Read, Write};

/// Number of values written at a time.
const CHUNK: usize = 1 << 13;

/// Writes one array as `.npy`, values in C order and in the byte order of the machine, as the header states.
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

/// Writes the header of an array. `npyz` would write the values one by one too, which takes longer than the disk.
pub(super) fn header<T: AutoSerialize>(writer: impl Write, shape: &[usize]) -> io::Result<()> {
    let sizes: Vec<u64> = shape.iter().map(|&n| n as u64).collect();
    let header = npyz::WriteOptions::new_header_only().dtype(T::default_dtype()).shape(&sizes);
    header.writer(writer).write_header_only()?;
    Ok(())
}

/// Reads the values of an array of this shape written by [`npy`]. The header must be equal byte for byte, so that no length in
/// the file is trusted.
///
/// # Errors
/// Another header, fewer or more values, bytes behind them; those of the reader.
pub(super) fn values(mut reader: impl Read, shape: &[usize]) -> io::Result<Vec<f64>> {
    let mut wanted = Vec::new();
    header::<f64>(&mut wanted, shape)?;
    let mut found = vec![0; wanted.len()];
    reader.read_exact(&mut found).map_err(short)?;
    if found != wanted {
        return Err(unlike(format!("it is no array of {shape:?} numbers")));
    }
    let mut values = vec![0.0; shape.iter().product()];
    reader.read_exact(bytemuck::cast_slice_mut(&mut values)).map_err(short)?;
    if reader.read(&mut [0])? > 0 {
        return Err(unlike(format!("it has more than its {} numbers", values.len())));
    }
    Ok(values)
}

/// Reads the values of an array with one axis in a file of `bytes` bytes.
///
/// # Errors
/// Errors of [`values`].
pub(super) fn vector(mut reader: impl Read, bytes: u64) -> io::Result<Vec<f64>> {
    // The ninth and tenth byte of the format are the length of the header.
    let mut begin = [0; 10];
    reader.read_exact(&mut begin).map_err(short)?;
    let head = begin.len() as u64 + u64::from(u16::from_le_bytes([begin[8], begin[9]]));
    let count = bytes.saturating_sub(head) / size_of::<f64>() as u64;
    values((&begin[..]).chain(reader), &[usize::try_from(count).map_err(|_| unlike("it is too long".to_owned()))?])
}

/// Reads the shape from the header of an array of numbers, up to the end of the header.
///
/// # Errors
/// Another header than [`header`] writes; those of the reader.
pub(super) fn shape(mut reader: impl Read) -> io::Result<Vec<usize>> {
    let mut found = vec![0; 10];
    reader.read_exact(&mut found).map_err(short)?;
    found.resize(10 + usize::from(u16::from_le_bytes([found[8], found[9]])), 0);
    reader.read_exact(&mut found[10..]).map_err(short)?;
    let text = String::from_utf8_lossy(&found[10..]).into_owned();
    let list = text.split_once("'shape': (").and_then(|(_, rest)| Some(rest.split_once(')')?.0));
    let sizes = list.and_then(|list| {
        let sizes = list.split(',').map(str::trim).filter(|size| !size.is_empty());
        sizes.map(|size| size.parse().ok()).collect::<Option<Vec<usize>>>()
    });
    let mut wanted = Vec::new();
    let counted = |sizes: &Vec<usize>| sizes.iter().try_fold(1, |count: usize, &n| count.checked_mul(n)).is_some();
    let sizes = sizes.filter(counted).ok_or_else(|| unlike("its header has no shape".to_owned()))?;
    header::<f64>(&mut wanted, &sizes)?;
    if found == wanted { Ok(sizes) } else { Err(unlike("its header is not one of numbers".to_owned())) }
}

fn unlike(reason: String) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, reason)
}

fn short(error: io::Error) -> io::Error {
    if error.kind() == io::ErrorKind::UnexpectedEof { unlike("it ends too early".to_owned()) } else { error }
}

/// An error where the number of values is not that of the shape.
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
    fn an_array_is_read_back_and_has_as_many_values_as_its_shape_says() {
        let mut file = Vec::new();
        let values: Vec<f64> = (0..3 * CHUNK + 5).map(|k| k as f64 / 7.0).collect();
        npy(&mut file, &[values.len()], values.iter().copied()).unwrap();
        assert_eq!(npyz::NpyFile::new(&file[..]).unwrap().into_vec::<f64>().unwrap(), values);
        assert_eq!(super::values(&file[..], &[values.len()]).unwrap(), values);
        assert_eq!(vector(&file[..], file.len() as u64).unwrap(), values);
        for count in [CHUNK - 1, CHUNK + 1] {
            let error = npy(io::sink(), &[CHUNK], vec![0.0; count]).unwrap_err().to_string();
            assert!(error.contains(&format!("{count} values")), "{error}");
        }
    }

    #[test]
    fn a_header_that_is_not_that_of_the_array_is_refused_whatever_it_says() {
        let mut file = Vec::new();
        npy(&mut file, &[2, 3], (0..6).map(f64::from)).unwrap();
        assert_eq!(shape(&file[..]).unwrap(), [2, 3]);
        let text = |from: &str, to: &str| {
            let at = file.windows(from.len()).position(|bytes| bytes == from.as_bytes()).unwrap();
            [&file[..at], to.as_bytes(), &file[at + from.len()..]].concat()
        };
        let huge = text("(2, 3, )", "(18446744073709551615, 3, )");
        for damaged in [
            huge,
            text("(2, 3, )", "(3, 2, )"),
            text("<f8", "<f4"),
            text("False", "True "),
            file[..file.len() - 1].to_vec(),
            [&file[..], &[0]].concat(),
            file[..20].to_vec(),
            Vec::new(),
        ] {
            assert!(values(&damaged[..], &[2, 3]).is_err());
            assert!(vector(&damaged[..], damaged.len() as u64).is_err());
        }
        assert!(shape(&text("(2, 3, )", "(9223372036854775807, 3, )")[..]).is_err());
        assert!(shape(&text("(2, 3, )", "(2, x, )")[..]).is_err() && shape(&text("<f8", "<f4")[..]).is_err());
    }
}
