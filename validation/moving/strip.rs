//! A wave on layers that relax, by plain exponentials: all amplitudes of all layers from one dense complex system.
//!
//! u_x = iU e^{iqx}, u_z = W e^{iqx}. In each material four solutions, s = ±1, ζ = qz from the face where e^{sζ} is 1:
//!
//! u = ∇φ:            U = 1,  W = s,       σ_zz = 2Gq,                   σ_xz = i 2Gqs,              all times e^{sζ}
//! u = (κ ẑ − z ∇)φ:  U = −ζ, W = κ − sζ,  σ_zz = 2Gq[2(1 − ν)s − ζ],    σ_xz = i 2Gq[(1 − 2ν) − sζ]
//!
//! with φ = e^{sζ + iqx}/q or e^{sζ + iqx} and κ = 3 − 4ν, complex G and ν of the frequency (correspondence principle).

use super::setup::{Stack, Stuff};
use percoat_core::body::ConstantModulus;
use rustfft::num_complex::Complex64;

const ONE: Complex64 = Complex64::new(1.0, 0.0);

/// A material of a stack at a frequency.
#[derive(Debug, Clone)]
struct Part {
    shear: Complex64,
    poisson: Complex64,
    /// Thickness times the wavenumber; infinite for the substrate.
    thickness: f64,
    slides: bool,
    /// Amplitudes: both that fall with the depth, then both that grow.
    amplitudes: [Complex64; 4],
}

/// Response of a stack to a unit pressure in one wave.
#[derive(Debug, Clone)]
pub struct Strip {
    wavenumber: f64,
    frequency: f64,
    parts: Vec<Part>,
}

/// U, W, σ_zz/q, σ_xz/(iq) and W′/q at a depth.
type State = [Complex64; 5];

impl Stuff {
    /// Complex shear modulus and Poisson's ratio at a frequency.
    fn moduli(&self, frequency: f64) -> [Complex64; 2] {
        let s = |time: f64| Complex64::new(0.0, frequency * time);
        let stiffening: Complex64 = self.terms.iter().map(|[g, time]| s(*time) / (ONE + s(*time)) * g).sum();
        let shear = stiffening + self.shear;
        let poisson = match self.constant {
            ConstantModulus::Poisson => Complex64::from(self.poisson),
            ConstantModulus::Bulk => {
                let bulk = 2.0 * self.shear * (1.0 + self.poisson) / (3.0 * (1.0 - 2.0 * self.poisson));
                (3.0 * bulk - 2.0 * shear) / (2.0 * (3.0 * bulk + shear))
            }
        };
        [shear, poisson]
    }
}

impl Part {
    fn new(stuff: &Stuff, frequency: f64, thickness: f64, slides: bool) -> Self {
        let [shear, poisson] = stuff.moduli(frequency);
        Self { shear, poisson, thickness, slides, amplitudes: [Complex64::default(); 4] }
    }

    /// Solutions at ζ below the upper face.
    fn solutions(&self, depth: f64) -> [State; 4] {
        let (g, nu) = (2.0 * self.shear, self.poisson);
        let kappa = 3.0 - 4.0 * nu;
        let pair = |s: f64, z: f64| {
            let e = (s * z).exp();
            let first = [ONE, s * ONE, g, g * s, ONE];
            let second = [
                -z * ONE,
                kappa - s * z,
                g * (2.0 * (1.0 - nu) * s - z),
                g * (1.0 - 2.0 * nu - s * z),
                s * (kappa - 1.0) - z,
            ];
            [first, second].map(|state| state.map(|value| value * e))
        };
        let [a, b] = pair(-1.0, depth);
        let [c, d] = if self.thickness.is_finite() { pair(1.0, depth - self.thickness) } else { [[0.0 * ONE; 5]; 2] };
        [a, b, c, d]
    }

    fn state(&self, depth: f64) -> State {
        let solutions = self.solutions(depth);
        [0, 1, 2, 3, 4].map(|row| (0..4).map(|k| self.amplitudes[k] * solutions[k][row]).sum())
    }

    /// ê : ê* of the strain's deviator and |tr ε|² at a depth, over q².
    fn strains(&self, depth: f64) -> [f64; 2] {
        let [u, _, _, shear, rise] = self.state(depth);
        let across = shear / (2.0 * self.shear);
        let trace = (rise - u).norm_sqr();
        [u.norm_sqr() + rise.norm_sqr() + 2.0 * across.norm_sqr() - trace / 3.0, trace]
    }

    fn bulk(&self) -> Complex64 {
        2.0 * self.shear * (1.0 + self.poisson) / (3.0 * (1.0 - 2.0 * self.poisson))
    }
}

impl Strip {
    /// The response at a wavenumber and a frequency.
    pub fn new(stack: &Stack, wavenumber: f64, frequency: f64) -> Self {
        let mut parts: Vec<Part> = stack
            .sheets
            .iter()
            .map(|(stuff, thickness, slides)| Part::new(stuff, frequency, thickness * wavenumber, *slides))
            .collect();
        parts.push(Part::new(&stack.substrate, frequency, f64::INFINITY, false));
        let amplitudes = solve(system(&parts), wavenumber);
        for (part, of) in parts.iter_mut().zip(amplitudes.chunks(4)) {
            part.amplitudes[..of.len()].copy_from_slice(of);
        }
        Self { wavenumber, frequency, parts }
    }

    /// Displacement of the surface into the body under the pressure 1.
    pub fn compliance(&self) -> Complex64 {
        self.parts[0].state(0.0)[1]
    }

    /// Dissipation ωG″ ê : ê* + ½ωK″ |tr ε|² of the wave with the amplitude 1, over the depth of each material.
    pub fn dissipation(&self) -> Vec<f64> {
        let density = |part: &Part, depth: f64| {
            let [shape, volume] = part.strains(depth);
            self.frequency * (part.shear.im * shape + 0.5 * part.bulk().im * volume) * self.wavenumber
        };
        let over = |part: &Part| {
            // A quadratic times e^{−2ζ} in the substrate; in a layer exponentials, in pieces of ζ ≤ 2.
            let end = part.thickness.min(40.0);
            let pieces = (end / 2.0).ceil().max(1.0);
            let piece = end / pieces;
            (0..pieces as usize).map(|k| gauss(|z| density(part, z), piece * k as f64, piece)).sum()
        };
        self.parts.iter().map(over).collect()
    }
}

/// ∫ over a piece by ten points of Gauss and Legendre.
pub fn gauss(f: impl Fn(f64) -> f64, from: f64, length: f64) -> f64 {
    const POINTS: [[f64; 2]; 5] = [
        [0.148_874_338_981_631_22, 0.295_524_224_714_752_87],
        [0.433_395_394_129_247_2, 0.269_266_719_309_996_35],
        [0.679_409_568_299_024_4, 0.219_086_362_515_982_04],
        [0.865_063_366_688_984_5, 0.149_451_349_150_580_6],
        [0.973_906_528_517_171_7, 0.066_671_344_308_688_14],
    ];
    let middle = from + 0.5 * length;
    let both = |[x, weight]: [f64; 2]| weight * (f(middle - 0.5 * length * x) + f(middle + 0.5 * length * x));
    0.5 * length * POINTS.into_iter().map(both).sum::<f64>()
}

/// Equations of a stack, with σ_zz/q = −1 at the surface in the last column.
fn system(parts: &[Part]) -> Vec<Vec<Complex64>> {
    let size = 4 * parts.len() - 2;
    let mut rows = Vec::with_capacity(size);
    let mut add = |states: &[(usize, [State; 4], f64)], of: usize, right: f64| {
        let mut row = vec![Complex64::default(); size + 1];
        for (part, solutions, sign) in states {
            for k in 0..(size - 4 * part).min(4) {
                row[4 * part + k] = solutions[k][of] * sign;
            }
        }
        row[size] = right.into();
        rows.push(row);
    };
    let surface = [(0, parts[0].solutions(0.0), 1.0)];
    add(&surface, 2, -1.0);
    add(&surface, 3, 0.0);
    for (k, pair) in parts.windows(2).enumerate() {
        let above = (k, pair[0].solutions(pair[0].thickness), 1.0);
        let below = (k + 1, pair[1].solutions(0.0), -1.0);
        add(&[above, below], 1, 0.0);
        add(&[above, below], 2, 0.0);
        if pair[0].slides {
            add(&[above], 3, 0.0);
            add(&[below], 3, 0.0);
        } else {
            add(&[above, below], 0, 0.0);
            add(&[above, below], 3, 0.0);
        }
    }
    rows
}

/// Elimination with pivots, each row by its largest entry; the solution over the wavenumber.
fn solve(mut rows: Vec<Vec<Complex64>>, wavenumber: f64) -> Vec<Complex64> {
    let n = rows.len();
    for row in &mut rows {
        let largest = row[..n].iter().map(|x| x.norm()).fold(0.0, f64::max);
        row.iter_mut().for_each(|x| *x /= largest);
    }
    for k in 0..n {
        let pivot = (k..n).max_by(|&a, &b| rows[a][k].norm().total_cmp(&rows[b][k].norm())).unwrap_or(k);
        rows.swap(k, pivot);
        let (done, left) = rows.split_at_mut(k + 1);
        for row in left {
            let factor = row[k] / done[k][k];
            row.iter_mut().zip(&done[k]).skip(k).for_each(|(x, y)| *x -= factor * y);
        }
    }
    let mut x = vec![Complex64::default(); n];
    for k in (0..n).rev() {
        let known: Complex64 = (k + 1..n).map(|j| rows[k][j] * x[j]).sum();
        x[k] = (rows[k][n] - known) / rows[k][k];
    }
    x.into_iter().map(|x| x / wavenumber).collect()
}
