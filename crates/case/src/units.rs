//! Units of the numbers of a case.
//!
//! Cases take any consistent units, and files are never converted. In tables, pictures and messages a unit has a name:
//!
//! - Of an SI unit with its prefix (m, mm, µm, nm; Pa … TPa) axes, tables and captions take the prefix with which their
//!   numbers read well, 2.1·10¹¹ Pa as 210 GPa. A force is a pressure times an area: GPa·µm² = mN.
//! - Any other name is written behind unchanged numbers.
//! - Without a name pressures are relative to the modulus of the substrate (on a rigid base: of the first layer) where that is 1,
//!   p/E₂ as in the paper, and lengths to
//!   the lattice period or the first level's radius where these are; otherwise units are unknown.

use percoat_common::measure::Measure;
use percoat_core::body::HalfSpace;
use percoat_core::counterbody::{Level, Shape};
use percoat_core::load::LoadQuantity;
use percoat_core::problem::Problem;
use percoat_core::quantity::Kind;

pub use percoat_common::unit::{CARRIED, Prefixed, Unit, is_force, is_length, is_pressure, lowered, pascals};

/// Units of lengths and pressures.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Units {
    length: Unit,
    pressure: Unit,
    time: Unit,
    temperature: Unit,
    quantity: LoadQuantity,
}

impl Units {
    /// Units of a problem, whose numbers alone are known.
    pub fn of(problem: &Problem) -> Self {
        let half_space = problem.half_space();
        let is_one = |x: f64| (x - 1.0).abs() < 1e-9;
        let length = match problem.levels().first().map(Level::shape) {
            Some(_) if problem.period().is_some_and(is_one) => Some("l"),
            Some(Shape::Paraboloid { radius } | Shape::Sphere { radius } | Shape::SpheroCone { radius, .. })
                if is_one(*radius) =>
            {
                Some("r₁")
            }
            _ => None,
        };
        // Without an elastic substrate that of the surface.
        let reference = half_space.substrate().material().unwrap_or(half_space.surface_material());
        let pressure = is_one(reference.young()).then(|| format!("E{}", reference_index(half_space)));
        let relative = |symbol: Option<String>| symbol.map_or(Unit::None, Unit::Relative);
        let quantity = problem.kind().load_quantity();
        Self {
            length: relative(length.map(str::to_owned)),
            pressure: relative(pressure),
            time: Unit::None,
            temperature: Unit::None,
            quantity,
        }
    }

    /// Unknown units.
    pub fn unknown() -> Self {
        Self {
            length: Unit::None,
            pressure: Unit::None,
            time: Unit::None,
            temperature: Unit::None,
            quantity: LoadQuantity::MeanPressure,
        }
    }

    /// The units with names for lengths, for pressures or for both.
    #[must_use]
    pub fn named(self, length: Option<&str>, pressure: Option<&str>) -> Self {
        Self {
            length: length.map_or(self.length, |name| Unit::called(name, "m")),
            pressure: pressure.map_or(self.pressure, |name| Unit::called(name, "Pa")),
            ..self
        }
    }

    /// The units with a name for times.
    #[must_use]
    pub fn with_time(self, time: Option<&str>) -> Self {
        Self { time: time.map_or(self.time, |name| Unit::Named(name.to_owned())), ..self }
    }

    /// The units with a name for temperatures.
    #[must_use]
    pub fn with_temperature(self, temperature: Option<&str>) -> Self {
        Self { temperature: temperature.map_or(self.temperature, |name| Unit::Named(name.to_owned())), ..self }
    }

    /// Unit of temperatures.
    pub fn temperature(&self) -> &Unit {
        &self.temperature
    }

    /// Unit of times.
    pub fn time(&self) -> &Unit {
        &self.time
    }

    /// Unit of velocities: a length per time; [`Unit::None`] where one of both has no name.
    pub fn velocity(&self) -> Unit {
        let names = self.length.name().zip(self.time.name());
        names.map_or(Unit::None, |(length, time)| Unit::Named(format!("{length}/{time}")))
    }

    /// The units with loads stated in this quantity.
    #[must_use]
    pub fn with_loads_in(self, quantity: LoadQuantity) -> Self {
        Self { quantity, ..self }
    }

    /// The quantity in which loads are stated.
    pub fn quantity(&self) -> LoadQuantity {
        self.quantity
    }

    /// Unit of loads in their [quantity](Self::quantity).
    pub fn load(&self) -> Unit {
        match self.quantity {
            LoadQuantity::MeanPressure => self.pressure.clone(),
            LoadQuantity::Force => self.force(),
        }
    }

    /// Unit of lengths.
    pub fn length(&self) -> &Unit {
        &self.length
    }

    /// Unit of pressures.
    pub fn pressure(&self) -> &Unit {
        &self.pressure
    }

    /// The units of lengths and of pressures; `None` of those that have no name, or one that is not known.
    pub fn measures(&self) -> [Option<Measure>; 2] {
        [(&self.length, Measure::METRE), (&self.pressure, Measure::PASCAL)]
            .map(|(unit, base)| Measure::like(&unit.name()?, base))
    }

    /// Unit of forces: a pressure times an area; [`Unit::None`] where one of both has no name.
    pub fn force(&self) -> Unit {
        self.pressure_times(2, "N", "²")
    }

    /// Unit of areas: a length squared; [`Unit::None`] where lengths have no name.
    pub fn area(&self) -> Unit {
        self.raised("²")
    }

    /// Unit of energies: a pressure times a volume; [`Unit::None`] where one of both has no name.
    pub fn energy(&self) -> Unit {
        self.pressure_times(3, "J", "³")
    }

    /// Unit of energies per area: a pressure times a length; [`Unit::None`] where one of both has no name.
    pub fn energy_per_area(&self) -> Unit {
        self.pressure_times(1, "J/m²", "")
    }

    /// Unit of a quantity by its kind; [`Unit::None`] of a number without dimension, and where a unit has no name.
    pub fn unit(&self, kind: Kind) -> Unit {
        match kind {
            Kind::Pressure => self.pressure.clone(),
            Kind::Force => self.force(),
            Kind::Length => self.length.clone(),
            Kind::Area => self.area(),
            Kind::Volume => self.raised("³"),
            Kind::Energy => self.energy(),
            Kind::Stiffness => per(&self.force(), &self.length),
            Kind::PressurePerLength => per(&self.pressure, &self.length),
            Kind::Temperature => self.temperature.clone(),
            Kind::Fraction | Kind::Ratio | Kind::Passes | Kind::Utilisation => Unit::None,
            Kind::Strain => Unit::Strain,
            Kind::Time => self.time.clone(),
        }
    }

    /// A power of a length, without a prefix of its own; [`Unit::None`] where lengths have no name.
    fn raised(&self, power: &str) -> Unit {
        match &self.length {
            Unit::Named(name) => Unit::Named(format!("{name}{power}")),
            Unit::Si { exponent, .. } => {
                let prefix = Unit::Si { base: "m", exponent: *exponent }.name().unwrap_or_default();
                Unit::Named(format!("{prefix}{power}"))
            }
            Unit::None | Unit::Relative(_) | Unit::Strain => Unit::None,
        }
    }

    /// A pressure times a power of a length, in SI `base`.
    fn pressure_times(&self, power: i32, base: &'static str, raised: &str) -> Unit {
        match (&self.pressure, &self.length) {
            (Unit::Si { exponent, .. }, Unit::Si { exponent: length, .. }) => {
                Unit::Si { base, exponent: exponent + power * length }
            }
            (pressure, length) => match (pressure.name(), length.name()) {
                (Some(pressure), Some(length)) => Unit::Named(format!("{pressure}·{length}{raised}")),
                _ => Unit::None,
            },
        }
    }
}

/// A unit over another; [`Unit::None`] where one of both has no name.
fn per(unit: &Unit, other: &Unit) -> Unit {
    unit.name().zip(other.name()).map_or(Unit::None, |(unit, other)| Unit::Named(format!("{unit}/{other}")))
}

/// Index of the substrate's material, on a rigid base of the first layer's, as letters carry it: none where there is one material.
pub fn reference_index(half_space: &HalfSpace) -> String {
    match half_space.material_count() {
        1 => String::new(),
        _ if half_space.substrate().is_rigid() => lowered(1),
        count => lowered(count),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use percoat_core::body::Material;
    use percoat_core::counterbody::Indenters;
    use percoat_core::lattice::Lattice;

    fn units(period: f64, radius: f64, young: f64) -> Units {
        let levels = vec![Level::new(Shape::Paraboloid { radius }, 0.0).unwrap(); 3];
        let indenters = Indenters::new(Lattice::hexagonal(period, 3).unwrap(), levels).unwrap();
        let half_space = HalfSpace::new(vec![], Material::from_young(young, 0.3).unwrap());
        Units::of(&Problem::new(indenters, half_space))
    }

    #[test]
    fn units_without_a_name_are_relative_where_something_is_one() {
        let relative = |symbol: &str| Unit::Relative(symbol.to_owned());
        assert_eq!(units(1.0, 0.8, 1.0), Units { length: relative("l"), pressure: relative("E"), ..Units::unknown() });
        assert_eq!(units(0.6, 1.0, 1.0).length, relative("r₁"));
        assert_eq!(units(2e-5, 8e-5, 2.1e11), Units::unknown());
        assert_eq!(units(1.0, 0.8, 1.0).force(), Unit::None);
    }

    #[test]
    fn numbers_of_an_si_unit_take_the_prefix_with_which_they_read_well() {
        let shown = |length: &str, pressure: &str, sizes: [f64; 3]| {
            let units = units(1.0, 1.0, 1.0).named(Some(length), Some(pressure));
            let units = [units.length.clone(), units.pressure.clone(), units.force()];
            [0, 1, 2].map(|k| {
                let prefixed = units[k].prefixed(sizes[k]);
                // 2.0999999 is 2.1.
                prefixed.behind(&format!("{}", (1e6 * prefixed.shown(sizes[k])).round() / 1e6)).replace('\u{a0}', " ")
            })
        };
        assert_eq!(shown("m", "Pa", [2e-6, 2.1e11, 3e-4]), ["2 µm", "210 GPa", "300 µN"]);
        assert_eq!(shown("µm", "GPa", [2.0, 0.002, 0.5]), ["2 µm", "2 MPa", "0.5 mN"]);
        assert_eq!(shown("um", "GPa", [1e-3, 0.05, 2e4]), ["1 nm", "0.05 GPa", "20 N"]);
        assert_eq!(shown("μm", "MPa", [1e6, 210e3, 1e-3]), ["1 m", "210 GPa", "1 nN"]);
        assert_eq!(shown("mm", "MPa", [0.5, 9999.0, 1e4]), ["0.5 mm", "9999 MPa", "10 kN"]);
        assert_eq!(shown("nm", "GPa", [0.0, -2e4, 1.0]), ["0 nm", "-20 TPa", "1 nN"]);
        assert_eq!(shown("m", "Pa", [1e-20, 1e20, 0.0]), ["0 pm", "100000000 TPa", "0 N"]);
        assert_eq!(shown("in", "psi", [1e-3, 3e7, 1.0]), ["0.001 in", "30000000 psi", "1 psi·in²"]);
        assert_eq!(shown("pm", "Pa", [1.0, 1.0, 1.0]), ["1 pm", "1 Pa", "0 pN"]);
    }

    #[test]
    fn strains_are_microstrain_or_per_cent() {
        let shown =
            |x: f64| Unit::Strain.with_unit(x, |x| format!("{}", (1e6 * x).round() / 1e6)).replace('\u{a0}', " ");
        assert_eq!(
            [100.5e-6, -185.1e-6, 0.0, 2.5e-3, -0.04].map(shown),
            ["100.5 µε", "-185.1 µε", "0 µε", "0.25 %", "-4 %"]
        );
    }

    #[test]
    fn an_energy_is_a_pressure_times_a_volume() {
        let energy = |length: &str, pressure: &str| {
            units(1.0, 1.0, 1.0).named(Some(length), Some(pressure)).energy().with_unit(2.0, |x| format!("{x}"))
        };
        let told = [("µm", "GPa"), ("mm", "MPa"), ("m", "Pa"), ("in", "psi")].map(|(l, p)| energy(l, p));
        // GPa·µm³ = nJ, MPa·mm³ = mJ.
        assert_eq!(told.map(|text| text.replace('\u{a0}', " ")), ["2 nJ", "2 mJ", "2 J", "2 psi·in³"]);
    }

    #[test]
    fn every_kind_has_its_unit_where_both_units_have_a_name() {
        let named = units(1.0, 1.0, 1.0).named(Some("µm"), Some("GPa"));
        let kinds = [Kind::Force, Kind::Area, Kind::Volume, Kind::Stiffness, Kind::PressurePerLength, Kind::Fraction];
        let told = kinds.map(|kind| named.unit(kind).name().unwrap_or_default());
        assert_eq!(told, ["mN", "µm²", "µm³", "mN/µm", "GPa/µm", ""]);
        assert!(kinds.iter().all(|kind| Units::unknown().unit(*kind) == Unit::None));
    }

    #[test]
    fn pressures_have_their_pascals() {
        for (name, expected) in
            [("GPa", 1e9), ("mPa", 1e-3), ("N/mm²", 1e6), ("bar", 1e5), ("psi", 6_894.757_293_168_361)]
        {
            assert!((pascals(name).unwrap() / expected - 1.0).abs() < 1e-12, "{name}");
        }
        assert!(["GPA", "mm", "N", ""].iter().all(|name| pascals(name).is_none()));
    }

    #[test]
    fn one_name_alone_leaves_the_other_unit_as_it_is() {
        let units = units(1.0, 0.8, 1.0).named(Some("mm"), None);
        assert_eq!(units.length.name().as_deref(), Some("mm"));
        assert_eq!((units.pressure.clone(), units.force()), (Unit::Relative("E".to_owned()), Unit::None));
    }
}
