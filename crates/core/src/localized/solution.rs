//! A load step solved by the localized method, and its readings.

use super::circle::CircleRadius;
use super::disc;
use super::exterior::Exterior;
use super::outline::Outline;
use super::spot::Spot;
use super::square::Squares;
use super::system::System;
use crate::numeric::closed_line::mean_radius;
use crate::reading::LevelReading;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;
use std::fmt;
use std::sync::Arc;

/// How a localized solution ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Stop {
    /// Loads change by less than 1e-8 of the whole load, and gaps in contact are less than 1e-9 of the largest displacement.
    Converged,
    /// Not converged: loads still changed, or a gap in contact had not vanished, after 60 passes over the levels or 2000 iterations per spot; or the
    /// prescribed penetration lies beyond complete contact.
    Stalled,
    /// A contact reaches the rim of its mesh.
    Rim,
    /// A contact reaches where a neighbour's surface is nearer: the method needs separate spots.
    Merged,
}

impl fmt::Display for Stop {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Converged => "converged: loads moved by less than 1e-8 of the whole one",
            Self::Stalled => "not converged: loads still moved, or a surface was not met, after 60 passes over the levels or 2000 iterations per spot, or the \
                 penetration lies beyond complete contact",
            Self::Rim => "a contact reaches the rim of its mesh",
            Self::Merged => "merged: a contact reaches under its neighbour",
        })
    }
}

/// Solution of one load step by the localized method.
#[derive(Debug, Clone)]
pub struct Solution {
    pub(super) system: Arc<System>,
    /// Mean pressure p̄, in the unit of Young's modulus.
    pub mean_pressure: f64,
    /// Penetration δ, common to all levels, a length.
    pub penetration: f64,
    /// Rule for what acts outside the circles.
    pub rule: CircleRadius,
    /// Contact spots, one per site of the cell.
    pub spots: Vec<Spot>,
    /// How the iteration ended.
    pub stop: Stop,
    /// Number of passes over the levels.
    pub passes: usize,
}

impl Solution {
    /// The indenters and the half-space.
    pub fn system(&self) -> &Arc<System> {
        &self.system
    }

    /// Additional displacement w_a by Eq. (8): displacement at the highest apex by the pressures inside its circle,
    /// minus that by p̄ on the circle, or plus that by the lattice sum outside it: a length. Summed directly, element by
    /// element.
    ///
    /// Equals the penetration where the highest level touches.
    pub fn additional_displacement(&self) -> f64 {
        let (system, highest) = (&*self.system, self.system.highest());
        let spot = &self.spots[highest];
        let squares = Squares::new(system.kernel(), 0.5 * spot.mesh.size);
        let element = spot.mesh.size * spot.mesh.size;
        let lattice_sum = spot.radius.is_finite() && self.rule == CircleRadius::LatticeSum;
        let exterior = lattice_sum.then(|| Exterior::new(system, spot.mesh, spot.circle.indenters()));
        let circle = exterior.as_ref().map_or(&spot.circle, |exterior| &exterior.circles()[highest]);
        let mut sum = 0.0;
        for (c, (source, images)) in self.spots.iter().zip(&circle.images).enumerate() {
            for (index, &p) in source.pressure.iter().enumerate().filter(|(_, p)| **p > 0.0) {
                let [x, y] = source.mesh.place(index);
                sum += p * images.iter().map(|[u, v]| squares.coefficient(x + u, y + v)).sum::<f64>();
                sum += exterior.as_ref().map_or(0.0, |exterior| p * element * exterior.at(highest, c, [-x, -y]));
            }
        }
        if spot.radius.is_finite() && !lattice_sum {
            sum -= self.mean_pressure * disc::displacement(system.kernel(), spot.radius, 0.0);
        }
        sum
    }

    /// Readings of each level, from the highest down.
    pub fn levels(&self) -> Vec<LevelReading> {
        let whole: f64 = self.spots.iter().map(Spot::load).sum();
        (1..=self.system.levels().len()).map(|level| self.level(level, whole)).collect()
    }

    fn of_level(&self, level: usize) -> impl Iterator<Item = &Spot> {
        self.spots.iter().filter(move |spot| spot.level == level)
    }

    fn level(&self, level: usize, whole: f64) -> LevelReading {
        let spots: Vec<(&Spot, Option<Outline>)> = self.of_level(level).map(|spot| (spot, spot.outline())).collect();
        let count = spots.len() as f64;
        let merged = spots.iter().any(|(spot, _)| spot.merged && spot.touches());
        let load: f64 = spots.iter().map(|(spot, _)| spot.load()).sum();
        // Root mean squares over the indenters: of √(area/π) of the spots, or of a radius of their outlines.
        let mean = |squares: f64| (squares / count).sqrt();
        let radius = |(spot, outline): &(&Spot, Option<Outline>)| {
            outline.as_ref().map_or(spot.counted_radius(), |outline| (outline.area() / PI).sqrt())
        };
        let area = spots.iter().map(|spot| PI * radius(spot).powi(2)).sum::<f64>() / count;
        let contact_radius = (area / PI).sqrt();
        let outlines: Option<Vec<&Outline>> = spots.iter().map(|(_, outline)| outline.as_ref()).collect();
        let ring =
            !merged && spots.iter().any(|(_, outline)| outline.as_ref().is_some_and(|outline| outline.hole > 0.0));
        let rings = outlines.as_ref().filter(|_| ring);
        let radii = || outlines.iter().flatten().flat_map(|outline| outline.radii.iter().copied());
        let radius_min = radii().reduce(f64::min).filter(|_| !merged);
        let radius_max = radii().reduce(f64::max).filter(|_| !merged);
        let shown = spots.iter().map(|(spot, _)| spot.peak()).fold(0.0, f64::max);
        let is_tip = load > 0.0 && self.system.levels()[level - 1].shape().singular_peak();
        let (max_pressure, resolved_peak) = LevelReading::peak_of(shown, is_tip);
        LevelReading {
            level,
            load: load / count,
            load_share: if whole > 0.0 { load / whole } else { 0.0 },
            max_pressure,
            resolved_peak,
            contact_area: area,
            contact_radius: (!merged).then_some(contact_radius),
            ring,
            radius_inner: rings.map(|all| mean(all.iter().map(|outline| outline.hole.powi(2)).sum())),
            radius_outer: rings.map(|all| mean(all.iter().map(|outline| mean_radius(&outline.radii).powi(2)).sum())),
            radius_min,
            radius_max,
            asymmetry: LevelReading::asymmetry_of(radius_min, radius_max),
            merged,
            resolution: contact_radius / spots.iter().map(|(spot, _)| spot.mesh.size).fold(0.0, f64::max),
            ..LevelReading::default()
        }
    }

    /// Radius R of the circle around the indenters of each level, a length; infinite without mutual effect.
    pub fn circle_radii(&self) -> Vec<f64> {
        let mean = |level: usize| {
            self.of_level(level).map(|spot| spot.radius).sum::<f64>() / self.of_level(level).count() as f64
        };
        (1..=self.system.levels().len()).map(mean).collect()
    }
}

impl fmt::Display for Solution {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "localized solution of {} spots, {}; {} passes", self.spots.len(), self.stop, self.passes)
    }
}
