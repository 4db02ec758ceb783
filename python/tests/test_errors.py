"""Refusals are errors that are typed and say why, in the words of the command line."""

from __future__ import annotations

import copy
import os
import re
from pathlib import Path
from typing import Any, Callable

import numpy as np
import pytest

import percoat
from conftest import Program, wave

REFUSED = Path(__file__).parents[2] / "tests" / "refused"


@pytest.fixture(scope="module")
def fig2() -> dict[str, Any]:
    return percoat.case("fig2", set={"grid.points": 48})


def changed(case: dict[str, Any], *path: Any, to: Any) -> dict[str, Any]:
    """A copy of a case with one entry changed; one that is `...` is taken out."""
    copied = copy.deepcopy(case)
    place: Any = copied
    for key in path[:-1]:
        place = place[key]
    if to is ...:
        del place[path[-1]]
    else:
        place[path[-1]] = to
    return copied


def refusal(call: Callable[[], object]) -> str:
    with pytest.raises(percoat.CaseError) as caught:
        call()
    return str(caught.value)


def words(text: str) -> str:
    return re.sub("^error: ", "", text.strip())


# Every command of the command line has its call.
CALLS: dict[str, Callable[..., object]] = {
    "solve": percoat.solve,
    "check": percoat.check,
    "limit": percoat.limit,
    "compare": percoat.compare,
}


def test_a_case_error_is_a_value_error() -> None:
    assert issubclass(percoat.CaseError, ValueError) and not issubclass(percoat.CaseError, OSError)
    assert percoat.CaseError.__module__ == "percoat" and percoat.CaseError.__doc__


@pytest.mark.parametrize(
    "path, value, message",
    [
        (["substrate", "young"], -1.0, "`substrate.young` must be a finite number greater than 0, not -1"),
        (
            ["substrate", "young"],
            float("nan"),
            "`substrate.young` must be a finite number greater than 0, not nan",
        ),
        (["substrate", "young"], np.inf, "`substrate.young` must be a finite number greater than 0, not inf"),
        (
            ["substrate", "young"],
            "soft",
            '`substrate.young` must be a finite number greater than 0, not the text "soft"',
        ),
        (
            ["substrate", "young"],
            [1.0],
            "`substrate.young` must be a finite number greater than 0, not a list of one item",
        ),
        (["substrate", "young"], True, "`substrate.young` must be a finite number greater than 0, not true"),
        (["substrate", "yong"], 1.0, "unknown key `substrate.yong`"),
        (["substrat"], {"young": 1.0}, "unknown key `substrat`"),
        (["substrate", "young"], ..., "`substrate.young` is missing"),
        (["substrate", "young"], None, "`substrate.young` is missing"),
        (["substrate"], ..., "the section [substrate] is missing"),
        (["layers", 0, "poisson"], 0.51, "`layers[0].poisson` must be a number"),
        (
            ["layers", 0, "interface"],
            "glued",
            '`layers[0].interface` must be "bonded" or "frictionless", not the text "glued"',
        ),
        (["load", "mean_pressure"], [0.01, -0.01], "`load.mean_pressure[1]` must be"),
        (["load", "mean_pressure"], np.array([0.01, np.nan]), "`load.mean_pressure[1]` must be"),
        (["load", "mean_pressure"], [], "`load.mean_pressure` must be"),
        (["grid", "points"], [48, 11], "`grid.points[1]` must"),
        (["grid", "points"], 48.5, "`grid.points` must be an integer between 4 and 32768"),
        (["grid", "points"], np.float64(1e9), "`grid.points` must be an integer between 4 and 32768"),
        (["levels"], [], "levels"),
        (["lattice", "kind"], "hexagon", '`lattice.kind` must be "hexagonal", "square", "oblique" or "isolated"'),
    ],
)
def test_a_dict_is_refused_where_its_file_would_be(
    fig2: dict[str, Any], path: list[Any], value: Any, message: str
) -> None:
    for call in (percoat.case, *CALLS.values()):
        assert message in refusal(lambda: call(changed(fig2, *path, to=value)))


@pytest.mark.parametrize(
    "settings",
    [
        {"substrate.young": -1.0},
        {"solver.tolerence": 1e-6},
        {"layers.0.thickness": np.nan},
        {"layers.7.thickness": 1.0},
        {"grid.points": 33.0},
        {"lattice": 3},
        {"levels.0.shape": "pyramid"},
        {"load": {"mean_pressure": 0.1, "penetration": 0.1}},
    ],
    ids=lambda settings: next(iter(settings)),
)
def test_settings_are_refused_in_the_words_of_the_command_line(
    program: Program, settings: dict[str, Any]
) -> None:
    ((key, value),) = settings.items()
    written = {True: "{ mean_pressure = 0.1, penetration = 0.1 }"}.get(isinstance(value, dict), value)
    told = program("solve", "fig2", "--set", f"{key}={written}", code=2).stderr
    # A list of texts is taken as it is; of a dict a value may be written in another way.
    assert words(refusal(lambda: percoat.solve("fig2", set=[f"{key}={written}"]))) == words(told)
    first = words(told).splitlines()[0]
    assert words(refusal(lambda: percoat.solve("fig2", set=settings))).splitlines()[0] == first


def test_settings_are_refused_with_key_value_and_place(fig2: dict[str, Any]) -> None:
    # Words of the same text on the command line, whatever the case is read from.
    for case in ("fig2", fig2):
        for key, value, text in [
            ("layers.0.poisson", 0.7, "layers.0.poisson=0.7"),
            ("levels[0].shape", "pyramid", 'levels[0].shape="pyramid"'),
            ("grid.pints", np.int64(8), "grid.pints=8"),
            ("levels.7.height", 1.5, "levels.7.height=1.5"),
            ("a..b", 1, "a..b=1"),
            ("", 1, "=1"),
        ]:
            ours = refusal(lambda: percoat.case(case, set={"title": "own", key: value}))
            assert ours == refusal(lambda: percoat.case(case, set=["title=own", text])) and text in ours
    # A key is not cut at an equals sign, as a text is.
    assert "unknown key `title=a`" in refusal(lambda: percoat.case("fig2", set={"title=a": "b"}))


@pytest.mark.parametrize(
    "settings",
    [{"levels.0.height": 0.0, "levels[0].height": 1.0}, ["grid.points=64", "grid.points=48"]],
    ids=["dict", "list"],
)
def test_a_key_set_twice_is_refused(settings: Any) -> None:
    assert "twice: give one value" in refusal(lambda: percoat.case("fig2", set=settings))


@pytest.mark.skipif(not REFUSED.is_dir(), reason="the cases are in the repository alone")
def test_files_are_refused_in_the_words_of_the_command_line(program: Program) -> None:
    # Every kind of refusal, of reading, of syntax and of meaning, and no more: each takes the start of a program.
    names = [
        "misspelt_key", "radius_is_nan", "surface_file_absent", "syntax_unclosed_section",
        "oblique_without_sites", "spring_too_soft", "missing_load", "set_without_value",
    ]
    for name in names:
        file = REFUSED / f"{name}.toml"
        settings = re.findall("^# set: (.*)$", file.read_text("utf-8"), re.MULTILINE)
        typed = [word for setting in settings for word in ("--set", setting)]
        told = program("solve", file, *typed, code=2).stderr
        assert words(refusal(lambda: percoat.solve(file, set=settings))) == words(told), name
        assert words(refusal(lambda: percoat.solve(str(file), set=settings))) == words(told), name


@pytest.mark.skipif(not REFUSED.is_dir(), reason="the cases are in the repository alone")
def test_all_that_is_refused_as_a_file_is_refused() -> None:
    files = sorted(REFUSED.glob("*.toml"))
    assert len(files) > 50
    for file in files:
        text = file.read_text("utf-8")
        settings = re.findall("^# set: (.*)$", text, re.MULTILINE)
        told = refusal(lambda: percoat.check(file, set=settings))
        for expected in re.findall("^# expect: (.*)$", text, re.MULTILINE):
            assert expected in told, file


def test_a_solution_that_is_out_of_reach_is_refused(
    program: Program, tmp_path: Path, fig2: dict[str, Any]
) -> None:
    deep = changed(fig2, "load", to={"penetration": 10.0})
    ours = refusal(lambda: percoat.solve(deep))
    settings = ["grid.points=48", "load={ penetration = 10.0 }"]
    typed = [word for setting in settings for word in ("--set", setting)]
    told = program("solve", "fig2", *typed, "-o", tmp_path / "out", code=2).stderr
    assert words(ours) == words(told)
    assert ours.startswith("load.penetration = 10 is out of reach: contact becomes complete at 0.0")


def memory() -> float:
    """Memory of this machine, in GiB; 0 where that is not known."""
    try:
        return float(os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 2**30)
    except (AttributeError, ValueError, OSError):
        return 0.0


@pytest.mark.skipif(memory() > 100.0, reason="the largest grid may fit")
def test_memory_is_refused_before_it_is_taken(program: Program, tmp_path: Path) -> None:
    for call in CALLS.values():
        assert re.search(
            "take about [0-9.]+ GiB of memory, and ",
            refusal(lambda: call("fig2", set={"grid.points": 32768})),
        )
    told = program("solve", "fig2", "--set", "grid.points=32768", "-o", tmp_path / "out", code=2).stderr
    ours = refusal(lambda: percoat.solve("fig2", set={"grid.points": 32768}))
    # What it takes differs, as pictures and files are left out, and what is there differs from moment to
    # moment.
    assert re.sub("[0-9]+", "#", words(ours)) == re.sub("[0-9]+", "#", words(told))


def test_a_plane_is_refused_before_its_memory_is_taken(python: Program) -> None:
    # 96 TB; in a process of its own, which must live on.
    text = """
import percoat, warnings
warnings.simplefilter("ignore")
step = percoat.solve("fig2", set={"grid.points": 48})[0]
try:
    step.plane(0.2, points=1_000_000)
except (percoat.CaseError, MemoryError) as error:
    print("refused:", error)
"""
    assert python(text).stdout.startswith("refused: ")


def test_there_is_no_such_case(tmp_path: Path) -> None:
    for call in (percoat.case, *CALLS.values(), percoat.HalfSpace.of, lambda case: percoat.kernel(case, 1.0)):
        message = refusal(lambda: call("fig22"))
        assert message.startswith("fig22 is neither a file nor an embedded case (afm-pull-off, ball-on-disc, dlc-on-steel, ")
        with pytest.raises(FileNotFoundError) as caught:
            call(tmp_path / "none.toml")
        assert caught.value.filename == str(tmp_path / "none.toml") and "none.toml" in str(caught.value)
        with pytest.raises(FileNotFoundError):
            call(str(tmp_path / "none.toml"))
        with pytest.raises((percoat.CaseError, IsADirectoryError)) as folder:
            call(tmp_path)
        assert str(tmp_path) in str(folder.value)


def test_a_file_that_may_not_be_read(tmp_path: Path) -> None:
    file = tmp_path / "own.toml"
    file.write_bytes(b"\xff\xfe[lattice]")
    with pytest.raises((percoat.CaseError, OSError)) as caught:
        percoat.solve(file)
    assert "own.toml" in str(caught.value) and "UTF-8" in str(caught.value)


@pytest.mark.parametrize("case", [3, None, b"fig2", [("grid", {})], 1.5, object()])
def test_a_case_of_another_type(case: Any) -> None:
    kind = type(case).__name__
    for call in (percoat.case, *CALLS.values(), percoat.HalfSpace.of, lambda case: percoat.kernel(case, 1.0)):
        with pytest.raises(
            TypeError, match=f"a case is a path, the name of an embedded case or a dict .*, not an? {kind}"
        ):
            call(case)


@pytest.mark.parametrize("value", [object(), 1j, len, dict])
def test_a_value_of_another_type(fig2: dict[str, Any], value: Any) -> None:
    kind = type(value).__name__
    with pytest.raises(
        TypeError, match=f"`substrate.young` is an? {kind}: a case has numbers, texts, true and false"
    ):
        percoat.solve(changed(fig2, "substrate", "young", to=value))
    with pytest.raises(TypeError, match=f"`substrate.young` is an? {kind}: a case has numbers"):
        percoat.solve("fig2", set={"substrate.young": value})


def test_a_key_of_another_type(fig2: dict[str, Any]) -> None:
    with pytest.raises(TypeError, match="a key of `substrate` is no text: 3"):
        percoat.solve(changed(fig2, "substrate", 3, to=1.0))
    with pytest.raises(TypeError, match="a key of `case` is no text: 3"):
        percoat.solve(changed(fig2, 3, to=1.0))
    for call in (lambda: percoat.solve("fig2", set={3: 1.0}), lambda: percoat.sweep("fig2", {3: [1.0]})):
        with pytest.raises(TypeError, match="no text: 3"):
            call()


@pytest.mark.parametrize(
    "value",
    [
        "case = {}; case['substrate'] = case",
        "case = {}; case[''] = case",
        "items = []; items.append(items); case = {'substrate': {'young': items}}",
    ],
)
def test_a_case_within_itself(python: Program, value: str) -> None:
    # In a process of its own, which must live on.
    text = f"""
import percoat
{value}
try:
    percoat.case(case)
except (RecursionError, ValueError, TypeError) as error:
    print("refused:", error)
"""
    assert python(text).stdout.startswith("refused: ")


@pytest.mark.parametrize("settings", [3, 1.5, object(), [1, 2], [("grid.points", 48)]])
def test_settings_of_another_type(settings: Any) -> None:
    with pytest.raises(TypeError, match="set is a dict such as .*, or a list of texts KEY=VALUE"):
        percoat.solve("fig2", set=settings)


@pytest.mark.parametrize("threads", [0, -1, 65_536, 10**9])
@pytest.mark.parametrize("name", list(CALLS))
def test_threads_out_of_range(python: Program, name: str, threads: int) -> None:
    # So many threads could take all memory: a process of its own, bounded, must live on.
    case = "dlc-on-steel" if name == "limit" else "fig2"
    text = f"""
import percoat
try:
    import resource
    taken = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_AS, (taken + 2**30, resource.RLIM_INFINITY))
except (ImportError, OSError):
    pass
try:
    percoat.{name}("{case}", set={{"grid.points": 48}}, threads={threads})
except percoat.CaseError as error:
    print(error)
"""
    assert re.match("threads must be ", python(text, timeout=20.0).stdout)


@pytest.mark.parametrize("threads", [1.5, "2", [2], np.array([1, 2])])
def test_threads_of_another_type(threads: Any) -> None:
    with pytest.raises(TypeError):
        percoat.solve("fig2", set={"grid.points": 48}, threads=threads)


def test_progress_of_another_type() -> None:
    for progress in (3, "print"):
        with pytest.raises(TypeError, match="not callable"):
            percoat.solve("fig2", set={"grid.points": 48}, progress=progress)  # type: ignore[arg-type]


@pytest.mark.parametrize("points", [[1.0, 2.0], 1.0, [[1.0, 2.0, 3.0, 4.0]], [[]], None])
def test_points_of_another_shape(three_levels: percoat.Result, points: Any) -> None:
    message = refusal(lambda: three_levels[0].stress(points))
    assert message == f"points have three coordinates x, y, z along their last axis, not {np.shape(points)}"


@pytest.mark.parametrize("points", ["abc", [[1.0, 2.0, 3.0], [1.0, 2.0]], [[object(), 0.0, 0.0]]])
def test_points_that_are_no_numbers(three_levels: percoat.Result, points: Any) -> None:
    with pytest.raises((ValueError, TypeError)):
        three_levels[0].stress(points)


def test_complex_points_are_not_cut_short(three_levels: percoat.Result) -> None:
    with pytest.raises(
        (TypeError, ValueError, np.exceptions.ComplexWarning if hasattr(np, "exceptions") else Warning)
    ):
        three_levels[0].stress(np.array([1j, 0.0, 0.1]))


@pytest.mark.parametrize("z", [-1e-300, -1.0, np.nan, np.inf])
def test_depths_above_the_body(three_levels: percoat.Result, z: float) -> None:
    step = three_levels[0]
    calls: list[Callable[[], object]] = [
        lambda: step.stress([[0.0, 0.0, 0.1], [0.0, 0.0, z]]),
        lambda: step.plane(z),
        lambda: step.section((0, 0), (1, 0), length=1.0, depth=z),
        lambda: percoat.kernel("fig2", 1.0, depth=[0.1, z]),
    ]
    for call in calls:
        assert re.search(
            "not in the body|no finite number|must be a finite number|depth is a number", refusal(call)
        )


def test_places_that_are_no_numbers(three_levels: percoat.Result) -> None:
    for point in ([np.nan, 0.0, 0.1], [0.0, np.inf, 0.1]):
        assert "no finite number" in refusal(lambda: three_levels[0].stress(point))


@pytest.mark.parametrize("material", [0, 2, 3, -1])
def test_a_depth_in_another_material(three_levels: percoat.Result, material: int) -> None:
    step = three_levels[0]
    for call in (
        lambda: step.stress([0.0, 0.0, 0.4], material=material), lambda: step.plane(0.4, material=material)
    ):
        assert refusal(call) == f"z = 0.4 is in material 1, not in {material}"
    if material != 2:
        assert f"is in material 1 and 2, not in {material}" in refusal(
            lambda: step.plane(0.5, material=material)
        )


@pytest.mark.parametrize("points", [0, -1, [0, 4], [4, -4]])
def test_planes_of_no_points(three_levels: percoat.Result, points: Any) -> None:
    assert "two numbers above 0, those along a₁ and a₂" in refusal(
        lambda: three_levels[0].plane(0.1, points=points)
    )


@pytest.mark.parametrize("points", [[], [4], [1, 2, 3], [[4, 4]]])
def test_planes_of_points_of_another_shape(three_levels: percoat.Result, points: Any) -> None:
    with pytest.raises((ValueError, TypeError)):
        three_levels[0].plane(0.1, points=points)


@pytest.mark.parametrize("points", [2.5, "12", [2.5, 4]])
def test_planes_of_points_of_another_type(three_levels: percoat.Result, points: Any) -> None:
    with pytest.raises((TypeError, percoat.CaseError)):
        three_levels[0].plane(0.1, points=points)


def test_sections_that_lead_nowhere(three_levels: percoat.Result) -> None:
    step = three_levels[0]
    assert "the case asks for none" in refusal(step.section)
    assert '`stress.section.from` must be "level 1" to "level 3", not the text "level 9"' in refusal(
        lambda: step.section("level 9", "level 1")
    )
    assert "`stress.section.toward` is missing" in refusal(lambda: step.section("level 1"))
    assert "a direction [x, y] other than [0, 0]" in refusal(lambda: step.section((0, 0), (0, 0)))
    assert "`stress.section.length` must be" in refusal(lambda: step.section((0, 0), (1, 0), length=-1.0))
    assert "a place [x, y]" in refusal(lambda: step.section((0, 0, 0), (1, 0)))
    with pytest.raises(TypeError, match="`stress.section.from` is an? object"):
        step.section(object(), (1, 0))  # type: ignore[arg-type]


def test_a_section_is_refused_as_in_a_case(three_levels: percoat.Result, flat_wave: percoat.Result) -> None:
    # The words have the key, the value received and the excerpt that the same value of `set` has.
    cut = {"from": "level 1", "toward": "level 9", "length": 1.0, "depth": 0.5}
    ours = refusal(lambda: three_levels[0].section("level 1", "level 9", length=1.0, depth=0.5))
    assert ours == refusal(lambda: percoat.case("fig2", set={"stress.section": cut}))
    assert "stress.section={" in ours and 'not the text "level 9"' in ours
    # A topography has no levels.
    told = "`stress.section.from` must be two numbers in brackets: this case has no levels"
    assert told in refusal(lambda: flat_wave[0].section("level 1", (1, 0)))


@pytest.mark.parametrize("wavenumber", [0.0, -1.0, np.nan, np.inf, 1e70, 1e-70, [1.0, 0.0], None])
def test_wavenumbers_out_of_range(wavenumber: Any) -> None:
    body = percoat.HalfSpace.of("fig2")
    for call in (body.compliance, body.correction, body.kernel, lambda q: percoat.kernel("fig2", q)):
        assert "a wavenumber is a number greater than 0, between 1e-60 and 1e60" in refusal(
            lambda: call(wavenumber)
        )


def test_tractions_that_are_not_there() -> None:
    assert 'traction is "normal", "along" or "across", not "up"' in refusal(
        lambda: percoat.kernel("fig2", 1.0, traction="up")
    )
    with pytest.raises(TypeError):
        percoat.kernel("fig2", 1.0, traction=1)  # type: ignore[arg-type]


def test_half_spaces_that_are_refused() -> None:
    substrate = {"young": 1.0, "poisson": 0.3}
    assert "the section [substrate] is missing" in refusal(percoat.HalfSpace)
    assert "unknown key `substrate.yong`" in refusal(
        lambda: percoat.HalfSpace(substrate={"yong": 1.0, "poisson": 0.3})
    )
    assert "either `shear_ratio` or `young`" in refusal(
        lambda: percoat.HalfSpace([{"thickness": 1.0, "poisson": 0.3}], substrate)
    )
    words_alone: Any = ["hard"]
    assert "`layers[0]` must be a table" in refusal(lambda: percoat.HalfSpace(words_alone, substrate))
    with pytest.raises(TypeError):
        percoat.HalfSpace(3, substrate)  # type: ignore[arg-type]


def test_sweeps_that_are_refused() -> None:
    assert "a sweep needs a key with several values" in refusal(lambda: percoat.sweep("fig2", {}))
    assert "`grid.points` has no values to sweep over" in refusal(
        lambda: percoat.sweep("fig2", {"grid.points": []})
    )
    assert "unknown key `grid.pints`" in refusal(lambda: percoat.sweep("fig2", {"grid.pints": [48, 64]}))
    pairs = {"grid.points": [48, 64], "layers.0.thickness": [0.1, 0.2, 0.3]}
    assert "`grid.points` has 2 of them, `layers.0.thickness` 3" in refusal(
        lambda: percoat.sweep("fig2", pairs, zip=True)
    )
    assert "a sweep needs a key with several values" in refusal(lambda: percoat.sweep("fig2", None))
    with pytest.raises(TypeError, match="a case is a path"):
        percoat.sweep(3, {"grid.points": [48, 64]})  # type: ignore[arg-type]
    with pytest.raises(FileNotFoundError):
        percoat.sweep("none.toml", {"grid.points": [48, 64]})


def test_limits_need_strengths() -> None:
    assert refusal(lambda: percoat.limit("fig2", set={"grid.points": 48})).startswith("limits need strengths")


def test_a_comparison_needs_levels() -> None:
    assert "compare needs [[levels]]" in refusal(lambda: percoat.compare(wave()))


@pytest.mark.parametrize(
    "heights, message",
    [
        (np.zeros((2, 3, 4)), "heights"),
        (np.zeros(12), "heights"),
        (np.zeros((0, 4)), "heights"),
        (np.full((8, 8), np.nan), "no measurement at any place"),
        (3.0, "heights"),
    ],
    ids=["three axes", "one axis", "empty", "not a number", "a number"],
)
def test_heights_that_are_no_surface(heights: Any, message: str) -> None:
    assert message in refusal(lambda: percoat.solve(wave(surface={"heights": heights, "period": [2.0, 0.5]})))


@pytest.mark.parametrize(
    "heights", [np.array([["a", "b"], ["c", "d"]]), np.ones((8, 8), complex), object(), [[1.0], [2.0, 3.0]]]
)
def test_heights_that_are_no_numbers(heights: Any) -> None:
    with pytest.raises(TypeError, match="`surface.heights` is (an array of numbers|complex)"):
        percoat.solve(wave(surface={"heights": heights, "period": [2.0, 0.5]}))


def test_heights_in_a_file_that_is_not_there(tmp_path: Path) -> None:
    surface = {"heights": tmp_path / "none.npy", "period": [2.0, 0.5]}
    assert f"`surface.heights`: cannot read {tmp_path / 'none.npy'}" in refusal(
        lambda: percoat.solve(wave(surface=surface))
    )


def test_there_is_no_such_key() -> None:
    assert "there is no key `x.y`" in refusal(lambda: percoat.explain("x.y"))
    with pytest.raises(TypeError):
        percoat.explain(3)  # type: ignore[arg-type]


def test_after_a_refusal_all_is_well(fig2: dict[str, Any]) -> None:
    expected = percoat.solve(fig2)[0].pressure
    refusal(lambda: percoat.solve(changed(fig2, "load", to={"penetration": 10.0})))
    assert np.array_equal(percoat.solve(fig2)[0].pressure, expected)
