//! The state at one point: stress tensor and displacement, principal stresses and equivalent stresses.

use serde::{Deserialize, Serialize};
use std::fmt;

/// Stress (positive in tension, a pressure) and displacement (a length; u_z into the body) at a point.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct StressState {
    /// Stress σ_xx, in the unit of Young's modulus.
    pub xx: f64,
    /// Stress σ_yy, in the unit of Young's modulus.
    pub yy: f64,
    /// Stress σ_zz, in the unit of Young's modulus.
    pub zz: f64,
    /// Stress σ_xy, in the unit of Young's modulus.
    pub xy: f64,
    /// Stress σ_xz, in the unit of Young's modulus.
    pub xz: f64,
    /// Stress σ_yz, in the unit of Young's modulus.
    pub yz: f64,
    /// Displacement u_x, u_y, u_z, lengths; not kept in files.
    #[serde(skip)]
    pub displacement: [f64; 3],
}

impl StressState {
    /// Largest difference of a stress component from that of another state, a pressure.
    pub fn difference_from(&self, other: &Self) -> f64 {
        let (a, b) = (self.components(), other.components());
        (0..6).map(|c| (a[c] - b[c]).abs()).fold(0.0, f64::max)
    }

    /// State from xx, yy, zz, xy, xz, yz, u_x, u_y, u_z.
    pub fn from_components([xx, yy, zz, xy, xz, yz, ux, uy, uz]: [f64; 9]) -> Self {
        Self { xx, yy, zz, xy, xz, yz, displacement: [ux, uy, uz] }
    }

    /// State from xx, yy, zz, xy, xz, yz; the displacement is left out.
    pub(super) fn from_stresses([xx, yy, zz, xy, xz, yz]: [f64; 6]) -> Self {
        Self { xx, yy, zz, xy, xz, yz, ..Self::default() }
    }

    /// State on the surface under the pressure p from xx, yy, xy, p and the `traction` over the pressure: σ_zz = −p, σ_αz = −q_α; the
    /// displacement is left out.
    pub(super) fn on_surface([xx, yy, xy, p]: [f64; 4], [tx, ty]: [f64; 2]) -> Self {
        Self { xx, yy, zz: -p, xy, xz: -tx * p, yz: -ty * p, ..Self::default() }
    }

    /// Components xx, yy, zz, xy, xz, yz, u_x, u_y, u_z.
    pub fn components(&self) -> [f64; 9] {
        let [ux, uy, uz] = self.displacement;
        [self.xx, self.yy, self.zz, self.xy, self.xz, self.yz, ux, uy, uz]
    }

    /// Linear interpolation towards another state; `part` is its weight.
    pub fn toward(&self, other: &Self, part: f64) -> Self {
        let (here, there) = (self.components(), other.components());
        Self::from_components(std::array::from_fn(|c| (1.0 - part) * here[c] + part * there[c]))
    }

    /// Normal stress along a direction on the surface, of any length.
    pub fn along(&self, [dx, dy]: [f64; 2]) -> f64 {
        (dx * dx * self.xx + 2.0 * dx * dy * self.xy + dy * dy * self.yy) / (dx * dx + dy * dy)
    }

    /// Principal stresses σ₁ ≥ σ₂ ≥ σ₃.
    ///
    /// Eigenvalues of the deviator by the trigonometric solution of its characteristic equation
    /// s³ − J₂s − J₃ = 0: s_k = 2√(J₂/3) cos(θ − 2πk/3), cos 3θ = (J₃/2)(3/J₂)^{3/2}.
    pub fn principal(&self) -> [f64; 3] {
        let (mean, j2) = self.invariants();
        let (a, b, c) = (self.xx - mean, self.yy - mean, self.zz - mean);
        let (xy, xz, yz) = (self.xy, self.xz, self.yz);
        if j2 == 0.0 {
            return [mean; 3];
        }
        let radius = (j2 / 3.0).sqrt();
        let [a, b, c, xy, xz, yz] = [a, b, c, xy, xz, yz].map(|s| s / radius);
        let j3 = a * (b * c - yz * yz) - xy * (xy * c - yz * xz) + xz * (xy * yz - b * xz);
        let angle = (0.5 * j3).clamp(-1.0, 1.0).acos() / 3.0;
        let (sine, cosine) = angle.sin_cos();
        let first = 2.0 * radius * cosine;
        let last = -radius * (cosine + 3f64.sqrt() * sine);
        [mean + first, mean - first - last, mean + last]
    }

    /// Mean normal stress σ_kk/3.
    pub(super) fn mean(&self) -> f64 {
        (self.xx + self.yy + self.zz) / 3.0
    }

    /// Mean normal stress σ_kk/3, and J₂ of the deviator.
    pub(super) fn invariants(&self) -> (f64, f64) {
        let mean = self.mean();
        let (a, b, c) = (self.xx - mean, self.yy - mean, self.zz - mean);
        (mean, 0.5 * (a * a + b * b + c * c) + self.xy * self.xy + self.xz * self.xz + self.yz * self.yz)
    }

    /// Size √(Σσᵢⱼ²) of the stress tensor, a pressure.
    pub(super) fn size(&self) -> f64 {
        let shear = self.xy * self.xy + self.xz * self.xz + self.yz * self.yz;
        (self.xx * self.xx + self.yy * self.yy + self.zz * self.zz + 2.0 * shear).sqrt()
    }

    /// Principal shear stress τ₁ = (σ₁ − σ₃)/2.
    pub fn tau1(&self) -> f64 {
        let [tau1, _, _] = self.derived();
        tau1
    }

    /// Largest tension σ₁.
    pub fn s1(&self) -> f64 {
        self.principal()[0]
    }

    /// Principal shear stress τ₁, von Mises stress and largest principal stress σ₁.
    pub fn derived(&self) -> [f64; 3] {
        let [first, _, last] = self.principal();
        [0.5 * (first - last), self.mises(), first]
    }

    /// Direction of σ₁, a unit vector whose first non-zero component is positive.
    pub fn s1_direction(&self) -> [f64; 3] {
        let s = self.s1();
        let rows = [[self.xx - s, self.xy, self.xz], [self.xy, self.yy - s, self.yz], [self.xz, self.yz, self.zz - s]];
        // The direction is normal to all rows; the longest cross product of two of them is the most accurate.
        let cross = |u: [f64; 3], v: [f64; 3]| {
            [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
        };
        let square = |v: &[f64; 3]| v.iter().map(|x| x * x).sum::<f64>();
        let normals = [cross(rows[0], rows[1]), cross(rows[1], rows[2]), cross(rows[2], rows[0])];
        let longest = normals.into_iter().max_by(|u, v| square(u).total_cmp(&square(v))).unwrap_or_default();
        let scale: f64 = rows.iter().map(square).sum();
        let vector = if square(&longest) > 1e-24 * scale * scale {
            longest
        } else {
            // σ₁ is double: any direction normal to the one independent row.
            let row = rows.into_iter().max_by(|u, v| square(u).total_cmp(&square(v))).unwrap_or_default();
            let axis = if row[0].abs() < row[1].abs() { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
            if square(&row) > 0.0 { cross(row, axis) } else { [1.0, 0.0, 0.0] }
        };
        let length = square(&vector).sqrt();
        let sign = vector.iter().find(|x| x.abs() > 1e-12 * length).map_or(1.0, |x| x.signum());
        vector.map(|x| sign * x / length)
    }

    /// Shear on a plane of constant depth, √(σ_xz² + σ_yz²).
    pub fn interface_shear(&self) -> f64 {
        self.xz.hypot(self.yz)
    }

    /// Von Mises stress √(3J₂).
    pub fn mises(&self) -> f64 {
        let (a, b, c) = (self.xx - self.yy, self.yy - self.zz, self.zz - self.xx);
        let shear = self.xy * self.xy + self.xz * self.xz + self.yz * self.yz;
        (0.5 * (a * a + b * b + c * c) + 3.0 * shear).sqrt()
    }
}

impl fmt::Display for StressState {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "σ xx {:.5e}, yy {:.5e}, zz {:.5e}, xy {:.5e}, xz {:.5e}, yz {:.5e}; τ₁ {:.5e}, σ₁ {:.5e}",
            self.xx,
            self.yy,
            self.zz,
            self.xy,
            self.xz,
            self.yz,
            self.tau1(),
            self.s1()
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn principal_stresses_of_a_rotated_tensor_are_its_eigenvalues() {
        // Eigenvalues 3, 1, −2 along a rotated orthonormal frame.
        let (s, c) = (0.6f64, 0.8f64);
        let frame = [[c, s, 0.0], [-s * c, c * c, s], [s * s, -s * c, c]];
        let values = [3.0, 1.0, -2.0];
        let entry = |i: usize, j: usize| (0..3).map(|k| values[k] * frame[k][i] * frame[k][j]).sum::<f64>();
        let state = StressState {
            xx: entry(0, 0),
            yy: entry(1, 1),
            zz: entry(2, 2),
            xy: entry(0, 1),
            xz: entry(0, 2),
            yz: entry(1, 2),
            ..StressState::default()
        };
        for (found, expected) in state.principal().iter().zip(values) {
            assert!((found - expected).abs() < 1e-14);
        }
        assert!((state.tau1() - 2.5).abs() < 1e-14);
        // The cube of so small a stress is zero.
        let tiny = StressState::from_components(state.components().map(|s| 1e-120 * s));
        assert!((tiny.tau1() / 2.5e-120 - 1.0).abs() < 1e-13, "{tiny}");
        assert!((state.mises() - 19f64.sqrt()).abs() < 1e-13);
        let direction = state.s1_direction();
        assert!((0..3).all(|i| (direction[i] - frame[0][i]).abs() < 1e-13));
    }

    #[test]
    fn double_and_triple_principal_stresses_have_directions_of_length_one() {
        let double = StressState { xx: 2.0, yy: 2.0, zz: -1.0, ..StressState::default() };
        let d = double.s1_direction();
        assert!(d[2].abs() < 1e-14 && (d[0].hypot(d[1]) - 1.0).abs() < 1e-14);
        let triple = StressState { xx: -1.0, yy: -1.0, zz: -1.0, ..StressState::default() };
        assert_eq!(triple.principal(), [-1.0; 3]);
        assert_eq!(triple.s1_direction(), [1.0, 0.0, 0.0]);
    }
}
