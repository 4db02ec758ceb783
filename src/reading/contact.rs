//! What is read off a contact on one grid.

use super::boundary::{Boundary, Scale};
use super::edge::Edge;
use super::fraction::{Fraction, Fractions};
use super::spots::{self, SpotReading};
use super::{Errors, LevelErrors, LevelReading, Uncertainty, area, peak, rough};
use crate::lattice::Grid;
use crate::lattice::components::Component;
use crate::numeric::number::number;
use crate::numeric::sums;
use crate::spectral::Contact;
use std::f64::consts::PI;
use std::fmt;

/// Scalars of one load step.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    /// Mean pressure p̄ over the cell, in the unit of Young's modulus.
    pub mean_pressure: f64,
    /// Penetration δ, a length.
    pub penetration: f64,
    /// Fraction of the cell in contact: read between the samples, or counted and corrected by the perimeter where that errs
    /// less, as on rough surfaces whose spots have few samples.
    pub contact_fraction: f64,
    /// What the reading of the fraction says of its own error, from the samples of this grid alone.
    pub contact_fraction_uncertainty: f64,
    /// Elastic energy ½∫ p w d²x of one cell, a pressure times a cubed length: see
    /// [`Contact::elastic_energy`](crate::spectral::Contact::elastic_energy).
    pub elastic_energy: f64,
    /// Largest pressure, between the samples, in the unit of Young's modulus; what the grid resolves of it where it is
    /// infinite ([`Reading::singular`]).
    pub max_pressure: f64,
    /// Samples between the largest pressure and the edge of contact, at most `spot_resolution`; 0 where read back from a file.
    pub peak_to_edge: f64,
    /// Number of contact spots in the cell; merged contacts are one.
    pub contact_spots: usize,
    /// Samples along the radius of a disc as large as the typical spot: the one up to which, from the smallest on, half
    /// of the load is carried. 0 without contact.
    pub spot_resolution: f64,
    /// Per level; empty for a topography.
    pub levels: Vec<LevelReading>,
    /// Per site, the boundary of its contact; `None` without contact, for merged contacts and for spots of too few
    /// samples or no smooth boundary. Empty for a topography.
    pub boundaries: Vec<Option<Boundary>>,
    /// Estimated discretisation errors, where coarser grids tell them.
    pub errors: Errors,
    /// All readings of the fraction in contact.
    pub(crate) fractions: Fractions,
}

impl Reading {
    /// Whether the largest pressure is infinite: that of a level is.
    pub fn singular(&self) -> bool {
        self.levels.iter().any(|level| level.singular)
    }

    /// The largest pressure where it is finite.
    pub fn finite_peak(&self) -> Option<f64> {
        (!self.singular()).then_some(self.max_pressure)
    }

    /// What one grid says of a contact, without errors.
    pub fn of(contact: &Contact) -> Self {
        Self::at_edge(contact, &edge(&[contact]), true)
    }

    /// The same with the edge of the body at hand; without `errors` those of the boundaries are left out.
    pub(super) fn at_edge(contact: &Contact, edge: &Edge, errors: bool) -> Self {
        let (grid, surface) = (contact.grid(), contact.surface());
        let (pressure, gap) = (contact.pressures(), contact.gaps());
        let mean_pressure = sums::mean(pressure);
        let modulus = contact.problem().half_space().surface_material().contact_modulus();
        let [sample_area, spacing] = [grid.sample_area(), grid.spacing()];
        let scale = Scale { sample_area, spacing, pressure, gap, modulus, edge, errors };
        let components = contact.touching();
        let counts = contact.spots(Some(&components));
        let highest = highest(grid, pressure, &components);
        let max_pressure = highest.map_or(0.0, |index| peak::interpolated(grid, pressure, index));

        let mut spots = spots::spots(contact, &components);
        let topography = if surface.owners().is_empty() {
            spots::of_topography(contact, &components, &scale)
        } else {
            spots::locate(contact, &scale, &mut spots);
            Vec::new()
        };

        let cell = grid.cell().area();
        // Located spots have their own area. The others share what the lines of samples find there, as they were counted.
        let located = || spots.iter().map(|spot| &spot.boundary).chain(&topography).flatten();
        let along_lines = if surface.owners().is_empty() {
            let unknown = components.iter().zip(&topography).filter(|(_, boundary)| boundary.is_none());
            area::of_components(grid, pressure, gap, unknown.map(|(component, _)| component), components.len())
        } else {
            // A component has one owner, or its owners have merged.
            let owner = |own: &Component| surface.owners()[own.runs[0].index(grid.points())];
            let unknown = components.iter().filter(|own| spots[owner(own) as usize].boundary.is_none());
            area::of_components(grid, pressure, gap, unknown, components.len())
        };
        let located_area: f64 = located().map(Boundary::area).sum();
        let contact_area = located_area + cell * along_lines.fraction;
        let counted: f64 = spots.iter().filter(|spot| spot.boundary.is_none()).map(|spot| spot.counted).sum();
        let share = if counted > 0.0 { cell / counted } else { 0.0 };
        let spot_area = |spot: &SpotReading| match &spot.boundary {
            Some(boundary) => [boundary.area(), boundary.area_error()],
            None => [along_lines.fraction, along_lines.error].map(|part| part * share * spot.counted),
        };

        let levels: Vec<LevelReading> = (1..=contact.problem().counterbody().levels().len())
            .map(|level| {
                let own: Vec<&SpotReading> = surface
                    .sites()
                    .iter()
                    .zip(&spots)
                    .filter(|(site, _)| site.level == level)
                    .map(|(_, s)| s)
                    .collect();
                let indenters = own.len() as f64;
                let load = own.iter().map(|spot| spot.load).sum::<f64>();
                let [area, area_error] =
                    [0, 1].map(|k| own.iter().map(|spot| spot_area(spot)[k]).sum::<f64>() / indenters);
                let merged = own.iter().any(|spot| spot.merged);
                let peaks = || own.iter().filter_map(|spot| spot.peak);
                let resolution = (area / PI / grid.sample_area()).sqrt();
                let radius = (area / PI).sqrt();
                let ring = !merged && own.iter().any(|spot| spot.ring);
                // What follows from the boundaries of all indenters: means by area, the least and the largest.
                let boundaries: Option<Vec<&Boundary>> = own.iter().map(|spot| spot.boundary.as_ref()).collect();
                let all = |value: fn(&Boundary) -> f64| {
                    let boundaries = boundaries.as_ref()?;
                    Some(boundaries.iter().map(move |boundary| value(boundary)))
                };
                let mean = |radius| Some((all(radius)?.map(|r| r * r).sum::<f64>() / indenters).sqrt());
                let most = |value| Some(all(value)?.fold(0.0, f64::max));
                let ring_radii = mean(Boundary::mean_hole_radius).zip(mean(Boundary::mean_radius)).filter(|_| ring);
                let (radius_inner, radius_outer) = ring_radii.unzip();
                LevelReading {
                    level,
                    load: load / indenters,
                    load_share: if mean_pressure > 0.0 { load / (mean_pressure * cell) } else { 0.0 },
                    max_pressure: peaks().map(|index| peak::interpolated(grid, pressure, index)).fold(0.0, f64::max),
                    singular: load > 0.0
                        && surface.sites().iter().any(|site| site.level == level && site.shape.singular_peak()),
                    contact_area: area,
                    contact_radius: (!merged).then_some(radius),
                    ring,
                    radius_inner,
                    radius_outer,
                    radius_min: all(|b| b.extremes().0).and_then(|radii| radii.reduce(f64::min)),
                    radius_max: most(|b| b.extremes().1),
                    centre: (load > 0.0 && !merged)
                        .then(|| [0, 1].map(|k| own.iter().map(|spot| spot.moment[k]).sum::<f64>() / load)),
                    merged,
                    resolution,
                    uncertainty: Uncertainty {
                        peak_to_edge: peaks()
                            .map(|index| peak::samples_to_edge(grid, pressure, index, resolution))
                            .fold(resolution, f64::min),
                        area: area_error,
                        radius: (!merged && area > 0.0).then(|| 0.5 * area_error / area * radius),
                        hole: most(|b| b.hole_error).filter(|_| ring),
                        boundary: most(|b| b.error),
                    },
                    errors: LevelErrors::default(),
                }
            })
            .collect();
        let typical = counts.half_load().map_or(0, |index| counts.sizes[index].0);
        let spot_resolution = (typical as f64 / PI).sqrt();
        let between = Fraction {
            value: contact_area / cell,
            uncertainty: located().map(Boundary::area_error).sum::<f64>() / cell + along_lines.error,
        };
        let corrected = surface.owners().is_empty().then(|| rough::corrected_fraction(grid, pressure));
        // The correction by the perimeter is a mean over the directions of borders: it takes many spots.
        let many = components.len() > spots::MOST && located_area < 0.5 * contact_area;
        let fractions = Fractions { between, many, corrected };
        let (fraction, _) = fractions.best(|own, _| own.uncertainty);
        let boundaries = spots.into_iter().map(|spot| spot.boundary).collect();
        Self {
            mean_pressure,
            penetration: contact.penetration(),
            contact_fraction: fraction.value,
            contact_fraction_uncertainty: fraction.uncertainty,
            elastic_energy: contact.elastic_energy(),
            // Between the samples the highest of them need not be the highest peak.
            max_pressure: levels.iter().map(|level| level.max_pressure).fold(max_pressure, f64::max),
            peak_to_edge: highest.map_or(0.0, |index| peak::samples_to_edge(grid, pressure, index, spot_resolution)),
            contact_spots: counts.sizes.len(),
            spot_resolution,
            levels,
            boundaries,
            errors: Errors::default(),
            fractions,
        }
    }
}

/// The edge on the body of contacts, at all distances at which their boundaries are looked for.
pub(super) fn edge(contacts: &[&Contact]) -> Edge {
    let distances = contacts.iter().map(|contact| Scale::distances(contact.grid()));
    let [shortest, longest] = distances.fold([f64::INFINITY, 0.0], |[a, b], [c, d]| [f64::min(a, c), f64::max(b, d)]);
    let problem = contacts[0].problem();
    Edge::new(problem.half_space().response(), problem.friction(), shortest, longest)
}

/// The sample with the largest pressure, the first of several; `None` without contact.
fn highest(grid: &Grid, pressure: &[f64], components: &[Component]) -> Option<usize> {
    let samples = components.iter().flat_map(|component| component.indices(grid)).flatten();
    samples.reduce(|a, b| if pressure[b] > pressure[a] || pressure[b] == pressure[a] && b < a { b } else { a })
}

impl fmt::Display for Reading {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "mean pressure {}, penetration {}, contact fraction {}",
            number(self.mean_pressure),
            number(self.penetration),
            number(self.contact_fraction)
        )?;
        for level in &self.levels {
            write!(
                f,
                "\nlevel {}: load {} ({:.3} %), peak pressure {}, contact area {}{}",
                level.level,
                number(level.load),
                100.0 * level.load_share,
                number(level.max_pressure),
                number(level.contact_area),
                match (level.merged, level.ring) {
                    (true, _) => ", merged with a neighbour",
                    (false, true) => ", a ring",
                    (false, false) => "",
                }
            )?;
        }
        Ok(())
    }
}
