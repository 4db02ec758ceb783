"""Surfaces as the libraries of others write them, for the tests: see README.md.

    pip install gwyfile x3pio sdfio surfalize SurfaceTopography rosettasciio rasterio
    python make.py
"""

import warnings
from pathlib import Path

import gwyfile.objects as gwy
import numpy as np
import rasterio
import sdfio
import x3pio
from rsciio.digitalsurf import file_writer
from surfalize import Surface
from SurfaceTopography import Topography

HERE = Path(__file__).parent
NX, NY = 24, 15
# Distances of samples along x and y, m.
DX, DY = 0.5e-6, 0.8e-6
# Samples without a measurement, along x and y.
HOLES = [(3, 2), (3, 3), (17, 11), (0, 14)]


def height(i: int, j: int) -> float:
    """Height at the sample i along x and j along y, y upward, in nanometres."""
    return 20 * i - 35 * j + (7 * i + 11 * j * j) % 13 * 8


def heights(holes: bool = True) -> np.ndarray:
    """Heights[i, j] in metres."""
    z = np.array([[height(i, j) for j in range(NY)] for i in range(NX)]) * 1e-9
    if holes:
        for at in HOLES:
            z[at] = np.nan
    return z


def image(z: np.ndarray) -> np.ndarray:
    """The image, the first line on top."""
    return np.ascontiguousarray(z[:, ::-1].T)


def gwyddion() -> None:
    def field(data: np.ndarray, unit: str) -> gwy.GwyDataField:
        sides = {"xreal": NX * DX, "yreal": NY * DY}
        return gwy.GwyDataField(data, **sides, si_unit_xy=gwy.GwySIUnit(unitstr="m"), si_unit_z=gwy.GwySIUnit(unitstr=unit))

    container = gwy.GwyContainer()
    container["/0/data/title"] = "Phase"
    container["/0/data"] = field(image(heights(False)) * 1e9, "deg")
    container["/1/data/title"] = "Height"
    container["/1/data"] = field(image(heights(False)), "m")
    container["/1/mask"] = field(np.isnan(image(heights())).astype(float), "")
    container.tofile(str(HERE / "one_height.gwy"))
    container["/2/data/title"] = "Height, backward"
    container["/2/data"] = field(image(-heights(False)), "m")
    container.tofile(str(HERE / "two_heights.gwy"))


def x3p() -> None:
    # Lines from below, y upward.
    options = {"x_scale": DX, "y_scale": DY}
    x3pio.write(HERE / "doubles.x3p", heights().T, **options)
    x3pio.write(HERE / "layers.x3p", np.stack([heights().T, -heights().T]), **options)
    x3pio.write(HERE / "text.x3p", heights().T, storage=x3pio.DataStorage.XML, **options)
    x3pio.write(HERE / "shorts.x3p", heights().T, z_type=x3pio.DataType.INT16, z_scale=1e-9, **options)
    Topography(heights(False), (NX * DX, NY * DY), unit="m").to_x3p(HERE / "other.x3p", dtype="F")


def surfaces() -> None:
    surface = Surface(image(heights()) * 1e6, DX * 1e6, DY * 1e6)
    surface.save(HERE / "plain.sur", compressed=False)
    surface.save(HERE / "compressed.sur", compressed=True)


def sdf() -> None:
    # Profiles from below, y upward: sdfio turns those of BCR over.
    for name, revision, kind, scale in [
        ("binary.sdf", "ISO-1.0", sdfio.DataType.BINARY64, 1.0),
        ("text.sdf", "ISO-1.0", sdfio.DataType.BINARY64, 1.0),
        ("iso2.sdf", "ISO-2.0", sdfio.DataType.BINARY32, 1e-9),
        ("iso2_text.sdf", "ISO-2.0", sdfio.DataType.INT16, 1e-9),
        ("bcr.sdf", "BCR-1.0", sdfio.DataType.INT16, 1e-9),
        ("bcr_floats.sdf", "BCR-1.0", sdfio.DataType.BINARY32, 1e-9),
        ("bcr_text.sdf", "BCR-1.0", sdfio.DataType.INT32, 1e-9),
    ]:
        form = sdfio.FileFormat.ASCII if "text" in name else sdfio.FileFormat.BINARY
        metadata = sdfio.Metadata(revision=sdfio.Revision(revision), data_type=kind, create_date=None, mod_date=None)
        sdfio.write(HERE / name, heights().T, x_scale=DX, y_scale=DY, z_scale=scale, format=form, metadata=metadata)


def digital_surf() -> None:
    def axis(name: str, size: int, scale: float, index: int) -> dict:
        return {"name": name, "units": "m", "index_in_array": index, "size": size, "scale": scale, "offset": 0.0, "navigate": False}

    signal = {
        "data": image(heights()) * 1e9,
        "axes": [axis("Y", NY, DY, 0), axis("X", NX, DX, 1)],
        "metadata": {"General": {"title": "", "date": "2026-01-01", "time": "00:00:00"}, "Signal": {"quantity": "Z (nm)"}},
        "original_metadata": {},
    }
    for compressed in [False, True]:
        name = "hyperspy_compressed.sur" if compressed else "hyperspy.sur"
        file_writer(HERE / name, signal, set_comments="off", is_special=True, compressed=compressed)


def esri() -> None:
    # In micrometres.
    data = np.nan_to_num(image(heights()) * 1e6, nan=-9999.0)
    transform = rasterio.transform.from_origin(0.0, NY * DY * 1e6, DX * 1e6, DY * 1e6)
    profile = {"driver": "AAIGrid", "width": NX, "height": NY, "count": 1, "dtype": "float64", "nodata": -9999.0}
    with rasterio.open(HERE / "grid.asc", "w", **profile, transform=transform, force_cellsize=False) as file:
        file.write(data, 1)
    for beside in HERE.glob("grid.*"):
        if beside.suffix != ".asc":
            beside.unlink()


if __name__ == "__main__":
    warnings.simplefilter("ignore")
    gwyddion()
    x3p()
    surfaces()
    sdf()
    digital_surf()
    esri()
