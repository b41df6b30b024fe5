"""The layouts for rqt and PlotJuggler: well-formed, and every topic and field that they show exists."""
import ast
import collections
import json
import pathlib
import re
import xml.etree.ElementTree as ElementTree

import pytest

from terminal import Terminal

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
CONFIG = REPOSITORY / "config"
PERSPECTIVE = json.loads((CONFIG / "rqt_suspension.perspective").read_text())
LAYOUT = ElementTree.parse(CONFIG / "plotjuggler_layout.xml").getroot()
NUMBERS = r"(?:float64|byte|bool|uint8)"


def topics_of_the_monitor():
    """Message type by name of the topic, as the nodelet has them advertised."""
    sources = " ".join(path.read_text() for path in (REPOSITORY / "src" / "ros").glob("*.cpp")
                       if path.name in ("report_topics.cpp", "tyre_output.cpp"))
    return {topic: message for message, topic in re.findall(r'advertise<(\w+)>\("(\w+)"', sources)}


def numeric_fields(message):
    lines = (REPOSITORY / "msg" / f"{message}.msg").read_text().splitlines()
    return {match[1] for match in (re.match(rf"{NUMBERS}\s+(\w+)\s*(?:#.*)?$", line) for line in lines) if match}


def plugins():
    return ast.literal_eval(PERSPECTIVE["groups"]["pluginmanager"]["keys"]["running-plugins"]["repr"])


def settings_of(plugin, number):
    name = f"plugin__{plugin.replace('/', '__')}__{number}"
    return PERSPECTIVE["groups"]["pluginmanager"]["groups"][name]["groups"]["plugin"]["keys"]


def rqt_curves():
    return [topic for number in plugins()["rqt_plot/Plot"]
            for topic in ast.literal_eval(settings_of("rqt_plot/Plot", number)["topics"]["repr"])]


def plotjuggler_curves():
    return [curve.get("name") for curve in LAYOUT.iter("curve")]


@pytest.mark.parametrize("curve", [*rqt_curves(), *plotjuggler_curves()])
def test_curve_is_a_number_that_is_published(curve):
    node, topic, field = curve.strip("/").split("/")
    messages = {"monitor": topics_of_the_monitor(), "simulator": {"truth": "SimulationTruth"}}
    assert field in numeric_fields(messages[node][topic])


def test_all_that_is_in_view_comes_from_a_running_system(tmp_path, port):
    """The curves, and what the other plugins look at: /diagnostics, without an aggregator, and the settings."""
    terminal = Terminal(tmp_path, port)
    fields = collections.defaultdict(set)
    for curve in [*rqt_curves(), *plotjuggler_curves()]:
        topic, _, field = curve.strip("/").rpartition("/")
        fields[topic].add(field)
    with terminal.start("roslaunch suspension_health_monitor paper.launch duration:=3600", "launch.txt") as launched:
        terminal.wait_for_master()
        terminal.wait_for_words("launch.txt", "/monitor: STALE", launched)
        for topic, its in fields.items():
            message = terminal.run(f"timeout 120 rostopic echo -n 1 /{topic}")
            assert its <= set(re.findall(r"^(\w+): \S", message, re.MULTILINE)), topic
        assert "monitor: Health" in terminal.run("timeout 120 rostopic echo -n 3 /diagnostics")
        assert "memory" in terminal.run("timeout 120 rosrun dynamic_reconfigure dynparam get /monitor")


def test_perspective_has_the_settings_of_every_running_plugin_and_no_others():
    running = {f"plugin__{plugin.replace('/', '__')}__{number}"
               for plugin, numbers in plugins().items() for number in numbers}
    assert running == set(PERSPECTIVE["groups"]["pluginmanager"]["groups"])
    assert set(plugins()) == {"rqt_plot/Plot", "rqt_runtime_monitor/RuntimeMonitor", "rqt_reconfigure/Param"}


def test_every_value_of_the_perspective_can_be_read_back():
    def check(group):
        assert set(group) == {"groups", "keys"}
        for value in group["keys"].values():
            assert value["type"] == "repr"
            ast.literal_eval(value["repr"])
        for child in group["groups"].values():
            check(child)
    check(PERSPECTIVE)


def test_plotjuggler_splitters_have_as_many_sizes_and_plots_as_they_say():
    splitters = list(LAYOUT.iter("DockSplitter"))
    assert splitters
    for splitter in splitters:
        count = int(splitter.get("count"))
        sizes = [float(size) for size in splitter.get("sizes").split(";")]
        assert len(sizes) == count == len(splitter.findall("DockArea/plot"))
        assert sum(sizes) == pytest.approx(1.0, abs=1e-4)
