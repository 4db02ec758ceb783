//! Stresses and displacements of a field at points, on planes and on sections, as arrays.

use crate::work::{Listener, Reason};
use ndarray::{Array2, Array3, ArrayView2, Axis, s};
use percoat::machine::{available_memory, bytes};
use percoat::stress::{Compliance, StrainState};
use percoat::{Depth, HalfSpace, StressField, SurfaceLine};

/// The depth z ≥ 0 in the material of this number, from 1; without one, in the upper of two that meet there.
fn depth(half_space: &HalfSpace, z: f64, material: Option<i64>) -> Result<Depth, String> {
    if !(z >= 0.0 && z.is_finite()) {
        return Err(format!("z = {z} is not in the body: depths are 0 or more, finite"));
    }
    let depths = half_space.depths(z);
    if depths.is_empty() {
        return Err(format!("z = {z} is not in the body: its rigid base is at {}", half_space.base_depth()));
    }
    let Some(wanted) = material else { return Ok(depths[0]) };
    depths.iter().find(|depth| depth.material as i64 == wanted).copied().ok_or_else(|| {
        let numbers: Vec<String> = depths.iter().map(|depth| depth.material.to_string()).collect();
        format!("z = {z} is in material {}, not in {wanted}", numbers.join(" and "))
    })
}

/// Points between two checks whether the work has been stopped.
const CHUNK: usize = 256;

/// The compliance of the material at a depth.
fn compliance(field: &StressField, depth: Depth) -> Compliance {
    field.half_space().material(depth.material).into()
}

/// σ_xx, σ_yy, σ_zz, σ_xy, σ_xz, σ_yz (n, 6) at points x, y, z (n, 3); with `strain` ε_xx … ε_yz instead.
pub fn at_points(
    field: &StressField,
    points: ArrayView2<'_, f64>,
    (material, strain): (Option<i64>, bool),
    listener: &Listener,
) -> Result<Array2<f64>, Reason> {
    if points.iter().any(|x| !x.is_finite()) {
        return Err("a point has a coordinate that is no finite number".into());
    }
    let cell = field.grid().cell();
    if let Some(point) = points.rows().into_iter().find(|point| !cell.contains([point[0], point[1]])) {
        let [a1, a2] = cell.vectors();
        return Err(format!(
            "({}, {}) is beyond the window of {} × {} around the isolated contact: enlarge lattice.size",
            point[0], point[1], a1[0], a2[1]
        )
        .into());
    }
    let depths = points.rows().into_iter().map(|point| depth(field.half_space(), point[2], material));
    let depths: Vec<Depth> = depths.collect::<Result<_, _>>()?;
    // The points of a depth one after another: they share the response of each wave there.
    let mut order: Vec<usize> = (0..depths.len()).collect();
    let key = |index: usize| (depths[index].material, depths[index].z);
    order.sort_by(|&a, &b| key(a).partial_cmp(&key(b)).expect("depths are numbers"));
    let mut found = Array2::zeros([depths.len(), 6]);
    for level in order.chunk_by(|&a, &b| depths[a] == depths[b]).flat_map(|level| level.chunks(CHUNK)) {
        listener.check()?;
        let places: Vec<[f64; 2]> = level.iter().map(|&index| [points[[index, 0]], points[[index, 1]]]).collect();
        for (&index, state) in level.iter().zip(field.points(depths[level[0]], &places)) {
            let [stress @ .., _, _, _] = state.components();
            let values = if strain { compliance(field, depths[index]).strain(&state).components() } else { stress };
            found.row_mut(index).iter_mut().zip(values).for_each(|(to, value): (&mut f64, f64)| *to = value);
        }
    }
    Ok(found)
}

/// Components of a state, and those of a strain.
const STRESSES: usize = 12;
const STRAINS: usize = StrainState::NAMES.len();

/// Components of a plane or section, with those of its `strain`.
fn components(strain: bool) -> usize {
    STRESSES + if strain { STRAINS } else { 0 }
}

/// Numbers of points along a₁ and a₂: refused unless both are above 0 and memory holds the components of the plane, with those of its
/// `strain`, and the six fields from which they are transformed.
pub fn counts(points: &[i64], strain: bool) -> Result<[usize; 2], String> {
    let counts: Vec<u64> = points.iter().filter_map(|&n| u64::try_from(n).ok()).filter(|&n| n > 0).collect();
    let [n1, n2] = counts[..] else {
        return Err(format!("points are two numbers above 0, those along a₁ and a₂, not {points:?}"));
    };
    let (needed, there) =
        (n1.saturating_mul(n2).saturating_mul(8 * components(strain) as u64 + 16 * 6), available_memory());
    if needed > there {
        return Err(format!(
            "{n1} × {n2} points take about {} of memory, and {} are available",
            bytes(needed),
            bytes(there)
        ));
    }
    Ok([n1 as usize, n2 as usize])
}

/// The twelve components xx, yy, zz, xy, xz, yz, u_x, u_y, u_z, τ₁, von Mises, σ₁ (12, n₁, n₂) at n₁ × n₂ points of a plane, and
/// the number of its material, from 1; with `strain` the numbers of its strains follow, (22, n₁, n₂).
pub fn plane(
    field: &StressField,
    z: f64,
    points: [usize; 2],
    (material, strain): (Option<i64>, bool),
    listener: &Listener,
) -> Result<(Array3<f64>, usize), Reason> {
    let depth = depth(field.half_space(), z, material)?;
    let [n1, n2] = points;
    let mut all = Array3::zeros([components(strain), n1, n2]);
    let (mut row, compliance) = (0, compliance(field, depth));
    field.stresses_by_rows(depth, points, |rows| {
        let count = rows.len_of(Axis(1));
        all.slice_mut(s![..6, row..row + count, ..]).assign(&rows.slice(s![..6, .., ..]));
        all.slice_mut(s![9..STRESSES, row..row + count, ..]).assign(&rows.slice(s![6.., .., ..]));
        if strain {
            all.slice_mut(s![STRESSES.., row..row + count, ..]).assign(&compliance.strains(rows));
        }
        row += count;
        listener.check()
    })?;
    row = 0;
    field.displacements_by_rows(depth, points, |rows| {
        let count = rows.len_of(Axis(1));
        all.slice_mut(s![6..9, row..row + count, ..]).assign(&rows);
        row += count;
        listener.check()
    })?;
    Ok((all, depth.material))
}

/// The twelve components on a vertical section (12, rows, points), with `strain` 22 (22, rows, points), a row a depth.
pub fn section(field: &StressField, line: &SurfaceLine, depths: &[Depth], strain: bool) -> Array3<f64> {
    let states = field.section(line, depths).states;
    let (rows, points) = states.dim();
    let mut all = Array3::zeros([components(strain), rows, points]);
    for ((row, point), state) in states.indexed_iter() {
        let strains = strain.then(|| compliance(field, depths[row]).strain(state).all());
        let components = state.components().into_iter().chain(state.derived()).chain(strains.into_iter().flatten());
        all.slice_mut(s![.., row, point]).iter_mut().zip(components).for_each(|(to, value)| *to = value);
    }
    all
}
