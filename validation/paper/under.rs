//! Stresses under an indenter of the first level, for Figs 6 and 7.

use super::model::Model;
use crate::StudyError;
use ndarray::Array2;
use percoat_core::body::{Depth, MeanStress};
use percoat_core::load::Load;
use percoat_core::stress::{StressField, StressState, SurfaceLine};
use percoat_draw::contour::zero_lines;

pub const LOAD: f64 = 0.002;
const POINTS: usize = 320;
/// Errors of the mesh over E₂, under the centre and at the interface: from 320 to 480 points stresses move by up to
/// 7e-7, on the surface by 1.5e-6.
pub const INSIDE: f64 = 2e-6;
pub const SURFACE: f64 = 5e-6;
/// Error of the mesh at the edge of the contact, relative: stresses move there by 5 %.
pub const EDGE: f64 = 0.06;
/// Direction from level 1 toward the neighbouring level 2.
const TOWARD: [f64; 2] = [0.866_025_403_784_438_6, 0.5];
/// Intervals of a section across, and down in each material.
const COLUMNS: usize = 120;
const ROWS: usize = 40;
/// Points of a line.
const LINE: usize = 161;

/// σ_r and τ₁ on a line from the axis: distance, σ_r, τ₁.
pub type Profile = Vec<[f64; 3]>;

/// Stresses under level 1.
pub struct Under {
    /// Contact radius a over r₁.
    pub radius: f64,
    /// h over r₁.
    pub thickness: f64,
    /// Distance of neighbouring indenters over r₁.
    pub period: f64,
    /// Levels that touch.
    pub levels: usize,
    /// Profiles at the surface, at the interface in the coating and in the substrate.
    pub profiles: [Profile; 3],
    field: StressField,
}

fn radial(state: &StressState) -> f64 {
    let [x, y] = TOWARD;
    state.xx * x * x + 2.0 * state.xy * x * y + state.yy * y * y
}

impl Under {
    /// `name`, with overrides, at its nominal pressure.
    pub fn new(name: &str, overrides: &[&str], mean: MeanStress) -> Result<Self, StudyError> {
        let model = Model::new(name, overrides)?;
        let mut steps = model.steps(POINTS)?;
        let (step, found) = steps.solve(Load::MeanPressure(LOAD))?;
        let radius = found.levels[0].contact_radius.ok_or("merged contacts")?;
        let field = StressField::new(step.finest(), mean);
        let (thickness, period) = (model.thickness(), model.distance());
        let depths = [(0.0, 1), (thickness, 1), (thickness, 2)].map(|(z, material)| Depth { z, material });
        let line = SurfaceLine { origin: [0.0; 2], direction: TOWARD, span: [0.0, period], points: LINE };
        let section = field.section(&line, &depths);
        let profile = |k: usize| -> Profile {
            line.distances()
                .iter()
                .zip(section.states.row(k))
                .map(|(&r, state)| [r, radial(state), state.tau1()])
                .collect()
        };
        Ok(Self {
            radius,
            thickness,
            period,
            levels: found.levels.iter().filter(|level| level.load > 0.0).count(),
            profiles: [profile(0), profile(1), profile(2)],
            field,
        })
    }

    /// Largest τ₁ in the coating, its depth over h, and the largest σ₁ anywhere.
    pub fn maxima(&self) -> [f64; 3] {
        let maxima = self.field.maxima([self.radius; 2]);
        let shear = maxima.materials[0].tau1;
        let tension =
            maxima.materials.iter().fold(f64::NEG_INFINITY, |most, material| most.max(material.tension.value));
        [shear.value, shear.position[2] / self.thickness, tension]
    }

    /// σ_r on the axis: at the surface, at the interface in the coating and in the substrate.
    pub fn centre(&self, curve: usize) -> f64 {
        self.profiles[curve][0][1]
    }

    /// Largest σ_r of a curve between two distances, in contact radii, and where it is.
    pub fn largest(&self, curve: usize, from: f64, to: f64) -> [f64; 2] {
        let within = |row: &&[f64; 3]| row[0] >= from * self.radius && row[0] <= to * self.radius;
        let rows = self.profiles[curve].iter().filter(within);
        rows.fold(
            [f64::NEG_INFINITY, f64::NAN],
            |best, row| {
                if row[1] > best[0] { [row[1], row[0] / self.radius] } else { best }
            },
        )
    }

    /// σ_r and τ₁ in each material on a section `wide` contact radii to both sides of the axis and `deep` thicknesses
    /// down.
    pub fn section(&self, wide: f64, deep: f64) -> [Part; 2] {
        let span = wide * self.radius;
        let line = SurfaceLine { origin: [0.0; 2], direction: TOWARD, span: [-span, span], points: COLUMNS + 1 };
        [(1, [0.0, 1.0]), (2, [1.0, deep])].map(|(material, [top, bottom])| {
            let z = |j: usize| top + (bottom - top) * j as f64 / ROWS as f64;
            let depths: Vec<Depth> = (0..=ROWS).map(|j| Depth { z: z(j) * self.thickness, material }).collect();
            let states = self.field.section(&line, &depths).states;
            Part { wide, depths: [top, bottom], values: states.map(|state| [radial(state), state.tau1()]) }
        })
    }
}

/// The part of a section that lies in one material.
pub struct Part {
    wide: f64,
    /// First and last z/h.
    depths: [f64; 2],
    /// σ_r and τ₁, row by row from the top.
    values: Array2<[f64; 2]>,
}

impl Part {
    /// x/a, z/h, σ_r, τ₁ at every sample.
    pub fn samples(&self) -> impl Iterator<Item = [f64; 4]> {
        self.values.indexed_iter().map(move |((j, i), &[radial, shear])| {
            let [x, z] = self.place([i as f64 / COLUMNS as f64, j as f64 / ROWS as f64]);
            [x, z, radial, shear]
        })
    }

    fn place(&self, [x, z]: [f64; 2]) -> [f64; 2] {
        let [top, bottom] = self.depths;
        [self.wide * (2.0 * x - 1.0), top + z * (bottom - top)]
    }

    /// The line on which σ_r (`quantity` 0) or τ₁ (1) has the value `level`: pieces, a point that is no number between.
    pub fn line(&self, quantity: usize, level: f64) -> Vec<[f64; 2]> {
        let index = |part: f64, count: usize| (part * count as f64).round() as usize;
        let value = |[x, z]: [f64; 2]| Some(self.values[[index(z, ROWS), index(x, COLUMNS)]][quantity] - level);
        let place = |line: Vec<[f64; 2]>| line.into_iter().map(|part| self.place(part)).chain([[f64::NAN; 2]]);
        zero_lines(COLUMNS, ROWS, value).into_iter().flat_map(place).collect()
    }
}
