//! Stresses and displacements at one depth by the waves of a traction.

use super::far_plane::FarPlane;
use super::passed::{Meaning, Passed};
use super::passed_shells::PassedShells;
use super::series::Response;
use super::tensor::StressState;
use super::thermal::ThermalAmplitudes;
use super::traction::ShearForm;
use super::traction_waves::Wave;
use crate::body::{Amplitudes, Antiplane, Depth, InPlane, InteriorTable};
use rustfft::num_complex::Complex64;
use std::sync::Arc;

/// Whether each of xx, yy, zz, xy, xz, yz, u_x, u_y, u_z is odd in the wavevector under a pressure; under a shear traction the
/// others are.
const ODD: [bool; 9] = [false, false, false, false, true, true, true, true, false];

/// Amplitudes at one depth of the shells whose waves reach it, and the state under the mean traction.
#[derive(Debug)]
pub(super) struct DepthResponse {
    pub normal: Vec<Amplitudes>,
    pub tangential: Option<Tangential>,
    /// Amplitudes of the stresses by heat; `None` without heat.
    thermal: Option<ThermalAmplitudes>,
    /// Wavelengths of the shells over 2π.
    pub lengths: Vec<f64>,
    pub mean: StressState,
    /// Whether the exact waves of discs are summed, see [`Response::is_deep`].
    pub is_deep: bool,
    /// Difference of the free and the periodic field; `None` where the system is periodic.
    pub far: Option<FarPlane<9>>,
    /// What lags behind below a load that moves over a body that relaxes; `None` of others.
    lost: Option<Lost>,
}

/// Imaginary parts of the amplitudes of waves whose component along the motion is positive; the other waves have the opposite ones.
#[derive(Debug)]
struct Lost {
    shells: Arc<PassedShells>,
    normal: Vec<Amplitudes>,
    tangential: Option<Tangential>,
}

/// Amplitudes at one depth under the shear traction.
#[derive(Debug)]
pub(super) struct Tangential {
    /// Traction on the body over the pressure; zero where it has waves of its own.
    ratio: [f64; 2],
    /// Whether the traction has waves of its own.
    is_field: bool,
    /// Amplitudes under a traction along the wavevector, by shell.
    along: Vec<Amplitudes>,
    /// Amplitudes under a traction across the wavevector, by shell.
    across: Vec<Antiplane>,
}

/// The stresses of a response: xx, yy, zz, xy, xz, yz.
#[derive(Debug)]
pub(super) struct StressComponents<'a>(pub &'a DepthResponse);

/// The displacements of a response: u_x, u_y, u_z.
#[derive(Debug)]
pub(super) struct DisplacementComponents<'a>(pub &'a DepthResponse);

impl DepthResponse {
    /// Response at a depth of the shells with these `wavenumbers` to a pressure and a tangential traction of a form, with the state `mean`
    /// under the mean traction.
    pub fn new(
        interiors: &InteriorTable,
        depth: Depth,
        wavenumbers: &[f64],
        form: ShearForm,
        mean: StressState,
    ) -> Self {
        let tangential = (form != ShearForm::None).then(|| Tangential {
            ratio: form.ratio().unwrap_or_default(),
            is_field: form.ratio().is_none(),
            along: interiors.amplitudes(InPlane::Along, wavenumbers, depth),
            across: interiors.antiplane(wavenumbers, depth),
        });
        Self {
            normal: interiors.amplitudes(InPlane::Normal, wavenumbers, depth),
            tangential,
            thermal: None,
            lengths: wavenumbers.iter().map(|q| 1.0 / q).collect(),
            mean,
            is_deep: false,
            far: None,
            lost: None,
        }
    }

    /// Response of a body that relaxes and that a load passes.
    pub fn passed(
        (passed, of): (&Passed, Meaning),
        depth: Depth,
        wavenumbers: &[f64],
        form: ShearForm,
        mean: StressState,
    ) -> Self {
        let [normal, lost] = passed.amplitudes(InPlane::Normal, wavenumbers.len(), depth, of);
        let sheared = (form != ShearForm::None).then(|| {
            let along = passed.amplitudes(InPlane::Along, wavenumbers.len(), depth, of);
            let across = passed.antiplane(wavenumbers.len(), depth, of);
            let parts_of = |(along, across)| Tangential {
                ratio: form.ratio().unwrap_or_default(),
                is_field: form.ratio().is_none(),
                along,
                across,
            };
            let mut parts = along.into_iter().zip(across).map(parts_of);
            (parts.next(), parts.next())
        });
        let (stored, late) = sheared.unwrap_or_default();
        Self {
            normal,
            tangential: stored,
            thermal: None,
            lengths: wavenumbers.iter().map(|q| 1.0 / q).collect(),
            mean,
            is_deep: false,
            far: None,
            lost: Some(Lost { shells: Arc::clone(passed.shells()), normal: lost, tangential: late }),
        }
    }

    /// The response with the stresses by heat.
    pub fn heated(self, thermal: Option<ThermalAmplitudes>) -> Self {
        Self { thermal, ..self }
    }

    /// The response of the series of a field, deep or near the surface, with what a free field has beside the periodic one.
    pub fn in_field(self, is_deep: bool, far: Option<FarPlane<9>>) -> Self {
        Self { is_deep, far, ..self }
    }

    /// Largest difference of the amplitudes of a shell at the surface from those of a bare half-space with this ν: over the pressure,
    /// with the traction that follows from it, and over a tangential traction with waves of its own.
    pub fn unlike(&self, shell: usize, poisson: f64) -> [f64; 2] {
        let Some(at) = self.normal.get(shell) else { return [0.0; 2] };
        let normal = (at.sqq + 1.0).abs().max((at.stt + 2.0 * poisson).abs());
        let Some(Tangential { ratio: [x, y], is_field, along, across }) = &self.tangential else {
            return [normal, 0.0];
        };
        let (along, across) = (along[shell], across[shell]);
        let tangential = (along.sqq + 2.0).abs().max((along.stt + 2.0 * poisson).abs()).max((across.sqt + 1.0).abs());
        if *is_field { [normal, tangential] } else { [normal + x.hypot(*y) * tangential, 0.0] }
    }
}

/// Factors of xx, yy, zz, xy, xz, yz, u_x, u_y, u_z of a wave along the unit vector **n** under a pressure or a traction along **n**.
#[inline(always)]
fn in_plane([nx, ny]: [f64; 2], amplitudes: &Amplitudes) -> [f64; 9] {
    let (xx, yy, xy) = (nx * nx, ny * ny, nx * ny);
    let Amplitudes { szz, sqz, sqq, stt, uz, uq } = *amplitudes;
    [xx * sqq + yy * stt, yy * sqq + xx * stt, szz, xy * (sqq - stt), nx * sqz, ny * sqz, nx * uq, ny * uq, uz]
}

/// Factors of the nine components of a wave along **n** under a traction across it, along **t** = (−n_y, n_x).
#[inline(always)]
fn antiplane([nx, ny]: [f64; 2], amplitudes: &Antiplane) -> [f64; 9] {
    let (tx, ty) = (-ny, nx);
    let Antiplane { stz, sqt, ut } = *amplitudes;
    [
        2.0 * nx * tx * sqt,
        2.0 * ny * ty * sqt,
        0.0,
        (nx * ty + ny * tx) * sqt,
        tx * stz,
        ty * stz,
        tx * ut,
        ty * ut,
        0.0,
    ]
}

/// −ic.
#[inline(always)]
fn turn(c: Complex64) -> Complex64 {
    Complex64::new(c.im, -c.re)
}

/// The nine components of a wave c along **n** of a pressure, or of a flux of heat, by its amplitudes.
#[inline(always)]
fn under(n: [f64; 2], c: Complex64, amplitudes: &Amplitudes) -> [Complex64; 9] {
    let (factors, turned) = (in_plane(n, amplitudes), turn(c));
    std::array::from_fn(|k| factors[k] * if ODD[k] { turned } else { c })
}

/// The nine components of a wave along the unit vector **n** by the amplitudes of its shell.
#[inline(always)]
fn components<W: Wave>(
    n: [f64; 2],
    shell: usize,
    wave: W,
    normal: &[Amplitudes],
    tangential: Option<&Tangential>,
) -> [Complex64; 9] {
    let c = wave.pressure();
    let waves = under(n, c, &normal[shell]);
    let Some(tangential) = tangential else { return waves };
    if !W::HAS_SHEAR {
        let (factors, turned) = (tangential.factors(n, shell), turn(c));
        return std::array::from_fn(|k| waves[k] + factors[k] * if ODD[k] { c } else { turned });
    }
    let shear = tangential.waves(wave.shear(), n, shell);
    std::array::from_fn(|k| waves[k] + if ODD[k] { shear[k] } else { turn(shear[k]) })
}

impl Tangential {
    /// Factors of the nine components of a wave along **n** under the traction that follows from the pressure; those even under a
    /// pressure are to be multiplied by −i.
    #[inline(always)]
    fn factors(&self, [nx, ny]: [f64; 2], shell: usize) -> [f64; 9] {
        let [ex, ey] = self.ratio;
        let (by_along, by_across) = (ex * nx + ey * ny, ey * nx - ex * ny);
        let (along, across) = (in_plane([nx, ny], &self.along[shell]), antiplane([nx, ny], &self.across[shell]));
        std::array::from_fn(|k| by_along * along[k] + by_across * across[k])
    }

    /// Components of a wave along **n** under a traction with the coefficients `[x, y]`; those even under a pressure are to be multiplied
    /// by −i.
    #[inline(always)]
    fn waves(&self, [x, y]: [Complex64; 2], [nx, ny]: [f64; 2], shell: usize) -> [Complex64; 9] {
        let (by_along, by_across) = (x * nx + y * ny, y * nx - x * ny);
        let (along, across) = (in_plane([nx, ny], &self.along[shell]), antiplane([nx, ny], &self.across[shell]));
        std::array::from_fn(|k| by_along * along[k] + by_across * across[k])
    }
}

impl Response<9> for DepthResponse {
    fn shells(&self) -> usize {
        self.normal.len()
    }

    #[inline(always)]
    fn times<W: Wave>(&self, q @ [x, y]: [f64; 2], shell: usize, wave: W) -> [Complex64; 9] {
        let length = self.lengths[shell];
        let n = [x * length, y * length];
        let mut sum = components(n, shell, wave, &self.normal, self.tangential.as_ref());
        if let Some(Lost { shells, normal, tangential }) = &self.lost {
            // i for a positive component along the motion, −i for a negative one.
            let lost = components(n, shell, wave * Complex64::new(0.0, shells.sign(q)), normal, tangential.as_ref());
            sum = std::array::from_fn(|k| sum[k] + lost[k]);
        }
        if let Some(thermal) = &self.thermal {
            let ([stored, lost], heat) = (thermal.of(q, shell), wave.heat());
            let [warm, lagging] = [under(n, heat, &stored), under(n, heat * Complex64::I, &lost)];
            sum = std::array::from_fn(|k| sum[k] + (warm[k] + lagging[k]));
        }
        sum
    }

    fn mean(&self) -> [f64; 9] {
        self.mean.components()
    }

    fn is_deep(&self) -> bool {
        self.is_deep
    }

    fn far(&self) -> Option<FarPlane<9>> {
        self.far.clone()
    }
}
impl Response<6> for StressComponents<'_> {
    fn shells(&self) -> usize {
        self.0.shells()
    }

    #[inline(always)]
    fn times<W: Wave>(&self, q: [f64; 2], shell: usize, wave: W) -> [Complex64; 6] {
        let [stresses @ .., _, _, _] = self.0.times(q, shell, wave);
        stresses
    }

    fn mean(&self) -> [f64; 6] {
        let [stresses @ .., _, _, _] = self.0.mean();
        stresses
    }

    fn is_deep(&self) -> bool {
        self.0.is_deep
    }

    fn far(&self) -> Option<FarPlane<6>> {
        Some(self.0.far.as_ref()?.map(|[stresses @ .., _, _, _]| stresses))
    }
}

impl Response<3> for DisplacementComponents<'_> {
    fn shells(&self) -> usize {
        self.0.shells()
    }

    #[inline(always)]
    fn times<W: Wave>(&self, q: [f64; 2], shell: usize, wave: W) -> [Complex64; 3] {
        let [.., ux, uy, uz] = self.0.times(q, shell, wave);
        [ux, uy, uz]
    }

    fn mean(&self) -> [f64; 3] {
        let [.., ux, uy, uz] = self.0.mean();
        [ux, uy, uz]
    }

    fn is_deep(&self) -> bool {
        self.0.is_deep
    }

    fn far(&self) -> Option<FarPlane<3>> {
        Some(self.0.far.as_ref()?.map(|[.., ux, uy, uz]| [ux, uy, uz]))
    }
}
