# %% [markdown]
# # A rough surface on a coating
#
# A self-affine surface touches at its summits alone. As long as little of it touches, the contact area
# grows in proportion to the load,
#
#     A/A₀ = κ p̄/(E* h′),
#
# with the rms slope h′ and κ near 2: √(2π) = 2.51 after Bush, Gibson & Thomas (1975) and √(8/π) = 1.60
# after Persson (2001) enclose what simulations find. Spots that are much smaller than the thickness of a
# coating feel the E* of the coating, large ones that of the substrate.
#
# Lengths in µm, pressures in GPa: 1 µm of titanium nitride on steel.

# %%
import matplotlib.pyplot as plt
import numpy as np

import percoat
import percoat.plot

# %% [markdown]
# ## The surface
#
# A periodic square of 40 µm. The spectrum is constant down to a wavelength of 10 µm, then falls as
# q^(−2(1+H)) with the Hurst exponent H = 0.8, and ends at 16 samples a wave. It is scaled to an rms slope
# of 0.02. Phases and amplitudes follow from the seed.

# %%
n, size, slope = 512, 40.0, 0.02
order = np.meshgrid(np.fft.fftfreq(n, 1 / n), np.fft.rfftfreq(n, 1 / n), indexing="ij")
wave = 2 * np.pi / size * np.stack(order)
q = np.hypot(*wave)
amplitude = np.maximum(q, 2 * np.pi / 10.0) ** -(1 + 0.8) * (q > 0) * (q <= 2 * np.pi / (16 * size / n))
noise = np.random.default_rng(seed=1).standard_normal((n, n))
spectrum = amplitude * np.fft.rfft2(noise)
gradient = np.fft.irfft2(1j * wave * spectrum, s=(n, n))
heights = np.fft.irfft2(spectrum, s=(n, n)) * slope / np.sqrt((gradient**2).sum(axis=0).mean())
print(f"rms height {heights.std():.4f} µm, from {heights.min():.3f} to {heights.max():.3f} µm")

# %% [markdown]
# ## With the coating and without
#
# percoat warns that the spots at small loads have few samples. Counting the samples in contact
# overestimates the area of such spots, by the border; `rough.corrected_fraction` takes that off by the
# length of the border (Yastrebov, Anciaux & Molinari 2017).

# %%
steel, nitride = {"young": 210.0, "poisson": 0.3}, {"young": 450.0, "poisson": 0.25}
bare_case = {
    "title": "A rough surface on steel",
    "lattice": {"kind": "square", "period": size},
    "surface": {"heights": heights},
    "substrate": steel,
    "load": {"mean_pressure": [0.02, 0.05, 0.1, 0.2, 0.4]},
    "units": {"length": "µm", "pressure": "GPa"},
}
bare = percoat.solve(bare_case)
coated = percoat.solve({**bare_case, "layers": [{"thickness": 1.0, **nitride}]})

steel_modulus, nitride_modulus = (body["young"] / (1 - body["poisson"] ** 2) for body in (steel, nitride))
load = np.array([step.mean_pressure for step in bare])
bare_area = np.array([step.rough.corrected_fraction for step in bare])
coated_area = np.array([step.rough.corrected_fraction for step in coated])
kappa = bare_area * steel_modulus * slope / load
print("mean pressure  in contact, bare  coated  κ, bare")
for row in zip(load, bare_area, coated_area, kappa):
    print("{:13.2f} {:17.2%} {:7.2%} {:8.2f}".format(*row))

light = bare_area < 0.1  # the law is one of small areas
assert light.sum() >= 3
assert np.all((kappa[light] > np.sqrt(8 / np.pi)) & (kappa[light] < np.sqrt(2 * np.pi)))
# A body of nitride alone would have less contact than the coated one, by the ratio of the moduli.
ratio = coated_area / bare_area
assert np.all((ratio > steel_modulus / nitride_modulus) & (ratio < 1))

# %% [markdown]
# ## What a pressure proves about itself
#
# The bare half-space's displacement is w = Cp, ŵ = 2 p̂/(E* q). Of all p ≥ 0 with the given mean, the right
# pressure has the least energy ½⟨p, w⟩ − ⟨p, h⟩. Let d be what another one is off by, and g = w − h its gap.
# By convexity
#
#     ½⟨d, Cd⟩ ≤ ⟨p, g − min g⟩,   and   ⟨d, Cd⟩ ≥ 2/(E* q_max) ⟨d, d⟩,
#
# so that a pressure bounds its own error, whoever found it: rms(d)² ≤ E* q_max ⟨p, g − min g⟩. percoat's
# certificate is the same bound of the energy, over the elastic energy ½⟨p, w⟩.

# %%
compliance = np.divide(2.0, steel_modulus * q, out=np.zeros_like(q), where=q > 0)


def excess(pressure):
    """Bound on the energy of the error of a pressure on the bare half-space, over the area of the cell."""
    gap = np.fft.irfft2(compliance * np.fft.rfft2(pressure), s=(n, n)) - heights
    return np.mean(pressure * (gap - gap.min()))


def largest_error(pressure):
    """Bound on its rms error."""
    return np.sqrt(steel_modulus * q.max() * excess(pressure))


tight = percoat.solve(bare_case, set={"load.mean_pressure": 0.1, "solver.tolerance": 1e-12}).steps[0]
error = largest_error(tight.pressure)
certified = tight.certificate.energy_gap * np.mean(tight.pressure * tight.displacement) / 2
print(f"rms error of percoat's pressure at most {error:.1e} GPa at the mean pressure of 0.1 GPa")
print(f"energy of the error at most {excess(tight.pressure):.3e}; as certified {certified:.3e}")
# The gap of either is rounded, in some units of the last place of the heights.
rounding = 0.1 * 10 * np.finfo(float).eps * np.ptp(heights)
assert abs(excess(tight.pressure) - certified) < rounding

# %% [markdown]
# ## Beside Tamaas
#
# [Tamaas](https://tamaas.readthedocs.io) solves the same discrete problem with a method of its own
# (Polonsky & Keer): the same kernel with E* = E/(1 − ν²), heights and pressures of the same sign, and a
# tolerance for ⟨p, g − min g⟩ over p̄ times the rms height. So its error is bounded as well, and the two
# pressures can differ by no more than the sum of the bounds. A sample with more than n times that, more than
# one of n² samples alone can be off by, is in contact in both.

# %%
try:
    import tamaas
except ImportError:
    print("Tamaas is not installed (pip install tamaas): nothing to compare with.")
else:
    tamaas.set_log_level(tamaas.LogLevel.error)
    model = tamaas.ModelFactory.createModel(tamaas.model_type.basic_2d, [size, size], [n, n])
    model.E, model.nu = steel["young"], steel["poisson"]
    assert np.isclose(model.E_star, steel_modulus, rtol=1e-14)
    tolerance = 1e-12
    tamaas.PolonskyKeerRey(model, heights, tolerance).solve(0.1)
    other = np.array(model.traction)

    difference = np.sqrt(np.mean((tight.pressure - other) ** 2))
    bound = error + np.sqrt(steel_modulus * q.max() * tolerance * 0.1 * heights.std())
    print(f"mean pressures differ by {abs(tight.pressure.mean() - other.mean()):.0e} GPa")
    print(f"in contact, counted: {np.mean(tight.pressure > 0):.6%} here, {np.mean(other > 0):.6%} there")
    print(f"pressures differ by {difference:.1e} GPa (rms); {bound:.1e} GPa is the bound")
    print(f"by {abs(tight.pressure - other).max():.1e} GPa at most, where the peak is {other.max():.2f} GPa")
    assert abs(tight.pressure.mean() - other.mean()) < n**2 * np.finfo(float).eps * 0.1
    assert difference < bound
    assert np.all(other[tight.pressure > n * bound] > 0) and np.all(tight.pressure[other > n * bound] > 0)

# %% [markdown]
# ## The pictures
#
# Contact spots at p̄ = 0.2 GPa, without the coating and with it, in one cell; and the contact area over the
# load between its limits.

# %%
figure, (left, right, curve) = plt.subplots(1, 3, figsize=(13, 4), layout="constrained")
cell = (0.0, size, 0.0, size)
for ax, result, name in ((left, bare, "bare"), (right, coated, "coated")):
    percoat.plot.contact(result.steps[3], ax=ax, window=cell)
    ax.set_title(f"{name}, {result.steps[3].rough.corrected_fraction:.1%} in contact")

curve.plot(load, bare_area, "o-", label="bare")
curve.plot(load, coated_area, "s-", label="coated")
for modulus, name, colour in ((steel_modulus, "steel", "C0"), (nitride_modulus, "nitride", "C1")):
    law = [constant * load / (modulus * slope) for constant in np.sqrt([8 / np.pi, 2 * np.pi])]
    curve.fill_between(load, *law, color=colour, alpha=0.15, linewidth=0, label=f"κ = 1.6 … 2.5, {name}")
curve.set(xlabel="mean pressure (GPa)", ylabel="fraction in contact", xscale="log", yscale="log")
curve.set_xticks(load, [f"{p:g}" for p in load])
curve.set_xticks([], minor=True)
curve.legend(frameon=False)
plt.show()
