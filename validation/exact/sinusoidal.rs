//! A sinusoidal pressure p̂ cos(**q**·**x**) on a half-space: stresses and displacements in closed form.
//!
//! With **n** = **q**/q and ζ = qz, positive in tension, u_z into the body:
//!
//! σ_zz = −p̂(1+ζ)e^{−ζ} cos,  σ_αz = −p̂ n_α ζ e^{−ζ} sin,  σ_αβ = −p̂[n_α n_β(1−2ν−ζ) + 2ν δ_αβ]e^{−ζ} cos,
//! u_z = p̂(2−2ν+ζ)e^{−ζ} cos/(2Gq),  u_α = −p̂ n_α(1−2ν−ζ)e^{−ζ} sin/(2Gq)
//!
//! (the Boussinesq–Papkovich solution, as in Johnson, Contact Mechanics (1985), §13.2). In the plane of the wave τ₁ is
//! p̂ ζe^{−ζ} everywhere, at most p̂/e at the depth 1/q.

use percoat_core::body::Material;
use percoat_core::stress::StressState;

/// State at **x** = (x, y) and the depth z under cos(**q**·**x**), p̂ = 1.
pub fn state(q: [f64; 2], [x, y]: [f64; 2], z: f64, material: Material) -> StressState {
    let wavenumber = q[0].hypot(q[1]);
    let n = q.map(|component| component / wavenumber);
    let nu = material.poisson();
    let (zeta, decay) = (wavenumber * z, (-wavenumber * z).exp());
    let (sine, cosine) = (q[0] * x + q[1] * y).sin_cos();
    let in_plane = |a: f64, b: f64, same: f64| -(a * b * (1.0 - 2.0 * nu - zeta) + 2.0 * nu * same) * decay * cosine;
    let softness = 0.5 / (material.shear() * wavenumber);
    let lateral = -(1.0 - 2.0 * nu - zeta) * decay * sine * softness;
    StressState {
        xx: in_plane(n[0], n[0], 1.0),
        yy: in_plane(n[1], n[1], 1.0),
        zz: -(1.0 + zeta) * decay * cosine,
        xy: in_plane(n[0], n[1], 0.0),
        xz: -n[0] * zeta * decay * sine,
        yz: -n[1] * zeta * decay * sine,
        displacement: [n[0] * lateral, n[1] * lateral, (2.0 - 2.0 * nu + zeta) * decay * cosine * softness],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_surface_is_free_of_shear_and_sinks_by_its_compliance() {
        let material = Material::from_young(3.0, 0.3).unwrap();
        let q = [2.0, 1.5];
        let top = state(q, [0.0, 0.0], 0.0, material);
        assert!((top.zz + 1.0).abs() < 1e-15 && top.xz == 0.0 && top.yz == 0.0);
        let compliance = 2.0 / (material.contact_modulus() * 2.5);
        assert!((top.displacement[2] / compliance - 1.0).abs() < 1e-14);
    }
}
