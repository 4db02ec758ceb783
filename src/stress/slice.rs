//! What the waves of the pressure cause at one depth.

use super::series::Response;
use super::tensor::State;
use crate::body::Amplitudes;

/// Of xx, yy, zz, xy, xz, yz, u_x, u_y, u_z those that change their sign with the wavevector.
const ODD: [bool; 9] = [false, false, false, false, true, true, true, true, false];

/// Amplitudes at a depth of the shells whose waves reach it, and the state of the mean pressure.
#[derive(Debug)]
pub(super) struct Slice {
    pub amplitudes: Vec<Amplitudes>,
    /// Wavelengths of the shells over 2π.
    pub lengths: Vec<f64>,
    pub mean: State,
}

/// Stresses only: xx, yy, zz, xy, xz, yz.
#[derive(Debug)]
pub(super) struct Stresses<'a>(pub &'a Slice);

/// Displacements only: u_x, u_y, u_z.
#[derive(Debug)]
pub(super) struct Displacements<'a>(pub &'a Slice);

/// Factors of xx, yy, zz, xy, xz, yz, u_x, u_y, u_z of a wave of this `length` over 2π.
#[inline(always)]
fn components([x, y]: [f64; 2], length: f64, amplitudes: &Amplitudes) -> [f64; 9] {
    let (nx, ny) = (x * length, y * length);
    let (xx, yy, xy) = (nx * nx, ny * ny, nx * ny);
    let Amplitudes { szz, sqz, sqq, stt, uz, uq } = *amplitudes;
    [xx * sqq + yy * stt, yy * sqq + xx * stt, szz, xy * (sqq - stt), nx * sqz, ny * sqz, nx * uq, ny * uq, uz]
}

impl Response<9> for Slice {
    const ODD: [bool; 9] = ODD;

    fn shells(&self) -> usize {
        self.amplitudes.len()
    }

    fn factors(&self, q: [f64; 2], shell: usize) -> [f64; 9] {
        components(q, self.lengths[shell], &self.amplitudes[shell])
    }

    fn mean(&self) -> [f64; 9] {
        self.mean.components()
    }
}

impl Response<6> for Stresses<'_> {
    const ODD: [bool; 6] = [ODD[0], ODD[1], ODD[2], ODD[3], ODD[4], ODD[5]];

    fn shells(&self) -> usize {
        self.0.shells()
    }

    fn factors(&self, q: [f64; 2], shell: usize) -> [f64; 6] {
        let [stresses @ .., _, _, _] = self.0.factors(q, shell);
        stresses
    }

    fn mean(&self) -> [f64; 6] {
        let [stresses @ .., _, _, _] = self.0.mean();
        stresses
    }
}

impl Response<3> for Displacements<'_> {
    const ODD: [bool; 3] = [ODD[6], ODD[7], ODD[8]];

    fn shells(&self) -> usize {
        self.0.shells()
    }

    fn factors(&self, q: [f64; 2], shell: usize) -> [f64; 3] {
        let [.., ux, uy, uz] = self.0.factors(q, shell);
        [ux, uy, uz]
    }

    fn mean(&self) -> [f64; 3] {
        let [.., ux, uy, uz] = self.0.mean();
        [ux, uy, uz]
    }
}
