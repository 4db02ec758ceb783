//! Coated waves in plane strain: shifts, widths that stick, and cycles of a dense solution.

use super::setup::{to_part, wave, width};
use crate::{Check, Data, Outcome, StudyError, Tolerance};
use percoat_core::load::Load;

const WAVES: &str = include_str!("waves.csv");
const CYCLES: &str = include_str!("cycles.csv");
/// Mean pressure.
pub const MEAN: f64 = 0.01;
/// Points along the wave.
const SIZES: [usize; 4] = [512, 1024, 2048, 4096];

pub fn add(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let sizes = if quick { &SIZES[3..] } else { &SIZES[..] };
    let columns = [
        "points",
        "chi",
        "nu",
        "h",
        "part",
        "shift",
        "shift_exact",
        "stick",
        "stick_exact",
        "middle",
        "middle_exact",
        "iterations",
    ];
    let mut data = Data::new("waves", &columns);
    for &points in sizes {
        for row in Data::parse("waves", WAVES)?.rows {
            let [chi, nu, h, part, stick, shift, middle] = row[..] else {
                return Err("a wave has seven numbers".into());
            };
            if quick && part != 0.6 {
                continue;
            }
            let step = to_part(&mut wave([chi, nu, h], points)?, Load::MeanPressure(MEAN), part)?;
            let contact = step.contact.finest();
            let shear = contact.shear().ok_or("there is no shear")?;
            let sticking = (0..contact.pressures().len()).filter(|&i| shear.sticks(i, contact.pressures()[i])).count();
            let found = 0.5 * sticking as f64 / (points * super::setup::ROWS) as f64;
            let difference = contact.pressures()[0] - shear.traction[0][0];
            let iterations = step.report.iterations as f64;
            data.rows.push(vec![
                points as f64,
                chi,
                nu,
                h,
                part,
                step.shift.value[0],
                shift,
                found,
                stick,
                difference,
                middle,
                iterations,
            ]);
        }
    }
    let at = |points: usize, name: &str| -> Vec<f64> {
        let rows = data.column("points").into_iter().zip(data.column(name));
        rows.filter(|row| row.0 == points as f64).map(|row| row.1).collect()
    };
    let finest = SIZES[3];
    let pairs = |name: &str| at(finest, name).into_iter().zip(at(finest, &format!("{name}_exact"))).collect::<Vec<_>>();
    outcome.checks.push(Check::worst("coated waves: shift, 4096 points", pairs("shift"), Tolerance::Relative(1e-5)));
    // A sample and a half at each of both ends, halved.
    let edge = 1.5 / finest as f64;
    outcome.checks.push(Check::worst(
        "coated waves: half of the width that sticks",
        pairs("stick"),
        Tolerance::Absolute(edge),
    ));
    let known: Vec<(f64, f64)> = pairs("middle").into_iter().filter(|pair| pair.1 > 0.0).collect();
    outcome.checks.push(Check::worst("coated waves: p − q/μ in the middle", known, Tolerance::Relative(1e-4)));
    if !quick {
        let mean = |points: usize| {
            let all = at(points, "shift").into_iter().zip(at(points, "shift_exact"));
            all.map(|(found, exact)| (found / exact - 1.0).abs()).sum::<f64>()
        };
        // The pressure ends like a square root, of which a sum over samples errs by the spacing to the power 3/2.
        let order = (mean(SIZES[0]) / mean(finest)).log2() / 3.0;
        outcome.checks.push(Check::at_least(
            "coated waves: order of convergence of the shift, 512 to 4096 points",
            order,
            1.5,
        ));
    }
    cycles(outcome, quick)?;
    outcome.data.push(data);
    Ok(())
}

/// Energies of a cycle.
fn cycles(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let points = SIZES[3];
    let mut data = Data::new("cycles", &["chi", "nu", "h", "part", "cycle", "cycle_exact"]);
    for row in Data::parse("cycles", CYCLES)?.rows {
        let [chi, nu, h, part, cycle] = row[..] else { return Err("a cycle has five numbers".into()) };
        if quick && chi != 4.0 {
            continue;
        }
        let mut solver = wave([chi, nu, h], points)?;
        let mut to = |part: f64| to_part(&mut solver, Load::MeanPressure(MEAN), part);
        let (_, down, again) = (to(part)?, to(-part)?, to(part)?);
        let found = (down.work.value + again.work.value) / width(points);
        data.rows.push(vec![chi, nu, h, part, found, cycle]);
    }
    let pairs = data.column("cycle").into_iter().zip(data.column("cycle_exact"));
    // 4e-5 at 2048 points, of the order 3/2.
    outcome.checks.push(Check::worst("coated waves: energy of a cycle, 4096 points", pairs, Tolerance::Relative(4e-5)));
    outcome.data.push(data);
    Ok(())
}
