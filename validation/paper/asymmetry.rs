//! Possible causes of an asymmetry of 12 % of the third level's contact: every load, the other arrangement of three
//! levels on a hexagonal lattice, other meanings of "distance", and the raster of square elements.

use super::model::Model;
use super::spot::{self, Raster, asymmetries};
use crate::{Data, StudyError};
use percoat_core::load::Load;
use percoat_core::localized::mesh::Mesh;
use percoat_core::localized::{CircleRadius, Coupled};
use percoat_core::numeric::least_squares;
use percoat_core::reading::{LevelReading, Reading, first_touches};
use rayon::prelude::*;
use std::f64::consts::PI;

/// Overrides that put the levels in rows, n₁ mod 3, instead of (n₁ − n₂) mod 3: of the four sublattices that hold
/// every third site of a hexagonal lattice three are rows, equal but for a rotation.
pub const ROWS: [&str; 4] = [
    "lattice={ kind = \"oblique\", a1 = [1.0, 0.0], a2 = [1.5, 2.598076211353316] }",
    "levels.0.sites=[[0.0, 0.0]]",
    "levels.1.sites=[[0.0, 0.3333333333333333]]",
    "levels.2.sites=[[0.0, 0.6666666666666666]]",
];

/// Samples along the cell of the three-fold arrangement.
const POINTS: usize = 192;
/// Ratio of load steps from the first touch of level 3 on, and the one within which the last load is enclosed.
const RATIO: f64 = 1.8;
const LAST: f64 = 1.02;
/// Contact diameter over the distance of the indenters up to which boundaries are read. Beyond, contacts become the cells
/// around the indenters; their asymmetry tends to 1 − √3/2 for every level.
const APART: f64 = 0.8;
/// Samples per contact radius from which an asymmetry of a thousandth is more than noise.
const RESOLVED: f64 = 12.0;

/// Part of the load of first touch at which the gap is measured, and how far around the apex, over l.
const BEFORE_TOUCH: f64 = 0.98;
const AROUND: f64 = 0.06;

/// One arrangement and parameter set over all loads at which the third level's contact is resolved.
pub struct Course {
    /// Mean pressure, asymmetries of levels 1, 2, 3; while contacts stand apart.
    pub rows: Vec<[f64; 4]>,
}

impl Course {
    /// The course from `first` on, a load soon after the first touch of level 3.
    pub fn new(model: &Model, first: f64) -> Result<Self, StudyError> {
        let mut steps = model.steps_as_dense(POINTS)?;
        let mut rows: Vec<[f64; 4]> = Vec::new();
        let (mut load, mut ratio) = (first, RATIO);
        while ratio > LAST {
            let found = steps.loaded(load)?;
            let far = |level: &LevelReading| level.contact_radius.is_some_and(|a| 2.0 * a < APART * model.distance());
            if !found.levels.iter().all(far) {
                // Back to the last load with contacts apart, and on by smaller steps.
                load /= ratio;
                ratio = ratio.sqrt();
            } else {
                let [a, b, c] = asymmetries(&found);
                if found.levels[2].resolution >= RESOLVED {
                    rows.push([load, a, b, c]);
                }
            }
            load *= ratio;
        }
        Ok(Self { rows })
    }

    /// Largest asymmetry of level 3 at any load.
    pub fn largest(&self) -> f64 {
        self.rows.iter().map(|row| row[3]).fold(f64::NAN, f64::max)
    }

    /// Largest asymmetry of level 3 over that of level 2 at any load.
    pub fn largest_ratio(&self) -> f64 {
        self.rows.iter().map(|row| row[3] / row[2]).fold(f64::NAN, f64::max)
    }
}

/// The third level's contact at its first touch: a small ellipse between the curvatures κ₁ ≤ κ₂ of the gap, whose
/// centre lies off the axis by its slope over its curvature where the neighbours are unequal.
pub struct Touch {
    /// Asymmetry from the centre of the contact: 1 − (κ₁/κ₂)^{2/3}, for κ₁ near κ₂.
    pub ellipse: f64,
    /// Distance of the centre from the axis, a length.
    pub shift: f64,
}

/// The touch of level 3 from the gap shortly before it.
pub fn at_touch(model: &Model) -> Result<Touch, StudyError> {
    let mut steps = model.steps_as_dense(POINTS)?;
    let touch = first_touches(&mut steps.solver)[2].ok_or("level 3 is hidden")?.mean_pressure;
    let step = steps.step(Load::MeanPressure(BEFORE_TOUCH * touch))?;
    let (grid, surface, gap) = (step.grid(), step.surface(), step.finest().gaps());
    let reduced = grid.cell().reduced();
    let site = surface.site_of(3).ok_or("no level 3")? as u32;
    let rows = (0..grid.len()).filter_map(|index| {
        let [x, y] = surface.offset(&reduced, site, index).map(|x| x / AROUND);
        (x.hypot(y) < 1.0).then(|| (vec![1.0, x, y, x * x, x * y, y * y], gap[index]))
    });
    let c = least_squares::fit(6, rows).ok_or("too few samples around the apex")?;
    let (mean, deviation) = (0.5 * (c[3] + c[5]), 0.5 * (c[3] - c[5]).hypot(c[4]));
    Ok(Touch {
        ellipse: 1.0 - ((mean - deviation) / (mean + deviation)).powf(2.0 / 3.0),
        shift: c[1].hypot(c[2]) / (2.0 * mean) * AROUND,
    })
}

impl Touch {
    /// Radius of the contact whose asymmetry, seen from the axis, is `asymmetry`: 2s/(a + s).
    pub fn radius(&self, asymmetry: f64) -> f64 {
        self.shift * (2.0 - asymmetry) / asymmetry
    }
}

/// Asymmetry of level 3 at one load, read in different ways.
pub struct Readings {
    /// Asymmetry from the axis, over the largest distance: the paper's words.
    pub plain: f64,
    /// Asymmetry over the mean distance.
    pub over_mean: f64,
    /// Asymmetry from the centre of the contact's area.
    pub from_centroid: f64,
    /// Asymmetry of the line where the pressure is half of its peak.
    pub contour: f64,
}

impl Readings {
    pub fn new(model: &Model, mean_pressure: f64, points: usize) -> Result<Self, StudyError> {
        let mut steps = model.steps(points)?;
        let step = steps.step(Load::MeanPressure(mean_pressure))?;
        let boundary = spot::boundary(&step, 3)?;
        let [plain, over_mean] = spot::asymmetry(&boundary.radii);
        let [from_centroid, _] = spot::asymmetry(&spot::from_centroid(&boundary));
        let [contour, _] = spot::asymmetry(&spot::contour(&step, 3, 0.5));
        Ok(Self { plain, over_mean, from_centroid, contour })
    }
}

/// Asymmetry of level 3, seen from its axis, if of all its neighbours one of level 1 alone is near, as in a circle with
/// too few indenters: the point load P at the distance l tilts the surface by P/(πE₁*l²), and the contact moves off by
/// R times that.
pub fn one_neighbour(model: &Model, found: &Reading) -> Result<f64, StudyError> {
    let radius = found.levels[2].contact_radius.ok_or("merged contacts")?;
    let curvature = model.indenters()?[2].curvature;
    let modulus = model.case().half_space().surface_material().contact_modulus();
    let shift = curvature * found.levels[0].load / (PI * modulus * model.distance().powi(2));
    Ok(2.0 * shift / (radius + shift))
}

/// Asymmetries of levels 1, 2, 3 of localized solutions with circles of 7 to 37 indenters, from the
/// fitted boundary.
pub fn localized(model: &Model, mean_pressure: f64) -> Result<Data, StudyError> {
    let mut data = Data::new("localized", &["indenters", "level_1", "level_2", "level_3"]);
    for indenters in [7, 13, 37] {
        let (_, solution) = model.localized_solution(mean_pressure, indenters, 48)?;
        let mut row = vec![indenters as f64];
        for spot in &solution.spots {
            let outline = spot.outline().ok_or("a spot of too few elements")?;
            row.push(spot::asymmetry(&outline.radii)[0]);
        }
        data.rows.push(row);
    }
    Ok(data)
}

/// Asymmetries of levels 1, 2, 3 counted in the elements of localized solutions with 7 indenters in the circle, each
/// the mean over a window of one element, against the number of elements across the first level's contact.
pub fn localized_elements(model: &Model, mean_pressure: f64) -> Result<Data, StudyError> {
    let mut data = Data::new("localized-elements", &["elements_across_level_1", "level_1", "level_2", "level_3"]);
    let (localized, start) = model.localized_solution(mean_pressure, 7, 24)?;
    let diameter = 2.0 * start.spots[0].contact_radius();
    for across in [11.0, 15.0, 19.0, 23.0, 25.0, 27.0, 31.0, 39.0] {
        const WINDOW: usize = 6;
        let counted = (0..WINDOW).into_par_iter().map(|k| {
            let size = diameter / (across - 0.5 + (k as f64 + 0.5) / WINDOW as f64);
            let mesh = Mesh { width: (1.4 * across / 2.0) as usize * 2 + 1, size };
            let load = Load::MeanPressure(mean_pressure);
            let solution =
                Coupled::new(localized.system(), mesh, 7, true).solve(load, CircleRadius::LoadBalanced, Some(&start));
            [0, 1, 2].map(|m| spot::counted(&solution.spots[m]))
        });
        let counted: Vec<[f64; 3]> = counted.collect();
        let mean = |m: usize| counted.iter().map(|row| row[m]).sum::<f64>() / WINDOW as f64;
        data.rows.push(vec![across, mean(0), mean(1), mean(2)]);
    }
    Ok(data)
}

/// Asymmetry that counting square elements gives circles of the radii of the three levels, against the number of
/// elements across the first level's contact; the mean over both placements of the raster and a window of one element.
pub fn elements(radii: [f64; 3]) -> Data {
    let mut data = Data::new("elements", &["elements_across_level_1", "level_1", "level_2", "level_3"]);
    for across in 4..=60 {
        let across = f64::from(across);
        let row = radii.map(|radius| {
            let mean = |raster| {
                let window = (0..=20).map(|k| 0.5 * (across - 0.5 + f64::from(k) / 20.0) * radius / radii[0]);
                window.map(|radius| spot::staircase(radius, raster)).sum::<f64>() / 21.0
            };
            0.5 * (mean(Raster::Centred) + mean(Raster::Cornered))
        });
        data.rows.push([across, row[0], row[1], row[2]].to_vec());
    }
    data
}
