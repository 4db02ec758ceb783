"""Makes coupled.csv: a contact of two unlike elastic bodies, one coated, that sticks and slips, solved densely; nothing of percoat enters.

Periodic cell, N1 x N2 samples (both odd), waves q = 2 pi (m b1 + n b2) with the shortest aliases, u of mean zero. One wave e^{iqx}, s = qz, in
displacements u_x = iU, u_z = W and with kappa = 3 - 4 nu:

    decaying   U = (a + b s) e^{-s},  W = (-a - kappa b - b s) e^{-s},
    growing    U = (c + d t) e^{-t},  W = ( c + kappa d + d t) e^{-t},  t = q(h - z),

from Navier's equations; sigma_zz = lambda e + 2 G W', tau_xz = i G (U' + q W), e = -q U + W'. The coefficients of all layers follow from one
system: tractions on the surface, continuity below. Surface tractions sigma_zz = -p, tau_xz = -q_x. Across: G cosh, sinh. The counterbody is the
mirror image: C, L, S add, K of the counterbody is subtracted.

Signorini and Coulomb, g = w + f - delta >= 0, p >= 0, pg = 0 and |q| <= mu p, the slip u_before + d - u along q, by steps; each by relaxation
sample after sample on the dense matrices, p <- max(0, p - g/C_0), q <- disc(q - (u - u_before - d)/A_0), until nothing changes by 1e-12.
pip install numpy; python generate.py (minutes)
"""
from pathlib import Path

import numpy as np

HERE = Path(__file__).parent
CELL, POINTS = ((1.0, 0.0), (0.35, 0.9)), (21, 23)
# (G, nu, h) from the surface down, then (G, nu).
BODY = ([(4.0, 0.2, 0.1)], (1.0, 0.3))
COUNTERBODY = ([], (2.0, 0.1))
MU, DELTA, SHIFT = 0.4, 0.022, (0.0028, -0.0018)

HEAD = """\
# Pressure and tractions on the body at the samples (i/21) a1 + (j/23) a2 that touch, after the steps of generate.py; then the sums over all.
i,j,p,qx,qy
"""


def plane(q, layers, substrate):
    """C, K, L of one body: W and U by a pressure, U by a traction, a wave of wavenumber q."""
    bodies = [*layers, (*substrate, None)]
    count = 4 * len(layers) + 2
    rows, column = [], 0

    def state(G, nu, h, s):
        """U, W, sigma_zz, tau (without i) at z = s/q of the columns a, b, c, d."""
        kappa, lam = 3 - 4 * nu, 2 * G * nu / (1 - 2 * nu)
        out = []
        families = [(1, s)] if h is None else [(1, s), (-1, q * h - s)]
        for sign, t in families:
            e = np.exp(-t)
            for a, b in ((1, 0), (0, 1)):
                U, dU = (a + b * t) * e, (b - a - b * t) * e
                W, dW = -sign * (a + kappa * b + b * t) * e, -sign * (b - a - kappa * b - b * t) * e
                # d/dz = sign q d/dt.
                dU, dW = sign * q * dU, sign * q * dW
                strain = -q * U + dW
                out.append((U, W, lam * strain + 2 * G * dW, G * (dU + q * W)))
        return np.array(out).T

    place = 0
    top = state(*bodies[0], 0.0)
    system = np.zeros((count, count))
    system[0, :top.shape[1]], system[1, :top.shape[1]] = top[2], top[3]
    line = 2
    for upper, lower in zip(bodies[:-1], bodies[1:]):
        below, above = state(*lower, 0.0), state(*upper, q * upper[2])
        n = above.shape[1]
        system[line:line + 4, place:place + n] = above
        system[line:line + 4, place + n:place + n + below.shape[1]] = -below
        place, line = place + n, line + 4
    # Tractions have the size of the modulus times q, displacements 1.
    scale = np.abs(system).max(axis=1)
    right = np.zeros((count, 2))
    right[0, 0], right[1, 1] = -1, -1
    found = np.linalg.solve(system / scale[:, None], right / scale[:, None])[:top.shape[1]]
    (Up, Uq), (Wp, Wq) = top[0] @ found, top[1] @ found
    assert abs(Wq - Up) < 1e-9 * abs(Wp), (Wq, Up)
    return Wp, Up, Uq


def across(q, layers, substrate):
    """S: displacement by a traction across the wave, by impedances from below."""
    G, _ = substrate
    z = G * q
    for G, _, h in reversed(layers):
        t = np.tanh(q * h)
        z = G * q * (z + G * q * t) / (G * q + z * t)
    return 1 / z


def kernels():
    a = np.array(CELL)
    b = np.linalg.inv(a).T
    m, n = (np.fft.fftfreq(count, 1 / count) for count in POINTS)
    best = np.full((*POINTS, 2), np.inf)
    for s in range(-2, 3):
        for t in range(-2, 3):
            k = 2 * np.pi * ((m[:, None, None] + s * POINTS[0]) * b[0] + (n[None, :, None] + t * POINTS[1]) * b[1])
            closer = np.hypot(*np.moveaxis(k, -1, 0)) < np.hypot(*np.moveaxis(best, -1, 0)) - 1e-9
            best[closer] = k[closer]
    q = np.hypot(best[..., 0], best[..., 1])
    C, K, L, S = (np.zeros(POINTS) for _ in range(4))
    for i in np.ndindex(*POINTS):
        if q[i] > 0:
            first, second = plane(q[i], *BODY), plane(q[i], *COUNTERBODY)
            C[i], K[i], L[i] = first[0] + second[0], first[1] - second[1], first[2] + second[2]
            S[i] = across(q[i], *BODY) + across(q[i], *COUNTERBODY)
    with np.errstate(invalid="ignore"):
        c, s = (np.where(q > 0, best[..., k] / q, 0) for k in (0, 1))
    hats = {"C": C, "xx": L * c * c + S * s * s, "yy": L * s * s + S * c * c, "xy": (L - S) * c * s, "x": 1j * K * c, "y": 1j * K * s}
    i, j = (np.arange(count) for count in POINTS)
    di, dj = (i[:, None] - i) % POINTS[0], (j[:, None] - j) % POINTS[1]
    size = POINTS[0] * POINTS[1]
    out = {}
    for name, hat in hats.items():
        field = np.fft.ifft2(hat)
        assert abs(field.imag).max() < 1e-12 * abs(field).max()
        out[name] = field.real[di[:, None, :, None], dj[None, :, None, :]].reshape(size, size)
    return out


def step(k, f, delta, rise, before, state, tolerance=1e-12):
    """p, q_x, q_y under a penetration and a rise of the shift, from a state."""
    size = f.size
    # w = C p - (K part) q: the transpose of B.
    whole = np.block([[k["C"], k["x"].T, k["y"].T], [k["x"], k["xx"], k["xy"]], [k["y"], k["xy"], k["yy"]]])
    x = state.copy()
    u = whole @ x
    C0, A0 = k["C"][0, 0], np.linalg.eigvalsh([[k["xx"][0, 0], k["xy"][0, 0]], [k["xy"][0, 0], k["yy"][0, 0]]])[-1]
    for sweep in range(20000):
        most = 0.0
        for i in range(size):
            at = (i, i + size, i + 2 * size)
            p, q = x[i], x[[at[1], at[2]]]
            new = max(0.0, p - (u[i] + f[i] - delta) / C0)
            if new != p:
                u += (new - p) * whole[:, i]
                x[i] = new
                most = max(most, abs(new - p))
            trial = q - (u[[at[1], at[2]]] - before[[i, i + size]] - rise) / A0
            length, bound = np.hypot(*trial), MU * new
            trial = trial * (bound / length) if length > bound else trial
            for part in (0, 1):
                change = trial[part] - q[part]
                if change != 0.0:
                    u += change * whole[:, at[1 + part]]
                    x[at[1 + part]] = trial[part]
                    most = max(most, abs(change))
        if most < tolerance * x[:size].max():
            u = whole @ x
            return x, u[size:], sweep
    raise RuntimeError("no convergence")


def main():
    k = kernels()
    u, v = np.meshgrid(*(np.arange(count) / count for count in POINTS), indexing="ij")
    f = (0.02 * (2 - np.cos(2 * np.pi * u) - np.cos(2 * np.pi * v))).ravel()
    size = f.size
    state, before = np.zeros(3 * size), np.zeros(2 * size)
    # Pressed in two parts of equal contact radius, then shifted in two equal ones.
    path = [(0.25, 0.0), (1.0, 0.0), (1.0, 0.5), (1.0, 0.5)]
    forces = []
    for depth, rise in path:
        state, before, sweeps = step(k, f, depth * DELTA, rise * np.array(SHIFT), before, state)
        p, qx, qy = state.reshape(3, size)
        forces.append((p.sum(), qx.sum(), qy.sum()))
        q = np.hypot(qx, qy)
        touching = p > 0
        print(sweeps, touching.sum(), (q[touching] < MU * p[touching] * (1 - 1e-9)).sum(), forces[-1])
    lines = [f"{i // POINTS[1]},{i % POINTS[1]},{p[i]:.12e},{qx[i]:.12e},{qy[i]:.12e}" for i in range(size) if p[i] > 0]
    lines.append(",".join(["-1", "-1", *(f"{value:.12e}" for value in forces[-1])]))
    (HERE / "coupled.csv").write_text(HEAD + "\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
