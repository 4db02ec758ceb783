//! Pressure that reaches a softer material beneath the surface.
//!
//! Below a contact of the radius a in an even body the pressure p₀ in its middle has fallen to p₀/(1 + z²/a²) at the depth z (Hertz; K. L.
//! Johnson, *Contact Mechanics*, 1985, Eq. 3.45), and over contacts that fill the plane not below the mean pressure. Where that exceeds the
//! hardness of the material there, it yields as a whole: a hard surface that bears the pressure is carried by a body that does not.
//!
//! Stiff layers spread the pressure. A layer of the thickness h counts as h (E₁*/E₂*)^⅓ of the material below it, which is as stiff a plate
//! (N. Odemark, Statens Väginstitut, Meddelande 77, 1949). Thin ones pass on all of the pressure.

use super::Reading;
use crate::body::{HalfSpace, Layer, MaterialId};
use crate::notation::number;
use crate::numeric::serialised;
use crate::problem::Problem;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;
use std::fmt;

/// Pressure above the hardness of a material beneath the surface.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Beneath {
    /// The material.
    #[serde(flatten)]
    pub material: MaterialId,
    /// Hardness of the material, a pressure.
    #[serde(deserialize_with = "serialised::number")]
    pub hardness: f64,
    /// Pressure that reaches it, about.
    #[serde(deserialize_with = "serialised::number")]
    pub pressure: f64,
    /// Depth of its upper face, a length.
    #[serde(deserialize_with = "serialised::number")]
    pub depth: f64,
    /// Radius of the contact, a length; that of a disc as large as the contact.
    #[serde(deserialize_with = "serialised::number")]
    pub radius: f64,
}

impl Beneath {
    /// The material beneath the surface whose hardness is exceeded most, by a reading on a grid of `points`; `None` where none is.
    pub(crate) fn of(problem: &Problem, reading: &Reading, points: [usize; 2]) -> Option<Self> {
        let spots = spots(problem, reading, points);
        let of_body = |body: &HalfSpace| -> Vec<Self> {
            let faces = body.interface_depths();
            let below = body.durabilities().skip(1).zip((2..).zip(faces));
            let known = below.filter_map(|(durability, (number, depth))| Some((durability.hardness?, number, depth)));
            let reached = known.map(|(hardness, number, depth)| {
                let [pressure, radius] = reaching(reading, &spots, equivalent_depth(body, number));
                Self { material: body.material_id(number), hardness, pressure, depth, radius }
            });
            reached.filter(|beneath| beneath.pressure > beneath.hardness).collect()
        };
        let all = problem.bodies().each().flat_map(of_body);
        all.max_by(|a, b| (a.pressure / a.hardness).total_cmp(&(b.pressure / b.hardness)))
    }
}

/// Pressure in the middle and radius of the contacts: of each level, or of the typical spot.
fn spots(problem: &Problem, reading: &Reading, [n1, n2]: [usize; 2]) -> Vec<[f64; 2]> {
    if reading.levels.is_empty() {
        let sample = problem.cell().area() / (n1 * n2) as f64;
        return vec![[reading.grid_peak(), reading.spot_resolution * sample.sqrt()]];
    }
    let touching = reading.levels.iter().filter(|level| level.touches());
    // Under a tip the mean pressure is finite.
    let of = |level: &super::LevelReading| {
        let pressure = level.finite_peak().unwrap_or(level.load / level.contact_area);
        [pressure, (level.contact_area / PI).sqrt()]
    };
    touching.map(of).collect()
}

/// Largest pressure that reaches a depth, and the radius of the contact that it comes from.
fn reaching(reading: &Reading, spots: &[[f64; 2]], depth: f64) -> [f64; 2] {
    let mean = reading.mean_pressure.unwrap_or(0.0);
    let passed = |&[pressure, radius]: &[f64; 2]| [pressure / (1.0 + (depth / radius).powi(2)), radius];
    let most = spots.iter().map(passed).max_by(|a, b| a[0].total_cmp(&b[0])).unwrap_or([0.0, 0.0]);
    [most[0].max(mean), most[1]]
}

/// Depth of a material (from 1) in an even body of it that spreads a pressure as the layers above do, a length.
fn equivalent_depth(body: &HalfSpace, number: usize) -> f64 {
    let below = body.material(number).contact_modulus();
    let of = |layer: &Layer| layer.thickness() * (layer.material().contact_modulus() / below).cbrt();
    body.layers()[..number - 1].iter().map(of).sum()
}

/// Largest pressure that reaches a material (from 1) of a body, about.
pub(crate) fn pressure_on(
    problem: &Problem,
    reading: &Reading,
    points: [usize; 2],
    (body, number): (&HalfSpace, usize),
) -> f64 {
    reaching(reading, &spots(problem, reading, points), equivalent_depth(body, number))[0]
}

impl fmt::Display for Beneath {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { material, hardness, pressure, depth, radius } = self;
        let [hardness, pressure, depth, radius] = [hardness, pressure, depth, radius].map(|x| number(*x));
        write!(
            f,
            "a pressure of about {pressure} reaches {material} at the depth {depth} below contacts of the radius {radius}, more than its \
             hardness {hardness}"
        )
    }
}
