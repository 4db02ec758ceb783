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
        "kalker.data.csv",
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
    // The dense solution is a line a body: rows of a body follow each other, and the last ones are those of the finest grid.
    let against = |data: &Data, found: &str, exact: &str| {
        let [chi, nu, h, part, found, exact] = ["chi", "nu", "h", "part", found, exact].map(|name| data.column(name));
        let points = data.column("points");
        let finest = points.iter().copied().fold(0.0, f64::max);
        let kept: Vec<usize> =
            (0..part.len()).filter(|&i| points.get(i).is_none_or(|points| *points == finest)).collect();
        let bodies = kept.chunk_by(|&i, &j| [chi[i], nu[i], h[i]] == [chi[j], nu[j], h[j]]);
        let named = |index: usize| if index == 0 { "dense solution, a line a body" } else { "" };
        let dense = bodies
            .enumerate()
            .map(|(index, body)| curve(named(index), Style::Line, 0, body.iter().map(|&i| [part[i], exact[i]])));
        let percoat = curve("percoat", Style::Markers, 1, kept.iter().map(|&i| [part[i], found[i]]));
        dense.chain([percoat]).collect::<Vec<_>>()
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
