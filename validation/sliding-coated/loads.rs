//! Stresses under a pressure and a traction √(1−r²) on a bonded coating, against integrals over wavenumbers.
//!
//! Inside, the pressure is given by its Fourier components 2π(sin k − k cos k)/k³ themselves, up to the shortest wave of the
//! grid: those that are missing have died off as e^{−πz/d} at the depth z. What is left is the images of the load, whose sum
//! falls in powers of the cell's side from L⁻³ on, as the mean state is that of the half-space.

use super::super::{Data, StudyError};
use ndarray::{Array2, ArrayView2};
use percoat_core::body::{Depth, HalfSpace, Interface, Layer, Material, MeanStress};
use percoat_core::friction::Friction;
use percoat_core::lattice::{Cell, Grid};
use percoat_core::stress::{StressField, StressState};
use std::f64::consts::TAU;
use std::sync::Arc;

const POISSON: f64 = 0.3;
/// E₁/E₂.
pub const RATIOS: [f64; 2] = [4.0, 0.5];
/// Sides of the cells, radii.
pub const SIDES: [usize; 3] = [24, 48, 96];
/// Samples per radius inside, where the shortest waves have died off …
const PER_RADIUS: usize = 10;
/// … and of a sampled pressure.
pub const SAMPLED: [usize; 3] = [8, 16, 32];

pub fn table() -> Result<Data, StudyError> {
    Ok(Data::parse("stresses", include_str!("stresses.csv"))?)
}

fn coated(ratio: f64) -> Result<HalfSpace, StudyError> {
    let coating = Layer::new(Material::from_young(ratio, POISSON)?, 1.0, Interface::Bonded)?;
    Ok(HalfSpace::new(vec![coating], Material::from_young(1.0, POISSON)?))
}

/// The field of a load of unit pressure, and that of unit traction in +x too.
fn fields(grid: &Arc<Grid>, pressure: ArrayView2<'_, f64>, ratio: f64) -> Result<[StressField; 2], StudyError> {
    let half_space = coated(ratio)?;
    let friction = Friction::new(1.0, [1.0, 0.0])?.uncoupled();
    let field = |friction| StressField::under(grid, pressure, &half_space, friction, MeanStress::HalfSpace);
    Ok([field(None)?, field(Some(&friction))?])
}

/// The pressure that has the components of √(1−r²), up to the shortest waves of the grid.
fn resolved(side: f64, points: usize) -> Array2<f64> {
    let transform = |k: f64| if k == 0.0 { TAU / 3.0 } else { TAU * (k.sin() - k * k.cos()) / k.powi(3) };
    let half = points / 2;
    let component = |(i, j): (usize, usize)| {
        let k = TAU / side * (i as f64).hypot(j as f64);
        let waves = [i, j].map(|m| if m == 0 { 1.0 } else { 2.0 });
        waves[0] * waves[1] * transform(k) / (side * side)
    };
    let cosines = Array2::from_shape_fn((points, half), |(i, m)| (TAU * (i * m % points) as f64 / points as f64).cos());
    cosines.dot(&Array2::from_shape_fn((half, half), component)).dot(&cosines.t())
}

/// √(1−r²) at the samples.
fn sampled(side: f64, points: usize) -> Array2<f64> {
    let away = |i: usize| i.min(points - i) as f64 * side / points as f64;
    Array2::from_shape_fn((points, points), |(i, j)| (1.0 - away(i).powi(2) - away(j).powi(2)).max(0.0).sqrt())
}

fn components(state: &StressState) -> [f64; 4] {
    [state.xx, state.yy, state.zz, state.xz]
}

/// σ_x, σ_y, σ_z, τ_xz of the pressure and of the traction alone at a place of the table.
fn at(fields: &[StressField; 2], [x, z, material]: [f64; 3]) -> [[f64; 4]; 2] {
    let depth = Depth { z, material: material as usize };
    let [normal, both] = [0, 1].map(|k| components(&fields[k].points(depth, &[[x, 0.0]])[0]));
    [normal, std::array::from_fn(|k| both[k] - normal[k])]
}

/// The table's rows of a ratio below the surface, those of the pressure and of the traction at each place together.
fn pairs(table: &Data, ratio: f64) -> impl Iterator<Item = &[Vec<f64>]> {
    table.rows.chunks(2).filter(move |rows| rows[0][0] == ratio && rows[0][2] > 0.0)
}

/// Columns: the place, then the table's stresses, those of each cell, and those extrapolated from L⁻³ and L⁻⁴.
pub fn inside() -> Result<Data, StudyError> {
    let mut columns: Vec<String> =
        ["ratio", "x", "z", "material", "tangential", "component", "table"].map(Into::into).into();
    columns.extend(SIDES.map(|side| format!("side_{side}")));
    columns.push("extrapolated".into());
    let mut data = Data { name: "inside", columns, rows: Vec::new() };
    let pressures: Vec<(Arc<Grid>, Array2<f64>)> = SIDES
        .iter()
        .map(|&side| {
            let points = side * PER_RADIUS;
            let grid = Grid::new(Cell::square(side as f64)?, [points; 2])?;
            Ok((Arc::new(grid), resolved(side as f64, points)))
        })
        .collect::<Result<_, StudyError>>()?;
    let table = table()?;
    for ratio in RATIOS {
        let fields: Vec<[StressField; 2]> =
            pressures.iter().map(|(grid, pressure)| fields(grid, pressure.view(), ratio)).collect::<Result<_, _>>()?;
        for rows in pairs(&table, ratio) {
            let place = [rows[0][1], rows[0][2], rows[0][3]];
            let found: Vec<[[f64; 4]; 2]> = fields.iter().map(|fields| at(fields, place)).collect();
            for ((load, row), component) in rows.iter().enumerate().flat_map(|row| (0..4).map(move |k| (row, k))) {
                let sides = [0, 1, 2].map(|side| found[side][load][component]);
                let mut values = row[..5].to_vec();
                values.extend([component as f64, row[5 + component]]);
                values.extend(sides);
                values.push(extrapolated(sides));
                data.rows.push(values);
            }
        }
    }
    Ok(data)
}

/// Limit from three sides L, each twice the one before, when errors are made of L⁻³ and L⁻⁴.
fn extrapolated([a, b, c]: [f64; 3]) -> f64 {
    let [ab, bc] = [[a, b], [b, c]].map(|[coarse, fine]| fine + (fine - coarse) / 7.0);
    bc + (bc - ab) / 15.0
}

/// A sampled pressure: by ratio and samples per radius the largest error inside against the resolved one in the same cell, σ_x
/// on the surface at the trailing edge from the traction and in the middle from the pressure against the table, without the
/// images to L⁻³, and the largest tension under both loads with its stated error.
pub fn surface() -> Result<Data, StudyError> {
    let columns = [
        "ratio",
        "per_radius",
        "inside",
        "edge",
        "edge_table",
        "middle",
        "middle_table",
        "tension",
        "stated",
        "tension_table",
    ];
    let mut data = Data::new("surface", &columns);
    let table = table()?;
    let grid = |side: usize, per_radius: usize| -> Result<Arc<Grid>, StudyError> {
        Ok(Arc::new(Grid::new(Cell::square(side as f64)?, [side * per_radius; 2])?))
    };
    for ratio in RATIOS {
        let known = |x: f64, tangential: f64| {
            let row = table.rows.iter().find(|row| row[..5] == [ratio, x, 0.0, 1.0, tangential]);
            row.map_or(f64::NAN, |row| row[5])
        };
        let under = |side: usize, per_radius: usize| {
            fields(&grid(side, per_radius)?, sampled(side as f64, side * per_radius).view(), ratio)
        };
        let on_surface =
            |fields: &[StressField; 2]| [at(fields, [-1.0, 0.0, 1.0])[1][0], at(fields, [0.0, 0.0, 1.0])[0][0]];
        let [near, far] = [SIDES[0], SIDES[1]].map(|side| under(side, SAMPLED[0]).map(|fields| on_surface(&fields)));
        let (near, far) = (near?, far?);
        let images = [0, 1].map(|k| (far[k] - near[k]) * 8.0 / 7.0);
        let side = SIDES[0];
        let resolved = fields(&grid(side, PER_RADIUS)?, resolved(side as f64, side * PER_RADIUS).view(), ratio)?;
        for per_radius in SAMPLED {
            let fields = under(side, per_radius)?;
            let mut worst = 0.0f64;
            for rows in pairs(&table, ratio) {
                let place = [rows[0][1], rows[0][2], rows[0][3]];
                let [found, exact] = [&fields, &resolved].map(|fields| at(fields, place));
                worst = (0..8).fold(worst, |worst, k| worst.max((found[k / 4][k % 4] - exact[k / 4][k % 4]).abs()));
            }
            let [edge, middle] = on_surface(&fields);
            let crest = fields[1].crest().ok_or("no edge of contact")?;
            data.rows.push(vec![
                ratio,
                per_radius as f64,
                worst,
                edge + images[0],
                known(-1.0, 1.0),
                middle + images[1],
                known(0.0, 0.0),
                crest.peak.value,
                crest.error(None) * crest.scale,
                known(-1.0, 0.0) + known(-1.0, 1.0),
            ]);
        }
    }
    Ok(data)
}
