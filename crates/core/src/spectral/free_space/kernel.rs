//! Displacement of a sample by the pressure of another one, without periodic images:
//!
//! w(x_i) = Σ_j K_{i−j} p_j,  K_{mn} = d₁d₂/(2π)² ∫_Z Ĉ(k) cos(k_x m d₁) cos(k_y n d₂) d²k
//!
//! over the zone Z = {|k_x| < π/d₁, |k_y| < π/d₂} of a rectangular grid with the spacings d₁, d₂. It depends on the offset and
//! the bodies alone, never on the window, and is what the periodic operator tends to in a large cell at the same spacings.
//! ⟨p, Kp⟩ = d₁d₂/(2π)² ∫_Z Ĉ|p̂|² d²k > 0.
//!
//! Written by c(k) = kĈ(k), finite at k = 0, and the [cut](super::cut) φ of the circle k_N inscribed in the zone,
//!
//! K_{mn}/(d₁d₂) = (1/2π) ∫₀^{k_N} c φ J₀(kr) dk + (1/π²) ∫₀^{π/d₁}∫₀^{π/d₂} (c/k)(1 − φ) cos(k_x m d₁) cos(k_y n d₂) d²k:
//!
//! the first integral is radial and holds all that is singular at k = 0 (`radial`), the integrand of the second is smooth
//! (`filon`). A traction **t**p, **t** = μ**e**, displaces by the odd kernel of B̂ = b/k, t₁K¹ + t₂K²,
//!
//! K¹_{mn}/(d₁d₂) = (x/2πr) ∫₀^{k_N} b φ J₁(kr) dk + (1/π²) ∫∫ (k_x/k)(b/k)(1 − φ) sin(k_x m d₁) cos(k_y n d₂) d²k,
//!
//! K² with x and y exchanged. All to some 10⁻¹⁵ K₀₀.
//!
//! A shear traction **q** displaces in its own plane by Â = L**k̂k̂**ᵀ + S(1 − **k̂k̂**ᵀ): with θ the angle of **k** and φ that of the offset,
//!
//! A_xx = K⁰ + K^c, A_yy = K⁰ − K^c, A_xy = K^s,
//!
//! K⁰ the kernel of ½(L + S), K^c and K^s those of ½(L − S) cos 2θ and ½(L − S) sin 2θ, whose radial parts are −J₂ in the place of J₀,
//! times cos 2φ and sin 2φ, and whose waves are cos·cos and −sin·sin.

use super::cut::high_pass;
use super::filon::{Filon, Wave};
use super::radial::Radial;
use crate::numeric::parallel;
use ndarray::Array2;
use std::f64::consts::PI;

/// Nodes on the shorter side of the zone (70 reach rounding); the longer one has as many more.
const NODES: usize = 80;

/// Function of the wavenumber k > 0 (1/length).
pub type OfWavenumber<'a> = &'a (dyn Fn(f64) -> f64 + Sync);

/// Samples of a window: those that a kernel is tabulated for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Window {
    /// Distances d₁, d₂ of neighbouring samples, lengths.
    pub spacings: [f64; 2],
    /// Numbers of samples N₁, N₂.
    pub points: [usize; 2],
}

/// An axis of the grid.
type Axis = usize;

/// Dependence of a transform on the direction θ of the wave, which its kernel has on that of the offset.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Direction {
    /// None.
    Any,
    /// The component of the unit vector along an axis, times −i.
    Along(Axis),
    /// cos 2θ.
    CosineTwice,
    /// sin 2θ.
    SineTwice,
}

impl Direction {
    /// The Bessel function of the radial part, and its sign.
    fn bessel(self) -> (fn(f64) -> f64, f64) {
        match self {
            Self::Any => (libm::j0, 1.0),
            Self::Along(_) => (libm::j1, 1.0),
            Self::CosineTwice | Self::SineTwice => (|x| libm::jn(2, x), -1.0),
        }
    }

    /// Value for a vector of a length > 0; 0 for the vector 0, where the radial part is 0 unless it depends on no direction.
    fn of(self, [x, y]: [f64; 2]) -> f64 {
        let square = x * x + y * y;
        match self {
            Self::Any => 1.0,
            _ if square == 0.0 => 0.0,
            Self::Along(axis) => [x, y][axis] / square.sqrt(),
            Self::CosineTwice => (x - y) * (x + y) / square,
            Self::SineTwice => 2.0 * x * y / square,
        }
    }

    /// The wave along an axis that is left of the complex one, by symmetry.
    fn wave(self, axis: Axis) -> Wave {
        match self {
            Self::SineTwice => Wave::Sine,
            Self::Along(odd) if odd == axis => Wave::Sine,
            _ => Wave::Cosine,
        }
    }

    /// Sign of the product of both waves.
    fn sign(self) -> f64 {
        if self == Self::SineTwice { -1.0 } else { 1.0 }
    }
}

impl Window {
    /// K_{mn} of c(k) = kĈ(k), lengths per pressure, at the offsets 0 ≤ m < N₁, 0 ≤ n < N₂; even in m and in n.
    pub fn kernel(&self, c: OfWavenumber<'_>) -> Array2<f64> {
        self.table(c, Direction::Any)
    }

    /// K¹_{mn} or K²_{mn}, by its axis, of b(k) = kB̂(k), lengths per pressure, at the offsets 0 ≤ m < N₁, 0 ≤ n < N₂; odd in
    /// the offset along its axis, even in the other.
    pub fn coupling_kernel(&self, b: OfWavenumber<'_>, axis: Axis) -> Array2<f64> {
        self.table(b, Direction::Along(axis))
    }

    /// K^c and K^s of a(k) = k·½(L − S), lengths per pressure, at the offsets 0 ≤ m < N₁, 0 ≤ n < N₂; the first even in m and in n, the
    /// second odd in both.
    pub fn shear_kernels(&self, a: OfWavenumber<'_>) -> [Array2<f64>; 2] {
        [Direction::CosineTwice, Direction::SineTwice].map(|direction| self.table(a, direction))
    }

    /// Memory while a table is made, bytes: the weights of both axes, and the sums over one of them.
    pub fn bytes_while_made(&self) -> usize {
        let ([n1, n2], [nodes1, nodes2]) = (self.points, [0, 1].map(|axis| self.nodes(axis)));
        8 * (nodes1 * (nodes1 + n1 + n2) + nodes2 * (nodes2 + n2))
    }

    /// Nodes over the zone along an axis.
    fn nodes(&self, axis: Axis) -> usize {
        let [d1, d2] = self.spacings;
        (NODES as f64 * d1.max(d2) / self.spacings[axis]).ceil() as usize
    }

    /// The kernel of f times a function of the direction.
    fn table(&self, f: OfWavenumber<'_>, direction: Direction) -> Array2<f64> {
        let ([d1, d2], [n1, n2]) = (self.spacings, self.points);
        let spacing = d1.max(d2);
        let (bessel, sign) = direction.bessel();
        let (radial_scale, scale) = (sign * 0.5 * d1 * d2 / spacing, direction.sign() * (PI * PI).recip());
        let [u1, u2] = [d1 / spacing, d2 / spacing];
        let reach = (u1 * n1 as f64).hypot(u2 * n2 as f64);
        let radial = Radial::new(bessel, reach, |s| f(s * PI / spacing));
        let rest = Rest::new(self, f, direction);
        let mut table = Array2::zeros((n1, n2));
        parallel::each_chunk_with(
            table.as_slice_mut().expect("made row by row"),
            n2,
            || vec![0.0; n2],
            |sums, m, row| {
                rest.row(m, sums);
                for (n, (value, rest)) in row.iter_mut().zip(&*sums).enumerate() {
                    let x = [u1 * m as f64, u2 * n as f64];
                    let rho = x[0].hypot(x[1]);
                    *value = radial_scale * direction.of(x) * radial.at(rho) + scale * rest;
                }
            },
        );
        table
    }
}

/// ∫∫ (f/k)(1 − φ) trig(k_x m d₁) trig(k_y n d₂) dk_y dk_x times d₁d₂, row by row.
struct Rest {
    along: Filon,
    /// Σ_{q′} g_{qq′} A_{q′n}, n fastest, g the integrand without its waves.
    sums: Vec<f64>,
}

impl Rest {
    fn new(window: &Window, f: OfWavenumber<'_>, direction: Direction) -> Self {
        let Window { spacings, points } = *window;
        let spacing = spacings[0].max(spacings[1]);
        let filon = |axis: Axis| Filon::new(window.nodes(axis), points[axis], direction.wave(axis));
        let [along, across] = [0, 1].map(filon);
        let mut sums = vec![0.0; along.nodes.len() * points[1]];
        parallel::each_chunk(&mut sums, points[1], |number, sums| {
            let node = along.nodes[number];
            let kx = PI / spacings[0] * node;
            let integrand = |node: &f64| {
                let ky = PI / spacings[1] * node;
                let k = kx.hypot(ky);
                direction.of([kx, ky]) * f(k) / k * high_pass(k * spacing / PI)
            };
            let values: Vec<f64> = across.nodes.iter().map(integrand).collect();
            for (sum, weights) in sums.iter_mut().zip(across.offsets()) {
                *sum = values.iter().zip(weights).map(|(value, weight)| value * weight).sum();
            }
        });
        Self { along, sums }
    }

    /// The integrals of the offsets (m, n) for all n.
    fn row(&self, m: usize, integrals: &mut [f64]) {
        integrals.fill(0.0);
        let weights = self.along.offsets().nth(m).expect("an offset of the window");
        for (weight, sums) in weights.iter().zip(self.sums.chunks_exact(integrals.len())) {
            integrals.iter_mut().zip(sums).for_each(|(integral, sum)| *integral += weight * sum);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{HalfSpace, Interface, Layer, Material};
    use crate::numeric::quadrature::gauss;

    /// Half-spaces of the shear modulus 1 with a layer of a thickness under each other name.
    fn bodies(h: f64) -> Vec<(&'static str, HalfSpace)> {
        let material = |shear, poisson| Material::from_shear(shear, poisson).unwrap();
        let coated = |chi, poisson, interface| {
            let layer = Layer::new(material(chi, poisson), h, interface).unwrap();
            HalfSpace::new(vec![layer], material(1.0, 0.3))
        };
        vec![
            ("bare", HalfSpace::new(vec![], material(1.0, 0.3))),
            ("stiff", coated(1e3, 0.2, Interface::Bonded)),
            ("very stiff", coated(1e6, 0.3, Interface::Bonded)),
            ("soft, incompressible", coated(1e-6, 0.5, Interface::Bonded)),
            ("frictionless", coated(100.0, 0.25, Interface::Frictionless)),
            ("soft, frictionless", coated(0.05, 0.45, Interface::Frictionless)),
            ("on springs", coated(2.0, 0.2, Interface::Spring { tangential: 1e-3, normal: 1e-3 })),
        ]
    }

    fn c(half_space: &HalfSpace) -> impl Fn(f64) -> f64 + Sync {
        |k| k * half_space.response().compliance(k)
    }

    fn b(half_space: &HalfSpace) -> impl Fn(f64) -> f64 + Sync {
        |k| k * half_space.response().surface(k).coupling
    }

    /// Nodes and weights on (0, 1) for waves up to a rate: on octaves and parts of them, more where waves are short.
    fn graded(rate: f64) -> Vec<[f64; 2]> {
        let octaves =
            (0..44).map(|octave| [if octave < 43 { 0.5f64.powi(octave + 1) } else { 0.0 }, 0.5f64.powi(octave)]);
        let parts = octaves.flat_map(|[low, high]| {
            let (parts, width) = (((high - low) * rate / 60.0).ceil().max(1.0), high - low);
            (0..parts as usize).map(move |part| [low + width * part as f64 / parts, width / parts])
        });
        let (few, many) = (gauss(24), gauss(60));
        let nodes = |[start, width]: [f64; 2]| {
            let rule = if width * rate < 6.0 { &few } else { &many };
            rule.iter().map(move |[x, w]| [start + 0.5 * width * (1.0 + x), 0.5 * width * w])
        };
        parts.flat_map(nodes).collect()
    }

    /// The integrals over the zone in polar coordinates, K of c and K¹, K², K^c, K^s of b, at some offsets.
    fn polar(window: &Window, [c, b]: [OfWavenumber<'_>; 2], offsets: &[[usize; 2]]) -> Vec<[f64; 5]> {
        let sides = window.spacings.map(|d| PI / d);
        let place = |offset: &[usize; 2]| [0, 1].map(|axis| offset[axis] as f64 * window.spacings[axis]);
        let reach = offsets.iter().map(|offset| place(offset)[0].hypot(place(offset)[1])).fold(0.0, f64::max);
        let corner = sides[1].atan2(sides[0]);
        let (parts, rule) = (1 + (reach * sides[0].hypot(sides[1]) / 100.0) as usize, gauss(80));
        let sectors = [(0, 0.0, corner), (1, corner, 0.5 * PI)].into_iter().flat_map(|(side, from, to)| {
            let width = (to - from) / parts as f64;
            let angles = (0..parts).flat_map(|part| rule.iter().map(move |node| (part, *node)));
            angles.map(move |(part, [t, w])| (side, from + width * (part as f64 + 0.5 * (1.0 + t)), 0.5 * width * w))
        });
        let area = window.spacings[0] * window.spacings[1] / (PI * PI);
        let rays = parallel::map_items(&sectors.collect::<Vec<(usize, f64, f64)>>(), |&(side, angle, weight)| {
            let direction = [angle.cos(), angle.sin()];
            let border = sides[side] / direction[side];
            let mut sums = vec![[0.0; 5]; offsets.len()];
            for [s, w] in graded(border * reach) {
                let (k, w) = (s * border, area * weight * border * w);
                let (c, b) = (w * c(k), w * b(k));
                for (sums, offset) in sums.iter_mut().zip(offsets) {
                    let [x, y] = [0, 1].map(|axis| (k * direction[axis] * place(offset)[axis]).sin_cos());
                    sums[0] += c * x.1 * y.1;
                    sums[1] += b * direction[0] * x.0 * y.1;
                    sums[2] += b * direction[1] * x.1 * y.0;
                    sums[3] += b * (2.0 * angle).cos() * x.1 * y.1;
                    sums[4] -= b * (2.0 * angle).sin() * x.0 * y.0;
                }
            }
            sums
        });
        rays.into_iter().fold(vec![[0.0; 5]; offsets.len()], |whole, ray| {
            whole.into_iter().zip(ray).map(|(a, b)| std::array::from_fn(|kind| a[kind] + b[kind])).collect()
        })
    }

    fn largest(table: &Array2<f64>) -> f64 {
        table.iter().fold(0.0, |largest, value| value.abs().max(largest))
    }

    const OFFSETS: [[usize; 2]; 7] = [[0, 0], [1, 0], [0, 1], [3, 2], [17, 0], [0, 23], [22, 21]];

    /// (4/π) ln(1 + √2) d/E*.
    #[test]
    fn the_displacement_of_a_sample_by_its_own_pressure_is_known() {
        for d in [1.0, 1.0 / 400.0, 7.3] {
            let window = Window { spacings: [d, d], points: [3, 3] };
            let displacement = window.kernel(&|_| 2.0)[[0, 0]];
            let exact = 4.0 / PI * (1.0 + 2f64.sqrt()).ln() * d;
            assert!((displacement / exact - 1.0).abs() < 1e-14, "{displacement} {exact}");
        }
    }

    /// Layers from far below to far above the spacing, and grids of unequal spacings.
    #[test]
    fn the_kernel_is_its_integral_over_the_zone() {
        for (spacings, h) in [([1.0, 1.0], 0.2), ([1.0, 1.0], 4.0), ([0.5, 1.0], 1.0), ([1.0, 0.25], 30.0)] {
            let window = Window { spacings, points: [24, 24] };
            for (name, half_space) in bodies(h) {
                let (c, b) = (c(&half_space), b(&half_space));
                let [along, across] = [0, 1].map(|axis| window.coupling_kernel(&b, axis));
                let [cosine, sine] = window.shear_kernels(&b);
                let tables = [window.kernel(&c), along, across, cosine, sine];
                let at_zero = tables[0][[0, 0]];
                for (offset, exact) in OFFSETS.iter().zip(polar(&window, [&c, &b], &OFFSETS)) {
                    for (kind, (table, exact)) in tables.iter().zip(exact).enumerate() {
                        let error = (table[*offset] - exact).abs() / at_zero;
                        assert!(error < 1e-14, "{name}, {spacings:?}, h {h}, kernel {kind} at {offset:?}: {error:e}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_larger_window_has_the_same_kernel() {
        for (name, half_space) in bodies(0.7) {
            let (c, b) = (c(&half_space), b(&half_space));
            let tables = [[24, 30], [96, 50]].map(|points| {
                let window = Window { spacings: [1.0, 0.6], points };
                [window.kernel(&c), window.coupling_kernel(&b, 0), window.coupling_kernel(&b, 1)]
            });
            for (small, large) in tables[0].iter().zip(&tables[1]) {
                assert!(small.indexed_iter().all(|(offset, value)| *value == large[offset]), "{name}");
            }
        }
    }

    /// A compliance that is the same for all waves displaces where the pressure is, by itself.
    #[test]
    fn a_constant_compliance_is_local() {
        let window = Window { spacings: [0.3, 0.5], points: [30, 20] };
        let table = window.kernel(&|k| 1.7 * k);
        for ((m, n), value) in table.indexed_iter() {
            let expected = if m + n == 0 { 1.7 } else { 0.0 };
            assert!((value - expected).abs() < 1e-14, "{m}, {n}: {value}");
        }
    }

    /// Odd kernels have no value at the offset zero along their axis, and are exchanged with the axes.
    #[test]
    fn coupling_kernels_of_both_axes_are_alike() {
        let window = Window { spacings: [1.0, 1.0], points: [12, 12] };
        let [x, y] = [0, 1].map(|axis| window.coupling_kernel(&|_| 1.0, axis));
        let size = largest(&x);
        for ((m, n), value) in x.indexed_iter() {
            assert!((value - y[[n, m]]).abs() < 1e-15 * size);
            assert!(m > 0 || *value == 0.0);
        }
        // b x/(2πr²) d₁d₂ far away, but for the ringing of the zone, (−1)^m/2 along the axis.
        let far = 0.5 * (x[[10, 10]] + x[[11, 11]]);
        assert!((far / (1.0 / (4.0 * PI) * 0.5 * (0.1 + 1.0 / 11.0)) - 1.0).abs() < 1e-2, "{far}");
    }
}
