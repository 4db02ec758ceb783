//! Coupling where the surface is incompressible: none on a half-space, some on a coating.

use super::super::kernel::Reference;
use super::super::{Data, StudyError};
use percoat_core::body::{HalfSpace, Interface, Layer, Material};
use percoat_core::counterbody::{Indenters, Level, Shape};
use percoat_core::friction::Friction;
use percoat_core::lattice::{Cell, Grid, Lattice};
use percoat_core::load::Load;
use percoat_core::problem::Problem;
use percoat_core::spectral::{LayeredOperator, Workspace};
use percoat_core::spectral::{Settings, Solver};
use std::f64::consts::TAU;

/// Largest change of the pressure under spheres by friction of μ = 1, over the largest pressure: on an incompressible
/// half-space, and under a soft incompressible coating.
pub fn change() -> Result<[f64; 2], StudyError> {
    let incompressible = Material::from_young(1.0, 0.5)?;
    let soft = Layer::new(Material::from_young(0.2, 0.5)?, 0.1, Interface::Bonded)?;
    let bare = HalfSpace::new(vec![], incompressible);
    let coated = HalfSpace::new(vec![soft], Material::from_young(1.0, 0.3)?);
    let change = |half_space: HalfSpace| -> Result<f64, StudyError> {
        let sphere = Level::new(Shape::Paraboloid { radius: 0.8 }, 0.0)?;
        let still = Problem::new(Indenters::new(Lattice::square(1.0, 1)?, vec![sphere])?, half_space);
        let moving = still.clone().sliding(Friction::new(1.0, [2.0, 1.0])?)?;
        let mut pressures = Vec::new();
        for problem in [still, moving] {
            let step = Solver::new(problem, [48; 2], Settings::default())?.solve(Load::MeanPressure(0.02));
            if !step.report.stop.solved() {
                return Err(step.report.to_string().into());
            }
            pressures.push(step.pressure().to_owned());
        }
        let largest = pressures[0].iter().fold(0.0, |most: f64, &p| most.max(p));
        Ok(pressures[0].iter().zip(&pressures[1]).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs())) / largest)
    };
    Ok([change(bare)?, change(coated)?])
}

/// Stacks of `kernel/tangential.jsonl` whose surface is incompressible: what μ = 1 adds to the displacement under a wave,
/// found and known, over the larger of what that traction displaces along and across the surface.
pub fn stacks() -> Result<Data, StudyError> {
    let mut data = Data::new("incompressible", &["layers", "shear", "thickness", "added", "known"]);
    for line in include_str!("../kernel/tangential.jsonl").lines() {
        let reference = Reference::read(line)?;
        let half_space = &reference.half_space;
        let Some(layer) = half_space.layers().first().filter(|layer| layer.material().poisson() == 0.5) else {
            continue;
        };
        const POINTS: usize = 8;
        let grid = Grid::new(Cell::square(TAU / reference.wavenumber)?, [POINTS; 2])?;
        let mut operator = LayeredOperator::sliding(&grid, half_space, &Friction::new(1.0, [1.0, 0.0])?);
        let mut field: Vec<f64> =
            (0..POINTS * POINTS).map(|k| (TAU * (k / POINTS) as f64 / POINTS as f64).cos()).collect();
        operator.displacement(&mut field, &mut Workspace::default());
        // C cos + μK sin
        let added = 2.0 / (POINTS * POINTS) as f64
            * field.iter().enumerate().map(|(k, u)| u * (TAU * (k / POINTS) as f64 / POINTS as f64).sin()).sum::<f64>();
        let [along, vertical] = reference.along()?;
        let scale = along.max(vertical.abs());
        data.rows.push(vec![
            half_space.layers().len() as f64,
            layer.material().shear() / half_space.material(half_space.material_count()).shear(),
            layer.thickness() * reference.wavenumber,
            added / scale,
            vertical / scale,
        ]);
    }
    Ok(data)
}
