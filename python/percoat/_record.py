"""Numbers under names."""

from __future__ import annotations

from typing import Any, Dict


class Record(Dict[str, Any]):
    """A dict whose entries are attributes, too.

    >>> from percoat import Record
    >>> level = Record(load=0.5, errors={"load": 1e-3})
    >>> level.load, level["load"], level.errors.load
    (0.5, 0.5, 0.001)
    """

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        for key, value in self.items():
            self[key] = _recorded(value)

    def __getattr__(self, name: str) -> Any:
        try:
            return self[name]
        except KeyError:
            known = ", ".join(map(str, self))
            raise AttributeError(f"no {name!r} here; there are {known}") from None

    def __setattr__(self, name: str, value: Any) -> None:
        self[name] = _recorded(value)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *map(str, self)]

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (dict(self),)

    def to_dict(self) -> dict[str, Any]:
        """The record as plain dicts and lists."""
        return {key: _plain(value) for key, value in self.items()}


def _recorded(value: Any) -> Any:
    if isinstance(value, Record):
        return value
    if isinstance(value, dict):
        return Record(value)
    if isinstance(value, list):
        return [_recorded(item) for item in value]
    return value


def _plain(value: Any) -> Any:
    if isinstance(value, Record):
        return value.to_dict()
    if isinstance(value, list):
        return [_plain(item) for item in value]
    return value
