"""Materials by their names."""

from __future__ import annotations

import pickle
from pathlib import Path

import percoat
import pytest

OWN = '[[material]]\nname = "TiN"\nyoung = 400.0\npoisson = { value = 0.2, range = [0.1, 0.3] }\n'


def test_the_library_is_a_dict_by_names() -> None:
    library = percoat.materials()
    assert len(library) >= 40
    steel = library["AISI 304"]
    assert (steel["kind"], steel["young"]["value"], steel["yield_strength"]["what"]) == ("steel", 193.0, "0.2 % proof")
    assert all(material["young"]["certainty"] in ("sourced", "assumed") for material in library.values())


def test_own_materials_come_first(tmp_path: Path) -> None:
    (tmp_path / "own.toml").write_text(OWN)
    coating = percoat.materials(tmp_path / "own.toml")["TiN"]
    assert coating == {"name": "TiN", "young": {"value": 400.0}, "poisson": {"value": 0.2, "range": [0.1, 0.3]}}
    (tmp_path / "own.toml").write_text(OWN.replace("400.0", '"stiff"'))
    with pytest.raises(percoat.CaseError, match=r"`material\[0\].young` must be a finite number"):
        percoat.materials(tmp_path / "own.toml")
    with pytest.raises(OSError):
        percoat.materials(tmp_path / "absent.toml")


def test_a_dict_takes_its_materials_by_name() -> None:
    case = percoat.case("tin-on-steel")
    case["layers"] = [{"thickness": 3e-6, "material": "CrN"}]
    case["substrate"] = {"material": "100Cr6"}
    whole = percoat.case(case)
    assert (whole["layers"][0]["young"], whole["substrate"]["poisson"]) == (375e9, 0.3)
    assert percoat.case(whole) == whole
    case["substrate"] = {"material": "100Cr7"}
    with pytest.raises(percoat.CaseError, match="did you mean \"100Cr6\"?"):
        percoat.case(case)


def test_a_half_space_takes_them_too(tmp_path: Path) -> None:
    (tmp_path / "own.toml").write_text(OWN)
    given = percoat.HalfSpace(substrate={"young": 400e3, "poisson": 0.2})
    named = percoat.HalfSpace(
        substrate={"material": "TiN"}, units={"pressure": "MPa"}, materials=tmp_path / "own.toml"
    )
    assert named.compliance(1.0) == given.compliance(1.0) == pickle.loads(pickle.dumps(named)).compliance(1.0)
