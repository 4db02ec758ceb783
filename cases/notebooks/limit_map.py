# %% [markdown]
# # At which load a coating fails, and how
#
# A diamond-like coating (DLC) lies on a chromium interlayer on hardened steel, and spheres slide on it. A
# material may yield; the DLC may crack where the tension behind the sphere reaches its strength; an
# interface may give way under tension and shear. The limit load is the mean pressure at which the first of
# them happens.
#
# A thick coating keeps the load away from the softer chromium. Friction adds tension behind the contact, in
# proportion to its coefficient and whatever the thickness (Hamilton & Goodman 1966). So thin coatings fail
# by what lies under them, and thick ones under friction by themselves: beyond some thickness more of it is
# of no use.
#
# Lengths in µm, pressures in GPa.

# %%
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import LogNorm

import percoat

# %% [markdown]
# ## The sweep
#
# The embedded case `dlc-on-steel`, its spheres of 50 µm radius 10 µm apart, on a coarse grid. With
# `limit=True` a sweep looks for the load at which each criterion is reached, instead of solving given
# loads.

# %%
thickness = np.array([1.0, 2.0, 4.0])
friction = np.array([0.0, 0.2, 0.4, 0.6])
setting = {"lattice.period": 10.0, "grid.points": 48}
table = percoat.sweep(
    "dlc-on-steel", {"layers.0.thickness": thickness, "friction.coefficient": friction, **setting}, limit=True
)
assert all(table["status"] == "done")

# %% [markdown]
# ## What governs
#
# Every criterion has its own limit load and an estimate of its error; the lowest load governs. Where the
# errors leave open which one is the lowest, a question mark says so.

# %%
names = [key[: -len("_mean_pressure")] for key in table if "_of_" in key and key.endswith("_mean_pressure")]
shape = (len(names), len(thickness), len(friction))  # of the settings, the first one varies slowest
limits = np.reshape([table[f"{name}_mean_pressure"] for name in names], shape)
errors = np.reshape([table[f"{name}_error"] for name in names], shape)

governing = np.nanargmin(limits, axis=0)
first = np.take_along_axis(limits, governing[None], axis=0)[0]
highest = np.take_along_axis(limits + errors, governing[None], axis=0)[0]
settled = np.sum(limits - errors < highest, axis=0) == 1
# What is not reached by its value, but may be within its error, is among the rivals.
if "first_rivals" in table:
    settled &= table["first_rivals"].reshape(first.shape) == ""

assert np.array_equal(first, table["first_mean_pressure"].reshape(first.shape))
interlayer, cracking = names.index("yield_of_material_2"), names.index("cracking_of_material_1")
assert set(governing.ravel()) == {interlayer, cracking}
assert governing[0, 0] == interlayer and governing[-1, -1] == cracking
# The chromium yields later under more coating, whatever the errors, and not later under more friction.
low, high = (limits + sign * errors for sign in (-1, 1))
assert np.all(high[interlayer, :-1] < low[interlayer, 1:])
assert np.all(low[interlayer, :, 1:] < high[interlayer, :, :-1])
# The crack needs the same load under any thickness, within the errors, and less of it the more friction
# there is.
assert np.all(low[cracking].max(axis=0) < high[cracking].min(axis=0))
assert np.all(np.diff(limits[cracking], axis=1) < 0)

# %% [markdown]
# ## What the coarse grid costs
#
# percoat warns: 48 samples along 10 µm are about six to the radius of contact. What yields lies a
# micrometre or more below and hardly minds. The tension that cracks the coating has a sharp peak right at
# the edge of contact; a coarse grid misses some of it and finds too high a load. The estimated errors tell
# the two apart, and a finer grid, for one setting of each kind, shows what they are worth.

# %%
relative = errors / limits
for name, index in (("yield of the chromium", interlayer), ("cracking of the DLC", cracking)):
    print(f"estimated error of the load, {name}: {relative[index].min():.1%} to {relative[index].max():.0%}")

for index, h, mu in ((interlayer, 1, 0), (cracking, -1, -1)):
    here = {"layers.0.thickness": thickness[h], "friction.coefficient": friction[mu]}
    fine = percoat.limit("dlc-on-steel", set={**setting, **here, "grid.points": 96}).first
    coarse, error = limits[index, h, mu], errors[index, h, mu]
    print(
        f"{names[index]}: {coarse:.4f} ± {error:.4f} GPa, "
        f"on 96 × 96 samples {fine.mean_pressure:.4f} ± {fine.error:.4f} GPa"
    )
    assert f"{fine.criterion}_of_material_{fine.material}" == names[index]
    assert abs(coarse - fine.mean_pressure) < error + fine.error

# %% [markdown]
# ## The map

# %%
words = {interlayer: "Cr yields", cracking: "DLC cracks"}
figure, ax = plt.subplots(figsize=(7, 4), layout="constrained")
mesh = ax.pcolormesh(friction, np.arange(len(thickness)), first, norm=LogNorm(), shading="nearest")
for h, row in enumerate(first):
    for mu, load in zip(friction, row):
        index = h, np.searchsorted(friction, mu)
        doubt = "" if settled[index] else " ?"
        paper = {"facecolor": "white", "edgecolor": "none", "alpha": 0.8}
        ax.text(mu, h, f"{load:.3f}\n{words[governing[index]]}{doubt}", ha="center", va="center", bbox=paper)
ax.set_yticks(np.arange(len(thickness)), [f"{h:g}" for h in thickness])
ax.set_xticks(friction)
ax.set(xlabel="coefficient of friction", ylabel="thickness of the DLC (µm)")
figure.colorbar(mesh, label="limit load, mean pressure (GPa)")
plt.show()
