//! Radius and area of one indenter on coatings thinner than the grid can see.
//!
//! The loads under which an indenter c rⁿ has the contact radius 1 follow from the integral equation of the contact
//! (`reference.csv`, and [`crate::exact::coated_contact`] for n = 2). The curvature that the images cause is taken out of
//! the indenter as in the study `isolated`.

use super::draw::{self, curve};
use super::steps::{Steps, fraction_in_contact, topography};
use super::{Check, Data, Outcome, Study, StudyError, Tolerance};
use crate::exact::{CoatedContact, Coating};
use percoat_app::picture::{Axis, Chart, Figure, Style};
use percoat_core::counterbody::{Counterbody, Indenters, Level, Shape};
use percoat_core::lattice::{Cell, Grid, Lattice};
use percoat_core::load::Load;
use std::f64::consts::PI;

pub const STUDY: Study = Study {
    name: "thin-coatings",
    title: "Contact radius and area on thin coatings, with their errors",
    files: &["figure.png", "thin-coatings.data.csv"],
    run: || run(&GRIDS),
    quick: Some(|| run(&GRIDS[..1])),
};

const REFERENCE: &str = include_str!("reference.csv");

/// Side of the cell over the contact radius.
const SIDE: f64 = 12.6;

/// Samples along the radius, error of the radius, and largest stated error.
const GRIDS: [(usize, f64, f64); 2] = [(20, 1.5e-3, 2e-2), (40, 6e-4, 8e-3)];

/// One solved contact of radius 1: its reading, relative to the truth, and its stated error.
struct Found {
    error: f64,
    stated: f64,
    counted: f64,
}

/// A row of the reference.
struct Contact {
    coating: Coating,
    young: f64,
    thickness: f64,
    exponent: f64,
    load: f64,
}

impl Contact {
    fn new(row: &[f64]) -> Result<Self, StudyError> {
        let &[young, poisson, thickness, exponent, load] = row else { return Err("a row too short".into()) };
        let coating = Coating::new(young * 1.3 / (1.0 + poisson), [poisson, 0.3], thickness)?;
        Ok(Self { coating, young, thickness, exponent, load })
    }

    /// Whether the coating carries by bending.
    fn is_plate(&self) -> bool {
        self.young > 100.0
    }

    /// c₂ of what the images add to the displacement around the axis, c₂r²: ¼∇²w of a hexagonal lattice of loads
    /// less that of one, each a Gaussian with the pressure's second moment (that of Galin's on a half-space),
    ///
    /// c₂ = −(P/2E*) [ (1/A) Σ g T(gh) e^{−g²s²/2} − (1/2π) ∫ q² T(qh) e^{−q²s²/2} dq ],  2s² = (2/3)(n+1)/(n+3).
    fn curvature_of_images(&self, side: f64) -> f64 {
        let square = (self.exponent + 1.0) / (self.exponent + 3.0) / 3.0;
        let h = self.coating.thickness();
        let term = |q: f64| q * self.coating.correction(q * h) * (-0.5 * q * q * square).exp();
        // Beyond, the Gaussian is below 1e-21.
        let end = 10.0 / square.sqrt();
        let least = 4.0 * PI / (3f64.sqrt() * side);
        let most = (end / least).ceil() as i32 * 2;
        let pairs = (-most..=most).flat_map(|i| (-most..=most).map(move |j| i * i + i * j + j * j));
        let lattice: f64 = pairs.filter(|&n| n > 0).map(|n| term(least * f64::from(n).sqrt())).sum();
        let steps = 40_000;
        let step = end / f64::from(steps);
        // The integrand is even and vanishes at the end: the trapezoidal rule is as good as exact.
        let alone: f64 = (1..steps).map(|k| f64::from(k) * step).map(|q| q * term(q)).sum::<f64>() * step;
        let area = 0.75f64.sqrt() * side * side;
        -self.load / (2.0 * self.coating.modulus()) * (lattice / area - alone / (2.0 * PI))
    }

    /// Solved with `samples` to the radius, as an indenter where it can be one and is not asked for as a topography.
    fn solved(&self, samples: usize, as_topography: bool) -> Result<Found, StudyError> {
        let points = (SIDE * samples as f64).round() as usize;
        let side = points as f64 / samples as f64;
        let c2 = self.curvature_of_images(side);
        let cell = Cell::hexagonal(side)?;
        let counterbody: Counterbody = if as_topography {
            let reduced = cell.reduced();
            topography(cell, [points; 2], |s, t| {
                let [x, y] = reduced.nearest([s - 0.5, t - 0.5]);
                let r = x.hypot(y);
                c2 * r * r - 0.5 * r.powf(self.exponent)
            })?
            .into()
        } else {
            let level = Level::new(Shape::Paraboloid { radius: 0.5 / (0.5 - c2) }, 0.0)?;
            Indenters::new(Lattice::new(cell, vec![vec![[0.0, 0.0]]])?, vec![level])?.into()
        };
        let mut steps = Steps::new(counterbody, self.coating.half_space(), [points; 2])?;
        let load = Load::MeanPressure(self.load / cell.area());
        let step = steps.step(load)?;
        let found = step.reading();
        let stated = found.errors.contact_fraction.ok_or("no stated error")?;
        let grid = Grid::new(cell, [points; 2])?;
        let count = step.pressure().iter().filter(|p| **p > 0.0).count() as f64;
        let radius = |area: f64| (area / PI).sqrt();
        let fraction = fraction_in_contact(&found)?;
        Ok(Found {
            error: radius(fraction * cell.area()) - 1.0,
            stated: 0.5 * stated / fraction,
            counted: radius(count * grid.sample_area()) - 1.0,
        })
    }
}

fn run(grids: &[(usize, f64, f64)]) -> Result<Outcome, StudyError> {
    let mut outcome = Outcome::default();
    let reference = Data::parse("reference", REFERENCE)?;
    let contacts: Vec<Contact> = reference.rows.iter().map(|row| Contact::new(row)).collect::<Result<_, _>>()?;
    let mut loads = Vec::new();
    for contact in contacts.iter().filter(|contact| contact.exponent == 2.0) {
        let exact = CoatedContact::new(&contact.coating, 1.0).ok_or("a singular system")?;
        loads.push((exact.load, contact.load));
    }
    outcome.checks.push(Check::worst("integral equation: load, h/a = 0.01 to 0.3", loads, Tolerance::Relative(1e-7)));

    let mut data = Data::new(
        "thin-coatings",
        &["samples", "young", "thickness", "exponent", "topography", "error", "stated", "counted"],
    );
    for &(samples, goal, stated_at_most) in grids {
        // The finer grid sees a part of the contacts, whose solution takes four times as long.
        let wanted = |contact: &&Contact| samples == 20 || contact.thickness == 0.03 || contact.young >= 100.0;
        let mut solved = Vec::new();
        for contact in contacts.iter().filter(wanted) {
            let paraboloid = contact.exponent == 2.0;
            let both = paraboloid && contact.thickness == 0.03 && samples == 20 && !contact.is_plate();
            for as_topography in [false, true] {
                if both || as_topography != paraboloid {
                    let found = contact.solved(samples, as_topography)?;
                    data.rows.push(vec![
                        samples as f64,
                        contact.young,
                        contact.thickness,
                        contact.exponent,
                        f64::from(u8::from(as_topography)),
                        found.error,
                        found.stated,
                        found.counted,
                    ]);
                    solved.push((as_topography, contact, found));
                }
            }
        }
        let largest = |wanted: &dyn Fn(bool, &Contact) -> bool, of: &dyn Fn(&Found) -> f64| {
            let wanted = solved.iter().filter(|(as_topography, contact, _)| wanted(*as_topography, contact));
            wanted.map(|(_, _, found)| of(found)).fold(0.0, f64::max)
        };
        for (name, topographies, plates) in [
            ("paraboloids", false, false),
            ("as topographies, cones and r⁴ too", true, false),
            ("paraboloids on plates, E₁/E₂ = 1000", false, true),
        ] {
            let worst = largest(
                &|as_topography, contact| as_topography == topographies && contact.is_plate() == plates,
                &|found| found.error.abs(),
            );
            outcome.checks.push(Check::absolute(format!("radius, {samples} samples: {name}"), worst, 0.0, goal));
        }
        if samples == 40 {
            let resolved =
                largest(&|as_topography, contact| !as_topography && contact.thickness * 40.0 >= 10.0, &|found| {
                    found.error.abs()
                });
            outcome.checks.push(Check::absolute("radius, h of ten samples and more", resolved, 0.0, 1e-3));
        }
        let held = solved.iter().filter(|(_, _, found)| found.error.abs() <= found.stated).count();
        let part = held as f64 / solved.len() as f64;
        outcome.checks.push(Check::at_least(format!("{samples} samples: errors within the stated ones"), part, 0.95));
        // A stated error that is always large holds too.
        let stated = largest(&|_, _| true, &|found| found.stated);
        outcome.checks.push(Check::at_most(format!("{samples} samples: largest stated error"), stated, stated_at_most));
    }
    outcome.figures.push(("figure", figure(&data)));
    outcome.data.push(data);
    Ok(outcome)
}

fn figure(found: &Data) -> Figure {
    let mut curves = Vec::new();
    for (young, colour) in [(0.1, 1), (0.5, 2), (2.0, 3), (10.0, 4), (100.0, 5), (1000.0, 6)] {
        let rows =
            || found.rows.iter().filter(move |row| row[0] == 20.0 && row[1] == young && row[3] == 2.0 && row[4] == 0.0);
        curves.push(curve(format!("E₁/E₂ = {young}"), Style::Line, colour, rows().map(|row| [row[2], 100.0 * row[5]])));
        curves.push(curve("", Style::Dotted, colour, rows().map(|row| [row[2], 100.0 * row[7]])));
    }
    let chart = Chart {
        title: String::new(),
        x: Axis::log("thickness over contact radius h/a"),
        y: Axis::linear("error of the radius (%)"),
        curves,
    };
    draw::figure(vec![chart], "Radius of a paraboloid's contact at 20 samples; dotted: from the number of samples.")
}
