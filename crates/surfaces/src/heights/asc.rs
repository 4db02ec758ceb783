//! Esri's grid of text, `.asc`: a header, then heights line by line, the first one on top.
//!
//! ```text
//! NCOLS 480              numbers of a line
//! NROWS 450              lines
//! XLLCORNER 378922       the corner of the lower left cell, or XLLCENTER: the sample in its middle; neither is used
//! YLLCORNER 4072345      or YLLCENTER
//! CELLSIZE 30            distance of samples; DX and DY where they differ along x and y, as GDAL writes them
//! NODATA_VALUE -32768    optional, otherwise -9999: no measurement
//! 43 2 45 7 3 …          NROWS × NCOLS numbers between blanks or ends of lines
//! ```
//!
//! (Esri, "Esri ASCII raster format".) The format has no units: lengths are in that of `surface.unit`, or of the case. A file `.asc` that begins
//! with a comment is another text, see [`spip`](super::spip).

use super::binary::{Image, broken, ended, twice, whole_text};
use super::channel::{Channel, WantedChannel, choose};
use super::fault::{Fault, fits};
use super::header::Length;
use super::measured::Measured;

/// Value of a sample without a measurement where the header has none.
const NO_DATA: f64 = -9999.0;

/// Keys of a header.
const KEYS: [&str; 10] =
    ["ncols", "nrows", "cellsize", "dx", "dy", "nodata_value", "xllcorner", "yllcorner", "xllcenter", "yllcenter"];

/// Reads the only channel; refused where another one is `wanted`.
pub fn read(content: &[u8], wanted: Option<&WantedChannel>) -> Result<Measured, Fault> {
    choose(&[Channel { name: String::new(), unit: None }], wanted)?;
    let content = whole_text(content)?;
    let mut words = content.split_whitespace().peekable();
    let mut found = [None; KEYS.len()];
    while let Some(index) = words.peek().and_then(|word| KEYS.iter().position(|key| word.eq_ignore_ascii_case(key))) {
        words.next();
        let value = words.next().ok_or_else(ended)?;
        let value: f64 = value.parse().map_err(|_| broken("a value of its header is no number"))?;
        if found[index].replace(value).is_some() {
            return Err(twice("a value of its header"));
        }
    }
    let [Some(columns), Some(rows), cell, dx, dy, no_data, ..] = found else {
        let what = "does not begin as a grid of Esri's, with NCOLS and NROWS";
        let fault = Fault::new(what, "another kind of .asc?");
        return Err(fault.help("export it as one, or as text with the ending .txt").or_elsewhere());
    };
    let (Some(dx), Some(dy)) = (dx.or(cell), dy.or(cell)) else {
        return Err(broken("its header has no CELLSIZE"));
    };
    if ![dx, dy].iter().all(|spacing| spacing.is_finite() && *spacing > 0.0) {
        return Err(broken("its CELLSIZE is no length greater than 0"));
    }
    let image = Image::new([columns, rows], true)?;
    // Each number has a character and a blank at least.
    if content.len() < 2 * image.len() - 1 {
        return Err(ended());
    }
    fits(8 * image.len() as u64)?;
    let mut values = Vec::with_capacity(image.len());
    let no_data = no_data.unwrap_or(NO_DATA);
    for word in words {
        let value: f64 = word.parse().map_err(|_| broken("one of its heights is no number"))?;
        if values.len() == image.len() {
            return Err(broken("it holds more heights than its header states"));
        }
        values.push(if value == no_data { f64::NAN } else { value });
    }
    if values.len() < image.len() {
        return Err(ended());
    }
    let side = |count: usize, spacing: f64| Length { value: count as f64 * spacing, unit: None };
    Ok(Measured {
        heights: image.heights(|k| values[k])?,
        sides: [side(image.width, dx), side(image.height, dy)],
        unit: None,
        doubts: Vec::new(),
    })
}
