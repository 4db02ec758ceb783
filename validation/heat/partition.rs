//! Partition of the heat between two bodies: stationary ones, a table of speeds, a dense solution, and the steps of the linear solve.

use super::setup::{AT_REST, Sheet, Stack, Stuff, heat, paraboloid, sliding, solved};
use crate::random::Random;
use crate::{Check, Data, Outcome, StudyError, Tolerance};
use percoat_core::body::Bodies;
use percoat_core::heating::{Heating, Partition};
use percoat_core::lattice::Cell;
use percoat_core::load::Load;
use percoat_core::reading::TemperatureReading;
use percoat_core::spectral::Step;
use rustfft::num_complex::Complex64;
use std::f64::consts::TAU;

/// Share of the body, κ = λ = 1 below λ = 3 at rest, of a Hertzian source of the radius 1 in a cell of the side 8 at these speeds: a prototype.
const TABLE: [[f64; 2]; 5] = [[AT_REST, 0.25], [1.0, 0.26723], [10.0, 0.38032], [100.0, 0.49692], [1000.0, 0.54370]];
/// Names of the bodies whose steps are counted.
pub const NAMES: [&str; 3] = ["bare", "insulating coat", "conducting coat"];
/// Steps of a prototype, at most.
const STEPS: f64 = 16.0;
const YOUNG: f64 = 1e6;

pub fn add(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    table(outcome, if quick { 128 } else { 256 })?;
    rest(outcome, quick)?;
    dense(outcome, quick)?;
    steps(outcome, quick)
}

/// A step of two bodies below a paraboloid of the contact radius 1 in a cell of the side 8.
pub fn pressed(body: &Stack, above: &Stack, velocity: f64, points: usize) -> Result<Step, StudyError> {
    let bodies = Bodies::elastic(body.half_space()?, above.half_space()?);
    let heating = Heating::default().without_expansion();
    let problem = sliding(paraboloid(8.0, 1e3)?, bodies, [0.3, velocity], heating)?;
    solved(problem, [points; 2], Load::Force(4.0 / 3.0 * YOUNG / 1.82 / 1e3))
}

pub fn bare(conductivity: f64) -> Stack {
    Stack::bare(Stuff::new(YOUNG, [conductivity, 1.0, 0.0]))
}

/// A coat a tenth of the contact radius thick.
pub fn coated(conductivity: f64) -> Stack {
    let sheet = Sheet::bonded(Stuff::new(YOUNG, [conductivity, 1.0, 0.0]), 0.1);
    Stack { sheets: vec![sheet], ..bare(1.0) }
}

fn table(outcome: &mut Outcome, points: usize) -> Result<(), StudyError> {
    let mut data = Data::new("partition", &["velocity", "share", "known"]);
    for [velocity, known] in TABLE {
        let step = pressed(&bare(1.0), &bare(3.0), velocity, points)?;
        data.rows.push(vec![velocity, heat(&step)?.share, known]);
    }
    let pairs = data.rows.iter().map(|row| (row[1], row[2]));
    outcome.checks.push(Check::worst("share of a moving body", pairs, Tolerance::Absolute(1e-3)));
    outcome.data.push(data);
    Ok(())
}

/// Bodies at rest: the share λ₁/(λ₁ + λ₂) at every sample, one temperature in contact, and all heat in one of them.
fn rest(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let (mut shares, mut apart, mut lost) = (Vec::new(), Vec::new(), Vec::new());
    let sizes = if quick { &[64, 81][..] } else { &[64, 81, 128, 135, 256] };
    for &points in sizes {
        for ratio in [0.1, 3.0, 40.0] {
            let step = pressed(&bare(1.0), &bare(ratio), AT_REST, points)?;
            let (heat, known) = (heat(&step)?, 1.0 / (1.0 + ratio));
            let in_contact = (0..heat.flux.len()).filter(|&i| heat.friction[i] > 0.0);
            let largest = heat.friction.iter().copied().fold(0.0, f64::max);
            shares.extend(in_contact.map(|i| ((heat.flux[i] - known * heat.friction[i]) / largest, 0.0)));
            apart.push((differs(&step)?, 0.0));
            lost.push((outside(&step)?, 0.0));
        }
    }
    for velocity in [1.0, 30.0, 1000.0] {
        for (below, above) in [(bare(1.0), bare(3.0)), (coated(0.05), bare(3.0)), (coated(20.0), coated(0.05))] {
            let step = pressed(&below, &above, velocity, sizes[1])?;
            apart.push((differs(&step)?, 0.0));
            lost.push((outside(&step)?, 0.0));
        }
    }
    let mut add = |name: &str, pairs: Vec<(f64, f64)>, tolerance| {
        outcome.checks.push(Check::worst(name, pairs, Tolerance::Absolute(tolerance)));
    };
    add("bodies at rest, flux of every sample less λ₁/(λ₁ + λ₂) of the friction's, over the largest", shares, 1e-7);
    add("difference of temperatures in contact, over the largest", apart, 1e-8);
    add("flux outside the contact", lost, 0.0);
    Ok(())
}

/// Largest difference of both surfaces in contact over the largest temperature.
fn differs(step: &Step) -> Result<f64, StudyError> {
    let heat = heat(step)?;
    let above = heat.counterbody.as_ref().ok_or("a rigid counterbody")?;
    let largest = heat.body.iter().fold(0.0f64, |most, t| most.max(t.abs()));
    let in_contact = (0..heat.flux.len()).filter(|&i| heat.friction[i] > 0.0);
    Ok(in_contact.map(|i| (heat.body[i] - above[i]).abs()).fold(0.0, f64::max) / largest)
}

/// Sum of the fluxes into either body where nothing touches.
fn outside(step: &Step) -> Result<f64, StudyError> {
    let heat = heat(step)?;
    Ok((0..heat.flux.len()).filter(|&i| heat.friction[i] == 0.0).map(|i| heat.flux[i].abs()).sum())
}

/// The same discrete equations as a full matrix, on grids of odd numbers of samples, with bulk temperatures that drive heat too.
fn dense(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let (mut random, mut pairs) = (Random::new(1958), Vec::new());
    for _ in 0..if quick { 2 } else { 12 } {
        let points = [[21, 27], [25, 33], [35, 35]][random.index(3)];
        // Right-angled: what wave stands for its aliases is then known.
        let cell = Cell::new([1.0, 0.0], [0.0, random.between(0.8, 1.2)])?;
        let phase = random.between(0.0, 1.0);
        let wave = |s: f64, t: f64| (TAU * s).cos() + (TAU * (t + phase)).cos() + 0.7 * (TAU * (2.0 * s - t)).cos();
        let surface = crate::steps::topography(cell, points, |s, t| 1e-3 * wave(s, t))?;
        let [below, above] = [0, 1].map(|_| random.logarithmic(0.1, 10.0));
        let (velocity, friction) = (random.logarithmic(0.1, 300.0), 0.2);
        let bulk = [random.between(-1.0, 1.0) * 1e-4 * velocity, 0.0];
        let stuff = |conductivity| Stack::bare(Stuff::new(1.0, [conductivity, 1.0, 0.0])).half_space();
        let heating = Heating::new(Partition::Solved, bulk)?.without_expansion();
        let bodies = Bodies::elastic(stuff(below)?, stuff(above)?);
        let problem = sliding(surface, bodies, [friction, velocity], heating)?;
        let step = solved(problem, points, Load::MeanPressure(1e-3))?;
        let known = fluxes(&step, [below, above, velocity, bulk[1] - bulk[0]])?;
        let largest = known.iter().fold(0.0f64, |most, q| most.max(q.abs()));
        pairs.extend(heat(&step)?.flux.iter().zip(known).map(|(found, known)| ((found - known) / largest, 0.0)));
    }
    let name = "flux of a rough contact, against a dense solution, over the largest";
    outcome.checks.push(Check::worst(name, pairs, Tolerance::Absolute(1e-8)));
    Ok(())
}

/// (K₁ + K₂)q₁ = K₂q + T₂ − T₁ in contact, K the sums of waves 1/λs.
fn fluxes(step: &Step, [below, above, velocity, jump]: [f64; 4]) -> Result<Vec<f64>, StudyError> {
    let ([n1, n2], [b1, b2]) = (step.grid().points(), step.grid().cell().reciprocal());
    let friction = &heat(step)?.friction;
    let centred = |i: usize, n: usize| if 2 * i > n { i as f64 - n as f64 } else { i as f64 };
    // Influence of a sample on one that lies (i, j) further on, of both bodies.
    let influence = |i: usize, j: usize| -> [f64; 2] {
        let (mut sums, count) = ([0.0; 2], (n1 * n2) as f64);
        for (m, n) in (0..n1 * n2).map(|m| (m / n2, m % n2)).skip(1) {
            let [u, v] = [centred(m, n1), centred(n, n2)];
            let k = [0, 1].map(|axis| u * b1[axis] + v * b2[axis]);
            let square = k[0] * k[0] + k[1] * k[1];
            let angle = TAU * (u * i as f64 / n1 as f64 + v * j as f64 / n2 as f64);
            let turn = Complex64::from_polar(1.0 / count, angle);
            sums[0] += (turn / (below * Complex64::new(square, -k[0] * velocity).sqrt())).re;
            sums[1] += turn.re / (above * square.sqrt());
        }
        sums
    };
    let table: Vec<[f64; 2]> = (0..n1 * n2).map(|m| influence(m / n2, m % n2)).collect();
    let from = |to: usize, of: usize| {
        let [i, j] = [(to / n2 + n1 - of / n2) % n1, (to % n2 + n2 - of % n2) % n2];
        table[i * n2 + j]
    };
    let set: Vec<usize> = (0..n1 * n2).filter(|&m| friction[m] > 0.0).collect();
    let row = |&to: &usize| -> Vec<f64> {
        let both = set.iter().map(|&of| from(to, of).iter().sum::<f64>());
        let heated: f64 = set.iter().map(|&of| from(to, of)[1] * friction[of]).sum();
        both.chain([heated + jump]).collect()
    };
    let found = eliminated(set.iter().map(row).collect());
    let mut flux = vec![0.0; n1 * n2];
    set.iter().zip(found).for_each(|(&m, q)| flux[m] = q);
    Ok(flux)
}

/// Elimination with pivots, the right side in the last column.
fn eliminated(mut rows: Vec<Vec<f64>>) -> Vec<f64> {
    let n = rows.len();
    for k in 0..n {
        let pivot = (k..n).max_by(|&a, &b| rows[a][k].abs().total_cmp(&rows[b][k].abs())).unwrap_or(k);
        rows.swap(k, pivot);
        let (done, left) = rows.split_at_mut(k + 1);
        for row in left {
            let factor = row[k] / done[k][k];
            row.iter_mut().zip(&done[k]).skip(k).for_each(|(x, y)| *x -= factor * y);
        }
    }
    let mut x = vec![0.0; n];
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|j| rows[k][j] * x[j]).sum();
        x[k] = (rows[k][n] - known) / rows[k][k];
    }
    x
}

/// Steps of the linear solve from coarse to fine grids and from rest to the fastest motion.
fn steps(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let mut data = Data::new("steps", &["body", "velocity", "points", "steps", "share"]);
    let sizes = if quick { &[64, 81][..] } else { &[64, 81, 128, 256, 375, 512] };
    let velocities = if quick { &[1.0, 1000.0][..] } else { &[AT_REST, 1.0, 10.0, 100.0, 1000.0, 1e4] };
    for (number, body) in [bare(1.0), coated(0.05), coated(20.0)].iter().enumerate() {
        for &velocity in velocities {
            for &points in sizes {
                let step = pressed(body, &bare(3.0), velocity, points)?;
                let share = 1.0 - TemperatureReading::of(&step).ok_or("nothing heats")?.counterbody_share;
                let row = [number as f64, velocity, points as f64, heat(&step)?.steps as f64, share];
                data.rows.push(row.to_vec());
            }
        }
    }
    for (number, name) in NAMES.into_iter().enumerate() {
        let counts = data.rows.iter().filter(|row| row[0] == number as f64 && row[1] < 2e3).map(|row| (row[3], STEPS));
        outcome.checks.push(Check::worst(format!("steps of the partition, {name}"), counts, Tolerance::AtMost));
    }
    outcome.data.push(data);
    Ok(())
}
