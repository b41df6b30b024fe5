"""What suspension_bag diagnose says of its findings: what they cost in b1 and b0, and how the strut travelled."""
import json
import re
import types

import numpy as np
import pytest
import rosbag

import browser

DRIVE = ["--scenario", "iso_road", "--vehicle", "ugv", "--rate", "100", "--set", "noise=0.03", "--duration", "60"]
HIDDEN = {"friction": ["--effect", "coulomb_friction=0.35,vs=0.02"], "stop": ["--effect", "bump_stop=47,g=0.013"],
          "late": ["--effect", "clock_offset=0.002"], "later": ["--effect", "clock_offset=0.02"]}


@pytest.fixture(scope="module", params=sorted(HIDDEN))
def said(request, program, tmp_path_factory):
    folder = tmp_path_factory.mktemp(request.param)
    program.succeed("simulate", *DRIVE, *HIDDEN[request.param], "-o", folder / "drive.bag")
    text = program.succeed("diagnose", folder / "drive.bag", "--json", folder / "result.json", "--report", folder / "page")
    return types.SimpleNamespace(case=request.param, text=text, folder=folder,
                                 result=json.loads((folder / "result.json").read_text()),
                                 page=browser.shown(folder / "page" / "report.html", folder / "profile"))


def test_cost_is_by_how_much_the_fit_without_the_effect_is_off(said):
    [cost], result = said.result["costs"], said.result
    assert [cost["effect"]] == result["selected"]
    for name in ("damping", "stiffness"):
        without, found = (result[model]["parameters"][f"{name}_to_mass"] for model in ("base", "extended"))
        if name in cost:
            # The model found is of all samples in `extended`, of two thirds of them in the cost.
            stddev = result["extended"]["stddevs"][f"{name}_to_mass"] / found
            assert cost[name]["change"] == pytest.approx(without / found - 1, abs=5 * stddev)
    true = {"damping": 4.0, "stiffness": 40.0}  # of the ugv
    if said.case == "friction":
        for name, value in true.items():
            off = result["base"]["parameters"][f"{name}_to_mass"] / value - 1
            assert cost[name]["change"] == pytest.approx(off, abs=4 * cost[name]["stddev"])


def test_sentence_has_the_number_in_terminal_and_page_alike(said):
    [cost] = said.result["costs"]
    assert cost["sentence"] in said.text
    assert said.page.one("p", class_="cost").text == cost["sentence"].replace("_", " ")
    for name, symbol in (("damping", "b1 (damping)"), ("stiffness", "b0 (stiffness)")):
        shown = re.search(rf"{re.escape(symbol)} (\S+) % (high|low)", cost["sentence"])
        if shown:
            sign = 1 if shown[2] == "high" else -1
            assert 100 * cost[name]["change"] == pytest.approx(sign * float(shown[1]), abs=0.51)
        else:
            assert f"{symbol} wrong by" in cost["sentence"]


def test_a_sensor_is_left_alone_if_it_moves_nothing(said):
    [cost] = said.result["costs"]
    assert cost["harmless"] == ("nothing to do" in cost["sentence"]) == (said.case == "late")
    advice = "synchronise their clocks"
    assert (advice in said.text) == (said.case == "later")
    assert (advice in said.page.one(id="verdict").text) == (said.case == "later")


def travel_of(bag):
    """Travel [m] without a model: the relative acceleration, integrated twice over frequency from 0.3 Hz on."""
    series = {"/sprung/imu": [], "/unsprung/imu": []}
    with rosbag.Bag(str(bag)) as source:
        for topic, message, _ in source.read_messages(list(series)):
            series[topic].append(message.linear_acceleration.z)
    relative = np.subtract(series["/unsprung/imu"], series["/sprung/imu"])
    frequency = np.fft.rfftfreq(len(relative), 0.01)
    wanted = frequency > 0.3
    spectrum = np.fft.rfft(relative) * wanted / -np.maximum(2 * np.pi * frequency, 1.0) ** 2
    return np.fft.irfft(spectrum, len(relative)), np.fft.irfft(spectrum * 2j * np.pi * frequency, len(relative))


def test_histograms_have_the_spread_of_the_integrated_readings(said):
    for name, truth in zip(("travel", "travel_rate"), travel_of(said.folder / "drive.bag")):
        found = said.result["travel"][name]
        edges, shares = np.array(found["edges"]), np.array(found["shares"])
        assert shares.sum() == pytest.approx(1.0) and 0.0 in edges and len(edges) == len(shares) + 1
        middles = (edges[:-1] + edges[1:]) / 2
        spread = np.sqrt((shares * middles ** 2).sum() - (shares * middles).sum() ** 2)
        assert spread == pytest.approx(truth.std(), rel=0.15)
        assert found["compression"]["share"] + found["rebound"]["share"] == pytest.approx(1.0, abs=1e-3)
        assert shares[edges[:-1] >= 0].sum() == pytest.approx(found["compression"]["share"], abs=1e-3)


def test_use_of_a_stop_is_told_where_its_gap_is_known(said):
    stops = said.result["travel"]["stops"]
    assert [stop["effect"] for stop in stops] == (["bump_stop"] if said.case == "stop" else [])
    for stop in stops:
        edges, shares = (np.array(said.result["travel"]["travel"][name]) for name in ("edges", "shares"))
        assert stop["gap"] == said.result["extended"]["shapes"]["bump_stop/g"]
        assert shares[edges[:-1] >= stop["gap"]].sum() <= stop["near"] <= shares[edges[1:] > 0.9 * stop["gap"]].sum()
        assert stop["hits"] > 5 and f"hit {stop['hits']} times" in said.text
        assert f"hit {stop['hits']} times" in said.page.one("p", class_="stop").text


def test_every_page_begins_with_the_verdict_of_check_on_the_data(program, said):
    program.succeed("check", said.folder / "drive.bag", "--json", said.folder / "check.json")
    checked = json.loads((said.folder / "check.json").read_text())
    program.succeed("health", said.folder / "drive.bag", "--report", said.folder / "health")
    for page in (said.page, browser.shown(said.folder / "health" / "report.html", said.folder / "profile")):
        assert page.one(id="script-errors").text == ""
        box = next(each for each in page.one("main").all() if each.tag in ("details", "section"))
        assert (box.tag, box.attributes["id"]) == ("details", "data")
        assert "Yes: all 2 IMUs are OK" in box.one("summary").text and "open" not in box.attributes
        rows = {row.attributes["data-imu"]: row.text for row in box.all("tr") if "data-imu" in row.attributes}
        assert set(rows) == {each["topic"] for each in checked["topics"]}
        for each in checked["topics"]:
            assert rows[each["topic"]].endswith(each["verdict"]) and f" {each['rate']:.4g}" in rows[each["topic"]]


def test_data_with_a_fault_is_told_at_once(program, tmp_path):
    program.succeed("simulate", *DRIVE, "-o", tmp_path / "clean.bag")
    lost = iter(np.random.default_rng(1).random(100_000) < 0.15)
    with rosbag.Bag(str(tmp_path / "clean.bag")) as source, rosbag.Bag(str(tmp_path / "drive.bag"), "w") as target:
        for topic, message, time in source.read_messages():
            if topic != "/sprung/imu" or not next(lost):
                target.write(topic, message, time)
    program.succeed("health", tmp_path / "drive.bag", "--report", tmp_path / "page")
    box = browser.shown(tmp_path / "page" / "report.html", tmp_path / "profile").one("details", id="data")
    assert "open" in box.attributes and box.attributes["data-level"] == "WARN"
    assert "Look at /sprung/imu" in box.one("summary").text
    assert "of the readings are missing: look for a slow link" in box.one("tr", data_imu="/sprung/imu").text
    for width, dark in ((1400, False), (390, True)):
        root = browser.measured(tmp_path / "page" / "report.html", tmp_path / "measured", width, dark).one("html").attributes
        assert (root["data-cut"], root["data-scrolls"], root["data-broken"]) == ("", "0", "")
