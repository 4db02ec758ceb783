"""The page that computes, clicked through in a headless browser.

Environment: PERCOAT_PAGE, the built page; PERCOAT, the program whose numbers it must have; PERCOAT_SHOTS, a folder for pictures of the screen.
"""

import base64
import json
import os
import re
import subprocess
import time
from pathlib import Path

import pytest
from selenium import webdriver
from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import Select, WebDriverWait

PAGE = Path(os.environ["PERCOAT_PAGE"]).resolve()
PROGRAM = Path(os.environ["PERCOAT"]).resolve()
SHOTS = os.environ.get("PERCOAT_SHOTS")
SIZES = {"desk": (1280, 1000), "phone": (390, 844)}
# Longest time that a machine under load may take, seconds.
PATIENCE = 180


@pytest.fixture(scope="module")
def browser(tmp_path_factory):
    options = webdriver.ChromeOptions()
    options.binary_location = next(path for path in ("/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome") if Path(path).exists())
    downloads = tmp_path_factory.mktemp("downloads")
    for flag in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-background-networking", "--disable-sync", "--no-first-run"):
        options.add_argument(flag)
    options.add_experimental_option("prefs", {"download.default_directory": str(downloads)})
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    driver = webdriver.Chrome(options=options, service=webdriver.ChromeService("/usr/bin/chromedriver"))
    driver.downloads = downloads
    yield driver
    driver.quit()


def wait(browser, condition, what):
    return WebDriverWait(browser, PATIENCE, 0.05).until(lambda _: condition(), what)


def status(browser):
    return browser.find_element(By.ID, "status").text


def done(browser):
    """Waits until the last calculation is done."""
    rounds = "return [String(round), document.body.dataset.done, document.getElementById('error').hidden]"

    def ended():
        now, finished, fine = browser.execute_script(rounds)
        assert fine, browser.find_element(By.ID, "error").text
        return now == finished

    wait(browser, ended, f"the calculation has not ended: {status(browser)}")


def opened(browser, address="", size="desk"):
    browser.set_window_size(*SIZES[size])
    browser.get("about:blank")
    browser.get(PAGE.as_uri() + address)
    wait(browser, lambda: browser.find_elements(By.CSS_SELECTOR, "#numbers tbody tr"), "no numbers")


def numbers(browser):
    rows = "return [...document.querySelectorAll('#numbers tbody tr')].map((row) => [...row.cells].map((cell) => cell.textContent))"
    return {name: cells for name, *cells in browser.execute_script(rows)}


def typed(browser, selector, text):
    field = browser.find_element(By.CSS_SELECTOR, selector)
    field.clear()
    field.send_keys(text)


def downloaded(browser, name, click):
    path = browser.downloads / name
    path.unlink(missing_ok=True)
    click()
    wait(browser, path.exists, f"{name} was not saved")
    time.sleep(0.2)
    return path


def saved(browser, name):
    button = browser.find_element(By.CSS_SELECTOR, f"[data-save={name}]")
    return downloaded(browser, "case.toml" if name == "case" else f"{name}.csv", button.click)


def shot(browser, name):
    if SHOTS:
        height = browser.execute_script("return document.documentElement.scrollHeight")
        width = browser.execute_script("return innerWidth")
        browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False})
        Path(SHOTS).mkdir(parents=True, exist_ok=True)
        browser.save_screenshot(str(Path(SHOTS) / f"{name}.png"))
        browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})


def scalars(record, path=""):
    """The numbers of a record by their paths; those of rounding alone, and positions, which mirror images share, are left out."""
    left_out = {"seconds", "certificate", "residual", "x", "y", "z", "direction", "rival", "centre", "errors", "error", "uncertainty"}
    if isinstance(record, dict):
        for key, value in record.items():
            if key not in left_out:
                yield from scalars(value, f"{path}/{key}")
    elif isinstance(record, list):
        for index, value in enumerate(record):
            yield from scalars(value, f"{path}/{index}")
    elif isinstance(record, (int, float)) and not isinstance(record, bool):
        yield path, record


def places(record, path=""):
    """The positions of a record by their paths; y without its sign, as mirror images are equal."""
    if isinstance(record, dict):
        if {"x", "y", "z"} <= record.keys():
            yield path, (record["x"], abs(record["y"]), record["z"])
        for key, value in record.items():
            yield from places(value, f"{path}/{key}")
    elif isinstance(record, list):
        for index, value in enumerate(record):
            yield from places(value, f"{path}/{index}")


def same_numbers(browser, folder):
    """The numbers of the page are those of the command line with the case that it saves, to 1e-12.

    Positions of largest values, where a value changes with the square of the distance, agree to 1e-5 of the contact radius.
    """
    step = browser.execute_script("return shown.coated.step")
    case = saved(browser, "case")
    subprocess.run([PROGRAM, "solve", case, "-o", folder, "--no-pictures", "--no-fields", "-q"], check=True)
    other = json.loads((folder / "summary.json").read_text())["steps"][0]
    ours, theirs = dict(scalars(step)), dict(scalars(other))
    assert ours.keys() == theirs.keys() and len(ours) > 20
    for path, value in theirs.items():
        # Small differences have the rounding of what they are made of: the asymmetry that of radii, a stress that of the pressures, of
        # which it is a sum (1e-14 of the largest).
        if path.endswith("asymmetry"):
            scale = 1.0
        elif path.startswith("/stress/"):
            scale = max(abs(value), 0.01 * other["max_pressure"])
        else:
            scale = abs(value)
        assert abs(ours[path] - value) <= 1e-12 * scale, (path, ours[path], value)
    ours, theirs = dict(places(step)), dict(places(other))
    radius = other["levels"][0]["contact_radius"]
    assert ours.keys() == theirs.keys() and len(ours) > 5
    for path, place in theirs.items():
        assert all(abs(found - x) <= 1e-5 * radius for found, x in zip(ours[path], place)), (path, ours[path], place)


def test_a_ball_on_a_coating(browser, tmp_path):
    opened(browser)
    done(browser)
    found = numbers(browser)
    assert {"penetration", "contact radius", "peak pressure", "largest tension"} <= found.keys()
    assert all("±" in cell for cells in found.values() for cell in cells[:2]), found
    assert browser.find_element(By.ID, "verdict").text
    assert len(browser.find_elements(By.CSS_SELECTOR, "#pictures img")) == 3
    same_numbers(browser, tmp_path / "ball")
    shot(browser, "ball")


# Pairs of numbers with their errors, and how the page writes the difference of the first from the second.
DIFFERENCES = [
    ((0.93, 0.3), (0.6, 0.2), "within the errors"),
    ((1.548, 0.004), (1.0, 0.002), "+54.8 ± 0.8 %"),
    ((0.5, 0.001), (1.0, 0.001), "-50.0 ± 0.2 %"),
    ((2.0, 0.2), (1.0, 0.1), "+60 to +140 %"),
    ((11.0, 1.0), (1.0, 0.09), "+1000 ± 200 %"),
    ((None, None), (1.0, 0.1), "–"),
]


def test_differences_have_no_more_digits_than_their_errors_allow(browser):
    opened(browser)
    done(browser)
    of = "const record = ([value, error]) => ({ value, error }); return arguments[0].map(([a, b]) => differenceOf(record(a), record(b)))"
    assert browser.execute_script(of, [pair for *pair, _ in DIFFERENCES]) == [text for *_, text in DIFFERENCES]
    shown = [cells[2] for cells in numbers(browser).values()]
    written = r"–|within the errors|[+-]?[\d.]+( ± [\d.]+| to [+-]?[\d.]+)? %"
    assert all(re.fullmatch(written, text) for text in shown) and any("±" in text for text in shown), shown


def test_the_grid_stands_above_the_numbers_and_what_fails_first_before_the_largest_stresses(browser):
    opened(browser)
    done(browser)
    assert browser.find_element(By.CSS_SELECTOR, "#numbers caption").text == "on 192 × 192 samples"
    captions = "return [...document.querySelectorAll('#more caption')].map((caption) => caption.textContent)"
    order = browser.execute_script(captions)
    assert order[0] == "contact" and order[1].startswith("limits"), order
    assert order.index("utilisation of strengths") < order.index("largest stresses"), order
    drawn = browser.execute_script("return shown.coated.pictures.map(([, svg]) => svg).join('')")
    assert ">ball<" in drawn and "level 1" not in drawn, "a ball alone has no number"


def test_a_change_is_computed_at_once_and_stands_in_the_address(browser, tmp_path):
    opened(browser)
    before = numbers(browser)["contact radius"][0]
    typed(browser, "[name=force]", "2,5")
    wait(browser, lambda: numbers(browser).get("contact radius", [before])[0] != before, "nothing changes")
    done(browser)
    found = numbers(browser)
    address = browser.execute_script("return location.hash")
    opened(browser, address)
    done(browser)
    assert numbers(browser) == found
    assert browser.find_element(By.CSS_SELECTOR, "[name=force]").get_attribute("value") == "2.5"


def test_a_counterbody_that_sticks_has_its_shift_and_what_slips(browser, tmp_path):
    opened(browser)
    done(browser)
    Select(browser.find_element(By.CSS_SELECTOR, "[name=samples]")).select_by_value("96")
    Select(browser.find_element(By.CSS_SELECTOR, "[name=motion]")).select_by_value("sticks")
    wait(browser, lambda: "tangential shift" in numbers(browser), "no shift")
    done(browser)
    drawn = [figure.get_attribute("data-name") for figure in browser.find_elements(By.CSS_SELECTOR, "#pictures figure")]
    assert drawn == ["pressure", "slip", "section", "profiles"]
    captions = browser.execute_script("return [...document.querySelectorAll('#more caption')].map((caption) => caption.textContent)")
    assert any(caption.startswith("partial slip") for caption in captions)
    assert not any(caption.startswith("limits") for caption in captions), "limits are those of a counterbody that slides"
    step = browser.execute_script("return shown.coated.step")
    assert abs(step["tangential"]["mobilised"] - 0.6) < 1e-6
    case = saved(browser, "case")
    subprocess.run([PROGRAM, "solve", case, "-o", tmp_path / "sticks", "--no-pictures", "--no-fields", "-q"], check=True)
    other = json.loads((tmp_path / "sticks" / "summary.json").read_text())["steps"][0]
    # Tractions are solved to a gap of 1e-8: shifts agree to about that.
    assert step["tangential"]["tangential_shift"] == pytest.approx(other["tangential"]["tangential_shift"], rel=1e-6)
    # Sliders stand where the state is.
    assert browser.execute_script("return [form.elements.friction.value, form.elements.part.value]") == ["0.2", "0.6"]
    # Without friction nothing is left to stick.
    browser.execute_script("form.elements.friction.value = '0'; form.elements.friction.dispatchEvent(new Event('input', {bubbles: true}))")
    wait(browser, lambda: "tangential shift" not in numbers(browser), "the shift stays")
    done(browser)


# Keeps the numbers, the pictures and the verdict that stand there while the rest is computed.
KEPT_PARTS = """
const status = document.getElementById("status");
window.shownParts = [];
new MutationObserver(() => {
  if (!status.textContent.includes("computing the rest")) return;
  const rows = [...document.querySelectorAll("#numbers tbody tr")].map((row) => [row.cells[0].textContent, row.cells[1].textContent]);
  const pictures = [...document.querySelectorAll("#pictures figure")].map((figure) => figure.dataset.name);
  const buttons = document.querySelectorAll("#actions:not([hidden]) button, #pictures button:not([disabled])").length;
  window.shownParts.push({ numbers: Object.fromEntries(rows), pictures, buttons, verdict: document.getElementById("verdict").textContent });
}).observe(status, { childList: true });
"""


def test_contact_stresses_and_section_are_shown_one_after_another(browser):
    """A number stays what it is when others stand beside it."""
    opened(browser)
    done(browser)
    browser.execute_script(KEPT_PARTS)
    Select(browser.find_element(By.CSS_SELECTOR, "[name=samples]")).select_by_value("96")
    done(browser)
    contact, stresses = browser.execute_script("return window.shownParts")
    whole = {name: cells[0] for name, cells in numbers(browser).items()}
    assert {"penetration", "contact radius", "peak pressure"} <= contact["numbers"].keys() < whole.keys(), contact
    assert contact["numbers"].items() <= whole.items()
    assert stresses["numbers"] == whole
    assert not contact["verdict"] and stresses["verdict"]
    assert contact["pictures"] == stresses["pictures"] == ["pressure", "profiles"]
    assert contact["buttons"] == stresses["buttons"] == 0, "what is not complete can be saved"
    drawn = [figure.get_attribute("data-name") for figure in browser.find_elements(By.CSS_SELECTOR, "#pictures figure")]
    assert drawn == ["pressure", "section", "profiles"]


# Every case is left after an iteration.
LEFT_EARLY = """
const complete = caseOf;
caseOf = (...given) => {
  const built = complete(...given);
  return { ...built, solver: { ...built.solver, max_iterations: 1 } };
};
"""


def test_what_is_not_converged_is_shown_with_its_warning_alone(browser):
    opened(browser)
    done(browser)
    browser.execute_script(KEPT_PARTS)
    browser.execute_script(LEFT_EARLY)
    Select(browser.find_element(By.CSS_SELECTOR, "[name=samples]")).select_by_value("96")
    done(browser)
    assert browser.execute_script("return window.shownParts") == []
    assert "not converged" in browser.find_element(By.ID, "warnings").text


# The pictures of the parts and of the whole of a case with two loads.
TWO_LOADS = """
const [done] = arguments;
const rough = caseOf({ ...state, body: "asperities" }, library, { points: 48 });
const request = { task: "solve", case: { ...rough, load: { mean_pressure: [0.01, 0.04] } }, pictures: true, parts: true };
const pressure = ({ pictures }) => Object.fromEntries(pictures).pressure;
const parts = [];
answerOf(request, (known) => parts.push(pressure(known))).then((whole) => done([...parts, pressure(whole)]), (error) => done(String(error)));
"""


def test_pictures_are_those_of_the_last_load(browser):
    opened(browser)
    done(browser)
    first, first_again, last, last_again, whole = browser.execute_async_script(TWO_LOADS)
    assert first == first_again != last == last_again == whole


def test_layers_come_and_go(browser, tmp_path):
    opened(browser)
    browser.find_element(By.ID, "add").click()
    done(browser)
    assert "CrN" in saved(browser, "case").read_text()
    tension = numbers(browser)["largest tension"]
    rows = browser.find_elements(By.CSS_SELECTOR, "#layers .part")
    assert len(rows) == 2
    Select(rows[1].find_element(By.TAG_NAME, "select")).select_by_value("")
    rows = browser.find_elements(By.CSS_SELECTOR, "#layers .part")
    for key, value in (("young", "100"), ("poisson", "0.3"), ("tensile_strength", "0.4")):
        rows[1].find_element(By.CSS_SELECTOR, f"[data-key={key}]").send_keys(value)
    done(browser)
    assert numbers(browser)["largest tension"] != tension
    assert re.search("young = 100.0", saved(browser, "case").read_text())
    for _ in range(2):
        browser.find_element(By.CSS_SELECTOR, "#layers button").click()
    done(browser)
    assert len(numbers(browser)["penetration"]) == 1, "without layers there is nothing to compare with"


def test_asperities_under_a_pressure(browser, tmp_path):
    opened(browser)
    browser.find_element(By.CSS_SELECTOR, "[name=body][value=asperities]").click()
    wait(browser, lambda: "asperities" in browser.execute_script("return shown.coated?.case ?? ''").lower(), "no asperities")
    done(browser)
    same_numbers(browser, tmp_path / "asperities")
    shot(browser, "asperities")
    Select(browser.find_element(By.CSS_SELECTOR, "[name=load]")).select_by_value("cell")
    Select(browser.find_element(By.CSS_SELECTOR, "[name=lattice]")).select_by_value("hexagonal")
    done(browser)
    assert "hexagonal" in saved(browser, "case").read_text()


def test_tables_and_pictures_are_saved(browser):
    opened(browser)
    done(browser)
    assert saved(browser, "profile").read_text().startswith("x,y,pressure,gap\n")
    assert saved(browser, "section").read_text().count("\n") > 1000
    assert "penetration" in saved(browser, "numbers").read_text()
    button = browser.find_element(By.CSS_SELECTOR, "[data-picture=section]")
    assert downloaded(browser, "section.png", button.click).read_bytes().startswith(b"\x89PNG")


def test_what_is_refused_is_said(browser):
    opened(browser)
    typed(browser, "#layers [data-key=thickness]", "-1")
    error = browser.find_element(By.ID, "error")
    wait(browser, lambda: error.is_displayed(), "no error")
    assert "thickness" in error.text
    shot(browser, "error")
    typed(browser, "#layers [data-key=thickness]", "2")
    wait(browser, lambda: not error.is_displayed(), "the error stays")


def test_what_is_no_number_is_refused_and_other_values_of_an_address_are_not_taken(browser):
    opened(browser)
    done(browser)
    typed(browser, "[name=force]", "five")
    error = browser.find_element(By.ID, "error")
    wait(browser, error.is_displayed, "no error")
    assert '"five" is not a number' in error.text
    assert not browser.find_element(By.ID, "actions").is_displayed()
    text = json.dumps({"layers": [None, {"thickness": "2"}], "samples": 7, "force": "much", "body": "cube", "substrate": 3})
    browser.get("about:blank")
    browser.get(PAGE.as_uri() + "#" + base64.b64encode(text.encode()).decode())
    wait(browser, lambda: "layers[0]" in browser.find_element(By.ID, "error").text, "no error")
    state = browser.execute_script("return state")
    assert (state["samples"], state["force"], state["body"], state["layers"]) == (192, 5, "ball", [{}, {}])


def test_a_failure_of_the_module_is_not_the_last_word(browser):
    opened(browser)
    done(browser)
    # The next request fails as it does where the module ends itself.
    fails_once = "const send = worker.send; worker.send = () => { worker.send = send; return Promise.resolve({ failure: 'unreachable' }); };"
    browser.execute_script(fails_once + "state.force = 2; changed();")
    error = browser.find_element(By.ID, "error")
    wait(browser, error.is_displayed, "no error")
    assert "unreachable" in error.text
    typed(browser, "[name=force]", "3")
    done(browser)
    assert "3 N" in saved(browser, "case").read_text()


def test_numbers_of_a_change_under_way_cannot_be_saved(browser):
    opened(browser)
    done(browser)
    typed(browser, "[name=force]", "4")
    assert browser.execute_script("return document.getElementById('result').classList.contains('outdated')")
    done(browser)
    assert not browser.execute_script("return document.getElementById('result').classList.contains('outdated')")
    # Limits say on which grid they were searched.
    assert "96 × 96 samples" in browser.find_element(By.ID, "verdict").text


def test_a_telephone(browser):
    opened(browser, size="phone")
    done(browser)
    wide = browser.execute_script("return document.documentElement.scrollWidth - innerWidth")
    assert wide <= 0, "the page is wider than the screen"
    shot(browser, "phone")


def test_nothing_is_uploaded(browser):
    opened(browser)
    done(browser)
    asked = [json.loads(entry["message"])["message"] for entry in browser.get_log("performance")]
    sent = [event["params"]["request"]["url"] for event in asked if event["method"] == "Network.requestWillBeSent"]
    assert sent
    assert all(url.startswith(("file:", "blob:", "data:", "about:")) for url in sent), sent
    severe = [entry for entry in browser.get_log("browser") if entry["level"] == "SEVERE"]
    assert not severe, severe
