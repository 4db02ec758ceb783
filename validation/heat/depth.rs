//! A wave of heat and of pressure on a layered body by integration through the depth.
//!
//! With the fields T, f (flux into the depth), u_z = W, σ_zz = P times e^{ikξ} and u_q = −iU, σ_qz = −iS times e^{ikξ}, Λ of Lamé, b = (3Λ + 2G)α and
//! s² = k² − ik_x v/κ, the equations of heat and of equilibrium are y′ = My, y = (U, W, P, S, T, f):
//!
//! U′ = S/G + kW,  W′ = (P − ΛkU + bT)/(Λ + 2G),  P′ = −kS,  S′ = k[(Λ + 2G)kU + ΛW′ − bT],  T′ = −f/λ,  f′ = −λs²T.
//!
//! Each layer is cut into pieces of |M|d ≤ 1, over which e^{Md} is its series. The state of a substrate has no part that grows: (1 + sign M)y = 0,
//! with the sign of a matrix by Newton's iteration. The states at the upper faces of all pieces are one linear system, solved with pivots.
//! Neither exponentials of the rates, potentials, nor reciprocity: nothing is shared with percoat.

use super::setup::{Stack, Stuff};
use percoat_core::body::Interface;
use rustfft::num_complex::Complex64;

const ZERO: Complex64 = Complex64::new(0.0, 0.0);
/// Unknowns of a state.
const N: usize = 6;

type Matrix = [[Complex64; N]; N];
type State = [Complex64; N];

/// Response of a layered body to one wave of what acts on its surface.
#[derive(Debug, Clone)]
pub struct Wave {
    wavenumber: f64,
    /// Material, depth of the upper face, length, state there, of each piece; the substrate last.
    pieces: Vec<Piece>,
}

#[derive(Debug, Clone)]
struct Piece {
    material: usize,
    stuff: Stuff,
    matrix: Matrix,
    top: f64,
    length: f64,
    state: State,
}

/// σ_zz, σ_qz, σ_qq, σ_tt, u_z and u_q in percoat's phases, T, and the flux into the depth.
pub type Fields = [Complex64; 8];

impl Wave {
    /// Response to a pressure and a flux into the surface, at a wavevector, under a source that moves with v along x.
    pub fn new(stack: &Stack, k: [f64; 2], velocity: f64, [pressure, flux]: [f64; 2]) -> Self {
        let wavenumber = k[0].hypot(k[1]);
        let (mut pieces, mut top) = (Vec::new(), 0.0);
        for (number, sheet) in stack.sheets.iter().enumerate() {
            let matrix = equations(&sheet.stuff, k, velocity);
            let count = (size(&balanced(&matrix, &sheet.stuff, wavenumber)) * sheet.thickness).ceil().max(1.0);
            let length = sheet.thickness / count;
            for _ in 0..count as usize {
                pieces.push(Piece { material: number + 1, stuff: sheet.stuff, matrix, top, length, state: [ZERO; N] });
                top += length;
            }
        }
        if let Some(stuff) = stack.substrate {
            let (matrix, material) = (equations(&stuff, k, velocity), stack.sheets.len() + 1);
            pieces.push(Piece { material, stuff, matrix, top, length: f64::INFINITY, state: [ZERO; N] });
        }
        let mut system = System { size: N * pieces.len(), rows: Vec::new() };
        system.hold(&[(0, unit(2))], (-pressure).into());
        system.hold(&[(0, unit(3))], ZERO);
        system.hold(&[(0, unit(5))], flux.into());
        for (number, piece) in pieces.iter().enumerate() {
            system.join(stack, &pieces, number, piece, wavenumber);
        }
        let solution = system.solved();
        for (piece, state) in pieces.iter_mut().zip(solution.chunks(N)) {
            piece.state.copy_from_slice(state);
        }
        Self { wavenumber, pieces }
    }

    /// Fields in a material, from 1 at the surface down, at a depth within it.
    pub fn at(&self, material: usize, z: f64) -> Fields {
        let of = |piece: &&Piece| piece.material == material && piece.top <= z * (1.0 + 1e-14) + 1e-300;
        let piece = self.pieces.iter().rev().find(of).unwrap_or(&self.pieces[0]);
        self.fields(&piece.stuff, &piece.below(z - piece.top))
    }

    fn fields(&self, stuff: &Stuff, &[u, w, p, s, t, f]: &State) -> Fields {
        let (g, lame, heat) = moduli(stuff);
        let ku = u * self.wavenumber;
        let rise = (p - ku * lame + t * heat) / (lame + 2.0 * g);
        let along = ku * (lame + 2.0 * g) + rise * lame - t * heat;
        let across = (ku + rise) * lame - t * heat;
        [p, s, along, across, w, u, t, f]
    }
}

impl Piece {
    /// State at a distance below the upper face.
    fn below(&self, distance: f64) -> State {
        // Below a few units only what falls is left: a substrate is followed in steps, each freed of what grows.
        let free = self.length.is_infinite().then(|| {
            let sign = sign(&balanced(&self.matrix, &self.stuff, 1.0));
            let scale = scales(&self.stuff, 1.0);
            (sign, scale)
        });
        let steps = (size(&balanced(&self.matrix, &self.stuff, 1.0)) * distance).ceil().max(1.0);
        let step = exponential(&self.matrix, distance / steps, &self.stuff);
        let mut state = self.state;
        for _ in 0..steps as usize {
            state = times(&step, &state);
            if let Some((sign, scale)) = &free {
                let scaled: State = std::array::from_fn(|n| state[n] / scale[n]);
                let grown = times(sign, &scaled);
                state = std::array::from_fn(|n| 0.5 * (scaled[n] - grown[n]) * scale[n]);
            }
        }
        state
    }
}

/// G, Λ and (3Λ + 2G)α.
fn moduli(stuff: &Stuff) -> (f64, f64, f64) {
    let g = 0.5 * stuff.young / (1.0 + stuff.poisson);
    let lame = 2.0 * g * stuff.poisson / (1.0 - 2.0 * stuff.poisson);
    (g, lame, (3.0 * lame + 2.0 * g) * stuff.expansion)
}

/// M.
fn equations(stuff: &Stuff, [kx, ky]: [f64; 2], velocity: f64) -> Matrix {
    let ((g, lame, heat), k) = (moduli(stuff), kx.hypot(ky));
    let (stiff, mut m) = (lame + 2.0 * g, [[ZERO; N]; N]);
    let square = Complex64::new(k * k, -kx * velocity / stuff.diffusivity);
    m[0][1] = k.into();
    m[0][3] = g.recip().into();
    m[1][0] = (-lame * k / stiff).into();
    m[1][2] = stiff.recip().into();
    m[1][4] = (heat / stiff).into();
    m[2][3] = (-k).into();
    m[3][0] = (k * k * (stiff - lame * lame / stiff)).into();
    m[3][2] = (k * lame / stiff).into();
    m[3][4] = (k * heat * (lame / stiff - 1.0)).into();
    m[4][5] = (-stuff.conductivity.recip()).into();
    m[5][4] = -square * stuff.conductivity;
    m
}

/// Sizes of the six parts of a state that belong together in a material: M is near the wavenumber in them.
fn scales(stuff: &Stuff, k: f64) -> [f64; N] {
    let (g, _, heat) = moduli(stuff);
    let warmth = if heat > 0.0 { g / heat } else { 1.0 };
    [k.recip(), k.recip(), g, g, warmth, warmth * stuff.conductivity * k]
}

fn balanced(matrix: &Matrix, stuff: &Stuff, k: f64) -> Matrix {
    let scale = scales(stuff, k);
    std::array::from_fn(|i| std::array::from_fn(|j| matrix[i][j] * (scale[j] / scale[i])))
}

/// Largest sum of a row.
fn size(matrix: &Matrix) -> f64 {
    matrix.iter().map(|row| row.iter().map(|x| x.norm()).sum::<f64>()).fold(0.0, f64::max)
}

fn unit(n: usize) -> State {
    std::array::from_fn(|k| if k == n { 1.0.into() } else { ZERO })
}

fn times(matrix: &Matrix, state: &State) -> State {
    std::array::from_fn(|i| (0..N).map(|j| matrix[i][j] * state[j]).sum())
}

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..N).map(|m| a[i][m] * b[m][j]).sum()))
}

/// e^{Md} by its series, in balanced parts.
fn exponential(matrix: &Matrix, distance: f64, stuff: &Stuff) -> Matrix {
    let (scale, m) = (scales(stuff, 1.0), balanced(matrix, stuff, 1.0));
    let mut sum: Matrix = std::array::from_fn(unit);
    let mut term = sum;
    for n in 1..40 {
        term = product(&term, &m).map(|row| row.map(|x| x * (distance / f64::from(n))));
        sum.iter_mut().flatten().zip(term.iter().flatten()).for_each(|(sum, term)| *sum += term);
    }
    std::array::from_fn(|i| std::array::from_fn(|j| sum[i][j] * (scale[i] / scale[j])))
}

/// Sign of a matrix without eigenvalues on the imaginary axis: Z ← (Z/c + cZ⁻¹)/2, c = |det Z|^{1/6} at first.
fn sign(matrix: &Matrix) -> Matrix {
    let mut z = *matrix;
    for turn in 0..60 {
        let (inverse, determinant) = inverse(&z);
        let c = if turn < 6 { determinant.powf(1.0 / N as f64) } else { 1.0 };
        let next: Matrix = std::array::from_fn(|i| std::array::from_fn(|j| 0.5 * (z[i][j] / c + inverse[i][j] * c)));
        let change = z.iter().flatten().zip(next.iter().flatten()).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
        z = next;
        if turn > 8 && change < 1e-15 * size(&z) {
            break;
        }
    }
    z
}

/// Inverse and |det|.
fn inverse(matrix: &Matrix) -> (Matrix, f64) {
    let mut rows: Vec<Vec<Complex64>> = (0..N).map(|i| [matrix[i].to_vec(), unit(i).to_vec()].concat()).collect();
    let mut determinant = 1.0;
    for k in 0..N {
        let pivot = (k..N).max_by(|&a, &b| rows[a][k].norm().total_cmp(&rows[b][k].norm())).unwrap_or(k);
        rows.swap(k, pivot);
        determinant *= rows[k][k].norm();
        let head: Vec<Complex64> = rows[k].iter().map(|x| x / rows[k][k]).collect();
        for (i, row) in rows.iter_mut().enumerate() {
            let factor = if i == k { row[k] - 1.0 } else { row[k] };
            row.iter_mut().zip(&head).for_each(|(x, y)| *x -= factor * y);
        }
        rows[k] = head;
    }
    (std::array::from_fn(|i| std::array::from_fn(|j| rows[i][N + j])), determinant)
}

/// Equations between states, one row each with its right side last.
struct System {
    size: usize,
    rows: Vec<Vec<Complex64>>,
}

impl System {
    /// A sum of parts of states is a value.
    fn hold(&mut self, parts: &[(usize, State)], value: Complex64) {
        let mut row = vec![ZERO; self.size + 1];
        for (piece, part) in parts {
            row[N * piece..N * (piece + 1)].iter_mut().zip(part).for_each(|(x, y)| *x += y);
        }
        row[self.size] = value;
        self.rows.push(row);
    }

    /// Conditions at the lower end of a piece.
    fn join(&mut self, stack: &Stack, pieces: &[Piece], number: usize, piece: &Piece, k: f64) {
        if piece.length.is_infinite() {
            return self.bound(number, piece, k);
        }
        let arrives = exponential(&piece.matrix, piece.length, &piece.stuff);
        let next = pieces.get(number + 1);
        let less = |n: usize| -> Vec<(usize, State)> {
            let above = [(number, arrives[n])].into_iter();
            above.chain(next.map(|_| (number + 1, unit(n).map(|x| -x)))).collect()
        };
        let is_inside = next.is_some_and(|next| next.material == piece.material);
        let sheet = &stack.sheets[piece.material - 1];
        let (resistance, interface) =
            if is_inside { (0.0, Interface::Bonded) } else { (sheet.resistance, sheet.interface) };
        let jump =
            |n: usize, of: usize, factor: f64| [less(n), vec![(number, arrives[of].map(|x| x * factor))]].concat();
        let (closure, slip) = match interface {
            Interface::Bonded => (0.0, Some(0.0)),
            Interface::Frictionless => (0.0, None),
            Interface::Spring { tangential, normal } => (normal.recip(), Some(tangential.recip())),
        };
        // W above − W below = −P/k_n; U above − U below = −S/k_t; T above − T below = Rf.
        self.hold(&jump(1, 2, closure), ZERO);
        self.hold(&slip.map_or(vec![(number, arrives[3])], |slip| jump(0, 3, slip)), ZERO);
        let is_cut = resistance.is_infinite();
        self.hold(&if is_cut { vec![(number, arrives[5])] } else { jump(4, 5, -resistance) }, ZERO);
        if next.is_some() {
            self.hold(&less(2), ZERO);
            self.hold(&slip.map_or(vec![(number + 1, unit(3))], |_| less(3)), ZERO);
            self.hold(&less(5), ZERO);
        }
    }

    /// Conditions that no solution grows with depth in a substrate: three independent rows of 1 + sign M.
    fn bound(&mut self, number: usize, piece: &Piece, k: f64) {
        let scale = scales(&piece.stuff, k);
        let sign = sign(&balanced(&piece.matrix, &piece.stuff, k));
        let mut rows: Vec<State> =
            (0..N).map(|i| std::array::from_fn(|j| sign[i][j] + if i == j { 1.0 } else { 0.0 })).collect();
        let dot = |a: &State, b: &State| a.iter().zip(b).map(|(x, y)| x * y.conj()).sum::<Complex64>();
        for _ in 0..N / 2 {
            let largest =
                (0..rows.len()).max_by(|&a, &b| dot(&rows[a], &rows[a]).re.total_cmp(&dot(&rows[b], &rows[b]).re));
            let chosen = rows.swap_remove(largest.unwrap_or(0));
            let length = dot(&chosen, &chosen).re;
            for row in &mut rows {
                let part = dot(row, &chosen) / length;
                row.iter_mut().zip(&chosen).for_each(|(x, y)| *x -= part * y);
            }
            self.hold(&[(number, std::array::from_fn(|j| chosen[j] / scale[j]))], ZERO);
        }
    }

    /// Elimination with pivots, columns and rows by their largest entries.
    fn solved(mut self) -> Vec<Complex64> {
        let n = self.size;
        let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(f64::MIN_POSITIVE, f64::max);
        let scales: Vec<f64> = (0..n).map(|j| largest(&mut self.rows.iter().map(|row| row[j].norm()))).collect();
        for row in &mut self.rows {
            row.iter_mut().zip(&scales).for_each(|(x, scale)| *x /= scale);
            let scale = largest(&mut row[..n].iter().map(|x| x.norm()));
            row.iter_mut().for_each(|x| *x /= scale);
        }
        let rows = &mut self.rows;
        for k in 0..n {
            let pivot = (k..n).max_by(|&a, &b| rows[a][k].norm().total_cmp(&rows[b][k].norm())).unwrap_or(k);
            rows.swap(k, pivot);
            let (done, left) = rows.split_at_mut(k + 1);
            for row in left.iter_mut().filter(|row| row[k] != ZERO) {
                let factor = row[k] / done[k][k];
                row.iter_mut().zip(&done[k]).skip(k).for_each(|(x, y)| *x -= factor * y);
            }
        }
        let mut x = vec![ZERO; n];
        for k in (0..n).rev() {
            let known: Complex64 = (k + 1..n).map(|j| rows[k][j] * x[j]).sum();
            x[k] = (rows[k][n] - known) / rows[k][k];
        }
        x.into_iter().zip(scales).map(|(x, scale)| x / scale).collect()
    }
}
