"""suspension_bag diagnose --vehicle --report: what the pages of a vehicle show in a browser."""
import io
import itertools
import json
import re
import types

import matplotlib.image
import pytest
import yaml

import browser

WORDS = {"effect_found": "Effect found", "nothing_missing": "Nothing missing", "unexplained": "Unexplained",
         "suspect": "Main suspect"}


def simulate(program, folder, model, *options):
    """A bag, and the file of its vehicle."""
    bag, path = folder / "drive <b>&.bag", folder / "vehicle.yaml"
    program.succeed("simulate", "--vehicle-model", model, "--duration", "60", "--rate", "100", "-o", bag, "--vehicle-file",
                    path, *options)
    return bag, path


@pytest.fixture(scope="module", params=["bar", "half", "unplaced"])
def report(request, program, tmp_path_factory):
    """A vehicle with an effect at the front, the result as --json has it, and the page as a browser shows it."""
    folder = tmp_path_factory.mktemp(request.param)
    if request.param == "bar":
        bag, path = simulate(program, folder, "sedan", "--set", "anti_roll_bars/front_left/front_right=9000")
    elif request.param == "half":
        bag, path = simulate(program, folder, "half_sedan", "--effect", "front/quadratic_damping=2")
    else:
        bag, path = simulate(program, folder, "sedan")
        path.write_text(re.sub(r", position: \[.*\]", "", path.read_text()))
    program.succeed("diagnose", bag, "--vehicle", path, "--json", folder / "result.json", "--report", folder / "page")
    main = folder / "page" / "report.html"
    return types.SimpleNamespace(case=request.param, bag=bag, folder=folder, path=main,
                                 layout=yaml.safe_load(path.read_text())["struts"],
                                 result=json.loads((folder / "result.json").read_text()),
                                 page=browser.shown(main, folder / "profile"))


def wheels(report):
    return {each.attributes["data-strut"]: each.attributes for each in report.page.one("svg").all()
            if "data-strut" in each.attributes}


def test_scripts_run_without_an_error(report):
    assert report.page.one(id="script-errors").text == ""
    assert report.page.one("html").attributes["data-ready"] == "yes"


def test_pages_load_nothing(report):
    pages = sorted(report.path.parent.rglob("*"))
    names = sorted(report.layout)
    assert [str(path.relative_to(report.path.parent)) for path in pages] == sorted(
        ["report.html", *names, *(f"{name}/report.html" for name in names)])
    for path in pages:
        if path.is_file():
            text = re.sub("http://www.w3.org/2000/svg", "", path.read_text())
            assert not re.search(r"(?:src|href)=|@import|url\(|fetch\(|XMLHttpRequest|https?://", text)


def test_verdict_of_the_vehicle_comes_first(report):
    verdict = report.page.one("section", id="verdict")
    assert verdict.attributes["data-verdict"] == report.result["verdict"]
    assert report.result["summary"].replace("_", " ") in verdict.one("h1").text
    assert report.bag.name in verdict.one("p", class_="source").text
    assert next(report.page.one("main").all("section")) is verdict


def test_every_strut_has_its_verdict_in_colour_and_words(report):
    struts = report.result["struts"]
    assert set(wheels(report)) == set(struts)
    items = {item.attributes["data-strut"]: item for item in report.page.one(id="verdict").all("li")}
    for name, strut in struts.items():
        word = WORDS[strut["verdict"]]
        assert wheels(report)[name]["data-verdict"] == items[name].attributes["data-verdict"] == strut["verdict"]
        assert items[name].one("span", class_="word").text == word
        for effect in strut["selected"]:
            assert effect.replace("_", " ") in items[name].text.lower()
    texts = [text.text for text in report.page.one("svg").all("text", class_="word")]
    assert texts == [WORDS[strut["verdict"]] for strut in struts.values()]


def test_wheels_stand_as_on_the_vehicle(report):
    """Ahead is up, left is left; to scale where the file has positions."""
    places = {name: (float(each["data-x"]), float(each["data-y"])) for name, each in wheels(report).items()}
    for one, other in itertools.permutations(places, 2):
        if one.startswith("front") and other.startswith("rear"):
            assert places[one][1] < places[other][1] - 40
        if one.endswith("left") and other.endswith("right"):
            assert places[one][0] < places[other][0] - 40
    if report.case != "bar":
        return
    positions = {name: strut["position"] for name, strut in report.layout.items()}
    scale = (places["rear_left"][1] - places["front_left"][1]) / (positions["front_left"][0] - positions["rear_left"][0])
    for name, (x, y) in places.items():
        ahead, left = (positions[name][i] - positions["front_left"][i] for i in range(2))
        assert x - places["front_left"][0] == pytest.approx(-scale * left, abs=0.11)
        assert y - places["front_left"][1] == pytest.approx(-scale * ahead, abs=0.11)


def test_drawing_can_be_saved_as_it_looks(report, tmp_path):
    """Each wheel in the colour of its verdict, on the colour of the page."""
    image = matplotlib.image.imread(io.BytesIO(browser.saved_drawing(report.path, tmp_path / "saved")), format="png")
    scale = image.shape[1] / 360
    assert scale > 1.5, "it may be printed"
    colours = {name: tuple(image[round(scale * float(each["data-y"])), round(scale * float(each["data-x"])), :3])
               for name, each in wheels(report).items()}
    verdicts = {name: each["data-verdict"] for name, each in wheels(report).items()}
    card = tuple(image[0, 0, :3])
    assert card not in colours.values() and card != (0, 0, 0)
    for one, other in itertools.permutations(colours, 2):
        assert (colours[one] == colours[other]) == (verdicts[one] == verdicts[other])


def test_anti_roll_bar_ties_its_struts(report):
    bars = [each for each in report.page.one("svg").all("g") if "data-bar" in each.attributes]
    assert [each.attributes["data-bar"].split() for each in bars] == [
        bar["struts"] for bar in report.result["anti_roll_bars"]]
    assert len(bars) == (report.case == "bar")
    for bar in bars:
        line = next(bar.all("line")).attributes
        for i, name in enumerate(bar.attributes["data-bar"].split(), start=1):
            assert float(line[f"x{i}"]) == pytest.approx(float(wheels(report)[name]["data-x"]), abs=0.06)
            assert float(line[f"y{i}"]) == pytest.approx(float(wheels(report)[name]["data-y"]), abs=0.06)


def test_coupling_is_that_of_the_result(report):
    rows = [row for row in report.page.one(id="coupling").all("tr") if "data-strut" in row.attributes]
    names = [row.attributes["data-strut"] for row in rows]
    for row in rows:
        for other, cell in zip(names, list(row.all("td"))[1:]):
            one = row.attributes["data-strut"]
            if one == other:
                assert cell.text == "1"
                continue
            ratio, stddev = (report.result[key][one][other] for key in ("coupling", "coupling_stddevs"))
            shown = [float(each) for each in cell.text.replace("−", "-").split("±")]
            assert shown == [pytest.approx(ratio, abs=0.6 * stddev), pytest.approx(stddev, rel=0.5)]


def test_struts_are_opened_and_lead_back(report):
    for name, strut in report.result["struts"].items():
        targets = {link.attributes["href"] for link in report.page.all("a") if name in link.attributes["href"]}
        assert targets == {f"{name}/report.html"}
        page = browser.shown(report.path.parent / name / "report.html", report.folder / "profile")
        assert page.one(id="script-errors").text == ""
        assert page.one("a").attributes["href"] == "../report.html"
        assert name in page.one("p", class_="source").text
        own = [effect for effect in strut["selected"] if effect != "anti_roll_bar"]
        expected = strut["verdict"] if own or strut["verdict"] == "unexplained" else "nothing_missing"
        assert page.one("section", id="verdict").attributes["data-verdict"] == expected
        assert ("anti-roll bar" in page.one("section", id="verdict").text) == ("anti_roll_bar" in strut["selected"])
        assert f"--strut {name}" in page.one(id="adding").text


@pytest.mark.parametrize("width, dark", [(1400, False), (390, True)])  # colours move nothing
def test_nothing_is_cut_off(report, width, dark):
    root = browser.measured(report.path, report.folder / "measured", width, dark).one("html").attributes
    assert (root["data-width"], root["data-dark"]) == (str(width), str(dark).lower())
    assert root["data-cut"] == ""
    assert root["data-scrolls"] == "0"


def test_with_strut_it_is_the_page_of_that_one(program, tmp_path):
    bag, path = simulate(program, tmp_path, "half_sedan")
    program.succeed("diagnose", bag, "--vehicle", path, "--strut", "rear", "--report", tmp_path / "page")
    assert [each.name for each in (tmp_path / "page").rglob("*")] == ["report.html"]
    page = browser.shown(tmp_path / "page" / "report.html", tmp_path / "profile")
    assert "rear in" in page.one("p", class_="source").text
    assert list(page.all("a")) == []


def test_nothing_is_left_of_a_search_that_fails(program, tmp_path):
    bag, path = simulate(program, tmp_path, "sedan", "--set", "tracks=identical")
    told = program("diagnose", bag, "--vehicle", path, "--report", tmp_path / "page", "-o", tmp_path / "models.yaml")
    assert told.returncode == 4 and "cannot tell" in told.stderr
    assert {each.name for each in tmp_path.iterdir()} == {bag.name, path.name}


def test_page_that_cannot_be_written_is_refused_before_the_search(program, tmp_path):
    bag, path = simulate(program, tmp_path, "half_sedan")
    (tmp_path / "page").mkdir()
    (tmp_path / "page" / "rear").write_text("here first")
    for folder, words in ((tmp_path / "no" / "folder", "cannot be made"), (tmp_path / "page", "page/rear: cannot be made")):
        program.refuse(3, ["diagnose", bag, "--vehicle", path, "--report", folder], [words], tmp_path)
    assert [each.name for each in (tmp_path / "page").iterdir()] == ["rear"]


@pytest.fixture(scope="module")
def page_of(program, tmp_path_factory):
    """Makes the page of a vehicle whose struts have these names and, if any, settings."""
    folder = tmp_path_factory.mktemp("made")
    bag, path = simulate(program, folder, "half_sedan")
    program.succeed("diagnose", bag, "--vehicle", path, "--report", folder / "page")
    text = (folder / "page" / "report.html").read_text()
    before, findings, after = re.fullmatch(
        r'(.*<script type="application/json" id="findings">)(.*?)(</script>.*)', text, re.DOTALL).groups()

    def make(names, known_forces=None, **settings):
        found = json.loads(findings)
        strut = {**next(iter(found["struts"].values())), **settings}
        found["struts"] = {name: strut for name in names}
        found["places"] = [{"name": name} for name in names]
        found["coupling"] = found["coupling_stddevs"] = {name: {other: 0.1 for other in names} for name in names}
        found["known_forces"] = known_forces or {}
        page = folder / "page" / f"{names[0]}.html"
        page.write_text(before + json.dumps(found) + after)
        return types.SimpleNamespace(path=page, page=browser.shown(page, folder / "profile"), folder=folder)
    return make


@pytest.mark.parametrize("rows", [
    [("fl", "fr"), ("ml", "mr"), ("rl", "rr")], [("f_l", "f_r"), ("b_l", "b_r")],
    [("axle_1_left", "axle_1_right"), ("axle_2_left", "axle_2_right"), ("axle_10_left", "axle_10_right")],
    [("front",), ("rear_left", "rear_right")], [("left_front", "right_front"), ("left_rear", "right_rear")],
    [("left", "right")], [("one",), ("two",)]], ids=lambda rows: rows[0][0])
def test_struts_without_positions_are_laid_out_by_their_names(page_of, rows):
    """Rows from ahead to behind, in each from left to right."""
    made = page_of(sorted(name for row in rows for name in row))
    assert made.page.one(id="script-errors").text == ""
    at = {name: tuple(float(each[f"data-{axis}"]) for axis in "xy") for name, each in wheels(made).items()}
    for row in rows:
        assert len({at[name][1] for name in row}) == 1
        assert [at[name][0] for name in row] == sorted({at[name][0] for name in row})
    heights = [at[row[0]][1] for row in rows]
    assert heights == sorted(set(heights))
    assert min((b - a for a, b in zip(heights, heights[1:])), default=42) >= 40


@pytest.mark.parametrize("count, settings", [
    (16, {}), (4, {"verdict": "cannot_tell", "reason": "are too short", "selected": []})])
def test_any_vehicle_has_room(page_of, count, settings):
    names = [f"a_rather_long_name_{i}_{side}" for i in range(count // 2) for side in ("left", "right")]
    made = page_of(names, **settings)
    root = browser.measured(made.path, made.folder / "measured", 390, False).one("html").attributes
    assert root["data-cut"] == ""
    assert made.page.one(id="script-errors").text == ""
    assert {each["data-verdict"] for each in wheels(made).values()} == {settings.get("verdict", "nothing_missing")}
    if settings:
        assert [each.text for each in made.page.one("svg").all("text", class_="word")] == count * ["Cannot tell"]
        assert list(made.page.all("a")) == [] and "are too short" in made.page.one(id="verdict").text


def test_known_forces_have_a_table(page_of):
    assert [] == list(page_of(["bare_1", "bare_2"]).page.all("section", id="forces"))
    names = ["pulled_1", "pulled_2"]
    forces = {"tow_bar": {"coefficients": dict(zip(names, [3.21e-4, -8.7e-5])), "stddevs": dict(zip(names, [2e-6, 3e-6]))},
              "crane": {"coefficients": dict.fromkeys(names, 0), "stddevs": dict.fromkeys(names)}}
    made = page_of(names, known_forces=forces)
    assert made.page.one(id="script-errors").text == ""
    rows = {row.attributes["data-force"]: [cell.text for cell in list(row.all("td"))[1:]]
            for row in made.page.one(id="forces").all("tr") if "data-force" in row.attributes}
    shown = [[float(each) for each in cell.replace("−", "-").split("±")] for cell in rows["tow_bar"]]
    assert shown == [pytest.approx([3.21e-4, 2e-6]), pytest.approx([-8.7e-5, 3e-6])]
    assert rows["crane"] == ["cannot tell", "cannot tell"]
    root = browser.measured(made.path, made.folder / "measured", 390, False).one("html").attributes
    assert root["data-cut"] == ""


def test_the_page_of_health_begins_with_the_corner_that_is_worse_than_its_levels(program, tmp_path):
    vehicle, bag = tmp_path / "v.yaml", tmp_path / "drive.bag"
    program.succeed("simulate", "--vehicle-model", "sedan", "--duration", "90", "--vehicle-file", vehicle, "-o", bag,
                    "--set", "struts/front_left/damping=1000")
    program.succeed("health", bag, "--vehicle", vehicle, "--report", tmp_path / "page")
    page = browser.shown(tmp_path / "page" / "report.html", tmp_path / "profile")
    assert page.one(id="script-errors").text == ""
    verdict = page.one("section", id="verdict")
    assert verdict.attributes["data-level"] in ("WARN", "ERROR")
    assert re.search(r"Over the drive, front left damping \d\d % below front right .*: damage", verdict.one("h1").text)
