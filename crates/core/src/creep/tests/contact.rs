//! Contact that creeps on a small grid, by assembled matrices: what retardation and history are for.
//!
//! In each interval g = C p + known + f − δ, g ≥ 0, p ≥ 0, gp = 0 with a given load is solved by an active set and elimination.

use super::super::{History, Retardation, RetardationModes};
use super::{layer, material};
use crate::body::{Bodies, HalfSpace, Interface, Material, Relaxation};
use crate::numeric::linear::solve;
use rustfft::num_complex::Complex64;
use std::f64::consts::TAU;

/// Samples along each side of a unit cell.
const N: usize = 24;

/// Fourier transform of a field by sums along both sides, forwards for the sign −1.
fn transformed(field: &[Complex64], sign: f64) -> Vec<Complex64> {
    let turn = |k: usize, i: usize| Complex64::from_polar(1.0, sign * TAU * ((k * i) % N) as f64 / N as f64);
    let turns: Vec<Complex64> = (0..N * N).map(|index| turn(index / N, index % N)).collect();
    let along = |field: &[Complex64]| -> Vec<Complex64> {
        // Transposes, so that twice gives both sides.
        let sum = |k: usize, row: usize| (0..N).map(|i| field[row * N + i] * turns[k * N + i]).sum();
        (0..N * N).map(|index| sum(index / N, index % N)).collect()
    };
    along(&along(field))
}

/// A gap on the grid, and the shell of each of its waves; the last one is the mean.
struct Cell {
    gap: Vec<f64>,
    shells: Vec<u32>,
    wavenumbers: Vec<f64>,
}

/// Pressure, penetration and samples in contact.
#[derive(Debug, Clone)]
struct Contact {
    pressure: Vec<f64>,
    penetration: f64,
    area: usize,
}

impl Cell {
    /// A paraboloid of radius one, aside of the samples so that none are equal.
    fn new() -> Self {
        let fold = |i: usize| i.min(N - i);
        let place = |i: usize, aside: f64| {
            let x = i as f64 / N as f64 - 0.5 - aside;
            0.5 * x * x
        };
        let gap = (0..N * N).map(|i| place(i / N, 0.0037) + place(i % N, 0.0101)).collect();
        let squares: Vec<usize> = (0..N * N).map(|i| fold(i / N).pow(2) + fold(i % N).pow(2)).collect();
        let mut all: Vec<usize> = squares.iter().copied().filter(|&square| square > 0).collect();
        all.sort_unstable();
        all.dedup();
        let wavenumbers = all.iter().map(|&square| TAU * (square as f64).sqrt()).collect();
        let shells = squares.iter().map(|square| all.binary_search(square).unwrap_or(all.len()) as u32).collect();
        Self { gap, shells, wavenumbers }
    }

    fn modes(&self, bodies: &Bodies) -> Vec<RetardationModes> {
        let retardation = Retardation::new(bodies);
        let mut modes = retardation.modes_of(&self.wavenumbers);
        modes.push(retardation.mean_modes());
        modes
    }

    /// Contact under a mean pressure with the compliance of each shell and a known displacement, from the samples that may be in contact.
    fn solved(&self, compliances: &[f64], known: &[f64], load: f64, start: &[f64]) -> Contact {
        let multiplier: Vec<Complex64> = self.shells.iter().map(|&shell| compliances[shell as usize].into()).collect();
        let kernel: Vec<f64> = transformed(&multiplier, 1.0).iter().map(|value| value.re / (N * N) as f64).collect();
        let entry = |i: usize, k: usize| kernel[(i / N + N - k / N) % N * N + (i % N + N - k % N) % N];
        let mut set: Vec<bool> = start.iter().map(|&p| p > 0.0).collect();
        for _ in 0..60 {
            let inside: Vec<usize> = (0..N * N).filter(|&i| set[i]).collect();
            let row = |&i: &usize| inside.iter().map(|&k| entry(i, k)).chain([-1.0]).collect();
            let mut rows: Vec<Vec<f64>> = inside.iter().map(row).collect();
            rows.push(inside.iter().map(|_| 1.0).chain([0.0]).collect());
            let mut right: Vec<f64> = inside.iter().map(|&i| -self.gap[i] - known[i]).collect();
            right.push(load * (N * N) as f64);
            let solution = solve(rows, right).unwrap();
            let penetration = solution[inside.len()];
            let mut pressure = vec![0.0; N * N];
            inside.iter().zip(&solution).for_each(|(&i, &p)| pressure[i] = p);
            let opening = |i: usize| {
                let elastic: f64 = inside.iter().map(|&k| entry(i, k) * pressure[k]).sum();
                elastic + known[i] + self.gap[i] - penetration
            };
            let next: Vec<bool> =
                (0..N * N).map(|i| if set[i] { pressure[i] > 0.0 } else { opening(i) < 0.0 }).collect();
            if next == set {
                return Contact { pressure, penetration, area: inside.len() };
            }
            set = next;
        }
        panic!("the set of contact changes for ever");
    }

    /// Contacts after each duration, under a mean pressure that depends on time.
    fn path(&self, modes: &[RetardationModes], durations: &[f64], load: impl Fn(f64) -> f64) -> Vec<Contact> {
        let mut history = History::new(modes, self.shells.clone());
        let (mut time, mut pressure, mut contacts) = (0.0, vec![1.0; N * N], Vec::new());
        for &duration in durations {
            time += duration;
            let interval = history.interval(duration);
            let scale = 1.0 / (N * N) as f64;
            let known: Vec<f64> = transformed(&history.known(&interval), 1.0).iter().map(|w| w.re * scale).collect();
            let contact = self.solved(&history.compliances(&interval), &known, load(time), &pressure);
            pressure = contact.pressure.clone();
            let spectrum: Vec<Complex64> = pressure.iter().map(|&p| p.into()).collect();
            history.advance(&interval, &transformed(&spectrum, -1.0));
            contacts.push(contact);
        }
        contacts
    }
}

fn uniform(end: f64, steps: usize) -> Vec<f64> {
    let step = end / steps as f64;
    [0.0].into_iter().chain(std::iter::repeat_n(step, steps)).collect()
}

/// A material that relaxes by two terms, the bulk modulus constant.
fn relaxing(material: Material) -> Material {
    let shear = [2.0, 5.0].map(|part| part * material.shear());
    material.with_relaxation(Some(Relaxation::new(&shear, &[0.3, 1.0]).unwrap()))
}

/// A half-space that relaxes, one with a coating that does, and a coating that does on a rigid base.
fn all_bodies() -> [Bodies; 3] {
    let layer = layer(relaxing(material(0.3, 0.45)), 0.1, Interface::Bonded);
    [
        HalfSpace::new(vec![], relaxing(material(1.0, 0.3))).into(),
        HalfSpace::new(vec![layer], material(1.0, 0.3)).into(),
        HalfSpace::on_rigid_base(vec![layer]).unwrap().into(),
    ]
}

/// E. H. Lee and J. R. M. Radok, J. Appl. Mech. 27, 438 (1960): while contact grows under a held load P, q = ∫ C(t − t′) dp(t′) is the pressure
/// of an elastic contact of compliance one under the load C(t)P. The sums over intervals have the same property, in any number of steps.
#[test]
fn a_homogeneous_body_under_a_held_load_is_elastic_at_every_time() {
    let cell = Cell::new();
    let bodies = &all_bodies()[0];
    let modes = cell.modes(bodies);
    for steps in [5, 20, 80] {
        let durations = uniform(20.0, steps);
        let contacts = cell.path(&modes, &durations, |_| 0.01);
        assert!(contacts[steps].area > contacts[0].area + 15, "contact grows");
        for (n, contact) in contacts.iter().enumerate() {
            let time = 20.0 * n as f64 / steps as f64;
            let compliances: Vec<f64> = modes.iter().map(|modes| modes.after(time)).collect();
            let elastic = cell.solved(&compliances, &[0.0; N * N], 0.01, &contact.pressure);
            assert_eq!(contact.area, elastic.area, "{steps} steps, t {time}");
            assert!((contact.penetration / elastic.penetration - 1.0).abs() < 1e-13, "{steps} steps, t {time}");
        }
    }
}

/// Loading and unloading by a cosine: differences of successive halvings fall by four. Samples that join and leave in one step or the next
/// scatter them by a tenth.
#[test]
fn steps_are_of_second_order_through_loading_and_unloading() {
    let cell = Cell::new();
    for bodies in all_bodies() {
        let modes = cell.modes(&bodies);
        let penetrations = [10, 20, 80, 160].map(|steps| {
            let contacts =
                cell.path(&modes, &uniform(1.5, steps), |time| 0.001 + 0.01 * (1.0 - (0.5 * TAU * time).cos()));
            let most = contacts.iter().map(|contact| contact.area).max().unwrap();
            assert!(contacts[steps].area + 5 < most, "contact shrinks again");
            contacts[steps].penetration
        });
        let [coarse, fine] = [penetrations[1] - penetrations[0], penetrations[3] - penetrations[2]];
        let order = (coarse / fine).log2() / 3.0;
        assert!((order - 2.0).abs() < 0.1, "{bodies}: {order}");
    }
}

/// The glassy body at first, and the relaxed one in the end.
#[test]
fn a_held_load_begins_glassy_and_ends_relaxed() {
    let cell = Cell::new();
    let durations: Vec<f64> = [0.0].into_iter().chain((0..30).map(|n| 0.01 * 3f64.powi(n))).collect();
    for bodies in all_bodies() {
        let modes = cell.modes(&bodies);
        let contacts = cell.path(&modes, &durations, |_| 0.01);
        let glassy: Vec<f64> = modes.iter().map(|modes| modes.glassy).collect();
        let mut relaxed: Vec<f64> = cell.wavenumbers.iter().map(|&k| bodies.compliance(k)).collect();
        relaxed.push(bodies.mean_compliance());
        for (contact, compliances) in [(&contacts[0], glassy), (&contacts[30], relaxed)] {
            let elastic = cell.solved(&compliances, &[0.0; N * N], 0.01, &contact.pressure);
            assert_eq!(contact.area, elastic.area);
            assert!((contact.penetration / elastic.penetration - 1.0).abs() < 1e-10, "{bodies}");
        }
    }
}
