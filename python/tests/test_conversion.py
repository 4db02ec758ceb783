"""Results as what others work with: dicts, datasets of xarray, frames of pandas, JSON."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest

import percoat


@pytest.fixture(scope="module")
def sliding() -> percoat.Result:
    return percoat.solve("dlc-on-steel", set={"grid.points": [48, 64], "load.mean_pressure": [0.0, 0.1, 0.2]})


def plain(value: Any) -> bool:
    """Whether there are dicts, lists, numbers and texts alone."""
    if type(value) is dict:
        return all(type(key) is str and plain(entry) for key, entry in value.items())
    if type(value) is list:
        return all(map(plain, value))
    return value is None or type(value) in (str, int, float, bool)


def test_to_dict_is_plain_and_json(sliding: percoat.Result) -> None:
    for record in (sliding, sliding[1], percoat.check("fig2", set={"grid.points": 48}), sliding[1].maxima()):
        assert record is not None
        entries = record.to_dict()
        assert plain(entries) and json.loads(json.dumps(entries, allow_nan=False)) == entries
    assert plain(percoat.case("dlc-on-steel")) and plain(sliding.case)


def test_to_dict_is_a_copy(sliding: percoat.Result) -> None:
    entries = sliding.to_dict()
    entries["steps"][1]["levels"][0]["load"] = -1.0
    entries["steps"].clear()
    assert sliding[1].levels[0].load > 0.0 and len(sliding.to_dict()["steps"]) == 3


def test_datasets_have_dimensions_coordinates_and_units(sliding: percoat.Result) -> None:
    xarray = pytest.importorskip("xarray")
    data = sliding.to_xarray()
    assert isinstance(data, xarray.Dataset) and dict(data.sizes) == {"step": 3, "x": 48, "y": 64}
    for name, unit in (("pressure", "GPa"), ("displacement", "µm"), ("gap", "µm")):
        assert data[name].dims == ("step", "x", "y") and data[name].attrs["units"] == unit
        for index, step in enumerate(sliding):
            assert data[name][index].values.tobytes() == getattr(step, name).tobytes()
    # The cell is rectangular.
    assert data.x.dims == ("x",) and data.y.dims == ("y",) and data.owner.dims == ("x", "y")
    assert data.x.attrs["units"] == data.y.attrs["units"] == "µm"
    assert np.array_equal(data.owner, sliding.owner)
    assert set(data.coords) == {"x", "y", "mean_pressure", "force"}
    assert data.mean_pressure.dims == ("step",) and data.mean_pressure.attrs["units"] == "GPa"
    assert data.force.dims == ("step",) and data.force.attrs["units"] == "GPa µm²"
    scalars = ("penetration", "contact_fraction", "contact_area", "max_pressure", "elastic_energy", "residual", "converged")
    for name in ("mean_pressure", "force", *scalars):
        assert data[name].values.tolist() == [getattr(step, name) for step in sliding], name
    assert data.penetration.attrs["units"] == "µm" and data.max_pressure.attrs["units"] == "GPa"
    assert data.converged.dtype == bool and "units" not in data.contact_fraction.attrs
    assert data.attrs["title"] == sliding.title and data.attrs["percoat"] == percoat.__version__
    assert np.array_equal(data.attrs["a1"], sliding.a1) and np.array_equal(data.attrs["a2"], sliding.a2)


def test_datasets_of_cases_without_units(three_levels: percoat.Result) -> None:
    pytest.importorskip("xarray")
    data = three_levels.to_xarray()
    # On an oblique cell neither x nor y alone is an axis.
    assert dict(data.sizes) == {"step": 2, "i": 96, "j": 96} and data.pressure.dims == ("step", "i", "j")
    assert data.x.dims == data.y.dims == data.owner.dims == ("i", "j")
    assert np.array_equal(data.x, three_levels.x) and np.array_equal(data.y, three_levels.y)
    assert all("units" not in data[name].attrs for name in (*data.data_vars, *data.coords))
    # Selection by load, as xarray does it.
    chosen = data.swap_dims(step="mean_pressure").sel(mean_pressure=0.05, method="nearest")
    assert np.array_equal(chosen.pressure, three_levels[1].pressure)


def test_datasets_of_one_step(sliding: percoat.Result) -> None:
    pytest.importorskip("xarray")
    whole = sliding.to_xarray()
    for index, step in enumerate(sliding):
        fields = step.to_xarray()
        assert dict(fields.sizes) == {"x": 48, "y": 64} and fields.identical(whole.isel(step=index))


def test_datasets_of_rectangular_cells_have_axes(flat_wave: percoat.Result) -> None:
    xarray = pytest.importorskip("xarray")
    data = flat_wave.to_xarray()
    assert dict(data.sizes) == {"step": 2, "x": 32, "y": 8} and data.pressure.dims == ("step", "x", "y")
    assert data.x.dims == ("x",) and data.y.dims == ("y",) and data.owner.dims == ("x", "y")
    # The axes are those of the arrays: a₁ first.
    assert data.pressure[1].values.tobytes() == flat_wave[1].pressure.tobytes()
    x, y = xarray.broadcast(data.x, data.y)
    assert np.array_equal(x, flat_wave.x) and np.array_equal(y, flat_wave.y)
    ridge = data.pressure.isel(step=1).sel(x=0.1, method="nearest")
    assert float(ridge.x) == flat_wave.x[2, 0] and np.array_equal(ridge, flat_wave[1].pressure[2])
    assert dict(flat_wave[0].to_xarray().sizes) == {"x": 32, "y": 8}


@pytest.mark.parametrize("name", ["flat_wave", "three_levels"])
def test_one_call_draws_datasets_of_any_cell(name: str, request: pytest.FixtureRequest) -> None:
    pytest.importorskip("xarray")
    pyplot = pytest.importorskip("matplotlib.pyplot")
    result = request.getfixturevalue(name)
    figure, ax = pyplot.subplots()
    result.to_xarray().pressure.isel(step=-1).plot(x="x", y="y", ax=ax)
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("x", "y")
    low, high = ax.get_xlim()
    assert low <= result.x.min() and high >= result.x.max() and high - low < 1.1 * np.ptp(result.x) + 0.1
    pyplot.close(figure)


def test_datasets_may_be_written_to(sliding: percoat.Result) -> None:
    pytest.importorskip("xarray")
    data = sliding.to_xarray()
    data["pressure"] += 1.0
    assert sliding[0].pressure.max() == 0.0 and data.pressure[0].min() == 1.0


def test_a_sweep_becomes_a_frame() -> None:
    pandas = pytest.importorskip("pandas")
    values = {"grid.points": 48, "load.mean_pressure": [[0.01, 0.03]], "layers.0.thickness": [0.1, 0.2, 0.4]}
    table = percoat.sweep("fig2", values)
    frame = pandas.DataFrame(table)
    assert frame.shape == (6, len(list(table))) and list(frame.columns) == list(table)
    assert all(
        np.array_equal(frame[name].to_numpy(), table[name], equal_nan=table[name].dtype.kind == "f")
        for name in table
    )
    last = frame[frame.step == 2].set_index("set_layers_0_thickness").penetration
    assert last.loc[0.2] == percoat.solve("fig2", set={"grid.points": 48, "load.mean_pressure": [0.01, 0.03],
                                                       "layers.0.thickness": 0.2})[1].penetration  # fmt: skip
    assert frame.groupby("combination").mean_pressure.max().tolist() == pytest.approx([0.03] * 3)


def test_steps_become_a_frame(sliding: percoat.Result) -> None:
    pandas = pytest.importorskip("pandas")
    frame = pandas.json_normalize(sliding.to_dict()["steps"])
    assert frame["certificate.load"].tolist() == [step.certificate.load for step in sliding]


def test_a_kernel_becomes_a_frame() -> None:
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame(percoat.kernel("fig2", [1.0, 2.0, 4.0]))
    assert frame.shape == (3, 4) and frame.compliance.is_monotonic_decreasing


def test_without_xarray_it_is_asked_for(sliding: percoat.Result, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "xarray", None)
    with pytest.raises(ImportError, match="xarray"):
        sliding.to_xarray()
