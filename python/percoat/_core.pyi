"""What is compiled: cases and records as dicts, fields as arrays."""

from os import PathLike
from typing import Any, Callable, Dict, List, Mapping, Optional, Tuple, Union

import numpy as np
from numpy.typing import NDArray

__version__: str

_Array = NDArray[np.float64]
_Listener = Optional[Callable[["Progress"], object]]
_Keys = Dict[str, Any]
_Settings = Union[None, str, Mapping[str, Any], List[str]]

class CaseError(ValueError):
    """A case, or what is asked of it, is refused: nothing has been computed."""

class Case:
    """A case that has been read, with every default resolved."""

    def __init__(
        self, case: Union[str, PathLike[str], Mapping[str, Any], Case], set: _Settings = None
    ) -> None: ...
    @property
    def cell(self) -> List[List[float]]: ...
    def as_dict(self) -> _Keys: ...
    def check(self, threads: Optional[int] = None) -> _Keys: ...

class HalfSpace:
    """Layers on a substrate, and their response to harmonic tractions."""

    def __init__(self, sections: Union[Mapping[str, Any], Case]) -> None: ...
    def compliance(self, wavenumbers: _Array) -> _Array: ...
    def correction(self, wavenumbers: _Array) -> _Array: ...
    def kernel(self, wavenumbers: _Array, depths: List[float], traction: str) -> List[_Keys]: ...

class Step:
    """A solved load step."""

    @property
    def pressure(self) -> _Array: ...
    @property
    def gap(self) -> _Array: ...
    def displacement(self) -> _Array: ...
    def stress(self, points: _Array, material: Optional[int] = None, body: str = "body") -> _Array: ...
    def plane(
        self, z: float, points: Optional[List[int]] = None, material: Optional[int] = None, body: str = "body"
    ) -> Tuple[_Array, int, Optional[str]]: ...
    def section(
        self, cut: Optional[Mapping[str, Any]] = None, body: str = "body"
    ) -> Tuple[List[_Array], NDArray[np.int32], _Array]: ...
    def maxima(self) -> Optional[_Keys]: ...
    def checkpoint(self) -> bytes: ...

class Progress:
    """Progress of a computation. It prints as a line."""

    @property
    def unit(self) -> str:
        """Counted things: ``step``, ``combination`` or ``part``; ``load`` or ``trial`` where their number is not known."""
    @property
    def done(self) -> int:
        """Number of those that are done."""
    @property
    def of(self) -> int:
        """Number of all; 0 where it is not known."""
    @property
    def points(self) -> Optional[Tuple[int, int]]:
        """Points of the present grid along a₁ and a₂; ``None`` for a sweep, a search for parameters, and before the first contact of a life."""
    @property
    def iteration(self) -> int:
        """Iterations so far on that grid."""
    @property
    def residual(self) -> float:
        """ε of the last iteration; NaN before the first."""
    @property
    def phase(self) -> str:
        """The present phase in words."""
    @property
    def seconds(self) -> float:
        """Wall time so far, seconds."""

def cases() -> List[Tuple[str, str]]: ...
def explain(key: Optional[str] = None) -> str: ...
def schema() -> _Keys: ...
def materials(file: Union[None, str, PathLike[str]] = None) -> List[_Keys]: ...
def solve(
    case: Case, threads: Optional[int] = None, progress: _Listener = None
) -> Tuple[_Keys, bool, Tuple[_Array, _Array, NDArray[np.int32]], List[Step]]: ...
def outcome_text(case: Case, summary: _Keys, width: int) -> str: ...
def step(case: Case, index: int, points: List[int], bytes: bytes) -> Step: ...
def life(case: Case, threads: Optional[int] = None, progress: _Listener = None) -> Tuple[_Keys, bool]: ...
def life_text(case: Case, life: _Keys, width: int) -> str: ...
def limit(case: Case, threads: Optional[int] = None, progress: _Listener = None) -> Tuple[_Keys, bool]: ...
def limit_text(case: Case, limits: _Keys, width: int) -> str: ...
def identify(
    case: Case,
    data: Union[str, PathLike[str], List[Tuple[str, _Array]]],
    free: List[str],
    width: int,
    threads: Optional[int] = None,
    progress: _Listener = None,
) -> Tuple[_Keys, Dict[str, Optional[_Array]], str, List[str]]: ...
def sweep(
    case: Union[str, PathLike[str], Mapping[str, Any], Case],
    set: Mapping[str, Any],
    zip: bool = False,
    limit: bool = False,
    threads: Optional[int] = None,
    progress: _Listener = None,
) -> Tuple[List[Tuple[str, List[Any]]], List[Tuple[str, str, str, List[str]]]]: ...
def compare(
    case: Case, width: int, threads: Optional[int] = None, progress: _Listener = None
) -> Tuple[_Keys, str, List[str], bool]: ...
def main(typed: List[str]) -> int: ...
