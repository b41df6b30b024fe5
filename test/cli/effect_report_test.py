"""suspension_bag diagnose --report: what the page shows in a browser."""
import base64
import json
import math
import re
import shlex
import types

import pytest
import rosbag

import browser

DRIVE = ["--scenario", "iso_road", "--vehicle", "rover", "--rate", "100", "--duration", "60"]
MOST_BYTES = 5_000_000


def disturb(clean, disturbed):
    """Adds to the body's reading what no effect of the strut explains: a tone that swells and wanders."""
    with rosbag.Bag(str(clean)) as source, rosbag.Bag(str(disturbed), "w") as target:
        for topic, message, time in source.read_messages():
            if topic == "/sprung/imu":
                t = message.header.stamp.to_sec()
                tone = math.sin(2 * math.pi * (3.3 * t + 0.7 * math.sin(0.31 * t)))
                message.linear_acceleration.z += 0.6 * tone * math.sin(0.17 * t)
            target.write(topic, message, time)


def make_bags(program, folder, case):
    """Drives by the name of the case."""
    bag = folder / "drive <b>&'\"$.bag"
    if case == "several":
        bags = [bag, folder / "second.bag"]
        for seed, path in enumerate(bags):
            drive = [*DRIVE[:-1], "30"] if seed else DRIVE
            program.succeed("simulate", *drive, "--seed", seed + 1, "--effect", "asymmetric_damping=1.3", "--effect",
                            "bump_stop=90,g=0.012", "-o", path)
        return bags
    hidden = {"friction": ["--effect", "coulomb_friction=0.35,vs=0.02"]}.get(case, [])
    program.succeed("simulate", *DRIVE, *hidden, "-o", bag)
    if case == "unexplained":
        bag.rename(folder / "clean.bag")
        disturb(folder / "clean.bag", bag)
    return [bag]


@pytest.fixture(scope="module", params=["friction", "nothing", "unexplained", "several"])
def report(request, program, tmp_path_factory):
    """A case with its result as --json has it, the file of the page, and what a browser makes of it."""
    folder = tmp_path_factory.mktemp(request.param)
    bags = make_bags(program, folder, request.param)
    told = program.succeed("diagnose", *bags, "--json", folder / "result.json", "--report", folder / "page")
    path = folder / "page" / "report.html"
    return types.SimpleNamespace(case=request.param, bags=bags, path=path, told=told,
                                 result=json.loads((folder / "result.json").read_text()),
                                 page=browser.shown(path, folder / "profile"))


def test_scripts_run_without_an_error(report):
    assert report.page.one(id="script-errors").text == ""
    assert report.page.one("html").attributes["data-ready"] == "yes"


def test_file_needs_nothing_else_and_is_small(report):
    text = report.path.read_text()
    assert len(text.encode()) <= MOST_BYTES
    assert not re.search(r"(?:src|href)=|@import|url\(|fetch\(|XMLHttpRequest|https?://", text)
    assert [path.name for path in report.path.parent.iterdir()] == ["report.html"]


def test_verdict_is_in_words(report):
    verdict = report.page.one("section", id="verdict")
    assert verdict.attributes["data-verdict"] == report.result["verdict"]
    heading = verdict.one("h1").text
    if report.case == "friction":
        assert "Missing from the model: dry friction" in heading
        assert "seal, bent rod, top mount" in verdict.text
        assert verdict.one("b", data_effect="coulomb_friction").text == "Coulomb friction"
    elif report.case == "nothing":
        assert "Nothing is missing" in heading
        assert "What to do next" in verdict.text
    elif report.case == "unexplained":
        assert "no known effect explains it" in heading
        assert "What to do next" in verdict.text
    else:
        assert {each.attributes["data-effect"] for each in verdict.all("b") if "data-effect" in each.attributes} == {
            "asymmetric_damping", "bump_stop"}


def test_ladder_has_the_numbers_of_the_result(report):
    steps = [float(each.attributes["data-rmse"]) for each in report.page.one(id="ladder").all("dd")]
    result = report.result
    assert steps[0] == result["base"]["held_out_rmse"]
    assert steps[-1] == result["noise_floor"]
    assert len(steps) == 2 + len(result["selected"])
    if result["selected"]:
        assert steps[-2] == result["extended"]["held_out_rmse"]
    written = [re.search(r"([0-9.]+) (m?)m/s²", each.text) for each in report.page.one(id="ladder").all("dd")]
    for step, text in zip(steps, written):
        assert float(text[1]) * (1e-3 if text[2] else 1.0) == pytest.approx(step, rel=0.005)


def test_every_candidate_has_its_row(report):
    rows = [each for each in report.page.one(id="ranking").all("tr") if "data-candidate" in each.attributes]
    ranking = report.result["ranking"]
    assert [row.attributes["data-candidate"] for row in rows] == [each["effects"][-1] for each in ranking]
    assert [float(row.attributes["data-rmse"]) for row in rows] == [each["held_out_rmse"] for each in ranking]
    chosen = {row.attributes["data-candidate"] for row in rows if row.attributes.get("class") == "chosen"}
    assert chosen == set(report.result["selected"])


def test_no_figure_is_empty(report):
    canvases = list(report.page.all("canvas"))
    expected = 2 + 2 + {"friction": 3 + 2 + 1 + 2 + 2, "several": 3 + 2 + 2 + 2 + 2}.get(report.case, 3 + 1 + 2 + 2)
    assert len(canvases) == expected
    for canvas in canvases:
        assert canvas.attributes["aria-label"]
        pixels = int(canvas.attributes["width"]) * int(canvas.attributes["height"])
        assert int(canvas.attributes["data-painted"]) > 0.01 * pixels, canvas.attributes["aria-label"]
        assert int(canvas.attributes["data-colours"]) > 20, canvas.attributes["aria-label"]


def test_every_picture_and_its_numbers_can_be_saved(report, tmp_path):
    saved = browser.saved(report.path, tmp_path / "saved")
    assert len(saved) == len(list(report.page.all("canvas")))
    for figure in saved:
        assert base64.b64decode(figure["PNG"].split(",")[1])[1:4] == b"PNG" and len(figure["PNG"]) > 1000, figure["name"]
        lines = figure["CSV"].splitlines()
        assert len(lines) > 10 and {line.count(",") for line in lines[:1]} == {4}, figure["name"]
    head, *lines = next(figure["CSV"] for figure in saved if figure["name"].endswith(": acceleration")).splitlines()
    assert head == "series,time [s],acceleration [m/s^2],low,high"
    measured = [line.split(",") for line in lines if line.startswith("measured,")]
    assert len(measured) > 5000, "every sample of 60 s at 100 Hz"
    assert max(abs(float(row[2])) for row in measured) < 50


def test_page_tells_what_it_was_made_from(report):
    origin = report.page.one(id="origin").text
    assert "suspension_bag diagnose" in origin and "--report" in origin
    assert "/sprung/imu , /unsprung/imu" in origin
    assert re.search(r"made 20\d\d-\d\d-\d\d \d\d:\d\d:\d\d UTC by suspension_bag \d", origin)
    assert re.search(r"stamps \S+ s to \S+ s", origin)


def test_errors_have_one_unit(report):
    text = " ".join(report.page.one(id=name).text for name in ("verdict", "ladder", "where", "ranking"))
    assert "mm/s²" not in text and "m/s²" in text


def test_page_and_terminal_tell_the_same_share_of_the_error(report):
    """Of every candidate that was fitted; of what was found, too, where that is one effect."""
    told = dict(re.findall(r"^(\w+)[ ~]+[\d.]+ +(-?[\d.]+) %   ", report.told, re.MULTILINE))
    rows = [list(row.all("td")) for row in report.page.one(id="ranking").all("tr")][1:]
    shown = {cells[1].one("b").text.replace(" ", "_"): cells[3].text.replace("\u2212", "-").split()[0] for cells in rows}
    assert told and {name: shown[name] for name in told} == told
    if len(report.result["selected"]) == 1:
        assert f"of the error removed {told[report.result['selected'][0]]}" in report.page.one(id="verdict").text


def test_workshop_is_told_what_to_check(report):
    advice = [each.text for each in report.page.one(id="verdict").all(class_="advice")]
    assert len(advice) == len(report.result["selected"])
    if report.case == "friction":
        assert advice[0].startswith("A little is design of any seal; more than when new is wear: check for a bent")
    if report.case == "several":
        assert any("Design of most dampers" in each for each in advice)


def test_commands_are_of_the_shell_alone(report):
    blocks = [each.text for each in report.page.one(id="adding").all("pre")]
    assert blocks[0].startswith("damping_to_mass:")
    for block in blocks[1:]:
        assert re.match(r"(rosrun|roslaunch|rosservice) ", block), block
    assert "model_file:=$PWD/model.yaml" in blocks[-1]


def test_commands_of_the_page_work_where_the_search_did(program, tmp_path):
    program.succeed("simulate", *DRIVE[:-1], "30", "-o", tmp_path / "simulated.bag")
    with rosbag.Bag(str(tmp_path / "simulated.bag")) as bag, rosbag.Bag(str(tmp_path / "drive.bag"), "w") as renamed:
        for topic, message, time in bag.read_messages(["/sprung/imu", "/unsprung/imu"]):
            renamed.write("/robot" + topic, message, time)
    (tmp_path / "my strut.yaml").write_text("sprung_axis: z\n")
    given = ["--sprung-topic", "/robot/sprung/imu", "--unsprung-topic=/robot/unsprung/imu", "--config", "my strut.yaml",
             "--set", "memory=3"]
    assert program("diagnose", "drive.bag", *given, "--report", "page", cwd=tmp_path).returncode == 0
    page = browser.shown(tmp_path / "page" / "report.html", tmp_path / "profile")
    write, compare, *_, live = [each.text for each in page.one(id="adding").all("pre")][1:]
    for command in (write, compare.replace("another_drive.bag", "drive.bag")):
        tool, *arguments = shlex.split(command)[2:]
        done = program(*arguments, cwd=tmp_path)
        assert (tool, done.returncode, done.stderr) == ("suspension_bag", 0, "")
    assert "sprung_imu:=/robot/sprung/imu unsprung_imu:=/robot/unsprung/imu config:=$PWD/'my strut.yaml'" in live


@pytest.mark.parametrize("width, dark", [(1400, False), (390, True)])  # colours move nothing
def test_nothing_is_cut_off_and_the_verdict_is_above_the_fold(report, tmp_path, width, dark):
    root = browser.measured(report.path, tmp_path / "measured", width, dark).one("html").attributes
    assert (root["data-width"], root["data-dark"]) == (str(width), str(dark).lower())
    assert (root["data-cut"], root["data-scrolls"]) == ("", "0")
    assert 0 < float(root["data-verdict-ends"]) <= 900


def test_parameters_and_model_file_are_those_of_the_result(report):
    model = report.page.one(id="adding").text
    parameters = (report.result.get("extended") or report.result["base"])["parameters"]
    for name, value in parameters.items():
        assert float(re.search(rf"{name}: (\S+)", model)[1]) == pytest.approx(value, rel=1e-12)
    assert ("set_effects" in model) == bool(report.result["selected"])
    added = report.result.get("extended", {"coefficients": {}, "shapes": {}})
    lines = len(list(report.page.one(id="parameters").all("tr"))) - 1
    assert lines == len(parameters) + len(added["coefficients"]) + len(added["shapes"])


def test_drives_are_named_as_they_are(report):
    for bag in report.bags:
        assert bag.name in report.page.one("p", class_="source").text
    options = [each.text for each in report.page.one(id="time").all("option")]
    assert options == ([bag.name for bag in report.bags] if len(report.bags) > 1 else [])


def test_page_that_cannot_be_written_is_refused_before_the_search(program, tmp_path):
    program.succeed("simulate", *DRIVE, "-o", tmp_path / "drive.bag")
    (tmp_path / "file").write_text("here first")
    for folder in (tmp_path / "file", tmp_path / "no" / "folder"):
        program.refuse(3, ["diagnose", tmp_path / "drive.bag", "--report", folder], [folder, "cannot be made"], tmp_path)


def test_nothing_is_left_of_a_search_that_fails(program, tmp_path):
    program.succeed("simulate", *DRIVE[:-1], "3", "-o", tmp_path / "short.bag")
    program.refuse(4, ["diagnose", tmp_path / "short.bag", "--report", tmp_path / "page"], [], tmp_path)
    assert not (tmp_path / "page").exists()
