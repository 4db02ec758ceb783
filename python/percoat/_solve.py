"""Solving a case: results, steps, and what is inside the body."""

from __future__ import annotations

import io
import shutil
from functools import cached_property
from os import PathLike
from typing import TYPE_CHECKING, Any, Callable, Iterator, Literal, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from percoat import _core, _html
from percoat._case import CaseLike, Settings
from percoat._quantities import QUANTITIES, unit_name
from percoat._record import Record
from percoat._warnings import warn, warn_of

if TYPE_CHECKING:
    import xarray

Array = NDArray[np.float64]
Body = Literal["body", "counterbody"]
Listener = Union[None, bool, Callable[["_core.Progress"], object]]

COMPONENTS = ("xx", "yy", "zz", "xy", "xz", "yz", "ux", "uy", "uz", "tau1", "mises", "s1")
"""Stresses σ_xx … σ_yz, displacements u_x, u_y, u_z, largest shear τ₁, von Mises' stress and the largest tension σ₁."""

STRAINS = ("exx", "eyy", "ezz", "exy", "exz", "eyz", "e1", "e2", "e3", "ev")
"""Strains ε_xx … ε_yz (half the shear angles), principal strains ε₁ ≥ ε₂ ≥ ε₃ and the volumetric strain."""


class Level(Record):
    """Readings of the contact of one level; ``load`` and areas are those of one indenter."""

    level: int
    load: float
    load_share: float
    max_pressure: Optional[float]
    contact_area: float
    contact_radius: Optional[float]
    radius_min: Optional[float]
    radius_max: Optional[float]
    asymmetry: Optional[float]
    centre: list[Optional[float]]
    errors: Record


class Field(Record):
    """Arrays under the names of :data:`COMPONENTS`, and where strains were asked for under those of :data:`STRAINS`."""

    xx: Array
    yy: Array
    zz: Array
    xy: Array
    xz: Array
    yz: Array
    ux: Array
    uy: Array
    uz: Array
    tau1: Array
    mises: Array
    s1: Array
    exx: Array
    eyy: Array
    ezz: Array
    exy: Array
    exz: Array
    eyz: Array
    e1: Array
    e2: Array
    e3: Array
    ev: Array


class Plane(Field):
    """Stresses and displacements on a plane: arrays (n₁, n₂) under the names of :data:`COMPONENTS`, at ``x`` and ``y``.

    Examples
    --------
    >>> import percoat
    >>> percoat.solve("fig2", set={"grid.points": 96})[0].plane(0.1)
    <percoat.Plane: 96 × 96 points at z = 0.1, in material 1>
    """

    x: Array
    y: Array
    z: float
    material: int
    name: Optional[str]
    """Name of the material, where the case gives one."""
    isolated: bool
    """Whether it lies in the window of an isolated contact, beside which nothing repeats it."""

    def __repr__(self) -> str:
        n1, n2 = self.xx.shape
        return f"<percoat.Plane: {n1} × {n2} points at z = {self.z}, in {self.name or f'material {self.material}'}>"


class Section(Field):
    """Stresses and displacements on a vertical cut: arrays (rows, points) under the names of :data:`COMPONENTS`.

    ``s`` is the distance along the cut, ``x`` and ``y`` its points; ``z`` and ``material`` those of the rows. A depth on
    an interface has two rows, one for each side.
    """

    s: Array
    x: Array
    y: Array
    z: Array
    material: NDArray[np.int32]

    def __repr__(self) -> str:
        rows, points = self.xx.shape
        return f"<percoat.Section: {rows} rows × {points} points, s = {self.s[0]:g} … {self.s[-1]:g}>"


class Common:
    """The case, its cell and samples, and the head of the summary, shared by the steps of a result."""

    def __init__(
        self,
        case: _core.Case,
        summary: dict[str, Any],
        accurate: bool,
        places: tuple[Array, Array, NDArray[np.int32]],
    ) -> None:
        self.case, self.summary, self.accurate = case, Record(summary), accurate
        self.x, self.y, self.owner = places
        self.a1, self.a2 = map(np.array, case.cell)
        self.units: Record = self.summary.units
        as_run = self.summary.case
        self.isolated: bool = as_run.get("lattice", {}).get("kind") == "isolated"
        self.quantity = "force" if self.isolated or "force" in as_run.load else "mean_pressure"
        for array in (*places, self.a1, self.a2):
            array.flags.writeable = False

    def places(self, n1: int, n2: int) -> tuple[Array, Array]:
        """x and y of so many points along a₁ and a₂."""
        if (n1, n2) == self.x.shape:
            return self.x, self.y
        u, v = np.meshgrid(np.arange(n1) / n1, np.arange(n2) / n2, indexing="ij")
        x, y = (u * self.a1[axis] + v * self.a2[axis] for axis in (0, 1))
        # The middle of a window is the origin.
        return x + self.x[0, 0], y + self.y[0, 0]

    def __reduce__(self) -> tuple[Any, ...]:
        return Common, (self.case, self.summary.to_dict(), self.accurate, (self.x, self.y, self.owner))


class Sampled:
    """Places of the samples and names of the units, those of a result and of each of its steps."""

    _common: Common

    @property
    def x(self) -> Array:
        """Places of the samples (n₁, n₂), a length."""
        return self._common.x

    @property
    def y(self) -> Array:
        """Places of the samples (n₁, n₂), a length."""
        return self._common.y

    @property
    def owner(self) -> NDArray[np.int32]:
        """The level whose indenter faces the sample (n₁, n₂), from 1; 0 for a topography."""
        return self._common.owner

    @property
    def units(self) -> Record:
        """Names of the units of ``length`` and ``pressure``, ``None`` where they have none."""
        return self._common.units


class Step(Sampled):
    """A solved load step: everything that ``summary.json`` has of it is an attribute, and so are its fields.

    Attributes
    ----------
    pressure, gap, displacement
        Arrays (n₁, n₂), axes along a₁ and a₂; a pressure ≥ 0, and lengths. They cannot be written to, and none is a copy:
        take ``step.pressure.copy()`` to change one.
    x, y, owner, units
        Those of the :class:`Result`.
    mean_pressure, force, penetration, contact_fraction, contact_area, max_pressure, levels, certificate, converged, …
        As in ``summary.json``; ``levels``, ``certificate`` and the like have attributes in turn. An isolated contact has a
        force, an area and a ``contact_stiffness`` ∂P/∂δ, no mean pressure and no fraction in contact: they are ``None``. ``stress`` is what
        :meth:`maxima` returns.

    Examples
    --------
    >>> import percoat
    >>> step = percoat.solve("fig2", set={"grid.points": 96}).steps[-1]
    >>> step.pressure.shape, step.levels[0].level, step.converged
    ((96, 96), 1, True)
    >>> bool(abs(step.pressure.mean() - 0.06) < 1e-14)
    True
    >>> stress = step.stress([[0.0, 0.0, 0.1], [0.0, 0.0, 0.2]])  # xx, yy, zz, xy, xz, yz
    >>> stress.shape
    (2, 6)
    """

    mean_pressure: Optional[float]
    force: float
    penetration: float
    additional_displacement: float
    contact_area: float
    contact_fraction: Optional[float]
    elastic_energy: float
    max_pressure: Optional[float]
    converged: bool
    stop_reason: str
    iterations: int
    convolutions: float
    residual: float
    certificate: Record
    points: list[int]
    levels: list[Level]
    errors: Record
    seconds: float

    def __init__(self, common: Common, index: int, record: Record, core: Union[_core.Step, bytes]) -> None:
        # Not the result: it has its steps, and what goes around in a circle is not gone when nobody has it.
        self._common = common
        self._index = index
        self._record = record
        self._kept = core

    @property
    def _core(self) -> _core.Step:
        kept = self._kept
        if isinstance(kept, bytes):
            kept = self._kept = _core.step(self._common.case, self._index, self._record.points, kept)
        return kept

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        return getattr(self._record, name)

    def __setattr__(self, name: str, value: Any) -> None:
        if not name.startswith("_"):
            raise AttributeError(f"a step is what was solved: {name!r} cannot be set")
        super().__setattr__(name, value)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._record]

    @property
    def isolated(self) -> bool:
        """Whether it is an isolated contact in a window, beside which nothing repeats it."""
        return self._common.isolated

    @cached_property
    def pressure(self) -> Array:
        """Contact pressure p ≥ 0 (n₁, n₂), in the unit of Young's modulus."""
        return self._core.pressure

    @cached_property
    def gap(self) -> Array:
        """Gap between body and counterbody (n₁, n₂), a length; 0 in contact, within the tolerance."""
        return self._core.gap

    @cached_property
    def displacement(self) -> Array:
        """Displacement of the surface into the body (n₁, n₂), a length.

        Over a cell its mean is zero; around an isolated contact it is zero far away.
        """
        displacement = self._core.displacement()
        displacement.flags.writeable = False
        return displacement

    @cached_property
    def tension(self) -> Optional[Array]:
        """Tension between the surfaces ≥ 0 (n₁, n₂), in the unit of Young's modulus; None of surfaces that do not adhere.

        What acts on the bodies is the pressure of contact less the tension.
        """
        tension = self._core.tension()
        if tension is not None:
            tension.flags.writeable = False
        return tension

    @cached_property
    def surface_temperature(self) -> Optional[Array]:
        """Temperature of the body's surface by frictional heat (n₁, n₂): its bulk temperature and what differs from the mean of the surface.

        None where nothing heats.
        """
        temperature = self._core.surface_temperature()
        if temperature is not None:
            temperature.flags.writeable = False
        return temperature

    @cached_property
    def _shear(self) -> Optional[tuple[Array, Array, Array]]:
        shear = self._core.shear()
        for field in shear or ():
            field.flags.writeable = False
        return shear

    @property
    def traction(self) -> Optional[Array]:
        """Tangential traction on the body, x and y (2, n₁, n₂), of a contact that sticks and slips; None of another."""
        return self._shear[0] if self._shear else None

    @property
    def slip(self) -> Optional[Array]:
        """Slip of the counterbody against the body in the step, x and y (2, n₁, n₂), a length; None where nothing sticks."""
        return self._shear[1] if self._shear else None

    @property
    def slip_work(self) -> Optional[Array]:
        """Energy per area (n₁, n₂) that slip has dissipated in the step; None where nothing sticks."""
        return self._shear[2] if self._shear else None

    def stress(
        self, points: ArrayLike, *, material: Optional[int] = None, body: Body = "body"
    ) -> Array:
        """Stresses at points inside one of the bodies, by the sum over waves itself.

        Parameters
        ----------
        points
            (…, 3): x, y, z, lengths; z ≥ 0 grows into the body.
        material
            Of the two that meet at an interface, from 1; else the one nearer to the surface.
        body
            ``"counterbody"`` for an elastic one; x and y are those of the body, z grows into it.

        Returns
        -------
        array (…, 6)
            σ_xx, σ_yy, σ_zz, σ_xy, σ_xz, σ_yz, positive in tension; :func:`percoat.tau1`, :func:`percoat.mises` and
            :func:`percoat.s1` take it.

        Examples
        --------
        >>> import numpy as np, percoat
        >>> step = percoat.solve("fig2", set={"grid.points": 96}).steps[0]
        >>> z = np.linspace(0.0, 1.0, 11)
        >>> stress = step.stress(np.stack([0 * z, 0 * z, z], axis=-1))
        >>> percoat.mises(stress).shape
        (11,)
        """
        return self._at_points(points, material, body, strain=False)

    def strain(
        self, points: ArrayLike, *, material: Optional[int] = None, body: Body = "body"
    ) -> Array:
        """Strains at points inside one of the bodies, those of :meth:`stress` by Hooke's law.

        Residual stresses count as they do there: strains are measured from the state without stress.

        Parameters
        ----------
        points, material, body
            As of :meth:`stress`.

        Returns
        -------
        array (…, 6)
            ε_xx, ε_yy, ε_zz, ε_xy, ε_xz, ε_yz, positive in extension; the last three are half the shear angles. The
            eigenvalues that :func:`percoat.principal` gives are the principal strains.

        Examples
        --------
        >>> import percoat
        >>> step = percoat.solve("fig2", set={"grid.points": 96}).steps[0]
        >>> strain = step.strain([0.0, 0.0, 0.5], material=2)
        >>> bool(strain[2] < 0.0)
        True
        """
        return self._at_points(points, material, body, strain=True)

    def _at_points(self, points: ArrayLike, material: Optional[int], body: Body, strain: bool) -> Array:
        """Six components (…, 6) at points (…, 3)."""
        array = np.asarray(points, dtype=float)
        if array.ndim == 0 or array.shape[-1] != 3:
            raise _core.CaseError(f"points have three coordinates x, y, z along their last axis, not {array.shape}")
        flat = np.ascontiguousarray(array.reshape(-1, 3))
        return self._core.at_points(flat, material, body, strain).reshape(*array.shape[:-1], 6)

    def plane(
        self,
        z: float,
        *,
        points: Union[None, int, Sequence[int]] = None,
        material: Optional[int] = None,
        body: Body = "body",
        strain: bool = False,
    ) -> Plane:
        """Stresses and displacements on the horizontal plane at the depth z.

        Parameters
        ----------
        z
            Depth ≥ 0, a length.
        points
            Along a₁ and a₂; those of the contact if it is not said.
        material
            Of the two that meet at an interface, from 1; else the one nearer to the surface.
        body
            ``"counterbody"`` for an elastic one; z grows into it.
        strain
            Whether it has strains too, under the names of :data:`percoat.STRAINS`.

        Examples
        --------
        >>> import percoat
        >>> step = percoat.solve("fig2", set={"grid.points": 96}).steps[0]
        >>> step.plane(0.5, material=2).tau1.shape
        (96, 96)
        """
        wanted = [points, points] if isinstance(points, (int, np.integer)) else points
        counts = None if wanted is None else list(wanted)
        components, material, name = self._core.plane(z, counts, material, body, strain)
        x, y = self._common.places(*components.shape[1:])
        place = {"x": x, "y": y, "z": float(z), "material": material, "name": name, "isolated": self.isolated}
        return Plane({**place, **dict(zip(COMPONENTS + STRAINS, components))})

    def section(
        self,
        start: Union[None, str, Sequence[float]] = None,
        toward: Union[None, str, Sequence[float]] = None,
        *,
        length: Optional[float] = None,
        depth: Optional[float] = None,
        behind: Optional[float] = None,
        body: Body = "body",
        strain: bool = False,
    ) -> Section:
        """Stresses and displacements on a vertical cut; without arguments, on that of the case.

        On the surface and just below it stresses are sharp at the edge of contact, where the sum over waves that
        :meth:`plane` and :meth:`stress` give overshoots.

        Parameters
        ----------
        start
            Where s = 0: ``"level 1"``, an indenter of that level, or a place (x, y).
        toward
            ``"level 2"``, the nearest other indenter of that level, or a direction (x, y).
        length, depth
            How long and how deep it is, lengths; that of a₁ and half of it if they are not said.
        behind
            How much of the length lies before ``start``.
        body
            ``"counterbody"`` for an elastic one; z grows into it.
        strain
            Whether it has strains too, under the names of :data:`percoat.STRAINS`.

        Examples
        --------
        >>> import percoat
        >>> step = percoat.solve("fig2", set={"grid.points": 96}).steps[0]
        >>> step.section("level 1", "level 2", length=1.0, depth=1.0)
        <percoat.Section: 202 rows × 401 points, s = 0 … 1>
        """
        cut = None
        if not (start is None and toward is None and length is None and depth is None and behind is None):
            period = float(np.hypot(*self._common.a1))
            cut = {
                "from": "level 1" if start is None else start,
                "toward": toward,
                "length": period if length is None else length,
                "depth": 0.5 * period if depth is None else depth,
                "behind": behind,
            }
        (s, x, y, z), material, components = self._core.section(cut, body, strain)
        place = {"s": s, "x": x, "y": y, "z": z, "material": material}
        return Section({**place, **dict(zip(COMPONENTS + STRAINS, components))})

    def maxima(self) -> Optional[Record]:
        """The largest stresses over each material, on each face and interface, with their places and errors.

        As ``stress`` in ``summary.json``, with the largest strains where the case has ``stress.strain = true``; ``None``
        without contact.

        Examples
        --------
        >>> import percoat
        >>> step = percoat.solve("fig2", set={"grid.points": 96}).steps[0]
        >>> step.maxima().max_tau1.material
        1
        """
        if "stress" in self._record:
            asked: Record = self._record.stress
            return asked
        found = self._core.maxima()
        return None if found is None else Record(found)

    def to_dict(self) -> dict[str, Any]:
        """Every scalar, as ``summary.json`` has it."""
        return self._record.to_dict()

    def to_xarray(self) -> xarray.Dataset:
        """Fields and scalars as an :class:`xarray.Dataset`, with the dimensions of :meth:`Result.to_xarray` but ``step``."""
        alone: xarray.Dataset = Result(self._common, [self]).to_xarray().isel(step=0)
        return alone

    def _bytes(self) -> bytes:
        """The checkpoint of which the step is made again."""
        kept = self._kept
        return kept if isinstance(kept, bytes) else kept.checkpoint()

    def __reduce__(self) -> tuple[Any, ...]:
        return _step, (self._common, self._index, self.to_dict(), self._bytes())

    def __repr__(self) -> str:
        n1, n2 = self.points
        quantity = self._common.quantity
        load = f"{quantity.replace('_', ' ')} {self._record[quantity]:.5g}"
        fraction = self.contact_fraction
        contact = f"contact area {self.contact_area:.5g}" if fraction is None else f"contact {100 * fraction:.3g} %"
        return (
            f"<percoat.Step: {load}, penetration {self.penetration:.5g}, {contact}, "
            f"{n1} × {n2} samples, {self.stop_reason}>"
        )

    def __str__(self) -> str:
        return str(Result(self._common, [self]))

    def _repr_html_(self) -> str:
        first, *_ = _core.outcome_tables(self._common.case, Result(self._common, [self]).to_dict())
        return _html.page("", [first])


class Result(Sampled):
    """Every load step of a case, solved. It prints the table of the command line.

    Attributes
    ----------
    steps
        The load steps, in their order; ``result[0]`` and ``for step in result`` work as well.
    x, y
        Places of the samples (n₁, n₂), lengths.
    a1, a2
        Vectors of the cell (2,), lengths.
    owner
        The level whose indenter faces the sample (n₁, n₂), from 1; 0 for a topography.
    units
        Names of the units of ``length`` and ``pressure``, ``None`` where they have none.
    summary
        All scalars, as ``summary.json`` has them.
    warnings
        What a reader should know before trusting the numbers.
    converged
        Whether all steps are, and the accuracy is reached, if one was prescribed.

    Examples
    --------
    >>> import percoat
    >>> result = percoat.solve("fig2", set={"grid.points": 96, "load.mean_pressure": [0.03, 0.06]})
    >>> result
    <percoat.Result 'Fig. 2: relatively hard coating, three levels in contact': 2 steps, 96 × 96 samples, converged>
    >>> [round(step.mean_pressure, 12) for step in result]
    [0.03, 0.06]
    >>> print(result)  # doctest: +ELLIPSIS
    Fig. 2: relatively hard coating, three levels in contact
    ...
    """

    steps: list[Step]

    def __init__(self, common: Common, steps: Sequence[Step]) -> None:
        self._common = common
        self.steps = list(steps)

    @property
    def summary(self) -> Record:
        """All scalars, as ``summary.json`` has them."""
        head = self._common.summary
        entries = {name: head[name] for name in head if name != "timing"}
        return Record({**entries, "steps": [step._record for step in self.steps], "timing": head.timing})

    @property
    def a1(self) -> Array:
        """Vector of the cell (2,), a length."""
        return self._common.a1

    @property
    def a2(self) -> Array:
        """Vector of the cell (2,), a length."""
        return self._common.a2

    @property
    def title(self) -> str:
        """Title of the case."""
        return str(self._common.summary.title)

    @property
    def case(self) -> dict[str, Any]:
        """The case as run, complete with defaults."""
        return self._common.case.as_dict()

    @property
    def warnings(self) -> list[str]:
        """What a reader should know before trusting the numbers."""
        doubts: list[str] = self._common.summary.warnings
        return doubts

    @property
    def accuracy(self) -> Optional[float]:
        """Change from the next coarser grid, where an accuracy was prescribed."""
        return self._common.summary.get("accuracy")

    @property
    def converged(self) -> bool:
        """Whether all steps are, and the accuracy is reached, if one was prescribed."""
        return self._common.accurate and all(step.converged for step in self.steps)

    def __len__(self) -> int:
        return len(self.steps)

    def __getitem__(self, index: Any) -> Any:
        return self.steps[index]

    def __iter__(self) -> Iterator[Step]:
        return iter(self.steps)

    def to_dict(self) -> dict[str, Any]:
        """All scalars as plain dicts and lists, as ``summary.json`` has them."""
        return self.summary.to_dict()

    def to_xarray(self) -> xarray.Dataset:
        """Fields and scalars as an :class:`xarray.Dataset`.

        On a rectangular cell, a₁ along x and a₂ along y, the dimensions are ``step``, ``x`` and ``y``, with the places of the
        samples as their coordinates. On any other cell they are ``step`` and ``i``, ``j`` along a₁, a₂, with coordinates ``x``,
        ``y`` (i, j). In both, axes are those of :attr:`Step.pressure`, and ``mean_pressure`` and ``force`` are coordinates of
        the steps. ``data.pressure.isel(step=0).plot(x="x", y="y")`` draws both. An isolated contact has no
        ``mean_pressure`` and no ``contact_fraction``, but a ``contact_stiffness``.

        Examples
        --------
        >>> import percoat, pytest
        >>> _ = pytest.importorskip("xarray")
        >>> data = percoat.solve("fig2", set={"grid.points": 96}).to_xarray()
        >>> dict(data.pressure.sizes)
        {'step': 1, 'i': 96, 'j': 96}
        >>> square = percoat.solve("rough", set={"grid.points": 32}).to_xarray()
        >>> dict(square.pressure.isel(step=0).sizes), square.x.dims
        ({'x': 32, 'y': 32}, ('x',))
        """
        import xarray

        def attributes_of(kind: str) -> dict[str, str]:
            unit = unit_name(kind, self.units.length, self.units.pressure)
            return {"units": unit} if unit else {}

        def applies(name: str) -> bool:
            # Under a tip the peak pressure is infinite, and null.
            return name == "max_pressure" or any(step._record.get(name) is not None for step in self.steps)

        length, pressure = attributes_of("length"), attributes_of("pressure")
        quantities = {name: kind for name, (kind, _) in QUANTITIES.items() if "." not in name and applies(name)}
        scalars = {name: attributes_of(kind) for name, kind in quantities.items()}
        loads = {name: scalars.pop(name) for name in ("mean_pressure", "force") if name in scalars}
        scalars.update(converged={}, residual={})
        fields = {"pressure": pressure, "displacement": length, "gap": length}
        x, y = self.x, self.y
        rectangular = bool(np.all(x == x[:, :1]) and np.all(y == y[:1]))
        i, j = ("x", "y") if rectangular else ("i", "j")
        data: dict[str, Any] = {
            name: (("step", i, j), np.stack([getattr(step, name) for step in self.steps]), attributes)
            for name, attributes in fields.items()
        }
        for name, attributes in scalars.items():
            values = [step._record.get(name) for step in self.steps]
            data[name] = ("step", np.array([np.nan if value is None else value for value in values]), attributes)
        data["owner"] = ((i, j), self.owner)
        coordinates = {
            "x": (i, x[:, 0], length) if rectangular else ((i, j), x, length),
            "y": (j, y[0], length) if rectangular else ((i, j), y, length),
            **{
                name: ("step", np.array([step._record[name] for step in self.steps]), attributes)
                for name, attributes in loads.items()
            },
        }
        attributes = {"title": self.title, "percoat": self._common.summary.percoat, "a1": self.a1, "a2": self.a2}
        return xarray.Dataset(data, coordinates, attributes)

    def save(self, folder: Union[str, PathLike[str]]) -> None:
        """Write the output folder of ``percoat solve --no-pictures``: ``summary.json``, ``contact.npz``, ``curve.csv``, ``case.toml``, …

        As on the command line only files are replaced that percoat wrote there as a finished result, and only by a complete
        one. ``percoat report folder`` makes a page of it, and ``percoat solve folder/case.toml`` solves it again; heights that
        are an array of the case become ``heights.npy`` beside it, and those of a file that was pickled with the result
        ``heights`` with the ending of the file; a file of ``load.pressure`` becomes ``pressure``. Other files are named
        by their absolute paths.

        Raises
        ------
        CaseError
            The folder holds a file of somebody else that would be replaced, or another run writes into it.
        OSError
            A file cannot be written.

        Examples
        --------
        >>> import os, percoat, tempfile
        >>> result = percoat.solve("fig2", set={"grid.points": 96})
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     result.save(folder)
        ...     sorted(name for name in os.listdir(folder) if not name.startswith("."))
        ['case.toml', 'contact.npz', 'curve.csv', 'summary.json']
        """
        array, case = None, self._common.case
        heights = case.as_dict().get("surface", {}).get("heights")
        if isinstance(heights, np.ndarray):
            file = io.BytesIO()
            np.save(file, heights)
            array = file.getvalue()
        aside(_core.save_result(case, self.to_dict(), [step._core for step in self.steps], folder, array))

    def __reduce__(self) -> tuple[Any, ...]:
        kept = [(step._index, step.to_dict(), step._bytes()) for step in self.steps]
        return _result, (self._common, kept)

    def __repr__(self) -> str:
        count = f"{len(self)} step" + ("" if len(self) == 1 else "s")
        n1, n2 = self.x.shape
        state = "converged" if self.converged else "not converged"
        return f"<percoat.Result {self.title!r}: {count}, {n1} × {n2} samples, {state}>"

    def __str__(self) -> str:
        width = shutil.get_terminal_size().columns
        return _core.outcome_text(self._common.case, self.to_dict(), width).rstrip()

    def _repr_html_(self) -> str:
        return _html.page(self.title, _core.outcome_tables(self._common.case, self.to_dict()))


def _step(common: Common, index: int, entries: dict[str, Any], core: Union[_core.Step, bytes]) -> Step:
    record = Record(entries)
    record["levels"] = [Level(level) for level in record["levels"]]
    return Step(common, index, record, core)


def _result(common: Common, kept: Sequence[tuple[int, dict[str, Any], bytes]]) -> Result:
    return Result(common, [_step(common, *step) for step in kept])


def aside(place: Optional[str]) -> None:
    """Warn where files are now that stood where a result is gathered."""
    if place is not None:
        warn([f"steps of an interrupted run, or files that are not percoat's, were in the place where a result is gathered; they are now in {place}"])


def listener(progress: Listener) -> Optional[Callable[[_core.Progress], object]]:
    """The callable that ``progress`` stands for."""
    if progress is True:
        return _print
    return progress or None


def _print(progress: _core.Progress) -> None:
    import sys

    if sys.stderr.isatty():
        print(f"\r{progress!s:79}", end="\n" if progress.done == progress.of else "", file=sys.stderr)
    else:
        print(progress, file=sys.stderr)


def solve(
    case: CaseLike, *, set: Settings = None, threads: Optional[int] = None, progress: Listener = None
) -> Result:
    """Solve every load step of a case.

    Parameters
    ----------
    case
        A path, the name of an embedded case, or a dict of the same shape as the TOML. ``surface.heights`` of a dict may
        be an array (n₁, n₂), larger = nearer to the body.
    set
        Values to change first, ``{"layers.0.thickness": 0.2}``.
    threads
        Threads to use, all cores if it is not said; results do not depend on it.
    progress
        A callable that is called with how far it is (it prints as a line, and has ``done``, ``of``, ``phase``, …), or ``True`` to
        have that printed on standard error.

    Returns
    -------
    Result

    Raises
    ------
    CaseError
        The case is refused, with the message of the command line.
    KeyboardInterrupt
        At once on Ctrl-C; the solution ends between two iterations.

    Warns
    -----
    NotConverged
        When a step did not converge, or the accuracy was not reached.

    Examples
    --------
    >>> import percoat
    >>> result = percoat.solve("fig2", set={"grid.points": 96})
    >>> round(result.steps[0].penetration, 4)
    0.0554
    """
    checked = _core.Case(case, set)
    head, accurate, places, cores = _core.solve(checked, threads, listener(progress))
    records = head.pop("steps")
    common = Common(checked, head, accurate, places)
    steps = [_step(common, index, record, core) for index, (record, core) in enumerate(zip(records, cores))]
    result = Result(common, steps)
    reasons = [f"step {n}: {step.stop_reason}" for n, step in enumerate(result, 1) if not step.converged]
    warn_of(result, "not converged: " + (", ".join(reasons) or "the accuracy is not reached"))
    return result
