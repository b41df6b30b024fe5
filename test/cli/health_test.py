"""suspension_bag health: the times are those of the drive, add up, and say the same in every form."""
import csv
import itertools
import json
import re
import types

import numpy as np
import pytest
import rosbag
import yaml

import browser
import imu_bag
from conftest import PAPER_SETTINGS

# As test/ros/damper_wear_test.py has it: damping falls from 3 to 2 1/s between 40 s and 100 s, 15 % at 67 s, 30 % at 94 s.
WARN_TIME, ERROR_TIME = 67.0, 94.0
SLACK, LAG = 9.6, 3.2
START = 1000.0  # [s] first stamp
DURATION = 120.0
TIMEOUT = 2.0  # input_timeout
SETTINGS = ["--config", PAPER_SETTINGS]
B1, B0 = 3.0, 13.8


def simulate(program, path, *more, start=START, duration=DURATION, left=2 / 3):
    program.succeed("simulate", "--scenario", "paper_clean", "--duration", duration, "--set", f"start_time={start}",
                    "--set", f"damping_end_fraction={left}", *more, "-o", path)
    return path


def health(program, folder, bags, *arguments):
    """What it says of the bags: text, result (--json), rows (--csv)."""
    text = program.succeed("health", *bags, *arguments, "--json", folder / "result.json", "--csv", folder / "rows.csv")
    with open(folder / "rows.csv", encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    return types.SimpleNamespace(text=text, result=json.loads((folder / "result.json").read_text()), rows=rows)


def levels(said):
    return [event["level"] for event in said.result["events"]]


def changes(rows):
    """The rows whose level differs from the one before."""
    before = [None] + [row["level"] for row in rows]
    return [row for row, level in zip(rows, before) if row["level"] != level]


@pytest.fixture(scope="module")
def worn_bag(program, tmp_path_factory):
    # Of one seed in thirteen the warning is more than 9.6 s late, with the paper's settings.
    return simulate(program, tmp_path_factory.mktemp("worn") / "worn.bag", "--seed", 4)


@pytest.fixture(scope="module")
def healthy_bag(program, tmp_path_factory):
    return simulate(program, tmp_path_factory.mktemp("healthy") / "healthy <b>&'\"$.bag", left=1)


@pytest.fixture(scope="module")
def worn(program, worn_bag, tmp_path_factory):
    return health(program, tmp_path_factory.mktemp("said"), [worn_bag], *SETTINGS)


def test_wear_is_told_when_it_comes(worn):
    assert levels(worn) == ["STALE", "OK", "WARN", "ERROR"]
    times = [event["time"] - START for event in worn.result["events"]]
    assert times[0] == pytest.approx(0.0, abs=1e-6)
    # Of a bounce of 0.6 Hz: 4 s until blocks of 2 s know it, then two blocks of 4 s and a reading or so that closes them.
    assert times[1] < 4.0 + 8.0 + 1.0
    for time, truth in zip(times[2:], (WARN_TIME, ERROR_TIME)):
        assert truth - SLACK < time < truth + SLACK + LAG
    assert re.match(r"damping 3\d % below nominal", worn.result["events"][-1]["message"])
    assert worn.result["early_warnings"] == 1
    assert (worn.result["warn_events"], worn.result["error_events"]) == (1, 1)


def test_healthy_drive_has_no_warning(program, healthy_bag, tmp_path):
    said = health(program, tmp_path, [healthy_bag], *SETTINGS)
    assert levels(said) == ["STALE", "OK"]
    assert (said.result["warn_events"], said.result["error_events"], said.result["early_warnings"]) == (0, 0, 0)


def test_seconds_add_up_and_are_those_between_the_events(worn):
    seconds = worn.result["seconds"]
    assert set(seconds) == {"OK", "WARN", "ERROR", "STALE"}
    assert sum(seconds.values()) == pytest.approx(DURATION, abs=1e-6)
    events = worn.result["events"]
    ends = [event["time"] for event in events[1:]] + [START + DURATION]
    for event, end in zip(events, ends):  # each level comes once
        assert seconds[event["level"]] == pytest.approx(end - event["time"], abs=1e-6)


def test_table_has_every_second_and_the_events_of_the_result(worn):
    assert list(worn.rows[0]) == ["time", "level", "message", "b1", "b0", "b1_stddev", "b0_stddev", "offset"]
    times = [float(row["time"]) for row in worn.rows]
    assert all(0.0 < later - before <= 1.021 for before, later in zip(times, times[1:]))
    assert times[-1] > START + DURATION - 1.1
    assert [(float(row["time"]), row["level"], row["message"]) for row in changes(worn.rows)] == [
        (pytest.approx(event["time"], abs=1e-6), event["level"], event["message"]) for event in worn.result["events"]]


def test_estimates_are_those_of_the_drive(worn):
    last, estimate = worn.rows[-1], worn.result["estimate"]
    assert float(last["b1"]) == pytest.approx(2.0, abs=0.4)
    assert float(last["b0"]) == pytest.approx(B0, rel=0.1)
    assert estimate["damping_to_mass"] == pytest.approx(float(last["b1"]), abs=float(last["b1_stddev"]))
    assert 0.0 < estimate["damping_to_mass_stddev"] < 1.0
    b1, stddev = re.search(r"^estimate: damping/mass (\S+) \+- (\S+) 1/s", worn.text, re.MULTILINE).groups()
    assert (float(b1), float(stddev)) == pytest.approx(
        (estimate["damping_to_mass"], estimate["damping_to_mass_stddev"]), abs=1e-4)
    assert set(estimate["friction"]) == {"force", "stddev", "damping_gain"}
    assert abs(estimate["delay"]) < 3 * estimate["delay_stddev"] and "late" not in worn.text
    assert estimate["explained"] > 0.9 and 0 < estimate["age"] < estimate["window"] and estimate["reason"] == ""


def test_offset_between_the_sensors_is_in_the_table(program, tmp_path):
    times, body, wheel = imu_bag.paper_drive()
    bag = imu_bag.write_bag(tmp_path / "offset.bag", (times, body, wheel + 0.3))
    said = health(program, tmp_path, [bag], "--set", f"nominal/damping_to_mass={B1}")
    assert float(said.rows[-1]["offset"]) == pytest.approx(0.3, abs=0.03)


def test_text_has_a_line_per_event_and_the_sums(worn):
    for event in worn.result["events"]:
        line = re.escape(f"{event['time']:.2f}") + rf" +{event['time'] - START:.2f}  {event['level']} +" + re.escape(
            event["message"])
        assert re.search(line, worn.text)
    for level, seconds in worn.result["seconds"].items():
        shown, count = re.search(rf"^{level} +(\S+) +\d+ % +(\d+)$", worn.text, re.MULTILINE).groups()
        assert float(shown) == pytest.approx(seconds, abs=0.006)
        assert int(count) == levels(worn).count(level)
    assert "early warnings 1, the first at 10" in worn.text
    assert max(map(len, worn.text.splitlines())) <= 160


def test_settings_decide(program, worn_bag, worn, tmp_path):
    settings = yaml.safe_load(PAPER_SETTINGS.read_text())
    nominal = [f"nominal/{name}={value}" for name, value in settings.pop("nominal").items()]
    (tmp_path / "rest.yaml").write_text(yaml.safe_dump(settings))

    def said(*assignments):
        arguments = [word for assignment in assignments for word in ("--set", assignment)]
        return health(program, tmp_path, [worn_bag], "--config", tmp_path / "rest.yaml", *arguments)
    assert said(*nominal).result == worn.result
    assert "ERROR" not in levels(said(*nominal, "health/damping_error=0.5"))
    stiffer = said("nominal/damping_to_mass=2", "health/payload_range=0").result
    assert re.match(r"damping (4|5)\d % above nominal", stiffer["events"][1]["message"])
    assert (stiffer["events"][1]["level"], stiffer["events"][-1]["level"] == "ERROR") == ("ERROR", False)


@pytest.mark.parametrize("complete", [True, False])
def test_only_a_complete_model_has_nominal_values(program, healthy_bag, tmp_path, complete):
    (tmp_path / "model.yaml").write_text(f"damping_to_mass: 1.5\nstiffness_to_mass: {B0}\n"
                                         f"complete: {str(complete).lower()}\n")
    said = health(program, tmp_path, [healthy_bag], "--config", tmp_path / "model.yaml")
    assert ("ERROR" in levels(said)) == complete
    assert any("learning the baseline" in event["message"] for event in said.result["events"]) != complete


def test_start_and_end_choose_a_part(program, worn_bag, tmp_path):
    said = health(program, tmp_path, [worn_bag], *SETTINGS, "--start", 10, "--end", 50)
    assert levels(said) == ["STALE", "OK"]
    assert said.result["events"][0]["time"] == pytest.approx(START + 10, abs=0.021)
    assert sum(said.result["seconds"].values()) == pytest.approx(40.0, abs=0.021)


BASELINE = f"damping_to_mass: {B1}\ndamping_to_mass_stddev: 0.03\nstiffness_to_mass: {B0}\nstiffness_to_mass_stddev: 0.1\n"
BY_BLOCKS = "friction_damping_covariance: 0\n"  # what files of former estimators do not have


def test_baseline_file_is_what_is_judged_by(program, worn_bag, tmp_path):
    path = tmp_path / "strut.yaml"
    path.write_text(BASELINE + BY_BLOCKS)
    said = health(program, tmp_path, [worn_bag], "--baseline", path)
    assert f"judged by the baseline of {path}: damping/mass 3 +- 0.03 1/s" in said.text
    assert levels(said)[-1] == "ERROR"
    assert re.match(r"damping 3\d % below baseline", said.result["events"][-1]["message"])
    assert health(program, tmp_path, [worn_bag], "--set", f"baseline_file={path}").result == said.result
    assert path.read_text() == BASELINE + BY_BLOCKS
    path.write_text(BASELINE)
    widened = np.hypot(0.03, 0.02 * B1)  # by 2 % between the estimators
    assert f"damping/mass 3 +- {widened:.2g} 1/s" in health(program, tmp_path, [worn_bag], "--baseline", path).text


def test_friction_that_the_baseline_had_on_a_smoother_road_is_taken_out_of_it(program, worn_bag, tmp_path):
    """Dampers are compared as they act on a road between the two: friction f as f m, m the mean of both gains."""
    def worn(text):
        path = tmp_path / "strut.yaml"
        path.write_text(BASELINE + text)
        result = health(program, tmp_path, [worn_bag], "--baseline", path).result
        return int(re.match(r"damping (\d+) % below baseline", result["end"]["message"])[1]), result["estimate"]

    force, gain = 0.02, 20.0
    friction = f"dry_friction: {force}\ndry_friction_stddev: 0.001\nfriction_damping_gain: {gain}\n"
    lost, now = worn(friction + BY_BLOCKS)
    between = (gain + now["friction"]["damping_gain"]) / 2
    acts = now["damping_to_mass"] + now["friction"]["force"] * between
    assert lost == pytest.approx(100 * (1 - acts / (B1 + force * between)), abs=0.6)
    former, _ = worn(friction + "friction_stiffness_gain: 0\n")  # its b1 has the friction's share in it
    assert former == pytest.approx(100 * (1 - acts / (B1 - force * gain + force * between)), abs=0.6)
    assert lost - former > 6


@pytest.mark.parametrize("text, words", [
    (None, ["must be a YAML file"]), ("damping_to_mass: -3\nstiffness_to_mass: 13.8\n", ["damping_to_mass = -3"]),
    ("damping_to_mass: 3\n", ["stiffness_to_mass is missing"]), ("{", ["line 1"])])
def test_baseline_file_that_cannot_be_is_refused(program, worn_bag, tmp_path, text, words):
    path = tmp_path / "strut.yaml"
    if text is not None:
        path.write_text(text)
    program.refuse(2, ["health", worn_bag, "--baseline", path, "--csv", tmp_path / "rows.csv"], [path, *words], tmp_path)


def test_nominal_values_beside_a_baseline_are_refused(program, worn_bag, tmp_path):
    (tmp_path / "strut.yaml").write_text(BASELINE)
    program.refuse(2, ["health", worn_bag, *SETTINGS, "--baseline", tmp_path / "strut.yaml"],
                   ["baseline_file", "must be one of them"], tmp_path)


def test_a_baseline_is_learned_as_live_but_not_written(program, healthy_bag, tmp_path):
    said = health(program, tmp_path, [healthy_bag], "--set", "baseline/learn_time=30", "--set",
                  f"baseline_file={tmp_path / 'strut.yaml'}")
    assert re.search(r"judged by the baseline learned from 10\d\d\.\d\d s to 10\d\d\.\d\d s: damping/mass (2\.9|3\.0)", said.text)
    assert re.match("damping .* baseline", said.rows[-1]["message"])
    assert not (tmp_path / "strut.yaml").exists()


def test_without_anything_to_judge_by_that_is_said(program, healthy_bag, tmp_path):
    said = health(program, tmp_path, [healthy_bag], "--set", "baseline/learn_time=0")
    assert "judged by nothing" in said.text
    assert "no nominal values" in said.result["events"][-1]["message"]


def copied(source, target, keep):
    """A bag with the messages that keep(topic, seconds after START) accepts."""
    with rosbag.Bag(str(source)) as messages, rosbag.Bag(str(target), "w") as bag:
        for topic, message, time in messages.read_messages():
            if not topic.startswith("/simulator") and keep(topic, message.header.stamp.to_sec() - START):
                bag.write(topic, message, time)
    return target


def test_silence_is_not_health(program, healthy_bag, tmp_path):
    bag = copied(healthy_bag, tmp_path / "gap.bag", lambda _, time: not 60.0 < time < 75.0)
    said = health(program, tmp_path, [bag], *SETTINGS)
    silent = next(event for event in said.result["events"] if "no reading accepted for 15 s" in event["message"])
    assert silent["level"] == "STALE"
    assert silent["time"] - START == pytest.approx(60.0 + TIMEOUT, abs=0.021)
    assert re.search(r"before: damping (at|[1-3] % below) nominal", silent["message"])  # known to 1.4 %
    assert sum(said.result["seconds"].values()) == pytest.approx(DURATION, abs=1e-6)
    assert said.result["seconds"]["STALE"] >= 15.0 - TIMEOUT
    assert levels(said)[-1] == "OK" and set(levels(said)) == {"STALE", "OK"}


@pytest.mark.parametrize("changed", [lambda k: k == 6000, lambda k: k == 11000, lambda k: k >= 6000],
                         ids=["one", "the last", "the clock is set"])
def test_stamps_of_another_age_are_no_years(program, healthy_bag, tmp_path, changed):
    with rosbag.Bag(str(healthy_bag)) as source, rosbag.Bag(str(tmp_path / "years.bag"), "w") as bag:
        messages = source.read_messages([imu_bag.SPRUNG, imu_bag.UNSPRUNG])
        for k, (topic, message, time) in enumerate(itertools.islice(messages, 11001)):
            if changed(k):
                message.header.stamp.secs += 1_700_000_000
            bag.write(topic, message, time)
    said = health(program, tmp_path, [tmp_path / "years.bag"], *SETTINGS)
    assert sum(said.result["seconds"].values()) == pytest.approx(110.0, abs=0.1)
    assert said.result["seconds"]["OK"] > 110.0 - 2 * 13.0  # each clock begins with what it does not know yet
    assert said.result["end"]["level"] == "OK"


@pytest.mark.parametrize("dead", [imu_bag.SPRUNG, imu_bag.UNSPRUNG])
def test_a_sensor_that_dies_leaves_the_rest_unknown(program, healthy_bag, tmp_path, dead):
    bag = copied(healthy_bag, tmp_path / "dead.bag", lambda topic, time: topic != dead or 20.0 < time < 60.0)
    said = health(program, tmp_path, [bag], *SETTINGS)
    assert levels(said) == ["STALE", "OK", "STALE"]
    assert said.result["events"][-1]["time"] - START == pytest.approx(60.0 + TIMEOUT, abs=0.05)
    assert sum(said.result["seconds"].values()) == pytest.approx(DURATION, abs=1e-6)
    assert said.result["seconds"]["OK"] <= 42.0
    assert "no reading accepted for 60 s" in said.result["end"]["message"]


@pytest.mark.parametrize("first_start", [100.0, 5000.0], ids=["in order", "the later one first"])
def test_several_bags_are_one_drive_after_the_other(program, worn_bag, tmp_path, first_start):
    first = simulate(program, tmp_path / "first.bag", "--seed", 2, start=first_start, duration=60, left=1)
    alone = health(program, tmp_path, [first], *SETTINGS)
    said = health(program, tmp_path, [first, worn_bag], *SETTINGS)
    assert said.result["events"][:2] == alone.result["events"]
    assert [event["level"] for event in said.result["events"] if event["time"] >= START + 20.0][-1] == "ERROR"
    assert sum(said.result["seconds"].values()) == pytest.approx(60.0 + DURATION, abs=1e-6)
    assert re.search(r"^ +1\d\d\d\.\d\d +1\d\d\.\d\d  ERROR", said.text, re.MULTILINE)  # 60 s later than by its stamp


def test_parked_is_a_result(program, tmp_path):
    noise = np.random.default_rng(1).normal(0.0, 0.02, (2, 3000))
    bag = imu_bag.write_bag(tmp_path / "parked.bag", (0.02 * np.arange(3000), *noise))
    said = health(program, tmp_path, [bag], "--set", f"nominal/damping_to_mass={B1}")
    assert levels(said) == ["STALE"]
    assert said.result["seconds"] == {"OK": 0.0, "WARN": 0.0, "ERROR": 0.0, "STALE": pytest.approx(59.98, abs=1e-6)}
    assert said.rows[-1]["message"].startswith("cannot tell: ")
    assert said.result["end"] == {"level": "STALE", "message": said.rows[-1]["message"], "time": pytest.approx(
        1_700_000_000 + 59.98, abs=1e-6), "elapsed": pytest.approx(59.98, abs=1e-6)}
    assert "at the end STALE: " + said.rows[-1]["message"] in said.text


def test_bags_that_tell_nothing_are_refused_and_leave_nothing(program, worn_bag, paper_bag, tmp_path):
    with rosbag.Bag(str(tmp_path / "empty.bag"), "w"):
        pass
    (tmp_path / "broken.bag").write_bytes(worn_bag.read_bytes()[:100_000])
    (tmp_path / "rows.csv").write_text("of yesterday\n")
    outputs = ["--csv", tmp_path / "rows.csv", "--json", tmp_path / "result.json", "--report", tmp_path / "page"]

    def refuse(status, arguments, *words):
        program.refuse(status, ["health", *arguments, *outputs], words, tmp_path)
        assert not (tmp_path / "page").exists()
    refuse(4, [tmp_path / "empty.bag"], "empty.bag", "no messages")
    refuse(4, [paper_bag, *SETTINGS, "--end", "1"], "no regression row")
    refuse(4, [paper_bag, "--end", "0.5"], "sample period cannot be measured")
    refuse(3, [tmp_path / "broken.bag"], "broken.bag")
    refuse(3, [paper_bag, tmp_path / "none.bag"], "none.bag")
    refuse(3, [paper_bag, "--sprung-topic", "/body/imu"], "/body/imu", "Imu topics in this bag", imu_bag.SPRUNG)
    refuse(2, [paper_bag, "--set", "forgetting_factor=1.2"], "forgetting_factor = 1.2")
    refuse(2, [paper_bag, "--set", "sample_period=2"], "integration_horizon")


def test_other_topics(program, worn_bag, worn, tmp_path):
    names = {imu_bag.SPRUNG: "/body", imu_bag.UNSPRUNG: "/axle"}
    with rosbag.Bag(str(worn_bag)) as messages, rosbag.Bag(str(tmp_path / "named.bag"), "w") as bag:
        for topic, message, time in messages.read_messages(list(names)):
            bag.write(names[topic], message, time)
    said = health(program, tmp_path, [tmp_path / "named.bag"], *SETTINGS, "--sprung-topic", "/body", "--unsprung-topic",
                  "/axle")
    assert said.result == worn.result


@pytest.mark.parametrize("option", ["--csv", "--json"])
def test_an_output_is_never_an_input(program, worn_bag, tmp_path, option):
    (tmp_path / "strut.yaml").write_text(BASELINE)
    program.refuse(2, ["health", worn_bag, "--baseline", tmp_path / "strut.yaml", option, tmp_path / "strut.yaml"],
                   [option, "of its own"], tmp_path)


@pytest.fixture(scope="module", params=["worn", "healthy", "two", "parked"])
def page(request, program, worn_bag, healthy_bag, tmp_path_factory):
    """A case with its result, and the file of its page."""
    folder = tmp_path_factory.mktemp(request.param)
    bags, arguments = {"worn": ([worn_bag], SETTINGS), "healthy": ([healthy_bag], []),
                       "two": ([healthy_bag, worn_bag], SETTINGS), "parked": ([folder / "parked.bag"], [])}[request.param]
    noise = np.random.default_rng(1).normal(0.0, 0.02, (2, 3000))
    imu_bag.write_bag(folder / "parked.bag", (0.02 * np.arange(3000), *noise))
    said = health(program, folder, bags, *arguments, "--report", folder / "page")
    return types.SimpleNamespace(case=request.param, bags=bags, folder=folder, path=folder / "page" / "report.html",
                                 result=said.result)


def test_page_needs_nothing_else(page):
    text = page.path.read_text()
    assert len(text.encode()) <= 1_000_000
    assert not re.search(r"(?:src|href)=|@import|url\(|fetch\(|XMLHttpRequest|https?://", text)
    assert [path.name for path in page.path.parent.iterdir()] == ["report.html"]


def test_page_says_what_the_result_says(page):
    shown = browser.shown(page.path, page.folder / "profile")
    assert shown.one(id="script-errors").text == ""
    assert shown.one("html").attributes["data-ready"] == "yes"
    verdict = shown.one("section", id="verdict")
    said = {event["level"] for event in page.result["events"]}
    assert verdict.attributes["data-level"] == next(level for level in ("ERROR", "WARN", "OK", "STALE") if level in said)
    assert {each.attributes["data-level"]: float(each.attributes["data-seconds"]) for each in verdict.all("div")
            if "data-seconds" in each.attributes} == page.result["seconds"]
    rows = [row for row in shown.one("section", id="events").all("tr") if "data-event" in row.attributes]
    assert [(row.attributes["data-event"], float(row.attributes["data-time"])) for row in rows] == [
        (event["level"], event["time"]) for event in page.result["events"]]
    for row, event in zip(rows, page.result["events"]):
        assert event["message"].replace("m/s^2", "m/s²").split(" -")[0] in row.text
    for bag in page.bags:
        assert bag.name in verdict.one("p", class_="source").text
    canvases = list(shown.all("canvas"))
    assert len(canvases) == (1 if page.case == "parked" else 3)
    assert ("No estimate was ever valid" in shown.one("section", id="course").text) == (page.case == "parked")
    assert page.result["end"]["message"].replace("m/s^2", "m/s²").split(" -")[0] in verdict.text
    for canvas in canvases:
        pixels = int(canvas.attributes["width"]) * int(canvas.attributes["height"])
        assert int(canvas.attributes["data-painted"]) > 0.01 * pixels, canvas.attributes["aria-label"]


@pytest.mark.parametrize("width, dark", [(1400, False), (390, True)])  # colours move nothing
def test_nothing_is_cut_off(page, width, dark):
    root = browser.measured(page.path, page.folder / "measured", width, dark).one("html").attributes
    assert (root["data-width"], root["data-dark"]) == (str(width), str(dark).lower())
    assert root["data-cut"] == ""
    assert root["data-scrolls"] == "0"


def test_page_that_cannot_be_written_is_refused(program, worn_bag, tmp_path):
    (tmp_path / "file").write_text("here first")
    for folder in (tmp_path / "file", tmp_path / "no" / "folder"):
        program.refuse(3, ["health", worn_bag, "--report", folder], [folder, "cannot be made"], tmp_path)
