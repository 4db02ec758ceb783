# %% [markdown]
# # A sweep for people with a spreadsheet
#
# The table of a sweep is a dict of columns, which pandas takes as it is. One call writes it as XLSX; a second
# sheet holds the settings, so that the file alone says what was computed. It needs
# `pip install pandas openpyxl`.

# %%
from io import BytesIO

import pandas as pd

import percoat

thickness = [0.1, 0.2, 0.5, 1.0]
setting = {"layers.0.shear_ratio": [0.5, 2.0], "grid.points": 64}
table = percoat.sweep("fig2", {"layers.0.thickness": thickness, **setting})
assert all(table["status"] == "done")

# %% [markdown]
# ## The workbook
#
# A sweep has more than a hundred columns; a few of them are enough for a reader. A column of numbers stays one
# of numbers, and a cell without a value is empty. Here it stays in memory: give `ExcelWriter` the path `"fig2.xlsx"`
# instead of it for a file.

# %%
wanted = ["status", "mean_pressure", "penetration", "contact_fraction", "max_pressure"]
frame = pd.DataFrame(table)
frame = frame[[name for name in frame if name.startswith("set_")] + wanted]
settings = pd.Series({"case": "fig2", **setting, "percoat": percoat.__version__}, name="value").astype(str)

workbook = BytesIO()
with pd.ExcelWriter(workbook, engine="openpyxl") as book:
    frame.to_excel(book, sheet_name="sweep", index=False)
    settings.to_excel(book, sheet_name="settings")

# %% [markdown]
# Read back, it is what was written: the workbook keeps double precision, whatever a spreadsheet shows of it.

# %%
again = pd.read_excel(workbook, sheet_name="sweep")
assert list(again) == list(frame) and len(again) == 8
for name in wanted[1:]:
    assert (again[name] - frame[name]).abs().max() <= 1e-15 * frame[name].abs().max(), name
# A thicker hard coating lets the indenters sink in less under the same mean pressure.
assert frame[frame.set_layers_0_shear_ratio == 2.0].penetration.is_monotonic_decreasing
print(frame.to_string(index=False))
