//! Waves of heat on random stacks: temperature, flux, swelling and thermal stress at all depths.

use super::depth::{Fields, Wave};
use super::setup::{Sheet, Stack, Stuff};
use crate::random::Random;
use crate::{Check, Data, Outcome, StudyError, Tolerance};
use percoat_core::body::{Depth, Interface};
use percoat_core::heat::HeatedBody;
use rustfft::num_complex::Complex64;
use std::f64::consts::TAU;

pub fn add(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let mut random = Random::new(1937);
    let columns = ["layers", "rigid", "contrast", "temperature", "swelling", "stress", "displacement"];
    let mut data = Data::new("waves", &columns);
    for _ in 0..if quick { 12 } else { 160 } {
        data.rows.push(row(&mut random)?);
    }
    let names = ["temperature and flux", "swelling", "thermal stress", "displacement inside"];
    for (column, name) in (3..).zip(names) {
        let scale = |row: &[f64]| if column == 3 { 1.0 } else { row[2] };
        let errors = data.rows.iter().map(|row| (row[column] / scale(row), 0.0));
        let over = if column == 3 { "" } else { ", over the contrast of moduli" };
        let name = format!("{name} of waves on random stacks, error{over}");
        outcome.checks.push(Check::worst(name, errors, Tolerance::Absolute(1e-10)));
    }
    outcome.data.push(data);
    bare(outcome, quick)
}

/// ŵ = −2(1 + ν)α/(λs(s + k)) of one material, whatever is called a layer.
fn bare(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let (mut random, mut errors) = (Random::new(1951), Vec::new());
    for _ in 0..if quick { 40 } else { 400 } {
        let (stuff, k, velocity) = (stuff(&mut random), wave(&mut random), velocity(&mut random));
        let sheets = (0..random.index(3)).map(|_| Sheet::bonded(stuff, random.logarithmic(1e-4, 1.0))).collect();
        let body = heated(&Stack { sheets, substrate: Some(stuff) }, velocity)?;
        let wavenumber = k[0].hypot(k[1]);
        let s = Complex64::new(wavenumber * wavenumber, -k[0] * velocity / stuff.diffusivity).sqrt();
        let known = -2.0 * (1.0 + stuff.poisson) * stuff.expansion / (stuff.conductivity * s * (s + wavenumber));
        errors.push(((body.swelling(k) / known - 1.0).norm(), 0.0));
    }
    let name = "swelling of one material in layers, relative error against its closed form";
    outcome.checks.push(Check::worst(name, errors, Tolerance::Absolute(1e-12)));
    Ok(())
}

/// Layers, whether the base is rigid, contrast of moduli, and errors of temperature, swelling, stress and displacement, each over the largest of
/// its kind.
fn row(random: &mut Random) -> Result<Vec<f64>, StudyError> {
    let (stack, k, velocity) = (stack(random), wave(random), velocity(random));
    let body = heated(&stack, velocity)?;
    let (known, found) = (Wave::new(&stack, k, velocity, [0.0, 1.0]), body.thermal_stress(k));
    let (mut worst, mut largest) = ([0.0f64; 3], [0.0f64; 3]);
    for (material, z) in depths(&stack) {
        let depth = Depth { z, material };
        let of = found.at(depth);
        let [t, f] = [found.temperature().at(depth), found.temperature().flux(depth)];
        let own: Fields = [of.szz, of.sqz, of.sqq, of.stt, of.uz, of.uq, t, f];
        for (n, (own, known)) in own.into_iter().zip(known.at(material, z)).enumerate() {
            let kind = [1, 1, 1, 1, 2, 2, 0, 0][n];
            // Temperatures over fluxes by the wavenumber and the conductivity of the surface.
            let scale = if n == 6 { surface(&stack).conductivity * k[0].hypot(k[1]) } else { 1.0 };
            worst[kind] = worst[kind].max((own - known).norm() * scale);
            largest[kind] = largest[kind].max(known.norm() * scale);
        }
    }
    let swollen = known.at(1, 0.0)[4];
    let swelling = (body.swelling(k) / swollen - 1.0).norm();
    let [temperature, stress, moved] = [0, 1, 2].map(|kind| worst[kind] / largest[kind]);
    let counts = [stack.sheets.len() as f64, f64::from(u8::from(stack.substrate.is_none())), contrast(&stack)];
    Ok([&counts[..], &[temperature, swelling, stress, moved]].concat())
}

fn heated(stack: &Stack, velocity: f64) -> Result<HeatedBody, StudyError> {
    HeatedBody::of(&stack.half_space()?, velocity).ok_or_else(|| "a material does not conduct".into())
}

fn surface(stack: &Stack) -> Stuff {
    stack.sheets.first().map(|sheet| sheet.stuff).or(stack.substrate).unwrap_or(Stuff::new(1.0, [1.0; 3]))
}

/// Faces and places inside of all materials.
fn depths(stack: &Stack) -> Vec<(usize, f64)> {
    let (mut all, mut top) = (Vec::new(), 0.0);
    for (number, sheet) in stack.sheets.iter().enumerate() {
        all.extend([0.0, 0.37, 0.8, 1.0].map(|part| (number + 1, top + part * sheet.thickness)));
        top += sheet.thickness;
    }
    if stack.substrate.is_some() {
        all.extend([0.0, 0.3, 2.0].map(|below| (stack.sheets.len() + 1, top + below)));
    }
    all
}

fn materials(stack: &Stack) -> impl Iterator<Item = Stuff> {
    stack.sheets.iter().map(|sheet| sheet.stuff).chain(stack.substrate)
}

/// Largest of Young's moduli over the smallest.
fn contrast(stack: &Stack) -> f64 {
    let [least, most] = materials(stack)
        .fold([f64::INFINITY, 0.0], |[least, most]: [f64; 2], stuff| [least.min(stuff.young), most.max(stuff.young)]);
    most / least
}

fn stuff(random: &mut Random) -> Stuff {
    Stuff {
        young: random.logarithmic(0.1, 10.0),
        poisson: random.between(0.0, 0.49),
        conductivity: random.logarithmic(0.05, 20.0),
        diffusivity: random.logarithmic(0.1, 10.0),
        expansion: random.logarithmic(0.1, 10.0),
    }
}

/// A stack of one to three layers with any interfaces and resistances, on an elastic substrate or a rigid base.
pub fn stack(random: &mut Random) -> Stack {
    let sheet = |random: &mut Random| {
        let interface = match random.index(3) {
            0 => Interface::Frictionless,
            1 => Interface::Spring { tangential: random.logarithmic(0.1, 10.0), normal: random.logarithmic(0.1, 10.0) },
            _ => Interface::Bonded,
        };
        let resistance = match random.index(4) {
            0 => f64::INFINITY,
            1 => random.logarithmic(0.01, 10.0),
            _ => 0.0,
        };
        Sheet { stuff: stuff(random), thickness: random.logarithmic(0.01, 1.0), interface, resistance }
    };
    let sheets = (0..=random.index(3)).map(|_| sheet(random)).collect();
    let substrate = (random.index(4) > 0).then(|| stuff(random));
    Stack { sheets, substrate }
}

fn wave(random: &mut Random) -> [f64; 2] {
    let (wavenumber, angle) = (random.logarithmic(0.3, 4.0), random.between(0.0, TAU));
    [wavenumber * angle.cos(), wavenumber * angle.sin()]
}

/// At rest, or up to a Péclet number near 100.
fn velocity(random: &mut Random) -> f64 {
    if random.index(4) == 0 { 0.0 } else { random.logarithmic(0.01, 30.0) }
}
