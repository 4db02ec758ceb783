//! `[surface]`: one period of any topography, read from a NumPy file.

use std::fs::File;
use std::io::{BufReader, Read};
use std::path::Path;

use serde::Serialize;

use super::error::Refusal;
use super::magnitude::CARRIED;
use super::npy::Head;
use super::reader::{TableAt, ValueAt};
use super::room::available_memory;

/// The section `[surface]`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SurfaceSection {
    /// Path of the NumPy file, absolute, so that a copy of the case still finds it.
    pub heights: String,
}

/// Heights of one period of a surface.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Heights {
    /// Samples along a₁ and a₂.
    pub(super) points: [usize; 2],
    /// Protrusion upward at each sample, lengths, n₁ × n₂ values, a₂ fastest.
    pub(super) values: Vec<f64>,
}

const WANTED: &str = "float64 heights of shape (n1, n2), written by numpy.save";

impl SurfaceSection {
    /// Read the section and the file, whose path is relative to `folder`.
    pub(super) fn read(section: &TableAt<'_>, folder: &Path) -> Result<(Self, Heights), Refusal> {
        section.only()?;
        let value = section.required("heights")?;
        let name = value.text("the path of a NumPy file")?;
        let path = folder.join(name);
        let path = std::path::absolute(&path).unwrap_or(path);
        let heights = Heights::read(&path, &value)?;
        Ok((Self { heights: path.to_string_lossy().into_owned() }, heights))
    }
}

impl Heights {
    fn read(path: &Path, written: &ValueAt<'_>) -> Result<Self, Refusal> {
        let shown = path.display();
        let refuse = |what: String, label: String| {
            Refusal::new(written.node.place, format!("`{}`: {what}", written.path), label)
                .help(format!("needed: {WANTED}"))
        };
        let unreadable = |error| refuse(format!("cannot read {shown}: {error}"), "this file".into());
        let file = File::open(path).map_err(unreadable)?;
        let bytes = file.metadata().map_err(unreadable)?.len();
        let mut reader = BufReader::new(file);
        let head = Head::read(&mut reader)
            .map_err(|error| refuse(format!("{shown} is not a NumPy file: {error}"), "this file".into()))?;

        let &[n1 @ 2..=32768, n2 @ 2..=32768] = &head.shape[..] else {
            let sizes: Vec<String> = head.shape.iter().map(u64::to_string).collect();
            let shape = format!("shape ({})", sizes.join(", "));
            let what = format!("{shown} holds an array of {shape}; n1 and n2 must lie between 2 and 32768");
            return Err(refuse(what, shape));
        };
        let kind = format!("type {}", head.kind);
        let decode = head.decode().ok_or_else(|| refuse(format!("{shown} holds values of {kind}"), kind))?;
        let truncated = || refuse(format!("{shown} ends before its {n1} × {n2} values"), "truncated".into());
        if bytes < 8 * n1 * n2 {
            return Err(truncated());
        }
        // As stored, in the order of the grid, and once more on it.
        if 24 * n1 * n2 > available_memory() {
            let what = format!("{shown} holds {n1} × {n2} values, more than memory does");
            return Err(refuse(what, "too large".into()));
        }
        let mut value = [0; 8];
        let mut next = |_| reader.read_exact(&mut value).map(|()| decode(value));
        let stored: Vec<f64> = (0..n1 * n2).map(&mut next).collect::<Result<_, _>>().map_err(|_| truncated())?;

        let points = [n1 as usize, n2 as usize];
        let [n1, n2] = points;
        let values = if head.fortran { (0..n1 * n2).map(|k| stored[k / n2 + n1 * (k % n2)]).collect() } else { stored };
        match values.iter().position(|height| height.is_nan() || height.abs() > *CARRIED.end()) {
            None => Ok(Self { points, values }),
            Some(k) => {
                let (value, i, j) = (super::node::plain(values[k]), k / n2, k % n2);
                Err(refuse(
                    format!("{shown} holds {value} at [{i}, {j}]"),
                    "every height must be finite and at most 1e60".into(),
                ))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::{Case, CaseError, Source};
    use crate::run::Sampling;
    use npyz::{Order, WriterBuilder};

    const CASE: &str = "[lattice]\nkind = \"square\"\nperiod = 1\n[surface]\nheights = \"surface.npy\"\n\
                        [substrate]\nyoung = 1\npoisson = 0.3\n[load]\nmean_pressure = 1e-3\n";

    fn write<T: npyz::AutoSerialize>(folder: &Path, shape: &[u64], order: Order, values: &[T]) {
        let file = File::create(folder.join("surface.npy")).unwrap();
        let options = npyz::WriteOptions::new().default_dtype().shape(shape).order(order);
        let mut writer = options.writer(file).begin_nd().unwrap();
        writer.extend(values).unwrap();
        writer.finish().unwrap();
    }

    fn read(folder: &Path, more: &str) -> Result<Case, CaseError> {
        let source = Source { name: "case".to_owned(), text: format!("{CASE}{more}"), folder: folder.to_owned() };
        Case::read(&source, &[])
    }

    #[test]
    fn both_orders_give_the_same_heights_with_a2_fastest() {
        let folder = tempfile::tempdir().unwrap();
        for (order, stored) in [(Order::C, [1., 2., 3., 4., 5., 6.]), (Order::Fortran, [1., 4., 2., 5., 3., 6.])] {
            write(folder.path(), &[2, 3], order, &stored);
            let case = read(folder.path(), "").unwrap();
            let heights = case.counterbody().topography().expect("a topography").heights();
            assert_eq!(heights, ndarray::arr2(&[[1., 2., 3.], [4., 5., 6.]]));
            assert_eq!(case.grid, Sampling::Points([2, 3]));
            let elsewhere = Source { name: "copy".to_owned(), text: case.to_toml(), folder: "elsewhere".into() };
            assert_eq!(Case::read(&elsewhere, &[]).unwrap(), case);
        }
    }

    #[test]
    fn the_grid_is_that_of_the_file() {
        let folder = tempfile::tempdir().unwrap();
        write(folder.path(), &[2, 2], Order::C, &[0.0; 4]);
        assert!(read(folder.path(), "[grid]\npoints = 2\n").is_ok());
        let error = read(folder.path(), "[grid]\npoints = 64\n").unwrap_err().to_string();
        assert!(error.contains("`grid.points` must be [2, 2]"), "{error}");
        assert!(read(folder.path(), "[grid]\naccuracy = 0.01\n").is_err());
    }

    #[test]
    fn files_of_other_contents_are_refused_with_what_they_hold() {
        let folder = tempfile::tempdir().unwrap();
        let fault = || read(folder.path(), "").unwrap_err().to_string();
        write(folder.path(), &[2, 2], Order::C, &[0.0f32; 4]);
        assert!(fault().contains("values of type '<f4'"), "{}", fault());
        write(folder.path(), &[4], Order::C, &[0.0; 4]);
        assert!(fault().contains("shape (4)"), "{}", fault());
        write(folder.path(), &[1, 4], Order::C, &[0.0; 4]);
        assert!(fault().contains("shape (1, 4)"), "{}", fault());
        write(folder.path(), &[2, 2], Order::C, &[0.0, 1.0, f64::NAN, 3.0]);
        assert!(fault().contains("holds nan at [1, 0]"), "{}", fault());
        write(folder.path(), &[20, 20], Order::C, &[0.0; 400]);
        let whole = std::fs::read(folder.path().join("surface.npy")).unwrap();
        std::fs::write(folder.path().join("surface.npy"), &whole[..whole.len() - 9]).unwrap();
        assert!(fault().contains("ends before its 20 × 20 values"), "{}", fault());
    }
}
