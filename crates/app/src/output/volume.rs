//! The stress field of one load step in three dimensions, for ParaView.
//!
//! A structured grid in VTK's XML format (`.vts`) with its numbers appended as raw bytes, written here, since vtkio 0.6 depends on
//! parsers that newer compilers reject and takes four times the file in memory.
//! VTK itself reads what is written (`tests/library/volume.rs`). VTK's z axis points upwards out of the body, so that depth is
//! drawn downwards. Everything in the file follows the drawn axes: coordinates are −z, displacements −u_z, and σ_xz, σ_yz
//! have the opposite sign of [`StressState`]'s, whose z points into the body.

use super::checksum::Checksum;
use super::{OutputError, write_file};
use percoat_core::body::Depth;
use percoat_core::stress::{StressField, StressState};
use std::io::{self, Write};
use std::path::Path;

/// Scalars at the points, in the order of [`values`].
const SCALARS: [&str; 10] =
    ["sigma_xx", "sigma_yy", "sigma_zz", "sigma_xy", "sigma_xz", "sigma_yz", "tau1", "mises", "sigma1", "material"];

/// Writes the field on a stack of planes as a VTK structured grid; `path` should end in `.vts`.
///
/// - **Points**: [n₁ + 1, n₂ + 1, `depths`] along a₁, a₂ and upwards (the last depth first, so that the grid is
///   right-handed), a₁ fastest. `points` are the samples [n₁, n₂] of [`StressField::plane`], at least 1 each; the border
///   i = n₁, j = n₂ repeats i = 0, j = 0, so that the cell closes; around an isolated contact there is no such border. A depth on an interface that is given once for each
///   side makes a layer of cells without thickness, across which the field jumps. Coordinates x, y, −z are lengths.
/// - **Values at points**, 64-bit: `sigma_xx`, `sigma_yy`, `sigma_zz`, `sigma_xy`, `sigma_xz`, `sigma_yz`, the
///   principal shear stress `tau1`, the von Mises stress `mises` and the largest tension `sigma1`, all in the unit of
///   the pressure, positive in tension; `material` ([`Depth::material`]); the vector `displacement` (u_x, u_y, −u_z), a
///   length, along the drawn axes.
///
/// `sigma_xz` and `sigma_yz` too are along the drawn axes, the opposite of [`StressState`]'s, where z points into the body.
/// Values are exact at the points, however few they are. Planes are computed one at a time; the states of all points are kept
/// until they are written, about the size of the file.
///
/// # Errors
/// [`OutputError`] when the file cannot be written, or when there are no depths or no points; nothing is left behind.
pub fn write_volume(path: &Path, field: &StressField, depths: &[Depth], points: [usize; 2]) -> Result<(), OutputError> {
    added_volume(path, field, depths, points).map(|_| ())
}

/// Writes the field as [`write_volume`] does, and returns the checksum of the file.
pub(super) fn added_volume(
    path: &Path,
    field: &StressField,
    depths: &[Depth],
    points: [usize; 2],
) -> Result<Checksum, OutputError> {
    let mut sum = Checksum::default();
    write_file(path, |writer| {
        let writer = &mut sum.through(writer);
        let [n1, n2] = points;
        if depths.is_empty() || n1 == 0 || n2 == 0 {
            let reason = format!("a grid of {n1} × {n2} points at {} depths is empty", depths.len());
            return Err(io::Error::new(io::ErrorKind::InvalidInput, reason));
        }
        let upwards: Vec<Depth> = depths.iter().rev().copied().collect();
        let states: Vec<StressState> = upwards.iter().flat_map(|&depth| closed_plane(field, depth, points)).collect();
        let [last1, last2] = field.grid().cell().last_points(points);
        let per_layer = (last1 + 1) * (last2 + 1);
        head(writer, [last1, last2, depths.len() - 1], states.len())?;
        for c in 0..SCALARS.len() {
            let value = |(index, state): (usize, &StressState)| values(state, upwards[index / per_layer].material)[c];
            block(writer, states.len(), states.iter().enumerate().map(value))?;
        }
        let displacement = states.iter().flat_map(|state| {
            let [ux, uy, uz] = state.displacement;
            [ux, uy, -uz]
        });
        block(writer, 3 * states.len(), displacement)?;
        let place = |(index, _): (usize, &StressState)| {
            let (i, j) = (index % (last1 + 1), index / (last1 + 1) % (last2 + 1));
            let [x, y] = field.grid().cell().point([i as f64 / n1 as f64, j as f64 / n2 as f64]);
            [x, y, -upwards[index / per_layer].z]
        };
        block(writer, 3 * states.len(), states.iter().enumerate().flat_map(place))?;
        write!(writer, "\n</AppendedData>\n</VTKFile>\n")
    })?;
    Ok(sum)
}

/// States of a plane, a₁ fastest, its border repeated in a periodic system.
fn closed_plane(field: &StressField, depth: Depth, points: [usize; 2]) -> Vec<StressState> {
    let ([n1, n2], plane) = (points, field.plane(depth, points));
    let [last1, last2] = field.grid().cell().last_points(points);
    (0..=last2).flat_map(|j| (0..=last1).map(move |i| (i, j))).map(|(i, j)| plane.state([i % n1, j % n2])).collect()
}

/// Writes the XML before the numbers: extents, and the offset of each array's block.
fn head(writer: &mut impl Write, [n1, n2, layers]: [usize; 3], points: usize) -> io::Result<()> {
    let extent = format!("0 {n1} 0 {n2} 0 {layers}");
    // Each block is preceded by its length, 8 bytes.
    let (scalar, vector) = (8 + 8 * points, 8 + 24 * points);
    let array = |name: &str, components: usize, offset: usize| {
        let kind = format!("type=\"Float64\" Name=\"{name}\" NumberOfComponents=\"{components}\"");
        format!("<DataArray {kind} format=\"appended\" offset=\"{offset}\"/>")
    };
    writeln!(writer, "<?xml version=\"1.0\"?>")?;
    let order = "version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\"";
    writeln!(writer, "<VTKFile type=\"StructuredGrid\" {order}>")?;
    writeln!(writer, "<StructuredGrid WholeExtent=\"{extent}\">\n<Piece Extent=\"{extent}\">")?;
    writeln!(writer, "<PointData Scalars=\"tau1\" Vectors=\"displacement\">")?;
    for (number, name) in SCALARS.iter().enumerate() {
        writeln!(writer, "{}", array(name, 1, number * scalar))?;
    }
    writeln!(writer, "{}\n</PointData>", array("displacement", 3, SCALARS.len() * scalar))?;
    writeln!(writer, "<Points>\n{}\n</Points>", array("points", 3, SCALARS.len() * scalar + vector))?;
    write!(writer, "</Piece>\n</StructuredGrid>\n<AppendedData encoding=\"raw\">\n_")
}

/// Writes the block of an array: its length in bytes, then the numbers.
fn block(writer: &mut impl Write, len: usize, values: impl Iterator<Item = f64>) -> io::Result<()> {
    writer.write_all(&(8 * len as u64).to_le_bytes())?;
    values.into_iter().try_for_each(|value| writer.write_all(&value.to_le_bytes()))
}

/// The values of [`SCALARS`] along the drawn axes, z upwards.
fn values(state: &StressState, material: usize) -> [f64; SCALARS.len()] {
    let StressState { xx, yy, zz, xy, xz, yz, .. } = *state;
    [xx, yy, zz, xy, -xz, -yz, state.tau1(), state.mises(), state.s1(), material as f64]
}
