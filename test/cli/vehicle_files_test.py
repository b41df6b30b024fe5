"""--vehicle: the files that commands write and read for the struts of a vehicle, and for one of them with --strut."""
import csv
import json
import types

import pytest
import yaml

import browser
import conftest

WORN_AT = 100.0  # [s]
LEVELS = ("OK", "WARN", "ERROR", "STALE")


@pytest.fixture(scope="module")
def vehicle(program, tmp_path_factory):
    """A half car whose rear damper loses half of itself, and what simulate says of its struts."""
    folder = tmp_path_factory.mktemp("vehicle")
    bag, path = folder / "drive.bag", folder / "vehicle.yaml"
    worn = [word for name, value in (("damping_end_fraction", 0.5), ("ramp_start", WORN_AT), ("ramp_end", WORN_AT))
            for word in ("--set", f"struts/rear/{name}={value}")]
    told = program.succeed("simulate", "--vehicle-model", "half_sedan", "--duration", "150", "--rate", "100", *worn, "-o",
                           bag, "--vehicle-file", path)
    truth = {line.split()[0]: tuple(map(float, line.split()[1:3])) for line in told.splitlines()[2:]}
    return types.SimpleNamespace(folder=folder, bag=bag, path=path, truth=truth, of=[bag, "--vehicle", path])


@pytest.fixture(scope="module")
def healthy(vehicle, tmp_path_factory):
    """A baseline file of the struts as they were built."""
    path = tmp_path_factory.mktemp("healthy") / "healthy.yaml"
    path.write_text(yaml.safe_dump({"struts": {
        name: {"damping_to_mass": b1, "stiffness_to_mass": b0} for name, (b1, b0) in vehicle.truth.items()}}))
    return path


@pytest.fixture(scope="module")
def watched(program, vehicle, healthy, tmp_path_factory):
    """health with every file that it writes."""
    folder = tmp_path_factory.mktemp("watched")
    text = program.succeed("health", *vehicle.of, "--baseline", healthy, "--csv", folder / "rows.csv", "--json",
                           folder / "result.json", "--report", folder / "page")
    return types.SimpleNamespace(folder=folder, text=text, rows=list(csv.DictReader((folder / "rows.csv").open())),
                                 result=json.loads((folder / "result.json").read_text())["struts"])


def test_health_judges_every_strut_by_its_own_baseline(watched, healthy):
    assert watched.text.count(f"judged by the baseline of {healthy}") == 2
    assert watched.result["front"]["end"]["level"] == "OK"
    assert watched.result["rear"]["end"]["level"] == "ERROR"
    assert "below baseline" in watched.result["rear"]["end"]["message"]


def test_health_table_has_the_events_of_every_strut(watched):
    assert list(watched.rows[0]) == ["time", "strut", "level", "message", "b1", "b0", "b1_stddev", "b0_stddev", "offset"]
    times = [float(row["time"]) for row in watched.rows]
    assert max(before - after for before, after in zip(times, times[1:])) < 2.0  # struts report at times of their own
    for name, strut in watched.result.items():
        own = [row for row in watched.rows if row["strut"] == name]
        changes = [row for row, before in zip(own, [{"level": None}, *own]) if row["level"] != before["level"]]
        assert [(row["level"], row["message"]) for row in changes] == [
            (event["level"], event["message"]) for event in strut["events"]]
        assert float(own[-1]["b1"]) == pytest.approx(strut["estimate"]["damping_to_mass"], abs=0.1)


def test_health_page_has_a_timeline_per_strut(watched):
    page = browser.shown(watched.folder / "page" / "report.html", watched.folder / "profile")
    assert page.one(id="script-errors").text == ""
    verdict = page.one("section", id="verdict")
    assert verdict.attributes["data-level"] == "ERROR" and "Rear: Error after" in verdict.one("h1").text
    worst = {row.attributes["data-strut"]: row.attributes["data-level"] for row in verdict.all("tr")
             if "data-strut" in row.attributes}
    assert worst == {"front": "OK", "rear": "ERROR"}
    assert len(list(page.one("section", id="levels").all("canvas"))) == 2
    for name, strut in watched.result.items():
        own = page.one("section", id=f"verdict-{name}")
        assert {each.attributes["data-level"]: float(each.attributes["data-seconds"]) for each in own.all("div")
                if "data-seconds" in each.attributes} == pytest.approx(strut["seconds"])
        rows = [row for row in page.one("section", id=f"events-{name}").all("tr") if "data-event" in row.attributes]
        assert [row.attributes["data-event"] for row in rows] == [event["level"] for event in strut["events"]]
        assert len(list(page.one("section", id=f"course-{name}").all("canvas"))) == 3
        page.one("section", id=f"estimates-{name}")
    for canvas in page.all("canvas"):
        pixels = int(canvas.attributes["width"]) * int(canvas.attributes["height"])
        assert int(canvas.attributes["data-painted"]) > 0.01 * pixels, canvas.attributes["aria-label"]


@pytest.mark.parametrize("width, dark", [(1400, False), (390, True)])
def test_nothing_is_cut_off(watched, width, dark):
    root = browser.measured(watched.folder / "page" / "report.html", watched.folder / "measured", width,
                            dark).one("html").attributes
    assert (root["data-cut"], root["data-scrolls"]) == ("", "0")


def test_health_of_one_strut_writes_the_files_of_one_strut(program, vehicle, healthy, watched, tmp_path):
    own = tmp_path / "rear.yaml"
    own.write_text(yaml.safe_dump(yaml.safe_load(healthy.read_text())["struts"]["rear"]))
    program.succeed("health", *vehicle.of, "--strut", "rear", "--baseline", own, "--csv", tmp_path / "rows.csv", "--json",
                    tmp_path / "result.json", "--report", tmp_path / "page")
    rows = list(csv.DictReader((tmp_path / "rows.csv").open()))
    assert rows == [{key: value for key, value in row.items() if key != "strut"} for row in watched.rows
                    if row["strut"] == "rear"]
    assert json.loads((tmp_path / "result.json").read_text())["struts"] == {"rear": watched.result["rear"]}
    page = browser.shown(tmp_path / "page" / "report.html", tmp_path / "profile")
    assert "Error after" in page.one("section", id="verdict").one("h1").text
    assert len(list(page.all("canvas"))) == 3


def test_settings_of_one_strut_are_those_of_the_live_vehicle(program, vehicle, tmp_path):
    """A baseline_file, nominal values, effects below struts/NAME."""
    settings = tmp_path / "struts.yaml"
    b1, b0 = vehicle.truth["rear"]
    settings.write_text(yaml.safe_dump({"struts": {"rear": {"nominal": {
        "damping_to_mass": b1, "stiffness_to_mass": b0}}, "front": {"effects": "quadratic_damping"}}}))
    text = program.succeed("health", *vehicle.of, "--config", settings)
    assert "rear, judged by nominal values" in text and "front, judged by the baseline learned" in text
    program.refuse(2, ["health", *vehicle.of, "--set", "struts/middle/effects=quadratic_damping"],
                   ["struts/middle", "front, rear"], tmp_path)


@pytest.fixture(scope="module")
def found(program, tmp_path_factory):
    """A vehicle with an effect at the front, and the models that diagnose finds."""
    folder = tmp_path_factory.mktemp("found")
    bag, path = folder / "drive.bag", folder / "vehicle.yaml"
    program.succeed("simulate", "--vehicle-model", "half_sedan", "--duration", "60", "--rate", "100", "--effect",
                    "front/quadratic_damping=2", "-o", bag, "--vehicle-file", path)
    program.succeed("diagnose", bag, "--vehicle", path, "-o", folder / "models.yaml", "--json", folder / "result.json")
    return types.SimpleNamespace(folder=folder, models=folder / "models.yaml", of=[bag, "--vehicle", path],
                                 result=json.loads((folder / "result.json").read_text()))


def test_models_of_all_struts_are_one_file(found):
    models = yaml.safe_load(found.models.read_text())
    assert list(models) == ["struts"] and set(models["struts"]) == {"front", "rear"}
    front = found.result["struts"]["front"]["extended"]
    assert models["struts"]["front"]["damping_to_mass"] == pytest.approx(front["parameters"]["damping_to_mass"])
    assert models["struts"]["front"]["effects"]["quadratic_damping"]["coefficient"] == pytest.approx(
        front["coefficients"]["quadratic_damping"])
    assert "effects" not in models["struts"]["rear"]


def rmse(program, found, folder, *options):
    program.succeed("compare", *found.of, *options, "--json", folder / "compared.json")
    struts = json.loads((folder / "compared.json").read_text())["struts"]
    return {name: strut["free_run"]["rmse"] for name, strut in struts.items()}


def test_compare_and_diagnose_take_the_models_that_diagnose_wrote(program, found, tmp_path):
    linear, own = rmse(program, found, tmp_path), rmse(program, found, tmp_path, "--model", found.models)
    assert own["front"] < 0.9 * linear["front"]
    assert own["rear"] < 1.05 * linear["rear"]
    program.succeed("diagnose", *found.of, "--model", found.models, "--json", tmp_path / "again.json")
    again = json.loads((tmp_path / "again.json").read_text())
    assert again["selected"] == {"front": [], "rear": []}


def test_health_takes_the_models_that_diagnose_wrote_as_settings(program, found):
    told = program.succeed("health", *found.of, "--config", found.models)
    assert told.count("judged by nominal values: damping/mass") == 2 and "ERROR        0.00" in told


def test_a_strut_without_a_model_has_the_linear_one(program, found, tmp_path):
    part = tmp_path / "part.yaml"
    part.write_text(yaml.safe_dump({"struts": {"front": yaml.safe_load(found.models.read_text())["struts"]["front"]}}))
    assert rmse(program, found, tmp_path, "--model", part)["front"] == pytest.approx(
        rmse(program, found, tmp_path, "--model", found.models)["front"], rel=0.01)


def test_with_strut_the_model_is_the_file_of_one_strut(program, found, tmp_path):
    program.succeed("diagnose", *found.of, "--strut", "front", "-o", tmp_path / "front.yaml")
    own = yaml.safe_load((tmp_path / "front.yaml").read_text())
    assert own == yaml.safe_load(found.models.read_text())["struts"]["front"]
    one, all_of = (rmse(program, found, tmp_path, "--strut", "front", "--model", path)
                   for path in (tmp_path / "front.yaml", found.models))
    assert set(one) == {"front"} and one["front"] == pytest.approx(all_of["front"], rel=0.01)


def test_rows_of_identify(program, found, tmp_path):
    program.succeed("identify", *found.of, "--csv", tmp_path / "all.csv", "--json", tmp_path / "result.json")
    program.succeed("identify", *found.of, "--strut", "rear", "--csv", tmp_path / "rear.csv")
    rows = list(csv.DictReader((tmp_path / "all.csv").open()))
    result = json.loads((tmp_path / "result.json").read_text())["struts"]
    assert list(rows[0])[:3] == ["time", "strut", "ls_damping_to_mass"]
    for name, strut in result.items():
        own = [row for row in rows if row["strut"] == name]
        assert len(own) == strut["rows"]
        assert float(own[-1]["la_damping_to_mass"]) == pytest.approx(strut["la"]["damping_to_mass"])
        assert sum(row["predicted"] != "nan" for row in own) > 0.8 * len(own)
    assert list(csv.DictReader((tmp_path / "rear.csv").open())) == [
        {key: value for key, value in row.items() if key != "strut"} for row in rows if row["strut"] == "rear"]


MODEL = "{damping_to_mass: 5, stiffness_to_mass: 60}"


@pytest.mark.parametrize("command, option", [("compare", "--model"), ("diagnose", "--model"), ("health", "--baseline")])
@pytest.mark.parametrize("text, words", [
    (MODEL, ["struts are missing", "--strut NAME"]),
    (f"struts: {{middle: {MODEL}}}", ["struts/middle", "front, rear"]),
    (f"struts: {{front: {MODEL}}}\neffects: none", ["effects stands beside struts"]),
    ("struts: {front: {damping_to_mass: 5}}", ["front", "stiffness_to_mass is missing"]),
    ("struts: {front: {damping_to_mass: 5, stiffness_to_mass: -60}}", ["front", "stiffness_to_mass = -60"]),
    ("struts: {front: {damping_to_mass: 5, stiffness_to_mass: 60, c: 1}}", ["front", "c"]),
    (None, ["cannot be read"])], ids=["of one strut", "unknown", "beside", "half", "negative", "more", "none"])
def test_files_that_cannot_be_are_refused(program, found, tmp_path, command, option, text, words):
    path = tmp_path / "file.yaml"
    if text is not None:
        path.write_text(text)
    program.refuse(2, [command, *found.of, option, path], [path, *words], tmp_path)


def test_a_file_without_the_strut_asked_for_is_refused(program, found, tmp_path):
    (tmp_path / "file.yaml").write_text(f"struts: {{rear: {MODEL}}}")
    program.refuse(2, ["compare", *found.of, "--strut", "front", "--model", tmp_path / "file.yaml"],
                   ["struts/front is missing", "--strut"], tmp_path)


def test_nominal_values_beside_a_baseline_are_refused(program, vehicle, healthy, tmp_path):
    program.refuse(2, ["health", *vehicle.of, "--baseline", healthy, "--set", "nominal/damping_to_mass=3"],
                   ["baseline_file", "must be one of them", "take nominal, which identify -o writes, out"], tmp_path)


@pytest.mark.parametrize("command, inputs, outputs", [
    ("diagnose", "--model", ["-o", "--json"]), ("health", "--baseline", ["--csv", "--json"]),
    ("identify", "--vehicle", ["--csv", "--json"])])
def test_an_output_is_never_an_input(program, found, tmp_path, command, inputs, outputs):
    own = tmp_path / "own.yaml"
    own.write_text(f"struts: {{front: {MODEL}}}")
    bag, _, layout = found.of
    given = [bag, "--vehicle", own if inputs == "--vehicle" else layout]
    for output in outputs:
        program.refuse(2, [command, *given, *([] if inputs == "--vehicle" else [inputs, own]), output, own],
                       [own, "of its own"], tmp_path)


@pytest.mark.parametrize("command, inputs", [("diagnose", "--model"), ("health", "--baseline")])
def test_a_page_is_never_an_input(program, found, tmp_path, command, inputs):
    (tmp_path / "report.html").write_text(f"struts: {{front: {MODEL}}}")
    program.refuse(2, [command, *found.of, inputs, tmp_path / "report.html", "--report", tmp_path],
                   ["--report", "of its own"], tmp_path)


def test_files_of_a_failed_run_do_not_appear(program, vehicle, tmp_path):
    (tmp_path / "rows.csv").write_text("of yesterday\n")
    before = conftest.snapshot(tmp_path)
    told = program("health", *vehicle.of, "--end", "0.5", "--csv", tmp_path / "rows.csv", "--json",
                   tmp_path / "result.json", "--report", tmp_path / "page")
    assert told.returncode == 4
    assert conftest.snapshot(tmp_path) == before and not (tmp_path / "page").exists()
