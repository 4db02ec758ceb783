//! One level on thin coatings: contact radius, peak pressure and penetration of both methods.
//!
//! A thin coating bends the pressure at the edge of contact within its thickness. What the elements see of that decides how
//! well the localized solution reads its radius.

use crate::{Check, Data, Outcome, StudyError};
use percoat_core::body::{HalfSpace, Interface, Layer, Material, MeanStress};
use percoat_core::comparison::ComparisonTask;
use percoat_core::counterbody::{Indenters, Level, Shape};
use percoat_core::lattice::Lattice;
use percoat_core::load::Load;
use percoat_core::localized::{CircleRadius, Stop};
use percoat_core::problem::Problem;
use percoat_core::spectral::Settings;
use std::ops::ControlFlow;
use std::sync::Arc;

/// Elements along the contacts and samples along the cell.
const ELEMENTS: usize = 48;
const POINTS: usize = 512;
/// Relative error of the radius: a fiftieth of an element, …
const THIN: f64 = 1e-3;
/// … and where the coating is as thin as an element, whose pressure is even, or heaps the pressure on the outermost ones, a
/// fifteenth and a fifth.
const ELEMENT: f64 = 3e-3;
const HEAPED: f64 = 1e-2;

/// A coating on E₂ = 1, ν₂ = 0.3 under paraboloids of radius 1 on a hexagonal lattice of unit period.
pub struct Coating {
    young: f64,
    poisson: f64,
    thickness: f64,
    interface: Interface,
    mean_pressure: f64,
    /// Bound of the radius' relative difference.
    bound: f64,
}

/// Every coating.
pub fn coatings() -> Vec<Coating> {
    let of = |young, poisson, thickness, interface, mean_pressure, bound| Coating {
        young,
        poisson,
        thickness,
        interface,
        mean_pressure,
        bound,
    };
    let (bonded, frictionless) = (Interface::Bonded, Interface::Frictionless);
    vec![
        of(0.2, 0.3, 0.05, bonded, 0.02, THIN),
        of(0.2, 0.5, 0.05, bonded, 0.02, THIN),
        of(0.2, 0.3, 0.05, frictionless, 0.02, THIN),
        of(5.0, 0.3, 0.05, bonded, 0.02, THIN),
        of(5.0, 0.3, 0.05, frictionless, 0.02, THIN),
        of(0.1, 0.3, 0.01, bonded, 0.02, THIN),
        of(0.1, 0.3, 0.01, frictionless, 0.02, THIN),
        of(0.01, 0.3, 0.1, bonded, 0.004, THIN),
        of(10.0, 0.3, 0.01, bonded, 0.02, ELEMENT),
        of(100.0, 0.3, 0.1, frictionless, 0.05, ELEMENT),
        of(100.0, 0.3, 0.02, bonded, 0.02, HEAPED),
    ]
}

/// Checks and data of each coating.
pub fn thin_coatings(coatings: &[Coating], outcome: &mut Outcome) -> Result<(), StudyError> {
    let columns = [
        "young",
        "poisson",
        "thickness",
        "sliding",
        "mean_pressure",
        "contact_radius",
        "radius",
        "peak",
        "penetration",
    ];
    let mut data = Data::new("thin", &columns);
    for coating in coatings {
        let &Coating { young, poisson, thickness, interface, mean_pressure, bound } = coating;
        let layer = Layer::new(Material::from_young(young, poisson)?, thickness, interface)?;
        let half_space = HalfSpace::new(vec![layer], Material::from_young(1.0, 0.3)?);
        let level = Level::new(Shape::Paraboloid { radius: 1.0 }, 0.0)?;
        let indenters = Indenters::new(Lattice::hexagonal(1.0, 1)?, vec![level])?;
        let task = ComparisonTask {
            problem: Arc::new(Problem::new(indenters, half_space)),
            load: Load::MeanPressure(mean_pressure),
            settings: Settings::default(),
            indenters: vec![7],
            elements: ELEMENTS,
            rule: CircleRadius::LatticeSum,
            mutual_effect: true,
            mean: MeanStress::Confined,
        };
        let compared = task.compare([POINTS; 2], &mut |_| ControlFlow::Continue(()))?;
        let circle = compared.circles.first().ok_or("a circle is missing")?;
        let slides = interface == Interface::Frictionless;
        let name = format!(
            "E₁ = {young}, ν₁ = {poisson}, h = {thickness}, {}",
            if slides { "frictionless" } else { "bonded" }
        );
        if circle.stop != Stop::Converged || !compared.spectral.converged() {
            return Err(format!("{name}: {}, {}", circle.stop, compared.spectral.report()).into());
        }
        let difference = &circle.difference;
        let radius = compared.spectral.reading.levels[0].contact_radius.ok_or("the contacts have merged")?;
        data.rows.push(vec![
            young,
            poisson,
            thickness,
            f64::from(u8::from(slides)),
            mean_pressure,
            radius,
            difference.contact_radius,
            difference.max_pressure,
            difference.penetration,
        ]);
        outcome.checks.push(Check::at_most(format!("{name}: contact radius"), difference.contact_radius, bound));
        outcome.checks.push(Check::at_most(format!("{name}: penetration"), difference.penetration, 1e-3));
        // The pressure that a stiff coating heaps at the edge is a ridge narrower than an element.
        let peak = if bound == HEAPED { 0.05 } else { 1e-3 };
        outcome.checks.push(Check::at_most(format!("{name}: peak pressure"), difference.max_pressure, peak));
    }
    outcome.data.push(data);
    Ok(())
}
