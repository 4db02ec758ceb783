//! SPIP's ASCII files, `.asc` or `.txt`, which Gwyddion writes too: a header of comments, the heights as an image, and perhaps a mask.
//!
//! ```text
//! # File Format = ASCII     first line              # z-unit = nm       unit of the heights, or
//! # x-pixels = 480          numbers of a line       # Bit2nm = 0.5      factor from the numbers to nanometres
//! # y-pixels = 450          lines                   # voidpixels = 7    places without a measurement
//! # x-length = 4800         sides, always in nm     # Start of Data:
//! # y-length = 4500
//! ```
//!
//! Void pixels make as many lines follow as there are heights, of 1 at a place without a measurement and 0 elsewhere. Gwyddion writes
//! `Bit2nm = 1.0` also beside a `z-unit`, which then holds alone. Sources: Gwyddion's `spip-asc.c`, and the reader of SurfaceTopography 1.27.

use super::fault::{Fault, Heights};

/// Heights of a table without its mask: `lines` lines of heights, of which `voids` have no measurement.
pub fn without_voids(table: Heights, lines: usize, voids: usize) -> Result<Heights, Fault> {
    let Heights { points: [rows, numbers], mut values } = table;
    if rows == 2 * lines {
        let mask = values.split_off(lines * numbers);
        let is_mask = mask.iter().all(|mark| [0.0, 1.0].contains(mark));
        if !is_mask || mask.iter().filter(|mark| **mark == 1.0).count() != voids {
            let what = format!(
                "holds {lines} lines behind its heights that do not mark by 1 the {voids} places without a measurement of its header"
            );
            return Err(Fault::new(what, "another mask").help("export it again"));
        }
        values.iter_mut().zip(mask).filter(|(_, mark)| *mark == 1.0).for_each(|(height, _)| *height = f64::NAN);
        return Ok(Heights { points: [lines, numbers], values });
    }
    if rows == lines && values.iter().filter(|height| height.is_nan()).count() < voids {
        let what = format!("says that {voids} places have no measurement, and does not mark them");
        return Err(Fault::new(what, "which places?").help("write nan for these heights, and # voidpixels = 0"));
    }
    Ok(Heights { points: [rows, numbers], values })
}
