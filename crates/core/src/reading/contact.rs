//! The reading of a contact on one grid.

use super::boundary::{Boundary, ContactSamples};
use super::contact_area::ContactArea;
use super::counted::CountedArea;
use super::edge::ContactEdge;
use super::fractions::Fractions;
use super::level_spots::LevelSpots;
use super::{LevelReading, peak, spots, topography};
use crate::lattice::components::Component;
use crate::lattice::{Grid, Surroundings};
use crate::load::LoadQuantity;
use crate::measured::Measured;
use crate::notation::number;
use crate::numeric::serialised;
use crate::numeric::sums;
use crate::quantity::{Quantity, quantities};
use crate::spectral::Contact;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;
use std::fmt;

quantities! {
    /// Scalars of the contact of one load step.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
    pub struct Reading {
        /// Mean pressure p̄ over the cell, in the unit of Young's modulus; `None` for an isolated contact.
        #[serde(deserialize_with = "Option::deserialize")]
        pub mean_pressure: Option<f64> = Pressure "mean pressure" "p̄",
        /// Force P on the cell, or on the isolated contact, a pressure times an area; below 0 where surfaces that adhere are drawn apart.
        #[serde(default = "unknown", deserialize_with = "serialised::number")]
        pub force: f64 = Force "force" "P",
        /// Penetration δ, a length: measured from the mean plane of the deformed surface, the additional displacement of Eq. (8); of an
        /// isolated contact the approach of points far away.
        #[serde(flatten, with = "both_names")]
        pub penetration: f64 = Length "penetration" "δ" given "largest deflection",
        /// Area of contact in the cell, a length squared.
        #[serde(default = "unknown", deserialize_with = "serialised::number")]
        pub contact_area: f64 = Area "contact area" "A" given "area under pressure",
        /// Fraction of the cell in contact: read between the samples, or counted and corrected by the perimeter where that errs
        /// less, as on rough surfaces whose spots have few samples. `None` for an isolated contact.
        #[serde(deserialize_with = "Option::deserialize")]
        pub contact_fraction: Option<f64> = Fraction "fraction in contact" "A/A₀" given "fraction under pressure",
        /// Uncertainty of the fraction in contact, from the samples of this grid alone; not kept in files.
        #[serde(skip)]
        pub contact_fraction_uncertainty: f64,
        /// Elastic energy ½∫ p w d²x of one cell, a pressure times a cubed length: see
        /// [`Contact::elastic_energy`](crate::spectral::Contact::elastic_energy).
        #[serde(default = "unknown", deserialize_with = "serialised::number")]
        pub elastic_energy: f64 = Energy "elastic energy" "U",
        /// Largest pressure in contact, between the samples, in the unit of Young's modulus; infinite where that of a level is. Of surfaces
        /// that adhere the tension is taken off.
        #[serde(flatten, with = "serialised::max_pressure")]
        pub max_pressure: f64 = Pressure "peak pressure" "p" short "peak",
        /// Largest pressure that the grid resolves, where the largest one is infinite; `None` where it is finite.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub resolved_peak: Option<f64>,
        /// Estimated discretisation errors; empty without coarser grids.
        pub errors: Errors,
        /// Samples between the largest pressure and the edge of contact, at most `spot_resolution`; not kept in files.
        #[serde(skip)]
        pub peak_to_edge: f64,
        /// Number of contact spots in the cell; merged contacts are one.
        pub contact_spots: usize,
        /// Samples along the radius of a disc as large as the typical spot: the one up to which, from the smallest on, half
        /// of the load is carried. 0 without contact.
        #[serde(deserialize_with = "serialised::number")]
        pub spot_resolution: f64,
        /// Per level; empty for a topography.
        pub levels: Vec<LevelReading>,
        /// Per site, the boundary of its contact; `None` without contact, for merged contacts and for spots of too few
        /// samples or no smooth boundary. Empty for a topography; not kept in files.
        #[serde(skip)]
        pub boundaries: Vec<Option<Boundary>>,
        /// All readings of the fraction in contact; not kept in files.
        #[serde(skip)]
        pub fractions: Fractions,
    }
    table ReadingQuantities as READING;
    /// Estimated errors of the scalars of a load step, each in the unit of its quantity; `None` where there is no
    /// coarser grid to compare with or no such quantity.
    ///
    /// On the way to a solution the nested grids have solved the same load step with a half, a quarter, … of the points.
    /// Quantities converge at second order, a cusp of the pressure slower; errors oscillate as the edge of contact moves
    /// among the samples, so that two grids can agree by chance. The estimate is therefore 1.5 to 4 times the largest of
    ///
    /// |q(h) − q(2h)|,  |q(h) − q(4h)|/4,  and the error by the law for n samples along a contact radius:
    ///
    /// | quantity | relative |
    /// |---|---|
    /// | peak pressure | 0.1 n⁻² + n⁻⁴ for profiles rᵏ with k ≥ 2; 0.25 n^{1−k} for the cusps of 1 < k < 2; n samples between the peak and the edge, which under a stiff coating lies in a ridge along it |
    /// | load on an indenter, prescribed the penetration | 0.03 n⁻² + 0.3 n⁻⁴ |
    /// | share of the load, absolute; load on an indenter, prescribed the mean pressure | 0.002 n⁻² |
    /// | penetration | 0.01 n⁻²; 0.05 n⁻² under a topography |
    /// | elastic energy | 0.03 n⁻², prescribed the mean pressure, 0.05 n⁻² under a topography; 0.03 n⁻² + 0.3 n⁻⁴, prescribed the penetration |
    /// | mean gap of a topography | 0.05 n⁻² of the penetration |
    /// | area of a topography corrected by its perimeter | a quarter of the correction |
    /// | centre of the pressure | 0.005 n⁻² of the contact radius |
    /// | areas, radii, asymmetry, fraction in contact | the uncertainty of the reading of the boundary |
    ///
    /// The fraction in contact of a topography is read between the samples; where its spots are narrower than ten samples on the
    /// average, or many and without boundaries of their own, it is that or the count corrected by the perimeter, whichever has the
    /// smaller error by these laws.
    ///
    /// The numbers are read off seven hundred random cases solved again with four times the points; that the estimates hold
    /// in 95 % of others is shown in `validation/discretisation`. A prescribed quantity has no error; the peak under a tip is
    /// infinite and has none either.
    #[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
    errors Errors {}
}

impl Reading {
    /// Whether there is any contact.
    pub fn touches(&self) -> bool {
        self.contact_area > 0.0
    }

    /// Mean pressure P/A where there is contact, in the unit of Young's modulus, of surfaces that adhere with all that pulls, and its error (those of
    /// force and area added, relative); `None` without contact.
    pub fn mean_contact_pressure(&self) -> Option<Measured> {
        let Self { force, contact_area, errors, .. } = self;
        let mean = (self.touches() && *contact_area > 0.0).then(|| force / contact_area)?;
        let error = errors.contact_area.map(|area| (mean.abs() * area + errors.force.unwrap_or(0.0)) / contact_area);
        Some(Measured::new(mean, error))
    }

    /// Surroundings of the cell.
    pub fn surroundings(&self) -> Surroundings {
        match self.contact_fraction {
            Some(_) => Surroundings::Periodic,
            None => Surroundings::FreeSpace,
        }
    }

    /// The load in one of its quantities; `None` for the mean pressure of an isolated contact.
    pub fn load_in(&self, quantity: LoadQuantity) -> Option<f64> {
        match quantity {
            LoadQuantity::MeanPressure => self.mean_pressure,
            LoadQuantity::Force => Some(self.force),
        }
    }

    /// The load in one of its quantities; not a number for the mean pressure of an isolated contact.
    pub fn load(&self, quantity: LoadQuantity) -> f64 {
        self.load_in(quantity).unwrap_or(f64::NAN)
    }

    /// Estimated error of the [load](Self::load).
    pub fn load_error(&self, quantity: LoadQuantity) -> Option<f64> {
        READING.load(quantity).of(self).and_then(|load| load.error)
    }

    /// Quantity that states how far contact extends: the fraction of the cell, or of an isolated contact the area.
    pub fn extent(&self) -> &'static Quantity<Self> {
        if self.contact_fraction.is_some() { &READING.contact_fraction } else { &READING.contact_area }
    }

    /// Whether the largest pressure is infinite: that of a level is.
    pub fn singular(&self) -> bool {
        self.max_pressure.is_infinite()
    }

    /// The largest pressure where it is finite.
    pub fn finite_peak(&self) -> Option<f64> {
        (!self.singular()).then_some(self.max_pressure)
    }

    /// The largest pressure that the grid resolves: always finite.
    pub fn grid_peak(&self) -> f64 {
        self.resolved_peak.unwrap_or(self.max_pressure)
    }

    /// Reading of a contact on one grid, without estimated errors.
    pub fn of(contact: &Contact) -> Self {
        Self::at_edge(contact, &edge(&[contact]), true)
    }

    /// Reading of a contact on one grid from the edge of its body; without `errors` those of the boundaries are left out.
    pub(super) fn at_edge(contact: &Contact, edge: &ContactEdge, errors: bool) -> Self {
        let (grid, pressure) = (contact.grid(), contact.pressures());
        let components = contact.touching();
        let counts = contact.spots(Some(&components));
        let highest = highest(grid, pressure, &components);
        let mut spots = spots::spots(contact, &components);
        let samples = samples(contact, edge, errors);
        let given = contact.problem().given_pressure();
        let topography = if given.is_some() {
            // A pressure that is given may end with a jump.
            Vec::new()
        } else if contact.surface().owners().is_empty() {
            topography::boundaries(contact, &components, &samples)
        } else {
            spots::locate(contact, &samples, &mut spots);
            Vec::new()
        };
        let area = ContactArea::of(contact, &components, &spots, &topography);
        let mean_pressure = sums::mean(&contact.net_pressures());
        let (cell, surroundings) = (grid.cell(), grid.cell().surroundings());
        let levels: Vec<LevelReading> = (1..=contact.problem().levels().len())
            .map(|level| LevelSpots::new(contact, level, &spots).reading(&area, sums::mean(pressure)))
            .collect();
        let fractions = || Fractions {
            between: area.fraction(),
            // The correction by the perimeter is a mean over the directions of borders: it takes many spots.
            many: components.len() > topography::LARGEST_SPOTS && area.located() < 0.5 * area.total(),
            counted: contact.surface().owners().is_empty().then(|| CountedArea::of(grid, pressure)),
        };
        let known = given.and_then(|given| given.loaded_area());
        let fractions = known.map_or_else(fractions, |area| Fractions::known(area / cell.area()));
        let (fraction, _) = fractions.best(|fraction, _| fraction.uncertainty);
        let typical = counts.half_load().map_or(0, |index| counts.sizes[index].0);
        let spot_resolution = (typical as f64 / PI).sqrt();
        // A pressure that is given has no peak between the samples.
        let highest_peak = match given {
            Some(given) => given.highest() * (mean_pressure * cell.area() / given.force()),
            None => highest.map_or(0.0, |index| peak::net(contact, peak::interpolated(contact, index))),
        };
        // Between the samples the highest of them need not be the highest peak.
        let touching = levels.iter().filter(|level| level.touches());
        let resolved = touching.map(LevelReading::grid_peak).fold(highest_peak, f64::max);
        let (max_pressure, resolved_peak) = LevelReading::peak_of(resolved, levels.iter().any(LevelReading::singular));
        Self {
            mean_pressure: surroundings.per_cell(mean_pressure),
            force: mean_pressure * cell.area(),
            penetration: contact.penetration(),
            contact_area: fraction.value * cell.area(),
            contact_fraction: surroundings.per_cell(fraction.value),
            contact_fraction_uncertainty: fraction.uncertainty,
            elastic_energy: contact.elastic_energy(),
            max_pressure,
            resolved_peak,
            peak_to_edge: highest.map_or(0.0, |index| peak::samples_to_edge(grid, pressure, index, spot_resolution)),
            contact_spots: counts.sizes.len(),
            spot_resolution,
            levels,
            boundaries: spots.into_iter().map(|spot| spot.boundary).collect(),
            errors: Errors::default(),
            fractions,
        }
    }
}

impl ReadingQuantities {
    /// The load in one of its quantities.
    pub fn load(&self, quantity: LoadQuantity) -> &Quantity<Reading> {
        match quantity {
            LoadQuantity::MeanPressure => &self.mean_pressure,
            LoadQuantity::Force => &self.force,
        }
    }
}

/// A number that files of earlier versions do not have.
fn unknown() -> f64 {
    f64::NAN
}

/// The penetration under both of its names: δ is measured from the mean plane of the deformed surface, so that it is the
/// additional displacement w_a of Eq. (8).
mod both_names {
    use crate::numeric::serialised::number;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    #[derive(Serialize, Deserialize)]
    struct Keys {
        #[serde(deserialize_with = "number")]
        penetration: f64,
        #[serde(skip_deserializing)]
        additional_displacement: f64,
    }

    pub fn serialize<S: Serializer>(penetration: &f64, keys: S) -> Result<S::Ok, S::Error> {
        Keys { penetration: *penetration, additional_displacement: *penetration }.serialize(keys)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(keys: D) -> Result<f64, D::Error> {
        Ok(Keys::deserialize(keys)?.penetration)
    }
}

/// The samples of a contact, with the edge of its body.
fn samples<'a>(contact: &'a Contact, edge: &'a ContactEdge, errors: bool) -> ContactSamples<'a> {
    let [sample_area, spacing] = [contact.grid().sample_area(), contact.grid().spacing()];
    let modulus = contact.problem().bodies().contact_modulus();
    ContactSamples { sample_area, spacing, pressure: contact.pressures(), gap: contact.gaps(), modulus, edge, errors }
}

/// Pressure and gap at an edge between the bodies of some contacts, at all distances that the fits of their boundaries use.
pub(super) fn edge(contacts: &[&Contact]) -> ContactEdge {
    let distances = contacts.iter().map(|contact| ContactSamples::distances(contact.grid()));
    let [shortest, longest] = distances.fold([f64::INFINITY, 0.0], |[a, b], [c, d]| [f64::min(a, c), f64::max(b, d)]);
    let problem = contacts[0].problem();
    ContactEdge::new(problem.bodies(), problem.friction(), shortest, longest)
}

/// Flat index of the sample with the largest pressure, the first of several; `None` without contact.
fn highest(grid: &Grid, pressure: &[f64], components: &[Component]) -> Option<usize> {
    let samples = components.iter().flat_map(|component| component.indices(grid)).flatten();
    samples.reduce(|a, b| if pressure[b] > pressure[a] || pressure[b] == pressure[a] && b < a { b } else { a })
}

impl fmt::Display for Reading {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.mean_pressure {
            Some(mean) => write!(f, "mean pressure {}", number(mean))?,
            None => write!(f, "force {}", number(self.force))?,
        }
        self.contact_fraction.iter().try_for_each(|part| write!(f, ", contact fraction {}", number(*part)))?;
        write!(f, ", penetration {}, contact area {}", number(self.penetration), number(self.contact_area))?;
        for level in &self.levels {
            write!(
                f,
                "\nlevel {}: load {} ({:.3} %), peak pressure {}, contact area {}{}",
                level.level,
                number(level.load),
                100.0 * level.load_share,
                number(level.grid_peak()),
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
