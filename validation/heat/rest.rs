//! A Hertzian source and a uniform disc at rest, in closed form.
//!
//! T(r) = (πq₀/8aλ)(2a² − r²) and T(r) = (2qa/πλ) E(r/a); images of the power Q in squares of the side L add Q(S₁/L + S₃⟨r²⟩/4L³)/(2πλ).

use super::setup::{Stack, Stuff, flux, heat, paraboloid, place, sliding, solved, under_flux};
use super::sources::LATTICE;
use crate::{Check, Data, Outcome, StudyError, Tolerance};
use percoat_core::counterbody::{GivenPressure, LoadedDisc};
use percoat_core::heating::Heating;
use percoat_core::lattice::Cell;
use percoat_core::load::Load;
use percoat_core::spectral::Step;
use std::f64::consts::{PI, TAU};

const CONDUCTIVITY: f64 = 2.0;
/// Sides of the cell over the radius, and samples along them.
const GRIDS: [(f64, usize); 4] = [(8.0, 128), (8.0, 243), (8.0, 512), (12.0, 405)];
/// −∇²T over T of a source of the radius 1 in its middle, and of its mean over the source, where it counts twice: of Hertz and of the disc, whose
/// slope at the edge is that of a spacing before it.
const CURVED: [[f64; 2]; 2] = [[2.0, 5.0], [1.0, 6.4]];
/// Temperature of the images beyond the terms that are subtracted: S₅⟨r⁴⟩.
const IMAGES: f64 = 5e-6;

pub fn add(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let mut data = Data::new("rest", &["source", "side", "samples", "middle", "mean", "middle_exact", "mean_exact"]);
    let grids = if quick { &GRIDS[..2] } else { &GRIDS[..] };
    for &(side, points) in grids {
        data.rows.push(row(0, side, points)?);
        data.rows.push(row(1, side, points)?);
    }
    for (source, name) in ["Hertzian source", "uniform disc"].into_iter().enumerate() {
        for (what, place) in ["in its middle", "mean"].into_iter().enumerate() {
            let rows = data.rows.iter().filter(|row| row[0] == source as f64);
            let parts = rows.map(|row| {
                let allowed = CURVED[source][what] * row[2].powi(-2) / 12.0 + IMAGES;
                ((row[3 + what] / row[5 + what] - 1.0) / allowed, 0.0)
            });
            let name = format!("{name} at rest, temperature {place}, over what a grid makes");
            outcome.checks.push(Check::worst(name, parts, Tolerance::Absolute(1.0)));
        }
    }
    outcome.data.push(data);
    let contacts = if quick { &[(16.0, 256)][..] } else { &[(16.0, 256), (16.0, 512), (24.0, 675)] };
    let found = contacts.iter().map(|&(side, points)| contact(side, points)).collect::<Result<Vec<_>, _>>()?;
    outcome.checks.push(Check::worst(
        "paraboloid in contact, temperature in its middle, over 0.1 (h/a)^1.5",
        found.into_iter().map(|part| (part, 0.0)),
        Tolerance::Absolute(1.0),
    ));
    Ok(())
}

fn body() -> Stack {
    // So diffusive that the motion carries nothing along.
    Stack::bare(Stuff::new(1.0, [CONDUCTIVITY, 1e12, 0.0]))
}

/// Source, side, samples of a radius, temperatures in the middle and in the mean over the flux, and the known ones.
fn row(source: usize, side: f64, points: usize) -> Result<Vec<f64>, StudyError> {
    let h = side / points as f64;
    let given = if source == 0 {
        let hertz = |x: f64, y: f64| (1.0 - x * x - y * y).max(0.0).sqrt();
        flux([side; 2], [points; 2], |x, y| mean(hertz, [x, y], h))?
    } else {
        let disc = LoadedDisc { centre: [0.0; 2], radius: 1.0, pressure: 1.0 };
        GivenPressure::discs(Cell::square(side)?, vec![disc])?
    };
    let step = under_flux(given, &body(), 1.0, [points; 2])?;
    let square = [0.4, 0.5][source];
    let power = heat(&step)?.friction.iter().sum::<f64>() * h * h;
    let lone = temperatures(&step)?.into_iter().zip([square, 2.0 * square]);
    let lone = lone.map(|(value, square)| value - power * images(side, square));
    let exact = if source == 0 {
        [PI / 4.0, PI / 5.0].map(|value| value / CONDUCTIVITY)
    } else {
        [1.0, 8.0 / (3.0 * PI)].map(|value| value / CONDUCTIVITY)
    };
    Ok([source as f64, side, 1.0 / h].into_iter().chain(lone).chain(exact).collect())
}

/// Mean of a function over the cell of a sample.
fn mean(value: impl Fn(f64, f64) -> f64, [x, y]: [f64; 2], h: f64) -> f64 {
    const PARTS: usize = 16;
    let shift = |n: usize| h * ((n as f64 + 0.5) / PARTS as f64 - 0.5);
    let all = (0..PARTS * PARTS).map(|n| value(x + shift(n / PARTS), y + shift(n % PARTS)));
    all.sum::<f64>() / (PARTS * PARTS) as f64
}

/// Temperature that the images of the power 1 add, at a mean square distance from the source.
fn images(side: f64, square: f64) -> f64 {
    (LATTICE[0] / side + 0.25 * LATTICE[1] * square / side.powi(3)) / (TAU * CONDUCTIVITY)
}

/// Temperature of the first sample, and the mean over the flux.
fn temperatures(step: &Step) -> Result<[f64; 2], StudyError> {
    let heat = heat(step)?;
    let [sum, whole] = heat.body.iter().zip(&heat.flux).fold([0.0; 2], |[s, w], (t, q)| [s + t * q, w + q]);
    Ok([heat.body[0], sum / whole])
}

/// Error of T(0) = 3Q/(8λa) below a paraboloid pressed with the force of Hertz' radius 1, over 0.1 (h/a)^1.5. Images make its gap steeper by the part
/// (2S₃/3π)(a/L)³ and the radius smaller by a third of it.
fn contact(side: f64, points: usize) -> Result<f64, StudyError> {
    let stuff = Stuff { young: 1e6, ..Stuff::new(1.0, [CONDUCTIVITY, 1e12, 0.0]) };
    let bodies = Stack::bare(stuff).half_space()?;
    let force = 4.0 / 3.0 * 1e6 / 0.91 / 1e3;
    let problem = sliding(paraboloid(side, 1e3)?, bodies, [0.3, 1.0], Heating::default().without_expansion())?;
    let step = solved(problem, [points; 2], Load::Force(force))?;
    let power = 0.3 * force;
    let steeper = 2.0 * LATTICE[1] / (3.0 * PI * side.powi(3));
    let known = 3.0 * power / (8.0 * CONDUCTIVITY) * (1.0 + steeper / 3.0);
    let apex = (0..points).find(|&i| place(i, points, side).abs() < 1e-12).unwrap_or(0);
    let found = heat(&step)?.body[apex * (points + 1)] - power * images(side, 0.4);
    Ok((found / known - 1.0) / (0.1 * (side / points as f64).powf(1.5)))
}
