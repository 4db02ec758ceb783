//! The homogeneous cases against Tamaas, a program of others (Frérot, Anciaux, Rey, Pham-Ba & Molinari, J. Open Source
//! Softw. 5 (2020) 2121).
//!
//! The numbers come from `validation/peer/tamaas_homogeneous.py`, on rectangular cells: a hexagonal lattice is there a
//! cell 1 × √3 with two indenters, here a rhombus with one.

use super::draw::{self, curve};
use super::steps::{Steps, fraction_in_contact, topography};
use super::{Check, Data, Outcome, Study, StudyError, Tolerance};
use percoat_app::picture::{Axis, Chart, Figure, Style};
use percoat_core::body::{HalfSpace, Material};
use percoat_core::counterbody::{Counterbody, Indenters, Level, Shape};
use percoat_core::lattice::{Cell, Lattice};
use std::f64::consts::TAU;

pub const STUDY: Study = Study {
    name: "peer",
    title: "Homogeneous half-spaces against Tamaas",
    files: &["figure.png", "peer.data.csv"],
    run,
    quick: None,
};

const REFERENCE: &str = include_str!("reference.csv");
const CASES: [&str; 4] = ["hexagonal lattice", "square lattice", "oblong lattice 1 × 2", "egg-box"];

/// Counterbody and points of a case, numbered from 1.
fn counterbody(number: usize) -> Result<(Counterbody, [usize; 2]), StudyError> {
    let lattice = |cell| -> Result<Counterbody, StudyError> {
        let lattice = Lattice::new(cell, vec![vec![[0.0, 0.0]]])?;
        Ok(Indenters::new(lattice, vec![Level::new(Shape::Paraboloid { radius: 0.8 }, 0.0)?])?.into())
    };
    Ok(match number {
        1 => (lattice(Cell::hexagonal(1.0)?)?, [480; 2]),
        2 => (lattice(Cell::square(1.0)?)?, [480; 2]),
        3 => (lattice(Cell::new([1.0, 0.0], [0.0, 2.0])?)?, [400, 800]),
        4 => {
            let wave = |s: f64, t: f64| 0.01 * (TAU * s).cos() * (TAU * t).cos();
            (topography(Cell::square(1.0)?, [480; 2], wave)?.into(), [480; 2])
        }
        _ => return Err(format!("no case {number}").into()),
    })
}

fn run() -> Result<Outcome, StudyError> {
    let reference = Data::parse("reference", REFERENCE)?;
    let half_space = HalfSpace::new(vec![], Material::from_young(1.0, 0.0)?);
    let mut data = Data { name: "peer", ..reference.clone() };
    data.rows.clear();
    let mut checks = Vec::new();
    for (number, name) in (1..).zip(CASES) {
        let rows: Vec<&Vec<f64>> = reference.rows.iter().filter(|row| row[0] == number as f64).collect();
        let (counterbody, points) = self::counterbody(number)?;
        let mut steps = Steps::new(counterbody, &half_space, points)?;
        let mut found = Vec::new();
        for row in &rows {
            let step = steps.loaded(row[1])?;
            let numbers = [step.penetration, step.max_pressure, fraction_in_contact(&step)?];
            found.push(numbers);
            data.rows.push([[number as f64, row[1]].as_slice(), &numbers].concat());
        }
        for (index, quantity, tolerance) in [
            (0, "penetration", Tolerance::Relative(1e-4)),
            (1, "peak pressure", Tolerance::Relative(1e-4)),
            // Counted samples are good for no more.
            (2, "fraction in contact", Tolerance::Absolute(2e-3)),
        ] {
            let pairs = found.iter().zip(&rows).map(|(found, row)| (found[index], row[2 + index]));
            checks.push(Check::worst(format!("{name}: {quantity}, {} loads", rows.len()), pairs, tolerance));
        }
    }
    Ok(Outcome { checks, figures: vec![("figure", figure(&data, &reference))], data: vec![data], ..Outcome::default() })
}

fn figure(found: &Data, reference: &Data) -> Figure {
    let panel = |quantity: &str, label: &str| {
        let of = |data: &Data, number: usize| -> Vec<[f64; 2]> {
            let column = data.column(quantity);
            let rows = data.rows.iter().zip(column).filter(|(row, _)| row[0] == number as f64);
            rows.map(|(row, value)| [row[1], value]).collect()
        };
        let curves = (1..).zip(CASES).flat_map(|(number, name)| {
            [
                curve(if number == 1 { "percoat" } else { "" }, Style::Line, number, of(found, number)),
                curve(format!("Tamaas, {name}"), Style::Markers, number, of(reference, number)),
            ]
        });
        Chart {
            title: String::new(),
            x: Axis::log("mean pressure p̄/E*"),
            y: Axis::log(label),
            curves: curves.collect(),
        }
    };
    let panels = vec![panel("peak", "peak pressure over E*"), panel("fraction", "fraction in contact")];
    draw::figure(panels, "Paraboloids R = 0.8 on three lattices and an egg-box of amplitude 0.01, period 1.")
}
