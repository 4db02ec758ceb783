//! Stresses under a sliding sphere whose traction does not change its pressure, in closed form.
//!
//! Under the pressure p₀√(1 − r²) and the traction μp₀√(1 − r²) in +x on the body, lengths over the contact radius, stresses
//! over p₀ or μp₀ and positive in tension, everything is made of
//!
//! H_jm = ∫₀^∞ (sin k − k cos k) k^{j−2} e^{−kz} J_m(kr) dk,   j = 0, 1,   m = 0 … 3
//!
//! (`validation/sliding-sphere/README.md`), which with Z = z + i, R = √(r² + Z²), v = 1/(R + Z) are
//!
//! H_0m = −Im[i g_m + h_m],  zH_1m = −Im[i z rᵐvᵐ/R + z g_m],  g₀ = log v,  g_m = rᵐvᵐ/m,  h₀ = −Z log v − R,
//! h_m = r (g_{m−1} + g_{m+1})/(2m).
//!
//! Among its images on a lattice of the period l ≫ a the body feels what their point forces make near the origin. By the
//! symmetry of the lattice it grows in proportion to the place, with (a/l)³S₃ times
//!
//! σ_x = σ_y = −(1+ν)z/3   of the pressure, and of the traction
//! (σ_x, σ_y, τ_xy) = [(4+ν)x, 3νx, (2−ν)y]/12,  τ_xz = −z/2;
//!
//! the next terms are of the order (a/l)⁵.

use rustfft::num_complex::Complex64;
use std::f64::consts::PI;

/// σ_x, σ_y, σ_z, τ_xy, τ_xz, τ_yz.
pub type Stress = [f64; 6];

/// Stresses at x, y, z (over a, z ≥ 0) of the pressure over p₀, and of the traction over μp₀.
pub fn stresses(nu: f64, [x, y, z]: [f64; 3]) -> [Stress; 2] {
    let (h, zh) = hankel([x, y, z]);
    let (square, product) = (x * x - y * y, 2.0 * x * y);
    let (cube, cross) = (x * (x * x - 3.0 * y * y), y * (3.0 * x * x - y * y));
    let mean = -0.5 * ((1.0 + 2.0 * nu) * h[0] - zh[0]);
    let turned = 0.5 * ((1.0 - 2.0 * nu) * h[2] - zh[2]);
    let normal =
        [mean + square * turned, mean - square * turned, -h[0] - zh[0], product * turned, -x * zh[1], -y * zh[1]];
    let [first, third] = [1, 3].map(|m| 0.25 * (2.0 * nu * h[m] + zh[m]));
    let tangential = [
        x * (3.0 * first - 2.0 * (1.0 + nu) * h[1]) - cube * third,
        x * (first - 2.0 * nu * h[1]) + cube * third,
        -x * zh[1],
        y * (first - h[1]) - cross * third,
        -h[0] + 0.5 * (zh[0] - square * zh[2]),
        -0.5 * product * zh[2],
    ];
    [normal, tangential]
}

/// Part of the images in the normal and the tangential stresses, over (a/l)³S₃.
pub fn images(nu: f64, [x, y, z]: [f64; 3]) -> [Stress; 2] {
    let lateral = -(1.0 + nu) * z / 3.0;
    let [along, across, shear] = [(4.0 + nu) * x, 3.0 * nu * x, (2.0 - nu) * y].map(|part| part / 12.0);
    [[lateral, lateral, 0.0, 0.0, 0.0, 0.0], [along, across, 0.0, shear, -0.5 * z, 0.0]]
}

/// Both together: that of the pressure and μ times that of the traction.
pub fn together([normal, tangential]: [Stress; 2], friction: f64) -> Stress {
    std::array::from_fn(|k| normal[k] + friction * tangential[k])
}

/// A stress in axes that are turned by −`angle`: that of a body turned by `angle`.
pub fn turned([xx, yy, zz, xy, xz, yz]: Stress, angle: f64) -> Stress {
    let (s, c) = angle.sin_cos();
    [
        c * c * xx + s * s * yy - 2.0 * s * c * xy,
        s * s * xx + c * c * yy + 2.0 * s * c * xy,
        zz,
        s * c * (xx - yy) + (c * c - s * s) * xy,
        c * xz - s * yz,
        s * xz + c * yz,
    ]
}

/// The von Mises stress.
pub fn mises([xx, yy, zz, xy, xz, yz]: Stress) -> f64 {
    let apart = (xx - yy).powi(2) + (yy - zz).powi(2) + (zz - xx).powi(2);
    (0.5 * apart + 3.0 * (xy * xy + xz * xz + yz * yz)).sqrt()
}

/// σ_x over p₀ at the trailing edge: the largest tension of all.
pub fn trailing_tension(nu: f64, friction: f64) -> f64 {
    (1.0 - 2.0 * nu) / 3.0 + friction * PI * (4.0 + nu) / 8.0
}

/// H_0m/rᵐ and zH_1m/rᵐ for m = 0 … 3.
fn hankel([x, y, z]: [f64; 3]) -> ([f64; 4], [f64; 4]) {
    let square = x * x + y * y;
    let source = Complex64::new(z, 1.0);
    let root = Complex64::new(square - 1.0 + z * z, 2.0 * z).sqrt();
    let v = (root + source).inv();
    // At the edge it is zero.
    let depth = if z > 0.0 { z / root } else { Complex64::ZERO };
    let once = [v.ln(), v, v.powi(2) / 2.0, v.powi(3) / 3.0, v.powi(4) / 4.0];
    let twice = [
        -source * once[0] - root,
        (once[0] + square * once[2]) / 2.0,
        (once[1] + square * once[3]) / 4.0,
        (once[2] + square * once[4]) / 6.0,
    ];
    let h = std::array::from_fn(|m| -(Complex64::I * once[m] + twice[m]).im);
    let zh = std::array::from_fn(|m| -(Complex64::I * depth * v.powi(m as i32) + z * once[m]).im);
    (h, zh)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::hertz::Stresses;

    fn near(found: Stress, expected: Stress, tolerance: f64) {
        assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < tolerance), "{found:?} for {expected:?}");
    }

    #[test]
    fn the_surface_in_contact_is_johnsons_and_the_normal_part_hubers() {
        let nu = 0.3;
        for [x, y, z] in [[0.3, 0.4, 0.0], [-0.8, 0.1, 0.0], [0.3, 0.9, 0.2], [1.5, -0.4, 0.0], [-2.0, 1.0, 1.3]] {
            let [normal, tangential] = stresses(nu, [x, y, z]);
            let (r, bearing) = (f64::hypot(x, y), f64::atan2(y, x));
            let huber = Stresses::at(r, z, nu);
            near(normal, turned([huber.radial, huber.hoop, huber.axial, 0.0, huber.shear, 0.0], bearing), 1e-14);
            if z == 0.0 && r < 1.0 {
                let [xx, yy, xy] = [(4.0 + nu) * x, 3.0 * nu * x, (2.0 - nu) * y].map(|part| -PI / 8.0 * part);
                near(tangential, [xx, yy, 0.0, xy, -(1.0 - r * r).sqrt(), 0.0], 1e-14);
            }
        }
        let edge = together(stresses(nu, [-1.0, 0.0, 0.0]), 0.5);
        assert!((edge[0] - trailing_tension(nu, 0.5)).abs() < 1e-14);
    }

    #[test]
    fn images_are_those_of_point_forces_on_the_lattice() {
        // Forces of 2π/3 at the sites of a hexagonal lattice of the period 20 under the stresses of a far contact, summed in
        // circles; what is left is the next term and the end of the sum.
        let (nu, period, place) = (0.3, 20.0, [0.7, -0.4, 0.5]);
        let mut sum = [[0.0; 6]; 2];
        let reach = 400i32;
        for (i, j) in (-reach..=reach).flat_map(|i| (-reach..=reach).map(move |j| (i, j))) {
            if (i, j) == (0, 0) || i * i + i * j + j * j > reach * reach * 3 / 4 {
                continue;
            }
            let [dx, dy] = [f64::from(i) + 0.5 * f64::from(j), 0.75f64.sqrt() * f64::from(j)].map(|s| period * s);
            let part = stresses(nu, [place[0] - dx, place[1] - dy, place[2]]);
            sum.iter_mut().zip(part).for_each(|(sum, part)| (0..6).for_each(|k| sum[k] += part[k]));
        }
        let scale = 11.03417573491481 / f64::powi(period, 3);
        for (found, expected) in sum.into_iter().zip(images(nu, place)) {
            near(found, expected.map(|part| scale * part), 2e-3 * scale);
        }
    }

    #[test]
    fn a_turned_stress_has_the_same_von_mises() {
        let stress = together(stresses(0.25, [0.2, 0.5, 0.3]), 0.4);
        assert!((mises(turned(stress, 0.7)) - mises(stress)).abs() < 1e-15);
        near(turned([1.0, 2.0, 3.0, 0.0, 4.0, 0.0], 0.5 * PI), [2.0, 1.0, 3.0, 0.0, 0.0, 4.0], 1e-15);
    }
}
