//! Spectral and localized solution of one case side by side.
//!
//! Three things differ between them: the grid of the one, the elements of the other, and what the circle leaves out.
//! Each method is therefore solved at two resolutions, half and full; what a quantity changes between them bounds its
//! discretisation error, since both converge at first order or faster. What remains of the difference is the error of
//! localization. The circles have both radius rules, on the same elements, and the smallest also the lattice sum of what
//! is outside it.

use crate::hierarchy::{Hierarchy, Solution};
use crate::indenter::Level;
use crate::lattice::{Lattice, LatticeError};
use crate::localized::stress::LocalizedField;
use crate::localized::{self, CircleRadius, Coupled, LevelReading, Localized, Setup, Stop};
use crate::material::HalfSpace;
use crate::observables::{Errors, Observables, errors, observe};
use crate::solver::{Control, Settings};
use crate::stress::{Depth, Field, MeanStress, State};
use crate::texture::Surface;
use serde::Serialize;

/// Largest deviation of any level in contact from a reference; relative but for the share.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Deviation {
    /// Of the penetration, relative.
    pub penetration: f64,
    /// Of the load on one indenter, relative.
    pub load: f64,
    /// Of the share of the whole load, absolute.
    pub load_share: f64,
    /// Of the peak pressure, relative.
    pub max_pressure: f64,
    /// Of the contact radius, relative.
    pub contact_radius: f64,
}

/// What both methods say of a load step.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    /// Penetration δ, a length.
    pub penetration: f64,
    /// Level by level; radii of merged contacts are not a number.
    pub levels: Vec<LevelReading>,
}

impl Reading {
    /// From the spectral solution.
    pub fn spectral(observables: &Observables) -> Self {
        let level = |level: &crate::observables::LevelObservables| LevelReading {
            level: level.level,
            load: level.load,
            load_share: level.load_share,
            max_pressure: level.max_pressure,
            contact_radius: level.contact_radius.unwrap_or(f64::NAN),
            ring: level.ring,
            radius: f64::INFINITY,
        };
        Self { penetration: observables.penetration, levels: observables.levels.iter().map(level).collect() }
    }

    /// From a localized solution.
    pub fn localized(system: &Localized, solution: &localized::Solution) -> Self {
        Self { penetration: solution.penetration, levels: system.observe(solution) }
    }

    /// Deviation of this reading from `reference`. A level that touches in one of them only deviates by all of it; the
    /// radius of merged contacts is not a number.
    pub fn deviation(&self, reference: &Self) -> Deviation {
        let relative = |a: f64, b: f64| match (a, b) {
            _ if a == b => 0.0,
            _ if a == 0.0 || b == 0.0 => 1.0,
            _ => (a / b - 1.0).abs(),
        };
        // Unlike f64::max this keeps what is not a number.
        let larger = |most: f64, x: f64| if most.is_nan() || x <= most { most } else { x };
        let largest = |of: &dyn Fn(&LevelReading, &LevelReading) -> f64| {
            let pairs = self.levels.iter().zip(&reference.levels);
            pairs.filter(|(a, b)| a.load > 0.0 || b.load > 0.0).map(|(a, b)| of(a, b)).fold(0.0, larger)
        };
        Deviation {
            penetration: relative(self.penetration, reference.penetration),
            load: largest(&|a, b| relative(a.load, b.load)),
            load_share: largest(&|a, b| (a.load_share - b.load_share).abs()),
            max_pressure: largest(&|a, b| relative(a.max_pressure, b.max_pressure)),
            contact_radius: largest(&|a, b| relative(a.contact_radius, b.contact_radius)),
        }
    }
}

/// One circle held against the spectral solution.
#[derive(Debug, Clone)]
pub struct CircleComparison {
    /// Indenters inside, whole shells.
    pub indenters: usize,
    /// How the solution ended.
    pub stop: Stop,
    /// What it says.
    pub reading: Reading,
    /// Additional displacement w_a, Eq. (8).
    pub additional_displacement: f64,
    /// Deviation from the spectral solution.
    pub difference: Deviation,
    /// Change from half the number of elements.
    pub mesh_error: Deviation,
}

/// Stresses of both methods at one point under the first indenter of the highest level.
#[derive(Debug, Clone, Copy)]
pub struct StressPair {
    /// Place from the indenter's axis, lengths.
    pub place: [f64; 2],
    /// Depth and material.
    pub depth: Depth,
    /// Spectral state.
    pub spectral: State,
    /// Localized state; without displacements.
    pub localized: State,
}

impl StressPair {
    /// Largest difference of a stress component, a pressure.
    pub fn difference(&self) -> f64 {
        let (a, b) = (self.spectral.components(), self.localized.components());
        (0..6).map(|c| (a[c] - b[c]).abs()).fold(0.0, f64::max)
    }
}

/// Both solutions of a load step.
#[derive(Debug)]
pub struct Comparison {
    /// Spectral solution on its finest grid.
    pub spectral: Observables,
    /// Its estimated discretisation errors.
    pub spectral_errors: Errors,
    /// The same as a solver sees it.
    pub solution: Solution,
    /// Points of the finest grid.
    pub points: [usize; 2],
    /// Change from half the points.
    pub grid_error: Deviation,
    /// Elements across the largest contact.
    pub elements: usize,
    /// Circles under the rule asked for.
    pub circles: Vec<CircleComparison>,
    /// The same circles under the other rule.
    pub other_rule: Vec<CircleComparison>,
    /// The first circle with the lattice sum outside; `None` without mutual effect or where all have it.
    pub lattice_sum: Option<CircleComparison>,
    /// Stresses with the last circle, the rule asked for.
    pub stresses: Vec<StressPair>,
}

/// What is compared.
#[derive(Debug, Clone)]
pub struct Task<'a> {
    /// Where the indenters stand.
    pub lattice: &'a Lattice,
    /// Their levels.
    pub levels: &'a [Level],
    /// What they press into.
    pub half_space: &'a HalfSpace,
    /// The load step.
    pub control: Control,
    /// Settings of the spectral solver.
    pub settings: Settings,
    /// Indenters in the circles, elements, rule and mutual effect; one solution for each number of indenters.
    pub setup: Setup,
    /// Numbers of indenters.
    pub indenters: &'a [usize],
    /// Mean lateral stress.
    pub mean: MeanStress,
}

impl Task<'_> {
    fn surface(&self) -> Surface {
        Surface::Indenters { lattice: self.lattice.clone(), levels: self.levels.to_vec() }
    }

    /// Compares both methods, the spectral one on grids of `points` and half of them. `progress` hears what is begun.
    ///
    /// # Errors
    /// [`LatticeError`] when a number of points is zero.
    pub fn compare(&self, points: [usize; 2], progress: &mut dyn FnMut(&str)) -> Result<Comparison, LatticeError> {
        progress("spectral solution");
        let surface = self.surface();
        let solve = |points: [usize; 2]| -> Result<(Hierarchy, Solution, Observables), LatticeError> {
            let mut hierarchy = Hierarchy::new(&surface, self.half_space, points, self.settings)?;
            let solution = hierarchy.solve(self.control, &mut |_| ());
            let observables = observe(&hierarchy, &solution);
            Ok((hierarchy, solution, observables))
        };
        let (_, _, coarse) = solve(points.map(|n| n.div_ceil(2)))?;
        let (hierarchy, solution, spectral) = solve(points)?;
        let spectral_errors = errors(&hierarchy, &spectral, self.control);
        let reference = Reading::spectral(&spectral);
        let grid_error = reference.deviation(&Reading::spectral(&coarse));

        let most = self.indenters.iter().copied().max().unwrap_or(1);
        let system = Localized::new(self.lattice, self.levels, self.half_space, most);
        let (mesh, start) = system.mesh(self.control, &self.setup);
        let half = mesh.halved();
        let (mut circles, mut other_rule, mut lattice_sum) = (Vec::new(), Vec::new(), None);
        let mut last = start;
        let counts: &[usize] = if self.setup.mutual_effect { self.indenters } else { &[1] };
        for &indenters in counts {
            progress(&format!("localized solution, {indenters} indenters in the circle"));
            let [fine, coarse] =
                [mesh, half].map(|mesh| Coupled::new(&system, mesh, indenters, self.setup.mutual_effect));
            let compared = |rule: CircleRadius| {
                let widened = |coupled: &Coupled<'_>, start| {
                    let solution = coupled.solve(self.control, rule, Some(start));
                    if solution.stop != Stop::Rim {
                        return solution;
                    }
                    system.solve(self.control, &Setup { indenters, radius: rule, ..self.setup })
                };
                let found = widened(&fine, &last);
                let own = found.spots[0].mesh;
                let rough = if own == mesh {
                    coarse.solve(self.control, rule, Some(&found))
                } else {
                    let coupled = Coupled::new(&system, own.halved(), indenters, self.setup.mutual_effect);
                    coupled.solve(self.control, rule, Some(&found))
                };
                let rough = Reading::localized(&system, &rough);
                let reading = Reading::localized(&system, &found);
                let comparison = CircleComparison {
                    indenters: fine.indenters(),
                    stop: found.stop,
                    additional_displacement: system.additional_displacement(&found),
                    difference: reading.deviation(&reference),
                    mesh_error: reading.deviation(&rough),
                    reading,
                };
                (comparison, found)
            };
            let (chosen, found) = compared(self.setup.radius);
            circles.push(chosen);
            if self.setup.mutual_effect {
                other_rule.push(compared(self.setup.radius.other()).0);
            }
            if self.setup.mutual_effect && self.setup.radius != CircleRadius::LatticeSum && lattice_sum.is_none() {
                lattice_sum = Some(compared(CircleRadius::LatticeSum).0);
            }
            last = found;
        }
        progress("stresses");
        let stresses = self.stresses(&system, &last, &hierarchy, &solution);
        let elements = self.setup.elements;
        Ok(Comparison {
            points,
            spectral,
            spectral_errors,
            solution,
            grid_error,
            elements,
            circles,
            other_rule,
            lattice_sum,
            stresses,
        })
    }

    /// Stresses on the axis of the first indenter of the highest level and along a line from it.
    fn stresses(
        &self,
        system: &Localized,
        localized: &localized::Solution,
        hierarchy: &Hierarchy,
        spectral: &Solution,
    ) -> Vec<StressPair> {
        let highest = (0..system.sites().len())
            .min_by(|&a, &b| system.profile(a, 0.0).total_cmp(&system.profile(b, 0.0)))
            .unwrap_or(0);
        let spot = &localized.spots[highest];
        if !spot.touches() || localized.stop != Stop::Converged {
            return Vec::new();
        }
        let radius = spot.contact_radius();
        let field = LocalizedField::new(localized, self.half_space, self.mean);
        let whole = Field::new(hierarchy.grid(), &spectral.pressure, self.half_space, self.mean);
        let faces = self.half_space.interface_depths();
        let mut depths: Vec<f64> = [0.25, 0.5, 1.0, 2.0].map(|part| part * radius).to_vec();
        depths.extend(faces.into_iter().filter(|&z| z < 3.0 * radius && field.reaches(z)));
        depths.sort_by(f64::total_cmp);
        let [x, y] = self.lattice.toward(spot.place, spot.level);
        let unit = [x, y].map(|v| v / x.hypot(y));
        let places: Vec<[f64; 2]> = [0.0, 0.5, 1.0, 1.5].map(|part| unit.map(|u| part * radius * u)).to_vec();
        let origin = self.lattice.cell().point(spot.place);
        let mut pairs = Vec::new();
        for depth in depths.into_iter().flat_map(|z| whole.depths(z)) {
            let Some(states) = field.points(highest, depth, &places) else { continue };
            let absolute: Vec<[f64; 2]> = places.iter().map(|p| [origin[0] + p[0], origin[1] + p[1]]).collect();
            for ((&place, localized), spectral) in places.iter().zip(states).zip(whole.points(depth, &absolute)) {
                pairs.push(StressPair { place, depth, spectral, localized });
            }
        }
        pairs
    }
}
