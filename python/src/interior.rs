//! Stresses and displacements inside the body, where a step is asked for them.

use crate::step::Kept;
use crate::toml::written;
use crate::work::Listener;
use ndarray::{Array2, Array3, ArrayView2, Axis, s};
use percoat::case::{Case, Source};
use percoat::machine::{available_memory, bytes};
use percoat::run::StressRequest;
use percoat::{Depth, HalfSpace, SurfaceLine};
use toml::Value;

/// The depth z ≥ 0 in the material of this number; on an interface, where none is said, in the upper one.
fn depth(half_space: &HalfSpace, z: f64, material: Option<i64>) -> Result<Depth, String> {
    if !(z >= 0.0 && z.is_finite()) {
        return Err(format!("z = {z} is not in the body: depths are 0 or more, finite"));
    }
    let depths = half_space.depths(z);
    let Some(wanted) = material else { return Ok(depths[0]) };
    depths.iter().find(|depth| depth.material as i64 == wanted).copied().ok_or_else(|| {
        let own: Vec<String> = depths.iter().map(|depth| depth.material.to_string()).collect();
        format!("z = {z} is in material {}, not in {wanted}", own.join(" and "))
    })
}

/// Points whose stresses are summed before Ctrl-C is looked for again.
const CHUNK: usize = 256;
/// What nobody hears any more.
const STOPPED: &str = "stopped before its end";

/// Stresses at points (n, 3): (n, 6).
pub fn at(
    kept: &Kept,
    points: ArrayView2<'_, f64>,
    material: Option<i64>,
    listener: &Listener,
) -> Result<Array2<f64>, String> {
    let half_space = kept.step.problem().half_space();
    if points.iter().any(|x| !x.is_finite()) {
        return Err("a point has a coordinate that is no finite number".to_owned());
    }
    let depths = points.rows().into_iter().map(|point| depth(half_space, point[2], material));
    let depths: Vec<Depth> = depths.collect::<Result<_, _>>()?;
    // All points of a depth at once: what the waves cause there is worked out for all of them.
    let mut order: Vec<usize> = (0..depths.len()).collect();
    let key = |index: usize| (depths[index].material, depths[index].z);
    order.sort_by(|&a, &b| key(a).partial_cmp(&key(b)).expect("depths are numbers"));
    let (field, mut stresses) = (kept.field(), Array2::zeros([depths.len(), 6]));
    for level in order.chunk_by(|&a, &b| depths[a] == depths[b]).flat_map(|level| level.chunks(CHUNK)) {
        if listener.stops() {
            return Err(STOPPED.to_owned());
        }
        let places: Vec<[f64; 2]> = level.iter().map(|&index| [points[[index, 0]], points[[index, 1]]]).collect();
        for (&index, state) in level.iter().zip(field.points(depths[level[0]], &places)) {
            let [stress @ .., _, _, _] = state.components();
            stresses.row_mut(index).iter_mut().zip(stress).for_each(|(to, value): (&mut f64, f64)| *to = value);
        }
    }
    Ok(stresses)
}

/// Bytes that a point of a plane takes: its twelve components, and the six fields they are transformed from.
const POINT: u64 = 8 * 12 + 16 * 6;

/// Points of a plane along a₁ and a₂, for which there is room.
fn counts(points: &[i64]) -> Result<[usize; 2], String> {
    let counts: Vec<u64> = points.iter().filter_map(|&n| u64::try_from(n).ok()).filter(|&n| n > 0).collect();
    let [n1, n2] = counts[..] else {
        return Err(format!("points are two numbers above 0, those along a₁ and a₂, not {points:?}"));
    };
    let (needed, there) = (n1.saturating_mul(n2).saturating_mul(POINT), available_memory());
    if needed > there {
        return Err(format!(
            "{n1} × {n2} points take about {} of memory, and {} are available",
            bytes(needed),
            bytes(there)
        ));
    }
    Ok([n1 as usize, n2 as usize])
}

/// The twelve components xx, yy, zz, xy, xz, yz, u_x, u_y, u_z, τ₁, von Mises, σ₁ on a plane: (12, n₁, n₂), and the
/// material it is in.
pub fn plane(
    kept: &Kept,
    z: f64,
    points: Option<Vec<i64>>,
    material: Option<i64>,
    listener: &Listener,
) -> Result<(Array3<f64>, usize), String> {
    let depth = depth(kept.step.problem().half_space(), z, material)?;
    let points = points.map_or(Ok(kept.step.grid().points()), |points| counts(&points))?;
    let (field, [n1, n2]) = (kept.field(), points);
    let mut all = Array3::zeros([12, n1, n2]);
    let mut row = 0;
    field.stresses_by_rows(depth, points, |rows| {
        let count = rows.len_of(Axis(1));
        all.slice_mut(s![..6, row..row + count, ..]).assign(&rows.slice(s![..6, .., ..]));
        all.slice_mut(s![9.., row..row + count, ..]).assign(&rows.slice(s![6.., .., ..]));
        row += count;
        if listener.stops() { Err(STOPPED.to_owned()) } else { Ok(()) }
    })?;
    row = 0;
    field.displacements_by_rows(depth, points, |rows| {
        let count = rows.len_of(Axis(1));
        all.slice_mut(s![6..9, row..row + count, ..]).assign(&rows);
        row += count;
        if listener.stops() { Err(STOPPED.to_owned()) } else { Ok(()) }
    })?;
    Ok((all, depth.material))
}

/// The same on a vertical section: (12, rows, points).
pub fn section(kept: &Kept, line: &SurfaceLine, depths: &[Depth]) -> Array3<f64> {
    let states = kept.field().section(line, depths).states;
    let (rows, points) = states.dim();
    let mut all = Array3::zeros([12, rows, points]);
    for ((row, point), state) in states.indexed_iter() {
        let components = state.components().into_iter().chain(state.derived());
        all.slice_mut(s![.., row, point]).iter_mut().zip(components).for_each(|(to, value)| *to = value);
    }
    all
}

/// The stresses asked for by a case whose key `stress.section` has this value.
pub fn request(case: &Case, cut: &Value) -> Result<StressRequest, String> {
    // Where its indenters are is all that counts: of a topography there are none, and its heights need not be read.
    let mut table: toml::Table = toml::from_str(&case.to_toml()).map_err(|error| error.to_string())?;
    if case.counterbody().topography().is_some() {
        let flat = "heights = \"flat.npy\"".parse::<toml::Table>().map_err(|error| error.to_string())?;
        table.insert("surface".to_owned(), Value::Table(flat));
        table.remove("grid");
    }
    let flat = percoat::output::npy_bytes(&[4, 4], [0.0, 1.0].repeat(8)).map_err(|error| error.to_string())?;
    let source = Source {
        name: "section".to_owned(),
        text: toml::to_string(&table).map_err(|error| error.to_string())?,
        files: [("flat.npy".to_owned(), flat.into())].into(),
        ..Source::default()
    };
    let with_section =
        Case::read(&source, &[format!("stress.section={}", written(cut))]).map_err(|error| error.to_string())?;
    Ok(with_section.run().stress.unwrap_or_default())
}
