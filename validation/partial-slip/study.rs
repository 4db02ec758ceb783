//! Partial slip and rolling against closed forms, dense solutions and converged numbers.

mod counts;
mod coupled;
mod rolling;
mod setup;
mod spheres;
mod waves;

use super::draw::{self, curve};
use super::{Data, Outcome, Study, StudyError};
use percoat_app::picture::{Axis, Chart, Style};

pub const STUDY: Study = Study {
    name: "partial-slip",
    title: "Partial slip and rolling: shifts, cycles, creepages, a dense coupled contact, and iterations",
    files: &[
        "balls.data.csv",
        "converged.data.csv",
        "coupled.data.csv",
        "cycles.data.csv",
        "figure.png",
        "iterations.data.csv",
        "proportional.data.csv",
        "punch.data.csv",
        "rolling.data.csv",
        "waves.data.csv",
    ],
    run: || run(false),
    quick: Some(|| run(true)),
};

fn run(quick: bool) -> Result<Outcome, StudyError> {
    let mut outcome = Outcome::default();
    spheres::add(&mut outcome, quick)?;
    waves::add(&mut outcome, quick)?;
    rolling::add(&mut outcome, quick)?;
    coupled::add(&mut outcome)?;
    counts::add(&mut outcome, quick)?;
    outcome
        .figures
        .push(("figure", draw::figure(charts(&outcome), "Shifts, creepages and iterations of partial slip.")));
    Ok(outcome)
}

/// Shifts of waves over the force, creepages, and iterations over the number of points.
fn charts(outcome: &Outcome) -> Vec<Chart> {
    let find = |name: &str| outcome.data.iter().find(|data| data.name == name).cloned().unwrap_or(Data::new("", &[]));
    let (waves, rolling, iterations) = (find("waves"), find("rolling"), find("iterations"));
    let against = |data: &Data, found: &str, exact: &str| {
        let parts = data.column("part");
        let points = |name: &str| parts.iter().copied().zip(data.column(name)).map(|(x, y)| [x, y]).collect::<Vec<_>>();
        let finest = data.column("points").into_iter().fold(0.0, f64::max);
        let kept = data.column("points").into_iter().map(|points| points == finest || finest == 0.0);
        let kept: Vec<bool> = kept.collect();
        let all = if kept.is_empty() { vec![true; parts.len()] } else { kept };
        let keep = |all: &[bool], points: Vec<[f64; 2]>| {
            points.into_iter().zip(all.to_vec()).filter(|(_, kept)| *kept).map(|(point, _)| point).collect::<Vec<_>>()
        };
        vec![
            curve("dense solution", Style::Markers, 0, keep(&all, points(exact))),
            curve("percoat", Style::Markers, 1, keep(&all, points(found))),
        ]
    };
    let counted = (0u8..).zip(counts::NAMES).map(|(index, name)| {
        let rows = iterations.rows.iter().filter(|row| row[0] == f64::from(index));
        curve(name, Style::Markers, usize::from(index), rows.map(|row| [row[1], row[3]]))
    });
    vec![
        Chart {
            title: "(a) shift of a wave".into(),
            x: Axis::linear("tangential force Q/μP"),
            y: Axis::linear("shift over μ"),
            curves: against(&waves, "shift", "shift_exact"),
        },
        Chart {
            title: "(b) creepage of a wave that rolls".into(),
            x: Axis::linear("tangential force Q/μP"),
            y: Axis::linear("creepage over μ"),
            curves: against(&rolling, "creepage", "creepage_exact"),
        },
        Chart {
            title: "(c) iterations of the tractions".into(),
            x: Axis::log("points along a side"),
            y: Axis::linear("iterations"),
            curves: counted.collect(),
        },
    ]
}
