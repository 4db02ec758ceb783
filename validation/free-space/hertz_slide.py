"""Hertz pressure p0 sqrt(1-r^2) and traction q_x = mu p on the unit circle of a half-space: closed-form stresses.

Independent derivation (same field as Hamilton 1983).  Boussinesq-Cerruti potentials need one function,
    Phi1 = int p Omega dA,   Omega = z ln(rho+z) - rho,   d2 Phi1/dz2 = V = int p/rho dA.
The Hertz disc is a line of sources at complex depth: V = (pi/2) int_{-1}^{1} (1-t^2) / sqrt(r^2+(z+it)^2) dt.  With L_n the n-th
antiderivative in zeta of 1/R, R = sqrt(r^2+zeta^2), two integrations by parts give, at zeta = z + i,
    V = 2 pi Im L3 - 2 pi Re L2,   Phi = V(n -> n+1),   Phi1 = V(n -> n+2),
and with D = (1/r) d/dr, Q = 1/(R+zeta):
    D L1 = Q/R, D L2 = -Q, D L3 = 1/4 - ln(R+zeta)/2 - zeta Q/2,  D2 L2 = Q^2/R, D2 L3 = -Q^2/2, D2 L4 = Q/3 - zeta Q^2/6, ...
Traction on the body +x (its trailing edge is x = -1), z into the body, tension positive.  p0 = a = 1.
    sigma_xx = [2 nu psi_z + 2 mu V_x - Phi_xx + 2 nu psi1_xx - z psi_xx] / 2 pi,  sigma_yy = [2 nu psi_z - Phi_yy + 2 nu psi1_yy - z psi_yy] / 2 pi
    sigma_zz = [V_z - z psi_zz] / 2 pi,   sigma_xy = [mu V_y - Phi_xy + 2 nu psi1_xy - z psi_xy] / 2 pi
    sigma_xz = [mu V_z - z psi_xz] / 2 pi,  sigma_yz = -z psi_yz / 2 pi,   psi1 = mu Phi1_x + Phi_1z, psi = d psi1/dz.
"""
import numpy as np


def _potentials(x, y, z):
    r2 = x * x + y * y
    zeta = z + 1j
    R = np.sqrt(r2 + zeta * zeta)          # Re R >= 0; on z = 0, r < 1: R = +i sqrt(1-r^2)
    Q = 1 / (R + zeta)
    log = np.log(R + zeta)
    d1 = {1: Q / R, 2: -Q, 3: 0.25 - log / 2 - zeta * Q / 2}
    # D L4 from Laplace: 2 D L_n + r^2 D2 L_n + L_{n-2} = 0
    L2 = zeta * log - R
    d2 = {2: Q**2 / R, 3: -Q**2 / 2, 4: Q / 3 - zeta * Q**2 / 6}
    d1[4] = -(r2 * d2[4] + L2) / 2
    d3 = {4: -Q**3 / 3, 5: Q**2 / 8 - zeta * Q**3 / 12, 3: Q**3 / R}
    d2[5] = -(r2 * d3[5] + d1[3]) / 4      # D of the same
    L = {0: 1 / R, 1: log, 2: L2}

    def comb(t, n):                        # potential of index n: Phi1 = 4, Phi = 3, V = 2, V_z = 1, V_zz = 0
        return 2 * np.pi * (t[n + 1].imag - t[n].real)
    return comb, L, d1, d2, d3


def stresses(x, y, z, mu, nu):
    """(6, ...) array: sigma_xx, yy, zz, xy, xz, yz."""
    x, y, z = np.broadcast_arrays(*(np.asarray(v, float) for v in (x, y, z)))
    with np.errstate(divide='ignore', invalid='ignore'):   # 1/R at the edge only enters as z/R
        comb, L, d1, d2, d3 = _potentials(x, y, z)
    V1, V2 = comb(d1, 2), comb(d2, 2)                  # V_x = x V1, V_xx = V1 + x^2 V2
    Vz1 = comb(d1, 1)                                  # V_zx = x Vz1
    Vz, Vzz = comb(L, 1), comb(L, 0)
    P1, P2, P3 = comb(d1, 3), comb(d2, 3), comb(d3, 3)  # Phi
    F2, F3 = comb(d2, 4), comb(d3, 4)                  # Phi1
    with np.errstate(invalid='ignore'):
        psi_z = mu * x * V1 + Vz
        psi_xz = mu * (V1 + x * x * V2) + x * Vz1
        psi_yz = mu * x * y * V2 + y * Vz1
        psi_zz = mu * x * Vz1 + Vzz
        psi_xx = mu * (3 * x * P2 + x**3 * P3) + V1 + x * x * V2
        psi_yy = mu * (x * P2 + x * y * y * P3) + V1 + y * y * V2
        psi_xy = mu * (y * P2 + x * x * y * P3) + x * y * V2
        psi1_xx = mu * (3 * x * F2 + x**3 * F3) + P1 + x * x * P2
        psi1_yy = mu * (x * F2 + x * y * y * F3) + P1 + y * y * P2
        psi1_xy = mu * (y * F2 + x * x * y * F3) + x * y * P2

        def deep(v):                                   # z times a derivative: zero on the surface
            return np.where(z == 0, 0, z * v)
        return np.array([2 * nu * psi_z + 2 * mu * x * V1 - (P1 + x * x * P2) + 2 * nu * psi1_xx - deep(psi_xx),
                         2 * nu * psi_z - (P1 + y * y * P2) + 2 * nu * psi1_yy - deep(psi_yy),
                         Vz - deep(psi_zz),
                         mu * y * V1 - x * y * P2 + 2 * nu * psi1_xy - deep(psi_xy),
                         mu * Vz - deep(psi_xz),
                         -deep(psi_yz)]) / (2 * np.pi)
