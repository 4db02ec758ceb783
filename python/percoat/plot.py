"""Pictures of results, on the axes of Matplotlib: ``pip install "percoat[plot]"``.

Lines mean what they mean in the pictures of the command line: dashed is what results are compared with, interfaces are thin and
solid, bars and bands are estimated errors, and no line leads through points that differ by less than their errors.

Every function draws on ``ax``, or on a new figure, and returns the axes; further arguments go to Matplotlib's
artist.

>>> import percoat.plot
>>> result = percoat.solve("fig2", set={"grid.points": 96})
>>> ax = percoat.plot.pressure(result.steps[0])
>>> ax.figure.savefig("pressure.png", dpi=300)  # doctest: +SKIP
"""

from __future__ import annotations

from typing import Any, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from percoat import _core
from percoat._identify import Identification
from percoat._limit import criterion_name
from percoat._quantities import QUANTITIES, unit_name
from percoat._solve import COMPONENTS, STRAINS, Array, Plane, Result, Section, Step

try:
    import matplotlib.pyplot as plt
    from matplotlib.axes import Axes
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import BoundaryNorm, CenteredNorm, ListedColormap
    from matplotlib.patches import Patch
except ModuleNotFoundError as error:
    raise ImportError('percoat.plot needs Matplotlib: pip install "percoat[plot]"') from error

__all__ = ["contact", "curve", "fit", "plane", "pressure", "section"]

Window = Tuple[float, float, float, float]
Units = Optional[Mapping[str, Optional[str]]]

DRAWN = 400_000
"""Samples drawn in a window, at most: finer than the dots of most pictures, and drawn within a second."""

LABELS = {
    **{name: rf"$\sigma_{{{name}}}$" for name in ("xx", "yy", "zz", "xy", "xz", "yz")},
    **{f"u{axis}": f"$u_{axis}$" for axis in "xyz"},
    "tau1": r"largest shear $\tau_1$",
    "mises": "von Mises' stress",
    "s1": r"largest tension $\sigma_1$",
    **{name: rf"$\varepsilon_{{{name[1:]}}}$" for name in STRAINS[:-1]},
    "ev": r"volumetric strain $\varepsilon_v$",
}

KINDS = {
    **dict.fromkeys(COMPONENTS, "pressure"),
    **dict.fromkeys(STRAINS, "strain"),
    **dict.fromkeys(("ux", "uy", "uz", "additional_displacement"), "length"),
    "value": "pressure",
}
"""Kind of quantity of each component of a field, and of a plain `value`; names that are not here have no unit."""


def pressure(
    step: Step, *, ax: Optional[Axes] = None, window: Optional[Window] = None, **artist: Any
) -> Axes:
    """Draw a map of the contact pressure; blank where nothing touches.

    Parameters
    ----------
    step
        A load step, ``result.steps[i]``.
    ax
        Where to draw; a new figure if it is not said.
    window
        x₀, x₁, y₀, y₁, lengths: the rectangle that is shown, filled with copies of the cell; that of the
        pictures of ``percoat solve`` if it is not said: at least two by two cells around the middle of the unit cell, one
        cell of a topography, and of an isolated contact the rectangle around it, without copies.
    artist
        For :meth:`matplotlib.axes.Axes.pcolormesh`: ``cmap``, ``norm``, ``vmin``, ….

    Examples
    --------
    >>> import percoat.plot
    >>> step = percoat.solve("fig2", set={"grid.points": 96}).steps[0]
    >>> ax = percoat.plot.pressure(step, window=(-1, 1, -1, 1), cmap="magma")
    >>> ax.get_xlabel(), ax.get_ylabel()
    ('x', 'y')
    """
    values = np.ma.masked_equal(step.pressure, 0.0)
    units = step.units
    scale = _scale(values, {"vmin": 0.0, **artist} if "norm" not in artist else artist)
    ax = _map(ax, step, values, scale, units, window, artist)
    return _bar(ax, scale, _label("pressure", "pressure", units))


def contact(step: Step, *, ax: Optional[Axes] = None, window: Optional[Window] = None, **artist: Any) -> Axes:
    """Draw the contact spots in the colours of their levels; those of a topography in one colour.

    Parameters
    ----------
    step, ax, window
        As for :func:`pressure`.
    artist
        For :meth:`matplotlib.axes.Axes.pcolormesh`; ``cmap`` with one colour a level.

    Examples
    --------
    >>> import percoat.plot
    >>> step = percoat.solve("fig2", set={"grid.points": 96}).steps[0]
    >>> ax = percoat.plot.contact(step)
    >>> [text.get_text() for text in ax.get_legend().get_texts()]
    ['level 1', 'level 2', 'level 3']
    """
    owner = step.owner
    levels = max(1, int(owner.max()))
    spots = np.ma.masked_where(step.pressure == 0.0, np.maximum(owner, 1))
    colours = artist.get("cmap", ListedColormap([f"C{level % 10}" for level in range(levels)]))
    scale = ScalarMappable(BoundaryNorm(np.arange(levels + 1) + 0.5, levels), colours)
    ax = _map(ax, step, spots, scale, step.units, window, artist)
    if levels > 1:
        touching = np.unique(spots.compressed())
        keys = [Patch(color=tuple(scale.to_rgba(level)), label=f"level {level}") for level in touching]
        ax.legend(handles=keys, ncol=4, frameon=False, loc="lower left", bbox_to_anchor=(0.0, 1.0))
    return ax


def plane(
    plane: Plane,
    quantity: str = "tau1",
    *,
    ax: Optional[Axes] = None,
    window: Optional[Window] = None,
    units: Units = None,
    **artist: Any,
) -> Axes:
    """Draw a map of a stress or a displacement at one depth, which stands above it.

    Parameters
    ----------
    plane
        From :meth:`percoat.Step.plane`.
    quantity
        One of :data:`percoat.COMPONENTS`, or of :data:`percoat.STRAINS` where the plane has strains. What takes both
        signs has white for zero.
    ax, window, artist
        As for :func:`pressure`.
    units
        ``result.units``, for the labels.

    Examples
    --------
    >>> import percoat.plot
    >>> step = percoat.solve("fig2", set={"grid.points": 96}).steps[0]
    >>> ax = percoat.plot.plane(step.plane(0.5, material=2), "zz")
    >>> ax.get_title()
    'z = 0.5, material 2'
    """
    values = _component(plane, quantity)
    scale = _scale(values, artist)
    ax = _map(ax, plane, values, scale, units, window, artist)
    depth = f"{plane.z:g} {_unit('length', units)}".rstrip()
    ax.set_title(f"z = {depth}, {plane.name or f'material {plane.material}'}", fontsize="medium")
    return _bar(ax, scale, _label(LABELS[quantity], KINDS[quantity], units))


def section(
    section: Section, quantity: str = "tau1", *, ax: Optional[Axes] = None, units: Units = None, **artist: Any
) -> Axes:
    """Draw a vertical cut, z downward; interfaces are lines, across which a field may jump.

    Both axes have one scale; ``ax.set(aspect="auto", ylim=(7.5, 0.0))`` stretches the cut and shows a thin coating alone.

    Parameters
    ----------
    section
        From :meth:`percoat.Step.section`.
    quantity, ax, units, artist
        As for :func:`plane`.

    Examples
    --------
    >>> import percoat.plot
    >>> step = percoat.solve("fig2", set={"grid.points": 96}).steps[0]
    >>> ax = percoat.plot.section(step.section("level 1", "level 2", length=1.0, depth=1.0), "xx")
    >>> [float(line.get_ydata()[0]) for line in ax.lines]
    [0.5]
    """
    ax = _axes(ax)
    values, z, s = _component(section, quantity), section.z, section.s
    scale = _scale(values, artist)
    # Rows are nodes, colours run from one to the next: material by material, none runs across an interface.
    ends = np.flatnonzero(np.diff(section.material)) + 1
    for rows in np.split(np.arange(len(z)), ends):
        if len(rows) > 1:
            ax.pcolormesh(s, z[rows], values[rows], **{"shading": "gouraud", **_shared(scale, artist)})
    for end in ends:
        ax.axhline(z[end], color="0.6", linewidth=1.0)
    ax.set(xlim=(s[0], s[-1]), ylim=(z[-1], z[0]), aspect="equal")
    ax.set(xlabel=_label("s", "length", units), ylabel=_label("z", "length", units))
    return _bar(ax, scale, _label(LABELS[quantity], KINDS[quantity], units))


def curve(
    result: Result,
    x: str = "penetration",
    y: Optional[str] = None,
    *,
    ax: Optional[Axes] = None,
    **artist: Any,
) -> Axes:
    """Draw one number of every load step over another; steps that have not converged are crossed out.

    Bars are the estimated errors of ``y``, where the steps have any. No line leads through points that differ by less
    than their errors.

    Parameters
    ----------
    result
        Whose load steps.
    x, y
        Names of numbers in ``step.to_dict()``, dotted where they lie deeper, ``"certificate.load"``. One that
        leads through a list, ``"levels.load"``, gives a line for each entry, with a legend. ``y`` is the load if it
        is not said: ``"force"`` where the case gives forces, and of an isolated contact, else ``"mean_pressure"``.
    ax
        Where to draw; a new figure if it is not said.
    artist
        For :meth:`matplotlib.axes.Axes.plot`.

    Examples
    --------
    >>> import percoat.plot
    >>> result = percoat.solve("fig2", set={"grid.points": 96, "load.mean_pressure": [0.04, 0.05, 0.06]})
    >>> ax = percoat.plot.curve(result, "mean_pressure", "levels.load")
    >>> ax.get_xlabel(), [line.get_label() for line in ax.lines]
    ('mean pressure', ['level 1', 'level 2', 'level 3'])
    """
    ax = _axes(ax)
    y = result._common.quantity if y is None else y
    (across, entries_x), (up, entries_y) = (_numbers(result, name) for name in (x, y))
    across, up = np.broadcast_arrays(across, up)
    entries = entries_y or entries_x
    errors = np.broadcast_to(_errors(result, y, up.shape), up.shape)
    for abscissas, ordinates, bars, entry in zip(across.T, up.T, errors.T, entries or [""]):
        drawn = {"marker": ".", "label": entry or None, **artist}
        (line,) = ax.plot(*_interrupted(abscissas, ordinates, bars), **drawn)
        if np.any(bars > 0.0):
            ax.errorbar(abscissas, ordinates, np.nan_to_num(bars), fmt="none", ecolor=line.get_color(), elinewidth=0.8)
    failed = np.array([not step.converged for step in result])
    if failed.any():
        ax.plot(across[failed].ravel(), up[failed].ravel(), "x", color="red", zorder=3, label="not converged")
    if entries or failed.any():
        ax.legend()
    labels = []
    for *path, last in (x.split("."), y.split(".")):
        words = path[-1] if path and last == "value" else last
        kind, _ = QUANTITIES.get(".".join([*path, last]), (KINDS.get(last), None))
        labels.append(_label(words.replace("_", " "), kind, result.units))
    ax.set(xlabel=labels[0], ylabel=labels[1])
    if ax.get_xscale() == "linear":
        # Numbers such as 0.0475 stand side by side.
        ax.locator_params(axis="x", nbins=5)
    return ax


def fit(
    found: Identification, *, difference: bool = False, ax: Optional[Axes] = None, **artist: Any
) -> Axes:
    """Draw measured indentation curves with their fit; of unloading the fitted points with their power laws.

    The band is that of two standard errors of the fit, by those of the parameters alone: measured points scatter by their
    own deviations besides, which are their bars where they are known.

    Parameters
    ----------
    found
        From :func:`percoat.identify`.
    difference
        Measured less fitted penetrations instead of the penetrations.
    ax
        Where to draw; a new figure if it is not said.
    artist
        For :meth:`matplotlib.axes.Axes.errorbar`, by which the measured points are drawn.

    Examples
    --------
    >>> import numpy as np, percoat.plot
    >>> case = percoat.case("ball-on-disc", set={"grid.points": 64, "load.force": [1e3, 2e3, 5e3]})
    >>> curve = [(step.force, step.penetration) for step in percoat.solve(case)]
    >>> found = percoat.identify(case, np.array(curve), ["substrate.young"])
    >>> percoat.plot.fit(found).get_ylabel()
    'penetration (µm)'
    """
    ax = _axes(ax)
    for curve in np.unique(found.curve):
        of_curve = np.flatnonzero(found.curve == curve)
        order = of_curve[np.argsort(found.force[of_curve])]
        force, below = found.force[order], found.fitted[order] if difference else 0.0
        fitted, band = found.fitted[order] - below, 2.0 * found.fitted_error[order]
        bars = None if found.penetration_error is None else found.penetration_error[order]
        first = curve == found.curve[0]
        points = {"fmt": ".", "color": "C0", "label": "measured" if first else None, **artist}
        ax.errorbar(force, found.penetration[order] - below, bars, **points)
        (line,) = ax.plot(force, fitted, color="C1", label="fit" if first else None)
        ax.fill_between(force, fitted - band, fitted + band, color=line.get_color(), alpha=0.3, linewidth=0.0)
    ax.legend()
    name = "measured − fit" if difference else "penetration"
    ax.set(xlabel=_label("force", "force", found.units), ylabel=_label(name, "length", found.units))
    return ax


def _numbers(result: Result, name: str) -> tuple[Array, Optional[list[str]]]:
    """Values of a dotted name, (steps, lines), and the lines' names where it leads through a list."""
    entries: Optional[list[str]] = None

    def read(value: Any, words: Sequence[str], before: str) -> list[float]:
        nonlocal entries
        if isinstance(value, list) and words:
            entries = [_entry(entry, before, number) for number, entry in enumerate(value, 1)]
            return [number for entry in value for number in read(entry, words, "")]
        if value is None:
            return [np.nan]
        if words:
            return read(getattr(value, words[0]), words[1:], words[0])
        if not isinstance(value, (int, float)):
            raise ValueError(f"{name!r} is no number of a step")
        return [float(value)]

    return np.array([read(step, name.split("."), "") for step in result.summary.steps]), entries


def _entry(entry: Any, list_: str, number: int) -> str:
    """Name of an entry of a list: a criterion by its name and what it is of, one of ``levels`` level 1, …"""
    if "criterion" not in entry:
        return f"{list_[:-1]} {number}"
    return criterion_name(entry)


def _errors(result: Result, name: str, shape: tuple[int, ...]) -> Array:
    """Errors of what a dotted name stands for, NaN where none are known."""
    _, error = QUANTITIES.get(name, (None, None))
    if error is None:
        return np.full(shape, np.nan)
    try:
        return _numbers(result, error)[0]
    except AttributeError:
        # A step whose quantity does not apply has no error of it.
        return np.full(shape, np.nan)


def _interrupted(across: Array, up: Array, errors: Array) -> tuple[Array, Array]:
    """Points with gaps where a line would lead through noise, as in the charts of the command line.

    A stretch on which the values rise, or fall, has a line only if they do so by more than its largest error. A constant is no
    noise, and errors too small to see are none.
    """
    known = np.nan_to_num(errors)
    reach = np.concatenate([up - known, up + known, [np.nan]])
    span = 0.0 if np.isnan(reach).all() else float(np.nanmax(reach) - np.nanmin(reach))
    seen = known > 0.006 * span
    gaps: list[int] = []
    first = 0
    while first < len(up) - 1:
        last = first + 1
        way = up[last] - up[first]
        while last < len(up) - 1 and (up[last + 1] - up[last]) * way >= 0.0:
            way = way or up[last + 1] - up[last]
            last += 1
        change = abs(up[last] - up[first])
        if 0.0 < change <= known[first : last + 1].max():
            gaps += [after for after in range(first + 1, last + 1) if seen[after] or seen[after - 1]]
        first = last
    return np.insert(across, gaps, np.nan), np.insert(up, gaps, np.nan)


def _component(record: Union[Plane, Section], quantity: str) -> Array:
    known = [name for name in COMPONENTS + STRAINS if name in record]
    if quantity not in known:
        asked = "; strains stand in it with strain=True" if quantity in STRAINS else ""
        raise ValueError(f"no quantity {quantity!r}; there are {', '.join(known)}{asked}")
    return np.asarray(record[quantity])


def _unit(kind: Optional[str], units: Units) -> str:
    """Name of the unit of a kind of quantity; empty where it has none."""
    return unit_name(kind, (units or {}).get("length"), (units or {}).get("pressure")) or ""


def _label(words: str, kind: Optional[str], units: Units) -> str:
    unit = _unit(kind, units)
    return f"{words} ({unit})" if unit else words


def _axes(ax: Optional[Axes]) -> Axes:
    return plt.subplots(layout="constrained")[1] if ax is None else ax


def _scale(values: Array, artist: Mapping[str, Any]) -> ScalarMappable:
    """One scale of colours for every copy of the cell and every material."""
    signed = bool(np.any(values < 0.0) and np.any(values > 0.0))
    norm = artist.get("norm", CenteredNorm() if signed and not {"vmin", "vmax"} & set(artist) else None)
    scale = ScalarMappable(norm, artist.get("cmap", "RdBu_r" if signed else "viridis"))
    scale.set_clim(artist.get("vmin"), artist.get("vmax"))
    scale.set_array(values if np.ma.count(values) else np.array([1.0]))
    scale.autoscale_None()
    return scale


def _shared(scale: ScalarMappable, artist: Mapping[str, Any]) -> dict[str, Any]:
    """Arguments of each mesh, which is pixels in PDF and SVG files too: these have no seams then and are small."""
    rest = {name: value for name, value in artist.items() if name not in ("vmin", "vmax")}
    return {"rasterized": True, **rest, "norm": scale.norm, "cmap": scale.cmap}


def _bar(ax: Axes, scale: ScalarMappable, label: str) -> Axes:
    """A colour bar as high as the map, whatever its aspect."""
    ax.figure.colorbar(scale, cax=ax.inset_axes((1.03, 0.0, 0.05, 1.0)), label=label)
    return ax


def _map(
    ax: Optional[Axes],
    places: Union[Step, Plane],
    values: NDArray[Any],
    scale: ScalarMappable,
    units: Units,
    window: Optional[Window],
    artist: Mapping[str, Any],
) -> Axes:
    """Fill the window with copies of the cell; a sample (i, j) is the middle of a parallelogram.

    The window is that of the pictures of the command line if it is not said. An isolated contact is drawn once.
    """
    ax = _axes(ax)
    n = np.array(values.shape)
    origin = np.array([places.x[0, 0], places.y[0, 0]])
    spacings = [(c[1, 0] - c[0, 0], c[0, 1] - c[0, 0]) for c in (places.x, places.y)]
    cell = n * np.array(spacings)  # its columns are a₁, a₂
    if window is None:
        has_levels = not isinstance(places, Step) or bool(places.owner.any())
        seen = ~np.ma.getmaskarray(values) & np.ma.isMaskedArray(values)
        window = _core.window(cell.T.tolist(), places.isolated, has_levels, seen)
    x0, x1, y0, y1 = window
    # A large grid is thinned to DRAWN. Samples are left out, never averaged: the edge of a contact stays
    # sharp, and is off by less than one of the parallelograms drawn.
    shown = n.prod() * (x1 - x0) * (y1 - y0) / abs(np.linalg.det(cell))
    m = np.ceil(n * min(1.0, np.sqrt(DRAWN / shown))).astype(int)
    values = values[np.ix_(*(np.rint(np.arange(of) * whole / of).astype(int) for of, whole in zip(m, n)))]

    fractions = np.meshgrid(*((np.arange(of + 1) - 0.5) / of for of in m), indexing="ij")
    corners = np.tensordot(cell, fractions, axes=1)
    reach = np.abs(cell) @ (1.0 / m)  # of a parallelogram, along x and y
    centre, half = np.array([x0 + x1, y0 + y1]) / 2, np.array([x1 - x0, y1 - y0]) / 2 + reach
    ends = np.linalg.solve(cell, np.array([[x0, x0, x1, x1], [y0, y1, y0, y1]]) - origin[:, None])
    first, last = np.floor(ends.min(axis=1)).astype(int), np.floor(ends.max(axis=1) + 0.5 / m).astype(int)
    if places.isolated:
        first, last = np.zeros((2, 2), dtype=int)
    for copy in np.ndindex(*(last - first + 1)):
        x, y = corners + (origin + cell @ (first + copy))[:, None, None]
        visible = (np.abs(x - centre[0]) <= half[0]) & (np.abs(y - centre[1]) <= half[1])
        rows, columns = (np.flatnonzero(visible.any(axis=axis)) for axis in (1, 0))
        if len(rows) > 1 and len(columns) > 1:
            between = np.s_[rows[0] : rows[-1], columns[0] : columns[-1]]
            around = np.s_[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]
            ax.pcolormesh(x[around], y[around], values[between], **_shared(scale, artist))
    ax.set(xlim=(x0, x1), ylim=(y0, y1), aspect="equal")
    ax.set(xlabel=_label("x", "length", units), ylabel=_label("y", "length", units))
    return ax
