"""Read a stress volume back with VTK itself.

    python read_volume.py FILE.vts  N1 N2 LAYERS  X0 X1 Y0 Y1 Z0 Z1  I J K SIGMA_ZZ

Points along each side, bounds as VTK gives them, and sigma_zz at the point (I, J, K), counted from 0.
Prints one line a check; exit code 1 when one fails.
"""

import sys

from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow
from vtkmodules.vtkIOXML import vtkXMLStructuredGridReader

SCALARS = [
    "sigma_xx", "sigma_yy", "sigma_zz", "sigma_xy", "sigma_xz", "sigma_yz", "tau1", "mises", "sigma1", "material",
]


def close(found, expected):
    return all(abs(a - b) < 1e-11 for a, b in zip(found, expected, strict=True))


def checks(path, dimensions, bounds, index, sigma_zz):
    """Pairs (what is checked, whether it holds)."""
    window = vtkStringOutputWindow()
    vtkOutputWindow.SetInstance(window)
    reader = vtkXMLStructuredGridReader()
    yield "VTK can read the file", reader.CanReadFile(path)
    reader.SetFileName(path)
    reader.Update()
    grid = reader.GetOutput()
    said = window.GetOutput()
    yield f"VTK has nothing to complain of: {said!r}", not said and reader.GetErrorCode() == 0

    extent = [end for n in dimensions for end in (0, n - 1)]
    yield f"extent is {grid.GetExtent()}", list(grid.GetExtent()) == extent
    yield f"bounds are {grid.GetBounds()}", close(grid.GetBounds(), bounds)
    data = grid.GetPointData()
    arrays = {data.GetArrayName(k): data.GetArray(k) for k in range(data.GetNumberOfArrays())}
    yield "arrays are those of the interface", set(arrays) == {*SCALARS, "displacement"}
    for name, array in arrays.items():
        components = 3 if name == "displacement" else 1
        whole = array.GetNumberOfComponents() == components and array.GetNumberOfTuples() == grid.GetNumberOfPoints()
        yield f"{name} has {components} components at every point", whole
    yield "the vectors are the displacements", data.GetVectors().GetName() == "displacement"

    i, j, k = index
    n1, n2, _ = dimensions
    found = arrays["sigma_zz"].GetValue(i + n1 * (j + n2 * k))
    yield f"sigma_zz is {found}", close([found], [sigma_zz])


def main():
    path, *numbers = sys.argv[1:]
    dimensions, index = ([int(n) for n in numbers[a:b]] for a, b in [(0, 3), (9, 12)])
    bounds, sigma_zz = [float(x) for x in numbers[3:9]], float(numbers[12])
    failed = 0
    for what, holds in checks(path, dimensions, bounds, index, sigma_zz):
        print("ok    " if holds else "FAILED", what)
        failed += not holds
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
