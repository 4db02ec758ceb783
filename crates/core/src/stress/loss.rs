//! Energy that each material loses below a load that moves steadily.
//!
//! A wave c e^{i**q**·**x**} of the pressure has in the material the frequency ω = −**q**·**v**. With its amplitudes at a depth the power
//!
//! Φ = ½ |c|² ω Im(s_zz* u_z + s_qz* u_q)
//!
//! per area flows down there: what a material loses flows in at its upper face and not out at its lower one. Interfaces lose nothing. The
//! traction of friction is left out.

use super::series::Series;
use crate::body::{Amplitudes, Depth, HalfSpace, InPlane};
use crate::numeric::parallel;
use crate::spectral::Contact;
use rustfft::num_complex::Complex64;

/// Parts of the energy lost under a contact's pressure in the materials of the body that relax, each with its number; none at rest.
pub(crate) fn losses(contact: &Contact) -> Vec<(usize, f64)> {
    let problem = contact.problem();
    let (body, [vx, vy]) = (problem.half_space(), problem.velocity());
    let relaxing: Vec<usize> =
        (1..).zip(body.materials()).filter(|(_, material)| material.relaxation().is_some()).map(|(n, _)| n).collect();
    if problem.motion().is_none() || relaxing.len() < 2 {
        let alone = problem.motion().and(relaxing.first());
        return alone.map(|&number| (number, 1.0)).into_iter().collect();
    }
    let series = Series::new(contact.grid(), contact.pressures());
    let rows = series.waves.rows_within(series.waves.wavenumbers().len());
    let waves: Vec<([f64; 2], Complex64)> =
        rows.iter().flat_map(|row| series.of::<Complex64>(row, false)).map(|(q, _, c)| (q, c)).collect();
    let of_wave = |number: usize| {
        let ([x, y], c) = waves[number];
        flows(body, x.hypot(y), -(x * vx + y * vy)).into_iter().map(|flow| c.norm_sqr() * flow).collect::<Vec<f64>>()
    };
    // Added in their order, whatever the threads.
    let all: Vec<Vec<f64>> = parallel::map(waves.len(), of_wave);
    let mut lost = vec![0.0; body.material_count()];
    for flows in all {
        for (material, lost) in lost.iter_mut().enumerate() {
            *lost += flows[material] - flows.get(material + 1).copied().unwrap_or(0.0);
        }
    }
    let whole: f64 = relaxing.iter().map(|number| lost[number - 1]).sum();
    relaxing.into_iter().map(|number| (number, lost[number - 1] / whole)).collect()
}

/// Power that flows down at the upper face of each material, for p = 1 and without the factor ½.
fn flows(body: &HalfSpace, wavenumber: f64, frequency: f64) -> Vec<f64> {
    if frequency == 0.0 {
        return vec![0.0; body.material_count()];
    }
    let response = body.response_at(Complex64::new(0.0, frequency));
    let interior = response.interior(InPlane::Normal, wavenumber);
    let flow = |material: usize| {
        let Amplitudes { szz, sqz, uz, uq, .. } = interior.at(Depth { z: body.faces(material).0, material });
        frequency * (szz.conj() * uz + sqz.conj() * uq).im
    };
    (1..=body.material_count()).map(flow).collect()
}
